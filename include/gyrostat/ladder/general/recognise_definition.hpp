// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "gyrostat/body/principal_axes.hpp"
#include "gyrostat/ladder/general/recognise.hpp"

namespace gyrostat::general {

namespace detail {

/// Each as_...: nullptr where the scene is an instance, else why it is none. dropped: raised to the greatest of what is dropped, in roundings.
inline const char* as_free(const Given& given, std::optional<free::Scene>& scene) {
  const auto& [problem, wheels, loads, spinners, question] = given;
  if (loads.other) return loads.other;
  if (!loads.quiet()) return "a torque acts on the body";
  if (spinners.why) return spinners.why;
  if (!spinners.spare) return "a wheel has friction or a motor";
  free::Assembly<double> assembly;
  assembly.body.inertia = wheels.whole;
  assembly.body.rotor_momentum = problem.rotor_momentum - loads.charge;
  assembly.body.angular_velocity = problem.angular_velocity;
  assembly.body.attitude = problem.attitude;
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    if (law.follows != Follows::body)
      assembly.wheels.push_back({law.axis, law.axial_inertia, law.rate, law.follows == Follows::constant});
  }
  const auto made = free::Scene::make(assembly, question);
  if (!made) return "no body of this inertia holds its wheels";
  scene = *made;
  return nullptr;
}

/// The factor by which a matrix is a multiple of another, to 8 roundings of `size`; NaN: it is none, or what is left of it times `per` is a torque that
/// matters.
inline double multiple_of(const Mat3<double>& m, const Mat3<double>& of, const Mat3<double>& size, const Loads& loads,
                          double per, double* dropped) noexcept {
  int i = 0;
  of.diagonal().cwiseAbs().maxCoeff(&i);
  const double factor = m(i, i) / of(i, i);
  return loads.drop(m - factor * of, size, per, dropped) ? factor : nan<double>;
}

inline const char* as_deceleration(const Given& given, std::optional<deceleration::Scene>& scene, double* dropped) {
  const auto& [problem, wheels, loads, spinners, question] = given;
  if (loads.other) return loads.other;
  if (!loads.damps() && !loads.brakes()) return "nothing brakes the body";
  if (!loads.body.isZero(0) || loads.weighs || !loads.charge.isZero(0))
    return "another torque acts beside brake and drag";
  if (spinners.why) return spinners.why;
  if (!spinners.spare) return "a wheel has friction or a motor";
  const bool carrier = !loads.damping.isZero(0), total = !loads.by_momentum.isZero(0);
  if (carrier && total) return "drag acts both on the carrier and on the whole";
  if (!loads.brake_total.isZero(0) && !loads.brake_carrier.isZero(0)) return "two brakes obey different laws";
  deceleration::Setup setup;
  if (!loads.brake_carrier.isZero(0)) setup.law = deceleration::Law::carrier;
  if (carrier) setup.drag_law = deceleration::Law::carrier;
  const bool on_carrier = carrier || setup.law == deceleration::Law::carrier;
  if (on_carrier && spinners.free)
    return "a wheel turns freely, and what brakes the carrier acts on it with that wheel locked";
  if (carrier)
    setup.drag = multiple_of(loads.damping, wheels.whole, loads.damping_size, loads, loads.extent.rate, dropped);
  if (total)
    setup.drag = multiple_of(loads.by_momentum, Mat3<double>::Identity(), loads.by_momentum_size, loads,
                             loads.extent.momentum, dropped);
  if (!(setup.drag >= 0))
    return carrier ? "the damping is not a positive multiple of the inertia"
                   : "the drag on the momentum is not the same about all axes, or drives";
  setup.control = setup.law == deceleration::Law::carrier ? loads.brake_carrier : loads.brake_total;
  setup.rotor_momentum = spinners.kept;
  setup.momentum = wheels.reduced * problem.angular_velocity + spinners.kept;
  setup.attitude = problem.attitude;
  setup.angular_velocity = problem.angular_velocity;
  const auto body = Inertia<double>::from_tensor(wheels.reduced);
  if (!body) return "without its free wheels the body breaks the triangle inequality";
  const auto made = deceleration::Scene::make(*body, setup, question);
  if (!made) return message(made.error());
  scene = *made;
  return nullptr;
}

/// down_alone: of what the attitude makes nothing else is asked for.
inline const char* as_heavy(const Given& given, bool down_alone, std::optional<HeavyInstance>& instance,
                            double* dropped) {
  const auto& [problem, wheels, loads, spinners, question] = given;
  if (loads.other) return loads.other;
  if (!loads.weighs) return "no weight, gradient or dipole in a field that stands still";
  if (!loads.body.isZero(0) || loads.damps() || loads.brakes()) return "another torque acts beside what stands still";
  if (spinners.why) return spinners.why;
  if (!spinners.spare) return "a wheel has friction or a motor";
  if (spinners.free && loads.gradient != 0)
    return "a wheel turns freely, and the gradient acts on the body with it locked";
  HeavyInstance made;
  const Vec3<double> l = spinners.kept - loads.charge;
  if (const double size = l.norm(); size > 0) {
    const Vec3<double> e = l / size;
    if (!symmetric_about(wheels.reduced, e, dropped) || !parallel(loads.moment, e, dropped))
      return "momentum of wheels, and neither body nor weight symmetric about it";
    made.turn = l / e.dot(wheels.reduced * e);
  }
  // the product of mass, gravity and arm alone counts: a body of little mass can always have it
  double mass = problem.mass, gravity = problem.field.gravity;
  Vec3<double> centre = problem.centre_of_mass;
  const bool own = vanishes(mass * gravity * centre - loads.moment, loads.moment.cwiseAbs());
  const auto make = [&] { return heavy::Body::make(wheels.reduced, mass, centre, gravity, loads.gradient); };
  Result<heavy::Body> body = own ? make() : Errc::not_applicable;
  if (!body) {
    const double moment = loads.moment.norm();
    mass = 1e-9 * wheels.reduced.trace();
    gravity = moment / mass;
    centre = moment > 0 ? Vec3<double>(loads.moment / moment) : Vec3<double>(0, 0, 0);
    body = make();
  }
  if (!body) return message(body.error());
  made.q_HI = to_heavy_axes(loads.direction);
  heavy::Start start;
  start.state.angular_velocity = problem.angular_velocity + made.turn;
  start.state.attitude = made.q_HI * problem.attitude;
  start.oriented = true;
  Question asked = question;
  made.down_alone = down_alone && loads.direction == problem.field.down;
  if (made.down_alone) asked.wants_attitude = false;
  const auto scene = heavy::Scene::make(*body, start, asked);
  if (!scene) return message(scene.error());
  made.scene = *scene;
  instance = made;
  return nullptr;
}

inline const char* as_rotor(const Given& given, std::optional<RotorInstance>& instance, double* dropped) {
  const auto& [problem, wheels, loads, spinners, question] = given;
  if (loads.other) return loads.other;
  if (!loads.quiet()) return "a torque acts on the body";
  if (spinners.why) return spinners.why;
  if (spinners.driven == -1) return "no wheel has friction or a motor";
  if (spinners.driven == -2) return "more than one wheel has friction or a motor";
  RotorInstance made;
  made.driven = std::size_t(spinners.driven);
  const auto& law = wheels.laws[made.driven];
  const Vec3<double> rest = spinners.kept - loads.charge;
  if (!parallel(rest, law.axis, dropped)) return "other momentum is not along the driven wheel";
  made.shift = rest.dot(law.axis) / law.axial_inertia;
  // without friction the rate that the motor was given by
  const auto& wheel = problem.wheels[made.driven];
  const double no_load = law.friction == wheel.slope ? wheel.no_load_rate : law.torque / law.friction;
  if (!(std::abs(no_load) <= 1e8)) return "the motor hardly feels its rate";
  const Mat3<double> J = wheels.reduced + law.axial_inertia * law.axis * law.axis.transpose();
  const bool alone = !spinners.free;  // then J is that of the whole, as it was given
  const auto body = rotor::Gyrostat<double>::make(alone ? wheels.whole : J, wheel.axis, law.axial_inertia, law.friction,
                                                  no_load + made.shift);
  if (!body) return message(body.error());
  const auto scene =
      rotor::Scene::make(*body, {problem.attitude, problem.angular_velocity, law.rate + made.shift}, question);
  if (!scene) return message(scene.error());
  made.scene = *scene;
  instance = made;
  return nullptr;
}

/// Moments, and the turn from body axes to principal ones.
struct SpinAxes {
  Vec3<double> moments;
  Mat3<double> R_SB;
};

/// The principal axes of which the given momenta are along one, that one the third; nothing where there is none.
inline std::optional<SpinAxes> spin_axes(const Mat3<double>& J, const Vec3<double>& l, const Vec3<double>& charge,
                                         const Vec3<double>& omega, double* dropped) noexcept {
  const auto [moments, axes, gaps] = PrincipalAxes<double>::nearest(J);
  int best = -1;
  double most = -1;
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> e = axes.col(i);
    if (!parallel(e, l) || !parallel(e, charge)) continue;
    if (const double spin = std::abs(e.dot(J * omega)); spin > most) best = i, most = spin;
  }
  if (best < 0) return std::nullopt;
  for (const auto& along : {l, charge}) parallel(axes.col(best), along, dropped);
  SpinAxes made;
  for (int row = 0; row < 3; ++row) {
    const int i = (best + 1 + row) % 3;
    made.moments[row] = moments[i];
    made.R_SB.row(row) = axes.col(i).transpose();
  }
  return made;
}

