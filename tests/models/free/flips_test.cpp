// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/flips.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostats.hpp"

namespace free_flips_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::flip_interval;
using gyrostat::free::flips;
using gyrostat::free::Motion;
using V = Vec3<double>;

TEST_CASE("a T-handle flips half a period apart, later the nearer to its middle axis it is spun", "[free]") {
  double last = 0;
  for (const double e : {1e-1, 2e-3, 1e-8, 1e-14}) {
    const auto m = *Motion<double>::make<DoubleDouble>(
        Problem<double>::from_moments({1.2e-4, .9e-4, .4e-4}, {0, 0, 0}, {e / 2, 9, e}).cast<DoubleDouble>());
    const double T = m.period();
    CHECK(flip_interval(m) == Approx(T / 2));
    CHECK(flip_interval(m) > last);
    last = flip_interval(m);
    const auto times = flips<double>(m, V(0, 1, 0), -T, 4 * T);
    REQUIRE(times.size() == 10);
    for (std::size_t i = 0; i < times.size(); ++i) {
      CHECK(std::abs(m.at(times[i]).angular_momentum[1]) < 1e-10 * m.angular_momentum_norm());
      if (i > 0) CHECK(times[i] - times[i - 1] == Approx(T / 2));
      // K + 2 K j
      const double u = m.jacobi_start() + m.jacobi_rate() * times[i];
      CHECK(std::abs(std::remainder(u, 2 * m.quarter_period())) < 1e-7 * m.quarter_period());
    }
    // beside the other principal axes: the one that M surrounds never, the third twice a period as well
    CHECK(flips<double>(m, V(1, 0, 0), 0, 4 * T).size() + flips<double>(m, V(0, 0, 1), 0, 4 * T).size() == 8);
  }
}

TEST_CASE("flips of a gyrostat are all the changes of sign", "[free]") {
  Bodies bodies(43);
  for (int i = 0; i < 100; ++i) {
    const auto m = *Motion<double>::make(bodies.of(i % 2 ? Regime::generic : Regime::unstable_axis, i));
    const V b = bodies.vector().normalized();
    if (!std::isfinite(m.period())) continue;
    const double end = 2.7 * m.period();
    const auto times = flips<double>(m, b, 0, end);
    int changes = 0;
    constexpr int n = 20000;
    for (int k = 1; k <= n; ++k)
      changes +=
          (b.dot(m.at(end * (k - 1) / n).angular_momentum) < 0) != (b.dot(m.at(end * k / n).angular_momentum) < 0);
    CHECK(changes == int(times.size()));
  }
}

TEST_CASE("motions without a period or a middle axis have no flips", "[free]") {
  const auto steady = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {0, 2, 0}));
  CHECK(flips<double>(steady, V(1, 0, 0), 0, 10).empty());
  CHECK(std::isnan(flip_interval(steady)));
  const auto with_rotor = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {1, 2, 3}, {0, 2, 0}));
  CHECK(std::isnan(flip_interval(with_rotor)));
  CHECK(flips<double>(with_rotor, V(1, 0, 0), 10, 0).empty());
  const auto turns = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {.1, 2, 0}));
  CHECK(flips<double>(turns, V(0, 1, 0), -gyrostat::infinity<double>, 10).empty());
  CHECK(flips<double>(turns, V(0, 1, 0), 1e30, 2e30).empty());
}

}  // namespace free_flips_test
