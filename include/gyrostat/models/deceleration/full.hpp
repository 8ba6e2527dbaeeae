// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// The full equations (deceleration.md, section 1): right-hand side, Jacobian and Taylor recurrences. The state is U, what the
/// control opposes (M for law total, G = M - l for law carrier), so that the end of the motion is U = 0 for both laws:
///     dU/dt = q(U) + L U + c - control U/|U|,   q(U)_i = (a_k - a_j) U_j U_k,  (i, j, k) cyclic.
namespace gyrostat::deceleration {

/// The constants of the full equations in terms of U.
template <Real Scalar>
struct FullCoefficients {
  Vec3<Scalar> offset;     ///< M - U: zero or l, N m s
  Vec3<Scalar> rate;       ///< omega - a U: -a l or zero, rad/s
  Vec3<Scalar> quadratic;  ///< a_k - a_j, 1/(kg m^2)
  /// The same in two parts, of which the first has half the digits: together they add up to zero, which three rounded numbers do not, and U.q(U)
  /// drifts by that, alike in every step.
  Vec3<Scalar> quadratic_parts[2];
  Mat3<Scalar> linear;    ///< L, 1/s
  Vec3<Scalar> constant;  ///< c, N m

  explicit FullCoefficients(const Problem<Scalar>& problem) noexcept {
    const Vec3<Scalar>& a = problem.inverse_inertia;
    const Vec3<Scalar>& l = problem.rotor_momentum;
    const bool total = problem.law == Law::total || problem.control.isZero(0);  // without control U is ours to choose
    const Vec3<Scalar> gaps = problem.inverse_gaps();
    quadratic = {gaps[1], -gaps[2], gaps[0]};
    using Wide = Wider<Scalar>;
    const Scalar lacks = static_cast<Scalar>((Wide(gaps[2]) - Wide(gaps[0])) - Wide(gaps[1]));
    constexpr Scalar splitter = Scalar(1ULL << (std::numeric_limits<Scalar>::digits + 1) / 2) + 1;
    for (int i = 0; i < 3; ++i) {
      const Scalar far = splitter * quadratic[i];
      quadratic_parts[0][i] = far - (far - quadratic[i]);
      quadratic_parts[1][i] = quadratic[i] - quadratic_parts[0][i];
    }
    quadratic_parts[1][1] += lacks;
    const Vec3<Scalar> g = problem.gyro_rate();
    if (total) {
      // M x a(M - l) = M x aM - M x g
      offset.setZero();
      rate = -g;
      linear << 0, -g[2], g[1],  //
          g[2], 0, -g[0],        //
          -g[1], g[0], 0;
      constant = problem.drag_law == Law::total ? Vec3<Scalar>::Zero().eval() : Vec3<Scalar>(problem.drag * l);
    } else {
      // (G + l) x aG = G x aG + l x aG
      offset = l;
      rate.setZero();
      linear << 0, -l[2] * a[1], l[1] * a[2],  //
          l[2] * a[0], 0, -l[0] * a[2],        //
          -l[1] * a[0], l[0] * a[1], 0;
      constant = problem.drag_law == Law::carrier ? Vec3<Scalar>::Zero().eval() : Vec3<Scalar>(-problem.drag * l);
    }
    linear.diagonal().array() -= problem.drag;
  }
};

/// Principal axes that the control leaves alone, and about which the body turns on for ever where what U has along one is certain to last.
///
/// Let i be such an axis, of the greatest or the least moment, so that q_j q_k < 0, and c the controls about the other two. W = |q_k| U_j^2 + |q_j| U_k^2 obeys
/// dW/dt = -2 (c_j |q_k| U_j^2 + c_k |q_j| U_k^2)/|U|, and P = |q_k| U_j^2 - |q_j| U_k^2
/// dP/dt = +-4 |q_j q_k| U_i U_j U_k - 2 (c_j |q_k| U_j^2 - c_k |q_j| U_k^2)/|U|, where the last term is no greater than dW/dt, and |P| <= W. As
/// dU_i^2/dt = 2 q_i U_i U_j U_k, U_i^2 changes from now on by at most |q_i| W/|q_j q_k|. Drag along U shrinks all of this alike.
template <Real Scalar>
class AxesLeftAlone {
 public:
  /// Where control and drag act along principal axes, and neither a rotor nor the drag pushes; else there is none.
  explicit AxesLeftAlone(const Problem<Scalar>& problem) noexcept {
    const FullCoefficients<Scalar> f(problem);
    const Mat3<Scalar>& b = problem.control;
    if (!b.isDiagonal(0) || !f.linear.isDiagonal(0) || !f.constant.isZero(0)) return;
    const Vec3<Scalar> q = f.quadratic.cwiseAbs();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      if (b(i, i) != 0 || !(f.quadratic[j] * f.quadratic[k] < 0 || q[i] == 0)) continue;
      any_ = is_[i] = true;
      if (q[i] != 0) weight_(i, j) = q[i] / q[j], weight_(i, k) = q[i] / q[k];
    }
  }
  bool any() const noexcept { return any_; }
  /// Whether U never comes to zero.
  bool keep(const Vec3<Scalar>& U) const noexcept {
    constexpr Scalar clear = Scalar(1.001L);
    const Vec3<Scalar> square = U.cwiseAbs2();
    for (int i = 0; any_ && i < 3; ++i)
      if (is_[i] && clear * weight_.row(i).dot(square) < square[i]) return true;
    return false;
  }

