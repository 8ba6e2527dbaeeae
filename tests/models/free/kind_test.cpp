// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/kind.hpp"

#include <set>
#include <string>

#include "catch.hpp"

TEST_CASE("every kind of a free motion has a name of its own", "[free]") {
  using gyrostat::free::Kind;
  std::set<std::string> names;
  for (const Kind kind : {Kind::about_largest, Kind::about_smallest, Kind::one_component, Kind::separatrix,
                          Kind::steady, Kind::spherical})
    names.insert(gyrostat::free::name(kind));
  CHECK(names.size() == 6);
  CHECK(names.count("") == 0);
}
