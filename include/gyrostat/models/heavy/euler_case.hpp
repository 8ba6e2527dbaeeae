// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/body/free_motion.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/math/jacobi.hpp"
#include "gyrostat/math/third_kind.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/exact_error.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

/// The motion without torque (Euler, Poinsot) with its attitude, exact but for rounding: docs/heavy.md, section 7. The
/// body's axis `near` is the one that the path of the angular momentum L surrounds; the part of L along it is +-sqrt(1
/// - tilt) dn, those along the middle and the far one go with sn and cn. Moments in any order and equal ones too.
///
/// With the vertical laid along L the attitude's two amplitudes (TopAttitude) turn at the rates
///     (L/I_near + (2 T/L - L/I_near)/(1 +- m))/2,  m = sqrt(1 - tilt) dn:
/// one integral of the third kind with positive characteristic, and the angle of the two other parts of L, for both.
template <Real Scalar>
class EulerCase {
 public:
  EulerCase() = default;

  /// Errors: not_applicable (weight off O, or a gradient on a body that is no sphere); not_finite; zero_vector. The
  /// start is aligned().
  static Result<EulerCase> make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    const Vec3<Scalar>& I = problem.inertia();
    if (!(problem.moment().array() == 0).all() || (problem.gradient() != 0 && I.maxCoeff() != I.minCoeff()))
      return Errc::not_applicable;
    const auto from = aligned(start);
    if (!from) return from.error();
    EulerCase made;
    made.build(I, *from);
    return made;
  }

  State<Scalar> at(Scalar t) const noexcept {
    if (L_ == 0) return start_;
    t *= unit_;
    const Point p = point(t);
    const Scalar m = std::sqrt(along_) * p.u.dn;
    const Scalar opposite = tilt_ * (p.u.sn * p.u.sn * steep_ + p.u.cn * p.u.cn);  // 1 - m^2
    const Scalar inner = std::sqrt((1 + m) / 2), outer = std::sqrt(opposite / (2 * (1 + m)));
    const C a = (side_ > 0 ? outer : inner) * (above_ * math::unit(-p.phase_above));
    const C b = (side_ > 0 ? inner : outer) * (below_ * math::unit(-p.phase_below));
    const Quat<Scalar> q = back_ * Quat<Scalar>{a.re, b.re, b.im, a.im} * turn_;
    Vec3<Scalar> direction;
    direction[near_] = side_ * m;
    direction[middle_] = p.sign * std::sqrt(tilt_ * steep_) * p.u.sn;
    direction[far_] = p.sign * -side_ * order_ * std::sqrt(tilt_) * p.u.cn;
    State<Scalar> s;
    s.angular_velocity = unit_ * L_ * direction.cwiseProduct(inverse_);
    s.attitude = normalised(q);
    s.down = rotate<Scalar>(conjugate(s.attitude), Vec3<Scalar>(0, 0, -1));
    return s;
  }

  /// Bound of the error of at() up to time |t|.
  ExactError<Scalar> error(Scalar t) const noexcept {
    t = std::abs(unit_ * t);
    const Scalar late = time_error(rounding * share_, rounding * shift_, K_, rate_, t);
    // both amplitudes change no faster than this but for steady turns
    const Scalar pace = 4 * (rate_ + L_ * near_far_ * tilt_);
    return ExactError<Scalar>::of(rounding * (1 + fastest_ * t) + pace * late, unit_ * fastest_);
  }

  math::Modulus<Scalar> modulus() const noexcept { return modulus_; }
  /// Of the angular velocity in the body, s; infinite on the separatrix and in a permanent rotation of a body with
  /// three axes.
  Scalar period() const noexcept {
    return rate_ > 0 && rounding * shift_ < 1 ? 4 * K_ / (unit_ * rate_) : infinity<Scalar>;
  }

 private:
  using C = math::Complex<Scalar>;
  static constexpr Scalar rounding = 64 * epsilon<Scalar>;
  struct Point {
    math::JacobiTurn<Scalar> u;
    Scalar sign;  // of sn and cn: - after an odd number of half periods
    Scalar phase_above, phase_below;
  };

  /// |1/I_i - 1/I_j| in the unit of inverse_.
  Scalar gap(const Vec3<Scalar>& I, int i, int j) const noexcept {
    return std::abs(I[i] - I[j]) / I.maxCoeff() * inverse_[i] * inverse_[j];
  }
  void choose_axes(const Vec3<Scalar>& I, const Vec3<Scalar>& m) noexcept;
  void set_path(const Vec3<Scalar>& I, const Vec3<Scalar>& m) noexcept;
  void set_attitude(const Quat<Scalar>& attitude, const Vec3<Scalar>& m) noexcept;
  void build(const Vec3<Scalar>& I, const State<Scalar>& start) noexcept;
  Point point(Scalar t) const noexcept {
    const auto u = math::JacobiTurn<Scalar>::of(functions_, v0_ + rate_ * t);
    const Scalar sign = std::fmod(u.turns, Scalar(2)) == 0 ? 1 : -1;
    // L near_far int dt/(1 + eta sn^2), and the unwrapped angle
    const Scalar third = factor_ == 0 ? Scalar(0) : factor_ * third_(u.minus_quarter(modulus_, K_));
    const Scalar G = L_ * near_far_ * t / steep_ + third;
    const Scalar theta = std::atan2(std::sqrt(steep_) * u.sn, u.cn) + pi<Scalar> * u.turns;
    const Scalar even = L_ * inverse_[near_] * t;
    const Scalar inner = (even + growing_ * (G - theta)) / 2, outer = (even + growing_ * (G + theta)) / 2;
    return {u, sign, side_ > 0 ? outer : inner, side_ > 0 ? inner : outer};
  }

  State<Scalar> start_;
  Scalar unit_ = 1, L_ = 0;
  Vec3<Scalar> inverse_{1, 1, 1};  // 1/I in the unit of the moments
  int near_ = 2, middle_ = 1, far_ = 0;
  Scalar side_ = 1, growing_ = 1,
         order_ = 1;  // signs: of L along near; of 1/I_far - 1/I_near; of the order of the axes times growing
  Scalar tilt_ = 0, along_ = 1;      // and 1 - tilt
  Scalar near_far_ = 0, steep_ = 1;  // |1/I_near - 1/I_far|; near_far/near_mid
  math::Modulus<Scalar> modulus_;
  math::JacobiAt<Scalar> functions_{math::Modulus<Scalar>{}};
  math::ThirdKind<Scalar> third_;
  Scalar rate_ = 0, v0_ = 0, K_ = 0, factor_ = 0;
  Scalar fastest_ = 0, share_ = 1, shift_ = 0;
  Quat<Scalar> back_, turn_;
  C above_, below_;
};

