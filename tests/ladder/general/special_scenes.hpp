// SPDX-License-Identifier: BSD-3-Clause
// Random general scenes that are exactly instances of a family, in the words of body, wheels and torques.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gyrostat/ladder/general/motion.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace general_scenes {

using namespace gyrostat;
using namespace gyrostat::general;

class SpecialScenes {
 public:
  explicit SpecialScenes(unsigned seed) : random_(seed) {}

  struct Made {
    Problem<double> problem;
    double span = 1;
  };

  /// An instance of the family; turns: about how many the body makes at most.
  Made of(Special family, double turns) {
    Made made;
    Problem<double>& p = made.problem;
    rate_ = scale(1e-2, 10);
    made.span = 2 * pi<double> / rate_ * scale(0.1, turns);
    p.attitude = unit() < 0.3 ? Quat<double>{} : attitude();
    p.mass = scale(1, 10);
    if (unit() < 0.5) p.velocity = direction(), p.position = direction();
    if (unit() < 0.3) p.field.gravity = 9.8;
    switch (family) {
      case Special::free: free_body(p); break;
      case Special::deceleration: braked(made); break;
      case Special::heavy: heavy(made); break;
      case Special::rotor: driven(p); break;
      default: thrusting(p);
    }
    if (unit() < 0.1) p.wheels.push_back(wheel(WheelType::locked, direction()));
    return made;
  }