 private:
  bool any_ = false, is_[3] = {};
  Mat3<Scalar> weight_ = Mat3<Scalar>::Zero();
};

/// dM/dt, N m; momentum M in principal axes. Where U = 0 and the control does not vanish the torque has no value: NaN.
template <Real Scalar>
Vec3<Scalar> momentum_rate(const Problem<Scalar>& problem, const Vec3<Scalar>& M) noexcept {
  const Vec3<Scalar> G = M - problem.rotor_momentum;
  const Vec3<Scalar> omega = problem.inverse_inertia.cwiseProduct(G);
  const Vec3<Scalar>& U = problem.law == Law::total ? M : G;
  const Vec3<Scalar>& D = problem.drag_law == Law::total ? M : G;
  Vec3<Scalar> rate{M[1] * omega[2] - M[2] * omega[1], M[2] * omega[0] - M[0] * omega[2],
                    M[0] * omega[1] - M[1] * omega[0]};
  rate -= problem.drag * D;
  if (!problem.control.isZero(0)) rate -= problem.control * (U / U.norm());
  return rate;
}

/// The derivative of momentum_rate by M, 1/s.
template <Real Scalar>
Mat3<Scalar> momentum_jacobian(const Problem<Scalar>& problem, const Vec3<Scalar>& M) noexcept {
  const FullCoefficients<Scalar> f(problem);
  const Vec3<Scalar> U = M - f.offset;
  const Vec3<Scalar>& d = f.quadratic;
  Mat3<Scalar> jacobian = f.linear;
  jacobian(0, 1) += d[0] * U[2];
  jacobian(0, 2) += d[0] * U[1];
  jacobian(1, 0) += d[1] * U[2];
  jacobian(1, 2) += d[1] * U[0];
  jacobian(2, 0) += d[2] * U[1];
  jacobian(2, 1) += d[2] * U[0];
  if (!problem.control.isZero(0)) {
    const Scalar norm = U.norm();
    const Vec3<Scalar> n = U / norm;
    jacobian -= problem.control * (Mat3<Scalar>::Identity() - n * n.transpose()) / norm;
  }
  return jacobian;
}

