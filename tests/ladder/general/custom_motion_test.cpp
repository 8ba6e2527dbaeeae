// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/custom_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <vector>

#include "../../allocations.hpp"
#include "../../models/general/laws.hpp"
#include "../../models/general/truth.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/comparison.hpp"

namespace general_custom_motion_test {

using namespace gyrostat;
using namespace gyrostat::general;
using ode::Status;

struct CustomRun {
  CustomMotionAnswer<double> answer;
  std::vector<State<double>> states;
};

template <class Law>
CustomRun run(const Problem<double>& problem, const Law& law, const std::vector<double>& named,
              const std::vector<double>& times, double tolerance) {
  CustomRun made;
  made.states.resize(times.size());
  MotionOptions<double> options;
  options.tolerance = tolerance, options.step_cap = 1'000'000;
  const auto answer = custom_motion<double>(problem, law, named, times, made.states, options);
  REQUIRE(answer);
  made.answer = *answer;
  return made;
}

/// By the scales that custom_motion() takes.
template <class Law>
FullErrors<double> apart(const Problem<double>& problem, const Law& law, const std::vector<double>& times,
                         const std::vector<State<double>>& one, const std::vector<State<double>>& two) {
  Vec3<double> torque;
  REQUIRE(general::detail::ask_at_start(problem, law, torque) == LawFault::none);
  const auto sized = general::detail::pushed_by(problem, torque);
  const Prepared<double> of(sized, times.back());
  Comparison both{FullRow<double>(of)};
  for (std::size_t i = 0; i < one.size(); ++i) both.add(one[i], two[i]);
  return both.relative(both.difference());
}

template <class Law = NoTorque>
std::vector<State<double>> truth(const Problem<double>& problem, const std::vector<double>& times, const Law& law = {},
                                 const std::vector<double>& named = {}) {
  const std::vector<long double> wide(times.begin(), times.end());
  std::vector<State<double>> made;
  const auto of = general_truth::cast<long double>(problem);
  for (const auto& state : general_truth::motion<long double>(of, wide, 1e-17L, 60'000, law, named))
    made.push_back(general_truth::cast<double>(state));
  return made;
}

Problem<double> brick() {
  Problem<double> made;
  made.inertia = Vec3<double>(3, 4, 5).asDiagonal();
  made.angular_velocity = {0.3, -0.5, 0.8};
  made.attitude = normalised(Quat<double>{0.9, 0.1, -0.2, 0.3});
  return made;
}

Problem<double> with_torque(TorqueType type, const Vec3<double>& vector) {
  Problem<double> made = brick();
  auto& torque = made.torques.emplace_back();
  torque.type = type, torque.vector = vector;
  return made;
}

const std::vector<double> times{0, 1, 4, 10, 30};
constexpr double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-11};

/// A law against the same torque of the library's, by another integrator in another precision.
template <class Law>
void check_as_built_in(const Problem<double>& without, const Problem<double>& with, const Law& law) {
  const auto right = truth(with, times);
  REQUIRE(right.size() == times.size());
  for (const double tolerance : tolerances) {
    const auto made = run(without, law, {}, times, tolerance);
    REQUIRE(made.answer.status == Status::reached);
    CHECK(made.answer.met);
    const auto error = apart(without, law, times, right, made.states);
    for (std::size_t k = 0; k < std::size(full_columns); ++k) {
      CAPTURE(tolerance, full_columns[k].name, error[k], made.answer.error[k]);
      CHECK(error[k] <= made.answer.error[k]);
    }
  }
}

TEST_CASE("a law is answered as the same torque of the library's is", "[general]") {
  const Vec3<double> c(0.1, -0.2, 0.05), B(2e-5, -1e-5, 3e-5);
  check_as_built_in(brick(), with_torque(TorqueType::constant, c),
                    [&](double, const Seen<double>&) noexcept { return c; });

  Mat3<double> D;
  D << 0.2, 0.05, 0, 0, 0.3, -0.04, 0.1, 0, 0.15;
  auto damped = with_torque(TorqueType::damping, {0, 0, 0});
  damped.torques[0].matrix = D;
  check_as_built_in(brick(), damped,
                    [&](double, const Seen<double>& s) noexcept -> Vec3<double> { return -(D * s.angular_velocity); });
  damped.torques[0].opposed = Opposed::momentum;
  check_as_built_in(brick(), damped,
                    [&](double, const Seen<double>& s) noexcept -> Vec3<double> { return -(D * s.angular_momentum); });

  auto magnet = with_torque(TorqueType::magnetic, {1e4, -2e4, 5e3});
  magnet.field.magnetic = MagneticField::uniform, magnet.field.flux_density = B;
  check_as_built_in(brick(), magnet, [&](double, const Seen<double>& s) noexcept {
    return cross<double>({1e4, -2e4, 5e3}, rotate<double>(conjugate(s.attitude), B));
  });

  auto top = with_torque(TorqueType::weight, {0, 0, 0});
  top.fixed = true, top.mass = 2, top.centre_of_mass = {0.01, 0.02, 0.1}, top.field.gravity = 9.8;
  auto held = top;
  held.torques.clear();
  check_as_built_in(held, top, [&](double, const Seen<double>& s) noexcept {
    return cross<double>(Vec3<double>(2 * 9.8 * top.centre_of_mass),
                         rotate<double>(conjugate(s.attitude), Vec3<double>(0, 0, -1)));
  });
}

TEST_CASE("a law beside wheels of every kind", "[general]") {
  auto with = with_torque(TorqueType::damping, {0, 0, 0});
  for (int i = 0; i < 6; ++i) {
    Wheel<double> wheel;
    wheel.type = static_cast<WheelType>(i);
    wheel.axis = Vec3<double>(1, 0.3 * i, 2 - i).normalized();
    wheel.axial_inertia = 0.02 * (i + 1);
    wheel.rate = wheel.type == WheelType::locked ? 0 : 20 - 5 * i;
    if (wheel.type == WheelType::torque) wheel.torque = 0.02;
    if (wheel.type == WheelType::motor) wheel.slope = 0.01, wheel.no_load_rate = 30;
    if (wheel.type == WheelType::friction) wheel.friction = 0.003;
    if (wheel.type == WheelType::held) {
      wheel.table.times = {0, 3, 12}, wheel.table.values = {5, -5, 10};
      wheel.table.holds = true;
    }
    with.wheels.push_back(wheel);
  }
  with.torques[0].matrix = 0.3 * Mat3<double>::Identity();
  auto without = with;
  without.torques.clear();
  check_as_built_in(without, with,
                    [](double, const Seen<double>& s) noexcept -> Vec3<double> { return -0.3 * s.angular_velocity; });
}

TEST_CASE("the error of a custom motion falls as its steps are tightened", "[general]") {
  const auto law = [](auto t, const auto& s) noexcept {
    using S = std::remove_cvref_t<decltype(t)>;
    return Vec3<S>(S(0.3) * std::sin(2 * t), s.attitude.x * s.angular_velocity[1], -S(0.1) * s.angular_velocity.norm());
  };
  const auto problem = brick();
  const auto right = truth(problem, times, law);
  double error[2], step[2];
  for (int i = 0; i < 2; ++i) {
    const auto made = run(problem, law, {}, times, i == 0 ? 1e-7 : 1e-11);
    error[i] = std::log(apart(problem, law, times, right, made.states).greatest());
    step[i] = std::log(made.answer.step_tolerance);
  }
  // the tolerance is that of a step
  CHECK((error[0] - error[1]) / (step[0] - step[1]) == Approx(1).margin(0.2));
}

TEST_CASE("a step of a law, named and not", "[general]") {
  general_laws::Mixed law;
  law.push = {0.1, 0, 0.05}, law.phase = 1.2, law.frequency = 0.4;
  law.kick = {0, 0.4, -0.3}, law.kick_time = 7.3;
  const auto problem = brick();
  const auto right = truth(problem, times, law, {7.3});
  for (const double tolerance : tolerances) {
    const auto named = run(problem, law, {7.3}, times, tolerance), unnamed = run(problem, law, {}, times, tolerance);
    const auto twice = run(problem, law, {7.3, std::nextafter(7.3, 8.)}, times, tolerance);
    for (const CustomRun* made : {&named, &unnamed, &twice}) {
      REQUIRE(made->answer.status == Status::reached);
      const auto error = apart(problem, law, times, right, made->states);
      for (std::size_t k = 0; k < std::size(full_columns); ++k) {
        CAPTURE(tolerance, made == &named, full_columns[k].name, error[k], made->answer.error[k]);
        CHECK(error[k] <= made->answer.error[k]);
      }
    }
    CHECK(named.answer.met);
    CHECK(twice.answer.met);
    CHECK(named.answer.counts.rejected < unnamed.answer.counts.rejected);
  }
}

TEST_CASE("each of two times of a table that are neighbours among the doubles has its own value", "[general]") {
  auto problem = brick();
  auto& wheel = problem.wheels.emplace_back();
  wheel.type = WheelType::held, wheel.axial_inertia = 0.1;
  // at the later one, where the table ends, by what follows it
  const double now = 1, next = std::nextafter(now, 2.);
  wheel.table = {{0, now, next}, {10, -25, -4}, Between::linear, false};
  const auto made = run(problem, NoTorque{}, {}, {0, 0.5, now, next, 2}, 1e-9);
  CHECK(made.answer.status == Status::reached);
  const auto rate = [&](std::size_t i) { return made.states[i].rotor_rate[0]; };
  CHECK(rate(1) == Approx(-7.5));
  CHECK(rate(2) == Approx(-25));
  CHECK(rate(3) == 0);
  CHECK(rate(4) == 0);
}

TEST_CASE("a law without a value ends the motion where it has none", "[general]") {
  const auto law = [](double t, const Seen<double>&) noexcept {
    return Vec3<double>(t < 5.5 ? 0.1 : gyrostat::nan<double>, 0, 0);
  };
  const auto made = run(brick(), law, {}, times, 1e-8);
  CHECK(made.answer.status == Status::not_finite);
  CHECK(made.answer.fault == LawFault::no_value);
  CHECK(made.answer.fault_time == Approx(5.5).epsilon(1e-9));
  CHECK(!made.answer.met);
  CHECK(made.states[2].angular_velocity.allFinite());
  CHECK(std::isnan(made.states[3].angular_velocity[0]));

  const auto never = run(
      brick(), [](double, const Seen<double>&) noexcept { return Vec3<double>(0, infinity<double>, 0); }, {}, times,
      1e-8);
  CHECK(never.answer.fault == LawFault::no_value);
  CHECK(never.answer.fault_time == 0);

  // of a state that no step need reach
  const auto edge = [](double, const Seen<double>& s) noexcept {
    return Vec3<double>(std::sqrt(1.02 - s.angular_velocity.norm()) * 0.01, 0, 0);
  };
  const auto near = run(brick(), edge, {}, {0, 1, 2}, 1e-8);
  CHECK(near.answer.status == Status::reached);
}

TEST_CASE("DOP853 does not hold a body on an unstable axis", "[general]") {
  for (int i = 0; i < 20; ++i) {
    const Mat3<double> R = to_matrix(as_unit(Quat<double>{0.3, 0.005 * i, 0.7, 0.4}));
    Problem<double> p;
    const Mat3<double> J = R * Vec3<double>(1, 2, 3).asDiagonal() * R.transpose();
    p.inertia = (J + J.transpose()) / 2;
    p.angular_velocity = R * Vec3<double>(0, 1, 0);
    CAPTURE(i);
    const auto made = run(p, NoTorque{}, {}, {120}, 1e-4);
    CHECK(!made.answer.met);
    CHECK(made.answer.error[full_column::angular_velocity] > 0.1);
  }
}

TEST_CASE("a law that is no function is refused", "[general]") {
  int asked = 0;
  const auto law = [&asked](double, const Seen<double>&) noexcept { return Vec3<double>(0.1 * ++asked, 0, 0); };
  const auto made = run(brick(), law, {}, times, 1e-8);
  CHECK(made.answer.fault == LawFault::not_repeatable);
  CHECK(asked == 2);
}

TEST_CASE("a body at rest that a law wakes", "[general]") {
  Problem<double> problem = brick();
  problem.angular_velocity.setZero();
  const auto law = [](auto t, const auto& s) noexcept {
    using S = std::remove_cvref_t<decltype(t)>;
    return Vec3<S>(S(0.01) * t, S(0.02) * t * t, -S(0.1) * s.angular_velocity[2]);
  };
  const auto right = truth(problem, times, law);
  for (const double tolerance : tolerances) {
    const auto made = run(problem, law, {}, times, tolerance);
    const auto error = apart(problem, law, times, right, made.states);
    CHECK(made.answer.met);
    for (std::size_t k = 0; k < std::size(full_columns); ++k) {
      CAPTURE(tolerance, full_columns[k].name, error[k], made.answer.error[k]);
      CHECK(error[k] <= made.answer.error[k]);
    }
  }
}

TEST_CASE("a custom motion is stopped by its caller, and refuses what is no question", "[general]") {
  Monitor monitor;
  monitor.cancel = true;
  std::vector<State<double>> states(2);
  MotionOptions<double> options;
  options.monitor = &monitor;
  const std::vector<double> at{0, 1e4}, wrong{1, 0}, bad{gyrostat::nan<double>};
  const auto made = custom_motion<double>(brick(), NoTorque{}, {}, at, states, options);
  REQUIRE(made);
  CHECK(made->status == Status::cancelled);
  CHECK(custom_motion<double>(brick(), NoTorque{}, {}, wrong, states, {}).error() == Errc::not_increasing);
  CHECK(custom_motion<double>(brick(), NoTorque{}, bad, at, states, {}).error() == Errc::not_finite);
  CHECK(custom_motion<double>(brick(), NoTorque{}, {}, {at.data(), 1}, states, {}).error() == Errc::out_of_domain);
}

TEST_CASE("steps of a custom motion allocate nothing", "[general]") {
  general_laws::Mixed law;
  law.push = {0.1, 0, 0.05}, law.kick = {0, 0.4, -0.3}, law.kick_time = 7.3;
  const auto problem = with_torque(TorqueType::constant, {0.1, 0, 0});
  const Prepared<double> of(problem, 30);
  const std::vector<double> cuts{7.3};
  general::detail::CustomCourse<double, general_laws::Mixed> course(
      problem, law, {1, 1, 1}, general::detail::number_sizes(of), 30, cuts, 1, 1e-12, 100'000);
  const std::size_t before = allocations();
  while (course.time() < 30 && course.step(30) == Status::reached) (void)course.at(course.time());
  CHECK(allocations() == before);
  CHECK(course.time() == 30);
}

/// How many of so many scenes, each at four tolerances, state less than they err; prints the median of stated over true.
int dishonest(unsigned seed, int scenes) {
  general_laws::Scenes source(seed);
  std::vector<double> ratios;
  int wrong = 0, met = 0, all = 0, stopped = 0;
  for (int i = 0; i < scenes; ++i) {
    const auto made = source.next(3);
    std::vector<double> at{0};
    for (int k = 1; k < 8 && i % 3 != 0; ++k) at.push_back(made.span * k / 8);
    at.push_back(made.span);
    const auto right = truth(made.problem, at, made.law, made.named);
    if (right.size() != at.size()) continue;
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const auto of = run(made.problem, made.law, i % 2 == 1 ? std::vector<double>{} : made.named, at, tolerance);
      if (of.answer.status == Status::event) {
        ++stopped;
        continue;
      }
      CAPTURE(seed, i, tolerance);
      REQUIRE(of.answer.status == Status::reached);
      const auto error = apart(made.problem, made.law, at, right, of.states);
      ++all, met += of.answer.met;
      double least = infinity<double>;
      for (std::size_t k = 0; k < std::size(full_columns); ++k) {
        if (!(error[k] <= of.answer.error[k])) {
          ++wrong;
          std::printf("scene %d at %.0e, %s: %.3g, stated %.3g\n", i, tolerance, full_columns[k].name, error[k],
                      of.answer.error[k]);
        }
        if (error[k] > 0) least = std::min(least, of.answer.error[k] / error[k]);
      }
      ratios.push_back(least);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf(
      "seed %u: %d answers, %d met, %d stopped by a brake; stated over true: median %.1f, least %.2f, nine tenths "
      "below %.0f; columns that state too little: %d\n",
      seed, all, met, stopped, ratios[ratios.size() / 2], ratios.front(), ratios[ratios.size() * 9 / 10], wrong);
  CHECK(ratios[ratios.size() / 2] < 50);
  CHECK(met > all * 8 / 10);
  return wrong;
}

TEST_CASE("stated errors of custom motions bound the true ones", "[general]") { CHECK(dishonest(71, 24) == 0); }

TEST_CASE("stated errors of many custom motions bound the true ones", "[.long][general]") {
  CHECK(dishonest(72, 320) == 0);
}

}  // namespace general_custom_motion_test
