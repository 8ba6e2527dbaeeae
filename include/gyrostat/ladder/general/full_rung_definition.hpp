// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/general/full_rung.hpp"

namespace gyrostat::general {

namespace detail {

GYROSTAT_COMPILED_ONCE std::array<double, primitive::count> off_of(const Track& track, const FullErrors<double>& error,
                                                                   const FullRow<double>& row,
                                                                   const Scene& scene) noexcept {
  std::array<double, primitive::count> off;
  std::array<double, primitive::count> size{};
  const auto norm = [](const auto& values) noexcept {
    double square = 0;
    for (const double x : values) square += x * x;
    return std::sqrt(square);
  };
  for (const auto& s : track.states) {
    const double sizes[] = {1,
                            s.angular_velocity.norm(),
                            s.angular_momentum.norm(),
                            norm(s.rotor_rate),
                            norm(s.rotor_angle),
                            s.velocity.norm(),
                            s.position.norm()};
    for (std::size_t p = 0; p < primitive::count; ++p) size[p] = std::max(size[p], sizes[p]);
  }
  for (std::size_t p = 0; p < primitive::count; ++p)
    off[p] = p == primitive::attitude || error[p] == 0 ? error[p] : error[p] * std::max(size[p], row.scale[p]);
  // where nothing has acted yet
  for (const auto p : {primitive::velocity, primitive::position})
    if (size[p] == 0 && error[p] < infinity<double>) off[p] = 0;
  if (scene.wheels().count == 0) off[primitive::rotor_rate] = off[primitive::rotor_angle] = nan<double>;
  return off;
}

GYROSTAT_COMPILED_ONCE Track::Compared compared_of(const Track& track, const FullErrors<double>& error,
                                                   const FullRow<double>& row) noexcept {
  Comparison<FullRow<double>> sizes(row);
  for (const auto& s : track.states) sizes.add(s);
  const auto off = sizes.absolute(error);
  return {off[full_column::impulse], off[full_column::gain], off[full_column::work]};
}

/// Takes what a run says about its errors into the track that has its states, and judges it by what is asked of the columns made of them.
struct RunReader {
  const Scene& scene;
  const FullRow<double>& row;
  const Goal<std::size(column_kinds)>& goal;
  Track& track;

  bool judges(std::size_t place) const noexcept {
    return goal.columns[place] < infinity<double> && scene.has_column(place);
  }
  double excess(std::size_t place) const noexcept { return column_error(track, scene, place) / goal.columns[place]; }

