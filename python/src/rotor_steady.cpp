// SPDX-License-Identifier: BSD-3-Clause
// Steady rotations of gyrostats with a driven rotor and where a motion goes, over rows; gyrostat/rotor.py and
// gyrostat/stability/rotor.py wrap them.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "gil.hpp"
#include "gyrostat/ladder/rotor/capture.hpp"
#include "gyrostat/ladder/rotor/fall_time.hpp"
#include "gyrostat/models/rotor/attractor.hpp"
#include "gyrostat/models/rotor/exceptional.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"
#include "rotor_arguments.hpp"

namespace of_rotor {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::rotor;

constexpr int most = 8;  // of SteadyRotations::at

using Bodies = std::vector<Gyrostat<double>>;

/// Rows of inertia (n, 3, 3), axis (n, 3) and numbers (n), checked.
Bodies bodies(const Array& inertia, const Array& axis, const Array& axial_inertia, const Array& slope,
              const Array& no_load_rate) {
  const py::ssize_t rows = axial_inertia.size();
  require_shape("inertia", inertia, {rows, 3, 3});
  require_shape("axis", axis, {rows, 3});
  require_shape("slope", slope, {rows});
  require_shape("no_load_rate", no_load_rate, {rows});
  Bodies made;
  made.reserve(std::size_t(rows));
  for (py::ssize_t row = 0; row < rows; ++row) {
    const double* theta = inertia.data() + 9 * row;
    const double* e = axis.data() + 3 * row;
    Mat3<double> tensor;
    for (int i = 0; i < 9; ++i) tensor(i / 3, i % 3) = theta[i];
    const auto body = Gyrostat<double>::make(tensor, {e[0], e[1], e[2]}, axial_inertia.data()[row], slope.data()[row],
                                             no_load_rate.data()[row]);
    if (!body)
      raise("DomainError", "row " + std::to_string(row) + ": inertia = " + text(Array({3, 3}, theta)) +
                               ", axial_inertia = " + text(axial_inertia.data()[row]) +
                               ", slope = " + text(slope.data()[row]) + ": " + message(body.error()));
    made.push_back(*body);
  }
  return made;
}

/// All steady rotations of rows of gyrostats and their stability, padded: -1 for codes, NaN for numbers.
Data steady_rows(const Array& inertia, const Array& axis, const Array& axial_inertia, const Array& slope,
                 const Array& no_load_rate, const Array& momentum) {
  const Bodies body = bodies(inertia, axis, axial_inertia, slope, no_load_rate);
  const auto rows = py::ssize_t(body.size());
  require_shape("momentum", momentum, {rows});
  for (py::ssize_t row = 0; row < rows; ++row)
    if (!(momentum.data()[row] >= 0) || !std::isfinite(momentum.data()[row]))
      raise("DomainError", "momentum, row " + std::to_string(row) + " = " + text(momentum.data()[row]) +
                               ": give a finite number >= 0");
  const auto n = body.size() * most;
  std::vector<double> direction(3 * n, missing), spin(n, missing), level(n, missing), type(n, -1), verdict(n, -1),
      isolated(n, -1), decay(n, missing), real(3 * n, missing), imaginary(3 * n, missing), cubic(4 * n, missing),
      determinant(n, missing), best_slope(n, missing), best_rate(n, missing), algebraic(n, missing);
  std::vector<double> count(body.size()), continuum(body.size()), family(body.size());
  {
    const Unlocked free;
    for (std::size_t row = 0; row < body.size(); ++row) {
      const double l = momentum.data()[row];
      const auto found = steady_rotations(body[row], l);
      count[row] = found.count;
      continuum[row] = found.sphere ? 2 : found.circle ? 1 : 0;
      family[row] = double(exceptional_distance(body[row], l).family);
      for (int i = 0; i < found.count; ++i) {
        const std::size_t at = row * most + std::size_t(i);
        const auto& rotation = found[i];
        const auto stability = stability_of(body[row], l, rotation);
        for (std::size_t j = 0; j < 3; ++j) {
          direction[3 * at + j] = rotation.direction[Eigen::Index(j)];
          real[3 * at + j] = stability.eigenvalues[j].real();
          imaginary[3 * at + j] = stability.eigenvalues[j].imag();
        }
        std::copy(stability.cubic.begin(), stability.cubic.end(), &cubic[4 * at]);
        spin[at] = rotation.spin_rate;
        level[at] = rotation.level;
        type[at] = double(rotation.type);
        isolated[at] = rotation.isolated;
        verdict[at] = double(stability.verdict);
        decay[at] = stability.decay_rate;
        determinant[at] = stability.determinant;
        best_slope[at] = stability.best_slope;
        best_rate[at] = stability.best_rate;
        algebraic[at] = algebraic_rate(body[row], l, rotation);
      }
    }
  }
  Data made;
  const auto matrix = [&](std::vector<double>& values) { return array(std::move(values), {rows, most}); };
  made["count"] = array(std::move(count), {rows});
  made["continuum"] = array(std::move(continuum), {rows});
  made["family"] = array(std::move(family), {rows});
  made["direction"] = array(std::move(direction), {rows, most, 3});
  made["spin_rate"] = matrix(spin);
  made["level"] = matrix(level);
  made["type"] = matrix(type);
  made["isolated"] = matrix(isolated);
  made["verdict"] = matrix(verdict);
  made["decay_rate"] = matrix(decay);
  made["eigenvalues_real"] = array(std::move(real), {rows, most, 3});
  made["eigenvalues_imaginary"] = array(std::move(imaginary), {rows, most, 3});
  made["cubic"] = array(std::move(cubic), {rows, most, 4});
  made["determinant"] = matrix(determinant);
  made["best_slope"] = matrix(best_slope);
  made["best_rate"] = matrix(best_rate);
  made["algebraic_rate"] = matrix(algebraic);
  return made;
}

/// Certificates of states of one gyrostat, angular_velocity (n, 3) and rotor_rate (n).
Data certify_rows(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
                  const Array& angular_velocity, const Array& rotor_rate) {
  const auto body = gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate);
  const py::ssize_t rows = rotor_rate.size();
  require_shape("angular_velocity", angular_velocity, {rows, 3});
  std::vector<double> momentum, index, certificate, level, margin;
  for (auto* values : {&momentum, &index, &certificate, &level, &margin}) values->reserve(std::size_t(rows));
  {
    const Unlocked free;
    for (py::ssize_t row = 0; row < rows; ++row) {
      const double* Omega = angular_velocity.data() + 3 * row;
      const auto state = body.state({}, {Omega[0], Omega[1], Omega[2]}, rotor_rate.data()[row]);
      const auto steady = steady_rotations(body, state.momentum.norm());
      const auto found = certify(body, steady, state.momentum, state.axial_momentum);
      momentum.push_back(state.momentum.norm());
      index.push_back(found.index);
      certificate.push_back(double(found.certificate));
      level.push_back(found.level);
      margin.push_back(found.margin);
    }
  }
  Data made;
  made["momentum"] = array(std::move(momentum), {rows});
  made["index"] = array(std::move(index), {rows});
  made["certificate"] = array(std::move(certificate), {rows});
  made["level"] = array(std::move(level), {rows});
  made["margin"] = array(std::move(margin), {rows});
  return made;
}

