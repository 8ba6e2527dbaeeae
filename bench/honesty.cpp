// SPDX-License-Identifier: BSD-3-Clause
// How honest the answers are: random scenes of the deceleration family, solved at two tolerances, against the full
// equations at 1e-12. Prints the fraction of answers whose true error is within the stated one in every column and in
// the stop time, the median of stated over true, and the worst cases with their scenes.
//
//     honesty [SCENES = 10000] [SEED = 1] [RUNG = auto] [DECADES = 5]     eps from 10^-DECADES to 1
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::deceleration;

/// Bodies, rotors, torques and starts of every kind the family knows, the degenerate ones well represented.
class Scenes {
 public:
  Scenes(unsigned seed, double decades) : decades_(decades), random_(seed) {}

  struct Made {
    Inertia<double> body;
    Setup setup;
    std::vector<double> times;

    Result<Scene> posed(Question question) const {
      question.times = times;
      return Scene::make(body, setup, question);
    }
    std::string text() const {
      const Vec3<double>& J = body.principal();
      const Vec3<double>&l = setup.rotor_momentum, &b = setup.control, &M = setup.momentum;
      char line[600];
      std::snprintf(line, sizeof line,
                    "J %.17g %.17g %.17g l %.17g %.17g %.17g b %.17g %.17g %.17g drag %.17g law %d %d M %.17g %.17g "
                    "%.17g T %.17g",
                    J[0], J[1], J[2], l[0], l[1], l[2], b[0], b[1], b[2], setup.drag, int(setup.law),
                    int(setup.drag_law), M[0], M[1], M[2], times.back());
      return line;
    }
  };

  Made next() {
    for (;;) {
      const double A = 1 + unit(), C = 0.3 + 0.7 * unit();
      double B = C + (A - C) * unit();
      const double kind = unit();
      if (kind < 0.1) B = A - (A - C) * std::pow(10, -1 - 4 * unit());
      else if (kind < 0.2) B = C + (A - C) * std::pow(10, -1 - 4 * unit());
      else if (kind < 0.22) B = A;
      else if (kind < 0.24) B = C;
      const auto body = Inertia<double>::from_moments(A, B, C);
      if (!body) continue;
      Made made{*body, {}, {}};
      Setup& d = made.setup;
      d.momentum = direction();
      const double eps = std::pow(10, -decades_ * unit());
      for (int i = 0; i < 3; ++i) d.control[i] = eps * std::pow(10, -1.5 * unit());
      if (unit() < 0.05) d.control.setConstant(eps * unit());
      d.drag = unit() < 0.4 ? 0 : eps * unit();
      if (unit() < 0.5) {
        d.rotor_momentum = direction() * std::pow(10, -3 + 4 * unit());
        if (unit() < 0.2) d.rotor_momentum[int(3 * unit())] = 0;
        if (unit() < 0.1) d.rotor_momentum = Vec3<double>(0, 0, d.rotor_momentum.norm());
        d.law = unit() < 0.6 ? Law::total : Law::carrier;
        d.drag_law = unit() < 0.6 ? d.law : Law::total;
      } else if (unit() < 0.2 && B < A && C < B) {
        const auto polhode = polhode_through<double>(Vec3<double>(1 / A, 1 / B, 1 / C), d.momentum);
        const double kp2 = std::pow(10, -1 - 9 * unit());
        const auto near = at_modulus<double>(polhode, {1 - kp2, kp2});
        d.momentum = momentum_on(near, 1.0, 4 * unit() * math::Native::complete(near.modulus).K);
      }
      const Vec3<double> U = d.law == Law::total ? d.momentum : Vec3<double>(d.momentum - d.rotor_momentum);
      const double mean = d.control.mean();
      const double braking = d.drag > 0 ? std::log1p(d.drag * U.norm() / mean) / d.drag : U.norm() / mean;
      const double span = braking * std::pow(10, -1.2 * unit()) * 1.2;
      for (int i = 1; i <= 12; ++i) made.times.push_back(span * i / 12);
      return made;
    }
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Vec3<double> direction() {
    std::normal_distribution<double> normal;
    Vec3<double> v(normal(random_), normal(random_), normal(random_));
    return v.normalized();
  }
  double decades_;
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  const double decades = argc > 4 ? std::atof(argv[4]) : 5;
  honesty::run(
      argc, argv, tables, 10000, Scenes(honesty::seed_of(argc, argv), decades),
      [](const Scene& scene, Answer& truth) {
        Question question = scene.question();
        question.tolerance = 1e-12;
        question.rung = rung::full;
        Refusal failed;
        truth = solve(scene.asked(question), failed);
        return failed.code == Errc::ok;
      },
      [](const Scene& scene, Refusal& refusal) { return solve(scene, refusal); }, {1e-3, 1e-6}, {"stop_time"});
}
