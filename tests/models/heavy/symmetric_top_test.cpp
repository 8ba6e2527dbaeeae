// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/symmetric_top.hpp"

#include "catch.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;

Result<SymmetricTop<double>> of(const V& inertia, const V& centre, double gradient = 0) {
  const auto made = Problem<double>::make(inertia, 1, centre, 9.8, gradient);
  REQUIRE(made);
  return SymmetricTop<double>::of(*made);
}

}  // namespace

TEST_CASE("symmetric top: the axis is found, and its frame is a rotation", "[heavy]") {
  for (int k = 0; k < 3; ++k) {
    V I(1, 1, 1), c = V::Zero();
    I[k] = 0.6;
    c[k] = -0.1;
    const auto top = of(I, c, 2);
    REQUIRE(top);
    CHECK(top->across == 1);
    CHECK(top->along == 0.6);
    CHECK(top->weight == Approx(-0.98));
    CHECK(top->gradient_rate() == Approx(-0.8));
    CHECK(top->axes.col(2) == V::Unit(k));
    CHECK(top->axes.determinant() == Approx(1));
    CHECK((to_matrix(top->turn) - top->axes).norm() == 0);
  }
}

TEST_CASE("symmetric top: of a sphere the line to the mass centre", "[heavy]") {
  for (const V& c : {V(0.1, 0.05, -0.02), V(-0.1, 0.05, -0.2), V(0.1, 0, 1e-9), V(0, 0, -0.1)}) {
    const auto top = of({1, 1, 1}, c, 3);
    REQUIRE(top);
    CHECK((top->axes.col(2) * top->weight - 9.8 * c).norm() < 1e-15);
    CHECK((to_matrix(top->turn) - top->axes).norm() < 1e-15);
    CHECK(top->gradient_rate() == 0);
  }
  CHECK(of({1, 1, 1}, {0, 0, 0}));
}

TEST_CASE("symmetric top: what has no axis", "[heavy]") {
  CHECK(of({1, 1.1, 0.6}, {0, 0, 0.1}).error() == Errc::not_applicable);
  CHECK(of({1, 1, 0.6}, {0, 0.01, 0.1}).error() == Errc::not_applicable);
  CHECK(of({1, 1, 0.6}, {0.1, 0, 0}).error() == Errc::not_applicable);
  CHECK(of({1, 1 + 4e-16, 0.6}, {1e-18, 0, 0.1}));
  CHECK(of({1, 1 + 1e-12, 0.6}, {0, 0, 0.1}).error() == Errc::not_applicable);
}

TEST_CASE("top attitude: at the start it gives back the state, also on the vertical", "[heavy]") {
  const auto problem = Problem<double>::make({1, 1, 0.6}, 1, {0, 0, 0.1}, 9.8, 0);
  const auto top = SymmetricTop<double>::of(*problem);
  REQUIRE(top);
  for (const double tilt : {0.7, 1e-3, 1e-9, 0.0, 3.0}) {
    const Quat<double> q = Quat<double>{0.8, 0, 0, 0.6} * Quat<double>{std::cos(tilt / 2), 0, std::sin(tilt / 2), 0};
    const auto start = start_at({0.3, -0.2, 2}, q);
    const TopStart<double> o(*top, start);
    CHECK(o.above == Approx(1 - o.u));
    CHECK(o.below == Approx(1 + o.u).margin(1e-16));
    // the amplitude at a pole that is touched is kept away from zero
    const double floor = 1e-40;
    AxisPoint<double> point{o.u, o.swing, o.above, std::max(o.below, floor), 0.3, -1.2};
    const double c_above = o.d - o.rho * o.above;
    const double speed = std::hypot(o.rate[0], o.rate[1]);
    const double c_below = o.below > floor ? o.d + o.rho * o.below : std::sqrt(2 * floor) * speed;
    const TopAttitude<double> attitude(*top, o, c_above, c_below, point, 3);
    const auto s = attitude.at(0, point);
    CAPTURE(tilt);
    const auto d = distance(s, start);
    CHECK(d.attitude < 1e-15);
    CHECK(d.down < 1e-15);
    CHECK(d.angular_velocity < 3e-15);
  }
}
