// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/principal_axes.hpp"

#include <random>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;

namespace {

template <Real S>
Mat3<S> turned(const Vec3<S>& moments, const Vec3<S>& turn) {
  const Mat3<S> R = matrix_from_vector<S>(turn);
  const Mat3<S> J = R * moments.asDiagonal() * R.transpose();
  return (J + J.transpose()) / 2;
}

}  // namespace

TEMPLATE_TEST_CASE("a diagonal tensor keeps its axes and its order", "", float, double, long double) {
  using S = TestType;
  for (const Vec3<S>& moments : {Vec3<S>(1, 2, 3), Vec3<S>(3, 1, 2), Vec3<S>(2, 2, 1)}) {
    const auto axes = PrincipalAxes<S>::nearest(moments.asDiagonal());
    CHECK(axes.moments == moments);
    CHECK(axes.R_BP == Mat3<S>::Identity());
  }
}

TEMPLATE_TEST_CASE("a turn by less than half a right angle is found again, in any order of the moments", "", float,
                   double, long double) {
  using S = TestType;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const Vec3<S> moments = i % 2 == 0 ? Vec3<S>(1, 2, S(2.5)) : Vec3<S>(S(2.5), 1, 2);
    const Vec3<S> turn = S(0.4) * Vec3<S>(S(part(random)), S(part(random)), S(part(random)));
    const auto axes = PrincipalAxes<S>::nearest(turned<S>(moments, turn));
    CHECK((axes.moments - moments).norm() <= 32 * epsilon<S>);
    CHECK((axes.R_BP - matrix_from_vector<S>(turn)).norm() <= 64 * epsilon<S>);
  }
}

TEST_CASE("any turn: a proper rotation that gives the tensor back, no axis more than a right angle from the body's") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(-3, 3);
  for (int i = 0; i < 300; ++i) {
    const Vec3<double> moments = i % 3 == 0 ? Vec3<double>(2, 2, 1) : Vec3<double>(1, 1.4, 2);
    const Mat3<double> J = turned<double>(moments, {part(random), part(random), part(random)});
    const auto [found, R, gaps] = PrincipalAxes<double>::nearest(J);
    CHECK((R * found.asDiagonal() * R.transpose() - J).norm() <= 1e-14);
    CHECK((R.transpose() * R - Mat3<double>::Identity()).norm() <= 1e-14);
    CHECK(cross<double>(R.col(0), R.col(1)).dot(R.col(2)) > 0);
    CHECK(R(0, 0) >= 0);
    CHECK(R(2, 2) >= 0);
  }
}

TEST_CASE("the symmetric part, or why there is none") {
  Mat3<double> J = Vec3<double>(1, 2, 2.5).asDiagonal();
  J(0, 1) = 1e-15;
  const auto symmetric = symmetric_part<double>(J);
  REQUIRE(symmetric);
  CHECK(*symmetric == symmetric->transpose());
  CHECK((*symmetric)(1, 0) == 0.5e-15);
  J(0, 1) = 1e-13;
  CHECK(symmetric_part<double>(J).error() == Errc::not_symmetric);
  J(0, 1) = gyrostat::nan<double>;
  CHECK(symmetric_part<double>(J).error() == Errc::not_finite);
}
