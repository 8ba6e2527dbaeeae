// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/series_2_rung.hpp"

#include <cstring>

#include "catch.hpp"
#include "honest.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Question named(double tolerance = 1e-6) {
  Question question;
  question.rung = rung::series_2;
  question.wants_attitude = true;
  question.tolerance = tolerance;
  return question;
}

}  // namespace

TEST_CASE("rung series-2 is the second order with honest errors", "[heavy]") {
  Tops random(3);
  int answered = 0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    const auto p = random.body();
    const auto scene = periodic(p, random.log_any(10, 300), random.any(-0.9, 0.9), 5, 1e-6, rung::series_2);
    const Track track = series_2_track(scene, nullptr);
    REQUIRE(track.failure == Errc::ok);
    if (!track.in_domain) continue;
    ++answered;
    const auto& [spin, cosine] = *scene.periodic();
    const auto motion = *Series2<double>::make(p, spin, cosine);
    for (std::size_t k = 0; k < track.states.size(); ++k)
      CHECK((track.states[k].down - motion.at(scene.question().times[k]).down).norm() < 8 * epsilon<double>);
    check_honest(scene, track);
  }
  CHECK(answered > 15);
}

TEST_CASE("rung series-2 gives other starts their free nutation", "[heavy]") {
  Tops random(5);
  int answered = 0;
  for (int i = 0; i < 30; ++i) {
    CAPTURE(i);
    const auto p = random.body();
    auto start = random.start();
    const double spin = random.log_any(20, 300), tilt = random.log_any(1e-4, 0.03);
    start.angular_velocity = spin * Vec3<double>(tilt, -tilt / 2, 1);
    const auto scene = posed(p, start, 60 / spin, named());
    const Track track = series_2_track(scene, nullptr);
    if (track.failure != Errc::ok) {
      CHECK(track.failure == Errc::not_applicable);
      continue;
    }
    if (!track.in_domain) continue;
    ++answered;
    CHECK((track.states.front().angular_velocity - start.angular_velocity).norm() < 0.2 * spin);
    CHECK(std::isnan(track.periodicity.period));
    check_honest(scene, track);
  }
  CHECK(answered > 10);
}

TEST_CASE("rung series-2: where moment A or B is next to C, weight shares p and q out anew", "[heavy]") {
  Tops random(31);
  int answered = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const double next = 1 + (i % 3 == 0 ? 1 : -1) * random.log_any(1e-6, 1e-2);
    const double other = i % 3 == 0 ? random.log_any(1.1, 1.6) : random.log_any(0.4, 0.9);
    const auto p = *Problem<double>::make(i % 2 == 0 ? Vec3<double>(other, next, 1) : Vec3<double>(next, other, 1), 1,
                                          {0, 0, random.log_any(1e-5, 0.1)}, 9.8, 0);
    auto start = random.start();
    const double spin = random.log_any(20, 300);
    start.angular_velocity = {0, 0, spin};
    const auto scene = posed(p, start, random.log_any(3, 300) / spin, named());
    const Track track = series_2_track(scene, nullptr);
    if (track.failure != Errc::ok || !track.in_domain) continue;
    ++answered;
    check_honest(scene, track);
  }
  CHECK(answered > 20);
}

TEST_CASE("rung series-2 counts the tilt of the momentum where axis 3 is the least one by far", "[heavy]") {
  // free: A/C = 4.7 and 5.3
  const auto slim = *Problem<double>::make({1.716545521472373, 1.4640460411750875, 0.36769342422485352}, 1.2, {0, 0, 0},
                                           2.2271001478361505, 0);
  State<double> start;
  start.angular_velocity = {-3.8294344436039038e-06, 3.9783739587638709e-06, -0.59878914111444093};
  start.down = {-0.83464055356894828, 0.54933767171724945, -0.040040838782314236};
  Question question = named();
  question.wants_attitude = false;
  const auto scene = posed(slim, start, 13.374261021662255, question);
  check_honest(scene, series_2_track(scene, nullptr));

  const auto symmetric = *Problem<double>::make({1.7878484180795351, 1.7878484181092238, 0.3349418044090271}, 0.96,
                                                {0, 0, 0.067193145519888281}, 0, 2.2251071412605883e-07);
  start.angular_velocity = {-0.020994121638082328, 0.050624375230001184, 0.7543675758134577};
  start.down = {-0.60686285734091716, 0.73363130195832915, 0.30578192419916661};
  const auto wide = posed(symmetric, start, 60.541344691378072, question);
  check_honest(wide, series_2_track(wide, nullptr));
}

TEST_CASE("rung series-2 recognises the start of the forced motion", "[heavy]") {
  const auto p = *Problem<double>::make({0.0011, 0.0014, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 0);
  const auto start = Series2<double>::make(p, 500, 0.1)->at(0);
  const auto scene = posed(p, start, 0.1, named());
  const Track forced = series_2_track(scene, nullptr);
  const double nutating = Nutating<double>::make(p, start)->error(0.1).down;
  CHECK(forced.error[column::down] < nutating / 4);
  check_honest(scene, forced);
  CHECK(std::isnan(forced.periodicity.period));
}

TEST_CASE("rung series-2 refuses what it has no formula for", "[heavy]") {
  const auto p = *Problem<double>::make({0.0011, 0.0024, 0.002}, 0.8, {0.012, 0, 0.01}, 9.80665, 0);
  State<double> start;
  start.angular_velocity = {3, 2, 100};
  start.down = {0, 0.6, 0.8};
  Question question;
  question.rung = rung::series_2;
  const Track intermediate = series_2_track(posed(p, start, 1, question), nullptr);
  CHECK(intermediate.failure == Errc::not_applicable);
  CHECK(std::strstr(intermediate.refusal, "intermediate"));
  const auto even = *Problem<double>::make({0.002, 0.0016, 0.002}, 0.8, {0.012, 0, 0.01}, 9.80665, 0);
  const Track divisor = series_2_track(periodic(even, 100, 0.1, 1), nullptr);
  CHECK(divisor.failure == Errc::not_applicable);
  CHECK(std::strstr(divisor.refusal, "divisor"));
}

TEST_CASE("rung series-2 has no answer where the rounding of a tensor turns its axes", "[heavy]") {
  Body body;
  body.problem = *Problem<double>::make({1, 1 + 4e-16, 1.5}, 1, {0, 0, 0}, 0, 0);
  body.R_BP = to_matrix(normalised(Quat<double>{1, 0.3, 0.2, 0.1}));
  Question question;
  question.times = {1};
  question.rung = rung::series_2;
  const auto scene = Scene::make(body, Start{{{0.1, 0.2, 5}, Vec3<double>(0.6, 0, 0.8), {}}}, question);
  REQUIRE(scene);
  CHECK(series_2_track(*scene, nullptr).failure == Errc::not_applicable);
}
