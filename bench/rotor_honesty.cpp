// SPDX-License-Identifier: BSD-3-Clause
// How honest the answers are: random scenes of the rotor family, solved at four tolerances, against the full equations in long
// double. Prints the fraction of answers whose true error is within the stated one in every column, the median of stated over true, and
// the worst cases with their scenes.
//
//     rotor_honesty [SCENES = 5000] [SEED = 1] [RUNG = auto] [together]
//
// together: as a sweep answers them, with `full` in lanes.
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "../tests/ladder/rotor/truth.hpp"
#include "gyrostat/ladder/rotor/cvode_motion.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::rotor;

/// Bodies, motors and starts of every kind the family knows, the degenerate ones well represented.
class Scenes {
 public:
  explicit Scenes(unsigned seed) : random_(seed) {}

  struct Made {
    Gyrostat<double> body;
    Asked data;
    const char* kind;

    Result<Scene> posed(Question question) const {
      question.times = data.times;
      return Scene::make(body, data, question);
    }
    std::string text() const {
      const auto& b = body;
      const auto& d = data;
      const auto& J = b.inertia();
      char line[900];
      std::snprintf(
          line, sizeof line,
          "%s: theta %.17g %.17g %.17g %.17g %.17g %.17g e %.17g %.17g %.17g lambda %.17g S %.17g target %.17g "
          "Omega %.17g %.17g %.17g rate %.17g q %.17g %.17g %.17g %.17g",
          kind, J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2), b.axis()[0], b.axis()[1], b.axis()[2],
          b.axial_inertia(), b.slope(), b.no_load_rate(), d.angular_velocity[0], d.angular_velocity[1],
          d.angular_velocity[2], d.rotor_rate, d.attitude.w, d.attitude.x, d.attitude.y, d.attitude.z);
      return line + honesty::text_of(d.times);
    }
  };

  Made next() {
    for (;;) {
      const char* kind = "generic";
      Vec3<double> second(scale(0.2, 3), scale(0.2, 3), scale(0.2, 3));
      Mat3<double> turn = to_matrix(attitude());
      Vec3<double> e = direction();
      const double which = unit();
      double h_over_l = std::copysign(scale(1e-2, 10), unit() - 0.5);
      if (which < 0.06) {
        kind = "axisymmetric";
        second[1] = second[0];
        e = turn.col(2);
      } else if (which < 0.1) {
        kind = "nearly axisymmetric";
        second[1] = second[0] * (1 + scale(1e-14, 1e-3));
        e = (turn.col(2) + scale(1e-14, 1e-3) * direction()).normalized();
      } else if (which < 0.16) {
        kind = "principal axis";
        e = turn.col(int(3 * unit()));
      } else if (which < 0.2) {
        kind = "near a principal axis";
        e = (turn.col(int(3 * unit())) + scale(1e-12, 1e-2) * direction()).normalized();
      } else if (which < 0.24) {
        kind = "sphere";
        second[1] = second[2] = second[0];
      } else if (which < 0.28) {
        kind = "target at rest";
        h_over_l = 0;
      } else if (which < 0.36) {
        kind = "exact axes";
        turn.setIdentity();
        e = turn.col(int(3 * unit()));
      }
      double lambda = scale(1e-3, 1), whole = 1;
      const double shape = unit();
      if (shape < 0.06) {
        kind = "slim";
        second[int(3 * unit())] *= scale(1e3, 1e8);
      } else if (shape < 0.12) {
        kind = "the rotor is the whole";
        whole = scale(1e-7, 1e-2);
        second *= whole * lambda;
      }
      // kilogrammes of a grain and of an asteroid, turns a year and a million a second
      const double mass = unit() < 0.8 ? 1 : scale(1e-20, 1e20), clock = unit() < 0.8 ? 1 : scale(1e-7, 1e7);
      second *= mass, lambda *= mass;
      const double mu = lambda * (0.5 + unit());
      const Mat3<double> E = Mat3<double>::Identity();
      const Mat3<double> carrier = turn * (second.sum() * E - Mat3<double>(second.asDiagonal())) * turn.transpose();
      Mat3<double> theta = carrier + lambda * e * e.transpose() + mu * (E - e * e.transpose());
      theta = ((theta + theta.transpose()) / 2).eval();
      const double l = scale(1e-1, 1e2) * mass * clock;
      const double spin = l / theta.trace();
      // relaxation from far slower to far faster than the turn
      double slope = whole * lambda * spin * scale(1e-5, 30);
      if (unit() < 0.05) slope = lambda * spin * scale(30, 1e3), kind = "stiff";
      if (unit() < 0.04) slope = 0, kind = "free rotor";
      auto made = Gyrostat<double>::make(theta, e, lambda, slope, h_over_l * l / lambda);
      if (!made) continue;

      Made scene{*made, {}, kind};
      Asked& d = scene.data;
      d.attitude = attitude();
      Vec3<double> H = l * direction();
      double omega = unit() < 0.3   ? made->no_load_rate()
                     : unit() < 0.5 ? 0
                                    : std::copysign(scale(1e-2, 3), unit() - 0.5) * l / lambda;
      const double start = unit();
      if (start < 0.05) {
        scene.kind = "at rest";
        H.setZero();
      } else if (start < 0.09) {
        scene.kind = "nearly at rest";
        H *= scale(1e-14, 1e-4);
      } else if (start < 0.4) {
        // at, or near, a steady rotation
        const auto steady = steady_rotations(*made, l);
        if (steady.count > 0) {
          const auto& near = steady.at[std::size_t(int(unit() * steady.count))];
          const double off = start < 0.15 ? 0 : scale(1e-10, 0.3);
          H = l * (near.direction + off * direction()).normalized();
          omega = made->no_load_rate() + off * spin * (2 * unit() - 1);
          scene.kind = off == 0                           ? "steady"
                       : near.type == SteadyType::minimum ? "near a minimum"
                                                          : "near a saddle or maximum";
        }
      } else if (start < 0.46) {
        scene.kind = "momentum along the rotor";
        H = std::copysign(l, unit() - 0.5) * e;
      }
      d.angular_velocity = made->inverse_inertia() * (H - lambda * omega * e);
      d.rotor_rate = omega;
      double rate = std::max({l / theta.trace(), d.angular_velocity.norm(), 1e-3 * std::abs(omega)});
      if (whole < 1) rate = turning_rate(*made, made->state({}, d.angular_velocity, omega));
      d.times = honesty::asked_times(random_, 2 * pi<double> / rate * scale(0.3, 200));
      return scene;
    }
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double scale(double low, double high) { return std::exp(std::log(low) + unit() * std::log(high / low)); }
  double normal() { return std::normal_distribution<double>()(random_); }
  Vec3<double> direction() {
    const double x = normal(), y = normal(), z = normal();
    return Vec3<double>(x, y, z).normalized();
  }
  Quat<double> attitude() {
    const double w = normal(), x = normal(), y = normal(), z = normal();
    return normalised(Quat<double>{w, x, y, z});
  }
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  honesty::run(
      argc, argv, tables, 5000, Scenes(honesty::seed_of(argc, argv)),
      [](const Scene& scene, Answer& truth) { return true_motion(scene, truth); },
      [together = argc > 4 && std::string(argv[4]) == "together"](const Scene& scene, Refusal& refusal) {
        Answer answer;
        if (together && SweepSolver{}.together({&scene, 1}, {&answer, 1}) == 1) return answer;
        return solve(scene, refusal);
      },
      {1e-2, 1e-5, 1e-8, 1e-11});
}
