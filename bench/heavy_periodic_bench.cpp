// SPDX-License-Identifier: BSD-3-Clause
// Periodic motions of heavy bodies, one call each: 256 random bodies with c = 1 rad/s at c/r0 = 0.05 and 0.3, with multipliers and errors;
// the family of one body; a swing; a motion of trace 550 by collocation. The counter `shots` is the mean number of runs until it closed,
// `failures` how many bodies had none.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "gyrostat/ladder/heavy/periodic_family.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/swing_orbit.hpp"
#include "gyrostat/ladder/heavy/unstable_orbit.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Problem<double> body(double a, double b, const Vec3<double>& direction, double k) {
  return Problem<double>::make({a, b, 1}, 1, direction / 128, 128, k).value();
}

struct Case {
  Problem<double> problem;
  double G0;
};

std::vector<Case> cases() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Case> all;
  while (all.size() < 256) {
    const double a = .2 + 1.8 * u(random), b = .2 + 1.8 * u(random), k = u(random);
    const Vec3<double> direction(u(random) - .5, u(random) - .5, u(random) - .5);
    const double G0 = .6 * u(random) - .3;
    if (std::abs(1 - a) < .1 || std::abs(1 - b) < .1 || a + b < 1.1 || std::abs(a - b) > .9 || direction.norm() < .1)
      continue;
    all.push_back({body(a, b, direction.normalized(), k), G0});
  }
  return all;
}

void orbits(benchmark::State& state) {
  const auto all = cases();
  const double spin = 100. / static_cast<double>(state.range(0));
  std::size_t i = 0, shots = 0, failures = 0, done = 0;
  for (auto _ : state) {
    const auto orbit = periodic_orbit(all[i].problem, spin, all[i].G0);
    benchmark::DoNotOptimize(orbit->period);
    shots += static_cast<std::size_t>(orbit->shots);
    failures += orbit ? 0 : 1;
    ++done;
    i = (i + 1) % all.size();
  }
  state.counters["shots"] = static_cast<double>(shots) / static_cast<double>(done);
  state.counters["failures"] = static_cast<double>(failures) * 256 / static_cast<double>(done);
}
BENCHMARK(orbits)->ArgName("100 c/r0")->Arg(5)->Arg(30)->Unit(benchmark::kMicrosecond);

void family(benchmark::State& state) {
  const auto p = body(.55, .8, {.6, .48, .64}, .7);
  for (auto _ : state) {
    const auto made = periodic_family(p, 5., .1);
    state.counters["members"] = static_cast<double>(made->members.size());
  }
}
BENCHMARK(family)->Unit(benchmark::kMillisecond);

void swing(benchmark::State& state) {
  const auto p = body(.55, .8, {.6, .48, .64}, .7);
  for (auto _ : state) {
    const auto orbit = swing_orbit(p, 0, 0.8);
    benchmark::DoNotOptimize(orbit->period);
  }
}
BENCHMARK(swing)->Unit(benchmark::kMicrosecond);

void collocation(benchmark::State& state) {
  const auto p = body(.55, .8, {.6, .48, .64}, .7);
  const auto shot = periodic_orbit(p, .645, .1);
  for (auto _ : state) {
    const auto orbit = unstable_orbit(p, *shot);
    benchmark::DoNotOptimize(orbit->period);
    state.counters["trace"] = orbit->trace_minus_4;
  }
}
BENCHMARK(collocation)->Unit(benchmark::kMillisecond);

}  // namespace
