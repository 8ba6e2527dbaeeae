// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/steady_stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "catch.hpp"
#include "models/rotor/bodies.hpp"
#include "models/rotor/equilibria.hpp"
#include "models/rotor/momentum_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using Complex = std::complex<double>;

double growth(const std::array<Complex, 3>& roots) {
  return std::max({roots[0].real(), roots[1].real(), roots[2].real()});
}

/// The coefficients of det(d - A) = d (d^3 + c2 d^2 + c1 d + c0) of the motion of (H, p), which keeps |H|: from the
/// derivative by central differences, exact for quadratic equations, in long double.
std::array<double, 3> characteristic(const Gyrostat<double>& g, const Vec3<double>& H, double p) {
  using L = long double;
  using Vec4 = Eigen::Matrix<L, 4, 1>;
  const Mat3<L> inverse =
      (g.inertia().cast<L>() - L(g.axial_inertia()) * g.axis().cast<L>() * g.axis().cast<L>().transpose()).inverse();
  const auto rate = [&](const Vec4& y) -> Vec4 {
    const Vec3<L> A = y.head<3>(), e = g.axis().cast<L>(), Omega = inverse * (A - y[3] * e);
    const Vec3<L> turn = A.cross(Omega);
    const L x = y[3] / L(g.axial_inertia()) - e.dot(Omega) - L(g.no_load_rate());
    return {turn[0], turn[1], turn[2], -L(g.slope()) * x};
  };
  const Vec4 at(H[0], H[1], H[2], p);
  Eigen::Matrix<L, 4, 4> A;
  for (int i = 0; i < 4; ++i) {
    const Vec4 d = Vec4::Unit(i) * at.norm();
    A.col(i) = (rate(at + d) - rate(at - d)) / (2 * at.norm());
  }
  // Faddeev and Le Verrier
  Eigen::Matrix<L, 4, 4> grown = A;
  std::array<double, 3> c{};
  for (int i = 0; i < 3; ++i) {
    const L trace = grown.trace() / (i + 1);
    c[std::size_t(i)] = double(-trace);
    grown = A * (grown - trace * Eigen::Matrix<L, 4, 4>::Identity());
  }
  return c;
}

MomentumMotion beside(const Gyrostat<double>& g, double l, const SteadyRotation<double>& r, double off) {
  const rotor::detail::Tangent<double> t(r.direction);
  return MomentumMotion::from(g, l, (r.direction + off * (0.8 * t.u + 0.6 * t.v)).normalized(), 0);
}

}  // namespace

TEST_CASE("the stability of the reference data") {
  for (const auto& set : reference_equilibria()) {
    const auto g = set.gyrostat();
    CHECK(g.coupling() == Approx(set.coupling).epsilon(1e-15));
    for (const auto& r : steady_rotations(g, set.norm)) {
      INFO(set.name);
      const auto s = stability_of(g, set.norm, r);
      const auto& truth = *std::min_element(set.points.begin(), set.points.end(), [&](const auto& a, const auto& b) {
        return (a.direction - r.direction).norm() < (b.direction - r.direction).norm();
      });
      const double scale = std::pow(set.norm / g.principal()[0], 2);
      CHECK(std::abs(s.determinant - truth.determinant) <= 1e-13 * scale);
      CHECK(std::abs(s.tilt_coupling - truth.tilt_coupling) <= 2e-14 * set.norm / std::pow(g.principal()[0], 3));
      CHECK(s.cubic[0] == Approx(set.coupling).epsilon(1e-15));
      CHECK(s.cubic[1] == Approx(set.slope / set.axial_inertia).epsilon(1e-15));
      const double size = std::max({std::abs(truth.eigenvalues[0]), std::abs(truth.eigenvalues[1]), 1e-3});
      for (const Complex d : truth.eigenvalues) {
        double least = 1e9;
        for (const Complex mine : s.eigenvalues) least = std::min(least, std::abs(mine - d));
        CHECK(least <= 1e-11 * size);
      }
      const Verdict verdict = truth.verdict == "asymptotically stable" ? Verdict::asymptotically_stable
                              : truth.verdict == "unstable"            ? Verdict::unstable
                              : truth.verdict == "non-isolated"        ? Verdict::not_isolated
                                                                       : Verdict::marginal;
      CHECK(s.verdict == verdict);
      CHECK(std::isnan(s.decay_rate) == (verdict == Verdict::marginal || verdict == Verdict::not_isolated));
    }
  }
}