/// Taylor recurrences of the full equations, composed of what the scene has. A state is (U1, U2, U3, -) and, with attitude,
/// (w, x, y, z) of the quaternion from principal to inertial axes, dq/dt = q (0, omega)/2. With control the fourth number of a
/// row becomes a coefficient of |U|.
///
/// One order costs three convolutions for q(U), one (halved by symmetry) for |U|, three for U/|U|. Each is split into the terms
/// known an order earlier and the newest one, and all newest terms together are one 3x3 matrix, the Jacobian at the start of the
/// step: so one order waits for the last only through one matrix-vector product.
template <Real Real_, bool with_control, bool with_attitude>
class FullSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = with_attitude ? 8 : 4;

  /// By-products of an expansion: rows (U2, U3, U1), (U3, U1, U2), (U, |U|), (control U/|U|, -).
  template <int Order>
  struct Work {
    Lanes<Scalar> forward[Order + 1];
    Lanes<Scalar> backward[Order + 1];
    Lanes<Scalar> whole[Order + 1];
    Lanes<Scalar> torque[Order + 1];
    Scalar norm[Order + 1];
    QuaternionSeries<Scalar, with_attitude ? Order : 0> turn;
  };

  /// reach < 1: part of the way to U = 0 that one step may go at most.
  explicit FullSystem(const Problem<Scalar>& problem, Scalar reach = Scalar(0.3L)) noexcept;

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// reach |U| over the greatest rate at which |U| can shrink: short enough to never jump over U = 0. Infinite without control; on an
  /// axis that the motion keeps only the control about that axis and the other torques count.
  Scalar step_limit(const Scalar* x) const noexcept;

  /// Moves a state onto the laws it obeys exactly: |q| = 1; |U| if the control torques are equal or absent; the energy if then
  /// l = 0, or if nothing acts on the body. Parts of U that nothing can see any more become zero. t counts from the start of the problem.
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept;

  /// Whether U is certain never to come to zero: it lies on an axis where it stays and that the control leaves alone, or keeps what it has along one.
  bool never_stops(const Scalar* x) const noexcept {
    const int axis = axis_kept(x);
    return (axis >= 0 && own_[axis] == 0) || left_alone_.keep({x[0], x[1], x[2]});
  }
  /// Whether the motion tells in time when it stops, or that it never does, though the control leaves an axis alone.
  bool tells_its_stop(const Scalar* x) const noexcept { return left_alone_.any() || axis_kept(x) >= 0; }

  /// |U| at t where it obeys its own law, dR/dt = -drag R - b: (R0 + b/drag) exp(-drag t) - b/drag, N m s.
  Scalar norm_at(Scalar t) const noexcept {
    const Scalar x = drag_ * t;
    const Scalar mean = x > 0 ? -std::expm1(-x) / x : Scalar(1);
    return norm_ * std::exp(-x) - equal_control_ * t * mean;
  }
  bool norm_is_known() const noexcept { return norm_is_known_; }

 private:
  using Row = Lanes<Scalar>;

  /// The axis that U lies on, where it stays there; -1: none.
  int axis_kept(const Scalar* x) const noexcept {
    int along = -1;
    for (int i = 0; i < 3; ++i)
      if (x[i] != 0) along = along < 0 ? i : 3;
    return along >= 0 && along < 3 && keeps_[along] ? along : -1;
  }

  /// The reciprocal moments less that of the axis to which the momentum starts nearest. Energy over |M|^2 less that is as well known as the
  /// distance from the axis, however near.
  static Vec3<Scalar> gaps_from_nearest_axis(const Problem<Scalar>& problem) noexcept {
    const Vec3<Scalar> gaps = problem.inverse_gaps(), size = problem.momentum.cwiseAbs();
    if (size[0] >= size[1] && size[0] >= size[2]) return {0, gaps[0], gaps[2]};
    if (size[1] >= size[2]) return {-gaps[0], 0, gaps[1]};
    return {-gaps[2], -gaps[1], 0};
  }

  /// Whether U across axis i decays against U along it, `most`, from now on: the control about that axis is the weakest, and
  /// damps the other two faster than they feed each other, which they do the less the slower the body turns.
  bool settles_on(int i, Scalar most) const noexcept {
    const Scalar square = most * most;
    return damping_[i] > 0 && coupling_[i] * square * square < damping_[i];
  }

  static GYROSTAT_INLINE Row row(const Vec3<Scalar>& v, Scalar last = 0) noexcept {
    return lanes(v[0], v[1], v[2], last);
  }

  /// Order k + 1 from the orders up to k. Index: an integral constant, so that everything unrolls, or an int.
  template <class Index, int Order>
  GYROSTAT_INLINE void extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                              const Row (&jacobian)[3], const Row (&turn)[3], const Row (&quadratic)[2],
                              const Row& along, const Row& inverse, const Row& half_inverse,
                              Scalar half_unit) const noexcept;

  Row quadratic_[2], constant_, inverse_inertia_, rate_;
  Row linear_[3];
  Row control_[3];
  Scalar reach_, control_bound_, constant_bound_, linear_bound_, drag_;
  AxesLeftAlone<Scalar> left_alone_;
  // of each axis
  bool keeps_[3];          ///< a U along it stays there
  Vec3<Scalar> own_;       ///< the control about it, N m
  Vec3<Scalar> damping_;   ///< product of the excesses of the other two over it, N^2 m^2; 0: this is not the weakest
  Vec3<Scalar> coupling_;  ///< product of the quadratic terms that couple the other two
  // exact laws
  Vec3<Scalar> rotor_momentum_;
  Vec3<Scalar>
      by_momentum_;  ///< the reciprocal moments, without rotor less that of the axis next to which U starts: of a level that is kept, too
  Scalar norm_, level_, equal_control_;
  bool norm_is_known_, energy_is_known_, energy_is_constant_;
};

