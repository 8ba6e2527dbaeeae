// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/fall_time.hpp"

#include <cmath>

#include "catch.hpp"
#include "models/rotor/bodies.hpp"
#include "models/rotor/momentum_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

/// The dual-spin satellite of the slow cases with another wheel: `gain` times its inertia at the same momentum.
Gyrostat<double> dual_spin(double slope, double gain, double off = 3.7) {
  const double angle = off * pi<double> / 180, azimuth = std::atan2(0.34289780745545134, 0.45035926880694593);
  const Vec3<double> e(std::cos(angle), std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth));
  return Gyrostat<double>::make(Vec3<double>(86, 118, 141).asDiagonal(), e, 0.28 * gain, slope, 210 / gain).value();
}

/// Time of the full motion from one level of V to another.
double full_time(const Gyrostat<double>& g, double l, const Vec3<double>& start, double from, double to, double dt) {
  auto motion = MomentumMotion::from(g, l, start, 0);
  double t = 0, begin = -1;
  for (; motion.level() > to && t < 1e7; t += dt) {
    if (begin < 0 && motion.level() <= from) begin = t;
    motion.step(dt);
  }
  return t - begin;
}

}  // namespace

TEST_CASE("close to a minimum the level falls at twice the rate of the mode") {
  Bodies bodies(41);
  int tested = 0;
  while (tested < 60) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 10) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    const auto s = stability_of(g, l, all[0]);
    const double kappa = s.cubic[2] / s.cubic[0] - s.determinant;
    if (kappa > 3e-3 * s.determinant) continue;
    ++tested;
    const double depth = all[1].level - all[0].level;
    const auto fall =
        time_between_levels(g, all, l, all.count - 1, 0, all[0].level + 1e-5 * depth, all[0].level + 1e-6 * depth);
    REQUIRE(fall);
    CHECK(fall->time == Approx(std::log(10.0) / (2 * s.decay_rate)).epsilon(0.01 + kappa / s.determinant));
    CHECK(fall->turns == Approx(fall->time * std::sqrt(s.determinant) / (2 * pi<double>)).epsilon(0.01));
  }
}

TEST_CASE("close to a maximum it leaves at the rate of its growth") {
  const auto g = dual_spin(0.1, 1);
  const double l = 52.17233512121151;
  const auto all = steady_rotations(g, l);
  const auto& top = all[all.count - 1];
  const auto s = stability_of(g, l, top);
  const double depth = top.level - all[0].level;
  const auto fall =
      time_between_levels(g, all, l, all.count - 1, 0, top.level - 1e-6 * depth, top.level - 1e-5 * depth);
  REQUIRE(fall);
  CHECK(fall->time == Approx(std::log(10.0) / (-2 * s.decay_rate)).epsilon(0.01));
}

TEST_CASE("from flat spin into the well, against the full motion") {
  // a heavier wheel further off the axis, so that the fall is affordable
  for (const double slope : {3.0, 30.0}) {
    const auto g = dual_spin(slope, 60, 20);
    const double l = 52.17233512121151;
    const auto all = steady_rotations(g, l);
    REQUIRE(all.count == 2);
    const double range = all[1].level - all[0].level;
    const double from = all[1].level - 0.1 * range, to = all[0].level + 0.05 * range;
    const auto said = time_between_levels(g, all, l, 1, 0, from, to);
    REQUIRE(said);
    const Vec3<double> start = (all[1].direction + 0.2 * Vec3<double>(0, 0.6, -0.8)).normalized();
    REQUIRE(g.steady_level(l * start) > from);
    const double full = full_time(g, l, start, from, to, 0.2);
    INFO(slope << ' ' << said->loss_per_turn << " said " << said->time << " full " << full);
    CHECK(said->error() < 0.1);
    CHECK(std::abs(said->time / full - 1) <= said->error());
    CHECK(said->time == Approx(full).epsilon(0.02));
  }
}

