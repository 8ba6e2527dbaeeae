// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gyrostat/models/deceleration/orbit.hpp"
#include "gyrostat/models/deceleration/phase_grid.hpp"

/// First-order averaged equations with rotor momentum (deceleration.md, section 4): the rates of |M| and of the energy,
/// averaged over the free orbit of section 4.1.
namespace gyrostat::deceleration {

/// The control and drag torque at M, N m (the small part of dM/dt): -drag D - control U/|U|; 0 U/|U| at U = 0.
template <Real Scalar>
Vec3<Scalar> small_torque(const Problem<Scalar>& problem, const Vec3<Scalar>& M) noexcept {
  const Vec3<Scalar> G = M - problem.rotor_momentum;
  const Vec3<Scalar>& U = problem.law == Law::total ? M : G;
  const Vec3<Scalar>& D = problem.drag_law == Law::total ? M : G;
  const Scalar norm = U.norm();
  return -problem.drag * D - problem.control * U * (norm > 0 ? 1 / norm : Scalar(0));
}

/// Rates of the slow variables: of R = |M|, N m; of the carrier energy h, W; of eta = (h - S0/2)/R, rad/s^2.
template <Real Scalar>
struct SlowRates {
  Scalar R = 0, h = 0, eta = 0;
};

/// Rates of the slow variables under a torque at M.
template <Real Scalar>
SlowRates<Scalar> slow_rates(const Problem<Scalar>& problem, const Vec3<Scalar>& M, Scalar eta,
                             const Vec3<Scalar>& torque) noexcept {
  const Scalar R = M.norm();
  const Scalar dR = M.dot(torque) / R, dh = problem.angular_velocity(M).dot(torque);
  return {dR, dh, (dh - eta * dR) / R};
}

/// Averages over one free orbit.
template <Real Scalar>
struct OrbitAverage {
  SlowRates<Scalar> rates;                            ///< what the averaged equations need
  Vec3<Scalar> momentum{0, 0, 0};                     ///< <M>, N m s
  Mat3<Scalar> second_moment = Mat3<Scalar>::Zero();  ///< <M M^T>, (N m s)^2
  Level<Scalar> level;  ///< of the orbit taken: differs from the one asked where that was clamped
  Component component;
  math::Modulus<Scalar> modulus;
  Scalar period = 0;      ///< s
  int nodes = 0;          ///< points on the orbit, uniform in time
  Scalar error = 0;       ///< estimate from node doubling, relative to R and R^2
  Scalar half_error = 0;  ///< the same of half the points
};

namespace detail {

/// Sums over the four points (+-sn, +-cn) of an entry of the phase grid: the lanes of a vector.
template <Real Scalar>
struct OrbitSums {
  using Lanes = Eigen::Array<Scalar, 4, 1>;
  static constexpr int count = 11;  // M; M M^T; control power along M and along omega
  std::array<Lanes, count> sum;

  OrbitSums() noexcept { sum.fill(Lanes::Zero()); }

  template <class Elliptic>
  void add(const Problem<Scalar>& problem, const Orbit<Scalar, Elliptic>& orbit, Scalar sn, Scalar cn, Scalar dn,
           Scalar weight) noexcept {
    const bool single = orbit.regime() == Regime::one_component;
    const Scalar w = single ? cn * cn : dn, p = single ? sn * dn : sn;
    const Lanes along_sn = Lanes(1, 1, -1, -1) * p, along_cn = Lanes(1, -1, -1, 1) * cn;
    const auto component = [&](int i) -> Lanes {
      return orbit.even()[i] + w * orbit.even2()[i] + along_sn * orbit.along_sn()[i] + along_cn * orbit.along_cn()[i];
    };
    const Lanes size = orbit.level().R / component(3);
    const Lanes x = component(0) * size, y = component(1) * size, z = component(2) * size;
    const Lanes wx = weight * x, wy = weight * y, wz = weight * z;
    sum[0] += wx, sum[1] += wy, sum[2] += wz;
    sum[3] += wx * x, sum[4] += wy * y, sum[5] += wz * z;
    sum[6] += wx * y, sum[7] += wy * z, sum[8] += wz * x;
    if (problem.law == Law::carrier) {
      const Vec3<Scalar>&l = problem.rotor_momentum, &a = problem.inverse_inertia;
      const Mat3<Scalar>& b = problem.control;
      const Lanes gx = x - l[0], gy = y - l[1], gz = z - l[2];
      const Lanes inverse = weight / (gx * gx + gy * gy + gz * gz).sqrt().max(std::numeric_limits<Scalar>::min());
      const Lanes bx = (b(0, 0) * gx + b(0, 1) * gy + b(0, 2) * gz) * inverse;
      const Lanes by = (b(1, 0) * gx + b(1, 1) * gy + b(1, 2) * gz) * inverse;
      const Lanes bz = (b(2, 0) * gx + b(2, 1) * gy + b(2, 2) * gz) * inverse;
      sum[9] += bx * x + by * y + bz * z;
      sum[10] += a[0] * bx * gx + a[1] * by * gy + a[2] * bz * gz;
    }
  }

