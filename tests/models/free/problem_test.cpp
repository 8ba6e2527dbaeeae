// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/problem.hpp"

#include <cmath>

#include "catch.hpp"

namespace free_problem_test {

using namespace gyrostat;
using gyrostat::free::PrincipalProblem;
using gyrostat::free::Problem;
using V = Vec3<double>;

TEST_CASE("a free problem that is not physical is refused with its reason", "[free]") {
  auto p = Problem<double>::from_moments({3, 2, 1.5}, {.1, .2, .3}, {1, 2, 3});
  CHECK(p.check() == Errc::ok);
  auto q = p;
  q.inertia(0, 1) = .1;
  CHECK(q.check() == Errc::not_symmetric);
  q = p;
  q.inertia(0, 0) = 4;
  CHECK(q.check() == Errc::triangle_inequality);
  q = p;
  q.inertia(2, 2) = -1;
  CHECK(q.check() == Errc::not_positive);
  for (double* x : {&q.rotor_momentum[1], &q.angular_velocity[2], &q.attitude.y, &q.inertia(1, 1)}) {
    q = p;
    *x = std::nan("");
    CHECK(q.check() == Errc::not_finite);
  }
  q = p;
  q.attitude.w = 1.1;
  CHECK(q.check() == Errc::out_of_domain);
  q = p;
  q.angular_velocity[0] = std::nan("");
  q.momentum_given = true;
  CHECK(q.check() == Errc::ok);
}

TEST_CASE("principal axes of a free problem give the tensor and the momentum back", "[free]") {
  Problem<double> p;
  p.inertia << 5, .2, -.1, .2, 4, .3, -.1, .3, 3;
  p.rotor_momentum = {.3, -.2, .5};
  p.angular_velocity = {.3, -.5, .8};
  const auto d = PrincipalProblem<double>::of(p);
  CHECK((d.R_BP * d.moments.asDiagonal() * d.R_BP.transpose() - p.inertia).norm() < 1e-14);
  CHECK((d.R_BP * d.M - (p.inertia * p.angular_velocity + p.rotor_momentum)).norm() < 1e-14);
  CHECK(d.R_BP.determinant() == Approx(1));
  auto given = p;
  given.angular_momentum = p.inertia * p.angular_velocity + p.rotor_momentum;
  CHECK(p.momentum() == given.angular_momentum);
  given.momentum_given = true;
  CHECK(given.momentum() == given.angular_momentum);
  CHECK((d.R_BP * PrincipalProblem<double>::of(given).omega - p.angular_velocity).norm() < 1e-14);
  const auto wide = PrincipalProblem<DoubleDouble>::of(p.cast<DoubleDouble>());
  CHECK((vector_cast<double>(wide.moments) - d.moments).norm() < 1e-14);
}

TEST_CASE("axes of equal moments are turned to the rotor momentum, and gaps keep the digits of the moments", "[free]") {
  const auto equal = PrincipalProblem<double>::of(Problem<double>::from_moments({3, 3, 2}, {3, 4, 1}, {1, 2, 3}));
  CHECK(equal.gaps(0, 1) == 0);
  CHECK(equal.l[0] == Approx(5));
  CHECK(equal.l[1] == 0);
  CHECK((equal.R_BP * equal.l - V(3, 4, 1)).norm() < 1e-15);
  CHECK_FALSE(equal.spherical());
  const auto close =
      PrincipalProblem<double>::of(Problem<double>::from_moments({3, 3 * (1 - 0x1p-40), 2}, {3, 4, 1}, {1, 2, 3}));
  CHECK(close.gaps(0, 1) == Approx(0x1p-40 / 3).epsilon(1e-11));
  CHECK(PrincipalProblem<double>::of(Problem<double>::from_moments({3, 3, 3}, {3, 4, 1}, {1, 2, 3})).spherical());
}

TEST_CASE("beside known principal axes those of a neighbour are found at once", "[free]") {
  auto p = Problem<double>::from_moments({3, 2, 1.5}, {.1, .2, .3}, {1, 2, 3});
  p.inertia(0, 1) = p.inertia(1, 0) = .2;
  p.inertia(1, 2) = p.inertia(2, 1) = -.1;
  const Mat3<double> axes = PrincipalProblem<double>::of(p).R_BP;
  for (const double by : {0., 0x1p-50, 1e-9}) {
    auto near = p;
    near.inertia(0, 2) = near.inertia(2, 0) = by;
    near.inertia(1, 1) *= 1 + by;
    const auto d = PrincipalProblem<double>::beside(near, axes);
    const auto truth = PrincipalProblem<DoubleDouble>::of(near.cast<DoubleDouble>());
    const double most = 4e-15 + 100 * by * by;
    CAPTURE(by);
    CHECK((matrix_cast<double>(truth.R_BP) - d.R_BP).norm() < most);
    CHECK((vector_cast<double>(truth.moments) - d.moments).norm() < most);
    CHECK((vector_cast<double>(truth.M) - d.M).norm() < 8 * most);
    CHECK((vector_cast<double>(truth.l) - d.l).norm() < most);
    CHECK((vector_cast<double>(truth.omega) - d.omega).norm() < 8 * most);
    CHECK(d.gaps(0, 1) == Approx(double(truth.gaps(0, 1))));
  }
}

TEST_CASE("a start is steady only where every component of omega x M is rounding", "[free]") {
  const auto at = [](const V& l, const V& w) {
    const auto p = PrincipalProblem<double>::of(Problem<double>::from_moments({4, 3, 2}, l, w));
    return p.steady(p.M.norm());
  };
  CHECK(at({0, 0, 0}, {0, 1, 0}));
  CHECK(at({1, 3, 1}, {.5, 1, .25}));
  CHECK(at({1, 3, 1}, {0, 0, 0}));
  CHECK_FALSE(at({0, 0, 0}, {0, 1, 1e-300}));
  CHECK_FALSE(at({1, 3, 1}, {.5, 1, .2500001}));
}

}  // namespace free_problem_test
