// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "gyrostat/models/deceleration/orbit_average.hpp"

/// Where the type of the free orbit changes, and what happens there under the small torques (deceleration.md, section 4.2).
namespace gyrostat::deceleration {

/// What a critical level is. The energies at one R, in order: lowest, then the birth and the saddle of the lobes around the
/// largest moment, then the saddle and the birth of those around the smallest, then highest; either pair may be missing.
enum class Critical : std::uint8_t {
  lowest,  ///< stable equilibrium of least energy
  birth,   ///< centre of the younger lobe: it appears or vanishes (k2 -> 0 for all other orbits of the level: no event)
  saddle,  ///< unstable equilibrium: the separatrix of two lobes (k2 -> 1)
  highest,  ///< stable equilibrium of greatest energy
};

/// A relative equilibrium omega = sigma M at |M| = R.
template <Real Scalar>
struct CriticalLevel {
  Critical kind = Critical::lowest;
  Regime lobes = Regime::one_component;  ///< of a birth or saddle: about_largest or about_smallest
  Scalar eta = 0;                        ///< rad/s
  Scalar sigma = 0;                      ///< 1/(kg m^2)

  /// d eta/dR along the family of this equilibrium, rad/s per N m s; dh/dR is sigma R.
  Scalar slope(Scalar R) const noexcept { return sigma - eta / R; }
};

/// All of them at one R, by ascending eta: 2, 4 or 6. A shared saddle (no rotor momentum along the middle axis) counts for
/// both pairs; an axis without rotor momentum may make lowest and birth, or birth and highest, one level.
template <Real Scalar>
struct CriticalLevels {
  std::array<CriticalLevel<Scalar>, 6> level;
  int count = 0;

  /// highest - lowest: the unit of distances between levels.
  Scalar range() const noexcept { return level[std::size_t(count - 1)].eta - level[0].eta; }
};

/// Critical levels at |M| = R. Errors: not_finite, not_positive, not_applicable for a sphere, no_convergence.
template <Real Scalar>
Result<CriticalLevels<Scalar>> critical_levels(const Problem<Scalar>& problem, Scalar R) noexcept {
  const Vec3<Scalar>& a = problem.inverse_inertia;
  const Vec3<Scalar> g = problem.gyro_rate();
  if (!std::isfinite(R) || !a.allFinite() || !g.allFinite()) return Errc::not_finite;
  if (!(R > 0) || !(a[0] > 0)) return Errc::not_positive;
  if (a[2] - a[0] <= 8 * epsilon<Scalar> * a[2]) return Errc::not_applicable;

  const Secular<Scalar> original(a, g, R), mirror = original.mirrored();
  CriticalLevels<Scalar> all;
  const auto put = [&](Critical kind, Regime lobes, const Secular<Scalar>& q, Scalar sign,
                       const SecularPoint<Scalar>& p) {
    all.level[std::size_t(all.count++)] = {kind, lobes, sign * q.level(p), sign * q.sigma(p)};
  };
  SecularPoint<Scalar> end;
  if (!original.turning_point(0, -1, infinity<Scalar>, end)) return Errc::no_convergence;
  put(Critical::lowest, Regime::one_component, original, 1, end);
  if (const auto rise = original.rise(0); rise.exists) {
    put(Critical::birth, Regime::about_largest, original, 1, rise.lo);
    put(Critical::saddle, Regime::about_largest, original, 1, rise.hi);
  }
  if (const auto rise = mirror.rise(0); rise.exists) {
    put(Critical::saddle, Regime::about_smallest, mirror, -1, rise.hi);
    put(Critical::birth, Regime::about_smallest, mirror, -1, rise.lo);
  }
  if (!mirror.turning_point(0, -1, infinity<Scalar>, end)) return Errc::no_convergence;
  put(Critical::highest, Regime::one_component, mirror, -1, end);
  for (int i = 0; i < all.count; ++i)  // a product of finite numbers may overflow
    if (const auto& level = all.level[std::size_t(i)]; !std::isfinite(level.eta) || !std::isfinite(level.sigma))
      return Errc::not_finite;
  return all;
}

/// The critical levels next to a level, and how far they are: |eta - eta_c| over the range of energies at this R.
template <Real Scalar>
struct LevelBand {
  CriticalLevel<Scalar> below, above;
  Scalar to_below = 0, to_above = 0;

  /// Distance to the nearer separatrix; infinity if neither end is one.
  Scalar separatrix_distance() const noexcept {
    return std::min(below.kind == Critical::saddle ? to_below : infinity<Scalar>,
                    above.kind == Critical::saddle ? to_above : infinity<Scalar>);
  }
};

/// The band of a level: inside it no orbit changes its type. A level outside the energies possible at its R is taken at the end, and one of two critical
/// levels that are one but for rounding belongs to the band beside them.
/// Errors as critical_levels.
template <Real Scalar>
Result<LevelBand<Scalar>> band_of(const Problem<Scalar>& problem, const Level<Scalar>& level) noexcept {
  const auto critical = critical_levels(problem, level.R);
  if (!critical) return critical.error();
  std::size_t i = 0;
  const std::size_t last = std::size_t(critical->count) - 2;
  const auto closed = [&](std::size_t at) noexcept {
    const Scalar one = critical->level[at].eta, next = critical->level[at + 1].eta;
    return next - one <= 8 * epsilon<Scalar> * std::max(std::abs(one), std::abs(next));
  };
  while (i < last && (level.eta > critical->level[i + 1].eta || closed(i))) ++i;
  while (i > 0 && closed(i)) --i;
  const auto &below = critical->level[i], &above = critical->level[i + 1];
  const Scalar range = critical->range();
  return LevelBand<Scalar>{below, above, std::max(Scalar(0), level.eta - below.eta) / range,
                           std::max(Scalar(0), above.eta - level.eta) / range};
}

/// Where a motion that reaches a separatrix goes on: into one of its two lobes (branch +1, -1) or outside (one component).
template <Real Scalar>
struct Capture {
  Scalar plus = 0, minus = 0,
         outside = 0;  ///< probabilities over initial values spread by the size of the small torques
  Scalar inflow_plus = 0,
         inflow_minus = 0;  ///< Theta: energy, J, that a turn along the lobe's loop moves the motion inwards

