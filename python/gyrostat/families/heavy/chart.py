# SPDX-License-Identifier: BSD-3-Clause
"""The chart of a heavy body: what is measured, how far, the series by order, and the equations for rivals."""

import math
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core
from gyrostat.charts.methods import timed
from gyrostat.charts.problem import MOST_TURNS, Line, Measure, Problem, Run, Unanswered, counted, first_turns, reference, relative, tensor
from gyrostat.errors import ConvergenceError, DomainError
from gyrostat.families.heavy.functions import integrate, periodic_orbit, principal_axes, series, solve
from gyrostat.families.heavy.scene import arguments

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["problem", "true_errors"]

Vectors = NDArray[np.float64]

RATES: Final = Measure("angular_velocity", "error of omega", "the angular velocity", "greatest true error, relative to the greatest |ω| [1]")
DOWN: Final = Measure("down", "error of down", "down, body axes", "greatest true error, angle [rad]")
SERIES_ORDERS: Final = (2, 4, 6, 8, 12, 16, 20, 24, 30)


def true_errors(made: Mapping[str, Any], want: Mapping[str, Any]) -> dict[str, float]:
    """Greatest differences of the rates, over the greatest wanted, and of down."""
    return {name: relative(made[name], want[name]) for name in ("angular_velocity", "down")}


def problem(scene: "Scene") -> Problem:
    """The scene, or its first part where the whole is too long; a periodic motion from the start that shooting finds for it."""
    given = arguments(scene)
    periodic = given["periodic"]
    names = ("inertia", "mass", "centre_of_mass", "gravity", "gravity_gradient")
    start = {name: given[name] for name in ("angular_velocity", "down", "attitude")} if periodic is None else _periodic_start(given)
    physics = {**{name: given[name] for name in names}, **start}
    rate = _turn_rate(physics)
    times, cut = first_turns(given["times"], lambda end: rate * end, MOST_TURNS)
    given["times"] = physics["times"] = times
    want, source = reference(integrate, physics)
    turns = rate * float(times[-1])
    found = "" if periodic is None else ", from the start that shooting finds"
    title = (f"{counted(len(times), 'time')} to {times[-1]:.6g} s{cut}{found}\n"
             f"about {turns:.3g} turns; {source}")
    return Problem(title, (RATES, DOWN), solve, given, integrate, physics, lambda made: true_errors(made, want), Rival(physics, rate), 10 * turns,
                   lines=lambda: _series(given))


def _principal(given: Mapping[str, Any]) -> tuple[dict[str, Any], Vectors]:
    """The body in principal axes, and the rotation from there to the scene's."""
    inertia = np.asarray(given["inertia"], dtype=float)
    moments, axes = (inertia, np.eye(3)) if inertia.ndim == 1 else principal_axes(inertia)
    centre = axes.T @ np.asarray(given["centre_of_mass"], dtype=float)
    return {"inertia": moments, "centre_of_mass": centre, **{name: given[name] for name in ("mass", "gravity", "gravity_gradient")}}, axes


def _periodic_start(given: Mapping[str, Any]) -> dict[str, Any]:
    body, axes = _principal(given)
    orbit = periodic_orbit(**body, **given["periodic"])
    if str(orbit.verdict) == "none":
        raise DomainError(f"initial.periodic: no such motion was found to chart: {orbit.why}")
    return {"angular_velocity": axes @ orbit.angular_velocity, "down": axes @ orbit.down / np.linalg.norm(orbit.down), "attitude": None}


def _turn_rate(physics: Mapping[str, Any]) -> float:
    """Roughly the turns and swings in a second."""
    least = float(np.linalg.eigvalsh(tensor(physics["inertia"]))[0])
    pull = physics["mass"] * physics["gravity"] * float(np.linalg.norm(physics["centre_of_mass"])) / least
    return (float(np.linalg.norm(physics["angular_velocity"])) + math.sqrt(pull) + math.sqrt(physics["gravity_gradient"])) / (2 * math.pi)


