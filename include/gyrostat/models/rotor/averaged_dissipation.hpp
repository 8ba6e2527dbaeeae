// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/result.hpp"
#include "gyrostat/models/rotor/attractor.hpp"

/// How long V takes to fall when the rotor damps little in one turn (docs/rotor.md, section 4): dV/dt = -<S x^2>, the mean
/// over the fast motion m' = m x J(l m - h e) on a level of F, with x = omega - omega* in the periodic state of
/// k x' + (S/lambda) x = -l n.m'.
namespace gyrostat::rotor {

/// One closed orbit of the fast motion.
template <Real Scalar>
struct LevelOrbit {
  Scalar period = 0;       ///< s
  Scalar dissipation = 0;  ///< mean of S x^2, W
  Scalar stored = 0;       ///< mean of lambda k x^2/2, J
};

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
};

namespace detail {

/// The closed orbit through m. Runge-Kutta steps of 1/10 of the shortest time scale, so that the period is right to
/// 1e-5, the dissipation to 1e-3. Errc::no_convergence where it does not close within 8000 steps (on a separatrix).
template <Real Scalar>
Result<LevelOrbit<Scalar>> level_orbit(const Gyrostat<Scalar>& gyrostat, Scalar l, const Vec3<Scalar>& start) noexcept {
  const Mat3<Scalar>& J = gyrostat.inverse_inertia();
  const Vec3<Scalar> n = J * gyrostat.axis();
  const Scalar h = gyrostat.target_momentum(), k = gyrostat.coupling(), s = gyrostat.relaxation_rate();
  const auto rate = [&](const Vec3<Scalar>& m) noexcept -> Vec3<Scalar> {
    return cross<Scalar>(m, l * (J * m) - h * n);
  };
  const auto step_of = [&](const Vec3<Scalar>& m, Scalar dt) noexcept -> Vec3<Scalar> {
    const Vec3<Scalar> a = rate(m), b = rate(m + dt / 2 * a), c = rate(m + dt / 2 * b), d = rate(m + dt * c);
    return (m + dt / 6 * (a + 2 * b + 2 * c + d)).normalized();
  };
  const Scalar dt =
      Scalar(0.1L) / (l * (1 / gyrostat.principal()[0] - 1 / gyrostat.principal()[2]) + std::abs(h) * n.norm());
  constexpr std::size_t most = 8000;
  std::array<Scalar, most + 2> felt;  // n.m
  const Vec3<Scalar> direction = rate(start);
  const Scalar stride = direction.norm() * dt;
  Vec3<Scalar> m = start;
  felt[0] = n.dot(m);
  std::size_t steps = 0;
  Scalar last = 0, part = 0;
  for (;; ++steps) {
    if (steps == most) return Errc::no_convergence;
    const Vec3<Scalar> next = step_of(m, dt);
    const Scalar ahead = (next - start).dot(direction);
    if (steps > 2 && last < 0 && ahead >= 0 && (next - start).norm() < 2 * stride) {
      part = dt * (-last / (ahead - last));
      for (int i = 0; i < 2; ++i) {  // Newton's steps to the plane through the start
        const Vec3<Scalar> end = step_of(m, part);
        part -= (end - start).dot(direction) / rate(end).dot(direction);
      }
      break;
    }
    m = next;
    last = ahead;
    felt[steps + 1] = n.dot(m);
  }
  felt[steps + 1] = felt[0];
  // x over one step with n.m' constant; first from x = 0, then from the value that returns
  const Scalar period = Scalar(steps) * dt + part;
  const auto over = [&](Scalar x, std::size_t i, Scalar tau) noexcept {
    const Scalar lost = -std::expm1(-s * tau);
    return x - lost * x - l / k * (felt[i + 1] - felt[i]) * (s * tau > 0 ? lost / (s * tau) : Scalar(1));
  };
  Scalar x = 0;
  for (std::size_t i = 0; i <= steps; ++i) x = over(x, i, i < steps ? dt : part);
  x /= -std::expm1(-s * period);
  Scalar sum = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const Scalar tau = i < steps ? dt : part, next = over(x, i, tau);
    sum += tau * (x * x + x * next + next * next) / 3;
    x = next;
  }
  const Scalar mean = sum / period;
  return LevelOrbit<Scalar>{period, gyrostat.slope() * mean, gyrostat.axial_inertia() * k * mean / 2};
}

}  // namespace detail

