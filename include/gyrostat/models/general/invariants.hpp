// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/least_change.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/parts.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/prepared.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// What a motion keeps exactly while torques are conservative: the full equations are put back onto it after each step.
namespace gyrostat::general {

/// Over a piece, as far as all that acts in it spares them (docs/general.md, section 1.7):
///     energy    H = G.J*^-1 G/2 - sum m.v + (N/2) d.J d + (N/2) rh.J rh - n hh.(M - e_H),  G = M - l: on a circular orbit Jacobi's integral;
///     momentum  K = (M - e_H).v, where one direction v of space is all that torques know; without any |M|^2/2.
template <Real Scalar>
class Invariants {
 public:
  /// x: (w, x, y, z | M1, M2, M3) at the begin of the piece, lost: what rounding has lost of them.
  Invariants(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Scalar* x, const Scalar* lost) noexcept;

  explicit operator bool() const noexcept { return keeps_energy_ || keeps_momentum_; }
  bool keeps_energy() const noexcept { return keeps_energy_; }

  /// The least turn of the body, rad, and change of M, N m s, body axes, that put a state back.
  struct Change {
    Vec3<Scalar> turn{0, 0, 0}, momentum{0, 0, 0};
  };
  /// Of x + lost at t; q: the quaternion in x brought to unit length.
  Change missing(Scalar t, const Quat<Scalar>& q, const Scalar* x, const Scalar* lost) const noexcept;

 private:
  using Wide = Wider<Scalar>;

  template <class Number>
  struct Values {
    Number energy, momentum;
  };
  /// Directions as a body of this attitude sees them.
  template <class Number>
  struct Views {
    Vec3<Number> directions[3], down, outward, normal;
  };
  template <class Number>
  Views<Number> views(const Quat<Number>& q, Scalar t) const noexcept {
    Views<Number> made;
    const Mat3<Number> R = to_matrix(conjugate(q));
    const auto see = [&](const Vec3<Scalar>& v) noexcept { return Vec3<Number>(R * vector_cast<Number>(v)); };
    for (int i = 0; i < directions_.count; ++i) made.directions[i] = see(directions_.of[std::size_t(i)]);
    if (gradient_ != 0) made.down = see(down_);
    if (orbit_ != nullptr) made.outward = see(orbit_at(*orbit_, t).radial), made.normal = see(normal_);
    return made;
  }
  /// Whether the momentum about body axis i never changes: one of symmetry, which all torques and wheels are along.
  bool keeps_axis(int i) const noexcept {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const auto along = [&](const Vec3<Scalar>& v) noexcept { return v[j] == 0 && v[k] == 0; };
    const auto symmetric = [&](const Mat3<Scalar>& J) noexcept { return J.isDiagonal(0) && J(j, j) == J(k, k); };
    const bool pulled = gradient_ != 0 || orbit_gradient_ != 0;
    return symmetric(inverse_) && (!pulled || symmetric(whole_)) && along(wheels_) && along(charge_) &&
           std::all_of(moments_.begin(), moments_.end(), along);
  }
  template <class Number>
  Values<Number> values(const Views<Number>& seen, const Vec3<Number>& M) const noexcept {
    const Vec3<Number> G = M - vector_cast<Number>(wheels_);
    const auto form = [](const Mat3<Scalar>& J, const Vec3<Number>& v) noexcept {
      return v.dot(Vec3<Number>(matrix_cast<Number>(J) * v));
    };
    Number energy = form(loose_inverse_, G);
    if (gradient_ != 0) energy += gradient_ * form(whole_, seen.down);
    if (orbit_ != nullptr) energy += orbit_gradient_ * form(whole_, seen.outward);
    energy = energy / 2;
    for (int i = 0; i < directions_.count; ++i) energy -= seen.directions[i].dot(vector_cast<Number>(moments_[i]));
    const Vec3<Number> own = M - vector_cast<Number>(charge_);
    if (orbit_ != nullptr) energy -= orbit_rate_ * seen.normal.dot(own);
    if (!keeps_momentum_) return {energy, Number(0)};
    const Number momentum = is_free_ ? M.squaredNorm() / 2 : seen.directions[0].dot(own);
    return {energy, momentum};
  }

