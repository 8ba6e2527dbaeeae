// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/full.hpp"

#include "catch.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "allocations.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/models/rotor/assembly.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "models/rotor/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;
using ode::Status;

namespace {

/// theta = [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5]], tumbling.
template <Real S>
Gyrostat<S> body(S slope = S(0.2L), S no_load_rate = 3, S axial_inertia = S(0.35L)) {
  Mat3<S> theta;
  theta << S(3.2L), S(0.1L), S(-0.15L), S(0.1L), S(4.1L), S(0.2L), S(-0.15L), S(0.2L), 5;
  Vec3<S> e(S(0.75L), S(0.35L), S(0.56L));
  e /= e.norm();
  return Gyrostat<S>::make(theta, e, axial_inertia, slope, no_load_rate).value();
}

template <Real S>
State<S> tumbling(const Gyrostat<S>& gyrostat) {
  return gyrostat.state(normalised(Quat<S>{S(0.1L), S(0.7L), S(0.5L), S(-0.5L)}), {S(1.1L), S(-1.3L), S(2.2L)}, 1);
}

template <Real S, int Order = 20>
class Follower {
 public:
  using System = FullSystem<S>;
  Follower(const Gyrostat<S>& gyrostat, const State<S>& start, S tolerance, bool projected = true)
      : system_(gyrostat, start), solver_(system_, 0, system_.start(), options(system_, tolerance, projected)) {}

  State<S> at(S t) {
    REQUIRE(solver_.advance(t) == Status::reached);
    return system_.state(t, solver_.state());
  }
  S dissipated() const { return solver_.state()[11]; }
  const ode::Taylor<System, Order>& solver() const { return solver_; }
  ode::Taylor<System, Order>& solver() { return solver_; }

 private:
  static ode::TaylorOptions<S, System::width> options(const System& system, S tolerance, bool projected) {
    ode::TaylorOptions<S, System::width> how;
    how.tolerance = tolerance;
    how.scale = system.scale();
    how.projected = projected;
    return how;
  }
  System system_;
  ode::Taylor<System, Order> solver_;
};

template <Real S>
Vec3<S> inertial(const State<S>& s) {
  return rotate<S>(s.attitude, s.momentum);
}

/// Of two states, the greatest difference of attitude, H, p and beta.
double distance(const State<double>& a, const State<double>& b) {
  return std::max({angle_between(a.attitude, b.attitude), (a.momentum - b.momentum).norm(),
                   std::abs(a.axial_momentum - b.axial_momentum), std::abs(a.rotor_angle - b.rotor_angle)});
}

/// Carrier and rotor as two bodies with a joint: the reaction force and moment are unknowns like the accelerations.
struct TwoBodies {
  Assembly<double> parts;
  double slope = 0, no_load_rate = 0;

  // q (4), angular velocity of the carrier (body axes, 3), omega, beta, centroids and velocities (inertial, 12)
  using Numbers = std::array<double, 21>;

  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const Quat<double> q{y[0], y[1], y[2], y[3]};
    const Vec3<double> Omega(y[4], y[5], y[6]);
    const double omega = y[7];
    const Vec3<double>& e = parts.axis;
    const Mat3<double> E = Mat3<double>::Identity();
    const Mat3<double> rotor_inertia =
        parts.axial_inertia * e * e.transpose() + parts.equatorial_inertia * (E - e * e.transpose());
    const Vec3<double> motor = -slope * (omega - no_load_rate) * e;  // on the rotor
    const Vec3<double> rotor_velocity = Omega + omega * e;

