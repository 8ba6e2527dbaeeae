// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/collected.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "scenes.hpp"

namespace general_collected_test {

using namespace gyrostat;
using namespace gyrostat::general;

/// The torque of a sum as its documentation says.
Vec3<double> torque_of(const Problem<double>& p, const Terms<double>& terms, const Pose<double>& pose, double t) {
  const auto body = [&](const Vec3<double>& v) { return rotate<double>(conjugate(pose.attitude), v); };
  const Vec3<double>&w = pose.angular_velocity, &M = pose.angular_momentum;
  const Vec3<double> G = p.inertia * w, d = body(p.field.down);
  Vec3<double> sum = terms.body - terms.by_rate * w - terms.by_momentum * M;
  if (!terms.brake_total.isZero(0)) sum -= terms.brake_total.cwiseProduct(M) / M.norm();
  if (!terms.brake_carrier.isZero(0)) sum -= terms.brake_carrier.cwiseProduct(G) / G.norm();
  for (std::size_t j = 0; j < 3; ++j) sum += terms.inertial[j] * body(Vec3<double>::Unit(int(j)));
  sum += terms.gradient * cross<double>(d, Vec3<double>(p.inertia * d));
  if (p.orbit) {
    const auto at = orbit_at(*p.orbit, t);
    const Vec3<double> axes[] = {body(at.radial), body(at.along), body(cross<double>(at.radial, at.along))};
    for (std::size_t j = 0; j < 3; ++j) sum += terms.orbital[j] * axes[j];
    sum += terms.orbit_gradient * at.gradient * cross<double>(axes[0], Vec3<double>(p.inertia * axes[0]));
  }
  const auto field = field_at(p, t);
  const Vec3<double> B = body(field.flux_density), induced = cross<double>(w, B) - body(field.rate);
  return sum + cross<double>(terms.dipole, B) + cross<double>(Vec3<double>(terms.eddy * induced), B);
}

TEST_CASE("what is collected is what the torques are one by one", "[general]") {
  general_scenes::Scenes source(21);
  for (int i = 0; i < 150; ++i) {
    const auto made = source.next(2);
    const auto& p = made.problem;
    const auto collected = Collected<double>::of(p, made.span);
    const Vec3<double> w = p.angular_velocity + Vec3<double>(0.3, -0.2, 0.5);
    const Pose<double> pose{p.attitude, w, p.inertia * w + Vec3<double>(0.1, 0.2, 0.3)};
    for (const double t : {0.1 * made.span, 0.77 * made.span}) {
      Vec3<double> sum(0, 0, 0), force(0, 0, 0);
      double size = 0;
      for (const auto& record : collected.records) {
        const double factor = general::detail::factor_at(record.factor, t, t);
        const Vec3<double> one = torque_of(p, record.sum, pose, t);
        sum += factor * one, size += std::abs(factor) * one.norm();
        force += factor * (record.sum.force_body + rotate<double>(conjugate(p.attitude), record.sum.force_inertial));
      }
      const auto load = load_at(p, pose, t, t);
      CAPTURE(i, made.kind, t);
      CHECK((sum - load.torque).norm() <= 1e-13 * (size + load.torque.norm()));
      CHECK((force - load.force).norm() <= 1e-13 * (force.norm() + load.force.norm()));
    }
  }
}

TEST_CASE("torques with one factor are one record, and what always acts is the first", "[general]") {
  Problem<double> p;
  Torque<double> one;
  one.vector = {1, 2, 3};
  p.torques.assign(3, one);
  p.torques[1].vector = {-1, -2, -3};
  p.torques[2].factor.on = {{-1, 20}};
  auto made = Collected<double>::of(p, 10.);
  CHECK(made.is_steady());
  CHECK(made.steady().sum.body == one.vector);
  CHECK(made.steady().size.body == 3 * one.vector);
  p.torques.pop_back();
  made = Collected<double>::of(p, 10.);
  CHECK_FALSE(made.steady().sum.any());
  CHECK(made.steady().size.any());

  p.torques[0].factor.on = p.torques[1].factor.on = {{1, 2}};
  made = Collected<double>::of(p, 10.);
  REQUIRE(made.records.size() == 2);
  CHECK_FALSE(made.records[1].sum.any());
  // a wave that stands still is a number, and so is a table of one value
  p.torques[0].factor = {};
  p.torques[0].factor.amplitude = 2, p.torques[0].factor.phase = pi<double> / 2;
  p.torques[1].factor = {};
  p.torques[1].factor.table = {{0, 4}, {0.5, 0.5}, Between::cubic, true};
  made = Collected<double>::of(p, 10.);
  CHECK(made.is_steady());
  CHECK((made.steady().sum.body - 2.5 * one.vector).norm() < 1e-14);
  // what is always off is not there
  p.torques[0].factor.on = {{3, 3}};
  p.torques[0].factor.mean = p.torques[0].factor.amplitude = 0;
  CHECK(Collected<double>::of(p, 10.).is_steady());
}

TEST_CASE("torques that all but cancel are summed to the digits of what is left", "[general]") {
  Problem<double> p;
  Torque<double> torque;
  for (const Vec3<double>& c : {Vec3<double>(3e-6, 1e-6, 2e-6), Vec3<double>(1, 2, 3), Vec3<double>(-1, -2, -3)}) {
    torque.vector = c;
    p.torques.push_back(torque);
  }
  CHECK(Collected<double>::of(p, 1.).steady().sum.body == p.torques[0].vector);

  // two engines whose moments about the mass centre differ by what it is off their middle, the last digits of their arms included
  p.torques.clear();
  p.centre_of_mass = {0.1, 1e-9, 0.3};
  torque.type = TorqueType::thrust;
  torque.vector = {0, 0, 22}, torque.point = {0.6, 0.1, 0};
  for (int i = 0; i < 2; ++i, torque.point[0] = -0.4, torque.vector[2] = 22.000001) p.torques.push_back(torque);
  for (const bool turned : {false, true}) {
    for (auto& each : p.torques) each.axes = turned ? Axes::inertial : Axes::body;
    Vec3<long double> right(0, 0, 0);
    for (const auto& each : p.torques)
      right +=
          cross<long double>(Vec3<long double>(each.point.cast<long double>() - p.centre_of_mass.cast<long double>()),
                             Vec3<long double>(each.vector.cast<long double>()));
    const auto sum = Collected<double>::of(p, 1.).steady().sum;
    Vec3<double> found = sum.body;
    for (std::size_t j = 0; j < 3; ++j) found += sum.inertial[j] * Vec3<double>::Unit(int(j));
    CAPTURE(turned);
    CHECK((found - right.cast<double>()).norm() <= 2 * epsilon<double> * std::abs(found[1]));
    CHECK(std::abs(found[1]) < 2e-5);
  }
}

TEST_CASE("damping of the carrier and charge are matrices on the angular velocity", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  Torque<double> drag;
  drag.type = TorqueType::damping, drag.opposed = Opposed::carrier_momentum;
  drag.matrix = 0.1 * Mat3<double>::Identity();
  p.torques.push_back(drag);
  Torque<double> charge;
  charge.type = TorqueType::charge, charge.vector = {1, 2, 3};
  p.torques.push_back(charge);
  const auto made = Collected<double>::of(p, 1.);
  const auto& sum = made.steady().sum;
  CHECK((sum.by_rate - 0.1 * p.inertia - cross_matrix<double>(charge.vector)).norm() < 1e-15);
  CHECK((sum.by_carrier - 0.1 * Mat3<double>::Identity()).norm() < 1e-15);
}

TEST_CASE("breakpoints are in order, once each, and inside the span", "[general]") {
  Problem<double> p;
  p.torques.resize(2);
  p.torques[0].factor.on = {{3, 7}, {8, 20}};
  p.torques[1].type = TorqueType::table;
  p.torques[1].table = {{0, 3, 9, 10}, std::vector<double>(12, 1), Between::linear, false};
  p.wheels.resize(1);
  p.wheels[0].table = {{7, 8.5}, {1, 2}, Between::step, true};
  CHECK(breakpoints(p, 10.) == std::vector<double>{3, 7, 8, 8.5, 9});
  p.torques[0].factor.on = {{0, 5e-324}, {3, 7}};  // no step ends before that
  CHECK(breakpoints(p, 4.) == std::vector<double>{3});
}

TEST_CASE("torques that cannot be are refused by name", "[general]") {
  const auto fault = [](TorqueType type, auto&& change) {
    Problem<double> p;
    p.torques.resize(2);
    p.torques[1].type = type;
    if (type == TorqueType::table) p.torques[1].table = {{0, 1}, std::vector<double>(6, 1), Between::linear, false};
    change(p, p.torques[1]);
    return check_torques(p);
  };
  const auto nothing = [](auto&, auto&) {};
  CHECK_FALSE(fault(TorqueType::constant, nothing));
  CHECK_FALSE(fault(TorqueType::table, nothing));
  const auto weight = fault(TorqueType::weight, nothing);
  CHECK(weight.code == Errc::not_applicable);
  CHECK(weight.place == 1);
  CHECK_FALSE(fault(TorqueType::weight, [](auto& p, auto&) { p.fixed = true; }));
  CHECK(fault(TorqueType::gravity_gradient, nothing).code == Errc::not_applicable);
  CHECK_FALSE(fault(TorqueType::gravity_gradient, [](auto& p, auto&) { p.orbit.emplace(); }));
  CHECK(fault(TorqueType::eddy_current, nothing).code == Errc::not_applicable);
  CHECK(fault(TorqueType::brake, nothing).code == Errc::not_applicable);
  CHECK(fault(TorqueType::brake, [](auto&, auto& t) { t.opposed = Opposed::momentum, t.vector = {1, -1, 0}; }).code ==
        Errc::negative);
  CHECK(fault(TorqueType::constant, [](auto&, auto& t) { t.axes = Axes::orbit; }).code == Errc::not_applicable);
  CHECK(fault(TorqueType::damping, [](auto&, auto& t) { t.axes = Axes::inertial; }).code == Errc::not_applicable);
  CHECK(fault(TorqueType::constant, [](auto&, auto& t) { t.vector[0] = gyrostat::nan<double>; }).code ==
        Errc::not_finite);
  CHECK(fault(TorqueType::constant, [](auto&, auto& t) { t.factor.on = {{2, 1}}; }).code == Errc::not_increasing);
  CHECK(fault(TorqueType::constant, [](auto&, auto& t) { t.factor.on = {{0, 2}, {1, 3}}; }).code ==
        Errc::not_increasing);
  CHECK(fault(TorqueType::table, [](auto&, auto& t) { t.factor.table = {{0}, {1}, Between::step, true}; }).code ==
        Errc::not_applicable);
  CHECK(fault(TorqueType::table, [](auto&, auto& t) { t.table.values.pop_back(); }).code == Errc::out_of_domain);
  const std::vector<double> uneven{0, 10, 10 + 1e-5, 20};
  const auto far = fault(TorqueType::table, [&](auto&, auto& t) {
    t.table = {uneven, {0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1}, Between::cubic, false};
  });
  CHECK(far.code == Errc::out_of_domain);
  CHECK(far.place == 1);
  CHECK(fault(TorqueType::constant, [&](auto&, auto& t) {
          t.factor.table = {uneven, {0, 0, 1, 1}, Between::cubic, false};
        }).code == Errc::out_of_domain);
  CHECK(fault(TorqueType::constant, [](auto& p, auto&) { p.mass = 0; }).code == Errc::not_positive);
  CHECK(fault(TorqueType::constant, [](auto& p, auto&) { p.orbit.emplace().eccentricity = 1; }).code ==
        Errc::out_of_domain);
  CHECK(fault(TorqueType::constant, [](auto& p, auto&) { p.field.magnetic = MagneticField::dipole; }).code ==
        Errc::not_applicable);

  // as many waves as there is room for
  Problem<double> p;
  for (int i = 0; i < 9; ++i) {
    Torque<double> wave;
    wave.axes = Axes::inertial, wave.vector = {1, 0, 0};
    wave.factor.amplitude = 1, wave.factor.rate = 1 + i;
    p.torques.push_back(wave);
  }
  CHECK(check_torques(p).code == Errc::out_of_domain);
  for (auto& torque : p.torques) torque.axes = Axes::body;
  CHECK_FALSE(check_torques(p));
}

TEST_CASE("a start that is none is refused", "[general]") {
  Problem<double> p;
  CHECK_FALSE(check(p));
  p.attitude = {1, 1, 0, 0};
  CHECK(check(p).code == Errc::out_of_domain);
  p.attitude = {}, p.angular_velocity[2] = gyrostat::nan<double>;
  CHECK(check(p).code == Errc::not_finite);
}

}  // namespace general_collected_test
