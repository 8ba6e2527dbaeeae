// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/picard.hpp"

#include "catch.hpp"

#include <cmath>
#include <vector>

#include "allocations.hpp"
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "spinners.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

template <Real S>
std::vector<State<S>> truth(const Problem<S>& p, const std::vector<S>& times) {
  std::vector<State<S>> states(times.size());
  FullMotionOptions<S> options;
  options.tolerance = 100 * epsilon<S>;
  const auto answer = full_motion<S>(p, times, states, options);
  REQUIRE(answer);
  REQUIRE(answer->status == ode::Status::reached);
  return states;
}

template <Real S>
struct Swept {
  Result<PicardAnswer<S>> answer;
  std::vector<State<S>> states;
};

template <Real S>
Swept<S> sweep(const Problem<S>& p, const std::vector<S>& times, int sweeps) {
  Swept<S> swept{Errc::no_convergence, std::vector<State<S>>(times.size())};
  PicardOptions<S> options;
  options.sweeps = sweeps;
  swept.answer = picard_motion<S>(p, times, swept.states, options);
  return swept;
}

}  // namespace

TEST_CASE("every sweep raises the order in the tilt by two", "[spinning]") {
  using S = long double;
  Spinners random(3);
  int seen = 0;
  while (seen < 3) {
    auto base = random.spinner(0.05);
    if (base.nutation_squared() < 0) continue;
    ++seen;
    base.angular_velocity[0] = 0.01 * base.spin();
    base.angular_velocity[1] = -0.02 * base.spin();
    const std::vector<S> times{40 / std::abs(S(base.spin()))};
    // errors of the linear motion, of one sweep, and of two: p and q, tilt, theta, momentum
    std::array<S, 4> linear[3], one[3], two[3];
    for (int k = 0; k < 3; ++k) {
      auto p = cast<S>(base);
      const S s = std::ldexp(S(0.4L), -k);
      p.torque *= s;
      p.angles.psi *= s, p.angles.phi *= s;
      p.angular_velocity[0] *= s, p.angular_velocity[1] *= s;
      const auto right = truth(p, times)[0];
      const auto errors = [&](const State<S>& a) -> std::array<S, 4> {
        return {(a.angular_velocity - right.angular_velocity).template head<2>().norm(),
                std::hypot(a.angles.psi - right.angles.psi, a.angles.phi - right.angles.phi),
                std::abs(a.angles.theta - right.angles.theta), (a.momentum_I - right.momentum_I).norm()};
      };
      linear[k] = errors(Linear<S>(p).at(times[0]));
      const auto swept = sweep(p, times, 2);
      REQUIRE(swept.answer);
      two[k] = errors(swept.states[0]);
      spinning::detail::PicardSweeps<S> sweeps(p, 2, times[0], 80);
      for (int panel = 0; panel < 79; ++panel) {
        REQUIRE(sweeps.advance());
        sweeps.leave();
      }
      REQUIRE(sweeps.advance());
      one[k] = errors(sweeps.state(1, times[0]));
    }
    // two sweeps at the larger tilts, lest rounding rules
    const auto slope = [&](const auto& e, std::size_t i) {
      const int k = &e == &two ? 0 : 1;
      return std::log2(e[k][i] / e[k + 1][i]);
    };
    CAPTURE(seen);
    for (const std::size_t i : {0U, 1U}) {
      CHECK(slope(linear, i) == Approx(3).margin(0.15));
      CHECK(slope(one, i) == Approx(5).margin(0.15));
      CHECK(slope(two, i) == Approx(7).margin(0.3));
    }
    CHECK(slope(linear, 2) == Approx(2).margin(0.15));
    CHECK(slope(one, 2) == Approx(4).margin(0.15));
    CHECK(slope(two, 2) > 5.7);
    CHECK(slope(two, 3) > 5.7);
  }
}

