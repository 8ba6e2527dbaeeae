// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/motion.hpp"

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("a comparison of heavy motions measures each column by its own size", "[heavy]") {
  State<double> a, b;
  a.angular_velocity = {0, 3, 4};
  b.angular_velocity = {0, 3, 4.5};
  b.down = {0.01, 0, -1};
  b.attitude = quaternion_from_vector<double>({0.02, 0, 0});
  Comparison comparison(Row<double>{});
  comparison.add(a);
  CHECK(comparison.relative(comparison.difference()).greatest() == 0);
  comparison.add(a, b);
  const auto e = comparison.relative(comparison.difference());
  CHECK(e[column::angular_velocity] == Approx(0.1));
  CHECK(e[column::down] == Approx(0.01));
  CHECK(e[column::attitude] == Approx(0.02));
  CHECK(e.greatest() == Approx(0.1));
  b.down[1] = gyrostat::nan<double>;
  comparison.add(a, b);
  CHECK(std::isnan(comparison.difference().greatest()));
}

TEST_CASE("rates of a heavy body that hardly moves are measured by what its weight could give", "[heavy]") {
  const auto p = Problem<double>::make({1, 1.2, 1.6}, 2, {0, 0, 0.1}, 8, 3).value();
  const auto at_rest = scales(p, 0.0), fast = scales(p, -50.0);
  CHECK(at_rest[column::angular_velocity] == Approx(2));  // sqrt(1.6/1.6 + 3)
  CHECK(fast[column::angular_velocity] == 50);
  CHECK(fast[column::down] == 1);
  State<double> swinging;
  swinging.angular_velocity = {1e-9, 0, 0};
  Comparison comparison(Row<double>{at_rest});
  comparison.add(swinging, {});
  CHECK(comparison.relative(comparison.difference())[column::angular_velocity] == Approx(5e-10));
  CHECK(comparison.unit(column::attitude) == 1);
}

TEST_CASE("tables of the heavy family have one row a place", "[heavy]") {
  CHECK(place_of(tables.columns, "attitude") == int(column::attitude));
  CHECK(std::size(column_kinds) == column::attitude + 1);
  CHECK(place_of(tables.scalars, "precession_rate") == int(heavy::scalar::precession_rate));
  CHECK(place_of(tables.warnings, "rounding-decides") == int(warning::rounding_decides));
  CHECK(place_of(tables.warnings, "gradient") == int(warning::gradient));
  CHECK(place_of(tables.rungs, "series-2") == rung::series_2);
  CHECK(place_of(tables.rungs, "full") == rung::full);
}
