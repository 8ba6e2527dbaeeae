// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "asked.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"

/// Scenes for the tests of the ladder, their true answers, and the comparison of the two.
namespace scenes {

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

inline std::vector<double> until(double end, int n = 6) {
  std::vector<double> t;
  for (int i = 1; i <= n; ++i) t.push_back(end * i / n);
  return t;
}

/// The body A, B, C = 1.4, 1, 0.7 under b = (0.6, 0.9, 1) eps and drag 0.3 eps, unless said otherwise.
struct Case {
  V moments{1.4, 1, .7};
  Asked data;

  Case() = default;
  explicit Case(double eps, double end) {
    data.control = eps * V(.6, .9, 1);
    data.drag = .3 * eps;
    data.momentum = V(.8, .5, .33);
    data.momentum.normalize();
    data.times = until(end);
  }

  Scene scene() const {
    const auto body = Inertia<double>::from_moments(moments[0], moments[1], moments[2]);
    REQUIRE(body);
    const auto made = make_scene(*body, data);
    REQUIRE(made);
    return *made;
  }

  Answer solve(Refusal& refusal) const { return deceleration::solve<>(scene(), refusal); }

  /// Must answer.
  Answer solve() const {
    Refusal refusal;
    const Answer answer = solve(refusal);
    INFO(refusal.model << ": " << (refusal.why ? refusal.why : ""));
    REQUIRE(refusal.code == Errc::ok);
    return answer;
  }

  Case with(int model, double tolerance) const {
    Case c = *this;
    c.data.rung = model;
    c.data.tolerance = tolerance;
    return c;
  }

  /// The full equations, far finer than what is compared with them.
  Answer truth(double tolerance = 1e-11) const { return with(rung::full, tolerance).solve(); }
};

inline bool warns(const Answer& answer, const char* code) { return answer.warns(code); }

inline double quantity(const Answer& answer, const char* name) {
  const Quantity* found = answer.quantity(name);
  return found ? found->values[0] : gyrostat::nan<double>;
}

/// Why a model was passed over; empty if it was not looked at or answered.
inline std::string passed_over(const Answer& answer, const char* model) {
  for (const Attempt& a : answer.tried)
    if (std::strcmp(a.model, model) == 0) return a.why ? a.why : "";
  return "";
}

/// The errors that an answer states, for messages.
inline std::string stated(const Answer& answer) {
  std::string text = answer.model;
  for (const Column& c : answer.columns)
    text += std::string(" ") + c.kind->name + " " + Catch::Detail::stringify(c.error * 1e9) + "e-9";
  return text;
}

/// Greatest difference over the times, over the greatest norm in the reference or the scale (k2: absolute; attitude: an angle); NaN counts
/// as infinite.
inline double distance(const Answer& answer, const Answer& reference, const char* name) {
  const Column *a = answer.find(name), *r = reference.find(name);
  REQUIRE(a);
  REQUIRE(r);
  REQUIRE(a->values.size() == r->values.size());
  REQUIRE(a->values.size() == std::size_t(a->kind->width) * answer.times.size());
  const std::size_t width = std::size_t(a->kind->width);
  double worst = 0, size = r->scale;
  for (std::size_t i = 0; i < a->values.size(); i += width) {
    double difference = 0, norm = 0, along = 0;
    for (std::size_t j = i; j < i + width; ++j) along += a->values[j] * r->values[j];
    const double sign = a->kind->measure == Measure::angle && along < 0 ? -1 : 1;
    for (std::size_t j = i; j < i + width; ++j) {
      difference += (sign * a->values[j] - r->values[j]) * (sign * a->values[j] - r->values[j]);
      norm += r->values[j] * r->values[j];
    }
    if (!(std::sqrt(difference) <= worst)) worst = std::sqrt(difference);
    size = std::max(size, std::sqrt(norm));
  }
  if (std::isnan(worst)) return infinity<double>;
  if (a->kind->measure == Measure::angle) return 2 * worst;
  if (std::strcmp(name, "modulus_squared") == 0 || size == 0) return worst;
  return worst / size;
}

/// Every column and the stop time are as near the truth as they say.
inline void check_honest(const Answer& answer, const Answer& truth, double reference_error = 2e-11) {
  CAPTURE(answer.model, answer.error);
  for (const Column& column : answer.columns) {
    if (column.kind->measure == Measure::none) continue;
    if (!truth.find(column.name())) continue;
    INFO(column.kind->name);
    CHECK(std::isfinite(column.error));
    CHECK(column.error <= answer.error);
    CHECK(distance(answer, truth, column.kind->name) <= column.error + reference_error);
  }
  const double stop = quantity(answer, "stop_time"), right = quantity(truth, "stop_time");
  if (!std::isnan(stop) && !std::isnan(right)) {
    CAPTURE(stop, right);
    if (std::isinf(right) || std::isinf(stop)) CHECK(stop == right);
    else CHECK(std::abs(stop - right) <= (answer.error + reference_error) * right);
  }
  CHECK(answer.met == (answer.error <= answer.tolerance));
}

}  // namespace scenes
