// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/phase_grid.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/math/elliptic.hpp"

using gyrostat::deceleration::PhaseGrid;
using gyrostat::math::Modulus;

TEST_CASE("the phase grid holds the Jacobi functions at equal parts of a quarter period", "[deceleration]") {
  const auto m =
      GENERATE(Modulus<double>::from_k2(0.), Modulus<double>::from_k2(1e-14), Modulus<double>::from_k2(.3),
               Modulus<double>::from_kp2(.01), Modulus<double>::from_kp2(1e-8), Modulus<double>::from_kp2(1e-15));
  PhaseGrid<double> grid(m);
  int depth = 0;
  while (grid.refine()) ++depth;
  CHECK(depth == PhaseGrid<double>::deepest);
  CHECK(grid.depth() == depth);
  CHECK_FALSE(grid.refine());

  const Modulus<long double> exact{m.k2, m.kp2};
  const long double K = gyrostat::math::Native::complete(exact).K;
  const int q = grid.size() - 1;
  double worst = 0;
  for (int j = 1; j < q; ++j) {
    const auto f = gyrostat::math::Native::jacobi(K * j / q, exact);
    const int e = grid.entry(j);
    worst = std::max({worst, double(std::abs(grid.sn[e] / f.sn - 1)), double(std::abs(grid.cn[e] / f.cn - 1)),
                      double(std::abs(grid.dn[e] / f.dn - 1))});
  }
  CHECK(worst < 4e-15);
  CHECK(grid.entry(0) == 0);
  CHECK(grid.entry(q) == 1);
  CHECK(grid.cn[1] == 0);
}
