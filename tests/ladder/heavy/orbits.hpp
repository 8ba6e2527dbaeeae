// SPDX-License-Identifier: BSD-3-Clause
// Checks of periodic motions of heavy bodies that know nothing of how they were found.
#pragma once

#include <algorithm>

#include "catch.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/ode/taylor.hpp"

namespace gyrostat::heavy {

/// The motion after t, by the equations without variations.
template <Real S>
State<S> later(const Problem<S>& problem, const State<S>& start, S t) {
  using System = FullSystem<S>;
  const System system(problem, start);
  typename ode::Taylor<System>::Options options;
  options.tolerance = epsilon<S> / 16;
  options.scale = system.scale();
  ode::Taylor<System> solver(system, 0, system.start(), options);
  CHECK(solver.advance(t) == ode::Status::reached);
  return system.state(solver.state());
}

/// Greatest of |w(T) - w(0)|/rate_size and |down(T) - down(0)|.
template <Real S>
S gap(const Problem<S>& problem, const State<S>& start, S period) {
  const State<S> end = later(problem, start, period);
  return std::max<S>((end.angular_velocity - start.angular_velocity).norm() / rate_size(problem, start),
                     (end.down - start.down).norm());
}

}  // namespace gyrostat::heavy
