# SPDX-License-Identifier: BSD-3-Clause
"""The chart of a thrusting spinner: what is measured, how far, and the equations for rivals."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.charts.problem import MOST_TURNS, Measure, Problem, counted, first_turns, greatest, reference, relative
from gyrostat.families.spinning.functions import integrate, solve
from gyrostat.families.spinning.scene import arguments
from gyrostat.rotation import angle_between, quaternion_from_euler_312

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["problem", "true_errors"]

Vectors = NDArray[np.float64]

ATTITUDE: Final = Measure("attitude", "error of attitude", "the attitude", "greatest true error, angle [rad]")
# The second measure: the velocity, or without thrust the rates.
VELOCITY: Final = Measure("velocity", "error of velocity", "the velocity of the mass centre", "greatest true error, relative to the greatest |v| [1]")
RATES: Final = Measure("angular_velocity", "error of omega", "the angular velocity", "greatest true error, relative to the greatest |ω| [1]")


def true_errors(made: Mapping[str, Any], want: Mapping[str, Any]) -> dict[str, float]:
    """Greatest angle between the attitudes, and greatest differences of rates and velocities over the greatest wanted."""
    return {"attitude": greatest(angle_between(made["attitude"], want["attitude"])),
            **{key: relative(made[key], want[key]) for key in ("angular_velocity", "velocity")}}


def problem(scene: "Scene") -> Problem:
    """The scene, or its first part where the whole is too long."""
    given = arguments(scene)
    given["times"], cut = first_turns(given["times"], lambda end: _rate(given, end) * end, MOST_TURNS)
    physics = {key: value for key, value in given.items() if key not in ("tolerance", "model", "integrator")}
    want, source = reference(integrate, physics)
    end = float(given["times"][-1])
    turns = float(np.mean(np.linalg.norm(want["angular_velocity"], axis=1))) * end / (2 * math.pi)
    title = (f"{counted(len(given['times']), 'time')} to {end:.6g} s{cut}\nabout {turns:.3g} turns; {source}")
    return Problem(title, (ATTITUDE, VELOCITY if np.any(given["force"]) else RATES), solve, given, integrate, physics,
                   lambda made: true_errors(made, want), Rival(physics), 10 * _rate(given, end) * end)


def _rate(given: Mapping[str, Any], end: float) -> float:
    """Roughly the most turns and nutations in a second until `end`."""
    D, M, omega = (np.asarray(given[name], dtype=float) for name in ("inertia", "torque", "angular_velocity"))
    gyroscopic = abs(given["rotor_momentum"] - given["charge_momentum"]) / float(D.min())
    drive = float(np.linalg.norm(M[:2] / D[:2]))
    spin = float(np.linalg.norm(omega)) + abs(float(M[2] / D[2])) * end
    return float(max((2 * spin + gyroscopic + min(drive * end, math.sqrt(drive))) / (2 * math.pi), 1e-300))


class Rival:
    """Rates, quaternion, velocity and position over their sizes."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        self.D, self.M, self.f = (np.asarray(given[name], dtype=float) for name in ("inertia", "torque", "force"))
        self.Lambda = float(given["rotor_momentum"] - given["charge_momentum"])
        self.a = self.f / given["mass"]
        end = float(given["times"][-1])
        omega, v, x = (np.asarray(given[name], dtype=float) for name in ("angular_velocity", "velocity", "position"))
        rate = 2 * math.pi * _rate(given, end)
        push = float(np.linalg.norm(self.a))
        v_size = float(np.linalg.norm(v)) + push * end or 1.0
        x_size = float(np.linalg.norm(x)) + v_size * end or 1.0
        self.unit = np.array([rate] * 3 + [1.0] * 4 + [v_size] * 3 + [x_size] * 3)
        q = quaternion_from_euler_312(given["euler_312"])
        self.start = np.concatenate([omega, q, v, x]) / self.unit

    def columns(self, states: Vectors) -> dict[str, Any]:
        """(n, 13) -> columns; the attitude is not normalised."""
        numbers = states * self.unit
        return {"angular_velocity": numbers[:, :3], "attitude": numbers[:, 3:7], "velocity": numbers[:, 7:10]}

    def right(self) -> Callable[[float, Vectors], Vectors]:
        """The right-hand side in Python."""
        D1, D2, D3 = self.D.tolist()
        M1, M2, M3 = self.M.tolist()
        a1, a2, a3 = self.a.tolist()
        Lambda, unit = self.Lambda, self.unit

        def right(_: float, state: Vectors) -> Vectors:
            p, q, r, x, y, z, w, v1, v2, v3 = (state * unit)[:10].tolist()
            made: Vectors = np.array([
                (M1 - q * ((D3 - D2) * r + Lambda)) / D1, (M2 + p * ((D3 - D1) * r + Lambda)) / D2, (M3 - (D2 - D1) * p * q) / D3,
                0.5 * (w * p + y * r - z * q), 0.5 * (w * q + z * p - x * r), 0.5 * (w * r + x * q - y * p), -0.5 * (x * p + y * q + z * r),
                a1 * (1 - 2 * (y * y + z * z)) + a2 * 2 * (x * y - w * z) + a3 * 2 * (x * z + w * y),
                a1 * 2 * (x * y + w * z) + a2 * (1 - 2 * (x * x + z * z)) + a3 * 2 * (y * z - w * x),
                a1 * 2 * (x * z - w * y) + a2 * 2 * (y * z + w * x) + a3 * (1 - 2 * (x * x + y * y)), v1, v2, v3]) / unit
            return made

        return right

    def system(self, heyoka: Any) -> list[Any]:
        """The right-hand side for heyoka."""
        names = heyoka.make_vars("p", "q", "r", "x", "y", "z", "w", "v1", "v2", "v3", "x1", "x2", "x3")
        p, q, r, x, y, z, w, v1, v2, v3 = names[:10]
        D1, D2, D3 = self.D.tolist()
        Lambda = self.Lambda
        rate, v_size, x_size = (float(self.unit[i]) for i in (0, 7, 10))
        M, a = (self.M / rate).tolist(), (self.a / v_size).tolist()
        tensor = [[1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
                  [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
                  [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)]]
        still = 0.0 * p
        pushed = [heyoka.sum([a[j] * row[j] for j in range(3) if a[j]]) if any(a) else still for row in tensor]
        turn = rate / 2
        rates = [(M[0] - q * (rate * (D3 - D2) * r + Lambda)) / D1, (M[1] + p * (rate * (D3 - D1) * r + Lambda)) / D2,
                 (M[2] - rate * (D2 - D1) * p * q) / D3,
                 turn * (w * p + y * r - z * q), turn * (w * q + z * p - x * r), turn * (w * r + x * q - y * p),
                 -turn * (x * p + y * q + z * r), *pushed, *(v_size / x_size * v for v in (v1, v2, v3))]
        return list(zip(names, rates, strict=True))
