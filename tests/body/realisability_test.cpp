// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/realisability.hpp"

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;

TEST_CASE("the least second moment that is left, whatever the axes") {
  const Vec3<double> second(0.3, 0.5, 0.9);
  const Mat3<double> J = Mat3<double>(Vec3<double>(1.4, 1.2, 0.8).asDiagonal());  // of these second moments
  for (const double angle : {0., 0.4, 2.}) {
    const Mat3<double> R = matrix_from_vector<double>(angle * Vec3<double>(2, -1, 2) / 3);
    const Mat3<double> turned = R * J * R.transpose();
    CHECK(realisability<double>(turned, Mat3<double>::Zero()) == Approx(0.3));
    for (const double part : {0.1, 0.3, 0.4}) {
      const Mat3<double> known = R * Mat3<double>(Vec3<double>(part, 0, part).asDiagonal()) * R.transpose();
      CHECK(realisability<double>(turned, known) == Approx(0.3 - part).margin(1e-15));
    }
  }
}

TEST_CASE("a lamina is the limit, and beyond it no body is left") {
  const Mat3<double> none = Mat3<double>::Zero();
  CHECK(realisability<double>(Vec3<double>(1, 2, 3).asDiagonal(), none) == Approx(0).margin(1e-15));
  CHECK(realisability<double>(Vec3<double>(1, 2, 3.1).asDiagonal(), none) == Approx(-0.05));
}
