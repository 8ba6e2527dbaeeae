// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a decelerated gyrostat: Taylor series from the start to the last time asked for, through the stop.
namespace gyrostat::deceleration {

template <Real Scalar>
struct FullMotionOptions : MotionOptions<Scalar> {
  bool find_stop = true;  ///< go on behind the last time until the stop, if there is one
};

/// `error`: modulus and regime are no part of it, and have 0.
template <Real Scalar>
struct FullMotionAnswer : MotionOutcome<std::size(column_kinds), Scalar> {
  /// When U = 0 is reached and held, s; infinity if never; NaN if it was not looked for or the integration ended before.
  Scalar stop_time = nan<Scalar>;
  Scalar stop_error = 0;  ///< of the stop time, relative

  Scalar greatest_error() const noexcept { return greater(stop_error, this->error.greatest()); }
};

/// How the control acts at U = 0, where its torque can be any -control n with |n| <= 1 (Filippov).
template <Real Scalar>
struct Hold {
  bool holds = false;  ///< U = 0 is kept once reached
  Scalar weakest = 0;  ///< lower bound of the rate at which |U| shrinks near U = 0, N m; 0 if there is none

  explicit Hold(const Problem<Scalar>& problem) noexcept {
    const Mat3<Scalar>& b = problem.control;
    if (b.isZero(0)) return;
    const Vec3<Scalar> c = FullCoefficients<Scalar>(problem).constant;
    const Mat3<Scalar> cofactor = cofactors(b);
    const Scalar determinant = b.row(0).dot(cofactor.row(0));
    const Scalar trace = b.trace();
    // the two greater eigenvalues have a product of at most (trace/2)^2
    const Scalar least = std::max(Scalar(0), 4 * determinant / (trace * trace));
    if (c.isZero(0)) {
      holds = true;
      weakest = least > 16 * epsilon<Scalar> * trace ? least : Scalar(0);
    } else if (least > 16 * epsilon<Scalar> * trace) {
      const Scalar used = Vec3<Scalar>(cofactor * c).norm() / determinant;
      holds = used <= 1;
      weakest = holds ? least * (1 - used) : Scalar(0);
    }
  }

  /// Cofactors of a symmetric matrix: determinant times its inverse.
  static Mat3<Scalar> cofactors(const Mat3<Scalar>& b) noexcept {
    Mat3<Scalar> m;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        m(i, j) = b(i1, j1) * b(i2, j2) - b(i1, j2) * b(i2, j1);
      }
    }
    return m;
  }
};

/// The full motion at the given times (s from the start, increasing, the first >= 0): the total momentum in principal axes,
/// and with a start attitude (principal axes to inertial) the attitude. What lies behind a failure is NaN.
///
/// The stop is found to 1e-12 of its time: the steps shrink with |U| (FullSystem::step_limit) until the rest of the motion, |U| over the
/// torque, is below 1e-13 of the time. Behind it law total stays at M = 0, omega = -J^-1 l, and law carrier at M = l, omega = 0.
/// Where the control cannot hold U = 0 against the drag of the other law there is no stop.
///
/// The error is estimated by a second run with a step tolerance 64 times looser, whose distance from the answer is some ten to a
/// hundred times the error of the answer, plus what rounding of the data does to the phase and no second run can show. So the
/// estimate is safe rather than sharp. A run that misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: not_increasing (times), not_finite (problem or times), out_of_domain (a span of the wrong length).
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<Vec3<Scalar>> momentum,
                                             const FullMotionOptions<Scalar>& options = {},
                                             const Quat<Scalar>* start_attitude = nullptr,
                                             std::span<Quat<Scalar>> attitude = {}) noexcept;

namespace detail {

/// But for modulus and regime, which the equations do not need.
template <Real Scalar>
State<Scalar> state_of(const Problem<Scalar>& problem, const Vec3<Scalar>& M, const Quat<Scalar>& q) noexcept {
  State<Scalar> state;
  state.momentum = M;
  state.norm = M.norm();
  state.energy = problem.energy(M);
  state.attitude = q;
  return state;
}

/// One run: hands (index, M, q) of every time to the sink, in order.
template <Real Scalar, bool with_control, bool with_attitude>
class FullRun {
 public:
  using System = FullSystem<Scalar, with_control, with_attitude>;
  using Solver = ode::Taylor<System>;
  static constexpr int width = System::width;

