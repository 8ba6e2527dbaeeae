# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs on one scene: every rung, every integrator, and rivals where they are installed."""

import csv
import io
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from gyrostat.charts import methods
from gyrostat.charts.methods import TooLong
from gyrostat.charts.problem import Errors, Line, Measure, Problem, Run, Unanswered
from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES
from gyrostat.scenes import Scene
from gyrostat.writing import write_text

__all__ = ["Chart", "ChartPoint", "LeftOut", "make_chart", "measured"]

REPEATS: Final = 7
# Repeats end after this time [s].
LONG: Final = 0.2
# A setting takes about this many times as long as the one before, which is 100 times less accurate: so much a method of order 5.
GROWTH: Final = 2.5


@dataclass(frozen=True, slots=True)
class ChartPoint:
    """One method at one setting. `error` holds true errors (NaN: the method does not give the column), `stated` those that it states itself."""

    group: str  # rung, taylor, dop853, radau, cvode or rival
    label: str
    setting: str
    error: dict[str, float]
    seconds: float
    rhs: int
    note: str = ""
    stated: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LeftOut:
    """What has no point on the chart: a method, its settings, and why."""

    group: str
    label: str
    settings: tuple[str, ...]
    why: str

    def __str__(self) -> str:
        word = self.settings[0].partition(" ")[0]
        settings = ", ".join(setting.removeprefix(f"{word} ") for setting in self.settings)
        return f"{self.label}, {word} {settings}: {self.why}" if word else f"{self.label}: {self.why}"


@dataclass(frozen=True, eq=False, repr=False)
class Chart:
    """Error against cost on one scene.

    Errors are true ones, greatest over the times, against a reference that the title names. Cost is the CPU time of one solution [s], the least
    of several, and its count of right-hand-side evaluations. `left_out` says what has no point, and why.
    """

    name: str
    kind: str
    title: str
    measures: tuple[Measure, Measure]
    points: tuple[ChartPoint, ...]
    left_out: tuple[LeftOut, ...] = ()

    def by_label(self) -> dict[str, list[ChartPoint]]:
        """Points of each line of the figure, in the order of the settings."""
        made: dict[str, list[ChartPoint]] = {}
        for point in self.points:
            made.setdefault(point.label, []).append(point)
        return made

    def to_csv(self) -> str:
        """One row a point, then one a setting that was left out, without numbers and with the reason as its note."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(["group", "method", "setting", *(f"error_{m.key}" for m in self.measures), "seconds", "rhs", "note",
                         *(f"stated_{m.key}" for m in self.measures)])
        for p in self.points:
            errors, stated = (["" if math.isnan(e := of.get(m.key, math.nan)) else e for m in self.measures] for of in (p.error, p.stated))
            writer.writerow([p.group, p.label, p.setting, *errors, p.seconds, p.rhs, p.note, *stated])
        for each in self.left_out:
            writer.writerows([each.group, each.label, setting, *[""] * (len(self.measures) + 2), f"left out: {each.why}", *[""] * len(self.measures)] for setting in each.settings)
        return text.getvalue()

    def __repr__(self) -> str:
        methods = len(self.by_label())
        return f"<Chart of {self.name}: {len(self.points)} points of {methods} methods, {len(self.left_out)} left out; plot(), to_csv(), save(folder)>"

    def _repr_html_(self) -> str:
        from gyrostat.notebook import chart_html

        return chart_html(self)

    def plot(self) -> Any:
        """The figure. Needs matplotlib."""
        from gyrostat.plots import plot_chart

        return plot_chart(self)

    def save(self, folder: str | Path) -> list[Path]:
        """Write chart.png, chart.svg and chart.csv into a folder (made where it is missing)."""
        from gyrostat.drawing import save

        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        figure = self.plot()
        files = [folder / f"chart.{ending}" for ending in ("png", "svg", "csv")]
        for file in files[:2]:
            save(figure, file)
        write_text(files[2], self.to_csv())
        return files


def _least(run: Callable[[], Run], repeats: int) -> tuple[Run, float]:
    """A solution and the least time of several; what is long runs once."""
    made = run()
    taken = [made.seconds]
    while len(taken) < repeats and sum(taken) < LONG:
        taken.append(run().seconds)
    return made, min(taken)


def measured(line: Line, errors: Errors, repeats: int) -> tuple[list[ChartPoint], list[LeftOut]]:
    """A method at its settings, until one takes too long or is bound to."""
    points: list[ChartPoint] = []
    missing: dict[str, list[str]] = {}  # why -> settings
    seconds = 0.0
    for setting, run in line.settings:
        try:
            if GROWTH * seconds > methods.LONGEST:
                raise TooLong
            made, seconds = _least(run, repeats)
            points.append(ChartPoint(line.group, line.label, setting, errors(made.columns), seconds, made.rhs, made.note, made.stated))
        except Unanswered as why:
            missing.setdefault(str(why), []).append(setting)
            if isinstance(why, TooLong):
                seconds = math.inf
    return points, [LeftOut(line.group, line.label, tuple(settings), why) for why, settings in missing.items()]


def make_chart(scene: Scene, *, repeats: int = REPEATS, progress: Callable[[int, int, str], None] | None = None) -> Chart:
    """Measure every method on the scene. progress(done, all, what) is called before each. No solution may take longer than methods.LONGEST:
    what does, or would at a tighter setting, is left out. Raises DomainError where there is no motion to chart."""
    family = FAMILIES[scene.kind]
    if family.part("chart") is None:
        known = ", ".join(name for name, each in FAMILIES.items() if each.part("chart"))
        raise DomainError(f"kind = {scene.kind!r}: charts are known for the kinds {known}")
    problem: Problem = family.part("chart").problem(scene)
    every = methods.lines(problem, problem.rungs or tuple(family.facts.rungs))
    points: list[ChartPoint] = []
    left_out: list[LeftOut] = []
    for done, line in enumerate(every):
        if progress:
            progress(done, len(every), line.label)
        found, missing = measured(line, problem.errors, repeats)
        points += found
        left_out += missing
    if progress:
        progress(len(every), len(every), "")
    return Chart(scene.name, scene.kind, f"true error against cost, {problem.title}", problem.measures, tuple(points), tuple(left_out))
