// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Orbit and magnetic field at a time (docs/general.md, section 1.3), inertial axes.
namespace gyrostat::general {

/// Sine and cosine of an angle that grows evenly with time.
template <Real Scalar>
struct ClockAngle {
  Scalar sine, cosine;
};

/// Of the angle rate t + phase, rad, to rounding however many turns it has: what the product loses counts, too.
template <Real Scalar>
ClockAngle<Scalar> clock_angle(Scalar rate, Scalar t, Scalar phase = 0) noexcept {
  using std::cos, std::fma, std::sin;
  const Scalar whole = rate * t, rest = fma(rate, t, -whole) + phase;
  const Scalar s = sin(whole), c = cos(whole), s_rest = sin(rest), c_rest = cos(rest);
  return {s * c_rest + c * s_rest, c * c_rest - s * s_rest};
}

/// Where on its orbit the mass centre is.
template <Real Scalar>
struct OrbitPoint {
  Vec3<Scalar> radial{1, 0, 0}, along{0, 1, 0};  ///< unit: outward, and along track
  Scalar radius = 1;                             ///< m
  Scalar radial_rate = 0;                        ///< its derivative, m/s
  Scalar rate = 0;                               ///< at which the two turn about the normal, rad/s
  Scalar gradient = 0;                           ///< N = 3 mu/r^3, 1/s^2
};

namespace detail {

/// E of E - e sin E = M, by Newton's method in a bracket.
template <Real Scalar>
Scalar eccentric_anomaly(Scalar M, Scalar e) noexcept {
  using std::abs, std::cos, std::sin;
  Scalar low = M - e, high = M + e, E = M + e * sin(M);
  for (int trip = 0; trip < 100; ++trip) {
    const Scalar excess = E - e * sin(E) - M;
    (excess > 0 ? high : low) = E;
    Scalar next = E - excess / (1 - e * cos(E));
    if (!(next >= low && next <= high)) next = low + (high - low) / 2;
    const bool done = abs(next - E) <= epsilon<Scalar> * std::max(Scalar(1), abs(E));
    E = next;
    if (done) break;
  }
  return E;
}

/// The anomalies on an ellipse.
template <Real Scalar>
struct Anomalies {
  Scalar flat;   ///< sqrt(1 - e^2)
  Scalar axis;   ///< greater half axis, m
  Scalar mean;   ///< mean motion, rad/s
  Scalar begin;  ///< eccentric anomaly at t = 0
  Scalar now;    ///< and at t, whole turns counted

  Anomalies(const Orbit<Scalar>& orbit, Scalar t) noexcept {
    using std::atan2, std::cos, std::sin, std::sqrt;
    const Scalar e = orbit.eccentricity, c = cos(orbit.true_anomaly), s = sin(orbit.true_anomaly);
    flat = sqrt((1 - e) * (1 + e));
    axis = orbit.radius * (1 + e * c) / (flat * flat);
    mean = sqrt(orbit.mu / axis) / axis;
    begin = atan2(flat * s, e + c);
    now = eccentric_anomaly(begin - e * sin(begin) + mean * t, e);
  }
};

}  // namespace detail

/// Where on the orbit it is at t, s. The eccentric anomaly takes up to 100 steps; a circle needs none.
template <Real Scalar>
OrbitPoint<Scalar> orbit_at(const Orbit<Scalar>& orbit, Scalar t) noexcept {
  using std::atan2, std::cos, std::sin, std::sqrt;
  const Scalar e = orbit.eccentricity, r0 = orbit.radius;
  Scalar c, s;  // of the angle from the radius at t = 0
  OrbitPoint<Scalar> made;
  if (e == 0) {
    made.rate = sqrt(orbit.mu / r0) / r0;
    made.radius = r0;
    c = cos(made.rate * t), s = sin(made.rate * t);
  } else {
    const Scalar c0 = cos(orbit.true_anomaly), s0 = sin(orbit.true_anomaly);
    const auto [flat, axis, mean, E0, E] = detail::Anomalies<Scalar>(orbit, t);
    const Scalar near = 1 - e * cos(E);
    const Scalar x = (cos(E) - e) / near, y = flat * sin(E) / near;  // from the pericentre
    c = x * c0 + y * s0, s = y * c0 - x * s0;
    made.radius = axis * near;
    made.radial_rate = axis * mean * e * sin(E) / near;
    made.rate = mean * flat / (near * near);
  }
  made.radial = c * orbit.radial + s * orbit.along;
  made.along = c * orbit.along - s * orbit.radial;
  made.gradient = 3 * (orbit.mu / made.radius) / (made.radius * made.radius);
  return made;
}

/// The angle from the radius at t = 0 to that at t, whole turns counted, rad.
template <Real Scalar>
Scalar orbit_angle(const Orbit<Scalar>& orbit, Scalar t) noexcept {
  using std::atan2, std::cos, std::sin, std::sqrt;
  const Scalar e = orbit.eccentricity;
  if (e == 0) return sqrt(orbit.mu / orbit.radius) / orbit.radius * t;
  const detail::Anomalies<Scalar> of(orbit, t);
  const Scalar share = e / (1 + of.flat);
  const auto ahead = [share](Scalar E) noexcept { return 2 * atan2(share * sin(E), 1 - share * cos(E)); };
  return of.now - of.begin + (ahead(of.now) - ahead(of.begin));
}

/// The same orbit by a clock that begins at t.
template <Real Scalar>
Orbit<Scalar> orbit_from(const Orbit<Scalar>& orbit, Scalar t) noexcept {
  const OrbitPoint<Scalar> then = orbit_at(orbit, t);
  Orbit<Scalar> made = orbit;
  made.radius = then.radius, made.radial = then.radial, made.along = then.along;
  made.true_anomaly += orbit_angle(orbit, t);
  return made;
}

/// The magnetic field in one place, inertial axes.
template <Real Scalar>
struct MagneticPoint {
  Vec3<Scalar> flux_density{0, 0, 0};  ///< B, T
  Vec3<Scalar> rate{0, 0, 0};          ///< its derivative, T/s
};

/// The field where the body is.
template <Real Scalar>
MagneticPoint<Scalar> field_at(const Problem<Scalar>& problem, Scalar t) noexcept {
  const auto& field = problem.field;
  const Vec3<Scalar>& k = field.axis;
  switch (field.magnetic) {
    case MagneticField::none: break;
    case MagneticField::uniform: return {field.flux_density, {0, 0, 0}};
    case MagneticField::rotating: {
      const Vec3<Scalar> along = k * k.dot(field.flux_density), across = field.flux_density - along;
      const Vec3<Scalar> ahead = cross<Scalar>(k, across);
      const auto [s, c] = clock_angle(field.rate, t);
      return {along + c * across + s * ahead, field.rate * (c * ahead - s * across)};
    }
    case MagneticField::dipole: {
      const auto at = orbit_at(*problem.orbit, t);
      const Scalar ratio = field.radius / at.radius, b = field.strength * ratio * ratio * ratio;
      const Scalar out = k.dot(at.radial), on = k.dot(at.along);
      const Vec3<Scalar> shape = k - 3 * out * at.radial;
      return {b * shape,
              -3 * (at.radial_rate / at.radius) * b * shape - 3 * at.rate * b * (on * at.radial + out * at.along)};
    }
  }
  return {};
}

}  // namespace gyrostat::general
