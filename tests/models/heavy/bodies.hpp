// SPDX-License-Identifier: BSD-3-Clause
// Heavy bodies with c = sqrt(M g l/C) = 1 rad/s: the spin rate is r0/c = 1/eps.
#pragma once

#include <random>

#include "catch.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

/// a = A/C, b = B/C, (x', y', z') and k: small and of a field so strong that every shape is realisable.
template <Real Scalar = double>
Problem<Scalar> unit_body(Scalar a, Scalar b, const Vec3<Scalar>& direction, Scalar k) {
  const Scalar length = direction.norm();
  const auto made = length > 0 ? Problem<Scalar>::make({a, b, 1}, 1, direction / length / 128, 128, k)
                               : Problem<Scalar>::make({a, b, 1}, 1, Vec3<Scalar>::Zero(), 128, k);
  REQUIRE(made);
  return *made;
}

struct Draw {
  double a, b, k, G0;
  Vec3<double> direction;

  template <Real Scalar = double>
  Problem<Scalar> body() const {
    return unit_body<Scalar>(Scalar(a), Scalar(b), direction.cast<Scalar>(), Scalar(k));
  }
};

/// |1 - a|, |1 - b| and a + b - 1 above the margin, on one side of C both (or, every fourth, axis 3 intermediate); |G0| < tilt.
inline Draw draw(std::mt19937& random, double margin = 0.1, double tilt = 0.9) {
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0;; ++n) {
    Draw d{0.2 + 1.8 * unit(random), 0.2 + 1.8 * unit(random), unit(random), tilt * (2 * unit(random) - 1),
           Vec3<double>(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5)};
    const bool intermediate = (d.a - 1) * (d.b - 1) < 0;
    if (std::abs(1 - d.a) < margin || std::abs(1 - d.b) < margin || d.a + d.b - 1 < margin ||
        std::abs(d.a - d.b) > 1 - margin || d.direction.norm() < 0.1 || (intermediate && n % 4 != 0))
      continue;
    d.direction.normalize();
    return d;
  }
}

}  // namespace gyrostat::heavy
