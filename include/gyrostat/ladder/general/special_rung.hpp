// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/ladder/general/track.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/ladder/rung.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"

/// Rungs of the families, asked of a scene that is an instance of theirs, and their answers mapped back.
namespace gyrostat::general {

namespace detail {

/// Places in a family's table of columns of what gives the primitives, -1: nothing; and of norm and energy.
struct Sources {
  std::array<int, primitive::count> of;
  int norm = -1, energy = -1;
};

inline constexpr int none = -1;
inline constexpr Sources sources[specials] = {
    {{free::column::attitude, free::column::angular_velocity, free::column::angular_momentum, free::column::rotor_rate,
      free::column::rotor_angle, none, none}},
    {{deceleration::column::attitude, deceleration::column::angular_velocity, deceleration::column::angular_momentum,
      none, none, none, none},
     deceleration::column::angular_momentum_norm,
     deceleration::column::energy},
    {{heavy::column::attitude, heavy::column::angular_velocity, none, none, none, none, none}},
    {{rotor::column::attitude, rotor::column::angular_velocity, rotor::column::angular_momentum,
      rotor::column::rotor_rate, rotor::column::rotor_angle, none, none}},
    {{spinning::column::attitude, spinning::column::angular_velocity, none, none, none, spinning::column::velocity,
      spinning::column::position}},
};

/// What is asked of a family so that its answer gives the columns that are asked of the scene.
GYROSTAT_COMPILED_ONCE Question question_for(const Scene& scene, Special special, int rung);

/// Reads what a family gives into the states of a track.
class Reader {
 public:
  Reader(const Family& family, const Sources& from, const Answer& answer, Track& track) noexcept
      : family_(family), from_(from), answer_(answer), track_(track) {}

  /// take(state, row) for each time where the family gives the primitive, and how far it is off.
  template <class Take>
  void read(std::size_t p, const Take& take) const {
    read(p, from_.of[p], take);
  }
  /// The same by another column of the family.
  template <class Take>
  void read(std::size_t p, int place, const Take& take) const {
    const Column* column = find(place);
    if (!column) return;
    track_.off[p] = absolute_error(*column);
    const auto width = std::size_t(column->row_width());
    for (std::size_t i = 0; i < track_.states.size(); ++i) take(track_.states[i], column->values.data() + i * width);
  }
  void read_slow(int place, Track::Slow& to, double more = 0) const {
    const Column* column = find(place);
    if (!column) return;
    to.values = column->values;
    for (double& value : to.values) value += more;
    to.off = absolute_error(*column) + 4 * epsilon<double> * std::abs(more);
  }
  static Vec3<double> vector(const double* row) noexcept { return {row[0], row[1], row[2]}; }
  static Quat<double> quaternion(const double* row) noexcept { return {row[3], row[0], row[1], row[2]}; }

 private:
  const Column* find(int place) const noexcept {
    const Column* column = place < 0 ? nullptr : answer_.find(family_.columns[std::size_t(place)].name);
    return column && column->values[0] == column->values[0] ? column : nullptr;
  }

  const Family& family_;
  const Sources& from_;
  const Answer& answer_;
  Track& track_;
};

/// The momentum from the rates of the body, where the family does not tell it.
GYROSTAT_COMPILED_ONCE void complete_momentum(const Scene& scene, Track& track);

/// Rates and angles of the wheels that the family does not know: held ones, and free ones from the rates of the body, whose angles stay
/// unknown. driven: the one that it knows, or -1.
GYROSTAT_COMPILED_ONCE void complete_wheels(const Scene& scene, Track& track, int driven);

/// Whether no wheel turns: a family that knows wheels then has none to tell of.
inline bool all_locked(const Wheels<double>& wheels) noexcept {
  return std::all_of(wheels.laws.begin(), wheels.laws.begin() + std::ptrdiff_t(wheels.count),
                     [](const auto& law) { return law.follows == Follows::body; });
}

/// What rounding of the momenta of wheels that nearly cancel does, whose sum alone the family has.
GYROSTAT_COMPILED_ONCE void add_lost_digits(const Scene& scene, Track& track) noexcept;

/// What gravity adds to the path of the mass centre of a free body.
GYROSTAT_COMPILED_ONCE void fall(const Scene& scene, Track& track);

/// The path of a mass centre that nothing but gravity moves, where the family does not know it.
GYROSTAT_COMPILED_ONCE void complete_path(const Scene& scene, Track& track);

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const free::Scene&, const Reader& from, Track&);

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const deceleration::Scene&, const Reader& from, Track& track);

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const HeavyInstance& heavy, const Reader& from, Track& track);

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const RotorInstance& rotor, const Reader& from, Track& track);

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const SpinningInstance& spinning, const Reader& from,
                                     Track& track);

