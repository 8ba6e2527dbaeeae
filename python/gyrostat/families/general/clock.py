# SPDX-License-Identifier: BSD-3-Clause
"""A general scene by a clock that began before its start: laws that know the time, as the compiled ladder takes them, whose clock begins with the motion."""

import math
from decimal import Decimal, localcontext
from typing import Any

import numpy as np

from gyrostat.broadcast import Floats

__all__ = ["PI", "orbit_since", "phase", "since"]

Data = dict[str, Any]

PI = Decimal("3.141592653589793238462643383279502884197169399375105820974944592307816406286208998628034825342117068")
DIGITS = 100  # of intermediate results


def since(start: float, scene: Data) -> Data:
    """The scene with its tables, waves, fields and orbit told by the time since `start` [s]."""
    if start == 0:
        return scene
    tables = [each["table"] for each in (*scene["wheels"], *scene["torques"])] + [each["factor_table"] for each in scene["torques"]]
    told = [table["times"] for table in tables if table is not None] + [each["on"] for each in scene["torques"]]
    return {**scene, "wheels": [{**each, "table": _table(start, each["table"])} for each in scene["wheels"]],
            "torques": [_torque(start, each) for each in scene["torques"]], "orbit": None if scene["orbit"] is None else orbit_since(start, scene["orbit"]),
            "field": _field(start, scene["field"]), "clock": start, "retimed": max((_greatest_rounding(times, start) for times in told), default=0.0)}


def _greatest_rounding(times: Floats, start: float) -> float:
    """What times - start [s] is off by, at most: exactly (Knuth's two-sum)."""
    made = times - start
    part = made - times
    return float(np.max(np.abs((times - (made - part)) - (start + part)), initial=0.0))


def _table(start: float, table: Data | None) -> Data | None:
    return None if table is None else {**table, "times": table["times"] - start}


def _less_turns(angle: Decimal) -> Decimal:
    return angle - 2 * PI * (angle / (2 * PI)).to_integral_value()


def phase(rate: float | Decimal, time: float, first: float = 0.0) -> float:
    """rate time + first [rad] less whole turns, to one rounding however late the time is: a product of floats would be off by a rounding of all turns."""
    with localcontext(prec=DIGITS):
        return math.remainder(float(_less_turns(Decimal(rate) * Decimal(time) + Decimal(first))), 2 * math.pi)


def _sine_and_cosine(angle: Decimal) -> tuple[Decimal, Decimal]:
    x = _less_turns(angle)
    sums, term = [Decimal(0), Decimal(1)], Decimal(1)
    for k in range(1, 2 * DIGITS):
        term *= x / k if k % 2 else -x / k  # of the sine, x - x^3/3! + ..., and of the cosine by turns
        sums[1 - k % 2] += term
    return sums[0], sums[1]


def _mean_motion(orbit: Data) -> Decimal:
    """sqrt(mu/a^3), rad/s, a the semi-major axis: of what was given of the orbit, not of what was made of it."""
    told, e = orbit["told"], Decimal(orbit["eccentricity"])
    share, flat = 1 + e * _sine_and_cosine(Decimal(orbit["true_anomaly"]))[1], 1 - e * e
    if "period" in told:
        return 2 * PI / Decimal(told["period"])
    if "rate" in told:
        return Decimal(told["rate"]) * flat * flat.sqrt() / (share * share)
    radius = sum((Decimal(length) for length in told["lengths"]), Decimal(0))
    return (Decimal(orbit["mu"]) / (radius * share / flat) ** 3).sqrt()


def _torque(start: float, torque: Data) -> Data:
    return {**torque, "table": _table(start, torque["table"]), "factor_table": _table(start, torque["factor_table"]),
            "phase": phase(torque["rate"], start, torque["phase"]), "on": torque["on"] - start}


def _turned(vector: Floats, axis: Floats, angle: float) -> Floats:
    along = float(vector @ axis) * axis
    turned: Floats = along + math.cos(angle) * (vector - along) + math.sin(angle) * np.cross(axis, vector)
    return turned


def _field(start: float, field: Data) -> Data:
    return {**field, "flux_density": _turned(field["flux_density"], field["axis"], phase(field["rate"], start))} if field["rate"] else field


def _eccentric_anomaly(mean: Decimal, e: Decimal) -> Decimal:
    """By Kepler's equation, mean = E - e sin E, which Newton's method solves from pi without fail for e < 1."""
    E = PI.copy_sign(mean)
    for _ in range(200):
        sine, cosine = _sine_and_cosine(E)
        step = (E - e * sine - mean) / (1 - e * cosine)
        E -= step
        if abs(step) <= abs(E) * Decimal("1e-40"):
            break
    return E


def _direction(sine: Decimal, cosine: Decimal) -> float:
    return math.atan2(float(sine), float(cosine))


def orbit_since(start: float, orbit: Data) -> Data:
    """An orbit told by the time since `start` [s], to one rounding of each number however many turns that are."""
    if start == 0:
        return orbit
    with localcontext(prec=DIGITS):
        e = Decimal(orbit["eccentricity"])
        flat = ((1 - e) * (1 + e)).sqrt()
        sine, cosine = first = _sine_and_cosine(Decimal(orbit["true_anomaly"]))
        axis = Decimal(orbit["radius"]) * (1 + e * cosine) / (flat * flat)
        near = 1 + e * cosine
        # the eccentric anomaly, whose sine and cosine are known: a rounded one and the sine of what it lacks
        rounded = Decimal(_direction(flat * sine, e + cosine))
        of_rounded = _sine_and_cosine(rounded)
        E = rounded + (flat * sine / near) * of_rounded[1] - ((e + cosine) / near) * of_rounded[0]
        mean = _less_turns(E - e * flat * sine / near + _mean_motion(orbit) * Decimal(start))
        sine, cosine = _sine_and_cosine(_eccentric_anomaly(mean, e))
        near = 1 - e * cosine
        now = flat * sine / near, (cosine - e) / near
        along, across = float(now[1] * first[1] + now[0] * first[0]), float(now[0] * first[1] - now[1] * first[0])
        radial, forward = orbit["radial"], orbit["along"]
        return {**orbit, "radius": float(axis * near), "true_anomaly": _direction(*now),
                "radial": along * radial + across * forward, "along": along * forward - across * radial}
