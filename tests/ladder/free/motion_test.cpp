// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/motion.hpp"

#include "catch.hpp"
#include "gyrostat/models/free/kind.hpp"

TEST_CASE("the words of a motion's kind are those of the model", "[free]") {
  namespace free = gyrostat::free;
  for (std::size_t i = 0; i < std::size(free::kind_words); ++i)
    CHECK(std::string_view(free::kind_words[i]) == free::name(free::Kind(i)));
  CHECK(std::size(free::kind_words) == std::size_t(free::Kind::spherical) + 1);
}
