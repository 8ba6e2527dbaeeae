// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "gyrostat/models/rotor/gyrostat.hpp"

/// Every steady rotation of a gyrostat at the rotor's no-load rate (docs/rotor.md, section 4): the carrier turns about the
/// momentum H = l m with the rate psi_dot, the rotor with omega*,
///     psi_dot theta m = l m - h e,   |m| = 1,
/// which are the critical points of F(m) = (l m - h e).J (l m - h e)/2 on the sphere |m| = 1. In principal axes of theta, with
/// a_i = 1/theta_i and sigma = psi_dot/l,
///     m_i = (h/l) e_i a_i/(a_i - sigma),   phi(sigma) = m.m - 1 = 0.
/// 1/|m| is concave in sigma between two poles a_i and beyond the outer ones, and it is close to straight: all roots are found
/// by a method of third order from known brackets. The unknown is the distance from a pole, so that a pole with a tiny e_i costs
/// no digits.
namespace gyrostat::rotor {

/// What F has there. Two minima at most; one minimum and one maximum at least.
enum class SteadyType : std::uint8_t {
  minimum,
  saddle,
  maximum,
  degenerate,  ///< two or more steady rotations merge here to rounding (fold), or it is one of a continuum
};

/// One steady rotation.
template <Real Scalar>
struct SteadyRotation {
  Vec3<Scalar> direction{0, 0, 0};  ///< m = H/|H|, unit, body axes
  Scalar spin_rate = 0;             ///< psi_dot: Omega = psi_dot m, rad/s; may be negative or zero
  Scalar level = 0;                 ///< F(m), J
  SteadyType type = SteadyType::degenerate;
  bool isolated = true;  ///< false: a representative of a circle or of the whole sphere of steady rotations
};

/// By ascending spin rate, which is the order of the levels: F(m') - F(m) = l (psi' - psi) |m' - m|^2/4. 2, 4 or 6 isolated ones
/// where none is degenerate.
template <Real Scalar>
struct SteadyRotations {
  std::array<SteadyRotation<Scalar>, 8> at{};
  int count = 0;
  bool circle = false;  ///< one entry stands for a circle: two equal moments, and no rotor momentum in their plane
  bool sphere = false;  ///< every m is steady: three equal moments and h = 0

  const SteadyRotation<Scalar>* begin() const noexcept { return at.data(); }
  const SteadyRotation<Scalar>* end() const noexcept { return at.data() + count; }
  const SteadyRotation<Scalar>& operator[](int i) const noexcept { return at[std::size_t(i)]; }

  /// Index of the lowest entry of a type; -1 where there is none.
  int lowest(SteadyType type) const noexcept {
    for (int i = 0; i < count; ++i)
      if (at[std::size_t(i)].type == type) return i;
    return -1;
  }
};

namespace detail {

/// phi = S2 - 1, phi' = 2 S3, phi'' = 6 S4 at one sigma: sums of b^2/d^2, b^2/d^3, b^2/d^4 over the poles, d = a - sigma.
template <Real Scalar>
struct PoleSums {
  Scalar second = 0, third = 0, fourth = 0;
};

/// The poles that phi has, ascending, in units of 1/theta_3. Equal moments (to rounding) make one pole.
template <Real Scalar>
struct SteadyPoles {
  int count = 0;
  std::array<Scalar, 3> weight{};                 ///< b = |h/l e_i| a_i > 0
  std::array<Scalar, 3> place{};                  ///< a
  std::array<std::array<Scalar, 3>, 3> offset{};  ///< a_j - a_i at [i][j], each from the difference of the moments

  PoleSums<Scalar> sums(int origin, Scalar tau) const noexcept {
    PoleSums<Scalar> s;
    for (int j = 0; j < count; ++j) {
      const Scalar inverse = 1 / (offset[std::size_t(origin)][std::size_t(j)] - tau);
      const Scalar m = weight[std::size_t(j)] * inverse;
      const Scalar square = m * m;
      s.second += square;
      s.third += square * inverse;
      s.fourth += square * inverse * inverse;
    }
    return s;
  }

