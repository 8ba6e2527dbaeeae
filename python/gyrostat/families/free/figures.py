# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a free motion: the path of the momentum on its sphere in the body with the separatrix, the path of a body axis in space, and
rates, attitude and wheels over time, flips marked."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import COLOURS, Panel, components, curve, error_text, laid_out, legend_row, note, vector
from gyrostat.errors import DomainError
from gyrostat.families.free.functions import flips, permanent_rotations, reduced

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["figure", "remarks", "sphere"]

Vectors = NDArray[np.float64]


def figure(answer: "Answer", given: Mapping[str, Any]) -> "Figure":
    """Momentum sphere and path of an axis on top, columns over time below."""
    body = {name: given[name] for name in ("inertia", "rotor_momentum", "wheels", "angular_velocity", "angular_momentum")}
    turning = float(np.linalg.norm(answer["angular_momentum"][0])) > 0
    maps = [sphere(body), _space(body)] if turning else []
    panels: list[Panel] = [_rates(body), vector("attitude", "q", "", "Attitude, body to inertial")]
    if "rotor_rate" in answer.columns:
        panels += [_wheels("rotor_rate", "rate", "rad/s", "Rates of the wheels"),
                   _wheels("rotor_angle", "angle", "rad", "Angles of the wheels")]
    return laid_out(answer, maps, panels)


def remarks(answer: "Answer") -> list[str]:
    """For the title."""
    kind, period = answer.scalars.get("kind"), answer.scalars.get("period")
    if kind is None:
        return []
    return [str(kind)] + ([f"period {period:.4g} s"] if period is not None and math.isfinite(period) else [])


def _axes_of(body: Mapping[str, Any]) -> tuple[Vectors, Vectors]:
    """Principal moments, ascending, and axes (columns) of the whole, wheels locked."""
    inertia = np.asarray(body["inertia"], dtype=float)
    moments, axes = np.linalg.eigh(np.diag(inertia) if inertia.ndim == 1 else inertia)
    if np.linalg.det(axes) < 0:
        axes = -axes
    return moments, axes


def _shown(values: Vectors, centre: Vectors) -> Vectors:
    """Directions (n, 3) in the equal-area map around a unit vector: (n, 2), the opposite point at distance 2."""
    up = np.eye(3)[int(np.argmin(np.abs(centre)))]
    right = np.cross(up, centre)
    right /= np.linalg.norm(right)
    along = np.clip(values @ centre, -1.0, 1.0)
    across = np.stack([values @ right, values @ np.cross(centre, right)], -1)
    stretch = np.sqrt(2 / np.maximum(1 + along, 1e-12))
    made: Vectors = across * stretch[:, None]
    return made


def _frame(axes: "Axes", title: str) -> None:
    for radius, style in ((2.0, "-"), (math.sqrt(2), ":")):
        turn = np.linspace(0, 2 * math.pi, 361)
        axes.plot(radius * np.cos(turn), radius * np.sin(turn), color="#999999", linewidth=0.8, linestyle=style, label="_")
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title(title, fontsize=10)


def _legend(axes: "Axes") -> None:
    """Names below the map."""
    axes.legend(loc="upper center", fontsize=8, bbox_to_anchor=(0.5, 0.0), borderaxespad=0, ncols=3, markerscale=1.0)


def sphere(body: Mapping[str, Any]) -> Any:
    """The map of M in the body, with the permanent rotations and the separatrix, of a `body` as `solve` takes it."""

    def draw(axes: "Axes", answer: "Answer") -> None:
        M = answer["angular_momentum"]
        R = float(np.linalg.norm(M[0]))
        n = M / R
        _, principal = _axes_of(body)
        centre = principal[:, int(np.argmax(np.abs(principal.T @ n.mean(0))))]
        centre = centre * (1 if centre @ n.mean(0) >= 0 else -1)
        _frame(axes, "Momentum sphere in the body, equal area")
        try:
            found = permanent_rotations(**body)
        except DomainError:
            found = None
        if found is not None:
            _separatrix(axes, body, found, R, centre)
            for stable, marker, colour, name in ((True, "o", COLOURS[2], "stable rotation"), (False, "X", COLOURS[4], "unstable")):
                at = found.angular_momentum[found.stable == stable] / R
                if len(at):
                    points = _shown(at, centre)
                    axes.plot(points[:, 0], points[:, 1], marker, color=colour, markersize=6, label=name, linestyle="none")
        points = _shown(n, centre)
        axes.plot(points[:, 0], points[:, 1], ".", color=COLOURS[0], markersize=2, label="M")
        axes.plot(*points[0], "o", color=COLOURS[0], markersize=5, label="start")
        _legend(axes)

    return draw


