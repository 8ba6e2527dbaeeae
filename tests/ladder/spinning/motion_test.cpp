// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/motion.hpp"

#include <string_view>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("a comparison of spinning motions measures each column by its own size", "[spinning]") {
  State<double> a, b;
  a.angular_velocity = {0, 3, 4};
  b.angular_velocity = {0, 3, 4.5};
  a.angles = {0, 0, 100};
  b.angles = {0.01, 0, 100};
  b.attitude = quaternion_from_vector<double>({0.02, 0, 0});
  a.momentum_I = {0, 0, 10};
  b.momentum_I = {0, 1, 10};
  a.velocity = b.velocity = {1, 2, 3};
  b.position = {0, 0, 1e-3};
  Comparison comparison(Row<double>{});
  comparison.add(a, a);
  CHECK(comparison.relative(comparison.difference()).greatest() == 0);
  comparison.add(a, b);
  const auto e = comparison.relative(comparison.difference());
  CHECK(e[column::angular_velocity] == Approx(0.1));
  CHECK(e[column::euler_312] == Approx(0.01));  // the angle between the attitudes that they tell
  CHECK(e[column::attitude] == Approx(0.02));
  CHECK(e[column::angular_momentum_inertial] == Approx(0.1));
  CHECK(e[column::velocity] == 0);
  CHECK(std::isinf(e[column::position]));  // of a column that is zero in the first motion
  b.velocity[1] = gyrostat::nan<double>;
  comparison.add(a, b);
  CHECK(std::isnan(comparison.difference()[column::velocity]));
  CHECK(std::isnan(comparison.difference().greatest()));
}

TEST_CASE("angles are judged by the attitude that they tell", "[spinning]") {
  // at psi = pi/2 only theta + phi means anything; a turn of theta is none of the attitude
  State<double> a, b;
  a.angles = {pi<double> / 2, 0.3, 5};
  b.angles = {pi<double> / 2, 0.3 + 1, 5 - 1 + 2 * pi<double>};
  Comparison comparison(Row<double>{});
  comparison.add(a, b);
  CHECK(comparison.difference()[column::euler_312] < 1e-14);
  b.angles.psi -= 1e-3;
  comparison.add(a, b);
  CHECK(comparison.relative(comparison.difference())[column::euler_312] == Approx(1e-3).epsilon(1e-2));
  // what writing down many turns rounds
  b.angles.theta = 1e6;
  const State<double> states[] = {a, b};
  CHECK(angles_error<double>(1e-12, states) > 1e-12 + 1e-10);
  CHECK(angles_error<double>(1e-12, states) < 1e-12 + 1e-9);
}

TEST_CASE("a row of a spinning motion has the columns of the table, one behind the other", "[spinning]") {
  State<double> state;
  state.angular_velocity = {1, 2, 3};
  state.angles = {4, 5, 6};
  state.attitude = {10, 7, 8, 9};  // w first, last in a row
  state.momentum_I = {11, 12, 13};
  state.velocity = {14, 15, 16};
  state.position = {17, 18, 19};
  constexpr std::size_t width = row_width(column_kinds);
  double row[width];
  Row<double>{}(state, row);
  for (std::size_t i = 0; i < width; ++i) CHECK(row[i] == double(i + 1));
  CHECK(width == 19);
}

TEST_CASE("scales of the columns of a spinning motion", "[spinning]") {
  Problem<double> p;
  p.inertia = {2, 2.5, 3};
  for (const double scale : scales(p, 10.0).of) CHECK(scale == 0);
  p.angular_velocity = {0, 0, 2};
  p.rotor_momentum = -6;  // the momentum is zero, its parts are not
  p.mass = 2;
  p.force = {0, 8, 0};
  p.velocity = {3, 0, 0};
  p.position = {0, 0, 7};
  const auto e = scales(p, 10.0);
  CHECK(e[column::angular_velocity] == 2);
  CHECK(e[column::angular_momentum_inertial] == Approx(0.012));
  CHECK(e[column::velocity] == Approx(3 + 4 / 2.0));
  CHECK(e[column::position] == Approx(7 + 30 + 1));
  // from rest
  p.angular_velocity.setZero();
  p.torque = {0, 0, 3};
  CHECK(scales(p, 0.1)[column::angular_velocity] == Approx(0.1));
  CHECK(scales(p, 100.0)[column::angular_velocity] == Approx(1));
}

TEST_CASE("places in the tables of the spinning family", "[spinning]") {
  CHECK(std::string_view(column_kinds[column::euler_312].name) == "euler_312");
  CHECK(std::string_view(column_kinds[column::position].name) == "position");
  CHECK(std::string_view(scalar_kinds[scalar::tilt_max].name) == "tilt_max");
  CHECK(std::string_view(warning_kinds[warning::gimbal_lock].code) == "gimbal-lock");
  CHECK(std::string_view(warning_kinds[warning::spin_reversal].code) == "spin-reversal");
  CHECK(place_of(tables.rungs, "linear") == rung::linear);
  CHECK(place_of(tables.rungs, "second-order") == rung::second_order);
  CHECK(place_of(tables.rungs, "picard") == rung::picard);
  CHECK(place_of(tables.rungs, "full") == rung::full);
}
