# SPDX-License-Identifier: BSD-3-Clause
"""The momentum sphere of a gyrostat with a motor-driven rotor: levels of F, steady rotations, the path of the momentum."""

import math
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import new_figure, time_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["Path", "Sphere", "from_disc", "onto_disc", "plot_sphere"]

Vectors = NDArray[np.float64]

TYPES: Final = {  # type -> marker, colour, meaning
    "min": ("o", "#009E73", "minimum of F"),
    "saddle": ("X", "#E69F00", "saddle"),
    "max": ("^", "#D55E00", "maximum"),
    "degenerate": ("D", "#999999", "degenerate"),
}
GRID: Final = 361  # points across a hemisphere
LEVELS: Final = 15
PATHS: Final = "plasma"


@dataclass(frozen=True, eq=False)
class Sphere:
    """F(m) = (l m - h e).J (l m - h e)/2 on the unit sphere of m = H/l, body axes (docs/rotor.md, section 3)."""

    inertia: Vectors  # theta (3, 3), kg m2
    axis: Vectors  # e
    momentum_norm: float  # l, N m s
    target_momentum: float  # h = lambda omega*, N m s

    def level(self, m: Vectors) -> Vectors:
        """F of directions (..., 3), J."""
        y = self.momentum_norm * m - self.target_momentum * self.axis
        made: Vectors = 0.5 * np.einsum("...i,ij,...j", y, np.linalg.inv(self.inertia), y)
        return made

    def views(self) -> tuple[Vectors, Vectors]:
        """Bases (rows: right, up, towards the eye) of the hemispheres around e and around -e.

        Up is the axis of largest inertia as far as it is across e, else the next one.
        """
        _, axes = np.linalg.eigh(self.inertia)
        across = [v - (v @ self.axis) * self.axis for v in axes.T[::-1]]
        up = next(v for v in across if np.linalg.norm(v) > 0.1)
        up = up / np.linalg.norm(up)
        right = np.cross(up, self.axis)
        return np.array([right, up, self.axis]), np.array([-right, up, -self.axis])


@dataclass(frozen=True, eq=False)
class Path:
    """Pieces of the motion: times [s], directions m (n, 3) and V [J] of each."""

    t: Sequence[Vectors]
    direction: Sequence[Vectors]
    lyapunov: Sequence[Vectors]
    note: str


def onto_disc(view: Vectors, m: Vectors) -> tuple[Vectors, Vectors, NDArray[np.bool_]]:
    """Lambert's equal-area map of directions (..., 3): x, y (the hemisphere is the unit disc) and whether it is in front."""
    x, y, z = np.moveaxis(m @ view.T, -1, 0)
    scale = 1.0 / np.sqrt(np.maximum(1.0 + z, 1e-12))
    return x * scale, y * scale, z >= 0


def from_disc(view: Vectors, x: Vectors, y: Vectors) -> Vectors:
    """The inverse of the map; NaN outside the disc."""
    r2 = x * x + y * y
    z = np.where(r2 <= 1.0, 1.0 - r2, np.nan)
    scale = np.sqrt(1.0 + z)
    made: Vectors = np.stack([x * scale, y * scale, z], axis=-1) @ view
    return made


def _hemisphere(axes: "Axes", sphere: Sphere, view: Vectors, levels: Vectors, saddles: Sequence[float]) -> Any:
    """Levels of F on one hemisphere, the circles of equal angle from the rotor axis, and the principal axes."""
    from matplotlib.patches import Circle

    grid = np.linspace(-1.0, 1.0, GRID)
    x, y = np.meshgrid(grid, grid)
    inside = np.hypot(x, y)
    shrunk = np.maximum(inside, 1.0)  # the levels reach the rim: values outside are those of the rim
    F = sphere.level(from_disc(view, x / shrunk * (1 - 1e-9), y / shrunk * (1 - 1e-9)))
    filled = axes.contourf(x, y, F, levels=levels, cmap="Greys_r", alpha=0.55)
    lines = axes.contour(x, y, F, levels=levels[1:-1], colors="#555555", linewidths=0.45)
    rim = Circle((0.0, 0.0), 1.0, facecolor="none", edgecolor="black", linewidth=1.0, transform=axes.transData)
    axes.add_patch(rim)
    for drawn in (filled, lines):
        drawn.set_clip_path(rim)
    if saddles:
        axes.contour(x, y, F, levels=sorted(set(saddles)), colors=TYPES["saddle"][1], linewidths=1.6).set_clip_path(rim)
    centre = 0 if view[2] @ sphere.axis > 0 else 180
    for angle in (30, 60):
        radius = np.sqrt(2.0) * np.sin(np.radians(angle) / 2)
        axes.add_patch(Circle((0.0, 0.0), radius, facecolor="none", edgecolor="#0072B2", linewidth=0.6, linestyle=":"))
        axes.annotate(f"{abs(centre - angle)}°", (radius * np.sin(0.35), -radius * np.cos(0.35)), fontsize=7, color="#0072B2", ha="center", va="center")
    axes.annotate("90°", (1.02 * np.sin(0.35), -1.02 * np.cos(0.35)), fontsize=7, color="#0072B2", ha="left", va="top")
    axes.plot(0.0, 0.0, marker="*", markersize=13, color="#0072B2", markeredgecolor="white", markeredgewidth=0.8, zorder=5)
    axes.annotate("e" if centre == 0 else "−e", (0.0, 0.0), xytext=(-9, -11), textcoords="offset points", fontsize=10, color="#0072B2", ha="right", zorder=6)
    _, principal = np.linalg.eigh(sphere.inertia)
    for number, vector in enumerate(principal.T, 1):
        for sign in (1.0, -1.0):
            px, py, front = onto_disc(view, sign * vector)
            if front:
                axes.plot(px, py, marker="+", color="black", markersize=8, markeredgewidth=1.0, zorder=3)
                axes.annotate(f"{'' if sign > 0 else '−'}I{'₁₂₃'[number - 1]}", (px, py), xytext=(4, -10), textcoords="offset points", fontsize=8)
    axes.set_aspect("equal")
    axes.set_xlim(-1.08, 1.08)
    axes.set_ylim(-1.08, 1.08)
    axes.axis("off")
    return filled


