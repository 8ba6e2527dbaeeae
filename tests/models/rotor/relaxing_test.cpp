// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/relaxing.hpp"

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/ode/radau.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "models/rotor/bodies.hpp"

#include <cmath>

using namespace gyrostat;
using namespace gyrostat::rotor;
using ode::Status;

namespace {

/// The spin-up of docs/rotor.md, section 7, with R = diag(2.3, 2.9, 3.4).
template <Real S>
Gyrostat<S> spin_up(double slope) {
  const Vec3<S> e(S(0.36L), S(0.48L), S(0.8L));
  Mat3<S> theta = S(0.45L) * e * e.transpose();
  theta.diagonal() += Vec3<S>(S(2.3L), S(2.9L), S(3.4L));
  return Gyrostat<S>::make(theta, e, S(0.45L), static_cast<S>(slope), 30).value();
}

/// The rotor turning with omega relative to the carrier.
template <Real S>
State<S> start_of(const Gyrostat<S>& body, double omega) {
  State<S> state;
  const Vec3<S> m(S(0.5L), S(-0.7L), S(0.45L));
  state.momentum = 8 * m / std::sqrt(m.squaredNorm());
  state.axial_momentum = body.axial_inertia() * body.coupling() *
                         (static_cast<S>(omega) + body.axis().dot(body.free_inverse() * state.momentum));
  return state;
}

template <Real S>
using Stiff = ode::Radau<RelaxingRotor<S>>;

template <Real S>
Stiff<S> stiff(const Gyrostat<S>& body, const State<S>& start, S tolerance, S inside) {
  const RelaxingRotor<S> system(body, start);
  typename Stiff<S>::Options options;
  options.tolerance = tolerance;
  options.inside = inside;
  options.scale = system.scale(body, start);
  return {system, 0, system.components(start), options};
}

/// Angle between two attitudes, rad.
template <Real A, Real B>
double apart(const Quat<A>& a, const Quat<B>& b) {
  const Quat<long double> p{a.w, a.x, a.y, a.z}, q{b.w, b.x, b.y, b.z};
  const Quat<long double> d = conjugate(p) * q;
  return static_cast<double>(2 * std::hypot(d.x, d.y, d.z));
}

/// By Taylor series in long double.
State<long double> exact(double slope, double omega, long double t) {
  const auto body = spin_up<long double>(slope);
  const FullSystem<long double> system(body, start_of(body, omega));
  ode::TaylorOptions<long double, FullSystem<long double>::width> options;
  options.tolerance = 1e-20L;
  options.scale = system.scale();
  ode::Taylor<FullSystem<long double>, 24> solver(system, 0, system.start(), options);
  solver.advance(t);
  return system.state(t, solver.state());
}

static_assert(ode::RelaxingSystem<RelaxingRotor<float>> && ode::Projects<RelaxingRotor<long double>>);

}  // namespace

TEST_CASE("the relaxing form has the rates of the model") {
  Bodies bodies(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Gyrostat<double> body = bodies.realisable();
    const State<double> state = bodies.start(body);
    const RelaxingRotor<double> system(body, state);
    const auto x = system.components(state);

    const State<double> back = system.state(x.data());
    CHECK(apart(back.attitude, state.attitude) < 1e-14);
    CHECK((back.momentum - state.momentum).norm() < 1e-14);
    CHECK(back.axial_momentum == state.axial_momentum);
    CHECK(back.rotor_angle == state.rotor_angle);

    Lanes<double> y[8], rate[8];
    for (int i = 0; i < 8; ++i) y[i] = lanes(x[static_cast<std::size_t>(i)]);
    const Lanes<double> p = lanes(x[8]);
    system.rates({}, y, &p, rate);
    const State<double> expected = state_rate(body, state);
    const Quat<double> q_BF = from_matrix<double>(body.free_axes().R_BP);
    const Quat<double> turned = expected.attitude * q_BF;
    CHECK(std::abs(rate[0][1] - turned.w) < 1e-13);
    CHECK(std::abs(rate[1][2] - turned.x) < 1e-13);
    CHECK(std::abs(rate[2][3] - turned.y) < 1e-13);
    CHECK(std::abs(rate[3][0] - turned.z) < 1e-13);
    const Vec3<double> H = body.free_axes().R_BP.transpose() * expected.momentum;
    for (int i = 0; i < 3; ++i) CHECK(std::abs(rate[4 + i][0] - H[i]) < 1e-13);
    CHECK(std::abs(rate[7][0] - expected.rotor_angle) < 1e-13);
    Lanes<double> source;
    system.sources({}, y, &source);
    const double pull = source[0] - system.rate(0) * x[8];
    CHECK(std::abs(pull - expected.axial_momentum) < 1e-12);
  }
}

TEST_CASE("the projection restores unit norm and the angular momentum") {
  Bodies bodies(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Gyrostat<double> body = bodies.realisable();
    const State<double> state = bodies.start(body);
    const RelaxingRotor<double> system(body, state);
    auto x = system.components(state);
    for (double& v : x) v *= 1 + 1e-8;
    RelaxingRotor<double>::Components low{};
    system.project(0, x.data(), low.data());
    CHECK(std::abs(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - 1) < 1e-15);
    const State<double> projected = system.state(x.data());
    const Vec3<double> L = rotate(projected.attitude, projected.momentum);
    CHECK((L - rotate(state.attitude, state.momentum)).norm() < 2e-14);
    CHECK(apart(projected.attitude, state.attitude) < 1e-13);
  }
}

