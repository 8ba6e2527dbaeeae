// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The Volterra quartic as a secular equation (docs/deceleration.md, section 4.1). On the level |M| = R, eta = (h - S0/2)/R
///     c(sigma) = R^2 sigma - 2 R eta - sum g_i^2/(a_i - sigma) = 0,   a ascending,
/// has the eigenvector (g_i/(a_i - sigma), R), spacelike where c' < 0 and timelike where c' > 0. A zero of c' is a
/// relative equilibrium: omega = sigma M, M = g/(a - sigma).
namespace gyrostat::inline GYROSTAT_LEVEL {

/// A place sigma = a[origin] + offset. The distance to the nearest pole is what the eigenvector needs to full relative
/// accuracy, so it is never formed as a difference.
template <Real Scalar>
struct SecularPoint {
  int origin = 0;
  Scalar offset = 0;
};

/// Where c increases between two neighbouring poles: from `lo` to `hi` the level has two components.
template <Real Scalar>
struct SecularRise {
  bool exists = false;
  SecularPoint<Scalar> lo, hi;
};

/// c and its derivatives at one R. A pole whose weight g_i is below the rounding of the others is dropped (g_i = 0: the
/// axis e_i is then an eigenvector by itself); two poles closer than rounding are one.
template <Real Scalar>
class Secular {
 public:
  using Point = SecularPoint<Scalar>;

  Secular() = default;

  /// @param a ascending inverse moments, 1/(kg m^2); @param g = a l, rad/s; @param R = |M| > 0, N m s
  Secular(const Vec3<Scalar>& a, const Vec3<Scalar>& g, Scalar R) noexcept : a_(a), g_(g), R_(R) {
    using std::abs;
    const Scalar scale = std::max(g_.cwiseAbs().maxCoeff(), R * a_.cwiseAbs().maxCoeff());
    const Scalar floor = epsilon<Scalar> * scale;
    for (int i = 0; i < 2; ++i)
      if (a_[i + 1] - a_[i] <= 4 * epsilon<Scalar> * a_[2]) merge(i);
    for (int i = 0; i < 3; ++i) {
      if (abs(g_[i]) <= floor) g_[i] = 0;
      g2_[i] = g_[i] * g_[i];
      for (int j = 0; j < 3; ++j) gap_[i][j] = a_[j] - a_[i];
    }
  }

  /// The same with gaps[i][j] = a_j - a_i given, which may have digits that a has not. No poles are merged, and only weights are
  /// dropped whose squares would underflow.
  Secular(const Vec3<Scalar>& a, const Mat3<Scalar>& gaps, const Vec3<Scalar>& g, Scalar R) noexcept
      : a_(a), g_(g), R_(R) {
    using std::abs, std::sqrt;
    const Scalar floor = sqrt(std::numeric_limits<Scalar>::min()) * std::max(Scalar(1), R * a_[2]);
    for (int i = 0; i < 3; ++i) {
      if (abs(g_[i]) <= floor) g_[i] = 0;
      g2_[i] = g_[i] * g_[i];
      for (int j = 0; j < 3; ++j) gap_[i][j] = gaps(i, j);
    }
  }

  /// The same level with a, g and eta of the opposite sign and the axes in reverse order: it exchanges the components
  /// around the largest moment with those around the smallest. Eigenvectors keep their components.
  Secular mirrored() const noexcept {
    Secular m;
    m.R_ = R_;
    for (int i = 0; i < 3; ++i) {
      m.a_[i] = -a_[2 - i];
      m.g_[i] = -g_[2 - i];
      m.g2_[i] = g2_[2 - i];
      for (int j = 0; j < 3; ++j) m.gap_[i][j] = gap_[2 - j][2 - i];
    }
    m.merged_ = merged_ < 0 ? -1 : 1 - merged_;
    m.cos_ = cos_;
    m.sin_ = -sin_;
    return m;
  }

