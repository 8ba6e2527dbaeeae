// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstdint>
#include <utility>

#include "gyrostat/core/level.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Every way in which a construction or an iteration can fail.
enum class Errc : std::uint8_t {
  ok,
  not_finite,           ///< an argument is NaN or infinite
  not_positive,         ///< an argument that must be > 0 is not
  negative,             ///< an argument that must be >= 0 is not
  not_symmetric,        ///< a tensor is not symmetric
  triangle_inequality,  ///< a principal moment exceeds the sum of the two others
  zero_vector,          ///< a direction was asked of a vanishing vector
  out_of_domain,        ///< an argument leaves the legal interval
  not_increasing,       ///< times or brackets are not in increasing order
  no_bracket,           ///< the function has one sign at both ends
  no_convergence,       ///< an iteration hit its cap
  step_limit,           ///< an integrator hit its cap on steps
  step_underflow,       ///< an integrator could not make the step small enough
  separatrix,           ///< the orbit is the separatrix: it has no period
  undetermined,         ///< the averaged motion does not fix the outcome (capture)
  not_applicable,       ///< the model does not cover this scene
  unavailable,          ///< the build lacks an optional library
  cancelled,            ///< the caller stopped the work
  beyond_range,         ///< numbers are so large or small that their products overflow or vanish
};

/// One English sentence a failure, for a message at the edge.
constexpr const char* message(Errc code) noexcept {
  switch (code) {
    case Errc::ok: return "no error";
    case Errc::not_finite: return "a number is NaN or infinite";
    case Errc::not_positive: return "a number that must be positive is not";
    case Errc::negative: return "a number that must not be negative is";
    case Errc::not_symmetric: return "the tensor is not symmetric";
    case Errc::triangle_inequality: return "a principal moment exceeds the sum of the two others";
    case Errc::zero_vector: return "the vector vanishes and has no direction";
    case Errc::out_of_domain: return "a number leaves its legal interval";
    case Errc::not_increasing: return "the numbers are not in increasing order";
    case Errc::no_bracket: return "the function does not change sign over the bracket";
    case Errc::no_convergence: return "the iteration did not converge";
    case Errc::step_limit: return "the integrator reached its cap on steps";
    case Errc::step_underflow: return "the integrator could not make its step small enough";
    case Errc::separatrix: return "the orbit is the separatrix and has no period";
    case Errc::undetermined: return "the averaged motion does not determine the outcome";
    case Errc::not_applicable: return "the model does not cover this scene";
    case Errc::unavailable: return "the build lacks an optional library";
    case Errc::cancelled: return "the caller stopped the work";
    case Errc::beyond_range:
      return "numbers are so large or small that their products overflow or vanish: give them in other units";
  }
  return "unknown error";
}

/// A value, or the reason why there is none. Holds a default-constructed value beside a failure, so T must have one;
/// never throws and never allocates by itself.
template <class T>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) noexcept : value_(std::move(value)) {}
  constexpr Result(Errc error) noexcept : error_(error) { assert(error != Errc::ok); }

  constexpr explicit operator bool() const noexcept { return error_ == Errc::ok; }
  constexpr Errc error() const noexcept { return error_; }

  /// The value; a default-constructed one where error() is not ok.
  constexpr const T& value() const& noexcept { return value_; }
  constexpr T value() && noexcept { return std::move(value_); }
  /// The value, where there is one; of a result that is about to go a value of its own.
  constexpr const T& operator*() const& noexcept {
    assert(error_ == Errc::ok);
    return value_;
  }
  constexpr T operator*() && noexcept {
    assert(error_ == Errc::ok);
    return std::move(value_);
  }
  constexpr const T* operator->() const noexcept {
    assert(error_ == Errc::ok);
    return &value_;
  }

 private:
  T value_{};
  Errc error_ = Errc::ok;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
