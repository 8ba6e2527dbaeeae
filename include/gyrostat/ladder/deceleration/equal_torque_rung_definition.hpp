// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "gyrostat/ladder/deceleration/equal_torque_rung.hpp"

namespace gyrostat::deceleration {

namespace detail {

inline EqualTorqueLaw<double> equal_torque_law(const Scene& scene) noexcept {
  const auto& problem = scene.problem();
  return {problem.control(0, 0), problem.drag, problem.momentum.norm()};
}

/// The scene's body and start, as they were given.
inline free::Problem<double> unbraked_body(const Scene& scene) noexcept {
  const Setup& given = scene.setup();
  free::Problem<double> body;
  body.inertia = scene.inertia();
  body.momentum_given = !given.angular_velocity;
  body.angular_momentum = given.momentum;
  if (given.angular_velocity) body.angular_velocity = *given.angular_velocity;
  body.attitude = normalised(given.attitude);
  return body;
}

/// About what M will err, relatively, up to the last time where the free motion is set up in double: the rounding of the start grows with the
/// turn, and as 1/kp2 near the separatrix; that of the moments counts the more the nearer they are to each other. What it does err shows then.
inline double rounding_in_double(const Scene& scene) noexcept {
  const auto& problem = scene.problem();
  const auto p = polhode_through<double>(problem.inverse_inertia, problem.inverse_gaps(), problem.momentum);
  if (!std::isfinite(p.modulus.k2) || !std::isfinite(p.modulus.kp2)) return 8 * epsilon<double>;  // M stays
  const auto& x = p.axes;
  const double turn =
      p.rate_per_momentum() * problem.momentum.norm() * equal_torque_law(scene).clock(scene.question().times.back());
  const double gap = x.axisymmetric() ? x.near_mid : std::min(x.near_mid, x.mid_far);
  const double sphere = problem.inverse_inertia[2] / x.near_far;  // of the set-up
  double data = epsilon<double> * (3 + 3 * std::sqrt(x.near_far / gap) + 4 * sphere);
  if (!problem.exact_moments) {
    const Vec3<double> off = problem.gap_errors();
    const double near_mid = off[x.near / 2] / x.near_mid;
    data += near_mid + p.tilt / p.along * (off[1 - x.near / 2] + x.mid_far * near_mid) / x.near_mid;
  }
  return data * (2 + turn) / p.modulus.kp2;
}

/// What the angular velocity errs since columns take it from M by moments that come from a tensor and err as the greatest does, rad/s.
inline double velocity_rounding(const Problem<double>& problem) noexcept {
  const double slim = problem.exact_moments ? 1 : problem.inverse_inertia[2] / problem.inverse_inertia[0];
  return 8 * epsilon<double> * slim * problem.angular_velocity(problem.momentum).norm();
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Unbraked unbraked_motion(const Scene& scene) noexcept {
  if (scene.question().wants_attitude) return Unbraked::in_two;
  const auto goal = scene.goal();
  if (!(std::min(goal.columns[column::angular_momentum], goal.columns[column::angular_velocity]) < infinity<double>))
    return Unbraked::not_needed;
  const auto& problem = scene.problem();
  const double M = detail::rounding_in_double(scene), omega = problem.angular_velocity(problem.momentum).norm();
  const double faster = problem.inverse_inertia[2] * problem.momentum.norm() / omega;
  return M <= goal.columns[column::angular_momentum] && M * faster <= goal.columns[column::angular_velocity]
             ? Unbraked::in_double
             : Unbraked::in_two;
}

namespace detail {

/// Follows M, and with two words the attitude. Errors: those of free::Motion::make; not_applicable where a double does not do.
template <Real Setup>
Errc follow_unbraked(Track& track, const Scene& scene) {
  constexpr bool in_two = !std::is_same_v<Setup, double>;
  const auto& problem = scene.problem();
  const auto& times = scene.question().times;
  const free::Assembly<double> given{unbraked_body(scene), {}};
  const auto made =
      EqualTorqueMotion<double>::make<Setup>(given.body.template cast<Setup>(), problem.control(0, 0), problem.drag);
  if (!made) return made.error();
  const auto& law = made->law();
  const Mat3<double> R_PB = scene.R_BP().transpose();
  const Quat<double> q_BP = from_matrix(scene.R_BP());
  const double last =
      law.clock(times.back());  // next to the stop rounding may put a time before the last one behind it
  const double horizon = last + law.clock_error(last);
  std::optional<free::MotionError<double>> known;
  if constexpr (in_two)
    known = free::MotionError<double>::of<Setup>(made->unbraked(), given, free::Data::rounded, horizon);
  else known = free::MotionError<double>::quick(made->unbraked(), given, horizon);
  if (!known) return Errc::not_applicable;
  double momentum = 0, velocity = 0, attitude = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto now = made->at(times[i]);
    State<double>& state = track.states[i];
    state.momentum = R_PB * now.angular_momentum;
    state.attitude = now.unbraked.attitude * q_BP;
    const auto bound = known->at(now.tau);
    const Vec3<double>&M = now.unbraked.angular_momentum, &omega = now.unbraked.angular_velocity;
    const Vec3<double> flow = R_PB * cross<double>(M, omega);
    const double late = law.clock_error(now.tau);
    const double slower = now.norm / made->unbraked().angular_momentum_norm();
    const double rounding = 10 * epsilon<double> * made->unbraked().cancellation(now.tau);
    momentum = std::max(momentum, now.norm * bound.angular_momentum + slower * flow.norm() * late);
    velocity = std::max(
        velocity, slower * (known->fastest() * bound.angular_velocity + problem.angular_velocity(flow).norm() * late) +
                      now.norm * rounding * problem.inverse_inertia[2]);
    attitude = std::max(attitude, bound.attitude + omega.norm() * late);
  }
  constexpr double turned = 8 * epsilon<double>;  // into principal axes and back
  track.knows_momentum = true;
  track.knows_attitude = in_two && scene.question().wants_attitude;
  track.error[column::attitude] = attitude + turned;
  track.error[column::angular_momentum] = momentum + turned * problem.momentum.norm();
  track.error[column::angular_velocity] = velocity + velocity_rounding(problem);
  if (in_two) return Errc::ok;
  const auto goal = scene.goal();
  const double M = problem.momentum.norm(), omega = problem.angular_velocity(problem.momentum).norm();
  return track.error[column::angular_momentum] <= goal.columns[column::angular_momentum] * M &&
                 track.error[column::angular_velocity] <= goal.columns[column::angular_velocity] * omega
             ? Errc::ok
             : Errc::not_applicable;
}

/// How far |M| may be off at the start, relative: taken from omega by a tensor it errs as the greatest moment does.
inline double norm_rounding(const Scene& scene) noexcept {
  const auto& problem = scene.problem();
  return 8 * epsilon<double> + problem.momentum_error() / problem.momentum.norm();
}

/// What |M| and the start tell: all but M, omega and the attitude.
inline Track follow_norm(const Scene& scene) {
  const auto& problem = scene.problem();
  const auto law = equal_torque_law(scene);
  const double norm = problem.momentum.norm(), energy = problem.energy(problem.momentum);
  const OrbitKind kind = orbit_kind(problem, problem.momentum);
  const auto p = polhode_through<double>(problem.inverse_inertia, problem.inverse_gaps(), problem.momentum);
  Track track;
  for (const double t : scene.question().times) {
    State<double> state;
    state.norm = law.norm(t);
    state.energy = energy * (state.norm / norm) * (state.norm / norm);
    if (t < law.stop_time())  // |M| may underflow long before
      state.k2 = kind.k2, state.regime = kind.regime;
    track.states.push_back(state);
  }
  track.stop_time = law.stop_time();
  track.stop_error = norm_rounding(scene);
  track.error[column::angular_momentum_norm] = track.stop_error * norm;
  track.error[column::energy] = 16 * epsilon<double> * energy + problem.energy_error(problem.momentum);
  track.error[column::modulus_squared] =
      kind.regime == Regime::point ? (problem.exact_moments ? 0 : 1) : 2 * k2_of_data(problem, p, problem.momentum);
  double& of_modulus = track.error[column::modulus_squared];
  for (const double t : scene.question().times)  // that of the orbit, or of rest
    if (track.may_be_at_stop(t)) of_modulus = std::max(of_modulus, kind.k2);
  return track;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track equal_torque_track(const Scene& scene, Monitor*) {
  if (!scene.equal_control()) return refused<Track>(Errc::not_applicable, "the control torques are not equal");
  if (scene.has_rotor())
    return refused<Track>(Errc::not_applicable, "with rotor momentum only |M| has a closed form, not the energy");
  if (!(scene.problem().momentum.norm() > 0))
    return refused<Track>(Errc::not_applicable, "the body is at rest at the start");

  Track track = detail::follow_norm(scene);
  const Unbraked wanted = unbraked_motion(scene);
  Errc failure = Errc::ok;
  if (wanted == Unbraked::in_double) failure = detail::follow_unbraked<double>(track, scene);
  if (wanted == Unbraked::in_two || failure != Errc::ok) failure = detail::follow_unbraked<DoubleDouble>(track, scene);
  if (failure != Errc::ok) return refused<Track>(failure, message(failure));
  return track;
}

}  // namespace gyrostat::deceleration
