// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/floquet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "bodies.hpp"
#include "catch.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/series.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

/// The trace, less 4, of the derivative of the motion over one period by its start.
double monodromy(const Problem<double>& problem, const State<double>& start, double period) {
  using Numbers = std::array<double, 42>;
  const auto rate = [&problem](double, const Numbers& y, Numbers& dy) noexcept {
    const Vec3<double> w(y[0], y[1], y[2]), d(y[3], y[4], y[5]);
    const auto J = state_jacobian(problem, w, d);
    Eigen::Map<Eigen::Matrix<double, 6, 7>> out(dy.data());
    out.col(0) << angular_acceleration(problem, w, d), d.cross(w);
    out.rightCols<6>() = J * Eigen::Map<const Eigen::Matrix<double, 6, 7>>(y.data()).rightCols<6>();
  };
  Numbers y{};
  for (std::size_t i = 0; i < 3; ++i) {
    y[i] = start.angular_velocity[static_cast<int>(i)];
    y[3 + i] = start.down[static_cast<int>(i)];
  }
  for (std::size_t i = 0; i < 6; ++i) y[6 + 7 * i] = 1;
  ode::RungeKutta solver(rate, 0.0, y, ode::StepControl<double, 42>{.relative = 1e-11});
  REQUIRE(solver.advance(period) == ode::Status::reached);
  double trace = -4;
  for (std::size_t i = 0; i < 6; ++i) trace += solver.state()[6 + 7 * i];
  return trace;
}

Floquet<double> floquet(const Problem<double>& problem, double spin, double G0) {
  return Floquet<double>(*Scaled<double>::make(problem, spin, G0));
}

/// A body with c = 1, G0 = 0.1 and free nutation at omega = 1/2.
Problem<double> resonant(double off = 0) { return unit_body(0.55, 0.7659574468085106 + off, {0.6, 0.48, 0.64}, 0.0); }

}  // namespace

TEST_CASE("floquet: the exponent is right to its stated error, and the verdict never wrong", "[heavy]") {
  std::mt19937 random(5);
  int decided = 0, tried = 0;
  for (int body = 0; body < 120; ++body) {
    const Draw d = draw(random, 0.05, 0.95);
    const double spin = std::array{30.0, 10.0, 5.0}[static_cast<std::size_t>(body % 3)];
    const auto s = Series<double>::to_tolerance(d.body(), spin, d.G0, 1e-9, 0);
    if (!s || s->error(0).down > 1e-7) continue;
    const double trace = monodromy(d.body(), s->at(0), s->period());
    const auto f = floquet(d.body(), spin, d.G0);
    tried += 1;
    decided += f.verdict != FastStability::undecided;
    INFO(trace << " " << d.a << " " << d.b << " " << spin);
    if (f.verdict == FastStability::stable) CHECK(std::abs(trace) < 2 + 1e-7);
    if (f.verdict == FastStability::unstable) CHECK(std::abs(trace) > 2 - 1e-7);
    const double folded = std::acos(std::clamp(trace / 2, -1.0, 1.0)) / (2 * pi<double>);
    if (std::abs(trace) > 1.999 || !(f.squared > 0) || std::abs(f.exponent() - 0.5) < 2 * f.tongue) continue;
    const double nu = f.exponent() > 0.5 ? 1 - folded : folded;
    CHECK(std::abs(nu * nu - f.exponent() * f.exponent()) < f.squared_error);
  }
  CHECK(tried > 100);
  CHECK(decided > tried * 3 / 4);
}

TEST_CASE("floquet: slim bodies without weight in a gradient, which resonates at nu = 1", "[heavy]") {
  int decided = 0;
  for (const double slim : {8., 32., 128.})
    for (const double k : {1e-6, 1e-5, 1e-4, 5.568e-4})
      for (const double G0 : {0., 0.4}) {
        CAPTURE(slim, k, G0);
        const auto body = unit_body<double>(slim, slim, {0, 0, 0}, k);
        const auto found = floquet(body, 1, G0);
        const auto orbit = Series<double>::make(body, 1, G0, 8);
        if (!orbit) continue;
        const double trace = monodromy(body, orbit->at(0), orbit->period());
        const double nu2 = std::pow(std::acos(std::clamp(trace / 2, -1., 1.)) / (2 * pi<double>), 2);
        if (found.verdict == FastStability::undecided) continue;
        ++decided;
        CHECK((found.verdict == FastStability::stable) == (trace < 2));
        const double nu = std::sqrt(found.squared), folded = std::min(nu, std::abs(1 - nu));
        CHECK(std::abs(folded - std::sqrt(nu2)) < found.nu_error + 1e-9);
      }
  CHECK(decided > 8);
}

TEST_CASE("floquet: the error of the exponent is of order 4 in eps", "[heavy]") {
  const auto body = unit_body(0.55, 0.8, {0.6, 0.48, 0.64}, 0.7);
  double last = 0;
  for (double eps : {0.1, 0.05}) {
    const auto s = Series<double>::make(body, 1 / eps, 0.3, 26);
    REQUIRE(s);
    const auto f = floquet(body, 1 / eps, 0.3);
    const double nu = std::acos(monodromy(body, s->at(0), s->period()) / 2) / (2 * pi<double>);
    const double error = std::abs(nu - f.exponent());
    if (last > 0) CHECK(std::log2(last / error) == Approx(4).margin(0.3));
    last = error;
  }
}