template <class Instance>
const auto& scene_of(const Instance& instance) noexcept {
  if constexpr (requires { instance.scene; }) return instance.scene;
  else return instance;
}

/// The answer of a family's rung, mapped back.
template <class Instance>
Track track_of(const Scene& scene, Special special, int rung, const std::optional<Instance>& instance,
               Monitor* monitor) {
  const Family& family = *special_tables[std::size_t(special)];
  if (!instance) return refused<Track>(Errc::not_applicable, scene.instances().why[std::size_t(special)]);
  Refusal refusal;
  const Answer answer =
      solve(scene_of(*instance).asked(question_for(scene, special, rung)), refusal, monitor);  // of its namespace
  Track track;
  if (refusal.code != Errc::ok) {
    track.failure = refusal.code;
    if (!answer.tried.empty()) track.refusal = answer.tried.back().why, track.known_error = answer.tried.back().error;
    return track;
  }
  track.counts = answer.counts;
  track.in_domain = answer.tried.empty() || answer.tried.back().why == nullptr;
  track.states.resize(scene.question().times.size());
  map_back(scene, *instance, Reader(family, sources[std::size_t(special)], answer, track), track);
  complete_momentum(scene, track);
  if (special != Special::free || all_locked(scene.wheels()))
    complete_wheels(scene, track, special == Special::rotor ? Spinners::of(scene.wheels()).driven : -1);
  complete_path(scene, track);
  if (!scene.problem().fixed) fall(scene, track);
  if (special != Special::free) add_lost_digits(scene, track);
  for (const Warning& warning : answer.warnings)
    if (warning.kind != &no_value) track.warnings.push_back(warning);
  if (const Quantity* stop = answer.quantity("stop_time"))
    track.stop_time = stop->values[0], track.stop_error = stop->error;
  return track;
}

GYROSTAT_COMPILED_ONCE Track track_of(const Scene& scene, const SpecialRung& which, Monitor* monitor);

}  // namespace detail

/// A rung of a family, by its place in rung_kinds.
template <std::size_t Place>
Track special_track(const Scene& scene, Monitor* monitor) {
  return detail::track_of(scene, special_rungs[Place], monitor);
}

/// What it would cost, s; NaN: the scene is no instance of the family.
template <std::size_t Place>
double cost_of_special(const Scene& scene) noexcept {
  constexpr SpecialRung which = special_rungs[Place];
  const auto& found = scene.instances();
  if (!found.has(which.special)) return nan<double>;
  const Question asked = detail::question_for(scene, which.special, which.rung);
  if constexpr (which.special == Special::free) return free::cost_of(found.free->asked(asked), which.rung);
  else if constexpr (which.special == Special::deceleration)
    return deceleration::cost_of(found.deceleration->asked(asked), which.rung);
  else if constexpr (which.special == Special::heavy)
    return heavy::cost_of(found.heavy->scene.asked(asked), which.rung);
  else if constexpr (which.special == Special::rotor)
    return rotor::cost_of(found.rotor->scene.asked(asked), which.rung);
  else return spinning::cost_of(found.spinning->scene.asked(asked), which.rung);
}

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/special_rung_definition.hpp"
#endif
