# SPDX-License-Identifier: BSD-3-Clause
"""What all figures share: the canvas, colours, units of time, curves with their legends, and the layout of a figure over time. Needs matplotlib."""

import importlib
import itertools
import math
import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat.errors import DomainError
from gyrostat.writing import written

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["COLOURS", "MOMENT_NAMES", "Drawing", "Panel", "changes", "check_ending", "components", "curve", "error_text", "finish", "goes_on", "head", "is_coarse", "laid_out",
           "legend_beside", "legend_row", "map_frame", "map_legend", "map_reach", "map_sides", "mark_stop", "new_figure", "note", "on_map", "principal_axes", "save", "span_text", "split",
           "stacked", "time_unit", "vector", "wheels_panel"]

COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D31")
# Units of time [s], and the span from which on each is used [s].
TIME_UNITS: Final = ((1e-6, "µs", 0.0), (1e-3, "ms", 1e-3), (1.0, "s", 1.0), (60.0, "min", 240.0), (3600.0, "h", 14400.0),
                     (86400.0, "days", 345600.0), (31557600.0, "years", 126230400.0))
# Dots an inch of a picture.
DENSITY = 150
# What varies by less than this share of its size is constant but for rounding.
CONSTANT: Final = 1e-10
MOMENT_NAMES: Final = ("least", "middle", "greatest")

# Name of a file without its ending, and what draws it.
Drawing = tuple[str, "Callable[[], Figure]"]
# Draws a part of an answer into axes over the times, which are in the unit of the figure.
Panel = Callable[["Axes", "Answer", NDArray[Any]], None]


def _matplotlib(part: str) -> Any:
    """A module of matplotlib."""
    try:
        return importlib.import_module(f"matplotlib.{part}")
    except ImportError as error:
        raise ImportError("matplotlib is not installed: pip install 'gyrostat[cli]'") from error


def new_figure(width: float, height: float) -> "Figure":
    """An empty figure [inch]."""
    made: Figure = _matplotlib("figure").Figure(figsize=(width, height), layout="constrained")
    return made


def as_written(figure: "Figure") -> "Figure":
    """The figure, in whose text a dollar is a dollar: names of scenes are no formulas, powers of ten beside an axis are."""
    from matplotlib.text import Text
    from matplotlib.ticker import LogFormatter, ScalarFormatter

    numbers: set[Text] = set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            if isinstance(axis.get_major_formatter(), (LogFormatter, ScalarFormatter)):
                numbers.update((*axis.get_ticklabels(which="both"), axis.get_offset_text()))
    for text in figure.findobj(Text):
        text.set_parse_math(text in numbers)
    return figure


NO_FIGURES: Final = {"pgf", "raw", "rgba", "gif"}  # they need LaTeX, have no size of their own, or move


def check_ending(file: Path) -> None:
    """Raise DomainError where the ending of a file is that of no format of figures: to be asked before long work."""
    known = _matplotlib("backend_bases").FigureCanvasBase.get_supported_filetypes()
    if file.suffix[1:].lower() not in set(known) - NO_FIGURES:
        raise DomainError(f"plot file {file}: unknown ending {file.suffix or '(none)'!r}; use .png, .svg or .pdf")


def save(figure: "Figure", file: Path) -> None:
    """Write a figure in the format of the file's ending."""
    check_ending(file)
    as_written(figure)
    figure.draw_without_rendering()  # the layout of axes whose sides are equal, with legends beside them, takes a second pass
    with written(file) as beside:
        figure.savefig(beside, dpi=DENSITY)


def head(figure: "Figure", lines: Sequence[str], size: float) -> None:
    """A title of these lines, broken where they are wider than the figure."""
    width = round(122 / size * figure.get_figwidth())
    figure.suptitle("\n".join(textwrap.fill(part, width) for line in lines for part in line.splitlines()), fontsize=size)


def finish(figure: "Figure", title: str, seen: Sequence[str]) -> None:
    """Title above, and below a paragraph for each thing that is seen."""
    head(figure, [title], 13)
    width = round(12.5 * figure.get_figwidth())
    figure.supxlabel("\n".join(textwrap.fill(text, width) for text in seen), fontsize=9, x=0.01, ha="left")


