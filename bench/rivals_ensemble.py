# SPDX-License-Identifier: BSD-3-Clause
"""Many scenes at once: rows of a sweep, errors stated, against heyoka's batch and ensemble and a Python loop over SciPy, in one run.

    python bench/rivals_ensemble.py [--rows 4096] [--periods 1000]

Two studies. *Driven rotor*: two numbers vary by a hundredth, the angular velocity at 50 s and 100 s, which `full` answers in lanes; heyoka has the
equations of rivals_heyoka_rotor.py with both numbers as parameters. *Free gyrostat*: one moment and one rate vary, the attitude after so many
periods, which the closed form answers. heyoka is compiled once; only the propagation of all rows is timed, of its batch in as many lanes as it
recommends, of its ensemble (one body after another) on the threads that it takes. CPU time of the process, all threads, for all alike. The error
is the greatest true one among 32 rows (of SciPy, which takes seconds a row, that of the first), against heyoka in long double; heyoka's row is the cheapest of its tolerances that errs no more than ours.
"""

from __future__ import annotations

import argparse
import os
import time
from typing import Any, Callable, NamedTuple

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # idle threads that spin would be counted

import gyrostat
import heyoka as hy
import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

CHECKED = 32
TOLERANCES = [10.0**-k for k in range(7, 17)]


class Study(NamedTuple):
    """Equations with parameters, and of every row these and the start; a row's numbers at the times end with what is compared."""

    name: str
    equations: list[Any]
    parameters: NDArray[np.float64]  # (rows, numbers)
    starts: NDArray[np.float64]  # (rows, state)
    times: list[float]
    compared: Callable[[NDArray[Any]], NDArray[Any]]  # states (n, state): (n, k)


def cross(a: Any, b: Any) -> list[Any]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def turning(q: Any, w: Any) -> list[Any]:
    return [(q[0], -0.5 * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2])), (q[1], 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1])),
            (q[2], 0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2])), (q[3], 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]))]


def upright(q: NDArray[Any]) -> NDArray[Any]:
    """Of q and -q the one whose greatest component is positive."""
    greatest = np.take_along_axis(q, np.abs(q).argmax(1)[:, None], 1)
    return q * np.sign(greatest) / np.linalg.norm(q, axis=1)[:, None]


# ---- the driven rotor ----

THETA = np.array([[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]])
AXIS = np.array([0.36, 0.48, 0.8]) / np.linalg.norm([0.36, 0.48, 0.8])
LAMBDA, NO_LOAD, OMEGA, RATE = 0.35, 30.0, np.array([0.1, 0.2, 0.3]), -1.0


def rotor_scene(tolerance: float) -> dict[str, Any]:
    return {"name": "driven rotor", "kind": "rotor", "solve": {"times": [50.0, 100.0], "tolerance": tolerance}, "body": {"inertia": THETA.tolist()},
            "rotor": {"axis": AXIS.tolist(), "axial_inertia": LAMBDA}, "motor": {"slope": 0.05, "no_load_rate": NO_LOAD},
            "initial": {"angular_velocity": OMEGA.tolist(), "rotor_rate": RATE}}


def rotor_study(slope: NDArray[np.float64], no_load: NDArray[np.float64]) -> Study:
    h, p = hy.make_vars("h1", "h2", "h3"), hy.make_vars("p")
    inverse = np.linalg.inv(THETA - LAMBDA * np.outer(AXIS, AXIS))
    free = [h[i] - AXIS[i] * p for i in range(3)]
    w = [sum(float(inverse[i, j]) * free[j] for j in range(3)) for i in range(3)]
    omega = p * (1 / LAMBDA) - sum(float(AXIS[i]) * w[i] for i in range(3))
    rates = [(h[i], x) for i, x in enumerate(cross(h, w))] + [(p, -hy.par[0] * (omega - hy.par[1]))]
    H = THETA @ OMEGA + LAMBDA * RATE * AXIS
    start = np.array([*H, LAMBDA * (AXIS @ OMEGA + RATE)])

    return Study("driven rotor", rates, np.column_stack([slope, no_load]), np.tile(start, (len(slope), 1)), [50.0, 100.0],
                 lambda x: (x[:, :3] - x[:, 3:4] * AXIS) @ inverse.T)


