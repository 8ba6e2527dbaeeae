// SPDX-License-Identifier: BSD-3-Clause
// Two despins without rotor momentum at eps = 1e-4, from |M| to |M|/2: a compact body, J = (1.4, 1, 0.7), which makes
// 240 turns, and the one of the paper, J = (35, 22, 16), which makes 2700. Second-order averaging against the direct integrators, each at the loosest tolerance with which |M| and k2, or M itself, err by at most 1e-6 at the end (found
// here, against long double). Then the average over an orbit with rotor momentum, and whole scenes through solve(). At the end the ratios.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gyrostat/ladder/deceleration/averaged_motion.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/models/deceleration/orbit_average.hpp"
#include "gyrostat/models/deceleration/second_order.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::deceleration;
using Elliptic = math::Native;

constexpr double wanted = 1e-6;

/// The body of the benchmark that runs: 0 the compact one, 1 the one of the paper, in units of its first |M|.
int body = 0;

template <Real S>
Problem<S> despin() {
  static const Vec3<double> inverse[] = {{1 / 1.4, 1, 1 / 0.7}, {50 / 35., 50 / 22., 50 / 16.}};
  static const Vec3<double> control[] = {{0.6e-4, 0.9e-4, 1e-4}, {0.1e-4, 0.16e-4, 0.2e-4}};
  static const Vec3<double> start[] = {{0.8, 0.5, 0.33166247903554}, {40, 25, 16.5}};
  Problem<S> p;
  p.inverse_inertia = inverse[body].cast<S>();
  p.control.diagonal() = control[body].cast<S>();
  p.drag = static_cast<S>(body == 0 ? 0.3e-4 : 0.2e-4);
  p.momentum = start[body].normalized().cast<S>();
  return p;
}

struct End {
  Vec3<double> momentum{0, 0, 0};
  std::uint64_t rhs = 0;  ///< evaluations of the right-hand side, or Taylor steps
};

/// Second-order averaging: mean start, mean equations, osculating end.
End averaged_2(const Problem<double>& problem, double tolerance, double t_end) {
  const Vec3<double>& M0 = problem.momentum;
  const double norm0 = M0.norm();
  const auto start = polhode_through<double>(problem.inverse_inertia, M0);
  const auto b = ControlTorques<double>::of(problem.control, start.axes);
  const double u0 = argument_of<Elliptic>(start, M0);
  const auto away = oscillation<Elliptic>(start, b, norm0, u0);
  const auto mean = shifted(start, -away.spread);
  AveragedMotion<Elliptic, double> motion(problem, mean.polhode, norm0 * (1 - away.norm),
                                          u0 / Elliptic::complete(start.modulus).K, tolerance, tolerance * 1e2);
  motion.advance(t_end, 0, [](const Polhode<double>&, double) {});
  const auto s = motion.state();
  const auto o = oscillation<Elliptic>(s.polhode, b, s.norm, s.phase * Elliptic::complete(s.polhode.modulus).K);
  const auto p = shifted(s.polhode, o.spread).polhode;
  return {momentum_on<Elliptic>(p, s.norm * (1 + o.norm), s.phase * Elliptic::complete(p.modulus).K),
          motion.counts().rhs};
}

template <Real S, int Order>
End taylor(const Problem<S>& problem, S tolerance, S t_end) {
  using System = FullSystem<S, true, false>;
  ode::TaylorOptions<S, System::width> options;
  options.tolerance = tolerance;
  for (std::size_t i = 0; i < System::width; ++i) options.scale[i] = i == 3 ? S(0) : S(1);
  typename ode::Taylor<System, Order>::State start{};
  for (std::size_t i = 0; i < 3; ++i) start[i] = problem.momentum[static_cast<int>(i)];
  ode::Taylor<System, Order> solver(System(problem), 0, start, options);
  solver.advance(t_end);
  const auto* x = solver.state();
  return {Vec3<S>(x[0], x[1], x[2]).template cast<double>(), solver.counts().steps};
}

