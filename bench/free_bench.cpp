// SPDX-License-Identifier: BSD-3-Clause
// Free motions in closed form. Time: one evaluation (rates and attitude) beside libm's sine and cosine and beside the elliptic functions
// and the integral of the third kind of GSL that the classical formulas need; a point of an even grid; the set-up in double and in
// double-double; eight bodies side by side, set up and at one time; the estimate of the error, and its quick form. Accuracy: median and greatest error over
// random bodies of every regime, 1.05 to 1.5 periods on, against Taylor series of 113 bits, with the set-up in two words and in one, and the greatest
// effect of a rounding of every datum; after many passages of an unstable rotation; and after 1e4 to 1e9 periods.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../tests/models/free/gyrostats.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/free/motion_lanes.hpp"
#include "quad.hpp"
#ifdef GYROSTAT_HAVE_GSL
#include "gyrostat/math/gsl.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Motion;

enum class Scene { rigid, rigid_separatrix, one_component, lobe, gyrostat_separatrix };

Problem<double> problem(Scene scene) {
  const Vec3<double> J(35, 22, 16);
  const Quat<double> q = normalised(Quat<double>{.927, .1, -.3, .2});
  switch (scene) {
    case Scene::rigid: return Problem<double>::from_moments(J, {0, 0, 0}, {.4, .55, .7}, q);
    case Scene::rigid_separatrix: return Problem<double>::from_moments(J, {0, 0, 0}, {1e-5, .55, 1e-6}, q);
    case Scene::one_component: return Problem<double>::from_moments(J, {5, -3, 2}, {.2, .3, -.35}, q);
    case Scene::lobe: return Problem<double>::from_moments(J, {-.4, .6, 1.2}, {.1, -.3, 1.4}, q);
    case Scene::gyrostat_separatrix: return Problem<double>::from_moments(J, {0, 3, 0}, {0, .9, 1e-5}, q);
  }
  return {};
}

void sine_and_cosine(benchmark::State& state) {
  double x = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(std::sin(x) + std::cos(x));
    x += .37;
  }
}

#ifdef GYROSTAT_HAVE_GSL
void gsl_functions_and_third_kind(benchmark::State& state) {
  const auto m = math::Modulus<double>::from_k2(.74271);
  double u = 0;
  for (auto _ : state) {
    const auto j = math::Gsl::jacobi(u, m);
    benchmark::DoNotOptimize(j);
    benchmark::DoNotOptimize(math::Gsl::incomplete_Pi(j.am, -.3, m));
    u += .037;
  }
}
BENCHMARK(gsl_functions_and_third_kind);
#endif

void evaluation(benchmark::State& state, Scene scene) {
  const auto m = *Motion<double>::make(problem(scene));
  double t = 0;
  for (auto _ : state) {
    auto s = m.at(t);
    benchmark::DoNotOptimize(s);
    t += .37;
  }
}

void grid_point(benchmark::State& state, Scene scene) {
  const auto m = *Motion<double>::make(problem(scene));
  constexpr std::size_t n = 4096;
  std::vector<double> w(3 * n), q(4 * n);
  for (auto _ : state) {
    m.grid(0, .037, n, w.data(), q.data(), nullptr);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(n));
}

template <class Setup>
void set_up(benchmark::State& state, Scene scene) {
  auto p = problem(scene).cast<Setup>();
  for (auto _ : state) {
    auto m = Motion<double>::make<Setup>(p);
    benchmark::DoNotOptimize(m);
  }
}

void set_up_double(benchmark::State& state, Scene scene) { set_up<double>(state, scene); }
void set_up_double_double(benchmark::State& state, Scene scene) { set_up<DoubleDouble>(state, scene); }

template <class Setup>
void stated_error(benchmark::State& state) {
  const gyrostat::free::Assembly<double> given{problem(Scene::lobe), {}};
  for (auto _ : state) {
    auto error = gyrostat::free::MotionError<double>::of<Setup>(given, gyrostat::free::Data::rounded, 100);
    benchmark::DoNotOptimize(error);
  }
}

