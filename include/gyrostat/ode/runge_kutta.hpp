// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/ode/dop853.hpp"
#include "gyrostat/ode/status.hpp"

namespace gyrostat::ode {

/// dydt = f(t, y). A NaN among the derivatives rejects the step: it is tried again, shorter.
template <class F, class Scalar, std::size_t N>
concept RightHandSide = requires(F& f, Scalar t, const std::array<Scalar, N>& y, std::array<Scalar, N>& dydt) {
  { f(t, y, dydt) } noexcept;
};

/// The same number for every component.
template <Real Scalar, std::size_t N>
constexpr std::array<Scalar, N> uniform(Scalar value) noexcept {
  std::array<Scalar, N> all{};
  all.fill(value);
  return all;
}

/// What a step may err and how long it may be. A step is accepted when the root mean square over the components of
/// error_i / (absolute_i + relative |y_i|) is at most one.
template <Real Scalar, std::size_t N>
struct StepControl {
  Scalar relative = Scalar(1e-9);
  std::array<Scalar, N> absolute = uniform<Scalar, N>(Scalar(1e-12));
  Scalar first_step = 0;                   ///< 0: chosen from the first two derivatives
  Scalar longest_step = infinity<Scalar>;  ///< no step is longer; all are so long where tolerances are never missed
  std::uint64_t step_cap = 100000;         ///< on accepted and rejected steps together
  /// Whether the right-hand side is smooth within a step. Where it may have kinks, or be singular nearby, the estimate of order 5(3), which is
  /// a product of two, comes out too small: then that of order 5 alone is taken.
  bool smooth = true;
};

/// Explicit adaptive Runge-Kutta method DOP853, order 8(5,3), dense output of order 7 (Hairer, Norsett, Wanner 1993,
/// section II.10). Twelve evaluations a step; the three more that the dense output needs are made at the first at()
/// inside a step. Runs either way in t. No heap, no throw; every loop is capped.
///     RungeKutta solver(f, t0, y0, StepControl<double, 2>{.relative = 1e-10});
///     while (solver.time() < t_end && solver.step(t_end) == Status::reached) {
///       for (; next < n && t[next] <= solver.time(); ++next) y[next] = solver.at(t[next]);
///     }
template <Real Scalar, std::size_t N, RightHandSide<Scalar, N> F>
class RungeKutta {
 public:
  using State = std::array<Scalar, N>;

  RungeKutta(F rhs, Scalar t, const State& y, const StepControl<Scalar, N>& control = {}) noexcept
      : rhs_(std::move(rhs)), control_(control) {
    restart(t, y);
  }

  /// Begins anew at (t, y), as after a switch of the right-hand side's regime; the counts go on. A first step of 0 is
  /// chosen at the next step().
  void restart(Scalar t, const State& y, Scalar first_step = 0) noexcept {
    t_ = t_old_ = t;
    y_ = y_old_ = y;
    lost_ = {};
    h_ = 0;
    next_ = std::abs(first_step);
    evaluate(t_, y_, f_);
    status_ = std::isfinite(t_) && finite(y_) && finite(f_) ? Status::reached : Status::not_finite;
  }

  /// Begins anew where it is: what rounding has lost of the state so far is kept.
  void go_on() noexcept {
    const State lost = lost_;
    restart(t_, State(y_));
    lost_ = lost;
  }

  /// One accepted step towards `limit`, which may be infinite, and never past it. Status::reached where a step was made or
  /// `limit` is already the time; any other status is final until restart(). A start that is not finite, a limit that is
  /// NaN, a step that meets NaN however short it is made, and a time that grows beyond all numbers end with
  /// Status::not_finite.
  Status step(Scalar limit) noexcept {
    const Scalar span = limit - t_;
    if (status_ != Status::reached || span == 0) return status_;
    if (std::isnan(span)) return status_ = Status::not_finite;
    t_old_ = t_;
    y_old_ = y_;
    h_ = 0;
    dense_ = false;
    const Scalar direction = span > 0 ? Scalar(1) : Scalar(-1);
    const Scalar length = std::abs(span);
    if (next_ == 0) next_ = control_.first_step > 0 ? control_.first_step : first_step(direction, length);

    int blind = 0;  // trials that met NaN
    Scalar greatest = 6;
    for (;;) {
      if (counts_.steps + counts_.rejected >= control_.step_cap) return status_ = Status::step_limit;
      const Scalar size = next_ < control_.longest_step ? next_ : control_.longest_step;
      const bool last = length <= Scalar(1.01) * size;
      const Scalar h = last ? span : direction * size;
      const Scalar end = last ? limit : t_ + h;
      if (!std::isfinite(end)) return status_ = Status::not_finite;
      if (!last && t_ + h / 10 == t_) return status_ = blind > 0 ? Status::not_finite : Status::step_underflow;
      const Scalar error = try_step(end, h);
      if (error <= 1) {
        t_ = end;
        y_ = trial_;
        lost_ = trial_lost_;
        f_ = k_[12];
        h_ = h;
        ++counts_.steps;
        next_ = std::abs(h) * factor(error, greatest);
        // A step that the limit cut short says little about the next one.
        if (std::abs(h) < size && next_ < size) next_ = size;
        return status_;
      }
      ++counts_.rejected;
      greatest = 1;
      if (std::isfinite(error)) {
        next_ = std::abs(h) * factor(error, greatest);
      } else {
        // Next to the edge of its domain a state can stand still in rounding while the time goes on in tiny steps: that is the end.
        ++blind;
        if (blind > blind_cap || std::abs(h) <= 1024 * epsilon<Scalar> * std::abs(t_))
          return status_ = Status::not_finite;
        next_ = std::abs(h) / 5;
      }
    }
  }

