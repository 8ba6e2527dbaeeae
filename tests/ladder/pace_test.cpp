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

TEST_CASE("steps that stay alike are found hopeless where they would overrun their budget at all", "[ladder]") {
  const auto found_after = [](double last) {
    Pace<double> pace;
    for (std::uint64_t looks = 1; looks < 20; ++looks)
      if (pace.is_hopeless(looks << 16, double(looks), last, 20 << 16)) return looks;
    return std::uint64_t(20);
  };
  CHECK(found_after(20.5) == 7);
  CHECK(found_after(19.5) == 20);
}
