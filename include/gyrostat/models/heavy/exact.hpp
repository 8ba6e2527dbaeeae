// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <variant>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/euler_case.hpp"
#include "gyrostat/models/heavy/exact_error.hpp"
#include "gyrostat/models/heavy/lagrange_gradient.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "gyrostat/models/heavy/pendulum.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

/// The cases that are known in closed form or by quadrature (docs/heavy.md, section 7).
enum class ExactCase : std::uint8_t {
  none,
  euler,     ///< no torque
  lagrange,  ///< an axis of symmetry through the mass centre, with or without gradient
  pendulum,  ///< a principal axis stays horizontal
};

/// Short name of a case, as scene answers print it.
constexpr const char* symbol(ExactCase which) noexcept {
  switch (which) {
    case ExactCase::none: return "none";
    case ExactCase::euler: return "euler";
    case ExactCase::lagrange: return "lagrange";
    case ExactCase::pendulum: return "pendulum";
  }
  return "?";
}

/// The exact motion from a start where there is one, the first case of the list that holds within rounding.
template <Real Scalar>
class Exact {
 public:
  Exact(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    if (const auto euler = EulerCase<Scalar>::make(problem, start)) motion_ = *euler;
    else if (const auto top = LagrangeTop<Scalar>::make(problem, start)) motion_ = *top;
    else if (const auto pulled = LagrangeGradient<Scalar>::make(problem, start)) motion_ = *pulled;
    else if (const auto pendulum = Pendulum<Scalar>::make(problem, start)) motion_ = *pendulum;
  }

  ExactCase which() const noexcept {
    constexpr ExactCase of[] = {ExactCase::none, ExactCase::euler, ExactCase::lagrange, ExactCase::lagrange,
                                ExactCase::pendulum};
    return of[motion_.index()];
  }
  bool applies() const noexcept { return which() != ExactCase::none; }

  /// NaN where none applies.
  State<Scalar> at(Scalar t) const noexcept {
    return visited([&](const auto& m) { return m.at(t); },
                   State<Scalar>{none(), none(), {unknown, unknown, unknown, unknown}});
  }
  /// Bound of the error of at() up to time |t|; infinite where none applies. uneven: by how much more than it shows a top is off its symmetry, relative.
  ExactError<Scalar> error(Scalar t, Scalar uneven = 0) const noexcept {
    constexpr Scalar open = infinity<Scalar>;
    return visited(
        [&](const auto& m) {
          if constexpr (requires { m.lasting(); }) return m.error(t, uneven);
          else return m.error(t);
        },
        ExactError<Scalar>{open, open, open});
  }
  /// What of it a top's lack of symmetry makes alone; of other motions nothing.
  ExactError<Scalar> uneven_error(Scalar t, Scalar uneven) const noexcept {
    return visited(
        [&](const auto& m) {
          if constexpr (requires { m.lasting(); }) return m.uneven_error(t, uneven);
          else return ExactError<Scalar>{};
        },
        ExactError<Scalar>{});
  }
  /// What rounding has put the data off symmetry or plane, and the motion leaves out; relative.
  Scalar defect() const noexcept {
    return visited(
        [](const auto& m) {
          if constexpr (requires { m.defect(); }) return m.defect();
          else return Scalar(0);
        },
        Scalar(0));
  }
  /// Of what repeats itself, s: of the angular velocity in the body (euler, pendulum), of the nutation (lagrange). NaN
  /// where none applies.
  Scalar period() const noexcept {
    return visited(
        [](const auto& m) {
          if constexpr (requires { m.nutation_period(); }) return m.nutation_period();
          else return m.period();
        },
        unknown);
  }

  /// The motion itself, nullptr where it is another one.
  const EulerCase<Scalar>* euler() const noexcept { return std::get_if<1>(&motion_); }
  const LagrangeTop<Scalar>* top() const noexcept { return std::get_if<2>(&motion_); }
  const LagrangeGradient<Scalar>* top_in_gradient() const noexcept { return std::get_if<3>(&motion_); }
  const Pendulum<Scalar>* pendulum() const noexcept { return std::get_if<4>(&motion_); }

 private:
  static constexpr Scalar unknown = nan<Scalar>;
  static Vec3<Scalar> none() noexcept { return Vec3<Scalar>::Constant(unknown); }

  template <class Function, class Value>
  Value visited(const Function& f, const Value& otherwise) const noexcept {
    if (const auto* m = euler()) return f(*m);
    if (const auto* m = top()) return f(*m);
    if (const auto* m = top_in_gradient()) return f(*m);
    if (const auto* m = pendulum()) return f(*m);
    return otherwise;
  }

  std::variant<std::monostate, EulerCase<Scalar>, LagrangeTop<Scalar>, LagrangeGradient<Scalar>, Pendulum<Scalar>>
      motion_;
};

#ifdef GYROSTAT_COMPILED
extern template class Exact<double>;
#endif

}  // namespace gyrostat::heavy
