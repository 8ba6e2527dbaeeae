// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/inputs.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

std::vector<double> free_row() {
  const double none = gyrostat::nan<double>;
  return {3,  0,    0,    0,    2.5,  0,    0,    0,    2, .1, 0,  0,  .3, -.5, .8, none, none, none, .5, -.5, .5,
          .5, none, none, none, none, none, none, none, 0, .6, .8, .2, 5,  0,   1,  0,    0,    .1,   -9, 1};
}

}  // namespace

TEST_CASE("a row of numbers is the body with the wheels that it stands for", "[free]") {
  Question question;
  question.times = {1};
  std::vector<double> row = free_row();
  auto scene = free::scene_of(row, question);
  REQUIRE(scene);
  CHECK(scene->wheels() == 2);
  CHECK_FALSE(scene->assembly().wheels[0].turns_freely);
  CHECK(scene->assembly().wheels[1].turns_freely);
  CHECK(scene->assembly().wheels[1].rate == -9);
  CHECK_FALSE(scene->assembly().body.momentum_given);
  CHECK(scene->assembly().body.attitude.w == .5);
  CHECK_FALSE(scene->view());

  for (std::size_t i = 12; i < 15; ++i) row[i + 3] = row[i], row[i] = gyrostat::nan<double>;
  row[22] = row[25] = 1, row[23] = row[24] = row[26] = row[27] = 0, row[28] = .5;
  scene = free::scene_of(row, question);
  REQUIRE(scene);
  CHECK(scene->assembly().body.momentum_given);
  CHECK(scene->angular_momentum() == Vec3<double>(.3, -.5, .8));
  REQUIRE(scene->view());
  CHECK(scene->view()->half_angle == .5);
}

TEST_CASE("a body whose wheels are none says why", "[free]") {
  Question question;
  question.times = {1};
  std::vector<double> row = free_row();
  row[38] = 4;
  CHECK(free::scene_of(row, question).error() == Errc::triangle_inequality);
  row = free_row(), row.pop_back();
  CHECK(free::scene_of(row, question).error() == Errc::out_of_domain);
}
