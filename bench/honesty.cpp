// SPDX-License-Identifier: BSD-3-Clause
// How honest the answers are: random scenes of the deceleration family, solved at several tolerances, against the full equations in
// long double, made of the same numbers by no conversion in double. Prints by rung and column how often the true error is within the
// stated one, the spread of stated over true, and the worst cases with their scenes.
//
//     honesty [SCENES = 3000] [SEED = 1] [RUNG = auto] [DECADES = 3]     eps from 10^-DECADES to 1
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "gyrostat/ladder/deceleration/cvode_motion.hpp"
#include "gyrostat/ladder/deceleration/full_motion.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "gyrostat/models/deceleration/orbit.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::deceleration;

/// A scene, as its numbers are given.
struct Made {
  Mat3<double> tensor;
  Inertia<double> body;
  Setup setup;
  std::vector<double> times;
  bool wants_attitude = false;

  Result<Scene> posed(Question question) const {
    question.times = times;
    question.wants_attitude = wants_attitude;
    return Scene::make(body, setup, question);
  }
  std::string text() const {
    const Vec3<double>&l = setup.rotor_momentum, &b = setup.control, &M = setup.momentum;
    const Quat<double>& q = setup.attitude;
    char line[900];
    std::snprintf(
        line, sizeof line,
        "J %.17g %.17g %.17g %.17g %.17g %.17g l %.17g %.17g %.17g b %.17g %.17g %.17g drag %.17g law %d %d M %.17g "
        "%.17g %.17g q %.3g %.3g %.3g %.3g T %.17g n %zu",
        tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(0, 2), tensor(1, 2), l[0], l[1], l[2], b[0],
        b[1], b[2], setup.drag, int(setup.law), int(setup.drag_law), M[0], M[1], M[2], q.w, q.x, q.y, q.z, times.back(),
        times.size());
    return line;
  }
};

/// Bodies, rotors, torques and starts of every kind the family knows, the degenerate ones well represented.
class Scenes {
 public:
  Scenes(unsigned seed, double decades) : decades_(decades), random_(seed) {}

