# SPDX-License-Identifier: BSD-3-Clause
"""A thrusting, charged gyrostat that spins about its body axis 3, over arrays.

Torque M and force f are constant in the body; a rotor along axis 3 holds the momentum lambda3 relative to the body; a charge in a
magnetic field adds the torque e_H (q, -p, 0), e_H = e H l^2 cos(sigma). With omega = (p, q, r) and Lambda = lambda3 - e_H:
    D1 p' = M1 - q [(D3 - D2) r + Lambda],   D2 q' = M2 + p [(D3 - D1) r + Lambda],   D3 r' = M3 - (D2 - D1) p q,
    R' = R [omega]x,   m v' = R f,   x' = v.
The 3-1-2 angles are (psi, phi, theta), R = Rz(theta) Rx(psi) Ry(phi) from body to inertial axes: psi and phi tilt axis 3, theta is the
spin angle. SI units, rad. Equations: docs/spinning.md.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.asking import Ask, asked
from gyrostat.broadcast import Floats, array, arrays, complexes, finite_rows, in_range, number, numbers, rows, shaped, whole
from gyrostat.errors import DomainError
from gyrostat.families import answer_of

__all__ = ["Linear", "LinearGrid", "Monitor", "Pointing", "charge_momentum", "integrate", "linear", "linear_grid",
           "nutation_frequency_squared", "pointing", "pointing_error", "problems", "secular_velocity_ratio", "solve"]

ORIGIN: Final = (0.0, 0.0, 0.0)
# A problem as keyword arguments: name -> shape behind the leading axes.
SHAPES: Final[dict[str, tuple[int, ...]]] = {
    "inertia": (3,), "mass": (), "rotor_momentum": (), "charge_momentum": (), "torque": (3,), "force": (3,), "angular_velocity": (3,),
    "euler_312": (3,), "velocity": (3,), "position": (3,),
}
ERRORS: Final = ("rates", "spin", "tilt", "theta", "attitude", "momentum", "axial_momentum", "velocity", "axial_velocity", "position",
                 "axial_position")


def charge_momentum(*, charge: ArrayLike, flux_density: ArrayLike, arm: ArrayLike, angle: ArrayLike) -> Floats:
    """e_H = e H l^2 cos(sigma) [N m s], over arrays.

    charge : e [C]; flux_density : H [T]; arm : l, from the mass centre along axis 3 [m]; angle : sigma, between axis 3 and the field,
    taken as constant [rad]. The Lorentz force on the moving charge is left out.
    """
    lead, (e, H, l, sigma) = finite_rows([("charge", charge, ()), ("flux_density", flux_density, ()), ("arm", arm, ()), ("angle", angle, ())])
    with np.errstate(over="ignore", invalid="ignore"):
        made: Floats = shaped(in_range("the momentum of the charge", e * H * l**2 * np.cos(sigma)), lead)
    return made


def problems(given: Mapping[str, ArrayLike]) -> tuple[tuple[int, ...], _core.SpinningProblems]:
    """Leading shape and the rows that the compiled functions take, from the arguments of `solve` that describe a body, broadcast.

    Raises DomainError for a wrong shape, a number that is not finite and a body that is not physical, naming argument and row.
    """
    lead, made = rows([(name, given[name], shape) for name, shape in SHAPES.items()])
    return lead, _core.SpinningProblems(**dict(zip(SHAPES, made, strict=True)))


def _single(given: Mapping[str, ArrayLike]) -> _core.SpinningProblems:
    lead, made = problems(given)
    if lead:
        raise DomainError(f"one body is solved at a time: the arguments have the leading axes {lead}")
    return made


def solve(*, inertia: ArrayLike, mass: float, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike, times: ArrayLike,
          rotor_momentum: float = 0.0, charge_momentum: float = 0.0, euler_312: ArrayLike = ORIGIN, velocity: ArrayLike = ORIGIN,
          position: ArrayLike = ORIGIN, tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto",
          monitor: Monitor | None = None, ask: Ask | None = None) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) D1, D2, D3, principal moments along the body axes, axis 3 the spin axis [kg m^2]; mass [kg]; torque : (3,) M in body
    axes [N m]; force : (3,) f in body axes [N]; angular_velocity : (3,) p, q, r at t = 0 [rad/s]; times : (n,) increasing, first >= 0 [s];
    rotor_momentum : lambda3 along axis 3 [N m s]; charge_momentum : e_H [N m s]; euler_312 : (3,) psi, phi, theta at t = 0 [rad];
    velocity, position : (3,) of the mass centre at t = 0, inertial axes [m/s, m]; tolerance : greatest relative error wanted in any
    column; model : "auto" or a rung; integrator : "auto", "taylor" or "cvode", for the rung full.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: the default set.
    Raises DomainError for an argument outside its domain and for a rung that cannot compute the motion, ConvergenceError where
    a computation hits its cap, Cancelled where the monitor stopped it.
    """
    physics = {"inertia": inertia, "mass": mass, "rotor_momentum": rotor_momentum, "charge_momentum": charge_momentum, "torque": torque,
               "force": force, "angular_velocity": angular_velocity, "euler_312": euler_312, "velocity": velocity, "position": position}
    solving: dict[str, Any] = {"times": array("times", times), **numbers(tolerance=tolerance), "model": model, "integrator": integrator}
    made = _core.spinning_solve(_single(physics), **solving, monitor=monitor, ask=asked("spinning", ask))
    return answer_of("spinning", made, {**arrays(**physics), **solving, "ask": ask})


