// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/body/inertia.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat::free {

/// A gyrostat that no torque acts on, with constant rotor momentum: M = J omega + l, dM/dt = M x omega, dq/dt = q (0, omega)/2. Body
/// axes, SI units. Rotors are taken into J and l by reduced.hpp.
template <Real Scalar>
struct Problem {
  Mat3<Scalar> inertia = Mat3<Scalar>::Identity();  ///< J, symmetric, kg m^2
  Vec3<Scalar> rotor_momentum{0, 0, 0};             ///< l, N m s
  Vec3<Scalar> angular_velocity{0, 0, 0};           ///< at t = 0, rad/s; not read where the momentum is given
  Vec3<Scalar> angular_momentum{0, 0, 0};           ///< M at t = 0, N m s
  bool momentum_given = false;
  Quat<Scalar> attitude{};  ///< at t = 0, body to inertial

  static Problem from_moments(const Vec3<Scalar>& moments, const Vec3<Scalar>& rotor_momentum,
                              const Vec3<Scalar>& angular_velocity, const Quat<Scalar>& attitude = {}) noexcept {
    Problem problem;
    problem.inertia = moments.asDiagonal();
    problem.rotor_momentum = rotor_momentum;
    problem.angular_velocity = angular_velocity;
    problem.attitude = attitude;
    return problem;
  }

  /// Errc::not_finite; not_symmetric, not_positive, triangle_inequality: the inertia, to 8 eps of Tolerance; out_of_domain: the attitude
  /// is not of unit length within 1e-8.
  template <Real Tolerance = Scalar>
  Errc check() const noexcept {
    using std::abs;
    if (!rotor_momentum.allFinite() || !(momentum_given ? angular_momentum : angular_velocity).allFinite())
      return Errc::not_finite;
    const Scalar length = norm(attitude);
    if (!(length - length == 0)) return Errc::not_finite;
    if (!(abs(length - 1) <= Scalar(1e-8) + 4 * Scalar(epsilon<Tolerance>))) return Errc::out_of_domain;
    return Inertia<Tolerance>::check_tensor(matrix_cast<Tolerance>(inertia));
  }

  /// M at t = 0, body axes, N m s.
  Vec3<Scalar> momentum() const noexcept {
    return momentum_given ? angular_momentum : Vec3<Scalar>(inertia * angular_velocity + rotor_momentum);
  }

  template <Real To>
  Problem<To> cast() const noexcept {
    const auto& q = attitude;
    return {matrix_cast<To>(inertia),
            vector_cast<To>(rotor_momentum),
            vector_cast<To>(angular_velocity),
            vector_cast<To>(angular_momentum),
            momentum_given,
            {static_cast<To>(q.w), static_cast<To>(q.x), static_cast<To>(q.y), static_cast<To>(q.z)}};
  }
};

/// A problem in principal axes, moments descending.
template <Real Scalar>
struct PrincipalProblem {
  Vec3<Scalar> moments{1, 1, 1}, inverse{1, 1, 1};  ///< J_i and a_i = 1/J_i
  Mat3<Scalar> gaps = Mat3<Scalar>::Zero();         ///< a_j - a_i, from differences of the moments
  Mat3<Scalar> R_BP = Mat3<Scalar>::Identity();
  Vec3<Scalar> l{0, 0, 0}, G{0, 0, 0}, M{0, 0, 0}, omega{0, 0, 0};  ///< G = J omega, M = G + l

