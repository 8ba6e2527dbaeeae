// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/elliptic.hpp"

#include <new>

#include "allocations.hpp"
#include "catch.hpp"

using namespace gyrostat::math;

static_assert(EllipticBackend<Native, float>);
static_assert(EllipticBackend<Native, double>);
static_assert(EllipticBackend<Native, long double>);
static_assert(!EllipticBackend<int, double>);
static_assert(!EllipticBackend<Native, int>);

TEMPLATE_TEST_CASE("the native backend is the free functions and never allocates", "[math]", float, double,
                   long double) {
  using S = TestType;
  const auto m = Modulus<S>::from_k2(S(0.3));
  const auto before = allocations();
  const auto a = Native::complete(m);
  const auto b = Native::means(m);
  const auto c = Native::jacobi(S(1.1), m);
  const S z = Native::zeta(S(1.1), m);
  const S f = Native::incomplete_F(S(0.6), m);
  const S e = Native::incomplete_E(S(0.6), m);
  const S p = Native::incomplete_Pi(S(0.6), S(0.2), m);
  const auto after = allocations();
  CHECK(after == before);
  // some compilers contract products and sums here otherwise than there
  const auto same = [](S x, S y) { return std::abs(x - y) <= 2 * epsilon<S> * std::abs(y); };
  CHECK(same(a.K, complete(m).K));
  CHECK(same(b.W, means(m).W));
  CHECK(same(c.sn, jacobi(S(1.1), m).sn));
  CHECK(same(z, zeta(S(1.1), m)));
  CHECK(same(f, incomplete_F(S(0.6), m)));
  CHECK(same(e, incomplete_E(S(0.6), m)));
  CHECK(same(p, incomplete_Pi(S(0.6), S(0.2), m)));
  void* volatile memory = ::operator new(sizeof(S));
  ::operator delete(memory);
  CHECK(allocations() > after);  // the counter counts
}
