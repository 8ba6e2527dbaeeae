# SPDX-License-Identifier: BSD-3-Clause
"""An attitude at the start in each form that a scene file may give it in, and the quaternion that it comes to.

All forms say how the body is turned against the inertial axes: v_I = R_IB v_B, as the quaternion [x, y, z, w] of `attitude` does.
"""

import math
from collections.abc import Mapping
from functools import reduce
from itertools import product
from typing import Any, Final

import numpy as np

from gyrostat.errors import Refused
from gyrostat.fields import ROUNDING, UNSET, Choices, Field, Table
from gyrostat.rotation import quaternion_from_matrix, quaternion_from_vector

__all__ = ["EXAMPLE", "FORMS", "NOT_ORTHONORMAL", "SEQUENCES", "axes_of", "form_of", "off_orthonormal", "quaternions", "require_rotation",
           "rotation_rows", "settle", "with_alternatives", "with_forms"]

Quaternion = tuple[float, float, float, float]

# Rows of a direction cosine matrix are of unit length and across each other within this, and where they are not within the second, a warning says so.
ORTHONORMAL: Final = 1e-8
ROUNDED: Final = 1e-12
# The code of that warning and its text, to which the greatest product that should be 0 or 1 adds how far it is off.
NOT_ORTHONORMAL: Final = ("not-orthonormal", "the direction cosines of the start are rounded, and the nearest rotation is taken; off by")

FORMS: Final[Table] = (
    Field("quaternion_scalar_first", "quaternion", "the attitude as [w, x, y, z]", "", UNSET),
    Field("euler", "record", "the attitude as three turns, each about an axis of the body as the one before left it: with 3-2-1 body to inertial "
          "is R3(a1) R2(a2) R1(a3)", "", UNSET, parts=(
              Field("sequence", "sequence", "three axes, neighbours different, as 3-2-1 or ZYX"),
              Field("angles", "vector", "angles of the turns in the order of the sequence", "rad"))),
    Field("mrp", "vector", "the attitude as modified Rodrigues parameters: axis times tan(angle/4), of any size", "", UNSET),
    Field("rotation_vector", "vector", "the attitude as axis times angle, of any size", "rad", UNSET),
    Field("dcm_body_to_inertial", "rotation", "the attitude as direction cosines, three rows: they take body components to inertial ones", "", UNSET,
          low=-1 - ORTHONORMAL, high=1 + ORTHONORMAL),
    Field("dcm_inertial_to_body", "rotation", "the attitude as direction cosines, three rows: they take inertial components to body ones", "", UNSET,
          low=-1 - ORTHONORMAL, high=1 + ORTHONORMAL),
)
EXAMPLE: Final[dict[str, Any]] = {f"initial.{name}": value for name, value in {
    "quaternion_scalar_first": (1.0, 0.0, 0.0, 0.0), "euler": {"sequence": "3-2-1", "angles": ("10 deg", 0.0, 0.0)}, "mrp": (0.0, 0.0, 0.1),
    "rotation_vector": (0.0, 0.0, "20 deg"), "dcm_body_to_inertial": ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "dcm_inertial_to_body": ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
}.items()}
_THREES: Final = [axes for axes in product(range(3), repeat=3) if axes[0] != axes[1] != axes[2]]
# Each as digits and as letters, with its axes counted from 0.
SEQUENCES: Final[dict[str, tuple[int, ...]]] = {
    **{"-".join(str(axis + 1) for axis in axes): axes for axes in _THREES}, **{"".join("XYZ"[axis] for axis in axes): axes for axes in _THREES}}


def with_forms(table: Table) -> Table:
    """The keys of a table; where there is an attitude, with all its forms behind it."""
    return tuple(each for field in table for each in ((field, *FORMS) if field.name == "attitude" else (field,)))


def with_alternatives(choices: tuple[Choices, ...]) -> tuple[Choices, ...]:
    """What can be given in one of several ways, the attitude in each of its forms; it may be left out unless something says otherwise."""
    attitude = ("initial.attitude",)
    forms = tuple((f"initial.{field.name}",) for field in FORMS)
    if not any(attitude in each for each in choices):
        choices = (*choices, (attitude, ()))
    return tuple((*each, *forms) if attitude in each else each for each in choices)


def form_of(initial: Mapping[str, Any]) -> str:
    """The form in which a start gives its attitude, where that is not the quaternion itself; else empty."""
    return next((field.name for field in FORMS if initial.get(field.name) is not UNSET), "")


def settle(initial: dict[str, Any]) -> None:
    """Puts the quaternion of a checked start under `attitude`, whatever form it was given in."""
    if form := form_of(initial):
        initial["attitude"] = _quaternion(form, initial[form])


