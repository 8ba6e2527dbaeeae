// SPDX-License-Identifier: BSD-3-Clause
// The motion of a general problem from the equations as they are written, in long double by a Runge-Kutta method: another integrator,
// another form of the equations, another precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

namespace general_truth {

using namespace gyrostat;
using namespace gyrostat::general;

template <Real To, Real From>
Vec3<To> cast(const Vec3<From>& v) {
  return v.template cast<To>();
}

template <Real To, Real From>
Table<To> cast(const Table<From>& t) {
  return {{t.times.begin(), t.times.end()}, {t.values.begin(), t.values.end()}, t.between, t.holds};
}

template <Real To, Real From>
Factor<To> cast(const Factor<From>& f) {
  Factor<To> made;
  for (const auto& [from, to] : f.on) made.on.push_back({To(from), To(to)});
  made.table = cast<To>(f.table);
  made.mean = To(f.mean), made.amplitude = To(f.amplitude), made.rate = To(f.rate), made.phase = To(f.phase);
  return made;
}

template <Real To, Real From>
Problem<To> cast(const Problem<From>& p) {
  Problem<To> made;
  made.inertia = p.inertia.template cast<To>();
  made.mass = To(p.mass), made.centre_of_mass = cast<To>(p.centre_of_mass), made.fixed = p.fixed;
  made.rotor_momentum = cast<To>(p.rotor_momentum);
  for (const auto& w : p.wheels)
    made.wheels.push_back({w.type, cast<To>(w.axis), To(w.axial_inertia), To(w.rate), To(w.angle), To(w.torque),
                           To(w.friction), To(w.slope), To(w.no_load_rate), cast<To>(w.table)});
  for (const auto& t : p.torques) {
    auto& mine = made.torques.emplace_back();
    mine.type = t.type, mine.axes = t.axes, mine.opposed = t.opposed;
    mine.vector = cast<To>(t.vector), mine.point = cast<To>(t.point);
    mine.matrix = t.matrix.template cast<To>();
    if (t.gradient) mine.gradient = To(*t.gradient);
    mine.table = cast<To>(t.table), mine.factor = cast<To>(t.factor);
  }
  if (p.orbit)
    made.orbit = {To(p.orbit->radius),       To(p.orbit->mu),           To(p.orbit->eccentricity),
                  To(p.orbit->true_anomaly), cast<To>(p.orbit->radial), cast<To>(p.orbit->along)};
  const auto& f = p.field;
  made.field = {To(f.gravity),    cast<To>(f.down), f.magnetic,     cast<To>(f.flux_density),
                cast<To>(f.axis), To(f.rate),       To(f.strength), To(f.radius)};
  const auto& q = p.attitude;
  made.attitude = {To(q.w), To(q.x), To(q.y), To(q.z)};
  made.angular_velocity = cast<To>(p.angular_velocity);
  made.velocity = cast<To>(p.velocity), made.position = cast<To>(p.position);
  return made;
}

template <Real To, Real From>
State<To> cast(const State<From>& s) {
  State<To> made;
  const auto& q = s.attitude;
  made.attitude = {To(q.w), To(q.x), To(q.y), To(q.z)};
  made.angular_velocity = cast<To>(s.angular_velocity), made.angular_momentum = cast<To>(s.angular_momentum);
  for (std::size_t i = 0; i < most_wheels; ++i) {
    made.rotor_rate[i] = To(s.rotor_rate[i]);
    made.rotor_angle[i] = To(s.rotor_angle[i]);
  }
  made.velocity = cast<To>(s.velocity), made.position = cast<To>(s.position);
  made.work = To(s.work), made.impulse = cast<To>(s.impulse);
  return made;
}

/// The kinetic energy of body and wheels that turn by themselves, less that of wheels whose p stays, J.
template <Real S>
S energy_that_changes(const Wheels<S>& wheels, const State<S>& s) {
  S sum = s.angular_velocity.dot(wheels.reduced * s.angular_velocity) / 2;
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    const S p = law.axial_inertia * (s.rotor_rate[i] + law.axis.dot(s.angular_velocity));
    if (law.follows >= Follows::integral) sum += p * p / (2 * law.axial_inertia);
  }
  return sum;
}

/// The equations as they are written, and a torque beside those of the problem; of the times from `from` up to, but not at, `to`.
template <Real S, class Law>
struct Driven {
  Flow<S> flow;
  const Law& law;
  S from = 0, to = 0;

  void operator()(S t, const typename Flow<S>::Numbers& y, typename Flow<S>::Numbers& rate) const noexcept {
    flow(t, y, rate);
    if constexpr (!std::is_same_v<Law, NoTorque>) {
      const State<S> s = flow.state(t, y);
      const Vec3<S> torque = law(std::clamp(t, from, std::nextafter(to, from)),
                                 Seen<S>{{s.attitude, s.angular_velocity, s.angular_momentum}, s.rotor_rate});
      for (std::size_t i = 0; i < 3; ++i) rate[Flow<S>::momentum + i] += torque[int(i)];
    }
  }
};

/// The motion at the times (increasing, from 0) under the torques of a problem and a law that changes at `named`; empty where it cannot be
/// followed.
template <Real S, class Law = NoTorque>
std::vector<State<S>> motion(const Problem<S>& problem, const std::vector<S>& times, S tolerance,
                             std::uint64_t step_cap = 1'000'000, const Law& law = {},
                             const std::vector<double>& named = {}) {
  const auto wheels = Wheels<S>::of(problem);
  auto cuts = breakpoints(problem, times.back());
  for (const double cut : named)
    if (cut > 0 && S(cut) < times.back()) cuts.push_back(S(cut));
  std::vector<S> stops(times);
  stops.insert(stops.end(), cuts.begin(), cuts.end());
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  Flow<S> flow(problem, wheels);
  auto y = flow.start();
  const State<S> start = flow.state(0, y);
  const S M0 = start.angular_momentum.norm() + wheels.momentum_of_wheels().norm();
  std::vector<State<S>> made;
  std::size_t next = 0;
  S t = 0;
  const auto put = [&] {
    for (; next < times.size() && times[next] <= t; ++next) {
      auto& state = made.emplace_back(flow.state(t, y));
      state.work = energy_that_changes(wheels, state) - energy_that_changes(wheels, start);
      state.impulse =
          rotate<S>(state.attitude, state.angular_momentum) - rotate<S>(start.attitude, start.angular_momentum);
    }
  };
  put();
  for (const S stop : stops) {
    if (!(stop > t)) continue;
    ode::StepControl<S, Flow<S>::width> control;
    control.relative = tolerance, control.step_cap = step_cap;
    for (std::size_t i = 0; i < Flow<S>::width; ++i)
      control.absolute[i] = tolerance * (i < 4 ? S(1) : M0 * S(1e-2L) + S(1e-30L));
    ode::RungeKutta<S, Flow<S>::width, Driven<S, Law>> solver({flow, law, t, stop}, t, y, control);
    if (solver.advance(stop) != ode::Status::reached) return {};
    y = solver.state(), t = stop;
    flow.inside = t;
    put();
  }
  return made;
}

}  // namespace general_truth