/// Time in which V falls from the level `from` of F to the level `to` < `from`, J, with |H| = momentum_norm: valid for weak
/// coupling, lambda l q << k D, an estimate whose error() is stated. summit, valley: indices of the maximum (lobe_of) and the
/// minimum (certify) that the motion comes from and goes to; they matter above the highest and below the lowest saddle, where F has
/// two of them. Some milliseconds at most.
/// Errors: not_applicable for S = 0 or a continuum of steady rotations; out_of_domain unless `valley` is a minimum, `summit` a
/// maximum, and the levels lie between theirs, these excluded; not_increasing unless to < from; no_convergence.
template <Real Scalar>
Result<FallTime<Scalar>> time_between_levels(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady,
                                             Scalar momentum_norm, int summit, int valley, Scalar from,
                                             Scalar to) noexcept {
  const Scalar l = momentum_norm;
  if (gyrostat.slope() == 0 || steady.circle || steady.sphere) return Errc::not_applicable;
  if (summit < 0 || valley < 0 || summit >= steady.count || valley >= steady.count) return Errc::out_of_domain;
  const SteadyRotation<Scalar>&top = steady[summit], &bottom = steady[valley];
  if (top.type != SteadyType::maximum || bottom.type != SteadyType::minimum) return Errc::out_of_domain;
  if (!(from < top.level && to > bottom.level)) return Errc::out_of_domain;
  if (!(to < from)) return Errc::not_increasing;

  // Critical levels on the way: the saddles, between the two ends.
  std::array<Scalar, 10> critical{};
  int count = 0;
  critical[std::size_t(count++)] = bottom.level;
  for (const auto& r : steady)
    if ((r.type == SteadyType::saddle || r.type == SteadyType::degenerate) &&
        r.level > critical[std::size_t(count - 1)] && r.level < top.level)
      critical[std::size_t(count++)] = r.level;
  critical[std::size_t(count)] = top.level;

  // The great circle from the minimum to the maximum crosses every level on the way.
  const Vec3<Scalar> a = bottom.direction;
  Vec3<Scalar> along = top.direction - a.dot(top.direction) * a;
  if (along.norm() < Scalar(1e-3L)) along = detail::Tangent<Scalar>(a).u;
  along.normalize();
  const detail::LevelOnCircle<Scalar> F(gyrostat, l, a, along);
  const Scalar length = std::atan2(top.direction.dot(along), top.direction.dot(a));
  const auto point = [&](Scalar level, bool from_top) noexcept -> Vec3<Scalar> {
    constexpr int parts = 128;  // the crossing next to the end that has only one component beside it
    int i = 1;
    const auto place = [&](int j) noexcept { return length * Scalar(from_top ? parts - j : j) / parts; };
    while (i < parts && (F(place(i)) < level) != from_top) ++i;
    Scalar inside = place(i - 1), outside = place(i);
    for (int halving = 0; halving < 60; ++halving) {
      const Scalar middle = (inside + outside) / 2;
      ((F(middle) < level) != from_top ? inside : outside) = middle;
    }
    return std::cos(inside) * a + std::sin(inside) * along;
  };

  FallTime<Scalar> r;
  const Scalar range = steady[steady.count - 1].level - steady[0].level;
  // In xi = ln((E - low)/(high - E)) of a band between critical levels the integrand is flat at an extremum of F and falls
  // like |xi| exp(-|xi|) at a saddle. Panels of at most 6, each by Kronrod's rule of 15 points, halved while it differs from
  // Gauss's rule of 7: the damping may nearly vanish on some orbits (next to the family circular_section).
  constexpr Scalar node[8] = {Scalar(0),
                              Scalar(0.207784955007898467600689403773L),
                              Scalar(0.405845151377397166906606412077L),
                              Scalar(0.586087235467691130294144691693L),
                              Scalar(0.741531185599394439863864773281L),
                              Scalar(0.864864423359769072789712788640L),
                              Scalar(0.949107912342758524526189684048L),
                              Scalar(0.991455371120812639206854697526L)};
  constexpr Scalar kronrod[8] = {Scalar(0.209482141084727828012999174892L), Scalar(0.204432940075298892414161999235L),
                                 Scalar(0.190350578064785409913256402422L), Scalar(0.169004726639267902826583426599L),
                                 Scalar(0.140653259715525918745189590510L), Scalar(0.104790010322250183839876322542L),
                                 Scalar(0.063092092629978553290700663189L), Scalar(0.022935322010529224963732008059L)};
  constexpr Scalar gauss[4] = {Scalar(0.417959183673469387755102040816L), Scalar(0.381830050505118944950369775489L),
                               Scalar(0.279705391489276667901467771424L), Scalar(0.129484966168869693270611432679L)};
  constexpr Scalar cut = 12;
  constexpr int deepest = 7;
  for (int band = 0; band < count; ++band) {
    const Scalar low = critical[std::size_t(band)], high = critical[std::size_t(band + 1)];
    const Scalar lower = std::max(to, low), upper = std::min(from, high);
    if (!(lower < upper)) continue;
    const Scalar begin = lower > low ? std::log((lower - low) / (high - lower)) : -infinity<Scalar>;
    const Scalar end = upper < high ? std::log((upper - low) / (high - upper)) : infinity<Scalar>;
    const Scalar first = band == 0 ? begin : std::max(begin, -cut);
    const Scalar past = band == count - 1 ? end : std::min(end, cut);
    if (!(first < past)) continue;
    const bool from_top = band == count - 1 && band > 0;
    const int panels = std::min(64, 1 + int((past - first) / 6));
    const Scalar width = (past - first) / Scalar(panels);
    for (int panel = 0; panel < panels; ++panel) {
      // the left part of a halved panel is done first; `left` of its depth and the right parts above it remain
      Scalar left = first + Scalar(panel) * width;
      const Scalar stop = left + width * (1 - 8 * epsilon<Scalar>);
      int depth = 0;
      while (left < stop) {
        const Scalar half = width / Scalar(2 << depth), middle = left + half;
        FallTime<Scalar> part;
        Scalar rough = 0;
        for (int i = 0; i < 15; ++i) {
          const std::size_t at = std::size_t((i + 1) / 2);
          const Scalar xi = middle + (i % 2 ? half : -half) * node[at];
          const Scalar above = (high - low) / (1 + std::exp(-xi)), below = (high - low) / (1 + std::exp(xi));
          const auto orbit =
              detail::level_orbit<Scalar>(gyrostat, l, point(xi < 0 ? low + above : high - below, from_top));
          if (!orbit) return orbit.error();
          const Scalar each = half * above * (below / (high - low)) / orbit->dissipation;
          const Scalar time = kronrod[at] * each;
          if (at % 2 == 0) rough += gauss[at / 2] * each;
          part.time += time;
          part.turns += time / orbit->period;
          part.coupling += time * orbit->stored / std::max(orbit->stored, std::min(above, below));
          part.loss_per_turn = std::max(part.loss_per_turn, orbit->dissipation * orbit->period / range);
        }
        if (depth < deepest && std::abs(part.time - rough) > Scalar(2e-3L) * (part.time + r.time)) {
          ++depth;
          continue;
        }
        r.time += part.time;
        r.turns += part.turns;
        r.coupling += part.coupling;
        r.loss_per_turn = std::max(r.loss_per_turn, part.loss_per_turn);
        left += 2 * half;
        // a panel that ends on a boundary of a coarser one is followed by a coarser one
        while (depth > 0 &&
               std::abs(std::remainder((left - first) / width * Scalar(1 << (depth - 1)), Scalar(1))) < Scalar(0.25L))
          --depth;
      }
    }
  }
  r.coupling /= r.time;
  return r;
}

}  // namespace gyrostat::rotor