# ---- the free gyrostat ----

J, L, START = np.array([35.0, 22.0, 16.0]), np.array([3.0, -2.0, 5.0]), np.array([0.4, 0.55, 0.7])


def free_scene(end: float) -> dict[str, Any]:
    return {"name": "free gyrostat", "kind": "free", "solve": {"times": [end], "tolerance": 1e-6}, "body": {"inertia": J.tolist(), "rotor_momentum": L.tolist()},
            "initial": {"angular_velocity": START.tolist()}}


def free_study(moment: NDArray[np.float64], rate: NDArray[np.float64], end: float) -> Study:
    q, M = hy.make_vars("w", "x", "y", "z"), hy.make_vars("m1", "m2", "m3")
    w = [(M[0] - L[0]) / hy.par[0], (M[1] - L[1]) * (1 / J[1]), (M[2] - L[2]) * (1 / J[2])]
    rows = len(moment)
    M0 = np.column_stack([moment * rate + L[0], np.full(rows, J[1] * START[1] + L[1]), np.full(rows, J[2] * START[2] + L[2])])
    starts = np.column_stack([np.ones(rows), np.zeros((rows, 3)), M0])
    return Study("free gyrostat", turning(q, w) + list(zip(M, cross(M, w))), moment[:, None], starts, [end],
                 lambda x: upright(x[:, :4]))


# ---- rivals: states of all rows at the times, and the seconds ----


def by_batch(study: Study, tolerance: float, most: int) -> tuple[float, NDArray[np.float64]]:
    width = hy.recommended_simd_size()
    rows = min(len(study.starts), most) // width * width
    made = hy.taylor_adaptive_batch(study.equations, study.starts[:width].T.copy(), tol=tolerance, pars=study.parameters[:width].T.copy())
    out = np.empty((len(study.times), rows, study.starts.shape[1]))
    began = time.process_time()
    for i in range(0, rows, width):
        made.set_time(0.0)
        made.state[:] = study.starts[i:i + width].T
        made.pars[:] = study.parameters[i:i + width].T
        for k, t in enumerate(study.times):
            made.propagate_until(t)
            out[k, i:i + width] = made.state.T
    return (time.process_time() - began) / rows, out


def by_ensemble(study: Study, tolerance: float) -> float:
    made = hy.taylor_adaptive(study.equations, study.starts[0], tol=tolerance, pars=study.parameters[0])

    def row(integrator: Any, i: int) -> Any:
        integrator.time = 0.0
        integrator.state[:] = study.starts[i]
        integrator.pars[:] = study.parameters[i]
        return integrator

    began = time.process_time()
    rows = min(len(study.starts), 512)
    hy.ensemble_propagate_until(made, study.times[-1], rows, row)
    return (time.process_time() - began) / rows


def by_scipy(study: Study, tolerance: float, rows: int) -> tuple[float, NDArray[np.float64]]:
    rates = [expression for _, expression in study.equations]
    variables = [variable for variable, _ in study.equations]
    compiled = hy.cfunc(rates, variables)
    out = np.empty((len(study.times), rows, study.starts.shape[1]))
    began = time.process_time()
    for i in range(rows):
        pars = study.parameters[i]
        solved = solve_ivp(lambda t, x: compiled(x, pars=pars), (0, study.times[-1]), study.starts[i], "DOP853", study.times, rtol=tolerance,
                           atol=tolerance)
        out[:, i] = solved.y.T
    return (time.process_time() - began) / rows, out