    // a1, a2, dOmega, domega, F (on the rotor, at its centroid), N (on the rotor, across e): all in body axes
    Eigen::Matrix<double, 16, 16> A;
    Eigen::Matrix<double, 16, 1> b;
    A.setZero();
    b.setZero();
    A.block<3, 3>(0, 0) = parts.carrier_mass * E;
    A.block<3, 3>(0, 10) = E;  // m1 a1 = -F
    A.block<3, 3>(3, 3) = parts.rotor_mass * E;
    A.block<3, 3>(3, 10) = -E;  // m2 a2 = F
    A.block<3, 3>(6, 6) = parts.carrier_inertia;
    A.block<3, 3>(6, 10) = cross_matrix<double>(parts.offset);  // d x (-F) acts on the carrier
    A.block<3, 3>(6, 13) = E;
    b.segment<3>(6) = -motor - cross<double>(Omega, parts.carrier_inertia * Omega);
    A.block<3, 3>(9, 6) = rotor_inertia;
    A.block<3, 1>(9, 9) = rotor_inertia * e;
    A.block<3, 3>(9, 13) = -E;
    b.segment<3>(9) = motor - cross<double>(Omega, rotor_inertia * rotor_velocity);
    A.block<3, 3>(12, 3) = E;  // the joint: a2 = a1 + dOmega x d + Omega x (Omega x d)
    A.block<3, 3>(12, 0) = -E;
    A.block<3, 3>(12, 6) = cross_matrix<double>(parts.offset);
    b.segment<3>(12) = cross<double>(Omega, cross<double>(Omega, parts.offset));
    A.block<1, 3>(15, 13) = e.transpose();  // the joint is free about e
    const Eigen::Matrix<double, 16, 1> x = A.partialPivLu().solve(b);

    const Quat<double> turning = quaternion_rate<double>(q, Omega);
    rate = {turning.w, turning.x, turning.y, turning.z, x[6], x[7], x[8], x[9], omega};
    const Vec3<double> a1 = rotate<double>(q, x.segment<3>(0)), a2 = rotate<double>(q, x.segment<3>(3));
    for (std::size_t i = 0; i < 3; ++i) {
      rate[9 + i] = y[15 + i];
      rate[12 + i] = y[18 + i];
      rate[15 + i] = a1[static_cast<int>(i)];
      rate[18 + i] = a2[static_cast<int>(i)];
    }
  }
};

}  // namespace

TEST_CASE("the rates are those of the equations") {
  Bodies bodies(1);
  for (int i = 0; i < 50; ++i) {
    const auto g = bodies.realisable();
    const auto s = bodies.start(g);
    const auto rate = state_rate(g, s);
    const Vec3<double> Omega = g.angular_velocity(s.momentum, s.axial_momentum);
    const double omega = g.rotor_rate(s.axial_momentum, Omega);
    // H = theta Omega + lambda omega e
    CHECK((g.inertia() * Omega + g.axial_inertia() * omega * g.axis() - s.momentum).norm() <
          1e-13 * (s.momentum.norm() + std::abs(s.axial_momentum)));
    CHECK((rate.momentum - cross<double>(s.momentum, Omega)).isZero(0));
    CHECK(rate.rotor_angle == omega);
    // L = P H does not change, and V falls by S (omega - omega*)^2
    const Quat<double>&q = s.attitude, &dq = rate.attitude;
    const Quat<double> spin = dq * conjugate(q);  // half the angular velocity, inertial axes
    const Vec3<double> L = inertial(s);
    const Vec3<double> dL =
        rotate<double>(q, rate.momentum) + 2 * cross<double>(Vec3<double>(spin.x, spin.y, spin.z), L);
    CHECK(dL.norm() < 1e-13 * L.norm() * Omega.norm());
    const double x = omega - g.no_load_rate();
    const double dV = Omega.dot(rate.momentum) + x * rate.axial_momentum;
    CHECK(dV == Approx(-g.slope() * x * x).epsilon(1e-10));
    CHECK(rate.axial_momentum == Approx(-g.relaxation_rate() * s.axial_momentum +
                                        g.slope() * (g.no_load_rate() + (g.free_inverse() * g.axis()).dot(s.momentum)))
                                     .epsilon(1e-10)
                                     .margin(1e-12));
  }
}

