// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/general/instances.hpp"

/// Finds the families that a scene is an instance of.
namespace gyrostat::general {

namespace detail {

/// What recognition looks at.
struct Given {
  const Problem<double>& problem;
  const Wheels<double>& wheels;
  Loads loads;
  Spinners spinners;
  Question question;
};

}  // namespace detail

/// Of which families the scene is an instance, in some microseconds.
GYROSTAT_COMPILED_ONCE Instances recognise(const Problem<double>& problem, const Wheels<double>& wheels,
                                           const Collected<double>& torques, const Sizes<double>& sizes,
                                           const Question& question);

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/recognise_definition.hpp"
#endif
