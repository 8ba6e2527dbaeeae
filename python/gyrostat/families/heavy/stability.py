# SPDX-License-Identifier: BSD-3-Clause
"""A heavy body about a fixed point: rest, sleeping top, regular precession, and the periodic motions with their multipliers."""

import math
import textwrap
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat import _core, heavy
from gyrostat.drawing import new_figure
from gyrostat.errors import ConvergenceError, DomainError
from gyrostat.scenes import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["plot", "report", "sentence", "tables"]

Tables = list[tuple[str, list[str], list[list[str]]]]

# The family begins at so many times the rate of the torque, or at the scene's spin where that is faster.
FIRST: Final = 6.0
# What the conversion of an attitude leaves of a cosine that is 0 or 1.
ROUNDING: Final = 4 * np.finfo(float).eps
# A stretch of members that are undecided is a crossing or a touch of the bound of stability where its spins differ by less than this share.
NARROW: Final = 1e-2
ENDS: Final = {
    "spin-reached": "it goes on to slower spins", "spin-zero": "it reaches spin zero", "homoclinic": "its period grows without bound",
    "stalled": "no further member was found", "member-limit": "it goes on: as many members as are listed were allowed",
}
COLOURS: Final = {"stable": "#009E73", "unstable": "#D55E00", "undecided": "#999999"}


def report(scene: Scene) -> dict[str, Any]:
    """Equilibria and periodic motions of a heavy body and their stability, as plain data (docs/heavy.md, sections 3, 4, 6, 7).

    SI units, vectors in body axes; spin and inclination are those of principal axis 3 (heavy.principal_axes).
    pendulum_rate : c = sqrt(M g l/C); slow_rate : max(c, sqrt N), in words the rate that the torque sets.
    rest : down of least potential energy, frequencies and directions of its two swings, and start_angle, how far down is from there at the start
    (None where a periodic motion is asked for) [rad], or None without torque.
    top : None, or for a body with an axis of symmetry through its mass centre: spin, and for both ends of the axis (up, down) threshold,
    frequency_squared, verdict and amplification; precession : cos_inclination, and slow and fast rate about down; nutation : of the start, its
    period [s], least and greatest down along the axis, and precession_rate, the mean turn about down (None where a periodic motion is asked for).
    periodic : the motion with the spin and inclination of the start: spin, cos_inclination, angular_velocity, down, period, closure, trace (sum of the
    two multipliers), multipliers ([re, im]), verdict (stable, unstable, undecided, none) and why, fast (the verdict of the second
    order: exponent, tongue, trace, verdict; None without spin).
    family : spin, period, trace and verdict of the periodic motions of that inclination from fast spins down, folds, end, or why there is none.
    """
    given = heavy.arguments(scene)
    inertia = np.asarray(given["inertia"], dtype=float)
    inertia, axes = (inertia, np.eye(3)) if inertia.ndim == 1 else heavy.principal_axes(inertia)
    body = {"inertia": inertia, "centre_of_mass": axes.T @ given["centre_of_mass"],
            **{name: given[name] for name in ("mass", "gravity", "gravity_gradient")}}
    spin, cosine = _start(given, axes)
    c = math.sqrt(body["mass"] * body["gravity"] * float(np.linalg.norm(body["centre_of_mass"])) / float(inertia[2]))
    slow = max(c, math.sqrt(body["gravity_gradient"]))
    return {"scene": scene.name, "pendulum_rate": c, "slow_rate": slow, "rest": _rest(body, axes, given), "top": _top(body, axes, spin, cosine, given),
            "periodic": _periodic(body, spin, cosine, axes), "family": _family(body, spin, cosine, slow)}


def _start(given: Mapping[str, Any], axes: Any) -> tuple[float, float]:
    """Spin about principal axis 3 and cosine of its inclination at t = 0."""
    if given["periodic"] is not None:
        return given["periodic"]["spin"], given["periodic"]["cos_inclination"]
    cosine = float(axes[:, 2] @ _down(given))
    exact = next((c for c in (-1.0, 0.0, 1.0) if abs(cosine - c) < ROUNDING), cosine)  # level and upright are what was meant
    return float(axes[:, 2] @ given["angular_velocity"]), exact


def _down(given: Mapping[str, Any]) -> Any:
    """Down at the start, in the given axes."""
    down = given["down"]
    return -_core.matrix_from_quaternion(given["attitude"][None, :])[0].reshape(3, 3)[2] if down is None else np.asarray(down)


