// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/exp_log.hpp"

#include <cmath>

#include "catch.hpp"
#include "samples.hpp"

using namespace gyrostat;

TEMPLATE_TEST_CASE("exp and log are inverse to a few ulp on the open ball of half a turn", "", float, double,
                   long double) {
  using S = TestType;
  for (const Vec3<S>& v : sample_rotations<S>()) {
    const S angle = v.norm();
    if (angle > pi<S> * (1 - 8 * epsilon<S>)) continue;
    const Quat<S> q = quaternion_from_vector(v);
    CHECK((vector_from_quaternion(q) - v).norm() <= 6 * epsilon<S> * angle);
    CHECK((vector_from_quaternion(Quat<S>{-q.w, -q.x, -q.y, -q.z}) - v).norm() <= 6 * epsilon<S> * angle);
    CHECK((matrix_from_vector(v) - to_matrix(q)).norm() <= 12 * epsilon<S>);
    // The tensor is 1 to rounding, so the round trip through it is absolute near half a turn, relative near zero.
    CHECK((vector_from_matrix(to_matrix(q)) - v).norm() <= 12 * epsilon<S> * angle);
    CHECK((vector_from_matrix(matrix_from_vector(v)) - v).norm() <= 24 * epsilon<S> * angle);
  }
}

TEST_CASE("the relative accuracy holds down to 1e-300") {
  const Vec3<double> axis(2.0 / 7, -3.0 / 7, 6.0 / 7);
  for (const double angle : {1e-300, 1e-200, 1e-154, 1e-100, 1e-16, 1e-9, 1e-8, 1e-7}) {
    const Vec3<double> v = angle * axis;
    const Vec3<double> by_quaternion = vector_from_quaternion(quaternion_from_vector(v));
    const Vec3<double> by_matrix = vector_from_matrix(matrix_from_vector(v));
    for (int i = 0; i < 3; ++i) {
      CHECK(by_quaternion[i] == Approx(v[i]).epsilon(1e-15).margin(0));
      CHECK(by_matrix[i] == Approx(v[i]).epsilon(1e-15).margin(0));
    }
  }
  const Vec3<double> none = vector_from_quaternion(Quat<double>{});
  CHECK(none == Vec3<double>(0, 0, 0));
  CHECK(quaternion_from_vector(none) == Quat<double>{});
  CHECK(matrix_from_vector(none) == Mat3<double>::Identity());
  CHECK(vector_from_matrix<double>(Mat3<double>::Identity()) == none);
}

TEST_CASE("half a turn gives its axis, up to sign") {
  for (const Vec3<double>& v : sample_rotations<double>()) {
    if (v.norm() < 3.1415926) continue;
    for (const Vec3<double>& back :
         {vector_from_quaternion(quaternion_from_vector(v)), vector_from_matrix(matrix_from_vector(v))}) {
      CHECK(back.norm() <= pi<double> * (1 + 2e-16));
      CHECK(cross<double>(back, v).norm() <= 2e-14);
      CHECK(std::abs(back.dot(v)) == Approx(v.squaredNorm()).epsilon(1e-14));
    }
  }
}

TEST_CASE("a long rotation vector comes back as the short one") {
  const Vec3<double> axis(0.6, 0, 0.8);
  CHECK((vector_from_quaternion(quaternion_from_vector<double>(5 * axis)) - (5 - 2 * pi<double>)*axis).norm() <= 4e-15);
}

TEST_CASE("the quaternion need not be of unit norm") {
  const Vec3<double> v(0.1, 0.2, -0.3);
  const Quat<double> q = quaternion_from_vector(v);
  CHECK((vector_from_quaternion(Quat<double>{1e3 * q.w, 1e3 * q.x, 1e3 * q.y, 1e3 * q.z}) - v).norm() <= 1e-15);
}

TEST_CASE("NaN comes out where NaN goes in") {
  const Vec3<double> bad(gyrostat::nan<double>, 0, 0);
  CHECK(std::isnan(quaternion_from_vector(bad).w));
  CHECK(matrix_from_vector(bad).hasNaN());
  CHECK(vector_from_quaternion(Quat<double>{gyrostat::nan<double>, 0, 1, 0}).hasNaN());
}
