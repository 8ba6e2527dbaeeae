// SPDX-License-Identifier: BSD-3-Clause
#pragma once

using Address = void (*)();

/// Where a file compiled for the baseline, and one compiled for AVX2 and fused multiply-add, have the same function of the headers.
Address of_baseline() noexcept;
Address of_v3() noexcept;
