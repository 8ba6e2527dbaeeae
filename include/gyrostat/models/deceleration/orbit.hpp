// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "gyrostat/body/secular.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/elliptic.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/models/deceleration/regime.hpp"

/// The free motion of a gyrostat with constant rotor momentum (Zhukovskii, Volterra) in closed form, and without it
/// (Euler, Poinsot) by the same code: deceleration.md, section 4.1.
namespace gyrostat::deceleration {

/// The slow variables of the free motion. eta = (h - S0/2)/R is the scaled carrier energy: it stays regular as R -> 0.
template <Real Scalar>
struct Level {
  Scalar R = 0;    ///< |M|, N m s
  Scalar eta = 0;  ///< rad/s
};

/// Level of the momentum M; R = 0 gives eta = 0.
template <Real Scalar>
Level<Scalar> level_of(const Problem<Scalar>& problem, const Vec3<Scalar>& M) noexcept {
  const Scalar R = magnitude(M);
  if (R == 0) return {};
  const Vec3<Scalar> n = M / R;
  return {R, R / 2 * n.dot(problem.inverse_inertia.cwiseProduct(n)) - problem.gyro_rate().dot(n)};
}

/// What sets the free orbit through M: without a rotor 2H/M^2 - 1/J1, 1/(kg m^2), told by differences of the moments, so that a change of all
/// of them does not show; with one, beside |M|, the level eta, rad/s. 0 at M = 0.
template <Real Scalar>
Scalar orbit_place(const Problem<Scalar>& problem, const Vec3<Scalar>& M) noexcept {
  if (!problem.rotor_momentum.isZero(0)) return level_of(problem, M).eta;
  const Scalar R = M.norm();
  if (!(R > 0)) return 0;
  const Vec3<Scalar> gaps = problem.inverse_gaps();
  return gaps[0] * (M[1] / R) * (M[1] / R) + gaps[2] * (M[2] / R) * (M[2] / R);
}

/// Carrier energy h on a level, J.
template <Real Scalar>
Scalar energy_of(const Problem<Scalar>& problem, const Level<Scalar>& level) noexcept {
  return level.R * level.eta + problem.rotor_energy_scale() / 2;
}

/// Which closed curve of a level the motion follows. Two components: `branch` is the sign of the lobe (sign of M along
/// axis 1, about_largest, or axis 3, about_smallest, at l = 0). One component: branch 0.
struct Component {
  Regime regime = Regime::one_component;
  int branch = 0;
};

/// A body of revolution with its rotor on the axis, but for some roundings.
template <Real Scalar>
struct Revolution {
  int axis = -1;       ///< 0 or 2; -1: the body is not such a one
  Scalar across = 0;   ///< 1/moment about the axes across, 1/(kg m^2)
  Scalar parted = 0;   ///< how far apart the two may be
  Scalar oblique = 0;  ///< what g may have across, rad/s
};

/// Whether the body is one of revolution about its greatest or its least axis, with the rotor on it. A tensor in turned axes has moments off
/// by some roundings of the greatest, and axes off by as much of the difference of moments.
template <Real Scalar>
Revolution<Scalar> revolution(const Problem<Scalar>& problem) noexcept {
  const Vec3<Scalar>& a = problem.inverse_inertia;
  const Vec3<Scalar> g = problem.gyro_rate();
  for (const int i : {0, 1}) {
    const int axis = 2 - 2 * i;
    const Scalar parted = 32 * epsilon<Scalar> * a[2], gap = std::abs(a[axis] - a[1]);
    const Scalar oblique = parted * std::abs(g[axis]) / gap;
    const Scalar most = std::max(std::abs(g[i]), std::abs(g[i + 1]));
    if (a[i + 1] - a[i] <= parted && parted < gap && g[axis] != 0 && most <= oblique)
      return {axis, (a[i] + a[i + 1]) / 2, parted, oblique};
  }
  return {};
}

/// A free orbit. Phase is measured in turns: it grows by one in a period, with time; its origin is a point of symmetry of
/// the Jacobi functions, the same along a family of orbits up to quarter turns (see aligned_to).
template <Real Scalar, class Elliptic = math::Native>
class Orbit {
 public:
  using Vec4 = Eigen::Matrix<Scalar, 4, 1>;

