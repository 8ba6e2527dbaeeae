// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "gyrostat/models/free/motion.hpp"

/// Random gyrostats and starts of every regime, and a truth by Taylor series (what the tests of a free motion are measured against).
namespace free_bodies {

using gyrostat::DoubleDouble;
using gyrostat::Quat;
using gyrostat::Real;
using gyrostat::Vec3;
using gyrostat::free::Problem;
using gyrostat::free::State;

enum class Regime {
  generic,          ///< l from 1e-2 to 10, a quarter without
  middle_axis,      ///< no l, start 1 to 1e-15 off the middle axis
  outer_axis,       ///< no l, start 1 to 1e-15 off the axis of the largest or smallest moment
  much_momentum,    ///< l over J omega from 1 to 1e12
  little_momentum,  ///< from 1 to 1e-12
  total_near_zero,  ///< M over l from 1 to 1e-12
  close_moments,    ///< two moments equal to 1..1e-15, l oblique
  equal_moments,    ///< two moments equal, l oblique
  unstable_axis,    ///< l along the middle axis, start 1 to 1e-15 off it
  symmetric,        ///< two moments equal, l along the third axis or none, a quarter next to resonance
  bisected,         ///< l oblique, start between two kinds of motion, as near as halving brings it
};
inline constexpr Regime regimes[] = {Regime::generic,       Regime::middle_axis,     Regime::outer_axis,
                                     Regime::much_momentum, Regime::little_momentum, Regime::total_near_zero,
                                     Regime::close_moments, Regime::equal_moments,   Regime::unstable_axis,
                                     Regime::symmetric,     Regime::bisected};
inline const char* name(Regime r) {
  static const char* names[] = {"generic",         "middle axis",     "outer axis",    "much momentum",
                                "little momentum", "total near zero", "close moments", "equal moments",
                                "unstable axis",   "symmetric",       "bisected"};
  return names[int(r)];
}

struct Bodies {
  std::mt19937_64 engine;
  explicit Bodies(unsigned seed) : engine(seed) {}

  double uniform(double a = 0, double b = 1) { return std::uniform_real_distribution<double>(a, b)(engine); }
  double normal() { return std::normal_distribution<double>()(engine); }
  double scale(double low, double high) { return std::pow(10, uniform(low, high)); }
  Vec3<double> vector() { return {normal(), normal(), normal()}; }
  Quat<double> attitude() { return gyrostat::normalised(Quat<double>{normal(), normal(), normal(), normal()}); }
  int axis() { return int(uniform(0, 3)); }

  Vec3<double> moments() {
    double J[3];
    do {
      for (double& j : J) j = 0.3 + uniform();
      std::sort(J, J + 3);
    } while (J[2] > 0.999 * (J[0] + J[1]));
    return {J[2], J[1], J[0]};
  }

  Problem<double> of(Regime regime, int count) {
    Vec3<double> J = moments(), l(0, 0, 0), w = vector();
    const Quat<double> q = attitude();
    const double e = scale(-15, 0), size = scale(-2, 1);
    switch (regime) {
      case Regime::generic:
        if (count % 4) l = size * vector();
        break;
      case Regime::middle_axis:
        w[0] *= count % 3 == 1 ? 0 : e;
        w[2] *= count % 3 == 2 ? 0 : e;
        break;
      case Regime::outer_axis:
        w[1] *= e;
        w[count % 2 ? 0 : 2] *= e;
        break;
      case Regime::much_momentum:
        l = scale(0, 12) * vector();
        if (count % 3 == 1) l[axis()] = 0;
        if (count % 3 == 2) l[axis()] = l[axis()] = 0;
        break;
      case Regime::little_momentum:
        l = scale(-12, 0) * vector();
        if (count % 2) l[axis()] = 0;
        break;
      case Regime::total_near_zero:
        l = vector();
        w = (-l).cwiseQuotient(J) + scale(-12, 0) * vector();
        break;
      case Regime::close_moments: {
        const int k = count % 2;
        J[k + 1] = J[k] * (1 - e / 4);
        l = size * vector();
        break;
      }
      case Regime::equal_moments: {
        const int k = count % 2;
        J[k + 1] = J[k];
        l = size * vector();
        break;
      }
      case Regime::unstable_axis:
        l[1] = 0.3 * normal();
        w[0] *= count % 2 ? e : 0;
        w[1] = uniform(1, 2);
        w[2] *= count % 2 ? 0 : e;
        break;
      case Regime::symmetric: {
        const int k = count % 2, third = k ? 0 : 2;
        J[k + 1] = J[k];
        if (count % 4 > 1) l[third] = size * normal();
        if (count % 4 == 3) w[third] = l[third] / (J[1] - J[third]) * (1 + scale(-2, 0));
        if (count % 3 == 0) w[third] *= scale(-2, 0);
        if (count % 3 == 1) w[k] *= e, w[k + 1] *= e;
        break;
      }
      case Regime::bisected: return bisected(J, 0.2 * vector(), w, vector(), q);
    }
    return Problem<double>::from_moments(J, l, w, q);
  }

  Problem<double> bisected(const Vec3<double>& J, const Vec3<double>& l, const Vec3<double>& from, Vec3<double> to,
                           const Quat<double>& q) {
    using gyrostat::free::Motion;
    const auto at = [&](double s) { return Problem<double>::from_moments(J, l, from + s * (to - from), q); };
    const auto kind = [&](double s) { return Motion<double>::make<DoubleDouble>(at(s).cast<DoubleDouble>())->kind(); };
    double low = 0, high = 1;
    const auto first = kind(0);
    for (int tries = 0; first == kind(1) && tries < 1000; ++tries) to = vector();
    const int depth = int(uniform(0, 50));
    for (int i = 0; i < depth; ++i) {
      const double middle = (low + high) / 2;
      (kind(middle) == first ? low : high) = middle;
    }
    return at(uniform() < 0.5 ? low : high);
  }

