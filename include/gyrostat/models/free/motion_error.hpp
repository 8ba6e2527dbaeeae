// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/many.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_lanes.hpp"
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
                                Scalar horizon = infinity<Scalar>) noexcept;

  /// The same where that motion is there already, of a sound assembly.
  template <Real Setup = Scalar, class Room>
  static MotionError of(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly, Data data = Data::rounded,
                        Scalar horizon = infinity<Scalar>) noexcept;

  /// The same for a tenth of the cost, for times from 0 up to the horizon, of a motion of a sound assembly that was set up in Scalar like its
  /// neighbours, so that their distances show the rounding of the set-up too; nothing beside a separatrix and in other places where rounding grows, and
  /// where the motion fails its own equations by more than some roundings.
  /// `in_lanes`: with the neighbours side by side where that can be.
  template <bool in_lanes = math::many_pays, class Room>
  static std::optional<MotionError> quick(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly,
                                          Scalar horizon) noexcept;

  /// Whether nothing that the set-up subtracts cancels as a matter of course: no separatrix is near, and no principal axes found in Scalar belong to
  /// moments that are nearly equal. Else there is no quick error.
  template <class Room>
  static bool is_tame(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly) noexcept {
    if (motion.kind() == Kind::steady || motion.kind() == Kind::separatrix || motion.kind() == Kind::spherical ||
        motion.hyperbolic())
      return false;
    const auto& modulus = motion.modulus();
    const Vec3<Scalar>& J = motion.principal_moments();
    return modulus.kp2 > quick_modulus && !(motion.kind() == Kind::one_component && modulus.k2 < quick_least) &&
           (assembly.body.inertia.isDiagonal(0) || std::min(J[0] - J[1], J[1] - J[2]) > quick_gap * J[0]);
  }

  /// Of every time up to |t|. Infinite where the data fix the phase to less than 0.05 rad only, and beyond the horizon.
  Bound at(Scalar t) const noexcept;

  Scalar period() const noexcept { return scalar_margin_ * share_ * period_ + 4 * epsilon<Scalar>; }  ///< relative
  Scalar turn_per_period() const noexcept {                                                           ///< rad
    return scalar_margin_ * turn_ + 16 * epsilon<Scalar>;
  }
  /// Of the turn in the long run at the mean rate `about` [rad/s], all of them counted; rad/s.
  Scalar turn_rate(Scalar turn_per_period, Scalar about) const noexcept {
    return scalar_margin_ * turn_rate_ + std::abs(about - turn_per_period / period_) * period();
  }
  Scalar modulus_squared() const noexcept { return scalar_margin_ * modulus_ + 4 * epsilon<Scalar>; }  ///< absolute
  Scalar energy() const noexcept { return scalar_margin_ * energy_ + 4 * epsilon<Scalar>; }            ///< relative
  Scalar angular_momentum_norm() const noexcept { return scalar_margin_ * norm_ + 4 * epsilon<Scalar>; }
  /// The greatest of these.
  Scalar of_scalars() const noexcept {
    return std::max({period(), turn_per_period(), modulus_squared(), energy(), angular_momentum_norm()});
  }
  /// Whether bounds reach over a whole period, which means over it need.
  bool spans_period() const noexcept { return period_ <= horizon_; }
  /// The greatest |omega| over a period or up to the horizon, rad/s: what bounds of the rates are relative to.
  Scalar fastest() const noexcept { return fastest_; }
  /// The neighbours are motions of the same kind; else the data do not tell on which side of a separatrix the motion is.
  bool kinds_agree() const noexcept { return agree_; }

 private:
  friend class QuickLanes;

  static constexpr Scalar quick_modulus = Scalar(0.01), quick_cancellation = 4, quick_defect = 16 * epsilon<Scalar>,
                          quick_margin = 6, quick_gap = Scalar(1e-3), quick_least = Scalar(1e-8);

  template <Real Setup, class Room>
  static Result<Motion<Scalar>> motion_of(const Assembly<Setup, Room>& given) noexcept {
    return Motion<Scalar>::template make<Setup>(Reduced<Setup, Room>::taken(given).problem);
  }

  /// Nodes from the first to the last, 0 being the start and the last the end of the span.
  struct Nodes {
    int first, last;
  };
  static constexpr Nodes many{-128, 128}, some{-16, 16}, few{0, 8};  ///< beside a separatrix; elsewhere; the quick ones

  /// A motion and its states at the nodes.
  class Centre {
   public:
    Centre(const Motion<Scalar>& of, Scalar span, Nodes nodes) noexcept : motion(of), first_(nodes.first) {
      for (int i = nodes.first; i <= nodes.last; ++i)
        states_[std::size_t(i - nodes.first)] = of.at(Scalar(i) * span / Scalar(nodes.last));
    }
    const State<Scalar>& at(int node) const noexcept { return states_[std::size_t(node - first_)]; }
    const Motion<Scalar>& motion;

   private:
    int first_;
    std::array<State<Scalar>, std::size_t(many.last - many.first + 1)> states_;
  };

  void begin_quick(Scalar horizon) noexcept {
    horizon_ = std::abs(horizon);
    nodes_ = few;
    weight_ = quick_margin / 4;
    scalar_margin_ = 4 * quick_margin;
  }

  /// Whether what quick() has seen of a motion can be believed; takes the defect into what is constant. J: principal moments; M and l in their axes,
  /// over |M|.
  bool trust_quick(const Vec3<Scalar>& J, const Vec3<Scalar>& M, const Vec3<Scalar>& l) noexcept {
    if (!agree_ || !(cancellation_ < quick_cancellation) || !(defect_ < quick_defect)) return false;
    modulus_ = std::max(modulus_, defect_);
    turn_ = std::max(turn_, defect_);
    add_hidden(std::max(epsilon<Scalar>, defect_ / 4));
    if (std::min(J[0] - J[1], J[1] - J[2]) <= 10 * quick_gap * J[0]) add_hidden_by_symmetry(J, M, l);
    return true;
  }

  /// Where two moments are equal, or nearly, the set-up in Scalar rounds them alike, for the neighbours as for the motion, and the period follows
  /// from a small part of M, along the axis that it surrounds or of the rotors, known to a rounding of the whole: no neighbour shows that. Of 980 000
  /// random motions, a third of them nearly symmetric, one period and turn was then off by more than stated, 1.4 times.
  void add_hidden_by_symmetry(const Vec3<Scalar>& J, const Vec3<Scalar>& M, const Vec3<Scalar>& l) noexcept {
    const Scalar part = kind_ == Kind::about_largest    ? M[0] * M[0]
                        : kind_ == Kind::about_smallest ? M[2] * M[2]
                                                        : std::min(l.norm(), Scalar(1));
    const Scalar hidden = epsilon<Scalar> / (2 * part), turned = hidden * fastest_ * J[0] / J[1];
    hidden_share_ = hidden / period_;
    hidden_turn_ = turned;
    share_ += hidden_share_;
    turn_rate_ += hidden_turn_;
    turn_ += turned * period_;
    modulus_ += 2 * hidden * J[0] / (J[0] - J[2]);
  }

  /// The defect and the neighbours of quick().
  template <class Room>
  void see_one_by_one(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly, Scalar by) noexcept {
    start(motion);
    for (int i = 0; i < few.last; i += 2)
      defect_ = std::max(defect_, motion.defect(motion.period() * Scalar(i) / few.last, fastest_));
    const Centre centre(motion, span_, nodes_);
    for (int k = 0; k < detail::neighbours; ++k) see(centre, motion_of(neighbour<Scalar>(assembly, k, by)));
  }

  /// The same, the neighbours in lanes, and the data themselves as one more, set up by the arithmetic of these. False, and nothing seen, where the
  /// motions are none for lanes.
  template <class Room>
  bool see_side_by_side(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly, Scalar by) noexcept {
    if constexpr (!std::is_same_v<Scalar, double>) {
      return false;
    } else {
      const auto centre = MotionLanes::of(motion);
      if (!centre) return false;
      MotionLanes others;
      const bool axes_given = assembly.body.inertia.isDiagonal(0);
      for (int k = 0; k <= detail::neighbours; ++k) {
        const bool is_given = k == detail::neighbours;
        const auto problem =
            Reduced<Scalar, Room>::taken(is_given ? assembly : neighbour<Scalar>(assembly, k, by)).problem;
        const auto principal = axes_given ? PrincipalProblem<Scalar>::of(problem)
                                          : PrincipalProblem<Scalar>::beside(problem, motion.R_BP());
        others.set(k, is_given ? MotionLanes::size : k + 1, principal, as_unit(problem.attitude));
      }
      if (others.make() != (1u << MotionLanes::size) - 1) return false;
      begin(motion, motion.at(0));
      MotionLanes::Row times;
      for (int i = 0; i < few.last; ++i) times[i] = span_ * i / few.last;
      const auto seen = centre->look(times);
      take_extent(seen, inverse_inertia(motion), motion.turn_per_period(), motion.angular_momentum_norm());
      const Figures own = figures_of(motion);
      for (int k = 0; k < MotionLanes::size; ++k)
        see_figures(own, {others.energy()[k], others.angular_momentum_norm()[k], others.modulus_squared()[k],
                          others.period()[k], others.turn_per_period()[k], others.kind(k)});
      Bound worst;
      for (int i = 0; i <= few.last; ++i) {
        const Scalar t = span_ * i / few.last;
        const State<Scalar> at = i < few.last ? seen.states.lane(i) : motion.at(t);
        std::fill_n(times, MotionLanes::size, t);
        const auto apart = others.at(times).apart(at);
        worst.angular_velocity = std::max(worst.angular_velocity, apart.angular_velocity / fastest_);
        worst.angular_momentum =
            std::max(worst.angular_momentum, apart.angular_momentum / motion.angular_momentum_norm());
        worst.attitude = std::max(worst.attitude, apart.attitude);
        widen(first_[std::size_t(i)], worst);
      }
      return true;
    }
  }

  /// What the rounding of the period and the turn hides.
  void add_hidden(Scalar by) noexcept {
    if (kind_ == Kind::steady) return;
    share_ += by / period_;
    turn_rate_ += 2 * pi<Scalar> * by / period_;
  }

  /// Looks at neighbours a thousand roundings away, which the arithmetic of Scalar tells apart well, and takes a thousandth of what it sees;
  /// false, and nothing seen, where the motion is not smooth enough in its data for that.
  template <class Room>
  bool see_from_afar(const Assembly<Scalar, Room>& assembly) noexcept {
    constexpr Scalar far = 1024, straight = Scalar(1e-3);
    if (kind_ == Kind::steady || kind_ == Kind::separatrix) return false;
    const auto made = motion_of(assembly);
    if (!made || made->kind() != kind_ || !(made->modulus().kp2 > Scalar(1e-4))) return false;
    const Centre centre(*made, span_, nodes_);
    const MotionError unseen = *this;
    weight_ = 1 / far;
    for (int k = 0; k < detail::neighbours; ++k)
      see(centre, motion_of(neighbour<Scalar>(assembly, k, far * epsilon<Scalar>)));
    weight_ = 1;
    const Bound& period = first_[std::size_t(nodes_.last)];
    if (agree_ && far * modulus_ < straight * made->modulus().kp2 && far * share_ * span_ < straight &&
        far * period.attitude < straight && far * period.angular_velocity < straight)
      return true;
    *this = unseen;
    return false;
  }

  /// What of the motion does not depend on its neighbours.
  void start(const Motion<Scalar>& motion) noexcept {
    const State<Scalar> first = motion.at(0);
    begin(motion, first);
    if (kind_ == Kind::steady) return start_steady(motion);
    const Mat3<Scalar> inverse = inverse_inertia(motion);
    for (int i = 0; i < nodes_.last; ++i) {
      const Scalar t = span_ * Scalar(i) / Scalar(nodes_.last);
      visit(motion, motion.at(t), inverse, motion.cancellation(t), motion.rate_terms(t));
    }
    // E = exp(h u) grows along a half period, and its rounding with it
    if (motion.hyperbolic() && std::isfinite(motion.quarter_period()))
      cancellation_ += motion.quarter_period() / motion.quarter_period_conjugate() / 8;
    margins();
  }

  void begin(const Motion<Scalar>& motion, const State<Scalar>& first) noexcept {
    kind_ = motion.kind();
    speed_ = first.angular_velocity.norm();
    if (kind_ == Kind::steady) return;
    period_ = motion.period();
    span_ = std::min(horizon_, std::isfinite(period_) ? period_ : 80 / motion.jacobi_rate());
  }

  static Mat3<Scalar> inverse_inertia(const Motion<Scalar>& motion) noexcept {
    return motion.R_BP() * motion.principal_moments().cwiseInverse().asDiagonal() * motion.R_BP().transpose();
  }

  /// Takes a state of the motion into what is greatest.
  void visit(const Motion<Scalar>& motion, const State<Scalar>& at, const Mat3<Scalar>& inverse, Scalar cancellation,
             Scalar rate_terms) noexcept {
    using std::max;
    const Scalar turn = motion.turn_per_period() / span_, R = motion.angular_momentum_norm();
    const Vec3<Scalar> flow = cross<Scalar>(at.angular_momentum, at.angular_velocity);
    cancellation_ = max(cancellation_, cancellation);
    rate_terms_ = max(rate_terms_, rate_terms);
    fastest_ = max(fastest_, at.angular_velocity.norm());
    momentum_change_ = max(momentum_change_, flow.norm() / R);
    rates_change_ = max(rates_change_, Vec3<Scalar>(inverse * flow).norm());
    attitude_change_ = max(attitude_change_, Vec3<Scalar>(at.angular_velocity - turn / R * at.angular_momentum).norm());
  }

  /// The same of all that was looked at, with margins and the defect.
  void take_extent(const MotionLanes::Looks& seen, const Mat3<double>& inverse, double turn, double R) noexcept {
    const auto most = seen.extent(inverse, turn / span_ / R);
    cancellation_ = std::max(cancellation_, most.cancellation);
    rate_terms_ = most.rate_terms;
    fastest_ = most.angular_velocity;
    momentum_change_ = most.flow / R;
    rates_change_ = most.acceleration;
    attitude_change_ = most.relative;
    defect_ = most.defect / fastest_;
    margins();
  }

  /// Per period that the phase is late, with a margin for what lies between the nodes.
  void margins() noexcept {
    const Scalar margin = Scalar(1.25);
    rates_change_ *= margin * span_ / fastest_;
    momentum_change_ *= margin * span_;
    attitude_change_ *= margin * span_;
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
    using std::max;
    if (!made) {
      agree_ = false;
      first_.fill({infinity<Scalar>, infinity<Scalar>, infinity<Scalar>});
      return;
    }
    const Motion<Scalar>& other = *made;
    see_figures(figures_of(motion), figures_of(other));
    if (kind_ == Kind::steady) return see_steady(other);
    Bound worst;
    for (int i = 0; i <= nodes_.last; ++i) {
      // running greatest differences, with time forward and back
      for (int side = 1; side * i >= nodes_.first && side >= -1; side -= 2) {
        const Scalar t = Scalar(side * i) * span_ / Scalar(nodes_.last);
        const State<Scalar>&a = centre.at(side * i), b = other.at(t);
        const Quat<Scalar> q = conjugate(a.attitude) * b.attitude;
        worst.angular_velocity =
            max(worst.angular_velocity, Vec3<Scalar>(a.angular_velocity - b.angular_velocity).norm() / fastest_);
        worst.angular_momentum =
            max(worst.angular_momentum,
                Vec3<Scalar>(a.angular_momentum - b.angular_momentum).norm() / motion.angular_momentum_norm());
        worst.attitude = max(worst.attitude, Vec3<Scalar>(2 * q.x, 2 * q.y, 2 * q.z).norm());
      }
      widen(first_[std::size_t(i)], worst);
    }
  }

  void widen(Bound& bound, const Bound& worst) const noexcept {
    using std::max;
    const Scalar margin = 4 * weight_;
    bound.angular_velocity = max(bound.angular_velocity, margin * worst.angular_velocity);
    bound.angular_momentum = max(bound.angular_momentum, margin * worst.angular_momentum);
    bound.attitude = max(bound.attitude, margin * worst.attitude);
  }

  /// What is constant of a motion.
  struct Figures {
    Scalar energy, norm, modulus_squared, period, turn;
    Kind kind;
  };
  static Figures figures_of(const Motion<Scalar>& motion) noexcept {
    return {motion.energy(), motion.angular_momentum_norm(), motion.modulus_squared(),
            motion.period(), motion.turn_per_period(),       motion.kind()};
  }
  /// Of the motion and of a neighbour.
  void see_figures(const Figures& own, const Figures& other) noexcept {
    using std::abs, std::max;
    const auto relative = [](Scalar a, Scalar b) { return a == b ? Scalar(0) : abs(a - b) / abs(a); };
    energy_ = max(energy_, weight_ * relative(own.energy, other.energy));
    norm_ = max(norm_, weight_ * relative(own.norm, other.norm));
    if (kind_ == Kind::steady) return;
    modulus_ = max(modulus_, weight_ * abs(own.modulus_squared - other.modulus_squared));
    if (kind_ != Kind::spherical && other.kind != kind_) agree_ = false;
    share_ = max(share_, weight_ * relative(own.period, other.period) / period_);
    const Scalar raw = other.turn - own.turn;
    const Scalar turned = raw - 2 * pi<Scalar> * std::nearbyint(raw / (2 * pi<Scalar>));
    turn_ = max(turn_, weight_ * abs(turned));
    turn_rate_ =
        max(turn_rate_, weight_ * abs((turned - own.turn * (other.period - period_) / period_) / other.period));
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
    const Scalar place = ceil(t / span_ * Scalar(nodes_.last));
    if (!(place < Scalar(nodes_.last)))
      return t - t == 0 ? first_[std::size_t(nodes_.last)]
                        : Bound{infinity<Scalar>, infinity<Scalar>, infinity<Scalar>};
    return first_[std::size_t(place)];
  }

  Kind kind_ = Kind::steady;
  bool agree_ = true;
  Nodes nodes_ = many;
  Scalar weight_ = 1;  ///< by which a difference that is seen counts
  Scalar scalar_margin_ = 4;
  Scalar horizon_ = infinity<Scalar>, period_ = 1, span_ = 1;
  Scalar fastest_ = 0, speed_ = 0, defect_ = 0;
  Scalar rates_change_ = 0, momentum_change_ = 0, attitude_change_ = 0;  // by a phase late by a period
  Scalar share_ = 0, turn_rate_ = 0, turn_ = 0;  // periods late a second; rad/s about M; rad a period
  Scalar hidden_share_ = 0, hidden_turn_ = 0;    // of these what no neighbour shows, within a period either
  Scalar modulus_ = 0, energy_ = 0, norm_ = 0, cancellation_ = 1, rate_terms_ = 0;
  Scalar drift_ = 0, unstable_ = 0, frequency_ = 0, shear_ = 0, gain_ = 0;  // of a steady rotation
  std::array<Bound, std::size_t(many.last + 1)> first_{};
};

