// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/orbit_rung.hpp"

#include "reference_table.hpp"
#include "scenes.hpp"

using namespace scenes;

namespace {

struct WithRotors {
  double norm, energy, vector;
};

/// A gyrostat with rotor momentum along all axes, far from any separatrix, up to where a third of |U| is gone.
Case gyrostat_case(double eps, Law law, double end = .35) {
  Case c(eps, end / eps);
  c.data.rotor_momentum = V(.2, .15, .3);
  c.data.law = c.data.drag_law = law;
  c.data.times = until(end / eps, 40);
  return c;
}

WithRotors errors_of(int model, double eps, Law law) {
  const Case c = gyrostat_case(eps, law);
  const Answer truth = c.truth(1e-11), answer = c.with(model, 1e-5).solve();
  check_honest(answer, truth);
  return {distance(answer, truth, "angular_momentum_norm"), distance(answer, truth, "energy"),
          model == rung::averaged_2 ? distance(answer, truth, "angular_momentum") : 0};
}

double slope_by_4(double coarse, double fine) { return std::log(coarse / fine) / std::log(4); }

}  // namespace

TEST_CASE("orbit rung: orders with rotor momentum, under both laws", "[deceleration]") {
  for (const Law law : {Law::total, Law::carrier}) {
    CAPTURE(int(law));
    const WithRotors a = errors_of(rung::averaged, 4e-4, law), b = errors_of(rung::averaged, 1e-4, law);
    CHECK(slope_by_4(a.norm, b.norm) == Approx(1).margin(.15));
    CHECK(slope_by_4(a.energy, b.energy) == Approx(1).margin(.15));
    const WithRotors c = errors_of(rung::averaged_2, 4e-4, law), d = errors_of(rung::averaged_2, 1e-4, law);
    CHECK(slope_by_4(c.norm, d.norm) == Approx(2).margin(.15));
    CHECK(slope_by_4(c.energy, d.energy) == Approx(2).margin(.15));
    CHECK(slope_by_4(c.vector, d.vector) == Approx(1).margin(.15));
    CHECK(d.norm < b.norm / 50);
  }
}

TEST_CASE("orbit rung: the reference cases through the ladder", "[deceleration]") {
  int checked = 0;
  for (auto c : reference::cases()) {
    if (!c.has_rotor()) continue;
    CAPTURE(c.id);
    c.data.rung = rung::averaged;
    c.data.tolerance = 1e-9;
    Refusal refusal;
    const Answer answer = deceleration::solve<>(c.scene(), refusal);
    INFO((refusal.why ? refusal.why : ""));
    REQUIRE(refusal.code == Errc::ok);
    double norm = 0, energy = 0, size = 0, most = 0;
    for (std::size_t i = 0; i < c.norm.size(); ++i) {
      const double R = answer.find("angular_momentum_norm")->values[i], h = answer.find("energy")->values[i];
      CHECK(R == Approx(c.norm[i]).epsilon(1e-8));
      CHECK(h == Approx(c.energy[i]).epsilon(1e-8));
      norm = std::max(norm, std::abs(R - c.full_norm[i]));
      energy = std::max(energy, std::abs(h - c.full_energy[i]));
      size = std::max(size, c.full_norm[i]);
      most = std::max(most, c.full_energy[i]);
    }
    CHECK(norm / size <= answer.find("angular_momentum_norm")->error);
    CHECK(energy / most <= answer.find("energy")->error);
    ++checked;
  }
  CHECK(checked == 6);
}

TEST_CASE("orbit rung: actuators off the principal axes", "[deceleration]") {
  Mat3<double> J;
  J << 1.4, .1, .02, .1, 1, .05, .02, .05, .7;
  Asked data = Case(1e-4, 4000).data;
  const auto body = Inertia<double>::from_tensor(J);
  const auto solved = [&](int model, double tolerance) {
    data.rung = model;
    data.tolerance = tolerance;
    Refusal refusal;
    const Answer answer = deceleration::solve<>(*make_scene(*body, data), refusal);
    REQUIRE(refusal.code == Errc::ok);
    return answer;
  };
  const Answer truth = solved(rung::full, 1e-11);
  for (const int model : {rung::averaged, rung::averaged_2}) check_honest(solved(model, 1e-3), truth);
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const Answer answer = solved(any_rung, tolerance);
    CHECK(answer.met);
    check_honest(answer, truth);
  }
}

