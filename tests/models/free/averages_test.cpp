// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/averages.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/models/free/reduced.hpp"
#include "gyrostats.hpp"
#include "reference_table.hpp"

namespace free_averages_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Kind;
using gyrostat::free::Motion;
using gyrostat::free::precession;
using gyrostat::free::RateIntegral;
using gyrostat::free::Reduced;
using V = Vec3<double>;
using Wide = DoubleDouble;

TEST_CASE("means of a rigid body are those of the elliptic functions", "[free]") {
  for (const V& w : {V(.4, .55, .7), V(.9, .2, .1), V(.1, .9, .05), V(1e-5, .5, 1e-6)}) {
    const auto m = *Motion<double>::make<Wide>(Problem<double>::from_moments({35, 22, 16}, {0, 0, 0}, w).cast<Wide>());
    const auto mean = gyrostat::free::averages(m);
    const double R = m.angular_momentum_norm();
    const int near = m.kind() == Kind::about_largest ? 0 : 2, far = 2 - near;
    const V M = V(35, 22, 16).cwiseProduct(w);
    // M_near = c dn, and what M_mid takes of it
    const auto f = math::means(m.modulus());
    CHECK(std::abs(mean.angular_momentum[1]) < 1e-13 * R);
    CHECK(std::abs(mean.angular_momentum[far]) < 1e-13 * R);
    const double mid_far = near == 0 ? 1. / 16 - 1. / 22 : 1. / 22 - 1. / 35, near_far = 1. / 16 - 1. / 35;
    const double c2 = M[near] * M[near] + mid_far / near_far * M[1] * M[1];
    CHECK(mean.second_moment(near, near) == Approx(c2 * f.F).epsilon(1e-11));
    CHECK(mean.angular_momentum[near] ==
          Approx(std::copysign(pi<double> / 2 / m.quarter_period() * std::sqrt(c2), M[near])).epsilon(1e-11));
    CHECK(mean.second_moment.trace() == Approx(R * R));
    for (int i = 0; i < 3; ++i)
      CHECK(mean.angular_velocity[i] * V(35, 22, 16)[i] == Approx(mean.angular_momentum[i]).margin(1e-13 * R));
    CHECK(mean.error < 1e-12);
  }
}

