// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/complex.hpp"

#include <complex>

#include "catch.hpp"

using gyrostat::epsilon;
using namespace gyrostat::math;

TEMPLATE_TEST_CASE("complex numbers agree with std::complex", "[math]", float, double, long double) {
  using S = TestType;
  using Std = std::complex<S>;
  const Complex<S> a{S(1.5), S(-0.25)}, b{S(-0.75), S(3)};
  const Std A(a.re, a.im), B(b.re, b.im);
  const auto same = [](Complex<S> x, Std y) { return std::abs(Std(x.re, x.im) - y) <= 4 * epsilon<S> * std::abs(y); };
  CHECK(same(a + b, A + B));
  CHECK(same(a - b, A - B));
  CHECK(same(-a, -A));
  CHECK(same(a * b, A * B));
  CHECK(same(S(3) * a, S(3) * A));
  CHECK(same(a / S(3), A / S(3)));
  CHECK(same(conjugate(a), std::conj(A)));
  CHECK(same(turned(a), Std(0, 1) * A));
  CHECK(same(inverse(a), S(1) / A));
  CHECK(same(exponential(a), std::exp(A)));
  CHECK(same(unit(S(0.7)), std::polar(S(1), S(0.7))));
  CHECK(magnitude(a) == Approx(double(std::abs(A))));
  CHECK(complex_cast<double>(a) == Complex<double>{1.5, -0.25});
}

TEMPLATE_TEST_CASE("the magnitude without a root is no less, and at most 8 % more", "[math]", float, double,
                   long double) {
  using S = TestType;
  for (int i = 0; i <= 720; ++i) {
    const auto a = S(3) * unit(S(i) * gyrostat::pi<S> / 360);
    CHECK(magnitude_at_most(a) >= magnitude(a) * (1 - 2 * gyrostat::epsilon<S>));
    CHECK(magnitude_at_most(a) <= S(1.083L) * magnitude(a));
  }
  CHECK(magnitude_at_most(Complex<S>{0, -2}) == 2);
  CHECK(std::isnan(magnitude_at_most(Complex<S>{gyrostat::nan<S>, 1})));
  CHECK(std::isnan(magnitude_at_most(Complex<S>{1, gyrostat::nan<S>})));
}

TEST_CASE("complex numbers near the limits of the range", "[math]") {
  CHECK(magnitude(Complex<double>{3e200, 4e200}) == Approx(5e200));
  const auto small = inverse(Complex<double>{3e200, -4e200});
  CHECK(small.re == Approx(0.12e-200));
  CHECK(small.im == Approx(0.16e-200));
  CHECK(exponential(Complex<double>{0, 1.25}) == unit(1.25));
}
