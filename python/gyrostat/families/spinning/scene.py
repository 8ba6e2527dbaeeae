# SPDX-License-Identifier: BSD-3-Clause
"""The scene file of a thrusting spinner: its keys, and what they come to."""

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.families.spinning.functions import ORIGIN, charge_momentum
from gyrostat.fields import UNSET, Choices, Field, Table
from gyrostat.rotation import euler_312_from_quaternion

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["ALTERNATIVES", "ARGUMENTS", "EXAMPLE", "KEYS", "arguments"]

KEYS: Final[dict[str, Table]] = {
    "body": (
        Field("inertia", "moments", "three principal moments along the body axes, the third along the spin axis, or a diagonal "
              "3x3 tensor", "kg m^2", low=1e-40),
        Field("mass", "number", "mass", "kg", low=0, open_low=True),
        Field("rotor_momentum", "number", "momentum of the rotor along axis 3, relative to the carrier, constant", "N m s", 0.0),
    ),
    "field": (
        Field("momentum", "number", "charge momentum e H l^2 cos(sigma): the Lorentz torque is this times (q, -p, 0)", "N m s", UNSET),
        Field("charge", "number", "charge e", "C", UNSET),
        Field("flux_density", "number", "magnetic flux density H", "T", UNSET),
        Field("arm", "number", "distance l of the charge from the mass centre, along axis 3", "m", UNSET, low=0),
        Field("angle", "number", "angle sigma between axis 3 and the magnetic field", "rad", UNSET),
    ),
    "torque": (
        Field("body", "vector", "torque, constant in body axes", "N m"),
        Field("force", "vector", "force, constant in body axes", "N"),
    ),
    "initial": (
        Field("angular_velocity", "vector", "angular velocity of the carrier at t = 0, body axes", "rad/s"),
        Field("euler_312", "vector", "angles psi, phi, theta at t = 0: body to inertial is Rz(theta) Rx(psi) Ry(phi)", "rad", UNSET),
        Field("attitude", "quaternion", "attitude at t = 0, body to inertial, [x, y, z, w]", "", UNSET),
        Field("velocity", "vector", "velocity of the mass centre at t = 0, inertial axes", "m/s", (0.0, 0.0, 0.0)),
        Field("position", "vector", "position of the mass centre at t = 0, inertial axes", "m", (0.0, 0.0, 0.0)),
    ),
}
ALTERNATIVES: Final[tuple[Choices, ...]] = (
    (("field.momentum",), ("field.charge", "field.flux_density", "field.arm", "field.angle"), ()),
    (("initial.euler_312",), ("initial.attitude",), ()),
)
# Table and key of the arguments of `solve` that have another name there.
ARGUMENTS: Final = {"torque": ("torque", "body"), "charge_momentum": ("field", "momentum")}
EXAMPLE: Final[dict[str, Any]] = {
    "solve.duration": 100.0, "solve.samples": 101, "body.inertia": (8.0, 7.0, 11.0), "body.mass": 10.0, "field.momentum": 0.3, "field.charge": 0.003,
    "field.flux_density": 100.0, "field.arm": 1.1, "field.angle": 0.4, "torque.body": (0.04, -0.02, 0.0), "torque.force": (0.0, 0.0, 3.0),
    "initial.angular_velocity": (0.0, 0.0, 1.0), "initial.euler_312": (0.0, 0.0, 0.0), "initial.attitude": (0.0, 0.0, 0.0, 1.0),
}


def arguments(scene: "Scene") -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body, field, torque, start = (scene.tables[name] for name in ("solve", "body", "field", "torque", "initial"))
    momentum = field["momentum"] or 0.0
    if field["charge"] is not None:
        momentum = float(charge_momentum(charge=field["charge"], flux_density=field["flux_density"], arm=field["arm"], angle=field["angle"]))
    angles = euler_312_from_quaternion(start["attitude"]) if start["attitude"] is not None else start["euler_312"] or ORIGIN
    vectors = {"inertia": body["inertia"], "torque": torque["body"], "force": torque["force"],
               "angular_velocity": start["angular_velocity"], "euler_312": angles, "velocity": start["velocity"],
               "position": start["position"]}
    return {
        **{name: np.array(value, dtype=float) for name, value in vectors.items()}, "mass": body["mass"],
        "rotor_momentum": body["rotor_momentum"], "charge_momentum": momentum, "times": scene.times,
        "tolerance": solving["tolerance"], "model": solving["model"], "integrator": solving["integrator"],
    }
