// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/full.hpp"

#include "catch.hpp"

#include <array>
#include <cmath>
#include <random>

#include "gyrostat/ode/taylor.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using ode::Status;

namespace {

/// A scene with all terms; control with or without products of axes.
template <Real S>
Problem<S> described(Law law, Law drag_law, bool oblique = true) {
  Problem<S> problem;
  problem.inverse_inertia = {S(1) / S(1.4L), S(1), S(1) / S(0.7L)};
  problem.rotor_momentum = {S(0.2L), S(-0.15L), S(0.3L)};
  problem.control << S(0.06L), 0, 0, 0, S(0.09L), 0, 0, 0, S(0.1L);
  if (oblique) {
    problem.control(0, 1) = problem.control(1, 0) = S(0.02L);
    problem.control(1, 2) = problem.control(2, 1) = S(-0.01L);
  }
  problem.drag = S(0.03L);
  problem.law = law;
  problem.drag_law = drag_law;
  problem.momentum = {S(0.8L), S(0.5L), S(-0.33L)};
  return problem;
}

constexpr std::array<std::array<Law, 2>, 4> all_laws = {
    {{Law::total, Law::total}, {Law::total, Law::carrier}, {Law::carrier, Law::total}, {Law::carrier, Law::carrier}}};

}  // namespace

TEST_CASE("the torques are those of the equations") {
  for (const auto& [law, drag_law] : all_laws) {
    const auto problem = described<double>(law, drag_law);
    const Vec3<double> M = problem.momentum;
    const Vec3<double> G = M - problem.rotor_momentum;
    const Vec3<double> omega = problem.angular_velocity(M);
    const Vec3<double> U = law == Law::total ? M : G, D = drag_law == Law::total ? M : G;
    const Vec3<double> wanted = -problem.drag * D - problem.control * U.normalized();
    const Vec3<double> rate = momentum_rate(problem, M);
    // what the gyroscopic torque neither drives nor brakes: |M| and the energy
    CHECK(M.dot(rate) == Approx(M.dot(wanted)).epsilon(1e-14));
    CHECK(omega.dot(rate) == Approx(omega.dot(wanted)).epsilon(1e-13));
    // and across both, from the definition
    const Vec3<double> torque = rate - wanted;
    CHECK(torque[0] == Approx(M[1] * omega[2] - M[2] * omega[1]).epsilon(1e-14));
  }
}

TEST_CASE("a torque that has no value is NaN") {
  auto problem = described<double>(Law::total, Law::total);
  CHECK(!momentum_rate(problem, Vec3<double>(0, 0, 0)).allFinite());
  problem.control.setZero();
  CHECK(momentum_rate(problem, Vec3<double>(0, 0, 0)).isZero(0));
}

TEST_CASE("the Jacobian is the derivative") {
  for (const auto& [law, drag_law] : all_laws) {
    const auto problem = described<long double>(law, drag_law);
    const Mat3<long double> jacobian = momentum_jacobian(problem, problem.momentum);
    const long double step = 1e-6L;
    for (int j = 0; j < 3; ++j) {
      const Vec3<long double> e = step * Vec3<long double>::Unit(j);
      const Vec3<long double> column = (momentum_rate<long double>(problem, problem.momentum + e) -
                                        momentum_rate<long double>(problem, problem.momentum - e)) /
                                       (2 * step);
      CHECK((jacobian.col(j) - column).norm() < 1e-11L);
    }
  }
}

