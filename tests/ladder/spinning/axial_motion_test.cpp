// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/axial_motion.hpp"

#include "catch.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "../../models/spinning/spinners.hpp"
#include "allocations.hpp"
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/models/spinning/linear.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

template <Real S>
std::vector<State<S>> states_at(const Problem<S>& p, const std::vector<S>& times) {
  std::vector<State<S>> states(times.size());
  const auto answer = axial_motion<S>(p, times, states);
  REQUIRE(answer);
  REQUIRE(answer->status == ode::Status::reached);
  return states;
}

}  // namespace

TEST_CASE("the linear motion of the reference cases with an axial torque", "[spinning]") {
  std::ifstream file(GYROSTAT_TEST_DATA "/spinning_axial.csv");
  REQUIRE(file);
  std::string line;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    ++rows;
    std::istringstream in(line);
    std::string name, word;
    std::getline(in, name, ',');
    std::vector<long double> n;
    while (std::getline(in, word, ',')) n.push_back(std::strtold(word.c_str(), nullptr));
    REQUIRE(n.size() == 24 + 15);
    const auto at = [&](std::size_t i) { return Vec3<double>(double(n[i]), double(n[i + 1]), double(n[i + 2])); };
    Problem<double> p;
    p.inertia = at(0);
    p.mass = double(n[3]);
    p.torque = at(4);
    p.force = at(7);
    p.rotor_momentum = double(n[10]);
    p.charge_momentum = double(n[11]);
    p.angular_velocity = at(12);
    p.angles = {double(n[15]), double(n[16]), double(n[17])};
    p.velocity = at(18);
    p.position = at(21);
    const auto s = states_at(p, {double(n[24])})[0];
    CAPTURE(name, double(n[24]));
    const auto near = [&](const std::vector<double>& found, std::size_t from) {
      long double size = 0, apart = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        size = std::hypot(size, n[from + i]);
        apart = std::hypot(apart, static_cast<long double>(found[i]) - n[from + i]);
      }
      CHECK(apart <= 2e-13L * size);
    };
    near({s.angular_velocity[0], s.angular_velocity[1]}, 25);
    near({s.angular_velocity[2]}, 27);
    near({s.angles.psi, s.angles.phi}, 28);
    near({s.angles.theta}, 30);
    near({s.momentum_I[0], s.momentum_I[1]}, 31);
    near({s.velocity[0], s.velocity[1]}, 33);
    near({s.velocity[2]}, 35);
    near({s.position[0], s.position[1]}, 36);
    near({s.position[2]}, 38);
  }
  CHECK(rows == 12);
}

TEST_CASE("without axial torque it is the linear motion", "[spinning]") {
  Spinners random(2);
  for (int i = 0; i < 20; ++i) {
    const auto p = random.spinner(0.01);
    const double end = 30 / (std::abs(p.spin()) + std::abs(p.kappa1(p.spin())) + std::abs(p.kappa2(p.spin())));
    const std::vector<double> times{0, end / 7, end};
    const auto found = states_at(p, times);
    const Linear<double> linear(p);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto wanted = linear.at(times[k]);
      const double tilt = std::hypot(wanted.angles.psi, wanted.angles.phi);
      CHECK((found[k].angular_velocity - wanted.angular_velocity).norm() < 1e-13 * p.angular_velocity.norm());
      CHECK(std::abs(found[k].angles.psi - wanted.angles.psi) < 1e-12 * tilt);
      CHECK(std::abs(found[k].angles.phi - wanted.angles.phi) < 1e-12 * tilt);
      CHECK((found[k].momentum_I - wanted.momentum_I).norm() < 1e-13 * wanted.momentum_I.norm());
      CHECK((found[k].velocity - wanted.velocity).norm() < 1e-13 * (p.velocity.norm() + wanted.velocity.norm()));
      CHECK((found[k].position - wanted.position).norm() < 1e-13 * (p.position.norm() + wanted.position.norm()));
    }
  }
}

TEST_CASE("orders through a change of spin, through r = 0 and resonances", "[spinning]") {
  using S = long double;
  Spinners random(3);
  for (int i = 0; i < 6; ++i) {
    auto base = random.spinner(0.02);
    const double r0 = base.spin();
    base.rotor_momentum = 2 * base.inertia[2] * r0;
    base.force[0] = base.force[1] = 0;
    const double end = 30 / std::abs(r0);
    // despin through zero, or spin up: X = r (D1 + D2) and others are crossed
    base.torque[2] = (i % 2 == 0 ? -1.6 : 2.0) * base.inertia[2] * r0 / end;
    std::array<S, 5> error[2];
    for (int k = 0; k < 2; ++k) {
      auto p = cast<S>(base);
      const S s = k == 0 ? 0.2L : 0.1L;
      p.torque[0] *= s, p.torque[1] *= s;
      p.angles.psi *= s, p.angles.phi *= s;
      const std::vector<S> times{end};
      const auto found = states_at(p, times)[0];
      std::vector<State<S>> right(1);
      FullMotionOptions<S> options;
      options.tolerance = 1e-16L;
      REQUIRE(full_motion<S>(p, times, right, options)->status == ode::Status::reached);
      error[k] = {std::hypot(found.angular_velocity[0] - right[0].angular_velocity[0],
                             found.angular_velocity[1] - right[0].angular_velocity[1]),
                  std::hypot(found.angles.psi - right[0].angles.psi, found.angles.phi - right[0].angles.phi),
                  std::abs(found.angles.theta - right[0].angles.theta),
                  (found.momentum_I - right[0].momentum_I).head<2>().norm(),
                  std::abs(found.momentum_I[2] - right[0].momentum_I[2])};
    }
    CAPTURE(i);
    const auto slope = [&](std::size_t n) { return std::log2(error[0][n] / error[1][n]); };
    CHECK(slope(0) == Approx(3).margin(0.15));
    CHECK(slope(1) == Approx(3).margin(0.15));
    CHECK(slope(2) == Approx(2).margin(0.15));
    CHECK(slope(3) == Approx(3).margin(0.15));
    CHECK(slope(4) > 3.5);
  }
}

