// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/euler_312.hpp"

#include "catch.hpp"

#include <random>

#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;

namespace {

template <class S>
Mat3<S> product(S psi, S phi, S theta) {
  const auto about = [](const Vec3<S>& axis, S angle) { return to_matrix(quaternion_from_vector<S>(axis * angle)); };
  return about({0, 0, 1}, theta) * about({1, 0, 0}, psi) * about({0, 1, 0}, phi);
}

}  // namespace

TEMPLATE_TEST_CASE("3-1-2 angles: product of rotations, and back", "[rotation]", float, double, long double) {
  using S = TestType;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  const S eps = epsilon<S>;
  for (int i = 0; i < 300; ++i) {
    const S scale = i % 3 == 0 ? S(1e-4) : S(1);
    const S psi = S(1.55) * scale * S(any(random)), phi = S(3.14) * scale * S(any(random)),
            theta = S(3.14) * S(any(random));
    const Quat<S> q = quaternion_from_312(psi, phi, theta);
    CHECK(std::abs(norm(q) - 1) < 4 * eps);
    CHECK((to_matrix(q) - product(psi, phi, theta)).norm() < 16 * eps);
    const Vec3<S> back = angles_312(q);
    const S lever = 1 / std::cos(psi);
    CHECK(std::abs(back[0] - psi) <= 8 * eps * std::max(scale, std::abs(psi)));
    CHECK(std::abs(back[1] - phi) <= 16 * eps * lever * std::max(scale, std::abs(phi)));
    CHECK(std::abs(back[2] - theta) <= 16 * eps * lever * 4);
  }
}

TEST_CASE("3-1-2 angles at gimbal lock and of what is not a number", "[rotation]") {
  const double half = gyrostat::pi<double> / 2;
  for (const double sign : {-1.0, 1.0}) {
    // only phi + sign theta is left
    const Vec3<double> back = angles_312(quaternion_from_312(sign * half, 0.3, 0.4));
    CHECK(back[0] == Approx(sign * half).epsilon(1e-15));
    const Quat<double> q = quaternion_from_312(back[0], back[1], back[2]);
    CHECK((to_matrix(q) - product(sign * half, 0.3, 0.4)).norm() < 1e-14);
  }
  CHECK(std::isnan(angles_312(Quat<double>{gyrostat::nan<double>, 0, 0, 0})[0]));
}
