// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/second_order.hpp"

#include "catch.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "allocations.hpp"
#include "at_length.hpp"
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

using Real80 = long double;

template <std::size_t count>
std::array<State<Real80>, count> true_states(const Problem<Real80>& p, const std::array<Real80, count>& times) {
  std::array<State<Real80>, count> states;
  FullMotionOptions<Real80> options;
  options.tolerance = 1e-16L;
  const auto answer = full_motion<Real80>(p, times, states, options);
  REQUIRE(answer);
  REQUIRE(answer->status == ode::Status::reached);
  return states;
}

State<Real80> true_end(const Problem<Real80>& p, Real80 t) { return true_states<1>(p, {t})[0]; }

Real80 tilt_error(const State<Real80>& a, const State<Real80>& b) {
  return std::hypot(a.angles.psi - b.angles.psi, a.angles.phi - b.angles.phi);
}

/// r, theta, transverse and axial momentum, velocity, position.
std::array<Real80, 8> errors(const State<Real80>& a, const State<Real80>& b) {
  const auto across = [](const Vec3<Real80>& x, const Vec3<Real80>& y) { return (x - y).head<2>().norm(); };
  return {std::abs(a.angular_velocity[2] - b.angular_velocity[2]),
          std::abs(a.angles.theta - b.angles.theta),
          across(a.momentum_I, b.momentum_I),
          std::abs(a.momentum_I[2] - b.momentum_I[2]),
          across(a.velocity, b.velocity),
          std::abs(a.velocity[2] - b.velocity[2]),
          across(a.position, b.position),
          std::abs(a.position[2] - b.position[2])};
}

/// Torque, start and with them the tilt scaled.
Problem<Real80> scaled(Problem<Real80> p, Real80 s) {
  p.torque *= s;
  p.angles.psi *= s;
  p.angles.phi *= s;
  p.angular_velocity[0] *= s;
  p.angular_velocity[1] *= s;
  return p;
}

