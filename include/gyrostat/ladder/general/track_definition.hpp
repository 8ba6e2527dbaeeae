// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/ladder/general/track.hpp"

namespace gyrostat::general {

namespace detail {

GYROSTAT_COMPILED_ONCE Quat<double> orbit_axes(const Orbit<double>& orbit, double t) noexcept {
  const Vec3<double> normal = cross<double>(orbit.radial, orbit.along);
  Mat3<double> R;
  R.col(0) = orbit.along;
  R.col(1) = -normal;
  R.col(2) = -orbit.radial;
  const double half = orbit_angle(orbit, t) / 2;
  const Vec3<double> turn = std::sin(half) * normal;
  return Quat<double>{std::cos(half), turn[0], turn[1], turn[2]} * from_matrix<double>(R);
}

GYROSTAT_COMPILED_ONCE bool known(const Track& track, std::size_t place) noexcept {
  if (place == column::angular_momentum_norm && !track.norm.values.empty()) return true;
  if (place == column::energy && !track.energy.values.empty()) return true;
  for (std::size_t p = 0; p < primitive::count; ++p)
    if (has(made_of[place], p) && p != primitive::rotor_rate && std::isnan(track.off[p])) return false;
  return place != column::rotor_rate || !std::isnan(track.off[primitive::rotor_rate]);
}

/// Writes the columns of a scene's states: the one place that knows what they are made of.
class Writer {
 public:
  Writer(const Scene& scene, const Track& track) noexcept : scene_(scene), track_(track) {}

  /// Numbers of column `place` at time i.
  void operator()(std::size_t place, std::size_t i, double t, double* to) const noexcept {
    const State<double>& s = track_.states[i];
    const auto put = [&](const Vec3<double>& v) { std::copy_n(v.data(), 3, to); };
    const auto turn = [&](const Quat<double>& q) { to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w; };
    switch (place) {
      case column::attitude: return turn(s.attitude);
      case column::angular_velocity: return put(s.angular_velocity);
      case column::angular_momentum: return put(s.angular_momentum);
      case column::angular_momentum_inertial: return put(rotate<double>(s.attitude, s.angular_momentum));
      case column::angular_momentum_norm:
        *to = track_.norm.values.empty() ? s.angular_momentum.norm() : track_.norm.values[i];
        return;
      case column::energy:
        *to = track_.energy.values.empty() ? energy(scene_.wheels(), s) : track_.energy.values[i];
        return;
      case column::rotor_rate: std::copy_n(s.rotor_rate.data(), scene_.wheels().count, to); return;
      case column::rotor_angle: std::copy_n(s.rotor_angle.data(), scene_.wheels().count, to); return;
      case column::velocity: return put(s.velocity);
      case column::position: return put(s.position);
      case column::down: return put(rotate<double>(conjugate(s.attitude), scene_.problem().field.down));
      case column::attitude_orbit: return turn(conjugate(orbit_axes(*scene_.problem().orbit, t)) * s.attitude);
      case column::euler: return put(euler_angles(*scene_.euler(), s.attitude).angles);
      default: put(scene_.torque(t, seen_of(s)));
    }
  }

  /// The absolute error of column `place`.
  double off(std::size_t place) const noexcept {
    const auto& off = track_.off;
    const double turning = off[primitive::attitude], rate = off[primitive::angular_velocity];
    const double of_start = rounding_of_start(), momentum = off[primitive::angular_momentum] + of_start;
    const double M = greatest([](const State<double>& s) { return s.angular_momentum.norm(); });
    switch (place) {
      case column::attitude: return turning;
      case column::angular_velocity: return rate;
      case column::angular_momentum: return momentum;
      case column::angular_momentum_inertial:
        return least(least(momentum + M * (turning + 4 * epsilon<double>), track_.compared.inertial + of_start),
                     keeps_momentum() ? lost_momentum() + of_start : infinity<double>);
      case column::angular_momentum_norm:
        if (!track_.norm.values.empty()) return track_.norm.off;
        return least(least(momentum, track_.compared.norm + of_start),
                     keeps_momentum() ? lost_norm() + of_start : infinity<double>);
      case column::energy:
        if (!track_.energy.values.empty()) return track_.energy.off;
        return least(least(energy_off(rate), track_.compared.energy),
                     keeps_energy() ? lost_energy() : infinity<double>) +
               rounding_of_energy();
      case column::rotor_rate: return off[primitive::rotor_rate];
      case column::rotor_angle: return off[primitive::rotor_angle];
      case column::velocity: return off[primitive::velocity];
      case column::position: return off[primitive::position];
      case column::down: return turning + 4 * epsilon<double>;
      case column::attitude_orbit:
        return turning + 8 * epsilon<double> * (1 / (1 - scene_.problem().orbit->eccentricity) + orbit_phase());
      case column::euler: return euler_off(turning + 4 * epsilon<double>);
      default: return std::isnan(track_.compared.torque) ? torque_off() : track_.compared.torque;
    }
  }

