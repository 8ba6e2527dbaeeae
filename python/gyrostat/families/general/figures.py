# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a motion under any torques: the direction of the momentum in the body, the path of a body axis in space or in the axes of the orbit,
and what the answer holds over time, with the times at which a torque or a wheel changes its law."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.drawing import (
    COLOURS, MOMENT_NAMES, Panel, changes, components, error_text, is_coarse, laid_out, map_frame, map_legend, map_reach, note, on_map,
    principal_axes, span_text, vector, wheels_panel)
from gyrostat.fields import UNSET
from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.answer import Answer

__all__ = ["OF_ANY_COLUMNS", "figure", "remarks"]

Vectors = NDArray[np.float64]

# The figure is that of the columns that there are, whatever was asked.
OF_ANY_COLUMNS: Final = True
# So many breakpoints are marked one by one.
MOST_MARKS: Final = 40
# Neighbours on a map that are nearer than this are joined, about 15 degrees.
NEAR: Final = 0.25
# A body that turns by more than this between two times [rad] is shown by dots.
COARSE: Final = 1.5
ORBIT_AXES: Final = ((0, "along the orbit"), (2, "to the centre"))


def figure(answer: "Answer", given: Mapping[str, Any]) -> "Figure":
    """Maps of directions on top, columns over time below."""
    body = _body(given)
    maps = [draw for draw in (_momentum_map(body, answer), _axis_map(body, answer)) if draw]
    marks = _marks(given, float(answer.t[-1]))
    return laid_out(answer, maps, [_marked(panel, marks) for panel in _panels(answer, given)])


def remarks(answer: "Answer", _: Mapping[str, Any]) -> list[str]:
    """For the title."""
    found, stop = answer.scalars.get("recognised"), answer.scalars.get("stop_time")
    made = [f"an instance of {', '.join(found)}"] if found else []
    return made + ([f"stops at {span_text(stop)}"] if stop is not None and math.isfinite(stop) else [])


def _body(given: Mapping[str, Any]) -> dict[str, Any]:
    """Tensor, momentum and wheels as arrays."""
    inertia = np.asarray(given["inertia"], dtype=float)
    return {"inertia": np.diag(inertia) if inertia.ndim == 1 else inertia, "rotor_momentum": np.asarray(given["rotor_momentum"], dtype=float),
            "wheels": given["wheels"]}


def _has(answer: "Answer", column: str) -> bool:
    return column in answer.columns and bool(np.all(np.isfinite(answer[column])))


def _momentum(body: Mapping[str, Any], answer: "Answer") -> Vectors | None:
    """The total angular momentum in body axes, where the answer has it or what it follows from."""
    if _has(answer, "angular_momentum"):
        return answer["angular_momentum"]
    if not _has(answer, "angular_velocity") or (body["wheels"] and not _has(answer, "rotor_rate")):
        return None
    made: Vectors = answer["angular_velocity"] @ body["inertia"] + body["rotor_momentum"]
    for i, wheel in enumerate(body["wheels"]):
        axis = np.asarray(wheel["axis"], dtype=float)
        made = made + (wheel.get("axial_inertia") or 0.0) * answer["rotor_rate"][:, i:i + 1] * (axis / np.linalg.norm(axis))
    return made


# ---- maps ----


def _sparse(answer: "Answer") -> bool:
    """The times are so far apart that what turns with the body cannot be followed from one to the next."""
    speed = np.linalg.norm(answer["angular_velocity"], axis=1) if _has(answer, "angular_velocity") else np.zeros(len(answer.t))
    return bool(np.max(speed * np.diff(answer.t, prepend=answer.t[0])) > COARSE)


def _trace(axes: "Axes", directions: Vectors, centre: Vectors, colour: str, label: str, sparse: bool) -> Vectors:
    """Dots at directions (n, 3) on the map around `centre`, those that are near each other joined by lines; where they are on it."""
    points = on_map(directions, centre)
    far = (np.linalg.norm(np.diff(points, axis=0), axis=1) > NEAR) | sparse
    joined = np.insert(points, np.flatnonzero(far) + 1, np.nan, axis=0)
    axes.plot(joined[:, 0], joined[:, 1], "-", color=colour, linewidth=0.9, marker="." if np.any(far) else None, markersize=2, label=label)
    return points


def _path(axes: "Axes", directions: Vectors, centre: Vectors, title: str, colour: str, label: str, sparse: bool) -> float:
    """The path of a direction (n, 3) on a map around `centre` that is as large as the path; how far that is [deg]."""
    reach = map_reach(on_map(directions, centre))
    map_frame(axes, title, reach)
    points = _trace(axes, directions, centre, colour, label, sparse)
    axes.plot(*points[0], "o", color=COLOURS[2], markersize=5, label="start")
    if len(points) > 1:
        axes.plot(*points[-1], "s", color=COLOURS[1], markersize=4, label="end")
    return reach


