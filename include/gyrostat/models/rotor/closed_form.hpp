// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/models/rotor/modes.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

/// The families of motions that are known in closed form (docs/rotor.md, section 5).
enum class ClosedFormKind : std::uint8_t {
  none,
  no_momentum,      ///< L = 0
  axisymmetric,     ///< theta has e for an axis of symmetry, or is spherical
  principal_axis,   ///< e is a principal axis and H lies along it
  steady,           ///< steady rotation; with S = 0 at any rotor rate
  circular_section  ///< H runs round the circle H.n = 0, n normal to a circular section of x.J x = 1
};

/// Bounds of what a closed form errs, in units of the state.
template <Real Scalar>
struct ClosedFormError {
  Scalar attitude = 0;     ///< angle, rad
  Scalar momentum = 0;     ///< of H, N m s
  Scalar rotor_rate = 0;   ///< rad/s
  Scalar rotor_angle = 0;  ///< rad
};

/// The motion of a gyrostat where it is known in closed form. In all families n.H is constant, so that the rotor obeys its motor
/// alone, omega = omega* + (omega0 - omega*) exp(-St t), and the attitude is a product of two turns about fixed axes,
///     P(t) = exp(a t [L/l]x) P0 exp(psi(t) [c]x),   H(t) = exp(-psi [c]x) H0.
/// Body and start may lie a little off the family; error() says what that and rounding cost.
template <Real Scalar>
class ClosedForm {
 public:
  /// Greatest defect for which a family is used.
  static constexpr Scalar greatest_defect = std::max(Scalar(1e-6), 256 * epsilon<Scalar>);

  /// Finds the family: the first that holds to rounding, or else the nearest.
  ClosedForm(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept;

  /// none: no family lies within greatest_defect. Then nothing else here has a meaning but defect().
  ClosedFormKind kind() const noexcept { return kind_; }
  /// How far body and start lie off the family, relative to inertia, momentum and rate; infinite where the start is not finite.
  Scalar defect() const noexcept { return defect_; }
  /// Body and start lie in the family exactly, by zeros of the data: not even an instability leads out of it.
  bool exact() const noexcept { return exact_; }

  State<Scalar> at(Scalar t) const noexcept;
  /// Bounds for all times up to t >= 0: first order in the defect, with the growth of it that the motion's own linear equations
  /// have, twice; and rounding, of the data too. Infinite where first order does not suffice.
  ClosedFormError<Scalar> error(Scalar t) const noexcept;

 private:
  struct Phase {
    Scalar cosine, sine;  // of half the angle psi, any common factor
  };

  Scalar rate(Scalar t) const noexcept;
  Scalar angle(Scalar t) const noexcept;
  Phase phase(Scalar t) const noexcept;
  Scalar circle_rate(Scalar t) const noexcept;

  bool offer(ClosedFormKind kind, Scalar defect) noexcept;
  void offer_rotor_axis() noexcept;
  void offer_steady(const Vec3<Scalar>& Omega, Scalar momenta, Scalar excess) noexcept;
  void offer_circular_section(const Vec3<Scalar>& n, Scalar excess) noexcept;

  struct Sizes {
    Scalar j;          // greatest of J
    Scalar lambda, k;  // inertia of the rotor, coupling
    Scalar l, e_n, h;  // |H|, |J e|, greatest lambda omega
    Scalar fast;       // pace of the motion
    Scalar data;       // of H, as the start is known
  };
  /// Sizes of the terms that H and p are sums of, which may cancel, N m s.
  struct Parts {
    Scalar momentum, axial;
  };
  Parts parts() const noexcept;
  Sizes sizes() const noexcept;
  /// By how far the motion departs from the kind's formulas by t, to first order in the defect.
  ClosedFormError<Scalar> departure(Scalar t) const noexcept;
  ClosedFormError<Scalar> from_axisymmetric(Scalar t, const Sizes& x) const noexcept;
  ClosedFormError<Scalar> from_principal_axis(Scalar t, const Sizes& x) const noexcept;
  ClosedFormError<Scalar> from_steady(Scalar t, const Sizes& x) const noexcept;
  ClosedFormError<Scalar> from_circular_section(Scalar t, const Sizes& x) const noexcept;

  Gyrostat<Scalar> gyrostat_;
  State<Scalar> start_;
  ClosedFormKind kind_ = ClosedFormKind::none;
  bool exact_ = false;
  Scalar defect_ = infinity<Scalar>;
  Scalar norm_;               // l
  Scalar rate_, final_rate_;  // omega at 0 and for ever
  Scalar decay_;              // St
  Vec3<Scalar> axis_I_{0, 0, 1}, axis_B_{0, 0, 1};
  Scalar turn_ = 0;         // a
  Scalar steady_turn_ = 0;  // dpsi/dt without the rotor
  Scalar rotor_turn_ = 0;   // dpsi by the rotor angle
  // circular section: dphi/dt = drive - hill sin(phi)
  Scalar drive_ = 0, hill_ = 0, hill_cosine_ = 0, first_rate_ = 0;
  // what the departure needs
  Scalar off_ = 0, oblateness_ = 0, across_ = 0, excess_ = 0;  // relative
  Scalar along_ = 0;                                           // H along c
  Scalar j_axis_ = 0, j_1_ = 0, j_2_ = 0;                      // J along c and across
};

namespace detail {

/// z + exp(-z) - 1 over z, z >= 0: what a relaxing quantity lags behind, without cancellation.
template <Real Scalar>
Scalar relaxed_share(Scalar z) noexcept {
  if (z > 1) return 1 + std::expm1(-z) / z;
  Scalar sum = 0;
  for (int k = 22; k >= 2; --k) sum = (1 - sum) * z / Scalar(k);
  return sum;
}

/// J seen along a unit axis: along it, off it, and across.
template <Real Scalar>
struct AxisView {
  Scalar along, off, first, second;

