// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/result.hpp"

#include <cstring>

#include "catch.hpp"

using gyrostat::Errc;
using gyrostat::Result;

TEST_CASE("a result holds a value or the reason for its absence") {
  const Result<double> good = 2.5;
  CHECK(good);
  CHECK(*good == 2.5);
  CHECK(good.error() == Errc::ok);

  const Result<double> bad = Errc::zero_vector;
  CHECK_FALSE(bad);
  CHECK(bad.error() == Errc::zero_vector);
  CHECK(bad.value() == 0.0);
}

TEST_CASE("every failure has its own sentence") {
  constexpr int last = static_cast<int>(Errc::beyond_range);
  for (int i = 0; i <= last; ++i) {
    CHECK(std::strcmp(message(static_cast<Errc>(i)), "unknown error") != 0);
    for (int j = 0; j < i; ++j) CHECK(std::strcmp(message(static_cast<Errc>(i)), message(static_cast<Errc>(j))) != 0);
  }
  CHECK(std::strcmp(message(static_cast<Errc>(last + 1)), "unknown error") == 0);
}
