// SPDX-License-Identifier: BSD-3-Clause
// A satellite drifts with its wheel running and nothing acting on it. Which way does it face in a year, and how sure is that?
#include <cstdio>

#include "gyrostat/free.hpp"

using namespace gyrostat;

int main() {
  constexpr double year = 365.25 * 86400;  // s
  free::Assembly<double> satellite;
  satellite.body = free::Problem<double>::from_moments({35, 22, 16}, {0, 0, 0},
                                                       {0.004, 0.0055, 0.007});  // kg m^2, no other rotor, rad/s
  satellite.wheels.push_back({{0, 0, 1}, 0.02, 10, false});  // axis, kg m^2, rad/s; a motor holds its rate
  Question question;
  question.times = {1, year};
  question.asked = {{free::column::attitude}, {free::column::angular_momentum}};
  const auto scene = free::Scene::make(satellite, question);
  if (!scene) return std::puts(message(scene.error())), 1;

  Refusal refusal;
  const Answer answer = free::solve(*scene, refusal);
  if (refusal.code != Errc::ok) return std::puts(refusal.why), 1;
  const Column &attitude = *answer.find("attitude"), &momentum = *answer.find("angular_momentum");
  const double *x = &attitude.values[4], *m = &momentum.values[3];  // the rows of the second time
  std::printf("rung %s\n", answer.model);
  std::printf("attitude in a year [x, y, z, w]: %.9f %.9f %.9f %.9f, within %.1e rad\n", x[0], x[1], x[2], x[3],
              attitude.error);

  // Nothing acts, so the momentum must stand in space, wherever the body has turned: a check.
  const Vec3<double> before = scene->angular_momentum(),
                     after = rotate<double>({x[3], x[0], x[1], x[2]}, {m[0], m[1], m[2]});
  std::printf("the momentum has moved by %.1e rad in space\n", (after - before).norm() / before.norm());
}
