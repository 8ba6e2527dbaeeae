// SPDX-License-Identifier: BSD-3-Clause
// The equations of motion as they stand (docs/heavy.md, section 2), attitude included, by a Runge-Kutta method.
#pragma once

#include <array>
#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::heavy {

inline State<double> direct_motion(const Problem<double>& problem, const State<double>& start, double t,
                                   double tolerance = 1e-13) {
  using Numbers = std::array<double, 10>;
  const auto rate = [&problem](double, const Numbers& y, Numbers& dy) noexcept {
    const Vec3<double> w(y[0], y[1], y[2]), d(y[3], y[4], y[5]);
    const Vec3<double> spun = problem.torque(w, d).cwiseQuotient(problem.inertia()), turned = d.cross(w);
    const Quat<double> q = Quat<double>{y[6], y[7], y[8], y[9]} * Quat<double>{0, w[0] / 2, w[1] / 2, w[2] / 2};
    dy = {spun[0], spun[1], spun[2], turned[0], turned[1], turned[2], q.w, q.x, q.y, q.z};
  };
  const auto &w = start.angular_velocity, &d = start.down;
  const auto& q = start.attitude;
  ode::RungeKutta solver(rate, 0.0, Numbers{w[0], w[1], w[2], d[0], d[1], d[2], q.w, q.x, q.y, q.z},
                         ode::StepControl<double, 10>{.relative = tolerance});
  REQUIRE(solver.advance(t) == ode::Status::reached);
  const Numbers y = solver.state();
  return {{y[0], y[1], y[2]}, {y[3], y[4], y[5]}, normalised(Quat<double>{y[6], y[7], y[8], y[9]})};
}

/// Rotation angle between two attitudes, rad.
template <Real A, Real B>
double attitude_gap(const Quat<A>& a, const Quat<B>& b) {
  const auto cast = [](const auto& q) { return Quat<double>{double(q.w), double(q.x), double(q.y), double(q.z)}; };
  const Quat<double> gap = conjugate(cast(a)) * cast(b);
  return 2 * std::asin(std::fmin(1, std::sqrt(gap.x * gap.x + gap.y * gap.y + gap.z * gap.z)));
}

}  // namespace gyrostat::heavy
