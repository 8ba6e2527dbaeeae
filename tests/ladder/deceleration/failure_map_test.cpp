// SPDX-License-Identifier: BSD-3-Clause
// The failure map of the model (deceleration.md, section 7), row by row: at each of these places the ladder gives a right
// number with an honest error, or passes a rung over and says why.
#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "scenes.hpp"

using namespace scenes;

namespace {

constexpr double tolerances[] = {1e-2, 1e-3, 1e-6};

/// M of unit length at a modulus: `small` is k2 or kp2, in the regime around axis 1 of 1/(1.4, 1, 0.7).
V on_polhode(const V& moments, math::Modulus<double> modulus, double u) {
  const V a = moments.cwiseInverse();
  const auto p = polhode_through<double>(a, V(1, .1, .1));
  return momentum_on<>(at_modulus(p, modulus), 1., u);
}

/// Honest at every tolerance, met by some rung; returns the tightest answer.
Answer check_everywhere(Case c, bool met = true) {
  const Answer truth = c.truth();
  Answer last;
  for (const double tolerance : tolerances) {
    c.data.tolerance = tolerance;
    c.data.rung = any_rung;
    CAPTURE(tolerance);
    last = c.solve();
    check_honest(last, truth);
    INFO(stated(last));
    if (met) CHECK(last.met);
  }
  return last;
}

/// Asked for by name: an honest answer, or a refusal with a reason, or one that confesses not to meet the tolerance.
void check_by_name(const Case& c, int model, double tolerance, const Answer& truth) {
  Refusal refusal;
  const Answer answer = c.with(model, tolerance).solve(refusal);
  CAPTURE(model, tolerance);
  if (refusal.code == Errc::ok) {
    if (answer.met) check_honest(answer, truth);
  } else {
    CHECK(refusal.why != nullptr);
    CHECK(std::strlen(refusal.why) > 10);
    CHECK(answer.tried.size() == 1);
    CHECK_FALSE(answer.tried[0].accepted);
  }
}

}  // namespace

TEST_CASE("failure map: k2 -> 0", "[deceleration]") {
  for (const double k2 : {1e-6, 1e-12, 0.}) {
    CAPTURE(k2);
    Case c(1e-3, 500);
    c.data.momentum = on_polhode(c.moments, {k2, 1 - k2}, .7);
    const Answer answer = check_everywhere(c);
    CHECK(answer.find("modulus_squared")->values[0] <= 1.1 * k2);
    const Answer averaged = c.with(rung::averaged, 1e-3).solve();
    check_honest(averaged, c.truth());
    CHECK(averaged.met);
  }
}

TEST_CASE("failure map: k2 -> 1", "[deceleration]") {
  for (const double kp2 : {1e-3, 1e-6, 1e-9, 1e-12}) {
    CAPTURE(kp2);
    Case c(1e-3, 300);
    c.data.momentum = on_polhode(c.moments, {1 - kp2, kp2}, .7);
    check_everywhere(c);
    const Answer truth = c.truth();
    const Answer averaged = c.with(rung::averaged, 1e-3).solve();
    check_honest(averaged, truth);
    CHECK(warns(averaged, "near-separatrix"));
    check_by_name(c, rung::averaged_2, 1e-3, truth);
  }
}

TEST_CASE("failure map: the start is on the separatrix", "[deceleration]") {
  Case c(1e-3, 300);
  // 2H/M^2 = 1/B to the last digit that M allows
  const V a = c.moments.cwiseInverse();
  const double m1 = std::sqrt(a[2] - a[1]), m3 = std::sqrt(a[1] - a[0]);
  c.data.momentum = V(m1, .4, m3).normalized();
  check_everywhere(c);
  // 1/J = (0.5, 0.8, 1): an A - B of 0.3 and B - C of 0.2
  c.moments = V(2, 1.25, 1);
  c.data.momentum = V(std::sqrt(.2), .5, std::sqrt(.3));
  const Answer truth = c.truth();
  const Answer answer = check_everywhere(c);
  CHECK(answer.find("modulus_squared")->values.size() == 6);
  Refusal refusal;
  c.with(rung::averaged, 1e-3).solve(refusal);
  if (refusal.code != Errc::ok) CHECK(refusal.code == Errc::separatrix);
  check_by_name(c, rung::averaged_2, 1e-3, truth);
}

TEST_CASE("failure map: the separatrix holds the motion", "[deceleration]") {
  for (const double b2 : {.1, .5}) {
    CAPTURE(b2);
    Case c(1e-3, 600);
    c.data.control = 1e-3 * V(1, b2, 1);
    check_everywhere(c);
    const Answer averaged = c.with(rung::averaged, 1e-2).solve();
    check_honest(averaged, c.truth());
    CHECK((warns(averaged, "sticks-to-separatrix") || warns(averaged, "near-separatrix")));
  }
}

