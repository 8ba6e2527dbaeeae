// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/holding.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// What becomes of a body that a brake has brought to its stop (docs/general.md, section 1.6): whether it rests until the laws change, and its
/// state while it does.
namespace gyrostat::general {

/// What a body does at a stop.
enum class AtStop : std::uint8_t {
  rests,    ///< up to the end of the piece at least
  leaves,   ///< at once
  barely,   ///< what acts is hardly more than the brakes can hold
  later,    ///< it would leave within the piece, about an axis that no brake holds
  turning,  ///< undecided: wheels turn by torques of their own
  laws,     ///< undecided: brakes of both laws, and wheels that hold momentum
  varying,  ///< undecided: a load varies by itself, or because the body turns on
};

/// Why the motion is not followed through a stop, and what to do.
constexpr const char* why_not_through(AtStop what) noexcept {
  switch (what) {
    case AtStop::turning:
      return "a brake brings the body to its stop while wheels turn freely, by motors, by friction or at rates that "
             "change, and what it would have to hold then is not followed: ask for times up to the stop, or hold the "
             "wheels";
    case AtStop::laws:
      return "brakes of both laws bring the body to its stop while wheels hold momentum, and what they come to "
             "together is not known: give one law";
    case AtStop::varying:
      return "a brake brings the body to its stop beside a torque that goes on by itself there (a wave, an orbit, a "
             "field that moves, a torque in space on a body that turns on), and whether it holds is not followed: ask "
             "for times up to the stop, or give what varies as a table of steps";
    case AtStop::later:
      return "a table takes the torque on a body at rest from zero about an axis that its brake does not hold, and how "
             "the body leaves is not followed: give the table in steps";
    case AtStop::barely:
      return "the torque on a body at a stop exceeds what the brake can hold by less than a ten-thousandth, and how "
             "it leaves is not followed: change one of them";
    default: return "";
  }
}

/// The least rate at which a body is followed out of its rest, over the size of torque and brakes.
inline constexpr double least_departure = 1e-4;

/// How U leaves zero where a growing torque has just reached the limit of the brakes: U = s^2 (second + s third), s the time since then.
template <Real Scalar>
struct Outgrowth {
  Vec3<Scalar> second{0, 0, 0}, third{0, 0, 0};  ///< N m/s, N m/s^2
  Scalar time = 0;  ///< in which the torque grows by about what the brakes hold, s; 0: it does not
};

/// torque: coefficients of its powers of s, the first at the limit of the brakes; follows(U): the change of dU/dt with U, brakes excluded, to first
/// order. In dU/dt = torque - limit n, n = U/|U|, n0 is the share that each brake has; the first power gives n1, across n0, and |second|, the next
/// third along n0 (docs/general.md, section 1.6).
template <Real Scalar, class Follows>
Outgrowth<Scalar> outgrowth(const Vec3<Scalar>& limit, const std::array<Vec3<Scalar>, 4>& torque,
                            const Follows& follows) noexcept {
  Outgrowth<Scalar> made;
  if (!(limit.minCoeff() > 0)) return made;
  const auto share = [&](const Vec3<Scalar>& v) noexcept { return Vec3<Scalar>(v.cwiseQuotient(limit)); };
  const Vec3<Scalar> n0 = share(torque[0]).normalized(), growth = share(torque[1]);
  const Scalar along = n0.dot(growth), hold = n0.dot(share(n0));
  if (!(along > Scalar(least_departure) * magnitude(growth))) return made;
  const Scalar size = along / (2 * hold);
  made.second = size * n0;
  const Vec3<Scalar> n1 = share(torque[1] - 2 * made.second), across = size * n1;
  const Vec3<Scalar> next = torque[2] + follows(made.second);
  made.third = across + (n0.dot(share(next)) / 3 + n1.squaredNorm() / 6 - n0.dot(share(across))) / hold * n0;
  made.time = 1 / magnitude(growth);
  return made;
}

/// What happens where all that brakes oppose is zero.
template <Real Scalar>
struct Stop {
  AtStop what = AtStop::rests;
  Scalar until = infinity<Scalar>;  ///< when a torque that grows leaves the body no rest, s
  Departure<Scalar> departure;      ///< of what the brakes oppose, where the body leaves
  Outgrowth<Scalar> outgrowth;      ///< where it leaves so slowly that the departure has no rate
  Vec3<Scalar> turning{0, 0, 0};    ///< w, rad/s: that of held wheels alone
  Scalar slip = 0;                  ///< the most torque that may be left over, because of share_slack, N m
  bool carrier = false;             ///< J w is opposed, not M
};

namespace detail {

/// action(terms) for all that acts in a piece.
template <Real Scalar, class Action>
void each_of(const Piece<Scalar>& piece, const Action& action) noexcept {
  for (const auto& terms : piece.power) action(terms);
  for (const auto& wave : piece.waves) action(wave.terms);
}

/// The sum of the torques other than brakes, and the sum of their magnitudes, body axes.
template <Real Scalar>
struct SizedTorque {
  Vec3<Scalar> sum, size;
};

/// The torque of these coefficients on a body that turns with w, in a field at rest. M: its total momentum.
template <Real Scalar>
SizedTorque<Scalar> steady_torque(const Prepared<Scalar>& of, const Terms<Scalar>& terms, const Quat<Scalar>& q,
                                  const Vec3<Scalar>& w, const Vec3<Scalar>& M) noexcept {
  SizedTorque<Scalar> made{terms.body, terms.body.cwiseAbs()};
  const auto add = [&](const Vec3<Scalar>& torque, const Vec3<Scalar>& size) noexcept {
    made.sum += torque, made.size += size;
  };
  add(-(terms.by_rate * w), terms.by_rate.cwiseAbs() * w.cwiseAbs());
  add(-(terms.by_momentum * M), terms.by_momentum.cwiseAbs() * M.cwiseAbs());
  const auto seen = [&](const Vec3<Scalar>& v_I) noexcept { return rotate<Scalar>(conjugate(q), v_I); };
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3<Scalar> e = seen(Vec3<Scalar>::Unit(int(j)));
    add(terms.inertial[j] * e, terms.inertial[j].cwiseAbs() * e.cwiseAbs());
  }
  if (terms.gradient != 0) {
    const Vec3<Scalar> d = seen(of.problem.field.down), Jd = of.wheels.whole * d;
    const Scalar size = std::abs(terms.gradient) * d.norm() * Jd.norm();
    add(terms.gradient * cross<Scalar>(d, Jd), Vec3<Scalar>::Constant(size));
  }
  return made;
}

/// Whether brakes hold the torque sum of c_k s^k for all s from 0 to `length`: decided by subdividing it as a Bezier curve, which lies in the hull of
/// its control points; false also where that stays undecided. most: a share_of_brake().
template <Real Scalar>
bool holds_all(const Vec3<Scalar>& limit, const std::array<Vec3<Scalar>, 4>& c, Scalar length, Scalar most) noexcept {
  const Vec3<Scalar> a = length * c[1], b = length * length * c[2], d = length * length * length * c[3];
  struct Curve {
    std::array<Vec3<Scalar>, 4> point;
  };
  std::array<Curve, 64> left;
  std::size_t count = 0;
  left[count++] = {{c[0], c[0] + a / 3, c[0] + 2 * a / 3 + b / 3, c[0] + a + b + d}};
  const auto holds = [&](const Vec3<Scalar>& torque) noexcept { return share_of_brake(limit, torque) <= most; };
  while (count > 0) {
    const auto p = left[--count].point;
    if (!holds(p[0]) || !holds(p[3])) return false;
    if (holds(p[1]) && holds(p[2])) continue;
    if (count + 2 > left.size()) return false;
    const Vec3<Scalar> ab = (p[0] + p[1]) / 2, bc = (p[1] + p[2]) / 2, cd = (p[2] + p[3]) / 2;
    const Vec3<Scalar> abc = (ab + bc) / 2, bcd = (bc + cd) / 2, middle = (abc + bcd) / 2;
    left[count++] = {{p[0], ab, abc, middle}};
    left[count++] = {{middle, bcd, cd, p[3]}};
  }
  return true;
}

/// For how long, of `length`, the brakes hold it.
template <Real Scalar>
Scalar held_for(const Vec3<Scalar>& limit, const std::array<Vec3<Scalar>, 4>& c, Scalar length, Scalar most) noexcept {
  Scalar low = 0, high = length;
  for (int trip = 0; trip < 2 * std::numeric_limits<Scalar>::digits; ++trip) {
    const Scalar middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) break;
    (holds_all(limit, c, middle, most) ? low : high) = middle;
  }
  return low;
}

}  // namespace detail