  /// What rounding of theta and e can do to phi, at most.
  Scalar rounding(int origin, Scalar tau) const noexcept {
    Scalar sum = 0;
    for (int j = 0; j < count; ++j) {
      const Scalar d = offset[std::size_t(origin)][std::size_t(j)] - tau;
      const Scalar m = weight[std::size_t(j)] / d;
      const Scalar a = place[std::size_t(j)];
      sum += m * m * (1 + a * a / std::abs(d));
    }
    return 8 * epsilon<Scalar> * sum;
  }

  /// Where |m| = 1: the distance t from the pole `origin` towards `side` (+1, -1), between `outer`, where |m| >= 1, and
  /// `inner`, where |m| <= 1 (it may be infinite). At a fold that rounding closes: where it stands.
  Scalar root(int origin, int side, Scalar outer, Scalar inner, Scalar start) const noexcept {
    const Scalar sign = inner > outer ? Scalar(1) : Scalar(-1);
    Scalar t = start;
    for (int call = 0; call < 100; ++call) {
      const PoleSums<Scalar> s = sums(origin, side > 0 ? t : -t);
      const Scalar g = 1 / std::sqrt(s.second);
      const Scalar wanted = 1 - g;
      if (std::abs(wanted) <= epsilon<Scalar>) return t;
      (wanted > 0 ? outer : inner) = t;
      const Scalar g3 = g / s.second;
      const Scalar slope = side > 0 ? -g3 * s.third : g3 * s.third;
      const Scalar curve = 3 * g3 / s.second * (s.third * s.third - s.second * s.fourth);  // g'' <= 0
      const Scalar square = slope * slope + 2 * curve * wanted;
      // the parabola through this point; its vertex where it does not reach 1
      const Scalar step = square > 0 ? 2 * wanted / (slope + sign * std::sqrt(square)) : -slope / curve;
      Scalar next = t + step;
      if (!((next - outer) * sign > 0 && (inner - next) * sign > 0))
        next = inner < infinity<Scalar> ? outer / 2 + inner / 2 : 2 * outer;
      if (std::abs(next - t) <= 2 * epsilon<Scalar> * t) return next;
      t = next;
    }
    return t;
  }

  struct Place {
    int origin = 0;
    Scalar tau = 0;
  };

