# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs on a scene of a gyrostat with a driven rotor, against a Taylor integration in long double."""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from gyrostat import rotor
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
from gyrostat.rotation import angle_between
from gyrostat.scenes import Scene

__all__ = ["plan", "true_errors"]

MEASURES: Final = (
    Measure("attitude", "error of attitude", "the attitude", "greatest true error, angle [rad]"),
    Measure("angular_velocity", "error of Omega", "the angular velocity of the carrier", "greatest true error, relative to the greatest |Ω| [1]"))
# The chart covers at most so many turns: beyond, slow methods would take minutes.
MOST_TURNS: Final = 5000.0
# Where the motor relaxes so often in a turn Radau makes the reference: Taylor steps keep exciting what has relaxed.
STIFF: Final = 30.0 * 2 * math.pi
# A right-hand side written in Python [s], and the longest run of it that is waited for [s].
PYTHON_CALL: Final = 1.5e-5
PYTHON_PATIENCE: Final = 12.0


def true_errors(made: dict[str, Any], want: dict[str, Any]) -> dict[str, float]:
    """Greatest angle between the attitudes, and greatest difference of the angular velocities over the greatest wanted."""
    rate = want["angular_velocity"]
    return {
        "attitude": float(np.max(angle_between(made["attitude"], want["attitude"]))),
        "angular_velocity": float(np.max(np.linalg.norm(made["angular_velocity"] - rate, axis=1)) / np.max(np.linalg.norm(rate, axis=1))),
    }


def plan(scene: Scene, repeats: int) -> Plan:
    """Every method on the scene, or on its first part where the whole is too long."""
    given = rotor.arguments(scene)
    turns, relaxations = _rates(given)
    asked = given["times"]
    end, cut = min(float(asked[-1]), MOST_TURNS / turns), ""
    if end < asked[-1]:
        given["times"] = np.linspace(0.0, end, 51)
        cut = f" of the scene's {asked[-1]:.6g} s"
    physics = {key: value for key, value in given.items() if key not in ("tolerance", "model", "integrator")}
    stiff = relaxations > STIFF * turns
    want = rotor.integrate(**physics, method="radau" if stiff else "taylor", order=30, tolerance=1e-18, precision="long double")

    def errors(made: dict[str, Any]) -> dict[str, float]:
        return true_errors(made, want)

    methods = [("radau", "Radau IIA", "radau"), ("dop853", "Runge-Kutta DOP853", "dop853"), *cvode_methods()]
    jobs = (*rung_jobs(FACTS[scene.kind].rungs, rotor.solve, given, errors, repeats),
            *integrator_jobs(methods, rotor.integrate, physics, errors, repeats), *_rivals(physics, want, repeats))
    title = (f"true error against cost, {len(given['times'])} times to {end:.6g} s{cut}\n{turns * end:.3g} turns at most, {relaxations * end:.3g} "
             f"relaxation times of the motor; reference: {'Radau' if stiff else 'Taylor series of order 30'} in long double")
    return Plan(title, MEASURES, jobs)


def _tensor(given: dict[str, Any]) -> Vectors:
    inertia = np.asarray(given["inertia"], dtype=float)
    return np.diag(inertia) if inertia.ndim == 1 else inertia


def _start(given: dict[str, Any]) -> tuple[Vectors, Vectors, float]:
    """R^-1, H and p at the start, body axes."""
    theta, e, lam = _tensor(given), np.asarray(given["axis"], dtype=float), given["axial_inertia"]
    Omega = np.asarray(given["angular_velocity"], dtype=float)
    H = theta @ Omega + lam * given["rotor_rate"] * e
    return np.linalg.inv(theta - lam * np.outer(e, e)), H, lam * (given["rotor_rate"] + float(e @ Omega))


def _rates(given: dict[str, Any]) -> tuple[float, float]:
    """Bound of the turns in a second, and relaxation times of the motor in a second."""
    inverse, H, p = _start(given)
    e, lam = np.asarray(given["axis"], dtype=float), given["axial_inertia"]
    wheel = max(abs(p), lam * abs(given["no_load_rate"]))
    fastest = float(np.linalg.eigvalsh(inverse)[-1]) * (float(np.linalg.norm(H)) + wheel) / (2 * math.pi)
    return max(fastest, 1e-300), given["slope"] / lam * (1 + lam * float(e @ inverse @ e))


# ---- rivals ----


