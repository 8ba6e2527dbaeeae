// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The instruction level that this file is compiled for, as far as it changes the code: v4 with AVX-512, v3 with AVX2, both with fused
/// multiply-add, v2f with AVX and that, v2 with AVX alone, v1 else. It is an inline namespace of all that gyrostat declares: where files of one program are compiled
/// with different options, each calls the functions of its own level, and a library of another level is an error of the linker, not
/// an illegal instruction on somebody's processor. What Eigen and the standard library leave to the linker it goes on sharing: a program that
/// is to run on the lesser processor needs all its files compiled for it.
#if defined(__AVX512F__) && !defined(__FMA__)
#error "AVX-512 without fused multiply-add: add -mfma, or say -march=x86-64-v4"
#elif defined(__AVX512F__)
#define GYROSTAT_LEVEL v4
#elif defined(__AVX2__) && defined(__FMA__)
#define GYROSTAT_LEVEL v3
#elif defined(__AVX__) && defined(__FMA__)
#define GYROSTAT_LEVEL v2f
#elif defined(__AVX__)
#define GYROSTAT_LEVEL v2
#else
#define GYROSTAT_LEVEL v1
#endif

// declared here first, so that every namespace gyrostat::math, without more words, is the one of the level
namespace gyrostat::inline GYROSTAT_LEVEL {
namespace math {}
namespace ode {}
namespace deceleration {}
namespace spinning {}
namespace heavy {}
namespace rotor {}
namespace free {}
namespace general {}
namespace honesty {}
}  // namespace gyrostat::inline GYROSTAT_LEVEL
