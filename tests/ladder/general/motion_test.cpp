// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/motion.hpp"

#include <string>
#include <string_view>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::general;

TEST_CASE("rungs of the families bear their names, and the full equations come last", "[general]") {
  for (std::size_t i = 0; i < std::size_t(rung::segments); ++i) {
    const auto [family, rung] = special_rungs[i];
    const Family& tables = *special_tables[std::size_t(family)];
    CHECK(std::string(rung_kinds[i].name) ==
          std::string(special_words[std::size_t(family)]) + ":" + tables.rungs[std::size_t(rung)].name);
    CHECK(std::string_view(tables.name) == special_words[std::size_t(family)]);
  }
  CHECK(std::size(rung_kinds) == std::size_t(rung::full) + 1);
  for (const int own : {rung::segments, rung::full}) CHECK(special_rungs[own].special == Special::none);
  for (std::size_t i = rung::family_full; i < std::size_t(rung::segments); ++i)
    CHECK(std::string_view(rung_kinds[i].name).ends_with(":full"));
}

TEST_CASE("rungs that know no phase lack what turns with the body", "[general]") {
  const auto lacks = [](const char* rung, std::size_t column) {
    return has(rung_kinds[std::size_t(place_of(tables.rungs, rung))].lacks, column);
  };
  for (const auto column : {column::attitude, column::angular_velocity, column::torque, column::down})
    CHECK(lacks("deceleration:averaged", column));
  CHECK_FALSE(lacks("deceleration:averaged", column::energy));
  CHECK(lacks("deceleration:averaged-2", column::attitude));
  CHECK_FALSE(lacks("deceleration:averaged-2", column::angular_velocity));
  CHECK(rung_kinds[rung::full].lacks == 0);
}
