// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/many.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/free/motion_lanes.hpp"
#include "gyrostat/models/free/reduced.hpp"

namespace gyrostat::free {

/// The quick form of up to eight free gyrostats: their motions and, of each, four neighbours (MotionError::quick), all set up in double side by side.
/// What a body comes to is the same to the bit whatever stands beside it.
class QuickLanes {
 public:
  static constexpr int size = MotionLanes::size;
  using Row = MotionLanes::Row;

  /// A sound body, its principal axes, and the last time that is asked, s.
  struct Body {
    const Assembly<double>* assembly;
    const PrincipalProblem<double>* principal;
    double horizon;
  };

  /// What is known of a motion.
  struct Known {
    MotionError<double>::Bound bound;  ///< up to the horizon
    double of_scalars;                 ///< greatest error of what is constant, as MotionError::of_scalars
    double fastest;                    ///< greatest |omega|, rad/s, that the bound of the rates is over
    double momentum;                   ///< |M|, N m s
  };

  /// Sets up at most `size` bodies. A bit, 2^b, for each that MotionError::quick would take and whose motion is tame in lanes.
  unsigned make(std::span<const Body> bodies) noexcept {
    count_ = int(bodies.size());
    if (count_ == 0) return 0;
    enlist(bodies);
    unsigned tame[copies];
    for (int g = 0; g < groups(); ++g) tame[g] = lanes_[g].make();
    unsigned known = 0;
    Row span, end, squares[3] = {};
    for (int b = 0; b < count_; ++b) {
      bool all = true;
      for (int k = 0; k < copies; ++k) all = all && (tame[group_of(k, b)] >> lane_of(k, b) & 1);
      end[b] = bodies[std::size_t(b)].horizon;
      span[b] = std::min(end[b], all ? own(b).period()[own_lane(b)] : 0.);
      if (all && suits(bodies[std::size_t(b)], b)) known |= 1u << b;
    }
    if (known == 0) return 0;
    compare(span, end, squares);
    for (int b = 0; b < count_; ++b)
      if (known >> b & 1 && !judge(bodies[std::size_t(b)], b, {squares[0][b], squares[1][b], squares[2][b]}))
        known &= ~(1u << b);
    return known;
  }

  /// Of a body that is known.
  const Known& known(int b) const noexcept { return known_[b]; }
  /// Its states at the times, s.
  void at(int b, std::span<const double> times, State<double>* states) const noexcept {
    const MotionLanes motion = own(b).spread(own_lane(b));
    for (std::size_t first = 0; first < times.size(); first += size) {
      const std::size_t some = std::min<std::size_t>(size, times.size() - first);
      Row t;
      for (std::size_t i = 0; i < size; ++i) t[i] = times[first + std::min(i, some - 1)];
      const auto seen = motion.at(t);
      for (std::size_t i = 0; i < some; ++i) states[first + i] = seen.lane(int(i));
    }
  }

 private:
  using Error = MotionError<double>;
  static constexpr int copies = detail::neighbours + 1, itself = detail::neighbours;
  static constexpr int nodes = Error::few;

  int groups() const noexcept { return (copies * count_ + size - 1) / size; }
  // the copies of all bodies one behind the other: of eight bodies a group each
  int group_of(int k, int b) const noexcept { return (k * count_ + b) / size; }
  int lane_of(int k, int b) const noexcept { return (k * count_ + b) % size; }
  const MotionLanes& own(int b) const noexcept { return lanes_[group_of(itself, b)]; }
  int own_lane(int b) const noexcept { return lane_of(itself, b); }

  void enlist(std::span<const Body> bodies) noexcept;
  /// What MotionError::is_tame asks, and more: a motion that is set up by itself is on the same side of each limit.
  bool suits(const Body& body, int b) const noexcept {
    const PrincipalProblem<double>& p = *body.principal;
    const Vec3<double>& J = p.moments;
    const double R = own(b).angular_momentum_norm()[own_lane(b)], k2 = own(b).modulus_squared()[own_lane(b)];
    const bool single = own(b).kind(own_lane(b)) == Kind::one_component;
    return !(single && (k2 < 2 * Error::quick_least || k2 > 0.499)) && k2 < 0.97 && !p.spherical() && !p.steady(R) &&
           (has_axes(body) || std::min(J[0] - J[1], J[1] - J[2]) > 1.01 * Error::quick_gap * J[0]);
  }
  /// Sums of the squares of how far each neighbour is at most from each body over its span before the end: rates, momentum, attitude.
  void compare(const Row& span, const Row& end, Row (&squares)[3]) const noexcept;
  bool judge(const Body& body, int b, const std::array<double, 3>& squares) noexcept;

