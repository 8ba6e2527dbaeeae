// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/solve.hpp"

#include <array>
#include <random>

#include "reference_table.hpp"
#include "scenes.hpp"

using namespace scenes;

namespace {

Mat3<double> rotation(double angle, const V& axis) {
  const V n = std::sin(angle / 2) * axis.normalized();
  return to_matrix(Quat<double>{std::cos(angle / 2), n[0], n[1], n[2]});
}

V row(const Answer& answer, const char* name, std::size_t i) {
  const auto& x = answer.find(name)->values;
  return {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
}

}  // namespace

TEST_CASE("solve: moments in another order give the same answer in that order", "[deceleration]") {
  for (const double l : {0., .1})
    for (const double tolerance : {1e-2, -1e-2, 1e-5, -1e-5}) {  // < 0: asked for every column
      Case c(1e-4, 3000);
      c.data.rotor_momentum = l * V(1, 2, -1);
      c.data.tolerance = std::abs(tolerance);
      if (tolerance < 0) c.data.asked = all_but_attitude();
      const Answer plain = c.solve();
      std::array<int, 3> order{0, 1, 2};
      do {
        CAPTURE(l, tolerance, order[0], order[1]);
        Case d = c;
        for (int i = 0; i < 3; ++i) {
          d.moments[i] = c.moments[order[std::size_t(i)]];
          d.data.control[i] = c.data.control[order[std::size_t(i)]];
          d.data.momentum[i] = c.data.momentum[order[std::size_t(i)]];
          d.data.rotor_momentum[i] = c.data.rotor_momentum[order[std::size_t(i)]];
        }
        // an odd exchange mirrors the axes: the mirror image of a motion is one with M and l turned round
        const bool odd = ((order[1] - order[0] + 3) % 3) != 1;
        if (odd) d.data.momentum = -d.data.momentum, d.data.rotor_momentum = -d.data.rotor_momentum;
        const Answer other = d.solve();
        CHECK(std::strcmp(plain.model, other.model) == 0);
        for (const char* name : {"angular_momentum_norm", "energy", "modulus_squared"})
          CHECK(distance(other, plain, name) < 1e-8);
        if (tolerance > 0) continue;
        for (std::size_t i = 0; i < 6; ++i) {
          const V a = row(plain, "angular_momentum", i), b = row(other, "angular_momentum", i);
          const V back(a[order[0]], a[order[1]], a[order[2]]);
          CHECK((b - (odd ? -back : back)).norm() < 2 * std::abs(tolerance) * c.data.momentum.norm());
        }
      } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST_CASE("solve: a dual spinner, equal moments and the rotor on the axis, is averaged as any body", "[deceleration]") {
  for (const double last : {0.7, 1.4})
    for (const double spin : {0., 1e-3, 0.4}) {
      Case c(1e-5, 20000);
      c.moments = V(1, 1, last);
      c.data.rotor_momentum = V(0, 0, .3);
      c.data.momentum = V(.01, .9, .3 + last * spin);
      const Answer truth = c.truth();
      CAPTURE(last, spin);
      for (const int rung : {rung::averaged, rung::averaged_2}) {
        const Answer answer = c.with(rung, 1e-2).solve();
        for (const char* name : {"angular_momentum_norm", "energy", "modulus_squared"})
          CHECK(distance(answer, truth, name) <= answer.find(name)->error);
      }
      CHECK(c.with(any_rung, 1e-2).solve().met);
    }
}

TEST_CASE("solve: a dual spinner in turned axes is averaged as any body", "[deceleration]") {
  std::mt19937_64 random(4711);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 24; ++k) {
    const Mat3<double> R = rotation(1 + k, V(normal(random), normal(random), normal(random)));
    const V moments = 100 * V(1, 1, k % 2 == 0 ? 0.7 : 1.4);
    const Mat3<double> J = R * moments.asDiagonal() * R.transpose();
    Asked data = Case(1e-5, 2e4).data;
    data.control.setConstant(1e-3);  // the same along any axes
    data.momentum = R * V(1, 90, 30 + normal(random));
    data.rotor_momentum = R * V(0, 0, k % 4 < 2 ? 3 : 50);  // about the axis, and all round
    const auto body = Inertia<double>::from_tensor((J + J.transpose()) / 2);
    const auto by = [&](int rung, double tolerance) {
      data.rung = rung, data.tolerance = tolerance;
      Refusal refusal;
      const Answer answer = deceleration::solve<>(*make_scene(*body, data), refusal);
      INFO(refusal.model << ": " << (refusal.why ? refusal.why : ""));
      REQUIRE(refusal.code == Errc::ok);
      return answer;
    };
    const Answer truth = by(rung::full, 1e-9);
    CAPTURE(k);
    CHECK(truth.find("modulus_squared")->error < 1e-9);
    for (const int rung : {rung::averaged, rung::averaged_2}) {
      const Answer answer = by(rung, 1e-2);
      for (const char* name : {"angular_momentum_norm", "energy", "modulus_squared"})
        CHECK(distance(answer, truth, name) <= answer.find(name)->error);
    }
  }
}

TEST_CASE("solve: averaged by name beside a separatrix or an equilibrium states what it misses there",
          "[deceleration]") {
  struct One {
    V moments, rotor, omega, control;
    double drag, end;
  };
  const double J = 2.6289e-4;
  for (const One& one : {// a slim body whose rotor holds it beside the saddle: the first oscillation leads over it
                         One{V(J * (1 + 1e-5), J, 1.71e-7), V(-3.92e-7, 4.62e-6, 1.806e-5),
                             V(-.02921827, .01522464, 2.182), V::Constant(4.9e-12), 4.925e-6, 800},
                         // out of one lobe, and by chance into the other
                         One{V(1.25734996, 1.25734989, .07898505), V(-.82643929, -1.2849851, -.43698588),
                             V(1.02432, 1.59026, -1.305), V::Constant(3.918e-5), 0, 330},
                         // on an equilibrium, from which the torque swings the body away
                         One{V(1.06878147, 1.06147612, 1.06147497), V(0, 0, -.18386755), V(5.7e-5, -8.36e-5, -1.957068),
                             V(.0103, .0034, .0029), .00626, 141}}) {
    Case c;
    c.moments = one.moments;
    c.data.rotor_momentum = one.rotor;
    c.data.momentum = one.moments.cwiseProduct(one.omega) + one.rotor;
    c.data.control = one.control;
    c.data.drag = one.drag;
    c.data.times = until(one.end);
    const Answer truth = c.truth(1e-9);
    Refusal refusal;
    const Answer answer = c.with(rung::averaged, 1e-4).solve(refusal);
    CAPTURE(one.moments[0], refusal.code);
    if (refusal.code != Errc::ok) continue;
    for (const char* name : {"angular_momentum_norm", "energy"})
      CHECK(distance(answer, truth, name) <= answer.find(name)->error);
  }
}

TEST_CASE("solve: a body at rest is not told that it never stops", "[deceleration]") {
  Case c(0, 10);
  c.data.drag = 0.1;
  CHECK(warns(c.solve(), "no-control"));
  c.data.momentum.setZero();
  const Answer rest = c.solve();
  CHECK(quantity(rest, "stop_time") == 0);
  CHECK_FALSE(warns(rest, "no-control"));
}

TEST_CASE("solve: a stop within the times is told by every rung, to its error", "[deceleration]") {
  Case c;
  c.moments = V(0.0003665, 0.000377, 0.0004129);
  c.data.rotor_momentum = V(0, 0, 0.00015);
  c.data.control = V::Constant(5.7178e-6);
  c.data.law = Law::carrier;
  c.data.momentum = c.moments.cwiseProduct(V(2.02, -1.05, 1.67)) + c.data.rotor_momentum;
  c.data.times = until(195, 20);
  const double stop = quantity(c.truth(), "stop_time");
  REQUIRE(stop < 195);
  for (const int rung : {rung::averaged, rung::averaged_2}) {
    const Answer answer = c.with(rung, 1e-2).solve();
    CAPTURE(answer.model);
    REQUIRE(answer.quantity("stop_time") != nullptr);
    CHECK(std::abs(quantity(answer, "stop_time") / stop - 1) <= answer.quantity("stop_time")->error);
  }
}

TEST_CASE("solve: turned body axes turn the answer", "[deceleration]") {
  const Mat3<double> R = rotation(.9, V(1, -2, .5));
  Asked data = Case(1e-3, 300).data;
  data.asked = all_but_attitude();
  data.control.setConstant(1e-3);  // the same along any axes
  data.rotor_momentum = V(.1, .05, -.2);
  data.tolerance = 1e-9;
  const Mat3<double> J = V(1.4, 1, .7).asDiagonal();
  Refusal refusal;
  const Answer plain = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  REQUIRE(refusal.code == Errc::ok);
  data.momentum = R * data.momentum;
  data.rotor_momentum = R * data.rotor_momentum;
  const Answer turned =
      deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(R * J * R.transpose()), data), refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK(distance(turned, plain, "angular_momentum_norm") < 1e-9);
  CHECK(distance(turned, plain, "energy") < 1e-9);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK((row(turned, "angular_momentum", i) - R * row(plain, "angular_momentum", i)).norm() < 3e-9);
    CHECK((row(turned, "angular_velocity", i) - R * row(plain, "angular_velocity", i)).norm() < 3e-9);
  }
}

