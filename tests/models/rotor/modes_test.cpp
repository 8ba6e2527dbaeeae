// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/modes.hpp"

#include "bodies.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using V = Vec3<double>;
using M = Mat3<double>;

M random_matrix(Bodies& bodies) {
  M A;
  A << bodies.direction(), bodies.direction(), bodies.direction();
  return A;
}

/// exp(A t) by its power series after halving.
M exponential(const Mat3<long double>& A) {
  Mat3<long double> sum = Mat3<long double>::Identity(), term = sum;
  const Mat3<long double> small = A / 1024.0L;
  for (int k = 1; k < 24; ++k) {
    term = Mat3<long double>(term * small) / static_cast<long double>(k);
    sum += term;
  }
  for (int i = 0; i < 10; ++i) sum = Mat3<long double>(sum * sum);
  return sum.cast<double>();
}

}  // namespace

TEST_CASE("modes solve the linear equations and their integral", "[rotor]") {
  Bodies bodies(1);
  for (int i = 0; i < 300; ++i) {
    const M A = random_matrix(bodies);
    const V y0 = bodies.direction();
    const Modes<double> modes(A);
    const double t = bodies.scale(1e-3, 4), slack = 1e-14 * modes.condition();
    const M grown = exponential(A.cast<long double>() * static_cast<long double>(t));
    CHECK((modes.at(t, y0) - grown * y0).norm() < slack * (1 + grown.norm()));
    CHECK((A * modes.integral(t, y0) - (grown * y0 - y0)).norm() < slack * (1 + grown.norm()));
  }
}

TEST_CASE("modes near a double exponent lose what condition() says", "[rotor]") {
  Bodies bodies(2);
  for (const double gap : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const M T = random_matrix(bodies);
    M A;
    A << -1, 1, 0, -gap * gap, -1, 0, 0, 0, -2;
    A = M(T * A * T.inverse());
    const V y0 = bodies.direction();
    const Modes<double> modes(A);
    const V truth = exponential(A.cast<long double>() * 1.5L) * y0;
    CHECK((modes.at(1.5, y0) - truth).norm() < 1e-14 * modes.condition() * (1 + T.norm() * T.inverse().norm()));
    CHECK(modes.condition() > 0.1 / gap);
  }
}

TEST_CASE("exponentials and their differences without cancellation", "[rotor]") {
  using C = std::complex<double>;
  using L = std::complex<long double>;
  Bodies bodies(3);
  for (int i = 0; i < 300; ++i) {
    const C a(-bodies.scale(1e-9, 10), bodies.uniform(-5, 5));
    const C b = a + C(bodies.uniform(-1, 1), bodies.uniform(-1, 1)) * bodies.scale(1e-15, 1);
    const double t = bodies.scale(1e-6, 3);
    // by the integral of exp along the segment, Gauss-Legendre free: a power series in the distance
    const L la(a), lb(b);
    L sum = 0, term = 1;
    for (int k = 1; k < 60; ++k) {
      sum += term / static_cast<long double>(k);
      term *= (lb - la) * static_cast<long double>(t) / static_cast<long double>(k);
    }
    const L truth = std::exp(la * static_cast<long double>(t)) * sum * static_cast<long double>(t);
    CHECK(std::abs(L(detail::exp_difference(a, b, t)) - truth) < 4e-15L * std::abs(truth) * (1 + 6.0L * t));
  }
  CHECK(detail::integral_of_exp(C(0), 3.) == C(3));
  CHECK(std::abs(detail::integral_of_exp(C(-1e300), 1.)) == Approx(1e-300));
}

TEST_CASE("the linearisation is the derivative of the equations of motion", "[rotor]") {
  Bodies bodies(4);
  for (int i = 0; i < 100; ++i) {
    const auto body = bodies.realisable();
    const V m = bodies.direction();
    const double l = bodies.scale(0.1, 10), omega = bodies.uniform(-5, 5);
    const Linearisation<double> linear(body, l, m, omega);
    CHECK(std::abs(linear.u.cross(linear.v).dot(m) - 1) < 1e-14);
    // exact identities at any distance: Omega, dm/dt, dxi/dt
    const V d = 0.3 * bodies.direction();
    const double xi = bodies.uniform(-1, 1);
    const double rate = omega + linear.excess(d, xi);
    const V Omega = body.inverse_inertia() * (l * (m + d) - body.axial_inertia() * rate * body.axis());
    const V steady = body.inverse_inertia() * (l * m - body.axial_inertia() * omega * body.axis());
    const double size = Omega.norm() + steady.norm();
    CHECK((Omega - (steady + linear.spin_rate * d + linear.tilt_rate(d, xi))).norm() < 1e-13 * size);
    const double dp = -body.slope() * (rate - omega);
    const double dxi = linear.feed * linear.n.dot(d) - linear.relaxation * xi;
    CHECK(std::abs(dxi - dp / (body.axial_inertia() * body.coupling() * linear.unit)) < 1e-12 * linear.relaxation);
  }
}
