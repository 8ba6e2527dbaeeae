// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/theta_pair.hpp"

#include <cmath>
#include <complex>

#include "catch.hpp"
#include "gyrostats.hpp"

namespace free_theta_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Pencil;
using gyrostat::free::PrincipalProblem;
using gyrostat::free::SpinorFrame;
using gyrostat::free::ThetaPair;

/// Theta functions by their definition (DLMF 20.2), summed far beyond need.
std::complex<double> theta(int which, std::complex<double> z, double log_q) {
  std::complex<double> sum = 0;
  const std::complex<double> i(0, 1);
  for (int n = -60; n <= 60; ++n) {
    const double half = which == 1 ? n + 0.5 : n;
    const double sign = which == 3 ? 1 : n % 2 ? -1 : 1;
    sum += sign * std::exp(half * half * log_q + 2. * i * half * z);
  }
  return which == 1 ? -i * sum : sum;
}

TEST_CASE("both forms of the theta pair are theta functions", "[free]") {
  Bodies bodies(3);
  int seen[2][2] = {{0, 0}, {0, 0}};
  for (int k = 0; k < 200; ++k) {
    const auto p = bodies.of(k % 3 ? Regime::generic : Regime::bisected, k);
    const auto d = PrincipalProblem<double>::of(p);
    const Pencil<double> pencil(d.inverse, d.gaps, d.G, d.l, d.M, d.M.norm());
    const auto frame = SpinorFrame<double>::of(pencil);
    REQUIRE(frame);
    const ThetaPair<double> pair(*frame);
    if (!(pair.K < 6 * pair.Kp)) continue;  // the definition needs more digits there
    ++seen[pair.single][pair.hyperbolic];
    const double log_q = -pi<double> * pair.Kp / pair.K * (pair.single ? 1 : 2);
    for (const double share : {-.45, -.2, 0., .1, .37}) {
      const double u = 2 * pair.K * share;
      const auto v = pair.at(pair.h * u);
      const std::complex<double> z(pi<double> * u / (2 * pair.K),
                                   frame->delta * pi<double> * frame->eta / (2 * pair.K));
      const std::complex<double> one = theta(pair.single ? 1 : 4, z, log_q), two = theta(pair.single ? 3 : 1, z, log_q);
      // the ratio of the two, up to the constants A and B and, after the imaginary transformation, a fixed pair of frames
      const std::complex<double> a(v.one.re, v.one.im), b(v.two.re, v.two.im);
      if (!pair.hyperbolic && !pair.single) {
        CHECK(std::abs(b / a - two / one) < 1e-13 * (1 + std::abs(two / one)));
      } else if (!pair.hyperbolic) {
        const auto start = pair.at(0);
        const std::complex<double> z0(0, z.imag()), ratio0(start.one.re, start.one.im);
        const std::complex<double> c =
            theta(1, z0, log_q) / theta(3, z0, log_q) / (ratio0 / std::complex<double>(start.two.re, start.two.im));
        CHECK(std::abs(a / b * c - one / two) < 1e-12 * (1 + std::abs(one / two)));
      }
      CHECK(std::isfinite(std::abs(a) + std::abs(b)));
    }
    // turning: against a difference
    const double step = 1e-5 / pair.h;
    const auto rise = pair.at(pair.h * step), fall = pair.at(-pair.h * step);
    const auto turning = pair.turning();
    CHECK(turning.one == Approx(std::arg(std::complex<double>(rise.one.re, rise.one.im) /
                                         std::complex<double>(fall.one.re, fall.one.im)) /
                                (2 * step))
                             .margin(1e-8));
    CHECK(turning.two == Approx(std::arg(std::complex<double>(rise.two.re, rise.two.im) /
                                         std::complex<double>(fall.two.re, fall.two.im)) /
                                (2 * step))
                             .margin(1e-8));
  }
  for (const auto& row : seen)
    for (const int count : row) CHECK(count > 3);
}

TEST_CASE("the slope of a theta pair is that of its values", "[free]") {
  const auto d = PrincipalProblem<double>::of(Problem<double>::from_moments({3, 2, 1}, {.2, -.1, .3}, {1, .3, .4}));
  const Pencil<double> pencil(d.inverse, d.gaps, d.G, d.l, d.M, d.M.norm());
  const auto frame = SpinorFrame<double>::of(pencil);
  REQUIRE(frame);
  const ThetaPair<double> pair(*frame);
  REQUIRE_FALSE(pair.hyperbolic);
  const double step = 1e-4;
  for (const double z : {0., .7, 2., 5.}) {
    const auto at = [&](double x) { return pair.trigonometric(std::cos(x), std::sin(x)); };
    const auto slope = pair.slope(std::cos(z), std::sin(z)), up = at(z + step), down = at(z - step);
    CHECK(std::abs(slope.one.re - pair.h * (up.one.re - down.one.re) / (2 * step)) < 1e-7);
    CHECK(std::abs(slope.one.im - pair.h * (up.one.im - down.one.im) / (2 * step)) < 1e-7);
    CHECK(std::abs(slope.two.re - pair.h * (up.two.re - down.two.re) / (2 * step)) < 1e-7);
    CHECK(std::abs(slope.two.im - pair.h * (up.two.im - down.two.im) / (2 * step)) < 1e-7);
  }
}

TEST_CASE("the sums of a theta pair are short", "[free]") {
  Bodies bodies(4);
  for (const Regime regime : regimes)
    for (int k = 0; k < 100; ++k) {
      const auto d = PrincipalProblem<DoubleDouble>::of(bodies.of(regime, k).cast<DoubleDouble>());
      const auto frame =
          SpinorFrame<DoubleDouble>::of(Pencil<DoubleDouble>(d.inverse, d.gaps, d.G, d.l, d.M, d.M.norm()));
      REQUIRE(frame);
      const ThetaPair<DoubleDouble> pair(*frame);
      CHECK(pair.powers < ThetaPair<DoubleDouble>::most - 1);
      CHECK(pair.cast<double>().powers <= 9);
    }
}

}  // namespace free_theta_test
