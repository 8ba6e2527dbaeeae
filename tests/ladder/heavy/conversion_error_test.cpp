// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/conversion_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "catch.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/rotation/symmetric.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

/// A scene as it is given: a tensor, and down or an attitude.
struct Given {
  std::array<double, 9> inertia;
  Vec3<double> centre;
  double gravity, gradient;
  Vec3<double> rate, down;
  std::optional<Quat<double>> attitude;
  std::vector<double> times;
  double tolerance;

  template <Real S>
  Mat3<S> tensor() const {
    Mat3<S> made;
    for (int i = 0; i < 9; ++i) made(i / 3, i % 3) = inertia[std::size_t(i)];
    return made;
  }
};

/// Slim tops by full tensors; swings let go at rest, or nearly upright, whose parts off the plane are rounding.
const Given scenes[] = {
    {{0.001135674394878247, 0.0159699385536679, -0.024211815374705258, 0.0159699385536679, 0.7419498007214338,
      0.0005216985868539614, -0.024211815374705258, 0.0005216985868539614, 0.7415029689239638},
     {0.3514849839115895, -0.007573542775261754, 0.011482149338950058},
     9.80665,
     0.0,
     {-0.10025636658710227, 0.9538175054604588, -1.6082791064003288},
     {0.1641194478753487, 0.864749699207994, 0.47462908101882534},
     std::nullopt,
     {0.0, 0.8571558420556754, 1.6071672038543914},
     1e-11},
    {{0.19815613490190645, 0.0522349350498051, -0.028113240758223548, 0.0522349350498051, 0.06226505573736372,
      0.08269506983409466, -0.028113240758223548, 0.08269506983409466, 0.17140694762463443},
     {-0.050138979357117766, 0.1474837580983702, -0.07937688436663526},
     9.80665,
     0.0,
     {0.1312832450892377, -0.904975562416962, -0.5359237429781074},
     {0.0, 0.0, -1.0},
     Quat<double>{0.6747331387004672, 0.5061137740825531, -0.48213003506937224, 0.23692755961967862},
     {1.3926640791723237},
     1e-09},
    {{0.16477533435449823, -0.05658011563766309, 0.08890467302694315, -0.05658011563766309, 0.18467296065216762,
      0.07463596971283756, 0.08890467302694315, 0.07463596971283756, 0.11489633965812576},
     {0.03823290048188702, 0.032096733560172515, -0.050433788800893845},
     9.80665,
     0.0,
     {-1.158753241913644, -1.0033261950544938, 2.2459104075484957},
     {-0.5498905076002761, -0.8266561553258608, 0.11941536966813368},
     std::nullopt,
     {0.0, 2.6075333891862087, 5.2150667783724165},
     1e-09},
    {{0.0675297386784443, -0.020873030501447613, -0.049238377449687135, -0.020873030501447613, 0.09959604625582656,
      -0.02426626281589712, -0.049238377449687135, -0.02426626281589712, 0.052640116476509284},
     {-0.13301805838147054, -0.06555559567825728, -0.1546421907313004},
     9.80665,
     0.0,
     {1.7794419934920307, 1.8507062379893973, -0.8915655046568793},
     {0.0, 0.0, -1.0},
     Quat<double>{0.6221880101515418, -0.37627998096207543, -0.2670790689117239, -0.6324272502826644},
     {0.0023950272780268946, 0.4152004721094681, 0.8807978213233545},
     1e-09},
    {{0.4103524930505425, 0.0, 0.0, 0.0, 0.37283931510386864, 0.0, 0.0, 0.0, 0.08351787321277628},
     {-0.018385713909950568, 0.0, 0.0},
     0.0,
     0.012543632128898297,
     {0.0, 0.0, 0.0},
     {0.0, 0.0, -1.0},
     Quat<double>{-0.01906974152598329, 0.1306480567963307, -0.6949324321510277, -0.7068495914677552},
     {0.0, 353.65972754647515, 691.9429451996252},
     1e-06},
    {{0.9616084582278099, 0.0, 0.0, 0.0, 1.6477675296401202, 0.0, 0.0, 0.0, 0.9760152787861923},
     {0.049010074581910076, 0.0, 0.0},
     9.80665,
     0.0,
     {0.0, 0.0, 0.0},
     {0.0, 0.0, -1.0},
     Quat<double>{0.6987277870989784, 0.10853331071963324, -0.6987277870989788, 0.1085333107196332},
     {0.741152233674841, 28.285520920515317, 51.50456206769607},
     1e-06},
    {{0.21410968802223035, 0.0033121423386555746, 0.04669099792148615, 0.0033121423386555746, 0.19981446250911936,
      0.010292425084754656, 0.04669099792148615, 0.010292425084754656, 0.3441758129141393},
     {-0.011687824951447058, -0.002576429463314972, -0.03631971407524828},
     9.80665,
     0.0,
     {0.3167198851861375, 0.06981679202085166, 0.9842015704112493},
     {0.30563692777186324, 0.06737369776324421, 0.949761471755874},
     std::nullopt,
     {0.0, 21.250177722703448, 41.08367693056},
     1e-06},
    {{0.951922279466145, 0.0, 0.0, 0.0, 0.9148540855031269, 0.0, 0.0, 0.0, 0.12528238680193893},
     {0.15464591523047022, 0.0, 0.0},
     0.0,
     2.522695781138363,
     {0.0, -0.0, 0.0},
     {0.0, 0.0, -1.0},
     Quat<double>{0.23236064726613104, 0.6593450924265729, -0.2258216888368061, 0.6784372804806288},
     {104.85560757451509, 104.96056803769719, 104.96056814265775},
     1e-06},
    {{0.6418378038189723, 0.0, 0.0, 0.0, 0.28057287621212856, 0.0, 0.0, 0.0, 0.5214428014214753},
     {0.0, 0.14926631732264095, 0.07543887512004813},
     9.80665,
     0.0,
     {0.0, 0.0, 0.0},
     {-0.0, -0.8924918744374335, -0.45106347010499137},
     std::nullopt,
     {0.0, 9.238136888035429, 18.476273776070858},
     1e-06},
    // slim, across two moments that are nearly equal: their axes are known to rounding over the difference
    {{0.98183664006236571, 0.12065909085349667, -0.057226032239601377, 0.12065909085349667, 0.19846238495625657,
      0.38015218808038143, -0.057226032239601377, 0.38015218808038143, 0.81970192865569391},
     {-0.032335853858175952, 0.21480688275163015, -0.10187832106706762},
     0.0,
     0.0002793411229740062,
     {-0.052143009575265936, -0.12263019835481163, -0.24201880429979084},
     {0.0, 0.0, -1.0},
     Quat<double>{-0.64656809945209692, 0.3864394906819475, -0.546821007100599, -0.36551470422661125},
     {0.0, 66.224290883297627, 132.44858176659525},
     1e-08},
};

