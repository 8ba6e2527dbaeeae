// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/averaging.hpp"
#include "gyrostat/ladder/deceleration/cost.hpp"
#include "gyrostat/ladder/deceleration/orbit_kind.hpp"
#include "gyrostat/ladder/deceleration/orbit_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/models/deceleration/capture.hpp"

/// Rungs `averaged` and `averaged-2` with rotor momentum, or with actuators off the principal axes.
namespace gyrostat::deceleration {

namespace detail {

/// What |M| and the energy may be off by where it is not known on which curve the body moves, between the level `from` and an end: the torques' mean
/// rates on one and another differ by as much as moments, controls and the rotors' share of M do.
inline SlowError<double> on_another_curve(const Problem<double>& problem, const Level<double>& from, double R_end,
                                          double energy_end) noexcept {
  const Vec3<double>& a = problem.inverse_inertia;
  const Vec3<double> b = problem.control.diagonal();
  const double R = problem.momentum.norm(), controls = b.maxCoeff() > 0 ? 1 - b.minCoeff() / b.maxCoeff() : 0.0;
  const double rotors = 2 * problem.rotor_momentum.norm() / std::max(R, problem.rotor_momentum.norm());
  const double of_norm = std::min(1.0, controls + rotors), of_energy = std::min(1.0, 1 - a[0] / a[2] + of_norm);
  return {of_norm * std::abs(from.R - R_end), of_energy * std::abs(energy_of(problem, from) - energy_end), 0, 0};
}

}  // namespace detail

/// Collects at some levels along a mean motion what its error is made of (SecondOrder), and says how large it is.
/// First order leaves out the oscillation and f2; second order leaves out the oscillation of second order and, in the
/// phase, that of first and the drift that its own error of the level makes. The factors are measured (docs/errors.md).
template <class Elliptic>
class OrbitError {
 public:
  static constexpr double first_factor = 6, second_factor = 15, crossing_factor = 4, start_factor = 1.5;
  static constexpr double phase_factor = 3, drift_factor = 2;  // of M

  /// breakdown: |M| below which the averages tell nothing, N m s; second: whether the errors of second order are wanted
  OrbitError(const Problem<double>& problem, double breakdown, bool second) noexcept
      : problem_(problem), breakdown_(breakdown), wants_second_(second) {}

  /// Looks at a level of the motion at time t, s, unless one like it was seen just before.
  void visit(const Level<double>& level, Component component, double t) noexcept {
    const double opposed = problem_.law == Law::total ? level.R : std::sqrt(std::max(0.0, energy_of(problem_, level)));
    const bool is_soon = t - last_ < spacing_ * t && opposed > (1 - spacing_) * last_opposed_ &&
                         std::abs(level.R - last_R_) < spacing_ * last_R_;
    if (is_soon && !swells(level, component)) return;
    last_opposed_ = opposed;
    look(level, component, t);
  }

  /// Looks at it in any case, as at the last asked time: the motion may end beside a separatrix.
  void look(const Level<double>& level, Component component, double t) noexcept {
    const double span = std::max(0.0, t - last_);
    last_ = std::max(last_, t);
    last_R_ = level.R;
    if (const auto orbit = Orbit<double, Elliptic>::at(problem_, level, component))
      last_modulus_ = orbit->modulus(), last_period_ = orbit->period();
    swing_ = 0;
    take(level, component, t, span);
    const bool is_sure = !(t > 0) || first_factor * (mirrored_ ? swing_ : first_.k2) < 1;
    if (is_sure && was_unsure_) {
      const auto off = detail::on_another_curve(problem_, sure_, level.R, energy_of(problem_, level));
      astray_.norm += off.norm, astray_.energy += off.energy;
    }
    if (is_sure) sure_ = level;
    was_unsure_ = !is_sure;
  }

  /// What |M| and the energy of a motion that ends there may be off by because it was not known all the way on which curve the body moves. Behind a separatrix
  /// that is known again where the lobes mirror each other.
  SlowError<double> astray(double R_end, double energy_end) const noexcept {
    auto off = detail::on_another_curve(problem_, sure_, R_end, energy_end);
    off.norm += astray_.norm, off.energy += astray_.energy;
    return off;
  }