TEST_CASE("the Jacobian is the derivative") {
  using S = long double;
  const auto g = body<S>();
  const auto s = tumbling(g);
  const auto numbers = [](const State<S>& x) {
    Eigen::Matrix<S, 9, 1> all;
    all << x.attitude.w, x.attitude.x, x.attitude.y, x.attitude.z, x.momentum, x.axial_momentum, x.rotor_angle;
    return all;
  };
  const auto jacobian = state_jacobian(g, s);
  for (int j = 0; j < 9; ++j) {
    const auto moved = [&](S by) {
      State<S> x = s;
      S* place[] = {&x.attitude.w,  &x.attitude.x,  &x.attitude.y,     &x.attitude.z, &x.momentum[0],
                    &x.momentum[1], &x.momentum[2], &x.axial_momentum, &x.rotor_angle};
      *place[j] += by;
      return numbers(state_rate(g, x));
    };
    const S step = 1e-3L;  // the rates are quadratic: central differences are exact
    CHECK(((moved(step) - moved(-step)) / (2 * step) - jacobian.col(j)).norm() < 1e-14L);
  }
  CHECK((jacobian.block<4, 4>(4, 4) - momentum_jacobian(g, s.momentum, s.axial_momentum)).isZero(0));
}

TEMPLATE_TEST_CASE("the coefficients solve the equations", "", float, double, long double) {
  using S = TestType;
  constexpr int order = 20;
  for (const S slope : {S(0), S(0.2L), S(3)}) {
    const auto g = body<S>(slope);
    const FullSystem<S> system(g, tumbling(g));
    alignas(64) S x[order + 1][12] = {};
    alignas(64) typename FullSystem<S>::template Work<order> work;
    for (std::size_t i = 0; i < 12; ++i) x[0][i] = system.start()[i];
    const S unit = S(0.08L);
    system.expand(0, unit, x, work);
    for (const S theta : {S(-0.5), S(0), S(0.25), S(0.5)}) {
      std::array<S, 12> value{}, rate{};
      for (int k = order; k >= 0; --k) {
        for (std::size_t i = 0; i < 12; ++i) {
          rate[i] = rate[i] * theta + value[i];
          value[i] = value[i] * theta + x[k][i];
        }
      }
      for (S& r : rate) r /= unit;
      // beta holds omega* t with t counted from the start
      const State<S> here = system.state(theta * unit, value.data());
      const State<S> wanted = state_rate(g, here);
      const S excess = wanted.rotor_angle - g.no_load_rate();
      const S tolerance = 60 * epsilon<S>;
      CHECK(std::abs(rate[7] - wanted.axial_momentum) < tolerance * (1 + slope));
      CHECK(std::abs(rate[8] - excess) < tolerance);
      CHECK(rate[8] == rate[9]);
      CHECK(rate[8] == rate[10]);
      CHECK(std::abs(rate[11] - slope * excess * excess) < tolerance * (1 + 8 * slope));
      // q and H in principal axes of R: turned back by the state of the derivatives, both being linear
      const Quat<S> back = conjugate(from_matrix<S>(g.free_axes().R_BP));
      const Quat<S> dq = Quat<S>{rate[0], rate[1], rate[2], rate[3]} * back;
      CHECK(std::abs(dq.w - wanted.attitude.w) < tolerance);
      CHECK(std::abs(dq.x - wanted.attitude.x) < tolerance);
      CHECK(std::abs(dq.y - wanted.attitude.y) < tolerance);
      CHECK(std::abs(dq.z - wanted.attitude.z) < tolerance);
      const Vec3<S> dH = rotate<S>(conjugate(back), Vec3<S>(rate[4], rate[5], rate[6]));
      CHECK((dH - wanted.momentum).norm() < 8 * tolerance);
    }
  }
}

