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

TEST_CASE("heavy: a plane swing is beside a separatrix where its energy is nearly that of a rest on high", "[heavy]") {
  constexpr double near = 0.03;
  for (const double gradient : {0.0, 40.0}) {
    // about axis 2, the mass centre between axes 3 and 1
    const auto p = body({0.1, 0.12, 0.15}, {0.03, 0, 0.1}, gradient);
    const auto potential = [&](double angle) {
      const Vec3<double> d(std::sin(angle), 0, std::cos(angle));
      return gradient * d.dot(p.inertia().cwiseProduct(d)) / 2 - p.moment().dot(d);
    };
    double low = infinity<double>, high = -infinity<double>;
    for (int n = 0; n < 100'000; ++n) {
      const double height = potential(2 * pi<double> * n / 100'000);
      low = std::min(low, height), high = std::max(high, height);
    }
    const auto swings = [&](double angle, double above, double across = 0) {
      const double rate = std::sqrt(2 * (high + above * (high - low) - potential(angle)) / 0.12);
      return is_beside_separatrix<double>(p, {across * rate, rate, 0}, {std::sin(angle), across, std::cos(angle)},
                                          near);
    };
    for (const double angle : {0.0, 1.0, -2.0}) {
      CAPTURE(gradient, angle);
      CHECK(swings(angle, 0));
      CHECK(swings(angle, 0.029));
      CHECK(swings(angle, -0.029));
      CHECK(swings(angle, 0, 0.02));
      CHECK_FALSE(swings(angle, 0.031));
      CHECK_FALSE(swings(angle, -0.031));
      CHECK_FALSE(swings(angle, 0, 0.05));
    }
  }
  // no plane holds the mass centre and the motion
  CHECK_FALSE(is_beside_separatrix<double>(body({0.1, 0.12, 0.15}, {0, 0.1, 0}), {0, 1, 0}, {1, 0, 0}, near));
}

TEST_CASE("heavy: what decides when a motion leaves an unstable balance grows at its rate, and no other part counts",
          "[heavy]") {
  struct Balance {
    Problem<double> body;
    Vec3<double> rate, down;
  };
  const auto tilted =
      [] {  // a steady rotation about no principal axis: the torque of the weight takes that of the rate
        const Vec3<double> I{0.5, 0.7, 1}, d = Vec3<double>(0.3, -0.5, 0.8).normalized(), w = 2 * d;
        const Vec3<double> torque = cross<double>(w, I.cwiseProduct(w)), centre = cross<double>(d, torque) - d;
        return Balance{body(I, centre / 9.81), w, d};
      }();
  const Balance balances[] = {{body({0.1, 0.12, 0.15}, {0, 0, 0.1}), {0, 0, 0}, {0, 0, -1}},
                              {body({1, 2, 2.5}, {0, 0, 0}), {0, 3, 0}, {0, -1, 0}},
                              tilted};
  for (const auto& [p, w, d] : balances) {
    REQUIRE(is_steady(p, w, d, 1e-12));
    const auto leaving = departures(p, w, d);
    REQUIRE(leaving.growth > 0);
    const double size = std::hypot(leaving.of_rate.norm(), leaving.of_down.norm());
    const auto counts = [&](const Vec3<double>& of_rate, const Vec3<double>& of_down) {
      return (leaving.of_rate.dot(of_rate) / leaving.unit + leaving.of_down.dot(of_down)) / size;
    };
    // departures grow by the linear equations, to the square of their size
    constexpr double small = 1e-6;
    for (const Vec3<double>& v : {Vec3<double>(1, 2, -1), Vec3<double>(-3, 1, 1), Vec3<double>(1, -1, 4)}) {
      const Vec3<double> off_rate = small * leaving.unit * v, off_down = small * Vec3<double>(v[1], -v[2], v[0]);
      const auto change = [&](double side) -> std::pair<Vec3<double>, Vec3<double>> {
        const Vec3<double> rate = w + side * off_rate, down = d + side * off_down;
        return {p.torque(rate, down).cwiseQuotient(p.inertia()), cross<double>(down, rate)};
      };
      const auto more = change(1), less = change(-1);
      const double now = counts(off_rate, off_down);
      const double next = counts((more.first - less.first) / 2, (more.second - less.second) / 2);
      CHECK(next == Approx(leaving.growth * now).margin(1e-9 * small * leaving.unit));
    }
  }
  CHECK(departures<double>(body({1, 2, 2.5}, {0, 0, 0}), {3, 0, 0}, {1, 0, 0}).of_rate.isZero(0));
}
