// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/spin_angle.hpp"

#include "catch.hpp"

#include "gyrostat/rotation/exp_log.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

/// A free sphere: omega stands still in the body, the attitude turns about it.
struct Sphere {
  Problem<double> problem;

  SpinAngle<double>::Sample at(double t) const {
    const auto& a = problem.angles;
    const Vec3<double>& w = problem.angular_velocity;
    return {w, quaternion_from_312(a.psi, a.phi, a.theta) * quaternion_from_vector<double>(w * t), w[2] * t};
  }

  /// theta by steps so short that no turn is missed, unless cos(psi) comes nearer to zero than a step.
  double plain(double end) const {
    const int steps = int(40 * problem.angular_velocity.norm() * end) + 40;
    double theta = problem.angles.theta, t = 0;
    for (int i = 1; i <= steps; ++i) {
      const double to = end * i / steps;
      for (int part = 1; part <= 8; ++part) {
        const double now = t + (to - t) * part / 8;
        const double here = angles_312(at(now).attitude)[2];
        theta = here + 2 * pi<double> * std::round((theta - here) / (2 * pi<double>));
      }
      t = to;
    }
    return theta;
  }
};

}  // namespace

TEST_CASE("no turn is missed, however long the steps", "[spinning]") {
  Spinners random(1);
  int followed = 0;
  for (int i = 0; i < 150; ++i) {
    Sphere sphere{random.body(0)};
    auto& p = sphere.problem;
    p.inertia.setConstant(2);
    if (i % 3 == 0) p.angular_velocity = {0.1, -0.2, i % 2 == 0 ? 3.0 : -3.0}, p.angles = {0.1, -0.05, 7};
    const double step = random.log_any(0.01, 30) / p.angular_velocity.norm();
    SpinAngle<double> angle(p);
    CHECK(angle.angles().theta == Approx(p.angles.theta).margin(1e-14));
    const auto at = [&](double t) { return sphere.at(t); };
    double t = 0;
    for (int k = 0; k < 5; ++k) {
      t += step;
      angle.follow(t, at(t), at);
    }
    CHECK(std::remainder(angle.angles().theta - angles_312(at(t).attitude)[2], 2 * pi<double>) ==
          Approx(0).margin(1e-12));
    CHECK(angle.angles().psi == angles_312(at(t).attitude)[0]);
    if (angle.least_cosine() < 1e-3) continue;
    ++followed;
    CHECK(angle.angles().theta == Approx(sphere.plain(t)).margin(1e-9));
  }
  CHECK(followed > 140);
}

TEST_CASE("past cos(psi) = 0 on either side", "[spinning]") {
  // omega = e1 leads axis 3 through psi = pi/2 where phi = 0, and past it where phi = d
  for (const double d : {0.3, 1e-3, 1e-7, 1e-12}) {
    for (const double side : {-1.0, 1.0}) {
      CAPTURE(d, side);
      Sphere sphere;
      sphere.problem.angular_velocity = {1, 0, 0};
      sphere.problem.angles = {0, side * d, 0};
      const auto at = [&](double t) { return sphere.at(t); };
      SpinAngle<double> angle(sphere.problem);
      angle.follow(pi<double>, at(pi<double>), at);
      // half a turn of theta, back for phi > 0
      CHECK(angle.angles().theta == Approx(-side * pi<double>).epsilon(1e-9));
      CHECK(angle.least_cosine() <= std::sin(d) * (1 + 1e-3));
      CHECK(angle.least_cosine() >= (d > 1e-9 ? std::sin(d) / 20 : 0));
    }
  }
  // through it
  Sphere sphere;
  sphere.problem.angular_velocity = {1, 0, 0};
  const auto at = [&](double t) { return sphere.at(t); };
  SpinAngle<double> angle(sphere.problem);
  angle.follow(3, at(3), at);
  CHECK(angle.least_cosine() < 1e-14);
  CHECK(std::abs(angle.angles().theta) == Approx(pi<double>));
}

