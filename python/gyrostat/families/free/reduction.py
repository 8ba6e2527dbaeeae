# SPDX-License-Identifier: BSD-3-Clause
"""Body and wheels as one gyrostat, for figures and rivals; the ladder does the same in C++."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["reduced"]

Vectors = NDArray[np.float64]


def reduced(given: Mapping[str, Any]) -> tuple[Vectors, Vectors, Vectors]:
    """Inertia (3, 3) less that of the wheels that turn freely, the momentum (3,) of the wheels that the motion keeps, and M (3,) at the start.

    given : inertia, rotor_momentum, wheels, and angular_velocity or angular_momentum, as `solve` takes them.
    """
    inertia = np.array(given["inertia"], dtype=float)
    inertia = np.diag(inertia) if inertia.ndim == 1 else inertia
    wheels = [(np.array(w["axis"], dtype=float), w["axial_inertia"], w["rate"], w.get("type", "held") == "free") for w in given["wheels"]]
    l = np.array(given["rotor_momentum"], dtype=float)
    relative = l + sum((lam * rate * axis for axis, lam, rate, _ in wheels), np.zeros(3))
    omega = given["angular_velocity"]
    M = np.array(given["angular_momentum"], dtype=float) if omega is None else inertia @ omega + relative
    omega = np.linalg.solve(inertia, M - relative)
    for axis, lam, rate, free in wheels:
        if free:
            rate = rate + float(axis @ omega)
            inertia = inertia - lam * np.outer(axis, axis)
        l = l + lam * rate * axis
    return inertia, l, M
