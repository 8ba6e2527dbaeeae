// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <span>
#include <utility>

#include "gyrostat/ladder/deceleration/full_motion.hpp"
#include "gyrostat/ladder/deceleration/track.hpp"
#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "gyrostat/models/deceleration/orbit.hpp"

namespace gyrostat::deceleration {

/// Kind and modulus of the free orbit through M.
struct OrbitKind {
  Regime regime = Regime::rest;
  double k2 = 0;
};

inline OrbitKind orbit_kind(const Problem<double>& problem, const Vec3<double>& M) noexcept {
  if (M.isZero(0) || M == problem.rotor_momentum) return {};
  if (problem.rotor_momentum.isZero(0)) {
    const auto p = polhode_through<double>(problem.inverse_inertia, M);
    if (!std::isfinite(p.modulus.k2)) return {Regime::point, 0};
    if (!(p.modulus.kp2 > 0)) return {Regime::separatrix, 1};
    return {p.regime, p.modulus.k2};
  }
  const auto orbit = Orbit<double>::through(problem, M);
  if (orbit) return {orbit->regime(), orbit->modulus().k2};
  return orbit.error() == Errc::separatrix ? OrbitKind{Regime::separatrix, 1} : OrbitKind{Regime::point, 0};
}

namespace detail {

/// How far the modulus at M can be off when |M| and the energy are off by the given errors, N m s and J: an error along
/// the orbit does not count.
inline double k2_uncertainty(const Problem<double>& problem, const Vec3<double>& M, const OrbitKind& at, double norm,
                             double energy) noexcept {
  if (at.regime == Regime::rest) return 0;
  const auto& a = problem.inverse_inertia;
  if (at.regime == Regime::point && (problem.rotor_momentum.isZero(0) || a[2] - a[0] <= 8 * epsilon<double> * a[2]))
    return 4 * epsilon<double>;
  const double R = M.norm();
  norm = std::max(norm, 2 * epsilon<double> * R);
  if (problem.rotor_momentum.isZero(0)) {
    const auto p = polhode_through<double>(problem.inverse_inertia, M);
    const double ratio = (2 * energy / R + 2 * p.energy_ratio() * norm) / R;  // of 2H/M^2
    const double tilt = ratio / p.axes.near_far;
    const double slope = p.axes.mid_far / (p.axes.near_mid * (1 - p.tilt) * (1 - p.tilt));
    const double k2 = slope * tilt + 4 * epsilon<double>;
    return k2 < 1 ? k2 : 1.0;
  }
  const auto level = level_of(problem, M);
  const double eta = (energy + (std::abs(level.eta) + problem.angular_velocity(M).norm()) * norm) / R;
  double most = 4 * epsilon<double>;
  for (const auto& moved :
       {Level<double>{R + norm, level.eta}, Level<double>{R, level.eta + eta}, Level<double>{R, level.eta - eta}}) {
    const auto orbit = Orbit<double>::at(problem, moved, {at.regime, 1});
    most += orbit ? std::abs(orbit->modulus().k2 - at.k2) : orbit.error() == Errc::separatrix ? 1 - at.k2 : 1.0;
  }
  return std::min(1.0, most);
}

inline const char* why_stopped(ode::Status status) noexcept {
  return status == ode::Status::cancelled ? "the caller stopped the work" : ode::message(status);
}

/// Fills the columns from momentum and attitude already in the track.
inline void complete_full_track(Track& track, const Problem<double>& problem, const FullMotionError<double>& error) {
  double size = 0, energy = 0;
  for (const auto& M : track.momentum) {
    size = std::max(size, M.norm());
    energy = std::max(energy, problem.energy(M));
    const OrbitKind kind = orbit_kind(problem, M);
    track.norm.push_back(M.norm());
    track.energy.push_back(problem.energy(M));
    track.k2.push_back(kind.k2);
    track.regime.push_back(kind.regime);
  }
  track.momentum_error = error.momentum * size;
  track.velocity_error = error.angular_velocity;
  track.norm_error = error.momentum_norm * size;
  track.energy_error = error.energy * energy;
  track.attitude_error = error.attitude;
  track.stop_error = error.stop_time;
  const std::size_t stride = 1 + track.momentum.size() / 64;  // the modulus varies slowly: some of the points tell
  for (std::size_t i = 0; i < track.momentum.size(); i += stride)
    track.k2_error = std::max(track.k2_error, k2_uncertainty(problem, track.momentum[i], {track.regime[i], track.k2[i]},
                                                             track.norm_error, track.energy_error));
}

}  // namespace detail

/// The full equations of a problem in principal axes at times >= 0, by Taylor series.
inline Track full_motion_track(const Problem<double>& problem, std::span<const double> times, double tolerance,
                               bool find_stop, const Quat<double>* attitude, Monitor* monitor) {
  Track track;
  track.momentum.resize(times.size());
  if (attitude) track.attitude.resize(times.size());
  FullMotionOptions<double> options;
  options.tolerance = tolerance;
  options.find_stop = find_stop;
  if (monitor) options.progress = &monitor->fraction, options.cancel = &monitor->cancel;
  const auto answer = full_motion<double>(problem, times, track.momentum, options, attitude, track.attitude);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), detail::why_stopped(answer->status));
  track.stop_time = answer->stop_time;
  track.counts = answer->counts;
  detail::complete_full_track(track, problem, answer->error);
  return track;
}

/// Rung `full`: the full equations.
inline Track full_track(const Scene& scene, Monitor* monitor) {
  const auto& data = scene.data();
  const auto& problem = scene.problem();
  if (data.full_equations) return data.full_equations(scene, monitor);
  // A stop far behind the last time asked for is not worth its cost.
  const double span = data.times.back();
  const Vec3<double> U =
      data.law == Law::total ? problem.momentum : Vec3<double>(problem.momentum - problem.rotor_momentum);
  const double longest = U.norm() / scene.least_control();
  const bool find_stop = longest <= 20 * span || longest * problem.inverse_inertia[2] * problem.momentum.norm() < 1e4;
  const Quat<double> q_IP = data.attitude * from_matrix(scene.R_BP());
  const auto at_tolerance = [&](double tolerance) {
    return full_motion_track(problem, data.times, tolerance, find_stop, data.wants_attitude ? &q_IP : nullptr, monitor);
  };
  Track track = at_tolerance(data.tolerance);
  // The modulus may need more digits of M than M itself was asked for.
  double tolerance = data.tolerance;
  for (int trial = 0; trial < 3 && track.failure == Errc::ok && track.k2_error > data.tolerance; ++trial) {
    const double excess = 4 * track.k2_error / data.tolerance;
    if (excess > 1e5 || tolerance <= 1e-13) break;
    tolerance = std::max(1e-13, tolerance / excess);
    Track finer = at_tolerance(tolerance);
    finer.counts += track.counts;
    track = std::move(finer);
  }
  return track;
}

}  // namespace gyrostat::deceleration