  Scalar radius() const noexcept { return R_; }
  Scalar a(int i) const noexcept { return a_[i]; }
  Scalar g(int i) const noexcept { return g_[i]; }
  bool active(int i) const noexcept { return g_[i] != 0; }

  /// sigma(q) - sigma(p).
  Scalar difference(const Point& p, const Point& q) const noexcept {
    return gap_[p.origin][q.origin] + (q.offset - p.offset);
  }
  Scalar sigma(const Point& p) const noexcept { return a_[p.origin] + p.offset; }
  /// a_i - sigma.
  Scalar distance(const Point& p, int i) const noexcept { return gap_[p.origin][i] - p.offset; }

  /// g_i/(a_i - sigma), N m s; 0 for a dropped pole.
  Vec3<Scalar> vertex(const Point& p) const noexcept {
    Vec3<Scalar> v;
    for (int i = 0; i < 3; ++i) v[i] = active(i) ? g_[i] / distance(p, i) : Scalar(0);
    return v;
  }

  /// c at p.
  Scalar value(const Point& p, Scalar eta) const noexcept {
    Scalar sum = R_ * (R_ * a_[p.origin] - 2 * eta) + R_ * R_ * p.offset;
    for (int i = 0; i < 3; ++i)
      if (active(i)) sum -= g2_[i] / distance(p, i);
    return sum;
  }

  /// eta of the level on which p is a root.
  Scalar level(const Point& p) const noexcept { return value(p, Scalar(0)) / (2 * R_); }

  /// The zero of c' next to a[origin] on the side `direction` (+1, -1), at most `reach` away; false where c' < 0 there
  /// throughout. 1/|vertex| is concave between poles, so Newton's steps on it approach from the pole without overshoot.
  bool turning_point(int origin, int direction, Scalar reach, Point& found) const noexcept {
    using std::abs, std::sqrt;
    Scalar pole = 0;
    for (int i = 0; i < 3; ++i)
      if (gap_[origin][i] == 0) pole = std::max(pole, abs(g_[i]));
    found = {origin, Scalar(direction) * pole / R_};
    if constexpr (!native) {  // from the turning point as a double knows it, on the pole's side of it
      SecularPoint<double> rough;
      if (narrow().turning_point(origin, direction, double(reach), rough) && rough.offset != 0) {
        const Scalar near = Scalar(rough.offset) * (1 - 1e-9);
        if (Scalar(direction) * (near - found.offset) > 0 && excess_at({origin, near}) > 0) found.offset = near;
      }
    }
    for (int trip = 0; trip < 80; ++trip) {
      if (abs(found.offset) > reach) return false;
      Scalar second = 0, third = 0;
      for (int i = 0; i < 3; ++i)
        if (active(i)) {
          const Scalar inverse = 1 / distance(found, i), square = g2_[i] * inverse * inverse;
          second += square;
          third += square * inverse;
        }
      const Scalar excess = sqrt(second) / R_ - 1;
      if (found.offset == 0 && excess <= 0) return true;
      if (!(Scalar(direction) * third < 0)) return abs(excess) <= 8 * epsilon<Scalar>;
      const Scalar step = -second * excess / third;
      if (Scalar(direction) * step <= epsilon<Scalar> * abs(found.offset)) return true;
      found.offset += step;
      if (abs(step) <= sqrt(epsilon<Scalar>) * abs(found.offset)) return abs(found.offset) <= reach;
    }
    return false;
  }

  /// The rise between a[i] and a[i + 1], cut at these two.
  SecularRise<Scalar> rise(int i) const noexcept {
    SecularRise<Scalar> r;
    const Scalar width = gap_[i][i + 1];
    r.exists = width > 0 && turning_point(i, 1, width, r.lo) && turning_point(i + 1, -1, width, r.hi) &&
               difference(r.lo, r.hi) >= 0;
    return r;
  }

