// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/full.hpp"

#include <array>
#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "gyrostats.hpp"

namespace free_full_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::FullState;
using gyrostat::free::FullSystem;
using gyrostat::free::Motion;
using ode::Status;

template <Real S, int Order = 20>
class Steps {
 public:
  using System = FullSystem<S>;
  explicit Steps(const Problem<S>& problem, S tolerance = epsilon<S>, bool projected = true)
      : system_(problem), solver_(system_, 0, system_.start(), options(system_, tolerance, projected)) {}

  FullState<S> at(S t) {
    REQUIRE(solver_.advance(t) == Status::reached);
    return system_.state(t, solver_.state());
  }
  std::uint64_t steps() const { return solver_.counts().steps; }

 private:
  static auto options(const System& system, S tolerance, bool projected) {
    ode::TaylorOptions<S, System::width> how;
    how.tolerance = tolerance;
    how.scale = system.scale();
    how.projected = projected;
    return how;
  }
  System system_;
  ode::Taylor<System, Order> solver_;
};

/// Tumbling, with axes of the body that are not principal.
template <Real S>
Problem<S> turned_body(S rotor) {
  Problem<S> p;
  p.inertia << S(3.2L), S(0.1L), S(-0.15L), S(0.1L), S(4.1L), S(0.2L), S(-0.15L), S(0.2L), 5;
  p.rotor_momentum = rotor * Vec3<S>(S(0.5L), S(-1), S(0.75L));
  p.angular_velocity = {S(1.1L), S(-1.3L), S(2.2L)};
  p.attitude = normalised(Quat<S>{S(0.1L), S(0.7L), S(0.5L), S(-0.5L)});
  return p;
}

/// Errors of attitude (rad) and of omega, relative to its length.
Off off_closed(const FullState<double>& s, const Motion<double>& motion, double t) {
  const auto exact = motion.at(t);
  return off<double, double>({s.angular_velocity, s.angular_momentum, s.attitude}, exact);
}

TEMPLATE_TEST_CASE("the coefficients of the full free equations solve them", "[free]", float, double, long double) {
  using S = TestType;
  constexpr int order = 20;
  constexpr std::size_t width = 12;
  auto cancelling = turned_body<S>(4);  // M is the lesser one
  cancelling.angular_velocity = {S(-0.55L), S(1.05L), S(-0.7L)};
  for (const Problem<S>& problem : {turned_body<S>(0), turned_body<S>(2), cancelling}) {
    const FullSystem<S> system(problem);
    alignas(64) S x[order + 1][width] = {};
    alignas(64) typename FullSystem<S>::template Work<order> work;
    for (std::size_t i = 0; i < width; ++i) x[0][i] = system.start()[i];
    const S unit = S(0.08L);
    system.expand(0, unit, x, work);
    for (const S theta : {S(-0.5), S(0), S(0.25), S(0.5)}) {
      std::array<S, width> value{}, rate{};
      for (int k = order; k >= 0; --k) {
        for (std::size_t i = 0; i < width; ++i) {
          rate[i] = rate[i] * theta + value[i];
          value[i] = value[i] * theta + x[k][i];
        }
      }
      CHECK(rate[7] == 0);
      CHECK(rate[11] == 0);
      const auto here = system.state(0, value.data());
      const Vec3<S>&w = here.angular_velocity, &M = here.angular_momentum;
      const S size = M.norm() + problem.rotor_momentum.norm(), tolerance = 40 * epsilon<S> * size;
      CHECK((problem.inertia * w + problem.rotor_momentum - M).norm() < tolerance);
      // the rates of X and W are those of vectors in the same axes; X and M differ by a constant
      const Quat<S> q{value[0], value[1], value[2], value[3]}, to_principal = conjugate(here.attitude) * q;
      const auto body = [&](std::size_t i) {
        return Vec3<S>(rotate<S>(to_principal, Vec3<S>(rate[i], rate[i + 1], rate[i + 2])) / unit);
      };
      const Vec3<S> rate_M = cross<S>(M, w);
      // X is M, or M - l
      CHECK((body(4) - rate_M).norm() < tolerance * (1 + w.norm()));
      CHECK((body(8) - w).norm() < tolerance);
      const Quat<S> spin = quaternion_rate<S>(q, rotate<S>(conjugate(to_principal), w));
      CHECK(std::abs(rate[0] / unit - spin.w) < tolerance);
      CHECK(std::abs(rate[1] / unit - spin.x) < tolerance);
      CHECK(std::abs(rate[2] / unit - spin.y) < tolerance);
      CHECK(std::abs(rate[3] / unit - spin.z) < tolerance);
    }
  }
}

TEST_CASE("the error of one step of the full free equations falls with its order", "[free]") {
  using S = long double;
  constexpr int order = 8;
  const auto problem = turned_body<S>(2);
  const auto exact = Motion<S>::make(problem).value();
  const FullSystem<S> system(problem);
  S error[2];
  for (int i = 0; i < 2; ++i) {
    const S step = i == 0 ? 0.1L : 0.05L;
    alignas(64) S x[order + 1][12] = {};
    alignas(64) typename FullSystem<S>::template Work<order> work;
    for (std::size_t j = 0; j < 12; ++j) x[0][j] = system.start()[j];
    system.expand(0, step, x, work);
    S end[12] = {};
    for (const auto& row : x)
      for (int j = 0; j < 12; ++j) end[j] += row[j];
    error[i] = (system.state(step, end).angular_velocity - exact.at(step).angular_velocity).norm();
  }
  CHECK(double(std::log2(error[0] / error[1])) == Approx(order + 1).margin(0.3));
}

