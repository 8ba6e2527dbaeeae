// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/heavy/exact_periodicity.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/balance.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE Periodicity periodicity_of(const Scene& scene, const State<double>& start,
                                                  const Exact<double>& exact) {
  const auto& [spin, cosine] = *scene.periodic();
  const auto s = *Scaled<double>::make(scene.problem(), spin, cosine);
  constexpr double rounding = 64 * epsilon<double>;
  Periodicity known;
  if (const auto* pendulum = exact.pendulum()) {
    // with the gradient alone half a round repeats the rates, not down
    known.period = pendulum->period() * (scene.problem().moment().isZero(0) ? 2 : 1);
    known.period_error = rounding + exact.error(known.period).attitude;
    known.precession = known.precession_error = 0;
    return known;
  }
  const auto top = SymmetricTop<double>::of(scene.problem());
  if (!exact.euler() && !(top && top->axes(2, 2) == 1)) return known;
  // regular precession, or none
  known.precession = start.angular_velocity[0] / s.M3;
  known.precession_error = rounding * std::abs(known.precession);
  const double turning = start.angular_velocity[2] - known.precession * cosine;
  known.period = 2 * pi<double> / std::abs(turning);
  known.period_error = rounding * (1 + std::abs(known.precession * cosine / turning));
  // the square of the angle that a small nutation turns through in the period
  constexpr double full = 2 * pi<double>;
  double square = full * full * s.nutation_squared(), terms = std::abs(square);
  if (!exact.euler()) {
    const TopStart<double> from(*top, aligned(start).value());
    const double turned = from.unit * known.period;
    square = turned * turned * from.nutation_square(), terms = turned * turned * from.nutation_terms();
  }
  const double angle = std::sqrt(std::abs(square));
  known.trace = square < 0 ? 2 * std::cosh(angle) : 2 * std::cos(angle);
  known.trace_error = (rounding * terms + 2 * known.period_error * std::abs(square)) *
                          (square < 0 ? std::sinh(angle) / angle : 1 / std::max(1.0, angle)) +
                      rounding;
  return known;
}

GYROSTAT_COMPILED_ONCE Periodicity periodicity_from(const Problem<double>& problem, const State<double>& start) {
  const Exact<double> exact(problem, start);
  Periodicity known;
  const auto repeats = [&](double period) {
    known.period = period;
    known.period_error = exact.error(period).attitude;
  };
  if (const auto* pendulum = exact.pendulum()) {
    if (pendulum->motion() == PendulumMotion::separatrix) return known;
    const bool rests = pendulum->motion() == PendulumMotion::rest;
    if (rests && growth_rate<double>(problem, {0, 0, 0}, start.down) > 0) return known;  // it stands
    // at rest under the gradient alone the plane of the swing that does not come would be that of a rounding
    if (rests && problem.moment().isZero(0)) return known;
    // with the gradient alone half a round repeats the rates, not down
    const bool half = pendulum->motion() == PendulumMotion::rotation && problem.moment().isZero(0);
    repeats(pendulum->period() * (half ? 2 : 1));
    known.precession = known.precession_error = 0;
    return known;
  }
  const auto of_top = [&](const auto& top) {
    const double nutation = top.nutation_period(), wide = top.greatest() - top.least();
    const auto axes = SymmetricTop<double>::of(problem)->axes;
    const Vec3<double> down = axes.transpose() * start.down;
    const double sine = std::hypot(down[0], down[1]);
    // an axis that stays upright has no precession
    if (!(nutation < infinity<double>) || (wide <= 1e-12 && sine < 1e-6)) return;
    // an inclination is told by its sine where the axis is nearly upright
    const double nods = wide / sine;
    const bool still = wide <= 1e-12 && nods <= 1e-9;
    known.precession = top.mean_precession();
    known.precession_error = exact.error(nutation).attitude / nutation;
    if (still) {
      const double turning = axes.col(2).dot(start.angular_velocity) - known.precession * down[2];
      if (turning != 0) repeats(2 * pi<double> / std::abs(turning));
      known.period_error += nods;
    } else if (top.planar()) {
      // down passes one of the poles where the top swings through it, none or both else
      constexpr double near = 1e-12;
      const bool one = (1 + top.least() < near) != (1 - top.greatest() < near);
      repeats(nutation * (one ? 2 : 1));
      known.precession_error = top.in_plane() ? 0 : infinity<double>;
    } else {
      known.sides = top.sides();
      // whether down passes on this side of a pole or on the other hangs on the last digits
      for (const double side : known.sides)
        if (side != 0 && std::abs(side) <= 2 * conversion) known.precession_error = infinity<double>;
    }
  };
  if (const auto* top = exact.top()) of_top(*top);
  if (const auto* top = exact.top_in_gradient()) of_top(*top);
  return known;
}

GYROSTAT_COMPILED_ONCE Periodicity periodicity_from(const Scene& scene) {
  const Problem<double>& problem = scene.problem();
  Periodicity known = periodicity_from(problem, scene.start());
  if (!scene.converts_start() || (std::isnan(known.period) && std::isnan(known.precession))) return known;
  const Exact<double> exact(problem, scene.start());
  const int plane = exact.pendulum() ? exact.pendulum()->axis() : -1;
  constexpr double margin = honesty::neighbours_margin;
  for (const int which : {0, 1}) {
    const Problem<double> body = scene.converts_body() ? off_body(problem, which) : problem;
    const auto off = periodicity_from(body, off_start(scene.start(), which, plane));
    if (std::isnan(off.precession)) known.precession = nan<double>;
    if (off.precession_error == infinity<double>) known.precession_error = infinity<double>;
    known.precession_error += margin * std::abs(off.precession - known.precession);
    // a top whose inclination is steady nods a little in a start that is off
    if (!std::isnan(off.period)) known.period_error += margin * std::abs(off.period / known.period - 1);
    // a side that is open leaves the turn open, and how long the axis lingers there; a body that is symmetric but for rounding trades so much of the
    // momentum along its axis
    const double traded = scene.converts_body() ? conversion : 0;
    for (std::size_t pole : {0u, 1u})
      if (std::abs(known.sides[pole]) <= margin * std::max(traded, std::abs(off.sides[pole] - known.sides[pole])))
        known.precession_error = infinity<double>;
  }
  return known;
}

}  // namespace gyrostat::heavy
