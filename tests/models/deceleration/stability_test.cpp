// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/stability.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using gyrostat::math::Modulus;

namespace {

/// G of the averaged equations for the regime about the largest moment, in its difference form.
double growth(const Vec3<double>& b, Modulus<double> m) {
  const auto mean = math::Native::means(m);
  return (b[0] - b[2]) * m.k2 * mean.F - (b[1] - b[2]) * m.kp2 * mean.W;
}

Vec3<double> mirrored(const Vec3<double>& b) { return {b[2], b[1], b[0]}; }

RegimeStability<double> about_largest(const Vec3<double>& b) {
  const auto table = regime_stability(b, Regime::about_largest);
  REQUIRE(table);
  return *table;
}

}  // namespace

TEST_CASE("the torque balance falls from a half to nothing") {
  CHECK(torque_balance(Modulus<double>{0, 1}) == 0.5);
  CHECK(torque_balance(Modulus<double>{1, 0}) == 0);
  CHECK(torque_balance(Modulus<double>{1e-300, 1}) == Approx(0.5).epsilon(1e-15));
  CHECK(torque_balance(Modulus<double>::from_k2(0.4)) == Approx(0.4053).margin(5e-5));
  double last = 0.5;
  for (double x = -30; x < 600; x += 0.125) {
    const double e = std::exp(-std::abs(x));
    const double now = torque_balance(x < 0 ? Modulus<double>::from_parts(e, 1) : Modulus<double>::from_parts(1, e));
    CHECK(now <= last * (1 + 4e-16));
    CHECK(now > 0);
    last = now;
  }
  CHECK(std::isnan(torque_balance(Modulus<double>::from_k2(1.5))));
  CHECK(std::isnan(torque_balance(Modulus<double>{gyrostat::nan<double>, 1})));
}

TEMPLATE_TEST_CASE("the modulus of a balance is found at both ends", "", float, double, long double) {
  using S = TestType;
  for (const S k2 : {S(1e-3), S(0.1), S(0.4), S(0.9), S(0.999)}) {
    const auto m = modulus_of_balance(torque_balance(Modulus<S>::from_k2(k2)));
    REQUIRE(m);
    CHECK(std::abs(m->k2 - k2) <= 64 * epsilon<S>);
  }
  for (const S kp2 : {S(1e-3), S(1e-8), S(1e-30)}) {
    const auto m = modulus_of_balance(torque_balance(Modulus<S>::from_kp2(kp2)));
    REQUIRE(m);
    CHECK(std::abs(m->kp2 - kp2) <= 64 * epsilon<S> * kp2);
  }
  CHECK(modulus_of_balance(S(0.5) - epsilon<S>));
  CHECK(modulus_of_balance(S(0)).error() == Errc::out_of_domain);
  CHECK(modulus_of_balance(S(0.5)).error() == Errc::out_of_domain);
  CHECK(modulus_of_balance(S(-1)).error() == Errc::out_of_domain);
  CHECK(modulus_of_balance(gyrostat::nan<S>).error() == Errc::not_finite);
}

TEST_CASE("4000 random torques agree with the sign of dk2/dt along all k2") {
  std::mt19937_64 random(18);
  std::uniform_real_distribution<double> ratio(0, 2);
  int seen[5] = {};
  for (int i = 0; i < 4000; ++i) {
    const Vec3<double> b(ratio(random), ratio(random), 1);
    const auto table = about_largest(b);
    ++seen[static_cast<int>(table.region)];

    int changes = 0;
    double at_change = 0;
    bool grew = growth(b, Modulus<double>::from_k2(1e-9)) > 0;
    CHECK((table.axis == Tendency::repels) == grew);
    for (int j = 1; j < 400; ++j) {
      const double k2 = j / 400.0;
      const bool grows = growth(b, Modulus<double>::from_k2(k2)) > 0;
      if (grows != grew) {
        ++changes;
        at_change = k2;
      }
      grew = grows;
    }
    const bool grows_last = growth(b, Modulus<double>::from_kp2(1e-250)) > 0;
    if (grows_last != grew) {
      ++changes;
      at_change = 1;
    }
    CHECK((table.separatrix == Tendency::attracts) == grows_last);
    const double quotient = (b[0] - 1) / (b[1] - 1);
    const bool interior = 0 < quotient && quotient < 0.5;
    CHECK((table.interior != Tendency::none) == interior);
    CHECK(changes == (interior ? 1 : 0));
    if (interior) {
      const double k2 = table.quasi_stationary.k2;
      CHECK(at_change - 1.0 / 400 <= k2 + 1e-12);
      CHECK(k2 <= at_change);
      const double scale = std::abs(b[0] - 1) + std::abs(b[1] - 1);
      CHECK(std::abs(growth(b, table.quasi_stationary)) <= 1e-14 * scale);
      CHECK(b[0] == Approx(1 + (b[1] - 1) * torque_balance(table.quasi_stationary)).epsilon(1e-13));
      CHECK((table.interior == Tendency::attracts) == (b[1] < 1));
    }
  }
  for (int region = 0; region < 4; ++region) CHECK(seen[region] > 200);
}

