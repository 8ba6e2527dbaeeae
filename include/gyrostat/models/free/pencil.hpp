// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>

#include "gyrostat/body/secular.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The momentum of a free gyrostat as a curve of null vectors (Zhukovskii 1885, Volterra 1899): M = J omega + l, |M| = R. In
/// homogeneous coordinates X = (Z, 1), Z = M/R - d, the sphere of momentum and the ellipsoid of energy are two quadrics
///     S(X, X) = 0,   E(X, X) = 0,
/// and what follows (roots, frame, theta functions) is read off their pencil E - sigma S. Momenta are divided by R, so that sigma is an
/// inverse moment, 1/(kg m^2).
namespace gyrostat::free {

template <Real Scalar>
using Vec4 = Eigen::Matrix<Scalar, 4, 1>;

/// A spacelike eigenvector of the pencil, S(x, x) = 1. `exact`: a principal axis without rotor momentum, which is one by itself.
template <Real Scalar>
struct PencilAxis {
  SecularPoint<Scalar> place;
  Vec4<Scalar> x = Vec4<Scalar>::Zero();
  bool exact = false;
};

/// The spacelike eigenvectors in the order of their roots: three where the roots show that the level has two components (the fourth
/// eigenvector is then timelike), else the two that remain real beside a complex pair.
template <Real Scalar>
struct PencilAxes {
  int count = 0;
  PencilAxis<Scalar> axis[3];
  bool lobe_lowest =
      true;          ///< of three: the motion surrounds the axis with the lowest root, else that with the highest
  Scalar share = 0;  ///< of three: 0 where the lobe is born or ends as a point, 1 on the separatrix
};

/// The two quadrics, in principal axes. `shifted`: d = l/R, so that Z = J omega/R keeps the relative accuracy of omega where the
/// rotors carry most of the momentum; else d = 0, which is regular as R -> 0.
template <Real Scalar>
class Pencil {
 public:
  Pencil() = default;

  /// @param a ascending inverse moments, 1/(kg m^2); @param gaps a_j - a_i, from differences of the moments; @param G = J omega,
  /// @param l rotor momentum, @param M their sum, N m s; @param R = |M| > 0
  Pencil(const Vec3<Scalar>& a, const Mat3<Scalar>& gaps, const Vec3<Scalar>& G, const Vec3<Scalar>& l,
         const Vec3<Scalar>& M, Scalar R) noexcept
      : a_(a), gaps_(gaps), lambda_(l / R), n_(M / R) {
    const Vec3<Scalar> g = G / R;
    const bool rigid = lambda_[0] == 0 && lambda_[1] == 0 && lambda_[2] == 0;
    shifted_ = !rigid && g.squaredNorm() < 1;
    if (shifted_) d_ = lambda_;
    const Vec3<Scalar> Z = shifted_ ? g : n_;
    start_ << Z[0], Z[1], Z[2], Scalar(1);
    for (int i = 0; i < 3; ++i) plain_ -= a_[i] * n_[i] * (n_[i] - 2 * lambda_[i]);
    rho_ = shifted_ ? g.dot(g + 2 * lambda_) : Scalar(1);
    eps_ = shifted_ ? -g.dot(a_.cwiseProduct(g)) : plain_;
    secular_ = Secular<Scalar>(a_, gaps_, a_.cwiseProduct(lambda_), Scalar(1));
  }

  bool shifted() const noexcept { return shifted_; }
  Scalar a(int i) const noexcept { return a_[i]; }
  const Vec3<Scalar>& shift() const noexcept { return d_; }      ///< d
  const Vec4<Scalar>& start() const noexcept { return start_; }  ///< X at the start

  Scalar S(const Vec4<Scalar>& x, const Vec4<Scalar>& y) const noexcept {
    Scalar sum = -rho_ * x[3] * y[3];
    for (int i = 0; i < 3; ++i) sum += x[i] * y[i] + d_[i] * (x[i] * y[3] + y[i] * x[3]);
    return sum;
  }
  Scalar E(const Vec4<Scalar>& x, const Vec4<Scalar>& y) const noexcept {
    Scalar sum = eps_ * x[3] * y[3];
    for (int i = 0; i < 3; ++i) {
      sum += a_[i] * x[i] * y[i];
      if (!shifted_) sum -= a_[i] * lambda_[i] * (x[i] * y[3] + y[i] * x[3]);
    }
    return sum;
  }
  /// (E - sigma S)(x, y) at the root of an axis.
  Scalar form(const PencilAxis<Scalar>& at, const Vec4<Scalar>& x, const Vec4<Scalar>& y) const noexcept {
    return E(x, y) - sigma(at) * S(x, y);
  }

