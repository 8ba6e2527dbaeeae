// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/forced_start.hpp"

#include "catch.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Problem<double> stone_about(const Vec3<double>& inertia, const Vec3<double>& centre, double gradient = 0) {
  const auto made = Problem<double>::make(inertia, 0.8, centre, 9.80665, gradient);
  REQUIRE(made);
  return *made;
}

const Vec3<double> uneven{0.0011, 0.0016, 0.002};

}  // namespace

TEST_CASE("plain starts of fast periodic motions close", "[heavy]") {
  const auto check = [](const Problem<double>& p, const Periodic& asked) {
    const auto start = plain_start(p, asked);
    REQUIRE(start);
    const auto orbit = periodic_orbit<double>(p, asked.spin, asked.cos_inclination);
    REQUIRE(orbit);
    const double rate = std::abs(asked.spin);
    CHECK((start->angular_velocity - orbit->start.angular_velocity).norm() < 1e-12 * rate);
    CHECK((start->down - orbit->start.down).norm() < 1e-15);
    CHECK(std::abs((start->attitude * conjugate(orbit->start.attitude)).w) == Approx(1).epsilon(1e-14));
  };
  check(stone_about(uneven, {0, 0, 0}), {40, 0.3});
  check(stone_about(uneven, {0.01, 0.004, 0}), {-40, 0});
  check(stone_about(uneven, {0, 0, 0}, 3), {40, 0});
  check(stone_about({0.0016, 0.0016, 0.002}, {0, 0, 0.01}), {40, 0.3});
  check(stone_about({0.0016, 0.0016, 0.002}, {0, 0, -0.01}, 5), {-40, -0.6});
}

TEST_CASE("periodic motions without a plain start", "[heavy]") {
  CHECK(plain_start(stone_about(uneven, {0.01, 0, 0}), {40, 0.3}).error() == Errc::not_applicable);
  CHECK(plain_start(stone_about(uneven, {0.01, 0, 0.001}), {40, 0}).error() == Errc::not_applicable);
  CHECK(plain_start(stone_about(uneven, {0, 0, 0}, 1), {40, 0.3}).error() == Errc::not_applicable);
  CHECK(plain_start(stone_about({0.0016, 0.0016, 0.002}, {0, 0, -0.01}), {1, 0.3}).error() == Errc::no_convergence);
  CHECK(plain_start(stone_about(uneven, {0, 0, 0}), {0, 0.3}).error() == Errc::out_of_domain);
}

TEST_CASE("a departure from the forced motion grows no faster than stated", "[heavy]") {
  const auto p = stone_about({0.0011, 0.0014, 0.002}, {0.012, 0.009, 0.01});
  const double spin = 80, span = 2;
  const auto orbit = periodic_orbit<double>(p, spin, 0.1);
  REQUIRE(orbit);
  const auto scaled = *Scaled<double>::make(p, spin, 0.1);
  for (const double off : {1e-12, 1e-8, 1e-5, 1e-3}) {
    State<double> start = orbit->start;
    start.angular_velocity[0] += off * spin;
    CHECK(departure(start, orbit->start) == Approx(off).epsilon(1e-3));
    Question question;
    question.wants_attitude = true;
    Answer one, other;
    REQUIRE(true_motion(posed(p, start, span, question), one));
    REQUIRE(true_motion(posed(p, orbit->start, span, question), other));
    const auto stated = departed(scaled, off, span);
    CHECK(column_error(*one.find("down"), *other.find("down")) < stated.down);
    CHECK(column_error(*one.find("attitude"), *other.find("attitude")) < stated.attitude);
    CHECK(column_error(*one.find("angular_velocity"), *other.find("angular_velocity")) * spin <
          stated.angular_velocity);
  }
  CHECK(departed(scaled, 0, span).down == 0);
  CHECK(departed(scaled, 0.1, span).down == infinity<double>);
}

TEST_CASE("a departure grows about an unstable axis no faster than stated", "[heavy]") {
  const double spin = 80;
  for (const Vec3<double>& moments : {Vec3<double>(0.0011, 0.0024, 0.002), Vec3<double>(0.0019, 0.0024, 0.002)}) {
    const auto p = stone_about(moments, {0.01, 0, 0});
    const auto scaled = *Scaled<double>::make(p, spin, 0.1);
    REQUIRE(Floquet<double>(scaled).verdict == FastStability::unstable);
    const auto orbit = periodic_orbit<double>(p, spin, 0.1);
    REQUIRE(orbit);
    for (const double span : {0.05, 0.1, 0.2}) {
      CAPTURE(moments, span);
      State<double> start = orbit->start;
      start.angular_velocity[0] += 1e-9 * spin;
      Question question;
      question.wants_attitude = true;
      Answer one, other;
      REQUIRE(true_motion(posed(p, start, span, question), one));
      REQUIRE(true_motion(posed(p, orbit->start, span, question), other));
      const auto stated = departed(scaled, 1e-9, span);
      CHECK(std::isfinite(stated.down));
      CHECK(column_error(*one.find("down"), *other.find("down")) < stated.down);
      CHECK(column_error(*one.find("attitude"), *other.find("attitude")) < stated.attitude);
      CHECK(column_error(*one.find("angular_velocity"), *other.find("angular_velocity")) * spin <
            stated.angular_velocity);
    }
    CHECK(departed(scaled, 1e-9, 20).down == infinity<double>);
  }
}
