// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"

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
  Scalar unit = 0;          ///< of omega - omega_s in xi, rad/s: so that xi and d count alike in the energy
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
  /// Of the matrix where m0 is steady: the roots of docs/rotor.md (4.3), 1/s.
  std::array<math::Complex<Scalar>, 3> exponents() const noexcept {
    // B = G - (lambda l/k) n n^T
    const Scalar pull = g.norm() / (n.norm() * unit) * rate_of_tilt;
    const Scalar nu = n.dot(u), nv = n.dot(v);
    const Scalar uu = u.dot(G * u) - pull * nu * nu, vv = v.dot(G * v) - pull * nv * nv;
    const Scalar uv = u.dot(G * v) - pull * nu * nv;
    // n x m = nv u - nu v
    const Scalar kappa = pull * (nv * nv * uu - 2 * nu * nv * uv + nu * nu * vv);
    std::array<math::Complex<Scalar>, 3> d;
    const auto roots = detail::nutation_roots(relaxation, uu * vv - uv * uv, kappa);
    for (std::size_t i = 0; i < 3; ++i) d[i] = {roots[i].real(), roots[i].imag()};
    return d;
  }
  /// omega - omega_s, rad/s.
  Scalar excess(const Vec3<Scalar>& d, Scalar xi) const noexcept { return unit * xi - rate_of_tilt * n.dot(d); }
};

namespace detail {

/// exp z - 1.
template <Real Scalar>
math::Complex<Scalar> expm1(math::Complex<Scalar> z) noexcept {
  const Scalar grown = std::expm1(z.re), s = std::sin(z.im / 2);
  return {grown * std::cos(z.im) - 2 * s * s, (grown + 1) * std::sin(z.im)};
}

/// Integral of exp(d s) over s in [0, t].
template <Real Scalar>
math::Complex<Scalar> integral_of_exp(math::Complex<Scalar> d, Scalar t) noexcept {
  const math::Complex<Scalar> z = t * d;
  return z == math::Complex<Scalar>{} ? math::Complex<Scalar>{t} : t * (expm1(z) * math::inverse(z));
}

/// (exp(a t) - exp(b t))/(a - b), for a = b too.
template <Real Scalar>
math::Complex<Scalar> exp_difference(math::Complex<Scalar> a, math::Complex<Scalar> b, Scalar t) noexcept {
  if (a.re < b.re) std::swap(a, b);
  return math::exponential(t * a) * integral_of_exp(b - a, t);
}

template <Real Scalar>
using Complex3 = std::array<math::Complex<Scalar>, 3>;

/// Without conjugation.
template <Real Scalar>
math::Complex<Scalar> complex_dot(const Complex3<Scalar>& a, const Complex3<Scalar>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <Real Scalar>
math::Complex<Scalar> complex_dot(const Vec3<Scalar>& a, const Complex3<Scalar>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <Real Scalar>
Complex3<Scalar> complex_cross(const Complex3<Scalar>& a, const Complex3<Scalar>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <Real Scalar>
Scalar complex_length(const Complex3<Scalar>& a) noexcept {
  return std::hypot(math::magnitude(a[0]), math::magnitude(a[1]), math::magnitude(a[2]));
}
template <Real Scalar>
Complex3<Scalar> complex_scaled(math::Complex<Scalar> c, const Complex3<Scalar>& a) noexcept {
  return {c * a[0], c * a[1], c * a[2]};
}
/// Adds the real part of c a to the sum.
template <Real Scalar>
void add_real(Vec3<Scalar>& sum, math::Complex<Scalar> c, const Complex3<Scalar>& a) noexcept {
  for (int i = 0; i < 3; ++i) sum[i] += (c * a[std::size_t(i)]).re;
}

}  // namespace detail

/// dy/dt = A y in three unknowns: y = sum_i right_i exp(exponent_i t) (left_i y0). Near a double exponent right and left grow
/// like one over the distance; what that costs is reported by condition().
template <Real Scalar>
struct Modes {
  using Complex = math::Complex<Scalar>;
  using Vector = detail::Complex3<Scalar>;
  std::array<Complex, 3> exponent;  ///< 1/s
  std::array<Vector, 3> right;      ///< of unit length
  std::array<Vector, 3> left;       ///< left_i right_j = 1 for i = j, else 0; no conjugation

  /// exponents: the eigenvalues of A, to rounding.
  Modes(const Mat3<Scalar>& A, const std::array<Complex, 3>& exponents) noexcept : exponent(exponents) {
    for (std::size_t i = 0; i < 3; ++i) {
      // normal to the rows of A - d
      std::array<Vector, 3> rows;
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) rows[k][j] = Complex{A(int(k), int(j))};
        rows[k][k] = rows[k][k] - exponent[i];
        const Scalar size = detail::complex_length<Scalar>(rows[k]);
        if (size > 0) rows[k] = detail::complex_scaled<Scalar>(Complex{1 / size}, rows[k]);
      }
      Scalar most = -1;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector normal = detail::complex_cross<Scalar>(rows[k], rows[(k + 1) % 3]);
        const Scalar size = detail::complex_length<Scalar>(normal);
        if (size > most) {
          most = size;
          right[i] = detail::complex_scaled<Scalar>(Complex{1 / size}, normal);
        }
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector normal = detail::complex_cross<Scalar>(right[(i + 1) % 3], right[(i + 2) % 3]);
      left[i] = detail::complex_scaled<Scalar>(math::inverse(detail::complex_dot<Scalar>(normal, right[i])), normal);
    }
  }

  /// Greatest |left|: at least 1; rounding is amplified as much. Infinite or NaN where there are not three eigenvectors.
  Scalar condition() const noexcept {
    Scalar most = 0;
    for (const Vector& l : left) {
      const Scalar here = detail::complex_length<Scalar>(l);
      most = here <= most ? most : here;
    }
    return most;
  }
  /// Of the mode that decays most slowly or grows fastest, 1/s.
  Scalar growth_rate() const noexcept { return std::max({exponent[0].re, exponent[1].re, exponent[2].re}); }

  Vec3<Scalar> at(Scalar t, const Vec3<Scalar>& y0) const noexcept {
    Vec3<Scalar> y(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i)
      detail::add_real<Scalar>(y, math::exponential(t * exponent[i]) * detail::complex_dot<Scalar>(y0, left[i]),
                               right[i]);
    return y;
  }
  /// Integral of y over [0, t].
  Vec3<Scalar> integral(Scalar t, const Vec3<Scalar>& y0) const noexcept {
    Vec3<Scalar> y(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i)
      detail::add_real<Scalar>(y, detail::integral_of_exp(exponent[i], t) * detail::complex_dot<Scalar>(y0, left[i]),
                               right[i]);
    return y;
  }
};

}  // namespace gyrostat::rotor