  Mat3<Scalar> whole_, inverse_;
  Mat3<Scalar> loose_, loose_inverse_;  ///< J* and its inverse; without the axis about which the momentum never changes
  Vec3<Scalar> wheels_{0, 0, 0}, charge_{0, 0, 0};  ///< l; e_H
  Directions<Scalar> directions_;
  std::array<Vec3<Scalar>, 3> moments_;  ///< of the torques m x v along each
  Vec3<Scalar> down_{0, 0, -1}, normal_{0, 0, 1};
  const Orbit<Scalar>* orbit_ = nullptr;
  Scalar gradient_ = 0, orbit_gradient_ = 0, orbit_rate_ = 0;
  bool keeps_energy_ = false, keeps_momentum_ = false, is_free_ = false;
  Scalar per_whole_ = 0;               ///< 1 over the energy of the whole at the rate that it turns at, 1/J
  Scalar potential_ = 0, torque_ = 0;  ///< bounds of the potential energy, J, and of what else than itself turns M, N m
  Scalar energy_ = 0, momentum_ = 0;   ///< at the begin
};

template <Real Scalar>
Invariants<Scalar>::Invariants(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Scalar* x,
                               const Scalar* lost) noexcept
    : whole_(of.wheels.whole),
      inverse_(of.wheels.inverse),
      loose_(of.wheels.reduced),
      loose_inverse_(of.wheels.inverse) {
  const Terms<Scalar>& sum = piece.power[0];
  const auto changes = [](const Terms<Scalar>& terms) noexcept { return terms.any_torque(); };
  if (!(of.sizes.turning > 0) || std::any_of(piece.power.begin() + 1, piece.power.end(), changes) ||
      std::any_of(piece.waves.begin(), piece.waves.end(),
                  [&](const auto& wave) noexcept { return changes(wave.terms); }))
    return;
  const auto& problem = of.problem;
  const bool steady_wheels =
      of.settling.count == 0 && std::all_of(piece.momentum.begin() + 1, piece.momentum.end(),
                                            [](const auto& rate) noexcept { return rate.isZero(0); });
  is_free_ = !sum.any_torque();

  down_ = problem.field.down;
  add_directions(directions_, sum, normal_);
  if (sum.gradient != 0) directions_.need(down_);
  Terms<Scalar> left = sum;
  moments_.fill({0, 0, 0});
  for (int j = 0; j < 3; ++j) {
    Mat3<Scalar>& A = left.inertial[std::size_t(j)];
    const Vec3<Scalar> moment(A(2, 1), A(0, 2), A(1, 0));
    for (int i = 0; i < directions_.count; ++i)
      moments_[std::size_t(i)] += directions_.share(i, Vec3<Scalar>::Unit(j)) * moment;
    if (A == -A.transpose()) A.setZero();
  }
  if (left.by_rate == -left.by_rate.transpose()) left.by_rate.setZero();
  left.gradient = 0;
  keeps_momentum_ = is_free_ || (directions_.count == 1 && !left.any_torque());
  // an orbit turns against all directions of space that have a torque
  if (problem.orbit && problem.orbit->eccentricity == 0 && directions_.count == 0) left.orbit_gradient = 0;
  keeps_energy_ = steady_wheels && !left.any_torque();
  if (!*this) return;

  charge_ = {sum.by_rate(2, 1), sum.by_rate(0, 2), sum.by_rate(1, 0)};
  gradient_ = sum.gradient;
  if (sum.orbit_gradient != 0) {
    orbit_ = &*problem.orbit;
    const auto point = orbit_at(*orbit_, Scalar(0));
    orbit_gradient_ = sum.orbit_gradient * point.gradient, orbit_rate_ = point.rate;
    normal_ = cross<Scalar>(orbit_->radial, orbit_->along);
  }
  wheels_ = piece.momentum[0];
  for (int i = 0; i < 3; ++i) {
    if (!keeps_axis(i)) continue;
    loose_.row(i).setZero(), loose_.col(i).setZero();
    loose_inverse_.row(i).setZero(), loose_inverse_.col(i).setZero();
    break;
  }
  using std::abs;
  const Scalar greatest = of.sizes.greatest, rate = of.sizes.turning;
  per_whole_ = 1 / (greatest * rate * rate);
  torque_ = of.sizes.external + charge_.norm() * rate;
  potential_ = (abs(gradient_) + abs(orbit_gradient_)) * greatest;
  for (const auto& m : moments_) potential_ += m.norm();

  const auto whole = [&](int i) noexcept { return Wide(x[i]) + Wide(lost[i]); };
  const Quat<Wide> q = normalised(Quat<Wide>{whole(0), whole(1), whole(2), whole(3)});
  const Vec3<Wide> M(whole(4), whole(5), whole(6));
  const auto start = values<Wide>(views<Wide>(q, piece.from), M);
  energy_ = static_cast<Scalar>(start.energy), momentum_ = static_cast<Scalar>(start.momentum);
}

template <Real Scalar>
auto Invariants<Scalar>::missing(Scalar t, const Quat<Scalar>& q, const Scalar* x, const Scalar* lost) const noexcept
    -> Change {
  const Vec3<Scalar> M(x[4], x[5], x[6]), M_lost(lost[4], lost[5], lost[6]);
  const Quat<Scalar> q_lost = conjugate(q) * Quat<Scalar>{lost[0], lost[1], lost[2], lost[3]};
  const Vec3<Scalar> turn_lost(2 * q_lost.x, 2 * q_lost.y, 2 * q_lost.z);
  const auto seen = views<Scalar>(q, t);
  const auto now = values<Scalar>(seen, M);

  // derivatives by M and by a turn of the body
  const Vec3<Scalar> own = M - charge_;
  const Vec3<Scalar> w = inverse_ * Vec3<Scalar>(M - wheels_),
                     n = orbit_ != nullptr ? Vec3<Scalar>(orbit_rate_ * seen.normal) : Vec3<Scalar>(0, 0, 0);
  Vec3<Scalar> torque(0, 0, 0);
  for (int i = 0; i < directions_.count; ++i) torque += cross<Scalar>(moments_[std::size_t(i)], seen.directions[i]);
  if (gradient_ != 0) torque += gradient_ * cross<Scalar>(seen.down, Vec3<Scalar>(whole_ * seen.down));
  if (orbit_ != nullptr) torque += orbit_gradient_ * cross<Scalar>(seen.outward, Vec3<Scalar>(whole_ * seen.outward));
  const Vec3<Scalar> energy_by_M = loose_inverse_ * Vec3<Scalar>(M - wheels_) - n,
                     energy_by_turn = -torque - cross<Scalar>(own, n);
  const Vec3<Scalar> momentum_by_M = is_free_ ? M : seen.directions[0];
  const Vec3<Scalar> momentum_by_turn = is_free_ ? Vec3<Scalar>(0, 0, 0) : cross<Scalar>(own, seen.directions[0]);

  Scalar lacking_energy = 0, lacking_momentum = 0, ee = 0, ss = 0, es = 0;
  // A fast spin hardly changes while directions go round: then the steps err in these, by the ratio of their rates more than in M.
  const Scalar swing = cross<Scalar>(M, w).norm() + torque_;
  const Scalar give = std::clamp(swing * swing * per_whole_ * per_whole_, Scalar(1e-6L), Scalar(1));
  const auto product = [&](const Vec3<Scalar>& M1, const Vec3<Scalar>& turn1, const Vec3<Scalar>& M2,
                           const Vec3<Scalar>& turn2) noexcept {
    return give * M1.dot(loose_ * M2) + per_whole_ * turn1.dot(turn2);
  };
  // rounding of a great energy or momentum must not move the body: a defect that small is corrected only as far as it moves it by a rounding
  const auto with_rounding = [&](Scalar square, Scalar lacking, Scalar size) noexcept {
    return std::abs(lacking) <= 64 * epsilon<Scalar> * size ? square + per_whole_ * size * size : square;
  };
  if (keeps_energy_) {
    lacking_energy = (energy_ - now.energy) - energy_by_M.dot(M_lost) - energy_by_turn.dot(turn_lost);
    const Scalar size = (M.norm() + wheels_.norm()) * (w.norm() + orbit_rate_) + potential_;
    ee = with_rounding(product(energy_by_M, energy_by_turn, energy_by_M, energy_by_turn), lacking_energy, size);
  }
  if (keeps_momentum_) {
    lacking_momentum = (momentum_ - now.momentum) - momentum_by_M.dot(M_lost) - momentum_by_turn.dot(turn_lost);
    const Scalar size = is_free_ ? M.squaredNorm() : M.norm() + charge_.norm();
    ss = with_rounding(product(momentum_by_M, momentum_by_turn, momentum_by_M, momentum_by_turn), lacking_momentum,
                       size);
  }
  if (keeps_energy_ && keeps_momentum_) es = product(energy_by_M, energy_by_turn, momentum_by_M, momentum_by_turn);
  const auto [by_energy, by_momentum] = math::least_change(lacking_energy, lacking_momentum, ee, es, ss);
  return {per_whole_ * (by_energy * energy_by_turn + by_momentum * momentum_by_turn),
          give * Vec3<Scalar>(loose_ * (by_energy * energy_by_M + by_momentum * momentum_by_M))};
}

}  // namespace gyrostat::general