TEST_CASE("solve: climbs from the cheapest rung as the tolerance tightens", "[deceleration]") {
  Case c(1e-5, 3e4);
  const Answer truth = c.truth();
  int before = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-10}) {
    CAPTURE(tolerance);
    c.data.tolerance = tolerance;
    const Answer answer = c.solve();
    CHECK(answer.met);
    CHECK(answer.tolerance == tolerance);
    CHECK(int(answer.tried.size()) >= before);
    before = int(answer.tried.size());
    CHECK(std::strcmp(answer.tried.back().model, answer.model) == 0);
    CHECK(std::strcmp(answer.tried.front().model, "equal-torque") == 0);
    CHECK(answer.tried.front().why != nullptr);
    check_honest(answer, truth);
    CHECK(answer.counts.rhs > 0);
  }
  CHECK(before == 4);
}

TEST_CASE("solve: the models answer by their names", "[deceleration]") {
  Case c(1e-4, 3000);
  for (const auto& [model, name] : {std::pair{rung::averaged, "averaged"}, std::pair{rung::averaged_2, "averaged-2"},
                                    std::pair{rung::full, "full"}}) {
    const Answer answer = c.with(model, 1e-3).solve();
    CHECK(std::strcmp(answer.model, name) == 0);
    CHECK(answer.tried.size() == 1);
    CHECK(answer.tried[0].accepted);
  }
  Refusal refusal;
  const Answer none = c.with(rung::equal_torque, 1e-3).solve(refusal);
  CHECK(refusal.code == Errc::not_applicable);
  CHECK(std::strcmp(refusal.model, "equal-torque") == 0);
  CHECK(none.columns.empty());
}

