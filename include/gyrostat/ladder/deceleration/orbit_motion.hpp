// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/math/root.hpp"
#include "gyrostat/models/deceleration/capture.hpp"
#include "gyrostat/models/deceleration/orbit_second_order.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

namespace gyrostat::deceleration {

/// Mean rates on a level.
template <Real Scalar>
struct MeanRates {
  SlowRates<Scalar> rates;
  Scalar phase_rate = 0;  ///< turns per second
};

/// Right-hand side of the mean equations over free orbits with rotor momentum, in a clock that slows down towards the
/// stop: dt/dsigma = 1/(drag + b/|U|). State: ln(R/R0), eta [rad/s], t [s], phase [turns].
/// `rates.at(problem, level, component)` gives a Result of MeanRates, `rates.accept(problem, level, component)` says
/// of every accepted step.
template <class Rates, Real Scalar>
struct OrbitEquations {
  using State = std::array<Scalar, 4>;
  enum Index : int { log_norm, eta, time, phase };

  Problem<Scalar> problem;
  Scalar reference;    ///< R0, N m s
  Component followed;  ///< the curve that the last accepted step was on
  Rates rates{};
  Errc failure = Errc::ok;  ///< of the last evaluation that had no value

  Level<Scalar> level(const State& y) const noexcept { return {reference * std::exp(y[log_norm]), y[eta]}; }

  /// What the control opposes: |M|, or about |J omega|, N m s.
  Scalar opposed(const Level<Scalar>& at) const noexcept {
    if (problem.law == Law::total) return at.R;
    return std::sqrt(2 * std::max(Scalar(0), energy_of(problem, at)) / problem.inverse_inertia[1]);
  }

  void operator()(Scalar, const State& y, State& dy) noexcept {
    const Level<Scalar> at = level(y);
    const auto mean = rates.at(problem, at, followed);
    if (!mean) {
      if (std::isfinite(at.R) && std::isfinite(at.eta)) failure = mean.error();
      dy.fill(nan<Scalar>);
      return;
    }
    const Scalar b = problem.control.diagonal().maxCoeff(), U = opposed(at);
    const Scalar fading = problem.drag + (b > 0 ? b / U : Scalar(0));
    const Scalar dt = fading > 0 ? 1 / fading : 1 / std::abs(mean->phase_rate);
    dy[log_norm] = mean->rates.R / at.R * dt;
    dy[eta] = mean->rates.eta * dt;
    dy[time] = dt;
    dy[phase] = mean->phase_rate * dt;
  }
};

/// First order: the averages over the free orbit.
template <class Elliptic>
struct FirstOrderRates {
  static constexpr double longest_step = 2;
  static constexpr bool smooth = false;  // beside a separatrix and an equilibrium
  static constexpr std::uint64_t step_cap = 5000;

  template <Real Scalar>
  Result<MeanRates<Scalar>> at(const Problem<Scalar>& problem, const Level<Scalar>& level,
                               Component followed) const noexcept {
    const auto mean = average<Elliptic>(problem, level, followed);
    if (!mean) return mean.error();
    const MeanRates<Scalar> rates{mean->rates, 1 / mean->period};
    const Scalar beyond = level.eta - mean->level.eta;
    return mean->component.regime == Regime::point && beyond != 0
               ? continued(problem, mean->level, rates, beyond, followed)
               : rates;
  }

  /// The rates beyond an equilibrium, where stages of a step may go and the motion does not: the parabola through those of the equilibrium and of two
  /// levels as far on its other side, since a kink misleads the step control. Without such levels those of the equilibrium.
  template <Real Scalar>
  static MeanRates<Scalar> continued(const Problem<Scalar>& problem, const Level<Scalar>& end,
                                     const MeanRates<Scalar>& rates, Scalar beyond, Component followed) noexcept {
    const auto one = average<Elliptic>(problem, Level<Scalar>{end.R, end.eta - beyond}, followed);
    const auto two = average<Elliptic>(problem, Level<Scalar>{end.R, end.eta - 2 * beyond}, followed);
    if (!one || !two || one->component.regime != two->component.regime) return rates;
    const auto by = [](Scalar zero, Scalar first, Scalar second) noexcept { return 3 * (zero - first) + second; };
    return {{by(rates.rates.R, one->rates.R, two->rates.R), by(rates.rates.h, one->rates.h, two->rates.h),
             by(rates.rates.eta, one->rates.eta, two->rates.eta)},
            by(rates.phase_rate, 1 / one->period, 1 / two->period)};
  }

