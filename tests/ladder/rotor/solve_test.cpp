// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/solve.hpp"

#include <cstring>
#include <string>

#include "../../models/rotor/bodies.hpp"
#include "../column_error.hpp"
#include "catch.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "truth.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

struct Solved {
  Answer answer;
  Refusal refusal;

  bool by(const char* model) const { return std::strcmp(answer.model, model) == 0; }
  bool warns(const char* code) const {
    for (const Warning& w : answer.warnings)
      if (w.code() == code) return true;
    return false;
  }
  double scalar(const char* name) const {
    for (const Quantity& q : answer.quantities)
      if (q.name() == name) return q.values[0];
    FAIL("no such scalar: " << name);
    return 0;
  }
};

Solved solved(const Gyrostat<double>& body, const Asked& data, Monitor* monitor = nullptr) {
  const auto scene = make_scene(body, data);
  REQUIRE(scene);
  Solved made;
  made.answer = rotor::solve(*scene, made.refusal, monitor);
  return made;
}

/// Within its own stated error in every column, and within the tolerance where it says so.
void check_honest(const Gyrostat<double>& body, const Asked& data, const Answer& answer) {
  Answer truth;
  REQUIRE(true_motion(*make_scene(body, data), truth));
  for (const Column& column : answer.columns) {
    const double error = column_error(column, *truth.find(column.name())) - truth.find(column.name())->error;
    CAPTURE(answer.model, column.kind->name, data.tolerance, error, column.error);
    CHECK(error <= column.error);
    if (answer.met) CHECK(error <= data.tolerance);
  }
}

Asked asked(double span, double tolerance = 1e-6) {
  Asked data;
  for (int i = 0; i <= 8; ++i) data.times.push_back(span * i / 8);
  data.tolerance = tolerance;
  return data;
}

/// The start with momentum H and rotor rate omega.
void start(Asked& data, const Gyrostat<double>& body, const Vec3<double>& H, double omega) {
  data.angular_velocity = body.inverse_inertia() * (H - body.axial_inertia() * omega * body.axis());
  data.rotor_rate = omega;
}

}  // namespace

TEST_CASE("a whole gyrostat at rest is answered in closed form", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const Asked data = asked(200, 1e-9);
  const Solved made = solved(body, data);
  CHECK(made.by("closed-form"));
  CHECK(made.answer.met);
  CHECK(std::isnan(made.scalar("attractor")));
  check_honest(body, data, made.answer);
}

TEST_CASE("near a steady rotation the linear tail answers a loose scene and more is asked of a tight one", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  const auto steady = steady_rotations(body, 8.0);
  const auto& m = steady[0];
  REQUIRE(m.type == SteadyType::minimum);
  Bodies bodies(7);
  for (const double off : {1e-8, 1e-5, 1e-3}) {
    for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
      Asked data = asked(60, tolerance);
      start(data, body, 8 * (m.direction + off * bodies.direction()).normalized(), 3 + off);
      const Solved made = solved(body, data);
      CAPTURE(off, tolerance, made.answer.model);
      CHECK(made.answer.met);
      CHECK(made.scalar("attractor") == 0);
      CHECK(made.scalar("decay_rate") > 0);
      check_honest(body, data, made.answer);
    }
  }
  Asked data = asked(60, 1e-4);
  start(data, body, 8 * (m.direction + 1e-4 * bodies.direction()).normalized(), 3);
  CHECK(solved(body, data).by("linear-tail"));
  start(data, body, 8 * (m.direction + 1e-9 * bodies.direction()).normalized(), 3);
  CHECK(solved(body, data).by("closed-form"));
}