def _series(given: Mapping[str, Any]) -> Iterable[Line]:
    """The series of a periodic motion, order by order."""
    if given["periodic"] is None:
        return
    body, axes = _principal(given)

    def run(order: int) -> Run:
        try:
            made, seconds = timed(lambda: series(**body, **given["periodic"], t=given["times"], order=order))
        except (DomainError, ConvergenceError) as error:
            raise Unanswered(str(error)) from None
        if int(made.order) < order:
            raise Unanswered("the terms between are below rounding")
        stated = {"angular_velocity": float(made.error["angular_velocity"]) / abs(given["periodic"]["spin"]), "down": float(made.error["down"])}
        columns = {"angular_velocity": made.angular_velocity @ axes.T, "down": made.down @ axes.T}
        return Run(seconds, columns, 0, f"stated error {max(stated.values()):.2g}", stated)

    yield Line("rung", "series, by order (from Python)", tuple((f"order {order}", partial(run, order)) for order in SERIES_ORDERS))


class Rival:
    """Rates over their size, and down, in body axes."""

    def __init__(self, physics: Mapping[str, Any], turn_rate: float) -> None:
        self.inertia = tensor(physics["inertia"])
        self.pull = physics["mass"] * physics["gravity"] * np.asarray(physics["centre_of_mass"], dtype=float)
        self.gradient = float(physics["gravity_gradient"])
        self.rate = 2 * math.pi * turn_rate or 1.0
        down = physics["down"]
        if down is None:
            down = -_core.matrix_from_quaternion(np.asarray(physics["attitude"], dtype=float)[None, :])[0].reshape(3, 3)[2]
        self.start = np.concatenate([np.asarray(physics["angular_velocity"], dtype=float) / self.rate, down])

    def columns(self, states: Vectors) -> dict[str, Any]:
        """(n, 6) -> columns."""
        return {"angular_velocity": states[:, :3] * self.rate, "down": states[:, 3:6]}

    def right(self) -> Callable[[float, Vectors], Vectors]:
        """The right-hand side in Python."""
        inverse, I = np.linalg.inv(self.inertia), self.inertia
        (a, b, c), (d, e, f), (g, h, i) = I.tolist()
        inverse_rows = inverse.tolist()
        m1, m2, m3 = self.pull.tolist()
        N, rate = self.gradient, self.rate

        def right(_: float, state: Vectors) -> Vectors:
            p, q, r, x, y, z = state.tolist()
            p, q, r = p * rate, q * rate, r * rate
            L1, L2, L3 = a * p + b * q + c * r, d * p + e * q + f * r, g * p + h * q + i * r
            D1, D2, D3 = a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z
            t1 = L2 * r - L3 * q + m2 * z - m3 * y + N * (y * D3 - z * D2)
            t2 = L3 * p - L1 * r + m3 * x - m1 * z + N * (z * D1 - x * D3)
            t3 = L1 * q - L2 * p + m1 * y - m2 * x + N * (x * D2 - y * D1)
            made: Vectors = np.array([*((row[0] * t1 + row[1] * t2 + row[2] * t3) / rate for row in inverse_rows),
                                      y * r - z * q, z * p - x * r, x * q - y * p])
            return made

        return right

    def system(self, heyoka: Any) -> list[Any]:
        """The right-hand side for heyoka."""
        names = heyoka.make_vars("p", "q", "r", "x", "y", "z")
        w, d = names[:3], names[3:]
        inverse = np.linalg.inv(self.inertia)

        def times(matrix: Any, v: list[Any]) -> list[Any]:
            return [heyoka.sum([float(matrix[i, j]) * v[j] for j in range(3) if matrix[i, j]]) for i in range(3)]

        def cross(a: list[Any], b: list[Any]) -> list[Any]:
            return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

        m = self.pull.tolist()
        pull = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            terms = [part for part in (m[j] * d[k] if m[j] else None, -m[k] * d[j] if m[k] else None) if part is not None]
            pull.append(terms)
        spin = [self.rate**2 * part for part in cross(times(self.inertia, w), w)]
        gradient = [self.gradient * part for part in cross(d, times(self.inertia, d))] if self.gradient else None
        torque = [heyoka.sum([spin[i], *pull[i], *([gradient[i]] if gradient else [])]) for i in range(3)]
        turn = [self.rate * part for part in cross(d, w)]
        return list(zip(names, [*(part / self.rate for part in times(inverse, torque)), *turn], strict=True))
