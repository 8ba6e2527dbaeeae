// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/models/free/frame.hpp"
#include "gyrostat/models/free/kind.hpp"
#include "gyrostat/models/free/pencil.hpp"
#include "gyrostat/models/free/problem.hpp"
#include "gyrostat/models/free/theta_pair.hpp"

namespace gyrostat::free {

/// The motion at one time, body axes.
template <Real Scalar>
struct State {
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< rad/s
  Vec3<Scalar> angular_momentum{0, 0, 0};  ///< M, N m s
  Quat<Scalar> attitude{};                 ///< body to inertial, unit
};

class MotionLanes;

namespace detail {

/// A number in two words, for turns counted over a long time.
template <Real Scalar>
struct Turns {
  Scalar high = 0, low = 0;

  template <Real Setup>
  static Turns split(const Setup& x) noexcept {
    const Scalar high = static_cast<Scalar>(x);
    return {high, static_cast<Scalar>(x - Setup(high))};
  }
};

/// A number of turns less the nearest whole one, in two words.
template <Real Scalar>
struct Fraction {
  Scalar whole, high, low;

  /// of rate t + start
  static Fraction of(const Turns<Scalar>& rate, Scalar t, const Turns<Scalar>& start) noexcept {
    using std::fma, std::nearbyint;
    const Scalar p = t * rate.high, rest = fma(t, rate.high, -p) + t * rate.low;
    Scalar n = nearbyint(p + start.high);
    const Scalar part = p - n, sum = part + start.high, back = sum - part;
    const Scalar low = ((part - (sum - back)) + (start.high - back)) + (rest + start.low);
    const Scalar more = nearbyint(sum + low);
    const Scalar left = sum - more, high = left + low;
    return {n + more, high, low - (high - left)};
  }
};

}  // namespace detail

/// The motion of a free rigid body (Euler, Poinsot) or gyrostat (Zhukovskii, Volterra 1899), rates and attitude at any time: the spinor
/// of the direction of M in the body is a pair of theta functions of one complex argument times exp(i kappa t), and the attitude is that
/// spinor.
template <Real Scalar>
class Motion {
 public:
  Motion() = default;

  /// Setup: the numbers in which what is constant is found, DoubleDouble where rounding in it is not to be seen; at() works in Scalar.
  /// Errors: those of Problem::check(); no_convergence, separatrix (a level that rounding makes undecidable).
  template <Real Setup = Scalar>
  static Result<Motion> make(const Problem<Setup>& problem) noexcept;

  State<Scalar> at(Scalar t) const noexcept {
    if (kind_ == Kind::steady) return steady_at(t);
    if (kind_ == Kind::spherical) return sphere_at(t);
    const Place place = place_at(t);
    Value zeta = pair_.at(place.exponent, place.rest);
    if (place.odd) zeta = half_period(zeta);
    return assemble(zeta, math::unit(2 * pi<Scalar> * place.turns));
  }

  /// at(first + i step) for i < count into arrays that may be null: angular_velocity (count, 3), attitude (count, 4; x, y, z, w),
  /// angular_momentum (count, 3). By one complex product a point within blocks; within 100 eps of at().
  void grid(Scalar first, Scalar step, std::size_t count, Scalar* angular_velocity, Scalar* attitude,
            Scalar* angular_momentum) const noexcept;

  /// By how much rounding in at(t) grows since terms of opposite sign are added, 1 or more; near 1 but where the frame is boosted.
  Scalar cancellation(Scalar t) const noexcept {
    using std::abs;
    if (kind_ == Kind::steady || kind_ == Kind::spherical) return 1;
    const Place place = place_at(t);
    const auto f = products(pair_.at(place.exponent, place.rest));
    Scalar parts = 0, sum = 0;
    for (int j = 0; j < 4; ++j) parts += abs(size_[j] * f[std::size_t(j)]), sum += size_[j] * f[std::size_t(j)];
    return parts / abs(sum);
  }

  /// What omega is summed of in at(t), all terms by their sizes, rad/s: more than |omega| where the body is slim, whose slight moment turns a small
  /// part of M into much of omega.
  Scalar rate_terms(Scalar t) const noexcept {
    using std::abs, std::sqrt;
    if (kind_ == Kind::steady || kind_ == Kind::spherical) return at(t).angular_velocity.norm();
    const Place place = place_at(t);
    const auto f = products(pair_.at(place.exponent, place.rest));
    Scalar square = 0, size = 0;
    for (int j = 0; j < 4; ++j) size += size_[j] * f[std::size_t(j)];
    for (int i = 0; i < 3; ++i) {
      Scalar sum = 0;
      for (int j = 0; j < 4; ++j) sum += abs(W_(i, j) * f[std::size_t(j)]);
      square += sum * sum;
    }
    return sqrt(square) / abs(size);
  }

