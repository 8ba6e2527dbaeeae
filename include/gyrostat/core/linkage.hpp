// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Marks a function that the library gyrostat::gyrostat holds compiled, and that is inline where the headers are used alone. Its
/// definition stands in a header of its own, so that who links the library does not compile it again.
#ifdef GYROSTAT_COMPILED
#define GYROSTAT_COMPILED_ONCE
#else
#define GYROSTAT_COMPILED_ONCE inline
#endif
