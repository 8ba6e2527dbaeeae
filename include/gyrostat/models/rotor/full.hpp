// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/rotate_once.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// The full equations (docs/rotor.md, section 2, form C): right-hand side, Jacobian and Taylor recurrences of
///     dq/dt = q (0, Omega)/2,  dH/dt = H x Omega,  dp/dt = -S (omega - omega*),  dbeta/dt = omega,
///     Omega = R^-1 (H - p e),  omega = p/lambda - e.Omega:
/// quadratic, and linear in p but for dH/dt.
namespace gyrostat::rotor {

/// The derivative of a state by the time, component by component, 1/s.
template <Real Scalar>
State<Scalar> state_rate(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& state) noexcept {
  const Vec3<Scalar> Omega = gyrostat.angular_velocity(state.momentum, state.axial_momentum);
  const Scalar omega = gyrostat.rotor_rate(state.axial_momentum, Omega);
  return {quaternion_rate<Scalar>(state.attitude, Omega), cross<Scalar>(state.momentum, Omega),
          -gyrostat.slope() * (omega - gyrostat.no_load_rate()), omega};
}

/// The derivative of (dH/dt, dp/dt) by (H, p), 1/s. It does not depend on the attitude.
template <Real Scalar>
Eigen::Matrix<Scalar, 4, 4> momentum_jacobian(const Gyrostat<Scalar>& gyrostat, const Vec3<Scalar>& H,
                                              Scalar p) noexcept {
  const Vec3<Scalar> g = gyrostat.free_inverse() * gyrostat.axis();
  Eigen::Matrix<Scalar, 4, 4> jacobian;
  jacobian.template topLeftCorner<3, 3>() =
      cross_matrix<Scalar>(H) * gyrostat.free_inverse() - cross_matrix<Scalar>(gyrostat.angular_velocity(H, p));
  jacobian.template topRightCorner<3, 1>() = -cross<Scalar>(H, g);
  jacobian.template bottomLeftCorner<1, 3>() = gyrostat.slope() * g.transpose();
  jacobian(3, 3) = -gyrostat.relaxation_rate();
  return jacobian;
}

/// The derivative of state_rate by the state, both in the order (w, x, y, z, H, p, beta).
template <Real Scalar>
Eigen::Matrix<Scalar, 9, 9> state_jacobian(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& state) noexcept {
  const auto& [w, x, y, z] = state.attitude;
  const Vec3<Scalar> g = gyrostat.free_inverse() * gyrostat.axis();
  const Vec3<Scalar> o = gyrostat.angular_velocity(state.momentum, state.axial_momentum) / 2;
  Eigen::Matrix<Scalar, 9, 9> jacobian;
  jacobian.setZero();
  jacobian.template topLeftCorner<4, 4>() << 0, -o[0], -o[1], -o[2],  //
      o[0], 0, o[2], -o[1],                                           //
      o[1], -o[2], 0, o[0],                                           //
      o[2], o[1], -o[0], 0;
  Eigen::Matrix<Scalar, 4, 3> turning;  // of dq/dt by Omega
  turning << -x, -y, -z,                //
      w, -z, y,                         //
      z, w, -x,                         //
      -y, x, w;
  turning /= 2;
  jacobian.template block<4, 3>(0, 4) = turning * gyrostat.free_inverse();
  jacobian.template block<4, 1>(0, 7) = -turning * g;
  jacobian.template block<4, 4>(4, 4) = momentum_jacobian<Scalar>(gyrostat, state.momentum, state.axial_momentum);
  jacobian.template block<1, 3>(8, 4) = -g.transpose();
  jacobian(8, 7) = 1 / (gyrostat.axial_inertia() * gyrostat.coupling());
  return jacobian;
}

/// Taylor recurrences of the full equations in the principal axes of R. A state is
///     (w, x, y, z | H1, H2, H3, p | b, b, b, W),  b = integral of omega - omega*,  W = integral of S (omega - omega*)^2:
/// the quaternion takes principal axes of R to inertial ones; the last four are quadratures on which no rate depends.
///
/// One order costs one symmetric convolution for H x R^-1 H (with the square of omega - omega* in its fourth lane), one for p H and
/// three for the quaternion. Each is split into the terms known an order earlier and the newest one; the newest terms of
/// dH/dt and dp/dt together are one 4x4 matrix, the Jacobian at the start of the step: so one order waits for the last only
/// through one matrix-vector product.
template <Real Real_>
class FullSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = 12;
  using Numbers = std::array<Scalar, width>;

