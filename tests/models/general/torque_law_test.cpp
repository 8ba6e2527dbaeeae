// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/torque_law.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "catch.hpp"
#include "laws.hpp"
#include "scenes.hpp"

using namespace gyrostat;
using namespace gyrostat::general;

namespace {

constexpr auto throwing = [](double, const Seen<double>&) { return Vec3<double>(0, 0, 0); };
constexpr auto of_time_alone = [](double) noexcept { return Vec3<double>(0, 0, 0); };
static_assert(TorqueLaw<NoTorque, double> && TorqueLaw<NoTorque, long double>);
static_assert(TorqueLaw<OwnTorque, double> && !TorqueLaw<OwnTorque, long double>);
static_assert(!TorqueLaw<decltype(throwing), double> && !TorqueLaw<decltype(of_time_alone), double>);

/// NaN from 2 s on; a step at 1 s.
constexpr auto stepping = [](double t, const Seen<double>& seen) noexcept {
  if (t >= 2) return Vec3<double>(gyrostat::nan<double>, 0, 0);
  return Vec3<double>(t >= 1 ? 5 : 3, seen.angular_velocity[1], seen.rotor_rate[0]);
};

}  // namespace

TEST_CASE("the momentum of a driven body changes by the law beside all else", "[general]") {
  general_scenes::Scenes source(91);
  for (int i = 0; i < 50; ++i) {
    const auto made = source.next(2);
    const auto wheels = Wheels<double>::of(made.problem);
    Flow<double> plain(made.problem, wheels);
    DrivenFlow<double, decltype(stepping)> driven(made.problem, wheels, stepping, {1, 2, 1});
    driven.enter(0, 1);
    plain.inside = 0.5;
    const auto y = plain.start();
    auto without = y, with = y;
    plain(0.25, y, without);
    driven(0.25, y, with);
    const State<double> s = plain.state(0.25, y);
    const Vec3<double> law(3, 2 * s.angular_velocity[1], s.rotor_rate[0]);
    for (std::size_t k = 0; k < y.size(); ++k) {
      const bool pushed = k >= Flow<double>::momentum && k < Flow<double>::momentum + 3;
      CHECK(with[k] == without[k] + (pushed ? law[int(k - Flow<double>::momentum)] : 0.0));
    }
  }
}

TEST_CASE("a law is asked inside the piece alone", "[general]") {
  const Problem<double> body;
  const auto wheels = Wheels<double>::of(body);
  DrivenFlow<double, decltype(stepping)> flow(body, wheels, stepping);
  const auto y = flow.start();
  flow.enter(0, 1);
  CHECK(flow.law_at(1, y)[0] == 3);
  flow.enter(1, 2);
  CHECK(flow.law_at(1, y)[0] == 5);
  CHECK(flow.law_at(2, y)[0] == 5);
  CHECK(std::isnan(flow.lost_at()));
  flow.enter(1, 3);
  CHECK(std::isnan(flow.law_at(2.5, y)[0]));
  CHECK(flow.lost_at() == 2.5);
}

TEST_CASE("a law is not asked about numbers that are none", "[general]") {
  const Problem<double> body;
  const auto wheels = Wheels<double>::of(body);
  int asked = 0;
  const auto counting = [&asked](double, const Seen<double>&) noexcept { return ++asked, Vec3<double>(1, 0, 0); };
  DrivenFlow<double, decltype(counting)> flow(body, wheels, counting);
  auto y = flow.start();
  y[5] = gyrostat::nan<double>;
  CHECK(std::isnan(flow.law_at(0, y)[0]));
  CHECK(asked == 0);
  CHECK(std::isnan(flow.lost_at()));
}

TEST_CASE("a law of any type by a pointer", "[general]") {
  const OwnTorque none, own = OwnTorque::of(stepping, {1.0});
  const Seen<double> seen{};
  CHECK(!none.any());
  CHECK(none(0, seen) == Vec3<double>(0, 0, 0));
  CHECK(own.any());
  CHECK(own(0.5, seen) == stepping(0.5, seen));
  CHECK(own.breakpoints == std::vector<double>{1.0});
}

TEST_CASE("what a law sees stands in one order as numbers", "[general]") {
  Seen<double> seen;
  seen.attitude = {0.1, 0.2, 0.3, 0.4};  // w, x, y, z
  seen.angular_velocity = {5, 6, 7};
  seen.angular_momentum = {8, 9, 10};
  for (std::size_t i = 0; i < most_wheels; ++i) seen.rotor_rate[i] = 11 + double(i);
  const auto made = numbers_of(seen);
  CHECK(std::vector<double>(made.begin(), made.begin() + 4) == std::vector<double>{0.2, 0.3, 0.4, 0.1});
  for (std::size_t i = 4; i < made.size(); ++i) CHECK(made[i] == double(i) + 1);
}
