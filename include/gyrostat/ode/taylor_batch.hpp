// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"
#include "gyrostat/ode/status.hpp"

namespace gyrostat::ode {

/// Problems of a batch.
inline constexpr int batch_size = 8;

/// Component by component, the same number of all problems.
template <Real Scalar, int Width>
using BatchRow = Scalar[Width][batch_size];

/// Taylor coefficients of a step of all problems: component i of problem b at its t0 + s is sum_k x[k][i][b] (s/unit[b])^k.
template <Real Scalar, int Width, int Order>
using BatchRows = Scalar[Order + 1][Width][batch_size];

/// Eight systems of first-order equations of one kind that extend their Taylor coefficients side by side. The equations do not depend
/// on the time.
/// * `Scalar`, and `width`: the length of a state.
/// * `Work<Order>`: memory for by-products, default-constructible, without heap.
/// * `expand(unit, x, work)`: x[0] are the states; fills x[1] ... x[Order] in powers of (s/unit). No lane may depend on another.
template <class System>
concept BatchSystem =
    Real<typename System::Scalar> && (System::width > 0) &&
    requires(const System& system, const typename System::Scalar (&unit)[batch_size],
             BatchRows<typename System::Scalar, System::width, 2>& x, typename System::template Work<2>& work) {
      { system.expand(unit, x, work) } noexcept;
    };

/// Systems whose states have, behind the `width` numbers that are series, numbers that stay as they are in a step and change between steps
/// alone: a frame of reference, say, of which the series are told.
/// * `carried`: how many.
/// * `settle(first, x, low, carried)`: ends a step of the problems first, first + 1, ... that fit into a Wide: x + low is where it led to.
template <class System>
concept BatchCarries =
    (System::carried > 0) && requires(const System& system, BatchRow<typename System::Scalar, System::width>& x,
                                      BatchRow<typename System::Scalar, System::carried>& carried) {
      { system.settle(0, x, x, carried) } noexcept;
    };

namespace detail {
template <class System>
inline constexpr int batch_carried = 0;
template <BatchCarries System>
inline constexpr int batch_carried<System> = System::carried;
}  // namespace detail

/// The systems know invariants and move the states x + low of the problems first, first + 1, ... that fit into a Wide onto them.
template <class System>
concept BatchProjects = requires(const System& system, BatchRow<typename System::Scalar, System::width>& x) {
  { system.project(0, x, x) } noexcept;
};

template <Real Scalar>
struct TaylorBatchOptions {
  /// Size of the last kept term relative to scale, in every step, as for ode::Taylor.
  Scalar tolerance = epsilon<Scalar>;
  std::uint64_t step_cap = 100'000'000;  ///< for each problem
  bool projected = true;                 ///< project after every step, where the systems can
};

namespace detail {

/// log2 of a normal positive number, within 1.2e-4: interpolation at Chebyshev's nodes on [1, 2).
GYROSTAT_INLINE float near_log2(float x) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto exponent = static_cast<float>(static_cast<std::int32_t>(bits >> 23U) - 127);
  const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U) - 1.5F;
  return exponent + (0.5849625F + m * (0.960974F + m * (-0.3201395F + m * (0.1553881F - 0.0784407F * m))));
}

/// 2^x within 4e-6 of itself; 2^120 or 2^-120 outside these.
GYROSTAT_INLINE float near_exp2(float x) noexcept {
  x = x < 120.0F ? x : 120.0F;
  x = x > -120.0F ? x : -120.0F;
  const auto whole = static_cast<std::int32_t>(x + 127.5F);  // positive, so that cutting off rounds to the nearest
  const float r = x - static_cast<float>(whole - 127);
  const float power = std::bit_cast<float>(static_cast<std::uint32_t>(whole) << 23U);
  return power * (1.0F + r * (0.693121F + r * (0.2402235F + r * (0.055922F + r * 0.0096664F))));
}

}  // namespace detail

