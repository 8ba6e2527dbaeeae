# SPDX-License-Identifier: BSD-3-Clause
"""A free gyrostat after 10 000 periods: the closed form against heyoka's Taylor series, in one run.

    python bench/rivals_heyoka_free.py [--periods 10000] [--repeat 5]

heyoka's integrator is compiled once; only propagate_until is timed. Of the closed form one solution with one late time is timed (set-up, error estimate and Python
included), and what a time costs where 100 001 scattered times are asked at once. Thread CPU time, the least of the repeats. Both errors are the angle to the closed
form of the same data in double-double, whose own error is printed as stated.
"""

from __future__ import annotations

import argparse
import time
from typing import Any, Callable

import gyrostat
import gyrostat.free
import heyoka as hy
import numpy as np
from gyrostat.rotation import angle_between

J, L, START = np.array([35.0, 22.0, 16.0]), np.array([3.0, -2.0, 5.0]), np.array([0.4, 0.55, 0.7])


def equations() -> list[Any]:
    """dM/dt = M x w, dq/dt = q (0, w)/2, w = J^-1 (M - l)."""
    q, M = hy.make_vars("w", "x", "y", "z"), hy.make_vars("m1", "m2", "m3")
    w = [(M[i] - L[i]) * (1 / J[i]) for i in range(3)]
    return [(q[0], -0.5 * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2])), (q[1], 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1])),
            (q[2], 0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2])), (q[3], 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0])),
            (M[0], M[1] * w[2] - M[2] * w[1]), (M[1], M[2] * w[0] - M[0] * w[2]), (M[2], M[0] * w[1] - M[1] * w[0])]


def least(repeat: int, run: Callable[[], Any]) -> tuple[float, Any]:
    seconds, made = [], None
    for _ in range(repeat):
        began = time.thread_time()
        made = run()
        seconds.append(time.thread_time() - began)
    return min(seconds), made


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--periods", type=int, default=10_000)
    parser.add_argument("--repeat", type=int, default=5)
    given = parser.parse_args()
    body = {"inertia": J, "rotor_momentum": L, "angular_velocity": START}
    period = float(gyrostat.free.solve(**body, times=[1.0], ask="all").scalars["period"])
    end = given.periods * period
    truth = gyrostat.free.solve(**body, times=[end], tolerance=1e-11, model="closed-form")
    right = np.asarray(truth["attitude"])[-1]
    print(f"heyoka {hy.__version__}, {given.periods} periods of {period:.3f} s; truth known to {truth.error['attitude']:.1e} rad")

    once, answer = least(given.repeat, lambda: gyrostat.free.solve(**body, times=[end], tolerance=1e-6, ask=["attitude"]))
    some, more = (np.sort(np.random.default_rng(1).uniform(0, end, n)) for n in (1, 100_001))
    seconds = [least(given.repeat, lambda times=times: gyrostat.free.solve(**body, times=times, tolerance=1e-6, ask=["attitude"]))[0] for times in (some, more)]
    each = (seconds[1] - seconds[0]) / 100_000
    off = float(angle_between(np.asarray(answer["attitude"])[-1], right))
    print(f"closed form ({answer.model}): one solution {once * 1e6:.1f} us, {each * 1e9:.0f} ns a time; off by {off:.1e} rad, stated {answer.error['attitude']:.1e}")
    for tolerance in (1e-9, 1e-12, 1e-15):
        integrator = hy.taylor_adaptive(equations(), [1.0, 0.0, 0.0, 0.0, *(J * START + L)], tol=tolerance)

        def run(integrator: Any = integrator) -> Any:
            integrator.time = 0.0
            integrator.state[:] = [1.0, 0.0, 0.0, 0.0, *(J * START + L)]
            integrator.propagate_until(end)
            return integrator.state.copy()

        spent, state = least(given.repeat, run)
        w, x, y, z = state[:4] / np.linalg.norm(state[:4])
        print(f"heyoka, {tolerance:g}: {spent * 1e3:.1f} ms, off by {float(angle_between(np.array([x, y, z, w]), right)):.1e} rad;"
              f" {spent / each:.2g} times a time of the closed form, {spent / once:.2g} times one solution")


if __name__ == "__main__":
    main()
