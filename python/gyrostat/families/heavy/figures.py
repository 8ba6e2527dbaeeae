# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a heavy body: the paths of down in the body and of axis 3 in space, rates, down, nutation and precession."""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import COLOURS, Panel, changes, curve, error_text, is_coarse, laid_out, legend_beside, legend_row, note, span_text, split, time_unit, vector
from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["figure", "remarks"]


def figure(answer: "Answer", given: Mapping[str, Any]) -> "Figure":
    """Maps of directions, and panels over time of what changes."""
    down = answer["down"]
    panels: list[tuple[bool, Panel]] = [
        (True, split("angular_velocity", "ω", "rad/s", "Angular velocity, body axes")),
        (changes(down), vector("down", "d", "", "Down, body axes")),
        (changes(_inclination(down)), _nutation),
        (bool(np.any(np.hypot(down[:, 0], down[:, 1]) > 0)), _precession)]
    maps: list[Callable[["Axes", "Answer"], None]] = [partial(_heavy_sphere, given=given), _heavy_axis if "attitude" in answer.columns else _hodograph]
    return laid_out(answer, maps, [panel for shown, panel in panels if shown])


def remarks(answer: "Answer", _: Mapping[str, Any]) -> list[str]:
    """For the title."""
    period = answer.scalars.get("period")
    if period is None:
        return []
    made = [f"period {period:.6g} s" + (f" ({span_text(period)})" if time_unit(period)[1] != "s" else "")]
    if answer.scalars["stable"] is not None:
        made.append("stable" if answer.scalars["stable"] else "unstable")
    if answer.scalars["precession_rate"] is not None:
        made.append(f"mean precession {answer.scalars['precession_rate']:.4g} rad/s")
    return [", ".join(made)]


