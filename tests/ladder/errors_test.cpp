// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/errors.hpp"

#include <cmath>

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("the greatest of the errors is NaN if any is", "[ladder]") {
  Errors<3> errors{{1, 3, 2}};
  CHECK(errors.greatest() == 3);
  errors[1] = gyrostat::nan<double>;
  CHECK(std::isnan(errors.greatest()));
  errors[0] = infinity<double>;
  CHECK(std::isnan(errors.greatest()));
}

TEST_CASE("raising keeps the greater of two, and NaN from either side", "[ladder]") {
  Errors<3> most{{1, 5, gyrostat::nan<double>}};
  most.raise({{2, gyrostat::nan<double>, 7}});
  CHECK(most[0] == 2);
  CHECK(std::isnan(most[1]));
  CHECK(std::isnan(most[2]));
  most.raise({{0, 0, 0}});
  CHECK(most[0] == 2);
  CHECK(std::isnan(most[2]));
}

TEST_CASE("errors add and scale column by column", "[ladder]") {
  const Errors<2> sum = 2.0 * Errors<2>{{1, 2}} + Errors<2>{{10, 20}};
  CHECK(sum[0] == 12);
  CHECK(sum[1] == 24);
  CHECK(Errors<2>::all(3)[1] == 3);
}

TEST_CASE("an error over a vanishing size is infinite, but for no error at all", "[ladder]") {
  CHECK(over(0.0, 0.0) == 0);
  CHECK(over(1e-300, 0.0) == infinity<double>);
  CHECK(over(1.0, 4.0) == 0.25);
}

TEST_CASE("relative to the truth an error is wider; an attitude's is an angle and stays", "[ladder]") {
  CHECK(relative_to_truth(0.5) == 1);
  CHECK(relative_to_truth(1.0) == infinity<double>);
  CHECK(std::isnan(relative_to_truth(gyrostat::nan<double>)));
  static constexpr ColumnKind kinds[] = {{"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, ""},
                                         {"energy", 1, "J", Frame::none, Measure::relative, ""}};
  const auto wide = relative_to_truth(Errors<2>{{0.5, 0.5}}, kinds);
  CHECK(wide[0] == 0.5);
  CHECK(wide[1] == 1);
}
