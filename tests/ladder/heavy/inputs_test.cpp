// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/inputs.hpp"

#include <string_view>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

std::vector<double> heavy_row() {
  const double none = gyrostat::nan<double>;
  return {.0011, 0,    0, 0, .0016, 0,  0, 0,  .002, .8,   .012, .009, .01,  9.80665,
          none,  none, 0, 0, 150,   .6, 0, .8, none, none, none, none, none, none};
}

}  // namespace

TEST_CASE("a row of numbers is the heavy body that it stands for", "[heavy]") {
  Question question;
  question.times = {1};
  std::vector<double> row = heavy_row();
  auto scene = scene_of(row, question);
  REQUIRE(scene);
  CHECK(scene->problem().mass() == .8);
  CHECK(scene->problem().gradient() == 0);
  CHECK(scene->given().down == Vec3<double>(.6, 0, .8));
  CHECK_FALSE(scene->oriented());

  row[15] = 6.4e6;
  for (int i = 0; i < 3; ++i) row[std::size_t(19 + i)] = gyrostat::nan<double>;
  row[22] = 1, row[23] = row[24] = row[25] = 0;
  scene = scene_of(row, question);
  REQUIRE(scene);
  CHECK(scene->problem().gradient() == 3 * 9.80665 / 6.4e6);
  CHECK(scene->oriented());
  CHECK(scene->question().wants_attitude);
  row[22] = 0;
  CHECK(scene_of(row, question).error() == Errc::zero_vector);

  for (int i = 0; i < 3; ++i) row[std::size_t(16 + i)] = gyrostat::nan<double>;
  for (int i = 0; i < 4; ++i) row[std::size_t(22 + i)] = gyrostat::nan<double>;
  row[26] = 150, row[27] = .1;
  scene = scene_of(row, question);
  REQUIRE(scene);
  REQUIRE(scene->periodic());
  CHECK(scene->periodic()->spin == 150);
  CHECK(scene->periodic()->cos_inclination == .1);
}

TEST_CASE("a heavy body that is none says why", "[heavy]") {
  Question question;
  question.times = {1};
  std::vector<double> row = heavy_row();
  row[10] = .2;
  CHECK(scene_of(row, question).error() == Errc::triangle_inequality);
  const SceneOf scenes;
  REQUIRE(scenes.why(row) != nullptr);
  CHECK(std::string_view(scenes.why(row)).ends_with("has its mass centre there"));
  row = heavy_row(), row[0] = 1;  // no body has these moments
  CHECK(scenes(row, question).error() == Errc::triangle_inequality);
  CHECK(scenes.why(row) == nullptr);
  row = heavy_row(), row[15] = -1;
  CHECK(scene_of(row, question).error() == Errc::not_positive);
  row.pop_back();
  CHECK(scenes.why(row) == nullptr);
  CHECK(scene_of(row, question).error() == Errc::out_of_domain);
}
