// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/companions.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

struct PairWriter {
  using Scalar = double;
  using State = double;
  static constexpr ColumnKind columns[] = {{"x", 1, "m", Frame::none, Measure::relative, ""}};
  double rate = 0;

  void operator()(double x, double* row) const noexcept { *row = x; }
  template <class Numbers>
  double turning(const Numbers& row) const noexcept {
    return rate * std::abs(row[0]);
  }
};

constexpr double margin = honesty::side_by_side.margin;

/// A course whose state is a function of time, in steps of one length.
template <class F>
struct Course {
  F state;
  double length, now = 0;
  ode::Status fails = ode::Status::reached;

  ode::Status step(double t_max) {
    now = std::min(now + length, t_max);
    return now > 7 ? fails : ode::Status::reached;
  }
  double time() const { return now; }
  double at(double t) const { return state(t); }
  ode::Counts counts() const { return {0, 100, 0}; }
};
template <class F>
Course(F, double) -> Course<F>;

using Function = double (*)(double);
using Run = Course<Function>;

struct Found {
  Walk<PairWriter> walk;
  std::vector<double> states;
};

Found walked(Run course, Run companion, Run second, std::vector<double> times, double rate = 0,
             const MotionOptions<double>& options = {}) {
  std::vector<double> states(times.size());
  auto walk = walk_beside(PairWriter{.rate = rate}, Runs<Run>{course, companion, &second},
                          {course.at(0), times, states, -1.0}, options, not_noted);
  return {walk, states};
}

double still(double) { return 1; }
double off(double) { return 1.25; }
double bump(double t) { return t > 2 && t < 3 ? 3.0 : 1.0; }
double farther(double) { return 0.5; }

}  // namespace

TEST_CASE("the answer's states are kept at the asked times, and the distance to the companion is seen", "[ladder]") {
  const auto found = walked({still, 0.4}, {off, 1.5}, {still, 1}, {0, 1, 2.5, 10});
  CHECK(found.states == std::vector<double>{1, 1, 1, 1});
  CHECK(found.walk.status == ode::Status::reached);
  CHECK(found.walk.error[0] == margin * 0.25);
  CHECK(found.walk.asked.size()[0] == 1);
}

TEST_CASE("a distance between the asked times counts, and fades while the body turns", "[ladder]") {
  const auto kept = walked({still, 0.5}, {bump, 0.5}, {still, 1}, {10});
  CHECK(kept.walk.error[0] == margin * 2);
  const auto faded = walked({still, 0.5}, {bump, 0.5}, {still, 1}, {10}, 128);
  CHECK(faded.walk.error[0] < 0.01 * kept.walk.error[0]);
  CHECK(faded.walk.error[0] > 0);
}

TEST_CASE("a distance fades as the body turns by then, not as it did before", "[ladder]") {
  const Function slows = [](double t) { return t < 3 ? 1.0 : 0.0; },
                 starts = [](double t) { return t < 3 ? 0.0 : 1.0; };
  const Function slow_bump = [](double t) { return t < 3 ? (t > 2 ? 3.0 : 1.0) : 0.0; },
                 start_bump = [](double t) { return t < 3 ? (t > 2 ? 2.0 : 0.0) : 1.0; };
  CHECK(walked({slows, 0.5}, {slow_bump, 0.5}, {slows, 1}, {20}, 128).walk.error[0] > 0.5 * margin * 2);
  CHECK(walked({starts, 0.5}, {start_bump, 0.5}, {starts, 1}, {20}, 128).walk.error[0] < 0.01 * margin * 2);
}

TEST_CASE("either companion counts, and their own distance", "[ladder]") {
  CHECK(walked({still, 1}, {still, 1}, {farther, 1}, {5}).walk.error[0] == margin * 0.5);
  CHECK(walked({still, 1}, {farther, 1}, {still, 1}, {5}).walk.error[0] == margin * 0.5);
  CHECK(walked({still, 1}, {farther, 1}, {farther, 1}, {5}).walk.error[0] == margin * 0.5);
  CHECK(walked({farther, 1}, {off, 1}, {still, 1}, {5}).walk.error[0] == margin * 0.75);
}

TEST_CASE("a distance that is no number, or infinite, is kept", "[ladder]") {
  CHECK(std::isnan(error_of_distances(gyrostat::nan<double>, 1.)));
  CHECK(std::isnan(error_of_distances(1., gyrostat::nan<double>)));
  CHECK(error_of_distances(infinity<double>, 1.) == infinity<double>);
  CHECK(error_of_distances(infinity<double>, infinity<double>) == infinity<double>);
}

