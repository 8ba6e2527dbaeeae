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
    return {**scene, "wheels": [{**each, "table": _table(start, each["table"])} for each in scene["wheels"]],
            "torques": [_torque(start, each) for each in scene["torques"]], "orbit": None if scene["orbit"] is None else orbit_since(start, scene["orbit"]),
            "field": _field(start, scene["field"]), "clock": start}


def _table(start: float, table: Data | None) -> Data | None:
    return None if table is None else {**table, "times": table["times"] - start}


def _less_turns(angle: Decimal) -> Decimal:
    return angle - 2 * PI * (angle / (2 * PI)).to_integral_value()


def phase(rate: float | Decimal, time: float, first: float = 0.0) -> float:
    """rate time + first [rad] less whole turns, to one rounding however late the time is: a product of floats would be off by a rounding of all turns."""
    with localcontext(prec=DIGITS):
        return math.remainder(float(_less_turns(Decimal(rate) * Decimal(time) + Decimal(first))), 2 * math.pi)


def _cosine(angle: float) -> Decimal:
    square, sum_, term = _less_turns(Decimal(angle)) ** 2, Decimal(1), Decimal(1)
    for k in range(1, 2 * DIGITS, 2):
        term *= -square / (k * (k + 1))
        sum_ += term
    return sum_


def _mean_motion(orbit: Data) -> Decimal:
    """sqrt(mu/a^3), rad/s, a the semi-major axis."""
    with localcontext(prec=DIGITS):
        e = Decimal(orbit["eccentricity"])
        axis = Decimal(orbit["radius"]) * (1 + e * _cosine(orbit["true_anomaly"])) / (1 - e * e)
        return (Decimal(orbit["mu"]) / axis**3).sqrt()


def _torque(start: float, torque: Data) -> Data:
    return {**torque, "table": _table(start, torque["table"]), "factor_table": _table(start, torque["factor_table"]),
            "phase": phase(torque["rate"], start, torque["phase"]), "on": torque["on"] - start}


def _turned(vector: Floats, axis: Floats, angle: float) -> Floats:
    along = float(vector @ axis) * axis
    turned: Floats = along + math.cos(angle) * (vector - along) + math.sin(angle) * np.cross(axis, vector)
    return turned


def _field(start: float, field: Data) -> Data:
    return {**field, "flux_density": _turned(field["flux_density"], field["axis"], phase(field["rate"], start))} if field["rate"] else field


def _true_anomaly(mean: float, e: float) -> float:
    """By Kepler's equation, mean = E - e sin E, which Newton's method solves from pi without fail for e < 1."""
    E = math.copysign(math.pi, mean)
    for _ in range(100):
        step = (E - e * math.sin(E) - mean) / (1 - e * math.cos(E))
        E -= step
        if abs(step) <= 1e-15 * (1 + abs(E)):
            break
    return 2 * math.atan2(math.sqrt(1 + e) * math.sin(E / 2), math.sqrt(1 - e) * math.cos(E / 2))


def orbit_since(start: float, orbit: Data) -> Data:
    """An orbit told by the time since `start` [s]."""
    if start == 0:
        return orbit
    e, first, radius = orbit["eccentricity"], orbit["true_anomaly"], orbit["radius"]
    parameter = radius * (1 + e * math.cos(first))
    E = 2 * math.atan2(math.sqrt(1 - e) * math.sin(first / 2), math.sqrt(1 + e) * math.cos(first / 2))
    anomaly = _true_anomaly(phase(_mean_motion(orbit), start, E - e * math.sin(E)), e)
    normal = np.cross(orbit["radial"], orbit["along"])
    return {**orbit, "radius": parameter / (1 + e * math.cos(anomaly)), "true_anomaly": anomaly,
            "radial": _turned(orbit["radial"], normal, anomaly - first), "along": _turned(orbit["along"], normal, anomaly - first)}
