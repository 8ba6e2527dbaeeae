// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"

namespace gyrostat::math {

namespace detail {

template <Real Scalar>
struct InverseFactorials {
  static constexpr int count = 64;
  Scalar value[count];
  Scalar reciprocal[count];  ///< 1/k; at 0: 1
};

template <Real Scalar>
inline constexpr InverseFactorials<Scalar> inverse_factorials = [] {
  InverseFactorials<Scalar> f{};
  long double product = 1;
  for (int k = 0; k < InverseFactorials<Scalar>::count; ++k) {
    if (k > 0) product *= static_cast<long double>(k);
    f.value[k] = static_cast<Scalar>(1 / product);
    f.reciprocal[k] = k == 0 ? Scalar(1) : static_cast<Scalar>(1 / static_cast<long double>(k));
  }
  return f;
}();

}  // namespace detail

/// Divided differences of x -> e^(t x) over `nodes` fixed complex nodes a_i and up to `zeros` further nodes at 0, for any
/// t (docs/spinning.md, section 4.1). With [0^k, S] over k zeros and the nodes of S,
///     [0^k] = t^(k-1)/(k-1)!,   [a] = e^(t a),   d/dt [0^(k+1), S] = [0^k, S],   (d/dt - a)[S, a] = [S],
/// and [0^k, a] = t^k phi_k(t a). Nodes may coincide: nothing is ever divided by a difference that is small against 1/t.
/// A set whose nodes lie within a few 1/t is summed as a Taylor series; any other is the difference quotient over its
/// farthest pair. Which pair that is does not depend on t and is settled at construction. Error: a few eps of
/// t^(n-1)/(n-1)! max |e^(t a_i)| for n nodes, and the error of the exponentials handed in.
template <Real Scalar, int nodes, int zeros>
class ExpDifferences {
  static_assert(nodes >= 1 && zeros >= 0 && (zeros + 1) << nodes <= 64);

 public:
  using Value = Complex<Scalar>;
  using Set = unsigned;           ///< bit i: node i is a member
  using Entries = std::uint64_t;  ///< a set of divided differences
  static constexpr int sets = 1 << nodes;

  static constexpr Entries entry(int k, Set s) noexcept { return Entries(1) << (s * Set(zeros + 1) + Set(k)); }

  /// The divided differences found, those asked for among them.
  struct Table {
    Value values[sets][zeros + 1];
    const Value& operator()(int k, Set s) const noexcept { return values[s][k]; }
  };

  ExpDifferences() = default;

  /// Nodes in units of 1/t; may be wider than Scalar: their differences are then rounded once.
  template <Real Wider>
  ExpDifferences(const std::array<Complex<Wider>, nodes>& a, Entries wanted) noexcept {
    Split pairs[nodes][nodes + 1];  // the last: with the node 0
    for (int i = 0; i < nodes; ++i) {
      node_[i] = complex_cast<Scalar>(a[std::size_t(i)]);
      for (int j = 0; j < i; ++j) pairs[i][j] = Split(a[std::size_t(i)] - a[std::size_t(j)], 1u << i, 1u << j);
      pairs[i][nodes] = Split(a[std::size_t(i)], 1u << i, 0);
    }
    for (Set s = 0; s < sets; ++s) {
      wanted_[s] = static_cast<std::uint8_t>((wanted >> (s * Set(zeros + 1))) & ((1u << (zeros + 1)) - 1));
      for (int i = 0; i < nodes; ++i) {
        if (!(s >> i & 1)) continue;
        for (int j = 0; j < i; ++j)
          if ((s >> j & 1) && !(pairs[i][j].spread < alone_[s].spread)) alone_[s] = pairs[i][j];
        if (!(pairs[i][nodes].spread < with_zero_[s].spread)) with_zero_[s] = pairs[i][nodes];
      }
      radius_[s] = with_zero_[s].spread;
      if (alone_[s].spread > with_zero_[s].spread) with_zero_[s] = alone_[s];
    }
  }

