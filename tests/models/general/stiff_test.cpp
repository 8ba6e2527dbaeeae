// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/stiff.hpp"

#include <cmath>
#include <vector>

#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/ode/radau.hpp"
#include "scenes.hpp"

namespace general_stiff_test {

using namespace gyrostat;
using namespace gyrostat::general;
using ode::Status;

constexpr int most = int(most_wheels);
using System = StiffSystem<double, most>;
static_assert(ode::RelaxingSystem<System> && ode::Projects<System> && ode::RelaxingSystem<StiffSystem<float, 1>>);

Piece<double> first_piece(const Prepared<double>& of) {
  const auto cuts = breakpoints(of.problem, of.span);
  return Piece<double>::first(of.problem, of.wheels, of.torques, cuts.empty() ? of.span : cuts[0]);
}

TEST_CASE("the relaxing form is the equations as they are written, for every torque and wheel", "[general]") {
  general_scenes::Scenes source(67);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const auto made = source.next(2);
    const auto& p = made.problem;
    const Prepared<double> of(p, made.span);
    const double own = std::min(of.momentum.norm(), (p.inertia * p.angular_velocity).norm());
    if (!(own > 1e-2 * of.sizes.momenta) || own < 1e-2 * of.sizes.built) continue;  // a brake at rest has no direction
    const auto piece = first_piece(of);
    auto x = System::first_numbers(of);
    const System system(of, piece, x);
    // p off where it starts
    for (std::size_t k = 0; k < of.settling.count; ++k) x[System::width + k] *= 1 + 0.1 * double(k);
    const double t = 0.4 * piece.to;
    const State<double> state = system.state(t, x.data());
    Lanes<double> y[System::width], z[most], rate[System::width], pull[most];
    for (int c = 0; c < System::width; ++c) y[c] = lanes(x[std::size_t(c)]);
    for (int k = 0; k < most; ++k) z[k] = lanes(x[std::size_t(System::width + k)]);
    const auto moment = system.moment(lanes(0., t, t, 0.7 * piece.to));
    system.rates(moment, y, z, rate);
    system.sources(moment, y, pull);

    // the plain state, its velocity as the forces have left it
    const Flow<double> flow(p, of.wheels);
    auto plain = flow.start();
    const Vec3<double> start(x[4], x[5], x[6]);
    for (std::size_t k = 0; k < of.wheels.count; ++k) {
      const auto& law = of.wheels.laws[k];
      plain[Flow<double>::wheel + k] = law.axial_inertia * (state.rotor_rate[k] + law.axis.dot(state.angular_velocity));
    }
    Flow<double>::Numbers wanted;
    flow(t, plain, wanted);
    if (const KnownMomentum<double> known(piece, x.data(), System::Numbers{}.data()); known && !known.is_free()) {
      // the state holds the momentum of its time, the numbers that of the start
      for (std::size_t k = 0; k < of.wheels.count; ++k) {
        if (of.wheels.laws[k].follows == Follows::state || !of.wheels.laws[k].turns_by_itself()) continue;
        plain[Flow<double>::wheel + k] = piece.wheels[k].at(t);
      }
      for (std::size_t k = 0; k < of.settling.count; ++k) {
        double momentum = 0;
        for (std::size_t m = 0; m < of.settling.count; ++m)
          momentum += of.settling.to_wheel[k][m] * x[System::width + m];
        plain[Flow<double>::wheel + of.settling.wheel[k]] = momentum;
      }
      flow(t, plain, wanted);
    }
    CAPTURE(i, made.kind);
    ++compared;
    const double turn = of.sizes.turning, M = std::max(of.sizes.momentum(), 1e-300) * turn + of.sizes.torque;
    for (std::size_t c = 0; c < 4; ++c) CHECK(std::abs(rate[c][1] - wanted[c]) <= 1e-12 * turn);
    for (std::size_t c = 4; c < 7; ++c) CHECK(std::abs(rate[c][1] - wanted[c]) <= 1e-12 * M);
    for (std::size_t c = 0; c < 3 && !p.fixed; ++c) {
      const double gravity = p.field.gravity * p.field.down[int(c)];
      CHECK(std::abs(rate[10 + c][1] + gravity - wanted[24 + c]) <= 1e-12 * (of.sizes.force / p.mass + 10));
      CHECK(rate[13 + c][1] == x[10 + c]);
    }
    for (std::size_t k = 0; k < of.settling.count; ++k) {
      double momentum_rate = 0, size = of.wheels.laws[of.settling.wheel[k]].friction * turn;
      for (std::size_t m = 0; m < of.settling.count; ++m) {
        const double one = of.settling.rate[m] * x[System::width + m];
        momentum_rate += of.settling.to_wheel[k][m] * (pull[m][2] - one);
        size += std::abs(of.settling.to_wheel[k][m]) * (std::abs(pull[m][2]) + std::abs(one));
      }
      CHECK(std::abs(momentum_rate - wanted[Flow<double>::wheel + of.settling.wheel[k]]) <= 1e-12 * size);
    }
  }
  CHECK(compared > 200);
}