  /// By how much at(t) fails the equations dM/dt = M x omega, over |M| `fastest`, and dq/dt = q (0, omega)/2, over `fastest` [rad/s], and at(0) the
  /// start: some roundings where the set-up is sound. In trigonometric form, else infinite.
  Scalar defect(Scalar t, Scalar fastest) const noexcept;

  Kind kind() const noexcept { return kind_; }
  /// Of omega in the body, s; infinite on a separatrix, NaN in a permanent rotation.
  Scalar period() const noexcept { return period_; }
  /// Rotation about M after one period, rad, in (-pi, pi]; NaN where there is no period.
  Scalar turn_per_period() const noexcept { return 2 * pi<Scalar> * turn_; }
  math::Modulus<Scalar> modulus() const noexcept { return modulus_; }
  Scalar modulus_squared() const noexcept { return modulus_.k2; }

  Scalar energy() const noexcept { return energy_; }                           ///< omega.J omega/2, J
  Scalar angular_momentum_norm() const noexcept { return R_; }                 ///< N m s
  const Vec3<Scalar>& inertial_momentum() const noexcept { return M_I_; }      ///< inertial axes, N m s
  const Vec3<Scalar>& rotor_momentum() const noexcept { return l_B_; }         ///< body axes, N m s
  const Mat3<Scalar>& R_BP() const noexcept { return R_BP_; }                  ///< principal axes to body axes
  const Vec3<Scalar>& principal_moments() const noexcept { return moments_; }  ///< descending, kg m^2
  /// Square of the frequency of small oscillations about a steady rotation, negative where it is unstable, 1/s^2; 0 for other kinds.
  Scalar steady_square() const noexcept { return steady_square_; }
  /// kappa of the attitude's phase by either component of the spinor, rad/s: equal but for rounding.
  Scalar kappa(int component) const noexcept { return kappa_[component]; }
  /// Phase at time 0, in periods from a point of symmetry of the path (in half periods where hyperbolic()).
  Scalar start_phase() const noexcept { return start_.high; }
  bool hyperbolic() const noexcept { return pair_.hyperbolic; }
  Scalar jacobi_rate() const noexcept { return u_rate_; }                ///< du/dt, rad/s
  Scalar jacobi_start() const noexcept { return u_start_; }              ///< u at time 0
  Scalar quarter_period() const noexcept { return pair_.K; }             ///< K
  Scalar quarter_period_conjugate() const noexcept { return pair_.Kp; }  ///< K'

 private:
  friend class MotionLanes;

  using C = math::Complex<Scalar>;
  template <class S>
  using Mat34 = Eigen::Matrix<S, 3, 4>;

  template <Real Setup>
  void common(const PrincipalProblem<Setup>& p, const Setup& R, const Quat<Setup>& q0) noexcept {
    const Vec3<Setup> M = p.R_BP * p.M;
    moments_ = vector_cast<Scalar>(p.moments);
    R_BP_ = matrix_cast<Scalar>(p.R_BP);
    l_B_ = vector_cast<Scalar>(Vec3<Setup>(p.R_BP * p.l));
    energy_ = static_cast<Scalar>(p.omega.dot(p.G) / 2);
    R_ = static_cast<Scalar>(R);
    M_I_ = vector_cast<Scalar>(rotate<Setup>(q0, M));
    initial_.angular_velocity = vector_cast<Scalar>(Vec3<Setup>(p.R_BP * p.omega));
    initial_.angular_momentum = vector_cast<Scalar>(M);
    initial_.attitude = {static_cast<Scalar>(q0.w), static_cast<Scalar>(q0.x), static_cast<Scalar>(q0.y),
                         static_cast<Scalar>(q0.z)};
  }

  /// v in turns about its direction: rate of the half angle over 2 pi, and the direction.
  template <Real Setup>
  static detail::Turns<Scalar> half_turns(const Vec3<Setup>& v, Vec3<Scalar>& direction) noexcept {
    const Setup size = magnitude(v);
    direction = size > 0 ? vector_cast<Scalar>(Vec3<Setup>(v / size)) : Vec3<Scalar>(Vec3<Scalar>::Zero());
    return detail::Turns<Scalar>::split(size / (4 * pi<Setup>));
  }
  static Quat<Scalar> spun(const detail::Turns<Scalar>& rate, const Vec3<Scalar>& axis, Scalar t) noexcept {
    using std::cos, std::sin;
    const auto x = detail::Fraction<Scalar>::of(rate, t, {});
    const Scalar angle = 2 * pi<Scalar> * (x.high + x.low), s = sin(angle);
    return {cos(angle), s * axis[0], s * axis[1], s * axis[2]};
  }

