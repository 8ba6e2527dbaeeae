// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/bracket.hpp"
#include "gyrostat/models/rotor/attractor.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/models/rotor/steady.hpp"

/// How long V takes to fall when the rotor damps little in one turn (docs/rotor.md, section 4): dV/dt = -<S x^2>, the mean
/// over the fast motion m' = m x J(l m - h e) on a level of F, with x = omega - omega* in the periodic state of
/// k x' + (S/lambda) x = -l n.m'. Here the equations; ladder/rotor/fall_time.hpp solves them.
namespace gyrostat::rotor {

/// The motion of m = H/l without damping, on a level of F.
template <Real Scalar>
class FastMotion {
 public:
  /// @param momentum_norm l = |H|, N m s
  FastMotion(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept
      : J_(gyrostat.inverse_inertia()),
        n_(J_ * gyrostat.axis()),
        l_(momentum_norm),
        h_(gyrostat.target_momentum()),
        fastest_(l_ * (1 / gyrostat.principal()[0] - 1 / gyrostat.principal()[2]) + std::abs(h_) * n_.norm()) {}

  /// m', body axes, 1/s.
  Vec3<Scalar> rate(const Vec3<Scalar>& m) const noexcept { return cross<Scalar>(m, l_ * (J_ * m) - h_ * n_); }
  /// n.m, n = J e: all that the rotor feels of m, 1/(kg m^2).
  Scalar felt(const Vec3<Scalar>& m) const noexcept { return n_.dot(m); }
  /// A bound of |m'|, and of the pace at which it changes, 1/s.
  Scalar fastest() const noexcept { return fastest_; }

 private:
  Mat3<Scalar> J_;
  Vec3<Scalar> n_;
  Scalar l_, h_, fastest_;
};

/// One closed orbit of the fast motion.
template <Real Scalar>
struct LevelOrbit {
  Scalar period = 0;       ///< s
  Scalar dissipation = 0;  ///< mean of S x^2, W
  Scalar stored = 0;       ///< mean of lambda k x^2/2, J
};

/// What the rotor does on a closed orbit, felt(m) taken as straight between samples: x is then exact.
/// @param felt samples, the last again the first   @param step between them, but for the last interval, s   @param last its length, s
template <Real Scalar>
LevelOrbit<Scalar> level_orbit_of(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm, std::span<const Scalar> felt,
                                  Scalar step, Scalar last) noexcept {
  const Scalar l = momentum_norm, k = gyrostat.coupling(), s = gyrostat.relaxation_rate();
  const std::size_t whole = felt.size() - 2;  // intervals of full length
  const auto length = [&](std::size_t i) noexcept { return i < whole ? step : last; };
  const auto after = [&](Scalar x, std::size_t i) noexcept {
    const Scalar tau = length(i), lost = -std::expm1(-s * tau);
    return x - lost * x - l / k * (felt[i + 1] - felt[i]) * (s * tau > 0 ? lost / (s * tau) : Scalar(1));
  };
  // first from x = 0, then from the value that returns
  const Scalar period = Scalar(whole) * step + last;
  Scalar x = 0;
  for (std::size_t i = 0; i <= whole; ++i) x = after(x, i);
  x /= -std::expm1(-s * period);
  Scalar sum = 0;
  for (std::size_t i = 0; i <= whole; ++i) {
    const Scalar next = after(x, i);
    sum += length(i) * (x * x + x * next + next * next) / 3;
    x = next;
  }
  const Scalar mean = sum / period;
  return {period, gyrostat.slope() * mean, gyrostat.axial_inertia() * k * mean / 2};
}

/// An estimate, right to leading order in the coupling.
template <Real Scalar>
struct FallTime {
  Scalar time = 0;           ///< s
  Scalar turns = 0;          ///< of the fast motion
  Scalar coupling = 0;       ///< energy in x, over the distance to the next critical level: mean over the time
  Scalar loss_per_turn = 0;  ///< the largest energy that one turn takes, over the range of F

