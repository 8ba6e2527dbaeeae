// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "gyrostat/body/principal_axes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/models/deceleration/orbit.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a decelerated gyrostat: Taylor series from the start to the last time asked for, through the stop.
namespace gyrostat::deceleration {

template <Real Scalar>
struct FullMotionOptions : MotionOptions<Scalar> {
  bool find_stop = true;  ///< go on behind the last time until the stop, if there is one
  /// Takes the errors, in units of the columns, at every stride-th time from the first, that of orbit_place in the place of the modulus; empty:
  /// not wanted.
  std::span<ColumnErrors<Scalar>> errors{};
  std::size_t stride = 1;
};

/// `error`: modulus and regime are no part of it, and have 0.
template <Real Scalar>
struct FullMotionAnswer : MotionOutcome<std::size(column_kinds), Scalar> {
  /// When U = 0 is reached and held, s; infinity if never; NaN if it was not looked for or the integration ended before.
  Scalar stop_time = nan<Scalar>;
  Scalar stop_error = 0;  ///< of the stop time, relative
};

/// How the control acts at U = 0, where its torque can be any -control n with |n| <= 1 (Filippov).
template <Real Scalar>
struct Hold {
  bool holds = false;  ///< U = 0 is kept once reached
  bool comes =
      true;  ///< U = 0 may be reached; false: about an axis that the control leaves alone the body is certain to turn on
  bool driven = false;  ///< at U = 0 the drag of the other law pushes on
  Scalar weakest = 0;   ///< lower bound of the rate at which |U| shrinks near U = 0, N m; 0 if there is none

  explicit Hold(const Problem<Scalar>& problem) noexcept {
    const Mat3<Scalar>& b = problem.control;
    const FullCoefficients<Scalar> coefficients(problem);
    const Vec3<Scalar> c = coefficients.constant;
    driven = !c.isZero(0);
    comes = !AxesLeftAlone<Scalar>(problem).keep(problem.momentum - coefficients.offset);
    if (b.isZero(0)) return;
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

  bool may_stop() const noexcept { return holds && comes; }

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

/// The full motion at the given times (s from the start, increasing, the first >= 0): the states in principal axes, but for modulus and
/// regime, which the equations do not need; the attitude only where one is given for the start. What lies behind a failure is NaN.
///
/// The stop is found to 1e-12 of its time: the steps shrink with |U| (FullSystem::step_limit) until the rest of the motion, |U| over the
/// torque, is below 1e-13 of the time. Behind it law total stays at M = 0, omega = -J^-1 l, and law carrier at M = l, omega = 0.
/// Where the control cannot hold U = 0 against the drag of the other law there is no stop.
///
/// The error is estimated by runs of neighbours in tighter steps (companions.hpp), of the stop time by their stops. A run that misses the
/// tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: not_increasing (times), not_finite (problem or times), out_of_domain (the spans differ in length).
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {},
                                             const Quat<Scalar>* start_attitude = nullptr) noexcept;

namespace detail {

/// But for the regime; and for the modulus, whose place has orbit_place.
template <Real Scalar>
State<Scalar> state_of(const Problem<Scalar>& problem, const Vec3<Scalar>& M, const Quat<Scalar>& q) noexcept {
  State<Scalar> state;
  state.momentum = M;
  state.norm = M.norm();
  state.energy = problem.energy(M);
  state.k2 = orbit_place(problem, M);
  state.attitude = q;
  return state;
}

/// What decides when a motion leaves an unstable rotation next to which it begins (gyrostat::leaving_direction), in principal axes; zero elsewhere.
template <Real Scalar>
Vec3<Scalar> leaving_direction_of(const Problem<Scalar>& of) noexcept {
  const Vec3<Scalar>&a = of.inverse_inertia, &M = of.momentum;
  return leaving_direction<Scalar>(M, a.cwiseProduct(M - of.rotor_momentum), a.asDiagonal());
}

/// A problem that differs from the given one by about `amount`: by what rounding makes of its data. What is zero stays so where the
/// motion keeps it.
///
/// Where the moments are exact (Problem::exact_moments) they and their differences change relatively, and the momentum component by component.
/// Else tensor and vectors come from a rotation, and every component errs as the greatest does: `R` takes the neighbour's principal axes to
/// those of the given problem.
template <Real Scalar>
struct Neighbour {
  Problem<Scalar> problem;
  Mat3<Scalar> R = Mat3<Scalar>::Identity();