  template <Real Setup>
  void set_steady(const PrincipalProblem<Setup>& p, const Setup& R) noexcept {
    using std::abs;
    kind_ = Kind::steady;
    period_ = turn_ = nan<Scalar>;
    rate_ = half_turns<Setup>(p.R_BP * p.omega, axis_);
    if (!(R > 0)) return;
    // omega = sigma M: product of the second derivatives of the energy on the sphere of M
    const Vec3<Setup> n = p.M / R;
    const Setup sigma = p.omega.dot(n) / R;
    Vec3<Setup> d;
    for (int i = 0; i < 3; ++i) {
      d[i] = R * (p.inverse[i] - sigma);
      if (abs(d[i]) <= 8 * epsilon<Setup> * R * p.inverse[i]) d[i] = 0;
    }
    steady_square_ =
        static_cast<Scalar>(d[1] * d[2] * n[0] * n[0] + d[0] * d[2] * n[1] * n[1] + d[0] * d[1] * n[2] * n[2]);
  }

  template <Real Setup>
  void set_sphere(const PrincipalProblem<Setup>& p, const Setup& R) noexcept {
    (void)R;
    kind_ = Kind::spherical;
    const Setup a = p.inverse[1];
    const Vec3<Setup> l = a * (p.R_BP * p.l), M = a * (p.R_BP * p.M);
    rate_ = half_turns<Setup>(l, axis_);
    precession_ = half_turns<Setup>(M, precession_axis_);
    precession_axis_ = rotate<Scalar>(initial_.attitude, precession_axis_);
    const Setup size = magnitude(l), turns = magnitude(M) / size;
    period_ = static_cast<Scalar>(2 * pi<Setup> / size);
    set_turn(turns);
  }

  /// Turns about M in a period, brought into (-1/2, 1/2].
  template <Real Setup>
  void set_turn(const Setup& turns) noexcept {
    using std::nearbyint;
    turn_ = static_cast<Scalar>(turns - nearbyint(turns));
    if (turn_ == Scalar(-0.5)) turn_ = Scalar(0.5);
  }

  template <Real Setup>
  bool set_regular(const Pencil<Setup>& pencil, const SpinorFrame<Setup>& frame, const PrincipalProblem<Setup>& p,
                   const Setup& R) noexcept {
    using std::abs, std::isfinite;
    const ThetaPair<Setup> pair(frame);
    pair_ = pair.template cast<Scalar>();
    modulus_ = {static_cast<Scalar>(frame.modulus.k2), static_cast<Scalar>(frame.modulus.kp2)};
    const bool endless = frame.modulus.kp2 == 0;
    kind_ = endless                          ? Kind::separatrix
            : frame.form == PathForm::single ? Kind::one_component
            : frame.side > 0                 ? Kind::about_largest
                                             : Kind::about_smallest;
    const Setup u_rate = frame.rate * R, u_start = math::jacobi_argument(frame.sn, frame.cn, frame.dn);
    // a window of the argument: a period in trigonometric form, half of one in hyperbolic form
    const Setup window = endless ? Setup(1) : (pair.hyperbolic ? 2 : 4) * pair.K;
    rate_ = detail::Turns<Scalar>::split(u_rate / window);
    start_ = detail::Turns<Scalar>::split(u_start / window);
    span_ = detail::Turns<Scalar>::split(pair.h * window);
    u_rate_ = static_cast<Scalar>(u_rate);
    u_start_ = static_cast<Scalar>(u_start);

    const auto turning = pair.turning();
    const Setup kappa[2] = {R * (frame.psi[0] - frame.rate * turning.one),
                            R * (frame.psi[1] - frame.rate * turning.two)};
    const auto value = pair.at(Setup(0));
    const auto square = [](const math::Complex<Setup>& z) { return z.re * z.re + z.im * z.im; };
    const Setup phase_rate = kappa[square(value.one) >= square(value.two) ? 0 : 1] / (2 * pi<Setup>);
    const Setup jump = pair.hyperbolic
                           ? Setup(frame.delta) * frame.eta / ((frame.form == PathForm::single ? 2 : 4) * pair.Kp)
                           : Setup(0);
    for (int j = 0; j < 2; ++j) kappa_[j] = static_cast<Scalar>(kappa[j]);
    phase_rate_ = detail::Turns<Scalar>::split(phase_rate);
    jump_ = detail::Turns<Scalar>::split(endless ? Setup(0) : jump);
    period_ = endless ? infinity<Scalar> : static_cast<Scalar>(4 * pair.K / u_rate);
    if (endless) turn_ = nan<Scalar>;
    else set_turn<Setup>(2 * (phase_rate * (4 * pair.K / u_rate) + (pair.hyperbolic ? 2 * jump : Setup(0))));

    set_forms(pencil, frame, p, R);
    lay_ = {};
    lay_ = initial_.attitude * conjugate(at(Scalar(0)).attitude);
    return isfinite(rate_.high) && isfinite(phase_rate_.high) && isfinite(lay_.w + lay_.x + lay_.y + lay_.z);
  }

