// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/full.hpp"

#include "catch.hpp"

#include <algorithm>
#include <array>

#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using Turning = FullSystem<double, true>;
static_assert(ode::TaylorSystem<FullSystem<double>> && ode::Projects<FullSystem<double>>);
static_assert(ode::TaylorSystem<Turning> && ode::Projects<Turning>);
static_assert(ode::TaylorSystem<VariationalSystem<double>> && ode::Projects<VariationalSystem<double>>);

/// (w', d') as one vector.
template <Real S>
Eigen::Matrix<S, 6, 1> rate(const Problem<S>& p, const Vec3<S>& w, const Vec3<S>& d) {
  Eigen::Matrix<S, 6, 1> made;
  made << angular_acceleration<S>(p, w, d), fixed_vector_rate<S>(d, w);
  return made;
}

template <class System>
struct Motion {
  using S = typename System::Scalar;
  System system;
  ode::Taylor<System> solver;

  Motion(const Problem<S>& p, const State<S>& start, S tolerance = epsilon<S> / 8, bool projected = true)
      : system(p, start), solver(system, 0, system.start(), options(system, tolerance, projected)) {}
  static auto options(const System& system, S tolerance, bool projected) {
    ode::TaylorOptions<S, System::width> options;
    options.tolerance = tolerance;
    options.scale = system.scale();
    options.projected = projected;
    return options;
  }
  State<S> at(S t) {
    CHECK(solver.advance(t) == ode::Status::reached);
    return system.state(solver.state());
  }
};

State<double> end_of(const Problem<double>& p, const State<double>& start, double t) {
  return Motion<FullSystem<double>>(p, start).at(t);
}

double norm_of_difference(const State<double>& a, const State<double>& b) {
  return std::max((a.angular_velocity - b.angular_velocity).norm(), (a.down - b.down).norm());
}

/// Greatest error of the row x' = f(x) of a polynomial at `at`, over the size of its group of four.
template <Real S, int order, int width, class F>
S residual(const S (&x)[order + 1][width], S unit, S at, const F& wanted) {
  S value[width], slope[width];
  for (int k = 0; k < width; ++k) {
    value[k] = x[order][k];
    slope[k] = 0;
    for (int j = order; j >= 1; --j) {
      slope[k] = slope[k] * at + S(j) * x[j][k];
      value[k] = value[k] * at + x[j - 1][k];
    }
  }
  const auto right = wanted(value);
  S worst = 0;
  for (int k = 0; k < width; ++k) {
    S size = 0;
    for (int j = k / 4 * 4; j < k / 4 * 4 + 4; ++j)
      size = std::max({size, unit * std::abs(right[std::size_t(j)]), std::abs(slope[j])});
    if (size > 0) worst = std::max(worst, std::abs(slope[k] - unit * right[std::size_t(k)]) / size);
  }
  return worst;
}

}  // namespace

TEST_CASE("heavy: the Jacobian is the derivative", "[heavy]") {
  Tops random(1);
  for (int i = 0; i < 20; ++i) {
    const auto p = cast<long double>(random.body());
    const auto s = cast<long double>(random.start());
    const auto J = state_jacobian(p, s.angular_velocity, s.down);
    for (int j = 0; j < 6; ++j) {
      Vec3<long double> w[2] = {s.angular_velocity, s.angular_velocity}, d[2] = {s.down, s.down};
      constexpr long double h = 0.125L;  // exact: quadratic
      for (const int side : {0, 1}) (j < 3 ? w[side][j] : d[side][j - 3]) += side == 0 ? h : -h;
      const Eigen::Matrix<long double, 6, 1> column = (rate(p, w[0], d[0]) - rate(p, w[1], d[1])) / (2 * h);
      CHECK((J.col(j) - column).norm() < 1e-17L * J.norm());
    }
  }
}

TEMPLATE_TEST_CASE("heavy: the series solve the equations", "[heavy]", float, double, long double) {
  using S = TestType;
  constexpr int order = 20;
  using System = FullSystem<S, true>;
  Tops random(2);
  for (int i = 0; i < 16; ++i) {
    const auto p = cast<S>(random.body(i % 4 == 1 ? 0 : 1, i % 4 == 2 ? 0 : 0.5));
    auto s = cast<S>(random.start());
    if (i == 3) s.angular_velocity.setZero();
    const System system(p, s);
    S x[order + 1][System::width] = {};
    typename System::template Work<order> work;
    std::copy(system.start().begin(), system.start().end(), x[0]);
    const S unit = S(0.14L);  // short enough that what lies beyond the order is below rounding
    system.expand(0, unit, x, work);
    for (const S at : {S(0), S(0.5L), S(1)}) {
      const S worst = residual<S, order>(x, unit, at, [&](const S* y) {
        const Vec3<S> w(y[0], y[1], y[2]), d(y[4], y[5], y[6]);
        const auto f = rate<S>(p, w, d);
        const Quat<S> q = quaternion_rate<S>({y[8], y[9], y[10], y[11]}, w);
        return std::array<S, 12>{f[0], f[1], f[2], 0, f[3], f[4], f[5], 0, q.w, q.x, q.y, q.z};
      });
      CAPTURE(i, at);
      CHECK(worst <= 200 * epsilon<S>);
    }
    // without the attitude the same numbers
    using Less = FullSystem<S>;
    const Less less(p, s);
    S y[order + 1][Less::width] = {};
    typename Less::template Work<order> work_2;
    std::copy(less.start().begin(), less.start().end(), y[0]);
    less.expand(0, unit, y, work_2);
    for (int k = 0; k <= order; ++k)
      for (int j = 0; j < Less::width; ++j) CHECK(std::abs(y[k][j] - x[k][j]) <= 32 * epsilon<S> * std::abs(x[k][j]));
  }
}