TEST_CASE("precession and spin of tumbling bodies", "[free]") {
  // figures ascribed to (4179) Toutatis: 5.367 d about the long axis, 7.420 d of the long axis about M
  for (const auto& c : free_reference::read()) {
    if (c.id != "fr13") continue;
    const auto m = *Motion<double>::make<Wide>(c.problem.cast<Wide>());
    const auto p = precession<double>(m, V(0, 0, 1));
    CHECK(p.converged);
    CHECK(2 * pi<double> / std::abs(p.about_axis) == Approx(5.367).epsilon(2e-4));
    CHECK(2 * pi<double> / std::abs(p.about_momentum) == Approx(7.420).epsilon(2e-4));
  }
  // nearly about an axis, down to where only rounding is left: regular precession, about -M/A and the rate (A - C) r/A about the axis
  for (const double tilt : {1e-3, 1e-8, 1e-10, 1e-13, 1e-16, 1e-18}) {
    gyrostat::free::Problem<double> body;
    body.inertia = V(0.06, 0.06, 0.08).asDiagonal();
    body.angular_velocity = {tilt, 0, 0.1};
    const auto m = *Motion<double>::make<Wide>(body.cast<Wide>());
    const auto p = precession<double>(m, V(0, 0, 1));
    CHECK(p.converged);
    if (m.kind() == gyrostat::free::Kind::steady) continue;
    CHECK(p.about_momentum == Approx(m.angular_momentum_norm() / 0.06).epsilon(1e-12));
    CHECK(p.about_axis == Approx(-0.02 * 0.1 / 0.06).epsilon(1e-12));
  }
  {  // the same with axes that are not those of the data, whose rounding must not count
    gyrostat::free::Problem<double> body;
    body.inertia << 0.018512160134411877, -6.583994439447846e-05, -1.1405666827279548e-05, -6.583994439447846e-05,
        0.018500253300109376, 2.3241015779578812e-05, -1.1405666827279548e-05, 2.3241015779578812e-05,
        0.01852436191728041;
    body.angular_velocity = {0.035140355701690315, -0.033952135470104554, -0.02049281963952005};
    const auto m = *Motion<double>::make<Wide>(body.cast<Wide>());
    const V one = m.R_BP().col(0);
    const auto p = precession<double>(m, m.at(0).angular_momentum.dot(one) < 0 ? V(-one) : one);
    CHECK(p.converged);
    CHECK(p.about_momentum == Approx(0.053271).epsilon(1e-4));
    CHECK(p.about_axis == Approx(-2.8126e-4).epsilon(1e-3));
  }
  {  // a permanent rotation but for rounding
    gyrostat::free::Problem<double> body;
    body.inertia << 0.5930478690613811, 0.034631613473876985, -0.012038749679786057, 0.034631613473876985,
        0.5769130801017612, 0.028761512102441746, -0.012038749679786057, 0.028761512102441746, 0.6503410734485566;
    body.angular_velocity = {0.00578926913296689, -1.1858365169666605, -3.443594617851056};
    const auto m = *Motion<double>::make<Wide>(body.cast<Wide>());
    for (const double sign : {1., -1.}) {
      const auto p = precession<double>(m, sign * m.R_BP().col(0));
      CHECK(p.converged);
      CHECK(std::abs(p.about_momentum) == Approx(4.083744986448943).epsilon(1e-12));
      CHECK(std::abs(p.about_axis) == Approx(2 * pi<double> / m.period()).epsilon(1e-12));
    }
  }
  // the azimuth of an axis about M, and that of M about the axis, followed through a period step by step
  Bodies bodies(44);
  int used = 0;
  for (int i = 0; i < 100; ++i) {
    const auto m = *Motion<double>::make<Wide>(bodies.of(Regime::generic, i).cast<Wide>());
    const V b = bodies.vector().normalized(), n = m.inertial_momentum().normalized();
    const auto p = precession<double>(m, b);
    if (!p.converged) continue;
    ++used;
    double about_momentum = 0, about_axis = 0;
    V last_b, last_n;
    constexpr int steps = 20000;
    for (int k = 0; k <= steps; ++k) {
      const auto s = m.at(m.period() * k / steps);
      const V now_b = rotate<double>(s.attitude, b), now_n = s.angular_momentum.normalized();
      const auto angle = [](const V& from, const V& to, const V& axis) {
        const V u = from - axis.dot(from) * axis, v = to - axis.dot(to) * axis;
        return std::atan2(axis.dot(cross<double>(u, v)), u.dot(v));
      };
      if (k > 0) about_momentum += angle(last_b, now_b, n), about_axis -= angle(last_n, now_n, b);
      last_b = now_b, last_n = now_n;
    }
    CAPTURE(i);
    CHECK(p.about_momentum * m.period() == Approx(about_momentum).margin(1e-9));
    CHECK(p.about_axis * m.period() == Approx(about_axis).margin(1e-9));
  }
  CHECK(used > 80);
}

TEST_CASE("nutation of a rigid body ends where the elliptic functions do", "[free]") {
  const auto m =
      *Motion<double>::make<Wide>(Problem<double>::from_moments({35, 22, 16}, {0, 0, 0}, {.9, .2, .1}).cast<Wide>());
  const auto range = gyrostat::free::nutation<double>(m, V(1, 0, 0));
  double least = 10, greatest = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = std::acos(m.at(m.period() * i / 20000).angular_momentum[0] / m.angular_momentum_norm());
    least = std::min(least, a), greatest = std::max(greatest, a);
  }
  CHECK(range.least == Approx(least).epsilon(1e-8));
  CHECK(range.greatest == Approx(greatest).epsilon(1e-8));
  // steady: one angle
  const auto steady = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {0, 2, 0}));
  CHECK(gyrostat::free::nutation<double>(steady, V(.6, .8, 0)).least == Approx(std::acos(.8)));
  CHECK(gyrostat::free::nutation<double>(steady, V(.6, .8, 0)).greatest == Approx(std::acos(.8)));
}

