// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/real.hpp"

namespace gyrostat::ode {

/// y a time h later on y' = f(y), by one step of Runge and Kutta's classical method (order 4), for what needs few digits: the
/// caller chooses the step. State: a number or a vector that can be added and multiplied by a number.
template <class State, Real Scalar, class F>
[[nodiscard]] State classical_step(const F& f, const State& y, Scalar h) noexcept {
  const State a = f(y);
  const State b = f(State(y + h / 2 * a));
  const State c = f(State(y + h / 2 * b));
  const State d = f(State(y + h * c));
  return y + h / 6 * (a + Scalar(2) * b + Scalar(2) * c + d);
}

}  // namespace gyrostat::ode
