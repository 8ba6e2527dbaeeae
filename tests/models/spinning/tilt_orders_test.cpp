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
    if (TiltOrders<double>(p, 30 / std::abs(p.spin())).knows_tilt()) return p;
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
    const double of_first = linear_attitude_error<double>(linear_errors(p, T), left, orders, times);
    const double of_second = second_order_attitude_error<double>(left, orders, times);
    CHECK(first <= of_first + rounding);
    CHECK(second <= of_second + rounding);
    sharp.push_back(of_first / first);
  }
  REQUIRE(sharp.size() > 30);
  std::sort(sharp.begin(), sharp.end());
  CHECK(sharp[sharp.size() / 2] < 1.3);
}

TEST_CASE("the third order of the tilt is known at resonances of a symmetric body, not of an asymmetric one",
          "[spinning]") {
  Problem<double> p;
  p.inertia = {2, 2, 3};
  p.angular_velocity = {0, 0, 1};
  p.torque = {1e-5, 2e-5, 0};
  auto resonant = p;
  resonant.rotor_momentum = (p.inertia[0] + p.inertia[1] - p.inertia[2]) * p.spin();  // nu = r0
  auto without = p;
  without.inertia[2] = 2;  // nu = 0
  auto disc = p;
  disc.inertia[2] = 4;  // nu = r0, and a mode that stands still
  for (const auto& q : {p, resonant, without, disc}) {
    const TiltOrders<Real80> orders(cast<Real80>(q), 30);
    REQUIRE(orders.knows_tilt());
    const SecondOrder<Real80> motion(cast<Real80>(q), 30);
    for (const Real80 t : {11.3L, 30.0L}) {
      const Real80 error = tilt_apart(motion.at(t), true_state(cast<Real80>(q), t));
      CHECK(orders.tilt(t) == Approx(double(error)).epsilon(0.01));
    }
  }
  auto unstable = p;
  unstable.inertia = {2, 4, 3};
  auto at_rest = p;
  at_rest.angular_velocity[2] = 0;
  auto uneven = disc;
  uneven.inertia = {2, 2.1, 4.1};
  for (const auto& q : {unstable, at_rest, uneven}) {
    const TiltOrders<double> orders(q, 100);
    CHECK_FALSE(orders.knows_tilt());
    CHECK(orders.third_order().second == infinity<double>);
    const std::vector<double> times{10, 100};
    const auto second = second_order_errors(q, 100.0);
    CHECK(second_order_attitude_error<double>(second, orders, times) == second.attitude);
  }
}

TEST_CASE("what is known of the orders left out bounds the second order over all times", "[spinning]") {
  Spinners random(19);
  std::vector<double> sharp;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    auto p = spinner(random, true, random.log_any(0.01, 1));
    if (i % 3 == 0) p.rotor_momentum = (2 * p.inertia[0] - p.inertia[2]) * p.spin();
    p.force = {0.3, -0.2, 1}, p.mass = 1;
    const double T = random.any(20, 600) / std::abs(p.spin());
    const TiltOrders<double> orders(p, T);
    if (!orders.knows_tilt()) continue;
    const auto stated = second_order_errors(p, T, Look::close, orders.third_order());
    if (!(stated.size.tilt + stated.tilt < small_tilt && stated.theta < small_tilt)) continue;
    const SecondOrder<Real80> motion(cast<Real80>(p), T);
    Real80 tilt = 0, velocity = 0, theta = 0;
    for (int k = 1; k <= 40; ++k) {
      const Real80 t = Real80(T) * k / 40;
      const auto found = motion.at(t), right = true_state(cast<Real80>(p), t);
      tilt = std::max(tilt, tilt_apart(found, right));
      theta = std::max(theta, std::abs(found.angles.theta - right.angles.theta));
      velocity =
          std::max(velocity, std::hypot(found.velocity[0] - right.velocity[0], found.velocity[1] - right.velocity[1]));
    }
    CHECK(tilt <= stated.tilt);
    CHECK(theta <= stated.theta);
    CHECK(velocity <= stated.velocity);
    sharp.push_back(stated.tilt / double(tilt));
  }
  REQUIRE(sharp.size() > 30);
  std::sort(sharp.begin(), sharp.end());
  CHECK(sharp[sharp.size() / 2] < 4);
}