TEST_CASE("the cubic is the characteristic polynomial of the motion, and the verdict that of its roots") {
  Bodies bodies(31);
  int stable = 0, saddles = 0, maxima = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.1, 30) * std::abs(g.target_momentum());
    for (const auto& r : steady_rotations(g, l)) {
      const auto s = stability_of(g, l, r);
      const auto at = MomentumMotion::from(g, l, r.direction, 0);
      const auto c = characteristic(g, at.H, at.p);
      const double rate = l / g.principal()[0] + g.relaxation_rate();
      CHECK(std::abs(s.cubic[1] / s.cubic[0] - c[0]) <= 1e-13 * rate);
      CHECK(std::abs(s.cubic[2] / s.cubic[0] - c[1]) <= 1e-13 * rate * rate);
      CHECK(std::abs(s.cubic[3] / s.cubic[0] - c[2]) <= 1e-13 * rate * rate * rate);
      Complex sum = 0, product = 1;
      for (const Complex d : s.eigenvalues) {
        const Complex value = ((s.cubic[0] * d + s.cubic[1]) * d + s.cubic[2]) * d + s.cubic[3];
        const double size = std::abs(d);
        CHECK(std::abs(value) <=
              4e-15 * (((s.cubic[0] * size + s.cubic[1]) * size + std::abs(s.cubic[2])) * size + std::abs(s.cubic[3])));
        sum += d;
        product *= d;
      }
      CHECK(std::abs(sum + s.cubic[1] / s.cubic[0]) <= 1e-14 * rate);
      CHECK(std::abs(product + s.cubic[3] / s.cubic[0]) <= 1e-14 * std::abs(product));
      CHECK(s.decay_rate == -growth(s.eigenvalues));
      int growing = 0;
      for (const Complex d : s.eigenvalues) growing += d.real() > 0;
      if (r.type == SteadyType::minimum) {
        ++stable;
        CHECK(s.verdict == Verdict::asymptotically_stable);
        CHECK(growing == 0);
        CHECK(s.tilt_coupling > 0);
        CHECK(s.best_rate >= s.decay_rate * (1 - 1e-12));
      } else {
        (r.type == SteadyType::saddle ? saddles : maxima) += 1;
        CHECK(s.verdict == Verdict::unstable);
        CHECK(growing == (r.type == SteadyType::saddle ? 1 : 2));
        CHECK(std::isnan(s.best_slope));
      }
    }
  }
  CHECK(stable > 1000);
  CHECK(saddles > 300);
  CHECK(maxima > 1000);
}

TEST_CASE("roots of (d + s)(d^2 + D) + kappa d with real parts without cancellation") {
  using L = long double;
  for (double s = 1e-9; s < 1e9; s *= 7)
    for (const double D : {1.0, -1.0, 1e-6, -1e-6})
      for (double size = 1e-14; size < 1e4; size *= 11)
        for (const double kappa : {size, -size}) {
          const auto r = rotor::detail::nutation_roots<double>(s, D, kappa);
          const auto truth = rotor::detail::nutation_roots<L>(s, D, kappa);
          INFO(s << ' ' << D << ' ' << kappa);
          // next to a double root the square root of rounding is lost
          const L u = truth[1].real(), v = truth[1].imag(), w = truth[2].real();
          const L apart = v != 0 ? 2 * std::abs(v) / std::hypot(u, v) : std::abs(u - w) / std::abs(w + u);
          for (std::size_t i = 0; i < 3; ++i) {
            const L room = 1e-15L / std::min(L(1), apart * apart * apart);
            CHECK(std::abs(L(r[i].real()) - truth[i].real()) <= (room + 2e-15L) * std::abs(truth[i].real()));
          }
          // Vieta, in long double
          const L a = truth[0].real(), c = v != 0 ? u * u + v * v : u * w, twice = v != 0 ? 2 * u : u + w;
          CHECK(std::abs(-a * c - L(s) * D) <= 1e-17L * std::abs(s * D));
          CHECK(std::abs(a * twice + c - (L(D) + kappa)) <= 1e-17L * (std::abs(a * twice) + std::abs(c)));
          CHECK(std::abs(a + twice + s) <= 1e-17L * (std::abs(a) + std::abs(twice) + s));
        }
  const auto held = rotor::detail::nutation_roots<double>(0, 2, 2);
  CHECK(held[0] == Complex(0, 0));
  CHECK(std::abs(held[1] - Complex(0, 2)) + std::abs(held[2] + Complex(0, 2)) < 1e-15);
}

