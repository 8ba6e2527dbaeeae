// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/block_grid.hpp"

#include <random>

#include "allocations.hpp"
#include "catch.hpp"
#include "grid_oracle.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using grid_oracle::Arrays;

namespace {

Problem<double> stage_of(Vec3<double> D, double lambda3, double r0, double e_H = 0) {
  Problem<double> p;
  p.inertia = D;
  p.mass = 10;
  p.rotor_momentum = lambda3;
  p.charge_momentum = e_H;
  p.torque = {0.4, -0.2, 0};
  p.force = {0.3, -0.2, 3};
  p.angular_velocity = {0.002, -0.003, r0};
  p.angles = {0.004, -0.002, 0.3};
  p.velocity = {0.1, -0.2, 0.3};
  p.position = {1, 2, 3};
  return p;
}

}  // namespace

TEST_CASE("a grid by blocks at and near every resonance", "[spinning]") {
  for (const double detuning : {0.3, 1e-3, 1e-6, 1e-9, 1e-14, 0.0}) {
    for (const auto& p :
         {stage_of({8, 7, 12}, detuning - 12, 1), stage_of({8, 7, 12}, 3 + detuning, 1),
          stage_of({7, 7, 12}, 2 + detuning, 1), stage_of({8, 7, 12}, detuning - 5, 1, 0.25),
          stage_of({8, 7, 12}, detuning - 4, 1), stage_of({8, 7, 12}, 2, detuning), stage_of({7, 7, 7}, detuning, 1),
          stage_of({7, 7, 7}, 0, detuning), stage_of({8, 7, 12}, 12 - detuning, -1, 0.5)}) {
      for (const bool pushed : {true, false}) {
        auto problem = p;
        if (!pushed) problem.force = {0, 0, 3};
        for (const std::size_t n : {5u, 64u, 700u, 20000u}) {
          const BlockGrid<double> grid(problem, 0, 0.01, n);
          Arrays<double> a(n);
          grid.write(0, n, a.columns);
          INFO("detuning " << detuning << ", " << n << " points");
          CHECK(grid_oracle::error(a, problem, 0.0, 0.01, 1 + n / 50, 1) < 6e-15);
          // small t: each value, not only the greatest
          if (n < 700) CHECK(grid_oracle::error(a, problem, 0.0, 0.01, 1 + n / 50, 0) < 6e-15);
        }
      }
    }
  }
}

TEST_CASE("a grid by blocks far out", "[spinning]") {
  for (const auto& p : {stage_of({8, 7, 12}, 1e-9 - 12, 1), stage_of({8, 7, 12}, 3 + 1e-9, 1)}) {
    const std::size_t n = 2'000'000;
    const BlockGrid<double> grid(p, 0, 0.01, n);
    Arrays<double> a(1000);
    for (const std::size_t first : {100'000u, 1'999'000u}) {
      grid.write(first, 1000, a.columns);
      CHECK(grid_oracle::error(a, p, static_cast<long double>(first) * 0.01, 0.01, 13, 1) < 6e-15);
    }
  }
}

TEST_CASE("a grid by blocks through exponential growth", "[spinning]") {
  auto p = stage_of({8, 11, 9}, 0, 1);
  p.torque *= 1e-6;
  const double mu = std::sqrt(-p.nutation_squared());
  const std::size_t n = 3000;
  const double step = 40 / mu / double(n);
  Arrays<double> a(n);
  BlockGrid<double>(p, 0, step, n).write(0, n, a.columns);
  CHECK(grid_oracle::error(a, p, 0.0, step, 11, 1e-3) < 2e-13);
}

TEMPLATE_TEST_CASE("a grid by blocks in other precisions", "[spinning]", float, long double) {
  using S = TestType;
  const auto p = spinning::detail::problem_cast<S>(stage_of({8, 7, 12}, 3, 1, 0.2));
  const std::size_t n = 500;
  Arrays<S> a(n);
  BlockGrid<S>(p, 1, S(0.01), n).write(0, n, a.columns);
  CHECK(grid_oracle::error(a, p, 1, S(0.01), 7, 1) < 40 * double(epsilon<S>));
}

TEST_CASE("any window of a grid by blocks, without the heap; steps of any size", "[spinning]") {
  for (const double step : {0.02, 0.7, 5.0}) {
    const auto p = stage_of({8, 7, 12}, 2, 1, 0.2);
    const auto before = allocations();
    const BlockGrid<double> grid(p, -3, step, 900);
    CHECK(allocations() == before);
    Arrays<double> whole(900), part(300);
    grid.write(0, 900, whole.columns);
    part.columns.G3 = nullptr;
    grid.write(517, 300, part.columns);
    for (std::size_t i = 0; i < 300; ++i)
      for (std::size_t c = 0; c < 13; ++c)
        CHECK(part.column[c][i] == Approx(whole.column[c][517 + i]).epsilon(1e-10).margin(1e-11));
    CHECK(part.column[13][0] != part.column[13][0]);
    CHECK(grid_oracle::error(whole, p, -3.0, step, 7, 1) < 1e-14);
  }
}
