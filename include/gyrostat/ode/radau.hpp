// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"

namespace gyrostat::ode {

/// A system y' = f(t, y, p) with more unknowns p that relax linearly and may do so at any speed: p_i' = -rate_i p_i + source_i(t, y), with
/// constant rates >= 0.
/// * `Scalar`; `width` and `relaxing`: the numbers of components of y and p. A state is y and, behind it, p.
/// * `rate(i)`, 1/s.
/// * `Moment` and `moment(t)`: what depends on the time alone, of four times side by side.
/// * `sources(moment, y, source)` and `rates(moment, y, p, rate)`: of four states side by side, y[c] holding component c of each.
/// * `forcing()`, where something depends on the time: the greatest rate at which it swings, rad/s.
template <class System>
concept RelaxingSystem =
    Real<typename System::Scalar> && (System::width > 0) && (System::relaxing > 0) &&
    requires(const System& system, const typename System::Moment& moment, const Lanes<typename System::Scalar>& t,
             const Lanes<typename System::Scalar>* y, Lanes<typename System::Scalar>* rate) {
      { system.rate(0) } noexcept -> std::convertible_to<typename System::Scalar>;
      { system.moment(t) } noexcept -> std::same_as<typename System::Moment>;
      { system.sources(moment, y, rate) } noexcept;
      { system.rates(moment, y, y, rate) } noexcept;
    };

namespace detail {

/// The Radau IIA method of eight stages, order 15 (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5): collocation
/// at the zeros of P_8(2c - 1) - P_7(2c - 1). Tables over stages i are contiguous.
template <Real Scalar>
struct RadauTable {
  Scalar node[8];               ///< c_i, ascending; c_7 = 1
  Scalar matrix[8][8];          ///< [j][i]: integral of l_j from 0 to c_i, l_j the Lagrange polynomials
  Scalar weight[8];             ///< b_j, the last row of the matrix
  Scalar weight_low[8];         ///< what rounding leaves over: without it all frequencies would be off by some of it
  Scalar inverse[8][8];         ///< [j][i]: the inverse of the matrix, element (i, j)
  Scalar barycentric[8];        ///< 1/prod(c_j - c_m)
  Scalar legendre[8][8];        ///< [k][j]: (2k+1) b_j P_k(2c_j - 1): values at the nodes to Legendre coefficients
  Scalar tail[8][4];            ///< [j][k]: the last four of these, k = 4 ... 7
  Scalar tail_of_values[8][4];  ///< the same of the derivative, from values less the one at the start
  Scalar tail_size[4];          ///< the magnitudes of these, summed over j
};

/// P_0 ... P_8 at x = 2c - 1.
constexpr std::array<long double, 9> legendre_values(long double x) noexcept {
  std::array<long double, 9> P{1, x};
  for (std::size_t k = 2; k < 9; ++k) {
    const auto n = static_cast<long double>(k);
    P[k] = ((2 * n - 1) * x * P[k - 1] - (n - 1) * P[k - 2]) / n;
  }
  return P;
}

template <Real Scalar>
constexpr RadauTable<Scalar> radau_table() noexcept {
  constexpr long double c[8] = {0.0224793864387124981088254995708450599L, 0.114679053160904231909640237067514627L,
                                0.265789822784589468476789391693389997L,  0.452846373669444616998551442347651145L,
                                0.647375282886830362626092229828758797L,  0.819759308263107635012420057190818215L,
                                0.943737439463077853534347808967688824L,  1.0L};
  // Gauss's four points on (-1, 1), exact for the polynomials l_j
  constexpr long double x[4] = {-0.861136311594052575223946488892809505L, -0.339981043584856264802665759103244687L,
                                0.339981043584856264802665759103244687L, 0.861136311594052575223946488892809505L};
  long double matrix[8][8]{}, inverse[8][8]{}, legendre[8][8]{};  // [i][j], [i][j], [k][j]
  RadauTable<Scalar> table{};
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      for (int g = 0; g < 4; ++g) {
        // weight 2/((1 - x^2) P_4'(x)^2), halved for an interval of length 1
        const auto P = legendre_values(x[g]);
        const long double slope = 4 * (P[3] - x[g] * P[4]) / (1 - x[g] * x[g]);
        const long double at = c[i] * (1 + x[g]) / 2;
        long double value = c[i] / ((1 - x[g] * x[g]) * slope * slope);
        for (int m = 0; m < 8; ++m) value *= m == j ? 1 : (at - c[m]) / (c[j] - c[m]);
        matrix[i][j] += value;
      }
    }
  }
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      // the derivative at c_i of the polynomial that is 1 at c_j and 0 at 0 and at the other nodes
      if (i == j) {
        inverse[i][i] = 1 / c[i];
        for (int m = 0; m < 8; ++m) inverse[i][i] += m == i ? 0 : 1 / (c[i] - c[m]);
      } else {
        inverse[i][j] = c[i] / (c[j] * (c[j] - c[i]));
        for (int m = 0; m < 8; ++m) inverse[i][j] *= m == i || m == j ? 1 : (c[i] - c[m]) / (c[j] - c[m]);
      }
    }
  }
  for (int j = 0; j < 8; ++j) {
    const auto P = legendre_values(2 * c[j] - 1);
    long double product = 1;
    for (int m = 0; m < 8; ++m) product *= m == j ? 1 : c[j] - c[m];
    table.node[j] = static_cast<Scalar>(c[j]);
    table.weight[j] = static_cast<Scalar>(matrix[7][j]);
    table.weight_low[j] = static_cast<Scalar>(matrix[7][j] - static_cast<long double>(table.weight[j]));
    table.barycentric[j] = static_cast<Scalar>(1 / product);
    for (int k = 0; k < 8; ++k) legendre[k][j] = (2 * k + 1) * matrix[7][j] * P[static_cast<std::size_t>(k)];
  }
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      table.matrix[j][i] = static_cast<Scalar>(matrix[i][j]);
      table.inverse[j][i] = static_cast<Scalar>(inverse[i][j]);
      table.legendre[i][j] = static_cast<Scalar>(legendre[i][j]);
    }
    for (int k = 0; k < 4; ++k) {
      long double sum = 0;
      for (int i = 0; i < 8; ++i) sum += legendre[4 + k][i] * inverse[i][j];
      table.tail[j][k] = static_cast<Scalar>(legendre[4 + k][j]);
      table.tail_of_values[j][k] = static_cast<Scalar>(sum);
      table.tail_size[k] += static_cast<Scalar>(sum < 0 ? -sum : sum);
    }
  }
  return table;
}