TEST_CASE("a tumbling start climbs to the full equations; V shows when the attractor is certain", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  Asked data = asked(400);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  const Solved late = solved(body, data);
  CHECK(late.by("full"));
  CHECK(late.answer.met);
  const auto steady = steady_rotations(body, 8.0);
  REQUIRE(steady.count == 6);
  const double index = late.scalar("attractor");
  REQUIRE(index >= 0);
  CHECK(steady[int(index)].type == SteadyType::minimum);
  CHECK_FALSE(late.warns("attractor-undecided"));
  check_honest(body, data, late.answer);

  data = asked(0.5);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  const Solved early = solved(body, data);
  CHECK(std::isnan(early.scalar("attractor")));
  CHECK(early.warns("attractor-undecided"));
}

TEST_CASE("random scenes are honest", "[rotor]") {
  Bodies bodies(11);
  for (int i = 0; i < 40; ++i) {
    const auto body = bodies.realisable();
    Asked data = asked(bodies.scale(1, 60), bodies.scale(1e-9, 1e-2));
    data.attitude = bodies.attitude();
    data.angular_velocity = bodies.direction() * bodies.scale(0.1, 3);
    data.rotor_rate = bodies.uniform(-10, 10);
    const Solved made = solved(body, data);
    REQUIRE(made.refusal.code == Errc::ok);
    CHECK(made.answer.met);
    check_honest(body, data, made.answer);
  }
}

TEST_CASE("a rung asked for by name answers where it can, and says what it is worth", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  Asked data = asked(10);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  data.rung = rung::closed_form;
  const Solved closed = solved(body, data);
  CHECK(closed.refusal.code == Errc::not_applicable);
  CHECK(closed.refusal.why != nullptr);
  data.rung = rung::full;
  CHECK(solved(body, data).answer.met);
}

TEST_CASE("the answer does not depend on the body axes", "[rotor]") {
  Bodies bodies(13);
  const auto body = reference_body(0.2, 3);
  Asked data = asked(20, 1e-10);
  data.attitude = bodies.attitude();
  data.angular_velocity = {0.4, -1.1, 0.7};
  const Answer plain = solved(body, data).answer;
  for (int trial = 0; trial < 3; ++trial) {
    // new body axes C: v_C = R v_B
    const Quat<double> q_CB = bodies.attitude();
    const Mat3<double> R = to_matrix(q_CB);
    Mat3<double> theta = R * body.inertia() * R.transpose();
    theta = ((theta + theta.transpose()) / 2).eval();
    const auto turned = Gyrostat<double>::make(theta, (R * body.axis()).normalized(), 0.35, 0.2, 3);
    REQUIRE(turned);
    Asked other = data;
    other.attitude = data.attitude * conjugate(q_CB);
    other.angular_velocity = R * data.angular_velocity;
    const Answer answer = solved(*turned, other).answer;
    const auto &Omega = plain.find("angular_velocity")->values, &Omega_C = answer.find("angular_velocity")->values;
    const auto &q = plain.find("attitude")->values, &q_C = answer.find("attitude")->values;
    for (std::size_t i = 0; i < data.times.size(); ++i) {
      const Vec3<double> a(Omega[3 * i], Omega[3 * i + 1], Omega[3 * i + 2]);
      const Vec3<double> b(Omega_C[3 * i], Omega_C[3 * i + 1], Omega_C[3 * i + 2]);
      CHECK((R * a - b).norm() < 1e-9);
      const Quat<double> p{q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]};
      const Quat<double> p_C{q_C[4 * i + 3], q_C[4 * i], q_C[4 * i + 1], q_C[4 * i + 2]};
      CHECK(angle_between(p, p_C * q_CB) < 1e-9);
    }
  }
}

TEST_CASE("long work reports its progress and can be stopped", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  Asked data = asked(20);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  Monitor monitor;
  CHECK(solved(body, data, &monitor).refusal.code == Errc::ok);
  CHECK(monitor.fraction.load() == 1);
  data = asked(1e5);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  data.rung = rung::full;
  Monitor stopped;
  stopped.cancel = true;
  CHECK(solved(body, data, &stopped).refusal.code == Errc::cancelled);
}
