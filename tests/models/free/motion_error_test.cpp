// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/motion_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostat/models/free/averages.hpp"
#include "gyrostats.hpp"

namespace free_error_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Assembly;
using gyrostat::free::Data;
using gyrostat::free::Kind;
using gyrostat::free::Motion;
using gyrostat::free::MotionError;
using gyrostat::free::Reduced;
using Wide = DoubleDouble;

struct Tally {
  int asked = 0, understated = 0, endless = 0;
  std::vector<double> ratio;
  double median() {
    std::sort(ratio.begin(), ratio.end());
    return ratio.empty() ? 0 : ratio[ratio.size() / 2];
  }
};

/// True errors against what is stated. Truth: the data as given (`exact`), or each a rounding of 2^-52 away.
template <Real Setup>
Tally tally(Regime regime, Data data, int count, unsigned seed) {
  Bodies bodies(seed);
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const auto p = bodies.of(regime, i);
    auto given = p.cast<Wide>();
    const auto m = Motion<double>::make<Setup>(p.cast<Setup>());
    if (data == Data::rounded) given = bodies.jittered(p).cast<Wide>();
    const auto truth = Motion<Wide>::make<Wide>(given);
    REQUIRE((m && truth));
    const double T = std::isfinite(m->period()) ? m->period() : 10;
    double fastest = 0;
    for (int k = 0; k < 16; ++k) fastest = std::max(fastest, m->at(T * k / 16).angular_velocity.norm());
    for (const double turns : {.01, .3, 1.3, 40., 1e4}) {
      const double t = turns * T * bodies.uniform(.7, 1);
      const auto error = MotionError<double>::of<Setup>(Assembly<double>{p, {}}, data, t);
      REQUIRE(error);
      const auto bound = error->at(t);
      ++tally.asked;
      if (!std::isfinite(bound.attitude)) {
        ++tally.endless;
        continue;
      }
      const auto s = m->at(t);
      const Off o = off(s, truth->at(t));
      const double rates = o.rates * s.angular_velocity.norm() / fastest;
      if (o.attitude > bound.attitude || rates > bound.angular_velocity || o.momentum > bound.angular_momentum) {
        ++tally.understated;
        UNSCOPED_INFO(free_bodies::name(regime)
                      << ' ' << i << " after " << turns << ": attitude " << o.attitude << " of " << bound.attitude
                      << ", rates " << rates << " of " << bound.angular_velocity << ", momentum " << o.momentum
                      << " of " << bound.angular_momentum);
      }
      if (o.attitude > 0) tally.ratio.push_back(bound.attitude / o.attitude);
    }
  }
  return tally;
}

TEST_CASE("the stated error of a free motion is never too small where the set-up has two words", "[free][length]") {
  for (const Regime regime : regimes)
    for (const Data data : {Data::rounded, Data::exact}) {
      auto t = tally<Wide>(regime, data, at_length(20, 60), 31);
      CAPTURE(free_bodies::name(regime), data == Data::exact, t.asked, t.endless);
      CHECK(t.understated == 0);
      CHECK(t.median() < 15);
      if (regime != Regime::bisected) CHECK(t.endless == 0);
    }
}

TEST_CASE("the stated error of a free motion set up in double is hardly ever too small", "[free][length]") {
  int asked = 0, understated = 0;
  for (const Regime regime : regimes) {
    auto t = tally<double>(regime, Data::rounded, at_length(20, 60), 32);
    asked += t.asked, understated += t.understated;
    CAPTURE(free_bodies::name(regime));
    CHECK(t.median() < 80);
  }
  CHECK(understated <= asked / 500);
}

