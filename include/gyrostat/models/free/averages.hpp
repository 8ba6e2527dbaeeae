// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/periodic.hpp"
#include "gyrostat/math/quadrature.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/motion.hpp"

/// Means of a free motion over its period, by the trapezoid rule on the period, which converges like a geometric series; and what turns
/// on the average.
namespace gyrostat::free {

namespace detail {

/// Nodes in a period, a power of two, with which a rule may begin: fewer would miss what happens beside a separatrix, and agree.
template <Real Scalar>
int first_nodes(const Motion<Scalar>& motion) noexcept {
  int n = 16;
  while (n < 8192 && 2 * n < nodes_of(motion)) n *= 2;
  return n;
}

}  // namespace detail

/// Body axes. Of a motion without a period what it has for ever (steady) or tends to (separatrix).
template <Real Scalar>
struct Averages {
  Vec3<Scalar> angular_velocity{0, 0, 0};             ///< <omega>, rad/s
  Vec3<Scalar> angular_momentum{0, 0, 0};             ///< <M>, N m s
  Mat3<Scalar> second_moment = Mat3<Scalar>::Zero();  ///< <M M^T>, (N m s)^2
  Scalar error = 0;                                   ///< estimate, relative to the greatest
};

template <Real Scalar>
Averages<Scalar> averages(const Motion<Scalar>& motion) noexcept {
  Averages<Scalar> mean;
  const Scalar T = motion.period();
  if (!(T < infinity<Scalar>)) {
    const auto s = motion.at(motion.kind() == Kind::separatrix ? 80 / motion.jacobi_rate() : Scalar(0));
    mean.angular_velocity = s.angular_velocity;
    mean.angular_momentum = s.angular_momentum;
    mean.second_moment = s.angular_momentum * s.angular_momentum.transpose();
    return mean;
  }
  if (motion.is_regular_precession()) {
    const auto s = motion.at(Scalar(0));
    const Vec3<Scalar> axis = motion.turning_of_momentum().normalized();
    const Scalar along = axis.dot(s.angular_momentum), across = cross<Scalar>(axis, s.angular_momentum).squaredNorm();
    const Mat3<Scalar> on_axis = axis * axis.transpose();
    mean.angular_velocity = axis.dot(s.angular_velocity) * axis;
    mean.angular_momentum = along * axis;
    mean.second_moment = along * along * on_axis + across / 2 * (Mat3<Scalar>::Identity() - on_axis);
    mean.error = 8 * epsilon<Scalar>;
    return mean;
  }
  const auto means = math::periodic_means<Scalar, 12>(
      [&](Scalar x) {
        const auto s = motion.at(x * T);
        const Vec3<Scalar>&w = s.angular_velocity, &M = s.angular_momentum;
        return std::array<Scalar, 12>{w[0],        w[1],        w[2],        M[0],        M[1],        M[2],
                                      M[0] * M[0], M[1] * M[1], M[2] * M[2], M[0] * M[1], M[1] * M[2], M[2] * M[0]};
      },
      64 * epsilon<Scalar>, detail::first_nodes(motion), 16384);
  const auto& v = means.value;
  for (int i = 0; i < 3; ++i) {
    mean.angular_velocity[i] = v[std::size_t(i)];
    mean.angular_momentum[i] = v[std::size_t(3 + i)];
    mean.second_moment(i, i) = v[std::size_t(6 + i)];
    const int j = (i + 1) % 3;
    mean.second_moment(i, j) = mean.second_moment(j, i) = v[std::size_t(9 + i)];
    mean.error = std::max(mean.error, means.error[std::size_t(3 + i)] / motion.angular_momentum_norm());
  }
  return mean;
}

/// How a body axis b moves about the direction of M, on the average over a period: its azimuth about M, and the turning of the body about
/// b as seen from the plane of b and M, rad/s. Tumbling asteroids: the periods 2 pi over these.
template <Real Scalar>
struct Precession {
  Scalar about_momentum = 0, about_axis = 0;
  bool converged = true;  ///< false where M passes so near the axis that its turns cannot be counted
};

/// @param axis unit, body axes
template <Real Scalar>
Precession<Scalar> precession(const Motion<Scalar>& motion, const Vec3<Scalar>& axis) noexcept {
  const Scalar T = motion.period();
  Scalar magnified = 0;  // error of these rates over that of M's direction
  const auto rates = [&](Scalar t) {
    const auto s = motion.at(t);
    // by the parts of M and omega across the axis, which cancel nothing where both are nearly along it
    const Vec3<Scalar> n = s.angular_momentum / motion.angular_momentum_norm();
    const Scalar along = axis.dot(n), b = axis.dot(s.angular_velocity);
    const Vec3<Scalar> across = n - along * axis;
    const Scalar about = across.dot(s.angular_velocity - b * axis) / across.squaredNorm();
    magnified = std::max(magnified, s.angular_velocity.norm() / across.norm());
    return std::array<Scalar, 2>{about, b - along * about};
  };
  if (!(T < infinity<Scalar>)) {
    const auto r = rates(Scalar(0));
    return {r[0], r[1], motion.kind() == Kind::steady};
  }
  if (motion.is_regular_precession()) {
    const Vec3<Scalar> v = motion.turning_of_momentum();
    const Scalar about = axis.dot(v);
    if (v.squaredNorm() - about * about < Scalar(1e-12) * v.squaredNorm())
      return {motion.precession_rate(), -about, true};
  }
  // M comes back in the body after a period: but for whole turns the axis has then gone round M by the turn in a period, and the body about the axis
  // not at all. A rough mean tells how many.
  const auto means = math::periodic_means<Scalar, 2>([&](Scalar x) { return rates(x * T); }, Scalar(1e-3L),
                                                     detail::first_nodes(motion), 16384);
  const Scalar once = 2 * pi<Scalar> / T, rest = motion.turn_per_period() / T;
  Scalar about_momentum = means.value[0], about_axis = means.value[1];
  bool sure = 64 * epsilon<Scalar> * magnified < once;
  const bool largest = motion.kind() == Kind::about_largest;
  if (!sure && motion.rotor_momentum() == Vec3<Scalar>(0, 0, 0) && (largest || motion.kind() == Kind::about_smallest)) {
    // a permanent rotation but for rounding: M goes round the axis once in a period, backwards in the body about that of the smallest moment
    const Vec3<Scalar> one = motion.R_BP().col(largest ? 0 : 2);
    const Scalar along = axis.dot(one);
    sure = 1 - along * along < 1e-12;
    const Scalar spin = axis.dot(motion.at(Scalar(0)).angular_velocity), sense = spin < 0 ? Scalar(-1) : Scalar(1);
    about_axis = (largest ? -once : once) * sense;
    about_momentum = (spin - about_axis) * sense;
  }
  const Scalar round = (about_momentum - rest) / once, about = about_axis / once;
  const Scalar rounds = std::nearbyint(round), abouts = std::nearbyint(about);
  sure = sure && std::abs(round - rounds) < Scalar(0.1L) && std::abs(about - abouts) < Scalar(0.1L);
  return {rest + once * rounds, once * abouts, sure};
}

/// Least and greatest angle between a body axis and M, rad.
template <Real Scalar>
struct Nutation {
  Scalar least = 0, greatest = 0;
};

/// @param axis unit, body axes
template <Real Scalar>
Nutation<Scalar> nutation(const Motion<Scalar>& motion, const Vec3<Scalar>& axis) noexcept {
  using std::atan2;
  const auto angle = [&](Scalar t) {
    const Vec3<Scalar> M = motion.at(t).angular_momentum;
    return atan2(cross<Scalar>(axis, M).norm(), axis.dot(M));
  };
  Nutation<Scalar> range{angle(Scalar(0)), angle(Scalar(0))};
  const auto see = [&](Scalar t) {
    range.least = std::min(range.least, angle(t));
    range.greatest = std::max(range.greatest, angle(t));
  };
  const Scalar T = motion.period();
  if (T < infinity<Scalar>) {
    const auto slope = [&](Scalar t) {
      const auto s = motion.at(t);
      return axis.dot(cross<Scalar>(s.angular_momentum, s.angular_velocity));
    };
    for (const Scalar t : periodic_zeros(motion, slope, Scalar(0), T)) see(t);
  } else if (motion.kind() == Kind::separatrix) {
    for (int i = -400; i <= 400; ++i) see(Scalar(i) / (5 * motion.jacobi_rate()));
  }
  return range;
}

/// A period of omega in the body after which the attitude repeats too, nearly: after `periods` of them the body has made `turns` whole
/// turns about M, but for `rest` rad.
template <Real Scalar>
struct Resonance {
  int turns = 0, periods = 1;
  Scalar rest = 0;
};

/// The best with at most `most` periods, by the continued fraction of the turn in a period.
template <Real Scalar>
Resonance<Scalar> resonance(const Motion<Scalar>& motion, int most) noexcept {
  using std::abs, std::floor;
  const Scalar share = motion.turn_per_period() / (2 * pi<Scalar>);
  if (!(share - share == 0)) return {0, 0, nan<Scalar>};
  Scalar x = share;
  long p = 1, q = 0, last_p = 0, last_q = 1;
  for (int trip = 0; trip < 40; ++trip) {
    const Scalar whole = floor(x);
    if (!(abs(whole) < Scalar(1e9))) break;
    const long n = static_cast<long>(whole), next_p = n * p + last_p, next_q = n * q + last_q;
    if (next_q > most) break;
    last_p = p, last_q = q, p = next_p, q = next_q;
    if (x == whole) break;
    x = 1 / (x - whole);
  }
  return {static_cast<int>(p), static_cast<int>(q), 2 * pi<Scalar> * (Scalar(q) * share - Scalar(p))};
}

/// The integral of omega over time since t = 0, body axes, rad, up to `span`: what the angle of a rotor that turns freely needs. Kronrod's rule on panels
/// of a period, or of as much of it as the span has, each halved until Gauss's agrees. Allocates at construction.
template <Real Scalar>
class RateIntegral {
 public:
  RateIntegral(const Motion<Scalar>& motion, Scalar span) noexcept : motion_(motion), period_(motion.period()) {
    steady_ = motion.at(Scalar(0)).angular_velocity;
    if (motion.is_regular_precession() || motion.kind() == Kind::steady) return;
    const Scalar rate = motion.jacobi_rate();
    // beyond 40 units of u a separatrix motion turns steadily
    end_ = period_ < infinity<Scalar> ? std::min(span, period_)
                                      : std::clamp((40 - motion.jacobi_start()) / rate, Scalar(0), span);
    if (!(end_ > 0)) return;
    if (!(period_ < infinity<Scalar>)) steady_ = motion.at(end_).angular_velocity;
    divide(1 + static_cast<int>(std::min(end_ * rate, Scalar(1000))));
  }

