// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/full_motion.hpp"

#include "catch.hpp"

#include <atomic>
#include <cmath>
#include <vector>

#include "../../models/spinning/spinners.hpp"
#include "allocations.hpp"
#include "at_length.hpp"
#include "gyrostat/math/jacobi.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using ode::Status;

namespace {

template <Real S>
struct SolvedMotion {
  FullMotionAnswer<S> answer;
  std::vector<State<S>> states;
};

template <Real S>
SolvedMotion<S> solve(const Problem<S>& problem, const std::vector<S>& times, S tolerance,
                      FullMotionOptions<S> options = {}) {
  SolvedMotion<S> solved;
  solved.states.resize(times.size());
  options.tolerance = tolerance;
  const auto result = full_motion<S>(problem, times, solved.states, options);
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
State<S> to(const State<double>& s) {
  return {s.angular_velocity.cast<S>(),
          {S(s.angles.psi), S(s.angles.phi), S(s.angles.theta)},
          {S(s.attitude.w), S(s.attitude.x), S(s.attitude.y), S(s.attitude.z)},
          s.momentum_I.cast<S>(),
          s.velocity.cast<S>(),
          s.position.cast<S>()};
}

template <Real S>
void check_within(const ColumnErrors<S>& truth, const ColumnErrors<S>& stated) {
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) {
    CAPTURE(column_kinds[i].name);
    CHECK(truth[i] <= stated[i]);
  }
}

/// The angles themselves, turns of theta counted, within twice the error of the attitude that they tell over cos(psi).
template <Real S>
void check_angles(const std::vector<State<S>>& right, const std::vector<State<S>>& found, S stated) {
  for (std::size_t i = 0; i < right.size(); ++i) {
    const auto &a = right[i].angles, &b = found[i].angles;
    CHECK(Vec3<S>(a.psi - b.psi, a.phi - b.phi, a.theta - b.theta).norm() <= 2 * stated / std::cos(a.psi));
  }
}

/// Errors of `found` relative to `right`.
template <Real S>
ColumnErrors<S> errors(const Problem<S>& problem, const std::vector<S>& times, const std::vector<State<S>>& right,
                       const std::vector<State<S>>& found) {
  Comparison comparison(Row<S>{scales(problem, times.back())});
  for (std::size_t i = 0; i < right.size(); ++i) comparison.add(right[i], found[i]);
  return comparison.relative(comparison.difference());
}

/// A problem that starts from a state of another.
Problem<double> from(Problem<double> problem, const State<double>& state) {
  problem.angular_velocity = state.angular_velocity;
  problem.angles = state.angles;
  problem.velocity = state.velocity;
  problem.position = state.position;
  return problem;
}

}  // namespace

TEST_CASE("spinning: the full motion of the reference cases", "[spinning]") {
  const auto cases = reference_cases<double>();
  REQUIRE(cases.size() == 14);
  for (const auto& c : cases) {
    CAPTURE(c.name);
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      CAPTURE(tolerance);
      const auto solved = solve(c.problem, c.times, tolerance / 10);
      REQUIRE(solved.answer.status == Status::reached);
      auto found = errors(c.problem, c.times, c.states, solved.states);
      check_within(found, solved.answer.error);
      check_angles(c.states, solved.states, solved.answer.error[column::euler_312]);
      found[column::euler_312] -= angles_error<double>(0, c.states);  // what writing down many turns rounds
      CHECK(found.greatest() < std::max(tolerance / 100, 1e-13));
      if (tolerance >= 1e-9) CHECK(solved.answer.met);
    }
  }
}

TEST_CASE("the reference cases in long double, theta by turns among them", "[spinning]") {
  for (const auto& c : reference_cases<long double>()) {
    CAPTURE(c.name);
    const auto solved = solve(c.problem, c.times, 1e-16L);
    const auto found = errors(c.problem, c.times, c.states, solved.states);
    check_within(found, solved.answer.error);
    check_angles(c.states, solved.states, solved.answer.error[column::euler_312]);
    CHECK(found.greatest() < 4e-17L);
  }
}