  FullRun(const Problem<Scalar>& problem, const Quat<Scalar>& attitude, Scalar step_tolerance, Scalar reach,
          const FullMotionOptions<Scalar>& options, double progress_from, double progress_to) noexcept
      : problem_(problem),
        coefficients_(problem),
        hold_(problem),
        attitude_(attitude),
        step_tolerance_(step_tolerance),
        reach_(reach),
        options_(options),
        progress_from_(progress_from),
        progress_to_(progress_to) {}

  template <class Sink>
  ode::Status operator()(std::span<const Scalar> times, Sink&& sink) noexcept {
    using ode::Status;
    typename Solver::State state{};
    Vec3<Scalar> U = problem_.momentum - coefficients_.offset;
    Scalar t = 0;
    stop_time_ = with_control && (hold_.weakest > 0 || hold_.holds) ? nan<Scalar> : infinity<Scalar>;
    std::size_t next = 0;
    while (next < times.size() && times[next] <= 0) sink(next++, problem_.momentum, attitude_);
    if (U.isZero(0)) {
      if (hold_.holds || (!with_control && coefficients_.constant.isZero(0))) {
        rest(times, next, 0, attitude_, sink);
        return Status::reached;
      }
      if constexpr (with_control) t = leave(U);
    }
    for (int i = 0; i < 3; ++i) state[static_cast<std::size_t>(i)] = U[i];
    if constexpr (with_attitude) {
      state[4] = attitude_.w;
      state[5] = attitude_.x;
      state[6] = attitude_.y;
      state[7] = attitude_.z;
    }

    ode::TaylorOptions<Scalar, width> how;
    how.tolerance = step_tolerance_;
    how.step_cap = options_.step_cap;
    // the carrier's share of the momentum sets the energy; where it is the small part of M it needs its own digits
    const Scalar whole = std::max(problem_.momentum.norm(), U.norm());
    const Scalar share = (problem_.momentum - problem_.rotor_momentum).norm();
    const Scalar size = share > Scalar(1e-4L) * whole ? std::min(share, whole) : whole;
    for (std::size_t i = 0; i < 3; ++i) how.scale[i] = size > 0 ? size : std::numeric_limits<Scalar>::min();
    for (std::size_t i = 4; i < width; ++i) how.scale[i] = 1;
    const System system(problem_, reach_);
    Solver solver(system, t, state, how);

    const bool may_stop = with_control && hold_.holds;
    const bool seek = may_stop && hold_.weakest > 0 && options_.find_stop;
    const Scalar start_norm = U.norm();
    const Scalar rate_scale = coefficients_.quadratic.cwiseAbs().maxCoeff();
    const Scalar linear_scale = coefficients_.linear.norm() + coefficients_.rate.norm();
    alignas(32) Scalar x[width];
    Status status = Status::reached;
    std::uint32_t trips = 0;
    while (next < times.size() || seek) {
      const Scalar before = solver.time();
      status = solver.step();
      if (status != Status::reached) break;
      const Scalar now = solver.time();
      U = {solver.state()[0], solver.state()[1], solver.state()[2]};
      const Scalar norm = U.norm();
      if (next < times.size()) phase_ += (now - before) * (rate_scale * norm + linear_scale);
      for (; next < times.size() && times[next] <= now; ++next) {
        solver.at(times[next], x);
        sink(next, Vec3<Scalar>(Vec3<Scalar>(x[0], x[1], x[2]) + coefficients_.offset), quaternion(x));
      }
      if (may_stop) {
        // the rest of the motion: |U| falls at least at the weakest rate, in the end at the rate of its direction
        const Scalar fall = falling(U, norm);
        const Scalar slowest = hold_.weakest > 0 ? std::min(hold_.weakest, fall) : fall;
        if (!(norm > 0) || norm <= Scalar(1e-13L) * precision_factor * now * slowest) {
          rest(times, next, now + (norm > 0 ? norm / fall : Scalar(0)), quaternion(solver.state()), sink);
          break;
        }
      }
      if ((++trips & 255U) == 0) {
        if (options_.cancelled()) {
          status = Status::cancelled;
          break;
        }
        if constexpr (with_control) {
          // A step goes at most a part of |U|/torque. Where |U| fades without a stop ahead, the steps only grow shorter.
          const Scalar fall = falling(U, norm), left = seek ? Scalar(0) : times.back() - now;
          const auto budget = static_cast<Scalar>(options_.step_cap - trips);
          if (fall >= 0 && fall * left < norm && left > budget * system.step_limit(solver.state())) {
            status = Status::step_limit;
            break;
          }
        }
        const Scalar done = seek ? 1 - norm / start_norm : now / times.back();
        report(static_cast<double>(done));
      }
    }
    counts_ = solver.counts();
    for (; next < times.size(); ++next) {
      sink(next, Vec3<Scalar>(Vec3<Scalar>::Constant(nan<Scalar>)),
           Quat<Scalar>{nan<Scalar>, nan<Scalar>, nan<Scalar>, nan<Scalar>});
    }
    report(1);
    return status;
  }