  /// exponential[i] = e^(t a_i), t of either sign. About 10 ns for each entry far apart, 50 to 100 ns for each series.
  void evaluate(Scalar t, const std::array<Value, nodes>& exponential, Table& f) const noexcept {
    const Scalar length = std::abs(t);
    std::uint8_t need[sets], combine[sets], found[sets];
    for (Set s = 0; s < sets; ++s) {
      need[s] = wanted_[s];
      combine[s] = found[s] = 0;
    }
    f.values[0][0] = {0, 0};
    Scalar power = 1;
    for (int k = 1; k <= zeros; ++k) {
      f.values[0][k] = {power * detail::inverse_factorials<Scalar>.value[k - 1], 0};
      power *= t;
    }
    for (Set s = sets - 1; s > 0; --s) {
      const int members = std::popcount(s);
      for (int k = zeros; k >= 0; --k) {
        const unsigned bit = 1u << k;
        if (!(need[s] & bit) || (found[s] & bit)) continue;
        const int count = members + k;
        if (count == 1) {
          f.values[s][0] = exponential[std::size_t(std::countr_zero(s))];
          continue;
        }
        const Split& split = k > 0 ? with_zero_[s] : alone_[s];
        if (length * split.spread <= reach(count)) {
          if (k > 0) {
            series(s, t, f);
            found[s] = static_cast<std::uint8_t>(found[s] | all_with_zero);
            found[prefix(s)] = static_cast<std::uint8_t>(found[prefix(s)] | all_with_zero);
          } else {
            series_alone(s, t, exponential, f);
          }
          continue;
        }
        combine[s] = static_cast<std::uint8_t>(combine[s] | bit);
        const unsigned other = split.second == 0 ? bit >> 1 : bit;
        need[s ^ split.first] = static_cast<std::uint8_t>(need[s ^ split.first] | bit);
        need[s ^ split.second] = static_cast<std::uint8_t>(need[s ^ split.second] | other);
      }
    }
    for (Set s = 1; s < sets; ++s) {
      if (combine[s] == 0) continue;
      if (combine[s] & 1) {
        const Split& split = alone_[s];
        f.values[s][0] = split.inverse * (f.values[s ^ split.second][0] - f.values[s ^ split.first][0]);
      }
      for (int k = 1; k <= zeros; ++k) {
        if (!(combine[s] >> k & 1)) continue;
        const Split& split = with_zero_[s];
        const Value& with_first = f.values[s ^ split.second][split.second == 0 ? k - 1 : k];
        f.values[s][k] = split.inverse * (with_first - f.values[s ^ split.first][k]);
      }
    }
  }

 private:
  /// The farthest pair of a set: spread and inverse of a_first - a_second, each a set of one; second empty: the node 0.
  struct Split {
    Scalar spread = 0;
    Value inverse;
    Set first = 0, second = 0;

    Split() = default;
    template <Real Wider>
    Split(Complex<Wider> apart, Set i, Set j) noexcept
        : spread(magnitude(complex_cast<Scalar>(apart))),
          inverse(complex_cast<Scalar>(math::inverse(apart))),
          first(i),
          second(j) {}
  };

  static constexpr unsigned all_with_zero = ((1u << (zeros + 1)) - 1) & ~1u;

  /// t times spread up to which a series is as accurate as the quotient: of n nodes the quotients lose (n-1)!/spread^(n-1)
  /// times powers of two, the series e^(spread/2).
  static constexpr Scalar reach(int count) noexcept {
    return count <= 2 ? Scalar(1.5) : count <= 4 ? Scalar(2.5) : Scalar(3);
  }

  /// Without its last member.
  static constexpr Set prefix(Set s) noexcept { return s ^ std::bit_floor(s); }

  /// [0^k, s] and [0^k, prefix(s)] for k = 1 .. zeros, as t^n sum_m h_m(t a)/(n + m)!, n = |s| + k - 1, with the complete
  /// homogeneous symmetric polynomials h_m of the members.
  void series(Set s, Scalar t, Table& f) const noexcept {
    Value y[nodes];
    const int members = gather(s, t, y);
    with_members<nodes>(members, [&](auto count) {
      sum<count, zeros>(y, radius_[s] * std::abs(t), t, f.values[s] + 1, f.values[prefix(s)] + 1);
    });
  }

  /// [s] = e^(t a) [0, s - a without a] with its first member a.
  void series_alone(Set s, Scalar t, const std::array<Value, nodes>& exponential, Table& f) const noexcept {
    Value y[nodes];
    const int first = std::countr_zero(s);
    const int members = gather(s ^ (1u << first), t, y);
    for (int j = 0; j < members; ++j) y[j] = y[j] - t * node_[first];
    Value value[1], unused[1];
    with_members<nodes>(members,
                        [&](auto count) { sum<count, 1>(y, alone_[s].spread * std::abs(t), t, value, unused); });
    f.values[s][0] = exponential[std::size_t(first)] * value[0];
  }

