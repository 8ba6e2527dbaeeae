# SPDX-License-Identifier: BSD-3-Clause
"""The keys of a scene file: the one table behind the validator (scenes.py) and the JSON Schema (schema.py)."""

from dataclasses import dataclass
from typing import Any, Final, Literal

__all__ = ["ALTERNATIVES", "Choice", "Field", "INTEGRATORS", "KINDS", "LIMIT", "MOST_SAMPLES", "REQUIRED", "RUNGS",
           "Table", "UNSET", "needed", "table_of"]

Form = Literal["text", "choice", "number", "count", "vector", "direction", "quaternion", "inertia", "moments", "times", "record"]

REQUIRED: Final = "required"  # the key must be given
UNSET: Final = None  # the key may be left out and then has no value

# Greatest size of any number: its square, and products of a few of them, stay finite in double precision.
LIMIT: Final = 1e60
MOST_SAMPLES: Final = 1_000_000


@dataclass(frozen=True, slots=True)
class Field:
    """One key: its form, meaning and legal interval. Bounds hold for every element."""

    name: str
    form: Form
    meaning: str
    unit: str = ""
    default: Any = REQUIRED
    choices: tuple[str, ...] = ()
    low: float = -LIMIT
    high: float = LIMIT
    open_low: bool = False  # the lower bound itself is not allowed
    open_high: bool = False
    parts: tuple["Field", ...] = ()  # of a record: its keys, all of them wanted


Table = tuple[Field, ...]

RUNGS: Final[dict[str, tuple[str, ...]]] = {
    "deceleration": ("equal-torque", "averaged", "averaged-2", "full"),
    "rotor": ("closed-form", "linear-tail", "full"),
    "spinning": ("linear", "second-order", "picard", "full"),
    "heavy": ("series-2", "series", "exact", "full"),
}
INTEGRATORS: Final[dict[str, tuple[str, ...]]] = {
    "deceleration": ("taylor", "cvode"),
    "rotor": ("taylor", "radau", "cvode"),
    "spinning": ("taylor", "cvode"),
    "heavy": ("taylor", "cvode"),
}


def _head(kind: str) -> Table:
    return (
        Field("name", "text", "name of the scene"),
        Field("kind", "choice", "family of the scene", choices=(kind,)),
        Field("source", "text", "where the numbers come from", default=""),
    )


def _solve(kind: str) -> Table:
    return (
        Field("duration", "number", "end of an even grid of times from 0", "s", UNSET, low=0, open_low=True),
        Field("samples", "count", "number of times of the even grid", "", UNSET, low=2, high=MOST_SAMPLES),
        Field("times", "times", "times of the answer, increasing, first >= 0", "s", UNSET, low=0),
        Field("tolerance", "number", "greatest relative error wanted in any output column", "", 1e-6, low=1e-15, high=0.5),
        Field("model", "choice", "rung of the ladder, or auto", "", "auto", ("auto", *RUNGS[kind])),
        Field("integrator", "choice", "for rungs that integrate", "", "auto", ("auto", *INTEGRATORS[kind])),
        Field("elliptic", "choice", "for rungs that use elliptic integrals", "", "auto", ("auto", "native", "gsl")),
    )


KINDS: Final[dict[str, dict[str, Table]]] = {
    "deceleration": {
        "": _head("deceleration"),
        "solve": _solve("deceleration"),
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
    },
    "rotor": {
        "": _head("rotor"),
        "solve": _solve("rotor"),
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
    },
    "spinning": {
        "": _head("spinning"),
        "solve": _solve("spinning"),
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
    },
    "heavy": {
        "": _head("heavy"),
        "solve": _solve("heavy"),
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
    },
}

# A way to give something: full keys ("table.key"), wanted together. Without keys: it may be left out.
Choice = tuple[str, ...]

# Sets of ways of which exactly one must be taken, whole.
ALTERNATIVES: Final[dict[str, tuple[tuple[Choice, ...], ...]]] = {
    "deceleration": (
        (("solve.duration", "solve.samples"), ("solve.times",)),
        (("initial.angular_velocity",), ("initial.angular_momentum",)),
    ),
    "rotor": (
        (("solve.duration", "solve.samples"), ("solve.times",)),
        (("body.inertia",), ("carrier.inertia", "carrier.mass", "rotor.mass", "rotor.equatorial_inertia", "rotor.offset")),
    ),
    "spinning": (
        (("solve.duration", "solve.samples"), ("solve.times",)),
        (("field.momentum",), ("field.charge", "field.flux_density", "field.arm", "field.angle"), ()),
        (("initial.euler_312",), ("initial.attitude",), ()),
    ),
    "heavy": (
        (("solve.duration", "solve.samples"), ("solve.times",)),
        (("field.gravity_gradient",), ("field.centre_distance",), ()),
        (("initial.angular_velocity",), ("initial.periodic",)),
        (("initial.down",), ("initial.attitude",), ("initial.periodic",)),
    ),
}


def table_of(key: str) -> str:
    """The table of a full key; empty at the top."""
    return key.rpartition(".")[0]


def needed(kind: str, table: str) -> bool:
    """No scene of the kind can do without the table."""
    return any(field.default is REQUIRED for field in KINDS[kind][table]) or any(
        all(any(table_of(key) == table for key in choice) for choice in choices) for choices in ALTERNATIVES[kind])