  Scalar stop_time() const noexcept { return stop_time_; }
  const ode::Counts& counts() const noexcept { return counts_; }
  /// Bound of the angle turned through by U and by the axes up to the last time, rad.
  Scalar phase() const noexcept { return phase_; }
  /// Angle turned through behind the stop, rad.
  Scalar phase_at_rest() const noexcept { return phase_at_rest_; }

 private:
  /// 1 for double and wider; float cannot resolve 1e-13.
  static constexpr Scalar precision_factor = std::max(Scalar(1), epsilon<Scalar> / Scalar(1e-15L));

  Scalar falling(const Vec3<Scalar>& U, Scalar norm) const noexcept {
    const Vec3<Scalar> n = U / norm;
    return n.dot(problem_.control * n) - n.dot(coefficients_.constant);
  }

  Quat<Scalar> quaternion(const Scalar* x) const noexcept {
    if constexpr (with_attitude) {
      const Scalar size = 1 / std::sqrt(x[4] * x[4] + x[5] * x[5] + x[6] * x[6] + x[7] * x[7]);
      return {x[4] * size, x[5] * size, x[6] * size, x[7] * size};
    } else {
      return attitude_;
    }
  }

  /// Behind the stop: U = 0.
  template <class Sink>
  void rest(std::span<const Scalar> times, std::size_t& next, Scalar stop, const Quat<Scalar>& q, Sink& sink) noexcept {
    stop_time_ = stop;
    const Vec3<Scalar>& w = coefficients_.rate;
    const Scalar rate = w.norm();
    if (next < times.size()) phase_at_rest_ = std::max(Scalar(0), times.back() - stop) * rate;
    for (; next < times.size(); ++next) {
      Quat<Scalar> turned = q;
      if (with_attitude && rate > 0) {
        const Scalar half = std::max(Scalar(0), times[next] - stop) * rate / 2;
        const Scalar c = std::cos(half), s = std::sin(half) / rate;
        const Scalar x = w[0] * s, y = w[1] * s, z = w[2] * s;
        turned = {q.w * c - q.x * x - q.y * y - q.z * z, q.w * x + q.x * c + q.y * z - q.z * y,
                  q.w * y - q.x * z + q.y * c + q.z * x, q.w * z + q.x * y - q.y * x + q.z * c};
      }
      sink(next, coefficients_.offset, turned);
    }
  }

