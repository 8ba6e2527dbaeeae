// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/solve.hpp"

#include <cstring>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

/// The published body and data.
Problem<double> published() {
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
  bool warns(const char* code) const {
    for (const Warning& w : answer.warnings)
      if (std::strcmp(w.code, code) == 0) return true;
    return false;
  }
  const Quantity& scalar(const char* name) const {
    for (const Quantity& q : answer.quantities)
      if (std::strcmp(q.name, name) == 0) return q;
    FAIL("no such scalar: " << name);
    return answer.quantities[0];
  }
};

Solved solved(const Problem<double>& problem, const Question& question, Monitor* monitor = nullptr) {
  const auto scene = Scene::make(problem, question);
  REQUIRE(scene);
  Solved made;
  made.answer = spinning::solve(*scene, made.refusal, monitor);
  return made;
}

Question asked(double span, double tolerance = 1e-6, Model model = Model::any, int count = 10) {
  Question question;
  for (int i = 1; i <= count; ++i) question.times.push_back(span * i / count);
  question.tolerance = tolerance;
  question.model = model;
  return question;
}

}  // namespace

TEST_CASE("the published data climb to the full equations", "[spinning]") {
  const Solved made = solved(published(), asked(50, 1e-6, Model::any, 100));
  CHECK(made.refusal.code == Errc::ok);
  CHECK(made.by("full"));
  CHECK(made.answer.met);
  CHECK(made.answer.tried.size() == 4);
  CHECK(made.scalar("pointing_error").values[0] == Approx(3.411).epsilon(1e-3));
  CHECK(made.scalar("tilt_max").values[0] > 2.4);
  CHECK(made.scalar("nutation_frequency_squared").values[0] == Approx(0.19673 * 0.19673).epsilon(1e-4));

  const Solved linear = solved(published(), asked(50, 1e-3, Model::linear));
  CHECK(linear.by("linear"));
  CHECK_FALSE(linear.answer.met);
  CHECK(linear.warns("beyond-validity"));
}
