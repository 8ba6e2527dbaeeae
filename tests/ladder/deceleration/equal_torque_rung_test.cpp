// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/equal_torque_rung.hpp"

#include <random>

#include "gyrostat/ladder/deceleration/cost.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "scenes.hpp"

using namespace scenes;

TEST_CASE("equal-torque rung: the cheapest answer, exact at any tolerance", "[deceleration]") {
  for (const double eps : {1e-4, 1e-2, 1.}) {
    Case c(eps, .8 / eps);
    c.data.control.setConstant(eps);
    const Answer truth = c.truth();
    c.data.tolerance = 1e-11;
    c.data.asked = all_but_attitude();
    const Answer answer = c.solve();
    CHECK(std::strcmp(answer.model, "equal-torque") == 0);
    CHECK(answer.tried.size() == 1);
    check_honest(answer, truth, 1e-10);
    CHECK(distance(answer, truth, "angular_momentum") < 1e-9);
    CHECK(distance(answer, truth, "energy") < 1e-10);
  }
}

TEST_CASE("equal-torque rung: drag alone never stops the body, and leaves no doubt of the modulus", "[deceleration]") {
  for (const double drag : {0., .3}) {
    Case c(1e-3, 100);
    c.data.control.setZero();
    c.data.drag = drag;
    c.data.tolerance = 1e-9;
    const Answer answer = c.solve();
    CAPTURE(drag);
    CHECK(std::strcmp(answer.model, "equal-torque") == 0);
    CHECK(answer.met);
    CHECK(answer.find("modulus_squared")->error < 1e-12);
    const Answer full = c.with(rung::full, 1e-9).solve();
    CHECK(full.find("modulus_squared")->error < 1e-7);
  }
}

TEST_CASE("equal-torque rung: what turns about its axis rests there without a jump of the modulus", "[deceleration]") {
  Case c;
  c.moments = V(2.2e-3, 2.1e-3, 2e-3);
  c.data.drag = 0;
  c.data.control.setConstant(4.4e-6);
  c.data.momentum = V(2.2e-4, 0, 0);
  c.data.times = until(100, 10);  // with the stop, at 50 s
  c.data.tolerance = 1e-3;
  for (const int by : {any_rung, int(rung::equal_torque), int(rung::full)}) {
    CAPTURE(by);
    c.data.rung = by;
    const Answer answer = c.solve();
    CHECK(answer.met);
    CHECK(answer.find("modulus_squared")->error < 1e-12);
  }
  c.data.momentum = V(2e-4, 1e-4, 0);  // on an orbit: its modulus, or that of rest
  const double stop = c.data.momentum.norm() / 4.4e-6;
  c.data.times = {stop / 2, stop};
  c.data.rung = any_rung;
  const auto on_orbit = *c.solve().find("modulus_squared");
  CHECK(on_orbit.error >= on_orbit.values[0]);
  CHECK(on_orbit.error < 1.1 * on_orbit.values[0]);
}

TEST_CASE("equal-torque rung: says why it does not apply", "[deceleration]") {
  const auto why = [](const Case& c) {
    const Track track = equal_torque_track(c.scene(), nullptr);
    CHECK(track.failure == Errc::not_applicable);
    return std::string(track.refusal);
  };
  Case c(1e-3, 100);
  CHECK(why(c).find("not equal") != std::string::npos);
  c.data.control.setConstant(1e-3);
  CHECK(equal_torque_track(c.scene(), nullptr).failure == Errc::ok);
  Case rotor = c, rest = c;
  rotor.data.rotor_momentum = V(0, 0, 1e-9);
  CHECK(why(rotor).find("rotor") != std::string::npos);
  rest.data.momentum.setZero();
  CHECK(why(rest).find("rest") != std::string::npos);
}