  int gather(Set s, Scalar t, Value* y) const noexcept {
    int members = 0;
    for (int i = 0; i < nodes; ++i)
      if (s >> i & 1) y[members++] = t * node_[i];
    return members;
  }

  template <int n>
  struct Count {
    constexpr operator int() const noexcept { return n; }
  };

  template <int n, class F>
  static void with_members(int members, F f) noexcept {
    if constexpr (n == 1) {
      f(Count<1>{});
    } else {
      if (members == n) {
        f(Count<n>{});
      } else {
        with_members<n - 1>(members, f);
      }
    }
  }

  /// to[k-1] = [0^k, y/t], before[k-1] the same without the last of the `members` nodes, k = 1 .. top. |y_i| <= radius.
  template <int members, int top>
  static void sum(const Value* y, Scalar radius, Scalar t, Value* to, Value* before) noexcept {
    constexpr auto& table = detail::inverse_factorials<Scalar>;
    constexpr int n = members - 1;
    constexpr int terms = detail::InverseFactorials<Scalar>::count - members - top;
    Value h[members], last[top], previous[top];
    for (auto& value : h) value = {1, 0};
    for (int k = 0; k < top; ++k) {
      last[k] = {table.value[n + k + 1], 0};
      if constexpr (n > 0) previous[k] = {table.value[n + k], 0};
    }
    Scalar bound = radius;
    for (int m = 1; m < terms && bound > epsilon<Scalar> / 16; ++m) {
      h[0] = h[0] * y[0];
      for (int j = 1; j < members; ++j) h[j] = h[j - 1] + h[j] * y[j];
      for (int k = 0; k < top; ++k) {
        last[k] = last[k] + table.value[n + k + 1 + m] * h[n];
        if constexpr (n > 0) previous[k] = previous[k] + table.value[n + k + m] * h[n - 1];
      }
      bound *= radius * table.reciprocal[m + 1];
    }
    Scalar power = 1;
    for (int j = 0; j < n; ++j) power *= t;
    for (int k = 0; k < top; ++k) {
      if constexpr (n > 0) before[k] = power * previous[k];
      power *= t;
      to[k] = power * last[k];
    }
  }

  Value node_[nodes];
  Scalar radius_[sets] = {};
  Split alone_[sets], with_zero_[sets];
  std::uint8_t wanted_[sets] = {};
};

/// exp[z_0, ..., z_(n-1)], n <= 6: the divided difference of exp, (n-1)! times it a mean of exp over the convex hull of the
/// nodes. Nodes may coincide. Error: a few eps of max |e^z|/(n-1)!, and eps |z| of it for the rounding of the nodes. Exactly
/// real where the nodes are real or come in conjugate pairs.
template <std::size_t n, Real Scalar>
Complex<Scalar> exp_difference(const std::array<Complex<Scalar>, n>& z) noexcept {
  static_assert(n >= 1 && n <= 6);
  if constexpr (n == 1) {
    return exponential(z[0]);
  } else {
    std::size_t base = 0;  // all others decay against it
    for (std::size_t i = 1; i < n; ++i)
      if (z[i].re > z[base].re) base = i;
    constexpr int others = int(n) - 1;
    std::array<Complex<Scalar>, n - 1> a, exponentials;
    std::size_t at = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == base) continue;
      a[at] = z[i] - z[base];
      exponentials[at] = exponential(a[at]);
      ++at;
    }
    using Differences = ExpDifferences<Scalar, others, 1>;
    constexpr auto all = typename Differences::Set(Differences::sets - 1);
    typename Differences::Table f;
    Differences(a, Differences::entry(1, all)).evaluate(1, exponentials, f);
    Complex<Scalar> result = exponential(z[base]) * f(1, all);
    unsigned paired = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i; j < n && !(paired >> i & 1); ++j)
        if (!(paired >> j & 1) && z[i] == conjugate(z[j])) paired |= 1u << i | 1u << j;
    if (paired == (1u << n) - 1) result.im = 0;
    return result;
  }
}

}  // namespace gyrostat::math
