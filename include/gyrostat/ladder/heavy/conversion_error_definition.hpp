// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "gyrostat/ladder/heavy/conversion_error.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE Problem<double> off_body(const Problem<double>& of, int which) noexcept {
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

GYROSTAT_COMPILED_ONCE bool axes_undecided(const Problem<double>& of) noexcept {
  const Vec3<double>& I = of.inertia();
  const double gap = std::min({std::abs(I[0] - I[1]), std::abs(I[1] - I[2]), std::abs(I[2] - I[0])});
  return gap < 4e6 * conversion * I.maxCoeff();
}

GYROSTAT_COMPILED_ONCE State<double> off_start(const State<double>& of, int which, int k, double by) noexcept {
  const Vec3<double> direction = which == 0 ? Vec3<double>(0.6, -0.64, 0.48) : Vec3<double>(-0.48, 0.6, 0.64);
  const double turn = which == 0 ? by : -by;
  State<double> made = of;
  Vec3<double> turned = by * direction;
  if (k >= 0) {
    made.angular_velocity[k] *= 1 + turn;
    turned = turn * Vec3<double>::Unit(k);
  } else {
    made.angular_velocity += by * of.angular_velocity.norm() * Vec3<double>(direction[1], direction[2], direction[0]);
  }
  made.attitude = normalised(of.attitude * Quat<double>{1, turned[0] / 2, turned[1] / 2, turned[2] / 2});
  made.down = (of.down - cross<double>(turned, of.down)).normalized();
  if (k >= 0) made.down[k] = of.down[k];
  return made;
}

GYROSTAT_COMPILED_ONCE std::vector<double> times_to_compare(std::span<const double> times,
                                                            std::span<const State<double>> states) {
  constexpr std::size_t evenly = 8, parts = 32;
  std::vector<double> made;
  for (std::size_t i = 0; i <= evenly; ++i) made.push_back(times.back() * double(i) / double(evenly));
  const std::size_t n = times.size(), count = std::min(n, parts);
  const auto rate = [&](std::size_t i) noexcept { return states[i].angular_velocity.squaredNorm(); };
  for (std::size_t part = 0; part < count; ++part) {
    std::size_t fastest = part * n / count;
    for (std::size_t i = fastest; i < (part + 1) * n / count; ++i)
      if (rate(i) > rate(fastest)) fastest = i;
    made.push_back(times[fastest]);
  }
  std::sort(made.begin(), made.end());
  return made;
}

GYROSTAT_COMPILED_ONCE Exact<double> rounded_otherwise(const Problem<double>& problem, const State<double>& start,
                                                       Converted converted, int axis, int which) noexcept {
  constexpr double shares[] = {0.9, -0.6, 0.7, -0.8, 0.5, -0.7, 0.8, -0.9, 0.6, -0.5, 1.0};
  int place = 3 * which;
  const auto off = [&](double x) noexcept { return x * (1 + 2 * epsilon<double> * shares[place++ % 11]); };
  const auto moved = [&](const Vec3<double>& v) noexcept { return Vec3<double>(off(v[0]), off(v[1]), off(v[2])); };
  const Vec3<double>& I = problem.inertia();
  const double greatest = I.maxCoeff();
  Vec3<double> change = moved(I) - I;
  if (converted.body)
    for (int i = 0; i < 3; ++i) change[i] = conversion * greatest * shares[(3 * which + i) % 11];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(I[i] - I[j]) <= SymmetricTop<double>::greatest_defect * greatest) change[i] = change[j];
  const Vec3<double> inertia = I + change;
  const auto made = Problem<double>::make(inertia, off(problem.mass()), moved(problem.centre_of_mass()),
                                          off(problem.gravity()), off(problem.gradient()));
  State<double> from = start;
  if (converted.start) {
    from = off_start(start, which, axis, (which < 2 ? 2 : -2) * epsilon<double>);
  } else {
    from.angular_velocity = moved(start.angular_velocity);
    from.down = moved(start.down).normalized();
  }
  return Exact<double>(made ? *made : problem, from);
}

GYROSTAT_COMPILED_ONCE ExactError<double> error_by_neighbours(const Problem<double>& problem,
                                                              const State<double>& start, Converted converted, int axis,
                                                              const Exact<double>& exact,
                                                              std::span<const double> times) {
  constexpr double open = infinity<double>;
  constexpr int neighbours = 4;
  const std::vector<State<double>> seen = states_at(exact, times);
  Errors<std::size(column_kinds)> squares;
  for (int which = 0; which < neighbours; ++which) {
    const Exact<double> other = rounded_otherwise(problem, start, converted, axis, which);
    if (other.which() != exact.which()) return {open, open, open};
    Comparison apart(Row<double>{});
    for (std::size_t i = 0; i < times.size(); ++i) apart.add(seen[i], other.at(times[i]));
    const auto& off = apart.difference();
    for (std::size_t k = 0; k < std::size(column_kinds); ++k) squares[k] += off[k] * off[k] / neighbours;
  }
  double fastest = 0;
  for (const State<double>& each : seen) fastest = std::max(fastest, each.angular_velocity.norm());
  const auto stated = [&](std::size_t k) noexcept { return honesty::exact_margin * std::sqrt(squares[k]); };
  // of the attitude more: next to a pole its turn about the vertical is off by what no neighbour shows (39 roundings, found by climbing)
  constexpr double shared = 8 * epsilon<double>, turned = 48 * epsilon<double>;
  ExactError<double> error = exact.uneven_error(times.back(), converted.body ? unevenness(problem, exact) : 0);
  error += {stated(column::attitude) + turned, stated(column::down) + shared,
            stated(column::angular_velocity) + shared * fastest};
  return error;
}

}  // namespace gyrostat::heavy
