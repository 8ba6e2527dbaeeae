// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/prepared.hpp"

#include <cmath>
#include <cstddef>

#include "catch.hpp"
#include "scenes.hpp"

namespace general_prepared_test {

using namespace gyrostat;
using namespace gyrostat::general;

Problem<double> with_wheel(double friction) {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.3, -0.5, 0.8};
  Wheel<double> wheel;
  wheel.type = WheelType::friction, wheel.axial_inertia = 0.02, wheel.rate = 300, wheel.friction = friction;
  p.wheels.push_back(wheel);
  return p;
}

TEST_CASE("wheels that settle fast and for long make a problem stiff", "[general]") {
  const auto slow = with_wheel(1e-4), fast = with_wheel(100);
  CHECK_FALSE(Prepared<double>(slow, 1e6).is_stiff());
  CHECK(Prepared<double>(fast, 1e3).is_stiff());
  CHECK_FALSE(Prepared<double>(fast, 1e-3).is_stiff());
}

TEST_CASE("states of wheels and pushed centres make a state large", "[general]") {
  CHECK(Prepared<double>(with_wheel(1e-4), 1).is_large());
  Problem<double> p;
  CHECK_FALSE(Prepared<double>(p, 1).is_large());
  p.mass = 2, p.mass_given = true;
  p.torques.emplace_back();
  p.torques[0].type = TorqueType::thrust, p.torques[0].vector = {0, 0, 1};
  CHECK(Prepared<double>(p, 1).is_large());
}

TEST_CASE("the first numbers mean the state that a problem gives", "[general]") {
  general_scenes::Scenes source(67);
  for (int i = 0; i < 200; ++i) {
    const auto made = source.next(2);
    const auto& p = made.problem;
    const Prepared<double> of(p, made.span);
    const auto cuts = breakpoints(p, made.span);
    const auto piece = Piece<double>::first(p, of.wheels, of.torques, cuts.empty() ? made.span : cuts[0]);
    const auto x = first_numbers<double, true>(of);
    const auto state = state_of<double, true>(of, piece, 0, x.data());
    CAPTURE(i, made.kind);
    const double rate = of.sizes.momentum() / of.sizes.least;
    CHECK((state.angular_velocity - p.angular_velocity).norm() <= 1e-14 * rate);
    CHECK(angle_between(state.attitude, p.attitude) < 1e-15);
    CHECK(std::abs(state.work) <= 1e-14 * rate * of.sizes.momentum());
    for (std::size_t w = 0; w < of.wheels.count; ++w)
      if (of.wheels.laws[w].follows == Follows::state) CHECK(state.rotor_angle[w] == of.wheels.laws[w].angle);
    const auto scale = scale_of<double, true>(of);
    for (const double size : scale) CHECK((size >= 0 && std::isfinite(size)));
    for (std::size_t k = 0; k < 7; ++k) CHECK(scale[k] > 0);
  }
}

}  // namespace general_prepared_test
