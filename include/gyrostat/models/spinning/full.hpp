// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/quaternion_series.hpp"
#include "gyrostat/rotation/rotate_once.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// The full equations (docs/spinning.md, section 2): right-hand side, Jacobian and Taylor recurrences.
namespace gyrostat::spinning {

/// (p', q', r'), rad/s^2 (N1).
template <Real Scalar>
Vec3<Scalar> angular_acceleration(const Problem<Scalar>& problem, const Vec3<Scalar>& omega) noexcept {
  const auto& [D1, D2, D3] = std::array{problem.inertia[0], problem.inertia[1], problem.inertia[2]};
  const Vec3<Scalar>& M = problem.torque;
  const Scalar Lambda = problem.gyroscopic();
  return {(M[0] - omega[1] * ((D3 - D2) * omega[2] + Lambda)) / D1,
          (M[1] + omega[0] * ((D3 - D1) * omega[2] + Lambda)) / D2, (M[2] - (D2 - D1) * omega[0] * omega[1]) / D3};
}

/// R (D1 p, D2 q, D3 r + lambda3), N m s.
template <Real Scalar>
Vec3<Scalar> inertial_momentum(const Problem<Scalar>& problem, const Vec3<Scalar>& omega,
                               const Quat<Scalar>& attitude) noexcept {
  Vec3<Scalar> H = problem.inertia.cwiseProduct(omega);
  H[2] += problem.rotor_momentum;
  return rotate<Scalar>(attitude, H);
}

/// Acceleration of the mass centre, R f/m, m/s^2.
template <Real Scalar>
Vec3<Scalar> acceleration(const Problem<Scalar>& problem, const Quat<Scalar>& attitude) noexcept {
  return rotate<Scalar>(attitude, Vec3<Scalar>(problem.force / problem.mass));
}

/// The motion at t = 0, with the angles as they are given.
template <Real Scalar>
State<Scalar> start_state(const Problem<Scalar>& problem) noexcept {
  const auto& a = problem.angles;
  const Quat<Scalar> attitude = normalised(quaternion_from_312(a.psi, a.phi, a.theta));
  return {problem.angular_velocity,
          a,
          attitude,
          inertial_momentum(problem, problem.angular_velocity, attitude),
          problem.velocity,
          problem.position};
}

/// Taylor recurrences of the full equations. A state is
///     (p, q, r, A | w, x, y, z | u1, u2, u3, W | s1, s2, s3, -),
/// the quaternion taking body to inertial components, and quadratures that nothing else depends on: A of r, u of the force's
/// direction R f/|f|, W of the power M.omega, s of u. So neither force, mass nor velocity have a size that a step could feel.
///
/// One order costs one symmetric convolution for the rates, three for the quaternion and one and a half for the force's direction.
/// Each is split into the terms known an order earlier and the newest one, and the newest terms of the rates are one matrix, the
/// Jacobian at the start of the step: so one order waits for the last only through one matrix-vector product.
template <Real Real_>
class FullSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = 16;
  using Numbers = std::array<Scalar, width>;

  /// By-products of an expansion: rows (q, r, p, -), (r, p, q, -), half the angular velocity times the unit; the quaternion of axes
  /// whose third is the force's, and of it (w, z, z, w) and (y, x, y, x).
  template <int Order>
  struct Work {
    Lanes<Scalar> forward[Order + 1];
    Lanes<Scalar> backward[Order + 1];
    Lanes<Scalar> thrust[Order + 1];
    Lanes<Scalar> outer[Order + 1];
    Lanes<Scalar> inner[Order + 1];
    QuaternionSeries<Scalar, Order> turn;
  };

  explicit FullSystem(const Problem<Scalar>& problem) noexcept;

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept;

  /// Moves a state at t (from the start) onto the laws that it obeys exactly: |q| = 1; r and, without M1 and M2, |Pi| if D1 = D2;
  /// without torque the energy and R (D1 p, D2 q, D3 r + Lambda).
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept;

  /// The numbers of the start.
  const Numbers& start() const noexcept { return start_; }