TEMPLATE_TEST_CASE("heavy: the variational series solve their equations", "[heavy]", double, long double) {
  using S = TestType;
  constexpr int order = 20;
  using System = VariationalSystem<S>;
  Tops random(3);
  for (int i = 0; i < 4; ++i) {
    const auto p = cast<S>(random.body());
    const auto s = cast<S>(random.start());
    const System system(p, s);
    S x[order + 1][System::width] = {};
    typename System::template Work<order> work;
    std::copy(system.start().begin(), system.start().end(), x[0]);
    system.expand(0, S(0.14L), x, work);
    for (const S at : {S(0), S(1)}) {
      const S worst = residual<S, order>(x, S(0.14L), at, [&](const S* y) {
        const Vec3<S> w(y[0], y[1], y[2]), d(y[4], y[5], y[6]);
        std::array<S, System::width> out{};
        const auto f = rate<S>(p, w, d);
        const auto J = state_jacobian<S>(p, w, d);
        const typename System::Matrix change = J * system.derivative(y);
        for (int k = 0; k < 3; ++k) out[std::size_t(k)] = f[k], out[std::size_t(k + 4)] = f[k + 3];
        for (int column = 0; column < 6; ++column)
          for (int k = 0; k < 3; ++k) {
            out[std::size_t(8 * (column + 1) + k)] = change(k, column);
            out[std::size_t(8 * (column + 1) + k + 4)] = change(k + 3, column);
          }
        return out;
      });
      CHECK(worst <= 400 * epsilon<S>);
    }
  }
}

TEST_CASE("heavy: the variational motion is the derivative of the motion, and keeps what its laws say", "[heavy]") {
  Tops random(4);
  for (int i = 0; i < 6; ++i) {
    const auto p = cast<long double>(random.body());
    const auto s = cast<long double>(random.start());
    Motion<VariationalSystem<long double>> motion(p, s);
    const auto end = motion.at(5);
    const auto M = motion.system.derivative(motion.solver.state());
    for (int j = 0; j < 6; ++j) {
      constexpr long double h = 1e-5L;
      State<long double> side[2] = {s, s};
      Eigen::Matrix<long double, 6, 1> got[2];
      for (const int k : {0, 1}) {
        (j < 3 ? side[k].angular_velocity[j] : side[k].down[j - 3]) += k == 0 ? h : -h;
        const auto moved = Motion<FullSystem<long double>>(p, side[k]).at(5);
        got[k] << moved.angular_velocity, moved.down;
      }
      CHECK((M.col(j) - (got[0] - got[1]) / (2 * h)).norm() < 1e-8L * M.norm());
    }
    const auto gradients = [&](const State<long double>& at) {
      Eigen::Matrix<long double, 3, 6> F;
      const Vec3<long double> Iw = p.inertia().cwiseProduct(at.angular_velocity),
                              Id = p.inertia().cwiseProduct(at.down);
      F << Iw.transpose(), (p.gradient() * Id - p.moment()).transpose(), Id.transpose(), Iw.transpose(),
          Vec3<long double>::Zero().transpose(), 2 * at.down.transpose();
      return F;
    };
    CHECK((gradients(end) * M - gradients(s)).norm() < 1e-16L * M.norm() * gradients(s).norm());
    // the state is FullSystem's
    const auto alone = Motion<FullSystem<long double>>(p, s).at(5);
    CHECK((alone.angular_velocity - end.angular_velocity).norm() < 1e-16L);
  }
}

