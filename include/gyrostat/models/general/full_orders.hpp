// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/series.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The recurrences of FullSystem, order by order.
namespace gyrostat::general {

template <Real Real_, bool large>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_, large>::turn_seen(Index k, int i, Work<Order>& work,
                                                         Ahead& ahead) const noexcept {
  const auto &o = work.rate.v, &o_turned = work.rate.turned;
  auto& seen = work.seen[i];
  Row first = lanes(Scalar(0)), second = first;
  const auto add = [&](int j, int at, Row& sum_1, Row& sum_2) GYROSTAT_INLINE_LAMBDA {
    sum_1 = multiply_add(seen.v[j], o_turned[at], sum_1);
    sum_2 = multiply_add(seen.turned[j], o[at], sum_2);
  };
  if (k % 2 == 1) {
    auto& next = ahead.seen[i];
    next[0] = next[1] = first;
    count_down<Scalar>(k, [&](int j) GYROSTAT_INLINE_LAMBDA {
      add(j, k - j, first, second);
      add(j, k + 1 - j, next[0], next[1]);
    });
  } else {
    first = ahead.seen[i][0], second = ahead.seen[i][1];
    add(k, 0, first, second);
  }
  add(0, k, first, second);
  seen.set(k + 1, over_next(shuffle<1, 2, 0, 3>(first - second), k));
}

template <Real Real_, bool large>
template <class Index, int Order>
GYROSTAT_INLINE auto FullSystem<Real_, large>::orbit_gradient_torque(Index k, const Scalar (&x)[Order + 1][width],
                                                                     Work<Order>& work,
                                                                     const Constants& c) const noexcept -> Row {
  if constexpr (!std::is_same_v<Index, std::integral_constant<int, 0>>) work.orbit_turn.extend(k);
  work.outward.extend(k, load(&x[k][At::attitude]), work.orbit_turn);
  work.orbit_gradient[k] = shape_(work.outward.v, k);
  return lanes(c.unit * orbit_gradient_) * work.orbit_gradient[k];
}

template <Real Real_, bool large>
template <class Index, int Order>
GYROSTAT_INLINE void FullSystem<Real_, large>::extend(Index k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                                      Row& newest, Ahead& ahead, const Constants& c) const noexcept {
  const auto &o = work.rate.v, &o_turned = work.rate.turned;
  // M_j x w_(k-j) but for j = 0 and k
  Row known = lanes(Scalar(0)), known_2 = known;
  const auto add = [&](int j, int at, Row& sum_1, Row& sum_2) GYROSTAT_INLINE_LAMBDA {
    sum_1 = multiply_add(load(&x[j][At::momentum]), o_turned[at], sum_1);
    sum_2 = multiply_add(work.momentum_turned[j], o[at], sum_2);
  };
  if (k % 2 == 1) {
    auto& next = ahead.momentum;
    next[0] = next[1] = known;
    count_down<Scalar>(k - 1, [&](int j) GYROSTAT_INLINE_LAMBDA {
      add(j, k - j, known, known_2);
      if (j > 1) add(j, k + 1 - j, next[0], next[1]);
    });
  } else {
    known = ahead.momentum[0], known_2 = ahead.momentum[1];
    if (k > 2) add(k - 1, 1, known, known_2);
    add(1, k - 1, known, known_2);
  }
  known = shuffle<1, 2, 0, 3>(known - known_2);

  Row rate = c.rate * newest;
  if constexpr (large)
    for (int i = 0; i < wheel_count_; ++i) {
      const Row p = lanes(x[k][At::wheel(std::size_t(wheel_[std::size_t(i)]))]);
      rate = multiply_add(p, c.wheel_rate[i], rate), known = multiply_add(p, c.wheel_torque[i], known);
    }
  if (k < 5 && polynomial_) rate = rate + work.known_wheels[k], known = known + work.known_torque[k];
  work.rate.set(k, rate);
  work.momentum_turned[k] = shuffle<1, 2, 0, 3>(newest);
  for (int i = 0; i < directions_.count; ++i) {
    known = c.direction[i].times(work.seen[i].v[k], known);
    turn_seen(k, i, work, ahead);
  }
  if (sees_.orbit_gradient) known = known + orbit_gradient_torque(k, x, work, c);
  store(&x[k + 1][0], over_next(lanes(Scalar(0.5L)) * work.turn.extend(k, x, 0, rate), k));
  store(&x[k + 1][At::turned], over_next(rate, k));
  if (drives_) known = known + work.drive[k];
  if (has_rest_) known = known + rest(k, x, work, c);
  if constexpr (large) turn_wheels(k, x, work, c.unit);
  newest = over_next(c.jacobian.times(newest, known), k);
  store(&x[k + 1][At::momentum], newest);
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width],
                                      Work<Order>& work) const noexcept {
  const Row time = lanes(unit);
  Constants c;
  c.unit = unit;
  c.first_momentum = load(&x[0][At::momentum]);
  c.damping = steady_.by_rate;
  Row carried = known_wheels_[0];
  if (polynomial_) {
    const Row s = lanes(t - piece_.from);
    carried = known_wheels_[4];
    for (int k = 3; k >= 0; --k) carried = multiply_add(s, carried, known_wheels_[k]);
  }
  Row body = c.first_momentum - carried;
  for (int i = 0; i < wheel_count_; ++i) {
    c.wheel_rate[i] = time * by_wheel_[i];
    c.wheel_torque[i] = c.torque_by(c.wheel_rate[i]);
    if constexpr (large)
      body = multiply_add(lanes(-x[0][At::wheel(std::size_t(wheel_[std::size_t(i)]))]), wheel_axis_[i], body);
  }
  for (int j = 0; j < 3; ++j) c.rate.of[j] = time * inertia_inverse_.of[j];
  const Row rate = c.rate * body;
  for (int j = 0; j < 3; ++j) {
    const Row unit_axis = lanes(Scalar(j == 0), Scalar(j == 1), Scalar(j == 2), Scalar(0));
    c.jacobian.of[j] = c.torque_by(c.rate.of[j]) - cross_rows(rate, unit_axis);
    if (steady_.has_momentum) c.jacobian.of[j] = c.jacobian.of[j] - time * steady_.by_momentum.of[j];
  }
  for (int i = 0; i < directions_.count; ++i)
    for (int j = 0; j < 3; ++j) c.direction[i].of[j] = time * steady_.direction[i].of[j];

  work.rate.set(0, rate);
  work.momentum_turned[0] = shuffle<1, 2, 0, 3>(c.first_momentum);
  store(&x[1][0], lanes(Scalar(0.5L)) * work.turn.begin(x, 0, rate));
  store(&x[1][At::turned], rate);
  begin(t, x, work, c);
  Row newest = c.torque_by(rate) + time * (steady_.body - steady_.by_momentum * c.first_momentum);
  if (drives_) newest = newest + work.drive[0];
  if (sees_.orbit_gradient) newest = newest + orbit_gradient_torque(std::integral_constant<int, 0>{}, x, work, c);
  for (int i = 0; i < directions_.count; ++i) {
    auto& seen = work.seen[i];
    newest = c.direction[i].times(seen.v[0], newest);
    seen.set(1, cross_rows(seen.v[0], rate));
  }
  if (has_rest_) newest = newest + rest(0, x, work, c);
  if constexpr (large) turn_wheels(0, x, work, unit);
  store(&x[1][At::momentum], newest);

  Ahead ahead;
  const auto next = [&](auto k) GYROSTAT_INLINE_LAMBDA { extend(k, x, work, newest, ahead, c); };
  if constexpr (Order == 20) {  // that of the ladder; others, of which little is compiled so, are slower by a twentieth
    count_up<Scalar, Order - 1>(next);
  } else {
    int k = 1;
    for (; k + 1 < Order; k += 2) next(k), next(k + 1);
    if (k < Order) next(k);
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::begin(Scalar t, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                     const Constants& c) const noexcept {
  const Scalar unit = c.unit, s = t - piece_.from;
  const Quat<Scalar> q = conjugate(Quat<Scalar>{x[0][0], x[0][1], x[0][2], x[0][3]});
  // of unit length but for rounding, so that first order sets it right
  const Scalar share = 2 - (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const auto to_body = [&](const Vec3<Scalar>& v_I) noexcept {
    return row<Scalar>(v_I + share * Vec3<Scalar>(rotate<Scalar>(q, v_I) - v_I));
  };
  for (int i = 0; i < directions_.count; ++i) work.seen[i].set(0, to_body(directions_.of[std::size_t(i)]));
  if (polynomial_) {
    // the coefficients about s, by Horner's scheme repeated
    auto h = piece_.momentum;
    Scalar scale = -1;
    for (std::size_t k = 0; k < 5; ++k, scale *= unit) {
      for (std::size_t j = 4; j > k; --j) h[j - 1] += s * h[j];
      work.known_wheels[k] = c.rate * row<Scalar>(scale * h[k]),
      work.known_torque[k] = c.torque_by(work.known_wheels[k]);
    }
  }
  if constexpr (large) {
    Scalar push[4][8] = {};
    for (int i = 0; i < wheel_count_; ++i) {
      const auto wheel = std::size_t(wheel_[std::size_t(i)]);
      const auto& T = piece_.wheels[wheel].c;
      const Cubic<Scalar> about = Cubic<Scalar>{Scalar(0), {T[0], T[1], T[2], T[3]}}.about(s);
      Scalar scale = unit;
      for (std::size_t k = 0; k < 4; ++k, scale *= unit) push[k][wheel] = scale * about.c[k];
    }
    for (int half = 0; half < halves_; ++half)
      for (int k = 0; k < 4; ++k) work.push[half][k] = load(&push[k][4 * half]);
    if (moves_centre_) {
      // without a force the centre goes on as it does
      for (int k = 1; k <= Order; ++k)
        for (int lane = At::velocity; lane < width; lane += 4) store(&x[k][lane], lanes(Scalar(0)));
      store(&x[1][At::position], lanes(unit) * load(&x[0][At::velocity]));
    }
  }
  if (!sources_.empty() || sees_.force) begin_factors(t, work, unit);
  if (!has_rest_ && !sees_.orbit_gradient) return;
  OrbitPoint<Scalar> at;
  if (sees_.orbit_gradient || sees_.orbit_axes) {
    at = orbit_at(*of_.problem.orbit, t);
    if (sees_.orbit_gradient) {
      work.orbit_turn.begin(*of_.problem.orbit, at, unit);
      work.outward.begin(at, (1 + share) / 2);
    }
    if (sees_.orbit_axes) {
      work.orbit.set(*of_.problem.orbit, at, unit);
      work.seen[radial].set(0, to_body(at.radial));
      work.seen[along].set(0, to_body(at.along));
    }
  }
  if (sees_.field && of_.problem.field.magnetic == MagneticField::rotating) {
    const Vec3<Scalar>& k = of_.problem.field.axis;
    const Vec3<Scalar> B = field_at(of_.problem, t).flux_density, part = B - k * k.dot(B);
    work.seen[across].set(0, to_body(part));
    work.seen[leading].set(0, to_body(cross<Scalar>(k, part)));
  }
  begin_field(t, at, work, unit);
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::begin_field(Scalar, const OrbitPoint<Scalar>& at, Work<Order>& work,
                                           Scalar) const noexcept {
  const auto& field = of_.problem.field;
  if (!sees_.field) return;
  if (field.magnetic == MagneticField::dipole) {
    const Scalar ratio = field.radius / at.radius, b = field.strength * ratio * ratio * ratio;
    const auto& gradient = work.orbit.gradient;
    const auto cosine = work.orbit.cosine_of(at, field.axis);
    work.strength.last = gradient.last;
    for (int k = 0; k <= gradient.last; ++k) work.strength.c[k] = b / at.gradient * gradient.c[k];
    work.strength_out.last = Order;
    for (int k = 0; k <= Order; ++k) work.strength_out.c[k] = -3 * work.strength.times(cosine.c, k);
  }
  see_field(0, work);
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::begin_factors(Scalar t, Work<Order>& work, Scalar unit) const noexcept {
  const auto clear = [](auto& rows) noexcept { std::fill_n(rows, Order + 1, lanes(Scalar(0))); };
  if (drives_) clear(work.drive);
  if (sees_.force) {
    clear(work.force_body), clear(work.force_inertial);
    work.force_body[0] = row(piece_.power[0].force_body);
    work.force_inertial[0] = row(piece_.power[0].force_inertial);
  }
  int next = 0;
  for (const Source& source : sources_) {
    const auto* wave = source.power > 0 ? nullptr : &piece_.waves[std::size_t(source.wave)];
    const Terms<Scalar>& terms = wave ? wave->terms : piece_.power[std::size_t(source.power)];
    NumberSeries<Scalar, Order> factor;
    if (wave) {
      factor.set(wave->cubic.about(t), unit, wave->rate, wave->phase);
    } else {
      Cubic<Scalar> power{piece_.from, {}};
      power.c[std::size_t(source.power)] = 1;
      factor.set(power.about(t), unit);
    }
    const auto add = [&factor](auto& rows, const Row& by) noexcept {
      for (int k = 0; k <= factor.last; ++k) rows[k] = multiply_add(lanes(factor.c[k]), by, rows[k]);
    };
    if (source.drives) add(work.drive, lanes(unit) * row(terms.body));
    if (source.forces) add(work.force_body, row(terms.force_body)), add(work.force_inertial, row(terms.force_inertial));
    if (source.moves) work.factor[next++] = factor;
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::see_field(int k, Work<Order>& work) const noexcept {
  const auto& field = of_.problem.field;
  const auto by_directions = [&](const Vec3<Scalar>& v_I, int order) noexcept {
    Row sum = lanes(Scalar(0));
    for (int i = 0; i < directions_.count; ++i)
      sum = multiply_add(lanes(directions_.share(i, v_I)), work.seen[i].v[order], sum);
    return sum;
  };
  switch (field.magnetic) {
    case MagneticField::none: break;
    case MagneticField::uniform: work.field.set(k, by_directions(field.flux_density, k)); break;
    case MagneticField::rotating:
      work.field.set(k, work.seen[across].v[k] + by_directions(field.axis * field.axis.dot(field.flux_density), k));
      break;
    case MagneticField::dipole: {
      Row sum = work.strength_out.times(work.seen[radial].v, k);
      for (int j = std::min(work.strength.last, k); j >= 0; --j)
        sum = multiply_add(lanes(work.strength.c[j]), by_directions(field.axis, k - j), sum);
      work.field.set(k, sum);
      break;
    }
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::see(int k, Work<Order>& work, Scalar unit) const noexcept {
  const auto pair = [&](int first, int second, const auto& turning) noexcept {
    auto &a = work.seen[first], &b = work.seen[second];
    const auto &o = work.rate.v, &o_turned = work.rate.turned;
    Row a_1 = lanes(Scalar(0)), a_2 = a_1, b_1 = a_1, b_2 = a_1;
    for (int j = k; j >= 0; --j) {
      const Row &w = o[k - j], &w_turned = o_turned[k - j];
      a_1 = multiply_add(a.v[j], w_turned, a_1), a_2 = multiply_add(a.turned[j], w, a_2);
      b_1 = multiply_add(b.v[j], w_turned, b_1), b_2 = multiply_add(b.turned[j], w, b_2);
    }
    const Row a_rate = shuffle<1, 2, 0, 3>(a_1 - a_2) + turning.times(b.v, k);
    const Row b_rate = shuffle<1, 2, 0, 3>(b_1 - b_2) - turning.times(a.v, k);
    a.set(k + 1, over_next(a_rate, k)), b.set(k + 1, over_next(b_rate, k));
  };
  if (sees_.orbit_axes) pair(radial, along, work.orbit.rate);
  const auto& field = of_.problem.field;
  if (sees_.field && field.magnetic == MagneticField::rotating) {
    NumberSeries<Scalar, Order> turning;
    turning.set_constant(unit * field.rate);
    pair(across, leading, turning);
  }
  if (sees_.field) {
    see_field(k + 1, work);
    work.induced[k] = lanes(-Scalar(k + 1)) * work.field.v[k + 1];
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::oppose(int which, int k, const Row& opposed, Work<Order>& work) const noexcept {
  auto &U = work.opposed[which], &z = work.opposed_unit[which];
  auto& size = work.opposed_size[which];
  U[k] = opposed;
  Row square = lanes(Scalar(0)), rest = opposed;
  for (int j = 0; j <= k; ++j) square = multiply_add(U[j], U[k - j], square);
  const Scalar total = sum(square)[0];
  if (k == 0) {
    using std::sqrt;
    size[0] = sqrt(total);
  } else {
    size[k] = math::square_root(total, size, k, 1 / (2 * size[0]));
  }
  for (int j = 1; j <= k; ++j) rest = rest - lanes(size[j]) * z[k - j];
  z[k] = lanes(1 / size[0]) * rest;
}

template <Real Real_, bool large>
template <int Order>
auto FullSystem<Real_, large>::nonlinear_torque(const Part<Scalar>& part, int k, typename Work<Order>::Vectors& current,
                                                Work<Order>& work, Scalar unit) const noexcept -> Row {
  Row sum = lanes(Scalar(0));
  if (part.has_orbital) sum = part.radial.times(work.seen[radial].v[k], part.along.times(work.seen[along].v[k], sum));
  if (part.gradient != 0) sum = multiply_add(lanes(part.gradient), work.gradient[k], sum);
  if (part.orbit_gradient != 0) sum = multiply_add(lanes(part.orbit_gradient), work.orbit_gradient[k], sum);
  if (part.has_dipole) sum = sum + cross_rows(part.dipole, work.field.v[k]);
  if (part.has_total) sum = sum - part.brake_total * work.opposed_unit[0][k];
  if (part.has_carrier) sum = sum - part.brake_carrier * work.opposed_unit[1][k];
  sum = lanes(unit) * sum;
  if (part.has_eddy) {
    current.set(k, part.eddy * work.induced[k]);
    sum = sum + cross_term(current, work.field, k);
  }
  return sum;
}

template <Real Real_, bool large>
template <int Order>
auto FullSystem<Real_, large>::linear(const Part<Scalar>& part, int k, const Scalar (&x)[Order + 1][width],
                                      const Work<Order>& work, Scalar unit) const noexcept -> Row {
  Row sum = lanes(Scalar(0));
  if (part.has_momentum) sum = sum - part.by_momentum * load(&x[k][At::momentum]);
  if (part.has_directions)
    for (int i = 0; i < directions_.count; ++i) sum = part.direction[i].times(work.seen[i].v[k], sum);
  sum = lanes(unit) * sum;
  if (part.has_rate) sum = sum - part.by_rate * work.rate.v[k];
  return sum;
}

template <Real Real_, bool large>
template <int Order>
auto FullSystem<Real_, large>::rest(int k, Scalar (&x)[Order + 1][width], Work<Order>& work,
                                    const Constants& c) const noexcept -> Row {
  const Scalar unit = c.unit;
  see(k, work, unit);
  if (sees_.total_brake) oppose(0, k, load(&x[k][At::momentum]), work);
  if (sees_.carrier_brake) oppose(1, k, whole_ * work.rate.v[k], work);
  if (sees_.down) {
    Row down = lanes(Scalar(0));
    for (int i = 0; i < directions_.count; ++i)
      down = multiply_add(lanes(directions_.share(i, of_.problem.field.down)), work.seen[i].v[k], down);
    work.down.set(k, down);
    work.gradient[k] = shape_(work.down, k);
  }
  Row sum = nonlinear_torque(steady_, k, work.current[0], work, unit);
  for (int i = 0; i < factors_; ++i) {
    const auto& part = parts_[std::size_t(i)];
    work.torque[i][k] = nonlinear_torque(part, k, work.current[i + 1], work, unit) + linear(part, k, x, work, unit);
    sum = sum + work.factor[i].times(work.torque[i], k);
  }
  if constexpr (large)
    if (sees_.force) move_centre(k, x, work, unit);
  return sum;
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::turn_wheels(int k, Scalar (&x)[Order + 1][width], const Work<Order>& work,
                                           Scalar unit) const noexcept {
  const Row rate = work.rate.v[k];
  for (int half = 0; half < halves_; ++half) {
    const std::size_t p = At::wheel(4 * std::size_t(half)), angle = At::angle(4 * std::size_t(half));
    const auto& u = axes_[half];
    const Row along_axes =
        multiply_add(u[0], shuffle<0, 0, 0, 0>(rate),
                     multiply_add(u[1], shuffle<1, 1, 1, 1>(rate), u[2] * shuffle<2, 2, 2, 2>(rate)));
    const Row turning = lanes(unit) * inverse_[half] * load(&x[k][p]) - along_axes, slowed = friction_[half] * turning;
    store(&x[k + 1][p], over_next(k < 4 ? work.push[half][k] - slowed : lanes(Scalar(0)) - slowed, k));
    store(&x[k + 1][angle], over_next(turning, k));
  }
}

template <Real Real_, bool large>
template <int Order>
void FullSystem<Real_, large>::move_centre(int k, Scalar (&x)[Order + 1][width], const Work<Order>& work,
                                           Scalar unit) const noexcept {
  Row force = work.force_inertial[k];
  if (sees_.body_force) {
    Scalar component[3];
    for (int i = 0; i < 3; ++i) {
      Row product = lanes(Scalar(0));
      for (int j = 0; j <= k; ++j) product = multiply_add(work.seen[i].v[k - j], work.force_body[j], product);
      component[i] = sum(product)[0];
    }
    force = force + lanes(component[0], component[1], component[2], Scalar(0));
  }
  store(&x[k + 1][At::velocity], over_next(lanes(unit / of_.problem.mass) * force, k));
  store(&x[k + 1][At::position], over_next(lanes(unit) * load(&x[k][At::velocity]), k));
}

}  // namespace gyrostat::general
