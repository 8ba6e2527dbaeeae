// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/custom_rung.hpp"

#include <cmath>
#include <cstring>
#include <string_view>

#include "answered.hpp"
#include "catch.hpp"

using namespace general_scenes;

namespace {

constexpr auto custom_damping = [](double, const Seen<double>& seen) noexcept -> Vec3<double> {
  return -0.2 * seen.angular_velocity;
};

Problem<double> custom_damped() {
  auto made = brick();
  made.torques.push_back(damping(0.2 * Mat3<double>::Identity(), Opposed::angular_velocity));
  return made;
}

bool custom_warns(const Answer& answer) {
  return std::any_of(answer.warnings.begin(), answer.warnings.end(),
                     [](const Warning& each) { return std::strcmp(each.kind->code, "custom-smooth") == 0; });
}

gyrostat::Refusal custom_refusal(const Scene& scene) {
  gyrostat::Refusal refusal;
  (void)solve(scene, refusal);
  return refusal;
}

}  // namespace

TEST_CASE("a scene with a torque of the caller's own", "[general]") {
  for (const double tolerance : {1e-4, 1e-7, 1e-11}) {
    Question question = question_at({0, 3, 17, 40}, tolerance);
    question.asked = all_columns();
    auto bare = brick();
    bare.wheels = {wheel(WheelType::free, {1, 0, 2}), wheel(WheelType::motor, {0, 1, 1})};
    bare.wheels[1].slope = 0.01, bare.wheels[1].no_load_rate = 40;
    auto same = bare;
    same.torques = custom_damped().torques;
    const Scene scene = posed(bare, question).driven_by(OwnTorque::of(custom_damping));
    const Answer answer = solved(scene), right = true_answer(posed(same, question));
    CHECK(std::strcmp(answer.model, "full") == 0);
    CHECK(answer.met);
    CHECK(custom_warns(answer));
    for (const Column& column : answer.columns) {
      const double error = column_error(column, *right.find(column.name()));
      CAPTURE(tolerance, column.name(), error, column.error);
      CHECK(error <= column.error);
    }
  }
}

TEST_CASE("no family answers for a torque that it does not know", "[general]") {
  const Scene plain = posed(brick(), question_at({1, 2}));
  CHECK(std::strcmp(solved(plain).model, "full") != 0);
  const Scene driven = plain.driven_by(OwnTorque::of(custom_damping, {1.5}));
  CHECK(std::strcmp(solved(driven).model, "full") == 0);
  CHECK(!custom_warns(solved(driven)));
  Question named = question_at({1, 2}, 1e-6, 0);
  CHECK(custom_refusal(posed(brick(), named).driven_by(OwnTorque::of(custom_damping))).code == Errc::not_applicable);
  named.rung = rung::segments;
  CHECK(custom_refusal(posed(brick(), named).driven_by(OwnTorque::of(custom_damping))).code == Errc::not_applicable);
  // nor does what is made of the scene forget it
  const auto moved = driven.with(custom_damped());
  REQUIRE(moved);
  CHECK(moved->own_torque().any());
  CHECK(!moved->is_recognised());
}

TEST_CASE("a pulse of half a hundredth of the span is seen wherever it is, though its ends are not named",
          "[general]") {
  check_pulses(nullptr);
}

TEST_CASE("what a torque of the caller's own is refused for", "[general]") {
  const Scene plain = posed(brick(), question_at({1, 9}));
  const auto ends = [](double t, const Seen<double>&) noexcept {
    return Vec3<double>(t > 4 ? gyrostat::nan<double> : 0.1, 0, 0);
  };
  double lost = gyrostat::nan<double>;
  auto own = OwnTorque::of(ends);
  own.lost_at = &lost;
  CHECK(std::string_view(custom_refusal(plain.driven_by(own)).why) == no_value_of_law);
  CHECK(lost == Approx(4).epsilon(1e-9));

  int asked = 0;
  const auto restless = [&asked](double, const Seen<double>&) noexcept { return Vec3<double>(0, 0.1 * ++asked, 0); };
  CHECK(std::string_view(custom_refusal(plain.driven_by(OwnTorque::of(restless))).why) == not_repeatable);

  Question series = question_at({1, 9});
  series.integrator = Integrator::taylor;
  CHECK(std::string_view(custom_refusal(posed(brick(), series).driven_by(OwnTorque::of(custom_damping))).why) ==
        no_series);

  auto stiff = brick();
  stiff.wheels = {wheel(WheelType::friction, {1, 0, 0})};
  stiff.wheels[0].friction = 1e7;
  const Scene fast = posed(stiff, question_at({100})).driven_by(OwnTorque::of(custom_damping));
  CHECK(std::string_view(custom_refusal(fast).why) == too_fast_for_dop853);

  auto braked = brick();
  braked.torques.push_back(torque(TorqueType::brake, {0.5, 0.5, 0.5}));
  braked.torques[0].opposed = Opposed::momentum;
  const Scene stops = posed(braked, question_at({100})).driven_by(OwnTorque::of(custom_damping));
  CHECK(std::string_view(custom_refusal(stops).why) == why_stopped_by_brake);
}

TEST_CASE("the full equations by DOP853, of scenes with no torque of one's own", "[general]") {
  Question question = question_at({0, 3, 17, 40}, 1e-8, rung::full);
  Scene scene = posed(custom_damped(), question);
  scene.full_equations = &full_by_dop853;
  const Answer answer = solved(scene);
  CHECK(answer.met);
  CHECK(!custom_warns(answer));
  check_honest(scene, answer);
}

TEST_CASE("a custom motion reports how far it is, and is cancelled", "[general]") {
  Monitor monitor;
  const Scene scene = posed(brick(), question_at({1, 500})).driven_by(OwnTorque::of(custom_damping));
  gyrostat::Refusal refusal;
  (void)solve(scene, refusal, &monitor);
  CHECK(refusal.code == Errc::ok);
  CHECK(monitor.fraction == 1);
  monitor.cancel = true;
  (void)solve(scene, refusal, &monitor);
  CHECK(refusal.code == Errc::cancelled);
}
