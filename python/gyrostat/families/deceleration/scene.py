# SPDX-License-Identifier: BSD-3-Clause
"""The scene file of a body that is brought to rest: its keys, and what they come to."""

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.fields import UNSET, Choices, Field, Table

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["ALTERNATIVES", "EXAMPLE", "KEYS", "arguments"]

KEYS: Final[dict[str, Table]] = {
    "solve": (
        Field("elliptic", "choice", "for rungs that use elliptic integrals", "", "auto", ("auto", "native", "gsl")),
    ),
    "body": (
        Field("inertia", "inertia", "three principal moments along the body axes, or a symmetric 3x3 tensor",
              "kg m^2", low=1e-40),
        Field("rotor_momentum", "vector", "momentum of the rotors in the carrier, relative to it, constant",
              "N m s", (0.0, 0.0, 0.0)),
    ),
    "torque": (
        Field("control", "vector", "greatest control torque along each body axis", "N m", low=0),
        Field("drag", "number", "drag rate of the medium", "1/s", low=0),
        Field("law", "choice", "what the control opposes: the total momentum or the carrier's", "", "total",
              ("total", "carrier")),
        Field("drag_law", "choice", "what the drag is proportional to: the total momentum or the carrier's", "",
              "total", ("total", "carrier")),
    ),
    "initial": (
        Field("angular_velocity", "vector", "angular velocity of the carrier at t = 0, body axes", "rad/s", UNSET),
        Field("angular_momentum", "vector", "total angular momentum at t = 0, body axes", "N m s", UNSET),
        Field("attitude", "quaternion", "attitude at t = 0, body to inertial, [x, y, z, w]; only if attitude is wanted",
              "", UNSET),
    ),
}
ALTERNATIVES: Final[tuple[Choices, ...]] = (
    (("initial.angular_velocity",), ("initial.angular_momentum",)),
)
EXAMPLE: Final[dict[str, Any]] = {
    "solve.duration": 1000.0, "solve.samples": 101, "body.inertia": (35.0, 22.0, 16.0), "torque.control": (0.005, 0.008, 0.01), "torque.drag": 2e-4,
    "initial.angular_velocity": (0.5, 0.6, 0.7), "initial.angular_momentum": (17.5, 13.2, 11.2), "initial.attitude": (0.0, 0.0, 0.0, 1.0),
}


def arguments(scene: "Scene") -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body, torque, start = (scene.tables[name] for name in ("solve", "body", "torque", "initial"))
    inertia, rotor = np.array(body["inertia"], dtype=float), np.array(body["rotor_momentum"], dtype=float)
    omega = None
    if start["angular_momentum"] is not None:
        momentum = np.array(start["angular_momentum"], dtype=float)
    else:
        omega = np.array(start["angular_velocity"], dtype=float)
        momentum = (inertia * omega if inertia.ndim == 1 else inertia @ omega) + rotor
    return {
        "inertia": inertia, "rotor_momentum": rotor, "control": np.array(torque["control"], dtype=float),
        "drag": torque["drag"], "law": torque["law"], "drag_law": torque["drag_law"], "angular_momentum": momentum,
        "angular_velocity": omega, "attitude": None if start["attitude"] is None else np.array(start["attitude"], dtype=float),
        "times": scene.times, "tolerance": solving["tolerance"], "model": solving["model"],
        "integrator": solving["integrator"], "elliptic": solving["elliptic"],
    }