  Vec3<Scalar> angular_velocity(const Scalar* x) const noexcept { return {x[0], x[1], x[2]}; }
  /// Body to inertial.
  Quat<Scalar> attitude(const Scalar* x) const noexcept { return normalised(Quat<Scalar>{x[4], x[5], x[6], x[7]}); }
  /// m/s.
  Vec3<Scalar> velocity(const Scalar* x) const noexcept {
    return velocity_ + thrust_ * Vec3<Scalar>(x[8], x[9], x[10]);
  }
  /// m.
  Vec3<Scalar> position(Scalar t, const Scalar* x) const noexcept {
    return position_ + (t * velocity_ + thrust_ * Vec3<Scalar>(x[12], x[13], x[14]));
  }

  /// What the steps measure errors against: the size of the rates, 1 for the quaternion, a radian's time for u, and nothing for the
  /// other quadratures. `span`: how long the motion is asked for, s.
  Numbers scale(Scalar span) const noexcept;

 private:
  using Row = Lanes<Scalar>;

  /// The constants of an expansion.
  struct Constants {
    Row jacobian[3];  ///< columns of the derivative of (p', q', r', A') unit
    Row quadratic;    ///< coefficients of (q r, r p, p q) unit
    Row power;        ///< M unit
    Row half, unit;
  };

  /// Order k + 1 from the orders up to k. Index: an integral constant, so that everything unrolls, or an int.
  template <class Index, int Order>
  GYROSTAT_INLINE void extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                              const Constants& c) const noexcept;

  /// q_IB to q_IB conj(q_FB): the axes whose third is the force's.
  GYROSTAT_INLINE Row to_thrust(const Row& q) const noexcept {
    const Row from_w = q * lanes(q_FB_.w);
    return from_w - times_units(q * lanes(q_FB_.x), q * lanes(q_FB_.y), lanes(Scalar(0)));
  }
  /// R e3 from the sums of (w y, z x, z y, w x) and of (w w, x x, y y, z z).
  static GYROSTAT_INLINE Row third_axis(const Row& mixed, const Row& square, Scalar last) noexcept {
    return lanes(2 * (mixed[0] + mixed[1]), 2 * (mixed[2] - mixed[3]),
                 (square[0] - square[1]) - (square[2] - square[3]), last);
  }

  void project_rates(Scalar t, Scalar* x, Scalar* low) const noexcept;

  Vec3<Scalar> inertia_, torque_, angular_acceleration_;  ///< D, M, M/D
  Scalar gyroscopic_, gyroscopic_1_, gyroscopic_2_;       ///< Lambda, Lambda/D1, Lambda/D2
  Vec3<Scalar> quadratic_;                                ///< of (q r, r p, p q)
  Quat<Scalar> q_FB_;                                     ///< body axes to those whose third is the force's; z = 0
  Scalar thrust_;                                         ///< |f|/m, m/s^2
  Vec3<Scalar> velocity_, position_;
  // exact laws
  Vec3<Scalar> kept_I_;                 ///< R (D1 p, D2 q, D3 r + Lambda) without torque, N m s
  Wider<Scalar> kept_square_, energy_;  ///< the square of its norm, and twice the kinetic energy
  Scalar transverse_, r0_;              ///< |Pi|^2
  bool symmetric_, transverse_is_known_, free_;
  Numbers start_;
};

