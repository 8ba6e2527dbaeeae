# SPDX-License-Identifier: BSD-3-Clause
"""The chart of a body with any wheels under any torques: what is measured, how far, and the equations for rivals."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.broadcast import Floats
from gyrostat.charts.problem import MOST_TURNS, TURNING, Problem, Unanswered, counted, first_turns, reference, true_errors
from gyrostat.errors import DomainError
from gyrostat.facts import FACTS
from gyrostat.families.general.clock import since
from gyrostat.families.general.functions import QUESTION, integrate, posed, recognise, segments, solve
from gyrostat.families.general.scene import arguments

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["problem"]

Law = Callable[[float], Any]

# Times at which the rates are looked at, to foresee how far the body turns, and to how much.
LOOKS: Final = 201
ROUGH: Final = 1e-3
AT_REST: Final = 1e-300  # rad/s, a rate that divides nothing by nought


def _cross(a: Floats, b: Floats) -> Floats:
    """Of numbers, or of formulas, which np.cross takes from numpy 2 on."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def problem(scene: "Scene") -> Problem:
    """The scene, or its first part where the whole is too long. What is known of the error of its start is no error of a method: all begin at the same
    start, as if it were exact. Raises DomainError for a motion that a brake stops."""
    given = {**arguments(scene), "ask": ("attitude", "angular_velocity"), "euler": None}
    exact, begin = "; the start taken as exact" if given.pop("start_error", None) else "", scene.start_time
    physics = {name: value for name, value in given.items() if name not in QUESTION}
    found = {family for family, why in recognise(**physics, times=given["times"]).items() if not why}
    rival = Rival(physics)
    rate = _rate(given, rival)
    since_start, cut = first_turns(given["times"] - begin, lambda end: rate * end, MOST_TURNS)
    if cut:
        given["times"] = since_start + begin
    physics["times"], rival.times = given["times"], given["times"] - begin
    want, source = reference(integrate, physics, "taylor")
    end, last = float(rival.times[-1]), float(given["times"][-1])
    first = f" from {begin:.6g}" if begin else ""
    title = f"{counted(len(given['times']), 'time')}{first} to {last:.6g} s{cut}\n{rate * end if rate > AT_REST else 0:.3g} turns at most; {source}{exact}"
    lacks = set() if segments(**physics) else {"segments"}
    rungs = tuple(name for name in FACTS["general"].rungs if name.rpartition(":")[0] in {"", *found} and name not in lacks)
    return Problem(title, TURNING, solve, given, integrate, physics, lambda made: true_errors(made, want), rival, end * 10 * rate, rungs=rungs,
                   cuts=rival.cuts, begin=begin)


def _rate(given: Mapping[str, Any], rival: "Rival") -> float:
    """The greatest rate of body, orbit, field and waves, in turns a second."""
    begin, end = given.get("start_time", 0.0), float(given["times"][-1])
    if end <= begin:
        return 1.0  # which first_turns refuses
    try:
        answer = solve(**{**given, "times": np.linspace(begin, end, LOOKS), "tolerance": ROUGH, "model": "auto", "ask": ("angular_velocity",)})
    except DomainError as error:
        raise DomainError(f"the motion cannot be charted to {end:.6g} s, choose a shorter time: {error}") from None
    for warning in answer.warnings:
        if warning.code == "rest":
            raise DomainError(f"the motion cannot be charted to {end:.6g} s, choose a shorter time: integrators do not go through a stop, and "
                              f"{warning.message}")
    return max(float(np.max(np.linalg.norm(answer["angular_velocity"], axis=1))), rival.forcing, AT_REST) / (2 * math.pi)


# ---- the equations for rivals ----


def _table(table: Mapping[str, Any]) -> Law:
    """Values over time, (width,)."""
    times, values = table["times"], table["values"]
    slopes = np.zeros_like(values)
    if len(times) > 1:
        slopes = np.gradient(values, times, axis=0, edge_order=2 if len(times) > 2 else 1)
    kind, holds = table["interpolation"], table["extend"] == "hold"

    def law(t: float) -> Floats:
        if not times[0] <= t <= times[-1]:
            made: Floats = values[0 if t < times[0] else -1] * holds
            return made
        i = max(0, min(int(np.searchsorted(times, t, side="right")) - 1, len(times) - 2))
        if kind == "step" or len(times) == 1:
            made = values[int(np.searchsorted(times, t, side="right")) - 1]
            return made
        h = times[i + 1] - times[i]
        s = (t - times[i]) / h
        if kind == "linear":
            made = values[i] + s * (values[i + 1] - values[i])
            return made
        made = ((1 + 2 * s) * (1 - s) ** 2 * values[i] + s * s * (3 - 2 * s) * values[i + 1]
                + h * s * (1 - s) * ((1 - s) * slopes[i] - s * slopes[i + 1]))
        return made

    return law


