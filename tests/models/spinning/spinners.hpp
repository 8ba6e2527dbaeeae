// SPDX-License-Identifier: BSD-3-Clause
// Random bodies of the spinning family.
#pragma once

#include <cmath>
#include <random>

#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

template <Real S>
Problem<S> cast(const Problem<double>& p) {
  Problem<S> q;
  q.inertia = p.inertia.cast<S>();
  q.mass = S(p.mass);
  q.rotor_momentum = S(p.rotor_momentum);
  q.charge_momentum = S(p.charge_momentum);
  q.torque = p.torque.cast<S>();
  q.force = p.force.cast<S>();
  q.angular_velocity = p.angular_velocity.cast<S>();
  q.angles = {S(p.angles.psi), S(p.angles.phi), S(p.angles.theta)};
  q.velocity = p.velocity.cast<S>();
  q.position = p.position.cast<S>();
  return q;
}

/// Any realisable body with all terms: rates of any direction, any attitude, torque about `drive` of the gyroscopic one.
class Spinners {
 public:
  explicit Spinners(unsigned seed) : random_(seed) {}

  double any(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double log_any(double a, double b) { return std::exp(any(std::log(a), std::log(b))); }
  Vec3<double> vector() { return {any(-1, 1), any(-1, 1), any(-1, 1)}; }

  Problem<double> body(double drive = 0.1) {
    Problem<double> p;
    double a = 1, b = 1, c = 3;
    while (c > a + b || a > b + c || b > a + c) a = log_any(0.4, 3), b = log_any(0.4, 3), c = log_any(0.4, 3);
    p.inertia = Vec3<double>(a, b, c) * log_any(0.1, 10);
    p.mass = log_any(0.5, 50);
    const double spin = log_any(0.1, 10);
    p.angular_velocity = vector() * spin;
    const double momentum = p.inertia.cwiseProduct(p.angular_velocity).norm();
    p.rotor_momentum = any(-1, 1) * momentum;
    p.charge_momentum = any(-0.3, 0.3) * momentum;
    p.torque = drive * momentum * spin * vector();
    p.force = vector() * log_any(0.1, 10);
    p.angles = {any(-1.5, 1.5), any(-3, 3), any(-3, 3)};
    p.velocity = vector();
    p.position = vector();
    return p;
  }

  /// A body that spins about axis 3 and is tilted by transverse torques to about `tilt`, rad.
  Problem<double> spinner(double tilt) {
    Problem<double> p = body();
    const double spin = p.angular_velocity.norm() * (any(-1, 1) < 0 ? -1 : 1);
    p.angular_velocity = {0, 0, spin};
    p.rotor_momentum = any(0, 1) * p.inertia[2] * spin;
    p.charge_momentum = any(-0.1, 0.1) * p.inertia[2] * spin;
    p.torque = tilt / 2 * std::abs(spin * p.effective_momentum()) * vector();
    p.torque[2] = 0;
    p.angles = {tilt / 4 * any(-1, 1), tilt / 4 * any(-1, 1), any(-3, 3)};
    return p;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace gyrostat::spinning
