// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/answer.hpp"

#include <cmath>
#include <cstring>

#include "catch.hpp"

using namespace gyrostat;

namespace {

constexpr ColumnKind momentum{"angular_momentum", 3, "N m s", Frame::body, Measure::relative, ""};
constexpr ColumnKind norm{"angular_momentum_norm", 1, "N m s", Frame::none, Measure::relative, ""};
constexpr ColumnKind energy{"energy", 1, "J", Frame::none, Measure::relative, ""};
constexpr ScalarKind stop{"stop_time", 1, "s", Frame::none, Measure::relative, ""};
constexpr WarningKind late{"late", "it is late"};

}  // namespace

TEST_CASE("an answer finds its columns by name", "[ladder]") {
  Answer answer;
  answer.columns.push_back({&momentum, {1, 2, 3}, 1e-9});
  answer.columns.push_back({&norm, {4}, 1e-8});
  answer.columns.push_back({&energy, {5}, 1e-7});
  REQUIRE(answer.find("angular_momentum"));
  CHECK(answer.find("angular_momentum")->kind->width == 3);
  CHECK(answer.find("angular_momentum_norm")->values[0] == 4);
  char name[] = "energy";  // by its letters, not by its place in memory
  CHECK(answer.find(name)->values[0] == 5);
  CHECK(answer.find("angular") == nullptr);
  CHECK(answer.find("angular_momentum_norms") == nullptr);
  CHECK(answer.find("") == nullptr);
}

TEST_CASE("an answer finds its scalars by name and its warnings by code", "[ladder]") {
  Answer answer;
  answer.quantities.push_back({&stop, {12}, 1e-6});
  answer.warnings.push_back({&late, late.text, 3});
  REQUIRE(answer.quantity("stop_time"));
  CHECK(answer.quantity("stop_time")->values[0] == 12);
  CHECK(answer.quantity("stop") == nullptr);
  CHECK(answer.warns("late"));
  CHECK_FALSE(answer.warns("lat"));
}

TEST_CASE("an empty answer promises nothing", "[ladder]") {
  const Answer answer;
  CHECK_FALSE(answer.met);
  CHECK(std::isnan(answer.error));
  CHECK(answer.find("energy") == nullptr);
  CHECK(answer.counts.rhs == 0);
  CHECK(std::strcmp(answer.model, "") == 0);
}
