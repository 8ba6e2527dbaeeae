// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"

namespace gyrostat::math {

/// A function value and its derivative at one point.
template <Real Scalar>
struct Slope {
  Scalar f, df;
};

/// Cap on the function calls of one search; reached only by a function that is not continuous.
inline constexpr int root_calls = 200;

namespace detail {

/// A point well inside (a, b): the middle, or where the ends have one sign and lie far apart the middle of the exponents
/// (but at most 2^60 times closer to zero than the far end), so that a root near 1e-300 is reached too.
template <Real Scalar>
inline Scalar middle(Scalar a, Scalar b) noexcept {
  const Scalar x = std::abs(a);
  const Scalar y = std::abs(b);
  const Scalar least = std::min(x, y);
  const Scalar most = std::max(x, y);
  if (a * b < 0 || std::signbit(a) != std::signbit(b) || most <= 8 * least) return a / 2 + b / 2;
  const Scalar root = std::max(std::sqrt(least) * std::sqrt(most), most * Scalar(0x1p-60));
  if (!(root > least && root < most)) return a / 2 + b / 2;
  return a + b < 0 ? -root : root;
}

}  // namespace detail

/// Root of f between low and high by Newton's method, halving the bracket where a step leaves it or gains too little.
/// The signs at the ends are known and not evaluated (they may be poles): f(low) <= 0 <= f(high) if `rising`, else the
/// opposite. `f(x)` gives Slope{f, df}. Stops at f = 0, at a step below 2 eps |x| + tolerance, or when the bracket is
/// that small. low = high is the root. Errors: not_increasing where low > high; not_finite where f or df is NaN; no_convergence after
/// root_calls calls.
template <Real Scalar, class Function>
[[nodiscard]] inline Result<Scalar> newton_root(const Function& f, Scalar low, Scalar high, bool rising, Scalar start,
                                                Scalar tolerance = 0) noexcept {
  if (!(low < high)) return low == high ? Result<Scalar>(low) : Result<Scalar>(Errc::not_increasing);
  Scalar x = start > low && start < high ? start : low / 2 + high / 2;
  Scalar last = high - low;    // length of the last step
  Scalar before = high - low;  // and of the one before it
  for (int call = 0; call < root_calls; ++call) {
    const Slope<Scalar> at = f(x);
    if (std::isnan(at.f) || std::isnan(at.df)) return Errc::not_finite;
    if (at.f == 0) return x;
    ((at.f < 0) == rising ? low : high) = x;
    const Scalar reach = 2 * epsilon<Scalar> * std::abs(x) + tolerance;
    if (high - low <= reach) return x;
    Scalar next = x - at.f / at.df;
    if (std::abs(next - x) <= reach) return std::min(std::max(next, low), high);
    const bool slow = std::abs(next - x) > before / 2 || call % 8 == 7;  // at a multiple root Newton's steps stay slow
    if (!(next > low && next < high) || slow) next = detail::middle(low, high);
    before = last;
    last = std::abs(next - x);
    x = next;
  }
  return Errc::no_convergence;
}

/// The same from the middle of the bracket.
template <Real Scalar, class Function>
[[nodiscard]] inline Result<Scalar> newton_root(const Function& f, Scalar low, Scalar high, bool rising) noexcept {
  return newton_root(f, low, high, rising, low / 2 + high / 2);
}

/// Root of a continuous f between low and high without derivatives: inverse quadratic interpolation where it is safe,
/// halving elsewhere (Chandrupatla 1997). Stops at f = 0 or at a bracket below 4 eps |x| + tolerance, and answers its
/// better end. Errors: not_increasing unless low < high; no_bracket if f has one sign at both ends; not_finite where f
/// is NaN; no_convergence after root_calls calls.
template <Real Scalar, class Function>
[[nodiscard]] inline Result<Scalar> bracketed_root(const Function& f, Scalar low, Scalar high,
                                                   Scalar tolerance = 0) noexcept {
  if (!(low < high)) return Errc::not_increasing;
  Scalar a = high, fa = f(high);
  Scalar b = low, fb = f(low);
  if (std::isnan(fa) || std::isnan(fb)) return Errc::not_finite;
  if (fa == 0) return a;
  if (fb == 0) return b;
  if ((fa < 0) == (fb < 0)) return Errc::no_bracket;
  Scalar x = a / 2 + b / 2;
  for (int call = 2; call < root_calls; ++call) {
    const Scalar fx = f(x);
    if (std::isnan(fx)) return Errc::not_finite;
    Scalar c = a, fc = fa;
    if ((fx < 0) != (fa < 0)) {
      c = b;
      fc = fb;
      b = a;
      fb = fa;
    }
    a = x;
    fa = fx;
    const Scalar best = std::abs(fa) < std::abs(fb) ? a : b;
    const Scalar reach = 2 * epsilon<Scalar> * std::abs(best) + tolerance / 2;
    const Scalar width = std::abs(b - a);
    if (fa == 0) return a;
    if (width <= 2 * reach) return best;
    const Scalar margin = reach / width;
    const Scalar xi = (a - b) / (c - b);
    const Scalar phi = (fa - fb) / (fc - fb);
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi) {
      const Scalar t = fa / (fb - fa) * (fc / (fb - fc)) + (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb));
      x = a + std::min(std::max(t, margin), 1 - margin) * (b - a);
    } else {
      x = detail::middle(a, b);
    }
  }
  return Errc::no_convergence;
}

}  // namespace gyrostat::math
