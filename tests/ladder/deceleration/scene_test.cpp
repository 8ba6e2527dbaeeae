// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/scene.hpp"

#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

constexpr double bad_numbers[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};

Asked good() {
  Asked d;
  d.control = V(1, 2, 3);
  d.drag = .1;
  d.momentum = V(4, 5, 6);
  d.rotor_momentum = V(.1, .2, .3);
  d.times = {0, 1, 2.5};
  return d;
}

Errc made(const Asked& data) { return make_scene(Inertia<double>(), data).error(); }

}  // namespace

TEST_CASE("a scene that is not one says why", "[deceleration]") {
  CHECK(made(good()) == Errc::ok);
  const auto changed = [](auto change) {
    Asked d = good();
    change(d);
    return made(d);
  };
  for (const double bad : bad_numbers) {
    for (int i = 0; i < 3; ++i) {
      CHECK(changed([&](Asked& d) { d.momentum[i] = bad; }) == Errc::not_finite);
      CHECK(changed([&](Asked& d) { d.rotor_momentum[i] = bad; }) == Errc::not_finite);
      CHECK(changed([&](Asked& d) { d.control[i] = bad; }) == Errc::not_finite);
    }
    CHECK(changed([&](Asked& d) { d.drag = bad; }) == Errc::not_finite);
    CHECK(changed([&](Asked& d) { d.tolerance = bad; }) == Errc::not_finite);
    CHECK(changed([&](Asked& d) { d.times[1] = bad; }) == Errc::not_finite);
    CHECK(changed([&](Asked& d) { d.attitude.x = bad; }) == Errc::not_finite);
  }
  for (int i = 0; i < 3; ++i) CHECK(changed([&](Asked& d) { d.control[i] = -1e-300; }) == Errc::negative);
  CHECK(changed([](Asked& d) { d.drag = -1e-9; }) == Errc::negative);
  CHECK(changed([](Asked& d) { d.momentum *= 1e154; }) == Errc::beyond_range);
  CHECK(changed([](Asked& d) { d.times = {-1, 1}; }) == Errc::negative);
  CHECK(changed([](Asked& d) { d.times = {1, 1}; }) == Errc::not_increasing);
  CHECK(changed([](Asked& d) { d.times = {0, 2, 1}; }) == Errc::not_increasing);
  CHECK(changed([](Asked& d) { d.times.clear(); }) == Errc::out_of_domain);
  for (const double tolerance : {0., 1., -1., 2.})
    CHECK(changed([&](Asked& d) { d.tolerance = tolerance; }) == Errc::out_of_domain);
  CHECK(changed([](Asked& d) { d.attitude = {0, 0, 0, 0}; }) == Errc::zero_vector);
}

TEST_CASE("a body that is not one never becomes a scene", "[deceleration]") {
  CHECK(Inertia<double>::from_moments(3, 1, 1).error() == Errc::triangle_inequality);
  CHECK(Inertia<double>::from_moments(1, 0, 1).error() == Errc::not_positive);
  CHECK(Inertia<double>::from_moments(1, -1, 1).error() == Errc::not_positive);
  CHECK(Inertia<double>::from_moments(1, bad_numbers[0], 1).error() == Errc::not_finite);
}

TEST_CASE("the problem in principal axes is the scene in body axes", "[deceleration]") {
  Mat3<double> J;
  J << 2, .1, -.2, .1, 1.5, .05, -.2, .05, 1.2;
  const auto body = Inertia<double>::from_tensor(J);
  REQUIRE(body);
  Asked data = good();
  const auto made = make_scene(*body, data);
  REQUIRE(made);
  const Scene& scene = *made;
  const auto& p = scene.problem();
  const Mat3<double>& R = scene.R_BP();
  CHECK((R * p.momentum - data.momentum).norm() < 1e-14);
  CHECK((R * p.rotor_momentum - data.rotor_momentum).norm() < 1e-15);
  CHECK((R * p.control * R.transpose() - Mat3<double>(data.control.asDiagonal())).norm() < 1e-14);
  CHECK((J * R * p.angular_velocity(p.momentum) + data.rotor_momentum - data.momentum).norm() < 1e-13);
  CHECK(p.inverse_inertia[0] <= p.inverse_inertia[1]);
  CHECK(p.inverse_inertia[1] <= p.inverse_inertia[2]);
  CHECK_FALSE(scene.principal_control());
  CHECK(scene.has_rotor());
  CHECK_FALSE(scene.sphere());
  CHECK(scene.greatest_control() == 3);
  CHECK(scene.least_control() == 1);
}

TEST_CASE("moments in any order make signed permutations, and the control stays diagonal", "[deceleration]") {
  V J(1.4, 1, .7);
  std::sort(J.data(), J.data() + 3);
  do {
    const auto scene = make_scene(*Inertia<double>::from_moments(J[0], J[1], J[2]), good());
    REQUIRE(scene);
    CHECK(scene->principal_control());
    CHECK((scene->R_BP().cwiseAbs() * scene->problem().inverse_inertia - J.cwiseInverse()).norm() == 0);
    CHECK((scene->R_BP() * scene->problem().momentum) == V(4, 5, 6));
  } while (std::next_permutation(J.data(), J.data() + 3));
}

TEST_CASE("kinds of scenes", "[deceleration]") {
  Asked data = good();
  data.control.setConstant(.3);
  data.rotor_momentum.setZero();
  const auto equal = make_scene(Inertia<double>(), data);
  CHECK(equal->equal_control());
  CHECK(equal->sphere());
  CHECK_FALSE(equal->has_rotor());
  data.control.setZero();
  CHECK(make_scene(Inertia<double>(), data)->equal_control());
  CHECK(small_parameter(*make_scene(Inertia<double>(), data)) ==
        Approx(.1 / V(4, 5, 6).norm()).epsilon(1e-14));  // drag alone: per radian of a unit sphere
}
