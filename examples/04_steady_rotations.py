# SPDX-License-Identifier: BSD-3-Clause
"""A satellite has fallen into a flat spin. Which steady rotations does it have with its wheel at speed, which are stable, and does spinning
the wheel up recover it? No integration for the first two: algebra."""

import numpy as np

import gyrostat
from gyrostat import rotor

# Intelsat V: the wheel along the axis of least inertia, missed by one degree.
scene = gyrostat.load("intelsat-v-flat-spin")
inertia, axis = scene.tables["body"]["inertia"], np.array(scene.tables["rotor"]["axis"])
momentum = np.linalg.norm(np.array(inertia) * scene.tables["initial"]["angular_velocity"])  # the wheel is at rest
steady = rotor.steady_rotations(inertia=inertia, axis=axis, axial_inertia=scene.tables["rotor"]["axial_inertia"], momentum=momentum,
                                **scene.tables["motor"])


def from_wheel(direction: np.ndarray) -> float:
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(direction, axis)), direction @ axis)))


for i in range(int(steady.count)):
    print(f"{i}: {steady.type[i]:8} spins at {steady.spin_rate[i]:9.6f} rad/s, wheel axis {from_wheel(steady.direction[i]):6.2f} deg from the "
          f"momentum, decay rate {steady.decay_rate[i]:.3e} /s")
end = gyrostat.solve(scene, times=[0.0], ask=["attractor"]).scalars["attractor"]
if end is None:
    print("where it goes is not decided yet")
else:
    print(f"it ends in rotation {end}")
    print(f"wheel axis in the end {from_wheel(steady.direction[end]):.4f} deg from the momentum")