TEST_CASE("the errors of the linear motion under an axial torque", "[spinning]") {
  Spinners random(8);
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    auto p = random.spinner(random.log_any(1e-3, 0.2));
    if (i % 3 == 0) p.force[0] = p.force[1] = 0;
    if (i % 4 == 0) p.inertia[1] = p.inertia[0] = std::max(p.inertia[0], 0.51 * p.inertia[2]);
    const double end = random.log_any(1, 20) * 6.3 / std::abs(p.spin());
    p.torque[2] = random.any(-2, 3) * p.inertia[2] * p.spin() / end;
    const std::vector<double> times{end / 3, 0.7 * end, end};
    std::vector<State<double>> found(3), right(3);
    const auto answer = axial_motion<double>(p, times, found);
    FullMotionOptions<double> options;
    options.tolerance = 1e-12;
    const auto truth = full_motion<double>(p, times, right, options);
    REQUIRE(answer);
    if (!(answer->seen.size.tilt < 0.5) || truth->error.greatest() > 1e-9) continue;
    const auto stated = axial_torque_errors<double>(p, end, answer->seen);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto &a = found[k], &b = right[k];
      const auto within = [&](const Vec3<double>& x, const Vec3<double>& y, double across, double axial) {
        CHECK((x - y).head<2>().norm() <= across + 1e-9 * y.norm());
        CHECK(std::abs(x[2] - y[2]) <= axial + 1e-9 * y.norm());
      };
      const auto angles = [](const Angles<double>& c) { return Vec3<double>(c.psi, c.phi, c.theta); };
      within(a.angular_velocity, b.angular_velocity, stated.rates, stated.spin);
      within(angles(a.angles), angles(b.angles), stated.tilt, stated.theta);
      within(a.momentum_I, b.momentum_I, stated.momentum, stated.axial_momentum);
      within(a.velocity, b.velocity, stated.velocity, stated.axial_velocity);
      within(a.position, b.position, stated.position, stated.axial_position);
    }
  }
}

TEST_CASE("the greatest tilt and rate are reported", "[spinning]") {
  auto p = Spinners(4).spinner(0.01);
  p.torque[2] = 0.1 * p.inertia[2] * p.spin() * std::abs(p.spin());
  const double end = 20 / std::abs(p.spin());
  std::vector<double> times;
  for (int k = 0; k <= 400; ++k) times.push_back(end * k / 400);
  std::vector<State<double>> states(times.size());
  const auto answer = axial_motion<double>(p, times, states);
  REQUIRE(answer);
  double tilt = 0, rate = 0;
  for (const auto& s : states) {
    tilt = std::max(tilt, std::hypot(s.angles.psi, s.angles.phi));
    rate = std::max(rate, s.angular_velocity.head<2>().norm());
  }
  CHECK(answer->seen.size.tilt == Approx(tilt).epsilon(0.05));
  CHECK(answer->seen.size.rate == Approx(rate).epsilon(0.05));
  CHECK(answer->counts.steps > 0);
}

TEST_CASE("bad requests of an axial motion are refused, long ones can be stopped", "[spinning]") {
  auto p = Spinners(5).spinner(0.01);
  p.torque[2] = 0.01;
  std::vector<State<double>> states(2);
  const auto error = [&](const Problem<double>& problem, std::vector<double> times) {
    return axial_motion<double>(problem, times, states).error();
  };
  CHECK(error(p, {0, 1}) == Errc::ok);
  CHECK(error(p, {1, 0}) == Errc::not_increasing);
  CHECK(error(p, {0}) == Errc::out_of_domain);
  CHECK(error(p, {0, gyrostat::nan<double>}) == Errc::not_finite);
  auto bad = p;
  bad.angular_velocity[2] = gyrostat::nan<double>;
  CHECK(error(bad, {0, 1}) == Errc::not_finite);
  bad = p;
  bad.velocity[1] = gyrostat::nan<double>;
  CHECK(error(bad, {0, 1}) == Errc::ok);
  CHECK(std::isnan(states[1].velocity[1]));
  const std::vector<double> times{0, 1e5 / std::abs(p.spin())};
  AxialMotionOptions<double> options;
  options.step_cap = 10;
  CHECK(axial_motion<double>(p, times, states, options)->status == ode::Status::step_limit);
  CHECK(std::isnan(states[1].angles.theta));
  Monitor monitor;
  monitor.cancel = true;
  options = {};
  options.monitor = &monitor;
  CHECK(axial_motion<double>(p, times, states, options)->status == ode::Status::cancelled);
}

TEST_CASE("the axial motion does not touch the heap", "[spinning]") {
  auto p = Spinners(6).spinner(0.01);
  p.torque[2] = 0.01;
  const std::vector<double> times{0, 10 / std::abs(p.spin())};
  std::vector<State<double>> states(2);
  const auto before = allocations();
  const auto answer = axial_motion<double>(p, times, states);
  CHECK(allocations() == before);
  CHECK(answer);
}
