// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/table.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/vector.hpp"

/// What acts from one breakpoint to the next: there all that depends on time is a polynomial or a wave.
namespace gyrostat::general {

/// Torques times cubic(t) sin(rate t + phase).
template <Real Scalar>
struct Wave {
  Terms<Scalar> terms;
  Cubic<Scalar> cubic;
  Scalar rate = 0, phase = 0;
};

/// What is known of one wheel over a piece, by s = t - from: c0 + c1 s + ... is I Om of a held wheel, p of one whose p is known, T of
/// one whose p is a state.
template <Real Scalar>
struct WheelPiece {
  std::array<Scalar, 5> c{};
  Scalar integral = 0;    ///< of this over I, from t = 0 to the begin of the piece; not used for a T
  Scalar lost = 0;        ///< what rounding has taken from that in the pieces before
  Scalar start_lost = 0;  ///< and from the p with which the piece begins, where p is an integral

  Scalar at(Scalar s) const noexcept { return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4]))); }
  /// Goes on behind a piece of this length, s, of a wheel of this inertia.
  void add_up(const WheelPiece& before, Scalar length, Scalar inertia) noexcept {
    const Scalar was = before.integral, gain = before.gained(length) / inertia;
    integral = was + gain;
    lost = before.lost + (std::abs(was) >= std::abs(gain) ? (was - integral) + gain : (gain - integral) + was);
  }
  /// p begins where it was at the end of a piece of this length, s.
  void go_on(const WheelPiece& before, Scalar length) noexcept {
    const auto& b = before.c;
    c[0] = b[0], start_lost = before.start_lost;
    add_product_to(c[0], start_lost, length, b[1] + length * (b[2] + length * (b[3] + length * b[4])));
    add_to(c[0], start_lost, Scalar(0));
  }
  /// The integral of it over the piece up to s.
  Scalar gained(Scalar s) const noexcept {
    return s * (c[0] + s * (c[1] / 2 + s * (c[2] / 3 + s * (c[3] / 4 + s * c[4] / 5))));
  }
};

template <Real Scalar>
struct Piece {
  Scalar from = 0, to = 0;
  std::array<Terms<Scalar>, 4>
      power;  ///< the torques are power[0] + s power[1] + s^2 power[2] + s^3 power[3], s = t - from, and waves
  std::vector<Wave<Scalar>> waves;
  std::array<WheelPiece<Scalar>, most_wheels> wheels;
  std::array<Vec3<Scalar>, 5> momentum;  ///< by powers of s: of l0 and all wheels but those whose p is a state

  /// The first piece of a problem, up to its first breakpoint `to`, and the one behind `before`.
  static Piece first(const Problem<Scalar>& problem, const Wheels<Scalar>& wheels, const Collected<Scalar>& torques,
                     Scalar to) noexcept;
  static Piece behind(const Piece& before, const Problem<Scalar>& problem, const Wheels<Scalar>& wheels,
                      const Collected<Scalar>& torques, Scalar to) noexcept;

  /// A time in the piece, for the laws that hold in it.
  Scalar inside() const noexcept { return std::max(from, least_breakpoint<Scalar>); }

  /// The momentum of all wheels but those whose p is a state, N m s.
  Vec3<Scalar> momentum_at(Scalar t) const noexcept {
    const Scalar s = t - from;
    return momentum[0] + s * (momentum[1] + s * (momentum[2] + s * (momentum[3] + s * momentum[4])));
  }

 private:
  void take_torques(const Collected<Scalar>& torques) noexcept;
  void take_record(const Record<Scalar>& record) noexcept;
  void take_wheels(const Problem<Scalar>& problem, const Wheels<Scalar>& all, const Piece* before) noexcept;
};

template <Real Scalar>
Piece<Scalar> Piece<Scalar>::first(const Problem<Scalar>& problem, const Wheels<Scalar>& wheels,
                                   const Collected<Scalar>& torques, Scalar to) noexcept {
  Piece made;
  made.to = to;
  made.take_torques(torques);
  made.take_wheels(problem, wheels, nullptr);
  return made;
}

