// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

/// Tilt, rad, up to which errors are estimated by orders of it; beyond it by magnitudes alone, as if nothing oscillated or cancelled.
inline constexpr double small_tilt = 0.3;

/// Greatest values over [0, T] of what is integrated over time from 0, and of the integral of that.
template <Real Scalar>
struct OverTime {
  Scalar once, twice;

  /// As if what is integrated did not change its sign.
  static OverTime roughly(Scalar once, Scalar T) noexcept { return {once, once * T / 2}; }
  friend OverTime operator+(const OverTime& a, const OverTime& b) noexcept {
    return {a.once + b.once, a.twice + b.twice};
  }
  friend OverTime operator*(Scalar a, const OverTime& b) noexcept { return {a * b.once, a * b.twice}; }
  /// The lesser, passing over what is not a number.
  void lower(const OverTime& other) noexcept {
    if (other.once < once) once = other.once;
    if (other.twice < twice) twice = other.twice;
  }
};

/// Estimated greatest errors of the linear motion over [0, T] against the full equations, in units of the quantities; of a pair,
/// of its norm.
template <Real Scalar>
struct LinearErrors {
  Scalar rates;             ///< (p, q)
  Scalar spin;              ///< r
  Scalar tilt;              ///< (psi, phi)
  Scalar of_rates = 0;      ///< the part of it that the error of the rates makes
  Scalar of_spin_rate = 0;  ///< the part of it that the change of the spin rate makes: of the second order alone
  Scalar shift = 0;         ///< of the frequency of nutation, rad/s
  Scalar theta;             ///< spin angle
  Scalar attitude;          ///< angle of the rotation between the two attitudes, rad
  Scalar momentum;          ///< (G1, G2)
  Scalar axial_momentum;    ///< G3
  Scalar velocity;          ///< (v1, v2)
  Scalar axial_velocity;    ///< v3
  Scalar position;          ///< (x1, x2)
  Scalar axial_position;    ///< x3
  OverTime<Scalar> in_space{0, 0};  ///< of the tilt's error as space sees it, rad s
  OverTime<Scalar> in_body{0, 0};   ///< and as the body sees it
  Amplitudes<Scalar> size;          ///< g and P, of which the estimates are made
};

namespace detail {

/// Greatest values over [0, T] of the change of the spin rate to second order, rho = ((D1 - D2)/(2 D3)) Im int Pi^2, and of
/// its integral (docs/spinning.md, section 6.1).
template <Real Scalar>
struct SpinChange {
  Scalar rate, angle;
  Scalar at_nu = 0;  ///< of the rate what swings with nu, where the nutation is stable

  SpinChange(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar P, Scalar T) noexcept {
    const Scalar factor = std::abs(problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2]);
    rate = P * P * T;
    angle = rate * T / 2;
    const Scalar nu2 = problem.nutation_squared();
    const RateModes<Scalar> m(start, nu2);
    if (nu2 < 0) {
      const Scalar mu = m.lambda.re, growth = std::exp(mu * T);
      const Scalar c = magnitude(m.constant), u = magnitude(m.up) * growth, d = magnitude(m.down);
      lower(rate, c * c * T + (2 * c * u + u * u / 2 + 2 * c * d + d * d / 2) / mu + 2 * magnitude(m.up) * d * T);
      lower(angle, c * c * T * T / 2 + (2 * c * u + u * u / 4) / (mu * mu) + (2 * c * d + d * d / 2) * T / mu +
                       magnitude(m.up) * d * T * T);
    } else {
      const Scalar nu = m.lambda.im;
      const Scalar steady = std::abs(2 * m.constant.re * m.constant.im + 2 * (m.up * m.down).im);
      const Scalar once = 2 * magnitude(m.constant * m.up - conjugate(m.constant * m.down));
      const Scalar twice = magnitude(m.up * m.up - conjugate(m.down * m.down));
      const auto single = [T](Scalar w) noexcept { return std::min(T, 2 / w); };
      const auto both = [T, single](Scalar w) noexcept { return std::min(T * T / 2, (T + single(w)) / w); };
      at_nu = once * single(nu);
      lower(rate, steady * T + once * single(nu) + twice * single(2 * nu));
      lower(angle, steady * T * T / 2 + once * both(nu) + twice * both(2 * nu));
    }
    rate *= factor;
    angle *= factor;
    at_nu *= factor;
  }
};

