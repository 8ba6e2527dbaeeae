// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/linear_rung.hpp"

#include "catch.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

Problem<double> tilted_stage(double tilt) {
  auto p = Spinners(5).spinner(tilt);
  p.force[2] = 3;
  return p;
}

}  // namespace

TEST_CASE("rung linear is the linear motion with honest errors", "[spinning]") {
  Spinners random(11);
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    auto p = random.spinner(random.log_any(1e-5, 0.1));
    if (p.nutation_squared() < 0) continue;
    if (i % 3 == 0) p.force[0] = p.force[1] = 0;
    const auto scene = posed(p, 40 / std::abs(p.spin()), 1e-6, rung::linear);
    const Track track = linear_track(scene, nullptr);
    REQUIRE(track.failure == Errc::ok);
    for (std::size_t k = 0; k < track.states.size(); ++k)
      CHECK((track.states[k].position - Linear<double>(p).at(scene.question().times[k]).position).norm() == 0);
    if (track.in_domain) check_honest(scene, track);
  }
}

TEST_CASE("rung linear gives up early, unless asked for by name", "[spinning]") {
  const auto p = tilted_stage(1e-3);
  const double span = 100 / std::abs(p.spin());
  const Track early = linear_track(posed(p, span, 1e-9), nullptr);
  CHECK(early.failure == Errc::not_applicable);
  CHECK(early.refusal == nullptr);
  CHECK(early.known_error > 1e-9);
  CHECK(early.states.empty());
  const Track named = linear_track(posed(p, span, 1e-9, rung::linear), nullptr);
  CHECK(named.failure == Errc::ok);
  CHECK(named.in_domain);
  CHECK(named.error.greatest() > 1e-9);
  CHECK(named.warnings.empty());
}

TEST_CASE("rung linear beyond small tilt is passed over; by name it answers with a warning", "[spinning]") {
  const auto p = tilted_stage(1);
  const double span = 100 / std::abs(p.spin());
  const Track passed = linear_track(posed(p, span, 0.5), nullptr);
  CHECK(passed.failure == Errc::not_applicable);
  REQUIRE(passed.refusal != nullptr);
  const Track named = linear_track(posed(p, span, 0.5, rung::linear), nullptr);
  REQUIRE(named.failure == Errc::ok);
  CHECK_FALSE(named.in_domain);
  REQUIRE(named.warnings.size() == 1);
  CHECK(named.warnings[0].code() == "beyond-validity");
  CHECK(named.warnings[0].value > small_tilt);
}

TEST_CASE("rung linear refuses where the motion grows beyond the greatest double", "[spinning]") {
  Problem<double> p;
  p.inertia = {8, 12, 10};
  p.angular_velocity = {1e-3, 0, 1};
  REQUIRE(p.nutation_squared() < 0);
  for (const double span : {2e3, 2e4, 2e6}) {
    for (const int count : {10, 700}) {
      CAPTURE(span, count);
      const Track track =
          linear_track(posed(p, span / std::sqrt(-p.nutation_squared()), 1e-3, rung::linear, count), nullptr);
      CHECK(track.failure == Errc::not_finite);
      REQUIRE(track.refusal != nullptr);
      CHECK(track.states.empty());
    }
  }
}

TEST_CASE("rung linear on long even grids is the linear motion at each time", "[spinning]") {
  for (int kind = 0; kind < 4; ++kind) {
    CAPTURE(kind);
    auto p = tilted_stage(1e-3);
    if (kind == 1) p.rotor_momentum -= p.effective_momentum();                       // no stiffness
    if (kind == 2) p.inertia = {2, 2, 2}, p.rotor_momentum = p.charge_momentum = 0;  // no nutation
    double span = 60 / std::abs(p.spin());
    if (kind == 3) span *= 400;  // steps too long for a table
    Question question;
    for (int i = 0; i < 700; ++i) question.times.push_back(span / 7 + span * i / 699);
    question.rung = rung::linear;
    const auto scene = Scene::make(p, question);
    REQUIRE(scene);
    const Track track = linear_track(*scene, nullptr);
    REQUIRE(track.failure == Errc::ok);
    const Linear<double> linear(p);
    Comparison comparison(Row<double>{});
    for (std::size_t i = 0; i < track.states.size(); ++i) comparison.add(linear.at(question.times[i]), track.states[i]);
    // what is stated as rounding
    LinearErrors<double> nothing{};
    nothing.size = linear_errors(p, question.times.back()).size;
    const auto e = tilt_errors(p, nothing, track.states, question.times.back());
    const auto found = comparison.relative(comparison.difference());
    for (std::size_t i = 0; i < std::size(column_kinds); ++i) {
      CAPTURE(column_kinds[i].name);
      CHECK(found[i] <= e[i]);
    }
  }
  CHECK(even(std::vector<double>{1, 2, 3, 4}));
  CHECK_FALSE(even(std::vector<double>{1, 2, 3.001, 4}));
}