def _rivals(physics: dict[str, Any], want: dict[str, Any], repeats: int) -> Iterator[Job]:
    inverse, H, p = _start(physics)
    start = np.concatenate([np.asarray(physics["attitude"], dtype=float), H, [p]])
    times = np.asarray(physics["times"], dtype=float)
    size = float(np.linalg.norm(H)) + physics["axial_inertia"] * abs(physics["no_load_rate"]) + abs(p)

    def columns(states: Vectors) -> dict[str, Any]:
        axis = np.asarray(physics["axis"], dtype=float)
        return {"attitude": states[:, :4], "angular_velocity": (states[:, 4:7] - states[:, 7:] * axis) @ inverse}

    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        pass
    else:
        right = _right_hand_side(physics)
        turns, relaxations = _rates(physics)
        # twelve evaluations a step, at most six relaxation times long and some ten to a turn
        calls = 12 * float(times[-1]) * max(relaxations / 6, 10 * turns)
        for tolerance in TOLERANCES if calls * PYTHON_CALL < PYTHON_PATIENCE else ():

            def scipy_job(tolerance: float = tolerance) -> ChartPoint | None:
                made: dict[str, Any] = {}

                def once() -> float:
                    began = time.perf_counter()
                    made["run"] = solve_ivp(right, (0.0, times[-1]), start, method="DOP853", t_eval=times, rtol=tolerance,
                                            atol=tolerance * np.array([1.0] * 4 + [size] * 4))
                    return time.perf_counter() - began

                seconds = timed(once, repeats)
                run = made["run"]
                if not run.success:
                    return None
                return ChartPoint("rival", "SciPy DOP853 (Python right-hand side)", f"tolerance {tolerance:g}",
                                  true_errors(columns(run.y.T), want), seconds, int(run.nfev))

            yield "SciPy DOP853", f"{tolerance:g}", scipy_job
    try:
        import heyoka
    except ImportError:
        return
    scale = np.array([1.0] * 4 + [size] * 4)  # heyoka measures all components alike
    for tolerance in TOLERANCES:

        def heyoka_job(tolerance: float = tolerance) -> ChartPoint | None:
            integrator = heyoka.taylor_adaptive(_heyoka_system(heyoka, physics, size), list(start / scale), tol=tolerance)
            grid = times if times[0] == 0 else np.concatenate([[0.0], times])
            made: dict[str, Any] = {}

            def once() -> float:
                integrator.time = 0.0
                integrator.state[:] = start / scale
                began = time.perf_counter()
                made["out"] = integrator.propagate_grid(grid)
                return time.perf_counter() - began

            seconds = timed(once, repeats)
            outcome, steps, states = made["out"][0], made["out"][3], made["out"][5]
            if outcome != heyoka.taylor_outcome.time_limit or len(states) != len(grid):
                return None
            return ChartPoint("rival", "heyoka (compile time left out)", f"tolerance {tolerance:g}",
                              true_errors(columns(states[len(grid) - len(times):] * scale), want), seconds, int(steps))

        yield "heyoka", f"{tolerance:g}", heyoka_job


def _right_hand_side(given: dict[str, Any]) -> Callable[[float, Vectors], Vectors]:
    """Of (x, y, z, w, H, p); the attitude is not normalised."""
    inverse = _start(given)[0]
    e, lam, slope, no_load = np.asarray(given["axis"], dtype=float), given["axial_inertia"], given["slope"], given["no_load_rate"]

    def right(_: float, state: Vectors) -> Vectors:
        x, y, z, w, H1, H2, H3, p = state.tolist()
        Omega = inverse @ (state[4:7] - p * e)
        o1, o2, o3 = Omega.tolist()
        rate = p / lam - float(e @ Omega)
        return np.array([0.5 * (w * o1 + y * o3 - z * o2), 0.5 * (w * o2 + z * o1 - x * o3), 0.5 * (w * o3 + x * o2 - y * o1),
                         -0.5 * (x * o1 + y * o2 + z * o3), H2 * o3 - H3 * o2, H3 * o1 - H1 * o3, H1 * o2 - H2 * o1,
                         -slope * (rate - no_load)])

    return right


def _heyoka_system(heyoka: Any, given: dict[str, Any], size: float) -> list[Any]:
    """The same with H and p in units of `size`."""
    names = heyoka.make_vars("x", "y", "z", "w", "h1", "h2", "h3", "p")
    x, y, z, w, *H, p = names
    inverse = size * _start(given)[0]
    e, lam = np.asarray(given["axis"], dtype=float).tolist(), given["axial_inertia"]
    carrier = [H[i] - e[i] * p if e[i] else H[i] for i in range(3)]
    o = [heyoka.sum([float(inverse[i, j]) * carrier[j] for j in range(3) if inverse[i, j] != 0]) for i in range(3)]
    rate = size / lam * p - heyoka.sum([e[i] * o[i] for i in range(3) if e[i]])
    rates = [0.5 * (w * o[0] + y * o[2] - z * o[1]), 0.5 * (w * o[1] + z * o[0] - x * o[2]), 0.5 * (w * o[2] + x * o[1] - y * o[0]),
             -0.5 * (x * o[0] + y * o[1] + z * o[2]), H[1] * o[2] - H[2] * o[1], H[2] * o[0] - H[0] * o[2], H[0] * o[1] - H[1] * o[0],
             -given["slope"] / size * (rate - given["no_load_rate"])]
    return list(zip(names, rates, strict=True))
