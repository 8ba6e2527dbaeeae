// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/cvode_motion.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include "../../models/general/scenes.hpp"
#include "answered.hpp"
#include "catch.hpp"

using namespace general_scenes;

namespace {

constexpr auto cvode_kick = [](double t, const Seen<double>& seen) noexcept -> Vec3<double> {
  return Vec3<double>(t < 5 ? 0.1 : -0.2, 0, 0) - 0.1 * seen.angular_velocity;
};

}  // namespace

TEST_CASE("the full equations of general scenes by CVODE", "[general]") {
  general_scenes::Scenes source(97);
  int answered = 0;
  for (int i = 0; i < 12; ++i) {
    const auto made = source.next(2);
    Question question = question_at({0, made.span / 3, made.span}, i % 2 ? 1e-5 : 1e-8, rung::full);
    Scene scene = posed(made.problem, question);
    scene.full_equations = &full_by_cvode;
    gyrostat::Refusal refusal;
    const Answer answer = solve(scene, refusal);
    if (refusal.code != Errc::ok) continue;
    CAPTURE(i, made.kind);
    check_honest(scene, answer);
    ++answered;
  }
  CHECK(answered >= 10);
}

TEST_CASE("CVODE does not go through the stop of a brake, and says so at once", "[general]") {
  auto braked = brick();
  braked.torques.push_back(torque(TorqueType::brake, {0.5, 0.3, 0.4}));
  braked.torques[0].opposed = Opposed::momentum;
  // held against a push the torque of the brake jumps with the momentum: there CVODE would go to and fro in steps of nothing
  auto pushed = braked;
  pushed.torques.push_back(torque(TorqueType::constant, {-0.01, -0.002, 0.02}));
  pushed.torques[1].axes = Axes::inertial;
  int calls = 0;
  const auto counts = [&calls](double, const Seen<double>&) noexcept { return ++calls, Vec3<double>(0, 0, 0); };
  for (const auto* problem : {&braked, &pushed}) {
    for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
      CAPTURE(tolerance, calls);
      Scene scene = posed(*problem, question_at({1, 100}, tolerance, rung::full)).driven_by(OwnTorque::of(counts));
      scene.full_equations = &full_by_cvode;
      gyrostat::Refusal refusal;
      (void)solve(scene, refusal);
      CHECK(std::string_view(refusal.why) == why_stopped_by_brake);
    }
  }
  CHECK(calls < 60'000);
}

TEST_CASE("CVODE and DOP853 agree about a torque that steps", "[general]") {
  const Scene scene = posed(brick(), question_at({0, 4, 5, 20}, 1e-8)).driven_by(OwnTorque::of(cvode_kick, {5}));
  Scene other = scene;
  other.full_equations = &full_by_cvode;
  const Answer one = solved(scene), two = solved(other);
  CHECK(one.met);
  CHECK(two.met);
  for (const Column& column : one.columns) {
    const Column& its = *two.find(column.name());
    CHECK(column_error(column, its) <= column.error + its.error);
  }
}

TEST_CASE("CVODE goes over switches that lie a rounding apart", "[general]") {
  const double at = 2.5926710983288683, next = std::nextafter(at, 3.0);
  auto problem = brick();
  problem.torques.assign(2, torque(TorqueType::constant, {0.01, 0.02, -0.03}));
  problem.torques[0].factor.on = {{0, at}}, problem.torques[1].factor.on = {{next, 4}};
  for (const auto& times : {std::vector<double>{1, at, next, 5}, std::vector<double>{1, next}}) {
    const Scene scene = posed(problem, question_at(times, 1e-9, rung::full));
    Scene other = scene;
    other.full_equations = &full_by_cvode;
    const Answer one = solved(scene), two = solved(other);
    for (const Column& column : one.columns) {
      const Column& its = *two.find(column.name());
      CHECK(column_error(column, its) <= column.error + its.error);
    }
  }
}

TEST_CASE("CVODE sees a pulse of half a hundredth of the span, though its ends are not named", "[general]") {
  check_pulses(&full_by_cvode);
}

TEST_CASE("a law without a value ends a run of CVODE, too", "[general]") {
  double lost = gyrostat::nan<double>;
  const auto ends = [](double t, const Seen<double>&) noexcept {
    return Vec3<double>(t > 4 ? gyrostat::nan<double> : 0.1, 0, 0);
  };
  auto own = OwnTorque::of(ends);
  own.lost_at = &lost;
  Scene scene = posed(brick(), question_at({1, 9})).driven_by(own);
  scene.full_equations = &full_by_cvode;
  gyrostat::Refusal refusal;
  (void)solve(scene, refusal);
  CHECK(std::string_view(refusal.why) == no_value_of_law);
  CHECK(lost >= 4);
  CHECK(lost < 4.1);
}

TEST_CASE("a pulse of some roundings of its time is not lost by CVODE", "[general]") {
  const double at = 12.3, length = 20 * (std::nextafter(at, 13.0) - at);
  Problem<double> problem;
  problem.inertia = Mat3<double>::Identity();
  auto& pulse = problem.torques.emplace_back();
  pulse.vector = {0, 0, 1e-3};
  pulse.factor.on = {{at, at + length}};
  Scene scene = posed(problem, question_at({100}, 1e-8, rung::full));
  scene.full_equations = &full_by_cvode;
  const Column& rate = *solved(scene).find("angular_velocity");
  CHECK(std::abs(rate.values[2] / (1e-3 * length) - 1) <= rate.error);
  CHECK(rate.values[2] == Approx(1e-3 * length));
}