/// The full equations as a Runge-Kutta method likes them: no matrix, one root.
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

End dop853(const Problem<double>& problem, double tolerance, double t_end) {
  ode::StepControl<double, 3> control;
  control.relative = tolerance;
  control.absolute = ode::uniform<double, 3>(tolerance);
  control.step_cap = 100000000;
  ode::RungeKutta<double, 3, Equations> solver({problem.inverse_inertia, problem.control.diagonal(), problem.drag}, 0.0,
                                               {problem.momentum[0], problem.momentum[1], problem.momentum[2]},
                                               control);
  while (solver.time() < t_end && solver.step(t_end) == ode::Status::reached) {
  }
  const auto& y = solver.state();
  return {{y[0], y[1], y[2]}, solver.counts().rhs};
}

struct Reference {
  double time;
  End end;

  Reference() {
    AveragedMotion<Elliptic, double> motion(
        despin<double>(), polhode_through<double>(despin<double>().inverse_inertia, despin<double>().momentum), 1, 0,
        1e-10, infinity<double>);
    motion.advance(infinity<double>, 0.5, [](const Polhode<double>&, double) {});
    time = motion.time();
    end = taylor<long double, 24>(despin<long double>(), 1e-19L, time);
  }
};

const Reference& reference() {
  static std::unique_ptr<const Reference> both[2];
  auto& one = both[body];
  if (!one) one = std::make_unique<const Reference>();
  return *one;
}

/// Greater of the errors of |M| and k2.
double slow_error(const End& end) {
  const Vec3<double>&M = end.momentum, &R = reference().end.momentum;
  const Vec3<double> a = despin<double>().inverse_inertia;
  return std::max(std::abs(M.norm() - R.norm()),
                  std::abs(polhode_through<double>(a, M).modulus.k2 - polhode_through<double>(a, R).modulus.k2));
}

double vector_error(const End& end) { return (end.momentum - reference().end.momentum).norm(); }

/// The loosest tolerance from which on all tighter ones, in steps of a quarter decade, meet the wanted error too.
template <class Solve, class Error>
double loosest(const Solve& solve, const Error& error) {
  const double step = std::pow(10., .25);
  double tolerance = 1e-14;
  while (tolerance < 1e-2 && error(solve(tolerance * step)) <= wanted) tolerance *= step;
  return tolerance;
}

/// Times solve at its loosest tolerance and reports the true errors.
template <class Solve, class Error>
void measure(benchmark::State& state, const Solve& solve, const Error& error) {
  const double tolerance = loosest(solve, error);
  End end;
  for (auto _ : state) {
    end = solve(tolerance);
    benchmark::DoNotOptimize(end);
  }
  state.counters["norm_k2"] = slow_error(end);
  state.counters["vector"] = vector_error(end);
  state.counters["tolerance"] = tolerance;
  state.counters["rhs"] = static_cast<double>(end.rhs);
}

void averaged_despin(benchmark::State& state, int of) {
  body = of;
  const auto problem = despin<double>();
  measure(state, [&](double tolerance) { return averaged_2(problem, tolerance, reference().time); }, slow_error);
}
/// The direct methods: to 1e-6 in |M| and k2 alone, and to 1e-6 in M.
template <int Order>
void taylor_despin(benchmark::State& state, int of, double (*error)(const End&)) {
  body = of;
  const auto problem = despin<double>();
  measure(state, [&](double tolerance) { return taylor<double, Order>(problem, tolerance, reference().time); }, error);
}
void dop853_despin(benchmark::State& state, int of, double (*error)(const End&)) {
  body = of;
  const auto problem = despin<double>();
  measure(state, [&](double tolerance) { return dop853(problem, tolerance, reference().time); }, error);
}

