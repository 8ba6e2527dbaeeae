// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/jacobi.hpp"
#include "gyrostat/math/third_kind.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/exact_error.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

/// What a pendulum does.
enum class PendulumMotion : std::uint8_t {
  rest,        ///< hanging or standing still
  libration,   ///< swings to and fro
  rotation,    ///< goes round
  separatrix,  ///< to rounding, tends to standing without ever getting there
};

/// The turning of a body about a principal axis k that stays horizontal, with the mass centre in the plane across it
/// (docs/heavy.md, section 7): exact where weight or gradient acts alone. With theta the angle from down to the mass
/// centre,
///     theta'' = -c^2 sin theta,  c^2 = M g l/I_k;
/// the gradient alone does the same to twice the angle from down to the axis of the lesser moment, with
/// c^2 = N |I_j - I_i|/I_k. The axis stays whatever the moments are: both torques lie along it.
template <Real Scalar>
class Pendulum {
 public:
  /// How far off the plane, relative, a body or start may be.
  static constexpr Scalar greatest_defect = 16 * epsilon<Scalar>;

  Pendulum() = default;

  /// Errors: not_applicable (off the plane; weight and gradient together); not_finite; zero_vector. The start is
  /// aligned().
  static Result<Pendulum> make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    const auto from = aligned(start);
    if (!from) return from.error();
    Pendulum best;
    best.defect_ = infinity<Scalar>;
    for (int k = 0; k < 3; ++k) {
      Pendulum made;
      if (made.build(problem, *from, k) && made.defect_ < best.defect_) best = made;
    }
    if (!(best.defect_ <= greatest_defect)) return Errc::not_applicable;
    return best;
  }

  State<Scalar> at(Scalar t) const noexcept {
    const auto [half, rate] = point(unit_ * t);
    // half / (2 fold) is half the angle turned
    const Scalar turn = (half - half_) / fold_;
    State<Scalar> s;
    Quat<Scalar> by{std::cos(turn), 0, 0, 0};
    (axis_ == 0 ? by.x : axis_ == 1 ? by.y : by.z) = std::sin(turn);
    s.attitude = normalised(start_.attitude * by);
    s.down = rotate<Scalar>(conjugate(by), start_.down);
    s.angular_velocity = Vec3<Scalar>::Zero();
    s.angular_velocity[axis_] = unit_ * rate;
    return s;
  }

  /// Bound of the error of at() up to time |t|. A start off the plane by rounding may leave it, and one that stands upright to rounding
  /// may fall. @param blur relative distance from the plane that the start may have beyond what its numbers show
  ExactError<Scalar> error(Scalar t, Scalar blur = 0) const noexcept {
    t = std::abs(unit_ * t);
    const Scalar share = rate_ > frequency_ ? frequency_ / rate_ : Scalar(1);  // what the torque has in the rate
    const Scalar relative = stated * (1 + share * share * parts_);
    const Scalar late = time_error(relative, relative * shift_, K_, rate_, t);
    const auto grown = [t](Scalar part, Scalar rate) { return part == 0 ? Scalar(0) : part * std::exp(rate * t); };
    const Scalar off = grown(defect_ + blur, fastest_ + growth_) + grown(upright_, frequency_);
    const Scalar angle = stated * (1 + fastest_ * t) + fastest_ * late + off;
    return ExactError<Scalar>::of(angle, unit_ * (fastest_ + 1) * angle);
  }

  PendulumMotion motion() const noexcept { return motion_; }
  int axis() const noexcept { return axis_; }  ///< k
  /// How far off the plane the data are, by rounding, which the motion leaves out; relative.
  Scalar defect() const noexcept { return defect_; }
  /// Body and start lie in the plane to the last digit, by zeros of the data, which no rounding moves: those of the attitude make what is across
  /// the plane vanish term by term, not by what cancels.
  bool in_plane() const noexcept {
    const auto& q = start_.attitude;
    const bool zeros = axis_ == 0 ? q.x * q.z == 0 && q.w * q.y == 0 : q.y * q.z == 0 && q.w * q.x == 0;
    return defect_ == 0 && axis_ != 2 && zeros;
  }
  math::Modulus<Scalar> modulus() const noexcept { return modulus_; }
  Scalar frequency() const noexcept { return unit_ * frequency_; }  ///< c of small swings, rad/s
  /// To and fro, or once round (with the gradient alone half round), s; of small swings at rest; infinite on the
  /// separatrix.
  Scalar period() const noexcept {
    switch (motion_) {
      case PendulumMotion::rest: return 2 * pi<Scalar> / frequency();
      case PendulumMotion::libration: return 4 * K_ / (unit_ * rate_);
      case PendulumMotion::rotation: return 2 * K_ / (unit_ * rate_);
      case PendulumMotion::separatrix: break;
    }
    return infinity<Scalar>;
  }

 private:
  static constexpr Scalar rounding = 64 * epsilon<Scalar>, stated = 8 * epsilon<Scalar>;
  struct Point {
    Scalar half, rate;  // half of fold theta, unwrapped; theta'
  };

  struct Hang {
    Scalar fold;          // 2 where the angle is twice that of the body
    Scalar square;        // of c, 1/s^2
    Scalar parts;         // what it is a difference of, over it
    Scalar cosine, sine;  // of the angle, times any length
    Scalar doubt;         // rounding of the sine, over that length
  };
  static std::optional<Hang> hang(const Problem<Scalar>& problem, const Vec3<Scalar>& d, int k) noexcept;
  void set_phase(Scalar v, Scalar s, Scalar c, Scalar doubt) noexcept;
  bool build(const Problem<Scalar>& problem, const State<Scalar>& start, int k) noexcept;
  Point point(Scalar t) const noexcept {
    if (rate_ == 0) return {half_, 0};
    const auto u = math::JacobiTurn<Scalar>::of(functions_, v0_ + rate_ * t);
    const Scalar sign = std::fmod(u.turns, Scalar(2)) == 0 ? 1 : -1;
    if (rotates_)
      return {std::atan2(u.sn, u.cn) * direction_ + direction_ * pi<Scalar> * u.turns,
              2 * direction_ * rate_ * u.dn / fold_};
    const Scalar k = std::sqrt(modulus_.k2);
    return {direction_ * std::atan2(sign * k * u.sn, u.dn), 2 * direction_ * sign * rate_ * k * u.cn / fold_};
  }

  State<Scalar> start_;
  int axis_ = 2;
  Scalar unit_ = 1, fold_ = 1, parts_ = 0, frequency_ = 0, rate_ = 0, v0_ = 0, K_ = 0, half_ = 0, direction_ = 1;
  bool rotates_ = false;
  math::Modulus<Scalar> modulus_;
  math::JacobiAt<Scalar> functions_{math::Modulus<Scalar>{}};
  PendulumMotion motion_ = PendulumMotion::rest;
  Scalar fastest_ = 0, growth_ = 1, shift_ = 1, defect_ = 0;
  Scalar upright_ = 0;  // angle from standing upright that rounding may hide, at rest there
};

