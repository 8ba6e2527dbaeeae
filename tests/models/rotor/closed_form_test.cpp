// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/closed_form.hpp"

#include <cstring>

#include "allocations.hpp"
#include "bodies.hpp"
#include "catch.hpp"
#include "closed_form_cases.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using V = Vec3<double>;
using M = Mat3<double>;
using Q = Quat<double>;
using Kind = ClosedFormKind;

struct Start {
  Gyrostat<double> body;
  Q attitude{};
  V Omega{0, 0, 0};
  double omega = 0;
  State<double> state() const { return body.state(attitude, Omega, omega); }
};

Gyrostat<double> body_of(const M& theta, const V& e, double lambda, double S, double target) {
  const auto body = Gyrostat<double>::make((theta + theta.transpose()) / 2, e, lambda, S, target);
  REQUIRE(body);
  return *body;
}

/// The errors of the closed form at the times, and what it says itself.
struct Measured {
  ClosedFormError<double> error, bound;
};

Measured measure(const Start& start, const std::vector<double>& times) {
  const ClosedForm<double> form(start.body, start.state());
  const auto truth = LongMotion::from(start.body, start.attitude, start.Omega, start.omega, times);
  Measured m;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto here = form.at(times[i]);
    const auto rate = [&](const State<double>& s) {
      return start.body.rotor_rate(s.axial_momentum, start.body.angular_velocity(s.momentum, s.axial_momentum));
    };
    m.error.attitude = std::max(m.error.attitude, angle_between(here.attitude, truth[i].attitude));
    m.error.momentum = std::max(m.error.momentum, (here.momentum - truth[i].momentum).norm());
    m.error.rotor_rate = std::max(m.error.rotor_rate, std::abs(rate(here) - rate(truth[i])));
    m.error.rotor_angle = std::max(m.error.rotor_angle, std::abs(here.rotor_angle - truth[i].rotor_angle));
  }
  m.bound = form.error(times.back());
  return m;
}

void check_honest(const Measured& m) {
  CHECK(m.error.attitude <= m.bound.attitude);
  CHECK(m.error.momentum <= m.bound.momentum);
  CHECK(m.error.rotor_rate <= m.bound.rotor_rate);
  CHECK(m.error.rotor_angle <= m.bound.rotor_angle);
}

std::vector<double> times(double last) { return {last * 0.01, last * 0.1, last * 0.35, last * 0.7, last}; }

/// A member of each family in a random orientation: exact but for rounding.
Start member(Kind kind, Bodies& bodies) {
  Start s;
  s.attitude = bodies.attitude();
  const M R = to_matrix(bodies.attitude());
  double j[3] = {bodies.uniform(0.25, 0.3), bodies.uniform(0.3, 0.37), bodies.uniform(0.38, 0.45)};
  const double lambda = bodies.scale(0.05, 1), S = bodies.scale(1e-3, 3), target = bodies.uniform(-8, 8);
  const auto theta = [&] { return M(R * V(1 / j[0], 1 / j[1], 1 / j[2]).asDiagonal() * R.transpose()); };
  const V any = bodies.direction() * bodies.scale(0.1, 2);
  s.omega = bodies.uniform(-8, 8);
  switch (kind) {
    case Kind::none: s = {bodies.realisable(), bodies.attitude(), any, 1}; break;
    case Kind::no_momentum:
      s.body = body_of(theta(), bodies.direction(), lambda, S, target);
      s.omega = 0;
      break;
    case Kind::axisymmetric:
      j[1] = j[0];
      if (bodies.uniform(0, 1) < 0.2) j[2] = j[0];
      s.body = body_of(theta(), R.col(2), lambda, S, target);
      s.Omega = any;
      break;
    case Kind::principal_axis: {
      const int axis = int(bodies.uniform(0, 3));
      s.body = body_of(theta(), R.col(axis), lambda, S, target);
      s.Omega = R.col(axis) * bodies.uniform(-2, 2);
      break;
    }
    case Kind::steady: {
      // any Omega is steady where theta Omega + lambda omega e is parallel to it
      s.omega = target == 0 ? 1 : target;
      s.Omega = any;
      const double psi = bodies.uniform(-1, 1) * any.norm();
      const double l = (theta() * any).norm() + psi;
      const V e = l * any.normalized() - theta() * any;
      s.omega = e.norm() / lambda;
      s.body = body_of(theta(), e.normalized(), lambda, S, s.omega);
      break;
    }
    case Kind::circular_section: {
      const double j1 = j[2], j2 = j[1], j3 = j[0];
      const V e = R * V(std::sqrt(j2 - j3) / j3, 0, std::sqrt(j1 - j2) / j1);
      s.body = body_of(R * V(1 / j3, 1 / j2, 1 / j1).asDiagonal() * R.transpose(), e.normalized(), lambda, S, target);
      const V c = (s.body.inverse_inertia() * s.body.axis()).normalized();
      V m = bodies.direction();
      m = (m - m.dot(c) * c).normalized();
      const V H = m * bodies.scale(1, 10);
      s.omega = target;
      s.Omega = s.body.inverse_inertia() * (H - lambda * target * s.body.axis());
      break;
    }
  }
  return s;
}

}  // namespace

