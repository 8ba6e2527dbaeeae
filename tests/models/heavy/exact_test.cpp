// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/exact.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "at_length.hpp"
#include "catch.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using V = Vec3<double>;

Problem<double> body(const V& inertia, const V& centre, double gravity, double gradient) {
  const auto made = Problem<double>::make(inertia, 0.5, centre, gravity, gradient);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("exact: which case", "[heavy]") {
  const V top(0.002, 0.002, 0.001), uneven(0.0011, 0.0016, 0.002);
  const auto start = start_at({1, 2, 3}, {0.5, 0.1, -0.7, 0.3});
  const auto which = [&](const Problem<double>& p, const State<double>& s) { return Exact<double>(p, s).which(); };
  CHECK(which(body(uneven, {0, 0, 0}, 9.8, 0), start) == ExactCase::euler);
  CHECK(which(body(uneven, {0, 0, 0.01}, 0, 0), start) == ExactCase::euler);
  CHECK(which(body(top, {0, 0, 0.03}, 9.8, 0), start) == ExactCase::lagrange);
  CHECK(which(body(top, {0, 0, 0.03}, 9.8, 30), start) == ExactCase::lagrange);
  CHECK(which(body(top, {0, 0, 0}, 9.8, 30), start) == ExactCase::lagrange);
  CHECK(which(body({0.002, 0.002, 0.002}, {0.01, 0.02, -0.01}, 9.8, 30), start) == ExactCase::lagrange);
  CHECK(which(body(top, {0.01, 0, 0.03}, 9.8, 0), start) == ExactCase::none);
  CHECK(which(body(uneven, {0, 0, 0}, 9.8, 30), start) == ExactCase::none);
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 0), start) == ExactCase::none);
  State<double> flat{{0, 0, 4}, {0.6, 0.8, 0}, {}};
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 0), flat) == ExactCase::pendulum);
  CHECK(which(body(uneven, {0, 0, 0}, 9.8, 30), flat) == ExactCase::pendulum);
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 30), flat) == ExactCase::none);
  flat.down[1] = gyrostat::nan<double>;
  CHECK(which(body(uneven, {0.01, 0, 0}, 9.8, 0), flat) == ExactCase::none);
  CHECK(std::strcmp(symbol(ExactCase::lagrange), "lagrange") == 0);
}

