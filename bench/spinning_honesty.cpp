// SPDX-License-Identifier: BSD-3-Clause
// How honest the answers are: random scenes of the spinning family, solved at four tolerances, against the full equations in long
// double. Prints the fraction of answers whose true error is within the stated one in every column, the median of stated over true, and
// the worst cases with their scenes.
//
//     spinning_honesty [SCENES = 5000] [SEED = 1] [RUNG = auto]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "../tests/ladder/spinning/truth.hpp"
#include "gyrostat/ladder/spinning/cvode_motion.hpp"
#include "gyrostat/ladder/spinning/axial_motion.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::spinning;

/// Bodies, loads and starts of every kind the family knows, the degenerate ones well represented, tilted from 1e-4 to beyond 1 rad.
class Scenes {
 public:
  explicit Scenes(unsigned seed) : random_(seed) {}

  struct Made {
    Problem<double> problem;
    std::vector<double> times;
    const char* kind;

    Result<Scene> posed(Question question) const {
      question.times = times;
      return Scene::make(problem, question);
    }
    std::string text() const {
      const auto& p = problem;
      char line[900];
      std::snprintf(
          line, sizeof line,
          "%s: D %.17g %.17g %.17g m %.17g l %.17g e %.17g M %.17g %.17g %.17g f %.17g %.17g %.17g w %.17g %.17g %.17g "
          "angles %.17g %.17g %.17g v %.17g %.17g %.17g x %.17g %.17g %.17g",
          kind, p.inertia[0], p.inertia[1], p.inertia[2], p.mass, p.rotor_momentum, p.charge_momentum, p.torque[0],
          p.torque[1], p.torque[2], p.force[0], p.force[1], p.force[2], p.angular_velocity[0], p.angular_velocity[1],
          p.angular_velocity[2], p.angles.psi, p.angles.phi, p.angles.theta, p.velocity[0], p.velocity[1],
          p.velocity[2], p.position[0], p.position[1], p.position[2]);
      return line + honesty::text_of(times);
    }
  };

  Made next() {
    Made made = unit() < 0.12 ? flipping() : pushed();
    const double mass = unit() < 0.8 ? 1 : scale(1e-20, 1e20), length = unit() < 0.9 ? 1 : scale(1e-7, 1e7);
    const double clock = unit() < 0.8 ? 1 : scale(1e-7, 1e7), momentum = mass * length * length * clock;
    Problem<double>& p = made.problem;
    p.inertia *= mass * length * length, p.mass *= mass;
    p.rotor_momentum *= momentum, p.charge_momentum *= momentum;
    p.torque *= momentum * clock, p.force *= mass * length * clock * clock;
    p.angular_velocity *= clock, p.velocity *= length * clock, p.position *= length;
    for (double& t : made.times) t /= clock;
    return made;
  }

 private:
  /// Turning about a principal axis, mostly the middle one, exactly or nearly, which it leaves by what rounds; hardly pushed.
  Made flipping() {
    Made made{{}, {}, "about a principal axis"};
    Problem<double>& p = made.problem;
    do p.inertia = {scale(0.3, 3), scale(0.3, 3), scale(0.3, 3)};
    while (2 * p.inertia.maxCoeff() > p.inertia.sum());
    const Vec3<double>& D = p.inertia;
    int k = int(3 * unit());
    for (int i = 0; i < 3 && unit() < 0.8; ++i)
      if (D.minCoeff() < D[i] && D[i] < D.maxCoeff()) k = i, made.kind = "about the middle axis";
    const double spin = sign() * scale(0.03, 30), off = unit() < 0.3 ? 0 : scale(1e-17, 1e-2);
    p.angular_velocity = off * spin * vector();
    p.angular_velocity[k] = spin;
    if (unit() < 0.3) p.angular_velocity[(k + 1) % 3] = 0;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double growth = std::sqrt(std::abs((D[k] - D[i]) * (D[j] - D[k]) / (D[i] * D[j]))) * std::abs(spin);
    if (unit() < 0.5) p.angles = {2 * unit() - 1, 6 * unit() - 3, 6 * unit() - 3};
    if (unit() < 0.3) p.torque = scale(1e-12, 1e-3) * D.maxCoeff() * spin * spin * vector();
    if (unit() < 0.5) p.force = vector();
    made.times = honesty::asked_times(random_, scale(1, 100) / growth);
    return made;
  }