/// The integrals by Gauss's rule over the linear motion: rho, its integral, the nutation's phase, int |Gamma|^2/2, its integral.
std::array<Real80, 5> quadrature(const Problem<Real80>& p, Real80 t) {
  constexpr Real80 node[] = {0.183434642495649804939L, 0.525532409916328985818L, 0.796666477413626739592L,
                             0.960289856497536231684L};
  constexpr Real80 weight[] = {0.362683783378361982965L, 0.313706645877887287338L, 0.222381034453374470544L,
                               0.101228536290376259153L};
  const Linear<Real80> linear(p);
  const Real80 skew = (p.inertia[0] - p.inertia[1]) / p.inertia[2];
  const int panels = 1 + int(t * (std::abs(p.spin()) + std::abs(p.kappa1(p.spin())) + std::abs(p.kappa2(p.spin()))));
  std::array<Real80, 5> sum{};
  for (int k = 0; k < panels; ++k) {
    for (int j = 0; j < 8; ++j) {
      const Real80 half = t / (2 * panels);
      const Real80 at = (2 * k + 1) * half + (j < 4 ? half : -half) * node[j % 4];
      const auto s = linear.at(at);
      const Real80 w = half * weight[j % 4];
      const Real80 pq = s.angular_velocity[0] * s.angular_velocity[1] * skew;
      const Real80 loss = (s.angles.psi * s.angles.psi + s.angles.phi * s.angles.phi) / 2;
      sum[0] += w * pq;
      sum[1] += w * pq * (t - at);
      sum[2] += w * (s.angular_velocity[1] * s.angles.psi - s.angular_velocity[0] * s.angles.phi) / 2;
      sum[3] += w * loss;
      sum[4] += w * loss * (t - at);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("orders in the tilt", "[spinning]") {
  Spinners random(3);
  int seen = 0;
  while (seen < 8) {
    auto base = random.spinner(0.05);
    if (base.nutation_squared() < 0) continue;
    const bool charged = seen % 2 == 0, pushed = seen % 4 < 2;
    if (!charged) base.charge_momentum = 0;
    if (!pushed) base.force[0] = base.force[1] = 0;
    base.angular_velocity[0] = 0.01 * base.spin();
    base.angular_velocity[1] = -0.02 * base.spin();
    const auto p = cast<Real80>(base);
    const Real80 end = 60 / std::abs(p.spin());
    ++seen;
    std::array<Real80, 8> linear[2], second[2];
    for (int k = 0; k < 2; ++k) {
      const auto q = scaled(p, k == 0 ? 0.1L : 0.05L);
      const auto right = true_end(q, end);
      linear[k] = errors(Linear<Real80>(q).at(end), right);
      second[k] = errors(SecondOrder<Real80>(q, end).at(end), right);
    }
    const auto slope = [](const auto& e, int i) { return std::log2(e[0][std::size_t(i)] / e[1][std::size_t(i)]); };
    CAPTURE(seen);
    CHECK(slope(linear, 0) == Approx(2).margin(0.15));
    CHECK(slope(linear, 1) == Approx(2).margin(0.15));
    CHECK(slope(linear, 2) == Approx(3).margin(0.15));
    CHECK(slope(second, 0) == Approx(4).margin(0.15));
    CHECK(slope(second, 1) == Approx(4).margin(0.15));
    CHECK(slope(second, 2) == Approx(charged ? 3 : 5).margin(charged ? 0.5 : 0.3));
    if (pushed) {
      CHECK(slope(linear, 4) == Approx(2).margin(0.3));
      CHECK(slope(second, 4) == Approx(3).margin(0.3));
      CHECK(slope(second, 6) > 2.7);
    } else {
      CHECK(slope(linear, 5) == Approx(2).margin(0.15));
      CHECK(slope(second, 5) == Approx(4).margin(0.15));
      CHECK(slope(second, 7) == Approx(4).margin(0.15));
    }
  }
}

TEST_CASE("the tilt of a symmetric body errs no more after many turns", "[spinning][length]") {
  Spinners random(8);
  int seen = 0;
  for (int i = 0; seen < at_length(2, 5); ++i) {
    CAPTURE(i);
    auto p = random.spinner(0.002);
    p.inertia[1] = p.inertia[0];
    p.angular_velocity[0] = 0.001 * p.spin();
    if (i % 2 == 0) p.angles.psi = 0.002, p.angles.phi = -0.001;
    if (spinning::detail::third_order_swing(p, 1e9) > 10 / std::abs(p.spin())) continue;
    ++seen;
    Real80 linear[2], second[2], stated[2];
    for (int k = 0; k < 2; ++k) {
      const Real80 end = (k == 0 ? 60 : 1000) / std::abs(p.spin());
      linear[k] = second[k] = 0;
      const auto q = cast<Real80>(p);
      const SecondOrder<Real80> motion(q, end);
      REQUIRE(motion.applies());
      std::array<Real80, 5> times;
      for (int j = 0; j < 5; ++j) times[std::size_t(j)] = end - 7 * (4 - j) / std::abs(q.spin());
      const auto right = true_states(q, times);
      for (std::size_t j = 0; j < 5; ++j) {
        linear[k] = std::max(linear[k], tilt_error(Linear<Real80>(q).at(times[j]), right[j]));
        second[k] = std::max(second[k], tilt_error(motion.at(times[j]), right[j]));
      }
      stated[k] = second_order_errors(q, end).tilt;
      CHECK(second[k] < stated[k]);
    }
    CHECK(linear[1] > 6 * linear[0]);
    CHECK(second[1] < 3 * second[0]);
    CHECK(second[1] < linear[1] / 10);
    CHECK(stated[1] < 100 * second[1]);
  }
}

TEST_CASE("the integrals at any stiffness", "[spinning]") {
  Spinners random(4);
  for (int i = 0; i < 24; ++i) {
    CAPTURE(i);
    auto base = random.spinner(0.1);
    const double r0 = base.spin();
    base.angular_velocity[0] = 0.02 * std::abs(r0);
    const auto& D = base.inertia;
    base.charge_momentum = 0;
    if (i % 8 == 0) base.rotor_momentum = -D[2] * r0;                        // X = 0
    if (i % 8 == 1) base.rotor_momentum = (D[0] + D[1] - D[2]) * r0;         // X = r0 (D1 + D2)
    if (i % 8 == 2) base.rotor_momentum = -(D[2] - D[1]) * r0;               // kappa1 = 0
    if (i % 8 == 3) base.rotor_momentum = -(D[2] - (D[0] + D[1]) / 2) * r0;  // nu^2 < 0
    if (i % 8 == 4) base.inertia.setConstant(2), base.rotor_momentum = 0;    // sphere
    if (i % 8 == 5) base.rotor_momentum = -D[2] * r0 * (1 + 1e-9);
    if (i % 8 == 6) base.angular_velocity = {1e-3, 2e-3, 0}, base.rotor_momentum = 0;  // no spin
    const auto p = cast<Real80>(base);
    const double span = (i % 8 == 6   ? 5.0
                         : i % 8 == 3 ? 3.0
                                      : 30.0) /
                        std::max(std::abs(base.spin()), 0.3 * std::abs(r0));
    const SecondOrder<double> second(base, span);
    REQUIRE(second.applies());
    const SecondOrder<Real80> fine(p, Real80(span));
    const Linear<Real80> linear(p);
    const Real80 f3 = p.force[2] / p.mass;
    for (const double share : {0.013, 0.37, 1.0}) {
      const double t = share * span;
      const auto wanted = quadrature(p, t);
      const auto found = second.at(t);
      const auto l = linear.at(t);
      // the sizes the integrals reach anywhere up to t
      const Real80 rho = std::max(std::abs(wanted[0]), std::abs(quadrature(p, t / 2)[0]));
      CHECK(std::abs(found.angular_velocity[2] - p.spin() - wanted[0]) < 1e-10L * rho + 1e-15L * std::abs(p.spin()));
      CHECK(std::abs(second.phase(t) - wanted[1] - wanted[2]) <
            1e-10L * (std::abs(wanted[1]) + std::abs(wanted[2]) + std::abs(second.phase(span)) * share * share));
      CHECK(std::abs(found.velocity[2] - l.velocity[2] + f3 * wanted[3]) <
            1e-10L * std::abs(f3 * wanted[3]) + 1e-14L * std::abs(l.velocity[2]));
      CHECK(std::abs(found.position[2] - l.position[2] + f3 * wanted[4]) <
            1e-10L * std::abs(f3 * wanted[4]) + 1e-14L * std::abs(l.position[2]));
      // double against long double, all columns
      const auto right = fine.at(Real80(t));
      CHECK((found.momentum_I.cast<Real80>() - right.momentum_I).norm() < 1e-12L * right.momentum_I.norm());
      CHECK((found.velocity.cast<Real80>() - right.velocity).norm() < 1e-12L * right.velocity.norm());
      CHECK((found.position.cast<Real80>() - right.position).norm() < 1e-12L * right.position.norm());
      CHECK(std::abs(found.angles.theta - right.angles.theta) < 1e-13L * (1 + std::abs(right.angles.theta)));
    }
  }
}

TEST_CASE("corrections help where they say so, and their errors are stated", "[spinning]") {
  Spinners random(5);
  int helped = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    auto p = random.spinner(random.log_any(1e-3, 0.5));
    if (p.nutation_squared() < 0) continue;
    if (i % 3 == 0) p.charge_momentum = 0;
    if (i % 2 == 0) p.force[0] = p.force[1] = 0;
    const double end = random.log_any(1, 40) * 6.3 / std::abs(p.spin());
    const SecondOrder<double> second(p, end);
    if (!second.helps()) continue;
    ++helped;
    const auto stated = second_order_errors(p, end);
    const auto e = errors(
        [&] {
          const auto s = second.at(end);
          return State<Real80>{s.angular_velocity.cast<Real80>(),
                               {s.angles.psi, s.angles.phi, s.angles.theta},
                               {s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z},
                               s.momentum_I.cast<Real80>(),
                               s.velocity.cast<Real80>(),
                               s.position.cast<Real80>()};
        }(),
        true_end(cast<Real80>(p), end));
    const double limits[] = {stated.spin,     stated.theta,          stated.momentum, stated.axial_momentum,
                             stated.velocity, stated.axial_velocity, stated.position, stated.axial_position};
    const auto s = second.at(end);
    const double size[] = {std::abs(s.angular_velocity[2]),
                           std::abs(s.angles.theta),
                           s.momentum_I.norm(),
                           s.momentum_I.norm(),
                           s.velocity.norm(),
                           s.velocity.norm(),
                           s.position.norm(),
                           s.position.norm()};
    for (std::size_t k = 0; k < 8; ++k) {
      CAPTURE(k);
      CHECK(e[k] <= limits[k] + 1e-13 * size[k]);
    }
  }
  CHECK(helped > 25);
}

TEST_CASE("on the published data the corrections would harm", "[spinning]") {
  Problem<double> p;
  p.inertia = {8.7, 8.6, 11.1};
  p.mass = 10;
  p.torque = {4, 0, 0};
  p.force = {0, 0, 3};
  p.rotor_momentum = 1.3;
  p.charge_momentum = 0.291;
  p.angular_velocity = {0, 0, 0.28274};
  const SecondOrder<double> second(p, 50);
  CHECK(second.applies());
  CHECK(!second.helps());
}

TEST_CASE("where the second-order motion does not apply", "[spinning]") {
  auto p = Spinners(6).spinner(0.01);
  const double end = 10 / std::abs(p.spin());
  CHECK(SecondOrder<double>(p, end).applies());
  const auto start = SecondOrder<double>(p, end).at(0);
  CHECK(start.angular_velocity == p.angular_velocity);
  CHECK(start.angles.theta == p.angles.theta);
  CHECK((start.momentum_I - inertial_momentum(p, start.angular_velocity, start.attitude)).norm() <
        1e-12 * start.momentum_I.norm());
  for (const double t : {-0.1 * end, 1.1 * end, gyrostat::nan<double>})
    CHECK(std::isnan(SecondOrder<double>(p, end).at(t).angles.theta));
  CHECK(!SecondOrder<double>(p, 1e12 / std::abs(p.spin())).applies());
  p.torque[2] = 1;
  CHECK(!SecondOrder<double>(p, end).applies());
  p.torque[2] = 0;
  p.angular_velocity[2] = gyrostat::nan<double>;
  CHECK(std::isnan(SecondOrder<double>(p, end).at(end).angles.theta));
}

TEST_CASE("the second-order motion does not touch the heap", "[spinning]") {
  const auto p = Spinners(7).spinner(0.01);
  const double end = 10 / std::abs(p.spin());
  const auto before = allocations();
  const SecondOrder<double> second(p, end);
  const auto state = second.at(end);
  CHECK(allocations() == before);
  CHECK(state.angular_velocity.allFinite());
}
