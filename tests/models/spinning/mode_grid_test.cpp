// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/mode_grid.hpp"

#include <random>

#include "allocations.hpp"
#include "catch.hpp"
#include "grid_oracle.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using grid_oracle::Arrays;

namespace {

template <class S>
Problem<S> grid_stage(S r0 = 1) {
  Problem<S> p;
  p.inertia = {S(8.7), S(8.2), S(11.1)};
  p.mass = 10;
  p.rotor_momentum = S(1.3);
  p.charge_momentum = S(0.29);
  p.torque = {S(0.4), S(-0.27), 0};
  p.force = {S(0.7), S(-1.1), 3};
  p.angular_velocity = {S(0.02), S(-0.03), r0};
  p.angles = {S(0.05), S(-0.02), S(0.3)};
  p.velocity = {S(0.1), S(-0.2), S(0.3)};
  p.position = {1, 2, 3};
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE("a grid by modes is the linear motion", "[spinning]", float, double, long double) {
  using S = TestType;
  for (const S r0 : {S(1.1), S(-0.8)}) {
    for (const bool pushed : {true, false}) {
      auto p = grid_stage<S>(r0);
      if (!pushed) p.force = {0, 0, 3};
      for (const std::size_t n : {1u, 7u, 256u, 3000u}) {
        const S start = S(40), step = S(0.0371);
        Arrays<S> a(n);
        ModeGrid<S>(p, start, step).write(0, n, a.columns);
        const double eps = double(std::is_same_v<S, long double> ? epsilon<S> * 100 : epsilon<S>);
        CHECK(grid_oracle::error(a, p, start, step, 1 + n / 100, 1) < 16 * eps);
      }
    }
  }
}

TEST_CASE("a grid by modes does not drift", "[spinning]") {
  const auto p = grid_stage<double>();
  const ModeGrid<double> grid(p, 0, 0.01);
  Arrays<double> a(1000);
  grid.write(0, 1000, a.columns);
  CHECK(grid_oracle::error(a, p, 0.0, 0.01, 7, 1) < 4e-15);
  for (const std::size_t first : {100'000u, 3'000'000u, 100'000'000u}) {
    grid.write(first, 1000, a.columns);
    const Linear<long double> linear(spinning::detail::problem_cast<long double>(p));
    long double worst = 0;
    for (std::size_t i = 0; i < 1000; i += 111) {
      const auto truth = grid_oracle::row(linear.at(static_cast<long double>(first + i) * 0.01));
      for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(a.column[c][i] - truth[c]));
    }
    CHECK(double(worst) < 1e-14);
  }
}

TEST_CASE("any window of a grid by modes, without the heap", "[spinning]") {
  const auto p = grid_stage<double>();
  const ModeGrid<double> grid(p, 3, 0.02);
  Arrays<double> whole(900), part(300);
  const auto before = allocations();
  grid.write(0, 900, whole.columns);
  part.columns.G3 = nullptr;
  grid.write(517, 300, part.columns);
  CHECK(allocations() == before);
  for (std::size_t i = 0; i < 300; ++i)
    for (std::size_t c = 0; c < 13; ++c)
      CHECK(part.column[c][i] == Approx(whole.column[c][517 + i]).epsilon(1e-12).margin(1e-14));
  CHECK(part.column[13][0] != part.column[13][0]);
}

TEST_CASE("modes next to a resonance that turns through 10 rad", "[spinning]") {
  std::mt19937_64 random(3);
  const auto u = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  double worst = 0;
  for (int trial = 0; trial < 200; ++trial) {
    auto p = grid_stage<double>(u(0.5, 2));
    const double detuning = std::pow(10, u(-4, -1)), Lambda = p.charge_momentum + detuning;
    if (trial % 4 == 0) p.rotor_momentum = Lambda - 11.1 * p.spin();
    if (trial % 4 == 1) p.rotor_momentum = Lambda + (8.7 + 8.2 - 11.1) * p.spin();
    if (trial % 4 == 2) p.rotor_momentum = Lambda - (11.1 - 8.7) * p.spin();
    if (trial % 4 == 3) p.angular_velocity[2] = detuning;
    if (p.nutation_squared() <= 0) continue;
    const double T = u(10, 100) / divisors(p).least();
    Arrays<double> a(200);
    ModeGrid<double>(p, 0, T / 200).write(0, 200, a.columns);
    // the phase itself is kept in long double
    worst = std::max(worst, grid_oracle::error(a, p, 0.0, T / 200, 1, 1) / (1e-14 + 4e-19 * T));
  }
  CHECK(worst < 1);
}
