# SPDX-License-Identifier: BSD-3-Clause
"""The scene file of a free body with wheels: its keys and what they come to."""

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.fields import UNSET, Choices, Field, Table

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["ALTERNATIVES", "ARGUMENTS", "EXAMPLE", "KEYS", "arguments"]

WHEEL: Final[Table] = (
    Field("axis", "direction", "axis of the wheel, body axes, of unit length"),
    Field("axial_inertia", "number", "inertia of the wheel about its axis", "kg m^2", low=1e-40),
    Field("rate", "number", "rate of the wheel at t = 0, relative to the body", "rad/s"),
    Field("type", "choice", "held: a motor keeps the rate; free: the wheel turns without friction", default="held", choices=("held", "free")),
)
KEYS: Final[dict[str, Table]] = {
    "": (Field("wheel", "records", "wheels on the body, a table [[wheel]] each", default=(), parts=WHEEL),),
    "body": (
        Field("inertia", "inertia", "inertia of the whole about its mass centre, wheels locked: three principal moments along the body axes, "
              "or a symmetric 3x3 tensor", "kg m^2", low=1e-40),
        Field("rotor_momentum", "vector", "angular momentum, relative to the body and constant, of wheels that are not listed", "N m s",
              (0.0, 0.0, 0.0)),
    ),
    "initial": (
        Field("angular_velocity", "vector", "angular velocity at t = 0, body axes", "rad/s", UNSET),
        Field("angular_momentum", "vector", "total angular momentum at t = 0, body axes", "N m s", UNSET),
        Field("attitude", "quaternion", "attitude at t = 0, body to inertial, [x, y, z, w]", "", (0.0, 0.0, 0.0, 1.0)),
    ),
    "view": (
        Field("axis", "direction", "axis of the body that looks, of unit length", "", UNSET),
        Field("direction", "direction", "what it looks for, inertial axes, of unit length", "", UNSET),
        Field("half_angle", "number", "half the opening of the cone in which it sees", "rad", UNSET, low=0, high=3.141592653589793),
    ),
}
ALTERNATIVES: Final[tuple[Choices, ...]] = (
    (("initial.angular_velocity",), ("initial.angular_momentum",)),
    (("view.axis", "view.direction", "view.half_angle"), ()),
)
# The argument of `solve` that a table is.
ARGUMENTS: Final = {"wheels": ("", "wheel"), "view": ("", "view")}
EXAMPLE: Final[dict[str, Any]] = {
    "solve.duration": 100.0, "solve.samples": 101, "body.inertia": (35.0, 22.0, 16.0), "initial.angular_velocity": (0.4, 0.55, 0.7),
    "initial.angular_momentum": (14.0, 12.1, 11.2), "view.axis": (0.0, 0.0, 1.0), "view.direction": (1.0, 0.0, 0.0), "view.half_angle": 0.5,
    "wheel": ({"axis": (0.0, 0.0, 1.0), "axial_inertia": 2.5, "rate": 40.0, "type": "held"},),
}


def arguments(scene: "Scene") -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body, start, view = (scene.tables[name] for name in ("solve", "body", "initial", "view"))
    given = {name: None if start[name] is UNSET else np.array(start[name], dtype=float) for name in ("angular_velocity", "angular_momentum")}
    return {
        "inertia": np.array(body["inertia"], dtype=float), "rotor_momentum": np.array(body["rotor_momentum"], dtype=float),
        "wheels": [dict(wheel) for wheel in scene.top["wheel"]], **given, "attitude": np.array(start["attitude"], dtype=float),
        "view": None if view["axis"] is UNSET else dict(view), "times": scene.times, "tolerance": solving["tolerance"],
        "model": solving["model"], "integrator": solving["integrator"],
    }
