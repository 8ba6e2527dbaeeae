// SPDX-License-Identifier: BSD-3-Clause
// The module runs with glibc 2.34 and older, so it may call nothing newer. hypot has a version of its own since 2.35, which a
// newer glibc would bind; the linker sends all calls here (--wrap=hypot), and they go to the version that every glibc has. From
// 2.35 on both compute the same digits: they differ in who sets errno. On the way the upper halves of wide registers are given free, which
// GCC at times leaves in use: what glibc has for SSE waits for them.
#ifdef __AVX__
#include <immintrin.h>
#endif

extern "C" {

double hypot_of_every_glibc(double x, double y) noexcept;
__asm__(".symver hypot_of_every_glibc, hypot@GLIBC_2.2.5");

double __wrap_hypot(double x, double y) noexcept;
double __wrap_hypot(double x, double y) noexcept {
#ifdef __AVX__
  _mm256_zeroupper();
#endif
  return hypot_of_every_glibc(x, y);
}

}  // extern "C"
