// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/published.hpp"

#include <algorithm>

#include "bodies.hpp"
#include "catch.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using V = Vec3<double>;
using C = math::Complex<double>;

/// By ascending real, then imaginary part.
std::array<C, 3> sorted(std::array<C, 3> x) {
  std::sort(x.begin(), x.end(), [](C a, C b) { return std::abs(a.re - b.re) > 1e-9 ? a.re < b.re : a.im < b.im; });
  return x;
}

/// The paper's Q5, Q12 from e and tau, by which it means to prove k > 0: sums that should not be negative.
struct PositiveSums {
  double q5_printed;    ///< e1^2 - e3^2: can be -1
  double q5;            ///< 1 - e1^2 - e3^2
  double q12_expanded;  ///< first two lines, right
  double q12_printed;   ///< last line, with a term too many
  double q12;           ///< |tau|^2 |e x tau|^2
};
PositiveSums positive_sums(const V& e, const V& tau) {
  const V e2 = e.cwiseProduct(e), t2 = tau.cwiseProduct(tau);
  const double product = e.dot(tau);
  // sum over i of t_i^2 (t_i^2 (1 - e_i^2) - 2 sum of the mixed products) and t_i^2 t_j^2 (e_i^2 + e_j^2 + 2 e_k^2)
  const double mixed =
      2 * (e[0] * e[1] * tau[0] * tau[1] + e[0] * e[2] * tau[0] * tau[2] + e[1] * e[2] * tau[1] * tau[2]);
  double expanded = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    expanded += t2[i] * (t2[i] * (e2[j] + e2[k]) - mixed) + t2[i] * t2[j] * (e2[i] + e2[j] + 2 * e2[k]);
  }
  const double right = tau.squaredNorm() * (tau.squaredNorm() * e.squaredNorm() - product * product);
  const double extra = 2 * (t2[0] * t2[1] * e2[2] + t2[0] * t2[2] * e2[1] + t2[1] * t2[2] * e2[0]);
  return {e2[0] - e2[2], 1 - e2[0] - e2[2], expanded, right + extra, right};
}

Gyrostat<double> body_of(const published::Data<double>& d) {
  return Gyrostat<double>::make(d.inertia.asDiagonal(), d.axis, d.axial_inertia, d.slope, d.no_load_rate).value();
}

}  // namespace

TEST_CASE("the printed scalar system grows; its start hides that for six seconds", "[rotor]") {
  const auto system = published::printed<double>();
  const auto d = sorted(system.exponents());
  CHECK(d[0].re == Approx(-2.802).margin(5e-4));
  CHECK(d[1].re == Approx(-0.729).margin(5e-4));
  CHECK(d[2].re == Approx(0.741).margin(5e-4));
  CHECK(system.growth_rate() == d[2].re);
  // the four equations, by their own words
  Bodies bodies(1);
  for (int i = 0; i < 20; ++i) {
    const V y = bodies.direction(), dy = system.matrix() * y;
    CHECK(std::abs(-dy[0] - 2 * y[1] / 3 + y[2] / 3) < 1e-15);
    CHECK(std::abs(dy[1] + 4 * y[0] / 5 + y[2] / 5) < 1e-15);
    CHECK(std::abs(-0.1 * dy[0] + 0.167 * dy[1] + 4 * y[2] + 1.41 * dy[2]) < 1e-14);
    CHECK(std::abs(system.drift().dot(y) + std::sqrt(2.) / 7 * y[2]) < 1e-15);
  }
  const auto start = published::printed_start<double>();
  const auto size = [&](double t) { return system.at(t, start).y.head<2>().norm(); };
  CHECK(size(0) == Approx(std::sqrt(221.)));
  CHECK(size(6.07) == Approx(0.24).margin(0.01));
  CHECK(size(10) == Approx(3.3).margin(0.1));
  CHECK(size(20) == Approx(5.4e3).epsilon(0.02));
  for (double t = 0; t < 5.5; t += 0.5) CHECK(size(t + 0.5) < size(t));
  for (double t = 6.5; t < 12; t += 0.5) CHECK(size(t + 0.5) > size(t));
}

