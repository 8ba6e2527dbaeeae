// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/orbit_kind.hpp"

#include "catch.hpp"
#include "gyrostat/body/inertia.hpp"

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
          const double place = std::abs(orbit_place(p, moved) - orbit_place(p, M));
          const double nearer = k2_uncertainty(p, M, at, norm, energy, place);
          CHECK(std::abs(orbit_kind(p, moved).k2 - at.k2) <= nearer * 1.01 + 1e-14);
          CHECK(nearer <= bound);
        }
    }
}

TEST_CASE("|M| and energy that err together say nothing of k2", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = V(1, 1.5, 2);
  const V M(.9, .3, .2), longer = (1 + 1e-6) * M;
  const OrbitKind at = orbit_kind(p, M);
  const double norm = longer.norm() - M.norm(), energy = p.energy(longer) - p.energy(M);
  CHECK(k2_uncertainty(p, M, at, norm, energy) > 1e-6);
  CHECK(k2_uncertainty(p, M, at, norm, energy, std::abs(orbit_place(p, longer) - orbit_place(p, M))) < 1e-13);
}

TEST_CASE("k2 of nearly equal moments, from their exact differences and with the error of rounded ones",
          "[deceleration]") {
  // A = B to 3e-11: 1/A - 1/B has lost five digits, A - B has not
  const V moments(268, 167.673442904923, 167.67344290011644), M(-3e-4, 14.2, -1.9e-4);
  Problem<double> p;
  p.inverse_inertia = moments.cwiseInverse();
  const Vec3<long double> J = moments.cast<long double>();
  const Vec3<long double> gaps((J[0] - J[1]) / J[0] / J[1], (J[1] - J[2]) / J[1] / J[2], (J[0] - J[2]) / J[0] / J[2]);
  const auto truth = polhode_through<long double>(J.cwiseInverse(), gaps, M.cast<long double>());
  const auto error = [&] { return std::abs(orbit_kind(p, M).k2 - static_cast<double>(truth.modulus.k2)); };
  const auto doubt = [&] { return k2_of_data(p, polhode_through<double>(p.inverse_inertia, p.inverse_gaps(), M), M); };
  CHECK(error() > 1e-9);
  CHECK(error() <= doubt());
  p.gaps = Inertia<double>::from_moments(moments[0], moments[1], moments[2])->inverse_gaps(), p.exact_moments = true;
  CHECK(error() <= doubt());
  CHECK(doubt() < 1e-14);
}

TEST_CASE("k2 of a nearly symmetric body, where the moments are known", "[deceleration]") {
  for (const double gap : {1e-6, 1e-9, 1e-12}) {
    const auto inertia = Inertia<double>::from_moments(168 * (1 + gap), 168, 105).value();
    Problem<double> p;
    p.inverse_inertia = inertia.inverse_principal();
    p.gaps = inertia.inverse_gaps(), p.exact_moments = true;
    p.momentum = {1e-9, -2e-9, 3};
    const Vec3<long double> moments = inertia.principal().cast<long double>(),
                            m = p.momentum.cast<long double>().cwiseAbs2();
    // k2 = mid_far tilt/(near_mid (1 - tilt)) about the axis of the smallest moment
    const long double high = (moments[1] - moments[2]) / (moments[1] * moments[2]),
                      low = (moments[0] - moments[1]) / (moments[0] * moments[1]);
    const long double k2 = low * (high * m[1] + (high + low) * m[0]) / (high * ((high + low) * m[2] + low * m[1]));
    CHECK(orbit_kind(p, p.momentum).k2 == Approx(double(k2)).epsilon(1e-14).margin(0));
    p.gaps.reset(), p.exact_moments = false;  // what the inverse moments alone tell
    CHECK(std::abs(orbit_kind(p, p.momentum).k2 / double(k2) - 1) < 4 * epsilon<double> / gap);
  }
}

TEST_CASE("a body that stays on an axis has k2 = 0, or 1 where that is unstable, whatever the rounding of its level",
          "[deceleration]") {
  Problem<double> p;
  // axis 3 is the middle one, all but equal to axis 1
  p.inverse_inertia = V(1 / 0.00035777185885536514, 1 / 0.00021759402542216941, 1 / 0.00021759402525162928);
  const V a = p.inverse_inertia;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 1; i <= 50; ++i) {
      p.rotor_momentum = 2.0078477569557876e-18 * V::Unit(axis);
      const double R = i * 2.4e-18, rate = a[axis] * (1 - p.rotor_momentum[axis] / R);
      const bool saddle = (a[(axis + 1) % 3] - rate) * (a[(axis + 2) % 3] - rate) < 0;
      const OrbitKind kind = orbit_kind(p, R * V::Unit(axis));
      CAPTURE(axis, i, kind.k2);
      CHECK(kind.regime == (saddle ? Regime::separatrix : Regime::point));
      CHECK(kind.k2 == (saddle ? 1 : 0));
    }
}
