// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/series_2.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "bodies.hpp"
#include "catch.hpp"
#include "direct_motion.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Series2<double> closed(const Problem<double>& problem, double spin, double G0) {
  const auto made = Series2<double>::make(problem, spin, G0);
  REQUIRE(made);
  return *made;
}

/// Of (p, q), r and all three over r0, of down and of the attitude.
struct Errors {
  double transverse = 0, axial = 0, rates = 0, down = 0, attitude = 0;
};

template <class Truth>
Errors orbit_errors(const Series2<double>& s, const Truth& truth, double from, double to, int n = 41) {
  Errors worst;
  for (int i = 0; i < n; ++i) {
    const double t = from + (to - from) * i / (n - 1);
    const auto a = s.at(t), b = truth.at(t);
    const Vec3<double> gap = (a.angular_velocity - b.angular_velocity) / s.scaled().spin;
    worst.transverse = std::max(worst.transverse, std::hypot(gap[0], gap[1]));
    worst.axial = std::max(worst.axial, std::abs(gap[2]));
    worst.rates = std::max(worst.rates, gap.norm());
    worst.down = std::max(worst.down, (a.down - b.down).norm());
    worst.attitude = std::max(worst.attitude, attitude_gap(a.attitude, b.attitude));
  }
  return worst;
}

}  // namespace

TEST_CASE("series 2: the values of the closed form", "[heavy]") {
  for (const auto& row : reference_rows("periodic")) {
    const auto problem = row.problem();
    const double r0 = row.number[9], c = problem.pendulum_rate();
    const auto s = closed(problem, r0, row.number[10]);
    const auto* v = &row.number[19];
    const auto at = s.at(v[0]);
    CHECK(at.angular_velocity[0] == Approx(c * v[1]).epsilon(1e-12));
    CHECK(at.angular_velocity[1] == Approx(c * v[2]).epsilon(1e-12));
    CHECK(at.angular_velocity[2] == Approx(r0 * v[3]).epsilon(1e-13));
    const Vec3<double> down(v[4], v[5], v[6]);
    CHECK((at.down - down.normalized()).norm() < 1e-13);
  }
}

TEST_CASE("series 2: p and q to order 3 in eps, the rest to order 4", "[heavy]") {
  std::mt19937 random(2);
  for (int body = 0; body < 20; ++body) {
    const Draw d = draw(random);
    Errors last;
    for (double eps : {0.02, 0.01}) {
      const auto truth = Series<double>::make(d.body(), 1 / eps, d.G0, 20);
      REQUIRE(truth);
      const auto now = orbit_errors(closed(d.body(), 1 / eps, d.G0), *truth, 0, truth->period());
      if (eps == 0.01) {
        CHECK(std::log2(last.transverse / now.transverse) == Approx(4).margin(0.15));  // over r0: one more than over c
        CHECK(std::log2(last.axial / now.axial) == Approx(4).margin(0.15));
        CHECK(std::log2(last.down / now.down) == Approx(4).margin(0.15));
        CHECK(std::log2(last.attitude / now.attitude) == Approx(4).margin(0.15));
      }
      last = now;
    }
  }
}

TEST_CASE("series 2: periodic motions closed by shooting, and their rates", "[heavy]") {
  const auto motions = reference_rows("motion");
  for (const auto& row : reference_rows("periodic")) {
    INFO(row.id);
    const auto s = closed(row.problem(), row.number[9], row.number[10]);
    CHECK(std::abs(s.period() / row.number[13] - 1) < s.period_error());
    CHECK(std::abs(s.period() / row.number[13] - 1) > s.period_error() / 20);
    for (const auto& at : motions) {
      if (at.id != row.id) continue;
      const auto state = s.at(at.number[15]);
      const auto said = s.error(at.number[15]);
      const Vec3<double> w(at.number[16], at.number[17], at.number[18]), d(at.number[19], at.number[20], at.number[21]);
      CHECK((state.angular_velocity - w).norm() < said.angular_velocity);
      CHECK((state.down - d).norm() < said.down);
    }
  }
}

