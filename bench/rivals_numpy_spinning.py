# SPDX-License-Identifier: BSD-3-Clause
"""Times numpy on the scene of spinning_grid_bench: 13 quantities of the linear motion on an even grid, by partial fractions.

    python bench/rivals_numpy_spinning.py [--points 128 1024 8192 2000000] [--repeat 7]

One exponential for each frequency and the fewest products that numpy allows; thread CPU time a point, best of the repeats.
"""

from __future__ import annotations

import argparse
import cmath
import math
import time

import numpy as np

D1, D2, D3, MASS = 8.7, 8.2, 11.1, 10.0
LAMBDA3, CHARGE = 1.3, 0.29
TORQUE, FORCE, AXIAL_FORCE = 0.4 - 0.27j, 0.7 - 1.1j, 3.0
P0, R0, TILT, THETA = 0.02 - 0.03j, 1.1, 0.05 - 0.02j, 0.3
V0, V30, X0, X30 = 0.1 - 0.2j, 0.3, 1 + 2j, 3.0
STEP = 0.01


def modes() -> dict[str, complex]:
    """Amplitudes of the modes of the rates and of the tilt."""
    gyroscopic = LAMBDA3 - CHARGE
    k1, k2 = ((D3 - D2) * R0 + gyroscopic) / D1, ((D3 - D1) * R0 + gyroscopic) / D2
    nu = math.sqrt(k1 * k2)
    m = TORQUE.real / D1 + 1j * TORQUE.imag / D2
    b = complex(m.real - k1 * P0.imag, m.imag + k2 * P0.real)
    d = complex(-k1 * b.imag, k2 * b.real)
    up, down = b / (2j * nu) - d / (2 * nu**2), -b / (2j * nu) - d / (2 * nu**2)
    constant = P0 + d / nu**2
    g = {"c": constant / (1j * R0), "+": up / (1j * (R0 + nu)), "-": down / (1j * (R0 - nu))}
    return {"nu": nu, "pc": constant, "p+": up, "p-": down, "gc": g["c"], "g+": g["+"], "g-": g["-"],
            "gr": TILT - sum(g.values())}


def motion(t: np.ndarray, a: dict[str, complex]) -> list[np.ndarray]:
    """p, q, psi, phi, theta, G1, G2, v1, v2, v3, x1, x2, x3."""
    nu = a["nu"].real
    turn, heading = np.exp(1j * nu * t), cmath.exp(1j * THETA)
    spin = np.exp(1j * R0 * t)
    back = turn.conj()
    rates = a["pc"] + a["p+"] * turn + a["p-"] * back
    tilt = a["gc"] + a["g+"] * turn + a["g-"] * back + a["gr"] * spin.conj()
    L3 = D3 * R0 + LAMBDA3
    start = D1 * P0.real + 1j * D2 * P0.imag - 1j * L3 * TILT
    centre = heading * (start + 1j * CHARGE * TILT + 1j * TORQUE / R0)
    momentum = centre + heading * spin * (-1j * TORQUE / R0 - 1j * CHARGE * tilt)
    f, f3 = FORCE / MASS, AXIAL_FORCE / MASS
    w = (1j * R0, 1j * (R0 + nu), 1j * (R0 - nu))
    v = [(f - 1j * f3 * a["gc"]) / w[0], -1j * f3 * a["g+"] / w[1], -1j * f3 * a["g-"] / w[2]]
    x = [v[i] / w[i] for i in range(3)]
    drift, rest = -1j * f3 * a["gr"] * heading, V0 - heading * sum(v)
    velocity = rest + drift * t + heading * spin * (v[0] + v[1] * turn + v[2] * back)
    position = (X0 - heading * sum(x)) + t * (rest + drift / 2 * t) + heading * spin * (x[0] + x[1] * turn + x[2] * back)
    s = 1j * f.conjugate()
    b = [a["gr"] / (-1j * R0), a["g+"] / (1j * nu), a["g-"] / (-1j * nu)]
    c = [b[0] / (-1j * R0), b[1] / (1j * nu), b[2] / (-1j * nu)]
    axial, along = V30 - (s * sum(b)).real, f3 + (s * a["gc"]).real
    v3 = axial + along * t + (s * b[0] * spin.conj() + s * b[1] * turn + s * b[2] * back).real
    x3 = (X30 - (s * sum(c)).real + t * (axial + along / 2 * t)
          + (s * c[0] * spin.conj() + s * c[1] * turn + s * c[2] * back).real)
    return [rates.real, rates.imag, tilt.real, tilt.imag, R0 * t + THETA, momentum.real, momentum.imag, velocity.real,
            velocity.imag, v3, position.real, position.imag, x3]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, nargs="+", default=[128, 1024, 8192, 2000000])
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("--print", action="store_true", help="the 13 quantities at the last point, for comparison")
    arguments = parser.parse_args()
    a = modes()
    print(f"numpy {np.__version__}\npoints ns/point")
    for points in arguments.points:
        t = STEP * np.arange(points)
        loops = max(1, 200000 // points)
        best = math.inf
        for _ in range(arguments.repeat):
            begin = time.thread_time()
            for _ in range(loops):
                values = motion(t, a)
            best = min(best, (time.thread_time() - begin) / loops / points)
        print(f"{points} {best * 1e9:.1f}")
        if arguments.print:
            print(" ".join(f"{column[-1]:.15g}" for column in values))


if __name__ == "__main__":
    main()