def truth(study: Study) -> NDArray[Any]:
    long = np.longdouble
    out = np.empty((len(study.times), CHECKED, study.starts.shape[1]), long)
    made = hy.taylor_adaptive(study.equations, study.starts[0].astype(long), pars=study.parameters[0].astype(long), fp_type=long, tol=long(1e-18),
                              compact_mode=True)
    for i in range(CHECKED):
        made.time = long(0)
        made.state[:] = study.starts[i]
        made.pars[:] = study.parameters[i]
        for k, t in enumerate(study.times):
            made.propagate_until(long(t))
            out[k, i] = made.state
    return out


def report(study: Study, ours: float, mine: NDArray[np.float64]) -> None:
    """mine: (times, CHECKED, k), what is compared."""
    right = [study.compared(x) for x in truth(study)]
    size = max(float(np.abs(x).max()) for x in right)

    def off(those: Any) -> float:
        return max(float(np.abs(a - b).max()) for a, b in zip(those, right)) / size

    error = off(mine)
    print(f"{study.name}: a row of the sweep {ours * 1e6:.2f} us, error {error:.1e}")
    for tolerance in TOLERANCES:
        seconds, states = by_batch(study, tolerance, CHECKED)
        theirs = off([study.compared(x[:CHECKED]) for x in states])
        if theirs <= error or tolerance == TOLERANCES[-1]:
            seconds, states = by_batch(study, tolerance, study.starts.shape[0])
            print(f"  heyoka batch of {hy.recommended_simd_size()}, tolerance {tolerance:.1e}: {seconds * 1e6:.1f} us, error {theirs:.1e}: {seconds / ours:.2f} times")
            one = by_ensemble(study, tolerance)
            print(f"  heyoka ensemble, the same tolerance: {one * 1e6:.1f} us: {one / ours:.2f} times")
            break
    for tolerance in (10.0**-k for k in range(5, 14)):
        seconds, states = by_scipy(study, tolerance, 1)
        theirs = max(float(np.abs(study.compared(a) - b[:1]).max()) for a, b in zip(states, right)) / size
        if theirs <= error or tolerance < 2e-13:
            print(f"  a loop over SciPy's DOP853, compiled right-hand side, tolerance {tolerance:.0e}: {seconds * 1e6:.0f} us, error {theirs:.1e}: {seconds / ours:.0f} times")
            break


def sweep(scene: dict[str, Any], cases: dict[str, NDArray[np.float64]], ask: list[str]) -> tuple[float, Any]:
    seconds, made = [], None
    for _ in range(3):
        began = time.process_time()
        made = gyrostat.sweep(scene, cases=cases, ask=ask, threads=1)
        seconds.append(time.process_time() - began)
    return min(seconds) / len(next(iter(cases.values()))), made


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=4096)
    parser.add_argument("--periods", type=float, default=1000)
    given = parser.parse_args()
    print(f"heyoka {hy.__version__}, gyrostat at level {gyrostat.build_info()['level']}, {given.rows} rows")
    random = np.random.default_rng(1)
    first, second = random.normal(1, 0.01, (2, given.rows))
    for tolerance in (1e-6, 1e-9):
        slope, no_load = 0.05 * first, NO_LOAD * second
        ours, rows = sweep(rotor_scene(tolerance), {"motor.slope": slope, "motor.no_load_rate": no_load}, ["angular_velocity"])
        report(rotor_study(slope, no_load), ours, np.moveaxis(np.asarray(rows["angular_velocity"])[:CHECKED], 1, 0))
    period = float(gyrostat.solve(free_scene(1.0) | {"solve": {"times": [1.0], "ask": "all"}}).scalars["period"])
    end = given.periods * period
    moment, rate = J[0] * first, START[0] * second
    ours, rows = sweep(free_scene(end), {"body.inertia[0]": moment, "initial.angular_velocity[0]": rate}, ["attitude"])
    mine = np.asarray(rows["attitude"])[:CHECKED, -1][:, [3, 0, 1, 2]]
    print(f"{given.periods:g} periods of {period:.2f} s:")
    report(free_study(moment, rate, end), ours, upright(mine)[None])


if __name__ == "__main__":
    main()
