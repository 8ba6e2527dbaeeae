// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/family.hpp"

#include <set>
#include <string_view>

#include "catch.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"

using namespace gyrostat;

namespace {

const Family* const families[] = {&deceleration::tables, &rotor::tables, &spinning::tables, &heavy::tables};

template <class Table, class Name>
void check_distinct(const Table& table, Name name) {
  std::set<std::string_view> seen;
  for (const auto& row : table) {
    CAPTURE(name(row));
    CHECK(!std::string_view(name(row)).empty());
    CHECK(seen.insert(name(row)).second);
  }
}

}  // namespace

TEST_CASE("rows of a table are found by name or code", "[ladder]") {
  CHECK(place_of(rotor::tables.columns, "angular_momentum") == int(rotor::column::angular_momentum));
  CHECK(place_of(rotor::tables.warnings, "marginal") == int(rotor::warning::marginal));
  CHECK(place_of(rotor::tables.rungs, "full") == rotor::rung::full);
  CHECK(place_of(rotor::tables.rungs, "fuller") == -1);
  CHECK(row_width(rotor::column_kinds) == 13);
}

TEST_CASE("the tables of each family are complete: names once, units, meanings", "[ladder]") {
  for (const Family* family : families) {
    CAPTURE(family->name);
    check_distinct(family->columns, [](const ColumnKind& row) { return row.name; });
    check_distinct(family->scalars, [](const ScalarKind& row) { return row.name; });
    check_distinct(family->warnings, [](const WarningKind& row) { return row.code; });
    check_distinct(family->rungs, [](const RungKind& row) { return row.name; });
    for (const ColumnKind& column : family->columns) {
      CAPTURE(column.name);
      CHECK(!std::string_view(column.meaning).empty());
      CHECK((column.width == 1 || column.width == 3 || column.width == 4));
      CHECK((column.width != 4 || column.measure == Measure::angle));  // quaternions; angles of a rotation have three
      CHECK((column.kind == Kind::word) == !column.words.empty());
    }
    for (const RungKind& rung : family->rungs) CHECK(!std::string_view(rung.meaning).empty());
    CHECK(std::string_view(family->rungs.back().name) == "full");
    CHECK(std::string_view(family->integrators.front()) == "taylor");
  }
}