template <Real Real_>
FullSystem<Real_>::FullSystem(const Problem<Scalar>& problem) noexcept
    : inertia_(problem.inertia),
      torque_(problem.torque),
      angular_acceleration_(problem.torque.cwiseQuotient(problem.inertia)),
      gyroscopic_(problem.gyroscopic()),
      gyroscopic_1_(gyroscopic_ / inertia_[0]),
      gyroscopic_2_(gyroscopic_ / inertia_[1]),
      quadratic_((inertia_[1] - inertia_[2]) / inertia_[0], (inertia_[2] - inertia_[0]) / inertia_[1],
                 (inertia_[0] - inertia_[1]) / inertia_[2]),
      velocity_(problem.velocity),
      position_(problem.position),
      r0_(problem.spin()) {
  const Vec3<Scalar>& f = problem.force;
  const Scalar across = std::hypot(f[0], f[1]);
  const Scalar half = std::atan2(across, f[2]) / 2;
  const Scalar s = across > 0 ? std::sin(half) / across : Scalar(0);
  const bool opposite = across == 0 && f[2] < 0;
  q_FB_ = opposite ? Quat<Scalar>{0, 1, 0, 0} : Quat<Scalar>{std::cos(half), s * f[1], -s * f[0], 0};
  if (across == 0 && !opposite) q_FB_ = {1, 0, 0, 0};
  thrust_ = std::hypot(across, f[2]) / problem.mass;

  const auto& a = problem.angles;
  const Quat<Scalar> q_IB = quaternion_from_312(a.psi, a.phi, a.theta);
  const Vec3<Scalar>& omega = problem.angular_velocity;
  using Wide = Wider<Scalar>;
  const Vec3<Wide> rate = vector_cast<Wide>(omega);
  Vec3<Wide> kept = vector_cast<Wide>(inertia_).cwiseProduct(rate);
  energy_ = rate.dot(kept);
  kept[2] += gyroscopic_;
  kept_square_ = kept.squaredNorm();
  kept_I_ = rotate_once(q_IB, vector_cast<Scalar>(kept));
  transverse_ = static_cast<Scalar>(rate[0] * rate[0] + rate[1] * rate[1]);
  symmetric_ = inertia_[0] == inertia_[1];
  transverse_is_known_ = symmetric_ && torque_[0] == 0 && torque_[1] == 0;
  free_ = torque_.isZero(0);

  start_ = {omega[0], omega[1], omega[2], 0, q_IB.w, q_IB.x, q_IB.y, q_IB.z, 0, 0, 0, 0, 0, 0, 0, 0};
}

template <Real Real_>
auto FullSystem<Real_>::scale(Scalar span) const noexcept -> Numbers {
  const Scalar rate = Vec3<Scalar>(start_[0], start_[1], start_[2]).norm();
  const Scalar stiffness = std::max(std::abs(gyroscopic_1_), std::abs(gyroscopic_2_));
  const Scalar size = std::max(rate, built_rate(angular_acceleration_.norm(), stiffness, torque_[2] != 0, span));
  const Scalar w = size > 0 ? size : Scalar(1);  // at rest any scale will do, but zero would leave the component out
  const Scalar time = std::min(1 / w, span > 0 ? span : 1 / w);
  return {w, w, w, 0, 1, 1, 1, 1, time, time, time, 0, 0, 0, 0, 0};
}

template <Real Real_>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_>::extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work, Row& newest,
                                               const Constants& c) const noexcept {
  const Row y0 = shuffle<0, 0, 0, 0>(newest), y1 = shuffle<1, 1, 1, 1>(newest), y2 = shuffle<2, 2, 2, 2>(newest);

  // terms known since the last order, the youngest last
  const Row zero = lanes(Scalar(0));
  Row product = zero, product_2 = zero;
  if (k % 2 == 0) product = work.forward[k / 2] * work.backward[k / 2];
  count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA {
    product = multiply_add(work.forward[j], work.backward[k - j], product);
    product_2 = multiply_add(work.forward[k - j], work.backward[j], product_2);
  });
  const Row known = c.quadratic * (product + product_2);
  const Row next = over_next(
      multiply_add(c.jacobian[0], y0, multiply_add(c.jacobian[1], y1, multiply_add(c.jacobian[2], y2, known))), k);

  // the quaternion
  const Row motion = c.half * newest;
  store(&x[k + 1][4], over_next(work.turn.extend(k, x, 4, motion), k));

  // the force's direction, power and quadratures
  const Row thrust = to_thrust(load(&x[k][4]));
  const Row outer = shuffle<0, 3, 3, 0>(thrust), inner = shuffle<2, 1, 2, 1>(thrust);
  work.thrust[k] = thrust;
  work.outer[k] = outer;
  work.inner[k] = inner;
  Row mixed = multiply_add(work.outer[0], inner, outer * work.inner[0]);
  count_down<Scalar>(
      k - 1, [&](int j) GYROSTAT_INLINE_LAMBDA { mixed = multiply_add(work.outer[j], work.inner[k - j], mixed); });
  Row square = k % 2 == 0 ? lanes(Scalar(0.5)) * work.thrust[k / 2] * work.thrust[k / 2] : zero;
  count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA {
    square = multiply_add(work.thrust[j], work.thrust[k - j], square);
  });
  square = multiply_add(work.thrust[0], thrust, square);
  const Scalar power = sum(c.power * newest)[0];
  store(&x[k + 1][8],
        over_next(
            c.unit * third_axis(mixed, square + square, Scalar(0)) + lanes(Scalar(0), Scalar(0), Scalar(0), power), k));
  store(&x[k + 1][12], over_next(c.unit * with_last(load(&x[k][8]), zero), k));

  store(&x[k + 1][0], next);
  if (k + 1 < Order) {
    work.forward[k + 1] = shuffle<1, 2, 0, 3>(next);
    work.backward[k + 1] = shuffle<2, 0, 1, 3>(next);
  }
  newest = next;
}