TEST_CASE("the sweeps state their errors and those of the linear motion", "[spinning]") {
  Spinners random(5);
  int converged = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    auto p = random.spinner(random.log_any(1e-3, 1));
    if (i % 3 == 0) p.charge_momentum = 0;
    if (i % 2 == 0) p.force[0] = p.force[1] = 0;
    if (i % 5 == 0) p.rotor_momentum *= -1;
    double end = random.log_any(1, 15) * 6.3 / std::abs(p.spin());
    if (p.nutation_squared() < 0) end = std::min(end, 4 / std::sqrt(-p.nutation_squared()));
    const std::vector<double> times{0, end / 3, 0.7 * end, end};
    const auto swept = sweep(p, times, 2 + i % 4);
    if (!swept.answer || !swept.answer->converges) continue;
    ++converged;
    const auto right = truth(p, times);
    SweepErrors<double> linear, found;
    for (std::size_t k = 0; k < times.size(); ++k) {
      linear.add(Linear<double>(p).at(times[k]), right[k]);
      found.add(swept.states[k], right[k]);
    }
    const auto size = swept.answer->size.all();
    for (std::size_t k = 0; k < 6; ++k) {
      CAPTURE(k);
      const double own = 3e-14 * size[k];  // the truth's own
      CHECK(linear.all()[k] <= swept.answer->linear.all()[k] + own);
      if (k != 3) CHECK(linear.all()[k] >= 0.05 * swept.answer->linear.all()[k] - own - 1e-10 * size[k]);
      CHECK(found.all()[k] <= swept.answer->error.all()[k] + own);
    }
  }
  CHECK(converged > 35);
}

TEST_CASE("at resonances, without spin, unstable, as a sphere", "[spinning]") {
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    auto p = Spinners(8).spinner(0.01);
    p.charge_momentum = 0;
    const auto& D = p.inertia;
    const double r0 = p.spin();
    if (i == 0) p.rotor_momentum = -D[2] * r0;
    if (i == 1) p.rotor_momentum = (D[0] + D[1] - D[2]) * r0;
    if (i == 2) p.rotor_momentum = -(D[2] - D[1]) * r0;
    if (i == 3) p.rotor_momentum = -(D[2] - (D[0] + D[1]) / 2) * r0;
    if (i == 4) p.inertia.setConstant(1), p.rotor_momentum = 0;
    if (i == 5) p.angular_velocity.setZero(), p.rotor_momentum = 0;
    p.torque *= 0.01;
    const std::vector<double> times{3 / std::abs(r0)};
    const auto swept = sweep(p, times, 5);
    REQUIRE(swept.answer);
    CHECK(swept.answer->converges);
    SweepErrors<double> found;
    found.add(swept.states[0], truth(p, times)[0]);
    for (std::size_t k = 0; k < 6; ++k)
      CHECK(found.all()[k] <= swept.answer->error.all()[k] + 3e-14 * swept.answer->size.all()[k]);
    CHECK(found.attitude < 1e-12);
  }
}

TEST_CASE("the lesser stiffness of a slim body keeps its digits beside the greater", "[spinning]") {
  // the greater is 1e16 times as large: by half their sum and difference the sweeps erred by 9e-5 rad alike, and stated 4e-8
  Problem<double> p;
  p.inertia = {5.520688473285036e-06, 504.48092157393916, 504.48092157393916};
  p.charge_momentum = 6226.705391077201;
  p.torque = {-3.7873098708048464e-05, -5.793396068195702e-05, 0};
  p.angular_velocity = {0, 0, 12.34279934282614};
  p.angles = {0.002092350684103299, -0.0015856201713705133, 0.0062981660126478056};
  const std::vector<double> times{0.07241233584595383};
  const auto swept = sweep(p, times, 4);
  REQUIRE(swept.answer);
  Problem<long double> wide;
  wide.inertia = p.inertia.cast<long double>(), wide.charge_momentum = p.charge_momentum;
  wide.torque = p.torque.cast<long double>(), wide.angular_velocity = p.angular_velocity.cast<long double>();
  wide.angles = {p.angles.psi, p.angles.phi, p.angles.theta};
  const auto right = truth<long double>(wide, {static_cast<long double>(times[0])})[0];
  State<double> told{right.angular_velocity.cast<double>(), {}, {}};
  const auto& q = right.attitude;
  told.attitude = {double(q.w), double(q.x), double(q.y), double(q.z)};
  SweepErrors<double> found;
  found.add(swept.states[0], told);
  CHECK(found.attitude <= swept.answer->error.attitude);
  CHECK(found.angular_velocity <= swept.answer->error.angular_velocity);
}