/// near_, middle_ and far_ of the unit vector m along L: of a body with an axis of symmetry near is that one, of a sphere the one
/// nearest to L. Sets the signs with them.
template <Real Scalar>
void EulerCase<Scalar>::choose_axes(const Vec3<Scalar>& I, const Vec3<Scalar>& m) noexcept {
  const Vec3<Scalar> square = m.cwiseAbs2();
  int sorted[3] = {0, 1, 2};  // moments descending
  std::sort(sorted, sorted + 3, [&](int i, int j) { return I[i] > I[j]; });
  middle_ = sorted[1];
  const Scalar first = gap(I, sorted[0], middle_), last = gap(I, middle_, sorted[2]);
  bool largest = surrounds_largest(first, last, square[sorted[0]], square[sorted[2]]);
  if (first == 0) largest = false;
  else if (last == 0) largest = true;
  if (I.maxCoeff() == I.minCoeff()) {
    int nearest = 0;
    square.maxCoeff(&nearest);
    near_ = nearest;
    middle_ = (near_ + 1) % 3;
    far_ = (near_ + 2) % 3;
  } else {
    near_ = sorted[largest ? 0 : 2];
    far_ = sorted[largest ? 2 : 0];
  }
  growing_ = largest ? 1 : -1;  // 1/I grows from near to far
  side_ = m[near_] < 0 ? -1 : 1;
  order_ = (middle_ == (near_ + 1) % 3 ? 1 : -1) * growing_;
}

