// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"

/// What spin, torque or burn keeps a thrusting spinner within a budget: the linear motion solved backwards (docs/spinning.md,
/// section 3.1).
namespace gyrostat::spinning {

/// A scene that keeps its budget, and the number that was sought for it.
template <Real Scalar>
struct Design {
  Scalar value;             ///< what was asked for
  Problem<Scalar> problem;  ///< with the value in it
  Scalar tilt;      ///< bound of |psi + i phi| of the linear motion, for all time or to the end of the burn, rad
  SpinFlags flags;  ///< of that problem

  /// The linear motion describes the scene: the tilt stays below 0.3 rad.
  bool small_tilt() const noexcept { return tilt <= Scalar(0.3L); }
};

namespace detail {

template <Real Scalar>
Design<Scalar> design(Scalar value, const Problem<Scalar>& problem, Scalar T) noexcept {
  const Scalar tilt = amplitudes(problem, T).tilt;
  return {value, problem, tilt == tilt ? tilt : infinity<Scalar>, spin_flags(problem)};
}

}  // namespace detail

/// The least spin rate, of the sense of the scene's spin (a zero spin counts as positive), at which the torque turns the mean
/// direction of axis 3 by no more than `budget` (rad) and the spin is stable: |M|/|r (D3 r + Lambda)| <= budget. value: r, rad/s,
/// signed. All else is held, the start included; what the start itself adds to the tilt is not counted.
///
/// A rotor against the spin leaves two ranges of spin, one on either side of X = 0, and between them the body may be unstable. Where
/// the limit of stability, not the budget, is what stops the spin from being slower, value is that limit and flags.unstable is
/// set: any faster spin of the same range is stable and within the budget.
///
/// Errors: out_of_domain unless 0 < budget < infinity, zero_vector without transverse torque, not_applicable under a torque about axis
/// 3 and where no stable spin of this sense meets the budget.
template <Real Scalar>
Result<Design<Scalar>> spin_for_pointing(const Problem<Scalar>& problem, Scalar budget) noexcept {
  constexpr Scalar inf = infinity<Scalar>;
  const auto& D = problem.inertia;
  if (!(budget > 0 && budget < inf)) return Errc::out_of_domain;
  if (problem.torque[2] != 0) return Errc::not_applicable;
  const Scalar torque = std::hypot(problem.torque[0], problem.torque[1]);
  if (torque == 0) return Errc::zero_vector;
  const Scalar sense = problem.spin() < 0 ? Scalar(-1) : Scalar(1);
  const Scalar L = sense * problem.gyroscopic();

  // x = |r|: within the budget where |x (D3 x + L)| >= K; each root without cancellation
  const Scalar K = torque / budget, s = 2 * std::sqrt(D[2]) * std::sqrt(K), against = -L;
  struct Range {
    Scalar low, high;
  };
  std::array<Range, 2> ranges;
  int count = 0;
  if (L >= 0) {
    ranges[std::size_t(count++)] = {2 * (K / (L + std::hypot(L, s))), inf};
  } else {
    if (against >= s) {
      const Scalar sum = against + std::sqrt(against - s) * std::sqrt(against + s);
      ranges[std::size_t(count++)] = {2 * (K / sum), sum / (2 * D[2])};
    }
    ranges[std::size_t(count++)] = {(against + std::hypot(L, s)) / (2 * D[2]), inf};
  }

  const auto stable = [&](Scalar x) noexcept {
    const Scalar kappa1 = (D[2] - D[1]) * x + L, kappa2 = (D[2] - D[0]) * x + L;
    return (kappa1 > 0 && kappa2 > 0) || (kappa1 < 0 && kappa2 < 0);
  };
  std::array<Scalar, 2> limits{against / (D[2] - D[0]), against / (D[2] - D[1])};
  for (Scalar& limit : limits)
    if (!(limit > 0)) limit = inf;
  if (limits[0] > limits[1]) std::swap(limits[0], limits[1]);

  auto made = problem;
  const auto at = [&](Scalar x) noexcept {
    made.angular_velocity[2] = sense * x;
    return detail::design(sense * x, made, inf);
  };
  for (int i = 0; i < count; ++i) {
    const auto [low, high] = ranges[std::size_t(i)];
    if (stable(low)) return at(low);
    for (std::size_t j = 0; j < 2; ++j) {
      const Scalar from = limits[j];
      if (!(from >= low && from < high)) continue;
      const Scalar to = std::min(high, j == 0 ? limits[1] : inf);
      if (!(from < to) || !stable(to < inf ? from + (to - from) / 2 : 2 * from)) continue;
      Design<Scalar> limited = at(from);
      limited.flags.unstable = true;
      return limited;
    }
  }
  return Errc::not_applicable;
}

/// The greatest torque across axis 3, along the scene's own, up to which the mean direction of the velocity gained stays within
/// `budget` (rad, below pi/2) of inertial axis 3: |v/v3| <= tan(budget) for the secular ratio. value: |M|, N m. The direction of M in
/// the body and all else is held; the start counts, for it leans the mean direction of the axis too. Infinite where every torque of
/// that direction meets the budget.
///
/// Errors: out_of_domain unless 0 < budget < pi/2, zero_vector without transverse torque, not_applicable under a torque about axis
/// 3, where the spin is unstable, without force along axis 3, and where the start alone is over the budget.
template <Real Scalar>
Result<Design<Scalar>> torque_for_direction(const Problem<Scalar>& problem, Scalar budget) noexcept {
  using math::Complex;
  const auto& f = problem.force;
  const Scalar slope = std::tan(budget);
  if (!(budget > 0 && slope > 0 && slope < infinity<Scalar>) || budget > 2) return Errc::out_of_domain;
  const Scalar torque = std::hypot(problem.torque[0], problem.torque[1]);
  if (torque == 0) return Errc::zero_vector;
  if (problem.torque[2] != 0 || f[2] == 0 || !(problem.nutation_squared() > 0) || problem.spin() == 0)
    return Errc::not_applicable;

  // |start - m lean| <= slope |1 + m axial| over the size m of the torque
  auto made = problem;
  made.angles.theta = 0;
  made.torque = {0, 0, 0};
  const Complex<Scalar> start = mean_tilt(made);
  const Scalar r0 = problem.spin(), u1 = problem.torque[0] / torque, u2 = problem.torque[1] / torque;
  const Complex<Scalar> lean = Complex<Scalar>{u1, u2} / r0 / problem.effective_momentum();
  const Scalar axial = (f[1] * (u1 / (r0 * (problem.inertia[0] * problem.kappa1(r0)))) -
                        f[0] * (u2 / (r0 * (problem.inertia[1] * problem.kappa2(r0))))) /
                       f[2];
  const Scalar out = magnitude(start), steep = magnitude(lean), pull = std::abs(slope * axial);
  if (!(out <= slope)) return Errc::not_applicable;
  // a m^2 + 2 b m = c, c >= 0; past the root the ratio is over the budget, or v3 has changed its sign
  const Scalar a = (steep - pull) * (steep + pull);
  const Scalar b = -(start.re * lean.re + start.im * lean.im) - slope * slope * axial;
  const Scalar c = (slope - out) * (slope + out);
  const Scalar within = b * b + a * c;
  Scalar size = infinity<Scalar>;
  if (within >= 0 && b > 0) size = c / (b + std::sqrt(within));
  if (within >= 0 && b <= 0 && a > 0) size = (std::sqrt(within) - b) / a;

  made = problem;
  made.torque = {size * u1, size * u2, 0};
  if (!(size < infinity<Scalar>)) return Design<Scalar>{size, problem, size, spin_flags(problem)};
  return detail::design(size, made, infinity<Scalar>);
}

namespace detail {

/// A vector at a time and its rate.
template <Real Scalar>
struct Reach {
  Vec3<Scalar> y, rate;
};

/// The first t > 0 with |y(t)| = d, for y(0) = 0. motion(t) -> Reach, curvature(T): a bound of |y''| over [0, T]; infinite where y
/// never moves. `unit`: a time in which the motion changes little. step_limit after 1e6 steps. No crossing is stepped over: each
/// step is shorter than the bound of |y|^2 lets it grow to d^2.
template <Real Scalar, class Motion, class Curvature>
Result<Scalar> first_reach(Scalar d, Scalar unit, bool growing, const Motion& motion,
                           const Curvature& curvature) noexcept {
  Scalar t = 0, horizon = unit, a = curvature(horizon);
  for (int i = 0; i < 1'000'000; ++i) {
    if (t >= horizon) {
      horizon = growing ? horizon + unit : 2 * horizon;
      a = curvature(horizon);
    }
    const auto [y, rate] = motion(t);
    const Scalar size = magnitude(y), speed = magnitude(rate);
    if (!(size < infinity<Scalar> && speed < infinity<Scalar> && a < infinity<Scalar>)) return Errc::not_finite;
    const Scalar left = (d - size) * (d + size);
    if (left <= 4 * epsilon<Scalar> * d * d) return t;
    Scalar step = horizon - t;
    if (a > 0) step = std::min(step, speed / a + std::sqrt(d / a));
    if (a == 0 && speed == 0) return infinity<Scalar>;
    const Scalar fastest = speed + a * step;
    const Scalar bend = fastest * fastest + d * a, grow = y.dot(rate);
    const Scalar room = std::sqrt(grow * grow + bend * left);
    step = std::min(step, grow > 0 ? left / (grow + room) : (room - grow) / bend);
    if (!(t + step > t)) return t;
    t += step;
  }
  return Errc::step_limit;
}

template <Real Scalar, class Motion, class Curvature>
Result<Design<Scalar>> burn(const Problem<Scalar>& problem, Scalar budget, const Motion& motion,
                            const Curvature& curvature) noexcept {
  if (!(budget > 0 && std::isnormal(budget * budget))) return Errc::out_of_domain;
  if (problem.torque[2] != 0) return Errc::not_applicable;
  const Scalar r0 = problem.spin();
  const Scalar rate = std::abs(r0) + std::abs(problem.kappa1(r0)) + std::abs(problem.kappa2(r0));
  const Scalar drive = std::hypot(problem.torque[0] / problem.inertia[0], problem.torque[1] / problem.inertia[1]);
  const Scalar unit = 1 / std::max({rate, std::sqrt(drive), Scalar(1e-12L)});
  const auto T = first_reach(budget, unit, !(problem.nutation_squared() > 0), motion, curvature);
  if (!T) return T.error();
  if (!(*T < infinity<Scalar>)) return Design<Scalar>{*T, problem, 0, spin_flags(problem)};
  return design(*T, problem, *T);
}

}  // namespace detail

/// The longest burn during which the loads displace the mass centre by no more than `budget` (m) across inertial axis 3: the first
/// time at which |x1 + i x2| of x - x(0) - v(0) t is the budget. value: s. The whole scene is held. Unstable spins are answered
/// too, and flagged. Infinite where no force acts.
///
/// Errors: out_of_domain unless the budget is positive and its square a normal number, not_applicable under a torque about axis 3,
/// step_limit where the motion stays below the budget for very long, not_finite where it grows beyond all numbers before.
template <Real Scalar>
Result<Design<Scalar>> burn_for_displacement(const Problem<Scalar>& problem, Scalar budget) noexcept {
  auto p = problem;
  p.velocity = p.position = Vec3<Scalar>(0, 0, 0);
  const Linear<Scalar> linear(p);
  const Scalar across = std::hypot(p.force[0], p.force[1]), along = std::abs(p.force[2]);
  const auto motion = [&](Scalar t) noexcept {
    const auto s = linear.at(t);
    return detail::Reach<Scalar>{{s.position[0], s.position[1], 0}, {s.velocity[0], s.velocity[1], 0}};
  };
  const auto curvature = [&](Scalar T) noexcept {
    return (across + (along == 0 ? along : along * amplitudes(p, T).tilt)) / p.mass;
  };
  auto made = detail::burn(p, budget, motion, curvature);
  if (!made) return made.error();
  auto design = *made;
  design.problem = problem;
  return design;
}

/// The longest burn that changes the velocity of the mass centre by no more than `budget` (m/s), in size: the first time at which
/// |v - v(0)| is the budget. value: s. All else as for burn_for_displacement.
template <Real Scalar>
Result<Design<Scalar>> burn_for_velocity(const Problem<Scalar>& problem, Scalar budget) noexcept {
  using math::Complex;
  auto p = problem;
  p.velocity = p.position = Vec3<Scalar>(0, 0, 0);
  const Linear<Scalar> linear(p);
  const Scalar across = std::hypot(p.force[0], p.force[1]), along = std::abs(p.force[2]);
  const auto motion = [&](Scalar t) noexcept {
    const auto s = linear.at(t);
    const Complex<Scalar> f{p.force[0], p.force[1]}, Gamma{s.angles.psi, s.angles.phi};
    const auto pushed = math::unit(s.angles.theta) * (f - p.force[2] * math::turned(Gamma));
    const Scalar ahead = p.force[2] + f.im * Gamma.re - f.re * Gamma.im;
    return detail::Reach<Scalar>{s.velocity, Vec3<Scalar>(pushed.re, pushed.im, ahead) / p.mass};
  };
  const auto curvature = [&](Scalar T) noexcept {
    if (across == 0 && along == 0) return Scalar(0);
    const auto [tilt, rate] = amplitudes(p, T);
    const Scalar r0 = std::abs(p.spin()), moved = r0 * tilt + rate;
    return std::hypot(r0 * (across + along * tilt) + along * moved, across * moved) / p.mass;
  };
  auto made = detail::burn(p, budget, motion, curvature);
  if (!made) return made.error();
  auto design = *made;
  design.problem = problem;
  return design;
}

}  // namespace gyrostat::spinning
