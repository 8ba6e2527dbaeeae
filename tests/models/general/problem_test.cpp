// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/problem.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/general/collected.hpp"

namespace general_problem_test {

using namespace gyrostat;
using namespace gyrostat::general;

TEST_CASE("a problem is a body at rest where nothing else is said", "[general]") {
  const Problem<double> p;
  CHECK_FALSE(check(p));
  CHECK(p.angular_velocity.isZero(0));
  CHECK(p.attitude == Quat<double>{});
  CHECK_FALSE(Collected<double>::of(p, 1.).steady().sum.any());
  // a factor is one, and a torque none, until it is given
  Factor<double> factor;
  CHECK(general::detail::take_constant(factor, 1.) == 1);
  CHECK(Torque<double>{}.vector.isZero(0));
  CHECK(Wheel<double>{}.type == WheelType::held);
}

TEST_CASE("a factor is on in its intervals, from their begin on and before their end", "[general]") {
  Factor<double> factor;
  CHECK(factor.is_on(-3));
  factor.on = {{0, 1}, {1, 2}, {2, 2}, {3, 4.5}, {5, 6}};
  for (const auto& [from, to] : factor.on)
    for (const double border : {from, to})
      for (const double t : {std::nextafter(border, -1.), border, std::nextafter(border, 9.)}) {
        const bool wanted =
            std::any_of(factor.on.begin(), factor.on.end(), [t](const auto& one) { return one[0] <= t && t < one[1]; });
        CAPTURE(t);
        CHECK(factor.is_on(t) == wanted);
      }
  CHECK_FALSE(factor.is_on(-1));
  CHECK_FALSE(factor.is_on(7));
}

}  // namespace general_problem_test
