# SPDX-License-Identifier: BSD-3-Clause
"""Every steady rotation of a gyrostat with a driven rotor, its stability, and which of them a start tends to."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core, rotor
from gyrostat.answer import Answer
from gyrostat.errors import DomainError
from gyrostat.families.rotor.sphere import Path, Sphere, plot_sphere
from gyrostat.scenes import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["plot", "report", "sentence", "tables"]

Vectors = NDArray[np.float64]
Tables = list[tuple[str, list[str], list[list[str]]]]

CERTIFICATES: Final = ("undecided", "by level", "by uniqueness", "none")
# The motion is followed for at most this many turns.
MOST_TURNS: Final = 2e4
# Called settled where H stays within this angle of the attractor [rad].
SETTLED: Final = math.radians(5)
# The motor has come to its rate after so many of its relaxation times; the nutation has died after so many e-folds.
MOTOR_TIMES: Final = 20.0
NUTATION_TIMES: Final = 12.0
FOLLOWED_TIMES: Final = 8001
CIRCLE: Final = 3600  # directions at that angle
# Where swings of the nutation are looked at one by one: how many at most, and at how many times each, so that a peak is seen to a part in 2000.
MOST_SWINGS: Final = 4000
TIMES_A_SWING: Final = 50
ZOOM: Final = 65  # times between the last one outside and the next
# A time by the mean over the nutation is given where its relative error is less than this.
ROUGH: Final = 0.5
# Flat spin: the rotor's axis is further from L than FLAT, that of greatest inertia nearer than ABOUT; and out of it again [rad].
FLAT: Final = math.radians(45)
ABOUT: Final = math.radians(30)
UPRIGHT: Final = math.radians(15)
# The figure draws the whole path by so many points, unless neighbours are further apart than COARSE [rad]: then it draws pieces.
WHOLE: Final = 10001
COARSE: Final = 0.15
PIECES: Final = 40
TURNS_A_PIECE: Final = 1.5
FAMILIES: Final = {
    "at-rest": "the momentum is zero: it has no direction, and nothing rotates steadily about it",
    "axisymmetric": "the body is symmetric about the rotor axis: the nutation does not turn the motor, and the momentum precesses about e for ever",
    "circular-section": "n = J e is normal to a circular section of the inertia ellipsoid: the great circle n.m = 0 is invariant",
    "principal-axis": "the rotor axis is a principal axis: about it the nutation dies like 1/sqrt(t), not exponentially",
}


def report(scene: Scene) -> dict[str, Any]:
    """Steady rotations of a rotor scene and the attractor of its start, as plain data (docs/rotor.md, sections 3 and 4).

    SI units, angles in rad, body axes. momentum : |H|; target_momentum : h = lambda omega*; coupling : k; relaxation_rate : S~;
    family : one of FAMILIES or None; continuum : "circle" or "sphere" of steady rotations, or None.
    steady_rotations : by level of F, each with index, direction, spin_rate, rotor_axis_angle (of e to L), type (min, saddle, max,
    degenerate), level, isolated, verdict, decay_rate, e_fold_time, eigenvalues ([re, im]), best_slope, best_rate, algebraic_rate
    (1/W = 1/W0 + rate t). start : direction, rotor_axis_angle, flat_spin (it turns about the axis of greatest inertia, and
    the rotor axis is far from L), lyapunov, turn_time (a lower bound).
    attractor : index (None: not certified), certificate, margin (V less the lowest barrier at the start), time (when certified, 0: at
    the start), expected_time (where it is not, an estimate of when it will be), settling_time (until H stays within 5 degrees of it) and settling ("followed" or "averaged"), flat_spin ("recovers",
    "inverted", "stays", "undecided", or None where the start is none). What is not known is None.
    """
    given = rotor.arguments(scene)
    body = {key: given[key] for key in ("inertia", "axis", "axial_inertia", "slope", "no_load_rate")}
    theta = np.asarray(given["inertia"], dtype=float)
    theta = np.diag(theta) if theta.ndim == 1 else theta
    e, h = np.asarray(given["axis"], dtype=float), given["axial_inertia"] * given["no_load_rate"]
    H = theta @ given["angular_velocity"] + given["axial_inertia"] * given["rotor_rate"] * e
    certified = _core.rotor_certify(**body, angular_velocity=given["angular_velocity"][None, :], rotor_rate=[given["rotor_rate"]])
    l = float(certified["momentum"][0])
    found = rotor.steady_rotations(**body, momentum=l)
    k = 1.0 - given["axial_inertia"] * float(e @ np.linalg.solve(theta, e))
    steady = [_rotation(found, i, e) for i in range(int(found.count))]
    family, continuum = str(found.family) or None, str(found.continuum) or None
    tilt = _angle(e, H)
    about = abs(float(np.linalg.eigh(theta)[1][:, 2] @ H)) > math.cos(ABOUT) * l
    made: dict[str, Any] = {
        "scene": scene.name, "momentum": l, "target_momentum": h, "coupling": k,
        "relaxation_rate": given["slope"] / (given["axial_inertia"] * k), "family": family, "continuum": continuum,
        "steady_rotations": steady,
        "start": {"direction": (H / l).tolist() if l > 0 else None, "rotor_axis_angle": tilt if l > 0 else None,
                  "flat_spin": l > 0 and about and min(tilt, math.pi - tilt) > FLAT, "lyapunov": float(certified["level"][0]), "turn_time": 2 * math.pi / _fastest(theta, e, given, H)},
    }
    if family == "circular-section":
        made["circular_section"] = dict(_core.rotor_circular_section(**body, momentum=l))
    made["attractor"] = _attractor(made, given, body, theta, certified)
    return made


def _angle(a: Vectors, b: Vectors) -> float:
    return float(math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b)))


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _fastest(theta: Vectors, e: Vectors, given: Mapping[str, Any], H: Vectors) -> float:
    """A bound of the rates at which the body turns and nutates [rad/s]."""
    rotor_momentum = given["axial_inertia"] * max(abs(given["no_load_rate"]), abs(given["rotor_rate"]))
    least = float(np.linalg.eigvalsh(theta - given["axial_inertia"] * np.outer(e, e))[0])
    return max((float(np.linalg.norm(H)) + float(rotor_momentum)) / least, 1e-300)


def _rotation(found: rotor.SteadyRotations, i: int, e: Vectors) -> dict[str, Any]:
    direction = found.direction[i]
    decay = float(found.decay_rate[i])
    return {
        "index": i, "direction": direction.tolist(), "spin_rate": float(found.spin_rate[i]),
        "rotor_axis_angle": _angle(e, direction), "type": str(found.type[i]), "level": float(found.level[i]),
        "isolated": bool(found.isolated[i]), "verdict": str(found.verdict[i]), "decay_rate": _number(decay),
        "e_fold_time": 1.0 / decay if decay > 0 else None,
        "eigenvalues": [[float(d.real), float(d.imag)] for d in found.eigenvalues[i]],
        "best_slope": _number(found.best_slope[i]), "best_rate": _number(found.best_rate[i]),
        "algebraic_rate": _number(found.algebraic_rate[i]),
    }


def _attractor(made: Mapping[str, Any], given: Mapping[str, Any], body: Mapping[str, Any], theta: Vectors,
               certified: Mapping[str, Any]) -> dict[str, Any]:
    start = made["start"]
    verdict: dict[str, Any] = {
        "index": None, "certificate": CERTIFICATES[int(certified["certificate"][0])], "margin": _number(float(certified["margin"][0])),
        "time": None, "expected_time": None, "settling_time": None, "settling": None, "flat_spin": None,
    }
    index, time = int(certified["index"][0]), 0.0
    longest = MOST_TURNS * start["turn_time"]
    if index < 0 and verdict["certificate"] == "undecided":
        caught = _core.rotor_capture(**body, angular_velocity=given["angular_velocity"][None, :], rotor_rate=[given["rotor_rate"]],
                                     longest=longest, tolerance=1e-10)
        index, time = int(caught["index"][0]), float(caught["time"][0])
        if index < 0:
            verdict["expected_time"] = _expected(made, given, body, start["lyapunov"] - verdict["margin"], longest)
    if index >= 0:
        verdict["index"], verdict["time"] = index, time
        verdict["settling_time"], verdict["settling"] = _settling(made, given, body, theta, index, longest)
    if start["flat_spin"] and given["slope"] > 0:
        if index < 0:
            verdict["flat_spin"] = "undecided"
        else:
            end = made["steady_rotations"][index]["rotor_axis_angle"]
            aligned = end if made["target_momentum"] >= 0 else math.pi - end
            verdict["flat_spin"] = "recovers" if aligned < UPRIGHT else "inverted" if aligned > math.pi - UPRIGHT else "stays"
    return verdict


def _expected(made: Mapping[str, Any], given: Mapping[str, Any], body: Mapping[str, Any], barrier: float, followed: float) -> float | None:
    """When V, above the barrier after `followed`, should fall below it, by the mean over the nutation."""
    if MOTOR_TIMES / made["relaxation_rate"] > followed:
        return None
    state = rotor.solve(**{**given, "times": [followed], "tolerance": 1e-6, "model": "full", "integrator": "auto"})
    time, error = _core.rotor_fall_time(**body, angular_velocity=state["angular_velocity"][0], rotor_rate=state["rotor_rate"][0], valley=0,
                                        end=barrier)
    return float(followed + time) if error < ROUGH else None


def _last_outside(answer: Answer, l: float, m: Vectors) -> int:
    """Place of the last time at which H is more than SETTLED off m; -1 where there is none."""
    H = answer["angular_momentum"]
    outside = np.flatnonzero((np.linalg.norm(np.cross(H / l, m), axis=1) > math.sin(SETTLED)) | (H @ m < 0))
    return int(outside[-1]) if len(outside) else -1


def _settling(made: Mapping[str, Any], given: Mapping[str, Any], body: Mapping[str, Any], theta: Vectors, index: int,
              longest: float) -> tuple[float | None, str | None]:
    """Time until H stays within SETTLED of the attractor, and how it was found.

    The motion is followed until the motor has come to its rate and, where that is near, until the nutation has died; the mean over the
    nutation gives the rest.
    """
    attractor, l = made["steady_rotations"][index], made["momentum"]
    m = np.array(attractor["direction"])
    motor = MOTOR_TIMES / made["relaxation_rate"]
    nutation = NUTATION_TIMES * (attractor["e_fold_time"] or math.inf)
    followed = min(max(motor, nutation) if max(motor, nutation) <= longest else motor, longest)
    how = {**given, "tolerance": 1e-6, "model": "full", "integrator": "auto"}
    t = np.linspace(0.0, followed, FOLLOWED_TIMES)
    answer = rotor.solve(**{**how, "times": t})
    V = float(answer["lyapunov"][-1])
    # The least F at that angle: what has come nearer with less of V stays nearer.
    across, turn = np.linalg.svd(m[None, :])[2][1:], np.linspace(0.0, 2 * math.pi, CIRCLE, endpoint=False)[:, None]
    circle = math.cos(SETTLED) * m + math.sin(SETTLED) * (np.cos(turn) * across[0] + np.sin(turn) * across[1])
    end = float(np.min(Sphere(theta, np.asarray(given["axis"], dtype=float), l, made["target_momentum"]).level(circle)))
    if V <= end:
        # V never grows: from its first time below the level on no swing leads out again, and before it the swings are looked at one by one
        sure = int(np.argmax(answer["lyapunov"] <= end))
        last = _last_outside(answer, l, m)
        begin = max(last, 0)
        swings = (t[sure] - t[begin]) * max(im for _, im in attractor["eigenvalues"]) / (2 * math.pi)
        if swings > MOST_SWINGS:
            return float(t[sure]), "followed"

        def closer(first: float, after: float, times: int) -> tuple[Vectors, int]:
            """The motion between two times, and where it is outside last."""
            t = np.linspace(first, after, times)
            return t, _last_outside(rotor.solve(**{**how, "times": t}), l, m)

        if begin < sure:
            t, last = closer(float(t[begin]), float(t[sure]), max(math.ceil(swings * TIMES_A_SWING), sure - begin) + 2)
        if 0 <= last < len(t) - 1:
            t, last = closer(float(t[last]), float(t[last + 1]), ZOOM)
        return float(t[min(last + 1, len(t) - 1)]), "followed"
    x = float(answer["rotor_rate"][-1]) - given["no_load_rate"]
    in_motor = 0.5 * given["axial_inertia"] * made["coupling"] * x * x
    if in_motor > 0.1 * (V - attractor["level"]):
        return None, None
    time, error = _core.rotor_fall_time(**body, angular_velocity=answer["angular_velocity"][-1], rotor_rate=answer["rotor_rate"][-1],
                                        valley=index, end=end)
    return (float(followed + time), "averaged") if error < ROUGH else (None, None)


# ---- words ----


def _duration(seconds: float | None) -> str:
    if seconds is None:
        return "-"
    for size, unit in ((31557600.0, "years"), (86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.3g}°"


def _complex(value: Sequence[float]) -> str:
    re, im = value
    return f"{re:.4g}" if im == 0 else f"{re:.4g} {'+' if im > 0 else '-'} {abs(im):.4g}i"


def _eigenvalues(values: Sequence[Sequence[float]]) -> str:
    pairs = [v for v in values if v[1] >= 0]
    return ", ".join(_complex(v) if v[1] == 0 else f"{v[0]:.4g} ± {v[1]:.4g}i" for v in pairs)


def tables(report: Mapping[str, Any]) -> Tables:
    """Titles, heads and rows for reading."""
    first, second = [], []
    for r in report["steady_rotations"]:
        m = ", ".join(f"{x:.6f}" for x in r["direction"])
        verdict = r["verdict"] + ("" if r["isolated"] else ", not isolated")
        first.append([str(r["index"]), f"({m})", f"{r['spin_rate']:.9g}", _degrees(r["rotor_axis_angle"]), r["type"], f"{r['level']:.9g}", verdict])
        decays = "-" if r["e_fold_time"] is None else _duration(r["e_fold_time"])
        best = "-" if r["best_slope"] is None else f"{r['best_slope']:.4g}"
        best_time = "-" if r["best_rate"] is None else _duration(1 / r["best_rate"])
        second.append([str(r["index"]), "-" if r["decay_rate"] is None else f"{r['decay_rate']:.4g}", decays, best, best_time,
                       _eigenvalues(r["eigenvalues"])])
    return [(f"{report['scene']}: steady rotations, momentum {report['momentum']:.6g} N m s, h = {report['target_momentum']:.6g} N m s",
             ["", "direction of the momentum, body axes", "spin rate [rad/s]", "e to it", "type", "F [J]", "verdict"], first),
            ("Small disturbances", ["", "decay rate [1/s]", "e-fold", "best slope [N m s/rad]", "e-fold there", "eigenvalues [1/s]"], second)]


def sentence(report: Mapping[str, Any]) -> str:
    """What is special about the body, where the start goes, and when."""
    words = []
    family, start, verdict = report["family"], report["start"], report["attractor"]
    if family is not None:
        words.append(f"Exceptional: {FAMILIES[family]}.")
        section = report.get("circular_section")
        if section:
            words.append("On it the momentum runs round for ever, and starts of an open set end there." if section["tumbles"] else
                         "It holds two steady rotations.")
    if report["continuum"] is not None:
        words.append(f"A whole {report['continuum']} of steady rotations: what is listed stands for it.")
    if start["direction"] is None:
        return " ".join([*words, "The carrier ends turning at -h n."])
    tilt = _degrees(start["rotor_axis_angle"])
    if verdict["index"] is None:
        where = f"At the start e is {tilt} from the momentum{', in flat spin' if start['flat_spin'] else ''}."
        if verdict["certificate"] == "none":
            why = "the motor has no slope" if report["relaxation_rate"] == 0 else "no steady rotation attracts"
            return " ".join([*words, where, f"There is no attractor: {why}."])
        margin, longest = verdict["margin"], _duration(MOST_TURNS * start["turn_time"])
        why = (f"V is {margin:.4g} J above the lowest saddle and not below it within {longest}" if margin is not None and margin > 0
               else "the start is at an unstable steady rotation or a barrier")
        expected = verdict["expected_time"]
        return " ".join([*words, where, f"Undecided: {why}.",
                         *([f"By the mean over the nutation it should be after about {_duration(expected)}."] if expected else [])])
    end = report["steady_rotations"][verdict["index"]]
    spin = {"recovers": "Recovers from flat spin: a", "inverted": "Leaves flat spin upside down (rotor momentum against the whole): a",
            "stays": "Does not recover from flat spin: a", None: "A"}[verdict["flat_spin"]]
    how = {"by level": "V is below the lowest saddle", "by uniqueness": "it is the only minimum", "undecided": "V falls below the lowest saddle"}
    when = "from the start" if verdict["time"] == 0 else f"after {_duration(verdict['time'])}"
    words.append(f"{spin}ttractor {verdict['index']} is certified {when} ({how[verdict['certificate']]}). The rotor axis is {tilt} from the momentum "
                 f"at the start and {_degrees(end['rotor_axis_angle'])} at the attractor.")
    if verdict["settling_time"] == 0:
        words.append("The momentum is within 5° of it from the start.")
    elif verdict["settling_time"] is not None:
        about = "about " if verdict["settling"] == "averaged" else ""
        words.append(f"The momentum stays within 5° of it after {about}{_duration(verdict['settling_time'])}.")
    if end["e_fold_time"] is not None:
        words.append(f"The slowest mode has an e-fold of {_duration(end['e_fold_time'])}; with the slope of fastest damping, "
                     f"{end['best_slope']:.4g} N m s/rad, it would be {_duration(1 / end['best_rate'])}.")
    elif end["algebraic_rate"] is not None and end["algebraic_rate"] > 0:
        words.append("The nutation dies algebraically: 1/(V - F) grows by "
                     f"{end['algebraic_rate']:.4g} 1/(J s), so that its angle falls like 1/sqrt(t).")
    return " ".join(words)


# ---- figure ----


def plot(scene: Scene, report: Mapping[str, Any]) -> "Figure":
    """The momentum sphere with levels of F, steady rotations and the path of the start. Raises DomainError where L = 0."""
    if report["momentum"] == 0:
        raise DomainError("the momentum is zero: it has no direction, and there is no momentum sphere to draw")
    given = rotor.arguments(scene)
    theta = np.asarray(given["inertia"], dtype=float)
    theta = np.diag(theta) if theta.ndim == 1 else theta
    sphere = Sphere(theta, np.asarray(given["axis"], dtype=float), report["momentum"], report["target_momentum"])
    path = _path(report, given)
    index = report["attractor"]["index"]
    return plot_sphere(sphere, report["steady_rotations"], path, 0 if index is None else index, f"{report['scene']}: {sentence(report)}")


def _path(report: Mapping[str, Any], given: Mapping[str, Any]) -> Path:
    """The motion over the times of the scene, or as far as it can be followed; in pieces where the turns are many."""
    asked = float(given["times"][-1])
    end = min(asked, MOST_TURNS * report["start"]["turn_time"])
    note = f"path of {_duration(end)}"

    def motion(t: Vectors) -> Answer:
        return rotor.solve(**{**given, "times": t, "tolerance": 1e-6, "model": "auto"})

    pieces = [np.linspace(0.0, end, WHOLE)]
    columns = motion(pieces[0])
    m = columns["angular_momentum"] / report["momentum"]
    if np.max(np.linalg.norm(np.diff(m, axis=0), axis=1)) > COARSE:
        rate = float(np.median(np.linalg.norm(np.cross(m, columns["angular_velocity"]), axis=1)))
        length = min(2 * math.pi * TURNS_A_PIECE / max(rate, 1e-300), end / (2 * PIECES))
        pieces = [begin + np.linspace(0.0, length, 161) for begin in np.linspace(0.0, end - length, PIECES)]
        columns = motion(np.concatenate(pieces))
        m = columns["angular_momentum"] / report["momentum"]
        note = f"{PIECES} pieces of {_duration(length)} from a path of {_duration(end)}"
    if end < asked:
        note += f", the scene goes on to {_duration(asked)}"
    at = np.cumsum([len(piece) for piece in pieces])[:-1]
    return Path(pieces, np.split(m, at), np.split(columns["lyapunov"], at), note)
