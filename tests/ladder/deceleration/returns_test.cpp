// SPDX-License-Identifier: BSD-3-Clause
// Every rung comes back, whatever is absent: torques, rotors, rotation. Work is counted in steps.
#include "gyrostat/ladder/deceleration/full_motion.hpp"

#include "at_length.hpp"
#include "scenes.hpp"

using namespace scenes;

namespace {

/// Of all runs: the answer's and those of its two companions.
constexpr std::uint64_t many_steps = 3 * 15'000;

/// An answer without NaN among its errors, or a reason, after not too many steps.
void check_returns(const Case& c) {
  Refusal refusal;
  const Answer answer = c.solve(refusal);
  if (refusal.code != Errc::ok) {
    REQUIRE(refusal.why != nullptr);
    CHECK(std::strlen(refusal.why) > 10);
    return;
  }
  CHECK(answer.counts.steps < many_steps);
  CHECK(answer.error >= 0);
  for (const Column& column : answer.columns) {
    INFO(answer.model << " " << column.kind->name);
    if (column.kind->measure != Measure::none) CHECK(column.error >= 0);
    CHECK(std::none_of(column.values.begin(), column.values.end(), [](double v) { return std::isnan(v); }));
  }
}

/// Asked for by every rung's name, and by none.
void check_all_rungs(Case c) {
  for (int rung = any_rung; rung <= rung::full; ++rung) {
    CAPTURE(rung);
    c.data.rung = rung;
    check_returns(c);
  }
}

Problem<double> held_at_its_limit() {
  Problem<double> problem;
  problem.inverse_inertia = {1 / 35., 1 / 22., 1 / 16.};
  problem.rotor_momentum = {0, 2, 0};
  problem.control.diagonal() = V(.5, .8, 1);
  problem.drag = .4;  // drag |l| = .8
  problem.drag_law = Law::carrier;
  problem.momentum = {35, 46, 48};
  return problem;
}

}  // namespace

TEST_CASE("every rung returns, whatever acts and however the body starts", "[deceleration][length]") {
  int place = 0;  // by day one in eleven, which divides no number of choices below: any two of them meet
  for (const V& control : {V(0, 0, 0), V(0, .05, 0), V(.03, 0, .05), V(.03, .04, .05)})
    for (const double drag : {0., .02})
      for (const Law law : {Law::total, Law::carrier})
        for (const Law drag_law : {Law::total, Law::carrier})
          for (const V& l : {V(0, 0, 0), V(0, .3, 0), V(.2, .15, .3)})
            for (const V& omega : {V(0, 0, 0), V(0, 0, .8), V(.6, .4, .5)})
              for (const auto& times : {std::vector<double>{100}, until(20, 4)}) {
                if (place++ % at_length(11, 1) != 0) continue;
                CAPTURE(control.transpose(), drag, int(law), int(drag_law), l.transpose(), omega.transpose());
                CAPTURE(times.size());
                if (l.isZero(0) && (law == Law::carrier || drag_law == Law::carrier)) continue;  // one and the same
                Case c;
                c.data.control = control;
                c.data.drag = drag;
                c.data.law = law;
                c.data.drag_law = drag_law;
                c.data.rotor_momentum = l;
                c.data.momentum = c.moments.cwiseProduct(omega) + l;
                c.data.times = times;
                check_all_rungs(c);
              }
}

TEST_CASE("a free motion of many turns comes back", "[deceleration]") {
  Case c;
  c.data.momentum = V(.8, .5, .33);
  for (const double last : {3e3, 1e12, 1e300}) {
    CAPTURE(last);
    c.data.times = {last / 2, last};
    c.data.tolerance = 1e-9;
    check_all_rungs(c);
    c.data.rotor_momentum = V(.2, .15, .3);
    check_all_rungs(c);
    c.data.rotor_momentum.setZero();
  }
}

TEST_CASE("units as large and torques as small as doubles go come back", "[deceleration]") {
  for (const double unit : {1e-60, 1e60}) {
    CAPTURE(unit);
    Case c(1e-3, 300);
    c.moments *= unit;
    c.data.momentum *= unit;
    c.data.control *= unit;
    check_all_rungs(c);
  }
  Case c(1e-3, 300);
  for (const double torque : {1e-100, 1e-300}) {
    CAPTURE(torque);
    c.data.control = torque * V(1, 2, 1.5);
    check_all_rungs(c);
    c.data.drag = 0;
    check_all_rungs(c);
  }
}