TEST_CASE("spinning: the stated errors are honest", "[spinning]") {
  Spinners random(20);
  for (int i = 0; i < 24; ++i) {
    CAPTURE(i);
    auto p =
        i % 2 == 0 ? random.spinner(random.log_any(1e-3, 1)) : random.body(i % 3 == 0 ? 0 : random.log_any(1e-3, 0.3));
    if (i % 5 == 0) p.inertia[1] = p.inertia[0] = std::max(p.inertia[0], 0.51 * p.inertia[2]);
    if (i % 4 < 2) p.force[0] = p.force[1] = 0;
    if (i % 9 == 0) p.velocity.setZero(), p.position.setZero();
    const auto times = grid(random.log_any(1, 15) * 2 * pi<double> / p.angular_velocity.norm(), 12);
    const std::vector<long double> at(times.begin(), times.end());
    const auto truth = solve(cast<long double>(p), at, 1e-16L);
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      CAPTURE(tolerance);
      const auto solved = solve(p, times, tolerance);
      std::vector<State<long double>> found;
      for (const auto& s : solved.states) found.push_back(to<long double>(s));
      ColumnErrors<long double> stated;
      for (std::size_t k = 0; k < std::size(column_kinds); ++k) stated[k] = solved.answer.error[k];
      check_within<long double>(errors(cast<long double>(p), at, truth.states, found), stated);
      if (solved.answer.turns_known) check_angles(truth.states, found, stated[column::euler_312]);
      if (tolerance >= 1e-9) CHECK(solved.answer.met);
    }
  }
}

TEST_CASE("a body that flips about its middle axis states what rounding makes of the flips", "[spinning]") {
  // late times at which a single second run with the same laws came nearer to the answer than the truth is
  const struct {
    Vec3<double> inertia, rates;
    std::vector<double> times;
    double tolerance;
  } cases[] = {
      {{18125.239043903606, 6992.0047103986635, 11759.464063500162},
       {3.3098725193556597e-09, -0.00010906010207345974, 0.6616331065122731},
       {761.1070789647418, 761.8681860437065, 761.8689471507855, 761.8689479126544},
       1e-9},
      {{0.02308572328054728, 0.005936130229850647, 0.020489778772526394},
       {1.1008780575733453e-07, -1.1914257530386972e-10, 0.05492907602575799},
       {2908.784835040628, 2911.6936198756684, 2911.6965286605036, 2911.6965315722},
       1e-12},
      {{11658.855008050801, 5499.2608286351015, 7827.3331853540185},
       {-4.634312019554185e-09, -2.550403180053931e-08, 0.06433641719981174},
       {1915.9389390352926, 1935.2918576114066},
       1e-4},
      {{3.730966451810879, 0.6654385854514703, 3.477370423908563},
       {-3.116492045597346e-08, -2.4432586190038716e-09, 0.1337255021176984},
       {1970.8928428566812},
       1e-4},
      {{78.99588439676613, 26.8136056935304, 57.82789379355388},
       {-9.95992004656678e-05, 0.000580974101596726, 0.20326147921225593},
       {943.3262045085802},
       1e-10},
      // loose steps, in which one companion is taken elsewhere
      {{3703129311372749.5, 1818484371497766.5, 3787349865999598},
       {-0.0870311280458705, 0, -3.7567810154115175e-07},
       grid(4306.38965170406, 200),
       1e-2},
  };
  for (const auto& c : cases) {
    CAPTURE(c.tolerance, c.inertia[0]);
    Problem<double> p;
    p.inertia = c.inertia;
    p.angular_velocity = c.rates;
    const std::vector<long double> at(c.times.begin(), c.times.end());
    const auto truth = solve(cast<long double>(p), at, 1e-15L);
    const auto solved = solve(p, c.times, c.tolerance);
    std::vector<State<long double>> found;
    for (const auto& s : solved.states) found.push_back(to<long double>(s));
    const auto right = errors(cast<long double>(p), at, truth.states, found);
    for (const std::size_t i : {column::angular_velocity, column::attitude, column::angular_momentum_inertial}) {
      CAPTURE(column_kinds[i].name);
      CHECK(right[i] <= solved.answer.error[i] + truth.answer.error[i]);
      if (solved.answer.met) CHECK(right[i] <= c.tolerance);
    }
  }
}