/// The angle of `down` from where it hangs, for swings about axis k; nothing where both weight and gradient act.
template <Real Scalar>
auto Pendulum<Scalar>::hang(const Problem<Scalar>& problem, const Vec3<Scalar>& d, int k) noexcept
    -> std::optional<Hang> {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Vec3<Scalar>& I = problem.inertia();
  const Vec3<Scalar> m = problem.moment();
  const Scalar weight = std::hypot(m[i], m[j]), gradient = problem.gradient() * (I[i] - I[j]);
  if (weight > 0 && gradient == 0)
    return Hang{1,
                weight / I[k],
                0,
                (d[i] * m[i] + d[j] * m[j]) / weight,
                (d[i] * m[j] - d[j] * m[i]) / weight,
                epsilon<Scalar> * (std::abs(d[i] * m[j]) + std::abs(d[j] * m[i])) / weight};
  if (weight != 0) return std::nullopt;
  const Scalar sign = gradient > 0 ? 1 : -1;  // twice the angle beta of down: from axis j, or from i
  const Scalar parts = gradient != 0 ? (I[i] + I[j]) / std::abs(I[i] - I[j]) : Scalar(0);
  return Hang{2, std::abs(gradient) / I[k], parts, sign * (d[j] - d[i]) * (d[j] + d[i]), 2 * sign * d[i] * d[j], 0};
}