TEST_CASE("a control that only just holds gives up when its steps would not reach the last time", "[deceleration]") {
  const auto problem = held_at_its_limit();
  std::vector<State<double>> states(2);
  FullMotionOptions<double> options;
  options.step_cap = 100'000;
  const auto answer = full_motion<double>(problem, std::vector<double>{100, 200}, states, options);
  REQUIRE(answer);
  CHECK(answer->status == ode::Status::step_limit);
  CHECK(answer->counts.steps < 50'000);
}

TEST_CASE("beside an axis without control the rest of the momentum ends as zero", "[deceleration]") {
  Case c;
  c.moments = V(35, 22, 16);
  c.data.control = V(0, .5, .8);
  c.data.drag = .02;
  c.data.momentum = V(3.5, 4.4, 4.8);
  c.data.times = {250, 500};
  const Answer answer = c.with(rung::full, 1e-6).solve();
  const auto& M = answer.find("angular_momentum")->values;
  CHECK(M[0] > 0);
  for (const std::size_t i : {1u, 2u, 4u, 5u}) CHECK(M[i] == 0);
  CHECK(M[3] == Approx(M[0] * std::exp(-.02 * 250)).epsilon(1e-9));
  CHECK(answer.met);
  CHECK(answer.counts.steps < many_steps);
}

TEST_CASE("a phase that no double can hold is refused at once", "[deceleration]") {
  Case c(1e-12, 1e8);
  c.data.rotor_momentum = V(.2, .15, .3);
  Refusal refusal;
  c.with(rung::full, 1e-9).solve(refusal);
  CHECK(refusal.code == Errc::step_limit);
  CHECK(std::strcmp(refusal.why, phase_lost) == 0);
  c.data.times = {1e-3};
  CHECK(c.with(rung::full, 1e-9).solve().met);
}

TEST_CASE("a body at rest that nothing acts on stays at rest", "[deceleration]") {
  Case c(1e-3, 100);
  c.data.control.setZero();
  c.data.momentum.setZero();
  for (const auto& times : {std::vector<double>{100}, {0, 100}, {0, 50, 100}})
    for (const Law law : {Law::total, Law::carrier})
      for (const double drag : {0., .1}) {
        c.data.times = times, c.data.law = law, c.data.drag = drag;
        const Answer answer = c.solve();
        CHECK(answer.met);
        CHECK(answer.error == 0);
        for (const Column& column : answer.columns)
          if (column.kind->measure != Measure::none)
            CHECK(*std::max_element(column.values.begin(), column.values.end()) == 0);
      }
}

TEST_CASE("a carrier at rest beside its wheel is answered within the tolerance", "[deceleration]") {
  Case c(1e-3, 100);
  c.data.rotor_momentum = c.data.momentum = V(.1, .2, .3);
  c.data.law = c.data.drag_law = Law::carrier;
  c.data.asked = all_but_attitude();
  for (const auto& times : {std::vector<double>{100}, {0, 100}}) {
    c.data.times = times;
    const Answer answer = c.with(any_rung, 1e-9).solve();
    CHECK(answer.met);
    const auto& omega = answer.find("angular_velocity")->values;
    CHECK(*std::max_element(omega.begin(), omega.end()) == 0);
  }
}

TEST_CASE("the attitude behind the stop is known as far as the rate at which it goes on", "[deceleration]") {
  Case c;
  c.moments = V(35, 22, 16);
  c.data.rotor_momentum = V(1, 2, 3);
  c.data.control = V(.5, .8, 1);
  c.data.drag = .02;
  c.data.momentum = V(4.5, 6.4, 7.8);
  c.data.wants_attitude = true;
  c.data.times = {1e4, 1e9};
  const Answer answer = c.with(any_rung, 1e-9).solve();
  CHECK_FALSE(answer.met);
  CHECK(answer.find("attitude")->error > epsilon<double> * 1e9 * V(1 / 35., 2 / 22., 3 / 16.).norm());
  c.data.times = {1e4};
  CHECK(c.with(any_rung, 1e-9).solve().met);
}

namespace {
struct Named {
  Mat3<double> inertia;
  Asked asked;
};

Answer solved(Named given, int rung, double tolerance) {
  given.asked.rung = rung;
  given.asked.tolerance = tolerance;
  Refusal refusal;
  const Answer answer =
      deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(given.inertia), given.asked), refusal);
  REQUIRE(refusal.code == Errc::ok);
  return answer;
}
}  // namespace

