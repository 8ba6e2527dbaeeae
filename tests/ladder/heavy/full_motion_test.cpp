// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/full_motion.hpp"

#include <atomic>
#include <cmath>
#include <random>
#include <vector>

#include "allocations.hpp"
#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostat/models/heavy/exact.hpp"
#include "gyrostat/models/heavy/integrals.hpp"
#include "models/heavy/reference_table.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;
using ode::Status;

namespace {

template <Real S>
struct SolvedMotion {
  FullMotionAnswer<S> answer;
  std::vector<State<S>> states;
};

template <Real S>
SolvedMotion<S> solve(const Problem<S>& problem, const State<S>& start, const std::vector<S>& times, S tolerance,
                      bool attitude = false, FullMotionOptions<S> options = {}) {
  SolvedMotion<S> solved;
  solved.states.resize(times.size());
  options.tolerance = tolerance;
  options.attitude = attitude;
  const auto result = full_motion<S>(problem, start, times, solved.states, options);
  REQUIRE(result);
  solved.answer = *result;
  return solved;
}

std::vector<double> grid(double end, int n) {
  std::vector<double> times;
  for (int i = 0; i <= n; ++i) times.push_back(end * i / n);
  return times;
}

template <Real S>
void check_within(const ColumnErrors<S>& truth, const ColumnErrors<S>& stated) {
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) CHECK(truth[i] <= stated[i]);
}

State<long double> wide(const State<double>& s) {
  const auto& q = s.attitude;
  return {s.angular_velocity.cast<long double>(), s.down.cast<long double>(), {q.w, q.x, q.y, q.z}};
}

/// True errors of an answer, by the same equations in long double.
ColumnErrors<double> true_errors(const Problem<double>& problem, const State<double>& start,
                                 const std::vector<double>& times, const SolvedMotion<double>& solved, bool attitude) {
  const auto truth = solve<long double>(cast<long double>(problem), cast<long double>(start),
                                        {times.begin(), times.end()}, 1e-16L, attitude);
  REQUIRE(truth.answer.status == Status::reached);
  Comparison both(Row<long double>{});
  for (std::size_t i = 0; i < times.size(); ++i) both.add(truth.states[i], wide(solved.states[i]));
  const auto e = both.relative(both.difference());
  const auto& known = truth.answer.error;
  ColumnErrors<double> less;
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) less[i] = double(std::max(0.0L, e[i] - known[i]));
  return less;
}

}  // namespace

TEST_CASE("heavy: the full motion of the reference cases", "[heavy]") {
  const auto rows = reference_rows("motion");
  REQUIRE(rows.size() == 72);
  for (std::size_t first = 0; first < rows.size();) {
    const auto& head = rows[first];
    const auto vector = [](const ReferenceRow& row, std::size_t i) {
      return Vec3<double>(row.number[i], row.number[i + 1], row.number[i + 2]);
    };
    std::vector<double> times;
    std::vector<State<double>> right;
    std::size_t next = first;
    for (; next < rows.size() && rows[next].id == head.id; ++next) {
      times.push_back(rows[next].number[15]);
      right.push_back({vector(rows[next], 16), vector(rows[next], 19), {}});
    }
    CAPTURE(head.id);
    const State<double> start{vector(head, 9), vector(head, 12), {}};
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      CAPTURE(tolerance);
      const auto solved = solve(head.problem(), start, times, tolerance);
      REQUIRE(solved.answer.status == Status::reached);
      Comparison both(Row<double>{scales(head.problem(), start.angular_velocity.norm())});
      for (std::size_t i = 0; i < times.size(); ++i) both.add(right[i], solved.states[i]);
      const auto found = both.relative(both.difference());
      check_within(found, solved.answer.error);
      if (tolerance >= 1e-9) CHECK(solved.answer.met);
      // no better than it says, but for rounding
      if (tolerance >= 1e-9) CHECK(solved.answer.error.greatest() < std::max(100 * found.greatest(), 2e-12));
    }
    first = next;
  }
}

