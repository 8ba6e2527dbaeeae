// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/quaternion_lanes.hpp"

#include "catch.hpp"
#include "gyrostat/rotation/quaternion.hpp"

using namespace gyrostat;

TEMPLATE_TEST_CASE("products with the units are Hamilton's", "[rotation]", float, double, long double) {
  using S = TestType;
  const Quat<S> a{1, -2, 3, 5}, b{-7, 4, 2, 6}, c{3, 9, -8, 1};
  const auto row = [](const Quat<S>& q) { return lanes(q.w, q.x, q.y, q.z); };
  const auto got = times_units(row(a), row(b), row(c));
  const Quat<S> i = a * Quat<S>{0, 1, 0, 0}, j = b * Quat<S>{0, 0, 1, 0}, k = c * Quat<S>{0, 0, 0, 1};
  CHECK(got[0] == i.w + j.w + k.w);
  CHECK(got[1] == i.x + j.x + k.x);
  CHECK(got[2] == i.y + j.y + k.y);
  CHECK(got[3] == i.z + j.z + k.z);
}
