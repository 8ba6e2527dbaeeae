// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/full_motion.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "../../models/rotor/bodies.hpp"
#include "allocations.hpp"
#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostat/models/rotor/steady.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;
using ode::Status;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool slow_build = true;
#else
constexpr bool slow_build = false;
#endif

/// A body and a start from Omega and omega, in any precision.
template <Real S>
struct Motion {
  Gyrostat<S> body;
  Quat<S> attitude{};
  Vec3<S> Omega{0, 0, 0};
  S omega = 0;

  State<S> start() const { return body.state(normalised(attitude), Omega, omega); }

  Motion<long double> widened() const {
    using Long = long double;
    return {Gyrostat<Long>::make(body.inertia().template cast<Long>(), body.axis().template cast<Long>(),
                                 body.axial_inertia(), body.slope(), body.no_load_rate())
                .value(),
            {attitude.w, attitude.x, attitude.y, attitude.z},
            Omega.template cast<Long>(),
            omega};
  }
};

template <Real S>
struct SolvedMotion {
  FullMotionAnswer<S> answer;
  std::vector<State<S>> states;
};

template <Real S>
SolvedMotion<S> solve(const Gyrostat<S>& body, const State<S>& start, const std::vector<S>& times, S tolerance,
                      Integrator integrator = Integrator::any) {
  SolvedMotion<S> solved;
  solved.states.resize(times.size());
  FullMotionOptions<S> options;
  options.tolerance = tolerance;
  options.integrator = integrator;
  options.step_cap = 3'000'000;
  const auto made = full_motion<S>(body, start, times, solved.states, options);
  REQUIRE(made);
  solved.answer = *made;
  return solved;
}

using List = std::array<double, 6>;
template <Real S>
List list(const ColumnErrors<S>& e) {
  List made;
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = double(e[i]);
  return made;
}

/// True errors of an answer to the motion, column by column; sets `known` to how well the truth is known.
List true_errors(const Motion<double>& motion, const std::vector<double>& times, const SolvedMotion<double>& solved,
                 List& known) {
  const auto wide = motion.widened();
  State<long double> start = wide.start();
  if (motion.start().momentum.isZero(0)) start.momentum.setZero();
  const auto truth = solve<long double>(wide.body, start, {times.begin(), times.end()}, 1e-15L);
  REQUIRE(truth.answer.status == Status::reached);
  known = list(truth.answer.error);
  Comparison both{Row<long double>(wide.body, start)};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const State<double>& s = solved.states[i];
    both.add(truth.states[i], {{s.attitude.w, s.attitude.x, s.attitude.y, s.attitude.z},
                               s.momentum.cast<long double>(),
                               s.axial_momentum,
                               s.rotor_angle});
  }
  return list(both.relative(both.difference()));
}

void check_honest(const Motion<double>& motion, const std::vector<double>& times, double tolerance,
                  Integrator integrator = Integrator::any) {
  const auto solved = solve<double>(motion.body, motion.start(), times, tolerance, integrator);
  REQUIRE(solved.answer.status == Status::reached);
  List known;
  const List errors = true_errors(motion, times, solved, known), stated = list(solved.answer.error);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    CAPTURE(i, errors[i], stated[i], known[i], int(solved.answer.used));
    CHECK(errors[i] - known[i] <= stated[i]);
    if (solved.answer.met) CHECK(errors[i] - known[i] <= tolerance);
  }
}

Motion<double> random_motion(Bodies& bodies, int i) {
  Motion<double> motion{bodies.realisable()};
  motion.attitude = bodies.attitude();
  motion.Omega = motion.body.inverse_inertia() * (bodies.direction() * bodies.scale(1, 10));
  motion.omega = bodies.uniform(-10, 10);
  const auto with_slope = [&](double slope) {
    const auto& b = motion.body;
    motion.body = Gyrostat<double>::make(b.inertia(), b.axis(), b.axial_inertia(), slope, b.no_load_rate()).value();
  };
  if (i % 7 == 3) motion.Omega.setZero();
  if (i % 11 == 5) with_slope(0);
  if (i % 13 == 6) with_slope(bodies.scale(10, 1e4));
  return motion;
}

std::vector<double> grid(double end, int n) {
  std::vector<double> times;
  for (int i = 1; i <= n; ++i) times.push_back(end * i / n);
  return times;
}

struct Reference {
  std::string id;
  Motion<double> motion;
  double floor = 0;
  std::vector<double> times;
  std::vector<State<double>> states;
};

