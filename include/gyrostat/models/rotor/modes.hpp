// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "gyrostat/models/rotor/gyrostat.hpp"

/// The linear equations near a steady rotation and their solution by eigenvectors (docs/rotor.md, section 4.1).
namespace gyrostat::rotor {

/// The equations of motion about a steady rotation with the momentum l m0, the rotor rate omega_s and Omega = psi_dot m0, in the
/// unknowns d = m - m0 = a u + b v + normal part, and xi = (p - p0)/(lambda k unit). With q = G d - xi g, exactly:
///     Omega = psi_dot m + q,   dm/dt = m x q,   dxi/dt = feed n.d - St xi,   omega - omega_s = unit xi - (l/k) n.d.
template <Real Scalar>
struct Linearisation {
  Scalar norm = 0;          ///< l, N m s
  Vec3<Scalar> m, u, v;     ///< m0 and two unit tangents, right-handed (u, v, m0); body axes
  Scalar spin_rate = 0;     ///< psi_dot, rad/s
  Mat3<Scalar> G;           ///< l R^-1 - psi_dot E, 1/s
  Vec3<Scalar> g;           ///< lambda unit n, 1/s
  Vec3<Scalar> n;           ///< J e, 1/(kg m^2)
  Scalar unit = 0;          ///< of omega - omega_s in xi, rad/s: xi and d store alike much energy
  Scalar feed = 0;          ///< St l/(k unit), kg m^2/s
  Scalar relaxation = 0;    ///< St, 1/s
  Scalar rate_of_tilt = 0;  ///< l/k: omega - omega_s by n.d
  Mat3<Scalar> matrix;      ///< of (a, b, xi), 1/s

  /// m0 of unit length; it need not be steady to the last digit.
  Linearisation(const Gyrostat<Scalar>& gyrostat, Scalar l, const Vec3<Scalar>& m0, Scalar omega_s) noexcept
      : norm(l), m(m0), n(gyrostat.inverse_inertia() * gyrostat.axis()), relaxation(gyrostat.relaxation_rate()) {
    const Scalar lambda = gyrostat.axial_inertia(), k = gyrostat.coupling();
    int least = 0;
    m.cwiseAbs().minCoeff(&least);
    u = cross<Scalar>(Vec3<Scalar>::Unit(least), m).normalized();
    v = cross<Scalar>(m, u);
    spin_rate = m.dot(gyrostat.inverse_inertia() * (l * m - lambda * omega_s * gyrostat.axis()));
    G = l * gyrostat.free_inverse() - spin_rate * Mat3<Scalar>::Identity();
    unit = l / std::sqrt(gyrostat.principal()[0] * lambda * k);
    g = lambda * unit * n;
    feed = relaxation * l / (k * unit);
    rate_of_tilt = l / k;
    const Vec3<Scalar> Gu = G * u, Gv = G * v;
    matrix << -v.dot(Gu), -v.dot(Gv), v.dot(g),  //
        u.dot(Gu), u.dot(Gv), -u.dot(g),         //
        feed * n.dot(u), feed * n.dot(v), -relaxation;
  }