void register_despins() {
  static const char* names[] = {"compact", "paper"};
  for (int of = 0; of < 2; ++of) {
    const std::string prefix = std::string("despin_") + names[of] + "/";
    const auto add = [&](const std::string& name, auto function, auto... arguments) {
      benchmark::RegisterBenchmark((prefix + name).c_str(), function, of, arguments...)->Unit(benchmark::kMicrosecond);
    };
    add("averaged-2", averaged_despin);
    add("taylor_16/norm_and_k2", taylor_despin<16>, slow_error);
    add("taylor_20/norm_and_k2", taylor_despin<20>, slow_error);
    add("dop853/norm_and_k2", dop853_despin, slow_error);
    add("taylor_16/vector", taylor_despin<16>, vector_error);
    add("taylor_20/vector", taylor_despin<20>, vector_error);
    add("dop853/vector", dop853_despin, vector_error);
  }
}

/// The mean rates over one orbit with rotor momentum.
void rotor_average(benchmark::State& state, Law law, double rotor) {
  body = 0;
  Problem<double> p = despin<double>();
  p.rotor_momentum = rotor * Vec3<double>(.2, .15, .3);
  p.law = p.drag_law = law;
  const auto orbit = Orbit<double>::through(p, p.momentum);
  if (!orbit) return state.SkipWithError("no orbit");
  for (auto _ : state) {
    auto mean = average<Elliptic>(p, orbit->level(), orbit->component());
    benchmark::DoNotOptimize(mean);
  }
  state.counters["nodes"] = static_cast<double>(average<Elliptic>(p, orbit->level(), orbit->component())->nodes);
}
BENCHMARK_CAPTURE(rotor_average, total_one_component, Law::total, 1.)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rotor_average, total_two_components, Law::total, .05)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rotor_average, carrier_one_component, Law::carrier, 1.)->Unit(benchmark::kMicrosecond);

/// A whole scene of 100 times down to the half, -log10 of the tolerance given; `model` is the place in the ladder that answered.
void whole_scene(benchmark::State& state, double rotor) {
  body = 0;
  Setup setup;
  setup.control = Vec3<double>(0.6e-4, 0.9e-4, 1e-4);
  setup.drag = 0.3e-4;
  setup.momentum = despin<double>().momentum;
  setup.rotor_momentum = rotor * Vec3<double>(.2, .15, .3);
  Question question;
  for (int i = 1; i <= 100; ++i) question.times.push_back(reference().time * i / 100);
  question.tolerance = std::pow(10., -static_cast<double>(state.range(0)));
  const auto scene = Scene::make(*Inertia<double>::from_moments(1.4, 1, 0.7), setup, question);
  Refusal refusal;
  Answer answer;
  for (auto _ : state) {
    answer = solve<>(*scene, refusal);
    benchmark::DoNotOptimize(answer);
  }
  state.counters["stated"] = answer.error;
  state.counters["met"] = answer.met;
  state.SetLabel(answer.model);
}
BENCHMARK_CAPTURE(whole_scene, no_rotor, 0.)->Arg(2)->Arg(3)->Arg(4)->Arg(6)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(whole_scene, rotor, 1.)->Arg(2)->Arg(3)->Arg(4)->Arg(6)->Arg(9)->Unit(benchmark::kMicrosecond);

/// Prints as usual and keeps the times for the ratios.
class Ratios : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) time_[run.benchmark_name()] = run.GetAdjustedCPUTime();
  }
  void Finalize() override {
    for (const char* of : {"despin_compact/", "despin_paper/"}) {
      const double fast = time_[std::string(of) + "averaged-2"];
      if (!(fast > 0)) continue;
      std::printf("\n%saveraged-2: %.2f us\n", of, fast);
      for (const auto& [name, time] : time_)
        if (name.rfind(of, 0) == 0 && time > fast)
          std::printf("%-48s %10.0f us, %6.0f times as long\n", name.c_str(), time, time / fast);
    }
  }

 private:
  std::map<std::string, double> time_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  register_despins();
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  return 0;
}