/// ode::Taylor for eight problems at once, one in each lane of the vector registers, each with its own time, step and end. The lanes do
/// not see each other: a problem that fails or ends early stays as it is while the others go on. For many problems, replace those that
/// have ended (start) and go on stepping. Nothing is allocated, nothing throws.
template <BatchSystem System, int Order = 20>
class TaylorBatch {
  static_assert(Order >= 4);

 public:
  using Scalar = typename System::Scalar;
  static constexpr int width = System::width;
  static constexpr int order = Order;
  static constexpr int size = batch_size;
  static constexpr int carried = detail::batch_carried<System>;
  using State = std::array<Scalar, width + carried>;
  using Scale = std::array<Scalar, width>;
  using Rows = BatchRow<Scalar, width + carried>;
  using Options = TaylorBatchOptions<Scalar>;
  using Ends = std::array<Scalar, batch_size>;

  /// No problem yet: all eight wait for start().
  TaylorBatch(const System& system, const Options& options) noexcept : system_(system), options_(options) {
    for (int b = 0; b < size; ++b) {
      time_[b] = time_low_[b] = start_time_[b] = start_time_low_[b] = 0;
      unit_[b] = next_unit_[b] = 1;
      live_[b] = false;
      for (int i = 0; i < width; ++i) state_[i][b] = low_[i][b] = start_low_[i][b] = weight_[i][b] = 0;
      for (int i = 0; i < carried; ++i) carried_[i][b] = start_carried_[i][b] = 0;
      for (auto& row : x_)
        for (auto& component : row) component[b] = 0;
    }
  }

  /// The systems, to set the constants of a problem before it is started.
  System& system() noexcept { return system_; }
  const System& system() const noexcept { return system_; }

  /// Problem b begins (anew). scale: the size against which the error of each component is measured; 0 leaves a component out. unit: a time
  /// of the order of the first step, which saves expansions.
  void start(int b, Scalar t, const State& state, const Scale& scale, Scalar unit = 1) noexcept {
    time_[b] = start_time_[b] = t;
    time_low_[b] = start_time_low_[b] = 0;
    unit_[b] = next_unit_[b] = unit;
    flat_[b] = false;
    live_[b] = true;
    status_[b] = Status::reached;
    counts_[b] = {};
    for (std::size_t i = 0; i < width; ++i) {
      state_[i][b] = x_[0][i][b] = state[i];
      low_[i][b] = start_low_[i][b] = 0;
      weight_[i][b] = scale[i] > 0 ? 1 / (scale[i] * options_.tolerance) : Scalar(0);
      for (int k = 1; k <= Order; ++k) x_[k][i][b] = 0;
    }
    for (std::size_t i = 0; i < carried; ++i) carried_[i][b] = start_carried_[i][b] = state[width + i];
  }

  /// Perturbs every number of problem b by about `amount` of itself, up or down; zeros stay zero. The last step stays as it was.
  void kick(int b, Scalar amount) noexcept {
    constexpr std::array<Scalar, 3> part{Scalar(0.64L), Scalar(0.48L), Scalar(-0.6L)};
    const auto by = [&](int i) noexcept { return 1 + amount * part[static_cast<std::size_t>(i % 3)]; };
    for (int i = 0; i < width; ++i) state_[i][b] *= by(i);
    for (int i = 0; i < carried; ++i) carried_[i][b] *= by(width + i);
  }

  /// One step of every problem that has been started, has not failed and is before its end, at most up to it. How many these were.
  GYROSTAT_NOINLINE int step(const Ends& ends) noexcept;

  /// All problems to t_end exactly. False if one of them failed, see status(), or t_end is NaN.
  bool advance(Scalar t_end) noexcept {
    Ends ends;
    ends.fill(t_end);
    while (step(ends) > 0) {
    }
    bool all = true;
    for (int b = 0; b < size; ++b) all = all && status_[b] == Status::reached;
    return all && t_end == t_end;
  }

