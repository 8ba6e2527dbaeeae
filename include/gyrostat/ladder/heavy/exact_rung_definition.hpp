// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/ladder/heavy/exact_rung.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"

namespace gyrostat::heavy {

namespace detail {

/// The motion without torque of a body that a tensor describes: of the tensor itself, since its rounding turns axes of near moments. In principal axes
/// like all others. Nothing where it is not found, or the start is not the given one.
inline std::optional<ExactError<double>> follow_tensor(std::vector<State<double>>& states, const Scene& scene) {
  if (!scene.converts_body() || scene.periodic()) return std::nullopt;
  State<double> start = scene.given();
  if (scene.oriented()) start.down = rotate<double>(conjugate(start.attitude), {0, 0, -1});
  const auto from = aligned(start);
  if (!from) return std::nullopt;
  free::Assembly<double> given;
  given.body.inertia = scene.given_inertia();
  given.body.angular_velocity = from->angular_velocity;
  given.body.attitude = from->attitude;
  const auto motion = free::Motion<double>::make<DoubleDouble>(given.body.cast<DoubleDouble>());
  if (!motion) return std::nullopt;
  const auto& times = scene.question().times;
  states.clear();
  for (const double t : times) {
    const auto now = motion->at(t);
    states.push_back(
        in_axes<double>(scene.R_BP().transpose(),
                        {now.angular_velocity, rotate<double>(conjugate(now.attitude), {0, 0, -1}), now.attitude}));
  }
  const auto error = free::MotionError<double>::of<DoubleDouble>(*motion, given, free::Data::rounded, times.back());
  const auto bound = error.at(times.back());
  constexpr double turned = 16 * epsilon<double>;  // into principal axes and back
  return ExactError<double>{bound.attitude + turned, bound.attitude + turned,
                            (bound.angular_velocity + turned) * error.fastest()};
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track exact_track(const Scene& scene, Monitor*) {
  const Question& question = scene.question();
  State<double> start = scene.start();
  if (scene.periodic()) {
    const auto plain = plain_start(scene.problem(), *scene.periodic());
    if (!plain)
      return refused<Track>(Errc::not_applicable,
                            "no exact case: the start of this periodic motion is not known in closed form");
    start = *plain;
  }
  const Exact<double> exact(scene.problem(), start);
  if (scene.periodic() && exact.pendulum() && exact.pendulum()->motion() != PendulumMotion::rotation)
    return refused<Track>(Errc::not_applicable,
                          "no exact case: below twice the pendulum rate the body swings, and does not go round");
  if (!exact.applies())
    return refused<Track>(
        Errc::not_applicable,
        "no exact case: the body has weight or gradient, no axis of symmetry through its mass centre, and "
        "does not turn about a horizontal principal axis with weight or gradient alone");
  Track track;
  track.states.reserve(question.times.size());
  Comparison sizes(row_of(scene));
  for (const double t : question.times) {
    track.states.push_back(exact.at(t));
    sizes.add(track.states.back());
  }
  if (!std::isfinite(sizes.size()[column::down]))
    return refused<Track>(Errc::no_convergence,
                          "the closed form is lost in rounding: axis 3 starts too near the vertical, next to at rest");
  const int axis = exact.pendulum() ? exact.pendulum()->axis() : -1;
  const auto of_tensor = exact.euler() ? detail::follow_tensor(track.states, scene) : std::nullopt;
  auto bound = of_tensor ? *of_tensor : exact.error(question.times.back());
  const auto looks = [&] { return times_to_compare(question.times, track.states); };
  if (!of_tensor && scene.converts_start() && bound.attitude < infinity<double>) {
    const auto off = [&](const Problem<double>& body, int which) -> Result<State<double>> {
      if (scene.periodic()) return plain_start(body, *scene.periodic());
      return off_start(start, which, axis);
    };
    bound = conversion_error(scene.problem(), scene.converts_body(), exact, looks(), off);
  }
  const auto stated = [&] {
    return relative_to_truth(sizes.relative({bound.angular_velocity, bound.down, bound.attitude}), column_kinds);
  };
  track.error = stated();
  const Vec3<double>& I = scene.problem().inertia();
  const bool slim = I.minCoeff() < honesty::exact_slim * I.maxCoeff();
  // neighbours leave out what the motion itself does, but of a top that is known
  const bool tells_all =
      !of_tensor && (exact.which() == ExactCase::lagrange || (!scene.converts_body() && exact.defect() == 0));
  if (tells_all && !scene.periodic() && !slim && bound.attitude < infinity<double> &&
      !(scene.goal().excess(track.error) <= 1)) {
    const auto finer = error_by_neighbours(scene.problem(), start, {scene.converts_body(), scene.converts_start()},
                                           axis, exact, looks());
    bound = bound.least(finer.most(bound.over(honesty::exact_trust)));
    track.error = stated();
  }
  track.in_domain = bound.attitude < infinity<double>;
  if (!track.in_domain) track.warn(warning_kinds[warning::rounding_decides], question.times.back());

  if (scene.periodic()) track.periodicity = periodicity_of(scene, start, exact);
  else warn_of_balance(track, scene);
  return track;
}

}  // namespace gyrostat::heavy