template <Real Real_>
template <int Order>
void FullSystem<Real_>::expand(Scalar, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>& work) const noexcept {
  const Scalar zero = 0;
  const Scalar p = x[0][0], q = x[0][1], r = x[0][2];
  const Vec3<Scalar> a = unit * quadratic_;
  const Scalar l1 = unit * gyroscopic_1_, l2 = unit * gyroscopic_2_;

  Constants c;
  c.unit = lanes(unit);
  c.quadratic = lanes(a[0], a[1], a[2], zero);
  c.power = lanes(unit * torque_[0], unit * torque_[1], unit * torque_[2], zero);
  c.jacobian[0] = lanes(zero, a[1] * r + l2, a[2] * q, zero);
  c.jacobian[1] = lanes(a[0] * r - l1, zero, a[2] * p, zero);
  c.jacobian[2] = lanes(a[0] * q, a[1] * p, zero, unit);
  c.half = lanes(unit / 2);

  const Row start = load(x[0]);
  const Row motion = c.half * start;
  work.forward[0] = shuffle<1, 2, 0, 3>(start);
  work.backward[0] = shuffle<2, 0, 1, 3>(start);
  Row newest = lanes(unit * angular_acceleration_[0] + q * (a[0] * r - l1),
                     unit * angular_acceleration_[1] + p * (a[1] * r + l2),
                     unit * angular_acceleration_[2] + a[2] * (p * q), unit * r);
  store(x[1], newest);
  work.forward[1] = shuffle<1, 2, 0, 3>(newest);
  work.backward[1] = shuffle<2, 0, 1, 3>(newest);

  const Row attitude = load(&x[0][4]);
  store(&x[1][4], work.turn.begin(x, 4, motion));
  work.thrust[0] = to_thrust(attitude);
  work.outer[0] = shuffle<0, 3, 3, 0>(work.thrust[0]);
  work.inner[0] = shuffle<2, 1, 2, 1>(work.thrust[0]);
  const Scalar power = sum(c.power * start)[0];
  store(&x[1][8], c.unit * third_axis(work.outer[0] * work.inner[0], work.thrust[0] * work.thrust[0], zero) +
                      lanes(zero, zero, zero, power));
  store(&x[1][12], c.unit * with_last(load(&x[0][8]), lanes(zero)));

  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA { extend(k, x, work, newest, c); };
  count_up<Scalar, Order - 1>(next);
}

