// SPDX-License-Identifier: BSD-3-Clause
// Scenes of free bodies for the tests of the ladder, and answers held against a truth in double-double.
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "gyrostat/core/double_double.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/models/free/motion.hpp"

namespace free_scenes {

using namespace gyrostat;
using gyrostat::free::Assembly;
using gyrostat::free::Scene;

inline Scene posed(const Assembly<double>& assembly, std::vector<double> times, double tolerance = 1e-6,
                   int rung = any_rung) {
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  question.rung = rung;
  const auto scene = Scene::make(assembly, question);
  REQUIRE(scene);
  return *scene;
}

inline Assembly<double> body(const Vec3<double>& moments, const Vec3<double>& l, const Vec3<double>& w) {
  Assembly<double> made;
  made.body = free::Problem<double>::from_moments(moments, l, w, {0.5, 0.5, -0.5, 0.5});
  return made;
}

/// With a held wheel and a free one.
inline Assembly<double> wheeled() {
  auto made = body({3, 2.5, 2}, {0.1, 0, 0}, {0.3, -0.5, 0.8});
  made.wheels = {{{0, 0.6, 0.8}, 0.2, 5, false}, {{1, 0, 0}, 0.1, -9, true}};
  return made;
}

inline Answer solved(const Scene& scene) {
  gyrostat::Refusal refusal;
  const Answer answer = free::solve(scene, refusal);
  INFO(refusal.model << ": " << (refusal.why ? refusal.why : ""));
  REQUIRE(refusal.code == Errc::ok);
  return answer;
}

/// The quickest columns within their stated errors of the motion of the very data, and within the tolerance where the answer says so.
inline void check_honest(const Scene& scene, const Answer& answer) {
  const auto motion = free::Motion<DoubleDouble>::make<DoubleDouble>(scene.precise().problem);
  REQUIRE(motion);
  const auto &q = answer.find("attitude")->values, &w = answer.find("angular_velocity")->values;
  double off = 0, apart = 0, size = 0;
  for (std::size_t i = 0; i < answer.times.size(); ++i) {
    const auto truth = motion->at(answer.times[i]);
    const Quat<double> right{double(truth.attitude.w), double(truth.attitude.x), double(truth.attitude.y),
                             double(truth.attitude.z)};
    off = std::max(off, angle_between<double>({q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]}, right));
    const Vec3<double> rate = vector_cast<double>(truth.angular_velocity);
    apart = std::max(apart, (rate - Vec3<double>(w[3 * i], w[3 * i + 1], w[3 * i + 2])).norm());
    size = std::max(size, rate.norm());
  }
  CAPTURE(answer.model, off, apart / size);
  CHECK(off <= answer.find("attitude")->error);
  CHECK(apart <= answer.find("angular_velocity")->error * size);
  if (answer.met) CHECK(std::max(off, apart / size) <= answer.tolerance);
}

}  // namespace free_scenes
