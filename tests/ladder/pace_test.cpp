// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/pace.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("steps that do not lengthen and would overrun their budget by far are found hopeless", "[ladder]") {
  Pace<double> pace;
  CHECK_FALSE(pace.is_hopeless(0, 0, 1e9, 10));
  CHECK_FALSE(pace.is_hopeless(1 << 16, 1, 1e9, 10));
  CHECK(pace.is_hopeless(2 << 16, 2, 1e9, 10));
  pace.restart(2);
  CHECK_FALSE(pace.is_hopeless(3 << 16, 3, 1e9, 10));
}

namespace {

/// At which look the steps are found hopeless of which each look comes `grows` times as far as the one before, the first by 1 s, to `last`, s; 0: never.
std::uint64_t found_at(double last, double grows, std::uint64_t looks_of_budget, std::uint64_t restart_at = 0) {
  Pace<double> pace;
  double now = 0, stretch = 1;
  for (std::uint64_t looks = 1; now < last; ++looks, stretch *= grows) {
    now += stretch;
    if (pace.is_hopeless(looks << 16, now, last, looks_of_budget << 16)) return looks;
    if (looks == restart_at) pace.restart(now);
  }
  return 0;
}

}  // namespace

TEST_CASE("steps that have long not lengthened are found hopeless where they would overrun their budget at all",
          "[ladder]") {
  CHECK(found_at(20.5, 1, 20) == 7);
  CHECK(found_at(19.5, 1, 20) == 0);
  CHECK(found_at(20.5, 1, 20, 3) == 10);
  // by hundredths shorter and shorter: 19.5 s take 21.7 looks
  CHECK(found_at(19.5, 0.99, 20) > 0);
}

TEST_CASE("steps that lengthen are found hopeless where they would overrun their budget by half, if they go on to",
          "[ladder]") {
  // 152 looks of 1 s, by hundredths longer and longer, reach 350 s; 90 reach 145 s
  CHECK(found_at(145, 1.01, 152) == 0);
  CHECK(found_at(145, 1.01, 80) == 0);
  CHECK(found_at(145, 1.01, 50) == 7);
}
