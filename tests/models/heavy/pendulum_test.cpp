// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/pendulum.hpp"

#include "catch.hpp"
#include "long_motion.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;

/// Axis k is horizontal; the body turns by `angle` about it from an attitude without rounding.
State<double> swung(int k, double angle, double rate) {
  // body axis k along inertial axis 1, the next one up
  constexpr double h = 0.5;
  const Quat<double> level[] = {{std::sqrt(h), std::sqrt(h), 0, 0}, {h, h, -h, h}, {0, std::sqrt(h), 0, std::sqrt(h)}};
  State<double> s;
  s.angular_velocity = V::Zero();
  s.angular_velocity[k] = rate;
  Quat<double> turn{std::cos(angle / 2), 0, 0, 0};
  (k == 0 ? turn.x : k == 1 ? turn.y : turn.z) = std::sin(angle / 2);
  s.attitude = level[k] * turn;
  s.down = rotate<double>(conjugate(s.attitude), V(0, 0, -1));
  s.down[k] = 0;
  s.down.normalize();
  return s;
}

Problem<double> lined(int k, double gravity, double gradient, double way = 0.3) {
  V I(0.0011, 0.0016, 0.0020), c = V::Zero();
  c[(k + 1) % 3] = 0.012 * std::cos(way);
  c[(k + 2) % 3] = 0.012 * std::sin(way);
  const auto made = Problem<double>::make(I, 0.8, c, gravity, gradient);
  REQUIRE(made);
  return *made;
}

const std::vector<double> swing_times{0.0, 0.05, 0.13, 0.4, 0.77, 1.3};

Distance worst_swing(const Problem<double>& problem, const State<double>& start,
                     const std::vector<double>& times = swing_times) {
  const auto made = Pendulum<double>::make(problem, start);
  REQUIRE(made);
  const auto truth = LongMotion::from(problem, start, times);
  Distance d;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto here = distance(made->at(times[i]), truth[i]);
    const auto bound = made->error(times[i]);
    CHECK(here.attitude <= bound.attitude);
    CHECK(here.down <= bound.down);
    CHECK(here.angular_velocity <= bound.angular_velocity);
    d.see(here);
  }
  return d;
}

}  // namespace

TEST_CASE("heavy pendulum: libration and rotation about each principal axis", "[heavy]") {
  for (int k = 0; k < 3; ++k)
    for (const double angle : {0.0, 0.4, 2.0, -1.1, 3.0})
      for (const double rate : {0.0, 1.0, -7.0, 25.0, -60.0}) {
        CAPTURE(k, angle, rate);
        const auto d = worst_swing(lined(k, 9.8, 0), swung(k, angle, rate));
        CHECK(d.attitude < 1e-12);
        CHECK(d.angular_velocity < 1e-11);
      }
}

TEST_CASE("heavy pendulum: the gradient alone", "[heavy]") {
  for (int k = 0; k < 3; ++k)
    for (const double angle : {0.0, 0.4, 2.0, -1.1})
      for (const double rate : {0.0, 1.0, -4.0, 9.0}) {
        CAPTURE(k, angle, rate);
        const auto d = worst_swing(lined(k, 0, 40), swung(k, angle, rate));
        CHECK(d.attitude < 1e-12);
        CHECK(d.angular_velocity < 1e-11);
      }
}

