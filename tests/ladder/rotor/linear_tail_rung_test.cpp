// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/linear_tail_rung.hpp"

#include <cstring>
#include <string>

#include "../../models/rotor/bodies.hpp"
#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using V = Vec3<double>;

/// theta = diag(3, 5, 7), lambda = 0.5, S = 4, omega* = 1 with l = 7: one well, decay 0.0048 1/s.
struct Case {
  Gyrostat<double> body =
      Gyrostat<double>::make(V(3, 5, 7).asDiagonal(), V(0.5, 0.5, std::sqrt(0.5)), 0.5, 4, 1).value();
  SteadyRotation<double> steady = steady_rotations(body, 7.)[0];
  Asked data;

  Case(double eps, double last, double tolerance = 1e-6) {
    begin(steady.direction + eps * V(0.6, -0.7, 0.2), 1 + eps);
    data.attitude = normalised(Quat<double>{1, 2, -1, 0.5});
    for (int i = 0; i <= 40; ++i) data.times.push_back(last * i / 40);
    data.tolerance = tolerance;
  }
  void begin(const V& direction, double rate) {
    data.rotor_rate = rate;
    data.angular_velocity =
        body.inverse_inertia() * (7 * direction.normalized() - body.axial_inertia() * rate * body.axis());
  }
  Scene scene() const {
    const auto made = make_scene(body, data);
    REQUIRE(made);
    return *made;
  }
  Track run(Monitor* monitor = nullptr) const { return linear_tail_track(scene(), monitor); }
  Track truth() const {
    Case fine = *this;
    fine.data.tolerance = 1e-12;
    return full_track(fine.scene(), nullptr);
  }
  std::string why() const {
    const Track track = run();
    CHECK(track.failure == Errc::not_applicable);
    return track.refusal;
  }
};

void check_tail(const Case& c, const Track& track) {
  REQUIRE(track.failure == Errc::ok);
  REQUIRE(track.states.size() == c.data.times.size());
  const Track truth = c.truth();
  Comparison seen{Row<double>(c.body)};
  for (std::size_t i = 0; i < truth.states.size(); ++i) seen.add(truth.states[i], track.states[i]);
  const auto found = seen.relative(seen.difference());
  CHECK(found[column::attitude] <= track.error[column::attitude] + truth.error[column::attitude]);
  CHECK(found[column::angular_velocity] <=
        track.error[column::angular_velocity] + truth.error[column::angular_velocity]);
  CHECK(found[column::angular_momentum] <=
        track.error[column::angular_momentum] + truth.error[column::angular_momentum]);
  CHECK(found[column::rotor_rate] <= track.error[column::rotor_rate] + truth.error[column::rotor_rate]);
  CHECK(found[column::rotor_angle] <= track.error[column::rotor_angle] + truth.error[column::rotor_angle]);
  CHECK(found[column::lyapunov] <= track.error[column::lyapunov] + truth.error[column::lyapunov]);
}

}  // namespace

TEST_CASE("linear-tail rung: near a steady rotation it answers without a step", "[rotor]") {
  for (const double eps : {1e-6, 1e-4, 1e-3}) {
    const Case c(eps, 2000);
    const Track track = c.run();
    check_tail(c, track);
    CHECK(track.error.greatest() < 1e-6);
    CHECK(track.counts.steps == 0);
    CHECK(track.warnings.empty());
  }
}

TEST_CASE("linear-tail rung: from far away the full equations lead to it", "[rotor]") {
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    Case c(0, 30000, tolerance);
    c.begin(V(1, -0.3, -0.2), -2);
    const Track track = c.run();
    check_tail(c, track);
    CHECK(track.error.greatest() <= tolerance);
    REQUIRE(track.warnings.size() == 1);
    CHECK(track.warnings[0].code() == "hand-over");
    CHECK(track.warnings[0].value < 7500);
    CHECK(track.counts.steps > 0);
    CHECK(track.counts.steps < c.truth().counts.steps);
  }
}

TEST_CASE("linear-tail rung: random bodies, within the stated errors", "[rotor]") {
  Bodies bodies(21);
  int answered = 0;
  for (int i = 0; i < 200; ++i) {
    Case c(0, 1, bodies.scale(1e-9, 1e-3));
    c.body = bodies.realisable();
    const auto start = bodies.start(c.body);
    c.data.angular_velocity = c.body.angular_velocity(start.momentum, start.axial_momentum);
    c.data.rotor_rate = c.body.rotor_rate(start.axial_momentum, c.data.angular_velocity);
    const rotor::detail::ExponentialAttractors attractors(c.body, start.momentum.norm());
    if (attractors.count == 0) continue;
    const double last = 100 / attractors.stability[0].decay_rate;
    if (last * start.momentum.norm() > 2e4) continue;
    for (double& t : c.data.times) t *= last;
    const Track track = c.run();
    if (track.failure != Errc::ok) continue;
    ++answered;
    CAPTURE(i, c.data.tolerance);
    check_tail(c, track);
    CHECK(track.error.greatest() <= c.data.tolerance);
  }
  CHECK(answered > 4);
}

TEST_CASE("linear-tail rung: says why it does not apply", "[rotor]") {
  Case rest(0, 100);
  rest.data.angular_velocity.setZero();
  rest.data.rotor_rate = 0;
  CHECK(rest.why().find("no angular momentum") != std::string::npos);

  Case free(1e-3, 100);
  free.body = Gyrostat<double>::make(free.body.inertia(), free.body.axis(), 0.5, 0, 1).value();
  CHECK(free.why().find("no slope") != std::string::npos);

  // the rotor on the axis of the greatest moment: the nutation decays algebraically
  Case marginal(0, 100);
  marginal.body = Gyrostat<double>::make(V(3, 5, 7).asDiagonal(), V(0, 0, 1), 0.5, 4, 1).value();
  marginal.begin(V(0.1, 0.1, 1), 1);
  CHECK(marginal.why().find("attracts exponentially") != std::string::npos);

  Case far(0, 100);
  far.begin(V(1, -0.3, -0.2), -2);
  CHECK(far.why().find("too far") != std::string::npos);
}

TEST_CASE("linear-tail rung: asked for by name it answers over the tolerance, and outside its domain says so",
          "[rotor]") {
  Case over(3e-2, 50, 1e-9);
  over.data.rung = rung::linear_tail;
  Track track = over.run();
  check_tail(over, track);
  CHECK(track.error.greatest() > 1e-9);
  CHECK(track.in_domain);

  Case outside(0.3, 50);
  outside.data.rung = rung::linear_tail;
  track = outside.run();
  CHECK(track.failure == Errc::ok);
  CHECK_FALSE(track.in_domain);
  CHECK(track.states.size() == outside.data.times.size());
  REQUIRE(track.warnings.size() == 1);
  CHECK(track.warnings[0].code() == "beyond-validity");
}

TEST_CASE("linear-tail rung: the caller can stop it", "[rotor]") {
  Case c(0, 300000, 1e-8);
  c.begin(V(1, -0.3, -0.2), -2);
  Monitor monitor;
  monitor.cancel = true;
  CHECK(c.run(&monitor).failure == Errc::cancelled);
}
