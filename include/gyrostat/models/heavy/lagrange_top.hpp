// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/jacobi.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/math/third_kind.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/exact_error.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

namespace gyrostat::heavy {

/// What the axis of a top does.
enum class AxisMotion : std::uint8_t {
  nutation,    ///< its inclination oscillates
  regular,     ///< constant inclination: regular precession, or rest
  sleeping,    ///< upright or hanging
  separatrix,  ///< to rounding, tends to upright without ever getting there
};

/// The motion of a top without gravity gradient (Lagrange) in Jacobi's functions, at any time and exact but for
/// rounding (docs/heavy.md, section 7). Any axis of symmetry, mass centre on either side of O or at O, sphere,
/// spherical pendulum; a start anywhere, upright too.
///
/// With w = s u, s = -1 where the mass centre lies on the positive axis and kappa = 2 |W|/A, the axis obeys
///     w'^2 = (w - w1)(w2 - w)(h(1) + kappa (1 - w)),   w = w1 + (w2 - w1) sn^2(lam t + v0),
/// where h(1) = kappa (w3 - 1). Distances from the poles w = +-1 and from the third root come from sums of positive
/// terms, and each of the two amplitudes of TopAttitude has one integral of the third kind, with positive
/// characteristic.
template <Real Scalar>
class LagrangeTop {
 public:
  LagrangeTop() = default;

  /// Errors: not_applicable (no axis of symmetry through the mass centre, or a gradient that acts); not_finite;
  /// zero_vector. start.down is made unit, and start.attitude turned the shortest way to where it agrees with it.
  static Result<LagrangeTop> make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    const auto top = SymmetricTop<Scalar>::of(problem);
    if (!top) return top.error();
    if (top->gradient_rate() != 0) return Errc::not_applicable;
    const auto from = aligned(start);
    if (!from) return from.error();
    LagrangeTop made;
    made.build(*top, TopStart<Scalar>(*top, *from));
    return made;
  }

  State<Scalar> at(Scalar t) const noexcept { return attitude_.at(unit_ * t, axis(unit_ * t)); }

  /// Bound of the error of at() up to time |t|. uneven: by how much more than it shows the body is off its symmetry, relative.
  ExactError<Scalar> error(Scalar t, Scalar uneven = 0) const noexcept { return error_by(stated, t, uneven); }
  /// What of it the lacking symmetry makes alone.
  ExactError<Scalar> uneven_error(Scalar t, Scalar uneven) const noexcept { return error_by(0, t, uneven); }
  /// For how long what the body is off its symmetry by adds up, s; infinite where it always does.
  Scalar lasting() const noexcept { return lasting_ / unit_; }

  AxisMotion motion() const noexcept { return motion_; }
  math::Modulus<Scalar> modulus() const noexcept { return modulus_; }
  Scalar rate() const noexcept { return unit_ * lam_; }  ///< of the argument of Jacobi's functions, rad/s
  /// Least and greatest down along the axis of symmetry.
  Scalar least() const noexcept { return s_ > 0 ? below1_ - 1 : 1 - below2_; }
  Scalar greatest() const noexcept { return s_ > 0 ? 1 - above2_ : 1 - below1_; }
  /// Of the nutation, s; of small nutation where there is none; infinite on the separatrix.
  Scalar nutation_period() const noexcept {
    return motion_ == AxisMotion::separatrix || lam_ == 0 ? infinity<Scalar> : 2 * K_ / (unit_ * lam_);
  }
  /// A pendulum: the axis stays in one vertical plane. It passes the vertical once in a nutation where it swings, twice where it goes
  /// round.
  bool planar() const noexcept { return planar_; }
  /// Of the body's symmetry, by rounding, which the motion leaves out; relative.
  Scalar defect() const noexcept { return defect_; }
  /// The same to the last digit: off the plane by a rounding the axis passes the vertical on one side, by half a turn.
  bool in_plane() const noexcept { return in_plane_; }
  /// Turn of the axis about the vertical in one nutation, right-handed about DOWN, rad; of a pendulum, whose plane stands still, 0. Where
  /// the axis passes through the vertical, half a turn more or less is the same.
  Scalar precession_per_nutation() const noexcept {
    if (planar_) return 0;
    const auto [below, above] = phases_per_nutation();
    return below + above;
  }
  /// Their signs tell on which side the axis passes the upper and the lower pole: what is left of momenta that cancel there, over their size.
  std::array<Scalar, 2> sides() const noexcept { return {c_above_ / fastest_, c_below_ / fastest_}; }
  /// rad/s; on the separatrix that of its end.
  Scalar mean_precession() const noexcept {
    if (motion_ == AxisMotion::separatrix) return unit_ * s_ * rho_ / 2;
    if (motion_ != AxisMotion::nutation) return unit_ * (c_below_ / below2_ + c_above_ / above1_) / 2;
    return precession_per_nutation() / nutation_period();
  }

