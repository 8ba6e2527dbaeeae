// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/inputs.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

/// Carrier and rotor apart.
std::vector<double> rotor_row() {
  const double none = gyrostat::nan<double>;
  std::vector<double> row(9, none);
  for (const double value : {2.1, 0., 0.,   0., 2.6, 0.,  0., 0., 3.2, 12., .36, .48, .8, .35, 3.,
                             .3,  .2, -.15, .3, .05, 30., .1, .2, .3,  4.,  0.,  0.,  0., 1.})
    row.push_back(value);
  return row;
}

}  // namespace

TEST_CASE("carrier and rotor apart, or the whole, come to the same scene", "[rotor]") {
  Question question;
  question.times = {1};
  std::vector<double> row = rotor_row();
  const auto scene = scene_of(row, question);
  REQUIRE(scene);
  const auto& body = scene->gyrostat();
  CHECK(body.slope() == .05);
  CHECK(body.no_load_rate() == 30);
  CHECK(body.axial_inertia() == .35);
  CHECK(scene->given().rotor_rate == 4);
  CHECK(scene->given().angular_velocity == Vec3<double>(.1, .2, .3));
  for (int i = 0; i < 9; ++i) row[std::size_t(i)] = body.inertia()(i / 3, i % 3);
  const auto whole = scene_of(row, question);
  REQUIRE(whole);
  CHECK(whole->gyrostat().inertia() == body.inertia());
  CHECK(whole->start().momentum == scene->start().momentum);
}

TEST_CASE("an axis that is moved is brought back to unit length", "[rotor]") {
  Question question;
  question.times = {1};
  std::vector<double> row = rotor_row();
  row[19] += .1;
  const auto scene = scene_of(row, question);
  REQUIRE(scene);
  CHECK((scene->gyrostat().axis() - Vec3<double>(.46, .48, .8).normalized()).norm() < 1e-15);
}

TEST_CASE("a rotor that nothing can hold is no scene", "[rotor]") {
  Question question;
  question.times = {1};
  std::vector<double> row = rotor_row();
  row[22] = .7;
  CHECK(scene_of(row, question).error() == Errc::triangle_inequality);
  row[22] = -1;
  CHECK(scene_of(row, question).error() == Errc::not_positive);
  CHECK(scene_of(std::vector<double>{}, question).error() == Errc::out_of_domain);
}
