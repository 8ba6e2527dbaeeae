// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/lagrange_top.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "allocations.hpp"
#include "catch.hpp"
#include "long_motion.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;
using Q = Quat<double>;

Problem<double> top_body(double A, double C, double z0, int axis = 2, double N = 0) {
  V inertia = V::Constant(A), centre = V::Zero();
  inertia[axis] = C;
  centre[axis] = z0;
  const auto made = Problem<double>::make(inertia, 0.5, centre, 9.80665, N);
  REQUIRE(made);
  return *made;
}

LagrangeTop<double> top(const Problem<double>& problem, const State<double>& start) {
  const auto made = LagrangeTop<double>::make(problem, start);
  REQUIRE(made);
  return *made;
}

/// The body leans by `tilt` from standing (its third axis up), turned about that axis by `turn`, and about the
/// vertical.
Q leaning(double tilt, double turn = 0.3, double about = -0.8) {
  return Q{std::cos(about / 2), 0, 0, std::sin(about / 2)} * Q{std::cos(tilt / 2), std::sin(tilt / 2), 0, 0} *
         Q{std::cos(turn / 2), 0, 0, std::sin(turn / 2)};
}

Distance worst(const Problem<double>& problem, const State<double>& start, const std::vector<double>& times) {
  const auto exact = top(problem, start);
  const auto truth = LongMotion::from(problem, start, times);
  Distance d;
  for (std::size_t i = 0; i < times.size(); ++i) d.see(distance(exact.at(times[i]), truth[i]));
  return d;
}

const std::vector<double> top_times{0.0, 0.01, 0.033, 0.07, 0.13, 0.2, 0.31, 0.47, 0.6};

}  // namespace

TEST_CASE("lagrange top: the full equations from any start", "[heavy]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 40; ++n) {
    const int axis = n % 3;
    const double C = n % 5 == 4 ? 0.002 : 0.0005 + 0.0025 * std::abs(unit(random));
    const auto body = top_body(0.002, C, 0.03 * unit(random), axis);
    const double fast = n % 2 ? 100 : 5;
    V omega = 10 * V(unit(random), unit(random), unit(random));
    omega[axis] = fast * unit(random);
    const auto start = start_at(omega, {unit(random), unit(random), unit(random), unit(random)});
    CAPTURE(n, C, omega.transpose(), start.down.transpose());
    const auto d = worst(body, start, top_times);
    const auto bound = top(body, start).error(top_times.back());
    CHECK(d.attitude < 1e-12);
    CHECK(d.down < 1e-12);
    CHECK(d.angular_velocity < 1e-12 * (20 + fast));
    CHECK(d.attitude < bound.attitude);
    CHECK(d.down < bound.down);
    CHECK(d.angular_velocity < bound.angular_velocity);
    CHECK(bound.attitude < 1e-9);
  }
}