TEST_CASE("averaging by name beyond its validity tells no error, and says so", "[deceleration]") {
  Named given;  // a libration slower than the braking
  given.inertia << 6.1904577, -9.8214e-5, 2.2098e-5, -9.8214e-5, 6.1906075, -8.6499e-5, 2.2098e-5, -8.6499e-5,
      6.1905886;
  given.asked.control = V(.0006, .0014, .0036);
  given.asked.drag = 7.5e-5;
  given.asked.momentum = V(.4586, -.9277, .6564);
  given.asked.times = until(566);
  const Answer named = solved(given, rung::averaged, 1e-3);
  CHECK_FALSE(named.met);
  CHECK(warns(named, "beyond-validity"));
  CHECK(named.error == infinity<double>);
  for (const Column& column : named.columns)
    if (column.kind->measure != Measure::none) CHECK(column.error == infinity<double>);
  check_honest(solved(given, any_rung, 1e-3), solved(given, rung::full, 1e-11));
}

TEST_CASE("a doubt behind the asked times is one about the stop alone", "[deceleration]") {
  Named given;  // a wheel that spins a carrier along its axis
  given.inertia = V(11723, 196880, 186923).asDiagonal();
  given.asked.rotor_momentum = V(304.27, .0019, -.0014);
  given.asked.control = V(.254, .254, .52);
  given.asked.momentum = V(11723 * .11206 + 304.27, .0019, -.0014);
  given.asked.times = until(2462);
  const Answer truth = solved(given, rung::full, 1e-11);
  const Answer named = solved(given, rung::averaged, 1e-3);
  for (const Column& column : named.columns)
    if (column.kind->measure != Measure::none) CHECK(std::isfinite(column.error));
  check_honest(named, truth);
  check_honest(solved(given, any_rung, 1e-3), truth);
}

TEST_CASE("averaging knows when the oscillation leads over to the lobes about another axis", "[deceleration]") {
  Named
      given;  // two moments equal to 2e-10, M nearly in their plane, actuators off the principal axes: k2 is small on either side
  given.inertia << 0.0015841600836522709, -0.00032453502803147643, -0.00015110388258387898, -0.00032453502803147643,
      0.0011091037978311197, -0.00029784528781729276, -0.00015110388258387898, -0.00029784528781729276,
      0.0016101271873605238;
  given.asked.control = V(2.6707944491666184e-07, 2.7641601265557081e-07, 6.1174560305885422e-07);
  given.asked.drag = 0.00051692137644650325;
  given.asked.momentum = V(-0.0001452580163630012, -4.4072963160682518e-05, 0.00027318319553820231);
  given.asked.times = until(100.8);
  Named standing;  // on the axis of the greatest moment, but for a rounding, with a torque that moves it aside
  standing.inertia << 0.0053099302047481152, -0.0006630613584729455, -0.0019880833138757438, -0.0006630613584729455,
      0.0056055910635222179, -0.0015934625868791669, -0.0019880833138757438, -0.0015934625868791669,
      0.0013589319277248076;
  standing.asked.control = V(2.0163735460120833e-09, 1.2303085928059266e-10, 3.5871532644267918e-10);
  standing.asked.drag = 1.7550957711743037e-05;
  standing.asked.momentum = V(0.00011982615217851519, -4.9707441577077276e-05, -3.3279689869766067e-05);
  standing.asked.times = until(10);
  for (const Named& scene : {given, standing}) {
    const Answer truth = solved(scene, rung::full, 1e-11);
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      const Answer named = solved(scene, rung::averaged, tolerance);
      CHECK(named.find("modulus_squared")->error > distance(named, truth, "modulus_squared"));
      check_honest(solved(scene, any_rung, tolerance), truth);
    }
  }
}