inline const char* as_spinning(const Given& given, std::optional<SpinningInstance>& instance, double* dropped) {
  const auto& [problem, wheels, loads, spinners, question] = given;
  if (loads.other) return loads.other;
  if (loads.damps() || loads.brakes() || loads.weighs) return "a torque that is not constant in the body acts";
  if (loads.body.isZero(0) && loads.force.isZero(0)) return "neither torque nor thrust";
  if (!loads.force_I.isZero(0)) return "a force is constant in space";
  if (spinners.why) return spinners.why;
  if (!spinners.spare) return "a wheel has friction or a motor";
  const auto axes = spin_axes(wheels.reduced, spinners.kept, loads.charge, problem.angular_velocity, dropped);
  if (!axes) return "momentum of wheels or charge is not along a principal axis";
  SpinningInstance made;
  made.R_SB = axes->R_SB;
  made.q_IS = problem.attitude * conjugate(from_matrix<double>(made.R_SB));
  spinning::Problem<double> p;
  p.inertia = axes->moments;
  p.converted = !wheels.reduced.isDiagonal(0);
  p.mass = problem.mass;
  p.rotor_momentum = made.R_SB.row(2).dot(spinners.kept);
  p.charge_momentum = made.R_SB.row(2).dot(loads.charge);
  p.torque = made.R_SB * loads.body;
  p.force = made.R_SB * loads.force;
  p.angular_velocity = made.R_SB * problem.angular_velocity;
  p.velocity = rotate<double>(conjugate(made.q_IS), problem.velocity);
  p.position = rotate<double>(conjugate(made.q_IS), problem.position);
  const auto scene = spinning::Scene::make(p, question);
  if (!scene) return message(scene.error());
  made.scene = *scene;
  instance = made;
  return nullptr;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Instances recognise(const Problem<double>& problem, const Wheels<double>& wheels,
                                           const Collected<double>& torques, const Sizes<double>& sizes,
                                           const Question& question) {
  const auto extent = detail::Extent::of(problem, sizes, question.times.back());
  const detail::Given given{problem, wheels, detail::Loads::of(problem, torques, extent), detail::Spinners::of(wheels),
                            detail::plain(question)};
  Instances found;
  found.charge = given.loads.charge;
  found.pushed = !given.loads.force.isZero(0) || !given.loads.force_I.isZero(0) || !torques.is_steady();
  const auto why = [&](Special special) -> const char*& { return found.why[std::size_t(special)]; };
  found.dropped.fill(given.loads.dropped);
  const auto dropped = [&](Special special) { return &found.dropped[std::size_t(special)]; };
  why(Special::free) = detail::as_free(given, found.free);
  why(Special::deceleration) = detail::as_deceleration(given, found.deceleration, dropped(Special::deceleration));
  why(Special::heavy) =
      detail::as_heavy(given, !detail::wants_attitude(question, column::down), found.heavy, dropped(Special::heavy));
  why(Special::rotor) = detail::as_rotor(given, found.rotor, dropped(Special::rotor));
  why(Special::spinning) = detail::as_spinning(given, found.spinning, dropped(Special::spinning));
  return found;
}

}  // namespace gyrostat::general