template <Real Scalar>
template <Real Setup, class Room>
Result<MotionError<Scalar>> MotionError<Scalar>::of(const Assembly<Scalar, Room>& assembly, Data data,
                                                    Scalar horizon) noexcept {
  if (const auto sound = Reduced<Scalar, Room>::of(assembly); !sound) return sound.error();
  const auto motion = motion_of(assembly.template cast<Setup>());
  if (!motion) return motion.error();
  return of<Setup>(*motion, assembly, data, horizon);
}

template <Real Scalar>
template <Real Setup, class Room>
MotionError<Scalar> MotionError<Scalar>::of(const Motion<Scalar>& motion, const Assembly<Scalar, Room>& assembly,
                                            Data data, Scalar horizon) noexcept {
  MotionError error;
  error.horizon_ = std::abs(horizon);
  error.nodes_ = motion.hyperbolic() ? many : some;
  error.start(motion);
  const Setup by = data == Data::exact ? epsilon<Setup> : Setup(epsilon<Scalar>);
  constexpr bool wide = !std::is_same_v<Setup, Scalar>;
  if (!(wide && data == Data::rounded && error.see_from_afar(assembly))) {
    const auto given = assembly.template cast<Setup>();
    const Centre centre(motion, error.span_, error.nodes_);
    for (int k = 0; k < detail::neighbours; ++k) error.see(centre, motion_of(neighbour<Setup>(given, k, by)));
  }
  // what rounding did to this very set-up
  if constexpr (std::is_same_v<Setup, double>)
    error.see(Centre(motion, error.span_, error.nodes_), motion_of(assembly.template cast<DoubleDouble>()));
  error.add_hidden(static_cast<Scalar>(by));
  return error;
}

