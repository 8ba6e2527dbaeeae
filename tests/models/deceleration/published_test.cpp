// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/published.hpp"

#include <array>
#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/deceleration/stability.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using namespace gyrostat::deceleration::published;
using gyrostat::math::Modulus;
using Vec = Vec3<double>;

namespace {

/// Figures 5 to 13.
Data<double> figure(const Vec& rotor_momentum, const Vec& control = {5, 8, 10}, double sigma = 1.3) {
  return {{35, 22, 16}, rotor_momentum, {0.01, 0.02, 0.03}, control, 0.2, sigma};
}

/// k2 of the body without rotors at the same M, from the components.
double true_modulus(const Data<double>& d) {
  const double A = d.inertia[0], B = d.inertia[1], C = d.inertia[2];
  const Vec m = d.momentum().cwiseProduct(d.momentum());
  return (B - C) * ((A - B) * m[1] / B + (A - C) * m[2] / C) / ((A - B) * ((A - C) * m[0] / A + (B - C) * m[1] / B));
}

struct Run {
  double time;
  ode::Status status;
  std::array<double, 3> state;
};

/// Until k2 leaves [0, 1] or |M| vanishes, where the right-hand side gives NaN.
Run run(const Data<double>& d, Reading reading, double k2 = 0.99, double limit = 3) {
  const System<double> system(d, reading);
  ode::RungeKutta solver(system, 0.0, system.start(k2), ode::StepControl<double, 3>{.relative = 1e-11});
  const ode::Status status = solver.advance(limit);
  return {solver.time(), status, solver.state()};
}

}  // namespace

TEST_CASE("the units of figures 5 to 7") {
  CHECK(figure({100, 150, 50}).momentum_unit() == Approx(187.8).margin(0.05));
  CHECK(figure({150, 150, 50}).momentum_unit() == Approx(218.6).margin(0.05));
  CHECK(figure({200, 150, 50}).momentum_unit() == Approx(255.6).margin(0.05));
}

TEST_CASE("(10): L2 as printed has A/B where A/C belongs") {
  const auto d = figure({100, 150, 50});
  const double S0 = d.rotor_momentum.dot(d.rotor_momentum.cwiseQuotient(d.inertia));
  const auto corrected = rotor_terms(d, Reading::corrected);
  CHECK(corrected[0] == Approx(16 * S0).epsilon(1e-14));
  CHECK(corrected[1] == Approx(35 * S0).epsilon(1e-14));
  const auto printed = rotor_terms(d, Reading::printed);
  CHECK(printed[0] == corrected[0]);
  CHECK(printed[1] == Approx(35 * S0 - 35.0 * 2500 * (1.0 / 16 - 1.0 / 22)).epsilon(1e-14));
}

TEST_CASE("(11): the corrected modulus is that of the momentum, the printed one is another number") {
  struct Row {
    Vec l;
    double right, printed;
  };
  for (const Row& row :
       {Row{{100, 150, 50}, 0.650, 0.359}, Row{{150, 150, 50}, 0.410, 0.573}, Row{{200, 150, 50}, 0.271, 0.873},
        Row{{200, 50, 50}, 0.093, 3.59}, Row{{200, 100, 50}, 0.169, 1.54}, Row{{200, 150, 100}, 0.419, 0.0},
        Row{{200, 150, 150}, 0.665, 0.0}}) {
    const auto d = figure(row.l);
    CHECK(modulus_squared(d, Reading::corrected) == Approx(true_modulus(d)).epsilon(1e-10));
    CHECK(modulus_squared(d, Reading::corrected) == Approx(row.right).margin(6e-4));
    if (row.printed > 0) CHECK(modulus_squared(d, Reading::printed) == Approx(row.printed).epsilon(5e-3));
  }
  // "Without rotors the solutions are imaginary": the orbit is in the other regime.
  CHECK(modulus_squared(figure({0, 0, 0}), Reading::corrected) == Approx(1.501).margin(5e-4));
}

TEST_CASE("(13): beta1 as printed is not the ratio of momentum and energy") {
  for (const Vec& l : {Vec(0, 0, 0), Vec(100, 150, 50), Vec(3, -2, 1)}) {
    auto d = figure(l);
    d.angular_velocity = {0.5, 0.1, -0.2};
    const Vec M = d.momentum();
    const double twice_energy = M.dot(M.cwiseQuotient(d.inertia));
    const double ratio = M.squaredNorm() / twice_energy;
    const double k2 = modulus_squared(d, Reading::corrected);
    CHECK(momentum_energy_ratio(d.inertia, k2, Reading::corrected) == Approx(ratio).epsilon(1e-12));
    CHECK(momentum_energy_ratio(d.inertia, k2, Reading::printed) > 1.004 * ratio);
  }
}