  /// The problem itself.
  explicit Neighbour(const Problem<Scalar>& of) noexcept : problem(of) {}

  Neighbour(const Problem<Scalar>& of, Scalar amount, Aside aside) noexcept : problem(of) {
    const Vec3<Scalar> v = amount * neighbour_direction<Scalar>(aside);
    const Vec3<Scalar>& l = of.rotor_momentum;
    const Vec3<Scalar> parts = (of.momentum - l).cwiseAbs() + l.cwiseAbs();
    problem.drag *= 1 + v[0];
    problem.control *= 1 + v[1];
    const Vec3<Scalar> gaps = of.inverse_gaps();
    if (of.exact_moments) {
      const Vec3<Scalar> moved{gaps[0] * (1 + v[1]), gaps[1] * (1 + v[2]), gaps[0] * (1 + v[1]) + gaps[1] * (1 + v[2])};
      const Scalar first = of.inverse_inertia[0] * (1 + v[0]);
      problem.gaps = moved;
      problem.inverse_inertia = {first, first + moved[0], first + moved[2]};
      problem.momentum += momentum_shift(of, amount, aside).cwiseProduct(parts.cwiseMax(swing(of)));
      return;
    }
    // with all digits of the differences, so that axes of nearly equal moments turn as far as they must
    using Wide = Wider<Scalar>;
    const Wide first = of.inverse_inertia[0];
    const Scalar most = 1 / of.inverse_inertia[0];
    Mat3<Wide> tensor = Mat3<Wide>::Zero();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      tensor(i, i) = 1 / (i == 0 ? first : first + gaps[i == 1 ? 0 : 2]) + v[i] * most;
      tensor(j, k) = tensor(k, j) = v[k] * most;
    }
    const auto axes = PrincipalAxes<Scalar>::nearest_of(tensor);
    const Vec3<Scalar>& J = axes.moments;
    if (!(J.minCoeff() > 0)) return;
    R = axes.R_BP;
    const Mat3<Scalar> back = R.transpose();
    problem.inverse_inertia = J.cwiseInverse();
    problem.gaps = Vec3<Scalar>(axes.gaps[0] / J[0] / J[1], axes.gaps[1] / J[1] / J[2], axes.gaps[2] / J[0] / J[2]);
    problem.rotor_momentum = back * Vec3<Scalar>(l + l.norm() * v);
    // products of a control that has none would keep the motion beside a weak axis stiff for ever
    if (!of.control.isDiagonal(0)) problem.control = back * problem.control * R;
    problem.momentum = back * Vec3<Scalar>(of.momentum + of.momentum_terms() * momentum_shift(of, amount, aside));
  }

 private:
  /// In the direction of the other data; next to an unstable rotation also so that no part of what brings the motion away cancels another, nor what the
  /// other data do.
  static Vec3<Scalar> momentum_shift(const Problem<Scalar>& of, Scalar amount, Aside aside) noexcept {
    return amount * neighbour_direction<Scalar>(aside) +
           leaving_shift(leaving_direction_of(of), Scalar(1), amount, aside);
  }
  /// How far each component of the momentum moves in one radian of the motion, N m s: 0 where it is zero for ever.
  static Vec3<Scalar> swing(const Problem<Scalar>& of) noexcept {
    const FullCoefficients<Scalar> f(of);
    const Vec3<Scalar> U = of.momentum - f.offset, size = U.cwiseAbs();
    const Scalar norm = U.norm();
    Vec3<Scalar> torque = f.linear.cwiseAbs() * size + f.constant.cwiseAbs();
    if (norm > 0) torque += of.control.cwiseAbs() * (size / norm);
    for (int i = 0; i < 3; ++i) torque[i] += std::abs(f.quadratic[i]) * size[(i + 1) % 3] * size[(i + 2) % 3];
    const Scalar rate = f.quadratic.cwiseAbs().maxCoeff() * norm + f.linear.norm();
    return rate > 0 ? Vec3<Scalar>((torque / rate).cwiseMin(norm + of.rotor_momentum.norm())) : Vec3<Scalar>(0, 0, 0);
  }
};

/// One run of the equations, through the stop; of a neighbour, told in the axes of the given problem.
template <Real Scalar, bool with_control, bool with_attitude>
class Course {
  using System = FullSystem<Scalar, with_control, with_attitude>;
  using Solver = ode::Taylor<System>;
  static constexpr int width = System::width;

