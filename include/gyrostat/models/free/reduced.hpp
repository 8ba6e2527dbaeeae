// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/body/realisability.hpp"
#include "gyrostat/body/rotor.hpp"
#include "gyrostat/core/bounded_list.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/bracket.hpp"
#include "gyrostat/models/free/problem.hpp"

/// Any number of rotors on a free body, taken into the inertia and the rotor momentum of a gyrostat. With every rotor locked J, axis u,
/// axial inertia I, rate relative to the body:
///     held by a motor at its rate   l += I rate u; the motor works, so that omega.J omega/2 is kept and not the energy of the whole
///     free of friction              p = I (rate + u.omega) is kept:  l += p u,  J := J - I u u^T
namespace gyrostat::free {

template <Real Scalar>
struct Wheel {
  Vec3<Scalar> axis{0, 0, 1};  ///< body axes, of unit length within 1e-8
  Scalar axial_inertia = 1;    ///< kg m^2
  Scalar rate = 0;             ///< relative to the body at t = 0, rad/s
  bool turns_freely = false;   ///< else a motor holds the rate
};

/// Room for any number of wheels, on the heap.
struct Unbounded {
  template <class T>
  using List = std::vector<T>;
};
/// Room for some wheels, without the heap.
template <std::size_t most>
struct AtMost {
  template <class T>
  using List = BoundedList<T, most>;
};

/// A body with rotors: `body.inertia` is that with every rotor locked, `body.rotor_momentum` that of rotors that are not listed, held.
template <Real Scalar, class Room = Unbounded>
struct Assembly {
  Problem<Scalar> body;
  typename Room::template List<Wheel<Scalar>> wheels;

  /// Whether body axes are principal axes: no product of inertia, nor one that an oblique free wheel leaves.
  bool has_axes() const noexcept {
    const auto oblique = [](const Wheel<Scalar>& wheel) noexcept {
      const auto& u = wheel.axis;
      return wheel.turns_freely && (u[0] == Scalar(0)) + (u[1] == Scalar(0)) + (u[2] == Scalar(0)) < 2;
    };
    return body.inertia.isDiagonal(0) && std::none_of(wheels.begin(), wheels.end(), oblique);
  }

  template <Real To>
  Assembly<To, Room> cast() const {
    Assembly<To, Room> made{body.template cast<To>(), {}};
    for (const auto& w : wheels)
      made.wheels.push_back({vector_cast<To>(w.axis), To(w.axial_inertia), To(w.rate), w.turns_freely});
    return made;
  }
};

/// Why an assembly was refused: which wheel (-1: the body), and the axial inertia that it would have to stay below, kg m^2.
template <Real Scalar>
struct UnsoundWheel {
  int wheel = -1;
  Scalar limit = infinity<Scalar>;
};

template <Real Scalar, class Room = Unbounded>
struct Reduced {
  struct Turning {
    Vec3<Scalar> axis{0, 0, 1};
    Scalar rate = 0;  ///< held: relative to the body; free: p/I, the part along the axis relative to space, rad/s
    bool turns_freely = false;
  };
  Problem<Scalar> problem;
  typename Room::template List<Turning> wheels;

  /// Relative to the body, rad/s, where the body turns at omega.
  Scalar wheel_rate(std::size_t i, const Vec3<Scalar>& omega) const noexcept {
    return wheels[i].turns_freely ? wheels[i].rate - wheels[i].axis.dot(omega) : wheels[i].rate;
  }

  /// Errors: those of Problem::check(); of a wheel those of Rotor::from_axis; triangle_inequality where a free wheel leaves an inertia
  /// that is not positive or that no mass distribution has. `unsound` tells which wheel.
  template <Real Given>
  static Result<Reduced> of(const Assembly<Given, Room>& assembly, UnsoundWheel<Given>* unsound = nullptr) noexcept;

  /// The same of an assembly that is known to be sound.
  template <Real Given>
  static Reduced taken(const Assembly<Given, Room>& assembly) noexcept;

