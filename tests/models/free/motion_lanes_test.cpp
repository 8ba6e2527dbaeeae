// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/motion_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostats.hpp"

namespace motion_lanes_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Kind;
using gyrostat::free::Motion;
using gyrostat::free::MotionLanes;
using gyrostat::free::PrincipalProblem;
using Wide = DoubleDouble;

constexpr int size = MotionLanes::size;

MotionLanes lanes_of(const std::vector<Problem<double>>& bodies) {
  MotionLanes lanes;
  for (int b = 0; b < size; ++b)
    lanes.set(b, b + 1, PrincipalProblem<double>::of(bodies[std::size_t(b)]), bodies[std::size_t(b)].attitude);
  lanes.make();
  return lanes;
}

/// Where the sums of the theta functions are trigonometric.
bool is_trigonometric(const Motion<double>& m) {
  return m.kind() != Kind::steady && m.kind() != Kind::spherical && !m.hyperbolic();
}

struct Tally {
  int trigonometric = 0, tame = 0, wrong_kind = 0;
  std::vector<double> lanes, alone;  // greatest errors of rates, momentum and attitude
  static double part(std::vector<double>& x, double share) {
    std::sort(x.begin(), x.end());
    return x.empty() ? 0 : x[std::size_t(share * double(x.size() - 1))];
  }
};

Tally tally(Regime regime, int count, unsigned seed) {
  Bodies bodies(seed);
  Tally tally;
  for (int i = 0; i < count; i += size) {
    std::vector<Problem<double>> given;
    for (int b = 0; b < size; ++b) given.push_back(bodies.of(regime, i + b));
    const MotionLanes lanes = lanes_of(given);
    MotionLanes::Row t;
    std::vector<std::optional<Motion<double>>> alone;
    for (int b = 0; b < size; ++b) {
      const auto made = Motion<double>::make(given[std::size_t(b)]);
      alone.push_back(made ? std::optional(*made) : std::nullopt);
      t[b] = made && std::isfinite(made->period()) ? bodies.uniform(-1, 3) * made->period() : 1;
    }
    const auto states = lanes.at(t);
    for (int b = 0; b < size; ++b) {
      const auto& m = alone[std::size_t(b)];
      tally.trigonometric += m && is_trigonometric(*m);
      if (!lanes.tame(b)) continue;
      ++tally.tame;
      const auto truth = Motion<Wide>::make<Wide>(given[std::size_t(b)].cast<Wide>());
      REQUIRE((m && truth));
      tally.wrong_kind += lanes.kind(b) != m->kind() || !is_trigonometric(*m);
      CAPTURE(free_bodies::name(regime), i, b);
      CHECK(lanes.period()[b] == Approx(m->period()).epsilon(1e-10));
      // where a second component is born the data leave k2 half its digits
      const double digits = regime == Regime::bisected ? 1e-7 : 1e-10;
      CHECK(lanes.modulus_squared()[b] == Approx(m->modulus_squared()).margin(digits));
      CHECK(lanes.energy()[b] == Approx(m->energy()).epsilon(1e-14));
      CHECK(lanes.angular_momentum_norm()[b] == Approx(m->angular_momentum_norm()).epsilon(1e-14));
      CHECK(std::cos(lanes.turn_per_period()[b] - m->turn_per_period()) == Approx(1));
      const auto at = truth->at(t[b]);
      const Off o = off(states.lane(b), at), one = off(m->at(t[b]), at);
      tally.lanes.push_back(std::max({o.rates, o.momentum, o.attitude}));
      tally.alone.push_back(std::max({one.rates, one.momentum, one.attitude}));
    }
  }
  return tally;
}

TEST_CASE("free bodies side by side err as one by one", "[free][length]") {
  for (const Regime regime : regimes) {
    auto t = tally(regime, at_length(192, 480), 53);
    CAPTURE(free_bodies::name(regime), t.trigonometric, t.tame);
    CHECK(t.wrong_kind == 0);
    CHECK(t.tame <= t.trigonometric);
    if (regime == Regime::generic || regime == Regime::little_momentum) CHECK(t.tame > .97 * t.trigonometric);
    if (regime == Regime::equal_moments) CHECK(t.tame == 0);
    CHECK(Tally::part(t.lanes, .5) <= 4 * Tally::part(t.alone, .5));
    CHECK(Tally::part(t.lanes, .95) <= 16 * Tally::part(t.alone, .95) + 1e-14);
  }
}

