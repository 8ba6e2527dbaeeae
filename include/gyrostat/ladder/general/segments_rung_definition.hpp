// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "gyrostat/ladder/general/scene_definition.hpp"
#include "gyrostat/ladder/general/segments_rung.hpp"

namespace gyrostat::general {

namespace detail {

/// A torque on a segment that holds `inside`; an empty one where it does not act, nothing where it is not steady there.
inline std::optional<std::optional<Torque<double>>> steady_torque(const Problem<double>& of,
                                                                  const Torque<double>& torque, double inside) {
  Factor<double> gate;
  gate.on = torque.factor.on;
  if (factor_at(gate, inside, inside) == 0) return std::optional<Torque<double>>{};
  double factor = torque.factor.mean;
  if (torque.factor.amplitude != 0) return std::nullopt;
  if (!torque.factor.table.times.empty()) {
    const auto value = steady_value(torque.factor.table, 1, 0, inside);
    if (!value) return std::nullopt;
    factor *= *value;
  }
  const bool orbits = torque.axes == Axes::orbit || (torque.type == TorqueType::gravity_gradient && !torque.gradient);
  const bool moves = (torque.type == TorqueType::magnetic || torque.type == TorqueType::eddy_current) &&
                     of.field.magnetic != MagneticField::uniform;
  if (orbits || moves || torque.type == TorqueType::brake) return std::nullopt;
  Torque<double> made = torque;
  made.factor = {};
  made.factor.mean = factor;
  if (torque.type == TorqueType::table) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = steady_value(torque.table, 3, i, inside);
      if (!value) return std::nullopt;
      made.vector[int(i)] = *value;
    }
    made.type = TorqueType::constant;
    made.table = {};
  }
  if (factor == 0 || (made.type == TorqueType::constant && made.vector.isZero(0)))
    return std::optional<Torque<double>>{};
  return std::optional(made);
}

/// Nothing where a law is not steady from the breakpoint `from` to the next.
inline std::optional<Problem<double>> steady_problem(const Problem<double>& of, double from) {
  Problem<double> made = of;
  made.torques.clear();
  for (const auto& torque : of.torques) {
    auto steady = steady_torque(of, torque, from);
    if (!steady) return std::nullopt;
    if (*steady) made.torques.push_back(std::move(**steady));
  }
  for (auto& wheel : made.wheels) {
    if (!wheel.table.times.empty() && !make_steady(wheel, from)) return std::nullopt;
  }
  return made;
}

GYROSTAT_COMPILED_ONCE std::vector<Segment> segments_of(const Problem<double>& problem, double span) {
  auto edges = breakpoints(problem, span);
  if (edges.empty() || edges.size() >= most_segments) return {};
  edges.insert(edges.begin(), 0.0);
  edges.push_back(span);
  std::vector<Segment> made;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    auto steady = steady_problem(problem, std::max(edges[i], least_breakpoint<double>));
    if (!steady) return {};
    made.push_back({edges[i], edges[i + 1], std::move(*steady)});
  }
  return made;
}

GYROSTAT_COMPILED_ONCE double begin_at(const State<double>& end, const Segment& before, Segment& next) noexcept {
  auto& problem = next.problem;
  problem.attitude = end.attitude;
  problem.angular_velocity = end.angular_velocity;
  if (!problem.fixed) problem.velocity = end.velocity, problem.position = end.position;
  bool stepped = false;
  for (std::size_t i = 0; i < problem.wheels.size(); ++i) {
    auto& wheel = problem.wheels[i];
    wheel.angle = end.rotor_angle[i];
    if (turns_by_itself(wheel)) wheel.rate = end.rotor_rate[i];
    else stepped = stepped || wheel.rate != before.problem.wheels[i].rate;
  }
  if (!stepped) return 0;
  const auto wheels = Wheels<double>::of(problem);
  problem.angular_velocity = wheels.inverse * (end.angular_momentum - wheels.momentum_of_wheels());
  for (std::size_t i = 0; i < problem.wheels.size(); ++i)
    if (auto& wheel = problem.wheels[i]; turns_by_itself(wheel))
      wheel.rate = wheels.laws[i].momentum / wheel.axial_inertia - wheel.axis.dot(problem.angular_velocity);
  return 4 * epsilon<double> * (end.angular_momentum.norm() + momenta_of_wheels(problem)) * wheels.inverse.norm();
}

GYROSTAT_COMPILED_ONCE std::vector<double> times_in(const Segment& segment, const std::vector<double>& asked,
                                                    std::size_t& next) {
  const double length = segment.to - segment.from;
  std::vector<double> made;
  for (; next < asked.size() && (asked[next] < segment.to || asked.back() == segment.to); ++next)
    if (const double t = asked[next] - segment.from; made.empty() || t > made.back()) made.push_back(t);
  if (made.empty() || made.back() < length) made.push_back(length);
  return made;
}

