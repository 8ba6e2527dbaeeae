// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/deceleration/averaged_motion.hpp"
#include "gyrostat/ladder/deceleration/hand_over.hpp"
#include "gyrostat/models/deceleration/averaging_error.hpp"

/// Rungs `averaged` and `averaged-2` without rotor momentum.
namespace gyrostat::deceleration {

/// |M| at which the body turns once while the control stops it, N m s: below, averaging has no meaning.
inline double breakdown_momentum(const Problem<double>& problem, double greatest_control) noexcept {
  return std::sqrt(greatest_control / problem.inverse_inertia[1]);
}

/// The averaged motion without rotor momentum and what its error is made of.
template <class Elliptic>
class AveragedRun {
 public:
  AveragedRun(const Scene& scene, const Polhode<double>& start, double norm, double phase, double tolerance,
              double phase_error) noexcept
      : problem_(scene.problem()),
        greatest_(scene.greatest_control()),
        motion_(problem_, start, norm, phase, tolerance, phase_error) {
    visit(start, norm);
  }

  ode::Status advance(double t, double floor = 0) noexcept {
    const auto status = motion_.advance(t, floor, [this](const Polhode<double>& p, double norm) { visit(p, norm); });
    if (motion_.crossed()) error_.cross(motion_.crossing_norm(), greatest_, problem_.inverse_inertia);
    return status;
  }

  AveragedMotion<Elliptic, double>& motion() noexcept { return motion_; }
  const AveragingError<double>& error() const noexcept { return error_; }

  /// Local error of the mean equations: far below what is asked, no smaller than rounding allows.
  static double tolerance_of(const Scene& scene) noexcept {
    return std::max(1e-13, std::min(1e-9, scene.question().tolerance * 1e-3));
  }

 private:
  void visit(const Polhode<double>& p, double norm) noexcept {
    const auto b = ControlTorques<double>::of(problem_.control, p.axes);
    error_.visit(p, b, mean_torque<Elliptic>(p, b), problem_.drag, norm);
  }

