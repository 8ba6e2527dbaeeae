// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/pointing.hpp"

#include <algorithm>
#include <complex>
#include <random>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

Problem<double> pointed_stage() {
  Problem<double> p;
  p.inertia = {8, 7, 12};
  p.mass = 10;
  p.rotor_momentum = 2;
  p.charge_momentum = 0.4;
  p.torque = {0.04, -0.02, 0};
  p.force = {0.3, -0.2, 3};
  p.angular_velocity = {0.002, -0.003, 1};
  p.angles = {0.004, -0.002, 0.3};
  return p;
}

std::complex<double> std_of(math::Complex<double> z) { return {z.re, z.im}; }

}  // namespace

TEST_CASE("the mean tilt is the mean of the tilt", "[spinning]") {
  for (const double r0 : {1.0, -0.7}) {
    for (const double lambda3 : {2.0, -3.0}) {
      auto p = pointed_stage();
      p.angular_velocity[2] = r0;
      p.rotor_momentum = lambda3;
      if (p.nutation_squared() <= 0) continue;
      const Linear<double> linear(p);
      std::complex<double> sum = 0;
      double weights = 0;
      const double T = 5000;
      for (double t = 0.25; t < T; t += 0.5) {
        const double weight = std::pow(std::sin(pi<double> * t / T), 4);
        const auto s = linear.at(t);
        sum += weight * std::polar(1.0, s.angles.theta) * std::complex<double>(s.angles.psi, s.angles.phi);
        weights += weight;
      }
      const auto mean = std_of(mean_tilt(p));
      CHECK(std::abs(sum / weights - mean) < 1e-9);
      // from rest the torque alone tilts it, by the pointing error
      p.angular_velocity = {0, 0, r0};
      p.angles = {0, 0, 0.3};
      CHECK(std::abs(std_of(mean_tilt(p))) == Approx(pointing_error(p)).epsilon(1e-14));
      CHECK(pointing_error(p) ==
            Approx(std::hypot(0.04, 0.02) / std::abs(r0 * (12 * r0 + lambda3 - 0.4))).epsilon(1e-14));
    }
  }
  auto p = pointed_stage();
  p.angular_velocity[2] = 0;
  CHECK(pointing_error(p) == infinity<double>);
  p.torque.setZero();
  CHECK(pointing_error(p) == 0);
}

TEST_CASE("the velocity turns to its secular direction", "[spinning]") {
  for (const double r0 : {1.0, -0.7}) {
    auto p = pointed_stage();
    p.angular_velocity[2] = r0;
    p.velocity = {0.1, 0.2, 0.3};
    const Linear<double> linear(p);
    const auto ratio = std_of(secular_velocity_ratio(p));
    const auto off = [&](double t) {
      const auto s = linear.at(t);
      return std::abs(std::complex<double>(s.velocity[0], s.velocity[1]) / s.velocity[2] - ratio);
    };
    CHECK(off(1e4) < 1e-4);
    CHECK(off(1e7) < 1e-7);
    // from rest: the printed form, with the rotor and the charge in it
    p.angular_velocity = {0, 0, r0};
    p.angles = {0, 0, 0.3};
    const double X = p.effective_momentum(), k1 = p.kappa1(r0), k2 = p.kappa2(r0);
    const std::complex<double> i(0, 1), M(0.04, -0.02);
    const auto expected = std::polar(1.0, 0.3) * (i * M / (r0 * X)) /
                          (1 + (-0.2 / 3) * 0.04 / (r0 * 8 * k1) - (0.3 / 3) * -0.02 / (r0 * 7 * k2));
    CHECK(std::abs(std_of(secular_velocity_ratio(p)) - expected) < 1e-15);
  }
}

TEST_CASE("the momentum runs on a circle, the charge apart", "[spinning]") {
  const auto p = pointed_stage();
  const Linear<double> linear(p);
  const auto circle = momentum_circle(p);
  const std::complex<double> i(0, 1);
  for (double t : {0.0, 0.4, 3.0, 17.0, 400.0}) {
    const auto s = linear.at(t);
    const auto charge =
        -i * p.charge_momentum * std::polar(1.0, s.angles.theta) * std::complex<double>(s.angles.psi, s.angles.phi);
    const std::complex<double> G(s.momentum_I[0], s.momentum_I[1]);
    CHECK(std::abs(G - charge - std_of(circle.centre)) == Approx(circle.radius).epsilon(1e-13));
  }
  // from rest, without charge: centre (-M2, M1)/r0, whatever the inertia and the rotor
  auto q = p;
  q.charge_momentum = 0;
  q.angular_velocity = {0, 0, 2};
  q.angles = {};
  CHECK(momentum_circle(q).centre.re == Approx(0.01));
  CHECK(momentum_circle(q).centre.im == Approx(0.02));
  CHECK(momentum_circle(q).radius == Approx(std::hypot(0.01, 0.02)));
}

