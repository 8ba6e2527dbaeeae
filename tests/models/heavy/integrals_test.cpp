// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/integrals.hpp"

#include "catch.hpp"

#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Problem<double> inertial_body(const Vec3<double>& inertia, const Vec3<double>& centre, double gravity = 9.8,
                              double gradient = 0) {
  const auto made = Problem<double>::make(inertia, 1, 0.01 * centre, gravity * 100, gradient);
  REQUIRE(made);
  return *made;
}

State<double> after(const Problem<double>& p, const State<double>& start, double t) {
  const FullSystem<double> system(p, start);
  ode::TaylorOptions<double, 8> options;
  options.scale = system.scale();
  ode::Taylor<FullSystem<double>> solver(system, 0, system.start(), options);
  CHECK(solver.advance(t) == ode::Status::reached);
  return system.state(solver.state());
}

/// The same in axes called (2, 3, 1).
Vec3<double> shift(const Vec3<double>& v, int times) {
  Vec3<double> made;
  for (int i = 0; i < 3; ++i) made[(i + times) % 3] = v[i];
  return made;
}

struct Integrable {
  FourthCase kind;
  Vec3<double> inertia, centre;
  double gradient, size;
  bool level = false;  ///< sigma = 0
};

const Integrable cases[] = {
    {FourthCase::euler, {1, 1.2, 1.5}, {0, 0, 0}, 0, 4},
    {FourthCase::lagrange, {1.3, 1.3, 0.7}, {0, 0, -0.8}, 0.6, 1},
    {FourthCase::lagrange, {1.1, 1.1, 1.1}, {0.3, -0.4, 0.5}, 0.6, 1},
    {FourthCase::clebsch, {1, 1.2, 1.5}, {0, 0, 0}, 0.6, 4},
    {FourthCase::kovalevskaya, {1.2, 1.2, 0.6}, {0.4, 0, 0}, 0, 40},
    {FourthCase::kovalevskaya, {1.2, 1.2, 0.6}, {0.24, -0.32, 0}, 0, 40},
    {FourthCase::goryachev_chaplygin, {1.2, 1.2, 0.3}, {0.4, 0, 0}, 0, 20, true},
    {FourthCase::goryachev_chaplygin, {1.2, 1.2, 0.3}, {-0.24, 0.32, 0}, 0, 20, true},
};

}  // namespace

TEST_CASE("heavy: the fourth integrals are found and kept, whatever the axes are called", "[heavy]") {
  Tops random(1);
  for (const Integrable& c : cases)
    for (int turn = 0; turn < 3; ++turn) {
      CAPTURE(int(c.kind), turn);
      const auto p = inertial_body(shift(c.inertia, turn), shift(c.centre, turn), 9.8, c.gradient);
      auto s = random.start();
      if (c.level) {
        // no momentum about the vertical
        const Vec3<double> Id = p.inertia().cwiseProduct(s.down);
        s.angular_velocity -= s.down * (Id.dot(s.angular_velocity) / Id.dot(s.down));
      }
      const FourthIntegral<double> fourth(p, s);
      REQUIRE(fourth.kind() == c.kind);
      const double before = fourth(s);
      double moved = 0;
      for (const double t : {0.7, 3.0, 20.0}) {
        const auto at = after(p, s, t);
        CHECK(std::abs(fourth(at) - before) < 2e-14 * c.size);
        moved = std::max(moved, (at.angular_velocity - s.angular_velocity).norm());
        const auto now = integrals(p, at), then = integrals(p, s);
        CHECK(now.energy == Approx(then.energy).margin(1e-14 * c.size));
        CHECK(now.vertical_momentum == Approx(then.vertical_momentum).margin(1e-14));
        CHECK(now.down_squared == Approx(1).epsilon(4e-15));
      }
      CHECK(moved > 1e-3);
    }
}

TEST_CASE("heavy: where a condition fails there is no fourth integral", "[heavy]") {
  Tops random(2);
  const auto s = random.start();
  const auto kind = [&](const Problem<double>& p) { return FourthIntegral<double>(p, s).kind(); };
  CHECK(kind(random.body()) == FourthCase::none);
  CHECK(std::isnan(FourthIntegral<double>(random.body(), s)(s)));
  CHECK(kind(inertial_body({1.3, 1.3, 0.7}, {1e-9, 0, -0.8})) == FourthCase::none);
  CHECK(kind(inertial_body({1.2, 1.2, 0.6}, {0.4, 0, 0}, 9.8, 0.1)) == FourthCase::none);
  CHECK(kind(inertial_body({1.2, 1.2, 0.6}, {0.4, 0, 1e-9})) == FourthCase::none);
  CHECK(kind(inertial_body({1.2, 1.2, 0.6 * (1 + 1e-12)}, {0.4, 0, 0})) == FourthCase::none);
  CHECK(kind(inertial_body({1.2, 1.2, 0.3}, {0.4, 0, 0})) == FourthCase::none);  // sigma does not vanish
  // gravity off is as good as a centre at the point
  CHECK(kind(inertial_body({1, 1.2, 1.5}, {0.1, 0, 0}, 0)) == FourthCase::euler);
  CHECK(kind(inertial_body({1, 1.2, 1.5}, {0.1, 0, 0}, 0, 0.2)) == FourthCase::clebsch);
}

TEST_CASE("heavy: a body that only nearly has a fourth integral does not keep it", "[heavy]") {
  Tops random(3);
  const auto s = random.start();
  const auto right = inertial_body({1.2, 1.2, 0.6}, {0.4, 0, 0}),
             wrong = inertial_body({1.2, 1.2, 0.6001}, {0.4, 0, 0});
  const FourthIntegral<double> fourth(right, s);
  CHECK(std::abs(fourth(after(wrong, s, 10)) - fourth(s)) > 1e-6);
}
