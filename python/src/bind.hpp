// SPDX-License-Identifier: BSD-3-Clause
// One function a family of models, each defined in its own translation unit and called by module.cpp.
#pragma once

#include <pybind11/pybind11.h>
