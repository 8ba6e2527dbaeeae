# SPDX-License-Identifier: BSD-3-Clause
"""A gyrostat whose rotor is driven by a motor of limited power, over arrays.

A carrier turns with Omega and holds a rotor, symmetric about an axis e fixed in it, that turns with the rate omega relative
to it. No torque acts from outside; the motor's moment on the rotor is -S (omega - omega*):
    H = theta Omega + lambda omega e,   dH/dt = H x Omega,   lambda d/dt(omega + e.Omega) = -S (omega - omega*).
All in body axes and SI units. Equations: docs/rotor.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.asking import Ask, asked
from gyrostat.broadcast import Floats, array, arrays, complexes, numbers, rows, shaped, whole
from gyrostat.errors import DomainError
from gyrostat.families import answer_of

__all__ = ["Monitor", "SteadyRotations", "assembled_inertia", "integrate", "solve", "steady_rotations"]

CONTINUA: Final = ("", "circle", "sphere")
FAMILIES: Final = ("", "at-rest", "axisymmetric", "circular-section", "principal-axis")
TYPES: Final = ("min", "saddle", "max", "degenerate")
VERDICTS: Final = ("asymptotically stable", "unstable", "marginal", "not isolated", "conservative")


def assembled_inertia(*, carrier_inertia: ArrayLike, carrier_mass: float, rotor_mass: float, axis: ArrayLike, axial_inertia: float,
                      equatorial_inertia: float, offset: ArrayLike) -> Floats:
    """Inertia (3, 3) of the whole gyrostat about the common mass centre, body axes [kg m^2] (docs/rotor.md, equation 2.1).

    carrier_inertia : (3,) principal moments or (3, 3) tensor about the carrier's centroid [kg m^2]; carrier_mass, rotor_mass [kg];
    axis : (3,) unit vector of the rotor; axial_inertia, equatorial_inertia : of the rotor about its axis and across it, about its own
    centroid [kg m^2]; offset : (3,) from the carrier's centroid to the rotor's [m].
    Raises DomainError for what is not positive, and for axial_inertia > 2 equatorial_inertia, which no rotor has.
    """
    made: Floats = _core.rotor_assembly(
        **arrays(carrier_inertia=carrier_inertia, axis=axis, offset=offset),
        **numbers(carrier_mass=carrier_mass, rotor_mass=rotor_mass, axial_inertia=axial_inertia, equatorial_inertia=equatorial_inertia))
    if not np.all(np.isfinite(made)):
        raise DomainError("the inertia of the whole is larger than a double: give smaller masses or a smaller offset")
    return made


def solve(*, inertia: ArrayLike, axis: ArrayLike, axial_inertia: float, slope: float, no_load_rate: float,
          angular_velocity: ArrayLike, times: ArrayLike, rotor_rate: float = 0.0, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
          tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto", monitor: Monitor | None = None, ask: Ask | None = None) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) principal moments or (3, 3) tensor of the whole about its mass centre, rotor locked [kg m^2]; axis : (3,) e, unit
    within 1e-8; axial_inertia : lambda > 0, of the rotor [kg m^2]; slope : S >= 0 of the motor [N m s/rad]; no_load_rate : omega*
    [rad/s]; angular_velocity : (3,) Omega of the carrier at t = 0 [rad/s]; rotor_rate : omega at t = 0, relative to the carrier
    [rad/s]; attitude : (4,) [x, y, z, w] at t = 0, body to inertial; times : (n,) increasing, first >= 0 [s]; tolerance : greatest
    relative error wanted in any column.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: the default set.
    Raises DomainError for an argument outside its domain and for a rung that cannot compute the motion, ConvergenceError where
    a computation hits its cap, Cancelled where the monitor stopped it.
    """
    given: dict[str, Any] = {
        **arrays(inertia=inertia, axis=axis, angular_velocity=angular_velocity, attitude=attitude, times=times),
        **numbers(axial_inertia=axial_inertia, slope=slope, no_load_rate=no_load_rate, rotor_rate=rotor_rate, tolerance=tolerance),
        "model": model, "integrator": integrator,
    }
    return answer_of("rotor", _core.rotor_solve(**given, monitor=monitor, ask=asked("rotor", ask)), {**given, "ask": ask})