TEST_CASE("the motion is that of two bodies with a joint") {
  TwoBodies two;
  two.parts.carrier_inertia << 2.1, 0.12, -0.05, 0.12, 2.6, 0.2, -0.05, 0.2, 3.2;
  two.parts.carrier_mass = 12;
  two.parts.rotor_mass = 3;
  two.parts.axial_inertia = 0.45;
  two.parts.equatorial_inertia = 0.3;
  two.parts.axis = Vec3<double>(0.36, 0.48, 0.8).normalized();
  two.parts.offset = {0.2, -0.15, 0.3};
  two.slope = 0.35;
  two.no_load_rate = 8;
  const auto theta = two.parts.inertia();
  REQUIRE(theta);
  const auto g = Gyrostat<double>::make(*theta, two.parts.axis, 0.45, two.slope, two.no_load_rate).value();

  const Quat<double> q{0.5, 0.5, -0.5, 0.5};
  const Vec3<double> Omega(0.3, -0.7, 0.5);
  const State<double> start = g.state(q, Omega, -1);
  TwoBodies::Numbers y{q.w, q.x, q.y, q.z, Omega[0], Omega[1], Omega[2], -1, 0};
  const Vec3<double> d = rotate<double>(q, two.parts.offset);
  const Vec3<double> v = rotate<double>(q, cross<double>(Omega, two.parts.offset));
  for (std::size_t i = 0; i < 3; ++i) {
    const double mass = two.parts.carrier_mass + two.parts.rotor_mass, drift = 0.1 * double(i);
    const int j = static_cast<int>(i);
    y[9 + i] = -two.parts.rotor_mass / mass * d[j];
    y[12 + i] = two.parts.carrier_mass / mass * d[j];
    y[15 + i] = drift - two.parts.rotor_mass / mass * v[j];
    y[18 + i] = drift + two.parts.carrier_mass / mass * v[j];
  }
  ode::StepControl<double, 21> control;
  control.relative = 1e-13;
  control.absolute = ode::uniform<double, 21>(1e-14);
  ode::RungeKutta<double, 21, TwoBodies> joint(two, 0.0, y, control);
  Follower<double> motion(g, start, 1e-16);
  for (const double t : {1.0, 5.0, 12.0, 20.0}) {
    REQUIRE(joint.advance(t) == Status::reached);
    const auto& z = joint.state();
    const State<double> s = motion.at(t);
    const Vec3<double> rate = g.angular_velocity(s.momentum, s.axial_momentum);
    CHECK(angle_between(normalised(Quat<double>{z[0], z[1], z[2], z[3]}), s.attitude) < 2e-11);
    CHECK((rate - Vec3<double>(z[4], z[5], z[6])).norm() < 2e-11);
    CHECK(z[7] == Approx(g.rotor_rate(s.axial_momentum, rate)).margin(2e-11));
    CHECK(z[8] == Approx(s.rotor_angle).margin(2e-10));
    // the joint held, so the simulation is a fair witness
    const Vec3<double> arm = rotate<double>(s.attitude, two.parts.offset);
    for (std::size_t i = 0; i < 3; ++i) CHECK(z[12 + i] - z[9 + i] == Approx(arm[static_cast<int>(i)]).margin(2e-10));
  }
}

TEST_CASE("V falls by what the motor takes, and L stays") {
  Bodies bodies(2);
  for (int i = 0; i < 20; ++i) {
    const auto g = bodies.realisable();
    const auto s = bodies.start(g);
    const double V0 = g.lyapunov(s.momentum, s.axial_momentum);
    const Vec3<double> L = inertial(s);
    Follower<double> plain(g, s, 1e-16, false), motion(g, s, 1e-16);
    double last = V0;
    for (int k = 1; k <= 40; ++k) {
      const double t = 0.5 * k;
      const State<double> a = plain.at(t), b = motion.at(t);
      // without projection nothing ties the quadrature to the state
      const double V = g.lyapunov(a.momentum, a.axial_momentum);
      CHECK(std::abs(V + plain.dissipated() - V0) < 4e-13 * V0);
      CHECK(g.lyapunov(b.momentum, b.axial_momentum) <= last + 1e-14 * V0);
      last = g.lyapunov(b.momentum, b.axial_momentum);
      CHECK((inertial(b) - L).norm() < 4e-15 * L.norm());
      CHECK(std::abs(norm(b.attitude) - 1) < 4e-16);
      CHECK(distance(a, b) < 1e-10);
      // beta from the law of p, a path without the quadrature
      CHECK(
          b.rotor_angle ==
          Approx(g.no_load_rate() * t - (b.axial_momentum - s.axial_momentum) / g.slope()).epsilon(1e-9).margin(1e-9));
    }
  }
}

TEST_CASE("a motion without motor runs back") {
  const auto g = body<double>(0.0);
  const State<double> start = tumbling(g);
  Follower<double> forth(g, start, 1e-16);
  State<double> end = forth.at(300);
  CHECK(distance(end, start) > 0.1);
  const double turned = end.rotor_angle;
  end.momentum *= -1;
  end.axial_momentum *= -1;
  end.rotor_angle = 0;
  Follower<double> back(g, end, 1e-16);
  State<double> again = back.at(300);
  again.momentum *= -1;
  again.axial_momentum *= -1;
  CHECK(again.rotor_angle == Approx(-turned).epsilon(1e-12));
  again.rotor_angle = 0;
  CHECK(distance(again, start) < 2e-11);
}

