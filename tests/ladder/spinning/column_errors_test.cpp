// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/column_errors.hpp"

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
  Comparison<double> comparison;
  comparison.add(a, a);
  CHECK(comparison.relative(comparison.difference()).greatest() == 0);
  comparison.add(a, b);
  const auto e = comparison.relative(comparison.difference());
  CHECK(e.angular_velocity == Approx(0.1));
  CHECK(e.angles == Approx(1e-4));
  CHECK(e.attitude == Approx(0.02));
  CHECK(e.momentum == Approx(0.1));
  CHECK(e.velocity == 0);
  CHECK(std::isinf(e.position));  // of a column that is zero in the first motion
  b.velocity[1] = gyrostat::nan<double>;
  comparison.add(a, b);
  CHECK(std::isnan(comparison.difference().velocity));
  CHECK(std::isnan(comparison.difference().greatest()));
}
