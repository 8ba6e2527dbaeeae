// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/full_rung.hpp"

#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("rung full of a free body agrees with the closed form, wheels and all", "[free]") {
  for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
    const std::vector<double> times{0, 3, 11, 40};
    const Scene scene = posed(wheeled(), times, tolerance, free::rung::full);
    const Answer full = solved(scene), form = solved(posed(wheeled(), times, tolerance, free::rung::closed_form));
    CHECK(full.met);
    check_honest(scene, full);
    for (const char* name : {"rotor_rate", "rotor_angle"}) {
      const Column &a = *full.find(name), &b = *form.find(name);
      double off = 0, size = 0;
      for (std::size_t i = 0; i < a.values.size(); i += 2) {
        off = std::max(off, std::hypot(a.values[i] - b.values[i], a.values[i + 1] - b.values[i + 1]));
        size = std::max(size, std::hypot(b.values[i], b.values[i + 1]));
      }
      CAPTURE(name, tolerance, off / size, a.error, b.error);
      CHECK(off <= (a.error + b.error) * size);
      CHECK(a.error < tolerance);
    }
  }
}

TEST_CASE("rung full of a free body refuses what no double can follow", "[free]") {
  gyrostat::Refusal refusal;
  (void)free::solve(posed(body({3, 2, 1}, {0, 0, 0}, {1, 1, 1}), {1e12}, 1e-9, free::rung::full), refusal);
  CHECK(refusal.code == Errc::step_limit);
  (void)free::solve(posed(body({3, 2, 1}, {0, 0, 0}, {1, 1, 1}), {1e9}, 1e-2, free::rung::full), refusal);
  CHECK(refusal.code == Errc::step_limit);
}
