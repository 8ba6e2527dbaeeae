// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

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
inline Question question_for(const Scene& scene, Special special, int rung) {
  const Question& question = scene.question();
  const Sources& from = sources[std::size_t(special)];
  Question made = plain(question);
  (question.rung == any_rung ? made.alone : made.rung) = rung;
  const auto want = [&](int place, const Aim& aim, bool as_it_is) {
    if (place < 0) return;
    // what is made of others shares its tolerance among them
    const bool absolute = aim.absolute && as_it_is;
    const double tolerance = as_it_is ? aim.tolerance : (aim.absolute ? question.tolerance : aim.tolerance) / 2;
    for (AskedQuantity& each : made.asked)
      if (each.place == std::size_t(place)) {
        each.needed = each.needed || aim.needed;
        if (!(tolerance < each.tolerance)) return;
        each.tolerance = tolerance, each.absolute = absolute;
        return;
      }
    made.asked.push_back({std::size_t(place), false, tolerance, absolute, aim.needed});
  };
  const bool all = question.asked.empty() && question.rung != any_rung;
  for (std::size_t c = 0; c < std::size(column_kinds); ++c) {
    auto aim = aim_of(question, tables, false, c);
    if (all) aim = Aim{question.tolerance, false, false};
    if (!aim || !scene.has_column(c)) continue;
    if (c == column::angular_momentum_norm && from.norm >= 0) {
      want(from.norm, *aim, true);
      continue;
    }
    if (c == column::energy && from.energy >= 0) {
      want(from.energy, *aim, true);
      continue;
    }
    for (std::size_t p = 0; p < primitive::count; ++p) {
      if (!has(made_of[c], p)) continue;
      const bool derived = from.of[p] < 0 && (p == primitive::angular_momentum || p == primitive::rotor_rate);
      want(derived ? from.of[primitive::angular_velocity] : from.of[p], *aim, !derived && made_of[c] == column_set(p));
    }
  }
  if (special == Special::deceleration && aim_of(question, tables, true, scalar::stop_time)) {
    const Aim aim = *aim_of(question, tables, true, scalar::stop_time);
    made.asked.push_back({deceleration::scalar::stop_time, true, aim.tolerance, aim.absolute, aim.needed});
  }
  if (made.asked.empty()) made.asked.push_back({std::size_t(from.of[primitive::attitude])});
  return made;
}

/// Reads what a family gives into the states of a track.
class Reader {
 public:
  Reader(const Family& family, const Sources& from, const Answer& answer, Track& track) noexcept
      : family_(family), from_(from), answer_(answer), track_(track) {}

  /// take(state, row) for each time where the family gives the primitive, and how far it is off.
  template <class Take>
  void read(std::size_t p, const Take& take) const {
    const Column* column = find(from_.of[p]);
    if (!column) return;
    track_.off[p] = off(*column);
    const auto width = std::size_t(column->row_width());
    for (std::size_t i = 0; i < track_.states.size(); ++i) take(track_.states[i], column->values.data() + i * width);
  }
  void read_slow(int place, Track::Slow& to, double more = 0) const {
    const Column* column = find(place);
    if (!column) return;
    to.values = column->values;
    for (double& value : to.values) value += more;
    to.off = off(*column) + 4 * epsilon<double> * std::abs(more);
  }
  static Vec3<double> vector(const double* row) noexcept { return {row[0], row[1], row[2]}; }
  static Quat<double> quaternion(const double* row) noexcept { return {row[3], row[0], row[1], row[2]}; }

 private:
  const Column* find(int place) const noexcept {
    const Column* column = place < 0 ? nullptr : answer_.find(family_.columns[std::size_t(place)].name);
    return column && column->values[0] == column->values[0] ? column : nullptr;
  }
  static double off(const Column& column) noexcept {
    return column.kind->measure == Measure::relative ? column.error * size_of(column) : column.error;
  }

  const Family& family_;
  const Sources& from_;
  const Answer& answer_;
  Track& track_;
};

/// The momentum from the rates of the body, where the family does not tell it.
inline void complete_momentum(const Scene& scene, Track& track) {
  const auto& wheels = scene.wheels();
  const double rate = track.off[primitive::angular_velocity];
  if (std::isnan(rate) || !std::isnan(track.off[primitive::angular_momentum])) return;
  const Vec3<double> kept = Spinners::of(wheels).kept;
  double M = kept.norm();
  for (auto& s : track.states) {
    s.angular_momentum = wheels.reduced * s.angular_velocity + kept;
    M = std::max(M, s.angular_momentum.norm());
  }
  track.off[primitive::angular_momentum] = wheels.reduced.norm() * rate + 4 * epsilon<double> * M;
}