TEST_CASE("(17): the printed factor M^2 belongs to M") {
  // Without rotors; alpha_1 read as alpha and the brackets as the derivation wants them.
  const Vec J(35, 22, 16), b(5, 8, 10);
  const double A = J[0], B = J[1], C = J[2], lambda = 0.2, M = 50;
  const auto m = Modulus<double>::from_k2(0.35);
  const auto mean = math::Native::means(m);
  const double alpha = A * (B - C) + C * (A - B) * m.k2;
  const double H = M * M / (2 * momentum_energy_ratio(J, m.k2, Reading::corrected));
  // (15), corrected, and the chain rule on (11)
  const Vec weight((B - C) * mean.F, (A - C) * mean.W, (A - B) * mean.V);
  const double dM = -lambda * M - b.cwiseProduct(J).dot(weight) / alpha;
  const double dH = -2 * lambda * H - M / alpha * b.dot(weight);
  const double top = 2 * A * H - M * M, bottom = M * M - 2 * C * H;
  const double chain =
      (B - C) / (A - B) * ((2 * A * dH - 2 * M * dM) * bottom - top * (2 * M * dM - 2 * C * dH)) / (bottom * bottom);

  const double bracket =
      (A - B) * bottom * (b[1] * mean.W + b[2] * mean.V) - (B - C) * top * (b[0] * mean.F + b[1] * mean.W);
  const double printed = -(A - B) * (B - C) / std::pow((A - B) * bottom, 2) * 2 * M * M / alpha * (A - C) * bracket;
  CHECK(printed == Approx(M * chain).epsilon(1e-11));

  // The corrected (27c) is the same in its units.
  const System<double> system({J, {0, 0, 0}, {M / A, 0, 0}, b, lambda, 1.3}, Reading::corrected);
  std::array<double, 3> dydt;
  system(0, {0, 1, m.k2}, dydt);
  const double T = 1.3 * M / b[2];
  CHECK(dydt[2] == Approx(T * chain).epsilon(1e-11));
}

TEST_CASE("(21), (22): the quasi-stationary modulus") {
  const auto m = Modulus<double>::from_k2(0.4);
  const auto mean = math::Native::means(m);
  for (const double kappa2 : {0.2, 0.6, 1.5}) {
    const double kappa1 = quasi_stationary_ratio(kappa2, m, Reading::corrected);
    CHECK(kappa1 == Approx(1 + (kappa2 - 1) * torque_balance(m)).epsilon(1e-14));
    const auto growth = [&](double ratio) { return (ratio - 1) * m.k2 * mean.F - (kappa2 - 1) * m.kp2 * mean.W; };
    CHECK(std::abs(growth(kappa1)) <= 1e-15);
    CHECK(std::abs(growth(quasi_stationary_ratio(kappa2, m, Reading::printed))) > 0.05);

    const double below = (kappa1 - kappa2) * mean.F + (kappa2 - 1);
    CHECK((kappa2 - 1) * mean.W / below == Approx(0.4).epsilon(1e-13));
    CHECK((kappa1 - kappa2) * mean.W / below == Approx(-0.238).margin(5e-4));
  }
}

TEST_CASE("(23): the right side is negative for all k2, so that nothing is restricted") {
  for (double k2 = 0.01; k2 < 1; k2 += 0.01) {
    const auto mean = math::Native::means(Modulus<double>::from_k2(k2));
    CHECK((mean.W - k2) / (mean.W + k2 * mean.F - k2) < -1);
  }
}

