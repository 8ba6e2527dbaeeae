// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/full.hpp"

#include "catch.hpp"

#include <algorithm>
#include <array>

#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

static_assert(ode::TaylorSystem<FullSystem<double>>);
static_assert(ode::Projects<FullSystem<double>>);

/// The derivative of the numbers of a state, from the definitions.
template <Real S>
std::array<S, 16> rate(const Problem<S>& p, const S* x) {
  const Vec3<S> omega(x[0], x[1], x[2]);
  const Quat<S> q{x[4], x[5], x[6], x[7]};
  const Vec3<S> a = angular_acceleration<S>(p, omega);
  const Quat<S> dq = quaternion_rate<S>(q, omega);
  const S f = p.force.norm();
  const Vec3<S> d = rotate<S>(q, f > 0 ? Vec3<S>(p.force / f) : Vec3<S>(0, 0, 1));
  return {a[0], a[1], a[2],  omega[2], dq.w, dq.x, dq.y, dq.z, d[0], d[1], d[2], p.torque.dot(omega),
          x[8], x[9], x[10], 0};
}

}  // namespace

TEST_CASE("the rates change as torques say", "[spinning]") {
  Spinners random(1);
  for (int i = 0; i < 50; ++i) {
    const auto p = random.body();
    const Vec3<double>& w = p.angular_velocity;
    Vec3<double> H = p.inertia.cwiseProduct(w);
    H[2] += p.rotor_momentum;
    const Vec3<double> charge = p.charge_momentum * Vec3<double>(w[1], -w[0], 0);
    const Vec3<double> sum = p.inertia.cwiseProduct(angular_acceleration(p, w)) + cross<double>(w, H);
    CHECK((sum - p.torque - charge).norm() < 1e-13 * (H.norm() * w.norm() + p.torque.norm()));
  }
}

TEMPLATE_TEST_CASE("the series solve the equations", "[spinning]", float, double, long double) {
  using S = TestType;
  constexpr int order = 20;
  constexpr int width = FullSystem<S>::width;
  Spinners random(3);
  for (int i = 0; i < 12; ++i) {
    auto p = cast<S>(random.body(i % 3 == 0 ? 0 : 0.3));
    if (i == 1) p.force = {0, 0, S(-2)};
    if (i == 2) p.force = {0, 0, S(2)};
    if (i == 3) p.force.setZero();
    if (i == 4) p.force[2] = 0;
    if (i == 5) p.angular_velocity.setZero();
    const FullSystem<S> system(p);
    S x[order + 1][width] = {};
    typename FullSystem<S>::template Work<order> work;
    for (std::size_t k = 0; k < width; ++k) x[0][k] = system.start()[k] + (k >= 8 ? S(0.1L) * S(k) : S(0));
    x[0][15] = 0;
    // short enough that what lies beyond the order is below rounding
    const S unit = S(0.14L) / (p.angular_velocity.norm() + std::abs(p.gyroscopic()) / p.inertia.minCoeff() +
                               std::sqrt(p.torque.norm() / p.inertia.minCoeff()));
    system.expand(0, unit, x, work);
    for (const S at : {S(0), S(0.5L), S(1)}) {
      S value[width], slope[width];
      for (int k = 0; k < width; ++k) {
        value[k] = x[order][k];
        slope[k] = 0;
        for (int j = order; j >= 1; --j) {
          slope[k] = slope[k] * at + S(j) * x[j][k];
          value[k] = value[k] * at + x[j - 1][k];
        }
      }
      const auto wanted = rate(p, value);
      for (int k = 0; k < width; ++k) {
        CAPTURE(i, k, at);
        const int group = k / 4 * 4;
        S size = 0;
        for (int j = group; j < group + 4; ++j) size = std::max(size, unit * std::abs(wanted[std::size_t(j)]));
        for (int j = group; j < group + 4; ++j) size = std::max(size, std::abs(slope[j]));
        CHECK(std::abs(slope[k] - unit * wanted[std::size_t(k)]) <= 200 * epsilon<S> * size);
      }
    }
  }
}

TEST_CASE("what a state means", "[spinning]") {
  Spinners random(4);
  for (int i = 0; i < 20; ++i) {
    const auto p = random.body();
    const FullSystem<double> system(p);
    auto x = system.start();
    CHECK(system.angular_velocity(x.data()) == p.angular_velocity);
    const Vec3<double> back = angles_312(system.attitude(x.data()));
    CHECK((back - Vec3<double>(p.angles.psi, p.angles.phi, p.angles.theta)).norm() < 1e-13);
    CHECK(system.velocity(x.data()) == p.velocity);
    CHECK(system.position(0, x.data()) == p.position);
    // after a second under a force that does not turn
    const Vec3<double> d = rotate<double>(system.attitude(x.data()), p.force / p.force.norm());
    for (std::size_t k = 0; k < 3; ++k) x[8 + k] = d[int(k)], x[12 + k] = d[int(k)] / 2;
    const Vec3<double> a = acceleration(p, system.attitude(x.data()));
    CHECK((system.velocity(x.data()) - p.velocity - a).norm() < 1e-14 * (1 + a.norm()));
    CHECK((system.position(1, x.data()) - p.position - p.velocity - a / 2).norm() < 1e-14 * (2 + a.norm()));
  }
}

