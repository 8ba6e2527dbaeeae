// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/cvode_walk.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

bool decay(double, const double* y, double* rate, void*) {
  rate[0] = -y[0];
  return true;
}

ode::Cvode solver() {
  ode::CvodeSystem system;
  system.dimension = 1;
  system.rhs = &decay;
  const std::array<double, 1> start{1};
  auto made = ode::Cvode::create(system, 0, start, {ode::CvodeMethod::adams, 1e-10, 1e-12});
  REQUIRE(made);
  return std::move(made).value();
}

}  // namespace

TEST_CASE("CVODE walk: every time is kept once, in order", "[cvode]") {
  auto cvode = solver();
  const std::vector<double> times{0.0, 0.1, 0.1, 2.0, 5.0};
  std::vector<double> kept{1};
  std::size_t next = 1;
  ode::Counts counts;
  Monitor monitor;
  int moves = 0;
  const auto keep = [&](double t) {
    std::array<double, 1> y{};
    CHECK(t == times[next]);
    if (!cvode.at(t, y)) return false;
    kept.push_back(y[0]);
    return true;
  };
  REQUIRE(walk(cvode, times, next, counts, &monitor, keep, [&] { return ++moves, true; }) == Errc::ok);
  REQUIRE(kept.size() == times.size());
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(std::abs(kept[i] - std::exp(-times[i])) < 1e-8);
  CHECK(counts.steps == std::uint64_t(moves));
  CHECK(monitor.fraction.load() == 1);
}

TEST_CASE("CVODE walk: ends where it is asked to, by the caller or by what was found", "[cvode]") {
  const std::vector<double> times{1.0, 50.0};
  ode::Counts counts;
  std::size_t next = 0;
  auto cvode = solver();
  CHECK(walk(
            cvode, times, next, counts, nullptr, [](double) { return true; }, [&] { return cvode.time() < 2; }) ==
        Errc::ok);
  CHECK(next == 1);
  CHECK(cvode.time() < 50);

  Monitor monitor;
  monitor.cancel = true;
  next = 0;
  auto second = solver();
  CHECK(
      walk(second, times, next, counts, &monitor, [](double) { return true; }, [] { return true; }) == Errc::cancelled);

  next = 0;
  auto third = solver();
  CHECK(walk(
            third, times, next, counts, nullptr, [](double) { return false; }, [] { return true; }) ==
        Errc::no_convergence);
}
