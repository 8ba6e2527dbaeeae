// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/exact_periodicity.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/regular_precession.hpp"
#include "honest.hpp"
#include "orbits.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Problem<double> body(double A, double B, double C, const Vec3<double>& centre, double gravity, double gradient) {
  const auto made = Problem<double>::make({A, B, C}, 0.5, centre, gravity, gradient);
  REQUIRE(made);
  return *made;
}

State<double> released(const Vec3<double>& rate, const Vec3<double>& down) { return {rate, down.normalized(), {}}; }

const Vec3<double> centre_below{0, 0, 0.03};

}  // namespace

TEST_CASE("a planar swing has a period and a plane that stands still, symmetric or not", "[heavy]") {
  for (const double gradient : {0.0, 20.0})
    for (const double rate : {0.0, 3.0, 40.0}) {
      CAPTURE(gradient, rate);
      // about axis 1; with a gradient the symmetric body has a closed form, the uneven one only without weight
      const auto from = released({rate, 0, 0}, {0, 0.5, 1});
      const auto even = periodicity_from(body(0.002, 0.002, 0.001, centre_below, 9.80665, gradient), from);
      CHECK(even.precession == 0);
      CHECK(even.precession_error == 0);
      // off the plane by what is lost in rounding it goes round the vertical by half a turn a swing, or hardly at all
      const auto beside = released({rate, 0, 0}, {1e-16, 0.5, 1});
      if (rate > 0)
        CHECK(periodicity_from(body(0.002, 0.002, 0.001, centre_below, 9.80665, gradient), beside).precession_error ==
              infinity<double>);
      CHECK(even.period_error < 1e-11);
      CHECK(gap(body(0.002, 0.002, 0.001, centre_below, 9.80665, gradient), from, even.period) < 1e-11);
      CHECK(gap(body(0.002, 0.002, 0.001, centre_below, 9.80665, gradient), from, even.period / 2) > 1e-3);
      if (gradient > 0) continue;
      const auto uneven = periodicity_from(body(0.002, 0.0025, 0.001, centre_below, 9.80665, 0), from);
      CHECK(uneven.precession == 0);
      CHECK(uneven.period == Approx(even.period).epsilon(1e-13));
    }
  // the gradient alone: half a round repeats the rates, not down
  for (const double rate : {0.5, 40.0}) {
    const auto p = body(0.002, 0.0025, 0.001, {0, 0, 0}, 0, 20);
    const auto from = released({rate, 0, 0}, {0, 0.5, 1});
    const auto known = periodicity_from(p, from);
    CHECK(known.precession == 0);
    CHECK(gap(p, from, known.period) < 1e-11);
    CHECK(gap(p, from, known.period / 2) > 1e-3);
  }
}

TEST_CASE("steady precession has one rate and one period, whichever rung answers", "[heavy]") {
  for (const double gradient : {0.0, 20.0})
    for (const bool fast : {false, true}) {
      const auto p = body(0.002, 0.002, 0.001, centre_below, 9.80665, gradient);
      const double u = 0.8, spin = 300;
      const auto rates = regular_precession(*SymmetricTop<double>::of(p), u, spin);
      State<double> from;
      from.down = {0.6, 0, u};
      from.angular_velocity = precessing_velocity<double>(from.down, spin, fast ? rates.fast : rates.slow);
      from.attitude = shortest_turn<double>(from.down, {0, 0, -1});
      Question question;
      question.wants_attitude = true;
      question.tolerance = 1e-10;
      double told[2];
      for (const int rung : {rung::exact, rung::full}) {
        CAPTURE(gradient, fast, rung);
        question.rung = rung;
        const auto scene = posed(p, from, 0.01, question, 1);
        Refusal refusal;
        const Answer answer = heavy::solve(scene, refusal);
        REQUIRE(refusal.code == Errc::ok);
        REQUIRE(answer.quantity("precession_rate"));
        REQUIRE(answer.quantity("period"));
        told[rung == rung::full] = answer.quantity("precession_rate")->values[0];
        CHECK(answer.quantity("precession_rate")->error < 1e-9);
        CHECK(gap(p, from, answer.quantity("period")->values[0]) < 1e-10);
        // the axis in space goes round the vertical at this rate, right-handed about down
        const auto& q = answer.find("attitude")->values;
        const Vec3<double> before = rotate<double>(scene.start().attitude, {0, 0, 1}),
                           after = rotate<double>(Quat<double>{q[3], q[0], q[1], q[2]}, {0, 0, 1});
        const double turn =
            -std::atan2(before[0] * after[1] - before[1] * after[0], before[0] * after[0] + before[1] * after[1]);
        CHECK(std::remainder(turn - told[rung == rung::full] * 0.01, 2 * pi<double>) == Approx(0).margin(1e-8));
      }
      CHECK(told[0] == told[1]);
      CHECK(told[0] == Approx(fast ? rates.fast : rates.slow).epsilon(1e-7));
    }
}