def axes_of(sequence: str) -> tuple[int, ...]:
    """The axes of a sequence of turns, counted from 0. Raises Refused."""
    if sequence in SEQUENCES:
        return SEQUENCES[sequence]
    if sequence.upper() in SEQUENCES:
        raise Refused("small letters mean turns about fixed axes elsewhere",
                      f'write "{sequence.upper()}" for turns about the axes of the body, "{sequence.upper()[::-1]}" with the angles in reverse for fixed ones')
    axes = [axis for axis in sequence.upper() if axis not in "- ,"]
    if len(axes) == 3 and set(axes) <= set("123") and axes[0] != axes[1] != axes[2]:
        raise Refused("this is no sequence of axes", f'write "{"-".join(axes)}"')
    if len(axes) == 3 and (set(axes) <= set("123") or set(axes) <= set("XYZ")):
        raise Refused("two turns about one axis, one after the other, are one turn", 'write three axes, neighbours different, as "3-2-1" or "3-1-3"')
    raise Refused("this is no sequence of axes", 'write three axes, neighbours different, as "3-2-1" or "ZYX"')


def off_orthonormal(initial: Mapping[str, Any]) -> float:
    """How far the direction cosines of a checked start are off being orthonormal, where that is more than roundings; else 0."""
    form = form_of(initial)
    if not form.startswith("dcm"):
        return 0.0
    matrix = np.array(initial[form])
    off = float(np.max(np.abs(matrix @ matrix.T - np.eye(3))))
    return off if off > ROUNDED else 0.0


def quaternions(form: str, matrices: Any) -> list[Quaternion]:
    """The unit quaternions of direction cosines (n, 3, 3) that are given in this form."""
    return [_quaternion(form, matrix) for matrix in matrices]


def rotation_rows(matrices: Any) -> tuple[list[str], Any]:
    """Of direction cosines (n, 3, 3): why they are those of no rotation, empty where they are; and which of these are rounded, (n,)."""
    wrong = [""] * len(matrices)
    with np.errstate(invalid="ignore"):
        off = np.max(np.abs(matrices @ np.swapaxes(matrices, -1, -2) - np.eye(3)), axis=(-1, -2))
        suspect = (off > ORTHONORMAL) | (np.linalg.det(matrices) < 0)
    for row in np.flatnonzero(suspect):
        try:
            require_rotation(matrices[row])
        except Refused as refused:
            wrong[row] = f"{NOT_ORTHONORMAL[0]}: {refused.problem}"
    return wrong, off > ROUNDED


def require_rotation(rows: Any) -> None:
    """Raises Refused for direction cosines that are those of no rotation."""
    matrix = np.array(rows)
    gram = matrix @ matrix.T
    off = np.abs(gram - np.eye(3))
    i, j = np.unravel_index(int(np.argmax(off)), off.shape)
    if off[i, j] > ORTHONORMAL:
        what = f"row {i + 1} has the length {math.sqrt(gram[i, i]):.12g}, not 1" if i == j else \
               f"rows {i + 1} and {j + 1} are not across each other: their product is {gram[i, j]:.3g}"
        raise Refused(what, "give nine direction cosines to at least 9 digits, a row each of the axes that they lead to")
    if np.linalg.det(matrix) < 0:
        raise Refused("the determinant is -1: this is a mirror, not a rotation", "one axis points the wrong way: change the sign of its row or column")


def _product(p: Quaternion, q: Quaternion) -> Quaternion:
    (a, b, c, d), (x, y, z, w) = p, q
    return d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x, d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z


def _turn(axis: int, angle: float) -> Quaternion:
    x, y, z = (math.sin(angle / 2) if i == axis else 0.0 for i in range(3))
    return x, y, z, math.cos(angle / 2)


def _from_mrp(parameters: tuple[float, ...]) -> Quaternion:
    square = sum(each * each for each in parameters)
    x, y, z = (2 * each / (1 + square) for each in parameters)
    return x, y, z, (1 - square) / (1 + square)


def _from_matrix(matrix: Any) -> Quaternion:
    """Of the rotation nearest to the matrix, which is orthonormal within 1e-8: two steps by Newton and Schulz, the second for roundings."""
    for _ in range(2):
        matrix = matrix @ (3 * np.eye(3) - matrix.T @ matrix) / 2
    x, y, z, w = quaternion_from_matrix(matrix).tolist()
    return x, y, z, w


def _quaternion(form: str, value: Any) -> Quaternion:
    """The unit quaternion of an attitude; of its two signs the one with w >= 0 unless the sign was given."""
    match form:
        case "quaternion_scalar_first":
            w, x, y, z = value
            return x, y, z, w
        case "euler":
            made = reduce(_product, (_turn(axis, angle) for axis, angle in zip(axes_of(value["sequence"]), value["angles"], strict=True)))
        case "mrp":
            made = _from_mrp(value)
        case "rotation_vector":
            made = tuple(quaternion_from_vector(value).tolist())
        case _:
            made = _from_matrix(np.array(value).T if form == "dcm_inertial_to_body" else np.array(value))
    norm = math.hypot(*made)
    scale = math.copysign(1.0 if abs(norm - 1) <= ROUNDING else 1 / norm, made[3])
    x, y, z, w = (each * scale for each in made)
    return x, y, z, w