template <Real Scalar>
inline constexpr RadauTable<Scalar> radau = radau_table<Scalar>();

}  // namespace detail

/// Width: of y and p; the scales of p stand behind those of y.
template <Real Scalar, int Width>
struct RadauOptions {
  /// Error that one step may leave in its end, relative to scale. These errors add up.
  Scalar tolerance = epsilon<Scalar>;
  /// Error that p, and y inside the step (at), may have, relative to scale. These errors do not add up. 0: 1000 tolerance. More than 10^4
  /// tolerance is cut down to that: errors of p beyond it would be felt at the ends.
  Scalar inside = 0;
  /// The size against which the error of each component is measured; 0 leaves a component out.
  std::array<Scalar, Width> scale{};
  /// Rounding of p at the stages, in eps of p: its coefficients show it and no shorter step lessens it, so that much of them is ignored.
  Scalar blur = 0;
  Scalar first_step = 0;  ///< 0: chosen from the rates at the start
  /// Factor on the first step and on steps limited by the sweeps, below 1 for a run that is compared with another: where these and not the tolerance set the
  /// steps, both would take the same and err alike.
  Scalar pace = 1;
  std::uint64_t step_cap = 100'000'000;
  bool projected = true;  ///< project after every step, where the system can
};

/// Integrates a relaxing system by Radau IIA collocation of order 15 with p eliminated exactly: its stage values are
/// p_i = p_i0 + (I + h rate_i A)^-1 h A (source_i(y) - rate_i p_i0), so that the sweeps y = y0 + h A f(y, p) converge at a pace set by h |df/dy|
/// alone, and neither they nor the step depend on the rates once p follows its sources. L-stable: a p0 off its source dies out in one
/// long step, at the accuracy that the tolerance asks for in several short ones.
///
/// The step is chosen from the Legendre coefficients a_4 ... a_7 of h y' over the step. Inside the step the error is the first
/// coefficient left out, extrapolated from these. At its end it is smaller: collocation leaves a defect orthogonal to the polynomials
/// of degree 6, so that only the same coefficient of the sensitivity counts and the error is like a_7^2. Steps whose sweeps do not
/// converge fast are shortened. Nothing is allocated, nothing throws, all loops are bounded.
template <RelaxingSystem System>
class Radau {
 public:
  using Scalar = typename System::Scalar;
  static constexpr int width = System::width;
  static constexpr int relaxing = System::relaxing;
  static constexpr int all = width + relaxing;
  static constexpr int order = 15;
  using State = std::array<Scalar, all>;
  using Options = RadauOptions<Scalar, all>;

