// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/exact_rung.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "gyrostat/core/double_double.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/full_rung.hpp"
#include "gyrostat/models/free/motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;

Scene scene_of(const V& inertia, const V& centre, double gradient, const State<double>& start, bool turning,
               const Mat3<double>& R = Mat3<double>::Identity(), double tolerance = 1e-13) {
  const auto body = Body::make(R * inertia.asDiagonal() * R.transpose(), 0.5, R * centre, 9.80665, gradient);
  REQUIRE(body);
  Question question;
  question.times = {0.0, 0.2, 1.0, 3.0};
  question.wants_attitude = turning;
  question.tolerance = tolerance;
  const auto made = Scene::make(*body, {start}, question);
  REQUIRE(made);
  return *made;
}

State<double> start(const V& omega, const Quat<double>& q) {
  const auto unit = normalised(q);
  return {omega, rotate<double>(conjugate(unit), V(0, 0, -1)), unit};
}

}  // namespace

TEST_CASE("heavy exact rung: without torque a tensor answers for itself", "[heavy]") {
  // a sphere but for roundings, which turn its axes as they please and let the rates drift
  Mat3<double> J;
  J << 1.5276172757148749, 4.2469731653849054e-16, 1.5779743266068923e-16,  //
      4.2469731653849054e-16, 1.5276172757148749, -4.2496418380388664e-16,  //
      1.5779743266068923e-16, -4.2496418380388664e-16, 1.5276172757148749;
  const Mat3<double> slim = to_matrix<double>(normalised(Quat<double>{0.2, -0.5, 0.7, 0.4}));
  for (const bool sphere : {true, false}) {
    const Mat3<double> inertia = sphere ? J : Mat3<double>(slim * V(1, 0.999, 0.002).asDiagonal() * slim.transpose());
    const V w =
        sphere ? V(0.00011839820181059967, -0.072026448393569142, 0.1968009676702592) : V(slim * V(0.3, 1, -40));
    for (const bool turning : {true, false}) {
      CAPTURE(sphere, turning);
      const auto body = Body::make(inertia, 3.1, {0, 0, 0}, 9.8, 0);
      REQUIRE(body);
      Question question;
      question.times = sphere ? std::vector<double>{62.2, 405.0, 2124.9} : std::vector<double>{1, 10, 30};
      question.wants_attitude = turning;
      const auto scene = Scene::make(*body, {start(w, {0.01, 0.63, -0.65, 0.43})}, question);
      REQUIRE(scene);
      const Track track = exact_track(*scene, nullptr);
      free::Problem<DoubleDouble> given;
      given.inertia = ((inertia + inertia.transpose()) / 2).cast<DoubleDouble>();
      given.angular_velocity = w.cast<DoubleDouble>();
      const auto truth = free::Motion<DoubleDouble>::make<DoubleDouble>(given);
      REQUIRE(truth);
      double off = 0, size = 0;
      for (std::size_t i = 0; i < track.states.size(); ++i) {
        const V right = vector_cast<double>(truth->at(question.times[i]).angular_velocity);
        off = std::max(off, (scene->R_BP() * track.states[i].angular_velocity - right).norm());
        size = std::max(size, right.norm());
      }
      CHECK(off <= track.error[column::angular_velocity] * size);
      CHECK(track.error[column::angular_velocity] < 1e-11);
    }
  }
}