  template <Real Scalar>
  void accept(const Problem<Scalar>&, const Level<Scalar>&, Component) noexcept {}
};

/// Second order: f2 and the drift of the phase. Keeps the orbit of the last accepted step, so that the origin of the
/// phase goes on without a jump.
template <class Elliptic, Real Scalar>
struct SecondOrderRates {
  static constexpr Scalar longest_step = Scalar(.25);  // neighbouring orbits must resemble each other
  static constexpr bool smooth = true;                 // there it has no value
  static constexpr std::uint64_t step_cap = 600;
  static constexpr Scalar most_oscillation = Scalar(.5);  // of the phase, turns

  Orbit<Scalar, Elliptic> reference;
  bool phase_lost = false;  ///< the orbits of two steps differ too much to compare their phases

  Result<MeanRates<Scalar>> at(const Problem<Scalar>& problem, const Level<Scalar>& level,
                               Component followed) const noexcept {
    const auto mean = second_order<Elliptic>(problem, level, followed, &reference, nullptr, false);
    if (!mean) return mean.error();
    // else it would lead along the separatrix, where the second order is as large as the first
    if (!(mean->phase_oscillation < most_oscillation)) return Errc::separatrix;
    SlowRates<Scalar> rates = mean->first;
    rates.R += mean->second.R;
    rates.h += mean->second.h;
    rates.eta += mean->second.eta;
    return MeanRates<Scalar>{rates, mean->phase_rate};
  }
  void accept(const Problem<Scalar>& problem, const Level<Scalar>& level, Component component) noexcept {
    const auto orbit = Orbit<Scalar, Elliptic>::at(problem, level, component);
    if (!orbit || orbit->regime() != reference.regime()) {
      phase_lost = true;
      if (orbit) reference = *orbit;
      return;
    }
    Scalar doubt = 0;
    reference = orbit->aligned_to(reference, &doubt);
    phase_lost = phase_lost || !(doubt < Scalar(.2));
  }
};

/// The energy over those whose difference it is, where rotors hold most of them, but no less than a thousandth: the mean equations are
/// integrated to so much of a tolerance, for what is slow at a low energy changes with R and eta by so much more.
template <Real Scalar>
Scalar energy_share(const Problem<Scalar>& problem, const Level<Scalar>& level) noexcept {
  const Scalar whole = level.R * (problem.inverse_inertia[2] * level.R + problem.gyro_rate().norm());
  return whole > 0 ? std::clamp(2 * energy_of(problem, level) / whole, Scalar(1e-3L), Scalar(1)) : Scalar(1);
}

/// Advances mean equations over free orbits forward in time. No heap, no throw, at most step_cap steps. A motion whose
/// further way the averages do not determine (capture from one component into one of two lobes) ends with
/// failure() == undetermined.
template <class Rates, Real Scalar>
class OrbitMotion {
  using Equations = OrbitEquations<Rates, Scalar>;
  using State = typename Equations::State;

 public:
  struct Sample {
    Level<Scalar> level;
    Component component;
    Scalar phase;  ///< turns
    bool at_rest;  ///< the control has reached its goal
  };

  /// @param tolerance local error of ln R, of eta relative to its scale and of the time
  /// @param phase_error local error of the phase in turns; infinite where the phase is not wanted
  OrbitMotion(const Problem<Scalar>& problem, const Level<Scalar>& start, Component component, Scalar phase,
              Scalar tolerance, Scalar phase_error, const Rates& rates = {},
              std::uint64_t step_cap = Rates::step_cap) noexcept
      : start_opposed_(Equations{problem, start.R, component}.opposed(start)),
        solver_(Equations{problem, start.R, component, rates}, Scalar(0), State{0, start.eta, 0, phase},
                control_of(problem, start, component, rates, tolerance, phase_error, step_cap)),
        component_(component) {}

