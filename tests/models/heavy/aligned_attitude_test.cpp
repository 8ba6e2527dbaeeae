// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/aligned_attitude.hpp"

#include <random>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

using V = Vec3<double>;

TEST_CASE("shortest turn: takes one vector to the other, near the same and opposite ones too", "[heavy]") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return V(normal(random), normal(random), normal(random)).normalized(); };
  for (int n = 0; n < 200; ++n) {
    const V a = draw(), away = std::pow(10.0, -(n % 20)) * draw();
    for (const V& b : {draw(), V((a + away).normalized()), V((away - a).normalized()), V(-a), a}) {
      const auto q = shortest_turn<double>(a, b);
      CHECK((rotate<double>(q, a) - b).norm() < 2e-15);
      CHECK(q.w >= -1e-15);
      CHECK(std::abs(q.x * a[0] + q.y * a[1] + q.z * a[2]) < 1e-15 + 1e-15 / std::max((a + b).norm(), 1e-15));
      CHECK(std::abs(norm(q) - 1) < 1e-15);
    }
  }
}

TEST_CASE("aligned start: down rules, a consistent attitude stays", "[heavy]") {
  State<double> s{{1, 2, 3}, {0.3, -0.4, 2}, {0.2, 0.5, -0.1, 0.9}};
  const auto made = aligned(s);
  REQUIRE(made);
  CHECK(made->down.norm() == Approx(1).epsilon(1e-15));
  CHECK((made->down - s.down.normalized()).norm() < 1e-15);
  CHECK((rotate<double>(conjugate(made->attitude), V(0, 0, -1)) - made->down).norm() < 1e-15);
  const auto again = aligned(*made);
  REQUIRE(again);
  const auto difference = conjugate(made->attitude) * again->attitude;
  CHECK(std::hypot(difference.x, difference.y, difference.z) < 1e-15);
  s.down.setZero();
  CHECK(aligned(s).error() == Errc::zero_vector);
  s.down[0] = gyrostat::infinity<double>;
  CHECK(aligned(s).error() == Errc::not_finite);
  s = {{1, 2, 3}, {0, 0, -1}, {0, 0, 0, 0}};
  CHECK(aligned(s).error() == Errc::zero_vector);
}
