// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "gyrostat/ladder/general/recognise.hpp"
#include "gyrostat/ladder/general/scene.hpp"

namespace gyrostat::general {

namespace detail {

/// The size that the parts of a torque have before they cancel, N m.
inline double size_of_torque(const Problem<double>& problem, const Torque<double>& torque, const Pose<double>& pose,
                             double t) noexcept {
  const auto& field = problem.field;
  switch (torque.type) {
    case TorqueType::weight: return problem.mass * field.gravity * problem.centre_of_mass.norm();
    case TorqueType::gravity_gradient:
      return std::abs(torque.gradient ? *torque.gradient : orbit_at(*problem.orbit, t).gradient) *
             problem.inertia.norm();
    case TorqueType::magnetic: return torque.vector.norm() * field_at(problem, t).flux_density.norm();
    case TorqueType::brake: return torque.vector.norm();
    case TorqueType::charge: return torque.vector.norm() * pose.angular_velocity.norm();
    default: return load_of(problem, torque, pose, t, t).torque.norm();
  }
}

GYROSTAT_COMPILED_ONCE double sum_of_torques(const Problem<double>& problem, const Pose<double>& pose,
                                             double t) noexcept {
  double sum = 0;
  for (const auto& torque : problem.torques)
    sum += std::abs(factor_at(torque.factor, t, t)) * size_of_torque(problem, torque, pose, t);
  return sum;
}

/// What is added up to a factor at t.
inline double terms_of_factor(const Factor<double>& factor, double t) noexcept {
  if (!factor.is_on(t)) return 0;
  const double wave = std::abs(factor.mean) + std::abs(factor.amplitude);
  return factor.table.times.empty() ? wave : wave * piece(factor.table, 1, 0, t).terms(t);
}

GYROSTAT_COMPILED_ONCE double terms_of_torques(const Problem<double>& problem, const Pose<double>& pose,
                                               double t) noexcept {
  double sum = 0;
  for (const auto& torque : problem.torques) {
    double size = size_of_torque(problem, torque, pose, t);
    if (torque.type == TorqueType::table)
      for (std::size_t column = 0; column < 3; ++column)
        size = std::max(size, piece(torque.table, 3, column, t).terms(t));
    sum += terms_of_factor(torque.factor, t) * size;
  }
  return sum;
}

/// What a table says from a time to its next one; nothing where it changes.
inline std::optional<double> steady_value(const Table<double>& table, std::size_t width, std::size_t column,
                                          double from) noexcept {
  const auto law = piece(table, width, column, from);
  return law.is_constant() ? std::optional(law.c[0]) : std::nullopt;
}

/// Puts a number for the table of a wheel's rate or torque where it is steady from a time to its next one; false: it is not.
inline bool make_steady(Wheel<double>& wheel, double from) noexcept {
  const auto value = steady_value(wheel.table, 1, 0, from);
  if (!value) return false;
  if (wheel.type == WheelType::held) wheel.rate = *value;
  else wheel.torque += *value;
  wheel.table = {};
  return true;
}

/// Tables of wheels that are steady over the whole span are numbers, which families know.
inline Problem<double> plainly(const Problem<double>& problem, double span) {
  Problem<double> made = problem;
  for (auto& wheel : made.wheels) {
    const auto& times = wheel.table.times;
    const bool breaks = std::any_of(times.begin(), times.end(), [&](double t) { return t > 0 && t < span; });
    if (!times.empty() && !breaks) make_steady(wheel, span / 2);
  }
  return made;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Result<Scene> Scene::make(const Problem<double>& problem, const Question& question,
                                                 bool recognised) {
  if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
  if (const Fault wrong = check(problem)) return wrong.code;
  Scene scene;
  scene.problem_ = detail::plainly(problem, question.times.back());
  scene.question_ = question;
  const Prepared<double> prepared(scene.problem_, question.times.back());
  scene.wheels_ = prepared.wheels;
  scene.sizes_ = prepared.sizes;
  const auto& sizes = scene.sizes_;
  if (!(sizes.turning < infinity<double>) || !(sizes.angle < infinity<double>) || !can_be_squared(sizes.least) ||
      !can_be_squared(sizes.greatest))
    return Errc::beyond_range;
  scene.large_ = prepared.is_large();
  scene.stiff_ = prepared.is_stiff();
  scene.settling_rate_ = prepared.settling.fastest();
  scene.breaks_ = breakpoints(scene.problem_, question.times.back()).size();
  scene.recognised_ = recognised;
  if (recognised) scene.instances_ = recognise(scene.problem_, prepared.wheels, prepared.torques, sizes, question);
  return scene;
}

GYROSTAT_COMPILED_ONCE ColumnErrors Scene::scales() const noexcept {
  constexpr double share = 1e-3;
  const auto& p = problem_;
  const double omega = p.angular_velocity.norm(), most = symmetric_eigen<double>(wheels_.whole).values[2];
  double momenta = (wheels_.whole * p.angular_velocity).norm() + p.rotor_momentum.norm(), fastest = omega;
  for (std::size_t i = 0; i < wheels_.count; ++i) {
    const auto& law = wheels_.laws[i];
    momenta += law.axial_inertia * std::abs(law.rate);
    fastest = std::max(fastest, std::abs(law.rate));
  }
  if (momenta == 0) momenta = sizes_.momentum();
  const Vec3<double> M = wheels_.reduced * p.angular_velocity + wheels_.momentum_of_wheels();
  const Flow<double> flow(p, wheels_);
  const double T = question_.times.back();
  const auto torques_at = [&](double t) { return detail::sum_of_torques(p, {p.attitude, p.angular_velocity, M}, t); };
  double torques = torques_at(0) + own_torque_(0, seen_of(flow.state(0, flow.start()))).norm();
  if (torques == 0)
    for (const double t : breakpoints(p, T)) torques = std::max(torques, torques_at(t));
  // a wave that begins at zero, a gradient on an aligned body: it is there all the same
  torques = std::max(torques, share * sizes_.external);
  const Vec3<double> g = p.fixed ? Vec3<double>(0, 0, 0) : Vec3<double>(p.field.gravity * p.field.down);
  ColumnErrors scale;
  scale[column::angular_velocity] = omega > 0 ? omega : share * momenta / most;
  scale[column::angular_momentum] = scale[column::angular_momentum_inertial] = scale[column::angular_momentum_norm] =
      share * momenta;
  scale[column::energy] = share * momenta / most * momenta / 2;
  scale[column::rotor_rate] = share * (fastest > 0 ? fastest : momenta / most);
  scale[column::rotor_angle] = share;
  scale[column::velocity] = p.velocity.norm() + g.norm() * T;
  scale[column::position] = p.position.norm() + (p.velocity.norm() + g.norm() * T) * T;
  scale[column::down] = 1;
  scale[column::torque] = share * torques;
  scale[column::euler] = 1;
  return scale;
}

}  // namespace gyrostat::general
