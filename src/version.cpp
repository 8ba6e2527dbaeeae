// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/version.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

const char* library_version() noexcept { return header_version; }

}  // namespace gyrostat::inline GYROSTAT_LEVEL
