// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

#include "gyrostat/ladder/cvode_runs.hpp"
#include "gyrostat/ladder/general/custom_rung.hpp"
#include "gyrostat/ladder/pace.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/ode/cvode.hpp"

/// The full equations of a general scene by CVODE, for comparison, anew from each breakpoint on. Needs the library gyrostat::cvode.
namespace gyrostat::general {

/// The equations as numbers of order one: those of Flow over their sizes.
class CvodeEquations {
 public:
  using Equations = DrivenFlow<double, OwnTorque>;
  static constexpr std::size_t width = Equations::width;
  using Numbers = Equations::Numbers;

  /// All but the sizes must outlive it.
  CvodeEquations(const Problem<double>& problem, const Wheels<double>& wheels, const OwnTorque& law,
                 const Numbers& sizes) noexcept
      : equations_(problem, wheels, law), sizes_(sizes) {}

  Numbers start() const noexcept {
    Numbers y = equations_.start();
    for (std::size_t i = 0; i < width; ++i) y[i] /= sizes_[i];
    return y;
  }
  /// The piece that is integrated. Time counts from its begin: short pieces would lose digits of theirs.
  void enter(double from, double to) noexcept {
    equations_.enter(from, to);
    from_ = from;
  }
  State<double> state(double t, const Numbers& y) const noexcept { return equations_.state(t, raw(y.data())); }
  double lost_at() const noexcept { return equations_.lost_at(); }
  double inside() const noexcept { return equations_.inside(); }

  /// One step by Euler, for a time so short that it is right to rounding; false where the equations have no value.
  bool step(double from, double to, Numbers& y) noexcept {
    Numbers slope{};
    if (!rate(0, y.data(), slope.data(), this)) return false;
    for (std::size_t i = 0; i < width; ++i) y[i] += (to - from) * slope[i];
    return true;
  }

  /// For ode::Cvode, with a pointer to this for `user`. It must stay where it is while the integrator lives.
  ode::CvodeSystem system() noexcept {
    ode::CvodeSystem made;
    made.dimension = int(width);
    made.rhs = &rate;
    made.user = this;
    return made;
  }

 private:
  Numbers raw(const double* y) const noexcept {
    Numbers made;
    for (std::size_t i = 0; i < width; ++i) made[i] = y[i] * sizes_[i];
    return made;
  }
  static bool rate(double since, const double* y, double* out, void* user) {
    auto& self = *static_cast<CvodeEquations*>(user);
    Numbers made{};
    self.equations_(self.from_ + since, self.raw(y), made);
    for (std::size_t i = 0; i < width; ++i) out[i] = made[i] / self.sizes_[i];
    return std::all_of(out, out + width, [](double x) { return std::isfinite(x); });
  }

