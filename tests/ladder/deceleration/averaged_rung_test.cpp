// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/averaged_rung.hpp"

#include "reference_table.hpp"
#include "scenes.hpp"

using namespace scenes;

namespace {

/// Slope of the error over eps from the first to the last.
double slope(const std::vector<double>& eps, const std::vector<double>& error) {
  return std::log(error.front() / error.back()) / std::log(eps.front() / eps.back());
}

struct Seen {
  std::vector<double> norm, k2, vector;
};

/// True errors of a model over the eps, at 40 times up to where half of the momentum is gone.
Seen errors_of(int model, const std::vector<double>& eps, const V& b, const V& M) {
  Seen e;
  for (const double x : eps) {
    Case c(x, .55 / x);
    c.data.control = x * b;
    c.data.momentum = M;
    c.data.times = until(.55 / x, 40);
    const Answer truth = c.truth(1e-12), answer = c.with(model, 1e-5).solve();
    check_honest(answer, truth);
    e.norm.push_back(distance(answer, truth, "angular_momentum_norm"));
    e.k2.push_back(distance(answer, truth, "modulus_squared"));
    if (model == rung::averaged_2) e.vector.push_back(distance(answer, truth, "angular_momentum"));
  }
  return e;
}

}  // namespace

TEST_CASE("averaged rung: orders without rotor, in both regimes", "[deceleration]") {
  const std::vector<double> eps{6e-4, 3e-4, 1.5e-4};
  struct Start {
    V b, M;
  };
  for (const Start& s :
       {Start{V(.6, .9, 1), V(.8, .5, .33).normalized()}, Start{V(1, .9, .6), V(.4, .5, .8).normalized()}}) {
    CAPTURE(s.b.transpose(), s.M.transpose());
    const Seen first = errors_of(rung::averaged, eps, s.b, s.M);
    CHECK(slope(eps, first.norm) == Approx(1).margin(.15));
    CHECK(slope(eps, first.k2) == Approx(1).margin(.15));
    const Seen second = errors_of(rung::averaged_2, eps, s.b, s.M);
    CHECK(slope(eps, second.norm) == Approx(2).margin(.15));
    CHECK(slope(eps, second.k2) == Approx(2).margin(.15));
    CHECK(slope(eps, second.vector) == Approx(1).margin(.15));
    CHECK(second.norm.back() < first.norm.back() / 50);
  }
}

TEST_CASE("averaged rung: the reference cases through the ladder", "[deceleration]") {
  for (auto c : reference::cases()) {
    if (c.has_rotor()) continue;
    CAPTURE(c.id);
    c.data.rung = rung::averaged;
    c.data.tolerance = 1e-9;
    Refusal refusal;
    const Answer answer = deceleration::solve<>(c.scene(), refusal);
    REQUIRE(refusal.code == Errc::ok);
    for (std::size_t i = 0; i < c.norm.size(); ++i) {
      CHECK(answer.find("angular_momentum_norm")->values[i] == Approx(c.norm[i]).epsilon(1e-9));
      CHECK(answer.find("modulus_squared")->values[i] == Approx(c.k2[i]).epsilon(1e-9));
      CHECK(answer.find("energy")->values[i] == Approx(c.energy[i]).epsilon(1e-9));
    }
    CHECK(answer.find("angular_momentum") == nullptr);  // first order does not know the phase
    if (!std::isnan(c.averaged_stop)) CHECK(quantity(answer, "stop_time") == Approx(c.averaged_stop).epsilon(1e-9));
    // and the truth lies within the errors
    double norm = 0;
    for (std::size_t i = 0; i < c.norm.size(); ++i)
      norm = std::max(norm, std::abs(answer.find("angular_momentum_norm")->values[i] - c.full_norm[i]));
    CHECK(norm <= answer.find("angular_momentum_norm")->error * c.full_norm[0]);
    if (!std::isnan(c.full_stop)) CHECK(std::abs(quantity(answer, "stop_time") / c.full_stop - 1) <= answer.error);
  }
}

