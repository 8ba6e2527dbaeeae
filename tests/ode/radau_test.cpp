// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/radau.hpp"

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/honesty.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace gyrostat;
using ode::Status;

namespace {

/// What stands in the equations of all systems here that have one relaxing unknown and know no time.
template <class S>
struct Timeless {
  using Scalar = S;
  static constexpr int relaxing = 1;
  struct Moment {};
  static Moment moment(const Lanes<S>&) noexcept { return {}; }
};

/// y = (cos t, sin t) and p = phi = 0.3 y0 whatever the rate (Prothero and Robinson 1974); off phi, p comes back as
/// phi + (p0 - phi0) exp(-rate t) if the coupling is 0.
template <Real S>
struct Follower : Timeless<S> {
  Follower(S its_rate = 1, S its_coupling = 0) noexcept : speed(its_rate), coupling(its_coupling) {}
  using Moment = typename Timeless<S>::Moment;
  static constexpr int width = 2;
  S speed, coupling;
  S rate(int) const noexcept { return speed; }
  GYROSTAT_INLINE void sources(const Moment&, const Lanes<S>* y, Lanes<S>* source) const noexcept {
    *source = lanes(S(0.3L)) * (lanes(speed) * y[0] - y[1]);
  }
  GYROSTAT_INLINE void rates(const Moment&, const Lanes<S>* y, const Lanes<S>* p, Lanes<S>* rate) const noexcept {
    const Lanes<S> off = lanes(coupling) * (*p - lanes(S(0.3L)) * y[0]);
    rate[0] = off - y[1];
    rate[1] = y[0] + off;
  }
};

/// The same, put back onto the unit circle.
struct FollowedCircle : Follower<double> {
  using Follower<double>::Follower;
  void project(double, double* x, double* low) const noexcept {
    const double stretch = (1 - x[0] * x[0] - x[1] * x[1]) / 2 - x[0] * low[0] - x[1] * low[1];
    x[0] += stretch * x[0];
    x[1] += stretch * x[1];
    low[0] = low[1] = 0;
  }
};

/// y' = y^2, infinite at t = 1 from y = 1.
struct StiffExplosion : Timeless<double> {
  static constexpr int width = 1;
  static double rate(int) noexcept { return 1; }
  static void sources(const Moment&, const Lanes<double>*, Lanes<double>* source) noexcept { *source = lanes(0.0); }
  static void rates(const Moment&, const Lanes<double>* y, const Lanes<double>*, Lanes<double>* rate) noexcept {
    rate[0] = y[0] * y[0];
  }
};

/// A free rigid body, y' = a (y2 y3, y3 y1, y1 y2), driven by p: no exact solution.
template <Real S>
struct Body : Timeless<S> {
  Body(S its_rate) noexcept : speed(its_rate) {}
  using Moment = typename Timeless<S>::Moment;
  static constexpr int width = 3;
  S speed;
  S rate(int) const noexcept { return speed; }
  GYROSTAT_INLINE void sources(const Moment&, const Lanes<S>* y, Lanes<S>* source) const noexcept {
    *source = lanes(speed) * (lanes(S(0.5L)) * y[1] + lanes(S(0.2L)));
  }
  GYROSTAT_INLINE void rates(const Moment&, const Lanes<S>* y, const Lanes<S>* p, Lanes<S>* rate) const noexcept {
    rate[0] = lanes(S(0.8L)) * y[1] * y[2] + *p * y[1];
    rate[1] = lanes(S(-1.1L)) * y[2] * y[0] - *p * y[0];
    rate[2] = lanes(S(0.3L)) * y[0] * y[1];
  }
};

/// y = sin(swing t)/swing and p_i = cos(t + i) whatever their rates: unknowns of very different rates under what swings by itself.
struct Driven {
  using Scalar = double;
  static constexpr int width = 1, relaxing = 3;
  struct Moment {
    Lanes<double> push, follow[3], ahead[3];
  };
  double swing = 1;
  std::array<double, 3> speeds{1, 1e3, 1e9};
  double rate(int i) const noexcept { return speeds[static_cast<std::size_t>(i)]; }
  double forcing() const noexcept { return std::max(swing, 1.0); }
  Moment moment(const Lanes<double>& t) const noexcept {
    const auto of = [&](auto f) { return lanes(f(t[0]), f(t[1]), f(t[2]), f(t[3])); };
    Moment made{of([&](double x) { return std::cos(swing * x); }), {}, {}};
    for (int i = 0; i < 3; ++i) {
      made.follow[i] = of([&](double x) { return std::cos(x + i); });
      made.ahead[i] = of([&](double x) { return -std::sin(x + i); });
    }
    return made;
  }
  void sources(const Moment& now, const Lanes<double>*, Lanes<double>* source) const noexcept {
    for (int i = 0; i < 3; ++i) source[i] = lanes(rate(i)) * now.follow[i] + now.ahead[i];
  }
  static void rates(const Moment& now, const Lanes<double>*, const Lanes<double>* p, Lanes<double>* rate) noexcept {
    // the unknowns are felt, though they cancel
    Lanes<double> sum = now.push;
    for (int i = 0; i < 3; ++i) sum = sum + (p[i] - now.follow[i]);
    rate[0] = sum;
  }
};

/// The same with y = weak_push sin(swing t)/swing.
constexpr double weak_push = 1e-5;
struct Weak : Driven {
  static void rates(const Moment& now, const Lanes<double>*, const Lanes<double>*, Lanes<double>* rate) noexcept {
    rate[0] = lanes(weak_push) * now.push;
  }
};

static_assert(ode::RelaxingSystem<Follower<float>> && ode::RelaxingSystem<Driven> &&
              ode::RelaxingSystem<StiffExplosion> && ode::Projects<FollowedCircle>);

template <class System>
typename ode::Radau<System>::Options watching(typename System::Scalar tolerance, typename System::Scalar inside = 0) {
  typename ode::Radau<System>::Options options;
  options.tolerance = tolerance;
  options.inside = inside;
  options.scale.fill(1);
  return options;
}

/// One step of the method from its table alone, iterated to rounding: y' = f(y), y of three components.
template <class F>
std::array<long double, 3> one_step(const F& f, const std::array<long double, 3>& y0, long double h) {
  const auto& table = ode::detail::radau<long double>;
  std::array<std::array<long double, 3>, 8> rate;
  rate.fill(f(y0));
  std::array<long double, 3> y{};
  for (int sweep = 0; sweep < 60; ++sweep) {
    auto next = rate;
    for (int i = 0; i < 8; ++i) {
      y = y0;
      for (int j = 0; j < 8; ++j) {
        for (std::size_t c = 0; c < 3; ++c) y[c] += h * table.matrix[j][i] * rate[static_cast<std::size_t>(j)][c];
      }
      next[static_cast<std::size_t>(i)] = f(y);
    }
    rate = next;
  }
  return y;  // of the last stage, at the end of the step
}

}  // namespace

