// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"

/// Periodic motions through one section, down_2 = 0 and down_3 = G0: at one spin, and along their family (docs/heavy.md, section 4).
/// No heap.
namespace gyrostat::heavy {

/// Unknown: p0, q0, T; spin and down at the start stay.
template <Real Scalar>
struct AtSpin {
  static constexpr int unknowns = 3, conditions = 0;
  Scalar rate;  ///< rad/s

  Eigen::Matrix<Scalar, 7, 3> basis(const State<Scalar>&) const noexcept {
    Eigen::Matrix<Scalar, 7, 3> by = Eigen::Matrix<Scalar, 7, 3>::Zero();
    by(0, 0) = by(1, 1) = by(6, 2) = 1;
    return by;
  }
  void move(State<Scalar>& start, Scalar& period, const Vec3<Scalar>& x) const noexcept {
    start.angular_velocity[0] += rate * x[0];
    start.angular_velocity[1] += rate * x[1];
    period += x[2] / rate;
  }
};

/// Unknown: p0, q0, r0, T, on the plane across a tangent of the family.
template <Real Scalar>
struct AlongFamily {
  static constexpr int unknowns = 4, conditions = 1;
  using Point = Eigen::Matrix<Scalar, 4, 1>;  ///< (p0/unit, q0/unit, r0/unit, unit T)
  Scalar unit, rate;                          ///< rad/s
  Point at, tangent;

  static Point point(const State<Scalar>& start, Scalar period, Scalar unit) noexcept {
    const auto& w = start.angular_velocity;
    return {w[0] / unit, w[1] / unit, w[2] / unit, period * unit};
  }
  Eigen::Matrix<Scalar, 7, 4> basis(const State<Scalar>&) const noexcept {
    Eigen::Matrix<Scalar, 7, 4> by = Eigen::Matrix<Scalar, 7, 4>::Zero();
    by(0, 0) = by(1, 1) = by(2, 2) = unit / rate;
    by(6, 3) = rate / unit;
    return by;
  }
  void move(State<Scalar>& start, Scalar& period, const Point& x) const noexcept {
    start.angular_velocity += unit * x.template head<3>();
    period += x[3] / unit;
  }
  Eigen::Matrix<Scalar, 1, 5> condition(const State<Scalar>& start, Scalar period) const noexcept {
    Eigen::Matrix<Scalar, 1, 5> row;
    row << tangent.dot(point(start, period, unit) - at), tangent.transpose();
    return row;
  }
};

/// Walks along a family of periodic motions by pseudo-arclength: past folds of the spin, to where it ends.
///
/// Another family crosses, or comes near, where the trace comes to 6 (both multipliers one; of a nearly symmetric body where its nutation
/// is in step with the spin). There steps become short, so that the walk does not change over to the other. Families that come nearer
/// than some 1e-4 are passed straight on, as ones that cross are.
template <Real Scalar>
class OrbitWalk {
 public:
  using Space = AlongFamily<Scalar>;
  using Point = typename Space::Point;

  /// @param unit rad/s, of the order of the slow motions: of it the steps are measured   @param towards in which sense to walk
  OrbitWalk(const Problem<Scalar>& problem, const Closed<Scalar>& from, Scalar unit, const Point& towards) noexcept
      : problem_(problem), member_(from), unit_(unit), tangent_(towards) {
    turn();
  }

  const Closed<Scalar>& member() const noexcept { return member_; }
  const Point& tangent() const noexcept { return tangent_; }
  /// d(spin)/d(length) along the family: changes its sign at a fold.
  Scalar spin_slope() const noexcept { return tangent_[2]; }
  const ode::Counts& counts() const noexcept { return counts_; }  ///< of all shots, those of trials that failed too
  int shots() const noexcept { return shots_; }
  /// Steps no longer than this from here on, in `unit`.
  void limit(Scalar longest) noexcept {
    longest_ = longest;
    length_ = std::min(length_, longest);
  }

  /// The next member. False where no step, however short, finds one.
  bool advance() noexcept {
    constexpr Scalar least = Scalar(1e-6L), straight = Scalar(0.94L), resolved = Scalar(1e-4L);
    const Scalar gap = here_gap();
    if (std::abs(gap) < 1 && fall_ > 0) {
      const Scalar ahead = std::abs(gap) / fall_;
      if (ahead > resolved) length_ = std::min(length_, Scalar(2) / 3 * ahead);
    }
    while (length_ > least) {
      const Point here = Space::point(member_.start, member_.period, unit_);
      const Space space{unit_, rate(), here + length_ * (tangent_ + length_ / 2 * bend_), tangent_};
      State<Scalar> start = member_.start;
      start.angular_velocity = unit_ * space.at.template head<3>();
      const auto next = close_orbit(problem_, start, space.at[3] / unit_, space.rate, space, close_enough<Scalar>, 9,
                                    4 * epsilon<Scalar>, &counts_);
      if (next) {
        shots_ += next->shots;
        const Point found = Space::point(next->start, next->period, unit_);
        const Scalar off = (found - space.at).norm() / length_;
        if (off < Scalar(0.5L)) {
          const Closed<Scalar> before = member_;
          const Point old = tangent_;
          member_ = *next;
          turn();
          const bool passed = (gap < 0) != (here_gap() < 0) && length_ > resolved;
          if (tangent_.dot(old) > straight && !passed) {
            const Scalar stepped = (found - here).norm();
            bend_ = (tangent_ - old) / stepped;
            fall_ = (std::abs(gap) - std::abs(here_gap())) / stepped;
            if (off < Scalar(0.05L)) length_ = std::min(Scalar(1.6L) * length_, longest_);
            if (off > Scalar(0.2L)) length_ /= 2;
            return true;
          }
          member_ = before;
          tangent_ = old;
        }
      }
      length_ /= 2;
    }
    return false;
  }

 private:
  Scalar rate() const noexcept { return std::max(rate_size(problem_, member_.start), unit_); }

  /// 6 less the trace at the member: |1 - multiplier|^2 where it is elliptic.
  Scalar here_gap() const noexcept { return 6 - member_.shot.derivative.trace(); }

  /// The tangent at the member, in the sense of the last one.
  void turn() noexcept {
    using Method = detail::Shooting<Scalar, Space>;
    const Space space{unit_, rate(), Space::point(member_.start, member_.period, unit_), tangent_};
    typename Method::Rows residual;
    typename Method::Jacobian jacobian;
    Method(space, space.rate).equations(problem_, member_.start, member_.period, member_.shot, residual, jacobian);
    residual.setZero();
    residual[6] = -1;
    const Point t = Method::change(jacobian, residual);
    tangent_ = t / t.norm();
  }

  Problem<Scalar> problem_;
  Closed<Scalar> member_;
  Scalar unit_;
  Point tangent_, bend_ = {0, 0, 0, 0};  ///< and its derivative by the length
  Scalar length_ = Scalar(0.1L), longest_ = Scalar(0.25L);
  Scalar fall_ = 0;  ///< of |6 - trace| by the length, in the last step
  ode::Counts counts_;
  int shots_ = 0;
};

}  // namespace gyrostat::heavy
