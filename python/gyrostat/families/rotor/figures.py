# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a driven rotor: rates of rotor and carrier, the direction of the momentum and its angle to the rotor's axis, and the Lyapunov
function."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import COLOURS, Panel, components, curve, error_text, legend_row, note, span_text, stacked, vector
from gyrostat.families.rotor.functions import steady_rotations

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["figure", "remarks"]


def figure(answer: "Answer", given: Mapping[str, Any]) -> "Figure":
    """Panels over time; of a body at rest the attitude in place of the momentum."""
    turning = bool(np.all(np.linalg.norm(answer["angular_momentum"], axis=1) > 0))
    about: list[Panel] = [_direction, _cone(given)] if turning else [vector("attitude", "q", "", "Attitude, body to inertial")]
    return stacked(answer, [_rotor_rate(given), vector("angular_velocity", "Ω", "rad/s", "Angular velocity of the carrier, body axes"), *about,
                            _lyapunov(given)])


def remarks(answer: "Answer", _: Mapping[str, Any]) -> list[str]:
    """For the title."""
    attractor, rate = answer.scalars["attractor"], answer.scalars["decay_rate"]
    if attractor is None:
        return ["no attractor certified"]
    return [f"tends to steady rotation {attractor}" + (f", in the end as exp(-t / {span_text(1 / rate)})" if rate is not None and rate > 0 else "")]


def _rotor_rate(given: Mapping[str, Any]) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        target = given["no_load_rate"]
        curve(axes, t, answer["rotor_rate"], ["ω of the rotor"])
        axes.axhline(target, color=COLOURS[1], linestyle="--", linewidth=1, label=f"no-load rate {target:.6g} rad/s")
        axes.set_ylabel("ω [rad/s]")
        legend_row(axes)
        axes.set_title("Rate of the rotor, relative to the carrier", loc="left", fontsize=10)
        note(axes, error_text(answer, "rotor_rate"))

    return draw


def _direction(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    H = answer["angular_momentum"]
    components(axes, t, H / np.linalg.norm(H, axis=1, keepdims=True), "m", "", "Direction of the angular momentum, body axes")
    axes.set_ylim(-1.1, 1.6)
    axes.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    note(axes, error_text(answer, "angular_momentum"))


def _cone(given: Mapping[str, Any]) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        H, e = answer["angular_momentum"], given["axis"]
        angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(e, H), axis=1), H @ e))
        curve(axes, t, angle, ["_angle"])
        axes.set_ylim(0, max(1.1 * float(np.max(angle)), 1.0))
        axes.set_ylabel("angle [deg]")
        axes.set_title("Angle between the rotor's axis and the angular momentum", loc="left", fontsize=10)

    return draw


def _lyapunov(given: Mapping[str, Any]) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        V = answer["lyapunov"]
        curve(axes, t, V, ["V"])
        if np.min(V) > 0 and np.max(V) > 30 * np.min(V):
            axes.set_yscale("log")
        steady = steady_rotations(**{name: given[name] for name in ("inertia", "axis", "axial_inertia", "slope", "no_load_rate")},
                                  momentum=float(np.linalg.norm(answer["angular_momentum"][0])))
        saddles = steady.level[steady.type == "saddle"]
        if saddles.size and np.max(V) > np.min(saddles):
            axes.axhline(np.min(saddles), color=COLOURS[1], linestyle="--", linewidth=1, label="lowest saddle: below it the attractor is certain")
        legend_row(axes)
        axes.set_ylabel("V [J]")
        axes.set_title("Lyapunov function, which never grows", loc="left", fontsize=10)
        note(axes, error_text(answer, "lyapunov"))

    return draw