  /// Steps until `limit`.
  Status advance(Scalar limit) noexcept {
    while (step(limit) == Status::reached && t_ != limit) {
    }
    return status_;
  }

  /// The state inside the last step, previous_time() <= t <= time(), to order 7; elsewhere the same polynomial. Before
  /// the first step and after a failed one: the state at time().
  State at(Scalar t) noexcept {
    if (h_ == 0) return y_;
    if (!dense_) make_dense();
    const Scalar x = (t - t_old_) / h_;
    const Scalar rest = 1 - x;
    State y;
    for (std::size_t i = 0; i < N; ++i) {
      Scalar sum = x * dense_terms_[6][i];
      sum = rest * (dense_terms_[5][i] + sum);
      sum = x * (dense_terms_[4][i] + sum);
      sum = rest * (dense_terms_[3][i] + sum);
      sum = x * (dense_terms_[2][i] + sum);
      sum = rest * (dense_terms_[1][i] + sum);
      y[i] = y_old_[i] + x * (dense_terms_[0][i] + sum);
    }
    return y;
  }

  /// Component i of at(t) and its derivative.
  std::array<Scalar, 2> component(std::size_t i, Scalar t) noexcept {
    if (h_ == 0) return {y_[i], f_[i]};
    if (!dense_) make_dense();
    const Scalar x = (t - t_old_) / h_, rest = 1 - x;
    Scalar sum = x * dense_terms_[6][i], slope = dense_terms_[6][i];
    for (std::size_t k = 6; k-- > 0;) {
      sum += dense_terms_[k][i];
      const bool outer = k % 2 == 0;  // times x, else times rest
      slope = outer ? sum + x * slope : rest * slope - sum;
      sum *= outer ? x : rest;
    }
    return {y_old_[i] + sum, slope / h_};
  }

  Scalar time() const noexcept { return t_; }
  const State& state() const noexcept { return y_; }
  const State& derivative() const noexcept { return f_; }  ///< at time()
  Scalar previous_time() const noexcept { return t_old_; }
  const State& previous_state() const noexcept { return y_old_; }
  Scalar next_step() const noexcept { return next_; }  ///< the length that the next step will be tried with
  Status status() const noexcept { return status_; }
  const Counts& counts() const noexcept { return counts_; }
  F& rhs() noexcept { return rhs_; }
  const F& rhs() const noexcept { return rhs_; }

 private:
  static constexpr int blind_cap = 40;  // 5^-40 of the step: no shorter one would avoid the NaN

  static bool finite(const State& y) noexcept {
    bool all = true;
    for (const Scalar v : y) all = all && std::isfinite(v);
    return all;
  }

  /// 0.9 error^(-1/8) within [1/3, greatest].
  static Scalar factor(Scalar error, Scalar greatest) noexcept {
    const Scalar wanted = Scalar(0.9) / std::sqrt(std::sqrt(std::sqrt(error)));
    return wanted < Scalar(1) / 3 ? Scalar(1) / 3 : (wanted < greatest ? wanted : greatest);
  }

  Scalar weight(std::size_t i, Scalar a, Scalar b) const noexcept {
    const Scalar size = std::abs(a) > std::abs(b) ? std::abs(a) : std::abs(b);
    return 1 / (control_.absolute[i] + control_.relative * size + std::numeric_limits<Scalar>::min());
  }

  void evaluate(Scalar t, const State& y, State& dydt) noexcept {
    ++counts_.rhs;
    rhs_(t, y, dydt);
  }

  /// Sum of weight times stage over a row of the method, component i.
  template <const auto& Row>
  Scalar weighted(std::size_t i) const noexcept {
    return [&]<std::size_t... Q>(std::index_sequence<Q...>) {
      return ((Scalar(Row[Q].weight) * k_[Row[Q].stage][i]) + ...);
    }(std::make_index_sequence<std::size(Row)>{});
  }

  template <std::size_t Stage, const auto& Row>
  void stage(Scalar t, const State& y, Scalar h) noexcept {
    State trial;
    for (std::size_t i = 0; i < N; ++i) trial[i] = y[i] + h * weighted<Row>(i);
    evaluate(t + Scalar(dop853::nodes[Stage]) * h, trial, k_[Stage]);
  }

