// SPDX-License-Identifier: BSD-3-Clause
// A satellite spins up its wheel: where is the wheel after a minute, ten minutes, an hour?
#include <cstdio>

#include "gyrostat/rotor.hpp"

using namespace gyrostat;

int main() {
  // Inertia in kg m^2; the wheel's axis and its inertia about it; its motor: slope in N m s/rad and no-load rate in rad/s.
  const Vec3<double> moments(86, 118, 141), axis = Vec3<double>(1, 0.05, 0.04).normalized();
  const auto body = rotor::Gyrostat<double>::make(moments.asDiagonal(), axis, 0.28, 0.13, 60);
  if (!body) return std::puts(message(body.error())), 1;  // what is built says why it cannot be

  rotor::Start start;
  start.angular_velocity = {0, 0.01, 0.1};  // rad/s: about the axis of greatest inertia, the wheel at rest
  Question question;
  question.times = {60, 600, 3600};  // s
  question.tolerance = 1e-6;         // greatest relative error wanted in any column
  const auto scene = rotor::Scene::make(*body, start, question);
  if (!scene) return std::puts(message(scene.error())), 1;

  // The ladder: the cheapest rung whose own error estimate meets the tolerance answers.
  Refusal refusal;
  const Answer answer = rotor::solve(*scene, refusal);
  if (refusal.code != Errc::ok) return std::puts(refusal.why), 1;

  for (const Attempt& tried : answer.tried)
    std::printf("%-12s %s%s\n", tried.model, tried.accepted ? "answered" : "passed over: ", tried.why ? tried.why : "");
  const Column& rate = *answer.find("rotor_rate");
  std::printf("estimated error of the wheel's rate %.1e, tolerance %s\n", rate.error, answer.met ? "met" : "not met");
  for (std::size_t i = 0; i < answer.times.size(); ++i)
    std::printf("t = %.0f s: wheel at %.6f rad/s\n", answer.times[i], rate.values[i]);
}
