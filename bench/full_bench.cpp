// SPDX-License-Identifier: BSD-3-Clause
// Direct integration of one despin, J = (1.4, 1, 0.7), from |M| = 1 to |M| = 1/2, by every integrator. Arguments: -log10 of the step
// tolerance and -log10 of epsilon. The counter `error` is the true one, of the momentum at that time, against long double.
// bench/rivals_heyoka.py runs heyoka on the same scene.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "gyrostat/ladder/deceleration/full_motion.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#if GYROSTAT_HAVE_CVODE
#include "gyrostat/ode/cvode.hpp"
#endif

using namespace gyrostat;
using namespace gyrostat::deceleration;
using ode::Status;

namespace {

template <Real S>
Problem<S> scene(double epsilon) {
  const Vec3<double> start(0.8, 0.5, 0.33166247903554);
  Problem<S> problem;
  problem.inverse_inertia = Vec3<double>(1 / 1.4, 1, 1 / 0.7).cast<S>();
  problem.control.diagonal() = Vec3<double>(epsilon * 0.6, epsilon * 0.9, epsilon).cast<S>();
  problem.drag = static_cast<S>(epsilon * 0.3);
  problem.momentum = (start / start.norm()).cast<S>();
  return problem;
}

struct End {
  long double time = 0;
  Vec3<long double> momentum{0, 0, 0};
};

/// Until |M| = 1/2, or until t_end if that is given.
template <Real S, int Order, bool with_attitude = false>
End taylor(double epsilon, S tolerance, S t_end = 0) {
  using System = FullSystem<S, true, with_attitude>;
  const Problem<S> problem = scene<S>(epsilon);
  ode::TaylorOptions<S, System::width> options;
  options.tolerance = tolerance;
  for (std::size_t i = 0; i < System::width; ++i) options.scale[i] = i == 3 ? S(0) : S(1);
  typename ode::Taylor<System, Order>::State start{};
  for (std::size_t i = 0; i < 3; ++i) start[i] = problem.momentum[static_cast<int>(i)];
  if constexpr (with_attitude) start[4] = 1;
  ode::Taylor<System, Order> solver(System(problem), 0, start, options);
  std::array<S, System::width> x{};
  S t = t_end;
  if (t_end > 0) {
    solver.advance(t_end);
    std::copy(solver.state(), solver.state() + System::width, x.begin());
  } else {
    const auto above = [](const S* u) noexcept { return u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - S(0.25L); };
    while (above(solver.state()) > 0 && solver.step() == Status::reached) {
    }
    t = *solver.crossing(above);
    solver.at(t, x.data());
  }
  return {t, {x[0], x[1], x[2]}};
}

const End& reference(double epsilon) {
  static const End coarse = taylor<long double, 24>(1e-3, 1e-20L), fine = taylor<long double, 24>(1e-4, 1e-20L);
  return epsilon > 5e-4 ? coarse : fine;
}

void arguments(benchmark::internal::Benchmark* bench) {
  for (const int epsilon : {3, 4}) {
    for (int tolerance = 6; tolerance <= 16; ++tolerance) bench->Args({tolerance, epsilon});
  }
  bench->Unit(benchmark::kMicrosecond);
}

/// Times solve(epsilon, tolerance, t_end), which returns the momentum at t_end.
template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const double epsilon = std::pow(10.0, -static_cast<double>(state.range(1)));
  const End& truth = reference(epsilon);
  Vec3<double> end{0, 0, 0};
  for (auto _ : state) {
    end = solve(epsilon, tolerance, static_cast<double>(truth.time));
    benchmark::DoNotOptimize(end);
  }
  state.counters["error"] = static_cast<double>((end.cast<long double>() - truth.momentum).cwiseAbs().maxCoeff());
}

template <int Order, bool with_attitude>
void taylor_series(benchmark::State& state) {
  measure(state, [](double epsilon, double tolerance, double t_end) {
    return Vec3<double>(
        taylor<double, Order, with_attitude>(epsilon, tolerance, t_end).momentum.template cast<double>());
  });
}
BENCHMARK(taylor_series<16, false>)->Apply(arguments);
BENCHMARK(taylor_series<20, false>)->Apply(arguments);
BENCHMARK(taylor_series<20, true>)->Apply(arguments);

