// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/bounded_list.hpp"

#include "allocations.hpp"
#include "catch.hpp"

using gyrostat::BoundedList;

TEST_CASE("a bounded list holds what is pushed, in order and without the heap") {
  const std::size_t before = allocations();
  BoundedList<double, 3> list;
  const bool empty_at_first = list.empty();
  for (const double x : {1.5, 2.5, 3.5}) list.push_back(x);
  double sum = 0;
  for (const double& x : list) sum += x;
  const std::size_t taken = allocations() - before;
  CHECK(empty_at_first);
  CHECK(taken == 0);
  CHECK(list.size() == 3);
  CHECK(!list.empty());
  CHECK(sum == 7.5);
  CHECK(list[1] == 2.5);
  CHECK(list.back() == 3.5);
  list.back() = 4.5;
  CHECK(list[2] == 4.5);
}

TEST_CASE("a full bounded list stays as it is") {
  BoundedList<int, 2> list;
  for (int i = 0; i < 5; ++i) list.push_back(i);
  CHECK(list.size() == 2);
  CHECK(list[1] == 1);
  CHECK(list.end() - list.begin() == 2);
}
