# SPDX-License-Identifier: BSD-3-Clause
"""A motion to look at: one HTML file that needs nothing else, with the body in space beside the path of its angular momentum in the body."""

import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from typing import Any, Final

import numpy as np

from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.asking import Ask
from gyrostat.broadcast import Floats
from gyrostat.drawing import MOMENT_NAMES, time_unit
from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES
from gyrostat.ladder import solve
from gyrostat.report import summary
from gyrostat.rotation import matrix_from_quaternion, quaternion_from_vector
from gyrostat.scenes import Scene
from gyrostat.writing import write_text

__all__ = ["View", "view"]

TURNS: Final = 30  # that are shown where no end is named
FRAMES: Final = 40  # a turn where there is room
FEWEST_FRAMES: Final = 6  # a turn, or the motion between them is not seen
LEAST: Final = 240  # frames in all
MOST: Final = 6000
PROBES: Final = 257  # times at which the speed is looked at before
STILL: Final = 1e-6  # turning by less [rad] is none
DOWN: Final = np.array([0.0, 0.0, -1.0])  # inertial axes of a heavy body
PLACE: Final = "{}  /* the motion */"  # in the page


@dataclass(frozen=True, eq=False)
class View:
    """A page (`html`), the answer that it shows, and `notes` on what was chosen for it. A notebook shows the page."""

    html: str
    answer: Answer
    notes: tuple[str, ...]

    def save(self, file: str | os.PathLike[str]) -> None:
        """Write the page to a file."""
        write_text(file, self.html)

    def __repr__(self) -> str:
        return f"<View of {self.answer!r}: save('view.html'), or show it in a notebook>"

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{escape(self.html)}" style="width: 100%; height: 680px; border: 0"></iframe>'


def view(scene: Scene, begin: float | None = None, end: float | None = None, monitor: Monitor | None = None) -> View:
    """The motion of a scene from `begin` to `end` [s]; by default from the start for some tens of turns, at most to the last time of the scene.

    It is solved anew, for attitude, angular velocity and momentum at times that make a smooth picture. Raises DomainError where nothing turns,
    where the rung that the scene names gives no attitude, and where the window has more turns than can be shown.
    """
    notes: list[str] = []
    posed = _with_attitude(scene, notes)
    times = _times(posed, scene.start_time if begin is None else begin, end, notes, monitor)
    columns: list[str] = [name for name in ("attitude", "angular_velocity", "angular_momentum", "angular_momentum_inertial") if name in FAMILIES[scene.kind].facts.columns]
    answer = _ask(posed, times, columns, monitor)
    notes.insert(0, f"Solved for this view: {', '.join(columns)} at {len(times)} times.")
    data = {**_data(posed, answer), "notes": notes, "time_unit": time_unit(float(times[-1] - times[0]))}
    page = files("gyrostat").joinpath("view.html").read_text(encoding="utf-8")
    return View(page.replace(PLACE, json.dumps(data, allow_nan=False).replace("<", "\\u003c")), answer, tuple(notes))


def _ask(scene: Scene, times: Floats, columns: list[str], monitor: Monitor | None) -> Answer:
    """The answer, with columns that are known at every time. Tolerances of their own stay those of the scene."""
    own = scene.tables["solve"]["ask"]
    given = own if isinstance(own, Mapping) else {}
    ask: Ask = {name: given.get(name, "default") for name in columns}
    answer = solve(scene, monitor=monitor, times=times.tolist(), ask=ask)
    for name in columns:
        if not np.all(np.isfinite(answer[name])):
            raise DomainError(f"{scene.name}: rung {answer.model} does not give {name}, which a view needs: leave model out, or name full")
    return answer


