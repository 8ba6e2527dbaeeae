// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/free/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/rotate_once.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full equations of a free gyrostat as Taylor recurrences:
///     M = J omega + l,  dM/dt = M x omega,  dq/dt = q (0, omega)/2,  dW/dt = omega.
namespace gyrostat::free {

/// What the full equations follow, body axes. Rates and momentum are both there: where one is far below l it cannot be had from the
/// other to a rounding of itself.
template <Real Scalar>
struct FullState {
  Quat<Scalar> attitude{};                 ///< body to inertial, unit
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< omega, rad/s
  Vec3<Scalar> angular_momentum{0, 0, 0};  ///< M, N m s
  Vec3<Scalar> turned{0, 0, 0};  ///< W, integral of omega from t = 0, rad: what the angles of rotors are made of
};

/// Taylor recurrences in principal axes. A state is (w, x, y, z | X1, X2, X3, 0 | W1, W2, W3, 0), the quaternion from principal axes to
/// inertial ones. X is J omega or M, the lesser of the two at the start, so that steps lose a rounding of the lesser one, however large
/// l is:
///     omega = a X - g,  M = X + l:  X = J omega with g = 0,  or  X = M with g = a l and M = X.
///
/// One order costs one symmetric convolution for X x a X and three for the quaternion. Each is split into the terms known an order
/// earlier and the newest one, and the newest terms of dX/dt are one matrix, the Jacobian at the start of the step: so one order waits for
/// the last only through one matrix-vector product.
template <Real Real_>
class FullSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = 12;
  using Numbers = std::array<Scalar, width>;

  /// By-products of an expansion: rows (X2, X3, X1, 0), (X3, X1, X2, 0) and (omega unit/2, 0).
  template <int Order>
  struct Work {
    Lanes<Scalar> forward[Order + 1];
    Lanes<Scalar> backward[Order + 1];
    QuaternionSeries<Scalar, Order> turn;
  };

  /// The motion of a problem that Problem::check() finds right, from which the projection takes its constants.
  explicit FullSystem(const Problem<Scalar>& problem) noexcept;

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves a state onto the laws it obeys exactly: |q| = 1, P M = L by a turn of the body, and against the drift by rounding energy and
  /// |M|, by a change of each X_i relative to itself, so that an axis that is nearly kept is not left by it.
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept;

  /// The numbers at t = 0.
  const Numbers& start() const noexcept { return start_; }
  /// The state, in body axes, that numbers mean.
  FullState<Scalar> state(Scalar t, const Scalar* x) const noexcept;

  /// What the steps measure errors against: 1 for the quaternion and W (rad), |X| for X.
  Numbers scale() const noexcept {
    // where nothing moves any scale will do, but zero would leave the component out
    const Scalar size = magnitude(Vec3<Scalar>(start_[4], start_[5], start_[6])), s = size > 0 ? size : Scalar(1);
    return {1, 1, 1, 1, s, s, s, 0, 1, 1, 1, 0};
  }

  /// Greatest errors of omega (rad/s) and M (N m s), where X is known to `relative` of its greatest norm.
  struct Losses {
    Scalar angular_velocity, angular_momentum;
  };
  Losses losses(Scalar relative) const noexcept {
    return {relative * (a_[2] * greatest_ + g_.norm()), relative * (greatest_ + l_.norm())};
  }

 private:
  using Row = Lanes<Scalar>;

  static GYROSTAT_INLINE Row row(const Vec3<Scalar>& v) noexcept { return lanes(v[0], v[1], v[2], Scalar(0)); }

  /// The constants of an expansion, times unit.
  struct Constants {
    Row jacobian[3];  ///< columns of the derivative of dX/dt
    Row quadratic;    ///< a_k - a_j
    Row motion;       ///< a/2
  };

