// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/second_order_rung.hpp"

#include "catch.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("rung second-order answers where the linear one does not, with honest errors", "[spinning]") {
  Spinners random(13);
  int answered = 0;
  for (int i = 0; i < 30; ++i) {
    CAPTURE(i);
    auto p = random.spinner(random.log_any(1e-4, 1e-2));
    if (p.nutation_squared() < 0) continue;
    if (i % 2 == 0) p.force[0] = p.force[1] = 0;
    const auto scene = posed(p, 40 / std::abs(p.spin()), 1e-4);
    const Track track = second_order_track(scene, nullptr);
    if (track.failure != Errc::ok) continue;
    CHECK(track.in_domain);
    check_honest(scene, track);
    answered += linear_track(scene, nullptr).failure != Errc::ok;
  }
  CHECK(answered > 5);
}

TEST_CASE("rung second-order is passed over where it does not apply or would harm", "[spinning]") {
  auto p = Spinners(5).spinner(1);
  const double span = 200 / std::abs(p.spin());
  for (const int model : {any_rung, int(rung::second_order)}) {
    const Track harms = second_order_track(posed(p, span, 0.5, model), nullptr);
    CHECK(harms.failure == Errc::not_applicable);
    CHECK(harms.refusal != nullptr);
  }
  p.torque *= 1e-4;
  const Track missed = second_order_track(posed(p, span, 1e-15), nullptr);
  CHECK(missed.failure == Errc::not_applicable);
  CHECK(missed.refusal == nullptr);
  CHECK(missed.known_error > 1e-15);
  p.torque[2] = 1e-3;
  const Track axial = second_order_track(posed(p, span, 1e-3, rung::second_order), nullptr);
  CHECK(axial.failure == Errc::not_applicable);
  CHECK(axial.refusal != nullptr);
}

TEST_CASE("where second order is good enough the full equations are not asked", "[spinning]") {
  Problem<double> p;
  p.inertia = {245, 240, 485};
  p.mass = 15;
  p.torque = {5.5e-6, 0, 0};
  p.force = {0, 0, 1.1e-3};
  p.angular_velocity = {2e-5, 0, 0.15707963267948966};
  const double span = 7200;
  const int turns = 180;
  Refusal refusal;
  const auto who = [&](int times) {
    return std::string_view(solve(posed(p, span, 1e-6, any_rung, times), refusal).model);
  };
  CHECK(who(2 * turns) == "second-order");
  CHECK(who(20 * turns) == "second-order");
}

TEST_CASE("rung second-order at the start alone", "[spinning]") {
  auto p = Spinners(5).spinner(1e-3);
  Question question;
  question.times = {0};
  question.tolerance = 1e-12;
  question.rung = rung::second_order;
  const auto scene = Scene::make(p, question);
  const Track track = second_order_track(*scene, nullptr);
  REQUIRE(track.failure == Errc::ok);
  check_honest(*scene, track);
}

TEST_CASE("rung second-order along an even grid is what it is time by time", "[spinning]") {
  Spinners random(29);
  int gone = 0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    auto p = random.spinner(random.log_any(1e-4, 1e-2));
    if (p.nutation_squared() < 0) continue;
    const double span = random.log_any(10, 1000) / std::abs(p.spin());
    Question question;
    question.rung = rung::second_order;
    for (int k = 0; k < 700; ++k) question.times.push_back(span * (k + 100) / 799);
    const Track track = second_order_track(*Scene::make(p, question), nullptr);
    if (track.failure != Errc::ok) continue;
    REQUIRE(goes_along_grid(question.times));
    ++gone;
    const SecondOrder<double> motion(p, span);
    const double phase = 1 + std::abs(p.spin() * span);
    for (std::size_t k = 0; k < track.states.size(); k += 33) {
      CAPTURE(k);
      const auto& found = track.states[k];
      const auto right = motion.at(question.times[k]);
      CHECK((found.velocity - right.velocity).norm() <= 1e-14 * phase * right.velocity.norm());
      CHECK((found.position - right.position).norm() <= 1e-14 * phase * right.position.norm());
      CHECK((found.momentum_I - right.momentum_I).norm() <= 1e-14 * phase * right.momentum_I.norm());
      CHECK(std::abs(found.angles.theta - right.angles.theta) <= 1e-14 * phase);
    }
    check_honest(*Scene::make(p, question), track);
  }
  CHECK(gone > 8);
}
