// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/body/secular.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/free/problem.hpp"

namespace gyrostat::free {

/// A rotation that lasts: omega = ratio M. Body axes.
template <Real Scalar>
struct PermanentRotation {
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< rad/s
  Vec3<Scalar> angular_momentum{0, 0, 0};  ///< N m s
  Scalar ratio = 0;                        ///< 1/(kg m^2)
  /// Of the frequency of small oscillations of M about it, 1/s^2: > 0 stable (the energy has an extremum there), < 0 unstable, growing like
  /// exp(sqrt(-square) t); 0 where a neighbour is permanent too.
  Scalar square = 0;

  bool stable() const noexcept { return square > 0; }
};

/// The permanent rotations of a body with a given norm of the momentum.
template <Real Scalar>
struct PermanentRotations {
  int count = 0;  ///< 2, 4 or 6
  PermanentRotation<Scalar> rotation[6];
};

namespace detail {

/// Collects rotations with M = R n, omega = sigma M, where n_i = g_i/(a_i - sigma).
template <Real Scalar>
struct PermanentSearch {
  const PrincipalProblem<Scalar>& p;
  const Secular<Scalar>& q;
  Scalar R;
  PermanentRotations<Scalar> found;

  void add(const SecularPoint<Scalar>& at, const Vec3<Scalar>& n) noexcept {
    if (found.count == 6) return;
    auto& r = found.rotation[found.count++];
    r.ratio = q.sigma(at);
    r.angular_momentum = p.R_BP * Vec3<Scalar>(R * n);
    r.angular_velocity = r.ratio * r.angular_momentum;
    const Scalar d[3] = {R * q.distance(at, 0), R * q.distance(at, 1), R * q.distance(at, 2)};
    r.square = d[1] * d[2] * n[0] * n[0] + d[0] * d[2] * n[1] * n[1] + d[0] * d[1] * n[2] * n[2];
  }
  /// A zero of the slope of the secular equation; axes without rotor momentum are dealt with apart.
  void turning(int origin, int direction, Scalar reach) noexcept {
    SecularPoint<Scalar> at;
    if (!q.turning_point(origin, direction, reach, at) || (at.offset == 0 && !q.active(origin))) return;
    Vec3<Scalar> n = q.vertex(at);
    add(at, n / n.norm());
  }
  /// Both rotations about an axis i without rotor momentum; M has parts along the others where these have some.
  void axis(int i) noexcept {
    using std::sqrt;
    const SecularPoint<Scalar> at{i, Scalar(0)};
    Vec3<Scalar> n = q.vertex(at);
    const Scalar rest = 1 - n.squaredNorm();
    if (!(rest > 0)) return;  // at 0 it is one of those that turning() finds
    n[i] = sqrt(rest);
    add(at, n);
    n[i] = -n[i];
    add(at, n);
  }
};

/// M along l, one way or the other: its path about l is a circle at the rate |l|/J.
template <Real Scalar>
Result<PermanentRotations<Scalar>> permanent_of_sphere(const PrincipalProblem<Scalar>& p, Scalar R) noexcept {
  const Vec3<Scalar> l = p.R_BP * p.l;
  const Scalar length = l.norm();
  if (!(length > 0)) return Errc::not_applicable;
  PermanentRotations<Scalar> found;
  for (const Scalar sign : {Scalar(1), Scalar(-1)}) {
    auto& r = found.rotation[found.count++];
    r.ratio = p.inverse[1] * (1 - sign * length / R);
    r.angular_momentum = sign * R / length * l;
    r.angular_velocity = p.inverse[1] * (sign * R - length) / length * l;
    r.square = (p.inverse[1] * length) * (p.inverse[1] * length);
  }
  return found;
}

}  // namespace detail

/// All permanent rotations of a gyrostat whose angular momentum has the length R > 0, N m s: those whose axes are principal axes without
/// rotor momentum, and the zeros of the slope of Volterra's secular equation (Volterra 1899). Of a body with two equal moments whose
/// plane has no rotor momentum a circle of them exists, of which two pairs are given. Errors: those of
/// Problem::check(); not_positive: R; not_applicable: a sphere without rotor momentum, which turns about any axis alike.
template <Real Scalar>
Result<PermanentRotations<Scalar>> permanent_rotations(const Problem<Scalar>& problem, Scalar R) noexcept {
  if (const Errc wrong = problem.check(); wrong != Errc::ok) return wrong;
  if (!(R > 0)) return Errc::not_positive;
  const auto p = PrincipalProblem<Scalar>::of(problem);
  if (p.spherical()) return detail::permanent_of_sphere(p, R);
  const Secular<Scalar> q(p.inverse, p.gaps, p.inverse.cwiseProduct(p.l / R), Scalar(1));
  detail::PermanentSearch<Scalar> search{p, q, R, {}};
  search.turning(0, -1, infinity<Scalar>);
  for (int i = 0; i < 3; ++i) {
    if (!q.active(i)) search.axis(i);
    if (i == 2) break;
    const auto rise = q.rise(i);
    if (!rise.exists) continue;
    search.turning(i, 1, p.gaps(i, i + 1));
    search.turning(i + 1, -1, p.gaps(i, i + 1));
  }
  search.turning(2, 1, infinity<Scalar>);
  return search.found;
}

}  // namespace gyrostat::free
