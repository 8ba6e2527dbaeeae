# SPDX-License-Identifier: BSD-3-Clause
"""Rotations over arrays: quaternion, rotation tensor, rotation vector, each to each, and 3-1-2 angles.

A rotation takes body components to inertial components, v_I = R v_B. Quaternions (..., 4) are [x, y, z, w], or with
scalar_first=True [w, x, y, z], as in SciPy's Rotation; tensors are (..., 3, 3); rotation vectors (..., 3) are axis times angle
[rad]. Leading axes are free and the GIL is released. Exact through zero and half a turn: no small-angle branch. A quaternion need
not have unit norm but must not vanish; a tensor that is not orthogonal within 1e-6 raises DomainError.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gyrostat import _core
from gyrostat.broadcast import Floats, rows, shaped
from gyrostat.errors import DomainError

__all__ = [
    "angle_between", "euler_312_from_quaternion", "matrix_from_quaternion", "matrix_from_vector", "quaternion_from_euler_312",
    "quaternion_from_matrix", "quaternion_from_vector", "vector_from_matrix", "vector_from_quaternion",
]

ORTHOGONAL_TOLERANCE = 1e-6
LARGEST = 1e100  # angle


def _sized(name: str, values: Floats) -> Floats:
    """Rows of quaternions, of lengths of the order of 1: the squares of very large or small ones would leave the doubles."""
    greatest = np.abs(values).max(axis=1, initial=0.0, keepdims=True)
    good = np.isfinite(greatest) & (greatest > 0)
    if not np.all(good):
        row = int(np.argmin(good))
        raise DomainError(f"{name}, row {row} = {values[row].tolist()}: not finite, or zero")
    made: Floats = np.ldexp(values, -np.frexp(greatest)[1])
    return made


def _quaternions(quaternion: ArrayLike, scalar_first: bool) -> tuple[tuple[int, ...], Floats]:
    lead, (q,) = rows([("quaternion", quaternion, (4,))])
    q = _sized("quaternion", q)
    return lead, np.ascontiguousarray(np.roll(q, -1, axis=1)) if scalar_first else q


def _finite(name: str, value: ArrayLike) -> tuple[tuple[int, ...], Floats]:
    """Rows of three numbers, each at most 1e100, that far from where their squares leave the doubles."""
    lead, (made,) = rows([(name, value, (3,))])
    good = np.all(np.abs(made) <= LARGEST, axis=1)
    if not np.all(good):
        row = int(np.argmin(good))
        raise DomainError(f"{name}, row {row} = {made[row].tolist()}: give finite numbers, none over {LARGEST:g}")
    return lead, made


def _tensors(matrix: ArrayLike) -> tuple[tuple[int, ...], Floats]:
    lead, (m,) = rows([("matrix", matrix, (3, 3))])
    known = np.where(np.abs(m) <= 2, m, 2.0)  # no rotation has such a number
    off = np.abs(np.einsum("nij,nkj->nik", known, known) - np.eye(3)).max(axis=(1, 2), initial=0.0)
    good = (off <= ORTHOGONAL_TOLERANCE) & (np.linalg.det(known) > 0)
    if not np.all(good):
        row = int(np.argmin(good))
        raise DomainError(f"matrix, row {row} = {m[row].tolist()}: not a proper rotation within {ORTHOGONAL_TOLERANCE:g}")
    return lead, m.reshape(-1, 9)


def _ordered(q: Floats, lead: tuple[int, ...], scalar_first: bool) -> Floats:
    made: Floats = shaped(np.roll(q, 1, axis=1) if scalar_first else q, lead, 4)
    return made


def matrix_from_quaternion(quaternion: ArrayLike, *, scalar_first: bool = False) -> Floats:
    """(..., 4) -> (..., 3, 3)."""
    lead, q = _quaternions(quaternion, scalar_first)
    made: Floats = shaped(_core.matrix_from_quaternion(q), lead, 3, 3)
    return made


def quaternion_from_matrix(matrix: ArrayLike, *, scalar_first: bool = False) -> Floats:
    """(..., 3, 3) -> (..., 4), of unit norm; the sign is free."""
    lead, m = _tensors(matrix)
    return _ordered(_core.quaternion_from_matrix(m), lead, scalar_first)


def vector_from_quaternion(quaternion: ArrayLike, *, scalar_first: bool = False) -> Floats:
    """(..., 4) -> (..., 3): the shortest rotation vector, at most pi long."""
    lead, q = _quaternions(quaternion, scalar_first)
    made: Floats = shaped(_core.vector_from_quaternion(q), lead, 3)
    return made


def quaternion_from_vector(vector: ArrayLike, *, scalar_first: bool = False) -> Floats:
    """(..., 3) -> (..., 4); any length up to 1e100."""
    lead, v = _finite("vector", vector)
    return _ordered(_core.quaternion_from_vector(v), lead, scalar_first)


def vector_from_matrix(matrix: ArrayLike) -> Floats:
    """(..., 3, 3) -> (..., 3): the shortest rotation vector, at most pi long."""
    lead, m = _tensors(matrix)
    made: Floats = shaped(_core.vector_from_matrix(m), lead, 3)
    return made


def matrix_from_vector(vector: ArrayLike) -> Floats:
    """(..., 3) -> (..., 3, 3); any length up to 1e100."""
    lead, v = _finite("vector", vector)
    made: Floats = shaped(_core.matrix_from_vector(v), lead, 3, 3)
    return made


def euler_312_from_quaternion(quaternion: ArrayLike, *, scalar_first: bool = False) -> Floats:
    """(..., 4) -> (..., 3): psi, phi, theta of R = Rz(theta) Rx(psi) Ry(phi) [rad], |psi| <= pi/2, phi and theta in [-pi, pi].

    At |psi| = pi/2 only theta + phi (psi > 0) or theta - phi has a meaning, and comes back right.
    """
    lead, q = _quaternions(quaternion, scalar_first)
    made: Floats = shaped(_core.euler_312_from_quaternion(q), lead, 3)
    return made


def quaternion_from_euler_312(angles: ArrayLike, *, scalar_first: bool = False) -> Floats:
    """(..., 3) -> (..., 4) of R = Rz(theta) Rx(psi) Ry(phi), the angles psi, phi, theta of any size up to 1e100 [rad]."""
    lead, a = _finite("angles", angles)
    return _ordered(_core.quaternion_from_euler_312(a), lead, scalar_first)


def angle_between(first: ArrayLike, second: ArrayLike) -> Floats:
    """(..., 4), (..., 4) -> (...): angle of the rotation from one attitude to the other, at most pi [rad]. The order of the components does
    not matter as long as it is that of both, and the signs of the quaternions do not."""
    lead, (p, q) = rows([("first", first, (4,)), ("second", second, (4,))])
    p, q = (each / np.linalg.norm(each, axis=1, keepdims=True) for each in (_sized("first", p), _sized("second", q)))
    near = np.where(np.sum(p * q, axis=1, keepdims=True) < 0, -q, q)
    made: Floats = shaped(4.0 * np.arctan2(np.linalg.norm(p - near, axis=1), np.linalg.norm(p + near, axis=1)), lead)
    return made
