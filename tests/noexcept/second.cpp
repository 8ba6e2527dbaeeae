// SPDX-License-Identifier: BSD-3-Clause
// A second translation unit with every header: what a header defines may be defined in each.
#include "gyrostat/gyrostat.hpp"
