# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a free motion: the path of the momentum on its sphere in the body with the separatrix, the path of a body axis in space, and
rates, attitude and wheels over time, flips marked."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import (
    COLOURS, MOMENT_NAMES, Panel, components, error_text, laid_out, map_frame, map_legend, map_reach, map_sides, note, on_map, principal_axes, vector, wheels_panel)
from gyrostat.errors import DomainError
from gyrostat.families.free.functions import flips, permanent_rotations, reduced
from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["figure", "remarks", "sphere"]

Vectors = NDArray[np.float64]

NEAR = 30.0  # deg: a path that goes no farther from the middle of its map is shown on one as large as itself


def figure(answer: "Answer", given: Mapping[str, Any]) -> "Figure":
    """Momentum sphere and path of an axis on top, columns over time below."""
    body = {name: given[name] for name in ("inertia", "rotor_momentum", "wheels", "angular_velocity", "angular_momentum")}
    turning = float(np.linalg.norm(answer["angular_momentum"][0])) > 0
    maps = [sphere(body), _space(body)] if turning else []
    panels: list[Panel] = [_rates(body), vector("attitude", "q", "", "Attitude, body to inertial")]
    if "rotor_rate" in answer.columns:
        panels += [wheels_panel("rotor_rate", "rate", "rad/s", "Rates of the wheels"),
                   wheels_panel("rotor_angle", "angle", "rad", "Angles of the wheels")]
    return laid_out(answer, maps, panels)


def remarks(answer: "Answer", _: Mapping[str, Any]) -> list[str]:
    """For the title."""
    kind, period = answer.scalars.get("kind"), answer.scalars.get("period")
    if kind is None:
        return []
    return [str(kind)] + ([f"period {period:.4g} s"] if period is not None and math.isfinite(period) else [])


def sphere(body: Mapping[str, Any], all_unstable: bool = False) -> Any:
    """The map of M in the body, with the permanent rotations and the separatrix, of a `body` as `solve` takes it: of a path that stays near its middle
    only what is there, unless `all_unstable` rotations are wanted and there are some."""

    def draw(axes: "Axes", answer: "Answer") -> None:
        M = answer["angular_momentum"]
        R = float(np.linalg.norm(M[0]))
        n = M / R
        _, principal = principal_axes(body["inertia"])
        centre = principal[:, int(np.argmax(np.abs(principal.T @ n.mean(0))))]
        centre = centre * (1 if centre @ n.mean(0) >= 0 else -1)
        try:
            found = permanent_rotations(**body)
        except DomainError:
            found = None
        points = on_map(n, centre)
        reach = map_reach(points)
        near = reach < NEAR and not (all_unstable and found is not None and not np.all(found.stable))
        edge = map_frame(axes, "Momentum in the body, near its axis" if near else "Momentum sphere in the body, equal area", reach if near else 180.0)
        half = 1.03 * edge  # the contours of the separatrix cut the rim
        if found is not None:
            _separatrix(axes, body, found, R, centre, min(edge, 2.0))
            kinds = ((found.stable, "o", COLOURS[2], "stable rotation"), (found.isolated & ~found.stable, "X", COLOURS[4], "unstable"),
                     (~found.isolated, "D", COLOURS[3], "one of a circle"))
            for those, marker, colour, name in kinds:
                at = found.angular_momentum[those] / R
                where = on_map(at, centre) if len(at) else np.empty((0, 2))
                where = where[np.linalg.norm(where, axis=1) < half]
                if len(where):
                    axes.plot(where[:, 0], where[:, 1], marker, color=colour, markersize=6, label=name, linestyle="none")
        axes.plot(points[:, 0], points[:, 1], ".", color=COLOURS[0], markersize=2, label="M")
        axes.plot(*points[0], "o", color=COLOURS[0], markersize=5, label="start")
        _body_axes(axes, centre, half)
        axes.set(xlim=(-half, half), ylim=(-half, half))
        map_legend(axes)

    return draw


def _body_axes(axes: "Axes", centre: Vectors, half: float) -> None:
    """Crosses where the body's own axes are, but for what lies on the rim, opposite the centre."""
    for sign, before in ((1.0, "+"), (-1.0, "\u2212")):
        for axis, name in zip(sign * np.eye(3), "xyz", strict=True):
            if axis @ centre > -0.99:
                (at,) = on_map(axis[None, :], centre)
                if np.linalg.norm(at) >= half:
                    continue
                axes.plot(*at, "+", color="#000000", markersize=6, label="_")
                axes.annotate(f"{before}{name}", at, xytext=(4, 4), textcoords="offset points", fontsize=8)


def _separatrix(axes: "Axes", body: Mapping[str, Any], found: Any, R: float, centre: Vectors, edge: float) -> None:
    """The level of the energy through each unstable rotation."""
    side = np.linspace(-edge, edge, 401)
    x, y = np.meshgrid(side, side)
    r2 = x**2 + y**2
    inside = r2 <= edge**2
    right, up = map_sides(centre)
    across = np.sqrt(np.maximum(1 - r2 / 4, 0))
    n = (x * across)[..., None] * right + (y * across)[..., None] * up + (1 - r2 / 2)[..., None] * centre
    inertia, l, _ = reduced(body)
    G = R * n - l
    energy = 0.5 * np.einsum("...i,ij,...j", G, np.linalg.inv(inertia), G)
    energy[~inside] = np.nan
    levels = sorted({float(e) for e in found.energy[~found.stable]})
    if any(np.nanmin(energy) < level < np.nanmax(energy) for level in levels):
        axes.contour(x, y, energy, levels=levels, colors=COLOURS[1], linewidths=0.8)
        axes.plot([], [], color=COLOURS[1], linewidth=0.8, label="separatrix")


def _space(body: Mapping[str, Any]) -> Any:
    def draw(axes: "Axes", answer: "Answer") -> None:
        _, principal = principal_axes(body["inertia"])
        n = (answer["angular_momentum"] @ principal) / np.linalg.norm(answer["angular_momentum"][0])
        which = int(np.argmax(np.abs(n).min(0)))
        R = matrix_from_quaternion(answer["attitude"])
        rotated = R @ principal[:, which]
        pole = R[0] @ answer["angular_momentum"][0]
        pole = pole / np.linalg.norm(pole)
        if np.mean(rotated @ pole) < 0:
            rotated = -rotated
        points = on_map(rotated, pole)
        reach = map_reach(points)
        map_frame(axes, "Path of a body axis in space, the momentum in the middle", reach if reach < NEAR else 180.0)
        axes.plot(points[:, 0], points[:, 1], ".", color=COLOURS[3], markersize=2,
                  label=f"axis of the {MOMENT_NAMES[which]} moment")
        axes.plot(*points[0], "o", color=COLOURS[3], markersize=5, label="start")
        axes.plot(0, 0, "+", color="#000000", markersize=8, label="angular momentum")
        map_legend(axes)

    return draw


def _rates(body: Mapping[str, Any]) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        components(axes, t, answer["angular_velocity"], "ω", "rad/s", "Angular velocity, body axes")
        note(axes, error_text(answer, "angular_velocity"))
        interval = answer.scalars.get("flip_interval")
        if interval and 1 <= float(answer.t[-1]) / interval <= 60:
            middle = principal_axes(body["inertia"])[1][:, 1]
            scale = float(answer.t[-1]) / t[-1] if t[-1] else 1.0
            for time in flips(**body, axis=middle, begin=float(answer.t[0]), end=float(answer.t[-1])):
                axes.axvline(time / scale, color="#999999", linewidth=0.8, linestyle=":", label="_flip")

    return draw