  /// Rates, momentum and spinor as forms of zeta; body axes.
  template <Real Setup>
  void set_forms(const Pencil<Setup>& pencil, const SpinorFrame<Setup>& frame, const PrincipalProblem<Setup>& p,
                 const Setup& R) noexcept {
    using std::sqrt;
    using CS = math::Complex<Setup>;
    const Vec4<Setup>* basis[4] = {&frame.plus, &frame.minus, &frame.xa, &frame.xb};
    Vec4<Setup> momentum[4];
    for (int k = 0; k < 4; ++k) {
      const Setup factor = (k < 2 ? 1 : 2);
      momentum[k] = pencil.momentum(*basis[k]);
      const Vec3<Setup> m = p.R_BP * Vec3<Setup>(momentum[k].template head<3>()), w = p.R_BP * pencil.rate(*basis[k]);
      M_.col(k) = vector_cast<Scalar>(Vec3<Setup>(factor * R * m));
      W_.col(k) = vector_cast<Scalar>(Vec3<Setup>(factor * R * w));
      size_[k] = static_cast<Scalar>(factor * momentum[k][3]);
    }
    // o o^+ = H(N+)/2, then iota from H(xa) + i H(xb) = 2 o iota^+
    const Vec4<Setup>&N = momentum[0], &a = momentum[2], &b = momentum[3];
    CS o[2], iota[2];
    const Setup root = sqrt((N[3] + (N[2] >= 0 ? N[2] : -N[2])) / 2), zero = Setup(0);
    if (N[2] >= 0) o[0] = {root, zero}, o[1] = {N[0] / (2 * root), N[1] / (2 * root)};
    else o[1] = {root, zero}, o[0] = {N[0] / (2 * root), -N[1] / (2 * root)};
    const CS H[2][2] = {{{(a[3] + a[2]) / 2, (b[3] + b[2]) / 2}, {(a[0] + b[1]) / 2, (b[0] - a[1]) / 2}},
                        {{(a[0] - b[1]) / 2, (a[1] + b[0]) / 2}, {(a[3] - a[2]) / 2, (b[3] - b[2]) / 2}}};
    const Setup square = o[0].re * o[0].re + o[0].im * o[0].im + o[1].re * o[1].re + o[1].im * o[1].im;
    for (int j = 0; j < 2; ++j)
      iota[j] = math::conjugate(math::conjugate(o[0]) * H[0][j] + math::conjugate(o[1]) * H[1][j]) / square;
    // principal axes to body axes: p c, c = (R_BP)^-1, is a unitary transformation of the spinor
    const Quat<Setup> c = conjugate(from_matrix(p.R_BP));
    const CS U[2][2] = {{{c.w, c.z}, {c.y, c.x}}, {{-c.y, c.x}, {c.w, -c.z}}};
    for (int i = 0; i < 2; ++i) {
      spinor_[i][0] = math::complex_cast<Scalar>(U[i][0] * o[0] + U[i][1] * o[1]);
      spinor_[i][1] = math::complex_cast<Scalar>(U[i][0] * iota[0] + U[i][1] * iota[1]);
    }
  }

  using Value = typename ThetaPair<Scalar>::Value;

  /// Where the motion is at a time: the angle or the exponent of E and what rounding took from that, the turns of the spinor's phase, and
  /// whether a number of half periods that is odd was taken off u.
  struct Place {
    Scalar exponent, rest, turns;
    bool odd;
  };
  Place place_at(Scalar t) const noexcept {
    using std::fma, std::nearbyint;
    const auto x = detail::Fraction<Scalar>::of(rate_, t, start_), f = detail::Fraction<Scalar>::of(phase_rate_, t, {});
    if (!pair_.hyperbolic) return {2 * pi<Scalar> * (x.high + x.low), Scalar(0), f.high + f.low, false};
    if (kind_ == Kind::separatrix) {  // no period: beyond e^100 the motion has reached its end to any rounding
      const Scalar end = 100, u = span_.high * (x.whole + (x.high + x.low));
      return {u > end ? end : u < -end ? -end : u, Scalar(0), f.high + f.low, false};
    }
    const auto jump = detail::Fraction<Scalar>::of(jump_, x.whole, {});
    const Scalar exponent = span_.high * x.high, half = x.whole / 2;
    return {exponent, fma(span_.high, x.high, -exponent) + (span_.low * x.high + span_.high * x.low),
            (f.high + jump.high) + (f.low + jump.low), half != nearbyint(half)};
  }

