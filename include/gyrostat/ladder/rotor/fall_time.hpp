// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/rotor/level_orbit.hpp"
#include "gyrostat/math/quadrature.hpp"
#include "gyrostat/models/rotor/averaged_dissipation.hpp"

namespace gyrostat::rotor {

namespace detail {

/// The fall through a part of a band, by both rules.
template <Real Scalar>
struct FallPart {
  FallTime<Scalar> fall;
  Scalar time_by_gauss = 0;
};

/// From xi = middle + half to middle - half. @param range of F, J   @param from_top see LevelPath::point
template <Real Scalar>
Result<FallPart<Scalar>> fall_part(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm,
                                   const LevelPath<Scalar>& path, const LevelBand<Scalar>& band, Scalar range,
                                   bool from_top, Scalar middle, Scalar half) noexcept {
  FallPart<Scalar> part;
  for (const auto& p : math::kronrod_points<Scalar>) {
    const Scalar xi = middle + half * p.node;
    const Scalar above = band.above(xi), below = band.below(xi);
    const auto orbit = level_orbit<Scalar>(gyrostat, momentum_norm, path.point(band.level(xi), from_top));
    if (!orbit) return orbit.error();
    const Scalar each = half * above * (below / (band.high - band.low)) / orbit->dissipation;
    const Scalar time = p.weight * each;
    if (p.gauss_weight > 0) part.time_by_gauss += p.gauss_weight * each;
    part.fall += {time, time / orbit->period, time * orbit->stored / std::max(orbit->stored, std::min(above, below)),
                  orbit->dissipation * orbit->period / range};
  }
  return part;
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
  if (gyrostat.slope() == 0 || steady.circle || steady.sphere) return Errc::not_applicable;
  if (summit < 0 || valley < 0 || summit >= steady.count || valley >= steady.count) return Errc::out_of_domain;
  const SteadyRotation<Scalar>&top = steady[summit], &bottom = steady[valley];
  if (top.type != SteadyType::maximum || bottom.type != SteadyType::minimum) return Errc::out_of_domain;
  if (!(from < top.level && to > bottom.level)) return Errc::out_of_domain;
  if (!(to < from)) return Errc::not_increasing;

  const LevelBands<Scalar> bands(steady, bottom.level, top.level);
  const LevelPath<Scalar> path(gyrostat, momentum_norm, bottom.direction, top.direction);
  const Scalar range = steady[steady.count - 1].level - steady[0].level;
  constexpr Scalar cut = 12;  // beyond it a saddle takes no more time that counts
  constexpr int deepest = 7;  // the damping may nearly vanish on some orbits (next to the family circular_section)
  FallTime<Scalar> whole;
  for (int i = 0; i < bands.count; ++i) {
    const LevelBand<Scalar> band = bands[i];
    const Scalar lower = std::max(to, band.low), upper = std::min(from, band.high);
    if (!(lower < upper)) continue;
    const bool lowest = i == 0, highest = i == bands.count - 1;
    const Scalar first = lowest ? band.xi(lower) : std::max(band.xi(lower), -cut);
    const Scalar last = highest ? band.xi(upper) : std::min(band.xi(upper), cut);
    if (!(first < last)) continue;
    const int panels = std::min(64, 1 + int((last - first) / 6));
    const Errc wrong = math::halved_panels(
        first, last, panels, deepest, [&](Scalar middle, Scalar half, bool halvable) noexcept -> Result<bool> {
          const auto part =
              detail::fall_part(gyrostat, momentum_norm, path, band, range, highest && !lowest, middle, half);
          if (!part) return part.error();
          const Scalar time = part->fall.time;
          if (halvable && std::abs(time - part->time_by_gauss) > Scalar(2e-3L) * (time + whole.time)) return false;
          whole += part->fall;
          return true;
        });
    if (wrong != Errc::ok) return wrong;
  }
  whole.coupling /= whole.time;
  return whole;
}

}  // namespace gyrostat::rotor