TEST_CASE("laws of the motion", "[spinning]") {
  Spinners random(5);
  for (int i = 0; i < 12; ++i) {
    auto p = random.body();
    const auto times = grid(40 / p.angular_velocity.norm(), 20);
    for (const State<double>& s : solve(p, times, 1e-12).states) {
      const Mat3<double> R = to_matrix(s.attitude);
      CHECK((R * R.transpose() - Mat3<double>::Identity()).norm() < 3e-15);
      const Vec3<double> psi_phi_theta = angles_312(s.attitude);
      CHECK(std::abs(psi_phi_theta[0] - s.angles.psi) < 1e-15);
      CHECK(std::abs(std::remainder(psi_phi_theta[2] - s.angles.theta, 2 * pi<double>)) < 1e-13);
      const Vec3<double> H = p.inertia.cwiseProduct(s.angular_velocity) + Vec3<double>(0, 0, p.rotor_momentum);
      CHECK((R * H - s.momentum_I).norm() < 1e-14 * (H.norm() + std::abs(p.rotor_momentum)));
    }
    // without torque: energy, and without charge the momentum
    p.torque.setZero();
    const auto energy = [&](const State<double>& s) {
      return s.angular_velocity.dot(p.inertia.cwiseProduct(s.angular_velocity));
    };
    const auto free = solve(p, times, 1e-13);
    for (const auto& s : free.states) CHECK(energy(s) == Approx(energy(free.states[0])).epsilon(2e-14));
    p.charge_momentum = 0;
    const auto neutral = solve(p, times, 1e-13);
    for (const auto& s : neutral.states)
      CHECK((s.momentum_I - neutral.states[0].momentum_I).norm() <
            2e-14 * (neutral.states[0].momentum_I.norm() + std::abs(p.rotor_momentum)));
  }
}

TEST_CASE("equal transverse moments: r grows evenly, and a spin up crosses zero", "[spinning]") {
  Spinners random(6);
  for (int i = 0; i < 10; ++i) {
    auto p = random.spinner(0.2);
    p.inertia[0] = p.inertia[1] = std::max(p.inertia[0], p.inertia[2]);
    p.torque[2] = -0.05 * p.inertia[2] * p.spin() * std::abs(p.spin());
    const auto times = grid(40 / std::abs(p.spin()), 20);  // r changes sign half-way
    const auto solved = solve(p, times, 1e-10);
    REQUIRE(solved.answer.status == Status::reached);
    for (std::size_t k = 0; k < times.size(); ++k)
      CHECK(solved.states[k].angular_velocity[2] ==
            Approx(p.spin() + p.torque[2] / p.inertia[2] * times[k]).margin(1e-15 * std::abs(p.spin())));
    CHECK(solved.states.back().angular_velocity[2] * p.spin() < 0);
  }
}

TEST_CASE("the free rigid body against Jacobi's functions", "[spinning]") {
  // q, p and r of Euler's top with momentum on the side of axis 3, the largest moment:
  // p = p* cn, q = q* sn, r = r* dn
  Problem<double> p;
  p.inertia = {1, 2, 2.5};
  p.angular_velocity = {0.8, 0, 1.1};
  const double D1 = 1, D2 = 2, D3 = 2.5, P = 0.8, R = 1.1;
  const double rate = std::sqrt((D3 - D2) * (D3 - D1) / (D1 * D2)) * R;
  const double k2 = (D2 - D1) * D1 * P * P / ((D3 - D2) * D3 * R * R);
  REQUIRE(k2 < 1);
  const double Q = P * std::sqrt(D1 * (D3 - D1) / (D2 * (D3 - D2)));
  const auto times = grid(200, 40);
  const auto solved = solve(p, times, 1e-12);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto f = math::jacobi(rate * times[k], math::Modulus<double>{k2, 1 - k2});
    const Vec3<double> wanted(P * f.cn, Q * f.sn, R * f.dn);
    CHECK((solved.states[k].angular_velocity - wanted).norm() < 1e-12);
  }
}

TEST_CASE("axis reflection, time shift, reversal", "[spinning]") {
  Spinners random(7);
  for (int i = 0; i < 10; ++i) {
    const auto p = random.body(0.1);
    const double end = 20 / p.angular_velocity.norm();
    const std::vector<double> times{0, end / 3, end};
    const auto whole = solve(p, times, 1e-13);

    // half a turn of the body axes about axis 1
    auto flipped = p;
    for (const int k : {1, 2}) {
      flipped.torque[k] *= -1;
      flipped.force[k] *= -1;
      flipped.angular_velocity[k] *= -1;
    }
    flipped.rotor_momentum *= -1;
    flipped.charge_momentum *= -1;
    const Quat<double> half{0, 1, 0, 0};
    const Vec3<double> a = angles_312(quaternion_from_312(p.angles.psi, p.angles.phi, p.angles.theta) * half);
    flipped.angles = {a[0], a[1], a[2]};
    const auto other = solve(flipped, times, 1e-13);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto &s = whole.states[k], &f = other.states[k];
      const Vec3<double> w(f.angular_velocity[0], -f.angular_velocity[1], -f.angular_velocity[2]);
      CHECK((w - s.angular_velocity).norm() < 1e-11 * s.angular_velocity.norm());
      CHECK((to_matrix(f.attitude * conjugate(half)) - to_matrix(s.attitude)).norm() < 1e-11);
      CHECK((f.momentum_I - s.momentum_I).norm() < 1e-11 * s.momentum_I.norm());
      CHECK((f.position - s.position).norm() < 1e-11 * (1 + s.position.norm()));
    }

    const auto rest = solve(from(p, whole.states[1]), {0, end - end / 3}, 1e-13);
    CHECK((rest.states[1].angular_velocity - whole.states[2].angular_velocity).norm() <
          1e-11 * p.angular_velocity.norm());
    CHECK((rest.states[1].position - whole.states[2].position).norm() < 1e-11 * (1 + whole.states[2].position.norm()));
    CHECK(rest.states[1].angles.theta == Approx(whole.states[2].angles.theta).margin(1e-8));

    // backwards in time rates and momenta change sign, torques do not
    auto back = from(p, whole.states[2]);
    back.angular_velocity *= -1;
    back.velocity *= -1;
    back.rotor_momentum *= -1;
    back.charge_momentum *= -1;
    const auto home = solve(back, {end}, 1e-13);
    CHECK((home.states[0].angular_velocity + p.angular_velocity).norm() < 1e-10 * p.angular_velocity.norm());
    CHECK((home.states[0].position - p.position).norm() < 1e-10 * (1 + whole.states[2].position.norm()));
  }
}

