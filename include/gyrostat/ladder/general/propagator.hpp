// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/free/reduced.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A state moved on by one step of a loop, and by how much it may be off then.
namespace gyrostat::general {

/// What moves: attitude, rates, and rates of the wheels relative to the body, in the order of the problem.
struct Moving {
  Quat<double> attitude{};                       ///< body to inertial
  Vec3<double> angular_velocity{0, 0, 0};        ///< body axes, rad/s
  std::array<double, most_wheels> rotor_rate{};  ///< rad/s
};

/// How far a state may be from the true one.
struct MovedError {
  double attitude = 0;          ///< rad
  double angular_velocity = 0;  ///< length of its error, rad/s
  double rotor_rate = 0;        ///< length of its error, rad/s
};

/// Moves states of one body on. Where nothing acts on it and no wheel is driven or slowed that is the closed form of `models/free`, which
/// takes no memory from the heap; else, and where rounding hides on which side of a separatrix the motion runs, it is the full equations.
class Propagator {
 public:
  /// Steps that one run of the full equations may take: a second or two in all, where none of the runs does with fewer.
  static constexpr std::uint64_t step_cap = 100'000;

  Propagator() = default;

  /// Why states alone do not tell how the body moves on; nullptr: they do. Of a problem that check() finds right.
  GYROSTAT_COMPILED_ONCE static const char* clock_needed(const Problem<double>& problem) noexcept;

  /// Of body, wheels and torques of a problem, whose start does not matter. tolerance: of the full equations; the closed form is set up in
  /// double where that errs by less than a thousandth of it, else to twice the digits: errors of steps that follow each other grow faster than their number.
  /// Errors: those of check(); out_of_domain: the tolerance; not_applicable: clock_needed; beyond_range: moments of inertia.
  GYROSTAT_COMPILED_ONCE static Result<Propagator> make(const Problem<double>& problem, double tolerance);

  std::size_t wheels() const noexcept { return wheels_.count; }
  bool is_closed_form() const noexcept { return closed_; }

  /// Moves a state on by dt >= 0, s. error: how far it may be then from that to which the given state moves, where that is right to
  /// a rounding; infinite where rounding decides, as on an unstable axis for long. nullptr saves most of the time of a closed form. Errors, which leave the
  /// state as it is: not_finite; negative (dt); out_of_domain: an attitude that is not of unit length to 1e-6, or a locked wheel that turns; not_applicable: a
  /// brake stops the body where wheels or other torques set it going again in a way that is not followed (models/general/rest.hpp); undetermined: the body
  /// turns so often that no double knows its phase; step_limit and no_convergence.
  GYROSTAT_COMPILED_ONCE Errc advance(double dt, Moving& state, MovedError* error = nullptr) const noexcept;

 private:
  static constexpr double quick_share = 1e-3;
  using Room = free::AtMost<most_wheels>;
  template <Real Scalar>
  using Assembly = free::Assembly<Scalar, Room>;

  GYROSTAT_COMPILED_ONCE bool find_closed_form() const noexcept;
  GYROSTAT_COMPILED_ONCE Errc check_state(double dt, const Moving& state) const noexcept;
  GYROSTAT_COMPILED_ONCE Assembly<double> assembly_of(const Moving& state) const noexcept;
  /// The momenta of the wheels at these rates and the fixed one, summed without their directions, N m s.
  GYROSTAT_COMPILED_ONCE double momenta_of(const Moving& state) const noexcept;
  /// Nothing where the closed form does not know the motion.
  GYROSTAT_COMPILED_ONCE std::optional<Errc> advance_freely(double dt, const Moving& begin, Moving& state,
                                                            MovedError* error) const noexcept;
  GYROSTAT_COMPILED_ONCE Errc advance_fully(double dt, const Moving& begin, Moving& state,
                                            MovedError* error) const noexcept;

  Problem<double> problem_;
  Wheels<double> wheels_;
  double tolerance_ = 1e-9;
  bool closed_ = false;
};

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/propagator_definition.hpp"
#endif
