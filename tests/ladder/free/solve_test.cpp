// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/solve.hpp"

#include <array>
#include <string_view>
#include <vector>

#include "../../models/free/gyrostats.hpp"
#include "gyrostat/models/free/averages.hpp"
#include "gyrostat/models/free/view.hpp"
#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("whichever rung answers about a free body is honest", "[free]") {
  free_bodies::Bodies bodies(41);
  int by_form = 0;
  for (const auto regime : free_bodies::regimes)
    for (int i = 0; i < 12; ++i)
      for (const double tolerance : {1e-2, 1e-6, 1e-10}) {
        Assembly<double> assembly;
        assembly.body = bodies.of(regime, i);
        const double end = std::pow(10, bodies.uniform(-1, 3));
        const Scene scene = posed(assembly, {0.3 * end, 0.99 * end, end}, tolerance);
        const Answer answer = solved(scene);
        CAPTURE(free_bodies::name(regime), i, tolerance, end);
        if (answer.find("attitude")->error < 0.05) check_honest(scene, answer);
        by_form += std::string_view(answer.model) == "closed-form";
      }
  CHECK(by_form > 100);
}

TEST_CASE("the scalars of a free motion: Toutatis as Hudson and Ostro (1995) saw it", "[free]") {
  constexpr double day = 86400, degree = pi<double> / 180;
  auto assembly = body({3.22, 3.09, 1}, {0, 0, 0}, Vec3<double>(20.7, 31.3, 98.0) * degree / day);
  assembly.body.attitude = {};
  Question question;
  question.times = {30 * day};
  question.rung = free::rung::closed_form;
  const auto scene = Scene::make(assembly, question);
  const Answer answer = solved(*scene->viewed(free::ViewRequest{{0, 0, 1}, {1, 0, 0}, pi<double> / 6}));
  const auto value = [&](const char* name) { return answer.quantity(name)->values[0]; };
  CHECK(free::kind_words[std::size_t(value("kind"))] == std::string_view("about-smallest"));
  CHECK(2 * pi<double> / value("spin_rate") / day == Approx(5.367).epsilon(1e-3));
  CHECK(2 * pi<double> / value("precession_rate") / day == Approx(7.420).epsilon(1e-3));
  CHECK(value("flip_interval") == Approx(value("period") / 2));
  CHECK((value("view_fraction") > 0 && value("view_fraction") < 1));
  CHECK(answer.quantity("period")->error < 1e-13);
}

TEST_CASE("what a wheel leaves of the momentum is known to its roundings, whichever rung answers", "[free]") {
  // 0.7 * 1 - 0.0007 * 1000 of these doubles is -3.72966e-17
  auto assembly = body({0.5, 0.7, 1}, {0, 0, 0}, {0, 1, 0});
  assembly.body.attitude = {};
  assembly.wheels.push_back({{0, 1, 0}, 0.0007, -1000, false});
  for (const int rung : {free::rung::closed_form, free::rung::full}) {
    Question question;
    question.times = {1.0};
    question.rung = rung;
    const Answer answer = solved(*Scene::make(assembly, question));
    const Column& M = *answer.find("angular_momentum");
    CAPTURE(rung, M.values[1], M.error, M.scale);
    CHECK(std::abs(M.values[1] - -3.72966e-17) <= M.error * std::max(M.scale, std::abs(M.values[1])));
    CHECK(M.error < 1e-11);
  }
}