  /// zeta in hyperbolic form an odd number of half periods on.
  Value half_period(const Value& zeta) const noexcept {
    return pair_.single ? Value{-zeta.one, zeta.two} : Value{-zeta.two, -zeta.one};
  }

  /// What omega, M and their common size are sums of.
  static std::array<Scalar, 4> products(const Value& zeta) noexcept {
    const C &a = zeta.one, &b = zeta.two;
    return {a.re * a.re + a.im * a.im, b.re * b.re + b.im * b.im, a.re * b.re + a.im * b.im, a.re * b.im - a.im * b.re};
  }

  /// The state whose spinor is zeta times a phase.
  State<Scalar> assemble(const Value& zeta, const C& phase) const noexcept {
    using std::sqrt;
    const C &a = zeta.one, &b = zeta.two;
    const auto f = products(zeta);
    const Scalar inverse = 1 / (size_[0] * f[0] + size_[1] * f[1] + size_[2] * f[2] + size_[3] * f[3]);
    State<Scalar> s;
    for (int i = 0; i < 3; ++i) {
      s.angular_velocity[i] = (W_(i, 0) * f[0] + W_(i, 1) * f[1] + W_(i, 2) * f[2] + W_(i, 3) * f[3]) * inverse;
      s.angular_momentum[i] = (M_(i, 0) * f[0] + M_(i, 1) * f[1] + M_(i, 2) * f[2] + M_(i, 3) * f[3]) * inverse;
    }
    const C up = (spinor_[0][0] * a + spinor_[0][1] * b) * phase,
            down = (spinor_[1][0] * a + spinor_[1][1] * b) * phase;
    const Scalar length = 1 / sqrt(up.re * up.re + up.im * up.im + down.re * down.re + down.im * down.im);
    s.attitude = lay_ * Quat<Scalar>{up.re * length, down.im * length, -down.re * length, up.im * length};
    return s;
  }

  State<Scalar> steady_at(Scalar t) const noexcept {
    State<Scalar> s = initial_;
    s.attitude = initial_.attitude * spun(rate_, axis_, t);
    if (t - t != 0) s.angular_velocity.setConstant(nan<Scalar>), s.angular_momentum.setConstant(nan<Scalar>);
    return s;
  }

  /// q = exp(a M_I t/2) q0 exp(-a l t/2).
  State<Scalar> sphere_at(Scalar t) const noexcept {
    const Quat<Scalar> turn = spun(rate_, axis_, t);
    return {rotate<Scalar>(turn, initial_.angular_velocity), rotate<Scalar>(turn, initial_.angular_momentum),
            spun(precession_, precession_axis_, t) * initial_.attitude * conjugate(turn)};
  }

  static constexpr int block = 64;
  struct Block;
  void fill(Block& b, Scalar first, Scalar step) const noexcept;
  void sums(Block& b) const noexcept;
  void forms(Block& b) const noexcept;

  Kind kind_ = Kind::steady;
  State<Scalar> initial_;
  Vec3<Scalar> moments_{1, 1, 1}, l_B_{0, 0, 0}, M_I_{0, 0, 0};
  Mat3<Scalar> R_BP_ = Mat3<Scalar>::Identity();
  Scalar energy_ = 0, R_ = 0, period_ = nan<Scalar>, turn_ = nan<Scalar>, steady_square_ = 0;
  math::Modulus<Scalar> modulus_;