TEST_CASE("failure map: M -> 0, a tiny start", "[deceleration]") {
  for (const double size : {1e-2, 1e-4, 1e-8}) {
    CAPTURE(size);
    Case c(1e-3, 0.8 * size / 1e-3);
    c.data.momentum *= size;
    check_everywhere(c);
    const Answer truth = c.truth();
    for (const int model : {rung::averaged, rung::averaged_2}) check_by_name(c, model, 1e-3, truth);
  }
}

TEST_CASE("failure map: M -> 0, times behind the stop", "[deceleration]") {
  // the weakest control along the axis of middle inertia is the worst place: the bodies fall to it in the end
  for (const V& b : {V(.6, .9, 1), V(.9, .2, 1), V(1, .9, .6), V(1, 1, 1)}) {
    CAPTURE(b.transpose());
    Case c(1e-3, 8000);
    c.data.control = 1e-3 * b;
    const Answer answer = check_everywhere(c);
    CHECK(quantity(answer, "stop_time") < 8000);
    CHECK(answer.find("angular_momentum_norm")->values.back() == 0);
    CHECK(answer.find("energy")->values.back() == 0);
    const Answer truth = c.truth();
    for (const int model : {rung::averaged, rung::averaged_2}) {
      const Answer named = c.with(model, 1e-3).solve();
      check_honest(named, truth);
      CHECK(named.find("angular_momentum_norm")->values.back() == 0);
    }
  }
}

TEST_CASE("failure map: M = 0 at the start", "[deceleration]") {
  Case c(1e-3, 100);
  c.data.momentum.setZero();
  const Answer answer = c.solve();
  CHECK(answer.met);
  CHECK(std::strcmp(answer.model, "full") == 0);
  for (const Column& column : answer.columns)
    for (const double v : column.values) CHECK((column.kind->measure == Measure::none || v == 0));
  CHECK(quantity(answer, "stop_time") == 0);
  CHECK_FALSE(passed_over(answer, "averaged").empty());
  CHECK_FALSE(passed_over(answer, "averaged-2").empty());

  c.data.rotor_momentum = V(.1, .2, .3);  // M = 0 with turning rotors: the body turns at -J^-1 l
  c.data.asked = all_but_attitude();
  const Answer turning = c.solve();
  CHECK(turning.met);
  for (int i = 0; i < 3; ++i)
    CHECK(turning.find("angular_velocity")->values[std::size_t(i)] ==
          Approx(-c.data.rotor_momentum[i] / c.moments[i]).epsilon(1e-12));
}

TEST_CASE("failure map: A -> B", "[deceleration]") {
  for (const double gap : {.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-10, 0.})
    for (const V& M : {V(.95, .2, .1), V(.6, .5, .4)}) {
      CAPTURE(gap, M.transpose());
      Case c(1e-3, 400);
      c.moments = V(1 + gap, 1, .7);
      c.data.momentum = M;
      check_everywhere(c);
      const Answer truth = c.truth();
      for (const int model : {rung::averaged, rung::averaged_2}) check_by_name(c, model, 1e-3, truth);
      Refusal refusal;
      const Answer averaged = c.with(rung::averaged, 1e-3).solve(refusal);
      if (refusal.code == Errc::ok && gap < 1e-2 && gap > 0) CHECK(warns(averaged, "near-symmetric"));
    }
}

TEST_CASE("failure map: B -> C", "[deceleration]") {
  for (const double gap : {.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-10, 0.})
    for (const V& M : {V(.1, .2, .95), V(.6, .5, .4)}) {
      CAPTURE(gap, M.transpose());
      Case c(1e-3, 400);
      c.moments = V(1.4, 1 + gap, 1);
      c.data.momentum = M;
      check_everywhere(c);
      const Answer truth = c.truth();
      for (const int model : {rung::averaged, rung::averaged_2}) check_by_name(c, model, 1e-3, truth);
    }
}

TEST_CASE("failure map: A = B = C", "[deceleration]") {
  Case c(1e-3, 400);
  c.moments = V(1, 1, 1);
  const Answer answer = check_everywhere(c);
  CHECK(std::strcmp(answer.model, "full") == 0);
  for (const int model : {rung::averaged, rung::averaged_2}) {
    Refusal refusal;
    (void)c.with(model, 1e-3).solve(refusal);
    CHECK(std::string(refusal.why).find("sphere") != std::string::npos);
  }
  c.data.control.setConstant(1e-3);  // the closed form has M decay along itself
  check_everywhere(c);
  c.data.rotor_momentum = V(.1, .2, .3);
  check_everywhere(c);
}