TEMPLATE_TEST_CASE("the table is that of collocation at the Radau nodes", "", float, double, long double) {
  using S = TestType;
  const auto& table = ode::detail::radau<S>;
  const S close = 8 * epsilon<S>;
  CHECK(table.node[7] == 1);
  for (int i = 0; i < 8; ++i) {
    const auto P = ode::detail::legendre_values(2 * static_cast<long double>(table.node[i]) - 1);
    CHECK(std::abs(static_cast<S>(P[8] - P[7])) < 64 * close);
    CHECK(table.weight[i] == table.matrix[i][7]);
    for (int k = 1; k <= 8; ++k) {
      S integral = 0;
      for (int j = 0; j < 8; ++j) integral += table.matrix[j][i] * std::pow(table.node[j], S(k - 1));
      CHECK(std::abs(integral - std::pow(table.node[i], S(k)) / S(k)) < close);
    }
    for (int j = 0; j < 8; ++j) {
      S product = 0;
      for (int m = 0; m < 8; ++m) product += table.matrix[m][i] * table.inverse[j][m];
      CHECK(std::abs(product - S(i == j ? 1 : 0)) < 32 * close);
    }
  }
  // as a quadrature, exact up to the degree 14 and not further
  for (int k = 0; k <= 15; ++k) {
    long double sum = 0;
    for (int j = 0; j < 8; ++j) {
      const auto x = 2 * static_cast<long double>(table.node[j]) - 1;
      const auto P = ode::detail::legendre_values(x);
      long double P7P = P[7];
      P7P *= k <= 8 ? P[static_cast<std::size_t>(k)] : 0;
      sum += static_cast<long double>(table.weight[j]) * (k <= 8 ? P7P : 0);
    }
    if (k < 7) CHECK(std::abs(static_cast<S>(sum)) < close);
    if (k == 7) CHECK(std::abs(static_cast<S>(sum - 1 / 15.0L)) < close);
    if (k == 8) CHECK(std::abs(static_cast<S>(sum)) > S(0.01L));
  }
}