TEST_CASE("series 2: estimates are never too small, and not idle", "[heavy]") {
  std::mt19937 random(8);
  int idle = 0, counted = 0;
  for (int body = 0; body < 300; ++body) {
    const Draw d = draw(random, 0.05);
    const double spin = std::array{50.0, 20.0, 10.0, 5.0}[static_cast<std::size_t>(body % 4)];
    const auto truth = Series<double>::make(d.body(), spin, d.G0, 26);
    if (!truth) continue;
    const auto s = closed(d.body(), spin, d.G0);
    for (double turns : {1.0, 100.0}) {
      const double to = truth->period() * turns;
      const auto error = orbit_errors(s, *truth, to * (turns - 1) / turns, to);
      const auto said = s.error(to);
      if (truth->error(to).relative(spin) > 0.01 * said.relative(spin)) continue;
      counted += 1;
      CHECK(error.rates * spin <= said.angular_velocity);
      CHECK(error.down <= said.down);
      CHECK(error.attitude <= said.attitude);
      idle += said.relative(spin) > 30 * std::max({error.rates, error.down, error.attitude});
      CHECK(std::abs(s.precession_rate() - truth->precession_rate()) <= s.precession_error());
    }
  }
  CHECK(counted > 450);
  CHECK(idle < counted / 10);
}

TEST_CASE("series 2: the slow precession of a symmetric top", "[heavy]") {
  const auto s = closed(unit_body(0.7, 0.7, {0, 0, 1}, 0.2), 40, 0.3);
  CHECK(s.precession_rate() == Approx((-1 + 0.2 * 0.3 * (2 - 1.4) / 2) / 40).epsilon(1e-13));
}

TEST_CASE("series 2: the limits of its domain", "[heavy]") {
  const Vec3<double> at{0.6, 0.48, 0.64};
  const auto made = [](double a, double b, Vec3<double> direction, double k, double spin, double G0) {
    return Series2<double>::make(unit_body(a, b, direction, k), spin, G0);
  };
  // what it divides vanishes too
  CHECK(made(1, 0.7, {0, 0.6, 0.8}, 0.3, 20, 0.3));
  CHECK(made(0.7, 1, {0.6, 0, 0.8}, 0.3, 20, 0.3));
  CHECK(made(1, 0.7, at, 0.3, 20, 0.3).error() == Errc::not_applicable);
  CHECK(made(0.7, 1, at, 0.3, 20, 0.3).error() == Errc::not_applicable);
  CHECK(made(0.7, 0.7, at, 0.3, 20, gyrostat::nan<double>).error() == Errc::not_finite);
  CHECK(made(0.7, 0.7, at, 0.3, 20, -1).error() == Errc::out_of_domain);
  // a lamina without z': the closed form exists, the next order does not
  const auto lamina = made(0.625, 0.375, {0.6, 0.8, 0}, 0.3, 20, 0.3);
  REQUIRE(lamina);
  CHECK(lamina->error(0).down == gyrostat::infinity<double>);
  CHECK(lamina->error(0).angular_velocity == gyrostat::infinity<double>);
  CHECK(lamina->period_error() == gyrostat::infinity<double>);
  CHECK(lamina->precession_error() == gyrostat::infinity<double>);
  // answered, with an estimate that covers the distance to the full series or says that there is none
  for (double gap : {0.05, 0.01, 0.003, 0.001}) {
    for (const auto& [a, b] : {std::pair{1 - gap, 0.8}, {0.8, 1 - gap}, {0.6, 0.4 + gap}}) {
      const auto s = made(a, b, at, 0.7, 20, 0.1);
      REQUIRE(s);
      const auto truth = Series<double>::to_tolerance(unit_body(a, b, at, 0.7), 20, 0.1, 1e-12, 1.0);
      if (!truth) {
        CHECK(doubts(s->scaled()).any());
        continue;
      }
      INFO(a << " " << b);
      const auto error = orbit_errors(*s, *truth, 0, 1);
      CHECK(error.down <= s->error(1).down + truth->error(1).down);
      CHECK(error.rates * 20 <= s->error(1).angular_velocity + truth->error(1).angular_velocity);
    }
  }
}