  AxisView(const Mat3<Scalar>& J, const Vec3<Scalar>& c) noexcept {
    int least = 0;
    c.cwiseAbs().minCoeff(&least);
    const Vec3<Scalar> u = cross<Scalar>(Vec3<Scalar>::Unit(least), c).normalized();
    const Vec3<Scalar> v = cross<Scalar>(c, u);
    const Vec3<Scalar> Jc = J * c, Ju = J * u;
    along = c.dot(Jc);
    off = std::hypot(u.dot(Jc), v.dot(Jc));
    const Scalar uu = u.dot(Ju), vv = v.dot(J * v);
    const Scalar half = std::hypot((uu - vv) / 2, v.dot(Ju));
    first = (uu + vv) / 2 - half;
    second = (uu + vv) / 2 + half;
  }
  Scalar oblateness() const noexcept { return second - first; }
};

}  // namespace detail

template <Real Scalar>
ClosedForm<Scalar>::ClosedForm(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept
    : gyrostat_(gyrostat), start_(start) {
  const Vec3<Scalar>& H = start.momentum;
  const Scalar lambda = gyrostat.axial_inertia();
  const Vec3<Scalar> n = gyrostat.inverse_inertia() * gyrostat.axis();
  const Vec3<Scalar> Omega = gyrostat.angular_velocity(H, start.axial_momentum);
  norm_ = H.norm();
  rate_ = gyrostat.rotor_rate(start.axial_momentum, Omega);
  final_rate_ = gyrostat.slope() > 0 ? gyrostat.no_load_rate() : rate_;
  decay_ = gyrostat.relaxation_rate();
  if (!std::isfinite(norm_) || !std::isfinite(rate_)) return;
  if (norm_ == 0) {
    offer(ClosedFormKind::no_momentum, 0);
    axis_B_ = n.normalized();
    rotor_turn_ = -lambda * n.norm();
    return;
  }
  axis_I_ = rotate(start.attitude, H).normalized();
  const Scalar momenta = norm_ + lambda * std::max(std::abs(rate_), std::abs(final_rate_));
  const Scalar excess = momenta > 0 ? lambda * std::abs(rate_ - final_rate_) / momenta : Scalar(0);
  offer_rotor_axis();
  offer_steady(Omega, momenta, excess);
  offer_circular_section(n, excess);
}

/// Whether a kind with this defect is taken: the first within greatest_defect or, until one holds to rounding, one with a lesser defect.
template <Real Scalar>
bool ClosedForm<Scalar>::offer(ClosedFormKind kind, Scalar defect) noexcept {
  const Scalar rounding = 64 * epsilon<Scalar>;
  const bool better =
      kind_ == ClosedFormKind::none ? defect <= greatest_defect : defect_ > rounding && defect < defect_;
  if (defect < defect_) defect_ = defect;
  if (better) kind_ = kind;
  return better;
}

/// The kinds about the rotor's axis: axisymmetric and principal_axis.
template <Real Scalar>
void ClosedForm<Scalar>::offer_rotor_axis() noexcept {
  const Vec3<Scalar>&H = start_.momentum, &e = gyrostat_.axis();
  const Scalar j_most = 1 / gyrostat_.principal()[0];
  const detail::AxisView<Scalar> rotor(gyrostat_.inverse_inertia(), e);
  const Vec3<Scalar> H_across = H - H.dot(e) * e;
  const auto zero = [](Scalar x) { return x == 0; };
  const Scalar blur = std::count_if(e.begin(), e.end(), zero) == 2 ? Scalar(0) : epsilon<Scalar>;  // of an oblique axis
  const auto take = [&] {
    axis_B_ = e;
    off_ = rotor.off / j_most + blur;
    oblateness_ = rotor.oblateness() / j_most;
    across_ = H_across.norm() / norm_;
    along_ = H.dot(e);
    j_axis_ = rotor.along;
    j_1_ = rotor.first;
    j_2_ = rotor.second;
    rotor_turn_ = -gyrostat_.axial_inertia() * j_axis_;
  };
  if (offer(ClosedFormKind::axisymmetric, (rotor.off + rotor.oblateness()) / j_most)) {
    take();
    const Scalar j_across = (rotor.first + rotor.second) / 2;
    turn_ = norm_ * j_across;
    steady_turn_ = along_ * (j_axis_ - j_across);
  }
  if (offer(ClosedFormKind::principal_axis, rotor.off / j_most + H_across.norm() / norm_)) {
    take();
    turn_ = 0;
    steady_turn_ = along_ * j_axis_;
    int zeros = 0;
    for (int i = 0; i < 3; ++i) zeros += e[i] == 0 && H[i] == 0;
    exact_ = zeros == 2 && across_ == 0 && off_ == 0;
  }
}

/// @param momenta |H| and the greatest of the rotor   @param excess of the rotor's momentum over the final one, relative to them
template <Real Scalar>
void ClosedForm<Scalar>::offer_steady(const Vec3<Scalar>& Omega, Scalar momenta, Scalar excess) noexcept {
  const Vec3<Scalar>& H = start_.momentum;
  const Scalar j_most = 1 / gyrostat_.principal()[0];
  const Scalar off = cross<Scalar>(H, Omega).norm() / (norm_ * j_most * momenta);
  if (!offer(ClosedFormKind::steady, off + excess)) return;
  turn_ = Omega.dot(H) / norm_;
  steady_turn_ = rotor_turn_ = 0;
  off_ = off;
  excess_ = excess;
  exact_ = false;
}

/// @param n J e   @param excess see offer_steady
template <Real Scalar>
void ClosedForm<Scalar>::offer_circular_section(const Vec3<Scalar>& n, Scalar excess) noexcept {
  const Vec3<Scalar>& H = start_.momentum;
  const Mat3<Scalar>& J = gyrostat_.inverse_inertia();
  const Scalar j_most = 1 / gyrostat_.principal()[0];
  const Vec3<Scalar> c = n.normalized();
  const detail::AxisView<Scalar> section(J, c);
  if (!offer(ClosedFormKind::circular_section, section.oblateness() / j_most + std::abs(H.dot(c)) / norm_ + excess))
    return;
  axis_B_ = c;
  turn_ = norm_ * (section.first + section.second) / 2;
  steady_turn_ = rotor_turn_ = 0;
  const Vec3<Scalar> m = (H - H.dot(c) * c).normalized();
  // along the circle m turns at n.(h n - J H)/|n|, and its second derivative has the cosine
  drive_ = gyrostat_.axial_inertia() * final_rate_ * n.norm();
  const Vec3<Scalar> across = cross<Scalar>(c, m);
  const Scalar hill_sine = norm_ * c.dot(J * m);
  hill_cosine_ = norm_ * c.dot(J * across);
  hill_ = std::hypot(hill_sine, hill_cosine_);
  first_rate_ = drive_ - hill_sine;
  oblateness_ = section.oblateness() / j_most;
  across_ = std::abs(H.dot(c)) / norm_;
  excess_ = excess;
  exact_ = false;
}

template <Real Scalar>
Scalar ClosedForm<Scalar>::rate(Scalar t) const noexcept {
  const Scalar done = -std::expm1(-decay_ * t);
  return done < Scalar(0.5) ? rate_ + (final_rate_ - rate_) * done
                            : final_rate_ + (rate_ - final_rate_) * std::exp(-decay_ * t);
}

template <Real Scalar>
Scalar ClosedForm<Scalar>::angle(Scalar t) const noexcept {
  const Scalar share = detail::relaxed_share(decay_ * t);  // of the time at the final rate
  return t * (share < Scalar(0.5) ? rate_ + (final_rate_ - rate_) * share
                                  : final_rate_ + (rate_ - final_rate_) * (1 - share));
}

/// The circle's angle phi: (cos phi/2, sin phi/2) obeys a linear equation but for its length, in all three cases of drive and hill.
template <Real Scalar>
auto ClosedForm<Scalar>::phase(Scalar t) const noexcept -> Phase {
  if (kind_ != ClosedFormKind::circular_section) {
    const Scalar half = (steady_turn_ * t + rotor_turn_ * angle(t)) / 2;
    return {std::cos(half), std::sin(half)};
  }
  const Scalar square = (std::abs(drive_) - hill_) * (std::abs(drive_) + hill_);
  const Scalar nu = std::sqrt(std::abs(square));
  const Scalar z = nu * t / 2;
  const Scalar c = square >= 0 ? std::cos(z) : Scalar(1);
  const Scalar s = z == 0 ? t / 2 : (square >= 0 ? std::sin(z) : std::tanh(z)) / nu;
  return {c + s * hill_cosine_, -s * first_rate_};
}

/// dphi/dt at t.
template <Real Scalar>
Scalar ClosedForm<Scalar>::circle_rate(Scalar t) const noexcept {
  const Scalar hill_sine = drive_ - first_rate_;
  const Phase half = phase(t);
  const Scalar size = half.cosine * half.cosine + half.sine * half.sine;
  const Scalar c = (half.cosine * half.cosine - half.sine * half.sine) / size, s = -2 * half.cosine * half.sine / size;
  return drive_ - (hill_sine * c + hill_cosine_ * s);
}

template <Real Scalar>
State<Scalar> ClosedForm<Scalar>::at(Scalar t) const noexcept {
  State<Scalar> state = start_;
  const Phase half = phase(t);
  const Scalar size = std::hypot(half.cosine, half.sine);
  const Scalar c = half.cosine / size, s = half.sine / size;
  const Quat<Scalar> turn_B{c, s * axis_B_[0], s * axis_B_[1], s * axis_B_[2]};
  const Scalar w = std::cos(turn_ * t / 2), around = std::sin(turn_ * t / 2);
  const Quat<Scalar> turn_I{w, around * axis_I_[0], around * axis_I_[1], around * axis_I_[2]};
  state.attitude = normalised(turn_I * start_.attitude * turn_B);
  state.momentum = rotate(conjugate(turn_B), start_.momentum);
  // p = lambda (k omega + n.H), n.H constant
  state.axial_momentum = start_.axial_momentum + gyrostat_.axial_inertia() * gyrostat_.coupling() * (rate(t) - rate_);
  state.rotor_angle = start_.rotor_angle + angle(t);
  return state;
}

template <Real Scalar>
auto ClosedForm<Scalar>::parts() const noexcept -> Parts {
  const Vec3<Scalar> Omega = gyrostat_.angular_velocity(start_.momentum, start_.axial_momentum);
  const Scalar lambda = gyrostat_.axial_inertia();
  return {std::max(norm_, (gyrostat_.inertia() * Omega).norm() + lambda * std::abs(rate_)),
          lambda * (std::abs(rate_) + std::abs(gyrostat_.axis().dot(Omega)))};
}

template <Real Scalar>
auto ClosedForm<Scalar>::sizes() const noexcept -> Sizes {
  const Scalar j = 1 / gyrostat_.principal()[0];
  const Scalar lambda = gyrostat_.axial_inertia(), k = gyrostat_.coupling();
  const Scalar l = norm_, e_n = (gyrostat_.inverse_inertia() * gyrostat_.axis()).norm();
  const Scalar h = lambda * std::max(std::abs(rate_), std::abs(final_rate_));
  const Scalar blur = gyrostat_.momentum_blur(gyrostat_.angular_velocity(start_.momentum, start_.axial_momentum));
  const Scalar whole = std::max(l + 2 * h, parts().momentum + h);
  return {j, lambda, k, l, e_n, h, j * (l + h), 4 * epsilon<Scalar> * (whole + blur)};
}

template <Real Scalar>
ClosedFormError<Scalar> ClosedForm<Scalar>::departure(Scalar t) const noexcept {
  const Sizes x = sizes();
  switch (kind_) {
    case ClosedFormKind::none: break;
    case ClosedFormKind::no_momentum: return {.attitude = x.j * x.data * t};
    case ClosedFormKind::axisymmetric: return from_axisymmetric(t, x);
    case ClosedFormKind::principal_axis: return from_principal_axis(t, x);
    case ClosedFormKind::steady: return from_steady(t, x);
    case ClosedFormKind::circular_section: return from_circular_section(t, x);
  }
  return {};
}

template <Real Scalar>
ClosedFormError<Scalar> ClosedForm<Scalar>::from_axisymmetric(Scalar t, const Sizes& x) const noexcept {
  // H turns about e in the body with a rate that changes monotonically: what the defect moves it by averages out
  const Scalar j_across = (j_1_ + j_2_) / 2;
  const Scalar nu_0 = (j_axis_ - j_across) * along_ - x.lambda * j_axis_ * rate_;
  const Scalar nu_t = (j_axis_ - j_across) * along_ - x.lambda * j_axis_ * rate(t);
  const Scalar nu = nu_0 * nu_t > 0 ? std::min(std::abs(nu_0), std::abs(nu_t)) : Scalar(0);
  // an unevenness of the section acts with the second harmonic of H's turn, an axis that is off with the first; neither drifts to first order
  const Scalar once = std::min(t, 2 / nu), pushed = x.fast * once, defect = off_ + oblateness_;
  const Scalar lean = std::min(across_ + off_ * pushed, Scalar(1));  // of H from e
  const Scalar tilt = x.l * lean * (oblateness_ * lean / 2 + off_) * pushed + x.data;
  ClosedFormError<Scalar> error;
  error.rotor_rate = 2 * x.e_n / x.k * tilt;
  const Scalar swing = defect * pushed;
  const Scalar drift = t * (std::abs(j_axis_ - j_across) * tilt + x.lambda * j_axis_ * error.rotor_rate +
                            x.fast * swing * (defect + swing) + x.j * x.data);
  error.attitude = 2 * swing + drift;
  error.momentum = x.l * (swing + lean * drift) + 2 * tilt;
  error.rotor_angle = t * error.rotor_rate;
  return error;
}

template <Real Scalar>
ClosedFormError<Scalar> ClosedForm<Scalar>::from_principal_axis(Scalar t, const Sizes& x) const noexcept {
  if (exact_) return {};
  // H across: h1' = -A2 h2, h2' = A1 h1, A_i = H.e J_i - Omega.e
  const auto stiffness = [&](Scalar ji, Scalar omega) { return along_ * ji - j_axis_ * (along_ - x.lambda * omega); };
  const Scalar omega_t = rate(t);
  const Scalar a1 = stiffness(j_1_, rate_), a2 = stiffness(j_2_, rate_);
  const Scalar b1 = stiffness(j_1_, omega_t), b2 = stiffness(j_2_, omega_t);
  Scalar gain = std::exp(x.l * (j_2_ - j_1_) / 2 * t), time = t;
  if (a1 * a2 > 0 && b1 * b2 > 0 && a1 * b1 > 0) {
    const auto spread = [](Scalar a, Scalar b) { return std::max(a / b, b / a); };
    const Scalar most = std::max({std::abs(a1), std::abs(a2), std::abs(b1), std::abs(b2)});
    const Scalar least = std::min({std::abs(a1), std::abs(a2), std::abs(b1), std::abs(b2)});
    const Scalar bounded = std::sqrt(most / least * std::max(spread(a1, b1), spread(a2, b2)));
    if (bounded < gain) {
      gain = bounded;
      time = std::min(t, 8 / least);
    }
  }
  const Scalar off = off_ + 4 * epsilon<Scalar>;
  const Scalar across = gain * (across_ * x.l + x.data + 2 * off * x.l * x.fast * time);
  ClosedFormError<Scalar> error;
  error.momentum = across;
  error.rotor_rate = x.j / x.k * (2 * off * across + across * across / x.l);
  error.attitude = 2 * across / x.l + t * (x.data * x.j + 2 * x.j * off * across + x.j * across * across / x.l +
                                           x.lambda * j_axis_ * error.rotor_rate);
  error.rotor_angle = t * error.rotor_rate;
  return error;
}

template <Real Scalar>
ClosedFormError<Scalar> ClosedForm<Scalar>::from_steady(Scalar t, const Sizes& x) const noexcept {
  const Linearisation<Scalar> linear(gyrostat_, x.l, start_.momentum / x.l, final_rate_);
  const Modes<Scalar> modes(linear.matrix, linear.exponents());
  // dy/dt = A y + off + relaxing exp(-St t) from y = 0, y what the tangential momentum and xi - xi_0 exp(-St t) depart by
  const Vec3<Scalar> Omega =
      gyrostat_.inverse_inertia() * Vec3<Scalar>(start_.momentum - x.lambda * final_rate_ * gyrostat_.axis());
  const Scalar xi = (rate_ - final_rate_) / linear.unit, decay = linear.relaxation;
  const Vec3<Scalar> off(-Omega.dot(linear.v), Omega.dot(linear.u), 0);
  const Vec3<Scalar> relaxing = xi * Vec3<Scalar>(linear.v.dot(linear.g), -linear.u.dot(linear.g), 0);
  const Scalar blur = 4 * epsilon<Scalar> * (x.fast + decay / linear.unit * (x.l + x.h) / x.lambda);
  // of y: the turn about L, and the rate of the rotor
  const Vec3<Scalar> Gm = linear.G * linear.m;
  const Vec3<Scalar> of_turn(Gm.dot(linear.u), Gm.dot(linear.v), -linear.g.dot(linear.m));
  const Vec3<Scalar> of_rate(-linear.rate_of_tilt * linear.n.dot(linear.u),
                             -linear.rate_of_tilt * linear.n.dot(linear.v), linear.unit);
  struct Moved {
    Scalar tilt = 0, any = 0, rate = 0, turn = 0;
  } moved;
  // by a push that is known, and one of which only the size is, and how far off the start is
  const auto move = [&](bool known, Scalar push, Scalar start) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      const math::Complex<Scalar> d = modes.exponent[i];
      const Scalar growth = std::exp(std::max(Scalar(0), d.re * t)), swing = std::min(t, 2 / math::magnitude(d));
      Scalar by = detail::complex_length<Scalar>(modes.left[i]) * (push * swing + start);
      if (known)
        by += math::magnitude(detail::complex_dot<Scalar>(off, modes.left[i])) * swing +
              math::magnitude(detail::complex_dot<Scalar>(relaxing, modes.left[i])) *
                  std::min(t, 2 / math::magnitude(d + math::Complex<Scalar>{decay}));
      by *= growth;
      const auto& right = modes.right[i];
      moved.tilt += by * std::hypot(math::magnitude(right[0]), math::magnitude(right[1]));
      moved.any += by;
      moved.rate += by * math::magnitude(detail::complex_dot<Scalar>(of_rate, right));
      moved.turn += by * math::magnitude(detail::complex_dot<Scalar>(of_turn, right));
    }
  };
  move(true, blur, x.data / x.l);
  const Scalar square = moved.any * moved.any;
  // what the linear equations leave out: of second order in y, and its products with what pushes
  move(false, (x.fast + linear.feed * x.e_n) * square + (std::abs(xi) * linear.g.norm() + off.norm()) * moved.any, 0);
  ClosedFormError<Scalar> error;
  error.momentum = x.l * moved.tilt;
  error.rotor_rate = moved.rate + linear.rate_of_tilt * std::abs(linear.n.dot(linear.m)) * moved.tilt * moved.tilt / 2;
  const Scalar relaxed = std::abs(linear.g.dot(linear.m) * xi) * -std::expm1(-decay * t);
  error.attitude = moved.tilt + t * (moved.turn + relaxed + x.fast * square + x.data * x.j);
  error.rotor_angle = t * error.rotor_rate;
  return error;
}