TEST_CASE("(28): without rotors the printed energy has the wrong sign") {
  for (const double k2 : {0.1, 0.5, 0.99}) {
    const auto d = figure({0, 0, 0});
    CHECK(System<double>(d, Reading::printed).energy_at(1, k2) ==
          -System<double>(d, Reading::corrected).energy_at(1, k2));
  }
  // With them: H of (9) at the given start, in J.
  for (const Vec& l : {Vec(100, 150, 50), Vec(200, 150, 150)}) {
    const auto d = figure(l);
    const double k2 = modulus_squared(d, Reading::corrected);
    CHECK(System<double>(d, Reading::corrected).energy_at(1, k2) * d.control[2] == Approx(d.energy()).epsilon(1e-9));
  }
  CHECK(figure({100, 150, 50}).energy() == Approx(5.5).margin(0.05));
  CHECK(figure({200, 150, 50}).energy() == Approx(6.5).margin(0.05));
  const auto printed_start = [](double l1) {
    return System<double>(figure({l1, 150, 50}), Reading::printed).energy_at(1, 0.99);
  };
  CHECK(printed_start(100) == Approx(13.9).margin(0.05));
  CHECK(printed_start(150) == Approx(8.97).margin(0.005));
  CHECK(printed_start(200) == Approx(2.04).margin(0.005));
}

TEST_CASE("(27) corrected keeps (28) along the motion, with and without rotors") {
  for (const Vec& l : {Vec(0, 0, 0), Vec(100, 150, 50)}) {
    const auto d = figure(l);
    const System<double> system(d, Reading::corrected);
    const Run at = run(d, Reading::corrected, 0.99, 0.6);
    CHECK(at.status == ode::Status::reached);
    CHECK(at.state[0] == Approx(system.energy_at(at.state[1], at.state[2])).epsilon(1e-9));
  }
}

TEST_CASE("(27) as printed: k2 leaves [0, 1] at once for the data of figures 5 to 13") {
  for (const Vec& l : {Vec(100, 150, 50), Vec(150, 150, 50), Vec(200, 150, 50), Vec(200, 50, 50), Vec(200, 100, 50),
                       Vec(200, 150, 100), Vec(200, 150, 150)}) {
    const auto d = figure(l);
    const System<double> system(d, Reading::printed);
    CHECK(system.denominator(1) < 0);
    CHECK(system.denominator(1.23) < 0);
    CHECK(system.denominator(1.44) > 0);
    const Run end = run(d, Reading::printed);
    CHECK(end.status == ode::Status::not_finite);
    CHECK(end.time > 4e-5);
    CHECK(end.time < 1.5e-4);
    CHECK(end.state[2] == Approx(1).margin(1e-3));
  }
}

TEST_CASE("(27) corrected, without rotors: the stop times of figures 14 to 25") {
  struct Row {
    double sigma, kappa1, kappa2, stop, k2;
  };
  for (const Row& row :
       {Row{1.3, 0.75, 0.9, 0.8125, 0.021}, Row{1.3, 0.8, 1, 0.7531, 0.036}, Row{1.3, 0.89, 1.11, 0.6868, 0.149},
        Row{1.8, 0.89, 1.3, 0.457, 0.048}, Row{1.8, 0.76, 1.25, 0.498, 0.0015}, Row{0.7, 0.5, 0.8, 1.749, -1},
        Row{1.3, 0.5, 0.8, 1.017, -1}, Row{1.8, 0.5, 0.8, 0.754, -1}, Row{1.3, 1, 1, 0.71550, 0.99}}) {
    const Run end = run(figure({0, 0, 0}, {row.kappa1, row.kappa2, 1}, row.sigma), Reading::corrected);
    CHECK(end.status != ode::Status::reached);
    CHECK(end.time == Approx(row.stop).margin(6e-4));
    // The figure on the right is at |M| = 1e-3 or so: k2 goes on to fall as a power of |M|.
    if (row.k2 > 0) CHECK(end.state[2] <= row.k2 * 1.1);
  }
  CHECK(run(figure({0, 0, 0}, {1, 1, 1}), Reading::corrected).time == Approx(5 * std::log1p(0.2 / 1.3)).epsilon(1e-9));
}

TEST_CASE("(29) is right, and the perturbed data of figures 23 to 25 break it") {
  const auto m = Modulus<double>::from_k2(0.99);
  CHECK(greatest_ratio(0.8, m) == Approx(0.9947).margin(5e-5));
  CHECK(greatest_ratio(1.07, m) == Approx(1.0019).margin(5e-5));
  const Run end = run(figure({0, 0, 0}, {1.05, 1.07, 1}), Reading::corrected);
  CHECK(end.status == ode::Status::not_finite);
  CHECK(end.time == Approx(0.257).margin(1e-3));
  CHECK(end.state[2] == Approx(1).margin(1e-6));
}
