# SPDX-License-Identifier: BSD-3-Clause
"""A heavy body that turns about a fixed point in a Newtonian field, over arrays.

I is the inertia about the fixed point, r_cm the mass centre from there, w = (p, q, r) the angular velocity and d the unit vector DOWN, to
the attracting centre, all in body axes; N = 3 g/R is the gravity gradient:
    I w' = (I w) x w + M g r_cm x d + N d x (I d),   d' = d x w.
The attitude takes body axes to inertial ones, of which the third points up: d = -(row 3 of its tensor). Precession is counted
right-handed about down. `solve` and `integrate` take inertias as three moments or as a tensor; all else takes principal axes,
which `principal_axes` finds.
SI units, rad. Equations: docs/heavy.md.
"""

from __future__ import annotations

import itertools
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

__all__ = ["Exact", "FastStability", "Hanging", "Monitor", "PeriodicFamily", "PeriodicOrbit", "Precession", "Series", "SleepingTop",
           "bodies", "exact", "fast_stability", "gravity_gradient", "hanging", "integrate", "periodic_family", "periodic_orbit",
           "principal_axes", "regular_precession", "series", "sleeping_top", "solve"]

Words = NDArray[np.str_]

# A body as keyword arguments: name -> shape behind the leading axes.
SHAPES: Final[dict[str, tuple[int, ...]]] = {"inertia": (3,), "mass": (), "centre_of_mass": (3,), "gravity": (), "gravity_gradient": ()}


def gravity_gradient(*, gravity: ArrayLike, distance: ArrayLike) -> Floats:
    """N = 3 g/R [1/s2], over arrays. gravity : g at the fixed point [m/s2]; distance : R of the attracting centre [m], > 0."""
    lead, (g, R) = finite_rows([("gravity", gravity, ()), ("distance", distance, ())])
    if not np.all(R > 0):
        raise DomainError(f"distance = {np.min(R):g}: give numbers > 0")
    with np.errstate(over="ignore"):
        made: Floats = shaped(in_range("the gradient", 3 * (g / R)), lead)
    return made


def principal_axes(inertia: ArrayLike) -> tuple[Floats, Floats]:
    """Principal moments (..., 3) and rotations R (..., 3, 3), v_body = R v_principal, of inertias (..., 3, 3) [kg m^2], as `solve` takes them:
    the body axes themselves where the tensor is diagonal, else those of its eigenvectors that are nearest, axis by axis.

    Raises DomainError for another shape, a number that is not finite and a tensor that is not symmetric (within 8 roundings).
    """
    tensor = array("inertia", inertia)
    if tensor.ndim < 2 or tensor.shape[-2:] != (3, 3) or not np.all(np.isfinite(tensor)):
        raise DomainError(f"inertia of shape {tensor.shape}: give (..., 3, 3) finite numbers")
    flipped = np.swapaxes(tensor, -1, -2)
    size = np.max(np.abs(tensor), axis=(-1, -2), keepdims=True)
    if np.any(np.abs(tensor - flipped) > 8 * np.finfo(float).eps * size):
        raise DomainError("inertia: a tensor is not symmetric")
    values, vectors = np.linalg.eigh(tensor / 2 + flipped / 2)
    orders = np.array(list(itertools.permutations(range(3))))
    near = np.stack([sum(np.abs(vectors[..., i, order[i]]) for i in range(3)) for order in orders], axis=-1)
    best = orders[np.argmax(near, axis=-1)]
    moments = np.take_along_axis(values, best, axis=-1)
    axes = np.take_along_axis(vectors, best[..., None, :], axis=-1)
    axes = axes * np.copysign(1.0, np.diagonal(axes, axis1=-2, axis2=-1))[..., None, :]
    axes[..., 1] *= np.sign(np.linalg.det(axes))[..., None]
    aligned = np.all(tensor == np.eye(3) * tensor, axis=(-1, -2))[..., None]
    return np.where(aligned, np.diagonal(tensor, axis1=-2, axis2=-1), moments), np.where(aligned[..., None], np.eye(3), axes)