def _with_attitude(scene: Scene, notes: list[str]) -> Scene:
    """The scene with an attitude at the start."""
    start = scene.tables["initial"]
    if scene.kind == "deceleration" and start["attitude"] is None:
        notes.append("The scene gives no attitude: the body axes start along the inertial axes.")
        return scene.replace(**{"initial.attitude": [0.0, 0.0, 0.0, 1.0]})
    if scene.kind == "heavy" and start["attitude"] is None:
        notes.append("The scene gives the vertical alone: which way the body faces at the start is free.")
        first = _ask(scene, np.zeros(1), ["angular_velocity", "down"], None)
        down = first["down"][0] / np.linalg.norm(first["down"][0])
        across = np.cross(down, DOWN)
        size = float(np.linalg.norm(across))
        axis = across / size if size > 0 else np.array([1.0, 0.0, 0.0])
        attitude = quaternion_from_vector(math.atan2(size, float(down @ DOWN)) * axis)
        return scene.replace(**{"initial.angular_velocity": first["angular_velocity"][0].tolist(), "initial.attitude": attitude.tolist()})
    return scene


def _times(scene: Scene, begin: float, end: float | None, notes: list[str], monitor: Monitor | None) -> Floats:
    """Even times of the pictures: TURNS turns from `begin` where no end is named."""
    last = float(scene.times[-1]) if end is None else end
    if not scene.start_time <= begin < last < math.inf:
        of_scene = f"; the scene ends at {last:g} s" if end is None else ""
        raise DomainError(f"{scene.name}: there is nothing to see from {begin:g} s to {last:g} s: give an end after the begin, and a begin of at least "
                          f"{scene.start_time:g}{of_scene}")

    def turned(until: float) -> tuple[Floats, Floats, Floats]:
        """Times, speeds and the angle turned since `begin`."""
        t = np.linspace(begin, until, PROBES)
        speed = np.linalg.norm(_ask(scene, t, ["angular_velocity"], monitor)["angular_velocity"], axis=1)
        return t, speed, np.concatenate([[0.0], np.cumsum(np.diff(t) * (speed[1:] + speed[:-1]) / 2)])

    probe = last
    if end is None:
        now = float(np.linalg.norm(_ask(scene, np.array([begin]), ["angular_velocity"], monitor)["angular_velocity"]))
        probe = min(last, begin + 2 * TURNS * 2 * math.pi / now) if now > 0 else last
    t, speed, angle = turned(probe)
    if angle[-1] < STILL:
        raise DomainError(f"{scene.name}: nothing turns from {begin:g} s to {probe:g} s, so there is nothing to see: choose another window or start")
    stop = probe
    if end is None and angle[-1] > TURNS * 2 * math.pi:
        stop = float(np.interp(TURNS * 2 * math.pi, angle, t))
        notes.append(f"The first {TURNS} turns of {last - begin:g} s: --from and --to (begin, end) show others.")
    turns = float(np.max(speed[t <= stop])) * (stop - begin) / (2 * math.pi)
    if turns * FEWEST_FRAMES > MOST:
        raise DomainError(f"{scene.name}: {turns:.0f} turns are more than a view shows (at most {MOST // FEWEST_FRAMES}): "
                          "choose a shorter window with --from and --to (begin, end)")
    if turns * FRAMES > MOST:
        notes.append(f"Thinned to {MOST / turns:.0f} pictures a turn.")
    return np.linspace(begin, stop, int(min(max(turns * FRAMES, LEAST), MOST)) + 1)


def _rounded(values: Any) -> list[Any]:
    """Nested lists of numbers of seven digits, as many as a picture needs."""
    array = np.asarray(values, dtype=float)
    return [float(f"{v:.7g}") for v in array] if array.ndim == 1 else [_rounded(row) for row in array]


