// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/regular_precession.hpp"
#include "gyrostat/models/heavy/scaled.hpp"
#include "gyrostat/models/heavy/series.hpp"

/// The start of the forced motion of a fast spin: where it is known, and how far a given start is from it.
namespace gyrostat::heavy {

/// Spin and inclination of the forced motion that a scene asks for, or that its start would belong to.
inline Periodic forced_start(const Scene& scene) noexcept {
  if (scene.periodic()) return *scene.periodic();
  return {scene.start().angular_velocity[2], scene.start().down[2]};
}

/// How far a start is from that of the forced motion with the same r and d3: the change of rates over |r|, and of down.
inline double departure(const State<double>& start, const State<double>& forced) noexcept {
  return std::hypot((start.angular_velocity - forced.angular_velocity).norm() / std::abs(start.angular_velocity[2]),
                    (start.down - forced.down).norm());
}

/// What such a departure becomes up to t: a free nutation beside the forced motion, and what it does to the phases. Infinite where the
/// forced motion may be unstable, and where the departure is not small.
inline MotionError<double> departed(const Scaled<double>& s, double departure, double t) noexcept {
  if (departure == 0) return {};
  constexpr double open = infinity<double>;
  const Floquet<double> floquet(s);
  if (floquet.verdict != FastStability::stable) return {open, open, pi<double>};
  const FirstOrder<double> first(s);
  const double omega = std::sqrt(s.nutation_squared()), aspect = std::abs(omega / s.A1);
  const double wide = std::max(aspect, 1 / aspect), nutation = 8 * departure * wide * (1 + s.a + s.b);
  const double forced = std::hypot(first.chi, first.kap) + std::hypot(first.X, first.Y) + s.torque();
  const double angle = std::abs(s.spin * t), grown = nutation * (1 + 4 * (forced + nutation) * wide * angle);
  if (!(grown < 0.1)) return {open, open, pi<double>};
  return {std::abs(s.spin) * grown, grown, std::min(grown / (s.M3 * (1 - omega)), pi<double>)};
}

/// The start of a fast periodic motion where it is known in closed form: spin about a horizontal or weightless axis 3 that no torque
/// turns away, slow regular precession of a body symmetric about axis 3. Attitude: psi = 0. not_applicable where it is not known.
inline Result<State<double>> plain_start(const Problem<double>& problem, const Periodic& asked) noexcept {
  const auto scaled = Scaled<double>::make(problem, asked.spin, asked.cos_inclination);
  if (!scaled) return scaled.error();
  State<double> start;
  start.angular_velocity = {0, 0, asked.spin};
  start.down = {scaled->M3, 0, scaled->G0};
  start.attitude = attitude_from_angles<double>(0, pi<double> / 2, start.down);
  const Vec3<double> torque = problem.torque(start.angular_velocity, start.down);
  const bool idle = torque.isZero(0);
  // down stays in the plane of axes 1, 2, and no torque leaves axis 3
  const bool flat = asked.cos_inclination == 0 && problem.moment()[2] == 0;
  if (idle && problem.moment().isZero(0) && problem.gradient() == 0) return start;
  if (flat) return start;
  const auto top = SymmetricTop<double>::of(problem);
  if (!top || top->axes(2, 2) != 1 || problem.inertia()[0] != problem.inertia()[1]) return Errc::not_applicable;
  const auto precession = regular_precession(*top, scaled->G0, asked.spin);
  if (!precession.exists) return Errc::no_convergence;
  start.angular_velocity = precessing_velocity(start.down, asked.spin, precession.slow);
  return start;
}

}  // namespace gyrostat::heavy