  /// q, rad/s.
  Vec3<Scalar> tilt_rate(const Vec3<Scalar>& d, Scalar xi) const noexcept { return G * d - xi * g; }
  /// omega - omega_s, rad/s.
  Scalar excess(const Vec3<Scalar>& d, Scalar xi) const noexcept { return unit * xi - rate_of_tilt * n.dot(d); }
};

namespace detail {

/// exp z - 1.
template <Real Scalar>
std::complex<Scalar> expm1(std::complex<Scalar> z) noexcept {
  const Scalar grown = std::expm1(z.real()), s = std::sin(z.imag() / 2);
  return {grown * std::cos(z.imag()) - 2 * s * s, (grown + 1) * std::sin(z.imag())};
}

/// exp z.
template <Real Scalar>
std::complex<Scalar> exponential(std::complex<Scalar> z) noexcept {
  const Scalar size = std::exp(z.real());
  return {size * std::cos(z.imag()), size * std::sin(z.imag())};
}

/// Integral of exp(d s) over s in [0, t].
template <Real Scalar>
std::complex<Scalar> integral_of_exp(std::complex<Scalar> d, Scalar t) noexcept {
  const std::complex<Scalar> z = d * t;
  return z == Scalar(0) ? std::complex<Scalar>(t) : t * (expm1(z) / z);
}

/// (exp(a t) - exp(b t))/(a - b), for a = b too.
template <Real Scalar>
std::complex<Scalar> exp_difference(std::complex<Scalar> a, std::complex<Scalar> b, Scalar t) noexcept {
  if (a.real() < b.real()) std::swap(a, b);
  return exponential(a * t) * integral_of_exp(b - a, t);
}

}  // namespace detail

/// dy/dt = A y in three unknowns: y = sum_i right_i exp(exponent_i t) (left_i y0). Near a double exponent right and left grow
/// like one over the distance; what that costs is told by condition().
template <Real Scalar>
struct Modes {
  using Complex = std::complex<Scalar>;
  using Vector = Eigen::Matrix<Complex, 3, 1>;
  std::array<Complex, 3> exponent;           ///< 1/s
  Eigen::Matrix<Complex, 3, 3> right, left;  ///< columns of unit length, and rows; left right = 1

  explicit Modes(const Mat3<Scalar>& A) noexcept {
    const Eigen::EigenSolver<Mat3<Scalar>> solver(A);
    right = solver.eigenvectors();
    for (int i = 0; i < 3; ++i) exponent[std::size_t(i)] = solver.eigenvalues()[i];
    complete();
  }
  /// With exponents that are known better than A tells them.
  Modes(const Mat3<Scalar>& A, const std::array<Complex, 3>& exponents) noexcept : exponent(exponents) {
    for (int i = 0; i < 3; ++i) {
      // normal to the rows of A - d
      Eigen::Matrix<Complex, 3, 3> rest = A.template cast<Complex>();
      for (int k = 0; k < 3; ++k) rest(k, k) -= exponent[std::size_t(i)];
      Scalar most = -1;
      for (int k = 0; k < 3; ++k) {
        const Vector a = rest.row(k).normalized(), b = rest.row((k + 1) % 3).normalized();
        const Eigen::Matrix<Complex, 1, 3> normal = product(a, b);
        if (normal.norm() > most) {
          most = normal.norm();
          right.col(i) = normal.transpose();
        }
      }
    }
    complete();
  }

  /// Greatest |left|: at least 1; rounding is amplified as much. Infinite or NaN where there are not three eigenvectors.
  Scalar condition() const noexcept {
    Scalar most = 0;
    for (int i = 0; i < 3; ++i) {
      const Scalar here = left.row(i).norm();
      most = here <= most ? most : here;
    }
    return most;
  }
  /// Of the mode that decays most slowly or grows fastest, 1/s.
  Scalar growth_rate() const noexcept { return std::max({exponent[0].real(), exponent[1].real(), exponent[2].real()}); }

  Vec3<Scalar> at(Scalar t, const Vec3<Scalar>& y0) const noexcept {
    Vector y = Vector::Zero();
    for (int i = 0; i < 3; ++i)
      y += right.col(i) *
           (detail::exponential(exponent[std::size_t(i)] * t) * (left.row(i) * y0.template cast<Complex>())(0));
    return y.real();
  }
  /// Integral of y over [0, t].
  Vec3<Scalar> integral(Scalar t, const Vec3<Scalar>& y0) const noexcept {
    Vector y = Vector::Zero();
    for (int i = 0; i < 3; ++i)
      y += right.col(i) *
           (detail::integral_of_exp(exponent[std::size_t(i)], t) * (left.row(i) * y0.template cast<Complex>())(0));
    return y.real();
  }

 private:
  void complete() noexcept {
    for (int i = 0; i < 3; ++i) right.col(i).normalize();
    const Vector r0 = right.col(0), r1 = right.col(1), r2 = right.col(2);
    left.row(0) = product(r1, r2);
    left.row(1) = product(r2, r0);
    left.row(2) = product(r0, r1);
    left /= (left.row(0) * r0)(0);
  }
  /// The vector product without conjugation.
  static Eigen::Matrix<Complex, 1, 3> product(const Vector& a, const Vector& b) noexcept {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
};

}  // namespace gyrostat::rotor
