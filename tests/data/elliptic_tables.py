#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write the tables elliptic_*.csv beside this file (needs mpmath; a minute).

Every row starts with `small` and `side`: the smaller of k2 and kp2, an exact binary fraction of 24 bits (so float,
double and long double read the same number), and which of the two it is. The other is 1 - small. u, phi and n are
exact in 24 bits too. Values come from mpmath in 400 digits, enough for 1 - 1e-300, and are printed with 30. Near
k2 = 1 the Jacobi functions come from Jacobi's imaginary transformation, elsewhere from mpmath's own.
"""

import random
from pathlib import Path

import mpmath as mp

mp.mp.dps = 400
HERE = Path(__file__).parent
rng = random.Random(20)


def exact(x):
    """x rounded to 24 significant bits, at any exponent."""
    m, e = mp.frexp(mp.mpf(x))
    return mp.ldexp(mp.nint(mp.ldexp(m, 24)), int(e) - 24)


def text(x):
    return mp.nstr(x, 30, min_fixed=1, max_fixed=0)


def read(x):
    return mp.nstr(x, 60, min_fixed=1, max_fixed=0) if x else "0"


def moduli(exponents, extra):
    values = [exact(mp.mpf(10) ** e * rng.uniform(1, 3)) for e in exponents] + [exact(x) for x in extra]
    return [(v, side) for v in values for side in ("k2", "kp2")]


def square(small, side):
    return small if side == "k2" else 1 - small


def complete(small, side):
    k2 = square(small, side)
    k, e = mp.ellipk(k2), mp.ellipe(k2)
    return k, e, e / k, 1 - e / k, k2 - 1 + e / k


def jacobi(u, small, side):
    k2 = square(small, side)
    k, _, f, _, _ = complete(small, side)
    n = mp.nint(u / (2 * k))
    r = u - 2 * k * n
    if side == "k2":
        sn, cn, dn = (mp.ellipfun(name, r, m=k2).real for name in ("sn", "cn", "dn"))
    else:
        sn = mp.ellipfun("sc", mp.mpc(0, r), m=small).imag
        cn, dn = (mp.ellipfun(name, mp.mpc(0, r), m=small).real for name in ("nc", "dc"))
    am = mp.atan2(sn, cn)
    zeta = mp.ellipe(am, k2) - f * r
    sign = -1 if n % 2 else 1
    return sign * sn, sign * cn, dn, am + n * mp.pi, zeta


def write(name, header, rows):
    path = HERE / f"elliptic_{name}.csv"
    path.write_text("\n".join(["# written by elliptic_tables.py", header, *(",".join(r) for r in rows)]) + "\n")
    print(path.name, len(rows), "rows")


def main():
    spread = [-300, -250, -200, -150, -100, -70, -50, -37, -30, -25, -20, -18, -16, -15, -14, -12, -10, -9, -8, -7, -6,
              -5, -4, -3, -2]
    middle = [i / 40 + rng.uniform(-0.01, 0.01) for i in range(1, 20)] + [0.5, 0.49, 0.4999]
    write("complete", "small,side,K,E,F,W,V",
          [[read(s), side, *map(text, complete(s, side))] for s, side in moduli(spread, middle)])

    few = [-300, -200, -100, -50, -37, -30, -20, -16, -12, -8, -5, -3, -2]
    some = [0.05, 0.1, 0.2, 0.3, 0.4, 0.45, 0.5]
    rows = []
    for s, side in moduli(few, some):
        k = complete(s, side)[0]
        for u in (mp.mpf("1e-20"), 1e-5, 0.1, 0.7, 0.49 * k, 0.51 * k, 0.9 * k, 1.3 * k, -1.8 * k, 2.4 * k, -7.7 * k,
                  rng.uniform(20, 40) * k):
            u = exact(u)
            rows.append([read(s), side, read(u), *map(text, jacobi(u, s, side))])
    write("functions", "small,side,u,sn,cn,dn,am,zeta", rows)

    rows = []
    for s, side in moduli(few, some):
        k2 = square(s, side)
        for phi, n in ((1e-10, 0.5), (0.3, 0.9), (0.8, -0.5), (1.2, -300), (1.5, 1e-6), (-1.57, 0.99), (2.5, 0.3),
                       (-4.2, -2), (40.3, 0.7), (0.5, 2)):
            phi, n = exact(phi), exact(n)
            rows.append([read(s), side, read(phi), read(n), text(mp.ellipf(phi, k2)), text(mp.ellipe(phi, k2)),
                         text(mp.ellippi(n, phi, k2).real)])
    write("incomplete", "small,side,phi,n,F,E,Pi", rows)


if __name__ == "__main__":
    main()
