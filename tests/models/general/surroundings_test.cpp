// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/surroundings.hpp"

#include <cmath>

#include "catch.hpp"

namespace general_surroundings_test {

using namespace gyrostat;
using namespace gyrostat::general;

Orbit<double> orbit_of(double e) {
  Orbit<double> orbit;
  orbit.radius = 2, orbit.mu = 3, orbit.eccentricity = e, orbit.true_anomaly = 0.7;
  orbit.radial = {0.6, 0.8, 0}, orbit.along = {0, 0, 1};
  return orbit;
}

TEST_CASE("the angle of a clock keeps its digits over many turns", "[general]") {
  for (const double t : {0., 0.3, -2e3, 3.1e5, 7.7e6}) {
    const auto at = clock_angle(1.7, t, 0.4);
    const long double angle =
        static_cast<long double>(1.7) * static_cast<long double>(t) + static_cast<long double>(0.4);
    CAPTURE(t);
    CHECK(std::abs(double(at.sine - std::sin(angle))) < 2e-12);
    CHECK(std::abs(double(at.cosine - std::cos(angle))) < 2e-12);
    CHECK(at.sine * at.sine + at.cosine * at.cosine == Approx(1).epsilon(1e-15));
  }
}

TEST_CASE("an orbit obeys the law of gravity", "[general]") {
  for (const double e : {0., 1e-9, 0.1, 0.6, 0.95}) {
    const auto orbit = orbit_of(e);
    for (const double t : {0., 0.4, 3., 40., -2.}) {
      const auto at = orbit_at(orbit, t);
      CAPTURE(e, t);
      const auto place = [&](double when) {
        const auto there = orbit_at(orbit, when);
        return Vec3<double>(there.radius * there.radial);
      };
      const double h = 1e-3 / at.rate;
      const Vec3<double> pull = (place(t + h) - 2 * place(t) + place(t - h)) / (h * h);
      CHECK((pull + orbit.mu / (at.radius * at.radius) * at.radial).norm() < 1e-4 * pull.norm());
      const Vec3<double> speed = (place(t + h) - place(t - h)) / (2 * h);
      CHECK((speed - at.radial_rate * at.radial - at.radius * at.rate * at.along).norm() < 1e-5 * speed.norm());
      // energy and momentum are those of the start
      const auto first = orbit_at(orbit, 0.);
      const auto energy = [&](const OrbitPoint<double>& p) {
        return (p.radial_rate * p.radial_rate + p.radius * p.radius * p.rate * p.rate) / 2 - orbit.mu / p.radius;
      };
      CHECK(energy(at) == Approx(energy(first)).epsilon(1e-12));
      CHECK(at.radius * at.radius * at.rate == Approx(first.radius * first.radius * first.rate).epsilon(1e-13));
      CHECK(at.gradient == Approx(3 * orbit.mu / std::pow(at.radius, 3)));
    }
  }
  const auto start = orbit_at(orbit_of(0.6), 0.);
  CHECK(start.radius == Approx(2));
  CHECK((start.radial - orbit_of(0).radial).norm() < 1e-15);
}

TEST_CASE("an orbit by a later clock is the same one", "[general]") {
  for (const double e : {0.0, 0.3, 0.95}) {
    Orbit<double> orbit;
    orbit.mu = 2, orbit.radius = 1.5, orbit.eccentricity = e, orbit.true_anomaly = 0.7;
    const auto later = orbit_from(orbit, 3.0);
    for (const double t : {0.0, 0.4, 5.0}) {
      const auto one = orbit_at(orbit, 3.0 + t), other = orbit_at(later, t);
      CHECK((one.radial - other.radial).norm() < 1e-12);
      CHECK((one.along - other.along).norm() < 1e-12);
      CHECK(other.radius == Approx(one.radius).epsilon(1e-12));
    }
  }
}

TEST_CASE("Kepler's equation is solved near a parabola too", "[general]") {
  for (const double e : {0.5, 0.99, 0.999999})
    for (const double M : {0., 1e-8, 0.1, 3., 3.2, 6.2, 100.}) {
      const double E = general::detail::eccentric_anomaly(M, e);
      CHECK(std::abs(E - e * std::sin(E) - M) <= 1e-15 * (1 + 4 * M));
    }
}

TEST_CASE("the rate of a field is its derivative", "[general]") {
  Problem<double> p;
  p.orbit = orbit_of(0.3);
  p.field.flux_density = {1, 2, -3}, p.field.axis = {0, 0.6, 0.8};
  p.field.rate = 0.3, p.field.strength = 2, p.field.radius = 1.5;
  for (const auto kind :
       {MagneticField::none, MagneticField::uniform, MagneticField::rotating, MagneticField::dipole}) {
    p.field.magnetic = kind;
    for (const double t : {0., 2., 17.}) {
      const double h = 1e-5;
      const Vec3<double> rate = (field_at(p, t + h).flux_density - field_at(p, t - h).flux_density) / (2 * h);
      CAPTURE(int(kind), t);
      CHECK((rate - field_at(p, t).rate).norm() < 1e-8);
    }
  }
  // over the equator of a dipole, and on its axis
  p.orbit->eccentricity = 0, p.orbit->radius = 1.5;
  p.field.axis = cross<double>(p.orbit->radial, p.orbit->along);
  CHECK((field_at(p, 1.).flux_density - 2 * p.field.axis).norm() < 1e-14);
  p.field.axis = p.orbit->radial;
  CHECK((field_at(p, 0.).flux_density + 4 * p.field.axis).norm() < 1e-14);
}

}  // namespace general_surroundings_test
