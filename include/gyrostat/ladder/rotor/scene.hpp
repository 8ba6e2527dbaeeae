// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/times.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

/// Which rung answers; `any` climbs the ladder.
enum class Model : std::uint8_t { any, closed_form, linear_tail, full };

/// What advances the full equations; `any` takes Radau where the motor is stiff and Taylor series elsewhere.
enum class Integrator : std::uint8_t { any, taylor, radau };

struct Track;
class Scene;

/// The user's view of a scene, in body axes and SI units.
struct SceneData {
  Quat<double> attitude{};                 ///< body to inertial at t = 0, of unit norm
  Vec3<double> angular_velocity{0, 0, 0};  ///< Omega of the carrier at t = 0, rad/s
  double rotor_rate = 0;                   ///< omega at t = 0, relative to the carrier, rad/s
  std::vector<double> times;               ///< s, increasing, the first >= 0
  double tolerance = 1e-6;
  Model model = Model::any;
  Integrator integrator = Integrator::any;
  /// Solves the full equations in place of the library's own integrators (cvode_motion.hpp); nullptr: its own.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;
};

/// A valid scene.
class Scene {
 public:
  Scene() = default;

  /// not_finite; zero_vector (an attitude without length); and what check_times finds.
  static Result<Scene> make(const Gyrostat<double>& gyrostat, const SceneData& data) {
    if (!data.angular_velocity.allFinite() || !std::isfinite(data.rotor_rate)) return Errc::not_finite;
    if (const Errc wrong = check_times(data.times, data.tolerance); wrong != Errc::ok) return wrong;
    const double length = norm(data.attitude);
    if (!std::isfinite(length)) return Errc::not_finite;
    if (!(length > 0)) return Errc::zero_vector;
    Scene scene;
    scene.gyrostat_ = gyrostat;
    scene.data_ = data;
    scene.start_ = gyrostat.state(normalised(data.attitude), data.angular_velocity, data.rotor_rate);
    return scene;
  }

  const Gyrostat<double>& gyrostat() const noexcept { return gyrostat_; }
  const State<double>& start() const noexcept { return start_; }
  const SceneData& data() const noexcept { return data_; }

 private:
  Gyrostat<double> gyrostat_;
  State<double> start_;
  SceneData data_;
};

}  // namespace gyrostat::rotor
