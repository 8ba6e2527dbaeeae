// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/linear.hpp"

#include <algorithm>
#include <complex>
#include <random>
#include <vector>

#include "allocations.hpp"
#include "direct_motion.hpp"
#include "gyrostat/models/spinning/linear_functions.hpp"
#include "linear_table.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using gyrostat::spinning::detail::problem_cast;
using linear_table::outputs;

namespace {

constexpr double span_of_powers[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-13, 1e-16, 0};

Problem<double> stage() {
  Problem<double> p;
  p.inertia = {8, 7, 12};
  p.mass = 10;
  p.torque = {0.4, -0.2, 0};
  p.force = {0.3, -0.2, 3};
  p.angular_velocity = {0.002, -0.003, 1};
  p.angles = {0.004, -0.002, 0.3};
  p.velocity = {0.1, -0.2, 0.3};
  p.position = {1, 2, 3};
  return p;
}

/// Problems at a distance `detuning` from every resonance: X = 0, X = r0 (D1 + D2), kappa1 = 0, kappa2 = 0, r0 = 0, nu = 0,
/// all at once.
std::vector<Problem<double>> near_resonances(double detuning) {
  std::vector<Problem<double>> all;
  const auto add = [&](Vec3<double> D, double lambda3, double r0, double e_H = 0) {
    auto p = stage();
    p.inertia = D;
    p.rotor_momentum = lambda3;
    p.charge_momentum = e_H;
    p.angular_velocity[2] = r0;
    all.push_back(p);
  };
  add({8, 7, 12}, detuning - 12, 1);
  add({8, 7, 12}, -detuning - 12, 1, 0.25);
  add({8, 7, 12}, 3 + detuning, 1);
  add({7, 7, 12}, 2 + detuning, 1);
  add({8, 7, 15}, 0, 1 + detuning);
  add({8, 7, 12}, detuning - 5, 1);
  add({8, 7, 12}, -detuning - 5, 1);
  add({8, 7, 12}, detuning - 4, 1, 0.25);
  add({8, 7, 12}, 2, detuning);
  add({8, 7, 12}, 2, -detuning);
  add({7, 7, 7}, detuning, 1);
  add({7, 7, 7}, 0, detuning);
  add({8, 7, 12}, detuning, detuning);
  add({8, 7, 12}, 12 - detuning, -1);
  return all;
}

/// Gamma and v of the closed form that divides by nu, r0 and r0 +- nu, as it is found in print.
struct Printed {
  std::complex<double> Gamma, v;

