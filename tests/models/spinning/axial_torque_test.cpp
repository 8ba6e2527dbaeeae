// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/axial_torque.hpp"

#include "catch.hpp"

#include <array>
#include <cmath>

#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

static_assert(ode::TaylorSystem<AxialTorqueSystem<double>>);
static_assert(ode::Projects<AxialTorqueSystem<double>>);

/// The derivative of the numbers of a state at t, from the definitions.
template <Real S>
std::array<S, 24> rate_of(const Problem<S>& p, S t, const S* x) {
  const S r = p.spin() + p.torque[2] / p.inertia[2] * t;
  return {p.torque[0] / p.inertia[0] - p.kappa1(r) * x[1],
          p.torque[1] / p.inertia[1] + p.kappa2(r) * x[0],
          x[0] + r * x[3],
          x[1] - r * x[2],
          -r * x[5],
          r * x[4],
          (p.inertia[0] - p.inertia[1]) / p.inertia[2] * x[0] * x[1],
          (x[1] * x[2] - x[0] * x[3]) / 2 + x[6],
          x[4],
          x[5],
          x[4] * x[2] - x[5] * x[3],
          x[4] * x[3] + x[5] * x[2],
          x[2],
          x[3],
          (x[2] * x[2] + x[3] * x[3]) / 2,
          0,
          x[8],
          x[9],
          x[10],
          x[11],
          x[12],
          x[13],
          0,
          0};
}

}  // namespace

TEMPLATE_TEST_CASE("the series solve the linear equations under an axial torque", "[spinning]", float, double,
                   long double) {
  using S = TestType;
  constexpr int order = 24, width = AxialTorqueSystem<S>::width;
  Spinners random(3);
  for (int i = 0; i < 10; ++i) {
    auto p = cast<S>(random.body(0.3));
    p.angles = {S(0.3L), S(-0.2L), 1};
    if (i == 0) p.angular_velocity[2] = 0;
    const AxialTorqueSystem<S> system(p);
    const S t = S(0.5L) / p.angular_velocity.norm();
    S x[order + 1][width] = {};
    typename AxialTorqueSystem<S>::template Work<order> work;
    for (std::size_t k = 0; k < width; ++k) x[0][k] = system.start()[k] + (k >= 6 ? S(0.1L) : S(0));
    for (const std::size_t k : {15U, 22U, 23U}) x[0][k] = 0;
    const S unit = S(0.2L) / (std::abs(system.spin(t)) + std::abs(p.kappa1(system.spin(t))) +
                              std::abs(p.kappa2(system.spin(t))) + std::sqrt(p.torque.norm() / p.inertia.minCoeff()));
    system.expand(t, unit, x, work);
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
      const auto wanted = rate_of(p, t + at * unit, value);
      for (int k = 0; k < width; ++k) {
        CAPTURE(i, k, at);
        S size = 0;
        for (int j = k / 4 * 4; j < k / 4 * 4 + 4; ++j) size = std::max(size, unit * std::abs(wanted[std::size_t(j)]));
        CHECK(std::abs(slope[k] - unit * wanted[std::size_t(k)]) <= 200 * epsilon<S> * size);
      }
    }
  }
}

TEST_CASE("what the numbers of the start mean", "[spinning]") {
  auto p = Spinners(4).spinner(1e-3);
  p.torque[2] = 0.1;
  const AxialTorqueSystem<double> system(p);
  const auto s = system.state(0, system.start().data());
  CHECK(s.angular_velocity == p.angular_velocity);
  CHECK(s.angles.psi == p.angles.psi);
  CHECK(s.angles.theta == p.angles.theta);
  CHECK(s.velocity == p.velocity);
  CHECK(s.position == p.position);
  // to third and fourth order in the tilt
  const Vec3<double> G = inertial_momentum(p, s.angular_velocity, s.attitude);
  CHECK((s.momentum_I - G).head<2>().norm() < 1e-9 * G.norm());
  CHECK(std::abs(s.momentum_I[2] - G[2]) < 1e-12 * G.norm());
  CHECK(system.spin(2) == Approx(p.spin() + 0.2 / p.inertia[2]));
  CHECK(system.theta(2) == Approx(p.angles.theta + 2 * p.spin() + 0.2 / p.inertia[2]));
}

TEST_CASE("the scales of an axial torque are never zero where a component is judged", "[spinning]") {
  Spinners random(6);
  for (int i = 0; i < 20; ++i) {
    auto p = random.body();
    if (i % 2 == 0) p.angular_velocity.setZero();
    if (i % 3 == 0) p.torque.setZero();
    if (i % 4 == 0) p.angles = {};
    for (const double span : {0.0, 1e-3, 1e3}) {
      const auto scale = AxialTorqueSystem<double>(p).scale(span);
      for (std::size_t k = 0; k < scale.size(); ++k) {
        const bool judged = k < 6 || (k >= 8 && k < 14);
        CHECK((scale[k] > 0) == judged);
        CHECK(std::isfinite(scale[k]));
      }
    }
  }
}