def _data(scene: Scene, answer: Answer) -> dict[str, Any]:
    """What the page shows, as plain data."""
    given = FAMILIES[scene.kind].arguments(scene)
    inertia = np.asarray(given["inertia"], dtype=float)
    inertia = np.diag(inertia) if inertia.ndim == 1 else inertia
    attitude, omega = answer["attitude"], answer["angular_velocity"]
    # q and -q are one attitude: of neighbours the near ones, so that the page can go between them
    flips = np.where(np.sum(attitude[1:] * attitude[:-1], axis=1) < 0, -1.0, 1.0)
    attitude = attitude * np.cumprod(np.concatenate([[1.0], flips]))[:, None]
    if "angular_momentum" in answer:
        momentum = answer["angular_momentum"]
    elif "angular_momentum_inertial" in answer:
        momentum = np.einsum("nji,nj->ni", matrix_from_quaternion(attitude), answer["angular_momentum_inertial"])
    else:
        momentum = omega @ inertia
    moments, axes = np.linalg.eigh(inertia)
    shown = momentum if np.any(momentum) else omega
    along = shown @ axes
    which = int(np.argmax(np.abs(along).sum(axis=0)))
    axis = axes[:, which] * (1 if along[0, which] >= 0 else -1)
    return {
        "name": scene.name, "kind": scene.kind, "summary": summary(answer), "met": answer.met,
        "warnings": [f"{warning.code}: {warning.message}" for warning in answer.warnings],
        "errors": {name: f"{answer.error[name]:.2g}" for name in answer if math.isfinite(answer.error.get(name, math.nan))},
        "begin": float(answer.t[0]), "end": float(answer.t[-1]), "turns": float(np.mean(np.linalg.norm(omega, axis=1)) * np.ptp(answer.t) / (2 * math.pi)),
        "attitude": _rounded(attitude), "angular_velocity": _rounded(omega), "angular_momentum": _rounded(momentum),
        "axis": _rounded(axis), "axis_name": f"axis of the {MOMENT_NAMES[which]} moment", "moments": _rounded(moments), "principal": _rounded(axes.T),
        "box": _box(scene, given, inertia), "wheels": _wheels(scene), "up": _up(scene),
    }


def _box(scene: Scene, given: Mapping[str, Any], inertia: Floats) -> dict[str, Any]:
    """The even box with these moments about its centre: half its edges, their directions and the centre, in body axes; its farthest corner
    is one from the origin."""
    centre, mass = np.zeros(3), 1.0
    if scene.kind == "heavy" or scene.kind == "general" and scene.tables["body"]["fixed"]:  # about the fixed point, which is the origin
        centre = np.asarray(given["centre_of_mass"], dtype=float)
        room = float(centre @ centre)
        if given["mass"] is not None:
            mass = float(given["mass"])
        elif room > 0:  # as nothing needs it: such that half of the least moment is left about the mass centre
            mass = 0.5 * float(np.linalg.eigvalsh(inertia)[0]) / room
        inertia = inertia - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    moments, axes = np.linalg.eigh(inertia)
    half = np.sqrt(np.maximum(1.5 * (moments.sum() - 2 * moments) / mass, 0.0))
    half = np.maximum(half, 0.03 * np.max(half))  # a lamina can still be seen
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half @ axes.T + centre
    size = float(np.max(np.linalg.norm(corners, axis=1)))
    return {"half": _rounded(half / size), "axes": _rounded(axes.T), "centre": _rounded(centre / size)}


def _up(scene: Scene) -> list[Any] | None:
    """The direction up in space of a body that is held at a point."""
    if scene.kind == "heavy":
        return _rounded(-DOWN)
    if scene.kind != "general" or not scene.tables["body"]["fixed"] or not scene.tables["field"]["gravity"]:
        return None
    down = np.asarray(scene.tables["field"]["down"], dtype=float)
    return _rounded(-down / np.linalg.norm(down))


def _wheels(scene: Scene) -> list[Any]:
    """Axes of wheels and rotors in the body, of unit length."""
    body = scene.tables["body"]
    found = [wheel["axis"] for wheel in scene.top.get("wheel", ())]
    if scene.kind == "rotor":
        found.append(scene.tables["rotor"]["axis"])
    inside = np.zeros(3) if body.get("rotor_momentum") is None else np.asarray(body["rotor_momentum"], dtype=float)
    inside = inside * np.array([0.0, 0.0, 1.0]) if inside.ndim == 0 else inside
    if np.any(inside):
        found.append(inside / np.linalg.norm(inside))
    axes = np.array(found, dtype=float).reshape(-1, 3)
    return _rounded(axes / np.linalg.norm(axes, axis=1)[:, None])
