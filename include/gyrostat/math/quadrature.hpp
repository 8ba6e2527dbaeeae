// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"

namespace gyrostat::math {

/// A point of Kronrod's rule of 15 points on (-1, 1).
template <Real Scalar>
struct KronrodPoint {
  Scalar node;
  Scalar weight;        ///< exact to degree 23, with the others
  Scalar gauss_weight;  ///< of Gauss's rule of 7 points, exact to degree 13; 0 at the points that it has not
};

/// The rule from the middle outwards (Piessens and others, QUADPACK, 1983, qk15).
template <Real Scalar>
inline constexpr std::array<KronrodPoint<Scalar>, 15> kronrod_points = [] {
  constexpr long double node[8] = {0.0L,
                                   0.207784955007898467600689403773L,
                                   0.405845151377397166906606412077L,
                                   0.586087235467691130294144691693L,
                                   0.741531185599394439863864773281L,
                                   0.864864423359769072789712788640L,
                                   0.949107912342758524526189684048L,
                                   0.991455371120812639206854697526L};
  constexpr long double weight[8] = {0.209482141084727828012999174892L, 0.204432940075298892414161999235L,
                                     0.190350578064785409913256402422L, 0.169004726639267902826583426599L,
                                     0.140653259715525918745189590510L, 0.104790010322250183839876322542L,
                                     0.063092092629978553290700663189L, 0.022935322010529224963732008059L};
  constexpr long double gauss[4] = {0.417959183673469387755102040816L, 0.381830050505118944950369775489L,
                                    0.279705391489276667901467771424L, 0.129484966168869693270611432679L};
  std::array<KronrodPoint<Scalar>, 15> points{};
  for (std::size_t i = 0; i < 15; ++i) {
    const std::size_t j = (i + 1) / 2;
    points[i] = {Scalar(i % 2 == 1 ? node[j] : -node[j]), Scalar(weight[j]), Scalar(j % 2 == 0 ? gauss[j / 2] : 0.0L)};
  }
  return points;
}();

/// Walks over (first, last), cut into `panels` equal parts, from left to right. `take(middle, half, halvable)` sees a part and
/// answers with a Result<bool>: false has it halved, at most `deepest` times, for which `halvable` is true. Ends with the first
/// error that `take` answers, else with Errc::ok.
template <Real Scalar, class Take>
[[nodiscard]] Errc halved_panels(Scalar first, Scalar last, int panels, int deepest, const Take& take) noexcept {
  const Scalar width = (last - first) / Scalar(panels);
  for (int panel = 0; panel < panels; ++panel) {
    // the left part of a halved panel is done first: `part` is the place of this one among all of its depth
    long part = 0;
    for (int depth = 0; part < 1L << depth;) {
      const Scalar half = width / Scalar(2L << depth);
      const Scalar middle = first + Scalar(panel) * width + Scalar(2 * part + 1) * half;
      const Result<bool> taken = take(middle, half, depth < deepest);
      if (!taken) return taken.error();
      if (!*taken && depth < deepest) {
        ++depth, part *= 2;
        continue;
      }
      // a part that ends on a boundary of a coarser one is followed by a coarser one
      for (++part; depth > 0 && part % 2 == 0; part /= 2) --depth;
    }
  }
  return Errc::ok;
}

}  // namespace gyrostat::math
