// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/published.hpp"

#include <algorithm>
#include <array>

#include "catch.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using published::Motion;
using published::Reading;

namespace {

using C = math::Complex<double>;

/// The data of the figures: lambda3 = 1.3, e = 0.003, M1 = 4.
template <class S = double>
Problem<S> figures() {
  Problem<S> p;
  p.inertia = {S(8.7), S(8.6), S(11.1)};
  p.mass = 10;
  p.rotor_momentum = S(1.3);
  p.charge_momentum = S(0.003) * 100 * S(1.02) * S(1.02) * std::cos(S(0.37));
  p.torque = {4, 0, 0};
  p.force = {0, 0, 3};
  p.angular_velocity = {0, 0, S(2.7) * pi<S> / 30};
  return p;
}

/// That body with every term of the formulas.
template <class S = double>
Problem<S> generic() {
  Problem<S> p = figures<S>();
  p.torque = {S(0.04), S(-0.02), 0};
  p.force = {S(0.3), S(-0.2), 3};
  p.angular_velocity = {S(0.002), S(-0.003), p.spin()};
  p.angles = {S(0.004), S(-0.002), S(0.3)};
  p.velocity = {S(0.1), S(-0.2), S(0.3)};
  p.position = {1, 2, 3};
  return p;
}

template <class S = double>
Problem<S> symmetric() {
  Problem<S> p = generic<S>();
  p.inertia = {S(8.6), S(8.6), S(11.1)};
  return p;
}

/// Error of each value, and its size in the truth: rates, tilt, G, v, v3, x, x3.
struct Compared {
  std::array<double, 7> error, size;

  double relative() const {
    double worst = 0;
    for (std::size_t i = 0; i < 7; ++i) worst = std::max(worst, error[i] / size[i]);
    return worst;
  }
};

template <class S>
Compared compare(const published::Values<double>& y, const State<S>& s) {
  Compared made;
  const auto pair = [&](std::size_t i, C value, S re, S im) {
    made.error[i] = double(std::hypot(S(value.re) - re, S(value.im) - im));
    made.size[i] = double(std::hypot(re, im));
  };
  pair(0, y.rates, s.angular_velocity[0], s.angular_velocity[1]);
  pair(1, y.tilt, s.angles.psi, s.angles.phi);
  pair(2, y.momentum, s.momentum_I[0], s.momentum_I[1]);
  pair(3, y.velocity, s.velocity[0], s.velocity[1]);
  pair(4, {y.axial_velocity, 0}, s.velocity[2], 0);
  pair(5, y.position, s.position[0], s.position[1]);
  pair(6, {y.axial_position, 0}, s.position[2], 0);
  return made;
}

Compared compare(const Problem<double>& p, Reading reading, double t) {
  return compare(Motion<double>(p, reading).at(t), Linear<double>(p).at(t));
}

/// The linear motion in the words of the paper.
published::Values<double> values(const State<double>& s) {
  const auto pair = [](const Vec3<double>& v) { return C{v[0], v[1]}; };
  return {pair(s.angular_velocity),
          {s.angles.psi, s.angles.phi},
          s.angles.theta,
          pair(s.momentum_I),
          pair(s.momentum_I),
          pair(s.velocity),
          s.velocity[2],
          pair(s.position),
          s.position[2]};
}

double distance(C value, double re, double im) { return std::hypot(value.re - re, value.im - im); }

/// d/dt of a complex value by differences of sixth order.
template <class F>
math::Complex<long double> slope(const F& f, long double t) {
  const long double h = 1e-3L;
  return (45 * (f(t + h) - f(t - h)) - 9 * (f(t + 2 * h) - f(t - 2 * h)) + (f(t + 3 * h) - f(t - 3 * h))) / (60 * h);
}

/// How far the published motion is from the equations that it was derived from, (9), (19), (40), (41), (55), (62), as parts of
/// the rates themselves: rates, tilt, v, v3, x, x3.
std::array<double, 6> residuals(const Problem<long double>& p, Reading reading, long double t) {
  using W = math::Complex<long double>;
  const Motion<long double> motion(p, reading);
  const auto y = motion.at(t);
  const W f{p.force[0], p.force[1]};
  // the equation of Pi1 in p and q, with one frequency for both
  const auto D = p.inertia;
  const long double ratio = std::sqrt(std::abs((D[2] - D[1]) * D[1] / ((D[2] - D[0]) * D[0]))), nu = motion.nutation();
  const W rate{p.torque[0] / D[0] - ratio * nu * y.rates.im, p.torque[1] / D[1] + nu / ratio * y.rates.re};
  const W push = math::unit(y.spin_angle) * (f - p.force[2] * math::turned(y.tilt)) / p.mass;
  const long double axial = (p.force[2] + math::turned(math::conjugate(f) * y.tilt).re) / p.mass;
  const auto part = [](W is, W wanted) { return double(math::magnitude(is - wanted) / math::magnitude(wanted)); };
  return {part(slope([&](long double s) { return motion.at(s).rates; }, t), rate),
          part(slope([&](long double s) { return motion.at(s).tilt; }, t), y.rates - p.spin() * math::turned(y.tilt)),
          part(slope([&](long double s) { return motion.at(s).velocity; }, t), push),
          part(slope([&](long double s) { return W{motion.at(s).axial_velocity, 0}; }, t), {axial, 0}),
          part(slope([&](long double s) { return motion.at(s).position; }, t), y.velocity),
          part(slope([&](long double s) { return W{motion.at(s).axial_position, 0}; }, t), {y.axial_velocity, 0})};
}

}  // namespace