TEST_CASE("rung linear under an axial torque", "[spinning]") {
  auto p = tilted_stage(1e-3);
  const double span = 60 / std::abs(p.spin());
  p.torque[2] = -1.5 * p.inertia[2] * p.spin() / span;  // through zero spin
  p.rotor_momentum = 2 * p.inertia[2] * p.spin();
  p.charge_momentum = 0;
  const auto scene = posed(p, span, 1e-2, any_rung, 100);
  const Track track = linear_track(scene, nullptr);
  REQUIRE(track.failure == Errc::ok);
  CHECK(track.counts.steps > 0);
  check_honest(scene, track);
  check_honest(posed(p, span, 1e-2, rung::linear), linear_track(posed(p, span, 1e-2, rung::linear), nullptr));
  // a sixteenth of the way shows that it is not good enough
  const Track early = linear_track(posed(p, span, 1e-10, any_rung, 100), nullptr);
  CHECK(early.failure == Errc::not_applicable);
  CHECK(early.known_error > 1e-10);
  CHECK(early.states.empty());

  Monitor monitor;
  monitor.cancel = true;
  CHECK(linear_track(posed(p, 1000 * span, 1e-2, rung::linear), &monitor).failure == Errc::cancelled);
  // what no budget of steps reaches is refused before the first one
  p.torque[2] = 1e16 * p.inertia[2];
  for (const int asked : {any_rung, int(rung::linear)})
    CHECK(linear_track(posed(p, 1, 1e-2, asked), &monitor).failure == Errc::step_limit);
}

TEST_CASE("momenta of body and rotor that cancel under an axial torque count with what they round", "[spinning]") {
  Problem<double> p;
  p.inertia = {2613.7322301636445, 1419.327843774858, 4033.0598935536277};
  p.mass = 114.03874353797272;
  p.rotor_momentum = -18826.90214284515;
  p.torque = {0.0013877228921286094, 0.0011079945521293092, -169226.2482901884};
  p.angular_velocity = {0, 0, 4.672601008849952};
  for (const double span : {2.555815799916065e-05, 0.00011896062578669156}) {
    const auto scene = posed(p, span, 1e-9, rung::linear, 3);
    check_honest(scene, linear_track(scene, nullptr));
  }
}

TEST_CASE("rung linear under an axial torque is not followed where its tilt has lost all sense", "[spinning]") {
  Problem<double> p;
  p.inertia = {0.1135, 0.6155, 0.5155};  // spins about the middle axis
  p.angular_velocity = {0.0025, 0.018, 0.052};
  p.torque = {4e-8, -2e-7, -7e-7};
  for (const int asked : {any_rung, int(rung::linear)}) {
    const Track track = linear_track(posed(p, 7000, 1e-2, asked), nullptr);
    CHECK(track.failure == Errc::not_applicable);
    REQUIRE(track.refusal != nullptr);
    CHECK(track.states.empty());
    CHECK(track.counts.steps < 1000);
  }
}

TEST_CASE("what unstable spin makes of small errors is in the stated ones", "[spinning]") {
  // the torque holds the body on its middle axis, where no mode of the linear motion grows; what it leaves out does, by e^20
  Problem<double> p;
  p.inertia = {0.00397775, 0.0070476, 0.0067541};
  p.mass = 0.04418;
  p.force = {0, 0, 0.00012};
  p.torque = {-2.00697e-05, 3.824e-06, 0};
  p.angular_velocity = {-0.000168730608458878, 0.008376893203032495, 8.163};
  p.angles = {0.001026202768961472, 2.067017131678035e-05, -3.256949379824225};
  for (const double axial : {0.0, 1e-9, -3e-6}) {
    for (const double span : {2.0, 4.0, 6.0, 14.58}) {
      CAPTURE(axial, span);
      p.torque[2] = axial;
      const auto scene = posed(p, span, 0.1, rung::linear);
      const Track track = linear_track(scene, nullptr);
      REQUIRE(track.failure == Errc::ok);
      CHECK(track.in_domain == (span < 7));
      if (track.in_domain) check_honest(scene, track);
    }
  }
}

TEST_CASE("rung linear at the start alone", "[spinning]") {
  for (const double axial : {0.0, 0.1}) {
    auto p = tilted_stage(1e-3);
    p.torque[2] = axial;
    Question question;
    question.times = {0};
    question.rung = rung::linear;
    const auto scene = Scene::make(p, question);
    const Track track = linear_track(*scene, nullptr);
    REQUIRE(track.failure == Errc::ok);
    CHECK(track.in_domain);
    check_honest(*scene, track);
  }
}