def _markers(axes: "Axes", view: Vectors, steady: Sequence[Mapping[str, Any]]) -> None:
    for rotation in steady:
        x, y, front = onto_disc(view, np.array(rotation["direction"]))
        if not front:
            continue
        marker, colour, _ = TYPES[rotation["type"]]
        axes.plot(x, y, marker=marker, markersize=10, color=colour, markeredgecolor="black", markeredgewidth=0.9, zorder=7)
        axes.annotate(str(rotation["index"]), (x, y), xytext=(6, 6), textcoords="offset points", fontsize=9, fontweight="bold", zorder=8,
                      bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.7})


def _curve(axes: "Axes", view: Vectors, path: Path, norm: Any, scale: float) -> None:
    from matplotlib.collections import LineCollection

    for t, direction in zip(path.t, path.direction, strict=True):
        x, y, front = onto_disc(view, direction)
        points = np.stack([x, y], axis=-1)
        both = front[:-1] & front[1:]
        segments = np.stack([points[:-1], points[1:]], axis=1)[both]
        line = LineCollection(list(segments), cmap=PATHS, norm=norm, linewidths=1.1, zorder=4)
        line.set_array((0.5 * (t[:-1] + t[1:]) / scale)[both])
        axes.add_collection(line)
    x, y, front = onto_disc(view, path.direction[0][0])
    if front:
        axes.plot(x, y, marker="s", markersize=8, color="white", markeredgecolor="black", markeredgewidth=1.4, zorder=7)
        axes.annotate("start", (x, y), xytext=(7, -11), textcoords="offset points", fontsize=8, zorder=8,
                      bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.7})


def _decay(axes: "Axes", path: Path, steady: Sequence[Mapping[str, Any]], attractor: int, norm: Any, scale: float, unit: str) -> None:
    """V over time above F of the attractor, with the levels of the steady rotations."""
    from matplotlib.collections import LineCollection

    base = steady[attractor]["level"] if steady else 0.0
    top = max(float(np.max(v)) for v in path.lyapunov) - base
    least = top
    for t, V in zip(path.t, path.lyapunov, strict=True):
        above = np.maximum(V - base, 1e-12 * max(top, 1e-300))
        least = min(least, float(np.min(above)))
        points = np.stack([t / scale, above], axis=-1)
        line = LineCollection(list(np.stack([points[:-1], points[1:]], axis=1)), cmap=PATHS, norm=norm, linewidths=2.0, zorder=4)
        line.set_array(0.5 * (t[:-1] + t[1:]) / scale)
        axes.add_collection(line)
    for before, after, V_before, V_after in zip(path.t[:-1], path.t[1:], path.lyapunov[:-1], path.lyapunov[1:], strict=True):
        axes.plot([before[-1] / scale, after[0] / scale], [max(V_before[-1] - base, least), max(V_after[0] - base, least)], color="#AAAAAA", linewidth=0.7, zorder=3)
    top = max(top, 2 * least)
    shown = [(r["level"] - base, f"{r['index']} ({r['type']})", TYPES[r["type"]][1]) for r in steady]
    shown = [each for each in shown if 0.3 * least < each[0] < 3 * top]
    near = 0.05 * math.log(6 * top / least)  # on the logarithmic axis: labels closer than this share a line
    names: list[tuple[float, list[str]]] = []
    for level, name, colour in shown:
        axes.axhline(level, color=colour, linestyle="--", linewidth=1.1, zorder=2)
        if names and math.log(level / names[-1][0]) < near:
            names[-1][1].append(name)
        else:
            names.append((level, [name]))
    for level, together in names:
        axes.annotate(", ".join(together), (1.0, level), xycoords=("axes fraction", "data"), xytext=(4, 0),
                      textcoords="offset points", fontsize=8, va="center", annotation_clip=False)
    axes.set_yscale("log")
    first, last = float(path.t[0][0]) / scale, float(path.t[-1][-1]) / scale
    axes.set_xlim(first, last if last > first else first + 1)
    axes.set_ylim(0.5 * least, 2.0 * max(top, *(level for level, _, _ in shown)) if shown else 2.0 * top)
    axes.set_xlabel(f"time [{unit}]")
    axes.set_ylabel(f"V − F of {attractor} [J]" if steady else "V [J]")
    axes.grid(alpha=0.3)
    axes.set_title(f"Lyapunov function against the levels of the steady rotations; {path.note}", loc="left", fontsize=9)