/// Whether stops in a piece can be followed at all, by its wheels and brakes alone: rests (they can), turning or laws.
template <Real Scalar>
AtStop stoppable(const Prepared<Scalar>& of, const Piece<Scalar>& piece) noexcept {
  bool total = false, carrier = false, own = false, with_momentum = false;
  detail::each_of(piece, [&](const Terms<Scalar>& terms) noexcept {
    total = total || !terms.brake_total.isZero(0);
    carrier = carrier || !terms.brake_carrier.isZero(0);
  });
  for (std::size_t i = 0; i < of.wheels.count; ++i) {
    const auto follows = of.wheels.laws[i].follows;
    own = own || follows == Follows::state || (carrier && follows >= Follows::constant);
    with_momentum = with_momentum || follows >= Follows::constant;
  }
  for (std::size_t k = 0; k < piece.momentum.size(); ++k) {
    own = own || (k > 0 && !piece.momentum[k].isZero(0));
    with_momentum = with_momentum || !piece.momentum[k].isZero(0);
  }
  if (own) return AtStop::turning;
  return total && carrier && with_momentum ? AtStop::laws : AtStop::rests;
}

namespace detail {

/// Makes the polynomial sum of c_k s^k that of s + by.
template <Real Scalar>
void shift_origin(std::array<Vec3<Scalar>, 4>& c, Scalar by) noexcept {
  for (int k = 0; k < 3; ++k)
    for (int j = 2; j >= k; --j) c[std::size_t(j)] += by * c[std::size_t(j) + 1];
}

/// Whether the torques of a piece on a body that turns with w are no polynomial of the time.
template <Real Scalar>
bool load_varies(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Vec3<Scalar>& w) noexcept {
  const bool turns = !w.isZero(0), stands = of.problem.field.magnetic == MagneticField::uniform && !turns;
  const auto any = [](const auto& matrices) noexcept {
    return std::any_of(matrices.begin(), matrices.end(), [](const auto& m) noexcept { return !m.isZero(0); });
  };
  bool varies = !piece.waves.empty();
  for (std::size_t k = 0; k < piece.power.size(); ++k) {
    const Terms<Scalar>& terms = piece.power[k];
    varies = varies || any(terms.orbital) || terms.orbit_gradient != 0 || !terms.dipole.isZero(0);
    varies = varies || (!terms.eddy.isZero(0) && !stands);
    varies = varies || (turns && (any(terms.inertial) || terms.gradient != 0 || !terms.force_body.isZero(0)));
    varies = varies || (k > 0 && (!terms.brake_total.isZero(0) || !terms.brake_carrier.isZero(0)));
  }
  return varies;
}

/// What brakes have to hold: the torque by powers of the time since a moment, and how many times the brakes the terms are that it is the sum of, at
/// least 1.
template <Real Scalar>
struct TorqueOnBrakes {
  std::array<Vec3<Scalar>, 4> torque;
  Scalar terms = 1;
};

/// That of a piece from t on, on a body with attitude q and total momentum M that turns with w. limit: of the brakes.
template <Real Scalar>
TorqueOnBrakes<Scalar> torque_on_brakes(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Quat<Scalar>& q,
                                        const Vec3<Scalar>& w, const Vec3<Scalar>& M, const Vec3<Scalar>& limit,
                                        Scalar t) noexcept {
  TorqueOnBrakes<Scalar> load;
  Vec3<Scalar> size(0, 0, 0), of_brake(0, 0, 0);
  Scalar power = 1;
  for (std::size_t k = 0; k < 4; ++k, power *= std::max(t, piece.to) - piece.from) {
    const auto one = steady_torque<Scalar>(of, piece.power[k], q, w, M);
    load.torque[k] = one.sum, size += power * one.size;
  }
  shift_origin(load.torque, t - piece.from);
  for (int i = 0; i < 3; ++i) {
    if (limit[i] > 0) of_brake[i] = size[i] / limit[i];
    for (auto& c : load.torque)
      if (limit[i] == 0 && std::abs(c[i]) <= share_slack<Scalar> * size[i]) c[i] = 0;
  }
  load.terms = std::max(Scalar(1), magnitude(of_brake));
  return load;
}

}  // namespace detail