std::vector<Reference> reference_cases() {
  std::ifstream file(GYROSTAT_TEST_DATA "/rotor_motion.csv");
  REQUIRE(file);
  std::vector<Reference> all;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::string id, cell;
    std::getline(cells, id, ',');
    std::vector<double> x;
    while (std::getline(cells, cell, ',')) x.push_back(std::strtod(cell.c_str(), nullptr));
    REQUIRE(x.size() == 35);
    if (all.empty() || all.back().id != id) {
      Mat3<double> theta;
      theta << x[0], x[1], x[2], x[1], x[3], x[4], x[2], x[4], x[5];
      const Vec3<double> e = Vec3<double>(x[7], x[8], x[9]).normalized();
      const auto body = Gyrostat<double>::make(theta, e, x[6], x[10], x[11]);
      REQUIRE(body);
      Reference made;
      made.id = id;
      made.motion = {*body, normalised(Quat<double>{x[12], x[13], x[14], x[15]}), {x[16], x[17], x[18]}, x[19]};
      made.floor = x[34];
      all.push_back(made);
    }
    const auto& body = all.back().motion.body;
    const Vec3<double> Omega(x[25], x[26], x[27]);
    State<double> s = body.state({x[21], x[22], x[23], x[24]}, Omega, x[28]);
    s.momentum = {x[30], x[31], x[32]};
    s.rotor_angle = x[29];
    all.back().times.push_back(x[20]);
    all.back().states.push_back(s);
  }
  return all;
}

}  // namespace

TEST_CASE("rotor: the full motion of the reference cases", "[rotor][length]") {
  const auto cases = reference_cases();
  REQUIRE(cases.size() == 11);
  for (const Reference& c : cases) {
    const bool is_long = c.id == "pub07" || c.id == "pub03";  // 1e4 turns; 30000 s
    for (const Integrator integrator : {Integrator::any, Integrator::radau}) {
      if (slow_build && is_long) continue;
      if (is_long && integrator == Integrator::radau && !at_length()) continue;
      for (const double tolerance : {1e-6, 1e-9, 1e-13}) {
        if (is_long && tolerance > 1e-7) continue;
        const auto solved = solve<double>(c.motion.body, c.motion.start(), c.times, tolerance, integrator);
        CAPTURE(c.id, int(integrator), tolerance, int(solved.answer.used), solved.answer.counts.steps);
        REQUIRE(solved.answer.status == Status::reached);
        Comparison both{Row<double>(c.motion.body, c.motion.start())};
        for (std::size_t i = 0; i < c.times.size(); ++i) both.add(c.states[i], solved.states[i]);
        const List errors = list(both.relative(both.difference())), stated = list(solved.answer.error);
        for (std::size_t i = 0; i < errors.size(); ++i) {
          CAPTURE(i, errors[i], stated[i]);
          CHECK(errors[i] <= stated[i] + 1e-15);
          if (tolerance > 1e-10) CHECK(errors[i] <= std::max(tolerance, c.floor));
        }
        if (tolerance < 1e-10) CHECK(errors[0] < c.floor);
        if (tolerance > 1e-10 && !is_long) CHECK(solved.answer.met);
      }
    }
  }
}

TEST_CASE("what is stated bounds what is true", "[rotor]") {
  Bodies bodies(7);
  const int count = slow_build ? 12 : 60;
  for (int i = 0; i < count; ++i) {
    const auto motion = random_motion(bodies, i);
    const double turn = 6.3 / turning_rate(motion.body, motion.start());
    const auto times = grid(bodies.scale(1, 30) * turn, i % 3 == 0 ? 1 : 12);
    CAPTURE(i);
    for (const double tolerance : {1e-4, 1e-9, 1e-14}) check_honest(motion, times, tolerance);
    check_honest(motion, times, 1e-7, Integrator::radau);
  }
}

