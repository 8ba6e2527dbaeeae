#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Generate include/gyrostat/math/complete_coefficients.hpp (needs mpmath).

The associate complete integrals of x = kp2,
    B = int cos^2/sqrt(1 - k2 sin^2),   D = int sin^2/sqrt(1 - k2 sin^2)   over [0, pi/2],
are fitted on 0 < x <= 1 as P(x) - ln(x) Q(x), both polynomials of one degree, with P(0) and Q(0) exact, so that the
greatest relative error is least (Remez exchange in 60 digits; the basis x^i, x^i ln x is a Chebyshev system). The
logarithm 1/r^3 (ln(1+r) - r + r^2/2) is fitted on the binade around 1 with the greatest absolute error of ln least,
q/k2 of the nome q is fitted on 0 <= k2 <= 1/2 as a polynomial of k2 with the greatest relative error least,
and (atan t - t)/t^3 as a polynomial of t^2 up to tan(pi/8) with the greatest relative error of atan least.
"""

import sys
from pathlib import Path

import mpmath as mp

mp.mp.dps = 60


def remez(target, basis, weight, points, rounds=30):
    """Coefficients c with |weight (target - sum c basis)| equioscillating on the grid `points`; and the error."""
    grid = [(target(x), [b(x) for b in basis], weight(x)) for x in points]
    n, count = len(basis), len(points)
    chosen = [round((1 - mp.cos(mp.pi * i / n)) / 2 * (count - 1)) for i in range(n + 1)]
    for _ in range(rounds):
        a, r = mp.matrix(n + 1, n + 1), mp.matrix(n + 1, 1)
        for row, j in enumerate(chosen):
            f, phi, w = grid[j]
            for col in range(n):
                a[row, col] = phi[col]
            a[row, n] = (-1) ** row / w
            r[row] = f
        solution = mp.lu_solve(a, r)
        c, level = list(solution[:n]), abs(solution[n])
        error = [w * (f - mp.fdot(c, phi)) for f, phi, w in grid]
        worst = max(abs(e) for e in error)
        # one extremum of each run of one sign, then the n + 1 in a row that hold the greatest
        runs = []
        for j, e in enumerate(error):
            if runs and (error[runs[-1]] > 0) == (e > 0):
                if abs(e) > abs(error[runs[-1]]):
                    runs[-1] = j
            else:
                runs.append(j)
        while len(runs) > n + 1:
            if len(runs) - (n + 1) >= 2:
                k = min(range(len(runs) - 1), key=lambda i: max(abs(error[runs[i]]), abs(error[runs[i + 1]])))
                del runs[k:k + 2]
            else:
                del runs[0 if abs(error[runs[0]]) < abs(error[runs[-1]]) else -1]
        if len(runs) < n + 1:
            raise RuntimeError("lost an extremum: refine the grid")
        chosen = runs
        if worst < level * mp.mpf("1.02"):
            break
    return c, worst


def associate(name, degree):
    def values(x):
        k2 = 1 - x
        if x == 1:
            return mp.pi / 4
        if k2 < mp.mpf("1e-12"):  # far below the fit's error
            k, e = mp.ellipk(k2), mp.ellipe(k2)
            with mp.workdps(100):
                k, e = mp.ellipk(1 - x), mp.ellipe(1 - x)
        else:
            k, e = mp.ellipk(k2), mp.ellipe(k2)
        return (e - x * k) / k2 if name == "B" else (k - e) / k2

    p0 = mp.mpf(1) if name == "B" else mp.log(4) - 1
    q0 = mp.mpf(0) if name == "B" else mp.mpf(1) / 2
    cache = {}

    def full(x):
        if x not in cache:
            cache[x] = values(x)
        return cache[x]

    basis = []
    for i in range(1, degree + 1):
        basis.append(lambda x, i=i: x ** i)
        basis.append(lambda x, i=i: -x ** i * mp.log(x))
    points = [((1 - mp.cos(mp.pi * mp.mpf(i) / 1200)) / 2) ** 3 for i in range(20, 1201)]
    c, worst = remez(lambda x: full(x) - p0 + q0 * mp.log(x), basis, lambda x: 1 / full(x), points)
    return [p0] + c[0::2], [q0] + c[1::2], worst


def logarithm(terms):
    low, high = 1 / mp.sqrt(2) - 1, mp.sqrt(2) - 1
    points = [low + (high - low) * (1 - mp.cos(mp.pi * mp.mpf(i) / 1200)) / 2 for i in range(1201)]

    def rest(r):
        return (mp.log1p(r) - r + r * r / 2) / r ** 3

    return remez(rest, [lambda r, i=i: r ** i for i in range(terms)], lambda r: abs(r) ** 3 + mp.mpf("1e-4"), points)


def arctangent(terms):
    high = mp.tan(mp.pi / 8) ** 2
    points = [high * (1 - mp.cos(mp.pi * mp.mpf(i) / 1200)) / 2 for i in range(1, 1201)]

    def rest(x):
        t = mp.sqrt(x)
        return (mp.atan(t) / t - 1) / x

    return remez(rest, [lambda x, i=i: x ** i for i in range(terms)], lambda x: x + mp.mpf("1e-6"), points)


def nome(terms):
    points = [mp.mpf("0.5") * (1 - mp.cos(mp.pi * mp.mpf(i) / 1200)) / 2 for i in range(1201)]
    cache = {x: mp.qfrom(m=x) / x if x else mp.mpf(1) / 16 for x in points}
    return remez(cache.get, [lambda x, i=i: x ** i for i in range(terms)], lambda x: 1 / cache[x], points)


def row(name, values):
    body = ",\n    ".join(", ".join(mp.nstr(v, 20) for v in values[i:i + 4]) for i in range(0, len(values), 4))
    return f"inline constexpr double {name}[] = {{\n    {body}}};\n"


def main():
    degree = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    terms = int(sys.argv[2]) if len(sys.argv) > 2 else 17
    text = ""
    for name in "BD":
        p, q, worst = associate(name, degree)
        print(f"{name}: relative error {mp.nstr(worst, 3)}", file=sys.stderr)
        text += row(f"{name}_regular", p) + row(f"{name}_logarithmic", q)
    c, worst = logarithm(terms)
    print(f"ln: absolute error {mp.nstr(worst, 3)}", file=sys.stderr)
    text += row("logarithm", c)
    c, worst = nome(20)
    print(f"nome: relative error {mp.nstr(worst, 3)}", file=sys.stderr)
    text += row("nome_over_k2", c)
    c, worst = arctangent(10)
    print(f"atan: relative error {mp.nstr(worst, 3)}", file=sys.stderr)
    text += row("arctangent", c)
    head = f"""// SPDX-License-Identifier: BSD-3-Clause
// Written by tools/elliptic_coefficients.py {degree} {terms}; what the numbers are is said there.
#pragma once

namespace gyrostat::math::detail {{

"""
    path = Path(__file__).parent.parent / "include/gyrostat/math/complete_coefficients.hpp"
    path.write_text(head + text + "\n}  // namespace gyrostat::math::detail\n", encoding="utf-8")


if __name__ == "__main__":
    main()