  /// False where some level had no second order: the errors below are then not bounds.
  bool known() const noexcept { return known_; }
  double phase_oscillation() const noexcept { return change_; }
  /// Whether the error of the start leads over a separatrix: then the mean motion may begin on its other side, and lead elsewhere.
  bool start_is_unclear() const noexcept { return unclear_; }

  SlowError<double> first_order() const noexcept {
    const double f = first_factor;
    return {f * (first_.norm + drift_R_) + start_factor * drift_start_, f * (first_.energy + drift_h_),
            std::min(1.0, f * first_.k2), 0};
  }
  /// The same with what the turns beside separatrices have changed of the energy, J: nobody knows in which of them they were crossed.
  SlowError<double> first_order_across(double crossed) const noexcept {
    auto made = first_order();
    const double energy = crossing_factor * crossed;
    made.energy += energy;
    made.norm += energy / (2 * scales(problem_)[column::energy]) * problem_.momentum.norm();
    return made;
  }
  SlowError<double> second_order_error() const noexcept {
    const double f = second_factor;
    return {f * second_.norm, f * second_.energy, std::min(1.0, f * second_.k2), second_.vector + f * second_.norm};
  }

 private:
  static constexpr double spacing_ = 0.25;

  /// What second order says of the level, `span` s after the one before.
  void take(const Level<double>& level, Component component, double t, double span) noexcept {
    const auto s = second_order<Elliptic>(problem_, level, component);
    if (!s) {
      const bool on_equilibrium = s.error() == Errc::not_applicable || is_narrow(level, component);
      known_ = known_ && on_equilibrium;
      if (on_equilibrium) visit_equilibrium(level, component);
      else swing_ = 1;
      return;
    }
    // What second order leaves out: its own oscillation, or that of first order times the change during it.
    const double shift = 2 * pi<double> * s->phase_oscillation + s->orbit.period() * std::abs(s->first.R) / level.R;
    const bool rests =
        problem_.law == Law::total;  // then no more can be wrong than there is, or there was where the averages ended
    const double most = most_off(level);
    const double off = std::min(s->oscillation.R, most);
    drift_R_ += std::min(std::abs(s->second.R), rests ? std::abs(s->first.R) : infinity<double>) * span;
    // and what the oscillation, by which the mean motion begins beside the true one, changes of the rates
    if (!(t > 0)) start_R_ = s->oscillation.R, start_eta_ = s->oscillation.eta;
    drift_start_ += std::min(std::abs(s->along_R) * start_R_ + std::abs(s->along_eta) * start_eta_,
                             rests ? std::abs(s->first.R) : infinity<double>) *
                    span;
    // and what the error of |M| changes of the rate: its oscillation, part of which the mean motion begins with, and its own drift
    const double share = (off + drift_R_) / level.R;
    drift_h_ += std::min(std::abs(s->second.h) + std::abs(s->first.h) * share,
                         rests ? std::abs(s->first.h) : infinity<double>) *
                span;
    keep(first_.norm, off);
    keep(first_.energy, std::min(s->oscillation.h, problem_.inverse_inertia[2] * most * most));
    keep_k2(k2_swing(*s, level, component, s->oscillation.R, s->oscillation.eta));
    const double size = std::sqrt(std::max(0.0, transverse(s->orbit)));
    if (wants_second_) take_second(*s, level, component, shift, size, span);
    if (!(t > 0)) {
      const double f = first_factor;
      unclear_ = !(k2_swing(*s, level, component, f * s->oscillation.R, f * s->oscillation.eta) < 1);
    }
    swing_aside(*s, size, span);
    keep(change_, s->phase_oscillation);
  }