  Scalar sigma(const PencilAxis<Scalar>& p) const noexcept { return secular_.sigma(p.place); }
  /// sigma(q) - sigma(p).
  Scalar difference(const PencilAxis<Scalar>& p, const PencilAxis<Scalar>& q) const noexcept {
    return secular_.difference(p.place, q.place);
  }

  /// S(x, u) of an axis u, without cancellation where the shifted x is small.
  Scalar along(const PencilAxis<Scalar>& u, const Vec4<Scalar>& x) const noexcept {
    return shifted_ && !u.exact ? E(x, u.x) / sigma(u) : S(x, u.x);
  }

  /// A timelike vector, S(x, x) < 0, near the start where that is small in shifted form; moved along a principal axis on request.
  Vec4<Scalar> timelike(int axis = -1) const noexcept {
    Vec4<Scalar> x = Vec4<Scalar>::Zero();
    const Scalar g = start_.template head<3>().norm(), step = shifted_ && 4 * g < 1 ? 3 * g : Scalar(1);
    for (int i = 0; i < 3; ++i) x[i] = -step * d_[i];
    x[3] = 1;
    if (axis >= 0) x[axis] += step;
    return x;
  }

  /// M/R and the fourth coordinate of X, from (Z, x4).
  Vec4<Scalar> momentum(const Vec4<Scalar>& x) const noexcept {
    return {x[0] + d_[0] * x[3], x[1] + d_[1] * x[3], x[2] + d_[2] * x[3], x[3]};
  }
  /// omega/R times the fourth coordinate of X.
  Vec3<Scalar> rate(const Vec4<Scalar>& x) const noexcept {
    Vec3<Scalar> w = x.template head<3>();
    if (!shifted_) w -= lambda_ * x[3];
    return a_.cwiseProduct(w);
  }

  /// Errors: those of the roots of the secular equation (no_convergence, not_finite).
  Result<PencilAxes<Scalar>> axes() const noexcept {
    if (!secular_.active(0) && !secular_.active(1) && !secular_.active(2)) return principal_axes();
    const Scalar eta = -plain_ / 2;
    const Secular<Scalar> mirror = secular_.mirrored();
    for (const bool mirrored : {false, true}) {
      const Secular<Scalar>& q = mirrored ? mirror : secular_;
      const Scalar level = mirrored ? -eta : eta;
      const auto rise = q.rise(0);
      if (!rise.exists) continue;
      const Scalar below = q.value(rise.lo, level);
      Scalar above = q.value(rise.hi, level);
      // one sign decides for both sides of a dropped pole
      if (mirrored && rise.hi.origin == 1 && rise.hi.offset == 0 && !q.active(1))
        above = -secular_.value({1, Scalar(0)}, eta);
      if (!(below <= 0 && above >= 0 && below < above)) continue;
      return three(q, mirrored, rise, level, -below / (above - below));
    }
    return two(eta);
  }

 private:
  using Axis = PencilAxis<Scalar>;
  using Axes = PencilAxes<Scalar>;
  using Point = SecularPoint<Scalar>;

  /// Without rotor momentum: which axis the motion surrounds is decided by the components of M, never by the root.
  Axes principal_axes() const noexcept {
    Axes found;
    found.count = 3;
    for (int i = 0; i < 3; ++i) found.axis[i] = principal(i);
    const Scalar n0 = n_[0] * n_[0], n1 = n_[1] * n_[1], n2 = n_[2] * n_[2];
    found.lobe_lowest = gaps_(0, 1) * n0 >= gaps_(1, 2) * n2;
    const Scalar near = found.lobe_lowest ? gaps_(0, 1) : gaps_(1, 2);
    const Scalar risen = found.lobe_lowest ? gaps_(0, 1) * n1 + gaps_(0, 2) * n2 : gaps_(1, 2) * n1 + gaps_(0, 2) * n0;
    found.share = near > 0 ? risen / near : Scalar(0);
    return found;
  }

