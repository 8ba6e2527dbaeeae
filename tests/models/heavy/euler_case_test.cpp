// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/euler_case.hpp"

#include <random>

#include "allocations.hpp"
#include "catch.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;

Problem<double> free_body(const V& inertia, double gravity = 9.8) {
  const auto made = Problem<double>::make(inertia, 1, V::Zero(), gravity, 0);
  REQUIRE(made);
  return *made;
}

EulerCase<double> euler(const Problem<double>& problem, const State<double>& start) {
  const auto made = EulerCase<double>::make(problem, start);
  REQUIRE(made);
  return *made;
}

void compare(const Problem<double>& problem, const State<double>& start, double end = 8) {
  const auto exact = euler(problem, start);
  const std::vector<double> times{0.0, 0.1, 0.7, 1.9, 3.1, 4.7, end};
  const auto truth = LongMotion::from(problem, start, times);
  const auto bound = exact.error(end);
  CAPTURE(problem.inertia().transpose(), start.angular_velocity.transpose(), exact.modulus().kp2);
  CHECK(bound.attitude < 1e-9);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto d = distance(exact.at(times[i]), truth[i]);
    CHECK(d.attitude <= std::min(bound.attitude, 1e-13 * (1 + 10 * times[i])));
    CHECK(d.down <= bound.down);
    CHECK(d.angular_velocity <= bound.angular_velocity);
  }
}

}  // namespace

TEST_CASE("euler case: angular velocity and attitude from any start, moments in any order", "[heavy]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const V moments(1, 1.4, 2);
  constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int n = 0; n < 36; ++n) {
    const V I(moments[order[n % 6][0]], moments[order[n % 6][1]], moments[order[n % 6][2]]);
    compare(free_body(I), start_at({unit(random), unit(random), unit(random)},
                                   {unit(random), unit(random), unit(random), unit(random)}));
  }
}

TEST_CASE("euler case: the bound is never too small, and some tens of times the error", "[heavy]") {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> ratio;
  for (int n = 0; n < 60; ++n) {
    const double e = n % 3 ? 1 : std::pow(10, -12 * unit(random));  // of a difference of two moments, and off an axis
    const V I(1, 1 + 0.4 * e, 1.5 + 0.3 * unit(random));
    const auto start = start_at({normal(random), normal(random), (n % 2 ? e : 1) * normal(random)},
                                {normal(random), normal(random), normal(random), normal(random)});
    const auto body = free_body(I * std::pow(10, 12 * unit(random) - 6));
    const auto exact = euler(body, start);
    const std::vector<double> times{0.3, 4, 30};
    const auto truth = LongMotion::from(body, start, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      CAPTURE(n, times[i], exact.modulus().kp2);
      const auto d = distance(exact.at(times[i]), truth[i]);
      const auto bound = exact.error(times[i]);
      CHECK(d.attitude <= bound.attitude);
      CHECK(d.down <= bound.down);
      CHECK(d.angular_velocity <= bound.angular_velocity);
      if (d.attitude > 0) ratio.push_back(bound.attitude / d.attitude);
    }
  }
  std::sort(ratio.begin(), ratio.end());
  CHECK(ratio[ratio.size() / 2] < 100);
}

TEST_CASE("euler case: limits", "[heavy]") {
  const Quat<double> q = normalised(Quat<double>{0.4, -0.3, 0.7, 0.2});
  const double c = std::cos(0.4), s = std::sin(0.4);
  for (const V& I : {V(1, 1, 1.5), V(1, 1.5, 1), V(1.5, 1, 1), V(1, 1, 0.6), V(1, 0.6, 1), V(1.2, 1.2, 1.2),
                     V(1, 1.4, 2), V(1, 1 + 1e-12, 1.4), V(1, 1 + 4e-16, 0.8), V(1, 1 + 1e-12, 1 + 2e-12)})
    for (const V& w : {V(0, 0, 1), V(0, -1, 0), V(1, 0, 0), V(0, c, s), V(c, 0, s), V(c, -s, 0), V(1e-9, 1e-10, 1),
                       V(1, -1e-9, 1e-10), V(0, 0, 0), V(1e-9, 1, -1e-9)}) {
      if (I[0] < I[1] && I[1] < I[2] && w[1] == 1 && w[0] != 0) continue;  // next to the saddle: below
      compare(free_body(I), start_at(w, q), I == V(1, 1.4, 2) && w[1] * w[1] == 1 ? 4.8 : 8);
    }
}

