// SPDX-License-Identifier: BSD-3-Clause
// How honest the answers to general scenes are: random scenes, a tenth of them with wheels that settle thousands of times, a tenth all but at rest in a balance, half of the others exactly
// instances of a family, or between the times at which something changes, solved at four tolerances, against the
// equations as they are written, in long double by a Runge-Kutta method. Prints the fraction of answers whose true error is within the
// stated one in every column, the median of stated over true, and the worst cases; behind it how well energies and momenta agree with what torques and
// motors have done.
//
//     general_honesty [SCENES = 500] [SEED = 1] [RUNG = auto]
#include <cmath>
#include <string>
#include <vector>

#include "../tests/ladder/general/special_scenes.hpp"
#include "../tests/models/general/scenes.hpp"
#include "../tests/models/general/truth.hpp"
#include "gyrostat/ladder/general/cvode_motion.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/ladder/general/track.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::general;

constexpr double turns = 10;

class Scenes {
 public:
  explicit Scenes(unsigned seed) : seed_(seed), general_(seed), special_(seed + 7919), stiff_(seed + 104729) {}

  struct Made {
    Problem<double> problem;
    std::vector<double> times;
    std::string kind;

    Result<Scene> posed(Question question) const {
      question.times = times;
      return Scene::make(problem, question);
    }
    std::string text() const { return kind + honesty::text_of(times); }
  };

  Made next() {
    Made made;
    double span = 1;
    const int all = count_++, i = all - all / 5;
    if (all % 10 == 8) {
      made = balanced(span);
    } else if (all % 5 == 4) {
      const auto any = stiff_.stiff(turns, stiff_.scale(2e3, 4e4));
      made.problem = any.problem, made.kind = any.kind, span = any.span;
    } else if (i % 2 == 0) {
      const auto any = general_.next(turns);
      made.problem = any.problem, made.kind = any.kind, span = any.span;
    } else {
      constexpr int families = int(specials), kinds = families + 2;
      const int kind = i / 2 % kinds;
      const auto family = kind < families ? Special(kind) : kind == families ? Special::free : Special::spinning;
      const auto one = kind < families ? special_.of(family, turns) : special_.in_segments(family, turns);
      made.problem = one.problem, made.kind = special_words[int(family)], span = one.span;
      if (kind >= families) made.kind += ", in segments";
    }
    made.times = honesty::asked_times(all % 5 == 4 ? stiff_.random() : special_.random(), span);
    made.kind = "seed " + std::to_string(seed_) + " scene " + std::to_string(all) + " " + made.kind;
    return made;
  }

 private:
  /// At rest or nearly so, on high or hanging, half of them in turned axes, a third as a dipole in a field, mostly with rotors that hold far more than the
  /// body turns with.
  Made balanced(double& span) {
    auto& random = special_.random();
    const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto scale = [&](double low, double high) { return std::exp(any(std::log(low), std::log(high))); };
    Made made;
    made.kind = "balanced";
    Problem<double>& p = made.problem;
    const double a = any(0.1, 1), b = any(0.1, 1), c = any(0.1, 1), swing = scale(0.1, 10);
    p.inertia = Vec3<double>(b + c, a + c, a + b).asDiagonal();
    const double size = swing * swing * p.inertia.diagonal().minCoeff(), off = any(0, 1) < 0.5 ? 0 : scale(1e-16, 1e-3);
    const Vec3<double> along =
        (Vec3<double>(0, 0, any(0, 1) < 0.8 ? -1 : 1) + off * Vec3<double>(any(-1, 1), any(-1, 1), 0));
    p.torques.resize(1);
    if (any(0, 1) < 0.3) {
      p.torques[0].type = TorqueType::magnetic, p.torques[0].vector = {0, 0, size};
      p.field.magnetic = MagneticField::uniform, p.field.flux_density = along;
    } else {
      p.torques[0].type = TorqueType::weight, p.fixed = true;
      p.mass = 1, p.centre_of_mass = {0, 0, 0.1}, p.field.gravity = 10 * size, p.field.down = along.normalized();
    }
    p.angular_velocity =
        swing * scale(1e-16, 1) * Vec3<double>(any(-1, 1), any(-1, 1), any(0, 1) < 0.5 ? 0 : any(-1, 1));
    const double momentum = size / swing * scale(1e-3, 1e2);
    const Vec3<double> axis = any(0, 1) < 0.5 ? Vec3<double>(0, 1, 0) : Vec3<double>(0, 0.6, 0.8);
    const double kind = any(0, 1);
    if (kind < 0.2) {
      p.rotor_momentum = momentum * axis;
    } else if (kind < 0.8) {
      p.wheels.resize(1);
      auto& wheel = p.wheels[0];
      wheel.type = kind < 0.5 ? WheelType::held : WheelType::free;
      wheel.axis = axis, wheel.axial_inertia = scale(1e-4, 0.05), wheel.rate = momentum / wheel.axial_inertia;
    }
    if (any(0, 1) < 0.5) {
      const auto turn = [&] { return any(-1, 1); };
      p.attitude = as_unit(Quat<double>{turn(), turn(), turn(), turn()});
      for (auto* fixed : {&p.field.down, &p.field.flux_density}) *fixed = rotate<double>(p.attitude, *fixed);
      if (any(0, 1) < 0.5) p.angular_velocity.setZero();
    }
    span = scale(3, 30) / swing;
    return made;
  }

