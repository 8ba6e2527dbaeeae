// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "gyrostat/ladder/rotor/closed_form_rung.hpp"
#include "gyrostat/ladder/rotor/full_rung.hpp"
#include "gyrostat/ladder/rotor/linear_tail_rung.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/attractor.hpp"
#include "gyrostat/models/rotor/exceptional.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"

namespace gyrostat::rotor {

namespace detail {

/// The state at the last time, from the columns.
inline State<double> last_state(const Scene& scene, const Answer& answer) noexcept {
  const auto last = [&](const char* name) { return answer.find(name)->values.end(); };
  const auto H = last("angular_momentum"), Omega = last("angular_velocity");
  const auto& body = scene.gyrostat();
  State<double> state;
  state.momentum = {H[-3], H[-2], H[-1]};
  state.axial_momentum =
      body.axial_inertia() * (last("rotor_rate")[-1] + body.axis().dot(Vec3<double>(Omega[-3], Omega[-2], Omega[-1])));
  return state;
}

/// Where the motion tends to, and warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene) {
  const auto& body = scene.gyrostat();
  const auto warn = [&](const char* code, const char* text, double value) {
    answer.warnings.push_back({code, text, value});
  };
  if (!body.realisable())
    warn("not-realisable",
         "no mass distribution has this inertia and this rotor: tr(theta)/2 - theta - lambda/2 (1 - e e^T) has a "
         "negative "
         "eigenvalue, kg m^2",
         body.realisability());

  const State<double> state = last_state(scene, answer);
  const double l = state.momentum.norm();
  double index = nan<double>, rate = nan<double>;
  const auto steady = steady_rotations(body, l);
  const auto attractor = certify(body, steady, state.momentum, state.axial_momentum);
  if (attractor.index >= 0) {
    index = attractor.index;
    rate = stability_of(body, l, steady[attractor.index]).decay_rate;
  }
  answer.quantities.push_back({"attractor", 1, {index}});
  answer.quantities.push_back({"decay_rate", 1, {rate}});

  const auto family = exceptional_distance(body, l).family;
  if (body.slope() == 0) {
    warn("no-motor", "the motor has no slope: nothing is dissipated and no steady rotation attracts", nan<double>);
  } else if (family == Exceptional::axisymmetric) {
    warn("no-attractor", "the body is symmetric about the rotor's axis: it precesses for ever", nan<double>);
  } else if (family == Exceptional::principal_axis && attractor.index >= 0 && std::isnan(rate)) {
    warn("marginal", "the rotor lies on a principal axis: the nutation dies out like 1/sqrt(t), at no exponential rate",
         nan<double>);
  } else if (attractor.certificate == Certificate::undecided && l > 0) {
    warn("attractor-undecided",
         steady.count > 0 && attractor.margin > 0
             ? "two steady rotations attract and the motion has not chosen at the last time; V is above the lowest "
               "saddle by, J"
             : "the motion stands on an unstable steady rotation or a barrier: rounding decides where it goes",
         attractor.margin);
  }
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  static constexpr std::array<Rung<Scene, Track>, 3> rungs{
      {{"closed-form", &closed_form_track}, {"linear-tail", &linear_tail_track}, {"full", &full_track}}};
  const int only = int(scene.data().model) - 1;
  Answer answer = climb<Scene, Track>(rungs, scene, scene.data().tolerance, only, monitor, refusal);
  if (refusal.code == Errc::ok) detail::describe(answer, scene);
  return answer;
}

}  // namespace gyrostat::rotor
