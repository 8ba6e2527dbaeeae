// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/reduced.hpp"

namespace gyrostat::free {

/// What is known of the data: `rounded`, each is right to a rounding of Scalar; `exact`, each is meant to its last bit, and the rounding
/// of the set-up alone counts.
enum class Data : std::uint8_t { rounded, exact };

namespace detail {

inline constexpr int neighbours = 4;

/// Sign of what the n-th datum of the k-th neighbour is moved by: fixed, and without a pattern that the data could share.
constexpr int neighbour_sign(int k, int n) noexcept {
  constexpr unsigned long long patterns[neighbours] = {0x9e3779b97f4a7c15ULL, 0xd1b54a32d192ed03ULL,
                                                       0x8cb92ba72f3d8dd7ULL, 0xaef17502108ef2d9ULL};
  return (patterns[k] >> (n % 61)) & 1 ? 1 : -1;
}

}  // namespace detail

/// The k-th neighbour of an assembly: every datum times 1 +- by; zeros stay.
template <Real Scalar, class Room>
Assembly<Scalar, Room> neighbour(Assembly<Scalar, Room> given, int k, Scalar by) noexcept {
  int n = 0;
  const auto move = [&](Scalar& x) { x *= 1 + Scalar(detail::neighbour_sign(k, n++)) * by; };
  auto& body = given.body;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      move(body.inertia(i, j));
      body.inertia(j, i) = body.inertia(i, j);
    }
  for (int i = 0; i < 3; ++i) {
    move(body.rotor_momentum[i]);
    move(body.angular_velocity[i]);
    move(body.angular_momentum[i]);
  }
  for (auto& wheel : given.wheels) {
    for (int i = 0; i < 3; ++i) move(wheel.axis[i]);
    move(wheel.axial_inertia);
    move(wheel.rate);
  }
  return given;
}

/// How wrong a motion may be, from four neighbours whose data are a rounding away, made by the same arithmetic: up to the horizon, or
/// over the first period where that is shorter, they are compared time by time, beyond it by their periods and turns.
template <Real Scalar>
class MotionError {
 public:
  struct Bound {
    Scalar angular_velocity = 0;  ///< over the greatest |omega|
    Scalar angular_momentum = 0;  ///< over |M|
    Scalar attitude = 0;          ///< rad
  };

  MotionError() = default;

  /// Of the motion that make<Setup> gives for the reduced assembly, for times up to |horizon|: the nearer, the closer the bounds where a
  /// period is long. Errors: those of Reduced::of and Motion::make.
  template <Real Setup = Scalar, class Room>
  static Result<MotionError> of(const Assembly<Scalar, Room>& assembly, Data data = Data::rounded,
                                Scalar horizon = infinity<Scalar>) noexcept {
    if (const auto sound = Reduced<Scalar, Room>::of(assembly); !sound) return sound.error();
    const auto motion = motion_of(assembly.template cast<Setup>());
    if (!motion) return motion.error();
    return of<Setup>(*motion, assembly, data, horizon);
  }

  /// The same where that motion is there already, of a sound assembly.
  template <Real Setup = Scalar, class Room>
  static MotionError of(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly, Data data = Data::rounded,
                        Scalar horizon = infinity<Scalar>) noexcept {
    MotionError error;
    error.horizon_ = std::abs(horizon);
    error.start(motion);
    const Setup by = data == Data::exact ? epsilon<Setup> : Setup(epsilon<Scalar>);
    constexpr bool wide = !std::is_same_v<Setup, Scalar>;
    if (!(wide && data == Data::rounded && error.see_from_afar(assembly))) {
      const auto given = assembly.template cast<Setup>();
      const Centre centre(motion, error.span_);
      for (int k = 0; k < detail::neighbours; ++k) error.see(centre, motion_of(neighbour<Setup>(given, k, by)));
    }
    // what rounding did to this very set-up
    if constexpr (std::is_same_v<Setup, double>)
      error.see(Centre(motion, error.span_), motion_of(assembly.template cast<DoubleDouble>()));
    if (error.kind_ != Kind::steady) {  // and what the rounding of the period and the turn hides
      const Scalar hidden = static_cast<Scalar>(by);
      error.share_ += hidden / error.period_;
      error.turn_rate_ += 2 * pi<Scalar> * hidden / error.period_;
    }
    return error;
  }