template <Real Scalar>
Piece<Scalar> Piece<Scalar>::behind(const Piece& before, const Problem<Scalar>& problem, const Wheels<Scalar>& wheels,
                                    const Collected<Scalar>& torques, Scalar to) noexcept {
  Piece made;
  made.from = before.to;
  made.to = to;
  made.take_torques(torques);
  made.take_wheels(problem, wheels, &before);
  return made;
}

template <Real Scalar>
void Piece<Scalar>::take_torques(const Collected<Scalar>& torques) noexcept {
  for (const Record<Scalar>& record : torques.records) take_record(record);
}

template <Real Scalar>
void Piece<Scalar>::take_record(const Record<Scalar>& record) noexcept {
  const auto& factor = record.factor;
  if (!factor.is_on(inside())) return;
  Cubic<Scalar> cubic{from, {1}};
  if (!factor.table.times.empty()) cubic = piece(factor.table, 1, 0, inside()).about(from);
  for (std::size_t i = 0; i < 4; ++i)
    if (cubic.c[i] != 0 && factor.mean != 0) power[i].add(factor.mean * cubic.c[i], record.sum);
  if (factor.amplitude == 0) return;
  for (Scalar& c : cubic.c) c *= factor.amplitude;
  const auto same = [&](const Wave<Scalar>& wave) noexcept {
    return cubic.is_constant() && wave.cubic.is_constant() && wave.rate == factor.rate && wave.phase == factor.phase;
  };
  const auto found = std::find_if(waves.begin(), waves.end(), same);
  if (found != waves.end()) {
    found->terms.add(cubic.c[0] / found->cubic.c[0], record.sum);
  } else if (cubic.c != std::array<Scalar, 4>{}) {
    waves.push_back({record.sum, cubic, factor.rate, factor.phase});
  }
}

template <Real Scalar>
void Piece<Scalar>::take_wheels(const Problem<Scalar>& problem, const Wheels<Scalar>& all,
                                const Piece* before) noexcept {
  momentum.fill({0, 0, 0});
  momentum[0] = all.rotor_momentum;
  for (std::size_t i = 0; i < all.count; ++i) {
    const WheelLaw<Scalar>& law = all.laws[i];
    WheelPiece<Scalar>& mine = wheels[i];
    Cubic<Scalar> table{from, {}};
    if (law.tabled) table = piece(problem.wheels[i].table, 1, 0, inside()).about(from);
    const Scalar length = before != nullptr ? from - before->from : Scalar(0);
    if (before != nullptr && law.follows != Follows::state && law.follows != Follows::body)
      mine.add_up(before->wheels[i], length, law.axial_inertia);
    switch (law.follows) {
      case Follows::body: continue;
      case Follows::rate:
        if (!law.tabled) mine.c[0] = law.axial_inertia * law.rate;
        for (std::size_t k = 0; law.tabled && k < 4; ++k) mine.c[k] = law.axial_inertia * table.c[k];
        break;
      case Follows::constant: mine.c[0] = law.momentum; break;
      case Follows::integral:
        mine.c[0] = law.momentum;
        if (before != nullptr) mine.go_on(before->wheels[i], length);
        table.c[0] += law.torque;
        for (std::size_t k = 0; k < 4; ++k) mine.c[k + 1] = table.c[k] / Scalar(int(k) + 1);
        break;
      case Follows::state:
        table.c[0] += law.torque;
        std::copy(table.c.begin(), table.c.end(), mine.c.begin());
        continue;
    }
    // that of wheels held at a constant rate is in rotor_momentum
    if (law.follows == Follows::rate && !law.tabled) continue;
    for (std::size_t k = 0; k < 5; ++k) momentum[k] += mine.c[k] * law.axis;
  }
}

}  // namespace gyrostat::general
