// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "gyrostat/deceleration.hpp"

int main() {
  using namespace gyrostat;
  const auto fail = [](const char* why) { return std::puts(why), 1; };

  const Vec3<double> moments(16403.01, 70915.56, 76392.38), rate(0.012, 0.008, 0.032);  // kg m^2, rad/s
  const auto body = Inertia<double>::from_moments(moments[0], moments[1], moments[2]);
  if (!body) return fail(message(body.error()));

  deceleration::Setup setup;
  setup.control = {0.06, 0.05, 0.04};  // N m
  setup.drag = 1.2e-6;                 // 1/s
  setup.momentum = moments.cwiseProduct(rate);
  Question question;
  question.times = {0, 20000, 40000};  // s
  question.tolerance = 1e-3;
  const auto scene = deceleration::Scene::make(*body, setup, question);
  if (!scene) return fail(message(scene.error()));

  Refusal refusal;
  const Answer answer = deceleration::solve(*scene, refusal);
  if (refusal.code != Errc::ok) return fail(refusal.why);
  for (const Attempt& each : answer.tried)
    std::printf("%-12s %s\n", each.model, each.accepted ? "answered" : "passed over");
  const Quantity& stop = *answer.quantity("stop_time");
  std::printf("it stops after %.1f h, give or take %.2f %%\n", stop.values[0] / 3600, 100 * stop.error);
}