TEST_CASE("agrees with the Taylor series where the motor is not stiff") {
  for (const double slope : {0.0, 0.05, 5.0}) {
    const auto body = spin_up<double>(slope);
    const State<long double> end = exact(slope, 0, 50);
    auto solver = stiff(body, start_of(body, 0), 1e-15, 1e-12);
    REQUIRE(solver.advance(50) == Status::reached);
    const State<double> answer = RelaxingRotor<double>(body, start_of(body, 0)).state(solver.state());
    CAPTURE(slope, solver.counts().steps);
    CHECK(apart(answer.attitude, end.attitude) < 3e-13);
    CHECK((answer.momentum - end.momentum.cast<double>()).norm() < 2e-12);
    CHECK(std::abs(answer.axial_momentum - static_cast<double>(end.axial_momentum)) < 1e-12);
    CHECK(answer.rotor_angle == Approx(static_cast<double>(end.rotor_angle)).epsilon(1e-12));
  }
}

TEST_CASE("a stiffer motor costs no more and loses no digits") {
  // relaxation rates from 13 to 1.3e5 1/s; omega = omega* at the start, so that p follows its source from the beginning but for
  // what the turning body adds
  std::uint64_t fewest = 1000000, most = 0;
  for (const double slope : {5.0, 50.0, 500.0, 5e3, 5e4}) {
    const auto body = spin_up<double>(slope);
    auto solver = stiff(body, start_of(body, 30), 1e-14, 1e-11);
    REQUIRE(solver.advance(200) == Status::reached);
    const auto fine = spin_up<long double>(slope);
    auto truth = stiff<long double>(fine, start_of(fine, 30), 1e-19L, 1e-16L);
    REQUIRE(truth.advance(200) == Status::reached);
    const State<double> answer = RelaxingRotor<double>(body, start_of(body, 30)).state(solver.state());
    const State<long double> end = RelaxingRotor<long double>(fine, start_of(fine, 30)).state(truth.state());
    if (slope == 5) CHECK(apart(end.attitude, exact(slope, 30, 200).attitude) < 1e-15);
    CAPTURE(slope, solver.counts().steps, solver.counts().rhs);
    CHECK(apart(answer.attitude, end.attitude) < 1e-11);
    CHECK(std::abs(answer.axial_momentum - static_cast<double>(end.axial_momentum)) < 1e-11);
    fewest = std::min(fewest, solver.counts().rhs);
    most = std::max(most, solver.counts().rhs);
  }
  CHECK(10 * most < 13 * fewest);
}

TEST_CASE("the stiff limit is the motor that keeps its rate") {
  // S -> infinity: omega = omega* and V is constant; the departure falls like 1/S
  const auto departure = [](double slope) {
    const auto body = spin_up<double>(slope);
    const auto start = start_of(body, 30);
    auto solver = stiff(body, start, 1e-14, 1e-11);
    const RelaxingRotor<double> system(body, start);
    REQUIRE(solver.advance(20) == Status::reached);
    const State<double> end = system.state(solver.state());
    return body.lyapunov(start.momentum, start.axial_momentum) - body.lyapunov(end.momentum, end.axial_momentum);
  };
  const double a = departure(1e4), b = departure(1e5);
  CHECK(a > 0);
  CHECK(std::log10(a / b) == Approx(1).margin(0.15));
}

TEST_CASE("V falls and the angular momentum stays, from any start, however stiff the motor") {
  Bodies bodies(7);
  for (const double factor : {1.0, 1e3, 1e6}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Gyrostat<double> plain = bodies.realisable();
      const auto body = Gyrostat<double>::make(plain.inertia(), plain.axis(), plain.axial_inertia(),
                                               factor * plain.slope(), plain.no_load_rate())
                            .value();
      const State<double> start = bodies.start(plain);  // the rotor far from omega*
      const RelaxingRotor<double> system(body, start);
      auto solver = stiff(body, start, 1e-14, 1e-11);
      const Vec3<double> L = rotate(start.attitude, start.momentum);
      const double first = body.lyapunov(start.momentum, start.axial_momentum);
      double before = first;
      while (solver.time() < 20) {
        REQUIRE(solver.step(20) == Status::reached);
        const State<double> now = system.state(solver.state());
        const double V = body.lyapunov(now.momentum, now.axial_momentum);
        CHECK(V <= before + 1e-10 * first);
        before = V;
        CHECK((rotate(now.attitude, now.momentum) - L).norm() < 1e-14 * L.norm());
      }
      CAPTURE(factor, solver.counts().steps, solver.counts().rejected);
      CHECK(solver.counts().steps < 2000);
      CHECK(solver.counts().rejected < 100);
    }
  }
}

TEST_CASE("the stiff path allocates nothing") {
  const auto body = spin_up<double>(5e3);
  const auto start = start_of(body, 0);
  const std::size_t before = allocations();
  auto solver = stiff(body, start, 1e-12, 1e-9);
  const Status status = solver.advance(5);
  CHECK(allocations() == before);
  CHECK(status == Status::reached);
}
