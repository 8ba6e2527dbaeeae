# SPDX-License-Identifier: BSD-3-Clause
"""The keys of a scene file: the one table behind the validator (scenes.py) and the JSON Schema (schema.py)."""

from dataclasses import dataclass
from typing import Any, Final, Literal

__all__ = ["ALTERNATIVES", "Field", "KINDS", "LATER_KINDS", "LIMIT", "REQUIRED", "RUNGS", "Table", "UNSET"]

Form = Literal["text", "choice", "number", "count", "vector", "quaternion", "inertia", "times"]

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


Table = tuple[Field, ...]

RUNGS: Final[dict[str, tuple[str, ...]]] = {
    "deceleration": ("equal-torque", "averaged", "averaged-2", "full"),
}
# Kinds that the scene format knows and this version does not answer.
LATER_KINDS: Final = ("rotor", "spinning", "heavy")
# Integrators that the scene format knows and no kind of this version uses.
LATER_INTEGRATORS: Final = ("radau",)


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
        Field("integrator", "choice", "for rungs that integrate", "", "auto", ("auto", "taylor", "cvode")),
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
}

# Table -> sets of keys of which exactly one must be given, whole.
ALTERNATIVES: Final[dict[str, dict[str, tuple[tuple[str, ...], ...]]]] = {
    "deceleration": {
        "solve": (("duration", "samples"), ("times",)),
        "initial": (("angular_velocity",), ("angular_momentum",)),
    },
}
