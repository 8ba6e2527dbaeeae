// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/ladder/spinning/linear_rung.hpp"
#include "gyrostat/ladder/spinning/neighbour.hpp"

namespace gyrostat::spinning {

namespace detail {

/// The linear motion on an even grid.
inline void linear_on_grid(const LinearGrid<double>& grid, double spin, std::span<State<double>> states) noexcept {
  constexpr std::size_t chunk = 128;
  std::array<std::array<double, chunk>, 14> store;
  auto& s = store;
  const GridColumns<double> columns{s[0].data(),  s[1].data(),  s[2].data(),  s[3].data(), s[4].data(),
                                    s[5].data(),  s[6].data(),  s[7].data(),  s[8].data(), s[9].data(),
                                    s[10].data(), s[11].data(), s[12].data(), s[13].data()};
  for (std::size_t first = 0; first < states.size(); first += chunk) {
    const std::size_t count = std::min(chunk, states.size() - first);
    grid.write(first, count, columns);
    for (std::size_t i = 0; i < count; ++i) {
      State<double>& state = states[first + i];
      state.angular_velocity = {s[0][i], s[1][i], spin};
      state.angles = {s[2][i], s[3][i], s[4][i]};
      state.attitude = quaternion_from_312(s[2][i], s[3][i], s[4][i]);
      state.momentum_I = {s[5][i], s[6][i], s[13][i]};
      state.velocity = {s[7][i], s[8][i], s[9][i]};
      state.position = {s[10][i], s[11][i], s[12][i]};
    }
  }
}

GYROSTAT_COMPILED_ONCE void linear_states(const Problem<double>& problem, std::span<const double> times,
                                          std::span<State<double>> states) noexcept {
  // below, what a grid begins with costs more than it saves: modes of the motion, or tables of blocks
  constexpr std::size_t worth_modes = 16, worth_blocks = 512;
  const std::size_t n = times.size();
  if (n >= worth_modes && even(times)) {
    const double step = (times.back() - times.front()) / double(n - 1);
    const GridKernel best = LinearGrid<double>::best(problem, times.front(), step, n);
    if (best == GridKernel::modes || (best == GridKernel::blocks && n >= worth_blocks)) {
      linear_on_grid(LinearGrid<double>(problem, times.front(), step, n, best), problem.spin(), states);
      return;
    }
  }
  Linear<double>(problem).at(times, states);
}

/// What a motion for small tilt says where it leaves its domain.
inline void warn_beyond_validity(Track& track, const LinearErrors<double>& error) {
  track.warn(warning_kinds[warning::beyond_validity], error.size.tilt);
}

GYROSTAT_COMPILED_ONCE Track given_up(const LinearErrors<double>& error) {
  Track track = over_tolerance<Track>(error.attitude);
  if (!holds(error)) track.refusal = tilt_too_large;
  return track;
}

/// What the turning of the data into the axes of the spin makes of a motion for small tilt, in the units of the columns: two neighbours of it
/// say it. follow(problem, states): whether the motion is found.
template <class Follow>
ColumnErrors<double> conversion_errors(const Scene& scene, Follow&& follow) {
  const Problem<double>& problem = scene.problem();
  if (!problem.converted) return {};
  const double rate = problem.rate_size(scene.question().times.back());
  std::vector<State<double>> given(scene.question().times.size()), near(given.size());
  bool found = follow(problem, given);
  Comparison apart(Row<double>{});
  for (const Aside aside : {Aside::first, Aside::second}) {
    found = found && follow(neighbour<double>(problem, rate, 4 * epsilon<double>, aside), near);
    for (std::size_t i = 0; i < given.size(); ++i) apart.add(given[i], near[i]);
  }
  return found ? apart.difference() : ColumnErrors<double>::all(infinity<double>);
}

GYROSTAT_COMPILED_ONCE ColumnErrors<double> linear_conversion_errors(const Scene& scene) {
  return conversion_errors(scene, [&](const Problem<double>& of, std::span<State<double>> states) {
    linear_states(of, scene.question().times, states);
    return true;
  });
}

GYROSTAT_COMPILED_ONCE Track judged(Track track, const Scene& scene, const LinearErrors<double>& error,
                                    const ColumnErrors<double>& of_data) {
  const Row<double> row{};
  for (const State<double>& state : track.states) {
    double numbers[row_width(column_kinds)];
    row(state, numbers);
    if (!std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return std::isfinite(x); }))
      return refused<Track>(Errc::not_finite, "the equations for small tilt grow beyond the greatest double");
  }
  const double span = scene.question().times.back();
  track.error = tilt_errors(scene.problem(), error, track.states, span, of_data);
  track.tilt_error = error.tilt + rounding_of_phases(scene.problem(), span) * error.size.tilt + 8 * epsilon<double> +
                     of_data[column::attitude];
  track.in_domain = holds(error);
  if (!track.in_domain) warn_beyond_validity(track, error);
  return track;
}

