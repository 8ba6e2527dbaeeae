// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/cvode_motion.hpp"

#include "../../models/rotor/bodies.hpp"
#include "../column_error.hpp"
#include "catch.hpp"
#include "truth.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

Scene scene_of(const Gyrostat<double>& body, double span, double tolerance) {
  Asked data;
  for (int i = 0; i <= 6; ++i) data.times.push_back(span * i / 6);
  data.tolerance = tolerance;
  data.angular_velocity = {0.6, -0.9, 0.7};
  data.rotor_rate = 2;
  data.full_equations = &full_by_cvode;
  return *make_scene(body, data);
}

void check_by_cvode(const Scene& scene, Integrator truth_by = Integrator::taylor) {
  const Track track = full_track(scene, nullptr);
  REQUIRE(track.failure == Errc::ok);
  Answer answer, truth;
  fill(answer, scene, track);
  judge(answer, scene.question(), tables);
  REQUIRE(true_motion(scene, truth, truth_by));
  for (const Column& column : answer.columns) {
    const double error = column_error(column, *truth.find(column.name())) - truth.find(column.name())->error;
    CAPTURE(column.kind->name, error, column.error);
    CHECK(error <= column.error);
  }
  CHECK(answer.error < 1e3 * scene.question().tolerance);
}

}  // namespace

TEST_CASE("CVODE answers a rotor scene within the error it states", "[rotor]") {
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) check_by_cvode(scene_of(reference_body(0.05, 30), 20, tolerance));
  Bodies bodies(31);
  for (int i = 0; i < 5; ++i) check_by_cvode(scene_of(bodies.realisable(), 10, 1e-6));
}

TEST_CASE("CVODE takes BDF where the motor is stiff", "[rotor]") {
  const Scene scene = scene_of(reference_body(300, 5), 5, 1e-6);
  REQUIRE(is_stiff(scene.gyrostat(), scene.start()));
  check_by_cvode(scene);
  const Track stiffer = full_track(scene_of(reference_body(3e5, 5), 5, 1e-6), nullptr);
  CHECK(stiffer.failure == Errc::ok);
  CHECK(stiffer.counts.steps < 200'000);
}

TEST_CASE("the Jacobian of the scaled equations is the derivative of their rates", "[rotor]") {
  const auto body = reference_body(0.3, 7);
  const State<double> start = body.state({0.5, -0.5, 0.5, 0.5}, {0.6, -0.9, 0.7}, 2);
  CvodeEquations equations(body, start, 40);
  const auto system = equations.system();
  const auto y = equations.start();
  std::array<double, 81> J{};
  REQUIRE(system.jacobian(0, y.data(), J.data(), system.user));
  for (std::size_t j = 0; j < 9; ++j) {
    auto high = y, low = y;
    constexpr double h = 1e-6;
    high[j] += h, low[j] -= h;
    std::array<double, 9> a{}, b{};
    REQUIRE(system.rhs(0, high.data(), a.data(), system.user));
    REQUIRE(system.rhs(0, low.data(), b.data(), system.user));
    for (std::size_t i = 0; i < 9; ++i) CHECK((a[i] - b[i]) / (2 * h) == Approx(J[9 * j + i]).margin(1e-7));
  }
  const auto back = equations.state(y.data());
  CHECK((back.momentum - start.momentum).norm() < 1e-14);
  CHECK(back.axial_momentum == Approx(start.axial_momentum).epsilon(1e-15));
}

TEST_CASE("CVODE can be stopped", "[rotor]") {
  Monitor stopped;
  stopped.cancel = true;
  CHECK(full_track(scene_of(reference_body(0.05, 30), 20, 1e-6), &stopped).failure == Errc::cancelled);
}