  /// By-products of an expansion: rows (H2, H3, H1, omega), (H3, H1, H2, omega), (Omega unit/2, omega) and (H x R^-1 e unit, 0),
  /// omega without omega*.
  template <int Order>
  struct Work {
    Lanes<Scalar> forward[Order + 1];
    Lanes<Scalar> backward[Order + 1];
    Lanes<Scalar> across[Order + 1];
    QuaternionSeries<Scalar, Order> turn;
  };

  /// The motion from `start` at t = 0, from which the projection takes its constants.
  FullSystem(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept;

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves a state onto the laws it obeys exactly: |q| = 1, P H = L, and against the drift by rounding V + W = V0.
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept;

  /// The numbers at t = 0.
  const Numbers& start() const noexcept { return start_; }
  /// The state, in body axes, that numbers at t mean.
  State<Scalar> state(Scalar t, const Scalar* x) const noexcept;

  /// What the steps measure errors against: 1 for the quaternion, |H| + |h| + |p| for H, the size of its own for p, the lesser of V0 and the
  /// energy of the carrier for W, and nothing for b.
  Numbers scale() const noexcept;

 private:
  using Row = Lanes<Scalar>;

  static GYROSTAT_INLINE Row row(const Vec3<Scalar>& v) noexcept { return lanes(v[0], v[1], v[2], Scalar(0)); }

  /// The constants of an expansion.
  struct Constants {
    Row jacobian[4];                  ///< columns of the derivative of (dH/dt, dp/dt) unit
    Row motion[4];                    ///< columns of the derivative of (Omega unit/2, omega)
    Row quadratic;                    ///< a_k - a_j times unit
    Row axis_forward, axis_backward;  ///< R^-1 e unit
    Row first_x;                      ///< (0, 0, 0, 2 (omega - omega*) at the start)
    Row unit, slope;                  ///< unit, and S unit
  };

  /// Order k + 1 from the orders up to k. Index: an integral constant, so that everything unrolls, or an int.
  template <class Index, int Order>
  GYROSTAT_INLINE void extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                              const Constants& c) const noexcept;

  /// The kinetic energy of the carrier and that of the rotor's departure from no load, J: their sum is V.
  template <Real Number>
  struct Levels {
    Number carrier, rotor;
    Number whole() const noexcept { return carrier + rotor; }
  };
  template <Real Number>
  Levels<Number> levels(const Vec3<Number>& H, Number p) const noexcept {
    const Vec3<Number> G = H - p * vector_cast<Number>(e_);
    const Number y = p * (1 / Number(lambda_)) - no_load_rate_;
    return {G.dot(vector_cast<Number>(a_).cwiseProduct(G)) / 2, lambda_ * y * y / 2};
  }

  Vec3<Scalar> a_, e_, g_;    ///< 1/R, e and R^-1 e in principal axes of R
  Vec3<Scalar> differences_;  ///< (a_3 - a_2, a_1 - a_3, a_2 - a_1), from those of the moments
  Scalar lambda_, slope_, no_load_rate_, relaxation_rate_, rotor_inverse_;
  Quat<Scalar> q_BF_;
  Vec3<Scalar> L_I_;
  static constexpr Scalar slack_ = 64 * epsilon<Scalar>;  ///< of V + W by rounding, relative to V
  Scalar level_, angle_;                                  ///< V and beta at the start
  Numbers start_;
};