TEST_CASE("heavy: the stated errors are honest", "[heavy][length]") {
  Tops random(20);
  for (int i = 0; i < at_length(9, 24); ++i) {
    const auto p = random.body(i % 5 == 0 ? 0 : random.log_any(0.05, 2), i % 3 == 0 ? 0 : random.log_any(0.01, 1));
    auto s = random.start(random.log_any(0.1, 8));
    if (i % 8 == 6) s.angular_velocity.setZero();
    const auto times = grid(random.log_any(1, 15) * 2 * pi<double> / rate_size(p, s), 12);
    const bool attitude = i % 2 == 0;
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      CAPTURE(i, tolerance);
      const auto solved = solve(p, s, times, tolerance, attitude);
      REQUIRE(solved.answer.status == Status::reached);
      const auto found = true_errors(p, s, times, solved, attitude);
      check_within(found, solved.answer.error);
      if (solved.answer.met) CHECK(found.greatest() <= tolerance);
    }
  }
}

TEST_CASE("heavy: the estimate follows the growth of errors next to an unstable balance", "[heavy]") {
  // upright and a little off: the fall amplifies errors again and again
  const auto p = Problem<double>::make({1, 1.3, 1.6}, 1, {0, 0, 0.01}, 100, 0).value();
  State<double> s;
  s.down = Vec3<double>(1e-4, 2e-4, -1).normalized();
  for (const double end : {20.0, 60.0, 150.0}) {
    const auto times = grid(end, 7);
    for (const double tolerance : {1e-6, 1e-9}) {
      CAPTURE(end, tolerance);
      const auto solved = solve(p, s, times, tolerance);
      check_within(true_errors(p, s, times, solved, false), solved.answer.error);
    }
  }
}

TEST_CASE("heavy: next to a steady rotation that the weight makes unstable no companion lies near by chance",
          "[heavy]") {
  struct Case {
    Vec3<double> inertia, centre, rate, down;
    double end;
  };
  const Case cases[] = {{{0.4723347891518149, 0.7336284533058418, 0.8703335112571293},
                         {0, 0, -0.28966779731294234},
                         {5.291582598977839e-9, 3.057052192679298e-8, -1.714281507131344},
                         {0, 0, 1},
                         35.61},
                        {{0.43943612903003065, 0.6974870124461867, 0.8973235966165313},
                         {0, 0, 0.24474453255368445},
                         {-8.243996216252782e-8, -8.049137596095607e-8, 1.964183754368513},
                         {0, 0, -1},
                         177.12},
                        {{0.5287348293411975, 0.7651353459977667, 1.0698717513192018},
                         {0.0480002820146792, 0.056191647205059765, 0.23399983660614934},
                         {-0.17857050577432254, -0.1951500050506159, -0.748534183455418},
                         {-0.2249287159048317, -0.24581237451654736, -0.9428591354470403},
                         8.88},
                        {{0.46903442290131114, 0.626692809351128, 0.954802802803002},
                         {-0.019514834958424137, 0.00799487837284808, -0.18754083515626496},
                         {-0.8669716098736369, 0.15260652685281992, -1.636872411093925},
                         {0.4664725533080872, -0.08210969745867455, 0.8807163871493926},
                         18.54350541174087}};
  for (const auto& c : cases) {
    const auto p = Problem<double>::make(c.inertia, 1, c.centre, 9.80665, 0).value();
    State<double> s;
    s.angular_velocity = c.rate, s.down = c.down.normalized();
    for (const double tolerance : {1e-2, 1e-4, 1e-5, 1e-6, 1e-7}) {
      CAPTURE(c.end, tolerance);
      const std::vector<double> times{c.end};
      const auto solved = solve(p, s, times, tolerance);
      check_within(true_errors(p, s, times, solved, false), solved.answer.error);
    }
  }
}