TEST_CASE("the laws of a weak, a soft and a stiff motor") {
  const double D = 2.3, kappa = 1e-3;
  const auto rate = [&](double s) { return -growth(rotor::detail::nutation_roots<double>(s, D, kappa)); };
  for (double s = 1e-8; s < 1e8; s *= 10) {
    const double weak = kappa / 2 * s / (s * s + D);
    CHECK(rate(s) == Approx(weak).epsilon(2 * kappa / D));
  }
  for (const double s : {1e-3, 1e-5, 1e-7}) CHECK(rate(s) == Approx(s * kappa / (2 * (D + kappa))).epsilon(s * s));
  for (const double s : {1e3, 1e5, 1e7}) CHECK(rate(s) == Approx(kappa / (2 * s)).epsilon(4 / (s * s)));
}

TEST_CASE("the fastest damping is the best of all slopes") {
  for (const double D : {1.0, 1e-4, 37.0})
    for (const double c : {1e-6, 0.01, 1.0, 3.9, 4.0, 4.1, 6.0, 7.9, 8.0, 8.1, 9.0, 20.0, 1e3}) {
      const double kappa = c * D;
      const auto best = fastest_damping(D, kappa);
      const auto decay = [&](double s) { return -growth(rotor::detail::nutation_roots<double>(s, D, kappa)); };
      // a triple root loses the third root of rounding
      CHECK(decay(best.relaxation) == Approx(best.rate).epsilon(c >= 7.9 ? 2e-5 : 1e-12));
      for (double s = 1e-3; s < 3e3; s *= 1.0007) CHECK(decay(s * std::sqrt(D)) <= best.rate * (1 + 1e-12));
      if (c < 4) CHECK(best.rate == Approx(kappa / (4 * std::sqrt(D))));
    }
  CHECK(std::isnan(fastest_damping(1.0, 0.0).rate));
  CHECK(std::isnan(fastest_damping(-1.0, 1.0).rate));

  // through the whole chain: the body with that slope has that rate
  Bodies bodies(3);
  for (int i = 0; i < 100; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 10) * std::abs(g.target_momentum());
    const auto s = stability_of(g, l, steady_rotations(g, l)[0]);
    const auto tuned = Gyrostat<double>::make(g.inertia(), g.axis(), g.axial_inertia(), s.best_slope, g.no_load_rate());
    const auto t = stability_of(*tuned, l, steady_rotations(*tuned, l)[0]);
    CHECK(t.decay_rate == Approx(s.best_rate).epsilon(1e-9));
    CHECK(t.best_slope == Approx(s.best_slope).epsilon(1e-9));
  }
}