 private:
  template <Real Given>
  static Errc check_wheels(const Assembly<Given, Room>& assembly, UnsoundWheel<Given>* unsound) noexcept {
    Mat3<Given> J = assembly.body.inertia, known = Mat3<Given>::Zero();
    for (std::size_t i = 0; i < assembly.wheels.size(); ++i) {
      const auto& wheel = assembly.wheels[i];
      if (unsound) unsound->wheel = static_cast<int>(i);
      const auto rotor = Rotor<Given>::from_axis(wheel.axis, wheel.axial_inertia);
      if (!rotor) return rotor.error();
      if (!std::isfinite(wheel.rate)) return Errc::not_finite;
      if (!wheel.turns_freely) continue;
      const auto allowed = [&](Given axial_inertia) {
        const auto tried = *Rotor<Given>::from_axis(wheel.axis, axial_inertia);
        const Mat3<Given> rest = tried.inertia_without(J), parts = known + tried.least_second_moments();
        return symmetric_eigen<Given>(rest).values[0] > 64 * epsilon<Given> * J.trace() &&
               realisability<Given>(assembly.body.inertia, parts) >= -64 * epsilon<Given> * J.trace();
      };
      if (!allowed(wheel.axial_inertia)) {
        if (unsound)
          unsound->limit = math::Bracket<Given>{0, wheel.axial_inertia}
                               .halved(200, [&](Given I) { return I > 0 && allowed(I); })
                               .yes;
        return Errc::triangle_inequality;
      }
      J = rotor->inertia_without(J);
      known += rotor->least_second_moments();
    }
    if (unsound) *unsound = {};
    return Errc::ok;
  }
};

template <Real Scalar, class Room>
template <Real Given>
Result<Reduced<Scalar, Room>> Reduced<Scalar, Room>::of(const Assembly<Given, Room>& assembly,
                                                        UnsoundWheel<Given>* unsound) noexcept {
  if (const Errc wrong = assembly.body.check(); wrong != Errc::ok) return wrong;
  if (const Errc wrong = check_wheels(assembly, unsound); wrong != Errc::ok) return wrong;
  return taken(assembly);
}

template <Real Scalar, class Room>
template <Real Given>
Reduced<Scalar, Room> Reduced<Scalar, Room>::taken(const Assembly<Given, Room>& assembly) noexcept {
  Reduced reduced;
  reduced.problem = assembly.body.template cast<Scalar>();
  Problem<Scalar>& body = reduced.problem;
  typename Room::template List<Scalar> inertia;
  Vec3<Scalar> relative = body.rotor_momentum;  // of all rotors
  for (const auto& wheel : assembly.wheels) {
    const Vec3<Scalar> axis = vector_cast<Scalar>(wheel.axis);
    reduced.wheels.push_back({axis / axis.norm(), Scalar(wheel.rate), wheel.turns_freely});
    inertia.push_back(wheel.axial_inertia);
    relative += inertia.back() * Scalar(wheel.rate) * reduced.wheels.back().axis;
  }
  const Vec3<Scalar> omega = body.momentum_given
                                 ? Vec3<Scalar>(body.inertia.inverse() * (body.angular_momentum - relative))
                                 : body.angular_velocity;
  for (std::size_t i = 0; i < reduced.wheels.size(); ++i) {
    Turning& wheel = reduced.wheels[i];
    if (wheel.turns_freely) {
      wheel.rate += wheel.axis.dot(omega);
      body.inertia -= inertia[i] * wheel.axis * wheel.axis.transpose();
    }
    body.rotor_momentum += inertia[i] * wheel.rate * wheel.axis;
  }
  return reduced;
}

#ifdef GYROSTAT_COMPILED
extern template Result<Reduced<double>> Reduced<double>::of<double>(const Assembly<double>&,
                                                                    UnsoundWheel<double>*) noexcept;
extern template Reduced<double> Reduced<double>::taken<double>(const Assembly<double>&) noexcept;
extern template Reduced<DoubleDouble> Reduced<DoubleDouble>::taken<double>(const Assembly<double>&) noexcept;
extern template Reduced<DoubleDouble> Reduced<DoubleDouble>::taken<DoubleDouble>(
    const Assembly<DoubleDouble>&) noexcept;
#endif

}  // namespace gyrostat::free