TEST_CASE("a dual-spin satellite precesses regularly: in closed form, with the rates of its axis", "[free]") {
  auto assembly = body({120, 120, 90}, {0, 0, 0}, {0.05, -0.02, 0.3});
  assembly.body.attitude = {};
  assembly.wheels.push_back({{0, 0, 1}, 2.5, 40, true});
  Question question;
  for (int i = 0; i <= 480; ++i) question.times.push_back(0.25 * i);
  question.tolerance = 1e-9;
  const auto scene = Scene::make(assembly, question);
  const Answer answer = solved(*scene);
  CHECK(answer.model == std::string_view("closed-form"));
  check_honest(*scene, answer);
  const auto value = [&](const char* name) { return answer.quantity(name)->values[0]; };
  const double along = 87.5 * 0.3 + 2.5 * 40.3, spin = ((120 - 87.5) * 0.3 - 2.5 * 40.3) / 120;
  CHECK(value("precession_rate") == Approx(std::hypot(120 * 0.05, 120 * 0.02, along) / 120).epsilon(1e-14));
  CHECK(std::abs(value("spin_rate")) == Approx(std::abs(spin)).epsilon(1e-14));
  CHECK(value("period") == Approx(2 * pi<double> / std::abs(spin)).epsilon(1e-14));
  // in turned axes as well, where the moments are equal but for rounding
  const Quat<double> turn = normalised(Quat<double>{0.3, -0.5, 0.7, 0.2});
  const Mat3<double> R = to_matrix(turn);
  assembly.body.inertia = R * assembly.body.inertia * R.transpose();
  assembly.body.inertia = Mat3<double>((assembly.body.inertia + assembly.body.inertia.transpose()) / 2);
  assembly.body.angular_velocity = R * assembly.body.angular_velocity;
  assembly.wheels[0].axis = R.col(2);
  const auto askew = Scene::make(assembly, question);
  const Answer turned = solved(*askew);
  check_honest(*askew, turned);
  CHECK(turned.met);
  CHECK(turned.quantity("period")->values[0] == Approx(value("period")).epsilon(1e-13));
}

TEST_CASE(
    "rates of precession and spin are those of an axis that M surrounds, where rotors leave the principal axis outside",
    "[free]") {
  // truth: quadrature over the path of M, integrated with 34 digits
  Question question;
  question.times = {10};
  for (const auto place : {free::scalar::precession_rate, free::scalar::spin_rate, free::scalar::period})
    question.asked.push_back({place, true, 1e-6, false, false});
  const auto scene = Scene::make(body({2, 1.5, 1.2}, {0, .1, .2}, {1, 0, .02}), question);
  REQUIRE(scene);
  const Answer answer = solved(*scene);
  CHECK(answer.met);
  CHECK(answer.quantity("precession_rate")->values[0] == Approx(1.4558836).epsilon(1e-7));
  CHECK(answer.quantity("spin_rate")->values[0] == Approx(-0.4370267).epsilon(1e-6));
  CHECK(std::abs(answer.quantity("spin_rate")->values[0]) ==
        Approx(2 * pi<double> / answer.quantity("period")->values[0]).epsilon(1e-12));
}

TEST_CASE("a view of a motion that closes is stated within one over its periods", "[free]") {
  // spin 4 : precession 1, closed after one period: each time has but one azimuth about M, and the long run is a matter of where the motion began
  Question question;
  question.times = {100};
  question.rung = free::rung::closed_form;
  const auto scene = Scene::make(body({1, 1, 1.5}, {0, 0, 0}, {4, 0, 2}), question);
  const Answer answer = solved(*scene->viewed(free::ViewRequest{{1, 0, 0}, {0, .6, .8}, .4}));
  const Quantity& seen = *answer.quantity("view_fraction");
  CHECK(std::abs(seen.values[0] - 0.0661) <= seen.error);
  CHECK(seen.error == Approx(1));
}

TEST_CASE("the mean cosine of a view does not hang on the cone", "[free]") {
  Question question;
  question.times = {100};
  const auto scene = Scene::make(body({1, 2, 2.5}, {0, 0, 0}, {0, 0, .1}), question);
  REQUIRE(scene);
  const Answer answer = solved(*scene->viewed(free::ViewRequest{{0, 0, 1}, {1, 0, 0}, pi<double> / 2}));
  const Quantity& cosine = *answer.quantity("view_cosine");
  CHECK(std::abs(cosine.values[0]) <= cosine.error);
  CHECK(cosine.error < 1e-11);
  CHECK(answer.quantity("view_fraction")->error >= 0.5);  // it stands on the edge of the cone
}

