// SPDX-License-Identifier: BSD-3-Clause
// An unsymmetric top that spins fast: its periodic motion, the period, and whether what a small push does to it stays small.
#include <cmath>
#include <cstdio>

#include "gyrostat/heavy.hpp"

using namespace gyrostat;

int main() {
  // Moments about the tip, kg m^2; mass, kg; mass centre from the tip, m; gravity, m/s^2; no gravity gradient.
  const auto top = heavy::Problem<double>::make({0.0011, 0.0016, 0.0020}, 0.8, {0.012, 0.009, 0.010}, 9.80665, 0);
  if (!top) return std::puts(message(top.error())), 1;
  std::printf("pendulum rate %.3f rad/s: the spin is fast where it is well above\n", top->pendulum_rate());

  const char* const words[] = {"stable", "unstable", "undecided"};
  for (const double spin : {50., 100., 200., 400.}) {  // rad/s; axis 3 leans so that its cosine to down is 0.1
    const auto orbit = heavy::periodic_orbit<double>(*top, spin, 0.1);
    if (!orbit) {
      std::printf("spin %.0f rad/s: %s\n", spin, message(orbit.error()));
      continue;
    }
    std::printf("spin %.0f rad/s: period %.9f s, within %.0e; sum of the multipliers %.6f: %s\n", spin, orbit->period,
                orbit->error.period * orbit->period, orbit->trace_minus_4, words[int(orbit->stability)]);
    std::printf("  turns in a period at spin %.0f rad/s: %.6f\n", spin, orbit->period * spin / (2 * pi<double>));
  }
}
