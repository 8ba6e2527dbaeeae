// SPDX-License-Identifier: BSD-3-Clause
// Rows of a driven rotor that `full` answers, by the ladder one by one and by the solver of sweeps in lanes, errors included. Argument: -log10 of
// the tolerance. The time is that of 512 rows; the counter `error` is the mean of the stated ones, `answered` how many rows had an answer.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "gyrostat/ladder/rotor/inputs.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::rotor;

constexpr std::size_t rows = 512, at_once = SweepSolver::width;

std::vector<Scene> scenes(double tolerance) {
  std::vector<double> numbers(input_width(input_kinds), gyrostat::nan<double>);
  const double body[] = {3.2, .1, -.15, .1, 4.1, .2, -.15, .2, 5}, rotor[] = {.36, .48, .8, .35},
               rest[] = {.05, 30., .1, .2, .3, -1., 0., 0., 0., 1.};
  std::copy(std::begin(body), std::end(body), numbers.begin());
  std::copy(std::begin(rotor), std::end(rotor), numbers.begin() + 19);
  std::copy(std::begin(rest), std::end(rest), numbers.begin() + 28);
  Question question;
  question.times = {50, 100};
  question.tolerance = tolerance;
  question.asked = {{column::angular_velocity}};
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal(1, .01);
  std::vector<Scene> all;
  for (std::size_t i = 0; i < rows; ++i) {
    auto own = numbers;
    own[0] *= normal(engine), own[28] *= normal(engine);
    all.push_back(*scene_of(own, question));
  }
  return all;
}

template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  const auto all = scenes(std::pow(10.0, -double(state.range(0))));
  std::vector<Answer> answers(rows);
  int answered = 0;
  for (auto _ : state) {
    answered = solve(all, answers);
    benchmark::ClobberMemory();
  }
  double error = 0;
  for (const Answer& each : answers) error += each.error / double(rows);
  state.counters["error"] = error;
  state.counters["answered"] = answered;
}

void by_the_ladder(benchmark::State& state) {
  measure(state, [](const auto& all, auto& answers) {
    for (std::size_t i = 0; i < rows; ++i) {
      Refusal refusal;
      answers[i] = solve(all[i], refusal);
    }
    return int(rows);
  });
}

void in_lanes(benchmark::State& state) {
  measure(state, [](const auto& all, auto& answers) {
    int answered = 0;
    for (std::size_t i = 0; i < rows; i += at_once)
      for (unsigned bits = solve_together(std::span(all).subspan(i, at_once), std::span(answers).subspan(i, at_once));
           bits != 0; bits &= bits - 1)
        ++answered;
    return answered;
  });
}

BENCHMARK(by_the_ladder)->Arg(6)->Arg(9)->Unit(benchmark::kMillisecond);
BENCHMARK(in_lanes)->Arg(6)->Arg(9)->Unit(benchmark::kMillisecond);

}  // namespace