  /// Of every time up to |t|. Infinite where the data fix the phase to less than 0.05 rad only, and beyond the horizon.
  Bound at(Scalar t) const noexcept {
    using std::abs;
    Bound b = near(abs(t));
    const Scalar beyond = abs(t);
    const Scalar late = beyond * share_, turned = beyond * turn_rate_;
    if (!(beyond <= horizon_)) b.attitude = infinity<Scalar>;
    if (kind_ == Kind::steady) {
      const Scalar off = wander(beyond);
      b.angular_momentum += 4 * off;
      b.angular_velocity += 4 * off * gain_;
      b.attitude += 4 * (off * gain_ + 2 * epsilon<Scalar>)*speed_ * beyond;
    } else if (!(beyond <= period_)) {
      b.angular_velocity += 4 * late * rates_change_;
      b.angular_momentum += 4 * late * momentum_change_;
      b.attitude += 4 * (turned + late * attitude_change_);
      if (!agree_) b.attitude = infinity<Scalar>;
    }
    const Scalar rounding = 10 * cancellation_ * epsilon<Scalar>;
    const Scalar most = Scalar(0.2);  // four times 0.05
    if (!(b.attitude <= most && b.angular_velocity <= most))
      return {infinity<Scalar>, infinity<Scalar>, infinity<Scalar>};
    // M may be all rounding and the body's motion not
    if (!(b.angular_momentum <= most)) b.angular_momentum = infinity<Scalar>;
    const Scalar of_rates = fastest_ > 0 ? std::max(rounding, 4 * epsilon<Scalar> * rate_terms_ / fastest_) : rounding;
    return {b.angular_velocity + of_rates, b.angular_momentum + rounding, b.attitude + rounding};
  }

  Scalar period() const noexcept { return 4 * share_ * period_ + 4 * epsilon<Scalar>; }  ///< relative
  Scalar turn_per_period() const noexcept {                                              ///< rad
    return 4 * turn_ + 16 * epsilon<Scalar>;
  }
  Scalar modulus_squared() const noexcept { return 4 * modulus_ + 4 * epsilon<Scalar>; }  ///< absolute
  Scalar energy() const noexcept { return 4 * energy_ + 4 * epsilon<Scalar>; }            ///< relative
  Scalar angular_momentum_norm() const noexcept { return 4 * norm_ + 4 * epsilon<Scalar>; }
  /// The greatest |omega| over a period or up to the horizon, rad/s: what bounds of the rates are relative to.
  Scalar fastest() const noexcept { return fastest_; }
  /// The neighbours are motions of the same kind; else the data do not tell on which side of a separatrix the motion is.
  bool kinds_agree() const noexcept { return agree_; }

 private:
  static constexpr int nodes = 128;

  template <Real Setup, class Room>
  static Result<Motion<Scalar>> motion_of(const Assembly<Setup, Room>& given) noexcept {
    return Motion<Scalar>::template make<Setup>(Reduced<Setup, Room>::taken(given).problem);
  }

  /// A motion and its states at the nodes, from a period before the start to one behind it.
  class Centre {
   public:
    Centre(const Motion<Scalar>& of, const Scalar& span) noexcept : motion(of) {
      for (int i = -nodes; i <= nodes; ++i) states_[std::size_t(i + nodes)] = of.at(Scalar(i) * span / nodes);
    }
    const State<Scalar>& at(int node) const noexcept { return states_[std::size_t(node + nodes)]; }
    const Motion<Scalar>& motion;

   private:
    std::array<State<Scalar>, 2 * nodes + 1> states_;
  };

  /// Looks at neighbours a thousand roundings away, which the arithmetic of Scalar tells apart well, and takes a thousandth of what it sees;
  /// false, and nothing seen, where the motion is not smooth enough in its data for that.
  template <class Room>
  bool see_from_afar(const Assembly<Scalar, Room>& assembly) noexcept {
    constexpr Scalar far = 1024, straight = Scalar(1e-3);
    if (kind_ == Kind::steady || kind_ == Kind::separatrix) return false;
    const auto made = motion_of(assembly);
    if (!made || made->kind() != kind_ || !(made->modulus().kp2 > Scalar(1e-4))) return false;
    const Centre centre(*made, span_);
    const MotionError unseen = *this;
    shrink_ = 1 / far;
    for (int k = 0; k < detail::neighbours; ++k)
      see(centre, motion_of(neighbour<Scalar>(assembly, k, far * epsilon<Scalar>)));
    shrink_ = 1;
    const Bound& period = first_[nodes];
    if (agree_ && far * modulus_ < straight * made->modulus().kp2 && far * share_ * span_ < straight &&
        far * period.attitude < straight && far * period.angular_velocity < straight)
      return true;
    *this = unseen;
    return false;
  }

