// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/table.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// All torques of a problem summed, so that neither stepping nor recognition sees how many there are (docs/general.md, section 1.2).
namespace gyrostat::general {

/// The coefficients of a sum of torques, body axes:
///     tau = body - by_rate w - by_momentum M - (brake_total_j U_j/|U| e_j, U = M) - (brake_carrier_j U_j/|U| e_j, U = J w)
///         + sum_j (inertial[j] e_j + orbital[j] o_j) + gradient d x J d + orbit_gradient N rh x J rh + dipole x B + (eddy (w_rel x B)) x B,
/// e_j being the inertial axes and o_j radial, along track and normal of the orbit as the body sees them, d down, N = 3 mu/r^3 and B the
/// magnetic field. A uniform field is constant in inertial axes, so its torque on a dipole stands in `inertial`.
template <Real Scalar>
struct Terms {
  Vec3<Scalar> body{0, 0, 0};                       ///< N m
  Mat3<Scalar> by_rate = Mat3<Scalar>::Zero();      ///< N m s/rad; charge is its skew part, and by_carrier J is in it
  Mat3<Scalar> by_carrier = Mat3<Scalar>::Zero();   ///< what opposes J w, apart, 1/s
  Mat3<Scalar> by_momentum = Mat3<Scalar>::Zero();  ///< 1/s
  Vec3<Scalar> brake_total{0, 0, 0}, brake_carrier{0, 0, 0};          ///< N m
  std::array<Mat3<Scalar>, 3> inertial = zeros(), orbital = zeros();  ///< N m
  Scalar gradient = 0;                                                ///< 1/s^2, of the field that stands still
  Scalar orbit_gradient = 0;                                          ///< multiple of the orbit's gravity gradient
  Vec3<Scalar> dipole{0, 0, 0};                                       ///< in a field that moves, A m^2
  Mat3<Scalar> eddy = Mat3<Scalar>::Zero();                           ///< S m^4
  Vec3<Scalar> force_body{0, 0, 0}, force_inertial{0, 0, 0};          ///< that moves the mass centre of a free body, N

  /// action(coefficient of each...) for each coefficient of some sums.
  template <class Action, class... Sums>
  static void each(const Action& action, Sums&... of) noexcept {
    action(of.body...), action(of.by_rate...), action(of.by_carrier...), action(of.by_momentum...);
    action(of.brake_total...), action(of.brake_carrier...);
    for (std::size_t j = 0; j < 3; ++j) action(of.inertial[j]...), action(of.orbital[j]...);
    action(of.gradient...), action(of.orbit_gradient...);
    action(of.dipole...), action(of.eddy...);
    action(of.force_body...), action(of.force_inertial...);
  }
  /// Adds a multiple of another sum.
  void add(Scalar times, const Terms& other) noexcept {
    each([times](auto& mine, const auto& its) noexcept { mine += times * its; }, *this, other);
  }
  /// The same, with what rounding leaves over of it added to `low`: terms may all but cancel.
  void add(Scalar times, const Terms& other, Terms& low) noexcept {
    each(
        [times](auto& mine, const auto& its, auto& rest) noexcept {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(mine)>, Scalar>)
            add_product_to(mine, rest, times, its);
          else
            for (Eigen::Index i = 0; i < mine.size(); ++i)
              add_product_to(mine.data()[i], rest.data()[i], times, its.data()[i]);
        },
        *this, other, low);
  }
  /// Adds a multiple of the magnitudes of another sum.
  void add_sizes(Scalar times, const Terms& other) noexcept {
    using std::abs;
    each(
        [size = abs(times)](auto& mine, const auto& its) noexcept {
          using std::abs;
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(mine)>, Scalar>) mine += size * abs(its);
          else mine += size * its.cwiseAbs();
        },
        *this, other);
  }
  /// Whether a torque or force is left.
  bool any() const noexcept {
    bool found = false;
    each(
        [&](const auto& mine) noexcept {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(mine)>, Scalar>) found = found || mine != 0;
          else found = found || !mine.isZero(0);
        },
        *this);
    return found;
  }
  /// Whether a torque is left that depends on the motion.
  bool any_moving() const noexcept {
    Terms moving = *this;
    moving.body.setZero();
    return moving.any_torque();
  }
  /// Whether a torque is left.
  bool any_torque() const noexcept {
    Terms torque = *this;
    torque.force_body.setZero(), torque.force_inertial.setZero();
    return torque.any();
  }

 private:
  static std::array<Mat3<Scalar>, 3> zeros() noexcept {
    return {Mat3<Scalar>::Zero(), Mat3<Scalar>::Zero(), Mat3<Scalar>::Zero()};
  }
};

