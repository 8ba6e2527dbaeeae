// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/design.hpp"

#include <algorithm>
#include <cmath>

#include "allocations.hpp"
#include "catch.hpp"
#include "models/spinning/spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

Problem<double> upper_stage() {
  Problem<double> p;
  p.inertia = {2985, 2729, 4183};
  p.mass = 2017;
  p.torque = {4, -2, 0};
  p.force = {2, -1, 400};
  p.angular_velocity = {0, 0, 1.0471975511965976};
  return p;
}

double ratio(const Problem<double>& p) { return math::magnitude(secular_velocity_ratio(p)); }

bool points_within(Problem<double> p, double spin, double budget) {
  p.angular_velocity[2] = spin;
  return p.nutation_squared() > 0 && pointing_error(p) <= budget;
}

State<double> from_rest(Problem<double> p, double t) {
  p.velocity = p.position = Vec3<double>(0, 0, 0);
  return Linear<double>(p).at(t);
}

Vec3<double> drift(const Problem<double>& p, double t) {
  return from_rest(p, t).position.cwiseProduct(Vec3<double>(1, 1, 0));
}

Vec3<double> increment(const Problem<double>& p, double t) { return from_rest(p, t).velocity; }

}  // namespace

TEST_CASE("the least spin points within the budget, and no slower one does", "[spinning]") {
  Spinners random(1201);
  int at_limit = 0, none = 0, between = 0;
  for (int i = 0; i < 1500; ++i) {
    auto p = random.spinner(0.05);
    p.rotor_momentum = random.any(-2, 2) * std::abs(p.inertia[2] * p.spin());
    const double budget = random.log_any(1e-4, 0.3);
    const auto made = spin_for_pointing(p, budget);
    const double sense = p.spin() < 0 ? -1 : 1;
    if (!made) {
      CHECK(made.error() == Errc::not_applicable);
      for (double x = 1e-4; x < 1e4; x *= 1.02) CHECK_FALSE(points_within(p, sense * x, budget));
      ++none;
      continue;
    }
    const double x = sense * made->value;
    REQUIRE(x > 0);
    CHECK(made->problem.spin() == made->value);
    if (made->flags.unstable) {
      CHECK(points_within(p, made->value * (1 + 1e-9), budget));
      ++at_limit;
    } else {
      CHECK(std::abs(pointing_error(made->problem) / budget - 1) < 2e-12);
      CHECK(made->problem.nutation_squared() > 0);
      if (made->problem.effective_momentum() * made->value < 0) ++between;
    }
    for (int k = 0; k < 200; ++k) {
      const double slower = x * (k < 100 ? 1 - 1e-9 * (k + 1) * (k + 1) * (k + 1) : std::exp(-0.1 * (k - 99)));
      if (slower > 0 && slower < x * (1 - 1e-9)) CHECK_FALSE(points_within(p, sense * slower, budget));
    }
  }
  CHECK(at_limit > 20);
  CHECK(none > 20);
  CHECK(between > 20);
}

TEST_CASE("the least spin has no cancellation", "[spinning]") {
  for (const double lambda3 : {1e6, 1e9, -1e6, -1e9}) {
    auto p = upper_stage();
    p.rotor_momentum = lambda3;
    const auto made = spin_for_pointing(p, 1e-3);
    REQUIRE(made);
    auto exact = cast<long double>(p);
    exact.angular_velocity[2] = made->value;
    CHECK(double(std::abs(pointing_error(exact) / 1e-3L - 1)) < 1e-14);
  }
}

