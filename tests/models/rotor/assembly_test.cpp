// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/assembly.hpp"

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "catch.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

/// Inertia of point masses about their mass centre.
Mat3<double> inertia_of(const std::vector<std::pair<double, Vec3<double>>>& points) {
  double mass = 0;
  Vec3<double> centre(0, 0, 0);
  for (const auto& [m, r] : points) mass += m, centre += m * r;
  centre /= mass;
  Mat3<double> theta = Mat3<double>::Zero();
  for (const auto& [m, r] : points) {
    const Vec3<double> d = r - centre;
    theta += m * (d.squaredNorm() * Mat3<double>::Identity() - d * d.transpose());
  }
  return theta;
}

}  // namespace

TEST_CASE("theta of carrier and rotor is that of all their points", "[rotor]") {
  Bodies bodies(4);
  for (int trial = 0; trial < 20; ++trial) {
    // a carrier of ten points, and a rotor of two rings about its axis
    std::vector<std::pair<double, Vec3<double>>> carrier, wheel;
    double m1 = 0, m2 = 0;
    Vec3<double> c1(0, 0, 0);
    for (int i = 0; i < 10; ++i) {
      carrier.emplace_back(bodies.uniform(0.5, 2), bodies.direction() * bodies.uniform(0.1, 1));
      m1 += carrier.back().first;
      c1 += carrier.back().first * carrier.back().second;
    }
    c1 /= m1;
    Assembly<double> parts;
    parts.axis = bodies.direction();
    parts.offset = bodies.direction() * bodies.uniform(0, 2);
    const Vec3<double> a = parts.axis.unitOrthogonal(), b = parts.axis.cross(a);
    for (const double height : {-0.1, 0.1}) {
      for (int i = 0; i < 12; ++i) {
        const double angle = i * pi<double> / 6;
        wheel.emplace_back(0.05,
                           c1 + parts.offset + 0.4 * (std::cos(angle) * a + std::sin(angle) * b) + height * parts.axis);
        m2 += 0.05;
      }
    }
    const Mat3<double> own = inertia_of(wheel);
    parts.carrier_inertia = inertia_of(carrier);
    parts.carrier_mass = m1;
    parts.rotor_mass = m2;
    parts.axial_inertia = parts.axis.dot(own * parts.axis);
    parts.equatorial_inertia = a.dot(own * a);
    carrier.insert(carrier.end(), wheel.begin(), wheel.end());
    const auto theta = parts.inertia();
    REQUIRE(theta);
    CHECK((*theta - inertia_of(carrier)).norm() < 1e-13 * theta->norm());
    const auto body = Gyrostat<double>::make((*theta + theta->transpose()) / 2, parts.axis, parts.axial_inertia, 1, 1);
    REQUIRE(body);
    CHECK(body->realisable());
  }
}

TEST_CASE("parts that cannot be are refused", "[rotor]") {
  Assembly<double> good;
  good.rotor_mass = 1;
  good.axial_inertia = 0.2;
  good.equatorial_inertia = 0.1;
  CHECK(good.inertia());
  const auto failure = [&](auto change) {
    Assembly<double> parts = good;
    change(parts);
    return parts.inertia().error();
  };
  CHECK(failure([](auto& p) { p.axial_inertia = 0.2001; }) == Errc::triangle_inequality);
  CHECK(failure([](auto& p) { p.rotor_mass = 0; }) == Errc::not_positive);
  CHECK(failure([](auto& p) { p.carrier_mass = -1; }) == Errc::not_positive);
  CHECK(failure([](auto& p) { p.axial_inertia = 0; }) == Errc::not_positive);
  CHECK(failure([](auto& p) { p.equatorial_inertia = 0; }) == Errc::not_positive);
  CHECK(failure([](auto& p) { p.offset[1] = gyrostat::nan<double>; }) == Errc::not_finite);
  CHECK(failure([](auto& p) { p.carrier_inertia(0, 0) = infinity<double>; }) == Errc::not_finite);
  CHECK(failure([](auto& p) { p.rotor_mass = infinity<double>; }) == Errc::not_finite);
}
