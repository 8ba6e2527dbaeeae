# SPDX-License-Identifier: BSD-3-Clause
"""The rotations that last for a free body with wheels, and whether they are stable: table, report and figure."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from gyrostat.drawing import new_figure
from gyrostat.errors import DomainError
from gyrostat.families.free.figures import sphere
from gyrostat.families.free.functions import permanent_rotations, solve
from gyrostat.families.free.scene import arguments
from gyrostat.scenes import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gyrostat.broadcast import Floats

__all__ = ["plot", "report", "sentence", "tables"]


def _body(given: Mapping[str, Any]) -> dict[str, Any]:
    return {name: given[name] for name in ("inertia", "rotor_momentum", "wheels", "angular_velocity", "angular_momentum")}


def report(scene: Scene) -> dict[str, Any]:
    """The permanent rotations with the momentum of the start, as plain data.

    rotations : by ascending energy, each with angular_velocity [rad/s], energy [J], stable, isolated (false: it stands for a circle of them, as of a
    body with two equal moments about any axis in their plane, and what is beside it leaves in proportion to time), frequency of small oscillations
    about it [rad/s] (None where there are none) and growth rate of what leaves it [1/s] (None where nothing grows so); motion : what the start does.
    Raises DomainError where the momentum is zero.
    """
    given = arguments(scene)
    try:
        found = permanent_rotations(**_body(given))
    except DomainError:
        raise DomainError("initial: the body has no momentum, or turns about any axis alike: nothing tells one rotation from another; give it a momentum, "
                          "or moments that differ") from None
    rotations = [_rotation(*one) for one in zip(found.angular_velocity, found.energy, found.square, found.isolated, found.stable, strict=True)]
    answer = solve(**{**given, "times": [0.0], "model": "closed-form", "ask": ["kind", "period", "modulus_squared", "energy"]})
    return {"scene": scene.name, "rotations": rotations, "motion": {name: _finite(answer.scalars[name]) for name in ("kind", "period", "modulus_squared", "energy")}}


def _rotation(rate: "Floats", energy: float, square: float, isolated: bool, stable: bool) -> dict[str, Any]:
    """One of the rotations as plain data; `square` is that of the frequency of small oscillations."""
    return {"angular_velocity": rate.tolist(), "energy": float(energy), "stable": bool(stable), "isolated": bool(isolated),
            "frequency": math.sqrt(square) if stable else None, "growth_rate": math.sqrt(-square) if isolated and not stable else None}


def _finite(value: Any) -> Any:
    """None for a number that is not finite."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _text(value: float | None) -> str:
    return "-" if value is None else f"{value:.6g}"


def tables(report: Mapping[str, Any]) -> list[tuple[str, list[str], list[list[str]]]]:
    """For the terminal."""
    verdicts = ("stable" if r["stable"] else "unstable" if r["isolated"] else "one of a circle" for r in report["rotations"])
    rows = [[", ".join(f"{x:.6g}" for x in r["angular_velocity"]), _text(r["energy"]), verdict, _text(r["frequency"]), _text(r["growth_rate"])]
            for r, verdict in zip(report["rotations"], verdicts, strict=True)]
    return [("Rotations that last, with the momentum of the start",
             ["angular velocity [rad/s]", "energy [J]", "", "frequency [rad/s]", "growth rate [1/s]"], rows)]


def sentence(report: Mapping[str, Any]) -> str:
    """What the start does."""
    motion = report["motion"]
    energy, period = motion["energy"], motion["period"]
    words = {"about-largest": "the momentum goes round near the axis of the greatest moment",
             "about-smallest": "the momentum goes round near the axis of the least moment",
             "one-component": "the momentum goes round all the rotations of one kind", "separatrix": "the motion runs from one unstable rotation to another",
             "steady": "the start is one of them", "spherical": "the angular velocity goes round the momentum of the wheels"}[str(motion["kind"])]
    return f"From this start {words}" + (f", once in {period:.6g} s" if period is not None and math.isfinite(period) else "") + f", at {energy:.6g} J."


def plot(scene: Scene, report: Mapping[str, Any]) -> "Figure":
    """The momentum sphere with the rotations, the separatrix and the path from the start."""
    given = arguments(scene)
    period = report["motion"]["period"]
    end = period if period is not None and math.isfinite(period) else float(given["times"][-1])
    answer = solve(**{**given, "times": np.linspace(0.0, end, 721), "model": "closed-form", "tolerance": 1e-3, "ask": None})
    figure = new_figure(8.5, 6.5)
    sphere(_body(given), all_unstable=True)(figure.add_subplot(), answer)
    figure.suptitle(f"Rotations that last: {scene.name}", fontsize=13)
    return figure
