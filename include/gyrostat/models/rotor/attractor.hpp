// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gyrostat/models/rotor/exceptional.hpp"

/// Which steady rotation a motion tends to, said before it gets there (docs/rotor.md, section 4). V falls, and F <= V: once V is below
/// the lowest saddle of F, H stays in its valley for ever.
namespace gyrostat::rotor {

/// Why the attractor is known, or why not.
enum class Certificate : std::uint8_t {
  undecided,  ///< two minima, and V is above the lowest saddle (or within rounding of it); or a start on an unstable steady rotation
  by_level,       ///< V is below the lowest barrier: proven
  by_uniqueness,  ///< only one minimum: proven but for starts of measure zero (the stable manifolds of saddles and maxima)
  none,           ///< there is no attractor: S = 0, L = 0, symmetry about e, or a continuum of minima
};

/// The steady rotation that a motion tends to, and how that is known.
template <Real Scalar>
struct Attractor {
  int index = -1;  ///< into SteadyRotations; -1: not certified
  Certificate certificate = Certificate::undecided;
  Scalar level = 0;  ///< V, J
  Scalar margin =
      0;  ///< V - barrier_level, J: negative once captured; -infinity where F has one valley; NaN with `none`
};

namespace detail {

/// F on a great circle: mean + c1 cos t + s1 sin t + c2 cos 2t + s2 sin 2t.
template <Real Scalar>
struct LevelOnCircle {
  Scalar mean, c1, s1, c2, s2;

