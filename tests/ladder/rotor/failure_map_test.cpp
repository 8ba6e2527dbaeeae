// SPDX-License-Identifier: BSD-3-Clause
// The failure map of docs/rotor.md, section 9, row by row: a right answer with an honest error, or a refusal.
#include <array>
#include <cmath>
#include <cstring>

#include "../../models/rotor/bodies.hpp"
#include "../column_error.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/assembly.hpp"
#include "gyrostat/models/rotor/attractor.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"
#include "truth.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

bool warns(const Answer& answer, const char* code) {
  for (const Warning& w : answer.warnings)
    if (w.code() == code) return true;
  return false;
}

double value_of(const Answer& answer, const char* name) {
  for (const Quantity& q : answer.quantities)
    if (q.name() == name) return q.values[0];
  return infinity<double>;
}

/// The answer, seen to be within its stated errors, and within the tolerance where it says so.
Answer honest(const Gyrostat<double>& body, const Asked& data, Integrator truth_by = Integrator::taylor) {
  const auto scene = make_scene(body, data);
  REQUIRE(scene);
  Refusal refusal;
  const Answer answer = rotor::solve(*scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  Answer truth;
  REQUIRE(true_motion(*scene, truth, truth_by));
  for (const Column& column : answer.columns) {
    const double error = column_error(column, *truth.find(column.name())) - truth.find(column.name())->error;
    CAPTURE(answer.model, column.kind->name, error, column.error);
    CHECK(error <= column.error);
    if (answer.met) CHECK(error <= data.tolerance);
  }
  return answer;
}

/// Principal axes are body axes, the rotor on one of them.
Gyrostat<double> on_axis(int axis, double slope, double no_load_rate) {
  const Mat3<double> theta = Vec3<double>(3, 4, 5).asDiagonal();
  return Gyrostat<double>::make(theta, Vec3<double>::Unit(axis), 0.35, slope, no_load_rate).value();
}

}  // namespace

TEST_CASE("failure map: bodies that cannot be are refused, one that no matter has is warned of", "[rotor]") {
  const Mat3<double> theta = Vec3<double>(3, 5, 7).asDiagonal();
  const Vec3<double> e(0.5, 0.5, std::sqrt(0.5));
  CHECK(Gyrostat<double>::make(-theta, e, 1, 1, 1).error() == Errc::not_positive);
  CHECK(Gyrostat<double>::make(theta, e, 5, 1, 1).error() == Errc::triangle_inequality);  // k <= 0
  CHECK(Gyrostat<double>::make(theta, e, 1, -1, 1).error() == Errc::negative);
  CHECK(Gyrostat<double>::make(theta, 2 * e, 1, 1, 1).error() == Errc::out_of_domain);
  CHECK(Gyrostat<double>::make(theta, Vec3<double>(0, 0, 0), 1, 1, 1).error() == Errc::zero_vector);

  const auto body = Gyrostat<double>::make(theta, e, 2, 4, 1);
  REQUIRE(body);
  Asked data = asked(5, 1e-8);
  data.angular_velocity = {0.1, 0.2, 1};
  CHECK(warns(honest(*body, data), "not-realisable"));
  CHECK_FALSE(warns(honest(reference_body(0.2, 3), data), "not-realisable"));
}

TEST_CASE("failure map: momentum far smaller than the wheel's keeps all digits", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const double wheel = 0.35 * 20;
  for (const double ratio : {1e-4, 1e-8, 1e-12, 1e-15, 0.0}) {
    Asked data = asked(60, 1e-8);
    start(data, body, ratio * wheel * Vec3<double>(0.6, -0.48, 0.64), 20);
    const Answer answer = honest(body, data);
    CAPTURE(ratio, answer.model);
    CHECK(answer.find("attitude")->error < 1e-8);
  }
}

TEST_CASE("failure map: a motor of any stiffness is followed at the same price", "[rotor]") {
  Asked data = asked(20, 1e-9);
  data.angular_velocity = {0.7, -1, 0.6};
  std::uint64_t soft = 0;
  for (const double slope : {3.0, 30.0, 300.0, 3e3, 3e4, 3e6}) {
    const auto body = reference_body(slope, 5);
    Answer answer;
    if (slope < 1e3) {
      answer = honest(body, data);
    } else {
      Refusal refusal;
      answer = rotor::solve(*make_scene(body, data), refusal);
      REQUIRE(refusal.code == Errc::ok);
    }
    CAPTURE(slope, answer.counts.steps);
    CHECK(answer.met);
    if (soft == 0) soft = answer.counts.steps;
    CHECK(answer.counts.steps < 6 * soft + 400);
  }
}

