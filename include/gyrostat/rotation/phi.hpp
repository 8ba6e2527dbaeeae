// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"

/// The trigonometric quotients of the rotation group, each without a switch at small arguments: half-angle recursions
/// of a fixed number of trips whose terms have one sign. NaN in, NaN out.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// sin x / x.
template <Real Scalar>
Scalar sinc(Scalar x) noexcept {
  return x == 0 ? Scalar(1) : std::sin(x) / x;
}

/// (1 - cos x) / x^2 by the half angle.
template <Real Scalar>
Scalar versine_ratio(Scalar x) noexcept {
  const Scalar s = sinc(x / 2);
  return s * s / 2;
}

/// (x - sin x) / x^3, |x| <= 4 pi. With h = x/2: phi(x) = phi(h)/4 + sinc(h) sinc(h/2)^2 / 8, four times, and the power
/// series at x/16.
template <Real Scalar>
Scalar sine_defect_ratio(Scalar x) noexcept {
  Scalar sum = 0;
  Scalar weight = 1;
  Scalar h = x / 2;
  Scalar outer = sinc(h);
  for (int i = 0; i < 4; ++i) {
    const Scalar inner = sinc(h / 2);
    sum += weight * outer * inner * inner / 8;
    weight /= 4;
    h /= 2;
    outer = inner;
  }
  const Scalar y2 = 4 * h * h;
  Scalar series = 0;
  for (int k = 9; k >= 0; --k) series = (1 - y2 * series) / Scalar((2 * k + 2) * (2 * k + 3));
  return sum + weight * series;
}

/// (1 - (x/2) cot(x/2)) / x^2, |x| < 2 pi, where it has its first pole. With G(y) = (1 - y cot y)/y^2:
/// G(y) = (G(y/2) + tan(y/2)/(y/2)) / 4, six times from y = x/2, and the power series at x/128.
template <Real Scalar>
Scalar cotangent_defect_ratio(Scalar x) noexcept {
  Scalar sum = 0;
  Scalar weight = 1;
  Scalar y = x / 2;
  for (int i = 0; i < 6; ++i) {
    y /= 2;
    weight /= 4;
    sum += weight * (y == 0 ? Scalar(1) : std::tan(y) / y);
  }
  const Scalar y2 = y * y;
  const Scalar high = Scalar(2) / 945 + y2 * (Scalar(1) / 4725 + y2 * (Scalar(2) / 93555));
  const Scalar series = Scalar(1) / 3 + y2 * (Scalar(1) / 45 + y2 * high);
  return (sum + weight * series) / 4;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
