// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rung.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

/// A ladder of four invented rungs over a scene of their errors.
struct Scene {
  std::array<double, 4> error;
  std::array<Errc, 4> failure{};
  std::array<bool, 4> in_domain{true, true, true, true};
  mutable int looked_at = 0;
  Question its_question{};
  double value = 1;  ///< of the column, its size
  std::array<double, 4> cost{1, 2, 3, 4};
  const Question& question() const { return its_question; }
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.its_question = question;
    return other;
  }
};
struct Track {
  Errc failure;
  const char* refusal;
  double known_error;
  bool in_domain;
  double error;
};
constexpr ColumnKind rung_columns[] = {{"number", 1, "m", Frame::none, Measure::relative, ""},
                                       {"vector", 3, "m", Frame::body, Measure::relative, ""}};
constexpr ScalarKind rung_scalars[] = {{"period", 1, "s", Frame::none, Measure::relative, ""}};
void fill(Answer& answer, const Scene& scene, const Track& track) {
  answer.columns.push_back({&rung_columns[0], {scene.value}, track.error});
}
void describe(Answer& answer, const Scene&, const Track& track) {
  answer.counts.steps = std::uint64_t(track.error * 1e9);
  answer.quantities.push_back({&rung_scalars[0], {3}, 10 * track.error});
}

template <std::size_t i>
Track answer(const Scene& scene, Monitor*) {
  ++scene.looked_at;
  return {scene.failure[i], scene.failure[i] == Errc::ok ? nullptr : "it does not apply", gyrostat::nan<double>,
          scene.in_domain[i], scene.error[i]};
}

constexpr RungKind names[] = {{"first", "", column_set(1U)}, {"second", ""}, {"third", ""}, {"fourth", ""}};
constexpr Family rung_family{"invented", rung_columns, rung_scalars, {}, names, {}, column_set(1U)};
template <std::size_t i>
double cost(const Scene& scene) noexcept {
  return scene.cost[i];
}
constexpr Rung<Scene, Track> ladder[] = {
    {&answer<0>, &cost<0>}, {&answer<1>, &cost<1>}, {&answer<2>, &cost<2>}, {&answer<3>, &cost<3>}};

struct Climb {
  Answer answer;
  Refusal refusal;
  int looked_at;

  explicit Climb(Scene scene, double tolerance, int only = any_rung) {
    scene.its_question.tolerance = tolerance;
    scene.its_question.rung = only;
    answer = climb<Scene, Track>(rung_family, ladder, scene, nullptr, refusal);
    looked_at = scene.looked_at;
  }
  bool is(const char* model) const { return std::strcmp(answer.model, model) == 0; }
};

}  // namespace

TEST_CASE("the climb ends at the first rung that meets the tolerance", "[ladder]") {
  const Scene scene{{1e-2, 1e-4, 1e-6, 1e-8}};
  const Climb coarse(scene, 1e-1), middle(scene, 1e-4), fine(scene, 1e-7);
  CHECK(coarse.is("first"));
  CHECK(coarse.looked_at == 1);
  CHECK(middle.is("second"));
  CHECK(fine.is("fourth"));
  for (const Climb* c : {&coarse, &middle, &fine}) {
    CHECK(c->answer.met);
    CHECK(c->refusal.code == Errc::ok);
    CHECK(c->answer.tried.size() == std::size_t(c->looked_at));
    for (const Attempt& a : c->answer.tried) CHECK(a.accepted == (std::strcmp(a.model, c->answer.model) == 0));
  }
  CHECK(fine.answer.tried[1].error == 1e-4);
  CHECK(fine.answer.tolerance == 1e-7);
  CHECK(fine.answer.counts.steps == 10);  // described by the track that answers
}

TEST_CASE("no rung meets the tolerance: the most accurate answers and says so", "[ladder]") {
  const Climb c(Scene{{1e-2, 1e-6, 1e-4, 1e-3}}, 1e-9);
  CHECK(c.is("second"));
  CHECK_FALSE(c.answer.met);
  CHECK(c.refusal.code == Errc::ok);
  CHECK(c.answer.tried.size() == 4);
  CHECK(c.answer.tried[1].accepted);
  CHECK_FALSE(c.answer.tried[3].accepted);
}

TEST_CASE("where no rung knows its error the highest answers, whatever it costs", "[ladder]") {
  constexpr double unknown = infinity<double>;
  Scene scene{{unknown, unknown, unknown, unknown}};
  CHECK(Climb(scene, 1e-3).is("fourth"));
  scene.cost = {4, 3, 2, 1};
  CHECK(Climb(scene, 1e-3).is("fourth"));
  scene.error[1] = 0.5;
  CHECK(Climb(scene, 1e-3).is("second"));
}