 public:
  /// reach: part of the way to U = 0 that one step may go at most.
  Course(const Neighbour<Scalar>& of, const Quat<Scalar>& attitude, Scalar step_tolerance, Scalar reach,
         std::uint64_t step_cap) noexcept
      : problem_(of.problem),
        R_(of.R),
        turn_(from_matrix(of.R)),
        turned_(!of.R.isIdentity(0)),
        f_(problem_),
        hold_(problem_),
        start_(start_of(turned_ ? attitude * turn_ : attitude)),
        system_(problem_, reach),
        solver_(system_, start_.time, start_.numbers, options_of(step_tolerance, step_cap)),
        step_cap_(step_cap),
        may_stop_(with_control && hold_.may_stop()),
        faded_(without_digits * (problem_.momentum - f_.offset).norm()) {
    if (!may_stop_ && !(with_control && hold_.weakest > 0)) stop_time_ = infinity<Scalar>;
    if (start_.at_rest) come_to_rest(0, start_.numbers.data());
    time_ = start_.at_rest ? Scalar(0) : start_.time;
  }

  /// One step, at most up to t_max; where the motion has come to rest, all the way.
  ode::Status step(Scalar t_max) noexcept {
    if (rests_) {
      time_ = t_max;
      return ode::Status::reached;
    }
    const ode::Status status = solver_.step(t_max);
    if (status != ode::Status::reached) return status;
    time_ = solver_.time();
    const Vec3<Scalar> U = opposed(solver_.state());
    const Scalar norm = U.norm();
    if (may_stop_ && system_.never_stops(solver_.state())) may_stop_ = false, stop_time_ = infinity<Scalar>;
    if (may_stop_) {
      // the rest of the motion: |U| falls at least at the weakest rate, in the end at the rate of its direction
      const Scalar fall = falling(U, norm), slowest = hold_.weakest > 0 ? std::min(hold_.weakest, fall) : fall;
      if (!(norm > 0) || norm <= Scalar(1e-13L) * precision_factor * time_ * slowest)
        come_to_rest(time_ + (norm > 0 ? norm / fall : Scalar(0)), solver_.state());
    } else if (with_control && norm < faded_) {
      come_to_rest(infinity<Scalar>, solver_.state());
    }
    if constexpr (with_control)
      if ((++trips_ & 255U) == 0 && fades(U, norm, t_max - time_)) return ode::Status::step_limit;
    return status;
  }

  Scalar time() const noexcept { return time_; }

  /// The state at t in the last step.
  State<Scalar> at(Scalar t) const noexcept {
    if (rests_ && t > solver_.time()) {
      // the last of U goes as it began to
      const bool ends = t < stop_time_ && stop_time_ < infinity<Scalar>;
      const Scalar left = ends ? (stop_time_ - t) / (stop_time_ - solver_.time()) : Scalar(0);
      return seen(state_of(problem_, Vec3<Scalar>(left * opposed(solver_.state()) + f_.offset), at_rest(t)));
    }
    alignas(32) Scalar x[width];
    solver_.at(t, x);
    return seen(state_of(problem_, Vec3<Scalar>(opposed(x) + f_.offset), quaternion(x)));
  }

  /// Moves the state by about `amount` of itself.
  void kick(Scalar amount) noexcept { solver_.kick(amount); }
  ode::Counts counts() const noexcept { return solver_.counts(); }
  bool rests() const noexcept { return rests_; }
  /// When U = 0 is reached and held, s; infinite where it never is, NaN before.
  Scalar stop_time() const noexcept { return stop_time_; }
  /// Whether the motion is bound to come to a stop.
  bool stops() const noexcept { return may_stop_ && hold_.weakest > 0; }
  /// Whether going on decides when the body stops, or that it never does; and whether that is decided.
  bool can_decide() const noexcept { return stops() || (may_stop_ && system_.tells_its_stop(solver_.state())); }
  bool is_decided() const noexcept { return rests_ || !may_stop_; }