  std::array<Scalar, count> total(Scalar factor) const noexcept {
    std::array<Scalar, count> t;
    for (int i = 0; i < count; ++i) t[std::size_t(i)] = sum[std::size_t(i)].sum() * factor;
    return t;
  }
};

}  // namespace detail

/// Averages over an orbit: plain means over 16, 32, ... 512 points uniform in time, doubled until two of them agree. The
/// means converge like exp(-N c), so the difference of two says far more about the finer one than its own size; 512
/// points suffice down to kp2 of about 1e-15. Error no_convergence where they do not.
template <Real Scalar, class Elliptic>
Result<OrbitAverage<Scalar>> average(const Problem<Scalar>& problem, const Orbit<Scalar, Elliptic>& orbit) noexcept {
  using Sums = detail::OrbitSums<Scalar>;
  const Scalar R = orbit.level().R, eta = orbit.level().eta;
  const Vec3<Scalar>&a = problem.inverse_inertia, &l = problem.rotor_momentum;
  const Vec3<Scalar> g = problem.gyro_rate();

  PhaseGrid<Scalar> grid(orbit.modulus());
  Sums sums;
  sums.add(problem, orbit, grid.sn[0], grid.cn[0], grid.dn[0], Scalar(.5));
  sums.add(problem, orbit, grid.sn[1], grid.cn[1], grid.dn[1], Scalar(.5));
  auto mean = sums.total(Scalar(.25));
  const Scalar b = problem.control.cwiseAbs().maxCoeff(), swing = a[2] * (R + l.norm());
  const Scalar scale[3] = {R, R * R, b > 0 ? b : Scalar(1)};
  Scalar before = 1, error = infinity<Scalar>;
  const Scalar wanted = 256 * epsilon<Scalar>;
  while (grid.refine()) {
    const int end = grid.size();
    for (int i = (end - 1) / 2 + 1; i < end; ++i)
      sums.add(problem, orbit, grid.sn[i], grid.cn[i], grid.dn[i], Scalar(1));
    const auto finer = sums.total(Scalar(.25) / Scalar(end - 1));
    Scalar change = 0;
    for (int i = 0; i < Sums::count; ++i) {
      const Scalar unit = i < 3 ? scale[0] : i < 9 ? scale[1] : i == 9 ? scale[2] * R : scale[2] * swing;
      change = std::max(change, std::abs(finer[std::size_t(i)] - mean[std::size_t(i)]) / unit);
    }
    if (!std::isfinite(change)) return Errc::no_convergence;
    mean = finer;
    error = change * std::min(Scalar(1), change / before);
    before = std::max(change, std::numeric_limits<Scalar>::min());
    if (grid.depth() >= 2 && error <= wanted) break;
  }
  if (!(error < Scalar(1e-3))) return Errc::no_convergence;

  OrbitAverage<Scalar> r;
  r.momentum = {mean[0], mean[1], mean[2]};
  r.second_moment << mean[3], mean[6], mean[8], mean[6], mean[4], mean[7], mean[8], mean[7], mean[5];
  Scalar along_M, along_omega;
  if (problem.law == Law::total) {
    along_M = problem.control.cwiseProduct(r.second_moment).sum() / R;
    along_omega = 0;
    for (int i = 0; i < 3; ++i)
      along_omega += a[i] * problem.control.row(i).dot(r.second_moment.col(i) - l[i] * r.momentum) / R;
  } else {
    along_M = mean[9];
    along_omega = mean[10];
  }
  // G.omega = 2h and M.omega = 2h + l.omega are (nearly) constant on the orbit
  const Scalar twice_h = 2 * energy_of(problem, orbit.level());
  const bool total = problem.drag_law == Law::total;
  r.rates.R = -problem.drag * (total ? R : R - l.dot(r.momentum) / R) - along_M / R;
  r.rates.h = -problem.drag * (total ? twice_h + g.dot(r.momentum - l) : twice_h) - along_omega;
  r.rates.eta = (r.rates.h - eta * r.rates.R) / R;
  r.level = orbit.level();
  r.component = orbit.component();
  r.modulus = orbit.modulus();
  r.period = orbit.period();
  r.nodes = 4 * (grid.size() - 1);
  r.error = error;
  r.half_error = before;
  return r;
}

/// Averages over the orbit on a level; see Orbit::at for `followed` and the errors.
template <class Elliptic = math::Native, Real Scalar>
Result<OrbitAverage<Scalar>> average(const Problem<Scalar>& problem, const Level<Scalar>& level,
                                     Component followed) noexcept {
  const auto orbit = Orbit<Scalar, Elliptic>::at(problem, level, followed);
  if (!orbit) return orbit.error();
  return average(problem, *orbit);
}

}  // namespace gyrostat::deceleration