def time_unit(span: float) -> tuple[float, str]:
    """The unit [s] and its name in which a span [s] is a number of a few digits."""
    if span <= 0:
        return 1.0, "s"
    return next((unit, name) for unit, name, start in reversed(TIME_UNITS) if span >= start)


def span_text(seconds: float) -> str:
    """A time for reading."""
    scale, unit = time_unit(seconds)
    return f"{seconds / scale:.3g} {unit}"


def error_text(answer: "Answer", *columns: str) -> str:
    """The estimated errors of columns."""
    parts = [f"{answer.error[c]:.1e}" for c in columns if c in answer.error and math.isfinite(answer.error[c])]
    return "estimated error " + ", ".join(parts) if parts else "no error estimate"


def note(axes: "Axes", text: str) -> None:
    """A small remark above the right end of the axes."""
    axes.set_title(text, loc="right", fontsize=8, color="#555555")


# ---- curves ----


def changes(values: NDArray[Any]) -> bool:
    """A column (n,) or (n, k) that is not constant but for rounding; of a single time always."""
    numbers = np.asarray(values, dtype=float)
    spread = np.ptp(numbers, axis=0)
    return len(numbers) < 2 or bool(np.max(spread) > CONSTANT * np.max(np.abs(numbers)))


FEW_SAMPLES: Final = 12  # between which a curve would be guessed


def is_coarse(values: NDArray[Any]) -> bool:
    """Samples (n, k) that are less than a few a turn and draw no curve."""
    if len(values) < 4:
        return False
    moving = values[:, np.ptp(values, axis=0) > 1e-6 * np.max(np.abs(values), initial=0.0)]
    crossings = np.abs(np.diff(np.sign(values), axis=0)) > 0
    turns = np.diff(np.sign(np.diff(moving, axis=0)), axis=0) != 0
    return bool(np.mean(crossings) > 0.2 or (turns.size and np.mean(turns) > 0.4))


def curve(axes: "Axes", x: NDArray[Any], values: NDArray[Any], labels: Sequence[str], colours: Sequence[str] = COLOURS, *,
          coarse: bool | None = None, **style: Any) -> None:
    """Columns (n, k) over x: lines, or dots where the samples draw no curve; where they are few they are marked, and the lines between them faint."""
    values = np.asarray(values, dtype=float)
    values = values[:, None] if values.ndim == 1 else values
    if coarse is None:
        coarse = is_coarse(values)
    look: dict[str, Any] = {"linestyle": "none", "marker": ".", "markersize": 2} if coarse else {"linewidth": 1.0, **style}
    if len(x) < FEW_SAMPLES:
        look = {"marker": "o", "markersize": 4} | look | {"linestyle": ":", "linewidth": 0.8}
    for column, label, colour in zip(values.T, labels, itertools.cycle(colours), strict=False):
        axes.plot(x, column, color=colour, label=label, **look)


def legend_row(axes: "Axes", *others: "Axes") -> None:
    """One row of names over the curves, for which room is made; of axes that share a frame. What is constant gets a range to stand in."""
    for each in (axes, *others):
        low, high = each.get_ylim()
        if each.get_yscale() == "log":
            each.set_ylim(low, high * (high / low) ** 0.25)
            continue
        each.ticklabel_format(axis="y", useOffset=False)
        middle, size = (low + high) / 2, max(abs(low), abs(high))
        if high - low < 20 * CONSTANT * size:
            low, high = middle - 0.05 * size, middle + 0.05 * size
        each.set_ylim(low, high + 0.25 * (high - low))
    lines = [line for each in (axes, *others) for line in each.lines if not str(line.get_label()).startswith("_")]
    if lines:
        shown = axes if not others else others[-1]  # above the curves of all
        shown.legend(lines, [str(line.get_label()) for line in lines], loc="upper right", fontsize=8, ncols=len(lines), borderaxespad=0.2,
                     markerscale=3 if any(line.get_markersize() < 3 for line in lines) else 1)


def legend_beside(axes: "Axes") -> None:
    """The names to the right of the axes."""
    made = axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8, borderaxespad=0, handlelength=1.2)
    for line in made.get_lines():
        line.set_linewidth(max(1.2, line.get_linewidth()))


