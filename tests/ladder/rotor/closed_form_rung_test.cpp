// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/closed_form_rung.hpp"

#include <string>

#include "../../models/rotor/bodies.hpp"
#include "../../models/rotor/long_motion.hpp"
#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using V = Vec3<double>;

Gyrostat<double> body(const Mat3<double>& theta, const V& e, double lambda, double slope, double target) {
  const auto made = Gyrostat<double>::make((theta + theta.transpose()) / 2, e, lambda, slope, target);
  REQUIRE(made);
  return *made;
}

Asked asked_of(const V& Omega, double omega, double last) {
  Asked data;
  data.attitude = normalised(Quat<double>{.5, -.3, .2, .7});
  data.angular_velocity = Omega;
  data.rotor_rate = omega;
  for (int i = 0; i <= 10; ++i) data.times.push_back(last * i / 10);
  return data;
}

Track run(const Gyrostat<double>& gyrostat, const Asked& data) {
  const auto scene = make_scene(gyrostat, data);
  REQUIRE(scene);
  return closed_form_track(*scene, nullptr);
}

void check_closed(const Gyrostat<double>& gyrostat, const Asked& data, const Track& track) {
  const auto truth =
      LongMotion::from(gyrostat, normalised(data.attitude), data.angular_velocity, data.rotor_rate, data.times);
  Comparison seen{Row<double>(gyrostat)};
  for (std::size_t i = 0; i < truth.size(); ++i) seen.add(track.states[i], truth[i]);
  const auto found = seen.relative(seen.difference());
  CHECK(found[column::attitude] <= track.error[column::attitude]);
  CHECK(found[column::angular_velocity] <= track.error[column::angular_velocity]);
  CHECK(
      (found[column::angular_momentum] <= track.error[column::angular_momentum] || track.states[0].momentum.isZero(0)));
  CHECK(found[column::rotor_rate] <= track.error[column::rotor_rate]);
  CHECK(found[column::rotor_angle] <= track.error[column::rotor_angle]);
  CHECK(found[column::lyapunov] <= track.error[column::lyapunov]);
}

}  // namespace

TEST_CASE("closed-form rung: spin-up from rest, a symmetric body, and errors that hold", "[rotor]") {
  const auto from_rest = reference_body(0.05, 30);
  auto data = asked_of(V(0, 0, 0), 0, 100);
  Track track = run(from_rest, data);
  CHECK(track.failure == Errc::ok);
  CHECK(track.in_domain);
  CHECK(track.error[column::angular_momentum] == 0);
  CHECK(track.error.greatest() < 1e-11);
  check_closed(from_rest, data, track);

  const Mat3<double> symmetric = V(4, 4, 5.5).asDiagonal();
  const auto precessing = body(symmetric, V(0, 0, 1), .6, .5, 12);
  data = asked_of(V(.9, -.4, .7), 1.5, 60);
  track = run(precessing, data);
  CHECK(track.error.greatest() < 1e-11);
  check_closed(precessing, data, track);
}

TEST_CASE("closed-form rung: near symmetry the errors cover the departure", "[rotor]") {
  Bodies bodies(5);
  for (const double off : {1e-12, 1e-10, 1e-8, 1e-7}) {
    Mat3<double> theta = V(4, 4, 5.5).asDiagonal();
    theta(0, 1) = theta(1, 0) = off;
    const auto almost = body(theta, V(0, 0, 1), .6, .5, 12);
    const auto data = asked_of(V(.9, -.4, .7), 1.5, 60);
    const Track track = run(almost, data);
    CHECK(track.failure == Errc::ok);
    CHECK(track.error.greatest() > off);
    CHECK(track.error.greatest() < 1e5 * off);
    check_closed(almost, data, track);
  }
}

TEST_CASE("closed-form rung: says where there is none", "[rotor]") {
  Bodies bodies(6);
  const Track track = run(bodies.realisable(), asked_of(V(1, 2, 3), 0, 10));
  CHECK(track.failure == Errc::not_applicable);
  CHECK(std::string(track.refusal).find("no closed form") != std::string::npos);
}

TEST_CASE("closed-form rung: on an unstable rotation for too long it is out of its domain", "[rotor]") {
  const Mat3<double> R = to_matrix(normalised(Quat<double>{1, .3, -.2, .5}));
  const Mat3<double> theta = R * V(3, 4, 5).asDiagonal() * R.transpose();
  const auto middle = body(theta, R.col(1), .3, .5, 3);
  const V Omega = R.col(1) * 2;
  const Track brief = run(middle, asked_of(Omega, 3, 20)), late = run(middle, asked_of(Omega, 3, 400));
  CHECK(brief.in_domain);
  CHECK(brief.error.greatest() < 1e-6);
  CHECK(late.failure == Errc::ok);
  CHECK_FALSE(late.in_domain);
  CHECK(late.warnings.size() == 1);
  CHECK(late.error[column::attitude] == pi<double>);
}
