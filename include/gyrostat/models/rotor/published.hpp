// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "gyrostat/models/rotor/modes.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The linear equations (54), (55) of the paper on the free motion of a gyrostat whose rotor is driven by a motor of limited power, and
/// its scalar example: as printed, with the algebra corrected, and with data for which the rotation is a steady one
/// (docs/rotor.md, sections 6 and 8). For the reproduction of its figures 2 and 3 only.
namespace gyrostat::rotor::published {

/// The data of an example, SI units, principal axes of theta.
template <Real Scalar>
struct Data {
  Vec3<Scalar> inertia;    ///< theta, kg m^2
  Vec3<Scalar> axis;       ///< e
  Scalar axial_inertia;    ///< lambda, kg m^2
  Scalar slope;            ///< S, N m s/rad
  Scalar no_load_rate;     ///< omega*, rad/s; NaN: never given. The linear equations do not have it
  Scalar norm;             ///< l, N m s
  Vec3<Scalar> direction;  ///< m_inf
  Scalar spin_rate;        ///< psi_dot_inf, rad/s
};

/// gamma_1, gamma_2 along the tangents u, v of m_inf, b = beta_*' = omega - omega*, and gamma_3 along m_inf, with
/// m = m_inf + m_inf x gamma: rad, rad, rad/s, rad.
template <Real Scalar>
struct Deviation {
  Vec3<Scalar> y;  ///< gamma_1, gamma_2, b
  Scalar along;    ///< gamma_3
};

/// y' = A y, gamma_3' = a.y.
template <Real Scalar>
class System {
 public:
  /// A has a negative trace.
  System(const Mat3<Scalar>& matrix, const Vec3<Scalar>& drift) noexcept
      : matrix_(matrix), drift_(drift), modes_(matrix, exponents_of(matrix)) {}

  const Mat3<Scalar>& matrix() const noexcept { return matrix_; }                                     ///< A, 1/s
  const Vec3<Scalar>& drift() const noexcept { return drift_; }                                       ///< a, 1/s
  const std::array<math::Complex<Scalar>, 3>& exponents() const noexcept { return modes_.exponent; }  ///< 1/s
  /// Of the fastest growing mode, 1/s; negative where all decay.
  Scalar growth_rate() const noexcept { return modes_.growth_rate(); }

  Deviation<Scalar> at(Scalar t, const Deviation<Scalar>& start) const noexcept {
    return {modes_.at(t, start.y), start.along + drift_.dot(modes_.integral(t, start.y))};
  }

 private:
  /// The characteristic polynomial as (d + s)(d^2 + D) + kappa d.
  static std::array<math::Complex<Scalar>, 3> exponents_of(const Mat3<Scalar>& A) noexcept {
    const Scalar s = -A.trace();
    const Vec3<Scalar> c0 = A.col(0), c1 = A.col(1), c2 = A.col(2);
    const Scalar D = -c0.dot(cross<Scalar>(c1, c2)) / s;
    const Scalar minors = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0) + A(0, 0) * A(2, 2) - A(0, 2) * A(2, 0) +
                          A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1);
    std::array<math::Complex<Scalar>, 3> d;
    const auto roots = detail::nutation_roots(s, D, minors - D);
    for (std::size_t i = 0; i < 3; ++i) d[i] = {roots[i].real(), roots[i].imag()};
    return d;
  }

  Mat3<Scalar> matrix_;
  Vec3<Scalar> drift_;
  Modes<Scalar> modes_;
};