TEST_CASE("a vanishing rotor leaves the rigid body") {
  // Euler's equations
  const auto rigid = [](double, const std::array<double, 7>& y, std::array<double, 7>& rate) noexcept {
    static const Mat3<double> inverse = body<double>().inverse_inertia();
    const Vec3<double> H(y[4], y[5], y[6]);
    const Vec3<double> Omega = inverse * H, dH = cross<double>(H, Omega);
    const Quat<double> dq = quaternion_rate<double>({y[0], y[1], y[2], y[3]}, Omega);
    rate = {dq.w, dq.x, dq.y, dq.z, dH[0], dH[1], dH[2]};
  };
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const double lambda = i == 0 ? 1e-5 : 1e-7;
    const auto g = body<double>(0.01 * lambda, 3, lambda);
    const State<double> start = tumbling(g);
    const Quat<double>& q = start.attitude;
    const Vec3<double> H = body<double>().inertia() * Vec3<double>(1.1, -1.3, 2.2);
    ode::StepControl<double, 7> control;
    control.relative = 1e-13;
    control.absolute = ode::uniform<double, 7>(1e-13);
    ode::RungeKutta<double, 7, decltype(rigid)> euler(rigid, 0.0, {q.w, q.x, q.y, q.z, H[0], H[1], H[2]}, control);
    REQUIRE(euler.advance(10) == Status::reached);
    Follower<double> motion(g, start, 1e-16);
    const auto& y = euler.state();
    errors[i] = angle_between(motion.at(10).attitude, normalised(Quat<double>{y[0], y[1], y[2], y[3]}));
  }
  CHECK(errors[1] < 1e-5);
  CHECK(std::log10(errors[0] / errors[1]) == Approx(2).margin(0.1));  // in proportion to lambda
}

TEST_CASE("the choice of body axes does not matter") {
  Bodies bodies(3);
  for (int i = 0; i < 20; ++i) {
    const auto g = bodies.realisable();
    const auto s = bodies.start(g);
    Mat3<double> Q = to_matrix(bodies.attitude());
    if (i % 2 == 0) Q << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // a permutation of the axes
    const Quat<double> q = from_matrix<double>(Q);
    const Mat3<double> theta = Q * g.inertia() * Q.transpose();
    const auto turned = Gyrostat<double>::make((theta + theta.transpose()) / 2, Q * g.axis(), g.axial_inertia(),
                                               g.slope(), g.no_load_rate())
                            .value();
    Follower<double> a(g, s, 1e-16);
    Follower<double> b(turned, {s.attitude * conjugate(q), Q * s.momentum, s.axial_momentum, 0}, 1e-16);
    const State<double> x = a.at(10), y = b.at(10);
    CHECK(distance(x, {y.attitude * q, Q.transpose() * y.momentum, y.axial_momentum, y.rotor_angle}) < 2e-11);
  }
}

TEST_CASE("at rest, without momentum, and without numbers") {
  auto g = body<double>(0.2, 0);
  Follower<double> rest(g, g.state({}, {0, 0, 0}, 0), 1e-16);
  CHECK(distance(rest.at(1e6), {}) < 4e-16);

  // L = 0: omega relaxes exponentially and the body turns about J e
  g = body<double>(0.05, 30);
  Follower<double> from_rest(g, g.state({}, {0, 0, 0}, 0), 1e-16);
  const double t = 20;
  const State<double> s = from_rest.at(t);
  CHECK(s.momentum.isZero(0));
  const double r = g.relaxation_rate();
  const double beta = 30 * (t + std::expm1(-r * t) / r);
  const Vec3<double> n = -g.axial_inertia() * (g.inverse_inertia() * g.axis());
  CHECK(s.rotor_angle == Approx(beta).epsilon(1e-14));
  const Vec3<double> along = n.normalized();
  const double half = beta * n.norm() / 2;
  CHECK(angle_between<double>(s.attitude, {std::cos(half), along[0] * std::sin(half), along[1] * std::sin(half),
                                           along[2] * std::sin(half)}) < 1e-12);

  State<double> bad = tumbling(g);
  bad.momentum[1] = gyrostat::nan<double>;
  const FullSystem<double> system(g, bad);
  ode::TaylorOptions<double, 12> options;
  options.scale.fill(1);
  ode::Taylor<FullSystem<double>> solver(system, 0, system.start(), options);
  CHECK(solver.advance(1) == Status::not_finite);
}

