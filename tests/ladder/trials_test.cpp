// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/trials.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

struct Trial {
  ode::Status status = ode::Status::reached;
  bool met = false;
  double error = 0;
  ode::Counts counts{1, 10, 0};
};
struct Options {
  double tolerance = 1e-9;
  std::atomic<double>* progress = nullptr;
  void report(double done) const { progress->store(done); }
  double excess(const Trial& trial) const { return trial.error / tolerance; }
};

/// Errors are `gain` step tolerances.
std::vector<double> tolerances(double gain, double first, Trial* last = nullptr,
                               ode::Status status = ode::Status::reached) {
  std::vector<double> tried;
  std::atomic<double> progress{0};
  double until = 0;
  const Trial answer =
      tightened<double>(Options{1e-9, &progress}, first, [&](double step, double by, double from, double to) {
        CHECK(step == (tried.empty() ? first : std::max(finest_step_tolerance<double>, tried.back() / by)));
        CHECK(from == until);
        CHECK(to > from);
        until = to;
        tried.push_back(step);
        Trial trial;
        trial.status = status;
        trial.error = gain * step;
        trial.met = status == ode::Status::reached && trial.error <= 1e-9;
        return trial;
      });
  CHECK(progress == 1);
  CHECK(answer.counts.steps == 10 * tried.size());
  if (last) *last = answer;
  return tried;
}

}  // namespace

TEST_CASE("a run is tried again as much tighter as its error asks, and twice at most") {
  Trial last;
  CHECK(tolerances(1, 1e-10).size() == 1);
  const auto twice = tolerances(1e3, 1e-10, &last);
  REQUIRE(twice.size() == 2);
  CHECK(twice[1] == Approx(1e-10 / 800));
  CHECK(last.met);
  CHECK(tolerances(1e30, 1e-10, &last).back() == finest_step_tolerance<double>);
  CHECK(!last.met);
  CHECK(tolerances(1e30, 1e-10).size() == 2);  // nothing is tighter than the finest
  CHECK(tolerances(gyrostat::nan<double>, 1e-10).size() == 2);
  CHECK(tolerances(1e3, 1e-10, nullptr, ode::Status::cancelled).size() == 1);
}

TEST_CASE("the first guess of the step tolerance falls with the angle turned through, within its bounds") {
  CHECK(first_step_tolerance(1e-3, 0.0, 1e-8) == 1e-8);
  CHECK(first_step_tolerance(1e-9, 0.0, 1e-8) == Approx(1e-9 * honesty::first_share / 8));
  CHECK(first_step_tolerance(1e-9, 1600.0, 1e-8) == Approx(1e-9 * honesty::first_share / 108));
  CHECK(first_step_tolerance(1e-30, 0.0, 1e-8) == finest_step_tolerance<double>);
}

TEST_CASE("the phase of a body without weight errs with the square of the angle", "[ladder]") {
  const auto plain = [](double tolerance, double phase) { return first_step_tolerance(tolerance, phase, 1e-9); };
  const auto made = [](double tolerance, double phase) {
    return first_step_tolerance_of_phase(tolerance, phase, 1e-9);
  };
  CHECK(made(1e-3, 300) == 1e-9);
  CHECK(made(1e-6, 3e3) == Approx(1e-6 * honesty::first_share / (8 + honesty::first_drift * 9e6)));
  CHECK(made(1e-9, 1e4) == honesty::drifting_least);
  CHECK(made(1e-12, 1e3) == plain(1e-12, 1e3));
  CHECK(made(1e-12, 1e9) == plain(1e-12, 1e9));
}

TEST_CASE("a run of so many steps that another would take seconds is not tried again") {
  std::atomic<double> progress{0};
  int runs = 0;
  tightened<double>(Options{1e-9, &progress}, 1e-10, [&](double, double, double, double) {
    ++runs;
    Trial trial;
    trial.error = {1};
    trial.counts.steps = 4'000'000;
    return trial;
  });
  CHECK(runs == 1);
}

TEST_CASE("a companion takes tighter steps down to the finest, and rounding rules where steps are fine", "[ladder]") {
  CHECK(companion_step(1e-9) == 1e-9 / honesty::side_by_side.tighter);
  CHECK(data_change(1e-12) == honesty::side_by_side.data_change * epsilon<double>);
  CHECK(data_change(1e-9) == honesty::alone_change * epsilon<double>);  // no second one beside it
  CHECK(data_change(1e-9, {10., 1.}) == data_change(1e-12));
  CHECK(companion_step(finest_step_tolerance<double>) == finest_step_tolerance<double>);
  CHECK_FALSE(rounding_rules(1e-9));
  CHECK(rounding_rules(epsilon<double>));
  CHECK(rounding_rules(1e-9, {1., 1e6}));
}

