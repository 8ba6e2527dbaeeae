// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <random>

#include "catch.hpp"
#include "gyrostat/models/deceleration/problem.hpp"

/// Random problems in principal axes for the tests of the deceleration.
struct Bodies {
  using V = gyrostat::Vec3<double>;
  std::mt19937_64 random;
  std::uniform_real_distribution<double> flat{0, 1};
  std::normal_distribution<double> bell;

  explicit Bodies(unsigned seed) : random(seed) {}

  double uniform(double lo, double hi) { return lo + (hi - lo) * flat(random); }
  V vector() { return {bell(random), bell(random), bell(random)}; }

  /// 1/(A, B, C), ascending, of a physical body.
  V inverse_inertia() {
    for (;;) {
      V J(uniform(.2, 2), uniform(.2, 2), uniform(.2, 2));
      std::sort(J.data(), J.data() + 3, std::greater<double>());
      if (J[0] < J[1] + J[2] && J[0] > 1.001 * J[1] && J[1] > 1.001 * J[2]) return J.cwiseInverse();
    }
  }

  /// Without rotor momentum; eps scales control and drag.
  gyrostat::deceleration::Problem<double> problem(double eps) {
    gyrostat::deceleration::Problem<double> p;
    p.inverse_inertia = inverse_inertia();
    p.control = (eps * V(uniform(.3, 1), uniform(.3, 1), uniform(.3, 1))).asDiagonal();
    p.drag = eps * uniform(0, 1);
    p.momentum = vector();
    return p;
  }
};