TEST_CASE("the error of a step of the method falls with its order") {
  const auto slope = [](const auto& f, const std::array<long double, 3>& start, long double h, int from, int to,
                        auto&& exact) {
    const auto error = [&](int n) {
      auto y = start;
      for (int i = 0; i < n; ++i) y = one_step(f, y, h / static_cast<long double>(n));
      const std::array<long double, 3> truth = exact();
      return std::hypot(y[0] - truth[0], y[1] - truth[1], y[2] - truth[2]);
    };
    return std::log(error(from) / error(to)) / std::log(static_cast<long double>(to) / from);
  };
  const auto turning = [](const std::array<long double, 3>& y) { return std::array<long double, 3>{-y[1], y[0], 0}; };
  CHECK(static_cast<double>(slope(turning, {1, 0, 0}, 6, 3, 6, [] {
          return std::array<long double, 3>{std::cos(6.0L), std::sin(6.0L), 0};
        })) == Approx(15).margin(0.15));
  const auto body = [](const std::array<long double, 3>& y) {
    return std::array<long double, 3>{0.8L * y[1] * y[2], -1.1L * y[2] * y[0], 0.3L * y[0] * y[1]};
  };
  const std::array<long double, 3> start{1, 0.4L, -0.7L};
  CHECK(static_cast<double>(slope(body, start, 4, 4, 6, [&] {
          auto y = start;
          for (int i = 0; i < 16; ++i) y = one_step(body, y, 4.0L / 16);
          return y;
        })) == Approx(15).margin(0.5));
}

TEMPLATE_TEST_CASE("Radau: the oscillator comes back after many periods", "", float, double, long double) {
  using S = TestType;
  const S end = 200 * pi<S>;
  ode::Radau<Follower<S>> solver({S(1000)}, 0, {1, 0, S(0.3L)}, watching<Follower<S>>(epsilon<S> / 4));
  REQUIRE(solver.advance(end) == Status::reached);
  CHECK(solver.time() == end);
  CHECK(std::abs(solver.state()[0] - std::cos(end)) < 300 * epsilon<S>);
  CHECK(std::abs(solver.state()[1] - std::sin(end)) < 2000 * epsilon<S>);
  CHECK(std::abs(solver.state()[2] - S(0.3L) * std::cos(end)) < 300 * epsilon<S>);
  CHECK(solver.counts().rejected < 10);
}

TEST_CASE("neither steps nor errors depend on the rate once p follows its source") {
  std::uint64_t fewest = 1000000, most = 0;
  for (const double rate : {0.0, 1e-3, 1.0, 10.0, 1e2, 1e3, 1e4, 1e6, 1e8, 1e12}) {
    using System = Follower<double>;
    ode::Radau<System> solver({rate, 0.5}, 0, {1, 0, 0.3}, watching<System>(1e-12, 1e-10));
    REQUIRE(solver.advance(100) == Status::reached);
    CAPTURE(rate, solver.counts().steps, solver.counts().rhs);
    CHECK(std::abs(solver.state()[0] - std::cos(100.0)) < 1e-10);
    CHECK(std::abs(solver.state()[1] - std::sin(100.0)) < 1e-10);
    CHECK(std::abs(solver.state()[2] - 0.3 * std::cos(100.0)) < 1e-10);
    fewest = std::min(fewest, solver.counts().rhs);
    most = std::max(most, solver.counts().rhs);
  }
  CHECK(2 * most < 3 * fewest);
}