  Axis principal(int i) const noexcept {
    Axis p{{i, Scalar(0)}, Vec4<Scalar>::Zero(), true};
    p.x[i] = 1;
    return p;
  }

  Axis at(const Point& place) const noexcept {
    using std::abs, std::sqrt;
    Axis p{place, Vec4<Scalar>::Zero(), false};
    const Scalar factor = secular_.sigma(place);
    for (int i = 0; i < 3; ++i)
      if (secular_.active(i)) p.x[i] = (shifted_ ? factor : a_[i]) * lambda_[i] / secular_.distance(place, i);
    p.x[3] = 1;
    p.x /= sqrt(abs(S(p.x, p.x)));
    return p;
  }

  /// The axis of the mirrored equation's point, or principal axis, i.
  Axis unmirrored(const Point& p, bool mirrored, bool exact) const noexcept {
    const Point place = mirrored ? Point{2 - p.origin, -p.offset} : p;
    return exact ? principal(place.origin) : at(place);
  }

  void sort(Axes& found) const noexcept {
    const auto order = [&](int i, int j) {
      if (difference(found.axis[i], found.axis[j]) < 0) std::swap(found.axis[i], found.axis[j]);
    };
    order(0, 1);
    if (found.count == 3) order(1, 2), order(0, 1);
  }

  /// All four roots are real, three of them next to pole 0 of q.
  Result<Axes> three(const Secular<Scalar>& q, bool mirrored, const SecularRise<Scalar>& rise, Scalar eta,
                     Scalar share) const noexcept {
    Axes found;
    found.lobe_lowest = !mirrored;
    found.share = share;
    const auto add = [&](const Point& p, bool exact) { found.axis[found.count++] = unmirrored(p, mirrored, exact); };
    const bool active[3] = {q.active(0), q.active(1), q.active(2)};
    const Point none{0, Scalar(0)}, middle{1, Scalar(0)}, last{2, Scalar(0)};
    if (active[0]) {
      const auto root = q.falling_root(0, 1, none, rise.lo, eta);
      if (!root) return root.error();
      add(*root, false);
    } else {
      add(none, true);
    }
    if (active[1]) {
      const auto root = q.falling_root(0, 1, rise.hi, middle, eta);
      if (!root) return root.error();
      add(*root, false);
    } else {
      add(middle, true);
    }
    if (active[2]) {
      const auto root = q.falling_root(active[1] ? 1 : 0, 2, active[1] ? middle : rise.hi, last, eta);
      if (!root) return root.error();
      add(*root, false);
    } else {
      add(last, true);
    }
    sort(found);
    return found;
  }

  /// Two roots are real: a dropped pole is one, and between neighbouring active poles there is one.
  Result<Axes> two(Scalar eta) const noexcept {
    Axes found;
    int previous = -1;
    for (int i = 0; i < 3; ++i) {
      if (!secular_.active(i)) {
        if (found.count < 2) found.axis[found.count] = principal(i);
        ++found.count;
        continue;
      }
      if (previous >= 0) {
        Point from{previous, Scalar(0)}, to{i, Scalar(0)};
        if (i == previous + 1)
          if (const auto rise = secular_.rise(previous); rise.exists) {
            if (secular_.value(rise.lo, eta) > 0) from = rise.hi;
            else to = rise.lo;
          }
        const auto root = secular_.falling_root(previous, i, from, to, eta);
        if (!root) return root.error();
        if (found.count < 2) found.axis[found.count] = at(*root);
        ++found.count;
      }
      previous = i;
    }
    if (found.count != 2) return Errc::no_convergence;
    sort(found);
    return found;
  }

  Vec3<Scalar> a_{0, 0, 0};
  Mat3<Scalar> gaps_ = Mat3<Scalar>::Zero();
  Vec3<Scalar> lambda_{0, 0, 0}, n_{0, 0, 0}, d_{0, 0, 0};
  Scalar rho_ = 1, eps_ = 0;  // of S and E
  Scalar plain_ = 0;          // eps of the plain form: -2 eta of the secular equation
  bool shifted_ = false;
  Vec4<Scalar> start_ = Vec4<Scalar>::Zero();
  Secular<Scalar> secular_;
};

}  // namespace gyrostat::free
