// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/full_rung.hpp"

#include "../../models/rotor/bodies.hpp"
#include "../column_error.hpp"
#include "catch.hpp"
#include "truth.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

Asked asked_fully(double span, double tolerance) {
  Asked data;
  for (int i = 0; i <= 6; ++i) data.times.push_back(span * i / 6);
  data.tolerance = tolerance;
  data.angular_velocity = {0.6, -0.9, 0.7};
  data.rotor_rate = 2;
  return data;
}

}  // namespace

TEST_CASE("the full rung meets what it is asked for and says its error", "[rotor]") {
  for (const Integrator integrator : {Integrator::any, Integrator::taylor, Integrator::radau}) {
    for (const double tolerance : {1e-3, 1e-7, 1e-11}) {
      Asked data = asked_fully(30, tolerance);
      data.integrator = integrator;
      const Scene scene = *make_scene(reference_body(0.05, 30), data);
      const Track track = full_track(scene, nullptr);
      REQUIRE(track.failure == Errc::ok);
      CHECK(track.error.greatest() <= tolerance);
      CHECK(track.counts.steps > 0);
      Answer answer, truth;
      fill(answer, scene, track);
      REQUIRE(true_motion(scene, truth));
      for (const Column& column : answer.columns) {
        CAPTURE(int(integrator), tolerance, column.kind->name);
        CHECK(column_error(column, *truth.find(column.name())) <= column.error + truth.find(column.name())->error);
      }
    }
  }
}

TEST_CASE("equations that the scene brings take the place of the library's", "[rotor]") {
  Asked data = asked_fully(1, 1e-6);
  data.full_equations = [](const Scene&, Monitor*) { return refused<Track>(Errc::unavailable, "not mine"); };
  const Track track = full_track(*make_scene(reference_body(0.05, 30), data), nullptr);
  CHECK(track.failure == Errc::unavailable);
}

TEST_CASE("a full rung that is stopped says so", "[rotor]") {
  Monitor stopped;
  stopped.cancel = true;
  const Scene scene = *make_scene(reference_body(0.05, 30), asked_fully(1e5, 1e-6));
  CHECK(full_track(scene, &stopped).failure == Errc::cancelled);
}

TEST_CASE("one time, and time zero alone, are answered", "[rotor]") {
  Asked data = asked_fully(1, 1e-9);
  data.times = {0};
  const Scene start = *make_scene(reference_body(0.05, 30), data);
  const Track track = full_track(start, nullptr);
  REQUIRE(track.failure == Errc::ok);
  CHECK(track.states[0].momentum == start.start().momentum);
  CHECK(track.error.greatest() <= 1e-9);
  data.times = {7.5};
  CHECK(full_track(*make_scene(reference_body(0.05, 30), data), nullptr).error.greatest() < 1e-9);
}
