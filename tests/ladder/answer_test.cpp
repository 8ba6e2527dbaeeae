// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/answer.hpp"

#include <cmath>
#include <cstring>

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("an answer finds its columns by name", "[ladder]") {
  Answer answer;
  answer.columns.push_back({"angular_momentum", 3, {1, 2, 3}, 1e-9});
  answer.columns.push_back({"angular_momentum_norm", 1, {4}, 1e-8});
  answer.columns.push_back({"energy", 1, {5}, 1e-7});
  REQUIRE(answer.find("angular_momentum"));
  CHECK(answer.find("angular_momentum")->width == 3);
  CHECK(answer.find("angular_momentum_norm")->values[0] == 4);
  char name[] = "energy";  // by its letters, not by its place in memory
  CHECK(answer.find(name)->values[0] == 5);
  CHECK(answer.find("angular") == nullptr);
  CHECK(answer.find("angular_momentum_norms") == nullptr);
  CHECK(answer.find("") == nullptr);
}

TEST_CASE("an empty answer promises nothing", "[ladder]") {
  const Answer answer;
  CHECK_FALSE(answer.met);
  CHECK(std::isnan(answer.error));
  CHECK(answer.find("energy") == nullptr);
  CHECK(answer.counts.rhs == 0);
  CHECK(std::strcmp(answer.model, "") == 0);
}