TEST_CASE("distances from the resonances", "[spinning]") {
  for (const double detuning : {1.0, 1e-5, 1e-10, 1e-13}) {
    auto p = pointed_stage();
    p.charge_momentum = 0;
    p.rotor_momentum = 3 + detuning;  // X = r0 (D1 + D2) + detuning
    const long double exact = (3 + detuning) - 3.0L;
    const auto d = divisors(p);
    CHECK(d.difference * (1 + std::sqrt(p.nutation_squared())) ==
          Approx(double((15 + exact) * exact / 56)).epsilon(1e-13));
    CHECK(d.least() == d.difference);
    CHECK(spin_flags(p).resonant == (detuning < 0.5));
    CHECK_FALSE(spin_flags(p).compliant);
    CHECK_FALSE(spin_flags(p).unstable);
    p.rotor_momentum = detuning - 12;
    CHECK(spin_flags(p).compliant == (detuning < 0.5));
    CHECK(spin_flags(p).resonant == (detuning < 0.5));
  }
  auto p = pointed_stage();
  p.rotor_momentum = 0;
  p.charge_momentum = 0;
  p.inertia = {8, 11, 9};
  CHECK(spin_flags(p).unstable);
  CHECK(divisors(p).sum == Approx(std::sqrt(1 - p.nutation_squared())));
  p.inertia = {9, 9, 9};
  CHECK(spin_flags(p).unstable);
  CHECK(divisors(p).nu == 0);
  CHECK(divisors(p).difference == Approx(1));
  p.angular_velocity[2] = 0;
  CHECK(divisors(p).least() == 0);
  CHECK(spin_flags(p).compliant);
}

TEST_CASE("the amplitudes are bounds, and near where the modes are apart", "[spinning]") {
  std::mt19937_64 random(2);
  const auto u = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  std::vector<double> regular;
  for (int trial = 0; trial < 1200; ++trial) {
    Problem<double> p;
    Vec3<double> D;
    do D = {u(.3, 3), u(.3, 3), u(.3, 3)};
    while (2 * D.maxCoeff() > D.sum());
    p.inertia = D;
    p.angular_velocity = {0, 0, u(-1, 1)};
    p.rotor_momentum = D[2] * u(-1, 1);
    p.charge_momentum = u(-.2, .2);
    const double detuning = trial % 12 == 0 ? 0 : std::pow(10, u(-12, -1)), Lambda = p.charge_momentum + detuning;
    const int kind = trial % 6;
    if (kind == 1) p.rotor_momentum = Lambda - D[2] * p.spin();
    if (kind == 2) p.rotor_momentum = Lambda + (D[0] + D[1] - D[2]) * p.spin();
    if (kind == 3) p.rotor_momentum = Lambda + (D[1] - D[2]) * p.spin();
    if (kind == 4) p.angular_velocity[2] = detuning;
    p.torque = {u(-1, 1), trial % 5 == 0 ? 0 : u(-1, 1), 0};
    if (trial % 2 == 0) {
      p.angular_velocity[0] = u(-1, 1);
      p.angular_velocity[1] = u(-1, 1);
      p.angles = {u(-1, 1), u(-1, 1), 0};
    }
    double T = std::pow(10, u(-1, 2.3));
    if (p.nutation_squared() < 0) T = std::min(T, 30 / std::sqrt(-p.nutation_squared()));
    const auto bound = amplitudes(p, T);
    const Linear<double> linear(p);
    double tilt = 0, rate = 0;
    const int points = 200 + int(20 * T);
    for (int i = 0; i <= points; ++i) {
      const auto s = linear.at(T * i / points);
      tilt = std::max(tilt, std::hypot(s.angles.psi, s.angles.phi));
      rate = std::max(rate, std::hypot(s.angular_velocity[0], s.angular_velocity[1]));
    }
    INFO("trial " << trial << " T " << T << " nu^2 " << p.nutation_squared());
    CHECK(tilt <= bound.tilt * (1 + 1e-12));
    CHECK(rate <= bound.rate * (1 + 1e-12));
    CHECK(bound.tilt <= 12 * tilt);
    CHECK(bound.rate <= 12 * rate);
    // more time, no lower bound
    CHECK(amplitudes(p, 1.5 * T).tilt >= bound.tilt * (1 - 1e-12));
    if (kind == 0) regular.push_back(bound.tilt / tilt);
  }
  std::sort(regular.begin(), regular.end());
  CHECK(regular[regular.size() / 2] < 1.2);
}
