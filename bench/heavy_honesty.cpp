// SPDX-License-Identifier: BSD-3-Clause
// How honest the answers are: random scenes of the heavy family, solved at four tolerances, against the full equations in long
// double. Prints the fraction of answers whose true error is within the stated one in every column and in what is stated of a period,
// the median of stated over true, and the worst cases with their scenes.
//
//     heavy_honesty [SCENES = 5000] [SEED = 1] [RUNG = auto]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "../tests/ladder/heavy/truth.hpp"
#include "gyrostat/body/principal_axes.hpp"
#include "gyrostat/ladder/heavy/cvode_motion.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "honesty.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::heavy;

/// Bodies, fields and starts of every kind the family knows, the degenerate ones well represented.
class Scenes {
 public:
  explicit Scenes(unsigned seed) : random_(seed) {}

  struct Made {
    Body body;
    bool turned = false;  ///< given by a tensor, about axes that are not principal
    Mat3<double> inertia;
    Vec3<double> centre;
    Start start;
    std::vector<double> times;
    bool wants_attitude = false;
    std::string kind;

    Result<Scene> posed(Question question) const {
      question.times = times;
      question.wants_attitude = wants_attitude;
      Start from = start;
      from.oriented = wants_attitude;
      return Scene::make(body, from, question);
    }
    bool true_motion(const Scene& scene, Answer& truth) const;
    std::string text() const;
  };

  Made next() {
    for (;;) {
      Made made;
      if (body(made) && motion(made)) return made;
    }
  }

 private:
  bool body(Made& made) {
    // sums of such moments are exact; by way of float compilers leave the rounding out
    const auto moment = [this] { return std::round(any(0.3, 2) * 0x1p24) * 0x1p-24; };
    Vec3<double> I{moment(), moment(), moment()};
    Vec3<double> centre = direction();
    const double shape = unit(), kind = unit();
    const double off = kind < 0.4   ? 0
                       : kind < 0.5 ? sign() * epsilon<double> * std::ceil(14 * unit())
                                    : sign() * scale(1e-15, 0.1);
    made.kind = "generic";
    if (shape < 0.12) {
      I[1] = I[0] * (1 + off), centre = Vec3<double>(off * any(-1, 1), off * any(-1, 1), sign());
      made.kind = off == 0 ? "top" : "nearly top";
    } else if (shape < 0.16) {
      I[1] = I[0], made.kind = "symmetric";
    } else if (shape < 0.2) {
      I[1] = I[2] = I[0], made.kind = "sphere";
    } else if (shape < 0.25) {
      I[2] = I[0] + I[1], centre[2] = 0, made.kind = "lamina";
    } else if (shape < 0.28) {
      I[0] = I[1] = 2 * I[2], centre[2] = 0, made.kind = "Kovalevskaya";
    } else if (shape < 0.33) {
      I[unit() < 0.5 ? 0 : 1] = I[2] * (1 + off), made.kind = "near divisor";
    } else if (shape < 0.38) {
      // nutation at half the spin rate
      const double a = any(0.55, 0.95), b = (1 - a) / (1 - 0.75 * a);
      I[0] = a * I[2], I[1] = b * I[2] * (1 + off), made.kind = "tongue";
    } else if (shape < 0.41) {
      I = {I.minCoeff(), I.maxCoeff(), I.sum() - I.minCoeff() - I.maxCoeff()}, made.kind = "intermediate";
    } else if (shape < 0.47) {
      centre[2] = off, made.kind = off == 0 ? "flat" : "nearly flat";
      if (unit() < 0.5) centre[1] = 0;
    } else if (shape < 0.54) {
      I[1] = I[0] = 1, I[2] = std::exp2(std::floor(std::log2(scale(1e-8, 0.1))));
      centre = Vec3<double>(0, 0, sign()), made.kind = "slim";
    }
    if (!(I.minCoeff() > 0) || 2 * I.maxCoeff() > I.sum()) return false;
    if (unit() < 0.2 && shape >= 0.12) std::swap(I[0], I[2]), std::swap(centre[0], centre[2]);
    const double mass = scale(0.1, 10);
    const Vec3<double> room = Vec3<double>::Constant(I.sum() / 2) - I;
    double reach = 0;
    for (int i = 0; i < 3; ++i)
      if (centre[i] != 0) reach += room[i] > 0 ? centre[i] * centre[i] / room[i] : infinity<double>;
    if (!(reach < infinity<double>)) return false;
    centre *= std::sqrt(1 / (mass * reach)) * any(0.02, 0.9);
    const double field = unit();
    double weight = scale(0.1, 10), gradient = 0;
    if (field < 0.06) weight = 0, made.kind += ", no weight";
    if (field > 0.97) centre.setZero(), made.kind += ", centred";
    if (unit() < 0.5) gradient = scale(1e-8, 3), made.kind += ", gradient";
    const double length = centre.norm();
    const double gravity = length > 0 ? weight / mass / length : weight;
    // a grain, an asteroid; slow and fast clocks
    const double grams = unit() < 0.8 ? 1 : std::exp2(std::round(200 * unit() - 100));
    clock_ = unit() < 0.8 ? 1 : std::exp2(std::round(60 * unit() - 30));
    made.centre = centre, made.inertia = grams * Mat3<double>(I.asDiagonal());
    made.turned = unit() < 0.3;
    if (made.turned) {
      made.kind += ", tensor";
      const Mat3<double> R = to_matrix(normalised(Quat<double>{any(-1, 1), any(-1, 1), any(-1, 1), any(-1, 1)}));
      const Mat3<double> turned = R * made.inertia * R.transpose();
      made.inertia = (turned + turned.transpose()) / 2, made.centre = R * centre;
    }
    const auto body =
        Body::make(made.inertia, grams * mass, made.centre, gravity * clock_ * clock_, gradient * clock_ * clock_);
    if (!body) return false;
    made.body = *body;
    return true;
  }

