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
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/bracket.hpp"
#include "gyrostat/ode/status.hpp"

namespace gyrostat::ode {

/// Taylor coefficients of a step: component i of the state at t0 + s is sum_k x[k][i] (s/unit)^k.
template <Real Scalar, int Width, int Order>
using TaylorRows = Scalar[Order + 1][Width];

/// A system of first-order equations that extends its own Taylor coefficients.
/// * `Scalar`, and `width`: the length of a state, a multiple of four. Components that are no state (padding, or a
///   by-product the system wants to have as a series) are left out of the step control by a zero in Options::scale.
/// * `Work<Order>`: memory for by-products, default-constructible, without heap.
/// * `expand(t, unit, x, work)`: x[0] is the state at t; fills x[1] ... x[Order], the coefficients in powers of (s/unit),
///   each from the rows below it. The unit is close to the step, so that no coefficient over- or underflows.
template <class System>
concept TaylorSystem =
    Real<typename System::Scalar> && (System::width > 0) && (System::width % 4 == 0) &&
    requires(const System& system, typename System::Scalar t, TaylorRows<typename System::Scalar, System::width, 2>& x,
             typename System::template Work<2>& work) {
      { system.expand(t, t, x, work) } noexcept;
    };

/// The system bounds the step by the state (a singularity that a long step would jump over).
template <class System>
concept LimitsStep = requires(const System& system, const typename System::Scalar* x) {
  { system.step_limit(x) } noexcept -> std::convertible_to<typename System::Scalar>;
};

/// The system knows invariants (or laws of known time dependence) and moves a state onto them. The state is
/// x + low, low being what rounding left over; t is the time it belongs to.
template <class System>
concept Projects = requires(const System& system, typename System::Scalar t, typename System::Scalar* x) {
  { system.project(t, x, x) } noexcept;
};

/// The system knows that only its first numbers change, a multiple of four, and expands no others: these are left as they are.
template <class System>
concept MovesInPart = requires(const System& system) {
  { system.moving() } noexcept -> std::convertible_to<int>;
};

/// How a state of Width numbers is integrated.
template <Real Scalar, int Width>
struct TaylorOptions {
  /// Size of the last kept term relative to scale, in every step. The global error grows from it with the motion.
  Scalar tolerance = epsilon<Scalar>;
  /// The size against which the error of each component is measured; 0 leaves a component out.
  std::array<Scalar, Width> scale{};
  std::uint64_t step_cap = 100'000'000;
  bool compensated = true;  ///< carry what rounding loses in the sums of time and state
  bool projected = true;    ///< project after every step, where the system can
};

/// Integrates by Taylor series of a fixed order with a step from the last two coefficients (Jorba and Zou, Experimental
/// Mathematics 14 (2005) 99): h = min((tol/|x_N|)^(1/N), (tol/|x_{N-1}|)^(1/(N-1))). No step is rejected, nothing is
/// allocated, nothing throws. The last step stays available as a polynomial (at), which costs one Horner sum a time.
template <TaylorSystem System, int Order = 20>
class Taylor {
  static_assert(Order >= 4);

 public:
  using Scalar = typename System::Scalar;
  static constexpr int width = System::width;
  static constexpr int order = Order;
  using State = std::array<Scalar, width>;
  using Options = TaylorOptions<Scalar, width>;

  Taylor(const System& system, Scalar t, const State& state, const Options& options) noexcept
      : system_(system), options_(options), time_{t, 0}, start_{t, 0} {
    for (int i = 0; i < width; ++i) {
      const Scalar scale = options.scale[static_cast<std::size_t>(i)];
      weight_[i] = scale > 0 ? 1 / (scale * options.tolerance) : Scalar(0);
    }
    restart(t, state);
  }

  /// One step, at most up to t_max; reached if the time is t_max already or now.
  /// Returns reached with time() < t_max after an ordinary step.
  GYROSTAT_NOINLINE Status step(Scalar t_max = infinity<Scalar>) noexcept;

  /// Steps until t_end exactly; does nothing where that is passed already.
  Status advance(Scalar t_end) noexcept {
    Status status = Status::reached;
    while (time_.high < t_end && status == Status::reached) status = step(t_end);
    return t_end == t_end ? status : Status::not_finite;
  }

  Scalar time() const noexcept { return time_.high; }
  const Scalar* state() const noexcept { return state_; }
  /// What rounding has lost of the state so far: it is to be added.
  const Scalar* lost() const noexcept { return low_; }
  const Counts& counts() const noexcept { return counts_; }

  /// Begin of the last step; the polynomial holds from here to time().
  Scalar previous_time() const noexcept { return start_.high; }

  /// The state at t inside the last step, or its first `numbers`, a multiple of four. Outside it the polynomial is extrapolated.
  void at(Scalar t, Scalar* state, int numbers = width) const noexcept;