TEST_CASE("heavy: a plane swing beside its separatrix is not near its companions by chance", "[heavy][length]") {
  // What is kept of the energy decides how late it passes the top: one number. A lone companion was as far off it as the answer in 65 of 16 000.
  std::mt19937_64 random(1);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto scale = [&](double low, double high) { return std::exp(any(std::log(low), std::log(high))); };
  const double g = 9.80665;
  int wrong = 0, answers = 0;
  for (int i = 0; i < at_length(350, 700); ++i) {
    const double a = any(0.03, 1), b = any(0.03, 1), c = any(0.03, 1);
    const Vec3<double> I = scale(1e-4, 1) * Vec3<double>(b + c, a + c, a + b);
    const Vec3<double> centre = std::sqrt(scale(1e-3, 0.9) * I[1]) * Vec3<double>(1, 0, 0);
    const auto problem = Problem<double>::make(I, 1, centre, g, 0);
    if (!problem) continue;
    const double square = g * centre[0] / I[0], angle = any(-3, 3),
                 off = (any(-1, 1) < 0 ? -1 : 1) * scale(1e-13, 1e-2);
    State<double> start;
    start.down = Vec3<double>(std::cos(angle), std::sin(angle), 0).normalized();
    start.angular_velocity = {0, 0, std::sqrt(2 * g * centre[0] * (1 + start.down[0]) / I[2]) * (1 + off)};
    const std::vector<double> times{(std::log(1 / std::abs(off)) / 2 + 3) / std::sqrt(square) * any(0.3, 3)};
    const auto solved = solve(*problem, start, times, 1e-6);
    const auto off_by = true_errors(*problem, start, times, solved, false);
    wrong += off_by[column::down] > solved.answer.error[column::down];
    ++answers;
  }
  CHECK(answers > at_length(300, 600));
  CHECK(wrong == 0);
}

TEST_CASE("heavy: down and attitude belong together", "[heavy]") {
  Tops random(5);
  for (int i = 0; i < 8; ++i) {
    const auto p = random.body();
    const auto s = random.start(3);
    const auto times = grid(30, 20);
    const auto with = solve(p, s, times, 1e-12, true), without = solve(p, s, times, 1e-12);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto& at = with.states[k];
      CHECK((at.down - rotate<double>(conjugate(at.attitude), {0, 0, -1})).norm() < 1e-12);
      CHECK(norm(at.attitude) == Approx(1).epsilon(1e-15));
      CHECK((at.down - without.states[k].down).norm() < 1e-10);
      CHECK(without.states[k].attitude == Quat<double>{});
    }
    CHECK(without.answer.error[column::attitude] == 0);
  }
}

