// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/nutating.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "bodies.hpp"
#include "catch.hpp"
#include "direct_motion.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

/// p and q of some c = 1, down at any angle about axis 3.
State<double> start(std::mt19937& random, double spin, double G0) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double phi = 3.1 * unit(random), M3 = std::sqrt(1 - G0 * G0);
  State<double> s{{unit(random), unit(random), spin}, {M3 * std::sin(phi), M3 * std::cos(phi), G0}, {}};
  s.attitude = attitude_from_angles(unit(random), phi, s.down);
  return s;
}

/// The largest errors at 8 times up to t.
MotionError<double> errors(const Problem<double>& problem, const State<double>& from, const Nutating<double>& motion,
                           double t) {
  MotionError<double> worst;
  State<double> truth = from;
  for (int i = 1; i <= 8; ++i) {
    truth = direct_motion(problem, truth, t / 8, 1e-11);
    const auto at = motion.at(t / 8 * i);
    worst.angular_velocity = std::max(worst.angular_velocity, (at.angular_velocity - truth.angular_velocity).norm());
    worst.down = std::max(worst.down, (at.down - truth.down).norm());
    worst.attitude = std::max(worst.attitude, attitude_gap(at.attitude, truth.attitude));
  }
  return worst;
}

}  // namespace

TEST_CASE("nutating: the start itself at t = 0", "[heavy]") {
  std::mt19937 random(4);
  for (int body = 0; body < 20; ++body) {
    const Draw d = draw(random);
    if ((d.a - 1) * (d.b - 1) < 0) continue;
    const auto from = start(random, body % 2 == 0 ? 30 : -30, d.G0);
    const auto made = Nutating<double>::make(d.body(), from);
    REQUIRE(made);
    const auto at = made->at(0);
    CHECK((at.angular_velocity - from.angular_velocity).norm() < 1e-13);
    CHECK((at.down - from.down).norm() < 0.01);  // of length one to first order
    CHECK(attitude_gap(at.attitude, from.attitude) < 1e-7);
  }
}

TEST_CASE("nutating: estimates are not too small, and the errors of the stated orders", "[heavy]") {
  std::mt19937 random(6);
  for (double power : {1.0, 2.0}) {
    double last = 0, slope = 0;
    for (double eps : {0.05, 0.025}) {
      double sum = 0;
      random.seed(6);
      for (int body = 0; body < 40; ++body) {
        const Draw d = draw(random, 0.1, 0.8);
        const auto from = start(random, 1 / eps, d.G0);
        const auto made = Nutating<double>::make(d.body(), from);
        if ((d.a - 1) * (d.b - 1) < 0) {
          CHECK(made.error() == Errc::not_applicable);
          continue;
        }
        REQUIRE(made);
        const double t = std::pow(1 / eps, power) * eps;
        const auto error = errors(d.body(), from, *made, t), said = made->error(t);
        INFO(d.a << " " << d.b << " " << eps);
        CHECK(error.angular_velocity < said.angular_velocity);
        CHECK(error.down < said.down);
        CHECK(error.attitude < said.attitude);
        sum += error.down;
      }
      if (last > 0) slope = std::log2(last / sum);
      last = sum;
    }
    CHECK(slope == Approx(power == 1 ? 2 : 1).margin(0.25));  // eps^2 over 1/eps of phase, eps over 1/eps^2
  }
}

TEST_CASE("nutating: the motion from p = q = 0, where the forced one alone errs by all of it", "[heavy]") {
  for (const auto& row : reference_rows("motion")) {
    if (row.id != "pub05") continue;
    const auto* v = row.number.data();
    const State<double> from{{v[9], v[10], v[11]}, {v[12], v[13], v[14]}, {}};
    const auto made = Nutating<double>::make(row.problem(), from);
    const auto forced = Series2<double>::make(row.problem(), v[11], v[14]);
    REQUIRE(made);
    REQUIRE(forced);
    const Vec3<double> want(v[16], v[17], v[18]), down(v[19], v[20], v[21]);
    const auto at = made->at(v[15]);
    const double c = row.problem().pendulum_rate();
    CHECK((at.angular_velocity - want).norm() < 3e-3 * c);
    CHECK((at.down - down).norm() < 5e-3);
    CHECK((at.angular_velocity - want).norm() < made->error(v[15]).angular_velocity);
    CHECK((at.down - down).norm() < made->error(v[15]).down);
    if (v[15] > 0.1) CHECK((forced->at(v[15]).angular_velocity - want).norm() > 0.02 * c);
  }
}

