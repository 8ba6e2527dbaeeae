// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/core/times.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/models/spinning/axial_torque.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"

/// The linear motion under a torque about the spin axis, by Taylor series.
namespace gyrostat::spinning {

/// Tilt, rad, beyond which a motion for small tilt is not followed: it says nothing any more, and steps get short where it grows on.
inline constexpr double senseless_tilt = 1e6;

template <Real Scalar>
struct AxialMotionOptions {
  std::uint64_t step_cap = 10'000'000;
  Monitor* monitor = nullptr;  ///< who watches, if anybody

  bool cancelled() const noexcept { return monitor != nullptr && monitor->cancelled(); }
};

template <Real Scalar>
struct AxialMotionAnswer {
  ode::Status status = ode::Status::reached;  ///< event: the tilt grew beyond senseless_tilt
  AxialSizes<Scalar> seen;                    ///< on the way
  ode::Counts counts;
};

/// The motion for small tilt at the given times (s from the start, increasing, the first >= 0), to rounding. What lies behind a failure
/// is NaN. Errors: not_increasing (times), not_finite (problem or times), out_of_domain (a span of the wrong length).
template <Real Scalar>
Result<AxialMotionAnswer<Scalar>> axial_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                               std::span<State<Scalar>> states,
                                               const AxialMotionOptions<Scalar>& options = {}) noexcept {
  using System = AxialTorqueSystem<Scalar>;
  if (states.size() != times.size()) return Errc::out_of_domain;
  if (const Errc wrong = check_span(times); wrong != Errc::ok) return wrong;
  const System system(problem);
  const Scalar end = times.empty() ? Scalar(0) : times.back();
  ode::TaylorOptions<Scalar, System::width> how;
  how.tolerance = epsilon<Scalar> / 8;
  how.step_cap = options.step_cap;
  how.scale = system.scale(end);
  for (const Scalar size : how.scale)
    if (!(size < infinity<Scalar>)) return Errc::not_finite;
  ode::Taylor<System> solver(system, 0, system.start(), how);

  AxialMotionAnswer<Scalar> answer;
  Scalar before = 0;
  const Scalar zeta = problem.greatest_zeta();
  const auto look = [&](const Scalar* x, Scalar since, Scalar t) noexcept {
    auto& [size, spin, phase, gross, left_out] = answer.seen;
    const Scalar rate = std::hypot(x[0], x[1]), tilt = std::hypot(x[2], x[3]);
    size.rate = std::max(size.rate, rate);
    size.tilt = std::max(size.tilt, tilt);
    spin = std::max(spin, std::abs(x[6]));
    phase = std::max(phase, std::abs(x[7]));
    gross += std::max(before, rate * tilt) * since / 2;
    before = rate * tilt;
    const Scalar stiff = problem.kappa1(system.spin(t)) * problem.kappa2(system.spin(t));
    const Scalar grown = stiff < 0 ? left_out * std::exp(since * std::sqrt(-stiff)) : left_out;
    left_out = std::max(grown + zeta * rate * std::abs(x[6]) * since, 8 * epsilon<Scalar> * rate);
  };
  look(system.start().data(), 0, 0);
  std::size_t next = 0;
  for (; next < times.size() && times[next] <= 0; ++next) states[next] = system.state(0, system.start().data());
  alignas(32) Scalar x[System::width];
  std::uint32_t trips = 0;
  while (next < times.size()) {
    answer.status = solver.step(end);
    if (answer.status != ode::Status::reached) break;
    // the tilt may be greatest between the ends of a step
    constexpr int looks = 8;
    const Scalar part = (solver.time() - solver.previous_time()) / looks;
    for (int i = 1; i <= looks; ++i) {
      const Scalar t = i < looks ? solver.previous_time() + Scalar(i) * part : solver.time();
      solver.at(t, x);
      look(x, part, t);
    }
    if (answer.seen.size.tilt > Scalar(senseless_tilt)) {
      answer.status = ode::Status::event;
      break;
    }
    for (; next < times.size() && times[next] <= solver.time(); ++next) {
      solver.at(times[next], x);
      states[next] = system.state(times[next], x);
    }
    if ((++trips & 255U) == 0 && options.cancelled()) {
      answer.status = ode::Status::cancelled;
      break;
    }
  }
  answer.counts = solver.counts();
  const Vec3<Scalar> nothing = Vec3<Scalar>::Constant(nan<Scalar>);
  constexpr Scalar none = nan<Scalar>;
  for (; next < times.size(); ++next)
    states[next] = {nothing, {none, none, none}, {none, none, none, none}, nothing, nothing, nothing};
  return answer;
}

}  // namespace gyrostat::spinning