/// What happens in a piece from t on, where all that brakes oppose is zero. slack: how much of a share over 1 still counts as held.
template <Real Scalar>
Stop<Scalar> stop_at(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Quat<Scalar>& q, Scalar t,
                     Scalar slack) noexcept {
  Stop<Scalar> stop;
  stop.what = stoppable(of, piece);
  if (stop.what != AtStop::rests) return stop;
  const Terms<Scalar>& steady = piece.power[0];
  stop.carrier = !steady.brake_carrier.isZero(0);
  const Vec3<Scalar> l = piece.momentum[0], M = stop.carrier ? l : Vec3<Scalar>(0, 0, 0);
  if (!stop.carrier) stop.turning = of.wheels.inverse * Vec3<Scalar>(-l);
  if (detail::load_varies<Scalar>(of, piece, stop.turning)) {
    stop.what = AtStop::varying;
    return stop;
  }
  const Vec3<Scalar> limit = steady.brake_total + steady.brake_carrier;
  const auto load = detail::torque_on_brakes<Scalar>(of, piece, q, stop.turning, M, limit, t);
  const auto& torque = load.torque;
  const Scalar allowed = slack * load.terms;
  const Scalar most = 1 + allowed, share = share_of_brake(limit, torque[0]);
  const Scalar whole = std::max(magnitude(torque[0]), limit.maxCoeff());
  // whether a growing torque has just reached the limit of the brakes, to roundings of it and of the time
  const auto outgrows = [&](Scalar over) noexcept {
    stop.outgrowth = outgrowth(limit, torque, [&](const Vec3<Scalar>& U) noexcept -> Vec3<Scalar> {
      const Vec3<Scalar> w = of.wheels.inverse * U;
      const auto at = [&](const Vec3<Scalar>& rate, const Vec3<Scalar>& all) noexcept {
        return detail::steady_torque<Scalar>(of, piece.power[0], q, rate, all).sum;
      };
      const Vec3<Scalar> turn = stop.carrier ? cross<Scalar>(l, w) : cross<Scalar>(U, stop.turning);
      return at(stop.turning + w, M + U) - at(stop.turning, M) + turn;
    });
    const Scalar time = stop.outgrowth.time;
    return time > 0 && over <= 16 * allowed + 4 * epsilon<Scalar> * t / time;
  };
  if (share > most) {
    stop.departure = departure(limit, torque[0]);
    const bool slowly = stop.departure.rate < Scalar(least_departure) * whole;
    if (slowly && outgrows(share - 1)) stop.departure = {};
    else stop.outgrowth = {};
    stop.what = slowly && !(stop.outgrowth.time > 0) ? AtStop::barely : AtStop::leaves;
  } else if (const Scalar length = piece.to - t; !detail::holds_all(limit, torque, length, most)) {
    const Scalar held = detail::held_for(limit, torque, length, most);
    stop.until = t + held;
    const bool grows = outgrows(0);
    if (!(stop.until > t) || (grows && held <= 16 * allowed * stop.outgrowth.time))
      stop.what = grows ? AtStop::leaves : limit.minCoeff() > 0 ? AtStop::barely : AtStop::later;
  } else {
    // within the margin of rounding the torque may exceed the brake, and drive the body by the difference
    const bool changes = !(torque[1].isZero(0) && torque[2].isZero(0) && torque[3].isZero(0));
    const bool clear = changes && detail::holds_all(limit, torque, piece.to - t, 1 - allowed);
    const Scalar over = clear ? Scalar(0) : (changes ? most : share) - 1 + allowed;
    stop.slip = over > 0 ? over * limit.maxCoeff() : Scalar(0);
  }
  return stop;
}

