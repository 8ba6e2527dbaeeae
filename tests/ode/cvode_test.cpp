// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/cvode.hpp"

#include "catch.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/ode/taylor.hpp"

// the library has it, which the tests of this folder do not link
template void gyrostat::deceleration::FullSystem<double, true, false>::expand<20>(double, double, double (&)[21][width],
                                                                                  Work<20>&) const noexcept;

using namespace gyrostat;
using namespace gyrostat::deceleration;
using ode::Cvode;
using ode::CvodeMethod;
using ode::CvodeOptions;
using ode::CvodeSystem;
using ode::Status;

namespace {

Problem<double> scene() {
  Problem<double> problem;
  problem.inverse_inertia = {1 / 1.4, 1, 1 / 0.7};
  problem.rotor_momentum = {0.2, 0.15, 0.3};
  problem.control.diagonal() = 1e-2 * Vec3<double>(0.6, 0.9, 1);
  problem.drag = 3e-3;
  problem.momentum = {0.8, 0.5, 0.33};
  return problem;
}

bool rhs(double, const double* y, double* rate, void* user) {
  const Vec3<double> f = momentum_rate<double>(*static_cast<Problem<double>*>(user), {y[0], y[1], y[2]});
  for (int i = 0; i < 3; ++i) rate[i] = f[i];
  return f.allFinite();
}

bool jacobian(double, const double* y, double* columns, void* user) {
  const Mat3<double> J = momentum_jacobian<double>(*static_cast<Problem<double>*>(user), {y[0], y[1], y[2]});
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) columns[3 * j + i] = J(i, j);
  }
  return J.allFinite();
}

double half(double, const double* y, void*) { return std::hypot(y[0], y[1], y[2]) - 0.5; }

double limit(double, const double* y, void* user) {
  return FullSystem<double, true, false>(*static_cast<Problem<double>*>(user)).step_limit(y);
}

CvodeSystem system_of(Problem<double>& problem) {
  CvodeSystem system;
  system.dimension = 3;
  system.rhs = rhs;
  system.jacobian = jacobian;
  system.user = &problem;
  return system;
}

Vec3<double> taylor_at(const Problem<double>& problem, double t) {
  using System = FullSystem<double, true, false>;
  ode::TaylorOptions<double, 4> options;
  options.tolerance = 1e-17;
  options.scale = {1, 1, 1, 0};
  const Vec3<double>& M = problem.momentum;
  ode::Taylor<System> solver(System(problem), 0, {M[0], M[1], M[2], 0}, options);
  REQUIRE(solver.advance(t) == Status::reached);
  return {solver.state()[0], solver.state()[1], solver.state()[2]};
}

}  // namespace

TEST_CASE("CVODE and Taylor series agree") {
  auto problem = scene();
  const Vec3<double> truth = taylor_at(problem, 40);
  for (const auto method : {CvodeMethod::adams, CvodeMethod::bdf}) {
    for (const bool analytic : {true, false}) {
      double last = 1;
      for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
        CvodeSystem system = system_of(problem);
        if (!analytic) system.jacobian = nullptr;
        auto made = Cvode::create(system, 0, {problem.momentum.data(), 3}, {method, tolerance, tolerance, 1000000});
        REQUIRE(made);
        Cvode solver = std::move(made).value();
        REQUIRE(solver.advance(40) == Status::reached);
        CHECK(solver.time() == 40);
        const auto y = solver.state();
        const double error = (Vec3<double>(y[0], y[1], y[2]) - truth).norm();
        CHECK(error < 3e3 * tolerance);
        CHECK(error < last);
        last = error;
        CHECK(solver.counts().steps > 100);
        CHECK(solver.counts().rhs >= solver.counts().steps);
      }
    }
  }
}

