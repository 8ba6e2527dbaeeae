// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/deceleration/orbit_kind.hpp"

namespace gyrostat::deceleration {

namespace detail {

/// Of a steady rotation: on a separatrix where it is unstable, since the energy has a saddle there on the sphere of |M|.
inline OrbitKind kind_at_rest(const Problem<double>& problem, const Vec3<double>& M) noexcept {
  const Vec3<double> m = M.normalized(), t = m.unitOrthogonal(), u = m.cross(t), a = problem.inverse_inertia;
  const double rate = m.dot(problem.angular_velocity(M)) / M.norm();
  const double tt = t.dot(a.cwiseProduct(t)) - rate, uu = u.dot(a.cwiseProduct(u)) - rate,
               tu = t.dot(a.cwiseProduct(u));
  return tt * uu < tu * tu ? OrbitKind{Regime::separatrix, 1} : OrbitKind{Regime::point, 0};
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE OrbitKind orbit_kind(const Problem<double>& problem, const Vec3<double>& M) noexcept {
  if (M.isZero(0) || M == problem.rotor_momentum) return {};
  if (problem.rotor_momentum.isZero(0)) {
    const auto p = polhode_through<double>(problem.inverse_inertia, problem.inverse_gaps(), M);
    if (!std::isfinite(p.modulus.k2)) return {Regime::point, 0};
    if (!(p.modulus.kp2 > 0)) return {Regime::separatrix, 1};
    return {p.regime, p.modulus.k2};
  }
  if (rests_in_body(problem, M)) return detail::kind_at_rest(problem, M);
  const auto orbit = Orbit<double>::through(problem, M);
  if (orbit) return {orbit->regime(), orbit->modulus().k2};
  return orbit.error() == Errc::separatrix ? OrbitKind{Regime::separatrix, 1} : OrbitKind{Regime::point, 0};
}

GYROSTAT_COMPILED_ONCE double k2_of_data(const Problem<double>& problem, const Polhode<double>& p,
                                         const Vec3<double>& M) noexcept {
  const auto& x = p.axes;
  const Vec3<double> error = problem.gap_errors();
  const double near_mid = error[x.near / 2], mid_far = error[1 - x.near / 2];
  double k2 = p.tilt / p.along / x.near_mid * (mid_far + x.mid_far * near_mid / x.near_mid);
  if (!problem.exact_moments) {
    // a tensor that is off by the rounding of its greatest element turns the axes, too: what that does to 2H/M^2
    const double ratio = problem.energy_error(M) / M.squaredNorm();
    k2 += x.mid_far / x.near_mid * ratio / x.near_far / (p.along * p.along);
  }
  return k2 < 1 ? k2 + 8 * epsilon<double> : 1.0;
}

GYROSTAT_COMPILED_ONCE double k2_of_level(const Problem<double>& problem, const Level<double>& level,
                                          const OrbitKind& at, double R, double eta) noexcept {
  double most = 0;
  for (const auto& moved : {Level<double>{level.R + R, level.eta}, Level<double>{level.R, level.eta + eta},
                            Level<double>{level.R, level.eta - eta}}) {
    const auto orbit = Orbit<double>::at(problem, moved, {at.regime, 1});
    most += orbit ? std::abs(orbit->modulus().k2 - at.k2) : orbit.error() == Errc::separatrix ? 1 - at.k2 : 1.0;
  }
  return std::min(1.0, most);
}

/// How far from 0 the modulus of a body of revolution may be where roundings part its moments and tilt its rotor: split nu/turning^2 on two
/// components, the square of a quarter of it on one, with the roots of the quadratic that the quartic then is nu apart.
inline double k2_of_roundness(const Problem<double>& problem, const Revolution<double>& about,
                              const Vec3<double>& M) noexcept {
  const double R = M.norm(), n = M[about.axis] / R, g = problem.gyro_rate()[about.axis];
  const double far = problem.inverse_inertia[about.axis] - about.across, turning = R * n * far - g;
  const double tilted = about.oblique / turning;
  const double split = R * (about.parted + tilted * tilted * std::abs(far));
  const double lean = R * (1 - n * n) * far + 2 * g * n;
  const double disc = lean * lean - 4 * g * g;
  const double k2 = split / turning * std::sqrt(std::abs(disc)) / std::abs(turning);
  return disc > 0 ? std::abs(k2) : k2 * k2 / 16;
}

GYROSTAT_COMPILED_ONCE double k2_uncertainty(const Problem<double>& problem, const Vec3<double>& M, const OrbitKind& at,
                                             double norm, double energy, double place) noexcept {
  if (at.regime == Regime::rest) return 0;
  const auto& a = problem.inverse_inertia;
  // without rotors a point is a sphere: one to rounding alone has orbits, of which nobody knows
  if (at.regime == Regime::point && problem.rotor_momentum.isZero(0))
    return problem.exact_moments ? 4 * epsilon<double> : 1.0;
  if (at.regime == Regime::point && a[2] - a[0] <= 8 * epsilon<double> * a[2]) return 4 * epsilon<double>;
  const double R = M.norm();
  norm = std::max(norm, 2 * epsilon<double> * R);
  if (problem.rotor_momentum.isZero(0)) {
    const auto p = polhode_through<double>(problem.inverse_inertia, problem.inverse_gaps(), M);
    const double ratio = std::min((2 * energy / R + 2 * p.energy_ratio() * norm) / R,  // of 2H/M^2
                                  place + 8 * epsilon<double> * orbit_place(problem, M));
    const double tilt = ratio / p.axes.near_far;
    const double slope = p.axes.mid_far / (p.axes.near_mid * (1 - p.tilt) * (1 - p.tilt));
    const double k2 = slope * tilt + k2_of_data(problem, p, M);
    return k2 < 1 ? k2 : 1.0;
  }
  const auto level = level_of(problem, M);
  const double size = std::abs(level.eta) + problem.angular_velocity(M).norm();
  const double eta = std::min((energy + size * norm) / R, place + 8 * epsilon<double> * size);
  double most = 4 * epsilon<double> + k2_of_level(problem, level, at, norm, eta);
  if (const auto about = revolution(problem); about.axis >= 0) {
    const double k2 = most + k2_of_roundness(problem, about, M);
    return k2 < 1 ? k2 : 1.0;
  }
  // rounding of the moments, which the orbit takes differences of
  for (const double change : {4 * epsilon<double>, -4 * epsilon<double>}) {
    Problem<double> off = problem;
    off.inverse_inertia[1] *= 1 + change;
    if (!problem.exact_moments) {
      const double more = change * problem.inverse_inertia[1];
      off.gaps = problem.inverse_gaps() + Vec3<double>(more, -more, 0);
    }
    const OrbitKind moved = orbit_kind(off, M);
    most += std::abs(moved.k2 - at.k2);
  }
  return std::min(1.0, most);
}

}  // namespace gyrostat::deceleration