def _number(value: Any) -> float | None:
    return float(value) if math.isfinite(value) else None


def _rest(body: Mapping[str, Any], axes: Any, given: Mapping[str, Any]) -> dict[str, Any] | None:
    try:
        made = heavy.hanging(**body)
    except DomainError:
        return None
    down, angle = axes @ made.down, None
    if given["periodic"] is None:
        start = _down(given)
        angle = float(math.atan2(np.linalg.norm(np.cross(start, down)), start @ down))
    return {"down": down.tolist(), "frequency": made.frequency.tolist(), "swing": (made.swing @ axes.T).tolist(), "start_angle": angle}


def _top(body: Mapping[str, Any], axes: Any, spin: float, cosine: float, given: Mapping[str, Any]) -> dict[str, Any] | None:
    I, r = body["inertia"], body["centre_of_mass"]
    # of an axis other than the third the spin is another
    if I[0] != I[1] or r[0] != 0 or r[1] != 0:
        return None
    try:
        sleeps = [heavy.sleeping_top(**body, spin=spin, axis_down=side) for side in (False, True)]
        rates = heavy.regular_precession(**body, spin=spin, cos_inclination=cosine)
    except DomainError:
        return None
    ends = {name: {"threshold": float(s.threshold), "frequency_squared": float(s.frequency_squared), "verdict": str(s.verdict),
                   "amplification": _number(s.amplification)} for name, s in zip(("up", "down"), sleeps, strict=True)}
    return {"spin": spin, **ends, "nutation": _nutation(body, axes, given), "precession": {"cos_inclination": cosine, "slow": _number(rates.slow), "fast": _number(rates.fast)}}


def _nutation(body: Mapping[str, Any], axes: Any, given: Mapping[str, Any]) -> dict[str, Any] | None:
    if given["periodic"] is not None:
        return None
    made = heavy.exact(**body, angular_velocity=axes.T @ given["angular_velocity"], down=axes.T @ _down(given), t=[0.0])
    least, greatest = made.nutation.tolist()
    upright = min(1 + greatest, 1 - least) < ROUNDING  # an axis that stays on the vertical does not go round it
    return {"period": _number(made.period), "least": _number(least), "greatest": _number(greatest), "precession_rate": None if upright else _number(made.precession_rate)}


def _periodic(body: Mapping[str, Any], spin: float, cosine: float, axes: Any) -> dict[str, Any]:
    made = {"spin": spin, "cos_inclination": cosine}
    if spin == 0 or abs(cosine) >= 1:
        return {**made, "verdict": "none", "why": "without spin, or with axis 3 along the vertical, there is no such motion", "fast": None}
    o = heavy.periodic_orbit(**body, spin=spin, cos_inclination=cosine)
    f = heavy.fast_stability(**body, spin=spin, cos_inclination=cosine)
    fast = {"exponent": _number(f.exponent), "tongue": _number(f.tongue), "trace": _number(f.trace), "verdict": str(f.verdict)}
    if str(o.verdict) == "none":
        return {**made, "verdict": "none", "why": str(o.why), "fast": fast}
    return {**made, "angular_velocity": (axes @ o.angular_velocity).tolist(), "down": (axes @ o.down).tolist(), "period": float(o.period),
            "closure": float(o.closure), "trace": float(o.trace), "multipliers": [[m.real, m.imag] for m in o.multipliers.tolist()],
            "verdict": str(o.verdict), "why": "", "fast": fast}


def _family(body: Mapping[str, Any], spin: float, cosine: float, slow: float) -> dict[str, Any]:
    nothing: dict[str, Any] = {"spin": [], "period": [], "trace": [], "verdict": [], "folds": [], "end": None}
    if slow == 0 or abs(cosine) >= 1:
        return {**nothing, "why": "without torque, or with axis 3 along the vertical, there is no such family"}
    first = math.copysign(max(abs(spin), FIRST * slow), spin)
    try:
        made = heavy.periodic_family(**body, first_spin=first, cos_inclination=cosine)
    except (DomainError, ConvergenceError) as error:
        return {**nothing, "why": str(error)}
    m = made.members
    return {"spin": m.angular_velocity[:, 2].tolist(), "period": m.period.tolist(), "trace": m.trace.tolist(), "verdict": m.verdict.tolist(),
            "folds": made.folds.tolist(), "end": made.end, "why": ""}


# ---- words ----


def _text(value: float | None, digits: int = 6) -> str:
    return "-" if value is None else f"{value:.{digits}g}"


