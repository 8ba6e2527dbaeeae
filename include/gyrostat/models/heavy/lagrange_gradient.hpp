// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/exact_error.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

namespace gyrostat::heavy {

namespace detail {

/// Roots of a_0 + a_1 y + ... + a_Degree y^Degree in (low, high), increasing; those that a sign change shows. Returns
/// their number.
template <int Degree, Real Scalar>
int roots_between(const Scalar* a, Scalar low, Scalar high, Scalar* roots) noexcept {
  const auto f = [&](Scalar y) {
    Scalar value = a[Degree], slope = 0;
    for (int k = Degree - 1; k >= 0; --k) {
      slope = slope * y + value;
      value = value * y + a[k];
    }
    return math::Slope<Scalar>{value, slope};
  };
  Scalar edge[Degree + 1] = {low};
  int n = 1;
  if constexpr (Degree > 1) {
    Scalar derivative[Degree];
    for (int k = 0; k < Degree; ++k) derivative[k] = Scalar(k + 1) * a[k + 1];
    n += roots_between<Degree - 1>(derivative, low, high, edge + 1);
  }
  int found = 0;
  Scalar left = low;
  bool above = f(low).f > 0;
  for (int i = 1; i <= n; ++i) {
    const Scalar right = i < n ? edge[i] : high;
    const bool next = f(right).f > 0;
    if (above != next) {
      const auto root = math::newton_root<Scalar>(f, left, right, next);
      roots[found++] = *root;
    }
    above = next;
    left = right;
  }
  return found;
}

/// The root of a polynomial that lies next to 0 on the way to `limit`, where it is not positive but for rounding;
/// positive at 0.
template <int Degree, Real Scalar>
Scalar nearest_root(const std::array<Scalar, Degree + 1>& a, Scalar limit) noexcept {
  const Scalar sign = limit < 0 ? -1 : 1;
  Scalar mirrored[Degree + 1], roots[Degree];
  Scalar power = 1;
  for (std::size_t k = 0; k <= Degree; ++k, power *= sign) mirrored[k] = power * a[k];
  return roots_between<Degree>(mirrored, Scalar(0), std::abs(limit), roots) > 0 ? sign * roots[0] : limit;
}

}  // namespace detail

/// The motion of a top in a gravity gradient: docs/heavy.md, section 7. With u = u_b + (u_o - u_b) sin^2(x/2) from a
/// turning point u_b to the other, u_o, time and the phases of TopAttitude are integrals of even periodic functions of
/// x,
///     dt = dx/sqrt h(u),   u'^2 = (u - u1)(u2 - u) h(u),
/// less a part with the poles u = +-1, which is an arc tangent. They are kept as Fourier series; time is inverted by
/// Newton's method.
template <Real Scalar>
class LagrangeGradient {
 public:
  static constexpr int harmonics = 256;

  LagrangeGradient() = default;

  /// As LagrangeTop::make, for any gradient, zero too.
  static Result<LagrangeGradient> make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    const auto top = SymmetricTop<Scalar>::of(problem);
    if (!top) return top.error();
    const auto from = aligned(start);
    if (!from) return from.error();
    LagrangeGradient made;
    made.build(*top, TopStart<Scalar>(*top, *from));
    return made;
  }

  State<Scalar> at(Scalar t) const noexcept { return attitude_.at(unit_ * t, axis(unit_ * t)); }

  /// See LagrangeTop.
  ExactError<Scalar> error(Scalar t, Scalar uneven = 0) const noexcept { return error_by(stated, t, uneven); }
  ExactError<Scalar> uneven_error(Scalar t, Scalar uneven) const noexcept { return error_by(0, t, uneven); }
  Scalar lasting() const noexcept { return lasting_ / unit_; }  ///< see LagrangeTop

