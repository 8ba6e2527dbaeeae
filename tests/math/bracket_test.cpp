// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/bracket.hpp"

#include <cmath>

#include "catch.hpp"

using namespace gyrostat;
using gyrostat::math::Bracket;
using gyrostat::math::SignChange;

TEMPLATE_TEST_CASE("each halving keeps the change and halves the way to it, either way round", "", float, double,
                   long double) {
  using S = TestType;
  const S place = std::sqrt(S(2));
  const auto before = [&](S x) { return x < place; };
  for (int trips = 0; trips <= 20; ++trips) {
    const auto up = Bracket<S>{1, 2}.halved(trips, before);
    const auto down = Bracket<S>{2, 1}.halved(trips, [&](S x) { return !before(x); });
    CHECK(up.yes < place);
    CHECK(up.no > place);
    CHECK(up.no - up.yes == std::ldexp(S(1), -trips));
    CHECK(down.yes == up.no);
    CHECK(down.no == up.yes);
  }
}

TEMPLATE_TEST_CASE("a change of sign is found to the last digit, also where false position stalls", "", float, double,
                   long double) {
  using S = TestType;
  const auto search = [](const auto& f, S low, S high, int& calls) {
    SignChange<S> change{low, f(low), high, f(high)};
    for (calls = 0; calls < 200; ++calls) {
      const S x = change.guess(calls);
      if (!change.contains(x)) break;
      change.take(x, f(x));
    }
    return change;
  };
  int calls = 0;
  for (const S place : {S(0.1L), S(0.9L), S(1e-3L)}) {
    for (const int power : {1, 3, 9}) {
      const auto f = [&](S x) { return std::pow(x, S(power)) - std::pow(place, S(power)); };
      const auto rising = search(f, 0, 1, calls);
      CAPTURE(place, power, calls);
      CHECK(calls < 200);
      CHECK(rising.high - rising.low <= 2 * epsilon<S> * rising.high);
      CHECK(std::abs(rising.high / place - 1) <= 4 * epsilon<S> * (1 + S(1) / S(power)));
      const auto falling = search([&](S x) { return -f(x); }, 0, 1, calls);
      CHECK(calls < 200);
      CHECK(falling.high - falling.low <= 2 * epsilon<S> * falling.high);
      CHECK(std::abs(falling.high / rising.high - 1) <= 8 * epsilon<S>);
    }
  }
}