TEST_CASE("the means, rates and views of a free motion state what a rounding of the data makes of them", "[free]") {
  free_bodies::Bodies bodies(77);
  int known = 0, told = 0;
  std::vector<double> ratios;
  for (const auto regime : free_bodies::regimes)
    for (int i = 0; i < 24; ++i) {
      const auto given = bodies.of(regime, i);
      Assembly<double> assembly;
      assembly.body = given;
      Question question;
      question.times = {std::pow(10, bodies.uniform(-1, 3))};
      question.tolerance = 1e-3;
      for (const auto place :
           {free::scalar::angular_momentum_inertial, free::scalar::mean_angular_velocity, free::scalar::precession_rate,
            free::scalar::spin_rate, free::scalar::view_fraction, free::scalar::view_cosine})
        question.asked.push_back({place, true, question.tolerance, false, false});
      const auto scene = Scene::make(assembly, question);
      if (!scene) continue;
      const free::ViewRequest view{bodies.vector().normalized(), bodies.vector().normalized(), bodies.uniform(0.1, 2)};
      Refusal refusal;
      const Answer answer = free::solve(*scene->viewed(view), refusal);
      // the motion of data a rounding away, set up to twice the digits
      auto moved = given;
      const auto move = [&](double& x) { x *= 1 + epsilon<double> * bodies.uniform(-1, 1); };
      for (int k = 0; k < 3; ++k)
        move(moved.inertia(k, k)), move(moved.rotor_momentum[k]), move(moved.angular_velocity[k]);
      const auto motion = free::Motion<double>::make<DoubleDouble>(moved.cast<DoubleDouble>());
      if (!motion) continue;
      const auto check = [&](const char* name, Vec3<double> truth) {
        const Quantity* q = answer.quantity(name);
        if (!q || std::isnan(q->values[0]) || std::isnan(truth[0])) return;
        ++told;
        if (std::isnan(q->error) || !(q->error < 1)) return;
        ++known;
        const Vec3<double> value(q->values[0], q->values[1], q->values[2]);
        const double unit = q->kind->measure == Measure::relative ? truth.norm() : 1;
        const double error = (value - truth).norm(), stated = q->error * unit;
        CAPTURE(free_bodies::name(regime), i, name, error * 1e15, stated * 1e15, value[0], truth[0]);
        CHECK(error <= stated);
        if (error > 0) ratios.push_back(stated / error);
      };
      check("angular_momentum_inertial", motion->inertial_momentum());
      check("mean_angular_velocity", free::averages(*motion).angular_velocity);
      const bool largest =
          regime == free_bodies::Regime::symmetric ? i % 2 : motion->kind() == free::Kind::about_largest;
      const int axis = largest ? 0 : 2;
      Vec3<double> about = motion->R_BP().col(axis);
      const Vec3<double> mean = free::averages(*motion).angular_momentum;
      auto turning = free::precession<double>(*motion, about);
      // beside rotors the axis may lie outside the path of M
      if (given.rotor_momentum.norm() > 0 && !(turning.converged && turning.about_axis != 0))
        about = mean.normalized(), turning = free::precession<double>(*motion, about);
      if (turning.converged) {
        // of the axis in the sense of M
        const double along = about.dot(mean);
        check("spin_rate", {std::copysign(turning.about_axis, turning.about_axis * along), 0, 0});
        check("precession_rate", {turning.about_momentum, 0, 0});
      }
      const auto seen = free::long_run_view(*motion, view.axis, view.direction, view.half_angle);
      check("view_fraction", {seen.fraction, 0, 0});
      check("view_cosine", {seen.mean_cosine, 0, 0});
    }
  std::sort(ratios.begin(), ratios.end());
  CAPTURE(known, told, ratios[ratios.size() / 2]);
  CHECK(known > 0.8 * told);
  CHECK(ratios[ratios.size() / 2] < 1e3);
}

TEST_CASE("the modulus of a permanent rotation is 0, of an unstable one 1", "[free]") {
  for (const auto& [w, k2] :
       {std::pair(Vec3<double>(1, 0, 0), 0.), {Vec3<double>(0, 1, 0), 1.}, {Vec3<double>(0, 0, 1), 0.}}) {
    const Answer answer = solved(posed(body({3, 2, 1.5}, {0, 0, 0}, w), {2}));
    CHECK(answer.quantity("modulus_squared")->values[0] == k2);
  }
}

TEST_CASE("an answer beside a separatrix says so, whichever rung gives it", "[free]") {
  for (const int named : {any_rung, int(free::rung::closed_form), int(free::rung::full)}) {
    const Answer answer = solved(posed(body({3, 2, 1.5}, {0, 0, 0}, {1e-5, 1, 1e-5}), {2}, 1e-6, named));
    CAPTURE(named, answer.model);
    REQUIRE(answer.warnings.size() == 1);
    CHECK(answer.warnings[0].code() == "near-separatrix");
  }
}

