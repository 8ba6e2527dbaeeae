// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "gyrostat/body/realisability.hpp"
#include "gyrostat/body/rotor.hpp"
#include "gyrostat/ladder/free/closed_form_rung.hpp"
#include "gyrostat/ladder/free/cost.hpp"
#include "gyrostat/ladder/free/full_rung.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/models/free/averages.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/view.hpp"

namespace gyrostat::free {

namespace detail {

/// How far a motion is off over one period, or to the last time where it has none; NaN where that is not known.
inline MotionError<double>::Bound bound_over_period(const Motion<double>& motion, const MotionError<double>& error,
                                                    double last) noexcept {
  if (!(motion.period() < infinity<double>)) return error.at(last);
  return error.spans_period() ? error.at(motion.period())
                              : MotionError<double>::Bound{nan<double>, nan<double>, nan<double>};
}

/// Greatest difference of a share of the time to that of phases that fill a torus: where the motion closes after q periods, to the error of its turn
/// in a period [rad], each azimuth about M is one of q, which an arc holds to one. 0 where it does not close.
inline double closing_share(const Motion<double>& motion, double turn_error) noexcept {
  const auto closed = resonance(motion, 1'000'000);
  return closed.periods > 0 && std::abs(closed.rest) <= turn_error * closed.periods ? 1.0 / closed.periods : 0.0;
}

/// What an axis sees, and how far each is off.
struct Seen {
  double fraction, mean_cosine, fraction_error, cosine_error;
};

/// Where M in the body is off by so much, rad, and the turn in a period by turn_error.
inline Seen seen_of(const ViewRequest& view, const Motion<double>& motion, double off, double turn_error) {
  const auto seen = [&](double half_angle) { return long_run_view(motion, view.axis, view.direction, half_angle); };
  const auto made = seen(view.half_angle);
  if (!(off < pi<double>)) {
    const double all = off == off ? 1.0 : nan<double>;
    return {made.fraction, made.mean_cosine, all, all};
  }
  // as if the cone were wider and narrower; the cosine of an axis that is off by an angle is off by as much
  const double wide = seen(std::min(view.half_angle + off, pi<double>)).fraction;
  const double narrow = seen(view.half_angle - off).fraction;
  const double left = made.error + closing_share(motion, turn_error);
  return {made.fraction, made.mean_cosine, left + std::max(wide - narrow, off), left + off};
}

/// Room that the body's second moments leave beside its wheels, kg m^2: negative where no body has that inertia and holds them.
inline double room_beside_wheels(const Assembly<double>& assembly) noexcept {
  Mat3<double> known = Mat3<double>::Zero();
  for (const auto& wheel : assembly.wheels)
    known += Rotor<double>::from_axis(wheel.axis, wheel.axial_inertia)->least_second_moments();
  return realisability<double>(assembly.body.inertia, known);
}

/// Place of the principal axis that M surrounds; nothing where it surrounds none.
inline std::optional<int> surrounded_axis(const Motion<double>& motion) noexcept {
  const Vec3<double>& J = motion.principal_moments();
  if (motion.is_regular_precession() && motion.kind() != Kind::spherical) return J[1] == J[2] ? 0 : 2;
  if (motion.kind() == Kind::about_largest) return 0;
  return motion.kind() == Kind::about_smallest ? std::optional(2) : std::nullopt;
}

struct PrecessionInside {
  double about_momentum, about_axis;
  bool sure;
};

/// The precession of an axis that M surrounds, which all such axes share: the principal axis of that place, or the mean of M, beside which rotors may
/// leave it. Nothing where M passes so near to it that its turns cannot be counted.
inline std::optional<PrecessionInside> precession_inside(const Motion<double>& motion, const Vec3<double>& mean,
                                                         int place) {
  constexpr double clear = 1e3 * epsilon<double>;
  const Vec3<double>& J = motion.principal_moments();
  const double R = motion.angular_momentum_norm();
  const Vec3<double> principal = motion.R_BP().col(place);
  const Vec3<double> axis = principal.dot(mean) < 0 ? Vec3<double>(-principal) : principal;
  // rounding turns the axes of equal moments, and an axis that M is across to on the average
  const bool fixed = std::abs(J[place] - J[1]) > clear * J[0] && axis.dot(mean) > clear * R;
  const auto about = precession(motion, axis);
  if (motion.rotor_momentum().isZero(0) || (about.converged && about.about_axis != 0))
    return about.converged ? std::optional(PrecessionInside{about.about_momentum, about.about_axis, fixed})
                           : std::nullopt;
  const auto inside = precession(motion, Vec3<double>(mean.normalized()));
  if (!inside.converged) return std::nullopt;
  return PrecessionInside{inside.about_momentum, inside.about_axis, inside.about_axis != 0 && mean.norm() > clear * R};
}

}  // namespace detail

/// What is known of the whole motion, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  if (scene.wheels() > 0) {
    const double room = detail::room_beside_wheels(scene.assembly());
    const WarningKind& kind = warning_kinds[warning::not_realisable];
    if (room < -8 * epsilon<double> * scene.assembly().body.inertia.trace())
      answer.warnings.push_back({&kind, kind.text, room});
  }
  if (!tells_scalars(scene.question())) return;
  auto form = track.form ? track.form : quick_form_of(scene);
  if (!form) {
    const auto made = closed_form_of(scene);
    if (!made) return;
    form = *made;
  }
  const auto& [motion, error, precise] = *form;
  const auto tell = [&](std::size_t which, std::array<double, 3> values, double its_error = nan<double>) {
    answer.quantities.push_back({&scalar_kinds[which], values, its_error});
  };
  tell(scalar::kind, {double(motion.kind())});
  tell(scalar::period, {motion.period()}, error.period());
  tell(scalar::turn_per_period, {motion.turn_per_period()}, error.turn_per_period());
  tell(scalar::modulus_squared, {motion.modulus_squared()}, error.modulus_squared());
  tell(scalar::energy, {motion.energy()}, error.energy());
  tell(scalar::angular_momentum_norm, {motion.angular_momentum_norm()}, error.angular_momentum_norm());
  const Vec3<double> M_I = motion.inertial_momentum();
  tell(scalar::angular_momentum_inertial, {M_I[0], M_I[1], M_I[2]},
       error.at(0).angular_momentum + error.angular_momentum_norm());
  const auto wants = [&](auto... which) { return (tells_scalar(scene.question(), which) || ...); };
  const auto over_period = detail::bound_over_period(motion, error, scene.question().times.back());
  if (wants(scalar::mean_angular_velocity, scalar::precession_rate, scalar::spin_rate)) {
    const auto means = averages(motion);
    const Vec3<double>& mean = means.angular_velocity;
    tell(scalar::mean_angular_velocity, {mean[0], mean[1], mean[2]},
         over((over_period.angular_velocity + error.period() + means.error) * error.fastest(), mean.norm()));
    if (const auto place = detail::surrounded_axis(motion))
      if (const auto turning = detail::precession_inside(motion, means.angular_momentum, *place)) {
        const double rate = turning->about_momentum, off = error.turn_rate(motion.turn_per_period(), rate);
        tell(scalar::precession_rate, {rate}, turning->sure ? over(off, std::abs(rate)) : infinity<double>);
        tell(scalar::spin_rate, {turning->about_axis}, turning->sure ? error.period() : infinity<double>);
      }
  }
  if (wants(scalar::flip_interval) && detail::surrounded_axis(motion))
    if (const double interval = flip_interval(motion); interval == interval)
      tell(scalar::flip_interval, {interval}, error.period());
  if (const auto& view = scene.view(); view && wants(scalar::view_fraction, scalar::view_cosine)) {
    const double off = over_period.angular_momentum + error.angular_momentum_norm() + 16 * epsilon<double>;
    const auto seen = detail::seen_of(*view, motion, off, error.turn_per_period());
    tell(scalar::view_fraction, {seen.fraction}, seen.fraction_error);
    tell(scalar::view_cosine, {seen.mean_cosine}, seen.cosine_error);
  }
}

