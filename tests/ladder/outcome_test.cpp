// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/outcome.hpp"

#include <cmath>
#include <string_view>

#include "catch.hpp"

using namespace gyrostat;

namespace {
struct Tracked : Outcome {
  int value = 3;
};
}  // namespace

TEST_CASE("an outcome warns once a code", "[ladder]") {
  Tracked track;
  static constexpr WarningKind kinds[] = {{"far", "it is far"}, {"near", "it is near"}};
  track.warn(kinds[0], 2);
  track.warn(kinds[0], 3, "it is farther");
  track.warn(kinds[1], gyrostat::nan<double>, "it is very near");
  REQUIRE(track.warnings.size() == 2);
  CHECK(track.warnings[0].value == 2);
  CHECK(track.warnings[0].text == std::string_view("it is far"));
  CHECK(track.warnings[1].text == std::string_view("it is very near"));
  CHECK(track.warnings[1].code() == "near");
  CHECK(std::isnan(track.warnings[1].value));
}

TEST_CASE("a refusal says why, an error over the tolerance says how much", "[ladder]") {
  const auto why = refused<Tracked>(Errc::separatrix, "too near");
  CHECK(why.failure == Errc::separatrix);
  CHECK(why.refusal == std::string_view("too near"));
  CHECK(std::isnan(why.known_error));
  const auto much = over_tolerance<Tracked>(0.25);
  CHECK(much.failure == Errc::not_applicable);
  CHECK(much.refusal == nullptr);
  CHECK(much.known_error == 0.25);
  CHECK(Tracked{}.failure == Errc::ok);
  CHECK(Tracked{}.in_domain);
}

TEST_CASE("an integration that ended early says why", "[outcome]") {
  CHECK(failure_of(ode::Status::reached) == Errc::ok);
  CHECK(failure_of(ode::Status::cancelled) == Errc::cancelled);
  CHECK(failure_of(ode::Status::step_limit) == Errc::step_limit);
  CHECK(failure_of(ode::Status::step_underflow) == Errc::no_convergence);
  CHECK(failure_of(ode::Status::not_finite) == Errc::no_convergence);
}