  Radau(const System& system, Scalar t, const State& state, const Options& options) noexcept
      : system_(system), options_(options), time_{t, 0}, start_time_{t, 0} {
    for (int i = 0; i < relaxing; ++i) rate_[i] = system.rate(i);
    for (int i = 0; i < all; ++i) {
      state_[i] = start_[i] = state[static_cast<std::size_t>(i)];
      low_[i] = start_low_[i] = 0;
      const Scalar scale = options.scale[static_cast<std::size_t>(i)];
      weight_[i] = scale > 0 ? 1 / scale : Scalar(0);
      for (int j = 0; j < 8; ++j) last_[i][j] = 0;
    }
    // no tolerance below what rounding allows
    constexpr Scalar least = epsilon<Scalar> / 64;
    tolerance_ = options.tolerance > least ? options.tolerance : least;
    const Scalar inside = options.inside > 0 ? options.inside : 1000 * tolerance_;
    inside_ = std::max(std::min(inside, 10000 * tolerance_), 8 * epsilon<Scalar>);
  }

  /// One step, at most up to t_max; reached if the time is t_max already or now.
  /// Returns reached with time() < t_max after an ordinary step.
  GYROSTAT_NOINLINE Status step(Scalar t_max = infinity<Scalar>) noexcept;

  /// Steps until t_end exactly.
  Status advance(Scalar t_end) noexcept {
    Status status = Status::reached;
    while (time_.high < t_end && status == Status::reached) status = step(t_end);
    return t_end == t_end ? status : Status::not_finite;
  }

  /// As of Taylor.
  const Scalar* lost() const noexcept { return low_; }
  void regain(const Scalar* lost) noexcept {
    for (int i = 0; i < all; ++i) low_[i] = start_low_[i] = lost[i];
  }

  Scalar time() const noexcept { return time_.high; }
  /// y and p.
  const Scalar* state() const noexcept { return state_; }
  const Counts& counts() const noexcept { return counts_; }

  /// Begin of the last step; the polynomial holds from here to time().
  Scalar previous_time() const noexcept { return start_time_.high; }

  /// The state at t inside the last step, within Options::inside. Outside it the polynomial is extrapolated.
  void at(Scalar t, Scalar* state) const noexcept;

  /// at(t) plus the error that the last coefficients of each component suggest.
  void beside(Scalar t, Scalar* state) const noexcept;

 private:
  using Row = Lanes<Scalar>;
  static constexpr const detail::RadauTable<Scalar>& table = detail::radau<Scalar>;
  static constexpr int most_sweeps = 30;
  static constexpr int most_trials = 80;

  using Sum = gyrostat::Sum<Scalar>;

  static GYROSTAT_INLINE Scalar dot(const Scalar* a, const Scalar* b) noexcept {
    return sum(multiply_add(load(a), load(b), load(a + 4) * load(b + 4)))[0];
  }