/// The linear tilt as space sees it, e^(i r0 t) Gamma = sum tilt_j e^(pace_j t), and the rates that belong to it: a mode that stands still, and modes 0, lambda
/// and -lambda of the rates, lambda = i nu, or |nu| where the nutation is unstable. Infinite or NaN where nu = 0, or one of them is at rest in space.
template <Real Scalar>
struct TiltModes {
  using Complex = math::Complex<Scalar>;
  static constexpr int count = 4;

  bool stable;                         ///< the nutation; else turning() means nothing
  Complex tilt[count];                 ///< at t = 0, rad
  Complex rate[count];                 ///< of p + i q at t = 0, rad/s: pace times tilt
  Complex pace[count];                 ///< 0, i r0, i r0 + lambda, i r0 - lambda, 1/s
  Scalar tilted[count], rated[count];  ///< sizes of tilts and rates

  TiltModes(const Problem<Scalar>& problem, const LinearStart<Scalar>& start) noexcept
      : TiltModes(problem, start, problem.nutation_squared()) {}
  TiltModes(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar nutation_squared) noexcept
      : stable(nutation_squared > 0) {
    const Complex spin{0, problem.spin()};
    const RateModes<Scalar> modes(start, nutation_squared);
    const Complex paces[] = {{}, spin, spin + modes.lambda, spin - modes.lambda};
    const Complex amplitudes[] = {{}, modes.constant, modes.up, modes.down};
    tilt[0] = start.Gamma;
    for (int j = 0; j < count; ++j) {
      rate[j] = amplitudes[j];
      pace[j] = paces[j];
      rated[j] = magnitude(rate[j]);
      if (j == 0) continue;
      tilt[j] = rate[j] * math::inverse(pace[j]);
      tilted[j] = magnitude(tilt[j]);
      tilt[0] = tilt[0] - tilt[j];
    }
    tilted[0] = magnitude(tilt[0]);
  }

  Scalar turning(int j) const noexcept { return pace[j].im; }
  /// What nutation adds to the spin angle in the mean, rad/s.
  Scalar phase_rate() const noexcept {
    Scalar sum = 0;
    for (int k = 1; k < count; ++k) sum += (rate[k] * conjugate(tilt[k])).im;
    return sum / 2;
  }
  /// visit(c, w) for what swings of the phase of nutation, as integrals of Im(c e^(i w t)).
  template <class Visit>
  void swings_of_phase(Visit&& visit) const noexcept {
    for (int k = 1; k < count; ++k)
      for (int j = 0; j < count; ++j)
        if (j != k) visit(rate[k] * conjugate(tilt[j]) / Scalar(2), turning(k) - turning(j));
  }
};

/// What nutation adds to the spin angle over [0, T], half the integral of Im(Pi Gamma~): its greatest value, and that of the same modes if
/// none of their mean rates cancelled; from the modes where these are apart, else from g and P.
template <Real Scalar>
struct NutationPhase {
  Scalar net, gross;

  NutationPhase(const TiltModes<Scalar>& m, const Amplitudes<Scalar>& size, Scalar T) noexcept {
    net = gross = size.tilt * size.rate * T / 2;
    Scalar steady = 0, all = 0, swings = 0;
    for (int j = 1; j < m.count; ++j) {
      const int partner = m.stable || j == 1 ? j : 5 - j;  // whose product with it is steady: of growth, decay
      for (int k = 0; k < m.count; ++k)
        if (k == partner) {
          steady += (m.rate[j] * conjugate(m.tilt[k])).im;
          all += m.rated[j] * m.tilted[k];
        } else {
          swings += m.rated[j] * m.tilted[k] * greatest_integral(m.pace[j] + conjugate(m.pace[k]), T);
        }
    }
    lower(net, (std::abs(steady) * T + swings) / 2);
    lower(gross, (all * T + swings) / 2);
  }
};

/// What is left of the third order of the tilt over [0, T] where the part of it that stands still in space is turned back by what nutation adds
/// to the spin angle, half the integral of |Gamma|^2 Pi but for that part: a bound, from the magnitudes of the modes, and infinite where
/// these are not apart.
template <Real Scalar>
Scalar third_order_left(const TiltModes<Scalar>& modes, Scalar T) noexcept {
  Scalar sum = 0;
  for (int i = 0; i < modes.count; ++i)
    for (int j = 0; j < modes.count; ++j)
      for (int k = 1; k < modes.count; ++k) {
        if (i == 0 && j == k) continue;
        const Scalar w = std::abs(modes.turning(i) - modes.turning(j) + modes.turning(k));
        sum += modes.tilted[i] * modes.tilted[j] * modes.rated[k] * std::min(T, 2 / w);
      }
  return sum <= infinity<Scalar> ? sum / 2 : infinity<Scalar>;
}

