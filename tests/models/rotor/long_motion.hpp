// SPDX-License-Identifier: BSD-3-Clause
// The full equations in long double by DOP853: the truth of the tests, written apart from the library's own integration.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/rotation/kinematics.hpp"

namespace gyrostat::rotor {

struct LongMotion {
  using Long = long double;
  struct Rate {
    const Gyrostat<Long>* body;
    void operator()(Long, const std::array<Long, 9>& y, std::array<Long, 9>& dydt) const noexcept {
      const Quat<Long> q{y[0], y[1], y[2], y[3]};
      const Vec3<Long> H(y[4], y[5], y[6]);
      const Vec3<Long> Omega = body->angular_velocity(H, y[7]);
      const Long omega = body->rotor_rate(y[7], Omega);
      const Quat<Long> dq = quaternion_rate<Long>(q, Omega);
      const Vec3<Long> dH = H.cross(Omega);
      dydt = {dq.w, dq.x, dq.y, dq.z, dH[0], dH[1], dH[2], -body->slope() * (omega - body->no_load_rate()), omega};
    }
  };

  static Gyrostat<Long> widen(const Gyrostat<double>& body) {
    return Gyrostat<Long>::make(body.inertia().cast<Long>(), body.axis().cast<Long>(), body.axial_inertia(),
                                body.slope(), body.no_load_rate())
        .value();
  }

  /// From Omega and omega as the double numbers give them, at increasing times; rounded to double at the end only.
  static std::vector<State<double>> from(const Gyrostat<double>& body, const Quat<double>& attitude,
                                         const Vec3<double>& Omega, double omega, const std::vector<double>& times,
                                         long double tolerance = 1e-18L) {
    const auto wide = widen(body);
    const Quat<Long> q = normalised(Quat<Long>{attitude.w, attitude.x, attitude.y, attitude.z});
    return run(wide, wide.state(q, Omega.cast<Long>(), omega), times, tolerance);
  }
  static std::vector<State<double>> from(const Gyrostat<double>& body, const State<double>& s,
                                         const std::vector<double>& times, long double tolerance = 1e-18L) {
    const Quat<Long> q = normalised(Quat<Long>{s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z});
    return run(widen(body), {q, s.momentum.cast<Long>(), s.axial_momentum, s.rotor_angle}, times, tolerance);
  }

  static std::vector<State<double>> run(const Gyrostat<Long>& body, const State<Long>& s,
                                        const std::vector<double>& times, long double tolerance) {
    ode::StepControl<Long, 9> control;
    control.relative = tolerance;
    const Long l = s.momentum.norm() + std::abs(s.axial_momentum) + std::abs(body.target_momentum());
    const Long rate = l / body.axial_inertia();
    const Long a[9] = {1, 1, 1, 1, l, l, l, l, rate * 1e3L};
    for (std::size_t i = 0; i < 9; ++i) control.absolute[i] = a[i] * tolerance;
    control.step_cap = 10'000'000;
    // well inside the region of stability
    control.longest_step = 1 / (body.relaxation_rate() +
                                (s.momentum.norm() + std::abs(body.target_momentum())) / body.free_principal()[0]);
    ode::RungeKutta<Long, 9, Rate> solver(Rate{&body}, 0,
                                          {s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z, s.momentum[0],
                                           s.momentum[1], s.momentum[2], s.axial_momentum, s.rotor_angle},
                                          control);
    std::vector<State<double>> states;
    for (const double t : times) {
      solver.advance(t);
      const auto& y = solver.state();
      const Quat<Long> q = normalised(Quat<Long>{y[0], y[1], y[2], y[3]});
      states.push_back({{double(q.w), double(q.x), double(q.y), double(q.z)},
                        {double(y[4]), double(y[5]), double(y[6])},
                        double(y[7]),
                        double(y[8])});
    }
    return states;
  }
};

}  // namespace gyrostat::rotor