TEST_CASE("closed forms meet the reference cases", "[rotor]") {
  for (const auto& c : closed_form_cases) {
    const V e(c.axis[0], c.axis[1], c.axis[2]);
    const auto body = body_of(Eigen::Map<const M>(c.inertia), e / e.norm(), c.axial_inertia, c.slope, c.no_load_rate);
    const Q q0 = normalised(Q{c.attitude[0], c.attitude[1], c.attitude[2], c.attitude[3]});
    const ClosedForm<double> form(body, body.state(q0, V(c.Omega[0], c.Omega[1], c.Omega[2]), c.omega));
    CAPTURE(c.id);
    const bool rest = std::strcmp(c.id, "pub01") == 0, symmetric = std::strcmp(c.id, "pub05") == 0;
    CHECK(form.kind() == (rest ? Kind::no_momentum : symmetric ? Kind::axisymmetric : Kind::circular_section));
    for (const auto& truth : c.at) {
      const auto s = form.at(truth.t);
      const V Omega = body.angular_velocity(s.momentum, s.axial_momentum);
      const auto bound = form.error(truth.t);
      const double angle =
          angle_between(s.attitude, Q{truth.attitude[0], truth.attitude[1], truth.attitude[2], truth.attitude[3]});
      CHECK(angle < 2e-13 * (1 + truth.t));
      CHECK(angle <= bound.attitude);
      CHECK((Omega - V(truth.Omega[0], truth.Omega[1], truth.Omega[2])).norm() < 1e-13 * (1 + truth.t));
      CHECK(std::abs(body.rotor_rate(s.axial_momentum, Omega) - truth.omega) <= bound.rotor_rate);
      CHECK(std::abs(body.rotor_rate(s.axial_momentum, Omega) - truth.omega) < 1e-13 * 30);
      CHECK(std::abs(s.rotor_angle - truth.angle) < 1e-13 * (30 + truth.angle));
      CHECK((s.momentum - V(truth.H[0], truth.H[1], truth.H[2])).norm() <= bound.momentum);
      CHECK(std::abs(s.axial_momentum - truth.p) < 1e-13 * 10);
    }
    CHECK(form.error(200).attitude < 1e-10);
  }
}

TEST_CASE("closed forms of every family agree with the full equations, within their own bounds", "[rotor]") {
  Bodies bodies(7);
  for (const Kind kind :
       {Kind::no_momentum, Kind::axisymmetric, Kind::principal_axis, Kind::steady, Kind::circular_section}) {
    int useful = 0;
    for (int i = 0; i < 40; ++i) {
      const Start start = member(kind, bodies);
      const ClosedForm<double> form(start.body, start.state());
      CAPTURE(int(kind), i);
      CHECK(form.kind() == kind);
      CHECK(form.defect() < 1e-13);
      const auto m = measure(start, times(bodies.scale(1, 60)));
      check_honest(m);
      useful += m.bound.attitude < 1e-9;
    }
    CHECK(useful > 20);  // the others are unstable
  }
}

TEST_CASE("a body or a start a little off the family: the bound grows with the departure", "[rotor]") {
  Bodies bodies(8);
  int finite = 0;
  for (int i = 0; i < 240; ++i) {
    const Kind kind =
        std::array{Kind::axisymmetric, Kind::principal_axis, Kind::steady, Kind::circular_section}[std::size_t(i % 4)];
    Start start = member(kind, bodies);
    const double size = bodies.scale(1e-13, 2e-7);
    const V d = bodies.direction(), f = bodies.direction();
    const M theta = start.body.inertia() + size * (d * d.transpose());
    start.body = body_of(theta, (start.body.axis() + size * f).normalized(), start.body.axial_inertia(),
                         start.body.slope(), start.body.no_load_rate());
    start.Omega += size * bodies.direction();
    if (i % 8 < 4) start.omega += size;
    const ClosedForm<double> form(start.body, start.state());
    CAPTURE(int(kind), i, size);
    if (form.kind() == Kind::none) {
      CHECK(form.defect() > ClosedForm<double>::greatest_defect);
      continue;
    }
    const auto m = measure(start, times(bodies.scale(1, 100)));
    check_honest(m);
    finite += m.bound.attitude < infinity<double>;
  }
  CHECK(finite > 120);
}