  unsigned seed_;
  int count_ = 0;
  general_scenes::Scenes general_;
  general_scenes::SpecialScenes special_;
  general_scenes::Scenes stiff_;
};

std::vector<State<double>> motion(const Problem<double>& problem, const std::vector<double>& times,
                                  long double tolerance) {
  const std::vector<long double> wide(times.begin(), times.end());
  std::vector<State<double>> made;
  for (const auto& state :
       general_truth::motion<long double>(general_truth::cast<long double>(problem), wide, tolerance, 60'000))
    made.push_back(general_truth::cast<double>(state));
  return made;
}

/// How well the balances of the scenes close, and how their works compare with the energy of the truth.
struct BalancesSeen {
  std::vector<double> energy, momentum, work;

  void add(const Scenes::Made& made, const Scene& scene, const std::vector<State<double>>& truth) {
    const auto found = balance<double>(scene.problem(), made.times.back(), 1e-14, true);
    if (!(found.energy < infinity<double>)) return;
    // next to rest in a balance the energy is rounding of the potential that it leaves out
    if (made.kind.find("balanced") != std::string::npos) return;
    energy.push_back(found.energy), momentum.push_back(found.momentum);
    State<double> start{};
    start.angular_velocity = made.problem.angular_velocity;
    for (std::size_t i = 0; i < scene.wheels().count; ++i) start.rotor_rate[i] = scene.wheels().laws[i].rate;
    const double before = general::energy(scene.wheels(), start), after = general::energy(scene.wheels(), truth.back());
    const double off = found.work_off.whole() + 8 * epsilon<double> * (before + after);
    work.push_back(over(std::abs(found.work.whole() - (after - before)), off));
  }
  void print() {
    const auto tell = [](const char* name, std::vector<double>& all) {
      std::sort(all.begin(), all.end());
      const std::size_t n = all.size();
      if (n > 0)
        std::printf("  %s: median %.2g, 99 %% %.2g, greatest %.2g\n", name, all[n / 2], all[n * 99 / 100], all[n - 1]);
    };
    std::printf("balances of %zu scenes\n", energy.size());
    tell("energy", energy), tell("momentum", momentum);
    tell("works: how far their sum is off the change of the energy, over what is stated", work);
  }
};

/// The true motion and what it may itself be off by: four times the distance to a rougher run.
bool true_motion(const Scenes::Made& made, const Scene& scene, Answer& right, BalancesSeen& balances) {
  Track one, two;
  one.states = motion(made.problem, made.times, 1e-17L);
  two.states = motion(made.problem, made.times, 1e-15L);
  if (one.states.size() != made.times.size() || two.states.size() != made.times.size()) return false;
  balances.add(made, scene, one.states);
  one.off.fill(0), two.off.fill(0);
  Answer rough;
  fill(right, scene, one), fill(rough, scene, two);
  // where wheels hold much, the rates are a difference of momenta in long double, too
  double M = 0, w = 0;
  for (const auto& s : one.states) {
    M = std::max(M, s.angular_momentum.norm());
    w = std::max(w, s.angular_velocity.norm());
  }
  const double lost = 16 * double(epsilon<long double>) * M / scene.sizes().least;
  for (std::size_t i = 0; i < right.columns.size(); ++i) {
    Column& column = right.columns[i];
    column.error = 4 * column_error(rough.columns[i], column);
    if (column.name() == "angular_velocity") column.error += over(lost, size_of(column));
    if (column.name() == "energy") column.error += over(2 * scene.sizes().greatest * w * lost, size_of(column));
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const auto solve = [](const Scene& scene, Refusal& refusal) { return general::solve(scene, refusal); };
  BalancesSeen balances;
  const auto truth = [&](const Scenes::Made& made, const Scene& scene, Answer& right) {
    return true_motion(made, scene, right, balances);
  };
  honesty::run(argc, argv, tables, 500, Scenes(honesty::seed_of(argc, argv)), truth, solve, {1e-2, 1e-5, 1e-8, 1e-11});
  balances.print();
}