  Problem<double> problem_;
  double greatest_;
  AveragedMotion<Elliptic, double> motion_;
  AveragingError<double> error_;
};

namespace detail {

/// Why no averaged rung of this file answers the scene, or nullptr.
inline const char* not_averaged(const Scene& scene) noexcept {
  if (scene.question().wants_attitude) return "averaging does not know the attitude";
  if (scene.sphere()) return "a sphere has no fast polhode to average over";
  if (!(scene.problem().momentum.norm() > 0)) return "the body is at rest at the start";
  return nullptr;
}

/// The polhode of the start; where there is none the refusal is not ok.
struct PolhodeStart {
  Polhode<double> polhode{};
  Track refusal;
};

inline PolhodeStart start_of(const Scene& scene) {
  if (const char* why = not_averaged(scene)) return {{}, refused<Track>(Errc::not_applicable, why)};
  const auto p = polhode_through<double>(scene.problem().inverse_inertia, scene.problem().momentum);
  if (!std::isfinite(p.modulus.k2) || !std::isfinite(p.modulus.kp2))
    return {p, refused<Track>(Errc::not_applicable,
                              "M lies across an axis of symmetry: there is no polhode to average over")};
  if (!(p.modulus.kp2 > 0)) return {p, refused<Track>(Errc::separatrix, "the motion starts on the separatrix")};
  return {p, {}};
}

/// The osculating state of a mean one, and whether it has one.
struct Osculating {
  MeanState<double> state;
  Vec3<double> momentum;
  bool valid;
};

template <class Elliptic>
Osculating osculating(const Problem<double>& problem, const MeanState<double>& mean) noexcept {
  const auto b = ControlTorques<double>::of(problem.control, mean.polhode.axes);
  const double u = mean.phase * Elliptic::complete(mean.polhode.modulus).K;
  const auto o = oscillation<Elliptic>(mean.polhode, b, mean.norm, u);
  const auto p = shifted(mean.polhode, o.spread);
  const double norm = mean.norm * (1 + o.norm);
  const double argument = mean.phase * Elliptic::complete(p.polhode.modulus).K;
  return {{norm, p.polhode, mean.phase}, momentum_on<Elliptic>(p.polhode, norm, argument), p.valid};
}

/// What averaging does not like at the start. mu: relative change of M in one radian; gap: between the two moments that are nearest
/// each other, over the widest, and from where on it is narrow; kp2: of the first orbit.
inline void warn_of_start(Track& track, double mu, double gap, double narrow, double kp2) {
  if (mu > 0.1) track.warn(warning::not_slow, mu);
  if (gap < narrow) track.warn(warning::near_symmetric, gap);
  if (kp2 < std::max(1e-2, 10 * mu)) track.warn(warning::near_separatrix, kp2);
}

/// The gap between the two principal axes that are nearest each other, over that of the outer two.
inline double symmetry_gap(const Problem<double>& problem) noexcept {
  const auto& a = problem.inverse_inertia;
  return std::min(a[1] - a[0], a[2] - a[1]) / (a[2] - a[0]);
}

inline void warn_of_start(Track& track, const Scene& scene, const Polhode<double>& p) {
  const double M = scene.problem().momentum.norm();
  const double breakdown = breakdown_momentum(scene.problem(), scene.greatest_control());
  const double mu = breakdown * breakdown / (M * M);
  warn_of_start(track, mu, symmetry_gap(scene.problem()), scene.equal_control() ? 0 : std::max(1e-3, 10 * mu),
                p.modulus.kp2);
}

inline void warn_of_motion(Track& track, const AveragingError<double>& error, bool crossed, bool stuck) {
  if (crossed)
    track.warn(warning::crosses_separatrix, nan<double>,
               "the motion crosses the separatrix: the sign of the momentum about its new axis is not determined");
  if (stuck) track.warn(warning::sticks_to_separatrix);
  if (error.greatest_squeeze() > 0.1)
    track.warn(warning::near_separatrix, error.greatest_squeeze(),
               "one oscillation changes 1 - k2 by a large part of itself");
}

inline State<double> slow_state(const MeanState<double>& s) {
  State<double> state;
  state.norm = s.norm;
  state.energy = s.norm * s.norm * s.polhode.energy_ratio() / 2;
  state.k2 = s.norm > 0 ? s.polhode.modulus.k2 : 0;
  state.regime = s.norm > 0 ? s.polhode.regime : Regime::rest;
  return state;
}

/// The slow columns' errors.
inline void state_errors(Track& track, const SlowError<double>& error) noexcept {
  track.error[column::angular_momentum_norm] = error.norm;
  track.error[column::energy] = error.energy;
  track.error[column::modulus_squared] = error.k2;
}

}  // namespace detail

/// First order: started from the osculating polhode, carried down to rest.
template <class Elliptic>
Track averaged_track(const Scene& scene) {
  const auto [start, refusal] = detail::start_of(scene);
  if (refusal.failure != Errc::ok) return refusal;
  const auto& problem = scene.problem();
  const Vec3<double>& M0 = problem.momentum;
  const double norm0 = M0.norm();

  Track track;
  const double tolerance = AveragedRun<Elliptic>::tolerance_of(scene);
  AveragedRun<Elliptic> run(scene, start, norm0, 0, tolerance, infinity<double>);
  const double energy0 = problem.energy(M0);
  if (scene.question().rung == any_rung) {
    const auto least = run.error().first_order(norm0, energy0);
    const double error = std::max({least.norm / norm0, least.energy / energy0, least.k2});
    if (error > scene.question().tolerance) return over_tolerance<Track>(error);
  }
  for (const double t : scene.question().times) {
    if (run.advance(t) != ode::Status::reached)
      return refused<Track>(Errc::no_convergence, "the mean equations could not be integrated");
    track.states.push_back(detail::slow_state(run.motion().state()));
  }
  auto error = run.error().first_order(norm0, energy0);
  const double breakdown = breakdown_momentum(problem, scene.greatest_control());

  // Below a few breakdown momenta the body falls to the axis of the weakest control, the averaged one need not.
  const double low = 3 * breakdown;
  double late = scene.greatest_control() > 0 ? 1 : 0;
  if (late > 0 && low < norm0 / 2 && run.advance(infinity<double>, low) == ode::Status::reached) {
    const auto s = run.motion().state();
    const auto b = ControlTorques<double>::of(problem.control, s.polhode.axes);
    const double D = mean_torque<Elliptic>(s.polhode, b).deceleration;
    const double tail = low * std::abs(1 / scene.least_control() - 1 / D);
    const double drift = run.error().first_order(norm0, energy0).norm / D;
    const auto stop = run.motion().stop_time();
    if (!stop) return refused<Track>(stop.error(), "the mean equations could not be integrated to rest");
    late = (tail + drift) / *stop;
  }
  if (const auto stop = run.motion().stop_time()) track.stop_time = *stop;
  if (late > 1) late = infinity<double>;  // not an estimate any more
  track.stop_error = std::isfinite(track.stop_time) ? late + 1e3 * tolerance : 0;

  const double local = 10 * tolerance;
  error.norm += local * norm0;
  error.energy += local * energy0;
  error.k2 += local;
  if (track.states.back().norm < low) {
    error.norm += std::min(low, norm0) * std::min(1.0, late * track.stop_time * scene.greatest_control() / low);
    error.k2 = 1;
  }
  detail::state_errors(track, error);
  if (!(breakdown < norm0 / 3)) track.leave_domain();
  track.counts = run.motion().counts();
  detail::warn_of_start(track, scene, start);
  detail::warn_of_motion(track, run.error(), run.motion().crossed(), run.motion().stuck());
  withhold(track, scene);
  return track;
}

/// Second order: started from the mean polhode, answered with the osculating one and so with M itself; below
/// `hand_over` breakdown momenta the full equations take over.
template <class Elliptic>
Track averaged_2_track(const Scene& scene, Monitor* monitor) {
  const auto [start, refusal] = detail::start_of(scene);
  if (refusal.failure != Errc::ok) return refusal;
  const auto& problem = scene.problem();
  const Vec3<double>& M0 = problem.momentum;
  const double norm0 = M0.norm();
  const auto b = ControlTorques<double>::of(problem.control, start.axes);
  const double u0 = argument_of<Elliptic>(start, M0);
  const auto away = oscillation<Elliptic>(start, b, norm0, u0);
  const auto mean = shifted(start, -away.spread);
  if (!mean.valid || !(std::abs(away.norm) < .5))
    return refused<Track>(Errc::separatrix, "one oscillation reaches the separatrix: there is no mean polhode");

  // The later the full equations take over, the less the mean ones err there and the more turns the full ones make.
  const double last_norm = hand_over_share(scene) * breakdown_momentum(problem, scene.greatest_control());
  if (!(last_norm < norm0 / 2))
    return refused<Track>(Errc::not_applicable,
                          "the braking is too fast: averaging would hand over to the full equations at the start");

  Track track;
  // A relative error of the mean orbit becomes one of the phase, times the turns made.
  const double tolerance = 1e-3 * AveragedRun<Elliptic>::tolerance_of(scene) + 1e-13;
  const double phase_error = std::max(1e-7, scene.question().tolerance * 1e-2);
  AveragedRun<Elliptic> run(scene, mean.polhode, norm0 * (1 - away.norm), u0 / Elliptic::complete(start.modulus).K,
                            tolerance, phase_error);
  const auto& times = scene.question().times;
  constexpr const char* lost = "the motion comes so near the separatrix that the second order is lost";
  if (!(times.front() > 0)) track.states.push_back(detail::state_on_orbit(problem, problem.momentum));
  while (track.states.size() < times.size()) {
    if (run.advance(times[track.states.size()], last_norm) != ode::Status::reached)
      return refused<Track>(Errc::no_convergence, "the mean equations could not be integrated");
    if (run.motion().crossed() || run.motion().stuck()) return refused<Track>(Errc::separatrix, lost);
    if (run.motion().floored()) break;
    const auto now = detail::osculating<Elliptic>(problem, run.motion().state());
    if (!now.valid) return refused<Track>(Errc::separatrix, lost);
    track.states.push_back(detail::slow_state(now.state));
    track.states.back().momentum = now.momentum;
  }
  const double energy0 = problem.energy(M0);
  const auto in_span = run.error().second_order();
  const auto oscillating = run.error().first_order(norm0, energy0);
  const double local = 10 * tolerance;
  const double lag = 10 * phase_error + local * std::abs(run.motion().state().phase);  // quarter periods
  detail::state_errors(track, {in_span.norm + local * norm0 + lag * oscillating.norm,
                               in_span.energy + 2 * local * energy0 + lag * oscillating.energy,
                               in_span.k2 + local + lag * oscillating.k2, 0});
  track.know_momentum(problem, in_span.vector + (local + 2 * lag) * norm0);
  track.counts = run.motion().counts();
  detail::warn_of_start(track, scene, start);

  // The tail, for the stop time and for the samples beyond the hand-over.
  if (!(scene.greatest_control() > 0)) {
    track.stop_time = infinity<double>;
  } else {
    const bool reached = run.advance(infinity<double>, last_norm) == ode::Status::reached;
    if (!reached || run.motion().crossed() || run.motion().stuck()) {
      if (track.states.size() < times.size()) return refused<Track>(Errc::separatrix, lost);
      track.warn(warning::crosses_separatrix, nan<double>,
                 "after the asked times the motion crosses the separatrix: no stop time");
    } else {
      const auto at_end = detail::osculating<Elliptic>(problem, run.motion().state());
      if (!at_end.valid) return refused<Track>(Errc::separatrix, lost);
      const Errc failure =
          hand_over(track, scene, at_end.momentum, run.motion().time(), run.error().second_order(), monitor);
      if (failure != Errc::ok) return refused<Track>(failure, "the full equations could not take over near rest");
      track.stop_error += 100 * tolerance;
    }
  }
  detail::warn_of_motion(track, run.error(), run.motion().crossed(), run.motion().stuck());
  withhold(track, scene);
  return track;
}

}  // namespace gyrostat::deceleration
