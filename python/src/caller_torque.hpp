// SPDX-License-Identifier: BSD-3-Clause
// A torque of the caller's own, from Python: a callable, or the address of a compiled function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "convert.hpp"
#include "gil.hpp"
#include "gyrostat/models/general/torque_law.hpp"

namespace gyrostat::python {

/// What a compiled torque is: state holds attitude [x, y, z, w], angular velocity (3), angular momentum (3) and the rates of the wheels, one
/// behind the other; torque (3) is written.
using CompiledTorque = void (*)(double t, const double* state, double* torque);

/// Stays where it is while a scene has its law. What a callable raises is kept, and it is not asked any more.
class CallerTorque {
 public:
  /// given: None, a callable, or an address. clock: what is added to the time of the motion for it, s.
  CallerTorque(const py::object& given, std::size_t wheels, double clock) : wheels_(wheels), clock_(clock) {
    if (given.is_none()) return;
    if (py::isinstance<py::int_>(given)) compiled_ = reinterpret_cast<CompiledTorque>(given.cast<std::uintptr_t>());
    else callable_ = given;
  }
  CallerTorque(const CallerTorque&) = delete;
  CallerTorque& operator=(const CallerTorque&) = delete;

  /// None where nothing is given.
  general::OwnTorque law(std::vector<double> breakpoints) {
    if (compiled_ != nullptr) return {&by_address, this, std::move(breakpoints), &lost_at_};
    if (callable_) return {&by_call, this, std::move(breakpoints), &lost_at_};
    return {};
  }

  /// Raises what the callable has raised, or where it has no value.
  void raise_what_ended_it() const {
    if (raised_) std::rethrow_exception(raised_);
    if (lost_at_ == lost_at_)
      raise("DomainError",
            "torque: it has no finite value at t = " + text(lost_at_ + clock_) + " s, and the motion ends there");
  }

 private:
  static Vec3<double> by_address(const void* its, double t, const general::Seen<double>& seen) noexcept {
    const auto& self = *static_cast<const CallerTorque*>(its);
    const auto state = general::numbers_of(seen);
    double torque[3] = {nan<double>, nan<double>, nan<double>};
    self.compiled_(t + self.clock_, state.data(), torque);
    return {torque[0], torque[1], torque[2]};
  }
  static Vec3<double> by_call(const void* its, double t, const general::Seen<double>& seen) noexcept {
    const auto& self = *static_cast<const CallerTorque*>(its);
    constexpr double no = nan<double>;
    if (self.raised_) return {no, no, no};
    const Locked hold;
    try {
      return self.called(t + self.clock_, general::numbers_of(seen));
    } catch (...) {
      self.raised_ = std::current_exception();
      return {no, no, no};
    }
  }
  Vec3<double> called(double t, std::span<const double> state) const {
    const auto part = [&](std::size_t from, std::size_t size) {
      return py::array_t<double>(py::ssize_t(size), state.data() + from);
    };
    const py::object made = callable_(t, part(0, 4), part(4, 3), part(7, 3), part(10, wheels_));
    const auto torque = Array::ensure(made);
    if (!torque || torque.ndim() != 1 || torque.size() != 3) {
      PyErr_Clear();
      raise("DomainError",
            "torque: it gave " + py::repr(made).cast<std::string>() + "; give three numbers, N m along the body axes");
    }
    return {torque.data()[0], torque.data()[1], torque.data()[2]};
  }

  std::size_t wheels_;
  double clock_, lost_at_ = nan<double>;
  CompiledTorque compiled_ = nullptr;
  py::object callable_;
  mutable std::exception_ptr raised_;
};

}  // namespace gyrostat::python