  /// Where |m| is least between the poles `left` and `left + 1`; cubes: b^(2/3) of both. With sums over the poles on either
  /// side, (sum b^2/d^3)^(-1/3) of the two are equal there; each is concave, and linear where its side has one pole.
  Place least_between(int left, Scalar left_cube, Scalar right_cube) const noexcept {
    const int right = left + 1;
    const Scalar gap = offset[std::size_t(left)][std::size_t(right)];
    const Scalar sum = left_cube + right_cube;
    const Scalar from_left = gap * (left_cube / sum), from_right = gap * (right_cube / sum);
    if (count == 2) return from_left < from_right ? Place{left, from_left} : Place{right, -from_right};

    // `pair`: the pole with a second one behind it; `lone`: the other. z from `pair`, y from `lone`, z + y = gap.
    const bool mirrored = left == 0;
    const int pair = mirrored ? right : left, lone = mirrored ? left : right, third = mirrored ? 2 : 0;
    const Scalar cube = mirrored ? left_cube : right_cube;  // of `lone`
    const Scalar behind = std::abs(offset[std::size_t(pair)][std::size_t(third)]);
    const Scalar b2 = weight[std::size_t(pair)] * weight[std::size_t(pair)];
    const Scalar c2 = weight[std::size_t(third)] * weight[std::size_t(third)];
    Scalar balance = 0, slope = 0;  // of the two sides, and by z
    const auto weigh = [&](Scalar z, Scalar y) noexcept {
      const Scalar p = 1 / z, t = 1 / (z + behind);
      const Scalar p3 = b2 * p * p * p, t3 = c2 * t * t * t;
      const Scalar third_power = p3 + t3;
      const Scalar root = 1 / std::cbrt(third_power);
      balance = root - y / cube;
      slope = root / third_power * (p3 * p + t3 * t) + 1 / cube;
    };
    Scalar z = mirrored ? from_right : from_left;
    bool near_pair = z < gap / 2;
    if (near_pair) {
      weigh(gap / 2, gap / 2);
      if (balance < 0) near_pair = false, z = gap / 2;
    }
    Scalar t = near_pair ? z : z == gap / 2 ? gap / 2 : mirrored ? from_left : from_right;
    for (int call = 0; call < 40; ++call) {  // from below: Newton's steps on a concave function do not pass its root
      near_pair ? weigh(t, gap - t) : weigh(gap - t, t);
      const Scalar step = -balance / slope;
      const Scalar next = near_pair ? t + step : t - step;
      if (!(next > 0 && next < gap)) break;
      const bool done = std::abs(next - t) <= Scalar(1e-5L) * t;  // the step after it would be below 1e-10
      t = next;
      if (done) break;
    }
    const int origin = near_pair ? pair : lone;
    return {origin, origin == left ? t : -t};
  }
};

/// hi + lo, exactly a + b.
template <Real Scalar>
struct Exact {
  Scalar hi, lo;
};

template <Real Scalar>
inline Exact<Scalar> exact_sum(Scalar a, Scalar b) noexcept {
  const Scalar s = a + b, from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}

#ifdef FP_FAST_FMA
inline constexpr bool fast_fma = true;
#else
inline constexpr bool fast_fma = false;
#endif

/// a b, exactly (Dekker 1971 where the processor has no fused multiplication).
template <Real Scalar>
inline Exact<Scalar> exact_product(Scalar a, Scalar b) noexcept {
  const Scalar p = a * b;
  if constexpr (fast_fma && !std::is_same_v<Scalar, long double>) return {p, std::fma(a, b, -p)};
  constexpr Scalar splitter = Scalar((std::uint64_t(1) << ((std::numeric_limits<Scalar>::digits + 1) / 2)) + 1);
  const auto halves = [](Scalar x) noexcept -> Exact<Scalar> {
    const Scalar c = splitter * x, hi = c - (c - x);
    return {hi, x - hi};
  };
  const auto x = halves(a), y = halves(b);
  return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

/// A sum kept in twice the precision.
template <Real Scalar>
struct LongSum {
  Scalar hi = 0, lo = 0;

  void add(Exact<Scalar> x) noexcept {
    const Exact<Scalar> s = exact_sum(hi, x.hi);
    hi = s.hi;
    lo += s.lo + x.lo;
  }
  void add_product(Scalar a, Scalar b) noexcept { add(exact_product(a, b)); }
  Scalar value() const noexcept { return hi + lo; }
};

/// Two unit vectors that make a right-handed triad with the unit vector m (Duff and others 2017).
template <Real Scalar>
struct Tangent {
  Vec3<Scalar> u, v;

  explicit Tangent(const Vec3<Scalar>& m) noexcept {
    const Scalar sign = std::copysign(Scalar(1), m[2]);
    const Scalar a = -1 / (sign + m[2]), b = m[0] * m[1] * a;
    u = {1 + sign * m[0] * m[0] * a, sign * b, -sign * m[0]};
    v = {b, sign + m[1] * m[1] * a, -m[1]};
  }
};

/// One Newton step on psi theta m = l m - h e, |m| = 1, with the misfit in twice the precision: it takes away what the axes of
/// theta have lost. Left undone where a fold makes the step long.
template <Real Scalar>
void polish(const Gyrostat<Scalar>& gyrostat, Scalar l, SteadyRotation<Scalar>& r) noexcept {
  const Mat3<Scalar>&theta = gyrostat.inertia(), &J = gyrostat.inverse_inertia();
  const Vec3<Scalar>&e = gyrostat.axis(), m = r.direction;
  const Scalar psi = r.spin_rate, h = gyrostat.target_momentum();
  Vec3<Scalar> misfit;
  LongSum<Scalar> norm{-1, 0};
  for (int i = 0; i < 3; ++i) {
    LongSum<Scalar> row;
    for (int j = 0; j < 3; ++j) row.add_product(theta(i, j), m[j]);
    const Exact<Scalar> t = exact_sum(row.hi, row.lo);
    LongSum<Scalar> sum;
    sum.add_product(psi, t.hi);
    sum.lo += psi * t.lo;
    sum.add_product(-l, m[i]);
    sum.add_product(h, e[i]);
    misfit[i] = sum.value();
    norm.add_product(m[i], m[i]);
  }
  const Scalar excess = norm.value() / 2;
  const Tangent<Scalar> t(m);
  const Vec3<Scalar> force = J * misfit, Jm = l * (J * m), Ju = l * (J * t.u), Jv = l * (J * t.v);
  const Scalar uu = t.u.dot(Ju) - psi, uv = t.u.dot(Jv), vv = t.v.dot(Jv) - psi;
  const Scalar fu = t.u.dot(force) + excess * t.u.dot(Jm), fv = t.v.dot(force) + excess * t.v.dot(Jm);
  const Scalar determinant = uu * vv - uv * uv, size = uu * uu + vv * vv + 2 * uv * uv;
  const Scalar du = (vv * fu - uv * fv) / determinant, dv = (uu * fv - uv * fu) / determinant;
  if (!(std::abs(du) + std::abs(dv) <= Scalar(1e-3L) * std::abs(determinant) / size)) return;
  const Vec3<Scalar> change = du * t.u + dv * t.v - excess * m;
  r.direction = m + change - (du * du + dv * dv) / 2 * m;
  r.spin_rate = psi + (change.dot(Jm) + excess * psi - m.dot(force));
}

/// Axes first ... last of theta, whose moments are equal to rounding: together one pole of phi where the rotor has a part of its
/// momentum along them (`active`), else none.
struct SteadyGroup {
  int first, last;
  bool active;

  int multiplicity() const noexcept { return last - first + 1; }
};

/// phi of a gyrostat: the axes in groups, ascending in a, and the poles of the active ones.
template <Real Scalar>
struct SteadyAxes {
  Vec3<Scalar> moments;  ///< ascending, kg m^2
  Vec3<Scalar> along;    ///< (h/l) e in principal axes
  Scalar largest;        ///< moment, the unit
  std::array<SteadyGroup, 3> groups{};
  int group_count = 0;
  std::array<int, 3> pole{-1, -1, -1};  ///< of each axis; -1 where it has no weight
  SteadyPoles<Scalar> poles;

  SteadyAxes(const Gyrostat<Scalar>& gyrostat, Scalar eta) noexcept
      : moments(gyrostat.principal()),
        along(eta * (gyrostat.R_BP().transpose() * gyrostat.axis())),
        largest(moments[2]) {
    constexpr Scalar rounding = 64 * epsilon<Scalar>;
    std::array<Scalar, 3> moment{};  // of the poles
    for (int i = 2; i >= 0;) {
      int first = i;
      while (first > 0 && moments[i] - moments[first - 1] <= rounding * largest) --first;
      Scalar square = 0;
      for (int j = first; j <= i; ++j) square += along[j] * along[j];
      const Scalar part = first == i ? std::abs(along[i]) : std::sqrt(square);
      const Scalar least = first == i ? 0 : 16 * epsilon<Scalar> * std::abs(eta);
      const bool active = part > std::max(least, epsilon<Scalar> * epsilon<Scalar>);
      groups[std::size_t(group_count++)] = {first, i, active};
      if (active) {
        const std::size_t n = std::size_t(poles.count++);
        moment[n] = moments[i];
        poles.place[n] = largest / moments[i];
        poles.weight[n] = part * poles.place[n];
        for (int j = first; j <= i; ++j) pole[std::size_t(j)] = int(n);
      }
      i = first - 1;
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (int(i) < poles.count && int(j) < poles.count)
          poles.offset[i][j] = (moment[i] - moment[j]) / moment[i] * (largest / moment[j]);
  }

  /// m at sigma = a[origin] + tau, in principal axes; zero along axes whose pole has no weight.
  Vec3<Scalar> direction(int origin, Scalar tau) const noexcept {
    Vec3<Scalar> m(0, 0, 0);
    for (int i = 0; i < 3; ++i)
      if (const int j = pole[std::size_t(i)]; j >= 0)
        m[i] = along[i] * poles.place[std::size_t(j)] / (poles.offset[std::size_t(origin)][std::size_t(j)] - tau);
    return m;
  }

  /// Components of m along the active axes at the place of an inactive group, and phi there with its rounding.
  struct OnGroup {
    Vec3<Scalar> m{0, 0, 0};
    Scalar phi = -1, rounding = 0;
  };
  OnGroup on(const SteadyGroup& group) const noexcept {
    OnGroup at;
    const Scalar own = moments[group.last], a = largest / own;
    for (int i = 0; i < 3; ++i)
      if (pole[std::size_t(i)] >= 0) {
        // 1 - theta_i/theta_g by a difference of moments
        at.m[i] = along[i] * own / (own - moments[i]);
        at.phi += at.m[i] * at.m[i];
        const Scalar d = largest / moments[i] - a;
        at.rounding += 8 * epsilon<Scalar> * at.m[i] * at.m[i] * (1 + a * a / std::abs(d));
      }
    return at;
  }
};

/// Finds all steady rotations, in three parts.
template <Real Scalar>
class SteadySearch {
 public:
  SteadySearch(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm, Scalar eta) noexcept
      : gyrostat_(gyrostat), l_(momentum_norm), axes_(gyrostat, eta) {}

  int poles() const noexcept { return axes_.poles.count; }
  const SteadyRotations<Scalar>& found() const noexcept { return all_; }

  /// On the places of groups without weight: a pair m_i = +-sqrt(-phi), or a circle where the moment is not simple.
  void on_groups() noexcept {
    for (int g = 0; g < axes_.group_count; ++g) {
      const SteadyGroup& group = axes_.groups[std::size_t(g)];
      if (group.active) continue;
      auto [m, phi, rounding] = axes_.on(group);
      merged_[std::size_t(g)] = std::abs(phi) <= rounding;
      if (phi >= 0 || merged_[std::size_t(g)]) continue;
      const int index = 2 - group.last;  // poles to the left
      const Scalar part = std::sqrt(-phi);
      if (group.multiplicity() == 1) {
        for (const Scalar sign : {Scalar(1), Scalar(-1)}) {
          m[group.first] = sign * part;
          put(m, l_ / axes_.moments[group.first], index, true);
        }
      } else {
        m[group.first] = part;
        (group.multiplicity() == 2 ? all_.circle : all_.sphere) = true;
        put(m, l_ / axes_.moments[group.last], -1, false);
      }
    }
  }

  /// One root beyond each of the outer poles.
  void outside() noexcept {
    const SteadyPoles<Scalar>& poles = axes_.poles;
    const int last = poles.count - 1;
    Scalar left = 0, right = 0;  // |m| >= 1 there, by one term alone
    for (int j = 0; j < poles.count; ++j) {
      left = std::max(left, poles.weight[std::size_t(j)] - poles.offset[0][std::size_t(j)]);
      right = std::max(right, poles.weight[std::size_t(j)] + poles.offset[std::size_t(last)][std::size_t(j)]);
    }
    put_root(0, -poles.root(0, -1, left, infinity<Scalar>, left), true, false);
    put_root(last, poles.root(last, 1, right, infinity<Scalar>, right), false, false);
  }

  /// Two roots between the poles p and p + 1, or one where they merge, or none.
  void between(int p) noexcept {
    const SteadyPoles<Scalar>& poles = axes_.poles;
    const int q = p + 1;
    const Scalar gap = poles.offset[std::size_t(p)][std::size_t(q)];
    const Scalar low_p = poles.weight[std::size_t(p)], low_q = poles.weight[std::size_t(q)];
    if (low_p + low_q >= gap) return;
    const Scalar cube_p = std::cbrt(low_p * low_p), cube_q = std::cbrt(low_q * low_q);
    const Scalar sum = cube_p + cube_q;
    // without the third pole |m|^2 is sum^3/gap^2 at its least
    if (sum * sum * sum > gap * gap * (1 + Scalar(1e-6L))) return;
    const auto least = poles.least_between(p, cube_p, cube_q);
    const auto there = poles.sums(least.origin, least.tau);
    const Scalar phi = there.second - 1, tolerance = poles.rounding(least.origin, least.tau);
    if (phi > tolerance) return;
    if (phi >= -tolerance) {
      put_root(least.origin, least.tau, false, true);
      return;
    }
    // half the distance of the two roots, by the parabola of 1/|m|
    const Scalar g = 1 / std::sqrt(there.second);
    const Scalar half = std::sqrt(2 * (g - 1) / (3 * g * g * g * there.fourth));
    const Scalar own = std::abs(least.tau), other = gap - own;
    for (const int side : {1, -1}) {
      const int near = side > 0 ? p : q;
      const Scalar outer = poles.weight[std::size_t(near)], inner = least.origin == near ? own : other;
      if (inner > gap / 2 && outer < gap / 2 && poles.sums(near, side > 0 ? gap / 2 : -gap / 2).second > 1) {
        const int far = side > 0 ? q : p;  // the root is closer to this pole
        const Scalar end = least.origin == far ? own : other;
        const Scalar t = poles.root(far, -side, gap / 2, end, end + half < gap / 2 ? end + half : gap / 2);
        put_root(far, side > 0 ? -t : t, side < 0, false);
      } else {
        const Scalar t = poles.root(near, side, outer, inner, inner - half > outer ? inner - half : outer);
        put_root(near, side > 0 ? t : -t, side < 0, false);
      }
    }
  }

 private:
  /// m_P: in principal axes; index: of the SteadyType, -1 for degenerate.
  void put(const Vec3<Scalar>& m_P, Scalar rate, int index, bool isolated) noexcept {
    SteadyRotation<Scalar> r;
    r.direction = (gyrostat_.R_BP() * m_P).normalized();
    r.spin_rate = rate;
    r.isolated = isolated;
    if (isolated && index >= 0) {
      r.type = SteadyType(index);
      polish(gyrostat_, l_, r);
    }
    r.level = r.spin_rate * r.spin_rate * r.direction.dot(gyrostat_.inertia() * r.direction) / 2;
    int at = all_.count++;
    for (; at > 0 && all_.at[std::size_t(at - 1)].spin_rate > r.spin_rate; --at)
      all_.at[std::size_t(at)] = all_.at[std::size_t(at - 1)];
    all_.at[std::size_t(at)] = r;
  }

  /// A root of phi. Its type follows from the poles to the left, with those of groups without weight, and the sign of phi'.
  void put_root(int origin, Scalar tau, bool rising, bool fold) noexcept {
    const SteadyPoles<Scalar>& poles = axes_.poles;
    const Scalar sigma = poles.place[std::size_t(origin)] + tau;
    int left = 0;
    for (int g = 0; g < axes_.group_count; ++g) {
      const SteadyGroup& group = axes_.groups[std::size_t(g)];
      const int j = axes_.pole[std::size_t(group.last)];
      const Scalar a = axes_.largest / axes_.moments[group.last];
      const Scalar from = j >= 0 ? poles.offset[std::size_t(origin)][std::size_t(j)] - tau : a - sigma;
      if (from < 0) left += group.multiplicity();
      if (merged_[std::size_t(g)] && std::abs(from) <= std::sqrt(epsilon<Scalar>) * a) fold = true;
    }
    put(axes_.direction(origin, tau), l_ * sigma / axes_.largest, fold ? -1 : left - 1 + int(rising), true);
  }

  const Gyrostat<Scalar>& gyrostat_;
  Scalar l_;
  SteadyAxes<Scalar> axes_;
  std::array<bool, 3> merged_{};  // a root of phi lies on this group's place to rounding
  SteadyRotations<Scalar> all_;
};

}  // namespace detail

/// All steady rotations with |H| = momentum_norm, N m s. None where it is zero, negative or not finite, or so small that
/// h/|H| overflows. Direction to 1e-14 and spin rate to 1e-14 relative (double) away from folds; at a distance d from a fold, relative
/// in h, the loss is a factor 1/sqrt(d). A pair that is closer to its fold than rounding of theta and e moves it is one entry.
template <Real Scalar>
SteadyRotations<Scalar> steady_rotations(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept {
  const Scalar l = momentum_norm, eta = gyrostat.target_momentum() / l;
  if (!(l > 0) || !std::isfinite(l) || !std::isfinite(eta)) return {};
  detail::SteadySearch<Scalar> search(gyrostat, l, eta);
  search.on_groups();
  if (search.poles() > 0) search.outside();
  for (int p = 0; p + 1 < search.poles(); ++p) search.between(p);
  return search.found();
}

}  // namespace gyrostat::rotor