  /// By how much the torques change where attitude, rates and momentum change by their errors, by differences at some of the times, or at all.
  double torque_off() const noexcept {
    for (const std::size_t what : moved)
      if (!(track_.off[what] < infinity<double>)) return infinity<double>;
    const std::size_t n = track_.states.size(), stride = torque_comes_and_goes() ? 1 : 1 + n / 16;
    double most = 0;
    for (std::size_t back = 0; back < n; back += stride) most = greater(torque_off_at(n - 1 - back), most);
    return most;
  }

 private:
  static constexpr std::size_t moved[] = {primitive::attitude, primitive::angular_velocity,
                                          primitive::angular_momentum};

  /// Whether a torque turns over, as a brake where what it opposes nearly vanishes, or acts for a while, or falls with distance: some of the times would not
  /// show it.
  bool torque_comes_and_goes() const noexcept {
    const auto& torques = scene_.problem().torques;
    const auto& orbit = scene_.problem().orbit;
    return scene_.breaks() > 0 || scene_.own_torque().any() || (orbit && orbit->eccentricity > 0) ||
           std::any_of(torques.begin(), torques.end(), [](const auto& torque) {
             return torque.type == TorqueType::brake || torque.factor.amplitude != 0;
           });
  }
  bool rests_at(double t) const noexcept {
    return std::any_of(track_.rests.begin(), track_.rests.end(),
                       [&](const auto& rest) { return t >= rest[0] + track_.rest_off && t <= rest[1]; });
  }
  /// The error of the torques at an asked time.
  double torque_off_at(std::size_t i) const noexcept {
    const double t = scene_.question().times[i], late = clock_off(t);
    const Seen<double> here = seen_of(track_.states[i]);
    const auto& problem = scene_.problem();
    const double sizes = terms_of_torques(problem, here, t) + scene_.own_torque()(t, here).norm();
    double sum = 8 * epsilon<double> * sizes;
    if (late > 0) sum += (load_at(problem, here, t + late, t).torque - load_at(problem, here, t, t).torque).norm();
    if (rests_at(t)) return sum;
    const Vec3<double> now = scene_.torque(t, here);
    for (const std::size_t what : moved) {
      Vec3<double> about;  // no direction of the error does more than the root of the sum of squares
      for (int axis = 0; axis < 3; ++axis) about[axis] = off_by(what, Vec3<double>::Unit(axis), here, now, t);
      sum += about.norm();
    }
    if (scene_.own_torque().any()) sum += off_by_wheels(here, now, t);
    return sum;
  }
  /// What the error of attitude, rates or momentum about an axis does to the torque `now` at t.
  double off_by(std::size_t what, const Vec3<double>& axis, const Seen<double>& here, const Vec3<double>& now,
                double t) const noexcept {
    const double size = what == primitive::attitude           ? 1
                        : what == primitive::angular_velocity ? here.angular_velocity.norm()
                                                              : here.angular_momentum.norm();
    // by at least the root of a rounding, so that the difference means something
    const double off = track_.off[what], by = std::max(off, 1e-8 * size);
    if (!(by > 0)) return 0;
    Seen<double> at = here;
    switch (what) {
      case primitive::attitude:
        at.attitude = normalised(at.attitude * Quat<double>{1, by / 2 * axis[0], by / 2 * axis[1], by / 2 * axis[2]});
        break;
      case primitive::angular_velocity: at.angular_velocity += by * axis; break;
      default: at.angular_momentum += by * axis;
    }
    return (scene_.torque(t, at) - now).norm() * (off / by);
  }
  template <class Size>
  double greatest(const Size& size) const noexcept {
    double most = 0;
    for (const auto& s : track_.states) most = greater(size(s), most);
    return most;
  }
  /// Of J w and the momenta of the wheels at the start, which may all but cancel, as of a slim body that spins about its slim axis.
  double rounding_of_start() const noexcept {
    const auto& p = scene_.problem();
    const Vec3<double> sizes = p.inertia.cwiseAbs() * p.angular_velocity.cwiseAbs();
    return 2 * epsilon<double> * (sizes.norm() + momenta_of_wheels(p));
  }
  /// Of w . J w, whose products may all but cancel, and of the squares of rates that are sums.
  double rounding_of_energy() const noexcept {
    const Mat3<double> J = scene_.problem().inertia.cwiseAbs();
    const auto& wheels = scene_.wheels();
    return 2 * epsilon<double> * greatest([&](const State<double>& s) {
             const Vec3<double> w = s.angular_velocity.cwiseAbs();
             double sum = w.dot(J * w);
             for (std::size_t i = 0; i < wheels.count; ++i) {
               const auto& law = wheels.laws[i];
               const double carried = std::abs(law.axis.dot(s.angular_velocity));
               if (law.turns_by_itself())
                 sum += law.axial_inertia * std::abs(absolute_rate(s, i)) * (std::abs(s.rotor_rate[i]) + carried);
             }
             return sum;
           });
  }
  // What a law keeps is known by the start: how far it has gone is the error, whatever the phase.
  bool keeps_momentum() const noexcept { return scene_.problem().torques.empty() && !scene_.own_torque().any(); }
  bool keeps_energy() const noexcept {
    const auto& laws = scene_.wheels().laws;
    return keeps_momentum() && std::all_of(laws.begin(), laws.begin() + scene_.wheels().count, [](const auto& law) {
             return !law.tabled && law.follows != Follows::integral && law.follows != Follows::state;
           });
  }
  Vec3<double> first_momentum() const noexcept {
    return scene_.wheels().reduced * scene_.problem().angular_velocity + scene_.wheels().momentum_of_wheels();
  }
  double lost_momentum() const noexcept {
    const Vec3<double> first = first_momentum(), kept = rotate<double>(as_unit(scene_.problem().attitude), first);
    return 4 * epsilon<double> * first.norm() + greatest([&](const State<double>& s) {
             return (rotate<double>(s.attitude, s.angular_momentum) - kept).norm();
           });
  }
  double lost_norm() const noexcept {
    const double kept = first_momentum().norm();
    return 4 * epsilon<double> * kept +
           greatest([&](const State<double>& s) { return std::abs(s.angular_momentum.norm() - kept); });
  }
  double lost_energy() const noexcept {
    const auto& wheels = scene_.wheels();
    State<double> start{};
    start.angular_velocity = scene_.problem().angular_velocity;
    for (std::size_t i = 0; i < wheels.count; ++i) start.rotor_rate[i] = wheels.laws[i].rate;
    const double kept = energy(wheels, start);
    return 4 * epsilon<double> * kept +
           greatest([&](const State<double>& s) { return std::abs(energy(wheels, s) - kept); });
  }
  /// The lesser of two bounds; the second need not be known.
  static double least(double one, double two) noexcept { return two < one ? two : one; }
  double absolute_rate(const State<double>& s, std::size_t i) const noexcept {
    return s.rotor_rate[i] + scene_.wheels().laws[i].axis.dot(s.angular_velocity);
  }
  double energy_off(double rate) const noexcept {
    const auto& wheels = scene_.wheels();
    const double J = wheels.reduced.norm();
    double sum = (greatest([&](const State<double>& s) { return (wheels.reduced * s.angular_velocity).norm(); }) +
                  J * rate / 2) *
                 rate;
    for (std::size_t i = 0; i < wheels.count; ++i) {
      const auto& law = wheels.laws[i];
      if (law.follows != Follows::integral && law.follows != Follows::state) continue;  // else p stays
      const double its = track_.off[primitive::rotor_rate] + rate;
      sum += law.axial_inertia * its *
             (greatest([&](const State<double>& s) { return std::abs(absolute_rate(s, i)); }) + its / 2);
    }
    return sum;
  }
  /// Of the angles, those of first and last turn counted on from time to time: not known where one of them may be a turn off.
  double euler_off(double turning) const noexcept {
    double most = 0, counted[2] = {0, 0}, back[2] = {0, 0};
    bool begun = false;
    for (std::size_t i = 0; i < track_.states.size(); ++i) {
      const auto at = euler_angles(*scene_.euler(), track_.states[i].attitude);
      const bool given = scene_.question().times[i] == 0;
      const double off = at.error(given ? 4 * epsilon<double> : turning);
      for (int end = 0; end < 2; ++end) {
        const double angle = at.angles[2 * end], step = std::remainder(angle - back[end], 2 * pi<double>);
        // of one that is told alone, it is where the count begins
        if (!given && pi<double> - std::abs(step) <= (begun ? 2 : 1) * off) return infinity<double>;
        back[end] = angle;
        counted[end] += step;
      }
      begun = true;
      most = greater(off + 2 * epsilon<double> * (std::abs(counted[0]) + std::abs(counted[1])), most);
    }
    return most;
  }
  /// By how much a time may be off that was told by another clock, s: a rounding of what is left of it.
  double clock_off(double t) const noexcept { return scene_.problem().clock != 0 ? epsilon<double> * t : 0; }
  /// By how much a torque of the caller's own changes where the rates of the wheels change by their error.
  double off_by_wheels(const Seen<double>& here, const Vec3<double>& now, double t) const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < scene_.wheels().count; ++i) {
      const double off = track_.off[primitive::rotor_rate], by = std::max(off, 1e-8 * std::abs(here.rotor_rate[i]));
      if (!(by > 0)) continue;
      Seen<double> at = here;
      at.rotor_rate[i] += by;
      sum += (scene_.torque(t, at) - now).norm() * (off / by);
    }
    return sum;
  }
  /// The angle that the orbit would turn through at the rate of its pericentre, rad: a relative rounding of the time is no more of it.
  double orbit_phase() const noexcept {
    const auto& orbit = *scene_.problem().orbit;
    const double e = orbit.eccentricity, beyond = 1 + e * std::cos(orbit.true_anomaly);
    const double nearest = orbit.radius * (beyond / (1 + e));
    return std::sqrt(orbit.mu * (1 + e) / nearest) / nearest * scene_.question().times.back();
  }