TEST_CASE("heavy: integrals to rounding over ten thousand turns", "[heavy]") {
  const auto p = Problem<double>::make({0.0011, 0.0016, 0.0020}, 0.8, {0.012, 0.009, 0.010}, 9.80665, 40.0).value();
  State<double> s;
  s.angular_velocity = {2, -1, 20};
  s.attitude = normalised(Quat<double>{0.2, 0.4, -0.7, 0.3});
  s.down = rotate<double>(conjugate(s.attitude), {0, 0, -1});
  Motion<Turning> motion(p, s, 1e-15);
  double energy = 0, momentum = 0, length = 0, tilt = 0, unit = 0;
  for (int i = 1; i <= 10; ++i) {
    const auto at = motion.at(2 * pi<double> / s.angular_velocity.norm() * 1000 * i);
    energy = std::max(energy, std::abs(p.energy(at) - p.energy(s)));
    momentum = std::max(momentum, std::abs(p.vertical_momentum(at) - p.vertical_momentum(s)));
    length = std::max(length, std::abs(at.down.norm() - 1));
    tilt = std::max(tilt, (at.down - rotate<double>(conjugate(at.attitude), {0, 0, -1})).norm());
    unit = std::max(unit, std::abs(norm(at.attitude) - 1));
  }
  CHECK(energy < 8e-16 * (p.energy(s) + p.moment().norm() + p.gradient() * p.inertia()[2]));
  CHECK(momentum < 8e-16 * p.inertia().cwiseProduct(s.angular_velocity).norm());
  CHECK(length < 4e-16);
  CHECK(tilt < 2e-15);
  CHECK(unit < 4e-16);
}

TEST_CASE("heavy: the projection wins digits over many turns and loses none over few", "[heavy]") {
  Tops random(6);
  double worst[2] = {0, 0}, first[2] = {0, 0};
  for (int i = 0; i < 4; ++i) {
    const auto p = random.body(i < 2 ? 1 : 0.1, i % 2 == 0 ? 0 : 0.1);
    auto s = random.start();
    s.angular_velocity = {0.1, 0.2, 3};
    for (const bool projected : {false, true}) {
      Motion<FullSystem<double>> motion(p, s, 1e-12, projected);
      Motion<FullSystem<long double>> truth(cast<long double>(p), cast<long double>(s), 1e-19L, false);
      for (const double t : {2.0, 400.0}) {
        const auto at = motion.at(t);
        const auto right = truth.at(t);
        const double error = static_cast<double>((at.down.cast<long double>() - right.down).norm());
        auto& most = t < 100 ? first[projected] : worst[projected];
        most = std::max(most, error);
      }
    }
  }
  CHECK(worst[1] < worst[0] / 4);
  CHECK(first[1] < 2 * first[0]);
}

TEST_CASE("heavy: time reversal, relabelled axes, scaled units", "[heavy]") {
  Tops random(7);
  for (int i = 0; i < 12; ++i) {
    const auto p = random.body();
    const auto s = random.start();
    const double t = 20;
    const auto end = end_of(p, s, t);

    auto back = end;
    back.angular_velocity *= -1;
    auto home = end_of(p, back, t);
    home.angular_velocity *= -1;
    CHECK(norm_of_difference(home, s) < 1e-10);

    // axes (1, 2, 3) called (2, 3, 1); and (2, 1, 3) with all rates reversed in sign, which turns the hand
    const auto cyclic = [](const Vec3<double>& v) { return Vec3<double>(v[2], v[0], v[1]); };
    const auto other =
        Problem<double>::make(cyclic(p.inertia()), p.mass(), cyclic(p.centre_of_mass()), p.gravity(), p.gradient());
    REQUIRE(other);
    auto turned = end_of(*other, {cyclic(s.angular_velocity), cyclic(s.down), {}}, t);
    CHECK(norm_of_difference(turned, {cyclic(end.angular_velocity), cyclic(end.down), {}}) < 1e-11);
    const auto swapped = [](const Vec3<double>& v, double sign) {
      return Vec3<double>(sign * Vec3<double>(v[1], v[0], v[2]));
    };
    const auto mirror = Problem<double>::make(swapped(p.inertia(), 1), p.mass(), swapped(p.centre_of_mass(), 1),
                                              p.gravity(), p.gradient());
    REQUIRE(mirror);
    turned = end_of(*mirror, {swapped(s.angular_velocity, -1), swapped(s.down, 1), {}}, t);
    CHECK(norm_of_difference(turned, {swapped(end.angular_velocity, -1), swapped(end.down, 1), {}}) < 1e-11);

    // twice as fast under fourfold torques
    const auto fast =
        Problem<double>::make(p.inertia(), p.mass(), p.centre_of_mass(), 4 * p.gravity(), 4 * p.gradient());
    REQUIRE(fast);
    turned = end_of(*fast, {2 * s.angular_velocity, s.down, {}}, t / 2);
    CHECK(norm_of_difference(turned, {2 * end.angular_velocity, end.down, {}}) < 1e-11);
  }
}

