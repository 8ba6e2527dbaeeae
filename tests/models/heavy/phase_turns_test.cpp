// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/phase_turns.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

double greatest_error(const std::vector<double>& times, double rate) {
  using Turns = PhaseTurns<double>;
  const Turns turns(times, rate);
  double most = 0;
  for (std::size_t first = 0; first < times.size(); first += Turns::block) {
    double c[Turns::block], s[Turns::block];
    turns.write(first, c, s);
    for (std::size_t k = 0; k < Turns::block && first + k < times.size(); ++k) {
      const long double u = static_cast<long double>(rate) * times[first + k];
      const double size = 1 + std::abs(static_cast<double>(u));
      most = std::max(most, std::abs(c[k] - static_cast<double>(std::cos(u))) / size);
      most = std::max(most, std::abs(s[k] - static_cast<double>(std::sin(u))) / size);
    }
  }
  return most;
}

std::vector<double> even_times(std::size_t n, double start, double step) {
  std::vector<double> times(n);
  for (std::size_t i = 0; i < n; ++i) times[i] = start + double(i) * step;
  return times;
}

}  // namespace

TEST_CASE("phase turns: grids, blocks that are not full, uneven and few times", "[heavy]") {
  for (const std::size_t n : {1U, 31U, 32U, 33U, 128U, 1001U}) {
    CAPTURE(n);
    CHECK(greatest_error(even_times(n, 0, 0.013), 147.0) < 8 * epsilon<double>);
    CHECK(greatest_error(even_times(n, -3, 0.013), -21.0) < 8 * epsilon<double>);
    auto uneven = even_times(n, 0, 0.013);
    for (std::size_t i = 0; i < n; i += 3) uneven[i] += 1e-9;
    CHECK(greatest_error(uneven, 147.0) < 8 * epsilon<double>);
  }
  auto broken = even_times(400, 0, 0.01);
  for (std::size_t i = 200; i < 400; ++i) broken[i] *= 2;
  CHECK(greatest_error(broken, 30.0) < 8 * epsilon<double>);
}

TEST_CASE("phase turns: NaN stays NaN", "[heavy]") {
  auto times = even_times(200, 0, 0.01);
  times[70] = gyrostat::nan<double>;
  const PhaseTurns<double> turns(times, 3.0);
  double c[32], s[32];
  turns.write(64, c, s);
  CHECK(c[6] != c[6]);
}
