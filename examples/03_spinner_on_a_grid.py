# SPDX-License-Identifier: BSD-3-Clause
"""A spinning stage thrusts a little off its axis: a hundred thousand times of its motion as arrays, and where it points in the mean."""

import numpy as np

from gyrostat import spinning

stage = {
    "inertia": [560, 540, 820],  # kg m^2; axis 3 is the spin axis
    "torque": [9, -4, 0],  # N m, constant in the body: the thrust misses the mass centre
    "force": [0, 0, 4000],  # N
    "angular_velocity": [0, 0, 3],  # rad/s
}
grid = spinning.linear_grid(**stage, mass=2000, step=0.01, samples=100_000)

# psi and phi tilt axis 3: it points to (phi, -psi) in axes that do not spin about it, turned by theta to inertial ones
direction = np.exp(1j * grid.theta) * (grid.phi - 1j * grid.psi)
print(f"greatest tilt {np.abs(direction).max():.6f} rad")
print(f"mean direction off by {abs(direction.mean()):.6f} rad")
print(f"after {grid.t[-1]:.0f} s: {grid.v3[-1]:.1f} m/s along axis 3, ({grid.v1[-1]:.3f}, {grid.v2[-1]:.3f}) m/s across")
print(f"the same mean without the motion: {spinning.pointing(**stage).error:.6f} rad")
