// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/full_lanes.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "../../models/rotor/bodies.hpp"
#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/rotor/inputs.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/ladder/sweep.hpp"
#include "ladder/rotor/truth.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

/// Scenes of all kinds that the lanes take, each with its own times.
struct LaneScenes {
  std::vector<Gyrostat<double>> bodies;
  std::vector<State<double>> starts;
  std::vector<std::vector<double>> times;

  explicit LaneScenes(std::size_t count, unsigned seed = 5) {
    Bodies random(seed);
    while (bodies.size() < count) {
      const std::size_t i = bodies.size();
      Gyrostat<double> body = random.realisable();
      State<double> start = random.start(body);
      if (i % 7 == 1) {  // slim
        const Mat3<double> R = to_matrix(random.attitude());
        const Mat3<double> theta = R * Vec3<double>(1e-4, 1, 1.00005).asDiagonal() * R.transpose();
        body = Gyrostat<double>::make((theta + theta.transpose()) / 2, R.col(0), 1e-5, 1e-6, 100).value();
        start = body.state(random.attitude(), R * Vec3<double>(3, 0.1, -0.2), 0);
      } else if (i % 7 == 2) {  // nearly symmetric
        body = Gyrostat<double>::make(Vec3<double>(2, 2 + 1e-9, 3).asDiagonal(), {0, 0, 1}, 0.3, 0.1, 4).value();
        start = body.state(random.attitude(), {1, 1e-7, 0.5}, 0);
      } else if (i % 7 == 3) {  // nearly at rest
        start.momentum *= 1e-9;
      } else if (i % 7 == 4) {  // free rotor, axes of the body
        body = Gyrostat<double>::make(Vec3<double>(2, 3, 4).asDiagonal(), {0.6, 0, 0.8}, 0.3, 0, 0).value();
        start = body.state(random.attitude(), random.direction(), random.uniform(-5, 5));
      }
      const double last = random.scale(1, 300) / turning_rate(body, start);
      std::vector<double> asked = i % 5 == 0 ? std::vector<double>{last} : std::vector<double>{0, last / 3, last};
      if (i % 11 == 0)
        for (int k = 1; k < 200; ++k) asked.insert(asked.end() - 1, last / 3 + last * k / 301);
      if (!suits_lanes(body, start, last, Integrator::any)) continue;
      bodies.push_back(body), starts.push_back(start), times.push_back(asked);
    }
  }

  struct Found {
    std::vector<State<double>> states;
    FullMotionAnswer<double> answer;
  };
  /// In this order, so many at a time.
  std::vector<Found> find(const std::vector<std::size_t>& order, std::size_t at_once, double tolerance) const {
    std::vector<Found> all(bodies.size());
    for (std::size_t begin = 0; begin < order.size(); begin += at_once) {
      std::vector<LaneTask> tasks;
      for (std::size_t n = begin; n < std::min(order.size(), begin + at_once); ++n) {
        const std::size_t i = order[n];
        all[i].states.resize(times[i].size());
        LaneTask task;
        task.gyrostat = &bodies[i];
        task.start = starts[i];
        task.times = times[i];
        task.states = all[i].states;
        task.options.tolerance = tolerance;
        tasks.push_back(task);
      }
      full_in_lanes(tasks);
      for (std::size_t n = begin; n < begin + tasks.size(); ++n) all[order[n]].answer = tasks[n - begin].answer;
    }
    return all;
  }
};

bool same_state(const State<double>& a, const State<double>& b) {
  const auto bits = [](const State<double>& s) {
    return std::array<double, 9>{s.attitude.w,  s.attitude.x,  s.attitude.y,     s.attitude.z, s.momentum[0],
                                 s.momentum[1], s.momentum[2], s.axial_momentum, s.rotor_angle};
  };
  return std::memcmp(bits(a).data(), bits(b).data(), 9 * sizeof(double)) == 0;
}

std::vector<std::size_t> in_turn(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  return order;
}

}  // namespace

