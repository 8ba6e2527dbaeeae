// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lane_pair.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/math/least_change.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// The full equations (docs/heavy.md, section 2): right-hand side, Jacobian, Taylor recurrences, and those of the variational
/// equations. They are quadratic in (w, d).
namespace gyrostat::heavy {

/// w', rad/s^2.
template <Real Scalar>
Vec3<Scalar> angular_acceleration(const Problem<Scalar>& problem, const Vec3<Scalar>& omega,
                                  const Vec3<Scalar>& down) noexcept {
  return problem.torque(omega, down).cwiseQuotient(problem.inertia());
}

/// The derivative of (w', d') by (w, d).
template <Real Scalar>
Eigen::Matrix<Scalar, 6, 6> state_jacobian(const Problem<Scalar>& problem, const Vec3<Scalar>& omega,
                                           const Vec3<Scalar>& down) noexcept {
  const Vec3<Scalar>& I = problem.inertia();
  const auto times_inertia = [&](const Vec3<Scalar>& v) noexcept { return Vec3<Scalar>(I.cwiseProduct(v)); };
  const Mat3<Scalar> by_omega =
      cross_matrix<Scalar>(times_inertia(omega)) - cross_matrix<Scalar>(omega) * I.asDiagonal();
  const Mat3<Scalar> by_down =
      cross_matrix<Scalar>(problem.moment()) +
      problem.gradient() * (cross_matrix<Scalar>(down) * I.asDiagonal() - cross_matrix<Scalar>(times_inertia(down)));
  Eigen::Matrix<Scalar, 6, 6> jacobian;
  jacobian.template topLeftCorner<3, 3>() = I.cwiseInverse().asDiagonal() * by_omega;
  jacobian.template topRightCorner<3, 3>() = I.cwiseInverse().asDiagonal() * by_down;
  jacobian.template bottomLeftCorner<3, 3>() = cross_matrix<Scalar>(down);
  jacobian.template bottomRightCorner<3, 3>() = -cross_matrix<Scalar>(omega);
  return jacobian;
}

/// An estimate of the greatest |w| that is reached from a start, rad/s; zero only for a body that stays at rest.
template <Real Scalar>
Scalar rate_size(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
  // the potential energy that the start may still lose: each of its two parts falls to its least at most
  const Vec3<Scalar>& I = problem.inertia();
  const Vec3<Scalar> m = problem.moment();
  const Scalar weight = m.norm() - m.dot(start.down);
  const Scalar gradient = problem.gradient() / 2 * (I.dot(start.down.cwiseAbs2()) - I.minCoeff());
  const Scalar gain = std::max(weight, Scalar(0)) + std::max(gradient, Scalar(0));
  return std::sqrt(start.angular_velocity.squaredNorm() + 2 * gain / I.maxCoeff());
}

namespace detail {

/// The numbers (p, q, r, - | d1, d2, d3, -) at the head of a state: recurrences and projection.
///
/// With forward a+ = (a2, a3, a1) and backward a- = (a3, a1, a2) the equations are
///     w' = k w+ w- - N k d+ d- + I^-1 (m+ d- - m- d+),   d' = d+ w- - d- w+,   k = ((B - C)/A, (C - A)/B, (A - B)/C).
/// Of the pairs (w+, d+), (w-, d-) and (d-, w-) an order takes two convolutions: (w+, d+) (w-, d-) = (w+ w-, d+ d-) and
/// (w+, d+) (d-, w-) = (w+ d-, d+ w-). The terms with the two newest orders are split off, so that one order waits for the last only
/// through a shuffle, two products and two sums.
template <Real Scalar>
class EulerPoisson {
 public:
  using Row = Lanes<Scalar>;
  using Pair = LanePair<Scalar>;

  template <int Order>
  struct Rows {
    Pair forward[Order + 1], backward[Order + 1], crossed[Order + 1];  ///< (w+, d+), (w-, d-), (d-, w-)

    GYROSTAT_INLINE void keep(int k, const Pair& x) noexcept {
      forward[k] = shuffle_halves<1, 2, 0, 3, Scalar>(x);
      backward[k] = shuffle_halves<2, 0, 1, 3, Scalar>(x);
      crossed[k] = exchanged<Scalar>(backward[k]);
    }
  };

