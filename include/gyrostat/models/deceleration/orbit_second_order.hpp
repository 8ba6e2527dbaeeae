// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "gyrostat/models/deceleration/orbit_average.hpp"
#include "gyrostat/models/deceleration/periodic_integral.hpp"

/// Second-order averaging with rotor momentum (deceleration.md, section 4.3). With P the small torque, f = (dR/dt, d eta/dt)
/// under it and U the antiderivative of f - <f> along the free orbit (zero mean), the mean variables X = X_osc - U obey
///     dX/dt = <f> + f2,  f2 = -<P.grad U>,      d phase/dt = 1/T + <P.grad phase>.
/// The gradients are taken in the variables (R, eta, phase): four neighbouring orbits at equal phases do, instead of some
/// thirty orbits at displaced momenta. The torques carry the small parameter, so U is of first order and f2 of second.
namespace gyrostat::deceleration {

/// M at the phases j/n, n = 8 ... 512 a power of two.
template <Real Scalar, class Elliptic>
void orbit_nodes(const Orbit<Scalar, Elliptic>& orbit, int n, Vec3<Scalar>* M) noexcept {
  PhaseGrid<Scalar> grid(orbit.modulus());
  while (4 * (grid.size() - 1) < n && grid.refine()) {
  }
  const int q = grid.size() - 1, shift = orbit.quarter() * q;
  for (int j = 0; j < q; ++j) {
    const int e = grid.entry(j), r = grid.entry(q - j);
    const Scalar s = grid.sn[e], c = grid.cn[e], d = grid.dn[e];
    M[(j + 4 * q - shift) % n] = orbit.momentum(s, c, d);
    M[(j + 6 * q - shift) % n] = orbit.momentum(-s, -c, d);
    const Scalar s2 = grid.sn[r], c2 = grid.cn[r], d2 = grid.dn[r];  // u = K + j K/q
    M[(j + 5 * q - shift) % n] = orbit.momentum(s2, -c2, d2);
    M[(j + 7 * q - shift) % n] = orbit.momentum(-s2, c2, d2);
  }
}

/// Osculating minus mean on one orbit, as Fourier sums in the phase.
template <Real Scalar>
class OrbitOscillation {
 public:
  using Pair = PeriodicPair<Scalar>;

  OrbitOscillation() = default;
  OrbitOscillation(const Level<Scalar>& level, const Pair& slow, const Pair& phase) noexcept
      : level_(level), slow_(slow), phase_(phase) {}

  /// R, h and eta at a phase (turns).
  SlowRates<Scalar> slow(Scalar phase) const noexcept {
    const auto u = slow_.at(phase);
    return {u.first, level_.R * u.second + level_.eta * u.first, u.second};
  }

  /// The phase itself, turns.
  Scalar phase(Scalar phase) const noexcept { return phase_.at(phase).first; }

 private:
  Level<Scalar> level_;
  Pair slow_, phase_;
};

/// The mean equations on one level, and the size of what they leave out.
template <Real Scalar, class Elliptic = math::Native>
struct SecondOrder {
  SlowRates<Scalar> first;        ///< <f>
  SlowRates<Scalar> second;       ///< f2
  Scalar phase_rate = 0;          ///< d phase/dt, turns per second: 1/T + <P.grad phase>
  Scalar phase_drift = 0;         ///< its second part
  SlowRates<Scalar> oscillation;  ///< greatest |U|: what first order neglects at any one time
  SlowRates<Scalar>
      second_oscillation;  ///< greatest oscillation of second order: what second order neglects; zero where not wanted
  Scalar phase_oscillation = 0;       ///< greatest oscillation of the phase, turns
  Scalar along_R = 0, along_eta = 0;  ///< derivatives of the first <f> of R, 1/s and N m s/rad
  Orbit<Scalar, Elliptic> orbit;      ///< its phase is the one that phase_rate advances
  int nodes = 0;
};

namespace detail {

/// f and M on one orbit at equal phases.
template <Real Scalar>
struct OrbitSamples {
  static constexpr int capacity = PeriodicPair<Scalar>::capacity;
  Scalar period = 0;
  Vec3<Scalar> M[capacity];
  Scalar fR[capacity], feta[capacity];
  SlowRates<Scalar> mean;

