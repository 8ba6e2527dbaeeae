// SPDX-License-Identifier: BSD-3-Clause
// The forced motion of a fast spin on an even grid: closed form of second order and series of order 8, with and without attitude, one
// time alone, and Taylor series at 1e-9 over the same grid. Items are points; a period has 42. `error` is the motion's own estimate
// over the grid, the greater of rates over the spin and down; of Taylor none. bench/rivals_heyoka_heavy.py runs heyoka on this body.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/series.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "gyrostat/ode/taylor.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::heavy;

constexpr double spin = 150, cosine = 0.1;

const Problem<double>& body() {
  static const auto made =
      Problem<double>::make({0.0011, 0.0016, 0.0020}, 0.8, {0.012, 0.009, 0.010}, 9.80665, 4.617791555485795e-6)
          .value();
  return made;
}

struct Grid {
  std::vector<double> times;
  std::vector<State<double>> states;

  explicit Grid(std::int64_t n) : times(static_cast<std::size_t>(n)), states(times.size()) {
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = 1e-3 * static_cast<double>(i);
  }
};

template <class Motion>
void grid(benchmark::State& state, const Motion& motion) {
  Grid on(state.range(0));
  const bool turning = state.range(1) != 0;
  for (auto _ : state) {
    motion.at(on.times, on.states, turning);
    benchmark::ClobberMemory();
  }
  const auto error = motion.error(on.times.back());
  state.counters["error"] = std::max(error.angular_velocity / spin, error.down);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void series_2(benchmark::State& state) { grid(state, Series2<double>::make(body(), spin, cosine).value()); }
void series_8(benchmark::State& state) { grid(state, Series<double>::make(body(), spin, cosine, 8).value()); }

void series_2_at_one_time(benchmark::State& state) {
  const auto motion = Series2<double>::make(body(), spin, cosine).value();
  double t = 0;
  for (auto _ : state) benchmark::DoNotOptimize(motion.at(t += 0.37));
}

void make_series_2(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Series2<double>::make(body(), spin, cosine));
}
void make_series_8(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Series<double>::make(body(), spin, cosine, 8));
}

void taylor(benchmark::State& state) {
  using System = FullSystem<double>;
  Grid on(state.range(0));
  const System system(body(), Series<double>::make(body(), spin, cosine, 16).value().at(0));
  ode::TaylorOptions<double, System::width> options;
  options.tolerance = 1e-11;  // for a true error near 1e-9
  options.scale = system.scale();
  for (auto _ : state) {
    ode::Taylor<System> solver(system, 0, system.start(), options);
    alignas(32) double x[System::width];
    std::size_t next = 0;
    while (next < on.times.size()) {
      for (; next < on.times.size() && on.times[next] <= solver.time(); ++next) {
        solver.at(on.times[next], x);
        on.states[next] = system.state(x);
      }
      if (next < on.times.size()) (void)solver.step(on.times.back());
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void arguments(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"points", "attitude"});
  for (const int points : {128, 1024, 8192})
    for (const int turning : {0, 1}) bench->Args({points, turning});
}

BENCHMARK(series_2)->Apply(arguments);
BENCHMARK(series_8)->Apply(arguments);
BENCHMARK(taylor)->ArgName("points")->Arg(128)->Arg(1024)->Arg(8192);
BENCHMARK(series_2_at_one_time);
BENCHMARK(make_series_2);
BENCHMARK(make_series_8);

}  // namespace
