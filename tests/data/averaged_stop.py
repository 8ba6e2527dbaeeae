#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The averaged stop time of reference case P06, by SciPy alone.

The averaged motion of P06 starts in regime C, passes the separatrix at |M| = 8.298e-4 and comes to rest in regime A. The
independent variable is x = -ln kp2 on both sides (deceleration.md, sections 2 and 7), so nothing is singular on the way.
Prints the slow time of the crossing and of the stop: 1.09755912 and 1.09871506. A motion that stayed on the separatrix
after the crossing (mean torque b2) would stop at 1.09848.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipe, ellipkm1

DRAG = 0.3
A = np.array([1 / 1.001, 1.0, 1 / 0.7])
START = np.array([0.8, 0.5, 0.33])


def rates(log_norm, x, mid_far, near_mid, near, mid, far):
    """d(ln M, tau)/dx on the polhode with kp2 = exp(-x)."""
    kp2, k2, M = np.exp(-x), -np.expm1(-x), np.exp(log_norm)
    F = ellipe(k2) / ellipkm1(kp2)
    W = 1 - F if k2 > 1e-4 else k2 / 2 + k2**2 / 16 + k2**3 / 32
    torque = near * mid_far * (1 - W) + mid * (mid_far + near_mid) * W + far * near_mid * (k2 - W)
    fall = DRAG * M + torque / (mid_far + near_mid * k2)
    spread = 2 * ((near - far) * (1 - W) * k2 / kp2 - (mid - far) * W)
    return [-fall / spread, M / spread]


def main():
    d21, d32 = A[1] - A[0], A[2] - A[1]
    squares, norm = START**2, np.linalg.norm(START)
    tilt = (d32 * squares[1] + (d21 + d32) * squares[0]) / ((d21 + d32) * norm**2)
    begin, end = -np.log1p(-d21 * tilt / (d32 * (1 - tilt))), 36.0
    options = {"rtol": 2e-13, "atol": 1e-17, "method": "DOP853"}
    to = solve_ivp(lambda x, z: rates(z[0], x, d21, d32, 1.0, 0.9, 0.6), [begin, end], [np.log(norm), 0.0], **options)
    on = solve_ivp(lambda x, z: rates(z[0], x, d32, d21, 0.6, 0.9, 1.0), [end, 1e-9], to.y[:, -1], **options)
    rest = np.exp(on.y[0, -1])
    print(f"crossing {to.y[1, -1]:.9f} at |M| = {np.exp(to.y[0, -1]):.6e}, stop {on.y[1, -1] + rest / 0.6:.9f}")


if __name__ == "__main__":
    main()
