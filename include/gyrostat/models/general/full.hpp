// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/known_momentum.hpp"
#include "gyrostat/models/general/outward.hpp"
#include "gyrostat/models/general/parts.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/series.hpp"
#include "gyrostat/models/general/settling.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full equations of a body with any wheels under any torques as Taylor recurrences, from one breakpoint to the next.
namespace gyrostat::general {

/// Body, wheels and torques, prepared once for all pieces.
template <Real Scalar>
struct Prepared {
  const Problem<Scalar>& problem;
  Wheels<Scalar> wheels;
  Collected<Scalar> torques;
  Settling<Scalar> settling;
  Vec3<Scalar> momentum{0, 0, 0};  ///< M at t = 0
  Scalar span = 0;                 ///< s
  Sizes<Scalar> sizes;

  /// A problem that check() finds right, for the times from 0 to `span`.
  Prepared(const Problem<Scalar>& of, Scalar span_) noexcept
      : problem(of),
        wheels(Wheels<Scalar>::of(of)),
        torques(Collected<Scalar>::of(of, span_)),
        settling(wheels),
        span(span_) {
    momentum = wheels.reduced * of.angular_velocity + wheels.momentum_of_wheels();
    sizes = sizes_of(of, wheels, torques, span);
  }
  /// Whether wheels settle so much faster than everything else changes, and for so long, that Taylor steps, which cannot be longer than about 8 over
  /// their rate, cost more than collocation.
  bool is_stiff() const noexcept {
    const Scalar fastest = settling.fastest(), pace = sizes.turning + sizes.forcing + sizes.damping;
    return fastest > 30 * pace && fastest * span > 1000;
  }
  /// Whether the full equations need the state with wheels and path.
  bool is_large() const noexcept {
    return settling.count > 0 ||
           std::any_of(torques.records.begin(), torques.records.end(), [](const auto& record) noexcept {
             return !record.sum.force_body.isZero(0) || !record.sum.force_inertial.isZero(0);
           });
  }
};

/// The numbers of a state: (w, x, y, z | M1, M2, M3, - | W1, W2, W3, -), W the integral of the angular velocity, and in the large one the
/// momenta and angles of wheels whose p is a state, by fours, and what forces have given to velocity and position:
/// (p of 0 to 3 | angles of 0 to 3 | p of 4 to 7 | angles of 4 to 7 | v1, v2, v3, - | x1, x2, x3, -).
template <bool large>
struct Places {
  static constexpr int attitude = 0, momentum = 4, turned = 8, velocity = 28, position = 32;
  static constexpr int width = large ? 36 : 12;
  /// p and angle of a wheel.
  static constexpr std::size_t wheel(std::size_t i) noexcept { return 12 + 8 * (i / 4) + i % 4; }
  static constexpr std::size_t angle(std::size_t i) noexcept { return wheel(i) + 4; }
};

/// The numbers of the state at t = 0, in the order of Places, SI.
template <Real Scalar, bool large>
std::array<Scalar, Places<large>::width> first_numbers(const Prepared<Scalar>& from) noexcept {
  using At = Places<large>;
  std::array<Scalar, At::width> x{};
  const auto& q = from.problem.attitude;
  x[0] = q.w, x[1] = q.x, x[2] = q.y, x[3] = q.z;
  for (std::size_t i = 0; i < 3; ++i) x[At::momentum + i] = from.momentum[int(i)];
  if constexpr (large)
    for (std::size_t i = 0; i < from.wheels.count; ++i) {
      const auto& law = from.wheels.laws[i];
      if (law.follows != Follows::state) continue;
      x[At::wheel(i)] = law.momentum;
      x[At::angle(i)] = law.angle;
    }
  return x;
}

/// What steps measure errors against: 1 for the quaternion and W (rad), the size of the momenta for M, of each wheel's own for p, and for v what forces
/// add in the time of a radian.
template <Real Scalar, bool large>
std::array<Scalar, Places<large>::width> scale_of(const Prepared<Scalar>& of) noexcept {
  using std::abs;
  using At = Places<large>;
  const Sizes<Scalar>& sizes = of.sizes;
  // where nothing moves any scale will do, but zero would leave the component out
  const auto positive = [](Scalar size) noexcept { return size > 0 ? size : Scalar(1); };
  const Scalar M = positive(std::max(sizes.momenta, sizes.built / 64));
  std::array<Scalar, At::width> made{1, 1, 1, 1, M, M, M, 0, 1, 1, 1, 0};
  if constexpr (large) {
    for (std::size_t i = 0; i < of.wheels.count; ++i) {
      const auto& law = of.wheels.laws[i];
      if (law.follows != Follows::state) continue;
      const Scalar push = abs(law.torque), driven = std::min(law.axial_inertia * push / law.friction, push * of.span);
      made[At::wheel(i)] = positive(abs(law.momentum) + driven + std::min(M, law.axial_inertia * M / sizes.least));
    }
    const Scalar time = sizes.turning > 0 ? std::min(of.span, 1 / sizes.turning) : of.span;
    for (std::size_t i = 0; i < 3; ++i) made[At::velocity + i] = sizes.force / of.problem.mass * time;
  }
  return made;
}

/// The state that numbers at t mean by the laws of a piece, without the torque.
template <Real Scalar, bool large>
State<Scalar> state_of(const Prepared<Scalar>& of, const Piece<Scalar>& piece, Scalar t, const Scalar* x) noexcept {
  using At = Places<large>;
  const auto& wheels = of.wheels;
  const Scalar s = t - piece.from;
  State<Scalar> made;
  made.attitude = normalised(Quat<Scalar>{x[0], x[1], x[2], x[3]});
  const Vec3<Scalar> M(x[4], x[5], x[6]), turned(x[8], x[9], x[10]);
  made.angular_momentum = M;
  Vec3<Scalar> G = M - piece.momentum_at(t);
  if constexpr (large)
    for (std::size_t i = 0; i < wheels.count; ++i)
      if (wheels.laws[i].follows == Follows::state) G -= x[At::wheel(i)] * wheels.laws[i].axis;
  const Vec3<Scalar> w = wheels.inverse * G, w0 = of.problem.angular_velocity;
  made.angular_velocity = w;
  made.work = Vec3<Scalar>(w - w0).dot(wheels.reduced * Vec3<Scalar>(w + w0)) / 2;
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    if (law.follows == Follows::body) {
      made.rotor_angle[i] = law.angle;
      continue;
    }
    const Scalar I = law.axial_inertia, own = piece.wheels[i].at(s);
    if (law.follows == Follows::state) {
      made.rotor_rate[i] = x[At::wheel(i)] / I - law.axis.dot(w);
      made.rotor_angle[i] = x[At::angle(i)];
      made.work += (x[At::wheel(i)] - law.momentum) * (x[At::wheel(i)] + law.momentum) / (2 * I);
      continue;
    }
    const Scalar integral = piece.wheels[i].integral + (piece.wheels[i].lost + piece.wheels[i].gained(s) / I);
    const bool held = law.follows == Follows::rate;
    made.rotor_rate[i] = own / I - (held ? Scalar(0) : law.axis.dot(w));
    made.rotor_angle[i] = law.angle + (integral - (held ? Scalar(0) : law.axis.dot(turned)));
    if (law.follows == Follows::integral) made.work += (own - law.momentum) * (own + law.momentum) / (2 * I);
  }
  made.impulse = rotate<Scalar>(made.attitude, M) - rotate<Scalar>(of.problem.attitude, of.momentum);
  if (of.problem.fixed) return made;
  const Vec3<Scalar> gravity = of.problem.field.gravity * of.problem.field.down;
  made.velocity = of.problem.velocity + t * gravity;
  made.position = of.problem.position + t * (of.problem.velocity + t / 2 * gravity);
  if constexpr (large) {
    const Scalar *v = x + At::velocity, *way = x + At::position;
    made.velocity += Vec3<Scalar>(v[0], v[1], v[2]);
    made.position += Vec3<Scalar>(way[0], way[1], way[2]);
  }
  return made;
}