template <Real Real_, bool with_control, bool with_attitude>
FullSystem<Real_, with_control, with_attitude>::FullSystem(const Problem<Scalar>& problem, Scalar reach) noexcept
    : reach_(reach), left_alone_(problem) {
  const FullCoefficients<Scalar> f(problem);
  for (int i = 0; i < 2; ++i) quadratic_[i] = row(f.quadratic_parts[i]);
  constant_ = row(f.constant);
  inverse_inertia_ = row(problem.inverse_inertia);
  rate_ = row(f.rate);
  for (int j = 0; j < 3; ++j) {
    linear_[j] = row(f.linear.col(j));
    control_[j] = row(problem.control.col(j));
  }
  constant_bound_ = f.constant.norm();
  control_bound_ = problem.control.cwiseAbs().rowwise().sum().maxCoeff() + constant_bound_;
  linear_bound_ = (f.linear + f.linear.transpose()).norm() / 2;
  drag_ = problem.drag;

  const Mat3<Scalar>& b = problem.control;
  const bool plain = b.isDiagonal(0) && f.linear.isDiagonal(0) && f.constant.isZero(0);
  own_ = b.diagonal();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    keeps_[i] = true;
    for (const int at : {j, k}) keeps_[i] = keeps_[i] && b(at, i) == 0 && f.linear(at, i) == 0 && f.constant[at] == 0;
    const bool weakest = own_[j] > own_[i] && own_[k] > own_[i];
    damping_[i] = plain && weakest ? (own_[j] - own_[i]) * (own_[k] - own_[i]) : Scalar(0);
    coupling_[i] = f.quadratic[j] * f.quadratic[k];
  }
  rotor_momentum_ = problem.rotor_momentum;
  equal_control_ = b(0, 0);
  norm_ = (problem.momentum - f.offset).norm();
  const bool no_rotor = rotor_momentum_.isZero(0);
  by_momentum_ = no_rotor ? gaps_from_nearest_axis(problem) : problem.inverse_inertia;
  const Vec3<Scalar> G = problem.momentum - rotor_momentum_;
  level_ = G.dot(by_momentum_.cwiseProduct(G)) / 2;
  const bool equal = b == Mat3<Scalar>(equal_control_ * Mat3<Scalar>::Identity());
  const bool turning_only = no_rotor || (f.offset.isZero(0) && f.constant.isZero(0));
  norm_is_known_ = equal && turning_only && norm_ > 0;
  energy_is_constant_ = b.isZero(0) && drag_ == 0 && norm_is_known_;
  energy_is_known_ = norm_is_known_ && (no_rotor || energy_is_constant_);
}

template <Real Real_, bool with_control, bool with_attitude>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_, with_control, with_attitude>::extend(
    Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest, const Row (&jacobian)[3],
    const Row (&turn)[3], const Row (&quadratic)[2], const Row& along, const Row& inverse, const Row& half_inverse,
    Scalar half_unit) const noexcept {
  const Row u0 = shuffle<0, 0, 0, 0>(newest), u1 = shuffle<1, 1, 1, 1>(newest), u2 = shuffle<2, 2, 2, 2>(newest);

  // terms known since the last order, the youngest last
  Row product = lanes(Scalar(0)), product_2 = product;
  if (k % 2 == 0) product = work.forward[k / 2] * work.backward[k / 2];
  count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA {
    product = multiply_add(work.forward[j], work.backward[k - j], product);
    product_2 = multiply_add(work.forward[k - j], work.backward[j], product_2);
  });
  product = product + product_2;
  Row known = multiply_add(quadratic[0], product, quadratic[1] * product);

  if constexpr (with_control) {
    Row square = lanes(Scalar(0));
    Row quotient = square, quotient_2 = square;
    if (k % 2 == 0) {
      square = lanes(Scalar(0.5)) * work.whole[k / 2] * work.whole[k / 2];
      quotient = lanes(work.norm[k / 2]) * work.torque[k / 2];
    }
    count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA {
      square = multiply_add(work.whole[j], work.whole[k - j], square);
      quotient = multiply_add(lanes(work.norm[j]), work.torque[k - j], quotient);
      quotient_2 = multiply_add(lanes(work.norm[k - j]), work.torque[j], quotient_2);
    });
    const Row norm_known = sum(square * half_inverse);
    const Row z = multiply_add(norm_known, along, inverse * (quotient + quotient_2));
    known = known + z;
    // (control U/|U|, |U|) of this order
    const Row torque = multiply_add(turn[0], u0, multiply_add(turn[1], u1, turn[2] * u2)) - z;
    if (k + 1 < Order) {
      work.torque[k] = torque;
      work.norm[k] = torque[3];
      work.whole[k] = with_last(newest, torque);
    }
  }

  const Row next =
      over_next(multiply_add(jacobian[0], u0, multiply_add(jacobian[1], u1, multiply_add(jacobian[2], u2, known))), k);

  if constexpr (with_attitude) {
    const Row omega = inverse_inertia_ * newest * lanes(half_unit);
    store(&x[k + 1][4], over_next(work.turn.extend(k, x, 4, omega), k));
  }

  newest = next;
  store(&x[k + 1][0], with_last(next, lanes(Scalar(0))));
  if (k + 1 < Order) {
    work.forward[k + 1] = shuffle<1, 2, 0, 3>(next);
    work.backward[k + 1] = shuffle<2, 0, 1, 3>(next);
  }
}

