// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <span>
#include <utility>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"

namespace gyrostat {

/// What a rung hands back: the answer in its own terms, or why it has none. `fill(answer, scene, track)` turns it into
/// columns and sets answer.error; `describe(answer, scene, track)` adds to the answer that is given what belongs to the scene, whichever
/// rung answers.
template <class Track, class Scene>
concept RungResult = requires(const Track& track, const Scene& scene, Answer& answer) {
  { track.failure } -> std::convertible_to<Errc>;
  { track.refusal } -> std::convertible_to<const char*>;
  { track.known_error } -> std::convertible_to<double>;
  { track.in_domain } -> std::convertible_to<bool>;
  { scene.question() } -> std::convertible_to<const Question&>;
  fill(answer, scene, track);
  describe(answer, scene, track);
};

/// A model of a scene: says whether it applies, answers, estimates its own error and counts its work.
template <class Scene, class Track>
using Rung = Track (*)(const Scene&, Monitor*);

/// Why a climb ended without an answer.
struct Refusal {
  Errc code = Errc::ok;
  const char* model = "";
  const char* why = "";
};

/// The answer of the first rung, cheapest first, whose own error estimate meets the tolerance; failing that the most
/// accurate of those that answered, one in its domain before any outside, with met false. The rung that the question names answers alone,
/// wherever it can. `kinds` names the rungs. On failure the answer's `tried` still lists what was looked at.
template <class Scene, class Track>
  requires RungResult<Track, Scene>
Answer climb(std::span<const RungKind> kinds, std::span<const Rung<Scene, Track>> rungs, const Scene& scene,
             Monitor* monitor, Refusal& refusal) {
  const double tolerance = scene.question().tolerance;
  const int only = scene.question().rung;
  Answer best;
  Track best_track;
  std::vector<Attempt> tried;
  bool answered = false, best_in_domain = false;
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    if (only >= 0 && i != std::size_t(only)) continue;
    Track track = rungs[i](scene, monitor);
    if (track.failure != Errc::ok) {
      tried.push_back({kinds[i].name, track.known_error, false, track.refusal});
      refusal = {track.failure, kinds[i].name, track.refusal ? track.refusal : message(track.failure)};
      if (track.failure == Errc::cancelled) break;
      continue;
    }
    Answer answer;
    answer.model = kinds[i].name;
    answer.tolerance = tolerance;
    fill(answer, scene, track);
    answer.met = track.in_domain && answer.error <= tolerance;
    tried.push_back({kinds[i].name, answer.error, answer.met || only >= 0,
                     track.in_domain ? nullptr : "the scene leaves its domain"});
    const bool same_kind = track.in_domain == best_in_domain;
    if (!answered || answer.met ||
        (same_kind ? answer.error < best.error || best.error != best.error : track.in_domain)) {
      best_in_domain = track.in_domain;
      best = std::move(answer);
      best_track = std::move(track);
    }
    answered = true;
    if (best.met) break;
  }
  best.tried = std::move(tried);
  if (answered) {
    refusal = {};
    for (Attempt& attempt : best.tried) attempt.accepted = attempt.model == best.model;
    describe(best, scene, best_track);
  }
  return best;
}

}  // namespace gyrostat