 private:
  static constexpr Scalar floor = epsilon<Scalar> * epsilon<Scalar> * epsilon<Scalar>;
  static constexpr Scalar modulus_floor = epsilon<Scalar> * epsilon<Scalar>;
  static constexpr Scalar rounding = 24 * epsilon<Scalar>, stated = 4 * epsilon<Scalar>;
  // of where the motion starts: the greatest of 60 000 random starts was 9.4 eps
  static constexpr Scalar set_up = 12 * epsilon<Scalar>;

  /// What the phases of TopAttitude gain in one nutation, rad, of the poles w = -1 and w = 1.
  std::array<Scalar, 2> phases_per_nutation() const noexcept {
    const Scalar T = unit_ * nutation_period();
    return {c_below_ / 2 * (T + plus_factor_ * 2 * plus_.complete()) / below2_,
            c_above_ / 2 * (T + minus_factor_ * 2 * minus_.complete()) / above1_};
  }
  ExactError<Scalar> error_by(Scalar rounded, Scalar t, Scalar uneven) const noexcept;
  void build(const SymmetricTop<Scalar>& top, const TopStart<Scalar>& o) noexcept;
  void roots(const TopStart<Scalar>& o, Scalar kappa) noexcept;
  AxisPoint<Scalar> axis(Scalar t) const noexcept;

  // in terms of w; the poles w = -1 and w = +1 are called below and above here
  Scalar unit_ = 1, s_ = 1;           // of rate, rad/s; all that follows is in it
  Scalar z1_ = 0, z2_ = 0;            // w1 - w0 <= 0 <= w2 - w0
  Scalar below1_ = 1, below2_ = 1;    // 1 + w1, 1 + w2
  Scalar above1_ = 1, above2_ = 1;    // 1 - w1, 1 - w2
  Scalar h_minus_ = 0, h_plus_ = 0;   // h(-1), h(1)
  Scalar h0_ = 0, h1_ = 0, h2_ = 0;   // h at w0, w1, w2
  Scalar c_below_ = 0, c_above_ = 0;  // c of TopAttitude
  Scalar rho_ = 0, width_ = 0;        // w2 - w1
  Scalar lam_ = 0, v0_ = 0, K_ = 0;
  bool from_upper_ = false;  // v0 is counted from K
  math::Modulus<Scalar> modulus_;
  math::JacobiAt<Scalar> functions_{math::Modulus<Scalar>{}};
  math::ThirdKind<Scalar> plus_, minus_;       // of the poles -1 (from w2) and +1 (from w1)
  Scalar plus_factor_ = 0, minus_factor_ = 0;  // before them, s
  Scalar fastest_ = 0, across_ = 0, carried_ = 0, thin_ = 1, swing_ = 0, share_ = 1, shift_ = 0, defect_ = 0;
  AxisMotion motion_ = AxisMotion::nutation;
  bool planar_ = false, in_plane_ = false, standing_ = false, sphere_ = false;
  Scalar torn_ = 0;  // the gradient that acts on what the body is off its symmetry
  Scalar lasting_ = infinity<Scalar>;
  Scalar growth_ = 0;  // of what is off an axis that stands: square of its rate, of its tilt beside a pole
  TopAttitude<Scalar> attitude_;
};

