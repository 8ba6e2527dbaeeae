// SPDX-License-Identifier: BSD-3-Clause
// The functions of gyrostat.h.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "c_scene.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/gyrostat.h"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"
#include "gyrostat/ladder/general/propagator.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/version.hpp"

using gyrostat::c::Outcome;

struct gyrostat_answer {
  gyrostat::Answer answer;
};

struct gyrostat_propagator {
  gyrostat::general::Propagator propagator;
};

struct gyrostat_monitor {
  gyrostat::Monitor monitor;
};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free,
              "a signal handler may cancel");

namespace {

thread_local char last_message[1024] = "";

int refuse(int code, const char* why) noexcept {
  std::snprintf(last_message, sizeof last_message, "%s", why);
  return code;
}

/// What work() came to, as a code, with its message kept; what it throws included.
template <class Work>
int told(const Work& work) noexcept {
#if defined(__cpp_exceptions)
  try {
#endif
    const Outcome outcome = work();
    return outcome.code == GYROSTAT_OK ? GYROSTAT_OK : refuse(outcome.code, outcome.why.c_str());
#if defined(__cpp_exceptions)
  } catch (const std::bad_alloc&) {
    return refuse(GYROSTAT_NO_MEMORY, "there is no memory for it");
  } catch (const std::length_error&) {
    return refuse(GYROSTAT_BAD_ARGUMENT, "an array is longer than memory can be");
  } catch (...) {
    return refuse(GYROSTAT_BAD_ARGUMENT, "an exception that nobody expects");
  }
#endif
}

Outcome no_pointer(const char* what) { return {GYROSTAT_BAD_ARGUMENT, std::string(what) + " is NULL"}; }

/// The torque of a scene's own; lost_at: told when it has no finite value.
gyrostat::general::OwnTorque own_torque(const gyrostat_scene& given, double& lost_at) {
  using namespace gyrostat;
  if (given.torque == nullptr) return {};
  const auto call = [](const void* law, double t, const general::Seen<double>& seen) noexcept -> Vec3<double> {
    const auto& scene = *static_cast<const gyrostat_scene*>(law);
    const auto state = general::numbers_of(seen);
    double torque[3] = {gyrostat::nan<double>, gyrostat::nan<double>, gyrostat::nan<double>};
    scene.torque(scene.torque_data, t, state.data(), torque);
    return {torque[0], torque[1], torque[2]};
  };
  return {call, &given, given.breakpoints, &lost_at};
}

Outcome answered(const gyrostat_scene& given, gyrostat::Monitor* monitor, std::unique_ptr<gyrostat_answer>& made) {
  using namespace gyrostat;
  if (auto wrong = c::complete(given, true); wrong.code != GYROSTAT_OK) return wrong;
  const auto problem = c::problem_of(given);
  const auto scene = general::Scene::make(problem, given.question, given.recognise);
  if (!scene) return {GYROSTAT_BAD_SCENE, c::fault_of(problem, scene.error())};
  for (const AskedQuantity& each : given.question.asked)
    if (!each.scalar && !scene->has_column(each.place))
      return {GYROSTAT_BAD_SCENE, std::string("this scene has no column ") + general::column_kinds[each.place].name +
                                      ": do not ask for it, or add what it is of (docs/columns.md)"};
  Refusal refusal;
  made = std::make_unique<gyrostat_answer>();
  double lost_at = gyrostat::nan<double>;
  made->answer =
      general::solve(scene->known_within(given.start_error).driven_by(own_torque(given, lost_at)), refusal, monitor);
  if (refusal.code == Errc::ok) return {};
  if (refusal.code == Errc::cancelled) return {GYROSTAT_CANCELLED, refusal.why};
  auto why = std::string("model ") + refusal.model + ": " + refusal.why;
  if (lost_at == lost_at) {
    char when[40];
    std::snprintf(when, sizeof when, ", at t = %.9g s", lost_at);
    why += when;
  }
  return {GYROSTAT_NO_ANSWER, why};
}

Outcome prepared(const gyrostat_scene& given, std::unique_ptr<gyrostat_propagator>& made) {
  using namespace gyrostat;
  if (auto wrong = c::complete(given, false); wrong.code != GYROSTAT_OK) return wrong;
  if (given.torque != nullptr)
    return {GYROSTAT_BAD_SCENE, "a propagator takes no torque of your own: ask gyrostat_solve for the span"};
  const auto problem = c::problem_of(given);
  const auto propagator = general::Propagator::make(problem, given.question.tolerance);
  if (propagator) {
    made = std::make_unique<gyrostat_propagator>(gyrostat_propagator{*propagator});
    return {};
  }
  if (propagator.error() != Errc::not_applicable || general::check(problem))
    return {GYROSTAT_BAD_SCENE, c::fault_of(problem, propagator.error())};
  return {GYROSTAT_BAD_SCENE, std::string(general::Propagator::clock_needed(problem)) +
                                  ", and a state does not tell the time: ask gyrostat_solve for the span"};
}

/// The outcome of a step that a propagator refused.
Outcome not_moved(gyrostat::Errc wrong) {
  using gyrostat::Errc;
  switch (wrong) {
    case Errc::not_finite:
      return {GYROSTAT_BAD_ARGUMENT, "dt or a number of the state is NaN, infinite, or so large that its square is"};
    case Errc::negative: return {GYROSTAT_BAD_ARGUMENT, "dt is negative: give a number >= 0"};
    case Errc::out_of_domain:
      return {GYROSTAT_BAD_ARGUMENT,
              "attitude is not a unit quaternion to 1e-6, a locked wheel has a rate, or dt holds more turns of a field "
              "than a double counts"};
    case Errc::not_applicable:
      return {
          GYROSTAT_NO_ANSWER,
          "a brake brings the momentum that it opposes to zero within dt, where wheels or other torques set the body "
          "going again in a way that is not followed: give a shorter dt"};
    case Errc::undetermined:
      return {GYROSTAT_NO_ANSWER,
              "the body turns so often within dt that no double knows its phase: give a shorter dt"};
    default: return {GYROSTAT_NO_ANSWER, std::string(message(wrong)) + ": give a shorter dt"};
  }
}

Outcome moved(const gyrostat_propagator& given, double dt, double* attitude, double* angular_velocity,
              double* rotor_rate, double* error) {
  const std::size_t wheels = given.propagator.wheels();
  gyrostat::general::Moving state;
  state.attitude = {attitude[3], attitude[0], attitude[1], attitude[2]};
  state.angular_velocity = {angular_velocity[0], angular_velocity[1], angular_velocity[2]};
  std::copy_n(rotor_rate, wheels, state.rotor_rate.begin());
  gyrostat::general::MovedError off;
  const auto wrong = given.propagator.advance(dt, state, error != nullptr ? &off : nullptr);
  if (wrong != gyrostat::Errc::ok) return not_moved(wrong);
  const auto& q = state.attitude;
  const double turned[] = {q.x, q.y, q.z, q.w};
  std::copy_n(turned, 4, attitude);
  std::copy_n(state.angular_velocity.data(), 3, angular_velocity);
  std::copy_n(state.rotor_rate.begin(), wheels, rotor_rate);
  if (error == nullptr) return {};
  const double errors[] = {off.attitude, off.angular_velocity, off.rotor_rate};
  std::copy_n(errors, 3, error);
  return {};
}

/// What is asked of an answer by a name that it has not, or has of the other kind.
Outcome nothing_called(const gyrostat::Answer& answer, const char* name) {
  if (answer.find(name) != nullptr)
    return {GYROSTAT_BAD_ARGUMENT, std::string(name) + " is a column: have it by gyrostat_answer_column"};
  if (answer.quantity(name) != nullptr)
    return {GYROSTAT_BAD_ARGUMENT, std::string(name) + " is a scalar: have it by gyrostat_answer_scalar"};
  std::vector<std::string> names;
  for (const auto& column : answer.columns) names.emplace_back(column.name());
  for (const auto& quantity : answer.quantities) names.emplace_back(quantity.name());
  return {GYROSTAT_BAD_ARGUMENT, std::string("the answer has no ") + name + ": ask for it by gyrostat_ask; it has " +
                                     gyrostat::c::one_of(names)};
}

const gyrostat::Warning* warning_at(const gyrostat_answer* answer, size_t place) noexcept {
  return answer != nullptr && place < answer->answer.warnings.size() ? &answer->answer.warnings[place] : nullptr;
}

}  // namespace