TEST_CASE("failure map: M across the axis of symmetry", "[deceleration]") {
  for (const V& moments : {V(1.4, 1.4, .7), V(1.4, .8, .8)})
    for (const V& b : {V(.6, .9, 1), V(1, 1, 1)}) {
      CAPTURE(moments.transpose(), b.transpose());
      Case c(1e-3, 400);
      c.moments = moments;
      c.data.control = 1e-3 * b;
      c.data.momentum = moments[0] == moments[1] ? V(.6, .8, 0) : V(0, .8, .6);
      const Answer answer = check_everywhere(c);
      if (b[0] != b[1]) CHECK_FALSE(passed_over(answer, "averaged").empty());
    }
}

TEST_CASE("failure map: l -> 0", "[deceleration]") {
  Case bare(1e-3, 300);
  const Answer without = bare.truth();
  for (const double l : {1e-3, 1e-6, 1e-12}) {
    CAPTURE(l);
    Case c = bare;
    c.data.rotor_momentum = l * V(.3, -.7, .5);
    const Answer truth = c.truth();
    for (const double tolerance : {1e-2, 1e-4}) {
      c.data.tolerance = tolerance;
      const Answer answer = c.solve();
      check_honest(answer, truth);
      CHECK(answer.met);
      CHECK(distance(answer, without, "angular_momentum_norm") < 10 * l + tolerance);
    }
    // the averages without rotor and with a vanishing one are one limit
    const Answer with = c.with(rung::averaged, 1e-2).solve(), none = bare.with(rung::averaged, 1e-2).solve();
    CHECK(distance(with, none, "angular_momentum_norm") < l + 1e-7);
    CHECK(distance(with, none, "energy") < 20 * l + 1e-7);
  }
}

TEST_CASE("failure map: |l| >> R", "[deceleration]") {
  for (const double l : {10., 1e3})
    for (const Law law : {Law::total, Law::carrier}) {
      CAPTURE(l, int(law));
      Case c(1e-4, 50);
      c.data.rotor_momentum = l * V(.3, -.7, .5);
      c.data.law = c.data.drag_law = law;
      if (law == Law::carrier) c.data.momentum += c.data.rotor_momentum;
      const Answer truth = c.truth(1e-10);
      for (const double tolerance : {1e-2, 1e-4}) {
        c.data.tolerance = tolerance;
        const Answer answer = c.solve();
        check_honest(answer, truth, 1e-9);
        CHECK(answer.met);
      }
    }
}

TEST_CASE("failure map: the start is a relative equilibrium", "[deceleration]") {
  Case c(1e-3, 300);
  for (const int axis : {0, 1, 2}) {
    CAPTURE(axis);
    c.data.momentum = V::Unit(axis);
    check_everywhere(c);
  }
  // with rotor momentum: omega = sigma M, M_i = g_i/(a_i - sigma)
  c.data.rotor_momentum = V(.2, .15, .3);
  const V a = c.moments.cwiseInverse(), g = a.cwiseProduct(c.data.rotor_momentum);
  for (const double sigma : {.3, -.5, 1.8, 2.2}) {
    CAPTURE(sigma);
    c.data.momentum = g.cwiseQuotient(a - V::Constant(sigma));
    const Answer truth = c.truth();
    for (const double tolerance : {1e-2, 1e-6}) {
      c.data.tolerance = tolerance;
      const Answer answer = c.solve();
      check_honest(answer, truth);
      CHECK(answer.met);
    }
    for (const int model : {rung::averaged, rung::averaged_2}) check_by_name(c, model, 1e-2, truth);
  }
}

TEST_CASE("failure map: crossing of the separatrix without rotor momentum", "[deceleration]") {
  for (const double eps : {1e-3, 1e-4}) {
    CAPTURE(eps);
    Case c(eps, .7 / eps);
    c.data.control = eps * V(1.2, .9, .6);
    const Answer truth = c.truth();
    const Answer averaged = c.with(rung::averaged, .1).solve();
    check_honest(averaged, truth);
    CHECK(warns(averaged, "crosses-separatrix"));
    CHECK(averaged.find("regime")->values.front() == double(Regime::about_largest));
    CHECK(averaged.find("regime")->values.back() == double(Regime::about_smallest));
    CHECK(truth.find("regime")->values.back() == double(Regime::about_smallest));
    Refusal refusal;
    // the full equations take over below 8 breakdown momenta: at 1e-3 above the crossing, at 1e-4 below it
    const Answer second = c.with(rung::averaged_2, 1e-3).solve(refusal);
    if (eps == 1e-4) {
      CHECK(refusal.code == Errc::separatrix);
    } else {
      REQUIRE(refusal.code == Errc::ok);
      check_honest(second, truth);
    }
    for (const double tolerance : {1e-1, 1e-2, 1e-6}) {
      c.data.tolerance = tolerance;
      const Answer answer = c.solve();
      check_honest(answer, truth);
      CHECK(answer.met);
    }
  }
}