TEST_CASE("lagrange top: special starts", "[heavy]") {
  struct Case {
    const char* name;
    double C, z0;
    V omega;
    Q q;
  };
  const std::vector<Case> cases{
      {"sleeping", 0.001, 0.04, {0, 0, 150}, leaning(0)},
      {"upright, pushed", 0.001, 0.04, {3, 1, 60}, leaning(0)},
      {"upright, pushed, slow", 0.001, 0.04, {3, 1, 20}, leaning(0)},
      {"hanging, pushed", 0.001, -0.04, {3, 1, 20}, leaning(0)},
      {"hanging, pushed, no spin", 0.001, -0.04, {3, 1, 0}, leaning(0)},
      {"almost upright", 0.001, 0.04, {1e-9, 0, 20}, leaning(1e-9)},
      {"hanging almost", 0.001, -0.04, {1e-9, 0, 20}, leaning(1e-9)},
      {"released", 0.001, 0.04, {0, 0, 100}, leaning(0.4)},
      {"released, no spin", 0.001, 0.04, {0, 0, 0}, leaning(0.4)},
      {"spherical pendulum", 0.001, 0.04, {3, 4, 0}, leaning(2.4)},
      {"no weight", 0.001, 0.0, {3, 4, 30}, leaning(0.4)},
      {"no weight upright", 0.001, 0.0, {3, 4, 30}, leaning(0)},
      {"no weight sphere", 0.002, 0.0, {3, 4, 30}, leaning(0)},
      {"at rest hanging", 0.001, -0.04, {0, 0, 0}, leaning(0)},
      {"at rest standing", 0.001, 0.04, {0, 0, 0}, leaning(0)},
      {"upside", 0.001, 0.04, {0, 0, 10}, leaning(3.14159265358979)},
      {"through vertical", 0.001, 0.04, {8, 0, 0}, leaning(0.5, 0)},
      {"through vertical turned", 0.001, 0.04, {8, 1e-9, 1e-8}, leaning(0.5, 0)},
      {"almost through", 0.001, 0.04, {8, 1e-5, 1e-6}, leaning(2.5, 0)},
  };
  for (const auto& c : cases) {
    const auto body = top_body(0.002, c.C, c.z0);
    const auto start = start_at(c.omega, c.q);
    const auto d = worst(body, start, top_times);
    const auto e = top(body, start).error(top_times.back());
    CAPTURE(c.name);
    CHECK(d.attitude < 1e-13);
    CHECK(d.angular_velocity < 1e-12);
    CHECK(d.attitude < e.attitude);
    CHECK(d.down < e.down);
    CHECK(d.angular_velocity <= e.angular_velocity);
    CHECK(e.attitude < 1e-10);
  }
}

TEST_CASE("lagrange top: integrals along a thousand nutations", "[heavy]") {
  const auto body = top_body(0.002, 0.001, 0.04);
  const auto start = start_at({1, 2, 150}, leaning(0.6));
  const auto exact = top(body, start);
  const double E = body.energy(start), sigma = body.vertical_momentum(start);
  for (int n = 0; n < 200; ++n) {
    const auto s = exact.at(exact.nutation_period() * 5.03 * n);
    CHECK(std::abs(body.energy(s) / E - 1) < 1e-13);
    CHECK(std::abs(body.vertical_momentum(s) / sigma - 1) < 1e-13);
    CHECK(s.angular_velocity[2] == 150);
    CHECK(std::abs(s.down.norm() - 1) < 1e-14);
    CHECK((rotate<double>(conjugate(s.attitude), V(0, 0, -1)) - s.down).norm() < 1e-14);
  }
}

TEST_CASE("lagrange top: the reference motion, its period and its precession", "[heavy]") {
  int seen = 0;
  for (const auto& row : reference_rows("motion")) {
    if (row.id != "pub08") continue;
    ++seen;
    const auto& x = row.number;
    const V d(x[12], x[13], x[14]);
    const Q q = shortest_turn<double>(d, V(0, 0, -1));
    const auto exact = top(row.problem(), {V(x[9], x[10], x[11]), d, q});
    const auto s = exact.at(x[15]);
    CHECK((s.angular_velocity - V(x[16], x[17], x[18])).norm() <= 1e-12 * 150);
    CHECK((s.down - V(x[19], x[20], x[21])).norm() <= 1e-12);
    CHECK(exact.nutation_period() == Approx(0.086179831548813182535).epsilon(1e-13));
    CHECK(exact.precession_per_nutation() == Approx(0.11421649569470630232).epsilon(1e-12));
    CHECK(exact.mean_precession() == Approx(0.11421649569470630232 / 0.086179831548813182535).epsilon(1e-12));
    CHECK(exact.least() == Approx(0.7845825615181074907).epsilon(1e-14));
    CHECK(exact.greatest() == Approx(0.81757051543696177454).epsilon(1e-14));
    CHECK(exact.modulus().k2 == Approx(0.0012164473218956379677).epsilon(1e-12));
  }
  CHECK(seen == 6);
}

