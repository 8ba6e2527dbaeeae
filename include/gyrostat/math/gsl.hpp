// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/elliptic.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::math {

/// Elliptic integrals and functions by the GNU Scientific Library, double only: Carlson's forms fed the complement, and
/// gsl_sf_elljac_e. The domain is checked before every call, because GSL's default error handler ends the program; what
/// GSL does not cover comes back as NaN. Link gyrostat::gsl (GSL is GPL). The only header that includes GSL.
struct Gsl {
  /// As the native one; NaN below 1e-306 but for 0, where R_F ends.
  static Complete<double> complete(Modulus<double> m) noexcept {
    const Means<double> mean = means(m);
    if (m.kp2 == 0) return {mean.K, mean.F + 1};
    return {mean.K, mean.K * mean.F};
  }

  /// W = k2 R_D(0, kp2, 1)/(3 R_F(0, kp2, 1)) and V = k2 kp2 R_D(0, 1, kp2)/(3 R_F) where k2 <= kp2; elsewhere these of
  /// the complement and Legendre's relation F = W' + pi/(2 K K'), because R_D ends at arguments below 1e-205.
  static Means<double> means(Modulus<double> m) noexcept {
    if (!m.legal()) return {nan<double>, nan<double>, nan<double>, nan<double>};
    if (m.kp2 == 0) return {infinity<double>, 0, 1, 0};
    const bool small = m.k2 <= m.kp2;
    const Modulus<double> n = small ? m : m.complement();
    const double quarter = rf(0, n.kp2, 1);
    const double w = n.k2 * rd(0, n.kp2, 1) / (3 * quarter);
    const double v = n.k2 * n.kp2 * rd(0, 1, n.kp2) / (3 * quarter);
    if (small) return {quarter, 1 - w, w, v};
    const double K = rf(0, m.kp2, 1);
    const double legendre = pi<double> / (2 * K * quarter);
    const double F = w + legendre;
    return {K, F, 1 - F, legendre - v};
  }

  /// gsl_sf_elljac_e of the argument brought within half a quarter period, and the shift by quarter periods with k'. It
  /// takes k2 alone: where kp2 is near or below eps, cn and dn are good to some eps / sqrt(kp2) only.
  static Jacobi<double> jacobi(double u, Modulus<double> m) noexcept {
    const Jacobi<double> wrong{nan<double>, nan<double>, nan<double>, nan<double>};
    if (!m.legal() || !std::isfinite(u)) return wrong;
    const auto [n, r] = reduce(u, complete(m).K);
    Jacobi<double> f;
    if (!std::isfinite(r) || gsl_sf_elljac_e(r, m.k2, &f.sn, &f.cn, &f.dn) != GSL_SUCCESS) return wrong;
    if (odd(n)) {
      const double kp = std::sqrt(m.kp2);
      f = {f.cn / f.dn, -kp * f.sn / f.dn, kp / f.dn, 0};
    }
    f.am = n * (pi<double> / 2) + (odd(n) ? std::atan2(-f.cn, f.sn) : std::atan2(f.sn, f.cn));
    if (n - 4 * std::floor(n / 4) >= 2) {
      f.sn = -f.sn;
      f.cn = -f.cn;
    }
    return f;
  }

  /// E(am u) = u - k2 sn^3 R_D(cn^2, dn^2, 1)/3, hence zeta = W u - k2 sn^3 R_D/3, within half a quarter period, and
  /// zeta(u + K) = zeta(u) - k2 sn cd. A difference: absolute accuracy only, some eps of W K.
  static double zeta(double u, Modulus<double> m) noexcept {
    if (!m.legal() || !std::isfinite(u)) return nan<double>;
    const Means<double> mean = means(m);
    const auto [n, r] = reduce(u, mean.K);
    const Jacobi<double> f = jacobi(r, m);
    const double s2 = f.sn * f.sn;
    const double c2 = f.cn * f.cn;
    const double near = mean.W * r - m.k2 * f.sn * s2 * rd(c2, c2 + m.kp2 * s2, 1) / 3;
    return odd(n) ? near - m.k2 * f.sn * f.cn / f.dn : near;
  }

