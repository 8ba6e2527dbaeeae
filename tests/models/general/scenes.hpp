// SPDX-License-Identifier: BSD-3-Clause
// Random general scenes of every kind.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace general_scenes {

using namespace gyrostat;
using namespace gyrostat::general;

struct Made {
  Problem<double> problem;
  double span = 1;
  std::string kind;
};

class Scenes {
 public:
  explicit Scenes(unsigned seed) : random_(seed) {}

  /// turns: about how many the body makes at most.
  Made next(double turns) {
    for (;;) {
      Made made;
      body(made);
      const int torques = unit() < 0.2 ? 0 : 1 + int(6 * unit());
      surroundings(made.problem);
      span_ = 2 * pi<double> / rate_ * scale(0.1, turns);
      const int wheels = unit() < 0.4 ? 0 : 1 + int(8 * unit());
      for (int i = 0; i < wheels; ++i) made.problem.wheels.push_back(wheel(wheels));
      for (int i = 0; i < torques; ++i) made.problem.torques.push_back(torque(made));
      if (check(made.problem)) continue;
      // no longer than what the torques make of it allows
      const auto of = Wheels<double>::of(made.problem);
      const auto sizes = sizes_of(made.problem, of, Collected<double>::of(made.problem, span_), span_);
      made.span = std::min(span_, 2 * pi<double> / sizes.turning * 3 * turns);
      return made;
    }
  }