/// The part of the tilt that stands still in space, which second order turns back by what nutation and the change of the spin rate add to
/// the spin angle; 0 where that leaves no less of the third order than what turning takes away.
template <Real Scalar>
struct StillTilt {
  math::Complex<Scalar> still;     ///< rad
  Scalar left = infinity<Scalar>;  ///< third_order_left, rad, else infinite

  StillTilt(const TiltModes<Scalar>& modes, const Amplitudes<Scalar>& size, Scalar T) noexcept {
    if (!modes.stable) return;
    for (int j = 1; j < modes.count; ++j)
      if (!(std::abs(modes.turning(j)) * T >= 1)) return;  // within T that mode cannot be told from what stands still
    const Scalar rest = third_order_left(modes, T);
    if (!(rest < size.tilt * NutationPhase<Scalar>(modes, size, T).gross)) return;
    still = modes.tilt[0];
    left = rest;
  }
};

/// Error that grows from the rates at the start where the spin is unstable, rad/s: their third order and roundings, even where no mode of
/// the linear motion itself grows, as where the torque holds the body on its unstable axis. 0 where it is stable.
template <Real Scalar>
Scalar grown_error(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar zeta, Scalar T) noexcept {
  const Scalar nu2 = problem.nutation_squared();
  if (!(nu2 < 0)) return 0;
  const Scalar mu = std::sqrt(-nu2), grown = std::exp(mu * T), once = std::min(T, 1 / mu);
  const Scalar sizes = magnitude(start.Pi) + (magnitude(start.b) + magnitude(start.d) * once) * once;
  const Scalar spin =
      std::abs(problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2]) * sizes * sizes * once;
  return sizes * (zeta * spin * once + 8 * epsilon<Scalar>)*grown;
}

/// Error of the linear motion's transverse momentum at its start, which it takes to first order in the tilt, N m s.
template <Real Scalar>
Scalar momentum_left_out(const Problem<Scalar>& problem) noexcept {
  const auto less_sine = [](Scalar x) noexcept {
    const Scalar square = x * x;
    return square < Scalar(0.25L) ? x * square / 6 * (1 - square / 20) : x - std::sin(x);
  };
  const Scalar psi = problem.angles.psi, phi = problem.angles.phi, L3 = problem.axial_momentum();
  const Scalar G1 = problem.inertia[0] * problem.angular_velocity[0];
  const Scalar G2 = problem.inertia[1] * problem.angular_velocity[1];
  const Scalar less_psi = 2 * std::pow(std::sin(psi / 2), 2), less_phi = 2 * std::pow(std::sin(phi / 2), 2);
  return std::hypot(less_phi * G1 + less_sine(phi) * L3,
                    less_psi * G2 - std::sin(psi) * (std::sin(phi) * G1 + less_phi * L3) - less_sine(psi) * L3);
}

/// Greatest integral over [0, T] of an error of third order of the tilt that is 1 at most, and of what it makes of products with the tilt: it
/// swings with r0, nu, and with r0 less some nu, but for the cubes of what stands still.
template <Real Scalar>
Scalar third_order_swing(const Problem<Scalar>& problem, Scalar T) noexcept {
  const Divisors<Scalar> rates = divisors(problem);
  Scalar least = rates.least();
  if (problem.nutation_squared() > 0)
    for (const Scalar apart : {rates.spin - 2 * rates.nu, rates.spin - 3 * rates.nu, 2 * rates.spin - rates.nu})
      least = std::min(least, std::abs(apart));
  return std::min(T, 2 / least);
}

/// The tilt, rad, of the nutation that the constant mode of the rates forces: the spin rate swings with nu, and with it the torque of the gyroscopic
/// terms on that mode, so that it grows all the time. `per_rate`: what a change of the spin rate changes of the frequency of nutation.
template <Real Scalar>
Scalar forced_nutation(const TiltModes<Scalar>& modes, const SpinChange<Scalar>& rho, Scalar per_rate,
                       Scalar T) noexcept {
  if (!(modes.stable && rho.at_nu > 0)) return 0;
  const Scalar slowest = std::min(std::abs(modes.turning(2)), std::abs(modes.turning(3)));
  return per_rate * rho.at_nu * modes.rated[1] * T / 2 * std::min(T, 1 / slowest);
}

template <Real Scalar>
inline constexpr OverTime<Scalar> never{infinity<Scalar>, infinity<Scalar>};

