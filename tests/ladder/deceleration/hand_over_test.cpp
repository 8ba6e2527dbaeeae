// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/hand_over.hpp"

#include "scenes.hpp"

using namespace scenes;

TEST_CASE("hand-over: later for coarse answers, earlier for fine ones", "[deceleration]") {
  double before = 0;
  for (const double tolerance : {.5, 1e-3, 1e-6, 1e-9, 1e-12}) {
    Case c(1e-3, 100);
    c.data.tolerance = tolerance;
    const double share = hand_over_share(c.scene());
    CHECK(share >= before);
    CHECK(share >= 8);
    CHECK(share <= 100);
    before = share;
  }
}

TEST_CASE("hand-over: the stop time holds where averaging alone errs by ten per cent", "[deceleration]") {
  // deceleration.md, section 5: the weakest control along the middle axis
  for (const double eps : {1e-3, 1e-4}) {
    CAPTURE(eps);
    Case c(eps, .9 / eps);
    c.data.control = eps * V(.9, .2, 1);
    const Answer truth = c.truth();
    const double right = quantity(truth, "stop_time");
    const Answer first = c.with(rung::averaged, 1e-3).solve(), second = c.with(rung::averaged_2, 1e-3).solve();
    const double of_first = std::abs(quantity(first, "stop_time") / right - 1);
    const double of_second = std::abs(quantity(second, "stop_time") / right - 1);
    CHECK(of_first > 1e-2);
    CHECK(of_first <= first.error);
    CHECK(of_second < 1e-3);
    CHECK(of_second <= second.error);
  }
}

TEST_CASE("hand-over: samples go on from the averaged to the full equations without a seam", "[deceleration]") {
  Case c(1e-4, 14000);
  c.data.times = until(14000, 44);
  const Answer truth = c.truth();
  const Answer answer = c.with(rung::averaged_2, 1e-4).solve();
  check_honest(answer, truth);
  CHECK(distance(answer, truth, "angular_momentum_norm") < 1e-4);
  CHECK(answer.find("angular_momentum_norm")->values.size() == 44);
  CHECK(answer.find("angular_momentum_norm")->values.back() == 0);
  CHECK(answer.find("regime")->values.back() == double(Regime::rest));
}

TEST_CASE("hand-over: appends to what the track has", "[deceleration]") {
  Case c(1e-3, 1000);
  c.data.times = {10, 500, 1000};
  const Scene scene = c.scene();
  Track track;
  track.states = {{V(.9, 0, 0), .9, .4, .3, Regime::about_largest}};
  const V M(.2, .1, .05);
  REQUIRE(hand_over(track, scene, M, 400, SlowError<double>{1e-6, 1e-6, 1e-6, 1e-5}, nullptr) == Errc::ok);
  CHECK(track.states.size() == 3);
  CHECK(track.stop_time > 500);
  CHECK(track.stop_time < 1000);
  CHECK(track.states[2].norm == 0);
  CHECK(track.error[column::angular_momentum_norm] >= 1e-6);
  CHECK(track.error[column::angular_momentum] >= 1e-5);
  CHECK(track.stop_error > 0);
  CHECK(track.counts.rhs > 0);
  // the same with the full equations from the start of the hand-over
  Case rest = c;
  rest.data.momentum = M;
  rest.data.times = {100};
  const Answer truth = rest.truth();
  CHECK(track.states[1].norm == Approx(truth.find("angular_momentum_norm")->values[0]).epsilon(1e-6));
  CHECK(track.stop_time - 400 == Approx(quantity(truth, "stop_time")).epsilon(1e-6));
}