  Scalar least() const noexcept { return u_b_ < u_o_ ? u_b_ : u_o_; }  ///< down along the axis of symmetry
  Scalar greatest() const noexcept { return u_b_ < u_o_ ? u_o_ : u_b_; }
  /// Of the nutation, s; of small nutation where there is none; infinite or NaN where it is not stable.
  Scalar nutation_period() const noexcept { return period_ / unit_; }
  bool planar() const noexcept { return planar_; }      ///< see LagrangeTop
  Scalar defect() const noexcept { return defect_; }    ///< see LagrangeTop
  bool in_plane() const noexcept { return in_plane_; }  ///< see LagrangeTop
  /// Right-handed about DOWN, rad; see LagrangeTop.
  Scalar precession_per_nutation() const noexcept {
    if (planar_) return 0;
    if (still_) return mean_precession() * nutation_period();
    const auto [above, below] = phases_per_nutation();
    return above + below;
  }
  /// Their signs tell on which side the axis passes the upper and the lower pole: what is left of momenta that cancel there, over their size.
  std::array<Scalar, 2> sides() const noexcept { return {c_above_ / fastest_, c_below_ / fastest_}; }
  Scalar mean_precession() const noexcept {  ///< rad/s
    if (still_ && !planar_) return unit_ * (c_above_ / above_b_ + c_below_ / below_b_) / 2;
    return unit_ * precession_per_nutation() / period_;
  }
  /// Greatest part of the series that is left out, relative.
  Scalar truncation() const noexcept { return tail_; }
  /// Whether the period and the mean precession are right to some thousand roundings: not beside a separatrix, where more harmonics are needed than there are.
  bool resolves_period() const noexcept { return tail_ <= 4096 * epsilon<Scalar>; }

 private:
  static constexpr Scalar rounding = 64 * epsilon<Scalar>, stated = 4 * epsilon<Scalar>;
  static constexpr Scalar floor = epsilon<Scalar> * epsilon<Scalar> * epsilon<Scalar>;
  using Three = std::array<Scalar, 3>;  // of time and of the phases above and below

  /// What the phases of TopAttitude gain in one nutation, rad, of the poles u = 1 and u = -1.
  std::array<Scalar, 2> phases_per_nutation() const noexcept {
    if (still_) return {c_above_ / above_b_ / 2 * period_, c_below_ / below_b_ / 2 * period_};
    return {pi<Scalar> * (side_above_ + 2 * mean_[1]), pi<Scalar> * (side_below_ + 2 * mean_[2])};
  }
  ExactError<Scalar> error_by(Scalar rounded, Scalar t, Scalar uneven) const noexcept;
  void build(const SymmetricTop<Scalar>& top, const TopStart<Scalar>& o) noexcept;
  std::array<Scalar, 2> turning_points(Scalar x, Scalar b, Scalar a, Scalar k, Scalar gradient) const noexcept;
  static Scalar greatest_speed(const TopStart<Scalar>& o, Scalar pull, Scalar y1, Scalar y2) noexcept;
  Scalar off_pole(Scalar c, Scalar reach, Scalar near, Scalar far, Scalar& at_near, Scalar& at_far,
                  Scalar& root) noexcept;
  void expand() noexcept;
  AxisPoint<Scalar> axis(Scalar t) const noexcept;

  Scalar h(Scalar y) const noexcept { return h0_ + y * (h_y_ + y * h_yy_); }
  /// The integrands at sin^2(x/2), without the parts with poles.
  Three integrands(Scalar sine2) const noexcept {
    const Scalar y = y_b_ + width_ * sine2, root = std::sqrt(std::max(h(y), Scalar(0)));
    const Scalar slope_above = h_y_ + h_yy_ * (y + to_above_), slope_below = h_y_ + h_yy_ * (y + to_below_);
    return {1 / root, weight_above_ * slope_above / (root * (root + root_above_)),
            -weight_below_ * slope_below / (root * (root + root_below_))};
  }
  /// Odd periodic parts of the integrals.
  Three periodic(Scalar x) const noexcept {
    const Scalar twice = 2 * std::cos(x), s = std::sin(x);
    Three b1{}, b2{};
    for (int k = used_; k >= 1; --k)
      for (std::size_t i = 0; i < 3; ++i) {
        const Scalar b = series_[static_cast<std::size_t>(k)][i] + twice * b1[i] - b2[i];
        b2[i] = b1[i];
        b1[i] = b;
      }
    return {s * b1[0], s * b1[1], s * b1[2]};
  }