TEST_CASE("the second order of the spin angle is known at a resonance, without a nutation and behind an unstable one",
          "[spinning]") {
  struct Scene {
    const char* name;
    Vec3<Real80> inertia;
    Real80 spin, rotor, end;
  };
  const Scene scenes[] = {{"resonant", {2, 2, 3}, 1, 1, 30},      {"nearly", {2, 2.1L, 3}, 1, 1.1L, 30},
                          {"a disc", {2, 2, 4}, 1, 0, 30},        {"unstable", {2, 4, 3}, 1, 0, 4},
                          {"no nutation", {2, 2, 2}, 1, 0, 30},   {"hardly any", {2, 2, 2 + 1e-9L}, 1, 0, 30},
                          {"at rest", {2, 2.5L, 3}, 0, 1, 30},    {"a short while", {2, 2.5L, 3}, 1, 0, 0.1L},
                          {"a standing ball", {2, 2, 2}, 0, 0, 3}};
  for (const Scene& scene : scenes) {
    CAPTURE(scene.name);
    Real80 left[2];
    for (int k = 0; k < 2; ++k) {
      const Real80 by = k == 0 ? 1 : 0.5L;
      Problem<Real80> p;
      p.inertia = scene.inertia, p.rotor_momentum = scene.rotor;
      p.torque = {1e-4L * by, 2e-4L * by, 0};
      p.angular_velocity = {1e-3L * by, -2e-3L * by, scene.spin};
      p.angles = {2e-3L * by, -1e-3L * by, 0.3L};
      const Real80 end = scene.end;
      const Real80 error = true_state(p, end).angles.theta - Linear<Real80>(p).at(end).angles.theta;
      left[k] = std::abs(error - TiltOrders<Real80>(p, end).spin_angle(end));
      CHECK(std::abs(error) > 0);
      CHECK(left[k] < 0.01L * std::abs(error));
    }
    CHECK(std::log2(left[0] / left[1]) > 3.5);
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
  const double error = second_order_attitude_error<double>(second_order_errors(p, 100.0), orders, times);
  CHECK(allocations() == before);
  CHECK(error > 0);
}

TEST_CASE("what cancels, and what a constant mode forces, is not taken for small", "[spinning]") {
  struct Scene {
    Vec3<double> inertia, torque, rates;
    double rotor, charge, psi, phi, end;
  };
  // found from outside: a mode that all but stands still beside one that does; a spin rate that swings with the nutation
  const Scene scenes[] = {{{55.28778522147324, 54.91303679688075, 19.983322807790373},
                           {-0.0005286719290037658, 0.0015397652222544187, 0},
                           {0, 0, -0.25585825402394624},
                           5.0179400266813,
                           -0.10469616882643942,
                           0,
                           0,
                           70.54447448683499},
                          {{168.81374248782222, 165.06931068951076, 67.6920796128503},
                           {0.0017508407566175198, 7.48529927188651e-05, 0},
                           {2.1167598151098637e-07, 1.6560382810899974e-07, 0.5496837146194935},
                           -37.300566860059845,
                           -0.0676580230468105,
                           1.643203839504018e-07,
                           -2.893428490256912e-07,
                           82.2104264991293},
                          {{1723.2558191215412, 1633.3553227331395, 306.6041783346112},
                           {3.645635741498224e-07, -2.7781088235333056, 0},
                           {0.0009891601800327892, -1.5274564102777942e-06, -1.9453462893483282},
                           16.697877717112124,
                           0,
                           1.3389545395751192e-06,
                           -5.652734144148665e-06,
                           145.1993114811646},
                          {{1750.9259489301332, 1569.1207136534067, 284.1534068079423},
                           {1.5778160387501875e-07, -2.7540707435717304, 0},
                           {0.000943402347889317, -2.83289105387932e-07, -1.9453462893483282},
                           36.68057478165134,
                           0,
                           2.5435078194718926e-06,
                           0.0004405119028320926,
                           598.8268398262007}};
  for (const Scene& scene : scenes) {
    Problem<double> p;
    p.inertia = scene.inertia, p.torque = scene.torque, p.angular_velocity = scene.rates;
    p.rotor_momentum = scene.rotor, p.charge_momentum = scene.charge;
    p.angles = {scene.psi, scene.phi, 0};
    CAPTURE(scene.end);
    const std::vector<double> times{scene.end};
    const auto found = SecondOrder<double>(p, scene.end).at(scene.end);
    const auto right = true_state(cast<Real80>(p), scene.end);
    const Quat<Real80> q{found.attitude.w, found.attitude.x, found.attitude.y, found.attitude.z};
    const auto off = conjugate(right.attitude) * q;
    const auto error = second_order_errors(p, scene.end);
    const double truly = 2 * double(std::hypot(off.x, off.y, off.z));
    CHECK(truly < error.attitude);
    CHECK(truly < second_order_attitude_error<double>(error, TiltOrders<double>(p, scene.end), times));
  }
}

TEST_CASE("what adds up beside a spin angle that grows is in the velocity, and no peak between times is missed",
          "[spinning]") {
  // found from outside: velocity and position at a late time, up to 1.5 times what was stated
  Problem<double> late;
  late.inertia = {1, 0.999999737534028, 1.664200767052894}, late.mass = 1;
  late.rotor_momentum = -4.785167028665029, late.charge_momentum = -1.4106413974032876;
  late.torque = {-0.022240166313683533, 0.00022769612144945224, 0};
  late.force = {-0.38522170528193594, 6.244181382377659, -0.0279341072442273};
  late.angular_velocity = {0.0010618310957998766, 0.005583474458953804, 1};
  late.angles = {-0.0038432231560905678, -0.0006519325640042944, 0};
  const double end = 3000;
  const auto found = SecondOrder<Real80>(cast<Real80>(late), end).at(end), right = true_state(cast<Real80>(late), end);
  const TiltOrders<double> orders(late, end);
  for (const auto& stated :
       {second_order_errors(late, end), second_order_errors(late, end, Look::close, orders.third_order())}) {
    CHECK(double((found.velocity - right.velocity).head<2>().norm()) < stated.velocity);
    CHECK(double((found.position - right.position).head<2>().norm()) < stated.position);
  }
  // sums of a few frequencies: the greatest of many times is more than twice that of a few
  Problem<double> peaks;
  peaks.inertia = {1, 1, 1.6}, peaks.rotor_momentum = -2.574721482578588;
  peaks.torque = {1e-3, 0, 0}, peaks.angular_velocity = {0, 0, 1};
  const TiltOrders<double> of_peaks(peaks, 147.0);
  REQUIRE(of_peaks.knows_tilt());
  double most = 0;
  for (int i = 0; i <= 20000; ++i) most = std::max(most, of_peaks.tilt(147.0 * i / 20000));
  CHECK(most <= of_peaks.third_order().second);
  CHECK(of_peaks.third_order().second < 3 * most);
}
