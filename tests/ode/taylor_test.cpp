// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/taylor.hpp"

#include "catch.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

using namespace gyrostat;
using ode::Status;

namespace {

/// x'' = -rate^2 x: coefficients by hand, energy known.
template <Real S>
struct Oscillator {
  using Scalar = S;
  static constexpr int width = 4;
  template <int Order>
  struct Work {};
  S rate = 1;
  template <int Order>
  void expand(S, S unit, S (&x)[Order + 1][width], Work<Order>&) const noexcept {
    for (int k = 0; k < Order; ++k) {
      x[k + 1][0] = unit * x[k][1] / S(k + 1);
      x[k + 1][1] = -unit * rate * rate * x[k][0] / S(k + 1);
      x[k + 1][2] = x[k + 1][3] = 0;
    }
  }
};

/// The oscillator, put back onto its circle after each step.
template <Real S>
struct Circle : Oscillator<S> {
  void project(S, S* x, S* low) const noexcept {
    const S stretch = (1 - x[0] * x[0] - x[1] * x[1]) / 2 - x[0] * low[0] - x[1] * low[1];
    low[0] += stretch * x[0];
    low[1] += stretch * x[1];
  }
};

/// x' = x^2, infinite at t = 1 from x = 1.
struct Explosion {
  using Scalar = double;
  static constexpr int width = 4;
  template <int Order>
  struct Work {};
  template <int Order>
  void expand(double, double unit, double (&x)[Order + 1][width], Work<Order>&) const noexcept {
    for (int k = 0; k < Order; ++k) {
      double sum = 0;
      for (int j = 0; j <= k; ++j) sum += x[j][0] * x[k - j][0];
      x[k + 1][0] = unit * sum / (k + 1);
      for (int i = 1; i < 4; ++i) x[k + 1][i] = 0;
    }
  }
};

/// x' = -sign(x): a corner that the step limit must respect.
struct Fall {
  using Scalar = double;
  static constexpr int width = 4;
  template <int Order>
  struct Work {};
  template <int Order>
  void expand(double, double unit, double (&x)[Order + 1][width], Work<Order>&) const noexcept {
    for (int k = 1; k <= Order; ++k) {
      for (int i = 0; i < width; ++i) x[k][i] = 0;
    }
    x[1][0] = -unit;
  }
  double step_limit(const double* x) const noexcept { return 0.3 * x[0]; }
};

/// x' = 2 t: a right-hand side that knows the time.
struct Square {
  using Scalar = double;
  static constexpr int width = 4;
  template <int Order>
  struct Work {};
  template <int Order>
  void expand(double t, double unit, double (&x)[Order + 1][width], Work<Order>&) const noexcept {
    for (int k = 1; k <= Order; ++k) {
      for (int i = 0; i < width; ++i) x[k][i] = 0;
    }
    x[1][0] = 2 * t * unit;
    x[2][0] = unit * unit;
  }
};

static_assert(ode::TaylorSystem<Oscillator<double>> && !ode::LimitsStep<Oscillator<double>>);
static_assert(ode::LimitsStep<Fall> && ode::Projects<Circle<double>>);

template <Real S>
ode::TaylorOptions<S, 4> watching(S tolerance) {
  ode::TaylorOptions<S, 4> options;
  options.tolerance = tolerance;
  options.scale = {1, 1, 0, 0};
  return options;
}

}  // namespace

TEMPLATE_TEST_CASE("the oscillator comes back after many periods", "", float, double, long double) {
  using S = TestType;
  const S end = 200 * pi<S>;
  ode::Taylor<Oscillator<S>> solver({}, 0, {1, 0, 0, 0}, watching<S>(epsilon<S> / 4));
  REQUIRE(solver.advance(end) == Status::reached);
  CHECK(solver.time() == end);
  CHECK(std::abs(solver.state()[0] - std::cos(end)) < 60 * epsilon<S>);
  CHECK(std::abs(solver.state()[1] + std::sin(end)) < 2000 * epsilon<S>);
  CHECK(solver.counts().rejected < 10);
}

TEMPLATE_TEST_CASE("the unit of time does not matter, nor do powers that overflow", "", float, double) {
  using S = TestType;
  for (const S rate : {S(1e-6), S(1), S(1e6)}) {
    ode::Taylor<Oscillator<S>> solver({rate}, 0, {1, 0, 0, 0}, [&] {
      auto options = watching<S>(epsilon<S>);
      options.scale[1] = rate;
      return options;
    }());
    REQUIRE(solver.advance(10 / rate) == Status::reached);
    CHECK(std::abs(solver.state()[0] - std::cos(S(10))) < 200 * epsilon<S>);
  }
}

