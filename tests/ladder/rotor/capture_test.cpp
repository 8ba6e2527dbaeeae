// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/capture.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "allocations.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

Gyrostat<double> two_minima(double slope) {
  Mat3<double> theta;
  theta << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  return Gyrostat<double>::make(theta, Vec3<double>(0.75, 0.35, 0.56).normalized(), 0.35, slope, 3.0).value();
}

/// The rotor at rest, |H| = 8.
State<double> at_rest(const Gyrostat<double>& body, const Vec3<double>& m) {
  return body.state({}, body.inverse_inertia() * (8 * m), 0.0);
}

/// V on the motion at t, J.
double level_at(const Gyrostat<double>& body, const State<double>& start, double t, State<double>* where = nullptr) {
  State<double> state;
  FullMotionOptions<double> options;
  options.tolerance = 1e-11;
  REQUIRE(full_motion<double>(body, start, std::span(&t, 1), std::span(&state, 1), options));
  if (where) *where = state;
  return body.lyapunov(state.momentum, state.axial_momentum);
}

}  // namespace

TEST_CASE("capture: the first time at which V lies below the lowest saddle") {
  const auto body = two_minima(0.2);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int late = 0;
  for (int i = 0; i < 20; ++i) {
    const auto start = at_rest(body, Vec3<double>(normal(random), normal(random), normal(random)).normalized());
    const auto steady = steady_rotations(body, start.momentum.norm());
    const double barrier = barrier_level(body, steady, start.momentum.norm());
    const auto found = capture(body, start, 1e4, 1e-9);
    CAPTURE(i, found.time);
    REQUIRE(found.attractor.index >= 0);
    if (found.time == 0) {
      CHECK(body.lyapunov(start.momentum, start.axial_momentum) < barrier);
      continue;
    }
    ++late;
    CHECK(level_at(body, start, found.time) < barrier);
    const double early = found.time - std::max(2e-3 * found.time, 0.01 * 2 * pi<double> / turning_rate(body, start));
    CHECK(level_at(body, start, early) > barrier * (1 - 1e-9));
    // where the motion is much later
    State<double> end;
    level_at(body, start, found.time + 400, &end);
    CHECK((end.momentum.normalized() - steady[found.attractor.index].direction).norm() < 0.05);
    // a looser motion either says the same or nothing
    const auto loose = capture(body, start, 1e4, 1e-4);
    CHECK((loose.attractor.index == found.attractor.index || loose.attractor.index == -1));
  }
  CHECK(late > 10);
}

TEST_CASE("capture: stops at the longest time, and says nothing then") {
  const auto body = two_minima(0.2);
  const auto start = at_rest(body, Vec3<double>(-1, 0.1, -0.2).normalized());
  const auto whole = capture(body, start, 1e4, 1e-9);
  REQUIRE(whole.attractor.index >= 0);
  REQUIRE(whole.time > 1);
  const auto part = capture(body, start, whole.time / 2, 1e-9);
  CHECK(part.attractor.index == -1);
  CHECK(part.attractor.certificate == Certificate::undecided);
  CHECK(part.attractor.margin > 0);
  CHECK(part.time == whole.time / 2);
}

TEST_CASE("capture: what the algebra decides is reported at once") {
  const auto conservative = two_minima(0);
  const auto start = at_rest(conservative, Vec3<double>::UnitX());
  CHECK(capture(conservative, start, 1e3, 1e-9).attractor.certificate == Certificate::none);
  CHECK(capture(conservative, start, 1e3, 1e-9).time == 0);

  const auto body = two_minima(0.2);
  const auto steady = steady_rotations(body, 8.0);
  const auto settled = body.state({}, steady[1].spin_rate * steady[1].direction, body.no_load_rate());
  const auto found = capture(body, settled, 1e3, 1e-9);
  CHECK(found.time == 0);
  CHECK(found.attractor.index == 1);
  CHECK(found.attractor.certificate == Certificate::by_level);
}

TEST_CASE("capture: a stiff motor, and no heap") {
  const auto body = two_minima(2000);
  const auto start = body.state({}, body.inverse_inertia() * Vec3<double>(-7, 3, 2), 2.9);
  const auto before = allocations();
  const auto found = capture(body, start, 50.0, 1e-8);
  CHECK(allocations() == before);
  // a motor that follows at once dissipates little: still undecided, V having hardly fallen
  CHECK(found.attractor.margin <= body.lyapunov(start.momentum, start.axial_momentum));
  CHECK(std::isfinite(found.attractor.margin));
}