/// Eight bodies side by side, the given one and others near it; an item is a body, set up and at one time.
void side_by_side(benchmark::State& state, Scene scene) {
  using gyrostat::free::MotionLanes;
  Bodies bodies(9);
  const auto p = problem(scene);
  MotionLanes lanes;
  for (int b = 0; b < MotionLanes::size; ++b) {
    auto near = p;
    near.angular_velocity *= bodies.uniform(.9, 1.1);
    lanes.set(b, b + 1, gyrostat::free::PrincipalProblem<double>::of(near), near.attitude);
  }
  MotionLanes::Row t = {1, 2, 3, 4, 5, 6, 7, 8};
  if (lanes.make() != (1u << MotionLanes::size) - 1) state.SkipWithError("not all are tame");
  for (auto _ : state) {
    lanes.make();
    auto s = lanes.at(t);
    benchmark::DoNotOptimize(s);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * MotionLanes::size);
}

/// Of a motion that is there.
void quick_error(benchmark::State& state, Scene scene) {
  const gyrostat::free::Assembly<double> given{problem(scene), {}};
  const auto motion = *Motion<double>::make(given.body);
  for (auto _ : state) {
    auto error = gyrostat::free::MotionError<double>::quick(motion, given, 100);
    benchmark::DoNotOptimize(error);
  }
}

void accuracy(benchmark::State& state, Regime regime) {
  std::vector<double> rates[3], attitude[3];  // set-up in two words, in one; data
  for (auto _ : state) {
    Bodies bodies(7);
    for (int i = 0; i < 240; ++i) {
      const auto p = bodies.of(regime, i);
      auto wide = p.cast<DoubleDouble>();
      wide.attitude = normalised(wide.attitude);
      const auto fine = Motion<double>::make<DoubleDouble>(wide), quick = Motion<double>::make(p);
      if (!fine || !quick || !std::isfinite(fine->period())) continue;
      const double t = bodies.uniform(1.05, 1.5) * fine->period();
      const auto truth = Taylor<Quad>(p.cast<Quad>()).advance(t);
      Off data;
      for (int k = 0; k < 6; ++k) {
        auto near = bodies.jittered(p).cast<DoubleDouble>();
        near.attitude = wide.attitude;
        data.see(off(Motion<double>::make<DoubleDouble>(near)->at(t), truth));
      }
      const Off all[3] = {off(fine->at(t), truth), off(quick->at(t), truth), data};
      for (int k = 0; k < 3; ++k) rates[k].push_back(all[k].rates), attitude[k].push_back(all[k].attitude);
    }
  }
  const char* names[3] = {"wide", "double", "data"};
  for (int k = 0; k < 3; ++k) {
    std::sort(rates[k].begin(), rates[k].end());
    std::sort(attitude[k].begin(), attitude[k].end());
    const std::string name = names[k];
    state.counters[name + "_rates"] = rates[k][rates[k].size() / 2];
    state.counters[name + "_rates_max"] = rates[k].back();
    state.counters[name + "_attitude"] = attitude[k][attitude[k].size() / 2];
    state.counters[name + "_attitude_max"] = attitude[k].back();
  }
}

/// Of 240 bodies of all kinds but the last, so many decades of periods on, against the motion in double-double; what is stated includes what a rounding
/// of the data does.
void many_turns(benchmark::State& state) {
  std::vector<double> error, stated;
  for (auto _ : state) {
    Bodies bodies(9);
    for (int i = 0; i < 240; ++i) {
      const auto p = bodies.of(regimes[i % 9], i);
      const auto fine = Motion<double>::make<DoubleDouble>(p.cast<DoubleDouble>());
      const auto truth = Motion<DoubleDouble>::make<DoubleDouble>(p.cast<DoubleDouble>());
      if (!fine || !truth || !std::isfinite(fine->period())) continue;
      const double t = std::pow(10, double(state.range(0))) * bodies.uniform(.9, 1) * fine->period();
      error.push_back(off(fine->at(t), truth->at(t)).attitude);
      stated.push_back(gyrostat::free::MotionError<double>::of<DoubleDouble>(
                           *fine, gyrostat::free::Assembly<double>{p, {}}, gyrostat::free::Data::rounded, t)
                           .at(t)
                           .attitude);
    }
  }
  std::sort(error.begin(), error.end());
  std::sort(stated.begin(), stated.end());
  state.counters["error"] = error[error.size() / 2];
  state.counters["error_max"] = error.back();
  state.counters["stated"] = stated[stated.size() / 2];
}

