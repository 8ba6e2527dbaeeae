// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/settling.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "scenes.hpp"

namespace general_settling_test {

using namespace gyrostat;
using namespace gyrostat::general;

Problem<double> body() {
  Problem<double> p;
  p.inertia << 3, 0.1, -0.2, 0.1, 4, 0.3, -0.2, 0.3, 5;
  return p;
}

void add(Problem<double>& p, const Vec3<double>& axis, double inertia, double friction) {
  auto& wheel = p.wheels.emplace_back();
  wheel.type = WheelType::friction, wheel.axis = axis.normalized();
  wheel.axial_inertia = inertia, wheel.friction = friction;
}

TEST_CASE("one motor settles as the family rotor says", "[general]") {
  auto p = body();
  CHECK(Settling<double>(Wheels<double>::of(p)).fastest() == 0);
  add(p, {0.6, 0, 0.8}, 0.2, 0.3);
  const auto rotor = rotor::Gyrostat<double>::make(p.inertia, p.wheels[0].axis, 0.2, 0.3, 1.);
  REQUIRE(rotor);
  const Settling<double> settling(Wheels<double>::of(p));
  CHECK(settling.count == 1);
  CHECK(settling.fastest() == Approx(rotor->relaxation_rate()));
}

/// p' = -diag(c) (p/I - u.w) at M = l = 0, w = -J*^-1 sum p u.
Eigen::VectorXd settles(const Wheels<double>& wheels, const Settling<double>& settling, const Eigen::VectorXd& p) {
  Vec3<double> sum(0, 0, 0);
  for (std::size_t k = 0; k < settling.count; ++k) sum += p[int(k)] * wheels.laws[settling.wheel[k]].axis;
  const Vec3<double> w = -(wheels.inverse * sum);
  Eigen::VectorXd rate(p.size());
  for (std::size_t k = 0; k < settling.count; ++k) {
    const auto& law = wheels.laws[settling.wheel[k]];
    rate[int(k)] = -law.friction * (p[int(k)] / law.axial_inertia - law.axis.dot(w));
  }
  return rate;
}

TEST_CASE("in its axes each unknown settles by itself, however different the wheels", "[general]") {
  general_scenes::Scenes source(5);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    auto p = body();
    const int n = 1 + i % 8;
    add(p, {0, 0, 1}, 0.1, 0);  // free: not among them
    for (int k = 0; k < n; ++k)
      add(p, {source.unit() - 0.5, source.unit() - 0.5, source.unit() - 0.5}, source.scale(1e-3, 0.3),
          source.scale(1e-6, 1e9));
    if (check_wheels(p)) continue;
    ++compared;
    const auto wheels = Wheels<double>::of(p);
    const Settling<double> settling(wheels);
    REQUIRE(settling.count == std::size_t(n));
    for (int m = 0; m < n; ++m) {
      const auto mode = std::size_t(m);
      Eigen::VectorXd z(n);
      for (int k = 0; k < n; ++k) z[k] = settling.to_wheel[std::size_t(k)][mode];
      const Eigen::VectorXd rate = settles(wheels, settling, z);
      Vec3<double> axis(0, 0, 0);
      for (int k = 0; k < n; ++k) {
        const auto& law = wheels.laws[settling.wheel[std::size_t(k)]];
        CAPTURE(i, m, k);
        // the slow ones too, to roundings of their own wheel's part in it
        CHECK(std::abs(rate[k] + settling.rate[mode] * z[k]) <=
              1e-13 * (law.friction * (std::abs(z[k]) / law.axial_inertia + settling.axis[mode].norm())));
        axis += z[k] * law.axis;
        double unit = 0;
        for (std::size_t j = 0; j < settling.count; ++j)
          unit += settling.to_mode[mode][j] * settling.to_wheel[j][std::size_t(k)];
        CHECK(unit == Approx(k == m ? 1 : 0).margin(1e-13));
      }
      CHECK((axis - settling.axis[mode]).norm() <= 1e-14 * z.norm());
    }
  }
  CHECK(compared > 80);
}

TEST_CASE("small rates are as good as great ones", "[general]") {
  // two wheels that do not feel each other, 15 powers of ten apart
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  add(p, {1, 0, 0}, 0.1, 1e9), add(p, {0, 1, 0}, 0.2, 1e-6);
  const Settling<double> apart(Wheels<double>::of(p));
  CHECK(apart.rate[0] == Approx(1e9 * (1 / 0.1 + 1 / 2.9)).epsilon(1e-15));
  CHECK(apart.rate[1] == Approx(1e-6 * (1 / 0.2 + 1 / 1.8)).epsilon(1e-15));
  // coupled: the product of the rates is that of the frictions and the determinant
  p.wheels[1].axis = Vec3<double>(0.6, 0.8, 0);
  const auto wheels = Wheels<double>::of(p);
  const Settling<double> coupled(wheels);
  const auto entry = [&](std::size_t k, std::size_t m) {
    const auto &a = wheels.laws[k], &b = wheels.laws[m];
    return a.axis.dot(wheels.inverse * b.axis) + (k == m ? 1 / a.axial_inertia : 0);
  };
  const double determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
  CHECK(coupled.rate[0] * coupled.rate[1] == Approx(1e3 * determinant).epsilon(1e-14));
}

}  // namespace general_settling_test