TEST_CASE("the right algebra of the printed data is a growing spiral, about a maximum that is none", "[rotor]") {
  const auto data = published::printed_data<double>();
  const auto system = published::corrected(data);
  const auto d = sorted(system.exponents());
  CHECK(d[0].re == Approx(-3.41).margin(0.005));
  CHECK(d[2].re == Approx(0.0137).margin(5e-5));
  CHECK(d[2].im == Approx(0.727).margin(5e-4));
  // rows 2 and 4 as printed; rows 1 and 3 not
  Bodies bodies(2);
  for (int i = 0; i < 20; ++i) {
    const V y = bodies.direction(), dy = system.matrix() * y;
    CHECK(std::abs(dy[0] - 2 * y[1] / 3 + y[2] / 3) < 1e-15);
    CHECK(std::abs(dy[1] + 4 * y[0] / 5 + y[2] / 5) < 1e-15);
    CHECK(std::abs(0.1 * dy[0] - dy[1] / 6 + 2 * y[2] + (1 - 43. / 105) * dy[2]) < 1e-14);
    CHECK(std::abs(system.drift().dot(y) + std::sqrt(2.) / 7 * y[2]) < 1e-15);
  }
  // no omega* makes it steady: (omega*, omega*, 6 + sqrt(2) omega*)
  for (const double rate : {-5., -1., 0., 1., 5.}) {
    CHECK((published::misfit(data, rate) - V(rate, rate, 6 + std::sqrt(2.) * rate)).norm() < 1e-14);
    CHECK(published::misfit(data, rate).norm() > 2.9);
  }
  auto any = data;
  any.no_load_rate = 0;
  CHECK(body_of(any).realisability() == Approx(-0.092).margin(5e-4));
}

TEST_CASE("the repaired examples are steady, stable, and one of them can be built", "[rotor]") {
  const auto first = published::repaired_data<double>(), second = published::realisable_data<double>();
  const auto d1 = sorted(published::corrected(first).exponents()),
             d2 = sorted(published::corrected(second).exponents());
  CHECK(d1[0].re == Approx(-3.2157).margin(5e-5));
  CHECK(d1[2].re == Approx(-0.0857).margin(5e-5));
  CHECK(d1[2].im == Approx(0.7446).margin(5e-5));
  CHECK(d2[0].re == Approx(-8.9028).margin(5e-5));
  CHECK(d2[2].re == Approx(-0.004816).margin(5e-7));
  CHECK(d2[2].im == Approx(0.7848).margin(5e-5));
  CHECK((second.direction - V(.06020, .11089, .99201)).norm() < 1e-5);
  CHECK(second.spin_rate == Approx(.949085).margin(5e-7));
  CHECK(body_of(second).realisable());
  for (const auto& data : {first, second}) {
    CHECK(published::misfit(data, data.no_load_rate).norm() < 1e-14);
    const auto body = body_of(data);
    const auto steady = steady_rotations(body, data.norm)[0];
    CHECK(std::abs(std::abs(steady.direction.dot(data.direction)) - 1) < 1e-14);
    if (data.no_load_rate != 0) {
      CHECK(steady.spin_rate == Approx(data.spin_rate).epsilon(1e-13));
    }
    std::array<C, 3> exponents;
    const auto roots = stability_of(body, data.norm, steady).eigenvalues;
    for (std::size_t i = 0; i < 3; ++i) exponents[i] = {roots[i].real(), roots[i].imag()};
    exponents = sorted(exponents);
    const auto here = sorted(published::corrected(data).exponents());
    for (std::size_t i = 0; i < 3; ++i) CHECK(math::magnitude(exponents[i] - here[i]) < 1e-12);
  }
}

TEST_CASE("the corrected equations are the derivative of the motion", "[rotor]") {
  for (const auto& data : {published::repaired_data<double>(), published::realisable_data<double>()}) {
    const auto body = body_of(data);
    const auto system = published::corrected(data);
    std::vector<double> off;
    for (const double eps : {1e-3, 1e-4}) {
      // P = P_inf exp(gamma), P_inf = exp(psi_dot t m)
      const V& m = data.direction;
      const published::Deviation<double> start{V(0.6, -0.5, 0.4) * eps, 0.3 * eps};
      const auto gamma = [&](const published::Deviation<double>& x) -> V {
        const double share = m[0] * m[1] / (1 + m[2]);
        const V u(1 - m[0] * m[0] / (1 + m[2]), -share, -m[0]), v(-share, 1 - m[1] * m[1] / (1 + m[2]), -m[1]);
        return x.y[0] * u + x.y[1] * v + x.along * m;
      };
      const auto q = quaternion_from_vector<double>(gamma(start));
      const V H = rotate(conjugate(q), V(data.norm * m));
      const double omega = data.no_load_rate + start.y[2];
      const State<double> s{
          q, H, body.axial_inertia() * (body.coupling() * omega + (body.inverse_inertia() * body.axis()).dot(H)), 0};
      const double t = 3;
      const auto truth = LongMotion::from(body, s, {t})[0];
      const auto found = system.at(t, start);
      const auto told =
          quaternion_from_vector<double>(data.spin_rate * t * m) * quaternion_from_vector<double>(gamma(found));
      off.push_back(angle_between(truth.attitude, told));
    }
    CHECK(off[0] < 1e-5);
    CHECK(std::log10(off[0] / off[1]) == Approx(2).margin(0.1));
  }
}

