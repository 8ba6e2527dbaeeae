# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs on a scene of a heavy body, against a Taylor integration in long double."""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from gyrostat import _core, heavy
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
from gyrostat.errors import ConvergenceError, DomainError
from gyrostat.facts import FACTS
from gyrostat.scenes import Scene

__all__ = ["plan", "true_errors"]

RATES: Final = Measure("angular_velocity", "error of omega", "the angular velocity", "greatest true error, relative to the greatest |ω| [1]")
DOWN: Final = Measure("down", "error of down", "down, body axes", "greatest true error, angle [rad]")
# The chart covers at most so many turns: beyond, slow methods would take minutes.
MOST_TURNS: Final = 5000.0
# A right-hand side written in Python [s], and the longest run of it that is waited for [s].
PYTHON_CALL: Final = 1.2e-5
PYTHON_PATIENCE: Final = 12.0
SERIES_ORDERS: Final = (2, 4, 6, 8, 12, 16, 20, 24, 30)


def true_errors(made: dict[str, Any], want: dict[str, Any]) -> dict[str, float]:
    """Greatest differences of the rates, over the greatest wanted, and of down."""
    size = float(np.max(np.linalg.norm(want["angular_velocity"], axis=1)))
    off = {name: float(np.max(np.linalg.norm(made[name] - want[name], axis=1))) for name in ("angular_velocity", "down")}
    return {"angular_velocity": off["angular_velocity"] / size if size > 0 else math.nan, "down": off["down"]}


def plan(scene: Scene, repeats: int) -> Plan:
    """Every method on the scene, or on its first part where the whole is too long.

    A periodic motion is charted from the start that shooting finds for it.
    """
    given = heavy.arguments(scene)
    asked = given["times"]
    periodic, notes = given["periodic"], []
    if periodic is not None:
        start = _periodic_start(given)
        notes.append("from the start that shooting finds")
    else:
        start = {name: given[name] for name in ("angular_velocity", "down", "attitude")}
    physics = {**{name: given[name] for name in ("inertia", "mass", "centre_of_mass", "gravity", "gravity_gradient", "times")}, **start}
    turns = _turns(physics)
    if turns > MOST_TURNS:
        end = float(asked[-1]) * MOST_TURNS / turns
        physics["times"] = given["times"] = np.linspace(0.0, end, 51)
        notes.append(f"of the scene's {asked[-1]:.6g} s")
        turns = MOST_TURNS
    want = heavy.integrate(**physics, method="taylor", order=30, tolerance=1e-18, precision="long double")

    def errors(made: dict[str, Any]) -> dict[str, float]:
        return true_errors(made, want)

    methods = [("dop853", "Runge-Kutta DOP853", "dop853"), *cvode_methods()]
    jobs = (*rung_jobs(FACTS[scene.kind].rungs, heavy.solve, given, errors, repeats), *_series_jobs(given, errors, repeats),
            *integrator_jobs(methods, heavy.integrate, physics, errors, repeats), *_rivals(physics, turns, want, repeats))
    title = (f"true error against cost, {len(physics['times'])} times to {physics['times'][-1]:.6g} s{''.join(', ' + note for note in notes)}\n"
             f"about {turns:.3g} turns; reference: Taylor series of order 30 in long double")
    return Plan(title, (RATES, DOWN), jobs)


def _principal(given: dict[str, Any]) -> tuple[dict[str, Any], Vectors]:
    """The body in principal axes, and the rotation from there to the scene's."""
    inertia = np.asarray(given["inertia"], dtype=float)
    moments, axes = (inertia, np.eye(3)) if inertia.ndim == 1 else heavy.principal_axes(inertia)
    centre = axes.T @ np.asarray(given["centre_of_mass"], dtype=float)
    return {"inertia": moments, "centre_of_mass": centre, **{name: given[name] for name in ("mass", "gravity", "gravity_gradient")}}, axes


def _periodic_start(given: dict[str, Any]) -> dict[str, Any]:
    body, axes = _principal(given)
    orbit = heavy.periodic_orbit(**body, **given["periodic"])
    if str(orbit.verdict) == "none":
        raise DomainError(f"initial.periodic: no such motion was found to chart: {orbit.why}")
    return {"angular_velocity": axes @ orbit.angular_velocity, "down": axes @ orbit.down / np.linalg.norm(orbit.down), "attitude": None}


def _turns(physics: dict[str, Any]) -> float:
    """Roughly the turns and swings up to the last time."""
    inertia = np.asarray(physics["inertia"], dtype=float)
    least = float(np.min(inertia)) if inertia.ndim == 1 else float(np.linalg.eigvalsh(inertia)[0])
    pull = physics["mass"] * physics["gravity"] * float(np.linalg.norm(physics["centre_of_mass"])) / least
    rate = float(np.linalg.norm(physics["angular_velocity"])) + math.sqrt(pull) + math.sqrt(physics["gravity_gradient"])
    return max(rate * float(physics["times"][-1]) / (2 * math.pi), 1e-300)


