// SPDX-License-Identifier: BSD-3-Clause
// What an honesty run counts: answers whose true error is within the stated one, and the ratio of the two.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "../tests/ladder/column_error.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/rung.hpp"

namespace gyrostat::honesty {

struct Case {
  double ratio;  ///< true over stated
  std::string text;
};

/// What is seen at one tolerance.
struct Tally {
  int answered = 0, honest = 0, met = 0, over = 0, refused = 0, outside = 0, unknown = 0;
  int climbed = 0, waste = 0;  ///< answers of the ladder, and those that a cheaper rung would have done for
  int by_luck = 0;             ///< and those that one would have done for outside its domain
  /// By that rung, the one that answered, and the column in which its stated error was widest.
  std::map<std::string, int> wasted;
  std::map<std::string, int> outcomes;
  std::map<std::string, std::vector<double>> ratios;  ///< stated over true
  std::vector<Case> worst;
  std::vector<std::string> examples;
  double slowest = 0;
  std::string slow;
  /// What a rung took: where it gave an answer, s and over what it had predicted; where it gave none, s.
  struct Cost {
    std::vector<double> seconds, share;
    int in_vain = 0;
    double vain_seconds = 0;
  };
  std::map<std::string, Cost> costs;

  void time(double seconds, const std::string& scene) {
    if (seconds > slowest) slowest = seconds, slow = scene;
  }
  /// By the ladder.
  void spend(const Answer& answer) {
    for (const Attempt& a : answer.tried) {
      if (a.why == costs_more) ++outcomes[std::string("left out, predicted to cost more: ") + a.model];
      if (!(a.spent > 0)) continue;
      Cost& cost = costs[a.model];
      if (a.accepted) {
        cost.seconds.push_back(a.spent);
        cost.share.push_back(a.spent / a.predicted);
      } else {
        ++cost.in_vain;
        cost.vain_seconds += a.spent;
      }
    }
  }
  void refuse(const Refusal& refusal, const std::string& scene) {
    ++refused;
    if (outcomes[std::string("refused: ") + refusal.why]++ < 2) examples.push_back(scene);
  }
  /// Each column of the answer, and the scalars of these names where both have them.
  void compare(const Answer& answer, const Answer& truth, const std::string& scene,
               std::initializer_list<std::string_view> scalars = {}) {
    ++answered;
    ++outcomes[answer.model];
    bool good = true, within = true;
    double most = 0;
    std::string which;
    const auto one = [&](const char* name, double error, double stated, double own) {
      error = std::max(0.0, error - own);  // what the truth itself may be off by
      if (std::isnan(stated)) good = false, stated = 0;
      if (error > 0 && std::min(error, stated) < infinity<double>)
        ratios[std::string(answer.model) + " " + name].push_back(stated / error);
      good = good && error <= stated;
      within = within && (error <= answer.tolerance || stated > answer.tolerance);
      const double ratio = error == 0 ? 0 : error / stated;
      if (!(ratio <= most)) most = ratio, which = name;
    };
    for (const Column& column : answer.columns) {
      if (column.kind->measure == Measure::none) continue;
      const Column* right = truth.find(column.name());
      if (!right) continue;
      one(column.kind->name, column_error(column, *right), column.error, right->error);
    }
    for (const Quantity& q : answer.quantities)
      for (const Quantity& right : truth.quantities)
        if (std::find(scalars.begin(), scalars.end(), q.name()) != scalars.end() && q.kind == right.kind &&
            std::isfinite(q.values[0]) && std::isfinite(right.values[0]))
          one(q.kind->name,
              q.values[0] == right.values[0]
                  ? 0
                  : std::abs(q.values[0] - right.values[0]) /
                        (q.kind->measure == Measure::relative ? std::abs(right.values[0]) : 1.0),
              q.error, right.error);
    honest += good;
    met += answer.met;
    over += answer.met && !within;
    if (!good) worst.push_back({most, which + " " + scene});
  }
  /// `passed` is what a rung that was passed over answers by name, for less: whether all of what the ladder's answer gives would have been
  /// within the tolerance.
  bool was_in_vain(const Answer& passed, const Answer& answer, const Answer& truth) {
    double most = 0;
    std::string which;
    for (const Column& column : answer.columns) {
      if (column.kind->measure == Measure::none) continue;
      const Column *right = truth.find(column.name()), *found = passed.find(column.name());
      if (!right) continue;
      if (!found || !(column_error(*found, *right) + right->error <= answer.tolerance)) return false;
      if (!(found->error <= most)) most = found->error, which = column.name();
    }
    if (passed.tried.back().why != nullptr) return ++by_luck, true;
    ++waste;
    ++wasted[std::string(passed.model) + " for " + answer.model + ", " + which];
    return true;
  }
  void print(double tolerance) {
    std::printf("tolerance %.0e: %d answered, %d refused, %d of them outside the rung's domain, %d without a truth\n",
                tolerance, answered, refused, outside, unknown);
    std::printf("  slowest %.3f s: %s\n", slowest, slow.c_str());
    for (const auto& [name, n] : outcomes) std::printf("  %6d %s\n", n, name.c_str());
    std::printf("  true <= stated in %.4f %%; met in %d, of which over the tolerance %d\n",
                100.0 * honest / std::max(1, answered), met, over);
    std::printf(
        "  %d of %d answers of the ladder (%.1f %%) could have been a cheaper rung's in its domain, %d of one "
        "outside\n",
        waste, climbed, 100.0 * waste / std::max(1, climbed), by_luck);
    for (const auto& [name, n] : wasted) std::printf("  %6d wasted: %s\n", n, name.c_str());
    std::vector<double> all;
    for (auto& [name, values] : ratios) {
      std::sort(values.begin(), values.end());
      const std::size_t n = values.size();
      const auto lies = std::lower_bound(values.begin(), values.end(), 1.0) - values.begin();
      std::printf("  stated/true %-36s n %6zu  below 1: %4td  least %9.3g  1 %% %9.3g  median %9.3g  90 %% %9.3g\n",
                  name.c_str(), n, lies, values.front(), values[n / 100], values[n / 2], values[n * 9 / 10]);
      all.insert(all.end(), values.begin(), values.end());
    }
    std::sort(all.begin(), all.end());
    if (const std::size_t n = all.size(); n > 0)
      std::printf("  stated/true of all: least %.3g, median %.3g, 90 %% %.3g\n", all[0], all[n / 2], all[n * 9 / 10]);
    for (auto& [name, cost] : costs) {
      auto &seconds = cost.seconds, &share = cost.share;
      std::sort(seconds.begin(), seconds.end());
      std::sort(share.begin(), share.end());
      const std::size_t n = seconds.size();
      double total = 0;
      for (const double t : seconds) total += t;
      std::printf("  cost of %-12s answers %5zu  %8.2f ms", name.c_str(), n, 1e3 * total);
      if (n > 0)
        std::printf("  median %8.1f us  over predicted: 10 %% %5.2f  median %5.2f  90 %% %5.2f", 1e6 * seconds[n / 2],
                    share[n / 10], share[n / 2], share[n * 9 / 10]);
      std::printf("  in vain %5d  %8.2f ms\n", cost.in_vain, 1e3 * cost.vain_seconds);
    }
    for (const auto& text : examples) std::printf("  refused: %s\n", text.c_str());
    std::sort(worst.begin(), worst.end(), [](const Case& a, const Case& b) { return a.ratio > b.ratio; });
    for (std::size_t i = 0; i < std::min<std::size_t>(8, worst.size()); ++i)
      std::printf("  true/stated %.3g: %s\n", worst[i].ratio, worst[i].text.c_str());
  }
};

/// The seed on the command line.
inline unsigned seed_of(int argc, char** argv) { return argc > 2 ? unsigned(std::atoi(argv[2])) : 1; }

/// Times up to `span`, s: evenly from 0, anywhere, or a few late ones, of which an estimate sees least.
inline std::vector<double> asked_times(std::mt19937_64& random, double span) {
  const auto unit = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const double kind = unit();
  const int n = kind < 0.3 ? 12 : kind < 0.4 ? 200 : 1 + int(kind < 0.7 ? 20 * unit() : 4 * unit() * unit());
  std::vector<double> times;
  for (int i = 0; i <= n && kind < 0.4; ++i) times.push_back(span * i / n);
  for (int i = 1; i < n && kind >= 0.4; ++i)
    times.push_back(kind < 0.7 ? span * unit() : span * (1 - std::pow(10, -6 * unit())));
  if (kind >= 0.4) times.push_back(span);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// All of them where they are few, else the number of those that go evenly from 0 to the last.
inline std::string text_of(const std::vector<double>& times) {
  char word[40];
  if (times.size() > 24) return std::snprintf(word, sizeof word, " T %.17g n %zu", times.back(), times.size()), word;
  std::string text = " times";
  for (const double t : times) std::snprintf(word, sizeof word, " %.17g", t), text += word;
  return text;
}

/// Every column by name, but for an attitude that the start need not have.
inline std::vector<AskedQuantity> every_column(const Family& family) {
  std::vector<AskedQuantity> asked;
  for (std::size_t i = 0; i < family.columns.size(); ++i)
    if (family.columns[i].measure != Measure::angle || !has(family.unasked, i)) asked.push_back({i});
  return asked;
}

/// What the rung took that answers, s.
inline double spent_by(const Answer& answer) {
  for (const Attempt& attempt : answer.tried)
    if (attempt.accepted) return attempt.spent;
  return infinity<double>;
}

/// Has the scene's full equations solved by CVODE; false where it is not linked.
template <class Scene>
bool by_cvode([[maybe_unused]] Scene& scene) {
#ifdef GYROSTAT_HAVE_CVODE
  scene.full_equations = [](const Scene& of, Monitor* monitor) { return full_by_cvode(of, monitor); };
  return true;
#else
  return false;
#endif
}

/// The run of a family: [SCENES] [SEED] [RUNG] on the command line, RUNG being `cvode` for the full equations by CVODE where it is linked; every other answer of the ladder is asked for every column by name; without a rung the ladder, and every fourth answer by the rungs in turn,
/// by name. source.next() gives a scene of some kind; a `Made` has posed(question), a Result of the scene of the family under that question
/// (its times left to it), and text(), all that is needed to make it anew; truth(scene, answer), or truth(made, scene, answer) where the
/// scene keeps less than was given, fills in the true motion, false where it cannot be had. Each scene is solved at every tolerance.
template <class Scenes, class Truth, class Solve>
void run(int argc, char** argv, const Family& family, int count, Scenes source, const Truth& truth, const Solve& solve,
         std::initializer_list<double> tolerances, std::initializer_list<std::string_view> scalars = {}) {
  if (argc > 1) count = std::atoi(argv[1]);
  const std::size_t rungs = family.rungs.size();
  const bool outside = argc > 3 && std::string_view(argv[3]) == "cvode";
  const int named = outside ? int(rungs) - 1 : argc > 3 ? place_of(family.rungs, argv[3]) : any_rung;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);

  std::vector<Tally> tallies(tolerances.size());
  for (int i = 0; i < count; ++i) {
    auto made = source.next();
    Answer right;
    bool known = false, has_truth = false;
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      Question question;
      question.tolerance = tolerances.begin()[k];
      const std::size_t round = std::size_t(i) + k;
      question.rung = named != any_rung ? named : round % 4 == 0 ? int(round / 4 % rungs) : any_rung;
      if (question.rung == any_rung && round % 2 != 0) question.asked = every_column(family);
      auto posed = made.posed(question);
      if (!posed) {
        std::printf("no scene: %s\n", message(posed.error()));
        continue;
      }
      auto scene = std::move(posed).value();
      if (outside && !by_cvode(scene)) {
        std::printf("no CVODE here\n");
        return;
      }
      Refusal refusal;
      const auto begin = std::chrono::steady_clock::now();
      const Answer answer = solve(scene, refusal);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      const std::string text = std::string(answer.model) + ", " + made.text();
      tallies[k].time(seconds, text);
      if (question.rung == any_rung || named != any_rung) tallies[k].spend(answer);
      if (refusal.code != Errc::ok) {
        if (question.rung == any_rung || named != any_rung) tallies[k].refuse(refusal, text);
        continue;
      }
      tallies[k].outside += question.rung != any_rung && !answer.tried.empty() && answer.tried.back().why;
      if (!known) {
        Question whole;
        whole.rung = int(rungs) - 1;
        const auto full = made.posed(whole);
        if constexpr (requires { truth(made, *full, right); }) has_truth = truth(made, *full, right);
        else has_truth = truth(*full, right);
        // a truth that is hardly known itself, behind an instability, judges nothing
        for (const Column& column : right.columns)
          has_truth = has_truth && (column.kind->measure == Measure::none || column.error < 0.01);
      }
      known = true;
      if (!has_truth) {
        ++tallies[k].unknown;
        continue;
      }
      tallies[k].compare(answer, right, text, scalars);
      if (question.rung != any_rung) continue;
      ++tallies[k].climbed;
      for (const Attempt& attempt : answer.tried) {
        if (attempt.accepted || !(attempt.spent > 0)) continue;
        question.rung = place_of(family.rungs, attempt.model);
        const auto again = made.posed(question);
        const Answer passed = solve(*again, refusal);
        if (refusal.code == Errc::ok && spent_by(passed) < spent_by(answer) &&
            tallies[k].was_in_vain(passed, answer, right))
          break;
      }
    }
    if ((i + 1) % 500 == 0) std::fprintf(stderr, "%d of %d scenes\n", i + 1, count);
  }
  for (std::size_t k = 0; k < tolerances.size(); ++k) tallies[k].print(tolerances.begin()[k]);
}

}  // namespace gyrostat::honesty
