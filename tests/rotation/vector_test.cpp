// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/vector.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "catch.hpp"
#include "gyrostat/core/double_double.hpp"

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

TEMPLATE_TEST_CASE("a magnitude has its digits however great or small it is", "", float, double, long double,
                   DoubleDouble) {
  using S = TestType;
  const auto of = [](S scale) { return magnitude(Vec3<S>(2 * scale, -3 * scale, 6 * scale)) / scale; };
  // squares of these overflow or vanish in every one of the types but for 1
  const S great = std::is_same_v<S, float> ? S(1e37f) : std::is_same_v<S, DoubleDouble> ? S(1e160) : S(1e300);
  for (const S scale : {S(1), great, 1 / great, 1 / great / 8})
    CHECK(double(of(scale) - 7) == Approx(0).margin(16 * double(epsilon<S>)));
  CHECK(magnitude(Vec3<S>(0, 0, 0)) == 0);
  CHECK(magnitude(Vec3<S>(0, -std::numeric_limits<S>::min(), 0)) == std::numeric_limits<S>::min());
  CHECK(magnitude(Vec3<S>(1, -infinity<S>, 0)) == infinity<S>);
  const S none = magnitude(Vec3<S>(gyrostat::nan<S>, 1, 0));
  CHECK(none != none);
}

TEST_CASE("a magnitude does not hang on where the vector lies") {
  alignas(64) double room[16];
  const double v[3] = {0.1, 1.0 / 3, -2.0 / 7};
  const double here = magnitude(Vec3<double>(v[0], v[1], v[2]));
  for (int at = 0; at < 13; ++at) {
    std::copy_n(v, 3, room + at);
    CHECK(magnitude<double>(Eigen::Map<Vec3<double>>(room + at)) == here);
  }
}

TEST_CASE("a quaternion without arguments is the identity") {
  CHECK(Quat<double>{} == Quat<double>{1, 0, 0, 0});
  CHECK(std::is_trivially_copyable_v<Quat<double>>);
}