TEST_CASE("one attempt is accepted, the one that the answer is from", "[ladder]") {
  const auto accepted = [](const Answer& answer) {
    return std::count_if(answer.tried.begin(), answer.tried.end(), [](const Attempt& a) { return a.accepted; });
  };
  constexpr double unknown = gyrostat::nan<double>;
  const Climb named(Scene{{unknown, unknown, unknown, unknown}}, 1e-3, 2);
  CHECK(named.is("third"));
  CHECK(accepted(named.answer) == 1);
  // rungs that are left out stand before those that were asked
  Scene scene{{1e-2, 1e-4, 1e-6, 1e-8}};
  scene.cost = {1, 2, 300, 1};
  const Climb c(scene, 1e-7);
  CHECK(c.is("fourth"));
  CHECK(accepted(c.answer) == 1);
  CHECK(c.answer.tried.back().accepted);
}

TEST_CASE("where no rung can answer the highest says why, in whatever order they are asked", "[ladder]") {
  Scene scene{{}};
  scene.failure.fill(Errc::step_limit);
  for (const auto& cost : {std::array<double, 4>{1, 2, 3, 4}, {4, 3, 2, 1}, {2, 1, 4, 3}}) {
    scene.cost = cost;
    const Climb c(scene, 1e-3);
    CHECK(c.looked_at == 4);
    CHECK(std::strcmp(c.refusal.model, "fourth") == 0);
  }
}

TEST_CASE("rungs are asked in the order of what they predict to cost", "[ladder]") {
  Scene scene{{1e-2, 1e-9, 1e-9, 1e-9}};
  scene.cost = {5, 2, 0.5, 0.9};
  const Climb c(scene, 1e-4);
  CHECK(c.is("third"));
  CHECK(c.looked_at == 1);
  REQUIRE(c.answer.tried.size() == 3);  // the fourth stands behind the one that answers
  CHECK((c.answer.tried[2].accepted && c.answer.tried[2].predicted == 0.5 && c.answer.tried[2].spent > 0));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(c.answer.tried[i].model == names[i].name);
    CHECK(std::string_view(c.answer.tried[i].why) == costs_more);
    CHECK((c.answer.tried[i].predicted == scene.cost[i] && c.answer.tried[i].spent == 0));
    CHECK(std::isnan(c.answer.tried[i].error));
  }
  scene.cost[2] = 1.5;  // no clear difference from the second: the table decides
  CHECK(Climb(scene, 1e-4).is("second"));
  scene.cost[2] = 0.5;
  scene.error[2] = scene.error[3] = 1e-3;
  const Climb on(scene, 1e-4);
  CHECK(on.is("second"));
  CHECK(on.looked_at == 3);
  CHECK(Climb(scene, 1e-12).looked_at == 4);
  CHECK(Climb(scene, 1e-4, 0).is("first"));  // by name
}

TEST_CASE("rungs that do not apply are passed over with their reason", "[ladder]") {
  const Climb c(Scene{{1e-9, 1e-9, 1e-9, 1e-9}, {Errc::not_applicable, Errc::separatrix, Errc::ok, Errc::ok}}, 1e-3);
  CHECK(c.is("third"));
  CHECK(c.answer.met);
  REQUIRE(c.answer.tried.size() == 3);
  CHECK(std::strcmp(c.answer.tried[0].why, "it does not apply") == 0);
  CHECK(std::isnan(c.answer.tried[1].error));
  CHECK(c.answer.tried[2].why == nullptr);

  const auto no = Errc::not_applicable;
  const Climb none(Scene{{0, 0, 0, 0}, {no, no, no, Errc::step_limit}}, 1e-3);
  CHECK(none.refusal.code == Errc::step_limit);
  CHECK(std::strcmp(none.refusal.model, "fourth") == 0);
  CHECK(none.answer.tried.size() == 4);
  CHECK_FALSE(none.answer.met);
}

TEST_CASE("where no rung knows its cost the climb says that it has no answer", "[ladder]") {
  Scene scene{{0, 0, 0, 0}};
  scene.cost.fill(gyrostat::nan<double>);
  const Climb c(scene, 1e-3);
  CHECK(c.looked_at == 0);
  CHECK(c.refusal.code == Errc::not_applicable);
  CHECK(Climb(scene, 1e-3, 2).is("third"));  // by name
}

TEST_CASE("outside its domain a rung never meets a tolerance", "[ladder]") {
  Scene scene{{1e-9, 1e-3, 1e-3, 1e-3}};
  scene.in_domain[0] = false;
  const Climb c(scene, 1e-2);
  CHECK(c.is("second"));
  CHECK(c.answer.tried[0].why != nullptr);
  const Climb named(scene, 1e-2, 0);  // by name it answers all the same
  CHECK(named.is("first"));
  CHECK_FALSE(named.answer.met);
  CHECK(named.answer.tried[0].accepted);
}

TEST_CASE("a rung asked for by name stands alone", "[ladder]") {
  const Climb c(Scene{{1e-2, 1e-4, 1e-6, 1e-8}}, 1e-5, 1);
  CHECK(c.is("second"));
  CHECK_FALSE(c.answer.met);
  CHECK(c.looked_at == 1);
  CHECK(Climb(Scene{{1e-2, 1e-4, 1e-6, 1e-8}}, 1e-5, 2).answer.met);
}