/// The ladder's top rung, with its companion run, at the tolerance asked.
void full_motion_rung(benchmark::State& state) {
  measure(state, [](double epsilon, double tolerance, double t_end) {
    const std::array<double, 1> times{t_end};
    std::array<State<double>, 1> states;
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    options.find_stop = false;
    const auto answer = full_motion<double>(scene<double>(epsilon), times, states, options);
    benchmark::DoNotOptimize(answer);
    return states[0].momentum;
  });
}
BENCHMARK(full_motion_rung)->Apply([](benchmark::internal::Benchmark* bench) {
  for (const int epsilon : {3, 4}) {
    for (const int tolerance : {3, 6, 9}) bench->Args({tolerance, epsilon});
  }
  bench->Unit(benchmark::kMicrosecond);
});

/// The same equations written for a Runge-Kutta method: no matrix, one root.
struct Equations {
  Vec3<double> a, b;
  double drag;
  void operator()(double, const std::array<double, 3>& M, std::array<double, 3>& rate) const noexcept {
    const double pull = 1 / std::sqrt(M[0] * M[0] + M[1] * M[1] + M[2] * M[2]);
    rate[0] = (a[2] - a[1]) * M[1] * M[2] - M[0] * (drag + b[0] * pull);
    rate[1] = (a[0] - a[2]) * M[2] * M[0] - M[1] * (drag + b[1] * pull);
    rate[2] = (a[1] - a[0]) * M[0] * M[1] - M[2] * (drag + b[2] * pull);
  }
};

Equations equations(double epsilon) {
  const auto problem = scene<double>(epsilon);
  return {problem.inverse_inertia, problem.control.diagonal(), problem.drag};
}

void dop853(benchmark::State& state) {
  measure(state, [](double epsilon, double tolerance, double t_end) {
    const Vec3<double> start = scene<double>(epsilon).momentum;
    ode::StepControl<double, 3> control;
    control.relative = tolerance;
    control.absolute = ode::uniform<double, 3>(tolerance);
    control.step_cap = 10000000;
    ode::RungeKutta<double, 3, Equations> solver(equations(epsilon), 0.0, {start[0], start[1], start[2]}, control);
    while (solver.time() < t_end && solver.step(t_end) == Status::reached) {
    }
    const auto y = solver.state();
    return Vec3<double>(y[0], y[1], y[2]);
  });
}
BENCHMARK(dop853)->Apply(arguments);

#if GYROSTAT_HAVE_CVODE
bool rate(double t, const double* y, double* out, void* user) {
  std::array<double, 3> f{};
  (*static_cast<const Equations*>(user))(t, {y[0], y[1], y[2]}, f);
  for (std::size_t i = 0; i < 3; ++i) out[i] = f[i];
  return std::isfinite(f[0] + f[1] + f[2]);
}

bool jacobian(double, const double* y, double* columns, void* user) {
  const auto& e = *static_cast<const Equations*>(user);
  Problem<double> problem;
  problem.inverse_inertia = e.a;
  problem.control.diagonal() = e.b;
  problem.drag = e.drag;
  const Mat3<double> J = momentum_jacobian<double>(problem, {y[0], y[1], y[2]});
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) columns[3 * j + i] = J(i, j);
  }
  return true;
}

template <ode::CvodeMethod method, bool newton>
void cvode(benchmark::State& state) {
  measure(state, [](double epsilon, double tolerance, double t_end) {
    Equations e = equations(epsilon);
    const Vec3<double> start = scene<double>(epsilon).momentum;
    ode::CvodeSystem system;
    system.dimension = 3;
    system.rhs = rate;
    system.jacobian = newton ? jacobian : nullptr;
    system.user = &e;
    auto solver = ode::Cvode::create(system, 0, {start.data(), 3}, {method, tolerance, tolerance, 10000000});
    ode::Cvode run = std::move(solver).value();
    run.advance(t_end);
    const auto y = run.state();
    return Vec3<double>(y[0], y[1], y[2]);
  });
}
BENCHMARK(cvode<ode::CvodeMethod::adams, false>)->Apply(arguments);
BENCHMARK(cvode<ode::CvodeMethod::adams, true>)->Apply(arguments);
BENCHMARK(cvode<ode::CvodeMethod::bdf, true>)->Args({6, 3})->Args({9, 3})->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
