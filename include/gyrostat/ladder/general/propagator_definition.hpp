// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "gyrostat/body/inertia.hpp"
#include "gyrostat/core/double_double.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"
#include "gyrostat/ladder/general/propagator.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"

namespace gyrostat::general {

GYROSTAT_COMPILED_ONCE const char* Propagator::clock_needed(const Problem<double>& problem) noexcept {
  for (const auto& wheel : problem.wheels)
    if (!wheel.table.times.empty()) return "the rate or torque of a wheel changes with time";
  const auto torques = Collected<double>::of(problem, infinity<double>);
  if (!torques.is_steady()) return "a torque changes with time";
  const Terms<double>& sum = torques.steady().sum;
  for (const auto& each : sum.orbital)
    if (!each.isZero(0)) return "a torque is given in the axes of an orbit";
  if (sum.orbit_gradient != 0) return "the gravity gradient turns with an orbit";
  const bool currents_in_moving = !sum.eddy.isZero(0) && problem.field.magnetic != MagneticField::uniform;
  if (!sum.dipole.isZero(0) || currents_in_moving) return "the magnetic field moves";
  return nullptr;
}

GYROSTAT_COMPILED_ONCE Result<Propagator> Propagator::make(const Problem<double>& problem, double tolerance) {
  if (const Fault wrong = check(problem)) return wrong.code;
  if (!(tolerance > 0 && tolerance < 1)) return Errc::out_of_domain;
  if (clock_needed(problem) != nullptr) return Errc::not_applicable;
  const Prepared<double> prepared(problem, 1);
  if (!can_be_squared(prepared.sizes.least) || !can_be_squared(prepared.sizes.greatest)) return Errc::beyond_range;
  Propagator made;
  made.problem_ = problem;
  made.problem_.velocity = made.problem_.position = {0, 0, 0};
  made.wheels_ = prepared.wheels;
  made.tolerance_ = tolerance;
  made.closed_ = made.find_closed_form();
  return made;
}

GYROSTAT_COMPILED_ONCE Errc Propagator::advance(double dt, Moving& state, MovedError* error) const noexcept {
  if (const Errc wrong = check_state(dt, state); wrong != Errc::ok) return wrong;
  Moving begin = state;
  begin.attitude = as_unit(state.attitude);
  if (dt == 0) {
    state = begin;
    if (error != nullptr) *error = {4 * epsilon<double>, 0, 0};
    return Errc::ok;
  }
  constexpr double lost = 0.05;  // rad
  if (epsilon<double> * state.angular_velocity.norm() * dt > lost) return Errc::undetermined;
  // nor does anyone know a rate that is below a rounding of what wheels turn the body with
  if (epsilon<double> * momenta_of(state) * dt > wheels_.whole.norm()) return Errc::undetermined;
  if (closed_)
    if (const auto done = advance_freely(dt, begin, state, error)) return *done;
  return advance_fully(dt, begin, state, error);
}

GYROSTAT_COMPILED_ONCE bool Propagator::find_closed_form() const noexcept {
  if (Collected<double>::of(problem_, infinity<double>).steady().sum.any_torque()) return false;
  for (std::size_t i = 0; i < wheels_.count; ++i)
    if (wheels_.laws[i].follows > Follows::constant) return false;
  return Inertia<double>::check_tensor(wheels_.reduced) == Errc::ok;
}

GYROSTAT_COMPILED_ONCE Errc Propagator::check_state(double dt, const Moving& state) const noexcept {
  const double length = norm(state.attitude);
  if (!std::isfinite(dt) || !std::isfinite(length) || !state.angular_velocity.allFinite()) return Errc::not_finite;
  if (dt < 0) return Errc::negative;
  if (!(std::abs(length - 1) <= 1e-6)) return Errc::out_of_domain;
  for (std::size_t i = 0; i < wheels_.count; ++i) {
    const double rate = state.rotor_rate[i];
    if (!std::isfinite(rate * rate)) return Errc::not_finite;
    if (wheels_.laws[i].follows == Follows::body && state.rotor_rate[i] != 0) return Errc::out_of_domain;
  }
  return Errc::ok;
}

GYROSTAT_COMPILED_ONCE double Propagator::momenta_of(const Moving& state) const noexcept {
  double sum = problem_.rotor_momentum.norm();
  for (std::size_t i = 0; i < wheels_.count; ++i) sum += wheels_.laws[i].axial_inertia * std::abs(state.rotor_rate[i]);
  return sum;
}

GYROSTAT_COMPILED_ONCE Propagator::Assembly<double> Propagator::assembly_of(const Moving& state) const noexcept {
  Assembly<double> made;
  made.body.inertia = wheels_.whole;
  made.body.rotor_momentum = problem_.rotor_momentum;
  made.body.angular_velocity = state.angular_velocity;
  made.body.attitude = state.attitude;
  for (std::size_t i = 0; i < wheels_.count; ++i) {
    const auto& law = wheels_.laws[i];
    if (law.follows == Follows::body) continue;
    made.wheels.push_back({law.axis, law.axial_inertia, state.rotor_rate[i], law.follows == Follows::constant});
  }
  return made;
}

GYROSTAT_COMPILED_ONCE std::optional<Errc> Propagator::advance_freely(double dt, const Moving& begin, Moving& state,
                                                                      MovedError* error) const noexcept {
  const auto assembly = assembly_of(begin);
  auto motion = free::Motion<double>::make(free::Reduced<double, Room>::taken(assembly).problem);
  const auto quick = motion ? free::MotionError<double>::quick(*motion, assembly, dt) : std::nullopt;
  const bool suffices = quick && quick->at(dt).attitude < quick_share * tolerance_;
  if (!suffices)
    motion = free::Motion<double>::make<DoubleDouble>(free::Reduced<DoubleDouble, Room>::taken(assembly).problem);
  if (!motion) return {};
  using free::MotionError;
  const auto known = [&] {
    return suffices ? *quick : MotionError<double>::of<DoubleDouble>(*motion, assembly, free::Data::rounded, dt);
  };
  // wheels may turn the body far faster than it starts, and a slim one turns faster than its momentum tells
  const double wheels = momenta_of(begin), inertia = assembly.body.inertia.norm();
  const double whole = inertia * begin.angular_velocity.norm() + wheels;
  const bool doubtful = epsilon<double> * whole * wheels_.inverse.norm() * dt > 1e-6;
  if (doubtful && !(known().at(dt).attitude < 1)) return Errc::undetermined;
  const auto there = motion->at(dt);
  state = {there.attitude, there.angular_velocity, begin.rotor_rate};
  double free_wheels = 0, fastest = there.angular_velocity.norm();
  for (std::size_t i = 0; i < wheels_.count; ++i) {
    const auto& law = wheels_.laws[i];
    fastest = std::max(fastest, std::abs(begin.rotor_rate[i]) + begin.angular_velocity.norm());
    if (law.follows != Follows::constant) continue;
    const Vec3<double> change = begin.angular_velocity - there.angular_velocity;
    state.rotor_rate[i] = begin.rotor_rate[i] + law.axis.dot(change);
    free_wheels += 1;
  }
  if (error == nullptr) return Errc::ok;
  const auto estimate = known();
  const auto bound = estimate.at(dt);
  error->attitude = bound.attitude;
  error->angular_velocity = bound.angular_velocity * estimate.fastest();
  const double off = error->angular_velocity + 8 * epsilon<double> * fastest;
  error->rotor_rate = free_wheels > 0 ? std::sqrt(free_wheels) * off : 0.0;
  return Errc::ok;
}

GYROSTAT_COMPILED_ONCE Errc Propagator::advance_fully(double dt, const Moving& begin, Moving& state,
                                                      MovedError* error) const noexcept {
  Problem<double> problem = problem_;
  problem.attitude = begin.attitude;
  problem.angular_velocity = begin.angular_velocity;
  for (std::size_t i = 0; i < wheels_.count; ++i) problem.wheels[i].rate = begin.rotor_rate[i];
  FullErrors<double> wanted = FullErrors<double>::all(infinity<double>);
  for (const auto column : {full_column::attitude, full_column::angular_velocity, full_column::rotor_rate})
    wanted[column] = tolerance_;
  FullMotionOptions<double> options;
  options.tolerance = tolerance_;
  options.wanted = wanted.of;
  options.step_cap = step_cap;
  State<double> there;
  const std::array<double, 1> times{dt};
  const auto made = full_motion<double>(problem, times, std::span<State<double>>(&there, 1), options);
  if (!made) return made.error();
  if (made->status == ode::Status::event) return Errc::not_applicable;
  if (made->status != ode::Status::reached) return failure_of(made->status);
  state = {there.attitude, there.angular_velocity, begin.rotor_rate};
  for (std::size_t i = 0; i < wheels_.count; ++i) state.rotor_rate[i] = there.rotor_rate[i];
  if (error == nullptr) return Errc::ok;
  const FullRow<double> row(Prepared<double>(problem, dt));
  double square = 0;
  for (const double rate : there.rotor_rate) square += rate * rate;
  const auto absolute = [&](std::size_t column, double size) noexcept {
    return made->error[column] * std::max(size, row.scale[column]);
  };
  error->attitude = made->error[full_column::attitude];
  error->angular_velocity = absolute(full_column::angular_velocity, there.angular_velocity.norm());
  error->rotor_rate = wheels_.count == 0 ? 0.0 : absolute(full_column::rotor_rate, std::sqrt(square));
  return Errc::ok;
}

}  // namespace gyrostat::general