TEST_CASE("a start a little off a steady rotation: the bound knows in which direction", "[rotor]") {
  Bodies bodies(12);
  std::vector<double> attitude, rate;
  for (int i = 0; i < 120; ++i) {
    Start start = member(Kind::steady, bodies);
    const double size = bodies.scale(1e-10, 1e-7);
    start.Omega += size * bodies.direction();
    start.omega += size * bodies.uniform(-1, 1);
    if (ClosedForm<double>(start.body, start.state()).kind() != Kind::steady) continue;
    CAPTURE(i, size);
    const auto m = measure(start, times(bodies.scale(1, 100)));
    check_honest(m);
    if (!(m.bound.attitude < infinity<double>)) continue;
    attitude.push_back(m.bound.attitude / m.error.attitude);
    rate.push_back(m.bound.rotor_rate / m.error.rotor_rate);
  }
  CHECK(attitude.size() > 60);
  const auto median = [](std::vector<double>& of) {
    std::nth_element(of.begin(), of.begin() + std::ptrdiff_t(of.size() / 2), of.end());
    return of[of.size() / 2];
  };
  CHECK(median(attitude) < 12);
  CHECK(median(rate) < 12);
}

TEST_CASE("circular section: through, into, and on the border between the two", "[rotor]") {
  // j = (0.5, 0.35, 0.25): n.J v/|n| = sqrt(0.15 0.1)
  const double j1 = 0.5, j2 = 0.35, j3 = 0.25, b = std::sqrt((j1 - j2) * (j2 - j3));
  const V n(std::sqrt(j1 - j2), 0, std::sqrt(j2 - j3));
  const M theta = V(1 / j1, 1 / j2, 1 / j3).asDiagonal();
  const V along = theta * n;
  const V e = along.normalized();
  const double n_norm = n.norm() / along.norm(), lambda = 0.4;
  Bodies bodies(9);
  for (const double ratio : {0.2, 0.9, 1 - 1e-9, 1., 1 + 1e-9, 1.1, 5.})
    for (int i = 0; i < 6; ++i) {
      const double l = 2, target = ratio * l * b / (n_norm * lambda) * (i % 2 ? 1 : -1);
      Start s{body_of(theta, e, lambda, 0.3, target), bodies.attitude()};
      const double phi = bodies.uniform(-3, 3);
      const V H = l * (std::cos(phi) * V(0, 1, 0) + std::sin(phi) * V(n.normalized().cross(V(0, 1, 0))));
      s.omega = target;
      s.Omega = s.body.inverse_inertia() * (H - lambda * target * e);
      const ClosedForm<double> form(s.body, s.state());
      CHECK(form.kind() == Kind::circular_section);
      CAPTURE(ratio, phi);
      const auto m = measure(s, times(30));
      check_honest(m);
      CHECK(m.error.attitude < 1e-10);
      // the exact phase equation, by its difference quotient
      const V c = n.normalized();
      const auto angle = [&](double t) {
        const V H_t = form.at(t).momentum;
        return std::atan2(H_t.dot(c.cross(V(0, 1, 0))), H_t.dot(V(0, 1, 0)));
      };
      const double t = 1.7, step = 1e-5, here = angle(t);
      const double slope = std::remainder(angle(t + step) - angle(t - step), 2 * pi<double>) / (2 * step);
      const double hill = l * c.dot(s.body.inverse_inertia() * c.cross(V(0, 1, 0)));
      CHECK(std::abs(slope - (lambda * target * n_norm - hill * std::sin(here))) < 1e-8);
    }
}

