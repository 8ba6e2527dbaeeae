// SPDX-License-Identifier: BSD-3-Clause
// Direct integration of a spinning, thrusting body by every integrator, to one time. Arguments: -log10 of the tolerance, and the scene:
// 0 a Galileo-like burn at 10 rpm, 20 turns; 1 the same, 200 turns; 2 the published body, which tumbles, 50 s. The counter `error` is
// the true one against long double: the greatest of the relative error of the rates, the angle of the attitude, and the relative errors
// of velocity and position. bench/rivals_heyoka_spinning.py runs heyoka on the same scenes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#if GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/spinning/cvode_motion.hpp"
#endif

using namespace gyrostat;
using namespace gyrostat::spinning;
using ode::Status;

namespace {

template <Real S>
Problem<S> scene(int number) {
  Problem<S> p;
  if (number < 2) {
    p.inertia = {2985, 2729, 4183};
    p.mass = 2017;
    p.torque = {4, -2, 0};
    p.force = {2, -1, 400};
    p.angular_velocity = {S(0.002), S(-0.003), S(1.0471975511965976)};
    p.angles = {S(0.004), S(-0.002), S(0.3)};
  } else {
    p.inertia = {S(8.7), S(8.6), S(11.1)};
    p.mass = 10;
    p.torque = {4, 0, 0};
    p.force = {0, 0, 3};
    p.rotor_momentum = S(1.3);
    p.charge_momentum = S(0.29099800111055549);
    p.angular_velocity = {0, 0, S(0.2827433388230814)};
  }
  return p;
}

double end_of(int number) { return number == 0 ? 120 : number == 1 ? 1200 : 50; }

const State<long double>& reference(int number) {
  static const auto all = [] {
    std::array<State<long double>, 3> ends;
    for (int i = 0; i < 3; ++i) {
      const std::array<long double, 1> times{end_of(i)};
      FullMotionOptions<long double> options;
      options.tolerance = 1e-17L;
      (void)full_motion<long double>(scene<long double>(i), times, std::span(&ends[std::size_t(i)], 1), options);
    }
    return ends;
  }();
  return all[std::size_t(number)];
}

double error_of(const State<double>& end, int number) {
  const auto& truth = reference(number);
  const auto relative = [](const Vec3<double>& a, const Vec3<long double>& b) {
    return static_cast<double>((a.cast<long double>() - b).norm() / b.norm());
  };
  const Quat<long double> q{end.attitude.w, end.attitude.x, end.attitude.y, end.attitude.z};
  const auto d = conjugate(truth.attitude) * q;
  return std::max({relative(end.angular_velocity, truth.angular_velocity), relative(end.velocity, truth.velocity),
                   relative(end.position, truth.position), 2 * static_cast<double>(std::hypot(d.x, d.y, d.z))});
}

void arguments(benchmark::internal::Benchmark* bench) {
  for (const int number : {0, 1, 2}) {
    for (int tolerance = 6; tolerance <= 16; ++tolerance) bench->Args({tolerance, number});
  }
  bench->Unit(benchmark::kMicrosecond);
}

/// Times solve(scene, tolerance), which returns the state at the end.
template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const int number = static_cast<int>(state.range(1));
  State<double> end;
  for (auto _ : state) {
    end = solve(number, tolerance);
    benchmark::DoNotOptimize(end);
  }
  state.counters["error"] = error_of(end, number);
}

template <int Order>
void taylor_series(benchmark::State& state) {
  measure(state, [](int number, double tolerance) {
    const auto problem = scene<double>(number);
    const FullSystem<double> system(problem);
    ode::TaylorOptions<double, FullSystem<double>::width> options;
    options.tolerance = tolerance;
    options.scale = system.scale(end_of(number));
    ode::Taylor<FullSystem<double>, Order> solver(system, 0, system.start(), options);
    solver.advance(end_of(number));
    State<double> end;
    end.angular_velocity = system.angular_velocity(solver.state());
    end.attitude = system.attitude(solver.state());
    end.velocity = system.velocity(solver.state());
    end.position = system.position(solver.time(), solver.state());
    return end;
  });
}
BENCHMARK(taylor_series<16>)->Apply(arguments);
BENCHMARK(taylor_series<20>)->Apply(arguments);

/// The ladder's top rung, with its companion run and the spin angle, at the tolerance asked.
void full_motion_rung(benchmark::State& state) {
  measure(state, [](int number, double tolerance) {
    const std::array<double, 1> times{end_of(number)};
    std::array<State<double>, 1> states;
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    benchmark::DoNotOptimize(full_motion<double>(scene<double>(number), times, states, options));
    return states[0];
  });
}
BENCHMARK(full_motion_rung)->Apply([](benchmark::internal::Benchmark* bench) {
  for (const int number : {0, 1, 2}) {
    for (const int tolerance : {3, 6, 9}) bench->Args({tolerance, number});
  }
  bench->Unit(benchmark::kMicrosecond);
});

/// The same equations for a Runge-Kutta method: rates, quaternion, velocity, position.
struct Equations {
  Problem<double> problem;
  void operator()(double, const std::array<double, 13>& y, std::array<double, 13>& rate) const noexcept {
    const Vec3<double> omega(y[0], y[1], y[2]);
    const Quat<double> q{y[3], y[4], y[5], y[6]};
    const Vec3<double> a = angular_acceleration(problem, omega), dv = acceleration(problem, q);
    const auto dq = quaternion_rate<double>(q, omega);
    rate = {a[0], a[1], a[2], dq.w, dq.x, dq.y, dq.z, dv[0], dv[1], dv[2], y[7], y[8], y[9]};
  }
};

void dop853(benchmark::State& state) {
  measure(state, [](int number, double tolerance) {
    const auto p = scene<double>(number);
    const auto q = quaternion_from_312(p.angles.psi, p.angles.phi, p.angles.theta);
    ode::StepControl<double, 13> control;
    control.relative = tolerance;
    control.absolute = ode::uniform<double, 13>(tolerance);
    control.step_cap = 10000000;
    const auto& w = p.angular_velocity;
    ode::RungeKutta<double, 13, Equations> solver({p}, 0.0, {w[0], w[1], w[2], q.w, q.x, q.y, q.z, 0, 0, 0, 0, 0, 0},
                                                  control);
    while (solver.time() < end_of(number) && solver.step(end_of(number)) == Status::reached) {
    }
    const auto y = solver.state();
    State<double> end;
    end.angular_velocity = {y[0], y[1], y[2]};
    end.attitude = normalised(Quat<double>{y[3], y[4], y[5], y[6]});
    end.velocity = {y[7], y[8], y[9]};
    end.position = {y[10], y[11], y[12]};
    return end;
  });
}
BENCHMARK(dop853)->Apply(arguments);

#if GYROSTAT_HAVE_CVODE
void cvode_adams(benchmark::State& state) {
  measure(state, [](int number, double tolerance) {
    const auto problem = scene<double>(number);
    spinning::detail::CvodeEquations equations(problem, end_of(number));
    const auto start = equations.start();
    ode::CvodeSystem system;
    system.dimension = int(spinning::detail::CvodeEquations::width);
    system.rhs = &spinning::detail::CvodeEquations::rate;
    system.user = &equations;
    auto solver = ode::Cvode::create(system, 0, start, {ode::CvodeMethod::adams, tolerance, tolerance, 10000000});
    ode::Cvode run = std::move(solver).value();
    run.advance(end_of(number));
    return equations.state(run.time(), run.state().data(), {});
  });
}
BENCHMARK(cvode_adams)->Apply(arguments);
#endif

}  // namespace