template <Real Scalar>
ExactError<Scalar> LagrangeTop<Scalar>::error_by(Scalar rounded, Scalar t, Scalar uneven) const noexcept {
  t = std::abs(unit_ * t);
  const Scalar defect = defect_ + uneven, plain = defect * thin_, pull = swing_ * swing_ + torn_;
  const Scalar skew_shift = 4 * defect * (pull + fastest_ * fastest_) / h2_;  // an uneven body keeps no spin
  const Scalar off = standing_ ? pushed_off(defect * pull, growth_, t) : Scalar(0);
  // The spin changes by (I1 - I2) w1 w2/C and by the weight beside the axis, and the axis is moved to and fro; what a sphere is off has any axes.
  const Scalar turning = defect * ((sphere_ ? fastest_ * fastest_ : across_ * across_ / 2) + 2 * pull);
  const Scalar moving = plain * ((sphere_ ? fastest_ : across_) * fastest_ + pull);
  const Scalar nutation = std::min(t, unit_ * nutation_period());
  const auto up_to = [&](Scalar lasting, Scalar relative, Scalar shift, Scalar turned) noexcept {
    const Scalar late = time_error((rounded + relative) * share_, rounded * shift_ + shift, K_, lam_, t);
    // what is late carries the axis along, but not the spin
    const Scalar angle = (rounded > 0 ? set_up : Scalar(0)) + rounded * fastest_ * t + carried_ * late + turned + off;
    return ExactError<Scalar>::of(angle, unit_ * (across_ * angle + swing_ * (swing_ * late + off) +
                                                  rounded * fastest_ + (turning + moving) * lasting));
  };
  const ExactError<Scalar> always =
      up_to(t, defect, skew_shift, defect * t * (fastest_ + (fastest_ * fastest_ + torn_) * t));
  if (!(lasting_ < t)) return always;
  const Scalar spin = turning * lasting_;  // no more, but it has the axis out of time
  return always.least(up_to(lasting_, plain + 2 * thin_ * spin / carried_, skew_shift * (1 + lam_ * lasting_),
                            (plain * fastest_ + spin) * t + moving * lasting_ * nutation));
}

