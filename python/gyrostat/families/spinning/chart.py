# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs on a scene of a thrusting spinner, against a Taylor integration in long double."""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from gyrostat import spinning
from gyrostat.charts.point import (
    TOLERANCES,
    ChartPoint,
    Job,
    Measure,
    Plan,
    Vectors,
    cvode_methods,
    integrator_jobs,
    rung_jobs,
    timed,
)
from gyrostat.facts import FACTS
from gyrostat.rotation import angle_between, quaternion_from_euler_312
from gyrostat.scenes import Scene

__all__ = ["plan", "true_errors"]

ATTITUDE: Final = Measure("attitude", "error of attitude", "the attitude", "greatest true error, angle [rad]")
# The second measure: the velocity, or without thrust the rates.
VELOCITY: Final = Measure("velocity", "error of velocity", "the velocity of the mass centre", "greatest true error, relative to the greatest |v| [1]")
RATES: Final = Measure("angular_velocity", "error of omega", "the angular velocity", "greatest true error, relative to the greatest |ω| [1]")
# The chart covers at most so many turns: beyond, slow methods would take minutes.
MOST_TURNS: Final = 5000.0
# A right-hand side written in Python [s], and the longest run of it that is waited for [s].
PYTHON_CALL: Final = 2.5e-5
PYTHON_PATIENCE: Final = 12.0


def true_errors(made: dict[str, Any], want: dict[str, Any]) -> dict[str, float]:
    """Greatest angle between the attitudes, and greatest differences of rates and velocities over the greatest wanted."""
    errors = {"attitude": float(np.max(angle_between(made["attitude"], want["attitude"])))}
    for key in ("angular_velocity", "velocity"):
        size = float(np.max(np.linalg.norm(want[key], axis=1)))
        errors[key] = float(np.max(np.linalg.norm(made[key] - want[key], axis=1))) / size if size > 0 else math.nan
    return errors


def plan(scene: Scene, repeats: int) -> Plan:
    """Every method on the scene, or on its first part where the whole is too long."""
    given = spinning.arguments(scene)
    asked = given["times"]
    end, cut = float(asked[-1]), ""
    if _rate(given, end) * end > MOST_TURNS:
        while _rate(given, end) * end > MOST_TURNS:
            end *= 0.95
        given["times"] = np.linspace(0.0, end, 51)
        cut = f" of the scene's {asked[-1]:.6g} s"
    physics = {key: value for key, value in given.items() if key not in ("tolerance", "model", "integrator")}
    want = spinning.integrate(**physics, method="taylor", order=30, tolerance=1e-18, precision="long double")

    def errors(made: dict[str, Any]) -> dict[str, float]:
        return true_errors(made, want)

    methods = [("dop853", "Runge-Kutta DOP853", "dop853"), *cvode_methods()]
    jobs = (*rung_jobs(FACTS[scene.kind].rungs, spinning.solve, given, errors, repeats),
            *integrator_jobs(methods, spinning.integrate, physics, errors, repeats), *_rivals(physics, want, repeats))
    turns = float(np.mean(np.linalg.norm(want["angular_velocity"], axis=1))) * end / (2 * math.pi)
    title = (f"true error against cost, {len(given['times'])} times to {end:.6g} s{cut}\nabout {turns:.3g} turns; "
             "reference: Taylor series of order 30 in long double")
    return Plan(title, (ATTITUDE, VELOCITY if np.any(given["force"]) else RATES), jobs)


def _rate(given: dict[str, Any], end: float) -> float:
    """Roughly the most turns and nutations in a second until `end`."""
    D, M, omega = (np.asarray(given[name], dtype=float) for name in ("inertia", "torque", "angular_velocity"))
    gyroscopic = abs(given["rotor_momentum"] - given["charge_momentum"]) / float(D.min())
    drive = float(np.linalg.norm(M[:2] / D[:2]))
    spin = float(np.linalg.norm(omega)) + abs(float(M[2] / D[2])) * end
    return float(max((2 * spin + gyroscopic + min(drive * end, math.sqrt(drive))) / (2 * math.pi), 1e-300))


# ---- rivals ----


class _Equations:
    """Rates, quaternion, velocity and position over their sizes."""

    def __init__(self, given: dict[str, Any]) -> None:
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


def _rivals(physics: dict[str, Any], want: dict[str, Any], repeats: int) -> Iterator[Job]:
    equations = _Equations(physics)
    times = np.asarray(physics["times"], dtype=float)
    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        pass
    else:
        right = equations.right()
        # twelve evaluations a step, some ten steps to a turn
        calls = 120 * float(times[-1]) * _rate(physics, float(times[-1]))
        for tolerance in TOLERANCES if calls * PYTHON_CALL < PYTHON_PATIENCE else ():

            def scipy_job(tolerance: float = tolerance) -> ChartPoint | None:
                made: dict[str, Any] = {}

                def once() -> float:
                    began = time.perf_counter()
                    made["run"] = solve_ivp(right, (0.0, times[-1]), equations.start, method="DOP853", t_eval=times, rtol=tolerance,
                                            atol=tolerance)
                    return time.perf_counter() - began

                seconds = timed(once, repeats)
                run = made["run"]
                if not run.success:
                    return None
                return ChartPoint("rival", "SciPy DOP853 (Python right-hand side)", f"tolerance {tolerance:g}",
                                  true_errors(equations.columns(run.y.T), want), seconds, int(run.nfev))

            yield "SciPy DOP853", f"{tolerance:g}", scipy_job
    try:
        import heyoka
    except ImportError:
        return
    for tolerance in TOLERANCES:

        def heyoka_job(tolerance: float = tolerance) -> ChartPoint | None:
            integrator = heyoka.taylor_adaptive(equations.system(heyoka), list(equations.start), tol=tolerance)
            grid = times if times[0] == 0 else np.concatenate([[0.0], times])
            made: dict[str, Any] = {}

            def once() -> float:
                integrator.time = 0.0
                integrator.state[:] = equations.start
                began = time.perf_counter()
                made["out"] = integrator.propagate_grid(grid)
                return time.perf_counter() - began

            seconds = timed(once, repeats)
            outcome, steps, states = made["out"][0], made["out"][3], made["out"][5]
            if outcome != heyoka.taylor_outcome.time_limit or len(states) != len(grid):
                return None
            return ChartPoint("rival", "heyoka (compile time left out)", f"tolerance {tolerance:g}",
                              true_errors(equations.columns(states[len(grid) - len(times):]), want), seconds, int(steps))

        yield "heyoka", f"{tolerance:g}", heyoka_job