def integrate(*, inertia: ArrayLike, mass: float, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike, times: ArrayLike,
              rotor_momentum: float = 0.0, charge_momentum: float = 0.0, euler_312: ArrayLike = ORIGIN, velocity: ArrayLike = ORIGIN,
              position: ArrayLike = ORIGIN, method: str = "taylor", order: int = 20, tolerance: float = 1e-9,
              precision: str = "double",
              patience: float = math.inf) -> dict[str, Any]:
    """The full equations under one integrator at one setting, timed: no error estimate.

    Arguments as in `solve`. method : "taylor" (order 20; 30 in precision "long double"), "dop853", "cvode-adams",
    "cvode-bdf". tolerance : local, relative to the sizes of the state; patience : CPU time after which it gives up [s].
    Returns angular_velocity (n, 3) [rad/s], attitude (n, 4), angular_momentum_inertial (n, 3) [N m s], velocity (n, 3) [m/s],
    position (n, 3) [m], seconds, rhs, steps, status ("reached" where all went well, "cancelled" out of patience).
    Raises DomainError for an argument outside its domain and for a method that the build lacks.
    """
    problem = _single({"inertia": inertia, "mass": mass, "rotor_momentum": rotor_momentum, "charge_momentum": charge_momentum,
                       "torque": torque, "force": force, "angular_velocity": angular_velocity, "euler_312": euler_312,
                       "velocity": velocity, "position": position})
    made: dict[str, Any] = _core.spinning_integrate(problem, times=array("times", times), method=method, order=whole("order", order),
                                                    **numbers(tolerance=tolerance, patience=patience), precision=precision)
    return made


@dataclass(frozen=True, eq=False)
class Linear:
    """Linear motions at times as arrays; `error` holds a-priori estimates against the full equations."""

    angular_velocity: Floats  # (..., n, 3) p, q, r, body axes, rad/s
    euler_312: Floats  # (..., n, 3) psi, phi, theta, rad; theta counts turns
    attitude: Floats  # (..., n, 4) [x, y, z, w], body to inertial
    angular_momentum_inertial: Floats  # (..., n, 3) N m s
    velocity: Floats  # (..., n, 3) inertial, m/s
    position: Floats  # (..., n, 3) inertial, m
    tilt_bound: Floats  # (...) no less than |psi + i phi| until the farthest time, rad
    rate_bound: Floats  # (...) no less than |p + i q| until then, rad/s
    error: dict[str, Floats]  # one of ERRORS -> (...), in units of the quantity; pairs: of their norm