TEST_CASE("a start along a mode moves as the mode does") {
  Bodies bodies(77);
  for (int body = 0; body < 60; ++body) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.5, 10) * std::abs(g.target_momentum());
    for (const auto& r : steady_rotations(g, l)) {
      const auto s = stability_of(g, l, r);
      // dm = a u + b v, x: the linear equations in these, written out
      const rotor::detail::Tangent<double> t(r.direction);
      const Vec3<double> n = g.inverse_inertia() * g.axis();
      const Vec3<double> Bu = l * (g.inverse_inertia() * t.u) - r.spin_rate * t.u;
      const Vec3<double> Bv = l * (g.inverse_inertia() * t.v) - r.spin_rate * t.v;
      Mat3<double> A;
      A.row(0) << -t.v.dot(Bu), -t.v.dot(Bv), g.axial_inertia() * n.dot(t.v);
      A.row(1) << t.u.dot(Bu), t.u.dot(Bv), -g.axial_inertia() * n.dot(t.u);
      A.row(2) = -l / g.coupling() * (n.dot(t.u) * A.row(0) + n.dot(t.v) * A.row(1));
      A(2, 2) -= g.relaxation_rate();
      for (const Complex d : s.eigenvalues) {
        // its vector is normal to the rows of A - d
        using Shape = Eigen::Vector3cd;
        Shape rows[3], shape = Shape::Zero();
        for (int i = 0; i < 3; ++i) rows[i] = A.row(i).transpose().cast<Complex>() - d * Shape::Unit(i);
        for (int i = 0; i < 3; ++i) {
          const Shape &p = rows[i], &q = rows[(i + 1) % 3];
          const Shape each(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
          if (each.norm() > shape.norm()) shape = each;
        }
        shape /= shape.norm();
        CHECK((A.cast<Complex>() * shape - d * shape).norm() <= 1e-11 * A.norm());
        const double size = 1e-6 / (1 + std::abs(shape[2]));
        const Vec3<double> start = size * shape.real();
        const Vec3<double> off = start[0] * t.u + start[1] * t.v;
        auto motion = MomentumMotion::from(g, l, (r.direction + off).normalized(), start[2]);
        const double fastest = A.norm() + g.relaxation_rate();
        const double time =
            1.5 / std::max(std::abs(d), growth(s.eigenvalues));  // before another mode grows out of nothing
        const int steps = int(time * fastest / 0.03) + 1;
        if (steps > 20000) continue;
        for (int i = 0; i < steps; ++i) motion.step(time / steps);
        const Vec3<double> end = (size * shape * std::exp(d * time)).real();
        const Vec3<double> there = motion.direction() - r.direction;
        const double room = 3e-5 * size * std::max(1.0, std::exp(d.real() * time));
        INFO(d << " of " << s.eigenvalues[0] << s.eigenvalues[1] << s.eigenvalues[2]);
        CHECK((there - end[0] * t.u - end[1] * t.v).norm() <= room);
        CHECK(std::abs(motion.slip() - end[2]) <= room * (1 + std::abs(shape[2])));
      }
    }
  }
}

TEST_CASE("the full motion decays at the slowest rate for many e-folds, and leaves a maximum at that of its growth") {
  const auto g = reference_body(0.2, 3);
  const double l = 8;
  for (const auto& r : steady_rotations(g, l)) {
    if (r.type == SteadyType::saddle) continue;
    const auto s = stability_of(g, l, r);
    const bool decay = r.type == SteadyType::minimum;
    auto motion = beside(g, l, r, decay ? 1e-2 : 1e-9);
    const double turn = 2 * pi<double> / std::abs(s.eigenvalues[1].imag()), dt = turn / 400;
    const auto peak = [&] {
      double most = 0;
      for (int i = 0; i < 400; ++i) {
        motion.step(dt);
        most = std::max(most, (motion.direction() - r.direction).norm());
      }
      return most;
    };
    for (double t = 0; t < 2 / std::abs(s.decay_rate); t += turn) peak();
    const int turns = int(8 / std::abs(s.decay_rate) / turn) + 1;
    const double first = peak();
    for (int i = 1; i < turns; ++i) peak();
    const double last = peak();
    CHECK(std::log(first / last) / (turns * turn) == Approx(s.decay_rate).epsilon(2e-3));
  }
}

TEST_CASE("the rate falls as the square of the angle between e and a principal axis") {
  std::vector<double> rates;
  for (const double alpha : {1e-1, 1e-2, 1e-3, 1e-6}) {
    const auto g =
        Gyrostat<double>::make(Vec3<double>(3, 4, 5).asDiagonal(), {0, std::sin(alpha), std::cos(alpha)}, 0.4, 0.3, 3);
    const auto all = steady_rotations(*g, 5.0);
    rates.push_back(stability_of(*g, 5.0, all[0]).decay_rate / (alpha * alpha));
  }
  CHECK(rates[0] == Approx(rates[3]).epsilon(0.03));
  CHECK(rates[1] == Approx(rates[3]).epsilon(3e-4));
  CHECK(rates[2] == Approx(rates[3]).epsilon(3e-6));
}

TEST_CASE("the rate falls as (l/h)^3 behind a fast rotor at fixed S") {
  double last = 0;
  for (const double ratio : {1e1, 1e2, 1e3, 1e4}) {
    const auto g = reference_body(0.2, 2 / 0.35 * ratio);
    const double rate = stability_of(g, 2.0, steady_rotations(g, 2.0)[0]).decay_rate;
    if (last > 0) CHECK(std::log10(last / rate) == Approx(3).margin(3 / ratio));
    last = rate;
  }
}

