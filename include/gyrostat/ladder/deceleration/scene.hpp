// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gyrostat/body/inertia.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/times.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::deceleration {

/// Which rung answers; `any` climbs the ladder.
enum class Model : std::uint8_t { any, equal_torque, averaged, averaged_2, full };

struct Track;
class Scene;

/// The user's view of a scene, in body axes and SI units. Defaults describe a body left alone.
struct SceneData {
  Vec3<double> rotor_momentum{0, 0, 0};  ///< l, relative to the carrier, N m s
  Vec3<double> control{0, 0, 0};         ///< eps b along the body axes, >= 0, N m
  double drag = 0;                       ///< eps lambda, >= 0, 1/s
  Law law = Law::total, drag_law = Law::total;
  Vec3<double> momentum{0, 0, 0};  ///< M at t = 0, N m s
  bool wants_attitude = false;
  Quat<double> attitude{};    ///< body to inertial at t = 0, of unit norm
  std::vector<double> times;  ///< s, increasing, the first >= 0
  double tolerance = 1e-6;
  Model model = Model::any;
  /// Solves the full equations in place of the library's Taylor series (cvode_motion.hpp); nullptr: Taylor.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;
};

/// A valid scene: the problem in principal axes and the way back to the body axes.
class Scene {
 public:
  Scene() = default;

  /// not_finite, negative (control, drag), zero_vector (an attitude without length), and what check_times finds.
  static Result<Scene> make(const Inertia<double>& body, const SceneData& data) {
    if (!data.rotor_momentum.allFinite() || !data.control.allFinite() || !std::isfinite(data.drag) ||
        !data.momentum.allFinite())
      return Errc::not_finite;
    if (data.control.minCoeff() < 0 || data.drag < 0) return Errc::negative;
    if (const Errc wrong = check_times(data.times, data.tolerance); wrong != Errc::ok) return wrong;
    const double length = norm(data.attitude);
    if (!std::isfinite(length)) return Errc::not_finite;
    if (!(length > 0)) return Errc::zero_vector;

    Scene scene;
    scene.data_ = data;
    scene.R_BP_ = body.R_BP();
    const Mat3<double> R_PB = scene.R_BP_.transpose();
    scene.problem_.inverse_inertia = body.inverse_principal();
    scene.problem_.rotor_momentum = R_PB * data.rotor_momentum;
    scene.problem_.control = R_PB * data.control.asDiagonal() * scene.R_BP_;
    scene.problem_.drag = data.drag;
    scene.problem_.law = data.law;
    scene.problem_.drag_law = data.drag_law;
    scene.problem_.momentum = R_PB * data.momentum;
    return scene;
  }

  const Problem<double>& problem() const noexcept { return problem_; }
  const SceneData& data() const noexcept { return data_; }
  const Mat3<double>& R_BP() const noexcept { return R_BP_; }  ///< principal axes to body axes

  bool has_rotor() const noexcept { return problem_.rotor_momentum.squaredNorm() > 0; }
  bool sphere() const noexcept { return problem_.inverse_inertia[0] == problem_.inverse_inertia[2]; }
  /// The control torques act along the principal axes.
  bool principal_control() const noexcept {
    const auto& c = problem_.control;
    return c(0, 1) == 0 && c(0, 2) == 0 && c(1, 2) == 0;
  }
  /// One control torque for all axes (none counts as equal).
  bool equal_control() const noexcept {
    return data_.control[0] == data_.control[1] && data_.control[1] == data_.control[2];
  }
  double greatest_control() const noexcept { return data_.control.maxCoeff(); }
  double least_control() const noexcept { return data_.control.minCoeff(); }

 private:
  Problem<double> problem_;
  SceneData data_;
  Mat3<double> R_BP_ = Mat3<double>::Identity();
};

/// Bounds of the rate at which the control brings down what it opposes near the goal, N m: a drag that acts on the other
/// momentum helps or hinders by drag |l|. The lower bound is 0 where the control may not get there.
struct FinalTorque {
  double least, greatest;
};

inline FinalTorque final_torque(const Scene& scene) noexcept {
  const auto& p = scene.problem();
  const double other = p.law == p.drag_law ? 0 : p.drag * p.rotor_momentum.norm();
  return {std::max(0.0, scene.least_control() - other), scene.greatest_control() + other};
}

/// mu = max(b, drag R) over the rotation rate times R (deceleration.md, section 1): relative change of M in one radian.
inline double small_parameter(const Scene& scene) noexcept {
  const auto& p = scene.problem();
  const double R = p.momentum.norm();
  const double rate = std::max(R * p.inverse_inertia[1], p.gyro_rate().norm());
  return std::max(scene.greatest_control(), p.drag * R) / (R * rate);
}

}  // namespace gyrostat::deceleration