TEST_CASE("the rows of the table") {
  const auto first = about_largest({0.5, 0.8, 1});
  CHECK(first.region == Region::to_axis);
  CHECK(first.axis == Tendency::attracts);
  CHECK(first.interior == Tendency::none);
  CHECK(first.separatrix == Tendency::repels);
  CHECK(std::isnan(first.quasi_stationary.k2));

  const auto second = about_largest({1.5, 1.2, 1});
  CHECK(second.region == Region::to_separatrix);
  CHECK(second.axis == Tendency::repels);
  CHECK(second.separatrix == Tendency::attracts);

  const auto third = about_largest({0.9, 0.6, 1});
  CHECK(third.region == Region::to_interior);
  CHECK(third.axis == Tendency::repels);
  CHECK(third.interior == Tendency::attracts);
  CHECK(third.separatrix == Tendency::repels);

  const auto fourth = about_largest({1.1, 1.4, 1});
  CHECK(fourth.region == Region::from_interior);
  CHECK(fourth.axis == Tendency::attracts);
  CHECK(fourth.interior == Tendency::repels);
  CHECK(fourth.separatrix == Tendency::attracts);
  // Both have phi(k*2) = 1/4.
  CHECK(third.quasi_stationary.k2 == Approx(fourth.quasi_stationary.k2).epsilon(1e-13));
}

TEST_CASE("the regime about the smallest moment is the other with the outer torques exchanged") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> torque(0, 3);
  for (int i = 0; i < 200; ++i) {
    const Vec3<double> b(torque(random), torque(random), torque(random));
    const auto here = regime_stability(b, Regime::about_smallest);
    REQUIRE(here);
    const auto there = about_largest(mirrored(b));
    CHECK(here->region == there.region);
    CHECK((here->quasi_stationary.k2 == there.quasi_stationary.k2 || here->interior == Tendency::none));
    // Unless the two outer torques are equal, the separatrix is crossed one way.
    CHECK((here->separatrix == Tendency::attracts) != (about_largest(b).separatrix == Tendency::attracts));
  }
}

TEST_CASE("the boundaries of the regions") {
  // b1 = b3: the separatrix attracts from both sides where b2 is the smallest, else repels to both.
  CHECK(about_largest({1, 0.2, 1}).region == Region::to_separatrix);
  CHECK(regime_stability(Vec3<double>(1, 0.2, 1), Regime::about_smallest)->region == Region::to_separatrix);
  CHECK(about_largest({1, 1.7, 1}).region == Region::to_axis);
  CHECK(about_largest({1, 1, 1}).region == Region::neutral);
  CHECK(about_largest({0, 0, 0}).region == Region::neutral);
  // 2 b1 = b2 + b3.
  CHECK(about_largest({0.75, 0.5, 1}).region == Region::to_axis);
  CHECK(about_largest({1.25, 1.5, 1}).region == Region::to_separatrix);
  // k*2 that rounds to an end.
  CHECK(about_largest({1 + 2.3e-16, 1e300, 1}).quasi_stationary.kp2 < 1e-300);
  CHECK(about_largest({1.5 - 2.3e-16, 2, 1}).quasi_stationary.k2 < 1e-14);
}

TEST_CASE("what k2 tends to from a start") {
  const auto near_axis = Modulus<double>::from_k2(0.1);
  const auto near_separatrix = Modulus<double>::from_k2(0.999);
  CHECK(about_largest({0.5, 0.8, 1}).attractor(near_separatrix).k2 == 0);
  CHECK(about_largest({1.5, 1.2, 1}).attractor(near_axis).kp2 == 0);
  const auto stable = about_largest({0.9, 0.6, 1});
  CHECK(stable.attractor(near_axis).k2 == stable.quasi_stationary.k2);
  const auto unstable = about_largest({1.1, 1.4, 1});
  CHECK(unstable.attractor(near_axis).k2 == 0);
  CHECK(unstable.attractor(near_separatrix).kp2 == 0);
  CHECK(unstable.attractor(unstable.quasi_stationary).k2 == unstable.quasi_stationary.k2);
  CHECK(about_largest({1, 1, 1}).attractor(near_axis).k2 == near_axis.k2);
}

TEST_CASE("bad torques are refused") {
  const Regime A = Regime::about_largest;
  CHECK(regime_stability(Vec3<double>(gyrostat::nan<double>, 1, 1), A).error() == Errc::not_finite);
  CHECK(regime_stability(Vec3<double>(1, infinity<double>, 1), A).error() == Errc::not_finite);
  CHECK(regime_stability(Vec3<double>(1, 1, -1e-9), A).error() == Errc::negative);
  CHECK(regime_stability(Vec3<double>(1, 1, 2), Regime::one_component).error() == Errc::out_of_domain);
}
