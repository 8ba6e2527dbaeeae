// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/scene.hpp"

#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("a scene of a free body knows its wheels, its momentum and what is asked", "[free]") {
  const Scene scene = posed(wheeled(), {0, 1});
  CHECK(scene.wheels() == 2);
  const Vec3<double> w(0.3, -0.5, 0.8), M = scene.angular_momentum();
  const Vec3<double> whole = Vec3<double>(3, 2.5, 2).cwiseProduct(w) + Vec3<double>(0.1, 0, 0) +
                             0.2 * 5 * Vec3<double>(0, 0.6, 0.8) - 0.1 * 9 * Vec3<double>(1, 0, 0);
  CHECK((M - whole).norm() < 1e-15);
  CHECK((scene.angular_velocity() - w).norm() < 1e-15);
  CHECK(scene.gives(free::column::rotor_angle));
  CHECK_FALSE(posed(body({3, 2, 1.5}, {0, 0, 0}, {1, 1, 1}), {1}).gives(free::column::rotor_rate));
  CHECK(scene.goal().tightest == 1e-6);
  CHECK(scene.scales()[free::column::rotor_rate] == Approx(9e-3));

  auto by_momentum = wheeled();
  by_momentum.body.momentum_given = true;
  by_momentum.body.angular_momentum = M;
  by_momentum.body.angular_velocity.setZero();
  CHECK((posed(by_momentum, {1}).angular_velocity() - w).norm() < 1e-14);
}

TEST_CASE("a scene of a free body refuses what is not physical, and says which wheel", "[free]") {
  Question question;
  question.times = {1};
  auto heavy = wheeled();
  heavy.wheels[1].axial_inertia = 2.9;
  free::UnsoundWheel<double> unsound;
  const auto made = Scene::make(heavy, question, &unsound);
  REQUIRE_FALSE(made);
  CHECK(made.error() == Errc::triangle_inequality);
  CHECK(unsound.wheel == 1);
  CHECK((unsound.limit > 0.1 && unsound.limit < 2.9));
  CHECK(Scene::make(body({3, 1, 1}, {0, 0, 0}, {1, 1, 1}), question).error() == Errc::triangle_inequality);
  CHECK(Scene::make(body({3, 2, 2}, {0, 0, 0}, {1, 1, gyrostat::nan<double>}), question).error() == Errc::not_finite);
  CHECK(Scene::make(body({3e-160, 2e-160, 2e-160}, {0, 0, 0}, {1, 1, 1}), question).error() == Errc::beyond_range);
  CHECK(Scene::make(body({3, 2, 2}, {0, 0, 0}, {1e154, 1, 1}), question).error() == Errc::beyond_range);
  CHECK(Scene::make(body({3, 2, 2}, {0, 0, 0}, {0, 0, 0}), question).error() == Errc::ok);
  question.times = {1, 0.5};
  CHECK(Scene::make(wheeled(), question).error() == Errc::not_increasing);
}
