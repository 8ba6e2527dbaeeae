// SPDX-License-Identifier: BSD-3-Clause
// The drag on a tumbling body is known poorly. When does it stop: a thousand and one answers, each with an error of its own, and their
// percentiles?
#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

#include "gyrostat/deceleration.hpp"
#include "gyrostat/ladder/sweep.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

int main() {
  constexpr double none = gyrostat::nan<double>;
  // The scene as a row of numbers, in the order of deceleration::input_kinds; NaN: not given.
  const std::vector<double> numbers{
      35,    0,     0,     0,    22, 0, 0, 0, 16,  // inertia, kg m^2
      0,     0,     0,                             // momentum of rotors, N m s
      0.008, 0.008, 0.008, 2e-4,                   // control, N m; drag, 1/s
      0,     0,                                    // what these oppose: the total momentum
      none,  none,  none,  none,                   // attitude
      none,  none,  none,                          // angular velocity
      40,    25,    16.5,                          // angular momentum, N m s
  };
  constexpr std::size_t rows = 1001, drag_place = 15;
  std::vector<double> drag(rows);
  for (std::size_t i = 0; i < rows; ++i)
    drag[i] = 1e-4 + 2e-4 * double(i) / (rows - 1);  // 1/s: even, or drawn at random
  const Varied varied[] = {{drag_place, drag}};

  Question question;
  question.times = {1000};
  question.asked = {{scalar::stop_time, true, 1e-6}};
  std::vector<double> stop(rows), error(rows);
  std::vector<SweepRow> told(rows);
  const SweepTarget targets[] = {{scalar::stop_time, true, 1, stop, error}};
  sweep(
      tables, numbers, varied, [&](std::span<const double> row) { return scene_of(row, question); }, &solve<>, targets,
      told, std::thread::hardware_concurrency());

  const auto failed = std::count_if(told.begin(), told.end(), [](const SweepRow& row) { return !row.met; });
  const double worst = *std::max_element(error.begin(), error.end());
  std::sort(stop.begin(), stop.end());
  std::printf("rows over the tolerance: %d, greatest error %.1e\n", int(failed), worst);
  for (const int percent : {5, 50, 95})
    std::printf("stop time, %d %%: %.4f s\n", percent, stop[(rows - 1) * std::size_t(percent) / 100]);
}
