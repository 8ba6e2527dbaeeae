// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/exp_log.hpp"
#include "levels.hpp"

Address of_v3() noexcept { return reinterpret_cast<Address>(&gyrostat::quaternion_from_vector<double>); }