TEST_CASE("equal-torque rung: on and beside the separatrix", "[deceleration]") {
  Case c(1e-3, 100);
  c.data.control.setConstant(1e-3);
  c.moments = V(3, 2, 1.5);
  for (const double off : {0., 1e-13, -1e-9, 1e-5}) {  // 0: exactly, the differences of 1/J are 1/6 and 1/6
    c.data.momentum = V(.5 + off, .3, .5);
    for (const double end : {3., 20., 60., 800.}) {
      CAPTURE(off, end);
      c.data.times = until(end);
      Case closed = c.with(rung::equal_torque, 1e-9);
      closed.data.wants_attitude = true;
      const Answer answer = closed.solve();
      const double error = answer.find("attitude")->error;
      if (end < 30 || off == 1e-5) CHECK(error < 1e-6);
      if (end > 200 && off == 0) CHECK(error == infinity<double>);
      if (!(error < 1e-3)) continue;
      closed.data.rung = rung::full;
      closed.data.tolerance = 1e-12;
      const Answer truth = closed.solve();
      for (const char* name : {"attitude", "angular_momentum", "angular_velocity"})
        CHECK(distance(answer, truth, name) <= answer.find(name)->error + truth.find(name)->error);
      c.data.asked = {{column::angular_momentum}};  // without the attitude M is as good
      CHECK(distance(c.with(any_rung, 1e-9).solve(), truth, "angular_momentum") < 1e-9 + truth.error);
      c.data.asked.clear();
    }
  }
}

TEST_CASE("equal-torque rung: attitude, M and omega of three hundred bodies against the full equations",
          "[deceleration]") {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return V(normal(random), normal(random), normal(random)).normalized(); };
  std::vector<double> stated;
  for (int n = 0; n < 300; ++n) {
    V J(1 + unit(random), 1, .3 + .7 * unit(random));
    const double small = std::pow(10, -1 - 11 * unit(random));
    if (n % 5 == 1) J[1] = n % 2 ? J[0] - (J[0] - J[2]) * small : J[2] + (J[0] - J[2]) * small;  // nearly symmetric
    if (n % 5 == 2) J = V(1 + small, 1 + small * unit(random), 1);                               // nearly a sphere
    if (!(J[0] <= J[1] + J[2])) J[0] = J[1] + .9 * J[2];
    const Mat3<double> R =
        n % 2 ? Mat3<double>::Identity() : to_matrix<double>(quaternion_from_vector<double>(3 * direction()));
    Mat3<double> tensor = R * J.asDiagonal() * R.transpose();
    tensor = ((tensor + tensor.transpose()) / 2).eval();
    const auto body = Inertia<double>::from_tensor(tensor);
    REQUIRE(body);
    Asked data;
    data.momentum = direction();
    if (n % 5 == 3) {  // near the separatrix
      const auto p = polhode_through<double>(body->inverse_principal(), body->inverse_gaps(),
                                             body->R_BP().transpose() * data.momentum);
      data.momentum = body->R_BP() * momentum_on(at_modulus<double>(p, {1 - small, small}), 1., 8 * unit(random));
    }
    if (n % 5 == 4) data.momentum = (R.col(n % 3) + small * direction()).normalized();  // next to a principal axis
    if (n % 3 == 0) {
      data.angular_velocity = V(tensor.inverse() * data.momentum);
      data.momentum = tensor * *data.angular_velocity;
    }
    data.attitude = quaternion_from_vector<double>(3 * direction());
    const double span = std::pow(10, 2.3 * unit(random));
    data.control.setConstant(n % 7 ? unit(random) / span : 0);
    data.drag = n % 4 ? 2 * unit(random) / span : 0;
    data.times = until(n % 6 ? span : 3 * span, 4);
    data.wants_attitude = true;
    data.rung = rung::equal_torque;
    Refusal refusal;
    const Answer answer = deceleration::solve<>(*make_scene(*body, data), refusal);
    data.rung = rung::full;
    data.tolerance = 1e-13;
    const Answer truth = deceleration::solve<>(*make_scene(*body, data), refusal);
    REQUIRE(refusal.code == Errc::ok);
    for (const char* name : {"attitude", "angular_momentum", "angular_velocity", "energy", "angular_momentum_norm"}) {
      CAPTURE(n, name, J.transpose(), data.momentum.transpose(), data.control[0], data.drag, data.times.back());
      const double error = answer.find(name)->error, own = truth.find(name)->error;
      CHECK(distance(answer, truth, name) <= error + own);
      if (std::strcmp(name, "attitude") == 0 && error < infinity<double>) stated.push_back(error);
    }
  }
  CHECK(stated.size() > 290);
  std::sort(stated.begin(), stated.end());
  CHECK(stated[stated.size() / 2] < 3e-14);
}