  /// size: of the orbit, N m s.
  void take_second(const SecondOrder<double, Elliptic>& s, const Level<double>& level, Component component,
                   double shift, double size, double span) noexcept {
    const double R = std::max(s.second_oscillation.R, s.oscillation.R * shift);
    const double eta = std::max(s.second_oscillation.eta, s.oscillation.eta * shift);
    keep(second_.norm, R);
    keep(second_.energy, std::max(s.second_oscillation.h, s.oscillation.h * shift));
    keep(second_.k2, k2_swing(s, level, component, s.second_oscillation.R, s.second_oscillation.eta));
    drift_phase_ += detuning(s, level, component, R, eta) * span;
    keep(second_.vector, 2 * pi<double> * size * (phase_factor * s.phase_oscillation + drift_factor * drift_phase_));
  }

  /// Of |M|, N m s.
  double most_off(const Level<double>& level) const noexcept {
    return problem_.law == Law::total ? std::max(level.R, breakdown_) : infinity<double>;
  }

  void keep_k2(double swing) noexcept {
    keep(first_.k2, swing);
    keep(swing_, swing);
  }
  static void keep(double& greatest, double value) noexcept {
    if (!(value <= greatest) && greatest == greatest) greatest = value;  // NaN stays
  }

  /// Whether the orbit has come to twice its width or period, or half as near to a separatrix, since it was looked at.
  bool swells(const Level<double>& level, Component component) const noexcept {
    constexpr double small = 1e-3;
    const auto orbit = Orbit<double, Elliptic>::at(problem_, level, component);
    return orbit && (orbit->modulus().k2 > std::max(small, 2 * last_modulus_.k2) ||
                     orbit->modulus().kp2 < last_modulus_.kp2 / 2 || orbit->period() > 2 * last_period_);
  }

  /// On an equilibrium nothing oscillates, but the torque holds the body a little beside it.
  void visit_equilibrium(const Level<double>& level, Component component) noexcept {
    const auto orbit = Orbit<double, Elliptic>::at(problem_, level, component);
    if (!orbit) return;
    const Vec3<double> M = orbit->momentum_at(0.0);
    const double rate =
        level.R * (problem_.inverse_inertia[2] - problem_.inverse_inertia[0]) + problem_.gyro_rate().norm();
    const double turn = std::isfinite(orbit->period()) ? orbit->period() / (2 * pi<double>) : 1 / rate;
    const Vec3<double> torque = small_torque(problem_, M);
    const double beside =
        std::min(most_off(level), std::max(torque.norm(), drive_across(M, M.dot(torque) / M.norm())) * turn);
    keep(first_.norm, beside);
    keep(first_.energy, beside * problem_.angular_velocity(M).norm() + beside * beside * problem_.inverse_inertia[2]);
    const Vec3<double> aside = cross<double>(M, Vec3<double>(1, 1, 1));
    const double length = magnitude(aside);
    const auto away =
        Orbit<double, Elliptic>::through(problem_, length > 0 ? Vec3<double>(M + beside / length * aside) : M);
    keep_k2(away && !is_across(*orbit, *away) ? 4 * away->modulus().k2 : 1.0);
    keep(second_.vector, beside);
  }

  /// The torque across M swings the body beside an equilibrium, however small its orbit is, from where it is to as far on the other side: then
  /// what oscillates is that of an orbit so wide, its energy is another one, and so are its mean rates, over the `span` since the level before.
  void swing_aside(const SecondOrder<double, Elliptic>& s, double size, double span) noexcept {
    const Vec3<double> M = s.orbit.momentum_at(0.0), one = M.unitOrthogonal();
    const double R = M.norm();
    const double beside = std::min(R, 2 * drive_across(M, s.first.R) * s.orbit.period() / (2 * pi<double>));
    if (size >= beside) return;
    double drift_R = 0, drift_h = 0;
    for (const Vec3<double>& aside : {one, Vec3<double>(M.cross(one) / R)}) {
      const Vec3<double> there = (M + beside * aside) * (R / std::hypot(R, beside));
      const auto away = Orbit<double, Elliptic>::through(problem_, there);
      const auto wide = away ? second_order<Elliptic>(problem_, away->level(), away->component())
                             : Result<SecondOrder<double, Elliptic>>(away.error());
      keep(first_.norm, wide ? wide->oscillation.R : beside);
      keep(first_.energy, (wide ? wide->oscillation.h : beside * problem_.angular_velocity(M).norm()) +
                              std::abs(problem_.energy(there) - problem_.energy(M)));
      keep_k2(away && !is_across(s.orbit, *away) ? away->modulus().k2 : 1.0);
      if (!wide) continue;
      drift_R = std::max(drift_R, std::abs(wide->first.R - s.first.R));
      drift_h = std::max(drift_h, std::abs(wide->first.h - s.first.h));
    }
    drift_R_ += drift_R * span, drift_h_ += drift_h * span;
  }

