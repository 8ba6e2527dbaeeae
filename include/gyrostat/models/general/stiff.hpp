// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/known_momentum.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/prepared.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full equations over one piece for wheels that settle fast: each unknown z of settling.hpp relaxes by itself, at any rate
/// (docs/general.md, section 3).
namespace gyrostat::general {

namespace detail {

/// Three components of a vector, and a matrix, of four times or states side by side.
template <Real Scalar>
using Rows3 = std::array<Lanes<Scalar>, 3>;
template <Real Scalar>
using Rows33 = std::array<Rows3<Scalar>, 3>;

template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> dot_rows(const Rows3<Scalar>& a, const Rows3<Scalar>& b) noexcept {
  return multiply_add(a[0], b[0], multiply_add(a[1], b[1], a[2] * b[2]));
}
template <Real Scalar>
GYROSTAT_INLINE Rows3<Scalar> times(const Rows33<Scalar>& m, const Rows3<Scalar>& v) noexcept {
  return {dot_rows<Scalar>(m[0], v), dot_rows<Scalar>(m[1], v), dot_rows<Scalar>(m[2], v)};
}
template <Real Scalar>
GYROSTAT_INLINE Rows3<Scalar> cross_rows3(const Rows3<Scalar>& a, const Rows3<Scalar>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <Real Scalar>
GYROSTAT_INLINE void add_rows(Rows3<Scalar>& to, const Rows3<Scalar>& more) noexcept {
  for (std::size_t i = 0; i < 3; ++i) to[i] = to[i] + more[i];
}
template <Real Scalar>
GYROSTAT_INLINE void take_rows(Rows3<Scalar>& from, const Rows3<Scalar>& less) noexcept {
  for (std::size_t i = 0; i < 3; ++i) from[i] = from[i] - less[i];
}
template <Real Scalar>
GYROSTAT_INLINE void scale_rows(Rows3<Scalar>& rows, const Lanes<Scalar>& by) noexcept {
  for (auto& row : rows) row = row * by;
}

}  // namespace detail

/// A system for ode::Radau. A state: (q.w, q.x, q.y, q.z | M | W, the integral of w | velocity and position as forces have changed them | the
/// integrals of z | z), body axes as in full.hpp. most: at least the number of wheels with friction.
template <Real Real_, int most>
class StiffSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = 16 + most, relaxing = most;
  using Numbers = std::array<Scalar, width + relaxing>;

  /// What depends on the time alone, of four times.
  struct Moment {
    using Vector = detail::Rows3<Scalar>;
    using Matrix = detail::Rows33<Scalar>;
    Vector momentum;            ///< of wheels whose p is known
    Lanes<Scalar> drive[most];  ///< of z, by the motors
    /// As in Terms, and in `inertial` also what is along axes of the orbit or of a dipole in the field.
    Vector body, brake_total, brake_carrier, force_body, force_inertial;
    Matrix by_rate, by_momentum, eddy;
    std::array<Matrix, 3> inertial;
    Lanes<Scalar> gradient, orbit_gradient;  ///< times N
    Vector radial, field, field_rate;        ///< inertial axes
  };

  /// As FullSystem's.
  StiffSystem(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Numbers& start, const Numbers& lost = {},
              const KnownMomentum<Scalar>* before = nullptr) noexcept;

  static Numbers first_numbers(const Prepared<Scalar>& of) noexcept;
  /// W.
  static Vec3<Scalar> turned(const Scalar* x) noexcept { return {x[turn], x[turn + 1], x[turn + 2]}; }

  Scalar rate(int i) const noexcept { return of_->settling.rate[std::size_t(i)]; }
  Scalar forcing() const noexcept { return of_->sizes.forcing; }
  Moment moment(const Lanes<Scalar>& t) const noexcept;
  GYROSTAT_INLINE void sources(const Moment& now, const Lanes<Scalar>* y, Lanes<Scalar>* source) const noexcept;
  GYROSTAT_INLINE void rates(const Moment& now, const Lanes<Scalar>* y, const Lanes<Scalar>* z,
                             Lanes<Scalar>* rate) const noexcept;