TEST_CASE("random bodies, through lobes and valleys: the error stated is not too small") {
  Bodies bodies(6);
  int tested = 0, close = 0, lobes = 0;
  while (tested < 5) {
    auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 10) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    const double nutation = std::sqrt(stability_of(g, l, all[0]).determinant);
    const double slope = nutation * bodies.scale(0.02, 20) * g.axial_inertia() * g.coupling();
    g = Gyrostat<double>::make(g.inertia(), g.axis(), g.axial_inertia(), slope, g.no_load_rate()).value();
    // from the level of a point near a maximum
    int summit = all.count - 1;
    if (all.count == 6 && bodies.uniform(0, 1) < 0.5) summit = all[4].type == SteadyType::maximum ? 4 : 3;
    const auto& top = all[summit];
    const auto below = all[summit == all.count - 1 ? all.count - 2 : 3].level;
    const double from = top.level - bodies.uniform(0.1, 0.5) * std::min(top.level - below, top.level - all[0].level);
    auto motion = MomentumMotion::from(g, l, (top.direction + 0.02 * bodies.direction()).normalized(), 0);
    const double fast = (l + std::abs(g.target_momentum())) / g.principal()[0] + g.relaxation_rate();
    const double dt = 0.08 / fast;
    double time = 0, begin = -1;
    int valley = -1;
    double to = -1;
    for (int i = 0; i < 12000 && motion.level() > to; ++i, time += dt) {
      if (begin < 0 && motion.level() <= from) begin = time;
      motion.step(dt);
      if (i % 64 == 0 && valley < 0 && begin >= 0 && motion.level() < all[0].level + 0.4 * (from - all[0].level)) {
        valley = certify(g, all, motion.H, motion.p).index;
        if (valley >= 0) to = all[valley].level + 0.3 * (motion.level() - all[valley].level);
      }
    }
    if (valley < 0 || motion.level() > to) continue;
    const auto said = time_between_levels(g, all, l, summit, valley, from, to);
    REQUIRE(said);
    ++tested;
    lobes += all.count == 6;
    const double full = time - begin;
    INFO(all.count << " said " << said->time << " full " << full << " coupling " << said->coupling << " turns "
                   << said->turns << " loss " << said->loss_per_turn);
    CHECK(std::abs(said->time / full - 1) <= said->error());
    close += std::abs(said->time / full - 1) < 0.1;
  }
  CHECK(close > 1);
  CHECK(lobes > 0);
}

TEST_CASE("years are said at once") {
  const auto g = dual_spin(0.004, 1);
  const double l = 52.17233512121151, year = 365.25 * 86400;
  const auto all = steady_rotations(g, l);
  const double range = all[1].level - all[0].level;
  const auto fall = time_between_levels(g, all, l, 1, 0, all[1].level - 0.01 * range, all[0].level + 1e-3 * range);
  REQUIRE(fall);
  CHECK(fall->time > 20 * year);
  CHECK(fall->time < 60 * year);
  CHECK(fall->loss_per_turn < 1e-6);
  CHECK(fall->error() < 0.02);
  // slower by the motor's slope, as long as it is soft
  const auto softer =
      time_between_levels(dual_spin(0.002, 1), all, l, 1, 0, all[1].level - 0.01 * range, all[0].level + 1e-3 * range);
  CHECK(softer->time / fall->time == Approx(2).epsilon(2e-3));
}

TEST_CASE("what cannot be asked is refused") {
  const auto g = reference_body(0.2, 3);
  const auto all = steady_rotations(g, 8.0);
  const double low = all[0].level, high = all[5].level;
  CHECK(time_between_levels(g, all, 8.0, 5, 0, low + 1, low + 2).error() == Errc::not_increasing);
  CHECK(time_between_levels(g, all, 8.0, 5, 0, high, low + 2).error() == Errc::out_of_domain);
  CHECK(time_between_levels(g, all, 8.0, 5, 0, high - 1, low).error() == Errc::out_of_domain);
  CHECK(time_between_levels(g, all, 8.0, 5, 2, high - 1, low + 2).error() == Errc::out_of_domain);
  CHECK(time_between_levels(g, all, 8.0, 6, 0, high - 1, low + 2).error() == Errc::out_of_domain);
  CHECK(time_between_levels(reference_body(0, 3), all, 8.0, 5, 0, high - 1, low + 2).error() == Errc::not_applicable);
}