def integrate(*, inertia: ArrayLike, axis: ArrayLike, axial_inertia: float, slope: float, no_load_rate: float,
              angular_velocity: ArrayLike, times: ArrayLike, rotor_rate: float = 0.0, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
              method: str = "taylor", order: int = 20, tolerance: float = 1e-9, precision: str = "double",
              patience: float = math.inf) -> dict[str, Any]:
    """The full equations under one integrator at one setting, timed: no error estimate.

    Arguments as in `solve`. method : "taylor" (order 20; 30 in precision "long double"), "radau" (in both precisions),
    "dop853", "cvode-adams", "cvode-bdf". tolerance : local, relative to the sizes of the state; patience : CPU time after which it gives up [s].
    Returns attitude (n, 4), angular_velocity (n, 3) [rad/s], angular_momentum (n, 3) [N m s], rotor_rate (n,) [rad/s],
    rotor_angle (n,) [rad], lyapunov (n,) [J], seconds, rhs, steps, status ("reached" where all went well, "cancelled" out of patience).
    Raises DomainError for an argument outside its domain and for a method that the build lacks.
    """
    made: dict[str, Any] = _core.rotor_integrate(
        **arrays(inertia=inertia, axis=axis, angular_velocity=angular_velocity, attitude=attitude, times=times),
        **numbers(axial_inertia=axial_inertia, slope=slope, no_load_rate=no_load_rate, rotor_rate=rotor_rate, tolerance=tolerance, patience=patience),
        method=method, order=whole("order", order), precision=precision)
    return made


@dataclass(frozen=True, eq=False)
class SteadyRotations:
    """Steady rotations of gyrostats by level; arrays (..., 8) over the leading axes, padded with "" and NaN beyond `count`."""

    count: NDArray[np.int_]  # (...)
    continuum: NDArray[np.str_]  # (...) one of CONTINUA: an entry stands for a circle, or for the whole sphere
    family: NDArray[np.str_]  # (...) one of FAMILIES
    direction: Floats  # (..., 8, 3) m = H/|H|, body axes
    spin_rate: Floats  # psi_dot: Omega = psi_dot m, rad/s
    level: Floats  # F(m), J
    type: NDArray[np.str_]  # one of TYPES
    isolated: NDArray[np.bool_]
    verdict: NDArray[np.str_]  # one of VERDICTS
    decay_rate: Floats  # of the slowest mode, 1/s; negative: growth; NaN: not exponential
    eigenvalues: NDArray[np.complex128]  # (..., 8, 3) 1/s
    cubic: Floats  # (..., 8, 4) coefficients of the characteristic cubic: k, S/lambda, k D + lambda l q, S D/lambda
    determinant: Floats  # D, 1/s^2
    best_slope: Floats  # slope of the motor with the fastest decay, N m s/rad; NaN where nothing decays
    best_rate: Floats  # that decay, 1/s
    algebraic_rate: Floats  # c of 1/W = 1/W0 + c t, W = |V - F|, 1/(J s); NaN unless the rotor axis is principal and along m


def steady_rotations(*, inertia: ArrayLike, axis: ArrayLike, axial_inertia: ArrayLike, slope: ArrayLike, no_load_rate: ArrayLike,
                     momentum: ArrayLike) -> SteadyRotations:
    """All steady rotations of many gyrostats and their stability (docs/rotor.md, section 4).

    inertia : (3,) principal moments or (..., 3, 3) tensors of the whole about its mass centre [kg m^2]; axis : (..., 3) e, unit within
    1e-8; axial_inertia : (...) lambda [kg m^2]; slope : (...) S >= 0 [N m s/rad]; no_load_rate : (...) omega* [rad/s]; momentum : (...) |H| >= 0 [N m s].
    Leading axes broadcast. Raises DomainError for what is not physical, naming the row.
    """
    inertia = array("inertia", inertia)
    if inertia.ndim == 1:
        inertia = np.diag(inertia)
    lead, (theta, e, lam, S, rate, l) = rows([("inertia", inertia, (3, 3)), ("axis", axis, (3,)), ("axial_inertia", axial_inertia, ()),
                                              ("slope", slope, ()), ("no_load_rate", no_load_rate, ()), ("momentum", momentum, ())])
    lengths = np.linalg.norm(e, axis=-1)
    if (bent := np.flatnonzero(np.isfinite(lengths) & (np.abs(lengths - 1) > 1e-8))).size:
        raise DomainError(f"row {bent[0]}: axis has the length {lengths[bent[0]]:.9g}; give a unit vector, to 1e-8")
    made = _core.rotor_steady(inertia=theta, axis=e, axial_inertia=lam, slope=S, no_load_rate=rate, momentum=l)

    def words(names: Sequence[str], values: Any, *core: int) -> Any:
        return shaped(np.array([*names, ""])[np.asarray(values).astype(int)], lead, *core)

    return SteadyRotations(
        count=shaped(made["count"].astype(int), lead), continuum=words(CONTINUA, made["continuum"]), family=words(FAMILIES, made["family"]),
        direction=shaped(made["direction"], lead, 8, 3), type=words(TYPES, made["type"], 8), verdict=words(VERDICTS, made["verdict"], 8),
        isolated=shaped(made["isolated"] == 1, lead, 8),
        eigenvalues=shaped(complexes(made["eigenvalues_real"], made["eigenvalues_imaginary"]), lead, 8, 3),
        cubic=shaped(made["cubic"], lead, 8, 4),
        **{name: shaped(made[name], lead, 8) for name in ("spin_rate", "level", "decay_rate", "determinant", "best_slope", "best_rate",
                                                          "algebraic_rate")})