TEST_CASE("corrected, the published forms solve the equations they come from", "[spinning]") {
  auto prolate = generic<long double>();
  prolate.inertia = {8.7L, 8.6L, 5};
  auto backwards = generic<long double>();
  backwards.angular_velocity[2] *= -1;
  backwards.rotor_momentum *= -1;
  for (const auto& p : {generic<long double>(), symmetric<long double>(), prolate, backwards}) {
    for (const long double t : {0.3L, 4.0L, 31.0L})
      for (const double part : residuals(p, Reading::corrected, t)) CHECK(part < 1e-12);
    const auto start = Motion<long double>(p, Reading::corrected).at(0);
    const auto apart = [](math::Complex<long double> is, long double re, long double im) {
      return std::hypot(is.re - re, is.im - im);
    };
    CHECK(apart(start.rates, p.angular_velocity[0], p.angular_velocity[1]) < 1e-18L);
    CHECK(apart(start.tilt, p.angles.psi, p.angles.phi) < 1e-18L);
    CHECK(apart(start.velocity, p.velocity[0], p.velocity[1]) < 1e-18L);
    CHECK(std::abs(start.axial_velocity - p.velocity[2]) < 1e-18L);
    CHECK(apart(start.position, p.position[0], p.position[1]) < 1e-16L);
    CHECK(std::abs(start.axial_position - p.position[2]) < 1e-16L);
  }
}

TEST_CASE("corrected, the published forms are the linear motion where D1 = D2 or Lambda = 0", "[spinning]") {
  Spinners spinners(21);
  for (int trial = 0; trial < 200; ++trial) {
    auto p = generic();
    const double D = spinners.any(4, 9);
    p.inertia = {D, D, spinners.any(1, 1.9 * D)};
    p.angular_velocity[2] = spinners.any(0.3, 3) * (trial % 2 ? 1 : -1);
    p.rotor_momentum = spinners.any(-3, 3);
    if (trial % 3 == 0) {
      p.inertia = {D, spinners.any(0.8, 1.2) * D, spinners.any(1, 1.9 * D)};
      p.rotor_momentum = p.charge_momentum;
      if (!(p.nutation_squared() > 0)) continue;
    }
    if (divisors(p).least() < 0.1) continue;
    for (const double t : {2.0, 20.0}) {
      INFO(trial << " D " << p.inertia.transpose() << " r0 " << p.spin() << " t " << t);
      CHECK(compare(p, Reading::corrected, t).relative() < 1e-9);
      const auto balance = Motion<double>(p, Reading::corrected).at(t).circle;
      const auto G = Linear<double>(p).at(t).momentum_I;
      CHECK(distance(balance, G[0], G[1]) < 1e-12 * G.head<2>().norm());
    }
  }
}