TEST_CASE("a start next to an unstable rotation has two companions", "[rotor]") {
  // one may leave it as the answer does by chance: asked for the rotor's angle alone, it stated 1.3e-5 and erred 1.8e-3
  const Vec3<double> e(-0.1316957602766972, 0.9911026343056101, 0.019281986350554572);
  const auto body = Gyrostat<double>::make(Vec3<double>(38000, 52000, 75500).asDiagonal(), e, 626.9764414630253,
                                           7.104697577587372, 0);
  REQUIRE(body);
  Motion<double> motion{*body};
  motion.Omega = {2.7042854467577087e-13, 0.9999999999998496, -1.26790537411964e-13};
  motion.omega = 0;
  std::vector<double> times;
  for (int i = 1; i <= 10; ++i) times.push_back(27.04730453114166 * i);
  const double no = infinity<double>;
  const std::array<double, 6> wanted{no, no, no, no, 2.9666499646195915e-05, no};
  FullMotionOptions<double> options;
  options.tolerance = 2.9666499646195915e-05;
  options.wanted = wanted;
  SolvedMotion<double> solved;
  solved.states.resize(times.size());
  const auto made = full_motion<double>(motion.body, motion.start(), times, solved.states, options);
  REQUIRE(made);
  solved.answer = *made;
  List known;
  const List errors = true_errors(motion, times, solved, known), stated = list(solved.answer.error);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    CAPTURE(i, errors[i], stated[i], known[i]);
    CHECK(errors[i] - known[i] <= stated[i]);
  }
}

TEST_CASE("near a saddle errors grow and are stated", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  const auto steady = steady_rotations(body, 8.0);
  int saddles = 0;
  for (const auto& rotation : steady) {
    if (rotation.type != SteadyType::saddle) continue;
    ++saddles;
    for (const double off : {1e-3, 1e-6, 1e-10, 0.0}) {
      for (const double end : {10.0, 60.0}) {
        Motion<double> motion{body, {0.8, -0.2, 0.4, 0.4}};
        motion.Omega = rotation.spin_rate * rotation.direction + off * Vec3<double>(1, -2, 1);
        motion.omega = 3;
        CAPTURE(off, end);
        check_honest(motion, grid(end, 5), 1e-9);
      }
    }
  }
  CHECK(saddles > 0);
}

TEST_CASE("what becomes of a start in an unstable steady rotation is not known once rounding has left it", "[rotor]") {
  // the rotor spins down along the middle axis; the true motion stays there, all runs leave it and settle alike
  const auto body = Gyrostat<double>::make(Vec3<double>(3, 4, 5).asDiagonal(), {0, 1, 0}, 0.9, 0.9, 0);
  REQUIRE(body);
  const auto known = [&](const Vec3<double>& Omega, double end) {
    const auto solved = solve<double>(*body, body->state({0.82, -0.53, -0.15, -0.15}, Omega, 20), {end}, 1e-4);
    REQUIRE(solved.answer.status == Status::reached);
    return list(solved.answer.error);
  };
  for (const double error : known({0, 2, 0}, 172)) CHECK(error == infinity<double>);
  for (const double error : known({0, 2, 0}, 1)) CHECK(error < 1e-4);
  // off the axis the data say when it leaves, and where it settles is known
  CHECK(known({1e-6, 2, 0}, 172)[column::lyapunov] < 1e-3);
  // a stable one is kept
  const auto stable = solve<double>(*body, body->state({}, {0, 0, 2}, 0), {172}, 1e-4);
  for (const double error : list(stable.answer.error)) CHECK(error < 1e-4);
}

TEST_CASE("a departure from a steady rotation counts as error", "[rotor]") {
  auto error = rotor::ColumnErrors<double>::all(1e-9);
  error[column::angular_momentum] = 1e-10;
  auto small = error, counted = error, grown = error;
  rotor::detail::count_departure(small, 4e-11);
  CHECK(list(small) == list(error));
  rotor::detail::count_departure(counted, 1e-6);
  CHECK(counted[column::angular_momentum] == Approx(2e-6));
  CHECK(counted[column::rotor_angle] == Approx(2e-5));
  rotor::detail::count_departure(grown, 2 * honesty::left_steady);
  for (const double each : list(grown)) CHECK(each == infinity<double>);

  // 2e-4 of the momentum has gone across, but for what the start lacks of being along the axis
  const auto body = Gyrostat<double>::make(Vec3<double>(3, 4, 5).asDiagonal(), {0, 1, 0}, 0.9, 0.9, 0);
  REQUIRE(body);
  const auto start = body->state({}, {0, 2, 0}, 20), oblique = body->state({}, {1e-9, 2, 0}, 20);
  State<double> late = start;
  late.momentum[0] = 2e-4 * start.momentum.norm();
  const auto gone = [&](const State<double>& from) {
    return rotor::detail::departure_from_steady<double>(*body, from, std::span<const State<double>>(&late, 1));
  };
  CHECK(gone(start) == Approx(2e-4));
  CHECK(gone(oblique) == 0);
}

