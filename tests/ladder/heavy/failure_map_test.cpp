// SPDX-License-Identifier: BSD-3-Clause
// The failure map of docs/heavy.md, section 10: one test case a row.
#include <cmath>
#include <cstring>

#include "catch.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

bool by(const Answer& answer, const char* model) { return std::strcmp(answer.model, model) == 0; }
bool warns(const Answer& answer, const char* code) { return answer.warns(code); }
double value_of(const Answer& answer, const char* name) {
  const Quantity* found = answer.quantity(name);
  return found ? found->values[0] : gyrostat::nan<double>;
}

Answer honest(const Scene& scene) {
  Refusal refusal;
  const Answer answer = heavy::solve(scene, refusal);
  INFO(refusal.why);
  REQUIRE(refusal.code == Errc::ok);
  check_honest(scene, answer);
  return answer;
}
Refusal refusal_of(const Scene& scene) {
  Refusal refusal;
  CHECK(heavy::solve(scene, refusal).columns.empty());
  return refusal;
}

/// M g l = C = 1: c = 1, and N is k. A light body under strong gravity, so that every centre is real.
Problem<double> unit_body(double a, double b, const Vec3<double>& direction, double k = 0) {
  const auto made = Problem<double>::make({a, b, 1}, 1, 1e-6 * direction.normalized(), 1e6, k);
  REQUIRE(made);
  return *made;
}

const Vec3<double> towards{0.6, 0.48, 0.64};

Answer periodic_of(const Problem<double>& p, double spin, double cosine = 0.1, double tolerance = 1e-6,
                   int rung = any_rung) {
  return honest(periodic(p, spin, cosine, 3, tolerance, rung));
}

}  // namespace

TEST_CASE("failure map: heavy bodies that cannot be", "[heavy]") {
  CHECK(Problem<double>::make({1, 1, 2.1}, 1, {0, 0, 0}, 9.8, 0).error() == Errc::triangle_inequality);
  // moments that are possible, but not with the centre so far from the point they are about
  CHECK(Problem<double>::make({1, 1, 1}, 1, {0.9, 0, 0}, 9.8, 0).error() == Errc::triangle_inequality);
  CHECK(Problem<double>::make({1, 1, 1}, 1, {0.7, 0, 0}, 9.8, 0));
}

TEST_CASE("failure map: a slow spin", "[heavy]") {
  const auto p = unit_body(0.55, 0.8, towards);
  const Answer fast = periodic_of(p, 20), slow = periodic_of(p, 2.5),
               second = periodic_of(p, 2.5, 0.1, 1e-3, rung::series_2);
  CHECK(by(fast, "series"));
  CHECK_FALSE(warns(fast, "slow-spin"));
  CHECK(by(slow, "full"));
  CHECK(warns(slow, "slow-spin"));
  CHECK_FALSE(second.met);
  CHECK(second.error > 0.1);
}

