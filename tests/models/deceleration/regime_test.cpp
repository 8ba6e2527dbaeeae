// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/regime.hpp"

#include <cstring>
#include <set>
#include <string>

#include "catch.hpp"

using namespace gyrostat::deceleration;

TEST_CASE("each regime has a symbol of its own", "[deceleration]") {
  std::set<std::string> symbols;
  for (const Regime r : {Regime::about_largest, Regime::about_smallest, Regime::one_component, Regime::point,
                         Regime::separatrix, Regime::rest}) {
    CHECK(std::strcmp(symbol(r), "?") != 0);
    symbols.insert(symbol(r));
  }
  CHECK(symbols.size() == 6);
  CHECK(symbols.count("A") == 1);
  CHECK(symbols.count("C") == 1);
  CHECK(std::string(symbol(Regime(200))) == "?");
}
