// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/table.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"

namespace general_table_test {

using namespace gyrostat;
using namespace gyrostat::general;

Table<double> table_of(Between between, bool holds = false) { return {{1, 2, 4, 5}, {2, -1, 3, 5}, between, holds}; }

TEST_CASE("a table of steps, of lines and of cubics goes through its values", "[general]") {
  for (const Between between : {Between::step, Between::linear, Between::cubic}) {
    const auto table = table_of(between);
    REQUIRE(check(table, 1) == Errc::ok);
    for (std::size_t i = 0; i + 1 < 4; ++i) {
      const auto here = piece(table, 1, 0, table.times[i]);
      CHECK(here(table.times[i]) == table.values[i]);
      const double end = here(table.times[i + 1]);
      CHECK(end == Approx(between == Between::step ? table.values[i] : table.values[i + 1]));
    }
  }
  CHECK(piece(table_of(Between::linear), 1, 0, 2.5)(3.) == Approx(1));
}

TEST_CASE("a cubic table is smooth and right for parabolas", "[general]") {
  const auto table = table_of(Between::cubic);
  const auto slope = [](const Cubic<double>& c, double t) { return c.about(t).c[1]; };
  for (const double t : {2., 4.})
    CHECK(slope(piece(table, 1, 0, t - 0.5), t) == Approx(slope(piece(table, 1, 0, t), t)));
  const auto parabola = [](double t) { return 2 - 3 * t + 0.5 * t * t; };
  Table<double> of{{0, 1, 3, 4}, {}, Between::cubic, false};
  for (const double t : of.times) of.values.push_back(parabola(t));
  for (const double t : {0.2, 1.7, 2.9, 3.5}) CHECK(piece(of, 1, 0, t)(t) == Approx(parabola(t)).epsilon(1e-14));
  const Table<double> two{{0, 2}, {1, 5}, Between::cubic, false};
  CHECK(piece(two, 1, 0, 0.)(0.5) == Approx(2));
}

TEST_CASE("outside its times a table is zero or holds", "[general]") {
  for (const bool holds : {false, true}) {
    const auto table = table_of(Between::linear, holds);
    CHECK(piece(table, 1, 0, 0.)(0.5) == (holds ? 2 : 0));
    CHECK(piece(table, 1, 0, 5.)(7.) == (holds ? 5 : 0));
  }
  CHECK(piece(Table<double>{}, 1, 0, 1.)(2.) == 0);
}

TEST_CASE("columns of a table and a cubic about another time", "[general]") {
  const Table<double> table{{0, 1}, {1, 2, 3, 4, 5, 6}, Between::linear, false};
  REQUIRE(check(table, 3) == Errc::ok);
  for (std::size_t i = 0; i < 3; ++i) CHECK(piece(table, 3, i, 0.)(0.5) == double(i) + 2.5);
  const Cubic<double> cubic{1, {1, -2, 3, 0.5}};
  for (const double t : {-1., 0.3, 4.}) CHECK(cubic.about(2.5)(t) == Approx(cubic(t)));
}

TEST_CASE("how far a cubic goes between its times", "[general]") {
  CHECK(swing(table_of(Between::linear), 1) == 1);
  CHECK(swing(Table<double>{{0, 1, 2}, {0, 0, 0}, Between::cubic, false}, 1) == 1);
  // a jump of 1 within h: its slope 1/h is that of the parabola there but for a part of h, and carries the cubic 10/(3 h) far
  for (const double h : {1e-1, 1e-3, 1e-6}) {
    const Table<double> jump{{0, 10, 10 + h, 20}, {0, 0, 1, 1}, Between::cubic, false};
    CHECK(swing(jump, 1) == Approx(10 / (3 * h)).epsilon(0.3 * h + 1e-9));
    double reached = 0;
    for (double t = 0; t < 20; t += 0.01) reached = std::max(reached, std::abs(piece(jump, 1, 0, t)(t)));
    CHECK(reached < swing(jump, 1));
    CHECK(reached > 0.4 * swing(jump, 1));
  }
  const Table<double> three{{0, 10, 10.001, 20}, {5, 0, 0, 5, 0, 0, 5, 0, 1, 5, 0, 1}, Between::cubic, false};
  CHECK(swing(three, 3) == Approx(10 / (3 * 0.001) / 5).epsilon(1e-3));
}

TEST_CASE("tables that are not are refused", "[general]") {
  CHECK(check(table_of(Between::step), 3) == Errc::out_of_domain);
  CHECK(check(Table<double>{{1, 1}, {2, 3}, Between::linear, false}, 1) == Errc::not_increasing);
  CHECK(check(Table<double>{{1, gyrostat::nan<double>}, {2, 3}, Between::linear, false}, 1) == Errc::not_finite);
  CHECK(check(Table<double>{{1, 2}, {2, infinity<double>}, Between::linear, false}, 1) == Errc::not_finite);
}

TEST_CASE("a table is constant over a span that it covers", "[general]") {
  Table<double> table{{0, 1, 5}, {2, 2, 2}, Between::linear, false};
  CHECK(is_constant(table, 5.));
  CHECK_FALSE(is_constant(table, 6.));
  table.holds = true;
  CHECK(is_constant(table, 6.));
  table.values[1] = 3;
  CHECK_FALSE(is_constant(table, 5.));
}

}  // namespace general_table_test
