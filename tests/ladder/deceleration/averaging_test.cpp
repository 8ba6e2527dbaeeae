// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/averaging.hpp"

#include "scenes.hpp"

using namespace scenes;

namespace {

/// The exact motion of a body that spins about its first axis, in the place of a mean one.
struct Spin {
  Scene scene;
  double halt_at = infinity<double>;  ///< cannot be followed beyond, s
  double now = 0, at_floor = infinity<double>;

  double momentum(double t) const { return scene.problem().momentum[0] - scene.problem().control(0, 0) * t; }

  deceleration::detail::Halt advance(double t, double floor) {
    at_floor = (scene.problem().momentum[0] - floor) / scene.problem().control(0, 0);
    now = std::min(t, at_floor);
    return now > halt_at ? deceleration::detail::not_followed(Errc::separatrix) : deceleration::detail::Halt{};
  }
  bool floored() const { return now == at_floor; }
  double time() const { return now; }
  Result<State<double>> osculating() const {
    return deceleration::detail::state_on_orbit(scene.problem(), V(momentum(now), 0, 0));
  }
  SlowError<double> first_order() const { return {0, 0, 0, 0}; }
  SlowError<double> second_order() const { return {0, 0, 0, 0}; }
  double lag(double) const { return 1e-7; }
  ode::Counts counts() const { return {7, 70, 0}; }
  void warn(Track& track) const { track.warn(warning::sticks_to_separatrix); }
};

Scene spun(const std::vector<double>& times, int rung = any_rung) {
  Case c(1e-3, 1);
  c.data.drag = 0;
  c.data.momentum = V(.6, 0, 0);
  c.data.times = times;
  c.data.rung = rung;
  c.data.tolerance = 1e-5;
  return c.scene();
}

}  // namespace

TEST_CASE("second order: the mean motion, the full equations behind it, and the stop", "[deceleration]") {
  const Scene scene = spun({0, 300, 900, 2000});
  Spin mean{scene};
  Track begun;
  begun.warn(warning::near_symmetric, 1e-4);
  const Track track = second_order_track(begun, scene, mean, .1, 1e-9, nullptr);
  REQUIRE(track.failure == Errc::ok);
  REQUIRE(track.states.size() == 4);
  CHECK(track.knows_momentum);
  CHECK(track.states[0].momentum == V(.6, 0, 0));
  CHECK(track.states[1].norm == Approx(.42).epsilon(1e-14));
  CHECK(track.states[2].norm == Approx(.06).epsilon(1e-9));
  CHECK(track.states[3].norm == 0);
  CHECK(track.stop_time == Approx(1000).epsilon(1e-9));
  CHECK(track.stop_error < 1e-5);
  CHECK(track.counts.steps >= 7);
  REQUIRE(track.warnings.size() == 2);
  CHECK(track.warnings[0].code() == "near-symmetric");
}

TEST_CASE("second order: a mean motion that halts within the times is refused, behind them it has no stop",
          "[deceleration]") {
  const Scene within = spun({100, 400}), before = spun({100, 300});
  Spin mean{within, 350};
  const Track refusal = second_order_track(Track(), within, mean, .1, 1e-9, nullptr);
  CHECK(refusal.failure == Errc::separatrix);
  CHECK(refusal.refusal != nullptr);
  Spin other{before, 350};
  const Track track = second_order_track(Track(), before, other, .1, 1e-9, nullptr);
  CHECK(track.failure == Errc::ok);
  CHECK(track.states.size() == 2);
  CHECK(std::isnan(track.stop_time));
  CHECK(track.warnings.front().code() == "crosses-separatrix");
}

TEST_CASE("what no averaged rung answers has a reason", "[deceleration]") {
  Case c(1e-3, 300);
  CHECK(deceleration::detail::not_averaged(c.scene()) == nullptr);
  Case sphere = c, rest = c;
  sphere.moments = V(1, 1, 1);
  rest.data.momentum.setZero();
  for (const Case* bad : {&sphere, &rest}) CHECK(deceleration::detail::not_averaged(bad->scene()) != nullptr);
}

TEST_CASE("averaging warns of a fast torque, of near symmetry and of a separatrix", "[deceleration]") {
  const auto warned = [](double mu, double gap, double kp2) {
    Track track;
    deceleration::detail::warn_of_start(track, mu, gap, 1e-3, kp2);
    return track.warnings.size();
  };
  CHECK(warned(1e-3, .1, .5) == 0);
  CHECK(warned(.2, .1, 3) == 1);
  CHECK(warned(1e-3, 1e-4, .5) == 1);
  CHECK(warned(1e-3, .1, 1e-3) == 1);
  CHECK(warned(.2, 1e-4, .5) == 3);
}

TEST_CASE("breakdown momentum", "[deceleration]") {
  const Scene scene = Case(1e-4, 1).scene();
  // one radian of turning about the middle axis while the torque takes all momentum: M = sqrt(eps b B)
  CHECK(breakdown_momentum(scene.problem(), scene.greatest_control()) == Approx(1e-2).epsilon(1e-12));
}