inline Track axial_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  const double end = question.times.back();
  // the phase is an estimate
  if (scene.problem().phase(end) > 4 * unreachable_angle)
    return refused<Track>(Errc::step_limit, why_stopped(ode::Status::step_limit));
  AxialMotionOptions<double> options;
  options.step_cap = step_budget;
  options.monitor = monitor;
  Track track;
  const auto advance = [&](std::span<const double> times, std::span<State<double>> states, auto& error) {
    const auto made = axial_motion<double>(scene.problem(), times, states, options);
    if (!made) return made.error();
    track.counts += made->counts;
    if (made->status == ode::Status::event) return Errc::not_applicable;
    if (made->status != ode::Status::reached) return failure_of(made->status);
    error = axial_torque_errors(scene.problem(), times.back(), made->seen);
    return Errc::ok;
  };
  const auto why = [](Errc wrong) {
    if (wrong == Errc::not_applicable)
      return "the spin is unstable: the tilt grows beyond all sense of the equations for small tilt";
    return wrong == Errc::step_limit ? why_stopped(ode::Status::step_limit) : message(wrong);
  };
  LinearErrors<double> error{};
  if (question.rung != rung::linear) {
    // the errors only grow: a sixteenth of the motion often suffices
    const std::array<double, 1> early{end / 16};
    std::array<State<double>, 1> unused;
    if (const Errc wrong = advance(early, unused, error); wrong != Errc::ok) return refused<Track>(wrong, why(wrong));
    if (gives_up(scene, rung::linear, error)) return given_up(error);
  }
  track.states.resize(question.times.size());
  if (const Errc wrong = advance(question.times, track.states, error); wrong != Errc::ok)
    return refused<Track>(wrong, why(wrong));
  if (gives_up(scene, rung::linear, error)) return given_up(error);
  const auto of_data = conversion_errors(scene, [&](const Problem<double>& of, std::span<State<double>> states) {
    const auto made = axial_motion<double>(of, question.times, states, options);
    if (made) track.counts += made->counts;
    return made && made->status == ode::Status::reached;
  });
  return judged(std::move(track), scene, error, of_data);
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track linear_track(const Scene& scene, Monitor* monitor) {
  const Problem<double>& problem = scene.problem();
  if (problem.torque[2] != 0) return detail::axial_track(scene, monitor);
  const auto& times = scene.question().times;
  const double end = times.back();
  auto error = linear_errors(problem, end, Look::rough);
  if (detail::worth_a_closer_look(scene, rung::linear, error) && times.size() <= detail::many_times && end > 0) {
    const auto left = second_order_errors(problem, end, Look::rough);
    const TiltOrders<double> orders(problem, end);
    error.attitude = detail::looked_at(scene, error, [&](std::span<const double> at) {
      return linear_attitude_error<double>(error, left, orders, at);
    });
  }
  if (detail::gives_up(scene, rung::linear, error)) return detail::given_up(error);
  Track track;
  track.states.resize(times.size());
  detail::linear_states(problem, times, track.states);
  const auto of_data = detail::linear_conversion_errors(scene);
  track = detail::judged(std::move(track), scene, error, of_data);
  const bool suffices = scene.question().rung != rung::linear && scene.goal().excess(track.error) <= 1;
  if (suffices || track.refusal != nullptr || !track.in_domain || !(end > 0)) return track;
  auto close = linear_errors(problem, end, Look::close);
  close.attitude = error.attitude;
  return detail::judged(std::move(track), scene, close, of_data);
}

}  // namespace gyrostat::spinning