Answer answer_of(const Given& given, int rung) {
  const auto body = Body::make(given.tensor<double>(), 1, given.centre, given.gravity, given.gradient);
  REQUIRE(body);
  Start start{{given.rate, given.down, given.attitude.value_or(Quat<double>{})}};
  Question question;
  question.times = given.times;
  question.tolerance = given.tolerance;
  question.wants_attitude = given.attitude.has_value();
  question.rung = rung;
  Refusal refusal;
  const auto scene = Scene::make(*body, start, question);
  REQUIRE(scene);
  const Answer answer = heavy::solve(*scene, refusal);
  REQUIRE(refusal.code == Errc::ok);
  return answer;
}

/// Rates and down at the times in long double, conversions too; and what they are known to.
struct Truth {
  std::vector<Vec3<double>> rate, down;
  double error;
};

Truth truth_of(const Given& given) {
  using Long = long double;
  const auto eigen = symmetric_eigen<Long>(given.tensor<Long>());
  Mat3<Long> R = eigen.axes;
  if (R.determinant() < 0) R.col(0) *= -1;
  const Vec3<Long> moments(eigen.values[0], eigen.values[1], eigen.values[2]);
  const auto problem =
      Problem<Long>::make(moments, 1, R.transpose() * given.centre.cast<Long>(), given.gravity, given.gradient);
  REQUIRE(problem);
  Vec3<Long> down = given.down.cast<Long>();
  if (given.attitude) {
    const auto& q = *given.attitude;
    down = rotate<Long>(conjugate(normalised(Quat<Long>{q.w, q.x, q.y, q.z})), Vec3<Long>(0, 0, -1));
  }
  const State<Long> start{R.transpose() * given.rate.cast<Long>(), (R.transpose() * down).normalized(), {}};
  const std::vector<Long> times(given.times.begin(), given.times.end());
  std::vector<State<Long>> states(times.size());
  FullMotionOptions<Long> options;
  options.tolerance = 1e-14L;
  const auto made = full_motion<Long>(*problem, start, times, states, options);
  REQUIRE(made);
  REQUIRE(made->status == ode::Status::reached);
  Truth truth{{}, {}, double(made->error.greatest())};
  for (const auto& s : states) {
    truth.rate.push_back((R * s.angular_velocity).template cast<double>());
    truth.down.push_back((R * s.down).template cast<double>());
  }
  return truth;
}

}  // namespace

