// SPDX-License-Identifier: BSD-3-Clause
// Includes nothing of gyrostat: it is compiled for the first processors of the architecture and runs on all of them.
#pragma once

/// The highest instruction level of x86-64 that this processor and its operating system run, from 1 to 4.
inline int highest_level() noexcept {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v4")) return 4;
  if (__builtin_cpu_supports("x86-64-v3")) return 3;
  if (__builtin_cpu_supports("x86-64-v2")) return 2;
  return 1;
}
