// SPDX-License-Identifier: BSD-3-Clause
// How honest the full general equations are: random scenes, solved at four tolerances, against the equations as they are written, in
// long double by a Runge-Kutta method. Prints for each tolerance the fraction of answers whose true error is within the stated one in every
// column, the median of stated over true, and the worst cases.
//
//     general_honesty [SCENES = 500] [SEED = 1] [TURNS = 10]
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "../tests/models/general/scenes.hpp"
#include "../tests/models/general/truth.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr double tolerances[] = {1e-3, 1e-6, 1e-9, 1e-12};

struct Tally {
  int answered = 0, honest = 0, met = 0, over = 0, stopped = 0, unknown = 0;
  std::vector<double> stated_over_true;
  std::vector<honesty::Case> worst;
};

FullErrors<double> apart(const Prepared<double>& of, const std::vector<State<double>>& one,
                         const std::vector<State<double>>& two) {
  Comparison both{FullRow<double>(of)};
  for (std::size_t i = 0; i < one.size(); ++i) both.add(one[i], two[i]);
  return both.relative(both.difference());
}

std::vector<State<double>> truth(const Problem<long double>& problem, const std::vector<double>& times,
                                 long double tolerance) {
  const std::vector<long double> wide(times.begin(), times.end());
  std::vector<State<double>> made;
  for (const auto& state : general_truth::motion<long double>(problem, wide, tolerance, 60'000))
    made.push_back(general_truth::cast<double>(state));
  return made;
}

std::string what(const Problem<double>& p) {
  std::string text = " wheels";
  for (const auto& w : p.wheels) text += ' ' + std::to_string(int(w.type)) + (w.table.times.empty() ? "" : "t");
  text += " torques";
  for (const auto& t : p.torques) {
    text += ' ' + std::to_string(int(t.type));
    if (!t.factor.on.empty()) text += 'o';
    if (!t.factor.table.times.empty()) text += 't';
    if (t.factor.amplitude != 0) text += 'w';
  }
  return text;
}

void judge(Tally& tally, const FullErrors<double>& error, const FullErrors<double>& known,
           const FullMotionAnswer<double>& answer, double tolerance, const std::string& text) {
  ++tally.answered;
  tally.met += answer.met;
  bool honest = true, within = true;
  double least = infinity<double>, most = 0;
  std::size_t column = 0;
  for (std::size_t i = 0; i < std::size(full_columns); ++i) {
    const double true_error = std::max(0.0, error[i] - 4 * known[i]);
    honest = honest && true_error <= answer.error[i];
    within = within && true_error <= tolerance;
    if (true_error > 0) least = std::min(least, answer.error[i] / true_error);
    if (const double ratio = over(true_error, answer.error[i]); !(ratio <= most)) most = ratio, column = i;
  }
  tally.honest += honest;
  tally.over += answer.met && !within;
  if (least < infinity<double>) tally.stated_over_true.push_back(least);
  tally.worst.push_back({most, text + ' ' + full_columns[column].name});
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 500;
  const double turns = argc > 3 ? std::atof(argv[3]) : 10;
  general_scenes::Scenes source(honesty::seed_of(argc, argv));
  std::map<double, Tally> tallies;
  for (int i = 0; i < count; ++i) {
    const auto made = source.next(turns);
    const auto times = honesty::asked_times(source.random(), made.span);
    const auto wide = general_truth::cast<long double>(made.problem);
    const auto right = truth(wide, times, 1e-17L), rough = truth(wide, times, 1e-15L);
    const Prepared<double> of(made.problem, times.back());
    for (const double tolerance : tolerances) {
      Tally& tally = tallies[tolerance];
      std::vector<State<double>> states(times.size());
      FullMotionOptions<double> options;
      options.tolerance = tolerance;
      const auto answer = full_motion<double>(made.problem, times, states, options);
      const std::string text = std::to_string(i) + ' ' + made.kind + what(made.problem) + honesty::text_of(times);
      if (!answer || answer->status != ode::Status::reached) {
        ++tally.stopped;
        if (!answer || answer->status != ode::Status::event)
          std::printf("no answer: %s %s\n", answer ? ode::message(answer->status) : message(answer.error()),
                      text.c_str());
        continue;
      }
      if (right.empty() || rough.empty()) ++tally.unknown;
      else judge(tally, apart(of, right, states), apart(of, right, rough), *answer, tolerance, text);
    }
    if ((i + 1) % 100 == 0) std::fprintf(stderr, "%d of %d scenes\n", i + 1, count);
  }
  for (auto& [tolerance, tally] : tallies) {
    auto& ratios = tally.stated_over_true;
    std::sort(ratios.begin(), ratios.end());
    std::sort(tally.worst.begin(), tally.worst.end(), [](const auto& a, const auto& b) { return a.ratio > b.ratio; });
    std::printf(
        "tolerance %g: %d answered, %d honest (%.3f %%), %d met, %d met but over, %d stopped, %d unknown, median "
        "stated/true %.1f\n",
        tolerance, tally.answered, tally.honest, 100.0 * tally.honest / std::max(1, tally.answered), tally.met,
        tally.over, tally.stopped, tally.unknown, ratios.empty() ? 0.0 : ratios[ratios.size() / 2]);
    for (std::size_t i = 0; i < std::min<std::size_t>(4, tally.worst.size()); ++i)
      std::printf("  true/stated %.3g: %s\n", tally.worst[i].ratio, tally.worst[i].text.c_str());
  }
}
