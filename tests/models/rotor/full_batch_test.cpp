// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/full_batch.hpp"

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/ode/taylor_batch.hpp"
#include "models/rotor/bodies.hpp"

#include <cmath>
#include <limits>

using namespace gyrostat;
using namespace gyrostat::rotor;
using ode::Status;

namespace {

template <Real S>
using Batch = ode::TaylorBatch<FullBatch<S>>;

template <Real S>
Batch<S> empty(S tolerance) {
  ode::TaylorBatchOptions<S> options;
  options.tolerance = tolerance;
  return Batch<S>(FullBatch<S>{}, options);
}

template <Real S>
void put(Batch<S>& batch, int b, const Gyrostat<S>& body, const State<S>& start) {
  batch.system().set(b, body, start);
  batch.start(b, 0, batch.system().start(b), batch.system().scale(b));
}

template <Real S>
State<S> state_of(const Batch<S>& batch, int b) {
  return batch.system().state(b, batch.time(b), batch.state(b));
}

template <Real S>
Gyrostat<S> precise(const Gyrostat<double>& body) {
  return Gyrostat<S>::make(body.inertia().cast<S>(), body.axis().cast<S>(), static_cast<S>(body.axial_inertia()),
                           static_cast<S>(body.slope()), static_cast<S>(body.no_load_rate()))
      .value();
}
template <Real S>
State<S> precise(const State<double>& x) {
  const auto& [w, i, j, k] = x.attitude;
  return {Quat<S>{static_cast<S>(w), static_cast<S>(i), static_cast<S>(j), static_cast<S>(k)}, x.momentum.cast<S>(),
          static_cast<S>(x.axial_momentum), static_cast<S>(x.rotor_angle)};
}

/// By one Taylor series in long double.
State<double> exact(const Gyrostat<double>& body, const State<double>& start, double t) {
  const auto fine = precise<long double>(body);
  const FullSystem<long double> system(fine, precise<long double>(start));
  ode::TaylorOptions<long double, FullSystem<long double>::width> options;
  options.tolerance = 1e-19L;
  options.scale = system.scale();
  ode::Taylor<FullSystem<long double>> solver(system, 0, system.start(), options);
  REQUIRE(solver.advance(t) == Status::reached);
  const State<long double> x = system.state(t, solver.state());
  return {{static_cast<double>(x.attitude.w), static_cast<double>(x.attitude.x), static_cast<double>(x.attitude.y),
           static_cast<double>(x.attitude.z)},
          x.momentum.cast<double>(),
          static_cast<double>(x.axial_momentum),
          static_cast<double>(x.rotor_angle)};
}

double apart(const Quat<double>& a, const Quat<double>& b) {
  const Quat<double> d = conjugate(a) * b;
  return 2 * std::hypot(d.x, d.y, d.z);
}

static_assert(ode::BatchSystem<FullBatch<double>> && ode::BatchCarries<FullBatch<float>>);

}  // namespace

TEMPLATE_TEST_CASE("the first coefficients are the rates of the model", "", float, double, long double) {
  using S = TestType;
  Bodies bodies(11);
  auto batch = empty<S>(epsilon<S>);
  Gyrostat<S> body[8];
  State<S> start[8];
  S x[3][6][8], unit[8];
  for (int b = 0; b < 8; ++b) {
    const auto plain = bodies.realisable();
    body[b] = precise<S>(plain);
    start[b] = precise<S>(bodies.start(plain));
    batch.system().set(b, body[b], start[b]);
    for (int i = 0; i < 6; ++i) x[0][i][b] = batch.system().start(b)[static_cast<std::size_t>(i)];
    unit[b] = S(1) / static_cast<S>(1 + b);
  }
  typename FullBatch<S>::template Work<2> work;
  batch.system().expand(unit, x, work);
  for (int b = 0; b < 8; ++b) {
    const State<S> rate = state_rate(body[b], start[b]);
    const Vec3<S> H = body[b].free_axes().R_BP.transpose() * rate.momentum;
    // at the begin of a step H has the direction of n, and psi turns with Omega about it
    const Vec3<S> Omega = body[b].angular_velocity(start[b].momentum, start[b].axial_momentum);
    const S about = Omega.dot(start[b].momentum) / start[b].momentum.norm();
    const S expected[6] = {H[0], H[1], H[2], rate.axial_momentum, rate.rotor_angle - body[b].no_load_rate(), about};
    const S size = start[b].momentum.norm() + std::abs(start[b].axial_momentum) + 1;
    for (int i = 0; i < 6; ++i) {
      CHECK(std::abs(x[1][i][b] / unit[b] - expected[i]) < 2000 * size * size * epsilon<S>);
    }
    const State<S> back = batch.system().state(b, 0, batch.system().start(b));
    CHECK((back.momentum - start[b].momentum).norm() < 20 * size * epsilon<S>);
    CHECK(back.axial_momentum == start[b].axial_momentum);
    CHECK(back.rotor_angle == start[b].rotor_angle);
  }
}