  Orbit() = default;

  /// The orbit on a level.
  /// @param followed the curve that the motion has followed so far: chooses the lobe where the level has two components.
  /// From one component the motion keeps to the older lobe where the level lies nearer to the birth of the other one than
  /// to the separatrix; nearer to the separatrix the lobe is undetermined (capture.hpp), but for a body without rotor momentum, whose lobes mirror each
  /// other: there the branch is kept. Within 1e-9 of the birth the older
  /// lobe is taken as one component still, on the level just before, which is level(). A lobe below the energy of its own centre
  /// (a stage of an integrator that overshoots) and a level outside the energies possible at this R become that equilibrium,
  /// regime() == point, and level() is then the clamped one.
  /// Errors: not_finite; zero_vector at R = 0; not_positive; not_applicable for a sphere; separatrix; undetermined where
  /// the lobe is not known; no_convergence.
  static Result<Orbit> at(const Problem<Scalar>& problem, Level<Scalar> level, Component followed) noexcept {
    return build(problem, level, followed, nullptr);
  }

  /// The orbit through M.
  static Result<Orbit> through(const Problem<Scalar>& problem, const Vec3<Scalar>& M) noexcept {
    return build(problem, level_of(problem, M), {}, &M);
  }

  Level<Scalar> level() const noexcept { return level_; }
  Regime regime() const noexcept { return regime_; }
  int branch() const noexcept { return branch_; }
  Component component() const noexcept { return {regime_, branch_}; }
  /// The same regime, and at an equilibrium that of the lobes about it: about_largest at a least energy, about_smallest at a greatest.
  Regime lobe() const noexcept { return regime_ == Regime::point ? lobe_ : regime_; }
  math::Modulus<Scalar> modulus() const noexcept { return modulus_; }
  Scalar rate() const noexcept { return rate_; }             ///< du/dt, rad/s
  Scalar quarter_period() const noexcept { return K_; }      ///< of u: K
  Scalar period() const noexcept { return 4 * K_ / rate_; }  ///< s

  /// M at a phase (turns), N m s.
  Vec3<Scalar> momentum_at(Scalar phase) const noexcept {
    const Scalar turns = phase + Scalar(quarter_) / 4;
    const auto j = Elliptic::jacobi(4 * K_ * (turns - std::floor(turns)), modulus_);
    return momentum(j.sn, j.cn, j.dn);
  }

  /// Phase of a momentum on (or near) the orbit, in [0, 1).
  Scalar phase_of(const Vec3<Scalar>& M) const noexcept {
    const Vec3<Scalar> n = M / magnitude(M);
    const auto product = [&](const Vec4& v) { return v.template head<3>().dot(n) - v[3]; };
    Scalar sn, cn;
    if (regime_ == Regime::point) return 0;
    if (regime_ == Regime::one_component) {
      // on the curve X is a multiple of (P, Q, sn dn, cn); the last two by the spacelike vectors, the size by the null pair
      const Scalar plus = product(null_minus_) / -2, minus = product(null_plus_) / -2;
      const Scalar size = cos_ * plus + sin_ * minus;
      const Scalar q = product(v_cn_) / (norm_cn_ * norm_cn_ * size), p = product(v_sn_) / (norm_sn_ * norm_sn_ * size);
      cn = std::clamp(q, Scalar(-1), Scalar(1));
      sn = p / std::sqrt(modulus_.kp2 + modulus_.k2 * cn * cn);
    } else {
      sn = product(v_sn_) / (norm_sn_ * norm_sn_);
      cn = product(v_cn_) / (norm_cn_ * norm_cn_);
    }
    const Scalar u = Elliptic::incomplete_F(std::atan2(sn, cn), modulus_);
    const Scalar turns = u / (4 * K_) - Scalar(quarter_) / 4;
    const Scalar phase = turns - std::floor(turns);
    return phase < 1 ? phase : Scalar(0);
  }

