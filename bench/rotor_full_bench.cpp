// SPDX-License-Identifier: BSD-3-Clause
// Direct integration of one spin-up by every integrator: R = diag(2.3, 2.9, 3.4), lambda = 0.45, e = (0.36, 0.48, 0.8), S = 0.05,
// omega* = 30, |L| = 8, 200 s, which are 109 turns. Argument: -log10 of the step tolerance. The counter `error` is the true one, of the
// attitude at the end, rad, against long double. bench/rivals_heyoka_rotor.py runs heyoka on the same motion.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#if GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/rotor/cvode_motion.hpp"
#endif

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

constexpr double end_time = 200;

template <Real S>
Gyrostat<S> body(double slope = 0.05) {
  Vec3<S> e(S(0.36L), S(0.48L), S(0.8L));
  e /= e.norm();
  const S lambda = S(0.45L);
  Mat3<S> theta = lambda * e * e.transpose();
  theta.diagonal() += Vec3<S>(S(2.3L), S(2.9L), S(3.4L));
  return Gyrostat<S>::make((theta + theta.transpose()) / 2, e, lambda, static_cast<S>(slope), 30).value();
}

/// The rotor locked to the carrier, H along (0.3, -0.5, 0.8).
template <Real S>
State<S> start(const Gyrostat<S>& gyrostat) {
  const Vec3<S> direction(S(0.3L), S(-0.5L), S(0.8L));
  const Vec3<S> H = 8 / direction.norm() * direction;
  return gyrostat.state({}, gyrostat.inverse_inertia() * H, 0);
}

template <Real S, int Order>
Quat<S> taylor(S tolerance) {
  const auto gyrostat = body<S>();
  const FullSystem<S> system(gyrostat, start(gyrostat));
  ode::TaylorOptions<S, FullSystem<S>::width> options;
  options.tolerance = tolerance;
  options.scale = system.scale();
  ode::Taylor<FullSystem<S>, Order> solver(system, 0, system.start(), options);
  solver.advance(S(end_time));
  return system.state(S(end_time), solver.state()).attitude;
}

/// Times solve(tolerance), which returns the attitude at the end.
template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  static const Quat<long double> truth = taylor<long double, 24>(1e-20L);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  Quat<double> end{};
  for (auto _ : state) {
    end = solve(tolerance);
    benchmark::DoNotOptimize(end);
  }
  state.counters["error"] =
      static_cast<double>(angle_between<long double>(normalised(Quat<long double>{end.w, end.x, end.y, end.z}), truth));
}

void tolerances(benchmark::internal::Benchmark* bench) {
  for (int tolerance = 6; tolerance <= 16; ++tolerance) bench->Arg(tolerance);
  bench->Unit(benchmark::kMicrosecond);
}
void reachable(benchmark::internal::Benchmark* bench) {
  for (int tolerance = 7; tolerance <= 14; ++tolerance) bench->Arg(tolerance);
  bench->Unit(benchmark::kMicrosecond);
}

template <int Order>
void taylor_series(benchmark::State& state) {
  measure(state, [](double tolerance) { return taylor<double, Order>(tolerance); });
}
BENCHMARK(taylor_series<16>)->Apply(tolerances);
BENCHMARK(taylor_series<20>)->Apply(tolerances);
BENCHMARK(taylor_series<24>)->Apply(tolerances);

/// The ladder's rung, with its companion run; the argument is the tolerance asked for.
template <Integrator integrator>
void full_motion_rung(benchmark::State& state) {
  measure(state, [](double tolerance) {
    const std::array<double, 1> times{end_time};
    std::array<State<double>, 1> states;
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    options.integrator = integrator;
    const auto gyrostat = body<double>();
    const auto answer = full_motion<double>(gyrostat, start(gyrostat), times, states, options);
    benchmark::DoNotOptimize(answer);
    return states[0].attitude;
  });
}
BENCHMARK(full_motion_rung<Integrator::taylor>)->Arg(3)->Arg(6)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK(full_motion_rung<Integrator::radau>)->Arg(3)->Arg(6)->Arg(9)->Unit(benchmark::kMicrosecond);

