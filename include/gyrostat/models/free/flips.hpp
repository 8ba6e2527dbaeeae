// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/free/motion.hpp"

namespace gyrostat::free {

/// Points in a period that show every turn of the path of M: more beside a separatrix.
template <Real Scalar>
int nodes_of(const Motion<Scalar>& motion) noexcept {
  using std::ceil;
  const Scalar K = motion.quarter_period();  // 0 of a steady rotation
  if (motion.is_regular_precession() || !(K > 0 && K < infinity<Scalar>)) return 32;
  const Scalar ratio = K / motion.quarter_period_conjugate();
  return 32 + 24 * (ratio < 1000 ? static_cast<int>(ceil(ratio)) : 1000);
}

/// Times of [begin, end] at which a function that repeats with the motion's period crosses zero, in order; `value(t)`, at most `most` of
/// them. Empty where the motion has no period, and where the begin is not finite.
template <Real Scalar, class Function>
std::vector<Scalar> periodic_zeros(const Motion<Scalar>& motion, const Function& value, Scalar begin, Scalar end,
                                   std::size_t most = 1000000) noexcept {
  using std::ceil, std::floor;
  std::vector<Scalar> first, times;
  const Scalar T = motion.period();
  if (!(T < infinity<Scalar>) || !(begin <= end) || !(begin - begin == 0)) return times;
  const int nodes = nodes_of(motion);
  const Scalar begins = value(Scalar(0)), near = 64 * epsilon<Scalar> * T;
  Scalar last = begins;
  for (int i = 1; i <= nodes; ++i) {
    const Scalar low = T * Scalar(i - 1) / Scalar(nodes), high = T * Scalar(i) / Scalar(nodes);
    const Scalar next = i == nodes ? begins : value(high);  // at the end of the period as at its begin, to the bit
    if (last == 0) first.push_back(low);
    else if ((last < 0) != (next < 0) && next != 0) {
      const auto root = math::bracketed_root<Scalar>(value, low, high);
      // where both ends of the period are one zero but for rounding the sign may change in none of them: then it is at its begin
      if (!root && i == nodes) first.insert(first.begin(), Scalar(0));
      else if (root && *root > T - near) first.insert(first.begin(), Scalar(0));
      else if (root) first.push_back(*root);
    }
    last = next;
  }
  if (first.empty()) return times;
  for (Scalar turn = floor(begin / T); turn * T <= end && turn + 1 > turn && times.size() < most; turn += 1)
    for (const Scalar t : first)
      if (const Scalar at = turn * T + t; at >= begin && at <= end && times.size() < most) times.push_back(at);
  return times;
}

/// The first `most` times of [begin, end], s, at which M crosses the plane normal to a body axis. Of the middle axis of a rigid body spun about it these
/// are the flips that Dzhanibekov saw in 1985, half a period apart. Each is as uncertain as the motion's phase.
template <Real Scalar>
std::vector<Scalar> flips(const Motion<Scalar>& motion, const Vec3<Scalar>& axis, Scalar begin, Scalar end,
                          std::size_t most = 1000000) noexcept {
  return periodic_zeros(motion, [&](Scalar t) { return axis.dot(motion.at(t).angular_momentum); }, begin, end, most);
}

/// Time between flips about the middle principal axis, s: half a period where M surrounds another axis and the body has no rotor
/// momentum; NaN else.
template <Real Scalar>
Scalar flip_interval(const Motion<Scalar>& motion) noexcept {
  const bool rigid = motion.rotor_momentum() == Vec3<Scalar>(0, 0, 0);
  const bool lobe = motion.kind() == Kind::about_largest || motion.kind() == Kind::about_smallest;
  return rigid && lobe ? motion.period() / 2 : nan<Scalar>;
}

}  // namespace gyrostat::free