  /// M where the Jacobi functions of the argument u have the given values; u = 4 K phase + (0, 1, 2 or 3) K.
  Vec3<Scalar> momentum(Scalar sn, Scalar cn, Scalar dn) const noexcept {
    const Vec4 x = homogeneous(sn, cn, dn);
    return x.template head<3>() * (level_.R / x[3]);
  }

  /// M as a quotient: the first three components over the fourth, times R.
  Vec4 homogeneous(Scalar sn, Scalar cn, Scalar dn) const noexcept {
    const bool single = regime_ == Regime::one_component;
    return v_even_ + (single ? cn * cn : dn) * v_even2_ + (single ? sn * dn : sn) * v_sn_ + cn * v_cn_;
  }

  /// The four vectors of homogeneous(): X = even + w even2 + p along_sn + cn along_cn with w = cn^2, p = sn dn on one
  /// component, w = dn, p = sn on two.
  const Vec4& even() const noexcept { return v_even_; }
  const Vec4& even2() const noexcept { return v_even2_; }
  const Vec4& along_sn() const noexcept { return v_sn_; }
  const Vec4& along_cn() const noexcept { return v_cn_; }

  /// Quarter turns between u = 0 and phase 0.
  int quarter() const noexcept { return quarter_; }

  /// The same orbit with the origin of phase moved by quarter turns so that it lies nearest to that of a neighbour: near
  /// k2 = 0, where the frame exchanges its axes, and where an axis of the frame changes its sign, the phase then goes on
  /// without a jump. `spread` is the mean square distance of the quarter points over that of the next best choice: near 0
  /// for close neighbours, near 1 where the choice is arbitrary.
  Orbit aligned_to(const Orbit& neighbour, Scalar* spread = nullptr) const noexcept {
    Vec3<Scalar> here[4], there[4];
    quarter_points(here);
    neighbour.quarter_points(there);
    Scalar best = infinity<Scalar>, next = infinity<Scalar>;
    int shift = 0;
    for (int s = 0; s < 4; ++s) {
      Scalar sum = 0;
      for (int i = 0; i < 4; ++i) sum += (here[(i + s) % 4] / level_.R - there[i] / neighbour.level_.R).squaredNorm();
      if (sum < best) next = best, best = sum, shift = s;
      else next = std::min(next, sum);
    }
    if (spread) *spread = next > 0 ? best / next : Scalar(1);
    Orbit o = *this;
    o.quarter_ = (quarter_ + shift) % 4;
    return o;
  }

  /// M at the phases 0, 1/4, 1/2, 3/4.
  void quarter_points(Vec3<Scalar> (&M)[4]) const noexcept {
    const Scalar kp = std::sqrt(modulus_.kp2);
    static constexpr int sn[4] = {0, 1, 0, -1}, cn[4] = {1, 0, -1, 0};
    for (int i = 0; i < 4; ++i) {
      const int q = (i + quarter_) % 4;
      M[i] = momentum(Scalar(sn[q]), Scalar(cn[q]), q % 2 == 0 ? Scalar(1) : kp);
    }
  }

 private:
  using Quartic = Secular<Scalar>;
  using Point = SecularPoint<Scalar>;

  static Scalar lorentz(const Vec4& x, const Vec4& y) noexcept {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] - x[3] * y[3];
  }