def _complex(value: list[float]) -> str:
    re, im = value
    return f"{re:.6g}" if im == 0 else f"{re:.6g} {'+' if im > 0 else '-'} {abs(im):.6g}i"


def _vector(values: list[float]) -> str:
    return "(" + ", ".join(f"{x:.6f}" for x in values) + ")"


def _precession(precession: Mapping[str, Any], which: str) -> str:
    if precession[which] is not None:
        return _text(precession[which])
    return "none: the axis is level" if precession["cos_inclination"] == 0 else "none"


def _swing(frequency: float) -> str:
    return f"{frequency:.6g} rad/s, {2 * math.pi / frequency:.6g} s" if frequency > 0 else "none"


def _runs(verdicts: Sequence[str], folds: Collection[int]) -> list[tuple[int, int]]:
    """First and last member of the runs of one verdict between folds."""
    made, begin = [], 0
    for i in range(1, len(verdicts) + 1):
        if i == len(verdicts) or verdicts[i] != verdicts[begin] or i - 1 in folds:
            made.append((begin, i - 1))
            begin = i
    return made


def _stretches(family: Mapping[str, Any]) -> list[tuple[int, int, str]]:
    """First and last member and verdict of the stretches of one verdict between folds. A narrow stretch that is undecided belongs to the one before
    it, or behind a fold to the one after it."""
    verdicts, folds, spin = list(family["verdict"]), set(family["folds"]), family["spin"]
    for begin, end in _runs(verdicts, folds):
        if verdicts[begin] == "undecided" and abs(spin[end] - spin[begin]) <= NARROW * abs(spin[begin]):
            before, after = begin > 0 and begin - 1 not in folds, end + 1 < len(verdicts) and end not in folds
            if before or after:
                verdicts[begin:end + 1] = [verdicts[begin - 1 if before else end + 1]] * (end + 1 - begin)
    return [(begin, end, verdicts[begin]) for begin, end in _runs(verdicts, folds)]


def tables(report: Mapping[str, Any]) -> Tables:
    """Titles, heads and rows for reading."""
    made: Tables = []
    rest, top, orbit, family, slow = (report[name] for name in ("rest", "top", "periodic", "family", "slow_rate"))
    if rest is not None:
        made.append((f"{report['scene']}: hanging at rest, down = {_vector(rest['down'])}", ["swing of down along", "frequency and period"],
                     [[_vector(swing), _swing(f)] for swing, f in zip(rest["swing"], rest["frequency"], strict=True)]))
    if top is not None:
        made.append((f"Top with vertical axis at {top['spin']:.6g} rad/s", ["axis 3", "verdict", "least stable spin [rad/s]", "enlarges a tilt"],
                     [[end, top[end]["verdict"], _text(top[end]["threshold"]), _text(top[end]["amplification"])] for end in ("up", "down")]))
        p = top["precession"]
        made.append((f"Regular precession at cos(inclination) = {p['cos_inclination']:.6g}, right-handed about down", ["", "rate [rad/s]"],
                     [["slow", _precession(p, "slow")], ["fast", _precession(p, "fast")]]))
        if (n := top["nutation"]) is not None:
            made.append(("Nutation from this start", ["period [s]", "down along the axis", "mean precession about down [rad/s]"],
                         [[_text(n["period"], 9), f"{_text(n['least'])} to {_text(n['greatest'])}", _text(n["precession_rate"])]]))
    if orbit["verdict"] != "none":
        a, b = (_complex(m) for m in orbit["multipliers"])
        made.append((f"Periodic motion with spin {orbit['spin']:.6g} rad/s, cos(inclination) {orbit['cos_inclination']:.6g}",
                     ["verdict", "period [s]", "sum of multipliers", "multipliers"],
                     [[orbit["verdict"], f"{orbit['period']:.9g}", f"{orbit['trace']:.9g}", f"{a}; {b}"]]))
    if family["spin"]:
        rows = []
        for begin, end, verdict in _stretches(family):
            r, T, trace = (family[name] for name in ("spin", "period", "trace"))
            rows.append([verdict, f"{r[begin]:.5g} to {r[end]:.5g}", f"{r[begin] / slow:.4g} to {r[end] / slow:.4g}",
                         f"{T[begin]:.5g} to {T[end]:.5g}", f"{trace[begin]:.4g} to {trace[end]:.4g}"])
        made.append(("Periodic motions of this inclination, from fast spins down",
                     ["verdict", "spin [rad/s]", "over the rate of the torque", "period [s]", "sum of multipliers"], rows))
    return made