def _separatrix(axes: "Axes", body: Mapping[str, Any], found: Any, R: float, centre: Vectors) -> None:
    """The level of the energy through each unstable rotation."""
    side = np.linspace(-2, 2, 401)
    x, y = np.meshgrid(side, side)
    r2 = x**2 + y**2
    inside = r2 <= 4
    up = np.eye(3)[int(np.argmin(np.abs(centre)))]
    right = np.cross(up, centre)
    right /= np.linalg.norm(right)
    across = np.sqrt(np.maximum(1 - r2 / 4, 0))
    n = (x * across)[..., None] * right + (y * across)[..., None] * np.cross(centre, right) + (1 - r2 / 2)[..., None] * centre
    inertia, l, _ = reduced(body)
    G = R * n - l
    energy = 0.5 * np.einsum("...i,ij,...j", G, np.linalg.inv(inertia), G)
    energy[~inside] = np.nan
    levels = sorted({float(e) for e in found.energy[~found.stable]})
    if levels:
        axes.contour(x, y, energy, levels=levels, colors=COLOURS[1], linewidths=0.8)
        axes.plot([], [], color=COLOURS[1], linewidth=0.8, label="separatrix")


def _space(body: Mapping[str, Any]) -> Any:
    def draw(axes: "Axes", answer: "Answer") -> None:
        x, y, z, w = answer["attitude"].T
        moments, principal = _axes_of(body)
        n = (answer["angular_momentum"] @ principal) / np.linalg.norm(answer["angular_momentum"][0])
        which = int(np.argmax(np.abs(n).min(0)))
        b = principal[:, which]
        # q b q^-1
        rotated = np.stack([
            (1 - 2 * (y * y + z * z)) * b[0] + 2 * (x * y - w * z) * b[1] + 2 * (x * z + w * y) * b[2],
            2 * (x * y + w * z) * b[0] + (1 - 2 * (x * x + z * z)) * b[1] + 2 * (y * z - w * x) * b[2],
            2 * (x * z - w * y) * b[0] + 2 * (y * z + w * x) * b[1] + (1 - 2 * (x * x + y * y)) * b[2]], -1)
        pole = np.asarray(_inertial(answer["attitude"][0], answer["angular_momentum"][0]))
        pole = pole / np.linalg.norm(pole)
        if np.mean(rotated @ pole) < 0:
            rotated = -rotated
        _frame(axes, "Path of a body axis in space, the momentum in the middle")
        points = _shown(rotated, pole)
        axes.plot(points[:, 0], points[:, 1], ".", color=COLOURS[3], markersize=2,
                  label=f"axis of the {('least', 'middle', 'greatest')[which]} moment")
        axes.plot(*points[0], "o", color=COLOURS[3], markersize=5, label="start")
        axes.plot(0, 0, "+", color="#000000", markersize=8, label="angular momentum")
        _legend(axes)

    return draw


def _inertial(q: Vectors, v: Vectors) -> Vectors:
    u, w = q[:3], q[3]
    t = 2 * np.cross(u, v)
    made: Vectors = v + w * t + np.cross(u, t)
    return made


def _rates(body: Mapping[str, Any]) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        components(axes, t, answer["angular_velocity"], "ω", "rad/s", "Angular velocity, body axes")
        note(axes, error_text(answer, "angular_velocity"))
        interval = answer.scalars.get("flip_interval")
        if interval and 1 <= float(answer.t[-1]) / interval <= 60:
            middle = _axes_of(body)[1][:, 1]
            scale = float(answer.t[-1]) / t[-1] if t[-1] else 1.0
            for time in flips(**body, axis=middle, begin=float(answer.t[0]), end=float(answer.t[-1])):
                axes.axvline(time / scale, color="#999999", linewidth=0.8, linestyle=":", label="_flip")

    return draw


def _wheels(column: str, symbol: str, unit: str, title: str) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        values = answer[column]
        curve(axes, t, values, [f"{i + 1}" for i in range(values.shape[1])])
        axes.set_ylabel(f"{symbol} [{unit}]")
        legend_row(axes)
        axes.set_title(title, loc="left", fontsize=10)
        note(axes, error_text(answer, column))

    return draw