/// Rates and angles of the wheels that the family does not know: held ones, and free ones from the rates of the body, whose angles stay
/// unknown. driven: the one that it knows, or -1.
inline void complete_wheels(const Scene& scene, Track& track, int driven) {
  const auto& wheels = scene.wheels();
  const auto& times = scene.question().times;
  const double body = track.off[primitive::angular_velocity];
  double fastest = 0, freely = 0;
  for (std::size_t w = 0; w < wheels.count; ++w) {
    if (int(w) == driven) continue;
    const auto& law = wheels.laws[w];
    const bool free = law.follows == Follows::constant;
    const double own = free ? law.momentum / law.axial_inertia : law.rate;
    freely += free;
    fastest = std::max(fastest, std::abs(own));
    for (std::size_t i = 0; i < times.size(); ++i) {
      State<double>& s = track.states[i];
      s.rotor_rate[w] = free ? own - law.axis.dot(s.angular_velocity) : own;
      s.rotor_angle[w] = law.angle + own * times[i];
    }
  }
  const double rounding = 4 * epsilon<double> * std::sqrt(double(wheels.count)) * fastest;
  auto &rate = track.off[primitive::rotor_rate], &angle = track.off[primitive::rotor_angle];
  if (driven < 0) rate = angle = 0;
  rate += rounding + (freely > 0 ? std::sqrt(freely) * body : 0);
  angle += freely > 0 ? nan<double> : rounding * times.back();
}

/// What gravity adds to the path of the mass centre of a free body.
inline void fall(const Scene& scene, Track& track) {
  const auto& times = scene.question().times;
  const Vec3<double> g = scene.problem().field.gravity * scene.problem().field.down;
  if (g.isZero(0)) return;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    track.states[i].velocity += t * g;
    track.states[i].position += t * (t / 2 * g);
  }
  const double T = times.back(), rounding = 4 * epsilon<double>;
  track.off[primitive::velocity] += rounding * T * g.norm();
  track.off[primitive::position] += rounding * T * T * g.norm();
}

/// The path of a mass centre that nothing but gravity moves, where the family does not know it.
inline void complete_path(const Scene& scene, Track& track) {
  const auto& p = scene.problem();
  if (p.fixed || !std::isnan(track.off[primitive::velocity])) return;
  if (scene.instances().pushed) return;
  const auto& times = scene.question().times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    track.states[i].velocity = p.velocity;
    track.states[i].position = p.position + times[i] * p.velocity;
  }
  const double rounding = 4 * epsilon<double>;
  track.off[primitive::velocity] = rounding * p.velocity.norm();
  track.off[primitive::position] = rounding * (p.position.norm() + times.back() * p.velocity.norm());
}

inline void take_attitude(State<double>& s, const double* row) noexcept { s.attitude = Reader::quaternion(row); }
inline void take_rate(State<double>& s, const double* row) noexcept { s.angular_velocity = Reader::vector(row); }

inline void map_back(const Scene& scene, const free::Scene&, const Reader& from, Track&) {
  const auto& wheels = scene.wheels();
  const Vec3<double>& charge = scene.instances().charge;
  from.read(primitive::attitude, take_attitude);
  from.read(primitive::angular_velocity, take_rate);
  from.read(primitive::angular_momentum,
            [&](State<double>& s, const double* row) { s.angular_momentum = Reader::vector(row) + charge; });
  const auto spread = [&](auto& to, const double* row) {
    for (std::size_t w = 0; w < wheels.count; ++w) to[w] = wheels.laws[w].follows == Follows::body ? 0 : *row++;
  };
  from.read(primitive::rotor_rate, [&](State<double>& s, const double* row) { spread(s.rotor_rate, row); });
  from.read(primitive::rotor_angle, [&](State<double>& s, const double* row) {
    spread(s.rotor_angle, row);
    for (std::size_t w = 0; w < wheels.count; ++w) s.rotor_angle[w] += wheels.laws[w].angle;
  });
}

inline void map_back(const Scene& scene, const deceleration::Scene&, const Reader& from, Track& track) {
  from.read(primitive::attitude, take_attitude);
  from.read(primitive::angular_velocity, take_rate);
  from.read(primitive::angular_momentum,
            [](State<double>& s, const double* row) { s.angular_momentum = Reader::vector(row); });
  double kept = 0;
  for (const auto& law : scene.wheels().laws)
    if (law.follows == Follows::constant) kept += law.momentum * law.momentum / (2 * law.axial_inertia);
  from.read_slow(sources[std::size_t(Special::deceleration)].norm, track.norm);
  from.read_slow(sources[std::size_t(Special::deceleration)].energy, track.energy, kept);
}

inline void map_back(const Scene& scene, const HeavyInstance& heavy, const Reader& from, Track& track) {
  const auto& times = scene.question().times;
  const double n = heavy.turn.norm();
  const Quat<double> back = conjugate(heavy.q_HI);
  const bool turned = n > 0, oriented = !(heavy.q_HI == Quat<double>{});
  from.read(primitive::attitude, take_attitude);
  from.read(primitive::angular_velocity, take_rate);
  if (!turned && !oriented) return;
  for (std::size_t i = 0; i < times.size(); ++i) {
    State<double>& s = track.states[i];
    if (oriented) s.attitude = back * s.attitude;
    if (!turned) continue;
    // body axes of the family, which turn with the momentum of the wheels, to those of the body: about the axis by +n t
    const double half = n * times[i] / 2;
    const Vec3<double> e = heavy.turn / n;
    const Quat<double> slower{std::cos(half), -std::sin(half) * e[0], -std::sin(half) * e[1], -std::sin(half) * e[2]};
    s.attitude = s.attitude * slower;
    s.angular_velocity = rotate<double>(conjugate(slower), s.angular_velocity) - heavy.turn;
  }
  const double phase = 4 * epsilon<double> * (2 + n * times.back());
  double fastest = 0;
  for (const auto& s : track.states) fastest = std::max(fastest, (s.angular_velocity + heavy.turn).norm());
  track.off[primitive::attitude] += phase;
  track.off[primitive::angular_velocity] += phase * fastest;
}