  static Result<Orbit> build(const Problem<Scalar>& problem, const Level<Scalar>& level, const Component& followed,
                             const Vec3<Scalar>* M) noexcept {
    const Vec3<Scalar>& a = problem.inverse_inertia;
    const auto made = build_for(a, problem, level, followed, M);
    if (made || (made.error() != Errc::no_convergence && made.error() != Errc::undetermined)) return made;
    const Revolution<Scalar> about = revolution(problem);
    if (about.axis < 0) return made;
    // the lobes of such a body touch in rest alone, so that a motion stays in the older
    const Scalar lead = about.axis == 0 ? problem.rotor_momentum[0] : -problem.rotor_momentum[2];
    Component lobe{about.axis == 0 ? Regime::about_largest : Regime::about_smallest, lead > 0 ? 1 : -1};
    if (made.error() != Errc::undetermined) lobe = followed;
    // no direction across the axis is an axis of the orbit, until some roundings make one
    Problem<Scalar> even = problem;
    const int i = about.axis == 2 ? 0 : 1;
    for (const int across : {i, i + 1}) even.inverse_inertia[across] = about.across, even.rotor_momentum[across] = 0;
    for (const int roundings : {1, 4, 16, 64}) {
      Vec3<Scalar> parted = even.inverse_inertia;
      parted[2 - about.axis] *= 1 + static_cast<Scalar>(i == 0 ? -roundings : roundings) * epsilon<Scalar>;
      const auto nearly = build_for(parted, even, level, lobe, M);
      if (!nearly) continue;
      Orbit circle = *nearly;
      circle.close_round(even.inverse_inertia, even.gyro_rate(), about.axis);
      return circle;
    }
    return made;
  }

  /// Makes of what is all but a circle about a principal axis that circle, on which M turns evenly.
  void close_round(const Vec3<Scalar>& a, const Vec3<Scalar>& g, int axis) noexcept {
    if (regime_ == Regime::point) return;
    const Scalar turning = std::abs(momentum_at(0)[axis] * (a[axis] - a[1]) - g[axis]);
    if (!(turning > 0)) return;
    modulus_ = {0, 1};
    K_ = pi<Scalar> / 2;
    rate_ = turning;
  }

  /// How far rounding may move the place of an equilibrium on the sphere: the root of it.
  static constexpr Scalar rounding_of_place = Scalar(1e-6L);

  static Result<Orbit> build_for(const Vec3<Scalar>& a, const Problem<Scalar>& problem, Level<Scalar> level,
                                 const Component& followed, const Vec3<Scalar>* M) noexcept {
    const Vec3<Scalar> g = problem.gyro_rate();
    if (!std::isfinite(level.R) || !std::isfinite(level.eta) || !a.allFinite() || !g.allFinite())
      return Errc::not_finite;
    if (level.R == 0) return Errc::zero_vector;
    if (!(level.R > 0) || !(a[0] > 0)) return Errc::not_positive;
    if (a[2] - a[0] <= 8 * epsilon<Scalar> * a[2]) return Errc::not_applicable;

    Orbit o;
    o.level_ = level;
    const Quartic original(a, g, level.R), mirror = original.mirrored();
    const Scalar close = std::sqrt(epsilon<Scalar>) / 16 * std::max(level.R * a[2], g.norm());
    for (const bool mirrored : {false, true}) {
      const Quartic& q = mirrored ? mirror : original;
      const Scalar eta = mirrored ? -level.eta : level.eta;
      const auto rise = q.rise(0);
      if (!rise.exists) continue;
      const Scalar below = q.value(rise.lo, eta), above = q.value(rise.hi, eta);
      const Regime regime = mirrored ? Regime::about_smallest : Regime::about_largest;
      // a point may have been the end of a lobe
      const bool in_lobe = followed.regime == regime || followed.regime == Regime::point;
      if (below > 0) {  // under the lowest energy of the lobes
        const bool both = !q.active(0);
        if (both || (in_lobe && followed.branch == younger(q)))
          return o.rest_at(q, mirrored, rise.lo, followed.branch, M);
        // the end of the younger lobe, where M stands but for rounding
        if (M) {
          Orbit end = o;
          const auto rest = end.rest_at(q, mirrored, rise.lo, younger(q), M);
          if (rest && (rest->momentum_at(0) - *M).norm() <= rounding_of_place * level.R) return rest;
        }
        continue;
      }
      if (above < 0) continue;
      o.regime_ = regime;
      if (const auto e = o.two_components(q, mirrored, rise, eta); e != Errc::ok) return e;
      o.branch_ = 1;
      if (M) o.branch_ = lorentz(o.v_even2_, with_unit(*M)) >= 0 ? 1 : -1;
      else if (in_lobe && followed.branch != 0) o.branch_ = followed.branch;
      else if (q.active(0) && -below < above) o.branch_ = -younger(q);
      else if (g.isZero(0)) o.branch_ = followed.branch < 0 ? -1 : 1;  // lobes mirror each other
      else return Errc::undetermined;
      if (q.active(0) && o.branch_ == -younger(q) && -below < 2 * level.R * close) {
        // at the birth of the other lobe this frame is singular and the orbit is not: the mirror image of the level, where
        // there is one component still
        const Scalar back = (mirrored ? -1 : 1) * std::max(-below / (2 * level.R), close / 1000);
        o.level_.eta = (mirrored ? -1 : 1) * q.level(rise.lo) - back;
        break;
      }
      o.v_even2_ *= Scalar(o.branch_);
      return o.oriented(original, problem);
    }
    o.regime_ = Regime::one_component;
    o.branch_ = 0;
    bool outside = false;
    const auto e = o.one_component(original, o.level_.eta, outside);
    if (e == Errc::ok) return o.oriented(original, problem);
    if (!outside) return e;
    // no oscillation is left: the energy is at or beyond that of an equilibrium
    Point low, high;
    if (!original.turning_point(0, -1, infinity<Scalar>, low) || !mirror.turning_point(0, -1, infinity<Scalar>, high))
      return e;
    const Scalar from_low = level.eta - original.level(low), from_high = -mirror.level(high) - level.eta;
    if (!(std::min(from_low, from_high) < close)) return Errc::no_convergence;
    return from_low < from_high ? o.rest_at(original, false, low, 0, M) : o.rest_at(mirror, true, high, 0, M);
  }

