# SPDX-License-Identifier: BSD-3-Clause
"""The chart of a deceleration scene: what is measured, how far, and the equations for rivals."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.charts.problem import MOST_TURNS, Measure, Problem, counted, first_turns, greatest, reference, relative, tensor
from gyrostat.errors import DomainError
from gyrostat.families.deceleration.functions import integrate, solve
from gyrostat.families.deceleration.scene import arguments

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["problem", "true_errors"]

Vectors = NDArray[np.float64]

# The integrators of others step over M = 0: the chart ends before the stop.
STOP_SHARE: Final = 0.95

AT_REST: Final = "the body is at rest from the start: there is no motion to chart"

_AXIS: Final = "greatest true error, relative to the greatest |M| [1]"
MEASURES: Final = (Measure("angular_momentum_norm", "error of |M|", "|M|", _AXIS),
                   Measure("angular_momentum", "error of M", "the vector M, body axes", _AXIS))


def true_errors(made: Mapping[str, Any], want: Vectors) -> dict[str, float]:
    """Greatest error of the vector and of its size, each relative to the greatest size of `want` (n, 3)."""
    vector, size = made.get("angular_momentum"), made.get("angular_momentum_norm")
    if size is None and vector is not None:
        size = np.linalg.norm(vector, axis=1)
    return {"angular_momentum": math.nan if vector is None else relative(vector, want),
            "angular_momentum_norm": math.nan if size is None else relative(size, np.linalg.norm(want, axis=1))}


def problem(scene: "Scene") -> Problem:
    """The scene up to just before the stop, or its first part where the whole is too long."""
    given = {**arguments(scene), "attitude": None}
    if not np.any(given["angular_momentum"]):
        raise DomainError(AT_REST)
    rate = _turn_rate(given)
    times, cut = first_turns(given["times"], lambda end: rate * end, MOST_TURNS)
    given["times"] = times
    times, stop = _before_the_stop(given)
    given["times"] = times
    physics = {key: given[key] for key in ("inertia", "rotor_momentum", "control", "drag", "law", "drag_law", "angular_momentum", "times")}
    made, source = reference(integrate, physics)
    want = np.asarray(made["angular_momentum"])
    turns = rate * float(times[-1])
    title = (f"{counted(len(times), 'time')} to {times[-1]:.6g} s{cut}{stop}\n{turns:.3g} turns at most; {source}")
    return Problem(title, MEASURES, solve, given, integrate, physics, lambda made: true_errors(made, want), Rival(physics), 10 * turns)


def _turn_rate(given: Mapping[str, Any]) -> float:
    """Bound of the turns in a second while the momentum does not grow."""
    most = greatest([given["angular_momentum"]]) + 2 * greatest([given["rotor_momentum"]])
    return most / float(np.linalg.eigvalsh(tensor(given["inertia"]))[0]) / (2 * math.pi)


def _before_the_stop(given: Mapping[str, Any]) -> tuple[Vectors, str]:
    """The times that lie before the stop, and a remark where some were left out."""
    times = given["times"]
    if not np.any(given["control"]):
        return times, ""
    stop = solve(**{**given, "model": "full", "times": times[-1:], "tolerance": 1e-6}).scalars.get("stop_time")
    if stop is None or not math.isfinite(stop) or times[-1] <= STOP_SHARE * stop:
        return times, ""
    if stop <= 0:
        raise DomainError(AT_REST)
    kept = times[times <= STOP_SHARE * stop]
    if len(kept) < 2:
        kept = np.linspace(0.0, STOP_SHARE * stop, 51)
    return kept, f" (the motion stops at {stop:.6g} s)"


class Rival:
    """M over its size at the start."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        momentum = np.asarray(given["angular_momentum"], dtype=float)
        self.unit = float(np.linalg.norm(momentum)) or 1.0
        self.start = momentum / self.unit
        self.inverse = np.linalg.inv(tensor(given["inertia"])) * self.unit
        self.rotor = np.asarray(given["rotor_momentum"], dtype=float) / self.unit
        self.control = np.asarray(given["control"], dtype=float) / self.unit
        self.drag = float(given["drag"])
        self.total, self.total_drag = given["law"] == "total", given["drag_law"] == "total"

    def columns(self, states: Vectors) -> dict[str, Any]:
        """(n, 3) -> columns."""
        return {"angular_momentum": states * self.unit}

    def right(self) -> Callable[[float, Vectors], Vectors]:
        """dM/dt in Python."""
        (a, b, c), (d, e, f), (g, h, i) = self.inverse.tolist()
        l1, l2, l3 = self.rotor.tolist()
        b1, b2, b3 = self.control.tolist()
        drag, total, total_drag = self.drag, self.total, self.total_drag
        driven = any((b1, b2, b3))

        def right(_: float, momentum: Vectors) -> Vectors:
            x, y, z = momentum.tolist()
            u, v, w = x - l1, y - l2, z - l3
            p, q, r = a * u + b * v + c * w, d * u + e * v + f * w, g * u + h * v + i * w
            o1, o2, o3 = (x, y, z) if total_drag else (u, v, w)
            m1, m2, m3 = y * r - z * q - drag * o1, z * p - x * r - drag * o2, x * q - y * p - drag * o3
            if driven:
                o1, o2, o3 = (x, y, z) if total else (u, v, w)
                size = math.sqrt(o1 * o1 + o2 * o2 + o3 * o3)
                m1, m2, m3 = m1 - b1 * o1 / size, m2 - b2 * o2 / size, m3 - b3 * o3 / size
            made: Vectors = np.array([m1, m2, m3])
            return made

        return right

    def system(self, heyoka: Any) -> list[Any]:
        """dM/dt for heyoka."""
        names = heyoka.make_vars("x", "y", "z")
        carrier = [m - l if l else m for m, l in zip(names, self.rotor.tolist(), strict=True)]
        rate = [heyoka.sum([float(self.inverse[i, j]) * carrier[j] for j in range(3) if self.inverse[i, j] != 0]) for i in range(3)]
        opposed, dragged = (names if total else carrier for total in (self.total, self.total_drag))
        made = [names[1] * rate[2] - names[2] * rate[1], names[2] * rate[0] - names[0] * rate[2], names[0] * rate[1] - names[1] * rate[0]]
        if np.any(self.control):
            size = heyoka.sqrt(heyoka.sum([u * u for u in opposed]))
            made = [part - float(b) * u / size for part, b, u in zip(made, self.control, opposed, strict=True)]
        return [(name, part - self.drag * u) for name, part, u in zip(names, made, dragged, strict=True)]