TEST_CASE("steps of spinners are looser where two companions judge them", "[ladder]") {
  const auto plain = [](double tolerance, double phase) {
    return first_step_tolerance(tolerance, phase, honesty::loosest_step);
  };
  const auto made = [](double tolerance, double phase) { return first_step_tolerance_of_spinner(tolerance, phase); };
  CHECK(made(1e-3, 100) == plain(1e-3, 100));
  CHECK(made(1e-8, 10) == plain(1e-8, 10));
  CHECK(made(1e-9, 1000) > plain(1e-9, 1000));
  CHECK(rounding_rules(made(1e-9, 1000)));
  CHECK(made(1e-12, 1000) == Approx(honesty::spinning_share * plain(1e-12, 1000)));
}

TEST_CASE("neighbours lie in two directions, far apart along every axis", "[ladder]") {
  const auto a = neighbour_direction<double>(Aside::first), b = neighbour_direction<double>(Aside::second);
  CHECK(std::abs(a.norm() - 1) < 1e-2);
  CHECK(std::abs(b.norm() - 1) < 1e-2);
  CHECK(std::abs(a.dot(b)) < 0.1);
  CHECK((a - b).cwiseAbs().minCoeff() > 0.75);
}

TEST_CASE("where the start decides two neighbours lie on opposite sides", "[ladder]") {
  CHECK(second_aside<double>({1e9, 1}) == Aside::second);
  CHECK(second_aside<double>({1, honesty::unstable_condition}) == Aside::opposite);
  CHECK(neighbour_direction<double>(Aside::opposite) == -neighbour_direction<double>(Aside::first));
  CHECK(moment_shifts<double>(Aside::opposite) == -moment_shifts<double>(Aside::first));
  CHECK(tensor_shifts<double>(Aside::opposite) == -tensor_shifts<double>(Aside::first));
  CHECK(tensor_shifts<double>(Aside::second) != -tensor_shifts<double>(Aside::first));
}

TEST_CASE("a start counts more where it is next to an unstable steady rotation") {
  const Vec3<double> moments{1, 2, 3};
  const auto of = [](const Vec3<double>& inertia, const Vec3<double>& rate, const Vec3<double>& rotor) {
    return start_sensitivity<double>(inertia.cwiseProduct(rate) + rotor, rate, inertia.cwiseInverse().asDiagonal());
  };
  const Vec3<double> none{0, 0, 0};
  const double more = honesty::unstable_condition;
  CHECK(of(moments, {1e-5, 1, -1e-9}, none) == more);
  CHECK(of(moments, {0, -1, 1e-4}, none) == more);
  CHECK(of(moments, {0.3, 1, 0}, none) == 1);
  CHECK(of(moments, {1, 1e-7, 0}, none) == 1);
  CHECK(of(moments, {0, 1e-7, 1}, none) == 1);
  CHECK(of(moments, none, none) == 1);
  // a rotor holds the middle axis, and makes that of the greatest moment unstable from l = -(J3 - J2) w on
  CHECK(of(moments, {1e-5, 1, 0}, {0, 1.5, 0}) == 1);
  CHECK(of(moments, {0, 1e-5, 1}, {0, 0, -0.9}) == 1);
  CHECK(of(moments, {0, 1e-5, 1}, {0, 0, -1.1}) == more);
}

TEST_CASE("the direction that leaves an unstable rotation is what grows sees of a change of the momentum") {
  const Vec3<double> moments{1, 2, 3};
  const Vec3<double> rates[] = {{1e-9, 1, -1e-9}, {0, -1, 0}, {0.48, 0.6, 0.64}, {-0.3, 0.2, 0.9}};
  for (const Vec3<double>& w : rates) {
    const Mat3<double> inverse = moments.cwiseInverse().asDiagonal();
    // rotors that make it a steady rotation, of a momentum that leaves it unstable
    for (const double along : {0.5, 1.8, 2.0, 2.2, 4.0}) {
      const Vec3<double> M = along * w;
      const auto leaving = leaving_direction<double>(M, w, inverse);
      if (leaving.isZero(0)) continue;
      CHECK(std::abs(leaving.dot(M)) < 1e-8 * leaving.norm() * M.norm());
      // dM/dt = M x w, w = inverse (M - l)
      const auto rate = [&](const Vec3<double>& d) -> Vec3<double> {
        return cross<double>(d, w) + cross<double>(M, inverse * d);
      };
      const Vec3<double> one = cross<double>(leaving, M).normalized(), two = leaving.normalized();
      const double grows = leaving.dot(rate(two)) / leaving.norm();
      CHECK(grows > 0);
      CHECK(std::abs(leaving.dot(rate(one))) < 1e-7 * leaving.norm() * grows);
    }
  }
  CHECK(!leaving_direction<double>({0, 2, 0}, {0, 1, 0}, moments.cwiseInverse().asDiagonal()).isZero(0));
  CHECK(leaving_direction<double>({0, 0, 3}, {0, 0, 1}, moments.cwiseInverse().asDiagonal()).isZero(0));
}