TEST_CASE("the trace of an unstable steady precession is not that of a slow nutation", "[heavy]") {
  const auto made =
      Body::make(Mat3<double>(Vec3<double>(1, 1, 0.001953125).asDiagonal()), 0.15, {0, 0, -2.1}, 0, 43.77);
  REQUIRE(made);
  Question question;
  question.times = {0.2};
  question.tolerance = 1e-9;
  const auto trace = [&](int rung) {
    question.rung = rung;
    Start start;
    start.periodic = Periodic{-59.67, -0.113};
    const auto scene = Scene::make(*made, start, question);
    REQUIRE(scene);
    Refusal refusal;
    const Answer answer = heavy::solve(*scene, refusal);
    REQUIRE(refusal.code == Errc::ok);
    const Quantity& found = *answer.quantity("floquet_trace");
    CHECK(found.error < 1e-9);
    return found.values[0];
  };
  CHECK(trace(rung::full) > 2.04);
  CHECK(trace(rung::exact) == Approx(trace(rung::full)).epsilon(1e-9));
}

TEST_CASE("mean precession of a nutating top is given by every rung, of an upright one by none", "[heavy]") {
  const auto p = body(0.002, 0.002, 0.001, centre_below, 9.80665, 0);
  const auto from = released({1, 2, 60}, {0.6, 0, 0.8});
  const auto known = periodicity_from(p, from);
  CHECK(std::isnan(known.period));
  CHECK(std::abs(known.precession) > 0);
  CHECK(known.precession_error < 1e-11);
  Question question;
  question.rung = rung::full;
  Refusal refusal;
  const Answer answer = heavy::solve(posed(p, from, 1, question), refusal);
  REQUIRE(answer.quantity("precession_rate"));
  CHECK(answer.quantity("precession_rate")->values[0] == known.precession);
  CHECK(std::isnan(periodicity_from(p, released({0, 0, 60}, {0, 0, 1})).precession));
  // no closed form, no period
  CHECK(std::isnan(periodicity_from(body(0.0011, 0.0016, 0.002, {0.01, 0, 0.01}, 9.8, 0), from).period));
}

TEST_CASE("a top that nods a little about the vertical does not repeat", "[heavy]") {
  const auto p = *Problem<double>::make({8.82e-4, 8.82e-4, 6.945e-4}, 10.8, {0, 0, -5.24e-4}, 9.80665, 0);
  for (const double tilt : {1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3}) {
    CAPTURE(tilt);
    CHECK(std::isnan(periodicity_from(p, released({0, 0, 73.907}, {std::sin(tilt), 0, std::cos(tilt)})).period));
  }
}

TEST_CASE("a top that passes the vertical on a side which its data leave open says so", "[heavy]") {
  Mat3<double> tensor;
  tensor << 0.0015729044808591032, 2.0831217716788477e-06, -4.801832753988409e-05, 2.0831217716788477e-06,
      0.0015562986210884667, -5.931738169170318e-06, -4.801832753988409e-05, -5.931738169170318e-06,
      0.001692774607004645;
  const auto made = Body::make(tensor, 36.860985249189945,
                               {-0.00028785520386819376, -3.555895816156877e-05, 0.0008196744535978925}, 9.80665, 0);
  REQUIRE(made);
  State<double> from;
  from.angular_velocity = {6.833391286779667, 0.8441336880589759, -19.458242178510144};
  from.attitude = {0.9855761333368092, -0.020747724007615077, 0.16795599824170598, 0};
  Question question;
  question.times = {1};
  const auto scene = Scene::make(*made, Start{from, {}, true}, question);
  REQUIRE(scene);
  const auto known = periodicity_from(*scene);
  CHECK(std::abs(known.precession + 3.106148291663306) <= known.precession_error);
}

TEST_CASE("what a conversion errs is in the errors of period and precession", "[heavy]") {
  using Long = long double;
  // the start of a nodding top and of a swing, by an attitude that rounds
  struct Case {
    Vec3<double> rate;
    Quat<double> attitude;
  };
  for (const Case& given : {Case{{1, 2, 60}, {0.6, 0.3, -0.2, 0.7}}, Case{{0.3, -0.1, 9}, {0.1, 0.9, 0.3, 0.2}}}) {
    const auto p = body(0.002, 0.002, 0.001, centre_below, 9.80665, 0);
    State<double> from;
    from.attitude = normalised(given.attitude);
    from.angular_velocity = given.rate;
    Question question;
    question.wants_attitude = true;
    const auto scene = posed(p, from, 1, question);
    const auto known = periodicity_from(scene);
    const auto problem = Problem<Long>::make(p.inertia().cast<Long>(), p.mass(), p.centre_of_mass().cast<Long>(),
                                             p.gravity(), p.gradient());
    const auto& q = scene.given().attitude;
    State<Long> start;
    start.attitude = normalised(Quat<Long>{q.w, q.x, q.y, q.z});
    start.angular_velocity = given.rate.cast<Long>();
    start.down = rotate<Long>(conjugate(start.attitude), {0, 0, -1});
    const Exact<Long> exact(*problem, start);
    REQUIRE(exact.top());
    CHECK(std::abs(known.precession - double(exact.top()->mean_precession())) <= known.precession_error);
    CHECK(known.precession_error < 1e-11);
    CHECK(known.precession_error > periodicity_from(p, scene.start()).precession_error);
  }
  // a swing that may as well go over the top is known by neither
  const auto p = body(0.002, 0.002, 0.001, centre_below, 9.80665, 0);
  State<double> upright;
  upright.attitude = normalised(Quat<double>{1e-17, 1, 0, 0});
  Question question;
  question.wants_attitude = true;
  const auto known = periodicity_from(posed(p, upright, 1, question));
  CHECK_FALSE(known.period_error < 1e-9);
}