  Made next() {
    for (;;) {
      Made made;
      const Mat3<double> R = axes();
      const Vec3<double> J = moments();
      made.tensor = R * J.asDiagonal() * R.transpose();
      made.tensor = ((made.tensor + made.tensor.transpose()) / 2).eval();
      const auto body = Inertia<double>::from_tensor(made.tensor);
      if (!body) continue;
      made.body = *body;
      Setup& d = made.setup;
      const double clock = unit() < 0.15 ? std::pow(10, -20 + 40 * unit()) : 1;
      const double size = J.maxCoeff() * std::pow(10, -3 + 4 * unit()) * clock;  // |M|: |omega| mostly 1e-3 to 10 rad/s
      torques(d, size * size / J.maxCoeff(), size);
      if (unit() < 0.4) rotors(d, size);
      start(d, *body, R, size);
      if (unit() < 0.03) {  // all along one axis, where the momentum may pass through zero
        const Vec3<double> axis = R.col(int(3 * unit()));
        d.momentum = size * axis, d.rotor_momentum = (unit() < 0.5 ? 1 : -1) * d.rotor_momentum.norm() * axis;
      }
      made.wants_attitude = unit() < 0.5;
      if (made.wants_attitude) {
        const Vec3<double> v = direction() * pi<double> * unit();
        d.attitude = quaternion_from_vector<double>(v);
      }
      const Vec3<double> U = d.law == Law::total ? d.momentum : Vec3<double>(d.momentum - d.rotor_momentum);
      made.times = times(d, std::max(U.norm(), 1e-6 * size), J.minCoeff() / size);
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

  Mat3<double> axes() {
    if (unit() < 0.4) return Mat3<double>::Identity();
    return to_matrix<double>(quaternion_from_vector<double>(direction() * pi<double> * unit()));
  }

  Vec3<double> moments() {
    const double A = 1 + unit(), C = 0.3 + 0.7 * unit();
    double B = C + (A - C) * unit();
    const double kind = unit();
    Vec3<double> J(A, B, C);
    if (kind < 0.12) J[1] = A - (A - C) * std::pow(10, -1 - 10 * unit());
    else if (kind < 0.24) J[1] = C + (A - C) * std::pow(10, -1 - 10 * unit());
    else if (kind < 0.27) J[1] = A;
    else if (kind < 0.30) J[1] = C;
    else if (kind < 0.42) {  // a rod
      const double slim = std::pow(10, -1 - 4 * unit());
      J = Vec3<double>(1, 1 - slim * unit(), slim);
    } else if (kind < 0.46) {  // nearly a cube
      const double off = std::pow(10, -1 - 5 * unit());
      J = Vec3<double>(1 + off * unit(), 1 + off * unit(), 1);
    }
    J *= std::pow(10, unit() < 0.15 ? -20 + 40 * unit() : -4 + 8 * unit());
    for (int i = 2; i > 0; --i) std::swap(J[i], J[int((i + 1) * unit())]);
    return J;
  }

  /// rate: torque that would stop the body in a radian; size: of M.
  void torques(Setup& d, double rate, double size) {
    const double eps = std::pow(10, -decades_ * unit());
    for (int i = 0; i < 3; ++i) d.control[i] = eps * rate * std::pow(10, -1.5 * unit());
    const double kind = unit();
    if (kind < 0.15) d.control.setConstant(eps * rate * unit());
    else if (kind < 0.20) d.control[int(3 * unit())] = 0;
    else if (kind < 0.30) d.control.setZero();
    d.drag = unit() < 0.4 ? 0 : eps * rate / size * unit();
  }

  void rotors(Setup& d, double size) {
    d.rotor_momentum = direction() * size * std::pow(10, -3 + 4 * unit());
    if (unit() < 0.2) d.rotor_momentum[int(3 * unit())] = 0;
    if (unit() < 0.1) d.rotor_momentum = Vec3<double>(0, 0, d.rotor_momentum.norm());
    d.law = unit() < 0.6 ? Law::total : Law::carrier;
    d.drag_law = unit() < 0.6 ? d.law : Law::total;
  }

  void start(Setup& d, const Inertia<double>& body, const Mat3<double>& R, double size) {
    d.momentum = direction() * size;
    const double kind = unit();
    if (kind < 0.08) d.momentum = R.col(int(3 * unit())) * size;  // on a principal axis
    else if (kind < 0.11) d.momentum = d.rotor_momentum;          // the carrier at rest
    else if (kind < 0.25) {                                       // near the separatrix of the body without rotors
      const Vec3<double> gaps = body.inverse_gaps();
      const auto polhode =
          polhode_through<double>(body.inverse_principal(), gaps, body.R_BP().transpose() * d.momentum);
      if (!(polhode.modulus.kp2 > 0) || !(gaps.minCoeff() > 0)) return;
      const double kp2 = std::pow(10, -1 - 12 * unit());
      const auto near = at_modulus<double>(polhode, {1 - kp2, kp2});
      d.momentum = body.R_BP() * momentum_on(near, size, 4 * unit() * math::Native::complete(near.modulus).K);
    }
  }

  /// turn: seconds a radian.
  std::vector<double> times(const Setup& d, double U, double turn) {
    const double mean = d.control.mean(), most = std::pow(10, decades_) * turn;
    double braking = d.drag > 0 ? std::log1p(d.drag * U / mean) / d.drag : U / mean;
    if (!(braking < most)) braking = most;
    double span = braking * std::pow(10, -1.2 * unit()) * 1.2;
    const double kind = unit();
    if (kind < 0.08) span *= std::pow(10, 6 * unit());
    if (!(span > 0 && std::isfinite(span))) span = turn;
    std::vector<double> made;
    const double how = unit();
    const int count = how < 0.2 ? 1 : how < 0.35 ? 2 : how < 0.8 ? 12 : 40;
    for (int i = 1; i <= count; ++i) made.push_back(span * (i - (how < 0.5 ? 0.9 * unit() : 0)) / count);
    if (d.control.isZero(0) && made.back() > most)
      for (double& t : made) t *= most / made.back();
    return made;
  }

  double decades_;
  std::mt19937_64 random_;
};

/// The true motion of a scene, column by column.
template <bool with_control>
bool true_motion(const Made& made, Answer& answer) {
  using Long = long double;
  const auto body = Inertia<Long>::from_tensor(made.tensor.cast<Long>());
  if (!body) return false;
  const Mat3<Long> R = body->R_BP(), back = R.transpose();
  const Setup& d = made.setup;
  Problem<Long> problem;
  problem.inverse_inertia = body->inverse_principal();
  problem.gaps = body->inverse_gaps(), problem.exact_moments = true;
  problem.rotor_momentum = back * d.rotor_momentum.cast<Long>();
  problem.control = back * d.control.cast<Long>().asDiagonal() * R;
  problem.drag = d.drag;
  problem.law = d.law;
  problem.drag_law = d.drag_law;
  problem.momentum = back * d.momentum.cast<Long>();
  const Quat<Long> q = normalised(Quat<Long>{d.attitude.w, d.attitude.x, d.attitude.y, d.attitude.z}) * from_matrix(R);

  using Run = deceleration::detail::Course<Long, with_control, true>;
  constexpr std::uint64_t budget = 100'000;
  Run run(deceleration::detail::Neighbour<Long>(problem), q, 1e-19L, 0.3L, budget);
  const Row<Long> row(problem, R);
  std::vector<Long> numbers(row_width(column_kinds));
  answer = {};
  for (const ColumnKind& kind : column_kinds) answer.columns.push_back({&kind, {}, 0});
  const Long last = made.times.back();
  for (const double t : made.times) {
    while (run.time() < t)
      if (run.step(last) != ode::Status::reached) return false;
    State<Long> state = run.at(t);
    const bool rest = state.momentum.isZero(0) || state.momentum == problem.rotor_momentum;
    const bool steady = state.momentum.cross(problem.angular_velocity(state.momentum)).isZero(0);
    state.k2 = 0;
    if (!rest && problem.rotor_momentum.isZero(0)) {
      const auto p = polhode_through<Long>(problem.inverse_inertia, *problem.gaps, state.momentum);
      state.k2 = std::isfinite(p.modulus.k2) ? p.modulus.k2 : 0;
    } else if (!rest && steady) {
      Problem<double> here;
      here.inverse_inertia = problem.inverse_inertia.cast<double>();
      here.rotor_momentum = problem.rotor_momentum.cast<double>();
      state.k2 = orbit_kind(here, state.momentum.cast<double>()).k2;
    } else if (!rest) {
      // beside an equilibrium the roots that it is made of part by the root of a rounding
      auto& own = answer.columns[column::modulus_squared].error;
      own = std::max(own, double(std::sqrt(epsilon<Long>)));
      const auto orbit = Orbit<Long>::through(problem, state.momentum);
      state.k2 = orbit ? orbit->modulus().k2 : orbit.error() == Errc::separatrix ? 1 : 0;
    }
    row(state, numbers.data());
    auto number = numbers.begin();
    for (Column& column : answer.columns)
      for (int i = 0; i < column.kind->width; ++i) column.values.push_back(double(*number++));
  }
  if (run.stops() &&
      deceleration::detail::go_to_rest(run, infinity<Long>, MotionOptions<Long>{}) != ode::Status::reached)
    return false;
  answer.quantities.push_back({&scalar_kinds[scalar::stop_time], {double(run.stop_time())}, 0});
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const double decades = argc > 4 ? std::atof(argv[4]) : 3;
  honesty::run(
      argc, argv, tables, 3000, Scenes(honesty::seed_of(argc, argv), decades),
      [](const Made& made, const Scene&, Answer& truth) {
        return made.setup.control.isZero(0) ? true_motion<false>(made, truth) : true_motion<true>(made, truth);
      },
      [](const Scene& scene, Refusal& refusal) { return solve(scene, refusal); }, {1e-2, 1e-4, 1e-6, 1e-9, 1e-11},
      {"stop_time"});
}
