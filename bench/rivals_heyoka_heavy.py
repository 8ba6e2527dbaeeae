# SPDX-License-Identifier: BSD-3-Clause
"""Times heyoka on the motions of heavy_full_bench: a fast spin over 1 and over 100 periods, and a slow tumble of 10 s.

    python bench/rivals_heyoka_heavy.py [--repeat 9]

The integrator is compiled once a tolerance (batch size 1) and only propagate_until is timed, in thread CPU time. The
error is the true one: the greater of the relative error of the rates and that of down at the end.
"""

from __future__ import annotations

import argparse
import statistics
import time

import heyoka as hy
import numpy as np

A, B, C = 0.0011, 0.0016, 0.0020
MASS, GRAVITY, GRADIENT = 0.8, 9.80665, 4.617791555485795e-6
CENTRE = (0.012, 0.009, 0.010)
PERIOD = 0.04196818797409593
FAST = [-0.3767774621242862, 0.1192263074750677, 150.0, 0.99498743710662, 0.0, 0.1]
SLOW = [3.0, -2.0, 8.0, 0.6, 0.0, 0.8]

# (p, q, r, d1, d2, d3) at the end, from Taylor series in long double at two step tolerances
SCENES = [
    (
        "fast, 1 period",
        FAST,
        PERIOD,
        (-0.3767774621242862076, 0.1192263074750676356, 149.9999999999999999,
         0.9949874371066199651, -5.085179239500137172e-16, 0.100000000000000006),
    ),
    (
        "fast, 100 periods",
        FAST,
        100 * PERIOD,
        (-0.3767774621242862388, 0.1192263074750677306, 149.9999999999999997,
         0.9949874371066199651, -1.11680955282300598e-15, 0.1000000000000000066),
    ),
    (
        "slow, 10 s",
        SLOW,
        10.0,
        (1.774493619648050775, -2.14467766229695396, 8.606642612094614453,
         0.4142587316539332986, 0.2771931746369844855, 0.8669219383445921003),
    ),
]


def equations():
    """I w' = (I w) x w + M g r x d + N d x (I d), d' = d x w."""
    p, q, r, d1, d2, d3 = hy.make_vars("p", "q", "r", "d1", "d2", "d3")
    x, y, z = (MASS * GRAVITY * c for c in CENTRE)
    return [
        (p, (B - C) / A * (q * r - GRADIENT * (d2 * d3)) + (y / A * d3 - z / A * d2)),
        (q, (C - A) / B * (r * p - GRADIENT * (d3 * d1)) + (z / B * d1 - x / B * d3)),
        (r, (A - B) / C * (p * q - GRADIENT * (d1 * d2)) + (x / C * d2 - y / C * d1)),
        (d1, r * d2 - q * d3),
        (d2, p * d3 - r * d1),
        (d3, q * d1 - p * d2),
    ]


def error(state, truth):
    truth = np.array(truth)
    return max(np.linalg.norm(state[i : i + 3] - truth[i : i + 3]) / np.linalg.norm(truth[i : i + 3]) for i in (0, 3))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=9)
    arguments = parser.parse_args()
    print(f"heyoka {hy.__version__}")
    print("tolerance order mode: scene steps microseconds error")
    for exponent in range(6, 17):
        for compact in (False, True):
            integrator = hy.taylor_adaptive(equations(), FAST, tol=10.0**-exponent, compact_mode=compact)
            mode = "compact" if compact else "unrolled"
            for name, start, end, truth in SCENES:
                seconds = []
                for _ in range(arguments.repeat):
                    integrator.time = 0.0
                    integrator.state[:] = start
                    begin = time.thread_time()
                    steps = integrator.propagate_until(end)[3]
                    seconds.append(time.thread_time() - begin)
                print(
                    f"1e-{exponent:02d} {integrator.order} {mode}: {name} {steps}"
                    f" {statistics.median(seconds) * 1e6:.1f} {error(integrator.state, truth):.2e}"
                )


if __name__ == "__main__":
    main()
