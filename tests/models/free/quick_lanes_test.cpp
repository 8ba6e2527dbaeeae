// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/quick_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <span>
#include <vector>

#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostats.hpp"

namespace quick_lanes_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Assembly;
using gyrostat::free::Motion;
using gyrostat::free::MotionError;
using gyrostat::free::PrincipalProblem;
using gyrostat::free::QuickLanes;
using gyrostat::free::Reduced;
using Wide = DoubleDouble;

constexpr std::size_t size = QuickLanes::size;

/// Bodies, every third in its principal axes, each to be asked up to a time of its own.
struct Crowd {
  std::vector<Assembly<double>> assemblies;
  std::vector<PrincipalProblem<double>> principal;
  std::vector<double> last;

  void add(Bodies& bodies, Problem<double> p) {
    if (assemblies.size() % 3 != 0) {
      const Quat<double> turn = bodies.attitude();
      Mat3<double> R;
      for (int i = 0; i < 3; ++i) R.col(i) = rotate<double>(turn, Vec3<double>(Vec3<double>::Unit(i)));
      const Mat3<double> J = R * p.inertia * R.transpose();
      p.inertia = (J + J.transpose()) / 2;
      p.rotor_momentum = R * p.rotor_momentum;
      p.angular_velocity = R * p.angular_velocity;
    }
    const auto m = Motion<double>::make(p);
    assemblies.push_back({p, {}});
    principal.push_back(PrincipalProblem<double>::of(p));
    last.push_back(bodies.scale(-2, 4) * (m && std::isfinite(m->period()) ? m->period() : 10));
  }
  Crowd(Regime regime, std::size_t count, unsigned seed) {
    Bodies bodies(seed);
    for (std::size_t i = 0; i < count; ++i) add(bodies, bodies.of(regime, int(i)));
  }
  std::vector<QuickLanes::Body> bodies(std::size_t first, std::size_t count) const {
    std::vector<QuickLanes::Body> made;
    for (std::size_t i = first; i < first + count; ++i) made.push_back({&assemblies[i], &principal[i], last[i]});
    return made;
  }
};

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

TEST_CASE("what eight quick forms state of their errors bounds them", "[free][length]") {
  const auto count = std::size_t(at_length(40, 120));
  int asked = 0, taken = 0, understated = 0;
  std::vector<double> ratio;
  for (const Regime regime : regimes) {
    const Crowd crowd(regime, count, 41);
    for (std::size_t first = 0; first < count; first += size) {
      QuickLanes lanes;
      const unsigned known = lanes.make(crowd.bodies(first, size));
      for (std::size_t b = 0; b < size; ++b) {
        ++asked;
        if (!(known >> b & 1)) continue;
        ++taken;
        const auto& body = crowd.assemblies[first + b].body;
        const double end = crowd.last[first + b], times[] = {.31 * end, .77 * end, end};
        const auto truth = Motion<Wide>::make<Wide>(body.cast<Wide>());
        REQUIRE(truth);
        const auto& stated = lanes.known(int(b));
        State<double> states[3];
        lanes.at(int(b), times, states);
        for (int i = 0; i < 3; ++i) {
          const Off o = off(states[i], truth->at(times[i]));
          const double rates = o.rates * states[i].angular_velocity.norm() / stated.fastest;
          CAPTURE(free_bodies::name(regime), first + b, times[i]);
          understated += o.attitude > stated.bound.attitude || rates > stated.bound.angular_velocity ||
                         o.momentum > stated.bound.angular_momentum;
          if (o.attitude > 0) ratio.push_back(stated.bound.attitude / o.attitude);
        }
        CHECK(stated.momentum == Approx(crowd.principal[first + b].M.norm()).epsilon(1e-14));
      }
    }
  }
  CAPTURE(asked, taken, understated);
  CHECK(understated == 0);
  CHECK(taken > asked / 4);
  std::sort(ratio.begin(), ratio.end());
  INFO("stated over true, least and median: " << ratio.front() << ", " << ratio[ratio.size() / 2]);
  CHECK(ratio.front() > 2);
  CHECK(ratio[ratio.size() / 2] < 150);
}