TEST_CASE("solve: about an axis that the control leaves alone a body turns on for ever, and every rung says so",
          "[deceleration]") {
  const auto told = [](const Answer& answer) {
    const Quantity* stop = answer.quantity("stop_time");
    return std::array<double, 2>{stop ? stop->values[0] : gyrostat::nan<double>,
                                 stop ? stop->error : gyrostat::nan<double>};
  };
  for (const double drag : {0., 3e-5}) {
    for (const int alone : {0, 2}) {  // the axes of the greatest and the least moment
      Case c(1e-4, 3000);
      c.data.drag = drag;
      c.data.control[alone] = 0;
      // from beside the axis, and from aside, where only going on decides
      for (const double aside : {0.1, 20.}) {
        V M(aside, 0.7 * aside, aside);
        M[alone] = 1;
        c.data.momentum = M.normalized();
        for (const int model : {rung::averaged, rung::averaged_2, rung::full}) {
          Refusal refusal;
          const Answer answer = c.with(model, 1e-3).solve(refusal);
          if (refusal.code != Errc::ok) continue;
          CAPTURE(drag, alone, aside, answer.model);
          if (aside < 1) {
            CHECK(std::isinf(told(answer)[0]));
            CHECK(told(answer)[1] == 0);
            CHECK(warns(answer, "does-not-stop"));
          }
          CHECK(answer.quantity("final_angular_velocity") == nullptr);
        }
        c.data.asked = {{scalar::stop_time, true}};
        const Answer answer = c.with(rung::full, 1e-3).solve();
        CHECK(std::isinf(told(answer)[0]));
        CHECK(warns(answer, "does-not-stop"));
      }
    }
  }
  // right across the axis it stops
  Case across(1e-4, 3000);
  across.data.asked = {{scalar::stop_time, true}};
  across.data.drag = 0, across.data.control = V(0, 2e-4, 2e-4), across.data.momentum = V(0, 0, 1);
  CHECK(told(across.with(rung::full, 1e-6).solve())[0] == Approx(5000).epsilon(1e-6));
  // a late time shows what is left
  Case late(1e-2, 3000);
  late.data.drag = 0, late.data.control[2] = 0, late.data.momentum = V(20, 14, 1).normalized();
  const Answer answer = late.with(rung::full, 1e-9).solve();
  const auto& norm = answer.find("angular_momentum_norm")->values;
  CHECK(norm.back() > 1e-3);
  CHECK(norm.back() == Approx(norm[norm.size() - 2]).epsilon(1e-9));
}