TEST_CASE("heavy exact rung: agrees with the full equations within both estimates", "[heavy]") {
  const auto from = start({1, 2, 60}, {0.5, 0.1, -0.7, 0.3});
  const State<double> flat{{0, 0, 4}, {0.6, 0.8, 0}, {}};
  const Scene scenes[] = {scene_of({0.0011, 0.0016, 0.002}, {0, 0, 0}, 0, from, true),
                          scene_of({0.002, 0.002, 0.001}, {0, 0, 0.03}, 0, from, true),
                          scene_of({0.002, 0.001, 0.002}, {0, 0.03, 0}, 30, from, true),
                          scene_of({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 0, flat, false)};
  for (const Scene& scene : scenes) {
    const auto exact = exact_track(scene, nullptr);
    const auto full = full_track(scene, nullptr);
    REQUIRE(exact.failure == Errc::ok);
    REQUIRE(full.failure == Errc::ok);
    CHECK(exact.in_domain);
    const bool turning = scene.question().wants_attitude;
    Comparison apart(Row<double>{});
    for (std::size_t i = 0; i < exact.states.size(); ++i) {
      auto other = full.states[i];
      if (!turning) other.attitude = exact.states[i].attitude;
      apart.add(exact.states[i], other);
    }
    const auto off = apart.relative(apart.difference());
    CHECK(off[column::angular_velocity] <=
          exact.error[column::angular_velocity] + full.error[column::angular_velocity]);
    CHECK(off[column::down] <= exact.error[column::down] + full.error[column::down]);
    if (turning) CHECK(off[column::attitude] <= exact.error[column::attitude] + full.error[column::attitude]);
    CHECK(exact.error.greatest() < 1e-10);
  }
  const auto pendulum = periodicity_from(scenes[3].problem(), scenes[3].start());
  CHECK(pendulum.period > 0);
  CHECK(pendulum.period_error < 1e-12);
  const auto top = periodicity_from(scenes[1].problem(), scenes[1].start());
  CHECK(std::isnan(top.period));
  CHECK(std::abs(top.precession) > 0);
  CHECK(top.precession_error < 1e-11);
}

TEST_CASE("heavy exact rung: where the bound misses what is asked neighbours tell more sharply, and do not lie",
          "[heavy]") {
  using Long = long double;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> ratios;
  int sharper = 0;
  for (int i = 0; i < 200; ++i) {
    const bool top = i % 2 == 0;
    const double A = 0.0016 + 0.0004 * any(random), C = 0.0015 + 0.0003 * any(random);
    const V inertia = top ? V(A, A, C) : V(A, 0.0018, C), centre = top ? V(0, 0, 0.02) : V(0.01, 0.02, 0);
    const double gradient = i % 4 < 2 ? 0 : 10 + 9 * any(random), angle = 3 * any(random);
    State<double> from;
    from.angular_velocity = top ? V(5 * any(random), 5 * any(random), 60 * any(random)) : V(0, 0, 40 * any(random));
    from.down = top ? V(any(random), any(random), any(random)).normalized() : V(std::cos(angle), std::sin(angle), 0);
    const auto told = [&](double tolerance) {
      return exact_track(scene_of(inertia, centre, gradient, from, false, Mat3<double>::Identity(), tolerance),
                         nullptr);
    };
    const auto wide = told(1e-2), fine = told(1e-16);
    if (wide.failure != Errc::ok || !wide.in_domain) continue;
    const auto body = Problem<Long>::make(inertia.cast<Long>(), 0.5L, centre.cast<Long>(), Long(9.80665), gradient);
    REQUIRE(body);
    const Exact<Long> truth(*body, {from.angular_velocity.cast<Long>(), from.down.cast<Long>(), {}});
    const double times[] = {0.0, 0.2, 1.0, 3.0};
    Comparison apart(Row<double>{});
    for (std::size_t k = 0; k < 4; ++k) {
      const auto right = truth.at(times[k]);
      apart.add(fine.states[k],
                {right.angular_velocity.cast<double>(), right.down.cast<double>(), fine.states[k].attitude});
    }
    const auto off = apart.relative(apart.difference());
    for (const auto c : {column::angular_velocity, column::down}) {
      CAPTURE(i, top, gradient, c);
      CHECK(off[c] <= fine.error[c]);
      CHECK(fine.error[c] <= wide.error[c]);
      sharper += fine.error[c] < wide.error[c] / 4;
      if (off[c] > 0) ratios.push_back(fine.error[c] / off[c]);
    }
  }
  REQUIRE(ratios.size() >= 250);
  std::sort(ratios.begin(), ratios.end());
  CHECK(ratios[ratios.size() / 2] < 40);
  CHECK(sharper > 200);
}

TEST_CASE(
    "heavy exact rung: neighbours of a pendulum are compared where it passes its lowest place, not where it all but "
    "rests",
    "[heavy]") {
  using Long = long double;
  const V inertia(0.45355331273386273, 0.4, 0.45355331273386273), centre(0, 1.0065992989507713, 0.298398628204535);
  const double mass = 0.14716373210160236;
  const auto body = Body::make(inertia.asDiagonal(), mass, centre, 9.80665, 0);
  REQUIRE(body);
  State<double> from;
  from.angular_velocity = {-0.0003587512102505113, 0, 0};
  from.down = {0, -0.9588157398272741, -0.28402883138772567};
  Question question;
  question.tolerance = 1e-7;
  for (int i = 0; i <= 37; ++i) question.times.push_back(29.474334205841032 * i);
  const auto scene = Scene::make(*body, {from}, question);
  REQUIRE(scene);
  const auto told = exact_track(*scene, nullptr);
  REQUIRE(told.failure == Errc::ok);
  const auto longer = Problem<Long>::make(inertia.cast<Long>(), Long(mass), centre.cast<Long>(), Long(9.80665), 0);
  REQUIRE(longer);
  const Exact<Long> truth(*longer, {from.angular_velocity.cast<Long>(), from.down.cast<Long>(), {}});
  Comparison apart(Row<double>{});
  for (std::size_t i = 0; i < question.times.size(); ++i) {
    const auto right = truth.at(Long(question.times[i]));
    apart.add(told.states[i],
              {right.angular_velocity.cast<double>(), right.down.cast<double>(), told.states[i].attitude});
  }
  const auto off = apart.relative(apart.difference());
  CHECK(off[column::down] > 1e-7);
  CHECK(off[column::down] <= told.error[column::down]);
  CHECK(off[column::angular_velocity] <= told.error[column::angular_velocity]);
}

TEST_CASE("heavy exact rung: a pendulum whose attitude is given stays in the plane that its zeros name", "[heavy]") {
  using Long = long double;
  const V inertia(0.875, 0.914, 0.0954), centre(0, 0, 0.43);
  const auto body = Body::make(inertia.asDiagonal(), 4.3, centre, 9.80665, 0);
  const auto longer = Problem<Long>::make(inertia.cast<Long>(), Long(4.3), centre.cast<Long>(), Long(9.80665), 0);
  REQUIRE((body && longer));
  for (const double angle : {-2.6, -0.5, 0.7, 3.0}) {
    CAPTURE(angle);
    Question question;
    question.times = {1, 17, 60};
    question.wants_attitude = true;
    const auto from = start({0, 0, 0}, {std::cos(angle / 2), std::sin(angle / 2), 0, 0});
    const auto scene = Scene::make(*body, {from}, question);
    REQUIRE(scene);
    const Track told = exact_track(*scene, nullptr);
    REQUIRE(told.failure == Errc::ok);
    CHECK(told.error[column::attitude] < 1e-10);
    const auto given = scene->given().attitude;
    const Quat<Long> turn = normalised(Quat<Long>{given.w, given.x, given.y, given.z});
    const Exact<Long> truth(*longer, {V::Zero().cast<Long>(), rotate<Long>(conjugate(turn), {0, 0, -1}), turn});
    Comparison apart(Row<double>{});
    for (std::size_t i = 0; i < question.times.size(); ++i) {
      const auto right = truth.at(Long(question.times[i]));
      const auto& q = right.attitude;
      apart.add(told.states[i], {right.angular_velocity.cast<double>(),
                                 right.down.cast<double>(),
                                 {double(q.w), double(q.x), double(q.y), double(q.z)}});
    }
    const auto off = apart.relative(apart.difference());
    for (const std::size_t c : {column::down, column::angular_velocity, column::attitude})
      CHECK(off[c] <= told.error[c]);
  }
}

TEST_CASE("heavy exact rung: what cancels is no zero of the data", "[heavy]") {
  const auto p = Problem<double>::make({0.875, 0.914, 0.0954}, 4.3, {0, 0, 0.43}, 9.80665, 0);
  REQUIRE(p);
  const Quat<double> roll{std::cos(0.35), std::sin(0.35), 0, 0}, yaw{std::cos(0.8), 0, 0, std::sin(0.8)};
  for (const auto& [turn, sure] : {std::pair(roll, true), {yaw * roll, false}}) {
    auto from = start({0, 0, 0}, turn);
    from.down[0] = 0;  // as products may come to that cancel
    const auto swing = Pendulum<double>::make(*p, from);
    REQUIRE(swing);
    CHECK(swing->in_plane() == sure);
  }
}

namespace {

struct Judged {
  ColumnErrors<double> off, stated;  ///< off: of rates and down alone
};

/// The rung by itself at 1e-14 against the full equations in long double. The body's tensor is diagonal.
Judged judged(const V& inertia, double mass, const V& centre, double gravity, double gradient,
              const State<double>& from, const std::vector<double>& times) {
  using Long = long double;
  const auto body = Body::make(inertia.asDiagonal(), mass, centre, gravity, gradient);
  REQUIRE(body);
  Question question;
  question.times = times;
  question.tolerance = 1e-14;
  const auto scene = Scene::make(*body, {from}, question);
  REQUIRE(scene);
  const Track track = exact_track(*scene, nullptr);
  REQUIRE(track.failure == Errc::ok);
  const auto problem = Problem<Long>::make(inertia.cast<Long>(), mass, centre.cast<Long>(), gravity, gradient);
  REQUIRE(problem);
  FullMotionOptions<Long> options;
  options.tolerance = 1e-17L;
  std::vector<State<Long>> states(times.size());
  const std::vector<Long> asked(times.begin(), times.end());
  const State<Long> wide{from.angular_velocity.cast<Long>(), from.down.cast<Long>().normalized(), {}};
  REQUIRE(full_motion<Long>(*problem, wide, asked, states, options));
  Comparison apart(row_of(*scene));
  for (std::size_t k = 0; k < times.size(); ++k)
    apart.add(track.states[k],
              {states[k].angular_velocity.cast<double>(), states[k].down.cast<double>(), track.states[k].attitude});
  return {apart.relative(apart.difference()), track.error};
}

}  // namespace

TEST_CASE("heavy exact rung: a body that is symmetric to rounding, past an upright rest in a gradient", "[heavy]") {
  // What the moments differ by grows along with what is off by rounding; neighbours, which are symmetric, show the latter alone.
  State<double> from;
  from.angular_velocity = V(0, 0.5263080030265859, 2.553751602494565e-16);
  from.down = V(0.23615990259398437, 0.0002479438067365645, -0.9717141655324291);
  std::vector<double> times;
  for (int i = 1; i <= 40; ++i) times.push_back(0.53041352295492938 * i);
  const V inertia(1.0000000000000024, 1.0000000000000049, 0.25362249705565504);
  const auto [off, stated] = judged(inertia, 1, V(0, 0, 0), 0, 0.3930821635550513, from, times);
  CHECK(off[column::down] > 1e-11);
  CHECK(off[column::down] <= stated[column::down]);
}

TEST_CASE("heavy exact rung: a gradient turns a sphere by what its moments differ by", "[heavy]") {
  State<double> from;
  from.angular_velocity = V(-0.021725210773352058, 0.01901921499672101, 0);
  from.down = V(-0.5454379854007949, -0.557327046445177, 0.62600636369179);
  const V inertia(896.9477557056609, 896.9477557056591, 896.94775570566), centre(0, 0, -0.2408238012217468);
  const auto [off, stated] = judged(inertia, 2.0172640743472274, centre, 0.07229048974319296, 2.5218151989450095, from,
                                    {99.91729293589793, 190.63631886372386});
  CHECK(off[column::down] > 5e-12);
  CHECK(off[column::down] <= stated[column::down]);
}

TEST_CASE("heavy exact rung: moments that differ by roundings turn a slow body, and the error says so", "[heavy]") {
  // The torque of the gradient about the axis grows with the square of the time; neighbours are as symmetric as the answer, and were all that was asked.
  const double ulp = epsilon<double>;
  for (const double differs : {1 * ulp, 3 * ulp, 12 * ulp})
    for (const double along : {1.5, 1.0000001}) {
      CAPTURE(differs, along);
      const V inertia(1 + differs, 1, along);
      const double gradient = 0.35;
      State<double> from;
      from.angular_velocity = V(-0.016, -0.0002, -0.0005), from.down = V(-0.458, -0.88, 0.124).normalized();
      const auto [off, stated] = judged(inertia, 1, V(0, 0, 0), 9.80665, gradient, from, {9.0, 150.0, 800.0});
      CHECK(off[column::down] <= stated[column::down]);
      CHECK(off[column::angular_velocity] <= stated[column::angular_velocity]);
      CHECK(stated[column::down] <= 1e3 * off[column::down]);
    }
}

TEST_CASE("heavy exact rung: in the caller's axes", "[heavy]") {
  const Mat3<double> R = to_matrix(normalised(Quat<double>{0.9, 0.2, -0.1, 0.05}));
  const auto from = start({1, 2, 30}, {0.5, 0.1, -0.7, 0.3});
  const auto track = exact_track(scene_of({0.0011, 0.0016, 0.002}, {0, 0, 0}, 0, from, true, R), nullptr);
  CHECK(track.failure == Errc::ok);
}

TEST_CASE("heavy exact rung: refuses, and says where rounding decides", "[heavy]") {
  const auto from = start({1, 2, 60}, {0.5, 0.1, -0.7, 0.3});
  const auto none = exact_track(scene_of({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 0, from, true), nullptr);
  CHECK(none.failure == Errc::not_applicable);
  CHECK(none.refusal != nullptr);
  // hanging, with just the speed that leads to standing: theta' = 2 c
  const double c = std::sqrt(0.5 * 9.80665 * 0.01 / 0.002);
  auto lost = scene_of({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 0, {{0, 0, 2 * c}, {1, 0, 0}, {}}, false);
  auto question = lost.question();
  question.times.back() = 30;
  const auto body = Body::make(V(0.0011, 0.0016, 0.002).asDiagonal(), 0.5, {0.01, 0, 0}, 9.80665, 0);
  const auto track = exact_track(*Scene::make(*body, {{{0, 0, 2 * c}, {1, 0, 0}, {}}}, question), nullptr);
  CHECK(track.failure == Errc::ok);
  CHECK_FALSE(track.in_domain);
  CHECK(track.warnings.size() == 1);
  CHECK(exact_track(*Scene::make(*body, {from, Periodic{50, 0.1}}, question), nullptr).failure == Errc::not_applicable);
}