TEST_CASE("the projection corrects the laws and leaves a right state alone", "[spinning]") {
  Spinners random(5);
  for (int i = 0; i < 60; ++i) {
    auto p = random.body();
    const bool symmetric = i % 2 == 0, free = i % 3 == 0;
    if (symmetric) p.inertia[1] = p.inertia[0] = std::max(p.inertia[0], p.inertia[2] / 2 * 1.01);
    if (free) p.torque.setZero();
    if (i % 5 == 0) p.torque[0] = p.torque[1] = 0;
    const FullSystem<double> system(p);
    const double t = 3;
    const double r = p.spin() + p.torque[2] / p.inertia[2] * t;
    const auto kept = [&](const double* x) {
      Vec3<double> H = p.inertia.cwiseProduct(Vec3<double>(x[0], x[1], x[2]));
      H[2] += p.gyroscopic();
      return rotate<double>(Quat<double>{x[4], x[5], x[6], x[7]}, H);
    };
    auto right = system.start();
    if (symmetric) right[2] = r;
    auto wrong = right;
    for (std::size_t k = 0; k < 8; ++k)
      if (k != 3) wrong[k] += 1e-9 * random.any(-1, 1);
    const auto q = normalised(Quat<double>{wrong[4], wrong[5], wrong[6], wrong[7]});
    const double stretch = 1 + 1e-12;
    wrong[4] = stretch * q.w, wrong[5] = stretch * q.x, wrong[6] = stretch * q.y, wrong[7] = stretch * q.z;
    for (const bool off : {false, true}) {
      auto x = off ? wrong : right;
      std::array<double, 16> low{};
      system.project(t, x.data(), low.data());
      const double norm = x[4] * x[4] + x[5] * x[5] + x[6] * x[6] + x[7] * x[7];
      CHECK(std::abs(norm - 1) < 1e-15);
      if (symmetric) CHECK(x[2] == r);
      if (symmetric && p.torque[0] == 0 && p.torque[1] == 0)
        CHECK(std::hypot(x[0], x[1]) == Approx(std::hypot(right[0], right[1])).epsilon(1e-15));
      if (free) {
        const Vec3<double> target = kept(system.start().data());
        // the length of H is the projection's where it fixes the rates; its direction always
        CHECK(cross<double>(kept(x.data()), target).norm() < (off ? 1e-11 : 1e-14) * target.squaredNorm());
        const auto energy = [&](const double* y) {
          return p.inertia.dot(Vec3<double>(y[0] * y[0], y[1] * y[1], y[2] * y[2]));
        };
        if (!symmetric) CHECK(energy(x.data()) == Approx(energy(right.data())).epsilon(4e-15));
      }
      if (!off)
        for (std::size_t k = 0; k < 8; ++k)
          CHECK(std::abs(x[k] + low[k] - right[k]) < 1e-14 * (1 + std::abs(right[k])));
      for (std::size_t k = 0; k < 8; ++k) CHECK(std::abs(x[k] - right[k]) < 1e-7);
      for (std::size_t k = 8; k < 16; ++k) CHECK(x[k] == right[k]);
    }
  }
}

TEST_CASE("no scale is zero where a component is judged", "[spinning]") {
  Spinners random(6);
  for (int i = 0; i < 20; ++i) {
    auto p = random.body();
    if (i % 2 == 0) p.angular_velocity.setZero();
    if (i % 3 == 0) p.torque.setZero();
    if (i % 5 == 0) p.rotor_momentum = p.charge_momentum = 0;
    for (const double span : {0.0, 1e-3, 1e3}) {
      const auto scale = FullSystem<double>(p).scale(span);
      for (const std::size_t k : {0U, 1U, 2U, 4U, 5U, 6U, 7U, 8U, 9U, 10U}) {
        CHECK(scale[k] > 0);
        CHECK(std::isfinite(scale[k]));
      }
      for (const std::size_t k : {3U, 11U, 12U, 13U, 14U, 15U}) CHECK(scale[k] == 0);
    }
  }
}

TEST_CASE("what is not a number stays so", "[spinning]") {
  auto p = Spinners(7).body();
  p.angular_velocity[1] = gyrostat::nan<double>;
  CHECK(!angular_acceleration(p, p.angular_velocity).allFinite());
  const FullSystem<double> system(p);
  ode::TaylorOptions<double, 16> options;
  options.scale = system.scale(1);
  ode::Taylor<FullSystem<double>> solver(system, 0, system.start(), options);
  CHECK(solver.step(1) == ode::Status::not_finite);
}