/// When the attractors of motions of one gyrostat are certified, by integration over at most `longest`.
Data capture_rows(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
                  const Array& angular_velocity, const Array& rotor_rate, double longest, double tolerance) {
  const auto body = gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate);
  const py::ssize_t rows = rotor_rate.size();
  require_shape("angular_velocity", angular_velocity, {rows, 3});
  positive("longest", longest);
  std::vector<double> index, certificate, time, margin;
  for (auto* values : {&index, &certificate, &time, &margin}) values->reserve(std::size_t(rows));
  {
    const Unlocked free;
    for (py::ssize_t row = 0; row < rows; ++row) {
      const double* Omega = angular_velocity.data() + 3 * row;
      const auto found =
          capture(body, body.state({}, {Omega[0], Omega[1], Omega[2]}, rotor_rate.data()[row]), longest, tolerance);
      index.push_back(found.attractor.index);
      certificate.push_back(double(found.attractor.certificate));
      margin.push_back(found.attractor.margin);
      time.push_back(found.time);
    }
  }
  Data made;
  made["index"] = array(std::move(index), {rows});
  made["certificate"] = array(std::move(certificate), {rows});
  made["time"] = array(std::move(time), {rows});
  made["margin"] = array(std::move(margin), {rows});
  return made;
}

/// From a state, the time for V to fall to the level `end` on the way to the minimum `valley`, by the mean over the nutation, s, and its
/// relative error; NaN where it is not known.
std::array<double, 2> fall_time(const Array& inertia, const Array& axis, double axial_inertia, double slope,
                                double no_load_rate, const Array& angular_velocity, double rotor_rate, int valley,
                                double end) {
  const auto body = gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate);
  const auto state = body.state({}, vector("angular_velocity", angular_velocity), finite("rotor_rate", rotor_rate));
  const double l = state.momentum.norm();
  const Unlocked free;
  const auto steady = steady_rotations(body, l);
  const auto fall = time_between_levels(body, steady, l, lobe_of(body, steady, state.momentum), valley,
                                        body.lyapunov(state.momentum, state.axial_momentum), end);
  return fall ? std::array{fall->time, fall->error()} : std::array{missing, missing};
}

/// The invariant circle of a body of the family circular_section.
Data section(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
             double momentum) {
  const auto circle =
      circular_section(gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate), positive("momentum", momentum));
  Data made;
  made["level"] = circle.level;
  made["drive"] = circle.drive;
  made["hold"] = circle.hold;
  made["tumbles"] = circle.tumbles;
  return made;
}

}  // namespace
}  // namespace of_rotor

void bind_rotor_steady(pybind11::module_& module) {
  using namespace of_rotor;
  module.def("rotor_steady", &steady_rows, py::kw_only(), py::arg("inertia"), py::arg("axis"), py::arg("axial_inertia"),
             py::arg("slope"), py::arg("no_load_rate"), py::arg("momentum"),
             "Steady rotations of rows of gyrostats, (n, 8), padded with -1 and NaN.");
  module.def("rotor_certify", &certify_rows, py::kw_only(), py::arg("inertia"), py::arg("axis"),
             py::arg("axial_inertia"), py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"),
             py::arg("rotor_rate"), "Attractors of states of one gyrostat as far as the algebra decides them.");
  module.def("rotor_capture", &capture_rows, py::kw_only(), py::arg("inertia"), py::arg("axis"),
             py::arg("axial_inertia"), py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"),
             py::arg("rotor_rate"), py::arg("longest"), py::arg("tolerance"),
             "When the attractors of motions are certified, by integration.");
  module.def("rotor_fall_time", &fall_time, py::kw_only(), py::arg("inertia"), py::arg("axis"),
             py::arg("axial_inertia"), py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"),
             py::arg("rotor_rate"), py::arg("valley"), py::arg("end"),
             "Time of a fall of V from a state to a level and its relative error; NaN where it is not known.");
  module.def("rotor_circular_section", &section, py::kw_only(), py::arg("inertia"), py::arg("axis"),
             py::arg("axial_inertia"), py::arg("slope"), py::arg("no_load_rate"), py::arg("momentum"),
             "Level, drive and hold of the invariant circle, and whether it is run through for ever.");
}