/// Taylor recurrences over one piece, with M x w as the state M in the user's axes.
///
/// One order costs two convolutions of M x w and three of the quaternion, two for each inertial direction that the torques see. The terms
/// through one matrix-vector product. All other terms (rest) are skipped where there are none, and else summed order by order. Vectors
/// through one matrix-vector product. All else (rest) is looked at only where there is something of it, and then order by order. Vectors
/// that are seen from the body are formed from the quaternion at the start of every step, and expanded beside: they cannot drift.
template <Real Real_, bool large>
class FullSystem {
 public:
  using Scalar = Real_;
  using At = Places<large>;
  static constexpr int width = At::width;
  using Numbers = std::array<Scalar, width>;

  /// By-products of an expansion, in units of the step's unit of time.
  template <int Order>
  struct Work {
    using Vectors = VectorSeries<Scalar, Order>;
    using Series = NumberSeries<Scalar, Order>;
    using Row_ = Lanes<Scalar>;
    using Rows = Row_[Order + 1];
    Vectors rate;                          ///< w unit
    QuaternionSeries<Scalar, Order> turn;  ///< by the same
    Rows momentum_turned;                  ///< (M2, M3, M1)
    Vectors seen[7];  ///< directions; radial, along; the part of a rotating field across its axis, and ahead of it
    Row_ known_wheels[5], known_torque[5];  ///< w unit by the wheels whose momentum is known, and dM/dt by it
    Vectors field, down;
    OutwardSeries<Scalar, Order> outward;
    Rows induced;  ///< w_rel x B unit
    Rows gradient, orbit_gradient;
    Rows drive;  ///< torque that does not depend on the motion and has a factor, times unit
    Rows force_body, force_inertial;
    Vectors current[most_factors + 1];  ///< K (w_rel x B) unit of each part
    Rows torque[most_factors];          ///< of each part without its factor, times unit
    Series factor[most_factors];
    OrbitSeries<Scalar, Order> orbit;
    OrbitTurn<Scalar, Order> orbit_turn;
    Series strength, strength_out;  ///< of a dipole: b and -3 b cosine
    Rows opposed[2], opposed_unit[2];
    Scalar opposed_size[2][Order + 1];
    Row_ push[2][4];  ///< of wheels whose p is a state: T unit
  };

  /// The equations over a piece that begins with these numbers.
  FullSystem(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Numbers& start) noexcept;

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves a state onto the laws it obeys exactly: |q| = 1; R M = L, constant without a torque (then the body is turned), or with a known
  /// integral where all torque is inertial (then M gives way).
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept;

  /// W, the integral of the angular velocity, rad.
  static Vec3<Scalar> turned(const Scalar* x) noexcept { return {x[At::turned], x[At::turned + 1], x[At::turned + 2]}; }
  static Numbers first_numbers(const Prepared<Scalar>& of) noexcept {
    return general::first_numbers<Scalar, large>(of);
  }
  State<Scalar> state(Scalar t, const Scalar* x) const noexcept { return state(piece_, t, x); }
  /// The same by the laws of another piece.
  State<Scalar> state(const Piece<Scalar>& piece, Scalar t, const Scalar* x) const noexcept {
    return state_of<Scalar, large>(of_, piece, t, x);
  }

