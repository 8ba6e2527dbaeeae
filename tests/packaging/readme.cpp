// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "gyrostat/rotor.hpp"

int main() {
  using namespace gyrostat;
  const auto fail = [](const char* why) { return std::puts(why), 1; };

  // Inertia in kg m^2; the wheel's axis and its inertia about it; its motor: slope in N m s/rad and no-load rate in rad/s.
  const Vec3<double> moments(86, 118, 141), axis = Vec3<double>(1, 0.05, 0.04).normalized();
  const auto body = rotor::Gyrostat<double>::make(moments.asDiagonal(), axis, 0.28, 0.13, 60);
  if (!body) return fail(message(body.error()));  // every construction says why it failed

  rotor::Start start;
  start.angular_velocity = {0, 0.01, 0.1};  // turning about the axis of greatest inertia, the wheel at rest
  Question question;
  question.times = {60, 600, 3600};  // s
  question.tolerance = 1e-6;
  const auto scene = rotor::Scene::make(*body, start, question);
  if (!scene) return fail(message(scene.error()));

  Refusal refusal;
  const Answer answer = rotor::solve(*scene, refusal);
  if (refusal.code != Errc::ok) return fail(refusal.why);
  std::printf("rung %s, estimated error %.1e, tolerance %s\n", answer.model, answer.error, answer.met ? "met" : "not met");
  const Column& rate = *answer.find("rotor_rate");
  for (std::size_t i = 0; i < answer.times.size(); ++i)
    std::printf("t = %4.0f s: wheel at %.4f rad/s\n", answer.times[i], rate.values[i]);
}