TEST_CASE("nutating: without nutation, the forced motion", "[heavy]") {
  std::mt19937 random(10);
  for (int body = 0; body < 10; ++body) {
    const Draw d = draw(random);
    if ((d.a - 1) * (d.b - 1) < 0) continue;
    const auto forced = Series2<double>::make(d.body(), 100, d.G0);
    REQUIRE(forced);
    const auto made = Nutating<double>::make(d.body(), forced->at(0));
    REQUIRE(made);
    CHECK(made->amplitude() < 1e-13);
    CHECK(made->phase_rate() == Approx(forced->phase_rate()).epsilon(1e-13));
    CHECK(made->precession_rate() == Approx(forced->precession_rate()).epsilon(1e-13));
    const double omega = std::sqrt(made->scaled().nutation_squared());
    const Floquet<double> f(forced->scaled());
    const double nu = made->nutation_rate() / made->phase_rate();
    CHECK(nu == Approx(std::sqrt(f.squared)).margin(3 * f.squared_error));
    CHECK(std::abs(nu - omega) < 0.01);
  }
}

TEST_CASE("nutating: a steady spin on the resonance of the next order", "[heavy]") {
  const auto made =
      Nutating<double>::make(unit_body<double>(2, 2, {0, 0, 0}, 0), State<double>{{0, 0, 50}, {0.6, 0, 0.8}, {}});
  REQUIRE(made);
  REQUIRE(made->scaled().nutation_squared() == 0.25);
  CHECK(made->error(1).angular_velocity < 1e-11);
  CHECK(made->error(1).angular_velocity > 0);
}

TEST_CASE("nutating: where the second family is, the frequencies have the ratio omega again", "[heavy]") {
  for (double G0 : {0.0, 0.1, 0.3}) {
    const auto body = unit_body(0.55, 0.8, {0.6, 0.48, 0.64}, 0.7);
    const auto s = Scaled<double>::make(body, 50, G0);
    REQUIRE(s);
    const double amplitude = std::sqrt(Floquet<double>(*s).second_family_squared());
    const FirstOrder<double> first(*s);
    State<double> from = Series2<double>::make(body, 50, G0)->at(0);
    from.angular_velocity[0] += amplitude;
    const auto tilted = Nutating<double>::make(body, from);
    REQUIRE(tilted);
    const double omega = std::sqrt(s->nutation_squared());
    const auto still = Nutating<double>::make(body, Series2<double>::make(body, 50, G0)->at(0));
    REQUIRE(still);
    const double off = std::abs(tilted->nutation_rate() / tilted->phase_rate() - omega);
    CHECK(off < 0.1 * std::abs(still->nutation_rate() / still->phase_rate() - omega));
  }
}

TEST_CASE("nutating: what is refused", "[heavy]") {
  State<double> from{{0, 0, 20}, {0.6, 0, 0.8}, {}};
  const Vec3<double> at{0.6, 0.48, 0.64};
  CHECK(Nutating<double>::make(unit_body(0.7, 1.3, at, 0.3), from).error() == Errc::not_applicable);
  CHECK(Nutating<double>::make(unit_body(1.0, 0.7, at, 0.3), from).error() == Errc::not_applicable);
  CHECK(Nutating<double>::make(unit_body(0.7, 0.7, {0, 0, 0}, 0.3), from));
  from.angular_velocity[0] = gyrostat::nan<double>;
  CHECK(Nutating<double>::make(unit_body(0.7, 0.8, at, 0.3), from).error() == Errc::not_finite);
  from.angular_velocity = {1, 1, 0};
  CHECK(Nutating<double>::make(unit_body(0.7, 0.8, at, 0.3), from).error() == Errc::out_of_domain);
  from = {{0, 0, 20}, {0, 0, 1}, {}};
  CHECK(Nutating<double>::make(unit_body(0.7, 0.8, at, 0.3), from).error() == Errc::out_of_domain);
}