TEST_CASE("a dual-spin satellite takes years, 0.21 of them at best") {
  // wheel 3.7 degrees off the axis of least inertia, theta = diag(86, 118, 141), l = 52.17 N m s
  const double off = 3.7 * pi<double> / 180, azimuth = std::atan2(0.34289780745545134, 0.45035926880694593);
  const Vec3<double> e(std::cos(off), std::sin(off) * std::cos(azimuth), std::sin(off) * std::sin(azimuth));
  const auto g = Gyrostat<double>::make(Vec3<double>(86, 118, 141).asDiagonal(), e, 0.28, 0.004, 210);
  const double l = 52.17233512121151, year = 365.25 * 86400;
  const auto all = steady_rotations(*g, l);
  REQUIRE(all.count == 2);
  const auto s = stability_of(*g, l, all[0]);
  CHECK(1 / s.decay_rate == Approx(3.6 * year).epsilon(0.02));
  CHECK(s.best_slope == Approx(0.1345).epsilon(2e-3));
  CHECK(1 / s.best_rate == Approx(0.21 * year).epsilon(0.03));
  CHECK(std::sqrt(s.determinant) / (2 * pi<double> * s.best_rate) == Approx(5e5).epsilon(0.1));
}

TEST_CASE("what has no exponential rate is said") {
  const auto made = [](const Vec3<double>& moments, const Vec3<double>& e, double slope, double rate) {
    return Gyrostat<double>::make(moments.asDiagonal(), e, 0.4, slope, rate).value();
  };
  // e principal: m = +-e
  const auto principal = made({3, 4, 5}, {1, 0, 0}, 0.3, 6);
  const auto pair = steady_rotations(principal, 5.0);
  REQUIRE(pair.count == 2);
  for (const auto& r : pair) {
    const auto s = stability_of(principal, 5.0, r);
    CHECK(s.verdict == Verdict::marginal);
    CHECK(s.tilt_coupling == 0);
    CHECK(std::isnan(s.decay_rate));
    CHECK(std::isnan(s.best_slope));
    CHECK(s.eigenvalues[1].real() == 0);
    CHECK(std::abs(s.eigenvalues[1].imag()) == Approx(std::sqrt(s.determinant)));
  }
  // but a saddle there grows
  const auto saddle = made({3, 4, 5}, {1, 0, 0}, 0.3, 4);
  const auto four = steady_rotations(saddle, 5.0);
  const int i = four.lowest(SteadyType::saddle);
  REQUIRE(i >= 0);
  CHECK(stability_of(saddle, 5.0, four[i]).verdict == Verdict::unstable);
  CHECK(stability_of(saddle, 5.0, four[i]).decay_rate ==
        Approx(-std::sqrt(-stability_of(saddle, 5.0, four[i]).determinant)));

  // the same in rotated axes, with moments of any kind; and in diagonal ones no longer 1e-12 rad away
  Bodies bodies(8);
  for (int j = 0; j < 2000; ++j) {
    const Mat3<double> R = to_matrix(bodies.attitude());
    const Vec3<double> second(bodies.scale(0.05, 3), bodies.scale(0.05, 3), bodies.scale(0.05, 3));
    const Vec3<double> moments = second.sum() * Vec3<double>::Ones() - second;
    const double lambda = 0.1 * moments.minCoeff(), rate = bodies.uniform(-3, 3) / lambda;
    const auto turned = [&](double off) {
      const Mat3<double> theta = R * moments.asDiagonal() * R.transpose();
      const Vec3<double> e = std::cos(off) * R.col(0) + std::sin(off) * R.col(1);
      return Gyrostat<double>::make((theta + theta.transpose()) / 2, e, lambda, 0.3, rate).value();
    };
    const auto on = turned(0);
    for (const auto& r : steady_rotations(on, 5.0))
      if (std::abs(r.direction.dot(R.col(0))) > 1 - 1e-12 && r.type != SteadyType::saddle)
        CHECK(stability_of(on, 5.0, r).verdict == Verdict::marginal);
  }
  const auto off = made({3, 4, 5}, {std::cos(1e-12), std::sin(1e-12), 0}, 0.3, 6);
  CHECK(stability_of(off, 5.0, steady_rotations(off, 5.0)[0]).verdict == Verdict::asymptotically_stable);

  const auto circle = made({3, 3, 5}, {0.48, 0.36, 0.8}, 0.3, 0);
  int loose = 0;
  for (const auto& r : steady_rotations(circle, 5.0)) {
    const auto s = stability_of(circle, 5.0, r);
    loose += s.verdict == Verdict::not_isolated;
    CHECK((s.verdict == Verdict::not_isolated) == !r.isolated);
    if (!r.isolated) CHECK(s.determinant == 0);
  }
  CHECK(loose == 1);

  const auto held = made({3, 4, 5}, {0.6, 0.8, 0}, 0, 1);
  for (const auto& r : steady_rotations(held, 5.0)) {
    const auto s = stability_of(held, 5.0, r);
    CHECK(s.verdict == Verdict::conservative);
    CHECK(std::isnan(s.decay_rate));
    CHECK(std::isnan(s.best_slope) == (r.type != SteadyType::minimum));
  }

  // on a pitchfork to rounding
  const double critical = 1 / std::hypot(0.6 / 0.4, 0.8 / 0.2);
  const auto fork = made({3, 4, 5}, {0.6, 0.8, 0}, 0.3, critical / 0.4);
  const auto s = stability_of(fork, 1.0, steady_rotations(fork, 1.0)[0]);
  CHECK(s.verdict == Verdict::marginal);
  CHECK(std::isnan(s.decay_rate));
}