TEST_CASE("steps too long at first are shortened", "[rotor]") {
  // differences from a motion that leaves a saddle grow thousandfold: more than the first guess allows for
  const auto body = reference_body(0.2, 3);
  const auto steady = steady_rotations(body, 8.0);
  const auto& saddle = steady[steady.lowest(SteadyType::saddle)];
  const auto& centre = steady[steady.lowest(SteadyType::minimum)];
  const auto from = [&](const SteadyRotation<double>& rotation) {
    return solve<double>(body, body.state({}, rotation.spin_rate * rotation.direction + Vec3<double>(8e-5, 8e-5, 0), 3),
                         {50.0}, 1e-9);
  };
  const auto easy = from(centre), hard = from(saddle);
  CHECK(easy.answer.met);
  CHECK(hard.answer.met);
  CHECK(hard.answer.step_tolerance < easy.answer.step_tolerance / 8);
  CHECK(hard.answer.counts.steps > 2 * easy.answer.counts.steps);
}

TEST_CASE("rest, no momentum, no motor", "[rotor]") {
  const std::vector<double> times{0, 1, 50, 1000};
  SECTION("everything at rest stays so") {
    for (const double slope : {0.0, 0.2}) {
      const auto body = reference_body(slope, 0);
      for (const Integrator integrator : {Integrator::any, Integrator::radau}) {
        const auto solved =
            solve<double>(body, body.state({0.5, 0.5, 0.5, 0.5}, {0, 0, 0}, 0), times, 1e-9, integrator);
        CHECK(solved.answer.met);
        CHECK(angle_between<double>(solved.states[3].attitude, {0.5, 0.5, 0.5, 0.5}) < 1e-15);
        CHECK(solved.states[3].momentum.isZero(0));
        CHECK(solved.states[3].rotor_angle == 0);
      }
    }
  }
  SECTION("spin-up without momentum") {
    const auto body = reference_body(0.05, 30);
    for (const Integrator integrator : {Integrator::any, Integrator::radau}) {
      const auto solved = solve<double>(body, body.state({}, {0, 0, 0}, 0), times, 1e-9, integrator);
      CHECK(solved.answer.met);
      CHECK(solved.answer.error[column::angular_momentum] == 0);
      const double r = body.relaxation_rate();
      for (std::size_t i = 0; i < times.size(); ++i) {
        const double beta = 30 * (times[i] + std::expm1(-r * times[i]) / r);
        CHECK(solved.states[i].momentum.isZero(0));
        CHECK(solved.states[i].rotor_angle == Approx(beta).margin(1e-12));
      }
    }
  }
  SECTION("an angle far from no load is known as the angle of no load, from which it is told, is") {
    const auto body = reference_body(1e-6, 1e6);
    const long double r = Motion<double>{body}.widened().body.relaxation_rate();
    for (int i = 1; i <= 20; ++i) {
      const double t = 0.001 * i * i;
      const auto solved = solve<double>(body, body.state({}, {0, 0, 0}, 0), {t}, 1e-6);
      const long double late = r * t;  // some 1e-5 at most
      const auto beta = double(1e6L * t * late / 2 * (1 - late / 3 * (1 - late / 4)));
      CAPTURE(t);
      const double stated = solved.answer.error[column::rotor_angle] * std::max(beta, 1e-3);
      CHECK(std::abs(solved.states[0].rotor_angle - beta) <= stated);
      CHECK(stated < 4e-15 * 1e6 * t + 1e-14 * beta);
    }
  }
  SECTION("a momentum that cancels but for a rounding turns the body on when the motor has stopped it") {
    const double J = 0.20128893406024037, lambda = 0.05275733582847058, rate = -44.51652072736134;
    const Vec3<double> axis(0.8183702167305487, 0.5707549635205743, -0.06714878989991283),
        Omega(9.548474344885568, 6.659381066144883, -0.78346998038485);
    const auto body = Gyrostat<double>::make(J * Mat3<double>::Identity(), axis, lambda, 25.9, 0).value();
    const auto start = body.state({}, Omega, rate);
    REQUIRE(start.momentum.isZero(0));
    const auto solved = solve<double>(body, start, {100.0}, 1e-6);
    CHECK(solved.answer.met);
    const Vec3<long double> left =
        J * Omega.cast<long double>() + (long double)(lambda)*rate * axis.cast<long double>().normalized();
    CHECK(double(left.norm()) / J * 100 > 3e-13);
    CHECK(solved.answer.error[column::attitude] > double(left.norm()) / J * 100);
  }
  SECTION("without slope p and the energy stay") {
    const auto body = reference_body(0, 30);
    const State<double> start = body.state({}, {1, -2, 0.5}, 4);
    CHECK(solve<double>(body, start, times, 1e-9).answer.met);
    const auto solved = solve<double>(body, start, times, 2.7e-11);  // in steps near rounding
    for (const auto& s : solved.states) {
      CHECK(s.axial_momentum == start.axial_momentum);
      CHECK(body.energy(s.momentum, s.axial_momentum) ==
            Approx(body.energy(start.momentum, start.axial_momentum)).epsilon(3e-15));
    }
  }
}