TEST_CASE("each lane agrees with a single integration in long double") {
  Bodies bodies(12);
  for (int trial = 0; trial < 6; ++trial) {
    auto batch = empty<double>(1e-16);
    Gyrostat<double> body[8];
    State<double> start[8];
    for (int b = 0; b < 8; ++b) {
      body[b] = bodies.realisable();
      start[b] = bodies.start(body[b]);
      put(batch, b, body[b], start[b]);
    }
    REQUIRE(batch.advance(5));
    for (int b = 0; b < 8; ++b) {
      const State<double> x = state_of(batch, b), truth = exact(body[b], start[b], 5);
      const double l = start[b].momentum.norm();
      CAPTURE(trial, b, batch.counts(b).steps, batch.counts(b).rejected, l);
      CHECK(apart(x.attitude, truth.attitude) < 1e-12);
      CHECK((x.momentum - truth.momentum).norm() < 1e-12 * l);
      CHECK(std::abs(x.axial_momentum - truth.axial_momentum) < 1e-12 * (l + std::abs(truth.axial_momentum)));
      CHECK(std::abs(x.rotor_angle - truth.rotor_angle) < 1e-12 * (100 + std::abs(truth.rotor_angle)));
      // exactly on the laws
      const Vec3<double> L = rotate(start[b].attitude, start[b].momentum);
      CHECK((rotate(x.attitude, x.momentum) - L).norm() < 4e-15 * l);
    }
  }
}

TEST_CASE("the lanes take about as many steps as the single series, whose quaternion they have as an angle") {
  Bodies bodies(13);
  auto batch = empty<double>(1e-14);
  std::uint64_t single[8];
  for (int b = 0; b < 8; ++b) {
    const auto body = bodies.realisable();
    const auto start = bodies.start(body);
    put(batch, b, body, start);
    const FullSystem<long double> system(precise<long double>(body), precise<long double>(start));
    ode::TaylorOptions<long double, FullSystem<long double>::width> options;
    options.tolerance = 1e-14L;
    options.scale = system.scale();
    ode::Taylor<FullSystem<long double>> solver(system, 0, system.start(), options);
    REQUIRE(solver.advance(20) == Status::reached);
    single[b] = solver.counts().steps;
  }
  REQUIRE(batch.advance(20));
  for (int b = 0; b < 8; ++b) {
    CHECK(static_cast<double>(batch.counts(b).steps) == Approx(static_cast<double>(single[b])).epsilon(0.25).margin(2));
  }
}

TEST_CASE("a lane with NaN, one without motion and one without motor disturb nobody") {
  Bodies bodies(14);
  auto batch = empty<double>(1e-16);
  Gyrostat<double> body[8];
  State<double> start[8];
  for (int b = 0; b < 8; ++b) {
    body[b] = bodies.realisable();
    start[b] = bodies.start(body[b]);
  }
  start[1].momentum[1] = std::numeric_limits<double>::quiet_NaN();
  start[2] = State<double>{};  // no direction of H
  body[2] = Gyrostat<double>{};
  body[3] = Gyrostat<double>::make(body[3].inertia(), body[3].axis(), body[3].axial_inertia(), 0, 5).value();
  start[4].momentum *= 1e-12;
  for (int b = 0; b < 8; ++b) put(batch, b, body[b], start[b]);
  CHECK(!batch.advance(5));
  CHECK(batch.status(1) == Status::not_finite);
  CHECK(batch.status(2) == Status::not_finite);
  CHECK(std::abs(state_of(batch, 3).axial_momentum - start[3].axial_momentum) <
        1e-15 * std::abs(start[3].axial_momentum));
  for (int b = 0; b < 8; ++b) {
    if (b == 1 || b == 2) continue;  // those that have failed
    CAPTURE(b);
    CHECK(batch.status(b) == Status::reached);
    const State<double> truth = exact(body[b], start[b], 5);
    CHECK(apart(state_of(batch, b).attitude, truth.attitude) < 1e-12);
  }
}

TEST_CASE("the states of all lanes at once are those of each") {
  Bodies bodies(16);
  auto batch = empty<double>(1e-12);
  for (int b = 0; b < 8; ++b) {
    const auto body = bodies.realisable();
    put(batch, b, body, bodies.start(body));
  }
  Batch<double>::Ends ends;
  ends.fill(100);
  for (int trip = 0; trip < 5; ++trip) batch.step(ends);
  std::array<double, 8> t;
  for (std::size_t b = 0; b < 8; ++b) t[b] = (0.3 * batch.previous_time(int(b)) + 0.7 * batch.time(int(b)));
  alignas(64) Batch<double>::Rows numbers;
  alignas(64) double states[9][8];
  batch.at(t, numbers);
  batch.system().states(t, numbers, states);
  for (int b = 0; b < 8; ++b) {
    const double at = t[std::size_t(b)];
    const State<double> one = batch.system().state(b, at, batch.at(b, at));
    const double l = one.momentum.norm();
    CHECK(apart({states[0][b], states[1][b], states[2][b], states[3][b]}, one.attitude) < 2e-15);
    for (int i = 0; i < 3; ++i) CHECK(std::abs(states[4 + i][b] - one.momentum[i]) < 4e-15 * l);
    CHECK(states[7][b] == Approx(one.axial_momentum).epsilon(1e-14));
    CHECK(states[8][b] == Approx(one.rotor_angle).epsilon(1e-13));
  }
}

TEST_CASE("the batch allocates nothing") {
  Bodies bodies(15);
  const auto body = bodies.realisable();
  const auto start = bodies.start(body);
  auto batch = empty<double>(1e-12);
  const std::size_t before = allocations();
  for (int b = 0; b < 8; ++b) put(batch, b, body, start);
  const bool reached = batch.advance(5);
  const State<double> middle = batch.system().state(3, 4.99, batch.at(3, 4.99));
  CHECK(allocations() == before);
  CHECK(reached);
  CHECK(middle.momentum.allFinite());
}
