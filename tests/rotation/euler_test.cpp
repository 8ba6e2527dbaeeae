// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/euler.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "gyrostat/rotation/euler_312.hpp"

using namespace gyrostat;

namespace {

std::vector<EulerAxes> all_axes() {
  std::vector<EulerAxes> made;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        if (i != j && j != k) made.push_back({i, j, k});
  return made;
}

double turn_between(const Quat<double>& p, const Quat<double>& q) {
  const Quat<double> d = conjugate(p) * q;
  return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

Mat3<double> turn_about(int axis, double angle) {
  Mat3<double> R = Mat3<double>::Identity();
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  R(a, a) = R(b, b) = std::cos(angle);
  R(b, a) = std::sin(angle), R(a, b) = -std::sin(angle);
  return R;
}

}  // namespace

TEST_CASE("the quaternion of three angles is the product of three turns") {
  CHECK(all_axes().size() == 12);
  for (const auto& axes : all_axes()) {
    const Vec3<double> a(0.4, -1.1, 2.3);
    const Mat3<double> R = turn_about(axes[0], a[0]) * turn_about(axes[1], a[1]) * turn_about(axes[2], a[2]);
    const Vec3<double> v(0.3, -0.7, 0.2), turned = rotate<double>(quaternion_from_euler(axes, a), v);
    CHECK((turned - R * v).norm() < 1e-15);
  }
}

TEST_CASE("angles come back in their ranges, near the lock and at it too") {
  for (const auto& axes : all_axes()) {
    const bool proper = axes[0] == axes[2];
    for (const double off : {1.0, 0.3, 1e-4, 1e-9, 1e-15, 0.0})
      for (const double side : {-1.0, 1.0})
        for (const double first : {-3.0, -0.2, 1.9})
          for (const double last : {-1.2, 0.0, 2.9}) {
            // second angle at `off` from the lock
            const double lock = proper ? (side > 0 ? 0 : pi<double>) : side * pi<double> / 2;
            const Vec3<double> a(first, lock - (proper ? -side : side) * off, last);
            const Quat<double> q = quaternion_from_euler(axes, a);
            const auto found = euler_angles(axes, q);
            CAPTURE(axes[0], axes[1], axes[2], off, side, first, last);
            CHECK(turn_between(q, quaternion_from_euler(axes, found.angles)) < 2e-15);
            CHECK(std::abs(found.from_lock - off) < 1e-15);
            if (off > 1e-5) CHECK((found.angles - a).norm() < 4e-15 / off);
            CHECK(std::abs(found.angles[0]) <= pi<double>);
            CHECK(std::abs(found.angles[2]) <= pi<double>);
          }
  }
}

TEST_CASE("3-1-2 angles are those of the spinning family in another order") {
  const Quat<double> q = normalised(Quat<double>{0.5, -0.3, 0.7, 0.2});
  const Vec3<double> known = angles_312(q), found = euler_angles({2, 0, 1}, q).angles;
  CHECK((found - Vec3<double>(known[2], known[0], known[1])).norm() < 1e-15);
}

TEST_CASE("no error of the attitude makes more of the angles than is stated") {
  for (const auto& axes : all_axes())
    for (const double off : {0.7, 1e-2, 1e-5})
      for (const double error : {1e-9, 1e-3, 0.3}) {
        const bool proper = axes[0] == axes[2];
        const Vec3<double> a(0.3, proper ? off : pi<double> / 2 - off, -0.8);
        const auto at = euler_angles(axes, quaternion_from_euler(axes, a));
        const double stated = at.error(error);
        CHECK((stated == infinity<double>) == !(off - error > 1e-8));
        if (stated == infinity<double>) continue;
        double most = 0;
        for (int n = 0; n < 300; ++n) {
          const double u = -1 + (n + 0.5) / 150, angle = 2.4 * n, s = std::sqrt(1 - u * u);
          const Vec3<double> half = std::sin(error / 2) * Vec3<double>(s * std::cos(angle), s * std::sin(angle), u);
          const Quat<double> beside =
              quaternion_from_euler(axes, a) * Quat<double>{std::cos(error / 2), half[0], half[1], half[2]};
          const Vec3<double> d = euler_angles(axes, beside).angles - a;
          most = std::max(most, d.norm());
        }
        CAPTURE(axes[0], axes[1], axes[2], off, error, most, stated);
        CHECK(most <= stated * (1 + 1e-6));
        if (error < 0.01 * off) CHECK(stated < 1.2 * most);
      }
}
