// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/goal.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

constexpr ColumnKind goal_columns[] = {{"rate", 1, "rad/s", Frame::none, Measure::relative, ""},
                                       {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, ""},
                                       {"word", 1, "", Frame::none, Measure::none, "", "", Kind::word}};
constexpr ScalarKind goal_scalars[] = {{"stop", 1, "s", Frame::none, Measure::relative, ""},
                                       {"trace", 1, "1", Frame::none, Measure::absolute, ""}};
constexpr std::size_t counted[] = {0};
constexpr Family goal_family{"invented", goal_columns, goal_scalars, {}, {}, {}, column_set(1U), counted};
using Three = Goal<3>;

Question asking(std::vector<AskedQuantity> asked, double tolerance = 1e-6) {
  Question question;
  question.tolerance = tolerance;
  question.asked = std::move(asked);
  return question;
}

}  // namespace

TEST_CASE("without a word the default of the family is asked, of a named rung all", "[ladder]") {
  Question question = asking({}, 1e-4);
  const Three slow = Three::of(question, goal_family, Errors<3>::all(2));
  CHECK(slow.columns[0] == 1e-4);
  CHECK(slow.columns[1] == infinity<double>);
  CHECK(slow.columns[2] == infinity<double>);
  CHECK(slow.tightest == 1e-4);
  CHECK(aim_of(question, goal_family, true, 0));
  CHECK_FALSE(aim_of(question, goal_family, true, 0)->needed);
  CHECK_FALSE(aim_of(question, goal_family, true, 1));
  question.rung = 2;
  CHECK(Three::of(question, goal_family, Errors<3>::all(2)).columns[1] == 1e-4);
}

TEST_CASE("the tightest tolerance of what is asked counts", "[ladder]") {
  const auto goal = Three::of(asking({{1, false, 1e-2}, {0, true, 1e-3}}, 1e-9), goal_family, Errors<3>::all(1));
  CHECK(goal.columns[0] == infinity<double>);
  CHECK(goal.columns[1] == 1e-2);
  CHECK(goal.tightest == 1e-3);
  CHECK(goal.excess(Errors<3>{{1e9, 2e-2, 1}}) == 2);
  CHECK(std::isnan(goal.excess(Errors<3>{{1e9, gyrostat::nan<double>, 1}})));
}

TEST_CASE("a tolerance in the unit is one over the scale, an angle is one already", "[ladder]") {
  const auto goal =
      Three::of(asking({{0, false, 1e-2, true}, {1, false, 1e-3, true}}), goal_family, Errors<3>::all(50));
  CHECK(goal.columns[0] == Approx(2e-4));
  CHECK(goal.columns[1] == 1e-3);
  CHECK(goal.tightest == Approx(2e-4));
}

TEST_CASE("an answer is held against what is asked, a column by its size", "[ladder]") {
  Answer answer;
  answer.columns = {{&goal_columns[0], {3, -80}, 1e-4, 50}, {&goal_columns[1], {0, 0, 0, 1, 0, 0, 0, 1}, 2e-2}};
  answer.quantities = {{&goal_scalars[0], {200}, 1e-3}};
  judge(answer, asking({{0, false, 1e-2, true}, {0, true, 1, true}}), goal_family);
  CHECK(answer.columns[0].tolerance == Approx(1e-2 / 80));
  CHECK(std::isnan(answer.columns[1].tolerance));
  CHECK(answer.quantities[0].tolerance == Approx(1.0 / 200));
  CHECK(answer.excess == Approx(0.8));
  CHECK(answer.error == 1e-3);

  judge(answer, asking({{1, true}}), goal_family);  // it has no such value
  CHECK(answer.excess == infinity<double>);
  judge(answer, asking({{0}, {1, true, gyrostat::nan<double>, false, false}}, 1e-3), goal_family);
  CHECK(answer.excess == Approx(0.1));
}
