// SPDX-License-Identifier: BSD-3-Clause
// Sweeps: rows a second and core, of one scene of each family two of whose numbers vary. `alone` makes each scene and calls the ladder in a
// loop; `swept` does the same rows by gyrostat::sweep on 1 and 2 threads. CPU time of all threads, errors included; what is asked is one
// column at two times (`once`, `fast_top`: one), and of a despin when it stops.
#include <benchmark/benchmark.h>

#include <random>
#include <span>
#include <vector>

#include "gyrostat/ladder/sweep.hpp"
#include "studies.hpp"

namespace {

using namespace gyrostat;
using namespace studies;

constexpr std::size_t rows = 512;

/// What sweeps take for the ladder.
template <class Scene>
auto solver_of(const Study<Scene>& study) {
  return study.solve;
}
free::SweepSolver solver_of(const Study<free::Scene>&) { return {}; }
rotor::SweepSolver solver_of(const Study<rotor::Scene>&) { return {}; }

template <class Scene>
std::vector<std::vector<double>> values_of(const Study<Scene>& study) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal(1, .01);
  std::vector<std::vector<double>> values(2, std::vector<double>(rows));
  for (std::size_t i = 0; i < 2; ++i)
    for (double& value : values[i]) value = study.numbers[study.places[i]] * normal(engine);
  return values;
}

/// Says which rung answered.
template <class Scene>
void label(benchmark::State& state, const Study<Scene>& study) {
  Refusal refusal;
  const Answer answer = study.solve(*study.scene_of(study.numbers, study.question), refusal, nullptr);
  state.SetLabel(refusal.code == Errc::ok ? answer.model : refusal.why);
  state.SetItemsProcessed(state.iterations() * std::int64_t(rows));
}

template <class Scene>
void alone(benchmark::State& state, Study<Scene> (*made)()) {
  const Study<Scene> study = made();
  const auto values = values_of(study);
  std::vector<double> numbers = study.numbers;
  for (auto _ : state)
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < 2; ++i) numbers[study.places[i]] = values[i][row];
      Refusal refusal;
      benchmark::DoNotOptimize(study.solve(*study.scene_of(numbers, study.question), refusal, nullptr));
    }
  label(state, study);
}

template <class Scene>
void swept(benchmark::State& state, Study<Scene> (*made)()) {
  const Study<Scene> study = made();
  const auto values = values_of(study);
  const Varied varied[] = {{study.places[0], values[0]}, {study.places[1], values[1]}};
  std::vector<std::vector<double>> found;
  for (const AskedQuantity& each : study.question.asked) {
    const std::size_t width = each.scalar ? 1 : 2 * std::size_t(study.family.columns[each.place].width);
    found.emplace_back(rows * width), found.emplace_back(rows);
  }
  std::vector<SweepTarget> targets;
  for (std::size_t i = 0; i < study.question.asked.size(); ++i) {
    const AskedQuantity& each = study.question.asked[i];
    targets.push_back({each.place, each.scalar, found[2 * i].size() / rows, found[2 * i], found[2 * i + 1]});
  }
  std::vector<SweepRow> told(rows);
  const auto posed = [&](std::span<const double> numbers) { return study.scene_of(numbers, study.question); };
  for (auto _ : state) {
    sweep(study.family, study.numbers, varied, posed, solver_of(study), targets, told, unsigned(state.range(0)));
    benchmark::ClobberMemory();
  }
  label(state, study);
}

#define GYROSTAT_SWEEP_BENCH(name)                                \
  BENCHMARK_CAPTURE(alone, name, &name)->MeasureProcessCPUTime(); \
  BENCHMARK_CAPTURE(swept, name, &name)->Arg(1)->Arg(2)->MeasureProcessCPUTime()
GYROSTAT_SWEEP_BENCH(despin);
GYROSTAT_SWEEP_BENCH(driven_rotor);
GYROSTAT_SWEEP_BENCH(spinner);
GYROSTAT_SWEEP_BENCH(spinner_once);
GYROSTAT_SWEEP_BENCH(symmetric_top);
GYROSTAT_SWEEP_BENCH(fast_top);
GYROSTAT_SWEEP_BENCH(free_body);
GYROSTAT_SWEEP_BENCH(gyrostat_once);

}  // namespace
