// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/vector.hpp"

#include <type_traits>

#include "catch.hpp"

using namespace gyrostat;

TEMPLATE_TEST_CASE("the cross product and its tensor", "", float, double, long double) {
  using S = TestType;
  const Vec3<S> a(1, -2, 3), b(4, 5, -6), c(-1, 2, 2);
  CHECK(cross<S>(Vec3<S>::UnitX(), Vec3<S>::UnitY()) == Vec3<S>::UnitZ());
  CHECK(cross<S>(a, b) == Vec3<S>(-3, 18, 13));
  CHECK(cross<S>(b, a) == Vec3<S>(-cross<S>(a, b)));
  CHECK(cross_matrix<S>(a) * b == cross<S>(a, b));
  CHECK(cross_matrix<S>(a) == Mat3<S>(-cross_matrix<S>(a).transpose()));
  CHECK(cross<S>(a, cross<S>(b, c)) == Vec3<S>(b * a.dot(c) - c * a.dot(b)));
}

TEST_CASE("a quaternion without arguments is the identity") {
  CHECK(Quat<double>{} == Quat<double>{1, 0, 0, 0});
  CHECK(std::is_trivially_copyable_v<Quat<double>>);
}
