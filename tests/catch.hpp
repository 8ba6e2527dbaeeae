// SPDX-License-Identifier: BSD-3-Clause
// One include for Catch2 2.13 and 3.x: the test macros, generators, matchers and Approx.
#pragma once

#if GYROSTAT_CATCH2_MAJOR >= 3
#include <catch2/catch_approx.hpp>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_adapters.hpp>
#include <catch2/generators/catch_generators_random.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