  /// The same with torques that come and go and wheels whose rates step: an instance between these times alone.
  Made in_segments(Special family, double turns) {
    Made made = of(family, turns);
    Problem<double>& p = made.problem;
    if (unit() < 0.5) torque(p, TorqueType::constant, momentum_ * rate_ * scale(1e-3, 1) * direction());
    for (auto& each : p.torques) {
      const double from = made.span * unit(), length = made.span * scale(1e-2, 0.5);
      each.factor.on = {{from, from + length}};
      if (unit() < 0.3) each.factor.on.push_back({from + 2 * length, from + 3 * length});
    }
    for (auto& one : p.wheels) {
      if (one.type != WheelType::held || unit() < 0.5) continue;
      const double step = made.span * unit();
      one.table = {{0, step}, {one.rate, one.rate * scale(0.1, 3)}, Between::step, true};
    }
    return made;
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double scale(double low, double high) { return std::exp(std::log(low) + unit() * std::log(high / low)); }
  std::mt19937_64& random() { return random_; }
  Vec3<double> direction() {
    std::normal_distribution<double> normal;
    return Vec3<double>(normal(random_), normal(random_), normal(random_)).normalized();
  }
  Quat<double> attitude() {
    std::normal_distribution<double> normal;
    return normalised(Quat<double>{normal(random_), normal(random_), normal(random_), normal(random_)});
  }

 private:
  /// A body in its own axes or, with `turned`, in others; the axes are kept.
  void body(Problem<double>& p, bool symmetric, bool turned) {
    Vec3<double> second(scale(0.2, 3), scale(0.2, 3), scale(0.2, 3));
    if (symmetric) second[1] = second[0];
    axes_ = turned ? to_matrix(attitude()) : Mat3<double>(Mat3<double>::Identity());
    const Mat3<double> J = (second.sum() * Vec3<double>::Ones() - second).asDiagonal();
    p.inertia = turned ? Mat3<double>(axes_ * J * axes_.transpose()) : J;
    p.inertia = ((p.inertia + p.inertia.transpose()) / 2).eval();
    room_ = second.minCoeff();
    p.angular_velocity = rate_ * direction();
    momentum_ = p.inertia.trace() / 3 * rate_;
  }
  Wheel<double> wheel(WheelType type, const Vec3<double>& axis) {
    Wheel<double> made;
    made.type = type;
    made.axis = axis;
    made.axial_inertia = room_ * scale(1e-3, 0.1);
    made.rate =
        type == WheelType::locked ? 0 : momentum_ / made.axial_inertia * scale(1e-2, 1) * (unit() < 0.5 ? -1 : 1);
    made.angle = unit();
    return made;
  }
  WheelType spare() { return unit() < 0.5 ? WheelType::held : WheelType::free; }
  void torque(Problem<double>& p, TorqueType type, const Vec3<double>& vector) {
    auto& made = p.torques.emplace_back();
    made.type = type;
    made.vector = vector;
  }

  void free_body(Problem<double>& p) {
    body(p, unit() < 0.2, unit() < 0.5);
    p.fixed = unit() < 0.3;
    for (int i = int(4 * unit()); i > 0; --i) p.wheels.push_back(wheel(spare(), direction()));
    if (unit() < 0.2) p.rotor_momentum = 0.3 * momentum_ * direction();
    if (unit() < 0.3) torque(p, TorqueType::charge, 0.3 * momentum_ * direction());
    if (unit() < 0.2) {  // torques that cancel
      const Vec3<double> c = direction();
      torque(p, TorqueType::constant, c), torque(p, TorqueType::constant, -c);
    }
  }
  void braked(Made& made) {
    auto& p = made.problem;
    body(p, false, unit() < 0.5);
    p.fixed = unit() < 0.3;
    const bool carrier = unit() < 0.3;
    for (int i = int(3 * unit()); i > 0; --i)
      p.wheels.push_back(wheel(carrier ? WheelType::held : spare(), direction()));
    const double slow = scale(1e-4, 0.1) * rate_;
    if (unit() < 0.7) {
      auto& drag = p.torques.emplace_back();
      drag.type = TorqueType::damping;
      drag.opposed = carrier ? Opposed::carrier_momentum : Opposed::momentum;
      drag.matrix = slow * Mat3<double>::Identity();
    }
    if (p.torques.empty() || unit() < 0.5) {
      auto& brake = p.torques.emplace_back();
      brake.type = TorqueType::brake;
      brake.opposed = carrier && p.torques.size() > 1 ? Opposed::carrier_momentum : Opposed::momentum;
      const double size = slow * momentum_;
      brake.vector = unit() < 0.3 ? Vec3<double>(size * Vec3<double>::Ones())
                                  : Vec3<double>(size * scale(0.3, 1), size * scale(0.3, 1), size * scale(0.3, 1));
      made.span = std::min(made.span, 0.3 / slow);  // the full equations do not go through the stop
    }
  }
  void heavy(Made& made) {
    auto& p = made.problem;
    const double kind = unit();
    const bool symmetric = unit() < 0.4;
    body(p, symmetric, !symmetric && unit() < 0.4);
    const double weight = momentum_ * rate_ * scale(1e-2, 1);
    Vec3<double> arm = symmetric ? Vec3<double>(0, 0, 1) : direction();
    p.field.down = unit() < 0.5 ? Vec3<double>(0, 0, -1) : direction();
    if (kind < 0.6) {
      p.fixed = true;
      p.velocity.setZero(), p.position.setZero();
      p.centre_of_mass = std::sqrt(0.1 * room_ / p.mass) * arm;
      p.field.gravity = weight / p.mass / p.centre_of_mass.norm();
      torque(p, TorqueType::weight, {0, 0, 0});
    } else {
      p.field.magnetic = MagneticField::uniform;
      p.field.flux_density = 3e-5 * direction();
      torque(p, TorqueType::magnetic, weight / 3e-5 * arm);
    }
    if (kind > 0.4 && kind < 0.6 && !symmetric) {
      torque(p, TorqueType::gravity_gradient, {0, 0, 0});
      p.torques.back().gradient = rate_ * rate_ * scale(1e-3, 0.1);
    } else if (symmetric && unit() < 0.7) {  // a Lagrange gyrostat
      p.wheels.push_back(wheel(spare(), unit() < 0.5 ? arm : Vec3<double>(-arm)));
      if (unit() < 0.3) torque(p, TorqueType::charge, 0.3 * momentum_ * arm);
    }
    made.span = std::min(made.span, 20 / rate_);
  }
  void driven(Problem<double>& p) {
    body(p, false, unit() < 0.5);
    const Vec3<double> axis = unit() < 0.2 ? Vec3<double>(axes_.col(int(3 * unit()))).normalized() : direction();
    auto motor = wheel(unit() < 0.3 ? WheelType::friction : WheelType::motor, axis);
    const double slow = motor.axial_inertia * rate_ * scale(1e-3, 1);
    if (motor.type == WheelType::friction) motor.friction = slow;
    else motor.slope = slow, motor.no_load_rate = motor.rate * scale(0.1, 2);
    p.wheels.push_back(motor);
    if (unit() < 0.5) p.wheels.push_back(wheel(spare(), unit() < 0.5 ? axis : Vec3<double>(-axis)));
    if (unit() < 0.2) torque(p, TorqueType::charge, 0.3 * momentum_ * axis);
  }
  void thrusting(Problem<double>& p) {
    const bool turned = unit() < 0.4;
    body(p, false, turned);
    const int spin = int(3 * unit());
    const Vec3<double> e = axes_.col(spin).normalized();
    if (unit() < 0.6) p.angular_velocity = rate_ * (e + scale(1e-4, 0.3) * direction());
    const double size = momentum_ * rate_ * scale(1e-4, 0.1);
    if (unit() < 0.7) torque(p, TorqueType::constant, size * direction());
    if (p.torques.empty() || unit() < 0.6) {
      torque(p, TorqueType::thrust, size * direction());
      p.torques.back().point = direction();
      p.centre_of_mass = 0.1 * direction();
    }
    if (!turned && unit() < 0.5) {
      p.wheels.push_back(wheel(spare(), unit() < 0.5 ? e : Vec3<double>(-e)));
      if (unit() < 0.3) torque(p, TorqueType::charge, 0.3 * momentum_ * e);
    }
  }

  std::mt19937_64 random_;
  double rate_ = 1, room_ = 1, momentum_ = 1;
  Mat3<double> axes_ = Mat3<double>::Identity();
};

}  // namespace general_scenes