TEST_CASE("floquet: periodic motions of the reference", "[heavy]") {
  for (const auto& row : reference_rows("periodic")) {
    const auto f = floquet(row.problem(), row.number[9], row.number[10]);
    const double nu = std::acos(row.number[14] / 2) / (2 * pi<double>);
    CHECK(std::abs(nu * nu - f.exponent() * f.exponent()) < f.squared_error);
    if (row.id != "pub04") CHECK(f.verdict == FastStability::stable);
  }
}

TEST_CASE("floquet: through the tongue at nu = 1/2", "[heavy]") {
  for (const auto& row : reference_rows("floquet", false)) {
    const double eps = row.number[0];
    const auto f = floquet(unit_body(0.55, row.number[1], {0.6, 0.48, 0.64}, 0.0), 1 / eps, 0.1);
    INFO(eps << " " << row.number[1]);
    CHECK(f.trace_minus_4 == Approx(row.number[2]).margin(0.35 * eps * eps * eps));
    if (f.verdict == FastStability::stable) CHECK(std::abs(row.number[2]) < 2);
    if (f.verdict == FastStability::unstable) CHECK(std::abs(row.number[2]) > 2);
  }
  // the greatest growth rate over a revolution, 2 pi |kr| eps^2
  const auto at = floquet(resonant(), 40, 0.1);
  CHECK(at.verdict == FastStability::unstable);
  CHECK(2 * pi<double> * at.tongue * 1600 == Approx(0.6014).epsilon(2e-3));
  CHECK(floquet(resonant(0.01), 20, 0.1).verdict == FastStability::stable);
  CHECK(floquet(unit_body(0.55, 0.7659574468085106, {0, 0, 1}, 0.0), 20, 0.1).tongue == 0);
}

TEST_CASE("floquet: moments nearly equal are far from the tongue", "[heavy]") {
  for (double off : {1e-2, 1e-4, 1e-5})
    for (double a : {0.58, 1.6}) {
      const auto body = unit_body(a, a < 1 ? 1 - off : 1 + off, {0.6, 0.48, 0.64}, 0.3);
      const auto s = Series<double>::to_tolerance(body, 200, 0, 1e-9, 0);
      REQUIRE(s);
      const double trace = monodromy(body, s->at(0), s->period());
      const auto f = floquet(body, 200, 0);
      INFO(off << " " << a << " " << trace);
      CHECK(std::abs(trace) < 2);
      CHECK(f.verdict != FastStability::unstable);
      CHECK(f.tongue < 0.01);
      CHECK(std::abs(f.trace_minus_4 - trace) < 4 * pi<double> * pi<double> * f.squared_error + 1e-9);
    }
  // as at omega = 1/2 with the pole that it has off it
  const double a = 0.55, b = 0.7659574468085106, M3 = std::sqrt(0.99);
  const double kr = M3 / 2 * std::hypot(0.6 * (1.5 - 1 / b), 0.48 * (1 / (2 * (1 - b)) - 1 / a));
  CHECK(floquet(resonant(), 20, 0.1).tongue == Approx(kr / 400).epsilon(1e-12));
}

TEST_CASE("floquet: the second family, with and without", "[heavy]") {
  // at G0 = 0: k W3/W0 with W3 = omega^2 (a + b)/2, W0 = (a - 1)(a + b - 2)/(2 b)
  const double a = 0.55, b = 0.8, omega2 = (a - 1) * (b - 1) / (a * b);
  const auto f = floquet(unit_body(a, b, {0.6, 0.48, 0.64}, 0.7), 40, 0);
  CHECK(f.second_family_squared() == Approx(0.7 * omega2 * (a + b) * b / ((a - 1) * (a + b - 2))));
  CHECK(floquet(unit_body(a, b, {0.6, 0.48, 0.64}, 0.0), 40, -0.1).second_family_squared() < 0);
}

TEST_CASE("floquet: boundaries", "[heavy]") {
  const Vec3<double> at{0.6, 0.48, 0.64};
  const auto verdict = [](double a, double b, Vec3<double> direction, double k, double spin = 20, double G0 = 0.1) {
    return floquet(unit_body(a, b, direction, k), spin, G0).verdict;
  };
  CHECK(verdict(0.7, 1.3, at, 0.3) == FastStability::unstable);  // axis 3 intermediate
  CHECK(verdict(0.7, 0.7, at, 0.3) == FastStability::stable);
  CHECK(verdict(0.9999, 0.7, at, 0.3) == FastStability::undecided);  // omega near 0
  CHECK(verdict(0.6, 0.4001, at, 0.3) == FastStability::undecided);  // near 1
  CHECK(verdict(0.55, 0.8, at, 0.3, 1.0) == FastStability::undecided);
  CHECK(verdict(1, 0.8, at, 0.3) == FastStability::undecided);  // the motion itself is not there
}
