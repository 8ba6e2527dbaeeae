/* SPDX-License-Identifier: BSD-3-Clause */
/* A satellite spins up its wheel: where is the wheel after a minute, ten minutes, an hour? And the same body in a loop. */
#include <gyrostat/gyrostat.h>
#include <stdio.h>

static const double times[] = {60, 600, 3600}; /* s */

static int describe(gyrostat_scene* scene) {
  const double moments[] = {86, 118, 141}; /* kg m^2 */
  const double rate[] = {0, 0.01, 0.1};    /* rad/s: about the axis of greatest inertia, the wheel at rest */
  const double axis[] = {1, 0.05, 0.04};   /* of any length */
  return gyrostat_set(scene, "body.inertia", moments, 3) || gyrostat_set(scene, "initial.angular_velocity", rate, 3) ||
         gyrostat_add(scene, "wheel", "motor") || gyrostat_set(scene, "wheel.axis", axis, 3) ||
         gyrostat_set_number(scene, "wheel.axial_inertia", 0.28) || gyrostat_set_number(scene, "wheel.slope", 0.13) ||
         gyrostat_set_number(scene, "wheel.no_load_rate", 60) || gyrostat_set(scene, "solve.times", times, 3) ||
         gyrostat_set_number(scene, "solve.tolerance", 1e-6);
}

static int print(const gyrostat_answer* answer) {
  const double* rate;
  double error, size;
  size_t rows;
  if (gyrostat_answer_column(answer, "rotor_rate", &rate, &rows, NULL)) return 1;
  if (gyrostat_answer_error(answer, "rotor_rate", &error, &size)) return 1;
  printf("model %s, stated error of the wheel's rate %.1e rad/s, tolerance %s\n", gyrostat_answer_model(answer),
         error * size, gyrostat_answer_met(answer) ? "met" : "not met");
  for (size_t i = 0; i < rows; ++i) printf("t = %.0f s: wheel at %.6f rad/s\n", times[i], rate[i]);
  return 0;
}

/* Ten steps of a tenth of a second, each from the state that the last one ended with. */
static int loop(const gyrostat_propagator* propagator) {
  double attitude[] = {0, 0, 0, 1}, rate[] = {0, 0.01, 0.1}, wheel[] = {0}, error[3];
  for (int i = 0; i < 10; ++i)
    if (gyrostat_propagate(propagator, 0.1, attitude, rate, wheel, error)) return 1;
  printf("after ten steps: wheel at %.9f rad/s, the last step within %.0e rad/s\n", wheel[0], error[2]);
  return 0;
}

int main(void) {
  gyrostat_scene* scene = gyrostat_scene_new();
  gyrostat_answer* answer = NULL;
  gyrostat_propagator* propagator = NULL;
  const int failed = describe(scene) || gyrostat_solve(scene, &answer) || print(answer) ||
                     gyrostat_propagator_new(scene, &propagator) || loop(propagator);
  if (failed) puts(gyrostat_message()); /* what was wrong, and what to do */
  gyrostat_propagator_free(propagator);
  gyrostat_answer_free(answer);
  gyrostat_scene_free(scene);
  return failed;
}