TEST_CASE("equal-torque rung: takes no more trouble than what is asked needs", "[deceleration]") {
  Case c(1e-3, 300);
  c.data.control.setConstant(1e-3);
  CHECK(unbraked_motion(c.scene()) == Unbraked::not_needed);
  CHECK(c.solve().find("angular_momentum") == nullptr);
  const double least = cost_of_equal_torque(c.scene());
  c.data.asked = {{column::angular_momentum}};
  CHECK(unbraked_motion(c.scene()) == Unbraked::in_double);
  CHECK(cost_of_equal_torque(c.scene()) < 10 * least);
  CHECK(unbraked_motion(c.with(any_rung, 1e-14).scene()) == Unbraked::in_two);
  c.data.asked = {{column::attitude}};
  CHECK(unbraked_motion(c.scene()) == Unbraked::in_two);
  CHECK(cost_of_equal_torque(c.scene()) > 10 * least);
  CHECK(std::strcmp(c.solve().model, "equal-torque") == 0);
  c.data.times = until(2000);  // behind the stop, which leaves an attitude
  const Answer rested = c.solve();
  const auto& q = rested.find("attitude")->values;
  CHECK(std::equal(q.end() - 4, q.end(), q.end() - 8));
}

TEST_CASE("equal-torque rung: also under actuators off the principal axes", "[deceleration]") {
  Mat3<double> J;
  J << 1.4, .1, 0, .1, 1, .05, 0, .05, .8;
  Asked data = Case(1e-3, 300).data;
  data.control.setConstant(1e-3);
  Refusal refusal;
  const Answer answer = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  data.rung = rung::full;
  data.tolerance = 1e-11;
  const Answer truth = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  CHECK(std::strcmp(answer.model, "equal-torque") == 0);
  check_honest(answer, truth);
}

TEST_CASE("equal-torque rung: M across an axis of symmetry, where a set-up in double loses its phase",
          "[deceleration]") {
  Case c(1e-3, 100);
  c.data.control.setZero();
  c.data.drag = 1e-4;
  for (const double slight : {.5, 1e-2, 1e-4})
    for (const double share : {1e-2, 1e-4, 1e-6}) {
      c.moments = V(1, 1, slight);
      c.data.momentum = V(.6, .8, share * slight);
      c.data.asked = {{column::angular_momentum}};
      const Answer answer = c.with(rung::equal_torque, 1e-5).solve();
      c.data.asked = {{column::angular_momentum}, {column::attitude}};  // to twice the digits
      const Answer truth = c.with(rung::equal_torque, 1e-5).solve();
      const double error = answer.find("angular_momentum")->error;
      CAPTURE(slight, share, error);
      CHECK(distance(answer, truth, "angular_momentum") <= error + 8 * epsilon<double>);
      CHECK(error <= 1e-5);
    }
}

TEST_CASE("equal-torque rung: drag alone never brings the body to rest, though |M| underflows", "[deceleration]") {
  Case c(1e-3, 100);
  c.data.control.setZero();
  c.data.drag = 1;
  c.data.times = {1, 1e3, 1e5};
  const Answer answer = c.with(rung::equal_torque, 1e-6).solve();
  const auto& k2 = answer.find("modulus_squared")->values;
  CHECK(k2[0] > 0);
  CHECK(k2[2] == k2[0]);
}
