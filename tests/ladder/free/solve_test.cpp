// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/solve.hpp"

#include "../../models/free/gyrostats.hpp"
#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("whichever rung answers about a free body is honest", "[free]") {
  free_bodies::Bodies bodies(41);
  int by_form = 0;
  for (const auto regime : free_bodies::regimes)
    for (int i = 0; i < 12; ++i)
      for (const double tolerance : {1e-2, 1e-6, 1e-10}) {
        Assembly<double> assembly;
        assembly.body = bodies.of(regime, i);
        const double end = std::pow(10, bodies.uniform(-1, 3));
        const Scene scene = posed(assembly, {0.3 * end, 0.99 * end, end}, tolerance);
        const Answer answer = solved(scene);
        CAPTURE(free_bodies::name(regime), i, tolerance, end);
        if (answer.find("attitude")->error < 0.05) check_honest(scene, answer);
        by_form += std::string_view(answer.model) == "closed-form";
      }
  CHECK(by_form > 100);
}

TEST_CASE("the scalars of a free motion: Toutatis as Hudson and Ostro (1995) saw it", "[free]") {
  constexpr double day = 86400, degree = pi<double> / 180;
  auto assembly = body({3.22, 3.09, 1}, {0, 0, 0}, Vec3<double>(20.7, 31.3, 98.0) * degree / day);
  assembly.body.attitude = {};
  Question question;
  question.times = {30 * day};
  question.rung = free::rung::closed_form;
  const auto scene = Scene::make(assembly, question);
  const Answer answer = solved(scene->viewed(free::ViewRequest{{0, 0, 1}, {1, 0, 0}, pi<double> / 6}));
  const auto value = [&](const char* name) { return answer.quantity(name)->values[0]; };
  CHECK(free::kind_words[std::size_t(value("kind"))] == std::string_view("about-smallest"));
  CHECK(2 * pi<double> / value("spin_rate") / day == Approx(5.367).epsilon(1e-3));
  CHECK(2 * pi<double> / value("precession_rate") / day == Approx(7.420).epsilon(1e-3));
  CHECK(value("flip_interval") == Approx(value("period") / 2));
  CHECK((value("view_fraction") > 0 && value("view_fraction") < 1));
  CHECK(answer.quantity("period")->error < 1e-13);
}

TEST_CASE("rest, a sphere and a steady rotation have their answers", "[free]") {
  const Answer rest = solved(posed(body({3, 2, 1.5}, {0, 0, 0}, {0, 0, 0}), {0, 5}));
  CHECK(rest.met);
  for (const double x : rest.find("angular_velocity")->values) CHECK(x == 0);
  const Scene round = posed(body({2, 2, 2}, {0.1, 0.2, 0.3}, {1, 0, 0}), {1, 50}, 1e-9);
  check_honest(round, solved(round));
  const Scene steady = posed(body({3, 2, 1.5}, {0.1, 0, 0}, {1, 0, 0}), {1, 50}, 1e-9);
  const Answer turning = solved(steady);
  CHECK(turning.met);
  check_honest(steady, turning);
}
