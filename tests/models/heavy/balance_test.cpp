// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/balance.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/heavy/sleeping_top.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Problem<double> body(const Vec3<double>& inertia, const Vec3<double>& centre, double gradient = 0) {
  return Problem<double>::make(inertia, 1, centre, 9.81, gradient).value();
}

}  // namespace

TEST_CASE("heavy: a body that stands upright falls about the axis of its least moment", "[heavy]") {
  const auto p = body({0.1, 0.12, 0.15}, {0, 0, 0.1});
  const Vec3<double> none{0, 0, 0}, up{0, 0, -1}, hangs{0, 0, 1};
  CHECK(is_steady(p, none, up, 1e-14));
  CHECK(is_steady(p, none, hangs, 1e-14));
  CHECK_FALSE(is_steady<double>(p, none, {1e-6, 0, -1}, 1e-14));
  CHECK_FALSE(is_steady<double>(p, {1e-6, 0, 0}, up, 1e-14));
  CHECK(growth_rate(p, none, up) == Approx(std::sqrt(9.81 * 0.1 / 0.1)).epsilon(1e-12));
  CHECK(growth_rate(p, none, hangs) == 0);
}

TEST_CASE("heavy: tops sleep from the same spin on as their closed form says, and fall as fast", "[heavy]") {
  const auto p = body({0.12, 0.12, 0.05}, {0, 0, 0.2});
  const auto top = *SymmetricTop<double>::of(p);
  for (const double spin : {0.0, 3.0, -9.0, 15.0, 19.3, 19.5, 40.0, -400.0}) {
    CAPTURE(spin);
    const auto sleep = sleeping_top(top, false, spin);
    CHECK(growth_rate<double>(p, {0, 0, spin}, {0, 0, -1}) == Approx(sleep.growth_rate()).epsilon(1e-7).margin(1e-9));
    CHECK(growth_rate<double>(p, {0, 0, spin}, {0, 0, 1}) == 0);
  }
}

TEST_CASE("heavy: without weight the middle axis is unstable, as by Euler's equations", "[heavy]") {
  const Vec3<double> I{1, 2, 2.5};
  const auto p = body(I, {0, 0, 0});
  CHECK(growth_rate<double>(p, {0, 3, 0}, {0, -1, 0}) ==
        Approx(3 * std::sqrt((I[1] - I[0]) * (I[2] - I[1]) / (I[0] * I[2]))).epsilon(1e-12));
  CHECK(growth_rate<double>(p, {3, 0, 0}, {1, 0, 0}) == 0);
  CHECK(growth_rate<double>(p, {0, 0, 3}, {0, 0, 1}) == 0);
  CHECK(growth_rate<double>(p, {0, 0, 0}, {0, 0, 1}) == 0);
}

TEST_CASE("heavy: an asymmetric body is held upright by spins between two bounds", "[heavy]") {
  // both of z^2 + s z + p = 0 negative: from the quadratic in r^2
  const Vec3<double> I{0.1, 0.12, 0.15};
  const double weight = 9.81 * 0.01;
  const auto p = body(I, {0, 0, 0.01});
  const auto grows = [&](double r) {
    const double a = (I[2] - I[1]) * r * r - weight, b = (I[2] - I[0]) * r * r - weight;  // stiffnesses
    const double sum = a / I[0] + b / I[1] + std::pow((I[0] + I[1] - I[2]) * r, 2) / (I[0] * I[1]);
    const double product = a * b / (I[0] * I[1]);
    return !(sum > 0 && product > 0 && sum * sum > 4 * product);
  };
  for (double r = 0.1; r < 6; r += 0.1) {
    CAPTURE(r);
    CHECK((growth_rate<double>(p, {0, 0, r}, {0, 0, -1}) > 0) == grows(r));
  }
}
