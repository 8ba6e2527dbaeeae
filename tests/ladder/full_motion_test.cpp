// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/full_motion.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("progress is reported where it is asked for and never passes one; a set flag cancels", "[ladder]") {
  MotionOptions<double> nobody;
  nobody.report(0.5);
  CHECK_FALSE(nobody.cancelled());
  std::atomic<double> progress{0};
  std::atomic<bool> cancel{false};
  MotionOptions<double> options;
  options.progress = &progress;
  options.cancel = &cancel;
  options.report(1.5);
  CHECK(progress == 1);
  CHECK_FALSE(options.cancelled());
  cancel = true;
  CHECK(options.cancelled());

  Monitor monitor;
  MotionOptions<double> watched;
  watched.watched_by(nullptr);
  CHECK_FALSE(watched.cancelled());
  watched.watched_by(&monitor);
  watched.report(0.5);
  CHECK(monitor.fraction == 0.5);
  CHECK_FALSE(watched.cancelled());
  monitor.stop = []() noexcept { return true; };
  CHECK(monitor.cancelled());
  watched.watched_by(&monitor);
  CHECK(watched.cancelled());
}

TEST_CASE("a phase that no double holds is known before it is followed; a short motion is followed in any case",
          "[ladder]") {
  CHECK(phase_too_long(1e12, 1e-6));
  CHECK_FALSE(phase_too_long(1e9, 1e-6));
  CHECK_FALSE(phase_too_long(1e5, 1e-15));
  CHECK(phase_too_long(infinity<double>, 1e-3));
}