TEST_CASE("cancelled work ends the climb", "[ladder]") {
  const Climb c(Scene{{0, 0, 0, 0}, {Errc::not_applicable, Errc::cancelled, Errc::ok, Errc::ok}}, 1e-5);
  CHECK(c.refusal.code == Errc::cancelled);
  CHECK(c.looked_at == 2);

  // also where a rung before has answered, but not well enough
  const Climb second(Scene{{1e-2, 0, 0, 0}, {Errc::ok, Errc::cancelled, Errc::ok, Errc::ok}}, 1e-5);
  CHECK(second.refusal.code == Errc::cancelled);
  CHECK(second.answer.columns.empty());
  CHECK(second.answer.tried.size() == 2);
}

TEST_CASE("a NaN error never meets a tolerance and loses against any number", "[ladder]") {
  const Climb c(Scene{{gyrostat::nan<double>, 1e-2, gyrostat::nan<double>, 1e-1}}, 1e-5);
  CHECK(c.is("second"));
  CHECK_FALSE(c.answer.met);
}

TEST_CASE("only what is asked decides, each to its own tolerance", "[ladder]") {
  Scene scene{{1e-2, 1e-4, 1e-6, 1e-8}};
  scene.its_question.asked = {{0, false, 1e-5}};
  const Climb column(scene, 0.5);
  CHECK(column.is("third"));
  CHECK(column.answer.quantities.empty());
  CHECK(column.answer.columns[0].tolerance == 1e-5);

  scene.its_question.asked = {{0, true, 1e-4}};  // ten times the column's error
  const Climb scalar(scene, 0.5);
  CHECK(scalar.is("third"));
  CHECK(scalar.answer.excess == Approx(0.1));
  REQUIRE(scalar.answer.quantities.size() == 1);
  CHECK(scalar.answer.quantities[0].tolerance == 1e-4);
}

TEST_CASE("a rung that lacks what is asked is passed over unsolved, and by name says so", "[ladder]") {
  Scene scene{{1e-9, 1e-9, 1e-9, 1e-9}};
  scene.its_question.asked = {{1}};
  const Climb c(scene, 1e-3);
  CHECK(c.is("second"));
  REQUIRE(c.answer.tried.size() == 2);
  CHECK(std::isnan(c.answer.tried[0].error));
  CHECK(c.answer.tried[0].why != nullptr);
}

TEST_CASE("a scalar that no rung gives is there without a value, with a warning", "[ladder]") {
  static constexpr ScalarKind more[] = {rung_scalars[0], {"trace", 1, "1", Frame::none, Measure::absolute, ""}};
  static constexpr Family wider{"invented", rung_columns, more, {}, names, {}};
  Scene scene{{1e-9, 1e-9, 1e-9, 1e-9}};
  scene.its_question.asked = {{0}, {1, true}};
  Refusal refusal;
  const Answer answer = climb<Scene, Track>(wider, ladder, scene, nullptr, refusal);
  CHECK_FALSE(answer.met);
  CHECK(answer.warns("no-value"));
  REQUIRE(answer.quantity("trace"));
  CHECK(std::isnan(answer.quantity("trace")->values[0]));
  scene.its_question.asked[1].needed = false;
  CHECK(climb<Scene, Track>(wider, ladder, scene, nullptr, refusal).met);
}

TEST_CASE("a column that ends without a value says so, as one that begins so", "[ladder]") {
  const double none = gyrostat::nan<double>;
  const auto warns = [](std::vector<double> values, double error) {
    Answer answer;
    answer.columns.push_back({&rung_columns[0], std::move(values), error});
    gyrostat::detail::keep_asked(answer, Question{}, rung_family);
    return answer.warns("no-value");
  };
  CHECK(warns({none, none, none}, infinity<double>));
  CHECK(warns({1, 2, none}, infinity<double>));
  CHECK_FALSE(warns({1, 2, 3}, infinity<double>));
  CHECK_FALSE(warns({1, 2, 3}, 1e-3));
}

TEST_CASE("a tolerance in the unit is held against the size that the answer found", "[ladder]") {
  Scene scene{{1e-2, 1e-4, 1e-6, 1e-8}};
  scene.value = 1e4;
  scene.its_question.asked = {{0, false, 1e-1, true}};  // m, of 1e4 m
  const Climb c(scene, 0.5);
  CHECK(c.is("third"));
  CHECK(c.answer.columns[0].tolerance == Approx(1e-5));
  scene.error = {1e-2, 1e-4, 1e-4, 1e-4};  // the last rung is asked again, with what the tolerance comes to
  const Climb again(scene, 0.5);
  CHECK_FALSE(again.answer.met);
  CHECK(again.answer.tried.size() == 5);
}
