// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "gyrostat/ladder/free/closed_form_rung.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/math/many.hpp"

namespace gyrostat::free {

namespace detail {

/// Whether the recurrence of an even grid is worth its while; below so many times at() costs less.
inline bool takes_grid(std::span<const double> times) noexcept { return times.size() >= 64 && even(times); }

/// The motion at the times; on an even grid by its recurrence.
inline std::vector<State<double>> states_of(const Motion<double>& motion, std::span<const double> times) {
  std::vector<State<double>> states(times.size());
  if (!takes_grid(times)) {
    for (std::size_t i = 0; i < times.size(); ++i) states[i] = motion.at(times[i]);
    return states;
  }
  const std::size_t n = times.size();
  const double step = (times.back() - times.front()) / double(n - 1);
  constexpr std::size_t chunk = 256;
  double w[3 * chunk], q[4 * chunk], M[3 * chunk];
  for (std::size_t first = 0; first < n; first += chunk) {
    const std::size_t count = std::min(chunk, n - first);
    motion.grid(times.front() + double(first) * step, step, count, w, q, M);
    for (std::size_t i = 0; i < count; ++i) {
      State<double>& s = states[first + i];
      s.angular_velocity = {w[3 * i], w[3 * i + 1], w[3 * i + 2]};
      s.angular_momentum = {M[3 * i], M[3 * i + 1], M[3 * i + 2]};
      s.attitude = {q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]};
    }
  }
  return states;
}

/// The greatest distance of the angles that the wheels turn through, rad, to those of neighbours whose data are `by` away, set up in Setup.
template <Real Setup>
double angles_apart(const Track& track, const Scene& scene, Setup by) {
  const auto& times = scene.question().times;
  const auto& wheels = scene.gyrostat().wheels;
  const auto given = scene.assembly().cast<Setup>();
  const std::size_t stride = 1 + times.size() / 64;
  double off = 0;
  for (int k = 0; k < neighbours; ++k) {
    const auto near = Reduced<Setup>::taken(neighbour<Setup>(given, k, by));
    const auto moved = Motion<double>::make<Setup>(near.problem);
    if (!moved) return infinity<double>;
    const RateIntegral<double> other(*moved, times.back());
    for (std::size_t i = times.size(); i-- > 0;) {
      if (i % stride != 0 && i + 1 != times.size()) continue;
      const Vec3<double> turned = other.at(times[i]);
      double square = 0;
      for (std::size_t w = 0; w < wheels.size(); ++w) {
        const Reduced<double>::Turning wheel{vector_cast<double>(near.wheels[w].axis), double(near.wheels[w].rate),
                                             near.wheels[w].turns_freely};
        const double d = rotor_angle(wheel, times[i], turned) - rotor_angle(wheels[w], times[i], track.turned[i]);
        square += d * d;
      }
      off = std::max(off, std::sqrt(square));
    }
  }
  return off;
}

/// How far the angles of the wheels may be off, rad, besides rounding; their integrals of omega into the track.
inline double turn_by_body(Track& track, const Scene& scene, const ClosedForm& form,
                           const RateIntegral<double>& integral) {
  for (const double t : scene.question().times) track.turned.push_back(integral.at(t));
  const double last = scene.question().times.back();
  if (!form.precise && form.motion.is_regular_precession()) return form.error.turned(last);
  return form.precise ? angles_apart<DoubleDouble>(track, scene, DoubleDouble(epsilon<double>))
                      : 2 * angles_apart<double>(track, scene, 2 * epsilon<double>);
}

GYROSTAT_COMPILED_ONCE void turn_wheels(Track& track, const Scene& scene, const ClosedForm& form) {
  const auto& times = scene.question().times;
  double off = 0, size = 1e-3, through = 0;
  if (scene.needs_turned()) {
    const RateIntegral<double> integral(form.motion, times.back());
    off = turn_by_body(track, scene, form, integral);
    through = integral.swing();
  }
  const auto& wheels = scene.gyrostat().wheels;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vec3<double> turned = track.turned.empty() ? Vec3<double>(0, 0, 0) : track.turned[i];
    double square = 0;
    for (const auto& wheel : wheels) {
      const double angle = rotor_angle(wheel, times[i], turned);
      square += angle * angle;
      const double of_body = wheel.turns_freely ? turned.norm() : 0;
      through = std::max(through, std::abs(wheel.rate) * times[i] + of_body);
    }
    size = std::max(size, std::sqrt(square));
  }
  track.error[column::rotor_angle] = relative_to_truth((4 * off + 8 * epsilon<double> * through) / size);
}