TEST_CASE("sweeps know what an unstable spin makes of roundings, where its growing mode is not there at the start",
          "[spinning]") {
  const auto made = [](auto one) {
    using S = decltype(one);
    Problem<S> p;  // at the steady rates of its torque, spinning about the middle axis; data that are doubles
    p.inertia = {0.5, 0.94, 0.73}, p.mass = 10, p.torque = {9.76e-7, -4e-7, 0}, p.force = {0, 0, 1};
    const double k1 = (0.73 - 0.94) / 0.5, k2 = (0.73 - 0.5) / 0.94;
    p.angular_velocity = {S(double(4e-7 / 0.94 / k2)), S(double(9.76e-7 / 0.5 / k1)), one};
    return p;
  };
  const double T = 25 / std::sqrt(-made(1.0).nutation_squared());
  const auto found = sweep<double>(made(1.0), {T}, 4);
  const auto fine = sweep<long double>(made(1.0L), {T}, 4);
  REQUIRE((found.answer && fine.answer));
  const Vec3<long double> exact = fine.states[0].angular_velocity;
  const double off = double((vector_cast<long double>(found.states[0].angular_velocity) - exact).norm());
  CHECK(off < found.answer->error.angular_velocity);
  CHECK(found.answer->error.angular_velocity > 1e-16 * std::exp(25.));
}

TEST_CASE("sweeps that do not converge give no answer", "[spinning]") {
  Problem<double> p;
  p.inertia = {8.7, 8.6, 11.1};
  p.mass = 10;
  p.torque = {4, 0, 0};
  p.force = {0, 0, 3};
  p.rotor_momentum = 1.3;
  p.charge_momentum = 0.291;
  p.angular_velocity = {0, 0, 0.28274};
  const auto swept = sweep(p, {1.0, 50.0}, 4);
  CHECK((!swept.answer || !swept.answer->converges));
  // well within a second the tilt is small
  const auto brief = sweep(p, {0.3}, 4);
  REQUIRE(brief.answer);
  CHECK(brief.answer->converges);
}

TEST_CASE("bad requests of sweeps are refused", "[spinning]") {
  auto p = Spinners(9).spinner(0.01);
  const double end = 1 / std::abs(p.spin());
  CHECK(sweep<double>(p, {end}, 1).answer.error() == Errc::out_of_domain);
  CHECK(sweep<double>(p, {end}, 9).answer.error() == Errc::out_of_domain);
  CHECK(sweep<double>(p, {end, 0}, 2).answer.error() == Errc::not_increasing);
  CHECK(sweep<double>(p, {gyrostat::nan<double>}, 2).answer.error() == Errc::not_finite);
  CHECK(sweep<double>(p, {1e9 * end}, 2).answer.error() == Errc::step_limit);
  CHECK(sweep<double>(p, {}, 2).answer);
  CHECK(sweep<double>(p, {0.0}, 2).answer);
  p.torque[2] = 1;
  CHECK(sweep<double>(p, {end}, 2).answer.error() == Errc::not_applicable);
  p.torque[2] = 0;
  p.angular_velocity[2] = gyrostat::nan<double>;
  CHECK(sweep<double>(p, {end}, 2).answer.error() == Errc::not_finite);
}

TEST_CASE("sweeps do not touch the heap", "[spinning]") {
  const auto p = Spinners(10).spinner(0.01);
  const std::vector<double> times{1 / std::abs(p.spin()), 10 / std::abs(p.spin())};
  std::vector<State<double>> states(2);
  const auto before = allocations();
  const auto answer = picard_motion<double>(p, times, states);
  CHECK(allocations() == before);
  CHECK(answer);
}
