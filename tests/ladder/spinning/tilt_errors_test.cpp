// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/tilt_errors.hpp"

#include <algorithm>
#include <vector>

#include "../../models/spinning/spinners.hpp"
#include "catch.hpp"
#include "gyrostat/models/spinning/linear.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

std::vector<State<double>> states(const Problem<double>& p, double span) {
  const Linear<double> linear(p);
  std::vector<State<double>> found;
  for (int i = 0; i <= 20; ++i) found.push_back(linear.at(span * i / 20));
  return found;
}

}  // namespace

TEST_CASE("errors of a small tilt become relative to what the right columns measure at least", "[spinning]") {
  const auto p = Spinners(3).spinner(0.01);
  const double span = 20 / std::abs(p.spin());
  const auto found = states(p, span);
  LinearErrors<double> left_out{};
  left_out.size = {0.01, 0.01};
  const auto rounding = tilt_errors(p, left_out, found, span);
  for (const double e : rounding.of) {
    CHECK(e > 0);
    CHECK(e < 1e-12);
  }

  double fastest = 0, position = 0;
  for (const auto& s : found) {
    fastest = std::max(fastest, s.angular_velocity.norm());
    position = std::max(position, s.position.norm());
  }
  left_out.rates = 3e-3 * fastest, left_out.spin = 4e-3 * fastest;
  left_out.attitude = 0.02;
  left_out.position = 0.5 * position;
  const auto e = tilt_errors(p, left_out, found, span);
  CHECK(e[column::angular_velocity] == Approx(5e-3).epsilon(1e-2));
  CHECK(e[column::attitude] == Approx(0.02));
  const double scale = scales(p, span)[column::position];
  CHECK(e[column::position] == Approx(0.5 * position / std::max(0.5 * position, scale)));
  CHECK(e[column::velocity] == rounding[column::velocity]);
}

TEST_CASE("a column that may be all error is relative to its scale; no attitude is off by more than half a turn",
          "[spinning]") {
  const auto p = Spinners(3).spinner(0.01);
  const auto found = states(p, 1);
  LinearErrors<double> left_out{};
  left_out.momentum = 1e9;
  left_out.attitude = 700;
  const auto e = tilt_errors(p, left_out, found, 1);
  CHECK(e[column::angular_momentum_inertial] ==
        Approx(1e9 / scales(p, 1.0)[column::angular_momentum_inertial]).epsilon(1e-6));
  // without one it has none
  Problem<double> rest;
  left_out.momentum = 1;
  CHECK(tilt_errors(rest, left_out, states(rest, 1), 1)[column::angular_momentum_inertial] == infinity<double>);
  CHECK(e[column::attitude] == Approx(pi<double>));
}

TEST_CASE("where nothing moves nothing is wrong", "[spinning]") {
  Problem<double> p;
  const auto found = states(p, 1);
  const auto e = tilt_errors(p, LinearErrors<double>{}, found, 1);
  CHECK(e[column::velocity] == 0);
  CHECK(e[column::position] == 0);
  CHECK(e[column::angular_velocity] == 0);
  CHECK(e[column::euler_312] == e[column::attitude]);
  CHECK(e[column::attitude] < 1e-15);
}

TEST_CASE("small tilt means tilt and spin angle known to 0.3 rad", "[spinning]") {
  LinearErrors<double> e{};
  CHECK(holds(e));
  e.size.tilt = 0.29;
  CHECK(holds(e));
  e.tilt = 0.02;
  CHECK_FALSE(holds(e));
  e.tilt = 0;
  e.theta = 0.31;
  CHECK_FALSE(holds(e));
  e.theta = gyrostat::nan<double>;
  CHECK_FALSE(holds(e));
}