  /// The last four Legendre coefficients, k = 4 ... 7, from eight stage values.
  static GYROSTAT_INLINE Row last_coefficients(const Scalar (&rows)[8][4], const Scalar* values) noexcept {
    Row a = load(rows[0]) * lanes(values[0]);
    for (int j = 1; j < 8; ++j) a = multiply_add(load(rows[j]), lanes(values[j]), a);
    return a;
  }

  /// The matrices (I + z A)^-1 h A of a step, z = h rate_i, by Gauss and Jordan's elimination. Needs no pivots: for any z >= 0 the error is
  /// of the order of rounding (condition of A: 47).
  void eliminate(Scalar h) noexcept;
  void eliminate(Scalar h, Scalar rate, Scalar (&relax)[8][8]) const noexcept;
  /// What depends on the time alone at the stages of a step.
  void look(Scalar h) noexcept;
  /// Lagrange's polynomials of the last step at the nodes of one `ratio` times as long.
  void extrapolate(Scalar ratio) noexcept;
  /// The rates at the begin of the step, in all lanes.
  void rates_here(Row (&rate)[width]) noexcept;
  /// Fills stage_ with the first guess of h y'. False if the rates at the start of the step are not finite.
  bool predict(Scalar h) noexcept;
  /// One sweep: stage_ and p_ anew; returns the size of the change of stage_.
  GYROSTAT_INLINE Scalar sweep(Scalar h) noexcept;

  enum class Sweeps : std::uint8_t { converged, slow, not_finite };
  Sweeps solve(Scalar h, Scalar rounding) noexcept;

  /// Coefficients of p without what its rounding may have made of them.
  Row clear(const Row& a, Scalar p) const noexcept {
    const Scalar blur = options_.blur * epsilon<Scalar> * std::abs(p);
    const auto left = [&](int k) noexcept { return std::max(std::abs(a[k]) - blur * table.tail_size[k], Scalar(0)); };
    return lanes(left(0), left(1), left(2), left(3));
  }

  /// Estimates the coefficients left out from the last four, given their squares summed over components.
  struct Tail {
    explicit Tail(const Row& squares) noexcept {
      const Scalar a4 = squares[0], a5 = squares[1], a6 = squares[2], a7 = squares[3];
      sum = a4 + a5 + a6 + a7;
      // how the coefficients fall, by pairs since even and odd ones may vanish in turn
      const Scalar early = std::max(a4, a5), late = std::max(a6, a7);
      const Scalar fall = early > 0 ? std::min(std::sqrt(std::sqrt(late / early)), Scalar(1)) : Scalar(0);
      tail = std::max(std::sqrt(a7), fall * std::sqrt(a6));
      inside = fall * tail / 30;
    }
    Scalar sum, tail, inside;
  };

  /// Of the next step, from the last coefficients of one that has converged.
  struct Verdict {
    Scalar factor;  ///< by which to change its length; NaN if a coefficient is not finite
    bool accurate;  ///< good enough to be accepted
  };
  GYROSTAT_INLINE Verdict judge(Scalar h, Scalar tolerance, Scalar most_inside) const noexcept;
  /// The length to begin with; NaN if the rates are not finite.
  Scalar first_step() noexcept;
  /// Moves the state to the end of a step and keeps its polynomial.
  GYROSTAT_INLINE void accept(Scalar h) noexcept;

  System system_;
  Options options_;
  Scalar rate_[relaxing];
  Scalar tolerance_, inside_, goal_;
  Sum time_, start_time_;
  Scalar wish_ = 0;         ///< the next step
  Scalar last_step_ = 0;    ///< of the polynomial in last_
  bool follow_ = false;     ///< that polynomial is a guess of the next step
  Scalar ratio_ = 0;        ///< of the matrix in forward_
  Scalar made_for_ = 0;     ///< the step of the matrix in relax_
  Scalar contraction_ = 0;  ///< of the sweeps of this step, their mean
  Counts counts_;
  alignas(32) Scalar state_[all];
  alignas(32) Scalar low_[all];
  alignas(32) Scalar start_[all];
  alignas(32) Scalar start_low_[all];
  alignas(32) Scalar weight_[all];
  alignas(32) Scalar relax_[relaxing][8][8];  ///< [j][i]
  alignas(32) Scalar forward_[8][8];          ///< [j][i]
  alignas(32) Scalar stage_[width][8];        ///< h y' at the stages of this step
  alignas(32) Scalar p_[relaxing][8];         ///< p - p0 at the stages of this step
  typename System::Moment moment_[2];         ///< at the stages of this step
  alignas(32) Scalar last_[all][8];           ///< h y' and h p' of the last accepted step
};