  /// The axes of the data are principal.
  static bool has_axes(const Body& body) noexcept { return body.assembly->has_axes(); }
  Error::Figures figures(int k, int b) const noexcept {
    const MotionLanes& lanes = lanes_[group_of(k, b)];
    const int at = lane_of(k, b);
    return {lanes.energy()[at], lanes.angular_momentum_norm()[at], lanes.modulus_squared()[at],
            lanes.period()[at], lanes.turn_per_period()[at],       lanes.kind(at)};
  }

  int count_ = 0;
  MotionLanes lanes_[copies];
  Known known_[size];
};

inline void QuickLanes::enlist(std::span<const Body> bodies) noexcept {
  Quat<double> attitude[size];  // the neighbours', too
  for (int b = 0; b < count_; ++b) attitude[b] = as_unit(bodies[std::size_t(b)].assembly->body.attitude);
  for (int k = 0; k < copies; ++k)
    for (int b = 0; b < count_; ++b) {
      const Body& body = bodies[std::size_t(b)];
      const Assembly<double>& given = *body.assembly;
      const int lane = lane_of(k, b), end = k == itself && b + 1 == count_ ? size : lane + 1;
      MotionLanes& to = lanes_[group_of(k, b)];
      if (k == itself) {
        to.set(lane, end, *body.principal, attitude[b]);
        continue;
      }
      // principal axes found in double are off by more than a rounding
      const double by = (has_axes(body) ? 1 : 2) * epsilon<double>;
      const auto problem = Reduced<double>::taken(neighbour<double>(given, k, by)).problem;
      to.set(lane, end,
             has_axes(body) ? PrincipalProblem<double>::of(problem)
                            : PrincipalProblem<double>::beside(problem, body.principal->R_BP),
             attitude[b]);
    }
}

inline void QuickLanes::compare(const Row& span, const Row& end, Row (&squares)[3]) const noexcept {
  MotionLanes::States seen[copies], sorted[copies];
  Row farthest[itself][3] = {};
  for (int node = 1; node <= nodes; ++node) {
    for (int g = 0; g < groups(); ++g) {
      MotionLanes::Row t;
      for (int lane = 0; lane < size; ++lane) {
        const int copy = g * size + lane, b = std::min(copy, copies * count_ - 1) % count_;
        t[lane] = end[b] - span[b] * (nodes - node) / nodes;
      }
      seen[g] = lanes_[g].at(t);
    }
    for (int k = 0; count_ < size && k < copies; ++k)
      for (int b = 0; b < size; ++b) {
        const int of = std::min(b, count_ - 1);
        sorted[k].take(b, seen[group_of(k, of)], lane_of(k, of));
      }
    const MotionLanes::States* const by_body = count_ < size ? sorted : seen;
    for (int k = 0; k < itself; ++k) by_body[k].widen(by_body[itself], farthest[k]);
  }
  for (int k = 0; k < itself; ++k)
    for (int n = 0; n < 3; ++n)
      for (int b = 0; b < size; ++b) squares[n][b] += farthest[k][n][b];
}

inline bool QuickLanes::judge(const Body& body, int b, const std::array<double, 3>& squares) noexcept {
  const Error::Figures own_figures = figures(itself, b);
  Error error;
  error.begin_quick(body.horizon);
  error.kind_ = own_figures.kind;
  error.period_ = own_figures.period;
  error.span_ = std::min(error.horizon_, error.period_);
  MotionLanes::Row t;
  for (int i = 0; i < size; ++i) t[i] = error.span_ * i / nodes;
  const auto seen = own(b).spread(own_lane(b)).look(t);
  const PrincipalProblem<double>& p = *body.principal;
  const double R = own_figures.norm;
  error.take_extent(seen, p.R_BP * p.inverse.asDiagonal() * p.R_BP.transpose(), own_figures.turn, R);
  const State<double> start = seen.states.lane(0);
  error.defect_ = std::max({error.defect_, (start.angular_momentum - p.R_BP * p.M).norm() / R,
                            (start.angular_velocity - p.R_BP * p.omega).norm() / error.fastest_});
  for (int k = 0; k < itself; ++k) error.see_figures(own_figures, figures(k, b));
  error.add(error.last_node(), {squares[0] / (error.fastest_ * error.fastest_), squares[1] / (R * R), squares[2]});
  if (!error.trust_quick(p.moments, p.M / R, p.l / R, own(b).phase_rate(own_lane(b)))) return false;
  known_[std::size_t(b)] = {error.at(body.horizon), error.of_scalars(), error.fastest(), R};
  return true;
}

}  // namespace gyrostat::free