TEST_CASE("a quick form has the same bits whatever stands beside it", "[free]") {
  Bodies bodies(42);
  Crowd crowd(Regime::generic, 0, 0);
  for (int i = 0; i < 160; ++i) crowd.add(bodies, bodies.of(regimes[i % int(std::size(regimes))], i));
  crowd.assemblies[17].body.angular_velocity[1] =
      gyrostat::nan<double>;  // what is no body must not hurt those beside it
  crowd.principal[17] = PrincipalProblem<double>::of(crowd.assemblies[17].body);
  int seen = 0;
  for (std::size_t count = 2; count <= size; ++count)
    for (std::size_t first = 0; first + count <= crowd.last.size(); first += count) {
      QuickLanes together;
      const unsigned known = together.make(crowd.bodies(first, count));
      for (std::size_t b = 0; b < count; ++b) {
        CAPTURE(count, first, b);
        QuickLanes alone;
        const unsigned by_itself = alone.make(crowd.bodies(first + b, 1));
        REQUIRE((known >> b & 1) == by_itself);
        if (!by_itself) continue;
        ++seen;
        CHECK(same_bits(together.known(int(b)), alone.known(0)));
        const double t = crowd.last[first + b], times[] = {0, .5 * t, t};
        State<double> one[3], other[1];
        together.at(int(b), times, one);
        alone.at(0, {times + 2, 1}, other);
        CHECK(same_bits(one[2], other[0]));
      }
    }
  CHECK(seen > 300);
}

TEST_CASE("quick forms in lanes state about what they state one by one", "[free]") {
  const Crowd crowd(Regime::generic, 160, 43);
  std::vector<double> ratio;
  for (std::size_t first = 0; first < 160; first += size) {
    QuickLanes lanes;
    const unsigned known = lanes.make(crowd.bodies(first, size));
    for (std::size_t b = 0; b < size; ++b) {
      const auto m = Motion<double>::make(crowd.assemblies[first + b].body);
      REQUIRE(m);
      const auto alone = MotionError<double>::quick<false>(*m, crowd.assemblies[first + b], crowd.last[first + b]);
      if (!alone || !(known >> b & 1)) continue;
      const auto& found = lanes.known(int(b));
      CHECK(found.fastest == Approx(alone->fastest()));
      ratio.push_back(found.bound.attitude / alone->at(crowd.last[first + b]).attitude);
    }
  }
  std::sort(ratio.begin(), ratio.end());
  REQUIRE(ratio.size() > 100);
  CHECK(ratio[ratio.size() / 2] > .5);
  CHECK(ratio[ratio.size() / 2] < 2);
}

TEST_CASE("wheels are in a quick form as in the gyrostat that they come to", "[free]") {
  Bodies bodies(45);
  Assembly<double> given{bodies.of(Regime::generic, 1), {}};
  given.wheels = {{{0, .6, .8}, .02, 5, false}, {{1, 0, 0}, .01, -9, true}};
  const auto reduced = Reduced<double>::of(given);
  REQUIRE(reduced);
  const auto principal = PrincipalProblem<double>::of(reduced->problem);
  const QuickLanes::Body body{&given, &principal, 30};
  QuickLanes lanes;
  REQUIRE(lanes.make({&body, 1}) == 1);
  const auto truth = Motion<Wide>::make<Wide>(Reduced<Wide>::taken(given).problem);
  REQUIRE(truth);
  const double end = 30;
  State<double> state;
  lanes.at(0, {&end, 1}, &state);
  CHECK(off(state, truth->at(end)).attitude <= lanes.known(0).bound.attitude);
  CHECK(lanes.known(0).bound.attitude < 1e-11);
  CHECK(lanes.make({}) == 0);
}

}  // namespace quick_lanes_test
