// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/gyrostat.hpp"

#include "bodies.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

const Mat3<double> inertia = Vec3<double>(3, 5, 7).asDiagonal();
const Vec3<double> slanted(0.5, 0.5, std::sqrt(0.5));

Errc failure(const Mat3<double>& theta, const Vec3<double>& e, double lambda, double slope, double rate) {
  return Gyrostat<double>::make(theta, e, lambda, slope, rate).error();
}

}  // namespace

TEST_CASE("what is no gyrostat is refused with its reason", "[rotor]") {
  CHECK(failure(inertia, slanted, 2, 4, 1) == Errc::ok);
  CHECK(failure(inertia, slanted, 2, 0, 1) == Errc::ok);
  CHECK(failure(inertia, slanted, 2, -1e-300, 1) == Errc::negative);
  CHECK(failure(inertia, slanted, 0, 4, 1) == Errc::not_positive);
  CHECK(failure(inertia, slanted, -1, 4, 1) == Errc::not_positive);
  CHECK(failure(inertia, Vec3<double>(0, 0, 0), 2, 4, 1) == Errc::zero_vector);
  CHECK(failure(inertia, slanted * (1 + 1e-7), 2, 4, 1) == Errc::out_of_domain);
  CHECK(failure(inertia, slanted * (1 + 1e-9), 2, 4, 1) == Errc::ok);
  Mat3<double> theta = inertia;
  theta(0, 1) = 1e-3;
  CHECK(failure(theta, slanted, 2, 4, 1) == Errc::not_symmetric);
  theta = Vec3<double>(3, 5, -7).asDiagonal();
  CHECK(failure(theta, slanted, 2, 4, 1) == Errc::not_positive);
  theta = Vec3<double>(3, 5, 0).asDiagonal();
  CHECK(failure(theta, slanted, 2, 4, 1) == Errc::not_positive);
  for (const double bad : {gyrostat::nan<double>, infinity<double>, -infinity<double>}) {
    CHECK(failure(inertia, Vec3<double>(bad, 0, 1), 2, 4, 1) == Errc::not_finite);
    CHECK(failure(inertia, slanted, bad, 4, 1) == Errc::not_finite);
    CHECK(failure(inertia, slanted, 2, bad, 1) == Errc::not_finite);
    CHECK(failure(inertia, slanted, 2, 4, bad) == Errc::not_finite);
    theta = inertia;
    theta(2, 2) = bad;
    CHECK(failure(theta, slanted, 2, 4, 1) == Errc::not_finite);
  }
}

TEST_CASE("the greatest axial inertia is 1/(e.J e), far below e.theta e", "[rotor]") {
  Mat3<double> theta;
  theta << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  const Vec3<double> e = Vec3<double>(0.75, 0.35, 0.56).normalized();
  const double most = 1 / e.dot(theta.inverse() * e);
  CHECK(failure(theta, e, most * (1 - 1e-9), 1, 1) == Errc::ok);
  CHECK(failure(theta, e, most * (1 + 1e-9), 1, 1) == Errc::triangle_inequality);
  CHECK(most < 3.75);
  CHECK(e.dot(theta * e) > 3.75);
  CHECK(failure(theta, e, 3.75, 1, 1) == Errc::triangle_inequality);
}

TEST_CASE("k by the free-wheel inertia is 1 - lambda e.J e without its cancellation", "[rotor]") {
  Bodies bodies(1);
  for (int i = 0; i < 100; ++i) {
    const auto body = bodies.realisable();
    const Vec3<double>& e = body.axis();
    CHECK(body.coupling() == Approx(1 - body.axial_inertia() * e.dot(body.inverse_inertia() * e)).epsilon(1e-12));
    CHECK((body.coupling() > 0 && body.coupling() < 1));
    const Mat3<double> R = body.inertia() - body.axial_inertia() * e * e.transpose();
    CHECK((body.free_inverse() * R - Mat3<double>::Identity()).norm() < 1e-13);
    CHECK(body.free_principal().prod() / body.principal().prod() == Approx(body.coupling()).epsilon(1e-12));
    CHECK(body.realisable());
  }
}

TEST_CASE("the printed example is not realisable; its greatest rotor has an axial inertia of 1.7238", "[rotor]") {
  const auto least = [](double lambda) {
    return Gyrostat<double>::make(inertia, slanted, lambda, 4, 0)->realisability();
  };
  CHECK(least(2) == Approx(-0.092366).epsilon(1e-4));
  CHECK(least(1.7237) > 0);
  CHECK(least(1.7239) < 0);
}

TEST_CASE("state, rates and the two forms of V agree", "[rotor]") {
  Bodies bodies(2);
  for (int i = 0; i < 100; ++i) {
    const auto body = bodies.realisable();
    const Vec3<double> Omega = bodies.direction() * bodies.scale(0.1, 10);
    const double omega = bodies.uniform(-20, 20), lambda = body.axial_inertia();
    const State<double> s = body.state(bodies.attitude(), Omega, omega);
    const Vec3<double> back = body.angular_velocity(s.momentum, s.axial_momentum);
    CHECK((back - Omega).norm() < 1e-13 * (Omega.norm() + std::abs(omega)));
    CHECK(body.rotor_rate(s.axial_momentum, back) == Approx(omega).margin(1e-12));
    const double T =
        Omega.dot(body.inertia() * Omega) / 2 + lambda * omega * Omega.dot(body.axis()) + lambda * omega * omega / 2;
    CHECK(body.energy(s.momentum, s.axial_momentum) == Approx(T).epsilon(1e-12));
    const double rate = body.no_load_rate();
    CHECK(body.lyapunov(s.momentum, s.axial_momentum) ==
          Approx(T - rate * s.axial_momentum + lambda * rate * rate / 2).epsilon(1e-11));
  }
}

TEST_CASE("parts of H that cancel to rounding leave no momentum", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  const Vec3<double> Omega = -body.axial_inertia() * 7.3 * (body.inverse_inertia() * body.axis());
  CHECK(body.state({}, Omega, 7.3).momentum.isZero(0));
  CHECK_FALSE(body.state({}, Omega * (1 + 1e-12), 7.3).momentum.isZero(0));
}

TEST_CASE("rotating the body axes changes no scalar", "[rotor]") {
  Bodies bodies(3);
  for (int i = 0; i < 20; ++i) {
    const auto body = bodies.realisable();
    const Mat3<double> R = to_matrix(bodies.attitude());
    Mat3<double> theta = R * body.inertia() * R.transpose();
    theta = ((theta + theta.transpose()) / 2).eval();
    const auto turned = Gyrostat<double>::make(theta, (R * body.axis()).normalized(), body.axial_inertia(),
                                               body.slope(), body.no_load_rate());
    REQUIRE(turned);
    CHECK(turned->coupling() == Approx(body.coupling()).epsilon(1e-13));
    CHECK(turned->realisability() == Approx(body.realisability()).margin(1e-12));
    const Vec3<double> H = bodies.direction() * 3;
    CHECK(turned->lyapunov(R * H, 0.7) == Approx(body.lyapunov(H, 0.7)).epsilon(1e-12));
  }
}

TEMPLATE_TEST_CASE("every scalar type works", "[rotor]", float, double, long double) {
  const auto body = Gyrostat<TestType>::make(inertia.cast<TestType>(), slanted.cast<TestType>(), 2, 4, 1);
  REQUIRE(body);
  CHECK(double(body->coupling()) == Approx(0.59047619).epsilon(1e-6));
  CHECK(double(body->relaxation_rate()) == Approx(4 / 2 / 0.59047619).epsilon(1e-6));
}