  Printed(const Problem<double>& p, double t) {
    using C = std::complex<double>;
    const C i(0, 1);
    const double r0 = p.spin(), k1 = p.kappa1(r0), k2 = p.kappa2(r0), nu = std::sqrt(k1 * k2);
    const LinearStart<double> s(p);
    const C Pi(s.Pi.re, s.Pi.im), b(s.b.re, s.b.im), d(s.d.re, s.d.im), Gamma0(s.Gamma.re, s.Gamma.im);
    const C constant = Pi + d / (nu * nu), up = b / (2.0 * i * nu) - d / (2 * nu * nu),
            down = -b / (2.0 * i * nu) - d / (2 * nu * nu);
    const auto E1 = [&](double w) { return (std::exp(i * w * t) - 1.0) / (i * w); };
    const auto E2 = [&](double w) { return (E1(w) - t) / (i * w); };
    Gamma = std::exp(-i * r0 * t) * (Gamma0 + constant * E1(r0) + up * E1(r0 + nu) + down * E1(r0 - nu));
    const C f(p.force[0], p.force[1]);
    const C pull =
        f * E1(r0) - i * p.force[2] * (Gamma0 * t + constant * E2(r0) + up * E2(r0 + nu) + down * E2(r0 - nu));
    v = C(p.velocity[0], p.velocity[1]) + std::exp(i * p.angles.theta) / p.mass * pull;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("the linear motion against 25 digits", "[spinning]", double, long double) {
  using S = TestType;
  double worst[8] = {};
  for (const auto& row : linear_table::read()) {
    const auto y = outputs(Linear<S>(problem_cast<S>(row.problem)).at(S(row.t)));
    for (int k = 0; k < 8; ++k) {
      const double error = linear_table::relative(y, row.truth, k);
      INFO(row.name << " t " << row.t << " quantity " << k);
      CHECK(error <= 2e-13 * double(epsilon<S> / epsilon<double>));
      worst[k] = std::max(worst[k], error);
    }
  }
  if (sizeof(S) == sizeof(double)) CHECK(worst[0] <= 1e-14);
}

TEST_CASE("the linear motion in single precision", "[spinning]") {
  for (const auto& row : linear_table::read()) {
    if (row.t > 30) continue;
    const auto narrow = problem_cast<float>(row.problem);
    const auto y = outputs(Linear<float>(narrow).at(float(row.t)));
    const auto truth = outputs(Linear<double>(problem_cast<double>(narrow)).at(double(float(row.t))));
    INFO(row.name << " t " << row.t);
    for (int k = 0; k < 8; ++k) CHECK(linear_table::relative(y, truth, k) <= 2e-5);
  }
}

TEST_CASE("no digit is lost near or at a resonance", "[spinning]") {
  double worst = 0;
  for (const double detuning : span_of_powers) {
    for (const auto& p : near_resonances(detuning)) {
      const Linear<double> linear(p);
      const Linear<long double> wide(problem_cast<long double>(p));
      long double most[8] = {};
      for (const double t : {1e-3, 0.02, 0.3, 1.0, 2.3, 4.0, 7.0, 13.0, 31.0, 100.0, 300.0}) {
        const auto truth = outputs(wide.at(t)), y = outputs(linear.at(t));
        for (int k = 0; k < 8; ++k) {
          most[k] = std::max(most[k], linear_table::size(truth, k));
          worst = std::max(worst, linear_table::relative(y, truth, k, 1e-3L * most[k]));
        }
      }
    }
  }
  CHECK(worst <= 2e-13);
}

TEST_CASE("the closed form as printed loses every digit near a resonance", "[spinning]") {
  double before = 0;
  for (const double X : {1e-2, 1e-4, 1e-6}) {
    auto p = stage();
    p.rotor_momentum = X - 12;
    const double t = 10;
    const auto truth = Linear<long double>(problem_cast<long double>(p)).at(t);
    const auto ours = Linear<double>(p).at(t);
    const Printed printed(p, t);
    const auto lost = [](double a, double b, long double x, long double y) {
      return double(std::hypot(a - x, b - y) / std::hypot(x, y));
    };
    const double loss = lost(printed.v.real(), printed.v.imag(), truth.velocity[0], truth.velocity[1]);
    CHECK(loss > 20 * before);
    const double loss_of_tilt = lost(printed.Gamma.real(), printed.Gamma.imag(), truth.angles.psi, truth.angles.phi);
    INFO(X << " " << loss << " " << loss_of_tilt);
    CHECK(loss_of_tilt < 1e-2 * loss);
    CHECK(lost(ours.velocity[0], ours.velocity[1], truth.velocity[0], truth.velocity[1]) < 2e-15);
    CHECK(lost(ours.angles.psi, ours.angles.phi, truth.angles.psi, truth.angles.phi) < 2e-15);
    before = loss;
  }
  CHECK(before > 1e-7);
  auto p = stage();
  p.rotor_momentum = -12;
  CHECK_FALSE(std::isfinite(Printed(p, 10).Gamma.real()));
}

TEST_CASE("the start is the start", "[spinning]") {
  const auto p = stage();
  const auto s = Linear<double>(p).at(0);
  CHECK(s.angular_velocity == p.angular_velocity);
  CHECK(s.angles.psi == p.angles.psi);
  CHECK(s.angles.phi == p.angles.phi);
  CHECK(s.angles.theta == p.angles.theta);
  CHECK(s.velocity == p.velocity);
  CHECK(s.position == p.position);
  // momentum: exact along axis 3, of first order across
  const Vec3<double> L(8 * 0.002, 7 * -0.003, 12);
  const Vec3<double> G = rotate<double>(s.attitude, L);
  CHECK(s.momentum_I[2] == Approx(G[2]).epsilon(1e-15));
  CHECK((s.momentum_I - G).norm() < 12 * std::pow(0.005, 3));
}

TEST_CASE("the linear motion is linear in the torque and in the force", "[spinning]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    auto p = stage();
    p.rotor_momentum = 4 * u(random);
    p.charge_momentum = u(random);
    p.angular_velocity[2] = u(random);
    const double t = 20 * (1 + u(random));
    const Vec3<double> M(u(random), u(random), 0), N(u(random), u(random), 0), f(u(random), u(random), u(random));
    const auto with = [&](const Vec3<double>& torque, const Vec3<double>& force) {
      auto problem = p;
      problem.torque = torque;
      problem.force = force;
      return outputs(Linear<double>(problem).at(t));
    };
    const Vec3<double> none(0, 0, 0);
    const auto both = with(M + N, f), first = with(M, f), second = with(N, f), neither = with(none, f);
    const auto pushed = with(M, 2 * f), free = with(M, none);
    for (int k = 0; k < 8; ++k) {
      std::array<long double, 13> sum, scaled;
      for (std::size_t i = 0; i < 13; ++i) {
        sum[i] = first[i] + second[i] - neither[i];
        scaled[i] = 2 * first[i] - free[i];
      }
      const long double floor = linear_table::size(first, k) + linear_table::size(second, k) + 1e-3L;
      CHECK(linear_table::relative(both, sum, k, floor) < 1e-12);
      CHECK(linear_table::relative(pushed, scaled, k, floor) < 1e-12);
    }
  }
}

TEST_CASE("a motion goes on from any of its states", "[spinning]") {
  for (const double detuning : {0.3, 1e-3, 0.0}) {
    for (const auto& p : near_resonances(detuning)) {
      const Linear<double> linear(p);
      for (const double t : {0.4, 9.0}) {
        const auto middle = linear.at(t);
        auto later = p;
        later.angular_velocity = middle.angular_velocity;
        later.angles = middle.angles;
        later.velocity = middle.velocity;
        later.position = middle.position;
        const auto there = outputs(linear.at(t + 5.5)), in_two = outputs(Linear<double>(later).at(5.5));
        for (int k = 0; k < 8; ++k)
          CHECK(linear_table::relative(in_two, there, k, 1e-2L * (1 + linear_table::size(there, 5))) < 1e-12);
      }
    }
  }
}

TEST_CASE("turned bodies, turned motions", "[spinning]") {
  for (const double detuning : {0.3, 1e-9}) {
    for (const auto& p : near_resonances(detuning)) {
      const auto s = Linear<double>(p).at(7.7);
      // half a turn about axis 1, in the body and outside: the spin and the rotor change sign
      auto flipped = p;
      for (auto* v :
           {&flipped.torque, &flipped.force, &flipped.angular_velocity, &flipped.velocity, &flipped.position}) {
        (*v)[1] = -(*v)[1];
        (*v)[2] = -(*v)[2];
      }
      flipped.rotor_momentum = -p.rotor_momentum;
      flipped.charge_momentum = -p.charge_momentum;
      flipped.angles = {p.angles.psi, -p.angles.phi, -p.angles.theta};
      const auto o = Linear<double>(flipped).at(7.7);
      CHECK(o.angular_velocity[0] == Approx(s.angular_velocity[0]).epsilon(1e-13));
      CHECK(o.angular_velocity[1] == Approx(-s.angular_velocity[1]).epsilon(1e-13));
      CHECK(o.angles.psi == Approx(s.angles.psi).epsilon(1e-13));
      CHECK(o.angles.phi == Approx(-s.angles.phi).epsilon(1e-13));
      CHECK(o.angles.theta == -s.angles.theta);
      CHECK(o.momentum_I[0] == Approx(s.momentum_I[0]).epsilon(1e-13));
      CHECK(o.momentum_I[1] == Approx(-s.momentum_I[1]).epsilon(1e-13));
      CHECK(o.momentum_I[2] == Approx(-s.momentum_I[2]).epsilon(1e-13).margin(1e-15));
      CHECK(o.velocity[1] == Approx(-s.velocity[1]).epsilon(1e-13));
      CHECK(o.position[2] == Approx(-s.position[2]).epsilon(1e-13));

      // a quarter turn about axis 3: Pi, Gamma, M, f, v, x are multiplied by i
      auto turned = p;
      const auto turn = [](Vec3<double> v) { return Vec3<double>(-v[1], v[0], v[2]); };
      turned.inertia = {p.inertia[1], p.inertia[0], p.inertia[2]};
      turned.torque = turn(p.torque);
      turned.force = turn(p.force);
      turned.angular_velocity = turn(p.angular_velocity);
      turned.velocity = turn(p.velocity);
      turned.position = turn(p.position);
      turned.angles.psi = -p.angles.phi;
      turned.angles.phi = p.angles.psi;
      const auto q = Linear<double>(turned).at(7.7);
      CHECK((q.angular_velocity - turn(s.angular_velocity)).norm() <= 1e-13 * s.angular_velocity.norm());
      CHECK(q.angles.psi == Approx(-s.angles.phi).epsilon(1e-12));
      CHECK(q.angles.phi == Approx(s.angles.psi).epsilon(1e-12));
      CHECK((q.velocity - turn(s.velocity)).norm() <= 1e-13 * s.velocity.norm());
      CHECK((q.position - turn(s.position)).norm() <= 1e-13 * s.position.norm());
      CHECK(q.momentum_I[0] == Approx(-s.momentum_I[1]).epsilon(1e-12));

      // theta0 turns what is inertial
      auto ahead = p;
      ahead.angles.theta += 0.9;
      ahead.velocity.setZero();
      ahead.position.setZero();
      auto behind = ahead;
      behind.angles.theta = 0;
      const auto a = Linear<double>(ahead).at(7.7), b = Linear<double>(behind).at(7.7);
      const Quat<double> by = quaternion_from_312(0.0, 0.0, ahead.angles.theta);
      CHECK((a.velocity - rotate<double>(by, b.velocity)).norm() <= 1e-14 * b.velocity.norm());
      CHECK((a.position - rotate<double>(by, b.position)).norm() <= 1e-14 * b.position.norm());
      CHECK((a.momentum_I - rotate<double>(by, b.momentum_I)).norm() <= 1e-14 * b.momentum_I.norm());
      CHECK(a.angles.psi == b.angles.psi);
    }
  }
}

TEST_CASE("a free sphere and a body that does not spin", "[spinning]") {
  Problem<double> sphere;
  sphere.inertia = {2, 2, 2};
  sphere.torque = {0.01, 0, 0};
  sphere.angular_velocity = {0, 0, 1};
  const auto s = Linear<double>(sphere).at(50);
  CHECK(s.angular_velocity[0] == Approx(0.005 * 50).epsilon(1e-15));  // p grows with t
  CHECK(s.angular_velocity[1] == 0);
  Problem<double> still;
  still.inertia = {2, 3, 4};
  still.torque = {0.01, 0.02, 0};
  still.force = {0, 0, 2};
  still.mass = 2;
  const auto r = Linear<double>(still).at(3);
  CHECK(r.angles.psi == Approx(0.005 * 4.5));
  CHECK(r.angles.phi == Approx(0.02 / 3 * 4.5));
  CHECK(r.velocity[0] == Approx(0.02 / 3 * 4.5));
  CHECK(r.velocity[1] == Approx(-0.005 * 4.5));
  CHECK(r.position[0] == Approx(0.02 / 3 * 81.0 / 24));
  CHECK(r.position[2] == Approx(4.5));
}

TEST_CASE("unstable spin grows as cosh, and the momentum keeps its digits", "[spinning]") {
  Problem<double> p;
  p.inertia = {8, 11, 9};
  p.angular_velocity = {1e-9, 0, 1};
  const double mu = std::sqrt(-p.nutation_squared());
  for (const double turns : {1.0, 17.0, 50.0, 200.0}) {
    const double t = turns / mu;
    const auto s = Linear<double>(p).at(t);
    CHECK(s.angular_velocity[0] == Approx(1e-9 * std::cosh(mu * t)).epsilon(1e-13));
    // without torque the momentum stays, however far the body tips
    CHECK(s.momentum_I[0] == Approx(8e-9).epsilon(1e-15));
    CHECK(s.momentum_I[1] == 0);
  }
}

TEST_CASE("attitude: the rotation of the angles, of unit norm", "[spinning]") {
  for (const auto& row : linear_table::read()) {
    const auto s = Linear<double>(row.problem).at(row.t);
    CHECK(norm(s.attitude) == Approx(1).epsilon(1e-15));
    CHECK(s.attitude == quaternion_from_312(s.angles.psi, s.angles.phi, s.angles.theta));
  }
}

TEST_CASE("orders of the linear motion in the torque", "[spinning]") {
  // greatest errors over 40 s at scales 1 and 1/2
  const std::vector<double> times{3, 10, 17, 24, 33, 40};
  const auto errors = [&](double scale) {
    auto p = stage();
    p.rotor_momentum = 2;
    p.charge_momentum = 0.3;
    p.torque = scale * Vec3<double>(0.3, 0.2, 0);
    p.force = {2, -1, 3};
    p.angular_velocity = {scale * 0.003, -scale * 0.002, 1};
    p.angles = {scale * 0.006, scale * 0.004, 0.3};
    const Linear<double> linear(p);
    const auto truth = direct::motion(p, times);
    std::array<double, 10> most{};
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto s = linear.at(times[i]);
      const auto& d = truth[i];
      const auto see = [&](std::size_t k, double error) { most[k] = std::max(most[k], std::abs(error)); };
      see(0, std::hypot(s.angular_velocity[0] - d.angular_velocity[0], s.angular_velocity[1] - d.angular_velocity[1]));
      see(1, std::hypot(s.angles.psi - d.angles.psi, s.angles.phi - d.angles.phi));
      see(2, std::hypot(s.momentum_I[0] - d.momentum_I[0], s.momentum_I[1] - d.momentum_I[1]));
      see(3, s.angles.theta - d.angles.theta);
      see(4, s.angular_velocity[2] - d.angular_velocity[2]);
      see(5, s.velocity[2] - d.velocity[2]);
      see(6, s.position[2] - d.position[2]);
      see(7, std::hypot(s.velocity[0] - d.velocity[0], s.velocity[1] - d.velocity[1]));
      see(8, s.momentum_I[2] - d.momentum_I[2]);
      see(9, p.axial_momentum() - d.momentum_I[2]);
    }
    return most;
  };
  const auto coarse = errors(0.5), fine = errors(0.25);
  const double order[10] = {3, 3, 3, 2, 2, 2, 2, 2, 4, 2};
  for (std::size_t k = 0; k < 10; ++k) {
    INFO("quantity " << k << ": " << coarse[k] << " " << fine[k]);
    CHECK(std::log2(coarse[k] / fine[k]) == Approx(order[k]).margin(0.15));
  }
  CHECK(fine[8] < 0.01 * fine[9]);  // the balance along axis 3 against a constant L3
}

TEST_CASE("where the linear motion applies, and what it costs", "[spinning]") {
  auto p = stage();
  CHECK(Linear<double>(p).applies());
  p.torque[2] = 1e-9;
  CHECK_FALSE(Linear<double>(p).applies());
  const std::vector<double> times{5, 0, 2, -1};
  std::vector<State<double>> states(times.size());
  const auto before = allocations();
  const Linear<double> linear(stage());
  linear.at(times, states);
  CHECK(allocations() == before);
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(outputs(states[i]) == outputs(linear.at(times[i])));
  STATIC_REQUIRE(noexcept(linear.at(1.0)));
}
