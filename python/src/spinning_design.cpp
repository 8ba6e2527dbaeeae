// SPDX-License-Identifier: BSD-3-Clause
// Designs of a thrusting spinner over rows; gyrostat/design.py wraps them.
#include <string>
#include <vector>

#include "bind.hpp"
#include "convert.hpp"
#include "gil.hpp"
#include "gyrostat/models/spinning/design.hpp"
#include "spinning_arguments.hpp"

namespace of_spinning {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::spinning;

using Solver = Result<Design<double>> (*)(const Problem<double>&, double) noexcept;

Solver solver(const std::string& goal) {
  if (goal == "spin-for-pointing") return &spin_for_pointing<double>;
  if (goal == "torque-for-direction") return &torque_for_direction<double>;
  if (goal == "burn-for-displacement") return &burn_for_displacement<double>;
  if (goal == "burn-for-velocity") return &burn_for_velocity<double>;
  raise("DomainError", "goal = '" + goal + "': unknown");
}

/// Why there is no design; empty where there is one.
const char* reason(Errc code) {
  switch (code) {
    case Errc::ok: return "";
    case Errc::zero_vector: return "no-torque";
    case Errc::step_limit: return "too-long";
    case Errc::not_finite: return "never-reached";
    default: return "not-covered";
  }
}

/// Arrays (rows,); without a design NaN.
Data design_rows(const SpinningProblems& problems, const std::string& goal, const Array& budget) {
  const Solver solve = solver(goal);
  const auto& bodies = problems.rows();
  const auto rows = py::ssize_t(bodies.size());
  require_shape("budget", budget, {rows});
  std::vector<Result<Design<double>>> made;
  made.reserve(bodies.size());
  {
    const Unlocked free;
    for (std::size_t row = 0; row < bodies.size(); ++row) made.push_back(solve(bodies[row], budget.data()[row]));
  }
  std::vector<double> value, tilt, unstable, resonant, compliant;
  py::list why;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const auto& design = made[row];
    if (design.error() == Errc::out_of_domain)
      raise("DomainError", (rows > 1 ? "row " + std::to_string(row) + ": " : std::string()) +
                               "budget = " + text(budget.data()[row]) + ": give a finite number > 0" +
                               (goal == "torque-for-direction" ? " and < pi/2"
                                : goal.starts_with("burn")     ? " with a square that a double holds"
                                                               : ""));
    value.push_back(design ? design->value : missing);
    tilt.push_back(design ? design->tilt : missing);
    unstable.push_back(design->flags.unstable);
    resonant.push_back(design->flags.resonant);
    compliant.push_back(design->flags.compliant);
    why.append(reason(design.error()));
  }
  Data out;
  out["value"] = array(std::move(value), {rows});
  out["tilt"] = array(std::move(tilt), {rows});
  out["unstable"] = array(std::move(unstable), {rows});
  out["resonant"] = array(std::move(resonant), {rows});
  out["compliant"] = array(std::move(compliant), {rows});
  out["why"] = why;
  return out;
}

}  // namespace
}  // namespace of_spinning

void bind_spinning_design(pybind11::module_& module) {
  using namespace of_spinning;
  module.def("spinning_design", &design_rows, py::arg("problems"), py::kw_only(), py::arg("goal"), py::arg("budget"),
             "Value, bound of the tilt, unstable, resonant, compliant, and why there is no design, a row each.");
}
