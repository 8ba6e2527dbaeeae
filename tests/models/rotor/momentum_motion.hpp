// SPDX-License-Identifier: BSD-3-Clause
// The motion of (H, p) by the classical Runge-Kutta method with a fixed step: slow, short and independent of the integrators.
#pragma once

#include "gyrostat/models/rotor/gyrostat.hpp"

namespace gyrostat::rotor {

struct MomentumMotion {
  Gyrostat<double> body;
  Vec3<double> H;
  double p;

  /// At rest in the direction m with the rotor rate omega* + x.
  static MomentumMotion from(const Gyrostat<double>& body, double l, const Vec3<double>& m, double x) {
    const double k = body.coupling(), lambda = body.axial_inertia();
    // x = omega - omega*, omega = (p/lambda - n.H)/k
    const Vec3<double> H = l * m, n = body.inverse_inertia() * body.axis();
    return {body, H, lambda * (k * (body.no_load_rate() + x) + n.dot(H))};
  }

  double norm() const { return H.norm(); }
  Vec3<double> direction() const { return H / H.norm(); }
  double slip() const { return body.rotor_rate(p, body.angular_velocity(H, p)) - body.no_load_rate(); }
  double level() const { return body.lyapunov(H, p); }

  void step(double dt) {
    const double l = H.norm();
    const auto rate = [&](const Vec3<double>& A, double b, Vec3<double>& dA, double& db) {
      const Vec3<double> Omega = body.angular_velocity(A, b);
      dA = A.cross(Omega);
      db = -body.slope() * (body.rotor_rate(b, Omega) - body.no_load_rate());
    };
    Vec3<double> a1, a2, a3, a4;
    double b1, b2, b3, b4;
    rate(H, p, a1, b1);
    rate(H + dt / 2 * a1, p + dt / 2 * b1, a2, b2);
    rate(H + dt / 2 * a2, p + dt / 2 * b2, a3, b3);
    rate(H + dt * a3, p + dt * b3, a4, b4);
    H += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    H *= l / H.norm();
    p += dt / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
  }
};

}  // namespace gyrostat::rotor
