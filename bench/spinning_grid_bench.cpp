// SPDX-License-Identifier: BSD-3-Clause
// The linear motion of a spinning body: whole grids of 13 quantities by each kernel beside the mere writing of as many numbers,
// their tables, and single times. Items are points. bench/rivals_numpy_spinning.py times numpy on the same scene.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/linear_grid.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::spinning;

constexpr double step = 0.01;

Problem<double> stage(bool resonant = false) {
  Problem<double> p;
  p.inertia = {8.7, 8.2, 11.1};
  p.mass = 10;
  p.charge_momentum = 0.29;
  p.rotor_momentum = resonant ? p.charge_momentum - 11.1 * 1.1 + 1e-9 : 1.3;  // X = 1e-9
  p.torque = {0.4, -0.27, 0};
  p.force = {0.7, -1.1, 3};
  p.angular_velocity = {0.02, -0.03, 1.1};
  p.angles = {0.05, -0.02, 0.3};
  p.velocity = {0.1, -0.2, 0.3};
  p.position = {1, 2, 3};
  return p;
}

/// 13 arrays in one allocation, each on a boundary of 64 bytes.
struct Arrays {
  std::vector<double> memory;
  double* column[13];

  explicit Arrays(std::size_t n) : memory(13 * ((n + 7) / 8 * 8 + 8) + 8) {
    auto* begin = reinterpret_cast<double*>((reinterpret_cast<std::uintptr_t>(memory.data()) + 63) / 64 * 64);
    for (auto*& c : column) {
      c = begin;
      begin += (n + 7) / 8 * 8 + 8;
    }
  }
  GridColumns<double> columns() const {
    const auto& c = column;
    return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11], c[12]};
  }
};

void count(benchmark::State& state, std::size_t points) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}

void grid(benchmark::State& state, GridKernel kernel) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Arrays arrays(n);
  const LinearGrid<double> linear(stage(kernel == GridKernel::blocks), 0, step, n, kernel);
  const auto columns = arrays.columns();
  for (auto _ : state) {
    linear.write(0, n, columns);
    benchmark::ClobberMemory();
  }
  count(state, n);
}

void stores_only(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Arrays arrays(n);
  for (auto _ : state) {
    for (std::size_t i = 0; i < n; i += 256) {
      const std::size_t m = n - i < 256 ? n - i : 256;
      for (int k = 0; k < 13; ++k) {
        double* __restrict to = arrays.column[k] + i;
        const double value = 1.5 * k;
        for (std::size_t j = 0; j < m; ++j) to[j] = value;
      }
      benchmark::ClobberMemory();
    }
  }
  count(state, n);
}

void tables(benchmark::State& state, GridKernel kernel) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto problem = stage(kernel == GridKernel::blocks);
  for (auto _ : state) {
    const LinearGrid<double> linear(problem, 0, step, n, kernel);
    benchmark::DoNotOptimize(&linear);
  }
}

/// One time after the other, each some part of `range` ms.
void single_time(benchmark::State& state) {
  const Linear<double> linear(stage());
  const double t = 1e-3 * static_cast<double>(state.range(0));
  double sum = 0, at = 0;
  for (auto _ : state) {
    at = at < 0.999 ? at + 0.001 : 0.7;
    const auto s = linear.at(t * at);
    sum += s.position[0] + s.attitude.w;
  }
  benchmark::DoNotOptimize(sum);
  count(state, 1);
}

void preparation(benchmark::State& state) {
  auto problem = stage();
  for (auto _ : state) {
    problem.rotor_momentum += 1e-9;
    const Linear<double> linear(problem);
    benchmark::DoNotOptimize(&linear);
  }
}

void error_estimates(benchmark::State& state) {
  auto problem = stage();
  for (auto _ : state) {
    problem.rotor_momentum += 1e-9;
    auto errors = linear_errors(problem, 100.0);
    benchmark::DoNotOptimize(errors);
  }
}

BENCHMARK(stores_only)->Arg(128)->Arg(1024)->Arg(8192)->Arg(2000000);
BENCHMARK_CAPTURE(grid, modes, GridKernel::modes)->Arg(128)->Arg(1024)->Arg(8192)->Arg(2000000);
BENCHMARK_CAPTURE(grid, blocks, GridKernel::blocks)->Arg(1024)->Arg(8192)->Arg(100000)->Arg(2000000);
BENCHMARK_CAPTURE(grid, points, GridKernel::points)->Arg(8192);
BENCHMARK_CAPTURE(tables, modes, GridKernel::modes)->Arg(8192);
BENCHMARK_CAPTURE(tables, blocks, GridKernel::blocks)->Arg(8192)->Arg(2000000);
BENCHMARK(single_time)->Arg(1)->Arg(300)->Arg(1000)->Arg(2000)->Arg(5000)->Arg(1000000);
BENCHMARK(preparation);
BENCHMARK(error_estimates);

}  // namespace