TEST_CASE("with kappa for zeta the published forms are the linear motion of any stable body", "[spinning]") {
  Spinners spinners(22);
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto p = spinners.spinner(0.1);
    const auto limits = divisors(p);
    if (!(p.nutation_squared() > 0) || limits.least() < 0.1 * limits.sum) continue;
    ++seen;
    INFO(trial << " D " << p.inertia.transpose() << " r0 " << p.spin());
    CHECK(compare(p, Reading::exact, 20 / limits.sum).relative() < 1e-10);
  }
  CHECK(seen > 60);
}

TEST_CASE("the figures' frequency is not that of their body", "[spinning]") {
  const auto p = figures();
  const double nu = Motion<double>(p, Reading::exact).nutation();
  CHECK(nu == Approx(0.19673).margin(5e-6));
  CHECK(nu == Approx(std::sqrt(p.nutation_squared())).epsilon(1e-14));
  CHECK(Motion<double>(p, Reading::printed).nutation() / nu - 1 == Approx(-0.0120).margin(5e-5));
  CHECK(Motion<double>(p, Reading::corrected).nutation() == Motion<double>(p, Reading::printed).nutation());
  // 0.12 rad at the end of the figures
  CHECK(50 * (nu - Motion<double>(p, Reading::printed).nutation()) == Approx(0.118).margin(5e-4));
  // residual of (9) in the rates: it stands for two equations with different frequencies
  auto far = p;
  far.inertia = {8.7, 8, 11.1};
  far.torque[0] = 0.1;
  const auto off = compare(far, Reading::corrected, 50);
  CHECK(off.error[0] > 0.3 * off.size[0]);
}

TEST_CASE("misprints of (46) and (61): velocity and position across", "[spinning]") {
  // as printed the figures' own position starts ten metres off
  const auto p = figures();
  const auto start = Motion<double>(p, Reading::printed).at(0);
  CHECK(math::magnitude(start.velocity) == 0);
  CHECK(math::magnitude(start.position) > 5);
  CHECK(math::magnitude(Motion<double>(p, Reading::corrected).at(0).position) < 1e-13);
  const auto off = compare(p, Reading::printed, 0.5);
  CHECK(off.size[3] == Approx(2.87e-3).epsilon(2e-3));
  CHECK(off.error[3] == Approx(0.0853).epsilon(2e-3));
  const auto broken = residuals(generic<long double>(), Reading::printed, 4);
  CHECK(broken[0] < 1e-13);
  CHECK(broken[1] < 1e-13);
  CHECK(broken[2] > 1e-3);
  CHECK(broken[4] > 1e-3);
  // D1 = D2 hides them: (58) is left
  const auto hidden = residuals(symmetric<long double>(), Reading::printed, 4);
  CHECK(hidden[2] < 1e-13);
  CHECK(hidden[4] > 1e-3);
}

TEST_CASE("misprint of (58): the sign of the transverse force", "[spinning]") {
  const auto p = symmetric();
  const Motion<double> printed(p, Reading::printed), corrected(p, Reading::corrected);
  const C f{p.force[0] / p.mass, p.force[1] / p.mass};
  const double r0 = p.spin();
  for (const double t : {0.0, 0.5, 8.0}) {
    const C apart = printed.at(t).position - corrected.at(t).position;
    const C wanted = (2 / (r0 * r0)) * (math::unit(p.angles.theta) * (f * (math::unit(r0 * t) - C{1, 0})));
    CHECK(math::magnitude(apart - wanted) < 1e-12);
  }
  const double off = compare(p, Reading::printed, 0.5).error[5];
  CHECK(off > 0.05);
  CHECK(off < 0.15);
}