TEST_CASE("a slim body whose great moments are nearly equal decays as long double says") {
  const Vec3<double> moments(1, 0.999997, 4e-5), e(0.6, 0.8, 0);
  const auto g = Gyrostat<double>::make(moments.asDiagonal(), e, 1e-5, 1e-5, -0.1).value();
  const auto precise =
      Gyrostat<long double>::make(moments.cast<long double>().asDiagonal(), e.cast<long double>(), 1e-5L, 1e-5L, -0.1L)
          .value();
  const auto set = steady_rotations(g, 1.0);
  const auto same = steady_rotations(precise, 1.0L);
  REQUIRE(set.count == 6);
  REQUIRE(same.count == 6);
  for (int i = 0; i < set.count; ++i) {
    const auto s = stability_of(g, 1.0, set[i]);
    const auto truth = stability_of(precise, 1.0L, same[i]);
    CAPTURE(i, s.decay_rate);
    CHECK(s.verdict == (i < 2 ? Verdict::asymptotically_stable : Verdict::unstable));
    CHECK(s.verdict == truth.verdict);
    CHECK(std::abs(s.decay_rate - double(truth.decay_rate)) < 1e-6);
  }
}

TEST_CASE("towards a fold one real rate vanishes as S D/(lambda (k D + lambda l q))") {
  double six = 3.5572, four = 3.5573;
  for (int i = 0; i < 45; ++i) {
    const double middle = (six + four) / 2;
    (steady_rotations(reference_body(0.2, middle), 8.0).count >= 5 ? six : four) = middle;
  }
  for (const double d : {1e-6, 1e-8, 1e-10}) {
    const auto g = reference_body(0.2, six * (1 - d));
    for (const auto& r : steady_rotations(g, 8.0)) {
      const auto s = stability_of(g, 8.0, r);
      if (std::abs(s.determinant) > 1e-3) continue;
      const double slow = -g.slope() * s.determinant / (g.axial_inertia() * s.cubic[2]);
      double least = 10;
      for (const Complex x : s.eigenvalues) least = std::min(least, std::abs(x - slow) / std::abs(slow));
      CHECK(least < 30 * std::sqrt(d));
    }
  }
}

TEMPLATE_TEST_CASE("stability in other precisions", "", float, long double) {
  using S = TestType;
  Bodies bodies(4);
  for (int i = 0; i < 50; ++i) {
    const auto d = bodies.realisable();
    const auto g = Gyrostat<S>::make(d.inertia().cast<S>(), d.axis().cast<S>(), S(d.axial_inertia()), S(d.slope()),
                                     S(d.no_load_rate()));
    const double l = std::abs(d.target_momentum()) * bodies.scale(0.5, 5);
    const auto mine = stability_of(*g, S(l), steady_rotations(*g, S(l))[0]);
    const auto truth = stability_of(d, l, steady_rotations(d, l)[0]);
    CHECK(mine.verdict == truth.verdict);
    CHECK(double(mine.decay_rate) == Approx(truth.decay_rate).epsilon(std::is_same_v<S, float> ? 5e-3 : 1e-11));
  }
}