  /// What an order adds to a later derivative by its products with another: coefficients of its (w+, d+), (w-, d-), (d-, w-)
  /// and (d+, w+).
  struct Partner {
    Pair by_forward, by_backward, by_crossed, by_turned;
  };

  /// The coefficients of an expansion.
  struct Constants {
    Pair first, second;                ///< (k, 1) unit, (-N k, -1) unit
    Pair first_back, second_back;      ///< (k, -1) unit, (-N k, 1) unit
    Pair pull_forward, pull_backward;  ///< (I^-1 m+, 0) unit, (I^-1 m-, 0) unit
    Partner order_0, order_1;          ///< that of order 0 with the pull
  };

  /// What two convolutions make of the derivative but for the pull: (w+ w-, d+ d-) and (w+ d-, d+ w-).
  static GYROSTAT_INLINE Pair joined(const Pair& straight, const Pair& across, const Constants& c) noexcept {
    const Pair first = halves<Scalar>(straight, across);
    const Pair second = exchanged<Scalar>(halves<Scalar>(across, straight));
    return multiply_add(c.first, first, c.second * second);
  }

  EulerPoisson() = default;
  EulerPoisson(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept
      : inertia_(problem.inertia()), moment_(problem.moment()), gradient_(problem.gradient()) {
    const Vec3<Scalar>& I = inertia_;
    quadratic_ = {(I[1] - I[2]) / I[0], (I[2] - I[0]) / I[1], (I[0] - I[1]) / I[2]};
    pull_forward_ = {moment_[1] / I[0], moment_[2] / I[1], moment_[0] / I[2]};
    pull_backward_ = {moment_[2] / I[0], moment_[0] / I[1], moment_[1] / I[2]};
    // a rate that never changes (an axis of symmetry through the mass centre) is left alone by the projection
    for (int i = 0; i < 3; ++i) {
      const bool kept = quadratic_[i] == 0 && moment_[(i + 1) % 3] == 0 && moment_[(i + 2) % 3] == 0;
      loose_[i] = kept ? Scalar(0) : Scalar(1);
    }
    rate_ = rate_size(problem, start);
    per_whole_ = 1 / (I.maxCoeff() * rate() * rate());
    const Scalar outer_torque = moment_.norm() + gradient_ * (I.maxCoeff() - I.minCoeff());
    outer_square_ = outer_torque * outer_torque;
    potential_ = moment_.norm() + gradient_ * I.maxCoeff();
    using Wide = Wider<Scalar>;
    const auto wide = [](const Vec3<Scalar>& v) noexcept { return vector_cast<Wide>(v); };
    const Vec3<Wide> w = wide(start.angular_velocity), d = wide(start.down);
    const Vec3<Wide> Iw = wide(I).cwiseProduct(w), Id = wide(I).cwiseProduct(d);
    square_ = static_cast<Scalar>(d.squaredNorm());
    per_square_ = 1 / square_;
    momentum_ = static_cast<Scalar>(Iw.dot(d));
    energy_ =
        static_cast<Scalar>((Iw.dot(wide(loose_).cwiseProduct(w)) + gradient_ * d.dot(Id)) / 2 - wide(moment_).dot(d));
  }

  /// |d|, which stays.
  Scalar length_of_down() const noexcept { return std::sqrt(square_); }
  /// |w| that is reached, rad/s; 1 for a body at rest.
  Scalar rate() const noexcept { return rate_ > 0 ? rate_ : Scalar(1); }

  /// The coefficients, and orders 0 and 1 of the numbers.
  template <int Order, int Width>
  GYROSTAT_INLINE Constants begin(Scalar unit, Scalar (&x)[Order + 1][Width], Rows<Order>& rows) const noexcept {
    const auto row = [](const Vec3<Scalar>& v) noexcept { return lanes(v[0], v[1], v[2], Scalar(0)); };
    const Vec3<Scalar> quadratic = unit * quadratic_;
    const Row zero = lanes(Scalar(0)), k = row(quadratic), gradient = row(-gradient_ * quadratic);
    const Row one = lanes(unit), minus = lanes(-unit);
    Constants c;
    c.first = lane_pair(k, one);
    c.second = lane_pair(gradient, minus);
    c.first_back = lane_pair(k, minus);
    c.second_back = lane_pair(gradient, one);
    c.pull_forward = lane_pair(row(unit * pull_forward_), zero);
    c.pull_backward = lane_pair(row(unit * pull_backward_), zero);

    rows.keep(0, load_pair(&x[0][0]));
    const Pair forward = rows.forward[0], crossed = rows.crossed[0];
    const Pair convolved = joined(forward * rows.backward[0], forward * crossed, c);
    const Pair next = multiply_add(c.pull_forward, crossed, convolved) - c.pull_backward * exchanged<Scalar>(forward);
    store_pair(&x[1][0], next);
    rows.keep(1, next);
    c.order_0 = partner(rows, 0, c);
    c.order_0.by_crossed = c.order_0.by_crossed + c.pull_forward;
    c.order_0.by_turned = c.order_0.by_turned - c.pull_backward;
    c.order_1 = partner(rows, 1, c);
    return c;
  }

  /// Order k + 1 from the orders up to k >= 1.
  template <class Index, int Order, int Width>
  GYROSTAT_INLINE void extend(Index k, Scalar (&x)[Order + 1][Width], Rows<Order>& rows,
                              const Constants& c) const noexcept {
    const auto &forward = rows.forward, &backward = rows.backward, &crossed = rows.crossed;
    // pairs j, k - j, the youngest last
    Pair straight = lane_pair(Scalar(0)), straight_2 = straight, across = straight, across_2 = straight;
    if (k % 2 == 0) {
      straight = forward[k / 2] * backward[k / 2];
      across = forward[k / 2] * crossed[k / 2];
    }
    count_down<Scalar>((k - 1) / 2 - 1, [&](int j) GYROSTAT_INLINE_LAMBDA {
      const int early = j + 1, late = k - early;
      straight = multiply_add(forward[early], backward[late], straight);
      straight_2 = multiply_add(forward[late], backward[early], straight_2);
      across = multiply_add(forward[early], crossed[late], across);
      across_2 = multiply_add(forward[late], crossed[early], across_2);
    });
    Pair known = joined(straight + straight_2, across + across_2, c);
    if (k >= 3) known = with(c.order_1, rows, k - 1, known);
    const Pair next = over_next<Scalar>(with(c.order_0, rows, k, known), k);
    store_pair(&x[k + 1][0], next);
    rows.keep(k + 1, next);
  }

  /// Moves (w, d) onto |d|, energy and vertical momentum of the start.
  void project(Scalar* x, Scalar* low) const noexcept;

 private:
  template <int Order>
  static GYROSTAT_INLINE Partner partner(const Rows<Order>& rows, int k, const Constants& c) noexcept {
    const Pair forward = rows.forward[k], turned = exchanged<Scalar>(forward);
    const Pair w_forward = halves<Scalar>(forward, turned), d_forward = halves<Scalar>(turned, forward);
    const Pair w_backward = halves<Scalar>(rows.backward[k], rows.crossed[k]);
    const Pair d_backward = halves<Scalar>(rows.crossed[k], rows.backward[k]);
    return {c.first * w_backward, c.first_back * w_forward, c.second_back * d_forward, c.second * d_backward};
  }

  /// rest + the products of order k with the partner
  template <int Order>
  static GYROSTAT_INLINE Pair with(const Partner& partner, const Rows<Order>& rows, int k, const Pair& rest) noexcept {
    const Pair forward = rows.forward[k];
    return multiply_add(partner.by_turned, exchanged<Scalar>(forward),
                        multiply_add(partner.by_forward, forward, rest)) +
           multiply_add(partner.by_crossed, rows.crossed[k], partner.by_backward * rows.backward[k]);
  }

  Vec3<Scalar> inertia_, moment_, quadratic_, pull_forward_, pull_backward_;
  Vec3<Scalar> loose_;   ///< 0 for a rate that never changes, else 1
  Scalar gradient_;      ///< 1/s^2
  Scalar outer_square_;  ///< of a bound of the torque but for the gyroscopic one, (N m)^2
  Scalar potential_;     ///< a bound of the potential energy, J
  Scalar square_, per_square_, energy_,
      momentum_;  ///< of the start: |d|^2, energy without that of the rates that never change, vertical momentum
  Scalar rate_, per_whole_;  ///< rate_size, rad/s; 1 over the energy that it stands for, 1/J
};

template <Real Scalar>
void EulerPoisson<Scalar>::project(Scalar* x, Scalar* low) const noexcept {
  const Vec3<Scalar> w(x[0], x[1], x[2]), d(x[4], x[5], x[6]);
  const Vec3<Scalar> w_low(low[0], low[1], low[2]), d_low(low[4], low[5], low[6]);
  const Scalar stretch = ((square_ - d.squaredNorm()) / 2 - d.dot(d_low)) * per_square_;
  Vec3<Scalar> d_change = stretch * d;

  // gradients of energy and vertical momentum; along d they are tangential, where |d| stays
  const Vec3<Scalar> Iw = inertia_.cwiseProduct(w), Id = inertia_.cwiseProduct(d);
  const Vec3<Scalar> energy_by_d = gradient_ * Id - moment_;
  const Vec3<Scalar> more = d_low + d_change;
  const Vec3<Scalar> w_free = loose_.cwiseProduct(w), d_free = loose_.cwiseProduct(d);
  const Scalar energy = (Iw.dot(w_free) + gradient_ * d.dot(Id)) / 2 - moment_.dot(d);
  const Scalar lacking_energy = (energy_ - energy) - Iw.dot(loose_.cwiseProduct(w_low)) - energy_by_d.dot(more);
  const Scalar lacking_momentum = (momentum_ - Iw.dot(d)) - Id.dot(w_low) - Iw.dot(more);
  const Vec3<Scalar> e = energy_by_d - d * (d.dot(energy_by_d) * per_square_), s = Iw - d * (d.dot(Iw) * per_square_);

  // The least change in the norm dw.I dw + give |dd|^2 whole that corrects both, or the energy alone where they are not independent. A
  // fast spin hardly changes while d goes round: then the steps err in d, by the ratio of d' to w' more than in w.
  const Scalar give = std::clamp((cross<Scalar>(Iw, w).squaredNorm() + outer_square_) * per_whole_ * per_whole_,
                                 Scalar(1e-6L), Scalar(1));
  Scalar ee = give * Iw.dot(w_free) + per_whole_ * e.squaredNorm();
  const Scalar es = give * Iw.dot(d_free) + per_whole_ * e.dot(s),
               ss_of_all = give * Id.dot(d_free) + per_whole_ * s.squaredNorm();
  // rounding of a great energy must not move d: a defect that small is corrected only as far as it moves d by a rounding
  const Scalar size = Iw.dot(w_free) / 2 + potential_;
  if (std::abs(lacking_energy) <= 64 * epsilon<Scalar> * size) ee += per_whole_ * size * size;
  // nor that of the momentum, where the axis is so near the vertical that hardly anything changes it
  const Scalar momentum = Iw.norm() * d.norm();
  Scalar ss = ss_of_all;
  if (std::abs(lacking_momentum) <= 64 * epsilon<Scalar> * momentum) ss += per_whole_ * momentum * momentum;
  const auto [by_energy, by_momentum] = math::least_change(lacking_energy, lacking_momentum, ee, es, ss);
  const Vec3<Scalar> w_change = give * (by_energy * w_free + by_momentum * d_free);
  d_change += per_whole_ * (by_energy * e + by_momentum * s);
  for (int i = 0; i < 3; ++i) {
    add_to(x[i], low[i], w_change[i]);
    add_to(x[4 + i], low[4 + i], d_change[i]);
  }
}

}  // namespace detail

/// Taylor recurrences of the full equations. A state is (p, q, r, - | d1, d2, d3, -), and where the body's attitude is asked for
/// (turning) also its quaternion (w, x, y, z), body to inertial.
template <Real Real_, bool turning = false>
class FullSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = turning ? 12 : 8;
  using Numbers = std::array<Scalar, width>;

