// SPDX-License-Identifier: BSD-3-Clause
// Scenes of heavy bodies, and answers held against the motion in long double.
#pragma once

#include <cmath>
#include <utility>

#include "../column_error.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "truth.hpp"

namespace gyrostat::heavy {

/// Principal axes; `count` times up to the span.
inline Scene posed(const Problem<double>& problem, const Start& start, double span, Question question = {},
                   int count = 10) {
  question.times.clear();
  for (int i = 1; i <= count; ++i) question.times.push_back(span * i / count);
  Body body;
  body.problem = problem;
  const auto scene = Scene::make(body, start, question);
  REQUIRE(scene);
  return *scene;
}

inline Scene posed(const Problem<double>& problem, const State<double>& start, double span, Question question = {},
                   int count = 10) {
  return posed(problem, Start{start}, span, std::move(question), count);
}

/// The periodic motion with this spin, with attitude.
inline Scene periodic(const Problem<double>& problem, double spin, double cosine, double turns, double tolerance = 1e-6,
                      int rung = any_rung) {
  Question question;
  question.wants_attitude = true;
  question.tolerance = tolerance;
  question.rung = rung;
  return posed(problem, Start{{}, Periodic{spin, cosine}}, turns * 2 * pi<double> / std::abs(spin), question);
}

/// Every column, and what is stated of the period, within its stated error, and columns within the tolerance where the answer says so.
inline void check_honest(const Scene& scene, const Answer& answer) {
  Answer truth;
  REQUIRE(true_motion(scene, truth));
  for (const Column& column : answer.columns) {
    const Column& right = *truth.find(column.name());
    const double error = column_error(column, right) - right.error;
    CAPTURE(answer.model, column.kind->name, error, column.error);
    CHECK(error <= column.error);
    if (answer.met) CHECK(error <= answer.tolerance);
  }
  for (const Quantity& q : answer.quantities)
    for (const Quantity& right : truth.quantities) {
      if (q.kind != right.kind || right.error == infinity<double>) continue;
      CAPTURE(answer.model, q.kind->name, q.values[0], right.values[0], q.error);
      const double unit = q.kind->measure == Measure::relative ? std::abs(right.values[0]) : 1.0;
      if (std::isnan(q.error)) CHECK(q.values[0] == right.values[0]);
      else CHECK(std::abs(q.values[0] - right.values[0]) <= (q.error + right.error) * unit);
    }
}

inline void check_honest(const Scene& scene, const Track& track) {
  Answer answer;
  fill(answer, scene, track);
  tell(answer, track.periodicity);
  check_honest(scene, answer);
}

}  // namespace gyrostat::heavy
