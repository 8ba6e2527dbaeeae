# SPDX-License-Identifier: BSD-3-Clause
"""A rigid body, with or without wheels, that no torque acts on.

    M = J w + l,   dM/dt = M x w,   dq/dt = q (0, w)/2,
J the inertia with the wheels locked, less that of wheels that turn freely about their axes, l the momentum of the wheels. All in body axes and
SI units. Equations and closed form: docs/free.md.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.asking import Ask, asked
from gyrostat.broadcast import Floats, array, arrays, number, numbers, record, whole
from gyrostat.errors import DomainError
from gyrostat.families import answer_of

__all__ = ["Monitor", "PermanentRotations", "flips", "integrate", "permanent_rotations", "solve"]

# One wheel: axis (3,), axial_inertia, rate and type ("held" or "free"), the keys of the table [[wheel]] of a scene file.
Wheel = Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class PermanentRotations:
    """The rotations that last, by ascending energy.

    angular_velocity : (n, 3) [rad/s]; angular_momentum : (n, 3), all of the start's length [N m s], body axes; energy : (n,) w.J w/2 [J];
    square : (n,) of the frequency of small oscillations about each, negative where it is unstable [1/s^2]; isolated, stable : (n,).
    """

    angular_velocity: Floats
    angular_momentum: Floats
    energy: Floats
    square: Floats

    @property
    def isolated(self) -> NDArray[np.bool_]:
        """(n,) false: it stands for a circle of rotations, as of a body with two equal moments about any axis in their plane; what starts beside it leaves
        in proportion to time. Told to a few roundings."""
        greatest = max(float(np.abs(self.square).max()), float(np.square(self.angular_velocity).sum(1).max()))
        made: NDArray[np.bool_] = np.abs(self.square) > 8 * np.finfo(float).eps * greatest
        return made

    @property
    def stable(self) -> NDArray[np.bool_]:
        """(n,) neighbours stay neighbours."""
        made: NDArray[np.bool_] = self.isolated & (self.square > 0)
        return made


def _body(inertia: ArrayLike, rotor_momentum: ArrayLike, wheels: Sequence[Wheel], angular_velocity: ArrayLike | None,
          angular_momentum: ArrayLike | None, attitude: ArrayLike) -> dict[str, Any]:
    if not isinstance(wheels, Sequence):
        raise DomainError(f"wheels = {wheels}: give a list of records")
    start = {"angular_velocity": angular_velocity, "angular_momentum": angular_momentum}
    return {
        **arrays(inertia=inertia, rotor_momentum=rotor_momentum, attitude=attitude), "wheels": _wheels(wheels),
        **{name: None if value is None else array(name, value) for name, value in start.items()},
    }


def _wheels(wheels: Sequence[Wheel]) -> tuple[Floats, Floats, Floats, Floats]:
    """Axes (n, 3), axial inertias, rates, and 1 for those that turn freely."""
    axes, turn_freely = np.empty((len(wheels), 3)), np.zeros(len(wheels))
    of_each = {"axial_inertia": np.empty(len(wheels)), "rate": np.empty(len(wheels))}
    for i, wheel in enumerate(wheels):
        what = f"wheels: wheel[{i}]"
        record(what, wheel, ("axis", "axial_inertia", "rate"), ("type", "name"))
        if wheel.get("type", "held") not in ("held", "free"):
            raise DomainError(f'wheels: the type of wheel[{i}] is "{wheel["type"]}": use held or free')
        axis = array(f"{what}: axis", wheel["axis"])
        if axis.shape != (3,):
            raise DomainError(f"{what}: axis has the shape {axis.shape}, not (3,)")
        axes[i], turn_freely[i] = axis, wheel.get("type", "held") == "free"
        for name, values in of_each.items():
            values[i] = number(f"{what}: {name}", wheel[name])
    return axes, of_each["axial_inertia"], of_each["rate"], turn_freely


def solve(*, inertia: ArrayLike, times: ArrayLike, angular_velocity: ArrayLike | None = None, angular_momentum: ArrayLike | None = None,
          rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), wheels: Sequence[Wheel] = (), attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
          view: Mapping[str, Any] | None = None, tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto",
          monitor: Monitor | None = None, ask: Ask | None = None) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) principal moments or (3, 3) tensor about the mass centre, wheels locked [kg m^2]; angular_velocity : (3,) at t = 0
    [rad/s], or angular_momentum : (3,) total, body axes [N m s]; rotor_momentum : (3,) of wheels that are not listed, relative and constant
    [N m s]; wheels : each with axis (3,), unit within 1e-8, axial_inertia [kg m^2], rate at t = 0 relative to the body [rad/s], and type
    "held" (a motor keeps the rate) or "free" (no friction); attitude : (4,) [x, y, z, w] at t = 0, body to inertial; view : axis (3,) body,
    direction (3,) inertial, half_angle [rad], for the scalars view_fraction and view_cosine; times : (n,) increasing, first >= 0 [s];
    tolerance : greatest relative error wanted in any column.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: the default set.
    Raises DomainError for an argument outside its domain, for a wheel that the body cannot hold, and for a rung that cannot compute the
    motion; ConvergenceError where a computation hits its cap; Cancelled where the monitor stopped it.
    """
    given = _body(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude)
    asking: dict[str, Any] = {**arrays(times=times), **numbers(tolerance=tolerance), "model": model, "integrator": integrator}
    seen = None
    if view is not None:
        record("view", view, ("axis", "direction", "half_angle"))
        seen = (array("view.axis", view["axis"]), array("view.direction", view["direction"]), number("view.half_angle", view["half_angle"]))
    made = _core.free_solve(**given, **asking, view=seen, monitor=monitor, ask=asked("free", ask))
    return answer_of("free", made, {**given, **asking, "wheels": [dict(wheel) for wheel in wheels] or None, "view": view, "ask": ask})