@dataclass(frozen=True, slots=True)
class Maths:
    """Functions of numbers, or of expressions."""

    cos: Callable[[Any], Any]
    sin: Callable[[Any], Any]
    sqrt: Callable[[Any], Any]


NUMBERS: Final = Maths(math.cos, math.sin, math.sqrt)


def _factor(torque: Mapping[str, Any], maths: Maths) -> Callable[[Any], Any]:
    on, table = torque["on"], _table(torque["factor_table"]) if torque["factor_table"] else None
    mean, amplitude, rate, phase = (float(torque[name]) for name in ("mean", "amplitude", "rate", "phase"))

    def factor(t: Any) -> Any:
        if len(on) and not any(begin <= t < end for begin, end in on):
            return 0.0
        wave = mean + amplitude * maths.sin(rate * t + phase) if amplitude else mean
        return wave if table is None else wave * float(table(t)[0])

    return factor


def _rotation(state: Floats) -> Floats:
    """Body to inertial, of a quaternion (x, y, z, w) of any length."""
    return _matrix(state[:4] / np.linalg.norm(state[:4]))


def _matrix(q: Floats) -> Floats:
    """Of a unit quaternion (x, y, z, w)."""
    x, y, z, w = q.tolist()
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class Surroundings:
    """Orbit and field, inertial axes."""

    def __init__(self, scene: Mapping[str, Any], maths: Maths = NUMBERS) -> None:
        self.orbit, self.field, self.maths = scene["orbit"], scene["field"], maths
        self.mean = 0.0
        if self.orbit:
            e, nu = self.orbit["eccentricity"], self.orbit["true_anomaly"]
            self.axis = self.orbit["radius"] * (1 + e * math.cos(nu)) / (1 - e * e)
            self.mean = math.sqrt(self.orbit["mu"] / self.axis**3)
            E = 2 * math.atan(math.sqrt((1 - e) / (1 + e)) * math.tan(nu / 2))
            self.first = E - e * math.sin(E)

    def place(self, t: Any) -> tuple[Floats, Floats, float, float, float]:
        """Radial and along, unit; distance, its rate, and the rate of turn."""
        e, nu, mu = self.orbit["eccentricity"], self.orbit["true_anomaly"], self.orbit["mu"]
        if e == 0:
            c, s = self.maths.cos(self.mean * t), self.maths.sin(self.mean * t)
            return self.orbit["radial"] * c + self.orbit["along"] * s, self.orbit["along"] * c - self.orbit["radial"] * s, self.axis, 0.0, self.mean
        M = self.first + self.mean * t
        E = M
        for _ in range(60):
            step = (E - e * math.sin(E) - M) / (1 - e * math.cos(E))
            E -= step
            if abs(step) < 1e-15 * max(1.0, abs(E)):
                break
        r = self.axis * (1 - e * math.cos(E))
        true = math.atan2(math.sqrt(1 - e * e) * math.sin(E), math.cos(E) - e)
        c, s = math.cos(true - nu), math.sin(true - nu)
        h = math.sqrt(mu * self.axis * (1 - e * e))
        return (c * self.orbit["radial"] + s * self.orbit["along"], c * self.orbit["along"] - s * self.orbit["radial"], r, mu / h * e * math.sin(true),
                h / (r * r))

    def flux(self, t: Any) -> tuple[Floats, Floats]:
        """The magnetic flux density and its rate."""
        field, kind = self.field, self.field["magnetic"]
        B, k = field["flux_density"], field["axis"]
        if kind == "rotating":
            along, ahead = k * float(k @ B), _cross(k, B)
            c, s, rate = self.maths.cos(field["rate"] * t), self.maths.sin(field["rate"] * t), field["rate"]
            return along + (B - along) * c + ahead * s, (ahead * c - (B - along) * s) * rate
        if kind != "dipole":
            return B, np.zeros(3)
        radial, on, r, climb, turn = self.place(t)
        b = field["strength"] * (field["radius"] / r) ** 3
        shape = k - radial * (3 * (k @ radial))
        return shape * b, shape * (-3 * climb / r * b) - (radial * (k @ on) + on * (k @ radial)) * (3 * b * turn)


