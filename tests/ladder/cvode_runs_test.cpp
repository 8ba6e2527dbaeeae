// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/cvode_runs.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

struct Row {
  using Scalar = double;
  using State = double;
  static constexpr ColumnKind columns[] = {{"x", 1, "m", Frame::none, Measure::relative, ""}};
  void operator()(double x, double* row) const noexcept { *row = x; }
};

/// x' = -x from 1.
struct Decay {
  std::array<double, 1> start() const { return {1}; }
  double state(const double* y) const { return y[0]; }
  ode::CvodeSystem system() {
    ode::CvodeSystem made;
    made.dimension = 1;
    made.rhs = [](double, const double* y, double* out, void*) { return out[0] = -y[0], true; };
    made.user = this;
    return made;
  }
};

CvodeRun<double> run(double tolerance, std::span<const double> times) {
  Decay equations;
  return run_cvode(equations, 1.0, times, {ode::CvodeMethod::adams, tolerance, tolerance}, nullptr);
}

CvodeRuns<Row> runs_at(double tolerance, const std::vector<double>& asked) {
  return cvode_runs(Row{}, asked, tolerance, 1e-3,
                    [](std::span<const double> times, const CvodeTask& task) { return run(task.tolerance, times); });
}

}  // namespace

TEST_CASE("one run gives the states at the asked times, the start as it stands", "[ladder]") {
  const double times[] = {0, 1, 2};
  const auto made = run(1e-10, times);
  REQUIRE(made.failure == Errc::ok);
  REQUIRE(made.states.size() == 3);
  CHECK(made.states[0] == 1);
  CHECK(made.states[2] == Approx(std::exp(-2.0)).epsilon(1e-8));
  CHECK(run(1e-10, std::span(times).first(1)).states == std::vector<double>{1});
}

TEST_CASE("runs at tolerances apart give an error that holds", "[ladder]") {
  const std::vector<double> times{0, 1, 2, 5};
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto runs = runs_at(tolerance, times);
    REQUIRE(runs.failure == Errc::ok);
    REQUIRE(runs.states.size() == times.size());
    CHECK(runs.tolerance == Approx(std::max(1e-3 * tolerance, honesty::cvode_tightest)));
    const double stated = runs.error[0] + runs.tolerance;
    double error = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      error = std::max(error, std::abs(runs.states[i] - std::exp(-times[i])));
    CAPTURE(tolerance, error, stated);
    CHECK(error <= stated);
    CHECK(stated < tolerance);
  }
  CHECK(runs_at(1e-12, times).margin[0] == honesty::cvode_margin_of_rounding);
}

TEST_CASE("a run that fails leaves no states", "[ladder]") {
  const auto runs = cvode_runs(Row{}, std::vector<double>{1.0}, 1e-6, 1, [](auto, const CvodeTask&) {
    CvodeRun<double> none;
    none.failure = Errc::step_limit;
    return none;
  });
  CHECK(runs.failure == Errc::step_limit);
  CHECK(runs.states.empty());
}

TEST_CASE("what runs differ by is not hidden where they meet at the one time that is asked for", "[ladder]") {
  const std::vector<double> asked{10};
  const auto swinging = [](std::span<const double> times, const CvodeTask& task) {
    CvodeRun<double> made;
    for (const double t : times) made.states.push_back(task.change > 0 ? 1e-6 * std::sin(pi<double> * t) : 0);
    return made;
  };
  const auto runs = cvode_runs(Row{}, asked, 1e-3, 1e-3, swinging);
  CHECK(runs.states == std::vector<double>{0});
  CHECK(runs.error[0] > honesty::cvode_margin * 5e-7);
  CHECK(runs.asked.size()[0] == 0);
}

TEST_CASE("where one companion is near by chance the other counts", "[ladder]") {
  for (const int away : {0, 1}) {
    const auto near = [&](std::span<const double> times, const CvodeTask& task) {
      CvodeRun<double> made;
      made.states.assign(times.size(), task.change > 0 && (task.aside == Aside::first) == (away == 0) ? 1e-6 : 0);
      return made;
    };
    const auto runs = cvode_runs(Row{}, std::vector<double>{10}, 1e-3, 1e-3, near);
    CAPTURE(away);
    CHECK(runs.error[0] == Approx(1e-6 * runs.margin[away]));
    CHECK(runs.margin[away] == Approx(honesty::cvode_margin * honesty::cvode_looser[0] / honesty::cvode_looser[away]));
  }
}

namespace {

/// As Row, of motions that have parted where they are more than 0.5 apart.
struct PartingRow : Row {
  template <class Numbers>
  bool has_parted(const Numbers& a, const Numbers& b) const noexcept {
    return std::abs(a[0] - b[0]) > 0.5;
  }
};

}  // namespace

TEST_CASE("runs that have parted and come back are seen", "[ladder]") {
  const auto error_of = [](auto row, double bump) {
    return cvode_runs(row, std::vector<double>{10.0}, 1e-6, 1,
                      [&](std::span<const double> times, const CvodeTask& task) {
                        CvodeRun<double> made;
                        for (const double t : times)
                          made.states.push_back(1 + (task.change > 0 && t > 3 && t < 4 ? bump : 0));
                        return made;
                      })
        .error[0];
  };
  CHECK(error_of(PartingRow{}, 0.6) >= 0.6);
  CHECK(error_of(PartingRow{}, 0.4) == 0);
  CHECK(error_of(Row{}, 0.6) == 0);
}