  // windows of u (periods, or half periods in hyperbolic form): their rate, the start, and the angle or exponent of E over one. In a
  // steady rotation and on a sphere turns of a half angle about axis_, and about precession_axis_
  detail::Turns<Scalar> rate_, start_, span_, phase_rate_, jump_, precession_;
  Vec3<Scalar> axis_{0, 0, 0}, precession_axis_{0, 0, 0};
  ThetaPair<Scalar> pair_;
  Mat34<Scalar> M_ = Mat34<Scalar>::Zero(),
                W_ = Mat34<Scalar>::Zero();  // forms of |zeta_1|^2, |zeta_2|^2, Re and Im conj(zeta_1) zeta_2
  Scalar size_[4] = {1, 1, 0, 0};
  C spinor_[2][2] = {};
  Quat<Scalar> lay_{};  // inertial axes from those with M along 3
  Scalar kappa_[2] = {0, 0}, u_rate_ = 0, u_start_ = 0;
};

template <Real Scalar>
template <Real Setup>
Result<Motion<Scalar>> Motion<Scalar>::make(const Problem<Setup>& problem) noexcept {
  if (const Errc wrong = problem.template check<Scalar>(); wrong != Errc::ok) return wrong;
  Motion motion;
  const auto p = PrincipalProblem<Setup>::of(problem);
  const Setup R = magnitude(p.M);
  if (!(R - R == 0)) return Errc::not_finite;
  const Quat<Setup> q0 = as_unit(problem.attitude);
  motion.common(p, R, q0);
  const Setup floor = Setup(1e-140) * (p.l.cwiseAbs().maxCoeff() + p.G.cwiseAbs().maxCoeff());
  if (R <= floor || p.steady(R)) {
    motion.set_steady(p, R);
    return motion;
  }
  if (p.spherical()) {
    motion.set_sphere(p, R);
    return motion;
  }
  const Pencil<Setup> pencil(p.inverse, p.gaps, p.G, p.l, p.M, R);
  const auto frame = SpinorFrame<Setup>::of(pencil);
  if (!frame) return frame.error();
  return motion.set_regular(pencil, *frame, p, R) ? Result<Motion>(motion) : Result<Motion>(Errc::no_convergence);
}

template <Real Scalar>
Scalar Motion<Scalar>::defect(Scalar t, Scalar fastest) const noexcept {
  using std::max;
  if (pair_.hyperbolic || kind_ == Kind::steady || kind_ == Kind::spherical) return infinity<Scalar>;
  const Place place = place_at(t);
  const C E = math::unit(place.exponent);
  const Value zeta = pair_.trigonometric(E.re, E.im), slope = pair_.slope(E.re, E.im);
  const C &a = zeta.one, &b = zeta.two, &da = slope.one, &db = slope.two;
  const auto dot = [](const C& x, const C& y) { return x.re * y.re + x.im * y.im; };
  const Vec4<Scalar> f{dot(a, a), dot(b, b), dot(a, b), a.re * b.im - a.im * b.re};
  const Vec4<Scalar> df{2 * dot(a, da), 2 * dot(b, db), dot(da, b) + dot(a, db),
                        da.re * b.im - da.im * b.re + a.re * db.im - a.im * db.re};
  const Vec4<Scalar> size{size_[0], size_[1], size_[2], size_[3]};
  const Scalar s = size.dot(f);
  const Vec3<Scalar> M = M_ * f / s, omega = W_ * f / s;
  const Vec3<Scalar> change = u_rate_ * (M_ * df - M * size.dot(df)) / s;
  const Scalar of_momentum = (change - cross<Scalar>(M, omega)).norm() / R_;

  const C kappa{0, 2 * pi<Scalar> * phase_rate_.high / u_rate_};
  const C up = spinor_[0][0] * a + spinor_[0][1] * b, down = spinor_[1][0] * a + spinor_[1][1] * b;
  const C dup = spinor_[0][0] * da + spinor_[0][1] * db + kappa * up,
          ddown = spinor_[1][0] * da + spinor_[1][1] * db + kappa * down;
  const Vec3<Scalar> v(down.im, -down.re, up.im), dv(ddown.im, -ddown.re, dup.im);
  const Scalar square = up.re * up.re + v.squaredNorm();
  const Vec3<Scalar> turning = 2 * u_rate_ / square * (up.re * dv - dup.re * v - cross<Scalar>(v, dv));
  const Scalar of_attitude = (turning - omega).norm();
  const Scalar found = max(of_momentum, of_attitude) / fastest;
  if (t != 0) return found;
  return max(found,
             max((M - initial_.angular_momentum).norm() / R_, (omega - initial_.angular_velocity).norm() / fastest));
}

/// What a block of a grid works on, array by array so that compilers make vector instructions of the loops.
template <Real Scalar>
struct Motion<Scalar>::Block {
  using Row = Scalar[block];
  Row up, down;      // cos and sin of the angle of E, or E and 1/E
  Row cosine, sine;  // of the spinor's phase
  Row sign;          // -1 an odd number of half periods on (hyperbolic form)
  Row zeta[4];       // zeta_1 and zeta_2, real and imaginary parts
  Row rate[3], momentum[3], attitude[4];
};

namespace detail {

/// z_k = z_0 turn^k: eight in a row, and every further one from that eight before it.
template <Real Scalar, std::size_t N>
void wind(Scalar (&re)[N], Scalar (&im)[N], math::Complex<Scalar> z, math::Complex<Scalar> turn) noexcept {
  math::Complex<Scalar> leap{1, 0};
  for (std::size_t k = 0; k < 8; ++k) {
    re[k] = z.re, im[k] = z.im;
    z = z * turn;
    leap = leap * turn;
  }
  for (std::size_t k = 8; k < N; ++k) {
    re[k] = re[k - 8] * leap.re - im[k - 8] * leap.im;
    im[k] = re[k - 8] * leap.im + im[k - 8] * leap.re;
  }
}

}  // namespace detail

template <Real Scalar>
void Motion<Scalar>::fill(Block& b, Scalar first, Scalar step) const noexcept {
  using std::exp;
  const auto turned = [](Scalar turns) { return math::unit(2 * pi<Scalar> * turns); };
  const auto f = detail::Fraction<Scalar>::of(phase_rate_, step, {});
  const C turn = turned(f.high + f.low);
  if (!pair_.hyperbolic) {
    const auto x = detail::Fraction<Scalar>::of(rate_, step, {});
    const Place place = place_at(first);
    detail::wind(b.up, b.down, math::unit(place.exponent), turned(x.high + x.low));
    detail::wind(b.cosine, b.sine, turned(place.turns), turn);
    return;
  }
  const bool endless = kind_ == Kind::separatrix;
  const Scalar rise = rate_.high * step * span_.high, end = endless ? Scalar(100) : span_.high / 2;
  const Scalar by = exp(rise), back = 1 / by;
  C phase{1, 0};
  Scalar exponent = end, sign = 1;  // beyond the end of a window: anew
  for (int k = 0; k < block; ++k) {
    if (k == 0 || !(exponent < end && exponent > -end)) {
      const Place place = place_at(first + step * Scalar(k));
      exponent = place.exponent;
      b.up[k] = exp(exponent) * (1 + place.rest);
      b.down[k] = 1 / b.up[k];
      phase = turned(place.turns);
      sign = place.odd ? -1 : 1;
    } else {
      b.up[k] = b.up[k - 1] * by;
      b.down[k] = b.down[k - 1] * back;
      phase = phase * turn;
    }
    b.cosine[k] = phase.re, b.sine[k] = phase.im, b.sign[k] = sign;
    exponent += rise;
  }
}

/// ThetaPair::at for a whole block.
template <Real Scalar>
void Motion<Scalar>::sums(Block& b) const noexcept {
  typename Block::Row re, im, sum[2][2];
  const bool hyperbolic = pair_.hyperbolic, single = pair_.single;
  for (int k = 0; k < block; ++k) {
    re[k] = im[k] = 1;  // E^m and E^-m, or its real and imaginary part
    if (!hyperbolic) im[k] = 0;
    sum[0][0][k] = pair_.x[0], sum[0][1][k] = sum[1][0][k] = sum[1][1][k] = 0;
  }
  for (int m = 1; m <= pair_.powers; ++m) {
    const Scalar x = pair_.x[m], y = pair_.y[m];
    auto& s = sum[m & 1];
    if (!hyperbolic) {
      for (int k = 0; k < block; ++k) {
        const Scalar r = re[k] * b.up[k] - im[k] * b.down[k];
        im[k] = re[k] * b.down[k] + im[k] * b.up[k];
        re[k] = r;
        s[0][k] += x * re[k];
        s[1][k] += y * im[k];
      }
      continue;
    }
    for (int k = 0; k < block; ++k) re[k] *= b.up[k], im[k] *= b.down[k];
    if (single) {
      const Scalar odd = m & 1 ? -1 : 1;
      for (int k = 0; k < block; ++k) s[0][k] += x * (re[k] + odd * im[k]), s[1][k] += y * (re[k] - odd * im[k]);
    } else if (m & 1) {
      const bool swapped = m % 4 == 3;
      for (int k = 0; k < block; ++k) {
        const Scalar one = swapped ? im[k] : re[k], two = swapped ? re[k] : im[k];
        sum[1][0][k] += x * one, sum[1][1][k] += y * one;
        sum[0][0][k] -= x * two, sum[0][1][k] += y * two;
      }
    }
  }
  for (int k = 0; k < block; ++k) {
    Scalar a = sum[1][0][k], c = sum[1][1][k], e = sum[0][0][k], g = sum[0][1][k];
    if (!hyperbolic) {
      const Scalar turned = a;  // -i times the odd sum
      a = c, c = -turned;
      b.zeta[0][k] = single ? a : e, b.zeta[1][k] = single ? c : g;
      b.zeta[2][k] = single ? e : a, b.zeta[3][k] = single ? g : c;
    } else if (single) {
      b.zeta[0][k] = b.sign[k] * a, b.zeta[1][k] = b.sign[k] * c, b.zeta[2][k] = e, b.zeta[3][k] = g;
    } else {
      const bool odd = b.sign[k] < 0;
      b.zeta[0][k] = odd ? -e : a, b.zeta[1][k] = odd ? -g : c, b.zeta[2][k] = odd ? -a : e,
      b.zeta[3][k] = odd ? -c : g;
    }
  }
}

/// assemble() for a whole block.
template <Real Scalar>
void Motion<Scalar>::forms(Block& b) const noexcept {
  using std::sqrt;
  // copies: what the loops write could be members, for all the compiler knows
  const Mat34<Scalar> W = W_, M = M_;
  const Scalar size[4] = {size_[0], size_[1], size_[2], size_[3]};
  const Quat<Scalar> l = lay_;
  const C o[2] = {spinor_[0][0], spinor_[1][0]}, iota[2] = {spinor_[0][1], spinor_[1][1]};
  typename Block::Row square;
  for (int k = 0; k < block; ++k) {
    const Scalar ar = b.zeta[0][k], ai = b.zeta[1][k], br = b.zeta[2][k], bi = b.zeta[3][k];
    const Scalar f0 = ar * ar + ai * ai, f1 = br * br + bi * bi, f2 = ar * br + ai * bi, f3 = ar * bi - ai * br;
    const Scalar inverse = 1 / (size[0] * f0 + size[1] * f1 + size[2] * f2 + size[3] * f3);
    for (int i = 0; i < 3; ++i) {
      b.rate[i][k] = (W(i, 0) * f0 + W(i, 1) * f1 + W(i, 2) * f2 + W(i, 3) * f3) * inverse;
      b.momentum[i][k] = (M(i, 0) * f0 + M(i, 1) * f1 + M(i, 2) * f2 + M(i, 3) * f3) * inverse;
    }
    const C one{ar, ai}, two{br, bi}, turn{b.cosine[k], b.sine[k]};
    const C up = (o[0] * one + iota[0] * two) * turn, down = (o[1] * one + iota[1] * two) * turn;
    const Scalar w = up.re, x = down.im, y = -down.re, z = up.im;
    square[k] = w * w + x * x + y * y + z * z;
    b.attitude[0][k] = l.w * x + l.x * w + l.y * z - l.z * y;
    b.attitude[1][k] = l.w * y - l.x * z + l.y * w + l.z * x;
    b.attitude[2][k] = l.w * z + l.x * y - l.y * x + l.z * w;
    b.attitude[3][k] = l.w * w - l.x * x - l.y * y - l.z * z;
  }
  for (int k = 0; k < block; ++k) square[k] = sqrt(square[k]);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < block; ++k) b.attitude[i][k] /= square[k];
}

