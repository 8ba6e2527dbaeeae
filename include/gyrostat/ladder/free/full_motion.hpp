// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/free/full.hpp"
#include "gyrostat/models/free/problem.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a free gyrostat by Taylor series.
namespace gyrostat::free {

/// Places in full_columns.
namespace full_column {
enum : std::size_t { attitude, angular_velocity, angular_momentum, turned };
}

/// What the full equations are compared by.
inline constexpr ColumnKind full_columns[] = {
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity, body axes",
     "where it vanishes at t = 0: a thousandth of what the momenta would turn the body with, over its greatest moment"},
    {"angular_momentum", 3, "N m s", Frame::body, Measure::relative, "total angular momentum, body axes",
     "where it vanishes at t = 0: the momenta of body and rotors, which cancel"},
    {"turned", 3, "rad", Frame::body, Measure::relative, "integral of the angular velocity, body axes", "0.001 rad"},
};

template <Real Scalar>
using FullErrors = Errors<std::size(full_columns), Scalar>;

/// Writes full_columns of a state, one behind the other.
template <Real S>
struct FullRow {
  using Scalar = S;
  using State = FullState<S>;
  static constexpr const auto& columns = full_columns;

  FullErrors<S> scale{};

  /// The scales that a start sets, in units of the columns.
  explicit FullRow(const Problem<S>& problem) noexcept {
    const auto p = PrincipalProblem<S>::of(problem);
    const S l = p.l.norm();
    if (p.omega.isZero(0)) scale[full_column::angular_velocity] = share * (p.M.norm() + l) / p.moments[0];
    scale[full_column::angular_momentum] = share * l;
    scale[full_column::turned] = share;
  }

  void operator()(const State& state, S* row) const noexcept {
    const auto& [q, w, M, W] = state;
    for (const S value : {q.x, q.y, q.z, q.w, w[0], w[1], w[2], M[0], M[1], M[2], W[0], W[1], W[2]}) *row++ = value;
  }

  /// |angular_velocity|.
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return std::hypot(row[4], row[5], row[6]);
  }

 private:
  static constexpr S share = S(1e-3L);
};

template <Real Scalar>
using FullMotionOptions = MotionOptions<Scalar>;

template <Real Scalar>
using FullMotionAnswer = MotionOutcome<std::size(full_columns), Scalar>;

/// How fast the body turns, or M in it, a bound of the order of |omega|, rad/s.
template <Real Scalar>
Scalar turning_rate(const PrincipalProblem<Scalar>& p) noexcept {
  return p.inverse[2] * p.M.norm() + p.inverse.cwiseProduct(p.l).norm();
}
template <Real Scalar>
Scalar turning_rate(const Problem<Scalar>& problem) noexcept {
  return turning_rate(PrincipalProblem<Scalar>::of(problem));
}

/// The full motion at the given times (s, increasing, the first >= 0). What lies behind a failure is NaN.
///
/// The error is estimated by runs of neighbours: body and start differ by a few roundings, and the steps have a tighter tolerance
/// (companions.hpp). Their distance from the answer, watched in every step and kept for some twenty turns, is the error of the answer,
/// and shows what the motion makes of errors: that phases drift, and that all differences grow where it leaves an unstable rotation. A run
/// that misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: out_of_domain (the spans differ in length), not_increasing (times), not_finite (times, tolerance or momentum), and those of
/// Problem::check().
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<FullState<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {}) noexcept;

namespace detail {

/// One run of the equations.
template <Real Scalar>
class FullCourse {
 public:
  static constexpr bool goes_on_alike = true;

  FullCourse(const Problem<Scalar>& problem, Scalar tolerance, std::uint64_t step_cap) noexcept
      : system_(problem), solver_(system_, 0, system_.start(), options(system_, tolerance, step_cap)) {}