  /// The time inside the last step at which g(state) changes sign, to a few roundings of the step; Errc::no_bracket if it has
  /// the same sign at both ends (a double crossing inside one step is not seen).
  template <class Function>
  Result<Scalar> crossing(Function&& g) const noexcept;

  /// Perturbs every component by about `amount` of itself, up or down; zeros stay zero. The last step stays as it was.
  void kick(Scalar amount) noexcept {
    constexpr std::array<Scalar, 3> part{Scalar(0.64L), Scalar(0.48L), Scalar(-0.6L)};
    for (int i = 0; i < moving(); ++i) state_[i] *= 1 + amount * part[static_cast<std::size_t>(i % 3)];
  }

  /// Starts anew from another state (after an event that changes it): until the next step at() has that one alone. The counts go on.
  void restart(Scalar t, const State& state) noexcept {
    time_ = start_ = {t, 0};
    flat_ = false;
    for (int i = 0; i < width; ++i) {
      x_[0][i] = state_[i] = state[static_cast<std::size_t>(i)];
      low_[i] = start_low_[i] = 0;
    }
    for (int k = 1; k <= Order; ++k)
      for (int i = 0; i < width; ++i) x_[k][i] = 0;
  }
  /// Adds what rounding had lost of the state from which it has just started: steps so short that each moves less than a rounding add up.
  void regain(const Scalar* lost) noexcept {
    for (int i = 0; i < width; ++i) low_[i] = start_low_[i] = lost[i];
  }

 private:
  using Sum = gyrostat::Sum<Scalar>;

  int moving() const noexcept {
    if constexpr (MovesInPart<System>) return system_.moving();
    else return width;
  }

  /// x(theta) - x(0), four lanes from the given one; theta = s/unit.
  GYROSTAT_INLINE Lanes<Scalar> increment(int lane, Scalar theta) const noexcept {
    const Lanes<Scalar> z = lanes(theta);
    const Lanes<Scalar> z2 = z * z;
    Lanes<Scalar> even = load(&x_[Order - Order % 2][lane]);
    Lanes<Scalar> odd = load(&x_[Order - 1 + Order % 2][lane]);
    for (int k = Order - Order % 2 - 2; k >= 2; k -= 2) even = multiply_add(even, z2, load(&x_[k][lane]));
    for (int k = Order - 3 + Order % 2; k >= 1; k -= 2) odd = multiply_add(odd, z2, load(&x_[k][lane]));
    return z * multiply_add(even, z, odd);
  }

  /// Greatest |x[k][i]| / (tolerance scale[i]); NaN if a coefficient is.
  GYROSTAT_INLINE Scalar size(int k) const noexcept {
    Scalar greatest = 0;
    for (int lane = 0; lane < moving(); lane += 4) {
      const Scalar here = greatest_magnitude(load(&x_[k][lane]) * load(&weight_[lane]));
      greatest = here > greatest ? here : greatest + 0 * here;
    }
    return greatest;
  }

  /// Fills the rows at the time now and chooses theta = h/unit from the last two coefficients. A unit far from the step is changed
  /// and the expansion repeated: a few times at the start, practically never later.
  GYROSTAT_INLINE Status expand(Scalar& theta) noexcept;
  /// The state at theta of the rows.
  GYROSTAT_INLINE void move(Scalar theta) noexcept;

