// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/full_motion.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "../../models/free/gyrostats.hpp"
#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/core/compensated.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/math/quadrature.hpp"
#include "gyrostat/models/free/motion.hpp"

namespace free_full_motion_test {

using namespace gyrostat;
using namespace free_bodies;
using ode::Status;
namespace full_column = gyrostat::free::full_column;
using gyrostat::free::full_motion;
using gyrostat::free::FullErrors;
using gyrostat::free::FullMotionAnswer;
using gyrostat::free::FullMotionOptions;
using gyrostat::free::FullRow;
using gyrostat::free::FullState;
using gyrostat::free::Motion;
using gyrostat::free::turning_rate;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool slow_build = true;
#else
constexpr bool slow_build = false;
#endif

template <Real S>
struct FullRun {
  FullMotionAnswer<S> answer;
  std::vector<FullState<S>> states;
};

template <Real S>
FullRun<S> run_full(const Problem<S>& problem, const std::vector<S>& times, S tolerance) {
  FullRun<S> made;
  made.states.resize(times.size());
  FullMotionOptions<S> options;
  options.tolerance = tolerance;
  options.step_cap = 1'000'000;
  const auto answer = full_motion<S>(problem, times, made.states, options);
  REQUIRE(answer);
  made.answer = *answer;
  return made;
}

/// The closed form at the times, the integral of omega by Gauss and Kronrod's rule on parts of half a radian. times[0] == 0.
std::vector<FullState<double>> closed_form(const Motion<double>& motion, double rate,
                                           const std::vector<double>& times) {
  std::vector<FullState<double>> states;
  std::array<Sum<double>, 3> W{};
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && motion.kind() != free::Kind::steady) {
      const double whole = times[i] - times[i - 1];
      const int parts = 1 + int(2 * rate * whole);
      for (int k = 0; k < parts; ++k)
        for (const auto& point : math::kronrod_points<double>) {
          const Vec3<double> w = motion.at(times[i - 1] + whole / parts * (k + 0.5 + point.node / 2)).angular_velocity;
          for (int j = 0; j < 3; ++j)
            W[std::size_t(j)] = add(W[std::size_t(j)], whole / parts / 2 * point.weight * w[j]);
        }
    } else if (i > 0) {
      for (int j = 0; j < 3; ++j) W[std::size_t(j)].high = times[i] * motion.at(0).angular_velocity[j];
    }
    const auto s = motion.at(times[i]);
    states.push_back({s.attitude, s.angular_velocity, s.angular_momentum, {W[0].high, W[1].high, W[2].high}});
  }
  return states;
}

FullErrors<double> true_errors(const Problem<double>& problem, const std::vector<FullState<double>>& truth,
                               const std::vector<FullState<double>>& states) {
  Comparison both{FullRow<double>(problem)};
  for (std::size_t i = 0; i < truth.size(); ++i) both.add(truth[i], states[i]);
  return both.relative(both.difference());
}

struct Tally {
  int met = 0, all = 0;
  std::vector<double> stated_over_true;
};

/// Compares with the closed form: stated errors bound the true ones, and those of an answer that is met are within the tolerance.
void check_stated(const Problem<double>& problem, const std::vector<double>& times, double tolerance, Tally& tally) {
  const auto motion = Motion<double>::make<DoubleDouble>(problem.cast<DoubleDouble>());
  REQUIRE(motion);
  const auto run = run_full<double>(problem, times, tolerance);
  REQUIRE(run.answer.status == Status::reached);
  const auto truth = closed_form(*motion, turning_rate(problem), times);
  const auto errors = true_errors(problem, truth, run.states);
  ++tally.all;
  tally.met += run.answer.met;
  // of the truth itself
  const double known = 4e-15 * motion->cancellation(times.back());
  for (std::size_t i = 0; i < 4; ++i) {
    const double stated = run.answer.error[i];
    CAPTURE(i, errors[i], stated, run.answer.met, run.answer.counts.steps, run.answer.step_tolerance);
    CHECK(errors[i] - known <= stated);
    if (run.answer.met) CHECK(errors[i] - known <= tolerance);
    if (errors[i] > known && stated < 0.1) tally.stated_over_true.push_back(stated / errors[i]);
  }
}