template <RelaxingSystem System>
void Radau<System>::eliminate(Scalar h) noexcept {
  if (h == made_for_) return;
  made_for_ = h;
  for (int i = 0; i < relaxing; ++i) eliminate(h, rate_[i], relax_[i]);
}

template <RelaxingSystem System>
void Radau<System>::eliminate(Scalar h, Scalar rate, Scalar (&relax)[8][8]) const noexcept {
  const Scalar z = h * rate;
  alignas(32) Scalar rows[8][16];
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      rows[i][j] = z * table.matrix[j][i] + (i == j ? 1 : 0);
      rows[i][8 + j] = h * table.matrix[j][i];
    }
  }
  for (int k = 0; k < 8; ++k) {
    const Row pivot = lanes(1 / rows[k][k]);
    for (int j = k / 4 * 4; j < 16; j += 4) store(&rows[k][j], load(&rows[k][j]) * pivot);
    for (int i = 0; i < 8; ++i) {
      if (i == k) continue;
      const Row factor = lanes(-rows[i][k]);
      for (int j = k / 4 * 4; j < 16; j += 4)
        store(&rows[i][j], multiply_add(factor, load(&rows[k][j]), load(&rows[i][j])));
    }
  }
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) relax[j][i] = rows[i][8 + j];
}

template <RelaxingSystem System>
void Radau<System>::look(Scalar h) noexcept {
  for (int half = 0; half < 2; ++half) {
    const Row ahead = multiply_add(lanes(h), load(&table.node[4 * half]), lanes(time_.low));
    moment_[half] = system_.moment(lanes(time_.high) + ahead);
  }
}

template <RelaxingSystem System>
void Radau<System>::rates_here(Row (&rate)[width]) noexcept {
  Row y[width], p[relaxing];
  for (int c = 0; c < width; ++c) y[c] = lanes(state_[c]);
  for (int i = 0; i < relaxing; ++i) p[i] = lanes(state_[width + i]);
  system_.rates(system_.moment(lanes(time_.high)), y, p, rate);
  ++counts_.rhs;
}

template <RelaxingSystem System>
void Radau<System>::extrapolate(Scalar ratio) noexcept {
  if (ratio == ratio_) return;
  ratio_ = ratio;
  for (int i = 0; i < 8; ++i) {
    const Scalar x = ratio * table.node[i];  // behind the end of the last step
    Scalar product = ratio;                  // h y' of the new step, not of the last one
    for (int m = 0; m < 8; ++m) product *= x + (1 - table.node[m]);
    for (int j = 0; j < 8; ++j) forward_[j][i] = product * table.barycentric[j] / (x + (1 - table.node[j]));
  }
}

template <RelaxingSystem System>
bool Radau<System>::predict(Scalar h) noexcept {
  // a polynomial is not followed far
  if (follow_ && h <= 2 * last_step_) {
    extrapolate(h / last_step_);
    for (int c = 0; c < width; ++c) {
      Row low = load(&forward_[0][0]) * lanes(last_[c][0]), high = load(&forward_[0][4]) * lanes(last_[c][0]);
      for (int j = 1; j < 8; ++j) {
        low = multiply_add(load(&forward_[j][0]), lanes(last_[c][j]), low);
        high = multiply_add(load(&forward_[j][4]), lanes(last_[c][j]), high);
      }
      store(&stage_[c][0], low);
      store(&stage_[c][4], high);
    }
    return true;
  }
  Row rate[width];
  rates_here(rate);
  Scalar finite = 0;
  for (int c = 0; c < width; ++c) {
    finite += 0 * rate[c][0];
    for (int i = 0; i < 8; i += 4) store(&stage_[c][i], lanes(h) * rate[c]);
  }
  return finite == 0;
}

