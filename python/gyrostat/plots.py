# SPDX-License-Identifier: BSD-3-Clause
"""Figures of answers and charts. Needs matplotlib."""

import math
import textwrap
from typing import TYPE_CHECKING, Any, Final

from gyrostat.drawing import COLOURS, Panel, as_written, components, curve, error_text, head, mark_stop, new_figure, note, save, stacked
from gyrostat.errors import DomainError
from gyrostat.facts import FACTS, UNITS
from gyrostat.families import FAMILIES
from gyrostat.scenes import scene_from

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from gyrostat.answer import Answer
    from gyrostat.charts import Chart

__all__ = ["plot_answer", "plot_chart", "save"]


def plot_answer(answer: "Answer") -> "Figure":
    """What the answer holds, over time; see families/KIND/figures.py."""
    scene = scene_from(answer.scene)
    family = FAMILIES[scene.kind]
    figures = family.part("figures")
    whole = getattr(figures, "OF_ANY_COLUMNS", False) or scene.tables["solve"]["ask"] in (None, "default", "all")
    given = family.arguments(scene) if whole else {}
    made: Figure = figures.figure(answer, given) if whole else _asked(answer)
    title = f"{scene.name}: rung {answer.model}, {answer.verdict}"
    remarks = figures.remarks(answer, given) if whole else []
    head(made, [title, *remarks], 11)
    return as_written(made)


def _asked(answer: "Answer") -> "Figure":
    """A panel for each column of numbers that was asked for."""
    panels = [_column(name) for name, values in answer.columns.items() if values.dtype.kind == "f"]
    if not panels:
        raise DomainError("no column of numbers over time was asked for: ask for one, such as "
                          f"{next(iter(FACTS[answer.scene['kind']].columns))}, to have a figure")
    figure = stacked(answer, panels)
    mark_stop(figure, answer, len(panels))
    return figure


TITLE: Final = 84  # letters


def _column(name: str) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: "NDArray[Any]") -> None:
        values, quantity = answer[name], FACTS[answer.scene["kind"]].quantities[name]
        title = textwrap.shorten(f"{name}: {quantity.meaning}", TITLE, placeholder=" ...")  # beside the error
        unit = "" if UNITS[name] == "1" else UNITS[name]
        if values.ndim == 1:
            curve(axes, t, values, [f"_{name}"])
            axes.set_ylabel(f"[{unit}]" if unit else "")
            axes.set_title(title, loc="left", fontsize=10)
        else:
            components(axes, t, values, "", unit, title, per_wheel=quantity.width == 0)
            axes.set_ylabel(f"[{unit}]" if unit else "")
        note(axes, error_text(answer, name))

    return draw


# ---- charts ----

# The look of a method, the same in every chart: marker, its size, colour, dashes. Rungs: by their place in the ladder, the full equations apart.
FULL: Final = ("*", 14, "#000000", "-")
RUNGS: Final = (("P", 11, "#0072B2", "-"), ("^", 11, "#D55E00", "-"), ("X", 11, "#009E73", "-"), ("p", 11, "#CC79A7", "-"))
METHODS: Final = {
    "series, by order (from Python)": ("d", 6, "#7F7F7F", "-"),
    "Taylor, order 20": ("o", 5, "#08306B", "-"),
    "Radau IIA": ("h", 7, "#6A3D9A", "-"), "Runge-Kutta DOP853": ("v", 6, "#E69F00", "-"),
    "CVODE Adams": ("s", 5, "#33A02C", "--"), "CVODE BDF": ("s", 5, "#8C6D31", "--"),
    "SciPy DOP853 (Python right-hand side)": ("D", 5, "#E31A1C", ":"), "heyoka (compile time left out)": ("D", 5, "#FB6FB1", ":"),
}
OTHER: Final = (".", 8, COLOURS[-1], "-")
STATED: Final = "error that a rung states"
CHART_FLOOR: Final = 1e-17  # an error of zero is drawn here


def _looks(chart: "Chart") -> dict[str, tuple[str, int, str, str]]:
    ladder = [rung for rung in FAMILIES[chart.kind].facts.rungs if rung != "full"]
    rungs = {f"rung {rung}": RUNGS[i % len(RUNGS)] for i, rung in enumerate(ladder)}
    return {"rung full": FULL, **rungs, **METHODS}


def plot_chart(chart: "Chart") -> "Figure":
    """True error against time per solution, on log axes: a panel for each of the two errors, whiskers from true to stated ones.
    What is left out stands below."""
    figure = new_figure(14, 6.5 + 0.17 * len(chart.left_out))
    left, right, key = figure.subplots(1, 3, width_ratios=(1, 1, 0.42))
    key.axis("off")
    right.sharex(left)
    right.sharey(left)
    looks = _looks(chart)
    handles: dict[str, Any] = {}
    for axes, measure in zip((left, right), chart.measures, strict=True):
        for label, points in chart.by_label().items():
            shown = [(p.seconds, max(p.error[measure.key], CHART_FLOOR), p.stated.get(measure.key, math.nan)) for p in points
                     if math.isfinite(p.error.get(measure.key, math.nan))]
            if not shown:
                continue
            x, y, stated = zip(*shown, strict=True)
            edged = label.startswith("rung ")
            marker, size, colour, dashes = looks.get(label, OTHER)
            handles[label], = axes.loglog(
                x, y, marker=marker, color=colour, linestyle=dashes if len(shown) > 1 else "none", markersize=size, linewidth=1.1, label=label,
                markeredgecolor="black" if edged else colour, markeredgewidth=0.7, zorder=4 if edged else 2)
            if any(math.isfinite(e) for e in stated):
                axes.vlines(x, y, stated, colors=colour, linewidth=1.1, zorder=3)
                handles[STATED], = axes.plot(x, stated, marker="_", color=colour, linestyle="none", markersize=9, zorder=3, label=STATED)
        axes.set_title(f"Error of {measure.title}", fontsize=10)
        axes.set_xlabel("CPU time per solution, least of several [s]")
        axes.set_ylabel(measure.axis)
        axes.grid(alpha=0.35, which="major", linewidth=0.6)
        axes.grid(alpha=0.15, which="minor", linewidth=0.4)
    if handles.pop(STATED, None):
        handles[STATED], = key.plot([], [], marker="_", color="black", linestyle="none", markersize=9)
    key.legend(handles.values(), handles.keys(), loc="upper left", fontsize=8, borderaxespad=0, title="the time of a rung holds\nits error estimate",
               title_fontsize=8, alignment="left")
    head(figure, [f"{chart.name}: {chart.title}"], 11)
    if chart.left_out:
        figure.supxlabel("Left out: " + "\n".join(textwrap.fill(str(each), 190) for each in chart.left_out), fontsize=8, x=0.01, ha="left")
    return figure
