// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/full_rung.hpp"

#include <cstring>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

const Vec3<double> moments{1, 1.5, 2}, centre{0.01, -0.02, 0.015};

/// In axes turned by R.
Scene scene(const Mat3<double>& R, const State<double>& start, std::vector<double> times, bool attitude = false,
            double tolerance = 1e-8) {
  const auto body = Body::make(R * moments.asDiagonal() * R.transpose(), 1, R * centre, 98, 0.3);
  REQUIRE(body);
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  question.wants_attitude = attitude;
  const auto made = Scene::make(*body, in_axes(R, start), question);
  REQUIRE(made);
  return *made;
}

Track stand_in(const Scene&, Monitor*) {
  Track track;
  track.warn("stand-in", "");
  return track;
}

}  // namespace

TEST_CASE("rung full of a heavy body answers in the caller's axes", "[heavy]") {
  Tops random(1);
  const auto start = random.start(2);
  const Mat3<double> one = Mat3<double>::Identity(), R = to_matrix(quaternion_from_vector<double>({0.2, -0.3, 0.1}));
  Answer straight, turned;
  Monitor monitor;
  for (const bool plain : {true, false}) {
    const Scene s = scene(plain ? one : R, start, {0, 1, 5}, true);
    const Track track = full_track(s, &monitor);
    REQUIRE(track.failure == Errc::ok);
    CHECK(track.error.greatest() <= 1e-8);
    CHECK(track.counts.steps > 0);
    fill(plain ? straight : turned, s, track);
  }
  CHECK(monitor.fraction == 1);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto vector = [&](const Answer& answer, const char* name) {
      const double* v = &answer.find(name)->values[3 * k];
      return Vec3<double>(v[0], v[1], v[2]);
    };
    CHECK((R * vector(straight, "angular_velocity") - vector(turned, "angular_velocity")).norm() < 1e-8);
    CHECK((R * vector(straight, "down") - vector(turned, "down")).norm() < 1e-8);
    const double *a = &straight.find("attitude")->values[4 * k], *b = &turned.find("attitude")->values[4 * k];
    const Mat3<double> P = to_matrix(Quat<double>{a[3], a[0], a[1], a[2]}),
                       Q = to_matrix(Quat<double>{b[3], b[0], b[1], b[2]});
    CHECK((P * R.transpose() - Q).norm() < 1e-8);
  }
}

TEST_CASE("rung full of a heavy body says why it stops", "[heavy]") {
  Tops random(2);
  Monitor monitor;
  monitor.cancel = true;
  CHECK(full_track(scene(Mat3<double>::Identity(), random.start(), {0, 500}), &monitor).failure == Errc::cancelled);
}

TEST_CASE("rung full of a heavy body hands over to the integrator of the question", "[heavy]") {
  Question question;
  question.times = {0, 1};
  question.full_equations = &stand_in;
  const auto made = Scene::make({}, {}, question);
  REQUIRE(made);
  const Track track = full_track(*made, nullptr);
  REQUIRE(track.warnings.size() == 1);
  CHECK(std::strcmp(track.warnings[0].code, "stand-in") == 0);
}
