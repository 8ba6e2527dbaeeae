// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/linear_grid.hpp"

#include <random>

#include "allocations.hpp"
#include "catch.hpp"
#include "grid_oracle.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using grid_oracle::Arrays;

namespace {

Problem<double> rolling_stage(double lambda3, double r0 = 1) {
  Problem<double> p;
  p.inertia = {8, 7, 12};
  p.mass = 10;
  p.rotor_momentum = lambda3;
  p.torque = {0.4, -0.2, 0};
  p.force = {0.3, -0.2, 3};
  p.angular_velocity = {0.002, -0.003, r0};
  p.angles = {0.004, -0.002, 0.3};
  return p;
}

}  // namespace

TEST_CASE("which kernel", "[spinning]") {
  const auto kernel = [](const Problem<double>& p, double step, std::size_t points) {
    return LinearGrid<double>(p, 0, step, points).kernel();
  };
  CHECK(kernel(rolling_stage(1.3), 0.01, 10000) == GridKernel::modes);
  CHECK(kernel(rolling_stage(1.3), 0.01, 100) == GridKernel::blocks);     // small t
  CHECK(kernel(rolling_stage(-12), 0.01, 10000) == GridKernel::blocks);   // X = 0
  CHECK(kernel(rolling_stage(-4.5), 0.01, 10000) == GridKernel::blocks);  // unstable
  CHECK(kernel(rolling_stage(-12), 10, 100) == GridKernel::points);
  CHECK(kernel(rolling_stage(1.3), 10, 100) == GridKernel::modes);
  CHECK(LinearGrid<double>(rolling_stage(1.3), 0, 0.01, 10000, GridKernel::blocks).kernel() == GridKernel::blocks);
  CHECK(LinearGrid<double>(rolling_stage(1.3), 0, 0.01, 10, GridKernel::modes).kernel() == GridKernel::modes);
  CHECK(LinearGrid<double>(rolling_stage(1.3), 0, 0.01, 10, GridKernel::points).kernel() == GridKernel::points);
}

TEST_CASE("the kernel chosen is accurate, whatever the scene", "[spinning]") {
  std::mt19937_64 random(6);
  const auto u = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  double worst = 0;
  int used[4] = {};
  for (int trial = 0; trial < 300; ++trial) {
    Problem<double> p = rolling_stage(0, u(-1, 1));
    Vec3<double> D;
    do D = {u(.3, 3), u(.3, 3), u(.3, 3)};
    while (2 * D.maxCoeff() > D.sum());
    p.inertia = D;
    p.rotor_momentum = D[2] * u(-1, 1);
    p.charge_momentum = trial % 3 == 0 ? D[2] * u(-.2, .2) : 0;
    const double detuning = trial % 10 == 3 ? 0 : std::pow(10, u(-12, -1)), Lambda = p.charge_momentum + detuning;
    if (trial % 5 == 1) p.rotor_momentum = Lambda - D[2] * p.spin();
    if (trial % 5 == 2) p.rotor_momentum = Lambda + (D[0] + D[1] - D[2]) * p.spin();
    if (trial % 5 == 3) p.angular_velocity[2] = detuning;
    double T = std::pow(10, u(-1, 3));
    if (p.nutation_squared() < 0) T = std::min(T, 20 / std::sqrt(-p.nutation_squared()));
    const std::size_t n = std::size_t(std::pow(10, u(1, 3.5)));
    const double step = T / double(n), start = trial % 4 == 0 ? u(0, 10) : 0;
    const LinearGrid<double> grid(p, start, step, n);
    ++used[int(grid.kernel())];
    Arrays<double> a(n);
    grid.write(0, n, a.columns);
    worst = std::max(worst, grid_oracle::error(a, p, start, step, 1 + n / 60, 1));
  }
  INFO(worst * 1e15);
  CHECK(worst < 2e-13);
  CHECK(used[int(GridKernel::modes)] > 20);
  CHECK(used[int(GridKernel::blocks)] > 20);
  CHECK(used[int(GridKernel::points)] > 5);
}

TEST_CASE("a grid takes no memory from the heap", "[spinning]") {
  Arrays<double> a(500);
  const auto before = allocations();
  for (const auto kernel : {GridKernel::modes, GridKernel::blocks, GridKernel::points})
    LinearGrid<double>(rolling_stage(1.3), 0, 0.01, 500, kernel).write(0, 500, a.columns);
  CHECK(allocations() == before);
}
