// SPDX-License-Identifier: BSD-3-Clause
// The failure map of docs/spinning.md, section 8, row by row: a right answer with an honest error, or a refusal.
#include <cmath>
#include <cstring>

#include "catch.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

bool warns(const Answer& answer, const char* code) { return answer.warns(code); }

double number_of(const Answer& answer, const char* name) {
  const Quantity* const found = answer.quantity(name);
  REQUIRE(found != nullptr);
  return found->values[0];
}

bool by(const Answer& answer, const char* model) { return std::strcmp(answer.model, model) == 0; }

/// The answer, seen to be within its stated errors, and within the tolerance where it says so.
Answer honest(const Problem<double>& problem, double span, double tolerance, int model = any_rung) {
  const auto scene = posed(problem, span, tolerance, model);
  Refusal refusal;
  const Answer answer = spinning::solve(scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  check_honest(scene, answer);
  if (model == any_rung) CHECK(answer.met);
  return answer;
}

/// Spins at 1 rad/s under a thrust off its axis.
Problem<double> stage(double torque) {
  Problem<double> p;
  p.inertia = {8, 9, 12};
  p.mass = 10;
  p.angular_velocity = {0, 0, 1};
  p.torque = {torque, torque / 2, 0};
  p.force = {0.1, -0.2, 3};
  return p;
}

constexpr double detunings[] = {1e-2, 1e-6, 1e-10, 0};

/// The small-tilt motion where nothing divides by what vanishes, and the ladder at any tolerance.
void check_all(const Problem<double>& p, double span) {
  CHECK(by(honest(p, span, 1e-2), "linear"));
  honest(p, span, 1e-6);
  honest(p, span, 1e-9);
}

}  // namespace

TEST_CASE("failure map: no gyroscopic stiffness", "[spinning]") {
  for (const double detuning : detunings) {
    CAPTURE(detuning);
    auto p = stage(1e-3);
    p.rotor_momentum = -12 + 20 * detuning;
    REQUIRE(p.effective_momentum() == Approx(20 * detuning).margin(1e-14));
    check_all(p, 20);
    CHECK(warns(honest(p, 20, 1e-2), "no-stiffness") == (detuning < 5e-3));
  }
  auto p = stage(1e-3);
  p.rotor_momentum = -12;
  CHECK(std::isnan(number_of(honest(p, 20, 1e-2), "pointing_error")));
}

TEST_CASE("failure map: resonance of spin and nutation", "[spinning]") {
  for (const double second : {9.0, 8.0}) {
    for (const double detuning : detunings) {
      CAPTURE(second, detuning);
      auto p = stage(1e-2);
      p.inertia[1] = second;
      p.rotor_momentum = (8 + second) * (1 + detuning) - 12;
      check_all(p, 40);
      CHECK(warns(honest(p, 40, 1e-2), "resonance"));
    }
  }
  // a plate is there without a rotor
  auto p = stage(1e-2);
  p.inertia = {5, 7, 12};
  CHECK(warns(honest(p, 40, 1e-2), "resonance"));
}

TEST_CASE("failure map: no nutation", "[spinning]") {
  for (const double detuning : detunings) {
    CAPTURE(detuning);
    auto p = stage(3e-4);
    p.rotor_momentum = -3 * (1 - detuning);  // kappa1 = 0
    check_all(p, 30);
    p.rotor_momentum = -4 * (1 - detuning);  // kappa2 = 0
    check_all(p, 30);
  }
}

TEST_CASE("failure map: unstable spin", "[spinning]") {
  auto intermediate = stage(1e-5);
  intermediate.inertia = {8, 12, 10};
  auto wheel = stage(1e-6);
  wheel.rotor_momentum = -3.5;
  for (const auto& p : {intermediate, wheel}) {
    REQUIRE(p.nutation_squared() < 0);
    const double span = 6 / std::sqrt(-p.nutation_squared());
    const Answer answer = honest(p, span, 1e-2);
    CHECK(by(answer, "linear"));
    CHECK(warns(answer, "unstable-spin"));
    CHECK(std::isnan(number_of(answer, "pointing_error")));
    CHECK(number_of(answer, "nutation_frequency_squared") < 0);
    // it grows out of all small tilt
    CHECK(by(honest(p, 4 * span, 1e-3), "full"));
  }
}

TEST_CASE("failure map: prolate bodies", "[spinning]") {
  auto p = stage(1e-2);
  p.inertia = {12, 11, 6};
  check_all(p, 40);
  const Answer answer = honest(p, 40, 1e-2);
  CHECK(answer.warnings.empty());
  CHECK(number_of(answer, "nutation_frequency_squared") > 0);
}

TEST_CASE("failure map: a sphere", "[spinning]") {
  auto p = stage(3e-4);
  p.inertia = {9, 9, 9};
  check_all(p, 30);
  CHECK(warns(honest(p, 30, 1e-2), "unstable-spin"));
}