def components(axes: "Axes", t: NDArray[Any], values: NDArray[Any], symbol: str, unit: str, title: str, *, coarse: bool | None = None,
               per_wheel: bool = False) -> None:
    """A vector as its components 1, 2, 3, what each wheel has by their numbers; a quaternion as x, y, z, w."""
    names = "xyzw" if values.shape[1] == 4 and not per_wheel else [str(i) for i in range(1, values.shape[1] + 1)]
    curve(axes, t, values, [f"{symbol}{name}" for name in names], coarse=coarse)
    axes.set_ylabel(f"{symbol} [{unit}]" if unit else symbol)
    legend_row(axes)
    axes.set_title(title, loc="left", fontsize=10)


def vector(column: str, symbol: str, unit: str, title: str) -> Panel:
    """The panel of a column of vectors or quaternions, with its error."""
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        components(axes, t, answer[column], symbol, unit, title)
        note(axes, error_text(answer, column))

    return draw


def wheels_panel(column: str, symbol: str, unit: str, title: str, names: Sequence[str] = ()) -> Panel:
    """The panel of a column of wheels, in their order or by their names; of a column of numbers with its symbol as the name."""
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        values = answer[column]
        curve(axes, t, values, names or [f"{i + 1}" for i in range(values.shape[1])])
        axes.set_ylabel(f"{symbol} [{unit}]")
        legend_row(axes)
        axes.set_title(title, loc="left", fontsize=10)
        note(axes, error_text(answer, column))

    return draw


def split(column: str, symbol: str, unit: str, title: str) -> Panel:
    """The panel of a column of vectors that single out axis 3: components 1 and 2, and 3 on a scale of its own."""
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        values = answer[column]
        right = axes.twinx()
        curve(axes, t, values[:, :2], [f"{symbol}1", f"{symbol}2"])
        curve(right, t, values[:, 2], [f"{symbol}3"], COLOURS[2:], linestyle="--")
        suffix = f" [{unit}]" if unit else ""
        axes.set_ylabel(f"{symbol}1, {symbol}2{suffix}")
        right.set_ylabel(f"{symbol}3{suffix}", color=COLOURS[2])
        legend_row(axes, right)
        axes.set_title(title, loc="left", fontsize=10)
        note(axes, error_text(answer, column))

    return draw


# ---- maps of directions ----


def principal_axes(inertia: ArrayLike) -> tuple[NDArray[Any], NDArray[Any]]:
    """Principal moments, ascending, and axes (columns, right-handed) of three moments or a tensor."""
    given = np.asarray(inertia, dtype=float)
    moments, axes = np.linalg.eigh(np.diag(given) if given.ndim == 1 else given)
    return moments, -axes if np.linalg.det(axes) < 0 else axes