  /// Of the time, relative: an empirical bound, which held for all of 240 random bodies and motors (median error 0.5 %, median bound
  /// 17 times that). From 1 on the time is no more than a guess.
  Scalar error() const noexcept { return 20 * coupling + 12 * (loss_per_turn + 1 / turns); }

  /// Adds what comes after; the coupling of both is still a sum over the time.
  FallTime& operator+=(const FallTime& next) noexcept {
    time += next.time;
    turns += next.turns;
    coupling += next.coupling;
    loss_per_turn = std::max(loss_per_turn, next.loss_per_turn);
    return *this;
  }
};

/// The levels between two neighbouring critical ones, J. By xi = ln((E - low)/(high - E)) the time that a motion spends there is flat
/// at an extremum of F and falls like |xi| exp(-|xi|) at a saddle.
template <Real Scalar>
struct LevelBand {
  Scalar low, high;

  Scalar xi(Scalar level) const noexcept {
    if (!(level > low)) return -infinity<Scalar>;
    return level < high ? std::log((level - low) / (high - level)) : infinity<Scalar>;
  }
  Scalar above(Scalar xi) const noexcept { return (high - low) / (1 + std::exp(-xi)); }  ///< E - low
  Scalar below(Scalar xi) const noexcept { return (high - low) / (1 + std::exp(xi)); }   ///< high - E
  Scalar level(Scalar xi) const noexcept { return xi < 0 ? low + above(xi) : high - below(xi); }
};

/// The bands from a minimum of F up to a maximum, cut at the saddles and folds between them.
template <Real Scalar>
struct LevelBands {
  std::array<Scalar, 10> critical{};
  int count = 0;

  LevelBands(const SteadyRotations<Scalar>& steady, Scalar bottom, Scalar top) noexcept {
    critical[std::size_t(count++)] = bottom;
    for (const auto& r : steady)
      if ((r.type == SteadyType::saddle || r.type == SteadyType::degenerate) &&
          r.level > critical[std::size_t(count - 1)] && r.level < top)
        critical[std::size_t(count++)] = r.level;
    critical[std::size_t(count)] = top;
  }
  LevelBand<Scalar> operator[](int i) const noexcept {
    return {critical[std::size_t(i)], critical[std::size_t(i + 1)]};
  }
};

/// The great circle from a minimum of F to a maximum: it crosses every level between theirs.
template <Real Scalar>
class LevelPath {
 public:
  LevelPath(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm, const Vec3<Scalar>& bottom,
            const Vec3<Scalar>& top) noexcept
      : a_(bottom),
        along_(across(bottom, top)),
        F_(gyrostat, momentum_norm, a_, along_),
        length_(std::atan2(top.dot(along_), top.dot(a_))) {}

  /// The direction m with this level next to the minimum, or next to the maximum: only one orbit lies between.
  Vec3<Scalar> point(Scalar level, bool from_top) const noexcept {
    constexpr int parts = 128;
    const auto place = [&](int i) noexcept { return length_ * Scalar(from_top ? parts - i : i) / parts; };
    const auto before = [&](Scalar angle) noexcept { return (F_(angle) < level) != from_top; };
    int i = 1;
    while (i < parts && before(place(i))) ++i;
    const Scalar angle = math::Bracket<Scalar>{place(i - 1), place(i)}.halved(60, before).yes;
    return std::cos(angle) * a_ + std::sin(angle) * along_;
  }

 private:
  static Vec3<Scalar> across(const Vec3<Scalar>& a, const Vec3<Scalar>& top) noexcept {
    Vec3<Scalar> along = top - a.dot(top) * a;
    if (along.norm() < Scalar(1e-3L)) along = detail::Tangent<Scalar>(a).u;  // the maximum lies opposite
    along.normalize();
    return along;
  }

  Vec3<Scalar> a_, along_;
  detail::LevelOnCircle<Scalar> F_;
  Scalar length_;
};

}  // namespace gyrostat::rotor