  static Vec4 with_unit(const Vec3<Scalar>& M) noexcept {
    Vec4 x;
    x << M / magnitude(M), Scalar(1);
    return x;
  }

  /// Branch of the lobe that is born where the two components part; its centre is the secondary equilibrium.
  static int younger(const Quartic& q) noexcept { return q.g(0) > 0 ? -1 : 1; }

  /// Normalised eigenvector of a place, or the axis itself.
  struct Axis {
    Point place;
    Vec4 x;
    Scalar square;  // of the vector before it was normalised, over R^2
  };
  static Axis axis_at(const Quartic& q, const Point& place) noexcept {
    const Vec3<Scalar> v = q.vertex(place) / q.radius();
    Axis r{place, Vec4(v[0], v[1], v[2], Scalar(1)), v.squaredNorm() - 1};
    r.x /= std::sqrt(std::abs(r.square));
    return r;
  }
  static Axis axis_along(int i) noexcept {
    Axis r{{i, Scalar(0)}, Vec4::Zero(), 1};
    r.x[i] = 1;
    return r;
  }

  static Vec4 unmirrored(const Vec4& x, bool mirrored) noexcept { return mirrored ? Vec4(x[2], x[1], x[0], x[3]) : x; }

  /// Frame and modulus around axis 0 of q, which has three roots in its first gap.
  Errc two_components(const Quartic& q, bool mirrored, const SecularRise<Scalar>& rise, Scalar eta) noexcept {
    const auto rising = q.rising_root(0, rise, eta);
    if (!rising) return rising.error();
    const Axis inner = axis_at(q, *rising);
    if (!(inner.square < 0)) return Errc::separatrix;

    Axis lobe = axis_along(0), side[2];
    if (q.active(0)) {
      const auto root = q.falling_root(0, 1, {0, Scalar(0)}, rise.lo, eta);
      if (!root) return root.error();
      lobe = axis_at(q, *root);
      if (!(lobe.square > 0)) return Errc::separatrix;
    }
    int n = 0;
    const bool one = q.active(1), two = q.active(2);
    if (one) {
      const auto root = q.falling_root(0, 1, rise.hi, {1, Scalar(0)}, eta);
      if (!root) return root.error();
      side[n++] = axis_at(q, *root);
    } else {
      side[n++] = axis_along(1);
    }
    if (two) {
      const Point from = one ? Point{1, Scalar(0)} : rise.hi;
      const auto root = q.falling_root(one ? 1 : 0, 2, from, {2, Scalar(0)}, eta);
      if (!root) return root.error();
      side[n++] = axis_at(q, *root);
    } else {
      side[n++] = axis_along(2);
    }
    if (!(side[0].square > 0) || !(side[1].square > 0)) return Errc::separatrix;
    if (q.difference(side[0].place, side[1].place) < 0) std::swap(side[0], side[1]);

    const Scalar R = q.radius();
    const Scalar nu = R * std::max(Scalar(0), q.difference(lobe.place, inner.place));
    const Scalar p2 = R * q.difference(inner.place, side[0].place), p3 = R * q.difference(inner.place, side[1].place);
    const Scalar split = R * q.difference(side[0].place, side[1].place);
    if (!(p2 > 0)) return Errc::separatrix;
    modulus_ = math::Modulus<Scalar>::from_parts(split * nu, p2 * (p3 + nu));
    rate_ = std::sqrt(p3 * (p2 + nu));

    // Lorentz orthogonality to rounding: nearly equal roots leave their vectors skew
    Vec4 x0 = lobe.x, x1 = side[0].x, x2 = side[1].x;
    const Vec4& t = inner.x;
    const auto clear = [](Vec4& x, const Vec4& y, Scalar sign) { x -= sign * lorentz(x, y) * y; };
    clear(x0, t, -1);
    clear(x1, t, -1);
    clear(x1, x0, 1);
    x1 /= std::sqrt(lorentz(x1, x1));
    clear(x2, t, -1);
    clear(x2, x0, 1);
    clear(x2, x1, 1);
    x2 /= std::sqrt(lorentz(x2, x2));
    if (x0[0] < 0) x0 = -x0;
    int largest = 0;
    x1.template head<3>().cwiseAbs().maxCoeff(&largest);
    if (x1[largest] < 0) x1 = -x1;

    v_even_ = unmirrored(t, mirrored);
    v_even2_ = unmirrored(x0, mirrored) * std::sqrt(p3 / (p3 + nu));
    norm_sn_ = std::sqrt(nu / (nu + p2));
    norm_cn_ = std::sqrt(nu / (nu + p3));
    v_sn_ = unmirrored(x1, mirrored) * norm_sn_;
    v_cn_ = unmirrored(x2, mirrored) * norm_cn_;
    return Errc::ok;
  }