  /// Order k + 1 from the orders up to k. Index: an integral constant, so that everything unrolls, or an int.
  template <class Index, int Order>
  GYROSTAT_INLINE void extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                              const Constants& c) const noexcept;

  /// Row k + 1 of the quaternion but for its newest terms, and of W, from omega unit/2 of order k.
  template <class Index, int Order>
  GYROSTAT_INLINE void turn(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                            const Row& motion) const noexcept;

  /// Two functions of X that stay, in two words: M.M/2, and omega.J omega/2 less a2 times that, in which differences of a alone are left, so that
  /// beside the middle axis it is known relative to itself; and the sums of the magnitudes of their terms. Less constants.
  struct Levels {
    Sum<Scalar> energy{0, 0}, momentum{0, 0};
    Scalar energy_parts = 0, momentum_parts = 0;
  };
  static void add_term(Sum<Scalar>& sum, Scalar& parts, Scalar factor, Scalar x, Scalar rest) noexcept {
    using std::abs, std::fma;
    const Scalar term = factor * x, error = fma(factor, x, -term) + factor * rest;
    const Scalar total = sum.high + term, part = total - sum.high;
    sum.low += ((sum.high - (total - part)) + (term - part)) + error;
    sum.high = total;
    parts += abs(term);
  }
  /// low: what rounding left over of X.
  Levels levels(const Vec3<Scalar>& X, const Vec3<Scalar>& low) const noexcept {
    Levels at;
    for (int i = 0; i < 3; ++i) {
      const Scalar square = X[i] * X[i], rest = std::fma(X[i], X[i], -square) + 2 * X[i] * low[i];
      add_term(at.energy, at.energy_parts, gap_[i] / 2, square, rest);
      add_term(at.momentum, at.momentum_parts, Scalar(0.5L), square, rest);
      add_term(at.energy, at.energy_parts, -pull_[i], X[i], low[i]);
      add_term(at.momentum, at.momentum_parts, l_[i], X[i], low[i]);
    }
    return at;
  }
  /// By which shares of themselves the components of X have to change so that energy and |M| are those of the start.
  Vec3<Scalar> missing(const Vec3<Scalar>& X, const Vec3<Scalar>& low) const noexcept;

  Vec3<Scalar> a_, quadratic_;  ///< 1/J and (a3 - a2, a1 - a3, a2 - a1)
  Vec3<Scalar> g_, l_;          ///< one of the two is 0
  Vec3<Scalar> gap_, pull_;     ///< of the energy kept: a - a2 and g + a2 l, or a and g
  Mat3<Scalar> linear_;         ///< of dX/dt
  Mat3<Scalar> R_BP_;
  Quat<Scalar> q_BP_;
  Vec3<Scalar> L_I_;
  static constexpr Scalar slack_ = 64 * epsilon<Scalar>;  ///< of the levels by rounding, relative to their parts
  Levels level_;
  Scalar greatest_;  ///< a bound of |X|
  Numbers start_;
};

template <Real Real_>
FullSystem<Real_>::FullSystem(const Problem<Scalar>& problem) noexcept {
  // what near moments differ by is the first that rounding takes, and over many turns it decides
  PrincipalProblem<Scalar> p;
  if constexpr (std::is_same_v<Scalar, double>)
    p = PrincipalProblem<DoubleDouble>::of(problem.template cast<DoubleDouble>()).template cast<double>();
  else p = PrincipalProblem<Scalar>::of(problem);
  const bool steps_momentum = magnitude(p.M) < magnitude(p.G);
  a_ = p.inverse;
  quadratic_ = {p.gaps(1, 2), p.gaps(2, 0), p.gaps(0, 1)};
  g_ = l_ = Vec3<Scalar>(0, 0, 0);
  if (steps_momentum) g_ = a_.cwiseProduct(p.l);
  else l_ = p.l;
  // beside much rotor momentum the energy is known better by itself
  const bool alone = magnitude(l_) > magnitude(p.G);
  gap_ = alone ? a_ : Vec3<Scalar>(-quadratic_[2], Scalar(0), quadratic_[0]);
  pull_ = alone ? g_ : Vec3<Scalar>(g_ + a_[1] * l_);
  linear_ = cross_matrix<Scalar>(l_) * a_.asDiagonal();
  linear_ += cross_matrix<Scalar>(g_);
  R_BP_ = p.R_BP;
  q_BP_ = from_matrix<Scalar>(p.R_BP);
  const Quat<Scalar> q = as_unit(problem.attitude) * q_BP_;
  L_I_ = rotate_once(q, p.M);
  const Vec3<Scalar> X = steps_momentum ? p.M : p.G;
  level_ = levels(X, Vec3<Scalar>(0, 0, 0));
  // J omega lies on an ellipsoid of constant energy
  greatest_ = steps_momentum ? X.norm() : std::sqrt(p.moments[0]) * a_.cwiseSqrt().cwiseProduct(X).norm();
  start_ = {q.w, q.x, q.y, q.z, X[0], X[1], X[2], 0, 0, 0, 0, 0};
}

