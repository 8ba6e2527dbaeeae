#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write exp_difference.csv beside this file: divided differences of exp to 25 digits, from the exponential of a bidiagonal matrix
(Opitz 1964) at 80 digits. Needs mpmath.

Columns: number n of nodes; real and imaginary part of each node (exact doubles), n pairs; real and imaginary part of exp[nodes].
"""

import random
from pathlib import Path

import mpmath as mp

mp.mp.dps = 80


def difference(nodes):
    n = len(nodes)
    matrix = mp.zeros(n)
    for i, z in enumerate(nodes):
        matrix[i, i] = mp.mpc(z)
        if i + 1 < n:
            matrix[i, i + 1] = 1
    scale = 0  # exp(A) = exp(A/2^s)^(2^s), the power series at A/2^s
    while mp.norm(matrix, 1) * mp.mpf(2) ** -scale > 0.5:
        scale += 1
    small = matrix * mp.mpf(2) ** -scale
    total, term = mp.eye(n), mp.eye(n)
    for k in range(1, 70):
        term = term * small / k
        total += term
    for _ in range(scale):
        total = total * total
    return total[0, n - 1]


def cases():
    draw = random.Random(1)
    yield [0j]
    yield [0j] * 6
    yield [1j, -1j]
    yield [0j, 1e-9j, -1e-9j]
    yield [0j, 0j, 0j, 2.5j, 2.5j, 2.5j]
    yield [0j, 0j, 0j, 40j, 40j + 1e-6j, 1e-7j]
    yield [-700 + 0j, 0j, 0j]
    yield [30 + 0j, -30 + 0j, 0j]
    for n in range(2, 7):
        for size in (1e-3, 1.0, 5.0, 60.0):
            yield [complex(0, size * draw.uniform(-1, 1)) for _ in range(n)]
            yield [complex(size * draw.uniform(-1, 1), 0) for _ in range(n)]
            yield [complex(0.2 * size * draw.uniform(-1, 1), size * draw.uniform(-1, 1)) for _ in range(n)]
            centre = [complex(0, size * draw.uniform(-1, 1)) for _ in range(2)]
            yield [draw.choice(centre) + 1e-5j * draw.choice((0, 1, 2)) for _ in range(n)]


def main():
    with (Path(__file__).parent / "exp_difference.csv").open("w", encoding="utf-8") as file:
        file.write("# written by exp_difference_table.py\n")
        for nodes in cases():
            value = difference(nodes)
            cells = [str(len(nodes))]
            for z in nodes:
                cells += [repr(z.real), repr(z.imag)]
            for part in (value.real, value.imag):
                cells.append("0" if abs(part) < mp.mpf(10) ** -60 * abs(value) else mp.nstr(part, 25))
            file.write(",".join(cells) + "\n")


if __name__ == "__main__":
    main()
