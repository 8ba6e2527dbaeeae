// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/hanging.hpp"

#include "catch.hpp"

#include "gyrostat/models/heavy/full.hpp"
#include "models/heavy/bodies.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

double potential(const Problem<double>& p, const Vec3<double>& d) {
  State<double> s;
  s.down = d;
  return p.energy(s);
}

}  // namespace

TEST_CASE("heavy hanging: rest, of the least energy", "[heavy]") {
  Tops random(31);
  for (int i = 0; i < 60; ++i) {
    const auto p = random.body(i % 3 == 0 ? 0.05 : 1, i % 2 == 0 ? 0 : 2);
    const auto h = hanging(p);
    REQUIRE(h);
    CHECK(std::abs(h->down.norm() - 1) < 1e-15);
    CHECK(p.torque({0, 0, 0}, h->down).norm() < 1e-14 * (p.moment().norm() + p.gradient()));
    const double least = potential(p, h->down);
    for (int j = 0; j < 40; ++j) CHECK(potential(p, random.direction()) >= least);
  }
}

TEST_CASE("heavy hanging: the swings are modes of the linear equations", "[heavy]") {
  Tops random(32);
  for (int i = 0; i < 40; ++i) {
    const auto p = random.body(1, i % 2 == 0 ? 0 : 2);
    const auto h = hanging(p);
    REQUIRE(h);
    CHECK(h->frequency[0] <= h->frequency[1]);
    const auto J = state_jacobian<double>(p, {0, 0, 0}, h->down);
    for (int k : {0, 1}) {
      const auto swing = h->swing[std::size_t(k)];
      const double square = h->frequency[std::size_t(k)] * h->frequency[std::size_t(k)];
      CHECK(std::abs(swing.dot(h->down)) < 1e-14);
      // d'' = J_dw J_wd d = -omega^2 d
      const Vec3<double> second = J.bottomLeftCorner<3, 3>() * (J.topRightCorner<3, 3>() * swing);
      CHECK((second + square * swing).norm() < 1e-13 * (1 + square));
    }
  }
}

TEST_CASE("heavy hanging: a body from the literature", "[heavy]") {
  const auto h = hanging(unit_body(.55, .8, {.6, .48, .64}, .7));
  REQUIRE(h);
  CHECK(h->frequency[0] == Approx(1.0424).margin(5e-5));
  CHECK(h->frequency[1] == Approx(1.2868).margin(5e-5));
}

TEST_CASE("heavy hanging: limits", "[heavy]") {
  // a compound pendulum
  const auto flat = hanging(unit_body(.55, .8, {1, 0, 0}, 0.));
  REQUIRE(flat);
  CHECK((flat->down - Vec3<double>(1, 0, 0)).norm() == 0);
  CHECK(flat->frequency[0] == Approx(1).epsilon(1e-15));
  CHECK(flat->frequency[1] == Approx(std::sqrt(1 / .8)).epsilon(1e-15));
  // the gradient alone: down along the axis of least inertia
  const auto free = hanging(unit_body(.55, .8, {0, 0, 0}, .7));
  REQUIRE(free);
  CHECK((free->down - Vec3<double>(1, 0, 0)).norm() == 0);
  CHECK(free->frequency[0] == Approx(std::sqrt(.7 * .25 / 1)).epsilon(1e-14));
  CHECK(free->frequency[1] == Approx(std::sqrt(.7 * .45 / .8)).epsilon(1e-14));
  // weight across the soft axis, and a gradient too strong for it
  const auto bent = hanging(unit_body(.55, .8, {0, 0, 1}, 4.));
  REQUIRE(bent);
  CHECK(bent->down[2] == Approx(1 / (4 * .45)).epsilon(1e-14));
  CHECK(bent->down[0] > 0);
  CHECK(hanging(unit_body(.55, .8, {0, 0, 0}, 0.)).error() == Errc::not_applicable);
  CHECK(hanging(unit_body(1., 1., {0, 0, 0}, 1.)).error() == Errc::not_applicable);
}