def map_sides(centre: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """The directions that point to the right and upwards at the centre of a map, a unit vector."""
    up = np.eye(3)[int(np.argmin(np.abs(centre)))]
    right = np.cross(up, centre)
    right /= np.linalg.norm(right)
    return right, np.cross(centre, right)


def on_map(values: NDArray[Any], centre: NDArray[Any]) -> NDArray[Any]:
    """Directions (n, 3) in the equal-area map around a unit vector: (n, 2), the opposite point at distance 2."""
    right, up = map_sides(centre)
    along = np.clip(values @ centre, -1.0, 1.0)
    across = np.stack([values @ right, values @ up], -1)
    stretch = np.sqrt(2 / np.maximum(1 + along, 1e-12))
    made: NDArray[Any] = across * stretch[:, None]
    return made


def map_reach(points: NDArray[np.float64]) -> float:
    """How far the farthest of points (n, 2) on a map lies from its centre, and a little more [deg]."""
    return math.degrees(2 * math.asin(min(1.0, 1.05 * float(np.max(np.linalg.norm(points, axis=1))) / 2)))


def map_frame(axes: "Axes", title: str, reach: float = 180.0) -> float:
    """The circles of a map that shows directions as far as `reach` [deg] from its centre: of the whole sphere the rim and the equator. The radius of
    the outermost."""
    step = next((step for step in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0) if reach <= 4 * step), 0.0)
    angles = [step * (i + 1) for i in range(max(1, math.ceil(reach / step - 1e-9)))] if step else [90.0, 180.0]
    turn = np.linspace(0, 2 * math.pi, 361)
    for angle in angles:
        radius = 2 * math.sin(math.radians(angle) / 2)
        axes.plot(radius * np.cos(turn), radius * np.sin(turn), color="#999999", linewidth=0.8, linestyle="-" if angle == 180 else ":", label="_")
        if step or angle < 180:
            at = (0, radius) if step else (radius / math.sqrt(2), radius / math.sqrt(2))  # upwards may be an axis
            axes.annotate(f"{angle:.3g}°", at, ha="center", va="center", fontsize=7, color="#555555", zorder=1,
                          bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title(title, fontsize=10)
    return 2 * math.sin(math.radians(min(angles[-1], 180.0)) / 2)


def map_legend(axes: "Axes") -> None:
    """Names below the map."""
    axes.legend(loc="upper center", fontsize=8, bbox_to_anchor=(0.5, 0.0), borderaxespad=0, ncols=3, markerscale=1.0)


# ---- layout ----


def _over_time(answer: "Answer") -> tuple[NDArray[Any], str]:
    """The times in a fitting unit, and its name."""
    scale, unit = time_unit(float(answer.t[-1]))
    return answer.t / scale, unit


def goes_on(answer: "Answer") -> bool:
    """At the stop the momentum is gone, but the body turns on: that of its rotors turns it."""
    return any(warning.code == "does-not-stop" for warning in answer.warnings)


def mark_stop(figure: "Figure", answer: "Answer", panels: int) -> None:
    """A dotted line in the first panels where the body stops, or its momentum vanishes, or below the last of them that it does so later; nothing where
    that is not known."""
    stop, first, last = answer.scalars.get("stop_time"), answer.t[0], answer.t[-1]
    if stop is None or not math.isfinite(stop):
        return
    scale, _ = time_unit(last)
    if stop > last:
        figure.axes[panels - 1].annotate(f"{'|M| is 0' if goes_on(answer) else 'stops'} at {span_text(stop)} →", (1.0, 0.0), xytext=(0, -28), xycoords="axes fraction",
                                         textcoords="offset points", fontsize=8, color="#555555", ha="right")
    elif stop >= first:
        for axes in figure.axes[:panels]:
            axes.axvline(stop / scale, color="#555555", linestyle=":", linewidth=1)


def stacked(answer: "Answer", panels: Sequence[Panel]) -> "Figure":
    """Panels over one axis of time, one below the other."""
    figure = new_figure(9, 1.0 + 2.2 * len(panels))
    t, unit = _over_time(answer)
    every = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(every, panels, strict=True):
        panel(axes, answer, t)
        axes.grid(alpha=0.3)
    every[-1].set_xlabel(f"time [{unit}]")
    return figure


def laid_out(answer: "Answer", maps: Sequence[Callable[["Axes", "Answer"], None]], panels: Sequence[Panel]) -> "Figure":
    """Maps side by side on top, and below them panels over time in two columns; an odd one is as wide as both."""
    rows = -(-len(panels) // 2)
    figure = new_figure(11, (4.9 if maps else 0.6) + 2.3 * rows)
    t, unit = _over_time(answer)
    above = 2.1 if maps else 0.01
    grid = figure.add_gridspec(1 + rows, 2 * max(1, len(maps)), height_ratios=(above, *[1.0] * rows))
    columns = 2 * max(1, len(maps))
    for i, draw in enumerate(maps):
        draw(figure.add_subplot(grid[0, 2 * i:2 * i + 2]), answer)
    for i, panel in enumerate(panels):
        odd = i == len(panels) - 1 and i % 2 == 0
        half = slice(0, columns) if odd else slice(0, columns // 2) if i % 2 == 0 else slice(columns // 2, columns)
        axes = figure.add_subplot(grid[1 + i // 2, half])
        panel(axes, answer, t)
        axes.grid(alpha=0.3)
        if i >= len(panels) - 2:
            axes.set_xlabel(f"time [{unit}]")
    return figure
