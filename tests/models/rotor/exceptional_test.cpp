// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/exceptional.hpp"

#include <cmath>

#include "catch.hpp"
#include "models/rotor/bodies.hpp"
#include "models/rotor/momentum_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

Gyrostat<double> made(const Mat3<double>& theta, const Vec3<double>& e, double lambda = 0.6, double slope = 0.5,
                      double rate = 5) {
  const auto g = Gyrostat<double>::make((theta + theta.transpose()) / 2, e.normalized(), lambda, slope, rate);
  REQUIRE(g);
  return *g;
}

Mat3<double> diagonal(double a, double b, double c) { return Vec3<double>(a, b, c).asDiagonal(); }

/// e with n = theta^-1 e normal to a circular section, theta = diag(3, 4.2, 5).
Vec3<double> section_axis(double side = 1) {
  const double j1 = 1 / 3.0, j2 = 1 / 4.2, j3 = 1 / 5.0;
  return Vec3<double>(3 * std::sqrt(j1 - j2), 0, side * 5 * std::sqrt(j2 - j3)).normalized();
}

Exceptional family(const Gyrostat<double>& g, double l = 8) { return exceptional_distance(g, l).family; }

}  // namespace

TEST_CASE("the families are recognised, in any axes") {
  Bodies bodies(1);
  for (int i = 0; i < 100; ++i) {
    const Mat3<double> R = i == 0 ? Mat3<double>::Identity() : to_matrix(bodies.attitude());
    const auto turned = [&](const Mat3<double>& theta, const Vec3<double>& e) {
      return made(R * theta * R.transpose(), R * e);
    };
    CHECK(family(turned(diagonal(4, 4, 5.5), {0, 0, 1})) == Exceptional::axisymmetric);
    CHECK(family(turned(diagonal(5.5, 4, 4), {-1, 0, 0})) == Exceptional::axisymmetric);
    CHECK(family(turned(diagonal(4, 4, 4), {0.48, 0.6, 0.64})) == Exceptional::axisymmetric);
    CHECK(family(turned(diagonal(4, 4, 5.5), {1, 0, 0})) == Exceptional::principal_axis);
    CHECK(family(turned(diagonal(4, 4, 5.5), {0.6, 0, 0.8})) == Exceptional::none);
    CHECK(family(turned(diagonal(3, 3.6, 5), {0, 0, 1})) == Exceptional::principal_axis);
    CHECK(family(turned(diagonal(3, 3.6, 5), {0, 1, 0})) == Exceptional::principal_axis);
    CHECK(family(turned(diagonal(3, 4.2, 5), section_axis())) == Exceptional::circular_section);
    CHECK(family(turned(diagonal(3, 4.2, 5), section_axis(-1))) == Exceptional::circular_section);
    CHECK(family(turned(diagonal(3, 4.2, 5), {0.6, 0, 0.8})) == Exceptional::none);
    CHECK(family(turned(diagonal(3, 4.2, 5), section_axis()), 0) == Exceptional::at_rest);
  }
  for (int i = 0; i < 1000; ++i) CHECK(family(bodies.realisable()) == Exceptional::none);
}

TEST_CASE("the distances are linear in what is wrong") {
  for (const double d : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const auto axisymmetric = exceptional_distance(made(diagonal(4 * (1 + d), 4, 5.5), {0, 0, 1}), 8.0);
    CHECK(axisymmetric.axisymmetric / d == Approx(std::sqrt(0.5) * 4 / std::sqrt(32 + 5.5 * 5.5)).epsilon(d + 1e-3));
    CHECK(axisymmetric.family == Exceptional::principal_axis);
    const auto principal = exceptional_distance(made(diagonal(3, 3.6, 5), {d, 0, 1}), 8.0);
    CHECK(principal.principal_axis / d == Approx(2 / diagonal(3, 3.6, 5).norm()).epsilon(d + 1e-3));
    CHECK(principal.family == Exceptional::none);
    const auto section =
        exceptional_distance(made(diagonal(3, 4.2, 5), section_axis() + d * Vec3<double>::UnitY()), 8.0);
    CHECK(section.circular_section / d > 0.01);
    CHECK(section.circular_section / d < 1);
    CHECK(section.family == Exceptional::none);
    const auto rest = exceptional_distance(made(diagonal(3, 4.2, 5), {0.6, 0, 0.8}), 3 * d);
    CHECK(rest.at_rest == Approx(d).epsilon(2 * d));
  }
}