def linear(*, inertia: ArrayLike, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike, t: ArrayLike,
           mass: ArrayLike = 1.0, rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0, euler_312: ArrayLike = ORIGIN,
           velocity: ArrayLike = ORIGIN, position: ArrayLike = ORIGIN) -> Linear:
    """Motion for small tilt at constant spin, exact for that model, of many bodies (docs/spinning.md, section 3).

    inertia : (..., 3) D1, D2, D3 [kg m^2]; torque : (..., 3), none about axis 3 [N m]; force : (..., 3) [N]; angular_velocity, euler_312,
    velocity, position : (..., 3) at t = 0; mass, rotor_momentum, charge_momentum : (...); t : (n,) of either sign, in any order [s].
    Leading axes broadcast. Exact at resonances, for a sphere, without spin and where the spin is unstable; NaN where a number overflows, as
    of an unstable spin at a late time.
    error : rates (p, q), spin r, tilt (psi, phi), theta, attitude (the angle), momentum (G1, G2), axial_momentum G3, velocity (v1, v2),
    axial_velocity v3, position (x1, x2), axial_position x3: wide estimates of what it leaves out, no bounds (section 5.1), and without rounding.
    Raises DomainError for what is not physical and for a torque about axis 3, naming the row.
    """
    lead, many = problems({"inertia": inertia, "mass": mass, "rotor_momentum": rotor_momentum, "charge_momentum": charge_momentum,
                           "torque": torque, "force": force, "angular_velocity": angular_velocity, "euler_312": euler_312,
                           "velocity": velocity, "position": position})
    made = _core.spinning_linear(many, np.atleast_1d(array("t", t)))
    n = made["attitude"].shape[1]
    errors = made["error"]
    return Linear(attitude=shaped(made["attitude"], lead, n, 4),
                  **{name: shaped(made[name], lead, n, 3)
                     for name in ("angular_velocity", "euler_312", "angular_momentum_inertial", "velocity", "position")},
                  tilt_bound=shaped(errors[:, -2], lead), rate_bound=shaped(errors[:, -1], lead),
                  error={name: shaped(errors[:, i], lead) for i, name in enumerate(ERRORS)})


@dataclass(frozen=True, eq=False)
class LinearGrid:
    """Linear motions on an even grid of times `t` (n,) [s]; the others (..., n)."""

    t: Floats
    p: Floats  # body rates, rad/s; r is constant
    q: Floats
    psi: Floats  # 3-1-2 angles, rad
    phi: Floats
    theta: Floats
    G1: Floats  # inertial momentum, N m s
    G2: Floats
    G3: Floats
    v1: Floats  # inertial velocity, m/s
    v2: Floats
    v3: Floats
    x1: Floats  # inertial position, m
    x2: Floats
    x3: Floats


def linear_grid(*, inertia: ArrayLike, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike, step: float, samples: int,
                start: float = 0.0, mass: ArrayLike = 1.0, rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0,
                euler_312: ArrayLike = ORIGIN, velocity: ArrayLike = ORIGIN, position: ArrayLike = ORIGIN) -> LinearGrid:
    """The motion of `linear` at start + i step, i = 0 .. samples - 1, at some ten nanoseconds a time for all columns together.

    step [s] of either sign, not 0; samples >= 1; the others as in `linear`. Good to rounding of the greatest value of each quantity;
    NaN where a number overflows.
    """
    first, by, n = number("start", start), number("step", step), whole("samples", samples)
    if not (math.isfinite(first) and math.isfinite(by) and by != 0):
        raise DomainError(f"start = {start}, step = {step}: give finite numbers, and a step that is not 0")
    if not 1 <= n <= 2**31:
        raise DomainError(f"samples = {samples}: give a whole number from 1 on")
    lead, many = problems({"inertia": inertia, "mass": mass, "rotor_momentum": rotor_momentum, "charge_momentum": charge_momentum,
                           "torque": torque, "force": force, "angular_velocity": angular_velocity, "euler_312": euler_312,
                           "velocity": velocity, "position": position})
    made = _core.spinning_linear_grid(many, first, by, n)
    names = ("p", "q", "psi", "phi", "theta", "G1", "G2", "G3", "v1", "v2", "v3", "x1", "x2", "x3")
    t = first + by * np.arange(n, dtype=np.float64)
    return LinearGrid(t=t, **{name: shaped(made[i], lead, n) for i, name in enumerate(names)})


@dataclass(frozen=True, eq=False)
class Pointing:
    """Where thrusting spinners point in the mean; arrays over the leading axes."""

    error: Floats  # (...) |M|/|r0 X|, rad, of the torque alone: the lean that the start has without it is in mean_tilt; infinite where r0 X = 0 and where there is no mean
    secular_velocity_ratio: Floats  # (..., 2) limit of (v1, v2)/v3; NaN without force or mean
    mean_tilt: NDArray[np.complex128]  # (...) mean of e^(i theta) (psi + i phi), rad; axis 3 points to -i times it; NaN where there is none
    nutation_frequency_squared: Floats  # (...) nu^2, 1/s^2
    unstable: NDArray[np.bool_]  # (...) nu^2 <= 0: there is no mean
    resonant: NDArray[np.bool_]  # (...) |r0| and nu are so near that the tilt grows over many turns
    compliant: NDArray[np.bool_]  # (...) next to no gyroscopic stiffness


