// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/closed_form_rung.hpp"

#include "posed.hpp"

using namespace free_scenes;

TEST_CASE("rung closed-form: an even grid and single times agree, at any time", "[free]") {
  std::vector<double> even_times, odd_times;
  for (int i = 0; i < 500; ++i) even_times.push_back(0.37 * i);
  odd_times = even_times;
  odd_times.insert(odd_times.begin() + 1, 0.011);
  const auto assembly = body({3, 2.5, 1}, {0.2, -0.1, 0.4}, {0.5, 1, -0.3});
  const Scene scene = posed(assembly, even_times, 1e-9, free::rung::closed_form);
  const Answer grid = solved(scene), single = solved(posed(assembly, odd_times, 1e-9, free::rung::closed_form));
  for (std::size_t i = 1; i < 500; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(grid.find("angular_velocity")->values[3 * i + k] ==
            Approx(single.find("angular_velocity")->values[3 * (i + 1) + k]).margin(1e-13));
  check_honest(scene, grid);
}

TEST_CASE("rung closed-form: where the data do not fix the phase it says so", "[free]") {
  const auto flips = body({3, 2, 1}, {0, 0, 0}, {1e-9, 1, 1e-9});
  const Scene soon = posed(flips, {10, 30}, 1e-3, free::rung::closed_form),
              late = posed(flips, {1e15}, 1e-3, free::rung::closed_form);
  check_honest(soon, solved(soon));
  CHECK(solved(soon).warns("near-separatrix"));
  const Answer lost = solved(late);
  CHECK_FALSE(lost.met);
  CHECK(lost.warns("phase-unknown"));
  CHECK(lost.find("attitude")->error == infinity<double>);
  const Answer stands = solved(posed(body({3, 2, 1}, {0, 0, 0}, {0, 1, 0}), {1000}, 1e-3, free::rung::closed_form));
  CHECK(stands.warns("unstable-rotation"));
  CHECK_FALSE(stands.met);
}

TEST_CASE("rung closed-form: a momentum that is all rounding is stated by the size of its parts", "[free]") {
  Mat3<double> J = body({3, 2.9, 0.2}, {0, 0, 0}, {0, 0, 0}).body.inertia;
  const Mat3<double> R = to_matrix<double>(normalised(Quat<double>{0.3, -0.5, 0.7, 0.2}));
  J = R * J * R.transpose();
  for (const bool turned : {false, true}) {
    auto assembly = body({4, 3, 2}, {-2, -3, -0.5}, {0.5, 1, 0.25});
    if (turned) {
      assembly.body.inertia = (J + J.transpose()) / 2;
      assembly.body.angular_velocity = R.col(2);
      assembly.body.rotor_momentum = -(assembly.body.inertia * R.col(2));
    }
    const Scene scene = posed(assembly, {10, 20, 30}, 1e-3, free::rung::closed_form);
    const Answer answer = solved(scene);
    const auto& column = *answer.find("angular_momentum");
    const Vec3<DoubleDouble> truth = scene.precise().problem.momentum();  // and it keeps that length
    double off = 0;
    for (std::size_t i = 0; i < column.values.size(); i += 3)
      off = std::max(off, Vec3<double>(&column.values[i]).norm() + double(truth.norm()));
    CAPTURE(turned, off, column.error, column.scale);
    CHECK(column.error < 1e-9);
    CHECK(off <= column.error * std::max(column.scale, off));
  }
}