TEST_CASE("steps need no memory") {
  const auto g = body<double>();
  Follower<double> motion(g, tumbling(g), 1e-16);
  const auto before = allocations();
  const Status status = motion.solver().advance(100);
  CHECK(allocations() == before);
  CHECK(status == Status::reached);
}

namespace {

/// The end of a tumbling motion against one in long double, at order 24 and 28 alike to 2e-12. R = diag(2.3, 2.9, 3.4), a weak motor.
void check_turns(double end, const Quat<double>& truth, double bound) {
  const Vec3<double> e = Vec3<double>(0.36, 0.48, 0.8).normalized();
  const double lambda = 0.45;
  const Mat3<double> theta = Mat3<double>(Vec3<double>(2.3, 2.9, 3.4).asDiagonal()) + lambda * e * e.transpose();
  const auto g = Gyrostat<double>::make((theta + theta.transpose()) / 2, e, lambda, 2.7e-6, 30).value();
  State<double> start;
  start.momentum = 8 * Vec3<double>(0.3, -0.5, 0.8).normalized();
  start.axial_momentum = lambda * e.dot(g.inverse_inertia() * start.momentum);
  Follower<double> motion(g, start, 1e-16);
  const Vec3<double> L = inertial(start);
  double last = g.lyapunov(start.momentum, start.axial_momentum), worst_norm = 0, worst_L = 0, rise = 0;
  State<double> s;
  for (int i = 1; i <= 100; ++i) {
    s = motion.at(end * i / 100);
    worst_norm = std::max(worst_norm, std::abs(norm(s.attitude) - 1));
    worst_L = std::max(worst_L, (inertial(s) - L).norm() / L.norm());
    const double lyapunov = g.lyapunov(s.momentum, s.axial_momentum);
    rise = std::max(rise, lyapunov - last);
    last = lyapunov;
  }
  CHECK(worst_norm < 4e-16);
  CHECK(worst_L < 3e-15);
  CHECK(rise <= 0);
  CHECK(angle_between(s.attitude, truth) < bound);
}

}  // namespace

TEST_CASE("ten thousand turns") {
  check_turns(2.1e4, {-0.42232385771610975, -0.76488833594118573, 0.012790450226979322, -0.48623533101564931}, 2e-10);
}
TEST_CASE("a hundred thousand turns", "[.long]") {
  check_turns(2.1e5, {-0.7307974244156757, -0.0060289225606136, -0.27269759775278590, 0.6257274140870230}, 4e-9);
}

TEST_CASE("a rotor that was far from no load leaves the body its energy") {
  // at first V is a million times the energy of the body
  const auto end = []<Real S>(S tolerance) {
    Mat3<S> theta;
    theta << S(3.161L), S(0.2833L), S(-0.0108L), S(0.2833L), S(2.1726L), S(1.4538L), S(-0.0108L), S(1.4538L),
        S(2.0604L);
    const Vec3<S> e = Vec3<S>(S(-0.1485L), S(-0.9456L), S(0.2894L)).normalized();
    const auto g = Gyrostat<S>::make(theta, e, S(0.001936L), S(0.00035L), 49842).value();
    const auto start = g.state({1, 0, 0, 0}, {S(1.69L), S(3.07L), S(2.74L)}, 0);
    Follower<S, std::is_same_v<S, double> ? 20 : 28> motion(g, start, tolerance);
    const auto s = motion.at(144);
    return Quat<double>{double(s.attitude.w), double(s.attitude.x), double(s.attitude.y), double(s.attitude.z)};
  };
  CHECK(angle_between(end(1e-14), end(1e-19L)) < 5e-11);
}
