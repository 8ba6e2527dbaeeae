// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/reduced.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostats.hpp"
#include "reference_table.hpp"

namespace free_reduced_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Assembly;
using gyrostat::free::Motion;
using gyrostat::free::Reduced;
using gyrostat::free::UnsoundWheel;
using Wide = DoubleDouble;
using V = Vec3<double>;

Assembly<double> assembly_of(const free_reference::Case& c) {
  Assembly<double> a{c.problem, {}};
  for (const auto& r : c.rotors) a.wheels.push_back({r.axis, r.axial_inertia, r.rate, r.free});
  return a;
}

TEST_CASE("bodies with held and free rotors meet the reference cases", "[free]") {
  int seen = 0;
  for (const auto& c : free_reference::read()) {
    if (c.rotors.empty()) continue;
    ++seen;
    CAPTURE(c.id);
    const auto reduced = Reduced<Wide>::of(assembly_of(c));
    REQUIRE(reduced);
    auto problem = reduced->problem;
    problem.attitude = normalised(problem.attitude);
    const auto m = Motion<double>::make<Wide>(problem);
    const auto full = Motion<Wide>::make<Wide>(problem);
    REQUIRE(m);
    const auto coarse = Motion<double>::make(Reduced<double>::of(assembly_of(c))->problem);
    REQUIRE(coarse);
    for (const auto& at : c.at) {
      const State<Wide> truth{at.angular_velocity, at.angular_momentum, at.attitude};
      const auto s = m->at(at.t);
      CHECK(off(s, truth).rates < 1e-15);
      CHECK(off(s, truth).attitude < 2e-15);
      CHECK(off(coarse->at(at.t), truth).rates < 4 * c.rate_ulp + 1e-15);
      CHECK(off(coarse->at(at.t), truth).attitude < 4 * c.attitude_ulp + 4e-15);
      CHECK(off(full->at(at.t), truth).rates < 1e-28);
      for (std::size_t i = 0; i < c.rotors.size(); ++i)
        CHECK(std::abs(double(reduced->wheel_rate(i, full->at(at.t).angular_velocity) - at.rotor_rate[i])) < 1e-27);
    }
  }
  CHECK(seen == 3);
}

TEST_CASE("a free rotor follows the equations of body and rotor", "[free]") {
  // J w' + I v' u = (J w + I v u) x w and v' + u.w' = 0, by a fine Runge-Kutta of the classical kind
  Assembly<double> a;
  a.body.inertia << 5, .2, -.1, .2, 4, .3, -.1, .3, 3;
  a.body.angular_velocity = {.3, -.5, .8};
  a.wheels = {{V(2, 4, 1) / std::sqrt(21.), .3, 6, true}, {V(0, 0, 1), .2, -4, true}};
  const auto reduced = Reduced<double>::of(a);
  REQUIRE(reduced);
  const auto m = Motion<double>::make(reduced->problem);
  REQUIRE(m);
  using State5 = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> mass = Eigen::Matrix<double, 5, 5>::Identity();
  mass.block<3, 3>(0, 0) = a.body.inertia;
  for (int i = 0; i < 2; ++i) {
    mass.block<3, 1>(0, 3 + i) = a.wheels[std::size_t(i)].axial_inertia * a.wheels[std::size_t(i)].axis;
    mass.block<1, 3>(3 + i, 0) = a.wheels[std::size_t(i)].axis.transpose();
  }
  const Eigen::Matrix<double, 5, 5> inverse = mass.inverse();
  const auto rate = [&](const State5& y) {
    const V w = y.head<3>();
    V M = a.body.inertia * w;
    for (int i = 0; i < 2; ++i) M += a.wheels[std::size_t(i)].axial_inertia * y[3 + i] * a.wheels[std::size_t(i)].axis;
    State5 f = State5::Zero();
    f.head<3>() = cross<double>(M, w);
    return State5(inverse * f);
  };
  State5 y;
  y << .3, -.5, .8, 6, -4;
  const int steps = 4000;
  const double h = 5. / steps;
  for (int k = 0; k < steps; ++k) {
    const State5 k1 = rate(y), k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2), k4 = rate(y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const V w = m->at(5).angular_velocity;
  CHECK((w - y.head<3>()).norm() < 1e-12);
  for (std::size_t i = 0; i < 2; ++i) CHECK(reduced->wheel_rate(i, w) == Approx(y[3 + int(i)]).epsilon(1e-12));
}

TEST_CASE("rates that follow from a given total momentum are those that give it", "[free]") {
  Assembly<double> a;
  a.body = Problem<double>::from_moments({5, 4, 3}, {.1, .2, .3}, {.3, -.5, .8});
  a.wheels = {{V(0, .6, .8), .3, 6, true}, {V(1, 0, 0), .2, -4, false}};
  const V M =
      a.body.inertia * a.body.angular_velocity + a.body.rotor_momentum + .3 * 6 * V(0, .6, .8) + .2 * -4 * V(1, 0, 0);
  auto b = a;
  b.body.momentum_given = true;
  b.body.angular_momentum = M;
  b.body.angular_velocity = {7, 7, 7};
  const auto first = Motion<double>::make(Reduced<double>::of(a)->problem),
             second = Motion<double>::make(Reduced<double>::of(b)->problem);
  REQUIRE((first && second));
  CHECK((first->at(3).angular_velocity - second->at(3).angular_velocity).norm() < 1e-14);
  CHECK((first->at(0).angular_momentum - M).norm() < 1e-14);
  CHECK(Reduced<double>::of(b)->wheels[0].rate == Approx(6 + V(0, .6, .8).dot(a.body.angular_velocity)));
}

TEST_CASE("a rotor that the body cannot hold is refused by name and limit", "[free]") {
  Assembly<double> a;
  a.body = Problem<double>::from_moments({5, 4, 3}, {0, 0, 0}, {.3, -.5, .8});
  a.wheels = {{V(0, 0, 1), .2, 1, false}, {V(0, 0, 1), 3.5, 1, true}};
  UnsoundWheel<double> unsound;
  CHECK(Reduced<double>::of(a, &unsound).error() == Errc::triangle_inequality);
  CHECK(unsound.wheel == 1);
  // second moments of mass (1, 2, 3): a thin disc across axis 3 has I/2 in the first two
  CHECK(unsound.limit == Approx(2).epsilon(1e-6));
  a.wheels[1].axial_inertia = .99 * unsound.limit;
  CHECK(Reduced<double>::of(a, &unsound));
  CHECK(unsound.wheel == -1);
  a.wheels[0].axis = {0, 0, 1.1};
  CHECK(Reduced<double>::of(a, &unsound).error() == Errc::out_of_domain);
  CHECK(unsound.wheel == 0);
  a.wheels[0] = {V(0, 0, 1), -1, 1, false};
  CHECK(Reduced<double>::of(a).error() == Errc::not_positive);
  a.wheels[0] = {V(0, 0, 1), 1, gyrostat::nan<double>, false};
  CHECK(Reduced<double>::of(a).error() == Errc::not_finite);
  a.body.inertia(0, 0) = 8;
  CHECK(Reduced<double>::of(a).error() == Errc::triangle_inequality);
}

}  // namespace free_reduced_test
