// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Least eigenvalue of the second moments of mass, tr(J)/2 E - J - known, kg m^2: negative where no mass distribution has the inertia J
/// and, as a part of its second moments, `known` (those of a rotor, or of the whole mass in its centre). Stronger than the triangle
/// inequality.
template <Real Scalar>
Scalar realisability(const Mat3<Scalar>& J, const Mat3<Scalar>& known) noexcept {
  const Mat3<Scalar> second_moments = J.trace() / 2 * Mat3<Scalar>::Identity() - J - known;
  return symmetric_eigen<Scalar>(second_moments).values[0];
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