TEST_CASE("nothing acts, nothing moves", "[spinning]") {
  Problem<double> p;
  p.inertia = {2, 2.5, 3};
  const std::vector<double> times{0, 1, 1e6};
  SECTION("at rest") {
    const auto solved = solve(p, times, 1e-12);
    CHECK(solved.answer.met);
    CHECK(solved.answer.error[column::angular_velocity] == 0);
    CHECK(solved.states[2].position.isZero(0));
  }
  SECTION("a velocity alone") {
    p.velocity = {1, -2, 3};
    p.position = {0, 0, 5};
    const auto solved = solve(p, times, 1e-12);
    CHECK(solved.answer.met);
    CHECK(solved.states[2].velocity == p.velocity);
    CHECK((solved.states[2].position - Vec3<double>(1e6, -2e6, 3e6 + 5)).norm() < 1e-9);
  }
  SECTION("a force alone") {
    p.force = {0, 0, 6};
    p.mass = 2;
    const auto solved = solve(p, times, 1e-12);
    CHECK(solved.answer.met);
    CHECK(solved.states[2].position[2] == Approx(1.5e12).epsilon(1e-14));
  }
  SECTION("a force on a spinning body: the velocity turns on a circle") {
    p.force = {4, 0, 0};
    p.mass = 2;
    p.angular_velocity = {0, 0, 3};
    const auto solved = solve(p, {0, 100}, 1e-11);
    CHECK(solved.answer.met);
    CHECK(solved.states[1].velocity[0] == Approx(2.0 / 3 * std::sin(300.0)).epsilon(1e-11));
    CHECK(solved.states[1].velocity[1] == Approx(2.0 / 3 * (1 - std::cos(300.0))).epsilon(1e-11));
    CHECK(solved.states[1].angles.theta == Approx(300).epsilon(1e-14));
  }
}

TEST_CASE("angles near gimbal lock are stated as the attitude allows", "[spinning]") {
  Problem<double> p;
  p.inertia = {2, 2, 2};
  p.angular_velocity = {1, 0, 0};
  SECTION("an output close by") {
    p.angles = {0, 1e-5, 0};
    const auto solved = solve(p, {0, pi<double> / 2, 3}, 1e-9);
    CHECK(solved.answer.met);
    CHECK(solved.answer.turns_known);
    const auto truth = solve(cast<long double>(p), {0.0L, static_cast<long double>(pi<double> / 2), 3.0L}, 1e-16L);
    std::vector<State<long double>> found;
    for (const auto& s : solved.states) found.push_back(to<long double>(s));
    check_angles<long double>(truth.states, found, solved.answer.error[column::euler_312]);
    CHECK(solved.states[2].angles.theta == Approx(-pi<double>).margin(1e-3));
  }
  SECTION("the side of the pass is not known") {
    p.angles = {0, 1e-16, 0};
    const auto solved = solve(p, {0, 3}, 1e-6);
    CHECK(!solved.answer.turns_known);
    CHECK(solved.answer.met);
    CHECK(std::abs(solved.states[1].angles.theta) == Approx(pi<double>));
  }
  SECTION("upside down phi is at the middle of its range") {
    p.angles = {0.01, pi<double>, 0};
    p.angular_velocity = {0.01, 0, 2};
    CHECK(solve(p, grid(30, 30), 1e-9).answer.met);
  }
}

