// SPDX-License-Identifier: BSD-3-Clause
// Arrays for a grid of the linear motion, and the distance to Linear in wider numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gyrostat/models/spinning/grid_columns.hpp"
#include "gyrostat/models/spinning/linear.hpp"

namespace grid_oracle {

using namespace gyrostat;
using namespace gyrostat::spinning;

template <class S>
struct Arrays {
  std::vector<S> column[14];
  GridColumns<S> columns;

  explicit Arrays(std::size_t n) {
    for (auto& c : column) c.assign(n, gyrostat::nan<S>);
    auto& d = column;
    columns = {d[0].data(), d[1].data(), d[2].data(), d[3].data(),  d[4].data(),  d[5].data(),  d[6].data(),
               d[7].data(), d[8].data(), d[9].data(), d[10].data(), d[11].data(), d[12].data(), d[13].data()};
  }
};

inline std::array<long double, 14> row(const State<long double>& s) {
  return {s.angular_velocity[0], s.angular_velocity[1], s.angles.psi,  s.angles.phi,   s.angles.theta,
          s.momentum_I[0],       s.momentum_I[1],       s.velocity[0], s.velocity[1],  s.velocity[2],
          s.position[0],         s.position[1],         s.position[2], s.momentum_I[2]};
}

/// Pairs of columns that are measured by their norm; the same twice: one alone.
inline constexpr std::size_t pairs[9][2] = {{0, 1}, {2, 3},   {4, 4},   {5, 6},  {7, 8},
                                            {9, 9}, {10, 11}, {12, 12}, {13, 13}};

/// Greatest error of any quantity over its value (floor: or that part of its greatest value, where that is more; theta: floor 1; G3,
/// a sum of parts that cancel where the tilt is large: over those parts), at every `every`-th entry.
template <class S>
double error(const Arrays<S>& a, const Problem<S>& p, long double start, S step, std::size_t every, double floor) {
  const Linear<long double> linear(spinning::detail::problem_cast<long double>(p));
  const long double torque = p.torque.norm(), charge = std::abs(p.charge_momentum);
  long double most[9] = {};
  double worst = 0;
  const std::size_t n = a.column[0].size();
  std::vector<std::array<long double, 14>> truth;
  for (std::size_t i = 0; i < n; i += every)
    truth.push_back(row(linear.at(start + static_cast<long double>(i) * step)));
  const auto size = [](const std::array<long double, 14>& y, const std::size_t* pair) {
    return pair[0] == pair[1] ? std::abs(y[pair[0]]) : std::hypot(y[pair[0]], y[pair[1]]);
  };
  if (floor == 1)
    for (const auto& y : truth)
      for (int k = 0; k < 9; ++k) most[k] = std::max(most[k], size(y, pairs[k]));
  for (std::size_t j = 0; j < truth.size(); ++j) {
    std::array<long double, 14> apart;
    for (std::size_t c = 0; c < 14; ++c) apart[c] = a.column[c][j * every] - truth[j][c];
    for (int k = 0; k < 9; ++k) {
      most[k] = std::max(most[k], size(truth[j], pairs[k]));
      const long double difference = size(apart, pairs[k]);
      if (difference == 0) continue;
      long double over = std::max(size(truth[j], pairs[k]), (k == 2 ? 1 : floor) * most[k]);
      if (k == 8)
        over += torque * most[1] * std::abs(start + static_cast<long double>(j * every) * step) +
                charge * most[1] * most[1];
      const double ratio = double(difference / over);
      if (!(ratio <= worst)) worst = ratio;
    }
  }
  return worst;
}

}  // namespace grid_oracle