TEST_CASE("a stiff motor is handed to collocation", "[rotor]") {
  std::uint64_t least = 1'000'000, most = 0;
  for (const double slope : {100.0, 1e3, 1e4, 1e6}) {
    Motion<double> motion{reference_body(slope, 5), {0.5, 0.5, -0.5, 0.5}, {0.5, 1.1, -0.8}, 0};
    REQUIRE(is_stiff(motion.body, motion.start()));
    const auto solved = solve<double>(motion.body, motion.start(), grid(20, 6), 1e-9);
    CHECK(solved.answer.used == Integrator::radau);
    CHECK(solved.answer.met);
    least = std::min(least, solved.answer.counts.steps);
    most = std::max(most, solved.answer.counts.steps);
    if (slope < 2e3) check_honest(motion, grid(5, 4), 1e-9);
    // before the motor has come to its balance, and across that moment
    const double layer = 40 / motion.body.relaxation_rate();
    check_honest(motion, {layer / 80, layer / 2, layer, 1.5 * layer}, 1e-9);
  }
  CHECK(2 * most < 3 * least);

  const Motion<double> soft{reference_body(0.2, 5), {}, {0.5, 1.1, -0.8}, 0};
  CHECK_FALSE(is_stiff(soft.body, soft.start()));
  CHECK(solve<double>(soft.body, soft.start(), {5.0}, 1e-9).answer.used == Integrator::taylor);
  CHECK(solve<double>(soft.body, soft.start(), {5.0}, 1e-9, Integrator::radau).answer.used == Integrator::radau);
}

TEST_CASE("collocation: a companion does not step as the answer does where the tolerance does not limit the steps",
          "[rotor]") {
  Mat3<double> theta;
  theta << 0.8935674446483661, -0.3427251901010436, -0.12114096383804812,  //
      -0.3427251901010436, 1.255184112635051, 0.2992328181370981,          //
      -0.12114096383804812, 0.2992328181370981, 1.2121625626274404;
  const Vec3<double> axis(-0.28596772775766144, -0.6656321527895841, -0.6893158172085011);
  const auto body =
      Gyrostat<double>::make(theta, axis, 0.00020077011038276873, 0.0007430126427142202, -2.432718726467986);
  REQUIRE(body);
  Motion<double> motion{*body, {1, 0, 0, 1}, {-0.007770283648871459, -0.0052502992823221925, 0.0011844191881189023}, 0};
  for (const double end : {15., 20., 27.357167214063523, 40.})
    for (const double tolerance : {1e-6, 1e-8, 1e-9, 1e-10}) {
      CAPTURE(end, tolerance);
      check_honest(motion, grid(end, 11), tolerance, Integrator::radau);
    }
}

TEST_CASE("collocation: a companion does not go all the way in the one step of the answer", "[rotor]") {
  Mat3<double> theta;
  theta << 0.0022798934794142204, 8.152301342131277e-05, 0.0007374957910340591,  //
      8.152301342131277e-05, 0.0016680995106459423, 0.00012226014110750785,      //
      0.0007374957910340591, 0.00012226014110750785, 0.002947839235201267;
  const auto body = Gyrostat<double>::make(theta, {0.25521899886249616, -0.6771480552956659, 0.6901693805356212},
                                           0.00028062146898224285, 5.6458701999705285, 6.958020608240542);
  REQUIRE(body);
  const Motion<double> motion{*body, {}, {-0.4951331405353694, -0.533445295628389, 0.07636506079176576}, 1.4045491};
  for (const double end : {0.01, 0.03879280939919115, 0.1}) check_honest(motion, {end}, 1e-5);
}

