// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/rest.hpp"

#include <string_view>

#include "catch.hpp"

namespace general_rest_test {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr double eps = epsilon<double>, slack = share_slack<double>;

Problem<double> braked(Opposed opposed) {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  auto& brake = p.torques.emplace_back();
  brake.type = TorqueType::brake, brake.opposed = opposed, brake.vector = {1, 2, 4};
  return p;
}

Torque<double>& push(Problem<double>& p, const Vec3<double>& torque) {
  p.torques.emplace_back().vector = torque;
  return p.torques.back();
}

Stop<double> stop(const Problem<double>& p, double t = 0) {
  const Prepared<double> of(p, 10);
  REQUIRE(!check(p));
  const auto cuts = breakpoints(p, 10.);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, cuts.empty() ? 10. : cuts.front());
  return stop_at(of, piece, p.attitude, t, slack);
}

TEST_CASE("a body rests where its brakes hold all other torques together", "[general]") {
  for (const auto opposed : {Opposed::momentum, Opposed::carrier_momentum}) {
    auto p = braked(opposed);
    CHECK(stop(p).what == AtStop::rests);
    CHECK(stop(p).slip == 0);
    push(p, {0.5, 1, -1});
    CHECK(stop(p).what == AtStop::rests);
    push(p, {0.5, 1, 1});
    const auto leaves = stop(p);
    CHECK(leaves.what == AtStop::leaves);
    CHECK(leaves.departure.rate > 0);
    // another brake of the other law, and the same body
    auto& other = p.torques.emplace_back();
    other.type = TorqueType::brake, other.vector = {2, 2, 2};
    other.opposed = opposed == Opposed::momentum ? Opposed::carrier_momentum : Opposed::momentum;
    CHECK(stop(p).what == AtStop::rests);
    p.rotor_momentum = {0, 0, 1};
    CHECK(stop(p).what == AtStop::laws);
  }
}

TEST_CASE("what brakes hold to roundings may slip by them", "[general]") {
  auto p = braked(Opposed::momentum);
  auto& torque = push(p, {0, 2 * (1 - 20 * eps), 0});
  CHECK(stop(p).slip == 0);
  torque.vector[1] = 2 * (1 + 8 * eps);
  const auto held = stop(p);
  CHECK(held.what == AtStop::rests);
  CHECK(held.slip >= 2 * 8 * eps);
  CHECK(held.slip <= 4 * 17 * eps);
  torque.vector[1] = 2 * (1 + 9 * eps);
  CHECK(stop(p).what == AtStop::barely);
  torque.vector[1] = 2 * (1 + 1e-3);
  CHECK(stop(p).what == AtStop::leaves);
}

TEST_CASE("torques that stand still while the body does are known, and others are not", "[general]") {
  auto p = braked(Opposed::momentum);
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  p.fixed = true, p.mass = 2, p.centre_of_mass = {0, 0, 0.1}, p.field.gravity = 9.8;
  p.torques.emplace_back().type = TorqueType::weight;
  const Vec3<double> down = rotate<double>(conjugate(p.attitude), p.field.down);
  const Vec3<double> weight = 2 * 9.8 * cross<double>(p.centre_of_mass, down);
  CHECK((stop(p).what == AtStop::rests) == (share_of_brake<double>({1, 2, 4}, weight) <= 1));
  p.torques[0].vector = {9, 9, 9};
  CHECK(stop(p).what == AtStop::rests);
  // held wheels turn the body on against them, and a torque in space would change
  p.rotor_momentum = {0.3, 0, 0.2};
  CHECK(stop(p).what == AtStop::varying);
  p.torques[0].opposed = Opposed::carrier_momentum;
  CHECK(stop(p).what == AtStop::rests);
  p.torques.pop_back(), p.torques[0].opposed = Opposed::momentum;
  const auto turned = stop(p);
  CHECK(turned.what == AtStop::rests);
  CHECK((p.inertia * turned.turning + p.rotor_momentum).norm() < 1e-15);
  push(p, {0.1, 0, 0}).factor.amplitude = 0.1;
  p.torques.back().factor.rate = 3;
  CHECK(stop(p).what == AtStop::varying);
  p.torques.pop_back();
  p.orbit.emplace(), p.torques.emplace_back().type = TorqueType::gravity_gradient;
  CHECK(stop(p).what == AtStop::varying);
}

TEST_CASE("wheels that turn by themselves leave a stop undecided, where they matter", "[general]") {
  auto p = braked(Opposed::momentum);
  auto& wheel = p.wheels.emplace_back();
  wheel.type = WheelType::free, wheel.axial_inertia = 0.1, wheel.rate = 10;
  CHECK(stop(p).what == AtStop::rests);
  p.torques[0].opposed = Opposed::carrier_momentum;
  CHECK(stop(p).what == AtStop::turning);
  p.torques[0].opposed = Opposed::momentum;
  p.wheels[0].type = WheelType::torque, p.wheels[0].torque = 0.1;
  CHECK(stop(p).what == AtStop::turning);
  p.wheels[0].type = WheelType::friction, p.wheels[0].torque = 0, p.wheels[0].friction = 0.1;
  CHECK(stop(p).what == AtStop::turning);
  p.wheels[0].type = WheelType::held;
  CHECK(stop(p).what == AtStop::rests);
}

