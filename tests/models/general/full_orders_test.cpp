// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/full_orders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "scenes.hpp"
#include "truth.hpp"

namespace general_full_orders_test {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr int order = 8;

/// The first coefficients of a step from the start, in units of time of `unit`, and the state at x of them.
template <bool large>
struct Expansion {
  using System = FullSystem<double, large>;
  const Problem<double>& problem;
  Prepared<double> of;
  Piece<double> piece;
  System system;
  alignas(32) double x[order + 1][System::width] = {};
  typename System::template Work<order> work;

  Expansion(const Problem<double>& p, double span, double t, double unit)
      : problem(p), of(p, span), piece(whole(of, span)), system(of, piece, first_numbers<double, large>(of)) {
    const auto start = first_numbers<double, large>(of);
    std::copy(start.begin(), start.end(), x[0]);
    system.expand(t, unit, x, work);
  }
  static Piece<double> whole(const Prepared<double>& of, double span) {
    const auto cuts = breakpoints(of.problem, span);
    return Piece<double>::first(of.problem, of.wheels, of.torques, cuts.empty() ? span : cuts[0]);
  }
  /// Component i of the derivative at s after the start of the step.
  std::array<double, System::width> rate(double s, double unit) const {
    std::array<double, System::width> sum{};
    for (std::size_t i = 0; i < sum.size(); ++i)
      for (int k = order; k >= 1; --k) sum[i] = sum[i] * (s / unit) + k * x[k][i] / unit;
    return sum;
  }
  std::array<double, System::width> at(double s, double unit) const {
    std::array<double, System::width> sum{};
    for (std::size_t i = 0; i < sum.size(); ++i)
      for (int k = order; k >= 0; --k) sum[i] = sum[i] * (s / unit) + x[k][i];
    return sum;
  }
};

/// Whether the polynomial of a step satisfies the equations as they are written, up to the order that is left out.
template <bool large>
void check_series(const general_scenes::Made& made, double share) {
  const auto& p = made.problem;
  const Prepared<double> sized(p, made.span);
  const double unit = 0.005 / sized.sizes.turning;
  const Expansion<large> step(p, made.span, 0, unit);
  if (step.piece.to < unit) return;
  const Flow<double> flow(p, step.of.wheels);
  const double s = share * unit;
  const auto x = step.at(s, unit), rate = step.rate(s, unit);
  using At = Places<large>;
  // the plain state: of wheels whose p is known it is taken from the piece
  auto y = flow.start();
  for (std::size_t i = 0; i < 4; ++i) y[i] = x[i];
  for (std::size_t i = 0; i < 3; ++i) y[4 + i] = x[4 + i];
  for (std::size_t i = 0; i < step.of.wheels.count; ++i) {
    const auto follows = step.of.wheels.laws[i].follows;
    if (follows == Follows::integral) y[8 + i] = step.piece.wheels[i].at(s);
    if (large && follows == Follows::state) y[8 + i] = x[At::wheel(i)];
  }
  if (large && !p.fixed)
    for (std::size_t i = 0; i < 3; ++i) {
      y[Flow<double>::velocity + i] = p.velocity[int(i)] + s * p.field.gravity * p.field.down[int(i)] + x[28 + i];
    }
  Flow<double>::Numbers wanted;
  flow(s, y, wanted);
  const double M = std::max(sized.sizes.momentum(), 1e-300) * sized.sizes.turning, scale = 1e-12;
  for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(rate[i] - wanted[i]) <= scale * sized.sizes.turning);
  for (std::size_t i = 4; i < 7; ++i) CHECK(std::abs(rate[i] - wanted[i]) <= scale * (M + sized.sizes.torque));
  if constexpr (large) {
    for (std::size_t i = 0; i < step.of.wheels.count; ++i) {
      if (step.of.wheels.laws[i].follows != Follows::state) continue;
      const double turn = sized.sizes.turning;
      const double size =
          (std::abs(y[8 + i]) + step.of.wheels.laws[i].axial_inertia * turn) * turn + std::abs(wanted[8 + i]);
      CHECK(std::abs(rate[At::wheel(i)] - wanted[8 + i]) <= 1e-11 * size);
      const double turning = std::abs(y[8 + i]) / step.of.wheels.laws[i].axial_inertia + sized.sizes.turning;
      CHECK(std::abs(rate[At::angle(i)] - wanted[16 + i]) <= 1e-11 * turning);
    }
    const double push = sized.sizes.force / p.mass;
    for (std::size_t i = 0; i < 3 && !p.fixed; ++i)
      CHECK(std::abs(rate[28 + i] + p.field.gravity * p.field.down[int(i)] - wanted[24 + i]) <=
            1e-12 * (push + std::abs(p.field.gravity)));
  }
}

TEST_CASE("the series of every torque and wheel satisfy the equations as they are written", "[general]") {
  general_scenes::Scenes source(61);
  int large = 0, small = 0;
  for (int i = 0; i < 300; ++i) {
    auto made = source.next(2);
    const Prepared<double> of(made.problem, made.span);
    // a brake at rest has no direction
    const double own = (made.problem.inertia * made.problem.angular_velocity).norm();
    if (own < 1e-2 * of.sizes.momenta || own < 1e-2 * of.sizes.built) continue;
    CAPTURE(i, made.kind);
    for (const double share : {0., 0.6}) {
      if (of.is_large()) check_series<true>(made, share), ++large;
      else check_series<false>(made, share), check_series<true>(made, share), ++small;
    }
  }
  CHECK(large > 50);
  CHECK(small > 50);
}

TEST_CASE("waves that drive alone may be as many as one likes", "[general]") {
  general_scenes::Made made;
  auto& p = made.problem;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.3, -0.5, 0.8};
  made.span = 10;
  for (int i = 0; i < 40; ++i) {
    Torque<double> torque;
    torque.vector = {0.1 + 0.01 * i, 0.2, -0.1};
    torque.factor.mean = 0, torque.factor.amplitude = 1, torque.factor.rate = 0.1 + 0.05 * i, torque.factor.phase = i;
    p.torques.push_back(torque);
  }
  REQUIRE(check(p).code == Errc::ok);
  for (const double share : {0., 0.6}) check_series<false>(made, share), check_series<true>(made, share);
}

TEST_CASE("the error of a step falls as its order says", "[general]") {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.3, -0.5, 0.8};
  p.fixed = true, p.mass = 2, p.centre_of_mass = {0.1, 0.2, 0.3}, p.field.gravity = 1;
  p.torques.resize(2);
  p.torques[0].type = TorqueType::weight;
  p.torques[1].type = TorqueType::brake, p.torques[1].opposed = Opposed::momentum,
  p.torques[1].vector = {0.1, 0.2, 0.3};
  const auto error = [&](double h) {
    const Expansion<false> step(p, 10, 0, h);
    const auto x = step.at(h, h);
    const auto right =
        general_truth::motion<long double>(general_truth::cast<long double>(p), {(long double)h}, 1e-18L);
    return (Vec3<double>(x[4], x[5], x[6]) - right[0].angular_momentum.cast<double>()).norm();
  };
  const double slope = std::log(error(0.8) / error(0.4)) / std::log(2.);
  CHECK(slope == Approx(order + 1).margin(0.4));
}

}  // namespace general_full_orders_test
