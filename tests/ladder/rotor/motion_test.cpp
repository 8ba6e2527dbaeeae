// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/motion.hpp"

#include "../../models/rotor/bodies.hpp"
#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

TEST_CASE("a comparison measures each column by its own size", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const Vec3<double> Omega(0.1, -0.2, 0.3);
  const State<double> a = body.state({}, Omega, 5);
  State<double> b = body.state(quaternion_from_vector<double>({0, 0, 0.01}), Omega * 1.001, 5.002);
  State<double> c = a;
  c.rotor_angle = 10;
  b.rotor_angle = 10.5;
  Comparison comparison{Row<double>(body)};
  comparison.add(a, a);
  CHECK(comparison.difference().greatest() == 0);
  CHECK(comparison.relative(comparison.difference()).greatest() == 0);
  comparison.add(c, b);
  const auto relative = comparison.relative(comparison.difference());
  CHECK(relative[column::attitude] == Approx(0.01));
  CHECK(relative[column::angular_velocity] == Approx(0.001));
  CHECK(relative[column::rotor_rate] == Approx(0.002 / 5));
  CHECK(relative[column::rotor_angle] == Approx(0.05));
  CHECK(relative[column::angular_momentum] == Approx((b.momentum - a.momentum).norm() / a.momentum.norm()));
  b.axial_momentum = gyrostat::nan<double>;
  comparison.add(a, b);
  CHECK(std::isnan(comparison.difference()[column::rotor_rate]));
}