template <Real Real_, bool with_control, bool with_attitude>
template <int Order>
void FullSystem<Real_, with_control, with_attitude>::expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width],
                                                            Work<Order>& work) const noexcept {
  const Row zero = lanes(Scalar(0));
  const Row scale = lanes(unit);
  const Row start = with_last(load(x[0]), zero);
  const Row quadratic[2] = {quadratic_[0] * scale, quadratic_[1] * scale};
  const Row u[3] = {shuffle<0, 0, 0, 0>(start), shuffle<1, 1, 1, 1>(start), shuffle<2, 2, 2, 2>(start)};

  Row jacobian[3], turn[3] = {zero, zero, zero};
  Row along = zero, inverse = zero, half_inverse = zero;
  const Row forward = shuffle<1, 2, 0, 3>(start), backward = shuffle<2, 0, 1, 3>(start);
  Row first = constant_;
  for (int j = 0; j < 3; ++j) first = multiply_add(linear_[j], u[j], first);
  const auto times_quadratic = [&](const Row& v) { return multiply_add(quadratic[0], v, quadratic[1] * v); };
  first = scale * first + times_quadratic(forward * backward);
  // columns of the derivative of q(U) + L U
  jacobian[0] = scale * linear_[0] + times_quadratic(lanes(Scalar(0), start[2], start[1], Scalar(0)));
  jacobian[1] = scale * linear_[1] + times_quadratic(lanes(start[2], Scalar(0), start[0], Scalar(0)));
  jacobian[2] = scale * linear_[2] + times_quadratic(lanes(start[1], start[0], Scalar(0), Scalar(0)));

  if constexpr (with_control) {
    const Scalar norm = std::sqrt(sum(start * start)[0]);
    const Scalar i = 1 / norm;
    inverse = lanes(i, i, i, Scalar(0));
    half_inverse = lanes(i, i, i, -i);
    const Row n = start * inverse;
    const Row n_part[3] = {shuffle<0, 0, 0, 0>(n), shuffle<1, 1, 1, 1>(n), shuffle<2, 2, 2, 2>(n)};
    const Row control_scale = scale * inverse;
    Row torque = zero;
    for (int j = 0; j < 3; ++j) torque = multiply_add(control_[j], n_part[j], torque);
    along = control_scale * torque;
    torque = scale * torque;
    first = first - torque;
    for (int j = 0; j < 3; ++j) {
      const Row column = control_[j] * control_scale - along * n_part[j];
      jacobian[j] = jacobian[j] - column;
      turn[j] = with_last(column, n_part[j]);  // fourth row: n, so that the fourth number is |U|
    }
    along = with_last(along, lanes(Scalar(-1)));
    work.torque[0] = with_last(torque, lanes(norm));
    work.norm[0] = norm;
  }
  if constexpr (with_attitude) {
    const Row omega = (inverse_inertia_ * start + rate_) * lanes(unit / 2);
    store(&x[1][4], work.turn.begin(x, 4, omega));
  }
  store(x[1], with_last(first, zero));
  work.forward[1] = shuffle<1, 2, 0, 3>(first);
  work.backward[1] = shuffle<2, 0, 1, 3>(first);

  Row newest = first;
  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA {
    extend(k, x, work, newest, jacobian, turn, quadratic, along, inverse, half_inverse, unit / 2);
  };
  count_up<Scalar, Order - 1>(next);
}