template <RelaxingSystem System>
GYROSTAT_INLINE auto Radau<System>::sweep(Scalar h) noexcept -> Scalar {
  Row y[2][width];
#pragma GCC unroll 16
  for (int c = 0; c < width; ++c) {
    Row low = lanes(low_[c]), high = low;
    for (int j = 0; j < 8; ++j) {
      const Row rate = lanes(stage_[c][j]);
      low = multiply_add(load(&table.matrix[j][0]), rate, low);
      high = multiply_add(load(&table.matrix[j][4]), rate, high);
    }
    y[0][c] = lanes(state_[c]) + low;
    y[1][c] = lanes(state_[c]) + high;
  }
  Row source[2][relaxing], p[2][relaxing];
  for (int half = 0; half < 2; ++half) system_.sources(moment_[half], y[half], source[half]);
#pragma GCC unroll 8
  for (int i = 0; i < relaxing; ++i) {
    const Row p0 = lanes(state_[width + i]), pull = lanes(rate_[i]) * p0;
    alignas(32) Scalar drive[8];
    store(&drive[0], source[0][i] - pull);
    store(&drive[4], source[1][i] - pull);
    Row low = lanes(Scalar(0)), high = low;
    for (int j = 0; j < 8; ++j) {
      low = multiply_add(load(&relax_[i][j][0]), lanes(drive[j]), low);
      high = multiply_add(load(&relax_[i][j][4]), lanes(drive[j]), high);
    }
    store(&p_[i][0], low);
    store(&p_[i][4], high);
    p[0][i] = p0 + low;
    p[1][i] = p0 + high;
  }
  Row square = lanes(Scalar(0));
  for (int half = 0; half < 2; ++half) {
    Row rate[width];
    system_.rates(moment_[half], y[half], p[half], rate);
#pragma GCC unroll 16
    for (int c = 0; c < width; ++c) {
      const Row next = lanes(h) * rate[c];
      const Row change = (next - load(&stage_[c][4 * half])) * lanes(weight_[c]);
      square = multiply_add(change, change, square);
      store(&stage_[c][4 * half], next);
    }
  }
  counts_.rhs += 8;
  return std::sqrt(sum(square)[0]);
}

template <RelaxingSystem System>
auto Radau<System>::solve(Scalar h, Scalar rounding) noexcept -> Sweeps {
  Scalar first = 0, before = 0;
  for (int k = 1; k <= most_sweeps; ++k) {
    const Scalar change = sweep(h);
    if (!(change < infinity<Scalar>)) return Sweeps::not_finite;
    if (k == 1) {
      first = before = change;
      contraction_ = 0;
      // the first change may be small where the second is not: what pushes has moved, and what it moves has not
      if (change == 0) return Sweeps::converged;
      continue;
    }
    const Scalar ratio = change / before;
    // what the next sweep would change; below some roundings it changes nothing any more
    if (change * std::min(ratio, Scalar(1)) <= goal_ || (change < 256 * rounding && ratio > Scalar(0.3L))) {
      // a change of the size of rounding says nothing of the convergence
      if (const Scalar least = rounding / 4; first > least)
        contraction_ = static_cast<Scalar>(
            std::pow(static_cast<float>(std::max(change, least) / first), 1 / static_cast<float>(k - 1)));
      return Sweeps::converged;
    }
    if (k > 3 && (ratio > Scalar(0.7L))) return Sweeps::slow;
    before = change;
  }
  return Sweeps::slow;
}

template <RelaxingSystem System>
auto Radau<System>::first_step() noexcept -> Scalar {
  if (options_.first_step > 0) return options_.first_step;
  Row rate[width];
  rates_here(rate);
  Scalar greatest = 0;
  for (int c = 0; c < width; ++c) greatest += std::abs(rate[c][0]) * weight_[c];
  if (!(greatest < infinity<Scalar>)) return nan<Scalar>;
  return options_.pace * (greatest > 0 ? Scalar(0.1L) / greatest : Scalar(1));
}