  bool determined() const noexcept { return plus == 1 || minus == 1 || outside == 1; }
};

/// How far beside a separatrix the loop is taken, over the range of energies: what is so near has a period, and errs by some 1e-7.
template <Real Scalar>
Scalar beside_saddle(const CriticalLevels<Scalar>& critical) noexcept {
  return critical.range() * std::sqrt(epsilon<Scalar>) / 2;
}

/// Theta: energy, J, that a turn along the loop of the lobe `side` beside its saddle moves the motion inwards. Errors: those of the orbit; not_applicable
/// where it is none of that lobe.
template <class Elliptic = math::Native, Real Scalar>
Result<Scalar> inflow(const Problem<Scalar>& problem, Scalar R, const CriticalLevel<Scalar>& saddle, Scalar away,
                      const Component& side) noexcept {
  // lobes around the largest moment lie under their saddle, the others above it
  const Scalar inwards = side.regime == Regime::about_largest ? Scalar(-1) : Scalar(1);
  const auto loop = average<Elliptic>(problem, Level<Scalar>{R, saddle.eta + inwards * away}, side);
  if (!loop) return loop.error();
  if (loop->component.regime != side.regime) return Errc::not_applicable;
  return inwards * loop->period * (loop->rates.h - saddle.sigma * R * loop->rates.R);
}

/// The same where the critical levels are not at hand. Errors: theirs, too; not_applicable without such a saddle.
template <class Elliptic = math::Native, Real Scalar>
Result<Scalar> inflow_at_saddle(const Problem<Scalar>& problem, Scalar R, const Component& side) noexcept {
  const auto critical = critical_levels(problem, R);
  if (!critical) return critical.error();
  for (int i = 0; i < critical->count; ++i)
    if (const auto& c = critical->level[std::size_t(i)]; c.kind == Critical::saddle && c.lobes == side.regime)
      return inflow<Elliptic>(problem, R, c, beside_saddle(*critical), side);
  return Errc::not_applicable;
}

/// What follows on the separatrix of the lobes `lobes` (about_largest, about_smallest) at |M| = R for a motion that comes
/// from `from` (one_component, or a lobe). Theta_i = -oint_i (h' - h_s'(R) R') dt over the loop of lobe i, taken with the
/// sign that makes inwards positive; entering both lobes, P_i = Theta_i/(Theta_1 + Theta_2); leaving lobe 1, the loop of the other takes in the
/// part Theta_2/-Theta_1 of those that pass it (Neishtadt 1975).
/// Errors: not_applicable where there is no such separatrix or it is shared by the lobes around both axes (no rotor momentum
/// along the middle one: arcs, not loops); undetermined where the torques hold the motion at the separatrix, or take it away
/// from it on the side it comes from; those of the orbit.
template <class Elliptic = math::Native, Real Scalar>
Result<Capture<Scalar>> capture(const Problem<Scalar>& problem, Scalar R, Regime lobes, Component from) noexcept {
  const auto critical = critical_levels(problem, R);
  if (!critical) return critical.error();
  const CriticalLevel<Scalar>* saddle = nullptr;
  int saddles_there = 0;
  for (int i = 0; i < critical->count; ++i) {
    const auto& c = critical->level[std::size_t(i)];
    if (c.kind == Critical::saddle && c.lobes == lobes) saddle = &c;
  }
  if (!saddle) return Errc::not_applicable;
  const Scalar away = beside_saddle(*critical);
  for (int i = 0; i < critical->count; ++i) {
    const auto& c = critical->level[std::size_t(i)];
    if (c.kind == Critical::saddle && std::abs(c.eta - saddle->eta) < 4 * away) ++saddles_there;
  }
  if (saddles_there > 1) return Errc::not_applicable;

  Capture<Scalar> r;
  for (const int branch : {1, -1}) {
    const auto flow = inflow<Elliptic>(problem, R, *saddle, away, Component{lobes, branch});
    if (!flow) return flow.error();
    (branch > 0 ? r.inflow_plus : r.inflow_minus) = *flow;
  }

  const Scalar plus = r.inflow_plus, minus = r.inflow_minus;
  const bool outer = from.regime == Regime::one_component;
  const Scalar own = outer ? -(plus + minus) : from.branch > 0 ? plus : minus;
  if (!(own < 0)) return Errc::undetermined;  // it turns away from the separatrix
  if (plus > 0 && minus > 0) {
    r.plus = plus / (plus + minus);
    r.minus = minus / (plus + minus);
  } else if (plus > 0 && plus + minus > 0) {
    r.plus = 1;
  } else if (minus > 0 && plus + minus > 0) {
    r.minus = 1;
  } else if (!outer && plus + minus < 0) {
    const Scalar other = from.branch > 0 ? minus : plus;
    (from.branch > 0 ? r.minus : r.plus) = other > 0 ? other / -own : Scalar(0);
    r.outside = 1 - std::max(r.plus, r.minus);
  } else {
    return Errc::undetermined;
  }
  return r;
}

}  // namespace gyrostat::deceleration
