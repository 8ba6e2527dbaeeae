// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gyrostat/ladder/cvode_walk.hpp"
#include "gyrostat/ladder/rotor/full_rung.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/ode/cvode.hpp"

/// The full equations by CVODE, the trusted outsider. Needs the library gyrostat::cvode.
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
  }

  Numbers numbers(const State<double>& s) const noexcept {
    const auto& [q, H, p, beta] = s;
    return {q.w, q.x, q.y, q.z, H[0] / momentum_, H[1] / momentum_, H[2] / momentum_, p / momentum_, beta / angle_};
  }
  State<double> state(const double* y) const noexcept {
    return {{y[0], y[1], y[2], y[3]}, momentum_ * Vec3<double>(y[4], y[5], y[6]), momentum_ * y[7], angle_ * y[8]};
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
  static bool rate(double, const double* y, double* out, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    const Numbers made = self.numbers(state_rate(self.gyrostat_, self.state(y)));
    std::copy(made.begin(), made.end(), out);
    return std::all_of(made.begin(), made.end(), [](double x) { return std::isfinite(x); });
  }
  static bool jacobian(double, const double* y, double* columns, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    Eigen::Matrix<double, 9, 9> J = state_jacobian(self.gyrostat_, self.state(y));
    J.middleRows<4>(4) /= self.momentum_;
    J.middleCols<4>(4) *= self.momentum_;
    J.row(8) /= self.angle_;
    J.col(8) *= self.angle_;
    std::copy(J.data(), J.data() + 81, columns);
    return J.allFinite();
  }

  Gyrostat<double> gyrostat_;
  double momentum_, angle_;
};

namespace detail {

struct CvodeRun {
  std::vector<State<double>> states;
  Errc failure = Errc::ok;
  ode::Counts counts;
};

inline CvodeRun cvode_run(const Scene& scene, ode::CvodeMethod method, double tolerance, Monitor* monitor) {
  const auto& times = scene.data().times;
  const double end = times.back();
  CvodeEquations equations(scene.gyrostat(), scene.start(), end);
  CvodeEquations::Numbers y = equations.numbers(scene.start());
  CvodeRun run;
  run.states.reserve(times.size());
  if (!(times.front() > 0)) run.states.push_back(scene.start());
  if (!(end > 0)) return run;
  auto made = ode::Cvode::create(equations.system(), 0, y, {method, tolerance, tolerance});
  if (!made) return run.failure = made.error(), run;
  auto cvode = std::move(made).value();
  std::size_t next = run.states.size();
  run.failure = walk(
      cvode, times, next, run.counts, monitor,
      [&](double t) {
        if (!cvode.at(t, y)) return false;
        State<double> state = equations.state(y.data());
        state.attitude = normalised(state.attitude);
        run.states.push_back(state);
        return true;
      },
      [] { return true; });
  return run;
}

inline Track by_cvode(const Scene& scene, ode::CvodeMethod method, Monitor* monitor) {
  // what one step errs adds up over many: far more digits are asked of a step than of the answer
  const double tolerance = std::max(1e-13, scene.data().tolerance * 1e-5);
  CvodeRun run = cvode_run(scene, method, tolerance, monitor);
  if (run.failure != Errc::ok) return refused<Track>(run.failure, message(run.failure));
  const CvodeRun looser = cvode_run(scene, method, 10 * tolerance, monitor);
  if (looser.failure != Errc::ok) return refused<Track>(looser.failure, message(looser.failure));

  Track track;
  track.states = std::move(run.states);
  track.counts = run.counts;
  track.counts += looser.counts;
  Comparison<double> both(scene.gyrostat());
  for (std::size_t i = 0; i < track.states.size(); ++i) both.add(track.states[i], looser.states[i]);
  // of the greatest numbers that a column is made of, some of which may cancel
  const auto& body = scene.gyrostat();
  const auto& start = scene.start();
  const double momentum = start.momentum.norm() + std::abs(start.axial_momentum) + std::abs(body.target_momentum());
  const double floor = 10 * tolerance, rate = momentum / body.free_principal()[0] + momentum / body.axial_inertia();
  const ColumnErrors<double>&d = both.difference(), &size = both.size();
  const double margin = tolerance > 1e-13 ? 4 : 10;  // near rounding a tighter tolerance wins little
  track.error = both.relative({margin * d.attitude + floor,
                               margin * d.angular_velocity + floor * momentum / body.free_principal()[0],
                               margin * d.angular_momentum + floor * momentum, margin * d.rotor_rate + floor * rate,
                               margin * d.rotor_angle + floor * size.rotor_angle,
                               margin * d.lyapunov + floor * (size.lyapunov + momentum * rate)});
  return track;
}

}  // namespace detail

/// Rung `full` by CVODE: Adams, or BDF where the motor is stiff. The error is four times the distance to a second run at a tolerance
/// ten times looser, ten times where the tighter one is the tightest that CVODE is asked for.
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  const bool stiff = is_stiff(scene.gyrostat(), scene.start());
  return detail::by_cvode(scene, stiff ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams, monitor);
}

}  // namespace gyrostat::rotor
