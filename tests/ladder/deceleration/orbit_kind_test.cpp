// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/orbit_kind.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

TEST_CASE("kind of the free orbit through M", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = V(1, 1.5, 2);
  CHECK(orbit_kind(p, V(0, 0, 0)).regime == Regime::rest);
  CHECK(orbit_kind(p, V(1, .1, .1)).regime == Regime::about_largest);
  CHECK(orbit_kind(p, V(.1, .1, 1)).regime == Regime::about_smallest);
  CHECK(orbit_kind(p, V(.5, .3, .5)).regime == Regime::separatrix);
  CHECK(orbit_kind(p, V(.5, .3, .5)).k2 == 1);
  p.inverse_inertia = V(1, 1, 1);
  CHECK(orbit_kind(p, V(1, 2, 3)).regime == Regime::point);
  p.inverse_inertia = V(1, 1.5, 2);
  const OrbitKind bare = orbit_kind(p, V(.9, .3, .2));
  p.rotor_momentum = V(1e-9, 2e-9, -1e-9);
  const OrbitKind with = orbit_kind(p, V(.9, .3, .2));
  CHECK(with.regime == bare.regime);
  CHECK(with.k2 == Approx(bare.k2).epsilon(1e-7));
  p.rotor_momentum = V(3, 2, 1);
  CHECK(orbit_kind(p, V(.9, .3, .2)).regime == Regime::one_component);
}

TEST_CASE("uncertainty of k2 covers what an error of M does to it", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = V(1, 1.5, 2);
  for (const V& l : {V(0, 0, 0), V(.2, .1, .15)})
    for (const V& M : {V(.9, .3, .2), V(.2, .4, .8), V(1, .01, .02)}) {
      p.rotor_momentum = l;
      CAPTURE(l.transpose(), M.transpose());
      const OrbitKind at = orbit_kind(p, M);
      for (const double d : {1e-6, 1e-9})
        for (const V& off : {V(1, 0, 0), V(0, -1, 0), V(0, 0, 1)}) {
          const V moved = M + d * off;
          const double norm = std::abs(moved.norm() - M.norm()), energy = std::abs(p.energy(moved) - p.energy(M));
          const double bound = k2_uncertainty(p, M, at, norm, energy);
          CHECK(std::abs(orbit_kind(p, moved).k2 - at.k2) <= bound * 1.01 + 1e-14);
        }
    }
}