TEST_CASE("fifty thousand stated errors of free motions", "[.long]") {
  Tally all;
  for (const Regime regime : regimes) {
    auto t = tally<Wide>(regime, Data::rounded, 1000, 33);
    INFO(free_bodies::name(regime) << ": median stated/true " << t.median());
    CHECK(t.median() < 15);
    all.asked += t.asked, all.understated += t.understated;
    all.ratio.insert(all.ratio.end(), t.ratio.begin(), t.ratio.end());
  }
  CHECK(all.asked >= 50'000);
  CHECK(all.understated <= all.asked / 2000);
  CHECK(all.median() <= 10);
}

TEST_CASE("where the data fix no phase the error of a free motion is infinite", "[free]") {
  const auto error_of = [](const Vec3<double>& l, const Vec3<double>& w, double horizon, Data data = Data::rounded) {
    return *MotionError<double>::of<Wide>(Assembly<double>{Problem<double>::from_moments({6, 4, 3}, l, w), {}}, data,
                                          horizon);
  };
  // the separatrix: the data decide nothing after ln(1/eps) of the rate
  const auto separatrix = error_of({0, 0, 0}, {1, 1, 2}, 1000);
  CHECK(separatrix.at(1).attitude < 1e-13);
  CHECK(std::isinf(separatrix.at(200).attitude));
  CHECK_FALSE(separatrix.kinds_agree());
  // long after the start a generic motion too, unless the data are exact
  const auto error_until = [&](double t) { return error_of({.1, -.2, .3}, {1, 2, 3}, t); };
  const auto generic = error_until(1e3), backward = error_until(-1e3);
  CHECK(generic.kinds_agree());
  CHECK(generic.at(1e3).attitude < 1e-10);
  CHECK(std::isinf(error_until(1e18).at(1e18).attitude));
  CHECK(std::isinf(error_until(infinity<double>).at(infinity<double>).attitude));
  CHECK(std::isinf(generic.at(1001).attitude));
  CHECK(std::isinf(generic.at(-1).attitude));
  CHECK(std::isinf(generic.at(gyrostat::nan<double>).attitude));
  CHECK(error_of({.1, -.2, .3}, {1, 2, 3}, 1e18, Data::exact).at(1e18).attitude < 1e-9);
  // permanent rotations: stable ones drift, an unstable one leaves
  CHECK(error_of({0, 0, 0}, {2, 0, 0}, 1e3).at(1e3).attitude < 1e-10);
  const auto unstable = error_of({0, 0, 0}, {0, 2, 0}, 100);
  CHECK(unstable.at(1).attitude < 1e-12);
  CHECK(std::isinf(unstable.at(100).attitude));
  // grows with time, never falls
  double last = 0;
  for (double t = 0; t < 300; t += .37) {
    CHECK(generic.at(t).attitude >= last);
    last = generic.at(t).attitude;
  }
  CHECK(backward.at(-1e3).attitude == Approx(generic.at(1e3).attitude).epsilon(.5));
  CHECK(generic.period() < 1e-14);
  CHECK(generic.turn_per_period() < 1e-12);
  CHECK(generic.modulus_squared() < 1e-14);
  CHECK(generic.energy() < 1e-14);
  CHECK(generic.angular_momentum_norm() < 1e-14);
}

TEST_CASE("errors of special free motions are bounds too", "[free]") {
  Bodies bodies(34);
  for (int i = 0; i < 60; ++i) {
    const auto l = bodies.vector(), w = bodies.vector();
    const Vec3<double> J = bodies.moments();
    Problem<double> p;
    if (i % 3 == 0) p = Problem<double>::from_moments({2, 2, 2}, l, w);                 // a sphere
    if (i % 3 == 1) p = Problem<double>::from_moments(J, (J * -1).cwiseProduct(w), w);  // M = 0
    if (i % 3 == 2) {  // about the axis of the largest or smallest moment
      const int k = i % 2 ? 0 : 2;
      p = Problem<double>::from_moments(J, {0, 0, 0}, Vec3<double>::Unit(k) * w[0]);
    }
    const auto m = Motion<double>::make<Wide>(p.cast<Wide>());
    const auto error = MotionError<double>::of<Wide>(Assembly<double>{p, {}}, Data::rounded, 1e3);
    REQUIRE((m && error));
    const auto truth = Motion<Wide>::make<Wide>(bodies.jittered(p).cast<Wide>());
    for (const double t : {.1, 3., 40., 1e3}) {
      CAPTURE(i, t);
      CHECK(off(m->at(t), truth->at(t)).attitude <= error->at(t).attitude);
      CHECK(error->at(t).attitude < 1e-12 * (1 + t) * (1 + w.norm()) * (i % 3 ? 1 : 1 + l.norm()));
    }
  }
}

TEST_CASE("a near horizon brings close bounds where the period is long", "[free]") {
  Bodies bodies(35);
  for (int i = 0; i < 40; ++i) {
    // two moments equal but for roundings, M nearly across the axis of the third: the polhode takes ages, the body turns at once
    const double e = bodies.scale(-15, -9);
    const auto p = Problem<double>::from_moments({1.4, 1 + e, 1}, {0, 0, 0},
                                                 {bodies.scale(-12, -7), bodies.uniform(1, 2), 1}, bodies.attitude());
    const auto m = Motion<double>::make<Wide>(p.cast<Wide>());
    const auto truth = Motion<Wide>::make<Wide>(bodies.jittered(p).cast<Wide>());
    const Assembly<double> given{p, {}};
    for (const double t : {0., .1, 3., 40.}) {
      const auto near = MotionError<double>::of<Wide>(given, Data::rounded, t);
      const auto far = MotionError<double>::of<Wide>(given, Data::rounded, 1e3 * m->period());
      REQUIRE((m && truth && near && far));
      CAPTURE(e, t, m->period());
      CHECK(near->at(t).attitude < 1e-13 * (1 + t));
      if (t > 0) CHECK(near->at(t).attitude < far->at(t).attitude);  // at the start both are the roundings
      CHECK(off(m->at(t), truth->at(t)).attitude <= near->at(t).attitude);
      CHECK(std::isinf(near->at(1.1 * t + 1e-9).attitude));
    }
  }
}

TEST_CASE("a steady rotation that is neither stable nor unstable leaves as slowly as its neighbours", "[free]") {
  const auto steady = [](const Vec3<double>& J, const Vec3<double>& w) {
    const auto p = Problem<double>::from_moments(J, {0, 0, 0}, w);
    const auto m = Motion<double>::make<Wide>(p.cast<Wide>());
    REQUIRE(m);
    CHECK(m->kind() == Kind::steady);
    CHECK(m->steady_square() == 0);
    return MotionError<double>::of<Wide>(*m, Assembly<double>{p, {}}, Data::rounded, 1e3);
  };
  const auto sphere = steady({1.2, 1.2, 1.2}, {1e-9, 1, -1e-9});
  const auto across = steady({1.5, 1, 1}, {0, .6, .8});
  for (const double t : {1., 30., 1e3}) {  // across an axis of symmetry M drifts in proportion to the square of time
    CHECK(sphere.at(t).attitude < 1e-14 * (1 + t));
    CHECK(across.at(t).attitude < 1e-14 * (1 + t) * (1 + t));
  }
}

TEST_CASE("in flat spin the attitude is as sure as the rate and the momentum's place in the body", "[free]") {
  // a booster after separation, end over end for a day
  const auto p = Problem<double>::from_moments({122e3, 122e3, 11300}, {0, 0, 0}, {0, 2.0943951023931953, 0});
  const double day = 86400;
  const auto m = Motion<double>::make<Wide>(p.cast<Wide>());
  const auto error = MotionError<double>::of<Wide>(Assembly<double>{p, {}}, Data::rounded, day);
  REQUIRE((m && error));
  CHECK(m->kind() == Kind::steady);
  CHECK(error->at(day).attitude < 1e-7);
  Bodies bodies(36);
  for (int i = 0; i < 20; ++i) {
    const auto truth = Motion<Wide>::make<Wide>(bodies.jittered(p).cast<Wide>());
    CHECK(off(m->at(day), truth->at(day)).attitude <= error->at(day).attitude);
  }
}

TEST_CASE("the momentum of a steady rotation is known to the roundings of what it is summed of", "[free]") {
  Bodies bodies(37);
  for (int i = 0; i < 50; ++i) {
    const Vec3<double> J = bodies.moments();
    const double w = bodies.uniform(.1, 2), little = bodies.scale(-6, -1);
    const auto p = Problem<double>::from_moments(J, {0, 0, (little - 1) * J[2] * w}, {0, 0, w});
    const auto m = Motion<double>::make<Wide>(p.cast<Wide>());
    const auto error = MotionError<double>::of<Wide>(Assembly<double>{p, {}}, Data::rounded, 1);
    const auto truth = Motion<Wide>::make<Wide>(bodies.jittered(p).cast<Wide>());
    REQUIRE((m && error && truth));
    CAPTURE(i, little);
    CHECK(off(m->at(1), truth->at(1)).momentum <= error->at(1).angular_momentum);
    CHECK(error->at(1).angular_momentum < 1e-14 * (1 + 1 / little));
  }
}

/// A slim body, its axes not those of the data, whose slight moment turns a rounding of M into many of omega.
Problem<double> slim(Bodies& bodies, double least, double across) {
  const double slight = bodies.scale(least, -1), gap = bodies.scale(-6, -1) * slight;
  const Quat<double> turn = bodies.attitude();
  Mat3<double> R;
  for (int i = 0; i < 3; ++i) R.col(i) = rotate<double>(turn, Vec3<double>(Vec3<double>::Unit(i)));
  Mat3<double> J = R * Vec3<double>(1, 1 - gap, slight).asDiagonal() * R.transpose();
  J = Mat3<double>((J + J.transpose()) / 2);
  Problem<double> made;
  made.inertia = J;
  made.angular_velocity = R * Vec3<double>(across * bodies.normal(), across * bodies.normal(), 1);
  made.attitude = bodies.attitude();
  return made;
}

TEST_CASE("rates of slim bodies err by what their slight moment makes of a rounding", "[free]") {
  Bodies bodies(8101);
  std::vector<double> ratio;
  for (int i = 0; i < 300; ++i) {
    const bool soon = i >= 150;  // before neighbours are apart, when rounding of the evaluation alone shows
    const auto p = soon ? slim(bodies, -7, 1) : slim(bodies, -4, 0.1);
    const auto m = Motion<double>::make<Wide>(p.cast<Wide>());
    const auto truth = Motion<Wide>::make<Wide>(p.cast<Wide>());
    REQUIRE((m && truth));
    const double last = soon ? bodies.scale(-8, -2) : bodies.scale(-1, 1);
    const auto error = MotionError<double>::of<Wide>(*m, Assembly<double>{p, {}}, Data::rounded, last);
    double most = 0, fastest = 0;
    for (int k = 1; k <= 12; ++k) {
      const auto s = m->at(last * k / 12);
      fastest = std::max(fastest, s.angular_velocity.norm());
      most = std::max(most, off(s, truth->at(last * k / 12)).rates * s.angular_velocity.norm());
    }
    const double stated = error.at(last).angular_velocity * error.fastest();
    ratio.push_back(stated / most);
    CAPTURE(i, most / fastest, stated / fastest);
    CHECK(most <= stated);
  }
  std::sort(ratio.begin(), ratio.end());
  INFO("median stated/true " << ratio[ratio.size() / 2]);
  CHECK(ratio[ratio.size() / 2] < 30);
}

TEST_CASE("the start of a slim body comes back to four roundings of what its rates are summed of", "[free]") {
  Bodies bodies(8102);
  int hyperbolic = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double slight = bodies.scale(-7, -1);
    Problem<double> p;
    p.inertia = Vec3<double>(1, 1 - slight * bodies.scale(-4, -1), slight).asDiagonal();
    p.angular_velocity = {bodies.scale(-3, 0) * bodies.normal(), bodies.scale(-3, 0) * bodies.normal(),
                          bodies.scale(-3, 3) * bodies.normal()};
    if (i % 2) p.rotor_momentum = {0, 0, bodies.scale(-8, 0) * bodies.normal()};
    const auto m = Motion<double>::make<DoubleDouble>(p.cast<DoubleDouble>());
    if (!m || m->kind() == gyrostat::free::Kind::steady || m->is_regular_precession()) continue;
    hyperbolic += m->hyperbolic();
    CAPTURE(i, m->hyperbolic());
    CHECK((m->at(0).angular_velocity - p.angular_velocity).norm() <= 4 * epsilon<double> * m->rate_terms(0));
  }
  CHECK(hyperbolic > 200);
}

