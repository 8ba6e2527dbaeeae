// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/rotate_once.hpp"

namespace gyrostat::rotor {

/// The equations of a driven rotor (docs/rotor.md, section 2) as a system with one unknown that relaxes linearly, the axial momentum p:
///     dq/dt = q (0, Omega)/2,  dH/dt = H x Omega,  Omega = R^-1 (H - p e),
///     dp/dt = -S/(lambda k) p + S (omega* + (R^-1 e).H).
/// Components in the principal axes of R: (q.w, q.x, q.y, q.z, H1, H2, H3, rotor angle, p). The motor may be arbitrarily stiff.
template <Real Real_>
class RelaxingRotor {
 public:
  using Scalar = Real_;
  static constexpr int width = 8, relaxing = 1;
  struct Moment {};  ///< nothing depends on the time
  using Components = std::array<Scalar, width + 1>;

  /// start: gives the angular momentum in inertial axes, which stays.
  RelaxingRotor(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept
      : momentum_I_(rotate_once(start.attitude, start.momentum)),
        rate_(gyrostat.relaxation_rate()),
        drive_(gyrostat.slope() * gyrostat.no_load_rate()),
        per_axial_inertia_(1 / gyrostat.axial_inertia()) {
    const PrincipalAxes<Scalar> free = gyrostat.free_axes();
    R_BF_ = free.R_BP;
    q_BF_ = from_matrix<Scalar>(R_BF_);
    const Vec3<Scalar> e = R_BF_.transpose() * gyrostat.axis();
    for (int i = 0; i < 3; ++i) {
      inverse_[i] = 1 / free.moments[i];
      axis_[i] = e[i];
      source_[i] = gyrostat.slope() * inverse_[i] * e[i];
    }
  }

  Components components(const State<Scalar>& state) const noexcept {
    const Quat<Scalar> q = normalised(state.attitude) * q_BF_;
    const Vec3<Scalar> H = R_BF_.transpose() * state.momentum;
    return {q.w, q.x, q.y, q.z, H[0], H[1], H[2], state.rotor_angle, state.axial_momentum};
  }
  /// x: the components, of a motion with the momentum this system began with.
  State<Scalar> state(const Scalar* x) const noexcept {
    // H = P^T L also between the steps, where H itself is good to a share of |H| + |h| + |p| only
    const Quat<Scalar> q = normalised(Quat<Scalar>{x[0], x[1], x[2], x[3]});
    return {normalised(q * conjugate(q_BF_)), R_BF_ * rotate<Scalar>(conjugate(q), momentum_I_), x[8], x[7]};
  }
  /// Sizes against which errors are measured: 1 of q, |H| + |h| + |p| of momenta, none of the rotor angle.
  static Components scale(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept {
    const Scalar size = start.momentum.norm() + std::abs(gyrostat.target_momentum()) + std::abs(start.axial_momentum);
    const Scalar momentum = size > 0 ? size : Scalar(1);
    return {1, 1, 1, 1, momentum, momentum, momentum, 0, momentum};
  }

  Scalar rate(int) const noexcept { return rate_; }
  static Moment moment(const Lanes<Scalar>&) noexcept { return {}; }

  GYROSTAT_INLINE void sources(const Moment&, const Lanes<Scalar>* y, Lanes<Scalar>* source) const noexcept {
    *source = multiply_add(lanes(source_[0]), y[4],
                           multiply_add(lanes(source_[1]), y[5], multiply_add(lanes(source_[2]), y[6], lanes(drive_))));
  }

  GYROSTAT_INLINE void rates(const Moment&, const Lanes<Scalar>* y, const Lanes<Scalar>* p,
                             Lanes<Scalar>* rate) const noexcept {
    using Row = Lanes<Scalar>;
    const Row minus_p = lanes(Scalar(0)) - *p;
    Row Omega[3], half[3];
    for (int i = 0; i < 3; ++i) {
      Omega[i] = lanes(inverse_[i]) * multiply_add(minus_p, lanes(axis_[i]), y[4 + i]);
      half[i] = lanes(Scalar(0.5)) * Omega[i];
    }
    const Row zero = lanes(Scalar(0));
    rate[0] = zero - multiply_add(y[1], half[0], multiply_add(y[2], half[1], y[3] * half[2]));
    rate[1] = multiply_add(y[0], half[0], multiply_add(y[2], half[2], zero - y[3] * half[1]));
    rate[2] = multiply_add(y[0], half[1], multiply_add(y[3], half[0], zero - y[1] * half[2]));
    rate[3] = multiply_add(y[0], half[2], multiply_add(y[1], half[1], zero - y[2] * half[0]));
    rate[4] = y[5] * Omega[2] - y[6] * Omega[1];
    rate[5] = y[6] * Omega[0] - y[4] * Omega[2];
    rate[6] = y[4] * Omega[1] - y[5] * Omega[0];
    const Row along =
        multiply_add(lanes(axis_[0]), Omega[0], multiply_add(lanes(axis_[1]), Omega[1], lanes(axis_[2]) * Omega[2]));
    rate[7] = lanes(per_axial_inertia_) * *p - along;
  }

  /// |q| = 1, and H = P^T L with the L of the start. Both to rounding of x + low.
  void project(Scalar, Scalar* x, Scalar* low) const noexcept {
    Scalar missing = 1, along = 0;
    for (int i = 0; i < 4; ++i) missing -= x[i] * x[i];
    for (int i = 0; i < 4; ++i) along += x[i] * low[i];
    const Scalar stretch = missing / 2 - along;
    for (int i = 0; i < 4; ++i) add_to(x[i], low[i], stretch * x[i]);
    const Vec3<Scalar> H = rotate(Quat<Scalar>{x[0], -x[1], -x[2], -x[3]}, momentum_I_);
    for (int i = 0; i < 3; ++i) {
      x[4 + i] = H[i];
      low[4 + i] = 0;
    }
  }

 private:
  Mat3<Scalar> R_BF_;
  Quat<Scalar> q_BF_;
  Vec3<Scalar> momentum_I_;
  Scalar rate_, drive_, per_axial_inertia_;
  Scalar inverse_[3], axis_[3], source_[3];
};

}  // namespace gyrostat::rotor