  const Scene& scene_;
  const Track& track_;
};

GYROSTAT_COMPILED_ONCE double column_off(const Track& track, const Scene& scene, std::size_t place) noexcept {
  return Writer(scene, track).off(place);
}

GYROSTAT_COMPILED_ONCE double column_error(const Track& track, const Scene& scene, std::size_t place) noexcept {
  const Writer write(scene, track);
  double size = scene.scales()[place];
  for (std::size_t i = 0; i < track.states.size(); ++i) {
    Vec3<double> row(0, 0, 0);
    write(place, i, scene.question().times[i], row.data());
    size = std::max(size, row.norm());
  }
  return relative_to_truth(over(write.off(place), size));
}

}  // namespace detail

/// First and last angle of each row counted on from the row before.
inline void count_turns(Column& euler) noexcept {
  auto& values = euler.values;
  for (std::size_t i = 3; i < values.size(); ++i)
    if (i % 3 != 1) values[i] = values[i - 3] + std::remainder(values[i] - values[i - 3], 2 * pi<double>);
}

/// Rates and angles of the wheels at t = 0 as they were given.
inline void put_wheels(Answer& answer, const Wheels<double>& wheels) {
  if (answer.times.front() != 0) return;
  for (Column& column : answer.columns) {
    const bool rate = column.kind == &column_kinds[column::rotor_rate];
    if ((!rate && column.kind != &column_kinds[column::rotor_angle]) || column.error == infinity<double>) continue;
    for (std::size_t i = 0; i < wheels.count; ++i) column.values[i] = rate ? wheels.laws[i].rate : wheels.laws[i].angle;
  }
}

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  const auto scale = scene.scales();
  const detail::Writer write(scene, track);
  const std::size_t n = answer.times.size();
  for (std::size_t place = 0; place < std::size(column_kinds); ++place) {
    if (!scene.gives(place)) continue;
    const ColumnKind& kind = column_kinds[place];
    const std::size_t width = kind.width == per_rotor ? scene.wheels().count : std::size_t(kind.width);
    if (!detail::known(track, place)) {
      answer.columns.push_back({&kind, std::vector<double>(n * width, nan<double>), infinity<double>, scale[place]});
      answer.columns.back().width = int(width);
      continue;
    }
    answer.columns.push_back({&kind, std::vector<double>(n * width), 0, scale[place]});
    Column& column = answer.columns.back();
    column.width = int(width);
    for (std::size_t i = 0; i < n; ++i) write(place, i, answer.times[i], column.values.data() + i * width);
    if (place == column::euler) count_turns(column);
    const double off = write.off(place);
    column.error = kind.measure == Measure::relative ? relative_to_truth(over(off, size_of(column))) : off;
  }
  const auto& q = scene.problem().attitude;
  const auto& w = scene.problem().angular_velocity;
  put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  put_start(answer, column_kinds[column::angular_velocity], {w[0], w[1], w[2]});
  put_wheels(answer, scene.wheels());
}

}  // namespace gyrostat::general
