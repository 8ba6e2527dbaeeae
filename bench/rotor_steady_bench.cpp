// SPDX-License-Identifier: BSD-3-Clause
// All steady rotations of a gyrostat, their stability, its attractor and slow times: one call each, over random realisable bodies.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "gyrostat/ladder/rotor/fall_time.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::rotor;

struct Scene {
  Gyrostat<double> gyrostat;
  double norm;
  Vec3<double> momentum;
  double axial_momentum;
};

/// 1024 bodies with h/l from 0.1 to 3: 2, 4 and 6 steady rotations; those with `count` only, if it is given.
std::vector<Scene> scenes(int count = 0) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  std::normal_distribution<double> z;
  std::vector<Scene> all;
  while (all.size() < 1024) {
    Mat3<double> A;
    for (int i = 0; i < 9; ++i) A(i / 3, i % 3) = z(random);
    const Mat3<double> second = A * A.transpose();
    const Mat3<double> theta = second.trace() * Mat3<double>::Identity() - second;
    const Vec3<double> e = Vec3<double>(z(random), z(random), z(random)).normalized();
    const double lambda = 0.05 * u(random) * theta.trace();
    const double h = 0.1 * std::pow(30, u(random));
    const auto g = Gyrostat<double>::make((theta + theta.transpose()) / 2, e, lambda, 0.1, h / lambda);
    if (!g || !g->realisable()) continue;
    if (count > 0 && steady_rotations(*g, 1.0).count != count) continue;
    all.push_back({*g, 1, Vec3<double>(z(random), z(random), z(random)).normalized(), h});
  }
  return all;
}

template <class F>
void each(benchmark::State& state, const std::vector<Scene>& all, F f) {
  std::size_t i = 0;
  for (auto _ : state) {
    auto r = f(all[i]);
    benchmark::DoNotOptimize(r);
    i = (i + 1) % all.size();
  }
}

struct Table {
  SteadyRotations<double> rotations;
  SteadyStability<double> stability[8];
};

Table table(const Gyrostat<double>& g, double norm) {
  Table t;
  t.rotations = steady_rotations(g, norm);
  for (int i = 0; i < t.rotations.count; ++i) t.stability[i] = stability_of(g, norm, t.rotations[i]);
  return t;
}

void rotations(benchmark::State& state, int count) {
  each(state, scenes(count), [](const Scene& s) { return steady_rotations(s.gyrostat, s.norm); });
}

void rotations_and_stability(benchmark::State& state, int count) {
  each(state, scenes(count), [](const Scene& s) { return table(s.gyrostat, s.norm); });
}

/// From theta, lambda, e and the motor on: with the axes of theta and of R.
void from_the_tensor(benchmark::State& state) {
  each(state, scenes(), [](const Scene& s) {
    const auto& g = s.gyrostat;
    const auto made =
        Gyrostat<double>::make(g.inertia(), g.axis(), g.axial_inertia(), g.slope(), g.no_load_rate()).value();
    return table(made, s.norm);
  });
}

void attractor(benchmark::State& state) {
  each(state, scenes(), [](const Scene& s) {
    return certify(s.gyrostat, steady_rotations(s.gyrostat, s.norm), s.momentum, s.axial_momentum);
  });
}

void slow_time(benchmark::State& state) {
  each(state, scenes(2), [](const Scene& s) {
    const auto r = steady_rotations(s.gyrostat, s.norm);
    const double range = r[1].level - r[0].level;
    return time_between_levels(s.gyrostat, r, s.norm, 1, 0, r[1].level - 0.01 * range, r[0].level + 0.01 * range);
  });
}

BENCHMARK_CAPTURE(rotations, all, 0);
BENCHMARK_CAPTURE(rotations, two, 2);
BENCHMARK_CAPTURE(rotations, six, 6);
BENCHMARK_CAPTURE(rotations_and_stability, all, 0);
BENCHMARK_CAPTURE(rotations_and_stability, two, 2);
BENCHMARK_CAPTURE(rotations_and_stability, six, 6);
BENCHMARK(from_the_tensor);
BENCHMARK(attractor);
BENCHMARK(slow_time)->Unit(benchmark::kMillisecond);

}  // namespace