  /// U = 0 that the control cannot hold: U leaves along the one direction n with (s + control) n = c, s > 0. Sets U a moment later
  /// and returns that moment; it is so short that the square of it is lost in rounding.
  Scalar leave(Vec3<Scalar>& U) const noexcept {
    const Vec3<Scalar>& c = coefficients_.constant;
    Scalar low = 0, high = c.norm();
    Vec3<Scalar> n = c / high;
    for (int trip = 0; trip < 2 * std::numeric_limits<Scalar>::digits; ++trip) {
      const Scalar s = (low + high) / 2;
      Mat3<Scalar> m = problem_.control;
      m.diagonal().array() += s;
      const Mat3<Scalar> cofactor = Hold<Scalar>::cofactors(m);
      n = cofactor * c / m.row(0).dot(cofactor.row(0));
      (n.norm() > 1 ? low : high) = s;
    }
    const Scalar s = (low + high) / 2;
    const Scalar rate =
        coefficients_.linear.norm() + coefficients_.quadratic.cwiseAbs().maxCoeff() * problem_.rotor_momentum.norm();
    const Scalar moment = epsilon<Scalar> / (rate > 0 ? rate : Scalar(1));
    U = s * moment * n.normalized();
    return moment;
  }

  void report(double done) const noexcept {
    options_.report(progress_from_ + std::clamp(done, 0.0, 1.0) * (progress_to_ - progress_from_));
  }

