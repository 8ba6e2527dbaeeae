// SPDX-License-Identifier: BSD-3-Clause
// Sweeps: rows a second and core, of one scene of each family two of whose numbers vary. `alone` makes each scene and calls the ladder in a
// loop; `swept` does the same rows by gyrostat::sweep on 1 and 2 threads. CPU time of all threads, errors included; what is asked is one
// column at two times (`once`, `fast_top`: one), and of a despin when it stops.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "gyrostat/ladder/deceleration/inputs.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/ladder/free/inputs.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/ladder/heavy/inputs.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/ladder/rotor/inputs.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/ladder/spinning/inputs.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/ladder/sweep.hpp"

namespace {

using namespace gyrostat;

constexpr double none = gyrostat::nan<double>;
constexpr std::size_t rows = 512;

/// A family's functions, and a scene of which two numbers vary by a hundredth.
template <class Scene>
struct Study {
  const Family& family;
  Result<Scene> (*scene_of)(std::span<const double>, const Question&);
  Answer (*solve)(const Scene&, Refusal&, Monitor*);
  std::vector<double> numbers;
  std::size_t places[2];
  Question question;
};

Question asked(std::vector<double> times, double tolerance, std::vector<AskedQuantity> what) {
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  question.asked = std::move(what);
  return question;
}

Study<deceleration::Scene> despin() {
  using namespace deceleration;
  return {tables,
          &deceleration::scene_of,
          &deceleration::solve<>,
          {16403, 0,      0, 0, 70915, 0,    0,    0,    76392, 0,    0,    0,    .06,  .05,
           .04,   1.2e-6, 0, 0, none,  none, none, none, .012,  .008, .032, none, none, none},
          {0, 12},
          asked({20000, 40000}, 1e-2, {{column::angular_momentum_norm}, {scalar::stop_time, true}})};
}

Study<rotor::Scene> driven_rotor() {
  std::vector<double> numbers{3.2, .1, -.15, .1, 4.1, .2, -.15, .2, 5};
  numbers.insert(numbers.end(), 10, none);
  for (const double number :
       {.36, .48, .8, .35, none, none, none, none, none, .05, 30., .1, .2, .3, -1., 0., 0., 0., 1.})
    numbers.push_back(number);
  return {rotor::tables,      &rotor::scene_of, &rotor::solve,
          std::move(numbers), {0, 28},          asked({50, 100}, 1e-6, {{rotor::column::angular_velocity}})};
}

Study<spinning::Scene> spinner() {
  return {spinning::tables,
          &spinning::scene_of,
          &spinning::solve,
          {8,    7,    11,   10,   1.3,  none,  none, none, none, none, 4e-4, -2e-4, 0, 0, 0, 3,
           none, none, none, none, 2e-4, -3e-4, 1,    0,    0,    0,    0,    0,     0, 0, 0, 0},
          {0, 10},
          asked({50, 100}, 1e-3, {{spinning::column::angular_velocity}})};
}

Study<heavy::Scene> symmetric_top() {
  return {heavy::tables,
          &heavy::scene_of,
          &heavy::solve,
          {.0016, 0,    0,  0,   .0016, 0,  0, 0,  .002, .8,   0,    0,    .01,  9.80665,
           none,  none, .1, -.2, 40,    .6, 0, .8, none, none, none, none, none, none},
          {9, 18},
          asked({5, 10}, 1e-6, {{heavy::column::angular_velocity}})};
}

Study<free::Scene> free_body() {
  return {free::tables,
          &free::scene_of,
          &free::solve,
          {35,   0,    0,    0, 22, 0, 0, 0,    16,   0,    0,    0,    .4,   .55, .7,
           none, none, none, 0, 0,  0, 1, none, none, none, none, none, none, none},
          {0, 12},
          asked({5000, 10000}, 1e-6, {{free::column::angular_velocity}})};
}

Study<spinning::Scene> spinner_once() {
  auto study = spinner();
  study.question.times = {100};
  return study;
}

Study<heavy::Scene> fast_top() {
  return {heavy::tables,
          &heavy::scene_of,
          &heavy::solve,
          {.0011, 0,    0, 0, .0016, 0,    0, 0,  .002, .8,   .012, .009, .01,  9.80665,
           none,  none, 0, 0, 1500,  .995, 0, .1, none, none, none, none, none, none},
          {9, 13},
          asked({.04}, 1e-3, {{heavy::column::angular_velocity}})};
}

Study<free::Scene> gyrostat_once() {
  auto study = free_body();
  study.numbers[9] = 3, study.numbers[10] = -2, study.numbers[11] = 5;
  study.question = asked({100}, 1e-6, {{free::column::attitude}});
  return study;
}

/// What sweeps take for the ladder.
template <class Scene>
auto solver_of(const Study<Scene>& study) {
  return study.solve;
}
free::SweepSolver solver_of(const Study<free::Scene>&) { return {}; }

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