def bodies(given: Mapping[str, ArrayLike], *more: tuple[str, ArrayLike, tuple[int, ...]]) -> tuple[tuple[int, ...], _core.HeavyBodies, list[Floats]]:
    """Leading shape, the bodies as the compiled functions take them, and `more` (name, value, core shape) as rows; all broadcast.

    Raises DomainError for a wrong shape, a number that is not finite and a body that is not physical, naming argument and row.
    """
    lead, made = rows([*((name, given[name], shape) for name, shape in SHAPES.items()), *more])
    return lead, _core.HeavyBodies(**dict(zip(SHAPES, made, strict=False))), made[len(SHAPES):]


def _start(**named: ArrayLike | None) -> dict[str, Any]:
    """Arguments of a start, each of which may be left out."""
    return {name: None if value is None else array(name, value) for name, value in named.items()}


def solve(*, inertia: ArrayLike, mass: float, centre_of_mass: ArrayLike, gravity: float, times: ArrayLike, gravity_gradient: float = 0.0,
          angular_velocity: ArrayLike | None = None, down: ArrayLike | None = None, attitude: ArrayLike | None = None,
          periodic: Mapping[str, float] | None = None, tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto",
          monitor: Monitor | None = None, ask: Ask | None = None) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) principal moments along the body axes, or (3, 3), about the fixed point [kg m^2]; mass [kg]; centre_of_mass : (3,) [m];
    gravity [m/s2]; gravity_gradient : N [1/s2]; times : (n,) increasing, first >= 0 [s].
    The start: angular_velocity (3,) [rad/s] with down (3,), unit, or attitude (4,) [x, y, z, w]; or periodic = {"spin", "cos_inclination"}, the
    periodic motion with r = spin [rad/s] and down = [sqrt(1 - c^2), 0, c] at t = 0, in principal axes.
    tolerance : greatest relative error wanted in any column; model : "auto" or a rung; integrator : "auto", "taylor" or "cvode", for full.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: the default set.
    Raises DomainError for an argument outside its domain and for a rung that cannot compute the motion, ConvergenceError where
    a computation hits its cap, Cancelled where the monitor stopped it.
    """
    if periodic is not None and not (isinstance(periodic, Mapping) and periodic.keys() == {"spin", "cos_inclination"}):
        raise DomainError(f"periodic = {periodic}: give {{\"spin\": ..., \"cos_inclination\": ...}}")
    wanted = None if periodic is None else (number("periodic.spin", periodic["spin"]), number("periodic.cos_inclination", periodic["cos_inclination"]))
    given: dict[str, Any] = {
        **arrays(inertia=inertia, centre_of_mass=centre_of_mass, times=times), **_start(angular_velocity=angular_velocity, down=down, attitude=attitude),
        **numbers(mass=mass, gravity=gravity, gravity_gradient=gravity_gradient, tolerance=tolerance), "model": model, "integrator": integrator,
    }
    made = _core.heavy_solve(**given, periodic=wanted, monitor=monitor, ask=asked("heavy", ask, attitude is not None))
    return answer_of("heavy", made, {**given, "ask": ask, "periodic": periodic if periodic is None else dict(periodic)})


def integrate(*, inertia: ArrayLike, mass: float, centre_of_mass: ArrayLike, gravity: float, angular_velocity: ArrayLike, times: ArrayLike,
              gravity_gradient: float = 0.0, down: ArrayLike | None = None, attitude: ArrayLike | None = None, method: str = "taylor",
              order: int = 20, tolerance: float = 1e-9, precision: str = "double",
              patience: float = math.inf) -> dict[str, Any]:
    """The full equations under one integrator at one setting, timed: no error estimate.

    Arguments as in `solve`. method : "taylor" (order 20; 30 in precision "long double"), "dop853", "cvode-adams",
    "cvode-bdf". tolerance : local, relative to the sizes of the state; patience : CPU time after which it gives up [s].
    Returns angular_velocity (n, 3) [rad/s], down (n, 3), attitude (n, 4) where it was given, seconds, rhs, steps, status ("reached" where all
    went well, "cancelled" out of patience). Raises DomainError for an argument outside its domain and for a method that the build lacks.
    """
    made: dict[str, Any] = _core.heavy_integrate(
        **arrays(inertia=inertia, centre_of_mass=centre_of_mass, times=times), **_start(angular_velocity=angular_velocity, down=down, attitude=attitude),
        **numbers(mass=mass, gravity=gravity, gravity_gradient=gravity_gradient, tolerance=tolerance, patience=patience), method=method,
        order=whole("order", order), precision=precision)
    return made


@dataclass(frozen=True, eq=False)
class Series:
    """Fast periodic motions by series, at times; `error` is the greatest over them. Errors are infinite where the terms left out are no longer the lesser
    ones: where they exceed 0.3 (of the rates over the spin, or rad) at t = 0."""

    angular_velocity: Floats  # (..., n, 3) rad/s
    down: Floats  # (..., n, 3)
    attitude: Floats  # (..., n, 4); the angle psi starts at 0
    order: NDArray[np.int64]  # (...) in c/r0, even
    period: Floats  # (...) of rates and down, s
    period_error: Floats  # (...) s
    precession_rate: Floats  # (...) mean turn about down, rad/s
    precession_error: Floats  # (...) rad/s
    error: dict[str, Floats]  # angular_velocity [rad/s], down, attitude [rad] -> (...)


def series(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, spin: ArrayLike, cos_inclination: ArrayLike,
           t: ArrayLike, gravity_gradient: ArrayLike = 0.0, order: int | None = None, tolerance: float = 1e-12) -> Series:
    """The periodic motion of a fast spin by the series of Lindstedt in c/r0 (docs/heavy.md, section 3), of many bodies.

    inertia, centre_of_mass : (..., 3); mass, gravity, gravity_gradient : (...); spin : (...) r0 [rad/s]; cos_inclination : (...), in (-1, 1); t : (n,)
    of either sign [s]; order : even, from 2 to 30, or None: what the tolerance wants at the farthest time, or else the one of least error.
    Leading axes broadcast. Raises DomainError where a divisor vanishes, ConvergenceError where the terms do not fall, naming the row.
    """
    terms = 0 if order is None else whole("order", order)
    if order is not None and (terms % 2 or not 2 <= terms <= 30):
        raise DomainError(f"order = {order}: give an even number from 2 to 30")
    if not (aim := number("tolerance", tolerance)) > 0:
        raise DomainError(f"tolerance = {tolerance}: give a number > 0")
    lead, many, (r0, G0) = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                                   "gravity_gradient": gravity_gradient}, ("spin", spin, ()), ("cos_inclination", cos_inclination, ()))
    made = _core.heavy_series(many, spin=r0, cos_inclination=G0, t=np.atleast_1d(array("t", t)), order=terms, tolerance=aim)
    n, numbers = made["down"].shape[1], made["numbers"]
    return Series(**{name: shaped(made[name], lead, n, width) for name, width in (("angular_velocity", 3), ("down", 3), ("attitude", 4))},
                  order=shaped(numbers[:, 0].astype(np.int64), lead),
                  **{name: shaped(numbers[:, i], lead)
                     for i, name in ((1, "period"), (2, "period_error"), (3, "precession_rate"), (4, "precession_error"))},
                  error={name: shaped(numbers[:, 5 + i], lead) for i, name in enumerate(("angular_velocity", "down", "attitude"))})


@dataclass(frozen=True, eq=False)
class Exact:
    """Motions in closed form or by quadrature, at times; NaN where the body has none."""

    case: Words  # (...) euler, lagrange, pendulum or none
    angular_velocity: Floats  # (..., n, 3) rad/s
    down: Floats  # (..., n, 3)
    attitude: Floats  # (..., n, 4)
    period: Floats  # (...) of what repeats itself: the rates (euler, pendulum), the nutation (lagrange), s; NaN where gravity_gradient is not 0
    # and a top moves so near a separatrix that it is not resolved, as is precession_rate
    nutation: Floats  # (..., 2) of a top: least and greatest down along its axis of symmetry, 1 where it hangs; NaN of others
    precession_rate: Floats  # (...) of a top: mean turn of its axis about down, right-handed, rad/s; NaN of others
    error: dict[str, Floats]  # bounds until the farthest time: angular_velocity [rad/s], down, attitude [rad] -> (...)


def exact(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, angular_velocity: ArrayLike, t: ArrayLike,
          gravity_gradient: ArrayLike = 0.0, down: ArrayLike | None = None, attitude: ArrayLike | None = None) -> Exact:
    """The exact motion of many bodies where there is one (docs/heavy.md, section 7).

    Arguments as in `series`; angular_velocity : (..., 3) at t = 0, with down (..., 3) or attitude (..., 4), of any length. Without an attitude the body
    starts in one that the smallest turn makes of the identity. Leading axes broadcast. Down that an attitude gives is known to rounding, and the error
    counts that: infinite where the motion is unstable and rounding decides. Raises DomainError for a direction or quaternion that vanishes, naming the row.
    """
    value, name, width = (down, "down", 3) if attitude is None else (attitude, "attitude", 4)
    if value is None or (down is not None and attitude is not None):
        raise DomainError("give either down or attitude")
    lead, many, (w, given) = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                                     "gravity_gradient": gravity_gradient}, ("angular_velocity", angular_velocity, (3,)), (name, value, (width,)))
    q = given if down is None else np.tile([0.0, 0.0, 0.0, 1.0], (len(given), 1))
    made = _core.heavy_exact(many, angular_velocity=w, down=None if down is None else given, attitude=q, t=np.atleast_1d(array("t", t)))
    n, numbers = made["down"].shape[1], made["numbers"]
    return Exact(case=_words(made["case"], lead), period=shaped(numbers[:, 0], lead), nutation=shaped(numbers[:, 4:6], lead, 2),
                 precession_rate=shaped(numbers[:, 6], lead),
                 **{name: shaped(made[name], lead, n, width) for name, width in (("angular_velocity", 3), ("down", 3), ("attitude", 4))},
                 error={name: shaped(numbers[:, 1 + i], lead) for i, name in enumerate(("angular_velocity", "down", "attitude"))})


def _words(texts: list[str], lead: tuple[int, ...]) -> Words:
    made: Words = np.array(texts, dtype=np.str_).reshape(lead)
    return made


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """Motions whose rates and down return after a period; NaN where none was found."""

    angular_velocity: Floats  # (..., 3) at t = 0, rad/s
    down: Floats  # (..., 3) at t = 0
    period: Floats  # (...) s
    period_error: Floats  # (...) s, an estimate several times too large
    closure: Floats  # (...) greatest of |w(T) - w(0)| over the size of w and |d(T) - d(0)|
    trace: Floats  # (...) of the 6x6 monodromy, minus 4: the sum of the two multipliers
    trace_error: Floats  # (...)
    multipliers: NDArray[np.complex128]  # (..., 2) those that are not one, the greater first
    verdict: Words  # (...) stable, unstable, undecided (the trace is too near +-2), none (not found)
    method: Words  # (...) shooting or continuation
    why: Words  # (...) why there is none; empty where there is one


def _orbits(made: Mapping[str, Any], lead: tuple[int, ...]) -> PeriodicOrbit:
    x = made["numbers"]
    return PeriodicOrbit(
        angular_velocity=shaped(x[:, 0:3], lead, 3), down=shaped(x[:, 3:6], lead, 3),
        **{name: shaped(x[:, 6 + i], lead) for i, name in enumerate(("period", "period_error", "closure", "trace", "trace_error"))},
        multipliers=shaped(complexes(x[:, 11:15:2], x[:, 12:15:2]), lead, 2),
        verdict=_words(made["verdict"], lead), method=_words(made["method"], lead), why=_words(made["why"], lead))


def periodic_orbit(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, spin: ArrayLike,
                   cos_inclination: ArrayLike, gravity_gradient: ArrayLike = 0.0) -> PeriodicOrbit:
    """The periodic motion with r = spin and down = [+sqrt(1 - c^2), 0, c] at t = 0, by shooting or along its family, of many bodies.

    Arguments as in `series`. Some hundred microseconds each. Where no motion is found the row is NaN and `why` says so.
    """
    lead, many, (r0, G0) = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                                   "gravity_gradient": gravity_gradient}, ("spin", spin, ()), ("cos_inclination", cos_inclination, ()))
    return _orbits(_core.heavy_periodic_orbits(many, spin=r0, cos_inclination=G0), lead)


@dataclass(frozen=True, eq=False)
class PeriodicFamily:
    """Periodic motions over the spin, from the fast end on."""

    members: PeriodicOrbit  # (n,); the spin of each is angular_velocity[:, 2]
    folds: NDArray[np.int64]  # members behind which the spin turns back
    end: str  # spin-reached, spin-zero, homoclinic, stalled or member-limit


def periodic_family(*, inertia: ArrayLike, mass: float, centre_of_mass: ArrayLike, gravity: float, first_spin: float, cos_inclination: float,
                    gravity_gradient: float = 0.0, last_spin: float = 0.0, most_members: int = 400) -> PeriodicFamily:
    """The family of one body from a fast spin on, the inclination fixed, past folds, to last_spin or to where it ends.

    first_spin, last_spin [rad/s], of one sign; 0: as far as it goes. Raises DomainError or ConvergenceError where the first is not found.
    """
    lead, one, _ = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                           "gravity_gradient": gravity_gradient})
    if lead:
        raise DomainError(f"one body at a time: the arguments have the leading axes {lead}")
    if (members := whole("most_members", most_members)) < 1:
        raise DomainError(f"most_members = {most_members}: give a whole number from 1 on")
    made = _core.heavy_periodic_family(one, **numbers(first_spin=first_spin, cos_inclination=cos_inclination, last_spin=last_spin),
                                       most_members=min(members, 2**31 - 1))
    return PeriodicFamily(_orbits(made, (len(made["verdict"]),)), np.array(made["folds"], dtype=np.int64), str(made["end"]))


@dataclass(frozen=True, eq=False)
class SleepingTop:
    """Tops that spin about the vertical."""

    threshold: Floats  # (...) least |spin| of a stable sleep, rad/s; 0: stable at any
    frequency_squared: Floats  # (...) of small tilts, 1/s2; negative: they grow
    amplification: Floats  # (...) of a tilt at rest; infinite below the threshold
    verdict: Words  # (...) stable, unstable, undecided (within rounding of the threshold)


def sleeping_top(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, spin: ArrayLike = 0.0,
                 axis_down: bool | NDArray[np.bool_] = False, gravity_gradient: ArrayLike = 0.0) -> SleepingTop:
    """Stability of tops whose axis of symmetry, which passes through the mass centre, is vertical (docs/heavy.md, section 7).

    spin : (...) about that axis [rad/s]; axis_down : (...) the body axis of symmetry points down (of a sphere: the line to the mass centre, in
    the direction of body axis 3). Others as in `series`. Raises DomainError where there is no such axis.
    """
    lead, many, (r, side) = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                                    "gravity_gradient": gravity_gradient}, ("spin", spin, ()), ("axis_down", axis_down, ()))
    made = _core.heavy_sleeping(many, spin=r, axis_down=side != 0)
    x = made["numbers"]
    return SleepingTop(**{name: shaped(x[:, i], lead) for i, name in enumerate(("threshold", "frequency_squared", "amplification"))},
                       verdict=_words(made["verdict"], lead))


@dataclass(frozen=True, eq=False)
class Precession:
    """Rates of regular precession about down, rad/s, |slow| <= |fast|; both NaN where the top cannot precess so."""

    slow: Floats  # (...)
    fast: Floats  # (...) infinite where the axis is level: there is the slow one alone


def regular_precession(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, spin: ArrayLike,
                       cos_inclination: ArrayLike, gravity_gradient: ArrayLike = 0.0) -> Precession:
    """The rates at which a top with an axis of symmetry through its mass centre precesses at constant inclination.

    spin : (...) about that axis [rad/s]; cos_inclination : (...) of the axis to down, in [-1, 1]. Others as in `series`.
    NaN where the spin is too slow for any; of a level axis (cos_inclination = 0 to 8 eps) with spin there is the slow one alone,
    and `fast` is infinite.
    """
    lead, many, (r, u) = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                                 "gravity_gradient": gravity_gradient}, ("spin", spin, ()), ("cos_inclination", cos_inclination, ()))
    made = _core.heavy_regular_precession(many, cos_inclination=u, spin=r)
    return Precession(shaped(made[:, 0], lead), shaped(made[:, 1], lead))


@dataclass(frozen=True, eq=False)
class Hanging:
    """Rest where the potential energy is least, and the two small swings about it."""

    down: Floats  # (..., 3)
    frequency: Floats  # (..., 2) ascending, rad/s
    swing: Floats  # (..., 2, 3) directions in which down moves


def hanging(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, gravity_gradient: ArrayLike = 0.0) -> Hanging:
    """Where bodies hang, and how fast they swing there (docs/heavy.md, section 6). Arguments as in `series`."""
    lead, many, _ = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                            "gravity_gradient": gravity_gradient})
    made = _core.heavy_hanging(many)
    return Hanging(shaped(made[:, 0:3], lead, 3), shaped(made[:, 3:5], lead, 2), shaped(made[:, 5:], lead, 2, 3))


@dataclass(frozen=True, eq=False)
class FastStability:
    """Whether a free nutation of a fast spin grows, to second order in c/r0."""

    exponent_squared: Floats  # (...) nu^2; negative: real and positive multipliers
    error: Floats  # (...) of nu^2
    tongue: Floats  # (...) half width in nu of the resonance at 1/2
    exponent: Floats  # (...) nu as the tongue draws it, 1/2 inside; NaN where nu^2 < 0
    trace: Floats  # (...) sum of the two multipliers
    growth: Floats  # (...) ln of the greater one
    verdict: Words  # (...) stable, unstable, undecided


def fast_stability(*, inertia: ArrayLike, mass: ArrayLike, centre_of_mass: ArrayLike, gravity: ArrayLike, spin: ArrayLike,
                   cos_inclination: ArrayLike, gravity_gradient: ArrayLike = 0.0) -> FastStability:
    """Stability of the periodic motion of a fast spin without finding it (docs/heavy.md, section 3). Arguments as in `series`."""
    lead, many, (r0, G0) = bodies({"inertia": inertia, "mass": mass, "centre_of_mass": centre_of_mass, "gravity": gravity,
                                   "gravity_gradient": gravity_gradient}, ("spin", spin, ()), ("cos_inclination", cos_inclination, ()))
    made = _core.heavy_fast_stability(many, spin=r0, cos_inclination=G0)
    names = ("exponent_squared", "error", "tongue", "trace", "growth", "exponent")
    return FastStability(**{name: shaped(made["numbers"][:, i], lead) for i, name in enumerate(names)}, verdict=_words(made["verdict"], lead))
