// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/invariants.hpp"

#include <cmath>
#include <utility>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;

TEST_CASE("energy and the length of the momentum do not depend on the axes") {
  Mat3<double> J;
  J << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  const Vec3<double> omega(0.3, -0.7, 1.1), l(0.2, 0.5, -0.4);
  const double h = carrier_energy<double>(J, omega);
  const double M = safe_norm<double>(total_momentum<double>(J, omega, l));
  for (const double angle : {0.0, 1e-8, 0.7, 3.1}) {
    const Mat3<double> R = matrix_from_vector<double>(angle * Vec3<double>(2, -1, 2) / 3);
    const Mat3<double> turned = R * J * R.transpose();
    CHECK(carrier_energy<double>(turned, R * omega) == Approx(h).epsilon(1e-14));
    CHECK(safe_norm<double>(total_momentum<double>(turned, R * omega, R * l)) == Approx(M).epsilon(1e-14));
  }
}

TEST_CASE("the free gyrostat conserves both, to first order in a short step") {
  const Vec3<long double> moments(35, 22, 16), omega(0.3L, -0.7L, 1.1L), l(20, 5, -14);
  const Mat3<long double> J = moments.asDiagonal();
  const Vec3<long double> M = total_momentum<long double>(J, omega, l);
  const Vec3<long double> rate = cross<long double>(M, omega);
  const auto after = [&](long double t) {
    const Vec3<long double> moved = M + t * rate;
    const Vec3<long double> turned = (moved - l).cwiseQuotient(moments);
    return std::pair{carrier_energy<long double>(J, turned), safe_norm<long double>(moved)};
  };
  const long double step = 1e-6L;
  CHECK(std::abs(after(step).first - after(-step).first) / (2 * step) <= 1e-9L);
  CHECK(std::abs(after(step).second - after(-step).second) / (2 * step) <= 1e-9L);
}

TEST_CASE("the length neither overflows nor underflows") {
  CHECK(safe_norm<double>({3e200, 0, 4e200}) == Approx(5e200));
  CHECK(safe_norm<double>({0, 3e-200, 4e-200}) == Approx(5e-200).margin(0));
  CHECK(std::isnan(safe_norm<double>({gyrostat::nan<double>, 0, 0})));
}
