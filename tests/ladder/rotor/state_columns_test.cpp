// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/state_columns.hpp"

#include <vector>

#include "../../models/rotor/bodies.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

struct Bound {
  double attitude, momentum, rotor_rate, rotor_angle;
};

}  // namespace

TEST_CASE("columns of states that are off by a bound lie within the errors stated", "[rotor]") {
  Bodies bodies(31);
  for (int i = 0; i < 500; ++i) {
    const auto body = bodies.realisable();
    const double off = bodies.scale(1e-14, 0.1);
    std::vector<State<double>> states;
    Comparison seen{Row<double>(body)};
    Bound bound{};
    for (int k = 0; k < 3; ++k) {
      auto s = bodies.start(body);
      s.rotor_angle = bodies.uniform(-1, 1);
      auto moved = s;
      const double rate = off * bodies.uniform(-1, 1), angle = off * bodies.uniform(-1, 1);
      moved.momentum += off * bodies.direction();
      // p for the wanted rotor rate: omega = p/(lambda k) - n.H/k
      const auto rate_of = [&](const State<double>& x) {
        return body.rotor_rate(x.axial_momentum, body.angular_velocity(x.momentum, x.axial_momentum));
      };
      moved.axial_momentum += body.axial_inertia() * body.coupling() * (rate_of(s) + rate - rate_of(moved));
      moved.rotor_angle += angle;
      bound.momentum = std::max(bound.momentum, off);
      bound.rotor_rate = std::max(bound.rotor_rate, std::abs(rate));
      bound.rotor_angle = std::max(bound.rotor_angle, std::abs(angle) + 1e-16);
      states.push_back(s);
      seen.add(s, moved);
    }
    const auto told = state_columns(Row<double>(body), states[0], states, bound);
    const auto found = seen.relative(seen.difference());
    CHECK(found[column::angular_momentum] <= told[column::angular_momentum] * (1 + 1e-12) + 1e-15);
    CHECK(found[column::angular_velocity] <= told[column::angular_velocity]);
    CHECK(found[column::rotor_rate] <= told[column::rotor_rate] + 1e-13);
    CHECK(found[column::rotor_angle] <= told[column::rotor_angle] * (1 + 1e-12));
    CHECK(found[column::lyapunov] <= told[column::lyapunov]);
    CHECK(told[column::lyapunov] < 1e4 * off);
  }
}

TEST_CASE("no momentum and no error of it: none stated", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const std::vector<State<double>> states{body.state({}, Vec3<double>(0, 0, 0), 0)};
  const auto told = state_columns(Row<double>(body), states[0], states, Bound{0, 0, 0, 0});
  CHECK(told[column::angular_momentum] == 0);
  CHECK(told[column::rotor_angle] == 0);
  CHECK(state_columns(Row<double>(body), states[0], states, Bound{10, 0, 0, 0})[column::attitude] == pi<double>);
}

TEST_CASE("a bound that is infinite leaves no column with an error that looks small", "[rotor]") {
  // the carrier at rest, the rotor at its no-load rate: V = 0 and so is its gradient
  const auto body = reference_body(0.05, 30);
  const std::vector<State<double>> states{body.state({}, Vec3<double>(0, 0, 0), 30)};
  constexpr double no = infinity<double>;
  const auto stated = state_columns(Row<double>(body, states[0]), states[0], states, Bound{no, no, no, no});
  for (const std::size_t i : {column::angular_velocity, column::angular_momentum, column::rotor_rate, column::lyapunov})
    CHECK(stated[i] == no);
}

TEST_CASE("errors are relative to the truth, which may be smaller than the answer", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const std::vector<State<double>> states{body.state({}, Vec3<double>(0.1, 0, 0), 2)};
  const double omega = 2;
  CHECK(state_columns(Row<double>(body), states[0], states, Bound{0, 0, 0.5 * omega, 0})[column::rotor_rate] ==
        Approx(1));
  CHECK(state_columns(Row<double>(body), states[0], states, Bound{0, 0, 2 * omega, 0})[column::rotor_rate] ==
        infinity<double>);
}

TEST_CASE("a momentum that cancels to rounding is known to rounding of its parts, not exactly", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const Vec3<double> Omega = body.inverse_inertia() * (-0.35 * 7 * body.axis());
  const State<double> start = body.state({}, Omega, 7);
  REQUIRE(start.momentum.isZero(0));
  const Row<double> row(body, start);
  CHECK(row.scale[column::angular_momentum] > 0.35 * 7);
  const double stated =
      state_columns(row, start, std::vector<State<double>>{start}, Bound{0, 0, 0, 0})[column::angular_momentum];
  CHECK(stated > 8 * epsilon<double>);
  CHECK(stated < 64 * epsilon<double>);
}

TEST_CASE("a momentum that nearly cancels is off by the rounding of its parts", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const Vec3<double> Omega = body.inverse_inertia() * (-0.35 * 7 * (1 - 1e-12) * body.axis());
  const State<double> start = body.state({}, Omega, 7);
  const double left = start.momentum.norm();
  REQUIRE(left > 0);
  const Row<double> row(body, start);
  const double stated =
      state_columns(row, start, std::vector<State<double>>{start}, Bound{0, 0, 0, 0})[column::angular_momentum];
  CHECK(stated > 4 * epsilon<double> * 0.35 * 7 / left);
  CHECK(stated < 64 * epsilon<double> * 0.35 * 7 / left);
}