template <Real Real_>
FullSystem<Real_>::FullSystem(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept
    : lambda_(gyrostat.axial_inertia()),
      slope_(gyrostat.slope()),
      no_load_rate_(gyrostat.no_load_rate()),
      angle_(start.rotor_angle) {
  const PrincipalAxes<Scalar> free = gyrostat.free_axes();
  a_ = free.moments.cwiseInverse();
  differences_ = {free.gaps[1] * a_[1] * a_[2], -free.gaps[2] * a_[2] * a_[0], free.gaps[0] * a_[0] * a_[1]};
  q_BF_ = from_matrix<Scalar>(free.R_BP);
  e_ = free.R_BP.transpose() * gyrostat.axis();
  g_ = a_.cwiseProduct(e_);
  rotor_inverse_ = 1 / lambda_ + e_.dot(g_);
  relaxation_rate_ = slope_ * rotor_inverse_;
  const Quat<Scalar> q = normalised(start.attitude) * q_BF_;
  const Vec3<Scalar> H = rotate_once(conjugate(q_BF_), start.momentum);
  start_ = {q.w, q.x, q.y, q.z, H[0], H[1], H[2], start.axial_momentum, 0, 0, 0, 0};
  L_I_ = rotate_once(q, H);
  using Wide = Wider<Scalar>;
  level_ = static_cast<Scalar>(levels(vector_cast<Wide>(H), Wide(start.axial_momentum)).whole());
}

template <Real Real_>
State<Real_> FullSystem<Real_>::state(Scalar t, const Scalar* x) const noexcept {
  // H = P^T L also between the steps, where the series of H is good to a share of |H| + |h| + |p| only
  const Quat<Scalar> q = normalised(Quat<Scalar>{x[0], x[1], x[2], x[3]});
  return {normalised(q * conjugate(q_BF_)), rotate<Scalar>(q_BF_, rotate<Scalar>(conjugate(q), L_I_)), x[7],
          angle_ + (no_load_rate_ * t + x[8])};
}

template <Real Real_>
auto FullSystem<Real_>::scale() const noexcept -> Numbers {
  const Scalar l = Vec3<Scalar>(start_[4], start_[5], start_[6]).norm();
  const Scalar wheel = std::abs(lambda_ * no_load_rate_) + std::abs(start_[7]);
  // where nothing moves any scale will do, but zero would leave the component out
  const auto positive = [](Scalar size) noexcept { return size > 0 ? size : Scalar(1); };
  const Scalar h = positive(l + wheel), p = positive(std::min(l, lambda_ * a_.maxCoeff() * l) + wheel);
  return {1, 1, 1, 1, h, h, h, p, 0, 0, 0, std::min(positive(level_), h * h * a_.maxCoeff())};
}

template <Real Real_>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_>::extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                                               const Constants& c) const noexcept {
  const Row y0 = shuffle<0, 0, 0, 0>(newest), y1 = shuffle<1, 1, 1, 1>(newest), y2 = shuffle<2, 2, 2, 2>(newest),
            y3 = shuffle<3, 3, 3, 3>(newest);

  // terms known since the last order, the youngest last
  Row product = lanes(Scalar(0)), product_2 = product, pull = product;
  if (k % 2 == 0) product = work.forward[k / 2] * work.backward[k / 2];
  count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA {
    product = multiply_add(work.forward[j], work.backward[k - j], product);
    product_2 = multiply_add(work.forward[k - j], work.backward[j], product_2);
  });
  count_down<Scalar>(
      k - 1, [&](int j) GYROSTAT_INLINE_LAMBDA { pull = multiply_add(lanes(x[j][7]), work.across[k - j], pull); });
  const Row square = product + product_2;
  const Row known = c.quadratic * square - pull;
  const Row next = over_next(multiply_add(c.jacobian[0], y0, multiply_add(c.jacobian[1], y1, known)) +
                                 multiply_add(c.jacobian[2], y2, c.jacobian[3] * y3),
                             k);

  // (Omega unit/2, omega) of order k
  const Row motion = multiply_add(c.motion[0], y0, c.motion[1] * y1) + multiply_add(c.motion[2], y2, c.motion[3] * y3);
  store(&x[k + 1][0], over_next(work.turn.extend(k, x, 0, motion), k));
  store(&x[k + 1][4], next);

  const Row rate = shuffle<3, 3, 3, 3>(motion);
  store(&x[k + 1][8], over_next(with_last(c.unit * rate, c.slope * multiply_add(c.first_x, motion, square)), k));

  if (k + 1 < Order) {
    work.forward[k] = with_last(shuffle<1, 2, 0, 3>(newest), motion);
    work.backward[k] = with_last(shuffle<2, 0, 1, 3>(newest), motion);
    work.across[k] = work.forward[k] * c.axis_backward - work.backward[k] * c.axis_forward;
  }
  newest = next;
}