  Scalar unit_ = 1;                     // of rate, rad/s; all that follows is in it
  Scalar h0_ = 1, h_y_ = 0, h_yy_ = 0;  // h by y = u - u0
  Scalar y_b_ = 0, width_ = 0;          // u_b - u0, u_o - u_b
  Scalar u_b_ = 0, u_o_ = 0;
  Scalar above_b_ = 1, above_o_ = 1, below_b_ = 1, below_o_ = 1;  // 1 - u, 1 + u at the turning points
  Scalar to_above_ = 0, to_below_ = 0;                            // 1 - u0, -1 - u0
  Scalar c_above_ = 0, c_below_ = 0, side_above_ = 1, side_below_ = 1;
  Scalar weight_above_ = 0, weight_below_ = 0, root_above_ = 0, root_below_ = 0;
  Scalar period_ = 0, start_ = 0;  // time of the start from u_b
  Three mean_{};
  std::array<Three, harmonics + 1> series_{};
  int used_ = 0;
  bool still_ = false, planar_ = false, in_plane_ = false;
  Scalar tail_ = 0, most_ = 1, least_ = 1, size_ = 1, pole_ = 0, fastest_ = 0, across_ = 0, swing_ = 0, defect_ = 0;
  Scalar carried_ = 0, thin_ = 1;                   // see LagrangeTop
  Scalar lasting_ = infinity<Scalar>, growth_ = 0;  // see LagrangeTop
  Scalar gradient_ = 0;                             // of itself; it turns an uneven body about its axis
  Scalar parts_ = 0;                                // of the gradient, which may cancel: C and A are rounded
  TopAttitude<Scalar> attitude_;
};

template <Real Scalar>
ExactError<Scalar> LagrangeGradient<Scalar>::error_by(Scalar rounded, Scalar t, Scalar uneven) const noexcept {
  t = std::abs(unit_ * t);
  const Scalar rate = std::sqrt(most_) / 2, K = rate * period_ / 2;
  const Scalar share = (size_ + parts_) / (still_ ? h0_ : least_);
  const Scalar defect = defect_ + uneven, pull = swing_ * swing_ + gradient_;
  const Scalar fast = fastest_ + std::sqrt(std::abs(most_));
  const Scalar off = still_ ? pushed_off(defect * (swing_ * swing_ + parts_), growth_, t) : Scalar(0);
  const Scalar left_out = rounded > 0 ? 64 * tail_ * (t + period_) : Scalar(0);
  // see LagrangeTop
  const Scalar plain = defect * thin_, turning = defect * (across_ * across_ / 2 + 2 * pull);
  const Scalar moving = plain * (across_ * fastest_ + pull);
  const auto up_to = [&](Scalar lasting, Scalar more, Scalar turned) noexcept {
    const Scalar relative = (rounded + more) * share;
    // a steady precession is not late, but what moves it turns it at another rate; where it is unstable, off tells more
    const Scalar moved = h0_ > 0 ? more * share * t : Scalar(0);
    const Scalar late = still_ ? moved : time_error(relative, relative, K, rate, t) + left_out;
    const Scalar angle = rounded * (1 + (still_ ? Scalar(0) : pole_)) * (1 + fast * t) + carried_ * late + turned + off;
    return ExactError<Scalar>::of(angle, unit_ * (across_ * angle + swing_ * (swing_ * late + off) +
                                                  rounded * (fastest_ + parts_ * t) + (turning + moving) * lasting));
  };
  const ExactError<Scalar> always = up_to(t, defect, defect * t * (fastest_ + (fastest_ * fastest_ + gradient_) * t));
  if (!(lasting_ < t)) return always;
  const Scalar spin = turning * lasting_;
  return always.least(up_to(lasting_, plain + 2 * thin_ * spin / carried_,
                            (plain * fastest_ + spin) * t + moving * lasting_ * std::min(t, period_)));
}

/// {y1, y2}: where x^2 + b y - a y^2 - k y^3 + gradient y^4 has its roots next to the start, on either side.
template <Real Scalar>
std::array<Scalar, 2> LagrangeGradient<Scalar>::turning_points(Scalar x, Scalar b, Scalar a, Scalar k,
                                                               Scalar gradient) const noexcept {
  if (x != 0) {
    const std::array<Scalar, 5> f{x * x, b, -a, -k, gradient};
    return {detail::nearest_root<4>(f, to_below_), detail::nearest_root<4>(f, to_above_)};
  }
  if (b > 0) return {0, detail::nearest_root<3>({b, -a, -k, gradient}, to_above_)};
  if (b < 0) return {detail::nearest_root<3>({-b, a, k, -gradient}, to_below_), 0};
  return {0, 0};
}