def _series_jobs(given: dict[str, Any], errors: Callable[[dict[str, Any]], dict[str, float]], repeats: int) -> Iterator[Job]:
    """The series of a periodic motion, order by order."""
    if given["periodic"] is None:
        return
    body, axes = _principal(given)
    for order in SERIES_ORDERS:

        def job(order: int = order) -> ChartPoint | None:
            made: dict[str, Any] = {}

            def once() -> float:
                began = time.perf_counter()
                made["run"] = heavy.series(**body, **given["periodic"], t=given["times"], order=order)
                return time.perf_counter() - began

            try:
                seconds = timed(once, repeats)
            except (DomainError, ConvergenceError):
                return None
            run = made["run"]
            if int(run.order) < order:  # the terms between are below rounding
                return None
            return ChartPoint("rung", "series, by order (from Python)", f"order {order}",
                              errors({"angular_velocity": run.angular_velocity @ axes.T, "down": run.down @ axes.T}), seconds, 0,
                              f"stated error {max(float(run.error['angular_velocity']) / abs(given['periodic']['spin']), float(run.error['down'])):.2g}")

        yield "series", f"order {order}", job


# ---- rivals ----


class _Equations:
    """Rates over their size, and down, in body axes."""

    def __init__(self, physics: dict[str, Any]) -> None:
        inertia = np.asarray(physics["inertia"], dtype=float)
        self.inertia = np.diag(inertia) if inertia.ndim == 1 else inertia
        self.pull = physics["mass"] * physics["gravity"] * np.asarray(physics["centre_of_mass"], dtype=float)
        self.gradient = float(physics["gravity_gradient"])
        end = float(physics["times"][-1])
        self.rate = 2 * math.pi * _turns(physics) / end if end > 0 else 1.0
        down = physics["down"]
        if down is None:
            down = -_core.matrix_from_quaternion(np.asarray(physics["attitude"], dtype=float)[None, :])[0].reshape(3, 3)[2]
        self.start = np.concatenate([np.asarray(physics["angular_velocity"], dtype=float) / self.rate, down])

    def columns(self, states: Vectors) -> dict[str, Any]:
        """(n, 6) -> columns."""
        return {"angular_velocity": states[:, :3] * self.rate, "down": states[:, 3:6]}

    def right(self) -> Callable[[float, Vectors], Vectors]:
        inverse, I = np.linalg.inv(self.inertia), self.inertia
        (a, b, c), (d, e, f), (g, h, i) = I.tolist()
        inverse_rows = inverse.tolist()
        m1, m2, m3 = self.pull.tolist()
        N, rate = self.gradient, self.rate

        def right(_: float, state: Vectors) -> Vectors:
            p, q, r, x, y, z = state.tolist()
            p, q, r = p * rate, q * rate, r * rate
            L1, L2, L3 = a * p + b * q + c * r, d * p + e * q + f * r, g * p + h * q + i * r
            D1, D2, D3 = a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z
            t1 = L2 * r - L3 * q + m2 * z - m3 * y + N * (y * D3 - z * D2)
            t2 = L3 * p - L1 * r + m3 * x - m1 * z + N * (z * D1 - x * D3)
            t3 = L1 * q - L2 * p + m1 * y - m2 * x + N * (x * D2 - y * D1)
            made: Vectors = np.array([*((row[0] * t1 + row[1] * t2 + row[2] * t3) / rate for row in inverse_rows),
                                      y * r - z * q, z * p - x * r, x * q - y * p])
            return made

        return right

    def system(self, heyoka: Any) -> list[Any]:
        names = heyoka.make_vars("p", "q", "r", "x", "y", "z")
        w, d = names[:3], names[3:]
        inverse = np.linalg.inv(self.inertia)

        def times(matrix: Vectors, v: list[Any]) -> list[Any]:
            return [heyoka.sum([float(matrix[i, j]) * v[j] for j in range(3) if matrix[i, j]]) for i in range(3)]

        def cross(a: list[Any], b: list[Any]) -> list[Any]:
            return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

        m = self.pull.tolist()
        pull = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            terms = [part for part in (m[j] * d[k] if m[j] else None, -m[k] * d[j] if m[k] else None) if part is not None]
            pull.append(terms)
        spin = [self.rate**2 * part for part in cross(times(self.inertia, w), w)]
        gradient = [self.gradient * part for part in cross(d, times(self.inertia, d))] if self.gradient else None
        torque = [heyoka.sum([spin[i], *pull[i], *([gradient[i]] if gradient else [])]) for i in range(3)]
        turn = [self.rate * part for part in cross(d, w)]
        return list(zip(names, [*(part / self.rate for part in times(inverse, torque)), *turn], strict=True))


def _rivals(physics: dict[str, Any], turns: float, want: dict[str, Any], repeats: int) -> Iterator[Job]:
    equations = _Equations(physics)
    times = np.asarray(physics["times"], dtype=float)
    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        pass
    else:
        right = equations.right()
        # twelve evaluations a step, some ten steps to a turn
        for tolerance in TOLERANCES if 120 * turns * PYTHON_CALL < PYTHON_PATIENCE else ():

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