  template <int Order>
  struct Work {
    typename detail::EulerPoisson<Scalar>::template Rows<Order> rows;
    QuaternionSeries<Scalar, turning ? Order : 0> turn;  ///< half the angular velocity times the unit
  };

  /// The motion from `start`, from which the projection takes its constants. Turning: start.attitude has unit norm and
  /// row 3 of its tensor is -start.down.
  FullSystem(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept : equations_(problem, start) {
    const auto &w = start.angular_velocity, &d = start.down;
    start_ = {w[0], w[1], w[2], 0, d[0], d[1], d[2], 0};
    if constexpr (turning) {
      const auto& q = start.attitude;
      start_[8] = q.w, start_[9] = q.x, start_[10] = q.y, start_[11] = q.z;
    }
  }

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves a state onto what it keeps: |d|, energy, vertical momentum; and the attitude onto unit norm and onto d.
  void project(Scalar, Scalar* x, Scalar* low) const noexcept;

  /// The numbers of the start.
  const Numbers& start() const noexcept { return start_; }

  /// The state that numbers mean; the attitude is not set where it is not asked for.
  State<Scalar> state(const Scalar* x) const noexcept {
    State<Scalar> s;
    s.angular_velocity = {x[0], x[1], x[2]};
    // of its length also inside a step, where the series sums to some roundings
    const Vec3<Scalar> down{x[4], x[5], x[6]};
    s.down = equations_.length_of_down() / down.norm() * down;
    if constexpr (turning) s.attitude = normalised(Quat<Scalar>{x[8], x[9], x[10], x[11]});
    return s;
  }

  /// What the steps measure errors against: the size of the rates, 1 for the rest.
  Numbers scale() const noexcept {
    const Scalar w = equations_.rate();
    Numbers scale{w, w, w, 0, 1, 1, 1, 0};
    if constexpr (turning) scale[8] = scale[9] = scale[10] = scale[11] = 1;
    return scale;
  }

 private:
  using Row = Lanes<Scalar>;

  /// Order k + 1 of the quaternion.
  template <class Index, int Order>
  GYROSTAT_INLINE void turn(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, const Row& half) const noexcept {
    const Row motion = half * load(&x[k][0]);
    store(&x[k + 1][8], over_next(work.turn.extend(k, x, 8, motion), k));
  }

  detail::EulerPoisson<Scalar> equations_;
  Numbers start_{};
};

template <Real Real_, bool turning>
template <int Order>
void FullSystem<Real_, turning>::expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width],
                                        Work<Order>& work) const noexcept {
  const auto c = equations_.begin(unit, x, work.rows);
  const Row half = lanes(unit / 2);
  if constexpr (turning) {
    store(&x[1][8], work.turn.begin(x, 8, half * load(&x[0][0])));
  }
  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA {
    equations_.extend(k, x, work.rows, c);
    if constexpr (turning) turn(k, x, work, half);
  };
  count_up<Scalar, Order - 1>(next);
}