 private:
  struct Start {
    Scalar time = 0;
    std::array<Scalar, width> numbers{};
    bool at_rest = false;
  };

  /// 1 for double and wider; float cannot resolve 1e-13.
  static constexpr Scalar precision_factor = std::max(Scalar(1), epsilon<Scalar> / Scalar(1e-15L));

  /// What is left of |U| where 1/|U| comes near overflow: nothing, without a stop.
  static constexpr Scalar without_digits = std::numeric_limits<Scalar>::min() / (epsilon<Scalar> * epsilon<Scalar>);

  static Vec3<Scalar> opposed(const Scalar* x) noexcept { return {x[0], x[1], x[2]}; }

  Start start_of(const Quat<Scalar>& attitude) const noexcept {
    Start start;
    Vec3<Scalar> U = problem_.momentum - f_.offset;
    if (U.isZero(0)) {
      // without a control what it would oppose tells a body at rest
      const bool still = problem_.law == Law::total || problem_.momentum == problem_.rotor_momentum;
      start.at_rest = hold_.holds || (!with_control && f_.constant.isZero(0) && still);
      if (with_control && !start.at_rest) start.time = leave(U);
    }
    for (int i = 0; i < 3; ++i) start.numbers[static_cast<std::size_t>(i)] = U[i];
    if constexpr (with_attitude) {
      start.numbers[4] = attitude.w;
      start.numbers[5] = attitude.x;
      start.numbers[6] = attitude.y;
      start.numbers[7] = attitude.z;
    }
    return start;
  }

  auto options_of(Scalar step_tolerance, std::uint64_t step_cap) const noexcept {
    ode::TaylorOptions<Scalar, width> how;
    how.tolerance = step_tolerance;
    how.step_cap = step_cap;
    // the carrier's share of the momentum sets the energy; where it is the small part of M it needs its own digits
    const Scalar whole = std::max(problem_.momentum.norm(), (problem_.momentum - f_.offset).norm());
    const Scalar share = (problem_.momentum - problem_.rotor_momentum).norm();
    Scalar size = share > Scalar(1e-4L) * whole ? std::min(share, whole) : whole;
    if (!(size > 0)) size = share > 0 ? share : Scalar(1);
    for (std::size_t i = 0; i < 3; ++i) how.scale[i] = size;
    for (std::size_t i = 4; i < width; ++i) how.scale[i] = 1;
    return how;
  }

  Scalar falling(const Vec3<Scalar>& U, Scalar norm) const noexcept {
    const Vec3<Scalar> n = U / norm;
    return n.dot(problem_.control * n) - n.dot(f_.constant);
  }

  /// A step goes at most a part of |U|/torque. Where |U| fades without a stop ahead, the steps only grow shorter: whether `left` seconds are
  /// more than all that are allowed will cover.
  bool fades(const Vec3<Scalar>& U, Scalar norm, Scalar left) const noexcept {
    if (stops()) return false;
    const Scalar fall = falling(U, norm);
    const auto budget = static_cast<Scalar>(step_cap_ - std::min<std::uint64_t>(step_cap_, solver_.counts().steps));
    return fall >= 0 && fall * left < norm && left > budget * system_.step_limit(solver_.state());
  }

  Quat<Scalar> quaternion(const Scalar* x) const noexcept {
    if constexpr (with_attitude) {
      const Scalar size = 1 / std::sqrt(x[4] * x[4] + x[5] * x[5] + x[6] * x[6] + x[7] * x[7]);
      return {x[4] * size, x[5] * size, x[6] * size, x[7] * size};
    } else {
      return {};
    }
  }

  /// Behind the stop U = 0.
  void come_to_rest(Scalar stop, const Scalar* x) noexcept {
    rests_ = true;
    stop_time_ = stop;
    rest_begins_ = time_;
    attitude_at_rest_ = quaternion(x);
  }

  /// In the axes of the given problem.
  State<Scalar> seen(State<Scalar> state) const noexcept {
    if (!turned_) return state;
    state.momentum = R_ * state.momentum;
    state.attitude = state.attitude * conjugate(turn_);
    return state;
  }

