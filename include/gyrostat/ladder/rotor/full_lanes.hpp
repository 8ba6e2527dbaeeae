// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/rotor/full_batch.hpp"
#include "gyrostat/ode/taylor_batch.hpp"

/// full_motion of many scenes, eight side by side in the lanes of the vector registers, the answers' runs and those of their companions alike.
namespace gyrostat::rotor {

/// A motion to be found: times, where its states go, and what is wanted; and the answer. What is pointed to must outlive the work.
struct LaneTask {
  const Gyrostat<double>* gyrostat = nullptr;
  State<double> start{};                ///< of unit attitude
  std::span<const double> times{};      ///< s, increasing, the first >= 0; not empty
  std::span<State<double>> states{};    ///< as many
  FullMotionOptions<double> options{};  ///< integrator: of the scenes that suits_lanes
  FullMotionAnswer<double> answer{};
};

/// Whether a motion can be found in lanes: one with a momentum, that is no work for collocation, no longer than some ten thousand turns, and of a
/// rotor that leaves the body some inertia about its axis.
inline bool suits_lanes(const Gyrostat<double>& gyrostat, const State<double>& start, double last,
                        Integrator integrator) noexcept {
  constexpr double longest = 1e5, least = 1e-140, left = 0.1;
  const double l = start.momentum.norm();
  return (integrator == Integrator::any || integrator == Integrator::taylor) && l > least && l < 1 / least &&
         gyrostat.coupling() > left && turning_rate(gyrostat, start) * last < longest &&
         (integrator == Integrator::taylor || !is_stiff(gyrostat, start));
}

/// Finds the motions. Their estimates are those of full_motion, by companions in lanes beside them, and like the answers
/// differ from its in the last bits, and in that the energy is not kept. No answer depends on other tasks. answer.status says what became of a task; one
/// that has not reached its last time may still be answered by full_motion. Every scene must suit the lanes. No heap.
GYROSTAT_COMPILED_ONCE void full_in_lanes(std::span<LaneTask> tasks) noexcept;

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/full_lanes_definition.hpp"
#endif