TEST_CASE("errata of the paper, by numbers", "[rotor]") {
  Bodies bodies(3);
  for (int i = 0; i < 50; ++i) {
    const auto body = bodies.realisable();
    const auto s = bodies.start(body);
    const auto rate = state_rate(body, s);
    const double lambda = body.axial_inertia(), k = body.coupling(), S = body.slope(), target = body.no_load_rate();
    const double l = s.momentum.norm();
    const V& e = body.axis();
    const V n = body.inverse_inertia() * e, m = s.momentum / l, dm = rate.momentum / l;
    const V Omega = body.angular_velocity(s.momentum, s.axial_momentum);
    const double omega = body.rotor_rate(s.axial_momentum, Omega), x = omega - target;
    const double domega = (rate.axial_momentum / lambda - n.dot(rate.momentum)) / k;  // of p = lambda (k omega + n.H)
    const V dOmega = body.free_inverse() * (rate.momentum - rate.axial_momentum * e);
    const V e_star = l / k * n;
    const double size = std::abs(domega) + std::abs(S / lambda * x) + e_star.norm() * dm.norm();
    // (25): the moment of inertia is missing
    CHECK(std::abs(lambda * (domega + e.dot(dOmega)) + S * x) < 1e-12 * size);
    CHECK(std::abs(domega + e.dot(dOmega) + S * x) == Approx(std::abs((1 - 1 / lambda) * S * x)).margin(1e-12 * size));
    // (29): the sign of the last term
    const double relaxation = S / (lambda * k);
    CHECK(relaxation == Approx(body.relaxation_rate()));
    CHECK(std::abs(domega + relaxation * x + e_star.dot(dm)) < 1e-12 * size);
    CHECK(std::abs(domega + relaxation * x - e_star.dot(dm)) ==
          Approx(2 * std::abs(e_star.dot(dm))).margin(1e-12 * size));
    // (32): d/dt (l^2 m.J m/2) - lambda omega k e*.dm = 0
    const double change = l * l * m.dot(body.inverse_inertia() * dm), couple = lambda * omega * k * e_star.dot(dm);
    CHECK(std::abs(change - couple) < 1e-12 * (std::abs(change) + std::abs(couple)));
    // (33), where the two errors cancel
    const double sum = change / k + lambda * omega * domega;
    CHECK(std::abs(omega * x + sum / (lambda * relaxation)) < 1e-11 * (std::abs(omega * x) + std::abs(sum)));
    // (35): d/dt {-e*.m - x}/S~ = x
    CHECK(std::abs((-e_star.dot(dm) - domega) / relaxation - x) < 1e-11 * size / relaxation);
    // k = det R/det theta
    const Mat3<double> R = body.inertia() - lambda * e * e.transpose();
    CHECK(k == Approx(R.determinant() / body.inertia().determinant()).epsilon(1e-12));
    // the sums that are to prove k > 0
    const V tau = bodies.direction() * bodies.scale(0.1, 3);
    const auto q = positive_sums(e, tau);
    const V across = e.cross(tau);
    CHECK(q.q12 == Approx(tau.squaredNorm() * across.squaredNorm()).epsilon(1e-12));
    CHECK(q.q12_expanded == Approx(q.q12).epsilon(1e-10));
    CHECK(q.q12_printed > q.q12);
    CHECK(q.q5 >= 0);
  }
  CHECK(positive_sums(V(0, 0, 1), V(1, 0, 0)).q5_printed == -1);
}

TEMPLATE_TEST_CASE("the printed example in every scalar", "[rotor]", float, double, long double) {
  using S = TestType;
  const auto x = published::printed<S>().at(2, published::printed_start<S>());
  const auto y = published::printed<long double>().at(2, published::printed_start<long double>());
  CHECK(std::abs(x.y[0] - S(y.y[0])) < 1000 * epsilon<S>);
  CHECK(std::abs(x.along - S(y.along)) < 1000 * epsilon<S>);
}