  System system_;
  Options options_;
  Sum time_;
  Sum start_;
  Scalar row_unit_ = 1;   ///< of the rows now held
  Scalar next_unit_ = 1;  ///< for the next expansion
  bool flat_ = false;     ///< the last expansion had no high derivatives
  Counts counts_;
  alignas(32) Scalar state_[width];
  alignas(32) Scalar low_[width];
  alignas(32) Scalar start_low_[width];
  alignas(32) Scalar weight_[width];
  alignas(64) TaylorRows<Scalar, width, Order> x_;
  alignas(64) typename System::template Work<Order> work_;
};

template <TaylorSystem System, int Order>
GYROSTAT_INLINE Status Taylor<System, Order>::expand(Scalar& theta) noexcept {
  constexpr Scalar small = Scalar(1e-20L), large = Scalar(1e20L);
  theta = 8;
  for (int trial = 0;; ++trial) {
    system_.expand(time_.high, row_unit_, x_, work_);
    ++counts_.rhs;
    const Scalar last = size(Order);
    const Scalar last_but_one = size(Order - 1);
    if (last < large && last_but_one < large) {
      if (last > small || last_but_one > small) {
        const float a = last > small ? std::log2(static_cast<float>(last)) * (-1.0F / Order) : 1e3F;
        const float b =
            last_but_one > small ? std::log2(static_cast<float>(last_but_one)) * (-1.0F / (Order - 1)) : 1e3F;
        theta = static_cast<Scalar>(std::exp2(std::min(a, b)));
        flat_ = false;
        return Status::reached;
      }
      // the motion has no high derivatives in this unit: try a longer one, and if there are none at all, let the step grow
      if (flat_ || trial >= 8 || !(size(1) > 0)) {
        flat_ = true;
        return Status::reached;
      }
      row_unit_ *= 8;
    } else {
      // a shorter unit ends an overflow of high powers, but not a derivative that is NaN or infinite
      if (!(size(1) < infinity<Scalar>)) return Status::not_finite;
      if (trial >= 60) return Status::step_underflow;
      row_unit_ /= last < infinity<Scalar> && last_but_one < infinity<Scalar> ? 8 : 64;
    }
    ++counts_.rejected;
  }
}

template <TaylorSystem System, int Order>
GYROSTAT_INLINE void Taylor<System, Order>::move(Scalar theta) noexcept {
  for (int i = 0; i < moving(); i += 4) {
    const Lanes<Scalar> high = load(&x_[0][i]);
    const Lanes<Scalar> delta = increment(i, theta);
    if (options_.compensated) {
      const Lanes<Scalar> y = load(&start_low_[i]) + delta;
      const Lanes<Scalar> next = high + y;
      const Lanes<Scalar> part = next - high;
      store(&state_[i], next);
      store(&low_[i], (high - (next - part)) + (y - part));
    } else {
      store(&state_[i], high + delta);
    }
  }
}

template <TaylorSystem System, int Order>
Status Taylor<System, Order>::step(Scalar t_max) noexcept {
  if (!(time_.high < t_max)) return t_max == t_max ? Status::reached : Status::not_finite;
  if (counts_.steps >= options_.step_cap) return Status::step_limit;

  for (int i = 0; i < width; i += 4) {
    store(&x_[0][i], load(&state_[i]));
    store(&start_low_[i], load(&low_[i]));
  }
  start_ = time_;
  row_unit_ = next_unit_;
  Scalar theta;
  if (const Status status = expand(theta); status != Status::reached) return status;

  Scalar h = theta * row_unit_;
  const Scalar own = h;  // in whose unit the next coefficients are of one size, where the system allows less
  if constexpr (LimitsStep<System>) {
    const Scalar limit = system_.step_limit(x_[0]);
    if (!(h < limit)) {
      h = limit;
      theta = h / row_unit_;
    }
  }
  if (!(h < infinity<Scalar>)) return Status::not_finite;
  next_unit_ = std::min(own, 64 * next_unit_);
  const Scalar left = (t_max - time_.high) - time_.low;
  const bool lands = h >= left;
  if (lands) {
    h = left;
    theta = h / row_unit_;
    if (flat_)
      next_unit_ = std::min(next_unit_, 64 * h);  // one that lands again and again would grow beyond all numbers
  } else if (!(h > std::abs(time_.high) * (epsilon<Scalar> / 1024))) {
    return Status::step_underflow;
  }

  move(theta);
  if (lands) {
    time_ = {t_max, 0};
  } else if (options_.compensated) {
    time_ = add(time_, h);
  } else {
    time_.high += h;
  }
  ++counts_.steps;
  if constexpr (Projects<System>) {
    if (options_.projected) system_.project(time_.high, state_, low_);
  }
  return Status::reached;
}

template <TaylorSystem System, int Order>
void Taylor<System, Order>::at(Scalar t, Scalar* state, int numbers) const noexcept {
  const Scalar theta = ((t - start_.high) - start_.low) / row_unit_;
  const int moved = std::min(numbers, moving());
  for (int i = 0; i < moved; i += 4) {
    store(state + i, load(&x_[0][i]) + (load(&start_low_[i]) + increment(i, theta)));
  }
  for (int i = moved; i < numbers; i += 4) store(state + i, load(&x_[0][i]));
}

template <TaylorSystem System, int Order>
template <class Function>
auto Taylor<System, Order>::crossing(Function&& g) const noexcept -> Result<Scalar> {
  alignas(32) Scalar state[width];
  const auto value = [&](Scalar t) noexcept {
    at(t, state);
    return g(static_cast<const Scalar*>(state));
  };
  math::SignChange<Scalar> change{start_.high, value(start_.high), time_.high, value(time_.high)};
  if (change.f_low == 0) return change.low;
  if (change.f_high == 0) return change.high;
  if (!((change.f_low < 0 && change.f_high > 0) || (change.f_low > 0 && change.f_high < 0))) return Errc::no_bracket;
  for (int trip = 0; trip < 200; ++trip) {
    const Scalar t = change.guess(trip);
    if (!change.contains(t)) break;
    const Scalar f = value(t);
    if (f == 0) return t;
    if (!(f == f)) return Errc::not_finite;
    change.take(t, f);
  }
  return std::abs(change.f_low) < std::abs(change.f_high) ? change.low : change.high;
}

}  // namespace gyrostat::ode
