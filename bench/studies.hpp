// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// One scene of each family, for the benchmarks of sweeps and of single solutions.
namespace studies {

using namespace gyrostat;

inline constexpr double none = gyrostat::nan<double>;
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

inline Question asked(std::vector<double> times, double tolerance, std::vector<AskedQuantity> what) {
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  question.asked = std::move(what);
  return question;
}

inline Study<deceleration::Scene> despin() {
  using namespace deceleration;
  return {tables,
          &deceleration::scene_of,
          &deceleration::solve<>,
          {16403, 0,      0, 0, 70915, 0,    0,    0,    76392, 0,    0,    0,    .06,  .05,
           .04,   1.2e-6, 0, 0, none,  none, none, none, .012,  .008, .032, none, none, none},
          {0, 12},
          asked({20000, 40000}, 1e-2, {{column::angular_momentum_norm}, {scalar::stop_time, true}})};
}

inline Study<rotor::Scene> driven_rotor() {
  std::vector<double> numbers{3.2, .1, -.15, .1, 4.1, .2, -.15, .2, 5};
  numbers.insert(numbers.end(), 10, none);
  for (const double number :
       {.36, .48, .8, .35, none, none, none, none, none, .05, 30., .1, .2, .3, -1., 0., 0., 0., 1.})
    numbers.push_back(number);
  return {rotor::tables,      &rotor::scene_of, &rotor::solve,
          std::move(numbers), {0, 28},          asked({50, 100}, 1e-6, {{rotor::column::angular_velocity}})};
}

inline Study<spinning::Scene> spinner() {
  return {spinning::tables,
          &spinning::scene_of,
          &spinning::solve,
          {8,    7,    11,   10,   1.3,  none,  none, none, none, none, 4e-4, -2e-4, 0, 0, 0, 3,
           none, none, none, none, 2e-4, -3e-4, 1,    0,    0,    0,    0,    0,     0, 0, 0, 0},
          {0, 10},
          asked({50, 100}, 1e-3, {{spinning::column::angular_velocity}})};
}

inline Study<heavy::Scene> symmetric_top() {
  return {heavy::tables,
          &heavy::scene_of,
          &heavy::solve,
          {.0016, 0,    0,  0,   .0016, 0,  0, 0,  .002, .8,   0,    0,    .01,  9.80665,
           none,  none, .1, -.2, 40,    .6, 0, .8, none, none, none, none, none, none},
          {9, 18},
          asked({5, 10}, 1e-6, {{heavy::column::angular_velocity}})};
}

inline Study<free::Scene> free_body() {
  return {free::tables,
          &free::scene_of,
          &free::solve,
          {35,   0,    0,    0, 22, 0, 0, 0,    16,   0,    0,    0,    .4,   .55, .7,
           none, none, none, 0, 0,  0, 1, none, none, none, none, none, none, none},
          {0, 12},
          asked({5000, 10000}, 1e-6, {{free::column::angular_velocity}})};
}

inline Study<spinning::Scene> spinner_once() {
  auto study = spinner();
  study.question.times = {100};
  return study;
}

inline Study<heavy::Scene> fast_top() {
  return {heavy::tables,
          &heavy::scene_of,
          &heavy::solve,
          {.0011, 0,    0, 0, .0016, 0,    0, 0,  .002, .8,   .012, .009, .01,  9.80665,
           none,  none, 0, 0, 1500,  .995, 0, .1, none, none, none, none, none, none},
          {9, 13},
          asked({.04}, 1e-3, {{heavy::column::angular_velocity}})};
}

inline Study<free::Scene> gyrostat_once() {
  auto study = free_body();
  study.numbers[9] = 3, study.numbers[10] = -2, study.numbers[11] = 5;
  study.question = asked({100}, 1e-6, {{free::column::attitude}});
  return study;
}

}  // namespace studies