template <Real Real_>
FullState<Real_> FullSystem<Real_>::state(Scalar, const Scalar* x) const noexcept {
  const Vec3<Scalar> X(x[4], x[5], x[6]), W(x[8], x[9], x[10]);
  const Quat<Scalar> q{x[0], x[1], x[2], x[3]};
  return {normalised(q * conjugate(q_BP_)), R_BP_ * (a_.cwiseProduct(X) - g_), R_BP_ * (X + l_), R_BP_ * W};
}

template <Real Real_>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_>::turn(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                             const Row& motion) const noexcept {
  store(&x[k + 1][0], over_next(work.turn.extend(k, x, 0, motion), k));
  store(&x[k + 1][8], over_next(motion + motion, k));
}

template <Real Real_>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_>::extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                                               const Constants& c) const noexcept {
  const Row y0 = shuffle<0, 0, 0, 0>(newest), y1 = shuffle<1, 1, 1, 1>(newest), y2 = shuffle<2, 2, 2, 2>(newest);

  // terms known since the last order, the youngest last
  Row product = lanes(Scalar(0)), product_2 = product;
  if (k % 2 == 0) product = work.forward[k / 2] * work.backward[k / 2];
  count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA {
    product = multiply_add(work.forward[j], work.backward[k - j], product);
    product_2 = multiply_add(work.forward[k - j], work.backward[j], product_2);
  });
  const Row known = c.quadratic * (product + product_2);
  const Row next =
      over_next(multiply_add(c.jacobian[0], y0, multiply_add(c.jacobian[1], y1, known)) + c.jacobian[2] * y2, k);

  turn(k, x, work, c.motion * newest);
  store(&x[k + 1][4], next);
  if (k + 1 < Order) {
    work.forward[k] = shuffle<1, 2, 0, 3>(newest);
    work.backward[k] = shuffle<2, 0, 1, 3>(newest);
  }
  newest = next;
}

template <Real Real_>
template <int Order>
void FullSystem<Real_>::expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept {
  const Vec3<Scalar> X(x[0][4], x[0][5], x[0][6]);
  const Vec3<Scalar> quadratic = unit * quadratic_;
  Mat3<Scalar> jacobian = unit * linear_;
  const Vec3<Scalar> forward(X[1], X[2], X[0]), backward(X[2], X[0], X[1]);
  const Vec3<Scalar> rate = jacobian * X + quadratic.cwiseProduct(forward.cwiseProduct(backward));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    jacobian(i, j) += quadratic[i] * X[k];
    jacobian(i, k) += quadratic[i] * X[j];
  }

  Constants c;
  for (int j = 0; j < 3; ++j) c.jacobian[j] = row(jacobian.col(j));
  c.quadratic = row(quadratic);
  const Scalar half = unit / 2;
  c.motion = row(half * a_);

  const Row motion = row(half * (a_.cwiseProduct(X) - g_));
  store(&x[1][0], work.turn.begin(x, 0, motion));
  Row newest = row(rate);
  store(&x[1][4], newest);
  store(&x[1][8], motion + motion);

  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA { extend(k, x, work, newest, c); };
  count_up<Scalar, Order - 1>(next);
}

