// SPDX-License-Identifier: BSD-3-Clause
// Two files of one program, compiled for different instruction levels: each has its own functions. Were they taken for the same, the
// linker would keep one of them, and the baseline would run instructions that it must not.
#include "levels.hpp"

int main() { return of_baseline() != of_v3() ? 0 : 1; }