TEST_CASE("averaged-2 rung: M itself, against the reference in quadruple precision", "[deceleration]") {
  for (auto c : reference::cases()) {
    if (c.has_rotor() || c.id == "P05") continue;
    CAPTURE(c.id);
    c.data.rung = rung::averaged_2;
    c.data.tolerance = 1e-6;
    Refusal refusal;
    const Answer answer = deceleration::solve<>(c.scene(), refusal);
    if (c.id == "P03") {  // too fast for so fine an answer
      CHECK(refusal.code == Errc::not_applicable);
      continue;
    }
    REQUIRE(refusal.code == Errc::ok);
    double vector = 0, norm = 0, size = 0;
    for (std::size_t i = 0; i < c.norm.size(); ++i) {
      const Eigen::Map<const V> M(&answer.find("angular_momentum")->values[3 * i]);
      vector = std::max(vector, (M - c.full_momentum[i]).norm());
      norm = std::max(norm, std::abs(answer.find("angular_momentum_norm")->values[i] - c.full_norm[i]));
      size = std::max(size, c.full_norm[i]);
    }
    CHECK(vector / size <= answer.find("angular_momentum")->error);
    CHECK(norm / size <= answer.find("angular_momentum_norm")->error);
    CHECK(std::abs(quantity(answer, "stop_time") / c.full_stop - 1) <= answer.error + 1e-8);
  }
}

TEST_CASE("averaged rung: refusals", "[deceleration]") {
  Case c(1e-3, 300);
  Case sphere = c, rest = c;
  sphere.moments = V(1, 1, 1);
  rest.data.momentum.setZero();
  for (const Case* bad : {&sphere, &rest}) {
    const Track first = averaged_track<math::Native>(bad->scene());
    const Track second = averaged_2_track<math::Native>(bad->scene(), nullptr);
    CHECK(first.failure == Errc::not_applicable);
    CHECK(second.failure == Errc::not_applicable);
    CHECK(first.refusal != nullptr);
    CHECK(second.refusal != nullptr);
  }
  CHECK(averaged_2_track<math::Native>(Case(.3, 2).scene(), nullptr).failure == Errc::not_applicable);
}

TEST_CASE("averaged rung: gives up early where the start already misses the tolerance", "[deceleration]") {
  Case c(1e-3, 300);
  c.data.tolerance = 1e-9;
  const Track track = averaged_track<math::Native>(c.scene());
  CHECK(track.failure == Errc::not_applicable);
  CHECK(track.known_error > 1e-5);
  CHECK(track.counts.rhs < 50);
}

TEST_CASE("averaged-2 rung: on a separatrix but for the rounding of a tensor the phase is not known",
          "[deceleration]") {
  Mat3<double> J;
  J << 2501.1470341335594, 262.82141347399829, 412.82486097680624, 262.82141347399829, 2087.8904955235985,
      443.76848990818837, 412.82486097680624, 443.76848990818837, 1624.8050419003171;
  Asked data;
  data.momentum = V(1881.5431496343533, -478.60845241972555, -607.46222977614866);
  data.times = until(643.56563054450805, 12);
  data.rung = rung::averaged_2;
  data.tolerance = 1e-4;
  Refusal refusal;
  const Answer answer = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK_FALSE(answer.met);
  CHECK(answer.find("angular_momentum")->error > 7.5e-3);  // which its M is off by
}

TEST_CASE("averaged rungs: next to the unstable rotation the body stays for many turns: none answers",
          "[deceleration]") {
  for (const double off : {1e-17, 1e-13, 1e-9}) {
    Case c(1e-3, 60);
    c.data.momentum = V(off, 1, -off);
    for (const int by : {rung::averaged, rung::averaged_2}) {
      c.data.rung = by;
      Refusal refusal;
      c.solve(refusal);
      CHECK(refusal.code == Errc::separatrix);
    }
    c.data.rung = any_rung;
    CHECK(std::strcmp(c.solve().model, "full") == 0);
  }
}

TEST_CASE("averaged-2 rung: the energy of a body that its rotors nearly hold is off by the rounding of theirs",
          "[deceleration]") {
  Case c(1e-6, .8);
  c.data.rotor_momentum = V(-200, 310, 120);
  c.data.momentum = c.data.rotor_momentum + 1e-3 * V(.8, .5, .33);
  c.data.control = 1e-6 * V(1, .5, .7);
  c.data.drag = 0;
  c.data.rung = rung::averaged_2;
  c.data.tolerance = 1e-9;
  const double energy = (1e-6 * V(.8, .5, .33).cwiseAbs2().cwiseQuotient(c.moments)).sum() / 2;
  const double held = c.data.rotor_momentum.cwiseAbs2().cwiseQuotient(c.moments).sum();
  Refusal refusal;
  const Answer answer = c.solve(refusal);
  REQUIRE(refusal.code == Errc::ok);
  CHECK(answer.find("energy")->error > 2 * epsilon<double> * held / energy);
}