  /// FullMotionOptions::judge of a RunReader.
  static double judge(void* caller, const FullMotionAnswer<double>& answer) noexcept {
    RunReader& reader = *static_cast<RunReader*>(caller);
    Track& track = reader.track;
    track.rests = answer.rests, track.rest_off = answer.rest_off;
    track.off = off_of(track, answer.error, reader.row, reader.scene);
    track.compared = compared_of(track, answer.error, reader.row);
    // the sizes of rates are foreseen from the momenta, which may be far more than what they come to
    double most = reader.judges(column::angular_velocity) ? reader.excess(column::angular_velocity) : 0;
    for (const std::size_t place : compared_columns)
      if (reader.judges(place)) most = greater(reader.excess(place), most);
    if (!reader.judges(column::torque)) return most;
    track.compared.torque = column_off(track, reader.scene, column::torque);
    return greater(reader.excess(column::torque), most);
  }
};

GYROSTAT_COMPILED_ONCE void add_balance(Track& track, const Scene& scene, double step_tolerance) noexcept {
  const Question& question = scene.question();
  const auto asks = [&](std::size_t which) { return aim_of(question, tables, true, which).has_value(); };
  const bool works = asks(scalar::work_torques) || asks(scalar::work_motors);
  if (!works && !asks(scalar::energy_balance) && !asks(scalar::momentum_balance)) return;
  const auto found = balance<double>(scene.problem(), question.times.back(), companion_step(step_tolerance), works);
  track.energy_balance = found.energy;
  track.momentum_balance = found.momentum;
  if (!works) return;
  // both together are what the energy has changed by, whose error all of the way has shown
  const auto error = [&](double off) noexcept {
    if (off > 0) off = std::max(off, std::isnan(track.compared.energy) ? 0 : track.compared.energy);
    return relative_to_truth(over(off, found.size));
  };
  track.work = found.work;
  track.work_error = {error(found.work_off.torques), error(found.work_off.motors)};
}

/// Whether the scene is integrated by Radau: where wheels are stiff, or as the question names it.
inline bool is_collocated(const Scene& scene) noexcept {
  const Integrator by = scene.question().integrator;
  return by == Integrator::any ? scene.is_stiff() : by == Integrator::radau;
}

/// Steps that a run takes so that wheels settle as they should, or by Radau, which need not follow them, what damping there is.
inline double settling_steps(const Scene& scene) noexcept {
  const double rate = is_collocated(scene) ? scene.sizes().damping : scene.settling_rate();
  return rate * scene.question().times.back() / 8;
}

/// How many times the cost of a step without them fields make a step cost.
inline double cost_of_fields(const Problem<double>& problem) noexcept {
  const auto acts = [&](TorqueType type) {
    return std::ranges::any_of(problem.torques, [type](const auto& torque) { return torque.type == type; });
  };
  const bool magnetic = acts(TorqueType::magnetic) || acts(TorqueType::eddy_current);
  const bool dipole = magnetic && problem.field.magnetic == MagneticField::dipole;
  const bool gradient = problem.orbit && acts(TorqueType::gravity_gradient);
  const bool ellipse = (dipole || gradient) && problem.orbit->eccentricity > 0;
  return 1 + (magnetic || gradient ? of_field : 0) + (dipole ? of_dipole : 0) + (ellipse ? of_ellipse : 0);
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE double cost_of_full(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = scene.sizes().angle + scene.sizes().forcing * times.back();
  const double tolerance = first_step_tolerance_of_phase(scene.goal().tightest, phase, honesty::loosest_step);
  const bool collocated = detail::is_collocated(scene);
  SeriesCost cost = collocated ? stiff_cost : scene.is_large() ? large_series_cost : small_series_cost;
  if (!collocated) cost.step *= detail::cost_of_fields(scene.problem());
  const double again = collocated ? 10 : 2;  // steps that a breakpoint costs
  return cost(phase + detail::settling_steps(scene), tolerance, times.size()) +
         double(scene.breaks()) * again * cost.step;
}

namespace detail {

GYROSTAT_COMPILED_ONCE Track unless_lost(const Scene& scene) {
  const double span = scene.question().times.back();
  if (phase_too_long(scene.sizes().turning * span, scene.goal().tightest))
    return refused<Track>(Errc::step_limit, phase_lost);
  if (!(scene.sizes().forcing * span <= most_forcing)) return refused<Track>(Errc::out_of_domain, forcing_lost);
  return {};
}

/// The full equations in one run or, where their error is wanted, with neighbours.
inline Track track_of(const Scene& scene, Monitor* monitor, bool alone) {
  const Question& question = scene.question();
  const auto& times = question.times;
  const auto goal = scene.goal();
  Track track = unless_lost(scene);
  if (track.failure != Errc::ok) return track;
  if (settling_steps(scene) > double(step_budget)) return refused<Track>(Errc::step_limit, too_stiff);
  const FullRow<double> row(Prepared<double>(scene.problem(), times.back()), true);
  const auto wanted = wanted_of(scene, goal, row, true);
  track.states.resize(times.size());
  RunReader reader{scene, row, goal, track};
  FullMotionOptions<double> options;
  options.integrator = question.integrator;
  options.alone = alone;
  options.tolerance = alone ? goal.tightest / 8 : goal.tightest;
  options.wanted = wanted.of;
  options.monitor = monitor;
  options.judge = &RunReader::judge, options.caller = &reader;
  const auto answer = full_motion<double>(scene.problem(), times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status == ode::Status::event)
    return refused<Track>(Errc::not_applicable, why_not_through(answer->at_stop));
  if (answer->outgrown) return refused<Track>(Errc::step_limit, why_outgrown);
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  if (answer->growth > honesty::chaotic_growth) track.warn(warning_kinds[warning::chaotic], answer->growth);
  if (scene.is_stiff() && answer->used == Integrator::radau)
    track.warn(warning_kinds[warning::stiff], scene.settling_rate());
  if (answer->stop_off < infinity<double>) {
    track.stop_time = answer->stop;
    track.stop_error = answer->stop > 0 ? relative_to_truth(answer->stop_off / answer->stop) : 0;
  }
  track.counts = answer->counts;
  if (alone) RunReader::judge(&reader, *answer);
  else add_balance(track, scene, answer->step_tolerance);
  return track;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor) {
  return detail::track_of(scene, monitor, false);
}
GYROSTAT_COMPILED_ONCE Track full_track_alone(const Scene& scene, Monitor* monitor) {
  return detail::track_of(scene, monitor, true);
}

}  // namespace gyrostat::general
