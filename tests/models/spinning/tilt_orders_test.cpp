// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/tilt_orders.hpp"

#include "catch.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "allocations.hpp"
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

using Real80 = long double;

State<Real80> true_state(const Problem<Real80>& p, Real80 t) {
  const std::array<Real80, 1> times{t};
  std::array<State<Real80>, 1> states;
  FullMotionOptions<Real80> options;
  options.tolerance = 1e-17L;
  const auto answer = full_motion<Real80>(p, times, states, options);
  REQUIRE(answer);
  REQUIRE(answer->status == ode::Status::reached);
  return states[0];
}

/// Angle between where two attitudes see inertial axis 3.
Real80 tilt_apart(const State<Real80>& a, const State<Real80>& b) {
  const Vec3<Real80> up(0, 0, 1);
  return (rotate<Real80>(conjugate(a.attitude), up) - rotate<Real80>(conjugate(b.attitude), up)).norm();
}

/// A stable spinner with some nutation, all that tilts it times `by`.
Problem<double> spinner(Spinners& random, bool symmetric, double by) {
  for (;;) {
    auto p = random.spinner(0.05);
    if (symmetric) p.inertia[1] = p.inertia[0];
    p.torque *= by;
    p.angular_velocity[0] = 0.01 * by * p.spin();
    p.angular_velocity[1] = -0.02 * by * p.spin();
    p.angles = {0.02 * by, -0.01 * by, 0.3};
    if (TiltOrders<double>(p, 30 / std::abs(p.spin())).known()) return p;
  }
}

}  // namespace

TEST_CASE("the second order of the spin angle is what the linear motion leaves out", "[spinning]") {
  for (unsigned seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    Real80 left[2];
    for (int k = 0; k < 2; ++k) {
      Spinners random(seed);
      const auto p = cast<Real80>(spinner(random, seed % 3 == 0, k == 0 ? 0.1 : 0.05));
      const Real80 end = 30 / std::abs(p.spin());
      const Real80 error = true_state(p, end).angles.theta - Linear<Real80>(p).at(end).angles.theta;
      const Real80 second = TiltOrders<Real80>(p, end).spin_angle(end);
      left[k] = std::abs(error - second);
      CHECK(left[k] < 0.1L * std::abs(error));
    }
    CHECK(std::log2(left[0] / left[1]) == Approx(4).margin(0.3));
  }
}

TEST_CASE("the third order of the tilt is what is left of a symmetric body's", "[spinning]") {
  for (unsigned seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    Spinners random(seed);
    const auto p = cast<Real80>(spinner(random, true, 0.05));
    const Real80 end = 30 / std::abs(p.spin());
    const SecondOrder<Real80> motion(p, end);
    for (const Real80 t : {0.21L * end, end}) {
      const Real80 error = tilt_apart(motion.at(t), true_state(p, t));
      CHECK(TiltOrders<Real80>(p, end).tilt(t) == Approx(double(error)).epsilon(0.02));
    }
  }
}

TEST_CASE("the errors at few times are sharp, and no smaller than the truth", "[spinning]") {
  Spinners random(77);
  std::vector<double> sharp;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const auto p = spinner(random, i % 2 == 0, random.log_any(0.003, 1));
    const std::vector<double> times{random.any(1, 200) / std::abs(p.spin())};
    const double T = times[0];
    const TiltOrders<double> orders(p, T);
    const auto left = second_order_errors(p, T);
    const auto right = true_state(cast<Real80>(p), T);
    const auto off = [&](const State<double>& s) {
      const Quat<Real80> q{s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z};
      const auto d = conjugate(right.attitude) * q;
      return 2 * std::atan2(double(std::hypot(d.x, d.y, d.z)), std::abs(double(d.w)));
    };
    if (!(left.size.tilt + left.tilt < small_tilt && left.theta < small_tilt)) continue;
    const double first = off(Linear<double>(p).at(T)), second = off(SecondOrder<double>(p, T).at(T));
    const double rounding = 1e-14 * (1 + std::abs(p.spin()) * T);
    const double of_first = attitude_error<double>(linear_errors(p, T), left, orders, times);
    const double of_second = attitude_error<double>(left, orders, times);
    CHECK(first <= of_first + rounding);
    CHECK(second <= of_second + rounding);
    sharp.push_back(of_first / first);
  }
  REQUIRE(sharp.size() > 30);
  std::sort(sharp.begin(), sharp.end());
  CHECK(sharp[sharp.size() / 2] < 1.3);
}

TEST_CASE("modes that are not apart tell nothing", "[spinning]") {
  Problem<double> p;
  p.inertia = {2, 2, 3};
  p.angular_velocity = {0, 0, 1};
  p.torque = {1e-3, 2e-3, 0};
  CHECK(TiltOrders<double>(p, 100).known());
  auto resonant = p;
  resonant.rotor_momentum = (p.inertia[0] + p.inertia[1] - p.inertia[2]) * p.spin();  // nu = r0
  auto unstable = p;
  unstable.inertia = {2, 4, 3};
  auto at_rest = p;
  at_rest.angular_velocity[2] = 0;
  for (const auto& q : {resonant, unstable, at_rest}) {
    const TiltOrders<double> orders(q, 100);
    CHECK_FALSE(orders.known());
    const std::vector<double> times{10, 100};
    const auto first = linear_errors(q, 100.0), second = second_order_errors(q, 100.0);
    CHECK(attitude_error<double>(first, second, orders, times) == first.attitude);
    CHECK(attitude_error<double>(second, orders, times) == second.attitude);
  }
}

TEST_CASE("the orders of the tilt do not touch the heap", "[spinning]") {
  Problem<double> p;
  p.inertia = {2, 2.5, 3};
  p.angular_velocity = {0, 0, 1};
  p.torque = {1e-3, 2e-3, 0};
  const std::array<double, 3> times{1, 10, 100};
  const auto before = allocations();
  const TiltOrders<double> orders(p, 100);
  const double error = attitude_error<double>(second_order_errors(p, 100.0), orders, times);
  CHECK(allocations() == before);
  CHECK(error > 0);
}
