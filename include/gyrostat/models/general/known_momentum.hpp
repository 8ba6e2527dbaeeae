// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/rotate_once.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::general {

/// R M, the momentum in inertial axes, over a piece in which all torque is constant in these axes, or a polynomial in time: known in closed
/// form.
template <Real Scalar>
class KnownMomentum {
 public:
  /// x: (w, x, y, z | M1, M2, M3) at the begin of the piece. before: of the piece before, where the motion goes on from it: what is known adds up over pieces
  /// without rounding more than once.
  KnownMomentum(const Piece<Scalar>& piece, const Scalar* x, const KnownMomentum* before = nullptr) noexcept
      : from_(piece.from), is_known_(piece.waves.empty()), is_free_(piece.waves.empty()) {
    by_time_.fill({0, 0, 0});
    if (before != nullptr && before->is_known_) go_on(*before);
    else by_time_[0] = rotate_once(Quat<Scalar>{x[0], x[1], x[2], x[3]}, Vec3<Scalar>(x[4], x[5], x[6]));
    for (std::size_t i = 0; i < 4; ++i) {
      Terms<Scalar> left = piece.power[i];
      is_free_ = is_free_ && !left.any_torque();
      for (std::size_t j = 0; j < 3; ++j) {
        const Scalar c = left.inertial[j](0, 0);
        if (left.inertial[j] == c * Mat3<Scalar>::Identity()) left.inertial[j].setZero();
        by_time_[i + 1][int(j)] = c / Scalar(int(i) + 1);
      }
      is_known_ = is_known_ && !left.any_torque();
    }
  }

  explicit operator bool() const noexcept { return is_known_; }
  /// There is no torque at all.
  bool is_free() const noexcept { return is_free_; }

  /// At t in the piece, N m s.
  Vec3<Scalar> at(Scalar t) const noexcept {
    const Scalar s = t - from_;
    return by_time_[0] + s * (by_time_[1] + s * (by_time_[2] + s * (by_time_[3] + s * by_time_[4])));
  }

 private:
  void go_on(const KnownMomentum& before) noexcept {
    const Scalar s = from_ - before.from_;
    const auto& b = before.by_time_;
    by_time_[0] = b[0], lost_ = before.lost_;
    const Vec3<Scalar> rate = b[1] + s * (b[2] + s * (b[3] + s * b[4]));
    for (int i = 0; i < 3; ++i) {
      add_product_to(by_time_[0][i], lost_[i], s, rate[i]);
      add_to(by_time_[0][i], lost_[i], Scalar(0));
    }
  }

  Scalar from_;
  bool is_known_, is_free_;
  std::array<Vec3<Scalar>, 5> by_time_;
  Vec3<Scalar> lost_{0, 0, 0};  ///< of the first of them, by rounding
};

}  // namespace gyrostat::general