/// Past the unstable rotation of a rigid body, args: decades that the start is off the middle axis, passages. Attitude, rad: the error, the
/// median effect of a rounding of every datum, what is stated.
void passages(benchmark::State& state) {
  const double off_axis = std::pow(10, -double(state.range(0)));
  double error = 0, stated = 0, kp2 = 0;
  std::vector<double> data;
  for (auto _ : state) {
    Bodies bodies(8);
    const auto p = Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {off_axis, 1, .3 * off_axis});
    const auto wide = p.cast<DoubleDouble>();
    const auto fine = Motion<double>::make<DoubleDouble>(wide);
    const auto truth = Motion<DoubleDouble>::make<DoubleDouble>(wide);
    const double t = fine->period() / 2 * double(state.range(1));
    const gyrostat::free::Assembly<double> given{p, {}};
    stated = gyrostat::free::MotionError<double>::of<DoubleDouble>(*fine, given, gyrostat::free::Data::rounded, t)
                 .at(t)
                 .attitude;
    error = off(fine->at(t), truth->at(t)).attitude;
    kp2 = fine->modulus().kp2;
    for (int k = 0; k < 40; ++k)
      data.push_back(
          off(Motion<double>::make<DoubleDouble>(bodies.jittered(p).cast<DoubleDouble>())->at(t), truth->at(t))
              .attitude);
  }
  std::sort(data.begin(), data.end());
  state.counters["kp2"] = kp2;
  state.counters["error"] = error;
  state.counters["data"] = data[data.size() / 2];
  state.counters["stated"] = stated;
}

BENCHMARK(sine_and_cosine);
#define EVERY_SCENE(function)                                             \
  BENCHMARK_CAPTURE(function, rigid, Scene::rigid);                       \
  BENCHMARK_CAPTURE(function, rigid_separatrix, Scene::rigid_separatrix); \
  BENCHMARK_CAPTURE(function, one_component, Scene::one_component);       \
  BENCHMARK_CAPTURE(function, lobe, Scene::lobe);                         \
  BENCHMARK_CAPTURE(function, gyrostat_separatrix, Scene::gyrostat_separatrix)
EVERY_SCENE(evaluation);
EVERY_SCENE(grid_point);
EVERY_SCENE(set_up_double);
EVERY_SCENE(set_up_double_double);
#define EVERY_TAME_SCENE(function)                                  \
  BENCHMARK_CAPTURE(function, rigid, Scene::rigid);                 \
  BENCHMARK_CAPTURE(function, one_component, Scene::one_component); \
  BENCHMARK_CAPTURE(function, lobe, Scene::lobe)
EVERY_TAME_SCENE(side_by_side);
EVERY_TAME_SCENE(quick_error);
BENCHMARK(stated_error<double>);
BENCHMARK(stated_error<DoubleDouble>);
BENCHMARK(passages)->ArgsProduct({{1, 3, 5, 7}, {1, 10, 1000}})->Iterations(1);
BENCHMARK(many_turns)->Arg(4)->Arg(6)->Arg(8)->Arg(9)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, generic, Regime::generic)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, middle_axis, Regime::middle_axis)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, outer_axis, Regime::outer_axis)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, much_momentum, Regime::much_momentum)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, little_momentum, Regime::little_momentum)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, total_near_zero, Regime::total_near_zero)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, close_moments, Regime::close_moments)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, equal_moments, Regime::equal_moments)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, unstable_axis, Regime::unstable_axis)->Iterations(1);
BENCHMARK_CAPTURE(accuracy, bisected, Regime::bisected)->Iterations(1);

}  // namespace
