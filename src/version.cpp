// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/version.hpp"

namespace gyrostat {

const char* library_version() noexcept { return header_version; }

}  // namespace gyrostat
