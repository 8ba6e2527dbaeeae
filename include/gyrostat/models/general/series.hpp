// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/math/series.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/table.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Power series of vectors and of what is known over time, for the steps of the full equations: coefficients of (s/unit)^k.
namespace gyrostat::general {

/// A row of three numbers and a zero.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> row(const Vec3<Scalar>& v) noexcept {
  return lanes(v[0], v[1], v[2], Scalar(0));
}

/// 1/n, n up to that of the highest order: a division would be waited for.
template <Real Scalar>
GYROSTAT_INLINE Scalar one_over(int n) noexcept {
  static constexpr auto table = [] {
    std::array<Scalar, 1024> made{};
    for (std::size_t i = 1; i < made.size(); ++i) made[i] = 1 / Scalar(i);
    return made;
  }();
  return table[std::size_t(n)];
}

/// A matrix by its columns.
template <Real Scalar>
struct Columns {
  Lanes<Scalar> of[3] = {lanes(Scalar(0)), lanes(Scalar(0)), lanes(Scalar(0))};

  Columns() = default;
  explicit Columns(const Mat3<Scalar>& m) noexcept {
    for (int j = 0; j < 3; ++j) of[j] = row<Scalar>(m.col(j));
  }
  /// m v + rest
  GYROSTAT_INLINE Lanes<Scalar> times(const Lanes<Scalar>& v, const Lanes<Scalar>& rest) const noexcept {
    return multiply_add(of[0], shuffle<0, 0, 0, 0>(v),
                        multiply_add(of[1], shuffle<1, 1, 1, 1>(v), multiply_add(of[2], shuffle<2, 2, 2, 2>(v), rest)));
  }
  GYROSTAT_INLINE Lanes<Scalar> operator*(const Lanes<Scalar>& v) const noexcept { return times(v, lanes(Scalar(0))); }
};

/// The coefficients of a vector, and beside each (v2, v3, v1), with which products are made.
template <Real Scalar, int Order>
struct VectorSeries {
  Lanes<Scalar> v[Order + 1];
  Lanes<Scalar> turned[Order + 1];

  GYROSTAT_INLINE void set(int k, const Lanes<Scalar>& value) noexcept {
    v[k] = value;
    turned[k] = shuffle<1, 2, 0, 3>(value);
  }
};

/// a x b of two vectors with their (v2, v3, v1), still to be turned itself: shuffle<1, 2, 0, 3> of sums of these are sums of products.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> half_cross(const Lanes<Scalar>& a, const Lanes<Scalar>& a_turned, const Lanes<Scalar>& b,
                                         const Lanes<Scalar>& b_turned, const Lanes<Scalar>& rest) noexcept {
  return multiply_add(a, b_turned, rest - a_turned * b);
}

template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> cross_rows(const Lanes<Scalar>& a, const Lanes<Scalar>& b) noexcept {
  return shuffle<1, 2, 0, 3>(half_cross(a, shuffle<1, 2, 0, 3>(a), b, shuffle<1, 2, 0, 3>(b), lanes(Scalar(0))));
}

/// Coefficient k of the squares of all four numbers of a row. Index: an integral constant, so that everything unrolls, or an int.
template <class Index, Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> square_term(const Lanes<Scalar>* a, Index k) noexcept {
  Lanes<Scalar> sum = lanes(Scalar(0));
  count_down<Scalar>((k - 1) / 2, [&](int j) GYROSTAT_INLINE_LAMBDA { sum = multiply_add(a[j], a[k - j], sum); });
  if (k > 0) sum = multiply_add(a[0], a[k], sum);
  sum = sum + sum;
  return k % 2 == 0 ? multiply_add(a[k / 2], a[k / 2], sum) : sum;
}

/// Coefficient k of the products of the numbers of two rows, the newest last.
template <class Index, Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> product_term(const Lanes<Scalar>* a, const Lanes<Scalar>* b, Index k) noexcept {
  Lanes<Scalar> sum[2] = {lanes(Scalar(0)), lanes(Scalar(0))};
  count_down<Scalar>(k - 1,
                     [&](int j) GYROSTAT_INLINE_LAMBDA { sum[j % 2] = multiply_add(a[j], b[k - j], sum[j % 2]); });
  if (k > 0) sum[1] = multiply_add(a[0], b[k], sum[1]);
  return multiply_add(a[k], b[0], sum[0]) + sum[1];
}

/// Coefficient k of a x b.
template <Real Scalar, int Order>
Lanes<Scalar> cross_term(const VectorSeries<Scalar, Order>& a, const VectorSeries<Scalar, Order>& b, int k) noexcept {
  Lanes<Scalar> first = lanes(Scalar(0)), second = first;
  const auto add = [&](int j) GYROSTAT_INLINE_LAMBDA {
    first = multiply_add(a.v[j], b.turned[k - j], first);
    second = multiply_add(a.turned[j], b.v[k - j], second);
  };
  // the newest ones last
  for (int j = 1; j < k; ++j) add(j);
  if (k > 0) add(k);
  add(0);
  return shuffle<1, 2, 0, 3>(first - second);
}

/// v x J v of a vector v and a symmetric J, by the products of the numbers of v: one convolution where J is diagonal, else one and a half, in
/// place of the two of a cross product.
template <Real Scalar>
struct ShapeTorque {
  Columns<Scalar> mixed, squares;  ///< by (v1 v2, v2 v3, v3 v1), and by (v1^2, v2^2, v3^2)
  bool has_squares = false;