TEST_CASE("solve: what an answer says of its scene", "[deceleration]") {
  Case c(1e-4, 3000);
  const Answer plain = c.solve();
  CHECK(quantity(plain, "small_parameter") == Approx(1e-4).epsilon(1e-12));
  CHECK(quantity(plain, "separatrix_distance") > 0);
  CHECK(quantity(plain, "final_angular_velocity") == 0);
  CHECK_FALSE(warns(plain, "does-not-stop"));
  CHECK_FALSE(warns(plain, "no-control"));
  Case rotor = c;
  rotor.moments = V(.7, 1.4, 1);
  rotor.data.rotor_momentum = V(.1, .2, .3);
  const Answer turning = rotor.solve();
  CHECK(warns(turning, "does-not-stop"));
  REQUIRE(turning.quantity("final_angular_velocity"));
  for (int i = 0; i < 3; ++i)
    CHECK(turning.quantity("final_angular_velocity")->values[std::size_t(i)] ==
          Approx(-rotor.data.rotor_momentum[i] / rotor.moments[i]).epsilon(1e-13));
  rotor.data.law = rotor.data.drag_law = Law::carrier;
  CHECK_FALSE(warns(rotor.solve(), "does-not-stop"));
  // a drag on what the control does not oppose pushes on when that has come to zero
  const auto pushed = [&](Law law, Law drag_law) {
    Case strong = rotor;
    strong.data.drag = 10, strong.data.law = law, strong.data.drag_law = drag_law;
    for (const auto& warning : strong.solve().warnings)
      if (warning.kind->code == std::string("does-not-stop")) return std::string(warning.text);
    return std::string();
  };
  CHECK(pushed(Law::total, Law::carrier).find("momentum at zero") != std::string::npos);
  CHECK(pushed(Law::carrier, Law::total).find("carrier at rest") != std::string::npos);
}

