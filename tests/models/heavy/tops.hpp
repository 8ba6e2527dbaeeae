// SPDX-License-Identifier: BSD-3-Clause
// Random heavy bodies and motions, rates and torques of order one.
#pragma once

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::heavy {

class Tops {
 public:
  explicit Tops(unsigned seed) : random_(seed) {}

  double any(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  double log_any(double from, double to) { return from * std::pow(to / from, any(0, 1)); }
  Vec3<double> vector() { return {any(-1, 1), any(-1, 1), any(-1, 1)}; }
  Vec3<double> direction() {
    for (;;)
      if (const Vec3<double> v = vector(); v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }

  /// Moments within (0.5, 2), |M g r_cm| about `weight`, N about `gradient`; the mass is small and gravity strong, so that every centre
  /// is real.
  Problem<double> body(double weight = 1, double gradient = 0.5) {
    for (;;) {
      const Vec3<double> I(any(0.5, 2), any(0.5, 2), any(0.5, 2));
      if (I.sum() - 2 * I.maxCoeff() < 0.05) continue;
      const auto made =
          Problem<double>::make(I, 1, 0.01 * direction(), 100 * weight * any(0.5, 1), gradient * any(0.5, 1));
      REQUIRE(made);
      return *made;
    }
  }
  State<double> start(double rate = 1) {
    State<double> s;
    s.angular_velocity = rate * direction();
    s.attitude = normalised(Quat<double>{any(-1, 1), any(-1, 1), any(-1, 1), any(-1, 1)});
    s.down = rotate<double>(conjugate(s.attitude), {0, 0, -1});
    return s;
  }

 private:
  std::mt19937 random_;
};

template <Real S>
Problem<S> cast(const Problem<double>& p) {
  const auto made = Problem<S>::make(p.inertia().cast<S>(), S(p.mass()), p.centre_of_mass().cast<S>(), S(p.gravity()),
                                     S(p.gradient()));
  REQUIRE(made);
  return *made;
}

/// In another precision; the quaternion and down are of unit length to its rounding.
template <Real S>
State<S> cast(const State<double>& s) {
  State<S> made;
  made.angular_velocity = s.angular_velocity.cast<S>();
  made.attitude = normalised(Quat<S>{S(s.attitude.w), S(s.attitude.x), S(s.attitude.y), S(s.attitude.z)});
  made.down = s.down.cast<S>();
  return made;
}

}  // namespace gyrostat::heavy
