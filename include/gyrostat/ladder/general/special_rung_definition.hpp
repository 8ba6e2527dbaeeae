// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/general/special_rung.hpp"

namespace gyrostat::general {

namespace detail {

GYROSTAT_COMPILED_ONCE Question question_for(const Scene& scene, Special special, int rung) {
  const Question& question = scene.question();
  const Sources& from = sources[std::size_t(special)];
  Question made = plain(question);
  (question.rung == any_rung ? made.only_rung : made.rung) = rung;
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
  const bool down_alone = special == Special::heavy && scene.instances().heavy->down_alone;
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
    if (c == column::down && down_alone) {
      want(heavy::column::down, *aim, true);
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

GYROSTAT_COMPILED_ONCE void complete_momentum(const Scene& scene, Track& track) {
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

GYROSTAT_COMPILED_ONCE void complete_wheels(const Scene& scene, Track& track, int driven) {
  const auto& wheels = scene.wheels();
  const auto& times = scene.question().times;
  const double body = track.off[primitive::angular_velocity];
  double fastest = 0, free_wheels = 0;
  for (std::size_t w = 0; w < wheels.count; ++w) {
    if (int(w) == driven) continue;
    const auto& law = wheels.laws[w];
    const bool free = law.follows == Follows::constant;
    const double own = free ? law.momentum / law.axial_inertia : law.rate;
    free_wheels += free;
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
  rate += rounding + (free_wheels > 0 ? std::sqrt(free_wheels) * body : 0);
  angle += free_wheels > 0 ? nan<double> : rounding * times.back();
}

GYROSTAT_COMPILED_ONCE void add_lost_digits(const Scene& scene, Track& track) noexcept {
  constexpr double much = 4;  // less than that the family's own errors hold
  const auto& wheels = scene.wheels();
  const double whole = momenta_of_wheels(scene.problem());
  if (!(whole > much * wheels.momentum_of_wheels().norm())) return;
  double w = 0, M = 0, v = 0, x = 0;
  for (const auto& s : track.states) {
    w = std::max(w, s.angular_velocity.norm()), M = std::max(M, s.angular_momentum.norm());
    v = std::max(v, s.velocity.norm()), x = std::max(x, s.position.norm());
  }
  const double off = 4 * epsilon<double> * whole, rate = off * wheels.inverse.norm();
  const double turned = rate * scene.question().times.back();
  track.off[primitive::attitude] += turned;
  track.off[primitive::angular_velocity] += rate + turned * w;
  track.off[primitive::angular_momentum] += off + turned * M;
  track.norm.off += off, track.energy.off += w * off;
  track.off[primitive::rotor_rate] += std::sqrt(double(wheels.count)) * (rate + turned * w);
  track.off[primitive::rotor_angle] += std::sqrt(double(wheels.count)) * turned;
  track.off[primitive::velocity] += turned * v;
  track.off[primitive::position] += turned * x;
}

GYROSTAT_COMPILED_ONCE void fall(const Scene& scene, Track& track) {
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

GYROSTAT_COMPILED_ONCE void complete_path(const Scene& scene, Track& track) {
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

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const free::Scene&, const Reader& from, Track&) {
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

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const deceleration::Scene&, const Reader& from, Track& track) {
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

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const HeavyInstance& heavy, const Reader& from, Track& track) {
  const auto& times = scene.question().times;
  const double n = heavy.turn.norm();
  const Quat<double> back = conjugate(heavy.q_HI);
  const bool turned = n > 0, oriented = !(heavy.q_HI == Quat<double>{});
  if (heavy.down_alone) {
    // one attitude of those with this down
    from.read(primitive::attitude, heavy::column::down,
              [](State<double>& s, const double* row) { s.attitude = to_heavy_axes(Reader::vector(row)); });
    track.off[primitive::attitude] += 4 * epsilon<double>;
  } else {
    from.read(primitive::attitude, take_attitude);
  }
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

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const RotorInstance& rotor, const Reader& from, Track& track) {
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

GYROSTAT_COMPILED_ONCE void map_back(const Scene& scene, const SpinningInstance& spinning, const Reader& from,
                                     Track& track) {
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

GYROSTAT_COMPILED_ONCE Track track_of(const Scene& scene, const SpecialRung& which, Monitor* monitor) {
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

}  // namespace gyrostat::general