template <Real Real_, bool turning>
void FullSystem<Real_, turning>::project(Scalar, Scalar* x, Scalar* low) const noexcept {
  equations_.project(x, low);
  if constexpr (turning) {
    Scalar missing = 1, along = 0;
    for (int i = 8; i < 12; ++i) missing -= x[i] * x[i];
    for (int i = 8; i < 12; ++i) along += x[i] * low[i];
    const Scalar stretch = missing / 2 - along;
    const Scalar length = 1 + stretch;
    const Quat<Scalar> q{length * x[8], length * x[9], length * x[10], length * x[11]};
    // the least turn of the body that brings down onto d; what q still has in low turns it too
    const Vec3<Scalar> seen = rotate<Scalar>(conjugate(q), Vec3<Scalar>(0, 0, -1));
    const Vec3<Scalar> d = Vec3<Scalar>(x[4], x[5], x[6]) - seen + Vec3<Scalar>(low[4], low[5], low[6]);
    const Quat<Scalar> rest = conjugate(q) * Quat<Scalar>{low[8], low[9], low[10], low[11]};
    const Vec3<Scalar> pending(2 * rest.x, 2 * rest.y, 2 * rest.z);
    Vec3<Scalar> by = cross<Scalar>(d, seen);
    by -= pending - seen * seen.dot(pending);
    const Quat<Scalar> turned = q * Quat<Scalar>{0, by[0] / 2, by[1] / 2, by[2] / 2};
    add_to(x[8], low[8], stretch * x[8] + turned.w);
    add_to(x[9], low[9], stretch * x[9] + turned.x);
    add_to(x[10], low[10], stretch * x[10] + turned.y);
    add_to(x[11], low[11], stretch * x[11] + turned.z);
  }
}

