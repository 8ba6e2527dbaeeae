// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/rotor.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("relative and absolute rotor momentum give the same total") {
  Mat3<double> J;
  J << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  const Vec3<double> omega(0.3, -0.7, 1.1);
  const auto rotor = Rotor<double>::from_axis({0.48, 0.6, 0.64}, 0.35);
  REQUIRE(rotor);
  const double rate = 30;
  const Vec3<double> M = J * omega + rotor->relative_momentum(rate);
  const double p = rotor->absolute_momentum(rate, omega);
  CHECK((rotor->inertia_without(J) * omega + p * rotor->axis() - M).norm() <= 1e-14);
  CHECK(rotor->relative_rate(p, omega) == Approx(rate).epsilon(1e-15));
}

TEST_CASE("the axis is of unit length within 1e-8 and normalised") {
  using R = Rotor<double>;
  const auto rotor = R::from_axis({0, 0, 1 + 5e-9}, 0.1);
  REQUIRE(rotor);
  CHECK(rotor->axis() == Vec3<double>(0, 0, 1));
  CHECK(rotor->axial_inertia() == 0.1);
  CHECK(R::from_axis({0, 0, 1 + 2e-8}, 0.1).error() == Errc::out_of_domain);
  CHECK(R::from_axis({0, 0, 0}, 0.1).error() == Errc::zero_vector);
  CHECK(R::from_axis({0, 0, 1}, 0).error() == Errc::not_positive);
  CHECK(R::from_axis({0, 0, 1}, -1).error() == Errc::not_positive);
  CHECK(R::from_axis({0, 0, 1}, infinity<double>).error() == Errc::not_finite);
  CHECK(R::from_axis({0, gyrostat::nan<double>, 1}, 1).error() == Errc::not_finite);
}

TEST_CASE("the thinnest disc has its axial inertia and no second moment along its axis") {
  const Vec3<double> axis(0.48, 0.6, 0.64);
  const auto rotor = Rotor<double>::from_axis(axis, 0.35);
  REQUIRE(rotor);
  const Mat3<double> second = rotor->least_second_moments();
  CHECK(second.trace() == Approx(0.35));
  CHECK((second * axis).norm() <= 1e-16);
  const Mat3<double> J = second.trace() * Mat3<double>::Identity() - second;
  CHECK(axis.dot(J * axis) == Approx(0.35));
}