TEST_CASE("the attitude of free bodies side by side begins at the given one", "[free]") {
  Bodies bodies(54);
  for (int i = 0; i < 80; i += size) {
    std::vector<Problem<double>> given;
    for (int b = 0; b < size; ++b) given.push_back(bodies.of(Regime::generic, i + b));
    const MotionLanes lanes = lanes_of(given);
    const MotionLanes::Row start = {};
    const auto states = lanes.at(start);
    for (int b = 0; b < size; ++b) {
      if (!lanes.tame(b)) continue;
      const auto& q = given[std::size_t(b)].attitude;
      const auto s = states.lane(b);
      CHECK(norm(conjugate(q) * s.attitude) == Approx(1).epsilon(1e-15));
      CHECK(std::abs((conjugate(q) * s.attitude).w) == Approx(1).epsilon(1e-15));
    }
  }
}

TEST_CASE("a free motion at eight times is what it is at each", "[free]") {
  Bodies bodies(55);
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    const auto m = Motion<double>::make(bodies.of(Regime::generic, i));
    REQUIRE(m);
    const auto lanes = MotionLanes::of(*m);
    CHECK(lanes.has_value() == is_trigonometric(*m));
    if (!lanes) continue;
    ++seen;
    MotionLanes::Row t;
    for (int b = 0; b < size; ++b) t[b] = b * m->period() / 7 + (b > 4 ? 1e6 * m->period() : 0);
    const auto looks = lanes->look(t);
    const auto states = lanes->at(t);
    for (int b = 0; b < size; ++b) {
      CAPTURE(i, b);
      const auto s = looks.states.lane(b), alone = m->at(t[b]);
      CHECK(off(s, alone).attitude < 4e-15);
      CHECK(off(s, alone).rates < 1e-14);
      CHECK(off(s, alone).momentum < 1e-14);
      CHECK(off(states.lane(b), s).attitude < 4e-15);
      CHECK(looks.cancellation[b] == Approx(m->cancellation(t[b])));
      CHECK(looks.rate_terms[b] == Approx(m->rate_terms(t[b])));
      // roundings, whose number depends on the order of the terms
      const double fastest = alone.angular_velocity.norm();
      if (b > 0) CHECK(looks.defect[b] < 1e-14 * fastest + 4 * m->defect(t[b], 1));
      if (b > 0) CHECK(m->defect(t[b], 1) < 1e-14 * fastest + 4 * looks.defect[b]);
    }
    MotionLanes::Row apart[3] = {};
    looks.states.widen(m->at(t[3]), apart);
    for (int b = 0; b < size; ++b) {
      const double momentum = off(looks.states.lane(b), m->at(t[3])).momentum * m->angular_momentum_norm();
      CHECK(std::sqrt(apart[1][b]) == Approx(momentum).margin(1e-15));
    }
  }
  CHECK(seen > 300);
}

TEST_CASE("lanes leave out what is not tame", "[free]") {
  const Vec3<double> J(6, 4, 3), none(0, 0, 0);
  const auto of = [&](const Vec3<double>& moments, const Vec3<double>& l, const Vec3<double>& w) {
    return Problem<double>::from_moments(moments, l, w);
  };
  const double bad = gyrostat::nan<double>;
  const MotionLanes lanes =
      lanes_of({of(J, none, {1, .1, .1}), of(J, none, {1e-4, 1, 1e-4}), of(J, none, {1, 1, 2}), of(J, none, {1, 0, 0}),
                of({2, 2, 2}, {1, 2, 3}, {1, 0, 0}), of({2, 2, 1}, {.1, .2, .3}, {1, 2, 3}), of(J, none, {bad, 1, 1}),
                of(J, {.1, -.2, .3}, {1, .1, .1})});
  const bool tame[] = {true, false, false, false, false, false, false, true};
  for (int b = 0; b < size; ++b) CHECK(lanes.tame(b) == tame[b]);
}

}  // namespace motion_lanes_test
