# SPDX-License-Identifier: BSD-3-Clause
"""Ask for what matters, as well as it matters: half a degree of attitude and the wheel's rate within 0.01 rad/s, nothing else. What is not
asked for costs nothing."""

import numpy as np

from gyrostat import rotor

axis = np.array([1, 0.05, 0.04])
answer = rotor.solve(
    inertia=[86, 118, 141], axis=axis / np.linalg.norm(axis), axial_inertia=0.28, slope=0.13, no_load_rate=60,
    angular_velocity=[0, 0.01, 0.1], times=[600],
    ask={"attitude": "0.5 deg", "rotor_rate": "0.01 rad/s"})  # units are understood; a bare number is relative
for name in answer:
    print(f"{name}: estimated error {answer.error[name]:.1e}, wanted {answer.tolerances[name]:.1e}")
worst = max(answer.error[name] / answer.tolerances[name] for name in answer)
print(f"rung {answer.model}, greatest error {worst:.2e} of what was allowed")
