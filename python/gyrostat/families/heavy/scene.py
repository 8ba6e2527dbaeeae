# SPDX-License-Identifier: BSD-3-Clause
"""The scene file of a heavy body: its keys, the checks that take more than one key, and what they come to."""

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.broadcast import Floats
from gyrostat.families.heavy.functions import gravity_gradient
from gyrostat.fields import ROUNDING, UNSET, Choices, Field, Found, Table, Values

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["ALTERNATIVES", "EXAMPLE", "KEYS", "arguments", "mistakes"]

KEYS: Final[dict[str, Table]] = {
    "body": (
        Field("inertia", "inertia", "inertia about the fixed point: three principal moments along the body axes, or a symmetric "
              "3x3 tensor", "kg m^2", low=1e-40),
        Field("mass", "number", "mass", "kg", low=0, open_low=True),
        Field("centre_of_mass", "vector", "mass centre from the fixed point, body axes", "m"),
    ),
    "field": (
        Field("gravity", "number", "gravity g at the fixed point", "m/s^2", low=0),
        Field("gravity_gradient", "number", "N = 3 g/R with R the distance of the attracting centre", "1/s^2", UNSET, low=0),
        Field("centre_distance", "number", "distance R of the attracting centre from the fixed point", "m", UNSET, low=0, open_low=True),
    ),
    "initial": (
        Field("angular_velocity", "vector", "angular velocity at t = 0, body axes", "rad/s", UNSET),
        Field("down", "direction", "unit vector to the attracting centre at t = 0, body axes", "", UNSET),
        Field("attitude", "quaternion", "attitude at t = 0, body to inertial, [x, y, z, w]; inertial axis 3 points up", "", UNSET),
        Field("periodic", "record", "the periodic motion with r = spin and down = [+sin, 0, cos] of the inclination at t = 0, in principal "
              "axes", "", UNSET, parts=(
                  Field("spin", "number", "rate about axis 3 at t = 0", "rad/s"),
                  Field("cos_inclination", "number", "third component of down at t = 0", "", low=-1, high=1, open_low=True, open_high=True))),
    ),
}
ALTERNATIVES: Final[tuple[Choices, ...]] = (
    (("field.gravity_gradient",), ("field.centre_distance",), ()),
    (("initial.angular_velocity",), ("initial.periodic",)),
    (("initial.down",), ("initial.attitude",), ("initial.periodic",)),
)
EXAMPLE: Final[dict[str, Any]] = {
    "solve.duration": 1.0, "solve.samples": 101, "body.inertia": (0.0011, 0.0016, 0.002), "body.mass": 0.8, "body.centre_of_mass": (0.012, 0.009, 0.01),
    "field.gravity": 9.80665, "field.gravity_gradient": 4.6e-6, "field.centre_distance": 6.4e6, "initial.angular_velocity": (0.0, 0.0, 150.0),
    "initial.down": (0.6, 0.0, 0.8), "initial.attitude": (1.0, 0.0, 0.0, 0.0), "initial.periodic": {"spin": 150.0, "cos_inclination": 0.1},
}


def mistakes(tables: Values) -> Found:
    """Second moments of mass about the mass centre that are not negative: stronger than the triangle inequality."""
    body = tables["body"]
    inertia, centre = np.array(body["inertia"]), np.array(body["centre_of_mass"])
    inertia = np.diag(inertia) if inertia.ndim == 1 else inertia
    about_point = np.trace(inertia) / 2 * np.eye(3) - inertia
    slack = -1.3 * ROUNDING * float(np.max(np.abs(inertia)))  # less than what the core allows
    with np.errstate(over="ignore", invalid="ignore"):
        about_centre = about_point - body["mass"] * np.outer(centre, centre)
    least, axes = np.linalg.eigh(about_point)
    if least[0] < slack:
        yield ("body.inertia", body["inertia"], "by rounding, a moment exceeds the sum of the two others",
               "make the greatest moment no larger than the sum of the two others")
    elif not np.all(np.isfinite(about_centre)) or np.linalg.eigvalsh(about_centre)[0] < slack:
        far = centre / float(np.linalg.norm(centre))
        with np.errstate(divide="ignore"):
            reach = 1 / math.sqrt(body["mass"] * float(np.sum(np.where(axes.T @ far == 0, 0.0, (axes.T @ far) ** 2 / np.maximum(least, 0)))))
        yield ("body.centre_of_mass", body["centre_of_mass"], "no body with this mass and this inertia about the fixed point has its mass "
               "centre there", f"in this direction it lies at most {reach:.9g} m from the fixed point: check the units, and that the inertia is "
               "about the fixed point, not the mass centre")


def arguments(scene: "Scene") -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body, field, start = (scene.tables[name] for name in ("solve", "body", "field", "initial"))
    distance = field["centre_distance"]
    gradient = field["gravity_gradient"] or 0.0 if distance is None else float(gravity_gradient(gravity=field["gravity"], distance=distance))

    def vector(value: Any) -> Floats | None:
        return None if value is None else np.array(value, dtype=float)

    return {
        "inertia": np.array(body["inertia"], dtype=float), "mass": body["mass"], "centre_of_mass": np.array(body["centre_of_mass"]),
        "gravity": field["gravity"], "gravity_gradient": gradient,
        **{name: vector(start[name]) for name in ("angular_velocity", "down", "attitude")},
        "periodic": None if start["periodic"] is None else dict(start["periodic"]),
        "times": scene.times, "tolerance": solving["tolerance"], "model": solving["model"], "integrator": solving["integrator"],
    }