def _middle(directions: Vectors) -> Vectors:
    """A direction in the middle of others."""
    mean = directions.mean(0)
    size = float(np.linalg.norm(mean))
    made: Vectors = mean / size if size > 0.05 else directions[0]
    return made


def _momentum_map(body: Mapping[str, Any], answer: "Answer") -> Callable[["Axes", "Answer"], None] | None:
    """The direction of the momentum in the body; principal axes marked."""
    M = _momentum(body, answer)
    if M is None:
        return None
    size = np.linalg.norm(M, axis=1)
    held = size > 1e-9 * np.max(size)  # of no momentum there is no direction
    if np.count_nonzero(held) < 2:
        return None
    n, sparse = M[held] / size[held, None], _sparse(answer)

    def draw(axes: "Axes", _: "Answer") -> None:
        centre = _middle(n)
        kept = "" if changes(size) else ", which keeps its size"
        reach = _path(axes, n, centre, f"Direction of the momentum in the body{kept}", COLOURS[0], "momentum", sparse)
        if reach >= 120:
            for which, axis in enumerate(principal_axes(body["inertia"])[1].T):
                points = on_map(np.stack([axis, -axis]), centre)
                axes.plot(points[:, 0], points[:, 1], "x", color="#555555", markersize=5, label="_")
                for x, y in points:
                    axes.annotate(MOMENT_NAMES[which], (x, y), xytext=(3, 3), textcoords="offset points", fontsize=7, color="#555555")
        map_legend(axes)

    return draw


def _axis_map(body: Mapping[str, Any], answer: "Answer") -> Callable[["Axes", "Answer"], None] | None:
    """The path of a principal axis in the axes of the orbit, or in space."""
    column = next((name for name in ("attitude_orbit", "attitude") if _has(answer, name)), None)
    if column is None:
        return None
    _, principal = principal_axes(body["inertia"])
    which, M = 0, _momentum(body, answer)
    if column == "attitude" and M is not None and np.any(M):
        # the one that the momentum stays nearest to
        which = int(np.argmax(np.mean(np.abs(M @ principal), 0) / np.mean(np.linalg.norm(M, axis=1))))
    path = matrix_from_quaternion(answer[column]) @ principal[:, which]
    place = "in the axes of the orbit" if column == "attitude_orbit" else "in space"
    sparse = _sparse(answer)

    def draw(axes: "Axes", _: "Answer") -> None:
        centre = _middle(path)
        reach = _path(axes, path, centre, f"Path of a body axis {place}", COLOURS[3], f"axis of the {MOMENT_NAMES[which]} moment", sparse)
        if column == "attitude_orbit":
            for i, name in ORBIT_AXES:
                for sign, word in ((1.0, name), (-1.0, f"not {name}")):
                    at = on_map(sign * np.eye(3)[i:i + 1], centre)[0]
                    if math.hypot(*at) < 2 * math.sin(math.radians(min(reach, 90.0)) / 2):
                        axes.plot(*at, "+", color="#000000", markersize=8, label=word)
        elif M is not None:
            _momentum_in_space(axes, M, answer["attitude"], centre, reach)
        map_legend(axes)

    return draw


def _momentum_in_space(axes: "Axes", M: Vectors, attitude: Vectors, centre: Vectors, reach: float) -> None:
    """The direction of the momentum on the map of a body axis, where it is there at all times and lies in it."""
    size = np.linalg.norm(M, axis=1)
    if not np.min(size) > 1e-9 * np.max(size):
        return
    seen = np.einsum("nij,nj->ni", matrix_from_quaternion(attitude), M) / size[:, None]
    radius = np.max(np.linalg.norm(on_map(seen, centre), axis=1))
    if reach >= 120 or radius < 2 * math.sin(math.radians(reach) / 2):
        points = _trace(axes, seen, centre, "#000000", "momentum", False)
        axes.plot(*points[0], "+", color="#000000", markersize=8, label="_")


# ---- panels over time ----


def _attitude(column: str, title: str) -> Panel:
    """A quaternion, of whose two signs that is taken which goes on from the time before."""
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        q = np.asarray(answer[column], dtype=float)
        if _sparse(answer):
            components(axes, t, q, "q", "", title, coarse=True)
            note(axes, error_text(answer, column))
            return
        flips = np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0)
        components(axes, t, q * np.cumprod(np.concatenate([[1.0], flips]))[:, None], "q", "", title)
        note(axes, error_text(answer, column))

    return draw


def _euler(sequence: str) -> Panel:
    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        components(axes, t, np.degrees(answer["euler"]), "a", "deg", f"Angles of the attitude, {sequence}")
        note(axes, error_text(answer, "euler"))

    return draw


_VECTORS: Final[tuple[tuple[str, str, str, str], ...]] = (
    ("angular_velocity", "ω", "rad/s", "Angular velocity, body axes"), ("angular_momentum", "M", "N m s", "Angular momentum, body axes"),
    ("angular_momentum_inertial", "M", "N m s", "Angular momentum, inertial axes"), ("torque", "τ", "N m", "External torque, body axes"),
    ("down", "d", "", "Down, body axes"), ("velocity", "v", "m/s", "Velocity, inertial axes"), ("position", "x", "m", "Position, inertial axes"))
