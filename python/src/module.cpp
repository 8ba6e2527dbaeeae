// SPDX-License-Identifier: BSD-3-Clause
// The extension module gyrostat._core: what the build holds, and the bindings of each family.
#include <pybind11/typing.h>

#include <Eigen/Core>
#include <memory>

#include "answer.hpp"
#include "bind.hpp"
#include "gil.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/version.hpp"

namespace py = pybind11;

namespace {

#ifndef GYROSTAT_CVODE_VERSION
#define GYROSTAT_CVODE_VERSION nullptr
#endif

using BuildInfo = py::typing::Dict<py::str, py::typing::Optional<py::str>>;

py::object text_or_none(const char* text) {
  return text == nullptr ? py::object(py::none()) : py::object(py::str(text));
}

/// Version of GSL in the extension gyrostat._gsl; None where that is not installed or finds no GSL. To know it is to load it.
py::object gsl_version() {
  try {
    return py::module_::import("gyrostat._gsl").attr("version");
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) throw;
    return py::none();
  }
}

/// The level of x86-64 instructions that this module was compiled for; null on other processors.
constexpr const char* instruction_level() noexcept {
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && \
    defined(__AVX512VL__)
  return "x86-64-v4";
#elif defined(__AVX2__) && defined(__FMA__) && defined(__BMI2__) && defined(__F16C__) && defined(__LZCNT__)
  return "x86-64-v3";
#elif defined(__SSE4_2__) && defined(__POPCNT__)
  return "x86-64-v2";
#elif defined(__x86_64__)
  return "x86-64-v1";
#else
  return nullptr;
#endif
}

BuildInfo build_info() {
  BuildInfo info;
  info["version"] = gyrostat::library_version();
  info["compiler"] = __VERSION__;
  info["level"] = text_or_none(instruction_level());
  info["eigen"] = py::str("{}.{}.{}").format(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  info["gsl"] = gsl_version();
  info["cvode"] = text_or_none(GYROSTAT_CVODE_VERSION);
  return info;
}

}  // namespace

// Nothing here is shared between threads but what the caller shares; tests/python/test_threads.py runs all of it at once.
PYBIND11_MODULE(_core, module, py::mod_gil_not_used()) {
  module.doc() = "Compiled core of gyrostat.";
  module.attr("__version__") = gyrostat::library_version();
  module.def(
      "build_info", &build_info,
      "Version of the library, of the compiler, and of each optional library (None: this installation has it not).");
  py::class_<gyrostat::Monitor, std::shared_ptr<gyrostat::Monitor>>(module, "Monitor",
                                                                    "Watches and stops long work from another thread.")
      .def(py::init([] {
        auto made = std::make_shared<gyrostat::Monitor>();
        made->stop = &gyrostat::python::signalled;
        return made;
      }))
      .def_property_readonly(
          "progress", [](const gyrostat::Monitor& m) { return m.fraction.load(); },
          "Share of the work done, from 0 to 1.")
      .def_property_readonly(
          "cancelled", [](const gyrostat::Monitor& m) { return m.cancel.load(); }, "Whether cancel() was called.")
      .def(
          "cancel", [](gyrostat::Monitor& m) { m.cancel.store(true); },
          "Ask the work to stop: it raises Cancelled soon after.");
  py::module_::import("atexit").attr("register")(py::cpp_function(&gyrostat::python::Lock::close));
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") =
                                                         py::cpp_function(&gyrostat::python::Lock::forget));
  bind_elliptic(module);
  bind_rotation(module);
  bind_text(module);
  bind_families(module);
  bind_sweep(module);
  bind_deceleration(module);
  bind_deceleration_integrators(module);
  bind_deceleration_published(module);
  bind_free(module);
  bind_free_integrators(module);
  bind_rotor(module);
  bind_rotor_integrators(module);
  bind_rotor_steady(module);
  bind_rotor_published(module);
  bind_spinning(module);
  bind_spinning_integrators(module);
  bind_spinning_design(module);
  bind_spinning_published(module);
  bind_heavy(module);
  bind_heavy_integrators(module);
  bind_heavy_motions(module);
  bind_heavy_published(module);
  bind_general(module);
  bind_general_integrators(module);
}
