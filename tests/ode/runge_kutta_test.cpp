// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/runge_kutta.hpp"

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "allocations.hpp"
#include "catch.hpp"

using gyrostat::infinity;
using gyrostat::pi;
using gyrostat::Real;
using gyrostat::ode::RungeKutta;
using gyrostat::ode::Status;
using gyrostat::ode::StepControl;
using gyrostat::ode::uniform;

namespace {

template <Real S>
using Vec2 = std::array<S, 2>;

/// y'' = -y as a first-order system with a time-dependent rate: y(t) = (cos p, -sin p), p = t + t^2/4.
struct Chirp {
  template <Real S>
  void operator()(S t, const Vec2<S>& y, Vec2<S>& dydt) const noexcept {
    const S rate = 1 + t / 2;
    dydt = {rate * y[1], -rate * y[0]};
  }
  template <Real S>
  static Vec2<S> exact(S t) {
    const S phase = t + t * t / 4;
    return {std::cos(phase), -std::sin(phase)};
  }
};

template <Real S>
StepControl<S, 2> fixed(S h) {
  return {.relative = 0, .absolute = uniform<S, 2>(S(1e30)), .first_step = h, .longest_step = h};
}

template <Real S>
S distance(const Vec2<S>& a, const Vec2<S>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// Least-squares slope of log error against log step.
double slope(const std::vector<long double>& h, const std::vector<long double>& error) {
  long double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const long double x = std::log(h[i]), y = std::log(error[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<long double>(h.size());
  return static_cast<double>((n * sxy - sx * sy) / (n * sxx - sx * sx));
}

}  // namespace

TEST_CASE("the step has order 8 and the dense output order 7") {
  std::vector<long double> h, end, inside;
  for (const int n : {20, 28, 40, 56, 80}) {
    const long double size = 4.0L / n;
    RungeKutta solver(Chirp{}, 0.0L, Vec2<long double>{1, 0}, fixed(size));
    REQUIRE(solver.advance(4.0L) == Status::reached);
    CHECK(solver.counts().steps == static_cast<unsigned>(n));
    h.push_back(size);
    end.push_back(distance(solver.state(), Chirp::exact(4.0L)));

    // The interpolation alone: one step from the exact state, its error falls as h^8.
    RungeKutta one(Chirp{}, 1.0L, Chirp::exact(1.0L), fixed(size));
    REQUIRE(one.step(4.0L) == Status::reached);
    long double worst = 0;
    for (int i = 1; i < 16; ++i) {
      const long double t = 1.0L + size * i / 16;
      worst = std::max(worst, distance(one.at(t), Chirp::exact(t)));
    }
    inside.push_back(worst);
  }
  CHECK(slope(h, end) == Approx(8).margin(0.15));
  CHECK(slope(h, inside) == Approx(8).margin(0.15));
}

TEST_CASE("one component of the dense output and its derivative are those of the whole") {
  const auto f = [](double t, const std::array<double, 2>& y, std::array<double, 2>& dy) noexcept {
    dy = {y[1], -std::sin(y[0]) + 0.1 * t};
  };
  RungeKutta solver(f, 0.0, std::array<double, 2>{1, 0.5}, StepControl<double, 2>{});
  CHECK(solver.component(1, 0.3)[0] == 0.5);
  REQUIRE(solver.step(10) == Status::reached);
  const double h = solver.time();
  for (const double x : {0.0, 0.2, 0.7, 1.0}) {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto [value, slope] = solver.component(i, x * h);
      CHECK(value == Approx(solver.at(x * h)[i]).epsilon(1e-15));
      const double around = solver.at(x * h + 1e-6)[i] - solver.at(x * h - 1e-6)[i];
      CHECK(slope == Approx(around / 2e-6).epsilon(1e-8).margin(1e-8));
    }
  }
}

TEST_CASE("the dense output meets the step at both ends") {
  RungeKutta solver(Chirp{}, 0.0, Vec2<double>{1, 0}, {.relative = 1e-8});
  for (int i = 0; i < 5; ++i) {
    REQUIRE(solver.step(4.0) == Status::reached);
    const auto before = solver.counts().rhs;
    CHECK(distance(solver.at(solver.previous_time()), solver.previous_state()) == 0);
    CHECK(solver.counts().rhs == before + 3);
    CHECK(distance(solver.at(solver.time()), solver.state()) <= 4e-16);
    CHECK(solver.counts().rhs == before + 3);
  }
}

TEMPLATE_TEST_CASE("the error follows the tolerance", "", float, double, long double) {
  using S = TestType;
  const S floor = std::is_same_v<S, float> ? S(1e-5) : std::is_same_v<S, double> ? S(1e-13) : S(1e-16);
  for (S tolerance = S(1e-3); tolerance > floor; tolerance /= 100) {
    RungeKutta solver(Chirp{}, S(0), Vec2<S>{1, 0}, {.relative = tolerance, .absolute = uniform<S, 2>(tolerance)});
    REQUIRE(solver.advance(S(10)) == Status::reached);
    CHECK(solver.time() == S(10));
    CHECK(distance(solver.state(), Chirp::exact(S(10))) <= 30 * tolerance);
    CHECK(solver.counts().rejected <= solver.counts().steps);
  }
}

TEST_CASE("it runs backwards, and a limit that cuts a step leaves the next one long") {
  RungeKutta solver(Chirp{}, 2.0, Chirp::exact(2.0), {.relative = 1e-12});
  REQUIRE(solver.advance(-1.0) == Status::reached);
  CHECK(distance(solver.state(), Chirp::exact(-1.0)) <= 1e-10);

  const double natural = solver.next_step();
  REQUIRE(solver.advance(-1.0 - natural / 1000) == Status::reached);
  CHECK(solver.next_step() >= natural / 2);
  CHECK(solver.step(solver.time()) == Status::reached);
}

TEST_CASE("absolute tolerances are per component") {
  // The second component is a fast, irrelevant oscillation driven by nothing.
  const auto rhs = [](double, const std::array<double, 3>& y, std::array<double, 3>& dydt) noexcept {
    dydt = {-y[0], 50 * y[2], -50 * y[1]};
  };
  const std::array<double, 3> start{1, 1e-3, 0};
  RungeKutta tight(rhs, 0.0, start, {.relative = 1e-10, .absolute = {1e-12, 1e-12, 1e-12}});
  RungeKutta loose(rhs, 0.0, start, {.relative = 1e-10, .absolute = {1e-12, 1e-2, 1e-2}});
  REQUIRE(tight.advance(3.0) == Status::reached);
  REQUIRE(loose.advance(3.0) == Status::reached);
  CHECK(2 * loose.counts().steps < tight.counts().steps);
}

TEST_CASE("NaN in the start ends at once, NaN met on the way shortens the step") {
  for (const double bad : {gyrostat::nan<double>, infinity<double>}) {
    RungeKutta in_state(Chirp{}, 0.0, Vec2<double>{bad, 0});
    CHECK(in_state.advance(1.0) == Status::not_finite);
    CHECK(in_state.counts().rhs == 1);
    RungeKutta in_time(Chirp{}, bad, Vec2<double>{1, 0});
    CHECK(in_time.advance(1.0) == Status::not_finite);
  }
  RungeKutta in_limit(Chirp{}, 0.0, Vec2<double>{1, 0});
  CHECK(in_limit.advance(gyrostat::nan<double>) == Status::not_finite);
  CHECK(in_limit.counts().rhs == 1);

  // y' = -1/(2 y), y = sqrt(1 - t): defined up to t = 1 only, where the slope is infinite.
  const auto rhs = [](double, const std::array<double, 1>& y, std::array<double, 1>& dydt) noexcept {
    dydt[0] = y[0] > 0 ? -0.5 / y[0] : gyrostat::nan<double>;
  };
  RungeKutta solver(rhs, 0.0, std::array<double, 1>{1.0}, {.relative = 1e-3, .first_step = 0.999});
  REQUIRE(solver.advance(0.99) == Status::reached);
  CHECK(solver.state()[0] == Approx(0.1).epsilon(1e-3));
  CHECK(solver.counts().rejected > 0);
  const Status end = solver.advance(2.0);
  CHECK((end == Status::not_finite || end == Status::step_underflow));
  CHECK(solver.time() == Approx(1).margin(1e-6));
  CHECK(solver.counts().rhs < 20000);
  CHECK(solver.at(solver.time())[0] == solver.state()[0]);
  CHECK(solver.step(2.0) == end);
}

TEST_CASE("a right-hand side that is NaN everywhere but at the start ends bounded") {
  const auto rhs = [](double t, const std::array<double, 1>&, std::array<double, 1>& dydt) noexcept {
    dydt[0] = t == 0 ? 1.0 : gyrostat::nan<double>;
  };
  RungeKutta solver(rhs, 0.0, std::array<double, 1>{1.0});
  CHECK(solver.advance(1.0) == Status::not_finite);
  CHECK(solver.time() == 0);
  CHECK(solver.counts().rhs < 1000);
}

TEST_CASE("the cap on steps holds") {
  RungeKutta solver(Chirp{}, 0.0, Vec2<double>{1, 0}, {.relative = 1e-12, .step_cap = 10});
  CHECK(solver.advance(1e3) == Status::step_limit);
  CHECK(solver.counts().steps + solver.counts().rejected == 10);
}

TEST_CASE("a step below the spacing of time is refused") {
  RungeKutta solver(Chirp{}, 1e17, Vec2<double>{1, 0}, {.relative = 1e-10});
  CHECK(solver.advance(2e17) == Status::step_underflow);
}

TEST_CASE("a restart goes on from another state with the counts kept") {
  RungeKutta solver(Chirp{}, 0.0, Vec2<double>{1, 0}, {.relative = 1e-10});
  REQUIRE(solver.advance(1.0) == Status::reached);
  const auto before = solver.counts();
  solver.restart(2.0, Chirp::exact(2.0), 0.01);
  CHECK(solver.at(1.5) == solver.state());
  CHECK(solver.next_step() == 0.01);
  REQUIRE(solver.advance(3.0) == Status::reached);
  CHECK(distance(solver.state(), Chirp::exact(3.0)) <= 1e-9);
  CHECK(solver.counts().steps > before.steps);
  CHECK(solver.counts().rhs > before.rhs);

  solver.restart(0.0, {gyrostat::nan<double>, 0});
  CHECK(solver.advance(1.0) == Status::not_finite);
  solver.restart(0.0, {1, 0});
  CHECK(solver.advance(1.0) == Status::reached);
}

TEST_CASE("steps that move less than a rounding add up, and go on so") {
  const auto slow = [](double, const std::array<double, 1>&, std::array<double, 1>& dydt) noexcept { dydt = {1e-17}; };
  RungeKutta solver(slow, 0.0, std::array<double, 1>{1}, {.longest_step = 1});
  for (int i = 1; i <= 1000; ++i) {
    REQUIRE(solver.advance(i) == Status::reached);
    if (i % 10 == 0) solver.go_on();
  }
  CHECK(solver.state()[0] - 1 == Approx(1e-14).epsilon(0.02));
  solver.restart(0, {1});
  REQUIRE(solver.advance(1) == Status::reached);
  CHECK(solver.state()[0] == 1);
}

TEST_CASE("a problem at rest is crossed in a few steps") {
  const auto rest = [](double, const std::array<double, 2>&, std::array<double, 2>& dydt) noexcept { dydt = {0, 0}; };
  RungeKutta solver(rest, 0.0, std::array<double, 2>{0, 0});
  REQUIRE(solver.advance(1e6) == Status::reached);
  CHECK(solver.counts().steps < 20);
}

TEST_CASE("an integration with dense output allocates nothing") {
  const std::size_t before = allocations();
  RungeKutta solver(Chirp{}, 0.0, Vec2<double>{1, 0}, {.relative = 1e-10});
  double sum = 0;
  while (solver.time() < 5 && solver.step(5) == Status::reached) sum += solver.at(solver.time() / 2)[0];
  CHECK(allocations() == before);
  CHECK(std::isfinite(sum));
}

TEST_CASE("runge kutta: what stands still or goes on for ever comes back with a status") {
  const auto still = [](double, const Vec2<double>&, Vec2<double>& dydt) noexcept { dydt = {0, 0}; };
  for (const double y : {0.0, 1.0}) {
    RungeKutta far(still, 0.0, Vec2<double>{y, y});
    CHECK(far.advance(1e300) == Status::reached);
    CHECK(far.time() == 1e300);
    CHECK(far.counts().steps < 500);
    CHECK(far.state() == Vec2<double>{y, y});
    for (const double limit : {infinity<double>, -infinity<double>}) {
      RungeKutta endless(still, 0.0, Vec2<double>{y, y});
      CHECK(endless.advance(limit) == Status::not_finite);
      CHECK(std::abs(endless.time()) > 1e300);
      CHECK(endless.counts().steps < 500);
    }
  }
  RungeKutta chirp(Chirp{}, 0.0, Vec2<double>{1, 0}, {.step_cap = 100});
  CHECK(chirp.advance(infinity<double>) == Status::step_limit);
  CHECK(chirp.counts().steps + chirp.counts().rejected == 100);
  CHECK(distance(chirp.state(), Chirp::exact(chirp.time())) < 1e-6);
  // a scale of time of its own: the first step is no longer than that
  const auto fast = [](double, const Vec2<double>& y, Vec2<double>& dydt) noexcept {
    dydt = {1e9 * y[1], -1e9 * y[0]};
  };
  RungeKutta quick(fast, 0.0, Vec2<double>{1, 0}, {.step_cap = 100});
  CHECK(quick.advance(infinity<double>) == Status::step_limit);
  CHECK(std::hypot(quick.state()[0], quick.state()[1]) == Approx(1).epsilon(1e-6));
}

TEST_CASE("the estimate of order 5 alone sees more of a kink than that of order 5(3)") {
  // through the kink at pi/10 a different way for each start
  const auto kinked = [](double, const std::array<double, 1>& y, std::array<double, 1>& dy) noexcept {
    dy[0] = 1 + std::abs(y[0] - pi<double> / 10);
  };
  const auto exact = [](double t, double y) {
    const double c = pi<double> / 10, u = y - c, crossing = std::log(1 - u);
    return t < crossing ? c + 1 - (1 - u) * std::exp(-t) : c - 1 + std::exp(t - crossing);
  };
  const auto worst = [&](bool smooth) {
    double most = 0;
    for (double tolerance = 1e-4; tolerance > 1e-11; tolerance /= 10)
      for (int i = 0; i < 20; ++i) {
        const double start = -0.01 * i;
        RungeKutta solver(kinked, 0.0, std::array<double, 1>{start},
                          StepControl<double, 1>{.relative = 0, .absolute = {tolerance}, .smooth = smooth});
        REQUIRE(solver.advance(2.0) == Status::reached);
        most = std::max(most, std::abs(solver.state()[0] - exact(2, start)) / tolerance);
      }
    return most;
  };
  // what is lost at the kink grows by e^1.7 from there
  CHECK(worst(false) < 100);
  CHECK(worst(true) > 3 * worst(false));
}