  Made pushed() {
    for (;;) {
      Made made{{}, {}, "generic"};
      Problem<double>& p = made.problem;
      Vec3<double> D(scale(0.3, 3), scale(0.3, 3), scale(0.3, 3));
      const double shape = unit();
      if (shape < 0.15) D[1] = D[0], made.kind = "symmetric";
      else if (shape < 0.45) D[1] = D[0] * (1 + sign() * scale(1e-12, 0.2)), made.kind = "nearly symmetric";
      else if (shape < 0.49) D[1] = D[2] = D[0], made.kind = "sphere";
      else if (shape < 0.53) D[2] = D[0] + D[1], made.kind = "lamina";
      if (2 * D.maxCoeff() > D.sum()) continue;
      p.inertia = D * scale(0.1, 1e3);
      p.mass = scale(1, 1e3);
      const double spin = sign() * scale(0.03, 30), L = p.inertia[2] * std::abs(spin);
      p.angular_velocity[2] = spin;
      if (unit() < 0.5) p.rotor_momentum = sign() * L * scale(0.01, 3);
      if (unit() < 0.3) p.charge_momentum = sign() * L * scale(1e-3, 0.5);
      double rate = std::abs(spin);  // what a revolution is counted by

      const double special = unit(), off = unit() < 0.4 ? 0 : sign() * scale(1e-12, 0.1);
      const double sum = (p.inertia[0] + p.inertia[1]) * spin;
      const auto effective = [&](double X) { p.rotor_momentum += X - p.effective_momentum(); };
      if (special < 0.04) effective(off * sum), made.kind = "no stiffness";
      else if (special < 0.08) effective(sum * (1 + off)), made.kind = "resonance";
      else if (special < 0.12) {
        // kappa1 = 0
        p.rotor_momentum -= p.kappa1(spin) * p.inertia[0];
        p.rotor_momentum += off * L;
        made.kind = "no nutation";
      } else if (special < 0.15) {
        p.angular_velocity[2] = 0;
        made.kind = "no spin";
      } else if (special < 0.17) {
        p.angular_velocity[2] *= scale(1e-10, 1e-2);
        made.kind = "slow spin";
      }
      if (special >= 0.12 && special < 0.17 && unit() < 0.5) p.rotor_momentum = p.charge_momentum = 0;

      double span = 2 * pi<double> / rate * scale(1, 300);
      const double nu2 = p.nutation_squared();
      if (nu2 < 0) span = std::min(span, scale(0.3, 12) / std::sqrt(-nu2));

      const double pushed = unit();
      if (pushed > 0.1) p.torque = vector(), p.torque[2] = 0;
      if (pushed < 0.2) p.torque[int(2 * unit())] = 0;
      if (unit() < 0.4) {
        const double size = p.torque.norm() > 0 ? scale(1e-2, 10) * p.torque.norm() / L : 0.1 * std::abs(rate);
        p.angular_velocity[0] = size * (2 * unit() - 1), p.angular_velocity[1] = size * (2 * unit() - 1);
        p.angles.psi = size / rate * (2 * unit() - 1), p.angles.phi = size / rate * (2 * unit() - 1);
      }
      if (unit() < 0.5) p.angles.theta = 6 * unit() - 3;
      const double force = unit();
      if (force > 0.1) p.force[2] = sign() * scale(0.1, 100);
      if (force > 0.5) p.force[0] = sign() * scale(0.01, 100), p.force[1] = sign() * scale(0.01, 100);
      if (unit() < 0.3) p.velocity = vector() * scale(0.1, 1e3), p.position = vector() * scale(1, 1e5);
      if (unit() < 0.2) {
        made.kind = special < 0.17 ? made.kind : "axial torque";
        const double change = unit() < 0.3 ? -2 * unit() * p.spin() : sign() * scale(1e-3, 3) * rate;
        p.torque[2] = p.inertia[2] * change / span;
      }
      if (unit() < 0.02) {
        p.torque.setZero();
        p.angular_velocity[0] = p.angular_velocity[1] = p.angles.psi = p.angles.phi = 0;
        made.kind = "nothing pushes";
      }

      // everything that tilts, in proportion
      const double g = tilt_of(p, span);
      if (!(g < 1e8)) continue;
      if (g > 0) {
        const double by = scale(1e-4, 1.5) / g, M3 = p.torque[2];
        p.torque *= by;
        p.torque[2] = M3;
        p.angular_velocity[0] *= by, p.angular_velocity[1] *= by;
        p.angles.psi *= by, p.angles.phi *= by;
      }
      if (unit() < 0.1) hold(made, span);
      made.times = honesty::asked_times(random_, span);
      return made;
    }
  }

  /// Lets the torque hold the body in a lean, where no mode of the linear motion is at work, and instability grows from nothing.
  void hold(Made& made, double& span) {
    Problem<double>& p = made.problem;
    const double kappa1 = p.kappa1(p.spin()), kappa2 = p.kappa2(p.spin()), nu2 = kappa1 * kappa2;
    const double lean =
        std::abs(p.torque[0] / (p.inertia[0] * kappa1)) + std::abs(p.torque[1] / (p.inertia[1] * kappa2));
    if (p.torque[2] != 0 || !(lean < std::abs(p.spin()))) return;
    p.angular_velocity[0] = -p.torque[1] / (p.inertia[1] * kappa2);
    p.angular_velocity[1] = p.torque[0] / (p.inertia[0] * kappa1);
    if (nu2 < 0) span = scale(1, 25) / std::sqrt(-nu2);
    made.kind = "held by the torque";
  }

  static double tilt_of(const Problem<double>& p, double span) {
    if (p.torque[2] == 0) return amplitudes(p, span).tilt;
    const std::vector<double> times{span};
    std::vector<State<double>> states(1);
    const auto made = axial_motion<double>(p, times, states);
    return made && made->status == ode::Status::reached ? made->seen.size.tilt : infinity<double>;
  }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double sign() { return unit() < 0.5 ? -1 : 1; }
  double scale(double low, double high) { return std::exp(std::log(low) + unit() * std::log(high / low)); }
  Vec3<double> vector() {
    const double x = 2 * unit() - 1, y = 2 * unit() - 1, z = 2 * unit() - 1;
    return {x, y, z};
  }
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  const auto truth = [](const Scene& scene, Answer& right) {
    if (!true_motion(scene, right)) return false;
    const Column& attitude = *right.find("attitude");
    double tilt = 0;
    for (std::size_t i = 0; i < attitude.values.size(); i += 4) {
      const double* q = &attitude.values[i];
      tilt = std::max(tilt, 2 * std::atan2(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])));
    }
    right.quantities.push_back({&scalar_kinds[scalar::tilt_max], {tilt}, attitude.error});
    return true;
  };
  honesty::run(argc, argv, tables, 5000, Scenes(honesty::seed_of(argc, argv)), truth,
               [](const Scene& scene, Refusal& refusal) { return solve(scene, refusal); }, {1e-2, 1e-5, 1e-8, 1e-11},
               {"tilt_max"});
}
