// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/full_rung.hpp"

#include <cstring>

#include "catch.hpp"

#include "at_length.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "honest.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

/// In axes turned by R.
Scene scene(const Mat3<double>& R, const State<double>& start, std::vector<double> times, bool attitude = false,
            double tolerance = 1e-8) {
  const Vec3<double> moments{1, 1.5, 2}, centre{0.01, -0.02, 0.015};
  const auto body = Body::make(R * moments.asDiagonal() * R.transpose(), 1, R * centre, 98, 0.3);
  REQUIRE(body);
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  question.wants_attitude = attitude;
  const auto made = Scene::make(*body, {in_axes(R, start)}, question);
  REQUIRE(made);
  return *made;
}

Track stand_in(const Scene&, Monitor*) {
  Track track;
  static constexpr WarningKind kind{"stand-in", ""};
  track.warn(kind);
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

TEST_CASE("rung full of a heavy body hands over to the integrator of the scene", "[heavy]") {
  Question question;
  question.times = {0, 1};
  const auto made = Scene::make({}, {}, question);
  REQUIRE(made);
  Scene brought = *made;
  brought.full_equations = &stand_in;
  const Track track = full_track(brought, nullptr);
  REQUIRE(track.warnings.size() == 1);
  CHECK(track.warnings[0].code() == "stand-in");
}

TEST_CASE("rung full of a periodic motion is honest where families come near and near the vertical",
          "[heavy][length]") {
  // a slow top whose centre lies 1e-4 off its axis: two families pass each other
  const auto near_top = *Problem<double>::make(
      {0.77520005340819609, 0.7749767866487971, 1.0315288305282593}, 0.40390434700321659,
      {8.4395990284069422e-05, 4.6693742053867553e-05, 0.41130677508657837}, 1.3053467299344408, 0);
  // axis 3 within 0.13 degrees of the vertical, precessing by 4e-7 rad a turn
  const auto upright = *Problem<double>::make({2.1285638809204102, 2.1285638809204102, 1.0642819404602051},
                                              0.22633466665973195, {-0.47771089604610772, -0.90096920838653727, 0},
                                              4.5051586829505723, 0.00041575568821916641);
  for (const double tolerance : {1e-9, 1e-3}) {
    if (tolerance == 1e-3 && !at_length()) break;
    for (const auto& scene :
         {periodic(near_top, -0.1940934011953416, 0.48583690324930551, 3, tolerance, rung::full),
          periodic(upright, 38.109852269815164, -0.99999727537266692, 7.5, tolerance, rung::full)}) {
      const Track track = full_track(scene, nullptr);
      REQUIRE(track.failure == Errc::ok);
      check_honest(scene, track);
    }
  }
}

TEST_CASE("rung full is honest at a loose tolerance, from rest", "[heavy]") {
  const auto p =
      *Problem<double>::make({1.1296526789665222, 0.61936593055725098, 0.63604569435119629}, 0.11726966428099141,
                             {-0.51671432332885225, 0.90478946655276959, 0}, 0.86163035473929594, 0);
  State<double> start;
  start.attitude =
      normalised(Quat<double>{0.72887262876882608, -0.50180520495023662, 0.066112307737259471, 0.46104814291148161});
  start.down = rotate<double>(conjugate(start.attitude), {0, 0, -1});
  Question question;
  question.tolerance = 1e-3;
  question.wants_attitude = true;
  const auto scene = posed(p, start, 348.68713754060849, question, 13);
  check_honest(scene, full_track(scene, nullptr));
}