template <Real Scalar>
ClosedFormError<Scalar> ClosedForm<Scalar>::from_circular_section(Scalar t, const Sizes& x) const noexcept {
  // off the circle grows like 1/(dphi/dt), what falls behind along it like dphi/dt; an uneven section pushes off it with the
  // second harmonic of phi
  const Scalar fastest = std::abs(drive_) + hill_, gap = std::abs(drive_) - hill_;
  const Scalar slowest = std::max({std::min(std::abs(first_rate_), std::abs(circle_rate(t))), gap, Scalar(0)});
  const Scalar gain = fastest / slowest;
  const Scalar uneven = oblateness_ + 4 * epsilon<Scalar>;
  const Scalar off = gain * (across_ + x.data / x.l + x.l * x.j * uneven * std::min(t, 2 / fastest));
  const Scalar excess = excess_ * (x.l + x.h) / x.lambda + 2 * x.l * x.e_n / x.k * off;
  const Scalar behind =
      gain * t *
      (x.l * x.j * (2 * off + uneven) + x.lambda * x.e_n * excess + x.data * x.j + 4 * epsilon<Scalar> * fastest);
  ClosedFormError<Scalar> error;
  error.rotor_rate = excess;
  error.momentum = x.l * (behind + off);
  error.attitude = behind + off + t * (2 * fastest * off + x.l * x.j * uneven + x.data * x.j);
  error.rotor_angle = t * excess;
  return error;
}