/// The numbers of FullSystem while a body rests in a piece: what brakes oppose is zero, held wheels turn the body on at most.
template <Real Scalar, bool large>
class Resting {
  using At = Places<large>;

 public:
  using Numbers = std::array<Scalar, At::width>;

  /// From t on, where the numbers are these but for what remains of the motion.
  Resting(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Stop<Scalar>& stop, Scalar t,
          const Numbers& numbers) noexcept
      : from_(t), begin_(numbers), turning_(stop.turning) {
    const Vec3<Scalar> M = stop.carrier ? piece.momentum[0] : Vec3<Scalar>(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) begin_[At::momentum + i] = M[int(i)];
    if constexpr (large) {
      push_.fill({0, 0, 0});
      const auto q = normalised(Quat<Scalar>{begin_[0], begin_[1], begin_[2], begin_[3]});
      for (std::size_t k = 0; k < 4; ++k)
        push_[k] = (rotate<Scalar>(q, piece.power[k].force_body) + piece.power[k].force_inertial) / of.problem.mass;
      detail::shift_origin(push_, t - piece.from);
    }
  }

  Scalar from() const noexcept { return from_; }

  Numbers at(Scalar t) const noexcept {
    using std::cos, std::sin;
    Numbers x = begin_;
    const Scalar s = t - from_;
    if (const Scalar rate = magnitude(turning_); rate > 0) {
      const Scalar c = cos(s * rate / 2), part = sin(s * rate / 2) / rate;
      const Quat<Scalar> q = Quat<Scalar>{x[0], x[1], x[2], x[3]} *
                             Quat<Scalar>{c, part * turning_[0], part * turning_[1], part * turning_[2]};
      x[0] = q.w, x[1] = q.x, x[2] = q.y, x[3] = q.z;
      for (std::size_t i = 0; i < 3; ++i) x[At::turned + i] += s * turning_[int(i)];
    }
    if constexpr (large) {
      const Vec3<Scalar>* a = push_.data();
      const Vec3<Scalar> v = s * (a[0] + s * (a[1] / 2 + s * (a[2] / 3 + s * a[3] / 4)));
      const Vec3<Scalar> way = s * s * (a[0] / 2 + s * (a[1] / 6 + s * (a[2] / 12 + s * a[3] / 20)));
      for (std::size_t i = 0; i < 3; ++i) {
        x[At::position + i] += s * x[At::velocity + i] + way[int(i)];
        x[At::velocity + i] += v[int(i)];
      }
    }
    return x;
  }

 private:
  Scalar from_;
  Numbers begin_;
  Vec3<Scalar> turning_;
  std::array<Vec3<Scalar>, large ? 4 : 0> push_;
};

}  // namespace gyrostat::general