/// Torques with the same factor over time, summed.
template <Real Scalar>
struct Record {
  Factor<Scalar> factor;  ///< by default 1
  Terms<Scalar> sum;
  Terms<Scalar> size;  ///< the sum of the magnitudes of its terms, which the rounding of `sum` is relative to
};

/// The most wave factors that torques which depend on the motion may have.
inline constexpr std::ptrdiff_t most_waves = 8;

/// All torques of a problem.
template <Real Scalar>
struct Collected {
  /// One record for each factor. The first, which may be empty, is of what acts unchanged over the whole span.
  std::vector<Record<Scalar>> records;

  /// The torques of a problem that check_torques() finds right, over the times from 0 to `span`.
  static Collected of(const Problem<Scalar>& problem, Scalar span) noexcept;

  const Record<Scalar>& steady() const noexcept { return records.front(); }
  /// Whether nothing depends on time by itself (orbit and field aside).
  bool is_steady() const noexcept { return records.size() == 1; }
};

/// Breakpoints up to here are none, s: no step ends before them. The law behind them holds from the start.
template <Real Scalar>
inline constexpr Scalar least_breakpoint = std::numeric_limits<Scalar>::min() / epsilon<Scalar>;

/// The times in (0, span) at which a torque or a wheel of a problem changes its law, increasing.
template <Real Scalar>
std::vector<Scalar> breakpoints(const Problem<Scalar>& problem, Scalar span) noexcept {
  std::vector<Scalar> found;
  const auto take = [&](Scalar t) noexcept {
    if (t > least_breakpoint<Scalar> && t < span) found.push_back(t);
  };
  for (const auto& torque : problem.torques) {
    for (const auto& [from, to] : torque.factor.on)
      if (from < to) take(from), take(to);
    for (const Scalar t : torque.factor.table.times) take(t);
    for (const Scalar t : torque.table.times) take(t);
  }
  for (const auto& wheel : problem.wheels)
    for (const Scalar t : wheel.table.times) take(t);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

namespace detail {

template <Real Scalar>
bool same_table(const Table<Scalar>& a, const Table<Scalar>& b) noexcept {
  return a.times == b.times && a.values == b.values && a.between == b.between && a.holds == b.holds;
}

template <Real Scalar>
bool same_factor(const Factor<Scalar>& a, const Factor<Scalar>& b) noexcept {
  return a.on == b.on && same_table(a.table, b.table) && a.mean == b.mean && a.amplitude == b.amplitude &&
         a.rate == b.rate && a.phase == b.phase;
}

/// Takes what is constant from 0 to `span` out of a factor, and returns it: 0 of what is off all the time.
template <Real Scalar>
Scalar take_constant(Factor<Scalar>& factor, Scalar span) noexcept {
  using std::sin;
  Scalar taken = 1;
  if (!factor.on.empty()) {
    std::erase_if(factor.on, [&](const auto& on) noexcept { return !(on[0] < on[1] && on[1] > 0 && on[0] < span); });
    if (factor.on.empty()) return 0;
  }
  for (const auto& [from, to] : factor.on)
    if (from <= 0 && to >= span) {
      factor.on.clear();
      break;
    }
  if (!factor.table.times.empty() && is_constant(factor.table, span)) {
    taken *= factor.table.values[0];
    factor.table = {};
  }
  if (factor.amplitude == 0 || factor.rate == 0) {
    taken *= factor.amplitude == 0 ? factor.mean : factor.mean + factor.amplitude * sin(factor.phase);
    factor.mean = 1, factor.amplitude = 0, factor.rate = 0, factor.phase = 0;
  }
  return taken;
}

/// A torque as coefficients, without its factor; of a table the unit torque along axis `column`. low: what rounding leaves over of it.
template <Real Scalar>
Terms<Scalar> terms_of(const Problem<Scalar>& problem, const Torque<Scalar>& torque, int column,
                       Terms<Scalar>& low) noexcept {
  Terms<Scalar> made;
  const Mat3<Scalar> unit = Mat3<Scalar>::Identity();
  // the moments of forces that balance each other cancel, and what they leave turns the body
  using Wide = std::conditional_t<std::is_same_v<Scalar, double>, DoubleDouble, Scalar>;
  const auto wide = [](const Vec3<Scalar>& v) noexcept { return Vec3<Wide>(v[0], v[1], v[2]); };
  const auto split = [](const Wide& x, Scalar& high, Scalar& rest) noexcept {
    high = static_cast<Scalar>(x);
    rest = static_cast<Scalar>(x - high);
  };
  // lever x v_I
  const auto inertially = [&](const Vec3<Wide>& lever, const Vec3<Scalar>& v_I) noexcept {
    const Mat3<Wide> by = cross_matrix<Wide>(lever);
    for (std::size_t j = 0; j < 3; ++j)
      for (int i = 0; i < 9; ++i) split(v_I[int(j)] * by(i), made.inertial[j](i), low.inertial[j](i));
  };
  const auto& field = problem.field;
  switch (torque.type) {
    case TorqueType::constant:
    case TorqueType::table: {
      const Vec3<Scalar> c = torque.type == TorqueType::constant ? torque.vector : Vec3<Scalar>(unit.col(column));
      if (torque.axes == Axes::body) made.body = c;
      else
        for (std::size_t j = 0; j < 3; ++j)
          (torque.axes == Axes::inertial ? made.inertial : made.orbital)[j] = c[int(j)] * unit;
      break;
    }
    case TorqueType::damping:
      if (torque.opposed == Opposed::angular_velocity) made.by_rate = torque.matrix;
      else if (torque.opposed == Opposed::momentum) made.by_momentum = torque.matrix;
      else made.by_carrier = torque.matrix, made.by_rate = torque.matrix * problem.inertia;
      break;
    case TorqueType::brake:
      (torque.opposed == Opposed::momentum ? made.brake_total : made.brake_carrier) = torque.vector;
      break;
    case TorqueType::weight:
      inertially(Vec3<Wide>(Wide(problem.mass) * field.gravity * wide(problem.centre_of_mass)), field.down);
      break;
    case TorqueType::gravity_gradient:
      if (torque.gradient) made.gradient = *torque.gradient;
      else made.orbit_gradient = 1;
      break;
    case TorqueType::magnetic:
      if (field.magnetic == MagneticField::uniform) inertially(wide(torque.vector), field.flux_density);
      else made.dipole = torque.vector;
      break;
    case TorqueType::eddy_current: made.eddy = torque.matrix; break;
    case TorqueType::thrust: {
      const Vec3<Wide> origin = wide(problem.fixed ? Vec3<Scalar>::Zero() : problem.centre_of_mass);
      const Vec3<Wide> lever = wide(torque.point) - origin;
      if (torque.axes == Axes::body) {
        const Vec3<Wide> moment = cross<Wide>(lever, wide(torque.vector));
        for (int i = 0; i < 3; ++i) split(moment[i], made.body[i], low.body[i]);
      } else {
        inertially(lever, torque.vector);
      }
      if (!problem.fixed) (torque.axes == Axes::body ? made.force_body : made.force_inertial) = torque.vector;
      break;
    }
    case TorqueType::charge: made.by_rate = cross_matrix<Scalar>(torque.vector); break;
  }
  return made;
}

/// What of a factor, or a table of torques, must hold.
template <Real Scalar>
Fault check_factor(const Factor<Scalar>& factor, int place) noexcept {
  using std::abs;
  for (const Scalar x : {factor.mean, factor.amplitude, factor.rate, factor.phase})
    if (!(abs(x) < infinity<Scalar>)) return {Errc::not_finite, place, "its factor must be finite"};
  for (const auto& [from, to] : factor.on)
    if (!(from <= to)) return {Errc::not_increasing, place, "what it is on for must end behind its begin"};
  for (std::size_t i = 1; i < factor.on.size(); ++i)
    if (!(factor.on[i - 1][1] <= factor.on[i][0]))
      return {Errc::not_increasing, place, "what it is on for must come one behind the other"};
  return check_table(factor.table, 1, place,
                     "the table of its factor must have one finite value for each time, and times that increase");
}

/// The least value of a table of single numbers, between its times too, to rounding; 0 of an empty one.
template <Real Scalar>
Scalar least_of(const Table<Scalar>& table) noexcept {
  if (table.values.empty()) return 0;
  const auto [low, high] = std::minmax_element(table.values.begin(), table.values.end());
  Scalar least = *low;
  for (std::size_t i = 0; table.between == Between::cubic && i + 1 < table.times.size(); ++i) {
    const auto law = piece(table, 1, 0, table.times[i]);
    const Scalar a = 3 * law.c[3], b = law.c[2], disc = b * b - a * law.c[1],
                 root = std::sqrt(std::max(disc, Scalar(0)));
    const Scalar q = -(b + std::copysign(root, b));  // where the slope c1 + 2 b s + a s^2 vanishes: q/a and c1/q
    for (const Scalar s : {q / a, law.c[1] / q})
      if (disc > 0 && s > 0 && s < table.times[i + 1] - table.times[i]) least = std::min(least, law(law.origin + s));
  }
  const Scalar rounding = 64 * epsilon<Scalar> * std::max(std::abs(*low), std::abs(*high));
  return least < -rounding ? least : std::max(least, Scalar(0));
}

/// Whether a factor is below zero, by more than roundings, at some time from 0 on: its wave while it is on, or a value of its table.
template <Real Scalar>
bool goes_negative(const Factor<Scalar>& factor) noexcept {
  using std::abs;
  const Scalar rounding = 8 * epsilon<Scalar> * (abs(factor.mean) + abs(factor.amplitude));
  const auto wave_dips = [&](Scalar from, Scalar to) noexcept {
    const auto at = [&](Scalar t) noexcept {
      return factor.mean + factor.amplitude * std::sin(factor.rate * t + factor.phase);
    };
    // the lowest point, where the sine is -1 or, of a negative amplitude, 1
    const Scalar lowest = (factor.amplitude > 0 ? -1 : 1) * pi<Scalar> / 2, turn = 2 * pi<Scalar>;
    const Scalar first = factor.rate * from + factor.phase, last = factor.rate * to + factor.phase;
    const Scalar low = std::min(first, last), high = std::max(first, last);
    const bool bottoms = lowest + turn * std::ceil((low - lowest) / turn) <= high;
    const Scalar least = bottoms ? factor.mean - abs(factor.amplitude) : std::min(at(from), at(to));
    return least < -rounding;
  };
  const bool dips =
      factor.on.empty()
          ? factor.mean - abs(factor.amplitude) < -rounding
          : std::any_of(
                factor.on.begin(), factor.on.end(),
                [&](const auto& one) noexcept { return one[1] > 0 && wave_dips(std::max(one[0], Scalar(0)), one[1]); });
  return dips || least_of(factor.table) < 0;
}

/// What a torque needs of the problem.
template <Real Scalar>
Fault check_needs(const Problem<Scalar>& problem, const Torque<Scalar>& torque, int place) noexcept {
  const bool inertial = torque.axes != Axes::body, orbital = torque.axes == Axes::orbit;
  const auto field = problem.field.magnetic;
  switch (torque.type) {
    case TorqueType::constant: break;
    case TorqueType::table:
      if (const Fault wrong = check_table(
              torque.table, 3, place, "its table must have three finite values for each time, and times that increase"))
        return wrong;
      if (!torque.factor.table.times.empty())
        return {Errc::not_applicable, place, "a table of torques has no table as its factor"};
      break;
    case TorqueType::brake:
      if (torque.opposed == Opposed::angular_velocity)
        return {Errc::not_applicable, place, "a brake opposes the momentum of the whole or of the carrier"};
      if (torque.vector.minCoeff() < 0) return {Errc::negative, place, "the limits of a brake must not be negative"};
      if (goes_negative(torque.factor))
        return {Errc::negative, place, "the factor of a brake must not be negative: it would drive the body"};
      break;
    case TorqueType::weight:
      if (!problem.fixed) return {Errc::not_applicable, place, "the weight of a free body has no moment"};
      break;
    case TorqueType::gravity_gradient:
      if (!torque.gradient && !problem.orbit)
        return {Errc::not_applicable, place, "a gravity gradient needs an orbit, or its size"};
      if (torque.gradient && !std::isfinite(static_cast<double>(*torque.gradient)))
        return {Errc::not_finite, place, "its gradient must be finite"};
      break;
    case TorqueType::magnetic:
    case TorqueType::eddy_current:
      if (field == MagneticField::none) return {Errc::not_applicable, place, "it needs a magnetic field"};
      break;
    case TorqueType::thrust:
      if (orbital) return {Errc::not_applicable, place, "a thrust is given in body or inertial axes"};
      if (!torque.point.allFinite()) return {Errc::not_finite, place, "its point must be finite"};
      break;
    case TorqueType::damping:
    case TorqueType::charge: break;
  }
  const bool turned =
      torque.type == TorqueType::constant || torque.type == TorqueType::table || torque.type == TorqueType::thrust;
  if (inertial && !turned) return {Errc::not_applicable, place, "it is given in body axes"};
  if (torque.type == (problem.fixed ? TorqueType::weight : TorqueType::thrust) && !problem.mass_given)
    return {Errc::not_applicable, place, "it needs the mass of the body, which is not given"};
  if (orbital && !problem.orbit) return {Errc::not_applicable, place, "axes of an orbit need an orbit"};
  return {};
}

/// Fields and orbit.
template <Real Scalar>
Fault check_surroundings(const Problem<Scalar>& problem) noexcept {
  using std::abs;
  const auto is_unit = [](const Vec3<Scalar>& v) noexcept {
    using std::abs;
    return abs(v.norm() - 1) <= 8 * epsilon<Scalar>;
  };
  const auto& field = problem.field;
  for (const Scalar x : {field.gravity, field.rate, field.strength, field.radius, field.flux_density[0],
                         field.flux_density[1], field.flux_density[2]})
    if (!(abs(x) < infinity<Scalar>)) return {Errc::not_finite, -1, "the field must be finite"};
  if (!is_unit(field.down)) return {Errc::out_of_domain, -1, "down must have unit length"};
  if (field.magnetic != MagneticField::none && !is_unit(field.axis))
    return {Errc::out_of_domain, -1, "the axis of the field must have unit length"};
  if (field.magnetic == MagneticField::dipole && !problem.orbit)
    return {Errc::not_applicable, -1, "the field of a dipole needs an orbit"};
  if (!problem.orbit) return {};
  const auto& orbit = *problem.orbit;
  if (!(orbit.radius > 0 && orbit.radius < infinity<Scalar>) || !(orbit.mu > 0 && orbit.mu < infinity<Scalar>))
    return {Errc::not_positive, -1, "radius and mu of the orbit must be positive"};
  if (!(orbit.eccentricity >= 0 && orbit.eccentricity < 1))
    return {Errc::out_of_domain, -1, "the eccentricity of the orbit must be in [0, 1)"};
  if (!(abs(orbit.true_anomaly) < infinity<Scalar>)) return {Errc::not_finite, -1, "the anomaly must be finite"};
  if (!is_unit(orbit.radial) || !is_unit(orbit.along) || !(abs(orbit.radial.dot(orbit.along)) <= 8 * epsilon<Scalar>))
    return {Errc::out_of_domain, -1, "radial and along must be orthonormal"};
  return {};
}

}  // namespace detail

template <Real Scalar>
Collected<Scalar> Collected<Scalar>::of(const Problem<Scalar>& problem, Scalar span) noexcept {
  Collected made;
  made.records.emplace_back();
  std::vector<Terms<Scalar>> low(1);  // what rounding leaves over of the sum of each
  const auto put = [&](Factor<Scalar> factor, const Torque<Scalar>& torque, int column) noexcept {
    Terms<Scalar> rest;
    const Terms<Scalar> terms = detail::terms_of(problem, torque, column, rest);
    const Scalar times = detail::take_constant(factor, span);
    if (times == 0 || !terms.any()) return;
    auto place = std::find_if(made.records.begin(), made.records.end(),
                              [&](const auto& record) noexcept { return detail::same_factor(record.factor, factor); });
    if (place == made.records.end()) {
      made.records.push_back({std::move(factor), {}, {}});
      low.emplace_back();
      place = made.records.end() - 1;
    }
    Terms<Scalar>& left = low[std::size_t(place - made.records.begin())];
    place->sum.add(times, terms, left);
    left.add(times, rest);
    place->size.add_sizes(times, terms);
  };
  for (const Torque<Scalar>& torque : problem.torques) {
    if (torque.type != TorqueType::table) {
      put(torque.factor, torque, 0);
      continue;
    }
    for (int column = 0; column < 3; ++column) {
      Factor<Scalar> factor = torque.factor;
      factor.table = torque.table;
      factor.table.values.clear();
      for (std::size_t i = 0; i < torque.table.times.size(); ++i)
        factor.table.values.push_back(torque.table.values[3 * i + std::size_t(column)]);
      put(std::move(factor), torque, column);
    }
  }
  for (std::size_t i = 0; i < low.size(); ++i) made.records[i].sum.add(1, low[i]);
  return made;
}

/// Whether the torques, fields and the orbit of a problem are what the equations can take: finite; what each torque needs is there.
template <Real Scalar>
Fault check_torques(const Problem<Scalar>& problem) noexcept {
  if (const Fault wrong = detail::check_surroundings(problem)) return wrong;
  if (!(problem.mass > 0 && problem.mass < infinity<Scalar>))
    return {Errc::not_positive, -1, "the mass must be positive"};
  if (!problem.centre_of_mass.allFinite()) return {Errc::not_finite, -1, "the centre of mass must be finite"};
  int place = 0;
  for (const auto& torque : problem.torques) {
    if (!torque.vector.allFinite() || !torque.matrix.allFinite())
      return {Errc::not_finite, place, "its numbers must be finite"};
    if (const Fault wrong = detail::check_factor(torque.factor, place)) return wrong;
    if (const Fault wrong = detail::check_needs(problem, torque, place)) return wrong;
    ++place;
  }
  const auto collected = Collected<Scalar>::of(problem, infinity<Scalar>);
  const auto waves = std::count_if(collected.records.begin(), collected.records.end(), [](const auto& record) noexcept {
    return record.factor.amplitude != 0 && record.sum.any_moving();
  });
  if (waves > most_waves)
    return {Errc::out_of_domain, -1, "at most 8 different waves go with torques that depend on the motion"};
  return {};
}

/// Whether the start is one: finite, with an attitude of unit length.
template <Real Scalar>
Fault check_start(const Problem<Scalar>& problem) noexcept {
  using std::abs;
  if (!problem.angular_velocity.allFinite()) return {Errc::not_finite, -1, "the angular velocity must be finite"};
  if (!problem.velocity.allFinite() || !problem.position.allFinite())
    return {Errc::not_finite, -1, "velocity and position must be finite"};
  if (!(abs(norm(problem.attitude) - 1) <= 8 * epsilon<Scalar>))
    return {Errc::out_of_domain, -1, "the attitude must have unit length"};
  return {};
}

/// All that a problem must be.
template <Real Scalar>
Fault check(const Problem<Scalar>& problem) noexcept {
  if (const Fault wrong = check_wheels(problem)) return wrong;
  if (const Fault wrong = check_torques(problem)) return wrong;
  return check_start(problem);
}

}  // namespace gyrostat::general