TEST_CASE("failure map: little spin and none", "[spinning]") {
  for (const double spin : {1e-2, 1e-6, 1e-12, 0.0}) {
    CAPTURE(spin);
    auto p = stage(1e-4);
    p.angular_velocity[2] = spin;
    check_all(p, 20);
    const Answer answer = honest(p, 20, 1e-2);
    CHECK(warns(answer, "no-spin") == (spin == 0));
    CHECK(std::isnan(number_of(answer, "pointing_error")) == (spin == 0));
  }
}

TEST_CASE("failure map: spin the other way round", "[spinning]") {
  auto p = stage(1e-2), flipped = p;
  p.rotor_momentum = 2;
  // half a turn of all axes about axis 1
  flipped.rotor_momentum = -2;
  for (auto* v : {&flipped.torque, &flipped.force, &flipped.angular_velocity}) {
    (*v)[1] *= -1;
    (*v)[2] *= -1;
  }
  for (const double tolerance : {1e-2, 1e-9}) {
    const Answer a = honest(p, 40, tolerance), b = honest(flipped, 40, tolerance);
    CHECK(std::strcmp(a.model, b.model) == 0);
    // the neighbours of the estimate are not turned with the axes
    CHECK((a.error < 2 * b.error && b.error < 2 * a.error));
    const auto &x = a.find("position")->values, &y = b.find("position")->values;
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK(y[i] == Approx(i % 3 == 0 ? x[i] : -x[i]).epsilon(1e-9).margin(1e-9));
    CHECK(number_of(a, "pointing_error") == Approx(number_of(b, "pointing_error")));
  }
}

TEST_CASE("failure map: tilt that is not small", "[spinning]") {
  for (const double torque : {0.5, 2.0, 8.0}) {
    CAPTURE(torque);
    const auto p = stage(torque);
    const Answer answer = honest(p, 30, 1e-3);
    CHECK(by(answer, "full"));
    const Answer linear = honest(p, 30, 1e-3, rung::linear);
    CHECK_FALSE(linear.met);
    if (torque > 1) {
      CHECK(warns(linear, "beyond-validity"));
      CHECK(answer.tried[0].why != nullptr);
      CHECK(number_of(answer, "tilt_max") > 0.2);
    }
  }
}

TEST_CASE("failure map: many turns", "[spinning]") {
  const auto p = stage(3e-2);
  CHECK(by(honest(p, 10, 5e-2), "linear"));
  const Answer late = honest(p, 2e3, 5e-2);
  const auto linear_try = [&] {
    return *std::find_if(late.tried.begin(), late.tried.end(),
                         [](const Attempt& a) { return std::string_view(a.model) == "linear"; });
  };
  CHECK(linear_try().error > 5e-2);
  const Answer linear = honest(p, 2e3, 1e-2, rung::linear);
  CHECK_FALSE(linear.met);
  CHECK(linear.find("attitude")->error > 0.05);
}

TEST_CASE("failure map: the charge turns the body and does not push it", "[spinning]") {
  auto p = stage(1e-2);
  p.charge_momentum = 0.5;
  check_all(p, 20);
  p.force.setZero();
  p.velocity = {50, 20, 10};
  const Answer answer = honest(p, 20, 1e-9);
  for (std::size_t i = 0; i < answer.find("velocity")->values.size(); i += 3) {
    CHECK(answer.find("velocity")->values[i] == 50);
    CHECK(answer.find("velocity")->values[i + 1] == 20);
    CHECK(answer.find("velocity")->values[i + 2] == 10);
  }
}

TEST_CASE("failure map: bodies that cannot be", "[spinning]") {
  Question question;
  question.times = {1};
  auto p = stage(0);
  p.inertia = {5, 6, 12};
  CHECK(Scene::make(p, question).error() == Errc::triangle_inequality);
  p.inertia = {5, 7, 12};
  CHECK(Scene::make(p, question));
  p.inertia = {-5, 7, 12};
  CHECK(Scene::make(p, question).error() == Errc::not_positive);
}

TEST_CASE("failure map: torque about the spin axis", "[spinning]") {
  for (const double change : {0.5, -0.5, -1.7}) {
    CAPTURE(change);
    auto p = stage(3e-4);
    p.rotor_momentum = 2;
    p.torque[2] = 12 * change / 40;
    const Answer answer = honest(p, 40, 1e-2, rung::linear);
    CHECK(answer.met);
    CHECK(warns(answer, "spin-reversal") == (change < -1));
    CHECK(std::isnan(number_of(answer, "pointing_error")));
    CHECK(by(honest(p, 40, 1e-7), "full"));
    // constant spin would be far off
    const auto& angles = answer.find("euler_312")->values;
    CHECK(std::abs(Linear<double>(p).at(40).angles.theta - angles[angles.size() - 1]) > 1);
  }
}
