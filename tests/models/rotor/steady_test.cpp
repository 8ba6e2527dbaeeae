// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/steady.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "catch.hpp"
#include "models/rotor/bodies.hpp"
#include "models/rotor/equilibria.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

Gyrostat<double> body(const Vec3<double>& moments, const Vec3<double>& e, double lambda, double no_load_rate) {
  const auto made = Gyrostat<double>::make(moments.asDiagonal(), e.normalized(), lambda, 0.1, no_load_rate);
  REQUIRE(made);
  return *made;
}

/// |J (psi theta m - l m + h e)| over l times the least |eigenvalue| of J - sigma on the tangent plane: the distance in m to the
/// exact steady rotation, to first order, computed in long double.
template <class Scalar>
double distance(const Gyrostat<Scalar>& g, Scalar norm, const SteadyRotation<Scalar>& r) {
  using L = long double;
  const Mat3<L> theta = g.inertia().template cast<L>(), J = theta.inverse();
  const Vec3<L> m = r.direction.template cast<L>().normalized();
  const L l = norm, psi = r.spin_rate;
  const L h = L(g.axial_inertia()) * L(g.no_load_rate());
  const Vec3<L> misfit = J * (psi * theta * m - l * m + h * g.axis().template cast<L>());
  const rotor::detail::Tangent<L> t(m);
  Eigen::Matrix<L, 2, 2> B;
  const L uv = t.u.dot(J * t.v);
  B << t.u.dot(J * t.u), uv, uv, t.v.dot(J * t.v);
  B -= psi / l * Eigen::Matrix<L, 2, 2>::Identity();
  const L trace = B.trace(), size = std::abs(trace) + std::sqrt(std::max(L(0), trace * trace - 4 * B.determinant()));
  const Vec3<L> across = misfit - m.dot(misfit) * m;
  return double(across.norm() / l * size / (2 * std::abs(B.determinant())));
}

/// Smallest over largest |eigenvalue| of B on the tangent plane: small next to a fold.
double fold_distance(const Gyrostat<double>& g, double l, const SteadyRotation<double>& r) {
  const rotor::detail::Tangent<double> t(r.direction);
  const Mat3<double>& J = g.inverse_inertia();
  const double sigma = r.spin_rate / l, uv = t.u.dot(J * t.v);
  const double uu = t.u.dot(J * t.u) - sigma, vv = t.v.dot(J * t.v) - sigma;
  const double size = std::abs(uu + vv) / 2 + std::hypot((uu - vv) / 2, uv);
  return std::abs(uu * vv - uv * uv) / (size * size);
}

int morse(const SteadyRotations<double>& all) {
  int sum = 0;
  for (const auto& r : all) sum += r.type == SteadyType::saddle ? -1 : r.type == SteadyType::degenerate ? 0 : 1;
  return sum;
}

}  // namespace

TEST_CASE("the steady rotations of the reference data") {
  for (const auto& set : reference_equilibria()) {
    INFO(set.name);
    const auto g = set.gyrostat();
    const auto all = steady_rotations(g, set.norm);
    REQUIRE(all.count == int(set.points.size()));
    std::vector<bool> used(set.points.size());
    for (const auto& r : all) {
      std::size_t best = 0;
      double least = 10;
      for (std::size_t i = 0; i < set.points.size(); ++i)
        if (const double d = (r.direction - set.points[i].direction).norm(); d < least) least = d, best = i;
      const auto& truth = set.points[best];
      CHECK_FALSE(used[best]);
      used[best] = true;
      CHECK(least < 1e-12);
      CHECK(std::abs(r.spin_rate - truth.spin_rate) <= 1e-13 * std::abs(truth.spin_rate));
      CHECK(std::abs(r.level - truth.level) <= 1e-14 * std::abs(truth.level) + 1e-15);
      CHECK(r.isolated == (truth.type != "circle"));
      const SteadyType type = truth.type == "min"      ? SteadyType::minimum
                              : truth.type == "max"    ? SteadyType::maximum
                              : truth.type == "saddle" ? SteadyType::saddle
                                                       : SteadyType::degenerate;
      CHECK(r.type == type);
    }
  }
}

