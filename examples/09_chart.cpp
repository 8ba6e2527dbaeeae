// SPDX-License-Identifier: BSD-3-Clause
// What does accuracy cost? Each rung of the ladder on one scene, an unsymmetric top in its periodic motion: the error that it states, the true one, the time.
#include <chrono>
#include <cmath>
#include <cstdio>

#include "gyrostat/heavy.hpp"

using namespace gyrostat;

namespace {

/// The rates after some fifty turns, by one rung alone.
Answer answer_of(int rung, double tolerance, Refusal& refusal) {
  const auto body =
      heavy::Body::make(Vec3<double>(0.0011, 0.0016, 0.0020).asDiagonal(), 0.8, {0.012, 0.009, 0.010}, 9.80665, 0);
  heavy::Start start;
  start.periodic = {150, 0.1};  // rad/s about axis 3, and the cosine of its inclination to down
  Question question;
  question.times = {2};  // s
  question.tolerance = tolerance;
  question.rung = rung;
  return heavy::solve(*heavy::Scene::make(*body, start, question), refusal);
}

Vec3<double> rates(const Answer& answer) { return Vec3<double>(answer.find("angular_velocity")->values.data()); }

}  // namespace

int main() {
  Refusal refusal;
  const Vec3<double> truth = rates(answer_of(heavy::rung::full, 1e-13, refusal));
  if (refusal.code != Errc::ok) return std::puts(refusal.why), 1;
  std::puts("rung      tolerance  stated error  true error      time");
  double boldest = 0;
  for (const int rung : {heavy::rung::series_2, heavy::rung::series, heavy::rung::full}) {
    for (const double tolerance : {1e-2, 1e-5, 1e-8}) {
      const auto begin = std::chrono::steady_clock::now();
      const Answer answer = answer_of(rung, tolerance, refusal);
      const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
      if (refusal.code != Errc::ok) {
        std::printf("%s refuses: %s\n", refusal.model, refusal.why);
        continue;
      }
      const double stated = answer.find("angular_velocity")->error,
                   error = (rates(answer) - truth).norm() / truth.norm();
      std::printf("%-9s %9.0e  %12.1e  %10.1e  %5.0f us  %s\n", answer.model, tolerance, stated, error, took.count(),
                  answer.met ? "" : "not met");
      boldest = std::fmax(boldest, error / stated);
    }
  }
  std::printf("true error at most %.6f of the stated one\n", boldest);
}