TEST_CASE("solve: attitude comes from the full equations alone", "[deceleration]") {
  Case c(1e-3, 100);
  c.data.wants_attitude = true;
  const Answer answer = c.solve();
  CHECK(std::strcmp(answer.model, "full") == 0);
  REQUIRE(answer.find("attitude"));
  for (std::size_t i = 0; i < answer.times.size(); ++i) {
    const double* q = &answer.find("attitude")->values[4 * i];
    CHECK(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == Approx(1).epsilon(1e-14));
  }
  CHECK(passed_over(answer, "averaged").find("does not give") != std::string::npos);
  CHECK(passed_over(answer, "averaged-2").find("does not give") != std::string::npos);
}

TEST_CASE("solve: units scale out, down to the tiny and up to the huge", "[deceleration]") {
  Case c(1e-4, 3000);
  c.data.tolerance = 1e-4;
  c.data.rung = rung::averaged_2;  // named, so that it also gives the stop after the times asked for
  const Answer plain = c.solve();
  REQUIRE(std::isfinite(quantity(plain, "stop_time")));
  for (const double s : {1e-6, 1e6}) {  // the body and all momenta and torques times s
    Case d = c;
    d.moments *= s;
    d.data.momentum *= s;
    d.data.control *= s;
    const Answer scaled = d.solve();
    CHECK(std::strcmp(plain.model, scaled.model) == 0);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(scaled.find("angular_momentum_norm")->values[i] ==
            Approx(s * plain.find("angular_momentum_norm")->values[i]).epsilon(1e-9));
      CHECK(scaled.find("modulus_squared")->values[i] ==
            Approx(plain.find("modulus_squared")->values[i]).epsilon(1e-7));
    }
    Case e = c;  // time
    e.data.momentum *= s;
    e.data.control *= s * s;
    e.data.drag *= s;
    for (double& t : e.data.times) t /= s;
    const Answer faster = e.solve();
    CHECK(std::strcmp(plain.model, faster.model) == 0);
    CHECK(quantity(faster, "stop_time") * s == Approx(quantity(plain, "stop_time")).epsilon(1e-7));
  }
}

TEST_CASE("solve: a monitor sees the work and can end it", "[deceleration]") {
  Case c(1e-5, 5e4);
  c.data.rung = rung::full;
  c.data.tolerance = 1e-10;
  Monitor monitor;
  Refusal refusal;
  deceleration::solve<>(c.scene(), refusal, &monitor);
  CHECK(refusal.code == Errc::ok);
  CHECK(monitor.fraction.load() == Approx(1).margin(.01));
  Monitor stopped;
  stopped.cancel = true;
  deceleration::solve<>(c.scene(), refusal, &stopped);
  CHECK(refusal.code == Errc::cancelled);
}

TEST_CASE("solve: the reference cases at many tolerances", "[deceleration]") {
  for (auto c : reference::cases()) {
    for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
      CAPTURE(c.id, tolerance);
      c.data.tolerance = tolerance;
      Refusal refusal;
      const Answer answer = deceleration::solve<>(c.scene(), refusal);
      REQUIRE(refusal.code == Errc::ok);
      INFO(stated(answer));
      CHECK(answer.met);
      double norm = 0, energy = 0, size = 0, most = 0;
      for (std::size_t i = 0; i < c.full_norm.size(); ++i) {
        norm = std::max(norm, std::abs(answer.find("angular_momentum_norm")->values[i] - c.full_norm[i]));
        energy = std::max(energy, std::abs(answer.find("energy")->values[i] - c.full_energy[i]));
        size = std::max(size, c.full_norm[i]);
        most = std::max(most, c.full_energy[i]);
      }
      CHECK(norm / size <= answer.find("angular_momentum_norm")->error);
      CHECK(energy / most <= answer.find("energy")->error);
      const double stop = quantity(answer, "stop_time");
      if (!std::isnan(c.full_stop) && !std::isnan(stop)) CHECK(std::abs(stop / c.full_stop - 1) <= answer.error + 3e-8);
    }
  }
}
