// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/cost.hpp"

#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("of a free body the closed form costs the same over many turns as over few", "[free]") {
  const auto assembly = body({3, 2.5, 1}, {0.2, -0.1, 0.4}, {0.5, 1, -0.3});
  const Scene many = posed(assembly, {1e5});
  Question question = posed(assembly, {1}).question();
  question.asked = {{free::column::attitude}};
  const Scene few = many.asked(question);
  CHECK(free::cost_of_closed_form(few) == free::cost_of_closed_form(many.asked(question)));
  CHECK(free::cost_of_full(many) > 20 * free::cost_of_closed_form(many));
  CHECK(std::string_view(solved(many).model) == "closed-form");
  // scalars come from the closed form, whichever rung answers
  question.asked.clear();
  CHECK(std::string_view(solved(many.asked(question)).model) == "closed-form");
  // the angles of wheels cost more than all else
  const Scene wheels = posed(wheeled(), {1});
  question.asked = {{free::column::attitude}};
  CHECK(free::cost_of_closed_form(wheels) > 2 * free::cost_of_closed_form(wheels.asked(question)));
}

TEST_CASE("where a free body has no quick form the closed form is not said to be cheap", "[free]") {
  Question question = posed(body({3, 2, 1}, {0, 0, 0}, {1, 0.1, 0.1}), {100}).question();
  question.asked = {{free::column::attitude}};
  const auto asked = [&](const Assembly<double>& given) { return posed(given, {100}).asked(question); };
  const Scene tame = asked(body({3, 2, 1}, {0.1, 0, 0}, {1, 0.1, 0.1})),
              flips = asked(body({3, 2, 1}, {0, 0, 0}, {0.01, 1, 0.01})),
              round = asked(body({2, 2, 2}, {0, 0, 0}, {0.1, 0.2, 1}));
  CHECK(free::cost_of_closed_form(tame) < 20e-6);
  CHECK(free::cost_of_closed_form(flips) > 10 * free::cost_of_closed_form(tame));
  CHECK(free::cost_of_closed_form(round) > 40e-6 + free::cost_of_closed_form(tame));
  // over few turns the full equations cost less then
  CHECK(std::string_view(solved(tame).model) == "closed-form");
  CHECK(std::string_view(solved(flips).model) == "full");
  question.times = {1e5};
  CHECK(std::string_view(solved(flips.asked(question)).model) == "closed-form");
}
