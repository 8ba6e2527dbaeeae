// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/quaternion.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "samples.hpp"

using namespace gyrostat;

namespace {

template <Real S>
S distance(const Quat<S>& a, const Quat<S>& b) {
  return norm(Quat<S>{a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z});
}

}  // namespace

TEMPLATE_TEST_CASE("the group laws hold at the identity, near it, anywhere, near half a turn", "", float, double,
                   long double) {
  using S = TestType;
  const S tight = 8 * epsilon<S>;
  const Quat<S> one;
  const Quat<S> other = quaternion_from_vector<S>({S(0.3), S(-1.1), S(0.7)});
  const Quat<S> third = quaternion_from_vector<S>({S(-2), S(0.4), S(1)});
  const Vec3<S> v(S(0.6), S(-0.2), S(1.5));
  for (const Vec3<S>& rotation : sample_rotations<S>()) {
    const Quat<S> q = quaternion_from_vector(rotation);
    CHECK(std::abs(norm(q) - 1) <= tight);
    CHECK(q * one == q);
    CHECK(one * q == q);
    CHECK(distance(q * conjugate(q), one) <= tight);
    CHECK(distance((q * other) * third, q * (other * third)) <= tight);
    CHECK((rotate(q * other, v) - rotate(q, rotate(other, v))).norm() <= 4 * tight);
    CHECK((rotate(conjugate(q), rotate(q, v)) - v).norm() <= 4 * tight);
    CHECK(std::abs(rotate(q, v).norm() - v.norm()) <= 2 * tight);
    CHECK((to_matrix(q) * v - rotate(q, v)).norm() <= 2 * tight);
    CHECK((to_matrix(q * other) - to_matrix(q) * to_matrix(other)).norm() <= 2 * tight);

    const Mat3<S> R = to_matrix(q);
    CHECK((R.transpose() * R - Mat3<S>::Identity()).norm() <= 2 * tight);
    CHECK(cross<S>(R.col(0), R.col(1)).dot(R.col(2)) > 0);

    const Quat<S> back = from_matrix(R);
    CHECK(back.w >= 0);
    const Quat<S> opposite{-back.w, -back.x, -back.y, -back.z};
    CHECK(std::min(distance(back, q), distance(opposite, q)) <= 4 * epsilon<S>);
  }
}

TEST_CASE("a rotation tensor keeps the relative accuracy of a tiny rotation") {
  for (const double angle : {1e-300, 1e-100, 1e-30, 1e-16, 1e-8, 1e-4}) {
    const Quat<double> q = quaternion_from_vector<double>({0.6 * angle, 0, -0.8 * angle});
    const Quat<double> back = from_matrix(to_matrix(q));
    CHECK(std::abs(back.x - q.x) <= 4e-16 * angle);
    CHECK(std::abs(back.z - q.z) <= 4e-16 * angle);
    CHECK(back.w == Approx(q.w).epsilon(1e-15));
  }
}

TEST_CASE("signed permutations convert exactly enough to give themselves back") {
  for (int i = 0; i < 3; ++i)
    for (const double si : {1.0, -1.0})
      for (int j = 0; j < 3; ++j)
        for (const double sj : {1.0, -1.0}) {
          if (i == j) continue;
          Mat3<double> R = Mat3<double>::Zero();
          R(i, 0) = si;
          R(j, 1) = sj;
          R.col(2) = cross<double>(R.col(0), R.col(1));
          CHECK((to_matrix(from_matrix(R)) - R).cwiseAbs().maxCoeff() <= 4.5e-16);
        }
}

TEST_CASE("the norm neither overflows nor underflows, and nothing has no direction") {
  CHECK(norm(Quat<double>{3e200, 0, 4e200, 0}) == Approx(5e200));
  CHECK(norm(Quat<double>{3e-200, 0, 4e-200, 0}) == Approx(5e-200).epsilon(1e-12));
  CHECK(normalised(Quat<double>{0, 0, 2, 0}) == Quat<double>{0, 0, 1, 0});
  CHECK(std::isnan(normalised(Quat<double>{0, 0, 0, 0}).w));
  CHECK(std::isnan(normalised(Quat<double>{gyrostat::nan<double>, 0, 0, 1}).z));
}

TEST_CASE("a quaternion of unit norm to rounding is left as it stands", "[rotation]") {
  const Quat<double> unit = normalised(Quat<double>{0.3, -0.7, 0.2, 0.61});
  CHECK(as_unit(unit) == unit);
  const Quat<double> longer{unit.w * (1 + 1e-9), unit.x, unit.y, unit.z};
  CHECK(as_unit(longer) == normalised(longer));
}

TEST_CASE("the angle between attitudes keeps its digits and ignores the signs of quaternions", "[rotation]") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (double angle = 3.1; angle > 1e-15; angle /= 7) {
    const Quat<double> q = normalised(Quat<double>{normal(random), normal(random), normal(random), normal(random)});
    const Vec3<double> axis = Vec3<double>(normal(random), normal(random), normal(random)).normalized();
    const Quat<double> turned = q * quaternion_from_vector<double>(axis * angle);
    CHECK(angle_between(q, turned) == Approx(angle).epsilon(1e-9).margin(4e-16));
    CHECK(angle_between(q, Quat<double>{-turned.w, -turned.x, -turned.y, -turned.z}) ==
          Approx(angle).epsilon(1e-9).margin(4e-16));
  }
}