template <RelaxingSystem System>
GYROSTAT_INLINE auto Radau<System>::judge(Scalar h, Scalar tolerance, Scalar most_inside) const noexcept -> Verdict {
  Row squares = lanes(Scalar(0));
  for (int c = 0; c < width; ++c) {
    const Row a = last_coefficients(table.tail, stage_[c]) * lanes(weight_[c]);
    squares = multiply_add(a, a, squares);
  }
  for (int i = 0; i < relaxing; ++i) {
    const Row a = clear(last_coefficients(table.tail_of_values, p_[i]), state_[width + i]) * lanes(weight_[width + i]);
    squares = multiply_add(a, a, squares);
  }
  const Tail left_out(squares);
  if (!(left_out.sum < infinity<Scalar>)) return {nan<Scalar>, false};
  const Scalar inside = left_out.inside, tail = left_out.tail;
  // the same coefficient of the sensitivity, 15 j_7(z/2), with z = h |df/dy| from the pace of the sweeps: A contracts tenfold
  Scalar z = 10 * contraction_;
  // what swings by itself is integrated as if the sensitivity did
  if constexpr (requires { system_.forcing(); }) z = std::max(z, h * system_.forcing());
  const Scalar sensitivity = Scalar(5.8e-8L) * z * z * z * z * z * z * z;
  const Scalar end = tail * std::max(tail, sensitivity) / 20;

  const float by_end = end > 0 ? std::log2(static_cast<float>(tolerance / end)) / 16 : 3.0F;
  const float by_inside = inside > 0 ? std::log2(static_cast<float>(most_inside / inside)) / 9 : 3.0F;
  const float by_sweeps =
      contraction_ > 0 ? std::log2(static_cast<float>(options_.pace * Scalar(0.25L) / contraction_)) : 3.0F;
  const float by = std::min({by_end - 0.2F, by_inside - 0.25F, by_sweeps, 2.0F});
  return {static_cast<Scalar>(std::exp2(std::max(by, -4.0F))), !(end > tolerance || inside > most_inside)};
}

template <RelaxingSystem System>
GYROSTAT_INLINE void Radau<System>::accept(Scalar h) noexcept {
  for (int c = 0; c < all; ++c) {
    start_[c] = state_[c];
    start_low_[c] = low_[c];
    Sum sum{state_[c], low_[c]};
    if (c < width) {
      sum = add(add(sum, dot(table.weight, stage_[c])), dot(table.weight_low, stage_[c]));
    } else {
      sum = add(sum, p_[c - width][7]);
    }
    state_[c] = sum.high;
    low_[c] = sum.low;
  }
  for (int c = 0; c < width; ++c) {
    for (int i = 0; i < 8; i += 4) store(&last_[c][i], load(&stage_[c][i]));
  }
  for (int k = 0; k < relaxing; ++k) {
    for (int i = 0; i < 8; i += 4) {
      Row rate = lanes(Scalar(0));
      for (int j = 0; j < 8; ++j) rate = multiply_add(load(&table.inverse[j][i]), lanes(p_[k][j]), rate);
      store(&last_[width + k][i], rate);
    }
  }
  last_step_ = h;
  follow_ = true;
}

