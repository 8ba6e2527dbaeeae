// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <span>
#include <utility>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/monitor.hpp"

namespace gyrostat {

/// What a rung hands back: the answer in its own terms, or why it has none. `fill(answer, scene, track)` turns it into
/// columns and sets answer.error.
template <class Track, class Scene>
concept RungResult = requires(const Track& track, const Scene& scene, Answer& answer) {
  { track.failure } -> std::convertible_to<Errc>;
  { track.refusal } -> std::convertible_to<const char*>;
  { track.known_error } -> std::convertible_to<double>;
  { track.in_domain } -> std::convertible_to<bool>;
  fill(answer, scene, track);
};

/// A model of a scene: a name and a function that says whether it applies, answers, estimates its own error and counts
/// its work.
template <class Scene, class Track>
struct Rung {
  const char* name;
  Track (*answer)(const Scene&, Monitor*);
};

/// Why a climb ended without an answer.
struct Refusal {
  Errc code = Errc::ok;
  const char* model = "";
  const char* why = "";
};

/// The answer of the first rung, cheapest first, whose own error estimate meets the tolerance; failing that the most
/// accurate of those that answered, one in its domain before any outside, with met false. `only` names a single rung, which then answers wherever it can.
/// On failure the answer's `tried` still tells what was looked at.
template <class Scene, class Track>
  requires RungResult<Track, Scene>
Answer climb(std::span<const Rung<Scene, Track>> rungs, const Scene& scene, double tolerance, int only,
             Monitor* monitor, Refusal& refusal) {
  Answer best;
  std::vector<Attempt> tried;
  bool answered = false, best_in_domain = false;
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    if (only >= 0 && i != std::size_t(only)) continue;
    const Track track = rungs[i].answer(scene, monitor);
    if (track.failure != Errc::ok) {
      tried.push_back({rungs[i].name, track.known_error, false, track.refusal});
      refusal = {track.failure, rungs[i].name, track.refusal ? track.refusal : message(track.failure)};
      if (track.failure == Errc::cancelled) break;
      continue;
    }
    Answer answer;
    answer.model = rungs[i].name;
    answer.tolerance = tolerance;
    fill(answer, scene, track);
    answer.met = track.in_domain && answer.error <= tolerance;
    tried.push_back({rungs[i].name, answer.error, answer.met || only >= 0,
                     track.in_domain ? nullptr : "the scene leaves its domain"});
    const bool same_kind = track.in_domain == best_in_domain;
    if (!answered || answer.met ||
        (same_kind ? answer.error < best.error || best.error != best.error : track.in_domain)) {
      best = std::move(answer);
      best_in_domain = track.in_domain;
    }
    answered = true;
    if (best.met) break;
  }
  best.tried = std::move(tried);
  if (answered) {
    refusal = {};
    for (Attempt& attempt : best.tried) attempt.accepted = attempt.model == best.model;
  }
  return best;
}

}  // namespace gyrostat