TEST_CASE("several unknowns follow what swings by itself, each at its own rate") {
  for (const double swing : {0.1, 1.0, 40.0}) {
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      ode::Radau<Driven> solver({swing}, 0, {0, 1, std::cos(1.0), std::cos(2.0)}, watching<Driven>(tolerance));
      double between = 0, state[4];
      while (solver.time() < 10) {
        REQUIRE(solver.step(10) == Status::reached);
        const double t = (solver.previous_time() + solver.time()) / 2;
        solver.at(t, state);
        for (int i = 0; i < 3; ++i) between = std::max(between, std::abs(state[1 + i] - std::cos(t + i)));
      }
      CAPTURE(swing, tolerance, between, solver.counts().steps);
      CHECK(std::abs(solver.state()[0] - std::sin(10 * swing) / swing) < 100 * tolerance);
      CHECK(between < 1000 * tolerance);
      CHECK(double(solver.counts().steps) < 40 + 20 * swing);
    }
  }
  // a push too small for the inside of a step to see it is followed by its rate
  Weak weak;
  weak.swing = 1000;
  ode::Radau<Weak> solver(weak, 0, {0, 1, std::cos(1.0), std::cos(2.0)}, watching<Weak>(1e-9, 1e-5));
  REQUIRE(solver.advance(10) == Status::reached);
  CHECK(std::abs(solver.state()[0] - weak_push * std::sin(1e4) / 1000) < 1e-9);
}

TEST_CASE("a start off the source is resolved, and the step grows again") {
  using System = Follower<double>;
  for (const double rate : {1.0, 30.0, 1e3, 1e5, 1e8}) {
    for (const double inside : {1e-4, 1e-8, 1e-12}) {
      ode::Radau<System> solver({rate}, 0, {1, 0, 1.3}, watching<System>(1e-14, inside));
      double worst = 0, state[3];
      while (solver.time() < 5) {
        REQUIRE(solver.step(5) == Status::reached);
        for (int k = 1; k <= 8; ++k) {
          const double t = solver.previous_time() + k / 8.0 * (solver.time() - solver.previous_time());
          solver.at(t, state);
          worst = std::max(worst, std::abs(state[2] - (0.3 * std::cos(t) + std::exp(-rate * t))));
          worst = std::max(worst, std::abs(state[0] - std::cos(t)));
        }
      }
      CAPTURE(rate, inside, worst, solver.counts().steps, solver.counts().rejected);
      CHECK(worst < inside);
      CHECK(solver.counts().steps < 150);
      CHECK(solver.counts().rejected < 40);
    }
  }
  // a single long step is stable: p falls by the stability function, which vanishes at infinity
  auto options = watching<System>(1e10, 1e10);
  options.first_step = 0.1;
  ode::Radau<System> solver({1e8}, 0, {1, 0, 1e3}, options);
  REQUIRE(solver.step() == Status::reached);
  CHECK(solver.time() == 0.1);
  CHECK(std::abs(solver.state()[2] - 0.3) < 0.1);
}

TEST_CASE("less pace: a shorter first step") {
  using System = Follower<double>;
  auto options = watching<System>(1e10, 1e10);
  ode::Radau<System> whole(System(1e8), 0, {1, 0, .3}, options);
  options.pace = .5;
  ode::Radau<System> half(System(1e8), 0, {1, 0, .3}, options);
  REQUIRE(whole.step() == Status::reached);
  REQUIRE(half.step() == Status::reached);
  CHECK(half.time() == Approx(whole.time() / 2));
}

