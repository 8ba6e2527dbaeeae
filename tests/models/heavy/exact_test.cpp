// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/exact.hpp"

#include <cstring>

#include "catch.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;

Problem<double> body(const V& inertia, const V& centre, double gravity, double gradient) {
  const auto made = Problem<double>::make(inertia, 0.5, centre, gravity, gradient);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("exact: which case", "[heavy]") {
  const V top(0.002, 0.002, 0.001), uneven(0.0011, 0.0016, 0.002);
  const auto start = start_at({1, 2, 3}, {0.5, 0.1, -0.7, 0.3});
  const auto which = [&](const Problem<double>& p, const State<double>& s) { return Exact<double>(p, s).which(); };
  CHECK(which(body(uneven, {0, 0, 0}, 9.8, 0), start) == ExactCase::euler);
  CHECK(which(body(uneven, {0, 0, 0.01}, 0, 0), start) == ExactCase::euler);
  CHECK(which(body(top, {0, 0, 0.03}, 9.8, 0), start) == ExactCase::lagrange);
  CHECK(which(body(top, {0, 0, 0.03}, 9.8, 30), start) == ExactCase::lagrange);
  CHECK(which(body(top, {0, 0, 0}, 9.8, 30), start) == ExactCase::lagrange);
  CHECK(which(body({0.002, 0.002, 0.002}, {0.01, 0.02, -0.01}, 9.8, 30), start) == ExactCase::lagrange);
  CHECK(which(body(top, {0.01, 0, 0.03}, 9.8, 0), start) == ExactCase::none);
  CHECK(which(body(uneven, {0, 0, 0}, 9.8, 30), start) == ExactCase::none);
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 0), start) == ExactCase::none);
  State<double> flat{{0, 0, 4}, {0.6, 0.8, 0}, {}};
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 0), flat) == ExactCase::pendulum);
  CHECK(which(body(uneven, {0, 0, 0}, 9.8, 30), flat) == ExactCase::pendulum);
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 30), flat) == ExactCase::none);
  flat.down[1] = gyrostat::nan<double>;
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 0), flat) == ExactCase::none);
  CHECK(std::strcmp(symbol(ExactCase::lagrange), "lagrange") == 0);
}

TEST_CASE("exact: every case against the full equations, and what repeats", "[heavy]") {
  const auto turned = start_at({1, 2, 30}, {0.5, 0.1, -0.7, 0.3});
  State<double> flat{{0, 0, 4}, {0.6, 0.8, 0}, {}};
  flat = *aligned(flat);
  flat.down = {0.6, 0.8, 0};
  const std::pair<Problem<double>, State<double>> scenes[] = {
      {body({0.0011, 0.0016, 0.002}, {0, 0, 0}, 9.8, 0), turned},
      {body({0.002, 0.002, 0.001}, {0, 0, 0.03}, 9.8, 0), turned},
      {body({0.002, 0.001, 0.002}, {0, 0.03, 0}, 9.8, 30), turned},
      {body({0.002, 0.002, 0.002}, {0.01, 0.02, -0.01}, 9.8, 0), turned},
      {body({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 9.8, 0), flat}};
  for (const auto& [problem, start] : scenes) {
    const Exact<double> exact(problem, start);
    REQUIRE(exact.applies());
    const std::vector<double> times{0.0, 0.1, 0.4};
    const auto truth = LongMotion::from(problem, start, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto d = distance(exact.at(times[i]), truth[i]);
      const auto bound = exact.error(times[i]);
      CAPTURE(symbol(exact.which()), times[i]);
      CHECK(d.attitude < 1e-12);
      CHECK(d.attitude <= bound.attitude);
      CHECK(d.down <= bound.down);
      CHECK(d.angular_velocity <= bound.angular_velocity);
    }
    const double T = exact.period();
    CHECK(exact.at(0.1 + T).angular_velocity.norm() == Approx(exact.at(0.1).angular_velocity.norm()).epsilon(1e-12));
  }
}

TEST_CASE("exact: none", "[heavy]") {
  const Exact<double> none(body({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 9.8, 0), start_at({1, 2, 3}, {1, 0, 0, 0}));
  CHECK_FALSE(none.applies());
  CHECK(std::isnan(none.at(1).down[0]));
  CHECK(std::isnan(none.at(1).attitude.w));
  CHECK(none.error(1).attitude == infinity<double>);
  CHECK(std::isnan(none.period()));
}
