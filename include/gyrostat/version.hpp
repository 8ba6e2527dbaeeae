// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/level.hpp"

#define GYROSTAT_VERSION_MAJOR 0
#define GYROSTAT_VERSION_MINOR 2
#define GYROSTAT_VERSION_PATCH 0

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Version of these headers, as "major.minor.patch".
inline constexpr const char* header_version = "0.2.0";

/// Version of the compiled library that is linked (gyrostat::gyrostat); equal to header_version in a sound build.
const char* library_version() noexcept;

}  // namespace gyrostat::inline GYROSTAT_LEVEL
