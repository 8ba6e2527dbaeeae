// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/problem.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

const Vec3<double> stone_moments{0.0011, 0.0016, 0.0020}, mass_centre{0.012, 0.009, 0.010};

Result<Problem<double>> body(const Vec3<double>& inertia, double mass, const Vec3<double>& at, double g = 9.8,
                             double n = 0) {
  return Problem<double>::make(inertia, mass, at, g, n);
}

}  // namespace

TEST_CASE("heavy torque: the components of the Euler-Poisson equations", "[heavy]") {
  const auto made = Problem<double>::make(stone_moments, 0.8, mass_centre, 9.80665, 4.6e-6);
  REQUIRE(made);
  const double A = stone_moments[0], B = stone_moments[1], C = stone_moments[2], w = 0.8 * 9.80665, N = 4.6e-6;
  const Vec3<double> omega{3, -2, 150}, d = Vec3<double>(0.3, -0.5, 0.8).normalized();
  const auto [p, q, r] = std::array{omega[0], omega[1], omega[2]};
  const Vec3<double> want{
      (B - C) * q * r + w * (mass_centre[1] * d[2] - mass_centre[2] * d[1]) + N * (C - B) * d[1] * d[2],
      (C - A) * r * p + w * (mass_centre[2] * d[0] - mass_centre[0] * d[2]) + N * (A - C) * d[2] * d[0],
      (A - B) * p * q + w * (mass_centre[0] * d[1] - mass_centre[1] * d[0]) + N * (B - A) * d[0] * d[1]};
  CHECK((made->torque(omega, d) - want).norm() <= 1e-15 * want.norm());
}

TEST_CASE("heavy body: energy and vertical momentum do not change along the torque", "[heavy]") {
  const auto made = Problem<double>::make(stone_moments, 0.8, mass_centre, 9.8, 40.0);
  REQUIRE(made);
  State<double> s{{3, -2, 15}, Vec3<double>(0.3, -0.5, 0.8).normalized(), {}};
  const Vec3<double> rate = made->torque(s.angular_velocity, s.down).cwiseQuotient(stone_moments);
  const Vec3<double> turn = s.down.cross(s.angular_velocity);
  const auto along = [&](double h) {
    State<double> moved = s;
    moved.angular_velocity += h * rate;
    moved.down += h * turn;
    return moved;
  };
  const double h = 1e-6;
  CHECK(std::abs(made->energy(along(h)) - made->energy(along(-h))) / (2 * h) < 1e-6 * made->energy(s));
  CHECK(std::abs(made->vertical_momentum(along(h)) - made->vertical_momentum(along(-h))) / (2 * h) < 1e-8);
}

TEST_CASE("heavy body: what is refused", "[heavy]") {
  CHECK(body(stone_moments, 0.8, mass_centre));
  CHECK(body({1, 1, 2.1}, 1, {0, 0, 0}).error() == Errc::triangle_inequality);
  CHECK(body(stone_moments, 0.8, {0.06, 0, 0}).error() == Errc::triangle_inequality);  // M x0^2 > (B + C - A)/2
  CHECK(body({1, 1, 2}, 1, {0, 0, 0}));                                                // a lamina
  CHECK(body({1, 1, 2}, 1, {0, 0, 0.1}).error() == Errc::triangle_inequality);  // whose centre cannot leave its plane
  CHECK(body({1, 0, 2}, 1, {0, 0, 0}).error() == Errc::not_positive);
  CHECK(body(stone_moments, 0, mass_centre).error() == Errc::not_positive);
  CHECK(body(stone_moments, 0.8, mass_centre, -9.8).error() == Errc::negative);
  CHECK(body(stone_moments, 0.8, mass_centre, 9.8, -1).error() == Errc::negative);
  CHECK(body(stone_moments, gyrostat::nan<double>, mass_centre).error() == Errc::not_finite);
  CHECK(body({1, gyrostat::infinity<double>, 1}, 1, mass_centre).error() == Errc::not_finite);
}

TEST_CASE("heavy body: realisable exactly where M (x0^2/J1 + y0^2/J2 + z0^2/J3) <= 1", "[heavy]") {
  const Vec3<double> direction = Vec3<double>(0.6, 0.48, 0.64), J(0.00125, 0.00075, 0.00035);
  const double limit = 1 / std::sqrt(0.8 * direction.cwiseAbs2().cwiseQuotient(J).sum());
  CHECK(body(stone_moments, 0.8, direction * limit * 0.999));
  CHECK_FALSE(body(stone_moments, 0.8, direction * limit * 1.001));
}