  /// What a brake opposes, N m s, by the numbers at t: the lesser of the two, if both laws are there; infinite without a brake.
  Scalar braked(Scalar t, const Scalar* x) const noexcept;
  bool has_brake() const noexcept { return sees_.total_brake || sees_.carrier_brake; }
  /// A bound of the torques that can reduce what a brake opposes, N m: motors change J w, but not M.
  Scalar torque(Scalar, const Scalar*) const noexcept {
    return sees_.carrier_brake ? of_.sizes.torque : of_.sizes.external;
  }

  Numbers scale() const noexcept { return scale_of<Scalar, large>(of_); }

  /// How many numbers at the head of the state change over the piece; those behind them stay.
  int moving() const noexcept { return moves_centre_ ? width : 12 + 8 * halves_; }

 private:
  using Row = Lanes<Scalar>;
  enum : int { radial = 3, along = 4, across = 5, leading = 6 };

  /// A sum of torques with a factor: where it stands in the piece, and what it has.
  struct Source {
    int power = 0, wave = 0;  ///< of time, or 0 and the place of the wave
    bool drives = false, forces = false, moves = false;
  };

  /// The constants of an expansion.
  struct Constants {
    Columns<Scalar> jacobian;  ///< of dM/dt by M
    Columns<Scalar> rate;      ///< of w by M
    Columns<Scalar> damping, direction[3];
    Row wheel_rate[most_wheels], wheel_torque[most_wheels];  ///< of w and of dM/dt by the momentum of a wheel
    Row first_momentum;
    Scalar unit;

    /// What w turns M by, and damps.
    GYROSTAT_INLINE Row torque_by(const Row& w) const noexcept { return cross_rows(first_momentum, w) - damping * w; }
  };

  /// What two orders have in common is summed for both at once, as loads are what an order costs: the part of the second one.
  struct Ahead {
    Row momentum[2], seen[3][2];
  };

  /// Order k + 1 from the orders up to k. Index: an integral constant, so that everything unrolls, or an int.
  template <class Index, int Order>
  GYROSTAT_INLINE void extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest, Ahead& ahead,
                              const Constants& c) const noexcept;
  /// Order k of the torque by the gradient of the orbit, without a factor; of what of it always acts, times unit.
  template <class Index, int Order>
  GYROSTAT_INLINE Row orbit_gradient_torque(Index k, const Scalar (&x)[Order + 1][width], Work<Order>& work,
                                            const Constants& c) const noexcept;
  template <class Index, int Order>
  GYROSTAT_INLINE void turn_seen(Index k, int i, Work<Order>& work, Ahead& ahead) const noexcept;
  /// All torque of order k, times unit, that is nonlinear, or depends on the motion and has a factor; and order k + 1 of all vectors and numbers
  /// that are not in the core.
  template <int Order>
  GYROSTAT_NOINLINE Row rest(int k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                             const Constants& c) const noexcept;
  template <int Order>
  Row nonlinear_torque(const Part<Scalar>& part, int k, typename Work<Order>::Vectors& current, Work<Order>& work,
                       Scalar unit) const noexcept;
  template <int Order>
  Row linear(const Part<Scalar>& part, int k, const Scalar (&x)[Order + 1][width], const Work<Order>& work,
             Scalar unit) const noexcept;

  template <int Order>
  GYROSTAT_NOINLINE void begin(Scalar t, Scalar (&x)[Order + 1][width], Work<Order>& work,
                               const Constants& c) const noexcept;
  template <int Order>
  void begin_field(Scalar t, const OrbitPoint<Scalar>& at, Work<Order>& work, Scalar unit) const noexcept;
  template <int Order>
  void begin_factors(Scalar t, Work<Order>& work, Scalar unit) const noexcept;
  template <int Order>
  void see(int k, Work<Order>& work, Scalar unit) const noexcept;
  template <int Order>
  void see_field(int k, Work<Order>& work) const noexcept;
  template <int Order>
  void oppose(int which, int k, const Row& opposed, Work<Order>& work) const noexcept;
  template <int Order>
  GYROSTAT_INLINE void turn_wheels(int k, Scalar (&x)[Order + 1][width], const Work<Order>& work,
                                   Scalar unit) const noexcept;
  template <int Order>
  void move_centre(int k, Scalar (&x)[Order + 1][width], const Work<Order>& work, Scalar unit) const noexcept;

  void take_wheels() noexcept;
  void take_parts() noexcept;

  const Prepared<Scalar>& of_;
  const Piece<Scalar>& piece_;
  Columns<Scalar> whole_;  ///< J
  ShapeTorque<Scalar> shape_;
  Directions<Scalar> directions_;
  Sees sees_;
  Vec3<Scalar> normal_{0, 0, 1};
  Part<Scalar> steady_;        ///< but for `orbit_gradient_`
  Scalar orbit_gradient_ = 0;  ///< the multiple of the orbit's gravity gradient that always acts
  int factors_ = 0;
  std::array<Part<Scalar>, most_factors> parts_;  ///< of the sources that depend on the motion
  std::vector<Source> sources_;
  bool has_rest_ = false, drives_ = false, polynomial_ = false, moves_centre_ = false;
  int wheel_count_ = 0, halves_ = 0;
  std::array<int, most_wheels> wheel_{};  ///< those whose p is a state
  Vec3<Scalar> by_wheel_[most_wheels];    ///< what w changes by with its momentum
  Row axes_[2][3], inverse_[2], friction_[2];
  KnownMomentum<Scalar> known_;
};

