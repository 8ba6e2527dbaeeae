// SPDX-License-Identifier: BSD-3-Clause
// General scenes for the tests of the ladder, and answers held against the equations as they are written, in long double.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "../../models/general/truth.hpp"
#include "../column_error.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/ladder/general/track.hpp"

namespace general_scenes {

using namespace gyrostat;
using namespace gyrostat::general;

inline Question question_at(std::vector<double> times, double tolerance = 1e-6, int rung = any_rung) {
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  question.rung = rung;
  return question;
}

inline Scene posed(const Problem<double>& problem, const Question& question) {
  const auto scene = Scene::make(problem, question);
  REQUIRE(scene);
  return *scene;
}

inline Answer solved(const Scene& scene) {
  gyrostat::Refusal refusal;
  const Answer answer = general::solve(scene, refusal);
  INFO(refusal.model << ": " << (refusal.why ? refusal.why : ""));
  REQUIRE(refusal.code == Errc::ok);
  return answer;
}

/// Every column by name.
inline std::vector<AskedQuantity> all_columns() {
  std::vector<AskedQuantity> made;
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) made.push_back({i});
  return made;
}

inline Answer true_answer(const Scene& scene) {
  const auto& times = scene.question().times;
  const std::vector<long double> wide(times.begin(), times.end());
  Track track;
  for (const auto& state :
       general_truth::motion<long double>(general_truth::cast<long double>(scene.problem()), wide, 1e-16L))
    track.states.push_back(general_truth::cast<double>(state));
  REQUIRE(track.states.size() == times.size());
  track.off.fill(0);
  Answer made;
  fill(made, scene, track);
  return made;
}

/// Each column within its stated error, and within the tolerance where the answer says so.
inline void check_honest(const Scene& scene, const Answer& answer) {
  const Answer truth = true_answer(scene);
  for (const Column& column : answer.columns) {
    const double error = column_error(column, *truth.find(column.name()));
    CAPTURE(answer.model, column.name(), error, column.error);
    CHECK(!(error > column.error));
    if (answer.met) CHECK(error <= answer.tolerance);
  }
}

/// An asymmetric body that turns.
inline Problem<double> brick() {
  Problem<double> made;
  made.inertia = Vec3<double>(3, 4, 5).asDiagonal();
  made.angular_velocity = {0.3, -0.5, 0.8};
  made.attitude = normalised(Quat<double>{0.9, 0.1, -0.2, 0.3});
  return made;
}

inline Wheel<double> wheel(WheelType type, const Vec3<double>& axis, double rate = 20) {
  Wheel<double> made;
  made.type = type;
  made.axis = axis.normalized();
  made.axial_inertia = 0.05;
  made.rate = type == WheelType::locked ? 0 : rate;
  return made;
}

inline Torque<double> torque(TorqueType type, const Vec3<double>& vector) {
  Torque<double> made;
  made.type = type;
  made.vector = vector;
  return made;
}

inline Torque<double> damping(const Mat3<double>& matrix, Opposed opposed) {
  Torque<double> made;
  made.type = TorqueType::damping;
  made.matrix = matrix;
  made.opposed = opposed;
  return made;
}

/// A torque of the caller's own that acts for half a hundredth of the span, wherever: an answer states at least what it errs. full: the full
/// equations by another integrator than DOP853.
inline void check_pulses(Track (*full)(const Scene&, Monitor*)) {
  auto slow = brick();
  slow.angular_velocity *= 1e-3;
  for (const double begin : {0.013, 0.1, 0.317, 0.49, 0.633, 0.871, 0.96}) {
    CAPTURE(begin);
    const auto pulse = [begin](double t, const Seen<double>&) noexcept {
      return Vec3<double>(0, 0, t > begin && t < begin + 0.005 ? 1. : 0.);
    };
    const auto asked = [&](double tolerance, std::vector<double> breakpoints) {
      return posed(slow, question_at({1}, tolerance, rung::full))
          .driven_by(OwnTorque::of(pulse, std::move(breakpoints)));
    };
    Scene scene = asked(1e-3, {});
    scene.full_equations = full;
    const Answer answer = solved(scene), named = solved(asked(1e-9, {begin, begin + 0.005}));
    const Column &column = *answer.find("angular_velocity"), &truth = *named.find("angular_velocity");
    CHECK(column_error(column, truth) <= column.error + truth.error);
  }
}

}  // namespace general_scenes