template <Real Scalar>
ClosedFormError<Scalar> ClosedForm<Scalar>::error(Scalar t) const noexcept {
  ClosedFormError<Scalar> error = departure(t);
  // Beyond first order there is no telling.
  const bool small = error.attitude < Scalar(0.05) && error.momentum <= Scalar(0.05) * norm_;
  const auto twice = [&](Scalar x) { return small ? 2 * x : infinity<Scalar>; };
  const Scalar j = 1 / gyrostat_.principal()[0];
  const Scalar omega = std::max(std::abs(rate_), std::abs(final_rate_));
  const Scalar fast = j * (norm_ + gyrostat_.axial_inertia() * omega);
  const auto [momentum, p] = parts();
  const Scalar ulps = 8 * epsilon<Scalar>;
  const Scalar rate =
      ulps *
      (gyrostat_.condition() * omega + fast + p / gyrostat_.axial_inertia() +
       (momentum + p + gyrostat_.momentum_blur(gyrostat_.angular_velocity(start_.momentum, start_.axial_momentum))) /
           gyrostat_.free_principal()[0]);
  const Scalar angle = rate * (decay_ * t > 1 ? 1 / decay_ : t);
  // the turn that a turn of the rotor makes comes from the inverse of the tensor
  const Scalar by_rotor = std::max(Scalar(1), gyrostat_.condition() / 4) * std::abs(rotor_turn_) * omega;
  const Scalar phase =
      ulps * (1 + (std::abs(turn_) + std::abs(steady_turn_) + by_rotor) * t) + std::abs(rotor_turn_) * angle;
  return {twice(error.attitude) + phase, twice(error.momentum) + norm_ * phase, twice(error.rotor_rate) + rate,
          twice(error.rotor_angle) + ulps * (omega * t + std::abs(start_.rotor_angle)) + angle};
}

}  // namespace gyrostat::rotor