_SINGLES: Final = (("angular_momentum_norm", "|M|", "N m s", "Size of the angular momentum"), ("energy", "E", "J", "Energy"))
_ATTITUDES: Final = (("attitude_orbit", "Attitude, body to the axes of the orbit"), ("attitude", "Attitude, body to inertial"))
_WHEELS: Final = (("rotor_rate", "rate", "rad/s", "Rates of the wheels"), ("rotor_angle", "angle", "rad", "Angles of the wheels"))


def _panels(answer: "Answer", given: Mapping[str, Any]) -> list[Panel]:
    """One for each column, rates and attitude first; where the attitude in the axes of the orbit is there, that in space is left out."""
    names = [str(wheel.get("name") or place) for place, wheel in enumerate(given["wheels"], 1)]
    made: list[Panel] = [vector(*_VECTORS[0])] if "angular_velocity" in answer.columns else []
    made += [_attitude(column, title) for column, title in _ATTITUDES if column in answer.columns][:1]
    made += [_euler(given["euler"])] if "euler" in answer.columns else []
    made += [wheels_panel(*kind, names) for kind in _WHEELS if kind[0] in answer.columns]
    made += [_torque(kind, _jumps(given)) if kind[0] == "torque" else vector(*kind) for kind in _VECTORS[1:] if kind[0] in answer.columns]
    return made + [wheels_panel(*kind, [kind[1]]) for kind in _SINGLES if kind[0] in answer.columns]


def _jumps(given: Mapping[str, Any]) -> list[float]:
    """Times at which torques come, go or step [s]."""
    times: set[float] = set()
    for each in given["torques"]:
        on = each.get("on")
        times |= set() if on in (None, UNSET) else {float(t) for span in on for t in span}
        for table in (each.get("factor"), each.get("torque")):
            if isinstance(table, Mapping) and table.get("times") not in (None, UNSET):
                stepping = table["interpolation"] == "step"
                times |= {float(t) for t in (table["times"] if stepping else (table["times"][0], table["times"][-1]))}
    return sorted(times)


def _torque(kind: tuple[str, str, str, str], jumps: Sequence[float]) -> Panel:
    """The curves of the torque end where it jumps: nothing is drawn across."""
    column, symbol, unit, title = kind

    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        values = answer[column]
        cuts = np.unique(np.searchsorted(answer.t, jumps))
        cuts = cuts[(cuts > 0) & (cuts < len(t))]
        nothing = np.full((len(cuts), values.shape[1]), np.nan)
        components(axes, np.insert(t, cuts, t[cuts]), np.insert(values, cuts, nothing, axis=0), symbol, unit, title, coarse=is_coarse(values))
        alone = np.diff(np.concatenate([[0], cuts, [len(t)]])) == 1
        places = np.concatenate([[0], cuts])[alone]
        for each, colour in zip(values.T, COLOURS, strict=False):  # what is no line
            axes.plot(t[places], each[places], ".", color=colour, markersize=4, label="_alone")
        note(axes, error_text(answer, column))

    return draw


def _marks(given: Mapping[str, Any], end: float) -> tuple[list[float], list[tuple[float, float]]]:
    """Times of tables, and intervals in which a torque is on, from the start to the end [s]."""
    begin = given.get("start_time", 0.0)
    times: set[float] = set()
    spans: set[tuple[float, float]] = set()
    for each in (*given["wheels"], *given["torques"]):
        for table in (each, each.get("factor"), each.get("rate"), each.get("torque")):
            if isinstance(table, Mapping) and table.get("times") not in (None, UNSET):
                times |= {float(t) for t in table["times"]}
        on = each.get("on")
        spans |= {(float(a), float(b)) for a, b in (() if on in (None, UNSET) else on)}
    return sorted(t for t in times if begin < t < end), sorted((max(a, begin), min(b, end)) for a, b in spans if a < end and b > begin and a < b)


def _marked(panel: Panel, marks: tuple[list[float], list[tuple[float, float]]]) -> Panel:
    """The panel, with bands where a torque is on, and lines at times of tables."""
    times, spans = marks

    def draw(axes: "Axes", answer: "Answer", t: NDArray[Any]) -> None:
        panel(axes, answer, t)
        scale = float(answer.t[-1]) / t[-1] if len(t) and t[-1] else 1.0
        for a, b in spans if len(spans) <= MOST_MARKS else ():
            axes.axvspan(a / scale, b / scale, color="#E69F00", alpha=0.25, linewidth=0.6, label="_on")
        for time in times if len(times) <= MOST_MARKS else ():
            axes.axvline(time / scale, color="#999999", linewidth=0.8, linestyle=":", label="_table")

    return draw
