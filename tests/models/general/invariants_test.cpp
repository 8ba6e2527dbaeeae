// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/invariants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "truth.hpp"

namespace general_invariants_test {

using namespace gyrostat;
using namespace gyrostat::general;
using Numbers = std::array<double, 12>;

/// A body that turns about all axes, held at a point.
Problem<double> body() {
  Problem<double> p;
  p.fixed = true;
  p.inertia << 3, 0.2, -0.1, 0.2, 2, 0.3, -0.1, 0.3, 1.5;
  p.mass = 2, p.centre_of_mass = {0.1, -0.2, 0.3};
  p.field.gravity = 4, p.field.down = Vec3<double>(0.6, 0, -0.8);
  p.angular_velocity = {0.7, -0.9, 1.1};
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  return p;
}

Problem<double> with(Problem<double> p, TorqueType type, const Vec3<double>& vector = {0, 0, 0}) {
  auto& torque = p.torques.emplace_back();
  torque.type = type, torque.vector = vector;
  return p;
}

Problem<double> with(Problem<double> p, WheelType type, const Vec3<double>& axis) {
  auto& wheel = p.wheels.emplace_back();
  wheel.type = type, wheel.axis = axis.normalized(), wheel.axial_inertia = 0.05, wheel.rate = 20;
  if (type == WheelType::torque) wheel.torque = 0.1;
  if (type == WheelType::friction) wheel.friction = 1e-3;
  return p;
}

Problem<double> heavy() { return with(body(), TorqueType::weight); }

Problem<double> in_orbit(double eccentricity) {
  auto p = body();
  p.fixed = false;
  p.orbit.emplace();
  p.orbit->radius = 2, p.orbit->mu = 3, p.orbit->eccentricity = eccentricity, p.orbit->true_anomaly = 1;
  p.orbit->radial = Vec3<double>(0.6, 0.8, 0), p.orbit->along = Vec3<double>(0, 0, 1);
  return with(p, TorqueType::gravity_gradient);
}

Problem<double> heavy_with_gradient() {
  auto p = with(heavy(), TorqueType::gravity_gradient);
  p.torques.back().gradient = 0.7;
  return p;
}

Problem<double> heavy_in_field() {
  auto p = with(heavy(), TorqueType::magnetic, {0.5, 1, -2});
  p.field.magnetic = MagneticField::uniform, p.field.flux_density = {0.3, 0.4, 0.1};
  return p;
}

struct Kept {
  const char* name;
  Problem<double> problem;
  bool energy, momentum;
};

std::vector<Kept> cases() {
  auto opposed = with(heavy(), TorqueType::damping);
  opposed.torques.back().matrix = Mat3<double>::Identity() * 0.1;
  auto waving = with(body(), TorqueType::weight);
  waving.torques[0].factor.amplitude = 0.5, waving.torques[0].factor.rate = 2;
  return {
      {"weight", heavy(), true, true},
      {"weight and gradient", heavy_with_gradient(), true, true},
      {"weight and charge", with(heavy(), TorqueType::charge, {0.4, 0.1, -0.3}), true, true},
      {"weight and field", heavy_in_field(), true, false},
      {"weight, oblique wheels that are held and free",
       with(with(heavy(), WheelType::held, {1, 2, 3}), WheelType::free, {-1, 1, 0}), true, true},
      {"weight and a wheel that a torque drives", with(heavy(), WheelType::torque, {1, 0, 1}), false, true},
      {"on a circle", in_orbit(0), true, false},
      {"on a circle, with a wheel", with(in_orbit(0), WheelType::held, {1, 1, 0}), true, false},
      {"on a circle, with a charge", with(in_orbit(0), TorqueType::charge, {0.4, 0.1, -0.3}), true, false},
      {"on a circle, with a charge and a wheel",
       with(with(in_orbit(0), TorqueType::charge, {0.4, 0.1, -0.3}), WheelType::free, {1, 1, 0}), true, false},
      {"no torque", body(), true, true},
      {"charge", with(body(), TorqueType::charge, {0.4, 0.1, -0.3}), true, false},
      {"on an ellipse", in_orbit(0.1), false, false},
      {"weight and damping", opposed, false, false},
      {"weight that comes and goes", waving, false, false},
      {"a torque in the body", with(body(), TorqueType::constant, {0.1, 0, 0}), false, false},
  };
}

Numbers numbers(const State<double>& state) {
  const auto& q = state.attitude;
  const auto& M = state.angular_momentum;
  return {q.w, q.x, q.y, q.z, M[0], M[1], M[2], 0, 0, 0, 0, 0};
}

Quat<double> unit(const Numbers& x) { return normalised(Quat<double>{x[0], x[1], x[2], x[3]}); }

TEST_CASE("the true motion keeps what is called kept", "[general]") {
  for (const auto& [name, problem, energy, momentum] : cases()) {
    CAPTURE(std::string(name));
    const Prepared<double> of(problem, 5.);
    const auto piece = Piece<double>::first(problem, of.wheels, of.torques, 5.);
    const auto start = first_numbers<double, false>(of);
    const Numbers lost{};
    const Invariants<double> kept(of, piece, start.data(), lost.data());
    CHECK(kept.keeps_energy() == energy);
    CHECK(bool(kept) == (energy || momentum));
    if (!kept) continue;
    const std::vector<long double> times = {0.3L, 2, 5};
    const auto truth =
        general_truth::motion<long double>(general_truth::cast<long double>(problem), times, 1e-17L, 60'000);
    REQUIRE(truth.size() == times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto x = numbers(general_truth::cast<double>(truth[i]));
      const auto none = kept.missing(double(times[i]), unit(x), x.data(), lost.data());
      CHECK(none.turn.norm() < 1e-14);
      CHECK(none.momentum.norm() < 1e-14 * of.momentum.norm());
      // and a state that is off is put back, but for what is of second order
      for (const double off : {1e-3, 1e-5}) {
        Numbers y = x;
        const Quat<double> turned = unit(x) * Quat<double>{1, off * 0.5, -off * 0.3, off * 0.4};
        y[0] = turned.w, y[1] = turned.x, y[2] = turned.y, y[3] = turned.z;
        for (std::size_t j = 4; j < 7; ++j) y[j] += off * of.momentum.norm() * std::cos(double(j));
        const auto change = kept.missing(double(times[i]), unit(y), y.data(), lost.data());
        const double first = change.turn.norm() + change.momentum.norm() / of.momentum.norm();
        const Quat<double> back = unit(y) * Quat<double>{1, change.turn[0] / 2, change.turn[1] / 2, change.turn[2] / 2};
        y[0] = back.w, y[1] = back.x, y[2] = back.y, y[3] = back.z;
        for (std::size_t j = 0; j < 3; ++j) y[4 + j] += change.momentum[int(j)];
        const auto rest = kept.missing(double(times[i]), unit(y), y.data(), lost.data());
        CHECK(first > off / 100);
        CHECK(rest.turn.norm() + rest.momentum.norm() / of.momentum.norm() < 30 * off * off);
      }
    }
  }
}

TEST_CASE("a momentum that nothing changes is left alone", "[general]") {
  auto p = heavy();
  p.inertia = Vec3<double>(2, 2, 1).asDiagonal(), p.centre_of_mass = {0, 0, 0.2};
  p = with(p, WheelType::held, {0, 0, 1});
  const Prepared<double> of(p, 5.);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 5.);
  auto x = first_numbers<double, false>(of);
  const Numbers lost{};
  const Invariants<double> kept(of, piece, x.data(), lost.data());
  x[4] += 1e-6;
  const auto change = kept.missing(0, unit(x), x.data(), lost.data());
  CHECK(change.momentum[2] == 0);
  CHECK(change.momentum.norm() > 1e-8);
}

TEST_CASE("loose steps keep the energy of a body on a circular orbit", "[general]") {
  const auto p = in_orbit(0);
  const Prepared<double> of(p, 300.);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 300.);
  using System = FullSystem<double, false>;
  const System system(of, piece, System::first_numbers(of));
  typename ode::Taylor<System>::Options options;
  options.tolerance = 1e-7, options.scale = system.scale();
  ode::Taylor<System> solver(system, 0, System::first_numbers(of), options);
  while (solver.time() < 300) REQUIRE(solver.step(300) == ode::Status::reached);
  const auto start = first_numbers<double, false>(of);
  const Numbers lost{};
  const Invariants<double> kept(of, piece, start.data(), lost.data());
  Numbers x;
  std::copy_n(solver.state(), x.size(), x.begin());
  const auto off = kept.missing(300, unit(x), x.data(), lost.data());
  CHECK(off.turn.norm() < 1e-14);
  CHECK(off.momentum.norm() < 1e-14 * of.momentum.norm());
}

}  // namespace general_invariants_test