TEST_CASE("failure map: capture with rotor momentum is not determined", "[deceleration]") {
  // from one component into a lobe around the axis of largest moment, whose control is the weakest
  Case c(1e-3, 700);
  c.data.control = 1e-3 * V(.6, .9, 1.2);
  c.data.rotor_momentum = V(.0012, .003, .0018);
  bool undetermined = false;
  for (const V& M : {V(.1, .3, .95), V(.5, .5, .7), V(.3, .8, .5)}) {
    CAPTURE(M.transpose());
    c.data.momentum = M;
    const Answer truth = c.truth();
    Refusal refusal;
    const Answer averaged = c.with(rung::averaged, .1).solve(refusal);
    if (refusal.code == Errc::ok) {
      if (averaged.met) check_honest(averaged, truth);
    } else {
      INFO(refusal.why);
      undetermined = undetermined || refusal.code == Errc::undetermined;
      CHECK((refusal.code == Errc::undetermined || refusal.code == Errc::separatrix));
    }
    for (const double tolerance : {.1, 1e-3}) {
      c.data.tolerance = tolerance;
      c.data.rung = any_rung;
      const Answer answer = c.solve();
      check_honest(answer, truth);
      CHECK(answer.met);
    }
  }
  CHECK(undetermined);
}

TEST_CASE("failure map: spread of the control torques", "[deceleration]") {
  for (const V& b : {V(.01, 1, 1), V(1, .01, 1), V(1, 1, .01), V(.01, .01, 1), V(1, 0, 1), V(0, 1, 0), V(0, 0, 1)}) {
    CAPTURE(b.transpose());
    Case c(1e-3, 300);
    c.data.control = 1e-3 * b;
    check_everywhere(c);
    const Answer truth = c.truth();
    for (const int model : {rung::averaged, rung::averaged_2}) check_by_name(c, model, 1e-2, truth);
  }
}

TEST_CASE("failure map: no control", "[deceleration]") {
  Case c(1e-3, 500);
  c.data.control.setZero();
  const Answer drag_only = check_everywhere(c);
  CHECK(warns(drag_only, "no-control"));
  CHECK(quantity(drag_only, "stop_time") == infinity<double>);
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(drag_only.find("angular_momentum_norm")->values[i] ==
          Approx(std::exp(-c.data.drag * c.data.times[i])).epsilon(1e-12));
  for (const double end : {4e5, 1e8}) {  // after e-120, and far below every double: k2 stays
    Case late = c.with(rung::averaged, 1e-2);
    late.data.times = until(end, 3);
    const Answer averaged = late.solve();
    CHECK(averaged.find("regime")->values[2] == averaged.find("regime")->values[0]);
    CHECK(averaged.find("modulus_squared")->values[2] == averaged.find("modulus_squared")->values[0]);
  }
  c.data.drag = 0;
  const Answer free = check_everywhere(c);
  CHECK(warns(free, "no-control"));
  for (const double norm : free.find("angular_momentum_norm")->values) CHECK(norm == Approx(1).epsilon(1e-12));
  c.data.rotor_momentum = V(.1, .2, .3);
  const Answer gyrostat = check_everywhere(c);
  const auto& h = gyrostat.find("energy")->values;
  CHECK(h.front() == Approx(h.back()).epsilon(1e-6));
}

TEST_CASE("failure map: eps is not small", "[deceleration]") {
  for (const double eps : {.1, .3, 1., 10.}) {
    CAPTURE(eps);
    Case c(eps, .7 / eps);
    const Answer answer = check_everywhere(c);
    CHECK(std::strcmp(answer.model, "full") == 0);
    const Answer truth = c.truth();
    for (const int model : {rung::averaged, rung::averaged_2}) check_by_name(c, model, 1e-1, truth);
    if (eps >= .3) {
      const Answer averaged = c.with(rung::averaged, 1e-1).solve();
      CHECK_FALSE(averaged.met);
      CHECK(warns(averaged, "not-slow"));
    }
  }
}

TEST_CASE("failure map: the control of the carrier cannot hold against drag on the total momentum", "[deceleration]") {
  Case c(1e-3, 2000);
  c.data.law = Law::carrier;
  c.data.drag_law = Law::total;
  c.data.rotor_momentum = V(2, 1, 3);
  c.data.drag = 1e-3;  // drag |l| = 3.7e-3 beats b = 1e-3
  const Answer truth = c.truth();
  CHECK(quantity(truth, "stop_time") == infinity<double>);
  for (const double tolerance : {1e-2, 1e-6}) {
    c.data.tolerance = tolerance;
    const Answer answer = c.solve();
    check_honest(answer, truth);
    CHECK(answer.met);
    CHECK(quantity(answer, "stop_time") == infinity<double>);
  }
}
