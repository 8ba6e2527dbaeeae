// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/periodic_motion.hpp"

#include <vector>

#include "catch.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "gyrostat/models/heavy/regular_precession.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

template <Real S>
Problem<S> flat_stone(S b = S(1.6L)) {
  const auto made = Problem<S>::make(Vec3<S>(S(1.1L), b, 2) / 1000, S(0.8L), Vec3<S>(12, 9, 10) / 1000, S(9.80665L), 0);
  REQUIRE(made);
  return *made;
}

template <Real S>
struct Followed {
  std::vector<State<S>> states;
  CarriedOn<S> made;
};

template <Real S>
Followed<S> follow(const Problem<S>& problem, const PeriodicOrbit<S>& orbit, const std::vector<S>& times) {
  const PeriodicMotion<S> motion(problem, orbit, times);
  for (std::size_t i = 1; i < motion.once().size(); ++i) CHECK(motion.once()[i] > motion.once()[i - 1]);
  CHECK(motion.once().front() == 0);
  CHECK(motion.once().back() == orbit.period);
  std::vector<State<S>> once(motion.once().size());
  FullMotionOptions<S> options;
  options.tolerance = S(1e-13L);
  options.attitude = true;
  const auto answer = full_motion<S>(problem, orbit.start, motion.once(), once, options);
  REQUIRE(answer);
  Followed<S> f;
  f.states.resize(times.size());
  f.made = motion.carry_on(once, answer->error, f.states);
  return f;
}

}  // namespace

TEST_CASE("a periodic motion carried on is that of the full equations", "[heavy]") {
  using Long = long double;
  const auto problem = flat_stone<Long>();
  const auto orbit = periodic_orbit<Long>(problem, 30, 0.1L);
  REQUIRE(orbit);
  std::vector<Long> times;
  for (int i = 0; i <= 40; ++i) times.push_back(orbit->period * Long(i) / 7);
  const auto f = follow<Long>(problem, *orbit, times);
  std::vector<State<Long>> straight(times.size());
  FullMotionOptions<Long> options;
  options.tolerance = 1e-15L;
  options.attitude = true;
  REQUIRE(full_motion<Long>(problem, orbit->start, times, straight, options));
  Comparison apart(Row<Long>{});
  for (std::size_t i = 0; i < times.size(); ++i) apart.add(straight[i], f.states[i]);
  CHECK(apart.relative(apart.difference()).greatest() < 1e-13L);
  CHECK(f.made.error.greatest() < 1e-10L);
}

TEST_CASE("an unstable periodic motion goes on as it began", "[heavy]") {
  const auto problem = flat_stone<double>(2.4);
  const auto orbit = periodic_orbit<double>(problem, 40, 0.2);
  REQUIRE(orbit);
  CHECK(orbit->trace_minus_4 > 5);
  const auto f = follow<double>(problem, *orbit, {0, 100 * orbit->period, 1e4 * orbit->period});
  CHECK((f.states[1].down - f.states[0].down).norm() < 1e-10);
  CHECK((f.states[2].down - f.states[0].down).norm() < 1e-8);
  CHECK((f.states[2].down - f.states[0].down).norm() < f.made.error[column::down]);
  CHECK(f.made.error[column::down] < 1e-8);
  CHECK(f.made.error[column::attitude] < 1e-5);
}

TEST_CASE("mean precession of a top is that of its regular precession", "[heavy]") {
  for (const double spin : {60.0, -60.0, 25.0}) {
    const auto problem = *Problem<double>::make({0.0016, 0.0016, 0.002}, 0.8, {0, 0, 0.01}, 9.80665, 0);
    const auto orbit = periodic_orbit<double>(problem, spin, 0.3);
    REQUIRE(orbit);
    const auto f = follow<double>(problem, *orbit, {0, 5 * orbit->period});
    const auto exact = regular_precession(*SymmetricTop<double>::of(problem), 0.3, spin);
    CHECK(f.made.precession == Approx(exact.slow).epsilon(1e-12));
    CHECK(std::abs(f.made.precession - exact.slow) <= f.made.precession_error);
  }
}

TEST_CASE("mean precession where the axis passes near the vertical has the right number of turns", "[heavy]") {
  const auto problem = *Problem<double>::make({0.0034386261332737767, 0.0004913220311038431, 0.0036099190332326537},
                                              0.0040168356914451345, {0.12182467808260147, 0, 0}, 9.80665, 0);
  const auto orbit = periodic_orbit<double>(problem, -3.910106827187173, 0.09472011668877006);
  REQUIRE(orbit);
  const auto f = follow<double>(problem, *orbit, {0, 1});
  // by the angle of the axis over 4000 states of a period, which turns by less than 1 rad between two of them
  constexpr int count = 4000;
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(orbit->period * i / count);
  std::vector<State<double>> states(times.size());
  FullMotionOptions<double> options;
  options.attitude = true;
  REQUIRE(full_motion<double>(problem, orbit->start, times, states, options));
  double turn = 0;
  Vec3<double> last = rotate<double>(states[0].attitude, {0, 0, 1});
  for (const auto& s : states) {
    const Vec3<double> now = rotate<double>(s.attitude, {0, 0, 1});
    const double step = std::atan2(last[0] * now[1] - last[1] * now[0], last[0] * now[0] + last[1] * now[1]);
    CHECK(std::abs(step) < 1);
    turn -= step;
    last = now;
  }
  CHECK(f.made.precession == Approx(turn / orbit->period).epsilon(1e-8));
  CHECK(f.made.precession == Approx(-5.716051611).epsilon(1e-8));
  CHECK(f.made.precession_error < 1e-6);
  // through the vertical it has no meaning
  State<double> up, down;
  up.angular_velocity = down.angular_velocity = {0.1, 0, 0};
  up.attitude = {std::cos(0.025), std::sin(0.025), 0, 0};
  down.attitude = {std::cos(0.025), -std::sin(0.025), 0, 0};
  CHECK(std::isnan(axis_turn(down, up, 1.0)));
}

TEST_CASE("times at the ends of periods", "[heavy]") {
  const auto problem = flat_stone<double>();
  const auto orbit = periodic_orbit<double>(problem, 40, 0.2);
  REQUIRE(orbit);
  const double T = orbit->period;
  const std::vector<double> times{0, std::nextafter(T, 0), T, std::nextafter(T, 1), 2 * T, std::nextafter(3 * T, 0)};
  const auto f = follow<double>(problem, *orbit, times);
  for (const auto& state : f.states) CHECK((state.down - orbit->start.down).norm() < 1e-12);
}
