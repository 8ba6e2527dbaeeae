# SPDX-License-Identifier: BSD-3-Clause
"""Elliptic integrals and functions over arrays, by the squared modulus k2 and, where it matters, its complement kp2.

Every function takes k2 in [0, 1] and optionally kp2 = 1 - k2: give kp2 where k2 is close to 1, so that its digits are not lost.
Arguments broadcast against each other; the GIL is released. `elliptic` picks the backend: "native" (= "auto") or "gsl", if the
build holds GSL; another name raises DomainError. Outside the domain the result is NaN, and where kp2 is not 1 - k2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gyrostat import _core
from gyrostat.broadcast import Floats, array, rows, shaped

__all__ = ["Complete", "Incomplete", "Jacobi", "complete", "incomplete", "jacobi", "zeta"]


class Complete(NamedTuple):
    """Complete integrals of the first and second kind."""

    K: Floats
    E: Floats


class Jacobi(NamedTuple):
    """Jacobi's functions and the amplitude [rad]."""

    sn: Floats
    cn: Floats
    dn: Floats
    am: Floats


class Incomplete(NamedTuple):
    """Incomplete integrals of the first, second and third kind."""

    F: Floats
    E: Floats
    Pi: Floats


def _complement(k2: ArrayLike, kp2: ArrayLike | None) -> ArrayLike:
    return 1.0 - array("k2", k2) if kp2 is None else kp2


def _agreeing(k2: Floats, kp2: Floats) -> tuple[Floats, Floats]:
    """The two; k2 is NaN where kp2 is another modulus's."""
    with np.errstate(invalid="ignore"):  # of infinities
        same = np.abs(k2 + kp2 - 1.0) <= 8 * np.finfo(float).eps
    return np.where(same, k2, np.nan), kp2


def complete(k2: ArrayLike, *, kp2: ArrayLike | None = None, elliptic: str = "auto") -> Complete:
    """K(k) and E(k). Within a few ulp for k2 and kp2 down to 1e-300."""
    lead, (a, b) = rows([("k2", k2, ()), ("kp2", _complement(k2, kp2), ())])
    made = _core.elliptic_complete(*_agreeing(a, b), elliptic)
    return Complete(*(shaped(made[:, i], lead) for i in range(2)))


def jacobi(u: ArrayLike, k2: ArrayLike, *, kp2: ArrayLike | None = None, elliptic: str = "auto") -> Jacobi:
    """sn, cn, dn and am of the argument u, any size: those of an argument wrong by a rounding of itself."""
    lead, (x, a, b) = rows([("u", u, ()), ("k2", k2, ()), ("kp2", _complement(k2, kp2), ())])
    made = _core.elliptic_jacobi(x, *_agreeing(a, b), elliptic)
    return Jacobi(*(shaped(made[:, i], lead) for i in range(4)))


def zeta(u: ArrayLike, k2: ArrayLike, *, kp2: ArrayLike | None = None, elliptic: str = "auto") -> Floats:
    """Jacobi's zeta function E(am u) - u E/K: periodic, does not grow with u."""
    lead, (x, a, b) = rows([("u", u, ()), ("k2", k2, ()), ("kp2", _complement(k2, kp2), ())])
    made: Floats = shaped(_core.elliptic_zeta(x, *_agreeing(a, b), elliptic), lead)
    return made


def incomplete(phi: ArrayLike, k2: ArrayLike, *, n: ArrayLike = 0.0, kp2: ArrayLike | None = None,
               elliptic: str = "auto") -> Incomplete:
    """F(phi, k), E(phi, k) and Pi(phi, n, k) for any amplitude phi [rad]; n is the characteristic (1 - n sin^2 under Pi)."""
    lead, (x, c, a, b) = rows([("phi", phi, ()), ("n", n, ()), ("k2", k2, ()), ("kp2", _complement(k2, kp2), ())])
    made = _core.elliptic_incomplete(x, c, *_agreeing(a, b), elliptic)
    return Incomplete(*(shaped(made[:, i], lead) for i in range(3)))