TEST_CASE("lagrange top: next to the separatrix the bound grows as the motion does", "[heavy]") {
  const auto body = top_body(0.002, 0.001, 0.04);
  const double W = body.moment().norm();
  for (const double spin : {0.0, 12.0})
    for (const double off : {0.0, 1e-15, -1e-13, 1e-10, -1e-6, 1e-3}) {
      // sigma = C r and E = C r^2/2 + W lead to upright
      const double tilt = 1.1, g = std::sin(tilt), up = std::cos(tilt);
      const double along = 0.001 * spin * (1 - up) / (0.002 * g * g);
      const double across = std::sqrt(2 * W * (1 - up) / 0.002 - along * along * g * g) * (1 + off);
      const Q q = leaning(tilt, 0);
      State<double> start = start_at({0, 0, 0}, q);
      const V e3(0, 0, 1), side = V(0, 0, 1).cross(start.down).normalized();
      start.angular_velocity = -along * (start.down - start.down[2] * e3) + across * side + spin * e3;
      const auto exact = top(body, start);
      const std::vector<double> times{0.05, 0.2, 0.7, 2, 6};
      const auto truth = LongMotion::from(body, start, times);
      for (std::size_t i = 0; i < times.size(); ++i) {
        CAPTURE(spin, off, times[i], exact.modulus().kp2);
        const auto d = distance(exact.at(times[i]), truth[i]);
        const auto bound = exact.error(times[i]);
        CHECK(d.attitude <= bound.attitude);
        CHECK(d.angular_velocity <= bound.angular_velocity);
        if (times[i] < 0.1) CHECK(bound.attitude < 1e-10);
        if (std::abs(off) > 1e-4) CHECK(bound.attitude < 1e-6);
      }
      CHECK(exact.modulus().kp2 < 4 * std::abs(off) + 1e-14);
    }
}

TEST_CASE(
    "lagrange top: kicked from the vertical with what all but takes it to the other pole, it stays in the plane of the "
    "kick",
    "[heavy]") {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 120; ++i) {
    const double z0 = (i % 2 == 0 ? 1 : -1) * (0.02 + 0.03 * any(random));
    const auto body = top_body(0.002, 0.001 + 0.0005 * any(random), z0);
    const double off = i % 3 == 0 ? 0 : (i % 3 == 1 ? 1 : -1) * std::pow(10, -4 - 12 * any(random));
    const double rate = 2 * std::sqrt(body.moment().norm() / 0.002) * (1 + off), way = 6 * any(random);
    const V kick(std::cos(way), std::sin(way), 0);
    const auto start = start_at(rate * kick, leaning(z0 > 0 ? pi<double> : 0));
    const auto motion = top(body, start);
    CAPTURE(i, z0, off, way);
    for (const double t : {0.01, 0.1, 0.4}) {
      const auto now = motion.at(t);
      const V& w = now.angular_velocity;
      CHECK(V(w - w.dot(kick) * kick).norm() <= motion.error(t).angular_velocity + 1e-13 * rate);
      CHECK(w.dot(kick) > 0);
    }
    const auto d = worst(body, start, {0.005, 0.05});
    CHECK(d.angular_velocity <= motion.error(0.05).angular_velocity);
    CHECK(d.down <= motion.error(0.05).down);
  }
}

