# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs on one scene: every rung, every integrator, and rivals where they are installed."""

import csv
import io
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from gyrostat.charts.point import ChartPoint, Measure
from gyrostat.families import FAMILIES
from gyrostat.scenes import Scene

__all__ = ["Chart", "ChartPoint", "make_chart"]

REPEATS: Final = 7
# A method that took longer than this for a solution [s] is not asked for a more accurate one.
TOO_LONG: Final = 3.0


@dataclass(frozen=True, eq=False)
class Chart:
    """Error against cost on one scene.

    Errors are true ones, greatest over the times, against a reference that the title names. Cost is the median time of one
    solution [s] and its count of right-hand-side evaluations.
    """

    name: str
    title: str
    measures: tuple[Measure, Measure]
    points: tuple[ChartPoint, ...]

    def by_label(self) -> dict[str, list[ChartPoint]]:
        """Points of each line of the figure, in the order of the settings."""
        lines: dict[str, list[ChartPoint]] = {}
        for point in self.points:
            lines.setdefault(point.label, []).append(point)
        return lines

    def to_csv(self) -> str:
        """One row a point."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(["group", "method", "setting", *(f"error_{m.key}" for m in self.measures), "seconds", "rhs", "note"])
        for p in self.points:
            errors = [p.error.get(m.key, math.nan) for m in self.measures]
            writer.writerow([p.group, p.label, p.setting, *("" if math.isnan(e) else e for e in errors), p.seconds, p.rhs, p.note])
        return text.getvalue()

    def plot(self) -> Any:
        """The figure. Needs matplotlib."""
        from gyrostat.plots import plot_chart

        return plot_chart(self)

    def save(self, folder: str | Path) -> list[Path]:
        """Write chart.png, chart.svg and chart.csv into a folder (made where it is missing)."""
        from gyrostat.plots import save

        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        figure = self.plot()
        files = [folder / f"chart.{ending}" for ending in ("png", "svg", "csv")]
        for file in files[:2]:
            save(figure, file)
        files[2].write_text(self.to_csv())
        return files


def make_chart(scene: Scene, *, repeats: int = REPEATS, progress: Callable[[int, int, str], None] | None = None) -> Chart:
    """Measure every method on the scene. `progress` is told (done, all, what) before each."""
    plan = FAMILIES[scene.kind].part("chart").plan(scene, repeats)
    points: list[ChartPoint] = []
    slow: set[str] = set()
    for done, (method, setting, job) in enumerate(plan.jobs):
        if method in slow:
            continue
        if progress:
            progress(done, len(plan.jobs), f"{method} {setting}")
        if (point := job()) is not None:
            points.append(point)
            if point.seconds > TOO_LONG:
                slow.add(method)
    if progress:
        progress(len(plan.jobs), len(plan.jobs), "")
    return Chart(scene.name, plan.title, plan.measures, tuple(points))