def _onto_map(sign: float, m: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Lambert's equal-area map of directions (..., 3) around axis 3 times `sign`: the hemisphere is the unit disc, its far end the rim's foot."""
    x, y, z = m[..., 0], sign * m[..., 1], sign * m[..., 2]
    across = np.hypot(x, y)
    size = np.where(z > 0, across / np.sqrt(1 + np.abs(z)), np.sqrt(1 + np.abs(z)))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(across > 0, x / across, 0.0) * size, np.where(across > 0, y / across, -1.0) * size


def _sphere_path(axes: "Axes", path: NDArray[Any], colour: str, name: str, names: tuple[str, str, str, str], title: str) -> tuple[float, float]:
    """The path of a direction (n, 3) on a map of the sphere around the end of axis 3 that is nearer.

    A path that stays near it is drawn larger, with a circle of equal angle; else the dashed circle is the equator, the rim the other end. names :
    of the axes and of -(axis 3). Returns the end, 1 or -1, and how far the map reaches.
    """
    from matplotlib.patches import Circle

    sign = -1.0 if np.mean(path[:, 2]) < 0 else 1.0
    x, y = _onto_map(sign, path)
    farthest = float(np.max(np.hypot(x, y)))
    reach = 1.5 if farthest > 0.7 else max(1.3 * farthest, 1e-3)
    angle = 90.0
    if reach < 1.5:
        most = 2 * math.degrees(math.asin(farthest / math.sqrt(2))) or 0.1
        unit = 10.0 ** math.floor(math.log10(most))
        angle = max(step * unit for step in (1, 2, 5) if step * unit <= most * (1 + 1e-9))
    radius = math.sqrt(2) * math.sin(math.radians(angle) / 2)
    axes.add_patch(Circle((0.0, 0.0), radius, facecolor="none", edgecolor="#777777", linewidth=0.8, linestyle="--"))
    axes.annotate(f"{angle:g}°", (radius * math.cos(0.8), -radius * math.sin(0.8)), fontsize=8, color="#555555", zorder=5)
    axes.add_patch(Circle((0.0, 0.0), math.sqrt(2.0), facecolor="none", edgecolor="#777777", linewidth=0.8))
    marks = [(np.array([0.0, 0.0, sign]), names[2] if sign > 0 else names[3])]
    marks += [(way * np.eye(3)[i], f"{'' if way > 0 else '−'}{names[i]}") for i in (0, 1) for way in (1.0, -1.0)]
    for direction, mark in marks:
        u, v = map(float, _onto_map(sign, direction))
        if max(abs(u), abs(v)) <= reach:
            axes.plot([u], [v], marker="+", color="#777777", markersize=6, linestyle="none")
            axes.annotate(mark, (u, v), xytext=(4, 3), textcoords="offset points", fontsize=8, color="#555555", zorder=5)
    jumps = np.concatenate([[False], np.hypot(np.diff(x), np.diff(y)) > 1.0])  # across the rim
    curve(axes, np.where(jumps, np.nan, x), y, [name], [colour], coarse=is_coarse(path), linewidth=0.8 if len(path) < 2000 else 0.4)
    axes.plot(x[:1], y[:1], color=colour, marker="o", markersize=5, linestyle="none", label="start")
    axes.set_aspect("equal")
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.axis("off")
    axes.set_title(title, loc="left", fontsize=10)
    return sign, reach


def _heavy_sphere(axes: "Axes", answer: "Answer", given: Mapping[str, Any]) -> None:
    sign, reach = _sphere_path(axes, answer["down"], COLOURS[0], "path of down", ("1", "2", "3", "−3"), "Down, body axes")
    centre = given["centre_of_mass"]
    size = float(np.linalg.norm(centre))
    if size > 0:
        u, v = map(float, _onto_map(sign, centre / size))
        if max(abs(u), abs(v)) <= reach:
            axes.plot([u], [v], marker="*", color=COLOURS[1], markersize=11, markeredgecolor="white", linestyle="none", label="mass centre")
    legend_beside(axes)
    note(axes, error_text(answer, "down"))


def _hodograph(axes: "Axes", answer: "Answer") -> None:
    w = answer["angular_velocity"]
    curve(axes, w[:, 0], w[:, 1], ["path"], [COLOURS[2]], coarse=is_coarse(w[:, :2]), linewidth=0.8)
    axes.plot(w[:1, 0], w[:1, 1], color=COLOURS[2], marker="o", markersize=5, linestyle="none", label="start")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("ω1 [rad/s]")
    axes.set_ylabel("ω2 [rad/s]")
    axes.grid(alpha=0.3)
    legend_beside(axes)
    axes.set_title("Angular velocity across axis 3", loc="left", fontsize=10)
    note(axes, error_text(answer, "angular_velocity"))


def _heavy_axis(axes: "Axes", answer: "Answer") -> None:
    R = matrix_from_quaternion(answer["attitude"])
    _sphere_path(axes, R[:, :, 2], COLOURS[2], "path of axis 3", ("1", "2", "up", "down"), "Body axis 3, inertial axes")
    legend_beside(axes)
    note(axes, error_text(answer, "attitude"))


def _inclination(down: NDArray[Any]) -> NDArray[Any]:
    """Angle of axis 3 to down (n,), deg."""
    made: NDArray[Any] = np.degrees(np.arctan2(np.hypot(down[:, 0], down[:, 1]), down[:, 2]))
    return made


def _nutation(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    theta = _inclination(answer["down"])
    curve(axes, t, theta, ["_theta"], coarse=is_coarse(theta[:, None] - np.mean(theta)))
    axes.set_ylabel("theta [deg]")
    axes.set_title("Nutation: angle of axis 3 to down", loc="left", fontsize=10)


def _precession(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    """The angle about down where the attitude is known, else its rate."""
    mean = answer.scalars["precession_rate"]
    if "attitude" in answer.columns:
        R = matrix_from_quaternion(answer["attitude"])
        psi = np.unwrap(np.arctan2(R[:, 0, 2], R[:, 1, 2])) / (2 * np.pi)
        curve(axes, t, psi, ["psi"], COLOURS[2:], coarse=False)
        if mean is not None:
            axes.plot(t, psi[0] + mean * (answer.t - answer.t[0]) / (2 * np.pi), color=COLOURS[1], linestyle="--", linewidth=1, label="mean")
        axes.set_ylabel("psi [turns]")
    else:
        d, w = answer["down"], answer["angular_velocity"]
        across = d[:, 0] ** 2 + d[:, 1] ** 2
        with np.errstate(divide="ignore", invalid="ignore"):
            rate = np.where(across > 1e-12, (w[:, 0] * d[:, 0] + w[:, 1] * d[:, 1]) / across, np.nan)
        curve(axes, t, rate, ["psi'"], COLOURS[2:], coarse=is_coarse(rate[:, None] - np.mean(rate)))
        if mean is not None:
            axes.axhline(mean, color=COLOURS[1], linestyle="--", linewidth=1, label="mean")
        axes.set_ylabel("psi' [rad/s]")
        low, high = np.nanquantile(rate, [0.02, 0.98]) if np.any(np.isfinite(rate)) else (0.0, 1.0)
        if np.nanmax(np.abs(rate), initial=0.0) > 10 * max(abs(low), abs(high)) > 0:  # near the vertical it has no bound
            room = 0.3 * (high - low)
            axes.set_ylim(low - room, high + room)
    legend_row(axes)
    axes.set_title("Precession about down", loc="left", fontsize=10)