  Equations equations_;
  Numbers sizes_;
  double from_ = 0;
};

namespace detail {

/// What ended a run of CVODE that nothing failed.
struct CvodeEnd {
  double lost = nan<double>;  ///< when the law had no value, s
  bool stopped = false;       ///< by a brake
};

/// Pieces so short, relative to their times, take a single step: laws that are asked at times between do not tell these apart.
inline constexpr double shortest_piece = 4 * epsilon<double>;

/// One run over all pieces.
inline CvodeRun<State<double>> run_pieces(const Problem<double>& problem, const OwnTorque& law,
                                          std::span<const double> times, CvodeEquations equations,
                                          const ode::CvodeOptions& options, Monitor* monitor, CvodeEnd& end) {
  const double span = times.back();
  auto cuts = breakpoints_with<double>(problem, law.breakpoints, span);
  cuts.push_back(span);
  CvodeRun<State<double>> run;
  const auto numbers = [](const ode::Cvode& cvode) {
    CvodeEquations::Numbers made;
    std::copy_n(cvode.state().begin(), made.size(), made.begin());
    return made;
  };
  auto y = equations.start();
  BrakeWatch<double> brakes;
  double from = 0;
  for (const double to : cuts) {
    equations.enter(from, to);
    // a time at a breakpoint belongs to the piece behind it
    const bool last = to == span;
    if (run.states.size() < times.size() && times[run.states.size()] == from)
      run.states.push_back(equations.state(from, y));
    if (!(to > from)) break;
    if (to - from < shortest_piece * std::abs(to)) {
      if (!equations.step(from, to, y)) return run.failure = Errc::not_finite, run;
      for (std::size_t i; (i = run.states.size()) < times.size() && (times[i] < to || last);)
        run.states.push_back(equations.state(times[i], y));
      from = to;
      continue;
    }
    auto made = ode::Cvode::create(equations.system(), 0, y, options);
    if (!made) return run.failure = made.error(), run;
    auto cvode = std::move(made).value();
    ode::Status status = ode::Status::reached;
    Pace<double> pace;
    pace.restart(0);
    const double length = to - from;
    while (cvode.time() < length && status == ode::Status::reached) {
      const double before = cvode.time();
      status = cvode.step(length);
      const double since = cvode.time(), now = from + since;
      // CVODE goes up to where the law has no value in ever shorter steps
      const bool stuck = equations.lost_at() >= now && !(since - before > 1e-10 * now);
      if (status == ode::Status::reached && stuck) status = ode::Status::not_finite;
      if (status == ode::Status::reached && pace.is_hopeless(cvode.counts().steps, since, length, options.step_cap))
        status = ode::Status::step_limit;
      for (std::size_t i; status == ode::Status::reached && (i = run.states.size()) < times.size() &&
                          (times[i] < to || last) && times[i] - from <= since;) {
        if (!cvode.at(times[i] - from, y)) return run.failure = Errc::no_convergence, run;
        run.states.push_back(equations.state(times[i], y));
      }
      if (status == ode::Status::reached &&
          brakes.stopped(problem, equations.state(now, numbers(cvode)), equations.inside()))
        return end.stopped = true, run.failure = Errc::not_applicable, run;
      if (monitor == nullptr) continue;
      if (monitor->cancelled()) status = ode::Status::cancelled;
      monitor->fraction.store(now / span, std::memory_order_relaxed);
    }
    run.counts += cvode.counts();
    if (status != ode::Status::reached) {
      if (status != ode::Status::cancelled && equations.lost_at() >= from + cvode.time())
        end.lost = equations.lost_at();
      return run.failure = failure_of(status), run;
    }
    y = numbers(cvode);
    from = to;
  }
  return run;
}

}  // namespace detail

/// Rung `full` by CVODE: Adams, or BDF where wheels settle fast. The error is that of cvode_runs().
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  const double span = scene.question().times.back();
  Track track = detail::unless_lost(scene);
  if (track.failure != Errc::ok) return track;
  const auto& law = scene.own_torque();
  Vec3<double> at_start;
  const LawFault fault = detail::ask_at_start(scene.problem(), law, at_start);
  if (fault == LawFault::no_value && law.lost_at != nullptr) *law.lost_at = 0;
  if (fault != LawFault::none) return refused<Track>(Errc::not_applicable, detail::why_law_failed(fault));
  const auto sized = detail::pushed_by(scene.problem(), at_start);
  const Prepared<double> of(sized, span);
  const FullRow<double> row(of);
  const auto sizes = detail::number_sizes(of);
  const auto method = of.is_stiff() ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams;
  detail::CvodeEnd end;
  auto runs = cvode_runs(
      row, scene.question().times, scene.goal().tightest, 1e-5,
      [&](std::span<const double> watched, const CvodeTask& task) {
        const auto& given = scene.problem();
        const auto problem = task.change > 0 ? detail::beside(given, task.change, task.aside) : given;
        const auto wheels = Wheels<double>::of(problem);
        const double longest = task.longest / (law.any() ? honesty::law_shorter : 1);
        return detail::run_pieces(
            problem, law, watched, CvodeEquations(problem, wheels, law, sizes),
            {method, task.tolerance, task.tolerance, ode::CvodeOptions{}.step_cap, longest * span}, monitor, end);
      });
  if (end.lost == end.lost) {
    if (law.lost_at != nullptr) *law.lost_at = end.lost;
    return refused<Track>(Errc::not_applicable, no_value_of_law);
  }
  if (end.stopped) return refused<Track>(Errc::not_applicable, why_stopped_by_brake);
  if (runs.failure == Errc::step_limit && law.any()) return refused<Track>(Errc::step_limit, steps_of_law);
  if (runs.failure != Errc::ok) return refused<Track>(runs.failure, why_cvode_failed(runs.failure));
  track.states = std::move(runs.states);
  track.counts = runs.counts;
  // of what columns are made of, some of which may cancel
  const auto rounding =
      detail::rounding_of_columns(of, row, runs.asked.size(), honesty::cvode_looser[0] * runs.tolerance);
  const auto error = runs.asked.relative(runs.error + rounding);
  const auto to_truth = relative_to_truth(error, full_columns);
  track.off = detail::off_of(track, to_truth, row, scene);
  track.compared = detail::compared_of(track, to_truth, row);
  detail::warn_of_law(track, scene);
  return track;
}

}  // namespace gyrostat::general
