/* SPDX-License-Identifier: BSD-3-Clause */
/* The C interface: motions that are known in closed form, and every kind of refusal. C99, and nothing but the C library. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gyrostat/gyrostat.h"

static int failures = 0;

#define CHECK(what)                                                       \
  do {                                                                    \
    if (!(what)) {                                                        \
      printf("line %d: %s  [%s]\n", __LINE__, #what, gyrostat_message()); \
      ++failures;                                                         \
    }                                                                     \
  } while (0)
#define OK(call) CHECK((call) == GYROSTAT_OK)
/* The call is refused with this code, and the message holds these words. */
#define REFUSED(call, code, words)                      \
  do {                                                  \
    CHECK((call) == (code));                            \
    CHECK(strstr(gyrostat_message(), (words)) != NULL); \
  } while (0)

/* ---- what is known in closed form ---- */

typedef struct {
  double x, y, z, w;
} quaternion;

static quaternion product(quaternion a, quaternion b) {
  quaternion c;
  c.w = a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z;
  c.x = a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y;
  c.y = a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x;
  c.z = a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w;
  return c;
}

static quaternion turn(double x, double y, double z, double angle) {
  const double s = sin(angle / 2) / sqrt(x * x + y * y + z * z);
  quaternion q;
  q.x = s * x, q.y = s * y, q.z = s * z, q.w = cos(angle / 2);
  return q;
}

/* Angle of the rotation between an attitude [x, y, z, w] and q. */
static double angle_between(const double* a, quaternion q) {
  quaternion back, d;
  back.x = -a[0], back.y = -a[1], back.z = -a[2], back.w = a[3];
  d = product(back, q);
  return 2 * atan2(sqrt(d.x * d.x + d.y * d.y + d.z * d.z), fabs(d.w));
}

/* A body with moments A, A, C that starts with its axes along the inertial ones and the rates (p, 0, r): it turns about the momentum at
 * |M|/A, and about its axis at (1 - C/A) r beside that. */
static const double A = 2, C = 3, p = 0.2, r = 0.5;
static quaternion symmetric_attitude(double t) {
  const double M = sqrt(A * p * A * p + C * r * C * r);
  return product(turn(A * p, 0, C * r, M / A * t), turn(0, 0, 1, (1 - C / A) * r * t));
}
static void symmetric_rates(double t, double* rates) {
  const double phase = (C / A - 1) * r * t;
  rates[0] = p * cos(phase), rates[1] = p * sin(phase), rates[2] = r;
}

static double distance(const double* a, const double* b, int n) {
  double sum = 0;
  int i;
  for (i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum);
}

/* ---- scenes ---- */

static const double times[] = {0, 1, 10, 100};
enum { count = 4 };

/* A body with three moments and rates at the start, asked at `times`. */
static gyrostat_scene* body(double a, double b, double c, double wx, double wy, double wz) {
  const double moments[] = {a, b, c}, rates[] = {wx, wy, wz};
  gyrostat_scene* scene = gyrostat_scene_new();
  CHECK(scene != NULL);
  OK(gyrostat_set(scene, "body.inertia", moments, 3));
  OK(gyrostat_set(scene, "initial.angular_velocity", rates, 3));
  OK(gyrostat_set(scene, "solve.times", times, count));
  return scene;
}

/* Solves, frees the scene, and checks that the model begins so. */
static gyrostat_answer* solved(gyrostat_scene* scene, const char* model) {
  gyrostat_answer* answer = NULL;
  OK(gyrostat_solve(scene, &answer));
  gyrostat_scene_free(scene);
  CHECK(answer != NULL);
  if (answer == NULL) return NULL;
  CHECK(gyrostat_answer_met(answer) == 1);
  CHECK(strncmp(gyrostat_answer_model(answer), model, strlen(model)) == 0);
  return answer;
}

/* The column, and by how much it may be off. */
static const double* column(const gyrostat_answer* answer, const char* name, size_t width, double* within) {
  const double* values = NULL;
  size_t rows = 0, wide = 0;
  double error = NAN, size = NAN;
  OK(gyrostat_answer_column(answer, name, &values, &rows, &wide));
  OK(gyrostat_answer_error(answer, name, &error, &size));
  CHECK(rows == count && wide == width);
  CHECK(error >= 0 && size > 0);
  *within = error * size;
  return values;
}