  /// Moves on to time t, or to the step in which the control comes to oppose no more than `floor` [N m s] if that is
  /// sooner (see floored). `visit(level, component, t)` sees every step's end.
  template <class Visitor>
  ode::Status advance(Scalar t, Scalar floor, Visitor visit) noexcept {
    const auto& y = solver_.state();
    while (!at_rest_ && !parted_ && y[Equations::time] < t && opposed() > floor)
      if (const auto status = step(visit); status != ode::Status::reached && !parted_) return status;
    if (parted_) return comes_before_parting(t, visit) ? ode::Status::reached : ode::Status::event;
    floored_ = opposed() <= floor && y[Equations::time] < t;
    now_ = floored_ ? y[Equations::time] : t;
    return ode::Status::reached;
  }
  bool floored() const noexcept { return floored_; }

  /// What the control opposes has come to nothing, or all but.
  bool ended() const noexcept { return at_rest_; }

  /// The motion stands, between the end of its last step and the stop, and for ever where drag alone brakes: what the torques oppose sinks from opposed() to
  /// nothing there.
  bool stands() const noexcept {
    const Scalar end = solver_.state()[Equations::time];
    return at_rest_ && now_ > end && (!controlled() || now_ < end + remainder());
  }

  Scalar time() const noexcept { return now_; }

  Sample sample() noexcept {
    const State& end = solver_.state();
    if (now_ < end[Equations::time]) {
      const State y = solver_.at(locate(now_));
      return {solver_.rhs().level(y), solver_.rhs().followed, y[Equations::phase], false};
    }
    return {solver_.rhs().level(end), component_, end[Equations::phase],
            at_rest_ && controlled() && now_ >= end[Equations::time] + remainder()};
  }

  /// Time at which the control reaches its goal, s; infinite where no control acts. From where it opposes no more than `near` [N m s] on what is
  /// left is told from the mean rate there.
  template <class Visitor>
  Result<Scalar> stop_time(Visitor visit, Scalar near = 0) noexcept {
    if (!controlled()) return infinity<Scalar>;
    if (parted_) return failure();
    while (!at_rest_ && opposed() > near)
      if (step(visit) != ode::Status::reached) return failure();
    return solver_.state()[Equations::time] + remainder();
  }

  /// |U| at the end of the last step.
  Scalar opposed() const noexcept { return solver_.rhs().opposed(solver_.rhs().level(solver_.state())); }

  /// Why the motion could not go on.
  Errc failure() const noexcept {
    if (solver_.status() == ode::Status::step_limit || !(solver_.time() < far_away)) return Errc::step_limit;
    return solver_.rhs().failure == Errc::ok ? Errc::no_convergence : solver_.rhs().failure;
  }
  /// Level and curve at the end of the last accepted step.
  Level<Scalar> last_level() const noexcept { return solver_.rhs().level(solver_.state()); }
  Component last_component() const noexcept { return component_; }
  const Rates& rates() const noexcept { return solver_.rhs().rates; }
  bool changed_component() const noexcept { return changed_; }
  /// Whether it may have by this time.
  bool changed_by(Scalar t) const noexcept { return changed_ && unchanged_until_ < t; }
  /// Whether the motion has gone to a curve where it does not belong: its energy is not known from there on.
  bool doubtful() const noexcept { return doubtful_; }
  /// What the turns beside separatrices that were crossed have changed of the energy against theirs, J: nobody knows in which of them it was.
  Scalar crossing() const noexcept { return crossing_; }
  /// Behind a failure `undetermined` on a separatrix: the chance of the likelier way on; else NaN.
  Scalar chance() const noexcept { return chance_; }
  const ode::Counts& counts() const noexcept { return solver_.counts(); }

 private:
  /// Where the clock of the mean equations ends: it tells e-folds of what the torque changes, or turns of a free motion.
  static constexpr Scalar far_away = Scalar(1e9);

