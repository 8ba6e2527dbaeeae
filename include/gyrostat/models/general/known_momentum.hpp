// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat::general {

/// R M, the momentum in inertial axes, over a piece in which all torque is constant in these axes, or a polynomial in time: known in closed
/// form. With what rounding leaves of it, as the numbers have it that a run carries on: over many short pieces it adds up.
template <Real Scalar>
class KnownMomentum {
 public:
  /// x: (w, x, y, z | M1, M2, M3) at the begin of the piece, lost: what rounding has lost of them. before: of the piece before, where the motion goes on
  /// from it.
  KnownMomentum(const Piece<Scalar>& piece, const Scalar* x, const Scalar* lost,
                const KnownMomentum* before = nullptr) noexcept
      : from_(piece.from), is_known_(piece.waves.empty()), is_free_(piece.waves.empty()) {
    by_time_.fill({0, 0, 0});
    if (before != nullptr && before->is_known_) go_on(*before);
    else begin(rotate<Wide>(attitude(x, lost), momentum(x, lost)));
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
  Vec3<Scalar> at(Scalar t) const noexcept { return by_time_[0] + since(t - from_); }
  /// What M + lost at t lacks of it, in body axes, N m s.
  Vec3<Scalar> missing(Scalar t, const Scalar* x, const Scalar* lost) const noexcept {
    const Vec3<Wide> known = vector_cast<Wide>(by_time_[0]) + vector_cast<Wide>(Vec3<Scalar>(lost_ + since(t - from_)));
    return vector_cast<Scalar>(Vec3<Wide>(rotate<Wide>(conjugate(attitude(x, lost)), known) - momentum(x, lost)));
  }

 private:
  using Wide = Wider<Scalar>;

  static Quat<Wide> attitude(const Scalar* x, const Scalar* lost) noexcept {
    const auto whole = [&](int i) noexcept { return Wide(x[i]) + Wide(lost[i]); };
    return normalised(Quat<Wide>{whole(0), whole(1), whole(2), whole(3)});
  }
  static Vec3<Wide> momentum(const Scalar* x, const Scalar* lost) noexcept {
    return vector_cast<Wide>(Vec3<Scalar>(x[4], x[5], x[6])) +
           vector_cast<Wide>(Vec3<Scalar>(lost[4], lost[5], lost[6]));
  }
  void begin(const Vec3<Wide>& L) noexcept {
    by_time_[0] = vector_cast<Scalar>(L);
    lost_ = vector_cast<Scalar>(Vec3<Wide>(L - vector_cast<Wide>(by_time_[0])));
  }
  /// Its change within s.
  Vec3<Scalar> since(Scalar s) const noexcept {
    return s * (by_time_[1] + s * (by_time_[2] + s * (by_time_[3] + s * by_time_[4])));
  }

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