/// Greatest v = sqrt(square + pull y - gradient y^2) of the axis between y1 and y2.
template <Real Scalar>
Scalar LagrangeGradient<Scalar>::greatest_speed(const TopStart<Scalar>& o, Scalar pull, Scalar y1, Scalar y2) noexcept {
  Scalar greatest = o.square;
  for (const Scalar y : {y1, y2}) greatest = std::max(greatest, o.square + y * (pull - o.gradient * y));
  if (o.gradient != 0) {
    const Scalar y = pull / (2 * o.gradient);
    if (y > y1 && y < y2) greatest = std::max(greatest, o.square + y * (pull - o.gradient * y));
  }
  return std::sqrt(std::max(greatest, Scalar(0)));
}

/// The distances of the turning points from a pole, `reach` away, and the c that belongs to them: a pole that is touched is kept away by less than
/// rounding.
template <Real Scalar>
Scalar LagrangeGradient<Scalar>::off_pole(Scalar c, Scalar reach, Scalar near, Scalar far, Scalar& at_near,
                                          Scalar& at_far, Scalar& root) noexcept {
  const Scalar there = h(reach);
  at_far = std::max(far, floor);
  const bool by_h = !still_ && there > size_ * near;  // the smaller relative error
  at_near = std::min(std::max(by_h ? c * c / (at_far * there) : near, floor), at_far);
  if (by_h) c = std::copysign(std::sqrt(at_near * at_far * there), c);
  root = std::abs(c) / std::sqrt(at_near * at_far);
  pole_ = std::max(pole_, std::sqrt(at_near) * (by_h ? size_ / there : 1 / at_near));
  return c;
}

template <Real Scalar>
void LagrangeGradient<Scalar>::build(const SymmetricTop<Scalar>& top, const TopStart<Scalar>& o) noexcept {
  unit_ = o.unit;
  defect_ = top.asymmetry_error();
  thin_ = std::min(Scalar(1), top.along / top.across);
  planar_ = o.planar();
  in_plane_ = o.planar(0);
  const Scalar u = o.u, x = o.swing;
  const Scalar pull = o.pull - 2 * o.gradient * u;  // slope of v^2
  const Scalar b = -2 * u * o.square + pull * o.ground + 2 * o.rho * o.d;
  const Scalar a = o.nutation_square();
  const Scalar k = pull - 2 * u * o.gradient;
  to_above_ = o.above;
  to_below_ = -o.below;
  c_above_ = o.d - o.rho * o.above;
  c_below_ = o.d + o.rho * o.below;
  size_ = o.square + o.rho * o.rho + 2 * std::abs(o.pull) + 4 * std::abs(o.gradient);
  gradient_ = std::abs(top.gradient) / (o.unit * o.unit);
  parts_ = 4 * gradient_ * (top.along + top.across) / top.across;
  swing_ = std::sqrt(std::abs(o.pull) + std::abs(o.gradient));

  still_ = x == 0 && b == 0;
  const auto [y1, y2] = turning_points(x, b, a, k, o.gradient);
  h_yy_ = -o.gradient;
  h_y_ = k + (y1 + y2) * h_yy_;
  h0_ = a + (y1 + y2) * h_y_ - y1 * y2 * h_yy_;

  // of the two turning points
  Scalar above1 = 1, above2 = 1, below1 = 1, below2 = 1;
  c_below_ = off_pole(c_below_, to_below_, o.below + y1, o.below + y2, below1, below2, root_below_);
  c_above_ = off_pole(c_above_, to_above_, o.above - y2, o.above - y1, above2, above1, root_above_);
  side_above_ = c_above_ < 0 ? -1 : 1;
  side_below_ = c_below_ < 0 ? -1 : 1;
  weight_above_ = side_above_ * std::sqrt(above1 * above2) / 2;
  weight_below_ = side_below_ * std::sqrt(below1 * below2) / 2;

  const bool lower = -y1 <= y2;
  y_b_ = lower ? y1 : y2;
  width_ = lower ? y2 - y1 : y1 - y2;
  above_b_ = lower ? above1 : above2;
  above_o_ = lower ? above2 : above1;
  below_b_ = lower ? below1 : below2;
  below_o_ = lower ? below2 : below1;
  u_b_ = below_b_ < above_b_ ? below_b_ - 1 : 1 - above_b_;
  u_o_ = below_o_ < above_o_ ? below_o_ - 1 : 1 - above_o_;

  across_ = greatest_speed(o, pull, y1, y2);
  carried_ = across_ + std::abs(o.rho);
  fastest_ = carried_ + std::abs(o.spin);
  growth_ = o.ground == 0 ? -h0_ / 4 : -h0_;
  if (still_) {
    period_ = 2 * pi<Scalar> / std::sqrt(h0_);
  } else {
    expand();
    const Scalar y_o = lower ? y2 : y1;
    const Scalar up = x * width_ < 0 ? -1 : 1;
    const Scalar at = 2 * up * std::atan2(std::sqrt(std::abs(y_b_)), std::sqrt(std::abs(y_o)));
    start_ = mean_[0] * at + periodic(at)[0];
  }
  const auto [above, below] = phases_per_nutation();
  lasting_ = heavy::lasting(period_, below - above + (o.spin - o.rho) * period_);
  attitude_ = TopAttitude<Scalar>(top, o, c_above_, c_below_, axis(0), fastest_);
}

