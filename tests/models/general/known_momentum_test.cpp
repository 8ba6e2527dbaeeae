// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/known_momentum.hpp"

#include "catch.hpp"
#include "gyrostat/models/general/full.hpp"

namespace general_known_momentum_test {

using namespace gyrostat;
using namespace gyrostat::general;

KnownMomentum<double> known(const Problem<double>& p, double span) {
  const Prepared<double> of(p, span);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, span);
  const auto start = first_numbers<double, false>(of), lost = decltype(start){};
  return {piece, start.data(), lost.data()};
}

TEST_CASE("the momentum is known where all torque is inertial", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  const Vec3<double> start = rotate<double>(p.attitude, Vec3<double>(p.inertia * p.angular_velocity));
  CHECK(known(p, 3).is_free());
  CHECK((known(p, 3).at(2) - start).norm() < 1e-15);
  auto& torque = p.torques.emplace_back();
  torque.type = TorqueType::table, torque.axes = Axes::inertial;
  torque.table = {{0, 4}, {1, 0, 2, 5, 4, 2}, Between::linear, true};
  const auto driven = known(p, 3);
  CHECK((driven && !driven.is_free()));
  CHECK((driven.at(2) - start - Vec3<double>(4, 2, 4)).norm() < 1e-14);
  torque.axes = Axes::body;
  CHECK_FALSE(known(p, 3));
  torque.axes = Axes::inertial, torque.type = TorqueType::constant, torque.vector = {1, 0, 0};
  torque.factor.amplitude = 1, torque.factor.rate = 2;
  CHECK_FALSE(known(p, 3));
}

TEST_CASE("the known momentum adds up over many pieces without rounding more than once", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  auto& torque = p.torques.emplace_back();
  torque.axes = Axes::inertial, torque.vector = {0.01, -0.02, 0.0037};
  for (int i = 0; i < 500; ++i) torque.factor.on.push_back({double(i), i + 0.5});
  const Prepared<double> of(p, 500);
  auto cuts = breakpoints(p, 500.);
  cuts.push_back(500);
  const auto start = first_numbers<double, false>(of), lost = decltype(start){};
  auto piece = Piece<double>::first(p, of.wheels, of.torques, cuts[0]);
  KnownMomentum<double> known(piece, start.data(), lost.data());
  const Vec3<double> first = known.at(0);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    piece = Piece<double>::behind(piece, p, of.wheels, of.torques, cuts[i]);
    known = KnownMomentum<double>(piece, start.data(), lost.data(), &known);
  }
  for (int i = 0; i < 3; ++i) {
    const long double wanted = static_cast<long double>(first[i]) + 250 * static_cast<long double>(torque.vector[i]);
    CHECK(double(std::abs(known.at(500)[i] - wanted)) <= 1.2e-16 * double(std::abs(wanted)));
  }
}

TEST_CASE("what rounding leaves of a momentum goes through a piece where it is known", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  auto& torque = p.torques.emplace_back();
  torque.axes = Axes::inertial, torque.vector = {0.01, -0.02, 0.0037};
  const Prepared<double> of(p, 1);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 1);
  auto x = first_numbers<double, false>(of);
  auto lost = decltype(x){};
  for (std::size_t i = 0; i < 3; ++i) lost[4 + i] = 1e-17 * double(i + 1), lost[i] = -2e-18;
  const FullSystem<double, false> system(of, piece, x, lost);
  const auto before = x;
  const auto begun = lost;
  system.project(0, x.data(), lost.data());
  for (std::size_t i = 4; i < 7; ++i) CHECK(std::abs((x[i] - before[i]) + (lost[i] - begun[i])) < 1e-28);
}

}  // namespace general_known_momentum_test
