// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/models/heavy/exact.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

/// Exact motions know a start to its last bit, zeros included. Where conversions made it (principal axes of a tensor, down from an
/// attitude) every component has an error, and so have the moments, of the size of the greatest.
namespace gyrostat::heavy {

/// What a conversion errs, relative to the greatest component.
inline constexpr double conversion = 8 * epsilon<double>;

/// A body whose moments are off by the rounding of the greatest; symmetric where it was. which: 0 or 1, in another direction.
inline Problem<double> off_body(const Problem<double>& of, int which) noexcept {
  const auto top = SymmetricTop<double>::of(of);
  Vec3<double> inertia = of.inertia();
  const double by = conversion * inertia.maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const bool plus = top ? (std::abs(top->axes(i, 2)) == 1) == (which == 0) : i != which;
    inertia[i] += plus ? by : -by;
  }
  const auto made =
      Problem<double>::make(inertia, of.mass(), of.centre_of_mass() * (1 + conversion), of.gravity(), of.gradient());
  return made ? *made : of;
}

/// Two principal moments of a tensor agree so nearly that its rounding turns their axes by more than a millionth.
inline bool axes_undecided(const Problem<double>& of) noexcept {
  const Vec3<double>& I = of.inertia();
  const double gap = std::min({std::abs(I[0] - I[1]), std::abs(I[1] - I[2]), std::abs(I[2] - I[0])});
  return gap < 1e6 * conversion * I.maxCoeff();
}
inline constexpr const char* undecided_axes =
    "two principal moments of the tensor agree but for rounding, which turns their axes: a series about one of them "
    "means nothing";

/// A start off by as much, all components of it; of a pendulum about the axis k (k >= 0) in its plane.
inline State<double> off_start(const State<double>& of, int which, int k) noexcept {
  const Vec3<double> direction = which == 0 ? Vec3<double>(0.6, -0.64, 0.48) : Vec3<double>(-0.48, 0.6, 0.64);
  const double turn = which == 0 ? conversion : -conversion;
  State<double> made = of;
  Vec3<double> by = conversion * direction;
  if (k >= 0) {
    made.angular_velocity[k] *= 1 + turn;
    by = turn * Vec3<double>::Unit(k);
  } else {
    made.angular_velocity +=
        conversion * of.angular_velocity.norm() * Vec3<double>(direction[1], direction[2], direction[0]);
  }
  made.attitude = normalised(of.attitude * Quat<double>{1, by[0] / 2, by[1] / 2, by[2] / 2});
  made.down = (of.down - cross<double>(by, of.down)).normalized();
  if (k >= 0) made.down[k] = of.down[k];
  return made;
}

/// Error of an exact motion up to a time, s, with that of conversions: the distance to the exact motions of two bodies and starts that
/// are off by what they err, these motions' own errors, and what keeps them from being exact: a top that is not quite symmetric, a pendulum
/// off its plane. start_of(body) is the start for such a body.
template <class StartOf>
ExactError<double> conversion_error(const Problem<double>& problem, bool converted, const Exact<double>& exact,
                                    double end, const StartOf& start_of) {
  constexpr double open = infinity<double>;
  constexpr int looks = 32;
  ExactError<double> worst = exact.error(end);
  Comparison apart(Row<double>{});
  for (const int which : {0, 1}) {
    const Problem<double> body = converted ? off_body(problem, which) : problem;
    const auto start = start_of(body, which);
    if (!start) return {open, open, open};
    const Exact<double> other(body, *start);
    if (other.which() != exact.which()) return {open, open, open};
    const auto own = other.error(end);
    worst = {std::max(worst.attitude, own.attitude), std::max(worst.down, own.down),
             std::max(worst.angular_velocity, own.angular_velocity)};
    for (int i = 0; i <= looks; ++i) apart.add(exact.at(end * i / looks), other.at(end * i / looks));
  }
  const auto& off = apart.difference();
  constexpr double margin = 4;
  worst += {margin * off[column::attitude], margin * off[column::down], margin * off[column::angular_velocity]};
  if (const auto* pendulum = exact.pendulum()) worst += pendulum->error(end, conversion);
  if (converted && exact.which() == ExactCase::lagrange) {
    const auto start = exact.at(0);
    const double rate = start.angular_velocity.norm() + rate_size(problem, start), angle = rate * end;
    const double skew = conversion * problem.inertia().maxCoeff() / SymmetricTop<double>::of(problem)->along;
    worst += ExactError<double>::of(skew * angle * (1 + angle), rate);
  }
  return worst;
}

}  // namespace gyrostat::heavy
