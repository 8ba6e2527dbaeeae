// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/motion_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostats.hpp"

namespace free_motion_grid_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Motion;

Motion<double> motion_of(const Problem<double>& p) {
  auto exact = p.cast<DoubleDouble>();
  exact.attitude = normalised(exact.attitude);
  const auto m = Motion<double>::make(exact);
  REQUIRE(m);
  return *m;
}

TEST_CASE("a grid of a free motion gives the numbers of single calls", "[free]") {
  for (const Regime regime : regimes) {
    Bodies bodies(25);
    for (int i = 0; i < 12; ++i) {
      const auto m = motion_of(bodies.of(regime, i));
      const double T = std::isfinite(m.period()) ? m.period() : 10;
      constexpr std::size_t n = 300;
      std::vector<double> w(3 * n), q(4 * n), M(3 * n);
      for (const double step : {T / 97, -T / 7, 3.3 * T}) {
        const std::size_t before = allocations();
        m.grid(.1 * T, step, n, w.data(), q.data(), M.data());
        CHECK(allocations() == before);
        double worst = 0;
        for (std::size_t k = 0; k < n; ++k) {
          const auto s = m.at(.1 * T + step * double(k));
          for (std::size_t c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(w[3 * k + c] - s.angular_velocity[int(c)]) / s.angular_velocity.norm());
            worst = std::max(worst, std::abs(M[3 * k + c] - s.angular_momentum[int(c)]) / m.angular_momentum_norm());
          }
          worst = std::max(worst, angle_between({q[4 * k + 3], q[4 * k], q[4 * k + 1], q[4 * k + 2]}, s.attitude));
        }
        CAPTURE(free_bodies::name(regime), i, step / T, m.modulus().kp2);
        // k steps are rounded as often as a time: the phase of the body and that of its attitude
        const double speed = m.quarter_period() > 0 ? m.quarter_period() * 4 : 1,
                     turning = m.is_regular_precession() ? m.precession_rate() : std::abs(m.kappa(0));
        CHECK(worst <
              1e-13 * (m.cancellation(0) + speed) + 3e-16 * 300 * std::abs(step / T) * (speed + 100 + turning * T));
      }
    }
  }
  const auto m = motion_of(Problem<double>::from_moments({3, 2, 1.5}, {.1, 0, 0}, {1, 2, 3}));
  m.grid(0, 1, 5, nullptr, nullptr, nullptr);
}

}  // namespace free_motion_grid_test
