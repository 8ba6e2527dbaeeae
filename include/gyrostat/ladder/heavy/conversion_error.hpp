// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/models/heavy/exact.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

/// Exact motions know a start to its last bit, zeros included. Where conversions made it (principal axes of a tensor, down from an
/// attitude) every component has an error, and so have the moments, of the size of the greatest.
namespace gyrostat::heavy {

/// What a conversion errs, relative to the greatest component: made with more digits, it is rounded once.
inline constexpr double conversion = 2 * epsilon<double>;

/// A body whose moments are off by the rounding of the greatest; symmetric where it was. which: 0 or 1, in another direction.
GYROSTAT_COMPILED_ONCE Problem<double> off_body(const Problem<double>& of, int which) noexcept;

/// Two principal moments of a tensor agree so nearly that its rounding turns their axes by more than a millionth.
GYROSTAT_COMPILED_ONCE bool axes_undecided(const Problem<double>& of) noexcept;
inline constexpr const char* undecided_axes =
    "two principal moments of the tensor agree but for rounding, which turns their axes: a series about one of them "
    "means nothing";

/// A start off by as much, all components of it; of a pendulum about the axis k (k >= 0) in its plane.
GYROSTAT_COMPILED_ONCE State<double> off_start(const State<double>& of, int which, int k,
                                               double by = conversion) noexcept;

/// By how much a conversion takes a top off its symmetry, relative; of other bodies nothing.
inline double unevenness(const Problem<double>& problem, const Exact<double>& exact) noexcept {
  if (exact.which() != ExactCase::lagrange) return 0;
  const auto top = SymmetricTop<double>::of(problem);
  return top ? conversion * problem.inertia().maxCoeff() / top->along : 0;
}

/// Times, s, in order, some twice, at which motions that should agree up to the last of the asked ones are compared: evenly, and of the asked ones in each of 32 parts of
/// them that at which the body turns fastest: what is late shows there. states: those at the asked times, of which there is one at least.
GYROSTAT_COMPILED_ONCE std::vector<double> times_to_compare(std::span<const double> times,
                                                            std::span<const State<double>> states);

/// The states at these times, s.
inline std::vector<State<double>> states_at(const Exact<double>& exact, std::span<const double> times) {
  std::vector<State<double>> made;
  made.reserve(times.size());
  for (const double t : times) made.push_back(exact.at(t));
  return made;
}

/// Error of an exact motion up to the last of these times, s, with that of conversions: the distance to the exact motions of two bodies and starts that
/// are off by what they err, these motions' own errors, and what keeps them from being exact: a top that is not quite symmetric, a pendulum
/// off its plane. start_of(body) is the start for such a body.
template <class StartOf>
ExactError<double> conversion_error(const Problem<double>& problem, bool converted, const Exact<double>& exact,
                                    std::span<const double> times, const StartOf& start_of) {
  constexpr double open = infinity<double>;
  const double end = times.back();
  const double uneven = converted ? unevenness(problem, exact) : 0;
  ExactError<double> worst = exact.error(end, uneven);
  const std::vector<State<double>> seen = states_at(exact, times);
  Comparison apart(Row<double>{});
  for (const int which : {0, 1}) {
    const Problem<double> body = converted ? off_body(problem, which) : problem;
    const auto start = start_of(body, which);
    if (!start) return {open, open, open};
    const Exact<double> other(body, *start);
    if (other.which() != exact.which()) return {open, open, open};
    worst = worst.most(other.error(end, uneven));
    for (std::size_t i = 0; i < times.size(); ++i) apart.add(seen[i], other.at(times[i]));
  }
  const auto& off = apart.difference();
  constexpr double margin = honesty::neighbours_margin;
  worst += {margin * off[column::attitude], margin * off[column::down], margin * off[column::angular_velocity]};
  if (const auto* pendulum = exact.pendulum(); pendulum && (converted || !pendulum->in_plane()))
    worst += pendulum->error(end, conversion);
  return worst.or_infinite();
}

/// What a scene's conversions have made anew: the body (principal axes of a tensor), the start (down from an attitude, or turned axes).
struct Converted {
  bool body = false, start = false;
};

/// A body and a start of which every number is off by about two roundings, zeros and equal moments kept; of what is converted all components by as much of
/// the greatest, and moments that agree but for rounding alike. which: 0 to 3.
GYROSTAT_COMPILED_ONCE Exact<double> rounded_otherwise(const Problem<double>& problem, const State<double>& start,
                                                       Converted converted, int axis, int which) noexcept;

/// What rounding of the data and of the arithmetic makes of an exact motion at these times, s, by the motions of four such neighbours: sharper than its
/// bound, which takes all roundings to add up; and what a top's lack of symmetry does, which no neighbour shows. axis: that of a pendulum, else -1.
GYROSTAT_COMPILED_ONCE ExactError<double> error_by_neighbours(const Problem<double>& problem,
                                                              const State<double>& start, Converted converted, int axis,
                                                              const Exact<double>& exact,
                                                              std::span<const double> times);

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/conversion_error_definition.hpp"
#endif
