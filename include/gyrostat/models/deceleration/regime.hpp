// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "gyrostat/core/level.hpp"

namespace gyrostat::deceleration {

/// The kind of free orbit on which a state lies: a constant of the undisturbed motion.
enum class Regime : std::uint8_t {
  about_largest,   ///< two components, around the axis of the largest moment (type A)
  about_smallest,  ///< two components, around the axis of the smallest moment (type C)
  one_component,   ///< a single closed curve (type 1): only with rotor momentum
  point,           ///< a relative equilibrium, omega parallel to M
  separatrix,      ///< the orbit has no period
  rest,            ///< M = 0
};

/// Short name of a regime, as scene answers print it.
constexpr const char* symbol(Regime regime) noexcept {
  switch (regime) {
    case Regime::about_largest: return "A";
    case Regime::about_smallest: return "C";
    case Regime::one_component: return "1";
    case Regime::point: return "point";
    case Regime::separatrix: return "separatrix";
    case Regime::rest: return "rest";
  }
  return "?";
}

}  // namespace gyrostat::deceleration