TEST_CASE("rest, a sphere and a steady rotation have their answers", "[free]") {
  const Answer rest = solved(posed(body({3, 2, 1.5}, {0, 0, 0}, {0, 0, 0}), {0, 5}));
  CHECK(rest.met);
  for (const double x : rest.find("angular_velocity")->values) CHECK(x == 0);
  const Scene round = posed(body({2, 2, 2}, {0.1, 0.2, 0.3}, {1, 0, 0}), {1, 50}, 1e-9);
  check_honest(round, solved(round));
  const Scene steady = posed(body({3, 2, 1.5}, {0.1, 0, 0}, {1, 0, 0}), {1, 50}, 1e-9);
  const Answer turning = solved(steady);
  CHECK(turning.met);
  check_honest(steady, turning);
}

TEST_CASE("answers to free bodies side by side are those of the ladder, to the bit", "[free]") {
  free_bodies::Bodies bodies(42);
  std::array<Answer, free::SweepSolver::width> answers;  // used again and again
  int together = 0, all = 0;
  for (int batch = 0; batch < 60; ++batch) {
    std::vector<Scene> scenes;
    for (int i = 0; i < 1 + batch % int(answers.size()); ++i) {
      Assembly<double> assembly;
      assembly.body = bodies.of(free_bodies::regimes[(batch + i) % 10], i);
      if (i % 4 == 3) assembly.wheels = {{{0, 0.6, 0.8}, 0.02, 5, false}, {{1, 0, 0}, 0.01, -9, true}};
      Question question;
      const double end = bodies.scale(-1, 3);
      question.times = {0, end / 3, end};
      question.asked = {{free::column::attitude}, {free::column::rotor_rate, false, 1e-3}};
      if (i % 3 == 0) question.asked = {{free::column::angular_velocity, false, 1e-9, true}};
      if (i % 5 == 0) question.asked = {};
      if (i == 6) question.rung = free::rung::closed_form;
      if (const auto scene = Scene::make(assembly, question)) scenes.push_back(*scene);
    }
    const unsigned answered = free::SweepSolver{}.together(scenes, answers);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      ++all;
      if (!(answered >> i & 1)) continue;
      ++together;
      CAPTURE(batch, i);
      const Answer alone = solved(scenes[i]);
      CHECK(answers[i].model == std::string_view(alone.model));
      CHECK((answers[i].met && alone.met));
      CHECK(answers[i].excess == alone.excess);
      CHECK(answers[i].error == alone.error);
      CHECK((answers[i].warnings.empty() && alone.warnings.empty()));
      CHECK((answers[i].quantities.empty() && alone.quantities.empty()));
      CHECK(answers[i].times == alone.times);
      REQUIRE(answers[i].columns.size() == alone.columns.size());
      for (std::size_t c = 0; c < alone.columns.size(); ++c) {
        CHECK(answers[i].columns[c].kind == alone.columns[c].kind);
        CHECK(answers[i].columns[c].values == alone.columns[c].values);
        CHECK(answers[i].columns[c].error == alone.columns[c].error);
        CHECK(answers[i].columns[c].tolerance == alone.columns[c].tolerance);
        CHECK(answers[i].columns[c].width == alone.columns[c].width);
      }
    }
  }
  CHECK(together > (math::many_pays ? all / 8 : -1));
  CHECK(free::SweepSolver{}.together({}, answers) == 0);
}

TEST_CASE("a view along no direction of unit length, or by an angle that none has, is refused", "[free]") {
  Question question;
  question.times = {1};
  const auto scene = *Scene::make(body({1, 2, 2.5}, {0, 0, 0}, {0.01, 1, 0.01}), question);
  const auto refused = [&](const free::ViewRequest& view) { return scene.viewed(view).error(); };
  CHECK(refused({{0, 0, 1}, {1, 0, 0}, 0.4}) == Errc::ok);
  CHECK(refused({{0, 0, 2}, {1, 0, 0}, 0.4}) == Errc::out_of_domain);
  CHECK(refused({{0, 0, 1}, {0, 0, 0}, 0.4}) == Errc::zero_vector);
  CHECK(refused({{0, 0, 1}, {1, 0, 0}, 4}) == Errc::out_of_domain);
  CHECK(refused({{0, 0, 1}, {1, 0, 0}, -0.1}) == Errc::out_of_domain);
  CHECK(refused({{0, 0, 1}, {1, 0, 0}, gyrostat::nan<double>}) == Errc::not_finite);
}