/// A sum of products of modes, c e^(i w t), integrated over [0, t], and twice, at most for t up to T: what stands still within T and what the integral
/// begins with add up with their phases, what swings by its size.
template <Real Scalar>
class ModeIntegral {
 public:
  using Complex = math::Complex<Scalar>;
  explicit ModeIntegral(Scalar T) noexcept : T_(T) {}

  /// c e^(i w t).
  void add(Complex c, Scalar w) noexcept {
    const Scalar size = magnitude_at_most(c), turn = std::abs(w) * T_;
    if (turn < 1) {
      still_ = still_ + c;
      add_swing(size * turn * T_ / 2, size * turn * T_ * T_ / 6);
    } else {
      drift_ = drift_ + math::turned(c / w);
      add_swing(size / std::abs(w), 2 * size / (w * w));
    }
  }
  /// The integral of c e^(i w t), turning with u.
  void add_integral(Complex c, Scalar w, Scalar u) noexcept {
    if (std::abs(w) * T_ < 1) return add_growing(magnitude_at_most(c), u);
    const Complex swing = -math::turned(c / w);
    add(swing, w + u);
    add(-swing, u);
  }
  /// c t, turning with u.
  void add_growing(Scalar c, Scalar u) noexcept {
    const Scalar w = std::abs(u);
    add_swing(c * std::min(T_ * T_ / 2, 2 * T_ / w), c * T_ * std::min(T_ * T_ / 6, 4 / (w * w)));
  }

  OverTime<Scalar> greatest() const noexcept {
    const Scalar still = magnitude(still_), drift = magnitude(drift_);
    return {still * T_ + drift + swings_.once, (still * T_ / 2 + drift) * T_ + swings_.twice};
  }

 private:
  void add_swing(Scalar once, Scalar twice) noexcept {
    swings_.once += once;
    swings_.twice += twice;
  }

  Scalar T_;
  Complex still_{}, drift_{};
  OverTime<Scalar> swings_{0, 0};
};

/// Greatest integrals over [0, T] of what the linear motion leaves out to second order, s, but for the change of the spin rate: of the direction
/// e^(i theta) in which a transverse force acts, and of the cosine of the tilt. From the modes; infinite without them.
template <Real Scalar>
struct ThrustLeftOut {
  OverTime<Scalar> turned = never<Scalar>, cosine = never<Scalar>;

  ThrustLeftOut(const LinearStart<Scalar>& start, const TiltModes<Scalar>& m, Scalar spin, Scalar T) noexcept {
    if (!m.stable) return;
    ModeIntegral<Scalar> direct(T), mirrored(T), lost(T);
    // e^(i theta) (1 - |A|^2/4) and e^(-i theta) A^2/4, theta with the phase of nutation
    for (int a = 0; a < m.count; ++a)
      for (int b = 0; b < m.count; ++b) {
        const auto product = m.tilt[a] * conjugate(m.tilt[b]) / Scalar(4);
        direct.add(-product, m.turning(a) - m.turning(b) + spin);
        lost.add(Scalar(2) * product, m.turning(a) - m.turning(b));
        mirrored.add(m.tilt[a] * m.tilt[b] / Scalar(4), m.turning(a) + m.turning(b) - spin);
      }
    direct.add({0, start.Gamma.re * start.Gamma.im / 2}, spin);
    direct.add_growing(std::abs(m.phase_rate()), spin);
    m.swings_of_phase([&](auto c, Scalar w) noexcept {
      direct.add_integral(c / Scalar(2), w, spin);
      direct.add_integral(-conjugate(c) / Scalar(2), -w, spin);
    });
    turned = direct.greatest() + mirrored.greatest();
    cosine = lost.greatest();
  }
};

/// Greatest integrals over [0, T] of what the linear motion leaves out of the tilt to third order, rad s: of the direction of axis 3 in space, and of
/// that of space in the body. From the modes; infinite without them. `shift`: of the frequency of nutation, rad/s; `g`: greatest tilt, with its error, where it is `linear.tilt`
/// without.
template <Real Scalar>
struct TiltLeftOut {
  OverTime<Scalar> space = never<Scalar>, body = never<Scalar>;

