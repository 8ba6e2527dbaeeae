// SPDX-License-Identifier: BSD-3-Clause
// One function a source file of bindings, called by module.cpp. Several families are compiled as one unit: what is a family's alone is in a
// namespace of_<family>.
#pragma once

#include <pybind11/pybind11.h>

void bind_elliptic(pybind11::module_& module);
void bind_families(pybind11::module_& module);
void bind_deceleration_published(pybind11::module_& module);
void bind_rotation(pybind11::module_& module);
void bind_text(pybind11::module_& module);
void bind_sweep(pybind11::module_& module);
void bind_deceleration(pybind11::module_& module);
void bind_deceleration_integrators(pybind11::module_& module);
void bind_rotor(pybind11::module_& module);
void bind_rotor_integrators(pybind11::module_& module);
void bind_rotor_steady(pybind11::module_& module);
void bind_rotor_published(pybind11::module_& module);
void bind_spinning(pybind11::module_& module);
void bind_spinning_integrators(pybind11::module_& module);
void bind_spinning_design(pybind11::module_& module);
void bind_spinning_published(pybind11::module_& module);
void bind_heavy(pybind11::module_& module);
void bind_heavy_integrators(pybind11::module_& module);
void bind_heavy_motions(pybind11::module_& module);
void bind_heavy_published(pybind11::module_& module);
void bind_free(pybind11::module_& module);
void bind_free_integrators(pybind11::module_& module);
void bind_general(pybind11::module_& module);
void bind_general_integrators(pybind11::module_& module);
