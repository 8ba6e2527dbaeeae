// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "gyrostat/core/level.hpp"

namespace gyrostat::free {

/// What a free motion is; a constant of the motion, named at construction.
enum class Kind : std::uint8_t {
  about_largest,   ///< the level has two components, and M surrounds an axis near that of the largest moment
  about_smallest,  ///< the same with the smallest moment
  one_component,   ///< the level has one component (with rotor momentum only)
  separatrix,      ///< M runs from one unstable permanent rotation to another, or back to the same; no period
  steady,          ///< a permanent rotation: omega is constant and parallel to M, or M = 0
  spherical,       ///< three equal moments: omega turns about the rotor momentum
};

constexpr const char* name(Kind kind) noexcept {
  switch (kind) {
    case Kind::about_largest: return "about-largest";
    case Kind::about_smallest: return "about-smallest";
    case Kind::one_component: return "one-component";
    case Kind::separatrix: return "separatrix";
    case Kind::steady: return "steady";
    case Kind::spherical: return "spherical";
  }
  return "";
}

}  // namespace gyrostat::free