TEST_CASE("heavy pendulum: separatrix, rest and small swings", "[heavy]") {
  const auto problem = lined(2, 9.8, 0, 0);
  const double c = problem.pendulum_rate();
  // hanging at angle pi/2 from the start of swung(): found from down itself
  const auto hanging = [&](double angle, double rate) {
    State<double> s = swung(2, 0, rate);
    const double now = std::atan2(s.down[1], s.down[0]);
    s = swung(2, now + angle, rate);
    return s;
  };
  for (const double off : {0.0, 1e-15, 1e-10, -1e-13, 1e-4, -1e-4}) {
    const auto start = hanging(0, 2 * c * (1 + off));
    const auto made = Pendulum<double>::make(problem, start);
    REQUIRE(made);
    CAPTURE(off, made->modulus().kp2);
    worst_swing(problem, start, {0.1, 0.5, 2, 5, 12});
    CHECK(made->error(0.1).attitude < 1e-12);
    if (std::abs(off) >= 1e-4) CHECK(made->error(12.0).attitude < 1e-7);
  }
  const auto exactly = Pendulum<double>::make(problem, hanging(0, 2 * c));
  REQUIRE(exactly);
  CHECK(exactly->error(30.0).attitude == gyrostat::infinity<double>);
  const auto small = Pendulum<double>::make(problem, hanging(1e-9, 0));
  REQUIRE(small);
  CHECK(small->motion() == PendulumMotion::libration);
  CHECK(small->period() == Approx(2 * pi<double> / c).epsilon(1e-14));
  State<double> still = swung(2, 0, 0);
  still.down = {1, 0, 0};
  const auto rest = Pendulum<double>::make(problem, still);
  REQUIRE(rest);
  CHECK(rest->motion() == PendulumMotion::rest);
  CHECK(rest->at(3).down == still.down);
  still.down = {-1, 0, 0};
  const auto standing = Pendulum<double>::make(problem, still);
  REQUIRE(standing);
  CHECK(standing->motion() == PendulumMotion::rest);
}

TEST_CASE("heavy pendulum: what swings the other way is the mirror image, to the bit", "[heavy]") {
  const auto problem = lined(2, 9.8, 0, 0);
  const double c = problem.pendulum_rate();
  for (const double share : {0.3, 1 - 1e-9, 1.0, 1 + 1e-9, 1.7}) {
    State<double> one;
    one.down = problem.moment().normalized();
    State<double> other = one;
    one.angular_velocity = {0, 0, 2 * c * share}, other.angular_velocity = {0, 0, -2 * c * share};
    const auto forth = Pendulum<double>::make(problem, one), back = Pendulum<double>::make(problem, other);
    REQUIRE(forth);
    REQUIRE(back);
    const auto across = Vec3<double>(0, 0, 1).cross(one.down);
    for (const double t : {0.05, 0.7, 3.0, 20.0}) {
      CAPTURE(share, t);
      const auto a = forth->at(t), b = back->at(t);
      CHECK(a.angular_velocity[2] == -b.angular_velocity[2]);
      CHECK(std::abs(a.down.dot(across) + b.down.dot(across)) < 1e-15);
    }
  }
}

TEST_CASE("heavy pendulum: nudged or tilted from upright by less than a rounding, it falls when it does", "[heavy]") {
  const auto made = Problem<double>::make({0.6, 1.0, 1.2}, 1, {0, 0, 0.3}, 9.8, 0);
  REQUIRE(made);
  const double growth = std::sqrt(9.8 * 0.3);  // rad/s: what is off grows by the linear equations to an angle of 1e-6
  constexpr double angle = 1e-6;
  const auto falls = [&](const State<double>& start, double reached, double sign, double square) {
    const auto pendulum = Pendulum<double>::make(*made, start);
    REQUIRE(pendulum);
    State<double> off;
    off.down = {sign * std::sin(angle), 0, -std::cos(angle)};
    const double rate = growth * angle * std::sqrt(1 + square);  // cosh^2 - sinh^2 = 1
    off.angular_velocity = {0, sign * rate, 0};
    const std::vector<double> later{1, 6, 9, 11, 13};  // down and up again
    const auto truth = LongMotion::from(*made, off, later);
    for (std::size_t i = 0; i < later.size(); ++i) {
      const double t = reached + later[i];
      const auto there = pendulum->at(t);
      CHECK(std::abs(there.down[0] - double(truth[i].down[0])) < 1e-9);
      CHECK(std::abs(there.angular_velocity[1] - double(truth[i].angular_velocity[1])) < 1e-9);
      CHECK(pendulum->error(t).down < 1e-11);
    }
  };
  State<double> start;
  start.down = {0, 0, -1};
  for (const double rate : {1e-12, 1e-16, -1e-30, 1e-90}) {
    start.angular_velocity = {0, rate, 0};
    CAPTURE(-std::log10(std::abs(rate)));
    const double part = std::abs(rate) / (angle * growth);
    falls(start, std::asinh(1 / part) / growth, rate > 0 ? 1 : -1, part * part);
  }
  start.angular_velocity = {0, 0, 0};
  for (const double tilt : {1e-9, 1e-17, -1e-40}) {
    start.down = {tilt, 0, -1};
    CAPTURE(-std::log10(std::abs(tilt)));
    const double part = std::abs(tilt) / angle;
    falls(start, std::acosh(1 / part) / growth, tilt > 0 ? 1 : -1, -part * part);
  }
}