  Vec3<Scalar> at(Scalar t) const noexcept {
    if (motion_.is_regular_precession()) return motion_.precession_integral(t);
    if (panels_.empty()) return steady_ * t;
    if (!(t > end_)) return within(t);
    if (!(period_ < infinity<Scalar>)) return whole_ + (t - end_) * steady_;
    const auto turns = detail::Fraction<Scalar>::of(detail::Turns<Scalar>{1 / period_, 0}, t, {});
    const bool before = turns.high < 0;
    const Scalar rest = before ? 1 + (turns.high + turns.low) : turns.high + turns.low;
    return (before ? turns.whole - 1 : turns.whole) * whole_ + within(std::clamp(rest * period_, Scalar(0), end_));
  }
  /// The size of what is summed, rad, of which its rounding is, also where it cancels.
  Scalar swing() const noexcept {
    Scalar most = whole_.norm();
    for (const Panel& panel : panels_) most = std::max(most, panel.before.norm());
    return most;
  }

 private:
  struct Panel {
    Scalar begin;
    Vec3<Scalar> before;  ///< the integral up to there
  };

  void divide(int panels) noexcept {
    using std::pow;
    const Scalar agreed = pow(epsilon<Scalar>, Scalar(0.6L));  // Kronrod's rule has 24 orders where Gauss's has 14
    Vec3<Scalar> sum(0, 0, 0), lost(0, 0, 0);
    const auto take = [&](Scalar middle, Scalar half, bool halvable) noexcept -> Result<bool> {
      Vec3<Scalar> part(0, 0, 0), apart(0, 0, 0);
      Scalar fastest = 0;
      for (const auto& point : math::kronrod_points<Scalar>) {
        const Vec3<Scalar> omega = motion_.at(middle + half * point.node).angular_velocity;
        part += point.weight * omega;
        apart += (point.weight - point.gauss_weight) * omega;
        fastest = std::max(fastest, omega.norm());
      }
      if (halvable && !(apart.norm() <= agreed * fastest)) return false;
      panels_.push_back({middle - half, sum});
      // with what the sum loses (Kahan 1965): beside a separatrix panels are alike, and so are their roundings
      const Vec3<Scalar> more = half * part - lost, now = sum + more;
      lost = (now - sum) - more;
      sum = now;
      return true;
    };
    (void)math::halved_panels(Scalar(0), end_, panels, 12, take);  // nothing refuses
    whole_ = sum;
  }

  /// Up to t, at most the end of the panels.
  Vec3<Scalar> within(Scalar t) const noexcept {
    const auto next = std::upper_bound(panels_.begin() + 1, panels_.end(), t,
                                       [](Scalar time, const Panel& panel) noexcept { return time < panel.begin; });
    const Panel& panel = *(next - 1);
    const Scalar half = (t - panel.begin) / 2;
    Vec3<Scalar> part(0, 0, 0);
    for (const auto& point : math::kronrod_points<Scalar>)
      part += point.weight * motion_.at(panel.begin + half * (1 + point.node)).angular_velocity;
    return panel.before + half * part;
  }

  Motion<Scalar> motion_;
  Scalar period_, end_ = 0;
  Vec3<Scalar> steady_{0, 0, 0};  ///< omega where it does not change, or no more
  Vec3<Scalar> whole_{0, 0, 0};   ///< the integral over all panels
  std::vector<Panel> panels_;
};

}  // namespace gyrostat::free
