// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/regular_precession.hpp"

#include "catch.hpp"
#include "gyrostat/models/heavy/lagrange_gradient.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("regular precession: the exact top keeps its inclination and its rate", "[heavy]") {
  for (const double z0 : {0.04, -0.04})
    for (const double gradient : {0.0, 50.0})
      for (const double tilt : {0.5, 2.0, 2.9}) {
        const auto problem = Problem<double>::make({0.002, 0.002, 0.001}, 0.5, {0, 0, z0}, 9.80665, gradient);
        const auto top = SymmetricTop<double>::of(*problem);
        const double spin = 80;
        auto start = start_at({0, 0, 0}, {std::cos(tilt / 2), std::sin(tilt / 2), 0, 0});
        const auto rates = regular_precession(*top, start.down[2], spin);
        REQUIRE(rates.exists);
        CHECK(std::abs(rates.slow) <= std::abs(rates.fast));
        for (const double rate : {rates.slow, rates.fast}) {
          CAPTURE(z0, gradient, tilt, rate);
          start.angular_velocity = precessing_velocity(start.down, spin, rate);
          if (gradient == 0) {
            const auto made = LagrangeTop<double>::make(*problem, start);
            REQUIRE(made);
            CHECK(made->greatest() - made->least() < 1e-13);
            CHECK(made->mean_precession() == Approx(rate).epsilon(1e-12));
          }
          const auto made = LagrangeGradient<double>::make(*problem, start);
          REQUIRE(made);
          CHECK(made->greatest() - made->least() < 1e-13);
          CHECK(made->mean_precession() == Approx(rate).epsilon(1e-12));
          const auto truth = LongMotion::from(*problem, start, {0.3});
          CHECK(std::abs(double(truth[0].down[2]) - start.down[2]) < 1e-13);
        }
      }
}

TEST_CASE("regular precession: fast spin without cancellation, limits, and where there is none", "[heavy]") {
  const auto problem = Problem<double>::make({0.002, 0.002, 0.001}, 0.5, {0, 0, 0.04}, 9.80665, 0);
  const auto top = *SymmetricTop<double>::of(*problem);
  const double W = top.weight;
  for (const double r : {1e6, -1e9}) {
    const auto rates = regular_precession(top, 0.7, r);
    CHECK(rates.slow == Approx(-W / (0.001 * r)).epsilon(1e-6));
    CHECK(rates.fast == Approx(0.001 * r / (0.002 * 0.7)).epsilon(1e-6));
    // the roots' product, to rounding
    CHECK(rates.slow * rates.fast == Approx(-W / (0.002 * 0.7)).epsilon(1e-15));
  }
  CHECK(regular_precession(top, 0.0, 50.0).slow == Approx(-W / 0.05));
  for (const double level : {0.0, 6e-17, -1e-15}) CHECK(regular_precession(top, level, 50.0).fast == infinity<double>);
  CHECK(regular_precession(top, 1e-12, 50.0).fast == Approx(0.001 * 50 / (0.002 * 1e-12)));
  CHECK_FALSE(regular_precession(top, -0.9, 5.0).exists);
  CHECK(std::isnan(regular_precession(top, -0.9, 5.0).slow));
  CHECK(regular_precession(top, 0.9, 0.0).exists);  // conical pendulum
  CHECK(regular_precession(top, 0.9, 0.0).slow == Approx(-regular_precession(top, 0.9, 0.0).fast));
  CHECK_FALSE(regular_precession(top, gyrostat::nan<double>, 5.0).exists);
}