TEST_CASE("structural misprints of (50), (51), (65), (66): velocity and position along the axis", "[spinning]") {
  for (const auto& p : {symmetric<long double>(), generic<long double>()}) {
    const auto broken = residuals(p, Reading::printed, 8);
    CHECK(broken[3] > 1e-3);
    CHECK(broken[5] > 1e-4);  // nor is (63) the integral of (47)
  }
  // hidden in every figure, for f1 = f2 = 0
  const auto still = compare(figures(), Reading::printed, 50);
  CHECK(still.error[4] == 0);
  CHECK(still.error[6] == 0);
  CHECK(still.size[4] == Approx(15));
  CHECK(still.size[6] == Approx(375));
  const auto printed = compare(generic(), Reading::printed, 50), corrected = compare(generic(), Reading::corrected, 50);
  CHECK(printed.error[4] == Approx(0.0125).epsilon(0.01));
  CHECK(corrected.error[4] == Approx(0.0033).epsilon(0.01));
  CHECK(printed.error[6] == Approx(0.274).epsilon(0.01));
  CHECK(corrected.error[6] == Approx(0.051).epsilon(0.01));
}

TEST_CASE("the two momenta (33) and (35) of the figures", "[spinning]") {
  const auto p = figures();
  const Motion<double> printed(p, Reading::printed), exact(p, Reading::exact);
  double apart = 0, apart_as_printed = 0, most = 0;
  for (int i = 0; i <= 5000; ++i) {
    const auto y = exact.at(0.01 * i), n = printed.at(0.01 * i);
    apart = std::max(apart, math::magnitude(y.momentum - n.circle));
    apart_as_printed = std::max(apart_as_printed, math::magnitude(n.momentum - n.circle));
    most = std::max(most, y.momentum.im);
    CHECK(math::magnitude(y.momentum - y.circle) < 1e-12);
  }
  CHECK(most == Approx(32.60).margin(0.005));
  CHECK(apart == Approx(4.6).margin(0.05));
  CHECK(apart_as_printed == Approx(4.87).margin(0.005));
  // without charge (35) holds, whatever the rotor; (33) with the printed frequency still depends on it
  auto neutral = p;
  neutral.charge_momentum = 0;
  double artefact = 0;
  for (const double lambda3 : {1.3, 1.6, 1.9}) {
    neutral.rotor_momentum = lambda3;
    const Motion<double> right(neutral, Reading::exact), near(neutral, Reading::printed);
    for (double t = 1; t <= 50; t += 0.5) {
      CHECK(math::magnitude(right.at(t).momentum - near.at(t).circle) < 1e-12);
      artefact = std::max(artefact, math::magnitude(near.at(t).momentum - near.at(t).circle));
    }
  }
  CHECK(artefact > 1.8);
  // the text on figure 12: wrong units, and the root over D3 r0^2
  const auto text = published::momentum_circle(p, Reading::printed),
             circle = published::momentum_circle(p, Reading::corrected);
  CHECK(text.radius == Approx(4.25).margin(0.005));
  CHECK(circle.radius == Approx(14.15).margin(0.005));
  CHECK(text.centre.im == Approx(4.508).margin(5e-4));
  CHECK(circle.centre.im == Approx(14.15).margin(0.005));
}