namespace {

/// To rounding: what is projected errs by a few roundings of its terms however long the motion is; the fourth integral, which is not, by
/// what a random walk of one rounding of its terms a step makes, and in all by less than 1e-13 of itself (of Goryachev and Chaplygin, where
/// terms cancel, of these).
void check_integrals(double revolutions, double tolerance) {
  struct Case {
    FourthCase kind;
    Vec3<double> inertia, centre;
    double gradient;
  };
  for (const Case& c : {Case{FourthCase::euler, {1, 1.2, 1.5}, {0, 0, 0}, 0},
                        {FourthCase::lagrange, {1.3, 1.3, 0.7}, {0, 0, -0.8}, 0.6},
                        {FourthCase::lagrange, {1.1, 1.1, 1.1}, {0.3, -0.4, 0.5}, 0.6},
                        {FourthCase::clebsch, {1, 1.2, 1.5}, {0, 0, 0}, 0.6},
                        {FourthCase::kovalevskaya, {1.2, 1.2, 0.6}, {0.24, -0.32, 0}, 0},
                        {FourthCase::goryachev_chaplygin, {1.2, 1.2, 0.3}, {-0.24, 0.32, 0}, 0},
                        {FourthCase::none, {1, 1.2, 1.5}, {0.3, 0.2, 0.4}, 0.3}})
    for (const bool attitude : {false, true}) {
      const auto p = Problem<double>::make(c.inertia, 1, 0.01 * c.centre, 980, c.gradient).value();
      State<double> start;
      start.angular_velocity = {0.9, 0.6, 3};
      start.attitude = normalised(Quat<double>{0.2, 0.4, -0.7, 0.3});
      start.down = rotate<double>(conjugate(start.attitude), {0, 0, -1});
      if (c.kind == FourthCase::goryachev_chaplygin) {
        const Vec3<double> Id = p.inertia().cwiseProduct(start.down);
        start.angular_velocity -= start.down * (Id.dot(start.angular_velocity) / Id.dot(start.down));
      }
      const FourthIntegral<double> fourth(p, start);
      REQUIRE(fourth.kind() == c.kind);
      const auto times = grid(revolutions * 2 * pi<double> / rate_size(p, start), 400);
      const auto solved = solve(p, start, times, tolerance, attitude);
      REQUIRE(solved.answer.status == Status::reached);

      double rate = 0, momentum = 0, energy = 0;
      for (const auto& s : solved.states) {
        const Vec3<double> Iw = p.inertia().cwiseProduct(s.angular_velocity);
        rate = std::max(rate, s.angular_velocity.norm());
        momentum = std::max(momentum, Iw.norm());
        energy = std::max(energy, Iw.dot(s.angular_velocity) / 2);
      }
      energy += p.moment().norm() + p.gradient() * p.inertia().maxCoeff() / 2;
      const double pull = p.moment().norm() / p.inertia().minCoeff();
      const double terms = c.kind == FourthCase::lagrange              ? rate
                           : c.kind == FourthCase::kovalevskaya        ? std::pow(rate * rate + pull, 2)
                           : c.kind == FourthCase::goryachev_chaplygin ? rate * (rate * rate + pull)
                                                                       : momentum * momentum;
      CAPTURE(int(c.kind), attitude, solved.answer.counts.steps);
      const auto at_start = integrals(p, start);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const auto& s = solved.states[i];
        const auto now = integrals(p, s);
        CAPTURE(i);
        CHECK(std::abs(now.energy - at_start.energy) < 1e-15 * energy);
        CHECK(std::abs(now.vertical_momentum - at_start.vertical_momentum) < 1e-15 * momentum);
        CHECK(std::abs(now.down_squared - 1) < 2e-15);
        if (attitude) CHECK((s.down - rotate<double>(conjugate(s.attitude), {0, 0, -1})).norm() < 2e-15);
        if (c.kind == FourthCase::none) continue;
        // of three runs alike
        const double steps = double(solved.answer.counts.steps) / 3 * times[i] / times.back();
        const double moved = std::abs(fourth(s) - fourth(start));
        CHECK(moved <= epsilon<double> * (8 + std::sqrt(steps)) * terms);
        CHECK(moved < 3e-14 * terms);
        if (c.kind != FourthCase::goryachev_chaplygin) CHECK(moved < 1e-13 * std::abs(fourth(start)));
      }
    }
}

}  // namespace

TEST_CASE("heavy: all integrals to rounding over two hundred revolutions", "[heavy]") { check_integrals(200, 1e-13); }
TEST_CASE("heavy: all integrals to rounding over a thousand and ten thousand revolutions", "[heavy][.long]") {
  check_integrals(1e3, 1e-13);
  check_integrals(1e4, 1e-12);
}

TEST_CASE("heavy: the exact motion of a top and the full equations agree to 1e-13", "[heavy]") {
  for (const double gradient : {0.0, 30.0, 300.0})
    for (const double z0 : {0.03, -0.03})
      for (const double along : {0.001, 0.0025})
        for (const double spin : {150.0, -60.0, 12.0})
          for (const double tilt : {0.6, 1.5, 2.7}) {
            CAPTURE(gradient, z0, along, spin, tilt);
            const auto p = Problem<double>::make({0.002, 0.002, along}, 0.5, {0, 0, z0}, 9.80665, gradient).value();
            State<double> start;
            start.angular_velocity = {1, 2, spin};
            start.attitude = Quat<double>{0.8, 0, 0, -0.6} * Quat<double>{std::cos(tilt / 2), std::sin(tilt / 2), 0, 0};
            start.down = rotate<double>(conjugate(start.attitude), {0, 0, -1});
            const Exact<double> exact(p, start);
            REQUIRE(exact.which() == ExactCase::lagrange);
            const auto times = grid(10 * 2 * pi<double> / rate_size(p, start), 20);
            const auto full = solve(p, start, times, 1e-12, true);
            Comparison both(Row<double>{});
            for (std::size_t i = 0; i < times.size(); ++i) both.add(exact.at(times[i]), full.states[i]);
            CHECK(both.relative(both.difference()).greatest() < 1e-13);
          }
}