GYROSTAT_COMPILED_ONCE double rate_error(const Scene& scene, std::span<const State<double>> states,
                                         double of_velocity) noexcept {
  double size = scene.scales()[column::rotor_rate], fastest = 0;
  double free_wheels = 0, greatest = 0;
  const auto& reduced = scene.gyrostat();
  for (const auto& wheel : reduced.wheels) {
    free_wheels += wheel.turns_freely;
    greatest = std::max(greatest, std::abs(wheel.rate));
  }
  for (const auto& s : states) {
    double square = 0;
    for (std::size_t w = 0; w < reduced.wheels.size(); ++w)
      square += std::pow(reduced.wheel_rate(w, s.angular_velocity), 2);
    size = std::max(size, std::sqrt(square));
    fastest = std::max(fastest, s.angular_velocity.norm());
  }
  const double of_body =
      free_wheels > 0 ? std::sqrt(free_wheels) * of_velocity * fastest : 0;  // held wheels do not feel it
  const double off = of_body + 8 * epsilon<double> * (greatest + fastest);
  return relative_to_truth(over(off, size));
}

GYROSTAT_COMPILED_ONCE void warn_of_motion(Outcome& track, const Motion<double>& motion, bool agree) {
  if (motion.kind() == Kind::steady && motion.steady_square() < 0)
    track.warn(warning_kinds[warning::unstable_rotation], std::sqrt(-motion.steady_square()));
  else if (motion.modulus().kp2 < 1e-6 || !agree)
    track.warn(warning_kinds[warning::near_separatrix], motion.modulus().kp2);
}

GYROSTAT_COMPILED_ONCE double momentum_error(const Scene& scene, double R, double bound) noexcept {
  if (bound < infinity<double>) return bound;
  const double parts =
      scene.principal().moments[0] * scene.angular_velocity().norm() + scene.gyrostat().problem.rotor_momentum.norm();
  return over(2 * R + 8 * epsilon<double> * parts, std::max(R, scene.scales()[column::angular_momentum]));
}

GYROSTAT_COMPILED_ONCE void state_errors(Track& track, const Scene& scene, const MotionError<double>::Bound& bound,
                                         double fastest, double R, double rounding) noexcept {
  double of_times = 0;
  for (const auto& s : track.states) of_times = std::max(of_times, s.angular_velocity.norm());
  // over the greatest rate of the asked times, which may all lie where the body turns slowly
  const double slightest = scene.principal().moments[2];
  const double velocity = bound.angular_velocity * over(fastest, of_times) + over(rounding * R / slightest, of_times);
  track.error[column::attitude] = bound.attitude + rounding;
  track.error[column::angular_velocity] = relative_to_truth(velocity);
  track.error[column::angular_momentum] =
      relative_to_truth(momentum_error(scene, R, bound.angular_momentum) + rounding);
  if (scene.wheels() > 0) track.error[column::rotor_rate] = rate_error(scene, track.states, velocity);
}

GYROSTAT_COMPILED_ONCE Track track_of(const Scene& scene, const ClosedForm& form) {
  const auto& times = scene.question().times;
  Track track;
  track.states = states_of(form.motion, times);
  const auto bound = form.error.at(times.back());
  state_errors(track, scene, bound, form.error.fastest(), form.motion.angular_momentum_norm(),
               takes_grid(times) ? grid_rounding : 0);
  if (scene.gives(column::rotor_angle)) turn_wheels(track, scene, form);
  warn_of_motion(track, form.motion, form.error.kinds_agree());
  if (!(bound.attitude < infinity<double>)) track.warn(warning_kinds[warning::phase_unknown], times.back());
  track.form = form;
  return track;
}

GYROSTAT_COMPILED_ONCE bool asks_for_states(const Scene& scene) noexcept {
  return math::many_pays && !tells_scalars(scene.question()) && !scene.gives(column::rotor_angle) &&
         !takes_grid(scene.question().times) && scene.principal().axis_of_symmetry() < 0;
}

GYROSTAT_COMPILED_ONCE bool take_lane(Track& track, const Scene& scene, const QuickLanes& lanes, int b) {
  const auto& times = scene.question().times;
  const auto& known = lanes.known(b);
  const auto goal = scene.goal();
  if (!(known.of_scalars <= goal.tightest)) return false;
  track.states.resize(times.size());
  lanes.at(b, times, track.states.data());
  state_errors(track, scene, known.bound, known.fastest, known.momentum, 0);
  return goal.excess(track.error) <= 1;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track closed_form_track(const Scene& scene, Monitor*) {
  if (detail::asks_for_states(scene)) {
    QuickLanes lanes;
    Track track;
    const QuickLanes::Body body = detail::lane_of(scene);
    if (lanes.make({&body, 1}) != 0 && detail::take_lane(track, scene, lanes, 0)) return track;
  }
  if (const auto form = quick_form_of(scene)) {
    Track track = detail::track_of(scene, *form);
    if (scene.goal().excess(track.error) <= 1) return track;
  }
  const auto form = closed_form_of(scene);
  if (!form) return refused<Track>(form.error(), "rounding hides on which side of a separatrix the motion runs");
  return detail::track_of(scene, *form);
}

}  // namespace gyrostat::free