  /// |q| = 1, and where R M is known M by it. Both to rounding of x + low.
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept;

  /// The state that numbers at t mean, by the laws of this piece or another one.
  State<Scalar> state(Scalar t, const Scalar* x) const noexcept { return state(*piece_, t, x); }
  State<Scalar> state(const Piece<Scalar>& piece, Scalar t, const Scalar* x) const noexcept;

  /// As in FullSystem, both.
  const KnownMomentum<Scalar>& known() const noexcept { return known_; }
  Scalar braked(Scalar t, const Scalar* x) const noexcept {
    const Scalar total = has_.total_brake ? Vec3<Scalar>(x[4], x[5], x[6]).norm() : infinity<Scalar>;
    if (!has_.carrier_brake) return total;
    return std::min(total, (of_->wheels.whole * state(t, x).angular_velocity).norm());
  }
  bool has_brake() const noexcept { return has_.total_brake || has_.carrier_brake; }
  /// A bound of the torques that take away what a brake opposes, N m: on the carrier those of the wheels, too, until they have settled.
  Scalar torque(Scalar t, const Scalar* x) const noexcept {
    Scalar sum = 0;
    if (!has_.carrier_brake) return of_->sizes.external;
    const auto at = state(t, x);
    for (std::size_t i = 0; i < of_->wheels.count; ++i)
      if (const auto& law = of_->wheels.laws[i]; law.follows == Follows::state)
        sum += std::abs(law.torque - law.friction * at.rotor_rate[i]);
    return of_->sizes.external + Mat3<Scalar>(of_->wheels.whole * of_->wheels.inverse).norm() * sum;
  }
  Numbers scale() const noexcept;

 private:
  using Row = Lanes<Scalar>;
  using Vector = typename Moment::Vector;
  using Matrix = typename Moment::Matrix;
  using At = Places<true>;
  enum : int { momentum = 4, turn = 7, velocity = 10, position = 13, passed = 16, mode = width };

  /// All that acts at one time, and where the field and the orbit are.
  struct Instant {
    Terms<Scalar> terms;
    OrbitPoint<Scalar> orbit;
    MagneticPoint<Scalar> field;
  };
  Instant instant(Scalar t) const noexcept;
  void take_motors(const Row& t, Moment& now) const noexcept;

  /// The torque of all that is not in Moment::body, and the force in inertial axes.
  struct Acting {
    Vector torque, force;
  };
  GYROSTAT_NOINLINE void act(const Moment& now, const Row* y, const Vector& w, Acting& acting) const noexcept;

  /// Which terms the piece has.
  struct Has {
    bool moving = false, inertial = false, rate = false, momentum = false, gradient = false, orbit_gradient = false,
         eddy = false, total_brake = false, carrier_brake = false, force_body = false, force_inertial = false,
         orbit = false, field = false;
  };