def integrate(*, inertia: ArrayLike, times: ArrayLike, angular_velocity: ArrayLike | None = None, angular_momentum: ArrayLike | None = None,
              rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), wheels: Sequence[Wheel] = (), attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
              method: str = "taylor", order: int = 20, tolerance: float = 1e-9, precision: str = "double",
              patience: float = math.inf) -> dict[str, Any]:
    """The full equations under one integrator at one setting, timed: no error estimate.

    Arguments as in `solve`. method : "taylor" (order 20; 30 in precision "long double"), "dop853", "cvode-adams", "cvode-bdf".
    tolerance : local, relative to the sizes of the state; patience : CPU time after which it gives up [s].
    Returns attitude (n, 4), angular_velocity (n, 3) [rad/s], angular_momentum (n, 3) [N m s], seconds, rhs, steps, status ("reached" where
    all went well, "cancelled" out of patience). Raises DomainError for an argument outside its domain and for a method that the build lacks.
    """
    made: dict[str, Any] = _core.free_integrate(
        **_body(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude), **arrays(times=times),
        method=method, order=whole("order", order), **numbers(tolerance=tolerance, patience=patience), precision=precision)
    return made


def reduced(given: Mapping[str, Any]) -> tuple[Floats, Floats, Floats]:
    """Inertia (3, 3) less that of the wheels that turn freely, the momentum (3,) of the wheels that the motion keeps, and M (3,) at the start.

    given : inertia, rotor_momentum, wheels, and angular_velocity or angular_momentum, as `solve` takes them.
    """
    made = _core.free_reduced(**_body(given["inertia"], given["rotor_momentum"], given["wheels"], given["angular_velocity"],
                                      given["angular_momentum"], (0.0, 0.0, 0.0, 1.0)))
    return made["inertia"], made["rotor_momentum"], made["angular_momentum"]


def permanent_rotations(*, inertia: ArrayLike, angular_velocity: ArrayLike | None = None, angular_momentum: ArrayLike | None = None,
                        rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), wheels: Sequence[Wheel] = ()) -> PermanentRotations:
    """The rotations with constant angular velocity that have the angular momentum of the start: two, four or six (Volterra 1899); where two moments
    are equal some stand for a circle of them (`isolated`), and have square = 0 but for rounding.

    Arguments as of `solve`. Raises DomainError as `solve` does, and where the momentum is zero.
    """
    made = _core.free_permanent(**_body(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, (0.0, 0.0, 0.0, 1.0)))
    if not (np.all(np.isfinite(made["energy"])) and np.all(np.isfinite(made["square"]))):
        raise DomainError("energy or rates of the body leave the range of the doubles: give its inertia and momentum in other units")
    order = np.argsort(made["energy"], kind="stable")
    return PermanentRotations(*(np.asarray(made[name])[order] for name in ("angular_velocity", "angular_momentum", "energy", "square")))


def flips(*, inertia: ArrayLike, axis: ArrayLike, begin: float, end: float, angular_velocity: ArrayLike | None = None,
          angular_momentum: ArrayLike | None = None, rotor_momentum: ArrayLike = (0.0, 0.0, 0.0), wheels: Sequence[Wheel] = ()) -> Floats:
    """Times (n,) of [begin, end] [s] at which the angular momentum crosses the plane across a body axis.

    axis : (3,), body axes: of a body spun about its middle axis that axis, and the times are those of its flips. Other arguments as of `solve`.
    Raises DomainError as `solve` does, and where there are more than a million.
    """
    along, first, last = array("axis", axis), number("begin", begin), number("end", end)
    if not np.any(along):
        raise DomainError("axis: a direction has a length, give one that is not zero")
    if not (math.isfinite(first) and math.isfinite(last) and first <= last):
        raise DomainError(f"begin = {begin}, end = {end}: give finite times, the end not before the begin")
    made: Floats = _core.free_flips(**_body(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, (0.0, 0.0, 0.0, 1.0)),
                                    axis=along, begin=first, end=last)
    return made