TEST_CASE("a body without rotors and with actuators off its axes goes over its separatrix, and to rest",
          "[deceleration]") {
  Named given;
  given.inertia << 42000, 150, 0, 150, 41000, 0, 0, 0, 5600;
  given.asked.control = V(.003, .0025, .001);
  given.asked.drag = 2e-8;
  given.asked.momentum = given.inertia * V(.0436, .007, .0175);
  for (const double end : {3e5, 3.5e5, 6e5, 7e5}) {  // before, behind, and after the stop
    given.asked.times = until(end);
    const Answer named = solved(given, rung::averaged, 1e-3), truth = solved(given, rung::full, 1e-10);
    check_honest(named, truth);
    CHECK(named.find("angular_momentum_norm")->error < (end < 3e5 ? 1e-3 : .4));
    CHECK(std::abs(quantity(named, "stop_time") - quantity(truth, "stop_time")) < 100);
  }
}

TEST_CASE("equal controls about an axis act along any axes across it", "[deceleration]") {
  Named given;
  given.inertia << 42000, 150, 0, 150, 41000, 0, 0, 0, 5600;
  given.asked.momentum = given.inertia * V(.0436, .007, .0175);
  given.asked.times = {1e3};
  for (const double b : {.3, .003, .7, 1e-6}) {
    given.asked.control = V(b, b, b / 3);
    CHECK(make_scene(*Inertia<double>::from_tensor(given.inertia), given.asked)->principal_control());
  }
}

TEST_CASE("averages that stand where drag alone brakes are off by what is left", "[deceleration]") {
  Named given;
  given.inertia = V(2707.0157625796101, 2707.0157617644218, 4257.3879387944789).asDiagonal();
  given.asked.rotor_momentum = V(18.96, 20.01, -26.46);
  given.asked.drag = 0.0205;
  given.asked.law = given.asked.drag_law = Law::total;
  given.asked.momentum = V(-576.7, -158.4, 0.0046);
  given.asked.times = until(1967);
  const Answer named = solved(given, rung::averaged, 1e-9);
  const Column& norm = *named.find("angular_momentum_norm");
  double most = 0;
  for (std::size_t i = 0; i < named.times.size(); ++i)
    most = std::max(
        most, std::abs(norm.values[i] - given.asked.momentum.norm() * std::exp(-given.asked.drag * named.times[i])));
  CHECK(most > 1e-9);
  CHECK(most <= norm.error * size_of(norm));
  CHECK(norm.error < 1e-6);
}

TEST_CASE("a torque that tears the carrier off is no torque to average", "[deceleration]") {
  Case c;  // drag |l| is a hundred times the control
  c.moments = V(33.045, 591.148, 561.463);
  c.data.rotor_momentum = V(3110.82, -65.74, 1348.43);
  c.data.control.setConstant(214.64);
  c.data.drag = 6.6744;
  c.data.law = Law::carrier;
  c.data.momentum = c.data.rotor_momentum + V(0, 0, -561.463 * .25082);
  c.data.times = until(.34);
  Refusal refusal;
  c.with(rung::averaged_2, 1e-2).solve(refusal);
  CHECK(refusal.code == Errc::not_applicable);
  check_honest(c.with(any_rung, 1e-2).solve(), c.truth());
}

TEST_CASE("the first row is the start as it was given, to the bit", "[deceleration]") {
  for (const double l : {0., .1})
    for (const int rung : {rung::averaged, rung::averaged_2, rung::full}) {
      CAPTURE(l, rung);
      Mat3<double> J;
      J << 1.4, .1, .02, .1, 1, .05, .02, .05, .7;
      Asked data = Case(1e-4, 3000).data;
      data.rotor_momentum = l * V(1, 2, -1);
      data.angular_velocity = V(.51, .47, .33);  // as given, not as the momentum in principal axes makes it again
      data.momentum = J * *data.angular_velocity + data.rotor_momentum;
      data.attitude = {.5, .5, .5, -.5};
      data.wants_attitude = rung == rung::full;
      data.times.insert(data.times.begin(), 0);
      data.rung = rung;
      data.tolerance = 1e-3;
      Refusal refusal;
      const Answer answer = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
      REQUIRE(refusal.code == Errc::ok);
      const auto first = [&](const char* name) { return V(answer.find(name)->values.data()); };
      if (rung != rung::averaged) {
        CHECK(first("angular_momentum") == data.momentum);
        CHECK(first("angular_velocity") == *data.angular_velocity);
      }
      if (rung == rung::full) CHECK(answer.find("attitude")->values[3] == .5);
      CHECK(answer.find("angular_momentum_norm")->values[0] == Approx(data.momentum.norm()).epsilon(1e-15));
    }
}