/// The elliptic functions of the motion. @param v half the rate of the folded angle   @param s, c sine and cosine of its half   @param doubt error of c
template <Real Scalar>
void Pendulum<Scalar>::set_phase(Scalar v, Scalar s, Scalar c, Scalar doubt) noexcept {
  const Scalar p = v * v, inside = frequency_ * c, up = frequency_ * s;
  const Scalar total = p + up * up;  // rate^2 k^2 of libration, rate^2 of rotation
  const Scalar short_of = (inside - std::abs(v)) * (inside + std::abs(v));
  constexpr Scalar floor = std::numeric_limits<Scalar>::min() / (epsilon<Scalar> * epsilon<Scalar>);
  fastest_ = 2 * std::sqrt(total) / fold_;
  half_ = std::atan2(s, c);
  motion_ = PendulumMotion::rest;
  if (v == 0 && c == 0) upright_ = doubt;
  if (total == 0 || (v == 0 && c == 0)) return;
  rotates_ = short_of < 0;
  direction_ = v < 0 ? -1 : 1;
  // a doubt of the place counts in the energy, and where the pendulum passes or leaves the top slowly in the argument
  const Scalar place = frequency_ * (std::abs(inside) + std::abs(v)) * (2 * doubt / rounding);
  shift_ = (inside * inside + p + place) / std::abs(short_of);
  Scalar sn, cn, dn;
  if (rotates_) {
    motion_ = PendulumMotion::rotation;
    rate_ = std::sqrt(total);
    modulus_ = {std::min(frequency_ * frequency_ / total, Scalar(1)), std::clamp(-short_of / total, floor, Scalar(1))};
    sn = direction_ * s;
    cn = c;
    dn = std::abs(v) / rate_;
  } else {
    motion_ = PendulumMotion::libration;
    rate_ = frequency_;
    modulus_ = {std::min(total / (rate_ * rate_), Scalar(1)), std::clamp(short_of / (rate_ * rate_), floor, Scalar(1))};
    const Scalar amplitude = std::sqrt(total);
    sn = direction_ * up / amplitude;
    cn = std::abs(v) / amplitude;
    dn = c;
  }
  if (!(shift_ * rounding < 1)) motion_ = PendulumMotion::separatrix;
  functions_ = math::JacobiAt<Scalar>(modulus_);
  K_ = functions_.quarter_period();
  const Scalar kp = std::sqrt(modulus_.kp2);
  dn = std::max(dn, kp);
  v0_ = math::jacobi_argument(sn, cn, dn);
  half_ = point(0).half;
}

template <Real Scalar>
bool Pendulum<Scalar>::build(const Problem<Scalar>& problem, const State<Scalar>& start, int k) noexcept {
  const auto hanging = hang(problem, start.down, k);
  if (!hanging) return false;
  const Vec3<Scalar>&I = problem.inertia(), &w = start.angular_velocity;
  const Vec3<Scalar> m = problem.moment();
  const Scalar size = magnitude(m) + problem.gradient() * (I.maxCoeff() - I.minCoeff());
  fold_ = hanging->fold;
  parts_ = hanging->parts;
  const Scalar speed = w[k] * fold_;
  unit_ = std::abs(w[k]) + std::sqrt(hanging->square);
  if (!(unit_ > 0)) unit_ = 1;
  growth_ = std::sqrt(size / I.minCoeff()) / unit_;
  const Scalar other = std::hypot(w[(k + 1) % 3], w[(k + 2) % 3]);
  defect_ = std::abs(start.down[k]) + (other > 0 ? other / unit_ : Scalar(0)) +
            (size > 0 ? std::abs(m[k]) / size : Scalar(0));
  if (!(defect_ <= greatest_defect)) return false;

  start_ = start;
  start_.down[k] = 0;
  axis_ = k;
  frequency_ = std::sqrt(hanging->square) / unit_;
  const Scalar length = std::hypot(hanging->cosine, hanging->sine);
  const Scalar cosine = hanging->cosine / length, sine = hanging->sine / length;
  // sine and cosine of half the angle, angle in (-pi, pi]
  const Scalar c = cosine > 0 ? std::sqrt((1 + cosine) / 2) : std::abs(sine) / std::sqrt(2 * (1 - cosine));
  const Scalar s =
      std::copysign(cosine > 0 ? std::abs(sine) / std::sqrt(2 * (1 + cosine)) : std::sqrt((1 - cosine) / 2), sine);
  set_phase(speed / 2 / unit_, s, c, hanging->doubt / length);
  return true;
}

}  // namespace gyrostat::heavy
