// SPDX-License-Identifier: BSD-3-Clause
// Tests that repeat one check over many random bodies take a part of them by day and all in the night.
#pragma once

#include <cstdlib>

/// Whether all is asked for: GYROSTAT_TESTS_AT_LENGTH is in the environment, as the tests of the label long have it.
inline bool at_length() {
  static const bool asked = std::getenv("GYROSTAT_TESTS_AT_LENGTH") != nullptr;
  return asked;
}

/// How many cases a test takes: the first `few`, or `all`. Its test case has the tag [length], or the night would pass it by.
inline int at_length(int few, int all) { return at_length() ? all : few; }
