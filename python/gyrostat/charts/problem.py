# SPDX-License-Identifier: BSD-3-Clause
"""What a family hands in to be charted, and what the charts of all families share in making it."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from gyrostat.answer import Answer
from gyrostat.errors import DomainError
from gyrostat.rotation import angle_between

__all__ = ["MOST_TURNS", "TURNING", "Errors", "Line", "Measure", "Problem", "Rival", "Run", "Unanswered", "counted", "first_turns", "greatest", "reference", "relative", "tensor", "true_errors"]

Vectors = NDArray[np.float64]
# True errors of columns, by the keys of the measures.
Errors = Callable[[Mapping[str, Any]], dict[str, float]]

# A chart covers at most so many turns: beyond, slow methods would take minutes.
MOST_TURNS: Final = 5000.0
# The reference may take so long [s].
REFERENCE_PATIENCE: Final = 30.0


@dataclass(frozen=True, slots=True)
class Measure:
    """An error that a chart shows: its key, its head in a table, its title and axis in the figure."""

    key: str
    head: str
    title: str
    axis: str


# What `true_errors` tells of a body that turns.
TURNING: Final = (
    Measure("attitude", "error of attitude", "the attitude", "greatest true error, angle [rad]"),
    Measure("angular_velocity", "error of omega", "the angular velocity", "greatest true error, relative to the greatest |ω| [1]"))


@dataclass(frozen=True, slots=True)
class Run:
    """One solution: the CPU time that it took [s], its columns and its evaluations of the right-hand side."""

    seconds: float
    columns: Mapping[str, Any]
    rhs: int
    note: str = ""
    stated: Mapping[str, float] = field(default_factory=dict)  # errors by column, where the method states its own


class Unanswered(Exception):
    """A method gives no solution at a setting; the text says why."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the chart: a method, and what runs it once at each setting, cheap settings first."""

    group: str  # rung, taylor, dop853, radau, cvode or rival
    label: str
    settings: tuple[tuple[str, Callable[[], Run]], ...]


class Rival(Protocol):
    """The equations for integrators of others, in numbers of the size of 1."""

    start: Vectors

    def right(self) -> Callable[[float, Vectors], Vectors]:
        """The right-hand side in Python."""

    def system(self, heyoka: Any) -> list[Any]:
        """The right-hand side in heyoka's expressions, as pairs of variable and rate."""

    def columns(self, states: Vectors) -> dict[str, Any]:
        """Columns of states (n, numbers)."""


@dataclass(frozen=True, eq=False)
class Problem:
    """A scene, or the part of it that is charted."""

    title: str  # what is charted, and the reference
    measures: tuple[Measure, Measure]
    solve: Callable[..., Answer]
    given: dict[str, Any]  # arguments of `solve`, with times, tolerance and model
    integrate: Callable[..., dict[str, Any]]
    physics: dict[str, Any]  # arguments of `integrate`, with times
    errors: Errors
    rival: Rival
    steps: float  # of a rival, roughly: some ten a turn, or what its stability allows
    methods: tuple[tuple[str, str, str], ...] = ()  # (group, label, method) of `integrate` besides those that all families have
    lines: Callable[[], Iterable[Line]] = field(default=tuple)  # besides rungs, integrators and rivals
    rungs: tuple[str, ...] = ()  # none: all that the family has
    cuts: tuple[float, ...] = ()  # times since the start at which the equations change, where a rival begins anew [s]
    begin: float = 0.0  # where the clock of the times stands at the start [s]


def counted(n: int, what: str) -> str:
    """So many of it, in words."""
    return f"{n} {what}{'' if n == 1 else 's'}"


def first_turns(times: Vectors, turns: Callable[[float], float], most: float) -> tuple[Vectors, str]:
    """The times up to about `most` turns, and a remark where some were left out; turns(end) : until a time [s], never falling.

    Raises DomainError where there is no time to chart.
    """
    asked = float(times[-1])
    if asked <= 0:
        raise DomainError("solve.times = [0.0]: there is no motion to chart; give a time > 0")
    if turns(asked) <= most:
        return times, ""
    end = asked
    while turns(end) > most:
        end *= min(0.95, 2 * most / turns(end))
    return np.linspace(0.0, end, 51), f" of the scene's {asked:.6g} s"


def reference(integrate: Callable[..., dict[str, Any]], physics: Mapping[str, Any], method: str = "taylor") -> tuple[dict[str, Any], str]:
    """The motion by integration in long double, and in words what made it. A body at the bound of what a body can have is none in long double, by
    rounding, and is integrated in double. Raises DomainError where that takes too long."""
    settings: dict[str, Any] = {"method": method, "tolerance": 1e-18, "patience": REFERENCE_PATIENCE}
    words, precision = "Radau" if method == "radau" else "Taylor series of order 30", "long double"
    try:
        made = integrate(**physics, **settings, order=30, precision=precision)
    except DomainError:
        words, precision = words.replace("30", "20"), "double"
        made = integrate(**physics, **settings, order=20, precision=precision)
    if made["status"] != "reached":
        why = f"takes over {REFERENCE_PATIENCE:g} s" if made["status"] == "cancelled" else f"ended with {made['status']}"
        raise DomainError(f"the integration that the methods are compared with {why}: chart a shorter time")
    return made, f"reference: {words} in {precision}"


def greatest(vectors: Any) -> float:
    """Greatest length of vectors (n, k), or size of numbers (n,)."""
    values = np.asarray(vectors, dtype=float)
    return float(np.max(np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=1)))


def relative(got: Any, want: Any) -> float:
    """Greatest difference over the greatest wanted; of what is zero throughout 0 where it was met and NaN elsewhere."""
    off, size = greatest(np.asarray(got) - want), greatest(want)
    return off / size if size > 0 else 0.0 if off == 0 else math.nan


def true_errors(made: Mapping[str, Any], want: Mapping[str, Any]) -> dict[str, float]:
    """Greatest angle between the attitudes, and greatest difference of the angular velocities over the greatest wanted."""
    return {"attitude": greatest(angle_between(made["attitude"], want["attitude"])),
            "angular_velocity": relative(made["angular_velocity"], want["angular_velocity"])}


def tensor(inertia: Any) -> Vectors:
    """An inertia as a tensor."""
    made = np.asarray(inertia, dtype=float)
    return np.diag(made) if made.ndim == 1 else made