TEST_CASE("failure map: on a principal axis the nutation dies out at no exponential rate", "[rotor]") {
  for (int axis = 0; axis < 3; ++axis) {
    const auto body = on_axis(axis, 0.3, 4);
    Asked data = asked(40, 1e-8);
    start(data, body, 8 * (Vec3<double>::Unit(axis) + Vec3<double>(0.2, 0.15, -0.1)).normalized(), 4);
    const Answer answer = honest(body, data);
    const auto steady = steady_rotations(body, 8.0);
    for (const auto& rotation : steady) {
      if (std::abs(rotation.direction[axis]) < 1 - 1e-12) continue;
      const auto stability = stability_of(body, 8.0, rotation);
      CAPTURE(axis, rotation.spin_rate);
      if (rotation.type == SteadyType::minimum) {
        CHECK(stability.verdict == Verdict::marginal);
        CHECK(std::isnan(stability.decay_rate));
      } else if (rotation.type == SteadyType::saddle) {
        CHECK(stability.verdict == Verdict::unstable);
      }
    }
  }
}

TEST_CASE("failure map: a body symmetric about the rotor has no attractor", "[rotor]") {
  const Mat3<double> theta = Vec3<double>(4, 4, 5).asDiagonal();
  const auto body = Gyrostat<double>::make(theta, Vec3<double>::UnitZ(), 0.5, 0.2, 6).value();
  Asked data = asked(100, 1e-8);
  data.angular_velocity = {0.4, 0.3, 1};
  const Answer answer = honest(body, data);
  CHECK(std::strcmp(answer.model, "closed-form") == 0);
  CHECK(std::isnan(value_of(answer, "attractor")));
  CHECK(warns(answer, "no-attractor"));
}

TEST_CASE("failure map: a start on a saddle is not certified, and its error grows", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  const auto steady = steady_rotations(body, 8.0);
  for (const auto& rotation : steady) {
    if (rotation.type == SteadyType::minimum) continue;
    for (const double span : {5.0, 400.0}) {
      Asked data = asked(span, 1e-8);
      start(data, body, 8 * rotation.direction, 3);
      const auto scene = make_scene(body, data);
      Refusal refusal;
      const Answer answer = rotor::solve(*scene, refusal);
      CAPTURE(int(rotation.type), span, answer.model, answer.error);
      if (refusal.code != Errc::ok) continue;
      Answer truth;
      REQUIRE(true_motion(*scene, truth));
      for (const Column& column : answer.columns) {
        const double error = column_error(column, *truth.find(column.name())) - truth.find(column.name())->error;
        CAPTURE(column.kind->name);
        CHECK(error <= column.error);
      }
      if (span < 10) CHECK(std::isnan(value_of(answer, "attractor")));
    }
  }
}

TEST_CASE("failure map: between two attractors the margin is reported", "[rotor]") {
  const auto body = reference_body(2e-4, 3);
  Asked data = asked(30, 1e-8);
  start(data, body, 8 * Vec3<double>(0.5, -0.7, 0.45).normalized(), 3);
  const Answer answer = honest(body, data);
  CHECK(std::isnan(value_of(answer, "attractor")));
  REQUIRE(warns(answer, "attractor-undecided"));
  for (const Warning& w : answer.warnings)
    if (w.code() == "attractor-undecided") {
      const auto steady = steady_rotations(body, 8.0);
      const double saddle = steady[steady.lowest(SteadyType::saddle)].level;
      CHECK(w.value == Approx(answer.find("lyapunov")->values.back() - saddle).epsilon(1e-6));
    }
}

TEST_CASE("failure map: without a slope nothing is dissipated and nothing attracts", "[rotor]") {
  const auto body = reference_body(0, 3);
  Asked data = asked(40, 1e-8);
  data.angular_velocity = {0.4, -1.1, 0.7};
  data.rotor_rate = 5;
  const Answer answer = honest(body, data);
  CHECK(std::isnan(value_of(answer, "attractor")));
  CHECK(warns(answer, "no-motor"));
}

