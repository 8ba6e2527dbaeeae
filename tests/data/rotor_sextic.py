#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes rotor_sextic.csv: the steady rotations of 2000 realisable gyrostats from all roots of their sextic, in 120 digits.

With sigma = psi_dot/l and e in principal axes of theta (docs/rotor.md, section 4):
    sum_i (h e_i/l)^2 prod_{j != i} (1 - sigma theta_j)^2 - prod_i (1 - sigma theta_i)^2 = 0.
Where e_i = 0 the factor (1 - sigma theta_i)^2 is taken out and the pair m_i = +-sqrt(1 - sum m_j^2) is put in. The type is that of
the second derivative of F on the tangent plane. The decimal numbers of a row, rounded to doubles, are the exact data; e is then
normalised; omega* = 1, so that h = lambda.

Columns: kind, theta 11, 22, 33, 12, 13, 23, lambda, e1, e2, e3, l, then by ascending sigma: m(inimum), s(addle) or M(aximum), sigma.
Needs mpmath and NumPy; takes some minutes.
"""
import pathlib

import mpmath as mp
import numpy as np

mp.mp.dps = 120
random = np.random.default_rng(20240611)


def short(x, digits=7):
    return f"{x:.{digits}g}"


def unit():
    v = random.normal(size=3)
    return v / np.linalg.norm(v)


def realisable(theta, lam, e):
    second = np.trace(theta) / 2 * np.eye(3) - theta - lam / 2 * (np.eye(3) - np.outer(e, e))
    return np.linalg.eigvalsh(second)[0] > 1e-6


def moments():
    """Principal moments of a body that is not too thin."""
    second = np.exp(random.uniform(np.log(0.2), np.log(3), 3))
    return second.sum() - second


def rotor(theta, e):
    """An axial inertia with which the body is realisable, 4 digits."""
    top = np.linalg.eigvalsh(theta)[0]
    while True:
        lam = float(short(top * np.exp(random.uniform(np.log(0.01), np.log(0.6))), 4))
        if realisable(theta, lam, e):
            return lam
        top *= 0.9


def tensor(t):
    a, b, c, d, e, f = (float(x) for x in t)
    return np.array([[a, d, e], [d, b, f], [e, f, c]])


def diagonal(values, digits=7):
    values = random.permutation(values)
    return [short(x, digits) for x in values] + ["0", "0", "0"]


def rotated(values):
    q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    t = q @ np.diag(values) @ q.T
    return [short(x) for x in (t[0, 0], t[1, 1], t[2, 2], t[0, 1], t[0, 2], t[1, 2])]


class Body:
    """Exact principal moments and e_i^2 of a row."""

    def __init__(self, theta, lam, axis):
        a, b, c, d, e, f = (mp.mpf(float(x)) for x in theta)
        v = mp.matrix([mp.mpf(float(x)) for x in axis])
        v /= mp.norm(v)
        if d == e == f == 0:
            self.moments, parts = [a, b, c], [v[0], v[1], v[2]]
        else:
            values, axes = mp.eigsy(mp.matrix([[a, d, e], [d, b, f], [e, f, c]]))
            parts = axes.T * v
            self.moments, parts = [values[i] for i in range(3)], [parts[i] for i in range(3)]
        self.axis, self.h = parts, mp.mpf(float(lam))

    def folds(self):
        """Values of h/l at which two steady rotations merge, from the least of phi between two poles."""
        poles = sorted(1 / self.moments[i] for i in range(3) if self.axis[i] != 0)
        found = []
        for low, high in zip(poles[:-1], poles[1:]):
            def slope(sigma):
                return sum(
                    (x / (1 - sigma * t)) ** 2 * t / (1 - sigma * t) for x, t in zip(self.axis, self.moments) if x
                )
            a, b = low, high
            for _ in range(160):
                middle = (a + b) / 2
                a, b = (a, middle) if slope(middle) > 0 else (middle, b)
            size = sum((x / (1 - a * t)) ** 2 for x, t in zip(self.axis, self.moments) if x)
            found.append(1 / mp.sqrt(size))
        return found

    def forks(self):
        """Values of h/l at which the pair of a missing component appears."""
        found = []
        for i in range(3):
            if self.axis[i] == 0:
                rest = sum((self.axis[j] / (1 - self.moments[j] / self.moments[i])) ** 2 for j in range(3) if j != i)
                if rest > 0:
                    found.append(1 / mp.sqrt(rest))
        return found

    def steady(self, l):
        """[(sigma, type)] by ascending sigma."""
        eta = self.h / mp.mpf(float(l))
        active = [i for i in range(3) if self.axis[i] != 0]
        total = [mp.mpf(0)] * (2 * len(active) + 1)

        def product(indices):
            p = [mp.mpf(1)]
            for i in indices:
                for _ in range(2):
                    p = [
                        (p[k] if k < len(p) else 0) - (self.moments[i] * p[k - 1] if k > 0 else 0)
                        for k in range(len(p) + 1)
                    ]
            return p

        for k, x in enumerate(product(active)):
            total[k] -= x
        for i in active:
            for k, x in enumerate(product([j for j in active if j != i])):
                total[k] += (eta * self.axis[i]) ** 2 * x
        scale = max(self.moments)  # in units of 1/scale
        coefficients = [total[k] / scale**k for k in range(len(total))][::-1]
        roots = mp.polyroots(coefficients, maxsteps=2000, extraprec=400)
        points = []
        for root in roots:
            if abs(mp.im(root)) < mp.mpf(10) ** -28 * abs(root):
                sigma = mp.re(root) / scale
                m = [eta * x / (1 - sigma * t) if x else mp.mpf(0) for x, t in zip(self.axis, self.moments)]
                points.append((sigma, m))
        for i in range(3):
            if self.axis[i] == 0:
                sigma = 1 / self.moments[i]
                m = [
                    eta * self.axis[j] / (1 - sigma * self.moments[j]) if self.axis[j] else mp.mpf(0) for j in range(3)
                ]
                rest = 1 - sum(x * x for x in m)
                if rest > 0:
                    for sign in (1, -1):
                        n = list(m)
                        n[i] = sign * mp.sqrt(rest)
                        points.append((sigma, n))
        listed = []
        for sigma, m in points:
            assert abs(sum(x * x for x in m) - 1) < mp.mpf(10) ** -20
            b = [1 / t - sigma for t in self.moments]
            determinant = m[0] ** 2 * b[1] * b[2] + m[1] ** 2 * b[0] * b[2] + m[2] ** 2 * b[0] * b[1]
            trace = sum(b) - sum(x * x * y for x, y in zip(m, b))
            listed.append((sigma, "s" if determinant < 0 else "m" if trace > 0 else "M"))
        listed.sort()
        assert len(listed) in (2, 4, 6)
        assert sum({"m": 1, "s": -1, "M": 1}[kind] for _, kind in listed) == 2
        return listed


def ratio():
    return np.exp(random.uniform(np.log(0.03), np.log(2.5)))


def row(kind):
    lam_of = rotor
    if kind == "generic":
        theta, e = rotated(moments()), unit()
    elif kind == "tiny":  # one or two components of e down to 1e-14
        theta, e = diagonal(moments()), unit()
        e /= np.linalg.norm(e)
        for i in random.permutation(3)[: random.integers(1, 3)]:
            e[i] = random.choice([-1, 1]) * 10 ** random.uniform(-14, -2)
    elif kind == "near-equal":  # moments equal within 1e-10 to 1e-2
        values = moments()
        gap = 10 ** random.uniform(-10, -2)
        values[1] = values[0] * (1 + gap)
        values[2] = values[0] * random.uniform(0.4, 1.9)
        theta, e = diagonal(values, 15), unit()
        if random.random() < 0.6:  # roots between the two
            e = np.array([1.0, 1.0, 1.0])
            for i in range(3):
                if min(abs(float(theta[i]) - values[0]), abs(float(theta[i]) - values[1])) <= values[0] * gap:
                    e[i] = random.normal() * gap
    elif kind in ("zero", "fork"):
        theta, e = diagonal(moments()), unit()
        e[random.integers(3)] = 0
        if random.random() < 0.3:
            e[random.integers(3)] = 0
            if not e.any():
                e[0] = 1
    else:  # fold
        theta, e = (rotated(moments()) if random.random() < 0.7 else diagonal(moments())), unit()
    e = e / np.linalg.norm(e)
    axis = [short(x, 10) if x else "0" for x in e]
    lam = short(lam_of(tensor(theta), e), 4)
    body = Body(theta, lam, axis)
    l = float(short(float(lam) / ratio(), 6))
    if kind in ("fold", "fork"):
        found = body.folds() if kind == "fold" else body.forks()
        if not found:
            return row(kind)
        at = found[random.integers(len(found))]
        distance = mp.mpf(10) ** random.uniform(-11, -2) * random.choice([-1, 1])
        l = float(body.h / (at * (1 + distance)))
    listed = body.steady(l)
    numbers = [kind, *theta, lam, *axis, repr(float(l))]
    return ",".join(numbers + [f"{t},{mp.nstr(s, 17)}" for s, t in listed])


def main():
    counts = {"generic": 1150, "tiny": 250, "near-equal": 200, "fold": 250, "zero": 100, "fork": 50}
    path = pathlib.Path(__file__).with_name("rotor_sextic.csv")
    with path.open("w", encoding="ascii") as out:
        out.write("# Steady rotations by the sextic in 120 digits. Columns and method: rotor_sextic.py\n")
        for kind, count in counts.items():
            for _ in range(count):
                out.write(row(kind) + "\n")


if __name__ == "__main__":
    main()
