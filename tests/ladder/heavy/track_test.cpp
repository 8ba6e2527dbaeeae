// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/track.hpp"

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Answer answer_of(const Body& body, const Track& track, bool attitude) {
  Question question;
  question.times = {0, 1};
  question.wants_attitude = attitude;
  const auto scene = Scene::make(body, {}, question);
  REQUIRE(scene);
  Answer answer;
  fill(answer, *scene, track);
  judge(answer, scene->question(), tables);
  tell(answer, track.periodicity);
  return answer;
}

}  // namespace

TEST_CASE("a heavy track becomes the columns of the contract, in the caller's axes", "[heavy]") {
  const Mat3<double> R = to_matrix(quaternion_from_vector<double>({0.2, -0.3, 0.1}));
  const auto body = Body::make(R * Vec3<double>(1, 1.5, 2).asDiagonal() * R.transpose(), 1, {0, 0, 0}, 9.8, 0);
  REQUIRE(body);
  Track track;
  const State<double> state{{1, 2, 3}, {0.6, 0, 0.8}, normalised(Quat<double>{0.5, 0.5, -0.5, 0.1})};
  track.states = {state, state};
  track.error = {1e-3, 1e-2, 1e-1};
  const Answer with = answer_of(*body, track, true), without = answer_of(*body, track, false);
  REQUIRE(with.columns.size() == 3);
  REQUIRE(without.columns.size() == 2);
  CHECK(with.error == 1e-1);
  CHECK(without.error == 1e-2);
  const auto vector = [&](const char* name) {
    const Column* c = with.find(name);
    REQUIRE(c);
    return Vec3<double>(c->values[3], c->values[4], c->values[5]);
  };
  CHECK((vector("angular_velocity") - R * state.angular_velocity).norm() < 1e-14);
  CHECK((vector("down") - R * state.down).norm() < 1e-15);
  const auto& q = with.find("attitude")->values;
  REQUIRE(q.size() == 8);
  CHECK((to_matrix(Quat<double>{q[7], q[4], q[5], q[6]}) * R - to_matrix(state.attitude)).norm() < 1e-14);
}

TEST_CASE("a heavy track states of its period what it knows", "[heavy]") {
  Track track;
  track.states = {State<double>{}, State<double>{}};
  CHECK(answer_of({}, track, false).quantities.empty());
  track.periodicity = {0.04, 1e-9, -1.9, 1e-8, 0.3, 1e-4};
  Answer answer = answer_of({}, track, false);
  REQUIRE(answer.quantity("period"));
  CHECK(answer.quantity("period")->values[0] == 0.04);
  CHECK(answer.quantity("floquet_trace")->values[0] == -1.9);
  CHECK(answer.quantity("stable")->values[0] == 1);
  CHECK(answer.quantity("precession_rate")->error == 1e-4);
  track.periodicity.trace = 2.1;
  CHECK(answer_of({}, track, false).quantity("stable")->values[0] == 0);
  track.periodicity.trace = -2 + 1e-8;
  answer = answer_of({}, track, false);
  CHECK(!answer.quantity("stable"));
  CHECK(answer.quantity("floquet_trace"));
  track.periodicity.stable = 0;
  REQUIRE(answer_of({}, track, false).quantity("stable"));
  CHECK(answer_of({}, track, false).quantity("stable")->values[0] == 0);
}
