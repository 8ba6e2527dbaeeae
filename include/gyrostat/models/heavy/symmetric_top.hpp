// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The body with an axis of symmetry through its mass centre (docs/heavy.md, section 7): its constants, and its motion
/// once that of its axis is known.
namespace gyrostat::heavy {

/// Such a body in a frame whose third axis is that of symmetry.
template <Real Scalar>
struct SymmetricTop {
  /// How far from symmetric, relative, a body may be that counts as symmetric.
  static constexpr Scalar greatest_defect = 16 * epsilon<Scalar>;

  Scalar across = 1, along = 1;  ///< A, C, kg m^2
  Scalar weight = 0;    ///< W = M g z0, N m; positive where the mass centre hangs below O as the axis points down
  Scalar gradient = 0;  ///< N, 1/s^2; 0 of a sphere
  Scalar field = 0;     ///< N, which acts on what a body is off its symmetry, of a sphere too
  bool sphere = false;  ///< to rounding; its principal axes are none
  Scalar defect = 0;    ///< relative, at most greatest_defect
  Mat3<Scalar> axes = Mat3<Scalar>::Identity();  ///< columns: the axes of the frame in those of the body
  Quat<Scalar> turn;                             ///< the same as a quaternion, frame to body

  /// The axis may be any of the body; of a sphere it is the line to the mass centre. not_applicable where there is
  /// none.
  static Result<SymmetricTop> of(const Problem<Scalar>& problem) noexcept {
    const Vec3<Scalar>& I = problem.inertia();
    const Vec3<Scalar> m = problem.moment();
    const Scalar size = magnitude(m), most = I.maxCoeff();
    SymmetricTop best;
    best.defect = infinity<Scalar>;
    for (const int k : {2, 0, 1}) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const Scalar off = size > 0 ? std::hypot(m[i], m[j]) / size : Scalar(0);
      const Scalar defect = std::abs(I[i] - I[j]) / most + off;
      if (!(defect < best.defect)) continue;
      const Scalar N = problem.gradient();
      best = {(I[i] + I[j]) / 2, I[k], m[k], N, N, false, defect, Mat3<Scalar>::Zero(), {}};
      best.axes(i, 0) = best.axes(j, 1) = best.axes(k, 2) = 1;
      constexpr Scalar h = Scalar(0.5);
      if (k == 0) best.turn = {h, h, h, h};
      if (k == 1) best.turn = {h, -h, -h, -h};
    }
    if (best.defect <= greatest_defect) return best;
    const Scalar uneven = (most - I.minCoeff()) / most;
    if (!(uneven <= greatest_defect)) return Errc::not_applicable;
    const Scalar sign = m[2] < 0 ? -1 : 1;
    const Vec3<Scalar> n = sign / size * m;
    const Quat<Scalar> turn = normalised(Quat<Scalar>{1 + n[2], -n[1], n[0], 0});
    const Scalar off = 2 * epsilon<Scalar>;  // of the mass centre from the axis, by the rounding of the turn
    best = {I.sum() / 3, I.sum() / 3, sign * size, 0, problem.gradient(), true, uneven + off, to_matrix(turn), turn};
    return best;
  }

  /// Relative error of the changes of the rates: asymmetry acts on the spin through the moment about the axis, which may be slight.
  Scalar asymmetry_error() const noexcept { return defect * std::max(Scalar(1), across / along); }
  /// N (C - A)/A, what the gradient does to the axis, 1/s^2.
  Scalar gradient_rate() const noexcept { return gradient * (along - across) / across; }
  /// 2 W/A, 1/s^2.
  Scalar pull() const noexcept { return 2 * weight / across; }
};

/// A start as the axis sees it, in a unit of rate of the motion's own size. With u = down along the axis, v the angular
/// velocity across it:
///     u'^2 = (1 - u^2) v^2 - (d - rho (u - u0))^2,   v^2 = v0^2 + (2 W/A)(u - u0) - N (C - A)/A (u^2 - u0^2).
/// All of it comes from the components, so that nothing cancels near u = +-1 nor at a turning point.
template <Real Scalar>
struct TopStart {
  Scalar unit;              ///< rad/s; 1 where nothing can move
  Scalar spin, rho;         ///< r; C r/A
  Scalar pull, gradient;    ///< 2 W/A, N (C - A)/A
  Scalar u, above, below;   ///< u, 1 - u, 1 + u
  Scalar square, swing, d;  ///< v^2; u'; v . down
  Scalar ground;            ///< 1 - u^2
  Vec3<Scalar> rate, down;  ///< angular velocity and down in the top's frame
  Quat<Scalar> attitude;    ///< top's frame to inertial

  /// @param start aligned
  TopStart(const SymmetricTop<Scalar>& top, const State<Scalar>& start) noexcept {
    unit =
        magnitude(start.angular_velocity) + std::sqrt(std::abs(top.pull())) + std::sqrt(std::abs(top.gradient_rate()));
    if (!(unit > 0)) unit = 1;
    rate = top.axes.transpose() * (start.angular_velocity / unit);
    pull = top.pull() / unit / unit;
    gradient = top.gradient_rate() / unit / unit;
    down = top.axes.transpose() * start.down;
    spin = rate[2];
    rho = top.along / top.across * spin;
    u = down[2];
    ground = down[0] * down[0] + down[1] * down[1];
    above = u > 0 ? ground / (1 + u) : 1 - u;
    below = u < 0 ? ground / (1 - u) : 1 + u;
    square = rate[0] * rate[0] + rate[1] * rate[1];
    swing = down[0] * rate[1] - down[1] * rate[0];
    d = rate[0] * down[0] + rate[1] * down[1];
    attitude = start.attitude * top.turn;
  }