  ShapeTorque() = default;
  explicit ShapeTorque(const Mat3<Scalar>& J) noexcept {
    Mat3<Scalar> pairs, own;
    for (int i = 0; i < 3; ++i) {
      const Vec3<Scalar> a = Vec3<Scalar>::Unit(i), b = Vec3<Scalar>::Unit((i + 1) % 3);
      pairs.col(i) = cross<Scalar>(a, J * b) + cross<Scalar>(b, J * a);
      own.col(i) = cross<Scalar>(a, J * a);
    }
    mixed = Columns<Scalar>(pairs), squares = Columns<Scalar>(own);
    has_squares = !own.isZero(0);
  }

  /// Coefficient k.
  template <class Index, int Order>
  GYROSTAT_INLINE Lanes<Scalar> operator()(const VectorSeries<Scalar, Order>& v, Index k) const noexcept {
    const Lanes<Scalar> torque = mixed * product_term(v.v, v.turned, k);
    return has_squares ? squares.times(square_term(v.v, k), torque) : torque;
  }
};

/// A number over time, with coefficients up to `last`.
template <Real Scalar, int Order>
struct NumberSeries {
  Scalar c[Order + 1];
  int last = 0;

  void set_constant(Scalar value) noexcept { c[0] = value, last = 0; }
  /// A cubic about the begin of the step.
  void set(const Cubic<Scalar>& cubic, Scalar unit) noexcept {
    Scalar scale = 1;
    for (int i = 0; i < 4; ++i, scale *= unit) c[i] = cubic.c[static_cast<std::size_t>(i)] * scale;
    for (last = 3; last > 0 && c[last] == 0;) --last;
  }
  /// The same times sin(rate t + phase).
  void set(const Cubic<Scalar>& cubic, Scalar unit, Scalar rate, Scalar phase) noexcept {
    const Scalar turn = rate * unit;
    const auto first = clock_angle(rate, cubic.origin, phase);
    const auto wave = [&](Scalar(&s)[Order + 1], Scalar size) noexcept {
      s[0] = size * first.sine, s[1] = size * (turn * first.cosine);
      for (int k = 2; k <= Order; ++k) s[k] = -turn * turn * one_over<Scalar>(k * (k - 1)) * s[k - 2];
    };
    NumberSeries factor;
    factor.set(cubic, unit);
    if (factor.last == 0) {
      wave(c, factor.c[0]);
    } else {
      Scalar s[Order + 1];
      wave(s, 1);
      for (int k = 0; k <= Order; ++k) c[k] = factor.times(s, k);
    }
    last = Order;
  }
  /// Coefficient k of this times the series a of numbers or rows.
  Scalar times(const Scalar* a, int k) const noexcept {
    Scalar sum = 0;
    for (int j = std::min(last, k); j >= 0; --j) sum += c[j] * a[k - j];
    return sum;
  }
  Lanes<Scalar> times(const Lanes<Scalar>* a, int k) const noexcept {
    Lanes<Scalar> sum = lanes(Scalar(0)), other = sum;
    int j = std::min(last, k);
    for (; j >= 1; j -= 2) {
      sum = multiply_add(lanes(c[j]), a[k - j], sum);
      other = multiply_add(lanes(c[j - 1]), a[k - j + 1], other);
    }
    if (j == 0) sum = multiply_add(lanes(c[0]), a[k], sum);
    return sum + other;
  }
};

/// The orbit from t on: rate of turning times unit, and gradient N.
template <Real Scalar, int Order>
struct OrbitSeries {
  NumberSeries<Scalar, Order> rate, gradient;

  void set(const Orbit<Scalar>& orbit, const OrbitPoint<Scalar>& at, Scalar unit) noexcept {
    if (orbit.eccentricity == 0) {
      rate.set_constant(unit * at.rate);
      gradient.set_constant(at.gradient);
    } else {
      set_eccentric(at, unit);
    }
  }
  /// The cosine of the angle between the radius and a direction, which is `at` at t.
  NumberSeries<Scalar, Order> cosine_of(const OrbitPoint<Scalar>& at, const Vec3<Scalar>& m) const noexcept {
    NumberSeries<Scalar, Order> cosine;
    Scalar out[Order + 1], on[Order + 1];  // m.radial, m.along
    out[0] = m.dot(at.radial), on[0] = m.dot(at.along);
    for (int k = 0; k < Order; ++k) {
      out[k + 1] = rate.times(on, k) * one_over<Scalar>(k + 1);
      on[k + 1] = -rate.times(out, k) * one_over<Scalar>(k + 1);
    }
    std::copy(out, out + Order + 1, cosine.c);
    cosine.last = Order;
    return cosine;
  }

 private:
  /// By y = r/r(t): y'' = n^2 (z^3 - z^2 mu/(r^3 n^2)) with z = 1/y, n and r those at t; rate n z^2, gradient N z^3.
  void set_eccentric(const OrbitPoint<Scalar>& at, Scalar unit) noexcept {
    const Scalar turn = unit * at.rate, centrifugal = turn * turn, pull = unit * unit * at.gradient / 3;
    Scalar y[Order + 2], z[Order + 1], square[Order + 1], cube[Order + 1];
    y[0] = 1, y[1] = unit * at.radial_rate / at.radius;
    for (int k = 0; k <= Order; ++k) {
      z[k] = math::quotient(Scalar(k == 0 ? 1 : 0), y, z, k, Scalar(1));
      square[k] = math::square(z, k);
      cube[k] = math::product(z, square, k);
      rate.c[k] = turn * square[k];
      gradient.c[k] = at.gradient * cube[k];
      if (k + 2 <= Order) y[k + 2] = (centrifugal * cube[k] - pull * square[k]) * one_over<Scalar>((k + 1) * (k + 2));
    }
    rate.last = gradient.last = Order;
  }
};

}  // namespace gyrostat::general
