// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

namespace gyrostat::heavy {

/// Unknown: the amplitude of a free nutation of given phase upon another motion, and T.
template <Real Scalar>
struct AtPhase {
  static constexpr int unknowns = 2, conditions = 0;
  Scalar rate;             ///< rad/s
  Vec3<Scalar> direction;  ///< of the change of w with the amplitude

  Eigen::Matrix<Scalar, 7, 2> basis(const State<Scalar>&) const noexcept {
    Eigen::Matrix<Scalar, 7, 2> by = Eigen::Matrix<Scalar, 7, 2>::Zero();
    for (int k = 0; k < 3; ++k) by(k, 0) = direction[k];
    by(6, 1) = 1;
    return by;
  }
  void move(State<Scalar>& start, Scalar& period, const Eigen::Matrix<Scalar, 2, 1>& x) const noexcept {
    start.angular_velocity += rate * x[0] * direction;
    period += x[1] / rate;
  }
};

/// A motion that closes after several turns, with a free nutation whose amplitude does not vanish with c/r0.
template <Real Scalar>
struct NutatingOrbit {
  PeriodicOrbit<Scalar> orbit;
  Scalar amplitude = 0;            ///< of p about that of periodic_orbit, rad/s
  Scalar predicted_amplitude = 0;  ///< to first order in c/r0
};

/// The second family: motions of a fast spin that close after n turns and m nutations, their amplitude such that the nutation's
/// frequency is m/n of the turns'; where omega = m/n it is of the order of c (docs/heavy.md, section 4). Of each family there are two
/// motions, which differ in phase: one stable, one unstable, both with a trace so near 2 that mostly neither can be told (for
/// m/n = 2/5 the difference was seen to fall as (c/r0)^9).
///
/// Errors: those of periodic_orbit; out_of_domain (m or n not positive, or not coprime, n > 64); not_applicable (axis 3 the intermediate
/// one, a = 1, a + b = 2, or no amplitude has this frequency, or one beyond half the spin); no_convergence.
/// @param nutations m   @param turns n   @param which 0 or 1, in order of phase
template <Real Scalar>
Result<NutatingOrbit<Scalar>> nutating_orbit(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination,
                                             int nutations, int turns, int which = 0) noexcept {
  if (nutations < 1 || turns < 1 || turns > 64 || std::gcd(nutations, turns) != 1 || which < 0 || which > 1)
    return Errc::out_of_domain;
  const auto forced = periodic_orbit(problem, spin, cos_inclination);
  if (!forced) return forced.error();
  const auto scaled = Scaled<Scalar>::make(problem, spin, cos_inclination);
  if (!scaled) return scaled.error();
  const Scaled<Scalar>& s = *scaled;
  const Scalar omega2 = s.nutation_squared(), ratio = Scalar(nutations) / Scalar(turns);
  // nu^2 falls by W0 (amplitude/r0)^2
  const Scalar falls = -s.off_a * (s.a + s.b - 2) / (2 * s.b);
  const Scalar square = (Floquet<Scalar>(s).squared - ratio * ratio) / falls;
  if (!(omega2 > 0) || !(square > 0) || !(square < Scalar(0.25L))) return Errc::not_applicable;
  const Scalar size = std::sqrt(square), across = std::sqrt(omega2) / s.A1, rate = std::abs(spin);

  NutatingOrbit<Scalar> made;
  made.predicted_amplitude = size * rate;
  const auto direction_at = [across](Scalar phase) noexcept {
    return Vec3<Scalar>(std::cos(phase), across * std::sin(phase), 0);
  };
  // at a phase: the amplitude and the period that close best, and what is left, which has always the same direction
  using Method = detail::Shooting<Scalar, AtPhase<Scalar>>;
  struct Trial {
    Closed<Scalar> closed;
    typename Method::Rows left;
    bool valid = false;
  };
  Scalar amplitude = size, period = Scalar(turns) * forced->period;
  int shots = forced->shots;
  ode::Counts counts = forced->counts;
  const auto at = [&](Scalar phase) noexcept {
    Trial trial;
    const AtPhase<Scalar> space{rate, direction_at(phase)};
    State<Scalar> start = forced->start;
    start.angular_velocity += rate * amplitude * space.direction;
    const auto closed = close_orbit(problem, start, period, rate, space, Scalar(1e-3L), 12);
    if (!closed) return trial;
    shots += closed->shots;
    counts += closed->counts;
    trial.closed = *closed;
    typename Method::Jacobian jacobian;
    Method(space, rate).equations(problem, closed->start, closed->period, closed->shot, trial.left, jacobian);
    const Scalar found = (closed->start.angular_velocity - forced->start.angular_velocity).dot(space.direction) /
                         (rate * space.direction.squaredNorm());
    trial.valid = std::abs(found / size - 1) < Scalar(0.5L);
    if (trial.valid) {
      amplitude = found;
      period = closed->period;
    }
    return trial;
  };

  // over one period of phases the residual passes zero twice
  const Scalar whole = 2 * pi<Scalar> / Scalar(turns);
  constexpr int parts = 8;
  const Trial first = at(0);
  if (!first.valid) return Errc::no_convergence;
  const auto value = [&](const Trial& trial) noexcept { return trial.left.dot(first.left) / first.left.norm(); };
  Scalar low = 0, f_low = value(first), high = 0, f_high = f_low;
  Trial best = first;
  int passed = -1;
  for (int i = 1; i <= parts + 1 && passed < which; ++i) {
    low = high;
    f_low = f_high;
    high = whole * Scalar(i) / parts;
    const Trial trial = at(high);
    if (!trial.valid) return Errc::no_convergence;
    f_high = value(trial);
    if ((f_low < 0) != (f_high < 0)) ++passed;
    best = trial;
  }
  if (passed < which) return Errc::no_convergence;
  Scalar phase = high;
  for (int trip = 0; trip < 40 && best.closed.closure > 8 * epsilon<Scalar>; ++trip) {
    Scalar next = trip % 3 == 2 ? (low + high) / 2 : (low * f_high - high * f_low) / (f_high - f_low);
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (!(next > low && next < high)) break;
    const Trial trial = at(next);
    if (!trial.valid) return Errc::no_convergence;
    const Scalar f = value(trial);
    if (trial.closed.closure < best.closed.closure) {
      best = trial;
      phase = next;
    }
    if ((f < 0) == (f_low < 0)) {
      low = next;
      f_low = f;
      f_high /= 2;
    } else {
      high = next;
      f_high = f;
      f_low /= 2;
    }
    if (high - low < 4 * epsilon<Scalar>) break;
  }
  if (!(best.closed.closure < Scalar(1e-11L) + 64 * epsilon<Scalar>)) return Errc::no_convergence;
  best.closed.shots = shots;
  best.closed.counts = counts;
  made.orbit = detail::judged(problem, best.closed, OrbitMethod::shooting);
  const Vec3<Scalar> direction = direction_at(phase);
  made.amplitude =
      (best.closed.start.angular_velocity - forced->start.angular_velocity).dot(direction) / direction.squaredNorm();
  return made;
}

}  // namespace gyrostat::heavy
