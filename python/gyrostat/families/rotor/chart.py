# SPDX-License-Identifier: BSD-3-Clause
"""The chart of a gyrostat with a driven rotor: what is measured, how far, and the equations for rivals."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.charts.problem import MOST_TURNS, TURNING, Measure, Problem, counted, first_turns, reference, tensor, true_errors
from gyrostat.families.rotor.functions import integrate, solve
from gyrostat.families.rotor.scene import arguments

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["problem"]

Vectors = NDArray[np.float64]

MEASURES: Final = (
    TURNING[0],
    Measure("angular_velocity", "error of Omega", "the angular velocity of the carrier", "greatest true error, relative to the greatest |Ω| [1]"))
# Where the motor relaxes so often in a turn Radau makes the reference: Taylor steps keep exciting what has relaxed.
STIFF: Final = 30.0 * 2 * math.pi
# An explicit step is at most so many relaxation times long.
STABLE: Final = 6.0


def problem(scene: "Scene") -> Problem:
    """The scene, or its first part where the whole is too long."""
    given = arguments(scene)
    rate, relaxing = _rates(given)
    given["times"], cut = first_turns(given["times"], lambda end: rate * end, MOST_TURNS)
    physics = {key: value for key, value in given.items() if key not in ("tolerance", "model", "integrator")}
    want, source = reference(integrate, physics, "radau" if relaxing > STIFF * rate else "taylor")
    end = float(given["times"][-1])
    title = (f"{counted(len(given['times']), 'time')} to {end:.6g} s{cut}\n{rate * end:.3g} turns at most, {relaxing * end:.3g} "
             f"relaxation times of the motor; {source}")
    return Problem(title, MEASURES, solve, given, integrate, physics, lambda made: true_errors(made, want), Rival(physics),
                   end * max(relaxing / STABLE, 10 * rate), (("radau", "Radau IIA", "radau"),))


def _start(given: Mapping[str, Any]) -> tuple[Vectors, Vectors, float]:
    """R^-1, H and p at the start, body axes."""
    theta, e, lam = tensor(given["inertia"]), np.asarray(given["axis"], dtype=float), given["axial_inertia"]
    Omega = np.asarray(given["angular_velocity"], dtype=float)
    H = theta @ Omega + lam * given["rotor_rate"] * e
    return np.linalg.inv(theta - lam * np.outer(e, e)), H, lam * (given["rotor_rate"] + float(e @ Omega))


def _rates(given: Mapping[str, Any]) -> tuple[float, float]:
    """Bound of the turns in a second, and relaxation times of the motor in a second."""
    inverse, H, p = _start(given)
    e, lam = np.asarray(given["axis"], dtype=float), given["axial_inertia"]
    wheel = max(abs(p), lam * abs(given["no_load_rate"]))
    fastest = float(np.linalg.eigvalsh(inverse)[-1]) * (float(np.linalg.norm(H)) + wheel) / (2 * math.pi)
    return max(fastest, 1e-300), given["slope"] / lam * (1 + lam * float(e @ inverse @ e))


class Rival:
    """Attitude (x, y, z, w), H and p over the size that they reach; the attitude is not normalised."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        self.inverse, H, p = _start(given)
        self.axis = np.asarray(given["axis"], dtype=float)
        self.axial, self.slope, self.no_load = (float(given[name]) for name in ("axial_inertia", "slope", "no_load_rate"))
        self.size = float(np.linalg.norm(H)) + self.axial * abs(self.no_load) + abs(p) or 1.0
        self.start = np.concatenate([np.asarray(given["attitude"], dtype=float), H / self.size, [p / self.size]])

    def columns(self, states: Vectors) -> dict[str, Any]:
        """(n, 8) -> columns."""
        return {"attitude": states[:, :4], "angular_velocity": self.size * (states[:, 4:7] - states[:, 7:] * self.axis) @ self.inverse}

    def right(self) -> Callable[[float, Vectors], Vectors]:
        """The right-hand side in Python."""
        inverse, e, lam, slope, no_load = self.size * self.inverse, self.axis, self.axial / self.size, self.slope / self.size, self.no_load

        def right(_: float, state: Vectors) -> Vectors:
            x, y, z, w, H1, H2, H3, p = state.tolist()
            Omega = inverse @ (state[4:7] - p * e)
            o1, o2, o3 = Omega.tolist()
            rate = p / lam - float(e @ Omega)
            return np.array([0.5 * (w * o1 + y * o3 - z * o2), 0.5 * (w * o2 + z * o1 - x * o3), 0.5 * (w * o3 + x * o2 - y * o1),
                             -0.5 * (x * o1 + y * o2 + z * o3), H2 * o3 - H3 * o2, H3 * o1 - H1 * o3, H1 * o2 - H2 * o1,
                             -slope * (rate - no_load)])

        return right

    def system(self, heyoka: Any) -> list[Any]:
        """The right-hand side for heyoka."""
        names = heyoka.make_vars("x", "y", "z", "w", "h1", "h2", "h3", "p")
        x, y, z, w, *H, p = names
        inverse, e = self.size * self.inverse, self.axis.tolist()
        carrier = [H[i] - e[i] * p if e[i] else H[i] for i in range(3)]
        o = [heyoka.sum([float(inverse[i, j]) * carrier[j] for j in range(3) if inverse[i, j] != 0]) for i in range(3)]
        rate = self.size / self.axial * p - heyoka.sum([e[i] * o[i] for i in range(3) if e[i]])
        rates = [0.5 * (w * o[0] + y * o[2] - z * o[1]), 0.5 * (w * o[1] + z * o[0] - x * o[2]), 0.5 * (w * o[2] + x * o[1] - y * o[0]),
                 -0.5 * (x * o[0] + y * o[1] + z * o[2]), H[1] * o[2] - H[2] * o[1], H[2] * o[0] - H[0] * o[2], H[0] * o[1] - H[1] * o[0],
                 -self.slope / self.size * (rate - self.no_load)]
        return list(zip(names, rates, strict=True))