TEMPLATE_TEST_CASE("every precision meets its own tolerance", "[rotor]", float, double, long double) {
  using S = TestType;
  Mat3<S> theta;
  theta << S(3.2L), S(0.1L), S(-0.15L), S(0.1L), S(4.1L), S(0.2L), S(-0.15L), S(0.2L), 5;
  Vec3<S> e(S(0.75L), S(0.35L), S(0.56L));
  e /= e.norm();
  const auto body = Gyrostat<S>::make(theta, e, S(0.35L), S(0.2L), 3).value();
  const auto start = body.state({}, {S(0.5L), S(1.1L), S(-0.8L)}, 0);
  for (const Integrator integrator : {Integrator::taylor, Integrator::radau}) {
    const auto solved = solve<S>(body, start, {S(1), S(5)}, 4000 * epsilon<S>, integrator);
    CHECK(solved.answer.status == Status::reached);
    CHECK(solved.answer.met);
    const Vec3<S> L = rotate<S>(solved.states[1].attitude, solved.states[1].momentum);
    CHECK((L - start.momentum).norm() < 16 * epsilon<S> * L.norm());
  }
}

TEST_CASE("what cannot be answered is refused", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  const State<double> start = body.state({}, {0.5, 1.1, -0.8}, 0);
  std::vector<State<double>> states(2);
  const auto error = [&](std::vector<double> times, State<double> from, double tolerance = 1e-9) {
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    return full_motion<double>(body, from, times, states, options).error();
  };
  CHECK(error({1, 2}, start) == Errc::ok);
  CHECK(error({1}, start) == Errc::out_of_domain);
  CHECK(error({2, 1}, start) == Errc::not_increasing);
  CHECK(error({-1, 1}, start) == Errc::not_increasing);
  CHECK(error({1, gyrostat::nan<double>}, start) == Errc::not_finite);
  CHECK(error({1, infinity<double>}, start) == Errc::not_finite);
  CHECK(error({1, 2}, start, gyrostat::nan<double>) == Errc::not_finite);
  State<double> bad = start;
  bad.momentum[2] = infinity<double>;
  CHECK(error({1, 2}, bad) == Errc::not_finite);
  bad = start;
  bad.axial_momentum = gyrostat::nan<double>;
  CHECK(error({1, 2}, bad) == Errc::not_finite);
  bad = start;
  bad.attitude = {0, 0, 0, 0};
  CHECK(error({1, 2}, bad) == Errc::zero_vector);

  FullMotionOptions<double> options;
  options.step_cap = 5;
  const std::vector<double> times{0.01, 1e6};
  for (const Integrator integrator : {Integrator::taylor, Integrator::radau}) {
    options.integrator = integrator;
    const auto capped = full_motion<double>(body, start, times, states, options);
    REQUIRE(capped);
    CHECK(capped->status == Status::step_limit);
    CHECK_FALSE(capped->met);
    CHECK(std::isfinite(states[0].axial_momentum));
    CHECK(std::isnan(states[1].axial_momentum));
  }
}

TEST_CASE("work can be watched and stopped, and needs no memory", "[rotor]") {
  const auto body = reference_body(0.2, 3);
  const State<double> start = body.state({}, {0.5, 1.1, -0.8}, 0);
  std::vector<State<double>> states(3);
  Monitor monitor;
  FullMotionOptions<double> options;
  options.monitor = &monitor;
  for (const Integrator integrator : {Integrator::taylor, Integrator::radau}) {
    options.integrator = integrator;
    const std::vector<double> times{0, 1, 400};
    monitor.fraction = 0;
    monitor.cancel = false;
    const auto before = allocations();
    const auto answer = full_motion<double>(body, start, times, states, options);
    CHECK(allocations() == before);
    REQUIRE(answer);
    CHECK(answer->met);
    CHECK(monitor.fraction == 1);
    CHECK(states[0].momentum == start.momentum);
    monitor.cancel = true;
    CHECK(full_motion<double>(body, start, times, states, options)->status == Status::cancelled);
  }
}

TEST_CASE("where the rates of the runs have parted V is known only where it hardly differs", "[rotor]") {
  const auto lyapunov = [](double of_rates, double stated) {
    ColumnErrors<double> error;
    error[column::angular_velocity] = of_rates;
    error[column::lyapunov] = stated;
    rotor::detail::forget_parted(error);
    return error[column::lyapunov];
  };
  CHECK(lyapunov(infinity<double>, 0.2) == infinity<double>);
  CHECK(lyapunov(infinity<double>, 1e-6) == Approx(honesty::parted_margin * 1e-6));  // the phase alone is lost
  CHECK(lyapunov(0.5, 0.2) == 0.2);
}