template <Real Real_>
template <int Order>
void FullSystem<Real_>::expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept {
  const Scalar* H = &x[0][4];
  const Scalar p = x[0][7];
  const Vec3<Scalar> g = unit * g_;
  const Vec3<Scalar> quadratic = unit * differences_;
  const Scalar half = unit / 2, slope = unit * slope_;

  Constants c;
  c.quadratic = row(quadratic);
  c.axis_forward = lanes(g[1], g[2], g[0], Scalar(0));
  c.axis_backward = lanes(g[2], g[0], g[1], Scalar(0));
  c.unit = lanes(unit);
  c.slope = lanes(slope);
  c.motion[0] = lanes(half * a_[0], Scalar(0), Scalar(0), -g_[0]);
  c.motion[1] = lanes(Scalar(0), half * a_[1], Scalar(0), -g_[1]);
  c.motion[2] = lanes(Scalar(0), Scalar(0), half * a_[2], -g_[2]);
  c.motion[3] = lanes(-g[0] / 2, -g[1] / 2, -g[2] / 2, rotor_inverse_);
  c.jacobian[0] = lanes(Scalar(0), quadratic[1] * H[2] + p * g[2], quadratic[2] * H[1] - p * g[1], slope * g_[0]);
  c.jacobian[1] = lanes(quadratic[0] * H[2] - p * g[2], Scalar(0), quadratic[2] * H[0] + p * g[0], slope * g_[1]);
  c.jacobian[2] = lanes(quadratic[0] * H[1] + p * g[1], quadratic[1] * H[0] - p * g[0], Scalar(0), slope * g_[2]);
  c.jacobian[3] =
      lanes(H[2] * g[1] - H[1] * g[2], H[0] * g[2] - H[2] * g[0], H[1] * g[0] - H[0] * g[1], -unit * relaxation_rate_);

  const Row start = load(H);
  // H and p e may nearly cancel, of a rotor that has nearly all of the inertia: both rates are of the one rounded difference
  const Vec3<Scalar> Omega = a_.cwiseProduct(Vec3<Scalar>(H[0], H[1], H[2]) - p * e_);
  const Row motion = lanes(half * Omega[0], half * Omega[1], half * Omega[2], p / lambda_ - e_.dot(Omega));
  const Scalar excess = motion[3] - no_load_rate_;
  c.first_x = lanes(Scalar(0), Scalar(0), Scalar(0), 2 * excess);

  // dH/dt = H x Omega, Omega unit/2 being in motion
  const Row forward = shuffle<1, 2, 0, 3>(start), backward = shuffle<2, 0, 1, 3>(start);
  const Row turning = forward * shuffle<2, 0, 1, 3>(motion) - backward * shuffle<1, 2, 0, 3>(motion);
  Row newest = with_last(turning + turning, lanes(-slope * excess));
  store(&x[1][0], work.turn.begin(x, 0, motion));
  store(&x[1][4], newest);
  const Scalar advance = unit * excess;
  store(&x[1][8], lanes(advance, advance, advance, slope * excess * excess));

  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA { extend(k, x, work, newest, c); };
  count_up<Scalar, Order - 1>(next);
}

template <Real Real_>
void FullSystem<Real_>::project(Scalar, Scalar* x, Scalar* low) const noexcept {
  Scalar missing = 1, along = 0;
  for (int i = 0; i < 4; ++i) missing -= x[i] * x[i];
  for (int i = 0; i < 4; ++i) along += x[i] * low[i];
  const Scalar stretch = missing / 2 - along;
  const Quat<Scalar> q{x[0], x[1], x[2], x[3]};
  Quat<Scalar> change{stretch * q.w, stretch * q.x, stretch * q.y, stretch * q.z};
  Vec3<Scalar> H = rotate<Scalar>(conjugate(q), L_I_);

  // V + W = V0. A small turn d of the body changes V by d.(Omega x H) = d.slope. Rounding of V and W is eps most: the part
  // slope^2/(slope^2 + most^2) of what is missing is corrected, so that the rounding turns the body by eps/2 at most, and V is kept in the
  // course of the steps; where the rotor brought far more energy than the body has, nothing is. What is more than rounding explains comes
  // of the truncation of H or of W: then W gives way, for to turn the body by it would hide it from a comparison of runs.
  const Levels<Scalar> at = levels(H, x[7]);
  const Vec3<Scalar> Omega = a_.cwiseProduct(H) - x[7] * g_;
  const Vec3<Scalar> slope = cross<Scalar>(Omega, H);
  const Scalar size = at.whole(), most = std::max(size, level_);
  const Scalar lacking = ((level_ - x[11]) - low[11]) - size;  // the great ones first: V may have sunk far below V0
  const Scalar square = slope.squaredNorm() + most * most;
  if (!(std::abs(lacking) <= slack_ * size)) {
    add_to(x[11], low[11], lacking);
  } else if (square > 0) {
    const Vec3<Scalar> turn = lacking / square * slope;
    H += cross<Scalar>(H, turn);
    const Quat<Scalar> turned = q * Quat<Scalar>{0, turn[0] / 2, turn[1] / 2, turn[2] / 2};
    change = {change.w + turned.w, change.x + turned.x, change.y + turned.y, change.z + turned.z};
  }
  add_to(x[0], low[0], change.w);
  add_to(x[1], low[1], change.x);
  add_to(x[2], low[2], change.y);
  add_to(x[3], low[3], change.z);
  for (int i = 0; i < 3; ++i) {
    x[4 + i] = H[i];
    low[4 + i] = 0;
  }
}

#ifdef GYROSTAT_COMPILED
extern template void FullSystem<double>::expand<20>(double, double, double (&)[21][FullSystem<double>::width],
                                                    FullSystem<double>::Work<20>&) const noexcept;
#endif

}  // namespace gyrostat::rotor
