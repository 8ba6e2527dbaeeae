// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/models/rotor/attractor.hpp"

/// When it is decided which steady rotation a motion tends to (docs/rotor.md, section 4.3): the full equations are solved until V has
/// fallen below the lowest saddle of F.
namespace gyrostat::rotor {

template <Real Scalar>
struct Capture {
  Attractor<Scalar> attractor;  ///< of the state at `time`; index -1: not certified up to the longest time
  Scalar time = 0;              ///< first time of a certificate, s; the time looked at last where there is none
};

namespace detail {

/// Whether a certificate stands although H is off by up to `momentum_error` |H| and V by up to `level_error`, J. An error
/// of H cannot hide a barrier: F rises by at most its slope times the error on the way to the true H.
template <Real Scalar>
bool certain(const Gyrostat<Scalar>& gyrostat, const Attractor<Scalar>& found, const Vec3<Scalar>& H,
             Scalar momentum_error, Scalar level_error) noexcept {
  if (found.index < 0) return false;
  if (found.certificate == Certificate::by_uniqueness || found.margin == -infinity<Scalar>) return true;
  const Scalar l = H.norm(), off = momentum_error * l;
  const Scalar slope = (gyrostat.inverse_inertia() * (H - gyrostat.target_momentum() * gyrostat.axis())).norm();
  return found.margin + level_error + off * (slope + off / gyrostat.principal()[0]) < 0;
}

}  // namespace detail

/// The attractor of the motion from `start`, found by following it for at most `longest`, s. A certificate counts only where
/// the estimated error of the motion cannot undo it. The time is right to 1e-3 of itself or 1/200 of a turn,
/// from above. tolerance: of the motion.
template <Real Scalar>
Capture<Scalar> capture(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, Scalar longest,
                        Scalar tolerance) noexcept {
  const Scalar l = start.momentum.norm();
  const SteadyRotations<Scalar> steady = steady_rotations(gyrostat, l);
  Capture<Scalar> made;
  made.attractor = certify(gyrostat, steady, start.momentum, start.axial_momentum);
  if (made.attractor.certificate != Certificate::undecided) return made;

  const Scalar level = made.attractor.level;  // V never exceeds that of the start
  constexpr std::size_t samples = 64;
  std::array<Scalar, samples> times;
  std::array<State<Scalar>, samples> states;
  FullMotionOptions<Scalar> options;
  options.tolerance = tolerance;
  // From t = 0 every time, so that the estimated error is that of the whole motion. Nothing where that cannot be followed; samples: none of them.
  const auto first_certain = [&](Scalar from, Scalar to) noexcept -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < samples; ++i) times[i] = from + (to - from) * Scalar(i + 1) / Scalar(samples);
    const auto answer = full_motion<Scalar>(gyrostat, start, times, states, options);
    if (!answer || answer->status != ode::Status::reached) return std::nullopt;
    for (std::size_t i = 0; i < samples; ++i) {
      const auto found = certify(gyrostat, steady, states[i].momentum, states[i].axial_momentum);
      if (detail::certain(gyrostat, found, states[i].momentum, answer->error[column::angular_momentum],
                          answer->error[column::lyapunov] * level)) {
        made.attractor = found;
        made.time = times[i];
        return i;
      }
    }
    return samples;
  };
  const Scalar turn = 2 * pi<Scalar> / turning_rate(gyrostat, start);
  Scalar from = 0, to = std::min(longest, 16 * turn);
  while (const auto i = first_certain(from, to)) {
    if (*i < samples) {
      if (*i > 0) from = times[*i - 1];
      first_certain(from, made.time);
      return made;
    }
    made.time = to;
    made.attractor = certify(gyrostat, steady, states[samples - 1].momentum, states[samples - 1].axial_momentum);
    if (!(to < longest)) break;
    from = to;
    to = std::min(longest, 4 * to);
  }
  made.attractor.index = -1;
  made.attractor.certificate = Certificate::undecided;
  return made;
}

}  // namespace gyrostat::rotor
