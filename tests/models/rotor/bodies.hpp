// SPDX-License-Identifier: BSD-3-Clause
// Random gyrostats with motors, and the bodies of the reference data.
#pragma once

#include <cmath>
#include <random>

#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

class Bodies {
 public:
  explicit Bodies(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// Evenly in the logarithm.
  double scale(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  Vec3<double> direction() {
    std::normal_distribution<double> normal;
    const Vec3<double> v(normal(random_), normal(random_), normal(random_));
    return v / v.norm();
  }

  Quat<double> attitude() {
    std::normal_distribution<double> normal;
    return normalised(Quat<double>{normal(random_), normal(random_), normal(random_), normal(random_)});
  }

  /// A realisable body: second moments of the carrier at random, a rotor between a thin disc and a rod, in any orientation.
  Gyrostat<double> realisable() {
    const Mat3<double> R = to_matrix(attitude());
    const Vec3<double> second(scale(0.3, 3), scale(0.3, 3), scale(0.3, 3));
    const Mat3<double> E = Mat3<double>::Identity();
    const Mat3<double> carrier = R * (second.sum() * E - Mat3<double>(second.asDiagonal())) * R.transpose();
    const Vec3<double> e = direction();
    const double lambda = scale(0.02, 1);
    const double mu = lambda * uniform(0.5, 2);
    const Mat3<double> theta = carrier + lambda * e * e.transpose() + mu * (E - e * e.transpose());
    const double slope = scale(1e-3, 3), target = uniform(-10, 10);
    return Gyrostat<double>::make((theta + theta.transpose()) / 2, e, lambda, slope, target).value();
  }

  /// A start with |H| about one to ten.
  State<double> start(const Gyrostat<double>& body) {
    const Vec3<double> Omega = body.inverse_inertia() * (direction() * scale(1, 10));
    return body.state(attitude(), Omega, uniform(-10, 10));
  }

 private:
  std::mt19937_64 random_;
};

/// The triaxial body of the reference data, theta = [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5]].
inline Gyrostat<double> reference_body(double slope, double no_load_rate) {
  Mat3<double> theta;
  theta << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  const Vec3<double> e = Vec3<double>(0.75, 0.35, 0.56).normalized();
  return Gyrostat<double>::make(theta, e, 0.35, slope, no_load_rate).value();
}

}  // namespace gyrostat::rotor