TEST_CASE("resonances are the convergents of the turn in a period", "[free]") {
  Bodies bodies(45);
  for (int i = 0; i < 50; ++i) {
    const auto m = *Motion<double>::make<Wide>(bodies.of(Regime::generic, i).cast<Wide>());
    double last = 7;
    for (const int most : {1, 3, 10, 100, 1000}) {
      const auto r = gyrostat::free::resonance(m, most);
      CHECK(r.periods <= most);
      CHECK(std::abs(r.rest) <= last);
      CHECK(std::abs(r.rest) <= 2 * pi<double> / 1);
      if (r.periods * 2 <= most) CHECK(std::abs(r.rest) < 2 * pi<double> / r.periods);
      last = std::abs(r.rest);
      const auto a = m.at(0), b = m.at(r.periods * m.period());
      const Quat<double> q = conjugate(a.attitude) * b.attitude;
      CHECK(2 * std::asin(std::min(1., V(q.x, q.y, q.z).norm())) ==
            Approx(std::abs(std::remainder(r.rest, 2 * pi<double>))).margin(1e-9));
    }
  }
  const auto steady = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {0, 2, 0}));
  CHECK(std::isnan(gyrostat::free::resonance(steady, 10).rest));
}

TEST_CASE("angles of rotors meet the reference cases", "[free]") {
  for (const auto& c : free_reference::read()) {
    if (c.rotors.empty()) continue;
    gyrostat::free::Assembly<double> a{c.problem, {}};
    for (const auto& r : c.rotors) a.wheels.push_back({r.axis, r.axial_inertia, r.rate, r.free});
    const auto reduced = Reduced<Wide>::of(a);
    const auto m = *Motion<double>::make<Wide>(reduced->problem);
    const RateIntegral<double> turned(m, c.at.back().t);
    for (const auto& at : c.at)
      for (std::size_t i = 0; i < c.rotors.size(); ++i) {
        const auto& wheel = reduced->wheels[i];
        const double angle =
            double(wheel.rate) * at.t - (wheel.turns_freely ? vector_cast<double>(wheel.axis).dot(turned.at(at.t)) : 0);
        CHECK(angle == Approx(double(at.rotor_angle[i])).epsilon(2e-15).margin(1e-14));
      }
  }
}

TEST_CASE("beside a saddle the integral of the rates is the angle turned through, to rounding", "[free]") {
  // a free wheel along an axis that the body turns about, and from which it falls off by e in 17 s
  const double inertia = 0.2312644683592179, lambda = 0.0030162406825449645, w = 0.22739603937628647;
  for (const double of_wheel : {-0.07893026337005613, 0.31, 2.0}) {
    Problem<double> p;
    p.inertia = V(0.020532983611022796, inertia, inertia - lambda).asDiagonal();
    p.rotor_momentum = {0, 0, lambda * (of_wheel + w)};
    p.angular_velocity = {-2.1096549447771598e-17, -6.047129932554282e-17, w};
    for (const Motion<double>& m : {*Motion<double>::make(p), *Motion<double>::make<Wide>(p.cast<Wide>())}) {
      const RateIntegral<double> turned(m, 171);
      for (const double t : {0.3, 7.0, 31.0, 95.0, 170.65020563893728}) {
        CAPTURE(of_wheel, t);
        CHECK(std::abs(turned.at(t)[2] - w * t) <= 1e-15 * (1 + w * t));
      }
    }
  }
}

TEST_CASE("the integral of the rates has them as its slope, in every kind of motion", "[free]") {
  std::vector<Problem<double>> problems = {
      Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {1, 1, 2}),     // separatrix
      Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {0, 1, 0}),     // steady
      Problem<double>::from_moments({4, 4, 4}, {.3, -.5, 1}, {0, 1, 2}),  // sphere
      Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {1e-9, 1, 0}),
      Problem<double>::from_moments({6, 4, 3}, {.3, -.5, 1}, {1, 1, .3}),
  };
  for (const auto& p : problems) {
    const auto m = *Motion<double>::make<Wide>(p.cast<Wide>());
    const RateIntegral<double> turned(m, 80);
    CAPTURE(int(m.kind()));
    CHECK(turned.at(0).norm() < 1e-14);
    for (const double t : {.4, .9, 3.1, 7.3, 12., 77.}) {
      V sum(0, 0, 0);  // Simpson
      constexpr int n = 4000;
      for (int k = 0; k <= n; ++k) sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * m.at(t * k / n).angular_velocity;
      CHECK((turned.at(t) - sum * t / n / 3).norm() < 1e-8);
      const double h = 1e-4;
      CHECK(((turned.at(t + h) - turned.at(t - h)) / (2 * h) - m.at(t).angular_velocity).norm() < 1e-7);
    }
  }
}

}  // namespace free_averages_test
