// SPDX-License-Identifier: BSD-3-Clause
// 64 spin-ups (docs/rotor.md, section 7), 200 s each, one by one and eight at a time. Argument: -log10 of the step tolerance. The time is
// that of all 64. `spread` mixes the motors, so that the problems differ in their steps. The counter `error` is the greatest true angle
// between the attitudes, rad, against long double; `step` is the time of a step of one trajectory, ns.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/full_batch.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/ode/taylor_batch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

constexpr double t_end = 200;
constexpr std::size_t count = 64;

template <Real S>
struct Scene {
  Gyrostat<S> body;
  State<S> start;
};

/// All alike but for the rate of the rotor at the start; spread: bodies and motors differ too.
template <Real S>
std::vector<Scene<S>> scenes(bool spread) {
  std::vector<Scene<S>> all;
  for (std::size_t i = 0; i < count; ++i) {
    const S share = static_cast<S>(static_cast<double>(i) / count);
    const Vec3<S> e(S(0.36L), S(0.48L), S(0.8L));
    Mat3<S> theta = S(0.45L) * e * e.transpose();
    theta.diagonal() += Vec3<S>(S(2.3L) + (spread ? share : 0), S(2.9L), S(3.4L));
    const auto body =
        Gyrostat<S>::make(theta, e, S(0.45L), S(0.05L) + (spread ? share / 2 : 0), 30 - (spread ? 20 * share : 0))
            .value();
    State<S> start;
    const Vec3<S> m(S(0.5L), S(-0.7L), S(0.45L));
    start.momentum = 8 * m / std::sqrt(m.squaredNorm());
    start.axial_momentum =
        body.axial_inertia() * body.coupling() * (share + body.axis().dot(body.free_inverse() * start.momentum));
    all.push_back({body, start});
  }
  return all;
}

template <Real S, int Order = 20>
Quat<S> single(const Scene<S>& scene, S tolerance, std::uint64_t& steps) {
  const FullSystem<S> system(scene.body, scene.start);
  ode::TaylorOptions<S, FullSystem<S>::width> options;
  options.tolerance = tolerance;
  options.scale = system.scale();
  ode::Taylor<FullSystem<S>, Order> solver(system, 0, system.start(), options);
  solver.advance(t_end);
  steps += solver.counts().steps;
  return system.state(t_end, solver.state()).attitude;
}

const std::vector<Quat<long double>>& reference(bool spread) {
  static const auto solve = [](bool mixed) {
    std::vector<Quat<long double>> answers;
    std::uint64_t steps = 0;
    for (const auto& scene : scenes<long double>(mixed)) answers.push_back(single<long double>(scene, 1e-19L, steps));
    return answers;
  };
  static const std::vector<Quat<long double>> alike = solve(false), mixed = solve(true);
  return spread ? mixed : alike;
}

template <class Solve>
void measure(benchmark::State& state, bool spread, const Solve& solve) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const auto all = scenes<double>(spread);
  std::vector<Quat<double>> ends(count);
  std::uint64_t steps = 0;
  for (auto _ : state) {
    solve(all, tolerance, ends, steps);
    benchmark::DoNotOptimize(ends);
  }
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Quat<long double> apart =
        conjugate(reference(spread)[i]) * Quat<long double>{ends[i].w, ends[i].x, ends[i].y, ends[i].z};
    worst = std::max(worst, static_cast<double>(2 * std::hypot(apart.x, apart.y, apart.z)));
  }
  state.counters["error"] = worst;
  state.counters["step"] =
      benchmark::Counter(static_cast<double>(steps) * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <bool spread>
void one_by_one(benchmark::State& state) {
  measure(state, spread, [](const auto& all, double tolerance, auto& ends, std::uint64_t& steps) {
    for (std::size_t i = 0; i < count; ++i) ends[i] = single(all[i], tolerance, steps);
  });
}

template <bool spread>
void eight_at_a_time(benchmark::State& state) {
  using Batch = ode::TaylorBatch<FullBatch<double>>;
  measure(state, spread, [](const auto& all, double tolerance, auto& ends, std::uint64_t& steps) {
    ode::TaylorBatchOptions<double> options;
    options.tolerance = tolerance;
    Batch batch(FullBatch<double>{}, options);
    ode::run_all(
        batch, count,
        [&](std::size_t i, int b) {
          batch.system().set(b, all[i].body, all[i].start);
          batch.start(b, 0, batch.system().start(b), batch.system().scale(b));
          return t_end;
        },
        [&](std::size_t i, int b) {
          ends[i] = batch.system().state(b, t_end, batch.state(b)).attitude;
          steps += batch.counts(b).steps;
        });
  });
}

BENCHMARK(one_by_one<false>)->Arg(8)->Arg(12)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(eight_at_a_time<false>)->Arg(8)->Arg(12)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(one_by_one<true>)->Arg(8)->Arg(12)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(eight_at_a_time<true>)->Arg(8)->Arg(12)->Arg(16)->Unit(benchmark::kMillisecond);

}  // namespace
