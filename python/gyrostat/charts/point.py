# SPDX-License-Identifier: BSD-3-Clause
"""What the charts of all kinds share: points, their timing, and how a method is measured."""

import statistics
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["TAYLOR_ORDERS", "TOLERANCES", "ChartPoint", "Job", "Measure", "Plan", "Vectors", "timed"]

TAYLOR_ORDERS: Final = (8, 12, 16, 20, 26)
TOLERANCES: Final = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
# Repeats end after this time [s].
LONG: Final = 0.5

Vectors = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Measure:
    """An error that a chart shows: its key in `ChartPoint.error`, its head in a table, its title and axis in the figure."""

    key: str
    head: str
    title: str
    axis: str


@dataclass(frozen=True, slots=True)
class ChartPoint:
    """One method at one setting. `error` holds true errors (NaN: the method does not give the column)."""

    group: str  # rung, taylor, dop853, radau, cvode or rival
    label: str
    setting: str
    error: dict[str, float]
    seconds: float
    rhs: int
    note: str = ""


# Method, setting, and what measures it (None: it cannot answer).
Job = tuple[str, str, Callable[[], ChartPoint | None]]


@dataclass(frozen=True, slots=True)
class Plan:
    """What a kind hands to the chart: what the figure says above, the two errors, and the methods, cheap settings first."""

    title: str
    measures: tuple[Measure, Measure]
    jobs: tuple[Job, ...]


def timed(work: Callable[[], float], repeats: int) -> float:
    """Median of what `work` says it took; work that is long runs once."""
    taken = [work()]
    while len(taken) < repeats and sum(taken) < LONG:
        taken.append(work())
    return statistics.median(taken)