  void start(const Motion<Scalar>& motion) noexcept {
    using std::isfinite, std::max, std::min;
    kind_ = motion.kind();
    const State<Scalar> s = motion.at(0);
    speed_ = s.angular_velocity.norm();
    if (kind_ == Kind::steady) return start_steady(motion);
    period_ = motion.period();
    span_ = min(horizon_, isfinite(period_) ? period_ : 80 / motion.jacobi_rate());
    const Scalar T = span_, turn = motion.turn_per_period() / T;
    const Mat3<Scalar> inverse =
        motion.R_BP() * motion.principal_moments().cwiseInverse().asDiagonal() * motion.R_BP().transpose();
    const Scalar R = motion.angular_momentum_norm();
    for (int i = 0; i < nodes; ++i) {
      const State<Scalar> at = motion.at(T * Scalar(i) / nodes);
      const Vec3<Scalar> flow = cross<Scalar>(at.angular_momentum, at.angular_velocity);
      cancellation_ = max(cancellation_, motion.cancellation(T * Scalar(i) / nodes));
      rate_terms_ = max(rate_terms_, motion.rate_terms(T * Scalar(i) / nodes));
      fastest_ = max(fastest_, at.angular_velocity.norm());
      momentum_change_ = max(momentum_change_, flow.norm());
      rates_change_ = max(rates_change_, Vec3<Scalar>(inverse * flow).norm());
      attitude_change_ =
          max(attitude_change_, Vec3<Scalar>(at.angular_velocity - turn / R * at.angular_momentum).norm());
    }
    // E = exp(h u) grows along a half period, and its rounding with it
    if (motion.hyperbolic() && isfinite(motion.quarter_period()))
      cancellation_ += motion.quarter_period() / motion.quarter_period_conjugate() / 8;
    // per period that the phase is late, with a margin for what lies between the nodes
    const Scalar margin = Scalar(1.25);
    rates_change_ *= margin * T / fastest_;
    momentum_change_ *= margin * T / R;
    attitude_change_ *= margin * T;
  }

  void start_steady(const Motion<Scalar>& motion) noexcept {
    using std::sqrt;
    const Scalar square = motion.steady_square(), R = motion.angular_momentum_norm();
    fastest_ = speed_;
    unstable_ = square < 0 ? sqrt(-square) : Scalar(0);
    frequency_ = square > 0 ? sqrt(square) : Scalar(0);
    const Vec3<Scalar>& J = motion.principal_moments();
    shear_ = R * (J[0] - J[2]) / (J[0] * J[2]);
    gain_ = speed_ > 0 ? R / J[2] / speed_ : Scalar(0);
    span_ = period_ = speed_ > 0 ? 2 * pi<Scalar> / speed_ : Scalar(1);
  }