template <Real Real_, bool large>
FullSystem<Real_, large>::FullSystem(const Prepared<Scalar>& of, const Piece<Scalar>& piece,
                                     const Numbers& start) noexcept
    : of_(of), piece_(piece), whole_(of.wheels.whole), shape_(of.wheels.whole), known_(piece, start.data()) {
  if (of.problem.orbit) normal_ = cross<Scalar>(of.problem.orbit->radial, of.problem.orbit->along);
  take_parts();
  take_wheels();
  if constexpr (large)
    moves_centre_ = sees_.force || std::any_of(start.begin() + At::velocity, start.begin() + At::position,
                                               [](Scalar v) noexcept { return v != 0; });
}

template <Real Real_, bool large>
void FullSystem<Real_, large>::take_parts() noexcept {
  const auto& field = of_.problem.field;
  const auto look = [&](const Terms<Scalar>& terms) noexcept {
    add_directions(directions_, terms, normal_);
    sees_.add(terms);
  };
  for (const auto& terms : piece_.power) look(terms);
  for (const auto& wave : piece_.waves) look(wave.terms);
  if (sees_.down) directions_.need(field.down);
  if (sees_.field && field.magnetic == MagneticField::uniform) directions_.need(field.flux_density);
  if (sees_.field && field.magnetic != MagneticField::uniform) directions_.need(field.axis);
  if (sees_.body_force) directions_.need_all();
  sees_.orbit_axes = sees_.orbit_axes || (sees_.field && field.magnetic == MagneticField::dipole);

  steady_ = Part<Scalar>(piece_.power[0], directions_, normal_);
  orbit_gradient_ = std::exchange(steady_.orbit_gradient, Scalar(0));
  const auto take = [&](const Terms<Scalar>& terms, int power, int wave) noexcept {
    if (!terms.any()) return;
    const Part<Scalar> part(terms, directions_, normal_);
    const bool forces = !terms.force_body.isZero(0) || !terms.force_inertial.isZero(0);
    sources_.push_back({power, wave, !terms.body.isZero(0), forces, part.moves()});
    drives_ = drives_ || !terms.body.isZero(0);
    if (part.moves()) parts_[std::size_t(factors_++)] = part;
  };
  for (int i = 1; i < 4; ++i) take(piece_.power[std::size_t(i)], i, 0);
  for (std::size_t i = 0; i < piece_.waves.size(); ++i) take(piece_.waves[i].terms, 0, int(i));
  has_rest_ = steady_.is_nonlinear() || factors_ > 0 || sees_.force;
}

template <Real Real_, bool large>
void FullSystem<Real_, large>::take_wheels() noexcept {
  const Row zero = lanes(Scalar(0));
  for (int half = 0; half < 2; ++half) {
    for (Row& axis : axes_[half]) axis = zero;
    inverse_[half] = friction_[half] = zero;
  }
  for (std::size_t k = 1; k < 5; ++k) polynomial_ = polynomial_ || !piece_.momentum[k].isZero(0);
  if constexpr (large) {
    Scalar axes[3][8] = {}, inverse[8] = {}, friction[8] = {};
    for (std::size_t i = 0; i < of_.wheels.count; ++i) {
      const auto& law = of_.wheels.laws[i];
      if (law.follows != Follows::state) continue;
      by_wheel_[wheel_count_] = -(of_.wheels.inverse * law.axis);
      wheel_[std::size_t(wheel_count_++)] = int(i);
      halves_ = i < 4 ? 1 : 2;
      for (int j = 0; j < 3; ++j) axes[j][i] = law.axis[j];
      inverse[i] = 1 / law.axial_inertia, friction[i] = law.friction;
    }
    for (int half = 0; half < 2; ++half) {
      for (int j = 0; j < 3; ++j) axes_[half][j] = load(&axes[j][4 * half]);
      inverse_[half] = load(&inverse[4 * half]), friction_[half] = load(&friction[4 * half]);
    }
  }
}

template <Real Real_, bool large>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_, large>::turn_seen(Index k, int i, Work<Order>& work,
                                                         Ahead& ahead) const noexcept {
  const auto &o = work.rate.v, &o_turned = work.rate.turned;
  auto& seen = work.seen[i];
  Row first = lanes(Scalar(0)), second = first;
  const auto add = [&](int j, int at, Row& sum_1, Row& sum_2) GYROSTAT_INLINE_LAMBDA {
    sum_1 = multiply_add(seen.v[j], o_turned[at], sum_1);
    sum_2 = multiply_add(seen.turned[j], o[at], sum_2);
  };
  if (k % 2 == 1) {
    auto& next = ahead.seen[i];
    next[0] = next[1] = first;
    count_down<Scalar>(k, [&](int j) GYROSTAT_INLINE_LAMBDA {
      add(j, k - j, first, second);
      add(j, k + 1 - j, next[0], next[1]);
    });
  } else {
    first = ahead.seen[i][0], second = ahead.seen[i][1];
    add(k, 0, first, second);
  }
  add(0, k, first, second);
  seen.set(k + 1, over_next(shuffle<1, 2, 0, 3>(first - second), k));
}

template <Real Real_, bool large>
template <class Index, int Order>
GYROSTAT_INLINE auto FullSystem<Real_, large>::orbit_gradient_torque(Index k, const Scalar (&x)[Order + 1][width],
                                                                     Work<Order>& work,
                                                                     const Constants& c) const noexcept -> Row {
  if constexpr (!std::is_same_v<Index, std::integral_constant<int, 0>>) work.orbit_turn.extend(k);
  work.outward.extend(k, load(&x[k][At::attitude]), work.orbit_turn);
  work.orbit_gradient[k] = shape_(work.outward.v, k);
  return lanes(c.unit * orbit_gradient_) * work.orbit_gradient[k];
}

