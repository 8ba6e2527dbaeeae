// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/frame.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostats.hpp"

namespace free_frame_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::PathForm;
using gyrostat::free::Pencil;
using gyrostat::free::PrincipalProblem;
using gyrostat::free::SpinorFrame;

using Wide = DoubleDouble;

template <Real Scalar>
Pencil<Scalar> pencil_of(const Problem<double>& p) {
  const auto d = PrincipalProblem<Scalar>::of(p.template cast<Scalar>());
  return {d.inverse, d.gaps, d.G, d.l, d.M, d.M.norm()};
}

TEST_CASE("the frame of a free motion is orthogonal and its functions of the start agree", "[free]") {
  Bodies bodies(2);
  int forms[3] = {0, 0, 0};
  double frame_off = 0, circle = 0, modulus = 0;
  for (const Regime regime : regimes)
    for (int i = 0; i < 60 && regime != Regime::symmetric; ++i) {  // k2 = 0 has an infinite K'; such need no frame
      const auto pencil = pencil_of<Wide>(bodies.of(regime, i));
      const auto frame = SpinorFrame<Wide>::of(pencil);
      REQUIRE(frame);
      const auto& f = *frame;
      ++forms[int(f.form)];
      if (regime == Regime::generic || regime == Regime::equal_moments)
        for (const auto* x : {&f.xa, &f.xb}) {
          frame_off = std::max(frame_off, double(abs(pencil.S(*x, *x) - 1)));
          frame_off = std::max(frame_off, double(abs(pencil.S(*x, f.plus)) + abs(pencil.S(*x, f.minus))) /
                                              (1 + double(x->norm() * (f.plus.norm() + f.minus.norm()))));
        }
      CHECK(double(pencil.S(f.plus, f.minus)) == Approx(-2).epsilon(1e-9));
      circle = std::max(circle, double(abs(f.sn * f.sn + f.cn * f.cn - 1)));
      modulus = std::max(modulus, double(abs(f.modulus.k2 + f.modulus.kp2 - 1)));
      CHECK(f.cn >= 0);
      CHECK(f.dn > 0);
      CHECK((f.eta > 0 && f.eta_rest > 0));
      const Wide Kp = math::complete(f.modulus.complement()).K;
      CHECK(double((f.eta + f.eta_rest) / Kp) == Approx(1).epsilon(1e-12));
    }
  CHECK(frame_off < 1e-22);
  CHECK(circle < 1e-14);
  CHECK(modulus < 1e-14);
  for (const int count : forms) CHECK(count > 20);
}

TEST_CASE("the modulus of a rigid body beside the separatrix is that of its components", "[free]") {
  const Vec3<double> J(3, 2, 1);
  for (const double e : {1e-3, 1e-8, 1e-15, 1e-40, 1e-100}) {
    const auto frame =
        SpinorFrame<double>::of(pencil_of<double>(Problem<double>::from_moments(J, {0, 0, 0}, {0, 1, e})));
    REQUIRE(frame);
    CHECK(frame->form == PathForm::separatrix);
    CHECK(frame->side == -1);
    CHECK(frame->exact);
    // kp2 = (a3 - a1) (a3 - a2) n3^2/((a2 - a1) ...), M = (0, 2, e)
    const double a[3] = {1. / 3, .5, 1}, n2 = 2, n3 = e;
    const double kp2 =
        (a[2] - a[0]) * (a[2] - a[1]) * n3 * n3 / ((a[2] - a[1]) * ((a[2] - a[0]) * n3 * n3 + (a[1] - a[0]) * n2 * n2));
    CHECK(frame->modulus.kp2 == Approx(kp2).epsilon(1e-14));
  }
}

TEST_CASE("on the separatrix itself the second modulus is zero and nothing else is lost", "[free]") {
  // inverse moments 2, 3, 4 twelfths, M1 = M3
  const auto frame =
      SpinorFrame<double>::of(pencil_of<double>(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {1, 1, 2})));
  REQUIRE(frame);
  CHECK(frame->modulus.kp2 == 0);
  CHECK(frame->rate > 0);
}

}  // namespace free_frame_test