TEST_CASE("the last coefficients tell the error inside each step") {
  using System = Follower<double>;
  for (const double rate : {30.0, 1e3, 1e5}) {
    for (const double inside : {1e-4, 1e-7, 1e-10}) {
      ode::Radau<System> solver({rate}, 0, {1, 0, 1.3}, watching<System>(1e-14, inside));
      double state[3], moved[3], greatest = 0, most_suspected = 0;
      while (solver.time() < 5) {
        REQUIRE(solver.step(5) == Status::reached);
        double error = 0, suspected = 0;
        for (int k = 1; k < 32; ++k) {
          const double t = solver.previous_time() + k / 32.0 * (solver.time() - solver.previous_time());
          solver.at(t, state);
          solver.beside(t, moved);
          error = std::max(error, std::abs(state[2] - (0.3 * std::cos(t) + std::exp(-rate * t))));
          suspected = std::max(suspected, std::abs(moved[2] - state[2]));
        }
        CAPTURE(rate, inside, solver.previous_time(), solver.time(), error, suspected);
        CHECK(error <=
              honesty::margin_between * suspected + 2e-13);  // and what rounding at the start of a step makes of p
        greatest = std::max(greatest, error);
        most_suspected = std::max(most_suspected, suspected);
      }
      CAPTURE(rate, inside, greatest, most_suspected);
      CHECK(most_suspected < 30 * greatest);
      // y is better by far at the end of a step than inside it
      solver.at(5, state);
      solver.beside(5, moved);
      CHECK(moved[0] == state[0]);
      CHECK(moved[1] == state[1]);
    }
  }
}

TEST_CASE("the error keeps to the tolerance over many decades") {
  for (const double rate : {0.5, 20.0, 2000.0}) {
    using Fine = Body<long double>;
    ode::Radau<Fine> truth({static_cast<long double>(rate)}, 0, {1, 0.4L, -0.7L, 0.4L}, watching<Fine>(1e-19L));
    REQUIRE(truth.advance(20) == Status::reached);
    double last = 1;
    std::vector<std::pair<double, double>> cost;
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
      using System = Body<double>;
      ode::Radau<System> solver({rate}, 0, {1, 0.4, -0.7, 0.4}, watching<System>(tolerance));
      REQUIRE(solver.advance(20) == Status::reached);
      double error = 0;
      for (int i = 0; i < 3; ++i)
        error = std::max(error, std::abs(static_cast<double>(solver.state()[i] - truth.state()[i])));
      CAPTURE(rate, tolerance, error, solver.counts().steps);
      CHECK(error < 100 * tolerance);
      CHECK(error < last);
      last = error;
      cost.emplace_back(static_cast<double>(solver.counts().steps), error);
    }
    // order 9 where the inside of the steps rules, 15 where their ends do
    const double slope = std::log(cost[2].second / cost[4].second) / std::log(cost[4].first / cost[2].first);
    CAPTURE(rate, slope);
    CHECK(slope > 8);
  }
}

TEST_CASE("what one step leaves is below the tolerance, at its end and inside") {
  using System = Body<double>;
  using Fine = Body<long double>;
  for (const double rate : {0.5, 20.0, 2000.0, 2e6}) {
    for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
      auto options = watching<System>(tolerance);
      ode::Radau<System> solver({rate}, 0, {1, 0.4, -0.7, 0.4}, options);
      double end = 0, inside = 0, state[4];
      while (solver.time() < 10) {
        const double* x = solver.state();
        ode::Radau<Fine> truth({static_cast<long double>(rate)}, static_cast<long double>(solver.time()),
                               {x[0], x[1], x[2], x[3]}, watching<Fine>(1e-18L));
        REQUIRE(solver.step(10) == Status::reached);
        for (int k = 1; k <= 6; ++k) {
          const double t = solver.previous_time() + k / 6.0 * (solver.time() - solver.previous_time());
          REQUIRE(truth.advance(t) == Status::reached);
          solver.at(t, state);
          for (int i = 0; i < 4; ++i) {
            const auto error = std::abs(static_cast<double>(state[i] - truth.state()[i]));
            (k == 6 && i < 3 ? end : inside) = std::max(k == 6 && i < 3 ? end : inside, error);
          }
        }
      }
      CAPTURE(rate, tolerance, end, inside);
      CHECK(end < tolerance);
      CHECK(inside < 1000 * tolerance);
    }
  }
}