  /// Short enough that the distance from a separatrix, by kp2, changes by half at most: beside it the rates are singular, which a step far over that
  /// distance would not see.
  static Scalar first_step(const Equations& equations, const Level<Scalar>& start) noexcept {
    Scalar step = Scalar(.02);
    const auto orbit = Orbit<Scalar>::at(equations.problem, start, equations.followed);
    if (!orbit || !(orbit->modulus().kp2 < Scalar(.1))) return step;
    Equations trial = equations;
    const State y{0, start.eta, 0, 0};
    State slope;
    trial(Scalar(0), y, slope);
    const Scalar kp2 = orbit->modulus().kp2;
    for (int trip = 0; trip < 60; ++trip, step /= 4) {
      const auto moved = Orbit<Scalar>::at(
          equations.problem,
          equations.level({step * slope[Equations::log_norm], start.eta + step * slope[Equations::eta], 0, 0}),
          equations.followed);
      if (moved && moved->regime() == orbit->regime() && std::abs(moved->modulus().kp2 - kp2) <= kp2 / 2) break;
    }
    return step;
  }

  static ode::StepControl<Scalar, 4> control_of(const Problem<Scalar>& problem, const Level<Scalar>& start,
                                                Component component, const Rates& rates, Scalar tolerance,
                                                Scalar phase_error, std::uint64_t step_cap) noexcept {
    ode::StepControl<Scalar, 4> control;
    control.relative = 0;
    const Scalar swing = problem.inverse_inertia[2] * start.R + problem.gyro_rate().norm();
    const Scalar b = problem.control.diagonal().maxCoeff();
    const Scalar fading = problem.drag + (b > 0 ? b / start.R : Scalar(0));
    const Scalar local = tolerance * energy_share(problem, start);
    // beside an equilibrium the width of the orbit is the root of how far the energy is from its own
    Scalar beside = local * swing;
    if (const auto band = band_of(problem, start))
      for (const auto* end : {&band->below, &band->above})
        if (end->kind != Critical::saddle) beside = std::min(beside, std::abs(end->eta - start.eta) / 64);
    beside = std::max(beside, std::min(local, Scalar(1e-13)) * swing);
    control.absolute = {local, beside, fading > 0 ? tolerance / fading : infinity<Scalar>, phase_error};
    control.smooth = Rates::smooth;
    control.first_step = first_step(Equations{problem, start.R, component, rates}, start);
    control.longest_step = Rates::longest_step;
    control.step_cap = step_cap;
    return control;
  }

  template <class Visitor>
  ode::Status step(Visitor visit) noexcept {
    if (!(solver_.time() < far_away)) return ode::Status::step_limit;
    solver_.rhs().followed = component_;  // and no sooner: the dense output of the last step still needs the old one
    const Level<Scalar> from = solver_.rhs().level(solver_.state());
    const Scalar begin = solver_.state()[Equations::time];
    if (const auto status = solver_.step(far_away); status != ode::Status::reached) return status;
    const Level<Scalar> at = solver_.rhs().level(solver_.state());
    const auto orbit = Orbit<Scalar>::at(solver_.rhs().problem, at, component_);
    if (orbit) {
      Component now = orbit->component();
      if (now.regime != Regime::point) {
        const bool known = around_.regime != Regime::point;
        if (known && (now.regime != around_.regime || now.branch != around_.branch)) {
          if (!changed_) unchanged_until_ = begin;
          changed_ = true;
          if (!cross(from, at, now)) {
            parted_ = true;
            return ode::Status::event;
          }
        }
        around_ = now;
      }
      component_ = now;
      solver_.rhs().rates.accept(solver_.rhs().problem, at, now);
    }
    visit(at, component_, solver_.state()[Equations::time]);
    // the energy near rest is a difference of numbers of size S0: below its rounding nothing is left to follow
    const Scalar floor = solver_.rhs().problem.law == Law::carrier
                             ? 64 * std::sqrt(epsilon<Scalar> * solver_.rhs().problem.rotor_energy_scale() /
                                              solver_.rhs().problem.inverse_inertia[1])
                             : Scalar(0);
    at_rest_ = opposed() <= std::max(Scalar(1e-8) * start_opposed_, floor);
    return ode::Status::reached;
  }