TEST_CASE("exact: every case against the full equations, and what repeats", "[heavy]") {
  const auto turned = start_at({1, 2, 30}, {0.5, 0.1, -0.7, 0.3});
  State<double> flat{{0, 0, 4}, {0.6, 0.8, 0}, {}};
  flat = *aligned(flat);
  flat.down = {0.6, 0.8, 0};
  const std::pair<Problem<double>, State<double>> scenes[] = {
      {body({0.0011, 0.0016, 0.002}, {0, 0, 0}, 9.8, 0), turned},
      {body({0.002, 0.002, 0.001}, {0, 0, 0.03}, 9.8, 0), turned},
      {body({0.002, 0.001, 0.002}, {0, 0.03, 0}, 9.8, 30), turned},
      {body({0.002, 0.002, 0.002}, {0.01, 0.02, -0.01}, 9.8, 0), turned},
      {body({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 9.8, 0), flat}};
  for (const auto& [problem, start] : scenes) {
    const Exact<double> exact(problem, start);
    REQUIRE(exact.applies());
    const std::vector<double> times{0.0, 0.1, 0.4};
    const auto truth = LongMotion::from(problem, start, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto d = distance(exact.at(times[i]), truth[i]);
      const auto bound = exact.error(times[i]);
      CAPTURE(symbol(exact.which()), times[i]);
      CHECK(d.attitude < 1e-12);
      CHECK(d.attitude <= bound.attitude);
      CHECK(d.down <= bound.down);
      CHECK(d.angular_velocity <= bound.angular_velocity);
    }
    const double T = exact.period();
    CHECK(exact.at(0.1 + T).angular_velocity.norm() == Approx(exact.at(0.1).angular_velocity.norm()).epsilon(1e-12));
  }
}

namespace {

/// Random bodies and starts of one exact case, and the same with every datum a rounding of 2^-52 away, in long double.
class Roundings {
 public:
  explicit Roundings(unsigned seed) : engine_(seed) {}
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  double normal() { return std::normal_distribution<double>()(engine_); }
  double scale(double low, double high) { return std::pow(10, uniform(low, high)); }
  int sign() { return uniform(0, 1) < 0.5 ? -1 : 1; }

  /// Moments, mass centre, gravity, gradient, rates and either attitude (top) or down (across its axis, pendulum).
  void take(const V& inertia, double mass, const V& centre, double gravity, double gradient, const V& rates,
            const Quat<double>& attitude) {
    problem = Problem<double>::make(inertia, mass, centre, gravity, gradient);
    start.attitude = attitude;
    start.down = rotate<double>(conjugate(attitude), {0, 0, -1});
    start.angular_velocity = rates;
    using L = long double;
    const auto off = [&](double x) { return L(x) * (1 + L(sign()) * 0x1p-52L); };
    const bool symmetric = inertia[0] == inertia[1];
    Vec3<L> I(off(inertia[0]), off(inertia[1]), off(inertia[2]));
    if (symmetric) I[1] = I[0];
    near =
        Problem<L>::make(I, off(mass), {off(centre[0]), off(centre[1]), off(centre[2])}, off(gravity), off(gradient));
    near_start.attitude = normalised(Quat<L>{attitude.w, attitude.x, attitude.y, attitude.z});
    near_start.down = rotate<L>(conjugate(near_start.attitude), {0, 0, -1});
    for (int i = 0; i < 3; ++i) near_start.angular_velocity[i] = off(rates[i]);
  }
  /// A top with its axis along z. @param close C/A is next to 1
  void top(bool gradient, bool close) {
    const double A = scale(-3, 1), C = close ? A * (1 + sign() * 0.9 * scale(-6, 0)) : A * uniform(0.1, 1.9);
    const double mass = uniform(0.1, 3), z = sign() * std::sqrt(A / mass) * uniform(0.05, 0.9);
    const Quat<double> q = normalised(uniform(0, 1) < 0.2 ? Quat<double>{1, scale(-8, 0), 0, 0}
                                                          : Quat<double>{normal(), normal(), normal(), normal()});
    V w(normal(), normal(), scale(-1, 2));
    if (uniform(0, 1) < 0.2) w = {0, 0, w[2]};
    if (uniform(0, 1) < 0.2) w *= scale(-4, 0);
    take({A, A, C}, mass, {0, 0, z}, gradient ? 0 : 9.80665, gradient ? uniform(0.1, 5) : 0, w, q);
  }
  /// A body that swings about z, which stays horizontal.
  void pendulum(bool gradient, bool close) {
    V I(uniform(0.5, 1), uniform(0.5, 1), uniform(0.5, 1));
    if (close) I[1] = I[0] * (1 - scale(-6, -1));
    I *= scale(-3, 2);
    const double mass = uniform(0.1, 3), arm = std::sqrt(I.minCoeff() / mass) * uniform(0.02, 0.4);
    const double to = uniform(0, 2 * pi<double>), from = uniform(0, 1) < 0.2 ? sign() * scale(-9, 0) : uniform(-3, 3);
    Mat3<double> R;
    const V down(std::cos(to + from), std::sin(to + from), 0), across(0, 0, 1);
    R.row(2) = -down.transpose();
    R.row(0) = across.transpose();
    R.row(1) = cross<double>(V(-down), across).transpose();
    const V centre = gradient ? V(0, 0, 0) : V(arm * std::cos(to), arm * std::sin(to), 0);
    take(I, mass, centre, gradient ? 0 : 9.80665, gradient ? uniform(0.1, 5) : 0, {0, 0, normal() * scale(-2, 1)},
         from_matrix(R));
  }

  Result<Problem<double>> problem = Errc::not_applicable;
  Result<Problem<long double>> near = Errc::not_applicable;
  State<double> start;
  State<long double> near_start;

 private:
  std::mt19937_64 engine_;
};

/// Stated over true, of down and of the rates, at a time; nothing where no error is stated.
template <class Motion, class Near>
void compare(const Motion& motion, const Near& near, double t, std::vector<double>& down, std::vector<double>& rates) {
  const auto stated = motion->error(t);
  if (!(stated.down < infinity<double>)) return;
  double off = 0, apart = 0;
  for (const double part : {0.37, 0.81, 1.0}) {
    const auto s = motion->at(part * t);
    const auto truth = near->at(part * t);
    off = std::max(off, double((s.down.template cast<long double>() - truth.down).norm()));
    apart = std::max(apart, double((s.angular_velocity.template cast<long double>() - truth.angular_velocity).norm()));
  }
  if (off > 0) down.push_back(stated.down / off);
  if (apart > 0) rates.push_back(stated.angular_velocity / apart);
}

}  // namespace

TEST_CASE("exact: what is stated bounds what roundings of the data do, and not a thousand times over",
          "[heavy][length]") {
  const int count = at_length(600, 6000);
  for (const bool swings : {false, true})
    for (const bool gradient : {false, true})
      for (const bool close : {false, true}) {
        Roundings body(static_cast<unsigned>(61 + 4 * swings + 2 * gradient + close));
        std::vector<double> down, rates;
        for (int i = 0; i < count; ++i) {
          swings ? body.pendulum(gradient, close) : body.top(gradient, close);
          if (!body.problem || !body.near) continue;
          const double t = body.scale(-1, 2.5);
          if (swings) {
            const auto motion = Pendulum<double>::make(*body.problem, body.start);
            const auto near = Pendulum<long double>::make(*body.near, body.near_start);
            if (motion && near) compare(motion, near, t, down, rates);
          } else if (gradient) {
            const auto motion = LagrangeGradient<double>::make(*body.problem, body.start);
            const auto near = LagrangeGradient<long double>::make(*body.near, body.near_start);
            if (motion && near) compare(motion, near, t, down, rates);
          } else {
            const auto motion = LagrangeTop<double>::make(*body.problem, body.start);
            const auto near = LagrangeTop<long double>::make(*body.near, body.near_start);
            if (motion && near) compare(motion, near, t, down, rates);
          }
        }
        CAPTURE(swings, gradient, close);
        REQUIRE(down.size() > std::size_t(count / 4));
        std::sort(down.begin(), down.end());
        std::sort(rates.begin(), rates.end());
        CHECK(down.front() > 1);
        CHECK(rates.front() > 1);
        CHECK(down[down.size() / 2] < 1000);
        CHECK(rates[rates.size() / 2] < 3000);
      }
}

TEST_CASE("exact: none", "[heavy]") {
  const Exact<double> none(body({0.0011, 0.0016, 0.002}, {0.01, 0, 0}, 9.8, 0), start_at({1, 2, 3}, {1, 0, 0, 0}));
  CHECK_FALSE(none.applies());
  CHECK(std::isnan(none.at(1).down[0]));
  CHECK(std::isnan(none.at(1).attitude.w));
  CHECK(none.error(1).attitude == infinity<double>);
  CHECK(std::isnan(none.period()));
}

TEST_CASE("exact motion: a mass centre beside the axis by less than a rounding makes an upright body fall", "[heavy]") {
  State<double> start;
  start.down = {0, 0, -1};
  for (const double gradient : {0.0, 0.1}) {
    const auto p = Problem<double>::make({1, 1, 0.5}, 1, {1e-17, 0, 0.5}, 9.8, gradient);
    REQUIRE(p);
    const Exact<double> upright(*p, start);
    REQUIRE(upright.which() == ExactCase::lagrange);
    CAPTURE(gradient);
    CHECK(upright.error(22).down == infinity<double>);
    for (const double t : {3.0, 8.0}) {  // as the linear equations have it
      const auto truth = LongMotion::from(*p, start, {t});
      const double away = distance(upright.at(t), truth[0]).down;
      CHECK(away <= upright.error(t).down);
      CHECK(upright.error(t).down < 40 * away + 1e-14);
    }
  }
}

TEST_CASE("exact motion: upright at rest but for rounding, when it falls is not known", "[heavy]") {
  const auto p = Problem<double>::make({1, 1, 1}, 0.0113, {0.00408, -0.00616, 0.01163}, 8.39e-6, 0);
  REQUIRE(p);
  State<double> start;
  start.down = -p->centre_of_mass().normalized();
  start.down[0] = std::nextafter(start.down[0], 1.0);
  const Exact<double> upright(*p, start);
  REQUIRE(upright.which() == ExactCase::lagrange);
  CHECK(upright.error(1.7e6).down == infinity<double>);
  start.down = p->centre_of_mass().normalized();
  const Exact<double> hanging(*p, start);
  REQUIRE(hanging.applies());
  CHECK(hanging.error(1.7e6).down < 1e-11);
}

TEST_CASE("exact: a mass centre off the axis is seen in any unit", "[heavy]") {
  for (const double scale : {1e-200, 1e-170, 1., 1e160, 1e200}) {
    CAPTURE(scale);
    const auto p = Problem<double>::make(Vec3<double>(1, 1, .7) * scale, 1e-3 * scale, {0, .03, 0}, 9800, 0);
    REQUIRE(p);
    State<double> start;
    start.angular_velocity = {.3, .2, .1};
    start.down = {0, .6, -.8};
    CHECK(Exact<double>(*p, start).which() == ExactCase::none);
    CHECK(p->pendulum_rate() == Approx(std::sqrt(1e-3 * 9800 * .03 / .7)));
  }
}