TEST_CASE("2000 gyrostats against every root of their sextic") {
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/rotor_sextic.csv");
  REQUIRE(file.good());
  int rows = 0, mismatches = 0, seen[7] = {};
  double worst_rate = 0, worst_direction = 0;
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#') continue;
    ++rows;
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
    const auto number = [&](std::size_t i) { return std::stod(cell[i]); };
    Mat3<double> theta;
    theta << number(1), number(4), number(5), number(4), number(2), number(6), number(5), number(6), number(3);
    const auto g = Gyrostat<double>::make(theta, {number(8), number(9), number(10)}, number(7), 0.1, 1);
    REQUIRE(g);
    CHECK(g->realisable());
    const double l = number(11);
    auto all = steady_rotations(*g, l);
    std::sort(all.at.begin(), all.at.begin() + all.count,
              [](const auto& a, const auto& b) { return a.spin_rate < b.spin_rate; });
    const std::size_t count = (cell.size() - 12) / 2;
    ++seen[count];
    bool same = all.count == int(count);
    for (std::size_t i = 0; same && i < count; ++i) {
      const char type = "msM-"[int(all.at[i].type)];
      // equal spin rates come in any order
      const double tie = 1e-9 * std::abs(all.at[i].spin_rate);
      bool found = false;
      for (std::size_t j = 0; j < count; ++j)
        found = found || (std::abs(number(13 + 2 * j) * l - all.at[i].spin_rate) <= tie && cell[12 + 2 * j][0] == type);
      same = same && found;
      const double sigma = number(13 + 2 * i), near = fold_distance(*g, l, all.at[i]);
      // loss by the distance to the fold
      const double off = std::abs(all.at[i].spin_rate / l - sigma) * g->principal()[0];
      worst_rate = std::max(worst_rate, off * near);
      worst_direction = std::max(worst_direction, distance(*g, l, all.at[i]) * near);
    }
    if (!same) {
      ++mismatches;
      UNSCOPED_INFO(line);
    }
  }
  CHECK(rows == 2000);
  CHECK(mismatches == 0);
  CHECK(worst_rate < 1e-15);
  CHECK(worst_direction < 3e-15);
  for (const int count : {2, 4, 6}) CHECK(seen[count] > 300);
}

TEST_CASE("they are critical points of F, ordered, and obey Morse's relation") {
  Bodies bodies(5);
  for (int i = 0; i < 3000; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(1e-2, 1e2) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    REQUIRE(all.count >= 2);
    CHECK(morse(all) == 2);
    CHECK(all[0].type == SteadyType::minimum);
    CHECK(all[all.count - 1].type == SteadyType::maximum);
    double last = 0;
    for (const auto& r : all) {
      CHECK(r.direction.norm() == Approx(1).epsilon(4e-16));
      CHECK(distance(g, l, r) <= 1e-15 / fold_distance(g, l, r));
      const double scale = l * l / g.principal()[0] + g.target_momentum() * g.target_momentum() / g.principal()[0];
      CHECK(std::abs(r.level - g.steady_level(l * r.direction)) <= 1e-14 * scale);
      CHECK(r.level >= last * (1 - 1e-14));
      last = r.level;
    }
    for (int j = 1; j < all.count; ++j) {
      const double apart = (all[j].direction - all[0].direction).squaredNorm();
      const double law = l * (all[j].spin_rate - all[0].spin_rate) * apart / 4;
      CHECK(std::abs(all[j].level - all[0].level - law) <= 1e-14 * all[j].level + 1e-13 * law);
    }
    // nothing on the sphere is below the first or above the last
    for (int j = 0; j < 10; ++j) {
      const double F = g.steady_level(l * bodies.direction());
      CHECK(F >= all[0].level * (1 - 1e-14));
      CHECK(F <= all[all.count - 1].level * (1 + 1e-14));
    }
  }
}

