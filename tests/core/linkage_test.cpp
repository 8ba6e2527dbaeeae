// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/linkage.hpp"

#include "catch.hpp"

#define GYROSTAT_TEXT_OF(x) #x
#define GYROSTAT_TEXT(x) GYROSTAT_TEXT_OF(x)

TEST_CASE("functions of the compiled library are not inline for those who link it", "[core]") {
#ifdef GYROSTAT_COMPILED
  CHECK(sizeof(GYROSTAT_TEXT(GYROSTAT_COMPILED_ONCE)) == sizeof(""));
#else
  CHECK(sizeof(GYROSTAT_TEXT(GYROSTAT_COMPILED_ONCE)) == sizeof("inline"));
#endif
}
