// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/exp_difference.hpp"

#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "catch.hpp"

using gyrostat::epsilon;
using namespace gyrostat::math;

namespace {

template <class S, std::size_t n>
Complex<S> of(const std::vector<long double>& cells) {
  std::array<Complex<S>, n> z;
  for (std::size_t i = 0; i < n; ++i) z[i] = {S(cells[2 * i]), S(cells[2 * i + 1])};
  return exp_difference(z);
}

template <class S>
Complex<S> of(std::size_t n, const std::vector<long double>& cells) {
  switch (n) {
    case 1: return of<S, 1>(cells);
    case 2: return of<S, 2>(cells);
    case 3: return of<S, 3>(cells);
    case 4: return of<S, 4>(cells);
    case 5: return of<S, 5>(cells);
    default: return of<S, 6>(cells);
  }
}

long double factorial(std::size_t n) { return n < 2 ? 1 : static_cast<long double>(n) * factorial(n - 1); }

}  // namespace

TEMPLATE_TEST_CASE("divided differences of exp against 25 digits", "[math]", double, long double) {
  using S = TestType;
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/exp_difference.csv");
  REQUIRE(file.good());
  std::string line;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line[0] == '#') continue;
    std::istringstream text(line);
    std::string cell;
    std::getline(text, cell, ',');
    const std::size_t n = std::stoul(cell);
    std::vector<long double> cells;
    while (std::getline(text, cell, ','))  // nodes are doubles
      cells.push_back(cells.size() < 2 * n ? std::stod(cell) : std::strtold(cell.c_str(), nullptr));
    REQUIRE(cells.size() == 2 * n + 2);
    long double greatest = cells[0];
    long double size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      greatest = std::max(greatest, cells[2 * i]);
      size = std::max(size, std::hypot(cells[2 * i], cells[2 * i + 1]));
    }
    const Complex<S> got = of<S>(n, cells);
    const long double error = std::hypot(static_cast<long double>(got.re) - cells[2 * n],
                                         static_cast<long double>(got.im) - cells[2 * n + 1]);
    INFO(line);
    CHECK(error <= (16 + size) * epsilon<S> * std::exp(greatest) / factorial(n - 1));
    ++rows;
  }
  CHECK(rows == 88);
}

TEST_CASE("divided differences of exp between clusters at every distance", "[math]") {
  // against the same in long double, whose error is 2000 times smaller
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  double worst = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<Complex<double>, 6> z;
    std::array<Complex<long double>, 6> wide;
    const double size = std::pow(10, 1.5 * u(random));
    const double centre[3] = {0, size * u(random), size * u(random)};
    for (std::size_t i = 0; i < 6; ++i) {
      const double x = centre[random() % 3] + (random() % 3 == 0 ? 1e-3 * u(random) : 0);
      z[i] = trial % 3 == 0   ? Complex<double>{x, 0}
             : trial % 3 == 1 ? Complex<double>{0, x}
                              : Complex<double>{x / 8, x};
      wide[i] = complex_cast<long double>(z[i]);
    }
    double greatest = z[0].re;
    for (const auto& value : z) greatest = std::max(greatest, value.re);
    const auto error = complex_cast<long double>(exp_difference(z)) - exp_difference(wide);
    worst = std::max(worst, double(magnitude(error)) * 120 / std::exp(greatest));
  }
  CHECK(worst < 6e-15);
}

TEST_CASE("exactly real where the nodes are symmetric", "[math]") {
  for (double nu : {0.0, 1e-12, 0.3, 2.0, 77.0}) {
    const Complex<double> up{0, nu}, down{0, -nu}, zero;
    const auto S = exp_difference(std::array{up, down});
    const auto V = exp_difference(std::array{zero, up, down});
    CHECK(S.im == 0);
    CHECK(V.im == 0);
    CHECK(S.re == Approx(nu == 0 ? 1 : std::sin(nu) / nu).margin(1e-15));
    CHECK(V.re == Approx(nu == 0 ? 0.5 : 2 * std::pow(std::sin(nu / 2) / nu, 2)).margin(1e-15));
    const auto pair = exp_difference(std::array<Complex<double>, 4>{{{0.2, nu}, {-0.4, 1}, {0.2, -nu}, {-0.4, -1}}});
    CHECK(pair.im == 0);
  }
  CHECK(exp_difference(std::array<Complex<double>, 3>{{{1, 0}, {1, 0}, {2, 0}}}).im == 0);
  CHECK(exp_difference(std::array<Complex<double>, 3>{{{0, 1}, {0, 1}, {0, -1}}}).im != 0);
}