TEST_CASE("axes may be permuted, and the rotor turned the other way") {
  Bodies bodies(6);
  for (int i = 0; i < 100; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 30) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    Mat3<double> P = Mat3<double>::Zero();
    P(0, 1) = P(1, 2) = P(2, 0) = 1;
    const auto turned = Gyrostat<double>::make(P * g.inertia() * P.transpose(), P * g.axis(), g.axial_inertia(),
                                               g.slope(), g.no_load_rate());
    const auto reversed =
        Gyrostat<double>::make(g.inertia(), g.axis(), g.axial_inertia(), g.slope(), -g.no_load_rate());
    const auto a = steady_rotations(*turned, l), b = steady_rotations(*reversed, l);
    REQUIRE(a.count == all.count);
    REQUIRE(b.count == all.count);
    for (int j = 0; j < all.count; ++j) {
      const double room = 1e-15 / fold_distance(g, l, all[j]);
      CHECK((a[j].direction - P * all[j].direction).norm() <= room);
      CHECK((b[j].direction + all[j].direction).norm() <= room);
      CHECK(a[j].type == all[j].type);
      CHECK(b[j].spin_rate == Approx(all[j].spin_rate).epsilon(room).margin(1e-15 * l));
    }
  }
}

TEST_CASE("a rotor on a principal axis: pairs along axis i while |h|/l < |1 - theta_a/theta_i|") {
  const Vec3<double> moments(3, 4, 5);
  for (int axis = 0; axis < 3; ++axis)
    for (const double ratio : {1e-3, 0.15, 0.19, 0.21, 0.24, 0.26, 0.32, 0.34, 0.39, 0.41, 0.6, 0.7, 3.0}) {
      const auto g = body(moments, Vec3<double>::Unit(axis), 0.4, ratio / 0.4);
      const auto all = steady_rotations(g, 1.0);
      int expected = 2;
      for (int i = 0; i < 3; ++i) expected += i != axis && ratio < std::abs(1 - moments[axis] / moments[i]) ? 2 : 0;
      CHECK(all.count == expected);
      CHECK(morse(all) == 2);
      int on_axis = 0;
      for (const auto& r : all) on_axis += std::abs(r.direction[axis]) == 1;
      CHECK(on_axis == 2);
    }
}

TEST_CASE("tiny components cost no digits and lead into the exact zero") {
  const double l = 1;
  const auto limit = steady_rotations(body({3, 4, 5}, {0.6, 0.8, 0}, 0.4, 0.2), l);
  REQUIRE(limit.count == 6);
  for (double tiny = 1e-3; tiny > 1e-40; tiny /= 7) {
    const auto g = body({3, 4, 5}, {0.6, 0.8, tiny}, 0.4, 0.2);
    const auto all = steady_rotations(g, l);
    REQUIRE(all.count == 6);
    for (int i = 0; i < 6; ++i) {
      CHECK(distance(g, l, all[i]) < 1e-15 / fold_distance(g, l, all[i]));
      CHECK(all[i].type == limit[i].type);
      double least = 10;
      for (const auto& r : limit) least = std::min(least, (r.direction - all[i].direction).norm());
      CHECK(least <= 10 * tiny + 1e-15);
    }
  }
}

TEST_CASE("a pair dies at a fold: six, five of which one is degenerate, four") {
  const auto at = [](double no_load_rate) {
    const auto g = reference_body(0.2, no_load_rate);
    return steady_rotations(g, 8.0);
  };
  double six = 3.5572, four = 3.5573;
  REQUIRE(at(six).count == 6);
  REQUIRE(at(four).count == 4);
  bool seen = false;
  for (int i = 0; i < 60; ++i) {
    const double middle = (six + four) / 2;
    const auto all = at(middle);
    if (all.count == 5) {
      int degenerate = 0;
      for (const auto& r : all) {
        degenerate += r.type == SteadyType::degenerate;
        CHECK(r.isolated);
      }
      CHECK(degenerate == 1);
      CHECK(morse(all) == 2);
      seen = true;
    }
    (all.count >= 5 ? six : four) = middle;
    if (i > 40 && seen) break;
  }
  CHECK(seen);
  // the two are as far apart as the square root of the distance
  for (const double d : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const auto all = at(six * (1 - d));
    REQUIRE(all.count == 6);
    double apart = 10;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < i; ++j) apart = std::min(apart, (all[i].direction - all[j].direction).norm());
    CHECK(apart / std::sqrt(d) == Approx(1.6).epsilon(0.05));
  }
}

