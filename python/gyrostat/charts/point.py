# SPDX-License-Identifier: BSD-3-Clause
"""What the charts of all kinds share: points, their timing, and how a method is measured."""

import math
import statistics
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat._core import build_info
from gyrostat.errors import ConvergenceError, DomainError

__all__ = ["TAYLOR_ORDERS", "TOLERANCES", "ChartPoint", "Job", "Measure", "Plan", "Vectors", "cvode_methods", "integrator_jobs", "rung_jobs", "timed"]

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


# True errors of the columns of an answer or of an integration, by the keys of the measures.
Errors = Callable[[dict[str, Any]], dict[str, float]]


def rung_jobs(models: Sequence[str], solve: Callable[..., dict[str, Any]], given: dict[str, Any], errors: Errors,
              repeats: int) -> Iterator[Job]:
    """Every rung at the scene's tolerance, the full equations at all tolerances. A rung that states an error of the whole is left out."""
    for model in models:
        for tolerance in TOLERANCES if model == "full" else (given["tolerance"],):

            def job(model: str = model, tolerance: float = tolerance) -> ChartPoint | None:
                made: dict[str, Any] = {}

                def once() -> float:
                    made.update(solve(**{**given, "model": model, "tolerance": tolerance}))
                    return float(made["seconds"])

                try:
                    seconds = timed(once, repeats)
                except (DomainError, ConvergenceError):
                    return None
                stated = max((e for e in made["error"].values() if math.isfinite(e)), default=math.nan)
                if not stated < 1:
                    return None
                setting = f"tolerance {tolerance:g}" if model == "full" else ""
                return ChartPoint("rung", f"rung {model}", setting, errors(made["columns"]), seconds, made["counts"]["rhs"],
                                  f"stated error {stated:.2g}")

            yield f"rung {model}", f"{tolerance:g}", job


def cvode_methods() -> list[tuple[str, str, str]]:
    """CVODE as (group, label, method), where the build has it."""
    return [("cvode", "CVODE Adams", "cvode-adams"), ("cvode", "CVODE BDF", "cvode-bdf")] if build_info()["cvode"] else []


def integrator_jobs(methods: Sequence[tuple[str, str, str]], integrate: Callable[..., dict[str, Any]], physics: dict[str, Any],
                    errors: Errors, repeats: int) -> Iterator[Job]:
    """The full equations under Taylor series of all orders and under the other (group, label, method), at all tolerances."""
    settings = [("taylor", f"Taylor, order {order}", "taylor", order) for order in TAYLOR_ORDERS]
    settings += [(*method, 0) for method in methods]
    for group, label, method, order in settings:
        for tolerance in TOLERANCES:

            def job(group: str = group, label: str = label, method: str = method, order: int = order,
                    tolerance: float = tolerance) -> ChartPoint | None:
                made: dict[str, Any] = {}

                def once() -> float:
                    made.update(integrate(**physics, method=method, order=order, tolerance=tolerance))
                    return float(made["seconds"])

                seconds = timed(once, repeats)
                if made["status"] != "reached":
                    return None
                return ChartPoint(group, label, f"tolerance {tolerance:g}", errors(made), seconds, made["rhs"])

            yield label, f"{tolerance:g}", job