  /// Every datum times 1 +- a rounding.
  Problem<double> jittered(Problem<double> p) {
    const auto jitter = [&](double& x) { x *= 1 + (uniform() < 0.5 ? 1 : -1) * 0x1p-52; };
    for (int i = 0; i < 3; ++i) jitter(p.inertia(i, i)), jitter(p.rotor_momentum[i]), jitter(p.angular_velocity[i]);
    return p;
  }
};

/// The equations of motion by Taylor series about each step, 30 terms: errors of some 1e-30 a revolution in double-double.
template <Real Scalar>
class Taylor {
 public:
  explicit Taylor(const Problem<Scalar>& p)
      : J_(p.inertia), l_(p.rotor_momentum), q_(gyrostat::normalised(p.attitude)) {
    using Mat = gyrostat::Mat3<Scalar>;
    const Mat& J = J_;
    Mat cofactors;
    for (int i = 0; i < 3; ++i) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      for (int j = 0; j < 3; ++j) {
        const int c = (j + 1) % 3, d = (j + 2) % 3;
        cofactors(i, j) = J(a, c) * J(b, d) - J(a, d) * J(b, c);
      }
    }
    inverse_ =
        cofactors.transpose() / (J(0, 0) * cofactors(0, 0) + J(0, 1) * cofactors(0, 1) + J(0, 2) * cofactors(0, 2));
    G_ = p.momentum_given ? Vec3<Scalar>(p.angular_momentum - l_) : Vec3<Scalar>(J * p.angular_velocity);
    pace_ = (inverse_ * (G_ + l_)).norm() + (inverse_ * G_).norm() + (inverse_ * l_).norm();
  }

  State<Scalar> advance(Scalar to) {
    while (t_ < to && t_ - t_ == 0) step(to);
    const Vec3<Scalar> w = inverse_ * G_;
    return {w, G_ + l_, q_};
  }

 private:
  static constexpr int order = 30;

  void step(Scalar to) {
    using std::abs, std::pow;
    Vec3<Scalar> g[order + 1], w[order + 1], M[order + 1];
    Quat<Scalar> q[order + 1];
    g[0] = G_;
    q[0] = q_;
    double reach = 1e300;
    for (int k = 0; k <= order; ++k) {
      w[k] = inverse_ * g[k] / pace_;  // time in units of 1/pace
      M[k] = k == 0 ? Vec3<Scalar>(g[0] + l_) : g[k];
      if (k == order) break;
      Vec3<Scalar> dg(0, 0, 0);
      Quat<Scalar> dq{0, 0, 0, 0};
      for (int j = 0; j <= k; ++j) {
        const Vec3<Scalar>&m = M[j], &v = w[k - j];
        dg += gyrostat::cross<Scalar>(m, v);
        const Quat<Scalar> part = q[j] * Quat<Scalar>{0, v[0], v[1], v[2]};
        dq = {dq.w + part.w, dq.x + part.x, dq.y + part.y, dq.z + part.z};
      }
      const Scalar n = k + 1;
      g[k + 1] = dg / n;
      q[k + 1] = {dq.w / (2 * n), dq.x / (2 * n), dq.y / (2 * n), dq.z / (2 * n)};
      if (k + 1 >= order - 1) {
        const double size = double(g[k + 1].norm() / G_.norm()), spin = double(gyrostat::norm(q[k + 1]));
        const double tolerance = double(gyrostat::epsilon<Scalar>) / 4;
        if (size > 0) reach = std::min(reach, pow(tolerance / size, 1. / (k + 1)));
        if (spin > 0) reach = std::min(reach, pow(tolerance / spin, 1. / (k + 1)));
      }
    }
    Scalar h = 0.8 * reach, step = h / pace_;
    if (t_ + step > to) step = to - t_, h = step * pace_;
    G_ = g[order];
    q_ = q[order];
    for (int k = order - 1; k >= 0; --k) {
      G_ = h * G_ + g[k];
      q_ = {h * q_.w + q[k].w, h * q_.x + q[k].x, h * q_.y + q[k].y, h * q_.z + q[k].z};
    }
    t_ = t_ + step == t_ ? to : t_ + step;
  }

  gyrostat::Mat3<Scalar> J_, inverse_;
  Vec3<Scalar> l_, G_;
  Scalar pace_ = 1;
  Quat<Scalar> q_;
  Scalar t_ = 0;
};

/// Relative to the length of the rates; rad.
struct Off {
  double rates = 0, momentum = 0, attitude = 0;
  void see(const Off& o) {
    rates = std::max(rates, o.rates);
    momentum = std::max(momentum, o.momentum);
    attitude = std::max(attitude, o.attitude);
  }
};

template <Real Scalar, Real Truth>
Off off(const State<Scalar>& s, const State<Truth>& truth) {
  using gyrostat::vector_cast;
  const Quat<Truth> q{s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z},
      r = gyrostat::conjugate(truth.attitude) * q;
  Off o;
  o.rates =
      double((vector_cast<Truth>(s.angular_velocity) - truth.angular_velocity).norm() / truth.angular_velocity.norm());
  const double R = double(truth.angular_momentum.norm()),
               gap = double((vector_cast<Truth>(s.angular_momentum) - truth.angular_momentum).norm());
  o.momentum = R > 0 ? gap / R : gap;
  using std::sqrt;
  o.attitude = double(2 * sqrt(r.x * r.x + r.y * r.y + r.z * r.z));
  if (!(o.rates >= 0)) o.rates = 1e300;
  if (!(o.attitude >= 0)) o.attitude = 1e300;
  return o;
}

}  // namespace free_bodies
