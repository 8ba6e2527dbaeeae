# SPDX-License-Identifier: BSD-3-Clause
"""A general scene by a clock that began before its start: laws that know the time, as the compiled ladder takes them, whose clock begins with the motion."""

import math
from typing import Any

import numpy as np

from gyrostat.broadcast import Floats

__all__ = ["orbit_since", "since"]

Data = dict[str, Any]


def since(start: float, scene: Data) -> Data:
    """The scene with its tables, waves, fields and orbit told by the time since `start` [s]."""
    if start == 0:
        return scene
    return {**scene, "wheels": [{**each, "table": _table(start, each["table"])} for each in scene["wheels"]],
            "torques": [_torque(start, each) for each in scene["torques"]], "orbit": None if scene["orbit"] is None else orbit_since(start, scene["orbit"]),
            "field": _field(start, scene["field"])}


def _table(start: float, table: Data | None) -> Data | None:
    return None if table is None else {**table, "times": table["times"] - start}


def _torque(start: float, torque: Data) -> Data:
    return {**torque, "table": _table(start, torque["table"]), "factor_table": _table(start, torque["factor_table"]),
            "phase": math.remainder(torque["phase"] + math.remainder(torque["rate"] * start, 2 * math.pi), 2 * math.pi), "on": torque["on"] - start}


def _turned(vector: Floats, axis: Floats, angle: float) -> Floats:
    along = float(vector @ axis) * axis
    turned: Floats = along + math.cos(angle) * (vector - along) + math.sin(angle) * np.cross(axis, vector)
    return turned


def _field(start: float, field: Data) -> Data:
    return {**field, "flux_density": _turned(field["flux_density"], field["axis"], math.remainder(field["rate"] * start, 2 * math.pi))} if field["rate"] else field


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
    mean = E - e * math.sin(E) + math.sqrt(orbit["mu"] / (parameter / (1 - e * e)) ** 3) * start
    anomaly = _true_anomaly(math.remainder(mean, 2 * math.pi), e)
    normal = np.cross(orbit["radial"], orbit["along"])
    return {**orbit, "radius": parameter / (1 + e * math.cos(anomaly)), "true_anomaly": anomaly,
            "radial": _turned(orbit["radial"], normal, anomaly - first), "along": _turned(orbit["along"], normal, anomaly - first)}
