# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a deceleration: |M| and energy, k2 with the regimes, and the vectors where the rung gives them."""

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import COLOURS, Panel, curve, error_text, goes_on, legend_row, mark_stop, note, span_text, stacked, time_unit, vector

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["figure", "remarks"]

REGIMES: Final = {
    "A": ("#56B4E9", "A: about the axis of largest inertia"),
    "C": ("#E69F00", "C: about the axis of smallest inertia"),
    "1": ("#009E73", "1: one component"),
    "point": ("#999999", "steady rotation"),
    "separatrix": ("#D55E00", "separatrix"),
    "rest": ("#444444", "at rest"),
}
VECTORS: Final = (("angular_momentum", "M", "N m s", "Total angular momentum, body axes"),
                  ("angular_velocity", "ω", "rad/s", "Angular velocity, body axes"),
                  ("attitude", "q", "", "Attitude, body to inertial"))


def figure(answer: "Answer", _: Mapping[str, Any]) -> "Figure":
    """Panels over time; the stop is marked in all of them, beyond the last time by an arrow below."""
    panels: list[Panel] = []
    if "angular_momentum_norm" in answer.columns:
        panels.append(_size_and_energy)
    if "modulus_squared" in answer.columns or "regime" in answer.columns:
        panels.append(_modulus)
    panels += [vector(*each) for each in VECTORS if each[0] in answer.columns]
    made = stacked(answer, panels)
    mark_stop(made, answer, len(panels))
    return made


def remarks(answer: "Answer", _: Mapping[str, Any]) -> list[str]:
    """For the title."""
    stop = answer.scalars.get("stop_time")
    if stop is None or not math.isfinite(stop):
        return []
    when = f"{stop:.6g} s" + (f" ({span_text(stop)})" if time_unit(stop)[1] != "s" else "")
    return [f"total momentum is 0 at {when}, and the rotors keep the body turning" if goes_on(answer) else f"stops at {when}"]


def _size_and_energy(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    curve(axes, t, answer["angular_momentum_norm"], ["|M|"])
    axes.set_ylabel("|M| [N m s]", color=COLOURS[0])
    axes.set_ylim(bottom=0)
    others = []
    if "energy" in answer.columns:
        right = axes.twinx()
        ring: dict[str, Any] = {"marker": "s", "markersize": 8, "fillstyle": "none"} if len(t) < 4 else {}  # round the dots of |M|
        curve(right, t, answer["energy"], ["carrier energy h"], COLOURS[1:], linestyle="--", **ring)
        right.set_ylabel("h [J]", color=COLOURS[1])
        right.set_ylim(bottom=0)
        others.append(right)
    legend_row(axes, *others)
    axes.set_title("Angular momentum and energy", loc="left", fontsize=10)
    note(axes, error_text(answer, "angular_momentum_norm", "energy"))


def _runs(names: NDArray[Any]) -> Iterator[tuple[str, int, int]]:
    """Stretches of one regime as (name, first index, last index)."""
    start = 0
    for i in range(1, len(names) + 1):
        if i == len(names) or names[i] != names[start]:
            yield str(names[start]), start, i - 1
            start = i


def _modulus(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
    if "modulus_squared" in answer.columns:
        k2 = np.array(answer["modulus_squared"], dtype=float)
        if "regime" in answer.columns:
            k2[answer["regime"] == "rest"] = np.nan  # without momentum it is on no orbit
        curve(axes, t, k2, ["_k2"], ["black"], coarse=False)
        note(axes, error_text(answer, "modulus_squared"))
    if "regime" in answer.columns:
        named = set()
        stop, end = (answer.scalars.get("stop_time") or math.nan) / time_unit(float(answer.t[-1]))[0], t[0]
        for name, first, last in _runs(answer["regime"]):
            begin, end = end, t[min(last + 1, len(t) - 1)]
            if t[last] < stop < end:  # it changes there, and not at the next time
                end = stop
            if name == "rest" and goes_on(answer):
                continue
            colour, meaning = REGIMES.get(name, ("#CCCCCC", name))
            axes.axvspan(begin, end, color=colour, alpha=0.25, linewidth=0, label=None if name in named else meaning)
            named.add(name)
        axes.legend(loc="upper right", fontsize=8, ncols=max(1, len(named)), borderaxespad=0.2)
    axes.set_ylim(-0.04, 1.32)
    axes.set_yticks([0.0, 0.25, 0.5, 0.75, 1.0])
    axes.set_ylabel("k² [1]")
    axes.set_title("Squared modulus and regime of the orbit", loc="left", fontsize=10)
