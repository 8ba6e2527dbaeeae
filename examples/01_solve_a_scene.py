# SPDX-License-Identifier: BSD-3-Clause
"""A satellite spins up its wheel: where is the wheel after a minute, ten minutes, an hour?"""

import numpy as np

import gyrostat

axis = np.array([1, 0.05, 0.04])
scene = {  # as a scene file has it; gyrostat.load reads one
    "name": "spin-up", "kind": "rotor",
    "solve": {"times": [60, 600, 3600], "tolerance": 1e-6},  # s; greatest relative error wanted in any column
    "body": {"inertia": [86, 118, 141]},  # kg m^2
    "rotor": {"axis": axis / np.linalg.norm(axis), "axial_inertia": 0.28},
    "motor": {"slope": 0.13, "no_load_rate": 60},  # N m s/rad, rad/s
    "initial": {"angular_velocity": [0, 0.01, 0.1], "rotor_rate": 0},  # rad/s: about the axis of greatest inertia
}

# The ladder: the cheapest rung whose own error estimate meets the tolerance answers.
answer = gyrostat.solve(scene)
for tried in answer.tried:
    print(f"{tried.model:12} {'answered' if tried.accepted else f'passed over: {tried.why}'}")
print(f"estimated error of the wheel's rate {answer.error['rotor_rate']:.1e}, tolerance {'met' if answer.met else 'not met'}")
for t, rate in zip(answer.t, answer["rotor_rate"], strict=True):
    print(f"t = {t:.0f} s: wheel at {rate:.6f} rad/s")