TEST_CASE("CVODE takes no step that is longer than it may be") {
  auto problem = scene();
  for (const double longest : {0.5, 0.05}) {
    auto made = Cvode::create(system_of(problem), 0, {problem.momentum.data(), 3},
                              {CvodeMethod::adams, 1e-4, 1e-4, 1000000, longest});
    REQUIRE(made);
    Cvode solver = std::move(made).value();
    double last = 0;
    while (solver.time() < 10) {
      REQUIRE(solver.step(10) == Status::reached);
      CHECK(solver.time() - last <= longest * (1 + 1e-12));
      last = solver.time();
    }
    CHECK(double(solver.counts().steps) >= 10 / longest);
  }
}

TEST_CASE("CVODE stops at an event and reads its last step") {
  auto problem = scene();
  CvodeSystem system = system_of(problem);
  system.event = half;
  auto made = Cvode::create(system, 0, {problem.momentum.data(), 3}, {CvodeMethod::adams, 1e-11, 1e-12});
  REQUIRE(made);
  Cvode solver = std::move(made).value();
  REQUIRE(solver.advance(1000) == Status::event);
  CHECK(std::hypot(solver.state()[0], solver.state()[1], solver.state()[2]) == Approx(0.5).epsilon(1e-11));
  CHECK((taylor_at(problem, solver.time()).norm()) == Approx(0.5).epsilon(1e-7));
  const double t = solver.time();
  REQUIRE(solver.step(1000) == Status::reached);
  CHECK(solver.time() > t);
  std::array<double, 3> y{};
  const double inside = (t + solver.time()) / 2;
  REQUIRE(solver.at(inside, y));
  CHECK((Vec3<double>(y[0], y[1], y[2]) - taylor_at(problem, inside)).norm() < 1e-7);
  CHECK(!solver.at(2000, y));
}

TEST_CASE("CVODE does not step over rest where the step is limited") {
  auto problem = scene();
  problem.rotor_momentum.setZero();
  problem.drag = 0;
  problem.control = 0.01 * Mat3<double>::Identity();
  CvodeSystem system = system_of(problem);
  system.step_limit = limit;
  auto made = Cvode::create(system, 0, {problem.momentum.data(), 3}, {CvodeMethod::adams, 1e-10, 1e-13});
  REQUIRE(made);
  Cvode solver = std::move(made).value();
  const double stop = problem.momentum.norm() / 0.01;
  double size = 1;
  for (int i = 0; i < 100000 && size > 1e-8; ++i) {
    REQUIRE(solver.step(infinity<double>) == Status::reached);
    const double next = std::hypot(solver.state()[0], solver.state()[1], solver.state()[2]);
    CHECK(next < size);
    size = next;
  }
  CHECK(solver.time() == Approx(stop).epsilon(1e-6));
}

TEST_CASE("CVODE ends at once where the numbers end") {
  auto problem = scene();
  const CvodeSystem system = system_of(problem);
  const double bad[3] = {1, std::numeric_limits<double>::quiet_NaN(), 0};
  CHECK(Cvode::create(system, 0, {bad, 3}).error() == Errc::not_finite);
  CHECK(Cvode::create(system, 0, {problem.momentum.data(), 2}).error() == Errc::out_of_domain);
  CHECK(Cvode::create(CvodeSystem{}, 0, {}).error() == Errc::not_positive);
  CHECK(Cvode::create(system, 0, {problem.momentum.data(), 3}, {CvodeMethod::bdf, -1}).error() == Errc::not_positive);

  // the equations have no value at rest
  const double rest[3] = {0, 0, 0};
  auto made = Cvode::create(system, 0, {rest, 3});
  REQUIRE(made);
  Cvode solver = std::move(made).value();
  CHECK(solver.advance(10) == Status::not_finite);

  auto capped = Cvode::create(system, 0, {problem.momentum.data(), 3}, {CvodeMethod::adams, 1e-9, 1e-9, 10});
  REQUIRE(capped);
  Cvode short_of = std::move(capped).value();
  CHECK(short_of.advance(1000) == Status::step_limit);
  CHECK(short_of.counts().steps == 10);
  CHECK(short_of.advance(std::numeric_limits<double>::quiet_NaN()) == Status::not_finite);
  CHECK(Cvode::version()[0] >= '6');
}