class Rival:
    """By the time since the start: attitude (x, y, z, w), M and the momenta of wheels that turn by themselves over a size that they have; the attitude is not normalised."""

    def __init__(self, physics: Mapping[str, Any]) -> None:
        begin = physics.get("start_time", 0.0)
        self.scene = scene = since(begin, posed(**{name: value for name, value in physics.items() if name != "start_time"}))
        self.times = np.zeros(0)
        self.body, self.surroundings = scene["body"], Surroundings(scene)
        wheels = [each for each in scene["wheels"] if each["type"] != "locked"]
        own = [each for each in wheels if each["type"] != "held"]
        self.held = [(each["axial_inertia"] * each["axis"], _table(each["table"]) if each["table"] else lambda t, rate=each["rate"]: [rate])
                     for each in wheels if each["type"] == "held"]
        self.axes = np.array([each["axis"] for each in own]).reshape(-1, 3)
        self.axial = np.array([each["axial_inertia"] for each in own])
        self.drive = [_drive(each) for each in own]
        self.slope = np.array([each["slope"] + each["friction"] if each["type"] == "motor" else each["friction"] if each["type"] != "free" else 0.0
                               for each in own])
        self.inverse = np.linalg.inv(self.body["inertia"] - np.einsum("k,ki,kj->ij", self.axial, self.axes, self.axes))
        self.torques = self._torques(NUMBERS)
        w = scene["initial"]["angular_velocity"]
        p = self.axial * (np.array([each["rate"] for each in own]) + self.axes @ w)
        M = self.body["inertia"] @ w + self._given(0.0) + (p - self.axial * (self.axes @ w)) @ self.axes
        self.size = float(np.linalg.norm(M) + np.sum(np.abs(p))) or float(np.max(self.body["inertia"])) * max(self.forcing, 1e-3)
        self.start = np.concatenate([scene["initial"]["attitude"], M / self.size, p / self.size])
        tables = [each[name]["times"] for each in (*scene["wheels"], *scene["torques"]) for name in ("table", "factor_table") if each.get(name)]
        self.cuts = tuple(sorted({float(t) for times in (*tables, *(each["on"].ravel() for each in scene["torques"])) for t in times if t > 0}))

    @property
    def forcing(self) -> float:
        """The greatest rate of orbit, field and waves [rad/s]."""
        field = abs(self.scene["field"]["rate"]) if self.scene["field"]["magnetic"] == "rotating" else 0.0
        waves = [abs(each["rate"]) for each in self.scene["torques"] if each["amplitude"]]
        return float(max([self.surroundings.mean, field, *waves]))

    def _given(self, t: float) -> Floats:
        """The momentum of held wheels, and of those not listed."""
        made: Floats = self.body["rotor_momentum"]
        for arm, rate in self.held:
            made = made + arm * float(rate(t)[0])
        return made

    def _rate(self, t: Any, state: Floats) -> Floats:
        carried = sum((p * axis for p, axis in zip(state[7:], self.axes, strict=True)), np.zeros(3))
        made: Floats = self.inverse @ (self.size * (state[4:7] - carried) - self._given(t))
        return made

    def _torques(self, maths: Maths) -> list[tuple[Callable[[Any], Any], Callable[[Any, Floats, Floats, Floats], Floats]]]:
        """Factor and law of each."""
        around = Surroundings(self.scene, maths)
        return [(_factor(each, maths), self._torque(each, around)) for each in self.scene["torques"]]

    def _torque(self, torque: Mapping[str, Any], around: Surroundings) -> Callable[[Any, Floats, Floats, Floats], Floats]:
        """A torque of t, the rotation, w and M, body axes."""
        kind, vector, matrix, body = torque["type"], torque["vector"], torque["matrix"], self.body
        field, J = self.scene["field"], self.body["inertia"]
        table = _table(torque["table"]) if torque["table"] else None

        def in_body(t: float, R: Floats, v: Floats) -> Floats:
            if torque["axes"] == "orbit":
                radial, along = around.place(t)[:2]
                v = v[0] * radial + v[1] * along + v[2] * _cross(radial, along)
            return v if torque["axes"] == "body" else R.T @ v

        def opposed(w: Floats, M: Floats) -> Floats:
            known: dict[str, Floats] = {"angular-velocity": w, "momentum": M, "carrier-momentum": J @ w}
            return known[torque["opposed"]]

        def gradient(t: float, R: Floats, w: Floats, M: Floats) -> Floats:
            if torque["gradient"] is not None:
                size, d = torque["gradient"], R.T @ field["down"]
            else:
                radial, _, r, _, _ = around.place(t)
                size, d = 3 * around.orbit["mu"] / r**3, R.T @ radial
            made: Floats = size * _cross(d, J @ d)
            return made

        def eddy(t: float, R: Floats, w: Floats, M: Floats) -> Floats:
            flux, rate = around.flux(t)
            B = R.T @ flux
            made: Floats = _cross(matrix @ (_cross(w, B) - R.T @ rate), B)
            return made

        def brake(t: float, R: Floats, w: Floats, M: Floats) -> Floats:
            U = opposed(w, M)
            made: Floats = -vector * U / around.maths.sqrt(U @ U)
            return made

        arm = torque["point"] - (0.0 if body["fixed"] else body["centre_of_mass"])
        laws: dict[str, Callable[[float, Floats, Floats, Floats], Any]] = {
            "constant": lambda t, R, w, M: in_body(t, R, vector), "table": lambda t, R, w, M: in_body(t, R, table(t)) if table else None,
            "damping": lambda t, R, w, M: -matrix @ opposed(w, M), "brake": brake, "gravity-gradient": gradient, "eddy-current": eddy,
            "weight": lambda t, R, w, M: body["mass"] * field["gravity"] * _cross(body["centre_of_mass"], R.T @ field["down"]),
            "magnetic": lambda t, R, w, M: _cross(vector, R.T @ around.flux(t)[0]),
            "thrust": lambda t, R, w, M: _cross(arm, in_body(t, R, vector)), "charge": lambda t, R, w, M: _cross(w, vector)}
        return laws[kind]

    def columns(self, states: Floats) -> dict[str, Any]:
        """(n, numbers), at the times that are charted, -> columns."""
        rates = np.array([self._rate(float(t), state) for t, state in zip(self.times, states, strict=True)])
        return {"attitude": states[:, :4], "angular_velocity": rates}

    def right(self) -> Callable[[float, Floats], Floats]:
        """The right-hand side in Python."""
        return lambda t, state: self._flow(t, state, _rotation(state), self.torques)

    def _flow(self, t: Any, state: Floats, R: Floats, torques: list[tuple[Callable[[Any], Any], Callable[[Any, Floats, Floats, Floats], Floats]]]) -> Floats:
        w, M = self._rate(t, state), self.size * state[4:7]
        torque = _cross(M, w)
        for factor, one in torques:
            share = factor(t)
            if not isinstance(share, float) or share:
                torque = torque + one(t, R, w, M) * share
        x, y, z, q = state[:4].tolist()
        o1, o2, o3 = w.tolist()
        turning = (q * o1 + y * o3 - z * o2, q * o2 + z * o1 - x * o3, q * o3 + x * o2 - y * o1, -(x * o1 + y * o2 + z * o3))
        push = np.array([drive(t) for drive in self.drive]) - self.slope * (self.size * state[7:] / self.axial - self.axes @ w)
        return np.concatenate([0.5 * np.array(turning), torque / self.size, push / self.size])

    def system(self, heyoka: Any) -> list[Any]:
        """For heyoka, with the quaternion as it stands. Raises Unanswered for laws that change at single times, and on an ellipse."""
        parts = (*self.scene["wheels"], *self.scene["torques"])
        if any(each.get(name) for each in parts for name in ("table", "factor_table")) or any(len(each["on"]) for each in self.scene["torques"]):
            raise Unanswered("tables and intervals are not written for it")
        if self.scene["orbit"] and self.scene["orbit"]["eccentricity"]:
            raise Unanswered("orbits but circles are not written for it")
        names = ("x", "y", "z", "w", "M1", "M2", "M3", *(f"p{i}" for i in range(len(self.axial))))
        state = np.array(heyoka.make_vars(*names), dtype=object)
        made = self._flow(heyoka.time, state, _matrix(state[:4]), self._torques(Maths(heyoka.cos, heyoka.sin, heyoka.sqrt)))
        return [(one, rate if isinstance(rate, heyoka.expression) else heyoka.expression(float(rate))) for one, rate in zip(state, made, strict=True)]


def _drive(wheel: Mapping[str, Any]) -> Callable[[float], float]:
    """What drives a wheel, without what its rate takes away [N m]."""
    constant = wheel["slope"] * wheel["no_load_rate"] if wheel["type"] == "motor" else wheel["torque"] if wheel["type"] == "torque" else 0.0
    table = _table(wheel["table"]) if wheel["table"] else None
    return lambda t: float(constant if table is None else constant + table(t)[0])