TEST_CASE("a spin that cannot be found is refused by name", "[spinning]") {
  const auto p = upper_stage();
  for (const double wrong : {0.0, -1.0, gyrostat::nan<double>, infinity<double>})
    CHECK(spin_for_pointing(p, wrong).error() == Errc::out_of_domain);
  auto still = p;
  still.torque = {0, 0, 0};
  CHECK(spin_for_pointing(still, 0.01).error() == Errc::zero_vector);
  auto driven = p;
  driven.torque[2] = 1;
  CHECK(spin_for_pointing(driven, 0.01).error() == Errc::not_applicable);
  auto intermediate = p;
  intermediate.inertia = {4183, 2729, 2985};
  CHECK(spin_for_pointing(intermediate, 0.01).error() == Errc::not_applicable);
  auto sphere = p;
  sphere.inertia = {3, 3, 3};
  CHECK(spin_for_pointing(sphere, 0.01).error() == Errc::not_applicable);
}

TEST_CASE("the greatest torque leans the velocity by the budget, and no smaller one leans it more", "[spinning]") {
  Spinners random(1202);
  int answered = 0, refused = 0, unlimited = 0;
  for (int i = 0; i < 3000; ++i) {
    auto p = random.spinner(0.05);
    p.torque = random.vector().cwiseProduct(Vec3<double>(1, 1, 0));
    p.force = random.vector();
    if (i % 2) p.angular_velocity[0] = 0.1 * p.spin();
    const double budget = random.log_any(1e-3, 1.4);
    const auto made = torque_for_direction(p, budget);
    auto q = p;
    if (!made) {
      CHECK(made.error() == Errc::not_applicable);
      q.torque = {0, 0, 0};
      CHECK((!(p.nutation_squared() > 0) || ratio(q) > std::tan(budget)));
      ++refused;
      continue;
    }
    const bool endless = made->value == infinity<double>;
    if (!endless) {
      CHECK(std::abs(ratio(made->problem) / std::tan(budget) - 1) < 1e-9);
      CHECK(std::hypot(made->problem.torque[0], made->problem.torque[1]) == Approx(made->value));
      CHECK(made->problem.torque[0] * p.torque[1] == Approx(made->problem.torque[1] * p.torque[0]));
    }
    endless ? ++unlimited : ++answered;
    for (int k = 0; k < 300; ++k) {
      const double size = endless ? std::exp(0.1 * (k - 150)) : made->value * (1 - 1e-6) * k / 300;
      q.torque = size * p.torque / std::hypot(p.torque[0], p.torque[1]);
      if (!(ratio(q) <= std::tan(budget) * (1 + 1e-9))) {
        CAPTURE(i, k, budget, ratio(q));
        CHECK(false);
        break;
      }
    }
  }
  CHECK(answered > 500);
  CHECK(refused > 100);
  CHECK(unlimited > 5);
}

TEST_CASE("without transverse force the torque is tan(budget) |r X|", "[spinning]") {
  auto p = upper_stage();
  p.force = {0, 0, 400};
  const auto made = torque_for_direction(p, 0.01);
  REQUIRE(made);
  CHECK(made->value == Approx(std::tan(0.01) * std::abs(p.spin() * p.effective_momentum())).epsilon(1e-14));
  CHECK(made->small_tilt());
  CHECK(made->tilt >= 0.01);
}

TEST_CASE("a torque that cannot be found is refused by name", "[spinning]") {
  const auto p = upper_stage();
  for (const double wrong : {0.0, -0.1, 1.6, 4.0, gyrostat::nan<double>, infinity<double>})
    CHECK(torque_for_direction(p, wrong).error() == Errc::out_of_domain);
  auto still = p;
  still.torque = {0, 0, 0};
  CHECK(torque_for_direction(still, 0.01).error() == Errc::zero_vector);
  auto q = p;
  q.force[2] = 0;
  CHECK(torque_for_direction(q, 0.01).error() == Errc::not_applicable);
  q = p;
  q.inertia = {4183, 2729, 2985};
  CHECK(torque_for_direction(q, 0.01).error() == Errc::not_applicable);
  q = p;
  q.angles.psi = 0.02;
  CHECK(torque_for_direction(q, 0.01).error() == Errc::not_applicable);
}

