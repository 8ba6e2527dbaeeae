// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/taylor_batch.hpp"

#include "allocations.hpp"
#include "catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

using namespace gyrostat;
using ode::Status;

namespace {

/// x'' = -rate^2 x, or x' = x^2 where the rate is zero; one more component counts the time.
template <Real S>
struct Oscillators {
  using Scalar = S;
  static constexpr int width = 3;
  template <int Order>
  struct Work {};
  S rate[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  template <int Order>
  void expand(const S (&unit)[8], S (&x)[Order + 1][width][8], Work<Order>&) const noexcept {
    for (int b = 0; b < 8; ++b) {
      for (int k = 0; k < Order; ++k) {
        const S share = unit[b] / static_cast<S>(k + 1);
        if (rate[b] == 0) {
          S sum = 0;
          for (int j = 0; j <= k; ++j) sum += x[j][0][b] * x[k - j][0][b];
          x[k + 1][0][b] = share * sum;
          x[k + 1][1][b] = 0;
        } else {
          x[k + 1][0][b] = share * x[k][1][b];
          x[k + 1][1][b] = -share * rate[b] * rate[b] * x[k][0][b];
        }
        x[k + 1][2][b] = k == 0 ? unit[b] : S(0);
      }
    }
  }
};

/// The oscillators put back onto their circles, all of rate 1.
struct Circles : Oscillators<double> {
  void project(int first, double (&x)[3][8], double (&low)[3][8]) const noexcept {
    for (int b = first; b < first + wide_size<double>; ++b) {
      const double stretch =
          (1 - x[0][b] * x[0][b] - x[1][b] * x[1][b]) / 2 - x[0][b] * low[0][b] - x[1][b] * low[1][b];
      low[0][b] += stretch * x[0][b];
      low[1][b] += stretch * x[1][b];
    }
  }
};

static_assert(ode::BatchSystem<Oscillators<float>> && !ode::BatchProjects<Oscillators<double>>);
static_assert(ode::BatchProjects<Circles>);

template <class System>
ode::TaylorBatch<System> batch_of(const System& system, typename System::Scalar tolerance) {
  using S = typename System::Scalar;
  ode::TaylorBatchOptions<S> options;
  options.tolerance = tolerance;
  ode::TaylorBatch<System> batch(system, options);
  for (int b = 0; b < 8; ++b) batch.start(b, 0, {1, 0, 0}, {1, system.rate[b] > 0 ? system.rate[b] : S(1), 0});
  return batch;
}

constexpr double bad = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("quick logarithm and power of two") {
  for (float x = 1e-20F; x < 1e20F; x *= 1.0137F) CHECK(std::abs(ode::detail::near_log2(x) - std::log2(x)) < 1.3e-4F);
  for (float x = -66; x < 66; x += 0.0137F) CHECK(ode::detail::near_exp2(x) == Approx(std::exp2(x)).epsilon(6e-6));
  CHECK(ode::detail::near_exp2(1e9F) > 1e35F);
  CHECK(ode::detail::near_exp2(-1e9F) < 1e-35F);
}

TEMPLATE_TEST_CASE("eight oscillators, each with its own rate and step", "", float, double, long double) {
  using S = TestType;
  Oscillators<S> system;
  for (int b = 0; b < 8; ++b) system.rate[b] = static_cast<S>(b < 4 ? 1 + b : 30 * b);
  auto batch = batch_of(system, epsilon<S>);
  REQUIRE(batch.advance(20));
  for (int b = 0; b < 8; ++b) {
    const auto x = batch.state(b);
    const S phase = 20 * system.rate[b];
    CHECK(batch.time(b) == 20);
    CHECK(batch.status(b) == Status::reached);
    CHECK(std::abs(x[0] - std::cos(phase)) < (20 + phase) * 2 * epsilon<S>);
    CHECK(std::abs(x[1] / system.rate[b] + std::sin(phase)) < (20 + phase) * 2 * epsilon<S>);
    CHECK(std::abs(x[2] - 20) <= 20 * epsilon<S>);
  }
  CHECK(batch.counts(7).steps > 20 * batch.counts(0).steps);
}

TEST_CASE("a lane does as it would alone") {
  Oscillators<double> system;
  for (int b = 0; b < 8; ++b) system.rate[b] = 1 + 0.37 * b;
  auto together = batch_of(system, 1e-15);
  REQUIRE(together.advance(50));
  for (int b = 0; b < 8; ++b) {
    ode::TaylorBatch<Oscillators<double>> alone(system, {1e-15});
    alone.start(b, 0, {1, 0, 0}, {1, system.rate[b], 0});
    REQUIRE(alone.advance(50));
    CHECK(alone.state(b) == together.state(b));
    CHECK(alone.counts(b).steps == together.counts(b).steps);
    CHECK(alone.counts((b + 1) % 8).steps == 0);
  }
}

TEST_CASE("what fails in one lane stays there") {
  Oscillators<double> system;
  system.rate[5] = 0;  // blows up at t = 1
  auto batch = batch_of(system, 1e-15);
  batch.start(2, 0, {1, bad, 0}, {1, 1, 0});
  batch.start(3, 0, {std::numeric_limits<double>::infinity(), 0, 0}, {1, 1, 0});
  system.rate[6] = bad;
  batch.system() = system;
  CHECK(!batch.advance(30));
  const auto reference = [&] {
    auto sound = batch_of(Oscillators<double>{}, 1e-15);
    REQUIRE(sound.advance(30));
    return sound.state(0);
  }();
  for (const int b : {0, 1, 4, 7}) {
    CHECK(batch.status(b) == Status::reached);
    CHECK(batch.state(b) == reference);
    CHECK(batch.time(b) == 30);
  }
  for (const int b : {2, 3, 6}) {
    CHECK(batch.status(b) == Status::not_finite);
    CHECK(batch.counts(b).steps == 0);
    CHECK(batch.time(b) == 0);
  }
  CHECK((batch.status(5) == Status::step_underflow || batch.status(5) == Status::not_finite));
  CHECK(batch.time(5) == Approx(1).epsilon(1e-9));
  CHECK(batch.counts(5).steps < 2000);
  // failed for good, until started again
  CHECK(!batch.advance(31));
  CHECK(batch.time(2) == 0);
  CHECK(batch.time(0) == 31);
  batch.start(2, 0, {1, 0, 0}, {1, 1, 0});
  batch.start(3, 0, {1, 0, 0}, {1, 1, 0});
  ode::TaylorBatch<Oscillators<double>>::Ends ends{};
  ends[2] = ends[3] = 30;
  while (batch.step(ends) > 0) {
  }
  CHECK(batch.state(2) == reference);
}

TEST_CASE("each problem has its own end, and one that is there waits unchanged") {
  auto batch = batch_of(Oscillators<double>{}, 1e-16);
  ode::TaylorBatch<Oscillators<double>>::Ends ends;
  for (std::size_t b = 0; b < 8; ++b) ends[b] = 1 + 5 * static_cast<double>(b);
  while (batch.step(ends) > 0) {
  }
  for (int b = 0; b < 8; ++b) {
    CHECK(batch.time(b) == ends[static_cast<std::size_t>(b)]);
    CHECK(std::abs(batch.state(b)[0] - std::cos(batch.time(b))) < 1e-14);
  }
  const auto before = batch.state(0);
  ends[7] = 100;
  while (batch.step(ends) > 0) {
  }
  CHECK(batch.state(0) == before);
  ends[1] = bad;
  CHECK(batch.step(ends) == 0);
  CHECK(batch.status(1) == Status::reached);
  CHECK(!batch.advance(bad));
  CHECK(batch.advance(101));
}

TEST_CASE("a batch reads its last step at any time") {
  auto batch = batch_of(Oscillators<double>{}, 1e-16);
  ode::TaylorBatch<Oscillators<double>>::Ends ends;
  for (std::size_t b = 0; b < 8; ++b) ends[b] = 10 + static_cast<double>(b);
  while (batch.step(ends) > 0) {
    for (int b = 0; b < 8; ++b) {
      for (const double share : {0.0, 0.4, 1.0}) {
        const double t = batch.previous_time(b) + share * (batch.time(b) - batch.previous_time(b));
        CHECK(std::abs(batch.at(b, t)[0] - std::cos(t)) < 5e-15);
      }
    }
  }
}

TEST_CASE("a batch keeps its cap on steps, problem by problem") {
  Oscillators<double> system;
  system.rate[3] = 100;
  ode::TaylorBatch<Oscillators<double>> batch(system, {1e-15, 30, true});
  CHECK(batch.advance(1));  // nothing started, nothing done
  for (int b = 0; b < 8; ++b) batch.start(b, 0, {1, 0, 0}, {1, system.rate[b], 0});
  CHECK(!batch.advance(10));
  CHECK(batch.status(3) == Status::step_limit);
  CHECK(batch.counts(3).steps == 30);
  CHECK(batch.time(2) == 10);
}

TEST_CASE("a motion without high derivatives takes long steps in its lane") {
  Oscillators<double> system;
  auto batch = batch_of(system, 1e-15);
  batch.start(4, 0, {0, 0, 0}, {1, 1, 1});
  batch.start(5, 0, {0, 0, 0}, {1, 1, 0});
  REQUIRE(batch.advance(1000));
  CHECK(batch.state(4)[2] == Approx(1000).epsilon(1e-15));
  CHECK(batch.state(5)[0] == 0);
  CHECK(batch.counts(4).steps < 40);
  CHECK(batch.counts(5).steps < 40);
  CHECK(std::abs(batch.state(3)[0] - std::cos(1000.0)) < 1e-13);
}

TEST_CASE("a projection keeps each state of a batch on its law") {
  const auto drift = [](bool projected) {
    ode::TaylorBatch<Circles> batch({}, {1e-18, 100000000, projected});
    for (int b = 0; b < 8; ++b) batch.start(b, 0, {std::cos(0.1 * b), std::sin(0.1 * b), 0}, {1, 1, 0});
    REQUIRE(batch.advance(10000));
    double worst = 0;
    for (int b = 0; b < 8; ++b) worst = std::max(worst, std::abs(std::hypot(batch.state(b)[0], batch.state(b)[1]) - 1));
    return worst / epsilon<double>;
  };
  CHECK(drift(true) <= 2);
  CHECK(drift(false) > 4);
}

TEST_CASE("many problems pass through the lanes") {
  Oscillators<double> system;
  ode::TaylorBatch<Oscillators<double>> batch(system, {1e-15});
  std::vector<double> error(100, 1.0);
  std::vector<Status> status(100);
  std::vector<int> ended(100, 0);
  const std::size_t before = allocations();
  ode::run_all(
      batch, 100,
      [&](std::size_t index, int b) {
        batch.system().rate[b] = 1 + 0.1 * static_cast<double>(index);
        batch.start(b, 0, {index == 50 ? bad : 1.0, 0, 0}, {1, batch.system().rate[b], 0});
        return index % 10 == 0 ? 0.0 : static_cast<double>(index);  // some end where they begin
      },
      [&](std::size_t index, int b) {
        const double t = index % 10 == 0 ? 0.0 : static_cast<double>(index);
        CHECK(batch.time(b) == t);
        error[index] = std::abs(batch.state(b)[0] - std::cos(batch.system().rate[b] * t));
        status[index] = batch.status(b);
        ++ended[index];
      });
  CHECK(allocations() == before);
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(ended[i] == 1);
    if (i == 50) continue;
    CHECK(error[i] < 1e-12);
    CHECK(status[i] == Status::reached);
  }
  ode::run_all(batch, 0, [](std::size_t, int) { return 0.0; }, [](std::size_t, int) { FAIL(); });
}

TEST_CASE("taylor batch: what stands still or goes on for ever comes back with a status") {
  ode::TaylorBatchOptions<double> options;
  options.step_cap = 1000;
  Oscillators<double> system;
  system.rate[0] = system.rate[1] = 0;  // x' = x^2: at rest at 0
  ode::TaylorBatch<Oscillators<double>> batch(system, options);
  batch.start(0, 0, {0, 0, 0}, {1, 1, 0});
  batch.start(1, 0, {0, 0, 0}, {0, 0, 0});  // nothing is watched
  batch.start(2, 0, {1, 0, 0}, {1, 1, 0});
  CHECK_FALSE(batch.advance(infinity<double>));
  CHECK(batch.status(0) == Status::not_finite);
  CHECK(batch.status(1) == Status::not_finite);
  CHECK(batch.status(2) == Status::step_limit);
  CHECK(batch.time(0) > 1e290);
  CHECK(batch.counts(2).steps == 1000);
  batch.start(0, 0, {0, 0, 0}, {1, 1, 0});
  batch.start(1, 0, {0, 0, 0}, {0, 0, 0});
  batch.start(2, 0, {1, 0, 0}, {1, 1, 0});
  CHECK_FALSE(batch.advance(bad));
  CHECK(batch.time(2) == 0);
}

namespace {

/// x' = 1 in the unit that a step finds, which it doubles where it ends.
struct Doubling {
  using Scalar = double;
  static constexpr int width = 1, carried = 1;
  template <int Order>
  struct Work {};
  template <int Order>
  void expand(const double (&unit)[8], double (&x)[Order + 1][1][8], Work<Order>&) const noexcept {
    for (int b = 0; b < 8; ++b)
      for (int k = 1; k <= Order; ++k) x[k][0][b] = k == 1 ? unit[b] : 0;
  }
  void settle(int first, double (&x)[1][8], double (&low)[1][8], double (&held)[1][8]) const noexcept {
    for (int b = first; b < first + wide_size<double>; ++b) x[0][b] = low[0][b] = 0, held[0][b] *= 2;
  }
};

static_assert(ode::BatchCarries<Doubling> && !ode::BatchCarries<Circles>);

}  // namespace

TEST_CASE("numbers that change between steps alone") {
  ode::TaylorBatch<Doubling> batch(Doubling{}, {1e-15});
  for (int b = 0; b < 8; ++b) batch.start(b, 0, {0, 1}, {1});
  ode::TaylorBatch<Doubling>::Ends ends{1, 1, 1, 1, -1, 1, 1, 1};
  batch.step(ends);
  CHECK(batch.state(0) == std::array<double, 2>{0, 2});
  CHECK(batch.state(4) == std::array<double, 2>{0, 1});
  CHECK(batch.at(0, 0.25) == std::array<double, 2>{0.25, 1});
  alignas(64) ode::TaylorBatch<Doubling>::Rows rows;
  batch.at({.5, .5, .5, .5, 0, .5, .5, .75}, rows);
  CHECK((rows[0][0] == .5 && rows[0][4] == 0 && rows[0][7] == .75));
  CHECK((rows[1][0] == 1 && rows[1][4] == 1));
  batch.kick(0, 1e-3);
  CHECK(batch.state(0)[1] == 2 * (1 + 1e-3 * 0.48));
  CHECK(batch.state(1)[1] == 2);
}