  /// One step, at most up to t_max.
  ode::Status step(Scalar t_max) noexcept { return solver_.step(t_max); }
  Scalar time() const noexcept { return solver_.time(); }
  /// The state at t in the last step.
  FullState<Scalar> at(Scalar t) const noexcept {
    alignas(32) Scalar x[System::width];
    solver_.at(t, x);
    return system_.state(t, x);
  }
  /// Moves the state by about `amount` of itself.
  void kick(Scalar amount) noexcept { solver_.kick(amount); }
  const ode::Counts& counts() const noexcept { return solver_.counts(); }
  const FullSystem<Scalar>& system() const noexcept { return system_; }

 private:
  using System = FullSystem<Scalar>;
  using Solver = ode::Taylor<System>;

  static auto options(const System& system, Scalar tolerance, std::uint64_t step_cap) noexcept {
    typename Solver::Options options;
    options.tolerance = tolerance;
    options.scale = system.scale();
    options.step_cap = step_cap;
    return options;
  }
  System system_;
  Solver solver_;
};

/// By how much the inverse of the tensor, of a diagonal one not at all, or the start magnifies rounding.
template <Real Scalar>
Condition<Scalar> condition_of(const Problem<Scalar>& of) noexcept {
  const Mat3<Scalar> inverse = of.inertia.inverse();
  const Vec3<Scalar> M = of.momentum();
  const Scalar of_start = start_sensitivity<Scalar>(M, inverse * Vec3<Scalar>(M - of.rotor_momentum), inverse);
  if (of.inertia.isDiagonal(0)) return {1, of_start};
  return {of.inertia.cwiseAbs().maxCoeff() * inverse.cwiseAbs().maxCoeff(), of_start};
}

/// Whether zeros of the data stay zero by a symmetry: rotation about one axis of a diagonal tensor, which the rotors turn about too.
template <Real Scalar>
bool keeps_axis(const Problem<Scalar>& of) noexcept {
  const Vec3<Scalar>&l = of.rotor_momentum, &v = of.momentum_given ? of.angular_momentum : of.angular_velocity;
  if (!of.inertia.isDiagonal(0)) return false;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (v[i] == 0 && v[j] == 0 && l[i] == 0 && l[j] == 0) return true;
  }
  return false;
}

/// A problem that differs from the given one by about `amount`: by what rounding makes of data and arithmetic. A body at rest and one
/// without momentum stay so, and so do zeros that a symmetry keeps.
template <Real Scalar>
Problem<Scalar> beside(const Problem<Scalar>& of, Scalar amount, Aside aside) noexcept {
  const Vec3<Scalar> direction = neighbour_direction<Scalar>(aside);
  Problem<Scalar> near = of;
  const bool diagonal = of.inertia.isDiagonal(0), kept = keeps_axis(of);
  if (diagonal) near.inertia += amount * of.inertia * moment_shifts<Scalar>(aside).asDiagonal();
  else near.inertia += amount * of.inertia.cwiseAbs().maxCoeff() * tensor_shifts<Scalar>(aside);

  const auto moved = [&](const Vec3<Scalar>& v, Scalar share) noexcept {
    const Scalar by = share * v.cwiseAbs().maxCoeff();
    Vec3<Scalar> made = v;
    for (int i = 0; i < 3; ++i)
      if (v[i] != 0 || !kept) made[i] += by * direction[i];
    return made;
  };
  near.rotor_momentum = moved(of.rotor_momentum, amount);
  near.angular_velocity = moved(of.angular_velocity, -amount);
  near.angular_momentum =
      of.angular_momentum == of.rotor_momentum ? near.rotor_momentum : moved(of.angular_momentum, -amount);
  if (kept) return near;
  const Mat3<Scalar> inverse = of.inertia.inverse();
  const Vec3<Scalar> M = of.momentum(), own = M - of.rotor_momentum;
  const Vec3<Scalar> leaving = leaving_direction<Scalar>(M, inverse * own, inverse);
  const Scalar size = std::max(own.cwiseAbs().maxCoeff(), of.rotor_momentum.cwiseAbs().maxCoeff());
  const Vec3<Scalar> shift = leaving_shift(leaving, size, amount, aside);
  near.angular_velocity += inverse * shift, near.angular_momentum += shift;
  return near;
}

