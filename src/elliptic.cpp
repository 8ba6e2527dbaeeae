// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/complete.hpp"

namespace gyrostat::math {

#if defined(__GNUC__) && defined(__x86_64__)

namespace {

[[gnu::target("avx512f,avx512dq,fma")]] void complete_avx512(const double* k2, const double* kp2, double* K, double* E,
                                                             std::size_t n) noexcept {
  detail::complete_loop(k2, kp2, K, E, n);
}

[[gnu::target("avx2,fma")]] void complete_avx2(const double* k2, const double* kp2, double* K, double* E,
                                               std::size_t n) noexcept {
  detail::complete_loop(k2, kp2, K, E, n);
}

}  // namespace

// the widest vectors that this processor has; without fused multiply-add the last bit may differ
void complete(const double* k2, const double* kp2, double* K, double* E, std::size_t n) noexcept {
  if (__builtin_cpu_supports("avx512dq")) return complete_avx512(k2, kp2, K, E, n);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return complete_avx2(k2, kp2, K, E, n);
  detail::complete_loop(k2, kp2, K, E, n);
}

#else

void complete(const double* k2, const double* kp2, double* K, double* E, std::size_t n) noexcept {
  detail::complete_loop(k2, kp2, K, E, n);
}

#endif

}  // namespace gyrostat::math