/// The roots of f(z) = x^2 + b z - a z^2 + kappa z^3, z = w - w0, around the start z = 0, and what hangs on them.
template <Real Scalar>
void LagrangeTop<Scalar>::roots(const TopStart<Scalar>& o, Scalar kappa) noexcept {
  const Scalar below0 = s_ > 0 ? o.below : o.above, above0 = s_ > 0 ? o.above : o.below, w0 = s_ * o.u;
  const Scalar x = o.swing;
  const Scalar b = -2 * w0 * o.square - kappa * o.ground + 2 * s_ * o.rho * o.d;
  const Scalar a = o.square - 2 * w0 * kappa + o.rho * o.rho;
  c_below_ = o.d + s_ * o.rho * below0;
  c_above_ = o.d - s_ * o.rho * above0;

  const Scalar root = std::sqrt(std::max(a * a - 4 * kappa * b, Scalar(0)));
  const bool still = x == 0 && b == 0;
  if (x == 0) {  // at a turning point: z (b - a z + kappa z^2)
    if (b < 0) z1_ = a > 0 ? 2 * b / (a + root) : (a - root) / (2 * kappa);
  } else {
    const auto f = [&](Scalar z) {
      return math::Slope<Scalar>{x * x + z * (b + z * (-a + kappa * z)), b + z * (-2 * a + 3 * kappa * z)};
    };
    // from the parabola, which the cubic lies above for z < 0
    const Scalar guess = a > 0 ? (b - std::sqrt(b * b + 4 * a * x * x)) / (2 * a) : -below0 / 2;
    z1_ = math::newton_root<Scalar>(f, -below0, 0, true, guess).value();
  }
  z1_ = std::max(z1_, -below0);
  above1_ = above0 - z1_;

  // w2 - 1 and w3 - 1: the roots of kappa t^2 - sum t - c^2/(1 - w1), from the cubic in t = w - 1
  const Scalar square = above1_ > 0 ? c_above_ * c_above_ / above1_ : Scalar(0);
  const Scalar sum = above1_ > 0 ? (2 * (o.square - kappa * above0 - s_ * o.rho * c_above_) - square) / above1_ : a;
  if (above1_ > 0) shift_ = (2 * (o.square + kappa * above0 + std::abs(o.rho * c_above_)) + square) / above1_;
  const Scalar spread = std::hypot(sum, 2 * std::sqrt(kappa * square));
  if (still) {
    above2_ = above0;
    h_plus_ = std::max(a - kappa * above0, Scalar(0));
  } else if (sum >= 0) {
    h_plus_ = (sum + spread) / 2;
    above2_ = h_plus_ > 0 ? square / h_plus_ : Scalar(0);
  } else {
    h_plus_ = 2 * kappa * square / (spread - sum);
    above2_ = (spread - sum) / (2 * kappa);
  }
  above2_ = std::min(above2_, above0);
  h_minus_ = h_plus_ + 2 * kappa;
  h0_ = h_plus_ + kappa * above0;
  if (x != 0) z2_ = z1_ < 0 ? x * x / (-z1_ * h0_) : above0;
  else if (b > 0) z2_ = b / h0_;
  z2_ = std::min(z2_, above0);
  if (still && w0 * w0 < 1) motion_ = AxisMotion::regular;
  if (still && o.ground == 0) motion_ = AxisMotion::sleeping;
  standing_ = still;
  growth_ = o.ground == 0 ? -a / 4 : -a;

  // A pole that is touched is kept away by less than rounding, with the c that belongs to this distance.
  below2_ = std::max(below0 + z2_, floor);
  below1_ = still ? below2_ : c_below_ * c_below_ / (below2_ * h_minus_);
  if (!(below1_ >= floor)) below1_ = floor;
  below1_ = std::min(below1_, below2_);
  above2_ = std::min(std::max(above2_, floor), std::max(above1_, floor));
  above1_ = std::max(above1_, above2_);
}

