// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/cvode_motion.hpp"

#include "asked.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

namespace {

Asked wheel(Law law) {
  Asked data;
  data.rotor_momentum = {0.2, 0.15, 0.3};
  data.control = {6e-4, 9e-4, 1e-3};
  data.drag = 3e-4;
  data.law = data.drag_law = law;
  data.momentum = {0.8, 0.5, 0.33};
  data.wants_attitude = true;
  data.rung = rung::full;
  for (int i = 0; i <= 12; ++i) data.times.push_back(100.0 * i);
  return data;
}

Answer answer(const Asked& data) {
  const auto scene = make_scene(*Inertia<double>::from_moments(1.4, 1.0, 0.7), data);
  REQUIRE(scene);
  Refusal refusal;
  Answer made = solve(*scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  return made;
}

}  // namespace

TEST_CASE("CVODE agrees with Taylor series within what both state, through the stop") {
  for (const Law law : {Law::total, Law::carrier}) {
    Asked data = wheel(law);
    data.tolerance = 1e-6;
    const Answer taylor = answer(data);
    data.full_equations = &full_by_cvode;
    const Answer cvode = answer(data);
    CHECK(cvode.counts.rhs > taylor.counts.rhs);
    for (const char* name : {"angular_momentum", "angular_velocity", "attitude"}) {
      const Column *mine = taylor.find(name), *theirs = cvode.find(name);
      REQUIRE(mine);
      REQUIRE(theirs);
      double size = 0, apart = 0;
      for (std::size_t i = 0; i < mine->values.size(); ++i) {
        size = std::max(size, std::abs(mine->values[i]));
        apart = std::max(apart, std::abs(mine->values[i] - theirs->values[i]));
      }
      INFO(name << " law " << int(law));
      CHECK(apart <= size * (mine->error + theirs->error));
      CHECK(theirs->error < 1e-3);
    }
    CHECK(cvode.quantities[0].values[0] == Approx(taylor.quantities[0].values[0]).epsilon(1e-6));
  }
}

TEST_CASE("CVODE does not take the modulus just before the stop for that of rest") {
  Asked data;
  data.control = {0.064, 0.062, 0.058};
  data.law = data.drag_law = Law::carrier;
  data.momentum = {2, 1.25, 0.44};
  data.rung = rung::full;
  data.tolerance = 1e-3;
  data.times = {38.12216898007308};  // 1e-7 of it before the stop: k2 is 0.371648 still
  data.full_equations = &full_by_cvode;
  const auto scene = make_scene(*Inertia<double>::from_moments(0.7, 1.0, 1.3), data);
  REQUIRE(scene);
  Refusal refusal;
  const Answer made = solve(*scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  const Column& k2 = *made.find("modulus_squared");
  CAPTURE(k2.values[0], k2.error);
  CHECK(std::abs(k2.values[0] - 0.371648) <= k2.error);
}

TEST_CASE("a cancelled CVODE run is refused as such") {
  Asked data = wheel(Law::total);
  data.full_equations = &full_by_cvode;
  const auto scene = make_scene(*Inertia<double>::from_moments(1.4, 1.0, 0.7), data);
  Monitor monitor;
  monitor.cancel = true;
  Refusal refusal;
  const Answer none = solve(*scene, refusal, &monitor);
  CHECK(refusal.code == Errc::cancelled);
  CHECK(none.columns.empty());
}
