// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/sweep.hpp"

#include <atomic>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/deceleration/inputs.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/ladder/free/inputs.hpp"
#include "gyrostat/ladder/free/solve.hpp"

using namespace gyrostat;

namespace {

/// Despins of bodies whose first moment and first torque differ, by what answers within a hundredth.
struct Despins {
  std::vector<double> numbers, moment, torque;
  Question question;
  std::vector<double> stop, stop_error, norm, norm_error;
  std::vector<SweepRow> told;

  explicit Despins(std::size_t rows) : numbers(input_width(deceleration::input_kinds), 0.0) {
    for (const std::size_t absent : {18U, 19U, 20U, 21U, 25U, 26U, 27U}) numbers[absent] = gyrostat::nan<double>;
    numbers[0] = 16403, numbers[4] = 70915, numbers[8] = 76392;
    numbers[12] = .06, numbers[13] = .05, numbers[14] = .04, numbers[15] = 1.2e-6;
    numbers[22] = .012, numbers[23] = .008, numbers[24] = .032;
    for (std::size_t i = 0; i < rows; ++i) {
      moment.push_back(16000 + 10 * double(i));
      torque.push_back(.06 - 1e-4 * double(i % 100));
    }
    using namespace deceleration;
    question.times = {10000, 40000};
    question.tolerance = 1e-2;
    question.asked = {{scalar::stop_time, true}, {column::angular_momentum_norm}};
    stop.resize(rows), stop_error.resize(rows), norm.resize(2 * rows), norm_error.resize(rows), told.resize(rows);
  }