template <Real Real_>
void FullSystem<Real_>::project_rates(Scalar t, Scalar* x, Scalar* low) const noexcept {
  const auto dot = [&](int i) noexcept { return x[i] * low[i]; };
  if (symmetric_) {
    const Scalar gain = angular_acceleration_[2] * t;
    x[2] = r0_ + gain;
    low[2] = (r0_ - x[2]) + gain;
    if (transverse_is_known_ && transverse_ > 0) {
      const Scalar stretch = ((transverse_ - x[0] * x[0] - x[1] * x[1]) / 2 - dot(0) - dot(1)) / transverse_;
      add_to(x[0], low[0], stretch * x[0]);
      add_to(x[1], low[1], stretch * x[1]);
    }
  } else if (free_) {
    const Vec3<Scalar> omega{x[0], x[1], x[2]};
    const Vec3<Scalar> G = inertia_.cwiseProduct(omega);
    const Vec3<Scalar> H(G[0], G[1], G[2] + gyroscopic_);
    const Vec3<Scalar> along = inertia_.cwiseProduct(H);  // gradients of |H|^2/2 and of the energy
    // in more digits: a spin that hardly changes would be moved by the same rounding in each step
    Wider<Scalar> norm = kept_square_, energy = energy_;
    for (int i = 0; i < 3; ++i) {
      const Wider<Scalar> rate = Wider<Scalar>(x[i]) + low[i], its = inertia_[i] * rate;
      const Wider<Scalar> whole = i == 2 ? its + gyroscopic_ : its;
      norm -= whole * whole;
      energy -= rate * its;
    }
    const Scalar missing_norm = static_cast<Scalar>(norm) / 2, missing_energy = static_cast<Scalar>(energy) / 2;
    // the least change of omega, in the metric of the inertia, that corrects both: a combination of H and omega
    const Scalar hh = along.dot(H), hw = along.dot(omega), ww = G.dot(omega);
    const Scalar determinant = hh * ww - hw * hw;
    Vec3<Scalar> change{0, 0, 0};
    if (64 * determinant > hh * ww) {
      change = ((missing_norm * ww - missing_energy * hw) / determinant) * H +
               ((missing_energy * hh - missing_norm * hw) / determinant) * omega;
    } else if (ww > 0) {
      change = (missing_energy / ww) * omega;
    }
    for (int i = 0; i < 3; ++i) add_to(x[i], low[i], change[i]);
  }
}

template <Real Real_>
void FullSystem<Real_>::project(Scalar t, Scalar* x, Scalar* low) const noexcept {
  if (symmetric_ || free_) project_rates(t, x, low);
  Scalar missing = 1, along = 0;
  for (int i = 4; i < 8; ++i) missing -= x[i] * x[i];
  for (int i = 4; i < 8; ++i) along += x[i] * low[i];
  const Scalar stretch = missing / 2 - along;
  Quat<Scalar> change{stretch * x[4], stretch * x[5], stretch * x[6], stretch * x[7]};
  if (free_) {
    const Quat<Scalar> q{x[4], x[5], x[6], x[7]};
    const Vec3<Scalar> rest = rotate<Scalar>(conjugate(q), kept_I_);
    const Vec3<Scalar> H(inertia_[0] * x[0], inertia_[1] * x[1], inertia_[2] * x[2] + gyroscopic_);
    const Scalar whole = inertia_.cwiseProduct(Vec3<Scalar>(x[0], x[1], x[2])).norm() + std::abs(gyroscopic_);
    const Scalar size = H.squaredNorm();
    // the least turn of the body that brings R H onto its constant; where H nearly cancels its direction is lost
    if (size > Scalar(1e-4L) * whole * whole) {
      // what q still has in low turns R H too
      const Quat<Scalar> d = conjugate(q) * Quat<Scalar>{low[4], low[5], low[6], low[7]};
      const Vec3<Scalar> pending(2 * d.x, 2 * d.y, 2 * d.z);
      Vec3<Scalar> turn = cross<Scalar>(H, rest) / size;
      turn -= pending - H * (H.dot(pending) / size);
      const Quat<Scalar> turned = q * Quat<Scalar>{0, turn[0] / 2, turn[1] / 2, turn[2] / 2};
      change = {change.w + turned.w, change.x + turned.x, change.y + turned.y, change.z + turned.z};
    }
  }
  add_to(x[4], low[4], change.w);
  add_to(x[5], low[5], change.x);
  add_to(x[6], low[6], change.y);
  add_to(x[7], low[7], change.z);
}

#ifdef GYROSTAT_COMPILED
extern template void FullSystem<double>::expand<20>(double, double, double (&)[21][FullSystem<double>::width],
                                                    FullSystem<double>::Work<20>&) const noexcept;
#endif

}  // namespace gyrostat::spinning