  /// Moments that agree to rounding are made equal, and the axes between them turned so that the first carries what rotor momentum lies
  /// across.
  static PrincipalProblem of(const Problem<Scalar>& problem) noexcept {
    using std::hypot;
    PrincipalProblem p;
    const SymmetricEigen<Scalar> eigen = symmetric_eigen<Scalar>(-(problem.inertia + problem.inertia.transpose()) / 2);
    p.moments = -eigen.values;
    p.R_BP = eigen.axes;
    p.l = p.R_BP.transpose() * problem.rotor_momentum;
    for (int i = 0; i < 2; ++i) {
      if (!(p.moments[i] - p.moments[i + 1] <= 4 * epsilon<Scalar> * p.moments[0])) continue;
      p.moments[i] = p.moments[i + 1] = (p.moments[i] + p.moments[i + 1]) / 2;
      const Scalar across = hypot(p.l[i], p.l[i + 1]);
      if (across == 0 || p.l[i + 1] == 0) continue;
      const Scalar c = p.l[i] / across, s = p.l[i + 1] / across;
      const Vec3<Scalar> first = p.R_BP.col(i), second = p.R_BP.col(i + 1);
      p.R_BP.col(i) = c * first + s * second;
      p.R_BP.col(i + 1) = c * second - s * first;
      p.l[i] = across;
      p.l[i + 1] = 0;
    }
    p.take_motion(problem);
    return p;
  }

  template <Real To>
  PrincipalProblem<To> cast() const noexcept {
    return {vector_cast<To>(moments), vector_cast<To>(inverse), matrix_cast<To>(gaps), matrix_cast<To>(R_BP),
            vector_cast<To>(l),       vector_cast<To>(G),       vector_cast<To>(M),    vector_cast<To>(omega)};
  }

  /// The same where axes are known that are wrong by roundings only, and the moments are apart: for a tenth of the cost.
  static PrincipalProblem beside(const Problem<Scalar>& problem, const Mat3<Scalar>& axes) noexcept {
    PrincipalProblem p;
    const Mat3<Scalar> J = axes.transpose() * (problem.inertia * axes);
    Mat3<Scalar> turn = Mat3<Scalar>::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != j) turn(i, j) = (J(i, j) + J(j, i)) / (2 * (J(j, j) - J(i, i)));
    p.moments = J.diagonal();
    p.R_BP = axes * turn;
    p.l = p.R_BP.transpose() * problem.rotor_momentum;
    p.take_motion(problem);
    return p;
  }

  /// omega is parallel to M to rounding, component by component: a start 1e-300 off a principal axis is not.
  bool steady(const Scalar& R) const noexcept {
    using std::abs;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Scalar first = M[j] / R * omega[k], second = M[k] / R * omega[j];
      if (abs(first - second) > 2 * epsilon<Scalar> * (abs(first) + abs(second))) return false;
    }
    return true;
  }

  /// The axis about which the body is symmetric, 0 or 2, where the rotor momentum lies along it to rounding; else -1.
  int axis_of_symmetry() const noexcept {
    using std::abs;
    for (const int k : {0, 2}) {
      const Scalar slight = 4 * epsilon<Scalar> * abs(l[k]);
      if (moments[1] == moments[2 - k] && abs(l[1]) <= slight && abs(l[2 - k]) <= slight) return k;
    }
    return -1;
  }

  /// J is a sphere to rounding.
  bool spherical() const noexcept { return gaps(0, 2) <= 8 * epsilon<Scalar> * inverse[2]; }

 private:
  /// What follows from the moments, the axes and l.
  void take_motion(const Problem<Scalar>& problem) noexcept {
    const Vec3<Scalar>& J = moments;
    for (int i = 0; i < 3; ++i) {
      inverse[i] = 1 / J[i];
      for (int j = 0; j < 3; ++j) gaps(i, j) = (J[i] - J[j]) / (J[i] * J[j]);
    }
    if (problem.momentum_given) {
      M = R_BP.transpose() * problem.angular_momentum;
      G = M - l;
      // wheels that have all of the momentum, but for the rounding of turned axes
      if (G.cwiseAbs().maxCoeff() <= 4 * epsilon<Scalar> * M.cwiseAbs().maxCoeff()) M = l, G.setZero();
      omega = inverse.cwiseProduct(G);
    } else {
      omega = R_BP.transpose() * problem.angular_velocity;
      G = J.cwiseProduct(omega);
      M = G + l;
    }
  }
};

}  // namespace gyrostat::free
