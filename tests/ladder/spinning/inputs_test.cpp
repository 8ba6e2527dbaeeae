// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/inputs.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

std::vector<double> spinner_row() {
  const double none = gyrostat::nan<double>;
  return {8,    7,    11,   10,   1.3, none, none, none, none, none, .04, -.02, 0, 0, 0, 3,
          none, none, none, none, .1,  .2,   1,    none, none, none, 1,   2,    3, 4, 5, 6};
}

}  // namespace

TEST_CASE("a row of numbers is the spinner that it stands for", "[spinning]") {
  Question question;
  question.times = {1};
  std::vector<double> row = spinner_row();
  auto scene = scene_of(row, question);
  REQUIRE(scene);
  const Problem<double>& p = scene->problem();
  CHECK(p.inertia == Vec3<double>(8, 7, 11));
  CHECK(p.rotor_momentum == 1.3);
  CHECK(p.charge_momentum == 0);
  CHECK(p.force == Vec3<double>(0, 0, 3));
  CHECK(p.angular_velocity == Vec3<double>(.1, .2, 1));
  CHECK(p.position == Vec3<double>(4, 5, 6));
  CHECK(p.angles.theta == 0);

  row[6] = .003, row[7] = 100, row[8] = 1.1, row[9] = .4;
  row[16] = row[17] = 0, row[18] = std::sin(.15), row[19] = std::cos(.15);
  scene = scene_of(row, question);
  REQUIRE(scene);
  CHECK(scene->problem().charge_momentum == Approx(.003 * 100 * 1.21 * std::cos(.4)).epsilon(1e-15));
  CHECK(scene->problem().angles.theta == Approx(.3).epsilon(1e-14));
  row[18] = row[19] = 0;
  CHECK(scene_of(row, question).error() == Errc::zero_vector);
  row[19] = 1;
  row[5] = .29, row[6] = gyrostat::nan<double>;
  CHECK(scene_of(row, question)->problem().charge_momentum == .29);
}

TEST_CASE("a spinner that is none says why", "[spinning]") {
  Question question;
  question.times = {1};
  std::vector<double> row = spinner_row();
  row[3] = 0;
  CHECK(scene_of(row, question).error() == Errc::not_positive);
  row[3] = 1, row[2] = 16;
  CHECK(scene_of(row, question).error() == Errc::triangle_inequality);
  row.push_back(1);
  CHECK(scene_of(row, question).error() == Errc::out_of_domain);
}
