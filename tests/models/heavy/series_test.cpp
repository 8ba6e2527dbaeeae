// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/series.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "allocations.hpp"
#include "bodies.hpp"
#include "catch.hpp"
#include "direct_motion.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using LongSeries = Series<long double>;

/// The largest errors over n times of one span, the last of them at its end.
template <Real Scalar>
MotionError<double> errors(const Series<Scalar>& series, const LongSeries& truth, double from, double to, int n = 41) {
  MotionError<double> worst;
  for (int i = 0; i < n; ++i) {
    const double t = from + (to - from) * i / (n - 1);
    const auto a = series.at(Scalar(t));
    const auto b = truth.at(t);
    const auto gap = [](const auto& x, const auto& y) {
      return (x.template cast<double>() - y.template cast<double>()).norm();
    };
    worst.angular_velocity = std::max(worst.angular_velocity, gap(a.angular_velocity, b.angular_velocity));
    worst.down = std::max(worst.down, gap(a.down, b.down));
    worst.attitude = std::max(worst.attitude, attitude_gap(a.attitude, b.attitude));
  }
  return worst;
}

Series<double> series(const Problem<double>& problem, double spin, double G0, int order) {
  const auto made = Series<double>::make(problem, spin, G0, order);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("series: periodic motions closed by shooting", "[heavy]") {
  std::vector<ReferenceRow> motions = reference_rows("motion");
  for (const auto& row : reference_rows("periodic")) {
    INFO(row.id);
    if (row.id == "pub04") continue;
    const auto s = series(row.problem(), row.number[9], row.number[10], 24);
    CHECK(s.period() == Approx(row.number[13]).epsilon(1e-13));
    const auto start = s.at(0);
    CHECK(start.angular_velocity[0] == Approx(row.number[11]).epsilon(1e-11));
    CHECK(start.angular_velocity[1] == Approx(row.number[12]).epsilon(1e-11).margin(1e-13));
    CHECK(std::abs(start.angular_velocity[2] / row.number[9] - 1) < 1e-15);
    for (const auto& at : motions) {
      if (at.id != row.id) continue;
      const double t = at.number[15];
      const auto state = s.at(t);
      const Vec3<double> w(at.number[16], at.number[17], at.number[18]), d(at.number[19], at.number[20], at.number[21]);
      CHECK((state.angular_velocity - w).norm() < 2e-13 * w.norm());
      CHECK((state.down - d).norm() < 1e-12);
      CHECK((state.angular_velocity - w).norm() <= s.error(t).angular_velocity + 1e-14 * w.norm());
      CHECK((state.down - d).norm() <= s.error(t).down);
    }
  }
}

TEST_CASE("series: at r0 = 2.5 c its own estimate holds", "[heavy]") {
  for (const auto& row : reference_rows("periodic")) {
    if (row.id != "pub04") continue;
    for (int order : {4, 8, 16, 26}) {
      const auto s = series(row.problem(), row.number[9], row.number[10], order);
      const double period = std::abs(s.period() / row.number[13] - 1);
      CHECK(period < s.period_error());
      CHECK(period > s.period_error() / 50);
      const auto start = s.at(0).angular_velocity;
      CHECK(std::hypot(start[0] - row.number[11], start[1] - row.number[12]) < s.error(0).angular_velocity);
    }
  }
}

TEST_CASE("series: the attitude, and all else, against the equations of motion", "[heavy]") {
  std::mt19937 random(5);
  for (int body = 0; body < 6; ++body) {
    const Draw d = draw(random, 0.15);
    const auto problem = d.body();
    for (double spin : {25.0, -25.0}) {
      const auto s = series(problem, spin, d.G0, 20);
      const auto start = s.at(0);
      for (double t : {0.1, 1.0}) {
        const auto want = direct_motion(problem, start, t), have = s.at(t);
        CHECK((have.angular_velocity - want.angular_velocity).norm() < 2e-12 * std::abs(spin));
        CHECK((have.down - want.down).norm() < 1e-11);
        CHECK(attitude_gap(have.attitude, want.attitude) < 1e-11);
        CHECK((to_matrix(have.attitude).row(2).transpose() + have.down).norm() < 1e-14);
      }
    }
  }
}

TEST_CASE("series: what each order reaches at r0 = 5 c", "[heavy]") {
  // largest errors of p/c, q/c, r/r0 and down over a period; the flat pendulum has the greatest of these bodies, and the one with its
  // centre on axis 3 the least
  struct Row {
    double a, b, k;
    Vec3<double> at;
  };
  const Row flat{0.55, 0.8, 0, {1, 0, 0}}, axial{0.55, 0.8, 0, {0, 0, 1}};
  const Row generic{0.55, 0.8, 0.7, {0.6, 0.48, 0.64}}, least_axis{1.6, 1.3, 0.5, {0.36, -0.48, 0.8}};
  const auto reached = [](const Row& row, int order) {
    const auto truth =
        LongSeries::make(unit_body<long double>(static_cast<long double>(row.a), static_cast<long double>(row.b),
                                                row.at.cast<long double>(), static_cast<long double>(row.k)),
                         5, 0.1L, 30);
    REQUIRE(truth);
    const auto s = series(unit_body(row.a, row.b, row.at, row.k), 5, 0.1, order);
    const auto error = errors(s, *truth, 0, s.period());
    return std::max(error.angular_velocity, error.down);
  };
  for (const auto& [order, most] : {std::pair{4, 1.8e-3}, {8, 7e-5}, {16, 1e-7}, {24, 1.3e-10}}) {
    INFO(order);
    CHECK(reached(flat, order) < 2 * most);
    CHECK(reached(flat, order) > most / 2);
    CHECK(reached(generic, order) < most);
    CHECK(reached(least_axis, order) < most);
  }
  for (const auto& [order, least] : {std::pair{4, 6e-5}, {8, 3e-8}, {16, 9e-14}}) {
    INFO(order);
    CHECK(reached(axial, order) < 2 * least);
    CHECK(reached(axial, order) > least / 2);
    CHECK(reached(generic, order) > least);
    CHECK(reached(least_axis, order) > least);
  }
  CHECK(reached(axial, 24) < 1e-14);
}

TEST_CASE("series: the error falls with the order in eps", "[heavy]") {
  std::mt19937 random(3);
  for (int body = 0; body < 5; ++body) {
    const Draw d = draw(random, 0.2);
    for (int order : {2, 4, 6}) {
      MotionError<double> last;
      for (double eps : {0.04, 0.02}) {
        const auto truth = LongSeries::make(d.body<long double>(), 1 / eps, d.G0, 24);
        const auto s = Series<long double>::make(d.body<long double>(), 1 / eps, d.G0, order);
        REQUIRE(truth);
        REQUIRE(s);
        MotionError<double> now = errors(*s, *truth, 0, 2 * pi<double> * eps);
        now.angular_velocity *= eps;
        if (eps == 0.02) {
          CHECK(std::log2(last.angular_velocity / now.angular_velocity) == Approx(order + 2).margin(0.15));
          CHECK(std::log2(last.down / now.down) == Approx(order + 2).margin(0.15));
          CHECK(std::log2(last.attitude / now.attitude) == Approx(order + 2).margin(0.15));
        }
        last = now;
      }
    }
  }
}

TEST_CASE("series: estimates are never too small, and not idle", "[heavy]") {
  std::mt19937 random(11);
  int counted = 0, idle = 0;
  for (int body = 0; body < 150; ++body) {
    const Draw d = draw(random, 0.05);
    const double spin = std::array{50.0, 10.0, 5.0, 3.0}[static_cast<std::size_t>(body % 4)];
    const auto truth = LongSeries::make(d.body<long double>(), spin, d.G0, 30);
    if (!truth) continue;
    for (double turns : {1.0, 300.0}) {
      const double to = 2 * pi<double> / spin * turns;
      for (int order : {0, 2, 6, 14}) {
        const auto made = order == 0 ? Series<double>::to_tolerance(d.body(), spin, d.G0, 1e-8, to)
                                     : Series<double>::make(d.body(), spin, d.G0, order);
        REQUIRE(made);
        const auto error = errors(*made, *truth, to * (turns - 1) / turns, to);
        const auto said = made->error(to),
                   doubtful = MotionError<double>{double(truth->error(to).angular_velocity),
                                                  double(truth->error(to).down), double(truth->error(to).attitude)};
        const auto check = [&](double real, double estimate, double truth_error) {
          INFO(order << " " << turns << " " << spin);
          if (truth_error > 0.1 * real) return;
          CHECK(real <= estimate);
          ++counted;
          idle += estimate > 100 * real && estimate > 1e-12;
        };
        check(error.angular_velocity, said.angular_velocity, doubtful.angular_velocity);
        check(error.down, said.down, doubtful.down);
        check(error.attitude, said.attitude, doubtful.attitude);
      }
    }
  }
  CHECK(counted > 1000);
  CHECK(idle < counted / 20);
}

TEST_CASE("series: to a tolerance, the least order that meets it", "[heavy]") {
  const auto body = unit_body(0.55, 0.8, {0.6, 0.48, 0.64}, 0.3);
  int last = 0;
  for (double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const auto s = Series<double>::to_tolerance(body, 20, 0.1, tolerance, 1.0);
    REQUIRE(s);
    CHECK(s->error(1.0).relative(20) <= tolerance);
    CHECK(s->order() >= last);
    last = s->order();
  }
  const auto best = Series<double>::to_tolerance(body, 20, 0.1, 0, 1.0);
  REQUIRE(best);
  CHECK(best->error(1.0).relative(20) < 5e-13);
}

TEST_CASE("series: the limits of its domain", "[heavy]") {
  const Vec3<double> at{0.6, 0.48, 0.64};
  const auto made = [](double a, double b, Vec3<double> direction, double k, double spin, double G0, int order = 12) {
    return Series<double>::make(unit_body(a, b, direction, k), spin, G0, order);
  };
  // too slow, or too near a divisor: refused
  CHECK(made(0.55, 0.8, at, 0.7, 0.9, 0.1).error() == Errc::no_convergence);
  CHECK(made(0.9999, 0.8, at, 0.7, 20, 0.4).error() == Errc::no_convergence);
  CHECK(made(0.8, 0.9999, at, 0.7, 20, 0.4).error() == Errc::no_convergence);
  CHECK(made(1, 0.8, at, 0.7, 20, 0.4).error() == Errc::not_applicable);
  CHECK(made(0.6, 0.4001, at, 0.7, 20, 0.1).error() == Errc::no_convergence);
  CHECK(made(0.55, 0.8, at, 5000, 20, 0.1).error() == Errc::no_convergence);
  CHECK(made(0.55, 0.8, at, 0.7, 20, 1.0).error() == Errc::out_of_domain);
  CHECK(made(0.55, 0.8, at, 0.7, 0.0, 0.1).error() == Errc::out_of_domain);
  CHECK(made(0.55, 0.8, at, 0.7, 20, 0.1, 3).error() == Errc::out_of_domain);
  CHECK(made(0.55, 0.8, at, 0.7, 20, 0.1, 0).error() == Errc::out_of_domain);
  CHECK(made(0.55, 0.8, at, 0.7, 20, 0.1, Series<double>::highest_order + 2).error() == Errc::out_of_domain);
  CHECK(made(0.55, 0.8, at, 0.7, gyrostat::nan<double>, 0.1).error() == Errc::not_finite);
  CHECK(made(0.55, 0.8, at, 0.7, 20, gyrostat::infinity<double>).error() == Errc::not_finite);

  // near a limit, but answered: right within the estimate
  const auto answered = [&](double a, double b, Vec3<double> direction, double k, double spin, double G0) {
    const auto problem = unit_body(a, b, direction, k);
    const double unstable = std::sqrt(std::fmax(0, -(1 - a) * (1 - b) / (a * b)));
    const auto s = Series<double>::to_tolerance(problem, spin, G0, 1e-10, 1.0);
    REQUIRE(s);
    const auto want = direct_motion(problem, s->at(0), 1.0), have = s->at(1.0);
    const auto said = s->error(1.0);
    INFO(said.down << " " << s->order());
    // a motion started from the series leaves the periodic one by a free nutation, which grows where axis 3 is the intermediate one
    const double grown = 4 * std::exp(unstable * spin);
    CHECK((have.angular_velocity - want.angular_velocity).norm() <= grown * said.angular_velocity + 1e-11 * spin);
    CHECK((have.down - want.down).norm() <= grown * said.down + 1e-11);
    CHECK(attitude_gap(have.attitude, want.attitude) <= grown * said.attitude + 1e-11);
    return std::max(said.angular_velocity / spin, said.down);
  };
  CHECK(answered(0.95, 0.8, at, 0.7, 20, 0.4) < 1e-6);
  CHECK(answered(0.8, 0.95, at, 0.7, 20, 0.4) < 1e-6);
  CHECK(answered(0.6, 0.45, at, 0.7, 20, 0.1) < 1e-6);
  CHECK(answered(0.7, 0.7, at, 0.7, 20, 0.1) < 1e-9);             // A = B
  CHECK(answered(0.7, 1.3, at, 0.7, 20, 0.1) < 1e-9);             // axis 3 intermediate
  CHECK(answered(0.7, 1.0, {0.6, 0, 0.8}, 0.7, 20, 0.4) < 1e-9);  // B = C without y'
  CHECK(answered(0.55, 0.8, {0, 0, 0}, 0.7, 20, 0.1) < 1e-9);     // no weight
  CHECK(answered(0.55, 0.8, at, 50, 20, 0.1) < 1e-3);             // N = r0^2/8
  CHECK(answered(0.55, 0.8, at, 0.7, 20, 0.98) < 1e-6);
  CHECK(answered(0.55, 0.8, at, 0.7, 20, -0.98) < 1e-6);
  CHECK(answered(0.55, 0.8, at, 0.7, 20, 0.999999) < 1e-6);  // psi has no meaning, all else has
}

TEST_CASE("series: grids as single times, without memory", "[heavy]") {
  const auto s = series(unit_body(0.55, 0.8, {0.6, 0.48, 0.64}, 0.3), 10, 0.1, 16);
  std::vector<double> times;
  for (int i = 0; i < 71; ++i) times.push_back(-3 + 0.17 * i);
  std::vector<State<double>> states(times.size());
  const auto before = allocations();
  s.at(std::span<const double>(times), std::span<State<double>>(states));
  const auto once = Series<double>::make(unit_body(0.55, 0.8, {0.6, 0.48, 0.64}, 0.3), 10, 0.1, 16);
  CHECK(allocations() == before);
  REQUIRE(once);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto one = s.at(times[i]);
    CHECK((states[i].angular_velocity - one.angular_velocity).norm() < 1e-14 * 10);
    CHECK((states[i].down - one.down).norm() < 1e-15);
    CHECK(attitude_gap(states[i].attitude, one.attitude) < 1e-14);
  }
}

