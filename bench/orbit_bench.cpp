// SPDX-License-Identifier: BSD-3-Clause
// The free orbit of a gyrostat, its averages and the second order, one call each, over a set of random scenes of one type.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "gyrostat/models/deceleration/capture.hpp"
#include "gyrostat/models/deceleration/orbit_second_order.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::deceleration;

struct Scene {
  Problem<double> problem;
  Level<double> level;
  Component component;
};

/// 256 scenes with orbits of one type, not within 1e-3 of the separatrix.
std::vector<Scene> scenes(Regime regime, Law law) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  std::normal_distribution<double> z;
  std::vector<Scene> all;
  while (all.size() < 256) {
    double J[3];
    do {
      for (double& j : J) j = .05 + u(random);
      std::sort(J, J + 3);
    } while (J[2] > J[0] + J[1]);
    Problem<double> p;
    p.inverse_inertia = {1 / J[2], 1 / J[1], 1 / J[0]};
    const double size = std::pow(10, -2 * u(random));
    for (int i = 0; i < 3; ++i) {
      p.rotor_momentum[i] = size * z(random);
      p.momentum[i] = z(random);
    }
    p.control = Vec3<double>(.6e-3, .9e-3, 1e-3).asDiagonal();
    p.drag = .3e-3;
    p.law = p.drag_law = law;
    const auto o = Orbit<double>::through(p, p.momentum);
    if (o && o->regime() == regime && o->modulus().kp2 > 1e-3) all.push_back({p, o->level(), o->component()});
  }
  return all;
}

template <class F>
void each(benchmark::State& state, Regime regime, Law law, F f) {
  const auto all = scenes(regime, law);
  std::size_t i = 0;
  for (auto _ : state) {
    auto r = f(all[i]);
    benchmark::DoNotOptimize(r);
    i = (i + 1) % all.size();
  }
}

void orbit(benchmark::State& state, Regime regime) {
  each(state, regime, Law::total, [](const Scene& s) { return Orbit<double>::at(s.problem, s.level, s.component); });
}

void averages(benchmark::State& state, Regime regime, Law law) {
  each(state, regime, law, [](const Scene& s) { return average(s.problem, s.level, s.component); });
}

void order_two(benchmark::State& state, Regime regime, Law law) {
  each(state, regime, law, [](const Scene& s) { return second_order(s.problem, s.level, s.component); });
}

void critical(benchmark::State& state) {
  each(state, Regime::one_component, Law::total, [](const Scene& s) { return critical_levels(s.problem, s.level.R); });
}

BENCHMARK_CAPTURE(orbit, one_component, Regime::one_component);
BENCHMARK_CAPTURE(orbit, about_largest, Regime::about_largest);
BENCHMARK_CAPTURE(orbit, about_smallest, Regime::about_smallest);
BENCHMARK_CAPTURE(averages, one_component_total, Regime::one_component, Law::total);
BENCHMARK_CAPTURE(averages, one_component_carrier, Regime::one_component, Law::carrier);
BENCHMARK_CAPTURE(averages, about_largest_total, Regime::about_largest, Law::total);
BENCHMARK_CAPTURE(averages, about_smallest_carrier, Regime::about_smallest, Law::carrier);
BENCHMARK_CAPTURE(order_two, one_component_total, Regime::one_component, Law::total);
BENCHMARK_CAPTURE(order_two, about_largest_carrier, Regime::about_largest, Law::carrier);
BENCHMARK(critical);

}  // namespace
