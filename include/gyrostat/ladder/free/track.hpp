// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"

namespace gyrostat::free {

/// The motion in closed form, and what is known of its errors.
struct ClosedForm {
  Motion<double> motion;
  MotionError<double> error;
  bool precise;  ///< set up to twice the digits
};

/// Up to which errors are to be known, s: the last time, or over a period where means are asked for.
inline double horizon_of(const Scene& scene, const Motion<double>& motion) noexcept {
  const double last = scene.question().times.back();
  return asks_for_scalars(scene.question()) && std::isfinite(motion.period()) ? std::max(last, motion.period()) : last;
}

/// Of the scene's data to twice the digits; an error where the data fit no motion (Motion::make).
inline Result<ClosedForm> closed_form_of(const Scene& scene) noexcept {
  const auto motion = Motion<double>::make<DoubleDouble>(scene.precise().problem);
  if (!motion) return motion.error();
  return ClosedForm{
      *motion,
      MotionError<double>::of<DoubleDouble>(*motion, scene.assembly(), Data::rounded, horizon_of(scene, *motion)),
      true};
}

/// The same in double for a tenth of the cost; nothing where its rounding may weigh (MotionError::quick), or the scalars need not be as well known as
/// is asked.
inline std::optional<ClosedForm> quick_form_of(const Scene& scene) noexcept {
  const auto motion = Motion<double>::make(scene.gyrostat().problem);
  if (!motion) return std::nullopt;
  const auto error = MotionError<double>::quick(*motion, scene.assembly(), horizon_of(scene, *motion));
  const double tightest = scene.goal().tightest;
  if (!error || !(error->of_scalars() <= tightest)) return std::nullopt;
  if (asks_for_scalars(scene.question()) && !(16 * error->at(motion->period()).angular_velocity <= tightest))
    return std::nullopt;
  return ClosedForm{*motion, *error, false};
}

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  std::vector<Vec3<double>> turned;  ///< integral of omega since t = 0, body axes, rad; where a wheel needs it
  ColumnErrors<double> error;        ///< estimated greatest errors over the times, as the columns measure them
  std::optional<ClosedForm> form;    ///< of a rung that has it
};

/// Angle of a wheel in the body since t = 0, rad.
inline double rotor_angle(const Reduced<double>::Turning& wheel, double t, const Vec3<double>& turned) noexcept {
  return wheel.turns_freely ? wheel.rate * t - wheel.axis.dot(turned) : wheel.rate * t;
}

inline void fill(Answer& answer, const Scene& scene, const Track& track) {
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