  // pointers, that it can be copied
  const Prepared<Scalar>* of_;
  const Piece<Scalar>* piece_;
  KnownMomentum<Scalar> known_;
  Has has_;
  int count_;
  Scalar inverse_[3][3], axis_[most][3], pull_[most][3];
};

template <Real Real_, int most>
StiffSystem<Real_, most>::StiffSystem(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Numbers& start,
                                      const Numbers& lost, const KnownMomentum<Scalar>* before) noexcept
    : of_(&of), piece_(&piece), known_(piece, start.data(), lost.data(), before), count_(int(of.settling.count)) {
  const auto look = [&](const Terms<Scalar>& terms) noexcept {
    has_.moving = has_.moving || terms.any_moving() || !terms.force_body.isZero(0) || !terms.force_inertial.isZero(0);
    for (std::size_t j = 0; j < 3; ++j) {
      has_.inertial = has_.inertial || !terms.inertial[j].isZero(0) || !terms.orbital[j].isZero(0);
      has_.orbit = has_.orbit || !terms.orbital[j].isZero(0);
    }
    has_.inertial = has_.inertial || !terms.dipole.isZero(0);
    has_.rate = has_.rate || !terms.by_rate.isZero(0);
    has_.momentum = has_.momentum || !terms.by_momentum.isZero(0);
    has_.gradient = has_.gradient || terms.gradient != 0;
    has_.orbit_gradient = has_.orbit_gradient || terms.orbit_gradient != 0;
    has_.eddy = has_.eddy || !terms.eddy.isZero(0);
    has_.field = has_.field || has_.eddy || !terms.dipole.isZero(0);
    has_.total_brake = has_.total_brake || !terms.brake_total.isZero(0);
    has_.carrier_brake = has_.carrier_brake || !terms.brake_carrier.isZero(0);
    has_.force_body = has_.force_body || !terms.force_body.isZero(0);
    has_.force_inertial = has_.force_inertial || !terms.force_inertial.isZero(0);
  };
  for (const auto& terms : piece.power) look(terms);
  for (const auto& wave : piece.waves) look(wave.terms);
  has_.orbit = has_.orbit || has_.orbit_gradient;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse_[i][j] = of.wheels.inverse(i, j);
  for (int i = 0; i < most; ++i) {
    const Vec3<Scalar> a = i < count_ ? of.settling.axis[std::size_t(i)] : Vec3<Scalar>(0, 0, 0);
    const Vec3<Scalar> pull = of.wheels.inverse * a;
    for (int j = 0; j < 3; ++j) axis_[i][j] = a[j], pull_[i][j] = pull[j];
  }
}

template <Real Real_, int most>
auto StiffSystem<Real_, most>::first_numbers(const Prepared<Scalar>& of) noexcept -> Numbers {
  Numbers x{};
  const auto& q = of.problem.attitude;
  x[0] = q.w, x[1] = q.x, x[2] = q.y, x[3] = q.z;
  for (std::size_t i = 0; i < 3; ++i) x[momentum + i] = of.momentum[int(i)];
  const auto& settling = of.settling;
  for (std::size_t i = 0; i < settling.count; ++i)
    for (std::size_t k = 0; k < settling.count; ++k)
      x[mode + i] += settling.to_mode[i][k] * of.wheels.laws[settling.wheel[k]].momentum;
  return x;
}

template <Real Real_, int most>
auto StiffSystem<Real_, most>::scale() const noexcept -> Numbers {
  const auto full = scale_of<Scalar, true>(*of_);
  Numbers made{1, 1, 1, 1, full[4], full[5], full[6], 1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i) made[velocity + i] = full[At::velocity + i];
  const auto& settling = of_->settling;
  for (std::size_t i = 0; i < settling.count; ++i) {
    Scalar least = infinity<Scalar>;
    for (std::size_t k = 0; k < settling.count; ++k) {
      const Scalar share = std::abs(settling.to_wheel[k][i]);
      if (share > 0) least = std::min(least, full[At::wheel(settling.wheel[k])] / share);
    }
    made[mode + i] = least;
  }
  return made;
}

template <Real Real_, int most>
auto StiffSystem<Real_, most>::instant(Scalar t) const noexcept -> Instant {
  const Scalar s = t - piece_->from;
  Instant made{piece_->power[0], {}, {}};
  Scalar power = 1;
  for (std::size_t k = 1; k < 4; ++k)
    if (power *= s; piece_->power[k].any()) made.terms.add(power, piece_->power[k]);
  for (const auto& wave : piece_->waves)
    made.terms.add(wave.cubic(t) * clock_angle(wave.rate, t, wave.phase).sine, wave.terms);
  if (has_.field) made.field = field_at(of_->problem, t);
  if (has_.orbit) {
    made.orbit = orbit_at(*of_->problem.orbit, t);
    const Vec3<Scalar> axes[] = {made.orbit.radial, made.orbit.along,
                                 cross<Scalar>(made.orbit.radial, made.orbit.along)};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) made.terms.inertial[k] += axes[j][int(k)] * made.terms.orbital[j];
  }
  if (has_.field && !made.terms.dipole.isZero(0))
    for (std::size_t k = 0; k < 3; ++k)
      made.terms.inertial[k] += made.field.flux_density[int(k)] * cross_matrix<Scalar>(made.terms.dipole);
  return made;
}