TEST_CASE("the full free equations agree with the closed form", "[free]") {
  for (const Regime regime : regimes) {
    Bodies bodies(61);
    for (int i = 0; i < 20; ++i) {
      const auto p = bodies.of(regime, i);
      const auto exact = Motion<double>::make<DoubleDouble>(p.cast<DoubleDouble>());
      REQUIRE(exact);
      Steps<double> steps(p);
      const double l = p.rotor_momentum.norm(), G = (p.inertia * p.angular_velocity).norm(),
                   fastest = 1 / p.inertia.diagonal().minCoeff();
      const double t = 20 / (fastest * (G + l));
      CAPTURE(free_bodies::name(regime), i, l / G, exact->modulus().kp2);
      for (const double share : {0.3, 1.0}) {
        const Off o = off_closed(steps.at(share * t), *exact, share * t);
        CHECK(o.rates < 1e-12);
        CHECK(o.attitude < 1e-12);
        CHECK(o.momentum < 1e-12 * std::max(1., 1e-3 * (G + l) / exact->angular_momentum_norm()));
      }
    }
  }
}

TEST_CASE("omega keeps its digits however great the rotor momentum is, and M where it cancels", "[free]") {
  Bodies bodies(62);
  for (int i = 0; i < 20; ++i) {
    const auto J = bodies.moments();
    const Vec3<double> l = 1e6 * bodies.vector(), w = bodies.vector();
    const auto p = Problem<double>::from_moments(J, l, w, bodies.attitude());
    const auto exact = Motion<double>::make<DoubleDouble>(p.cast<DoubleDouble>()).value();
    const double t = 100 / (l.norm() / J[2]);
    const auto s = Steps<double>(p).at(t);
    CHECK(off_closed(s, exact, t).rates < 1e-14);
    CHECK(off_closed(s, exact, t).attitude < 1e-14);

    auto given = p;
    given.momentum_given = true;
    given.angular_momentum = bodies.vector();
    const auto small = Motion<double>::make<DoubleDouble>(given.cast<DoubleDouble>()).value();
    const auto m = Steps<double>(given).at(t);
    CHECK(off_closed(m, small, t).momentum < 1e-13);
    CHECK(off_closed(m, small, t).rates < 1e-13);
  }
}

TEST_CASE("W is the integral of omega", "[free]") {
  Bodies bodies(63);
  for (int i = 0; i < 20; ++i) {
    const auto p = bodies.of(Regime::generic, i);
    const auto exact = Motion<double>::make<DoubleDouble>(p.cast<DoubleDouble>()).value();
    const double t = 3;
    // Simpson's rule, its error far below that of the steps
    constexpr int n = 20000;
    Vec3<double> sum(0, 0, 0);
    for (int k = 0; k <= n; ++k) sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * exact.at(t * k / n).angular_velocity;
    sum *= t / n / 3;
    CHECK((Steps<double>(p).at(t).turned - sum).norm() < 1e-10 * (1 + sum.norm()));
  }
}

TEST_CASE("the full free equations keep their laws, to rounding where they are projected", "[free]") {
  for (const Regime regime : {Regime::generic, Regime::much_momentum, Regime::close_moments, Regime::unstable_axis}) {
    Bodies bodies(64);
    for (int i = 0; i < 10; ++i) {
      const auto p = bodies.of(regime, i);
      const Vec3<double> G0 = p.inertia * p.angular_velocity, &l = p.rotor_momentum;
      const Vec3<double> L = rotate<double>(p.attitude, G0 + l);
      const double E = p.angular_velocity.dot(G0), K = G0.squaredNorm() + 2 * l.dot(G0);
      const double K_parts = G0.squaredNorm() + 2 * l.norm() * G0.norm();
      const double t = 2000 / (p.inertia.diagonal().cwiseInverse().maxCoeff() * (G0 + l).norm());
      for (const bool projected : {false, true}) {
        Steps<double> steps(p, epsilon<double> / 8, projected);
        const auto s = steps.at(t);
        const Vec3<double> G = p.inertia * s.angular_velocity;
        CAPTURE(free_bodies::name(regime), i, projected, steps.steps());
        const double slack = projected ? 1 : 20;
        CHECK(std::abs(s.angular_velocity.dot(G) / E - 1) < slack * 4e-15);
        CHECK(std::abs(G.squaredNorm() + 2 * l.dot(G) - K) < slack * 1e-14 * K_parts);
        CHECK((rotate<double>(s.attitude, s.angular_momentum) - L).norm() < slack * 4e-15 * L.norm());
        CHECK(std::abs(norm(s.attitude) - 1) < 4e-16);
      }
    }
  }
}

TEST_CASE("what does not turn stays, in the full free equations", "[free]") {
  const auto rest = Problem<double>::from_moments({3, 2, 1.5}, {1, -2, 0.5}, {0, 0, 0});
  const auto s = Steps<double>(rest).at(1000);
  CHECK(s.angular_velocity.isZero(0));
  CHECK(s.turned.isZero(0));
  CHECK(s.angular_momentum == rest.rotor_momentum);
  // M = 0: the body turns against its rotors
  const auto against = Problem<double>::from_moments({4, 3, 2}, {-2, -3, -.5}, {.5, 1, .25});
  const auto turned = Steps<double>(against).at(64);
  CHECK(turned.angular_momentum.isZero(0));
  CHECK((turned.turned - 64 * against.angular_velocity).norm() < 1e-13);
  // about the middle axis for ever
  const auto middle = Problem<double>::from_moments({4, 3, 2}, {0, .5, 0}, {0, 1, 0});
  CHECK(Steps<double>(middle).at(1000).angular_velocity[0] == 0);
}

}  // namespace free_full_test