TEST_CASE("the last step can be read at any time, its ends included") {
  using System = Follower<double>;
  ode::Radau<System> solver({50, 0.4}, 0, {1, 0, 0.3}, watching<System>(1e-16, 1e-14));
  double state[3];
  solver.at(0, state);
  CHECK((state[0] == 1 && state[1] == 0 && state[2] == 0.3));
  while (solver.time() < 20) {
    REQUIRE(solver.step() == Status::reached);
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      const double t = solver.previous_time() + share * (solver.time() - solver.previous_time());
      solver.at(t, state);
      CHECK(std::abs(state[0] - std::cos(t)) < 2e-14);
      CHECK(std::abs(state[2] - 0.3 * std::cos(t)) < 2e-14);
    }
  }
}

TEST_CASE("many ends asked for cost a step each and no accuracy") {
  using System = Follower<double>;
  ode::Radau<System> solver({50, 0.4}, 0, {1, 0, 0.3}, watching<System>(1e-15, 1e-12));
  for (int i = 1; i <= 1000; ++i) REQUIRE(solver.advance(i * 0.02) == Status::reached);
  CHECK(std::abs(solver.state()[0] - std::cos(20.0)) < 1e-14);
  CHECK(solver.counts().steps < 1100);
  // ends that nearly coincide
  REQUIRE(solver.advance(std::nextafter(20.0, 21.0)) == Status::reached);
  REQUIRE(solver.advance(21) == Status::reached);
  CHECK(std::abs(solver.state()[0] - std::cos(21.0)) < 1e-14);
}

TEST_CASE("many short steps leave little") {
  using System = Follower<double>;
  ode::Radau<System> solver({50}, 0, {1, 0, 0.3}, watching<System>(1e-16));
  for (int i = 1; i <= 20000; ++i) REQUIRE(solver.step(i / 64.0) == Status::reached);
  const double t = solver.time();
  const double error = std::hypot(solver.state()[0] - std::cos(t), solver.state()[1] - std::sin(t)) / epsilon<double>;
  CAPTURE(error);
  CHECK(error < 40);
}

TEST_CASE("Radau: a projection keeps the state on its law") {
  const auto error = [](bool projected) {
    auto options = watching<FollowedCircle>(1e-9);
    options.projected = projected;
    ode::Radau<FollowedCircle> solver(FollowedCircle(50), 0, {1, 0, 0.3}, options);
    double worst = 0;
    while (solver.time() < 1000) {
      REQUIRE(solver.step(1000) == Status::reached);
      worst = std::max(worst, std::abs(std::hypot(solver.state()[0], solver.state()[1]) - 1));
    }
    return worst / epsilon<double>;
  };
  CHECK(error(true) <= 2);
  CHECK(error(false) > 100);
}

TEST_CASE("Radau: a singularity ends the integration after few steps") {
  ode::Radau<StiffExplosion> solver({}, 0, {1, 0}, watching<StiffExplosion>(1e-12));
  const Status status = solver.advance(2);
  CHECK((status == Status::step_underflow || status == Status::not_finite));
  CHECK(solver.time() == Approx(1).epsilon(1e-6));
  CHECK(solver.counts().steps < 2000);
}

