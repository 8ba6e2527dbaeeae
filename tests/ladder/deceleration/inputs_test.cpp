// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/inputs.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

TEST_CASE("a row of numbers is the scene that it stands for", "[deceleration]") {
  const double none = gyrostat::nan<double>;
  Question question;
  question.times = {1, 2};
  std::vector<double> row{35, 0,    0, 0, 22,   0,    0,    0,    16,  1,   2,   3,    .1,   .2,
                          .3, 1e-3, 1, 0, none, none, none, none, .01, .02, .03, none, none, none};
  const auto scene = scene_of(row, question);
  REQUIRE(scene);
  CHECK(scene->setup().momentum == Vec3<double>(35 * .01 + 1, 22 * .02 + 2, 16 * .03 + 3));
  CHECK(scene->setup().angular_velocity.has_value());
  CHECK(scene->setup().control == Vec3<double>(.1, .2, .3));
  CHECK(scene->problem().law == Law::carrier);
  CHECK(scene->problem().drag_law == Law::total);
  CHECK(scene->problem().drag == 1e-3);
  CHECK_FALSE(scene->question().wants_attitude);

  for (int i = 0; i < 3; ++i) row[std::size_t(22 + i)] = none, row[std::size_t(25 + i)] = 4 + i;
  row[18] = row[19] = row[20] = 0, row[21] = 2;
  const auto other = scene_of(row, question);
  REQUIRE(other);
  CHECK(other->setup().momentum == Vec3<double>(4, 5, 6));
  CHECK(other->question().wants_attitude);
  CHECK(other->setup().attitude.w == 1);
  row[21] = 0;
  CHECK(scene_of(row, question).error() == Errc::zero_vector);
}

TEST_CASE("a row that is no scene says why", "[deceleration]") {
  Question question;
  question.times = {1};
  std::vector<double> row(input_width(input_kinds), 0.0);
  CHECK(scene_of(row, question).error() == Errc::not_positive);
  row[0] = row[4] = 1, row[8] = 3;
  CHECK(scene_of(row, question).error() == Errc::triangle_inequality);
  row[8] = 1;
  row[21] = 1;
  CHECK(scene_of(row, question).error() == Errc::ok);
  row[15] = -1;
  CHECK(scene_of(row, question).error() == Errc::negative);
  row.pop_back();
  CHECK(scene_of(row, question).error() == Errc::out_of_domain);
}