  Quat<Scalar> at_rest(Scalar t) const noexcept {
    const Vec3<Scalar>& w = f_.rate;
    const Scalar rate = w.norm();
    const Quat<Scalar>& q = attitude_at_rest_;
    if (!with_attitude || !(rate > 0)) return q;
    const Scalar half = (t - rest_begins_) * rate / 2;
    const Scalar c = std::cos(half), s = std::sin(half) / rate;
    return q * Quat<Scalar>{c, w[0] * s, w[1] * s, w[2] * s};
  }

  /// U = 0 that the control cannot hold: U leaves along the one direction n with (s + control) n = c, s > 0. Sets U a moment later
  /// and returns that moment; it is so short that the square of it is lost in rounding.
  Scalar leave(Vec3<Scalar>& U) const noexcept {
    const Vec3<Scalar>& c = f_.constant;
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
    const Scalar rate = f_.linear.norm() + f_.quadratic.cwiseAbs().maxCoeff() * problem_.rotor_momentum.norm();
    const Scalar moment = epsilon<Scalar> / (rate > 0 ? rate : Scalar(1));
    U = s * moment * n.normalized();
    return moment;
  }

  Problem<Scalar> problem_;
  Mat3<Scalar> R_;
  Quat<Scalar> turn_;
  bool turned_;
  FullCoefficients<Scalar> f_;
  Hold<Scalar> hold_;
  Start start_;
  System system_;
  Solver solver_;
  std::uint64_t step_cap_;
  std::uint32_t trips_ = 0;
  bool may_stop_, rests_ = false;
  Scalar faded_;  ///< |U| that counts as none, N m s
  Scalar time_ = 0, stop_time_ = nan<Scalar>, rest_begins_ = 0;
  Quat<Scalar> attitude_at_rest_{};
};

/// Goes on to the stop, at most up to t_max.
template <class Course, Real Scalar>
ode::Status go_to_rest(Course& course, Scalar t_max, const MotionOptions<Scalar>& options) noexcept {
  ode::Status status = ode::Status::reached;
  for (std::uint32_t trips = 1; status == ode::Status::reached && !course.is_decided() && course.time() < t_max;
       ++trips) {
    status = course.step(t_max);
    if ((trips & 255U) == 0 && options.cancelled()) status = ode::Status::cancelled;
  }
  return status;
}

/// How fast U and the axes turn at the start, rad/s.
template <Real Scalar>
Scalar turning_rate(const Problem<Scalar>& problem) noexcept {
  const FullCoefficients<Scalar> f(problem);
  return f.quadratic.cwiseAbs().maxCoeff() * (problem.momentum - f.offset).norm() + f.linear.norm() + f.rate.norm();
}

/// What an evaluation of the columns loses, in their units, where the state is known to `relative`; walked: of the momentum at the start, what the
/// steps have lost; at_rest: angle turned through behind the stop, rad.
template <Real Scalar>
ColumnErrors<Scalar> rounding_of_columns(const Problem<Scalar>& problem, const ColumnErrors<Scalar>& size,
                                         Scalar relative, Scalar walked, Scalar at_rest) noexcept {
  const Scalar M = size[column::angular_momentum] + problem.rotor_momentum.norm();
  const Scalar omega = size[column::angular_velocity];
  // moments that come from a tensor err as the greatest does
  const Scalar slim = problem.exact_moments ? Scalar(1) : problem.inverse_inertia[2] / problem.inverse_inertia[0];
  ColumnErrors<Scalar> error;
  // steps are as long, and lose as much, where little of it is left
  const Scalar off = relative * M + walked * problem.momentum.norm();
  error[column::angular_momentum] = off;
  error[column::angular_velocity] = (relative + walked) * (M * problem.inverse_inertia[2] + slim * omega);
  error[column::angular_momentum_norm] = off;
  error[column::energy] = off * omega;
  error[column::attitude] = 4 * (relative + walked + epsilon<Scalar> * at_rest);
  return error;
}

/// How many times over a rounding of the tensor counts in the motion: where a moment is slight, or two are so near that it turns their axes; or one of
/// the start.
template <Real Scalar>
Condition<Scalar> condition_of(const Problem<Scalar>& problem) noexcept {
  const Vec3<Scalar>& a = problem.inverse_inertia;
  const Scalar of_start = start_sensitivity(leaving_direction_of(problem));
  if (problem.exact_moments) return {1, of_start};
  const Vec3<Scalar> gaps = problem.inverse_gaps();
  Scalar of_tensor = a[2] / a[0];
  if (gaps[0] > 0) of_tensor = std::max(of_tensor, a[1] / gaps[0]);
  if (gaps[1] > 0) of_tensor = std::max(of_tensor, a[1] * a[2] / a[0] / gaps[1]);
  return {of_tensor, of_start};
}

/// The answer's run, its neighbours' side by side, and their distance.
template <Real Scalar, bool with_control, bool with_attitude>
class FullMotion {
 public:
  FullMotion(const Problem<Scalar>& problem, std::span<const Scalar> times, std::span<State<Scalar>> states,
             const FullMotionOptions<Scalar>& options, const Quat<Scalar>& attitude) noexcept
      : problem_(problem), times_(times), states_(states), options_(options), attitude_(attitude), itself_(problem) {}

