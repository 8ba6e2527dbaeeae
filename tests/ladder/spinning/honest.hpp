// SPDX-License-Identifier: BSD-3-Clause
// Scenes of spinning bodies, and answers held against the motion in long double.
#pragma once

#include "../../models/spinning/spinners.hpp"
#include "../column_error.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/spinning/track.hpp"
#include "truth.hpp"

namespace gyrostat::spinning {

/// `count` times up to the span.
inline Scene posed(const Problem<double>& problem, double span, double tolerance = 1e-6, int model = any_rung,
                   int count = 10) {
  Question question;
  for (int i = 1; i <= count; ++i) question.times.push_back(span * i / count);
  question.tolerance = tolerance;
  question.rung = model;
  const auto scene = Scene::make(problem, question);
  REQUIRE(scene);
  return *scene;
}

/// Every column within its stated error, and within the tolerance where the answer says so.
inline void check_honest(const Scene& scene, const Answer& answer) {
  Answer truth;
  REQUIRE(true_motion(scene, truth));
  for (const Column& column : answer.columns) {
    const Column& right = *truth.find(column.name());
    const double error = column_error(column, right) - right.error;
    CAPTURE(answer.model, column.name(), error, column.error);
    CHECK(error <= column.error);
    if (answer.met) CHECK(error <= answer.tolerance);
  }
}

inline void check_honest(const Scene& scene, const Track& track) {
  Answer answer;
  fill(answer, scene, track);
  check_honest(scene, answer);
}

}  // namespace gyrostat::spinning
