// SPDX-License-Identifier: BSD-3-Clause
// The full equations of the spinning family by a Runge-Kutta method, as an oracle of small-angle models.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/kinematics.hpp"

namespace direct {

using namespace gyrostat;
using spinning::Problem;
using spinning::State;

/// omega, quaternion (w, x, y, z), theta, v, x
using Numbers = std::array<double, 14>;

struct Rates {
  Problem<double> p;

  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const Vec3<double>&D = p.inertia, omega{y[0], y[1], y[2]};
    const double Lambda = p.gyroscopic();
    rate[0] = (p.torque[0] - omega[1] * ((D[2] - D[1]) * omega[2] + Lambda)) / D[0];
    rate[1] = (p.torque[1] + omega[0] * ((D[2] - D[0]) * omega[2] + Lambda)) / D[1];
    rate[2] = (p.torque[2] - (D[1] - D[0]) * omega[0] * omega[1]) / D[2];
    const Quat<double> q{y[3], y[4], y[5], y[6]}, turn = quaternion_rate(q, omega);
    rate[3] = turn.w, rate[4] = turn.x, rate[5] = turn.y, rate[6] = turn.z;
    const auto angles = angles_312(q);
    rate[7] = (omega[2] * std::cos(angles[1]) - omega[0] * std::sin(angles[1])) / std::cos(angles[0]);
    const Vec3<double> pull = rotate<double>(normalised(q), p.force / p.mass);
    for (std::size_t i = 0; i < 3; ++i) {
      rate[8 + i] = pull[long(i)];
      rate[11 + i] = y[8 + i];
    }
  }
};

/// The motion at increasing times; relative error some 1e-13 in hundreds of turns while the tilt stays below a radian.
inline std::vector<State<double>> motion(const Problem<double>& p, const std::vector<double>& times,
                                         double tolerance = 1e-13) {
  const auto q = quaternion_from_312(p.angles.psi, p.angles.phi, p.angles.theta);
  const auto &w = p.angular_velocity, &v = p.velocity, &x = p.position;
  const Numbers start{w[0], w[1], w[2], q.w, q.x, q.y, q.z, p.angles.theta, v[0], v[1], v[2], x[0], x[1], x[2]};
  ode::StepControl<double, 14> control;
  control.relative = tolerance;
  control.absolute = ode::uniform<double, 14>(tolerance * 1e-3);
  control.step_cap = 10'000'000;
  const double rate = std::abs(p.spin()) + std::sqrt(std::abs(p.nutation_squared()));
  if (rate > 0) control.longest_step = 0.5 / rate;
  ode::RungeKutta<double, 14, Rates> solver({p}, 0.0, start, control);
  std::vector<State<double>> states;
  for (const double t : times) {
    while (solver.time() < t && solver.step(t) == ode::Status::reached) {
    }
    const auto& y = solver.state();
    State<double> s;
    s.angular_velocity = {y[0], y[1], y[2]};
    s.attitude = normalised(Quat<double>{y[3], y[4], y[5], y[6]});
    const auto angles = angles_312(s.attitude);
    s.angles = {angles[0], angles[1], y[7]};
    const Vec3<double> momentum{p.inertia[0] * y[0], p.inertia[1] * y[1], p.inertia[2] * y[2] + p.rotor_momentum};
    s.momentum_I = rotate<double>(s.attitude, momentum);
    s.velocity = {y[8], y[9], y[10]};
    s.position = {y[11], y[12], y[13]};
    states.push_back(s);
  }
  return states;
}

}  // namespace direct