  /// What is half of -(u'^2)'' by u: in a steady precession the square of the frequency of small nutation, negative where it is unstable.
  Scalar nutation_square() const noexcept {
    return square + 2 * u * (pull - 2 * gradient * u) + gradient * ground + rho * rho;
  }
  /// The sum of the magnitudes of its terms.
  Scalar nutation_terms() const noexcept { return square + 2 * std::abs(pull) + 5 * std::abs(gradient) + rho * rho; }

  /// The axis stays in one vertical plane, to rounding: no spin and no momentum about the vertical.
  bool planar(Scalar rounding = 16 * epsilon<Scalar>) const noexcept {
    return std::abs(spin) <= rounding && std::abs(rho) <= rounding && std::abs(d) <= rounding;
  }
};

/// Where the axis is at one time.
template <Real Scalar>
struct AxisPoint {
  Scalar u, rate;                   ///< down along the axis, du/dt in the start's unit
  Scalar above, below;              ///< 1 - u, 1 + u, with relative accuracy; > 0
  Scalar phase_above, phase_below;  ///< int c/(2 (1 -+ u)) dt with c of the pole, rad
};

/// The motion of the whole body from that of its axis, without a pole at u = +-1. With the quaternion (w, x, y, z) of a
/// body of spin rho in place of r, w + i z and x + i y are amplitudes of squares (1 - u)/2 and (1 + u)/2 whose phases
/// fall at the rates c/(2 (1 -+ u)), c = d - rho (+-1 - u0); the body itself turns about its axis by (r - rho) t more
/// (Klein and Sommerfeld 1897).
template <Real Scalar>
class TopAttitude {
 public:
  TopAttitude() = default;

  /// @param c_above, c_below c of the poles u = 1 and u = -1, in the start's unit   @param first the axis at the start
  /// @param fastest angular velocity reached, in the same
  TopAttitude(const SymmetricTop<Scalar>& top, const TopStart<Scalar>& start, Scalar c_above, Scalar c_below,
              const AxisPoint<Scalar>& first, Scalar fastest) noexcept
      : axes_(top.axes),
        turn_back_(conjugate(top.turn)),
        unit_(start.unit),
        spin_(start.spin),
        rest_((start.spin - start.rho) / 2),
        c_above_(c_above),
        c_below_(c_below) {
    const Quat<Scalar>& q = start.attitude;
    const Quat<Scalar> v = quaternion_rate<Scalar>(q, {start.rate[0], start.rate[1], start.rho});
    // value and derivative have the same phase to find; near its pole an amplitude has only the second
    const Scalar weight = fastest > 0 ? 1 / (fastest * fastest) : Scalar(0);
    const auto phase = [&](C value, C change, Scalar size, C slope, Scalar by) {
      const C sum = size * value + weight * (change * math::conjugate(slope));
      const Scalar length = math::magnitude(sum);
      return length > 0 ? (sum / length) * math::unit(by) : C{1, 0};
    };
    const Pole a = above(first), b = below(first);
    above_ = phase({q.w, q.z}, {v.w, v.z}, a.size, a.slope, first.phase_above);
    below_ = phase({q.x, q.y}, {v.x, v.y}, b.size, b.slope, first.phase_below);
  }

  /// The state, in the body's axes, at time t from the start, times the unit, where the axis is at `point`.
  State<Scalar> at(Scalar t, const AxisPoint<Scalar>& point) const noexcept {
    const Pole pa = above(point), pb = below(point);
    const C a = above_ * math::unit(rest_ * t - point.phase_above);
    const C b = below_ * math::unit(-rest_ * t - point.phase_below);
    const C difference = math::conjugate(a) * b;
    const C across = Scalar(2) * (difference * (pa.size * pb.slope - pb.size * math::conjugate(pa.slope)));
    const Scalar side = 2 * pa.size * pb.size;
    State<Scalar> s;
    s.angular_velocity = axes_ * (unit_ * Vec3<Scalar>(across.re, across.im, spin_));
    s.down = axes_ * Vec3<Scalar>(side * difference.im, -side * difference.re, point.u);
    const Quat<Scalar> q{pa.size * a.re, pb.size * b.re, pb.size * b.im, pa.size * a.im};
    s.attitude = normalised(q * turn_back_);
    return s;
  }

 private:
  using C = math::Complex<Scalar>;
  struct Pole {
    Scalar size;  // of the amplitude
    C slope;      // its derivative but for the phase
  };
  Pole above(const AxisPoint<Scalar>& p) const noexcept {
    const Scalar size = std::sqrt(p.above / 2);
    return {size, {-p.rate / (4 * size), -c_above_ / (4 * size)}};
  }
  Pole below(const AxisPoint<Scalar>& p) const noexcept {
    const Scalar size = std::sqrt(p.below / 2);
    return {size, {p.rate / (4 * size), -c_below_ / (4 * size)}};
  }

  Mat3<Scalar> axes_ = Mat3<Scalar>::Identity();
  Quat<Scalar> turn_back_;
  Scalar unit_ = 1, spin_ = 0, rest_ = 0, c_above_ = 0, c_below_ = 0;
  C above_, below_;
};

}  // namespace gyrostat::heavy