GYROSTAT_COMPILED_ONCE Question question_of(const Scene& scene, std::vector<double> times, double from,
                                            std::size_t segments) {
  Question made;
  made.times = std::move(times);
  const double ahead = scene.sizes().turning * (scene.question().times.back() - from);
  made.tolerance = std::clamp(scene.goal().tightest / double(2 * segments) / (1 + ahead), 1e-14, 0.5);
  for (const std::size_t place :
       {column::attitude, column::angular_velocity, column::angular_momentum, column::rotor_rate, column::rotor_angle})
    if (scene.has_column(place)) made.asked.push_back({place});
  if (scene.gives(column::velocity) || scene.gives(column::position))
    made.asked.push_back({column::velocity}), made.asked.push_back({column::position});
  return made;
}

/// Gives a body the rate at which it may turn behind torques of a motion, which its start need not have.
inline void set_turning(Problem<double>& problem, double rate) noexcept {
  Vec3<double>& w = problem.angular_velocity;
  const double own = w.norm();
  if (own < rate) w = own > 0 ? Vec3<double>(rate / own * w) : Vec3<double>(rate * Vec3<double>(0.48, 0.6, 0.64));
}

/// Whether equal-torque refuses what the segment is as a deceleration, which costs it nothing.
inline bool refuses_at_once(const Scene& segment, const Candidate& candidate) noexcept {
  const SpecialRung& asked = special_rungs[candidate.rung];
  if (asked.special != Special::deceleration || asked.rung != deceleration::rung::equal_torque) return false;
  const auto& braked = segment.instances().deceleration;
  return !braked->equal_control() || braked->has_rotor();
}

/// What rungs cost, in their order, up to the first that surely meets what is asked: a closed form that does not refuse, or the full equations of a family,
/// which torques may drive as far as those of all.
inline double cost_of_sure(const Scene& segment, const std::vector<Candidate>& candidates) noexcept {
  double sum = 0;
  for (const Candidate& candidate : candidates) {
    const bool full = candidate.rung >= std::size_t(rung::family_full);
    sum += full ? std::max(candidate.cost, cost_of_full(segment)) : candidate.cost;
    if (full || (candidate.rung < closed_forms && !refuses_at_once(segment, candidate))) break;
  }
  return sum;
}

GYROSTAT_COMPILED_ONCE double cost_of_one(const Scene& segment, const std::vector<Candidate>& candidates,
                                          bool displaced) noexcept {
  const double ways = 3 + (turns_along(segment.problem()) ? 0 : 3) + double(segment.wheels().count);
  return segment_cost.each + segment_cost.share * cost_of_sure(segment, candidates) * (1 + (displaced ? ways : 0));
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE double cost_of_segments(const Scene& scene) noexcept {
  if (!scene.is_recognised() || scene.breaks() == 0 || scene.breaks() >= most_segments) return nan<double>;
  const auto segments = detail::segments_of(scene.problem(), scene.question().times.back());
  double sum = segments.empty() ? nan<double> : 0;
  bool displaced = false;
  std::size_t next = 0;
  for (const Segment& segment : segments) {
    auto times = detail::times_in(segment, scene.question().times, next);
    auto problem = segment.problem;
    if (displaced) detail::set_turning(problem, scene.sizes().turning);
    const auto made = Scene::make(problem, detail::question_of(scene, std::move(times), segment.from, segments.size()));
    const auto candidates = made ? detail::candidates_of(*made) : std::vector<detail::Candidate>{};
    if (candidates.empty()) return nan<double>;
    sum += detail::cost_of_one(*made, candidates, displaced);
    displaced = true;
  }
  return sum;
}

GYROSTAT_COMPILED_ONCE Track segments_track(const Scene& scene, Monitor* monitor, detail::Solve solve) {
  const double cost = cost_of_segments(scene);
  if (std::isnan(cost))
    return refused<Track>(Errc::not_applicable, scene.breaks() >= most_segments ? too_many_segments : not_in_segments);
  if (cost > longest_segments) return refused<Track>(Errc::step_limit, too_long_in_segments);
  detail::SegmentedMotion motion(scene, detail::segments_of(scene.problem(), scene.question().times.back()), solve);
  if (const Errc wrong = motion.run(monitor); wrong != Errc::ok)
    return refused<Track>(wrong, wrong != Errc::cancelled && motion.why() ? motion.why() : message(wrong));
  return motion.take();
}

}  // namespace gyrostat::general
