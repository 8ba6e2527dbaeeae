/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * The C interface of gyrostat, for C99 and for whatever calls C. Link gyrostat::gyrostat (CMake) or what
 * pkg-config --libs --static gyrostat names. docs/c.md shows it by example.
 *
 * A scene is physics by name: a body, its wheels, what acts on it, its start, and what is asked of it. The names are those
 * of a scene file of the kind "general" (docs/scenes.md): key "body.inertia" here is `inertia` in its table [body], and the
 * table below lists them. gyrostat_solve answers a scene by the cheapest model whose own error estimate meets the tolerance;
 * gyrostat_propagate moves one state on by one step, for a loop.
 *
 * Units: SI, radians, seconds. Vectors of a body are in its axes unless said otherwise. An attitude is a quaternion
 * [x, y, z, w] that takes body axes to inertial ones. A matrix is nine numbers, row after row. Numbers in several are one
 * array, one behind the other; nothing keeps a pointer to an array of the caller.
 *
 * Errors: a function that can fail returns GYROSTAT_OK or why not; gyrostat_message() then says it in words, with what to do.
 * A refused call changes nothing. No exception crosses this border, and NULL where an object or array is wanted is refused like
 * any other argument. A program ends only where memory runs out in the midst of a computation.
 *
 * Threads: no function waits for another. Different objects may be used from different threads at once, and so may one
 * object by functions that take it as const. What changes an object must have it alone. (A monitor is for all at once.)
 *
 * Lifetime: what a *_new or gyrostat_solve gives is the caller's, to be freed by the function of its name; freeing NULL does
 * nothing. Texts and arrays that a function hands out belong to the object asked, and last as long as it; a name of a column,
 * a model or a warning lasts for ever.
 *
 * Stability: functions and names may come to be; those that are there keep their meaning and their arguments within one
 * minor version. There are no structures whose size could change.
 */
#ifndef GYROSTAT_GYROSTAT_H
#define GYROSTAT_GYROSTAT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a function came to. */
enum {
  GYROSTAT_OK = 0,
  GYROSTAT_BAD_ARGUMENT = 1, /* NULL, not finite, outside its interval, an unknown name, a wrong number of numbers */
  GYROSTAT_BAD_SCENE =
      2, /* each part is possible and the whole is not: something is missing, or no body is like that */
  GYROSTAT_NO_ANSWER = 3, /* no model could answer: too long, too stiff, a stop that is not followed, lost digits */
  GYROSTAT_NO_MEMORY = 4,
  GYROSTAT_CANCELLED = 5 /* gyrostat_monitor_cancel was called */
};

typedef struct gyrostat_scene gyrostat_scene;
typedef struct gyrostat_answer gyrostat_answer;
typedef struct gyrostat_propagator gyrostat_propagator;
typedef struct gyrostat_monitor gyrostat_monitor;

/* The version of the library that is linked, "major.minor.patch". */
const char* gyrostat_version(void);

/* Why the last call of this thread that failed did so, one sentence; "" before any has. It lasts until the next call that fails. */
const char* gyrostat_message(void);