template <Real Scalar>
class FullMotion {
 public:
  FullMotion(const Problem<Scalar>& problem, std::span<const Scalar> times, std::span<FullState<Scalar>> states,
             const FullMotionOptions<Scalar>& options) noexcept
      : problem_(problem), times_(times), states_(states), options_(options), turning_(turning_rate(problem)) {}

  /// The answer's run and its neighbours' side by side, and their distance.
  FullMotionAnswer<Scalar> run(Scalar step_tolerance, double progress_from, double progress_to) const noexcept {
    FullMotionAnswer<Scalar> answer;
    answer.step_tolerance = step_tolerance;
    FullCourse<Scalar> course(problem_, step_tolerance, options_.step_cap);
    const Scalar tight = companion_step(step_tolerance);
    const Condition<Scalar> condition = condition_of(problem_);
    const Scalar change = data_change(step_tolerance, condition);
    FullCourse<Scalar> companion(beside(problem_, change, Aside::first), tight, options_.step_cap);
    std::optional<FullCourse<Scalar>> second;
    if (rounding_rules(step_tolerance, condition))
      second.emplace(beside(problem_, change, second_aside(condition)), tight, options_.step_cap);
    const auto& system = course.system();
    const FullState<Scalar> start = system.state(0, system.start().data());
    // rounding at the asked times
    const auto rounding = [&](const FullErrors<Scalar>& size, Scalar steps) noexcept {
      const Scalar relative = shared_rounding(steps);
      const auto lost = system.losses(2 * relative);
      FullErrors<Scalar> error;
      error[full_column::attitude] = 4 * relative;
      error[full_column::angular_velocity] = lost.angular_velocity;
      error[full_column::angular_momentum] = lost.angular_momentum;
      error[full_column::turned] = 4 * relative * size[full_column::turned];
      // of the polynomial of one step, too
      if (turning_ > 0) error[full_column::turned] += lost.angular_velocity / turning_;
      return error;
    };
    solve_beside(answer, FullRow<Scalar>(problem_),
                 Runs<FullCourse<Scalar>>{course, companion, second ? &*second : nullptr},
                 {start, times_, states_, nowhere(), progress_from, progress_to}, options_, rounding);
    return answer;
  }

  Scalar turning() const noexcept { return turning_; }
  /// The angle turned through up to the last time, to its order, rad.
  Scalar phase() const noexcept { return turning_ * times_.back(); }

 private:
  static FullState<Scalar> nowhere() noexcept {
    constexpr Scalar no = nan<Scalar>;
    return {{no, no, no, no}, {no, no, no}, {no, no, no}, {no, no, no}};
  }

  const Problem<Scalar>& problem_;
  std::span<const Scalar> times_;
  std::span<FullState<Scalar>> states_;
  const FullMotionOptions<Scalar>& options_;
  Scalar turning_;
};

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<FullState<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(full_columns)); wrong != Errc::ok) return wrong;
  if (const Errc wrong = problem.check(); wrong != Errc::ok) return wrong;
  FullMotionAnswer<Scalar> answer;
  answer.met = true;
  if (times.empty()) return answer;

  const detail::FullMotion<Scalar> motion(problem, times, states, options);
  if (!(motion.turning() < infinity<Scalar>)) return Errc::not_finite;
  const Scalar first =
      first_step_tolerance_of_phase<Scalar>(options.tolerance, motion.phase(), Scalar(honesty::loosest_step));
  return tightened<Scalar>(options, first, [&](Scalar step_tolerance, Scalar, double begin, double end) noexcept {
    return motion.run(step_tolerance, begin, end);
  });
}

}  // namespace gyrostat::free
