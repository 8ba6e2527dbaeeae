// SPDX-License-Identifier: BSD-3-Clause
// Torques of a caller's own, random ones among them.
#pragma once

#include <cmath>
#include <vector>

#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "scenes.hpp"

namespace general_laws {

using namespace gyrostat;
using namespace gyrostat::general;

/// A push that oscillates, damping, drag by the square of the rate, a field in space, a part that follows the first wheel, and a step.
struct Mixed {
  Vec3<double> push{0, 0, 0}, field{0, 0, 0}, dipole{0, 0, 0}, by_wheel{0, 0, 0}, kick{0, 0, 0};
  Mat3<double> damping = Mat3<double>::Zero();
  double frequency = 0, phase = 0, drag = 0, kick_time = infinity<double>;

  template <Real S>
  Vec3<S> operator()(S t, const Seen<S>& s) const noexcept {
    using std::sin;
    const Vec3<S>& w = s.angular_velocity;
    const Vec3<S> B = rotate<S>(conjugate(s.attitude), Vec3<S>(field.cast<S>()));
    Vec3<S> sum = push.cast<S>() * sin(S(frequency) * t + S(phase)) - damping.cast<S>() * w - S(drag) * w.norm() * w;
    sum += cross<S>(Vec3<S>(dipole.cast<S>()), B) + by_wheel.cast<S>() * s.rotor_rate[0];
    if (t >= S(kick_time)) sum += kick.cast<S>();
    return sum;
  }
};

struct Made {
  Problem<double> problem;
  double span = 1;
  Mixed law;
  std::vector<double> named;  ///< the breakpoints of the law
};

/// Random scenes of every kind, each with a law of the size of its torques.
class Scenes {
 public:
  explicit Scenes(unsigned seed) : source_(seed), random_(seed + 31337) {}

  Made next(double turns) {
    const auto any = source_.next(turns);
    Made made{any.problem, any.span, {}, {}};
    const Prepared<double> of(made.problem, made.span);
    const auto& sizes = of.sizes;
    const double M = sizes.momentum() > 0 ? sizes.momentum() : sizes.greatest / made.span;
    const double pace = std::max(sizes.turning, 1 / made.span), tau = M * pace;
    const auto size = [&] { return tau * std::pow(10, -4 + 3.5 * unit()); };
    auto& law = made.law;
    if (unit() < 0.6) law.push = size() * direction(), law.frequency = 3 * pace * unit(), law.phase = 6 * unit();
    if (unit() < 0.5) law.damping = (sizes.least / made.span * unit()) * Mat3<double>::Identity();
    if (unit() < 0.4) law.drag = sizes.least / made.span / pace * unit();
    if (unit() < 0.5) law.dipole = size() * direction(), law.field = direction();
    if (unit() < 0.3 && of.wheels.count > 0)
      law.by_wheel = size() / (1e-3 * pace + std::abs(of.wheels.laws[0].rate)) * direction();
    if (unit() < 0.4) {
      law.kick = size() * direction(), law.kick_time = made.span * unit();
      made.named = {law.kick_time};
    }
    return made;
  }
  double unit() { return std::uniform_real_distribution<double>()(random_); }

 private:
  Vec3<double> direction() {
    const auto normal = [&] { return std::normal_distribution<double>()(random_); };
    const double x = normal(), y = normal(), z = normal();
    return Vec3<double>(x, y, z).normalized();
  }

  general_scenes::Scenes source_;
  std::mt19937_64 random_;
};

}  // namespace general_laws
