// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "gyrostat/ladder/free/track.hpp"
#include "gyrostat/ladder/question.hpp"

namespace gyrostat::free {

namespace detail {

/// Up to which errors are to be known, s: the last time, or over a period where means are asked for.
inline double horizon_of(const Scene& scene, const Motion<double>& motion) noexcept {
  const double last = scene.question().times.back();
  return asks_for_scalars(scene.question()) && std::isfinite(motion.period()) ? std::max(last, motion.period()) : last;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Result<ClosedForm> closed_form_of(const Scene& scene) noexcept {
  const auto motion = Motion<double>::make<DoubleDouble>(scene.precise().problem);
  if (!motion) return motion.error();
  return ClosedForm{*motion,
                    MotionError<double>::of<DoubleDouble>(*motion, scene.assembly(), Data::rounded,
                                                          detail::horizon_of(scene, *motion)),
                    true};
}

GYROSTAT_COMPILED_ONCE std::optional<ClosedForm> quick_form_of(const Scene& scene) noexcept {
  const auto motion = Motion<double>::make(scene.gyrostat().problem);
  if (!motion) return std::nullopt;
  const auto error = MotionError<double>::quick(*motion, scene.assembly(), detail::horizon_of(scene, *motion));
  const double tightest = scene.goal().tightest;
  if (!error || !(error->of_scalars() <= tightest)) return std::nullopt;
  if (asks_for_scalars(scene.question()) && !(16 * error->at(motion->period()).angular_velocity <= tightest))
    return std::nullopt;
  return ClosedForm{*motion, *error, false};
}

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  const auto scale = scene.scales();
  const std::size_t n = track.states.size();
  const auto& wheels = scene.gyrostat().wheels;
  std::size_t filled = 0;
  for (std::size_t place = 0; place < std::size(column_kinds); ++place) {
    if (!scene.gives(place)) continue;
    const ColumnKind& kind = column_kinds[place];
    const std::size_t width = kind.width == per_rotor ? wheels.size() : std::size_t(kind.width);
    Column& made = renewed_column(answer, filled++, kind, n * width);
    made.error = track.error[place], made.scale = scale[place], made.width = int(width);
    double* to = made.values.data();
    for (std::size_t i = 0; i < n; ++i, to += width) {
      const State<double>& s = track.states[i];
      const auto put = [&](const Vec3<double>& v) { std::copy_n(v.data(), 3, to); };
      switch (place) {
        case column::attitude:
          to[0] = s.attitude.x, to[1] = s.attitude.y, to[2] = s.attitude.z, to[3] = s.attitude.w;
          break;
        case column::angular_velocity: put(s.angular_velocity); break;
        case column::angular_momentum: put(s.angular_momentum); break;
        case column::rotor_rate:
          for (std::size_t w = 0; w < width; ++w) to[w] = scene.gyrostat().wheel_rate(w, s.angular_velocity);
          break;
        default:
          for (std::size_t w = 0; w < width; ++w)
            to[w] =
                rotor_angle(wheels[w], answer.times[i], track.turned.empty() ? Vec3<double>(0, 0, 0) : track.turned[i]);
      }
    }
  }
  const auto& given = scene.assembly();
  const auto& q = given.body.attitude;
  const auto& v = given.body.momentum_given ? given.body.angular_momentum : given.body.angular_velocity;
  put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  put_start(answer, column_kinds[given.body.momentum_given ? column::angular_momentum : column::angular_velocity],
            {v[0], v[1], v[2]});
}

}  // namespace gyrostat::free