template <Real Real_, int most>
void StiffSystem<Real_, most>::take_motors(const Row& t, Moment& now) const noexcept {
  const auto& settling = of_->settling;
  Scalar momentum_at[3][4], drive[most][4] = {};
  for (int lane = 0; lane < 4; ++lane) {
    const Vec3<Scalar> known = piece_->momentum_at(t[lane]);
    for (int i = 0; i < 3; ++i) momentum_at[i][lane] = known[i];
    for (std::size_t k = 0; k < settling.count; ++k) {
      const Scalar T = piece_->wheels[settling.wheel[k]].at(t[lane] - piece_->from);
      for (std::size_t i = 0; i < settling.count; ++i) drive[i][lane] += settling.to_mode[i][k] * T;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) now.momentum[i] = load(momentum_at[i]);
  for (int i = 0; i < most; ++i) now.drive[i] = load(drive[i]);
}

template <Real Real_, int most>
auto StiffSystem<Real_, most>::moment(const Row& t) const noexcept -> Moment {
  Moment now;
  take_motors(t, now);
  const Instant at[] = {instant(t[0]), instant(t[1]), instant(t[2]), instant(t[3])};
  const auto number = [&](const auto& get) noexcept { return lanes(get(at[0]), get(at[1]), get(at[2]), get(at[3])); };
  const auto vector = [&](const auto& get) noexcept {
    Vector made;
    for (int i = 0; i < 3; ++i) made[std::size_t(i)] = number([&](const Instant& one) noexcept { return get(one)[i]; });
    return made;
  };
  const auto matrix = [&](const auto& get) noexcept {
    Matrix made;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        made[std::size_t(i)][std::size_t(j)] = number([&](const Instant& one) noexcept { return get(one)(i, j); });
    return made;
  };
  now.body = vector([](const Instant& one) noexcept -> const auto& { return one.terms.body; });
  if (!has_.moving) return now;
  if (has_.rate) now.by_rate = matrix([](const Instant& one) noexcept -> const auto& { return one.terms.by_rate; });
  if (has_.momentum)
    now.by_momentum = matrix([](const Instant& one) noexcept -> const auto& { return one.terms.by_momentum; });
  for (std::size_t k = 0; has_.inertial && k < 3; ++k)
    now.inertial[k] = matrix([k](const Instant& one) noexcept -> const auto& { return one.terms.inertial[k]; });
  if (has_.gradient) now.gradient = number([](const Instant& one) noexcept { return one.terms.gradient; });
  if (has_.orbit_gradient) {
    now.orbit_gradient =
        number([](const Instant& one) noexcept { return one.terms.orbit_gradient * one.orbit.gradient; });
    now.radial = vector([](const Instant& one) noexcept -> const auto& { return one.orbit.radial; });
  }
  if (has_.eddy) {
    now.eddy = matrix([](const Instant& one) noexcept -> const auto& { return one.terms.eddy; });
    now.field = vector([](const Instant& one) noexcept -> const auto& { return one.field.flux_density; });
    now.field_rate = vector([](const Instant& one) noexcept -> const auto& { return one.field.rate; });
  }
  if (has_.total_brake)
    now.brake_total = vector([](const Instant& one) noexcept -> const auto& { return one.terms.brake_total; });
  if (has_.carrier_brake)
    now.brake_carrier = vector([](const Instant& one) noexcept -> const auto& { return one.terms.brake_carrier; });
  if (has_.force_body)
    now.force_body = vector([](const Instant& one) noexcept -> const auto& { return one.terms.force_body; });
  if (has_.force_inertial)
    now.force_inertial = vector([](const Instant& one) noexcept -> const auto& { return one.terms.force_inertial; });
  return now;
}

template <Real Real_, int most>
GYROSTAT_INLINE void StiffSystem<Real_, most>::sources(const Moment& now, const Row* y, Row* source) const noexcept {
  Row G[3];
  for (int i = 0; i < 3; ++i) G[i] = y[momentum + i] - now.momentum[std::size_t(i)];
  for (int k = 0; k < most; ++k)
    source[k] =
        multiply_add(lanes(pull_[k][0]), G[0],
                     multiply_add(lanes(pull_[k][1]), G[1], multiply_add(lanes(pull_[k][2]), G[2], now.drive[k])));
}

template <Real Real_, int most>
GYROSTAT_INLINE void StiffSystem<Real_, most>::rates(const Moment& now, const Row* y, const Row* z,
                                                     Row* rate) const noexcept {
  const Row zero = lanes(Scalar(0));
  Vector G, w, half;
  for (std::size_t i = 0; i < 3; ++i) {
    G[i] = y[momentum + int(i)] - now.momentum[i];
    for (int k = 0; k < most; ++k) G[i] = multiply_add(lanes(-axis_[k][i]), z[k], G[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = multiply_add(lanes(inverse_[i][0]), G[0],
                        multiply_add(lanes(inverse_[i][1]), G[1], lanes(inverse_[i][2]) * G[2]));
    half[i] = lanes(Scalar(0.5L)) * w[i];
  }
  rate[0] = zero - multiply_add(y[1], half[0], multiply_add(y[2], half[1], y[3] * half[2]));
  rate[1] = multiply_add(y[0], half[0], multiply_add(y[2], half[2], zero - y[3] * half[1]));
  rate[2] = multiply_add(y[0], half[1], multiply_add(y[3], half[0], zero - y[1] * half[2]));
  rate[3] = multiply_add(y[0], half[2], multiply_add(y[1], half[1], zero - y[2] * half[0]));
  Acting acting{now.body, {zero, zero, zero}};
  if (has_.moving) act(now, y, w, acting);
  const Vector spin = detail::cross_rows3<Scalar>({y[momentum], y[momentum + 1], y[momentum + 2]}, w);
  const Row per_mass = lanes(1 / of_->problem.mass);
  for (int i = 0; i < 3; ++i) {
    const auto j = std::size_t(i);
    rate[momentum + i] = spin[j] + acting.torque[j];
    rate[turn + i] = w[j];
    rate[velocity + i] = per_mass * acting.force[j];
    rate[position + i] = y[velocity + i];
  }
  for (int k = 0; k < most; ++k) rate[passed + k] = z[k];
}

template <Real Real_, int most>
void StiffSystem<Real_, most>::act(const Moment& now, const Row* y, const Vector& w, Acting& acting) const noexcept {
  using namespace detail;
  Vector torque = acting.torque;
  const Vector M{y[momentum], y[momentum + 1], y[momentum + 2]};
  if (has_.rate) take_rows<Scalar>(torque, times<Scalar>(now.by_rate, w));
  if (has_.momentum) take_rows<Scalar>(torque, times<Scalar>(now.by_momentum, M));
  const auto times_J = [&](const Vector& v) noexcept {
    Vector made;
    const auto& J = of_->wheels.whole;
    for (int i = 0; i < 3; ++i)
      made[std::size_t(i)] =
          multiply_add(lanes(J(i, 0)), v[0], multiply_add(lanes(J(i, 1)), v[1], lanes(J(i, 2)) * v[2]));
    return made;
  };
  const auto brake = [&](const Vector& size, const Vector& U) noexcept {
    const Row square = dot_rows<Scalar>(U, U);
    const auto one_over = [&](int lane) noexcept { return 1 / std::sqrt(square[lane]); };
    const Row inverse = lanes(one_over(0), one_over(1), one_over(2), one_over(3));
    for (std::size_t i = 0; i < 3; ++i) torque[i] = torque[i] - size[i] * U[i] * inverse;
  };
  if (has_.total_brake) brake(now.brake_total, M);
  if (has_.carrier_brake) brake(now.brake_carrier, times_J(w));
  // row k of R: inertial axis k as the body sees it
  const Row one = lanes(Scalar(1)), two = lanes(Scalar(2));
  const auto product = [&](int i, int j) noexcept { return two * y[i] * y[j]; };
  const Matrix R{{{one - product(2, 2) - product(3, 3), product(1, 2) - product(0, 3), product(1, 3) + product(0, 2)},
                  {product(1, 2) + product(0, 3), one - product(1, 1) - product(3, 3), product(2, 3) - product(0, 1)},
                  {product(1, 3) - product(0, 2), product(2, 3) + product(0, 1), one - product(1, 1) - product(2, 2)}}};
  const auto to_body = [&](const Vector& v_I) noexcept {
    Vector made;
    for (std::size_t j = 0; j < 3; ++j)
      made[j] = multiply_add(R[0][j], v_I[0], multiply_add(R[1][j], v_I[1], R[2][j] * v_I[2]));
    return made;
  };
  const auto add_gradient = [&](const Row& size, const Vector& d) noexcept {
    Vector shape = cross_rows3<Scalar>(d, times_J(d));
    scale_rows<Scalar>(shape, size);
    add_rows<Scalar>(torque, shape);
  };
  for (std::size_t k = 0; has_.inertial && k < 3; ++k) add_rows<Scalar>(torque, times<Scalar>(now.inertial[k], R[k]));
  if (has_.gradient) {
    const Vec3<Scalar>& down = of_->problem.field.down;
    add_gradient(now.gradient, to_body({lanes(down[0]), lanes(down[1]), lanes(down[2])}));
  }
  if (has_.orbit_gradient) add_gradient(now.orbit_gradient, to_body(now.radial));
  if (has_.eddy) {
    const Vector B = to_body(now.field);
    Vector seen = cross_rows3<Scalar>(w, B);
    take_rows<Scalar>(seen, to_body(now.field_rate));
    add_rows<Scalar>(torque, cross_rows3<Scalar>(times<Scalar>(now.eddy, seen), B));
  }
  if (has_.force_body) acting.force = times<Scalar>(R, now.force_body);
  if (has_.force_inertial) add_rows<Scalar>(acting.force, now.force_inertial);
  acting.torque = torque;
}

template <Real Real_, int most>
void StiffSystem<Real_, most>::project(Scalar t, Scalar* x, Scalar* low) const noexcept {
  Scalar missing = 1, along = 0;
  for (int i = 0; i < 4; ++i) missing -= x[i] * x[i];
  for (int i = 0; i < 4; ++i) along += x[i] * low[i];
  const Scalar stretch = missing / 2 - along;
  for (int i = 0; i < 4; ++i) add_to(x[i], low[i], stretch * x[i]);
  if (!known_) return;
  static_assert(momentum == 4);
  const Vec3<Scalar> lacks = known_.missing(t, x, low);
  for (int i = 0; i < 3; ++i) add_to(x[momentum + i], low[momentum + i], lacks[i]);
}

template <Real Real_, int most>
auto StiffSystem<Real_, most>::state(const Piece<Scalar>& piece, Scalar t, const Scalar* x) const noexcept
    -> State<Scalar> {
  std::array<Scalar, At::width> full{};
  std::copy_n(x, 7, full.begin());
  if (known_) {
    // also between the steps, where M itself is good to a share of its scale only
    const Quat<Scalar> q = normalised(Quat<Scalar>{x[0], x[1], x[2], x[3]});
    const Vec3<Scalar> M = rotate<Scalar>(conjugate(q), known_.at(t));
    for (int i = 0; i < 3; ++i) full[std::size_t(At::momentum + i)] = M[i];
  }
  std::copy_n(x + turn, 3, full.begin() + At::turned);
  std::copy_n(x + velocity, 3, full.begin() + At::velocity);
  std::copy_n(x + position, 3, full.begin() + At::position);
  const auto& settling = of_->settling;
  for (std::size_t k = 0; k < settling.count; ++k) {
    const std::size_t wheel = settling.wheel[k];
    const auto& law = of_->wheels.laws[wheel];
    Scalar p = 0, integral = 0;
    for (std::size_t i = 0; i < settling.count; ++i) {
      p += settling.to_wheel[k][i] * x[mode + int(i)];
      integral += settling.to_wheel[k][i] * x[passed + int(i)];
    }
    full[At::wheel(wheel)] = p;
    full[At::angle(wheel)] = law.angle + (integral / law.axial_inertia - law.axis.dot(turned(x)));
  }
  return state_of<Scalar, true>(*of_, piece, t, full.data());
}

}  // namespace gyrostat::general
