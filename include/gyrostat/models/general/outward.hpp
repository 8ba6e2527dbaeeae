// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/series.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Where the centre of the orbit is, as the body sees it, for the steps of the full equations: a series that follows from the attitude, and is
/// no state of its own. All is inlined, for an order costs little more than a call.
namespace gyrostat::general {

/// g = (N/N(t))^(1/4) e^(i angle/2) of the orbit from t on, order by order: the angle is that through which the radius has turned since.
///
/// By Q = (r/r(t))^2: Q'' = 2 (radial_rate^2/r^2 + n^2 + (z - 2) mu/r^3) with z = Q^(-1/2) and radial_rate, n, r those at t. g = Q^(-3/8) e^(i angle/2)
/// obeys Q g' = (-3/8 Q' + i n/2) g, and z, too, is a power of Q: both are one sum.
template <Real Scalar, int Order>
struct OrbitTurn {
  Lanes<Scalar> g[Order + 1];  ///< real and imaginary part, z, and a zero

  void begin(const Orbit<Scalar>& orbit, const OrbitPoint<Scalar>& at, Scalar unit) noexcept {
    const Scalar turn = unit * at.rate, out = unit * at.radial_rate / at.radius;
    const Scalar pull = unit * unit * at.gradient / 3;
    half_turn_ = lanes(-turn / 2, turn / 2, Scalar(0), Scalar(0));
    twice_pull_ = 2 * pull, circle_ = orbit.eccentricity == 0;
    Q_[1] = 2 * out;
    Q_[2] = out * out + turn * turn - pull;
    g[0] = lanes(Scalar(1), Scalar(0), Scalar(1), Scalar(0));
  }
  /// Coefficient k >= 1.
  template <class Index>
  GYROSTAT_INLINE void extend(Index k) noexcept {
    const Lanes<Scalar> turning = half_turn_ * shuffle<1, 0, 3, 3>(g[k - 1]);
    const Scalar share = Scalar(1) / Scalar(k);
    if (circle_) {
      g[k] = lanes(share) * turning;
      return;
    }
    weighted_[k] = lanes(Q_[k]) * lanes(Scalar(0.625L) * k, Scalar(0.625L) * k, Scalar(0.5L) * k, Scalar(0));
    const Lanes<Scalar> zero = lanes(Scalar(0));
    Lanes<Scalar> whole[2] = {zero, zero}, less[2] = {zero, turning};
    count_down<Scalar>(k, [&](int j) GYROSTAT_INLINE_LAMBDA {
      whole[j % 2] = multiply_add(lanes(Q_[j]), g[k - j], whole[j % 2]);
      less[j % 2] = multiply_add(weighted_[j], g[k - j], less[j % 2]);
    });
    g[k] = multiply_add(lanes(share), less[0] + less[1], zero - (whole[0] + whole[1]));
    if (k + 2 <= Order) Q_[k + 2] = twice_pull_ * g[k][2] * (Scalar(1) / Scalar((k + 1) * (k + 2)));
  }

 private:
  Lanes<Scalar> half_turn_;
  Scalar twice_pull_;
  bool circle_;
  Scalar Q_[Order + 1];
  Lanes<Scalar> weighted_[Order + 1];  ///< Q_j j by 5/8, 5/8, 1/2
};

/// The direction from the centre of the orbit as the body sees it, times sqrt(N): p* (0, 1, 0, 0) p with the quaternion p of the body
/// relative to radial, along track and normal, times N^(1/4). By the products of p it takes three convolutions and a half; as a vector that turns
/// with the body, together with the one along track, it takes seven.
template <Real Scalar, int Order>
struct OutwardSeries {
  using Row = Lanes<Scalar>;
  VectorSeries<Scalar, Order> v;

  /// From a point of the orbit on; share: 1, or over the length of the attitude there.
  void begin(const OrbitPoint<Scalar>& at, Scalar share) noexcept {
    using std::sqrt;
    Mat3<Scalar> axes;
    axes.col(0) = at.radial, axes.col(1) = at.along, axes.col(2) = cross<Scalar>(at.radial, at.along);
    const Quat<Scalar> o = from_matrix<Scalar>(axes);
    const Scalar size = share * sqrt(sqrt(at.gradient));
    const Scalar w = size * o.w, x = size * o.x, y = size * o.y, z = size * o.z;
    // conj(o) q by the numbers of q
    by_[0] = lanes(w, -x, -y, -z), by_[1] = lanes(x, w, -z, y);
    by_[2] = lanes(y, z, w, -x), by_[3] = lanes(z, -y, x, w);
  }
  /// Coefficient k, from that of the attitude (w, x, y, z) and up to that of the orbit.
  template <class Index>
  GYROSTAT_INLINE void extend(Index k, const Row& q, const OrbitTurn<Scalar, Order>& orbit) noexcept {
    own_[k] = multiply_add(by_[0], shuffle<0, 0, 0, 0>(q), by_[1] * shuffle<1, 1, 1, 1>(q)) +
              multiply_add(by_[2], shuffle<2, 2, 2, 2>(q), by_[3] * shuffle<3, 3, 3, 3>(q));
    Row cosine = lanes(Scalar(0)), sine = cosine;
    const auto add = [&](int j) GYROSTAT_INLINE_LAMBDA {
      cosine = multiply_add(shuffle<0, 0, 0, 0>(orbit.g[j]), own_[k - j], cosine);
      sine = multiply_add(shuffle<1, 1, 1, 1>(orbit.g[j]), own_[k - j], sine);
    };
    count_down<Scalar>(k, add);
    add(0);
    // less k times the second
    const Scalar one = 1, two = 2;
    const Row p = multiply_add(shuffle<3, 2, 1, 0>(sine), lanes(one, one, -one, -one), cosine);
    p_[k] = p, first_[k] = shuffle<1, 0, 1, 0>(p) * lanes(two, -two, two, two), second_[k] = shuffle<2, 3, 3, 2>(p);
    const Row mixed = product_term(first_, second_, k), own = square_term(p_, k);
    const Row pairs = own + shuffle<1, 0, 3, 2>(own), sums = mixed + shuffle<1, 0, 3, 2>(mixed);
    v.set(k, lanes(pairs[0] - pairs[2], sums[0], sums[2], Scalar(0)));
  }

 private:
  Row by_[4];
  Row own_[Order + 1], p_[Order + 1], first_[Order + 1], second_[Order + 1];
};

}  // namespace gyrostat::general