/// The same body in axes of the data that are not its principal ones.
Problem<double> turned(Bodies& bodies, Problem<double> p) {
  const Quat<double> turn = bodies.attitude();
  Mat3<double> R;
  for (int i = 0; i < 3; ++i) R.col(i) = rotate<double>(turn, Vec3<double>(Vec3<double>::Unit(i)));
  const Mat3<double> J = R * p.inertia * R.transpose();
  p.inertia = (J + J.transpose()) / 2;
  p.rotor_momentum = R * p.rotor_momentum;
  p.angular_velocity = R * p.angular_velocity;
  return p;
}

template <bool in_lanes>
void quick_errors_bound() {
  Bodies bodies(36);
  const int count = at_length(40, 120);
  int asked = 0, taken = 0, generic = 0, understated = 0, of_scalars = 0;
  for (const Regime regime : regimes)
    for (int i = 0; i < count; ++i) {
      auto p = bodies.of(regime, i);
      if (i % 3) p = turned(bodies, p);
      const auto m = Motion<double>::make(p);
      const auto truth = Motion<Wide>::make<Wide>(p.cast<Wide>());
      if (!m || !truth) continue;
      const double t = bodies.scale(-2, 4) * (std::isfinite(m->period()) ? m->period() : 10);
      const auto error = MotionError<double>::quick<in_lanes>(*m, Assembly<double>{p, {}}, t);
      ++asked;
      if (!error) continue;
      ++taken;
      generic += regime == Regime::generic;
      const auto bound = error->at(t);
      for (const double part : {.31, .77, 1.}) {
        const auto s = m->at(part * t);
        const Off o = off(s, truth->at(part * t));
        const double rates = o.rates * s.angular_velocity.norm() / error->fastest();
        if (o.attitude > bound.attitude || rates > bound.angular_velocity || o.momentum > bound.angular_momentum)
          ++understated;
      }
      of_scalars += std::abs(m->period() / double(truth->period()) - 1) > error->period();
      of_scalars += std::abs(m->energy() / double(truth->energy()) - 1) > error->energy();
    }
  CAPTURE(asked, taken, generic, understated, of_scalars);
  CHECK(understated == 0);
  CHECK(of_scalars == 0);
  CHECK(generic > 3 * count / 4);
  CHECK(taken > asked / 3);
}

