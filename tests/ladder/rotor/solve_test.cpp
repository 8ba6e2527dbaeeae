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
  Asked data = asked(400, 1e-6);
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

  data = asked(0.5, 1e-6);
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
  Asked data = asked(10, 1e-6);
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
  Asked data = asked(20, 1e-6);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  Monitor monitor;
  CHECK(solved(body, data, &monitor).refusal.code == Errc::ok);
  CHECK(monitor.fraction.load() == 1);
  data = asked(1e5, 1e-6);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 0);
  data.rung = rung::full;
  Monitor stopped;
  stopped.cancel = true;
  CHECK(solved(body, data, &stopped).refusal.code == Errc::cancelled);
}

TEST_CASE("what rounds in the tensor of a slim body is in every rung's error", "[rotor]") {
  struct Slim {
    double theta[6];  // 11, 22, 33, 12, 13, 23
    Vec3<double> axis;
    double lambda, slope, target;
    Vec3<double> Omega;
    double rate, span;
  };
  const Slim bodies[] = {
      // a rod about no axis of its own, nearly at rest: the two parts of H cancel
      {{642218.549525043, 270304.25034275773, 613211.32101194363, 243776.05800990475, 134371.31143828243,
        -271504.31811031082},
       {0.60415063602705177, 0.24966052599908017, -0.75675070581134674},
       0.0016780925181580694,
       2.8790643230685201e-10,
       -79.313769964321054,
       {0.027383953396755454, -0.055330474148870427, -0.030498753797152788},
       -79.313769964321054,
       2400},
      // the same with no momentum but for rounding
      {{1126968.793612455, 692970.07832688477, 1155354.7225049557, 535370.10995764832, -346191.9896465044,
        513869.83067085932},
       {0.40748973344893941, 0.91108690308832962, 0.062231600932556995},
       0.37108448571383129,
       4.2267738286547594e-08,
       1.834430364879599,
       {0.0007601088499576326, -0.0011282794055208021, 0.00072958679161851797},
       0.034512587307369766,
       4e5},
      // a thin rotor oblique in a rod along axis 3
      {{0.4933211778965595, 0.49431554435421676, 0.0009943664576577606, 0, 0, 0},
       {-0.8449814297599532, -0.3413974179901367, -0.4116481341515996},
       0.00024587892804734085,
       1.7808107476212011e-06,
       -0.20483218327726072,
       {-7.762536824575064e-10, -1.0204229736059842e-08, 0.5385548363221692},
       0.005132882677934349,
       7.2},
      // near an unstable steady rotation
      {{96393470.472047538, 84436320.100728795, 165361912.16029918, 82464519.777687266, 24355933.796114106,
        -26185633.01902049},
       {-0.10709539294542297, 0.10087788396183175, -0.98911790466923033},
       0.26996916311289498,
       6.3106904378807924e-10,
       5.6900027283714412,
       {18.591481857022764, -19.988136210868511, -5.9035051875116951},
       5.6900027283714412,
       17},
      // symmetric about the rotor's axis
      {{250493.22208037876, 259393.6628717196, 143361.49694528535, 71541.06952955715, 118116.90595329273,
        -110997.73497486205},
       {0.48278670782082933, -0.45368806955774049, -0.7490554921315884},
       0.0014075826962727208,
       1.5270870040515563e-10,
       109.49268155396264,
       {-0.141053212455233, 0.13254534666842424, 0.21884087119255388},
       -32.882679799210635,
       137},
      // hardly more about the axis than the rotor has
      {{0.0047737634437182777, 0.0048777629391730621, 0.0050835042362732249, -5.4634582278778205e-05,
        8.8342784337409368e-05, -0.00020604396508557539},
       {-0.21999378447449419, 0.51309805858093227, -0.82965843397935046},
       0.0052343411820249541,
       9.5862410636161845e-13,
       57.000366147561571,
       {12.539693744822287, -29.246715836257007, 47.290697656552418},
       57.000366147561571,
       6.831380665276509e-07},
  };
  for (const Slim& slim : bodies) {
    const double(&J)[6] = slim.theta;
    Mat3<double> theta;
    theta << J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2];
    const auto body = Gyrostat<double>::make(theta, slim.axis, slim.lambda, slim.slope, slim.target);
    REQUIRE(body);
    for (const double tolerance : {1e-3, 1e-8})
      for (const int count : {1, 8}) {
        Asked data;
        data.tolerance = tolerance;
        data.angular_velocity = slim.Omega;
        data.rotor_rate = slim.rate;
        for (int i = 1; i <= count; ++i) data.times.push_back(slim.span * i / count);
        const Solved made = solved(*body, data);
        REQUIRE(made.refusal.code == Errc::ok);
        check_honest(*body, data, made.answer);
      }
  }
}
