// SPDX-License-Identifier: BSD-3-Clause
// Every header in one program without exceptions and without run-time type information.
#include "gyrostat/gyrostat.hpp"

#include <cstdio>
#include <cstring>

#if defined(__cpp_exceptions) || defined(__cpp_rtti)
#error "this program shows that gyrostat needs neither exceptions nor run-time type information"
#endif

namespace {

int failures = 0;

void check(bool right, const char* what) {
  std::printf("%s %s\n", right ? "ok  " : "FAIL", what);
  if (!right) ++failures;
}

/// A body of three unequal moments, slowed down by unequal torques: the ladder answers, from the headers alone.
bool despins() {
  namespace dec = gyrostat::deceleration;
  const auto body = gyrostat::Inertia<double>::from_moments(35, 22, 16);
  dec::Setup setup;
  setup.control = {5e-3, 8e-3, 10e-3};
  setup.drag = 2e-4;
  setup.momentum = {40, 25, 16.5};
  gyrostat::Question question;
  question.times = {0, 1000, 2000};
  question.tolerance = 1e-4;
  const auto scene = dec::Scene::make(*body, setup, question);
  if (!body || !scene) return false;
  gyrostat::Refusal refusal;
  const gyrostat::Answer answer = dec::solve<gyrostat::math::Native>(*scene, refusal);
  const gyrostat::Column* norm = answer.find("angular_momentum_norm");
  return answer.met && norm != nullptr && norm->values[0] > norm->values[1] && norm->values[1] > norm->values[2];
}

bool refuses() {
  return gyrostat::Inertia<double>::from_moments(1, 1, 3).error() == gyrostat::Errc::triangle_inequality;
}

}  // namespace

int main() {
  check(std::strcmp(gyrostat::library_version(), gyrostat::header_version) == 0,
        "library and headers are of one version");
  check(despins(), "the ladder answers a scene");
  check(refuses(), "a failure comes back as a value");
  return failures == 0 ? 0 : 1;
}
