# SPDX-License-Identifier: BSD-3-Clause
"""Times heyoka on the scene of full_bench: despin of J = (1.4, 1, 0.7) from |M| = 1 to |M| = 1/2.

    python bench/rivals_heyoka.py [--epsilon 1e-3 1e-4] [--repeat 7]

The integrator is compiled once (batch size 1) and only propagate_until is timed, in thread CPU time. The error is the true one: the
momentum at the time when |M| = 1/2, greatest component, against the reference printed by full_bench --reference.
"""

from __future__ import annotations

import argparse
import math
import statistics
import time

import heyoka as hy

INERTIA = (1.4, 1.0, 0.7)
CONTROL = (0.6, 0.9, 1.0)
DRAG = 0.3
START = (0.8, 0.5, 0.33166247903554)

# time and momentum where |M| = 1/2, from Taylor series in long double (agree at two tolerances to 1e-17)
REFERENCE = {
    1e-3: (538.974306798107508, (0.424251222174135200, -0.237071200338104866, -0.117508069739923482)),
    1e-4: (5389.96745284942737, (0.441875390549955640, 0.175497734339381457, -0.154747163037220377)),
}


def equations(epsilon: float):
    """The full equations dM/dt = M x w - eps (lambda M + b M/|M|)."""
    m = hy.make_vars("m1", "m2", "m3")
    norm = hy.sqrt(m[0] ** 2 + m[1] ** 2 + m[2] ** 2)
    w = [m[i] / INERTIA[i] for i in range(3)]
    rates = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        torque = -epsilon * (DRAG * m[i] + CONTROL[i] * m[i] / norm)
        rates.append((m[i], m[j] * w[k] - m[k] * w[j] + torque))
    return rates


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--epsilon", type=float, nargs="+", default=[1e-3, 1e-4])
    parser.add_argument("--repeat", type=int, default=7)
    arguments = parser.parse_args()
    size = math.sqrt(sum(x * x for x in START))
    start = [x / size for x in START]
    print(f"heyoka {hy.__version__}")
    print("epsilon tolerance order steps microseconds error")
    for epsilon in arguments.epsilon:
        t_end, reference = REFERENCE[epsilon]
        for exponent in range(6, 17):
            tolerance = 10.0**-exponent
            for compact in (False, True):
                integrator = hy.taylor_adaptive(equations(epsilon), start, tol=tolerance, compact_mode=compact)
                seconds = []
                for _ in range(arguments.repeat):
                    integrator.time = 0.0
                    integrator.state[:] = start
                    begin = time.thread_time()
                    steps = integrator.propagate_until(t_end)[3]
                    seconds.append(time.thread_time() - begin)
                error = max(abs(a - b) for a, b in zip(integrator.state, reference))
                mode = "compact" if compact else "unrolled"
                print(
                    f"{epsilon:.0e} 1e-{exponent:02d} {integrator.order} {steps} {statistics.median(seconds) * 1e6:.1f} {error:.2e} {mode}"
                )


if __name__ == "__main__":
    main()