TEST_CASE("Radau: a cap, a NaN and an end that is none are distinguished") {
  using System = Follower<double>;
  constexpr double bad = std::numeric_limits<double>::quiet_NaN();
  auto options = watching<System>(1e-15);
  options.step_cap = 7;
  ode::Radau<System> capped({1}, 0, {1, 0, 0.3}, options);
  CHECK(capped.advance(1000) == Status::step_limit);
  CHECK(capped.counts().steps == 7);

  for (int i = 0; i < 3; ++i) {
    ode::Radau<System>::State start{1, 0, 0.3};
    start[static_cast<std::size_t>(i)] = bad;
    ode::Radau<System> poisoned({1, 1}, 0, start, watching<System>(1e-15));
    CHECK(poisoned.advance(10) == Status::not_finite);
    CHECK(poisoned.counts().steps == 0);
    CHECK(poisoned.step() == Status::not_finite);
  }
  ode::Radau<System> rate_bad({bad, 1}, 0, {1, 0, 0.3}, watching<System>(1e-15));
  CHECK(rate_bad.advance(10) == Status::not_finite);
  ode::Radau<System> time_bad({1}, bad, {1, 0, 0.3}, watching<System>(1e-15));
  CHECK(time_bad.step(10) == Status::reached);  // as with any end that is not after the start
  CHECK(time_bad.counts().steps == 0);

  ode::Radau<System> solver({1}, 0, {1, 0, 0.3}, watching<System>(bad));
  CHECK(solver.advance(bad) == Status::not_finite);
  CHECK(solver.advance(-1) == Status::reached);
  CHECK(solver.time() == 0);
  CHECK(solver.advance(3) == Status::reached);  // at the tightest tolerance
  CHECK(solver.state()[0] == Approx(std::cos(3.0)).epsilon(1e-14));

  ode::Radau<System> still({1}, 0, {0, 0, 0}, watching<System>(1e-15));
  CHECK(still.advance(1e9) == Status::reached);
  CHECK(still.counts().steps < 40);
  CHECK(still.state()[0] == 0);
}

TEST_CASE("nothing is allocated on the way") {
  using System = Body<double>;
  const std::size_t before = allocations();
  ode::Radau<System> solver({100}, 0, {1, 0.4, -0.7, 0.4}, watching<System>(1e-12));
  double state[4];
  Status status = Status::reached;
  while (solver.time() < 20 && status == Status::reached) {
    status = solver.step(20);
    solver.at(solver.previous_time(), state);
  }
  CHECK(allocations() == before);
  CHECK(status == Status::reached);
}

namespace {

/// y' = 0, p' = -rate p.
struct Still : Timeless<double> {
  Still(double its_rate) noexcept : speed(its_rate) {}
  static constexpr int width = 1;
  double speed;
  double rate(int) const noexcept { return speed; }
  static void sources(const Moment&, const Lanes<double>*, Lanes<double>* source) noexcept { *source = lanes(0.0); }
  static void rates(const Moment&, const Lanes<double>*, const Lanes<double>*, Lanes<double>* rate) noexcept {
    rate[0] = lanes(0.0);
  }
};

}  // namespace

TEST_CASE("radau: what stands still or goes on for ever comes back with a status") {
  auto options = watching<Still>(1e-14);
  options.step_cap = 2000;
  for (const double speed : {0.0, 1.0, 1e9}) {
    ode::Radau<Still> far({speed}, 0, {1, 0}, options);
    CHECK(far.advance(1e290) == Status::reached);
    CHECK(far.time() == 1e290);
    CHECK(far.state()[0] == 1);
    CHECK(far.state()[1] == 0);
    ode::Radau<Still> endless({speed}, 0, {1, 0}, options);
    CHECK(endless.advance(infinity<double>) == Status::not_finite);
    CHECK(endless.counts().steps < 2000);
  }
  auto watched = watching<Follower<double>>(1e-14);
  watched.step_cap = 100;
  ode::Radau<Follower<double>> turning({1}, 0, {1, 0, 0.3}, watched);
  CHECK(turning.advance(infinity<double>) == Status::step_limit);
  CHECK(turning.counts().steps == 100);
  CHECK(ode::Radau<Still>({1}, 0, {1, 0}, options).advance(gyrostat::nan<double>) == Status::not_finite);
}
