// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "gyrostat/ladder/rotor/motion.hpp"

namespace gyrostat::rotor {

/// Errors of the columns, relative to their greatest norms in `states` or to their scales, from a bound for all of them: {attitude, momentum,
/// rotor_rate, rotor_angle}, rad, N m s, rad/s, rad. What making the columns from states costs by rounding is added, and that of the momentum of the start,
/// which is summed of what carrier and rotor have and may be far less.
template <class Bound>
ColumnErrors<double> state_columns(const Row<double>& row, const State<double>& start,
                                   std::span<const State<double>> states, const Bound& bound) noexcept {
  const Gyrostat<double>& body = row.body;
  Comparison sizes(row);
  double lyapunov = 0, rounding = 0, blur = 0;
  const double j = 1 / body.principal()[0], lambda = body.axial_inertia(), k = body.coupling();
  const double j_free = 1 / body.free_principal()[0];
  const double e_n = (body.inverse_inertia() * body.axis()).norm();
  constexpr double ulps = 4 * epsilon<double>;
  const Vec3<double> first = body.angular_velocity(start.momentum, start.axial_momentum);
  const double summed =
      (body.inertia() * first).norm() + lambda * std::abs(body.rotor_rate(start.axial_momentum, first));
  double parts = summed;
  for (const State<double>& s : states) {
    sizes.add(s);
    const double l = s.momentum.norm(), h = std::abs(body.target_momentum()), p = std::abs(s.axial_momentum);
    const Vec3<double> Omega = body.angular_velocity(s.momentum, s.axial_momentum);
    const double turning = body.rotor_rate(s.axial_momentum, Omega), x = turning - body.no_load_rate();
    parts = greater(parts, (body.inertia() * Omega).norm() + lambda * std::abs(turning));
    const Vec3<double> gradient = body.inverse_inertia() * (s.momentum - body.target_momentum() * body.axis());
    const double dH = bound.momentum + ulps * (l + h + summed + body.momentum_blur(Omega));
    const double dx = bound.rotor_rate + ulps * (p / lambda + j_free * (l + p) + std::abs(body.no_load_rate()));
    rounding = greater(rounding, ulps * j_free * (l + p + body.momentum_blur(Omega)));
    blur = greater(blur, ulps * body.momentum_blur(Omega));
    // 0 times an infinite bound is NaN: not known
    lyapunov = greater(lyapunov, gradient.norm() * dH + lambda * k * std::abs(x) * dx +
                                     (j * dH * dH + lambda * k * dx * dx) / 2 +
                                     ulps * body.lyapunov(s.momentum, s.axial_momentum));
  }
  ColumnErrors<double> errors;
  errors[column::attitude] = std::min(bound.attitude, pi<double>);
  errors[column::angular_momentum] = bound.momentum + 16 * epsilon<double> * row.scale[column::angular_momentum];
  // a body that starts at rest has none, to the bit; else it is summed of what the carrier and the rotor have, which may cancel
  if (sizes.unit(column::angular_momentum) > 0) errors[column::angular_momentum] += blur + 2 * epsilon<double> * parts;
  errors[column::angular_velocity] = j * bound.momentum + lambda * e_n * bound.rotor_rate + rounding;
  errors[column::rotor_rate] = bound.rotor_rate + e_n * blur;
  errors[column::rotor_angle] = bound.rotor_angle;
  errors[column::lyapunov] = lyapunov == lyapunov ? lyapunov : infinity<double>;
  return relative_to_truth(sizes.relative(errors), column_kinds);
}

}  // namespace gyrostat::rotor
