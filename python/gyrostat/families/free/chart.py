# SPDX-License-Identifier: BSD-3-Clause
"""The chart of a free body with wheels: what is measured, how far, and the equations for rivals."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat.charts.problem import MOST_TURNS, TURNING, Problem, counted, first_turns, reference, true_errors
from gyrostat.families.free.functions import integrate, reduced, solve
from gyrostat.families.free.scene import arguments

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["problem"]

Vectors = NDArray[np.float64]


def problem(scene: "Scene") -> Problem:
    """The scene, or its first part where the whole is too long."""
    given = arguments(scene)
    rate = Rival(given).rate / (2 * math.pi)
    given["times"], cut = first_turns(given["times"], lambda end: rate * end, MOST_TURNS)
    physics = {key: value for key, value in given.items() if key not in ("tolerance", "model", "integrator", "view")}
    want, source = reference(integrate, physics, "taylor")
    end = float(given["times"][-1])
    title = f"{counted(len(given['times']), 'time')} to {end:.6g} s{cut}\n{rate * end:.3g} turns at most; {source}"
    return Problem(title, TURNING, solve, given, integrate, physics, lambda made: true_errors(made, want), Rival(physics), end * 10 * rate)


class Rival:
    """Attitude (x, y, z, w) and M over its size; the attitude is not normalised."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        inertia, self.l, M = reduced(given)
        self.inverse = np.linalg.inv(inertia)
        self.size = float(np.linalg.norm(M)) or 1.0
        self.start = np.concatenate([np.asarray(given["attitude"], dtype=float), M / self.size])
        self.rate = max(float(np.linalg.eigvalsh(self.inverse)[-1]) * self.size + float(np.linalg.norm(self.inverse @ self.l)), 1e-300)

    def columns(self, states: Vectors) -> dict[str, Any]:
        """(n, 7) -> columns."""
        return {"attitude": states[:, :4], "angular_velocity": (self.size * states[:, 4:7] - self.l) @ self.inverse}

    def right(self) -> Callable[[float, Vectors], Vectors]:
        """The right-hand side in Python."""
        inverse, g = self.size * self.inverse, self.inverse @ self.l

        def right(_: float, state: Vectors) -> Vectors:
            x, y, z, w, M1, M2, M3 = state.tolist()
            o1, o2, o3 = (inverse @ state[4:7] - g).tolist()
            return np.array([0.5 * (w * o1 + y * o3 - z * o2), 0.5 * (w * o2 + z * o1 - x * o3), 0.5 * (w * o3 + x * o2 - y * o1),
                             -0.5 * (x * o1 + y * o2 + z * o3), M2 * o3 - M3 * o2, M3 * o1 - M1 * o3, M1 * o2 - M2 * o1])

        return right

    def system(self, heyoka: Any) -> list[Any]:
        """The right-hand side for heyoka."""
        names = heyoka.make_vars("x", "y", "z", "w", "m1", "m2", "m3")
        x, y, z, w, *M = names
        inverse, g = self.size * self.inverse, self.inverse @ self.l
        o = [heyoka.sum([float(inverse[i, j]) * M[j] for j in range(3) if inverse[i, j] != 0]) - float(g[i]) for i in range(3)]
        rates = [0.5 * (w * o[0] + y * o[2] - z * o[1]), 0.5 * (w * o[1] + z * o[0] - x * o[2]), 0.5 * (w * o[2] + x * o[1] - y * o[0]),
                 -0.5 * (x * o[0] + y * o[1] + z * o[2]), M[1] * o[2] - M[2] * o[1], M[2] * o[0] - M[0] * o[2], M[0] * o[1] - M[1] * o[0]]
        return list(zip(names, rates, strict=True))