TEST_CASE("what conversions of body and start make of a motion is in its error", "[heavy]") {
  int which = 0;
  for (const Given& given : scenes) {
    const Truth truth = truth_of(given);
    for (const int rung : {any_rung, int(rung::exact)}) {
      if (rung != any_rung && which == int(std::size(scenes)) - 1) continue;  // has no closed form
      const Answer answer = answer_of(given, rung);
      CAPTURE(which, rung, answer.model, answer.met, truth.error);
      const auto check = [&](const char* name, const std::vector<Vec3<double>>& right) {
        const Column& column = *answer.find(name);
        double most = 0, size = column.scale;
        for (std::size_t i = 0; i < right.size(); ++i) {
          const Vec3<double> here(column.values[3 * i], column.values[3 * i + 1], column.values[3 * i + 2]);
          most = std::max(most, (here - right[i]).norm());
          size = std::max(size, right[i].norm());
        }
        CAPTURE(name, most / size, column.error);
        CHECK(most / size <= column.error + truth.error + 1e-15);
        if (answer.met) CHECK(most / size <= given.tolerance + truth.error);
      };
      check("angular_velocity", truth.rate);
      check("down", truth.down);
    }
    ++which;
  }
}

TEST_CASE("a start that is given in principal axes is known to its last bit", "[heavy]") {
  // upright without a tilt: it stays, however long
  const auto top = Problem<double>::make({0.0016, 0.0016, 0.002}, 0.8, {0, 0, 0.01}, 9.80665, 0).value();
  Body body;
  body.problem = top;
  Question question;
  question.times = {0, 100};
  Start start;
  start.state.angular_velocity = {0, 0, 5};
  Refusal refusal;
  const Answer answer = heavy::solve(*Scene::make(body, start, question), refusal);
  CHECK(answer.met);
  CHECK(answer.find("down")->values[5] == -1);
  // from an attitude it is not known to stay
  question.wants_attitude = true;
  CHECK_FALSE(heavy::solve(*Scene::make(body, start, question), refusal).met);
}

TEST_CASE("motions are compared evenly, and where the body turns fastest", "[heavy]") {
  std::vector<double> times;
  std::vector<State<double>> states(100);
  for (std::size_t i = 0; i < states.size(); ++i) {
    times.push_back(0.5 * double(i));
    states[i].angular_velocity = {0, 0, i % 10 == 7 ? 5.0 : 1.0};
  }
  const auto looks = times_to_compare(times, states);
  CHECK(std::is_sorted(looks.begin(), looks.end()));
  CHECK(looks.front() == 0);
  CHECK(looks.back() == times.back());
  CHECK(looks.size() == 9 + 32);
  for (std::size_t i = 7; i < states.size(); i += 10) CHECK(std::count(looks.begin(), looks.end(), times[i]) > 0);
  const std::vector<double> once{3};
  CHECK(times_to_compare(once, std::vector<State<double>>(1)).back() == 3);
  const std::vector<double> at_start{0};
  const auto at_once = times_to_compare(at_start, std::vector<State<double>>(1));
  CHECK(std::count(at_once.begin(), at_once.end(), 0.0) == std::ptrdiff_t(at_once.size()));
}
