// SPDX-License-Identifier: BSD-3-Clause
// Spin-up by a stiff motor (docs/rotor.md, section 7): R = diag(2.3, 2.9, 3.4), 200 s or 109 rotations, the rotor at rest at the start.
// Arguments: -log10 of the tolerance and the motor's slope S; the relaxation rate is 2.5 S. The counter `error` is the true angle
// between the attitudes, rad, against long double: Taylor up to S = 50, Radau above.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <map>

#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/models/rotor/relaxing.hpp"
#include "gyrostat/ode/radau.hpp"
#include "gyrostat/ode/taylor.hpp"
#if GYROSTAT_HAVE_CVODE
#include "gyrostat/ode/cvode.hpp"
#endif

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

constexpr double t_end = 200;

template <Real S>
Gyrostat<S> body(double slope) {
  const Vec3<S> e(S(0.36L), S(0.48L), S(0.8L));
  Mat3<S> theta = S(0.45L) * e * e.transpose();
  theta.diagonal() += Vec3<S>(S(2.3L), S(2.9L), S(3.4L));
  return Gyrostat<S>::make(theta, e, S(0.45L), static_cast<S>(slope), 30).value();
}

template <Real S>
State<S> start(const Gyrostat<S>& gyrostat) {
  State<S> state;
  const Vec3<S> m(S(0.5L), S(-0.7L), S(0.45L));
  state.momentum = 8 * m / std::sqrt(m.squaredNorm());
  state.axial_momentum =
      gyrostat.axial_inertia() * gyrostat.coupling() * gyrostat.axis().dot(gyrostat.free_inverse() * state.momentum);
  return state;
}

template <Real S>
Quat<S> radau(double slope, S tolerance, ode::Counts* counts = nullptr) {
  const auto gyrostat = body<S>(slope);
  const auto state = start(gyrostat);
  const RelaxingRotor<S> system(gyrostat, state);
  typename ode::Radau<RelaxingRotor<S>>::Options options;
  options.tolerance = tolerance;
  options.scale = system.scale(gyrostat, state);
  ode::Radau<RelaxingRotor<S>> solver(system, 0, system.components(state), options);
  solver.advance(t_end);
  if (counts != nullptr) *counts = solver.counts();
  return system.state(solver.state()).attitude;
}

template <Real S, int Order>
Quat<S> taylor(double slope, S tolerance, ode::Counts* counts = nullptr) {
  const auto gyrostat = body<S>(slope);
  const FullSystem<S> system(gyrostat, start(gyrostat));
  ode::TaylorOptions<S, FullSystem<S>::width> options;
  options.tolerance = tolerance;
  options.scale = system.scale();
  ode::Taylor<FullSystem<S>, Order> solver(system, 0, system.start(), options);
  solver.advance(t_end);
  if (counts != nullptr) *counts = solver.counts();
  return system.state(t_end, solver.state()).attitude;
}

const Quat<long double>& reference(double slope) {
  static std::map<double, Quat<long double>> known;
  const auto found = known.find(slope);
  if (found != known.end()) return found->second;
  return known[slope] = slope <= 50 ? taylor<long double, 24>(slope, 1e-20L) : radau<long double>(slope, 1e-19L);
}

/// Times solve(slope, tolerance, counts), which returns the attitude at the end.
template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const auto slope = static_cast<double>(state.range(1));
  const Quat<long double> truth = reference(slope);
  Quat<double> end;
  ode::Counts counts;
  for (auto _ : state) {
    end = solve(slope, tolerance, &counts);
    benchmark::DoNotOptimize(end);
  }
  const Quat<long double> apart = conjugate(truth) * Quat<long double>{end.w, end.x, end.y, end.z};
  state.counters["error"] = static_cast<double>(2 * std::hypot(apart.x, apart.y, apart.z));
  state.counters["steps"] = static_cast<double>(counts.steps);
}

void arguments(benchmark::internal::Benchmark* bench, std::initializer_list<int> tolerances, int stiffest) {
  for (int slope = 5; slope <= stiffest; slope *= 10) {
    for (const int tolerance : tolerances) bench->Args({tolerance, slope});
  }
  bench->Unit(benchmark::kMillisecond);
}

void radau_15(benchmark::State& state) { measure(state, radau<double>); }
BENCHMARK(radau_15)->Apply([](auto* bench) { arguments(bench, {6, 9, 12, 14, 16}, 50000); });

void taylor_20(benchmark::State& state) { measure(state, taylor<double, 20>); }
BENCHMARK(taylor_20)->Apply([](auto* bench) { arguments(bench, {9, 16}, 50000); });

#if GYROSTAT_HAVE_CVODE
// (q, H, p) in body axes
bool rate(double, const double* y, double* out, void* user) {
  const State<double> d = state_rate(*static_cast<const Gyrostat<double>*>(user),
                                     State<double>{{y[0], y[1], y[2], y[3]}, {y[4], y[5], y[6]}, y[7], 0});
  const std::array<double, 8> f{d.attitude.w,  d.attitude.x,  d.attitude.y,  d.attitude.z,
                                d.momentum[0], d.momentum[1], d.momentum[2], d.axial_momentum};
  double finite = 0;
  for (std::size_t i = 0; i < 8; ++i) finite += out[i] = f[i];
  return std::isfinite(finite);
}

bool jacobian(double, const double* y, double* columns, void* user) {
  const auto J = state_jacobian(*static_cast<const Gyrostat<double>*>(user),
                                State<double>{{y[0], y[1], y[2], y[3]}, {y[4], y[5], y[6]}, y[7], 0});
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) columns[8 * j + i] = J(i, j);
  }
  return true;
}

template <ode::CvodeMethod method>
void cvode(benchmark::State& state) {
  state.SetLabel(ode::Cvode::version());
  measure(state, [](double slope, double tolerance, ode::Counts* counts) {
    auto gyrostat = body<double>(slope);
    const auto at = start(gyrostat);
    const std::array<double, 8> y{1, 0, 0, 0, at.momentum[0], at.momentum[1], at.momentum[2], at.axial_momentum};
    ode::CvodeSystem system;
    system.dimension = 8;
    system.rhs = rate;
    system.jacobian = jacobian;
    system.user = &gyrostat;
    ode::Cvode run = ode::Cvode::create(system, 0, y, {method, tolerance, tolerance, 100000000}).value();
    run.advance(t_end);
    *counts = run.counts();
    const auto x = run.state();
    return normalised(Quat<double>{x[0], x[1], x[2], x[3]});
  });
}
BENCHMARK(cvode<ode::CvodeMethod::bdf>)->Apply([](auto* bench) { arguments(bench, {6, 9, 11, 13}, 50000); });
#endif

}  // namespace
