// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "gyrostat/ladder/free/closed_form_rung.hpp"
#include "gyrostat/ladder/free/cost.hpp"
#include "gyrostat/ladder/free/full_rung.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/models/free/averages.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/view.hpp"

namespace gyrostat::free {

/// What is known of the whole motion, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  if (!tells_scalars(scene.question())) return;
  auto form = track.form ? track.form : quick_form_of(scene);
  if (!form) {
    const auto made = closed_form_of(scene);
    if (!made) return;
    form = *made;
  }
  const auto& [motion, error, precise] = *form;
  const auto tell = [&](std::size_t which, std::array<double, 3> values, double its_error = nan<double>) {
    answer.quantities.push_back({&scalar_kinds[which], values, its_error});
  };
  tell(scalar::kind, {double(motion.kind())});
  tell(scalar::period, {motion.period()}, error.period());
  tell(scalar::turn_per_period, {motion.turn_per_period()}, error.turn_per_period());
  tell(scalar::modulus_squared, {motion.modulus_squared()}, error.modulus_squared());
  tell(scalar::energy, {motion.energy()}, error.energy());
  tell(scalar::angular_momentum_norm, {motion.angular_momentum_norm()}, error.angular_momentum_norm());
  const Vec3<double> M_I = motion.inertial_momentum(), mean = averages(motion).angular_velocity;
  tell(scalar::angular_momentum_inertial, {M_I[0], M_I[1], M_I[2]});
  tell(scalar::mean_angular_velocity, {mean[0], mean[1], mean[2]});
  const bool two = motion.kind() == Kind::about_largest || motion.kind() == Kind::about_smallest;
  if (two) {
    const Vec3<double> axis = motion.R_BP().col(motion.kind() == Kind::about_largest ? 0 : 2);
    const auto turning = precession(motion, axis);
    if (turning.converged) {
      tell(scalar::precession_rate, {turning.about_momentum});
      tell(scalar::spin_rate, {turning.about_axis});
    }
    if (const double interval = flip_interval(motion); interval == interval)
      tell(scalar::flip_interval, {interval}, error.period());
  }
  if (const auto& view = scene.view()) {
    const auto seen = long_run_view(motion, view->axis, view->direction, view->half_angle);
    tell(scalar::view_fraction, {seen.fraction});
    tell(scalar::view_cosine, {seen.mean_cosine});
  }
}

/// In the order of rung_kinds.
inline constexpr Rung<Scene, Track> models[] = {{&closed_form_track, &cost_of_closed_form},
                                                {&full_track, &cost_of_full}};

GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept { return models[rung].cost(scene); }

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

}  // namespace gyrostat::free