  /// Whether t lies in the step in which motions part, on the curve that they come from: then goes there.
  template <class Visitor>
  bool comes_before_parting(Scalar t, Visitor visit) noexcept {
    if (!(t <= solver_.state()[Equations::time])) return false;
    const Level<Scalar> there = solver_.rhs().level(solver_.at(locate(t)));
    const auto orbit = Orbit<Scalar>::at(solver_.rhs().problem, there, component_);
    if (!orbit || orbit->regime() != around_.regime || orbit->component().branch != around_.branch) return false;
    visit(there, component_, t);
    now_ = unchanged_until_ = t;
    floored_ = false;
    return true;
  }

  /// Takes the motion over a separatrix between two levels, where it was found on `now` behind it: into the lobe, or outside, where all motions
  /// go; false where they part. Where no separatrix is so near rounding beside an equilibrium has taken one curve for another.
  bool cross(const Level<Scalar>& from, const Level<Scalar>& to, Component& now) noexcept {
    const auto& problem = solver_.rhs().problem;
    if (const auto band = band_of(problem, from)) {
      const Scalar range = (band->above.eta - band->below.eta) / (band->to_above + band->to_below);
      const Scalar moved = std::abs(to.eta - from.eta) / range + std::abs(to.R - from.R) / to.R;
      if (moved < band->separatrix_distance() / 4) return doubtful_ = true;
    }
    if (problem.rotor_momentum.isZero(0)) {  // lobes mirror each other
      for (const Component& side : {around_, now})
        if (const auto flow = inflow_at_saddle(problem, to.R, side)) crossing_ += std::abs(*flow);
      return true;
    }
    const Regime lobes = now.regime == Regime::one_component ? around_.regime : now.regime;
    const auto next = capture(problem, to.R, lobes, around_);
    if (next && next->determined()) {
      const Component there = next->outside == 1 ? Component{} : Component{lobes, next->plus == 1 ? 1 : -1};
      // a step that goes on beside the separatrix has missed the lobe
      if (there.regime != now.regime) return doubtful_ = true;
      now = there;
      crossing_ += std::abs(next->inflow_plus) + std::abs(next->inflow_minus);
      return true;
    }
    if (next) chance_ = std::max({next->plus, next->minus, next->outside});
    solver_.rhs().failure = next ? Errc::undetermined : Errc::separatrix;
    return false;
  }

  /// Whether a control acts: drag alone brings nothing to rest.
  bool controlled() const noexcept { return solver_.rhs().problem.control.diagonal().maxCoeff() > 0; }

  /// Time from the end of the last step to the stop, with |U| falling at its present mean rate.
  Scalar remainder() const noexcept {
    const auto& f = solver_.rhs();
    const State &y = solver_.state(), &dy = solver_.derivative();
    const Scalar dt = dy[Equations::time];
    if (f.problem.law == Law::total) return -dt / dy[Equations::log_norm];
    const Level<Scalar> at = f.level(y);
    const Scalar dh = at.R * (dy[Equations::eta] + at.eta * dy[Equations::log_norm]) / dt;
    const Scalar left = -2 * energy_of(f.problem, at) / dh;
    return left > 0 ? left : Scalar(0);  // of an energy that is all rounding, at an equilibrium, nothing is left
  }

  /// Place of a time inside the last step.
  Scalar locate(Scalar t) noexcept {
    const auto root = math::bracketed_root([&](Scalar sigma) { return solver_.at(sigma)[Equations::time] - t; },
                                           solver_.previous_time(), solver_.time());
    return root ? *root : solver_.previous_time();
  }

  Scalar start_opposed_;
  ode::RungeKutta<Scalar, 4, Equations> solver_;
  Component component_, around_ = component_;  ///< the curve; the last one that is not a point
  Scalar now_ = 0, chance_ = nan<Scalar>, crossing_ = 0;
  Scalar unchanged_until_ = infinity<Scalar>;
  bool parted_ = false;  ///< within the last step motions go different ways
  bool at_rest_ = false, changed_ = false, doubtful_ = false, floored_ = false;
};

}  // namespace gyrostat::deceleration