TEST_CASE("heavy pendulum: slow at the top, where a rounding of the place is one of the time", "[heavy]") {
  const auto from = [](const V& I, double mass, const V& centre, double gravity, const V& down, const V& rate,
                       double t) {
    const auto made = Problem<double>::make(I, mass, centre, gravity, 0);
    REQUIRE(made);
    State<double> start;
    start.down = down;
    start.angular_velocity = rate;
    worst_swing(*made, *aligned(start), {t / 2, t});
  };
  from({33.77965597104993, 20.740633460969025, 41.27992423422752}, 0.3672953422745925,
       {0, 0.0070190321121635585, 0.017800295447560382}, 1.62, {0, -0.36683187996701555, -0.9302872523257885},
       {7.346519185365767e-08, 0, 0}, 750.3865208227086);
  from({27.024539456490118, 43.77759626562278, 17.621996710737662}, 0.6762543131355201,
       {0.011198466333342028, 0, 0.006438340303496544}, 9.81, {-0.8669323216213088, 0, -0.49842587184885134},
       {0, -1.948398561237342e-06, 0}, 245.71479375238556);
}

TEST_CASE("heavy pendulum: the reference motions and their periods", "[heavy]") {
  int seen = 0;
  for (const auto& row : reference_rows("motion")) {
    if (row.id != "pub07a" && row.id != "pub07b") continue;
    ++seen;
    const auto& x = row.number;
    const State<double> start{V(x[9], x[10], x[11]), V(x[12], x[13], x[14]), {}};
    const auto made = Pendulum<double>::make(row.problem(), start);
    REQUIRE(made);
    const auto s = made->at(x[15]);
    CHECK((s.angular_velocity - V(x[16], x[17], x[18])).norm() <= 1e-12 * start.angular_velocity.norm());
    CHECK((s.down - V(x[19], x[20], x[21])).norm() <= 1e-12);
    CHECK(made->period() == Approx(row.id == "pub07a" ? 0.5921889339513522035 : 0.7478614710050073084).epsilon(1e-13));
  }
  CHECK(seen == 12);
}

TEST_CASE("heavy pendulum: what is refused", "[heavy]") {
  const auto good = swung(2, 0.3, 1);
  CHECK(Pendulum<double>::make(lined(2, 9.8, 0), good));
  CHECK(Pendulum<double>::make(lined(2, 9.8, 40), good).error() == Errc::not_applicable);
  CHECK(Pendulum<double>::make(lined(1, 9.8, 0), good).error() == Errc::not_applicable);
  auto tilted = good;
  tilted.angular_velocity[0] = 1e-9;
  CHECK(Pendulum<double>::make(lined(2, 9.8, 0), tilted).error() == Errc::not_applicable);
  tilted.angular_velocity[0] = gyrostat::nan<double>;
  CHECK(Pendulum<double>::make(lined(2, 9.8, 0), tilted).error() == Errc::not_finite);
}