  /// From a along the unit vector `along` normal to it.
  LevelOnCircle(const Gyrostat<Scalar>& gyrostat, Scalar l, const Vec3<Scalar>& a, const Vec3<Scalar>& along) noexcept {
    const Vec3<Scalar> Ja = l * (gyrostat.inverse_inertia() * a), Jb = l * (gyrostat.inverse_inertia() * along);
    const Scalar h = gyrostat.target_momentum();
    const Scalar aa = l * a.dot(Ja) / 2, bb = l * along.dot(Jb) / 2;
    mean = (aa + bb) / 2 + h * h * gyrostat.axis().dot(gyrostat.inverse_inertia() * gyrostat.axis()) / 2;
    c1 = -h * gyrostat.axis().dot(Ja);
    s1 = -h * gyrostat.axis().dot(Jb);
    c2 = (aa - bb) / 2;
    s2 = l * a.dot(Jb) / 2;
  }
  /// F and F''.
  struct Value {
    Scalar level, bend;
  };
  Value at(Scalar t) const noexcept {
    const Scalar c = std::cos(t), s = std::sin(t), once = c1 * c + s1 * s;
    const Scalar twice = c2 * (c * c - s * s) + s2 * 2 * s * c;
    return {mean + once + twice, -once - 4 * twice};
  }
  Scalar operator()(Scalar t) const noexcept { return at(t).level; }
  /// The derivative of this order, two or more, is nowhere larger.
  Scalar bound(int order) const noexcept { return std::hypot(c1, s1) + Scalar(1 << order) * std::hypot(c2, s2); }
};

/// Whether sign F stays below sign `barrier` all along the shorter great circle from a to b: proven between 64 points by the
/// bend of F there. False also where it cannot be proven.
template <Real Scalar>
bool arc_below(const Gyrostat<Scalar>& gyrostat, Scalar l, const Vec3<Scalar>& a, const Vec3<Scalar>& b, Scalar barrier,
               Scalar sign) noexcept {
  const Vec3<Scalar> across = b - a.dot(b) * a;
  const Scalar sine = across.norm();
  if (sine == 0) return a.dot(b) > 0;
  const LevelOnCircle<Scalar> F(gyrostat, l, a, across / sine);
  constexpr int parts = 64;
  const Scalar step = std::atan2(sine, a.dot(b)) / parts, square = step * step / 8;
  const Scalar slack = square * F.bound(4);  // how far F'' may be from its chord
  auto last = F.at(0);
  for (int i = 1; i <= parts; ++i) {
    const auto next = F.at(Scalar(i) * step);
    const Scalar cap = std::max(Scalar(0), slack - std::min(sign * last.bend, sign * next.bend)) * square;
    if (!(std::max(sign * last.level, sign * next.level) + cap < sign * barrier)) return false;
    last = next;
  }
  return true;
}

/// The minimum (sign +1) or maximum (-1) in whose component of sign F < sign `barrier` the direction m lies; -1 where this
/// is not proven. Steps along -sign grad F are so short that F is monotone on each.
template <Real Scalar>
int basin(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady, Scalar l, Vec3<Scalar> m,
          Scalar barrier, Scalar sign) noexcept {
  const Mat3<Scalar>& J = gyrostat.inverse_inertia();
  const Scalar h = gyrostat.target_momentum();
  const Vec3<Scalar> n = J * gyrostat.axis();
  const int extreme = sign > 0 ? 0 : steady.count - 1;
  int next_test = 0;
  for (int step = 0; step < 1024; ++step) {
    if (step == next_test) {
      next_test = step < 8 ? step + 2 : step + step / 2;
      for (int i = 0; i < steady.count; ++i) {
        const bool wanted = i == extreme || steady[i].type == (sign > 0 ? SteadyType::minimum : SteadyType::maximum);
        if (wanted && arc_below(gyrostat, l, m, steady[i].direction, barrier, sign)) return i;
      }
    }
    Vec3<Scalar> slope = sign * l * (l * (J * m) - h * n);
    slope -= slope.dot(m) * m;
    const Scalar size = slope.norm();
    if (!(size > 0)) return -1;
    slope /= -size;
    const LevelOnCircle<Scalar> F(gyrostat, l, m, slope);
    // F' <= -size + F''(0) t + bound(3) t^2/2 is negative up to here
    const Scalar bend = sign * F.at(0).bend, root = std::sqrt(bend * bend + 2 * F.bound(3) * size);
    const Scalar angle = bend > 0 ? 2 * size / (bend + root) : (root - bend) / F.bound(3);
    m = (std::cos(angle) * m + std::sin(angle) * slope).normalized();
  }
  return -1;
}

}  // namespace detail

/// Level of the lowest point at which the valleys of F meet, J: the lowest saddle, fold or circle of steady rotations, or the
/// invariant circle of the family circular_section; infinity where F has one valley only.
template <Real Scalar>
Scalar barrier_level(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady,
                     Scalar momentum_norm) noexcept {
  Scalar barrier = infinity<Scalar>;
  for (int i = steady.count - 1; i > 0; --i)
    if (steady[i].type == SteadyType::saddle || steady[i].type == SteadyType::degenerate) barrier = steady[i].level;
  if (exceptional_distance(gyrostat, momentum_norm).family == Exceptional::circular_section)
    barrier = std::min(barrier, circular_section(gyrostat, momentum_norm).level);
  return barrier;
}

/// Index of the maximum around which H lies, where F(H) is above the highest saddle; else that of the highest. -1 where it is
/// not proven (F(H) within rounding of the saddle), or there is none. time_between_levels needs it to know where a motion comes from.
template <Real Scalar>
int lobe_of(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady, const Vec3<Scalar>& H) noexcept {
  const int top = steady.count - 1;
  int maxima = 0;
  Scalar barrier = -infinity<Scalar>;
  for (const auto& r : steady) {
    maxima += r.type == SteadyType::maximum;
    if (r.type == SteadyType::saddle || r.type == SteadyType::degenerate) barrier = r.level;
  }
  if (maxima == 0 || steady[top].type != SteadyType::maximum) return -1;
  if (maxima == 1 || gyrostat.steady_level(H) <= barrier) return top;
  const Scalar l = H.norm();
  return detail::basin<Scalar>(gyrostat, steady, l, H / l, barrier, Scalar(-1));
}

/// What a motion in the state (H, p) tends to. H: body axes, N m s; p: axial momentum of the rotor, N m s; steady:
/// steady_rotations(gyrostat, |H|). The lowest steady rotation is a minimum even where it is degenerate.
template <Real Scalar>
Attractor<Scalar> certify(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady,
                          const Vec3<Scalar>& H, Scalar p) noexcept {
  const Scalar l = H.norm();
  Attractor<Scalar> r;
  r.level = gyrostat.lyapunov(H, p);
  r.margin = nan<Scalar>;
  const Exceptional family = exceptional_distance(gyrostat, l).family;
  if (steady.count == 0 || gyrostat.slope() == 0 || family == Exceptional::axisymmetric || !steady[0].isolated) {
    r.certificate = Certificate::none;
    return r;
  }
  const Scalar barrier = barrier_level(gyrostat, steady, l);
  const Vec3<Scalar> m = H / l;
  r.margin = r.level - barrier;
  int minima = 1, degenerate = 0;
  for (int i = 1; i < steady.count; ++i) {
    minima += steady[i].type == SteadyType::minimum;
    degenerate += steady[i].type == SteadyType::degenerate;
  }
  const Scalar scale = std::abs(r.level) + steady[steady.count - 1].level;
  if (barrier < infinity<Scalar> && r.margin < -64 * epsilon<Scalar> * scale) {
    r.index = minima == 1 ? 0 : detail::basin(gyrostat, steady, l, m, barrier, Scalar(1));
    r.certificate = r.index >= 0 ? Certificate::by_level : Certificate::undecided;
    return r;
  }
  if (minima > 1 || degenerate > 0 || family == Exceptional::circular_section) return r;
  const Vec3<Scalar> Omega = gyrostat.angular_velocity(H, p);
  const Scalar x = gyrostat.rotor_rate(p, Omega) - gyrostat.no_load_rate();
  const Scalar size = std::abs(p) / gyrostat.axial_inertia() + Omega.norm() + std::abs(gyrostat.no_load_rate());
  if (std::abs(x) <= 64 * epsilon<Scalar> * size)
    for (int i = 1; i < steady.count; ++i)
      if ((m - steady[i].direction).norm() <= 64 * epsilon<Scalar>) return r;
  r.index = 0;
  r.certificate = Certificate::by_uniqueness;
  return r;
}

}  // namespace gyrostat::rotor
