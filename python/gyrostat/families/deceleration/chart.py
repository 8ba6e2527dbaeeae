# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs on a deceleration scene, against a Taylor integration in long double."""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from gyrostat import deceleration
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
from gyrostat.scenes import Scene

__all__ = ["plan", "true_errors"]

# The integrators of others step over M = 0: the chart ends before the stop.
STOP_SHARE: Final = 0.95

_AXIS: Final = "greatest true error, relative to the greatest |M| [1]"
MEASURES: Final = (Measure("angular_momentum_norm", "error of |M|", "|M|", _AXIS),
                   Measure("angular_momentum", "error of M", "the vector M, body axes", _AXIS))


def true_errors(got: Vectors | None, norm: Vectors | None, want: Vectors) -> dict[str, float]:
    """Greatest error of the vector and of its size, each relative to the greatest size of `want` (n, 3)."""
    size = np.linalg.norm(want, axis=1)
    scale = float(np.max(size))
    if got is not None and norm is None:
        norm = np.linalg.norm(got, axis=1)
    errors = {"angular_momentum": math.nan, "angular_momentum_norm": math.nan}
    if got is not None:
        errors["angular_momentum"] = float(np.max(np.linalg.norm(got - want, axis=1))) / scale
    if norm is not None:
        errors["angular_momentum_norm"] = float(np.max(np.abs(norm - size))) / scale
    return errors


def plan(scene: Scene, repeats: int) -> Plan:
    """Every method on the scene, up to just before the stop."""
    given = deceleration.arguments(scene)
    times, cut = _before_the_stop(given)
    given["times"] = times
    given["attitude"] = None
    reference = deceleration.integrate(**_physics(given), method="taylor", order=30, tolerance=1e-18, precision="long double")
    want = np.asarray(reference["angular_momentum"])

    def errors(columns: dict[str, Any]) -> dict[str, float]:
        return true_errors(columns.get("angular_momentum"), columns.get("angular_momentum_norm"), want)

    methods = [("dop853", "Runge-Kutta DOP853", "dop853"), *cvode_methods()]
    jobs = (*rung_jobs(FACTS[scene.kind].rungs, deceleration.solve, given, errors, repeats),
            *integrator_jobs(methods, deceleration.integrate, _physics(given), errors, repeats), *_rivals(given, want, repeats))
    return Plan(f"true error against cost, {len(times)} times to {times[-1]:.6g} s{cut}", MEASURES, jobs)


def _physics(given: dict[str, Any]) -> dict[str, Any]:
    keys = ("inertia", "rotor_momentum", "control", "drag", "law", "drag_law", "angular_momentum", "times")
    return {key: given[key] for key in keys}


def _before_the_stop(given: dict[str, Any]) -> tuple[Vectors, str]:
    """The scene's times that lie before the stop, and a remark where some were left out."""
    times = given["times"]
    stop = deceleration.solve(**{**given, "model": "full", "times": times[-1:], "tolerance": 1e-6})["scalars"].get("stop_time")
    if stop is None or not math.isfinite(stop) or times[-1] <= STOP_SHARE * stop:
        return times, ""
    kept = times[times <= STOP_SHARE * stop]
    if len(kept) < 2:
        kept = np.linspace(0.0, STOP_SHARE * stop, 51)
    return kept, f" (the motion stops at {stop:.6g} s)"


# ---- rivals ----


def _rivals(given: dict[str, Any], want: Vectors, repeats: int) -> Iterator[Job]:
    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        pass
    else:
        right = _right_hand_side(given)
        start = np.asarray(given["angular_momentum"])
        times = given["times"]
        for tolerance in TOLERANCES:

            def scipy_job(tolerance: float = tolerance) -> ChartPoint | None:
                made: dict[str, Any] = {}

                def once() -> float:
                    began = time.perf_counter()
                    made["run"] = solve_ivp(right, (0.0, times[-1]), start, method="DOP853", t_eval=times, rtol=tolerance,
                                            atol=tolerance * float(np.linalg.norm(start)))
                    return time.perf_counter() - began

                seconds = timed(once, repeats)
                run = made["run"]
                if not run.success:
                    return None
                return ChartPoint("rival", "SciPy DOP853 (Python right-hand side)", f"tolerance {tolerance:g}",
                                  true_errors(run.y.T, None, want), seconds, int(run.nfev))

            yield "SciPy DOP853", f"{tolerance:g}", scipy_job
    try:
        import heyoka
    except ImportError:
        return
    for tolerance in TOLERANCES:

        def heyoka_job(tolerance: float = tolerance) -> ChartPoint | None:
            start, times = np.asarray(given["angular_momentum"]), given["times"]
            integrator = heyoka.taylor_adaptive(_heyoka_system(heyoka, given), list(start), tol=tolerance)
            grid = times if times[0] == 0 else np.concatenate([[0.0], times])
            made: dict[str, Any] = {}

            def once() -> float:
                integrator.time = 0.0
                integrator.state[:] = start
                began = time.perf_counter()
                made["out"] = integrator.propagate_grid(grid)
                return time.perf_counter() - began

            seconds = timed(once, repeats)
            outcome, steps, states = made["out"][0], made["out"][3], made["out"][5]
            if outcome != heyoka.taylor_outcome.time_limit or len(states) != len(grid):
                return None
            return ChartPoint("rival", "heyoka (compile time left out)", f"tolerance {tolerance:g}",
                              true_errors(states[len(grid) - len(times):], None, want), seconds, int(steps))

        yield "heyoka", f"{tolerance:g}", heyoka_job


def _tensor(given: dict[str, Any]) -> Vectors:
    inertia = np.asarray(given["inertia"], dtype=float)
    return np.diag(inertia) if inertia.ndim == 1 else inertia


def _right_hand_side(given: dict[str, Any]) -> Callable[[float, Vectors], Vectors]:
    inverse = np.linalg.inv(_tensor(given))
    rotor, control, drag = np.asarray(given["rotor_momentum"]), np.asarray(given["control"]), given["drag"]
    total, total_drag = given["law"] == "total", given["drag_law"] == "total"

    def right(_: float, momentum: Vectors) -> Vectors:
        carrier = momentum - rotor
        opposed = momentum if total else carrier
        dragged = momentum if total_drag else carrier
        rate = inverse @ carrier
        made: Vectors = np.cross(momentum, rate) - drag * dragged - control * opposed / math.sqrt(opposed @ opposed)
        return made

    return right


def _heyoka_system(heyoka: Any, given: dict[str, Any]) -> list[Any]:
    names = heyoka.make_vars("x", "y", "z")
    inverse = np.linalg.inv(_tensor(given))
    carrier = [m - l if l else m for m, l in zip(names, np.asarray(given["rotor_momentum"]).tolist(), strict=True)]
    rate = [heyoka.sum([float(inverse[i, j]) * carrier[j] for j in range(3) if inverse[i, j] != 0]) for i in range(3)]
    opposed = names if given["law"] == "total" else carrier
    dragged = names if given["drag_law"] == "total" else carrier
    size = heyoka.sqrt(heyoka.sum([u * u for u in opposed]))
    cross = [names[1] * rate[2] - names[2] * rate[1], names[2] * rate[0] - names[0] * rate[2], names[0] * rate[1] - names[1] * rate[0]]
    return [(names[i], cross[i] - given["drag"] * dragged[i] - float(given["control"][i]) * opposed[i] / size) for i in range(3)]
