// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/attitude.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/rotation/quaternion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Mat3<double> about(int axis, double angle) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Mat3<double> R = Mat3<double>::Identity();
  R(j, j) = R(k, k) = std::cos(angle);
  R(k, j) = std::sin(angle);
  R(j, k) = -R(k, j);
  return R;
}

Vec3<double> down_of(double theta, double phi) {
  return {std::sin(theta) * std::sin(phi), std::sin(theta) * std::cos(phi), std::cos(theta)};
}

}  // namespace

TEST_CASE("heavy attitude: three turns, and a last row that points up", "[heavy]") {
  for (double theta : {1e-9, 0.3, 1.5, 2.8, 3.14159})
    for (double psi : {-2.0, 0.4, 9.0})
      for (double phi : {-1.0, 0.7, 50.0}) {
        const Vec3<double> down = down_of(theta, phi);
        const Mat3<double> R = to_matrix(attitude_from_angles(psi, phi, down));
        const Mat3<double> want = about(0, pi<double>) * about(2, psi) * about(0, theta) * about(2, phi);
        CHECK((R - want).norm() < 1e-14);
        CHECK((R.row(2).transpose() + down).norm() < 1e-15);
      }
}

TEST_CASE("heavy attitude: phi is counted on over many turns", "[heavy]") {
  for (double u : {-40.0, 0.0, 3.0, 1000.0})
    for (double off : {-0.5, 0.0, 0.2})
      CHECK(spin_angle(down_of(1.1, pi<double> / 2 + u + off), u, math::unit(u)) ==
            Approx(pi<double> / 2 + u + off).epsilon(1e-14));
}