TEST_CASE("the error of a step falls with its order") {
  // the tolerance is out of the way, the steps are given
  const auto error = [](int n) {
    auto options = watching(1e30);
    ode::Taylor<Oscillator<double>, 8> solver({}, 0, {1, 0, 0, 0}, options);
    for (int i = 1; i <= n; ++i) REQUIRE(solver.step(4.0 * i / n) == Status::reached);
    return std::hypot(solver.state()[0] - std::cos(4.0), solver.state()[1] + std::sin(4.0));
  };
  CHECK(std::log2(error(4) / error(8)) == Approx(8).margin(0.15));
  CHECK(std::log2(error(8) / error(16)) == Approx(8).margin(0.15));
}

TEST_CASE("a tighter tolerance gives a smaller error") {
  double last = 1;
  for (const double tolerance : {1e-4, 1e-7, 1e-10, 1e-13}) {
    ode::Taylor<Oscillator<double>> solver({}, 0, {1, 0, 0, 0}, watching(tolerance));
    REQUIRE(solver.advance(50) == Status::reached);
    const double error = std::abs(solver.state()[0] - std::cos(50.0));
    CHECK(error < 100 * tolerance);
    CHECK(error < last);
    last = error;
  }
}

TEST_CASE("the last step can be read at any time") {
  ode::Taylor<Oscillator<double>> solver({}, 0, {1, 0, 0, 0}, watching(1e-16));
  double state[4];
  while (solver.time() < 20) {
    REQUIRE(solver.step() == Status::reached);
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      const double t = solver.previous_time() + share * (solver.time() - solver.previous_time());
      solver.at(t, state);
      CHECK(std::abs(state[0] - std::cos(t)) < 5e-15);
    }
  }
}

TEST_CASE("a crossing is found where it is") {
  ode::Taylor<Oscillator<double>> solver({}, 0, {1, 0, 0, 0}, watching(1e-16));
  const auto position = [](const double* x) noexcept { return x[0]; };
  int found = 0;
  while (solver.time() < 50) {
    REQUIRE(solver.step() == Status::reached);
    const auto t = solver.crossing(position);
    if (!t) {
      CHECK(t.error() == Errc::no_bracket);
      continue;
    }
    CHECK(*t == Approx((found + 0.5) * pi<double>).epsilon(1e-15).margin(4e-15));
    ++found;
  }
  CHECK(found == 16);
}

TEST_CASE("a right-hand side may depend on the time") {
  ode::Taylor<Square> solver({}, 1, {1, 0, 0, 0}, watching(1e-16));
  REQUIRE(solver.advance(3) == Status::reached);
  CHECK(solver.state()[0] == Approx(9).epsilon(1e-15));
}

TEST_CASE("carried roundings keep many short steps exact") {
  const auto error = [](bool compensated) {
    auto options = watching(1e30);
    options.compensated = compensated;
    ode::Taylor<Oscillator<double>, 8> solver({}, 0, {1, 0, 0, 0}, options);
    for (int i = 1; i <= 100000; ++i) REQUIRE(solver.step(i / 128.0) == Status::reached);
    const double t = solver.time();
    return std::hypot(solver.state()[0] - std::cos(t), solver.state()[1] + std::sin(t)) / epsilon<double>;
  };
  const double plain = error(false), carried = error(true);
  CAPTURE(plain, carried);
  CHECK(carried < 3);
  CHECK(plain > 10 * carried);
}

TEST_CASE("a projection keeps the state on its law") {
  const double end = 20000 * pi<double>;
  const auto error = [&](bool projected) {
    auto options = watching(1e-18);
    options.projected = projected;
    ode::Taylor<Circle<double>> solver({}, 0, {1, 0, 0, 0}, options);
    double worst = 0;
    while (solver.time() < end) {
      REQUIRE(solver.step(end) == Status::reached);
      worst = std::max(worst, std::abs(std::hypot(solver.state()[0], solver.state()[1]) - 1));
    }
    return worst / epsilon<double>;
  };
  const double free = error(false), projected = error(true);
  CAPTURE(free, projected);
  CHECK(projected <= 2);
  CHECK(free > 10 * projected);
}

TEST_CASE("a singularity ends the integration after few steps") {
  ode::Taylor<Explosion> solver({}, 0, {1, 0, 0, 0}, [] {
    auto options = watching(1e-12);
    options.step_cap = 100000;
    return options;
  }());
  const Status status = solver.advance(2);
  CHECK((status == Status::step_underflow || status == Status::not_finite));
  CHECK(solver.time() == Approx(1).epsilon(1e-9));
  CHECK(solver.counts().steps < 2000);
}

TEST_CASE("the system's own limit bounds the step") {
  ode::Taylor<Fall> solver({}, 0, {1, 0, 0, 0}, watching(1e-12));
  for (int i = 0; i < 60; ++i) REQUIRE(solver.step() == Status::reached);
  CHECK(solver.state()[0] == Approx(std::pow(0.7, 60)).epsilon(1e-6));
  CHECK(1 - solver.time() == Approx(std::pow(0.7, 60)).epsilon(1e-6));
}

