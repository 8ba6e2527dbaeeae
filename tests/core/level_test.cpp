// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/level.hpp"

#include <type_traits>

#include "catch.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/models/free/problem.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/ode/status.hpp"

namespace level = gyrostat::GYROSTAT_LEVEL;

// what is called gyrostat::x is gyrostat::LEVEL::x, so that its symbol names the level
static_assert(std::is_same_v<gyrostat::Lanes<double>, level::Lanes<double>>);
static_assert(std::is_same_v<gyrostat::math::Modulus<double>, level::math::Modulus<double>>);
static_assert(std::is_same_v<gyrostat::ode::Status, level::ode::Status>);
static_assert(std::is_same_v<gyrostat::heavy::Problem<double>, level::heavy::Problem<double>>);
static_assert(std::is_same_v<gyrostat::free::Problem<double>, level::free::Problem<double>>);

TEST_CASE("the level follows the options of the compiler") {
#define GYROSTAT_TEXT_OF(x) #x
#define GYROSTAT_TEXT(x) GYROSTAT_TEXT_OF(x)
  const char* name = GYROSTAT_TEXT(GYROSTAT_LEVEL);
  CHECK(name[0] == 'v');
#if defined(__FMA__) && defined(__AVX2__)
  CHECK(name[1] >= '3');
#else
  CHECK(name[1] <= '2');
#endif
}