TEST_CASE("orbit rung: honest with rotor momentum, to the stop and behind it", "[deceleration]") {
  for (const Law law : {Law::total, Law::carrier})
    for (const double eps : {1e-2, 1e-3}) {
      CAPTURE(int(law), eps);
      const Case c = gyrostat_case(eps, law, 3);
      const Answer truth = c.truth();
      for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-6}) {
        CAPTURE(tolerance);
        const Answer answer = c.with(any_rung, tolerance).solve();
        check_honest(answer, truth);
        CHECK(answer.met);
        CHECK(answer.find("energy")->values.back() ==
              Approx(law == Law::total ? c.scene().problem().rotor_energy_scale() / 2 : 0).margin(tolerance));
      }
    }
}

TEST_CASE("orbit rung: who asks for M to a loose tolerance has the phase by it", "[deceleration]") {
  for (const Law law : {Law::total, Law::carrier})
    for (const double tolerance : {2e-2, 2e-3}) {
      CAPTURE(int(law), tolerance);
      Case c = gyrostat_case(tolerance / 400, law).with(rung::averaged_2, tolerance);
      c.data.asked = {{column::angular_momentum}};
      const Answer answer = c.solve();
      CHECK(answer.met);
      check_honest(answer, c.truth());
    }
}

TEST_CASE("orbit rung: the stop is sought only where it is asked for", "[deceleration]") {
  for (const int model : {rung::averaged, rung::averaged_2}) {
    CAPTURE(model);
    Case c = gyrostat_case(1e-4, Law::total).with(model, 1e-3);
    c.data.asked = {{column::angular_momentum_norm}};
    const Answer without = c.solve();
    c.data.asked.push_back({scalar::stop_time, true});
    const Answer with = c.solve();
    CHECK(with.find("angular_momentum_norm")->values == without.find("angular_momentum_norm")->values);
    CHECK(with.counts.steps > 2 * without.counts.steps);
    CHECK(without.quantities.empty());
    REQUIRE(with.quantities.size() == 1);
    CHECK(with.quantities[0].values[0] > 1e4);
  }
}

TEST_CASE("orbit rung: where no tail is in doubt the stop is followed to its end, through the drag", "[deceleration]") {
  Case c = gyrostat_case(1e-4, Law::total);
  c.data.control = V(1e-4, 1e-4, 1e-4);
  c.data.drag = 1e-2;
  c.data.rung = rung::averaged;
  c.data.tolerance = 1e-9;
  const Answer answer = c.solve(), truth = c.truth();
  const Quantity &stop = answer.quantities.at(0), &right = truth.quantities.at(0);
  REQUIRE(stop.kind == &scalar_kinds[scalar::stop_time]);
  CHECK(stop.values[0] == Approx(std::log(1 + 1e-2 / 1e-4) / 1e-2).epsilon(1e-9));
  CHECK(std::abs(stop.values[0] - right.values[0]) <= (stop.error + right.error) * right.values[0]);
}

TEST_CASE("orbit rung: a stop whose error is too large whenever it comes is not sought", "[deceleration]") {
  Case c = gyrostat_case(1e-3, Law::carrier);
  c.data.tolerance = 1e-3;
  Track none, needed, named;
  const auto sought = [](Track& track, const Case& of, double late) {
    return deceleration::detail::seeks_stop(track, of.scene(), late, 1000);
  };
  CHECK(sought(none, c, .9));
  CHECK(none.warnings.empty());
  CHECK_FALSE(sought(none, c, 1.1));
  REQUIRE(none.warnings.size() == 1);
  CHECK(none.warnings[0].code() == "stop-withheld");
  CHECK(sought(named, c.with(rung::averaged, 1e-3), 1.1));
  c.data.asked = {{scalar::stop_time, true}};
  CHECK(sought(needed, c, 1.1));
  c.data.asked = {{column::energy}};
  CHECK_FALSE(sought(needed, c, .9));
  CHECK(needed.warnings.empty());
}

TEST_CASE("orbit rung: refusals and the size of breakdown", "[deceleration]") {
  Case c = gyrostat_case(1e-3, Law::total);
  Case sphere = c, rest = c;
  sphere.moments = V(1, 1, 1);
  rest.data.momentum.setZero();
  for (const Case* bad : {&sphere, &rest}) {
    Refusal refusal;
    bad->with(rung::averaged, 1e-3).solve(refusal);
    CHECK(refusal.code != Errc::ok);
    CHECK(refusal.why != nullptr);
    bad->with(rung::averaged_2, 1e-3).solve(refusal);
    CHECK(refusal.code != Errc::ok);
    CHECK(refusal.why != nullptr);
  }
  // with turning rotors the body turns to the end: the breakdown is linear in the torque, not its root
  const auto p = c.scene().problem();
  const double far = deceleration::detail::orbit_breakdown(p, 1e-3),
               near = deceleration::detail::orbit_breakdown(p, 1e-5);
  CHECK(far / near == Approx(100));
  CHECK(far < breakdown_momentum(p, 1e-3));
}