TEST_CASE("the quick error of a free motion bounds a set-up in double, or is not there", "[free][length]") {
  SECTION("with the neighbours side by side") { quick_errors_bound<true>(); }
  SECTION("one by one") { quick_errors_bound<false>(); }
}

TEST_CASE("precessions that a fast wheel drives are known as well as their wheel's momentum is put together",
          "[free]") {
  Bodies bodies(39);
  int taken = 0, understated = 0;
  for (int i = 0; i < at_length(6000, 100'000); ++i) {
    Assembly<double> a;
    const double J = bodies.scale(-1, 0), K = i % 3 == 0 ? J : J * bodies.uniform(0.3, 1.9);
    a.body = Problem<double>::from_moments({J, J, K}, {0, 0, 0}, bodies.scale(-3, 0) * bodies.vector());
    a.wheels.push_back({Vec3<double>(0, 0, 1), K * bodies.scale(-5, -2), bodies.scale(1, 4), i % 2 == 0});
    const auto m = Motion<double>::make(Reduced<double>::taken(a).problem);
    const auto truth = Motion<Wide>::make<Wide>(Reduced<Wide>::taken(a.cast<Wide>()).problem);
    if (!m || !truth) continue;
    const double t = bodies.scale(1, 3);
    const auto error = MotionError<double>::of_precession(*m, a, t);
    if (!error) continue;
    ++taken;
    const auto bound = error->at(t);
    const Off o = off(m->at(t), truth->at(t));
    understated += o.attitude > bound.attitude || o.rates > bound.angular_velocity;
  }
  CHECK(taken >= 5000);
  CHECK(understated == 0);
}

TEST_CASE("regular precessions need no neighbours, and their rate's integral is known too", "[free]") {
  Bodies bodies(38);
  int taken = 0, understated = 0;
  std::vector<double> ratio;
  for (int i = 0; i < 200; ++i) {
    auto p = bodies.of(Regime::symmetric, i);
    if (i % 3 == 2) p = turned(bodies, p);
    const auto m = Motion<double>::make(p);
    const auto truth = Motion<Wide>::make<Wide>(p.cast<Wide>());
    REQUIRE(truth);
    if (!m) continue;
    const double t = bodies.scale(-2, 2) * (std::isfinite(m->period()) ? std::min(m->period(), 1e3) : 10);
    const auto error = MotionError<double>::of_precession(*m, Assembly<double>{p, {}}, t);
    if (!error) continue;
    ++taken;
    const auto bound = error->at(t);
    const Off o = off(m->at(t), truth->at(t));
    using Long = long double;
    const gyrostat::free::RateIntegral<Long> integral(*Motion<Long>::make(p.cast<Long>()), Long(t));
    const auto turned = gyrostat::vector_cast<double>(integral.at(Long(t)));
    const double lost = (m->precession_integral(t) - turned).norm() - 16 * epsilon<double> * turned.norm();
    CAPTURE(i, t, lost, error->turned(t), o.attitude, bound.attitude);
    understated += o.attitude > bound.attitude || lost > error->turned(t);
    if (o.attitude > 0) ratio.push_back(bound.attitude / o.attitude);
    CHECK(lost <= error->turned(t));
  }
  std::sort(ratio.begin(), ratio.end());
  CHECK(taken > 150);
  CHECK(understated == 0);
  INFO("median stated/true " << ratio[ratio.size() / 2]);
  CHECK(ratio[ratio.size() / 2] < 30);
}

TEST_CASE("the modulus of a body of revolution in turned axes errs the more the nearer it is to flat spin", "[free]") {
  Bodies bodies(39);
  std::vector<double> ratio;
  for (const Vec3<double>& J : {Vec3<double>(1, 4, 4), Vec3<double>(0.2, 4, 4), Vec3<double>(5, 5, 7)})
    for (int i = 0; i < 60; ++i) {
      const double off = bodies.scale(-4, 0), azimuth = bodies.uniform(0, 6);
      const Vec3<double> flat(std::cos(azimuth), std::sin(azimuth), off);
      const int axis = J[0] < J[1] ? 0 : 2;
      Vec3<double> w;
      for (int k = 0; k < 3; ++k) w[k] = flat[(k + 2 - axis) % 3];
      const auto p = turned(bodies, Problem<double>::from_moments(J, {0, 0, 0}, w));
      const auto m = Motion<double>::make(p);
      const auto truth = Motion<Wide>::make<Wide>(p.cast<Wide>());
      REQUIRE((m && truth));
      if (m->kind() == Kind::steady || truth->kind() == Kind::steady) continue;
      const auto error = MotionError<double>::of<double>(*m, Assembly<double>{p, {}}, Data::rounded, 10);
      const double apart = std::abs(m->modulus_squared() - double(truth->modulus_squared()));
      CAPTURE(J, off, m->modulus_squared(), double(truth->modulus_squared()));
      CHECK(apart <= error.modulus_squared());
      if (apart > 0) ratio.push_back(error.modulus_squared() / apart);
    }
  std::sort(ratio.begin(), ratio.end());
  REQUIRE(ratio.size() > 100);
  CHECK(ratio[ratio.size() / 2] < 100);
}

TEST_CASE("the modulus of a body whose moments differ by roundings is not known to be that of a body of revolution",
          "[free]") {
  for (const double roundings : {1.0, 2.0, 3.0}) {
    const double C = 440.72051068984547, B = C * (1 + roundings * epsilon<double>), A = 185.4819661003833;
    const auto p = Problem<double>::from_moments({A, C, B}, {0, 0, 0}, {-0.06, 1, -0.08});
    const auto m = Motion<double>::make(p);
    REQUIRE(m);
    REQUIRE(m->is_regular_precession());
    const auto error = MotionError<double>::of<double>(*m, Assembly<double>{p, {}}, Data::rounded, 10);
    const auto truth = Motion<Wide>::make<Wide>(p.cast<Wide>());
    REQUIRE(truth);
    CAPTURE(roundings, double(truth->modulus_squared()));
    CHECK(double(truth->modulus_squared()) > 1e-13);
    CHECK(double(truth->modulus_squared()) <= error.modulus_squared());
  }
}

TEST_CASE("neighbours side by side show what they show one by one", "[free]") {
  Bodies bodies(37);
  std::vector<double> ratio;
  for (int i = 0; i < 300; ++i) {
    auto p = bodies.of(Regime::generic, i);
    if (i % 3) p = turned(bodies, p);
    const auto m = Motion<double>::make(p);
    REQUIRE(m);
    const Assembly<double> given{p, {}};
    const auto lanes = MotionError<double>::quick<true>(*m, given, 100),
               alone = MotionError<double>::quick<false>(*m, given, 100);
    if (!lanes || !alone) continue;
    CHECK(lanes->fastest() == Approx(alone->fastest()));
    ratio.push_back(lanes->at(100).attitude / alone->at(100).attitude);
  }
  std::sort(ratio.begin(), ratio.end());
  REQUIRE(ratio.size() > 150);
  CHECK(ratio[ratio.size() / 2] > .5);
  CHECK(ratio[ratio.size() / 2] < 2);
}

TEST_CASE("the quick error of bodies with equal moments bounds period and turn", "[free][length]") {
  Bodies bodies(38);
  int taken = 0;
  for (int i = 0; i < at_length(3000, 100'000); ++i) {
    // tumbling almost across the axis of symmetry, about which the turns are counted by a small part of M
    const double A = bodies.uniform(1, 3), C = A * bodies.uniform(.2, 1.9),
                 near = i % 2 ? A : A * (1 + 1e-14 * (i % 50));
    auto p = Problem<double>::from_moments({near, A, C}, {0, 0, 0},
                                           {bodies.uniform(-1, 1), bodies.uniform(-1, 1), bodies.scale(-4, 0)});
    if (i % 3 == 0) p.rotor_momentum[2] = bodies.scale(-3, -1);
    const auto m = Motion<double>::make(p);
    const auto truth = Motion<Wide>::make<Wide>(p.cast<Wide>());
    if (!m || !truth) continue;
    const auto error = MotionError<double>::quick(*m, Assembly<double>{p, {}}, 100);
    if (!error) continue;
    ++taken;
    CAPTURE(A, near, C, p.angular_velocity, p.rotor_momentum);
    CHECK(std::abs(m->period() / double(truth->period()) - 1) <= error->period());
    const double apart = std::abs(m->turn_per_period() - double(truth->turn_per_period()));
    CHECK(std::min(apart, 2 * pi<double> - apart) <= error->turn_per_period());
    CHECK(std::abs(m->modulus_squared() - double(truth->modulus_squared())) <= error->modulus_squared());
  }
  CHECK(taken > 1000);
}

TEST_CASE("no quick error where the set-up in double may be wrong", "[free]") {
  const auto quick = [](const Problem<double>& p) {
    return MotionError<double>::quick(*Motion<double>::make(p), Assembly<double>{p, {}}, 100).has_value();
  };
  CHECK(quick(Problem<double>::from_moments({3, 2, 1}, {0, 0, 0}, {1, .1, .1})));
  CHECK_FALSE(quick(Problem<double>::from_moments({3, 2, 1}, {0, 0, 0}, {1e-4, 1, 1e-4})));  // beside the separatrix
  CHECK_FALSE(quick(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {1, 1, 2})));        // on it
  CHECK_FALSE(quick(Problem<double>::from_moments({3, 2, 1}, {0, 0, 0}, {1, 0, 0})));        // steady
  // the slightest moment takes what rounding leaves of M for a rate
  CHECK_FALSE(quick(Problem<double>::from_moments({1, .9999999, 1e-6}, {0, 0, 0}, {.4, .3, .2})));
}

}  // namespace free_error_test
