// SPDX-License-Identifier: BSD-3-Clause
// Single solutions through the ladder, error estimate and columns included, at 2 and at 402 even times: the difference over 400 is what an output
// time costs. `allocations` counts those of one solution. Beside them the bare models, without error, at two times.
#include <benchmark/benchmark.h>

#include "../tests/allocations.hpp"
#include "gyrostat/ladder/deceleration/averaged_motion.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "studies.hpp"

namespace {

using namespace gyrostat;
using namespace studies;

/// A study at range(0) even times, by the ladder or by the rung of this name.
template <class Scene>
void solved(benchmark::State& state, Study<Scene> (*made)(), const char* rung) {
  Study<Scene> study = made();
  const double end = study.question.times.back();
  const auto count = std::size_t(state.range(0));
  study.question.times.clear();
  for (std::size_t i = 1; i <= count; ++i) study.question.times.push_back(end * double(i) / double(count));
  study.question.rung = place_of(study.family.rungs, rung);  // any_rung where there is none of this name
  const auto scene = study.scene_of(study.numbers, study.question);
  Refusal refusal;
  const std::size_t before = allocations();
  const Answer answer = study.solve(*scene, refusal, nullptr);
  state.counters["allocations"] = double(allocations() - before);
  state.SetLabel(refusal.code == Errc::ok ? answer.model : refusal.why);
  for (auto _ : state) benchmark::DoNotOptimize(study.solve(*scene, refusal, nullptr));
}

#define GYROSTAT_SOLVE_BENCH(study, rung) \
  BENCHMARK_CAPTURE(solved, study##_##rung, &study, #rung)->Arg(2)->Arg(402)->Unit(benchmark::kMicrosecond)
GYROSTAT_SOLVE_BENCH(despin, averaged);
GYROSTAT_SOLVE_BENCH(driven_rotor, full);
GYROSTAT_SOLVE_BENCH(spinner, linear);
GYROSTAT_SOLVE_BENCH(spinner, full);
GYROSTAT_SOLVE_BENCH(symmetric_top, exact);
GYROSTAT_SOLVE_BENCH(symmetric_top, full);
GYROSTAT_SOLVE_BENCH(fast_top, auto);
GYROSTAT_SOLVE_BENCH(free_body, auto);
GYROSTAT_SOLVE_BENCH(free_body, full);

void bare_averaged(benchmark::State& state) {
  const auto study = despin();
  const auto scene = study.scene_of(study.numbers, study.question);
  const auto& problem = scene->problem();
  for (auto _ : state) {
    const auto start = deceleration::polhode_through<double>(problem.inverse_inertia, problem.momentum);
    deceleration::AveragedMotion<math::Native, double> motion(problem, start, problem.momentum.norm(), 0, 1e-6,
                                                              infinity<double>);
    motion.advance(study.question.times.back(), 0, [](const deceleration::Polhode<double>&, double) {});
    benchmark::DoNotOptimize(motion.state());
  }
}
BENCHMARK(bare_averaged)->Unit(benchmark::kMicrosecond);

void bare_linear(benchmark::State& state) {
  const auto study = spinner();
  const auto scene = study.scene_of(study.numbers, study.question);
  for (auto _ : state) {
    const spinning::Linear<double> motion(scene->problem());
    for (const double t : study.question.times) benchmark::DoNotOptimize(motion.at(t));
  }
}
BENCHMARK(bare_linear)->Unit(benchmark::kMicrosecond);

void bare_closed_form(benchmark::State& state) {
  const auto study = free_body();
  free::Problem<double> problem;
  problem.inertia = Vec3<double>(35, 22, 16).asDiagonal();
  problem.angular_velocity = {.4, .55, .7};
  for (auto _ : state) {
    const auto motion = free::Motion<double>::make(problem);
    for (const double t : study.question.times) benchmark::DoNotOptimize(motion->at(t));
  }
}
BENCHMARK(bare_closed_form)->Unit(benchmark::kMicrosecond);

}  // namespace
