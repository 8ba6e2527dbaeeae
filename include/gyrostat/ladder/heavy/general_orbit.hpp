// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/kinematics.hpp"

namespace gyrostat::heavy {

/// Unknown: the whole start and T; energy, vertical momentum, |down| = 1 and the phase are conditions.
template <Real Scalar>
struct WithIntegrals {
  static constexpr int unknowns = 7, conditions = 4;
  Problem<Scalar> problem;
  Scalar rate;              ///< rad/s
  Scalar energy, momentum;  ///< J, N m s
  State<Scalar> near;       ///< the start stays on the plane across the motion here

  Eigen::Matrix<Scalar, 7, 7> basis(const State<Scalar>&) const noexcept {
    return Eigen::Matrix<Scalar, 7, 7>::Identity();
  }
  void move(State<Scalar>& start, Scalar& period, const Eigen::Matrix<Scalar, 7, 1>& x) const noexcept {
    start.angular_velocity += rate * x.template head<3>();
    start.down += x.template segment<3>(3);
    period += x[6] / rate;
  }
  Eigen::Matrix<Scalar, 4, 8> condition(const State<Scalar>& start, Scalar) const noexcept {
    const Vec3<Scalar>&I = problem.inertia(), &w = start.angular_velocity, &d = start.down;
    const Vec3<Scalar> Iw = I.cwiseProduct(w), Id = I.cwiseProduct(d);
    const Scalar work = I.maxCoeff() * rate * rate, turning = I.maxCoeff() * rate;
    const Vec3<Scalar> w_rate = angular_acceleration<Scalar>(problem, near.angular_velocity, near.down) / (rate * rate);
    const Vec3<Scalar> d_rate = fixed_vector_rate<Scalar>(near.down, near.angular_velocity) / rate;
    const Scalar speed = std::sqrt(w_rate.squaredNorm() + d_rate.squaredNorm());
    Eigen::Matrix<Scalar, 4, 8> rows = Eigen::Matrix<Scalar, 4, 8>::Zero();
    const auto set = [&rows](int i, Scalar value, const Vec3<Scalar>& by_w, const Vec3<Scalar>& by_d) noexcept {
      rows(i, 0) = value;
      for (int k = 0; k < 3; ++k) {
        rows(i, 1 + k) = by_w[k];
        rows(i, 4 + k) = by_d[k];
      }
    };
    set(0, (problem.energy(start) - energy) / work, rate / work * Iw,
        (problem.gradient() * Id - problem.moment()) / work);
    set(1, (problem.vertical_momentum(start) - momentum) / turning, rate / turning * Id, Iw / turning);
    set(2, (d.squaredNorm() - 1) / 2, Vec3<Scalar>::Zero(), d);
    set(3, (w_rate.dot(w - near.angular_velocity) / rate + d_rate.dot(d - near.down)) / speed, w_rate / speed,
        d_rate / speed);
    return rows;
  }
};

/// The periodic motion with the energy and the vertical momentum of a guess and near it, whatever its kind; down of unit length is kept
/// so (docs/heavy.md, section 4). Where such motions are not isolated (an integrable case) the nearest one.
/// Errors: out_of_domain (period not positive, down not of unit length within 1e-3); no_convergence, not_finite, step_limit.
/// @param period s
template <Real Scalar>
Result<PeriodicOrbit<Scalar>> general_orbit(const Problem<Scalar>& problem, const State<Scalar>& guess,
                                            Scalar period) noexcept {
  if (!guess.angular_velocity.allFinite() || !guess.down.allFinite()) return Errc::not_finite;
  if (!(period > 0) || !(std::abs(guess.down.norm() - 1) < Scalar(1e-3L))) return Errc::out_of_domain;
  State<Scalar> start = guess;
  start.down /= start.down.norm();
  const Scalar rate = rate_size(problem, start);
  if (!(rate > 0)) return Errc::out_of_domain;
  const WithIntegrals<Scalar> space{problem, rate, problem.energy(start), problem.vertical_momentum(start), start};
  const auto closed = close_orbit(problem, start, period, rate, space, close_enough<Scalar>, 40);
  if (!closed) return closed.error();
  return detail::judged(problem, *closed, rate, space, OrbitMethod::shooting);
}

}  // namespace gyrostat::heavy