TEST_CASE("one companion shows truncation alone", "[ladder]") {
  Run course{still, 1}, companion{farther, 1};
  const std::vector<double> times{0, 3, 5};
  std::vector<double> states(3), noted;
  const auto walk =
      walk_beside(PairWriter{}, Runs<Run>{course, companion, nullptr}, {1.0, times, states, -1.0},
                  MotionOptions<double>{}, [&](std::size_t, const Errors<1>& error) { noted.push_back(error[0]); });
  CHECK(walk.error[0] == margin * 0.5);
  CHECK(states == std::vector<double>{1, 1, 1});
  CHECK(noted == std::vector<double>{0, margin * 0.5, margin * 0.5});
}

TEST_CASE("the first steps of the runs end apart", "[ladder]") {
  // each run is as good as its step is long: what all make of the first step of the answer would be hidden
  struct Stepped {
    double end = 0, error = 0;
    ode::Status step(double t_max) {
      const double next = std::min(end + 1, t_max);
      error += std::pow(next - end, 21);
      end = next;
      return ode::Status::reached;
    }
    double time() const { return end; }
    double at(double) const { return 1 + error; }
    ode::Counts counts() const { return {0, 1, 0}; }
  };
  Stepped course, companion, second;
  const std::vector<double> times{1};
  std::vector<double> states(1);
  const auto walk = walk_beside(PairWriter{}, Runs<Stepped>{course, companion, &second}, {1.0, times, states, -1.0},
                                MotionOptions<double>{}, not_noted);
  CHECK(walk.error[0] == Approx(margin).epsilon(1e-2));
}

TEST_CASE("of many times some are looked at, and steps' ends; each hears an error that holds for it", "[ladder]") {
  struct Counting {
    Function state;
    double length;
    double now = 0;
    int* looks = nullptr;
    ode::Status step(double t_max) {
      now = std::min(now + length, t_max);
      return ode::Status::reached;
    }
    double time() const { return now; }
    double at(double t) const {
      if (looks != nullptr) ++*looks;
      return state(t);
    }
    ode::Counts counts() const { return {0, 1, 0}; }
  };
  const Function grows = [](double t) { return 1 + t * 0x1p-20; };
  for (const std::size_t count : {10u, 64u, 100u, 6400u, 6401u}) {
    int looks = 0;
    Counting course{still, 0.7}, companion{grows, 0.5, 0, &looks};
    std::vector<double> times, noted(count, -1.0), states(count);
    for (std::size_t i = 1; i <= count; ++i) times.push_back(10 * double(i) / double(count));
    std::size_t next = 0;
    const auto walk = walk_beside(PairWriter{}, Runs<Counting>{course, companion, nullptr}, {1.0, times, states, -1.0},
                                  MotionOptions<double>{}, [&](std::size_t i, const Errors<1>& error) {
                                    CHECK(i == next++);
                                    noted[i] = error[0];
                                  });
    CAPTURE(count);
    CHECK(next == count);
    CHECK(states == std::vector<double>(count, 1.0));
    CHECK(walk.error[0] == Approx(margin * 10 * 0x1p-20).epsilon(1e-9));
    for (std::size_t i = 0; i < count; ++i) CHECK(noted[i] >= margin * times[i] * 0x1p-20 * (1 - 1e-6));
    CHECK(looks <= 65 + int(honesty::first_compared) + 21 + 2 * 15);  // steps of the companion, and of the answer
  }
}

TEST_CASE("what is off at the end of a step and gone in the next is seen, of however many times", "[ladder]") {
  const Function swells = [](double t) { return 1 + (t > 4.19 && t < 4.2005 ? 0x1p-20 : 0); };  // six steps of 0.7
  for (const std::size_t count : {100u, 1000u, 6400u}) {
    Run course{swells, 0.7}, companion{still, 0.5};
    std::vector<double> times, states(count);
    for (std::size_t i = 1; i <= count; ++i) times.push_back(10 * double(i) / double(count));
    const auto walk = walk_beside(PairWriter{}, Runs<Run>{course, companion, nullptr}, {1.0, times, states, -1.0},
                                  MotionOptions<double>{}, not_noted);
    CAPTURE(count);
    CHECK(walk.error[0] == Approx(margin * 0x1p-20).epsilon(1e-9));
  }
}