TEST_CASE("spinning: float works within its digits", "[spinning]") {
  const auto p = Spinners(8).spinner(0.1);
  const double end = 20 / p.angular_velocity.norm();
  const auto truth = solve(p, {0.0, end}, 1e-10);
  const auto solved = solve<float>(cast<float>(p), {0.0F, static_cast<float>(end)}, 1e-3F);
  CHECK(solved.answer.met);
  CHECK((solved.states[1].momentum_I.cast<double>() - truth.states[1].momentum_I).norm() <
        1e-4 * truth.states[1].momentum_I.norm());
}

TEST_CASE("spinning: a motion can be watched, stopped and capped", "[spinning]") {
  const auto p = Spinners(9).body(1e-4);
  const std::vector<double> times{0, 1, 2000 / p.angular_velocity.norm()};
  Monitor monitor;
  FullMotionOptions<double> options;
  options.monitor = &monitor;
  CHECK(solve(p, times, 1e-8, options).answer.status == Status::reached);
  CHECK(monitor.fraction == 1.0);
  monitor.cancel = true;
  const auto cancelled = solve(p, times, 1e-8, options);
  CHECK(cancelled.answer.status == Status::cancelled);
  CHECK(!cancelled.answer.met);

  options.monitor = nullptr;
  options.step_cap = 20;
  const auto capped = solve(p, times, 1e-8, options);
  CHECK(capped.answer.status == Status::step_limit);
  CHECK(capped.states[0].angular_velocity.allFinite());
  CHECK(!capped.states[2].angular_velocity.allFinite());
  CHECK(std::isnan(capped.states[2].angles.theta));
  CHECK(!capped.answer.met);
}

TEST_CASE("spinning: bad requests are refused", "[spinning]") {
  const auto p = Spinners(10).body();
  std::vector<State<double>> states(2);
  const auto error = [&](const Problem<double>& problem, std::vector<double> times) {
    return full_motion<double>(problem, times, states).error();
  };
  CHECK(error(p, {0.0, 1.0}) == Errc::ok);
  CHECK(error(p, {1.0, 0.0}) == Errc::not_increasing);
  CHECK(error(p, {-1.0, 0.0}) == Errc::not_increasing);
  CHECK(error(p, {0.0, gyrostat::nan<double>}) == Errc::not_finite);
  CHECK(error(p, {0.0}) == Errc::out_of_domain);
  for (int i = 0; i < 8; ++i) {
    auto bad = p;
    double* const number[] = {&bad.inertia[0], &bad.mass,     &bad.rotor_momentum, &bad.charge_momentum,
                              &bad.torque[1],  &bad.force[2], &bad.angles.theta,   &bad.angular_velocity[0]};
    *number[i] = gyrostat::nan<double>;
    CHECK(error(bad, {0.0, 1.0}) == Errc::not_finite);
  }
  auto bad = p;
  bad.mass = 0;
  CHECK(error(bad, {0.0, 1.0}) == Errc::not_positive);
}

TEST_CASE("spinning: the full motion does not touch the heap", "[spinning]") {
  const auto p = Spinners(11).body();
  const auto times = grid(20 / p.angular_velocity.norm(), 3);
  std::vector<State<double>> states(times.size());
  const auto before = allocations();
  const auto result = full_motion<double>(p, times, states);
  CHECK(allocations() == before);
  CHECK(result);
}

TEST_CASE("where the spin axis points is known better than how far the body has turned about it",
          "[spinning][length]") {
  Spinners random(21);
  const int count = at_length(4, 12);
  int sharper = 0;
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    const auto problem = random.spinner(0.05);
    const double end = 400 / std::abs(problem.spin());
    const std::vector<double> times = grid(end, 9);
    const auto right = solve<long double>(cast<long double>(problem), {times.begin(), times.end()}, 1e-15L, {}).states;
    const auto found = solve<double>(problem, times, 1e-7);
    REQUIRE(found.answer.status == Status::reached);
    long double axis = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Vec3<long double> z(0, 0, 1);
      axis = std::max(axis, (rotate<long double>(right[k].attitude, z) -
                             rotate<long double>(to<long double>(found.states[k]).attitude, z))
                                .norm());
    }
    CHECK(axis <= found.answer.tilt_error);
    CHECK(found.answer.tilt_error <= 1.01 * found.answer.error[column::attitude]);
    if (found.answer.tilt_error < found.answer.error[column::attitude] / 3) ++sharper;
  }
  CHECK(2 * sharper >= count);
}