  /// A scene in which wheels settle `times` times over the span, or some of them more slowly.
  Made stiff(double turns, double times) {
    for (;;) {
      Made made = next(turns);
      auto& p = made.problem;
      int fast = 0;
      for (auto& wheel : p.wheels) {
        if (wheel.type == WheelType::locked || wheel.type == WheelType::held) continue;
        const double friction = wheel.axial_inertia / made.span * times * (fast++ > 0 ? scale(1e-5, 1) : 1);
        // a wheel keeps the rate that its motor would bring it to
        if (wheel.type == WheelType::torque || wheel.type == WheelType::free) wheel.type = WheelType::friction;
        if (wheel.type == WheelType::motor) wheel.slope = friction, wheel.friction *= 1e-2;
        else wheel.friction = friction, wheel.torque = 0, wheel.table = {};
        if (wheel.type == WheelType::friction && unit() < 0.5) {
          wheel.type = WheelType::torque;
          wheel.torque = friction * wheel.rate * scale(0.1, 2);
          if (unit() < 0.5) wheel.table = table(1, wheel.torque);
        }
      }
      if (fast == 0 || check(p)) continue;
      made.kind += " stiff";
      return made;
    }
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double scale(double low, double high) { return std::exp(std::log(low) + unit() * std::log(high / low)); }
  std::mt19937_64& random() { return random_; }

 private:
  void body(Made& made) {
    auto& p = made.problem;
    Vec3<double> second(scale(0.2, 3), scale(0.2, 3), scale(0.2, 3));
    Mat3<double> turn = to_matrix(attitude());
    made.kind = "generic";
    const double which = unit();
    if (which < 0.15) made.kind = "exact axes", turn.setIdentity();
    else if (which < 0.25) made.kind = "symmetric", second[1] = second[0], turn.setIdentity();
    else if (which < 0.3) made.kind = "sphere", second = second[0] * Vec3<double>::Ones(), turn.setIdentity();
    else if (which < 0.38) made.kind = "slim", second[int(3 * unit())] *= scale(10, 1e4);
    // kilogrammes of a grain and of an asteroid, turns a year and a million a second
    if (unit() < 0.15) second *= scale(1e-20, 1e20);
    rate_ = unit() < 0.85 ? scale(1e-2, 1e2) : scale(1e-7, 1e7);
    const Mat3<double> E = Mat3<double>::Identity();
    p.inertia = turn * (second.sum() * E - Mat3<double>(second.asDiagonal())) * turn.transpose();
    p.inertia = ((p.inertia + p.inertia.transpose()) / 2).eval();
    room_ = second.minCoeff();
    p.mass = scale(1, 10), p.centre_of_mass = 0.1 * direction();
    p.fixed = unit() < 0.35;
    p.attitude = unit() < 0.2 ? Quat<double>{} : attitude();
    p.angular_velocity = rate_ * direction();
    const double start = unit();
    if (start < 0.06) made.kind += " at rest", p.angular_velocity.setZero();
    else if (start < 0.1) made.kind += " nearly at rest", p.angular_velocity *= scale(1e-12, 1e-3);
    else if (start < 0.18) made.kind += " about an axis", p.angular_velocity = rate_ * turn.col(int(3 * unit()));
    momentum_ = p.inertia.trace() / 3 * rate_;
    if (unit() < 0.2) p.rotor_momentum = momentum_ * scale(1e-2, 3) * direction();
    if (unit() < 0.3) p.velocity = direction(), p.position = direction();
  }

  void surroundings(Problem<double>& p) {
    if (unit() < 0.5) {
      auto& orbit = p.orbit.emplace();
      orbit.radius = 7e6;
      const double n = rate_ * scale(0.01, 1);
      orbit.mu = n * n * 7e6 * 7e6 * 7e6;
      if (unit() < 0.5) orbit.eccentricity = 0.6 * unit(), orbit.true_anomaly = 6 * unit();
      const Mat3<double> axes = to_matrix(attitude());
      orbit.radial = axes.col(0), orbit.along = axes.col(1);
    }
    auto& field = p.field;
    field.gravity = unit() < 0.3 ? 9.8 : 0;
    if (unit() < 0.5) field.down = direction();
    field.magnetic = static_cast<MagneticField>(1 + int((p.orbit ? 3 : 2) * unit()));
    field.flux_density = 3e-5 * direction(), field.axis = direction();
    field.rate = rate_ * scale(0.01, 3), field.strength = 3e-5, field.radius = 6.5e6;
  }

  /// A torque of the size that matters, N m.
  double push() { return momentum_ * rate_ * scale(1e-4, 0.5); }

  Table<double> table(std::size_t width, double size) {
    Table<double> made;
    made.between = static_cast<Between>(int(3 * unit()));
    made.holds = unit() < 0.5;
    const int count = 2 + int(4 * unit());
    double t = span_ * (unit() - 0.3);
    for (int i = 0; i < count; ++i) {
      made.times.push_back(t);
      t += span_ * scale(0.03, 0.5);
      for (std::size_t k = 0; k < width; ++k) made.values.push_back(size * (2 * unit() - 1));
    }
    return made;
  }

  Wheel<double> wheel(int count) {
    Wheel<double> w;
    w.type = static_cast<WheelType>(int(6 * unit()));
    w.axis = unit() < 0.3 ? Vec3<double>(Vec3<double>::Unit(int(3 * unit()))) : direction();
    // now and then the body is little more than its wheels
    w.axial_inertia = room_ * (unit() < 0.9 ? scale(1e-3, 0.5) / count : 1.9);
    if (w.type == WheelType::locked) return w;
    const double fast = momentum_ / w.axial_inertia / count;
    w.rate = fast * scale(1e-3, 3) * (unit() < 0.5 ? -1 : 1);
    if (unit() < 0.1) w.rate = 0;
    w.angle = unit() < 0.5 ? 0 : unit();
    if (w.type == WheelType::torque) w.torque = push() / count;
    const double settling = w.axial_inertia * rate_;
    if (w.type == WheelType::friction || unit() < 0.3) w.friction = settling * scale(1e-4, 3);
    if (w.type == WheelType::motor) w.slope = settling * scale(1e-4, 3), w.no_load_rate = fast * scale(1e-2, 2);
    if (w.type == WheelType::torque && unit() < 0.3) w.table = table(1, push() / count);
    if (w.type == WheelType::held && unit() < 0.4) w.table = table(1, fast * scale(1e-2, 1));
    return w;
  }

  Mat3<double> tensor(double size) {
    if (unit() < 0.4) return size * Mat3<double>::Identity();
    Mat3<double> m;
    for (int i = 0; i < 3; ++i) m.col(i) = 0.5 * size * direction();
    return size * Mat3<double>::Identity() + 0.5 * m;
  }

  void factor(Torque<double>& torque) {
    auto& f = torque.factor;
    const double which = unit();
    if (which < 0.2) {
      const double from = span_ * (unit() - 0.2), to = from + span_ * scale(0.05, 1);
      f.on = {{from, to}};
      if (unit() < 0.5) f.on.push_back({to + 0.05 * span_, to + span_ * scale(0.1, 1)});
    } else if (which < 0.35 && torque.type != TorqueType::table) {
      f.table = table(1, 1);
    }
    if (unit() < 0.25) {
      f.mean = unit() < 0.5 ? 0 : unit(), f.amplitude = unit();
      f.rate = rate_ * scale(0.03, 100), f.phase = 6 * unit();
      // the faster a wave, the more it takes for it to show
      if (f.rate > rate_) f.amplitude *= std::sqrt(f.rate / rate_);
      if (torque.type == TorqueType::brake) f.mean = 1, f.amplitude = 0.5 * unit();
    }
  }

  Torque<double> torque(const Made& made) {
    const auto& p = made.problem;
    Torque<double> t;
    t.type = static_cast<TorqueType>(int(10 * unit()));
    t.axes = static_cast<Axes>(int((p.orbit ? 3 : 2) * unit()));
    t.opposed = static_cast<Opposed>(int(3 * unit()));
    const double tau = push();
    switch (t.type) {
      case TorqueType::constant: t.vector = tau * direction(); break;
      case TorqueType::table: t.table = table(3, tau); break;
      case TorqueType::damping: {
        const double size = scale(1e-3, 0.3) / span_ * std::min(1.0, rate_ * span_);
        t.matrix = tensor(t.opposed == Opposed::angular_velocity ? size * room_ : size);
        break;
      }
      case TorqueType::brake:
        if (t.opposed == Opposed::angular_velocity) t.opposed = Opposed::momentum;
        t.vector = momentum_ / span_ * scale(1e-3, 0.1) * direction().cwiseAbs();
        break;
      case TorqueType::weight: break;
      case TorqueType::gravity_gradient:
        if (!p.orbit || unit() < 0.3) t.gradient = rate_ * rate_ * scale(1e-3, 1);
        break;
      case TorqueType::magnetic: t.vector = tau / 3e-5 * direction(); break;
      case TorqueType::eddy_current: t.matrix = tensor(room_ / span_ * scale(1e-3, 0.3) / 9e-10); break;
      case TorqueType::thrust:
        t.vector = tau * direction(), t.point = direction();
        if (t.axes == Axes::orbit) t.axes = Axes::inertial;
        break;
      case TorqueType::charge: t.vector = momentum_ * scale(1e-3, 0.5) * direction(); break;
    }
    if (t.type != TorqueType::constant && t.type != TorqueType::table && t.type != TorqueType::thrust)
      t.axes = Axes::body;
    factor(t);
    return t;
  }

  double normal() { return std::normal_distribution<double>()(random_); }
  Vec3<double> direction() {
    const double x = normal(), y = normal(), z = normal();
    return Vec3<double>(x, y, z).normalized();
  }
  Quat<double> attitude() {
    const double w = normal(), x = normal(), y = normal(), z = normal();
    return normalised(Quat<double>{w, x, y, z});
  }

  std::mt19937_64 random_;
  double rate_ = 1, momentum_ = 1, room_ = 1, span_ = 1;
};

}  // namespace general_scenes
