# SPDX-License-Identifier: BSD-3-Clause
"""Times heyoka on the scenes of spinning_full_bench.

    python bench/rivals_heyoka_spinning.py [--repeat 7] [--tolerances 6 9 12 15]

Two states: 13 numbers (rates, quaternion, velocity, position), as the library has, and 19 (rates, rotation tensor, spin angle,
velocity, position). The integrator is compiled once (batch size 1) and only propagate_until is timed, in thread CPU time. The error is
the true one, as the bench measures it, against heyoka itself in quadruple precision where that is built in, else against its own
state of 13 numbers at the tolerance 1e-18 (rounding then limits it).
"""

from __future__ import annotations

import argparse
import statistics
import time

import heyoka as hy
import numpy as np

GALILEO = dict(D=(2985.0, 2729.0, 4183.0), m=2017.0, M=(4.0, -2.0, 0.0), f=(2.0, -1.0, 400.0), Lambda=0.0,
               omega=(0.002, -0.003, 1.0471975511965976), angles=(0.004, -0.002, 0.3))
PUBLISHED = dict(D=(8.7, 8.6, 11.1), m=10.0, M=(4.0, 0.0, 0.0), f=(0.0, 0.0, 3.0), Lambda=1.3 - 0.29099800111055549,
                 omega=(0.0, 0.0, 0.2827433388230814), angles=(0.0, 0.0, 0.0))
SCENES = [(GALILEO, 120.0), (GALILEO, 1200.0), (PUBLISHED, 50.0)]


def tensor(w, x, y, z):
    return [[1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)]]


def start_tensor(angles):
    psi, phi, theta = angles
    c, s = np.cos, np.sin
    z = np.array([[c(theta), -s(theta), 0], [s(theta), c(theta), 0], [0, 0, 1]])
    x = np.array([[1, 0, 0], [0, c(psi), -s(psi)], [0, s(psi), c(psi)]])
    y = np.array([[c(phi), 0, s(phi)], [0, 1, 0], [-s(phi), 0, c(phi)]])
    return z @ x @ y


def start_quaternion(angles):
    R = start_tensor(angles)
    w = np.sqrt(1 + np.trace(R)) / 2
    return [w, (R[2, 1] - R[1, 2]) / 4 / w, (R[0, 2] - R[2, 0]) / 4 / w, (R[1, 0] - R[0, 1]) / 4 / w]


def rates(scene):
    p, q, r = hy.make_vars("p", "q", "r")
    (D1, D2, D3), M, Lambda = scene["D"], scene["M"], scene["Lambda"]
    return (p, q, r), [(p, (M[0] - q * ((D3 - D2) * r + Lambda)) / D1), (q, (M[1] + p * ((D3 - D1) * r + Lambda)) / D2),
                       (r, (M[2] - (D2 - D1) * p * q) / D3)]


def motion(scene, R):
    v, x = hy.make_vars("v1", "v2", "v3"), hy.make_vars("x1", "x2", "x3")
    a = [sum(R[i][j] * scene["f"][j] for j in range(3)) / scene["m"] for i in range(3)]
    return [*zip(v, a), *zip(x, v)]


def with_quaternion(scene):
    (p, q, r), equations = rates(scene)
    w, x, y, z = hy.make_vars("w", "x", "y", "z")
    equations += [(w, -0.5 * (x * p + y * q + z * r)), (x, 0.5 * (w * p + y * r - z * q)),
                  (y, 0.5 * (w * q - x * r + z * p)), (z, 0.5 * (w * r + x * q - y * p))]
    return equations + motion(scene, tensor(w, x, y, z)), [*scene["omega"], *start_quaternion(scene["angles"]), *[0.0] * 6]


def with_tensor(scene):
    (p, q, r), equations = rates(scene)
    R = [list(hy.make_vars(*(f"R{i}{j}" for j in range(3)))) for i in range(3)]
    for row in R:
        equations += [(row[0], row[1] * r - row[2] * q), (row[1], row[2] * p - row[0] * r), (row[2], row[0] * q - row[1] * p)]
    theta = hy.make_vars("theta")
    equations.append((theta, (r * R[2][2] + p * R[2][0]) / (R[2][0] ** 2 + R[2][2] ** 2)))
    state = [*scene["omega"], *start_tensor(scene["angles"]).ravel(), scene["angles"][2], *[0.0] * 6]
    return equations + motion(scene, R), state


def seen(state):
    """Rates, rotation tensor, velocity, position."""
    state = np.asarray(state, dtype=float)
    if len(state) == 13:
        q = state[3:7] / np.linalg.norm(state[3:7])
        return state[:3], np.array(tensor(*q)), state[7:10], state[10:13]
    return state[:3], state[3:12].reshape(3, 3), state[13:16], state[16:19]


def error(found, right):
    far = [np.linalg.norm(a - b) / np.linalg.norm(b) for a, b in zip((found[0], *found[2:]), (right[0], *right[2:]))]
    return max(*far, np.linalg.norm(found[1] - right[1]) / np.sqrt(2))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("--tolerances", type=float, nargs="+", default=[6, 8, 9, 10, 11, 12, 13, 14, 15, 16])
    arguments = parser.parse_args()
    print(f"heyoka {hy.__version__}")
    print("scene state tolerance order steps microseconds error mode")
    for number, (scene, end) in enumerate(SCENES):
        equations, start = with_quaternion(scene)
        finest = hy.taylor_adaptive(equations, start, tol=1e-18)
        finest.propagate_until(end)
        right = seen(finest.state)
        for make, size in ((with_quaternion, 13), (with_tensor, 19)):
            equations, start = make(scene)
            for exponent in arguments.tolerances:
                tolerance = 10.0**-exponent
                for compact in (False, True):
                    integrator = hy.taylor_adaptive(equations, start, tol=tolerance, compact_mode=compact)
                    seconds = []
                    for _ in range(arguments.repeat):
                        integrator.time = 0.0
                        integrator.state[:] = start
                        begin = time.thread_time()
                        steps = integrator.propagate_until(end)[3]
                        seconds.append(time.thread_time() - begin)
                    mode = "compact" if compact else "unrolled"
                    print(f"{number} {size} {tolerance:.0e} {integrator.order} {steps} {statistics.median(seconds) * 1e6:.1f} "
                          f"{error(seen(integrator.state), right):.2e} {mode}", flush=True)


if __name__ == "__main__":
    main()
