// SPDX-License-Identifier: BSD-3-Clause
// Direct integration of a heavy body by every integrator, to one time. Arguments: -log10 of the tolerance, and the scene: 0 a fast spin
// (150 rad/s), one period; 1 the same, 100 periods; 2 a slow tumble near the pendulum rate, 10 s. The counter `error` is the true one against
// long double: the greater of the relative error of the rates and that of down. bench/rivals_heyoka_heavy.py runs heyoka on the same.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#if GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/heavy/cvode_motion.hpp"
#endif

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

constexpr double period = 0.04196818797409593;
constexpr double ends[] = {period, 100 * period, 10};

template <Real S>
Problem<S> body() {
  return Problem<S>::make({S(0.0011), S(0.0016), S(0.0020)}, S(0.8), {S(0.012), S(0.009), S(0.010)}, S(9.80665),
                          S(4.617791555485795e-6))
      .value();
}

template <Real S>
State<S> start(int scene) {
  State<S> s;
  if (scene < 2) {
    s.angular_velocity = {S(-0.3767774621242862), S(0.1192263074750677), 150};
    s.down = {S(0.99498743710662), 0, S(0.1)};
  } else {
    s.angular_velocity = {3, -2, 8};
    s.down = {S(0.6), 0, S(0.8)};
  }
  // half a turn about the middle between -axis 3 and down takes down to the vertical
  const Vec3<S> middle = (s.down - Vec3<S>(0, 0, 1)).normalized();
  s.attitude = {0, middle[0], middle[1], middle[2]};
  return s;
}

const State<long double>& reference(int scene) {
  static const auto all = [] {
    std::array<State<long double>, 3> states;
    for (int i = 0; i < 3; ++i) {
      const std::array<long double, 1> times{ends[i]};
      FullMotionOptions<long double> options;
      options.tolerance = 1e-17L;
      // from the very numbers that the doubles hold
      const auto from = start<double>(i);
      const auto& q = from.attitude;
      const State<long double> wide{
          from.angular_velocity.cast<long double>(), from.down.cast<long double>(), {q.w, q.x, q.y, q.z}};
      const auto p = body<double>();
      const auto same = Problem<long double>::make(p.inertia().cast<long double>(), p.mass(),
                                                   p.centre_of_mass().cast<long double>(), p.gravity(), p.gradient())
                            .value();
      (void)full_motion<long double>(same, wide, times, std::span(&states[std::size_t(i)], 1), options);
    }
    return states;
  }();
  return all[std::size_t(scene)];
}

double error_of(const State<double>& end, int scene) {
  const auto& truth = reference(scene);
  const auto relative = [](const Vec3<double>& a, const Vec3<long double>& b) {
    return static_cast<double>((a.cast<long double>() - b).norm() / b.norm());
  };
  return std::max(relative(end.angular_velocity, truth.angular_velocity), relative(end.down, truth.down));
}

void arguments(benchmark::internal::Benchmark* bench) {
  for (const int scene : {0, 1, 2})
    for (int tolerance = 6; tolerance <= 16; ++tolerance) bench->Args({tolerance, scene});
  bench->Unit(benchmark::kMicrosecond);
}

/// Times solve(problem, start, end, tolerance), which returns the state at the end.
template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const int scene = static_cast<int>(state.range(1));
  const auto p = body<double>();
  const auto from = start<double>(scene);
  State<double> end;
  for (auto _ : state) {
    end = solve(p, from, ends[scene], tolerance);
    benchmark::DoNotOptimize(end);
  }
  state.counters["error"] = error_of(end, scene);
}

template <int Order, bool turning>
void taylor_series(benchmark::State& state) {
  measure(state, [](const Problem<double>& p, const State<double>& from, double end, double tolerance) {
    using System = FullSystem<double, turning>;
    const System system(p, from);
    ode::TaylorOptions<double, System::width> options;
    options.tolerance = tolerance;
    options.scale = system.scale();
    ode::Taylor<System, Order> solver(system, 0, system.start(), options);
    solver.advance(end);
    return system.state(solver.state());
  });
}
BENCHMARK(taylor_series<16, false>)->Apply(arguments);
BENCHMARK(taylor_series<20, false>)->Apply(arguments);
BENCHMARK(taylor_series<24, false>)->Apply(arguments);
BENCHMARK(taylor_series<20, true>)->Apply(arguments);

/// State and its derivative by the start.
void variational(benchmark::State& state) {
  measure(state, [](const Problem<double>& p, const State<double>& from, double end, double tolerance) {
    using System = VariationalSystem<double>;
    const System system(p, from);
    ode::TaylorOptions<double, System::width> options;
    options.tolerance = tolerance;
    options.scale = system.scale();
    ode::Taylor<System> solver(system, 0, system.start(), options);
    solver.advance(end);
    return system.state(solver.state());
  });
}
BENCHMARK(variational)->Args({15, 0})->Unit(benchmark::kMicrosecond);

/// The ladder's top rung, with its companion run, at the tolerance asked.
void full_motion_rung(benchmark::State& state) {
  measure(state, [](const Problem<double>& p, const State<double>& from, double end, double tolerance) {
    const std::array<double, 1> times{end};
    std::array<State<double>, 1> states;
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    benchmark::DoNotOptimize(full_motion<double>(p, from, times, states, options));
    return states[0];
  });
}
BENCHMARK(full_motion_rung)->Apply([](benchmark::internal::Benchmark* bench) {
  for (const int scene : {0, 1, 2})
    for (const int tolerance : {3, 6, 9}) bench->Args({tolerance, scene});
  bench->Unit(benchmark::kMicrosecond);
});

/// The same equations for a Runge-Kutta method.
struct Equations {
  Problem<double> problem;
  void operator()(double, const std::array<double, 6>& y, std::array<double, 6>& rate) const noexcept {
    const Vec3<double> w(y[0], y[1], y[2]), d(y[3], y[4], y[5]);
    const Vec3<double> a = angular_acceleration<double>(problem, w, d), turn = fixed_vector_rate<double>(d, w);
    rate = {a[0], a[1], a[2], turn[0], turn[1], turn[2]};
  }
};

void dop853(benchmark::State& state) {
  measure(state, [](const Problem<double>& p, const State<double>& from, double end, double tolerance) {
    ode::StepControl<double, 6> control;
    control.relative = tolerance;
    control.absolute = ode::uniform<double, 6>(tolerance);
    control.step_cap = 10000000;
    const auto &w = from.angular_velocity, &d = from.down;
    ode::RungeKutta<double, 6, Equations> solver({p}, 0.0, {w[0], w[1], w[2], d[0], d[1], d[2]}, control);
    while (solver.time() < end && solver.step(end) == ode::Status::reached) {
    }
    const auto y = solver.state();
    return State<double>{{y[0], y[1], y[2]}, {y[3], y[4], y[5]}, {}};
  });
}
BENCHMARK(dop853)->Apply(arguments);

#if GYROSTAT_HAVE_CVODE
void cvode_adams(benchmark::State& state) {
  measure(state, [](const Problem<double>& p, const State<double>& from, double end, double tolerance) {
    CvodeEquations equations(p, from, false);
    auto made = ode::Cvode::create(equations.system(), 0, equations.start(),
                                   {ode::CvodeMethod::adams, tolerance, tolerance, 10000000});
    ode::Cvode solver = std::move(made).value();
    solver.advance(end);
    return equations.state(solver.state().data());
  });
}
BENCHMARK(cvode_adams)->Apply(arguments);
#endif

}  // namespace
