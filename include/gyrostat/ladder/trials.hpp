// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The tightest step tolerance that a Taylor integrator is asked for.
template <Real Scalar>
inline constexpr Scalar finest_step_tolerance = epsilon<Scalar> / 8;

/// The step tolerance of a companion of an answer in steps of this tolerance.
template <Real Scalar>
constexpr Scalar companion_step(Scalar step_tolerance) noexcept {
  return std::max(finest_step_tolerance<Scalar>, step_tolerance / Scalar(honesty::side_by_side.tighter));
}

/// How many times over a rounding of the data counts in a motion.
template <Real Scalar>
struct Condition {
  Scalar tensor =
      1;  ///< of the inertia: greatest moment over the least, where they come from a tensor and err as the greatest does
  Scalar start = 1;  ///< start_sensitivity()
  constexpr Scalar worst() const noexcept { return std::max(tensor, start); }
};

/// Whether rounding rules in steps of this tolerance, so that one companion may be near by chance.
template <Real Scalar>
constexpr bool rounding_rules(Scalar step_tolerance, const Condition<Scalar>& condition = {}) noexcept {
  return step_tolerance < Scalar(honesty::rounding_below) * epsilon<Scalar> * condition.worst();
}

/// Relative change of the data of companions, for an answer with steps of this tolerance.
template <Real Scalar>
constexpr Scalar data_change(Scalar step_tolerance, const Condition<Scalar>& condition = {}) noexcept {
  return epsilon<Scalar> *
         Scalar(rounding_rules(step_tolerance, condition) ? honesty::side_by_side.data_change : honesty::alone_change);
}

/// What decides when a motion leaves an unstable steady rotation next to which it begins: along this direction a change of the momentum counts, across it not.
/// Not of unit length; zero elsewhere. From the total momentum, the rate and the inverse of the tensor in one frame.
template <Real Scalar>
Vec3<Scalar> leaving_direction(const Vec3<Scalar>& momentum, const Vec3<Scalar>& rate,
                               const Mat3<Scalar>& inverse) noexcept {
  const Scalar size = momentum.norm(), whole = size * rate.norm(), across = cross<Scalar>(rate, momentum).norm();
  if (!(across < Scalar(honesty::next_to_unstable) * whole)) return {0, 0, 0};
  // the energy over the sphere of the momentum has a saddle there
  const Vec3<Scalar> along = momentum / size;
  int least = 0;
  along.cwiseAbs().minCoeff(&least);
  const Vec3<Scalar> one = cross<Scalar>(along, Vec3<Scalar>::Unit(least)).normalized(),
                     two = cross<Scalar>(along, one);
  const Scalar lift = rate.dot(along) / size;
  const Scalar first = one.dot(inverse * one) - lift, second = two.dot(inverse * two) - lift,
               both = one.dot(inverse * two);
  if (!(first * second < both * both)) return {0, 0, 0};
  // of dM/dt = M x w beside it, in these two axes, the left eigenvector of what grows: in that of its two forms which does not cancel
  const Scalar grows = std::sqrt(both * both - first * second);
  return both > 0 ? Vec3<Scalar>(first * one + (both + grows) * two)
                  : Vec3<Scalar>((both - grows) * one + second * two);
}
/// Factor by which a change of the start counts more: next to an unstable steady rotation the motion may linger, and how far off it began decides when it
/// leaves. 1 elsewhere.
template <Real Scalar>
Scalar start_sensitivity(const Vec3<Scalar>& leaving) noexcept {
  return leaving.isZero(0) ? Scalar(1) : Scalar(honesty::unstable_condition);
}
template <Real Scalar>
Scalar start_sensitivity(const Vec3<Scalar>& momentum, const Vec3<Scalar>& rate, const Mat3<Scalar>& inverse) noexcept {
  return start_sensitivity(leaving_direction(momentum, rate, inverse));
}

/// How the data of a companion differ: the first one's, a second one's, and a second one's opposite to the first.
enum class Aside : std::uint8_t { first, second, opposite };

/// How a second companion's do. Where the start decides when a motion leaves a rotation, one number rules all, and truncation and rounding of
/// the answer may be near what the data make of it in two companions, but not in two that lie on opposite sides.
template <Real Scalar>
constexpr Aside second_aside(const Condition<Scalar>& condition) noexcept {
  return condition.start > 1 ? Aside::opposite : Aside::second;
}

/// By how much the momentum of a companion, of this size, differs beside its other data where the start is next to an unstable rotation, so that nothing of what
/// brings the motion away cancels. leaving: leaving_direction().
template <Real Scalar>
Vec3<Scalar> leaving_shift(const Vec3<Scalar>& leaving, Scalar size, Scalar amount, Aside aside,
                           double factor = honesty::leaving_shift) noexcept {
  const Scalar by = Scalar(factor) * amount * size;
  return (aside == Aside::first ? by : -by) * leaving.cwiseSign();
}

