// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/modes.hpp"

#include <complex>

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

/// A = T block T^-1 with the exponents r + i w, r - i w and a.
struct Made {
  M A;
  std::array<math::Complex<double>, 3> exponents;
  double spread;

  Made(Bodies& bodies, double r, double w, double a) {
    const M T = random_matrix(bodies);
    M block;
    block << r, w, 0, -w, r, 0, 0, 0, a;
    A = M(T * block * T.inverse());
    exponents = {{{r, w}, {r, -w}, {a, 0}}};
    spread = T.norm() * T.inverse().norm();
  }
};

TEST_CASE("modes solve the linear equations and their integral", "[rotor]") {
  Bodies bodies(1);
  for (int i = 0; i < 300; ++i) {
    const Made made(bodies, bodies.uniform(-1, 0.3), bodies.uniform(0.2, 2), bodies.uniform(-2, 0.3));
    const V y0 = bodies.direction();
    const Modes<double> modes(made.A, made.exponents);
    const double t = bodies.scale(1e-3, 4), slack = 4e-15 * modes.condition() * made.spread * made.spread;
    const M grown = exponential(made.A.cast<long double>() * static_cast<long double>(t));
    CHECK((modes.at(t, y0) - grown * y0).norm() < slack * (1 + grown.norm()));
    CHECK((made.A * modes.integral(t, y0) - (grown * y0 - y0)).norm() < slack * (1 + grown.norm()));
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) {
        const auto product = rotor::detail::complex_dot<double>(modes.left[k], modes.right[j]);
        CHECK(math::magnitude(product - math::Complex<double>{k == j ? 1. : 0.}) < 1e-14 * modes.condition());
      }
    CHECK(modes.growth_rate() == std::max(made.exponents[0].re, made.exponents[2].re));
  }
}

TEST_CASE("modes near a double exponent lose what condition() says", "[rotor]") {
  Bodies bodies(2);
  for (const double gap : {1e-2, 1e-4, 1e-6}) {
    M A;
    A << -1, 1, 0, -gap * gap, -1, 0, 0, 0, -2;
    const V y0 = bodies.direction();
    const Modes<double> modes(A, {{{-1, gap}, {-1, -gap}, {-2, 0}}});
    const V truth = exponential(A.cast<long double>() * 1.5L) * y0;
    CHECK((modes.at(1.5, y0) - truth).norm() < 1e-14 * modes.condition());
    CHECK(modes.condition() > 0.1 / gap);
  }
}

TEST_CASE("exponentials and their differences without cancellation", "[rotor]") {
  using C = math::Complex<double>;
  using L = std::complex<long double>;
  using rotor::detail::exp_difference, rotor::detail::integral_of_exp;
  Bodies bodies(3);
  for (int i = 0; i < 300; ++i) {
    const C a{-bodies.scale(1e-9, 10), bodies.uniform(-5, 5)};
    const C b = a + bodies.scale(1e-15, 1) * C{bodies.uniform(-1, 1), bodies.uniform(-1, 1)};
    const double t = bodies.scale(1e-6, 3);
    // by the integral of exp along the segment, Gauss-Legendre free: a power series in the distance
    const L la(a.re, a.im), lb(b.re, b.im);
    L sum = 0, term = 1;
    for (int k = 1; k < 60; ++k) {
      sum += term / static_cast<long double>(k);
      term *= (lb - la) * static_cast<long double>(t) / static_cast<long double>(k);
    }
    const L truth = std::exp(la * static_cast<long double>(t)) * sum * static_cast<long double>(t);
    const C found = exp_difference(a, b, t);
    CHECK(std::abs(L(found.re, found.im) - truth) < 4e-15L * std::abs(truth) * (1 + 6.0L * t));
  }
  CHECK(integral_of_exp(C{}, 3.) == C{3});
  CHECK(math::magnitude(integral_of_exp(C{-1e300}, 1.)) == Approx(1e-300));
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

TEST_CASE("the exponents of the linearisation are those of its matrix", "[rotor]") {
  Bodies bodies(5);
  for (int i = 0; i < 100; ++i) {
    const auto body = bodies.realisable();
    const double l = bodies.scale(0.5, 10);
    for (const auto& steady : steady_rotations(body, l)) {
      const Linearisation<double> linear(body, l, steady.direction, body.no_load_rate());
      const auto d = linear.exponents();
      const auto known = stability_of(body, l, steady).eigenvalues;
      const M& A = linear.matrix;
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(std::complex<double>(d[k].re, d[k].im) - known[k]) < 1e-7 * A.norm());
        // det(A - d) = 0
        using C = std::complex<double>;
        const C z(d[k].re, d[k].im);
        Eigen::Matrix<C, 3, 3> rest = A.cast<C>();
        for (int j = 0; j < 3; ++j) rest(j, j) -= z;
        CHECK(std::abs(rest.determinant()) < 1e-13 * std::pow(A.norm(), 3));
      }
    }
  }
}
