// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/motion.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

TEST_CASE("a row has the columns of the table, in the caller's axes", "[deceleration]") {
  Problem<double> problem;
  problem.inverse_inertia = V(.5, .8, 1);
  problem.rotor_momentum = V(.1, -.2, .3);
  const Quat<double> q_BP = normalised(Quat<double>{.9, .1, -.3, .2}), q_IP = normalised(Quat<double>{.3, .7, .2, -.5});
  const Row<double> row(problem, to_matrix(q_BP));
  State<double> state{V(1, 2, -3), 4, 5, .6, Regime::one_component, q_IP};
  double x[row_width(column_kinds)];
  row(state, x);
  CHECK((Eigen::Map<const V>(x) - rotate(q_BP, state.momentum)).norm() < 1e-15);
  const V omega_P(.5 * .9, .8 * 2.2, -3.3);
  CHECK((Eigen::Map<const V>(x + 3) - rotate(q_BP, omega_P)).norm() < 1e-15);
  CHECK(x[6] == 4);
  CHECK(x[7] == 5);
  CHECK(x[8] == .6);
  CHECK(column_kinds[column::regime].words[std::size_t(x[9])] == std::string_view("1"));
  const Quat<double> back = Quat<double>{x[13], x[10], x[11], x[12]} * q_BP;  // scalar last
  CHECK(angle_between(back, q_IP) < 1e-15);
}

TEST_CASE("each regime has its symbol among the words of the column", "[deceleration]") {
  REQUIRE(column_kinds[column::regime].words.size() == std::size_t(Regime::rest) + 1);
  for (std::size_t i = 0; i < regime_words.size(); ++i) CHECK(regime_words[i] == std::string_view(symbol(Regime(i))));
}

TEST_CASE("the places in the tables are where the names stand", "[deceleration]") {
  CHECK(place_of(tables.columns, "attitude") == int(column::attitude));
  CHECK(place_of(tables.columns, "modulus_squared") == int(column::modulus_squared));
  CHECK(place_of(tables.scalars, "separatrix_distance") == int(scalar::separatrix_distance));
  CHECK(place_of(tables.warnings, "no-control") == int(warning::no_control));
  CHECK(place_of(tables.warnings, "stop-unknown") == int(warning::stop_unknown));
  CHECK(place_of(tables.rungs, "averaged-2") == rung::averaged_2);
  CHECK(place_of(tables.rungs, "full") == rung::full);
}
