// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "gyrostat/ladder/general/custom_rung.hpp"
#include "gyrostat/ladder/general/segments_rung.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/ladder/general/special_rung.hpp"
#include "gyrostat/ladder/general/start_error.hpp"
#include "gyrostat/ladder/goal.hpp"

namespace gyrostat::general {

namespace detail {

/// The extent of an orbit, m.
struct Apsides {
  double lowest, highest;
};
inline Apsides apsides_of(const Orbit<double>& orbit) noexcept {
  const double e = orbit.eccentricity, parameter = orbit.radius * (1 + e * std::cos(orbit.true_anomaly));
  return {parameter / (1 + e), parameter / (1 - e)};
}

/// By how much a gradient is greater than any of an orbit, as a share of that: 0 within a thousandth.
inline double beyond_orbit(double gradient, const Orbit<double>& orbit) noexcept {
  const auto [lowest, highest] = apsides_of(orbit);
  const auto over = [&](double r) noexcept { return gradient / (3 * (orbit.mu / r) / (r * r)) - 1; };
  const double low = over(highest), high = over(lowest);  // over the least of the orbit, and over the greatest
  return high > 1e-3 ? high : low < -1e-3 ? low : 0;
}

/// How many times as fast as at the start a body is at some time where torques come and go; 0 where none does, or where it starts at rest.
inline double outrun(const Scene& scene, const Track& track) noexcept {
  const auto& torques = scene.problem().torques;
  const double first = scene.problem().angular_velocity.norm();
  const bool come_and_go = std::any_of(torques.begin(), torques.end(), [](const Torque<double>& torque) {
    return !torque.table.times.empty() || !torque.factor.table.times.empty() || !torque.factor.on.empty();
  });
  if (!come_and_go || !(first > 0)) return 0;
  double most = 0;
  for (const auto& state : track.states) most = std::max(most, state.angular_velocity.norm());
  return most / first;
}

/// The first time at which a held wheel falls to rest because the table of its rate ends, s from the start; infinity: there is none.
inline double held_end(const Scene& scene) noexcept {
  double first = infinity<double>;
  for (const auto& wheel : scene.problem().wheels) {
    const auto& table = wheel.table;
    if (wheel.type != WheelType::held || table.holds || table.times.empty() || table.values.back() == 0) continue;
    first = std::min(first, table.times.back());
  }
  return first < scene.question().times.back() ? first : infinity<double>;
}

/// The rate at which the body turns once a torque that opposes the whole momentum has taken it, rad/s, as rotor and wheels with a rate of their own
/// have it at the start; 0 where there is no such torque.
inline double turned_by_stored(const Scene& scene) noexcept {
  const auto& problem = scene.problem();
  const bool opposed = std::any_of(problem.torques.begin(), problem.torques.end(), [](const Torque<double>& torque) {
    const bool opposes = torque.type == TorqueType::damping || torque.type == TorqueType::brake;
    return opposes && torque.opposed == Opposed::momentum;
  });
  if (!opposed) return 0;
  Vec3<double> stored = problem.rotor_momentum;
  for (const auto& wheel : problem.wheels)
    if (wheel.type != WheelType::locked) stored += wheel.axial_inertia * wheel.rate * wheel.axis;
  return (scene.wheels().inverse * stored).norm();
}

/// What is odd about orbit and torques, or was dropped on the way to a family.
template <class Warn>
void warn_of_scene(const Answer& answer, const Scene& scene, const Track& track, const Warn& warn) {
  const auto& problem = scene.problem();
  if (problem.orbit) {
    for (const auto& torque : problem.torques)
      if (torque.type == TorqueType::gravity_gradient && torque.gradient)
        if (const double beyond = beyond_orbit(*torque.gradient, *problem.orbit); beyond != 0)
          warn(warning::orbit_mismatch, beyond);
    const bool feels = std::any_of(problem.torques.begin(), problem.torques.end(), [](const Torque<double>& torque) {
      return torque.type == TorqueType::gravity_gradient;
    });
    const double size = std::sqrt(problem.inertia.diagonal().maxCoeff() / problem.mass);
    if (const double share = size / apsides_of(*problem.orbit).lowest; feels && problem.mass_given && share > 1e-3)
      warn(warning::wide_in_orbit, share);
    const double height = apsides_of(*problem.orbit).lowest - problem.orbit->surface;
    if (height < 0.01 * problem.orbit->surface) warn(warning::inside_planet, height);
  }
  if (const double times = outrun(scene, track); times > 1e3) warn(warning::torque_outruns, times);
  if (const double end = held_end(scene); end >= 0 && end < infinity<double>) warn(warning::held_table_ends, end);
  if (const double rate = turned_by_stored(scene);
      rate > 0 && !answer.warns("does-not-stop"))  // which a family may have told
    warn(warning::brakes_wheels, rate);
  if (!track.rests.empty()) warn(warning::rest, track.rests.front()[0]);
  const int rung = place_of(tables.rungs, answer.model);
  const Special by = rung < 0 ? Special::none : special_rungs[std::size_t(rung)].special;
  if (by == Special::none) return;
  if (const double dropped = scene.instances().dropped[std::size_t(by)]; dropped >= 1)
    warn(warning::with_rounding, dropped);
}

}  // namespace detail

/// What is known of the scene and of the whole motion.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  const auto tell = [&](std::size_t which, double value, double error = nan<double>) {
    answer.quantities.push_back({&scalar_kinds[which], {value}, error});
  };
  const auto warn = [&](std::size_t which, double value) {
    answer.warnings.push_back({&warning_kinds[which], warning_kinds[which].text, value});
  };
  double families = 0;
  for (std::size_t i = 0; i < specials; ++i)
    if (scene.instances().has(Special(i))) families += double(1U << i);
  tell(scalar::recognised, families);
  if (!std::isnan(track.stop_time)) tell(scalar::stop_time, track.stop_time, track.stop_error);
  if (!std::isnan(track.energy_balance)) tell(scalar::energy_balance, track.energy_balance);
  if (!std::isnan(track.momentum_balance)) tell(scalar::momentum_balance, track.momentum_balance);
  if (!std::isnan(track.work.whole())) {
    tell(scalar::work_torques, track.work.torques, track.work_error.torques);
    tell(scalar::work_motors, track.work.motors, track.work_error.motors);
  }
  const auto& problem = scene.problem();
  const double room = realisability(problem);
  if (room < -8 * epsilon<double> * problem.inertia.trace() &&
      !answer.warns(warning_kinds[warning::not_realisable].code))  // which a family may have told
    warn(warning::not_realisable, room);
  const auto drives = [](const Mat3<double>& m) { return symmetric_eigen<double>((m + m.transpose()) / 2).values[0]; };
  for (const auto& torque : problem.torques) {
    if (torque.type == TorqueType::damping && drives(torque.matrix) < 0)
      warn(warning::driven_damping, drives(torque.matrix));
    if (torque.type == TorqueType::eddy_current && drives(torque.matrix) < 0)
      warn(warning::eddy_not_positive, drives(torque.matrix));
  }
  if (scene.gives(column::euler) && track.off[primitive::attitude] < infinity<double>) {
    double nearest = infinity<double>;
    for (const auto& state : track.states)
      nearest = std::min(nearest, euler_angles(*scene.euler(), state.attitude).from_lock);
    if (!(nearest - track.off[primitive::attitude] > 1e-8)) warn(warning::gimbal_lock, nearest);
    const auto& times = scene.question().times;
    double fastest = problem.angular_velocity.norm(),
           longest = 0;  // rates that were not asked for may be zero in the states
    for (const auto& state : track.states) fastest = std::max(fastest, state.angular_velocity.norm());
    for (std::size_t i = 1; i < times.size(); ++i) longest = std::max(longest, times[i] - times[i - 1]);
    const double turn = fastest * longest;
    if (turn > pi<double>) warn(warning::turns_untold, turn);
  }
  for (const auto& wheel : problem.wheels)
    if (wheel.type == WheelType::motor && std::abs(wheel.rate) > std::abs(wheel.no_load_rate) && wheel.slope > 0)
      warn(warning::beyond_no_load, wheel.rate);
  detail::warn_of_scene(answer, scene, track, warn);
}

