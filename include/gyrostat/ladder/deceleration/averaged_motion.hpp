// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "gyrostat/core/result.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/deceleration/averaged.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

namespace gyrostat::deceleration {

/// The averaged motion without rotor momentum at one moment.
template <Real Scalar>
struct MeanState {
  Scalar norm;  ///< |M|, N m s; 0 from the stop on
  Polhode<Scalar> polhode;
  Scalar phase;  ///< u/K, unwrapped; meaningless once the motion has crossed the separatrix
};

/// Advances the averaged equations forward in time, through the separatrix and down to rest. No heap, no throw, at most
/// `step_cap` steps.
template <class Elliptic, Real Scalar>
class AveragedMotion {
  using Equations = AveragedEquations<Elliptic, Scalar>;
  using State = typename Equations::State;

 public:
  static constexpr std::uint64_t step_cap = 20000;

  /// @param start     polhode at t = 0: through M for first order, the mean one for second order
  /// @param norm      |M| at t = 0, > 0
  /// @param phase     u/K at t = 0
  /// @param tolerance local error of ln|M|, of -ln kp2 and, relative to the despin time, of the time
  /// @param phase_error local error of the phase, in quarter periods; infinite where the phase is not wanted
  AveragedMotion(const Problem<Scalar>& problem, const Polhode<Scalar>& start, Scalar norm, Scalar phase,
                 Scalar tolerance, Scalar phase_error) noexcept
      : problem_(problem),
        norm0_(norm),
        log_rest_(std::log(std::max(tolerance, 64 * epsilon<Scalar>))),
        equations_(start, problem.control, problem.drag, norm),
        solver_(equations_, Scalar(0), equations_.state_of(start, norm, Scalar(0), phase),
                control_of(tolerance * time_scale(start), tolerance, phase_error, longest_step(problem))) {}

  /// Moves on to time t, or to where |M| sinks to `floor` if that is sooner (see floored); earlier times are not reached
  /// again. `visit(polhode, |M|)` sees
  /// every step's end.
  template <class Visitor>
  ode::Status advance(Scalar t, Scalar floor, Visitor visit) noexcept {
    const Scalar goal = std::log(floor / norm0_);
    const auto& y = solver_.state();
    while (!at_rest_ && !stuck_ && y[Equations::time] < t && y[Equations::log_norm] > goal) {
      if (const auto status = step(); status != ode::Status::reached) return status;
      visit(solver_.rhs().polhode(y), solver_.rhs().norm(y));
    }
    now_ = t;
    floored_ = false;
    if (y[Equations::log_norm] <= goal) {
      const Scalar when = solver_.at(locate(Equations::log_norm, goal))[Equations::time];
      floored_ = when < t;
      now_ = std::min(now_, when);
    }
    return ode::Status::reached;
  }

  bool floored() const noexcept { return floored_; }  ///< the last advance() ended at its floor
  Scalar time() const noexcept { return now_; }

  /// The state at time().
  MeanState<Scalar> state() noexcept {
    const State& end = solver_.state();
    if (now_ < end[Equations::time]) {
      const State y = solver_.at(locate(Equations::time, now_));
      return {solver_.rhs().norm(y), solver_.rhs().polhode(y), y[Equations::phase]};
    }
    const Polhode<Scalar> p = solver_.rhs().polhode(end);
    const Scalar M = solver_.rhs().norm(end), D = solver_.rhs().torque(p).deceleration;
    return {decayed(M, D, now_ - end[Equations::time]), p, end[Equations::phase]};
  }

  /// Time at which |M| vanishes, s; infinite where no control torque acts.
  Result<Scalar> stop_time() noexcept {
    if (problem_.control.isZero(0)) return infinity<Scalar>;
    while (!at_rest_ && !stuck_)
      if (step() != ode::Status::reached)
        return solver_.status() == ode::Status::step_limit ? Errc::step_limit : Errc::no_convergence;
    const State& end = solver_.state();
    const Scalar M = solver_.rhs().norm(end);
    const Scalar D = solver_.rhs().torque(solver_.rhs().polhode(end)).deceleration;
    if (!(D > 0)) return infinity<Scalar>;
    return end[Equations::time] + EqualTorqueLaw(D, problem_.drag, M).stop_time();
  }

  bool crossed() const noexcept { return crossing_norm_ > 0; }      ///< has passed through the separatrix
  Scalar crossing_norm() const noexcept { return crossing_norm_; }  ///< |M| where it did, N m s; 0 if it did not
  bool stuck() const noexcept { return stuck_; }  ///< the separatrix attracts from both sides and holds it
  const ode::Counts& counts() const noexcept { return solver_.counts(); }

 private:
  /// Where the clock of the mean equations ends: it tells e-folds of what the torque changes, or quarter periods of a free motion.
  static constexpr Scalar far_away = Scalar(1e9);

  /// In e-folds. Drag beside a control makes a time with poles pi off the clock: over longer steps the estimate of their error may be small by
  /// chance, as in 140 times what was asked. A free motion has no e-folds.
  static Scalar longest_step(const Problem<Scalar>& problem) noexcept {
    return problem.control.isZero(0) && problem.drag == 0 ? infinity<Scalar> : Scalar(2);
  }

