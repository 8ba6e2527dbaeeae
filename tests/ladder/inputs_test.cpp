// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/inputs.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("a row of numbers is read as what it stands for", "[ladder]") {
  enum class Word { first, second };
  const std::vector<double> numbers{1, 2, 3, 4, 0, 3, 4, 0, 0, 0, 2, 1, 1, 0, 0, 0, 2, 0, 0, 0, 3};
  InputReader next(numbers);
  CHECK(next.number() == 1);
  CHECK(next.vector() == Vec3<double>(2, 3, 4));
  CHECK((next.direction() - Vec3<double>(0, .6, .8)).norm() < 1e-15);
  const auto q = next.quaternion();
  CHECK(q.w == 1);
  CHECK(q.z == 0);
  CHECK(next.choice<Word>(2) == Word::second);
  const Mat3<double> diagonal = next.tensor();
  CHECK(diagonal == Vec3<double>(1, 2, 3).asDiagonal().toDenseMatrix());
  CHECK(next.left() == 0);
  for (const double none : {-1.0, 0.5, 2.0, 1e300, gyrostat::nan<double>}) {
    InputReader strange(std::span(&none, 1));
    CHECK_FALSE(strange.choice<Word>(2));
  }
}

TEST_CASE("a direction of unit length, and one without length, stay as they are", "[ladder]") {
  const std::vector<double> numbers{0.36, 0.48, 0.8, 0, 0, 0};
  InputReader next(numbers);
  CHECK(next.direction() == Vec3<double>(0.36, 0.48, 0.8));
  CHECK(next.direction() == Vec3<double>(0, 0, 0));
}

TEST_CASE("a quaternion without length turns nothing, and is not one that was left out", "[ladder]") {
  const std::vector<double> numbers{0, 0, 0, 0, 0, 0, 0, 2};
  InputReader next(numbers);
  const Quat<double> none = next.quaternion();
  CHECK(is_given(none));
  CHECK(gyrostat::norm(none) == 0);
  CHECK(next.quaternion() == Quat<double>{1, 0, 0, 0});
}

TEST_CASE("what a scene leaves out is not given", "[ladder]") {
  const double none = gyrostat::nan<double>;
  const std::vector<double> numbers{none, none, none, none, none, none, none, none, none, none, none, none, none, 1};
  InputReader next(numbers);
  CHECK_FALSE(is_given(next.tensor()));
  CHECK_FALSE(is_given(next.quaternion()));
  CHECK(is_given(next.number()));
}

TEST_CASE("the elements of a list are not counted among the numbers of every scene", "[ladder]") {
  constexpr InputKind kinds[] = {{"body.inertia", 9}, {"torque.drag", 1}, {"wheel", 6, true}};
  STATIC_REQUIRE(input_width(kinds) == 10);
}