  void see(const Centre& centre, const Result<Motion<Scalar>>& made) noexcept {
    const Motion<Scalar>& motion = centre.motion;
    using std::abs, std::max;
    if (!made) {
      agree_ = false;
      first_.fill({infinity<Scalar>, infinity<Scalar>, infinity<Scalar>});
      return;
    }
    const Motion<Scalar>& other = *made;
    const auto relative = [](Scalar a, Scalar b) { return a == b ? Scalar(0) : abs(a - b) / abs(a); };
    energy_ = max(energy_, shrink_ * relative(motion.energy(), other.energy()));
    norm_ = max(norm_, shrink_ * relative(motion.angular_momentum_norm(), other.angular_momentum_norm()));
    if (kind_ == Kind::steady) return see_steady(other);
    modulus_ = max(modulus_, shrink_ * abs(motion.modulus_squared() - other.modulus_squared()));
    if (kind_ != Kind::spherical && other.kind() != kind_) agree_ = false;
    Bound worst;
    for (int i = 0; i <= nodes; ++i) {
      // running greatest differences, with time forward and back
      for (const int side : {1, -1}) {
        const Scalar t = Scalar(side * i) * span_ / nodes;
        const State<Scalar>&a = centre.at(side * i), b = other.at(t);
        const Quat<Scalar> q = conjugate(a.attitude) * b.attitude;
        worst.angular_velocity =
            max(worst.angular_velocity, Vec3<Scalar>(a.angular_velocity - b.angular_velocity).norm() / fastest_);
        worst.angular_momentum =
            max(worst.angular_momentum,
                Vec3<Scalar>(a.angular_momentum - b.angular_momentum).norm() / motion.angular_momentum_norm());
        worst.attitude = max(worst.attitude, Vec3<Scalar>(2 * q.x, 2 * q.y, 2 * q.z).norm());
      }
      Bound& to = first_[std::size_t(i)];
      const Scalar margin = 4 * shrink_;
      to.angular_velocity = max(to.angular_velocity, margin * worst.angular_velocity);
      to.angular_momentum = max(to.angular_momentum, margin * worst.angular_momentum);
      to.attitude = max(to.attitude, margin * worst.attitude);
    }
    share_ = max(share_, shrink_ * relative(motion.period(), other.period()) / period_);
    const Scalar turn = motion.turn_per_period(), raw = other.turn_per_period() - turn;
    const Scalar turned = raw - 2 * pi<Scalar> * std::nearbyint(raw / (2 * pi<Scalar>));
    turn_ = max(turn_, shrink_ * abs(turned));
    turn_rate_ =
        max(turn_rate_, shrink_ * abs((turned - turn * (other.period() - period_) / period_) / other.period()));
  }

  void see_steady(const Motion<Scalar>& other) noexcept {
    using std::max;
    const State<Scalar> s = other.at(0);
    const Scalar flow = cross<Scalar>(s.angular_momentum, s.angular_velocity).norm();
    if (flow > 0) drift_ = max(drift_, flow / other.angular_momentum_norm());
  }

  /// How far M may wander from that of a steady rotation, over |M|: the neighbours' drift carries it off, until it circles an equilibrium
  /// beside this one or leaves for good, and it does so along an ellipse or hyperbola.
  Scalar wander(Scalar t) const noexcept {
    using std::expm1, std::max, std::min;
    const Scalar pace = max(frequency_, unstable_), sheared = 1 + shear_ * t;
    const Scalar stretch = pace > 0 ? min(sheared, max(Scalar(1), shear_ / pace)) : sheared;
    const Scalar grown = expm1(unstable_ * t);
    const Scalar carried = unstable_ > 0 ? grown / unstable_ : frequency_ > 0 ? min(t, 1 / frequency_) : t;
    return stretch * (4 * epsilon<Scalar> * (1 + grown) + drift_ * carried);
  }

  /// Over the span, at the node at or after t.
  Bound near(Scalar t) const noexcept {
    if (kind_ == Kind::steady) return {};
    using std::ceil, std::min;
    const Scalar place = ceil(t / span_ * nodes);
    if (!(place < nodes))
      return t - t == 0 ? first_[nodes] : Bound{infinity<Scalar>, infinity<Scalar>, infinity<Scalar>};
    return first_[std::size_t(place)];
  }

  Kind kind_ = Kind::steady;
  bool agree_ = true;
  Scalar shrink_ = 1;                                          ///< a difference that is seen counts by so much
  Scalar horizon_ = infinity<Scalar>, period_ = 1, span_ = 1;  ///< span: that the nodes divide
  Scalar fastest_ = 0, speed_ = 0;
  Scalar rates_change_ = 0, momentum_change_ = 0, attitude_change_ = 0;  // by a phase late by a period
  Scalar share_ = 0, turn_rate_ = 0, turn_ = 0;  // periods late a second; rad/s about M; rad a period
  Scalar modulus_ = 0, energy_ = 0, norm_ = 0, cancellation_ = 1, rate_terms_ = 0;
  Scalar drift_ = 0, unstable_ = 0, frequency_ = 0, shear_ = 0, gain_ = 0;  // of a steady rotation
  std::array<Bound, nodes + 1> first_{};
};

}  // namespace gyrostat::free
