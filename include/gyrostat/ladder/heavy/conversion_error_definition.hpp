// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/heavy/conversion_error.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE Problem<double> off_body(const Problem<double>& of, int which) noexcept {
  const auto top = SymmetricTop<double>::of(of);
  Vec3<double> inertia = of.inertia();
  const double by = conversion * inertia.maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const bool plus = top ? (std::abs(top->axes(i, 2)) == 1) == (which == 0) : i != which;
    inertia[i] += plus ? by : -by;
  }
  const auto made =
      Problem<double>::make(inertia, of.mass(), of.centre_of_mass() * (1 + conversion), of.gravity(), of.gradient());
  return made ? *made : of;
}

GYROSTAT_COMPILED_ONCE bool axes_undecided(const Problem<double>& of) noexcept {
  const Vec3<double>& I = of.inertia();
  const double gap = std::min({std::abs(I[0] - I[1]), std::abs(I[1] - I[2]), std::abs(I[2] - I[0])});
  return gap < 1e6 * conversion * I.maxCoeff();
}

GYROSTAT_COMPILED_ONCE State<double> off_start(const State<double>& of, int which, int k) noexcept {
  const Vec3<double> direction = which == 0 ? Vec3<double>(0.6, -0.64, 0.48) : Vec3<double>(-0.48, 0.6, 0.64);
  const double turn = which == 0 ? conversion : -conversion;
  State<double> made = of;
  Vec3<double> by = conversion * direction;
  if (k >= 0) {
    made.angular_velocity[k] *= 1 + turn;
    by = turn * Vec3<double>::Unit(k);
  } else {
    made.angular_velocity +=
        conversion * of.angular_velocity.norm() * Vec3<double>(direction[1], direction[2], direction[0]);
  }
  made.attitude = normalised(of.attitude * Quat<double>{1, by[0] / 2, by[1] / 2, by[2] / 2});
  made.down = (of.down - cross<double>(by, of.down)).normalized();
  if (k >= 0) made.down[k] = of.down[k];
  return made;
}

}  // namespace gyrostat::heavy