  /// The spacelike eigenvectors that have one of the gaps between the axes, or an axis itself, to themselves; how many.
  Result<int> eigenvectors(const Quartic& q, Scalar eta, Axis (&axis)[3]) const noexcept {
    int n = 0, previous = -1;
    for (int i = 0; i < 3; ++i) {
      if (!q.active(i)) {
        axis[n++] = axis_along(i);
        continue;
      }
      if (previous >= 0) {
        Point from{previous, Scalar(0)}, to{i, Scalar(0)};
        if (i == previous + 1)
          if (const auto rise = q.rise(previous); rise.exists) {
            if (q.value(rise.lo, eta) > 0) from = rise.hi;
            else to = rise.lo;
          }
        const auto root = q.falling_root(previous, i, from, to, eta);
        if (!root) return root.error();
        axis[n++] = axis_at(q, *root);
        if (!(axis[n - 1].square > 0)) return Errc::separatrix;
      }
      previous = i;
    }
    return n;
  }

  /// Frame and modulus of a level with two spacelike eigenvectors and a complex pair m +- i B. `outside`: there is no such
  /// pair, because the energy is that of an equilibrium or beyond.
  Errc one_component(const Quartic& q, Scalar eta, bool& outside) noexcept {
    Axis axis[3];
    const auto found = eigenvectors(q, eta, axis);
    if (!found) return found.error();
    if (*found != 2) {
      outside = true;
      return Errc::separatrix;
    }
    if (q.difference(axis[0].place, axis[1].place) < 0) std::swap(axis[0], axis[1]);
    const Vec4 x1 = axis[0].x;
    Vec4 x2 = axis[1].x;
    x2 -= lorentz(x1, x2) * x1;
    x2 /= std::sqrt(lorentz(x2, x2));

    // the plane of the complex pair: f0 timelike, f1 spacelike
    Vec4 f0 = Vec4(0, 0, 0, 1) + x1[3] * x1 + x2[3] * x2;
    f0 /= std::sqrt(-lorentz(f0, f0));
    Vec4 f1 = cross(f0, x1, x2);
    f1 /= std::sqrt(lorentz(f1, f1));

    const Scalar R = q.radius();
    const auto form = [&](const Vec4& x, const Vec4& y) {
      Scalar sum = -2 * eta * x[3] * y[3];
      for (int i = 0; i < 3; ++i) sum += R * q.a(i) * x[i] * y[i] - q.g(i) * (x[i] * y[3] + x[3] * y[i]);
      return sum;
    };
    const Vec4 up = f0 + f1, down = f0 - f1;  // null vectors: lorentz(up, down) = -2
    const Scalar plus = form(up, up) / 2, minus = form(down, down) / 2;
    const Scalar m = -form(up, down) / 2;
    outside = !(plus * minus < 0);
    if (outside) return Errc::separatrix;
    const Scalar B = std::sqrt(-plus * minus);
    const Scalar boost = std::sqrt(std::sqrt(-minus / plus));
    // F1 is the one of +-f1 with E(F0, F1) > 0
    null_plus_ = plus > 0 ? Vec4(up * boost) : Vec4(down / boost);
    null_minus_ = plus > 0 ? Vec4(down / boost) : Vec4(up * boost);

    const Scalar width = R * q.difference(axis[0].place, axis[1].place);
    const Scalar s1 = R * q.sigma(axis[0].place), s2 = R * q.sigma(axis[1].place);
    set_one_component(x1, x2, width, m - s1, s2 - m, B);
    return Errc::ok;
  }

