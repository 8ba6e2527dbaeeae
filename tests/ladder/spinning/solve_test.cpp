// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/solve.hpp"

#include <cstring>

#include "catch.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

/// The published body and data.
Problem<double> paper_scene() {
  Problem<double> p;
  p.inertia = {8.7, 8.6, 11.1};
  p.mass = 10;
  p.rotor_momentum = 1.3;
  p.charge_momentum = 0.2909980111105094;
  p.angular_velocity = {0, 0, 0.2827433388230814};
  p.torque = {4, 0, 0};
  p.force = {0, 0, 3};
  return p;
}

struct Solved {
  Answer answer;
  Refusal refusal;

  bool by(const char* model) const { return std::strcmp(answer.model, model) == 0; }
  bool warns(const char* code) const { return answer.warns(code); }
  const Quantity& scalar(const char* name) const {
    REQUIRE(answer.quantity(name) != nullptr);
    return *answer.quantity(name);
  }
};

Solved solved(const Scene& scene, Monitor* monitor = nullptr) {
  Solved made;
  made.answer = spinning::solve(scene, made.refusal, monitor);
  return made;
}

}  // namespace

TEST_CASE("the published data climb to the full equations", "[spinning]") {
  const auto scene = posed(paper_scene(), 50, 1e-6, any_rung, 100);
  const Solved made = solved(scene);
  CHECK(made.refusal.code == Errc::ok);
  CHECK(made.by("full"));
  CHECK(made.answer.met);
  CHECK(made.answer.tried.size() == 3);
  for (const Attempt& attempt : made.answer.tried) CHECK((attempt.why != nullptr) == !attempt.accepted);
  check_honest(scene, made.answer);
  CHECK(made.scalar("pointing_error").values[0] == Approx(3.411).epsilon(1e-3));
  CHECK(made.scalar("tilt_max").values[0] > 2.4);
  CHECK(made.scalar("tilt_max").error > 0);
  CHECK(made.scalar("tilt_max").error <= made.answer.find("attitude")->error);
  CHECK(made.scalar("nutation_frequency_squared").values[0] == Approx(0.19673 * 0.19673).epsilon(1e-4));

  const Solved linear = solved(posed(paper_scene(), 50, 1e-3, rung::linear));
  CHECK(linear.by("linear"));
  CHECK_FALSE(linear.answer.met);
  CHECK(linear.warns("beyond-validity"));
  CHECK(linear.answer.find("attitude")->error == Approx(pi<double>));

  const Solved swept = solved(posed(paper_scene(), 50, 1e-3, rung::picard));
  CHECK(swept.refusal.code == Errc::no_convergence);
  const Solved corrected = solved(posed(paper_scene(), 50, 1e-3, rung::second_order));
  CHECK(corrected.refusal.code == Errc::not_applicable);
  CHECK(corrected.answer.tried.size() == 1);
}

TEST_CASE("a spinning ladder climbs as the tolerance tightens", "[spinning]") {
  auto p = paper_scene();
  p.angular_velocity[2] = 6;
  p.torque = {0.3, 0, 0};
  const struct {
    double tolerance;
    const char* model;
  } steps[] = {{1e-1, "linear"}, {1e-3, "second-order"}, {1e-8, "full"}};
  for (const auto& step : steps) {
    CAPTURE(step.tolerance);
    const auto scene = posed(p, 40, step.tolerance);
    const Solved made = solved(scene);
    CHECK(made.by(step.model));
    CHECK(made.answer.met);
    CHECK(made.answer.tried.back().accepted);
    check_honest(scene, made.answer);
  }
  for (const int model : {rung::linear, rung::second_order, rung::picard, rung::full}) {
    const auto scene = posed(p, 40, 1e-8, model);
    const Solved made = solved(scene);
    REQUIRE(made.refusal.code == Errc::ok);
    CHECK(made.answer.tried.size() == 1);
    CHECK(made.answer.met == (model == rung::picard || model == rung::full));
    check_honest(scene, made.answer);
  }
}

TEST_CASE("a body that only spins and thrusts is linear at any tolerance", "[spinning]") {
  auto p = paper_scene();
  p.torque.setZero();
  p.angles.theta = 0.3;
  p.force = {1, 2, 3};
  const auto scene = posed(p, 1000, 1e-11);
  const Solved made = solved(scene);
  CHECK(made.by("linear"));
  CHECK(made.answer.met);
  check_honest(scene, made.answer);
  CHECK(made.scalar("pointing_error").values[0] == 0);
  CHECK(made.scalar("tilt_max").values[0] < 1e-15);
  CHECK(made.scalar("secular_velocity_ratio").kind->width == 2);
  CHECK(made.scalar("secular_velocity_ratio").values[1] == 0);
  p.force.setZero();
  CHECK(std::isnan(solved(posed(p, 10)).scalar("secular_velocity_ratio").values[0]));
}