TEST_CASE("heavy: time reversed, the full motion returns", "[heavy]") {
  Tops random(12);
  int tame = 0;
  for (int i = 0; i < 12; ++i) {
    const auto p = random.body();
    const auto start = random.start(random.log_any(0.5, 8));
    const double end = 10 * 2 * pi<double> / rate_size(p, start);
    const auto there = solve(p, start, {end}, 1e-13, true);
    State<double> turned = there.states[0];
    turned.angular_velocity *= -1;
    const auto back = solve(p, turned, {end}, 1e-13, true);
    State<double> home = back.states[0];
    home.angular_velocity *= -1;
    Comparison both(Row<double>{});
    both.add(start, home);
    const auto apart = both.relative(both.difference());
    const auto &to = there.answer.error, &fro = back.answer.error;
    CHECK(apart[column::angular_velocity] <= to[column::angular_velocity] + fro[column::angular_velocity]);
    CHECK(apart[column::down] <= to[column::down] + fro[column::down]);
    CHECK(apart[column::attitude] <= to[column::attitude] + fro[column::attitude]);
    tame += to.greatest() < 1e-11;
    if (to.greatest() < 1e-11) CHECK(apart.greatest() < 1e-13);
  }
  CHECK(tame > 8);
}

TEST_CASE("heavy: axes called otherwise, the full motion is the same", "[heavy]") {
  Mat3<double> cyclic, odd;
  cyclic << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  odd << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  const Mat3<double> one = Mat3<double>::Identity();
  const Mat3<double> mirror = Vec3<double>(1, -1, 1).asDiagonal();
  struct Renamed {
    Mat3<double> axes;   ///< new components of a vector from old ones
    Mat3<double> space;  ///< and in the inertial frame, the vertical kept
  };
  Tops random(13);
  // an odd permutation keeps the hand where all axes are reversed too; else the motion is the mirrored one, rates turn round
  for (const auto& [axes, space] : {Renamed{cyclic, one}, {cyclic * cyclic, one}, {-odd, one}, {odd, mirror}})
    for (int i = 0; i < 6; ++i) {
      const auto p = random.body();
      const auto start = random.start(random.log_any(0.5, 8));
      const auto times = grid(10 * 2 * pi<double> / rate_size(p, start), 10);
      const auto renamed = [&axes = axes, &space = space](const State<double>& s) {
        const Mat3<double> R = space * to_matrix(s.attitude) * axes.transpose();
        return State<double>{axes.determinant() * (axes * s.angular_velocity), axes * s.down, from_matrix<double>(R)};
      };
      const auto other = Problem<double>::make(axes.cwiseAbs() * p.inertia(), p.mass(), axes * p.centre_of_mass(),
                                               p.gravity(), p.gradient())
                             .value();
      const auto straight = solve(p, start, times, 1e-12, true),
                 renaming = solve(other, renamed(start), times, 1e-12, true);
      Comparison both(Row<double>{});
      for (std::size_t k = 0; k < times.size(); ++k) both.add(renamed(straight.states[k]), renaming.states[k]);
      const auto apart = both.relative(both.difference());
      CHECK(apart.greatest() < 1e-12);
      CHECK(apart[column::angular_velocity] <=
            straight.answer.error[column::angular_velocity] + renaming.answer.error[column::angular_velocity]);
      CHECK(apart[column::down] <= straight.answer.error[column::down] + renaming.answer.error[column::down]);
      CHECK(apart[column::attitude] <=
            straight.answer.error[column::attitude] + renaming.answer.error[column::attitude]);
    }
}

TEST_CASE("heavy: nothing acts, nothing moves", "[heavy]") {
  const auto p = Problem<double>::make({1, 1.2, 1.5}, 1, {0, 0, 0.01}, 100, 0).value();
  State<double> s;
  s.down = {0, 0, 1};
  s.attitude = {0, 1, 0, 0};
  const auto solved = solve(p, s, {0, 1, 1e4}, 1e-12, true);
  CHECK(solved.answer.met);
  CHECK(solved.answer.error[column::angular_velocity] == 0);
  CHECK(solved.states[2].down == s.down);
}