  Scalar time(int b) const noexcept { return time_[b]; }
  /// reached, or why the problem stopped for good.
  Status status(int b) const noexcept { return status_[b]; }
  const Counts& counts(int b) const noexcept { return counts_[b]; }
  State state(int b) const noexcept {
    State state;
    for (std::size_t i = 0; i < width; ++i) state[i] = state_[i][b];
    for (std::size_t i = 0; i < carried; ++i) state[width + i] = carried_[i][b];
    return state;
  }

  /// Begin of the last step of problem b; the polynomial holds from here to time().
  Scalar previous_time(int b) const noexcept { return start_time_[b]; }

  /// The state of problem b at t inside its last step.
  State at(int b, Scalar t) const noexcept {
    const Scalar theta = ((t - start_time_[b]) - start_time_low_[b]) / unit_[b];
    State state;
    for (std::size_t i = 0; i < width; ++i) {
      Scalar sum = x_[Order][i][b];
      for (int k = Order - 1; k >= 1; --k) sum = sum * theta + x_[k][i][b];
      state[i] = x_[0][i][b] + (start_low_[i][b] + theta * sum);
    }
    for (std::size_t i = 0; i < carried; ++i) state[width + i] = start_carried_[i][b];
    return state;
  }

  /// The states of all problems, each at its own t inside its last step. The time of one hundred products a number.
  GYROSTAT_NOINLINE void at(const Ends& t, Rows& states) const noexcept {
    alignas(64) Scalar theta[size];
    for (int b = 0; b < size; ++b)
      theta[b] = ((t[static_cast<std::size_t>(b)] - start_time_[b]) - start_time_low_[b]) / unit_[b];
    for (int first = 0; first < size; first += pack) {
      const Pack z = load_wide(&theta[first]), z2 = z * z;
#pragma GCC unroll 8
      for (int i = 0; i < width; ++i)
        store(&states[i][first],
              load_wide(&x_[0][i][first]) + (load_wide(&start_low_[i][first]) + increment(i, first, z, z2)));
#pragma GCC unroll 8
      for (int i = 0; i < carried; ++i) store(&states[width + i][first], load_wide(&start_carried_[i][first]));
    }
  }

 private:
  using Pack = Wide<Scalar>;
  static constexpr int pack = wide_size<Scalar>;
  static constexpr Scalar small = Scalar(1e-20L), large = Scalar(1e20L);  ///< sizes that decide the step

  /// x(z) - x(0) of component i of the problems of one register.
  GYROSTAT_INLINE Pack increment(int i, int first, const Pack& z, const Pack& z2) const noexcept {
    Pack even = load_wide(&x_[Order - Order % 2][i][first]);
    Pack odd = load_wide(&x_[Order - 1 + Order % 2][i][first]);
    for (int k = Order - Order % 2 - 2; k >= 2; k -= 2) even = multiply_add(even, z2, load_wide(&x_[k][i][first]));
    for (int k = Order - 3 + Order % 2; k >= 1; k -= 2) odd = multiply_add(odd, z2, load_wide(&x_[k][i][first]));
    return z * multiply_add(even, z, odd);
  }

  /// The greatest sizes of the coefficients k relative to the tolerance.
  GYROSTAT_INLINE void sizes(int k, Scalar* to) const noexcept {
    const Pack zero = wide(Scalar(0));
    for (int first = 0; first < size; first += pack) {
      Pack greatest = zero;
#pragma GCC unroll 8
      for (int i = 0; i < width; ++i) {
        const Pack x = load_wide(&x_[k][i][first]) * load_wide(&weight_[i][first]);
        const Pack here = greater_of<Scalar>(x, zero - x);
        greatest = greater_of<Scalar>(here, multiply_add(zero, here, greatest));  // NaN stays
      }
      store(to + first, greatest);
    }
  }

  Scalar size_of(int b, int k) const noexcept {
    Scalar greatest = 0;
    for (int i = 0; i < width; ++i) greatest += std::abs(x_[k][i][b] * weight_[i][b]);
    return greatest;
  }

