// SPDX-License-Identifier: BSD-3-Clause
// Scenes of heavy bodies, and answers held against the motion in long double.
#pragma once

#include <cmath>
#include <string_view>

#include "../column_error.hpp"
#include "catch.hpp"
#include "truth.hpp"

namespace gyrostat::heavy {

/// Principal axes; `count` times up to the span.
inline Scene posed(const Problem<double>& problem, const State<double>& start, double span, Question question = {},
                   int count = 10) {
  question.times.clear();
  for (int i = 1; i <= count; ++i) question.times.push_back(span * i / count);
  Body body;
  body.problem = problem;
  const auto scene = Scene::make(body, start, question);
  REQUIRE(scene);
  return *scene;
}

/// The periodic motion with this spin, with attitude.
inline Scene periodic(const Problem<double>& problem, double spin, double cosine, double turns, double tolerance = 1e-6,
                      Model model = Model::any) {
  Question question;
  question.periodic = Periodic{spin, cosine};
  question.wants_attitude = true;
  question.tolerance = tolerance;
  question.model = model;
  return posed(problem, {}, turns * 2 * pi<double> / std::abs(spin), question);
}

/// Every column, and what is told of the period, within its stated error, and columns within the tolerance where the answer says so.
inline void check_honest(const Scene& scene, const Answer& answer) {
  Answer truth;
  REQUIRE(true_motion(scene, truth));
  for (const Column& column : answer.columns) {
    const Column& right = *truth.find(column.name);
    const double error = column_error(column, right) - right.error;
    CAPTURE(answer.model, column.name, error, column.error);
    CHECK(error <= column.error);
    if (answer.met) CHECK(error <= answer.tolerance);
  }
  for (const Quantity& q : answer.quantities)
    for (const Quantity& right : truth.quantities) {
      if (q.name != std::string_view(right.name) || right.error == infinity<double>) continue;
      CAPTURE(answer.model, q.name, q.values[0], right.values[0], q.error);
      if (std::isnan(q.error)) CHECK(q.values[0] == right.values[0]);
      else CHECK(std::abs(q.values[0] - right.values[0]) <= (q.error + right.error) * std::abs(right.values[0]));
    }
}

inline void check_honest(const Scene& scene, const Track& track) {
  Answer answer;
  fill(answer, scene, track);
  check_honest(scene, answer);
}

}  // namespace gyrostat::heavy
