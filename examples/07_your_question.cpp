// SPDX-License-Identifier: BSD-3-Clause
// Ask for what matters, as well as it matters: half a degree of attitude and the wheel's rate within 0.01 rad/s, nothing else. What is not
// asked for costs nothing.
#include <cstdio>

#include "gyrostat/rotor.hpp"

using namespace gyrostat;

int main() {
  const Vec3<double> moments(86, 118, 141), axis = Vec3<double>(1, 0.05, 0.04).normalized();
  const auto body = rotor::Gyrostat<double>::make(moments.asDiagonal(), axis, 0.28, 0.13, 60);
  if (!body) return std::puts(message(body.error())), 1;
  rotor::Start start;
  start.angular_velocity = {0, 0.01, 0.1};

  constexpr double degree = pi<double> / 180;
  Question question;
  question.times = {600};
  // place in the table, whether it is a scalar, the tolerance, and whether that is in the unit of the column (else relative)
  question.asked = {{rotor::column::attitude, false, 0.5 * degree}, {rotor::column::rotor_rate, false, 0.01, true}};
  const auto scene = rotor::Scene::make(*body, start, question);
  if (!scene) return std::puts(message(scene.error())), 1;

  Refusal refusal;
  const Answer answer = rotor::solve(*scene, refusal);
  if (refusal.code != Errc::ok) return std::puts(refusal.why), 1;
  for (const Column& column : answer.columns)
    std::printf("%s: estimated error %.1e, wanted %.1e\n", column.name().data(), column.error, column.tolerance);
  std::printf("rung %s, greatest error %.2e of what was allowed\n", answer.model, answer.excess);
}