  template <class Elliptic>
  void take(const Problem<Scalar>& problem, const Orbit<Scalar, Elliptic>& orbit, int n) noexcept {
    period = orbit.period();
    orbit_nodes(orbit, n, M);
    mean = {};
    for (int i = 0; i < n; ++i) {
      const auto f = slow_rates(problem, M[i], orbit.level().eta, small_torque(problem, M[i]));
      fR[i] = f.R;
      feta[i] = f.eta;
      mean.R += f.R / Scalar(n);
      mean.eta += f.eta / Scalar(n);
    }
  }
};

/// Steps {dR, d eta} of differences on an orbit: small against the way to the nearest equilibrium and separatrix.
/// @param mean of the momentum over the orbit
template <Real Scalar, class Elliptic>
Level<Scalar> difference_steps(const Problem<Scalar>& problem, const Orbit<Scalar, Elliptic>& orbit,
                               const Vec3<Scalar>& mean) noexcept {
  const Scalar R = orbit.level().R;
  const Scalar spread = std::max(Scalar(0), 1 - mean.squaredNorm() / (R * R));
  const Scalar room = std::min(spread, orbit.modulus().kp2);
  const Scalar share = std::sqrt(std::sqrt(epsilon<Scalar>)) / 8 * room;
  const auto& a = problem.inverse_inertia;
  return {share * R, share * (R * (a[2] - a[0]) + problem.gyro_rate().norm())};
}

/// Derivatives along R [0] and eta [1] at equal phases.
template <Real Scalar>
struct OrbitSlopes {
  static constexpr int capacity = OrbitSamples<Scalar>::capacity;
  Scalar T[2], mean_R[2], mean_eta[2];          ///< of the period and of <f>
  Scalar TfR[2][capacity], Tfeta[2][capacity];  ///< of T f
  Vec3<Scalar> rest[capacity];                  ///< P less what the changes of R and eta carry

  /// By differences of the orbits about `centre`, whose samples are `mid`. Errors as second_order.
  template <class Elliptic>
  Errc take(const Problem<Scalar>& problem, const Orbit<Scalar, Elliptic>& centre, const OrbitSamples<Scalar>& mid,
            const Level<Scalar>& steps, int n) noexcept {
    const Level<Scalar> here = centre.level();
    OrbitSamples<Scalar> up, down;
    for (int i = 0; i < n; ++i) rest[i] = small_torque(problem, mid.M[i]);
    for (int along = 0; along < 2; ++along) {
      const Scalar step = along == 0 ? steps.R : steps.eta;
      if (!(step > 0)) return Errc::no_convergence;
      Level<Scalar> plus = here, minus = here;
      (along == 0 ? plus.R : plus.eta) += step;
      (along == 0 ? minus.R : minus.eta) -= step;
      const Scalar per_width = 1 / (along == 0 ? plus.R - minus.R : plus.eta - minus.eta);
      const auto above = Orbit<Scalar, Elliptic>::at(problem, plus, centre.component());
      const auto below = Orbit<Scalar, Elliptic>::at(problem, minus, centre.component());
      if (!above) return above.error();
      if (!below) return below.error();
      if (above->regime() == Regime::point || below->regime() == Regime::point) return Errc::no_convergence;
      Scalar doubt_above = 0, doubt_below = 0;
      up.take(problem, above->aligned_to(centre, &doubt_above), n);
      down.take(problem, below->aligned_to(centre, &doubt_below), n);
      if (!(std::max(doubt_above, doubt_below) < Scalar(.01))) return Errc::no_convergence;
      T[along] = (up.period - down.period) * per_width;
      mean_R[along] = (up.mean.R - down.mean.R) * per_width;
      mean_eta[along] = (up.mean.eta - down.mean.eta) * per_width;
      const Scalar* f = along == 0 ? mid.fR : mid.feta;
      for (int i = 0; i < n; ++i) {
        TfR[along][i] = (up.period * up.fR[i] - down.period * down.fR[i]) * per_width;
        Tfeta[along][i] = (up.period * up.feta[i] - down.period * down.feta[i]) * per_width;
        rest[i] -= (up.M[i] - down.M[i]) * (f[i] * per_width);
      }
    }
    return Errc::ok;
  }
};

/// The second-order terms on one orbit, from its samples and slopes: all as numbers at the nodes.
template <Real Scalar>
struct SecondOrderTerms {
  using Samples = OrbitSamples<Scalar>;
  using Pair = PeriodicPair<Scalar>;
  static constexpr int capacity = Samples::capacity;

  const Samples& mid;
  const OrbitSlopes<Scalar>& slopes;
  const typename Pair::Roots& roots;
  int n;
  Pair u;                               ///< antiderivative of f in the phase: U = T u
  Scalar uR[capacity], ueta[capacity];  ///< its values
  Scalar phase[capacity];               ///< the rate of the phase under P, 1/s

  SecondOrderTerms(const Problem<Scalar>& problem, const Samples& samples, const OrbitSlopes<Scalar>& derivatives,
                   const typename Pair::Roots& unit_roots, int nodes) noexcept
      : mid(samples), slopes(derivatives), roots(unit_roots), n(nodes), u(Pair(roots, mid.fR, mid.feta).integral()) {
    u.sample(roots, uR, ueta);
    for (int i = 0; i < n; ++i) {
      const Vec3<Scalar> flow = mid.M[i].cross(problem.angular_velocity(mid.M[i]));  // per second; T times it per turn
      phase[i] = slopes.rest[i].dot(flow) / (mid.period * flow.squaredNorm());
    }
  }