TEMPLATE_TEST_CASE("the coefficients solve the equations", "", float, double, long double) {
  using S = TestType;
  constexpr int order = 20;
  for (const auto& [law, drag_law] : all_laws) {
    const auto problem = described<S>(law, drag_law);
    const FullCoefficients<S> f(problem);
    using System = FullSystem<S, true, true>;
    const System system(problem);
    alignas(64) S x[order + 1][8] = {};
    alignas(64) typename System::template Work<order> work;
    for (int i = 0; i < 3; ++i) x[0][i] = problem.momentum[i] - f.offset[i];
    x[0][4] = S(0.5);
    x[0][5] = S(-0.5);
    x[0][6] = S(0.5);
    x[0][7] = S(0.5);
    const S unit = S(0.25);
    system.expand(0, unit, x, work);
    for (const S theta : {S(-0.5), S(0), S(0.25), S(0.5)}) {
      Vec3<S> U{0, 0, 0}, rate{0, 0, 0};
      Quat<S> q{0, 0, 0, 0}, q_rate{0, 0, 0, 0};
      for (int k = order; k >= 0; --k) {
        rate = rate * theta + U;
        q_rate = {q_rate.w * theta + q.w, q_rate.x * theta + q.x, q_rate.y * theta + q.y, q_rate.z * theta + q.z};
        U = U * theta + Vec3<S>(x[k][0], x[k][1], x[k][2]);
        q = {q.w * theta + x[k][4], q.x * theta + x[k][5], q.y * theta + x[k][6], q.z * theta + x[k][7]};
      }
      const Vec3<S> M = U + f.offset;
      CHECK((rate / unit - momentum_rate(problem, M)).norm() < 30 * epsilon<S>);
      const Vec3<S> w = problem.angular_velocity(M);
      const S tolerance = 30 * epsilon<S>;
      CHECK(std::abs(q_rate.w / unit - (-q.x * w[0] - q.y * w[1] - q.z * w[2]) / 2) < tolerance);
      CHECK(std::abs(q_rate.x / unit - (q.w * w[0] + q.y * w[2] - q.z * w[1]) / 2) < tolerance);
      CHECK(std::abs(q_rate.y / unit - (q.w * w[1] + q.z * w[0] - q.x * w[2]) / 2) < tolerance);
      CHECK(std::abs(q_rate.z / unit - (q.w * w[2] + q.x * w[1] - q.y * w[0]) / 2) < tolerance);
    }
  }
}

TEST_CASE("what a scene lacks is left out without a change") {
  // the same motion with the control compiled out, and with the attitude
  auto problem = described<double>(Law::total, Law::total);
  problem.control.setZero();
  const auto end = [&](auto system) {
    using System = decltype(system);
    ode::TaylorOptions<double, System::width> options;
    options.tolerance = 1e-17;
    options.scale[0] = options.scale[1] = options.scale[2] = 1;
    typename ode::Taylor<System>::State start{};
    for (std::size_t i = 0; i < 3; ++i) start[i] = problem.momentum[static_cast<int>(i)];
    if constexpr (System::width == 8) start[4] = 1;
    ode::Taylor<System> solver(system, 0, start, options);
    REQUIRE(solver.advance(30) == Status::reached);
    return Vec3<double>(solver.state()[0], solver.state()[1], solver.state()[2]);
  };
  const Vec3<double> without = end(FullSystem<double, false, false>(problem));
  CHECK((end(FullSystem<double, true, false>(problem)) - without).norm() < 1e-14);
  CHECK((end(FullSystem<double, false, true>(problem)) - without).norm() < 1e-14);
  CHECK(without.norm() == Approx(problem.momentum.norm() * std::exp(-0.9)).epsilon(1e-14));
}

TEST_CASE("a step never jumps over the end") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const auto& [law, drag_law] : all_laws) {
    const auto problem = described<double>(law, drag_law);
    const FullSystem<double, true, false> system(problem);
    const FullCoefficients<double> f(problem);
    for (int i = 0; i < 200; ++i) {
      const Vec3<double> U{any(random), any(random), any(random)};
      const double x[4] = {U[0], U[1], U[2], 0};
      const double limit = system.step_limit(x);
      const Vec3<double> rate = momentum_rate<double>(problem, U + f.offset);
      CHECK(limit * -U.dot(rate) / U.norm() < 0.31 * U.norm());
    }
  }
  const FullSystem<double, false, false> without(described<double>(Law::total, Law::total));
  const double x[4] = {1, 0, 0, 0};
  CHECK(without.step_limit(x) == infinity<double>);
}

TEST_CASE("a projection brings a state back onto its laws") {
  auto problem = described<double>(Law::total, Law::total);
  problem.rotor_momentum.setZero();
  problem.control = 0.1 * Mat3<double>::Identity();
  const FullSystem<double, true, true> system(problem);
  CHECK(system.norm_is_known());
  const double t = 2;
  const double norm = system.norm_at(t);
  // a state on the law, to order one, then disturbed
  const double R0 = problem.momentum.norm();
  CHECK(norm == Approx((R0 + 0.1 / 0.03) * std::exp(-0.06) - 0.1 / 0.03).epsilon(1e-14));
  const Vec3<double> right = problem.momentum * (norm / R0);
  double x[8] = {right[0] + 1e-7, right[1] - 2e-7, right[2], 0, 1 + 1e-8, 0, 0, 0}, low[8] = {};
  for (int i = 0; i < 3; ++i) system.project(t, x, low);
  const Vec3<double> U{x[0], x[1], x[2]};
  CHECK(U.norm() == Approx(norm).epsilon(4e-16));
  CHECK(problem.energy(U) == Approx(problem.energy(right)).epsilon(6e-16));
  CHECK((U - right).norm() < 4e-7);
  CHECK(x[4] == 1);

  // no law, no change
  const auto lawless = described<double>(Law::carrier, Law::carrier);
  const FullSystem<double, true, false> plain(lawless);
  CHECK(!plain.norm_is_known());
  double y[4] = {0.3, 0.2, 0.1, 0}, rest[4] = {};
  plain.project(t, y, rest);
  CHECK((y[0] == 0.3 && y[1] == 0.2 && y[2] == 0.1 && rest[0] == 0));
}

