// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/hand_over.hpp"
#include "gyrostat/ladder/deceleration/orbit_kind.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/models/deceleration/capture.hpp"

/// What the averaged rungs share, over polhodes (averaged_rung.hpp) and over orbits with rotor momentum (orbit_rung.hpp).
namespace gyrostat::deceleration {

/// |M| at which the body turns once while the control stops it, N m s: below, averaging has no meaning.
inline double breakdown_momentum(const Problem<double>& problem, double greatest_control) noexcept {
  return std::sqrt(greatest_control / problem.inverse_inertia[1]);
}

/// Local error of the mean equations: far below what is asked, no smaller than rounding allows.
inline double mean_tolerance(const Scene& scene) noexcept {
  return std::max(1e-13, std::min(1e-5, scene.goal().tightest * 1e-3));
}

/// Local error of the phase of a mean motion of second order: far below what is asked of M. Where M is not asked for the phase tells its oscillation alone.
inline double mean_phase_error(const Scene& scene) noexcept {
  const auto goal = scene.goal();
  const double fast = goal.tightest_of(fast_columns);
  return std::max(1e-10, fast < infinity<double> ? fast * 1e-3 : goal.tightest * 1e-2);
}

namespace detail {

/// Why no averaged rung answers the scene, or nullptr.
GYROSTAT_COMPILED_ONCE const char* not_averaged(const Scene& scene) noexcept;

/// What averaging does not like at the start. mu: relative change of M in one radian; gap: between the two moments that are nearest
/// each other, over the widest, and from where on it is narrow; kp2: of the first orbit.
GYROSTAT_COMPILED_ONCE void warn_of_start(Track& track, double mu, double gap, double narrow, double kp2);

/// The gap between the two principal axes that are nearest each other, over that of the outer two.
inline double symmetry_gap(const Problem<double>& problem) noexcept {
  const auto& a = problem.inverse_inertia;
  return std::min(a[1] - a[0], a[2] - a[1]) / (a[2] - a[0]);
}

/// The slow columns' errors.
GYROSTAT_COMPILED_ONCE void state_errors(Track& track, const SlowError<double>& error) noexcept;

/// Why a mean motion cannot be followed on; ok where it was.
struct Halt {
  Errc code = Errc::ok;
  const char* why = nullptr;
};

GYROSTAT_COMPILED_ONCE Halt not_followed(Errc failure) noexcept;

/// Factor by which errors relative to the momentum at the start count in the momentum that is left to the weakest control, which sets the time of the
/// stop where that control acts last. 1 where all of it is left.
inline double weight_of_rest(const Scene& scene, double stop) noexcept {
  const auto& problem = scene.problem();
  const double drag = problem.drag, braked = drag > 0 ? std::expm1(drag * stop) / drag : stop;
  const double left = scene.least_control() * braked, norm = problem.momentum.norm();
  return left > 0 && left < norm ? norm / left : 1.0;
}

/// Relative error of the time of the stop, from local errors of the mean equations.
inline double stop_of_steps(double weight, double tolerance) noexcept {
  return std::max(honesty::mean_stop, 2 * honesty::mean_steps * weight) * tolerance;
}

/// Whether a motion is followed from the asked times to its stop: only where that is asked for. A stop that may be left out is not sought where its error, this
/// late at the least, is too large whenever it comes, at `latest`; then the track has a warning. Times in s.
inline bool seeks_stop(Track& track, const Scene& scene, double late, double latest) {
  if (!scene.asks_for_stop()) return false;
  const bool hopeless = late > scene.question().tolerance * latest;
  if (!hopeless || scene.needs_stop() || scene.question().rung != any_rung) return true;
  warn_of_stop_withheld(track, scene);
  return false;
}

/// Distance of the start's energy from the next separatrix at its |M|, over the range of energies there; NaN where there
/// is none (a sphere, M = 0, a rotor that leaves one component only).
inline double separatrix_distance(const Scene& scene) noexcept {
  const auto band = band_of(scene.problem(), level_of(scene.problem(), scene.problem().momentum));
  return band ? band->separatrix_distance() : nan<double>;
}

/// What a rounding of the energy makes of the phase of an orbit next to a separatrix, and so of the momentum over its size: an orbit lingers as long as
/// the logarithm of its distance. 0 where nobody asks.
inline double rounding_of_lingering(const Scene& scene) noexcept {
  const auto goal = scene.goal();
  if (!(std::min(goal.columns[column::angular_momentum], goal.columns[column::angular_velocity]) < infinity<double>))
    return 0;
  const double distance = separatrix_distance(scene);
  return distance == distance ? honesty::lingering_rounding * std::min(epsilon<double> / distance, 1.0) : 0;
}

inline Track refused(const Halt& halt) { return gyrostat::refused<Track>(halt.code, halt.why); }

}  // namespace detail

/// Second order: the osculating states of a mean motion, and so M itself, down to where the control opposes `floor` [N m s]; from there on
/// the full equations. Begins with a track that has the warnings of the start. `tolerance`: local error of the mean equations.
///
/// mean.advance(t, floor) goes on to time t or to the floor, whichever comes first, and gives a Halt; floored() says that it is at the floor,
/// time() when; osculating() gives the State of that time, as a Result; second_order(), first_order() the SlowError of the span; lag(local)
/// the angle by which the phase may be wrong, rad; counts() the work; warn(track) what there is to say of the motion.
template <class Mean>
Track second_order_track(Track track, const Scene& scene, Mean& mean, double floor, double tolerance,
                         Monitor* monitor) {
  const auto& problem = scene.problem();
  const auto& times = scene.question().times;
  track.states.reserve(times.size());
  if (!(times.front() > 0)) track.states.push_back(detail::state_on_orbit(problem, problem.momentum));
  while (track.states.size() < times.size()) {
    const auto halt = mean.advance(times[track.states.size()], floor);
    if (halt.code != Errc::ok) return detail::refused(halt);
    if (mean.floored()) break;
    const auto now = mean.osculating();
    if (!now) return detail::refused(detail::not_followed(now.error()));
    track.states.push_back(*now);
  }
  const bool in_time = track.states.size() == times.size();

  const SlowError<double> in_span = mean.second_order(), oscillating = mean.first_order();
  const double norm = problem.momentum.norm(), energy = problem.energy(problem.momentum);
  const double local = honesty::mean_steps * tolerance, lag = mean.lag(local);
  const double slow = honesty::mean_steps_of_slow * tolerance;
  // of a body that the rotors hold nearly alone the energy is a difference of numbers of the size of what they hold
  const double own_energy =
      2 * slow * energy + problem.energy_error(problem.momentum) + 3 * epsilon<double> * problem.rotor_energy_scale();
  double own_k2 = 0;
  for (const auto& state : track.states)
    own_k2 =
        std::max(own_k2, k2_uncertainty(problem, state.momentum, {state.regime, state.k2}, slow * norm, own_energy));
  detail::state_errors(track, {in_span.norm + slow * norm + problem.momentum_error() + lag * oscillating.norm,
                               in_span.energy + own_energy + lag * oscillating.energy,
                               std::min(1.0, in_span.k2 + own_k2 + lag * oscillating.k2), 0});
  track.know_momentum(problem, in_span.vector + (local + lag + detail::rounding_of_lingering(scene)) * norm);

  // The tail, for the stop time and for the samples beyond the hand-over. Where it leads to no stop the full equations tell more, and
  // nothing is left out to spare them.
  bool stops = false;
  const auto sought = [&] {
    const Vec3<double>& M = track.states.back().momentum;
    const double carrier = (M - problem.rotor_momentum).norm(),
                 opposed = problem.law == Law::total ? M.norm() : carrier;
    const double least = final_torque(scene).least;
    const double late = detail::opposed_error(problem, mean.second_order(), carrier) / least;
    return detail::seeks_stop(track, scene, late, times.back() + opposed / least);
  };
  if (in_time && !Hold<double>(problem).may_stop()) {
    track.stop_time = infinity<double>;
  } else if (in_time && !sought()) {
    // nothing asks what comes after the asked times
  } else if (const auto halt = mean.advance(infinity<double>, floor); halt.code != Errc::ok) {
    if (!in_time || halt.code == Errc::not_applicable) return detail::refused(halt);
    if (halt.code == Errc::separatrix || halt.code == Errc::undetermined)
      track.warn(warning::crosses_separatrix, nan<double>,
                 "after the asked times the kind of orbit changes: no stop time");
    else track.warn(warning::stop_unknown);
  } else {
    const auto now = mean.osculating();
    if (!now) return detail::refused(detail::not_followed(now.error()));
    const Errc failure = hand_over(track, scene, now->momentum, mean.time(), mean.second_order(), monitor);
    if (failure != Errc::ok)
      return gyrostat::refused<Track>(failure, "the full equations could not take over near rest");
    track.stop_error += detail::stop_of_steps(detail::weight_of_rest(scene, track.stop_time), tolerance);
    stops = true;
  }
  track.counts += mean.counts();
  mean.warn(track);
  // a rest that may not be one yet
  detail::doubt_modulus_at_stop(track, problem, times);
  if (stops) withhold_stop(track, scene);
  return track;
}

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/averaging_definition.hpp"
#endif