TEST_CASE("a good attitude is met where the angles pass cos(psi) = 0", "[spinning]") {
  auto p = paper_scene();
  p.torque.setZero();
  p.rotor_momentum = p.charge_momentum = 0;
  p.angular_velocity = {1, 0, 0};
  const auto scene = posed(p, 3, 1e-9);
  const Solved made = solved(scene);
  CHECK(made.by("full"));
  CHECK(made.answer.met);
  CHECK(made.warns("gimbal-lock"));
  CHECK(made.answer.find("euler_312")->error <= 1e-9);
  check_honest(scene, made.answer);
}

TEST_CASE("the first row of a spinning motion is the start as given, to the bit", "[spinning]") {
  auto p = paper_scene();
  p.angular_velocity = {0.1, -0.2, 6};
  p.torque = {0.003, 0, 0};
  p.velocity = {1.1, 2.2, 3.3};
  p.position = {0.1, 0.7, -0.3};
  for (const Angles<double> angles : {Angles<double>{0.013, -0.027, 31.7}, Angles<double>{2.3, 0.3, -4.1}}) {
    p.angles = angles;
    for (const int model : {rung::linear, rung::second_order, rung::picard, rung::full}) {
      CAPTURE(model, angles.psi);
      Question question;
      question.times = {0, 0.01, 0.02};
      question.tolerance = 1e-3;
      question.rung = model;
      const Solved made = solved(*Scene::make(p, question));
      if (angles.psi > 1 && model != rung::full) continue;
      REQUIRE(made.refusal.code == Errc::ok);
      const auto first = [&](const char* name, int i) { return made.answer.find(name)->values[std::size_t(i)]; };
      for (int i = 0; i < 3; ++i) {
        CHECK(first("angular_velocity", i) == p.angular_velocity[i]);
        CHECK(first("velocity", i) == p.velocity[i]);
        CHECK(first("position", i) == p.position[i]);
      }
      CHECK(first("euler_312", 0) == angles.psi);
      CHECK(first("euler_312", 1) == angles.phi);
      CHECK(first("euler_312", 2) == angles.theta);
      // and the next row goes on from there
      CHECK(std::abs(first("euler_312", 3) - angles.psi) < 0.1);
      CHECK(std::abs(first("euler_312", 4) - angles.phi) < 0.1);
      CHECK(std::abs(first("euler_312", 5) - angles.theta) < 0.2);
    }
  }
}

TEST_CASE("the greatest tilt has the error of the tilt, not of the spin angle", "[spinning]") {
  const auto tilt = [](const Answer& answer) {
    const Quantity* found = answer.quantity("tilt_max");
    REQUIRE(found != nullptr);
    return *found;
  };
  Spinners random(12);
  int compared = 0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    const auto p = random.spinner(random.log_any(1e-4, 0.03));
    if (p.nutation_squared() < 0) continue;
    const double span = 3000 / std::abs(p.spin());
    const Answer truth = solved(posed(p, span, 1e-11, rung::full)).answer;
    for (const int rung : {rung::linear, rung::second_order}) {
      const Solved made = solved(posed(p, span, 1e-3, rung));
      if (made.refusal.code != Errc::ok || made.warns("beyond-validity")) continue;
      ++compared;
      CHECK(std::abs(tilt(made.answer).values[0] - tilt(truth).values[0]) <=
            tilt(made.answer).error + tilt(truth).error);
      CHECK(tilt(made.answer).error <= made.answer.find("attitude")->error);
      if (rung == rung::linear) CHECK(tilt(made.answer).error < 0.3 * made.answer.find("attitude")->error);
    }
  }
  CHECK(compared > 10);
}

TEST_CASE("a position that comes back to zero is judged by its scale", "[spinning]") {
  // the force turns with the body: after a whole turn velocity and way start anew
  Problem<double> p;
  p.force = {4, 0, 0};
  p.angular_velocity = {0, 0, 3};
  Question question;
  question.times = {2 * pi<double> / 3};
  question.tolerance = 1e-11;
  question.rung = rung::full;
  const auto scene = *Scene::make(p, question);
  const Solved made = solved(scene);
  REQUIRE(made.refusal.code == Errc::ok);
  CHECK(made.answer.met);
  CHECK(std::abs(made.answer.find("velocity")->values[0]) < 1e-12);
  check_honest(scene, made.answer);
}

TEST_CASE("a spinning scene can be cancelled and watched", "[spinning]") {
  auto p = paper_scene();
  Monitor monitor;
  const Solved watched = solved(posed(p, 50), &monitor);
  CHECK(monitor.fraction == 1);
  CHECK(watched.answer.counts.steps > 0);
  monitor.cancel = true;
  const Solved made = solved(posed(p, 1e5), &monitor);
  CHECK(made.refusal.code == Errc::cancelled);
  CHECK(made.answer.columns.empty());
}
