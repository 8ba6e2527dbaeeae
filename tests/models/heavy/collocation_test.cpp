// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/collocation.hpp"

#include "catch.hpp"

#include <vector>

#include "models/heavy/bodies.hpp"
#include "models/heavy/reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("heavy collocation: reference motions, without an integrator", "[heavy]") {
  for (const auto& row : reference_rows("periodic")) {
    const auto& x = row.number;
    const auto orbit = collocated_orbit(row.problem(), x[9], x[10]);
    INFO(row.id);
    REQUIRE(orbit);
    const auto& w = orbit->nodes[0].angular_velocity;
    CHECK(std::hypot(w[0] - x[11], w[1] - x[12]) < 1e-12 * x[9]);
    CHECK(std::abs(orbit->period / x[13] - 1) < 1e-12);
    CHECK(orbit->unfolding.norm() < 1e-12);
    CHECK(orbit->residual < 1e-12);
    CHECK(orbit->tail < 1e-13);
  }
}

TEST_CASE("heavy collocation: 17 nodes do at c/r0 = 0.1, 33 at 0.4, in few iterations", "[heavy]") {
  for (const auto& p : {unit_body(.55, .8, {.6, .48, .64}, .7), unit_body(1.6, 1.3, {.36, -.48, .8}, .5)}) {
    const auto fast = collocated_orbit(p, 10., .1), slower = collocated_orbit(p, 2.5, .1);
    REQUIRE(fast);
    REQUIRE(slower);
    const auto few = collocated_orbit(p, 10., .1, {.first_nodes = 17, .most_nodes = 17});
    REQUIRE(few);
    CHECK(few->iterations <= 6);
    CHECK(std::abs(few->period / fast->period - 1) < 1e-14);
    CHECK((few->nodes[0].angular_velocity - fast->nodes[0].angular_velocity).norm() < 1e-13);
    CHECK(slower->nodes.size() <= 65);
    const auto coarse = collocated_orbit(p, 2.5, .1, {.first_nodes = 33, .most_nodes = 33});
    REQUIRE(coarse);
    CHECK(std::abs(coarse->period / slower->period - 1) < 1e-12);
    CHECK(coarse->unfolding.norm() < 1e-12);
  }
}

TEST_CASE("heavy collocation: the nodes keep energy, vertical momentum and length", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto orbit = collocated_orbit(p, 4., .1);
  REQUIRE(orbit);
  const auto& first = orbit->nodes[0];
  CHECK(std::abs(first.angular_velocity[2] - 4) < 1e-14);
  CHECK(std::abs(first.down[1]) < 1e-15);
  CHECK(std::abs(first.down[2] - .1) < 1e-15);
  for (const auto& node : orbit->nodes) {
    CHECK(std::abs(p.energy(node) - p.energy(first)) < 1e-12);
    CHECK(std::abs(p.vertical_momentum(node) - p.vertical_momentum(first)) < 1e-12);
    CHECK(std::abs(node.down.norm() - 1) < 1e-13);
  }
}

TEST_CASE("heavy collocation: refusals", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  CHECK(collocated_orbit(p, 0., .1).error() == Errc::out_of_domain);
  CHECK(collocated_orbit(p, 5., 1.).error() == Errc::out_of_domain);
  CHECK_FALSE(collocated_orbit(p, 0.3, .1, {.most_nodes = 33}));
  const std::vector<State<double>> few(3), even(6), some(7);
  CHECK(collocated_orbit<double>(p, 5., .1, few, 1.).error() == Errc::out_of_domain);
  CHECK(collocated_orbit<double>(p, 5., .1, even, 1.).error() == Errc::out_of_domain);
  CHECK(collocated_orbit<double>(p, 5., .1, some, -1.).error() == Errc::out_of_domain);
}
