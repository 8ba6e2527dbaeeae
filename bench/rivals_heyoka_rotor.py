# SPDX-License-Identifier: BSD-3-Clause
"""Times heyoka on the motion of rotor_full_bench: spin-up with R = diag(2.3, 2.9, 3.4), 200 s.

    python bench/rivals_heyoka_rotor.py [--repeat 9]

The integrator is compiled once (batch size 1) and only propagate_until is timed, in thread CPU time. The error is the true one: the
attitude at the end, rad.
"""

from __future__ import annotations

import argparse
import math
import statistics
import time

import heyoka as hy
import numpy as np

R = np.diag([2.3, 2.9, 3.4])
LAMBDA, SLOPE, NO_LOAD_RATE = 0.45, 0.05, 30.0
AXIS = np.array([0.36, 0.48, 0.8]) / math.sqrt(0.36**2 + 0.48**2 + 0.8**2)
DIRECTION = np.array([0.3, -0.5, 0.8]) / math.sqrt(0.3**2 + 0.5**2 + 0.8**2)
END = 200.0

# (w, x, y, z) at the end, from Taylor series in long double (orders 24 and 28 agree to 1e-16)
REFERENCE = np.array([0.7020784519390066817, 0.5894228731947941223, -0.2796656193992311120, -0.2854008850788061953])


def equations():
    """dq/dt = q (0, Omega)/2, dH/dt = H x Omega, dp/dt = -S (omega - omega*), Omega = R^-1 (H - p e)."""
    w, x, y, z, h1, h2, h3, p = hy.make_vars("w", "x", "y", "z", "h1", "h2", "h3", "p")
    h = (h1, h2, h3)
    o = [(h[i] - AXIS[i] * p) * (1 / R[i, i]) for i in range(3)]
    omega = p * (1 / LAMBDA) - (AXIS[0] * o[0] + AXIS[1] * o[1] + AXIS[2] * o[2])
    return [
        (w, -0.5 * (x * o[0] + y * o[1] + z * o[2])),
        (x, 0.5 * (w * o[0] + y * o[2] - z * o[1])),
        (y, 0.5 * (w * o[1] + z * o[0] - x * o[2])),
        (z, 0.5 * (w * o[2] + x * o[1] - y * o[0])),
        (h1, h2 * o[2] - h3 * o[1]),
        (h2, h3 * o[0] - h1 * o[2]),
        (h3, h1 * o[1] - h2 * o[0]),
        (p, -SLOPE * (omega - NO_LOAD_RATE)),
    ]


def start():
    """The rotor locked to the carrier: p = lambda e.theta^-1 H."""
    H = 8 * DIRECTION
    theta = R + LAMBDA * np.outer(AXIS, AXIS)
    return [1.0, 0.0, 0.0, 0.0, *H, LAMBDA * AXIS @ np.linalg.solve(theta, H)]


def angle(q):
    """Between the attitude q and the reference, rad."""
    q = np.asarray(q) / np.linalg.norm(q)
    difference = min(np.linalg.norm(q - REFERENCE), np.linalg.norm(q + REFERENCE))
    return 4 * math.asin(difference / 2)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=9)
    arguments = parser.parse_args()
    print(f"heyoka {hy.__version__}")
    print("tolerance order steps microseconds error")
    for exponent in range(6, 17):
        for compact in (False, True):
            integrator = hy.taylor_adaptive(equations(), start(), tol=10.0**-exponent, compact_mode=compact)
            seconds = []
            for _ in range(arguments.repeat):
                integrator.time = 0.0
                integrator.state[:] = start()
                begin = time.thread_time()
                steps = integrator.propagate_until(END)[3]
                seconds.append(time.thread_time() - begin)
            mode = "compact" if compact else "unrolled"
            print(
                f"1e-{exponent:02d} {integrator.order} {steps} {statistics.median(seconds) * 1e6:.1f}"
                f" {angle(integrator.state[:4]):.2e} {mode}"
            )


if __name__ == "__main__":
    main()