TEST_CASE("motions in lanes are as near the truth as they say", "[rotor]") {
  const LaneScenes scenes(140);
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    const auto found = scenes.find(in_turn(140), 32, tolerance);
    int met = 0, known = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(tolerance, i);
      if (found[i].answer.status != ode::Status::reached) continue;
      ++known;
      met += found[i].answer.met;
      // by four digits more, one by one
      FullMotionOptions<double> fine;
      fine.tolerance = std::max(tolerance * 1e-4, 1e-13);
      std::vector<State<double>> right(scenes.times[i].size());
      const auto truth = full_motion<double>(scenes.bodies[i], scenes.starts[i], scenes.times[i], right, fine);
      REQUIRE(bool(truth));
      const Row<double> row(scenes.bodies[i], scenes.starts[i]);
      Comparison<Row<double>> apart(row);
      for (std::size_t n = 0; n < right.size(); ++n) apart.add(right[n], found[i].states[n]);
      const auto off = apart.relative(apart.difference());
      for (std::size_t c = 0; c < std::size(column_kinds); ++c)
        CHECK(off[c] <= found[i].answer.error[c] + truth->error[c]);
      CHECK(found[i].answer.met == (found[i].answer.error.greatest() <= tolerance));
      // the momentum is kept
      for (const State<double>& state : found[i].states) {
        const Vec3<double> L = rotate(scenes.starts[i].attitude, scenes.starts[i].momentum);
        CHECK((rotate(state.attitude, state.momentum) - L).norm() <=
              10 * found[i].answer.error[column::attitude] * L.norm() + 1e-14 * L.norm());
      }
    }
    CHECK(known == 140);
    CHECK(met > 80);
  }
}

TEST_CASE("a motion in a lane does not hang on those beside it", "[rotor]") {
  constexpr std::size_t count = 45;
  const LaneScenes scenes(count, 6);
  const auto alone = scenes.find(in_turn(count), 1, 1e-8);
  auto order = in_turn(count);
  std::reverse(order.begin(), order.end());
  std::rotate(order.begin(), order.begin() + 17, order.end());
  for (const std::size_t at_once : {std::size_t(3), std::size_t(8), count}) {
    const auto together = scenes.find(order, at_once, 1e-8);
    for (std::size_t i = 0; i < count; ++i) {
      CAPTURE(at_once, i);
      CHECK(together[i].answer.status == alone[i].answer.status);
      CHECK(together[i].answer.counts.steps == alone[i].answer.counts.steps);
      CHECK(together[i].answer.error.of == alone[i].answer.error.of);
      for (std::size_t n = 0; n < scenes.times[i].size(); ++n)
        CHECK(same_state(together[i].states[n], alone[i].states[n]));
    }
  }
}

TEST_CASE("lanes: the start alone, a caller that stops, no heap", "[rotor]") {
  const LaneScenes scenes(20, 7);
  std::vector<double> zero{0};
  std::vector<State<double>> states(1);
  LaneTask task;
  task.gyrostat = &scenes.bodies[0];
  task.start = scenes.starts[0];
  task.times = zero;
  task.states = states;
  full_in_lanes({&task, 1});
  CHECK(task.answer.status == ode::Status::reached);
  CHECK(task.answer.met);
  CHECK(same_state(states[0], scenes.starts[0]));
  full_in_lanes({});

  Monitor monitor;
  monitor.cancel = true;
  std::vector<double> late{9e4 / turning_rate(scenes.bodies[0], scenes.starts[0])};
  task.times = late;
  task.options.monitor = &monitor;
  full_in_lanes({&task, 1});
  CHECK(task.answer.status == ode::Status::cancelled);

  std::vector<LaneTask> tasks;
  std::vector<std::vector<State<double>>> room;
  for (std::size_t i = 0; i < 20; ++i) room.emplace_back(scenes.times[i].size());
  for (std::size_t i = 0; i < 20; ++i) {
    tasks.emplace_back();
    tasks[i].gyrostat = &scenes.bodies[i];
    tasks[i].start = scenes.starts[i];
    tasks[i].times = scenes.times[i];
    tasks[i].states = room[i];
  }
  const std::size_t before = allocations();
  full_in_lanes(tasks);
  CHECK(allocations() == before);
}