TEST_CASE("a pitchfork: the pair off the plane leaves the plane as a square root") {
  // e = (0.6, 0.8, 0): the pair m3 exists while h/l < 1/hypot(0.6/(1 - 3/5), 0.8/(1 - 4/5))
  const double critical = 1 / std::hypot(0.6 / 0.4, 0.8 / 0.2);
  for (const double d : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const auto inside = steady_rotations(body({3, 4, 5}, {0.6, 0.8, 0}, 0.4, critical * (1 - d) / 0.4), 1.0);
    const auto outside = steady_rotations(body({3, 4, 5}, {0.6, 0.8, 0}, 0.4, critical * (1 + d) / 0.4), 1.0);
    CHECK(inside.count == outside.count + 2);
    CHECK(morse(inside) == 2);
    CHECK(morse(outside) == 2);
    CHECK(inside[0].type == SteadyType::minimum);
    CHECK(inside[1].type == SteadyType::minimum);
    CHECK(std::abs(inside[0].direction[2]) == Approx(std::sqrt(2 * d - d * d)).epsilon(1e-3));
    CHECK(outside[0].type == SteadyType::minimum);
  }
  const auto on = steady_rotations(body({3, 4, 5}, {0.6, 0.8, 0}, 0.4, critical / 0.4), 1.0);
  CHECK(on.count % 2 == 0);
  CHECK(on[0].type == SteadyType::degenerate);
  CHECK(on[0].direction[2] == 0);
}

TEST_CASE("equal moments: isolated points, a circle, the sphere") {
  const auto generic = steady_rotations(body({3, 3, 5}, {0.48, 0.36, 0.8}, 0.4, 2), 5.0);
  CHECK(generic.count == 4);
  CHECK_FALSE(generic.circle);
  for (const double rate : {0.0, 2.0}) {
    // theta axisymmetric about e: the equator is a circle of steady rotations while |h|/l < |1 - C/A|
    const auto g = body({3, 3, 5}, {0, 0, 1}, 0.4, rate);
    const auto all = steady_rotations(g, 5.0);
    REQUIRE(all.count == 3);
    CHECK(all.circle);
    int loose = 0;
    for (const auto& r : all) {
      CHECK(r.spin_rate * 5 == Approx(r.isolated ? 5 - r.direction[2] * g.target_momentum() : 5.0 * 5 / 3));
      loose += !r.isolated;
      CHECK(r.isolated == (r.type != SteadyType::degenerate));
    }
    CHECK(loose == 1);
  }
  CHECK(steady_rotations(body({3, 3, 5}, {0, 0, 1}, 0.4, 10), 5.0).count == 2);

  // the same in rotated axes, where the equality is hidden by rounding
  Bodies bodies(9);
  for (int i = 0; i < 50; ++i) {
    const Mat3<double> R = to_matrix(bodies.attitude());
    const Mat3<double> theta = R * Vec3<double>(3, 3, 5).asDiagonal() * R.transpose();
    const auto g = Gyrostat<double>::make((theta + theta.transpose()) / 2, R.col(2), 0.4, 0.1, 2);
    const auto all = steady_rotations(*g, 5.0);
    CHECK(all.count == 3);
    CHECK(all.circle);
  }

  const auto sphere = steady_rotations(body({2, 2, 2}, {0, 0.6, 0.8}, 0.4, 0), 5.0);
  CHECK(sphere.sphere);
  REQUIRE(sphere.count == 1);
  CHECK(sphere[0].spin_rate == 2.5);
  CHECK_FALSE(sphere[0].isolated);
  const auto two = steady_rotations(body({2, 2, 2}, {0, 0.6, 0.8}, 0.4, 1), 5.0);
  CHECK_FALSE(two.sphere);
  REQUIRE(two.count == 2);
  CHECK((two[0].direction - Vec3<double>(0, 0.6, 0.8)).norm() < 1e-15);
  CHECK(two[0].spin_rate == Approx(2.3));
  CHECK(two[1].spin_rate == Approx(2.7));
}