def plot_sphere(sphere: Sphere, steady: Sequence[Mapping[str, Any]], path: Path, attractor: int, title: str) -> "Figure":
    """Both hemispheres of the momentum sphere, equal in area, and below them V over the time of the path.

    steady : rotations with index, direction, type and level, as in the stability report; attractor : index of the one to measure V from.
    """
    import matplotlib
    from matplotlib.colors import PowerNorm
    from matplotlib.lines import Line2D

    figure = new_figure(14.5, 9.2)
    figure.get_layout_engine().set(w_pad=0.08)  # type: ignore[union-attr, call-arg]
    grid = figure.add_gridspec(2, 2, height_ratios=(3.8, 1.0))
    panels = [figure.add_subplot(grid[0, i]) for i in range(2)]
    views = sphere.views()
    F = np.concatenate([sphere.level(_sample(view)) for view in views])
    levels = np.unique(np.quantile(F, np.linspace(0.0, 1.0, LEVELS + 1)))
    if levels[-1] - levels[0] <= 1e-9 * abs(levels[-1]):
        levels = np.array([0.9, 1.1]) * levels[0]  # one shade: F does not depend on m
    levels[0] -= 1e-9 * abs(levels[0])
    levels[-1] += 1e-9 * abs(levels[-1])
    saddles = [float(r["level"]) for r in steady if r["type"] == "saddle"]
    scale, unit = time_unit(float(path.t[-1][-1] - path.t[0][0]))
    norm = PowerNorm(0.5, float(path.t[0][0]) / scale, float(path.t[-1][-1]) / scale)  # most happens early
    filled: Any = None
    for axes, view, name in zip(panels, views, ("front: around the rotor axis e", "back: around −e"), strict=True):
        filled = _hemisphere(axes, sphere, view, levels, saddles)
        _curve(axes, view, path, norm, scale)
        _markers(axes, view, steady)
        axes.set_title(name, fontsize=10)
    figure.colorbar(filled, ax=panels, location="left", shrink=0.8, label="F(m) [J], shades of equal area", pad=0.01, format="%.4g")
    figure.colorbar(matplotlib.cm.ScalarMappable(norm, PATHS), ax=panels, location="right", shrink=0.8, label=f"time of the path [{unit}]", pad=0.01)
    _decay(figure.add_subplot(grid[1, :]), path, steady, attractor, norm, scale, unit)
    present = [kind for kind in TYPES if any(r["type"] == kind for r in steady)]
    handles = [Line2D([], [], marker=TYPES[k][0], color=TYPES[k][1], markeredgecolor="black", linestyle="none", markersize=9, label=TYPES[k][2]) for k in present]
    if saddles:
        handles.append(Line2D([], [], color=TYPES["saddle"][1], linewidth=1.6, label="level of a saddle"))
    handles.append(Line2D([], [], marker="*", color="#0072B2", markeredgecolor="white", linestyle="none", markersize=13, label="rotor axis; rings: angle of e to L"))
    handles.append(Line2D([], [], marker="+", color="black", linestyle="none", markersize=8, label="principal axes, I₁ < I₂ < I₃"))
    handles.append(Line2D([], [], color=matplotlib.colormaps[PATHS](0.35), linewidth=1.6, label="path of the momentum"))
    handles.append(Line2D([], [], marker="s", color="white", markeredgecolor="black", linestyle="none", markersize=8, label="start"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), fontsize=8, columnspacing=1.5)
    figure.suptitle(textwrap.fill(title, 185), fontsize=9)
    return figure


def _sample(view: Vectors) -> Vectors:
    """Directions spread evenly over a hemisphere."""
    grid = np.linspace(-1.0, 1.0, 101)
    x, y = np.meshgrid(grid, grid)
    inside = x * x + y * y <= 1.0
    return from_disc(view, x[inside], y[inside])