/// Three oblique wheels, waves, a gradient of an orbit, a table, a force.
Problem<double> rich() {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5;
  p.angular_velocity = {0.5, 1.1, -0.8};
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  auto& orbit = p.orbit.emplace();
  orbit.radius = 7e6, orbit.mu = 0.01 * 7e6 * 7e6 * 7e6, orbit.eccentricity = 0.2;
  const Vec3<double> axes[] = {{1, 0.2, 0.1}, {-0.3, 1, 0.4}, {0.1, 0.5, 1}};
  for (int k = 0; k < 3; ++k) {
    auto& wheel = p.wheels.emplace_back();
    wheel.type = WheelType::motor, wheel.axis = axes[k].normalized();
    wheel.axial_inertia = 0.1 + 0.05 * k, wheel.rate = 20 - 5 * k, wheel.no_load_rate = 22 - 6 * k;
  }
  p.wheels[0].slope = 0.5, p.wheels[1].slope = 50, p.wheels[2].slope = 5e4;
  p.torques.resize(3);
  p.torques[0].vector = {0.3, -0.2, 0.1}, p.torques[0].axes = Axes::inertial;
  p.torques[0].factor.amplitude = 0.5, p.torques[0].factor.rate = 3;
  p.torques[1].type = TorqueType::gravity_gradient;
  p.torques[2].type = TorqueType::thrust, p.torques[2].vector = {0.1, 0.2, -0.1}, p.torques[2].point = {0.5, 0, 1};
  return p;
}

template <class Its>
auto solver_of(const Its& system, const typename Its::Numbers& start, double tolerance) {
  typename ode::Radau<Its>::Options options;
  options.tolerance = tolerance, options.blur = 4;
  options.scale = system.scale();
  return ode::Radau<Its>(system, 0, start, options);
}

struct End {
  std::vector<double> numbers;
  double steps;
};

template <class Its>
End end_of(const Problem<double>& p, double span, double tolerance) {
  const Prepared<double> of(p, span);
  const auto piece = first_piece(of);
  const auto start = Its::first_numbers(of);
  auto solver = solver_of(Its(of, piece, start), start, tolerance);
  REQUIRE(solver.advance(span) == Status::reached);
  return {{solver.state(), solver.state() + 10}, double(solver.counts().steps)};
}

double apart(const End& a, const End& b) {
  double most_off = 0;
  for (std::size_t i = 0; i < 10; ++i) most_off = std::max(most_off, std::abs(a.numbers[i] - b.numbers[i]));
  return most_off;
}

TEST_CASE("the error of the relaxing form falls with the order of its steps", "[general]") {
  using Its = StiffSystem<double, 3>;
  const auto p = rich();
  const auto right = end_of<Its>(p, 20, 1e-16), rough = end_of<Its>(p, 20, 1e-5), fine = end_of<Its>(p, 20, 1e-10);
  CAPTURE(apart(rough, right), apart(fine, right), rough.steps, fine.steps);
  CHECK(apart(fine, right) < 1e-8);
  CHECK(std::log(apart(rough, right) / apart(fine, right)) / std::log(fine.steps / rough.steps) > 8);
}

