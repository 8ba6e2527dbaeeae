// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/series.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The torques of a piece as the steps of the full equations want them: which inertial directions they see, and their coefficients in
/// rows.
namespace gyrostat::general {

/// The inertial directions that torques depend on: one, or the three axes.
template <Real Scalar>
struct Directions {
  int count = 0;
  std::array<Vec3<Scalar>, 3> of;  ///< unit, inertial axes

  /// Makes v a combination of the directions.
  void need(const Vec3<Scalar>& v) noexcept {
    if (v.isZero(0) || count == 3) return;
    if (count == 0) {
      of[0] = v / magnitude(v);
      count = 1;
    } else if (cross<Scalar>(of[0], v).cwiseAbs().maxCoeff() > 4 * epsilon<Scalar> * v.cwiseAbs().maxCoeff()) {
      need_all();
    }
  }
  void need_all() noexcept {
    for (int i = 0; i < 3; ++i) of[static_cast<std::size_t>(i)] = Vec3<Scalar>::Unit(i);
    count = 3;
  }
  /// The component of v along direction i.
  Scalar share(int i, const Vec3<Scalar>& v) const noexcept { return of[static_cast<std::size_t>(i)].dot(v); }
};

/// Which of the vectors that move in inertial space a sum of torques depends on.
struct Sees {
  bool orbit_axes = false, orbit_gradient = false, field = false, field_rate = false, down = false;
  bool total_brake = false, carrier_brake = false;
  bool body_force = false, force = false;

  template <Real Scalar>
  void add(const Terms<Scalar>& terms) noexcept {
    orbit_axes = orbit_axes || !terms.orbital[0].isZero(0) || !terms.orbital[1].isZero(0);
    orbit_gradient = orbit_gradient || terms.orbit_gradient != 0;
    down = down || terms.gradient != 0;
    field_rate = field_rate || !terms.eddy.isZero(0);
    field = field || field_rate || !terms.dipole.isZero(0);
    total_brake = total_brake || !terms.brake_total.isZero(0);
    carrier_brake = carrier_brake || !terms.brake_carrier.isZero(0);
    body_force = body_force || !terms.force_body.isZero(0);
    force = force || body_force || !terms.force_inertial.isZero(0);
  }
};

/// Adds the directions that a sum of torques sees.
template <Real Scalar>
void add_directions(Directions<Scalar>& directions, const Terms<Scalar>& terms, const Vec3<Scalar>& normal) noexcept {
  for (int i = 0; i < 9; ++i) directions.need({terms.inertial[0](i), terms.inertial[1](i), terms.inertial[2](i)});
  if (!terms.orbital[2].isZero(0)) directions.need(normal);
}

/// The torques of one factor: coefficients in rows, and which of them there are.
template <Real Scalar>
struct Part {
  Columns<Scalar> by_rate, by_momentum, radial, along, eddy, direction[3];
  Lanes<Scalar> body, brake_total, brake_carrier, dipole;
  Scalar gradient = 0, orbit_gradient = 0;
  bool has_rate = false, has_momentum = false, has_directions = false, has_orbital = false, has_eddy = false,
       has_dipole = false, has_total = false, has_carrier = false;

  Part() = default;
  Part(const Terms<Scalar>& terms, const Directions<Scalar>& directions, const Vec3<Scalar>& normal) noexcept
      : by_rate(terms.by_rate),
        by_momentum(terms.by_momentum),
        radial(terms.orbital[0]),
        along(terms.orbital[1]),
        eddy(terms.eddy),
        body(row(terms.body)),
        brake_total(row(terms.brake_total)),
        brake_carrier(row(terms.brake_carrier)),
        dipole(row(terms.dipole)),
        gradient(terms.gradient),
        orbit_gradient(terms.orbit_gradient),
        has_rate(!terms.by_rate.isZero(0)),
        has_momentum(!terms.by_momentum.isZero(0)),
        has_orbital(!terms.orbital[0].isZero(0) || !terms.orbital[1].isZero(0)),
        has_eddy(!terms.eddy.isZero(0)),
        has_dipole(!terms.dipole.isZero(0)),
        has_total(!terms.brake_total.isZero(0)),
        has_carrier(!terms.brake_carrier.isZero(0)) {
    for (int i = 0; i < directions.count; ++i) {
      Mat3<Scalar> by = directions.share(i, normal) * terms.orbital[2];
      for (std::size_t j = 0; j < 3; ++j) by += directions.of[std::size_t(i)][int(j)] * terms.inertial[j];
      direction[i] = Columns<Scalar>(by);
      has_directions = has_directions || !by.isZero(0);
    }
  }

  /// Whether there is a torque that is not linear in M, w and the directions.
  bool is_nonlinear() const noexcept {
    return has_orbital || has_eddy || has_dipole || has_total || has_carrier || gradient != 0 || orbit_gradient != 0;
  }
  /// Whether there is one that depends on the motion.
  bool moves() const noexcept { return is_nonlinear() || has_rate || has_momentum || has_directions; }
};

/// The most factors at a time of torques that depend on the motion, powers of time and waves.
inline constexpr int most_factors = 3 + int(most_waves);

}  // namespace gyrostat::general