  /// Fills trial_ and the stages 0 to 12; the scaled error, not finite where the step left the domain.
  Scalar try_step(Scalar t_new, Scalar h) noexcept {
    using namespace dop853;
    k_[0] = f_;
    stage<1, a1>(t_, y_, h);
    stage<2, a2>(t_, y_, h);
    stage<3, a3>(t_, y_, h);
    stage<4, a4>(t_, y_, h);
    stage<5, a5>(t_, y_, h);
    stage<6, a6>(t_, y_, h);
    stage<7, a7>(t_, y_, h);
    stage<8, a8>(t_, y_, h);
    stage<9, a9>(t_, y_, h);
    stage<10, a10>(t_, y_, h);
    stage<11, a11>(t_, y_, h);
    Scalar fifth = 0;
    Scalar third = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar slope = weighted<b>(i);
      // steps so short that each moves less than a rounding add up
      const auto sum = add(Sum<Scalar>{y_[i], lost_[i]}, h * slope);
      trial_[i] = sum.high, trial_lost_[i] = sum.low;
      const Scalar w = weight(i, y_[i], trial_[i]);
      const Scalar e5 = w * weighted<error5>(i);
      const Scalar e3 = w * (slope - weighted<error3>(i));
      fifth += e5 * e5;
      third += e3 * e3;
    }
    const Scalar both = control_.smooth ? fifth + third / 100 : fifth;
    const Scalar error = both == 0 ? Scalar(0) : std::abs(h) * fifth / std::sqrt(both * Scalar(N));
    if (!(error <= 1)) return error;
    evaluate(t_new, trial_, k_[12]);
    return finite(k_[12]) ? error : nan<Scalar>;
  }

  /// From the sizes of the state, its first and its second derivative (Hairer, Norsett, Wanner 1993, section II.4).
  Scalar first_step(Scalar direction, Scalar length) noexcept {
    Scalar d0 = 0;
    Scalar d1 = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar w = weight(i, y_[i], y_[i]);
      d0 += (w * y_[i]) * (w * y_[i]);
      d1 += (w * f_[i]) * (w * f_[i]);
    }
    d0 = std::sqrt(d0 / Scalar(N));
    d1 = std::sqrt(d1 / Scalar(N));
    const Scalar allowed = length < control_.longest_step ? length : control_.longest_step;
    const Scalar longest = allowed < infinity<Scalar> ? allowed : Scalar(1);  // without a limit: that of a trial
    const Scalar tiny = Scalar(1e-5);
    Scalar h0 = d0 < tiny || d1 < tiny ? longest * Scalar(1e-6) : d0 / d1 / 100;
    if (!(h0 < longest)) h0 = longest;

    for (std::size_t i = 0; i < N; ++i) trial_[i] = y_[i] + direction * h0 * f_[i];
    evaluate(t_ + direction * h0, trial_, k_[1]);
    Scalar d2 = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar e = weight(i, y_[i], y_[i]) * (k_[1][i] - f_[i]);
      d2 += e * e;
    }
    d2 = std::sqrt(d2 / Scalar(N)) / h0;
    const Scalar steepest = d1 > d2 ? d1 : d2;
    if (!std::isfinite(steepest)) return h0;
    const Scalar h1 = steepest > 0 ? std::sqrt(std::sqrt(std::sqrt(Scalar(0.01) / steepest))) : longest;
    const Scalar h = h1 < 100 * h0 ? h1 : 100 * h0;
    return h < longest ? h : longest;
  }

  void make_dense() noexcept {
    using namespace dop853;
    stage<13, a13>(t_old_, y_old_, h_);
    stage<14, a14>(t_old_, y_old_, h_);
    stage<15, a15>(t_old_, y_old_, h_);
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar change = y_[i] - y_old_[i];
      const Scalar opening = h_ * k_[0][i] - change;
      dense_terms_[0][i] = change;
      dense_terms_[1][i] = opening;
      dense_terms_[2][i] = change - h_ * k_[12][i] - opening;
      dense_terms_[3][i] = h_ * weighted<d4>(i);
      dense_terms_[4][i] = h_ * weighted<d5>(i);
      dense_terms_[5][i] = h_ * weighted<d6>(i);
      dense_terms_[6][i] = h_ * weighted<d7>(i);
    }
    dense_ = true;
  }

  F rhs_;
  StepControl<Scalar, N> control_;
  Scalar t_ = 0;
  Scalar t_old_ = 0;
  Scalar h_ = 0;     // the last accepted step; 0: none
  Scalar next_ = 0;  // length of the next trial; 0: to be chosen
  State y_{};
  State y_old_{};
  State f_{};
  State trial_{};
  State lost_{}, trial_lost_{};  ///< what rounding has lost of y_ and trial_
  std::array<State, 16> k_;
  std::array<State, 7> dense_terms_;
  bool dense_ = false;
  Status status_ = Status::reached;
  Counts counts_;
};

}  // namespace gyrostat::ode
