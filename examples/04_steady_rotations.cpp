// SPDX-License-Identifier: BSD-3-Clause
// A satellite has fallen into a flat spin. Which steady rotations does it have with its wheel at speed, which are stable, and does spinning
// the wheel up recover it? No integration: algebra, and a proof where there is one.
#include <cmath>
#include <cstdio>

#include "gyrostat/rotor.hpp"

using namespace gyrostat;

int main() {
  // Intelsat V (scenes/intelsat-v-flat-spin.toml): the wheel along the axis of least inertia, missed by one degree.
  const Vec3<double> moments(3026, 440, 3164), axis = Vec3<double>(0.0122, 1, 0.0122).normalized();
  const auto body = rotor::Gyrostat<double>::make(moments.asDiagonal(), axis, 0.159, 3.2e-5, 574.8);
  if (!body) return std::puts(message(body.error())), 1;
  const auto start = body->state({}, {1e-4, 2e-4, 0.0289}, 0);  // about the axis of greatest inertia, the wheel at rest
  const double l = start.momentum.norm();

  const auto steady = rotor::steady_rotations(*body, l);
  const char* const types[] = {"minimum", "saddle", "maximum", "degenerate"};
  const auto from_wheel = [&](const Vec3<double>& m) {
    return std::atan2(m.cross(axis).norm(), m.dot(axis)) * 180 / pi<double>;
  };
  for (int i = 0; i < steady.count; ++i) {
    const auto stability = rotor::stability_of(*body, l, steady[i]);
    std::printf("%d: %-8s spins at %9.6f rad/s, wheel axis %6.2f deg from the momentum, decay rate %.3e /s\n", i,
                types[int(steady[i].type)], steady[i].spin_rate, from_wheel(steady[i].direction), stability.decay_rate);
  }
  const auto end = rotor::certify(*body, steady, start.momentum, start.axial_momentum);
  if (end.index < 0) return std::puts("where it goes is not decided yet"), 0;
  std::printf("it ends in rotation %d, %s\n", end.index,
              end.certificate == rotor::Certificate::by_level ? "for certain" : "but for starts of measure zero");
  std::printf("wheel axis in the end %.4f deg from the momentum\n", from_wheel(steady[end.index].direction));
}
