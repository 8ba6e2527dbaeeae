// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numeric>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"
#include "gyrostat/math/bracket.hpp"
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

namespace detail {

/// Amplitude, relative to r0, of the nutation whose frequency is m/n of the turns', to first order in c/r0. not_applicable: there is none
/// below 1/2.
template <Real Scalar>
Result<Scalar> nutation_size(const Scaled<Scalar>& s, int nutations, int turns) noexcept {
  const Scalar ratio = Scalar(nutations) / Scalar(turns);
  // nu^2 falls by W0 (amplitude/r0)^2
  const Scalar falls = -s.off_a * (s.a + s.b - 2) / (2 * s.b);
  const Scalar square = (Floquet<Scalar>(s).squared - ratio * ratio) / falls;
  if (!(s.nutation_squared() > 0) || !(square > 0) || !(square < Scalar(0.25L))) return Errc::not_applicable;
  return std::sqrt(square);
}

/// Motions with a nutation upon the forced one, by its phase: at each the amplitude and the period that close best. What is then left
/// open has always the same direction.
template <Real Scalar>
class NutationPhases {
  using Method = Shooting<Scalar, AtPhase<Scalar>>;

 public:
  struct Trial {
    Closed<Scalar> closed;
    typename Method::Rows left;
    bool valid = false;
  };

  /// @param size nutation_size   @param across of q for one of p in a free nutation   @param rate |r0|, rad/s
  NutationPhases(const Problem<Scalar>& problem, const PeriodicOrbit<Scalar>& forced, int turns, Scalar size,
                 Scalar across, Scalar rate) noexcept
      : problem_(problem),
        forced_(forced),
        size_(size),
        across_(across),
        rate_(rate),
        amplitude_(size),
        period_(Scalar(turns) * forced.period),
        shots_(forced.shots),
        counts_(forced.counts) {}

  /// Begins from what the last valid trial has found.
  Trial at(Scalar phase) noexcept {
    Trial trial;
    const AtPhase<Scalar> space{rate_, direction(phase)};
    State<Scalar> start = forced_.start;
    start.angular_velocity += rate_ * amplitude_ * space.direction;
    const auto closed = close_orbit(problem_, start, period_, rate_, space, Scalar(1e-3L), 12);
    if (!closed) return trial;
    shots_ += closed->shots;
    counts_ += closed->counts;
    trial.closed = *closed;
    typename Method::Jacobian jacobian;
    Method(space, rate_).equations(problem_, closed->start, closed->period, closed->shot, trial.left, jacobian);
    const Scalar found = (closed->start.angular_velocity - forced_.start.angular_velocity).dot(space.direction) /
                         (rate_ * space.direction.squaredNorm());
    trial.valid = std::abs(found / size_ - 1) < Scalar(0.5L);
    if (trial.valid) {
      amplitude_ = found;
      period_ = closed->period;
    }
    return trial;
  }

  /// Of p in a trial about that of the forced motion, rad/s.
  Scalar amplitude(const Trial& trial, Scalar phase) const noexcept {
    const Vec3<Scalar> along = direction(phase);
    return (trial.closed.start.angular_velocity - forced_.start.angular_velocity).dot(along) / along.squaredNorm();
  }
  int shots() const noexcept { return shots_; }
  const ode::Counts& counts() const noexcept { return counts_; }

 private:
  Vec3<Scalar> direction(Scalar phase) const noexcept {
    return Vec3<Scalar>(std::cos(phase), across_ * std::sin(phase), 0);
  }

  const Problem<Scalar>& problem_;
  const PeriodicOrbit<Scalar>& forced_;
  Scalar size_, across_, rate_;
  Scalar amplitude_, period_;  // of the last valid trial; the amplitude relative to the rate
  int shots_;
  ode::Counts counts_;
};

template <Real Scalar>
struct FoundPhase {
  typename NutationPhases<Scalar>::Trial trial;
  Scalar phase = 0;
};

/// The phase at which nothing is left open. `turns` of the motion: over one period of phases what is left passes zero twice.
/// Errc::no_convergence.
template <Real Scalar>
Result<FoundPhase<Scalar>> closing_phase(NutationPhases<Scalar>& phases, int turns, int which) noexcept {
  const Scalar whole = 2 * pi<Scalar> / Scalar(turns);
  constexpr int parts = 8;
  const auto first = phases.at(0);
  if (!first.valid) return Errc::no_convergence;
  const auto value = [&](const auto& trial) noexcept { return trial.left.dot(first.left) / first.left.norm(); };
  math::SignChange<Scalar> change{0, value(first), 0, value(first)};
  FoundPhase<Scalar> best{first, 0};
  int passed = -1;
  for (int i = 1; i <= parts + 1 && passed < which; ++i) {
    change.low = change.high;
    change.f_low = change.f_high;
    change.high = whole * Scalar(i) / parts;
    best = {phases.at(change.high), change.high};
    if (!best.trial.valid) return Errc::no_convergence;
    change.f_high = value(best.trial);
    if ((change.f_low < 0) != (change.f_high < 0)) ++passed;
  }
  if (passed < which) return Errc::no_convergence;
  for (int trip = 0; trip < 40 && best.trial.closed.closure > 8 * epsilon<Scalar>; ++trip) {
    const Scalar next = change.guess(trip);
    if (!change.contains(next)) break;
    const auto trial = phases.at(next);
    if (!trial.valid) return Errc::no_convergence;
    if (trial.closed.closure < best.trial.closed.closure) best = {trial, next};
    change.take(next, value(trial));
    if (change.high - change.low < 4 * epsilon<Scalar>) break;
  }
  if (!(best.trial.closed.closure < Scalar(1e-11L) + 64 * epsilon<Scalar>)) return Errc::no_convergence;
  return best;
}

}  // namespace detail

/// The second family: motions of a fast spin that close after n turns and m nutations, their amplitude such that the nutation's
/// frequency is m/n of the turns'; where omega = m/n it is of the order of c (docs/heavy.md, section 4). Of each family there are two
/// motions, which differ in phase: one stable, one unstable, both with a trace so near 2 that mostly neither can be decided (for
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
  const auto size = detail::nutation_size(*scaled, nutations, turns);
  if (!size) return size.error();
  const Scalar across = std::sqrt(scaled->nutation_squared()) / scaled->A1, rate = std::abs(spin);
  detail::NutationPhases<Scalar> phases(problem, *forced, turns, *size, across, rate);
  const auto found = detail::closing_phase(phases, turns, which);
  if (!found) return found.error();
  Closed<Scalar> closed = found->trial.closed;
  closed.shots = phases.shots();
  closed.counts = phases.counts();
  return NutatingOrbit<Scalar>{detail::judged(problem, closed, OrbitMethod::shooting),
                               phases.amplitude(found->trial, found->phase), *size * rate};
}

}  // namespace gyrostat::heavy
