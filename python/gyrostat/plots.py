# SPDX-License-Identifier: BSD-3-Clause
"""Figures of answers and charts. Needs matplotlib."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import rotation, rotor, spinning
from gyrostat.answer import Answer
from gyrostat.errors import DomainError
from gyrostat.scenes import scene_from

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gyrostat.charts import Chart

__all__ = ["plot_answer", "plot_chart", "save"]

COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D31")
REGIMES: Final = {
    "A": ("#56B4E9", "A: about the axis of largest inertia"),
    "C": ("#E69F00", "C: about the axis of smallest inertia"),
    "1": ("#009E73", "1: one component"),
    "point": ("#999999", "steady rotation"),
    "separatrix": ("#D55E00", "separatrix"),
    "rest": ("#444444", "at rest"),
}
TIME_UNITS: Final = ((1.0, "s"), (3600.0, "h"), (86400.0, "days"), (31557600.0, "years"))


def _figure(width: float, height: float) -> "Figure":
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("matplotlib is not installed: pip install 'gyrostat[cli]'") from error
    return Figure(figsize=(width, height), layout="constrained")


def save(figure: "Figure", file: Path) -> None:
    """Write a figure in the format of the file's ending."""
    known = figure.canvas.get_supported_filetypes()
    if file.suffix[1:].lower() not in known:
        raise DomainError(f"plot file {file}: unknown ending {file.suffix or '(none)'!r}; use one of {', '.join(sorted(known))}")
    figure.savefig(file, dpi=150)


def _time_unit(span: float) -> tuple[float, str]:
    return next((pair for pair in reversed(TIME_UNITS) if span >= 4 * pair[0]), TIME_UNITS[0])


def _span(seconds: float) -> str:
    """A time for reading."""
    scale, unit = _time_unit(seconds)
    return f"{seconds / scale:.3g} {unit}"


def _error_text(answer: Answer, *columns: str) -> str:
    parts = [f"{answer.error[c]:.1e}" for c in columns if c in answer.error and math.isfinite(answer.error[c])]
    return "estimated error " + ", ".join(parts) if parts else "no error estimate"


def _note(axes: "Axes", text: str) -> None:
    axes.set_title(text, loc="right", fontsize=8, color="#555555")


def _runs(names: NDArray[Any]) -> Iterator[tuple[str, int, int]]:
    """Stretches of one regime as (name, first index, last index)."""
    start = 0
    for i in range(1, len(names) + 1):
        if i == len(names) or names[i] != names[start]:
            yield str(names[start]), start, i - 1
            start = i