extern "C" {

const char* gyrostat_version(void) { return gyrostat::library_version(); }
const char* gyrostat_message(void) { return last_message; }

gyrostat_scene* gyrostat_scene_new(void) { return new (std::nothrow) gyrostat_scene; }
void gyrostat_scene_free(gyrostat_scene* scene) { delete scene; }

int gyrostat_add(gyrostat_scene* scene, const char* what, const char* type) {
  return told([&] {
    if (scene == nullptr) return no_pointer("scene");
    if (what == nullptr || type == nullptr) return no_pointer(what == nullptr ? "what" : "type");
    return gyrostat::c::add(*scene, what, type);
  });
}

int gyrostat_set(gyrostat_scene* scene, const char* key, const double* values, size_t count) {
  return told([&] {
    if (scene == nullptr) return no_pointer("scene");
    if (key == nullptr || values == nullptr) return no_pointer(key == nullptr ? "key" : "values");
    return gyrostat::c::set(*scene, key, {values, count});
  });
}

int gyrostat_set_number(gyrostat_scene* scene, const char* key, double value) {
  return gyrostat_set(scene, key, &value, 1);
}

int gyrostat_set_word(gyrostat_scene* scene, const char* key, const char* word) {
  return told([&] {
    if (scene == nullptr) return no_pointer("scene");
    if (key == nullptr || word == nullptr) return no_pointer(key == nullptr ? "key" : "word");
    return gyrostat::c::set_word(*scene, key, word);
  });
}

int gyrostat_ask(gyrostat_scene* scene, const char* name, double tolerance) {
  return told([&] {
    if (scene == nullptr || name == nullptr) return no_pointer(scene == nullptr ? "scene" : "name");
    return gyrostat::c::ask(*scene, name, tolerance);
  });
}

int gyrostat_drive(gyrostat_scene* scene, gyrostat_torque torque, void* data, const double* breakpoints, size_t count) {
  return told([&] {
    if (scene == nullptr) return no_pointer("scene");
    if (breakpoints == nullptr && count > 0) return no_pointer("breakpoints");
    return gyrostat::c::drive(*scene, torque, data, {breakpoints, count});
  });
}

int gyrostat_solve(const gyrostat_scene* scene, gyrostat_answer** answer) {
  return gyrostat_solve_watched(scene, nullptr, answer);
}

int gyrostat_solve_watched(const gyrostat_scene* scene, gyrostat_monitor* monitor, gyrostat_answer** answer) {
  if (answer != nullptr) *answer = nullptr;
  const int code = told([&] {
    if (scene == nullptr || answer == nullptr) return no_pointer(scene == nullptr ? "scene" : "answer");
    std::unique_ptr<gyrostat_answer> made;
    auto outcome = answered(*scene, monitor != nullptr ? &monitor->monitor : nullptr, made);
    if (outcome.code == GYROSTAT_OK) *answer = made.release();
    return outcome;
  });
  if (monitor != nullptr) monitor->monitor.fraction.store(1);  // whatever came of it: who waits for it must not wait on
  return code;
}
void gyrostat_answer_free(gyrostat_answer* answer) { delete answer; }

gyrostat_monitor* gyrostat_monitor_new(void) { return new (std::nothrow) gyrostat_monitor; }
void gyrostat_monitor_free(gyrostat_monitor* monitor) { delete monitor; }
double gyrostat_monitor_fraction(const gyrostat_monitor* monitor) {
  return monitor != nullptr ? monitor->monitor.fraction.load() : 0;
}
void gyrostat_monitor_cancel(gyrostat_monitor* monitor) {
  if (monitor != nullptr) monitor->monitor.cancel.store(true);
}

const char* gyrostat_answer_model(const gyrostat_answer* answer) {
  return answer != nullptr ? answer->answer.model : nullptr;
}
int gyrostat_answer_met(const gyrostat_answer* answer) { return answer != nullptr && answer->answer.met ? 1 : 0; }
size_t gyrostat_answer_columns(const gyrostat_answer* answer) {
  return answer != nullptr ? answer->answer.columns.size() : 0;
}
const char* gyrostat_answer_column_name(const gyrostat_answer* answer, size_t place) {
  return place < gyrostat_answer_columns(answer) ? answer->answer.columns[place].kind->name : nullptr;
}

int gyrostat_answer_column(const gyrostat_answer* answer, const char* name, const double** values, size_t* rows,
                           size_t* width) {
  return told([&]() -> Outcome {
    if (answer == nullptr || name == nullptr) return no_pointer(answer == nullptr ? "answer" : "name");
    const gyrostat::Column* column = answer->answer.find(name);
    if (column == nullptr) return nothing_called(answer->answer, name);
    if (values != nullptr) *values = column->values.data();
    if (rows != nullptr) *rows = answer->answer.times.size();
    if (width != nullptr) *width = size_t(column->row_width());
    return {};
  });
}

int gyrostat_answer_error(const gyrostat_answer* answer, const char* name, double* error, double* size) {
  return told([&]() -> Outcome {
    using gyrostat::Measure;
    if (answer == nullptr || name == nullptr) return no_pointer(answer == nullptr ? "answer" : "name");
    const gyrostat::Column* column = answer->answer.find(name);
    const gyrostat::Quantity* quantity = answer->answer.quantity(name);
    if (column == nullptr && quantity == nullptr) return nothing_called(answer->answer, name);
    const Measure measure = column != nullptr ? column->kind->measure : quantity->kind->measure;
    const double stated = column != nullptr ? column->error : quantity->error;
    double relative_to = 1;
    if (measure == Measure::relative)
      relative_to = column != nullptr ? gyrostat::size_of(*column) : gyrostat::size_of(*quantity);
    if (error != nullptr) *error = measure == Measure::none ? gyrostat::nan<double> : stated;
    if (size != nullptr) *size = relative_to;
    return {};
  });
}

int gyrostat_answer_scalar(const gyrostat_answer* answer, const char* name, double* value) {
  return told([&]() -> Outcome {
    if (answer == nullptr || name == nullptr) return no_pointer(answer == nullptr ? "answer" : "name");
    if (value == nullptr) return no_pointer("value");
    const gyrostat::Quantity* quantity = answer->answer.quantity(name);
    if (quantity == nullptr && gyrostat::place_of(gyrostat::general::tables.scalars, name) < 0)
      return nothing_called(answer->answer, name);
    *value = quantity != nullptr ? quantity->values[0] : gyrostat::nan<double>;
    return {};
  });
}

size_t gyrostat_answer_warnings(const gyrostat_answer* answer) {
  return answer != nullptr ? answer->answer.warnings.size() : 0;
}
const char* gyrostat_answer_warning_code(const gyrostat_answer* answer, size_t place) {
  const auto* warning = warning_at(answer, place);
  return warning != nullptr ? warning->kind->code : nullptr;
}
const char* gyrostat_answer_warning_text(const gyrostat_answer* answer, size_t place) {
  const auto* warning = warning_at(answer, place);
  return warning != nullptr ? warning->text : nullptr;
}
double gyrostat_answer_warning_value(const gyrostat_answer* answer, size_t place) {
  const auto* warning = warning_at(answer, place);
  return warning != nullptr ? warning->value : gyrostat::nan<double>;
}

int gyrostat_propagator_new(const gyrostat_scene* scene, gyrostat_propagator** propagator) {
  if (propagator != nullptr) *propagator = nullptr;
  return told([&] {
    if (scene == nullptr || propagator == nullptr) return no_pointer(scene == nullptr ? "scene" : "propagator");
    std::unique_ptr<gyrostat_propagator> made;
    auto outcome = prepared(*scene, made);
    if (outcome.code == GYROSTAT_OK) *propagator = made.release();
    return outcome;
  });
}
void gyrostat_propagator_free(gyrostat_propagator* propagator) { delete propagator; }
size_t gyrostat_propagator_wheels(const gyrostat_propagator* propagator) {
  return propagator != nullptr ? propagator->propagator.wheels() : 0;
}
int gyrostat_propagator_is_closed_form(const gyrostat_propagator* propagator) {
  return propagator != nullptr && propagator->propagator.is_closed_form() ? 1 : 0;
}

int gyrostat_propagate(const gyrostat_propagator* propagator, double dt, double* attitude, double* angular_velocity,
                       double* rotor_rate, double* error) {
  return told([&] {
    if (propagator == nullptr) return no_pointer("propagator");
    if (attitude == nullptr || angular_velocity == nullptr)
      return no_pointer(attitude == nullptr ? "attitude" : "angular_velocity");
    if (rotor_rate == nullptr && propagator->propagator.wheels() > 0) return no_pointer("rotor_rate");
    return moved(*propagator, dt, attitude, angular_velocity, rotor_rate, error);
  });
}

}  // extern "C"