namespace detail {

inline Track in_segments(const Scene& scene, Monitor* monitor) {
  return segments_track(scene, monitor,
                        [](const Scene& one, Refusal& refusal, Monitor* its) { return solve(one, refusal, its); });
}

/// The full equations do not stand before those of a family that the scene is an instance of, which are the same with less in them.
template <std::size_t... Full>
double cost_behind(const Scene& scene, std::index_sequence<Full...>) noexcept {
  double cost = cost_of_full(scene);
  const auto put_behind = [&](double familys) { cost = familys > cost && familys < infinity<double> ? familys : cost; };
  (put_behind(cost_of_special<std::size_t(rung::family_full) + Full>(scene)), ...);
  return cost;
}
inline double cost_behind_families(const Scene& scene) noexcept {
  return cost_behind(scene, std::make_index_sequence<std::size_t(rung::segments - rung::family_full)>{});
}

template <std::size_t... Place>
constexpr auto models_of(std::index_sequence<Place...>) noexcept {
  return std::array<Rung<Scene, Track>, std::size(rung_kinds)>{{{&special_track<Place>, &cost_of_special<Place>}...,
                                                                {&in_segments, &cost_of_segments},
                                                                {&full_by_any, &cost_behind_families}}};
}
inline constexpr auto models = models_of(std::make_index_sequence<std::size_t(rung::segments)>{});

/// The rung that the question names alone, or the ladder.
inline Answer climbed(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

/// The answer from another start at these times, which end with the asked ones, if possible by the same rung, so that what it leaves out cancels. Its
/// error is of no interest.
inline std::optional<Answer> answer_beside(const Scene& scene, const Problem<double>& start,
                                           const std::vector<double>& times, int rung, Monitor* monitor) {
  const auto displaced = scene.with(start);
  if (!displaced) return std::nullopt;
  Scene beside = *displaced;
  if (!scene.own_torque().any() && !scene.full_equations) beside.full_equations = &full_track_alone;
  Refusal refusal;
  Question question = scene.question();
  question.times = times;
  if (question.rung == any_rung) question.only_rung = rung;
  Answer made = climbed(beside.asked(question), refusal, monitor);
  if (refusal.code != Errc::ok && refusal.code != Errc::cancelled)
    refusal = {}, question.only_rung = any_rung, made = climbed(beside.asked(question), refusal, monitor);
  return refusal.code == Errc::ok ? std::optional(std::move(made)) : std::nullopt;
}

/// A question with a share of its tolerances.
inline Question shared(Question question, double share) {
  question.tolerance *= share;
  for (AskedQuantity& each : question.asked) each.tolerance *= share;
  return question;
}

/// The answer to a scene whose start is off, and what comes of that: the tolerances hold for both together.
inline Answer solve_uncertain(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  Answer answer = climbed(scene, refusal, monitor);
  if (refusal.code != Errc::ok) return answer;
  const gyrostat::detail::Stopwatch watch;
  const Carried carried =
      carried_error(scene, answer, [&](const Problem<double>& start, const std::vector<double>& times) {
        return answer_beside(scene, start, times, place_of(tables.rungs, answer.model), monitor);
      });
  const double of_displaced = watch.seconds();
  if (monitor != nullptr && monitor->cancelled()) {
    refusal = {Errc::cancelled, message(Errc::cancelled)};
    return {};
  }
  Answer exact = answer;
  for (Column& column : exact.columns) column.error = 0;
  for (Quantity& quantity : exact.quantities)
    if (!std::isnan(quantity.error)) quantity.error = 0;
  add_carried(exact, carried);
  judge(exact, scene.question(), tables);
  const double taken = exact.excess;
  if (scene.question().rung == any_rung && answer.met && answer.excess > 1 - taken && taken < 1) {
    answer = climbed(scene.asked(shared(scene.question(), 1 - taken)), refusal, monitor);
    if (refusal.code != Errc::ok) return answer;
  }
  add_carried(answer, carried);
  judge(answer, scene.question(), tables);
  answer.met = answer.met && answer.excess <= 1;
  answer.tolerance = scene.question().tolerance;
  if (constexpr const auto& kind = warning_kinds[warning::start_uncertain]; !(taken <= 1))
    answer.warnings.push_back({&kind, kind.text, taken});
  for (Attempt& attempt : answer.tried)
    if (attempt.accepted) attempt.error = answer.error, attempt.excess = answer.excess, attempt.spent += of_displaced;
  return answer;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return scene.start_error().any() ? detail::solve_uncertain(scene, refusal, monitor)
                                   : detail::climbed(scene, refusal, monitor);
}

}  // namespace gyrostat::general