/// Taylor recurrences of the full equations together with those of six small changes of the start: a state is (p, q, r, -, d1, d2, d3, -)
/// and eight such numbers for the derivative of (w, d) by each of (p, q, r, d1, d2, d3) at the start.
template <Real Real_>
class VariationalSystem {
 public:
  using Scalar = Real_;
  static constexpr int columns = 6;
  static constexpr int width = 8 * (1 + columns);
  using Numbers = std::array<Scalar, width>;
  using Matrix = Eigen::Matrix<Scalar, columns, columns>;

  template <int Order>
  struct Work {
    typename detail::EulerPoisson<Scalar>::template Rows<Order> rows, change[columns];
  };

  VariationalSystem(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept : equations_(problem, start) {
    const auto &w = start.angular_velocity, &d = start.down;
    start_ = {w[0], w[1], w[2], 0, d[0], d[1], d[2], 0};
    for (int i = 0; i < columns; ++i) start_[std::size_t(8 * (i + 1) + place(i))] = 1;
  }

  template <int Order>
  void expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves (w, d) onto |d|, energy and vertical momentum of the start; the derivatives stay.
  void project(Scalar, Scalar* x, Scalar* low) const noexcept { equations_.project(x, low); }

  const Numbers& start() const noexcept { return start_; }

  State<Scalar> state(const Scalar* x) const noexcept {
    State<Scalar> s;
    s.angular_velocity = {x[0], x[1], x[2]};
    s.down = {x[4], x[5], x[6]};
    return s;
  }

  /// The derivative of (w, d) by (w, d) at the start. It is that of the equations for d of any length; along what they keep it obeys
  /// grad(F) at the time . matrix = grad(F) at the start, F any of energy, vertical momentum, |d|^2.
  Matrix derivative(const Scalar* x) const noexcept {
    Matrix matrix;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < columns; ++i) matrix(i, j) = x[8 * (j + 1) + place(i)];
    return matrix;
  }

