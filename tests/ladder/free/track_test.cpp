// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/track.hpp"

#include <random>

#include "gyrostat/models/free/averages.hpp"
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

TEST_CASE("what a wheel has turned through errs less than is stated, also where little time has passed", "[free]") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> unit(0, 1);
  int answers = 0, lies = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3<double> J(0.2 + unit(random), 0.2 + unit(random), 0.2 + unit(random));
    if (2 * J.maxCoeff() >= J.sum() - 0.1) continue;  // room for the wheel
    Assembly<double> assembly;
    assembly.body.inertia = J.asDiagonal();
    assembly.body.angular_velocity = Vec3<double>(any(random), any(random), any(random));
    const Vec3<double> axis(any(random), any(random), any(random));
    assembly.wheels.push_back({axis.normalized(), 0.01 + 0.03 * unit(random), 0, true});
    const double t = std::pow(10, -2 + unit(random));
    const Answer answer = solved(posed(assembly, {t}, 1e-3, free::rung::closed_form));
    const auto exact = free::Reduced<long double>::taken(assembly.cast<long double>());
    const auto motion = free::Motion<long double>::make<long double>(exact.problem);
    if (!motion) continue;
    const auto& wheel = exact.wheels[0];
    const long double truth = wheel.rate * t - wheel.axis.dot(free::RateIntegral<long double>(*motion, t).at(t));
    const Column* angle = answer.find("rotor_angle");
    REQUIRE(angle);
    const double off = double(std::abs(angle->values[0] - truth)) / std::max(1e-3, std::abs(angle->values[0]));
    ++answers;
    lies += !(off <= angle->error);
  }
  CHECK(answers > 300);
  CHECK(lies == 0);
}