TEST_CASE("the bound on the way holds with torques", "[spinning]") {
  // theta of a body under torque against a plain sum of its rate, the motion by short steps of the mid-point rule
  Spinners random(3);
  for (int i = 0; i < 30; ++i) {
    const auto p = i % 2 == 0 ? random.spinner(0.3) : random.body(0.5);
    const double end = 12 / (p.angular_velocity.norm() + std::abs(p.gyroscopic()) / p.inertia.minCoeff());
    constexpr int steps = 4000;
    std::vector<SpinAngle<double>::Sample> samples;
    SpinAngle<double>::Sample now{p.angular_velocity, quaternion_from_312(p.angles.psi, p.angles.phi, p.angles.theta),
                                  0};
    const auto acceleration = [&](const Vec3<double>& w) -> Vec3<double> {
      const Vec3<double>& D = p.inertia;
      return {(p.torque[0] - w[1] * ((D[2] - D[1]) * w[2] + p.gyroscopic())) / D[0],
              (p.torque[1] + w[0] * ((D[2] - D[0]) * w[2] + p.gyroscopic())) / D[1],
              (p.torque[2] - (D[1] - D[0]) * w[0] * w[1]) / D[2]};
    };
    const double h = end / steps;
    SpinAngle<double> fine(p);
    for (int k = 0; k <= steps; ++k) {
      samples.push_back(now);
      const Vec3<double> half = now.angular_velocity + h / 2 * acceleration(now.angular_velocity);
      now = {now.angular_velocity + h * acceleration(half), now.attitude * quaternion_from_vector<double>(half * h),
             now.turned + h * half[2]};
    }
    const auto at = [&](double t) { return samples[std::size_t(std::lround(t / h))]; };
    double theta = p.angles.theta;
    for (int k = 1; k <= steps; ++k) {
      const double here = angles_312(samples[std::size_t(k)].attitude)[2];
      theta = here + 2 * pi<double> * std::round((theta - here) / (2 * pi<double>));
    }
    SpinAngle<double> angle(p);
    angle.follow(end, samples.back(), at);
    if (angle.least_cosine() > 0.05) CHECK(angle.angles().theta == Approx(theta).margin(1e-9));
  }
}

TEST_CASE("the start gives the turns of theta and the range of phi", "[spinning]") {
  Sphere sphere;
  auto& p = sphere.problem;
  p.angles = {0.2, 3.1, 100};
  CHECK(SpinAngle<double>(p).angles().phi == Approx(3.1));
  CHECK(SpinAngle<double>(p).angles().theta == Approx(100));
  p.angular_velocity = {0, 0.2, 0};
  SpinAngle<double> angle(p);
  const auto at = [&](double t) { return sphere.at(t); };
  angle.follow(1, at(1), at);
  CHECK(angle.angles().phi > pi<double>);  // within pi of the start
  // beyond pi/2 the angles keep to the side of the start
  for (const double psi : {2.0, -2.0, 4.0, 7.0, -20.0}) {
    CAPTURE(psi);
    p.angles = {psi, 0.1, 0.3};
    SpinAngle<double> beyond(p);
    CHECK(beyond.angles().psi == Approx(psi));
    CHECK(beyond.angles().phi == Approx(0.1));
    CHECK(beyond.angles().theta == Approx(0.3));
    beyond.follow(1, at(1), at);
    const auto b = beyond.angles();
    CHECK(std::abs(b.psi - psi) < 0.3);
    CHECK(std::abs(b.phi - 0.1) < 0.6);
    const Quat<double> d = conjugate(at(1).attitude) * quaternion_from_312(b.psi, b.phi, b.theta);
    CHECK(std::hypot(d.x, d.y, d.z) < 1e-14);
  }
}

TEST_CASE("where the search is cut into too many pieces theta is known but for turns", "[spinning]") {
  Problem<double> p;
  p.angular_velocity = {1, 0, 0};
  p.angles.psi = pi<double> / 2;
  SpinAngle<double> angle(p);
  const SpinAngle<double>::Sample stays{p.angular_velocity, quaternion_from_312(p.angles.psi, 0.0, 0.0), 0};
  angle.follow(1, stays, [&](double) { return stays; });
  CHECK(std::isfinite(angle.angles().theta));
  CHECK(angle.least_cosine() == 0);
}

TEST_CASE("a search to infinity ends", "[spinning]") {
  Problem<double> p;
  p.inertia = {1, 1.1, 2};
  p.torque = {.1, 0, 0};
  const SpinAngle<double>::Sample stays{p.angular_velocity, {1, 0, 0, 0}, 0};
  SpinAngle<double> angle(p);
  angle.follow(gyrostat::infinity<double>, stays, [&](double) { return stays; });
  CHECK(angle.least_cosine() >= 0);
}

TEST_CASE("what is not a number ends the search", "[spinning]") {
  Sphere sphere;
  sphere.problem.angular_velocity = {0, gyrostat::nan<double>, 1};
  SpinAngle<double> angle(sphere.problem);
  angle.follow(1, sphere.at(1), [&](double t) { return sphere.at(t); });
  CHECK(std::isnan(angle.angles().psi));
}
