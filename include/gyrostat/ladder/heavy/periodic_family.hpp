// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/orbit_walk.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

/// The family of periodic motions that begins at fast spins, over the spin (docs/heavy.md, sections 4 and 6).
namespace gyrostat::heavy {

/// Why a family was followed no further.
enum class FamilyEnd : std::uint8_t {
  spin_reached,  ///< the spin asked for
  spin_zero,     ///< the spin passes zero
  homoclinic,  ///< a period or a trace beyond the bounds: the motion lingers at an unstable one, and the period has no bound
  stalled,      ///< no step, however short, finds a further member
  member_limit  ///< as many members as were allowed
};

template <Real Scalar>
struct FamilyOptions {
  Scalar last_spin = 0;  ///< rad/s, of the sign of the first; 0: to where the family ends
  Scalar greatest_trace = detail::greatest_trace<Scalar>;  ///< |trace - 4|
  Scalar greatest_period = 64;                             ///< over 1/max(c, sqrt N)
  std::size_t most_members = 400;
};

template <Real Scalar>
struct PeriodicFamily {
  std::vector<PeriodicOrbit<Scalar>> members;  ///< from the fast end on; each one's spin is start.angular_velocity[2]
  FamilyEnd end = FamilyEnd::stalled;
  Scalar slow_rate = 0;  ///< max(c, sqrt N), rad/s
  std::vector<std::size_t>
      folds;  ///< members behind which the spin turns back: first of the two between which it is greatest or least
};

/// The family from a fast spin on, G0 fixed, by pseudo-arclength; steps are at most a quarter of the slow rate, in p0, q0 and r0.
/// Errors: those of periodic_orbit at the first spin; out_of_domain (last_spin not below the first, or of another sign).
/// @param first_spin r0, rad/s; where c/r0 is not small its member is found first, as periodic_orbit does
template <Real Scalar>
Result<PeriodicFamily<Scalar>> periodic_family(const Problem<Scalar>& problem, Scalar first_spin,
                                               Scalar cos_inclination, const FamilyOptions<Scalar>& options = {});

template <Real Scalar>
Result<PeriodicFamily<Scalar>> periodic_family(const Problem<Scalar>& problem, Scalar first_spin,
                                               Scalar cos_inclination, const FamilyOptions<Scalar>& options) {
  const Scalar sign = first_spin < 0 ? Scalar(-1) : Scalar(1);
  const Scalar last = sign * options.last_spin;
  if (!(last >= 0) || !(last < std::abs(first_spin))) return Errc::out_of_domain;
  const auto scaled = Scaled<Scalar>::make(problem, first_spin, cos_inclination);
  if (!scaled) return scaled.error();
  const auto fast = detail::closed_orbit(problem, *scaled);
  if (!fast) return fast.error();

  PeriodicFamily<Scalar> family;
  family.slow_rate = detail::slow_rate(problem, first_spin);
  family.members.push_back(detail::judged(problem, fast->closed, fast->method));
  OrbitWalk<Scalar> walk(problem, fast->closed, family.slow_rate, fast->tangent);
  family.end = FamilyEnd::member_limit;
  while (family.members.size() < options.most_members) {
    const OrbitWalk<Scalar> before = walk;
    if (!walk.advance()) {
      family.end = FamilyEnd::stalled;
      break;
    }
    if (before.spin_slope() * walk.spin_slope() < 0) family.folds.push_back(family.members.size() - 1);
    const Scalar spin = sign * walk.member().start.angular_velocity[2];
    if (!(spin > 0)) {
      family.end = FamilyEnd::spin_zero;
      break;
    }
    if (last > 0) {
      const auto at = detail::member_passed(problem, before, walk, family.slow_rate, options.last_spin);
      if (at || spin <= last) {
        if (at) family.members.push_back(detail::judged(problem, *at, OrbitMethod::continuation));
        family.end = at ? FamilyEnd::spin_reached : FamilyEnd::stalled;
        break;
      }
    }
    family.members.push_back(detail::judged(problem, walk.member(), OrbitMethod::continuation));
    const auto& made = family.members.back();
    if (std::abs(made.trace_minus_4) > options.greatest_trace ||
        made.period * family.slow_rate > options.greatest_period) {
      family.end = FamilyEnd::homoclinic;
      break;
    }
  }
  return family;
}

#if defined(GYROSTAT_COMPILED)
extern template Result<PeriodicFamily<double>> periodic_family<double>(const Problem<double>&, double, double,
                                                                       const FamilyOptions<double>&);
#endif

}  // namespace gyrostat::heavy