TEST_CASE("on a circular section F is constant, and m runs round it at the rate stated") {
  for (const double side : {1.0, -1.0}) {
    const auto g = made(diagonal(3, 4.2, 5), section_axis(side), 0.6, 0.5, 6);
    const double l = 4;
    const auto circle = circular_section(g, l);
    CHECK(circle.tumbles);
    const Vec3<double> n = g.inverse_inertia() * g.axis();
    const Vec3<double> u = Vec3<double>::UnitY(), v = n.normalized().cross(u);
    for (double phi = 0; phi < 6; phi += 0.3) {
      const Vec3<double> m = std::cos(phi) * u + std::sin(phi) * v;
      CHECK(g.steady_level(l * m) == Approx(circle.level).epsilon(1e-14));
      const Vec3<double> rate = m.cross(g.inverse_inertia() * (l * m - g.target_momentum() * g.axis()));
      CHECK(std::abs(n.dot(rate)) < 1e-14);
      const double turn = rate.dot(n.normalized().cross(m));
      CHECK(std::abs(turn - circle.drive) == Approx(circle.hold * std::abs(std::sin(phi))).margin(1e-14));
    }
    // it runs for ever: a period of 2 pi/sqrt(drive^2 - hold^2), with omega = omega*
    const double period = 2 * pi<double> / std::sqrt(circle.drive * circle.drive - circle.hold * circle.hold);
    auto motion = MomentumMotion::from(g, l, u, 0);
    for (int i = 0; i < 4000; ++i) {
      motion.step(period / 4000);
      CHECK(std::abs(motion.slip()) < 1e-11);
    }
    CHECK((motion.direction() - u).norm() < 1e-10);
    CHECK_FALSE(circular_section(g, 4 * circle.drive / circle.hold * 1.01).tumbles);
    CHECK(circular_section(g, 4 * circle.drive / circle.hold * 0.99).tumbles);
  }
}

TEST_CASE("a rotor on a principal axis: 1/W grows as c t at a minimum and falls at a maximum") {
  const auto g = made(diagonal(3, 3.6, 5), {0, 0, 1}, 0.6, 0.5, 5);
  const double l = 8;
  const auto all = steady_rotations(g, l);
  const SteadyRotation<double>& low = all[0];
  REQUIRE(low.direction[2] == 1);
  const double c = algebraic_rate(g, l, low);
  const auto fraction = [&](const SteadyRotation<double>& r, double c_there, double off, double factor) {
    auto motion = MomentumMotion::from(g, l, (r.direction + off * Vec3<double>(0.6, 0.8, 0)).normalized(), 0);
    // past the first e-folds of x, which starts out of step
    const double dt = 0.04;
    for (double t = 0; t < 40; t += dt) motion.step(dt);
    const double first = std::abs(motion.level() - r.level);
    double time = 0;
    for (; time < factor / (c_there * first); time += dt) motion.step(dt);
    return (1 / std::abs(motion.level() - r.level) - 1 / first) / (c_there * time);
  };
  CHECK(fraction(low, c, 0.2, 0.5) == Approx(1).epsilon(0.02));
  CHECK(fraction(low, c, 0.4, 0.5) == Approx(1).epsilon(0.08));

  CHECK(algebraic_rate(made(diagonal(4, 4, 5.5), {0, 0, 1}), l,
                       steady_rotations(made(diagonal(4, 4, 5.5), {0, 0, 1}), l)[0]) == Approx(0).margin(1e-30));
  CHECK(algebraic_rate(made(diagonal(3, 3.6, 5), {0, 0, 1}, 0.6, 0), l, low) == 0);
  for (const auto& r : all) CHECK(std::isnan(algebraic_rate(g, l, r)) == (std::abs(r.direction[2]) != 1));
  const auto skew = made(diagonal(3, 3.6, 5), {0.1, 0, 1});
  CHECK(std::isnan(algebraic_rate(skew, l, steady_rotations(skew, l)[0])));
}

TEST_CASE("leaving a maximum on a principal axis: 1/W falls as c t") {
  const auto g = made(diagonal(3, 4, 5), {1, 0, 0}, 0.4, 0.3, 6);
  const double l = 5;
  const auto top = steady_rotations(g, l)[1];
  const double c = algebraic_rate(g, l, top);
  auto motion = MomentumMotion::from(g, l, (top.direction + 0.2 * Vec3<double>(0, 0.6, 0.8)).normalized(), 0);
  const double dt = 0.04;
  for (double t = 0; t < 40; t += dt) motion.step(dt);
  const double first = top.level - motion.level();
  double time = 0;
  for (; time < 0.5 / (c * first); time += dt) motion.step(dt);
  CHECK((1 / first - 1 / (top.level - motion.level())) / (c * time) == Approx(1).epsilon(0.03));
}