  /// What drives M away from an equilibrium next to it, N m: the torque across M, less what M needs to go along with the equilibrium, whose
  /// direction m changes with |M| as (diag(a) - nu) |M| dm/d|M| = -diag(a) m does on the tangent plane, omega = nu M.
  double drive_across(const Vec3<double>& M, double rate) const noexcept {
    const double R = M.norm();
    const Vec3<double> m = M / R, t = m.unitOrthogonal(), u = m.cross(t), a = problem_.inverse_inertia;
    const Vec3<double> torque = small_torque(problem_, M);
    const double nu = m.dot(problem_.angular_velocity(M)) / R;
    const double tt = t.dot(a.cwiseProduct(t)) - nu, uu = u.dot(a.cwiseProduct(u)) - nu;
    const double tu = t.dot(a.cwiseProduct(u)), tm = t.dot(a.cwiseProduct(m)), um = u.dot(a.cwiseProduct(m));
    const double determinant = tt * uu - tu * tu;
    return std::hypot(t.dot(torque) + rate * (uu * tm - tu * um) / determinant,
                      u.dot(torque) + rate * (tt * um - tu * tm) / determinant);
  }

  /// An orbit so narrow that its neighbours, whose differences the second order is made of, are those of an equilibrium.
  bool is_narrow(const Level<double>& level, Component component) const noexcept {
    const auto orbit = Orbit<double, Elliptic>::at(problem_, level, component);
    return orbit && transverse(*orbit) <= 1e-6 * level.R * level.R;
  }

  /// Mean square distance of M from its mean over the orbit.
  double transverse(const Orbit<double, Elliptic>& orbit) const noexcept {
    Vec3<double> M[4];
    orbit.quarter_points(M);
    const Vec3<double> centre = (M[0] + M[1] + M[2] + M[3]) / 4;
    double most = 0;
    for (const auto& m : M) most = std::max(most, (m - centre).squaredNorm());
    return most;
  }

  /// Change of the rate of the phase, turns per second, when the level moves by (dR, deta).
  double detuning(const SecondOrder<double, Elliptic>& s, const Level<double>& level, Component component, double dR,
                  double deta) const noexcept {
    const double rate = 1 / s.orbit.period();
    double change = 0;
    for (const auto& moved : {Level<double>{level.R + dR, level.eta}, Level<double>{level.R, level.eta + deta},
                              Level<double>{level.R, level.eta - deta}}) {
      const auto orbit = Orbit<double, Elliptic>::at(problem_, moved, component);
      change += orbit ? std::abs(1 / orbit->period() - rate) : rate;
    }
    return change;
  }

  /// Whether a separatrix lies between two orbits, for they lie in the lobes about different axes.
  static bool is_across(const Orbit<double, Elliptic>& from, const Orbit<double, Elliptic>& to) noexcept {
    const Regime one = from.lobe(), other = to.lobe();
    return (one == Regime::about_largest && other == Regime::about_smallest) ||
           (one == Regime::about_smallest && other == Regime::about_largest);
  }

  /// Change of k2 when the level moves by (dR, deta): all of it where that leads from the lobes about one axis to those about the other,
  /// however small k2 is in both.
  double k2_swing(const SecondOrder<double, Elliptic>& s, const Level<double>& level, Component component, double dR,
                  double deta) const noexcept {
    const double k2 = s.orbit.modulus().k2;
    double swing = 0;
    for (const auto& moved : {Level<double>{level.R + dR, level.eta}, Level<double>{level.R, level.eta + deta},
                              Level<double>{level.R, level.eta - deta}}) {
      const auto orbit = Orbit<double, Elliptic>::at(problem_, moved, component);
      swing += orbit && !is_across(s.orbit, *orbit) ? std::abs(orbit->modulus().k2 - k2) : 1.0;
    }
    return std::min(1.0, swing);
  }

