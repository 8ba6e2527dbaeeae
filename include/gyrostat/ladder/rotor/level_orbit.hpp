// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "gyrostat/core/result.hpp"
#include "gyrostat/models/rotor/averaged_dissipation.hpp"
#include "gyrostat/ode/fixed_step.hpp"

namespace gyrostat::rotor {

/// The closed orbit of the fast motion through the unit vector m. Steps of 1/10 of the shortest time scale, so that the period is
/// right to 1e-5, the dissipation to 1e-3. Errc::no_convergence where it does not close within 8000 steps (on a separatrix).
template <Real Scalar>
Result<LevelOrbit<Scalar>> level_orbit(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm,
                                       const Vec3<Scalar>& start) noexcept {
  const FastMotion<Scalar> motion(gyrostat, momentum_norm);
  const auto rate = [&](const Vec3<Scalar>& m) noexcept { return motion.rate(m); };
  const auto after = [&](const Vec3<Scalar>& m, Scalar h) noexcept -> Vec3<Scalar> {
    return ode::classical_step(rate, m, h).normalized();
  };
  const Scalar step = Scalar(0.1L) / motion.fastest();
  constexpr std::size_t most = 8000;
  std::array<Scalar, most + 2> felt;
  const Vec3<Scalar> direction = motion.rate(start);
  const Scalar stride = direction.norm() * step;
  Vec3<Scalar> m = start;
  felt[0] = motion.felt(m);
  Scalar last = 0;  // distance of m from the plane through the start, along the motion there
  for (std::size_t steps = 0; steps < most; ++steps) {
    const Vec3<Scalar> next = after(m, step);
    const Scalar ahead = (next - start).dot(direction);
    if (steps > 2 && last < 0 && ahead >= 0 && (next - start).norm() < 2 * stride) {
      Scalar rest = step * (-last / (ahead - last));
      for (int i = 0; i < 2; ++i) {  // Newton's steps to that plane
        const Vec3<Scalar> end = after(m, rest);
        rest -= (end - start).dot(direction) / rate(end).dot(direction);
      }
      felt[steps + 1] = felt[0];
      return level_orbit_of(gyrostat, momentum_norm, std::span<const Scalar>(felt.data(), steps + 2), step, rest);
    }
    m = next;
    last = ahead;
    felt[steps + 1] = motion.felt(m);
  }
  return Errc::no_convergence;
}

}  // namespace gyrostat::rotor