namespace {

/// What a walk to 10 s sees of its error, asked for 6400 times.
double error_seen(Run course, Run companion) {
  std::vector<double> times, states(6400);
  for (int i = 1; i <= 6400; ++i) times.push_back(i / 640.0);
  return walk_beside(PairWriter{}, Runs<Run>{course, companion, nullptr}, {1.0, times, states, -1.0},
                     MotionOptions<double>{}, not_noted)
      .error[0];
}

}  // namespace

TEST_CASE("what is off just behind the end of a step and gone soon after is seen", "[ladder]") {
  const Function swells = [](double t) { return 1 + (t > 4.2005 && t < 4.2025 ? 0x1p-20 : 0); };  // six steps of 0.7
  CHECK(error_seen({swells, 0.7}, {still, 0.5}) == Approx(margin * 0x1p-20).epsilon(1e-9));
}

TEST_CASE("a companion steps shorter than the answer, whatever its own tolerance would let it", "[ladder]") {
  for (const double own : {0.3, 0.7, 5.0}) {
    double longest = 0;
    struct Measured : Run {
      double* longest;
      ode::Status step(double t_max) {
        const double before = now;
        const auto status = Run::step(t_max);
        *longest = std::max(*longest, now - before);
        return status;
      }
    };
    double of_answer = 0;
    Measured course{{still, 0.7}, &of_answer}, companion{{still, own}, &longest};
    std::vector<double> times{70}, states(1);
    (void)walk_beside(PairWriter{}, Runs<Measured>{course, companion, nullptr}, {1.0, times, states, -1.0},
                      MotionOptions<double>{}, not_noted);
    CHECK(of_answer == Approx(0.7));
    const double most = honesty::companion_stride * 0.7;
    CHECK(longest <= std::min(own, most) * (1 + 1e-12));
    CHECK(longest > std::min(own, most * 0.99) * (1 - 1e-12));
  }
}

TEST_CASE("no two steps of a companion are alike", "[ladder]") {
  constexpr int count = 1000;
  std::array<int, 10> seen{};
  for (std::uint64_t k = 0; k < count; ++k) {
    const double less = (0.85 - companion_stride(0.85, k)) / honesty::stride_spread;
    REQUIRE(less >= 0);
    REQUIRE(less < 1);
    ++seen[std::size_t(10 * less)];
    // nor any that are a few apart, as the phases of a motion may come back after so many
    for (std::uint64_t apart = 1; apart < 8; ++apart)
      CHECK(std::abs(companion_stride(0.85, k + apart) - companion_stride(0.85, k)) > honesty::stride_spread / 20);
  }
  for (const int each : seen) CHECK(std::abs(each - count / 10) <= 2);
}

TEST_CASE("what is off inside the first step and not at its end is seen, of however many times", "[ladder]") {
  const Function bulges = [](double t) { return 1 + (t < 0.004 ? 0x1p-20 : 0); };
  CHECK(error_seen({still, 0.7}, {bulges, 0.5}) == Approx(margin * 0x1p-20).epsilon(1e-2));
}

TEST_CASE("what lies behind a failure is nowhere, whichever run fails", "[ladder]") {
  for (int which = 0; which < 3; ++which) {
    Run runs[3] = {{still, 1}, {still, 1}, {still, 1}};
    runs[which].fails = ode::Status::step_limit;
    const auto found = walked(runs[0], runs[1], runs[2], {0, 5, 9, 10});
    CAPTURE(which);
    CHECK(found.walk.status == ode::Status::step_limit);
    CHECK(found.states == std::vector<double>{1, 1, -1, -1});
  }
}

TEST_CASE("a walk can be stopped, and reports how far it is", "[ladder]") {
  Monitor monitor;
  monitor.cancel = true;
  MotionOptions<double> options;
  options.monitor = &monitor;
  const auto found = walked({still, 1}, {still, 1}, {still, 1}, {10}, 0, options);
  CHECK(found.walk.status == ode::Status::cancelled);
  CHECK(found.states[0] == -1);
  CHECK(monitor.fraction > 0);
}

