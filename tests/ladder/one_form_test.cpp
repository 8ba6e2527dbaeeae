// SPDX-License-Identifier: BSD-3-Clause
// All families are asked in one form: Scene::make(what is given, question), then solve(scene, refusal, monitor).
#include <cmath>
#include <concepts>
#include <string_view>

#include "catch.hpp"
#include "gyrostat/deceleration.hpp"
#include "gyrostat/free.hpp"
#include "gyrostat/general.hpp"
#include "gyrostat/heavy.hpp"
#include "gyrostat/rotor.hpp"
#include "gyrostat/spinning.hpp"

namespace one_form_test {

using namespace gyrostat;

/// A family in the one form: the question stands behind what is given.
template <class Scene, class... Given>
concept Asked =
    requires(const Given&... given, const Question& question, const Scene& scene, Refusal& refusal, Monitor* monitor) {
      { Scene::make(given..., question) } -> std::same_as<Result<Scene>>;
      { scene.asked(question) } -> std::same_as<Scene>;
      { scene.question() } -> std::convertible_to<const Question&>;
      { solve(scene, refusal) } -> std::same_as<Answer>;
      { solve(scene, refusal, monitor) } -> std::same_as<Answer>;
    };

/// Body about its axis 3 at r, without anything acting: every family keeps the rates.
template <class Scene, class... Given>
  requires Asked<Scene, Given...>
void check_spin(const Family& family, double r, const Given&... given) {
  INFO(family.name);
  Question question;
  question.times = {0, 1, 5};
  question.tolerance = 1e-6;
  const int place = place_of(family.columns, "angular_velocity");
  REQUIRE(place >= 0);
  question.asked = {{std::size_t(place)}};
  const auto scene = Scene::make(given..., question);
  REQUIRE(scene);
  Refusal refusal;
  const Answer answer = solve(*scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK(answer.met);
  CHECK(place_of(family.rungs, answer.model) >= 0);
  const Column* rates = answer.find("angular_velocity");
  REQUIRE(rates != nullptr);
  for (std::size_t i = 0; i < answer.times.size(); ++i) {
    const Vec3<double> rate(rates->values[3 * i], rates->values[3 * i + 1], rates->values[3 * i + 2]);
    CHECK((rate - Vec3<double>(0, 0, r)).norm() <= 1e-6 * std::abs(r));
  }

  Monitor monitor;
  question.times = {2, 1};
  CHECK(Scene::make(given..., question).error() == Errc::not_increasing);
  question.times = {};
  CHECK(Scene::make(given..., question).error() == Errc::out_of_domain);
  question.times = {1};
  CHECK(solve(scene->asked(question), refusal, &monitor).times.size() == 1);
}

TEST_CASE("all families are asked in one form, and all know a body that spins about its axis", "[ladder]") {
  const Vec3<double> moments(1.2, 1.5, 2);
  const Mat3<double> tensor = moments.asDiagonal();
  constexpr double r = 0.7;
  const Vec3<double> w(0, 0, r);

  deceleration::Setup setup;
  setup.momentum = moments.cwiseProduct(w);
  check_spin<deceleration::Scene>(deceleration::tables, r, *Inertia<double>::from_tensor(tensor), setup);

  rotor::Start wheel_at_rest;
  wheel_at_rest.angular_velocity = w;
  const auto carrier = rotor::Gyrostat<double>::make(tensor, {1, 0, 0}, 0.01, 0, 0);
  REQUIRE(carrier);
  check_spin<rotor::Scene>(rotor::tables, r, *carrier, wheel_at_rest);

  spinning::Problem<double> spinner;
  spinner.inertia = moments, spinner.angular_velocity = w;
  check_spin<spinning::Scene>(spinning::tables, r, spinner);

  heavy::Start upright;
  upright.state.angular_velocity = w;
  const auto top = heavy::Body::make(tensor, 1, {0, 0, 0.05}, 0, 0);
  REQUIRE(top);
  check_spin<heavy::Scene>(heavy::tables, r, *top, upright);

  free::Assembly<double> alone;
  alone.body = free::Problem<double>::from_moments(moments, {0, 0, 0}, w);
  check_spin<free::Scene>(free::tables, r, alone);

  general::Problem<double> body;
  body.inertia = tensor, body.angular_velocity = w;
  check_spin<general::Scene>(general::tables, r, body);
}

}  // namespace one_form_test
