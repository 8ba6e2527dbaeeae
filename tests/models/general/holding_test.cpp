// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/holding.hpp"

#include <cmath>

#include "catch.hpp"
#include "scenes.hpp"

namespace general_holding_test {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr double eps = epsilon<double>;

TEST_CASE("a brake at rest takes up what lies in its ellipsoid", "[general]") {
  const Vec3<double> limit(1, 2, 4);
  CHECK(share_of_brake<double>(limit, {0, 0, 0}) == 0);
  CHECK(share_of_brake<double>(limit, {0, -2, 0}) == 1);
  CHECK(share_of_brake<double>(limit, {0.6, 0, 3.2}) == Approx(1));
  CHECK(share_of_brake<double>({1, 0, 1}, {0.5, 0, 0}) == 0.5);
  CHECK(share_of_brake<double>({1, 0, 1}, {0.5, 1e-300, 0}) == infinity<double>);
  CHECK(torque_at_rest<double>(limit, {0.5, -1, 1}) == Vec3<double>(-0.5, 1, -1));
}

TEST_CASE("at the edge of a brake 8 roundings are held and 9 are not", "[general]") {
  const Vec3<double> limit(1, 2, 4);
  const Vec3<double> held(0, 2 * (1 + 8 * eps), 0), left(0, 2 * (1 + 9 * eps), 0);
  CHECK(torque_at_rest<double>(limit, held) == -held);
  CHECK(torque_at_rest<double>(limit, left) == Vec3<double>(0, -2, 0));
  CHECK(departure<double>(limit, left).rate > 0);
  CHECK(departure<double>(limit, {0, 2, 0}).rate == 0);
}

TEST_CASE("a body leaves along the one direction in which brake and torque agree", "[general]") {
  general_scenes::Scenes random(11);
  for (int i = 0; i < 200; ++i) {
    Vec3<double> limit, torque;
    for (int k = 0; k < 3; ++k) {
      limit[k] = i % 7 == k ? 0 : random.scale(1e-2, 10);
      torque[k] = random.scale(1e-3, 10) * (random.unit() < 0.5 ? -1 : 1);
    }
    const auto made = departure(limit, torque);
    if (share_of_brake(limit, torque) <= 1) {
      CHECK(made.rate == 0);
      continue;
    }
    REQUIRE(made.rate > 0);
    CHECK(made.direction.norm() == Approx(1).epsilon(1e-14));
    const Vec3<double> rest = limit.cwiseProduct(made.direction) + made.rate * made.direction - torque;
    CHECK(rest.norm() < 1e-13 * (limit.norm() + torque.norm()));
    CHECK((torque_at_rest(limit, torque) + torque - made.rate * made.direction).norm() < 1e-12 * torque.norm());
  }
}

}  // namespace general_holding_test