template <Real Scalar>
void LagrangeTop<Scalar>::build(const SymmetricTop<Scalar>& top, const TopStart<Scalar>& o) noexcept {
  unit_ = o.unit;
  s_ = top.weight > 0 ? -1 : 1;
  rho_ = o.rho;
  defect_ = top.asymmetry_error();
  sphere_ = top.sphere;
  torn_ = std::abs(top.field) / (unit_ * unit_);
  thin_ = std::min(Scalar(1), top.along / top.across);
  planar_ = o.planar();
  in_plane_ = o.planar(0);
  const Scalar kappa = std::abs(o.pull);
  roots(o, kappa);
  h1_ = h_plus_ + kappa * above1_;
  h2_ = h_plus_ + kappa * above2_;
  width_ = z2_ - z1_;
  lam_ = std::sqrt(h1_) / 2;
  const Scalar greatest = o.square - kappa * z1_;
  across_ = std::sqrt(greatest);
  carried_ = across_ + std::abs(o.rho);
  fastest_ = carried_ + std::abs(o.spin);
  swing_ = std::sqrt(kappa);
  share_ = h1_ > 0 ? (greatest + o.rho * o.rho + 4 * kappa) / h1_ : Scalar(0);
  if (share_ * rounding >= 1) lam_ = 0;  // at rest in a place it may leave
  if (h1_ > 0 && width_ > 0)
    modulus_ = {std::min(kappa * width_ / h1_, Scalar(1)), std::clamp(h2_ / h1_, modulus_floor, Scalar(1))};
  if (width_ > 0 && h2_ <= rounding * shift_) motion_ = AxisMotion::separatrix;
  // the vertical is known to rounding, and the tilt from it no better
  const Scalar tilt = std::sqrt(2 * (s_ > 0 ? o.above : o.below));
  shift_ = (shift_ + 2 * kappa * (tilt + stated + defect_)) / h2_;
  functions_ = math::JacobiAt<Scalar>(modulus_);
  K_ = functions_.quarter_period();
  if (width_ > 0) {
    const Scalar kp = std::sqrt(modulus_.kp2);
    const Scalar sn = std::sqrt(-z1_ / width_), cn = std::sqrt(z2_ / width_), dn = std::max(std::sqrt(h0_ / h1_), kp);
    const Scalar rising = s_ * o.swing < 0 ? -1 : 1;
    from_upper_ = cn < std::sqrt(kp) * sn;  // beyond K/2
    v0_ = rising *
          (from_upper_ ? math::jacobi_argument(-cn / dn, kp * sn / dn, kp / dn) : math::jacobi_argument(sn, cn, dn));
    plus_ = math::ThirdKind<Scalar>(modulus_, modulus_.kp2 * below1_ / below2_);
    minus_ = math::ThirdKind<Scalar>(modulus_, above2_ / above1_);
    plus_factor_ = width_ * modulus_.kp2 / (below2_ * lam_);
    minus_factor_ = width_ / (above1_ * lam_);
  }
  const auto consistent = [](Scalar c, Scalar square) { return std::copysign(std::sqrt(square), c); };
  if (motion_ == AxisMotion::nutation || motion_ == AxisMotion::separatrix) {
    c_below_ = consistent(c_below_, below1_ * below2_ * h_minus_);
    c_above_ = consistent(c_above_, above1_ * above2_ * h_plus_);
  }
  if (motion_ == AxisMotion::nutation || motion_ == AxisMotion::regular) {
    const auto [below, above] = phases_per_nutation();
    lasting_ =
        heavy::lasting(unit_ * nutation_period(), s_ * (below - above) + (o.spin - o.rho) * unit_ * nutation_period());
  }
  attitude_ = s_ > 0 ? TopAttitude<Scalar>(top, o, c_above_, c_below_, axis(0), fastest_)
                     : TopAttitude<Scalar>(top, o, c_below_, c_above_, axis(0), fastest_);
}

template <Real Scalar>
AxisPoint<Scalar> LagrangeTop<Scalar>::axis(Scalar t) const noexcept {
  const auto counted = math::JacobiTurn<Scalar>::of(functions_, v0_ + lam_ * t);
  const auto v = from_upper_ ? counted.plus_quarter(modulus_, K_) : counted;
  const auto from_above = from_upper_ ? counted : counted.minus_quarter(modulus_, K_);
  const Scalar s2 = v.sn * v.sn, c2 = v.cn * v.cn;
  const Scalar below = below1_ + width_ * s2, above = above2_ + width_ * c2;
  const Scalar rate = 2 * lam_ * width_ * v.sn * v.cn * v.dn;
  const Scalar behind = plus_factor_ == 0 ? Scalar(0) : plus_factor_ * plus_(from_above);
  const Scalar beside = minus_factor_ == 0 ? Scalar(0) : minus_factor_ * minus_(v);
  const Scalar phase_below = c_below_ / 2 * (t + behind) / below2_;
  const Scalar phase_above = c_above_ / 2 * (t + beside) / above1_;
  const Scalar w = below < above ? below - 1 : 1 - above;
  return s_ > 0 ? AxisPoint<Scalar>{w, rate, above, below, phase_above, phase_below}
                : AxisPoint<Scalar>{-w, -rate, below, above, phase_below, phase_above};
}

#ifdef GYROSTAT_COMPILED
extern template class LagrangeTop<double>;
#endif

}  // namespace gyrostat::heavy