  static ode::StepControl<Scalar, 4> control_of(Scalar time_error, Scalar tolerance, Scalar phase_error,
                                                Scalar longest) noexcept {
    ode::StepControl<Scalar, 4> control;
    control.longest_step = longest;
    control.relative = 0;
    control.absolute = {tolerance, tolerance, time_error, phase_error};
    control.first_step = Scalar(.2);
    control.step_cap = step_cap;
    return control;
  }

  /// About the time in which |M| falls by e at the start, s; infinite where nothing brakes it.
  Scalar time_scale(const Polhode<Scalar>& start) const noexcept {
    const Scalar fall = problem_.drag * norm0_ + equations_.torque(start).deceleration;
    return fall > 0 ? norm0_ / fall : infinity<Scalar>;
  }

  /// |M| a time dt after M under the constant mean torque D; never 0 where none acts, since drag alone brings nothing to rest.
  Scalar decayed(Scalar M, Scalar D, Scalar dt) const noexcept {
    const Scalar drag = problem_.drag, kept = M * std::exp(-drag * dt);
    if (D == 0) return std::max(kept, std::numeric_limits<Scalar>::denorm_min());
    return std::max(Scalar(0), kept - D * (drag > 0 ? -std::expm1(-drag * dt) / drag : dt));
  }

  ode::Status step() noexcept {
    if (!(solver_.time() < far_away)) return ode::Status::step_limit;
    if (const auto status = solver_.step(far_away); status != ode::Status::reached) return status;
    const State& y = solver_.state();
    if (y[Equations::log_norm] < log_rest_) at_rest_ = true;
    if (y[Equations::spread] > Equations::crossing && !solver_.rhs().polhode(y).axes.axisymmetric()) cross();
    return ode::Status::reached;
  }

  /// Point of the last step where component i, monotone there, has the given value; the nearer end if it has not, the first where it stays.
  Scalar locate(std::size_t i, Scalar value) noexcept {
    const Scalar low = solver_.previous_time(), high = solver_.time();
    const Scalar first = solver_.previous_state()[i], rise = solver_.state()[i] - first;
    // from the last place on, where that is near, or along the chord
    Scalar sigma = i == Equations::time ? near_.sigma + (value - near_.value) / near_.slope : nan<Scalar>;
    if (!(sigma >= low && sigma <= high)) sigma = low + (high - low) * (value - first) / rise;
    for (int trip = 0; trip < 6 && sigma >= low && sigma <= high; ++trip) {
      const auto [there, slope] = solver_.component(i, sigma);
      const Scalar off = value - there, further = off / slope;
      // to its own rounding: a torque that is hardly there makes steps of whatever length in time
      const bool there_already = std::abs(off) <= 4 * epsilon<Scalar> * std::abs(value);
      // a step of Newton's method so short is the last one
      const bool last = std::abs(further) <= Scalar(1e-9L) * (high - low);
      if (!there_already) sigma += further;
      if (!there_already && !last) continue;
      sigma = std::clamp(sigma, low, high);
      if (i == Equations::time) near_ = {value, sigma, slope};
      return sigma;
    }
    const auto root = math::bracketed_root([&](Scalar s) { return solver_.component(i, s)[0] - value; }, low, high);
    if (root) return *root;
    const bool before = std::abs(solver_.previous_state()[i] - value) <= std::abs(solver_.state()[i] - value);
    return before ? solver_.previous_time() : solver_.time();
  }

  /// Through the separatrix: the same spread and |M|, the other regime.
  void cross() noexcept {
    const Scalar sigma = locate(Equations::spread, Equations::crossing);
    State y = solver_.at(sigma);
    y[Equations::spread] = Equations::crossing;
    Polhode<Scalar> p = solver_.rhs().polhode(y);
    const Polhode<Scalar> here = p;
    p.regime = p.regime == Regime::about_largest ? Regime::about_smallest : Regime::about_largest;
    p.axes = PolhodeAxes<Scalar>::of(problem_.inverse_inertia, problem_.inverse_gaps(), p.regime);
    p = at_modulus(p, p.modulus);
    crossing_norm_ = solver_.rhs().norm(y);
    equations_ = Equations(p, problem_.control, problem_.drag, norm0_);
    if (equations_.torque(p).escape >= 0) {
      stuck_ = true;
      equations_ = Equations(here, problem_.control, problem_.drag, norm0_);
    }
    solver_.rhs() = equations_;
    solver_.restart(sigma, y);
  }

  Problem<Scalar> problem_;
  Scalar norm0_;
  Scalar
      log_rest_;  ///< ln |M|/|M(0)| from which the mean torque is taken as constant: what is left of the time is below the tolerance
  Equations equations_;
  ode::RungeKutta<Scalar, 4, Equations> solver_;
  /// The time that was looked for last, where it was found, and how fast it goes on there.
  struct Place {
    Scalar value = 0, sigma = nan<Scalar>, slope = 1;
  };
  Place near_;
  Scalar now_ = 0;
  Scalar crossing_norm_ = 0;
  bool stuck_ = false, at_rest_ = false, floored_ = false;
};

}  // namespace gyrostat::deceleration
