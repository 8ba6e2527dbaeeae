// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/frame_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "gyrostats.hpp"

namespace frame_lanes_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::PathForm;
using gyrostat::free::Pencil;
using gyrostat::free::PrincipalProblem;
using gyrostat::free::SpinorFrame;
using gyrostat::free::Vec4;
using gyrostat::free::detail::FrameLanes;
using gyrostat::free::detail::Many4;
using gyrostat::free::detail::ManyBodies;
using gyrostat::free::detail::PencilLanes;
using gyrostat::free::detail::PlaneLanes;
using math::Many;

constexpr int size = Many::size;

struct Group {
  PrincipalProblem<double> body[size];
  ManyBodies many;

  Group(Bodies& bodies, Regime regime, int from) {
    double rows[4][3][size];
    for (int b = 0; b < size; ++b) {
      body[b] = PrincipalProblem<double>::of(bodies.of(regime, from + b));
      for (int i = 0; i < 3; ++i) {
        rows[0][i][b] = body[b].moments[i], rows[1][i][b] = body[b].l[i];
        rows[2][i][b] = body[b].G[i], rows[3][i][b] = body[b].M[i];
      }
    }
    for (int i = 0; i < 3; ++i) {
      many.moments[i] = Many::from(rows[0][i]), many.l[i] = Many::from(rows[1][i]);
      many.G[i] = Many::from(rows[2][i]), many.M[i] = Many::from(rows[3][i]);
    }
  }
};

Vec4<double> lane(const Many4& x, int b) { return {x.x[0][b], x.x[1][b], x.x[2][b], x.x[3][b]}; }

TEST_CASE("the frames of free bodies side by side are orthogonal", "[free]") {
  Bodies bodies(51);
  int sound = 0, asked = 0;
  for (const Regime regime : {Regime::generic, Regime::little_momentum, Regime::much_momentum})
    for (int i = 0; i < 400; i += size) {
      const Group group(bodies, regime, i);
      const PencilLanes pencil(group.many);
      const FrameLanes frame(pencil);
      for (int b = 0; b < size; ++b) {
        ++asked;
        if (!(frame.sound.bits() >> b & 1)) continue;
        ++sound;
        CAPTURE(free_bodies::name(regime), i, b);
        // |x|^2 - x4^2 in the coordinates of M/R
        const auto S = [&](const Many4& first, const Many4& second) {
          Vec4<double> x = lane(first, b), y = lane(second, b);
          for (int k = 0; k < 3; ++k) x[k] += pencil.d[k][b] * x[3], y[k] += pencil.d[k][b] * y[3];
          const double terms = x.norm() * y.norm();
          return (x.head<3>().dot(y.head<3>()) - x[3] * y[3]) / (1 + terms);
        };
        CHECK(std::abs(S(frame.plus, frame.plus)) < 1e-11);
        CHECK(std::abs(S(frame.minus, frame.minus)) < 1e-11);
        CHECK(std::abs(S(frame.plus, frame.xa)) < 1e-11);
        CHECK(std::abs(S(frame.minus, frame.xb)) < 1e-11);
        CHECK(std::abs(S(frame.xa, frame.xb)) < 1e-11);
        CHECK(frame.k2[b] + frame.kp2[b] == Approx(1).epsilon(1e-11));
      }
    }
  CHECK(sound > 3 * asked / 4);
}

TEST_CASE("side by side and one by one a free body has the same frame", "[free]") {
  Bodies bodies(52);
  int compared = 0;
  for (const Regime regime : {Regime::generic, Regime::close_moments, Regime::total_near_zero})
    for (int i = 0; i < 400; i += size) {
      const Group group(bodies, regime, i);
      const FrameLanes frame{PencilLanes(group.many)};
      const Many &eta = frame.integrals.Fp, rest = frame.integrals.Kp - eta;
      for (int b = 0; b < size; ++b) {
        const auto& p = group.body[b];
        const auto alone = SpinorFrame<double>::of(Pencil<double>(p.inverse, p.gaps, p.G, p.l, p.M, p.M.norm()));
        REQUIRE(alone);
        if (!(frame.sound.bits() >> b & 1)) continue;
        ++compared;
        CAPTURE(free_bodies::name(regime), i, b);
        const bool single = frame.single.bits() >> b & 1;
        CHECK(single == (alone->form == PathForm::single));
        if (!single) CHECK(frame.side[b] == alone->side);
        CHECK(frame.delta[b] == alone->delta);
        CHECK(frame.k2[b] == Approx(alone->modulus.k2).margin(1e-10));
        CHECK(frame.rate[b] == Approx(alone->rate).epsilon(1e-10));
        CHECK(eta[b] == Approx(alone->eta).epsilon(1e-7));
        CHECK(rest[b] == Approx(alone->eta_rest).epsilon(1e-7));
      }
    }
  CHECK(compared > 600);
}

}  // namespace frame_lanes_test
