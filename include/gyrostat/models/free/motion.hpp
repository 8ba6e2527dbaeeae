// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/models/free/frame.hpp"
#include "gyrostat/models/free/kind.hpp"
#include "gyrostat/models/free/pencil.hpp"
#include "gyrostat/models/free/problem.hpp"
#include "gyrostat/models/free/theta_pair.hpp"
#include "gyrostat/models/free/turns.hpp"

namespace gyrostat::free {

/// The motion at one time, body axes.
template <Real Scalar>
struct State {
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< rad/s
  Vec3<Scalar> angular_momentum{0, 0, 0};  ///< M, N m s
  Quat<Scalar> attitude{};                 ///< body to inertial, unit
};

class MotionLanes;

/// The motion of a free rigid body (Euler, Poinsot) or gyrostat (Zhukovskii, Volterra 1899), rates and attitude at any time: the spinor
/// of the direction of M in the body is a pair of theta functions of one complex argument times exp(i kappa t), and the attitude is that
/// spinor. Of a body that is symmetric about the axis of its rotors trigonometric functions do.
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
    if (precesses_) return precession_at(t);
    const Place place = place_at(t);
    Value zeta = pair_.at(place.exponent, place.rest);
    if (place.odd) zeta = half_period(zeta);
    return assemble(zeta, math::unit(2 * pi<Scalar> * place.turns));
  }

  /// at(first + i step) for i < count into arrays that may be null: angular_velocity (count, 3), attitude (count, 4; x, y, z, w),
  /// angular_momentum (count, 3). By one complex product a point within blocks; within 100 eps of at().
  void grid(Scalar first, Scalar step, std::size_t count, Scalar* angular_velocity, Scalar* attitude,
            Scalar* angular_momentum) const noexcept;

  /// Factor by which cancellation magnifies rounding in at(t), 1 or more; near 1 except where the frame is boosted.
  Scalar cancellation(Scalar t) const noexcept {
    using std::abs;
    if (kind_ == Kind::steady || precesses_) return 1;
    const Place place = place_at(t);
    const auto f = products(pair_.at(place.exponent, place.rest));
    Scalar parts = 0, sum = 0;
    for (int j = 0; j < 4; ++j) parts += abs(size_[j] * f[std::size_t(j)]), sum += size_[j] * f[std::size_t(j)];
    return parts / abs(sum);
  }

  /// The sum of the magnitudes of the terms of omega in at(t), rad/s. More than |omega| where the body is slim: its least moment makes much of omega
  /// from a small part of M, which is what products of the pair leave where they nearly cancel.
  Scalar rate_terms(Scalar t) const noexcept {
    using std::abs, std::sqrt;
    if (kind_ == Kind::steady || precesses_) return at(t).angular_velocity.norm();
    const Place place = place_at(t);
    const Value zeta = pair_.at(place.exponent, place.rest);
    const auto f = products(zeta);
    const auto [a, b] = pair_.terms(place.exponent, zeta);
    const Scalar one = sqrt(f[0]), two = sqrt(f[1]), product = (one * b + two * a) / 2,
                 terms[4] = {one * a, two * b, product, product};
    Scalar square = 0, size = 0;
    for (int j = 0; j < 4; ++j) size += size_[j] * f[std::size_t(j)];
    for (int i = 0; i < 3; ++i) {
      Scalar sum = 0;
      for (int j = 0; j < 4; ++j) sum += abs(W_(i, j)) * terms[j];
      square += sum * sum;
    }
    return sqrt(square) / abs(size);
  }

  /// By how much at(t) fails the equations dM/dt = M x omega, over |M| `fastest`, and dq/dt = q (0, omega)/2, over `fastest` [rad/s], and at(0) the
  /// start: some roundings where the set-up is sound. Of theta functions in trigonometric form, else infinite.
  Scalar defect(Scalar t, Scalar fastest) const noexcept;

  Kind kind() const noexcept { return kind_; }
  /// The motion is a regular precession: M goes round an axis of the body at one rate, and the body turns about M at another. So are those of a
  /// body that is symmetric about the axis of its rotors, and of a sphere.
  bool is_regular_precession() const noexcept { return precesses_; }
  /// Of a regular precession: the rate at which M goes round an axis of the body, body axes, and that of the body about M, rad/s.
  Vec3<Scalar> turning_of_momentum() const noexcept { return 4 * pi<Scalar> * rate_.high * axis_; }
  Scalar precession_rate() const noexcept { return 4 * pi<Scalar> * precession_.high; }
  /// The integral of omega since t = 0 in a regular precession, body axes, rad.
  Vec3<Scalar> precession_integral(Scalar t) const noexcept {
    using std::cos, std::sin;
    const Vec3<Scalar>& w = initial_.angular_velocity;
    const auto x = detail::Fraction<Scalar>::of(rate_, t, {});
    const Scalar half = 2 * pi<Scalar> * (x.high + x.low), pace = 4 * pi<Scalar> * rate_.high;
    const Vec3<Scalar> along = axis_.dot(w) * axis_, across = w - along;
    return t * along + 2 * sin(half) / pace * (cos(half) * across + sin(half) * cross<Scalar>(axis_, across));
  }
  /// Of omega in the body, s; infinite on a separatrix, NaN in a permanent rotation.
  Scalar period() const noexcept { return period_; }
  /// Rotation about M after one period, rad, in (-pi, pi]; NaN where there is no period.
  Scalar turn_per_period() const noexcept { return 2 * pi<Scalar> * turn_; }
  math::Modulus<Scalar> modulus() const noexcept { return modulus_; }
  /// k2; 1 of an unstable permanent rotation, whose level is that of the separatrix.
  Scalar modulus_squared() const noexcept { return steady_square_ < 0 ? Scalar(1) : modulus_.k2; }

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
  Scalar phase_rate() const noexcept { return 2 * pi<Scalar> * phase_rate_.high; }  ///< the kappa that is used, rad/s
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

  /// omega = a M - v, v constant: M goes round v in the body at its rate.
  template <Real Setup>
  void set_precession(const PrincipalProblem<Setup>& p, const Setup& a, const Vec3<Setup>& v) noexcept {
    precesses_ = true;
    const Vec3<Setup> M = a * p.M;
    rate_ = half_turns<Setup>(p.R_BP * v, axis_);
    precession_ = half_turns<Setup>(p.R_BP * M, precession_axis_);
    precession_axis_ = rotate<Scalar>(initial_.attitude, precession_axis_);
    const Setup size = magnitude(v), turns = magnitude(M) / size;
    period_ = static_cast<Scalar>(2 * pi<Setup> / size);
    set_turn(turns);
  }

  template <Real Setup>
  void set_sphere(const PrincipalProblem<Setup>& p) noexcept {
    kind_ = Kind::spherical;
    set_precession<Setup>(p, p.inverse[1], p.inverse[1] * p.l);
  }

  /// @param k the axis of symmetry, which carries the rotor momentum
  template <Real Setup>
  void set_symmetric(const PrincipalProblem<Setup>& p, const Setup& R, int k) noexcept {
    const Setup across = p.moments[1], along = p.moments[k];
    Vec3<Setup> v(0, 0, 0);
    v[k] = p.inverse[1] * (p.l[k] - (across - along) * p.omega[k]);
    if (v[k] == 0) return set_steady(p, R);
    set_precession<Setup>(p, p.inverse[1], v);
    modulus_ = {Scalar(0), Scalar(1)};
    // M along the axis at which the energy turns: the level has as much again on the other side of it, where |M| reaches so far
    const Setup turn = p.l[k] * across / (across - along), one = p.M[1], other = p.M[2 - k];
    const bool two = p.l[k] == 0 || 4 * turn * (turn - p.M[k]) < one * one + other * other;
    kind_ = !two ? Kind::one_component : k == 0 ? Kind::about_largest : Kind::about_smallest;
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
  /// whether an odd number of half periods was taken off u.
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

  /// q = exp(a M_I t/2) q0 exp(-v t/2).
  State<Scalar> precession_at(Scalar t) const noexcept {
    const Quat<Scalar> turn = spun(rate_, axis_, t);
    return {rotate<Scalar>(turn, initial_.angular_velocity), rotate<Scalar>(turn, initial_.angular_momentum),
            spun(precession_, precession_axis_, t) * initial_.attitude * conjugate(turn)};
  }

  static constexpr int block = 64;
  struct Block;
  void fill(Block& b, Scalar first, Scalar step, const detail::Winding<Scalar>& angle,
            const detail::Winding<Scalar>& phase) const noexcept;
  using Points = typename detail::GridPoints<Scalar>::Type;
  void sums(const Block& b, int k, Points (&zeta)[4]) const noexcept;
  void forms(Block& b, int k, const Points (&zeta)[4], bool with_momentum) const noexcept;
  void precess(Block& b, int n) const noexcept;

  Kind kind_ = Kind::steady;
  bool precesses_ = false;
  State<Scalar> initial_;
  Vec3<Scalar> moments_{1, 1, 1}, l_B_{0, 0, 0}, M_I_{0, 0, 0};
  Mat3<Scalar> R_BP_ = Mat3<Scalar>::Identity();
  Scalar energy_ = 0, R_ = 0, period_ = nan<Scalar>, turn_ = nan<Scalar>, steady_square_ = 0;
  math::Modulus<Scalar> modulus_;

  // windows of u (periods, or half periods in hyperbolic form): their rate, the start, and the angle or exponent of E over one. In a
  // steady rotation and a regular precession turns of a half angle about axis_, and about precession_axis_
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
  // no digits are left of what turns the body, or of its square
  const Setup G = magnitude(p.G), l = magnitude(p.l);
  if (!std::is_same_v<Setup, Scalar> && G > 0 && G < Setup(1e4) * epsilon<Setup> * l) return Errc::no_convergence;
  if (!(R < Setup(1e150))) return Errc::no_convergence;
  const Quat<Setup> q0 = as_unit(problem.attitude);
  motion.common(p, R, q0);
  const Setup floor = Setup(1e-140) * (p.l.cwiseAbs().maxCoeff() + p.G.cwiseAbs().maxCoeff());
  if (R <= floor || p.steady(R)) {
    motion.set_steady(p, R);
    return motion;
  }
  if (p.spherical()) {
    motion.set_sphere(p);
    return motion;
  }
  if (const int k = p.axis_of_symmetry(); k >= 0) {
    motion.set_symmetric(p, R, k);
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
  if (pair_.hyperbolic || kind_ == Kind::steady || precesses_) return infinity<Scalar>;
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

#ifdef GYROSTAT_COMPILED
extern template Result<Motion<double>> Motion<double>::make<double>(const Problem<double>&) noexcept;
extern template Result<Motion<double>> Motion<double>::make<DoubleDouble>(const Problem<DoubleDouble>&) noexcept;
extern template double Motion<double>::defect(double, double) const noexcept;
extern template void Motion<double>::grid(double, double, std::size_t, double*, double*, double*) const noexcept;
#endif

}  // namespace gyrostat::free

#include "gyrostat/models/free/motion_grid.hpp"
