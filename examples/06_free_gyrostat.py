# SPDX-License-Identifier: BSD-3-Clause
"""A satellite drifts with its wheel running and nothing acting on it. Which way does it face in a year, and how sure is that?"""

import numpy as np

from gyrostat import free
from gyrostat.rotation import matrix_from_quaternion

year = 365.25 * 86400  # s
answer = free.solve(
    inertia=[35, 22, 16], angular_velocity=[0.004, 0.0055, 0.007],  # kg m^2, rad/s
    wheels=[{"axis": [0, 0, 1], "axial_inertia": 0.02, "rate": 10}],  # kg m^2, rad/s; a motor holds its rate
    times=[0, year], ask=["attitude", "angular_momentum"])
print("rung", answer.model)
print(f"attitude in a year [x, y, z, w]: {' '.join(f'{x:.9f}' for x in answer['attitude'][-1])}, within {answer.error['attitude']:.1e} rad")

# Nothing acts, so the momentum must stand in space, wherever the body has turned: a check.
before, after = (matrix_from_quaternion(q) @ M for q, M in zip(answer["attitude"], answer["angular_momentum"], strict=True))
print(f"the momentum has moved by {np.linalg.norm(after - before) / np.linalg.norm(before):.1e} rad in space")