TEST_CASE("a cap, a NaN and an end that is none are distinguished") {
  constexpr double bad = std::numeric_limits<double>::quiet_NaN();
  auto options = watching(1e-15);
  options.step_cap = 7;
  ode::Taylor<Oscillator<double>> capped({}, 0, {1, 0, 0, 0}, options);
  CHECK(capped.advance(1000) == Status::step_limit);
  CHECK(capped.counts().steps == 7);

  ode::Taylor<Oscillator<double>> poisoned({}, 0, {1, bad, 0, 0}, watching(1e-15));
  CHECK(poisoned.advance(10) == Status::not_finite);
  CHECK(poisoned.counts().steps == 0);
  CHECK(poisoned.counts().rhs == 1);
  CHECK(poisoned.step() == Status::not_finite);

  ode::Taylor<Oscillator<double>> solver({}, 0, {1, 0, 0, 0}, watching(1e-15));
  CHECK(solver.advance(bad) == Status::not_finite);
  CHECK(solver.advance(-1) == Status::reached);
  CHECK(solver.time() == 0);

  ode::Taylor<Oscillator<double>> still({}, 0, {0, 0, 0, 0}, watching(1e-15));
  CHECK(still.advance(1e9) == Status::reached);
  CHECK(still.counts().steps < 40);
  CHECK(still.state()[0] == 0);
}

TEST_CASE("an integration can start anew from another state") {
  ode::Taylor<Oscillator<double>> solver({}, 0, {1, 0, 0, 0}, watching(1e-16));
  REQUIRE(solver.advance(3) == Status::reached);
  solver.restart(5, {0, 1, 0, 0});
  CHECK(solver.previous_time() == 5);
  double now[4];
  for (const double t : {4.0, 5.0, 6.0}) {
    solver.at(t, now);
    CHECK((now[0] == 0 && now[1] == 1));
  }
  REQUIRE(solver.advance(6) == Status::reached);
  CHECK(solver.state()[0] == Approx(std::sin(1.0)).epsilon(1e-15));
}

TEST_CASE("a kick moves what is not zero, and leaves the last step as it was") {
  ode::Taylor<Oscillator<double>> solver({}, 0, {1, 0, 0, 0}, watching(1e-16));
  solver.kick(1e-6);
  CHECK(std::abs(solver.state()[0] - 1) > 4e-7);
  CHECK(std::abs(solver.state()[0] - 1) < 1e-6);
  CHECK(solver.state()[1] == 0);
  REQUIRE(solver.step() == Status::reached);
  double before[4], after[4];
  const double inside = (solver.previous_time() + solver.time()) / 2;
  solver.at(inside, before);
  solver.kick(1e-6);
  solver.at(inside, after);
  CHECK(before[0] == after[0]);
  const double kicked = solver.state()[0] / std::cos(solver.time());
  REQUIRE(solver.step() == Status::reached);
  CHECK(std::abs(kicked - 1) > 4e-7);
}

TEST_CASE("what rounding has lost goes from one integration to the next") {
  // x = 1 at t = 0 falls by t^2/2 = 1e-17 in each piece, and has begun anew in the meantime
  ode::Taylor<Oscillator<double>>::State x{1, 0, 0, 0}, lost{};
  for (int i = 0; i < 1000; ++i) {
    ode::Taylor<Oscillator<double>> solver({}, 0, {x[0], 0, 0, 0}, watching(1e-16));
    solver.regain(lost.data());
    REQUIRE(solver.advance(std::sqrt(2e-17)) == Status::reached);
    x[0] = solver.state()[0], lost[0] = solver.lost()[0];
  }
  CHECK(x[0] + lost[0] == Approx(1 - 1e-14).epsilon(1e-17).margin(2e-16));
  CHECK((1 - x[0]) - lost[0] == Approx(1e-14).epsilon(1e-6));
}

TEST_CASE("taylor: what stands still or goes on for ever comes back with a status") {
  using Solver = ode::Taylor<Oscillator<double>>;
  Solver::Options options;
  options.scale = {1, 1, 0, 0};
  options.step_cap = 1000;
  for (const double x : {0.0, 1.0}) {
    Solver far({0}, 0, {x, 0, 0, 0}, options);
    CHECK(far.advance(1e300) == Status::reached);
    CHECK(far.time() == 1e300);
    CHECK(far.state()[0] == x);
    Solver endless({0}, 0, {x, 0, 0, 0}, options);
    CHECK(endless.advance(infinity<double>) == Status::not_finite);
    CHECK(endless.time() > 1e290);
    CHECK(endless.counts().steps < 1000);
  }
  Solver swing({1}, 0, {1, 0, 0, 0}, options);
  CHECK(swing.advance(infinity<double>) == Status::step_limit);
  CHECK(swing.counts().steps == 1000);
  CHECK(Solver({1}, 0, {1, 0, 0, 0}, options).advance(gyrostat::nan<double>) == Status::not_finite);
}
