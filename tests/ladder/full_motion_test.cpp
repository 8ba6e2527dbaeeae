// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/full_motion.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("progress is reported where it is asked for and never passes one; a set flag cancels", "[ladder]") {
  MotionOptions<double> nobody;
  nobody.report(0.5);
  CHECK_FALSE(nobody.cancelled());
  Monitor monitor;
  MotionOptions<double> options;
  options.monitor = &monitor;
  options.report(1.5);
  CHECK(monitor.fraction == 1);
  CHECK_FALSE(options.cancelled());
  monitor.cancel = true;
  CHECK(options.cancelled());
}

TEST_CASE("what stops the work once, as a signal does, stops all of it", "[ladder]") {
  static int asked;
  asked = 0;
  Monitor monitor;
  monitor.stop = []() noexcept { return ++asked == 2; };
  MotionOptions<double> options;
  options.monitor = &monitor;
  CHECK_FALSE(options.cancelled());
  for (int i = 0; i < 3; ++i) CHECK(options.cancelled());
  CHECK(asked == 2);
  CHECK(monitor.cancel);
}

TEST_CASE("a phase that no double holds is known before it is followed; a short motion is followed in any case",
          "[ladder]") {
  CHECK(phase_too_long(1e12, 1e-6));
  CHECK_FALSE(phase_too_long(1e9, 1e-6));
  CHECK_FALSE(phase_too_long(1e5, 1e-15));
  CHECK(phase_too_long(infinity<double>, 1e-3));
}

TEST_CASE("what a motion cannot be asked for so", "[ladder]") {
  MotionOptions<double> options;
  const std::vector<double> times{0, 1, 2}, tolerances{1e-3, 1e-6};
  CHECK(options.check(times, 3, 4) == Errc::ok);
  CHECK(options.check(times, 2, 4) == Errc::out_of_domain);
  options.wanted = tolerances;
  CHECK(options.check(times, 3, 2) == Errc::ok);
  CHECK(options.check(times, 3, 4) == Errc::out_of_domain);
  options.wanted = {};
  CHECK(options.check(std::vector<double>{1, 0}, 2, 4) == Errc::not_increasing);
  options.tolerance = -1e-9;
  CHECK(options.check(times, 3, 4) == Errc::negative);
  options.tolerance = gyrostat::nan<double>;
  CHECK(options.check(times, 3, 4) == Errc::not_finite);
}
