// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/track.hpp"

#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

Scene scene_of(V moments, int model = any_rung, double tolerance = 1e-6) {
  Asked d;
  d.control = V(1, 1, 1);
  d.momentum = V(1, 2, 3);
  d.times = {1, 2};
  d.rung = model;
  d.tolerance = tolerance;
  return *make_scene(*Inertia<double>::from_moments(moments[0], moments[1], moments[2]), d);
}

Track track_of(const Scene& scene) {
  Track t;
  const V first(3, 4, 0), second(0, 0, 1);
  t.states = {{first, 5, scene.problem().energy(first), .5, Regime::about_largest},
              {second, 1, scene.problem().energy(second), .4, Regime::about_smallest}};
  t.error[column::angular_momentum_norm] = 1e-6;
  t.error[column::energy] = 1e-8;
  t.error[column::modulus_squared] = 1e-4;
  t.know_momentum(scene.problem(), 1e-5);
  return t;
}

}  // namespace

TEST_CASE("columns come in the caller's axes with relative errors", "[deceleration]") {
  const Scene scene = scene_of(V(.7, 1.4, 1), rung::full);  // the caller's order is C, A, B
  const Track track = track_of(scene);
  Answer answer;
  fill(answer, scene, track);
  judge(answer, scene.question(), tables);
  REQUIRE(answer.columns.size() == 6);
  const Column& M = *answer.find("angular_momentum");
  const Column& w = *answer.find("angular_velocity");
  for (std::size_t row = 0; row < 2; ++row) {
    const Eigen::Map<const V> M_B(&M.values[3 * row]), w_B(&w.values[3 * row]);
    CHECK((M_B - scene.R_BP() * track.states[row].momentum).norm() == 0);
    CHECK((V(.7, 1.4, 1).cwiseProduct(w_B) - M_B).norm() < 1e-15);
  }
  CHECK(M.error == Approx(1e-5 / 5));
  CHECK(answer.find("angular_momentum_norm")->error == Approx(1e-6 / 5));
  CHECK(answer.find("energy")->error == Approx(1e-8 / std::max(track.states[0].energy, track.states[1].energy)));
  CHECK(answer.find("modulus_squared")->error == 1e-4);
  CHECK(answer.find("regime")->values[1] == double(Regime::about_smallest));
  CHECK(std::isnan(answer.find("regime")->error));
  CHECK(answer.error == 1e-4);
  CHECK(answer.times == scene.question().times);
}

TEST_CASE("the stop time counts among the errors", "[deceleration]") {
  const Scene scene = scene_of(V(1.4, 1, .7));
  Track track = track_of(scene);
  Answer answer;
  fill(answer, scene, track);
  judge(answer, scene.question(), tables);
  CHECK(answer.quantities.empty());
  track.stop_time = 7;
  track.stop_error = 1e-2;
  Answer with;
  fill(with, scene, track);
  judge(with, scene.question(), tables);
  CHECK(with.error == 1e-2);
  REQUIRE(with.quantities.size() == 1);
  CHECK(with.quantities[0].values[0] == 7);
}

TEST_CASE("an attitude of principal axes becomes one of body axes", "[deceleration]") {
  const Scene scene = scene_of(V(.7, 1.4, 1), rung::full);
  Track track = track_of(scene);
  const Quat<double> q_IP = normalised(Quat<double>{.9, .1, -.3, .2});
  for (auto& state : track.states) state.attitude = q_IP;
  track.knows_attitude = true;
  track.error[column::attitude] = 1e-3;
  Answer answer;
  fill(answer, scene, track);
  judge(answer, scene.question(), tables);
  const Column& q = *answer.find("attitude");
  CHECK(q.kind->width == 4);
  CHECK(q.error == 1e-3);
  const Quat<double> back{q.values[3], q.values[0], q.values[1], q.values[2]};  // scalar last
  const Quat<double> body = q_IP * conjugate(from_matrix(scene.R_BP()));
  CHECK(std::abs(back.w * body.w + back.x * body.x + back.y * body.y + back.z * body.z) == Approx(1).epsilon(1e-14));
}

TEST_CASE("a stop behind the times that misses the tolerance is left out, unless it is asked for", "[deceleration]") {
  const auto left = [](int model, double tolerance, bool asked, double stop) {
    Scene scene = scene_of(V(1.4, 1, .7), model, tolerance);
    Question question = scene.question();
    if (asked) question.asked = {{scalar::stop_time, true}};
    scene = scene.asked(question);
    Track track = track_of(scene);
    track.stop_time = stop;
    track.stop_error = 1e-5;
    withhold_stop(track, scene);
    CHECK(std::isnan(track.stop_time) != track.warnings.empty());
    return !std::isnan(track.stop_time);
  };
  CHECK(left(any_rung, 1e-3, false, 1e9));
  CHECK_FALSE(left(any_rung, 1e-7, false, 1e9));
  CHECK(left(any_rung, 1e-7, false, 1e-9));
  CHECK(left(any_rung, 1e-7, true, 1e9));
  CHECK(left(rung::averaged_2, 1e-7, false, 1e9));
}

TEST_CASE("a warning is given once", "[deceleration]") {
  Track track;
  track.warn(warning::not_slow, 1);
  track.warn(warning::not_slow, 2, "in other words");
  track.warn(warning::near_separatrix, 3);
  REQUIRE(track.warnings.size() == 2);
  CHECK(track.warnings[0].value == 1);
}

TEST_CASE("refusals carry their reason or their error", "[deceleration]") {
  const Track why = gyrostat::refused<Track>(Errc::separatrix, "why");
  CHECK(why.failure == Errc::separatrix);
  CHECK(why.refusal != nullptr);
  const Track over = over_tolerance<Track>(.1);
  CHECK(over.failure == Errc::not_applicable);
  CHECK(over.refusal == nullptr);
  CHECK(over.known_error == .1);
}

TEST_CASE("a NaN among the errors is the answer's error", "[deceleration]") {
  const Scene scene = scene_of(V(1.4, 1, .7));
  Track track = track_of(scene);
  track.error[column::energy] = gyrostat::nan<double>;
  Answer answer;
  fill(answer, scene, track);
  judge(answer, scene.question(), tables);
  CHECK_FALSE(answer.error <= 1);
}
