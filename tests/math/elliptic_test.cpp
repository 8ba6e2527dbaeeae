// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/elliptic.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include "catch.hpp"

using namespace gyrostat::math;

static_assert(EllipticBackend<Native, float>);
static_assert(EllipticBackend<Native, double>);
static_assert(EllipticBackend<Native, long double>);
static_assert(!EllipticBackend<int, double>);
static_assert(!EllipticBackend<Native, int>);

// The address sanitizer has its own operator new, and a test must not replace it.
#if defined(__SANITIZE_ADDRESS__)
#define GYROSTAT_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GYROSTAT_COUNTS_ALLOCATIONS 0
#endif
#endif
#if !defined(GYROSTAT_COUNTS_ALLOCATIONS)
#define GYROSTAT_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<long> allocations{0};
}

#if GYROSTAT_COUNTS_ALLOCATIONS
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

TEMPLATE_TEST_CASE("the native backend is the free functions and never allocates", "[math]", float, double,
                   long double) {
  using S = TestType;
  const auto m = Modulus<S>::from_k2(S(0.3));
  const long before = allocations;
  const auto a = Native::complete(m);
  const auto b = Native::means(m);
  const auto c = Native::jacobi(S(1.1), m);
  const S z = Native::zeta(S(1.1), m);
  const S f = Native::incomplete_F(S(0.6), m);
  const S e = Native::incomplete_E(S(0.6), m);
  const S p = Native::incomplete_Pi(S(0.6), S(0.2), m);
  const long after = allocations;
  CHECK(after == before);
  CHECK(a.K == complete(m).K);
  CHECK(b.W == means(m).W);
  CHECK(c.sn == jacobi(S(1.1), m).sn);
  CHECK(z == zeta(S(1.1), m));
  CHECK(f == incomplete_F(S(0.6), m));
  CHECK(e == incomplete_E(S(0.6), m));
  CHECK(p == incomplete_Pi(S(0.6), S(0.2), m));
#if GYROSTAT_COUNTS_ALLOCATIONS
  void* volatile memory = ::operator new(sizeof(S));
  ::operator delete(memory);
  CHECK(allocations > after);  // the counter counts
#endif
}
