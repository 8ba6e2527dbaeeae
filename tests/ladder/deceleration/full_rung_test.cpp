// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/full_rung.hpp"

#include "gyrostat/rotation/exp_log.hpp"
#include "reference_table.hpp"
#include "scenes.hpp"

using namespace scenes;

TEST_CASE("full rung: the reference cases, within the stated error", "[deceleration]") {
  for (auto c : reference::cases()) {
    CAPTURE(c.id);
    for (const double tolerance : {1e-5, 1e-9}) {
      c.data.rung = rung::full;
      c.data.tolerance = tolerance;
      Refusal refusal;
      const Answer answer = deceleration::solve<>(c.scene(), refusal);
      REQUIRE(refusal.code == Errc::ok);
      double vector = 0, norm = 0, energy = 0, size = 0, most = 0;
      for (std::size_t i = 0; i < c.norm.size(); ++i) {
        const Eigen::Map<const V> M(&answer.find("angular_momentum")->values[3 * i]);
        vector = std::max(vector, (M - c.full_momentum[i]).norm());
        norm = std::max(norm, std::abs(answer.find("angular_momentum_norm")->values[i] - c.full_norm[i]));
        energy = std::max(energy, std::abs(answer.find("energy")->values[i] - c.full_energy[i]));
        size = std::max(size, c.full_norm[i]);
        most = std::max(most, c.full_energy[i]);
      }
      CHECK(vector / size <= answer.find("angular_momentum")->error);
      CHECK(norm / size <= answer.find("angular_momentum_norm")->error);
      CHECK(energy / most <= answer.find("energy")->error);
      CHECK(answer.find("angular_momentum")->error <= tolerance);
      if (!std::isnan(c.full_stop) && !std::isnan(quantity(answer, "stop_time")))
        CHECK(quantity(answer, "stop_time") == Approx(c.full_stop).epsilon(answer.error + 3e-8));
    }
  }
}

TEST_CASE("full rung: a free body keeps its momentum in space", "[deceleration]") {
  Case c(1e-3, 60);
  c.data.control.setZero();
  c.data.drag = 0;
  c.data.rotor_momentum = V(.1, -.2, .15);
  c.data.wants_attitude = true;
  c.data.attitude = normalised(Quat<double>{.8, .3, -.2, .4});
  c.moments = V(.7, 1.4, 1);  // the caller's order
  c.data.tolerance = 1e-9;
  const Answer answer = c.solve();
  CHECK(std::strcmp(answer.model, "full") == 0);
  const auto& q = answer.find("attitude")->values;
  const auto& M = answer.find("angular_momentum")->values;
  const V M0 = to_matrix(c.data.attitude) * c.data.momentum;
  for (std::size_t i = 0; i < 6; ++i) {
    const Quat<double> R_IB{q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]};
    const V M_I = to_matrix(R_IB) * V(M[3 * i], M[3 * i + 1], M[3 * i + 2]);
    CHECK((M_I - M0).norm() < 1e-8);
  }
}

TEST_CASE("full rung: a momentum that a tensor makes of omega errs as the greatest moment does", "[deceleration]") {
  const double slight = 1e-6;
  for (const double turn : {.3, .7, 1.1, 2.3}) {
    const Mat3<double> R = to_matrix<double>(quaternion_from_vector<double>(turn * V(.48, -.6, .64)));
    Mat3<double> tensor = R * V(1, 1 - slight / 2, slight).asDiagonal() * R.transpose();
    tensor = ((tensor + tensor.transpose()) / 2).eval();
    const V omega = R.col(2) + 1e-7 * V(1, 1, 1);
    Asked data;
    data.angular_velocity = omega;
    data.momentum = tensor * omega;
    data.times = {1e-2};
    data.rung = rung::full;
    data.asked = {{column::angular_momentum}, {column::angular_momentum_norm}};
    Refusal refusal;
    const Answer answer = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(tensor), data), refusal);
    REQUIRE(refusal.code == Errc::ok);
    const long double exact =
        Vec3<long double>(tensor.cast<long double>() * omega.cast<long double>()).norm();  // it stays
    const Column& norm = *answer.find("angular_momentum_norm");
    CAPTURE(turn, norm.error);
    CHECK(std::abs(double(norm.values[0] / exact - 1)) <= norm.error);
    CHECK(norm.error < 1e-7);
    CHECK(norm.error <= answer.find("angular_momentum")->error);
    // given by itself M is exact
    data.angular_velocity.reset();
    const Answer given = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(tensor), data), refusal);
    CHECK(given.find("angular_momentum_norm")->error < 1e-13);
  }
}

TEST_CASE("full rung: a stop far behind the asked times is said not to be followed", "[deceleration]") {
  Case c(1e-4, 10);
  c.data.tolerance = 1e-9;
  const Answer far = c.solve();
  REQUIRE(std::string_view(far.model) == "full");
  CHECK(far.met);
  REQUIRE(far.warnings.size() == 1);
  CHECK(far.warnings[0].code() == "stop-withheld");
  c.data.asked = {{column::angular_momentum_norm}};
  CHECK(c.solve().warnings.empty());
  c.data.asked.push_back({scalar::stop_time, true});
  const Answer asked = c.solve();
  CHECK(asked.warnings.empty());
  CHECK(asked.quantities.size() == 1);
  CHECK(Case(1e-2, 80).with(any_rung, 1e-9).solve().warnings.empty());
}