TEST_CASE("lagrange top: what it does", "[heavy]") {
  const auto body = top_body(0.002, 0.001, 0.04);
  CHECK(top(body, start_at({0, 0, 150}, {1, 0, 0, 0})).motion() == AxisMotion::sleeping);
  CHECK(top(body, start_at({0, 0, 10}, {1, 0, 0, 0})).nutation_period() == gyrostat::infinity<double>);
  CHECK(top(body, start_at({0, 0, 150}, leaning(0.3))).motion() == AxisMotion::nutation);
  CHECK(top(top_body(0.002, 0.001, 0), start_at({0, 0, 150}, leaning(0.3))).motion() == AxisMotion::regular);
  // fast spin: the axis falls by (1 - u^2) 2 W A/(C r)^2 and precesses at W/(C r), here upwards
  const auto fast = top(body, start_at({0, 0, 1e4}, leaning(1.0)));
  const double W = body.moment().norm(), L = 10;
  CHECK(fast.greatest() - fast.least() == Approx(2 * W * 0.002 * std::pow(std::sin(1.0), 2) / (L * L)).epsilon(1e-4));
  CHECK(fast.mean_precession() == Approx(-W / L).epsilon(1e-4));
}

TEST_CASE("lagrange top: float and long double", "[heavy]") {
  const auto body = top_body(0.002, 0.001, 0.04);
  const auto start = start_at({1, 2, 150}, leaning(0.6));
  const auto wide = LagrangeTop<long double>::make(problem_cast<long double>(body), state_cast<long double>(start));
  const auto narrow = LagrangeTop<float>::make(problem_cast<float>(body), state_cast<float>(start));
  REQUIRE(wide);
  REQUIRE(narrow);
  const auto exact = top(body, start);
  for (const double t : {0.0, 0.1, 1.0}) {
    CHECK(distance(exact.at(t), wide->at(t)).attitude < exact.error(t).attitude);
    CHECK(distance(narrow->at(float(t)), wide->at(float(t))).attitude <
          double(narrow->error(float(t)).attitude) + 1e-4 * t);
  }
}

TEST_CASE("lagrange top: what is refused", "[heavy]") {
  const auto start = start_at({1, 2, 150}, leaning(0.6));
  CHECK(LagrangeTop<double>::make(top_body(0.002, 0.001, 0.04, 2, 40), start).error() == Errc::not_applicable);
  CHECK(LagrangeTop<double>::make(top_body(0.002, 0.002, 0.04, 2, 40), start));
  const auto uneven = Problem<double>::make({0.002, 0.0021, 0.001}, 0.5, {0, 0, 0.04}, 9.8, 0);
  CHECK(LagrangeTop<double>::make(*uneven, start).error() == Errc::not_applicable);
  const auto off = Problem<double>::make({0.002, 0.002, 0.001}, 0.5, {0, 0.001, 0.02}, 9.8, 0);
  CHECK(LagrangeTop<double>::make(*off, start).error() == Errc::not_applicable);
  auto broken = start;
  broken.attitude.w = gyrostat::nan<double>;
  CHECK(LagrangeTop<double>::make(top_body(0.002, 0.001, 0.04), broken).error() == Errc::not_finite);
  const auto exact = top(top_body(0.002, 0.001, 0.04), start);
  const auto before = allocations();
  CHECK(exact.at(1).down.norm() == Approx(1));
  CHECK(allocations() == before);
  CHECK(std::isnan(exact.at(gyrostat::nan<double>).down[0]));
}

TEST_CASE("what a top is off its symmetry by turns on in each nutation as down does in the body", "[heavy]") {
  const V inertia(1.2, 1.2, 0.7);
  const auto problem = Problem<double>::make(inertia, 1, V(0, 0, 0.4), 9.8, 0);
  REQUIRE(problem);
  State<double> start;
  start.angular_velocity = V(0.7, -1.1, 3.1);
  start.down = V(0.3, 0.5, -0.6).normalized();
  const auto top = LagrangeTop<double>::make(*problem, start);
  REQUIRE(top);
  const double period = top->nutation_period();
  const V first = top->at(0.3).down, later = top->at(0.3 + period).down;
  const double turn = std::atan2(later[1], later[0]) - std::atan2(first[1], first[0]);
  const double least = std::min(std::abs(std::sin(turn / 2)), std::abs(std::sin(turn)));
  CHECK(std::abs(top->lasting() / (period * (1 + 1 / least)) - 1) < 1e-10);
}