  auto scenes() const {
    return [this](std::span<const double> row) { return deceleration::scene_of(row, question); };
  }
  void run(unsigned threads, Monitor* monitor = nullptr) {
    const Varied varied[] = {{0, moment}, {12, torque}};
    const SweepTarget targets[] = {{deceleration::scalar::stop_time, true, 1, stop, stop_error},
                                   {deceleration::column::angular_momentum_norm, false, 2, norm, norm_error}};
    sweep(deceleration::tables, numbers, varied, scenes(), &deceleration::solve<>, targets, told, threads, monitor);
  }
  /// Of a row, by the ladder itself.
  Answer alone(std::size_t row) const {
    std::vector<double> own = numbers;
    own[0] = moment[row], own[12] = torque[row];
    Refusal refusal;
    return deceleration::solve<>(*scenes()(own), refusal);
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("rows are done once each, whatever the number of threads", "[ladder]") {
  for (const unsigned threads : {0U, 1U, 3U, 16U})
    for (const std::size_t rows : {0U, 1U, 8U, 1001U}) {
      CAPTURE(threads, rows);
      std::vector<std::atomic<int>> done(rows);
      for_rows(rows, threads, nullptr, [&](Monitor&) { return [&](std::size_t row) { ++done[row]; }; });
      CHECK(std::all_of(done.begin(), done.end(), [](const auto& times) { return times == 1; }));
    }
}

TEST_CASE("a pool has no more threads than are of use", "[ladder]") {
  std::atomic<unsigned> workers{0};
  std::atomic<std::size_t> done{0};
  for_rows(4000, 4000, nullptr, [&](Monitor&) {
    ++workers;
    return [&](std::size_t) { ++done; };
  });
  CHECK(workers <= most_threads);
  CHECK(done == 4000);
}

TEST_CASE("blocks cover all rows, none longer than wanted", "[ladder]") {
  for (const unsigned threads : {1U, 3U})
    for (const std::size_t rows : {0U, 5U, 1001U}) {
      CAPTURE(threads, rows);
      std::vector<std::atomic<int>> done(rows);
      std::atomic<bool> longer{false};
      for_blocks(rows, threads, 16, nullptr, [&](Monitor&) {
        return [&](std::size_t begin, std::size_t end) {
          if (end - begin > 16) longer = true;
          for (; begin < end; ++begin) ++done[begin];
        };
      });
      CHECK_FALSE(longer.load());
      CHECK(std::all_of(done.begin(), done.end(), [](const auto& times) { return times == 1; }));
    }
}

TEST_CASE("the answers of a sweep are those of the ladder, to the bit, for any number of threads", "[ladder]") {
  Despins one(60);
  one.run(1);
  for (const unsigned threads : {2U, 5U}) {
    Despins several(60);
    several.run(threads);
    CHECK(same_bits(several.stop, one.stop));
    CHECK(same_bits(several.stop_error, one.stop_error));
    CHECK(same_bits(several.norm, one.norm));
    CHECK(same_bits(several.norm_error, one.norm_error));
  }
  for (const std::size_t row : {0U, 17U, 59U}) {
    CAPTURE(row);
    const Answer answer = one.alone(row);
    CHECK(one.told[row].reason == nullptr);
    CHECK(one.told[row].met == answer.met);
    CHECK(one.told[row].excess == answer.excess);
    CHECK(deceleration::rung_kinds[one.told[row].rung].name == std::string(answer.model));
    CHECK(one.stop[row] == answer.quantities[0].values[0]);
    CHECK(one.stop_error[row] == answer.quantities[0].error);
    CHECK(one.norm[2 * row + 1] == answer.columns[0].values[1]);
    CHECK(one.norm_error[row] == answer.columns[0].error);
  }
}

TEST_CASE("a row that is no scene says why and leaves those beside it alone", "[ladder]") {
  Despins good(20), bad(20);
  bad.moment[3] = -1;
  bad.moment[4] = 1e9;
  bad.torque[5] = gyrostat::nan<double>;
  bad.torque[6] = -1;
  good.run(1);
  bad.run(2);
  const auto why = [&](std::size_t row) { return std::string(bad.told[row].reason ? bad.told[row].reason : ""); };
  CHECK(why(3) == message(Errc::not_positive));
  CHECK(why(4) == message(Errc::triangle_inequality));
  CHECK(why(5) == message(Errc::not_finite));
  CHECK(why(6) == message(Errc::negative));
  for (std::size_t row = 0; row < 20; ++row) {
    CAPTURE(row);
    const bool broken = row >= 3 && row <= 6;
    CHECK((bad.told[row].reason != nullptr) == broken);
    CHECK((bad.told[row].rung < 0) == broken);
    CHECK(std::isnan(bad.stop[row]) == broken);
    CHECK(std::isnan(bad.norm[2 * row]) == broken);
    if (!broken) CHECK(bad.stop[row] == good.stop[row]);
  }
}

TEST_CASE("a rung that refuses is named with its reason", "[ladder]") {
  Despins despins(4);
  despins.question.rung = deceleration::rung::equal_torque;
  despins.run(1);
  CHECK(despins.told[1].rung == deceleration::rung::equal_torque);
  CHECK(despins.told[1].reason == std::string("the control torques are not equal"));
  CHECK(std::isnan(despins.stop[1]));
}

TEST_CASE("warnings are bits in the order of the table", "[ladder]") {
  Despins despins(2);
  despins.numbers[12] = despins.numbers[13] = despins.numbers[14] = 0;
  despins.torque = {0, .05};
  despins.run(1);
  CHECK((despins.told[0].warnings >> deceleration::warning::no_control & 1U) == 1);
  CHECK((despins.told[1].warnings >> deceleration::warning::no_control & 1U) == 0);
}

TEST_CASE("a sweep allocates what the ladder does for each row, and no more", "[ladder]") {
  const auto swept = [](std::size_t rows) {
    Despins despins(rows);
    const std::size_t before = allocations();
    despins.run(1);
    return allocations() - before;
  };
  const auto bare = [](std::size_t rows) {
    Despins despins(rows);
    const std::size_t before = allocations();
    std::vector<double> own = despins.numbers;
    for (std::size_t row = 0; row < rows; ++row) {
      own[0] = despins.moment[row], own[12] = despins.torque[row];
      Refusal refusal;
      const auto scene = despins.scenes()(own);
      (void)deceleration::solve<>(*scene, refusal);
    }
    return allocations() - before;
  };
  CHECK(swept(48) - swept(16) == bare(48) - bare(16));
}

TEST_CASE("a sweep that is stopped says which rows it left out", "[ladder]") {
  Despins despins(4000);
  Monitor monitor;
  std::atomic<int> solved{0};
  // the tenth row stops the sweep; it and those after it wait until that has reached their threads
  const auto solve = [&](const deceleration::Scene& scene, Refusal& refusal, Monitor* own) {
    Answer answer = deceleration::solve<>(scene, refusal, nullptr);
    if (++solved >= 10) {
      monitor.cancel = true;
      while (!own->cancel.load()) std::this_thread::yield();
    }
    return answer;
  };
  sweep(deceleration::tables, despins.numbers, {}, despins.scenes(), solve, {}, despins.told, 2, &monitor);
  const auto left = std::count_if(despins.told.begin(), despins.told.end(),
                                  [](const SweepRow& row) { return row.reason == not_reached; });
  CHECK(left == 4000 - solved);
  CHECK(despins.told[0].reason == nullptr);
  CHECK(std::string_view(despins.told.back().reason) == not_reached);
}

namespace {

/// Attitudes of free gyrostats, of whom every seventh is no body, every fifth turns beside a separatrix and every eleventh rests.
struct Tumblers {
  std::vector<double> numbers, moment, rate, side;
  Question question;
  std::vector<double> attitude, error;
  std::vector<SweepRow> told;

  explicit Tumblers(std::size_t rows) : numbers(input_width(free::input_kinds), gyrostat::nan<double>) {
    std::fill_n(numbers.begin(), 12, 0.0);
    numbers[0] = 35, numbers[4] = 22, numbers[8] = 16;
    numbers[9] = 3, numbers[10] = -2, numbers[11] = 5;
    numbers[18] = numbers[19] = numbers[20] = 0, numbers[21] = 1;
    for (std::size_t i = 0; i < rows; ++i) {
      moment.push_back(i % 7 == 6 ? 99 : 34 + 0.01 * double(i % 200));
      rate.push_back(i % 11 == 10 ? 0 : i % 5 == 4 ? 1e-9 : 0.7 - 1e-3 * double(i % 300));
      side.push_back(i % 11 == 10 ? 0 : i % 5 == 4 ? 1e-9 : 0.4);
    }
    numbers[13] = .55;
    question.times = {3, 90};
    question.tolerance = 1e-6;
    question.asked = {{free::column::attitude}};
    attitude.resize(8 * rows), error.resize(rows), told.resize(rows);
  }
  template <class Solve>
  void run(unsigned threads, const Solve& solve) {
    const Varied varied[] = {{0, moment}, {14, rate}, {12, side}};
    const SweepTarget targets[] = {{free::column::attitude, false, 8, attitude, error}};
    const auto scene_of = [&](std::span<const double> row) { return free::scene_of(row, question); };
    sweep(free::tables, numbers, varied, scene_of, solve, targets, told, threads);
  }
};

}  // namespace

TEST_CASE("rows that are answered side by side have the bits of the ladder, however they are divided", "[ladder]") {
  constexpr std::size_t rows = 700;
  Tumblers alone(rows);
  alone.run(1, &free::solve);
  for (const unsigned threads : {1U, 2U, 5U, 64U}) {
    Tumblers together(rows);
    together.run(threads, free::SweepSolver{});
    CAPTURE(threads);
    CHECK(same_bits(together.attitude, alone.attitude));
    CHECK(same_bits(together.error, alone.error));
    for (std::size_t row = 0; row < rows; ++row) {
      const SweepRow &a = together.told[row], &b = alone.told[row];
      CAPTURE(row);
      CHECK((a.reason == b.reason && a.rung == b.rung && a.met == b.met && a.warnings == b.warnings));
      CHECK((a.excess == b.excess || (std::isnan(a.excess) && std::isnan(b.excess))));
      CHECK((a.reason != nullptr) == (row % 7 == 6));
      CHECK(std::isnan(together.attitude[8 * row]) == (row % 7 == 6));
    }
  }
}