TEST_CASE("the steps do not care how many places for wheels there are, nor how fast they settle", "[general]") {
  const auto p = rich();
  CHECK(apart(end_of<StiffSystem<double, 3>>(p, 5, 1e-14), end_of<System>(p, 5, 1e-14)) < 1e-12);
  std::uint64_t fewest = 1'000'000, greatest = 0;
  for (const double faster : {1., 1e3, 1e6}) {
    auto one = p;
    for (auto& wheel : one.wheels) wheel.slope *= 100 * faster;
    const Prepared<double> of(one, 20.);
    const auto piece = first_piece(of);
    const auto start = System::first_numbers(of);
    const System system(of, piece, start);
    const std::size_t before = allocations();
    auto solver = solver_of(system, start, 1e-11);
    const Status status = solver.advance(20);
    CHECK(allocations() == before);
    REQUIRE(status == Status::reached);
    fewest = std::min(fewest, solver.counts().steps), greatest = std::max(greatest, solver.counts().steps);
    // the wheels hold their no-load rates, but for the torque that turns them with the body over the slope
    const auto state = system.state(20, solver.state());
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(std::abs(state.rotor_rate[k] - one.wheels[k].no_load_rate) < 5 / one.wheels[k].slope);
    CHECK(std::abs(norm(state.attitude) - 1) < 1e-15);
  }
  CHECK(greatest < 2 * fewest);
}

TEST_CASE("a thrust alone moves the centre, too", "[general]") {
  auto p = rich();
  p.torques = {p.torques[2]};
  for (const auto axes : {Axes::body, Axes::inertial}) {
    p.torques[0].axes = axes;
    const Prepared<double> of(p, 5.);
    const auto piece = first_piece(of);
    const auto x = System::first_numbers(of);
    const System system(of, piece, x);
    Lanes<double> y[System::width], z[most], rate[System::width];
    for (int c = 0; c < System::width; ++c) y[c] = lanes(x[std::size_t(c)]);
    for (int k = 0; k < most; ++k) z[k] = lanes(x[std::size_t(System::width + k)]);
    system.rates(system.moment(lanes(0.)), y, z, rate);
    const Vec3<double> f = p.torques[0].vector, force = axes == Axes::body ? rotate<double>(p.attitude, f) : f;
    for (int i = 0; i < 3; ++i) CHECK(rate[10 + i][0] == Approx(force[i] / p.mass));
  }
}

TEST_CASE("numbers of the relaxing form and states are the same", "[general]") {
  const auto p = rich();
  const Prepared<double> of(p, 5.);
  const auto piece = first_piece(of);
  auto x = System::first_numbers(of);
  const System system(of, piece, x);
  const auto state = system.state(0, x.data());
  CHECK((state.angular_velocity - p.angular_velocity).norm() < 1e-14);
  for (std::size_t k = 0; k < 3; ++k) CHECK(state.rotor_rate[k] == Approx(p.wheels[k].rate).epsilon(1e-13));
  const auto scale = system.scale();
  for (std::size_t k = 0; k < 3; ++k) {
    // an error of one scale of z is at most one scale of p
    const auto full = scale_of<double, true>(of);
    for (std::size_t m = 0; m < 3; ++m)
      CHECK(scale[System::width + m] * std::abs(of.settling.to_wheel[k][m]) <=
            full[Places<true>::wheel(k)] * (1 + 1e-14));
  }
  System::Numbers low{};
  for (std::size_t i = 0; i < 4; ++i) x[i] *= 1.001;
  system.project(0, x.data(), low.data());
  double size = 0;
  for (std::size_t i = 0; i < 4; ++i) size += x[i] * x[i];
  CHECK(std::abs(size - 1) < 1e-5);
}

}  // namespace general_stiff_test
