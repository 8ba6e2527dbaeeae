// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/problem.hpp"

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

}  // namespace general_problem_test
