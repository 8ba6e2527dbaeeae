// SPDX-License-Identifier: BSD-3-Clause
// Where a free motion in closed form could fail, place by place: a right answer with an honest error, infinite where the data decide nothing, or a
// refusal.
#include <cmath>
#include <limits>

#include "../../models/free/gyrostats.hpp"
#include "posed.hpp"

using namespace free_scenes;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// By the closed form; its columns are held against the motion of the very data where they are stated at all.
Answer by_form(const Assembly<double>& assembly, std::vector<double> times, double tolerance = 1e-9) {
  const Scene scene = posed(assembly, std::move(times), tolerance, free::rung::closed_form);
  const Answer answer = solved(scene);
  if (answer.find("attitude")->error < infinity<double>) check_honest(scene, answer);
  return answer;
}

double scalar_of(const Answer& answer, const char* name) { return answer.quantity(name)->values[0]; }
double stated(const Answer& answer) { return answer.find("attitude")->error; }

/// On a separatrix of an oblique gyrostat, as near as halving brings it.
Assembly<double> bisected() {
  free_bodies::Bodies bodies(5);
  Assembly<double> made;
  do made.body = bodies.of(free_bodies::Regime::bisected, 0);
  while (free::Motion<double>::make<DoubleDouble>(made.body.cast<DoubleDouble>())->modulus().kp2 > 1e-13);
  return made;
}

}  // namespace

TEST_CASE("failure map of free motions: 1 - k2 near zero without rotors", "[free]") {
  for (const bool largest : {false, true}) {
    double last = 0;
    for (const double off : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      CAPTURE(off, largest);
      const auto answer =
          by_form(body({6, 4, 3}, {0, 0, 0}, {largest ? off : off / 9, 1, largest ? off / 9 : off}), {1, 10});
      CHECK(free::Kind(int(scalar_of(answer, "kind"))) ==
            (largest ? free::Kind::about_largest : free::Kind::about_smallest));
      CHECK(stated(answer) < 1e-12);
      // a digit nearer it takes 2 ln 10 over the growth rate longer to leave and to come back as near
      const double growth = std::sqrt((6. - 4) * (4. - 3) / (6 * 3)), interval = scalar_of(answer, "flip_interval");
      if (last > 0) CHECK(interval - last == Approx(2 * std::log(1e3) / growth).epsilon(1e-5));
      last = interval;
    }
  }
}

TEST_CASE("failure map of free motions: 1 - k2 near zero with oblique rotors, the data decide nothing", "[free]") {
  const auto made = bisected();
  const auto soon = by_form(made, {0.1});
  CHECK(stated(soon) < 1e-12);
  const auto late = by_form(made, {1e4});
  CHECK(stated(late) == infinity<double>);
  CHECK_FALSE(late.met);
  CHECK((late.warns("phase-unknown") && late.warns("near-separatrix")));
}

TEST_CASE("failure map of free motions: on the separatrix itself", "[free]") {
  const auto on = body({6, 4, 3}, {0, 0, 0}, {1, 1, 2});  // (6 - 4) 6 w1^2 = (4 - 3) 3 w3^2
  const auto soon = by_form(on, {1, 5});
  CHECK(free::Kind(int(scalar_of(soon, "kind"))) == free::Kind::separatrix);
  CHECK(scalar_of(soon, "period") == infinity<double>);
  CHECK(stated(soon) < 1e-10);
  CHECK(stated(by_form(on, {300})) == infinity<double>);
}

TEST_CASE("failure map of free motions: the smallest paths, where a lobe is born", "[free]") {
  for (const double off : {1e-2, 1e-5, 1e-8, 1e-11, 1e-14})
    for (const Vec3<double>& l : {Vec3<double>(0, 0, 0), Vec3<double>(.3, 0, 0), Vec3<double>(.3, .2, -.1)}) {
      CAPTURE(off, l);
      // beside a permanent rotation omega = sigma M
      const Vec3<double> J(6, 4, 3);
      const double sigma = 0.05;
      Vec3<double> w;
      for (int i = 0; i < 3; ++i) w[i] = sigma * l[i] / (1 - sigma * J[i]);
      if (l.norm() == 0) w = {1, 0, 0};
      w[1] += off * w.norm();
      const auto answer = by_form(body(J, l, w), {1, 100});
      CHECK(stated(answer) < 1e-10);
    }
}

TEST_CASE("failure map of free motions: no momentum, or hardly any", "[free]") {
  const Vec3<double> J(6, 4, 3), w(.25, -.5, .5), l = -J.cwiseProduct(w);  // without a rounding
  const auto none = by_form(body(J, l, w), {1, 100});
  CHECK(free::Kind(int(scalar_of(none, "kind"))) == free::Kind::steady);
  CHECK(stated(none) < 1e-12);
  for (const double rest : {1e-3, 1e-8, 1e-13}) {
    CAPTURE(rest);
    const auto answer = by_form(body(J, l + Vec3<double>(rest, -rest, 2 * rest), w), {1, 100});
    CHECK(stated(answer) < 1e-10);
  }
}