/// Steps of a length that time changes.
struct Plodding {
  static constexpr bool goes_on_alike = true;
  double (*length)(double);
  double now = 0;
  std::uint64_t steps = 0;
  ode::Status step(double t_max) {
    ++steps, now = std::min(now + length(now), t_max);
    return ode::Status::reached;
  }
  double time() const { return now; }
  double at(double) const { return 1; }
  ode::Counts counts() const { return {0, steps, 0}; }
};

TEST_CASE("steps that would overrun their budget by far, and do not lengthen, are given up early", "[ladder]") {
  const auto walked_by = [](double (*length)(double), double end, std::uint64_t budget) {
    Plodding course{length}, companion{length};
    const std::vector<double> times{end};
    std::vector<double> states(1);
    MotionOptions<double> options;
    options.step_cap = budget;
    const auto walk = walk_beside(PairWriter{}, Runs<Plodding>{course, companion, nullptr}, {1.0, times, states, -1.0},
                                  options, not_noted);
    return std::pair{walk.status, companion.steps};
  };
  const auto even = [](double) { return 1.0; };
  const auto [status, steps] = walked_by(even, 1e9, 1000000);
  CHECK(status == ode::Status::step_limit);
  CHECK(steps < 300000);
  // what the budget nearly holds is not
  CHECK(walked_by(even, 3e5, 100000).first == ode::Status::reached);
  // nor are steps that lengthen
  CHECK(walked_by([](double t) { return 1 + 1e-4 * t; }, 1e9, 100000).first == ode::Status::reached);
}

/// A course on which a kick is seen, as something far away.
struct KickedCourse {
  double away = 0, now = 0;
  int kicks = 0;
  double kicked_at = 0;
  ode::Status step(double t_max) {
    now = std::min(now + 1, t_max);
    return ode::Status::reached;
  }
  void kick(double amount) { away += amount, ++kicks, kicked_at = now; }
  double time() const { return now; }
  double at(double) const { return 1 + away; }
  ode::Counts counts() const { return {}; }
};

TEST_CASE("a companion that runs alone is kicked once, behind half the span", "[ladder]") {
  const std::vector<double> times{4, 10};
  std::vector<double> states(2);
  const auto walked_with = [&](KickedCourse* second, KickedCourse& companion) {
    KickedCourse answer;
    const auto walk = walk_beside(PairWriter{}, Runs<KickedCourse>{answer, companion, second},
                                  {1.0, times, states, -1.0}, MotionOptions<double>{}, not_noted);
    CHECK(answer.kicks == 0);
    return walk.error[0];
  };
  KickedCourse alone;
  const double error = walked_with(nullptr, alone);
  CHECK(alone.kicks == 1);
  CHECK(alone.kicked_at > 5);
  CHECK(alone.kicked_at < 7);
  CHECK(error == Approx(margin * honesty::kick * epsilon<double>).epsilon(1e-3));
  KickedCourse first, second;
  CHECK(walked_with(&second, first) == 0);
  CHECK(first.kicks + second.kicks == 0);
}

TEST_CASE(
    "the stated error is the distance times its margin or the rounding, the greater, of a lone companion their sum",
    "[ladder]") {
  struct Answer : MotionOutcome<1, double> {};
  const std::vector<double> times{1, 5};
  std::vector<double> states(2);
  const auto solved = [&](Function beside, bool lone = false) {
    Answer answer;
    Run course{still, 1}, companion{beside, 1}, second{beside, 1};
    MotionOptions<double> options;
    options.tolerance = 1e-3;
    solve_beside(answer, PairWriter{}, Runs<Run>{course, companion, lone ? nullptr : &second},
                 {1.0, times, states, -1.0}, options,
                 [](const Errors<1>& size, double steps) noexcept { return steps * size; });
    return answer;
  };
  const double rounding = 10 * epsilon<double>;  // of 100 steps, of a column of size 1
  const auto near = [](double t) { return t > 4 ? 1 + 0x1p-20 : 1; };
  const double truncated = margin * 0x1p-20;
  const Answer loose = solved(near);
  CHECK(loose.error[0] == Approx(truncated / (1 - truncated)).epsilon(1e-12));
  CHECK(loose.met);
  CHECK(loose.counts.steps == 300);
  CHECK(solved(still).error[0] == Approx(rounding));
  // a lone companion may be near by chance
  const double both = truncated + rounding;
  CHECK(solved(near, true).error[0] == Approx(both / (1 - both)).epsilon(1e-12));
  CHECK(solved(off).error[0] == infinity<double>);
  CHECK_FALSE(solved(off).met);
}