  static double incomplete_F(double phi, Modulus<double> m) noexcept {
    if (!m.legal()) return nan<double>;
    const auto at = detail::Amplitude<double>::of(phi, m);
    const double part = at.s * rf(at.c2, at.delta2, 1);
    return at.n == 0 ? part : 2 * at.n * complete(m).K + part;
  }

  static double incomplete_E(double phi, Modulus<double> m) noexcept {
    if (!m.legal()) return nan<double>;
    const auto at = detail::Amplitude<double>::of(phi, m);
    double part = at.s;
    if (m.kp2 > 0) {
      part = at.s * (m.kp2 * (rf(at.c2, at.delta2, 1) + m.k2 * (at.s * at.s) / 3 * rd(at.c2, 1, at.delta2)) +
                     m.k2 * at.c / std::sqrt(at.delta2));
    }
    return at.n == 0 ? part : 2 * at.n * complete(m).E + part;
  }

  /// As the native one, n sin^2 phi < 1 on the way; a sum of two terms of opposite sign for n < 0.
  static double incomplete_Pi(double phi, double n, Modulus<double> m) noexcept {
    if (!m.legal()) return nan<double>;
    const auto at = detail::Amplitude<double>::of(phi, m);
    const auto part = [&](double s, double c2, double delta2) {
      const double s2 = s * s;
      return s * (rf(c2, delta2, 1) + n * s2 / 3 * rj(c2, delta2, 1, c2 + (1 - n) * s2));
    };
    const double inside = part(at.s, at.c2, at.delta2);
    if (at.n == 0) return inside;
    if (n > 1) return nan<double>;
    return 2 * at.n * part(1, 0, m.kp2) + inside;
  }

 private:
  // GSL's own limits on Carlson's arguments (specfunc/ellint.c), a little inside
  static constexpr double least = 1e-306;     // R_F: the sum of any two
  static constexpr double least_rd = 1e-205;  // R_D: z, x + y
  static constexpr double least_rj = 1e-101;  // R_J: p, the sum of any two
  static constexpr double most = 1e98;

  struct Reduced {
    double n, r;  // u = n K + r, |r| <= K/2
  };

  static Reduced reduce(double u, double K) noexcept {
    const double n = std::nearbyint(u / K);
    return n == 0 ? Reduced{n, u} : Reduced{n, std::fma(-n, K, u)};
  }

  static bool odd(double n) noexcept { return n - 2 * std::floor(n / 2) == 1; }

  static double value(int status, const gsl_sf_result& result) noexcept {
    return status == GSL_SUCCESS ? result.val : nan<double>;
  }

  static double rf(double x, double y, double z) noexcept {
    if (!(x >= 0 && y >= 0 && z >= 0 && x + y > least && x + z > least && y + z > least && x + y + z < most))
      return (x == 0) + (y == 0) + (z == 0) > 1 ? infinity<double> : nan<double>;
    gsl_sf_result result;
    return value(gsl_sf_ellint_RF_e(x, y, z, GSL_PREC_DOUBLE, &result), result);
  }

  static double rd(double x, double y, double z) noexcept {
    if (!(x >= 0 && y >= 0 && x + y > least_rd && z > least_rd && x + y + z < most))
      return z == 0 || (x == 0 && y == 0) ? infinity<double> : nan<double>;
    gsl_sf_result result;
    return value(gsl_sf_ellint_RD_e(x, y, z, GSL_PREC_DOUBLE, &result), result);
  }

  static double rj(double x, double y, double z, double p) noexcept {
    if (!(x >= 0 && y >= 0 && z >= 0 && p > least_rj && x + y > least_rj && x + z > least_rj && y + z > least_rj &&
          x + y + z + p < most))
      return p == 0 ? infinity<double> : nan<double>;
    gsl_sf_result result;
    return value(gsl_sf_ellint_RJ_e(x, y, z, p, GSL_PREC_DOUBLE, &result), result);
  }
};

static_assert(EllipticBackend<Gsl, double>);

}  // namespace gyrostat::math
