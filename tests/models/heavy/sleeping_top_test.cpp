// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/sleeping_top.hpp"

#include "catch.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

SymmetricTop<double> top(double z0, double gradient) {
  const auto problem = Problem<double>::make({0.002, 0.002, 0.001}, 0.5, {0, 0, z0}, 9.80665, gradient);
  REQUIRE(problem);
  const auto made = SymmetricTop<double>::of(*problem);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("sleeping top: the reference thresholds", "[heavy]") {
  CHECK(sleeping_top(top(-0.04, 0), true, 50.0).threshold == Approx(39.61141249690549).epsilon(1e-15));
  CHECK(sleeping_top(top(0.04, 0), false, 50.0).threshold == Approx(39.61141249690549).epsilon(1e-15));
  CHECK(sleeping_top(top(0.04, 0), true, 50.0).threshold == 0);
  CHECK(sleeping_top(top(-0.04, 50), true, 50.0).threshold == Approx(34.19157791035681).epsilon(1e-15));
  CHECK(sleeping_top(top(0.04, 50), false, 50.0).threshold == Approx(34.19157791035681).epsilon(1e-15));
  CHECK(sleeping_top(top(0.04, 50), true, 50.0).threshold == 0);
}

TEST_CASE("sleeping top: verdict, growth and amplification", "[heavy]") {
  const auto body = top(0.04, 0);
  const double limit = sleeping_top(body, false, 0.0).threshold;
  CHECK(sleeping_top(body, false, -1.001 * limit).verdict == SleepVerdict::stable);
  CHECK(sleeping_top(body, false, 0.98 * limit).verdict == SleepVerdict::unstable);
  CHECK(sleeping_top(body, false, limit).verdict == SleepVerdict::undecided);
  CHECK(sleeping_top(body, true, 0.0).verdict == SleepVerdict::stable);
  CHECK(sleeping_top(top(0, 0), true, 0.0).verdict == SleepVerdict::undecided);
  CHECK(sleeping_top(body, false, limit).amplification(1.001 * limit) == Approx(22.377).epsilon(1e-4));
  CHECK(sleeping_top(body, false, limit).amplification(limit) == infinity<double>);
  // without spin an inverted pendulum
  CHECK(sleeping_top(body, false, 0.0).growth_rate() == Approx(std::sqrt(body.weight / body.across)));
}

TEST_CASE("sleeping top: the exact top enlarges a small tilt by as much", "[heavy]") {
  const auto problem = Problem<double>::make({0.002, 0.002, 0.001}, 0.5, {0, 0, 0.04}, 9.80665, 0);
  const double tilt = 1e-6, limit = sleeping_top(top(0.04, 0), false, 0.0).threshold;
  // released at rest it leans out by the amplification
  for (const double share : {1.02, 1.3, 2.0}) {
    const double spin = share * limit;
    const auto made =
        LagrangeTop<double>::make(*problem, start_at({0, 0, spin}, {std::cos(tilt / 2), std::sin(tilt / 2), 0, 0}));
    REQUIRE(made);
    double most = 0;
    for (int i = 0; i < 400; ++i) {
      const auto s = made->at(i * made->nutation_period() / 400);
      most = std::max(most, std::hypot(s.down[0], s.down[1]) / tilt);
    }
    CHECK(most == Approx(sleeping_top(top(0.04, 0), false, spin).amplification(spin)).epsilon(1e-3));
  }
}