TEST_CASE("heavy: float works within its digits", "[heavy]") {
  Tops random(6);
  const auto p = random.body();
  const auto s = random.start();
  const auto truth = solve(p, s, {0.0, 10.0}, 1e-10);
  const auto solved = solve<float>(cast<float>(p), cast<float>(s), {0.0F, 10.0F}, 1e-2F);
  CHECK(solved.answer.met);
  CHECK((solved.states[1].down.cast<double>() - truth.states[1].down).norm() < 1e-3);
}

TEST_CASE("heavy: a motion can be watched, stopped and capped", "[heavy]") {
  Tops random(7);
  const auto p = random.body();
  const auto s = random.start();
  const std::vector<double> times{0, 1, 400};
  Monitor monitor;
  FullMotionOptions<double> options;
  options.monitor = &monitor;
  CHECK(solve(p, s, times, 1e-3, false, options).answer.status == Status::reached);
  CHECK(monitor.fraction == 1.0);
  monitor.cancel = true;
  const auto cancelled = solve(p, s, times, 1e-3, false, options);
  CHECK(cancelled.answer.status == Status::cancelled);
  CHECK(!cancelled.answer.met);

  options.monitor = nullptr;
  options.step_cap = 20;
  const auto capped = solve(p, s, times, 1e-3, false, options);
  CHECK(capped.answer.status == Status::step_limit);
  CHECK(capped.states[0].down.allFinite());
  CHECK(!capped.states[2].down.allFinite());
  CHECK(std::isnan(capped.answer.error.greatest()));
  CHECK(!capped.answer.met);
}

TEST_CASE("heavy: bad requests are refused", "[heavy]") {
  Tops random(8);
  const auto p = random.body();
  const auto good = random.start();
  std::vector<State<double>> states(2);
  const auto error = [&](const State<double>& s, std::vector<double> times, bool attitude = true) {
    FullMotionOptions<double> options;
    options.attitude = attitude;
    return full_motion<double>(p, s, times, states, options).error();
  };
  CHECK(error(good, {0.0, 1.0}) == Errc::ok);
  CHECK(error(good, {1.0, 0.0}) == Errc::not_increasing);
  CHECK(error(good, {-1.0, 0.0}) == Errc::not_increasing);
  CHECK(error(good, {0.0, gyrostat::nan<double>}) == Errc::not_finite);
  CHECK(error(good, {0.0}) == Errc::out_of_domain);
  for (const double bad : {gyrostat::nan<double>, gyrostat::infinity<double>}) {
    auto s = good;
    s.angular_velocity[0] = bad;
    CHECK(error(s, {0.0, 1.0}) == Errc::not_finite);
    s = good;
    s.down[1] = bad;
    CHECK(error(s, {0.0, 1.0}) == Errc::not_finite);
    s = good;
    s.attitude.y = bad;
    CHECK(error(s, {0.0, 1.0}) == Errc::not_finite);
    CHECK(error(s, {0.0, 1.0}, false) == Errc::ok);
  }
  auto s = good;
  s.down.setZero();
  CHECK(error(s, {0.0, 1.0}) == Errc::zero_vector);
  s = good;
  s.attitude = {0, 0, 0, 0};
  CHECK(error(s, {0.0, 1.0}) == Errc::zero_vector);
  s = good;
  s.down *= -1;
  CHECK(error(s, {0.0, 1.0}) == Errc::out_of_domain);
}

TEST_CASE("heavy: the full motion does not touch the heap", "[heavy]") {
  Tops random(9);
  const auto p = random.body();
  const auto s = random.start();
  const auto times = grid(10, 3);
  std::vector<State<double>> states(times.size());
  FullMotionOptions<double> options;
  options.attitude = true;
  const auto before = allocations();
  const auto result = full_motion<double>(p, s, times, states, options);
  CHECK(allocations() == before);
  CHECK(result);
}
