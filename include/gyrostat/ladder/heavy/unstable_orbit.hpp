// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"
#include "gyrostat/models/heavy/collocation.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

/// A periodic motion by collocation, from one found by shooting: for traces above 1e3, where a closure by shooting keeps few digits
/// (docs/heavy.md, section 4). closure is here the greatest gap between neighbouring nodes, each run on to the next; the trace is that of
/// the product of their derivatives. Seconds, and heap.
/// Errors: those of collocated_orbit.
template <Real Scalar>
Result<PeriodicOrbit<Scalar>> unstable_orbit(const Problem<Scalar>& problem, const PeriodicOrbit<Scalar>& guess,
                                             const CollocationOptions<Scalar>& options = {.first_nodes = 65}) {
  const Scalar spin = guess.start.angular_velocity[2], G0 = guess.start.down[2];
  const Scalar rate = rate_size(problem, guess.start);
  PeriodicOrbit<Scalar> orbit;
  orbit.method = OrbitMethod::collocation;

  std::vector<State<Scalar>> nodes(static_cast<std::size_t>(std::max(options.first_nodes, 5) | 1));
  nodes[0] = guess.start;
  // one motion from node to node; the last gap is left open
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const auto shot = shoot(problem, nodes[i - 1], guess.period / static_cast<Scalar>(nodes.size()));
    orbit.counts += shot.counts;
    if (shot.status != ode::Status::reached) return Errc::not_finite;
    nodes[i] = shot.end;
  }
  const auto found = collocated_orbit<Scalar>(problem, spin, G0, nodes, guess.period, options);
  if (!found) return found.error();

  const auto trace_of = [&](const Problem<Scalar>& of, const CollocatedOrbit<Scalar>& motion, Scalar tolerance,
                            Scalar* closure) {
    const std::size_t n = motion.nodes.size();
    Eigen::Matrix<Scalar, 6, 6> all = Eigen::Matrix<Scalar, 6, 6>::Identity();
    for (std::size_t i = 0; i < n; ++i) {
      const auto shot = shoot(of, motion.nodes[i], motion.period / static_cast<Scalar>(n), tolerance);
      orbit.counts += shot.counts;
      const auto& next = motion.nodes[(i + 1) % n];
      const Scalar gap = std::max((shot.end.angular_velocity - next.angular_velocity).norm() / rate,
                                  (shot.end.down - next.down).norm());
      if (closure != nullptr) *closure = std::max(*closure, gap);
      all = shot.derivative * all;
    }
    return all.trace();
  };
  orbit.start = guess.start;
  orbit.start.angular_velocity = found->nodes[0].angular_velocity;
  orbit.start.angular_velocity[2] = spin;
  orbit.period = found->period;
  orbit.trace_minus_4 = trace_of(problem, *found, epsilon<Scalar> / 8, &orbit.closure) - 4;
  orbit.shots = found->iterations;

  // what rounding of the data makes of it, and what the last harmonics do
  constexpr Scalar eps = epsilon<Scalar>;
  for (const Aside aside : {Aside::first, Aside::second}) {
    const detail::Neighbour<Scalar> near(problem, orbit.start, 8 * eps, aside);
    CollocatedOrbit<Scalar> other = *found;
    const Errc error = detail::Collocation<Scalar>(near.problem, spin, G0, rate).solve(other);
    const Scalar failed = error == Errc::ok ? Scalar(0) : infinity<Scalar>;
    const Scalar trace = trace_of(near.problem, other, 8 * eps, nullptr) - 4;
    orbit.error.period = std::max(orbit.error.period, std::abs(other.period / orbit.period - 1) + failed);
    orbit.error.trace = std::max(orbit.error.trace, std::abs(trace - orbit.trace_minus_4) + failed);
    orbit.error.start = std::max(
        orbit.error.start, (other.nodes[0].angular_velocity - orbit.start.angular_velocity).norm() / rate + failed);
  }
  const Scalar blur = 8 * eps + 4 * found->tail + 4 * orbit.closure;
  orbit.error.period += blur;
  orbit.error.start += blur;
  orbit.error.trace += blur * (1 + std::abs(orbit.trace_minus_4)) * static_cast<Scalar>(found->nodes.size());
  orbit.multipliers = multipliers(orbit.trace_minus_4);
  orbit.stability = orbit_stability(orbit.trace_minus_4, orbit.error.trace);
  return orbit;
}

}  // namespace gyrostat::heavy