template <Real Real_>
Vec3<Real_> FullSystem<Real_>::missing(const Vec3<Scalar>& X, const Vec3<Scalar>& low) const noexcept {
  const Levels at = levels(X, low);
  const auto lacks = [](const Sum<Scalar>& wanted, const Sum<Scalar>& found, Scalar parts) noexcept {
    return parts > 0 ? ((wanted.high - found.high) + (wanted.low - found.low)) / parts : Scalar(0);
  };
  const Scalar e = lacks(level_.energy, at.energy, at.energy_parts);
  const Scalar m = lacks(level_.momentum, at.momentum, at.momentum_parts);
  // What is more than rounding explains comes of truncation, which has to be seen by a comparison of runs.
  if (!(std::abs(e) <= slack_ && std::abs(m) <= slack_)) return {0, 0, 0};
  // least squares, damped where the two can hardly be told apart
  constexpr Scalar damping = Scalar(1e-4L);
  const Vec3<Scalar> slope = gap_.cwiseProduct(X) - pull_, M = X + l_;
  const Vec3<Scalar> u =
      at.energy_parts > 0 ? Vec3<Scalar>(X.cwiseProduct(slope) / at.energy_parts) : Vec3<Scalar>(0, 0, 0);
  const Vec3<Scalar> v =
      at.momentum_parts > 0 ? Vec3<Scalar>(X.cwiseProduct(M) / at.momentum_parts) : Vec3<Scalar>(0, 0, 0);
  const Scalar uu = u.squaredNorm() + damping, uv = u.dot(v), vv = v.squaredNorm() + damping;
  return (u * (vv * e - uv * m) + v * (uu * m - uv * e)) / (uu * vv - uv * uv);
}

template <Real Real_>
void FullSystem<Real_>::project(Scalar, Scalar* x, Scalar* low) const noexcept {
  Vec3<Scalar> X(x[4], x[5], x[6]);
  const Vec3<Scalar> change = X.cwiseProduct(missing(X, {low[4], low[5], low[6]}));
  for (int i = 0; i < 3; ++i) {
    add_to(x[4 + i], low[4 + i], change[i]);
    X[i] = x[4 + i];
  }

  Scalar excess = -1, along = 0;
  for (int i = 0; i < 4; ++i) excess += x[i] * x[i];
  for (int i = 0; i < 4; ++i) along += x[i] * low[i];
  const Scalar stretch = -excess / 2 - along;
  const Quat<Scalar> q{x[0], x[1], x[2], x[3]};
  Quat<Scalar> more{stretch * q.w, stretch * q.x, stretch * q.y, stretch * q.z};
  const Vec3<Scalar> M = X + l_;
  if (const Scalar R = M.norm(); R > 0) {
    // the turn d of the body with d x M = P^T L - M
    const Vec3<Scalar> gap = rotate<Scalar>(conjugate(q), L_I_) - M;
    const Vec3<Scalar> d = cross<Scalar>(M / R, gap / R);
    const Quat<Scalar> turned = q * Quat<Scalar>{0, d[0] / 2, d[1] / 2, d[2] / 2};
    more = {more.w + turned.w, more.x + turned.x, more.y + turned.y, more.z + turned.z};
  }
  add_to(x[0], low[0], more.w);
  add_to(x[1], low[1], more.x);
  add_to(x[2], low[2], more.y);
  add_to(x[3], low[3], more.z);
}

#ifdef GYROSTAT_COMPILED
extern template void FullSystem<double>::expand<20>(double, double, double (&)[21][FullSystem<double>::width],
                                                    FullSystem<double>::Work<20>&) const noexcept;
#endif

}  // namespace gyrostat::free