  using Flags = bool[size];
  using Numbers = Scalar[size];

  /// Begins a step: which problems make one; how many.
  GYROSTAT_INLINE int begin(const Ends& ends, Flags& runs) noexcept;
  /// Fills the rows of all and chooses theta = h/unit of the `running` ones that run from the last two coefficients. A unit far from
  /// the step is changed and the expansion repeated: a few times at the start, practically never later.
  GYROSTAT_INLINE void expand(const Flags& runs, int running, Numbers& theta) noexcept;
  /// Chooses h/unit of problem b where one of the last two coefficients is out of range, or changes its unit; true if that asks for
  /// another expansion.
  bool change_unit(int b, int trial, Scalar last, Scalar last_but_one, Scalar& theta) noexcept;
  /// Moves the times of those that run, at most up to their ends; taken: h/unit of each problem, 0 where it makes no step.
  GYROSTAT_INLINE void move_times(const Ends& ends, const Numbers& theta, Flags& runs, Numbers& taken) noexcept;
  /// Moves the states of those that run by what was taken.
  GYROSTAT_INLINE void move_states(const Numbers& taken, const Flags& runs) noexcept;

  System system_;
  Options options_;
  bool live_[size]{};  ///< started and not failed
  bool flat_[size]{};  ///< the last expansion had no high derivatives
  Status status_[size]{};
  Counts counts_[size];
  alignas(64) Scalar time_[size];
  alignas(64) Scalar time_low_[size];
  alignas(64) Scalar start_time_[size];
  alignas(64) Scalar start_time_low_[size];
  alignas(64) Scalar unit_[size];       ///< of the rows now held
  alignas(64) Scalar next_unit_[size];  ///< for the next expansion
  alignas(64) BatchRow<Scalar, width> state_;
  alignas(64) BatchRow<Scalar, width> low_;
  alignas(64) BatchRow<Scalar, width> start_low_;
  alignas(64) BatchRow<Scalar, width> weight_;
  alignas(64) BatchRow<Scalar, carried + (carried == 0)> carried_;
  alignas(64) BatchRow<Scalar, carried + (carried == 0)> start_carried_;
  alignas(64) BatchRows<Scalar, width, Order> x_;
  alignas(64) typename System::template Work<Order> work_;
};

template <BatchSystem System, int Order>
bool TaylorBatch<System, Order>::change_unit(int b, int trial, Scalar last, Scalar last_but_one,
                                             Scalar& theta) noexcept {
  theta = 8;
  if (last < large && last_but_one < large) {
    if (last > small || last_but_one > small) {
      const float x = last > small ? std::log2(static_cast<float>(last)) * (-1.0F / Order) : 1e3F;
      const float y = last_but_one > small ? std::log2(static_cast<float>(last_but_one)) * (-1.0F / (Order - 1)) : 1e3F;
      theta = static_cast<Scalar>(std::exp2(std::min(x, y)));
      flat_[b] = false;
      return false;
    }
    // the motion has no high derivatives in this unit: try a longer one, and if there are none at all, let the step grow
    if (flat_[b] || trial >= 8 || !(size_of(b, 1) > 0)) {
      flat_[b] = true;
      return false;
    }
    ++counts_[b].rejected;
    unit_[b] *= 8;
    return true;
  }
  // a shorter unit ends an overflow of high powers, but not a derivative that is NaN or infinite
  if (!(size_of(b, 1) < infinity<Scalar>)) {
    status_[b] = Status::not_finite;
  } else if (trial >= 60) {
    status_[b] = Status::step_underflow;
  } else {
    ++counts_[b].rejected;
    unit_[b] /= last < infinity<Scalar> && last_but_one < infinity<Scalar> ? 8 : 64;
    return true;
  }
  live_[b] = false;
  return false;
}

