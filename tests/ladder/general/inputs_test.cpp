// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/inputs.hpp"

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

general::Problem<double> problem_of_all_parts() {
  general::Problem<double> made;
  made.inertia << 3, .1, .2, .1, 2.5, .3, .2, .3, 2;
  made.mass = 7;
  made.wheels.resize(2);
  made.wheels[1].type = general::WheelType::torque;
  made.wheels[1].table = {{0, 1, 2}, {.1, .2, .3}};
  made.torques.resize(2);
  made.torques[0].matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  made.torques[0].gradient = 4.5;
  made.torques[1].type = general::TorqueType::table;
  made.torques[1].table = {{0, 1}, {1, 2, 3, 4, 5, 6}};
  made.torques[1].factor.on = {{0, 1}, {2, 3}};
  made.torques[1].factor.table = {{0, 5}, {1, 2}};
  made.orbit.emplace();
  made.attitude = {.5, -.5, .5, .5};
  made.angular_velocity = {.1, .2, .3};
  return made;
}

std::vector<double> row_of(general::Problem<double> problem) {
  std::vector<double> row;
  general::visit_numbers(problem, [&](const general::InputName&, const auto& value) { general::give(value, row); });
  return row;
}

std::string full_name(const general::InputName& name) {
  return name.table + std::to_string(name.place) + "." + name.key;
}

}  // namespace

TEST_CASE("a problem with its own numbers is that problem, and with others it has those in their places", "[general]") {
  const auto problem = problem_of_all_parts();
  std::vector<double> row = row_of(problem);
  CHECK(row_of(general::with_numbers(problem, row)) == row);

  double next = 1000;
  for (double& number : row) number = ++next;
  auto made = general::with_numbers(problem, row);
  std::size_t first = 0;
  std::set<std::string> names;
  general::visit_numbers(made, [&](const general::InputName& name, const auto& value) {
    std::vector<double> own;
    general::give(value, own);
    for (std::size_t i = 0; i < own.size() && full_name(name) != "initial-1.attitude"; ++i)
      CHECK(own[i] == row[first + i]);
    first += own.size();
    CHECK(names.insert(full_name(name)).second);
  });
  CHECK(first == row.size());
  CHECK(made.inertia(0, 1) == row[1]);
  CHECK(made.torques[0].matrix(2, 0) == made.torques[0].matrix(0, 0) + 6);
  CHECK(made.torques[1].factor.on[1][0] == made.torques[1].factor.on[0][0] + 2);
}

TEST_CASE("an attitude of a row is brought to unit norm, and one that has it stays to the last bit", "[general]") {
  auto problem = problem_of_all_parts();
  std::vector<double> row = row_of(problem);
  const std::size_t at = row.size() - 13;
  REQUIRE(row[at + 3] == .5);
  CHECK(general::with_numbers(problem, row).attitude == problem.attitude);
  for (std::size_t i = 0; i < 4; ++i) row[at + i] *= 3;
  CHECK(std::abs(general::with_numbers(problem, row).attitude.w - .5) < 1e-15);
  for (std::size_t i = 0; i < 4; ++i) row[at + i] = 0;
  const auto none = general::with_numbers(problem, row);
  CHECK(gyrostat::norm(none.attitude) == 0);
  CHECK(check_start(none).code == Errc::out_of_domain);
}