  const Problem<double>& problem_;
  double breakdown_;
  SlowError<double> first_{}, second_{};
  double start_R_ = 0, start_eta_ = 0, drift_start_ = 0;  // the oscillation at the start, and what it makes of |M|
  double drift_R_ = 0, drift_h_ = 0, drift_phase_ = 0, last_ = 0, last_opposed_ = 0, last_R_ = 0, change_ = 0;
  math::Modulus<double> last_modulus_{1, 0};
  double last_period_ = infinity<double>;
  Level<double> sure_;          ///< the last one looked at where it was known on which curve the body moves
  SlowError<double> astray_{};  ///< over the spans before it where that was not
  double swing_ = 0;            ///< of k2 on the level looked at
  bool wants_second_, known_ = true, unclear_ = false, was_unsure_ = false;
  bool mirrored_ = problem_.rotor_momentum.isZero(0);
};

namespace detail {

/// |U| below which a turn of the body takes as long as the rest of the braking by a torque [N m], N m s.
GYROSTAT_COMPILED_ONCE double orbit_breakdown(const Problem<double>& problem, double torque) noexcept;

GYROSTAT_COMPILED_ONCE State<double> slow_state(const Problem<double>& problem, const Level<double>& level,
                                                Component component, bool at_rest);

/// How far the modulus of a state can be off when |M| and the energy are, N m s and J.
GYROSTAT_COMPILED_ONCE double k2_beside(const Problem<double>& problem, const State<double>& state, double norm,
                                        double energy) noexcept;

/// Two moments nearer each other than this gap: the body librates slowly.
inline constexpr double narrow_gap = 1e-3;

/// kp2: of the first orbit.
inline void warn_of_start(Track& track, const Scene& scene, double kp2) {
  warn_of_start(track, small_parameter(scene), symmetry_gap(scene.problem()), narrow_gap, kp2);
}

/// Why a mean motion cannot be followed on, and the chance of the likelier lobe where it is captured (NaN elsewhere).
struct Impasse {
  Errc code;
  double chance = nan<double>;
};

/// From one component a motion that nears a separatrix is captured into one of two lobes.
GYROSTAT_COMPILED_ONCE Impasse impasse(const Problem<double>& problem, const Level<double>& level, Component component,
                                       Errc failure);

template <class Motion>
Impasse impasse(const Problem<double>& problem, const Motion& motion) {
  if (motion.chance() == motion.chance()) return {Errc::undetermined, motion.chance()};
  return impasse(problem, motion.last_level(), motion.last_component(), motion.failure());
}

/// Why a mean motion of so many steps at most was left where it was given fewer than it could have.
inline constexpr const char* steps_not_worth = "the full equations are cheaper: the mean equations take many steps";

/// A mean motion of second order (second_order_track).
template <class Elliptic>
class SecondOrderOrbit {
  using Rates = SecondOrderRates<Elliptic, double>;

 public:
  SecondOrderOrbit(const Scene& scene, const MeanLevel<double>& start, const Orbit<double, Elliptic>& orbit,
                   double tolerance, Monitor* monitor) noexcept
      : problem_(scene.problem()),
        last_(scene.question().times.back()),
        monitor_(monitor),
        phase_error_(std::max(1e-7, mean_phase_error(scene))),  // the noise of f2, as below
        step_cap_(steps_worth(scene, averaged_2_orbit_step, Rates::step_cap)),
        error_(problem_, orbit_breakdown(problem_, braking_torque(scene)), true),
        motion_(problem_, start.level, start.component, start.phase, tolerance, phase_error_, Rates{orbit}, step_cap_) {
    error_.visit(start.level, start.component, 0);
  }