template <Real Real_, bool large>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_, large>::extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                                      Row& newest, Ahead& ahead, const Constants& c) const noexcept {
  const auto &o = work.rate.v, &o_turned = work.rate.turned;
  // M_j x w_(k-j) but for j = 0 and k
  Row known = lanes(Scalar(0)), known_2 = known;
  const auto add = [&](int j, int at, Row& sum_1, Row& sum_2) GYROSTAT_INLINE_LAMBDA {
    sum_1 = multiply_add(load(&x[j][At::momentum]), o_turned[at], sum_1);
    sum_2 = multiply_add(work.momentum_turned[j], o[at], sum_2);
  };
  if (k % 2 == 1) {
    auto& next = ahead.momentum;
    next[0] = next[1] = known;
    count_down<Scalar>(k - 1, [&](int j) GYROSTAT_INLINE_LAMBDA {
      add(j, k - j, known, known_2);
      if (j > 1) add(j, k + 1 - j, next[0], next[1]);
    });
  } else {
    known = ahead.momentum[0], known_2 = ahead.momentum[1];
    if (k > 2) add(k - 1, 1, known, known_2);
    add(1, k - 1, known, known_2);
  }
  known = shuffle<1, 2, 0, 3>(known - known_2);

  Row rate = c.rate * newest;
  if constexpr (large)
    for (int i = 0; i < wheel_count_; ++i) {
      const Row p = lanes(x[k][At::wheel(std::size_t(wheel_[std::size_t(i)]))]);
      rate = multiply_add(p, c.wheel_rate[i], rate), known = multiply_add(p, c.wheel_torque[i], known);
    }
  if (k < 5 && polynomial_) rate = rate + work.known_wheels[k], known = known + work.known_torque[k];
  work.rate.set(k, rate);
  work.momentum_turned[k] = shuffle<1, 2, 0, 3>(newest);
  for (int i = 0; i < directions_.count; ++i) {
    known = c.direction[i].times(work.seen[i].v[k], known);
    turn_seen(k, i, work, ahead);
  }
  if (sees_.orbit_gradient) known = known + orbit_gradient_torque(k, x, work, c);
  store(&x[k + 1][0], over_next(lanes(Scalar(0.5L)) * work.turn.extend(k, x, 0, rate), k));
  store(&x[k + 1][At::turned], over_next(rate, k));
  if (drives_) known = known + work.drive[k];
  if (has_rest_) known = known + rest(k, x, work, c);
  if constexpr (large) turn_wheels(k, x, work, c.unit);
  newest = over_next(c.jacobian.times(newest, known), k);
  store(&x[k + 1][At::momentum], newest);
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width],
                                      Work<Order>& work) const noexcept {
  const Vec3<Scalar> M(x[0][4], x[0][5], x[0][6]);
  Vec3<Scalar> G = M - piece_.momentum_at(t);
  if constexpr (large)
    for (int i = 0; i < wheel_count_; ++i) {
      const auto wheel = std::size_t(wheel_[std::size_t(i)]);
      G -= x[0][At::wheel(wheel)] * of_.wheels.laws[wheel].axis;
    }
  const Mat3<Scalar> inverse = unit * of_.wheels.inverse;
  const Vec3<Scalar> w = inverse * G;
  const Terms<Scalar>& terms = piece_.power[0];
  Constants c;
  c.unit = unit;
  c.rate = Columns<Scalar>(inverse);
  c.first_momentum = row(M);
  Mat3<Scalar> jacobian = cross_matrix<Scalar>(M) * inverse - cross_matrix<Scalar>(w);
  if (steady_.has_rate) jacobian -= terms.by_rate * inverse;
  if (steady_.has_momentum) jacobian -= unit * terms.by_momentum;
  c.jacobian = Columns<Scalar>(jacobian);
  c.damping = steady_.by_rate;
  for (int i = 0; i < directions_.count; ++i)
    for (int j = 0; j < 3; ++j) c.direction[i].of[j] = lanes(unit) * steady_.direction[i].of[j];
  for (int i = 0; i < wheel_count_; ++i) {
    c.wheel_rate[i] = lanes(unit) * row(by_wheel_[i]);
    c.wheel_torque[i] = c.torque_by(c.wheel_rate[i]);
  }

  const Row rate = row(w);
  work.rate.set(0, rate);
  work.momentum_turned[0] = shuffle<1, 2, 0, 3>(c.first_momentum);
  store(&x[1][0], lanes(Scalar(0.5L)) * work.turn.begin(x, 0, rate));
  store(&x[1][At::turned], rate);
  begin(t, x, work, c);
  Row newest = c.torque_by(rate) + lanes(unit) * (steady_.body - steady_.by_momentum * c.first_momentum);
  if (drives_) newest = newest + work.drive[0];
  if (sees_.orbit_gradient) newest = newest + orbit_gradient_torque(std::integral_constant<int, 0>{}, x, work, c);
  for (int i = 0; i < directions_.count; ++i) {
    auto& seen = work.seen[i];
    newest = c.direction[i].times(seen.v[0], newest);
    seen.set(1, cross_rows(seen.v[0], rate));
  }
  if (has_rest_) newest = newest + rest(0, x, work, c);
  if constexpr (large) turn_wheels(0, x, work, unit);
  store(&x[1][At::momentum], newest);

  Ahead ahead;
  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA { extend(k, x, work, newest, ahead, c); };
  if constexpr (Order == 20) {  // that of the ladder; others, of which little is compiled so, are slower by a twentieth
    count_up<Scalar, Order - 1>(next);
  } else {
    int k = 1;
    for (; k + 1 < Order; k += 2) next(k), next(k + 1);
    if (k < Order) next(k);
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::begin(Scalar t, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                     const Constants& c) const noexcept {
  const Scalar unit = c.unit, s = t - piece_.from;
  const Quat<Scalar> q = conjugate(Quat<Scalar>{x[0][0], x[0][1], x[0][2], x[0][3]});
  // of unit length but for rounding, so that first order sets it right
  const Scalar share = 2 - (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const auto to_body = [&](const Vec3<Scalar>& v_I) noexcept {
    return row<Scalar>(v_I + share * Vec3<Scalar>(rotate<Scalar>(q, v_I) - v_I));
  };
  for (int i = 0; i < directions_.count; ++i) work.seen[i].set(0, to_body(directions_.of[std::size_t(i)]));
  if (polynomial_) {
    // the coefficients about s, by Horner's scheme repeated
    auto h = piece_.momentum;
    Scalar scale = -1;
    for (std::size_t k = 0; k < 5; ++k, scale *= unit) {
      for (std::size_t j = 4; j > k; --j) h[j - 1] += s * h[j];
      work.known_wheels[k] = c.rate * row<Scalar>(scale * h[k]),
      work.known_torque[k] = c.torque_by(work.known_wheels[k]);
    }
  }
  if constexpr (large) {
    Scalar push[4][8] = {};
    for (int i = 0; i < wheel_count_; ++i) {
      const auto wheel = std::size_t(wheel_[std::size_t(i)]);
      const auto& T = piece_.wheels[wheel].c;
      const Cubic<Scalar> about = Cubic<Scalar>{Scalar(0), {T[0], T[1], T[2], T[3]}}.about(s);
      Scalar scale = unit;
      for (std::size_t k = 0; k < 4; ++k, scale *= unit) push[k][wheel] = scale * about.c[k];
    }
    for (int half = 0; half < halves_; ++half)
      for (int k = 0; k < 4; ++k) work.push[half][k] = load(&push[k][4 * half]);
    if (moves_centre_) {
      // without a force the centre goes on as it does
      for (int k = 1; k <= Order; ++k)
        for (int lane = At::velocity; lane < width; lane += 4) store(&x[k][lane], lanes(Scalar(0)));
      store(&x[1][At::position], lanes(unit) * load(&x[0][At::velocity]));
    }
  }
  if (!sources_.empty() || sees_.force) begin_factors(t, work, unit);
  if (!has_rest_ && !sees_.orbit_gradient) return;
  OrbitPoint<Scalar> at;
  if (sees_.orbit_gradient || sees_.orbit_axes) {
    at = orbit_at(*of_.problem.orbit, t);
    if (sees_.orbit_gradient) {
      work.orbit_turn.begin(*of_.problem.orbit, at, unit);
      work.outward.begin(at, (1 + share) / 2);
    }
    if (sees_.orbit_axes) {
      work.orbit.set(*of_.problem.orbit, at, unit);
      work.seen[radial].set(0, to_body(at.radial));
      work.seen[along].set(0, to_body(at.along));
    }
  }
  if (sees_.field && of_.problem.field.magnetic == MagneticField::rotating) {
    const Vec3<Scalar>& k = of_.problem.field.axis;
    const Vec3<Scalar> B = field_at(of_.problem, t).flux_density, part = B - k * k.dot(B);
    work.seen[across].set(0, to_body(part));
    work.seen[leading].set(0, to_body(cross<Scalar>(k, part)));
  }
  begin_field(t, at, work, unit);
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::begin_field(Scalar, const OrbitPoint<Scalar>& at, Work<Order>& work,
                                           Scalar) const noexcept {
  const auto& field = of_.problem.field;
  if (!sees_.field) return;
  if (field.magnetic == MagneticField::dipole) {
    const Scalar ratio = field.radius / at.radius, b = field.strength * ratio * ratio * ratio;
    const auto& gradient = work.orbit.gradient;
    const auto cosine = work.orbit.cosine_of(at, field.axis);
    work.strength.last = gradient.last;
    for (int k = 0; k <= gradient.last; ++k) work.strength.c[k] = b / at.gradient * gradient.c[k];
    work.strength_out.last = Order;
    for (int k = 0; k <= Order; ++k) work.strength_out.c[k] = -3 * work.strength.times(cosine.c, k);
  }
  see_field(0, work);
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::begin_factors(Scalar t, Work<Order>& work, Scalar unit) const noexcept {
  const auto clear = [](auto& rows) noexcept { std::fill_n(rows, Order + 1, lanes(Scalar(0))); };
  if (drives_) clear(work.drive);
  if (sees_.force) {
    clear(work.force_body), clear(work.force_inertial);
    work.force_body[0] = row(piece_.power[0].force_body);
    work.force_inertial[0] = row(piece_.power[0].force_inertial);
  }
  int next = 0;
  for (const Source& source : sources_) {
    const auto* wave = source.power > 0 ? nullptr : &piece_.waves[std::size_t(source.wave)];
    const Terms<Scalar>& terms = wave ? wave->terms : piece_.power[std::size_t(source.power)];
    NumberSeries<Scalar, Order> factor;
    if (wave) {
      factor.set(wave->cubic.about(t), unit, wave->rate, wave->phase);
    } else {
      Cubic<Scalar> power{piece_.from, {}};
      power.c[std::size_t(source.power)] = 1;
      factor.set(power.about(t), unit);
    }
    const auto add = [&factor](auto& rows, const Row& by) noexcept {
      for (int k = 0; k <= factor.last; ++k) rows[k] = multiply_add(lanes(factor.c[k]), by, rows[k]);
    };
    if (source.drives) add(work.drive, lanes(unit) * row(terms.body));
    if (source.forces) add(work.force_body, row(terms.force_body)), add(work.force_inertial, row(terms.force_inertial));
    if (source.moves) work.factor[next++] = factor;
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::see_field(int k, Work<Order>& work) const noexcept {
  const auto& field = of_.problem.field;
  const auto by_directions = [&](const Vec3<Scalar>& v_I, int order) noexcept {
    Row sum = lanes(Scalar(0));
    for (int i = 0; i < directions_.count; ++i)
      sum = multiply_add(lanes(directions_.share(i, v_I)), work.seen[i].v[order], sum);
    return sum;
  };
  switch (field.magnetic) {
    case MagneticField::none: break;
    case MagneticField::uniform: work.field.set(k, by_directions(field.flux_density, k)); break;
    case MagneticField::rotating:
      work.field.set(k, work.seen[across].v[k] + by_directions(field.axis * field.axis.dot(field.flux_density), k));
      break;
    case MagneticField::dipole: {
      Row sum = work.strength_out.times(work.seen[radial].v, k);
      for (int j = std::min(work.strength.last, k); j >= 0; --j)
        sum = multiply_add(lanes(work.strength.c[j]), by_directions(field.axis, k - j), sum);
      work.field.set(k, sum);
      break;
    }
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::see(int k, Work<Order>& work, Scalar unit) const noexcept {
  const auto pair = [&](int first, int second, const auto& turning) noexcept {
    auto &a = work.seen[first], &b = work.seen[second];
    const auto &o = work.rate.v, &o_turned = work.rate.turned;
    Row a_1 = lanes(Scalar(0)), a_2 = a_1, b_1 = a_1, b_2 = a_1;
    for (int j = k; j >= 0; --j) {
      const Row &w = o[k - j], &w_turned = o_turned[k - j];
      a_1 = multiply_add(a.v[j], w_turned, a_1), a_2 = multiply_add(a.turned[j], w, a_2);
      b_1 = multiply_add(b.v[j], w_turned, b_1), b_2 = multiply_add(b.turned[j], w, b_2);
    }
    const Row a_rate = shuffle<1, 2, 0, 3>(a_1 - a_2) + turning.times(b.v, k);
    const Row b_rate = shuffle<1, 2, 0, 3>(b_1 - b_2) - turning.times(a.v, k);
    a.set(k + 1, over_next(a_rate, k)), b.set(k + 1, over_next(b_rate, k));
  };
  if (sees_.orbit_axes) pair(radial, along, work.orbit.rate);
  const auto& field = of_.problem.field;
  if (sees_.field && field.magnetic == MagneticField::rotating) {
    NumberSeries<Scalar, Order> turning;
    turning.set_constant(unit * field.rate);
    pair(across, leading, turning);
  }
  if (sees_.field) {
    see_field(k + 1, work);
    work.induced[k] = lanes(-Scalar(k + 1)) * work.field.v[k + 1];
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::oppose(int which, int k, const Row& opposed, Work<Order>& work) const noexcept {
  auto &U = work.opposed[which], &z = work.opposed_unit[which];
  auto& size = work.opposed_size[which];
  U[k] = opposed;
  Row square = lanes(Scalar(0)), rest = opposed;
  for (int j = 0; j <= k; ++j) square = multiply_add(U[j], U[k - j], square);
  const Scalar total = sum(square)[0];
  if (k == 0) {
    using std::sqrt;
    size[0] = sqrt(total);
  } else {
    size[k] = math::square_root(total, size, k, 1 / (2 * size[0]));
  }
  for (int j = 1; j <= k; ++j) rest = rest - lanes(size[j]) * z[k - j];
  z[k] = lanes(1 / size[0]) * rest;
}

template <Real Real_, bool large>
template <int Order>
auto FullSystem<Real_, large>::nonlinear_torque(const Part<Scalar>& part, int k, typename Work<Order>::Vectors& current,
                                                Work<Order>& work, Scalar unit) const noexcept -> Row {
  Row sum = lanes(Scalar(0));
  if (part.has_orbital) sum = part.radial.times(work.seen[radial].v[k], part.along.times(work.seen[along].v[k], sum));
  if (part.gradient != 0) sum = multiply_add(lanes(part.gradient), work.gradient[k], sum);
  if (part.orbit_gradient != 0) sum = multiply_add(lanes(part.orbit_gradient), work.orbit_gradient[k], sum);
  if (part.has_dipole) sum = sum + cross_rows(part.dipole, work.field.v[k]);
  if (part.has_total) sum = sum - part.brake_total * work.opposed_unit[0][k];
  if (part.has_carrier) sum = sum - part.brake_carrier * work.opposed_unit[1][k];
  sum = lanes(unit) * sum;
  if (part.has_eddy) {
    current.set(k, part.eddy * work.induced[k]);
    sum = sum + cross_term(current, work.field, k);
  }
  return sum;
}

template <Real Real_, bool large>
template <int Order>
auto FullSystem<Real_, large>::linear(const Part<Scalar>& part, int k, const Scalar (&x)[Order + 1][width],
                                      const Work<Order>& work, Scalar unit) const noexcept -> Row {
  Row sum = lanes(Scalar(0));
  if (part.has_momentum) sum = sum - part.by_momentum * load(&x[k][At::momentum]);
  if (part.has_directions)
    for (int i = 0; i < directions_.count; ++i) sum = part.direction[i].times(work.seen[i].v[k], sum);
  sum = lanes(unit) * sum;
  if (part.has_rate) sum = sum - part.by_rate * work.rate.v[k];
  return sum;
}

template <Real Real_, bool large>
template <int Order>
auto FullSystem<Real_, large>::rest(int k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                    const Constants& c) const noexcept -> Row {
  const Scalar unit = c.unit;
  see(k, work, unit);
  if (sees_.total_brake) oppose(0, k, load(&x[k][At::momentum]), work);
  if (sees_.carrier_brake) oppose(1, k, whole_ * work.rate.v[k], work);
  if (sees_.down) {
    Row down = lanes(Scalar(0));
    for (int i = 0; i < directions_.count; ++i)
      down = multiply_add(lanes(directions_.share(i, of_.problem.field.down)), work.seen[i].v[k], down);
    work.down.set(k, down);
    work.gradient[k] = shape_(work.down, k);
  }
  Row sum = nonlinear_torque(steady_, k, work.current[0], work, unit);
  for (int i = 0; i < factors_; ++i) {
    const auto& part = parts_[std::size_t(i)];
    work.torque[i][k] = nonlinear_torque(part, k, work.current[i + 1], work, unit) + linear(part, k, x, work, unit);
    sum = sum + work.factor[i].times(work.torque[i], k);
  }
  if constexpr (large)
    if (sees_.force) move_centre(k, x, work, unit);
  return sum;
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::turn_wheels(int k, Scalar (&x)[Order + 1][width], const Work<Order>& work,
                                           Scalar unit) const noexcept {
  const Row rate = work.rate.v[k];
  for (int half = 0; half < halves_; ++half) {
    const std::size_t p = At::wheel(4 * std::size_t(half)), angle = At::angle(4 * std::size_t(half));
    const auto& u = axes_[half];
    const Row along_axes =
        multiply_add(u[0], shuffle<0, 0, 0, 0>(rate),
                     multiply_add(u[1], shuffle<1, 1, 1, 1>(rate), u[2] * shuffle<2, 2, 2, 2>(rate)));
    const Row turning = lanes(unit) * inverse_[half] * load(&x[k][p]) - along_axes, slowed = friction_[half] * turning;
    store(&x[k + 1][p], over_next(k < 4 ? work.push[half][k] - slowed : lanes(Scalar(0)) - slowed, k));
    store(&x[k + 1][angle], over_next(turning, k));
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::move_centre(int k, Scalar (&x)[Order + 1][width], const Work<Order>& work,
                                           Scalar unit) const noexcept {
  Row force = work.force_inertial[k];
  if (sees_.body_force) {
    Scalar component[3];
    for (int i = 0; i < 3; ++i) {
      Row product = lanes(Scalar(0));
      for (int j = 0; j <= k; ++j) product = multiply_add(work.seen[i].v[k - j], work.force_body[j], product);
      component[i] = sum(product)[0];
    }
    force = force + lanes(component[0], component[1], component[2], Scalar(0));
  }
  store(&x[k + 1][At::velocity], over_next(lanes(unit / of_.problem.mass) * force, k));
  store(&x[k + 1][At::position], over_next(lanes(unit) * load(&x[k][At::velocity]), k));
}

template <Real Real_, bool large>
void FullSystem<Real_, large>::project(Scalar t, Scalar* x, Scalar* low) const noexcept {
  Scalar excess = -1, stretched = 0;
  for (int i = 0; i < 4; ++i) excess += x[i] * x[i];
  for (int i = 0; i < 4; ++i) stretched += x[i] * low[i];
  const Scalar stretch = -excess / 2 - stretched;
  const Quat<Scalar> q{x[0], x[1], x[2], x[3]};
  Quat<Scalar> more{stretch * q.w, stretch * q.x, stretch * q.y, stretch * q.z};
  if (known_) {
    const Vec3<Scalar> M(x[4], x[5], x[6]), wanted = rotate<Scalar>(conjugate(q), known_.at(t));
    if (const Scalar size = M.norm(); known_.is_free() && size > 0) {
      // the turn d of the body with d x M = R^T L - M
      const Vec3<Scalar> d = cross<Scalar>(M / size, Vec3<Scalar>(wanted - M) / size);
      const Quat<Scalar> tilt = q * Quat<Scalar>{0, d[0] / 2, d[1] / 2, d[2] / 2};
      more = {more.w + tilt.w, more.x + tilt.x, more.y + tilt.y, more.z + tilt.z};
    } else if (!known_.is_free()) {
      for (int i = 0; i < 3; ++i) {
        x[4 + i] = wanted[i];
        low[4 + i] = 0;
      }
    }
  }
  add_to(x[0], low[0], more.w);
  add_to(x[1], low[1], more.x);
  add_to(x[2], low[2], more.y);
  add_to(x[3], low[3], more.z);
}

template <Real Real_, bool large>
auto FullSystem<Real_, large>::braked(Scalar t, const Scalar* x) const noexcept -> Scalar {
  Scalar least = infinity<Scalar>;
  if (sees_.total_brake) least = Vec3<Scalar>(x[4], x[5], x[6]).norm();
  if (sees_.carrier_brake) least = std::min(least, (of_.wheels.whole * state(t, x).angular_velocity).norm());
  return least;
}

#ifdef GYROSTAT_COMPILED
extern template void FullSystem<double, true>::expand<20>(double, double,
                                                          double (&)[21][FullSystem<double, true>::width],
                                                          FullSystem<double, true>::Work<20>&) const noexcept;
extern template void FullSystem<double, false>::expand<20>(double, double,
                                                           double (&)[21][FullSystem<double, false>::width],
                                                           FullSystem<double, false>::Work<20>&) const noexcept;
#endif

}  // namespace gyrostat::general