TEST_CASE("a fast rotor: m tends to n, and the spin rate to -|h| |n|") {
  const Vec3<double> n = reference_body(0.1, 1).inverse_inertia() * reference_body(0.1, 1).axis();
  double last = 1;
  for (const double ratio : {1e2, 1e4, 1e6}) {
    const auto g = reference_body(0.1, ratio / 0.35);
    const auto all = steady_rotations(g, 1.0);
    REQUIRE(all.count == 2);
    const double off = (all[0].direction - n.normalized()).norm();
    CHECK(off < 0.011 * last);
    last = off;
    CHECK(all[0].spin_rate == Approx(-ratio * n.norm()).epsilon(2 / ratio));
    CHECK(all[1].spin_rate == Approx(ratio * n.norm()).epsilon(2 / ratio));
  }
}

TEST_CASE("near l = |h| the spin rate of the lowest one keeps its digits") {
  const auto g = reference_body(0.1, 10);
  const double h = g.target_momentum();
  for (const double d : {1e-4, 1e-8, 1e-12}) {
    const double l = h * (1 + d), d_exact = (l - h) / h;
    const auto all = steady_rotations(g, l);
    const Vec3<double> e = g.axis();
    // psi theta m = l m - h e and m = e to first order: psi = (l - h)/(e.theta e)
    CHECK(all[0].spin_rate == Approx(h * d_exact / e.dot(g.inertia() * e)).epsilon(2 * d + 4e-16 / d));
    CHECK(all[0].level == Approx(0.5 * h * h * d_exact * d_exact / e.dot(g.inertia() * e)).epsilon(2 * d + 4e-16 / d));
  }
}

TEMPLATE_TEST_CASE("in other precisions", "", float, long double) {
  using S = TestType;
  Bodies bodies(12);
  for (int i = 0; i < 200; ++i) {
    const auto d = bodies.realisable();
    const auto g = Gyrostat<S>::make(d.inertia().cast<S>(), d.axis().cast<S>(), S(d.axial_inertia()), S(d.slope()),
                                     S(d.no_load_rate()));
    REQUIRE(g);
    const double l = std::abs(d.target_momentum()) * bodies.scale(0.1, 10);
    const auto all = steady_rotations(*g, S(l));
    const auto truth = steady_rotations(d, l);
    REQUIRE(all.count == truth.count);
    for (int j = 0; j < all.count; ++j) {
      CHECK(all[j].type == truth[j].type);
      if (std::is_same_v<S, float>)
        CHECK((all[j].direction.template cast<double>() - truth[j].direction).norm() <=
              1e-6 / fold_distance(d, l, truth[j]));
      else CHECK(distance(*g, S(l), all[j]) <= 1e-18 / fold_distance(d, l, truth[j]));
    }
  }
}

TEST_CASE("no momentum, no numbers, and no allocation") {
  const auto g = reference_body(0.2, 3);
  for (const double l : {0.0, -1.0, double(gyrostat::nan<double>), infinity<double>, 1e-309})
    CHECK(steady_rotations(g, l).count == 0);
  CHECK(steady_rotations(g, 1e-300).count == 2);
  CHECK(steady_rotations(g, 1e300).count == 6);
  const std::size_t before = allocations();
  CHECK(steady_rotations(g, 8.0).count == 6);
  const std::size_t after = allocations();
  CHECK(after == before);
  STATIC_REQUIRE(noexcept(steady_rotations(g, 8.0)));
}

TEST_CASE("directions are unit vectors, also where two moments are nearly equal in rotated axes") {
  Bodies bodies(12);
  for (int i = 0; i < 400; ++i) {
    const Mat3<double> R = to_matrix(bodies.attitude());
    const double gap = std::pow(10., -16 + 8 * (i / 400.));
    const Mat3<double> theta = R * Vec3<double>(1 - gap, 1, 1 + gap / 2).asDiagonal() * R.transpose();
    const auto g = Gyrostat<double>::make((theta + theta.transpose()) / 2, bodies.direction(), 0.1, 0.1, 0);
    REQUIRE(g);
    for (const auto& r : steady_rotations(*g, 1.0)) CHECK(r.direction.norm() == Approx(1).epsilon(1e-14));
  }
}