/// What a Runge-Kutta method needs of the equations, in principal axes of R: (w, x, y, z | H, p), or (w, x, y, z | p) with H = P^T L.
template <bool with_momentum>
struct Equations {
  static constexpr std::size_t width = with_momentum ? 8 : 5;
  using Numbers = std::array<double, width>;
  Vec3<double> a, e, L;
  double lambda, slope, no_load_rate;

  explicit Equations(const Gyrostat<double>& g)
      : a(g.free_axes().moments.cwiseInverse()),
        e(g.free_axes().R_BP.transpose() * g.axis()),
        L(g.free_axes().R_BP.transpose() * start(g).momentum),
        lambda(g.axial_inertia()),
        slope(g.slope()),
        no_load_rate(g.no_load_rate()) {}

  Numbers from(double p) const {
    if constexpr (with_momentum) return {1, 0, 0, 0, L[0], L[1], L[2], p};
    else return {1, 0, 0, 0, p};
  }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const double p = y[width - 1];
    Vec3<double> H;
    if constexpr (with_momentum) H = {y[4], y[5], y[6]};
    else H = rotate<double>({y[0], -y[1], -y[2], -y[3]}, L);
    const Vec3<double> Omega = a.cwiseProduct(H - p * e);
    const auto q = quaternion_rate<double>({y[0], y[1], y[2], y[3]}, Omega);
    rate[0] = q.w, rate[1] = q.x, rate[2] = q.y, rate[3] = q.z;
    if constexpr (with_momentum) {
      const Vec3<double> dH = cross<double>(H, Omega);
      rate[4] = dH[0], rate[5] = dH[1], rate[6] = dH[2];
    }
    rate[width - 1] = -slope * (p / lambda - e.dot(Omega) - no_load_rate);
  }
};

template <bool with_momentum>
void dop853(benchmark::State& state) {
  measure(state, [](double tolerance) {
    using Rates = Equations<with_momentum>;
    const auto gyrostat = body<double>();
    const Rates equations(gyrostat);
    ode::StepControl<double, Rates::width> control;
    control.relative = tolerance;
    control.absolute = ode::uniform<double, Rates::width>(tolerance);
    control.step_cap = 10'000'000;
    ode::RungeKutta<double, Rates::width, Rates> solver(equations, 0.0, equations.from(start(gyrostat).axial_momentum),
                                                        control);
    solver.advance(end_time);
    const auto& y = solver.state();
    const Quat<double> q_BF = from_matrix<double>(gyrostat.free_axes().R_BP);
    return normalised(q_BF * Quat<double>{y[0], y[1], y[2], y[3]} * conjugate(q_BF));
  });
}
BENCHMARK(dop853<true>)->Apply(reachable);
BENCHMARK(dop853<false>)->Apply(reachable);

#if GYROSTAT_HAVE_CVODE
template <ode::CvodeMethod method, bool newton>
void cvode(benchmark::State& state) {
  measure(state, [](double tolerance) {
    const auto gyrostat = body<double>();
    const auto from = start(gyrostat);
    CvodeEquations equations(gyrostat, from, end_time);
    auto system = equations.system();
    if (!newton) system.jacobian = nullptr;
    const auto y = equations.start();
    auto made = ode::Cvode::create(system, 0, y, {method, tolerance, tolerance, 10'000'000});
    ode::Cvode run = std::move(made).value();
    run.advance(end_time);
    return normalised(equations.state(run.state().data()).attitude);
  });
}
BENCHMARK(cvode<ode::CvodeMethod::adams, false>)->Apply(reachable);
BENCHMARK(cvode<ode::CvodeMethod::adams, true>)->Apply(reachable);
BENCHMARK(cvode<ode::CvodeMethod::bdf, true>)->Arg(7)->Arg(10)->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
