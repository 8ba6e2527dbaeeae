// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/solve.hpp"

#include <cstring>
#include <string_view>

#include "catch.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "honest.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

struct Solved {
  Answer answer;
  Refusal refusal;

  bool by(const char* model) const { return std::strcmp(answer.model, model) == 0; }
  const Quantity* scalar(const char* name) const { return answer.quantity(name); }
};

Solved solved(const Scene& scene, Monitor* monitor = nullptr) {
  Solved made;
  made.answer = heavy::solve(scene, made.refusal, monitor);
  return made;
}

const Vec3<double> stone_centre{0.012, 0.009, 0.01};
const Problem<double> stone =
    *Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, stone_centre, 9.80665, 4.617791555485795e-06);
const Problem<double> even_top = *Problem<double>::make({0.0016, 0.0016, 0.002}, 0.8, {0, 0, 0.01}, 9.80665, 0);

}  // namespace

TEST_CASE("a fast periodic motion of a heavy body: each rung where it is enough", "[heavy]") {
  const auto at = [](double spin, double tolerance) { return solved(periodic(stone, spin, 0.1, 3, tolerance)); };
  CHECK(at(1500, 1e-4).by("series-2"));
  CHECK(at(150, 1e-4).by("series"));
  CHECK(at(150, 1e-9).by("series"));
  CHECK(at(20, 1e-9).by("full"));
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto scene = periodic(stone, 150, 0.1, 3, tolerance);
    const Solved made = solved(scene);
    CHECK(made.refusal.code == Errc::ok);
    CHECK(made.answer.met);
    CHECK(made.answer.tried.back().accepted);
    check_honest(scene, made.answer);
    CHECK(made.scalar("period")->values[0] == Approx(4.196818797409593e-02).epsilon(tolerance));
    CHECK(made.scalar("stable")->values[0] == 1);
  }
}

TEST_CASE("rung full of a periodic heavy motion: period and trace to all digits", "[heavy]") {
  const Solved made = solved(periodic(stone, 150, 0.1, 3, 1e-6, rung::full));
  CHECK(made.by("full"));
  // closed in 80 bits by another integrator
  CHECK(made.scalar("period")->values[0] == Approx(4.196818797409592953e-02).epsilon(1e-14));
  CHECK(made.scalar("floquet_trace")->values[0] == Approx(-1.9111876939650645).epsilon(1e-11));
  const auto slower = solved(periodic(stone, 21.02331426521783, 0.1, 3, 1e-6, rung::full));
  CHECK(slower.scalar("floquet_trace")->values[0] == Approx(-1.9054578079090723).epsilon(1e-9));
}

TEST_CASE("a heavy body asked for by its start", "[heavy]") {
  Question question;
  State<double> start;
  start.angular_velocity = {0.1, -0.3, 10};
  start.down = {0.6, 0, 0.8};
  question.tolerance = 1e-9;
  const auto scene = posed(stone, start, 2, question);
  const Solved made = solved(scene);
  CHECK(made.by("full"));
  CHECK(made.answer.met);
  CHECK(made.answer.quantities.empty());
  check_honest(scene, made.answer);
  start.angular_velocity *= 300;
  question.tolerance = 1e-2;
  CHECK(solved(posed(stone, start, 0.01, question)).by("series-2"));
}

TEST_CASE("what is known exactly is answered exactly", "[heavy]") {
  State<double> start;
  start.angular_velocity = {1, 2, 60};
  start.down = {0.6, 0, 0.8};
  Question question;
  question.tolerance = 1e-9;
  const auto scene = posed(even_top, start, 2, question);
  const Solved made = solved(scene);
  CHECK(made.by("exact"));
  CHECK(made.answer.tried.size() == 1);
  check_honest(scene, made.answer);
  const auto asked = periodic(even_top, 60, 0.3, 20, 1e-9);
  const Solved precessing = solved(asked);
  CHECK(precessing.by("exact"));
  check_honest(asked, precessing.answer);
}

TEST_CASE("a rung of the heavy family asked for by name answers or refuses", "[heavy]") {
  const auto by = [](int rung, double spin) { return solved(periodic(stone, spin, 0.1, 3, 1e-9, rung)); };
  CHECK(by(rung::series_2, 50).by("series-2"));
  CHECK_FALSE(by(rung::series_2, 50).answer.met);
  CHECK(by(rung::series, 50).by("series"));
  CHECK(by(rung::full, 50).by("full"));
  const Solved refused = by(rung::exact, 50);
  CHECK(refused.refusal.code == Errc::not_applicable);
  CHECK(std::strcmp(refused.refusal.model, "exact") == 0);
  CHECK(refused.answer.columns.empty());
  CHECK(refused.answer.tried.size() == 1);
}

