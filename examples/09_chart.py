# SPDX-License-Identifier: BSD-3-Clause
"""What does accuracy cost? Each rung of the ladder on one scene, an unsymmetric top in its periodic motion: the error that it states, the true
one, the time. `gyrostat chart SCENE` draws it, every integrator beside the rungs."""

import numpy as np

import gyrostat

scene = {
    "name": "top", "kind": "heavy", "solve": {"times": [2.0], "ask": ["angular_velocity"]},  # s: some fifty turns
    "body": {"inertia": [0.0011, 0.0016, 0.0020], "mass": 0.8, "centre_of_mass": [0.012, 0.009, 0.010]},  # kg m^2, kg, m
    "field": {"gravity": 9.80665},  # m/s^2
    "initial": {"periodic": {"spin": 150.0, "cos_inclination": 0.1}},  # rad/s
}
truth = gyrostat.solve(scene, model="full", tolerance=1e-13)["angular_velocity"]
print("rung      tolerance  stated error  true error      time")
boldest = 0.0
for rung in ("series-2", "series", "full"):
    for tolerance in (1e-2, 1e-5, 1e-8):
        answer = gyrostat.solve(scene, model=rung, tolerance=tolerance)
        stated, error = answer.error["angular_velocity"], np.linalg.norm(answer["angular_velocity"] - truth) / np.linalg.norm(truth)
        print(f"{rung:9} {tolerance:9.0e}  {stated:12.1e}  {error:10.1e}  {1e6 * answer.seconds:5.0f} us  {'' if answer.met else 'not met'}")
        boldest = max(boldest, error / stated)
print(f"true error at most {boldest:.6f} of the stated one")