/// The paper's data. m_inf = (0, 0, 1), psi_dot = 1 is a steady rotation for no omega*, and no body has this theta with this rotor.
template <Real Scalar>
Data<Scalar> printed_data() noexcept {
  return {{3, 5, 7}, {Scalar(0.5L), Scalar(0.5L), std::sqrt(Scalar(0.5L))}, 2, 4, nan<Scalar>, 1, {0, 0, 1}, 1};
}
/// The paper's start: angles of some ten radians in equations that are linear in them.
template <Real Scalar>
Deviation<Scalar> printed_start() noexcept {
  return {{10, 11, Scalar(0.01L)}, 5};
}
/// The least change that makes (0, 0, 1) a steady rotation with psi_dot = 1, a minimum of F: l = 7, omega* = 0.
template <Real Scalar>
Data<Scalar> repaired_data() noexcept {
  Data<Scalar> data = printed_data<Scalar>();
  data.no_load_rate = 0;
  data.norm = 7;
  return data;
}
/// With a rotor that a body can have and a motor that runs: lambda = 0.5, l = 7, omega* = 1. m_inf and psi_dot are the root of the secular
/// equation, docs/rotor.md (4.2), by Newton's method.
template <Real Scalar>
Data<Scalar> realisable_data() noexcept {
  Data<Scalar> data = repaired_data<Scalar>();
  data.axial_inertia = Scalar(0.5L);
  data.no_load_rate = 1;
  const Scalar h = data.axial_inertia * data.no_load_rate;
  Scalar psi = Scalar(0.949L);
  for (int trip = 0; trip < 8; ++trip) {
    Scalar f = -1, slope = 0;
    for (int i = 0; i < 3; ++i) {
      const Scalar gap = data.norm - psi * data.inertia[i];
      const Scalar m = h * data.axis[i] / gap;
      data.direction[i] = m;
      f += m * m;
      slope += 2 * m * m * data.inertia[i] / gap;
    }
    psi -= f / slope;
  }
  data.spin_rate = psi;
  data.direction.normalize();
  return data;
}

/// The four scalar equations as printed.
template <Real Scalar>
System<Scalar> printed() noexcept {
  const Scalar third = Scalar(1) / 3;
  const Scalar c = Scalar(0.1L), d = Scalar(0.167L), s = 4, k = Scalar(1.41L);
  // -g1' - 2 g2/3 + b/3 = 0, g2' + 4 g1/5 + b/5 = 0, -0.1 g1' + 0.167 g2' + 4 b + 1.41 b' = 0, g3' + sqrt(2) b/7 = 0
  const Vec3<Scalar> g1(0, -2 * third, third), g2(-Scalar(0.8L), 0, -Scalar(0.2L));
  Mat3<Scalar> A;
  A.row(0) = g1.transpose();
  A.row(1) = g2.transpose();
  A.row(2) = ((c * g1 - d * g2 - Vec3<Scalar>(0, 0, s)) / k).transpose();
  return {A, {0, 0, -std::sqrt(Scalar(2)) / 7}};
}

/// (54) and (55) in scalars, with S/lambda in place of S. The tangents are u = (1, 0, 0), v = (0, 1, 0) for m_inf = (0, 0, 1), and
/// elsewhere what the shortest turn from there makes of them.
template <Real Scalar>
System<Scalar> corrected(const Data<Scalar>& data) noexcept {
  const Vec3<Scalar>& m = data.direction;
  const Scalar lambda = data.axial_inertia, l = data.norm;
  const Vec3<Scalar> j = data.inertia.cwiseInverse();
  const Scalar share = m[0] * m[1] / (1 + m[2]);
  const Vec3<Scalar> u(1 - m[0] * m[0] / (1 + m[2]), -share, -m[0]);
  const Vec3<Scalar> v(-share, 1 - m[1] * m[1] / (1 + m[2]), -m[1]);
  // gamma' = J (l m x gamma - lambda b e) - psi_dot m x gamma;  m x u = v, m x v = -u
  const Vec3<Scalar> by_1 = l * j.cwiseProduct(v), by_2 = -l * j.cwiseProduct(u);
  const Vec3<Scalar> by_b = -lambda * j.cwiseProduct(data.axis);
  const Scalar k = 1 + data.axis.dot(by_b);
  Mat3<Scalar> A;
  A.row(0) << u.dot(by_1), u.dot(by_2) + data.spin_rate, u.dot(by_b);
  A.row(1) << v.dot(by_1) - data.spin_rate, v.dot(by_2), v.dot(by_b);
  // k b' + e.(by_1 g1' + by_2 g2') = -(S/lambda) b
  A.row(2) = -(data.axis.dot(by_1) * A.row(0) + data.axis.dot(by_2) * A.row(1)) / k;
  A(2, 2) -= data.slope / (lambda * k);
  return {A, {m.dot(by_1), m.dot(by_2), m.dot(by_b)}};
}

/// The vector psi_dot theta m - l m + h e that a steady rotation makes zero, N m s.
template <Real Scalar>
Vec3<Scalar> misfit(const Data<Scalar>& data, Scalar no_load_rate) noexcept {
  return data.spin_rate * data.inertia.cwiseProduct(data.direction) - data.norm * data.direction +
         data.axial_inertia * no_load_rate * data.axis;
}

}  // namespace gyrostat::rotor::published