inline void map_back(const Scene& scene, const RotorInstance& rotor, const Reader& from, Track& track) {
  const auto& wheels = scene.wheels();
  const auto& times = scene.question().times;
  const std::size_t driven = rotor.driven;
  from.read(primitive::attitude, take_attitude);
  from.read(primitive::angular_velocity, take_rate);
  from.read(primitive::rotor_rate,
            [&](State<double>& s, const double* row) { s.rotor_rate[driven] = *row - rotor.shift; });
  std::size_t next = 0;
  from.read(primitive::rotor_angle, [&](State<double>& s, const double* row) {
    s.rotor_angle[driven] = *row - rotor.shift * times[next++] + wheels.laws[driven].angle;
  });
  // M of the family has all other momentum in its rotor, but for that of the charge
  const Vec3<double>& charge = scene.instances().charge;
  from.read(primitive::angular_momentum,
            [&](State<double>& s, const double* row) { s.angular_momentum = Reader::vector(row) + charge; });
  const double shifted = 4 * epsilon<double> * std::abs(rotor.shift);
  track.off[primitive::rotor_rate] += shifted;
  track.off[primitive::rotor_angle] += shifted * times.back();
}

inline void map_back(const Scene& scene, const SpinningInstance& spinning, const Reader& from, Track& track) {
  const Quat<double> q_SB = from_matrix<double>(spinning.R_SB);
  const Mat3<double> R_BS = spinning.R_SB.transpose();
  const bool turned = !(q_SB == Quat<double>{}), oriented = !(spinning.q_IS == Quat<double>{});
  // moments that a tensor gives are rounded by its greatest element, and so is all that turns by them
  const auto& wheels = scene.wheels();
  const double condition = wheels.reduced.isDiagonal(0) ? 0 : wheels.reduced.norm() * wheels.inverse.norm();
  const double phase = condition * spinning.scene.problem().phase(scene.question().times.back());
  const double rounding = 8 * epsilon<double> * (1 + phase);
  const auto in_space = [&](const Vec3<double>& v) { return oriented ? rotate<double>(spinning.q_IS, v) : v; };
  double most[3] = {};
  from.read(primitive::attitude, [&](State<double>& s, const double* row) {
    s.attitude = Reader::quaternion(row);
    if (turned) s.attitude = s.attitude * q_SB;
    if (oriented) s.attitude = spinning.q_IS * s.attitude;
  });
  from.read(primitive::angular_velocity, [&](State<double>& s, const double* row) {
    s.angular_velocity = turned ? Vec3<double>(R_BS * Reader::vector(row)) : Reader::vector(row);
    most[0] = std::max(most[0], s.angular_velocity.norm());
  });
  from.read(primitive::velocity, [&](State<double>& s, const double* row) {
    s.velocity = in_space(Reader::vector(row));
    most[1] = std::max(most[1], s.velocity.norm());
  });
  from.read(primitive::position, [&](State<double>& s, const double* row) {
    s.position = in_space(Reader::vector(row));
    most[2] = std::max(most[2], s.position.norm());
  });
  if (!turned && !oriented) return;
  track.off[primitive::attitude] += rounding;
  track.off[primitive::angular_velocity] += rounding * most[0];
  track.off[primitive::velocity] += rounding * most[1];
  track.off[primitive::position] += rounding * most[2];
}

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
  if (special != Special::free)
    complete_wheels(scene, track, special == Special::rotor ? Spinners::of(scene.wheels()).driven : -1);
  complete_path(scene, track);
  if (!scene.problem().fixed) fall(scene, track);
  for (const Warning& warning : answer.warnings)
    if (warning.kind != &no_value) track.warnings.push_back(warning);
  if (const Quantity* stop = answer.quantity("stop_time"))
    track.stop_time = stop->values[0], track.stop_error = stop->error;
  return track;
}

inline Track track_of(const Scene& scene, const SpecialRung& which, Monitor* monitor) {
  const auto& found = scene.instances();
  const auto [special, rung] = which;
  switch (special) {
    case Special::free: return track_of(scene, special, rung, found.free, monitor);
    case Special::deceleration: return track_of(scene, special, rung, found.deceleration, monitor);
    case Special::heavy: return track_of(scene, special, rung, found.heavy, monitor);
    case Special::rotor: return track_of(scene, special, rung, found.rotor, monitor);
    default: return track_of(scene, special, rung, found.spinning, monitor);
  }
}

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
