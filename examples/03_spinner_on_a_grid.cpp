// SPDX-License-Identifier: BSD-3-Clause
// A spinning stage thrusts a little off its axis: a hundred thousand times of its motion as arrays, at a few nanoseconds a time, and where
// it points in the mean.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "gyrostat/models/spinning/linear_grid.hpp"

using namespace gyrostat;

int main() {
  spinning::Problem<double> stage;
  stage.inertia = {560, 540, 820};     // kg m^2; axis 3 is the spin axis
  stage.mass = 2000;                   // kg
  stage.torque = {9, -4, 0};           // N m, constant in the body: the thrust misses the mass centre
  stage.force = {0, 0, 4000};          // N
  stage.angular_velocity = {0, 0, 3};  // rad/s
  if (!(stage.nutation_squared() > 0)) return std::puts("this spin is unstable"), 1;

  constexpr std::size_t points = 100'000;
  constexpr double step = 0.01;  // s
  std::array<std::vector<double>, 13> c;
  for (auto& column : c) column.resize(points);
  const spinning::LinearGrid<double> grid(stage, 0, step, points);
  grid.write(0, points,
             {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(), c[5].data(), c[6].data(), c[7].data(),
              c[8].data(), c[9].data(), c[10].data(), c[11].data(), c[12].data()});

  // psi and phi tilt axis 3: it points to (phi, -psi) in axes that do not spin about it, turned by theta to inertial ones
  double x = 0, y = 0, most = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const double psi = c[2][i], phi = c[3][i], theta = c[4][i];
    x += (std::cos(theta) * phi + std::sin(theta) * psi) / points;
    y += (std::sin(theta) * phi - std::cos(theta) * psi) / points;
    most = std::max(most, std::hypot(psi, phi));
  }
  std::printf("greatest tilt %.6f rad\n", most);
  std::printf("mean direction off by %.6f rad\n", std::hypot(x, y));
  std::printf("after %.0f s: %.1f m/s along axis 3, (%.3f, %.3f) m/s across\n", points * step, c[9].back(), c[7].back(),
              c[8].back());
}