template <RelaxingSystem System>
Status Radau<System>::step(Scalar t_max) noexcept {
  if (!(time_.high < t_max)) return t_max == t_max ? Status::reached : Status::not_finite;
  if (counts_.steps >= options_.step_cap) return Status::step_limit;
  if (!(wish_ > 0)) {
    const Scalar first = first_step();
    if (!(first == first)) return Status::not_finite;
    // a run beside another lands elsewhere than where that may go in one step
    wish_ = options_.pace < 1 ? std::min(first, options_.pace * (t_max - time_.high)) : first;
  }

  // rounding of a state that has outgrown its scale
  Scalar size = 1;
  for (int i = 0; i < all; ++i) size = std::max(size, std::abs(state_[i]) * weight_[i]);
  const Scalar rounding = epsilon<Scalar> * size;
  const Scalar tolerance = std::max(tolerance_, rounding / 64), most_inside = std::max(inside_, 8 * rounding);
  goal_ = std::max(tolerance_ / 4, rounding / 8);

  bool shortened = false, finite = true;
  for (int trial = 0; trial < most_trials; ++trial) {
    const Scalar left = (t_max - time_.high) - time_.low;
    const bool lands = wish_ >= left;
    const Scalar h = lands ? left : wish_;
    if (!(h < infinity<Scalar>)) return Status::not_finite;
    if (!lands && !(h > std::abs(time_.high) * (epsilon<Scalar> / 1024))) return Status::step_underflow;
    eliminate(h);
    look(h);
    if (!predict(h)) return Status::not_finite;
    const Sweeps sweeps = solve(h, rounding);
    finite = sweeps != Sweeps::not_finite;
    if (sweeps != Sweeps::converged) {
      // rates that are finite at the start are so in a shorter step
      if (!finite) follow_ = false;
      wish_ = h / 2;
      shortened = true;
      ++counts_.rejected;
      continue;
    }
    const Verdict verdict = judge(h, tolerance, most_inside);
    if (!(verdict.factor == verdict.factor)) return Status::not_finite;
    if (!verdict.accurate) {
      wish_ = h * std::min(verdict.factor, Scalar(0.9L));
      shortened = true;
      ++counts_.rejected;
      continue;
    }

    accept(h);
    start_time_ = time_;
    time_ = lands ? Sum{t_max, 0} : add(time_, h);
    ++counts_.steps;
    // the same step again where nothing is won by another, so that its matrices serve again
    const Scalar factor = verdict.factor, next = h * (shortened ? std::min(factor, Scalar(1)) : factor);
    if (!(h < wish_) || next > wish_) wish_ = factor > Scalar(0.98L) && factor < Scalar(1.1L) ? h : next;
    if constexpr (Projects<System>) {
      if (options_.projected) system_.project(time_.high, state_, low_);
    }
    return Status::reached;
  }
  return finite ? Status::step_underflow : Status::not_finite;
}

template <RelaxingSystem System>
void Radau<System>::at(Scalar t, Scalar* state) const noexcept {
  if (!(last_step_ > 0)) {
    for (int i = 0; i < all; ++i) state[i] = state_[i];
    return;
  }
  // integrals of the Legendre polynomials from 0, (P_{k+1} - P_{k-1})/(2 (2k + 1))
  const Scalar theta = ((t - start_time_.high) - start_time_.low) / last_step_;
  const Scalar x = 2 * theta - 1;
  alignas(32) Scalar weight[8];
  Row low = load(&table.legendre[0][0]) * lanes(theta), high = load(&table.legendre[0][4]) * lanes(theta);
  Scalar before = 1, now = x;
  for (int k = 1; k < 8; ++k) {
    const auto n = static_cast<Scalar>(k);
    const Scalar next = ((2 * n + 1) * x * now - n * before) / (n + 1);
    const Row integral = lanes((next - before) / (2 * (2 * n + 1)));
    low = multiply_add(load(&table.legendre[k][0]), integral, low);
    high = multiply_add(load(&table.legendre[k][4]), integral, high);
    before = now;
    now = next;
  }
  store(&weight[0], low);
  store(&weight[4], high);
  for (int i = 0; i < all; ++i) state[i] = start_[i] + (start_low_[i] + dot(weight, last_[i]));
}

template <RelaxingSystem System>
void Radau<System>::beside(Scalar t, Scalar* state) const noexcept {
  at(t, state);
  if (!(last_step_ > 0)) return;
  // at its end y is better by far
  for (int i = t < time_.high ? 0 : width; i < all; ++i) {
    Row a = last_coefficients(table.tail, last_[i]);
    if (i >= width) a = clear(a, start_[i]);
    state[i] += Tail(a * a).inside;
  }
}

}  // namespace gyrostat::ode