TEST_CASE("orbit rung: the second order does not lead along a separatrix", "[deceleration]") {
  Case c;
  c.moments = V(16.610303555072683, 4.7346610276233108, 18.867221396289999);
  c.data.rotor_momentum = V(0.57153037983505539, -0.26308699404725783, 0.29143440786306024);
  c.data.control = V(0.0050470743456133057, 0.006314824015251558, 0.013222392267056321);
  c.data.drag = 0.00074254085486726289;
  c.data.momentum = V(10.555683923885208, -6.185015883180891, 14.474505977412523);
  c.data.times = until(50, 5);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    CAPTURE(tolerance);
    const Answer answer = c.with(rung::averaged_2, tolerance).solve();
    CHECK(std::isnan(quantity(answer, "stop_time")));  // true: 1348.5 s, after a crossing at 710 s
  }
}

TEST_CASE("orbit rung: near rest k2 is not known, also where only the error of |M| leads there", "[deceleration]") {
  Mat3<double> J;  // of a body that is symmetric but for rounding
  J << 141.39393709937585, 17.770318842467482, 33.059698994961749, 17.770318842467482, 119.10249986301159,
      18.288972862658483, 33.059698994961749, 18.288972862658483, 143.29636979044415;
  Asked data;
  data.momentum = V(33.327518605942664, 85.5260335437858, -391.96301550253185);
  data.control = V(1.6767130162836303, 0.4964069187184123, 4.4055269530166976);
  data.drag = 0.014219061630927794;
  data.times = until(78.29546054234514, 40);
  data.rung = rung::averaged;
  data.tolerance = 1e-6;
  Refusal refusal;
  const auto scene = make_scene(*Inertia<double>::from_tensor(J), data);
  const Answer answer = deceleration::solve<>(*scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK_FALSE(answer.met);
  data.rung = rung::full;
  data.tolerance = 1e-10;
  const Answer truth = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  CHECK(distance(answer, truth, "modulus_squared") > 1e-8);
  CHECK(answer.find("modulus_squared")->error > distance(answer, truth, "modulus_squared"));
}

TEST_CASE("orbit rung: just before the stop it errs no more than it states", "[deceleration]") {
  // equal torques and no drag: |M| = |M0| - b t, exactly
  Case c(1e-4, 1);
  const double b = 2e-4;
  c.data.rotor_momentum = V(.2, .15, .3);
  c.data.control = V(b, b, b);
  c.data.drag = 0;
  for (const double scale : {1., .3, 2.7}) {
    c.data.momentum = scale * V(.9, .7, .8);
    const double norm = c.data.momentum.norm(), stop = norm / b;
    for (const double before : {1e-4, 1e-6, 1e-8, 3e-9, 1e-9, 1e-10, 1e-12, 1e-14})
      for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        c.data.times = {0, stop / 2, stop * (1 - before)};
        c.data.asked = {{column::angular_momentum_norm, false, tolerance}};
        Refusal refusal;
        const Answer answer = c.with(rung::averaged, tolerance).solve(refusal);
        if (refusal.code != Errc::ok) continue;
        CAPTURE(scale, before, tolerance);
        const Column& column = *answer.find("angular_momentum_norm");
        CHECK(std::abs(column.values.back() - (norm - b * c.data.times.back())) <= column.error * norm);
        CHECK(column.error < 1e-3);
      }
  }
}

TEST_CASE("orbit rung: who does not know the energy does not know the curve", "[deceleration]") {
  // two moments nearly alike librate far more slowly than the drag stops the body
  Case c(1, 1);
  c.moments = {1.5190639713331304, 1.4119766394438593, 1.411932947981251};
  c.data.rotor_momentum = V(0.669845224632734, -0.27105529378585463, 0.017557232547090816);
  c.data.control.setZero();
  c.data.drag = 5.525927199917639;
  c.data.law = c.data.drag_law = Law::total;
  c.data.momentum = V(-8.827917390778833, 8074.478012185264, -6688.785200698465);
  c.data.times = {0, 0.02, 0.06, 0.1, 0.14};
  Refusal refusal;
  const Answer answer = c.with(rung::averaged, 1e-6).solve(refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK(answer.find("energy")->error > 1);
  CHECK(answer.find("modulus_squared")->error == 1);
  check_honest(answer, c.truth(1e-11));
}