/* ---- A scene ----
 *
 * One number, three or nine: how many numbers a key takes. Required ones are marked with *.
 *
 *   body.inertia*           3, 9  kg m^2   of the whole, wheels locked in it, about the mass centre, or the point where it is held:
 *                                          three moments along the body axes, or a symmetric matrix
 *   body.mass               1     kg       wanted by a weight where the body is fixed, and by a thrust where it is not
 *   body.centre_of_mass     3     m        from the body's origin; 0
 *   body.fixed              1              1: the origin is held in space; 0
 *   body.rotor_momentum     3     N m s    constant, of wheels that are not listed; 0
 *
 *   initial.attitude        4              [x, y, z, w], of any length but zero; [0, 0, 0, 1]
 *   initial.angular_velocity* 3   rad/s
 *   initial.velocity, initial.position  3  m/s, m  of a free body's mass centre, inertial axes; 0
 *   initial.error.attitude, .angular_velocity, .rotor_rate, .rotor_angle, .velocity, .position
 *                           1     rad ...  by how much the start may be off (the length of the error, that of rates and angles
 *                                          over the wheels): carried into the stated errors; 0
 *
 *   gyrostat_add(scene, "wheel", TYPE), TYPE one of locked, held, free, torque, motor, friction; then, of the wheel added last
 *   wheel.axis*             3              of any length but zero
 *   wheel.axial_inertia*    1     kg m^2   (a locked one: 0)
 *   wheel.rate, wheel.angle 1     rad/s, rad  relative to the body at t = 0; 0
 *   wheel.torque            1     N m      on the wheel (torque); 0
 *   wheel.friction          1     N m s/rad  (torque, motor; friction*); 0
 *   wheel.slope*, wheel.no_load_rate*  1   N m s/rad, rad/s  (motor)
 *   wheel.times, wheel.values  n  s; rad/s or N m  a table: of the rate (held) or added to the torque (torque)
 *   wheel.interpolation, wheel.extend      words: step, linear (default), cubic; zero (default), hold
 *
 *   gyrostat_add(scene, "torque", TYPE); then, of the torque added last
 *   torque.torque*          3     N m      constant: in the axes torque.frame
 *   torque.times*, torque.values*  n, 3n   s, N m  table
 *   torque.interpolation, torque.extend    words, as of wheels; table
 *   torque.matrix*          1, 3, 9        damping: N m s/rad, or 1/s against a momentum; eddy-current: S m^4
 *   torque.against                         word: angular-velocity (default), momentum, carrier-momentum; damping
 *   torque.limit*           3     N m      brake: about each body axis
 *   torque.law                             word: total (default), carrier: the momentum that a brake opposes
 *   torque.gradient         1     1/s^2    gravity-gradient: of a field along field.down; else that of the orbit
 *   torque.dipole*          3     A m^2    magnetic
 *   torque.force*, torque.point  3  N, m   thrust; point from the body's origin, 0
 *   torque.momentum*        3     N m s    charge
 *   torque.frame                           word: body (default), inertial, orbit; constant, table; a thrust: not orbit
 *   torque.on               2n    s        it acts from each begin to each end; always where this is not said
 *   torque.factor.mean, .amplitude, .rate, .phase  1  -, -, rad/s, rad  times mean + amplitude sin(rate t + phase);
 *                                          mean: 1, but 0 where a rate is set; the others 0
 *   torque.factor.times, .values  n  s, -  or times a table; torque.factor.interpolation, .extend: words
 *     (each type but table takes a factor; `weight` has no key of its own)
 *
 *   orbit.radius*, orbit.mu*  1   m, m^3/s^2  of the mass centre, as soon as a key of the orbit is set
 *   orbit.eccentricity, orbit.true_anomaly  1  -, rad; 0
 *   orbit.radial, orbit.along  3           outward and ahead at t = 0, inertial axes, of any length; what of the second is radial
 *                                          is dropped; [1, 0, 0], [0, 1, 0]
 *
 *   field.gravity           1     m/s^2    0; wanted by a weight
 *   field.down              3              inertial axes, of any length but zero; [0, 0, -1]
 *   field.uniform           3     T        inertial axes
 *   field.rotating.axis, .rate, .vector  3, 1, 3  -, rad/s, T   a field that turns
 *   field.dipole.axis, .strength, .radius  3, 1, 1  -, T, m     of the central body of the orbit, on its equator
 *
 *   solve.times*            n     s        increasing, the first not negative
 *   solve.tolerance         1              greatest error wanted in what is asked, in (0, 1); 1e-6
 *   solve.recognise         1              0: the full equations, whatever the scene is; 1
 *   solve.model                            word: a model by name (docs/columns.md), auto
 */

/* A scene without anything; NULL: there is no memory. */
gyrostat_scene* gyrostat_scene_new(void);
void gyrostat_scene_free(gyrostat_scene* scene);

/* Adds a "wheel" or a "torque" of a type; keys that begin with wheel or torque are then those of the one added last. At most 8
 * wheels. */
int gyrostat_add(gyrostat_scene* scene, const char* what, const char* type);

/* Sets a key to `count` finite numbers; another call of the same key replaces them. */
int gyrostat_set(gyrostat_scene* scene, const char* key, const double* values, size_t count);

/* Sets a key to one number. */
int gyrostat_set_number(gyrostat_scene* scene, const char* key, double value);

/* Sets a key to one of its words. */
int gyrostat_set_word(gyrostat_scene* scene, const char* key, const char* word);

/* Asks for a column or scalar by name (docs/columns.md), such as "attitude" or "rotor_rate", to a tolerance of its own, as its error
 * is measured; 0: solve.tolerance. Where nothing is asked for, an answer has attitude, rates, and rates and angles of the wheels. */
int gyrostat_ask(gyrostat_scene* scene, const char* name, double tolerance);

/* ---- A torque of your own ----
 *
 * At t, s: writes torque[3], N m about the reference point, body axes. state: attitude [x, y, z, w], angular velocity[3], rad/s, angular
 * momentum[3], N m s, both in body axes, and the rate of each wheel, rad/s relative to the body, one behind the other. `yours` is what was
 * given with the function. It must be a function: the same numbers give the same torque, whenever and in whatever order it is asked
 * (docs/general.md, section 7). NaN where it has no value. It is called by the thread that solves, and must return: no longjmp, no
 * exception. */
typedef void (*gyrostat_torque)(void* yours, double t, const double* state, double* torque);

/* Adds a torque of your own to those of the scene, in place of the one that was there; NULL: none. breakpoints: the `count` times at which
 * it or its derivatives jump, s, in any order; NULL and 0 for a smooth one. The function and `yours` are kept, and must last while the
 * scene is solved. No family is looked for, and a propagator takes none. */
int gyrostat_drive(gyrostat_scene* scene, gyrostat_torque torque, void* yours, const double* breakpoints, size_t count);

/* ---- An answer ---- */

/* Answers a scene, which it leaves as it is. *answer is NULL where it fails. It may take seconds for a long and hard motion. An answer
 * whose errors exceed the tolerance is one too: see gyrostat_answer_met. */
