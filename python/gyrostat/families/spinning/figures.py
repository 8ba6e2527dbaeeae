# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a thrusting spinner: directions of axis 3, of the momentum and of the velocity gained with their means, and the columns that change."""

import math
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import COLOURS, Panel, changes, curve, error_text, laid_out, legend_beside, legend_row, note, split
from gyrostat.families.spinning.functions import pointing, start_lean
from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["figure", "remarks"]

# Axis 3 tilts by more than this, and the linear motion, whose angles are drawn, says nothing [rad].
TUMBLING: Final = 1.0


def figure(answer: "Answer", given: Mapping[str, Any]) -> "Figure":
    """Maps of directions, and panels over time of what changes."""
    moved = bool(np.any(answer["velocity"] != given["velocity"]))
    panels: list[tuple[bool, Panel]] = [
        (True, split("angular_velocity", "ω", "rad/s", "Angular velocity, body axes")),
        (changes(answer["euler_312"][:, :2]), _angles),
        (changes(answer["angular_momentum_inertial"]), split("angular_momentum_inertial", "G", "N m s", "Momentum, inertial axes")),
        (moved and changes(answer["velocity"]), split("velocity", "v", "m/s", "Velocity, inertial axes")),
        (changes(answer["euler_312"][:, 2]), _spin_angle),
        (bool(np.any(answer["velocity"])) and changes(answer["position"]), split("position", "x", "m", "Position, inertial axes"))]
    maps = [partial(_axis_map, given=given), *([partial(_velocity_map, given=given)] if moved else [])]
    return laid_out(answer, maps, [panel for shown, panel in panels if shown])


def remarks(answer: "Answer", given: Mapping[str, Any]) -> list[str]:
    """For the title."""
    made = [f"greatest tilt {_degrees(answer.scalars['tilt_max'])}"]
    lean = answer.scalars["pointing_error"]
    if lean is not None and lean < TUMBLING and not answer.scalars["tilt_max"] > TUMBLING:
        made.append(f"lean under the torque {_degrees(lean)}")
        if (start := start_lean(given)) > lean:
            made[-1] += f" (without that of the start, {_degrees(start)})"
    if answer.scalars["nutation_frequency_squared"] <= 0:
        made.append("unstable spin")
    return [", ".join(made)]


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.3g} deg"


def _map(axes: "Axes", name: str, path: NDArray[Any], colour: str) -> None:
    """First two components of directions (n, 3), from a dot on."""
    curve(axes, path[:, 0], path[:, 1], [name], [colour], linewidth=0.8 if len(path) < 2000 else 0.4)
    axes.plot(path[:1, 0], path[:1, 1], color=colour, marker="o", markersize=4, linestyle="none")


def _mark(axes: "Axes", name: str, x: float, y: float) -> None:
    if math.isfinite(x) and math.isfinite(y):
        axes.plot([x], [y], color="black", marker="+", markersize=11, markeredgewidth=1.4, linestyle="none", label=name)


def _finish_map(axes: "Axes", title: str, path: NDArray[Any]) -> None:
    """The path is what shall be seen whole."""
    low, high = path[:, :2].min(axis=0), path[:, :2].max(axis=0)
    half = 0.58 * float(np.max(high - low))
    if half <= 1e-12 * float(np.max(np.abs(path[:, :2]))):  # a point, but for rounding: then with all others
        drawn = np.concatenate([path[:1, :2], *(line.get_xydata() for line in axes.lines)])
        low, high = drawn.min(axis=0), drawn.max(axis=0)
        half = max(0.58 * float(np.max(high - low)), 1e-3)
    x, y = (low + high) / 2
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(y - half, y + half)
    axes.set_aspect("equal")
    axes.grid(alpha=0.3)
    axes.ticklabel_format(style="sci", scilimits=(-2, 2))
    axes.set_xlabel("direction cosine, inertial axis 1")
    axes.set_ylabel("direction cosine, inertial axis 2")
    legend_beside(axes)
    axes.set_title(title, loc="left", fontsize=10)


def _axis_map(axes: "Axes", answer: "Answer", given: Mapping[str, Any]) -> None:
    R = matrix_from_quaternion(answer["attitude"])
    G = answer["angular_momentum_inertial"]
    size = np.linalg.norm(G, axis=1, keepdims=True)
    _map(axes, "body axis 3", R[:, :, 2], COLOURS[0])
    if np.all(size > 0):
        _map(axes, "angular\nmomentum", G / size, COLOURS[4])
    if answer.scalars["pointing_error"] is not None and math.isfinite(answer.scalars["pointing_error"]):
        mean = -1j * pointing(**{name: given[name] for name in (
            "inertia", "torque", "angular_velocity", "rotor_momentum", "charge_momentum", "euler_312")}).mean_tilt
        if abs(mean) < 1:
            _mark(axes, "mean of the\nlinear motion", float(np.real(mean)), float(np.imag(mean)))
    _finish_map(axes, "Axis 3, momentum", R[:, :, 2])
    note(axes, error_text(answer, "attitude", "angular_momentum_inertial"))


def _velocity_map(axes: "Axes", answer: "Answer", given: Mapping[str, Any]) -> None:
    gained = answer["velocity"] - given["velocity"]
    size = np.linalg.norm(gained, axis=1, keepdims=True)
    moving = size[:, 0] > 0
    direction = gained[moving] / size[moving]
    _map(axes, "velocity\ngained", direction, COLOURS[2])
    x, y = answer.scalars["secular_velocity_ratio"]
    if math.hypot(x, y) < 1:
        _mark(axes, "limit of the\nlinear motion", x / math.sqrt(1 + x * x + y * y), y / math.sqrt(1 + x * x + y * y))
    _finish_map(axes, "Velocity gained", direction)
    note(axes, error_text(answer, "velocity"))


def _angles(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    angles = np.degrees(answer["euler_312"][:, :2])
    angles[1:][np.abs(np.diff(angles, axis=0)) > 180] = np.nan  # from 180 to -180
    curve(axes, t, angles, ["psi", "phi"])
    axes.set_ylabel("psi, phi [deg]")
    legend_row(axes)
    axes.set_title("Tilt of axis 3, body axes", loc="left", fontsize=10)
    note(axes, error_text(answer, "euler_312"))


def _spin_angle(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    curve(axes, t, answer["euler_312"][:, 2] / (2 * np.pi), ["_theta"], coarse=False)
    axes.set_ylabel("theta [turns]")
    axes.set_title("Spin angle", loc="left", fontsize=10)