TEST_CASE("beside a steady rotation a projection moves the state by roundings alone", "[deceleration]") {
  // energy and |M| hardly differ there from those of the rotation: what is rounded of them must not become a departure from it
  for (int k = 0; k < 3; ++k) {
    for (const double off : {1e-2, 4e-3, 1e-5}) {
      Problem<double> problem;
      problem.inverse_inertia = {1 / 1.4, 1 / 1.0, 1 / 0.45};
      problem.momentum = Vec3<double>::Unit(k) + off * Vec3<double>(0.7, -0.3, 0.6);
      problem.control = 0.2 * Mat3<double>::Identity();
      problem.drag = 0.5;
      const FullSystem<double, true, false> system(problem);
      for (const double t : {0.0, 0.1, 0.7, 1.9}) {
        const Vec3<double> right = problem.momentum.normalized() * system.norm_at(t);
        double x[4] = {right[0], right[1], right[2], 0}, low[4] = {};
        system.project(t, x, low);
        CAPTURE(k, off, t);
        CHECK((Vec3<double>(x[0], x[1], x[2]) - right).norm() < 4e-16 * right.norm());
      }
    }
  }
}

TEST_CASE("the rounding of its three coefficients lets the gyroscopic torque neither drive nor brake") {
  // near moments of a slim body with a rotor across it, unequal control: no law is there to project on
  Problem<double> problem;
  problem.inverse_inertia = {1 / 7096.1, 1 / 7087.3, 1 / 6.13};
  problem.rotor_momentum = {519.4, 485.5, 4.9};
  problem.control.diagonal() << 3.36, 5.43, 4.58;
  problem.momentum = {7700, 7270, 30};
  const auto after = [&]<class S>(S tolerance) {
    Problem<S> p;
    p.inverse_inertia = problem.inverse_inertia.cast<S>();
    p.rotor_momentum = problem.rotor_momentum.cast<S>();
    p.control = problem.control.cast<S>();
    p.momentum = problem.momentum.cast<S>();
    p.gaps = problem.inverse_gaps().cast<S>();
    using System = FullSystem<S, true, false>;
    typename ode::Taylor<System>::Options options;
    options.tolerance = tolerance;
    options.scale.fill(p.momentum.norm());
    ode::Taylor<System> taylor(System(p, 1), 0, {p.momentum[0], p.momentum[1], p.momentum[2]}, options);
    while (taylor.time() < 500) REQUIRE(taylor.step(500) == Status::reached);
    return std::hypot(taylor.state()[0], taylor.state()[1], taylor.state()[2]);
  };
  const long double right = after(1e-17L);
  CHECK(std::abs(after(1e-15) - right) < 1e-12L * right);
}

TEST_CASE("carried sums and the projection shrink the phase error of a long free motion") {
  const auto error = [](bool careful) {
    const auto end = [&]<Real S>(S tolerance, bool on) {
      Problem<S> problem;
      problem.inverse_inertia = {S(1 / 1.4), 1, S(1 / 0.7)};
      problem.momentum = {S(0.8), S(0.5), S(0.33)};
      using System = FullSystem<S, false, false>;
      ode::TaylorOptions<S, 4> options;
      options.tolerance = tolerance;
      options.scale = {1, 1, 1, 0};
      options.compensated = options.projected = on;
      ode::Taylor<System> solver(System(problem), 0, {problem.momentum[0], problem.momentum[1], problem.momentum[2], 0},
                                 options);
      REQUIRE(solver.advance(50000) == Status::reached);
      return Vec3<long double>(solver.state()[0], solver.state()[1], solver.state()[2]);
    };
    static const Vec3<long double> truth = end.template operator()<long double>(1e-20L, true);
    return static_cast<double>((end.template operator()<double>(1e-16, careful) - truth).norm());
  };
  const double careful = error(true) / epsilon<double>, plain = error(false) / epsilon<double>;
  CAPTURE(careful, plain);
  CHECK(careful < 5000);
  CHECK(plain > 5 * careful);
}