TEST_CASE("failure map: the frame in space has no singular attitude", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  Asked data = asked(20, 1e-10);
  data.angular_velocity = {0.4, -1.1, 0.7};
  const Answer plain = honest(body, data);
  for (const Quat<double>& q :
       {Quat<double>{0, 1, 0, 0}, Quat<double>{0, 0, 0.6, 0.8}, Quat<double>{0.5, 0.5, 0.5, 0.5}}) {
    data.attitude = q;
    const Answer turned = honest(body, data);
    const auto &a = plain.find("attitude")->values, &b = turned.find("attitude")->values;
    for (std::size_t i = 0; i < a.size(); i += 4)
      CHECK(angle_between(q * Quat<double>{a[i + 3], a[i], a[i + 1], a[i + 2]},
                          Quat<double>{b[i + 3], b[i], b[i + 1], b[i + 2]}) < 1e-9);
  }
}

TEST_CASE("failure map: a rotor angle that runs away does not spoil the attitude", "[rotor]") {
  const Mat3<double> theta = Vec3<double>(3, 4, 5).asDiagonal();
  // a light fast wheel: 1e7 rad in the span, h of the order of l
  const auto body = Gyrostat<double>::make(theta, Vec3<double>(0.36, 0.48, 0.8), 1e-6, 1e-7, 2e5).value();
  Asked data = asked(50, 1e-9);
  start(data, body, Vec3<double>(1, -2, 2), 2e5);
  const Answer answer = honest(body, data);
  CHECK(answer.find("rotor_angle")->values.back() > 9e6);
  CHECK(answer.met);
}

TEST_CASE("failure map: numbers that are none, times that do not grow and endless work are refused", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  const auto failure = [&](auto change) {
    Asked data = asked(10, 1e-8);
    change(data);
    return make_scene(body, data).error();
  };
  CHECK(failure([](auto& d) { d.times = {gyrostat::nan<double>}; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.times = {-1}; }) == Errc::negative);
  CHECK(failure([](auto& d) { d.tolerance = gyrostat::nan<double>; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.angular_velocity[0] = infinity<double>; }) == Errc::not_finite);

  std::array<State<double>, 1> states;
  FullMotionOptions<double> options;
  options.step_cap = 1000;
  const double late[] = {1e9};
  const auto made = full_motion<double>(body, body.state({}, {1, 1, 1}, 0), late, states, options);
  REQUIRE(made);
  CHECK(made->status == ode::Status::step_limit);
  CHECK_FALSE(made->met);
}

TEST_CASE("failure map: a wheel at rest in a body that turns steadily is answered to any tolerance", "[rotor]") {
  const Mat3<double> theta = Vec3<double>(3026, 440, 3164).asDiagonal();
  for (const Vec3<double>& e : {Vec3<double>(0, 1, 0), Vec3<double>(0, 0.6, 0.8)}) {
    const auto body = Gyrostat<double>::make(theta, e, 0.1, 0, 0).value();
    for (const double tolerance : {1e-4, 1e-8}) {
      Asked data = asked(3600, tolerance);
      data.angular_velocity = {0, 0, 0.0289};
      const Answer answer = honest(body, data);
      CAPTURE(answer.model, tolerance, answer.error, e[2]);
      CHECK(answer.met);
    }
  }
}

TEST_CASE("failure map: the row at zero is the start as given, whichever rung answers", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  Asked data = asked(0.1, 1e-3);
  data.attitude = {0.1, 0.2, -0.3, std::sqrt(1 - 0.14)};
  data.angular_velocity = {0.1, 0.2, 1.0 / 3};
  data.rotor_rate = 0.7;
  const Answer answer = honest(body, data);
  const auto& q = answer.find("attitude")->values;
  CHECK(std::vector<double>(q.begin(), q.begin() + 4) == std::vector<double>{0.2, -0.3, std::sqrt(1 - 0.14), 0.1});
  const auto& Omega = answer.find("angular_velocity")->values;
  CHECK(std::vector<double>(Omega.begin(), Omega.begin() + 3) == std::vector<double>{0.1, 0.2, 1.0 / 3});
  CHECK(answer.find("rotor_rate")->values[0] == 0.7);
}

TEST_CASE("failure map: a span whose phase no double holds is refused at once, with the reason", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  Asked data = asked(1e13, 1e-6);
  data.angular_velocity = {0.4, -1.1, 0.7};
  data.rung = rung::full;
  Refusal refusal;
  rotor::solve(*make_scene(body, data), refusal);
  CHECK(refusal.code == Errc::step_limit);
  CHECK(refusal.why == std::string_view(phase_lost));
}