TEST_CASE("laws of divided differences of exp", "[math]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const double size = std::pow(10, u(random));
    std::array<Complex<double>, 4> z;
    for (auto& value : z) value = {0, size * u(random)};
    // the recurrence over any pair
    const auto whole = exp_difference(z);
    const auto head = exp_difference(std::array{z[0], z[1], z[2]}), tail = exp_difference(std::array{z[1], z[2], z[3]});
    const auto wrong = (z[3] - z[0]) * whole - (tail - head);
    CHECK(magnitude(wrong) <= 1e-14 * (1 + size));
    // no order of the nodes
    CHECK(magnitude(exp_difference(std::array{z[2], z[0], z[3], z[1]}) - whole) <= 1e-15);
    // a common shift is a factor
    const Complex<double> shift{0.3, 1.1};
    auto moved = z;
    for (auto& value : moved) value = value + shift;
    CHECK(magnitude(exp_difference(moved) - exponential(shift) * whole) <= 1e-15 * (1 + size));
    // conjugate nodes, conjugate value
    auto mirrored = z;
    for (auto& value : mirrored) value = conjugate(value);
    CHECK(magnitude(exp_difference(mirrored) - conjugate(whole)) <= 1e-15);
    // a mean over the hull
    CHECK(magnitude(whole) <= (1 + 1e-14) / 6);
  }
}

TEST_CASE("differences over t are the responses of chains of first order", "[math]") {
  // d/dt [0^(k+1), S] = [0^k, S] and (d/dt - a)[S, a] = [S], by central differences
  using Differences = ExpDifferences<long double, 3, 3>;
  const std::array<Complex<long double>, 3> a{{{0.1L, 1.3L}, {-0.2L, 0.4L}, {0, 1.2999L}}};
  Differences::Entries all = 0;
  for (Differences::Set s = 1; s < Differences::sets; ++s)
    for (int k = 0; k <= 3; ++k) all |= Differences::entry(k, s);
  const Differences differences(a, all);
  const auto at = [&](long double t) {
    Differences::Table f;
    differences.evaluate(t, {exponential(t * a[0]), exponential(t * a[1]), exponential(t * a[2])}, f);
    return f;
  };
  for (long double t : {-3.0L, -0.01L, 0.02L, 0.8L, 2.2L, 9.0L}) {
    const long double h = 1e-5L;
    const auto before = at(t - h), here = at(t), after = at(t + h);
    const auto slope = [&](int k, Differences::Set s) { return (1 / (2 * h)) * (after(k, s) - before(k, s)); };
    for (Differences::Set s = 1; s < Differences::sets; ++s) {
      for (int k = 1; k <= 3; ++k) CHECK(double(magnitude(slope(k, s) - here(k - 1, s))) < 2e-8);
      for (int i = 0; i < 3; ++i)
        if (const auto without = s & ~(1u << i); without != 0 && without != s)
          CHECK(double(magnitude(slope(0, s) - a[std::size_t(i)] * here(0, s) - here(0, without))) < 2e-8);
    }
  }
  const auto start = at(0);
  for (Differences::Set s = 1; s < Differences::sets; ++s)
    for (int k = 0; k <= 3; ++k)
      CHECK(start(k, s) == Complex<long double>{k == 0 && std::has_single_bit(s) ? 1.0L : 0, 0});
}

TEST_CASE("divided differences take no memory", "[math]") {
  const std::array<Complex<double>, 6> z{{{0, 1}, {0, 2}, {0, 30}, {0, 0}, {0, 0}, {1, 2}}};
  const auto before = allocations();
  const auto value = exp_difference(z);
  CHECK(allocations() == before);
  CHECK(std::isfinite(value.re));
  STATIC_REQUIRE(noexcept(exp_difference(z)));
}