template <Real Scalar>
void Motion<Scalar>::grid(Scalar first, Scalar step, std::size_t count, Scalar* angular_velocity, Scalar* attitude,
                          Scalar* angular_momentum) const noexcept {
  const bool special = kind_ == Kind::steady || kind_ == Kind::spherical;
  Block b{};
  for (std::size_t begin = 0; begin < count; begin += block) {
    const int n = static_cast<int>(std::min<std::size_t>(block, count - begin));
    if (!special) {
      fill(b, first + step * Scalar(begin), step);
      sums(b);
      forms(b);
    }
    for (int k = 0; special && k < n; ++k) {
      const State<Scalar> s = at(first + step * Scalar(begin + std::size_t(k)));
      for (int i = 0; i < 3; ++i) b.rate[i][k] = s.angular_velocity[i], b.momentum[i][k] = s.angular_momentum[i];
      b.attitude[0][k] = s.attitude.x, b.attitude[1][k] = s.attitude.y, b.attitude[2][k] = s.attitude.z,
      b.attitude[3][k] = s.attitude.w;
    }
    const auto put = [n](Scalar*& to, const auto& rows, int width) {
      if (!to) return;
      for (int k = 0; k < n; ++k)
        for (int i = 0; i < width; ++i) *to++ = rows[i][k];
    };
    put(angular_velocity, b.rate, 3);
    put(attitude, b.attitude, 4);
    put(angular_momentum, b.momentum, 3);
  }
}

#ifdef GYROSTAT_COMPILED
extern template Result<Motion<double>> Motion<double>::make<double>(const Problem<double>&) noexcept;
extern template Result<Motion<double>> Motion<double>::make<DoubleDouble>(const Problem<DoubleDouble>&) noexcept;
extern template double Motion<double>::defect(double, double) const noexcept;
extern template void Motion<double>::grid(double, double, std::size_t, double*, double*, double*) const noexcept;
#endif

}  // namespace gyrostat::free
