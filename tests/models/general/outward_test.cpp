// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/outward.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/math/series.hpp"

namespace general_outward_test {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr int order = 20;

double value(const double (&c)[order + 1], double x) { return math::evaluate(c, order, x); }

Orbit<double> orbit_of(double eccentricity) {
  Orbit<double> orbit;
  orbit.radius = 2, orbit.mu = 3, orbit.eccentricity = eccentricity, orbit.true_anomaly = 0.4;
  const Vec3<double> radial = Vec3<double>(1, -2, 0.5).normalized();
  orbit.radial = radial, orbit.along = cross<double>(Vec3<double>(0.3, 1, 2).normalized(), radial).normalized();
  return orbit;
}

TEST_CASE("the axes of an orbit turn and grow as those of the orbit", "[general]") {
  for (const double e : {0., 0.02, 0.7}) {
    const auto orbit = orbit_of(e);
    for (const double t : {0., 1.7, 5.}) {
      const auto at = orbit_at(orbit, t);
      const double unit = 0.1 / at.rate;
      OrbitTurn<double, order> turn;
      turn.begin(orbit, at, unit);
      for (int k = 1; k <= order; ++k) turn.extend(k);
      double real[order + 1], imaginary[order + 1];
      for (int k = 0; k <= order; ++k) real[k] = turn.g[k][0], imaginary[k] = turn.g[k][1];
      for (const double x : {0.5, 1., 1.5}) {
        const auto there = orbit_at(orbit, t + x * unit);
        CAPTURE(e, t, x);
        const double c = value(real, x), s = value(imaginary, x);
        CHECK((c * c + s * s) * (c * c + s * s) == Approx(there.gradient / at.gradient).epsilon(1e-13));
        CHECK((c * c - s * s) / (c * c + s * s) == Approx(there.radial.dot(at.radial)).margin(1e-13));
        CHECK(2 * c * s / (c * c + s * s) == Approx(there.radial.dot(at.along)).margin(1e-13));
      }
    }
  }
}

TEST_CASE("the way outward is that of the orbit as the body sees it", "[general]") {
  // a body that turns about an axis at a constant rate, from an attitude that rounding has stretched
  const Vec3<double> axis = Vec3<double>(1, 2, -2).normalized();
  const double stretch = 1 + 1e-9;
  const Quat<double> q0 = normalised(Quat<double>{0.3, -0.5, 0.7, 0.2});
  for (const double e : {0., 0.3}) {
    const auto orbit = orbit_of(e);
    const auto at = orbit_at(orbit, 0.8);
    const double unit = 0.1 / at.rate, turn = 0.2;  // the latter in half the angle over the unit
    const auto attitude = [&](double x) {
      const double s = std::sin(turn * x);
      return q0 * Quat<double>{std::cos(turn * x), s * axis[0], s * axis[1], s * axis[2]};
    };
    OrbitTurn<double, order> orbits;
    OutwardSeries<double, order> outward;
    orbits.begin(orbit, at, unit);
    outward.begin(at, 1 / stretch);
    double power = stretch;
    for (int k = 0; k <= order; ++k) {
      // derivatives of sine and cosine
      const double c = k % 4 == 0 ? 1 : k % 4 == 2 ? -1 : 0, s = k % 4 == 1 ? 1 : k % 4 == 3 ? -1 : 0;
      const Quat<double> q = q0 * Quat<double>{c, s * axis[0], s * axis[1], s * axis[2]};
      if (k > 0) orbits.extend(k), power *= turn / k;
      outward.extend(k, lanes(power * q.w, power * q.x, power * q.y, power * q.z), orbits);
    }
    for (const double x : {0., 0.5, 1.}) {
      const auto there = orbit_at(orbit, 0.8 + x * unit);
      const Vec3<double> wanted = std::sqrt(there.gradient) * rotate<double>(conjugate(attitude(x)), there.radial);
      for (int i = 0; i < 3; ++i) {
        double c[order + 1];
        for (int k = 0; k <= order; ++k) c[k] = outward.v.v[k][i];
        CAPTURE(e, x, i);
        CHECK(value(c, x) == Approx(wanted[i]).margin(1e-13 * wanted.norm()));
      }
    }
  }
}

}  // namespace general_outward_test
