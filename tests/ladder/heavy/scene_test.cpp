// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/scene.hpp"

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

const Vec3<double> body_moments{1, 1.5, 2}, centre{0.01, -0.02, 0.015};

Body body_of(const Mat3<double>& inertia, const Vec3<double>& offset = centre) {
  const auto made = Body::make(inertia, 1, offset, 98, 0.3);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("a heavy body keeps the caller's axes where they are principal", "[heavy]") {
  for (const Vec3<double>& order : {Vec3<double>(1, 1.5, 2), Vec3<double>(2, 1, 1.5), Vec3<double>(1.5, 2, 1)}) {
    const Body b = body_of(order.asDiagonal());
    CHECK(b.R_BP == Mat3<double>::Identity());
    CHECK(b.problem.inertia() == order);
    CHECK(b.problem.centre_of_mass() == centre);
  }
}

TEST_CASE("a heavy body with a full tensor takes the principal axes nearest to its own", "[heavy]") {
  const Mat3<double> R = to_matrix(quaternion_from_vector<double>({0.2, -0.3, 0.1}));
  for (const Vec3<double>& order : {Vec3<double>(1, 1.5, 2), Vec3<double>(2, 1, 1.5), Vec3<double>(1.5, 1, 2)}) {
    const Body b = body_of(R * order.asDiagonal() * R.transpose(), R * centre);
    CHECK((b.problem.inertia() - order).norm() < 1e-14);
    CHECK((b.R_BP - R).norm() < 1e-14);
    CHECK((b.problem.centre_of_mass() - centre).norm() < 1e-16);
    CHECK(b.R_BP.determinant() == Approx(1));
  }
}

TEST_CASE("heavy bodies that are none", "[heavy]") {
  Mat3<double> J = body_moments.asDiagonal();
  const auto error = [&](const Mat3<double>& inertia, double mass = 1) {
    return Body::make(inertia, mass, centre, 98, 0.3).error();
  };
  CHECK(error(J) == Errc::ok);
  J(0, 1) = 0.1;
  CHECK(error(J) == Errc::not_symmetric);
  J(1, 0) = gyrostat::nan<double>;
  CHECK(error(J) == Errc::not_finite);
  CHECK(error(Vec3<double>(1, 1, 3).asDiagonal()) == Errc::triangle_inequality);
  CHECK(error(body_moments.asDiagonal(), 0) == Errc::not_positive);
}

TEST_CASE("a heavy scene checks what it is given", "[heavy]") {
  const Body b = body_of(body_moments.asDiagonal());
  Question question;
  question.times = {0, 1};
  State<double> start;
  std::optional<Periodic> asked;
  const auto failure = [&] { return Scene::make(b, {start, asked}, question).error(); };
  CHECK(failure() == Errc::ok);
  start.angular_velocity[1] = gyrostat::nan<double>;
  CHECK(failure() == Errc::not_finite);
  start = {};
  start.down = {0, 0, 1.001};
  CHECK(failure() == Errc::out_of_domain);
  start.down = {0, 0, 0};
  CHECK(failure() == Errc::out_of_domain);
  question.wants_attitude = true;  // down is then the attitude's
  CHECK(failure() == Errc::ok);
  start.attitude = {0, 0, 0, 0};
  CHECK(failure() == Errc::zero_vector);
  start.attitude.w = gyrostat::infinity<double>;
  CHECK(failure() == Errc::not_finite);
  start = {};
  for (const double cosine : {1.0, -1.0, 2.0}) {
    asked = Periodic{150, cosine};
    CHECK(failure() == Errc::out_of_domain);
  }
  asked = Periodic{gyrostat::nan<double>, 0.1};
  CHECK(failure() == Errc::not_finite);
  asked = Periodic{150, 0.1};
  CHECK(failure() == Errc::ok);
  question.times = {1, 0};
  CHECK(failure() == Errc::not_increasing);
}

TEST_CASE("a heavy scene stands in principal axes, down and attitude together", "[heavy]") {
  const Mat3<double> R = to_matrix(quaternion_from_vector<double>({0.2, -0.3, 0.1}));
  const Body b = body_of(R * body_moments.asDiagonal() * R.transpose());
  Question question;
  question.times = {0, 1};
  question.wants_attitude = true;
  State<double> start{{1, 2, 3}, {0, 0, -1}, {0.2, 1, -0.4, 2}};
  const auto scene = Scene::make(b, {start}, question);
  REQUIRE(scene);
  const auto& s = scene->start();
  CHECK(norm(s.attitude) == Approx(1));
  CHECK((s.down + to_matrix(s.attitude).row(2).transpose()).norm() < 1e-15);
  CHECK((b.R_BP * s.angular_velocity - start.angular_velocity).norm() < 1e-14);
  const auto back = in_axes(b.R_BP, s);
  CHECK((to_matrix(back.attitude) - to_matrix(normalised(start.attitude))).norm() < 1e-14);
}