  /// The root with c' > 0 in a rise that brackets it.
  Result<Point> rising_root(int i, const SecularRise<Scalar>& r, Scalar eta) const noexcept {
    const int origin = nearer(i, i + 1, r.lo, r.hi, eta, 1);
    Scalar lo = gap_[origin][r.lo.origin] + r.lo.offset, hi = gap_[origin][r.hi.origin] + r.hi.offset;
    if (origin == i) hi = std::min(hi, gap_[i][i + 1] / 2 * (1 + epsilon<Scalar>));
    else lo = std::max(lo, -gap_[i][i + 1] / 2 * (1 + epsilon<Scalar>));
    if (!(lo < hi)) return Point{origin, lo};
    return solve(origin, lo, hi, eta, 1);
  }

  /// The root with c' < 0 between p and q inside [a_i, a_j], where c changes sign from + to - and at most one of p, q is
  /// missing: offset 0 at an active pole stands for the pole's infinity.
  Result<Point> falling_root(int i, int j, const Point& p, const Point& q, Scalar eta) const noexcept {
    const int origin = nearer(i, j, p, q, eta, -1);
    Scalar lo = gap_[origin][p.origin] + p.offset, hi = gap_[origin][q.origin] + q.offset;
    const Scalar half = gap_[i][j] / 2 * (1 + epsilon<Scalar>);
    if (origin == i) hi = std::min(hi, half);
    else lo = std::max(lo, -half);
    if (!(lo < hi)) return Point{origin, origin == i ? hi : lo};
    return solve(origin, lo, hi, eta, -1);
  }

  /// Turns a vector from the axes in which poles were merged back to the principal axes.
  Vec3<Scalar> to_principal(const Vec3<Scalar>& x) const noexcept {
    if (merged_ < 0) return x;
    Vec3<Scalar> y = x;
    y[merged_] = cos_ * x[merged_] - sin_ * x[merged_ + 1];
    y[merged_ + 1] = sin_ * x[merged_] + cos_ * x[merged_ + 1];
    return y;
  }

 private:
  template <Real Other>
  friend class Secular;

  /// A class of numbers takes many times longer than a processor's own, and rounds its operations less well.
  static constexpr bool native = std::floating_point<Scalar>;

  /// The same equation in double, of which a place to begin at is taken.
  Secular<double> narrow() const noexcept {
    Secular<double> made;
    made.R_ = double(R_);
    for (int i = 0; i < 3; ++i) {
      made.a_[i] = double(a_[i]), made.g_[i] = double(g_[i]), made.g2_[i] = double(g2_[i]);
      for (int j = 0; j < 3; ++j) made.gap_[i][j] = double(gap_[i][j]);
    }
    return made;
  }

  /// |vertex|/R - 1.
  Scalar excess_at(const Point& p) const noexcept {
    Scalar second = 0;
    for (int i = 0; i < 3; ++i)
      if (active(i)) {
        const Scalar x = g_[i] / distance(p, i);
        second += x * x;
      }
    using std::sqrt;
    return sqrt(second) / R_ - 1;
  }

  /// a_i and a_{i+1} agree to rounding: the axes are turned so that e_i carries the whole weight.
  void merge(int i) noexcept {
    using std::hypot;
    const Scalar weight = hypot(g_[i], g_[i + 1]);
    a_[i] = a_[i + 1] = (a_[i] + a_[i + 1]) / 2;
    if (weight == 0 || g_[i + 1] == 0) return;
    merged_ = i;
    cos_ = g_[i] / weight;
    sin_ = g_[i + 1] / weight;
    g_[i] = weight;
    g_[i + 1] = 0;
  }

  /// Which end of [a_i, a_j] is the nearer to the root between p and q; `slope` is the sign of c' there.
  int nearer(int i, int j, const Point& p, const Point& q, Scalar eta, int slope) const noexcept {
    const Point middle{i, gap_[i][j] / 2};
    if (difference(q, middle) >= 0) return i;
    if (difference(middle, p) >= 0) return j;
    return Scalar(slope) * value(middle, eta) >= 0 ? i : j;
  }