TEST_CASE("stated errors of the full free equations bound the true ones", "[free]") {
  constexpr double tolerances[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11};
  for (const Regime regime : regimes) {
    Bodies bodies(71);
    Tally tally;
    const int count = slow_build ? 4 : 20;
    for (int i = 0; i < count; ++i) {
      const auto p = bodies.of(regime, i);
      const double turn = 6.3 / turning_rate(p), end = bodies.scale(0, 1.7) * turn;
      // every fourth: the answer at one late time alone
      std::vector<double> times{0};
      if (i % 4 != 3)
        for (int k = 1; k < 10; ++k) times.push_back(end * k / 10);
      times.push_back(end);
      CAPTURE(free_bodies::name(regime), i, end / turn);
      check_stated(p, times, tolerances[i % 5], tally);
    }
    CAPTURE(free_bodies::name(regime), tally.met, tally.all);
    std::sort(tally.stated_over_true.begin(), tally.stated_over_true.end());
    CHECK(tally.stated_over_true[tally.stated_over_true.size() / 2] < 200);
    if (regime == Regime::generic || regime == Regime::close_moments || regime == Regime::equal_moments)
      CHECK(tally.met == tally.all);
  }
}

TEST_CASE("flips about the middle axis are stated by the full free equations as far as they are known", "[free]") {
  Tally tally;
  for (const double off : {1e-2, 1e-5, 1e-9, 1e-14}) {
    for (const double end : {20., 100., 400.}) {
      Problem<double> p = Problem<double>::from_moments({3, 2, 1.2}, {0, 0, 0}, {off, 2, -off});
      CAPTURE(off, end);
      for (const double tolerance : {1e-4, 1e-9}) check_stated(p, {0, end / 2, end}, tolerance, tally);
      p.rotor_momentum = {0, 0.3, 0};
      check_stated(p, {0, end}, 1e-7, tally);
    }
  }
  CHECK(tally.met > 6);
  // on the axis itself the body stays, and is known to
  const auto on = Problem<double>::from_moments({3, 2, 1.2}, {0, 0.3, 0}, {0, 2, 0});
  CHECK(run_full<double>(on, {1000}, 1e-10).answer.met);
}

TEST_CASE("axes that are not principal change nothing in the full free equations", "[free]") {
  Bodies bodies(72);
  for (int i = 0; i < 12; ++i) {
    auto p = bodies.of(i % 2 ? Regime::generic : Regime::little_momentum, i);
    const Mat3<double> R = to_matrix(bodies.attitude());
    p.inertia = R * p.inertia * R.transpose();
    p.inertia = (p.inertia + p.inertia.transpose()).eval() / 2;
    p.rotor_momentum = R * p.rotor_momentum;
    p.angular_velocity = R * p.angular_velocity;
    Tally tally;
    check_stated(p, {0, 1, 30}, 1e-9, tally);
    p.angular_momentum = p.inertia * p.angular_velocity + p.rotor_momentum;
    p.momentum_given = true;
    check_stated(p, {0, 1, 30}, 1e-9, tally);
    CHECK(tally.met == 2);
  }
}

TEST_CASE("rest, spheres and vanishing momentum in the full free equations", "[free]") {
  const std::vector<double> times{0, 1, 50, 1000};
  auto rest = Problem<double>::from_moments({3, 2, 1.5}, {1, -2, 0.5}, {0, 0, 0});
  for (const Vec3<double>& l : {Vec3<double>(1, -2, 0.5), Vec3<double>(0, 0, 0)}) {
    rest.rotor_momentum = l;
    const auto made = run_full<double>(rest, times, 1e-12);
    CHECK(made.answer.met);
    CHECK(made.states[3].angular_velocity.isZero(0));
    CHECK(made.states[3].turned.isZero(0));
    CHECK(made.states[3].attitude.w == 1);
  }
  Tally tally;
  check_stated(Problem<double>::from_moments({2, 2, 2}, {0.3, 0.4, -0.2}, {1, 2, 3}), {0, 1, 50}, 1e-10, tally);
  check_stated(Problem<double>::from_moments({2, 2, 2}, {0, 0, 0}, {1, 2, 3}), {0, 1, 50}, 1e-10, tally);
  check_stated(Problem<double>::from_moments({4, 3, 2}, {-2, -3, -.5}, {.5, 1, .25}), {0, 1, 50}, 1e-10, tally);
  check_stated(Problem<double>::from_moments({4, 3, 2}, {0, 0, .5}, {0, 0, .25}), {0, 1, 50}, 1e-10, tally);
  CHECK(tally.met == 4);
}

