// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/track.hpp"

#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("an answer about wheels has a number for each, and the start as it was given", "[free]") {
  const Scene scene = posed(wheeled(), {0, 2, 7});
  const Answer answer = solved(scene);
  const Column* rate = answer.find("rotor_rate");
  REQUIRE(rate);
  CHECK(rate->row_width() == 2);
  REQUIRE(rate->values.size() == 6);
  for (int i = 0; i < 3; ++i) CHECK(rate->values[std::size_t(2 * i)] == 5);  // held
  CHECK(rate->values[1] == Approx(-9).epsilon(1e-15));
  // a wheel without friction keeps its turn in space about its axis
  const auto& w = answer.find("angular_velocity")->values;
  for (std::size_t i = 0; i < 3; ++i) CHECK(rate->values[2 * i + 1] + w[3 * i] == Approx(-9 + 0.3).epsilon(1e-12));
  const Column* angle = answer.find("rotor_angle");
  CHECK(angle->values[4] == Approx(35).epsilon(1e-14));
  CHECK((angle->values[0] == 0 && angle->values[1] == 0));
  CHECK((w[0] == 0.3 && w[1] == -0.5 && w[2] == 0.8));
  CHECK(solved(posed(body({3, 2, 1.5}, {0, 0, 0}, {1, 1, 1}), {1})).find("rotor_rate") == nullptr);
}