static void free_symmetric_body(void) {
  gyrostat_scene* scene = body(A, A, C, p, 0, r);
  gyrostat_answer* answer;
  double turned_within, within, recognised = 0;
  const double *q, *w;
  int i;
  OK(gyrostat_set_word(scene, "solve.model", "free:closed-form"));
  OK(gyrostat_set_number(scene, "solve.tolerance", 1e-12)); /* a looser one has a quicker set-up, and a wider error */
  answer = solved(scene, "free:closed-form");
  if (answer == NULL) return;
  q = column(answer, "attitude", 4, &turned_within);
  w = column(answer, "angular_velocity", 3, &within);
  CHECK(turned_within < 1e-12 && within < 1e-12);
  for (i = 0; i < count; ++i) {
    double rates[3];
    symmetric_rates(times[i], rates);
    CHECK(distance(w + 3 * i, rates, 3) <= within + 1e-15);
    CHECK(angle_between(q + 4 * i, symmetric_attitude(times[i])) <= turned_within + 1e-15 * (1 + times[i]));
  }
  OK(gyrostat_answer_scalar(answer, "recognised", &recognised));
  CHECK(((int)recognised & 1) == 1);
  OK(gyrostat_answer_scalar(answer, "stop_time", &recognised));
  CHECK(isnan(recognised));
  CHECK(gyrostat_answer_columns(answer) >= 2);
  CHECK(strcmp(gyrostat_answer_column_name(answer, 0), "attitude") == 0);
  CHECK(gyrostat_answer_column_name(answer, 100) == NULL);
  CHECK(gyrostat_answer_warnings(answer) == 0);
  CHECK(gyrostat_answer_warning_code(answer, 0) == NULL && gyrostat_answer_warning_text(answer, 0) == NULL);
  CHECK(isnan(gyrostat_answer_warning_value(answer, 0)));
  gyrostat_answer_free(answer);
}

/* A motor runs a wheel up on a body that turns about the same axis: the wheel's absolute momentum P tends to its end at a rate of
 * S (1/I + 1/(J - I)). */
static void motor_on_an_axis(void) {
  const double J = 5, I = 0.1, S = 0.02, fast = 100, spin = 0.3;
  const double axis[] = {0, 0, 2};
  const double M = J * spin, k = S * (1 / I + 1 / (J - I)), first = I * spin;
  const double last = S * (fast + M / (J - I)) / k;
  gyrostat_scene* scene = body(3, 4, J, 0, 0, spin);
  gyrostat_answer* answer;
  double within;
  const double* rate;
  int i;
  OK(gyrostat_add(scene, "wheel", "motor"));
  OK(gyrostat_set(scene, "wheel.axis", axis, 3));
  OK(gyrostat_set_number(scene, "wheel.axial_inertia", I));
  OK(gyrostat_set_number(scene, "wheel.slope", S));
  OK(gyrostat_set_number(scene, "wheel.no_load_rate", fast));
  OK(gyrostat_ask(scene, "rotor_rate", 1e-8));
  answer = solved(scene, "rotor:");
  if (answer == NULL) return;
  CHECK(gyrostat_answer_columns(answer) >= 1);
  rate = column(answer, "rotor_rate", 1, &within);
  CHECK(within <= 1e-8 * fast);
  for (i = 0; i < count; ++i) {
    const double P = last + (first - last) * exp(-k * times[i]);
    CHECK(fabs(rate[i] - (P / I - (M - P) / (J - I))) <= within + 1e-12);
  }
  gyrostat_answer_free(answer);
}

/* Damping about one axis, and a torque about it that is on from 2 s to 7 s and doubled by its factor. */
static void damped_and_pushed(void) {
  const double J = 4, D = 0.2, push[] = {0, 0, 0.1}, on[] = {2, 7};
  const double matrix[] = {1, 0, 0, 0, 1, 0, 0, 0, 0.2};
  gyrostat_scene* scene = body(3, 3.5, J, 0, 0, 1);
  gyrostat_answer* answer;
  double within;
  const double* w;
  int i;
  OK(gyrostat_add(scene, "torque", "damping"));
  OK(gyrostat_set(scene, "torque.matrix", matrix, 9));
  OK(gyrostat_add(scene, "torque", "constant"));
  OK(gyrostat_set(scene, "torque.torque", push, 3));
  OK(gyrostat_set(scene, "torque.on", on, 2));
  OK(gyrostat_set_number(scene, "torque.factor.mean", 2));
  OK(gyrostat_set_number(scene, "solve.tolerance", 1e-9));
  answer = solved(scene, "");
  if (answer == NULL) return;
  w = column(answer, "angular_velocity", 3, &within);
  for (i = 0; i < count; ++i) {
    const double t = times[i], k = D / J;
    double truth = exp(-k * t);
    if (t > on[0])
      truth +=
          2 * push[2] / D * (1 - exp(-k * ((t < on[1] ? t : on[1]) - on[0]))) * exp(-k * (t > on[1] ? t - on[1] : 0));
    CHECK(fabs(w[3 * i + 2] - truth) <= within + 1e-15);
    CHECK(fabs(w[3 * i]) <= within && fabs(w[3 * i + 1]) <= within);
  }
  gyrostat_answer_free(answer);
}