template <Real Real_, bool with_control, bool with_attitude>
Real_ FullSystem<Real_, with_control, with_attitude>::step_limit(const Scalar* x) const noexcept {
  if constexpr (!with_control) {
    return infinity<Scalar>;
  } else {
    const Scalar norm = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    const int axis = axis_kept(x);
    return reach_ * norm / ((axis < 0 ? control_bound_ : own_[axis] + constant_bound_) + linear_bound_ * norm);
  }
}

template <Real Real_, bool with_control, bool with_attitude>
void FullSystem<Real_, with_control, with_attitude>::project(Scalar t, Scalar* x, Scalar* low) const noexcept {
  if constexpr (with_control) {
    // What fades beside a control torque that is weak about one axis ends as a denormal number, a hundred times as slow to add as zero; and as long
    // as it is there, the strong ones set the length of a step.
    constexpr Scalar e2 = epsilon<Scalar> * epsilon<Scalar>, nothing = e2 * e2 * e2 * e2;
    const Scalar size[3] = {std::abs(x[0]), std::abs(x[1]), std::abs(x[2])};
    const Scalar most = std::max({size[0], size[1], size[2]});
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const bool settled = size[j] < e2 * most && size[k] < e2 * most && settles_on(i, most);
      for (const int at : {j, k})
        if (settled || size[at] < nothing * most) x[at] = low[at] = 0;
    }
  }
  if (norm_is_known_) {
    const Vec3<Scalar> U{x[0], x[1], x[2]};
    const Vec3<Scalar> rest{low[0], low[1], low[2]};
    const Scalar target = norm_at(t);
    const Scalar square = U.squaredNorm();
    if (target > 0 && square > 0) {
      const Scalar stretch = ((target * target - square) / 2 - U.dot(rest)) / square;
      Vec3<Scalar> change = stretch * U;
      if (energy_is_known_) {
        // Along the part of the gradient that leaves |U| alone, whose square is `slope`. Where that is slight rounding of the level, eps size, must not
        // move U by more than some roundings: of a defect that small the part slope/(slope + (size/U)^2/64) is corrected.
        const Scalar ratio = target / norm_;
        const Scalar wanted = energy_is_constant_ ? level_ : level_ * ratio * ratio;
        const Vec3<Scalar> G = U - rotor_momentum_;
        const Vec3<Scalar> gradient = by_momentum_.cwiseProduct(G);
        const Scalar missing = wanted - G.dot(gradient) / 2 - gradient.dot(rest + change);
        const Vec3<Scalar> across = gradient - (gradient.dot(U) / square) * U;
        const Scalar slope = across.squaredNorm();
        const Scalar size = gradient.cwiseAbs().dot(U.cwiseAbs() + rotor_momentum_.cwiseAbs()) / 2;
        if (std::abs(missing) < 64 * epsilon<Scalar> * size) {
          change += (missing / (slope + size * size / (64 * square))) * across;
        } else if (slope > Scalar(1e-6L) * gradient.squaredNorm()) {
          change += (missing / slope) * across;
        }
      }
      for (int i = 0; i < 3; ++i) add_to(x[i], low[i], change[i]);
    }
  }
  if constexpr (with_attitude) {
    Scalar missing = 1, along = 0;
    for (int i = 4; i < 8; ++i) missing -= x[i] * x[i];
    for (int i = 4; i < 8; ++i) along += x[i] * low[i];
    const Scalar stretch = missing / 2 - along;
    for (int i = 4; i < 8; ++i) add_to(x[i], low[i], stretch * x[i]);
  }
}

#ifdef GYROSTAT_COMPILED
extern template void FullSystem<double, true, true>::expand<20>(
    double, double, double (&)[21][FullSystem<double, true, true>::width],
    FullSystem<double, true, true>::Work<20>&) const noexcept;
extern template void FullSystem<double, true, false>::expand<20>(
    double, double, double (&)[21][FullSystem<double, true, false>::width],
    FullSystem<double, true, false>::Work<20>&) const noexcept;
extern template void FullSystem<double, false, true>::expand<20>(
    double, double, double (&)[21][FullSystem<double, false, true>::width],
    FullSystem<double, false, true>::Work<20>&) const noexcept;
extern template void FullSystem<double, false, false>::expand<20>(
    double, double, double (&)[21][FullSystem<double, false, false>::width],
    FullSystem<double, false, false>::Work<20>&) const noexcept;
#endif

}  // namespace gyrostat::deceleration