TEST_CASE("the first row of a heavy answer is the start to the bit, in the caller's axes", "[heavy]") {
  const Mat3<double> R = to_matrix(normalised(Quat<double>{0.9, 0.1, -0.2, 0.15}));
  const auto body = Body::make(R * stone.inertia().asDiagonal() * R.transpose(), 0.8, R * stone_centre, 9.80665, 0);
  const auto sleeper =
      Body::make(R * even_top.inertia().asDiagonal() * R.transpose(), 0.8, R * even_top.centre_of_mass(), 9.80665, 0);
  REQUIRE(body);
  REQUIRE(sleeper);
  Start start;
  start.state.angular_velocity = R * Vec3<double>(1, 2, 300);
  start.state.attitude = normalised(Quat<double>{0.3, -0.7, 0.2, 0.5});
  const Vec3<double> down = rotate<double>(conjugate(start.state.attitude), {0, 0, -1});
  start.state.down = down;
  for (const bool turning : {true, false})
    for (const int rung : {rung::exact, rung::series_2, rung::full}) {
      Question question;
      question.times = {0, 0.1};
      question.rung = rung;
      question.wants_attitude = turning;
      const auto scene = Scene::make(rung == rung::exact ? *sleeper : *body, start, question);
      REQUIRE(scene);
      const Solved made = solved(*scene);
      CAPTURE(rung, turning);
      REQUIRE(made.refusal.code == Errc::ok);
      const auto first = [&](const char* name) { return made.answer.find(name)->values; };
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(first("angular_velocity")[i] == start.state.angular_velocity[int(i)]);
        if (!turning) CHECK(first("down")[i] == down[int(i)]);
      }
      if (!turning) continue;
      const auto& q = start.state.attitude;
      const double given[] = {q.x, q.y, q.z, q.w};
      for (std::size_t i = 0; i < 4; ++i) CHECK(first("attitude")[i] == given[i]);
    }
}

TEST_CASE("a heavy body that hardly moves is answered", "[heavy]") {
  State<double> hanging;
  hanging.down = {1e-9, 0, 1};
  Question question;
  question.tolerance = 1e-9;
  const auto p = Problem<double>::make({1, 1.2, 1.5}, 1, {0, 0, 0.01}, 100, 0).value();
  const Solved made = solved(posed(p, hanging, 30, question));
  CHECK(made.answer.met);
  CHECK(made.answer.find("angular_velocity")->scale == Approx(std::sqrt(1 / 1.5)));
}

TEST_CASE("a motion so long that no double holds its phase is refused at once", "[heavy]") {
  State<double> start;
  start.angular_velocity = {1, 2, 300};
  start.down = {0.6, 0, 0.8};
  const Solved made = solved(posed(stone, start, 1e9, {}));
  CHECK(made.refusal.code == Errc::step_limit);
  CHECK(std::string_view(made.refusal.why) == phase_lost);
}

TEST_CASE("a heavy answer is in the caller's axes and ends when cancelled", "[heavy]") {
  Tops random(4);
  const Mat3<double> R = to_matrix(normalised(Quat<double>{0.9, 0.1, -0.2, 0.15}));
  const auto& I = stone.inertia();
  const auto body = Body::make(R * I.asDiagonal() * R.transpose(), 0.8, R * stone_centre, 9.80665, 4.6e-6);
  REQUIRE(body);
  Question question;
  const Start start{{}, Periodic{150, 0.1}};
  question.times = {0, 0.1};
  const auto scene = Scene::make(*body, start, question);
  REQUIRE(scene);
  const auto turned = solved(*scene).answer, plain = solved(posed(stone, start, 0.1, question, 1)).answer;
  const auto vector = [](const Answer& answer, std::size_t k) {
    const double* v = &answer.find("down")->values[3 * k];
    return Vec3<double>(v[0], v[1], v[2]);
  };
  CHECK((vector(turned, 1) - R * vector(plain, 0)).norm() < 1e-6);

  Monitor monitor;
  monitor.cancel = true;
  const Solved stopped = solved(posed(stone, random.start(50), 100, {}), &monitor);
  CHECK(stopped.refusal.code == Errc::cancelled);
}

TEST_CASE("of two periodic motions with one spin and inclination every tolerance gives the same", "[heavy]") {
  const auto body = Problem<double>::make({0.21447220887664814, 0.08085594585809386, 0.2144722089216924}, 1,
                                          {0, 0.041439691240659625, -0.024197330077693723}, 9.80665, 0);
  REQUIRE(body);
  double period = 0;
  for (const double tolerance : {1e-3, 1e-6, 1e-8, 1e-10}) {
    const Solved made = solved(periodic(*body, 4.508929291625993, 0.07921321335229115, 0.5, tolerance));
    REQUIRE(made.refusal.code == Errc::ok);
    CHECK(made.answer.warns("not-unique"));
    const double found = made.scalar("period")->values[0];
    if (period > 0) CHECK(found == period);
    period = found;
  }
  // a series answers where it is asked for, and says so; a motion that is alone has no such warning
  CHECK(solved(periodic(*body, 4.508929291625993, 0.07921321335229115, 0.5, 1e-6, rung::series))
            .answer.warns("not-unique"));
  CHECK_FALSE(solved(periodic(stone, 150, 0.1, 3)).answer.warns("not-unique"));
}