template <BatchSystem System, int Order>
GYROSTAT_INLINE int TaylorBatch<System, Order>::begin(const Ends& ends, Flags& runs) noexcept {
  int running = 0;
  alignas(64) Numbers goes;
  for (int b = 0; b < size; ++b) {
    runs[b] = live_[b] && time_[b] < ends[static_cast<std::size_t>(b)];
    if (runs[b] && counts_[b].steps >= options_.step_cap) {
      status_[b] = Status::step_limit;
      live_[b] = runs[b] = false;
    }
    goes[b] = runs[b] ? Scalar(1) : Scalar(0);
    if (!runs[b]) continue;
    ++running;
    start_time_[b] = time_[b];
    start_time_low_[b] = time_low_[b];
    unit_[b] = next_unit_[b];
  }
  if (running == 0) return 0;
  // what makes no step keeps the begin of its last one, and its rows are made again to the same bits
  for (int first = 0; first < size; first += pack) {
    const auto yes = less<Scalar>(wide(Scalar(0)), load_wide(&goes[first]));
    const auto take = [&](Scalar* to, const Scalar* from) {
      store(to, choose<Scalar>(yes, load_wide(from), load_wide(to)));
    };
#pragma GCC unroll 8
    for (int i = 0; i < width; ++i) {
      take(&x_[0][i][first], &state_[i][first]);
      take(&start_low_[i][first], &low_[i][first]);
    }
#pragma GCC unroll 8
    for (int i = 0; i < carried; ++i) take(&start_carried_[i][first], &carried_[i][first]);
  }
  return running;
}

template <BatchSystem System, int Order>
GYROSTAT_INLINE void TaylorBatch<System, Order>::expand(const Flags& runs, int running, Numbers& theta) noexcept {
  bool waits[size];
  for (int b = 0; b < size; ++b) waits[b] = runs[b];
  alignas(64) Scalar last[size], last_but_one[size];
  for (int trial = 0, waiting = running; waiting > 0; ++trial) {
    system_.expand(unit_, x_, work_);
    sizes(Order, last);
    sizes(Order - 1, last_but_one);
    alignas(64) float guess[size];
    for (int b = 0; b < size; ++b) {
      const float x = detail::near_log2(static_cast<float>(last[b])) * (-1.0F / Order);
      const float y = detail::near_log2(static_cast<float>(last_but_one[b])) * (-1.0F / (Order - 1));
      guess[b] = detail::near_exp2(x < y ? x : y);
    }
    for (int b = 0; b < size; ++b) {
      if (!waits[b]) continue;
      ++counts_[b].rhs;
      if (last[b] < large && last_but_one[b] < large && last[b] > small && last_but_one[b] > small) {
        theta[b] = static_cast<Scalar>(guess[b]);
        flat_[b] = waits[b] = false;
      } else {
        waits[b] = change_unit(b, trial, last[b], last_but_one[b], theta[b]);
      }
      waiting -= waits[b] ? 0 : 1;
    }
  }
}

template <BatchSystem System, int Order>
GYROSTAT_INLINE void TaylorBatch<System, Order>::move_times(const Ends& ends, const Numbers& theta, Flags& runs,
                                                            Numbers& taken) noexcept {
  for (int b = 0; b < size; ++b) {
    taken[b] = 0;
    runs[b] = runs[b] && live_[b];
    if (!runs[b]) continue;
    Scalar h = theta[b] * unit_[b];
    const Scalar left = (ends[static_cast<std::size_t>(b)] - time_[b]) - time_low_[b];
    const bool lands = h >= left;
    if (!(h < infinity<Scalar>)) {
      status_[b] = Status::not_finite;
      live_[b] = runs[b] = false;
      continue;
    }
    next_unit_[b] = std::min(h, 64 * next_unit_[b]);
    if (lands) {
      h = left;
      if (flat_[b]) next_unit_[b] = std::min(next_unit_[b], 64 * h);
      time_[b] = ends[static_cast<std::size_t>(b)];
      time_low_[b] = 0;
    } else if (!(h > std::abs(time_[b]) * (epsilon<Scalar> / 1024))) {
      status_[b] = Status::step_underflow;
      live_[b] = runs[b] = false;
      continue;
    } else {
      const Scalar y = time_low_[b] + h;
      const Scalar high = time_[b] + y;
      const Scalar part = high - time_[b];
      time_low_[b] = (time_[b] - (high - part)) + (y - part);
      time_[b] = high;
    }
    taken[b] = h / unit_[b];
    ++counts_[b].steps;
  }
}

