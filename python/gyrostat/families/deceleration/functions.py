# SPDX-License-Identifier: BSD-3-Clause
"""Deceleration of an asymmetric gyrostat in a resistive medium, over arrays.

A carrier of inertia J turns with omega and holds rotors of momentum l, constant in it; M = J omega + l obeys
dM/dt = M x omega - drag D - control U/|U|. Law "total" opposes U = M (drag: D = M), law "carrier" opposes J omega.
All in body axes and SI units. Source: docs/deceleration.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core
from gyrostat._core import Monitor, build_info
from gyrostat.answer import Answer
from gyrostat.asking import Ask, asked
from gyrostat.broadcast import Floats, array, arrays, numbers, rows, shaped, whole
from gyrostat.errors import DomainError
from gyrostat.families import answer_of

__all__ = ["Averaged", "Monitor", "Stability", "averaged", "has_cvode", "integrate", "quasi_stationary_modulus_squared",
           "solve", "stability"]

REGIONS: Final = ("to-axis", "to-separatrix", "to-interior", "from-interior", "neutral")
TENDENCIES: Final = ("none", "attracts", "repels", "neutral")


def has_cvode() -> bool:
    """The build holds the CVODE integrators."""
    return build_info()["cvode"] is not None


def solve(*, inertia: ArrayLike, control: ArrayLike, drag: float, angular_momentum: ArrayLike, times: ArrayLike,
          rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), law: str = "total", drag_law: str = "total",
          attitude: ArrayLike | None = None, tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto",
          elliptic: str = "auto", monitor: Monitor | None = None, angular_velocity: ArrayLike | None = None,
          ask: Ask | None = None) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) principal moments or (3, 3) tensor [kg m^2]; control : (3,) >= 0 [N m]; drag : >= 0 [1/s];
    angular_momentum : (3,) total M at t = 0 [N m s]; rotor_momentum : (3,) [N m s]; attitude : (4,) [x, y, z, w], if wanted;
    times : (n,) increasing, first >= 0 [s]; tolerance : greatest relative error wanted in any column;
    angular_velocity : (3,) at t = 0 [rad/s], where angular_momentum was made of it, J omega + l: the row at t = 0 then has it to the bit.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: the default set.
    Raises DomainError for an argument outside its domain and for a rung that cannot compute the motion, ConvergenceError where
    a computation hits its cap, Cancelled where the monitor stopped it.
    """
    given: dict[str, Any] = {
        **arrays(inertia=inertia, rotor_momentum=rotor_momentum, control=control, angular_momentum=angular_momentum, times=times),
        **numbers(drag=drag, tolerance=tolerance), "attitude": None if attitude is None else array("attitude", attitude),
        "law": law, "drag_law": drag_law, "model": model, "integrator": integrator, "elliptic": elliptic,
    }
    omega = None if angular_velocity is None else array("angular_velocity", angular_velocity)
    made = _core.deceleration_solve(**given, monitor=monitor, angular_velocity=omega,
                                    ask=asked("deceleration", ask, attitude is not None))
    # a scene has one of the two
    start = {"angular_momentum": None, "angular_velocity": omega} if omega is not None else {}
    return answer_of("deceleration", made, {**given, **start, "ask": ask})


def integrate(*, inertia: ArrayLike, control: ArrayLike, drag: float, angular_momentum: ArrayLike, times: ArrayLike,
              rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), law: str = "total", drag_law: str = "total",
              method: str = "taylor", order: int = 20, tolerance: float = 1e-9, precision: str = "double",
              patience: float = math.inf) -> dict[str, Any]:
    """The full equations under one integrator at one setting, timed: no error estimate, no stop.

    Arguments as in `solve`. method : "taylor" (order 20; 30 in precision "long double"), "dop853",
    "cvode-adams", "cvode-bdf". tolerance : local, relative to |M(0)|; patience : CPU time after which it gives up [s].
    Returns angular_momentum (n, 3) [N m s], seconds, rhs, steps, status ("reached" where all went well, "cancelled" out of patience).
    Raises DomainError for an argument outside its domain and for a method that the build lacks.
    """
    made: dict[str, Any] = _core.deceleration_integrate(
        **arrays(inertia=inertia, rotor_momentum=rotor_momentum, control=control, angular_momentum=angular_momentum, times=times),
        **numbers(drag=drag, tolerance=tolerance, patience=patience), law=law, drag_law=drag_law, method=method, order=whole("order", order),
        precision=precision)
    return made