/// One row of a table of displacements (honesty.hpp), a number at a time.
template <Real Scalar, std::size_t count>
constexpr Scalar displacement(const double (&table)[2][count], Aside aside, std::size_t place) noexcept {
  const Scalar size = Scalar(table[aside == Aside::second ? 1 : 0][place]);
  return aside == Aside::opposite ? -size : size;
}

/// The direction in which the vectors of a companion's data differ.
template <Real Scalar>
Vec3<Scalar> neighbour_direction(Aside aside) noexcept {
  const auto by = [aside](std::size_t i) noexcept { return displacement<Scalar>(honesty::directions, aside, i); };
  return {by(0), by(1), by(2)};
}

/// By how much the moments of a companion's tensor differ, along the diagonal.
template <Real Scalar>
Vec3<Scalar> moment_shifts(Aside aside) noexcept {
  const auto by = [aside](std::size_t i) noexcept { return displacement<Scalar>(honesty::moment_shifts, aside, i); };
  return {by(0), by(1), by(2)};
}

/// By how much the tensor of a companion, where it is not diagonal, differs: over its greatest moment.
template <Real Scalar>
Mat3<Scalar> tensor_shifts(Aside aside) noexcept {
  const auto by = [aside](std::size_t i) noexcept { return displacement<Scalar>(honesty::tensor_shifts, aside, i); };
  Mat3<Scalar> made;
  made << by(0), by(3), by(4), by(3), by(1), by(5), by(4), by(5), by(2);
  return made;
}

/// First guess of the step tolerance of a motion that turns through `phase` rad.
template <Real Scalar>
Scalar first_step_tolerance(Scalar tolerance, Scalar phase, Scalar loosest) noexcept {
  const Scalar share =
      tolerance * Scalar(honesty::first_share) / (Scalar(honesty::first_base) + phase / Scalar(honesty::first_angle));
  return std::max(finest_step_tolerance<Scalar>, std::min(share, loosest));
}

/// The same of a body without weight, whose phase errs with the square of the angle.
template <Real Scalar>
Scalar first_step_tolerance_of_phase(Scalar tolerance, Scalar phase, Scalar loosest) noexcept {
  const Scalar of_rates = first_step_tolerance(tolerance, phase, loosest);
  const Scalar drift = Scalar(honesty::first_drift) * phase * phase;
  const Scalar of_phase = tolerance * Scalar(honesty::first_share) / (Scalar(honesty::first_base) + drift);
  return std::min(of_rates, std::max(of_phase, Scalar(honesty::drifting_least)));
}

/// The same of a spinner (honesty::spinning_share): looser where two companions judge it all the same.
template <Real Scalar>
Scalar first_step_tolerance_of_spinner(Scalar tolerance, Scalar phase) noexcept {
  const Scalar of_two = Scalar(honesty::rounding_below) * epsilon<Scalar> / 2;
  return std::max(first_step_tolerance(tolerance, phase, Scalar(honesty::loosest_step)),
                  first_step_tolerance(Scalar(honesty::spinning_share) * tolerance, phase, of_two));
}

/// Runs with a step tolerance, and up to twice more with a tighter one while the estimated error exceeds options.tolerance and a
/// tighter one may help and the steps so far are not too many. run(step_tolerance, tightened, progress_from, progress_to) gives an
/// answer with status, met, error and counts; `tightened` is by how much more was wanted than in the run before, infinite for the finest. The last answer is returned, with the
/// counts of all.
template <Real Scalar, class Options, class Run>
auto tightened(const Options& options, Scalar step_tolerance, const Run& run) noexcept {
  constexpr Scalar finest = finest_step_tolerance<Scalar>;
  constexpr double part[] = {0.0, 0.7, 0.9, 1.0};
  ode::Counts counts;
  Scalar by = 1;
  for (int trial = 0;; ++trial) {
    auto answer = run(step_tolerance, by, part[trial], part[trial + 1]);
    counts += answer.counts;
    answer.counts = counts;
    if (answer.met || trial == 2 || answer.status != ode::Status::reached || step_tolerance <= finest ||
        static_cast<double>(counts.steps) > honesty::retry_steps) {
      options.report(1);
      return answer;
    }
    const Scalar excess = options.excess(answer);
    by = excess > 1 ? Scalar(honesty::retry) * excess : infinity<Scalar>;
    step_tolerance = std::max(finest, step_tolerance / by);
  }
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