TEST_CASE("closed forms: no motor, and a motor that holds its rate", "[rotor]") {
  Bodies bodies(10);
  for (int i = 0; i < 30; ++i) {
    // without slope any rotor rate serves for the steady rotation and the circular section
    for (const Kind kind : {Kind::steady, Kind::circular_section, Kind::axisymmetric}) {
      Start s = member(kind, bodies);
      s.body = body_of(s.body.inertia(), s.body.axis(), s.body.axial_inertia(), 0, 77);
      const ClosedForm<double> form(s.body, s.state());
      CHECK(form.kind() == kind);
      check_honest(measure(s, times(10)));
      CHECK(std::abs(form.at(10).rotor_angle - 10 * s.omega) < 1e-12 * (1 + std::abs(10 * s.omega)));
    }
  }
}

TEST_CASE("closed forms: nothing there, nothing claimed", "[rotor]") {
  Bodies bodies(11);
  for (int i = 0; i < 200; ++i) {
    const Start s = member(Kind::none, bodies);
    const ClosedForm<double> form(s.body, s.state());
    CHECK(form.kind() == Kind::none);
    CHECK(form.defect() > ClosedForm<double>::greatest_defect);
  }
  auto bad = bodies.start(bodies.realisable());
  bad.momentum[1] = gyrostat::nan<double>;
  const ClosedForm<double> form(bodies.realisable(), bad);
  CHECK(form.kind() == Kind::none);
  CHECK(form.defect() == infinity<double>);
}

TEST_CASE("closed forms: an instability multiplies rounding, unless the data rule it out", "[rotor]") {
  const M theta = V(3, 4, 5).asDiagonal();
  // about the middle axis
  const Start exact{body_of(theta, V(0, 1, 0), 0.3, 0.5, 0), {}, V(0, 2, 0), 0};
  const ClosedForm<double> fixed(exact.body, exact.state());
  CHECK(fixed.kind() == Kind::principal_axis);
  CHECK(fixed.exact());
  CHECK(fixed.error(1e4).attitude < 1e-9);
  const M R = to_matrix(normalised(Q{1, .3, -.2, .5}));
  const Start tilted{body_of(R * theta * R.transpose(), R.col(1), 0.3, 0.5, 0), {}, R.col(1) * 2, 0};
  const ClosedForm<double> same(tilted.body, tilted.state());
  CHECK(same.kind() == Kind::principal_axis);
  CHECK_FALSE(same.exact());
  CHECK(same.error(1).attitude < 1e-13);
  CHECK(same.error(20).attitude > 1e3 * same.error(1).attitude);
  CHECK(same.error(200).attitude == infinity<double>);
}

TEST_CASE("closed forms ask for no memory", "[rotor]") {
  Bodies bodies(12);
  for (const Kind kind :
       {Kind::no_momentum, Kind::axisymmetric, Kind::principal_axis, Kind::steady, Kind::circular_section}) {
    const Start s = member(kind, bodies);
    const auto start = s.state();
    const std::size_t before = allocations();
    const ClosedForm<double> form(s.body, start);
    const double sum = form.at(3).rotor_angle + form.error(3).attitude;
    CHECK(allocations() == before);
    CHECK(sum == sum);
  }
}

TEST_CASE("closed forms: relaxation without cancellation", "[rotor]") {
  for (const double z : {1e-300, 1e-12, 1e-3, 0.5, 0.999, 1.001, 3., 50., 1e5}) {
    long double truth;
    if (z > 0.1) {
      truth = 1 + std::expm1(-static_cast<long double>(z)) / static_cast<long double>(z);
    } else {
      const long double x = z;
      truth = x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6 * (1 - x / 7 * (1 - x / 8 * (1 - x / 9)))))));
    }
    CHECK(std::abs(rotor::detail::relaxed_share(z) - truth) < 4e-16L * truth);
  }
  CHECK(rotor::detail::relaxed_share(0.) == 0);
}

TEMPLATE_TEST_CASE("closed forms in every scalar", "[rotor]", float, double, long double) {
  using S = TestType;
  const auto body = Gyrostat<S>::make(Vec3<S>(4, 4, S(5.5)).asDiagonal(), Vec3<S>(0, 0, 1), S(0.6), S(0.5), 12);
  REQUIRE(body);
  const ClosedForm<S> form(*body, body->state({}, Vec3<S>(S(0.9), S(-0.4), S(0.7)), S(1.5)));
  CHECK(form.kind() == Kind::axisymmetric);
  const auto s = form.at(3);
  CHECK(std::abs(s.momentum.norm() - form.at(0).momentum.norm()) < 40 * epsilon<S>);
  CHECK((rotate(s.attitude, s.momentum) - form.at(0).momentum).norm() < 100 * epsilon<S>);
  CHECK(form.error(3).attitude < 2000 * epsilon<S>);
}
