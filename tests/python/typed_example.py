# SPDX-License-Identifier: BSD-3-Clause
"""A small program of a user; mypy --strict reads it in test_package.py."""

import gyrostat
import numpy as np
from gyrostat import deceleration, elliptic, heavy, rotation, rotor, spinning


def libraries() -> list[str]:
    """Name and version of each optional library that this build holds."""
    info = gyrostat.build_info()
    return [f"{name} {info[name]}" for name in ("gsl", "cvode") if info[name] is not None]


def despin_times(scene: str, torques: list[float]) -> list[float]:
    """Stop time of a scene for several equal control torques, s."""
    return [float(gyrostat.solve(scene, control=[torque] * 3).scalars["stop_time"]) for torque in torques]


answer = gyrostat.solve(gyrostat.load("tiangong-1"), tolerance=1e-2)
largest: float = answer.greatest_error
momentum = np.asarray(answer["angular_momentum_norm"])
brake: gyrostat.Answer = deceleration.solve(inertia=[3.0, 2.0, 1.5], control=[0.1, 0.1, 0.1], drag=0.1, angular_momentum=[1.0, 2.0, 3.0], times=[0.0, 1.0])
errors: dict[str, float] = brake.scalar_error
star = deceleration.quasi_stationary_modulus_squared(control=[0.95, 0.8, 1.0])
sweep = deceleration.averaged(inertia=[3.0, 2.0, 1.5], control=np.ones((4, 3)), drag=0.1, angular_momentum=[1.0, 2.0, 3.0], t=[0.0, 1.0])
K = elliptic.complete(star).K
turn = rotation.matrix_from_vector([0.0, 0.0, 1.0])
theta = rotor.assembled_inertia(carrier_inertia=[2.0, 3.0, 4.0], carrier_mass=9.0, rotor_mass=1.0, axis=[0.0, 0.0, 1.0],
                                axial_inertia=0.1, equatorial_inertia=0.06, offset=[0.0, 0.1, 0.2])
lean = spinning.pointing_error(inertia=[8.0, 7.0, 11.0], torque=np.ones((4, 3)), spin_rate=2.0)
burn = spinning.linear_grid(inertia=[8.0, 7.0, 11.0], torque=[0.1, 0.0, 0.0], force=[0.0, 0.0, 3.0], angular_velocity=[0.0, 0.0, 2.0],
                            step=0.1, samples=50)
sleep = heavy.sleeping_top(inertia=[0.002, 0.002, 0.001], mass=0.5, centre_of_mass=[0.0, 0.0, 0.04], gravity=9.8, spin=np.array([20.0, 60.0]))
orbit = heavy.periodic_orbit(inertia=[0.0011, 0.0016, 0.002], mass=0.8, centre_of_mass=[0.012, 0.009, 0.01], gravity=9.8, spin=150.0, cos_inclination=0.1)
monitor = gyrostat.Monitor()
print(gyrostat.__version__, *libraries(), despin_times("tiangong-1", [0.4, 0.5]), largest, errors, momentum[-1], sweep.stop_time, K, turn, theta @ turn, lean[0],
      burn.x3[-1], sleep.verdict[0], orbit.period, monitor.progress)
