// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "gyrostat/general.hpp"

int main() {
  using namespace gyrostat;
  general::Problem<double> body;
  body.inertia = Vec3<double>(0.7, 0.9, 1.1).asDiagonal();  // kg m^2
  body.angular_velocity = {0.02, -0.3, 0.05};               // rad/s

  // a switched rate damper: 4 mN m against each rate, full above 0.01 rad/s, off from 60 s to 80 s
  const auto damper = [](double t, const general::Seen<double>& seen) noexcept -> Vec3<double> {
    if (t >= 60 && t < 80) return {0, 0, 0};
    return -4e-3 * (seen.angular_velocity / 0.01).array().tanh().matrix();
  };
  Question question;
  question.times = {30, 60, 82};  // s
  const auto scene = general::Scene::make(body, question);
  if (!scene) return std::printf("%s: %s\n", message(scene.error()), general::check(body).why), 1;

  Refusal refusal;
  const Answer answer = general::solve(scene->driven_by(general::OwnTorque::of(damper, {60, 80})), refusal);
  if (refusal.code != Errc::ok) return std::puts(refusal.why), 1;
  const Column& rate = *answer.find("angular_velocity");
  for (std::size_t i = 0; i < answer.times.size(); ++i)
    std::printf("t = %2.0f s: %.6f rad/s about axis 2\n", answer.times[i], rate.values[3 * i + 1]);
  std::printf("stated error %.0e\n", rate.error);
}