  /// As FullSystem's, and the derivatives against their units.
  Numbers scale() const noexcept {
    const Scalar w = equations_.rate();
    Numbers scale{};
    for (int j = 0; j <= columns; ++j)
      for (int i = 0; i < columns; ++i) {
        const Scalar by = j >= 1 && j <= 3 ? w : Scalar(1);  // derivatives by a rate
        scale[std::size_t(8 * j + place(i))] = (i < 3 ? w : Scalar(1)) / by;
      }
    return scale;
  }

 private:
  using Pair = LanePair<Scalar>;
  using Equations = detail::EulerPoisson<Scalar>;
  static constexpr int place(int i) noexcept { return i < 3 ? i : i + 1; }

  Equations equations_;
  Numbers start_{};
};

template <Real Real_>
template <int Order>
void VariationalSystem<Real_>::expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width],
                                      Work<Order>& work) const noexcept {
  const auto c = equations_.begin(unit, x, work.rows);
  const auto& rows = work.rows;
  for (int k = 0; k < Order; ++k) {
    if (k > 0) equations_.extend(k, x, work.rows, c);
    for (int column = 0; column < columns; ++column) {
      auto& change = work.change[column];
      change.keep(k, load_pair(&x[k][8 * (column + 1)]));
      Pair straight = lane_pair(Scalar(0)), straight_2 = straight, across = straight, across_2 = straight;
      for (int j = k; j >= 0; --j) {
        const int i = k - j;
        straight = multiply_add(rows.forward[j], change.backward[i], straight);
        straight_2 = multiply_add(rows.backward[j], change.forward[i], straight_2);
        across = multiply_add(rows.forward[j], change.crossed[i], across);
        across_2 = multiply_add(rows.crossed[j], change.forward[i], across_2);
      }
      const Pair pull = c.pull_forward * change.crossed[k] - c.pull_backward * exchanged<Scalar>(change.forward[k]);
      const Pair convolved = Equations::joined(straight + straight_2, across + across_2, c);
      store_pair(&x[k + 1][8 * (column + 1)], over_next<Scalar>(convolved + pull, k));
    }
  }
}

#ifdef GYROSTAT_COMPILED
extern template void FullSystem<double, true>::expand<20>(double, double,
                                                          double (&)[21][FullSystem<double, true>::width],
                                                          FullSystem<double, true>::Work<20>&) const noexcept;
extern template void FullSystem<double, false>::expand<20>(double, double,
                                                           double (&)[21][FullSystem<double, false>::width],
                                                           FullSystem<double, false>::Work<20>&) const noexcept;
extern template void VariationalSystem<double>::expand<20>(double, double,
                                                           double (&)[21][VariationalSystem<double>::width],
                                                           VariationalSystem<double>::Work<20>&) const noexcept;
#endif

}  // namespace gyrostat::heavy