  const Problem<Scalar>& problem_;
  FullCoefficients<Scalar> coefficients_;
  Hold<Scalar> hold_;
  Quat<Scalar> attitude_;
  Scalar step_tolerance_, reach_;
  const FullMotionOptions<Scalar>& options_;
  double progress_from_, progress_to_;
  Scalar stop_time_ = nan<Scalar>;
  Scalar phase_ = 0, phase_at_rest_ = 0;
  ode::Counts counts_;
};

/// The answer's run, the companion's run, and their distance.
template <Real Scalar, bool with_control, bool with_attitude>
FullMotionAnswer<Scalar> full_motion_with_error(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                                std::span<Vec3<Scalar>> momentum,
                                                const FullMotionOptions<Scalar>& options,
                                                const Quat<Scalar>& start_attitude, std::span<Quat<Scalar>> attitude,
                                                Scalar step_tolerance, double progress_from,
                                                double progress_to) noexcept {
  using Run = FullRun<Scalar, with_control, with_attitude>;
  constexpr Scalar eps = epsilon<Scalar>;
  constexpr auto& how = honesty::deceleration_run;
  FullMotionAnswer<Scalar> answer;
  answer.step_tolerance = step_tolerance;
  const double middle = progress_from + honesty::answers_share * (progress_to - progress_from);

  Run run(problem, start_attitude, step_tolerance, Scalar(0.3L), options, progress_from, middle);
  answer.status = run(times, [&](std::size_t i, const Vec3<Scalar>& M, const Quat<Scalar>& q) noexcept {
    momentum[i] = M;
    if constexpr (with_attitude) attitude[i] = q;
  });
  answer.stop_time = run.stop_time();
  answer.counts = run.counts();
  if (answer.status != ode::Status::reached) return answer;

  const Scalar margin = Scalar(step_tolerance < Scalar(how.two_below) * eps ? how.margin_of_rounding : how.margin);
  const Scalar looser = std::max(step_tolerance * Scalar(how.looser), Scalar(how.least_loose) * eps);
  Run companion(problem, start_attitude, looser, Scalar(0.45L), options, middle, progress_to);
  Comparison both(Row<Scalar>{problem});
  const auto status = companion(times, [&](std::size_t i, const Vec3<Scalar>& M, const Quat<Scalar>& q) noexcept {
    both.add(state_of(problem, momentum[i], with_attitude ? attitude[i] : q), state_of(problem, M, q));
  });
  answer.counts += companion.counts();
  if (status != ode::Status::reached) {
    answer.status = status;
    return answer;
  }

  // Rounding in every step adds up like a random walk, which the second run may miss by chance.
  const Scalar walk = eps * std::sqrt(static_cast<Scalar>(run.counts().steps));
  // What both runs share: the polynomial of a step that both take, good to the step tolerance; and the rounding of the data on their
  // way into the recurrences, a relative change of all rates by about a rounding, which turns the phase.
  const Scalar rounding = 4 * eps + walk + 2 * step_tolerance;
  const Scalar phase_error = rounding + eps * run.phase();
  const Scalar size = both.size()[column::angular_momentum] + problem.rotor_momentum.norm();
  ColumnErrors<Scalar> shared;
  shared[column::angular_momentum] = phase_error * size;
  shared[column::angular_velocity] = phase_error * size * problem.inverse_inertia[2];
  shared[column::angular_momentum_norm] = rounding * size;
  shared[column::energy] = rounding * size * both.size()[column::angular_velocity];
  if constexpr (with_attitude) shared[column::attitude] = 4 * (phase_error + eps * run.phase_at_rest());
  answer.error = both.relative(margin * both.difference() + shared);
  if (answer.stop_time > 0 && answer.stop_time < infinity<Scalar>) {
    answer.stop_error =
        Scalar(honesty::stop_margin) * margin * std::abs(companion.stop_time() - answer.stop_time) / answer.stop_time +
        2 * step_tolerance + Scalar(2e-13L) * std::max(Scalar(1), eps / Scalar(1e-15L));
  }
  answer.met = options.excess(answer.error) <= 1;
  return answer;
}

/// The error of |U| grows with the number of turns, that of the phase with its square.
template <Real Scalar>
Scalar first_step_tolerance(const Problem<Scalar>& problem, std::span<const Scalar> times,
                            const FullMotionOptions<Scalar>& options) noexcept {
  const FullCoefficients<Scalar> coefficients(problem);
  const Hold<Scalar> hold(problem);
  const Scalar size = (problem.momentum - coefficients.offset).norm();
  Scalar span = times.empty() ? Scalar(0) : times.back();
  if (hold.weakest > 0) {
    const Scalar stop = size / hold.weakest;
    span = options.find_stop ? stop : std::min(span, stop);
  }
  const Scalar phase = span * (coefficients.quadratic.cwiseAbs().maxCoeff() * size + coefficients.linear.norm() +
                               coefficients.rate.norm());
  constexpr Scalar finest = finest_step_tolerance<Scalar>;
  const Scalar first = options.tolerance * Scalar(honesty::first_share) /
                       (Scalar(honesty::drifting_base) + Scalar(honesty::drifting_phase) * phase * phase);
  return first >= finest ? std::min(first, Scalar(honesty::loosest_step)) : finest;
}

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<Vec3<Scalar>> momentum, const FullMotionOptions<Scalar>& options,
                                             const Quat<Scalar>* start_attitude,
                                             std::span<Quat<Scalar>> attitude) noexcept {
  if (momentum.size() != times.size()) return Errc::out_of_domain;
  if (start_attitude != nullptr && attitude.size() != times.size()) return Errc::out_of_domain;
  if (const Errc wrong = check_span(times); wrong != Errc::ok) return wrong;
  const auto finite = [](const auto& m) noexcept { return (m - m).isZero(0); };
  if (!finite(problem.inverse_inertia) || !finite(problem.rotor_momentum) || !finite(problem.control) ||
      !finite(problem.momentum) || !(std::abs(problem.drag) < infinity<Scalar>) ||
      !(options.tolerance == options.tolerance)) {
    return Errc::not_finite;
  }

  const Scalar step_tolerance = detail::first_step_tolerance(problem, times, options);
  const bool with_control = !problem.control.isZero(0);
  const Quat<Scalar> q = start_attitude != nullptr ? *start_attitude : Quat<Scalar>{};
  return tightened<Scalar>(options, step_tolerance, [&](Scalar tolerance, Scalar, double begin, double end) noexcept {
    const auto once = [&]<bool control, bool turning>() noexcept {
      return detail::full_motion_with_error<Scalar, control, turning>(problem, times, momentum, options, q, attitude,
                                                                      tolerance, begin, end);
    };
    if (start_attitude != nullptr)
      return with_control ? once.template operator()<true, true>() : once.template operator()<false, true>();
    return with_control ? once.template operator()<true, false>() : once.template operator()<false, false>();
  });
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                                     std::span<Vec3<double>>,
                                                                     const FullMotionOptions<double>&,
                                                                     const Quat<double>*,
                                                                     std::span<Quat<double>>) noexcept;
#endif

}  // namespace gyrostat::deceleration
