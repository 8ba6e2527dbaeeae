// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/fill.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

struct Writer {
  using Scalar = double;
  struct State {
    double a, b, c, d;
  };
  static constexpr ColumnKind columns[] = {{"vector", 3, "m", Frame::body, Measure::relative, ""},
                                           {"number", 1, "J", Frame::none, Measure::relative, ""}};
  void operator()(const State& s, double* row) const noexcept {
    for (const double x : {s.a, s.b, s.c, s.d}) *row++ = x;
  }
};
constexpr Family writer_family{"invented", Writer::columns, {}, {}, {}, {}};

}  // namespace

TEST_CASE("states become columns row by row: those that are asked for", "[ladder]") {
  const std::vector<Writer::State> states{{1, 2, 3, 4}, {5, 6, 7, 8}};
  Question question;
  Answer answer;
  fill_columns(answer, Writer{}, states, {{1e-3, 1e-2}}, question, writer_family);
  REQUIRE(answer.columns.size() == 2);
  CHECK(answer.find("vector")->values == std::vector<double>{1, 2, 3, 5, 6, 7});
  CHECK(answer.find("number")->values == std::vector<double>{4, 8});
  CHECK(answer.find("number")->error == 1e-2);

  question.asked = {{0}};
  Answer first;
  fill_columns(first, Writer{}, states, {{1e-3, 1e-2}}, question, writer_family);
  REQUIRE(first.columns.size() == 1);
  CHECK(first.columns[0].error == 1e-3);
}

TEST_CASE("what a rung does not know has no value, and of a named rung no column", "[ladder]") {
  const std::vector<Writer::State> states{{1, 2, 3, 4}, {5, 6, 7, 8}};
  Question question;
  Answer answer;
  fill_columns(answer, Writer{}, states, {{1e-3, 1e-2}}, question, writer_family, column_set(0U));
  REQUIRE(answer.columns.size() == 2);
  CHECK(answer.columns[0].error == infinity<double>);
  CHECK(answer.columns[0].values.size() == 6);
  for (const double x : answer.columns[0].values) CHECK(std::isnan(x));
  CHECK(answer.columns[1].values == std::vector<double>{4, 8});

  question.rung = 1;
  Answer named;
  fill_columns(named, Writer{}, states, {{1e-3, 1e-2}}, question, writer_family, column_set(0U));
  REQUIRE(named.columns.size() == 1);
  CHECK(named.columns[0].kind == &Writer::columns[1]);
}

TEST_CASE("the head of an answer is what was asked and what was found on the way", "[ladder]") {
  static constexpr WarningKind kind{"late", "it is late"};
  Outcome outcome;
  outcome.warn(kind, 2);
  outcome.counts.steps = 7;
  Question question;
  question.times = {0, 1};
  Answer answer;
  fill_head(answer, question, outcome);
  CHECK(answer.times == question.times);
  CHECK(answer.warns("late"));
  CHECK(answer.counts.steps == 7);
}

TEST_CASE("the row at zero is the start as given", "[ladder]") {
  const std::vector<Writer::State> states{{1, 2, 3, 4}, {5, 6, 7, 8}};
  for (const double first : {0.0, 0.5}) {
    Answer answer;
    answer.times = {first, 1};
    fill_columns(answer, Writer{}, states, {{0, 0}}, Question{}, writer_family);
    put_start(answer, Writer::columns[0], {1.5, 2.5, 3.5});
    const bool at_start = first == 0;
    CHECK(answer.find("vector")->values ==
          (at_start ? std::vector<double>{1.5, 2.5, 3.5, 5, 6, 7} : std::vector<double>{1, 2, 3, 5, 6, 7}));
    CHECK(answer.find("number")->values[0] == 4);
  }
}

TEST_CASE("a column takes the room of the one before in its place, and nothing else of it", "[ladder]") {
  Answer answer;
  Column& first = renewed_column(answer, 0, Writer::columns[0], 6);
  first.error = 1e-3, first.tolerance = 1e-2, first.scale = 2;
  const double* room = first.values.data();
  const Column& again = renewed_column(answer, 0, Writer::columns[1], 4);
  CHECK(again.values.data() == room);
  CHECK(again.values.size() == 4);
  CHECK(again.kind == &Writer::columns[1]);
  CHECK((std::isnan(again.error) && std::isnan(again.tolerance) && again.scale == 0));
  (void)renewed_column(answer, 1, Writer::columns[0], 3);
  CHECK(answer.columns.size() == 2);
}