TEST_CASE("failure map: below the end of the fast family a budget ends the walk", "[heavy][.long]") {
  const auto p = unit_body(0.55, 0.8, towards);
  const Refusal refusal = refusal_of(periodic(p, 0.05, 0.1, 1));
  CHECK(refusal.code == Errc::step_limit);
  CHECK(std::strstr(refusal.why, "budget of 50 thousand steps"));
  CHECK(std::strstr(refusal.why, "sqrt(M g l/C)"));
  CHECK(heavy::detail::walk_budget == 50'000);
}

TEST_CASE("failure map: below the end of the fast family", "[heavy]") {
  // the flat pendulum: to r0 = 2 c exactly
  const auto flat = unit_body(0.55, 0.8, {1, 0, 0});
  const Answer turning = periodic_of(flat, 2.01, 0);
  CHECK(by(turning, "exact"));
  CHECK(value_of(turning, "period") > 4.5);
  CHECK(refusal_of(periodic(flat, 1.99, 0, 1)).code == Errc::no_convergence);
}

TEST_CASE("failure map: moments 1 and 3, or 2 and 3, nearly equal", "[heavy]") {
  for (const double off : {0.05, 0.01}) {
    CAPTURE(off);
    const Answer b = periodic_of(unit_body(0.7, 1 - off, towards), 20, 0.5),
                 a = periodic_of(unit_body(1 - off, 0.7, towards), 20, 0.5);
    const bool near = 1 / 400.0 * 0.48 > 0.1 * off;
    CHECK(warns(b, "near-equal-moments-2") == near);
    CHECK(warns(a, "near-equal-moments-1") == (1 / 400.0 * 0.6 > 0.1 * off));
  }
  Refusal none;
  CHECK(by(heavy::solve(periodic(unit_body(0.7, 0.999, towards), 20, 0.5, 3), none), "full"));
  const Refusal equal = refusal_of(periodic(unit_body(1, 0.7, towards), 20, 0.5, 1));
  CHECK(equal.code == Errc::not_applicable);
  CHECK(std::strstr(equal.why, "equal"));
}

TEST_CASE("failure map: nearly equal moments that the weight does not drive", "[heavy]") {
  // y' = 0: 1 - b divides nothing
  const Vec3<double> across{0.6, 0, 0.8};
  const Answer none = periodic_of(unit_body(0.7, 0.999, across), 20, 0.5, 1e-4);
  CHECK(by(none, "series"));
  CHECK_FALSE(warns(none, "near-equal-moments-2"));
  CHECK(by(periodic_of(unit_body(0.7, 1, across), 20, 0.5, 1e-4), "series"));
  // axis 3 level at the start: milder, and the motion is stable
  for (const double off : {1e-3, 1e-5}) {
    const Answer level = periodic_of(unit_body(0.58, 1 - off, towards, 0.3), 20, 0);
    CHECK(level.met);
    const double stable = value_of(level, "stable");
    CHECK((stable == 1 || std::isnan(stable)));
  }
}

TEST_CASE("failure map: nearly a lamina", "[heavy]") {
  for (const double flatness : {0.1, 0.02}) {
    const Answer answer = periodic_of(unit_body(0.55, 0.45 + flatness, towards), 20);
    CHECK(warns(answer, "near-lamina") == (1 / 400.0 > 0.1 * flatness));
  }
  // to its plane nothing divides, at first; later orders do
  const auto near = unit_body(0.55, 0.455, {0.6, 0.8, 0});
  CHECK(periodic_of(near, 50, 0.1, 1e-4).met);
}

TEST_CASE("failure map: a lamina", "[heavy][.long]") {
  // in it the nutation keeps step with the spin: held by its own amplitude alone, of the order c eps^(1/3)
  const Answer lamina = honest(periodic(unit_body(0.55, 0.45, {0.6, 0.8, 0}), 20, 0.1, 1));
  CHECK(lamina.model == std::string_view("full"));
  CHECK(lamina.met);
}

TEST_CASE("failure map: nutation at a half and a third of the spin", "[heavy]") {
  // omega^2 = (a - 1)(b - 1)/(a b)
  const auto with = [](double omega) {
    const double a = 0.7, q = 1 - a;
    return unit_body(a, q / (q + omega * omega * a), towards);
  };
  const Answer half = periodic_of(with(0.5), 20), third = periodic_of(with(1 / 3.0), 20),
               beside = periodic_of(with(0.53), 20);
  CHECK(half.error < 1e-6);
  CHECK(third.error < 1e-6);
  CHECK(beside.error < 1e-6);
  CHECK(warns(half, "resonance"));
  CHECK_FALSE(warns(third, "resonance"));
  CHECK_FALSE(warns(beside, "resonance"));
  // nu = 1/2
  const auto tuned = [&](double spin) {
    double omega = 0.5;
    for (int i = 0; i < 20; ++i) {
      const Floquet<double> floquet(*Scaled<double>::make(with(omega), spin, 0.1));
      omega = std::sqrt(omega * omega + 0.25 - floquet.squared);
    }
    return with(omega);
  };
  // the tongue narrows as eps^2, what the series know of nu as eps^4: of a fast spin they decide
  const Answer inside = periodic_of(tuned(100), 100);
  CHECK_FALSE(by(inside, "full"));
  CHECK(value_of(inside, "stable") == 0);
  CHECK(std::isnan(value_of(periodic_of(tuned(10), 10), "stable")));
  const Answer full = periodic_of(tuned(10), 10, 0.1, 1e-6, rung::full);
  CHECK(value_of(full, "stable") == 0);
  CHECK(value_of(full, "floquet_trace") < -2);
  CHECK(warns(full, "unstable"));
}

TEST_CASE("failure map: any inclination", "[heavy]") {
  for (const double cosine : {-0.95, -0.5, 0.5, 0.98}) periodic_of(unit_body(0.55, 0.8, towards), 50, cosine);
  // where axis 3 comes near the vertical its precession is lost, the state is not
  const Answer upright = periodic_of(unit_body(0.55, 0.8, towards), 20, 0.9999);
  CHECK(warns(upright, "upright"));
  CHECK(upright.met);
}

TEST_CASE("failure map: no shift of the period", "[heavy]") {
  // Om2 = 0 where M3 x' = z' G0
  const Answer answer = periodic_of(unit_body(0.55, 0.8, {0.6, 0.48, 0.64}), 20, 0.6 / std::hypot(0.6, 0.64), 1e-9);
  CHECK(answer.met);
  CHECK(value_of(answer, "period") == Approx(2 * pi<double> / 20).epsilon(1e-4));
}

TEST_CASE("failure map: a strong gradient", "[heavy]") {
  for (const double k : {10.0, 100.0}) {
    const Answer answer = periodic_of(unit_body(0.55, 0.8, towards, k), 20);
    CHECK(warns(answer, "strong-gradient") == (k > 40));
    CHECK(warns(answer, "gradient") == (3e6 / k < 100 * std::sqrt(2.35 / 2)));
  }
  // gravity and gradient of a laboratory belong together; these do not
  const auto odd = Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 30);
  CHECK(warns(periodic_of(*odd, 150), "gradient"));
  const auto earth = Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 4.6e-6);
  CHECK(periodic_of(*earth, 150).warnings.empty());
  // no weight: no c
  const auto centred = Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0, 0, 0}, 9.80665, 4.6e-6);
  CHECK(periodic_of(*centred, 0.1).met);
}