  /// What the potential energy lacks at `down` to its maximum in the plane across axis k, J.
  static double to_top(const Problem<double>& p, int k, const Vec3<double>& down) {
    const auto potential = [&](const Vec3<double>& d) {
      return p.gradient() * d.dot(p.inertia().cwiseProduct(d)) / 2 - p.moment().dot(d);
    };
    const auto at = [&](double angle) {
      Vec3<double> d(0, 0, 0);
      d[(k + 1) % 3] = std::cos(angle), d[(k + 2) % 3] = std::sin(angle);
      return potential(d);
    };
    constexpr double step = pi<double> / 64;
    double best = 0;
    for (int n = 1; n < 128; ++n)
      if (at(n * step) > at(best)) best = n * step;
    double low = best - step, high = best + step;
    for (int trip = 0; trip < 80; ++trip) {
      const double one = low + (high - low) / 3, two = high - (high - low) / 3;
      (at(one) < at(two) ? low : high) = at(one) < at(two) ? one : two;
    }
    return at((low + high) / 2) - potential(down);
  }

  bool motion(Made& made) {
    const Problem<double>& p = made.body.problem;
    const double c = std::max({p.pendulum_rate(), std::sqrt(p.gradient()), 0.1 * clock_});
    State<double>& s = made.start.state;
    s.attitude = normalised(Quat<double>{any(-1, 1), any(-1, 1), any(-1, 1), any(-1, 1)});
    s.down = rotate<double>(conjugate(s.attitude), {0, 0, -1});
    const double kind = unit(), spin = sign() * c * (unit() < 0.1 ? scale(0.4, 3) : scale(2.4, 500));
    made.wants_attitude = unit() < 0.5;
    double turns = scale(0.5, 100);
    const auto stand = [&](const Vec3<double>& down) {
      s.down = down.normalized();
      s.attitude = attitude_from_angles<double>(any(-3, 3), std::atan2(s.down[0], s.down[1]), s.down);
    };
    if (kind < 0.35 && !(made.turned && kind > 0.1)) {
      made.start.periodic = Periodic{spin, unit() < 0.2   ? 0.0
                                           : unit() < 0.1 ? sign() * (1 - scale(1e-6, 0.1))
                                                          : any(-0.98, 0.98)};
      made.kind += ", periodic";
    } else if (kind < 0.45) {
      const double cosine = any(-0.9, 0.9), off = unit() < 0.3 ? 0 : scale(1e-16, 1e-2);
      const auto motion = Series2<double>::make(p, spin, cosine);
      if (!motion) return false;
      s = motion->at(0);
      s.angular_velocity[0] += off * any(-1, 1) * spin, s.angular_velocity[1] += off * any(-1, 1) * spin;
      if (unit() < 0.5) stand(s.down + Vec3<double>(0, off * any(-1, 1), 0));
      made.kind += ", beside periodic";
    } else if (kind < 0.6) {
      const double tilt = scale(1e-6, 0.3);
      s.angular_velocity = spin * Vec3<double>(tilt * any(-1, 1), tilt * any(-1, 1), 1);
      made.kind += ", fast";
    } else if (kind < 0.7) {
      const double tilt = unit() < 0.3 ? 0 : scale(1e-15, 0.1);
      const int k = int(3 * unit());
      const int side = unit() < 0.5 ? 1 : -1;
      s.angular_velocity.setZero();
      s.angular_velocity[k] = c * scale(0.1, 30);
      Vec3<double> down = tilt * direction();
      down[k] = side;
      stand(down);
      made.kind += ", sleeping";
    } else if (kind < 0.82) {
      // flat swings, near the separatrix too; mostly with the mass centre in their plane where a body has one
      int k = int(3 * unit());
      for (int axis = 0; axis < 3; ++axis)
        if (p.centre_of_mass()[axis] == 0 && unit() < 0.7) k = axis;
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double angle = any(-3.2, 3.2);
      Vec3<double> down;
      down[i] = std::cos(angle), down[j] = std::sin(angle), down[k] = unit() < 0.7 ? 0 : scale(1e-16, 1e-3);
      stand(down);
      s.angular_velocity.setZero();
      const double up = std::sqrt(2 * std::max(0.0, to_top(p, k, s.down)) / p.inertia()[k]);
      s.angular_velocity[k] = unit() < 0.5 ? up * (1 + sign() * scale(1e-16, 0.5)) : c * scale(0.01, 10);
      made.kind += ", flat swing";
      turns = scale(0.5, 20);
    } else if (kind < 0.85) {
      s.angular_velocity.setZero();
      if (unit() < 0.3)
        stand(sign() * Vec3<double>::Unit(int(3 * unit())) + (unit() < 0.5 ? 0 : scale(1e-17, 1e-3)) * direction());
      made.kind += ", from rest";
      turns = scale(0.5, 20);
    } else if (kind < 0.92) {
      s.angular_velocity = c * scale(1e-3, 10) * direction();
      made.kind += ", slow";
      turns = scale(0.5, 20);
    } else {
      const int k = int(3 * unit());
      s.angular_velocity = scale(1e-15, 0.1) * direction();
      s.angular_velocity[k] = 1;
      s.angular_velocity *= spin;
      made.kind += ", permanent";
    }
    double rate = rate_size(p, s);
    if (made.start.periodic) rate = std::max(std::abs(spin), 0.5 * c);
    if (!(rate > 0)) rate = c;
    const double span = 2 * pi<double> / rate * turns;
    made.times = honesty::asked_times(random_, span);
    if (made.turned && !made.start.periodic) s = in_axes(made.body.R_BP, s);
    return true;
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double any(double low, double high) { return low + unit() * (high - low); }
  double sign() { return unit() < 0.5 ? -1 : 1; }
  double scale(double low, double high) { return std::exp(std::log(low) + unit() * std::log(high / low)); }
  Vec3<double> direction() {
    for (;;) {
      const double x = any(-1, 1), y = any(-1, 1), z = any(-1, 1);
      if (const Vec3<double> v(x, y, z); v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  double clock_ = 1;
  std::mt19937_64 random_;
};

/// Of a body given by a tensor without the rounding of the way to principal axes; of the double problem where that is the given one.
bool Scenes::Made::true_motion(const Scene& scene, Answer& truth) const {
  if (!turned || start.periodic) return heavy::true_motion(scene, truth);
  using Long = long double;
  const auto& p = body.problem;
  const auto axes = PrincipalAxes<Long>::nearest(inertia.cast<Long>());
  const auto problem = Problem<Long>::make(axes.moments, p.mass(), axes.R_BP.transpose() * centre.cast<Long>(),
                                           p.gravity(), p.gradient());
  if (!problem) return false;
  const State<double>& given = scene.given();
  const auto& q = given.attitude;
  const Mat3<Long> R_PB = axes.R_BP.transpose();
  State<Long> from{R_PB * given.angular_velocity.cast<Long>(), {}, normalised(Quat<Long>{q.w, q.x, q.y, q.z})};
  Vec3<Long> down = given.down.cast<Long>();
  if (wants_attitude) down = rotate<Long>(conjugate(from.attitude), {0, 0, -1});
  from.down = (R_PB * down).normalized();
  from.attitude = from.attitude * conjugate(from_matrix(R_PB));
  const std::vector<Long> asked(times.begin(), times.end());
  std::vector<State<Long>> states(times.size());
  FullMotionOptions<Long> options;
  options.tolerance = 1e-14L;
  options.step_cap = 2'000'000;
  options.attitude = wants_attitude;
  // long double finds the axes of moments that differ by roundings of double no better than to 1e-3 rad
  options.converted = true;
  const auto made = full_motion<Long>(*problem, from, asked, states, options);
  if (!made || made->status != ode::Status::reached) return false;
  // fill() turns by the matrix in double
  const Mat3<Long> back = scene.R_BP().cast<Long>().transpose() * axes.R_BP;
  Track track;
  for (const auto& s : states) {
    const Quat<Long> turn = s.attitude * conjugate(from_matrix(back));
    track.states.push_back({(back * s.angular_velocity).cast<double>(),
                            (back * s.down).cast<double>(),
                            {double(turn.w), double(turn.x), double(turn.y), double(turn.z)}});
  }
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) track.error[i] = double(made->error[i]);
  fill(truth, scene, track);
  for (Column& column : truth.columns) column.error += 2e-15;
  return true;
}

std::string Scenes::Made::text() const {
  const auto& p = body.problem;
  const auto& s = start.state;
  const Periodic periodic = start.periodic.value_or(Periodic{0, 0});
  const auto &w = s.angular_velocity, &d = s.down;
  const Mat3<double>& I = inertia;
  char line[900];
  std::snprintf(line, sizeof line,
                "%s: I %.17g %.17g %.17g %.17g %.17g %.17g m %.17g r %.17g %.17g %.17g g %.17g N %.17g periodic %.17g "
                "%.17g w %.17g %.17g %.17g d %.17g %.17g %.17g q %.17g %.17g %.17g %.17g turning %d",
                kind.c_str(), I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2), p.mass(), centre[0], centre[1],
                centre[2], p.gravity(), p.gradient(), periodic.spin, periodic.cos_inclination, w[0], w[1], w[2], d[0],
                d[1], d[2], s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z, int(wants_attitude));
  return line + honesty::text_of(times);
}

}  // namespace

int main(int argc, char** argv) {
  const auto truth = [](const Scenes::Made& made, const Scene& scene, Answer& right) {
    return made.true_motion(scene, right);
  };
  const auto answer = [](const Scene& scene, Refusal& refusal) { return heavy::solve(scene, refusal); };
  honesty::run(argc, argv, tables, 5000, Scenes(honesty::seed_of(argc, argv)), truth, answer, {1e-2, 1e-5, 1e-8, 1e-11},
               {"period", "floquet_trace", "precession_rate"});
}
