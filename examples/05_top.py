# SPDX-License-Identifier: BSD-3-Clause
"""An unsymmetric top that spins fast: its periodic motion, the period, and whether what a small push does to it stays small."""

import math

import numpy as np

from gyrostat import heavy

top = {
    "inertia": [0.0011, 0.0016, 0.0020], "mass": 0.8,  # about the tip, kg m^2; kg
    "centre_of_mass": [0.012, 0.009, 0.010], "gravity": 9.80665,  # from the tip, m; m/s^2
}
spins = np.array([50.0, 100.0, 200.0, 400.0])  # rad/s; axis 3 leans so that its cosine to down is 0.1
orbits = heavy.periodic_orbit(**top, spin=spins, cos_inclination=0.1)
for i, spin in enumerate(spins):
    if orbits.why[i]:
        print(f"spin {spin:.0f} rad/s: {orbits.why[i]}")
        continue
    print(f"spin {spin:.0f} rad/s: period {orbits.period[i]:.9f} s, within {orbits.period_error[i]:.0e}; "
          f"sum of the multipliers {orbits.trace[i]:.6f}: {orbits.verdict[i]}")
    print(f"  turns in a period at spin {spin:.0f} rad/s: {orbits.period[i] * spin / (2 * math.pi):.6f}")