TEST_CASE("failure map: two equal moments across the spin", "[heavy]") {
  CHECK(by(periodic_of(unit_body(0.8, 0.8, towards), 50), "series"));
  CHECK(by(periodic_of(unit_body(0.8, 0.8, {0, 0, 1}), 50), "exact"));
}

TEST_CASE("failure map: spin about the axis of the intermediate moment", "[heavy]") {
  const Answer answer = periodic_of(unit_body(0.7, 1.3, towards), 50, 0.1, 1e-6);
  CHECK(by(answer, "series"));
  CHECK(value_of(answer, "stable") == 0);
  CHECK(value_of(answer, "floquet_trace") > 2);
  CHECK(warns(answer, "unstable"));
}

TEST_CASE("failure map: many revolutions", "[heavy]") {
  const auto p = unit_body(0.55, 0.8, towards);
  double last = 0;
  for (const double turns : {1.0, 30.0, 1000.0}) {
    const Answer second = honest(periodic(p, 20, 0.1, turns, 1e-6, rung::series_2));
    CHECK(second.error > 2 * last);
    last = second.error;
  }
  const Answer higher = honest(periodic(p, 20, 0.1, 1000, 1e-6));
  CHECK(by(higher, "series"));
  CHECK(higher.met);
  CHECK(honest(periodic(p, 20, 0.1, 1000, 1e-8, rung::full)).met);
}

TEST_CASE("failure map: a start without the rates of the periodic motion", "[heavy]") {
  const auto p = unit_body(0.55, 0.8, towards);
  State<double> start;
  start.angular_velocity = {0, 0, 100};
  start.down = {std::sqrt(0.99), 0, 0.1};
  Question question;
  question.tolerance = 2e-2;
  const Answer nutating = honest(posed(p, start, 0.3, question));
  CHECK(by(nutating, "series-2"));
  question.tolerance = 1e-6;
  const Answer full = honest(posed(p, start, 0.3, question));
  CHECK(by(full, "full"));
  question.rung = rung::series;
  const Answer series = honest(posed(p, start, 0.3, question));
  CHECK_FALSE(series.met);
  start.angular_velocity = {10, 0, 100};
  CHECK(refusal_of(posed(p, start, 0.3, question)).code == Errc::not_applicable);
}

TEST_CASE("failure map: a periodic motion next to a homoclinic one", "[heavy]") {
  const auto p = *Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 4.6e-6);
  Refusal refusal;
  const Answer answer = heavy::solve(periodic(p, 4, 0.1, 3), refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK(value_of(answer, "floquet_trace") > 1e3);
  CHECK(warns(answer, "unstable"));
  CHECK(answer.met);
  // a trace beyond 1e4, where one shot has lost its digits
  const Answer steep = heavy::solve(periodic(unit_body(0.55, 0.8, towards, 0.7), 0.589, 0.1, 3), refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK(value_of(steep, "floquet_trace") > 1e4);
  CHECK(steep.met);
}

TEST_CASE("failure map: upright and slow, chaos", "[heavy]") {
  const auto top = *Problem<double>::make({0.0016, 0.0016, 0.002}, 0.8, {0, 0, 0.01}, 9.80665, 0);
  State<double> start;
  start.down = {1e-6, 0, -std::sqrt(1 - 1e-12)};
  Question question;
  // C r = 2 sqrt(A M g l)
  const double threshold = 2 * std::sqrt(0.0016 * 0.8 * 9.80665 * 0.01) / 0.002;
  for (const double ratio : {0.9, 1.1}) {
    start.angular_velocity = {0, 0, ratio * threshold};
    const Answer answer = honest(posed(top, start, 1, question));
    CHECK(warns(answer, "unstable-sleep") == (ratio < 1));
  }
  const auto p = *Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 0);
  start.down = {-0.666, -0.499, -std::sqrt(1 - 0.666 * 0.666 - 0.499 * 0.499)};
  start.angular_velocity = {3, 2, 8};
  const Answer near = honest(posed(p, start, 2, question)), later = honest(posed(p, start, 30, question));
  CHECK(later.error > 0);
  CHECK(near.met);
}