  Scalar phase_drift() const noexcept {
    Scalar drift = 0;
    for (int i = 0; i < n; ++i) drift += phase[i] / Scalar(n);
    return drift;
  }

  /// f2 of R and eta, with the antiderivatives shifted by parts.
  SlowRates<Scalar> rates(const Level<Scalar>& level) const noexcept {
    const Scalar T = mid.period;
    Scalar R = 0, eta = 0;
    for (int i = 0; i < n; ++i) {
      R += uR[i] * slopes.TfR[0][i] + ueta[i] * slopes.TfR[1][i] - T * phase[i] * (mid.fR[i] - mid.mean.R);
      eta += uR[i] * slopes.Tfeta[0][i] + ueta[i] * slopes.Tfeta[1][i] - T * phase[i] * (mid.feta[i] - mid.mean.eta);
    }
    R /= Scalar(n);
    eta /= Scalar(n);
    return {R, level.R * eta + level.eta * R, eta};
  }

  /// What is left to oscillate in R and eta, of second order.
  void oscillation(Scalar* R, Scalar* eta) const noexcept {
    const Scalar T = mid.period;
    Scalar sR[capacity], seta[capacity];
    for (int i = 0; i < n; ++i) {
      const Scalar UR = T * uR[i], Ueta = T * ueta[i];
      sR[i] = T * (UR * slopes.mean_R[0] + Ueta * slopes.mean_R[1] - T * phase[i] * (mid.fR[i] - mid.mean.R));
      seta[i] = T * (UR * slopes.mean_eta[0] + Ueta * slopes.mean_eta[1] - T * phase[i] * (mid.feta[i] - mid.mean.eta));
    }
    for (int along = 0; along < 2; ++along) {
      Scalar wR[capacity], weta[capacity];
      Pair(roots, slopes.TfR[along], slopes.Tfeta[along]).integral().sample(roots, wR, weta);
      const Scalar* f = along == 0 ? mid.fR : mid.feta;
      for (int i = 0; i < n; ++i) {
        sR[i] -= T * f[i] * wR[i];
        seta[i] -= T * f[i] * weta[i];
      }
    }
    Pair(roots, sR, seta).integral().sample(roots, R, eta);
  }