/* A symmetric top that turns about the vertical keeps its rates; a body that lies right in a circular orbit keeps turning with it. */
static void surroundings(void) {
  const double outward[] = {2, 0, 0}, ahead[] = {-1, 3, 0};
  const double high[] = {0, 0, 0.1}, radius = 7e6, mu = 3.986e14, n = sqrt(mu / radius) / radius;
  gyrostat_scene* scene = body(0.02, 0.02, 0.015, 0, 0, 60);
  gyrostat_answer* answer;
  double within;
  const double* w;
  OK(gyrostat_set_number(scene, "body.fixed", 1));
  OK(gyrostat_set(scene, "body.centre_of_mass", high, 3));
  OK(gyrostat_add(scene, "torque", "weight"));
  REFUSED(gyrostat_solve(scene, &answer), GYROSTAT_BAD_SCENE, "torque 1 is a weight, and field.gravity is not set");
  OK(gyrostat_set_number(scene, "field.gravity", 9.81));
  REFUSED(gyrostat_solve(scene, &answer), GYROSTAT_BAD_SCENE, "torque 1: it needs the mass");
  OK(gyrostat_set_number(scene, "body.mass", 1));
  OK(gyrostat_ask(scene, "angular_velocity", 0));
  OK(gyrostat_set_word(scene, "solve.model", "heavy:exact"));
  answer = solved(scene, "heavy:exact");
  if (answer == NULL) return;
  w = column(answer, "angular_velocity", 3, &within);
  CHECK(fabs(w[11] - 60) <= within);
  REFUSED(gyrostat_answer_column(answer, "attitude", NULL, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "gyrostat_ask");
  gyrostat_answer_free(answer);

  scene = body(10, 30, 35, 0, 0, n);
  OK(gyrostat_set_number(scene, "orbit.radius", radius));
  OK(gyrostat_set_number(scene, "orbit.mu", mu));
  OK(gyrostat_set(scene, "orbit.radial", outward, 3));
  OK(gyrostat_set(scene, "orbit.along", ahead, 3));
  OK(gyrostat_add(scene, "torque", "gravity-gradient"));
  answer = solved(scene, "full");
  if (answer == NULL) return;
  w = column(answer, "angular_velocity", 3, &within);
  CHECK(fabs(w[11] - n) <= within && within < 1e-6 * n);
  gyrostat_answer_free(answer);
}

static void a_warning(void) {
  gyrostat_scene* scene = body(3, 3.5, 4, 0, 0, 1);
  gyrostat_answer* answer;
  OK(gyrostat_add(scene, "torque", "damping"));
  OK(gyrostat_set_number(scene, "torque.matrix", -0.001));
  answer = solved(scene, "");
  CHECK(gyrostat_answer_warnings(answer) == 1);
  CHECK(strcmp(gyrostat_answer_warning_code(answer, 0), "driven-damping") == 0);
  CHECK(strstr(gyrostat_answer_warning_text(answer, 0), "negative") != NULL);
  CHECK(fabs(gyrostat_answer_warning_value(answer, 0) + 0.001) < 1e-15);
  gyrostat_answer_free(answer);
}

/* The stated error holds what the start may be off by, which a turn carries on. */
static void an_uncertain_start(void) {
  gyrostat_scene* scene = body(A, A, C, p, 0, r);
  gyrostat_answer* answer;
  double within;
  OK(gyrostat_set_number(scene, "initial.error.attitude", 1e-4));
  OK(gyrostat_set_number(scene, "solve.tolerance", 1e-3));
  answer = solved(scene, "");
  column(answer, "attitude", 4, &within);
  CHECK(within >= 1e-4 && within < 1e-3);
  gyrostat_answer_free(answer);
}

/* ---- a torque of one's own ---- */

/* What a law is handed, and how often it was asked. */
typedef struct {
  double rate; /* N m s/rad */
  double jump; /* s: from here on it pushes the other way */
  double lost; /* s: from here on it has no value */
  int asked, cancels_after;
  gyrostat_monitor* monitor;
  double seen; /* the greatest fraction that the monitor told */
} damper;

static void own_damping(void* yours, double t, const double* state, double* torque) {
  damper* its = yours;
  const double push = t < its->jump ? -its->rate : its->rate;
  int i;
  for (i = 0; i < 3; ++i) torque[i] = t < its->lost ? push * state[4 + i] : NAN;
  if (gyrostat_monitor_fraction(its->monitor) > its->seen) its->seen = gyrostat_monitor_fraction(its->monitor);
  if (++its->asked == its->cancels_after) gyrostat_monitor_cancel(its->monitor);
}

/* By the momentum, the wheel and the attitude: M3 = 5 w3 + 0.1 rate, so that w3 falls as the exponential; and a spring that pulls where
 * the attitude is not the one that belongs to it. */
static void own_by_all_that_is_seen(void* yours, double t, const double* state, double* torque) {
  const double angle = 0.4 / 0.02 * -expm1(-0.02 * t);
  *(int*)yours += 1;
  torque[0] = torque[1] = 0;
  torque[2] = -0.02 * (state[9] - 0.1 * state[10]) - 0.5 * (2 * state[2] * state[3] - sin(angle));
}

static void a_torque_of_ones_own(void) {
  const double jump[] = {40}, axis[] = {0, 0, 1}, no_time[] = {NAN};
  damper its = {0.05, 40, INFINITY, 0, -1, NULL, 0};
  gyrostat_scene* scene = body(3, 4, 5, 0, 0, 1);
  gyrostat_propagator* loop;
  gyrostat_answer* answer;
  const double* w;
  double within;
  int i, asked = 0;
  OK(gyrostat_drive(scene, own_damping, &its, jump, 1));
  answer = solved(scene, "full");
  if (answer == NULL) return;
  CHECK(its.asked > 100);
  w = column(answer, "angular_velocity", 3, &within);
  for (i = 0; i < count; ++i)
    CHECK(fabs(w[3 * i + 2] - exp(-0.01 * (times[i] < 40 ? times[i] : 80 - times[i]))) <= within);
  CHECK(within < 1e-5);
  gyrostat_answer_free(answer);

  scene = body(3, 4, 5, 0, 0, 0.4);
  OK(gyrostat_add(scene, "wheel", "held"));
  OK(gyrostat_set(scene, "wheel.axis", axis, 3));
  OK(gyrostat_set_number(scene, "wheel.axial_inertia", 0.1));
  OK(gyrostat_set_number(scene, "wheel.rate", 20));
  OK(gyrostat_drive(scene, own_by_all_that_is_seen, &asked, NULL, 0));
  answer = solved(scene, "full");
  if (answer == NULL) return;
  w = column(answer, "angular_velocity", 3, &within);
  for (i = 0; i < count; ++i) CHECK(fabs(w[3 * i + 2] - 0.4 * exp(-0.02 * times[i])) <= within);
  CHECK(within < 1e-5 && asked > 100);
  gyrostat_answer_free(answer);

  scene = body(3, 4, 5, 0, 0, 1);
  REFUSED(gyrostat_drive(NULL, own_damping, &its, NULL, 0), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  REFUSED(gyrostat_drive(scene, own_damping, &its, NULL, 1), GYROSTAT_BAD_ARGUMENT, "breakpoints is NULL");
  REFUSED(gyrostat_drive(scene, own_damping, &its, no_time, 1), GYROSTAT_BAD_ARGUMENT, "breakpoint");
  its.lost = 50;
  OK(gyrostat_drive(scene, own_damping, &its, jump, 1));
  REFUSED(gyrostat_propagator_new(scene, &loop), GYROSTAT_BAD_SCENE, "torque of your own");
  REFUSED(gyrostat_solve(scene, &answer), GYROSTAT_NO_ANSWER, "no finite value, at t = 5");
  OK(gyrostat_drive(scene, NULL, NULL, NULL, 0));
  answer = solved(scene, "free:");
  gyrostat_answer_free(answer);
}

/* ---- a monitor ---- */

static void watched_and_stopped(void) {
  damper its = {0.01, INFINITY, INFINITY, 0, 20000, NULL, 0};
  gyrostat_scene* scene = body(3, 4, 5, 6, 4, 20);
  gyrostat_answer* answer = NULL;
  its.monitor = gyrostat_monitor_new();
  CHECK(its.monitor != NULL && gyrostat_monitor_fraction(its.monitor) == 0);
  OK(gyrostat_set_number(scene, "solve.tolerance", 1e-9));
  OK(gyrostat_drive(scene, own_damping, &its, NULL, 0));
  REFUSED(gyrostat_solve_watched(scene, its.monitor, &answer), GYROSTAT_CANCELLED, "stopped");
  CHECK(answer == NULL && its.asked >= 20000 && its.asked < 40000 && its.seen > 0 && its.seen < 1);
  REFUSED(gyrostat_solve_watched(scene, its.monitor, &answer), GYROSTAT_CANCELLED, "stopped");
  CHECK(gyrostat_monitor_fraction(its.monitor) == 1);
  gyrostat_monitor_free(its.monitor);
  its.monitor = gyrostat_monitor_new();
  CHECK(gyrostat_solve_watched(scene, its.monitor, NULL) != GYROSTAT_OK && gyrostat_monitor_fraction(its.monitor) == 1);
  gyrostat_monitor_free(its.monitor);

  its.monitor = gyrostat_monitor_new(), its.cancels_after = -1;
  OK(gyrostat_solve_watched(scene, its.monitor, &answer));
  CHECK(gyrostat_answer_met(answer) == 1 && its.seen > 0.9);
  gyrostat_answer_free(answer);
  gyrostat_monitor_free(its.monitor);
  gyrostat_monitor_free(NULL);
  gyrostat_monitor_cancel(NULL);
  CHECK(gyrostat_monitor_fraction(NULL) == 0);
  gyrostat_scene_free(scene);
}

/* ---- a loop ---- */

static void loop_in_closed_form(void) {
  gyrostat_scene* scene = body(A, A, C, 0, 0, 0);
  gyrostat_propagator* loop = NULL;
  double q[] = {0, 0, 0, 1}, w[3], rates[3], error[3], turned = 0, off = 0;
  int i;
  OK(gyrostat_propagator_new(scene, &loop));
  gyrostat_scene_free(scene);
  CHECK(gyrostat_propagator_is_closed_form(loop) == 1);
  CHECK(gyrostat_propagator_wheels(loop) == 0);
  symmetric_rates(0, w);
  for (i = 1; i <= 200; ++i) {
    OK(gyrostat_propagate(loop, 0.05, q, w, NULL, error));
    turned += error[0] + 0.05 * error[1] * (200 - i + 1);
    off += error[1];
    CHECK(error[0] > 0 && error[0] < 1e-13 && error[1] > 0 && error[1] < 1e-13 && error[2] == 0);
  }
  symmetric_rates(10, rates);
  CHECK(distance(w, rates, 3) <= 2 * off);
  CHECK(angle_between(q, symmetric_attitude(10)) <= 2 * turned);
  OK(gyrostat_propagate(loop, 0, q, w, NULL, NULL));
  CHECK(angle_between(q, symmetric_attitude(10)) <= 2 * turned);
  gyrostat_propagator_free(loop);
}

/* A free wheel and a held one: the momentum in space stays. A damped body: its rate falls as the exponential. */
static void loops_with_wheels_and_torques(void) {
  const double axes[] = {0, 1, 0, 1, 0, 0};
  gyrostat_scene* scene = body(3, 4, 5, 0, 0, 0);
  gyrostat_propagator* loop = NULL;
  double q[] = {0, 0, 0, 1}, w[] = {0.3, 0.1, -0.2}, rates[] = {50, -20}, error[3];
  double before, after;
  OK(gyrostat_add(scene, "wheel", "free"));
  OK(gyrostat_set(scene, "wheel.axis", axes, 3));
  OK(gyrostat_set_number(scene, "wheel.axial_inertia", 0.1));
  OK(gyrostat_add(scene, "wheel", "held"));
  OK(gyrostat_set(scene, "wheel.axis", axes + 3, 3));
  OK(gyrostat_set_number(scene, "wheel.axial_inertia", 0.2));
  OK(gyrostat_propagator_new(scene, &loop));
  CHECK(gyrostat_propagator_wheels(loop) == 2 && gyrostat_propagator_is_closed_form(loop) == 1);
  before = hypot(hypot(3 * w[0] + 0.2 * rates[1], 4 * w[1] + 0.1 * rates[0]), 5 * w[2]);
  OK(gyrostat_propagate(loop, 7, q, w, rates, error));
  after = hypot(hypot(3 * w[0] + 0.2 * rates[1], 4 * w[1] + 0.1 * rates[0]), 5 * w[2]);
  CHECK(fabs(after - before) <= 5 * error[1] + 0.3 * error[2]);
  CHECK(error[2] > 0 && error[2] < 1e-10);
  CHECK(rates[1] == -20 && fabs(rates[0] - 50 + w[1] - 0.1) <= error[2]);
  REFUSED(gyrostat_propagate(loop, 1, q, w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "rotor_rate is NULL");
  gyrostat_propagator_free(loop);
  gyrostat_scene_free(scene);

  scene = body(3, 4, 5, 0, 0, 0);
  OK(gyrostat_add(scene, "torque", "damping"));
  OK(gyrostat_set_number(scene, "torque.matrix", 0.5));
  OK(gyrostat_set_number(scene, "solve.tolerance", 1e-10));
  OK(gyrostat_propagator_new(scene, &loop));
  CHECK(gyrostat_propagator_is_closed_form(loop) == 0);
  w[0] = w[1] = 0, w[2] = 1;
  OK(gyrostat_propagate(loop, 2, q, w, NULL, error));
  CHECK(fabs(w[2] - exp(-0.5 / 5 * 2)) <= error[1] && error[1] < 1e-9 && error[1] > 0);
  gyrostat_propagator_free(loop);
  gyrostat_scene_free(scene);
}

/* ---- refusals ---- */

static void refused_nulls(void) {
  const double one = 1;
  double q[] = {0, 0, 0, 1}, w[] = {0, 0, 1};
  gyrostat_scene* scene = gyrostat_scene_new();
  gyrostat_answer* answer;
  gyrostat_propagator* loop;
  REFUSED(gyrostat_add(NULL, "wheel", "held"), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  REFUSED(gyrostat_add(scene, NULL, "held"), GYROSTAT_BAD_ARGUMENT, "what is NULL");
  REFUSED(gyrostat_add(scene, "wheel", NULL), GYROSTAT_BAD_ARGUMENT, "type is NULL");
  REFUSED(gyrostat_set(NULL, "body.mass", &one, 1), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  REFUSED(gyrostat_set(scene, NULL, &one, 1), GYROSTAT_BAD_ARGUMENT, "key is NULL");
  REFUSED(gyrostat_set(scene, "body.mass", NULL, 1), GYROSTAT_BAD_ARGUMENT, "values is NULL");
  REFUSED(gyrostat_set_number(NULL, "body.mass", 1), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  REFUSED(gyrostat_set_word(NULL, "solve.model", "full"), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  REFUSED(gyrostat_set_word(scene, "solve.model", NULL), GYROSTAT_BAD_ARGUMENT, "word is NULL");
  REFUSED(gyrostat_ask(scene, NULL, 0), GYROSTAT_BAD_ARGUMENT, "name is NULL");
  REFUSED(gyrostat_solve(NULL, &answer), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  CHECK(answer == NULL);
  REFUSED(gyrostat_solve(scene, NULL), GYROSTAT_BAD_ARGUMENT, "answer is NULL");
  REFUSED(gyrostat_answer_column(NULL, "attitude", NULL, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "answer is NULL");
  REFUSED(gyrostat_answer_error(NULL, "attitude", NULL, NULL), GYROSTAT_BAD_ARGUMENT, "answer is NULL");
  REFUSED(gyrostat_answer_scalar(NULL, "stop_time", NULL), GYROSTAT_BAD_ARGUMENT, "answer is NULL");
  REFUSED(gyrostat_propagator_new(NULL, &loop), GYROSTAT_BAD_ARGUMENT, "scene is NULL");
  CHECK(loop == NULL);
  REFUSED(gyrostat_propagator_new(scene, NULL), GYROSTAT_BAD_ARGUMENT, "propagator is NULL");
  REFUSED(gyrostat_propagate(NULL, 1, q, w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "propagator is NULL");
  CHECK(gyrostat_answer_model(NULL) == NULL && gyrostat_answer_met(NULL) == 0 && gyrostat_answer_columns(NULL) == 0);
  CHECK(gyrostat_answer_column_name(NULL, 0) == NULL && gyrostat_answer_warnings(NULL) == 0);
  CHECK(gyrostat_propagator_wheels(NULL) == 0 && gyrostat_propagator_is_closed_form(NULL) == 0);
  gyrostat_scene_free(NULL);
  gyrostat_answer_free(NULL);
  gyrostat_propagator_free(NULL);
  gyrostat_scene_free(scene);
}

static void refused_arguments(void) {
  const double v[] = {1, 2, 3, 4}, zero[] = {0, 0, 0, 0}, back[] = {0, 2, 1}, before[] = {-1, 1};
  const double no_number[] = {1, NAN, 3}, endless[] = {1, INFINITY, 3};
  gyrostat_scene* scene = gyrostat_scene_new();
  int i;
  REFUSED(gyrostat_set(scene, "body.weight", v, 1), GYROSTAT_BAD_ARGUMENT, "body.inertia");
  REFUSED(gyrostat_set(scene, "bodyweight", v, 1), GYROSTAT_BAD_ARGUMENT, "keys begin with");
  REFUSED(gyrostat_set(scene, "body.inertia", v, 4), GYROSTAT_BAD_ARGUMENT, "3 moments or a matrix of 9");
  REFUSED(gyrostat_set(scene, "body.inertia", no_number, 3), GYROSTAT_BAD_ARGUMENT, "NaN");
  REFUSED(gyrostat_set(scene, "initial.angular_velocity", endless, 3), GYROSTAT_BAD_ARGUMENT, "infinite");
  REFUSED(gyrostat_set(scene, "initial.attitude", v, 3), GYROSTAT_BAD_ARGUMENT, "quaternion");
  REFUSED(gyrostat_set(scene, "initial.attitude", zero, 4), GYROSTAT_BAD_ARGUMENT, "must not vanish");
  REFUSED(gyrostat_set_number(scene, "initial.error.attitude", -1), GYROSTAT_BAD_ARGUMENT, "negative");
  REFUSED(gyrostat_set(scene, "field.down", zero, 3), GYROSTAT_BAD_ARGUMENT, "must not vanish");
  REFUSED(gyrostat_set_number(scene, "body.fixed", 2), GYROSTAT_BAD_ARGUMENT, "1 for yes");
  REFUSED(gyrostat_set(scene, "solve.times", back, 3), GYROSTAT_BAD_ARGUMENT, "increase");
  REFUSED(gyrostat_set(scene, "solve.times", before, 2), GYROSTAT_BAD_ARGUMENT, "negative");
  REFUSED(gyrostat_set(scene, "solve.times", v, 0), GYROSTAT_BAD_ARGUMENT, "at least one");
  REFUSED(gyrostat_set_number(scene, "solve.tolerance", 0), GYROSTAT_BAD_ARGUMENT, "(0, 1)");
  REFUSED(gyrostat_set_number(scene, "solve.model", 1), GYROSTAT_BAD_ARGUMENT, "gyrostat_set_word");
  REFUSED(gyrostat_set_word(scene, "body.mass", "heavy"), GYROSTAT_BAD_ARGUMENT, "by gyrostat_set");
  REFUSED(gyrostat_set_word(scene, "solve.model", "fast"), GYROSTAT_BAD_ARGUMENT, "free:closed-form");
  REFUSED(gyrostat_ask(scene, "colour", 0), GYROSTAT_BAD_ARGUMENT, "attitude");
  REFUSED(gyrostat_ask(scene, "attitude", -1), GYROSTAT_BAD_ARGUMENT, "tolerance");
  REFUSED(gyrostat_ask(scene, "attitude", NAN), GYROSTAT_BAD_ARGUMENT, "tolerance");
  REFUSED(gyrostat_add(scene, "rocket", "big"), GYROSTAT_BAD_ARGUMENT, "wheel or torque");
  REFUSED(gyrostat_add(scene, "wheel", "square"), GYROSTAT_BAD_ARGUMENT, "locked, held, free");
  REFUSED(gyrostat_set_number(scene, "wheel.rate", 1), GYROSTAT_BAD_ARGUMENT, "gyrostat_add");
  OK(gyrostat_add(scene, "wheel", "held"));
  REFUSED(gyrostat_set_number(scene, "wheel.friction", 1), GYROSTAT_BAD_ARGUMENT,
          "of the type held has no wheel.friction");
  for (i = 1; i < 8; ++i) OK(gyrostat_add(scene, "wheel", "held"));
  REFUSED(gyrostat_add(scene, "wheel", "held"), GYROSTAT_BAD_ARGUMENT, "8 wheels");
  OK(gyrostat_add(scene, "torque", "thrust"));
  REFUSED(gyrostat_set_word(scene, "torque.against", "momentum"), GYROSTAT_BAD_ARGUMENT, "torque.force");
  REFUSED(gyrostat_set_word(scene, "torque.frame", "tilted"), GYROSTAT_BAD_ARGUMENT, "body, inertial or orbit");
  REFUSED(gyrostat_set(scene, "torque.on", v, 3), GYROSTAT_BAD_ARGUMENT, "pairs");
  OK(gyrostat_set(scene, "field.uniform", v, 3));
  REFUSED(gyrostat_set_number(scene, "field.dipole.radius", 1), GYROSTAT_BAD_ARGUMENT, "field.uniform is set");
  gyrostat_scene_free(scene);
}

static void refuse_scene(gyrostat_scene* scene, int code, const char* words) {
  gyrostat_answer* answer = NULL;
  REFUSED(gyrostat_solve(scene, &answer), code, words);
  CHECK(answer == NULL);
  gyrostat_scene_free(scene);
}

static void refused_scenes(void) {
  const double huge[] = {1e160, 0, 0}, ramp[] = {0, 1};
  const double axis[] = {0, 0, 1}, long_bar[] = {1, 2, 9};
  gyrostat_scene* scene = gyrostat_scene_new();
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "body.inertia is not set");
  scene = gyrostat_scene_new();
  OK(gyrostat_set(scene, "body.inertia", long_bar, 3));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "initial.angular_velocity is not set");
  scene = body(1, 2, 9, 0, 0, 1);
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "exceeds the sum");
  scene = body(3, 4, 5, 0, 0, 1);
  OK(gyrostat_add(scene, "wheel", "free"));
  OK(gyrostat_set(scene, "wheel.axis", axis, 3));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "of wheel 1 wheel.axial_inertia is not set");
  scene = body(3, 4, 5, 0, 0, 1);
  OK(gyrostat_add(scene, "wheel", "free"));
  OK(gyrostat_set(scene, "wheel.axis", axis, 3));
  OK(gyrostat_set_number(scene, "wheel.axial_inertia", 6));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "wheel 1: ");
  scene = body(3, 4, 5, 0, 0, 1);
  OK(gyrostat_add(scene, "torque", "weight"));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "torque 1: the weight of a free body");
  scene = body(3, 4, 5, 0, 0, 1);
  OK(gyrostat_set_number(scene, "orbit.eccentricity", 0.1));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "orbit.eccentricity is set and orbit.radius is not");
  scene = body(3, 4, 5, 0, 0, 1);
  OK(gyrostat_ask(scene, "attitude_orbit", 0));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "no column attitude_orbit");
  scene = body(3, 4, 5, 0.1, 0.2, 1);
  OK(gyrostat_set_word(scene, "solve.model", "heavy:exact"));
  refuse_scene(scene, GYROSTAT_NO_ANSWER, "model heavy:exact: ");
  scene = body(3, 3.5, 4, 0, 0, 1);
  OK(gyrostat_add(scene, "torque", "constant"));
  OK(gyrostat_set(scene, "torque.torque", huge, 3));
  OK(gyrostat_set_number(scene, "torque.factor.mean", 1e160));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "give them in other units");
  scene = body(3, 3.5, 4, 0, 0, 1);
  OK(gyrostat_add(scene, "torque", "constant"));
  OK(gyrostat_set(scene, "torque.torque", huge, 3));
  OK(gyrostat_set_number(scene, "torque.factor.mean", 2));
  OK(gyrostat_set(scene, "torque.factor.times", ramp, 2));
  OK(gyrostat_set(scene, "torque.factor.values", ramp, 2));
  refuse_scene(scene, GYROSTAT_BAD_SCENE, "a wave and a table");
}

static void refused_steps(void) {
  const double on[] = {1, 2}, push[] = {0, 0, 1};
  gyrostat_scene* scene = body(3, 4, 5, 0, 0, 0);
  gyrostat_propagator* loop = NULL;
  double q[] = {0, 0, 0, 1}, w[] = {0.1, 0.2, 0.3}, long_q[] = {0, 0, 0, 1.1}, bad_w[] = {0, NAN, 0};
  OK(gyrostat_propagator_new(scene, &loop));
  REFUSED(gyrostat_propagate(loop, NAN, q, w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "NaN");
  REFUSED(gyrostat_propagate(loop, -1, q, w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "negative");
  REFUSED(gyrostat_propagate(loop, 1, NULL, w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "attitude is NULL");
  REFUSED(gyrostat_propagate(loop, 1, q, NULL, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "angular_velocity is NULL");
  REFUSED(gyrostat_propagate(loop, 1, long_q, w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "unit quaternion");
  REFUSED(gyrostat_propagate(loop, 1, q, bad_w, NULL, NULL), GYROSTAT_BAD_ARGUMENT, "NaN");
  CHECK(q[3] == 1 && w[1] == 0.2 && long_q[3] == 1.1);
  gyrostat_propagator_free(loop);
  OK(gyrostat_add(scene, "torque", "constant"));
  OK(gyrostat_set(scene, "torque.torque", push, 3));
  OK(gyrostat_set(scene, "torque.on", on, 2));
  REFUSED(gyrostat_propagator_new(scene, &loop), GYROSTAT_BAD_SCENE, "a torque changes with time");
  CHECK(loop == NULL);
  gyrostat_scene_free(scene);
  scene = body(1, 2, 9, 0, 0, 0);
  REFUSED(gyrostat_propagator_new(scene, &loop), GYROSTAT_BAD_SCENE, "exceeds the sum");
  gyrostat_scene_free(scene);
}

int main(void) {
  CHECK(strlen(gyrostat_version()) >= 5);
  CHECK(strcmp(gyrostat_message(), "") == 0);
  free_symmetric_body();
  motor_on_an_axis();
  damped_and_pushed();
  surroundings();
  a_warning();
  an_uncertain_start();
  a_torque_of_ones_own();
  watched_and_stopped();
  loop_in_closed_form();
  loops_with_wheels_and_torques();
  refused_nulls();
  refused_arguments();
  refused_scenes();
  refused_steps();
  printf("gyrostat %s: %s\n", gyrostat_version(), failures == 0 ? "all as it should be" : "it fails");
  return failures == 0 ? 0 : 1;
}