  /// Modulus, rate and the vectors of the four functions, from the eigenvectors and the distances of their roots, `width` apart, from the pair.
  void set_one_component(const Vec4& x1, const Vec4& x2, Scalar width, Scalar al, Scalar be, Scalar B) noexcept {
    const Scalar rho = std::hypot(al, B), rho2 = std::hypot(be, B);
    rate_ = std::sqrt(rho * rho2);
    const Scalar r = (al * be - B * B) / (B * width), size = std::sqrt(1 + r * r);
    const Scalar small = 1 / (2 * size * (size + std::abs(r)));
    modulus_ = r > 0 ? math::Modulus<Scalar>::from_kp2(small) : math::Modulus<Scalar>::from_k2(small);
    const Scalar xc2 = r > 0 ? size + r : 1 / (size - r);
    const Scalar cosine = al / rho, sine = B / rho;
    if (cosine > 0) {
      cos_ = std::sqrt((1 + cosine) / 2);
      sin_ = sine / (2 * cos_);
    } else {
      sin_ = std::sqrt((1 - cosine) / 2);
      cos_ = sine / (2 * sin_);
    }
    v_even_ = cos_ * null_plus_ + sin_ * null_minus_;
    v_even2_ = xc2 * (cos_ * null_minus_ - sin_ * null_plus_);
    norm_sn_ = std::sqrt(2 * sine * (xc2 * xc2 + 1));
    norm_cn_ = 2 * std::sqrt(xc2 * rho / width);
    v_sn_ = norm_sn_ * x1;
    v_cn_ = norm_cn_ * x2;
  }

  /// The vector that is Lorentz orthogonal to three others.
  static Vec4 cross(const Vec4& x, const Vec4& y, const Vec4& z) noexcept {
    const auto subdeterminant = [&](int i, int j, int k) {
      return x[i] * (y[j] * z[k] - y[k] * z[j]) - x[j] * (y[i] * z[k] - y[k] * z[i]) +
             x[k] * (y[i] * z[j] - y[j] * z[i]);
    };
    return {subdeterminant(1, 2, 3), -subdeterminant(0, 2, 3), subdeterminant(0, 1, 3), subdeterminant(0, 1, 2)};
  }

