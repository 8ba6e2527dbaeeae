# SPDX-License-Identifier: BSD-3-Clause
"""The end of a scene as the start of another: state, what is left of it where the body has changed, and by how much it may be off."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.broadcast import Floats
from gyrostat.errors import DomainError
from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from gyrostat.answer import Answer
    from gyrostat.scenes import Scene

__all__ = ["End", "end_of"]

EPS: Final = 2.0**-52


@dataclass(frozen=True, slots=True)
class End:
    """A motion at its last time; the errors are absolute."""

    attitude: Floats  # (4,)
    angular_velocity: Floats  # (3,), body axes [rad/s]
    angular_momentum: Floats  # (3,), body axes [N m s]
    wheels: Mapping[str | int, tuple[float, float]]  # name -> rate [rad/s] and angle [rad] relative to the body; those without a name by their place, 1, 2 ...
    fixed: bool
    mass: float
    centre_of_mass: Floats  # (3,) from the body's origin, body axes [m]
    velocity: Floats  # (3,) of the mass centre, or of the origin of a fixed body, inertial axes [m/s]
    position: Floats  # (3,) [m]
    error: Mapping[str, float]

    def momentum(self, released: bool) -> tuple[Floats, float]:
        """The angular momentum, body axes, of a body that is let go about its mass centre, and by how much it may be off."""
        if not released:
            return self.angular_momentum, self.error["angular_momentum"]
        c, m = self.centre_of_mass, self.mass
        return self.angular_momentum - m * np.cross(c, np.cross(self.angular_velocity, c)), self.error["angular_momentum"] + m * float(c @ c) * self.error["angular_velocity"]

    def moved(self, centre_of_mass: Floats) -> tuple[Floats, Floats]:
        """Velocity and position of the mass centre of a body that is free from now on."""
        R = matrix_from_quaternion(self.attitude)
        arm = centre_of_mass - (np.zeros(3) if self.fixed else self.centre_of_mass)
        return self.velocity + R @ np.cross(self.angular_velocity, arm), self.position + R @ arm

    def off_path(self, centre_of_mass: Floats) -> dict[str, float]:
        """By how much these two may be off."""
        arm = float(np.linalg.norm(centre_of_mass - (np.zeros(3) if self.fixed else self.centre_of_mass)))
        turn, rate, omega = self.error["attitude"], self.error["angular_velocity"], float(np.linalg.norm(self.angular_velocity))
        return {"velocity": self.error.get("velocity", 0.0) + arm * (rate + omega * turn), "position": self.error.get("position", 0.0) + arm * turn}


def _stays_at_rest(torques: Sequence[Mapping[str, Any]]) -> bool:
    """Whether torques that stop a body let it rest from then on: brakes, and what goes with the rates, all of them always."""
    kinds = {torque["type"] for torque in torques}
    return "brake" in kinds and kinds <= {"brake", "damping"} and all(torque["on"] is None and torque["factor"] is None for torque in torques)


def _rests(answer: "Answer", time: float) -> bool:
    """Whether a body that has stopped for good has done so by then, s."""
    stop, off = answer.scalars["stop_time"], answer.scalar_error["stop_time"]
    return stop is not None and off is not None and time > stop * (1 + off)


@lru_cache(maxsize=16)
def end_of(scene: "Scene") -> End:
    """The end of a scene of any kind, by the cheapest rung that meets its own tolerance, or comes nearest to it. Raises DomainError where it is not known."""
    from gyrostat.families import FAMILIES
    from gyrostat.families.general.rewrite import as_general

    told = as_general(scene)
    names = [wheel["name"] or place for place, wheel in enumerate(told.top["wheel"], 1)]
    fixed = bool(told.tables["body"]["fixed"])
    ask = ["attitude", "angular_velocity", "angular_momentum", *(("rotor_rate", "rotor_angle") if names else ()), *(() if fixed else ("velocity", "position"))]
    last = float(scene.times[-1])
    general = FAMILIES["general"]
    stops = _stays_at_rest(told.top["torque"])
    given = {**general.arguments(told.replace(**{"solve.ask": [*ask, *(["stop_time"] if stops else [])]})), "times": np.array([last])}  # which lies before 0 where the clock began there
    answer = general.solve(**given)
    error = {name: answer.error[name] * (1.0 if name == "attitude" else max(answer.scale[name], float(np.linalg.norm(answer[name])))) for name in ask}
    for name in ask:
        if not math.isfinite(error[name]) or not np.all(np.isfinite(answer[name])):
            raise DomainError(f"from: the end of {scene.name} is not known: rung {answer.model} states no error of {name} there; ask for a shorter span of it, or "
                              "give [initial]")
    row = {name: answer[name][-1] for name in ask}
    if stops and _rests(answer, last):
        error.update({name: 0.0 for name in ask if name in ("angular_velocity", "angular_momentum") and not np.any(row[name])})
    still = np.zeros(3)
    turning = zip(row["rotor_rate"].tolist(), row["rotor_angle"].tolist(), strict=True) if names else ()
    return End(row["attitude"], row["angular_velocity"], row["angular_momentum"], dict(zip(names, turning, strict=True)), fixed,
               1.0 if given["mass"] is None else float(given["mass"]), given["centre_of_mass"], row.get("velocity", still), row.get("position", still), error)