int gyrostat_solve(const gyrostat_scene* scene, gyrostat_answer** answer);

/* The same, watched: other threads ask the monitor how far it is, and stop it. NULL: nobody does. Stopped, it ends within some hundred steps of
 * the full equations with GYROSTAT_CANCELLED, or with the answer of a cheaper model that stood already. */
int gyrostat_solve_watched(const gyrostat_scene* scene, gyrostat_monitor* monitor, gyrostat_answer** answer);
void gyrostat_answer_free(gyrostat_answer* answer);

/* The model that answered, such as "free:closed-form"; NULL of NULL. */
const char* gyrostat_answer_model(const gyrostat_answer* answer);

/* 1: every stated error is within the tolerance; 0: not, or NULL. */
int gyrostat_answer_met(const gyrostat_answer* answer);

/* How many columns there are, and the name of each; NULL behind the last. */
size_t gyrostat_answer_columns(const gyrostat_answer* answer);
const char* gyrostat_answer_column_name(const gyrostat_answer* answer, size_t place);

/* A column by name: `rows` rows, one for each time of solve.times, of `width` numbers each, row after row. Each of the three may be
 * NULL. */
int gyrostat_answer_column(const gyrostat_answer* answer, const char* name, const double** values, size_t* rows,
                           size_t* width);

/* The stated error of a column or scalar: no row is farther from the truth than *error times *size, in its unit (for an attitude
 * the angle between the two, rad). *error is what is held against a tolerance, and *size what it is relative to: 1 where it is
 * absolute. NaN: it is a definition and has none; infinite: nothing is known. Either may be NULL. */
int gyrostat_answer_error(const gyrostat_answer* answer, const char* name, double* error, double* size);

/* A scalar by name; NaN where the motion has none. "recognised" is a sum: 1 free, 2 deceleration, 4 heavy, 8 rotor, 16 spinning. */
int gyrostat_answer_scalar(const gyrostat_answer* answer, const char* name, double* value);

/* How many warnings there are (docs/warnings.md); of each its code, a sentence, and the number that raised it, NaN where there is
 * none. NULL and NaN behind the last. */
size_t gyrostat_answer_warnings(const gyrostat_answer* answer);
const char* gyrostat_answer_warning_code(const gyrostat_answer* answer, size_t place);
const char* gyrostat_answer_warning_text(const gyrostat_answer* answer, size_t place);
double gyrostat_answer_warning_value(const gyrostat_answer* answer, size_t place);

/* ---- A monitor ----
 *
 * For one call of gyrostat_solve_watched, which it must outlast; once cancelled it stays so. Fraction and cancel may be called at any time,
 * from any thread, from a signal handler, and from a torque of your own. NULL: there is no memory. */
gyrostat_monitor* gyrostat_monitor_new(void);
void gyrostat_monitor_free(gyrostat_monitor* monitor);

/* How much of the model at work is done, 0 to 1: the full equations count their span. 1 behind a call that has ended, a cancelled one too. */
double gyrostat_monitor_fraction(const gyrostat_monitor* monitor);
void gyrostat_monitor_cancel(gyrostat_monitor* monitor);

/* ---- One step of a loop ---- */

/* Prepares the body, wheels and torques of a scene; its start, times and what is asked do not matter, solve.tolerance does. Refused
 * where something changes with time by itself: a table, a wave, an interval, an orbit or a field that moves; and with a torque of your
 * own. *propagator is NULL where it fails. The scene is not kept. */
int gyrostat_propagator_new(const gyrostat_scene* scene, gyrostat_propagator** propagator);
void gyrostat_propagator_free(gyrostat_propagator* propagator);

/* The length of rotor_rate: how many wheels there are; 0 of NULL. */
size_t gyrostat_propagator_wheels(const gyrostat_propagator* propagator);

/* 1: nothing acts on the body and no wheel is driven or slowed, so that gyrostat_propagate is a closed form that takes no memory from
 * the heap, but where rounding hides on which side of a separatrix the motion runs; 0: it integrates the full equations, and takes some. */
int gyrostat_propagator_is_closed_form(const gyrostat_propagator* propagator);

/* Moves a state on by dt >= 0, s; GYROSTAT_NO_ANSWER where the full equations would need more than 100000 steps for it, and
 * where the body turns so often that no double knows its phase. Read and written: attitude[4], unit to 1e-6 and made so;
 * angular_velocity[3], rad/s; rotor_rate[], rad/s relative to the body, one for each wheel, NULL where there are none. A refused
 * call leaves them as they are.
 *
 * error[3]: how far the new state may be from that to which the given one moves, the given one taken to be right to a rounding:
 * attitude, rad; angular velocity, rad/s, and rates of the wheels, rad/s, as lengths; infinite where rounding decides, as on an
 * unstable axis for long. NULL: not asked for. Errors of steps that
 * follow each other add up, and grow with the motion: what roundings have changed of its momentum and energy turns it wrongly ever after. */
int gyrostat_propagate(const gyrostat_propagator* propagator, double dt, double* attitude, double* angular_velocity,
                       double* rotor_rate, double* error);

#ifdef __cplusplus
}
#endif

#endif