  /// Last steps: merged axes turned back, time made to run with u, K.
  Result<Orbit> oriented(const Quartic& q, const Problem<Scalar>& problem) noexcept {
    for (Vec4* v : {&v_even_, &v_even2_, &v_sn_, &v_cn_, &null_plus_, &null_minus_}) {
      const Vec3<Scalar> turned = q.to_principal(v->template head<3>());
      v->template head<3>() = turned;
    }
    if (regime_ != Regime::one_component) v_cn_ *= -Scalar(branch_);
    // at u = 0 only the sn term moves
    const Vec4 x = homogeneous(0, 1, 1);
    const Vec3<Scalar> n = x.template head<3>() / x[3];
    const Vec3<Scalar> slope = (v_sn_.template head<3>() - v_sn_[3] * n) / x[3];
    const Vec3<Scalar> flow = n.cross(problem.angular_velocity(level_.R * n));
    if (slope.dot(flow) < 0) {
      if (regime_ == Regime::one_component) v_sn_ = -v_sn_;
      else v_cn_ = -v_cn_;
    }
    return finished();
  }

  Result<Orbit> finished() noexcept {
    K_ = Elliptic::complete(modulus_).K;
    if (!(modulus_.kp2 > 0) || !std::isfinite(K_)) return Errc::separatrix;
    if (!(rate_ > 0) || !std::isfinite(rate_)) return rate_ >= 0 ? Errc::separatrix : Errc::no_convergence;
    if (!homogeneous(0, 1, 1).allFinite() || !v_sn_.allFinite()) return Errc::no_convergence;
    return *this;
  }

  /// The equilibrium omega = sigma M at a zero of c', with the period of small oscillations about it.
  Result<Orbit> rest_at(const Quartic& q, bool mirrored, const Point& place, int branch,
                        const Vec3<Scalar>* M) noexcept {
    Vec3<Scalar> v = q.vertex(place) / q.radius();
    if (place.offset == 0 && !q.active(place.origin)) {
      const int i = place.origin;
      if (M) branch = (*M)[mirrored ? 2 - i : i] < 0 ? -1 : 1;
      v[i] = Scalar(branch < 0 ? -1 : 1) * std::sqrt(std::max(Scalar(0), 1 - v.squaredNorm()));
    }
    v.normalize();
    regime_ = Regime::point;
    lobe_ = mirrored ? Regime::about_smallest : Regime::about_largest;
    branch_ = branch;
    level_.eta = (mirrored ? -1 : 1) * q.level(place);
    v_even_ = unmirrored(Vec4(v[0], v[1], v[2], Scalar(1)), mirrored);
    v_even_.template head<3>() = (mirrored ? q.mirrored() : q).to_principal(v_even_.template head<3>());
    v_even2_ = v_sn_ = v_cn_ = Vec4::Zero();
    modulus_ = {Scalar(0), Scalar(1)};
    // squared frequency: product of the two tangential second derivatives of eta on the sphere
    const Scalar R = q.radius();
    Vec3<Scalar> d;
    for (int i = 0; i < 3; ++i) d[i] = R * q.distance(place, i);
    const Scalar square = d[1] * d[2] * v[0] * v[0] + d[0] * d[2] * v[1] * v[1] + d[0] * d[1] * v[2] * v[2];
    rate_ = std::sqrt(std::max(Scalar(0), square));
    return finished();
  }

  Level<Scalar> level_;
  Regime regime_ = Regime::separatrix, lobe_ = Regime::separatrix;
  int branch_ = 0, quarter_ = 0;
  math::Modulus<Scalar> modulus_;
  Scalar rate_ = 0, K_ = 0;
  Vec4 v_even_ = Vec4::Zero(), v_even2_ = Vec4::Zero(), v_sn_ = Vec4::Zero(), v_cn_ = Vec4::Zero();
  // for the inverse map
  Vec4 null_plus_ = Vec4::Zero(), null_minus_ = Vec4::Zero();
  Scalar norm_sn_ = 0, norm_cn_ = 0, cos_ = 1, sin_ = 0;
};

#ifdef GYROSTAT_COMPILED
extern template class Orbit<double, math::Native>;
#endif

}  // namespace gyrostat::deceleration