TEST_CASE("failure map of free motions: rotors with nearly all of the momentum", "[free]") {
  for (const double share : {1e3, 1e7, 1e12}) {
    CAPTURE(share);
    const auto answer =
        by_form(body({6, 4, 3}, Vec3<double>(1, -2, .5) * share, {.3, .2, -.4}), {1e-2 / share, 10 / share});
    CHECK(answer.find("angular_velocity")->error <
          1e-12);  // of the rates themselves, not of the momentum over the moments
  }
}

TEST_CASE("failure map of free motions: equal moments, and spheres", "[free]") {
  for (const double gap : {0., 1e-16, 1e-12, 1e-6})
    for (const Vec3<double>& l : {Vec3<double>(0, 0, 0), Vec3<double>(0, 0, .7), Vec3<double>(.2, -.5, .7)}) {
      CAPTURE(gap, l);
      CHECK(stated(by_form(body({4 * (1 + gap), 4, 3}, l, {.3, 1, -.4}), {1, 100})) < 1e-10);
      CHECK(stated(by_form(body({4, 3 * (1 + gap), 3}, l, {.3, 1, -.4}), {1, 100})) < 1e-10);
      CHECK(stated(by_form(body({4 * (1 + gap), 4 * (1 + gap / 2), 4}, l, {.3, 1, -.4}), {1, 100})) < 1e-9);
    }
}

TEST_CASE("failure map of free motions: a slim body whose great moments are equal but for rounding, by every rung",
          "[free]") {
  // what a rounding of the moments does grows as the square of the time: the axis of the slight one turns slowly
  Assembly<double> slim;
  slim.body.inertia << 0.9991690400409974, 0.025635058337949605, 0.013150678701356425,  //
      0.025635058337949605, 0.20916019012717374, -0.4056975453995108,                   //
      0.013150678701356425, -0.4056975453995108, 0.7918788403309448;
  slim.body.angular_velocity = {-0.2716141210439777, -0.44623241540564457, 0.8527029967761156};
  auto apart = body({1 + 4.4e-16, 1, 2e-4}, {0, 0, 0}, {.6, .8, .01});
  for (const auto& given : {slim, apart})
    for (const int rung : {any_rung, int(free::rung::closed_form), int(free::rung::full)})
      for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
        CAPTURE(rung, tolerance);
        const Scene scene = posed(given, {18.8, 188.33364262378117}, tolerance, rung);
        check_honest(scene, solved(scene));
      }
}

TEST_CASE("failure map of free motions: so late that the data fix no phase", "[free]") {
  const auto tumbling = body({6, 4, 3}, {.1, -.2, .3}, {1, 2, 3});
  const auto late = by_form(tumbling, {1e18}), soon = by_form(tumbling, {1});
  CHECK(stated(late) == infinity<double>);
  CHECK(late.warns("phase-unknown"));
  // what does not hang on the phase keeps its meaning
  for (const char* name : {"period", "turn_per_period", "energy", "angular_momentum_norm", "modulus_squared"}) {
    CAPTURE(name);
    CHECK(scalar_of(late, name) == Approx(scalar_of(soon, name)).epsilon(1e-12));
    CHECK(late.quantity(name)->error < 1e-11);
  }
  CHECK(late.find("angular_momentum")->error == infinity<double>);
}

TEST_CASE("failure map of free motions: a free rotor that the body cannot hold", "[free]") {
  auto made = body({3, 2.5, 2}, {0, 0, 0}, {.3, -.5, .8});
  made.wheels = {{{0, 0, 1}, 2.5, 5, true}};
  Question question;
  question.times = {1};
  free::UnsoundWheel<double> unsound;
  CHECK_FALSE(Scene::make(made, question, &unsound));
  CHECK(unsound.wheel == 0);
  CHECK(unsound.limit < 2);
  made.wheels[0].turns_freely = false;  // a motor may hold it
  CHECK(Scene::make(made, question));
}

TEST_CASE("failure map of free motions: what is no number comes to no number", "[free]") {
  const auto sound = *free::Motion<double>::make(body({6, 4, 3}, {.1, -.2, .3}, {1, 2, 3}).body);
  for (const double t : {no_number, infinity<double>, -infinity<double>}) {
    const auto at = sound.at(t);
    CHECK(std::isnan(at.angular_velocity[0] + at.attitude.w));
  }
  for (const double bad : {no_number, infinity<double>}) {
    CHECK_FALSE(free::Motion<double>::make(body({6, 4, 3}, {0, 0, 0}, {1, bad, 3}).body));
    CHECK_FALSE(free::Motion<double>::make(body({6, 4, 3}, {bad, 0, 0}, {1, 2, 3}).body));
    CHECK_FALSE(free::Motion<double>::make(body({bad, 4, 3}, {0, 0, 0}, {1, 2, 3}).body));
  }
  Question question;
  question.times = {no_number};
  CHECK_FALSE(Scene::make(body({6, 4, 3}, {0, 0, 0}, {1, 2, 3}), question));
}