def _size_and_energy(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    axes.plot(t, answer["angular_momentum_norm"], color=COLOURS[0], label="|M|")
    axes.set_ylabel("|M| [N m s]", color=COLOURS[0])
    axes.set_ylim(bottom=0)
    lines = list(axes.lines)
    if "energy" in answer.columns:
        right = axes.twinx()
        right.plot(t, answer["energy"], color=COLOURS[1], linestyle="--", label="carrier energy h")
        right.set_ylabel("h [J]", color=COLOURS[1])
        right.set_ylim(bottom=0)
        lines += right.lines
    axes.legend(lines, [str(line.get_label()) for line in lines], loc="best", fontsize=8)
    axes.set_title("Angular momentum and energy", loc="left", fontsize=10)
    _note(axes, _error_text(answer, "angular_momentum_norm", "energy"))


def _modulus(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    if "modulus_squared" in answer.columns:
        k2 = np.array(answer["modulus_squared"], dtype=float)
        if "regime" in answer.columns:
            k2[answer["regime"] == "rest"] = np.nan  # a body at rest is on no orbit
        axes.plot(t, k2, color="black", linewidth=1.4)
        _note(axes, _error_text(answer, "modulus_squared"))
    if "regime" in answer.columns:
        named = set()
        for name, first, last in _runs(answer["regime"]):
            colour, meaning = REGIMES.get(name, ("#CCCCCC", name))
            end = t[min(last + 1, len(t) - 1)]
            axes.axvspan(t[first], end, color=colour, alpha=0.25, linewidth=0, label=None if name in named else meaning)
            named.add(name)
        axes.legend(loc="best", fontsize=8)
    axes.set_ylim(-0.03, 1.03)
    axes.set_ylabel("k² [1]")
    axes.set_title("Squared modulus and regime of the orbit", loc="left", fontsize=10)


def _coarse(values: NDArray[Any]) -> bool:
    """Samples (n, k) that are less than a few a turn and draw no curve."""
    if len(values) < 4:
        return False
    moving = values[:, np.ptp(values, axis=0) > 1e-6 * np.max(np.abs(values), initial=0.0)]
    crossings = np.abs(np.diff(np.sign(values), axis=0)) > 0
    turns = np.diff(np.sign(np.diff(moving, axis=0)), axis=0) != 0
    return bool(np.mean(crossings) > 0.2 or (turns.size and np.mean(turns) > 0.4))


def _legend_row(axes: "Axes", *others: "Axes", markerscale: float = 1) -> None:
    """One row of names over the curves, for which room is made; of axes that share a frame."""
    for each in (axes, *others):
        low, high = each.get_ylim()
        each.set_ylim(low, high + 0.2 * (high - low))
    lines = [line for each in (axes, *others) for line in each.lines]
    axes.legend(lines, [str(line.get_label()) for line in lines], loc="upper right", fontsize=8, ncols=len(lines), markerscale=markerscale)


def _components(axes: "Axes", t: NDArray[Any], values: NDArray[Any], symbol: str, unit: str, title: str) -> None:
    names = "xyzw"[: values.shape[1]]
    coarse = _coarse(values)
    for i, name in enumerate(names):
        axes.plot(t, values[:, i], color=COLOURS[i], label=f"{symbol}{name}", linewidth=0.9,
                  linestyle="none" if coarse else "-", marker="." if coarse else "", markersize=2)
    axes.set_ylabel(f"{symbol} [{unit}]" if unit else symbol)
    _legend_row(axes, markerscale=4 if coarse else 1)
    axes.set_title(title, loc="left", fontsize=10)


def _vector(axes: "Axes", answer: Answer, t: NDArray[Any], column: str, symbol: str, unit: str, title: str) -> None:
    _components(axes, t, answer[column], symbol, unit, title)
    _note(axes, _error_text(answer, column))


def _rotor_rate(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    target = float(answer.scene["motor"]["no_load_rate"])
    axes.plot(t, answer["rotor_rate"], color=COLOURS[0], label="ω of the rotor")
    axes.axhline(target, color=COLOURS[1], linestyle="--", linewidth=1, label=f"no-load rate {target:.6g} rad/s")
    axes.set_ylabel("ω [rad/s]")
    axes.legend(loc="best", fontsize=8)
    axes.set_title("Rate of the rotor, relative to the carrier", loc="left", fontsize=10)
    _note(axes, _error_text(answer, "rotor_rate"))


def _direction(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    H = answer["angular_momentum"]
    _components(axes, t, H / np.linalg.norm(H, axis=1, keepdims=True), "m", "", "Direction of the angular momentum, body axes")
    axes.set_ylim(-1.05, 1.05)
    _note(axes, _error_text(answer, "angular_momentum"))


def _cone(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    H, e = answer["angular_momentum"], np.asarray(answer.scene["rotor"]["axis"])
    angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(e, H), axis=1), H @ e))
    coarse = _coarse(angle[:, None])
    axes.plot(t, angle, color=COLOURS[0], linewidth=0.9, linestyle="none" if coarse else "-", marker="." if coarse else "", markersize=2)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("angle [deg]")
    axes.set_title("Angle between the rotor's axis and the angular momentum", loc="left", fontsize=10)


def _lyapunov(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    V = answer["lyapunov"]
    axes.plot(t, V, color=COLOURS[0], label="V")
    if np.min(V) > 0 and np.max(V) > 30 * np.min(V):
        axes.set_yscale("log")
    given = rotor.arguments(scene_from(answer.scene))
    steady = rotor.steady_rotations(
        **{name: given[name] for name in ("inertia", "axis", "axial_inertia", "slope", "no_load_rate")},
        momentum=float(np.linalg.norm(answer["angular_momentum"][0])))
    saddles = steady.level[steady.type == "saddle"]
    if saddles.size and np.max(V) > np.min(saddles):
        axes.axhline(np.min(saddles), color=COLOURS[1], linestyle="--", linewidth=1, label="lowest saddle: below it the attractor is certain")
    axes.legend(loc="best", fontsize=8)
    axes.set_ylabel("V [J]")
    axes.set_title("Lyapunov function, which never grows", loc="left", fontsize=10)
    _note(axes, _error_text(answer, "lyapunov"))


def _rotor_panels(answer: Answer) -> list[Any]:
    def velocity(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
        _vector(axes, answer, t, "angular_velocity", "Ω", "rad/s", "Angular velocity of the carrier, body axes")

    def attitude(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
        _vector(axes, answer, t, "attitude", "q", "", "Attitude, body to inertial")

    turning = bool(np.all(np.linalg.norm(answer["angular_momentum"], axis=1) > 0))
    return [_rotor_rate, velocity, *([_direction, _cone] if turning else [attitude]), _lyapunov]


def _deceleration_panels(answer: Answer) -> list[Any]:
    panels: list[Any] = []
    if "angular_momentum_norm" in answer.columns:
        panels.append(_size_and_energy)
    if "modulus_squared" in answer.columns or "regime" in answer.columns:
        panels.append(_modulus)
    for column, symbol, unit, title in (
        ("angular_momentum", "M", "N m s", "Total angular momentum, body axes"),
        ("angular_velocity", "ω", "rad/s", "Angular velocity, body axes"),
        ("attitude", "q", "", "Attitude, body to inertial"),
    ):
        if column in answer.columns:
            panels.append(lambda axes, answer, t, rest=(column, symbol, unit, title): _vector(axes, answer, t, *rest))
    return panels


def _map(axes: "Axes", name: str, path: NDArray[Any], colour: str) -> None:
    """First two components of directions (n, 3), from a dot on."""
    coarse = _coarse(path[:, :2])
    axes.plot(path[:, 0], path[:, 1], color=colour, linewidth=0.8 if len(path) < 2000 else 0.4, linestyle="none" if coarse else "-",
              marker="." if coarse else "", markersize=2, label=name)
    axes.plot(path[:1, 0], path[:1, 1], color=colour, marker="o", markersize=4, linestyle="none")


def _mark(axes: "Axes", name: str, x: float, y: float) -> None:
    if math.isfinite(x) and math.isfinite(y):
        axes.plot([x], [y], color="black", marker="+", markersize=11, markeredgewidth=1.4, linestyle="none", label=name)


def _finish_map(axes: "Axes", title: str, path: NDArray[Any]) -> None:
    """The path is what shall be seen whole."""
    low, high = path[:, :2].min(axis=0), path[:, :2].max(axis=0)
    half = 0.58 * float(np.max(high - low)) or 1e-3
    x, y = (low + high) / 2
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(y - half, y + half)
    axes.set_aspect("equal")
    axes.ticklabel_format(style="sci", scilimits=(-2, 2))
    axes.set_xlabel("direction cosine, inertial axis 1")
    axes.set_ylabel("direction cosine, inertial axis 2")
    axes.legend(loc="best", fontsize=8)
    axes.set_title(title, loc="left", fontsize=10)


def _axis_map(axes: "Axes", answer: Answer) -> None:
    given = spinning.arguments(scene_from(answer.scene))
    R = rotation.matrix_from_quaternion(answer["attitude"])
    G = answer["angular_momentum_inertial"]
    size = np.linalg.norm(G, axis=1, keepdims=True)
    _map(axes, "body axis 3", R[:, :, 2], COLOURS[0])
    if np.all(size > 0):
        _map(axes, "angular momentum", G / size, COLOURS[4])
    if math.isfinite(answer.scalars["pointing_error"]):
        mean = -1j * spinning.pointing(**{name: given[name] for name in (
            "inertia", "torque", "angular_velocity", "rotor_momentum", "charge_momentum", "euler_312")}).mean_tilt
        if abs(mean) < 1:
            _mark(axes, "mean of the linear motion", float(np.real(mean)), float(np.imag(mean)))
    _finish_map(axes, "Axis 3 and momentum", R[:, :, 2])
    _note(axes, _error_text(answer, "attitude", "angular_momentum_inertial"))


def _velocity_map(axes: "Axes", answer: Answer) -> None:
    gained = answer["velocity"] - np.array(answer.scene["initial"]["velocity"])
    size = np.linalg.norm(gained, axis=1, keepdims=True)
    moving = size[:, 0] > 0
    direction = gained[moving] / size[moving]
    _map(axes, "velocity gained", direction, COLOURS[2])
    x, y = answer.scalars["secular_velocity_ratio"]
    if math.hypot(x, y) < 1:
        _mark(axes, "limit of the linear motion", x / math.sqrt(1 + x * x + y * y), y / math.sqrt(1 + x * x + y * y))
    _finish_map(axes, "Velocity gained", direction)
    _note(axes, _error_text(answer, "velocity"))


def _pair(axes: "Axes", answer: Answer, t: NDArray[Any], column: str, symbol: str, unit: str, title: str) -> None:
    """Components 1 and 2, and 3 on an axis of its own."""
    values = answer[column]
    coarse = _coarse(values[:, :2])
    for i in (0, 1):
        axes.plot(t, values[:, i], color=COLOURS[i], label=f"{symbol}{i + 1}", linewidth=0.9, linestyle="none" if coarse else "-",
                  marker="." if coarse else "", markersize=2)
    axes.set_ylabel(f"{symbol}1, {symbol}2 [{unit}]")
    right = axes.twinx()
    right.plot(t, values[:, 2], color=COLOURS[2], linestyle="--", linewidth=1, label=f"{symbol}3")
    right.set_ylabel(f"{symbol}3 [{unit}]", color=COLOURS[2])
    _legend_row(axes, right, markerscale=4 if coarse else 1)
    axes.set_title(title, loc="left", fontsize=10)
    _note(axes, _error_text(answer, column))


def _angles(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    values = np.degrees(answer["euler_312"][:, :2])
    coarse = _coarse(values)
    for i, name in enumerate(("psi", "phi")):
        axes.plot(t, values[:, i], color=COLOURS[i], label=name, linewidth=0.9, linestyle="none" if coarse else "-",
                  marker="." if coarse else "", markersize=2)
    axes.set_ylabel("psi, phi [deg]")
    axes.legend(loc="best", fontsize=8, markerscale=4 if coarse else 1)
    axes.set_title("Tilt of axis 3, body axes", loc="left", fontsize=10)
    _note(axes, _error_text(answer, "euler_312"))


def _plot_spinning(answer: Answer) -> "Figure":
    figure = _figure(11, 13)
    scale, unit = _time_unit(float(answer.t[-1] - answer.t[0]))
    t = answer.t / scale
    grid = figure.subplots(4, 2, height_ratios=(1.9, 1, 1, 1))
    _axis_map(grid[0, 0], answer)
    moved = bool(np.any(answer["velocity"] != np.array(answer.scene["initial"]["velocity"])))
    if moved:
        _velocity_map(grid[0, 1], answer)
    else:
        grid[0, 1].set_axis_off()
    _pair(grid[1, 0], answer, t, "angular_velocity", "ω", "rad/s", "Angular velocity, body axes")
    _angles(grid[1, 1], answer, t)
    _pair(grid[2, 0], answer, t, "angular_momentum_inertial", "G", "N m s", "Angular momentum, inertial axes")
    _pair(grid[2, 1], answer, t, "velocity", "v", "m/s", "Velocity, inertial axes")
    theta = answer["euler_312"][:, 2]
    grid[3, 0].plot(t, theta / (2 * np.pi), color=COLOURS[0])
    grid[3, 0].set_ylabel("theta [turns]")
    grid[3, 0].set_title("Spin angle", loc="left", fontsize=10)
    _pair(grid[3, 1], answer, t, "position", "x", "m", "Position, inertial axes")
    for axes in grid.flat:
        axes.grid(alpha=0.3)
    for axes in grid[3]:
        axes.set_xlabel(f"time [{unit}]")
    return figure


def _onto_map(sign: float, m: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Lambert's equal-area map of directions (..., 3) around axis 3 times `sign`: the hemisphere is the unit disc, its far end the rim's foot."""
    x, y, z = m[..., 0], sign * m[..., 1], sign * m[..., 2]
    across = np.hypot(x, y)
    size = np.where(z > 0, across / np.sqrt(1 + np.abs(z)), np.sqrt(1 + np.abs(z)))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(across > 0, x / across, 0.0) * size, np.where(across > 0, y / across, -1.0) * size


def _sphere_path(axes: "Axes", path: NDArray[Any], colour: str, names: tuple[str, str, str, str], title: str) -> tuple[float, float]:
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
    for direction, name in marks:
        u, v = map(float, _onto_map(sign, direction))
        if max(abs(u), abs(v)) <= reach:
            axes.plot([u], [v], marker="+", color="#777777", markersize=6, linestyle="none")
            axes.annotate(name, (u, v), xytext=(4, 3), textcoords="offset points", fontsize=8, color="#555555", zorder=5)
    jumps = np.concatenate([[False], np.hypot(np.diff(x), np.diff(y)) > 1.0])  # across the rim
    coarse = _coarse(path)
    axes.plot(np.where(jumps, np.nan, x), y, color=colour, linewidth=0.8 if len(path) < 2000 else 0.4, linestyle="none" if coarse else "-",
              marker="." if coarse else "", markersize=2)
    axes.plot(x[:1], y[:1], color=colour, marker="o", markersize=5, linestyle="none", label="start")
    axes.set_aspect("equal")
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.axis("off")
    axes.set_title(title, loc="left", fontsize=10)
    return sign, reach


def _heavy_sphere(axes: "Axes", answer: Answer) -> None:
    sign, reach = _sphere_path(axes, answer["down"], COLOURS[0], ("1", "2", "3", "−3"), "Down, body axes")
    centre = np.array(answer.scene["body"]["centre_of_mass"])
    size = float(np.linalg.norm(centre))
    if size > 0:
        u, v = map(float, _onto_map(sign, centre / size))
        if max(abs(u), abs(v)) <= reach:
            axes.plot([u], [v], marker="*", color=COLOURS[1], markersize=11, markeredgecolor="white", linestyle="none", label="mass centre")
    axes.legend(loc="lower right", fontsize=8)
    _note(axes, _error_text(answer, "down"))


def _hodograph(axes: "Axes", answer: Answer) -> None:
    w = answer["angular_velocity"]
    coarse = _coarse(w[:, :2])
    axes.plot(w[:, 0], w[:, 1], color=COLOURS[2], linewidth=0.8, linestyle="none" if coarse else "-", marker="." if coarse else "", markersize=2)
    axes.plot(w[:1, 0], w[:1, 1], color=COLOURS[2], marker="o", markersize=5, linestyle="none", label="start")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("ω1 [rad/s]")
    axes.set_ylabel("ω2 [rad/s]")
    axes.grid(alpha=0.3)
    axes.legend(loc="lower right", fontsize=8)
    axes.set_title("Angular velocity across axis 3", loc="left", fontsize=10)
    _note(axes, _error_text(answer, "angular_velocity"))


def _heavy_axis(axes: "Axes", answer: Answer) -> None:
    R = rotation.matrix_from_quaternion(answer["attitude"])
    _sphere_path(axes, R[:, :, 2], COLOURS[2], ("1", "2", "up", "down"), "Body axis 3, inertial axes")
    axes.legend(loc="lower right", fontsize=8)
    _note(axes, _error_text(answer, "attitude"))


def _line(axes: "Axes", t: NDArray[Any], values: NDArray[Any], colour: str, name: str) -> None:
    coarse = _coarse(values[:, None] - np.mean(values))
    axes.plot(t, values, color=colour, linewidth=0.9, linestyle="none" if coarse else "-", marker="." if coarse else "", markersize=2, label=name)


def _nutation(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    d = answer["down"]
    _line(axes, t, np.degrees(np.arctan2(np.hypot(d[:, 0], d[:, 1]), d[:, 2])), COLOURS[0], "")
    axes.set_ylabel("theta [deg]")
    axes.set_title("Nutation: angle of axis 3 to down", loc="left", fontsize=10)


def _precession(axes: "Axes", answer: Answer, t: NDArray[Any]) -> None:
    """The angle about down where the attitude tells it, else its rate."""
    mean = answer.scalars["precession_rate"]
    if "attitude" in answer.columns:
        R = rotation.matrix_from_quaternion(answer["attitude"])
        psi = np.unwrap(np.arctan2(R[:, 0, 2], R[:, 1, 2])) / (2 * np.pi)
        _line(axes, t, psi, COLOURS[2], "psi")
        if mean is not None:
            axes.plot(t, psi[0] + mean * (answer.t - answer.t[0]) / (2 * np.pi), color=COLOURS[1], linestyle="--", linewidth=1, label="mean")
        axes.set_ylabel("psi [turns]")
    else:
        d, w = answer["down"], answer["angular_velocity"]
        across = d[:, 0] ** 2 + d[:, 1] ** 2
        with np.errstate(divide="ignore", invalid="ignore"):
            rate = np.where(across > 1e-12, (w[:, 0] * d[:, 0] + w[:, 1] * d[:, 1]) / across, np.nan)
        _line(axes, t, rate, COLOURS[2], "psi'")
        if mean is not None:
            axes.axhline(mean, color=COLOURS[1], linestyle="--", linewidth=1, label="mean")
        axes.set_ylabel("psi' [rad/s]")
        low, high = np.nanquantile(rate, [0.02, 0.98]) if np.any(np.isfinite(rate)) else (0.0, 1.0)
        if np.nanmax(np.abs(rate), initial=0.0) > 10 * max(abs(low), abs(high)) > 0:  # near the vertical it has no bound
            room = 0.3 * (high - low)
            axes.set_ylim(low - room, high + room)
    _legend_row(axes)
    axes.set_title("Precession about down", loc="left", fontsize=10)


def _plot_heavy(answer: Answer) -> "Figure":
    figure = _figure(11, 11)
    scale, unit = _time_unit(float(answer.t[-1] - answer.t[0]))
    t = answer.t / scale
    grid = figure.subplots(3, 2, height_ratios=(2.1, 1, 1))
    _heavy_sphere(grid[0, 0], answer)
    if "attitude" in answer.columns:
        _heavy_axis(grid[0, 1], answer)
    else:
        _hodograph(grid[0, 1], answer)
    _pair(grid[1, 0], answer, t, "angular_velocity", "ω", "rad/s", "Angular velocity, body axes")
    _vector(grid[1, 1], answer, t, "down", "d", "", "Down, body axes")
    _nutation(grid[2, 0], answer, t)
    _precession(grid[2, 1], answer, t)
    for axes in grid[1:].flat:
        axes.grid(alpha=0.3)
    for axes in grid[2]:
        axes.set_xlabel(f"time [{unit}]")
    return figure


# Kinds whose figure is more than panels over time.
FIGURES: Final = {"spinning": _plot_spinning, "heavy": _plot_heavy}
PANELS: Final = {"deceleration": _deceleration_panels, "rotor": _rotor_panels}


def _title(answer: Answer) -> str:
    verdict = "met" if answer.met else "NOT met"
    title = f"{answer.scene.get('name', '')}: rung {answer.model}, estimated error {answer.greatest_error:.1e}"
    title += f" (tolerance {answer.tolerance:g} {verdict})"
    stop = answer.scalars.get("stop_time")
    if stop is not None and np.isfinite(stop):
        title += f"\nstops at {stop:.6g} s"
    if "attractor" in answer.scalars:
        attractor, rate = answer.scalars["attractor"], answer.scalars["decay_rate"]
        title += "\nno attractor certified" if attractor is None else f"\ntends to steady rotation {attractor}"
        title += f", in the end as exp(-t / {_span(1 / rate)})" if attractor is not None and rate > 0 else ""
    if "tilt_max" in answer.scalars:
        told = [f"greatest tilt {_degrees(answer.scalars['tilt_max'])}"]
        if answer.scalars["pointing_error"] < 1:  # beyond, the linear motion tells nothing
            told.append(f"mean pointing error {_degrees(answer.scalars['pointing_error'])}")
        if answer.scalars["nutation_frequency_squared"] <= 0:
            told.append("unstable spin")
        title += "\n" + ", ".join(told)
    if answer.scalars.get("period") is not None:
        told = [f"period {answer.scalars['period']:.6g} s"]
        if answer.scalars["stable"] is not None:
            told.append("stable" if answer.scalars["stable"] else "unstable")
        if answer.scalars["precession_rate"] is not None:
            told.append(f"mean precession {answer.scalars['precession_rate']:.4g} rad/s")
        title += "\n" + ", ".join(told)
    return title


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.3g} deg"


def plot_answer(answer: Answer) -> "Figure":
    """What the answer holds, over time.

    Deceleration: |M| and energy, k2 with the regimes, and the vectors where the rung gives them. Rotor: rates of rotor and carrier,
    the angular momentum in body axes and its angle to the rotor's axis (at rest: the attitude), and the Lyapunov function. Spinning: the
    directions of axis 3, of the angular momentum and of the velocity gained with their means, and all columns over time. Heavy: the paths of
    down in the body and of axis 3 in space, rates, down, nutation and precession.
    """
    if answer.scene["kind"] in FIGURES:
        figure = FIGURES[answer.scene["kind"]](answer)
        figure.suptitle(_title(answer), fontsize=11)
        return figure
    panels = PANELS[answer.scene["kind"]](answer)
    figure = _figure(9, 1.0 + 2.2 * len(panels))
    scale, unit = _time_unit(float(answer.t[-1] - answer.t[0]))
    t = answer.t / scale
    stop = answer.scalars.get("stop_time")
    all_axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(all_axes, panels, strict=True):
        panel(axes, answer, t)
        axes.grid(alpha=0.3)
        if stop is not None and np.isfinite(stop) and t[0] <= stop / scale <= t[-1]:
            axes.axvline(stop / scale, color="#555555", linestyle=":", linewidth=1)
    all_axes[-1].set_xlabel(f"time [{unit}]")
    figure.suptitle(_title(answer), fontsize=11)
    return figure


CHART_STYLE: Final = {  # group -> marker, size, dashes
    "rung": ("*", 14, "-"), "taylor": ("o", 5, "-"), "radau": ("h", 6, "-"), "dop853": ("v", 6, "-"),
    "cvode": ("s", 5, "--"), "rival": ("D", 5, ":"),
}
RUNG_MARKERS: Final = {"rung equal-torque": "P", "rung averaged": "^", "rung averaged-2": "X", "rung closed-form": "P",
                       "rung linear-tail": "^", "rung linear": "P", "rung second-order": "^", "rung picard": "X", "rung exact": "P",
                       "rung series-2": "^", "rung series": "X", "rung full": "*"}
CHART_FLOOR: Final = 1e-17  # an error of zero is drawn here


def plot_chart(chart: "Chart") -> "Figure":
    """True error against time per solution, on log axes: a panel for each of the two errors."""
    figure = _figure(14, 6.5)
    left, right, key = figure.subplots(1, 3, width_ratios=(1, 1, 0.42))
    key.axis("off")
    right.sharex(left)
    right.sharey(left)
    handles: dict[str, Any] = {}
    for axes, measure in zip((left, right), chart.measures, strict=True):
        for colour, (label, points) in zip(_colours(), chart.by_label().items(), strict=False):
            shown = [(p.seconds, max(p.error[measure.key], CHART_FLOOR)) for p in points
                     if math.isfinite(p.error.get(measure.key, math.nan))]
            if not shown:
                continue
            x, y = zip(*shown, strict=True)
            rung = points[0].group == "rung"
            marker, size, dashes = CHART_STYLE[points[0].group]
            handles[label], = axes.loglog(
                x, y, marker=RUNG_MARKERS.get(label, marker), color=colour, linestyle=dashes if len(shown) > 1 else "none",
                markersize=size if not rung or label == "rung full" else 11, linewidth=1.1, label=label,
                markeredgecolor="black" if rung else colour, markeredgewidth=0.7, zorder=4 if rung else 2)
        axes.set_title(f"Error of {measure.title}", fontsize=10)
        axes.set_xlabel("time per solution [s]")
        axes.set_ylabel(measure.axis)
        axes.grid(alpha=0.35, which="major", linewidth=0.6)
        axes.grid(alpha=0.15, which="minor", linewidth=0.4)
    key.legend(handles.values(), handles.keys(), loc="upper left", fontsize=8, borderaxespad=0, title="median of repeats")
    figure.suptitle(f"{chart.name}: {chart.title}", fontsize=11)
    return figure


def _colours() -> Iterator[str]:
    while True:
        yield from COLOURS