template <BatchSystem System, int Order>
GYROSTAT_INLINE void TaylorBatch<System, Order>::move_states(const Numbers& taken, const Flags& runs) noexcept {
  alignas(64) BatchRow<Scalar, width> state, low;
  alignas(64) BatchRow<Scalar, carried + (carried == 0)> held;
  std::memcpy(state, state_, sizeof state_);
  std::memcpy(low, low_, sizeof low_);
  std::memcpy(held, carried_, sizeof carried_);
  for (int first = 0; first < size; first += pack) {
    const Pack z = load_wide(&taken[first]);
    const Pack z2 = z * z;
#pragma GCC unroll 8
    for (int i = 0; i < width; ++i) {
      const Pack delta = increment(i, first, z, z2);
      const Pack high = load_wide(&x_[0][i][first]);
      const Pack y = load_wide(&start_low_[i][first]) + delta;
      const Pack next = high + y;
      const Pack part = next - high;
      store(&state_[i][first], next);
      store(&low_[i][first], (high - (next - part)) + (y - part));
    }
    if constexpr (BatchCarries<System>) system_.settle(first, state_, low_, carried_);
    if constexpr (BatchProjects<System>) {
      if (options_.projected) system_.project(first, state_, low_);
    }
  }
  for (int b = 0; b < size; ++b) {
    if (runs[b]) continue;  // else as it was
#pragma GCC unroll 8
    for (int i = 0; i < width; ++i) {
      state_[i][b] = state[i][b];
      low_[i][b] = low[i][b];
    }
#pragma GCC unroll 8
    for (int i = 0; i < carried; ++i) carried_[i][b] = held[i][b];
  }
}

template <BatchSystem System, int Order>
int TaylorBatch<System, Order>::step(const Ends& ends) noexcept {
  Flags runs;
  alignas(64) Numbers theta, taken;
  const int running = begin(ends, runs);
  if (running == 0) return 0;
  expand(runs, running, theta);
  move_times(ends, theta, runs, taken);
  move_states(taken, runs);
  int moved = 0;
  for (int b = 0; b < size; ++b) moved += runs[b] ? 1 : 0;
  return moved;
}

/// Runs problems 0 ... count - 1 through the batch, a new one in each lane that has become free.
/// `begin(index, b)`: sets the system and starts problem `index` in lane b; returns its end time.
/// `end(index, b)`: lane b holds its answer, or the status of its failure.
template <BatchSystem System, int Order, class Begin, class End>
void run_all(TaylorBatch<System, Order>& batch, std::size_t count, Begin&& begin, End&& end) noexcept {
  using Scalar = typename System::Scalar;
  typename TaylorBatch<System, Order>::Ends ends{};
  std::array<std::size_t, batch_size> index{};
  std::array<bool, batch_size> busy{};
  std::size_t next = 0, left = count;
  while (left > 0) {
    for (int b = 0; b < batch_size; ++b) {
      const auto at = static_cast<std::size_t>(b);
      if (busy[at] && !(batch.status(b) == Status::reached && batch.time(b) < ends[at])) {
        end(index[at], b);
        busy[at] = false;
        --left;
      }
      if (!busy[at]) {
        ends[at] = -infinity<Scalar>;
        if (next < count) {
          index[at] = next++;
          ends[at] = begin(index[at], b);
          busy[at] = true;
        }
      }
    }
    batch.step(ends);
  }
}

}  // namespace gyrostat::ode