template <Real Scalar>
void LagrangeGradient<Scalar>::expand() noexcept {
  std::array<Three, harmonics + 1> value;
  std::array<Scalar, 2 * harmonics> cosine;
  for (int n = 16; n <= harmonics; n *= 2) {
    const auto size = static_cast<std::size_t>(n);
    for (std::size_t j = 0; j < 2 * size; ++j) cosine[j] = std::cos(pi<Scalar> * Scalar(j) / Scalar(n));
    most_ = 0;
    least_ = infinity<Scalar>;
    for (std::size_t j = 0; j <= size; ++j) {
      const Scalar half = std::sin(pi<Scalar> * Scalar(j) / Scalar(2 * n));
      value[j] = integrands(half * half);
      const Scalar here = 1 / (value[j][0] * value[j][0]);
      most_ = std::max(most_, here);
      least_ = std::min(least_, here);
      if (j == 0 || j == size)
        for (Scalar& v : value[j]) v /= 2;
    }
    Scalar sum = 0, rest = 0;
    for (std::size_t k = 0; k <= size; ++k) {
      Three c{};
      for (std::size_t j = 0; j <= size; ++j)
        for (std::size_t i = 0; i < 3; ++i) c[i] += value[j][i] * cosine[j * k % (2 * size)];
      for (std::size_t i = 0; i < 3; ++i) {
        c[i] *= Scalar(2) / Scalar(n);
        if (k == 0) mean_[i] = c[i] / 2;
        else series_[k][i] = c[i] / Scalar(k);
        (4 * k > 3 * size ? rest : sum) += std::abs(c[i]);
      }
    }
    used_ = n - 1;
    tail_ = rest / sum;
    if (!(tail_ > 4 * epsilon<Scalar>)) break;
  }
  period_ = 2 * pi<Scalar> * mean_[0];
}

template <Real Scalar>
AxisPoint<Scalar> LagrangeGradient<Scalar>::axis(Scalar t) const noexcept {
  if (still_) return {u_b_, 0, above_b_, below_b_, c_above_ / 2 * t / above_b_, c_below_ / 2 * t / below_b_};
  const Scalar time = start_ + t;
  const Scalar turns = std::nearbyint(time / period_), rest = std::fma(-turns, period_, time);
  const auto late = [&](Scalar x) {
    const Scalar half = std::sin(x / 2);
    return math::Slope<Scalar>{mean_[0] * x + periodic(x)[0] - rest, integrands(half * half)[0]};
  };
  constexpr Scalar end = pi<Scalar>;
  const auto found = math::newton_root<Scalar>(late, -end, end, true, rest / mean_[0]);
  const Scalar x = found ? *found : rest / mean_[0], sine = std::sin(x / 2), cosine = std::cos(x / 2), s2 = sine * sine,
               c2 = cosine * cosine;
  const Three part = periodic(x);
  const Scalar above = above_b_ * c2 + above_o_ * s2, below = below_b_ * c2 + below_o_ * s2;
  const Scalar rate = width_ * sine * cosine / integrands(s2)[0];
  const auto phase = [&](Scalar side, Scalar at_b, Scalar at_o, std::size_t i) {
    const Scalar angle = std::atan2(std::sqrt(at_o) * sine, std::sqrt(at_b) * cosine) + pi<Scalar> * turns;
    return side * angle + mean_[i] * (x + 2 * pi<Scalar> * turns) + part[i];
  };
  return {below < above ? below - 1 : 1 - above,    rate, above, below, phase(side_above_, above_b_, above_o_, 1),
          phase(side_below_, below_b_, below_o_, 2)};
}

#ifdef GYROSTAT_COMPILED
extern template class LagrangeGradient<double>;
#endif

}  // namespace gyrostat::heavy
