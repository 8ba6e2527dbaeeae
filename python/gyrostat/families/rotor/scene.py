# SPDX-License-Identifier: BSD-3-Clause
"""The scene file of a gyrostat with a driven rotor: its keys, the checks that take more than one key, and what they come to."""

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.families.rotor.functions import assembled_inertia
from gyrostat.fields import ROUNDING, UNSET, Choices, Field, Found, Table, Values

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["ALTERNATIVES", "EXAMPLE", "KEYS", "arguments", "mistakes"]

KEYS: Final[dict[str, Table]] = {
    "body": (
        Field("inertia", "inertia", "inertia of the whole gyrostat, rotor locked, about its mass centre: three principal moments "
              "along the body axes, or a symmetric 3x3 tensor", "kg m^2", UNSET, low=1e-40),
    ),
    "carrier": (
        Field("inertia", "inertia", "inertia of the carrier alone about its own centroid: three principal moments along the body "
              "axes, or a symmetric 3x3 tensor", "kg m^2", UNSET, low=1e-40),
        Field("mass", "number", "mass of the carrier", "kg", UNSET, low=0, open_low=True),
    ),
    "rotor": (
        Field("axis", "direction", "axis of the rotor, body axes, of unit length"),
        Field("axial_inertia", "number", "inertia of the rotor about its axis", "kg m^2", low=1e-40),
        Field("mass", "number", "mass of the rotor", "kg", UNSET, low=0, open_low=True),
        Field("equatorial_inertia", "number", "inertia of the rotor across its axis, about its own centroid", "kg m^2", UNSET,
              low=1e-40),
        Field("offset", "vector", "from the carrier's centroid to the rotor's, body axes", "m", UNSET),
    ),
    "motor": (
        Field("slope", "number", "moment on the rotor lost for each rad/s: the moment is -slope (rate - no_load_rate)",
              "N m s/rad", low=0),
        Field("no_load_rate", "number", "rate of the rotor, relative to the carrier, at which the motor gives no moment", "rad/s"),
    ),
    "initial": (
        Field("angular_velocity", "vector", "angular velocity of the carrier at t = 0, body axes", "rad/s"),
        Field("rotor_rate", "number", "rate of the rotor at t = 0, relative to the carrier", "rad/s"),
        Field("attitude", "quaternion", "attitude at t = 0, body to inertial, [x, y, z, w]", "", (0.0, 0.0, 0.0, 1.0)),
    ),
}
ALTERNATIVES: Final[tuple[Choices, ...]] = (
    (("body.inertia",), ("carrier.inertia", "carrier.mass", "rotor.mass", "rotor.equatorial_inertia", "rotor.offset")),
)
EXAMPLE: Final[dict[str, Any]] = {
    "solve.duration": 100.0, "solve.samples": 101, "body.inertia": (3.2, 4.1, 5.0), "carrier.inertia": (2.1, 2.6, 3.2), "carrier.mass": 12.0,
    "rotor.axis": (0.36, 0.48, 0.8), "rotor.axial_inertia": 0.35, "rotor.mass": 3.0, "rotor.equatorial_inertia": 0.3, "rotor.offset": (0.2, -0.15, 0.3),
    "motor.slope": 0.05, "motor.no_load_rate": 30.0, "initial.angular_velocity": (0.1, 0.2, 0.3), "initial.rotor_rate": 0.0,
}


def mistakes(tables: Values) -> Found:
    """A rotor that its own mass, or the whole gyrostat, can hold."""
    rotor, whole = tables["rotor"], tables["body"]["inertia"]
    axial, equatorial = rotor["axial_inertia"], rotor["equatorial_inertia"]
    if equatorial is not UNSET and axial > 2 * equatorial * (1 + ROUNDING):
        yield ("rotor.axial_inertia", axial, f"this exceeds twice rotor.equatorial_inertia = {equatorial!r}",
               f"no rotor has more than {2 * equatorial:.9g} kg m^2, the value of a thin disc: check both")
    if whole is not UNSET:
        tensor, axis = np.array(whole), np.array(rotor["axis"])
        most = 1 / float(axis @ np.linalg.solve(np.diag(tensor) if tensor.ndim == 1 else tensor, axis))
        if axial >= most * (1 - ROUNDING):
            yield ("rotor.axial_inertia", axial, f"the whole gyrostat of body.inertia holds less than {most:.9g} kg m^2 about this axis",
                   f"give less than {most:.9g} kg m^2 (1/(e.theta^-1.e)), or the inertia of the whole, rotor included")


def arguments(scene: "Scene") -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body, carrier, rotor, motor, start = (
        scene.tables[name] for name in ("solve", "body", "carrier", "rotor", "motor", "initial"))
    axis = np.array(rotor["axis"], dtype=float)
    if body["inertia"] is not None:
        inertia = np.array(body["inertia"], dtype=float)
    else:
        inertia = assembled_inertia(
            carrier_inertia=carrier["inertia"], carrier_mass=carrier["mass"], rotor_mass=rotor["mass"], axis=axis,
            axial_inertia=rotor["axial_inertia"], equatorial_inertia=rotor["equatorial_inertia"], offset=rotor["offset"])
    return {
        "inertia": inertia, "axis": axis, "axial_inertia": rotor["axial_inertia"], "slope": motor["slope"],
        "no_load_rate": motor["no_load_rate"], "angular_velocity": np.array(start["angular_velocity"], dtype=float),
        "rotor_rate": start["rotor_rate"], "attitude": np.array(start["attitude"], dtype=float), "times": scene.times,
        "tolerance": solving["tolerance"], "model": solving["model"], "integrator": solving["integrator"],
    }