/// In the order of rung_kinds.
inline constexpr Rung<Scene, Track> models[] = {{&closed_form_track, &cost_of_closed_form},
                                                {&full_track, &cost_of_full}};

GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept { return models[rung].cost(scene); }

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

namespace detail {

/// Whether the ladder begins with the closed form, by states alone, where that has a quick form.
inline bool begins_with_states(const Scene& scene) noexcept {
  const Question& question = scene.question();
  return question.rung == any_rung && question.only_rung == any_rung && asks_for_states(scene) &&
         !(cost_of_states(scene) <
           clearly_cheaper * cost_of_form(scene, suits_quick_form(scene) ? quick_set_up(scene) : SetUp::precise));
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE unsigned solve_together(std::span<const Scene> scenes, std::span<Answer> answers) {
  std::array<QuickLanes::Body, QuickLanes::size> bodies;
  std::array<std::size_t, QuickLanes::size> places;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (detail::begins_with_states(scenes[i])) bodies[count] = detail::lane_of(scenes[i]), places[count++] = i;
  QuickLanes lanes;
  const unsigned known = lanes.make(std::span(bodies).first(count));
  unsigned answered = 0;
  Track track;
  for (std::size_t b = 0; b < count; ++b) {
    const Scene& scene = scenes[places[b]];
    if (!(known >> b & 1) || !detail::take_lane(track, scene, lanes, int(b))) continue;
    Answer& answer = answers[places[b]];
    answer.model = tables.rungs[rung::closed_form].name;
    answer.tolerance = scene.question().tolerance;
    fill(answer, scene, track);
    judge(answer, scene.question(), tables);
    answer.met = answer.excess <= 1;
    if (answer.met) answered |= 1u << places[b];
  }
  return answered;
}

}  // namespace gyrostat::free