  bool start_is_unclear() const noexcept { return error_.start_is_unclear(); }

  Halt advance(double t, double floor) noexcept {
    const auto visit = [this](const Level<double>& level, Component component, double now) {
      error_.visit(level, component, now);
      if (monitor_) monitor_->fraction.store(std::min(1.0, now / last_), std::memory_order_relaxed);
    };
    if (motion_.advance(t, floor, visit) != ode::Status::reached) {
      const Errc failure = impasse(problem_, motion_).code;
      if (failure == Errc::step_limit && step_cap_ < Rates::step_cap) return {Errc::not_applicable, steps_not_worth};
      if (failure == Errc::not_applicable)
        return {failure, "next to an equilibrium, or where a lobe is born or dies, the second order has no value"};
      return not_followed(failure);
    }
    if (motion_.rates().phase_lost || motion_.changed_by(motion_.time()))
      return {Errc::separatrix, "the kind of orbit changes: the phase is lost, and M with it"};
    if (const auto now = motion_.sample(); t >= last_ && !now.at_rest)
      error_.look(now.level, now.component, motion_.time());
    return error_.known() ? Halt{} : Halt{Errc::no_convergence, "the size of the second order is not known"};
  }
  bool floored() const noexcept { return motion_.floored(); }
  double time() const noexcept { return motion_.time(); }

  Result<State<double>> osculating() noexcept {
    const auto now = motion_.sample();
    const auto M = osculating_of<Elliptic>(problem_, {now.level, now.phase, now.component}, &motion_.rates().reference);
    if (!M) return M.error();
    return state_on_orbit(problem_, *M);
  }

  SlowError<double> first_order() const noexcept { return error_.first_order(); }
  SlowError<double> second_order() const noexcept { return error_.second_order_error(); }
  double lag(double local) noexcept {
    return 2 * pi<double> *
           (honesty::mean_steps * phase_error_ + local * std::abs(motion_.sample().phase));  // of turns
  }
  ode::Counts counts() const noexcept { return motion_.counts(); }
  void warn(Track&) const noexcept {}