TEST_CASE("scenes that lanes do not suit", "[rotor]") {
  const Gyrostat<double> body = reference_body(0.05, 30);
  const State<double> start = body.state({}, {0.1, 0.2, 0.3}, 0);
  CHECK(suits_lanes(body, start, 10, Integrator::any));
  CHECK(suits_lanes(body, start, 10, Integrator::taylor));
  CHECK(!suits_lanes(body, start, 10, Integrator::radau));
  CHECK(!suits_lanes(body, start, 1e9, Integrator::any));
  CHECK(!suits_lanes(body, State<double>{}, 10, Integrator::any));
  CHECK(!suits_lanes(reference_body(1e4, 30), start, 10, Integrator::any));
}

TEST_CASE("rows of a rotor that are answered in lanes", "[rotor]") {
  // every seventh is no body, every fifth has a stiff motor, every eleventh rests
  constexpr std::size_t rows = 130;
  std::vector<double> numbers(input_width(input_kinds), gyrostat::nan<double>);
  const double body[] = {3.2, .1, -.15, .1, 4.1, .2, -.15, .2, 5};
  std::copy(std::begin(body), std::end(body), numbers.begin());
  const double rest[] = {.36, .48, .8, .35};
  std::copy(std::begin(rest), std::end(rest), numbers.begin() + 19);
  const double motor[] = {.05, 30., .1, .2, .3, -1., 0., 0., 0., 1.};
  std::copy(std::begin(motor), std::end(motor), numbers.begin() + 28);
  std::vector<double> moment, slope, rate, still;
  for (std::size_t i = 0; i < rows; ++i) {
    moment.push_back(i % 7 == 6 ? 99 : 3.2 + 1e-3 * double(i));
    slope.push_back(i % 5 == 4 ? 1e4 : 0.05);
    rate.push_back(0.1 + 1e-3 * double(i));
  }
  Question question;
  question.times = {5, 20};
  question.tolerance = 1e-7;
  question.asked = {{column::attitude}};
  const Varied varied[] = {{0, moment}, {28, slope}, {30, rate}};
  const auto posed = [&](std::span<const double> row) { return scene_of(row, question); };
  struct Swept {
    std::vector<double> values, errors;
    std::vector<SweepRow> told;
  };
  const auto run = [&](unsigned threads, const auto& solver) {
    Swept made{std::vector<double>(8 * rows), std::vector<double>(rows), std::vector<SweepRow>(rows)};
    const SweepTarget targets[] = {{column::attitude, false, 8, made.values, made.errors}};
    sweep(tables, numbers, varied, posed, solver, targets, made.told, threads);
    return made;
  };
  const Swept alone = run(1, &rotor::solve), one = run(1, SweepSolver{});
  int other = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    CAPTURE(i);
    CHECK(alone.told[i].reason == one.told[i].reason);
    CHECK(alone.told[i].rung == one.told[i].rung);
    CHECK(alone.told[i].warnings == one.told[i].warnings);
    CHECK(one.told[i].met == (i % 7 != 6));
    if (i % 7 == 6) continue;
    for (std::size_t n = 0; n < 8; ++n) {
      CHECK(std::abs(alone.values[8 * i + n] - one.values[8 * i + n]) <= alone.errors[i] + one.errors[i]);
      other += alone.values[8 * i + n] != one.values[8 * i + n];
    }
  }
  CHECK(other > 0);  // some were
  for (const unsigned threads : {2U, 5U, 64U}) {
    const Swept many = run(threads, SweepSolver{});
    CAPTURE(threads);
    CHECK(std::memcmp(many.values.data(), one.values.data(), 8 * rows * sizeof(double)) == 0);
    CHECK(std::memcmp(many.errors.data(), one.errors.data(), rows * sizeof(double)) == 0);
  }
}