  /// And in the phase, of first order.
  Pair phase_oscillation() const noexcept {
    const Scalar T = mid.period;
    Scalar s[capacity], none[capacity] = {};
    for (int i = 0; i < n; ++i) {
      const Scalar UR = T * uR[i], Ueta = T * ueta[i];
      s[i] = T * (phase[i] - (UR * slopes.T[0] + Ueta * slopes.T[1]) / (T * T));
    }
    return Pair(roots, s, none).integral();
  }
};

/// Greatest R, h and eta of n values of R and eta, times `scale`.
template <Real Scalar>
SlowRates<Scalar> greatest_rates(const Level<Scalar>& level, int n, const Scalar* R, const Scalar* eta,
                                 Scalar scale) noexcept {
  SlowRates<Scalar> m;
  for (int i = 0; i < n; ++i) {
    const Scalar x = R[i] * scale, y = eta[i] * scale;
    m.R = std::max(m.R, std::abs(x));
    m.h = std::max(m.h, std::abs(level.R * y + level.eta * x));
    m.eta = std::max(m.eta, std::abs(y));
  }
  return m;
}

}  // namespace detail

/// Where half the points that the averages need are as accurate as this, they do for terms of second order: those need far fewer digits.
inline constexpr double sound_half = 1e-6;

/// The second-order mean equations on a level.
/// @param followed see Orbit::at; @param reference an orbit just before on the path, so that the origin of phase does not
/// jump (Orbit::aligned_to), or null; @param oscillation when not null: receives the oscillation of first order.
/// @param sized whether the oscillation of second order is wanted
/// Errors: those of the orbit; not_applicable on an equilibrium; no_convergence where 256 points do not resolve the orbit
/// or the frames of the neighbours do not agree (an exchange of axes, or a separatrix, within the differences).
template <class Elliptic = math::Native, Real Scalar>
Result<SecondOrder<Scalar, Elliptic>> second_order(
    const Problem<Scalar>& problem, const Level<Scalar>& level, Component followed,
    const Orbit<Scalar, Elliptic>* reference = nullptr,
    std::type_identity_t<OrbitOscillation<Scalar>>* oscillation = nullptr, bool sized = true) noexcept {
  using Samples = detail::OrbitSamples<Scalar>;
  using Pair = PeriodicPair<Scalar>;
  auto found = Orbit<Scalar, Elliptic>::at(problem, level, followed);
  if (!found) return found.error();
  if (found->regime() == Regime::point) return Errc::not_applicable;
  const Orbit<Scalar, Elliptic> centre = reference ? found->aligned_to(*reference) : *found;
  const auto average = deceleration::average(problem, centre);
  if (!average) return average.error();
  const int n = average->half_error < sound_half ? average->nodes / 2 : average->nodes;
  if (n > Samples::capacity) return Errc::no_convergence;

  Samples mid;
  mid.take(problem, centre, n);
  detail::OrbitSlopes<Scalar> slopes;
  const Level<Scalar> steps = detail::difference_steps(problem, centre, average->momentum);
  if (const Errc wrong = slopes.take(problem, centre, mid, steps, n); wrong != Errc::ok) return wrong;
  const typename Pair::Roots roots(n);
  const detail::SecondOrderTerms<Scalar> terms(problem, mid, slopes, roots, n);

  const Level<Scalar> here = centre.level();
  const Scalar T = mid.period;
  SecondOrder<Scalar, Elliptic> r;
  r.first = average->rates;
  r.second = terms.rates(here);
  r.along_R = slopes.mean_R[0], r.along_eta = slopes.mean_R[1];
  r.phase_drift = terms.phase_drift();
  r.phase_rate = 1 / T + r.phase_drift;
  r.orbit = centre;
  r.nodes = n;
  if (!std::isfinite(r.second.R) || !std::isfinite(r.second.eta) || !std::isfinite(r.phase_drift))
    return Errc::no_convergence;

  Scalar x[Samples::capacity], y[Samples::capacity];
  r.oscillation = detail::greatest_rates(here, n, terms.uR, terms.ueta, T);
  if (sized) {
    terms.oscillation(x, y);
    r.second_oscillation = detail::greatest_rates(here, n, x, y, Scalar(1));
  }
  const Pair phase = terms.phase_oscillation();
  phase.sample(roots, x, y);
  for (int i = 0; i < n; ++i) r.phase_oscillation = std::max(r.phase_oscillation, std::abs(x[i]));
  if (oscillation) *oscillation = {here, terms.u.times(T), phase};
  return r;
}

/// A state of the mean equations.
template <Real Scalar>
struct MeanLevel {
  Level<Scalar> level;
  Scalar phase = 0;  ///< turns
  Component component;
};

/// The mean state of a momentum M. Errors as second_order; an equilibrium is its own mean.
/// @param orbit when not null: receives the orbit through M, whose origin of phase the state uses
template <class Elliptic = math::Native, Real Scalar>
Result<MeanLevel<Scalar>> mean_of(const Problem<Scalar>& problem, const Vec3<Scalar>& M,
                                  Orbit<Scalar, Elliptic>* orbit = nullptr) noexcept {
  const auto through = Orbit<Scalar, Elliptic>::through(problem, M);
  if (!through) return through.error();
  if (orbit) *orbit = *through;
  MeanLevel<Scalar> mean{through->level(), through->phase_of(M), through->component()};
  if (through->regime() == Regime::point) return mean;
  OrbitOscillation<Scalar> u;
  const auto order = second_order<Elliptic>(problem, mean.level, mean.component, &*through, &u, false);
  if (!order) return order.error();
  const auto slow = u.slow(mean.phase);
  mean.level.R -= slow.R;
  mean.level.eta -= slow.eta;
  mean.phase -= u.phase(mean.phase);
  return mean;
}

/// The osculating momentum M of a mean state. Errors as second_order.
/// @param reference an orbit that fixes the origin of the state's phase (Orbit::aligned_to), or null
template <class Elliptic = math::Native, Real Scalar>
Result<Vec3<Scalar>> osculating_of(const Problem<Scalar>& problem, const MeanLevel<Scalar>& mean,
                                   const Orbit<Scalar, Elliptic>* reference = nullptr) noexcept {
  const auto found = Orbit<Scalar, Elliptic>::at(problem, mean.level, mean.component);
  if (!found) return found.error();
  if (found->regime() == Regime::point) return found->momentum_at(Scalar(0));
  OrbitOscillation<Scalar> u;
  const auto order = second_order<Elliptic>(problem, mean.level, mean.component, reference, &u, false);
  if (!order) return order.error();
  const auto slow = u.slow(mean.phase);
  const Level<Scalar> level{mean.level.R + slow.R, mean.level.eta + slow.eta};
  const auto osculating = Orbit<Scalar, Elliptic>::at(problem, level, order->orbit.component());
  if (!osculating) return osculating.error();
  return osculating->aligned_to(order->orbit).momentum_at(mean.phase + u.phase(mean.phase));
}

}  // namespace gyrostat::deceleration
