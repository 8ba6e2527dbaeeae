// SPDX-License-Identifier: BSD-3-Clause
// The full equations in long double by DOP853: the truth of the tests, written apart from the library's own
// integration.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/rotation/kinematics.hpp"

namespace gyrostat::heavy {

template <Real To, Real From>
State<To> state_cast(const State<From>& s) {
  const auto& q = s.attitude;
  return {s.angular_velocity.template cast<To>(), s.down.template cast<To>(), {To(q.w), To(q.x), To(q.y), To(q.z)}};
}

template <Real To, Real From>
Problem<To> problem_cast(const Problem<From>& p) {
  const auto made = Problem<To>::make(p.inertia().template cast<To>(), To(p.mass()),
                                      p.centre_of_mass().template cast<To>(), To(p.gravity()), To(p.gradient()));
  REQUIRE(made);
  return *made;
}

/// A start at this angular velocity; down is that of the attitude.
inline State<double> start_at(const Vec3<double>& omega, const Quat<double>& attitude) {
  const Quat<double> q = normalised(attitude);
  return {omega, rotate<double>(conjugate(q), Vec3<double>(0, 0, -1)), q};
}

struct LongMotion {
  using Long = long double;
  struct Rate {
    const Problem<Long>* body;
    void operator()(Long, const std::array<Long, 10>& y, std::array<Long, 10>& dydt) const noexcept {
      const Vec3<Long> w(y[0], y[1], y[2]), d(y[3], y[4], y[5]);
      const Vec3<Long> dw = body->torque(w, d).cwiseQuotient(body->inertia()), dd = d.cross(w);
      const Quat<Long> dq = quaternion_rate<Long>({y[6], y[7], y[8], y[9]}, w);
      dydt = {dw[0], dw[1], dw[2], dd[0], dd[1], dd[2], dq.w, dq.x, dq.y, dq.z};
    }
  };

  /// At increasing times; down is that of the start, made unit.
  static std::vector<State<Long>> from(const Problem<double>& problem, const State<double>& start,
                                       const std::vector<double>& times, Long tolerance = 1e-18L) {
    const auto body = problem_cast<Long>(problem);
    const auto s = state_cast<Long>(start);
    const Quat<Long> q = normalised(s.attitude);
    const Vec3<Long> d = s.down.normalized();
    const auto& w = s.angular_velocity;
    const Long rate =
        w.norm() + std::sqrt(body.moment().norm() / body.inertia().minCoeff()) + std::sqrt(body.gradient());
    ode::StepControl<Long, 10> control;
    control.relative = tolerance;
    for (std::size_t i = 0; i < 10; ++i) control.absolute[i] = (i < 3 ? rate : 1) * tolerance;
    control.step_cap = 10'000'000;
    ode::RungeKutta<Long, 10, Rate> solver(Rate{&body}, 0, {w[0], w[1], w[2], d[0], d[1], d[2], q.w, q.x, q.y, q.z},
                                           control);
    std::vector<State<Long>> states;
    for (const double t : times) {
      solver.advance(Long(t));
      const auto& y = solver.state();
      states.push_back({{y[0], y[1], y[2]}, {y[3], y[4], y[5]}, normalised(Quat<Long>{y[6], y[7], y[8], y[9]})});
    }
    return states;
  }
};

/// Distance of two states: attitude (rad), down, angular velocity (rad/s).
struct Distance {
  double attitude = 0, down = 0, angular_velocity = 0;

  void see(const Distance& d) {
    attitude = std::max(attitude, d.attitude);
    down = std::max(down, d.down);
    angular_velocity = std::max(angular_velocity, d.angular_velocity);
  }
};

template <Real A, Real B>
Distance distance(const State<A>& a, const State<B>& b) {
  const auto p = state_cast<long double>(a), q = state_cast<long double>(b);
  return {double(angle_between(p.attitude, q.attitude)), double((p.down - q.down).norm()),
          double((p.angular_velocity - q.angular_velocity).norm())};
}

}  // namespace gyrostat::heavy