  FullMotionAnswer<Scalar> run(Scalar step_tolerance, double progress_from, double progress_to) const noexcept {
    constexpr Scalar eps = epsilon<Scalar>;
    FullMotionAnswer<Scalar> answer;
    answer.step_tolerance = step_tolerance;
    const Scalar tight = companion_step(step_tolerance);
    const Condition<Scalar> condition = condition_of(problem_);
    const Scalar change = data_change(step_tolerance, condition);
    Run course(itself_, attitude_, step_tolerance, Scalar(honesty::reach), options_.step_cap);
    Run companion(Neighbour<Scalar>(problem_, change, Aside::first), attitude_, tight, Scalar(honesty::companion_reach),
                  options_.step_cap);
    std::optional<Run> second;
    if (rounding_rules(step_tolerance, condition))
      second.emplace(Neighbour<Scalar>(problem_, change, second_aside(condition)), attitude_, tight,
                     Scalar(honesty::second_reach), options_.step_cap);
    const Runs<Run> runs{course, companion, second ? &*second : nullptr};
    if (!times_.empty()) {
      const Row<Scalar> row(problem_);
      const Scalar last = times_.back();
      const auto rounding = [&](const ColumnErrors<Scalar>& size, Scalar steps) noexcept {
        const Scalar rest = last > course.stop_time() ? last - course.stop_time() : Scalar(0);
        const Scalar gyro = problem_.gyro_rate().norm(), omega = size[column::angular_velocity];
        // omega is the difference of J^-1 M and J^-1 l in every step
        const Scalar swell = problem_.law == Law::total && omega > 0 ? std::min(gyro / omega, Scalar(100)) : Scalar(0);
        return rounding_of_columns(problem_, size, 3 * eps + 6 * swell * steps, shared_rounding(steps), rest * gyro);
      };
      const auto note = [&](std::size_t i, const ColumnErrors<Scalar>& error) noexcept {
        if (i / options_.stride < options_.errors.size()) options_.errors[i / options_.stride].raise(error);
      };
      const State<Scalar> start = state_of(problem_, problem_.momentum, attitude_);
      const State<Scalar> nowhere = state_of(problem_, Vec3<Scalar>(Vec3<Scalar>::Constant(nan<Scalar>)),
                                             Quat<Scalar>{nan<Scalar>, nan<Scalar>, nan<Scalar>, nan<Scalar>});
      solve_beside(answer, row, runs, {start, times_, states_, nowhere, progress_from, progress_to}, options_, rounding,
                   note);
      if (answer.status == ode::Status::reached) add_rounding(row, rounding, answer.counts.steps, !second);
      if (!with_attitude) answer.error[column::attitude] = 0;
      answer.error[column::modulus_squared] = 0;
      for (State<Scalar>& state : states_) state.k2 = 0;
    }
    look_for_stop(answer, runs);
    answer.counts = runs.counts();
    answer.met = answer.status == ode::Status::reached && options_.excess(answer) <= 1;
    return answer;
  }

 private:
  using Run = Course<Scalar, with_control, with_attitude>;