TEST_CASE("(53), (54): the velocity goes to a ratio that knows the rotor and the charge", "[spinning]") {
  const auto p = figures();
  CHECK(published::secular_velocity_ratio(p, Reading::printed).im == Approx(4.508).margin(5e-4));
  CHECK(published::secular_velocity_ratio(p, Reading::corrected).im == Approx(3.411).margin(5e-4));
  CHECK(published::secular_velocity_ratio(p, Reading::corrected).re == Approx(0).margin(1e-15));
  for (auto q : {generic(), symmetric()}) {
    q.angular_velocity = {0, 0, q.spin()};
    q.angles = {0, 0, 0.3};
    q.velocity.setZero();
    const auto late = Linear<double>(q).at(1e6).velocity;
    const C reached{late[0] / late[2], late[1] / late[2]};
    const C right = published::secular_velocity_ratio(q, Reading::corrected);
    CHECK(math::magnitude(reached - right) < 1e-4 * math::magnitude(right));
    const C printed = published::secular_velocity_ratio(q, Reading::printed);
    CHECK(math::magnitude(reached - printed) > 0.2 * math::magnitude(right));
    // right without rotor and charge
    q.rotor_momentum = q.charge_momentum = 0;
    q.angles.theta = 0;
    CHECK(published::secular_velocity_ratio(q, Reading::printed) ==
          published::secular_velocity_ratio(q, Reading::corrected));
  }
}

TEST_CASE("(30) as printed is no rotation", "[spinning]") {
  const Angles<double> angles{0.1, -0.2, 0.7};
  const auto right = published::direction_cosines(angles, Reading::corrected);
  const auto printed = published::direction_cosines(angles, Reading::printed);
  CHECK((right * right.transpose() - Mat3<double>::Identity()).norm() < 1e-15);
  const Vec3<double> x = printed.row(0), y = printed.row(1), z = printed.row(2);
  CHECK(std::abs(x.dot(cross<double>(y, z)) - 1) > 1e-3);
  const auto change = printed - right;
  CHECK(change.norm() == std::abs(change(1, 2)));
  CHECK(right(1, 2) == Approx(std::sin(0.7) * std::sin(-0.2) - std::cos(0.7) * std::sin(0.1) * std::cos(-0.2)));
}

TEST_CASE("the printed roots fail for a prolate body, and all but the linear motion about the middle axis",
          "[spinning]") {
  auto p = symmetric();
  p.inertia[2] = 5;
  const auto printed = compare(p, Reading::printed, 5);
  CHECK(printed.error[0] > 0.5 * printed.size[0]);
  CHECK(compare(p, Reading::corrected, 5).relative() < 1e-10);
  p.inertia = {8, 11, 9};
  for (const auto reading : {Reading::printed, Reading::corrected})
    CHECK_FALSE(std::isfinite(Motion<double>(p, reading).at(5).rates.re));
  CHECK(std::isfinite(Linear<double>(p).at(5).angular_velocity[0]));
  auto sphere = generic();
  sphere.inertia = {9, 9, 9};
  CHECK_FALSE(std::isfinite(Motion<double>(sphere, Reading::corrected).at(5).rates.re));
  auto still = generic();
  still.angular_velocity[2] = 0;
  CHECK_FALSE(std::isfinite(Motion<double>(still, Reading::exact).at(5).tilt.re));
}

TEST_CASE("what the published forms lose near a resonance", "[spinning]") {
  // tilt, v and x lose eps/delta, its square and its cube
  double before[3] = {};
  for (const double X : {1e-2, 1e-4, 1e-6}) {
    auto p = generic();
    p.inertia = {8, 8, 12};
    p.angular_velocity[2] = 1;
    p.charge_momentum = 0;
    p.rotor_momentum = X - 12;
    const auto truth = Linear<long double>(spinning::detail::problem_cast<long double>(p)).at(10);
    const auto ours = compare(values(Linear<double>(p).at(10)), truth);
    const auto lost = compare(Motion<double>(p, Reading::corrected).at(10), truth);
    const auto part = [](const Compared& made, std::size_t i) { return made.error[i] / made.size[i]; };
    INFO(X << " " << part(lost, 1) << " " << part(lost, 3) << " " << part(lost, 5));
    CHECK(ours.relative() < 2e-13);
    CHECK(part(lost, 3) > 20 * before[1]);
    CHECK(part(lost, 5) > 1e3 * before[2]);
    before[0] = part(lost, 1), before[1] = part(lost, 3), before[2] = part(lost, 5);
  }
  CHECK(before[0] < 1e-7);
  CHECK(before[1] > 1e-7);
  CHECK(before[2] > 1e-2);  // no digit left
}
