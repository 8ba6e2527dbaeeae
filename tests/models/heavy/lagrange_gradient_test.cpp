// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/lagrange_gradient.hpp"

#include <random>

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "long_motion.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;
using Q = Quat<double>;

Problem<double> gradient_body(double C, double z0, double N, int axis = 2) {
  V inertia = V::Constant(0.002), centre = V::Zero();
  inertia[axis] = C;
  centre[axis] = z0;
  const auto made = Problem<double>::make(inertia, 0.5, centre, 9.80665, N);
  REQUIRE(made);
  return *made;
}

LagrangeGradient<double> with_gradient(const Problem<double>& problem, const State<double>& start) {
  const auto made = LagrangeGradient<double>::make(problem, start);
  REQUIRE(made);
  return *made;
}

Q tilted(double tilt) {
  return Q{0.8, 0, 0, -0.6} * Q{std::cos(tilt / 2), std::sin(tilt / 2), 0, 0} * Q{0.96, 0, 0, 0.28};
}

const std::vector<double> some_times{0.0, 0.01, 0.033, 0.07, 0.13, 0.2, 0.31, 0.47};

}  // namespace

TEST_CASE("nearest root: the next on either side, not any", "[heavy]") {
  // (y + 3)(y + 1)(y - 2)(y - 5), positive at 0
  const std::array<double, 5> a{30, 19, -15, -3, 1};
  CHECK(heavy::detail::nearest_root<4>(a, 10.0) == Approx(2).epsilon(1e-15));
  CHECK(heavy::detail::nearest_root<4>(a, -10.0) == Approx(-1).epsilon(1e-15));
  CHECK(heavy::detail::nearest_root<4>(a, 1.5) == 1.5);
  CHECK(heavy::detail::nearest_root<4>({1e-30, 0, -1, 0, 0}, 1.0) == Approx(1e-15).epsilon(1e-14));
}

TEST_CASE("lagrange top in a gradient: the full equations from any start", "[heavy]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  int sound = 0;
  for (int n = 0; n < 40; ++n) {
    const int axis = n % 3;
    const auto body = gradient_body(0.0005 + 0.0025 * std::abs(unit(random)), 0.03 * unit(random),
                                    400 * std::abs(unit(random)), axis);
    V omega = 10 * V(unit(random), unit(random), unit(random));
    omega[axis] = (n % 2 ? 100 : 5) * unit(random);
    const auto start = start_at(omega, {unit(random), unit(random), unit(random), unit(random)});
    const auto exact = with_gradient(body, start);
    const auto truth = LongMotion::from(body, start, some_times);
    const auto bound = exact.error(some_times.back());
    CAPTURE(n, exact.truncation(), bound.attitude);
    sound += bound.attitude < 1e-9;
    for (std::size_t i = 0; i < some_times.size(); ++i) {
      const auto d = distance(exact.at(some_times[i]), truth[i]);
      CHECK(d.attitude < bound.attitude);
      CHECK(d.down < bound.down);
      CHECK(d.angular_velocity < bound.angular_velocity);
      if (bound.attitude < 1e-9) CHECK(d.attitude < 1e-12);
    }
  }
  CHECK(sound >= 36);
}

TEST_CASE("lagrange top in a gradient: upright starts, pushed or not, and passages of the vertical", "[heavy]") {
  for (const double N : {20.0, 300.0})
    for (const double z0 : {0.04, -0.04, 0.0})
      for (const auto& [omega, tilt] :
           {std::pair{V(0, 0, 150), 0.0}, std::pair{V(3, 1, 150), 0.0}, std::pair{V(8, 0, 0), 0.0},
            std::pair{V(3, 1, 150), 1e-9}, std::pair{V(0, 0, 150), 0.4}, std::pair{V(12, 0, 0), 0.5}}) {
        const auto body = gradient_body(0.001, z0, N);
        const auto start = start_at(omega, tilt == 0 ? Q{0.8, 0, 0, -0.6} : tilted(tilt));
        const auto exact = with_gradient(body, start);
        const auto truth = LongMotion::from(body, start, some_times);
        for (std::size_t i = 0; i < some_times.size(); ++i) {
          CAPTURE(N, z0, omega.transpose(), tilt, some_times[i]);
          const auto d = distance(exact.at(some_times[i]), truth[i]);
          const auto bound = exact.error(some_times[i]);
          CHECK(d.attitude < 1e-12);
          CHECK(d.attitude < bound.attitude);
          CHECK(d.angular_velocity <= bound.angular_velocity);
        }
      }
}

TEST_CASE("lagrange top in a gradient: without gradient it is Lagrange's", "[heavy]") {
  const auto body = gradient_body(0.001, 0.04, 0);
  for (const double tilt : {0.3, 1.5, 2.9}) {
    const auto start = start_at({1, 2, 120}, tilted(tilt));
    const auto series = with_gradient(body, start);
    const auto jacobi = LagrangeTop<double>::make(body, start);
    REQUIRE(jacobi);
    CHECK(series.nutation_period() == Approx(jacobi->nutation_period()).epsilon(1e-13));
    CHECK(series.mean_precession() == Approx(jacobi->mean_precession()).epsilon(1e-12));
    for (const double t : {0.0, 0.3, 2.0}) CHECK(distance(series.at(t), jacobi->at(t)).attitude < 1e-12);
  }
}

TEST_CASE("lagrange top in a gradient: the reference motion, its period and its precession", "[heavy]") {
  int seen = 0;
  for (const auto& row : reference_rows("motion")) {
    if (row.id != "pub09") continue;
    ++seen;
    const auto& x = row.number;
    const V d(x[12], x[13], x[14]);
    const auto exact = with_gradient(row.problem(), {V(x[9], x[10], x[11]), d, {}});
    const auto s = exact.at(x[15]);
    CHECK((s.angular_velocity - V(x[16], x[17], x[18])).norm() <= 1e-12 * 150);
    CHECK((s.down - V(x[19], x[20], x[21])).norm() <= 1e-12);
    CHECK(exact.nutation_period() == Approx(0.083562973467726523959).epsilon(1e-13));
    CHECK(exact.precession_per_nutation() == Approx(-0.025707499785273882949).epsilon(1e-12));
    CHECK(exact.least() == Approx(0.79049195944880255297).epsilon(1e-14));
    CHECK(exact.greatest() == Approx(0.82679985317744587624).epsilon(1e-14));
    CHECK(exact.truncation() < 1e-15);
  }
  CHECK(seen == 6);
}

TEST_CASE("lagrange top in a gradient: what is refused, what it costs", "[heavy]") {
  const auto start = start_at({1, 2, 150}, tilted(0.6));
  const auto uneven = Problem<double>::make({0.002, 0.0021, 0.001}, 0.5, {0, 0, 0.04}, 9.8, 3);
  CHECK(LagrangeGradient<double>::make(*uneven, start).error() == Errc::not_applicable);
  auto broken = start;
  broken.angular_velocity[1] = gyrostat::nan<double>;
  CHECK(LagrangeGradient<double>::make(gradient_body(0.001, 0.04, 3), broken).error() == Errc::not_finite);
  const auto before = allocations();
  const auto exact = with_gradient(gradient_body(0.001, 0.04, 3), start);
  CHECK(exact.at(1).down.norm() == Approx(1));
  CHECK(allocations() == before);
}
