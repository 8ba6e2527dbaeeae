// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "gyrostat/ladder/cvode_runs.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/rotor/full_rung.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/ode/cvode.hpp"

/// The full equations by CVODE, for comparison. Needs the library gyrostat::cvode.
namespace gyrostat::rotor {

/// The full equations as numbers of order one: (w, x, y, z | H, p in units of |H| + |p| + |h| | rotor angle over what it may reach).
class CvodeEquations {
 public:
  static constexpr std::size_t width = 9;
  using Numbers = std::array<double, width>;

  /// span: the last time asked for, s.
  CvodeEquations(const Gyrostat<double>& gyrostat, const State<double>& start, double span) noexcept
      : gyrostat_(gyrostat) {
    const double momentum =
        start.momentum.norm() + std::abs(start.axial_momentum) + std::abs(gyrostat.target_momentum());
    const double rate = std::abs(gyrostat.no_load_rate()) + std::abs(start.axial_momentum) / gyrostat.axial_inertia();
    momentum_ = momentum > 0 ? momentum : 1;
    angle_ = std::max(1.0, rate * span);
    start_ = numbers(start);
  }

  Numbers start() const noexcept { return start_; }
  /// With an attitude of unit norm.
  State<double> state(const double* y) const noexcept {
    State<double> made = as_it_stands(y);
    made.attitude = normalised(made.attitude);
    return made;
  }

  /// For ode::Cvode, with a pointer to this for `user`. It must stay where it is while the integrator lives.
  ode::CvodeSystem system() noexcept {
    ode::CvodeSystem made;
    made.dimension = int(width);
    made.rhs = &rate;
    made.jacobian = &jacobian;
    made.user = this;
    return made;
  }

 private:
  Numbers numbers(const State<double>& s) const noexcept {
    const auto& [q, H, p, beta] = s;
    return {q.w, q.x, q.y, q.z, H[0] / momentum_, H[1] / momentum_, H[2] / momentum_, p / momentum_, beta / angle_};
  }
  State<double> as_it_stands(const double* y) const noexcept {
    return {{y[0], y[1], y[2], y[3]}, momentum_ * Vec3<double>(y[4], y[5], y[6]), momentum_ * y[7], angle_ * y[8]};
  }

  static bool rate(double, const double* y, double* out, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    const Numbers made = self.numbers(state_rate(self.gyrostat_, self.as_it_stands(y)));
    std::copy(made.begin(), made.end(), out);
    return std::all_of(made.begin(), made.end(), [](double x) { return std::isfinite(x); });
  }
  static bool jacobian(double, const double* y, double* columns, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    Eigen::Matrix<double, 9, 9> J = state_jacobian(self.gyrostat_, self.as_it_stands(y));
    J.middleRows<4>(4) /= self.momentum_;
    J.middleCols<4>(4) *= self.momentum_;
    J.row(8) /= self.angle_;
    J.col(8) *= self.angle_;
    std::copy(J.data(), J.data() + 81, columns);
    return J.allFinite();
  }

  Gyrostat<double> gyrostat_;
  double momentum_, angle_;
  Numbers start_;
};

/// Rung `full` by CVODE: Adams, or BDF where the motor is stiff. The error is that of cvode_runs().
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  const auto& times = scene.question().times;
  const auto& body = scene.gyrostat();
  const auto& start = scene.start();
  const auto method = is_stiff(body, start) ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams;
  const auto run = [&](std::span<const double> watched, const CvodeTask& task) {
    std::optional<detail::Neighbour<double>> near;
    if (task.change > 0) near.emplace(body, start, task.change, task.aside);
    const auto& from = near ? near->start : start;
    CvodeEquations equations(near ? near->gyrostat : body, from, times.back());
    return run_cvode(
        equations, from, watched,
        {method, task.tolerance, task.tolerance, ode::CvodeOptions{}.step_cap, task.longest * times.back()}, monitor);
  };
  auto runs = cvode_runs(Row<double>(body, start), times, scene.goal().tightest, 1e-5, run);
  if (runs.failure != Errc::ok) return refused<Track>(runs.failure, why_cvode_failed(runs.failure));

  Track track;
  track.states = std::move(runs.states);
  track.counts = runs.counts;
  // of the greatest numbers that a column is made of, some of which may cancel
  const double momentum = start.momentum.norm() + std::abs(start.axial_momentum) + std::abs(body.target_momentum());
  const double rate = momentum / body.free_principal()[0] + momentum / body.axial_inertia();
  const auto& size = runs.asked.size();
  ColumnErrors<double> parts;
  parts[column::attitude] = 1;
  parts[column::angular_velocity] = momentum / body.free_principal()[0];
  parts[column::angular_momentum] = momentum;
  parts[column::rotor_rate] = rate;
  parts[column::rotor_angle] = size[column::rotor_angle] + rate * times.back();
  parts[column::lyapunov] = size[column::lyapunov] + momentum * rate;
  const double floor = honesty::cvode_looser[0] * runs.tolerance;
  track.error = runs.asked.relative(runs.error + floor * parts);
  detail::count_departure(track.error, detail::departure_from_steady<double>(body, start, track.states));
  return track;
}

}  // namespace gyrostat::rotor