TEST_CASE("euler case: on and next to the separatrix the bound grows as the motion does", "[heavy]") {
  const V I(1, 1.4, 2);
  const Quat<double> q = normalised(Quat<double>{0.4, -0.3, 0.7, 0.2});
  // L_1^2 (a1 - a2) = L_3^2 (a2 - a3)
  const double ratio = std::sqrt((1 - 1 / 1.4) / (1 / 1.4 - 0.5));
  for (const double off : {0.0, 1e-15, 1e-12, 1e-6, -1e-14, -1e-9})
    for (const double mid : {0.3, -1.0, 0.0}) {
      const auto start = start_at({0.7, mid / 1.4, 0.7 * ratio / 2 * (1 + off)}, q);
      const auto body = free_body(I);
      const auto exact = euler(body, start);
      const std::vector<double> times{1, 5, 20, 60, 150};
      const auto truth = LongMotion::from(body, start, times);
      for (std::size_t i = 0; i < times.size(); ++i) {
        CAPTURE(off, mid, times[i], exact.modulus().kp2);
        const auto d = distance(exact.at(times[i]), truth[i]);
        const auto bound = exact.error(times[i]);
        CHECK(d.attitude <= bound.attitude);
        CHECK(d.angular_velocity <= bound.angular_velocity);
        if (std::abs(off) >= 1e-6) CHECK(bound.attitude < 1e-6);
        if (times[i] <= 5) CHECK(bound.attitude < 1e-9);
      }
    }
}

TEST_CASE("euler case: the angular velocity repeats itself after the period", "[heavy]") {
  for (const V& w : {V(1, 0.2, 0.1), V(0.1, -0.2, 1), V(-0.6, 1, 0.5)}) {
    const auto exact = euler(free_body({1, 2, 1.4}), start_at(w, {1, 0, 0, 0}));
    const double T = exact.period();
    CHECK((exact.at(T).angular_velocity - w).norm() <= 1e-14 * w.norm());
    CHECK((exact.at(T / 2).angular_velocity - w).norm() > 0.1 * w.norm());
    CHECK((exact.at(1000 * T).angular_velocity - w).norm() <= 1e-11 * w.norm());
    CHECK((exact.at(-0.3 * T).angular_velocity - exact.at(0.7 * T).angular_velocity).norm() <= 1e-14 * w.norm());
  }
}

TEST_CASE("euler case: what is refused, what it costs", "[heavy]") {
  const auto body = free_body({1, 1.4, 2});
  const State<double> start = start_at({1, 2, 3}, {1, 0, 0, 0});
  State<double> broken = start;
  broken.down[1] = gyrostat::nan<double>;
  CHECK(EulerCase<double>::make(body, broken).error() == Errc::not_finite);
  broken.down.setZero();
  CHECK(EulerCase<double>::make(body, broken).error() == Errc::zero_vector);
  const auto heavy = Problem<double>::make({1, 1.4, 2}, 1, {0, 0, 0.1}, 9.8, 0);
  CHECK(EulerCase<double>::make(*heavy, start).error() == Errc::not_applicable);
  const auto pulled = Problem<double>::make({1, 1.4, 2}, 1, {0, 0, 0}, 9.8, 0.1);
  CHECK(EulerCase<double>::make(*pulled, start).error() == Errc::not_applicable);
  CHECK(EulerCase<double>::make(*Problem<double>::make({1, 1, 1}, 1, {0, 0, 0}, 9.8, 0.1), start));
  CHECK(EulerCase<double>::make(*Problem<double>::make({1, 1.4, 2}, 1, {0, 0, 0.1}, 0, 0), start));
  const auto exact = euler(body, start);
  const auto before = allocations();
  CHECK(exact.at(1.0).down.norm() == Approx(1));
  CHECK(exact.error(1.0).attitude < 1e-12);
  CHECK(allocations() == before);
}