  TiltLeftOut(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, const TiltModes<Scalar>& m,
              const SpinChange<Scalar>& rho, const Amplitudes<Scalar>& linear, Scalar shift, Scalar g,
              Scalar T) noexcept {
    if (!m.stable) return;
    using math::turned;
    using Complex = math::Complex<Scalar>;
    const auto single = [T](Scalar w) noexcept { return std::min(T, 2 / std::abs(w)); };
    const Scalar r0 = problem.spin(), nu = std::sqrt(problem.nutation_squared()), once = single(r0);
    ModeIntegral<Scalar> in_space(T), in_body(T);

    // half the integral of |A|^2 A', but for what turns the part that stands still
    for (int i = 0; i < m.count; ++i)
      for (int j = 0; j < m.count; ++j)
        for (int k = 1; k < m.count; ++k) {
          if (i == 0 && j == k) continue;
          const Scalar w = m.turning(i) - m.turning(j) + m.turning(k);
          const Complex product = m.tilt[i] * conjugate(m.tilt[j]) * m.rate[k] / Scalar(-2);
          in_space.add_integral(product, w, 0);
          in_body.add_integral(product, w, -r0);
        }
    // that in the body; in space the phase of nutation turns all, and that part stands still
    const Scalar phase_rate = std::abs(m.phase_rate());
    in_body.add_growing(phase_rate * m.tilted[0], r0);
    for (int a = 0; a < m.count; ++a) {
      if (a > 0) in_space.add_growing(phase_rate * m.tilted[a], m.turning(a));
      m.swings_of_phase([&](Complex c, Scalar w) noexcept {
        in_space.add_integral(c * m.tilt[a] / Scalar(2), w, m.turning(a));
        in_space.add_integral(-conjugate(c) * m.tilt[a] / Scalar(2), -w, m.turning(a));
      });
    }
    // the angles at the start are no directions
    const Scalar psi = start.Gamma.re, phi = start.Gamma.im;
    const Complex bent{-psi * psi * psi / 6, -phi * (psi * psi / 2 + phi * phi / 6)};
    in_space.add(bent, 0);
    in_body.add(bent, -r0);
    for (int a = 0; a < m.count; ++a) in_space.add(turned(psi * phi / 2 * m.tilt[a]), m.turning(a));
    const Scalar wider = g / linear.tilt, cubed = wider * wider * wider;
    space = Scalar(1.25L) * cubed * in_space.greatest();
    body = Scalar(1.25L) * cubed * in_body.greatest();
    if (!(rho.rate > 0)) return;

    // nutation late by the change of its frequency, and a lean that follows the change of the spin rate
    const Scalar swing = third_order_swing(problem, T);
    const Scalar late = std::min(shift * T, shift / rho.rate * rho.angle * wider * wider);
    const Scalar soon = std::min(T, 1 / nu), answer = std::min(T, 2 / divisors(problem).least());
    const Scalar unlike = wider * shift * (m.rated[1] + m.rated[2] + m.rated[3]) * soon * answer;
    const Scalar forced = cubed * forced_nutation(m, rho, shift / rho.rate, T);
    Scalar more_space = wider * late * (m.tilted[2] * single(m.turning(2)) + m.tilted[3] * single(m.turning(3))) +
                        (unlike + forced) * swing;
    Scalar more_body =
        wider * (late * (m.tilted[2] + m.tilted[3]) * single(nu) + shift * m.rated[1] * soon * once * T) +
        unlike * std::max(single(nu), once) + forced * single(nu);
    // it turns all modes but the one that stands still, and makes that one from others
    for (int j = 1; j < m.count; ++j) {
      const Scalar size = cubed * m.tilted[j], made = size * rho.rate * std::min(T, 1 / std::abs(m.turning(j)));
      more_space += size * rho.angle * single(m.turning(j)) + made * T / 2;
      more_body += made * once;
    }
    more_body += cubed * m.tilted[0] * rho.angle * once;
    space = space + OverTime<Scalar>::roughly(more_space, T);
    body = body + OverTime<Scalar>::roughly(more_body, T);
  }
};

}  // namespace detail

/// How closely errors are estimated of what is integrated over time: momentum, velocity, position.
enum class Look : std::uint8_t { rough, close };