 private:
  const Problem<double>& problem_;
  double last_;
  Monitor* monitor_;
  double phase_error_;  // local, turns
  std::uint64_t step_cap_;
  OrbitError<Elliptic> error_;
  OrbitMotion<Rates, double> motion_;
};

/// crossed: what the turns beside separatrices have changed of the energy, J; standing: |U| that is not followed into the stop, N m s.
template <class Elliptic>
void errors_of_averages(Track& track, const Scene& scene, const OrbitError<Elliptic>& error, double crossed,
                        double standing) {
  const auto& problem = scene.problem();
  const auto in_span = error.first_order_across(crossed);
  const double local = honesty::mean_steps * mean_tolerance(scene);
  // the energy is a difference of numbers of the size of what the rotors hold
  double energy = std::max(problem.rotor_energy_scale() / 2, scales(problem)[column::energy]);
  for (const State<double>& state : track.states) energy = std::max(energy, state.energy);
  // who does not know the energy, or |M|, does not know the curve
  const bool lost = in_span.energy >= energy || in_span.norm >= problem.momentum.norm();
  const double norm = local * problem.momentum.norm() + problem.momentum_error() + standing;
  energy = local * energy + problem.energy_error(problem.momentum) +
           standing * problem.inverse_inertia.maxCoeff() * (problem.rotor_momentum.norm() + standing);
  double k2 = local;
  for (const std::size_t i : {std::size_t(0), track.states.size() - 1})
    k2 = std::max(k2, k2_beside(problem, track.states[i], norm, energy));
  k2 = lost ? 1.0 : std::min(1.0, in_span.k2 + k2);
  const State<double>& end = track.states.back();
  const auto elsewhere = k2 < 1 ? SlowError<double>{} : error.astray(end.norm, end.energy);
  state_errors(track, {in_span.norm + norm + elsewhere.norm, in_span.energy + energy + elsewhere.energy, k2, 0});
}

/// Braking times below the breakdown momentum may differ by this, s, of which the averages tell nothing.
inline double tail_of(const FinalTorque& torque, double breakdown) noexcept {
  return 3 * breakdown * (1 / torque.least - 1 / torque.greatest);
}

/// The time of the stop and its error, or the warning why there is none: false. doubt: factor of its error; opposed(): the error of |U| by now.
template <class Motion, class Visit, class Opposed>
bool take_stop(Track& track, const Scene& scene, Motion& motion, Visit& visit, double breakdown, double doubt,
               const Opposed& opposed) {
  const auto torque = final_torque(scene);
  // what is left from here on is a small part of the tail, which is in doubt
  const double near = breakdown / 64 * (1 - torque.least / torque.greatest);
  const auto stop = motion.stop_time(visit, near);
  if (!stop) {
    const auto why = impasse(scene.problem(), motion);
    if (why.code == Errc::undetermined) track.warn(warning::capture_undetermined, why.chance);
    else track.warn(warning::stop_unknown);
    return false;
  }
  track.stop_time = *stop;
  track.stop_error = doubt * (tail_of(torque, breakdown) + opposed() / torque.least) / *stop +
                     honesty::mean_stop * mean_tolerance(scene);
  return true;
}

}  // namespace detail

/// First order over the free gyrostat orbit.
template <class Elliptic>
Track orbit_averaged_track(const Scene& scene, Monitor*) {
  if (const char* why = detail::not_averaged(scene)) return refused<Track>(Errc::not_applicable, why);
  const auto& problem = scene.problem();
  const auto orbit = Orbit<double>::through(problem, problem.momentum);
  if (!orbit) return detail::refused(detail::not_followed(orbit.error()));

  Track track;
  const double breakdown = detail::orbit_breakdown(problem, braking_torque(scene));
  OrbitError<Elliptic> error(problem, breakdown, false);
  const auto visit = [&](const Level<double>& level, Component component, double t) {
    error.visit(level, component, t);
  };
  using Rates = FirstOrderRates<Elliptic>;
  const std::uint64_t step_cap = steps_worth(scene, averaged_orbit_step, Rates::step_cap);
  OrbitMotion<Rates, double> motion(problem, orbit->level(), orbit->component(), 0, mean_tolerance(scene),
                                    infinity<double>, {}, step_cap);
  const auto not_worth = [&] { return motion.failure() == Errc::step_limit && step_cap < Rates::step_cap; };
  visit(orbit->level(), orbit->component(), 0);
  const Hold<double> hold(problem);
  const bool passes = hold.driven && !hold.holds;
  double standing = 0;  // of |U|, where the motion is not followed into the stop
  bool without_orbit = false;
  for (const double t : scene.question().times) {
    if (motion.advance(t, 0, visit) != ode::Status::reached)
      return not_worth() ? refused<Track>(Errc::not_applicable, detail::steps_not_worth)
                         : detail::refused(detail::not_followed(detail::impasse(problem, motion).code));
    const auto now = motion.sample();
    if (motion.ended() && passes)
      return refused<Track>(
          Errc::not_applicable,
          "what the control opposes passes through zero, and the drag of the rotors' momentum drives the "
          "carrier on: there the averages end");
    if (!std::isfinite(now.level.R)) return detail::refused(detail::not_followed(Errc::separatrix));
    track.states.push_back(detail::slow_state(problem, now.level, now.component, now.at_rest));
    without_orbit = without_orbit || std::isnan(track.states.back().k2);
    if (t == scene.question().times.back() && !now.at_rest) error.look(now.level, now.component, t);
    if (motion.stands()) standing = motion.opposed();
  }
  const double end = scene.question().times.back();
  const auto doubtful = [&] { return !error.known() || motion.doubtful(); };
  const bool doubtful_in_time = doubtful();
  detail::errors_of_averages(track, scene, error, motion.crossing(), standing);

  const double carrier = (problem.momentum - problem.rotor_momentum).norm();
  const auto opposed = [&] {
    return detail::opposed_error(problem, error.first_order_across(motion.crossing()), carrier);
  };
  // near rest the body falls to the axis of the weakest control, the averaged one need not
  const bool low = breakdown > 0 && motion.opposed() < 3 * breakdown + opposed();
  // The law of the carrier ends where its averages are differences of large numbers; with a slow libration as well they say nothing about
  // the stop.
  const bool slow = detail::symmetry_gap(problem) < detail::narrow_gap;
  const double doubt = problem.law == Law::total ? 1 : slow ? infinity<double> : 20;
  const auto torque = final_torque(scene);
  const double late = doubt * (detail::tail_of(torque, breakdown) + opposed() / torque.least);
  if (!hold.may_stop()) track.stop_time = infinity<double>;
  else if ((motion.ended() || detail::seeks_stop(track, scene, late, end + motion.opposed() / torque.least)) &&
           !detail::take_stop(track, scene, motion, visit, breakdown, doubt, opposed) && not_worth())
    return refused<Track>(Errc::not_applicable, detail::steps_not_worth);
  if (low || end >= track.stop_time || motion.changed_by(end)) track.error[column::modulus_squared] = 1;
  if (without_orbit) track.error[column::modulus_squared] = infinity<double>;
  if (motion.changed_component()) track.warn(warning::crosses_separatrix);
  if (doubtful_in_time || error.start_is_unclear() || !(small_parameter(scene) < 0.1) ||
      !(breakdown <= scene.opposed().norm() / 3))
    track.leave_domain();
  else if (doubtful() && std::isfinite(track.stop_time)) track.stop_error = infinity<double>;
  track.counts = motion.counts();
  detail::warn_of_start(track, scene, orbit->modulus().kp2);
  withhold_stop(track, scene);
  return track;
}

/// Second order over the free gyrostat orbit: M itself to first order in the torques.
template <class Elliptic>
Track orbit_averaged_2_track(const Scene& scene, Monitor* monitor) {
  if (const char* why = detail::not_averaged(scene)) return refused<Track>(Errc::not_applicable, why);
  const auto& problem = scene.problem();
  Orbit<double, Elliptic> orbit;
  const auto mean = mean_of<Elliptic>(problem, problem.momentum, &orbit);
  if (!mean) return detail::refused(detail::not_followed(mean.error()));
  if (orbit.regime() == Regime::point || rests_in_body(problem, problem.momentum))
    return refused<Track>(Errc::not_applicable,
                          "the motion starts on an equilibrium: there is nothing to average over");

  const double breakdown = detail::orbit_breakdown(problem, braking_torque(scene));
  const double floor = hand_over_share(scene) * breakdown;
  const double opposed = scene.opposed().norm();
  if (!(floor < opposed / 2))
    return refused<Track>(Errc::not_applicable,
                          "the braking is too fast: averaging would hand over to the full equations at the start");
  const double turns = opposed / std::max(scene.greatest_control(), 1e-300) / orbit.period();
  if (scene.question().rung == any_rung && turns < 1000)
    return refused<Track>(Errc::not_applicable, "the full equations are cheaper: the braking takes few turns");

  // A relative error of the mean orbit becomes one of the phase, times the turns made. f2 is a difference of neighbouring orbits: below its noise a
  // tighter tolerance only costs steps.
  const double made = 1 + scene.question().times.back() / orbit.period();
  const double of_phase = scene.goal().tightest_of(fast_columns) / (100 * honesty::mean_steps * made);
  const double noise = 1e-9 / energy_share(problem, mean->level);
  const double tolerance = std::max(1e-9, std::min(mean_tolerance(scene), std::max(noise, of_phase)));
  detail::SecondOrderOrbit<Elliptic> motion(scene, *mean, orbit, tolerance, monitor);
  if (motion.start_is_unclear())
    return refused<Track>(Errc::separatrix,
                          "the motion starts so near a separatrix that averaging does not tell on which side of it");
  Track track;
  detail::warn_of_start(track, scene, Orbit<double>::through(problem, problem.momentum)->modulus().kp2);
  return second_order_track(std::move(track), scene, motion, floor, tolerance, monitor);
}

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/orbit_rung_definition.hpp"
#endif