TEST_CASE("a table that stays within the brakes all along is held", "[general]") {
  auto p = braked(Opposed::momentum);
  auto& torque = push(p, {0, 2, 0});
  for (const auto between : {Between::linear, Between::cubic}) {
    torque.factor.table = {{0, 10}, {-0.9, 0.95}, between, false};
    CHECK(stop(p).what == AtStop::rests);
    CHECK(stop(p).slip == 0);
    // up to its limit, a rounding of it may be left over
    torque.factor.table.values[1] = 1;
    CHECK(stop(p).what == AtStop::rests);
    CHECK(stop(p).slip > 0);
    torque.factor.table.values[1] = 1.05;
    CHECK(stop(p).what == AtStop::rests);
    CHECK(stop(p).until == Approx(10 * 1.9 / 1.95).epsilon(1e-12));
    torque.factor.table.values = {1.05, 0.5};
    CHECK(stop(p).what == AtStop::leaves);
    CHECK(stop(p, 5).what == AtStop::rests);
  }
  // it goes beyond between its times alone
  torque.factor.table = {{0, 5, 10}, {0.5, 0.99, 0.98}, Between::cubic, false};
  CHECK(stop(p).what == AtStop::rests);
  torque.factor.table = {{-5, 0, 5, 10}, {0.1, 0.99, 0.97, 0.1}, Between::cubic, false};
  const auto cubic = piece(torque.factor.table, 1, 0, 0.);
  REQUIRE(cubic(1.5) > 1);
  CHECK(stop(p).what == AtStop::rests);
  CHECK(cubic(stop(p).until) == Approx(1).epsilon(1e-12));
  CHECK(stop(p).until < 1.5);
  for (const auto what : {AtStop::barely, AtStop::later, AtStop::turning, AtStop::laws, AtStop::varying})
    CHECK(!std::string_view(why_not_through(what)).empty());
}

TEST_CASE("a body at rest turns with its held wheels alone, and its centre goes on", "[general]") {
  auto p = braked(Opposed::momentum);
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  p.mass = 2;
  auto& thrust = p.torques.emplace_back();
  thrust.type = TorqueType::thrust, thrust.vector = {1, 0, 0}, thrust.factor.table = {{0, 10}, {1, 3}};
  const Prepared<double> of(p, 10);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 10.);
  std::array<double, Places<true>::width> x{};
  const auto& q = p.attitude;
  x[0] = q.w, x[1] = q.x, x[2] = q.y, x[3] = q.z;
  x[Places<true>::velocity] = 7;
  const auto made = stop_at(of, piece, q, 5., slack);
  REQUIRE(made.what == AtStop::rests);
  const auto later = Resting<double, true>(of, piece, made, 5., x).at(8);
  const Vec3<double> along = rotate<double>(q, {1, 0, 0});
  // force 2 N at 5 s, 0.2 N/s more, on 2 kg
  const double v = 3 * 1 + 4.5 * 0.1, way = 4.5 * 1 + 4.5 * 0.1;
  for (int i = 0; i < 3; ++i) {
    CHECK(later[std::size_t(Places<true>::velocity + i)] == Approx(v * along[i] + (i == 0 ? 7 : 0)));
    CHECK(later[std::size_t(Places<true>::position + i)] == Approx(way * along[i] + (i == 0 ? 21 : 0)));
    CHECK(later[std::size_t(i)] == x[std::size_t(i)]);
  }
}

TEST_CASE("a torque that outgrows the brakes moves the body by its own series", "[general]") {
  auto p = braked(Opposed::momentum);
  auto& torque = push(p, {0.3, 1.2, 0.8});
  torque.factor.table = {{0, 10}, {0, 10}, Between::linear, false};
  const auto rests = stop(p);
  REQUIRE(rests.what == AtStop::rests);
  const double held = rests.until;
  const auto leaves = stop(p, held);
  REQUIRE(leaves.what == AtStop::leaves);
  const auto& out = leaves.outgrowth;
  REQUIRE(out.time == Approx(held).epsilon(1e-9));  // from nothing to all that the brakes hold
  // dU/dt = torque - limit U/|U| to the second power of the time: what is left falls as its third
  const Vec3<double> limit = p.torques[0].vector, slope = torque.vector;
  const auto left = [&](double s) {
    const Vec3<double> U = s * s * (out.second + s * out.third), rate = s * (2 * out.second + 3 * s * out.third);
    return Vec3<double>(slope * (held + s) - limit.cwiseProduct(U.normalized()) - rate);
  };
  CHECK(left(1e-2).norm() / left(1e-3).norm() == Approx(100).epsilon(0.2));
  // and along the direction as the third, which is what remains of it
  const Vec3<double> along = out.second.normalized().cwiseQuotient(limit);
  CHECK(along.dot(left(1e-2)) / along.dot(left(1e-3)) == Approx(1000).epsilon(0.2));
  // an axis that no brake holds
  p.torques[0].vector[1] = 0;
  CHECK(stop(p).what == AtStop::later);
}

}  // namespace general_rest_test