TEST_CASE("heavy: without weight and gradient, Euler's motion", "[heavy]") {
  using namespace gyrostat::deceleration;
  Tops random(8);
  for (int i = 0; i < 12; ++i) {
    auto I = random.body().inertia();
    std::sort(I.begin(), I.end(), std::greater<>());
    const auto p = heavy::Problem<double>::make(I, 1, {0, 0, 0}, 9.8, 0);
    REQUIRE(p);
    const auto s = random.start();
    const Vec3<double> M = I.cwiseProduct(s.angular_velocity);
    const auto polhode = polhode_through<double>(I.cwiseInverse(), M);
    const double t = 30, u = argument_of(polhode, M) + polhode.rate_per_momentum() * M.norm() * t;
    const auto end = end_of(*p, s, t);
    CHECK((I.cwiseProduct(end.angular_velocity) - momentum_on(polhode, M.norm(), u)).norm() < 1e-12);
    // the momentum stands still in space
    const auto whole = Motion<Turning>(*p, s).at(t);
    const Vec3<double> before = rotate<double>(s.attitude, M),
                       after = rotate<double>(whole.attitude, I.cwiseProduct(whole.angular_velocity));
    CHECK((before - after).norm() < 1e-13);
  }
}

TEST_CASE("heavy: the projection corrects a state and leaves a right one alone", "[heavy]") {
  Tops random(9);
  for (int i = 0; i < 40; ++i) {
    const auto p = random.body(i % 3 == 0 ? 0 : 1, i % 4 == 0 ? 0 : 0.5);
    auto s = random.start();
    if (i % 5 == 0) s.angular_velocity.setZero();
    if (i % 7 == 0)
      s.angular_velocity = 2 * s.down;  // energy and momentum are nearly dependent where the torque is small
    const Turning system(p, s);
    for (const double off : {0.0, 1e-9}) {
      auto x = system.start();
      for (std::size_t k = 0; k < x.size(); ++k)
        if (k != 3 && k != 7) x[k] += off * random.any(-1, 1);
      const auto before = x;
      std::array<double, 12> low{};
      system.project(0, x.data(), low.data());
      for (std::size_t k = 0; k < x.size(); ++k)
        CHECK(std::abs(x[k] - before[k]) < 100 * off + 1e-14 * (1 + std::abs(x[k])));
      const auto state = system.state(x.data());
      const double slack = 1e-15 + 100 * off * off;
      CHECK(std::abs(state.down.norm() - 1) < slack);
      CHECK((state.down - rotate<double>(conjugate(state.attitude), {0, 0, -1})).norm() < 2 * slack);
      if (i % 5 != 0 && i % 7 != 0) {
        CHECK(std::abs(p.energy(state) - p.energy(s)) < 8 * slack);
        CHECK(std::abs(p.vertical_momentum(state) - p.vertical_momentum(s)) < 8 * slack);
      }
    }
  }
}

TEST_CASE("heavy: rest, hanging and standing", "[heavy]") {
  const auto p = Problem<double>::make({1, 1.2, 1.5}, 1, {0, 0, 0.01}, 100, 0).value();
  for (const double side : {1.0, -1.0}) {
    State<double> s;
    s.down = {0, 0, side};
    const auto end = Motion<Turning>(p, s).at(50);
    CHECK(end.angular_velocity.isZero(0));
    CHECK(end.down == s.down);
  }
  CHECK(rate_size(p, State<double>{{0, 0, 0}, {0, 0, 1}, {}}) == 0);
  CHECK(rate_size(p, State<double>{{0, 0, 0}, {0, 0, -1}, {}}) == Approx(std::sqrt(4 / 1.5)));
}

TEST_CASE("heavy: no scale is zero where a component is judged", "[heavy]") {
  Tops random(10);
  for (int i = 0; i < 10; ++i) {
    auto s = random.start();
    if (i % 2 == 0) s.angular_velocity.setZero();
    const auto p = random.body(i % 3 == 0 ? 0 : 1, 0);
    const auto scale = Turning(p, s).scale();
    for (std::size_t k = 0; k < 12; ++k) CHECK((scale[k] > 0) == (k != 3 && k != 7));
    const auto more = VariationalSystem<double>(p, s).scale();
    for (std::size_t k = 0; k < 56; ++k) CHECK((more[k] > 0) == (k % 4 != 3));
  }
}

TEST_CASE("heavy: what is not a number stays so", "[heavy]") {
  Tops random(11);
  const auto p = random.body();
  for (const double bad : {gyrostat::nan<double>, gyrostat::infinity<double>}) {
    auto s = random.start();
    s.angular_velocity[1] = bad;
    CHECK(Motion<FullSystem<double>>(p, s).solver.step(1) == ode::Status::not_finite);
    CHECK(Motion<VariationalSystem<double>>(p, s).solver.step(1) == ode::Status::not_finite);
    s = random.start();
    s.down[2] = bad;
    CHECK(Motion<Turning>(p, s).solver.step(1) == ode::Status::not_finite);
  }
}