  /// To the errors at single times, what no distance shows.
  template <class Rounding>
  void add_rounding(const Row<Scalar>& row, const Rounding& rounding, std::uint64_t steps, bool lone) const noexcept {
    const Scalar relative = epsilon<Scalar> * std::sqrt(static_cast<Scalar>(steps));
    for (std::size_t i = 0; i < options_.errors.size() && i * options_.stride < states_.size(); ++i) {
      Comparison size(row);
      size.add(states_[i * options_.stride]);
      options_.errors[i] = stated_error(options_.errors[i], rounding(size.size(), relative), lone);
    }
  }

  void look_for_stop(FullMotionAnswer<Scalar>& answer, const Runs<Run>& runs) const noexcept {
    if (answer.status != ode::Status::reached) return;
    const auto go = [&](Run& run, Scalar t_max) noexcept {
      if (answer.status == ode::Status::reached) answer.status = go_to_rest(run, t_max, options_);
    };
    if (options_.find_stop && runs.answer.can_decide()) go(runs.answer, infinity<Scalar>);
    if (answer.status != ode::Status::reached) {
      if (times_.empty() || answer.status == ode::Status::cancelled) return;
      answer.status = ode::Status::reached;  // the asked times are answered all the same
      answer.stop_error = infinity<Scalar>;
      return;
    }
    const Scalar stop = answer.stop_time = runs.answer.stop_time();
    if (!(stop > 0 && stop < infinity<Scalar>)) return;
    const auto stop_of = [&](Run& run) noexcept {
      go(run, 2 * stop);
      return std::min(run.stop_time(), 2 * stop);
    };
    const Scalar one = stop_of(runs.companion), two = runs.second != nullptr ? stop_of(*runs.second) : one;
    const Scalar apart = error_of_distances(std::max(std::abs(one - stop), std::abs(two - stop)), std::abs(one - two));
    answer.stop_error = Scalar(honesty::stop_margin) * apart / stop +
                        Scalar(honesty::stop_steps) * answer.step_tolerance +
                        Scalar(honesty::stop_rounding) *
                            shared_rounding(epsilon<Scalar> * std::sqrt(Scalar(runs.answer.counts().steps)));
    // where the runs have parted, three of them may stop together by chance: what they had |M| apart takes the weakest torque so long
    if (!times_.empty() && !(answer.error[column::angular_momentum] < 1))
      answer.stop_error += Scalar(honesty::stop_margin) * answer.error[column::angular_momentum_norm] *
                           problem_.momentum.norm() / (Hold<Scalar>(problem_).weakest * stop);
  }

  const Problem<Scalar>& problem_;
  std::span<const Scalar> times_;
  std::span<State<Scalar>> states_;
  const FullMotionOptions<Scalar>& options_;
  Quat<Scalar> attitude_;
  Neighbour<Scalar> itself_;
};

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
                                             std::span<State<Scalar>> states, const FullMotionOptions<Scalar>& options,
                                             const Quat<Scalar>* start_attitude) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(column_kinds)); wrong != Errc::ok) return wrong;
  const auto finite = [](const auto& m) noexcept { return (m - m).isZero(0); };
  if (!finite(problem.inverse_inertia) || !finite(problem.rotor_momentum) || !finite(problem.control) ||
      !finite(problem.momentum) || !(std::abs(problem.drag) < infinity<Scalar>)) {
    return Errc::not_finite;
  }

  const Scalar first = detail::first_step_tolerance(problem, times, options);
  const auto solve = [&]<bool control, bool turning>() noexcept {
    const Quat<Scalar> q = turning ? *start_attitude : Quat<Scalar>{};
    const detail::FullMotion<Scalar, control, turning> motion(problem, times, states, options, q);
    return tightened<Scalar>(options, first, [&](Scalar tolerance, Scalar, double begin, double end) noexcept {
      return motion.run(tolerance, begin, end);
    });
  };
  const bool turning = start_attitude != nullptr;
  if (!problem.control.isZero(0))
    return turning ? solve.template operator()<true, true>() : solve.template operator()<true, false>();
  return turning ? solve.template operator()<false, true>() : solve.template operator()<false, false>();
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                                     std::span<State<double>>,
                                                                     const FullMotionOptions<double>&,
                                                                     const Quat<double>*) noexcept;
#endif

}  // namespace gyrostat::deceleration