TEST_CASE("a companion that runs alone is not near by chance beside the middle axis", "[free]") {
  Problem<double> problem;
  problem.inertia << 0.029001510775688518, -0.002785352288565872, 0.0018508892419081913,  //
      -0.002785352288565872, 0.03168233909397403, 0.001770549165917692,                   //
      0.0018508892419081913, 0.001770549165917692, 0.03102551867971546;
  problem.angular_velocity = {-4.317617460330585, 0.3796768783022357, -6.698841320139436};
  problem.momentum_given = false;
  Tally tally;
  check_stated(problem, {0, 14.55995659634997, 20.799937994785672}, 1e-3, tally);
  CHECK(tally.met == 1);
}

TEMPLATE_TEST_CASE("the full free equations meet the tolerance of every precision", "[free]", float, double,
                   long double) {
  using S = TestType;
  const auto p = Problem<S>::from_moments({3, 2, S(1.5L)}, {S(0.3L), S(-0.5L), S(0.2L)}, {1, S(0.5L), S(-0.7L)});
  const auto made = run_full<S>(p, {S(1), S(5)}, 4000 * epsilon<S>);
  CHECK(made.answer.status == Status::reached);
  CHECK(made.answer.met);
}

TEST_CASE("what the full free equations cannot answer is refused", "[free]") {
  const auto good = Problem<double>::from_moments({3, 2, 1.5}, {0.1, 0, 0}, {1, 2, 3});
  std::vector<FullState<double>> states(2);
  const auto error = [&](std::vector<double> times, const Problem<double>& problem, double tolerance = 1e-9) {
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    return full_motion<double>(problem, times, states, options).error();
  };
  constexpr double no = gyrostat::nan<double>;
  CHECK(error({1, 2}, good) == Errc::ok);
  CHECK(error({1}, good) == Errc::out_of_domain);
  CHECK(error({2, 1}, good) == Errc::not_increasing);
  CHECK(error({-1, 1}, good) == Errc::not_increasing);
  CHECK(error({1, no}, good) == Errc::not_finite);
  CHECK(error({1, infinity<double>}, good) == Errc::not_finite);
  CHECK(error({1, 2}, good, no) == Errc::not_finite);
  auto bad = good;
  bad.angular_velocity[1] = no;
  CHECK(error({1, 2}, bad) == Errc::not_finite);
  bad = good;
  bad.rotor_momentum[1] = infinity<double>;
  CHECK(error({1, 2}, bad) == Errc::not_finite);
  bad = good;
  bad.attitude = {1, 1, 0, 0};
  CHECK(error({1, 2}, bad) == Errc::out_of_domain);
  bad = good;
  bad.inertia(0, 0) = 9;
  CHECK(error({1, 2}, bad) == Errc::triangle_inequality);
  bad = good;
  bad.angular_velocity = {1e200, 1e308, 1e308};
  CHECK(error({1, 2}, bad) == Errc::not_finite);

  const auto none = full_motion<double>(good, {}, {});
  REQUIRE(none);
  CHECK(none->met);

  FullMotionOptions<double> options;
  options.step_cap = 5;
  const std::vector<double> times{0.01, 1e6};
  const auto capped = full_motion<double>(good, times, states, options);
  REQUIRE(capped);
  CHECK(capped->status == Status::step_limit);
  CHECK_FALSE(capped->met);
  CHECK(std::isfinite(states[0].turned[0]));
  CHECK(std::isnan(states[1].turned[0]));
}

TEST_CASE("the full free equations can be watched and stopped, and need no memory", "[free]") {
  const auto p = Problem<double>::from_moments({3, 2, 1.5}, {0.3, -0.5, 0.2}, {1, 0.5, -0.7});
  std::vector<FullState<double>> states(3);
  Monitor monitor;
  FullMotionOptions<double> options;
  options.monitor = &monitor;
  const std::vector<double> times{0, 1, 400};
  const auto before = allocations();
  const auto answer = full_motion<double>(p, times, states, options);
  CHECK(allocations() == before);
  REQUIRE(answer);
  CHECK(answer->met);
  CHECK(monitor.fraction == 1);
  CHECK((states[0].angular_velocity - p.angular_velocity).norm() < 4e-16);
  monitor.cancel = true;
  CHECK(full_motion<double>(p, times, states, options)->status == Status::cancelled);
}

}  // namespace free_full_motion_test