TEMPLATE_TEST_CASE("series: float and long double", "[heavy]", float, long double) {
  const auto truth = LongSeries::make(
      unit_body<long double>(0.55L, 0.8L, Vec3<double>(0.6, 0.48, 0.64).cast<long double>(), 0.3L), 20, 0.1L, 24);
  const auto s =
      Series<TestType>::make(unit_body<TestType>(TestType(0.55L), TestType(0.8L),
                                                 Vec3<double>(0.6, 0.48, 0.64).cast<TestType>(), TestType(0.3L)),
                             20, TestType(0.1L), 20);
  REQUIRE(truth);
  REQUIRE(s);
  const auto error = errors(*s, *truth, 0, 0.3);
  const double tiny = std::is_same_v<TestType, float> ? 1e-5 : 1e-15;
  CHECK(error.angular_velocity < 20 * tiny);
  CHECK(error.attitude < tiny);
}

TEST_CASE("series: none where the torque outweighs how far a body is from a lamina", "[heavy]") {
  // terms fell to 1e-14, and rates erred by 1e-9
  const auto near = Problem<double>::make({0.4908928128695973, 0.5091255754993145, 1}, 1.1315653232578624,
                                          {0.14743271577630784, 0.09377510403629412, 0}, 9.80665, 0);
  REQUIRE(near);
  CHECK(Series<double>::to_tolerance(*near, -115.43, -0.0344, 1e-6, 45).error() == Errc::no_convergence);
  CHECK(Series<double>::make(*near, -115.43, -0.0344, 8).error() == Errc::no_convergence);
  CHECK(Series<double>::to_tolerance(*near, -1154.3, -0.0344, 1e-6, 45));
}