  /// Root of c between two offsets. c = g_o^2/offset + rest: the pole is kept and only the rest made linear, so the steps
  /// do not stall at the pole; a step out of the bracket becomes a bisection.
  Result<Point> solve(int origin, Scalar lo, Scalar hi, Scalar eta, int slope) const noexcept {
    using std::abs, std::copysign, std::isfinite, std::sqrt;
    const Scalar side = lo + hi > 0 ? Scalar(1) : Scalar(-1);
    const Scalar constant = R_ * (R_ * a_[origin] - 2 * eta);
    const Scalar parts = R_ * (abs(R_ * a_[origin]) + abs(2 * eta));  // whose rounding `constant` has
    const Scalar weight = g2_[origin];
    Scalar x = (lo + hi) / 2;
    if (slope > 0) {
      // c is close to a cubic that is level at both ends of a rise
      const Scalar clo = value({origin, lo}, eta), chi = value({origin, hi}, eta);
      if (clo >= 0) return Point{origin, lo};
      if (chi <= 0) return Point{origin, hi};
      const Scalar y = -clo / (chi - clo);
      if (y > 0 && y < 1)
        x = lo + (hi - lo) * (Scalar(.5) - Scalar(std::sin(std::asin(static_cast<double>(1 - 2 * y)) / 3)));
    }
    if constexpr (!native) {  // from the root as a double knows it
      const auto rough = narrow().solve(origin, double(lo), double(hi), double(eta), slope);
      if (rough && lo < rough->offset && rough->offset < hi) x = rough->offset;
    }
    constexpr int trips = native ? 100 : 300;
    const Scalar noise = (native ? 4 : 32) * epsilon<Scalar>;
    for (int trip = 0; trip < trips; ++trip) {
      Scalar rest = constant + R_ * R_ * x, steep = R_ * R_, size = parts + abs(R_ * R_ * x);
      for (int i = 0; i < 3; ++i)
        if (i != origin && active(i)) {
          const Scalar inverse = 1 / (gap_[origin][i] - x), term = g2_[i] * inverse;
          rest -= term;
          steep -= term * inverse;
          size += abs(term);
        }
      const Scalar f = rest + (weight > 0 ? weight / x : Scalar(0));
      // late trips stop at the rounding of c
      if (f == 0 || (trip > 12 && abs(f) <= noise * size)) return Point{origin, x};
      if ((f > 0) == (slope > 0)) hi = x;
      else lo = x;
      Scalar next;
      if (slope < 0 && weight > 0) {
        const Scalar beta = rest - steep * x;
        const Scalar root = sqrt(std::max(Scalar(0), beta * beta - 4 * steep * weight));
        const Scalar q = -(beta + copysign(root, beta)) / 2;
        next = weight / q;
        if (!(next * side > 0)) next = q / steep;
      } else {
        next = x - f / (steep - (weight > 0 ? weight / (x * x) : Scalar(0)));
      }
      // x is an end of the bracket now, and a step that is all rounding may leave it
      if (abs(next - x) <= 2 * epsilon<Scalar> * abs(next)) return Point{origin, next};
      // c may have a hump in the bracket that throws the steps to and fro: beyond ten trips every other one halves it
      if (!(next > lo && next < hi) || (trip > 10 && trip % 2 == 0)) {
        // both ends on one side of the pole: halving the logarithm where they are far apart
        const Scalar small = std::min(abs(lo), abs(hi)), large = std::max(abs(lo), abs(hi));
        next = small > 0 && large > 16 * small ? side * sqrt(small * large) : (lo + hi) / 2;
        if (!(next > lo && next < hi)) return Point{origin, x};
      }
      x = next;
      if (!isfinite(x)) return Errc::not_finite;
    }
    return Errc::no_convergence;
  }

  Vec3<Scalar> a_{0, 0, 0}, g_{0, 0, 0}, g2_{0, 0, 0};
  Scalar gap_[3][3] = {};
  Scalar R_ = 0;
  int merged_ = -1;
  Scalar cos_ = 1, sin_ = 0;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