def sentence(report: Mapping[str, Any]) -> str:
    """What the tables come to."""
    rest, top, orbit, family, slow = (report[name] for name in ("rest", "top", "periodic", "family", "slow_rate"))
    words = [f"The torque sets the rate {slow:.6g} rad/s; the start spins {abs(orbit['spin']) / slow:.4g} times as fast." if slow > 0 else "There is no torque."]
    if rest is not None and (rest["start_angle"] or 0) > math.pi / 2:
        words.append(f"The start is {math.degrees(rest['start_angle']):.4g} degrees from hanging, about which the swings above are.")
    if top is not None:
        verdict = top["up"]["verdict"]
        words.append(f"Upright the top would be {verdict}; the least spin that holds it is {top['up']['threshold']:.6g} rad/s.")
    if orbit["verdict"] == "none":
        words.append(f"No periodic motion with this spin was found: {orbit['why']}.")
    else:
        words.append(f"The periodic motion with this spin and inclination is {orbit['verdict']}.")
    if family["spin"]:
        folds = f", after {len(family['folds'])} fold{'s' if len(family['folds']) > 1 else ''}" if family["folds"] else ""
        words.append(f"Its family was followed to the spin {family['spin'][-1]:.5g} rad/s{folds}; there {ENDS[family['end']]}.")
    elif family["why"]:
        words.append(f"No family: {family['why']}.")
    return " ".join(words)


# ---- figure ----


def plot(scene: Scene, report: Mapping[str, Any]) -> "Figure":
    """Period and sum of the multipliers of the family over the spin. Raises DomainError where there is no family."""
    family, orbit, slow = report["family"], report["periodic"], report["slow_rate"]
    if len(family["spin"]) < 2:
        raise DomainError(f"there is no family of periodic motions to draw: {family['why'] or 'it has a single member'}")
    figure = new_figure(9, 8)
    above, below = figure.subplots(2, 1, sharex=True)
    spin = np.abs(np.array(family["spin"])) / slow
    _branch(above, family, spin, np.array(family["period"]) * slow)
    _branch(below, family, spin, np.arcsinh(np.array(family["trace"]) / 2))
    if orbit["verdict"] != "none":
        for axes, y in ((above, orbit["period"] * slow), (below, math.asinh(orbit["trace"] / 2))):
            axes.plot([abs(orbit["spin"]) / slow], [y], marker="s", markersize=8, color="white", markeredgecolor="black", linestyle="none",
                      label="the scene's spin")
    above.set_ylabel("period x rate of the torque [rad]")
    above.set_title("Period", loc="left", fontsize=10)
    above.legend(loc="best", fontsize=8)
    below.axhspan(-math.asinh(1), math.asinh(1), color="#009E73", alpha=0.1)
    low, high = below.get_ylim()
    wide = high - low > 12  # marks nearer than a twentieth of the height run into each other
    marks = [-1e6, -1e4, -100, *(() if wide else (-10,)), -2, *(() if wide else (0,)), 2, *(() if wide else (10,)), 100, 1e4, 1e6]
    shown = [m for m in marks if low <= math.asinh(m / 2) <= high]
    below.set_yticks([math.asinh(m / 2) for m in shown], [f"{m:g}" for m in shown])
    below.set_ylabel("sum of the multipliers")
    below.set_title("Stable between -2 and 2", loc="left", fontsize=10)
    below.set_xlabel(f"spin over the rate of the torque, {slow:.5g} rad/s")
    for axes in (above, below):
        axes.set_xscale("log")
        axes.grid(alpha=0.3, which="both")
    left, right = below.get_xlim()
    steps = (1, 2, 3, 5, 7) if right < 30 * left else (1, 2, 5) if right < 1000 * left else (1,)
    ticks = [step * 10.0**power for power in range(-9, 10) for step in steps if left <= step * 10.0**power <= right]
    below.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    below.set_xticks([], minor=True)
    figure.suptitle(textwrap.fill(f"{report['scene']}: {sentence(report)}", 115), fontsize=10)
    return figure


def _branch(axes: "Axes", family: Mapping[str, Any], x: Any, y: Any) -> None:
    named = set()
    for begin, end, verdict in _stretches(family):
        part = slice(begin, min(end + 2, len(x)))
        axes.plot(x[part], y[part], color=COLOURS[verdict], linewidth=1.6, marker=".", markersize=3, label=None if verdict in named else verdict)
        named.add(verdict)