template <Real Scalar>
template <bool in_lanes, class Room>
std::optional<MotionError<Scalar>> MotionError<Scalar>::quick(const Motion<Scalar>& motion,
                                                              const Assembly<Scalar, Room>& assembly,
                                                              Scalar horizon) noexcept {
  if (!is_tame(motion, assembly)) return std::nullopt;
  MotionError error;
  error.begin_quick(horizon);
  // principal axes found in Scalar are off by more than a rounding
  const Scalar by = (assembly.body.inertia.isDiagonal(0) ? 1 : 2) * epsilon<Scalar>;
  if (!in_lanes || !error.see_side_by_side(motion, assembly, by)) error.see_one_by_one(motion, assembly, by);
  const Mat3<Scalar> R_PB = motion.R_BP().transpose() / motion.angular_momentum_norm();
  const bool trusted = error.trust_quick(motion.principal_moments(), R_PB * motion.at(0).angular_momentum,
                                         R_PB * motion.rotor_momentum());
  return trusted ? std::optional(error) : std::nullopt;
}

template <Real Scalar>
auto MotionError<Scalar>::at(Scalar t) const noexcept -> Bound {
  using std::abs;
  Bound b = near(abs(t));
  const Scalar beyond = abs(t);
  const bool within = beyond <= period_;
  const Scalar late = beyond * (within ? hidden_share_ : share_),
               turned = beyond * (within ? hidden_turn_ : turn_rate_);
  if (!(beyond <= horizon_)) b.attitude = infinity<Scalar>;
  if (kind_ == Kind::steady) {
    const Scalar off = wander(beyond);
    b.angular_momentum += 4 * off;
    b.angular_velocity += 4 * off * gain_;
    b.attitude += 4 * (off * gain_ + 2 * epsilon<Scalar>)*speed_ * beyond;
  } else if (!within || hidden_share_ > 0) {
    b.angular_velocity += 4 * late * rates_change_;
    b.angular_momentum += 4 * late * momentum_change_;
    b.attitude += 4 * (turned + late * attitude_change_);
    if (!agree_ && !within) b.attitude = infinity<Scalar>;
  }
  // a defect that were always on the same side
  const Scalar off_course = defect_ * fastest_ * beyond;
  b.angular_velocity += off_course;
  b.angular_momentum += off_course;
  b.attitude += off_course;
  const Scalar rounding = 10 * cancellation_ * epsilon<Scalar>;
  const Scalar most = Scalar(0.2);  // four times 0.05
  if (!(b.attitude <= most && b.angular_velocity <= most))
    return {infinity<Scalar>, infinity<Scalar>, infinity<Scalar>};
  // M may be all rounding and the body's motion not
  if (!(b.angular_momentum <= most)) b.angular_momentum = infinity<Scalar>;
  const Scalar of_rates = fastest_ > 0 ? std::max(rounding, 4 * epsilon<Scalar> * rate_terms_ / fastest_) : rounding;
  return {b.angular_velocity + of_rates, b.angular_momentum + rounding, b.attitude + rounding};
}

#ifdef GYROSTAT_COMPILED
extern template MotionError<double> MotionError<double>::of<DoubleDouble>(const Motion<double>&,
                                                                          const Assembly<double, Unbounded>&, Data,
                                                                          double) noexcept;
extern template std::optional<MotionError<double>> MotionError<double>::quick<math::many_pays>(
    const Motion<double>&, const Assembly<double, Unbounded>&, double) noexcept;
extern template MotionError<double>::Bound MotionError<double>::at(double) const noexcept;
#endif

}  // namespace gyrostat::free
