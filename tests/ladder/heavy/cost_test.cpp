// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/cost.hpp"

#include "catch.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("of a heavy body the full equations cost less than the exact top only for a short while, and not clearly",
          "[heavy]") {
  const auto top = *Problem<double>::make({0.0016, 0.0016, 0.002}, 0.8, {0, 0, 0.01}, 9.80665, 0);
  const auto posed = [&](double end) {
    Body body;
    body.problem = top;
    Question question;
    question.times = {end};
    return *Scene::make(body, {State<double>{{1, 2, 150}, Vec3<double>(0.6, 0, 0.8), {}}}, question);
  };
  const Scene instant = posed(1e-3), minute = posed(60);
  CHECK(cost_of_full(instant) < cost_of_exact(instant));
  CHECK(cost_of_full(minute) > 10 * cost_of_exact(minute));
  Refusal refusal;
  for (const Scene& scene : {instant, minute}) CHECK(std::string_view(solve(scene, refusal).model) == "exact");
}
