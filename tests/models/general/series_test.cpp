// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/series.hpp"

#include <cmath>

#include "catch.hpp"

namespace general_series_test {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr int order = 20;
using Series = NumberSeries<double, order>;

double value(const Series& s, double x) { return math::evaluate(s.c, s.last, x); }

TEST_CASE("rows and columns multiply as vectors and matrices", "[general]") {
  Mat3<double> m;
  m << 1, 2, 3, 4, 5, 6, 7, 8, 10;
  const Vec3<double> a(0.3, -2, 1.5), b(1, 0.5, -0.7);
  const auto product = Columns<double>(m) * row<double>(a);
  const auto both = cross_rows(row<double>(a), row<double>(b));
  for (int i = 0; i < 3; ++i) {
    CHECK(product[i] == Approx((m * a)[i]));
    CHECK(both[i] == Approx(cross<double>(a, b)[i]));
  }
  CHECK(both[3] == 0);
  VectorSeries<double, 3> x, y;
  for (int k = 0; k <= 3; ++k) x.set(k, row<double>(k * a + b)), y.set(k, row<double>(a - k * b));
  Vec3<double> sum(0, 0, 0);
  for (int j = 0; j <= 3; ++j) sum += cross<double>(j * a + b, a - (3 - j) * b);
  for (int i = 0; i < 3; ++i) CHECK(cross_term(x, y, 3)[i] == Approx(sum[i]));
}

TEST_CASE("products of rows, and the torque on a shape, order by order", "[general]") {
  VectorSeries<double, order> v;
  for (int k = 0; k <= order; ++k) v.set(k, lanes(std::cos(3. * k), std::sin(2. * k + 1), 0.5 - k / 7., 0.));
  for (const bool diagonal : {true, false}) {
    Mat3<double> J = Vec3<double>(4, 3, 0.5).asDiagonal();
    if (!diagonal) J(0, 1) = J(1, 0) = 0.3, J(0, 2) = J(2, 0) = -0.1, J(1, 2) = J(2, 1) = 0.2;
    const ShapeTorque<double> torque(J);
    CHECK(torque.has_squares == !diagonal);
    for (int k = 0; k <= order; ++k) {
      Vec3<double> sum(0, 0, 0), squares(0, 0, 0), products(0, 0, 0);
      for (int j = 0; j <= k; ++j) {
        const Vec3<double> a(v.v[j][0], v.v[j][1], v.v[j][2]), b(v.v[k - j][0], v.v[k - j][1], v.v[k - j][2]);
        sum += cross<double>(a, J * b), squares += a.cwiseProduct(b);
        products += a.cwiseProduct(Vec3<double>(b[1], b[2], b[0]));
      }
      for (int i = 0; i < 3; ++i) {
        CAPTURE(diagonal, k, i);
        CHECK(torque(v, k)[i] == Approx(sum[i]).margin(1e-12));
        CHECK(square_term(v.v, k)[i] == Approx(squares[i]).margin(1e-12));
        CHECK(product_term(v.v, v.turned, k)[i] == Approx(products[i]).margin(1e-12));
      }
    }
  }
}

TEST_CASE("a cubic and a wave as series are themselves", "[general]") {
  const Cubic<double> cubic{2, {1, -0.5, 0.25, 0.1}};
  Series plain, wave;
  const double unit = 0.4;
  plain.set(cubic, unit);
  CHECK(plain.last == 3);
  wave.set(cubic, unit, 3., 0.2);
  for (const double t : {2., 2.3, 1.5}) {
    CHECK(value(plain, (t - 2) / unit) == Approx(cubic(t)));
    CHECK(value(wave, (t - 2) / unit) == Approx(cubic(t) * std::sin(3 * t + 0.2)));
  }
  Series one;
  one.set_constant(3);
  CHECK(one.times(wave.c, 4) == Approx(3 * wave.c[4]));
}

TEST_CASE("an orbit as series is the orbit", "[general]") {
  for (const double e : {0., 0.1, 0.7}) {
    Orbit<double> orbit;
    orbit.radius = 2, orbit.mu = 3, orbit.eccentricity = e, orbit.true_anomaly = 0.4;
    const Vec3<double> m = Vec3<double>(1, -2, 0.5).normalized();
    for (const double t : {0., 1.7, 5.}) {
      const auto at = orbit_at(orbit, t);
      const double unit = 0.1 / at.rate;
      OrbitSeries<double, order> series;
      series.set(orbit, at, unit);
      const auto cosine = series.cosine_of(at, m);
      for (const double x : {0.5, 1., 1.5}) {
        const auto there = orbit_at(orbit, t + x * unit);
        CAPTURE(e, t, x);
        CHECK(value(series.rate, x) == Approx(unit * there.rate).epsilon(1e-13));
        CHECK(value(series.gradient, x) == Approx(there.gradient).epsilon(1e-13));
        CHECK(value(cosine, x) == Approx(m.dot(there.radial)).epsilon(1e-13));
      }
    }
  }
}

}  // namespace general_series_test
