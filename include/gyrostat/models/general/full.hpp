// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/invariants.hpp"
#include "gyrostat/models/general/known_momentum.hpp"
#include "gyrostat/models/general/outward.hpp"
#include "gyrostat/models/general/parts.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/prepared.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/series.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full equations of a body with any wheels under any torques as Taylor recurrences, from one breakpoint to the next.
namespace gyrostat::general {

/// Taylor recurrences over one piece, with M x w as the state M in the user's axes.
///
/// One order costs two convolutions of M x w and three of the quaternion, two for each inertial direction that the torques see. The terms
/// with the newest order of M are split off as one matrix, the Jacobian at the start of the step, so that an order waits for the last only
/// through one matrix-vector product. All else (rest) is skipped where there is nothing of it, and else summed order by order. Vectors
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

  /// The equations over a piece that begins with these numbers. lost: of them, by rounding; before: what was known in the piece before; both where the
  /// motion goes on from it.
  FullSystem(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Numbers& start, const Numbers& lost = {},
             const KnownMomentum<Scalar>* before = nullptr) noexcept;

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves a state onto the laws it obeys exactly: |q| = 1; R M = L, constant without a torque (then the body is turned), or with a known
  /// integral where all torque is inertial (then M gives way); else energy and momentum, where they are kept.
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

  /// R M over the piece, where it is known: for the piece behind.
  const KnownMomentum<Scalar>& known() const noexcept { return known_; }
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
  Columns<Scalar> whole_, inertia_inverse_;  ///< J; the inverse of it without the wheels that turn by themselves
  Row known_wheels_[5];  ///< momentum of the wheels with one that is known, by powers of the time since the piece began
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
  std::array<int, most_wheels> wheel_{};                 ///< those whose p is a state
  Row by_wheel_[most_wheels], wheel_axis_[most_wheels];  ///< what w changes by with its momentum; its axis
  Row axes_[2][3], inverse_[2], friction_[2];
  KnownMomentum<Scalar> known_;
  Invariants<Scalar> invariants_;
};

template <Real Real_, bool large>
FullSystem<Real_, large>::FullSystem(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Numbers& start,
                                     const Numbers& lost, const KnownMomentum<Scalar>* before) noexcept
    : of_(of),
      piece_(piece),
      whole_(of.wheels.whole),
      inertia_inverse_(of.wheels.inverse),
      shape_(of.wheels.whole),
      known_(piece, start.data(), lost.data(), before),
      invariants_(of, piece, start.data(), lost.data()) {
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
  for (std::size_t k = 0; k < 5; ++k) {
    known_wheels_[k] = row<Scalar>(piece_.momentum[k]);
    polynomial_ = polynomial_ || (k > 0 && !piece_.momentum[k].isZero(0));
  }
  if constexpr (large) {
    Scalar axes[3][8] = {}, inverse[8] = {}, friction[8] = {};
    for (std::size_t i = 0; i < of_.wheels.count; ++i) {
      const auto& law = of_.wheels.laws[i];
      if (law.follows != Follows::state) continue;
      by_wheel_[wheel_count_] = row<Scalar>(-(of_.wheels.inverse * law.axis));
      wheel_axis_[wheel_count_] = row<Scalar>(law.axis);
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
void FullSystem<Real_, large>::project(Scalar t, Scalar* x, Scalar* low) const noexcept {
  Scalar excess = -1, stretched = 0;
  for (int i = 0; i < 4; ++i) excess += x[i] * x[i];
  for (int i = 0; i < 4; ++i) stretched += x[i] * low[i];
  const Scalar stretch = -excess / 2 - stretched;
  const Quat<Scalar> q{x[0], x[1], x[2], x[3]};
  Quat<Scalar> more{stretch * q.w, stretch * q.x, stretch * q.y, stretch * q.z};
  Vec3<Scalar> turn(0, 0, 0);
  if (known_ && !known_.is_free()) {
    const Vec3<Scalar> missing = known_.missing(t, x, low);
    for (int i = 0; i < 3; ++i) add_to(x[4 + i], low[4 + i], missing[i]);
  } else if (invariants_) {
    const Quat<Scalar> unit{q.w + more.w, q.x + more.x, q.y + more.y, q.z + more.z};
    const auto missing = invariants_.missing(t, unit, x, low);
    for (int i = 0; i < 3; ++i) add_to(x[4 + i], low[4 + i], missing.momentum[i]);
    turn = missing.turn;
  }
  const Vec3<Scalar> M(x[4], x[5], x[6]);
  if (const Scalar size = M.norm(); known_ && known_.is_free() && size > 0) {
    // that with turn x M = R^T L - M
    const Vec3<Scalar> wanted = rotate<Scalar>(conjugate(q), known_.at(t));
    turn = cross<Scalar>(M / size, Vec3<Scalar>(wanted - M) / size);
  }
  const Quat<Scalar> tilt = q * Quat<Scalar>{0, turn[0] / 2, turn[1] / 2, turn[2] / 2};
  more = {more.w + tilt.w, more.x + tilt.x, more.y + tilt.y, more.z + tilt.z};
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

#include "gyrostat/models/general/full_orders.hpp"