/// The shape of the path and where m lies on it.
template <Real Scalar>
void EulerCase<Scalar>::set_path(const Vec3<Scalar>& I, const Vec3<Scalar>& m) noexcept {
  const Vec3<Scalar> square = m.cwiseAbs2();
  const PolhodeGaps<Scalar> gaps{gap(I, near_, middle_), gap(I, middle_, far_), gap(I, near_, far_)};
  near_far_ = gaps.near_far;
  fastest_ = 1 + L_ * inverse_.maxCoeff();
  if (gaps.axisymmetric()) {
    tilt_ = square[middle_] + square[far_];
    along_ = square[near_];
  } else {
    const auto shape = PolhodeShape<Scalar>::of(gaps, square[near_], square[middle_], square[far_]);
    tilt_ = shape.tilt;
    along_ = shape.along;
    steep_ = near_far_ / gaps.near_mid;
    constexpr Scalar floor = epsilon<Scalar> * epsilon<Scalar>;
    modulus_ = {shape.modulus.k2, std::max(shape.modulus.kp2, floor)};
    shift_ = shape.sensitivity;
    share_ = std::sqrt(steep_);
  }
  functions_ = math::JacobiAt<Scalar>(modulus_);
  K_ = functions_.quarter_period();
  rate_ = L_ * rate_per_momentum(gaps, along_);
  if (!gaps.axisymmetric()) {
    third_ = math::ThirdKind<Scalar>(modulus_, modulus_.kp2 / steep_);
    factor_ = L_ * near_far_ * (steep_ - 1) * modulus_.kp2 / (steep_ * steep_ * rate_);
  }
  if (tilt_ > 0) {
    const Scalar sn = m[middle_] / std::sqrt(tilt_ * steep_), cn = -side_ * order_ * m[far_] / std::sqrt(tilt_);
    const Scalar dn =
        std::max(std::abs(m[near_]) / std::sqrt(along_ > 0 ? along_ : Scalar(1)), std::sqrt(modulus_.kp2));
    const Scalar u = math::jacobi_argument(sn, std::abs(cn), dn);
    v0_ = cn < 0 ? std::copysign(2 * K_, sn) - u : u;
  }
}

/// The attitude of a frame whose third axis is near, the vertical laid along L.
template <Real Scalar>
void EulerCase<Scalar>::set_attitude(const Quat<Scalar>& attitude, const Vec3<Scalar>& m) noexcept {
  const int k = near_;
  constexpr Scalar h = Scalar(0.5);
  const Quat<Scalar> frame = k == 0 ? Quat<Scalar>{h, h, h, h} : k == 1 ? Quat<Scalar>{h, -h, -h, -h} : Quat<Scalar>{};
  turn_ = conjugate(frame);
  const Quat<Scalar> lay = shortest_turn<Scalar>(rotate<Scalar>(attitude, m), Vec3<Scalar>(0, 0, -1));
  back_ = conjugate(lay);
  const Quat<Scalar> q = lay * attitude * frame;
  const Point p = point(0);
  const auto phase = [](Scalar re, Scalar im, Scalar by) {
    const Scalar size = std::hypot(re, im);
    return size > 0 ? C{re / size, im / size} * math::unit(by) : C{1, 0};
  };
  above_ = phase(q.w, q.z, p.phase_above);
  below_ = phase(q.x, q.y, p.phase_below);
}

template <Real Scalar>
void EulerCase<Scalar>::build(const Vec3<Scalar>& I, const State<Scalar>& start) noexcept {
  start_ = start;
  unit_ = start.angular_velocity.stableNorm();
  if (!(unit_ > 0)) return;
  const Vec3<Scalar> J = I / I.maxCoeff(), w = start.angular_velocity / unit_;
  inverse_ = J.cwiseInverse();
  Vec3<Scalar> m = J.cwiseProduct(w);
  L_ = m.norm();
  m /= L_;
  choose_axes(I, m);
  set_path(I, m);
  set_attitude(start.attitude, m);
}

}  // namespace gyrostat::heavy
