# SPDX-License-Identifier: BSD-3-Clause
"""A flight computer looks ahead: how long until a tumbling body has lost 99 % of its momentum, by the averaged equations?

In C++ the loop itself is shown; here they are called over an array of times, for all five measurements at once."""

import numpy as np

from gyrostat import deceleration

measured = np.array([40, 25, 16.5]) * 0.9 ** np.arange(5)[:, None]  # M, N m s, body axes
t = np.linspace(0, 6000, 6001)  # s
motion = deceleration.averaged(inertia=[35, 22, 16], control=[0.005, 0.008, 0.010], drag=2e-4, angular_momentum=measured, t=t)
left = motion.momentum_norm / np.linalg.norm(measured, axis=1)[:, None]
down = [np.interp(-0.01, -each, t) for each in left]
print(f"down to one per cent after {down[0]:.2f} s")
print(f"the last of five looks ahead: {down[-1]:.2f} s more")
