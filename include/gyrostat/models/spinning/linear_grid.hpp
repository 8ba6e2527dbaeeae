// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/spinning/block_grid.hpp"
#include "gyrostat/models/spinning/grid_columns.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/mode_grid.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

/// Which kernel writes a grid; `any`: the faster that is accurate.
enum class GridKernel : std::uint8_t { any, modes, blocks, points };

/// The linear motion at the times start + i step, i = 0 .. points - 1, as arrays (docs/spinning.md, section 4.3): by its modes, some
/// 1.2 ns a point, where nu^2 > 0 and the least divisor turns through more than 10 rad until the end; else by blocks, some 2.5 ns
/// a point and 0.06 ms before; point by point, 0.3 us each, where a step turns through more than 4 rad. Good to some eps of the
/// greatest value of each quantity; by blocks and points also of each value. Modes asked for by name where nu^2 <= 0 give NaN. About 50 kB, no heap.
template <Real Scalar>
class LinearGrid {
 public:
  LinearGrid(const Problem<Scalar>& problem, Scalar start, Scalar step, std::size_t points,
             GridKernel kernel = GridKernel::any) noexcept
      : begin_(start), step_(step) {
    if (kernel == GridKernel::any) kernel = best(problem, start, step, points);
    switch (kernel) {
      case GridKernel::modes: grid_.template emplace<ModeGrid<Scalar>>(problem, start, step); break;
      case GridKernel::points: grid_.template emplace<Linear<Scalar>>(problem); break;
      case GridKernel::blocks:
      default: grid_.template emplace<BlockGrid<Scalar>>(problem, start, step, points);
    }
  }

  static GridKernel best(const Problem<Scalar>& problem, Scalar start, Scalar step, std::size_t points) noexcept {
    const Scalar end = start + step * static_cast<Scalar>(points), r0 = problem.spin();
    const bool apart = divisors(problem).least() * std::max(std::abs(start), std::abs(end)) > 10;
    if (problem.nutation_squared() > 0 && apart) return GridKernel::modes;
    const Scalar rate = std::abs(r0) + std::abs(problem.kappa1(r0)) + std::abs(problem.kappa2(r0));
    return rate * std::abs(step) > 4 ? GridKernel::points : GridKernel::blocks;
  }

  GridKernel kernel() const noexcept {
    if (std::holds_alternative<ModeGrid<Scalar>>(grid_)) return GridKernel::modes;
    return std::holds_alternative<BlockGrid<Scalar>>(grid_) ? GridKernel::blocks : GridKernel::points;
  }

  /// Values first .. first + count - 1, into entries 0 .. count - 1.
  void write(std::size_t first, std::size_t count, const GridColumns<Scalar>& to) const noexcept {
    if (const auto* modes = std::get_if<ModeGrid<Scalar>>(&grid_)) modes->write(first, count, to);
    if (const auto* blocks = std::get_if<BlockGrid<Scalar>>(&grid_)) blocks->write(first, count, to);
    if (const auto* linear = std::get_if<Linear<Scalar>>(&grid_)) {
      for (std::size_t i = 0; i < count; ++i) put(linear->at(begin_ + static_cast<Scalar>(first + i) * step_), i, to);
    }
  }

 private:
  static void put(const State<Scalar>& s, std::size_t i, const GridColumns<Scalar>& to) noexcept {
    to.p[i] = s.angular_velocity[0];
    to.q[i] = s.angular_velocity[1];
    to.psi[i] = s.angles.psi;
    to.phi[i] = s.angles.phi;
    to.theta[i] = s.angles.theta;
    to.G1[i] = s.momentum_I[0];
    to.G2[i] = s.momentum_I[1];
    to.v1[i] = s.velocity[0];
    to.v2[i] = s.velocity[1];
    to.v3[i] = s.velocity[2];
    to.x1[i] = s.position[0];
    to.x2[i] = s.position[1];
    to.x3[i] = s.position[2];
    if (to.G3 != nullptr) to.G3[i] = s.momentum_I[2];
  }

  Scalar begin_, step_;
  std::variant<std::monostate, ModeGrid<Scalar>, BlockGrid<Scalar>, Linear<Scalar>> grid_;
};

}  // namespace gyrostat::spinning
