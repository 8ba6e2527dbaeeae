/* SPDX-License-Identifier: BSD-3-Clause */
/* What a user of the C interface writes first: a body, its start, an answer, and what is told where something is wrong. */
#include <gyrostat/gyrostat.h>
#include <math.h>
#include <stdio.h>

int main(void) {
  const double moments[] = {1, 2, 3}, rate[] = {0, 0, 0.5}, times[] = {0, 8};
  gyrostat_scene* scene = gyrostat_scene_new();
  gyrostat_answer* answer = NULL;
  const double* rates = NULL;
  if (gyrostat_set(scene, "body.inertia", moments, 2) != GYROSTAT_BAD_ARGUMENT) return 1;
  printf("gyrostat %s: %s\n", gyrostat_version(), gyrostat_message());
  if (gyrostat_set(scene, "body.inertia", moments, 3) || gyrostat_set(scene, "initial.angular_velocity", rate, 3) ||
      gyrostat_set(scene, "solve.times", times, 2) || gyrostat_solve(scene, &answer) ||
      gyrostat_answer_column(answer, "angular_velocity", &rates, NULL, NULL))
    return puts(gyrostat_message()), 1;
  if (!(fabs(rates[5] - 0.5) < 1e-6)) return 1;
  gyrostat_answer_free(answer);
  gyrostat_scene_free(scene);
  return 0;
}
