// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/column_errors.hpp"

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
  Comparison<double> comparison;
  comparison.add(a, a);
  CHECK(comparison.relative(comparison.difference()).greatest() == 0);
  comparison.add(a, b);
  const auto e = comparison.relative(comparison.difference());
  CHECK(e.angular_velocity == Approx(0.1));
  CHECK(e.down == Approx(0.01));
  CHECK(e.attitude == Approx(0.02));
  CHECK(e.greatest() == Approx(0.1));
  b.down[1] = gyrostat::nan<double>;
  comparison.add(a, b);
  CHECK(std::isnan(comparison.difference().greatest()));
}