@dataclass(frozen=True, eq=False)
class Averaged:
    """Averaged motions as arrays; `error` holds the estimated greatest error of each column of the same name: of momentum_norm and energy relative
    to their greatest value, of modulus_squared absolute."""

    momentum_norm: Floats  # (..., n) N m s
    energy: Floats  # (..., n) of the carrier, J
    modulus_squared: Floats  # (..., n)
    regime: NDArray[np.str_]  # (..., n)
    stop_time: Floats  # (...) s; infinite: never; NaN: not found
    error: dict[str, Floats]  # name -> (...)


def averaged(*, inertia: ArrayLike, control: ArrayLike, drag: ArrayLike, angular_momentum: ArrayLike, t: ArrayLike,
             rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), law: str = "total", drag_law: str = "total",
             tolerance: float = 1e-9, elliptic: str = "auto") -> Averaged:
    """Averaged deceleration of many bodies (deceleration.md, sections 2 and 4).

    inertia : (..., 3) principal moments, any order [kg m^2]; control : (..., 3) torques along the same axes [N m];
    drag : (...) [1/s]; angular_momentum : (..., 3) total M at t = 0, body axes [N m s]; rotor_momentum : (..., 3) [N m s];
    t : (n,) increasing, first >= 0 [s]; tolerance : local, of the integration.
    Leading axes broadcast. Raises DomainError for a non-physical inertia, naming the offending row.
    """
    lead, (J, b, d, M, l) = rows([("inertia", inertia, (3,)), ("control", control, (3,)), ("drag", drag, ()),
                                  ("angular_momentum", angular_momentum, (3,)), ("rotor_momentum", rotor_momentum, (3,))])
    made: dict[str, Any] = _core.deceleration_averaged(
        inertia=J, rotor_momentum=l, control=b, drag=d, angular_momentum=M, law=law, drag_law=drag_law,
        times=np.atleast_1d(array("t", t)), **numbers(tolerance=tolerance), elliptic=elliptic)
    n = made["momentum_norm"].shape[1]
    symbols = np.array(_core.deceleration_regimes())
    names = ("momentum_norm", "energy", "modulus_squared")
    return Averaged(**{name: shaped(made[name], lead, n) for name in names},
                    regime=shaped(symbols[made["regime"].astype(int)], lead, n), stop_time=shaped(made["stop_time"], lead),
                    error={name: shaped(made["error"][:, i], lead) for i, name in enumerate(names)})


@dataclass(frozen=True, eq=False)
class Stability:
    """Where the torques drive k2 in one regime; arrays over the leading axes of the torques."""

    region: NDArray[np.str_]  # one of REGIONS
    axis: NDArray[np.str_]  # k2 = 0: one of TENDENCIES
    interior: NDArray[np.str_]  # k*2
    separatrix: NDArray[np.str_]  # k2 = 1
    quasi_stationary: Floats  # k*2; NaN where there is none
    quasi_stationary_complement: Floats  # 1 - k*2


def stability(*, control: ArrayLike, regime: str = "A") -> Stability:
    """The stability table of a body without rotor momentum (deceleration.md, section 2.1).

    control : (..., 3) torques >= 0 about the axes of largest, middle and smallest inertia (only ratios matter) [N m];
    regime : "A" about the axis of largest inertia, "C" about the smallest. Raises DomainError for a negative torque.
    """
    lead, (b,) = rows([("control", control, (3,))])
    made = _core.deceleration_stability(b, regime)
    regions, tendencies = np.array(REGIONS), np.array(TENDENCIES)
    axis, interior, separatrix = (shaped(tendencies[made[:, i].astype(int)], lead) for i in (1, 2, 3))
    return Stability(region=shaped(regions[made[:, 0].astype(int)], lead), axis=axis, interior=interior, separatrix=separatrix,
                     quasi_stationary=shaped(made[:, 4], lead), quasi_stationary_complement=shaped(made[:, 5], lead))


def quasi_stationary_modulus_squared(*, control: ArrayLike, regime: str = "A") -> Floats:
    """k*², at which the torques leave the shape of the orbit alone; NaN where there is none. Arguments as in `stability`."""
    if regime not in ("A", "C"):
        raise DomainError(f"regime = {regime!r}: use A or C")
    return stability(control=control, regime=regime).quasi_stationary