TEST_CASE("a burn ends when the budget is first reached", "[spinning]") {
  Spinners random(1203);
  int turns = 0;
  for (int i = 0; i < 400; ++i) {
    auto p = random.spinner(random.log_any(1e-4, 1));
    p.force = random.vector() * random.log_any(0.1, 10);
    if (i % 3 == 0) p.force[0] = p.force[1] = 0;
    if (i % 4 == 0) p.angular_velocity = random.vector() * p.spin();  // any spin, unstable ones too
    const double size = p.force.norm() / p.mass / (p.spin() * p.spin());
    const double budget = size * random.log_any(1e-3, 1e3);
    for (const bool velocity : {false, true}) {
      const auto made = velocity ? burn_for_velocity(p, budget) : burn_for_displacement(p, budget);
      REQUIRE(made);
      const double T = made->value;
      const auto reached = [&](double t) { return (velocity ? increment(p, t) : drift(p, t)).norm(); };
      CHECK(std::abs(reached(T) / budget - 1) < 1e-11);
      CHECK(made->problem.position == p.position);
      turns += T * std::abs(p.spin()) > 6;
      for (int k = 1; k < 200; ++k) {
        if (!(reached(T * k / 200) < budget)) {
          CAPTURE(i, k, velocity, T);
          CHECK(false);
          break;
        }
      }
    }
  }
  CHECK(turns > 100);
}

TEST_CASE("a burn that grazes the budget first is not stepped over", "[spinning]") {
  // without torque a transverse force drives the velocity round a circle
  auto p = upper_stage();
  p.torque = {0, 0, 0};
  p.force = {10, 0, 0};
  const double most = 2 * p.force[0] / p.mass / p.spin();
  const auto before = burn_for_velocity(p, most * (1 - 1e-12));
  REQUIRE(before);
  CHECK(before->value * p.spin() == Approx(3.14159265358979).epsilon(1e-5));
  CHECK(burn_for_velocity(p, most * (1 + 1e-9)).error() == Errc::step_limit);
}

TEST_CASE("burns at the edges", "[spinning]") {
  auto p = upper_stage();
  CHECK(burn_for_displacement(p, 0.0).error() == Errc::out_of_domain);
  CHECK(burn_for_velocity(p, gyrostat::nan<double>).error() == Errc::out_of_domain);
  auto coasting = p;
  coasting.force = {0, 0, 0};
  CHECK(burn_for_displacement(coasting, 1.0)->value == infinity<double>);
  CHECK(burn_for_velocity(coasting, 1.0)->value == infinity<double>);
  auto driven = p;
  driven.torque[2] = 1;
  CHECK(burn_for_velocity(driven, 1.0).error() == Errc::not_applicable);

  // a body at rest that is pushed along one line
  Problem<double> still;
  still.force = {3, 0, 0};
  still.mass = 2;
  still.velocity = {1, 2, 3};
  CHECK(burn_for_displacement(still, 12.0)->value == Approx(4.0).epsilon(1e-13));
  CHECK(burn_for_velocity(still, 12.0)->value == Approx(8.0).epsilon(1e-13));

  // the square of the budget is no number
  CHECK(burn_for_velocity(p, 1e300).error() == Errc::out_of_domain);
  CHECK(burn_for_displacement(p, 1e-200).error() == Errc::out_of_domain);

  auto unstable = p;
  unstable.inertia = {4183, 2729, 2985};
  const auto made = burn_for_displacement(unstable, 1.0);
  REQUIRE(made);
  CHECK(made->flags.unstable);
  CHECK(drift(unstable, made->value).norm() == Approx(1.0));
}

TEST_CASE("designs allocate nothing", "[spinning]") {
  const auto p = upper_stage();
  const std::size_t before = allocations();
  const auto spin = spin_for_pointing(p, 0.01), torque = torque_for_direction(p, 0.01);
  const auto drifted = burn_for_displacement(p, 1.0), faster = burn_for_velocity(p, 1.0);
  CHECK(allocations() == before);
  CHECK((spin && torque && drifted && faster));
}
