// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/averaging_error.hpp"

#include "bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

AveragingError<double> after_one_visit(const Problem<double>& p, double eps) {
  const auto q = polhode_through<double>(p.inverse_inertia, p.momentum);
  const auto b = ControlTorques<double>::of(eps * p.control, q.axes);
  AveragingError<double> error;
  error.visit(q, b, mean_torque<>(q, b), eps * p.drag, p.momentum.norm());
  return error;
}

double energy_of(const Problem<double>& p) { return p.energy(p.momentum); }

}  // namespace

TEST_CASE("the estimates have the orders of what they estimate", "[deceleration]") {
  Bodies bodies(17);
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = bodies.problem(1);
    const double R = p.momentum.norm();
    const double kp2 = polhode_through<double>(p.inverse_inertia, p.momentum).modulus.kp2;
    const double eps = 1e-5 * std::min(1., R * R) * kp2 * kp2;
    const auto big = after_one_visit(p, eps), small = after_one_visit(p, eps / 10);
    const auto b1 = big.first_order(R, energy_of(p)), s1 = small.first_order(R, energy_of(p));
    const auto b2 = big.second_order(), s2 = small.second_order();
    CHECK(std::log10(b1.norm / s1.norm) == Approx(1).margin(.02));
    CHECK(std::log10(b1.k2 / s1.k2) == Approx(1).margin(.02));
    CHECK(std::log10(b1.energy / s1.energy) == Approx(1).margin(.02));
    CHECK(std::log10(b2.norm / s2.norm) == Approx(2).margin(.02));
    CHECK(std::log10(b2.k2 / s2.k2) == Approx(2).margin(.02));
    CHECK(std::log10(b2.energy / s2.energy) == Approx(2).margin(.02));
    CHECK(std::log10(b2.vector / s2.vector) == Approx(1).margin(.02));
    CHECK(b1.vector == 2 * R);  // first order does not know the phase
    CHECK(big.greatest_squeeze() < .1);
  }
}

TEST_CASE("the estimates grow and never shrink along a motion", "[deceleration]") {
  Bodies bodies(18);
  const auto p = bodies.problem(1e-4);
  const auto q = polhode_through<double>(p.inverse_inertia, p.momentum);
  const auto b = ControlTorques<double>::of(p.control, q.axes);
  AveragingError<double> error;
  double before = 0;
  for (double R = 1; R > .05; R *= .8) {
    error.visit(q, b, mean_torque<>(q, b), p.drag, R);
    const double now = error.second_order().norm;
    CHECK(now >= before);
    before = now;
  }
  error.visit(q, b, mean_torque<>(q, b), p.drag, 1);
  CHECK(error.second_order().norm == before);
}

TEST_CASE("a crossing adds mu |ln mu|", "[deceleration]") {
  AveragingError<double> error;
  const V a(1 / 1.4, 1, 1 / .7);
  error.cross(.5, 1e-4, a);
  const double mu = 1e-4 / (.25 * std::sqrt((a[1] - a[0]) * (a[2] - a[1])));
  const auto e = error.first_order(1, .5);
  CHECK(e.norm >= .5 * mu * (1 - std::log(mu)) * .999);
  CHECK(e.k2 >= mu * (1 - std::log(mu)));
  CHECK(e.k2 <= 1);
  CHECK(AveragingError<double>().first_order(1, .5).norm == 0);
}
TEST_CASE("NaN is not lost", "[deceleration]") {
  const V a(1 / 1.4, 1, 1 / .7);
  const auto q = polhode_through<double>(a, V(1, .2, .3));
  const ControlTorques<double> b{gyrostat::nan<double>, 1, 1};
  AveragingError<double> error;
  error.visit(q, b, mean_torque<>(q, b), .1, 1.);
  error.visit(q, {1, 1, 1}, mean_torque<>(q, ControlTorques<double>{1, 1, 1}), .1, 1.);
  CHECK(std::isnan(error.second_order().vector));
}