/// Costs a microsecond, a close look some two more; no bounds, but generous estimates (docs/spinning.md, section 5.1a). T > 0.
template <Real Scalar>
LinearErrors<Scalar> linear_errors(const Problem<Scalar>& problem, Scalar T, Look look = Look::close) noexcept {
  const LinearStart<Scalar> start(problem);
  const Amplitudes<Scalar> size = amplitudes(problem, T);
  const detail::SpinChange<Scalar> rho(problem, start, size.rate, T);
  const Scalar r0 = std::abs(problem.spin());
  const Scalar kappa1 = std::abs(problem.kappa1(problem.spin())), kappa2 = std::abs(problem.kappa2(problem.spin()));
  const Scalar steep = std::max(kappa1, kappa2), flat = std::min(kappa1, kappa2);
  const Scalar zeta = problem.greatest_zeta();
  // greatest ratio of the rates' ellipse, or what it grows to within T
  const Scalar skew = std::min(1 + steep * T, std::sqrt(steep / flat));
  const Scalar answer = std::min(T, 2 / divisors(problem).least());
  Scalar swing = detail::third_order_swing(problem, T);

  LinearErrors<Scalar> error;
  error.size = size;
  // what an error of the rates makes of the tilt: where it is one of the phase of nutation, that of the modes
  const detail::TiltModes<Scalar> modes(problem, start);
  const Scalar nutating = modes.tilted[2] + modes.tilted[3], once = std::min(T, 1 / std::sqrt(steep * flat));
  const detail::NutationPhase<Scalar> nutation(modes, size, T);
  Scalar g = size.tilt, P = size.rate, rate = rho.rate, angle = rho.angle, net = nutation.net, gross = nutation.gross;
  const Scalar grown = detail::grown_error(problem, start, zeta, T);
  const auto third_order = [&]() noexcept {
    error.shift = skew * zeta * rate;
    // what grows changes the spin rate late
    const Scalar late = modes.stable ? infinity<Scalar> : 2 * skew * zeta * angle;
    error.rates = P * std::min(error.shift * T, late) + skew * grown;
    error.of_rates = error.rates * answer;
    const Scalar wider = size.rate > 0 ? P / size.rate : Scalar(1);
    if (modes.stable)
      detail::lower(error.of_rates, error.shift * (T * nutating * wider + P * once * answer) +
                                        wider * wider * wider * detail::forced_nutation(modes, rho, skew * zeta, T));
    error.tilt = g * (gross + angle) + g * g * g / 2 + error.of_rates;
  };
  third_order();
  if (!(g + error.tilt <= Scalar(small_tilt))) {
    net = gross = g * P * T;
    swing = T;
    third_order();
  }
  // the motion itself may be larger than the linear one by its error
  g += error.tilt;
  P += error.rates;
  const Scalar more = size.rate > 0 ? P / size.rate : Scalar(1);
  rate *= more * more;
  angle *= more * more;
  net *= more * more, gross *= more * more;
  third_order();

  // of the phase of the turning frame; and int e^(i theta) (this error), also by parts
  const Scalar phase = angle + net + g * g / 2;
  using Integral = OverTime<Scalar>;
  Integral turned = Integral::roughly(std::min(T * phase, (phase + T * (rate + g * P / 2)) / r0) + g * g * T / 2, T);
  Integral cosine = Integral::roughly(g * g * T / 2, T);
  error.in_space = error.in_body = Integral::roughly(swing * error.tilt + T * g * g * g / 2, T);
  if (look == Look::close) {
    const detail::ThrustLeftOut<Scalar> thrust(start, modes, problem.spin(), T);
    const Scalar fourth = (phase + g * g) * (phase + g * g) * T / 2;
    turned.lower(more * more * thrust.turned +
                 Integral::roughly(std::min(T * angle, (angle + T * rate) / r0) + fourth, T));
    cosine.lower(more * more * thrust.cosine + Integral::roughly(fourth, T));
    const detail::TiltLeftOut<Scalar> tilt(problem, start, modes, rho, size, error.shift, g, T);
    error.in_space.lower(tilt.space);
    error.in_body.lower(tilt.body);
  }
  const Scalar f = magnitude(start.acceleration), f3 = std::abs(start.axial_acceleration);
  const Scalar M = magnitude(start.torque), e = std::abs(start.charge_momentum);
  error.spin = Scalar(1.25L) * rate;
  error.theta = Scalar(1.25L) * (net + angle) + g * g / 2 + g * g * gross;
  error.attitude = std::hypot(error.theta, error.tilt);
  error.momentum =
      M * turned.once + e * (error.tilt + g * phase + g * g * g) + Scalar(1.25L) * detail::momentum_left_out(problem);
  error.axial_momentum = M * error.in_body.once + e * g * error.tilt;
  const Integral across = f * turned + f3 * error.in_space, along = f3 * cosine + f * error.in_body;
  error.velocity = across.once;
  error.axial_velocity = along.once;
  error.position = across.twice;
  error.axial_position = along.twice;
  return error;
}

}  // namespace gyrostat::spinning
