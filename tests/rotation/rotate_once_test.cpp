// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/rotate_once.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/rotation/quaternion.hpp"

using namespace gyrostat;

TEST_CASE("a vector that is rotated once has one rounding", "[rotation]") {
  using Long = long double;
  for (int i = 0; i < 200; ++i) {
    const double s = i;
    const Quat<double> q{std::sin(s) * 3, std::cos(2 * s), std::sin(5 * s + 1), std::cos(7 * s)};  // of any length
    const Vec3<double> v(std::sin(3 * s), 1e3 * std::cos(s), std::sin(s + 2));
    const Quat<Long> wide = normalised(Quat<Long>{q.w, q.x, q.y, q.z});
    const Vec3<Long> right = rotate<Long>(wide, v.cast<Long>());
    const Vec3<double> made = rotate_once(q, v);
    for (int k = 0; k < 3; ++k) {
      const Long off = std::abs(made[k] - right[k]), ulp = std::abs(right[k]) * epsilon<double>;
      CHECK(off <= ulp / 2 + 1e3L * 64 * epsilon<Long>);
    }
  }
  const Vec3<Long> same(1, 2, 3);
  CHECK(rotate_once(Quat<Long>{2, 0, 0, 0}, same) == same);
}