def pointing(*, inertia: ArrayLike, torque: ArrayLike, angular_velocity: ArrayLike, force: ArrayLike = (0.0, 0.0, 1.0),
             rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0, euler_312: ArrayLike = ORIGIN) -> Pointing:
    """Means and flags of the linear motion of many bodies, from their numbers alone (docs/spinning.md, section 3).

    inertia, torque, angular_velocity, force, euler_312 : (..., 3); rotor_momentum, charge_momentum : (...), as in `linear`. A torque about
    axis 3 is left out. Leading axes broadcast. Raises DomainError for what is not physical, naming the row.
    """
    lead, many = problems({"inertia": inertia, "mass": 1.0, "rotor_momentum": rotor_momentum, "charge_momentum": charge_momentum,
                           "torque": torque, "force": force, "angular_velocity": angular_velocity, "euler_312": euler_312,
                           "velocity": ORIGIN, "position": ORIGIN})
    made = _core.spinning_pointing(many)
    return Pointing(error=shaped(made[:, 0], lead), secular_velocity_ratio=shaped(made[:, 1:3], lead, 2),
                    mean_tilt=shaped(complexes(made[:, 3], made[:, 4]), lead), nutation_frequency_squared=shaped(made[:, 5], lead),
                    **{name: shaped(made[:, i] == 1, lead) for i, name in ((6, "unstable"), (7, "resonant"), (8, "compliant"))})


def start_lean(given: Mapping[str, ArrayLike]) -> float:
    """How far tilt and rates of the start alone put the mean direction of axis 3 off inertial axis 3 [rad], of the arguments of `solve`; NaN where there
    is no mean."""
    still = {name: given[name] for name in ("inertia", "angular_velocity", "rotor_momentum", "charge_momentum", "euler_312")}
    return float(abs(pointing(torque=ORIGIN, **still).mean_tilt))


def _spin(spin_rate: ArrayLike) -> Floats:
    """(...) -> (..., 3): about axis 3 alone."""
    lead, (r,) = rows([("spin_rate", spin_rate, ())])
    made = np.zeros((*lead, 3))
    made[..., 2] = r.reshape(lead)
    return made


def pointing_error(*, inertia: ArrayLike, torque: ArrayLike, spin_rate: ArrayLike, rotor_momentum: ArrayLike = 0.0,
                   charge_momentum: ArrayLike = 0.0) -> Floats:
    """(...) mean lean of the spin axis under the torque, |M|/|r0 X| [rad], X = D3 r0 + lambda3 - e_H; infinite where r0 X = 0 and where the spin is
    unstable (nu^2 <= 0), which has no mean. A start with tilt or rates across the axis leans it besides, which is not in it: `pointing` has all.

    inertia, torque : (..., 3); spin_rate : (...) r0 [rad/s]; rotor_momentum, charge_momentum : (...). Leading axes broadcast.
    """
    return pointing(inertia=inertia, torque=torque, angular_velocity=_spin(spin_rate), rotor_momentum=rotor_momentum,
                    charge_momentum=charge_momentum).error


def nutation_frequency_squared(*, inertia: ArrayLike, spin_rate: ArrayLike, rotor_momentum: ArrayLike = 0.0,
                               charge_momentum: ArrayLike = 0.0) -> Floats:
    """(...) nu^2 = kappa1 kappa2 [1/s^2], negative where the spin is unstable. Arguments as in `pointing_error`."""
    return pointing(inertia=inertia, torque=ORIGIN, angular_velocity=_spin(spin_rate), rotor_momentum=rotor_momentum,
                    charge_momentum=charge_momentum).nutation_frequency_squared


def secular_velocity_ratio(*, inertia: ArrayLike, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike,
                           rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0, euler_312: ArrayLike = ORIGIN) -> Floats:
    """(..., 2) limit of (v1, v2)/v3 over many turns where the spin is stable; NaN where it is not, and without force. Arguments as in `pointing`."""
    return pointing(inertia=inertia, torque=torque, force=force, angular_velocity=angular_velocity, rotor_momentum=rotor_momentum,
                    charge_momentum=charge_momentum, euler_312=euler_312).secular_velocity_ratio
