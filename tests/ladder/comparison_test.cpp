// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/comparison.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;

namespace {

struct FreeRow {
  using Scalar = double;
  struct State {
    Quat<double> q;
    Vec3<double> w;
    double angle;
  };
  static constexpr ColumnKind columns[] = {{"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, ""},
                                           {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, ""},
                                           {"angle", 1, "rad", Frame::none, Measure::relative, ""}};
  void operator()(const State& s, double* row) const noexcept {
    for (const double x : {s.q.x, s.q.y, s.q.z, s.q.w, s.w[0], s.w[1], s.w[2], s.angle}) *row++ = x;
  }
};

}  // namespace

TEST_CASE("a comparison measures vectors by their norm, numbers by their size, attitudes by the angle", "[ladder]") {
  Comparison comparison{FreeRow{}};
  const FreeRow::State a{{}, {3, 0, -4}, -2}, b{quaternion_from_vector<double>({0, 0, 0.01}), {3, 0, -4.5}, -2.5};
  comparison.add(a);
  CHECK(comparison.difference().greatest() == 0);
  CHECK(comparison.relative(comparison.difference()).greatest() == 0);
  comparison.add(a, b);
  CHECK(comparison.size()[0] == 1);
  CHECK(comparison.size()[1] == 5);
  CHECK(comparison.size()[2] == 2);
  const auto relative = comparison.relative(comparison.difference());
  CHECK(relative[0] == Approx(0.01));
  CHECK(relative[1] == Approx(0.1));
  CHECK(relative[2] == Approx(0.25));
  FreeRow::State lost = b;
  lost.angle = gyrostat::nan<double>;
  comparison.add(a, lost);
  CHECK(std::isnan(comparison.difference()[2]));
  comparison.add(a, b);
  CHECK(std::isnan(comparison.difference()[2]));
}
