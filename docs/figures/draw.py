#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the family pages: the body with its axes, angles and torques, and what its motion looks like.

    draw.py [FOLDER] [--format svg|png|pdf]      writes them beside this file, or into FOLDER

What moves in them is integrated here, from the full equations of the pages, by a plain Runge-Kutta method that shares nothing with the
library. Needs numpy and matplotlib.
"""
import argparse
import pathlib

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patches import FancyArrowPatch, Polygon  # noqa: E402

BLUE, RED, GREEN, PINK, AMBER, SKY, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#777777"
STYLE = {"font.family": "DejaVu Sans", "font.size": 10, "mathtext.fontset": "dejavusans", "svg.fonttype": "path", "svg.hashsalt": "gyrostat",
         "axes.titlesize": 10.5, "axes.titlelocation": "left", "figure.facecolor": "white", "savefig.facecolor": "white"}


# ---- drawing in space ----

class View:
    """An orthographic view of space on a plane: `azimuth` and `elevation` of the eye, degrees; axis 3 of space is up."""

    def __init__(self, axes, azimuth, elevation):
        a, e = np.radians([azimuth, elevation])
        self.axes = axes
        self.eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        self.right = np.array([-np.sin(a), np.cos(a), 0.0])
        self.up = np.cross(self.eye, self.right)
        axes.set_aspect("equal")
        axes.axis("off")

    def flat(self, points):
        points = np.asarray(points, float)
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        return np.asarray(points, float) @ self.eye

    def line(self, points, **how):
        xy = self.flat(points)
        self.axes.plot(xy[:, 0], xy[:, 1], **{"color": "black", "linewidth": 1.0, "solid_capstyle": "round", **how})

    def on_sphere(self, points, **how):
        """A curve on a sphere about the origin: dashed and faint where it lies behind."""
        points = np.asarray(points, float)
        front = self.depth(points) >= 0
        cuts = np.flatnonzero(np.diff(front.astype(int))) + 1
        for part in np.split(np.arange(len(points)), cuts):
            stop = min(part[-1] + 2, len(points))
            seen = front[part[0]]
            hidden = {} if seen else {"alpha": 0.35, "linestyle": (0, (3, 2)), "linewidth": 0.8, "zorder": 1}
            self.line(points[part[0]:stop], **{**how, **hidden})

    def arrow(self, start, end, label="", at=1.0, shift=(0.0, 0.0), color="black", width=1.6, head=11, style="-|>", size=11, **how):
        a, b = self.flat(start), self.flat(end)
        self.axes.add_patch(FancyArrowPatch(a, b, arrowstyle=style, mutation_scale=head, color=color, linewidth=width, shrinkA=0, shrinkB=0,
                                            zorder=how.pop("zorder", 4), **how))
        if label:
            self.text(np.asarray(start) + at * (np.asarray(end) - np.asarray(start)), label, shift=shift, color=color, size=size)

    def text(self, point, label, shift=(0.0, 0.0), color="black", size=10.5, **how):
        xy = self.flat(point) + np.asarray(shift)
        self.axes.text(xy[0], xy[1], label, **{"color": color, "fontsize": size, "ha": "center", "va": "center", "zorder": 8, **how})

    def arc(self, centre, first, second, radius, label="", at=0.5, out=1.25, color="black", arrow=True, turn=None, width=1.2, size=11, shift=(0, 0)):
        """The angle from one direction to another; `turn`: by that angle about the axis `second` instead, rad."""
        first = np.asarray(first, float) / np.linalg.norm(first)
        second = np.asarray(second, float) / np.linalg.norm(second)
        if turn is None:
            angle = np.arccos(np.clip(first @ second, -1, 1))
            across = second - (first @ second) * first
            across /= np.linalg.norm(across)
        else:
            angle, across = turn, np.cross(second, first)
        s = np.linspace(0, angle, 60)[:, None]
        points = np.asarray(centre) + radius * (np.cos(s) * first + np.sin(s) * across)
        self.line(points if not arrow else points[:-3], color=color, linewidth=width, zorder=5)
        if arrow:
            self.arrow(points[-5], points[-1], color=color, width=width, head=9, zorder=5)
        if label:
            s = at * angle
            self.text(np.asarray(centre) + out * radius * (np.cos(s) * first + np.sin(s) * across), label, color=color, size=size, shift=shift)

    def disc(self, centre, axis, radius, face="#E8E8E8", edge="black", width=1.0, zorder=3, alpha=1.0):
        u, v = across(axis)
        s = np.linspace(0, 2 * np.pi, 90)[:, None]
        rim = np.asarray(centre) + radius * (np.cos(s) * u + np.sin(s) * v)
        self.axes.add_patch(Polygon(self.flat(rim), closed=True, facecolor=face, edgecolor=edge, linewidth=width, zorder=zorder, alpha=alpha))

    def wheel(self, centre, axis, radius, thickness, face="#BFE3D6", edge=GREEN):
        """A short cylinder."""
        axis = np.asarray(axis, float) / np.linalg.norm(axis)
        near = axis if self.depth(axis) > 0 else -axis
        u, v = across(axis)
        s = np.linspace(0, 2 * np.pi, 180)[:, None]
        rim = radius * (np.cos(s) * u + np.sin(s) * v)
        back, front = np.asarray(centre) - thickness / 2 * near, np.asarray(centre) + thickness / 2 * near
        both = self.flat(np.concatenate([rim + back, rim + front]))
        self.axes.add_patch(Polygon(hull(both), closed=True, facecolor=face, edgecolor=edge, linewidth=1.1, zorder=3))
        self.axes.add_patch(Polygon(self.flat(rim + front), closed=True, facecolor=face, edgecolor=edge, linewidth=1.1, zorder=3))

    def box(self, half, R=np.eye(3), face="#F2F2F2", alpha=0.55):
        """A box of half edges along the columns of R: its near faces filled, its far edges dashed."""
        for k in range(3):
            for side in (-1, 1):
                normal = side * R[:, k]
                i, j = (k + 1) % 3, (k + 2) % 3
                corners = [side * half[k] * R[:, k] + a * half[i] * R[:, i] + b * half[j] * R[:, j]
                           for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))]
                if self.depth(normal) > 0:
                    self.axes.add_patch(Polygon(self.flat(corners), closed=True, facecolor=face, edgecolor="none", alpha=alpha, zorder=2))
                    self.line(corners, color="#555555", linewidth=1.0, zorder=2.5)
                else:
                    self.line(corners, color="#999999", linewidth=0.7, linestyle=(0, (3, 3)), zorder=1)


def across(axis):
    """Two unit vectors across an axis, right-handed with it."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    u = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    u /= np.linalg.norm(u)
    return u, np.cross(axis, u)


def hull(points):
    """Convex hull of points in the plane, in order."""
    points = sorted(map(tuple, points))

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1])
                                      - (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-2][0])) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(points) + half(points[::-1]))


def turned(axis, angle):
    """The rotation by an angle about a coordinate axis (1, 2 or 3)."""
    i, j = axis % 3, (axis + 1) % 3
    R = np.eye(3)
    R[i, i] = R[j, j] = np.cos(angle)
    R[j, i], R[i, j] = np.sin(angle), -np.sin(angle)
    return R


def integrated(rate, start, times):
    """The solution of y' = rate(t, y) at the times, by the classical Runge-Kutta method."""
    y = np.array(start)
    out = [y]
    for t, h in zip(times[:-1], np.diff(times), strict=True):
        k1 = rate(t, y)
        k2 = rate(t + h / 2, y + h / 2 * k1)
        k3 = rate(t + h / 2, y + h / 2 * k2)
        k4 = rate(t + h, y + h * k3)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        out.append(y)
    return np.array(out)


def sphere(view, axes, radius=1.0):
    s = np.linspace(0, 2 * np.pi, 200)
    axes.fill(radius * np.cos(s), radius * np.sin(s), facecolor="#FAFAFA", edgecolor="#888888", linewidth=1.0, zorder=0)


# ---- deceleration ----

def deceleration():
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.7), layout="constrained")
    J = np.array([1.4, 1.0, 0.7])

    view = View(left, 30, 18)
    view.box([0.20, 0.44, 0.62])
    for k, (label, size, shift) in enumerate([("1: largest moment, $A$", 1.35, (0.05, -0.11)), ("2: middle, $B$", 1.15, (0.12, -0.11)), ("3: smallest, $C$", 1.3, (0.0, 0.1))]):
        view.arrow(np.zeros(3), size * np.eye(3)[k], label, shift=shift, color="#444444", width=1.0, size=10)
    axis = np.array([-0.55, -0.10, 0.83])
    view.wheel([0.0, -0.12, -0.32], axis, 0.20, 0.09)
    share, l = np.array([0.05, 1.05, 0.62]), 0.50 * axis / np.linalg.norm(axis)
    M = share + l
    view.arrow(np.array([0.0, -0.12, -0.32]), np.array([0.0, -0.12, -0.32]) + l, r"$l$", shift=(-0.08, 0.02), color=GREEN)
    view.arrow(np.zeros(3), share, r"$J\omega$", at=0.72, shift=(0.10, -0.09), color=BLUE)
    view.arrow(share, M, r"$l$", at=0.5, shift=(0.09, 0.03), color=GREEN)
    view.arrow(np.zeros(3), M, r"$M$", at=0.62, shift=(0.10, -0.03), color=RED, width=2.0)
    view.arrow(np.zeros(3), 0.85 * share / np.array([2.0, 1.0, 0.45]), r"$\omega$", shift=(-0.09, 0.06), color=SKY)
    control = -np.array([0.25, 0.4, 1.0]) * M / np.linalg.norm(M)
    view.arrow(M, M + 0.72 * control, r"control $-b_j\,M_j/|M|$", at=0.9, shift=(0.52, -0.05), color=PINK)
    view.arrow(M, M - 0.26 * M, color=AMBER, width=2.0, zorder=6)
    view.text(M, r"drag $-\lambda M$", shift=(0.38, 0.06), color="#A86F00", size=11)
    left.set_xlim(-1.35, 1.75)
    left.set_ylim(-1.25, 1.6)
    left.set_title("Axes of the body, $M=J\\omega+l$, and the torques on it (law total)")

    view = View(right, 38, 22)
    sphere(view, right)
    a = 1 / J
    for near, colour, tilts in ((0, SKY, (0.12, 0.4, 0.75)), (2, AMBER, (0.12, 0.4, 0.75))):
        far = 2 - near
        for tilt in tilts:  # from the near axis to the separatrix, in energy
            energy = a[near] + tilt * (a[1] - a[near])
            # n with sum n^2 = 1 and sum a n^2 = energy: an ellipse in (n_mid, n_far)
            mid, out = np.sqrt((energy - a[near]) / (a[1] - a[near])), np.sqrt((energy - a[near]) / (a[far] - a[near]))
            s = np.linspace(0, 2 * np.pi, 400)
            n = np.zeros((400, 3))
            n[:, 1], n[:, far] = mid * np.cos(s), out * np.sin(s)
            n[:, near] = np.sqrt(1 - n[:, 1] ** 2 - n[:, far] ** 2)
            for sign in (1, -1):
                view.on_sphere(n * np.where(np.arange(3) == near, sign, 1), color=colour, linewidth=1.5)
    s = np.linspace(0, 2 * np.pi, 600)
    ratio = np.sqrt((a[1] - a[0]) / (a[2] - a[1]))  # n3/n1 on the separatrix
    for sign in (1, -1):
        ring = np.stack([np.cos(s) / np.hypot(1, ratio), np.sin(s), sign * ratio * np.cos(s) / np.hypot(1, ratio)], axis=1)
        view.on_sphere(ring, color=RED, linewidth=1.8)
    for k, shift in ((0, (-0.05, -0.13)), (1, (0.12, 0.0)), (2, (0.0, 0.1))):
        view.arrow(np.eye(3)[k], 1.36 * np.eye(3)[k], str(k + 1), shift=shift, color="#444444", width=1.0)
        view.line(np.array([np.zeros(3), np.eye(3)[k]]), color="#999999", linewidth=0.7, linestyle=(0, (3, 3)))
    # M on a polhode of regime A, and which way it goes
    t = np.linspace(0, 1.3, 60)
    energy = a[0] + 0.4 * (a[1] - a[0])
    start = np.array([0.0, 0.0, np.sqrt((energy - a[0]) / (a[2] - a[0]))])
    start[0] = np.sqrt(1 - start[2] ** 2)
    path = integrated(lambda _, n: np.cross(n, a * n), start, t)
    view.line(path[:-2], color=BLUE, linewidth=2.6, zorder=5)
    view.arrow(path[-4], path[-1], color=BLUE, width=2.2, head=13, zorder=6)
    view.arrow(np.zeros(3), path[0], r"$M$", at=0.62, shift=(-0.09, 0.05), color=RED)
    view.text(np.array([0, 0, 0]), "regime A\n$k^2$: 0 on axis 1", shift=(-0.98, -0.93), color=BLUE, size=9.5)
    view.text(np.array([0, 0, 0]), "regime C\n$k^2$: 0 on axis 3", shift=(-0.98, 0.93), color="#A86F00", size=9.5)
    view.text(np.array([0, 0, 0]), "separatrix\n$k^2=1$", shift=(1.05, 0.88), color=RED, size=9.5)
    right.set_xlim(-1.45, 1.5)
    right.set_ylim(-1.32, 1.5)
    right.set_title("Free motion: $M$ runs along a polhode ($l=0$)")
    return figure


# ---- rotor ----

THETA, AXIS = np.array([3.0, 4.1, 5.2]), np.array([0.75, 0.35, 0.5612486])
AXIS = AXIS / np.linalg.norm(AXIS)


def rotor():
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12.6, 4.5), layout="constrained", width_ratios=[1.0, 1.0, 1.05])
    view = View(left, 30, 20)
    view.box([0.70, 0.62, 0.42])
    e = np.array([-0.38, 0.42, 0.82])
    e /= np.linalg.norm(e)
    centre = 0.42 * e + np.array([0, 0, 0.05])
    view.wheel(centre, e, 0.32, 0.12)
    view.arrow(centre - 0.30 * e, centre + 0.85 * e, r"$e$", shift=(0.03, 0.10), color=GREEN)
    view.arc(centre + 0.18 * e, across(e)[0], e, 0.38, "", color=GREEN, turn=4.2, width=1.5)
    view.text(centre + 0.18 * e, r"$\omega$", shift=(-0.42, 0.16), color=GREEN, size=12)
    view.arc(centre + 0.55 * e, across(e)[1], e, 0.20, "", color=PINK, turn=-4.4, width=1.5)
    view.text(centre + 0.55 * e, r"motor $-S(\omega-\omega^*)$", shift=(0.74, 0.08), color=PINK, size=10)
    view.arrow(np.zeros(3), np.array([0.05, 1.25, 0.72]), r"$H=\theta\Omega+\lambda\omega e$", shift=(0.06, 0.11), color=RED, width=2.0)
    view.arrow(np.zeros(3), np.array([0.15, 1.30, 0.22]), r"$\Omega$", shift=(0.1, 0.0), color=BLUE)
    for k, (size, shift) in enumerate([(1.3, (-0.04, -0.1)), (1.05, (0.09, -0.07)), (1.3, (-0.1, 0.02))]):
        view.arrow(np.zeros(3), size * np.eye(3)[k], str(k + 1), shift=shift, color="#444444", width=1.0, size=10)
    view.text(np.zeros(3), "carrier", shift=(-0.44, -0.42), color="#555555", size=9.5)
    left.set_xlim(-1.1, 1.65)
    left.set_ylim(-0.95, 1.6)
    left.set_title("Carrier, rotor and momentum")

    J, l, h, lam = 1 / THETA, 8.0, 1.05, 0.8

    def level(m):
        d = l * m - h * AXIS
        return (d * J * d).sum(axis=-1) / 2

    # the secular equation: all steady rotations
    eta = h / l

    def secular(sigma):
        return ((eta * AXIS / (1 - np.multiply.outer(sigma, THETA))) ** 2).sum(axis=-1) - 1

    poles = np.sort(1 / THETA)
    roots = []
    for low, high in zip([poles[0] - 0.2, *poles], [*poles, poles[-1] + 0.2], strict=True):
        grid = np.linspace(low, high, 20001)[1:-1]
        f = secular(grid)
        for i in np.flatnonzero(np.sign(f[:-1]) != np.sign(f[1:])):
            a, b = grid[i], grid[i + 1]
            for _ in range(60):
                c = (a + b) / 2
                a, b = (c, b) if np.sign(secular(c)) == np.sign(secular(a)) else (a, c)
            roots.append((a + b) / 2)
    kinds = ["min", "min", "saddle", "saddle", "max", "max"]
    marks = {"min": (GREEN, "o"), "saddle": (AMBER, "s"), "max": (RED, "^")}
    points = [eta * AXIS / (1 - sigma * THETA) for sigma in roots]
    assert len(roots) == 6, roots

    view = View(middle, 42, -14)
    sphere(view, middle)
    # levels of F, drawn in the plane of view, front and back
    x, y = np.meshgrid(np.linspace(-1, 1, 500), np.linspace(-1, 1, 500))
    inside = x ** 2 + y ** 2 < 0.9999
    values = [level(p) for p in points]
    for side in (-1, 1):
        z = np.sqrt(np.where(inside, 1 - x ** 2 - y ** 2, 0))
        m = x[..., None] * view.right + y[..., None] * view.up + side * z[..., None] * view.eye
        F = np.where(inside, level(m), np.nan)
        levels = np.linspace(min(values), max(values), 16)[1:-1]
        middle.contour(x, y, F, levels=levels, colors="#9A9A9A" if side > 0 else "#DADADA", linewidths=0.9 if side > 0 else 0.6, zorder=1)
        if side > 0:
            middle.contour(x, y, F, levels=sorted(values[2:4]), colors=AMBER, linewidths=1.4, zorder=2)
    # a motion that begins near the lower maximum
    S, R_inverse = 0.4, np.linalg.inv(np.diag(THETA) - lam * np.outer(AXIS, AXIS))

    def rate(_, y):
        H, p = y[:3], y[3]
        Omega = R_inverse @ (H - p * AXIS)
        return np.append(np.cross(H, Omega), -S * (p / lam - AXIS @ Omega - h / lam))

    start = points[4] + 0.10 * across(points[4])[1]
    start = l * start / np.linalg.norm(start)
    path = integrated(rate, np.append(start, h + lam * AXIS @ (J * start)), np.linspace(0, 500, 20001))[:, :3] / l
    view.on_sphere(path, color=BLUE, linewidth=0.9, zorder=4)
    for k, shift in ((0, (-0.10, 0.06)), (1, (0.11, 0.06)), (2, (0.0, 0.1))):
        view.arrow(np.eye(3)[k], 1.3 * np.eye(3)[k], str(k + 1), shift=shift, color="#444444", width=1.0)
    for kind, m in zip(kinds, points, strict=True):
        colour, mark = marks[kind]
        seen = view.depth(m) > 0
        xy = view.flat(m)
        middle.plot(*xy, mark, markersize=8, color=colour if seen else "white", markeredgecolor="black" if seen else colour, zorder=7)
    middle.plot(*view.flat(path[0]), "x", color=BLUE, markersize=8, markeredgewidth=2, zorder=8)
    view.text(path[0], "start", shift=(0.17, -0.10), color=BLUE, size=9.5)
    middle.set_xlim(-1.3, 1.35)
    middle.set_ylim(-1.3, 1.4)
    middle.set_title("$m=H/|H|$ and the levels of $F$")

    grid = np.linspace(poles[0] - 0.06, poles[-1] + 0.06, 40001)
    f = secular(grid)
    f[np.abs(f) > 30] = np.nan
    right.plot(grid, f, color="black", linewidth=1.2)
    right.axhline(0, color="#888888", linewidth=0.8)
    for pole, name in zip(poles, ("1/\\theta_3", "1/\\theta_2", "1/\\theta_1"), strict=True):
        right.axvline(pole, color="#888888", linewidth=0.8, linestyle=(0, (4, 3)))
        right.text(pole, 5.15, f"${name}$", ha="center", va="bottom", fontsize=10.5)
    seen = set()
    for kind, sigma in zip(kinds, roots, strict=True):
        colour, mark = marks[kind]
        names = {"min": "minimum: attracts", "saddle": "saddle", "max": "maximum"}
        right.plot(sigma, 0, mark, markersize=8, color=colour, markeredgecolor="black", zorder=5, label=None if kind in seen else names[kind])
        seen.add(kind)
    right.set_ylim(-2.2, 5)
    right.set_xlim(grid[0], grid[-1])
    right.set_xlabel(r"$\sigma=\dot\psi/l$ [1/(kg m$^2$)]")
    right.set_ylabel(r"$\phi(\sigma)$ [1]")
    right.legend(loc="lower right", fontsize=9, framealpha=1)
    right.set_title("Secular equation: the six steady rotations", pad=20)
    return figure


# ---- spinning ----

def spinning():
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12.6, 4.5), layout="constrained")
    view = View(left, 55, 30)
    theta, psi, phi = np.radians([35.0, 43.0, 46.0])
    R1 = turned(3, theta)
    R2 = R1 @ turned(1, psi)
    R3 = R2 @ turned(2, phi)
    for k, (shift, size) in enumerate((((-0.10, -0.06), 1.35), ((0.13, -0.02), 1.2), ((-0.10, 0.05), 1.25))):
        view.arrow(np.zeros(3), size * np.eye(3)[k], f"$X_{k + 1}$", shift=shift, color="#444444", width=1.1)
    s = np.linspace(0, 2 * np.pi, 200)[:, None]
    view.line(np.cos(s) * np.eye(3)[0] + np.sin(s) * np.eye(3)[1], color="#BBBBBB", linewidth=0.8)
    view.line(np.array([np.zeros(3), 1.15 * R1[:, 0]]), color=GREEN, linewidth=1.1, linestyle=(0, (4, 2)))
    view.line(np.array([np.zeros(3), 1.12 * R2[:, 2]]), color=AMBER, linewidth=1.1, linestyle=(0, (4, 2)))
    for k, (label, shift, size) in enumerate([("1", (-0.02, -0.1), 1.15), ("2", (0.12, 0.04), 1.2), ("3: spin axis", (0.02, -0.13), 1.3)]):
        view.arrow(np.zeros(3), size * R3[:, k], label, shift=shift, color=BLUE, width=1.8)
    view.arc(np.zeros(3), np.eye(3)[0], R1[:, 0], 0.62, r"$\theta$", at=0.4, out=1.2, color=GREEN)
    view.arc(np.zeros(3), np.eye(3)[2], R2[:, 2], 0.72, r"$\psi$", at=0.5, out=1.15, color=AMBER)
    view.arc(np.zeros(3), R2[:, 2], R3[:, 2], 0.72, r"$\varphi$", at=0.45, out=1.17, color=RED)
    view.text(1.15 * R1[:, 0], "after $\\theta$: 1'", shift=(0.12, -0.1), color=GREEN, size=9)
    view.text(1.12 * R2[:, 2], "after $\\psi$: 3''", shift=(-0.30, 0.06), color="#A86F00", size=9)
    left.set_xlim(-1.25, 1.5)
    left.set_ylim(-1.05, 1.6)
    left.set_title(r"Angles 3-1-2: $R=R_z(\theta)\,R_x(\psi)\,R_y(\varphi)$")

    view = View(middle, 28, 14)
    top, foot, radius = 0.62, -0.45, 0.44
    s = np.linspace(0, 2 * np.pi, 120)[:, None]
    rim = radius * (np.cos(s) * np.eye(3)[0] + np.sin(s) * np.eye(3)[1])
    body = view.flat(np.concatenate([rim + [0, 0, foot], rim + [0, 0, top]]))
    middle.add_patch(Polygon(hull(body), closed=True, facecolor="#F2F2F2", edgecolor="#555555", linewidth=1.0, zorder=2))
    middle.add_patch(Polygon(view.flat(rim + [0, 0, top]), closed=True, facecolor="#FAFAFA", edgecolor="#555555", linewidth=1.0, zorder=2))
    nozzle = np.concatenate([0.10 * rim / radius + [0, 0, foot], 0.22 * rim / radius + [0, 0, foot - 0.28]])
    middle.add_patch(Polygon(hull(view.flat(nozzle)), closed=True, facecolor="#DDDDDD", edgecolor="#555555", linewidth=1.0, zorder=1))
    view.wheel([0, 0, -0.20], [0, 0, 1], 0.27, 0.09)
    view.arrow([0, 0, 0], [0, 0, 1.72], "3", shift=(0.09, 0.02), color="#444444", width=1.0, zorder=3.5)
    view.arrow([0, 0, 0], [1.5, 0, 0], "1", shift=(-0.06, -0.05), color="#444444", width=1.0, zorder=3.5)
    view.arrow([0, 0, 0], [0, 1.0, 0], "2", shift=(0.09, -0.02), color="#444444", width=1.0, zorder=3.5)
    view.text([0, 0, -0.20], r"rotor $\lambda_3$", shift=(0.70, -0.04), color=GREEN)
    view.arc([0, 0, 0.80], [1, -1, 0], [0, 0, 1], 0.20, "", color=BLUE, turn=5.0, width=1.6)
    view.text([0, 0, 0.80], r"spin $r$", shift=(0.42, 0.02), color=BLUE)
    view.arrow([0, 0, foot - 0.88], [0, 0, foot - 0.32], r"force $f$", at=0.25, shift=(0.30, 0.0), color=RED, zorder=3.5)
    view.arrow([0, 0, 0], [1.05, 0.12, 0], "", color=PINK, width=2.2)
    view.text([1.05, 0.12, 0], r"torque $M$", shift=(-0.28, 0.13), color=PINK)
    view.disc([0, 0, 1.16], view.eye, 0.05, face="black", zorder=6)
    view.text([0, 0, 1.16], r"charge $e$", shift=(0.40, 0.0), size=10)
    view.arrow([0, -0.62, 0], [0, -0.62, 1.16], r"arm $l$", at=0.75, shift=(-0.20, 0), color="#555555", width=0.9, head=8, style="<|-|>", size=10)
    view.line(np.array([[0, -0.66, 1.16], [0, 0, 1.16]]), color="#999999", linewidth=0.7, linestyle=(0, (3, 3)))
    field = np.array([0.0, -0.55, 0.84])
    view.arrow([0, 0, 1.16], np.array([0, 0, 1.16]) + 0.70 * field, r"field", shift=(-0.05, 0.09), color=AMBER)
    view.arc([0, 0, 1.16], [0, 0, 1], field, 0.42, r"$\sigma$", at=0.55, out=1.24, color=AMBER, arrow=False)
    middle.set_xlim(-1.1, 1.3)
    middle.set_ylim(-1.3, 1.85)
    middle.set_title("Body, rotor and loads")

    # the linear motion of a stage, by the full equations
    D, m, lam, M, r0, f3 = np.array([300.0, 280.0, 400.0]), 1500.0, 50.0, 2.5, 1.2, 400.0

    def rate(_, y):
        p, q, r = y[:3]
        R = y[3:12].reshape(3, 3)
        w = np.array([p, q, r])
        dw = (np.array([M, 0, 0]) - np.cross(w, D * w + [0, 0, lam])) / D
        cross = np.array([[0, -r, q], [r, 0, -p], [-q, p, 0]])
        return np.concatenate([dw, (R @ cross).ravel(), R[:, 2] * f3 / m])

    times = np.linspace(0, 50.0, 5001)
    y = integrated(rate, np.concatenate([[0, 0, r0], np.eye(3).ravel(), np.zeros(3)]), times)
    axis = y[:, 3:12].reshape(-1, 3, 3)[:, :, 2]
    X = D[2] * r0 + lam
    right.plot(1e3 * axis[:, 0], 1e3 * axis[:, 1], color=BLUE, linewidth=0.9, label="axis 3")
    right.plot(1e3 * y[50:, 12] / y[50:, 14], 1e3 * y[50:, 13] / y[50:, 14], color=RED, linewidth=1.1, label="direction of the velocity")
    # <e^{i theta} Gamma> = -M/(r0 X), and axis 3 lies at -i times that: along (phi, -psi)
    lean = np.array([0.0, M / (r0 * X)])
    right.plot(*(1e3 * lean), "o", color=GREEN, markersize=8, markeredgecolor="black", zorder=5, label=r"mean, $|M|/|r_0X|$ from $X_3$")
    right.plot(0, 0, "x", color="black", markersize=8, markeredgewidth=2, zorder=6, label="start: $X_3$")
    right.set_aspect("equal")
    right.set_xlabel("along $X_1$ [mrad]")
    right.set_ylabel("along $X_2$ [mrad]")
    right.grid(linewidth=0.4, color="#DDDDDD")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, fontsize=9, frameon=False)
    right.set_title("Seen along $X_3$: lean under a torque")
    return figure


# ---- heavy ----

def heavy():
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12.6, 4.6), layout="constrained")
    view = View(left, 28, 20)
    down = np.array([0.0, 0.0, -1.0])
    psi, theta, phi = np.radians([-32.0, 140.0, 52.0])  # theta from DOWN
    # body axes: down = (sin theta sin phi, sin theta cos phi, cos theta) in them
    flip = np.diag([1.0, -1.0, -1.0])  # the frame whose axis 3 is down
    R = flip @ turned(3, psi) @ turned(1, theta) @ turned(3, phi)
    assert np.allclose(R.T @ down, [np.sin(theta) * np.sin(phi), np.sin(theta) * np.cos(phi), np.cos(theta)])
    axis, node = R[:, 2], flip @ turned(3, psi) @ np.array([1.0, 0, 0])
    u, v = across(axis)
    s = np.linspace(0, 2 * np.pi, 120)[:, None]
    rim = 0.85 * axis + 0.44 * (np.cos(s) * u + np.sin(s) * v)
    left.add_patch(Polygon(hull(view.flat(np.concatenate([np.zeros((1, 3)), rim]))), closed=True, facecolor="#F2F2F2", edgecolor="#777777", linewidth=1.0, zorder=1))
    view.line(rim, color="#777777", linewidth=0.9, zorder=1.5)
    view.arrow(np.zeros(3), 1.5 * axis, "3", shift=(0.07, 0.07), color=BLUE, width=1.8)
    view.arrow(np.zeros(3), 1.15 * R[:, 0], "1", shift=(0.05, -0.08), color=BLUE, width=1.8)
    view.arrow(np.zeros(3), 1.05 * R[:, 1], "2", shift=(0.10, 0.02), color=BLUE, width=1.8)
    view.arrow(np.zeros(3), 1.25 * down, r"$d$, down", shift=(0.29, 0.02), color=RED, width=1.8)
    view.arrow(np.zeros(3), -1.45 * down, "up: $X_3$", shift=(-0.30, -0.04), color="#444444", width=1.0)
    view.line(np.array([np.zeros(3), 1.30 * node]), color=GREEN, linewidth=1.1, linestyle=(0, (4, 2)))
    view.text(1.30 * node, "node", shift=(0.05, -0.09), color=GREEN, size=9.5)
    still = np.array([1.0, 0, 0])
    view.line(np.array([np.zeros(3), 1.30 * still]), color="#888888", linewidth=0.9, linestyle=(0, (4, 2)))
    view.text(1.30 * still, "$X_1$", shift=(-0.10, -0.03), color="#777777", size=10)
    view.arc(np.zeros(3), still, node, 1.02, r"$\psi$", at=0.5, out=1.17, color=GREEN)
    view.arc(np.zeros(3), down, axis, 0.50, r"$\theta$", at=0.3, out=1.2, color=AMBER)
    view.arc(np.zeros(3), node, R[:, 0], 0.80, r"$\varphi$", at=0.5, out=1.15, color=PINK)
    centre = R @ np.array([0.05, 0.20, 0.74])
    view.arrow(np.zeros(3), centre, "", color="black", width=1.3)
    view.text(centre, r"$r_{cm}$", shift=(-0.20, 0.02))
    view.disc(centre, view.eye, 0.04, face="black", zorder=6)
    view.arrow(centre, centre + 0.55 * down, r"$Mg\,d$", at=0.9, shift=(0.20, 0.02), color=RED)
    view.disc(np.zeros(3), view.eye, 0.035, face="white", zorder=7)
    view.text(np.zeros(3), "$O$", shift=(-0.11, 0.06))
    left.set_xlim(-1.2, 1.45)
    left.set_ylim(-1.35, 1.6)
    left.set_title(r"Fixed point $O$; angles $\theta$ (from down), $\psi$, $\varphi$")

    # a fast spin: the forced ellipse of the rates, and another start
    A, B, C, cm, k, G0, eps = 0.55, 0.8, 1.0, np.array([0.6, 0.48, 0.64]), 0.7, 0.1, 0.1
    I, M3 = np.array([A, B, C]), np.sqrt(1 - G0 ** 2)
    a, b = A / C, B / C
    chi = -cm[2] * (2 * b - 1) / (a + b - 1) + k * G0 * (1 - b)
    kap = cm[2] * (2 * a - 1) / (a + b - 1) + k * G0 * (a - 1)
    X, Y = cm[0] * G0 / (1 - a), cm[1] * G0 / (1 - b)

    def rate(_, y):  # unit of time 1/c, so that M g l = C and N = k
        w, d = y[:3], y[3:]
        torque = np.cross(I * w, w) + C * np.cross(cm, d) + k * np.cross(d, I * d)
        return np.concatenate([torque / I, np.cross(d, w)])

    times = np.linspace(0, 12 * 2 * np.pi * eps, 6001)
    for start, colour, label, width in (((X + chi * M3, Y), BLUE, "start of the periodic motion", 1.8), ((0.0, 0.0), GREY, "start at $p=q=0$", 0.7)):
        y = integrated(rate, np.array([eps * start[0], eps * start[1], 1 / eps, M3, 0.0, G0]), times)
        middle.plot(y[:, 0] / eps, y[:, 1] / eps, color=colour, linewidth=width, label=label, zorder=3 if colour == BLUE else 2)
    u = np.linspace(0, 2 * np.pi, 200)
    middle.plot(X + chi * M3 * np.cos(u), Y + kap * M3 * np.sin(u), color=RED, linewidth=1.3, linestyle=(0, (4, 3)), zorder=4, label="formula, second order")
    middle.plot(X, Y, "+", color=RED, markersize=9, markeredgewidth=1.6, zorder=5)
    middle.annotate("$(X, Y)$", (X, Y), (1.35, 0.62), color=RED, fontsize=10.5, arrowprops={"arrowstyle": "-", "color": RED, "linewidth": 0.8})
    middle.set_aspect("equal")
    middle.set_ylim(-1.6, 2.0)
    middle.set_xlabel(r"$p/(c\,\epsilon)$ [1]")
    middle.set_ylabel(r"$q/(c\,\epsilon)$ [1]")
    middle.grid(linewidth=0.4, color="#DDDDDD")
    middle.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, fontsize=9, frameon=False)
    middle.set_title(r"Transverse rates of a fast spin, $r_0=10\,c$")

    # the tongue at nu = 1/2: b varies, all else held
    G0, k, a = 0.1, 0.0, 0.55
    M3 = np.sqrt(1 - G0 ** 2)

    def exponent(b, e):
        w2 = (a - 1) * (b - 1) / (a * b)
        w = np.sqrt(w2)
        W1 = (3 * (a + b) - 2 * (2 * a * b + 1)) / (a * b)
        W2, W3 = 2 * w2 * (1 - a - b), w2 * (a + b) / 2
        return w + e ** 2 / (2 * w) * (G0 * (cm[2] * W1 + k * G0 * W2) + k * W3 * M3 ** 2)

    def coupling(b):
        return M3 / 2 * np.hypot(cm[0] * (1.5 - 1 / b), cm[1] * (2 * (1 - a) - b) / (a * b))

    b = np.linspace(0.70, 0.86, 4001)
    omega = np.sqrt((a - 1) * (b - 1) / (a * b))  # falls as b grows
    e = np.linspace(0, 0.3, 200)
    edges = [[np.interp(0, (exponent(b, x) - 0.5 + sign * coupling(b) * x ** 2)[::-1], omega[::-1]) for x in e] for sign in (1, -1)]
    right.fill_betweenx(e, *edges, facecolor="#F6C9AE", edgecolor="none")
    for edge in edges:
        right.plot(edge, e, color=RED, linewidth=1.4)
    right.set_xlim(0.47, 0.53)
    right.set_ylim(0, 0.3)
    right.annotate("unstable", (0.4965, 0.22), (0.478, 0.25), color=RED, fontsize=10, arrowprops={"arrowstyle": "-", "color": RED, "linewidth": 0.8})
    right.text(0.483, 0.10, "stable", ha="center", color=BLUE, fontsize=10)
    right.text(0.517, 0.10, "stable", ha="center", color=BLUE, fontsize=10)
    right.axvline(0.5, color="#888888", linewidth=0.8, linestyle=(0, (4, 3)))
    right.set_xlabel(r"nutation over spin, $\omega$ [1]")
    right.set_ylabel(r"$\epsilon=c/r_0$ [1]")
    right.set_title(r"Tongue: $|\nu-1/2|<|k_r|\,\epsilon^2$")
    return figure


# ---- free ----

def free_body(axes):
    """A body with two wheels, its momentum, and the angles of its axis 3 about it."""
    view = View(axes, 20, 17)
    psi, theta, phi = np.radians([48.0, 42.0, -30.0])
    R = turned(3, psi) @ turned(1, theta) @ turned(3, phi)
    node, up = turned(3, psi) @ np.array([1.0, 0, 0]), np.array([0.0, 0, 1])
    view.box([0.34, 0.46, 0.62], R)
    for k, (size, shift) in enumerate([(1.25, (0.02, -0.1)), (1.2, (0.1, 0.0)), (1.5, (0.08, 0.05))]):
        view.arrow(np.zeros(3), size * R[:, k], str(k + 1), shift=shift, color=BLUE, width=1.5)
    for centre, axis, name, shift in (((0.0, -0.2, -0.36), (0.0, -1.0, 0.0), "$u_1$", (-0.06, 0.09)), ((0.05, 0.24, -0.1), (0.0, 0.8, -0.6), "$u_2$", (0.07, -0.07))):
        at, along = R @ np.array(centre), R @ np.array(axis)
        view.wheel(at, along, 0.17, 0.08)
        view.arrow(at, at + 0.5 * along, name, shift=shift, color=GREEN, width=1.5)
    view.arrow(np.zeros(3), 1.62 * up, r"$M=J\omega+l$", shift=(0.42, 0.0), color=RED, width=2.0)
    view.arrow(np.zeros(3), 1.3 * (0.55 * up + 0.5 * R[:, 2]), r"$\omega$", shift=(0.02, 0.1), color=SKY)
    still = np.array([1.0, 0, 0])
    view.line(np.array([np.zeros(3), 1.35 * still]), color="#888888", linewidth=0.9, linestyle=(0, (4, 2)))
    view.text(1.35 * still, "$X_1$", shift=(-0.1, -0.04), color="#777777", size=10)
    view.line(np.array([np.zeros(3), 1.3 * node]), color=AMBER, linewidth=1.1, linestyle=(0, (4, 2)))
    view.arc(np.zeros(3), still, node, 1.05, r"$\psi$", at=0.78, out=1.0, shift=(0.02, -0.13), color=AMBER)
    view.arc(np.zeros(3), up, R[:, 2], 0.95, r"$\vartheta$", at=0.8, out=1.12, color=PINK)
    axes.set_xlim(-1.6, 1.6)
    axes.set_ylim(-1.1, 1.85)
    axes.set_title("Body, wheels, and axis 3 about $M$")


def free():
    figure, ((body, left), (middle, right)) = plt.subplots(2, 2, figsize=(10.4, 9.2), layout="constrained", height_ratios=[1.0, 0.95])
    free_body(body)
    a, l = 1 / np.array([1.4, 1.0, 0.7]), np.array([0.05, 0.10, 0.09])  # of a gyrostat, |M| = 1

    # permanent rotations omega = sigma M: n = a l/(a - sigma) of unit length
    sigma = np.linspace(a[0] - 0.6, a[2] + 0.6, 400001)
    excess = ((a * l / (a - sigma[:, None])) ** 2).sum(axis=1) - 1
    found = []
    for i in np.flatnonzero((excess[:-1] < 0) != (excess[1:] < 0)):
        n = a * l / (a - sigma[i])
        d = a - sigma[i]
        found.append((n / np.linalg.norm(n), d[1] * d[2] * n[0] ** 2 + d[0] * d[2] * n[1] ** 2 + d[0] * d[1] * n[2] ** 2 > 0))

    view = View(left, 62, 24)
    sphere(view, left)
    x, y = np.meshgrid(np.linspace(-1, 1, 801), np.linspace(-1, 1, 801))
    near = x ** 2 + y ** 2 < 1
    n = x[..., None] * view.right + y[..., None] * view.up + np.sqrt(np.where(near, 1 - x ** 2 - y ** 2, 0))[..., None] * view.eye
    energy = np.where(near, ((n - l) ** 2 * a).sum(axis=-1) / 2, np.nan)
    saddles = sorted(((m - l) ** 2 * a).sum() / 2 for m, stable in found if not stable)
    low, high = np.nanmin(energy), np.nanmax(energy)
    for first, last, colour in ((low, saddles[0], SKY), (saddles[0], saddles[-1], GREEN), (saddles[-1], high, AMBER)):
        left.contour(x, y, energy, levels=first + (last - first) * np.array([0.15, 0.4, 0.7]), colors=colour, linewidths=1.2)
    left.contour(x, y, energy, levels=saddles, colors=RED, linewidths=1.8)
    for m, stable in found:
        if m @ view.eye > 0:
            left.plot(*view.flat(m), "o" if stable else "X", color="black" if stable else RED, markersize=6, zorder=6)
    for k, shift in ((0, (0.0, -0.1)), (1, (0.1, -0.02)), (2, (0.0, 0.1))):
        view.arrow(np.eye(3)[k], 1.3 * np.eye(3)[k], str(k + 1), shift=shift, color="#444444", width=1.0)
    view.text(np.zeros(3), "about-smallest", shift=(-0.86, 1.08), color="#A86F00", size=9.5)
    view.text(np.zeros(3), "about-largest", shift=(-1.02, -1.0), color=BLUE, size=9.5)
    view.text(np.zeros(3), "one component\nbetween the separatrices", shift=(0.95, -1.08), color=GREEN, size=9.5)
    left.set_xlim(-1.5, 1.5)
    left.set_ylim(-1.3, 1.4)
    left.set_title("Paths of $M$ in a body with wheels")

    # the rigid body in the plane of complex u
    tilt = 0.72 * (a[1] - a[0]) + a[0]  # 2 h/M^2
    k2 = (a[2] - a[1]) * (tilt - a[0]) / ((a[1] - a[0]) * (a[2] - tilt))

    def quarter(m2):
        x, y = 1.0, np.sqrt(1 - m2)
        for _ in range(40):
            x, y = (x + y) / 2, np.sqrt(x * y)
        return np.pi / (2 * x)

    K, Kp = quarter(k2), quarter(1 - k2)
    q, m = np.exp(-np.pi * Kp / K), np.arange(-12, 13)

    def dn(u):
        z = np.pi * u[..., None] / (2 * K)
        return (1 - k2) ** 0.25 * (q ** (m ** 2) * np.exp(2j * m * z)).sum(axis=-1) / ((-1.0) ** m * q ** (m ** 2) * np.exp(2j * m * z)).sum(axis=-1)

    angle = np.linspace(0, np.arcsin(np.sqrt((a[1] - a[0]) / (a[2] - a[0]))), 20001)
    integrand = 1 / np.sqrt(1 - (1 - k2) * np.sin(angle) ** 2)
    eta = ((integrand[1:] + integrand[:-1]) / 2).sum() * (angle[1] - angle[0])  # sn(eta, k')^2 = (a2 - a1)/(a3 - a1)
    re, im = np.meshgrid(np.linspace(-2 * K, 2 * K, 401), np.linspace(-2 * Kp, 2 * Kp, 401))
    size = np.log10(np.abs(dn(re + 1j * im)))
    middle.pcolormesh(re / K, im / Kp, np.clip(size, -1, 1.2), cmap="Blues", shading="auto", rasterized=True)
    grid = np.array([-1, 1])
    for x in (-2, 0, 2):
        middle.plot([x, x], grid, "x", color="black", markersize=9, markeredgewidth=2, zorder=4, label="poles of $n$" if x == 0 else None)
        theta4, theta1 = -2 + eta / Kp, eta / Kp  # delta = -1 about the axis of the largest moment
        middle.plot(x, theta4, "o", color=RED, markersize=8, zorder=4, label=r"zeros of $\zeta_1$" if x == 0 else None)
        middle.plot(x, theta1, "o", color=AMBER, markersize=8, zorder=4, label=r"zeros of $\zeta_2$" if x == 0 else None)
    middle.axhline(0, color=GREEN, linewidth=2.0, zorder=3, label="the motion")
    middle.set_xlim(-2.1, 2.1)
    middle.set_ylim(-2.1, 2.1)
    middle.set_xlabel("Re $u/K$")
    middle.set_ylabel("Im $u/K'$")
    middle.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=4, fontsize=9, frameon=False, handletextpad=0.4, columnspacing=1.0)
    middle.set_title(r"Complex time: $\log_{10}|n_1|$ over a cell of periods")

    t = np.linspace(0, 150, 15001)
    for off, colour in ((1e-2, GREEN), (1e-5, BLUE), (1e-8, PINK)):
        path = integrated(lambda _, n: np.cross(n, a * n), np.array([off, np.sqrt(1 - 2 * off ** 2), off]), t)
        right.plot(t, path[:, 1], color=colour, linewidth=1.4, label=f"$10^{{{round(np.log10(off))}}}$ off the axis")
    right.set_xlim(0, 150)
    right.set_xlabel("$t$ [s]")
    right.set_ylabel("$n_2$ [1]")
    right.grid(linewidth=0.4, color="#DDDDDD")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=9, frameon=False)
    right.set_title("Spun about the middle axis: flips")
    return figure


def boom(eccentricity, t):
    """The swing in the plane of the orbit of a long cylinder, degrees: that of the scene gravity-gradient-boom, started in the plane."""
    mu, radius, anomaly, ratio = 3.986004415e14, 6800774.658762454, np.radians(-142.73870880091428), 11750 / 12250
    p = radius * (1 + eccentricity * np.cos(anomaly))
    h = np.sqrt(mu * p)

    def rate(_, state):
        angle, speed, nu = state
        r = p / (1 + eccentricity * np.cos(nu))
        return np.array([speed, -1.5 * mu / r ** 3 * ratio * np.sin(2 * (angle - nu)), h / r ** 2])

    path = integrated(rate, np.array([anomaly + np.radians(5.0), h / radius ** 2, anomaly]), t)
    return np.degrees(path[:, 0] - path[:, 2])


def top(spin, wheel, t):
    """The path of the axis of a symmetric top in space that carries the momentum `wheel` along it: horizontal components of axis 3."""
    J, arm = np.array([0.02, 0.02, 0.012]), np.array([0.0, 0.0, 2.0 * 9.80665 * 0.05])
    l = np.array([0.0, 0.0, wheel])
    tilt = np.array([[1, 0, 0], [0, np.cos(0.5), -np.sin(0.5)], [0, np.sin(0.5), np.cos(0.5)]])

    def rate(_, state):
        R, M = state[:9].reshape(3, 3), state[9:]
        w = (M - l) / J
        cross = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        return np.concatenate([(R @ cross).ravel(), np.cross(M, w) + np.cross(arm, R.T @ [0, 0, -1.0])])

    path = integrated(rate, np.concatenate([tilt.ravel(), J * np.array([0.1, 0.2, spin]) + l]), t)
    return path[:, [2, 5]]


def general_body(axes):
    """A body on its orbit, with a wheel, a thruster and what turns it."""
    view = View(axes, 35, 20)
    R = turned(3, np.radians(18.0)) @ turned(1, np.radians(-16.0))
    view.box([0.42, 0.42, 0.3], R)
    for k, (size, shift) in enumerate([(1.15, (0.0, -0.1)), (1.15, (0.09, 0.03)), (1.0, (-0.09, 0.05))]):
        view.arrow(np.zeros(3), size * R[:, k], str(k + 1), shift=shift, color=BLUE, width=1.5)
    at, along = R @ np.array([-0.1, 0.12, 0.02]), R @ np.array([0.0, 0.707, 0.707])
    view.wheel(at, along, 0.2, 0.09)
    view.arrow(at, at + 0.62 * along, r"$u_k,\ \Omega_k$", shift=(0.17, 0.05), color=GREEN, width=1.5)
    nozzle, push = R @ np.array([0.42, -0.3, -0.2]), R @ np.array([-0.05, 0.05, 0.75])
    view.arrow(np.zeros(3), nozzle, "$r$", at=0.6, shift=(-0.02, 0.09), color="black", width=1.2)
    view.arrow(nozzle - 0.95 * push, nozzle, "thrust $f$", at=0.0, shift=(-0.02, -0.1), color=PINK, width=1.8)
    view.arrow(np.zeros(3), np.array([-0.55, 0.35, 0.9]), "$B$", shift=(-0.03, 0.1), color=SKY)
    planet = np.array([0.25, 1.0, -1.35])
    for vector, name, shift in ((-1.15 * np.array([0.25, 1.0, -1.35]) / np.linalg.norm(planet), "outward (radial)", (-0.3, 0.1)),
                                (1.25 * np.cross([0.97, -0.2426, 0.0], planet) / np.linalg.norm(planet), "along", (0.2, 0.06)),
                                (1.25 * np.array([0.97, -0.2426, 0.0]), "normal", (-0.05, -0.1))):
        view.line(np.array([np.zeros(3), vector]), color="#888888", linewidth=0.9, linestyle=(0, (4, 2)))
        view.text(vector, name, shift=shift, color="#777777", size=9.5)
    view.arrow(np.zeros(3), 0.62 * planet, "to the planet, $d$", at=1.0, shift=(0.28, -0.08), color=RED, width=1.8)
    view.disc(np.zeros(3), view.eye, 0.035, face="white", zorder=7)
    axes.set_xlim(-1.5, 1.6)
    axes.set_ylim(-1.4, 1.45)
    axes.set_title("Body, wheel and torques; axes of the orbit")


def general():
    figure, ((body, left), (middle, right)) = plt.subplots(2, 2, figsize=(10.4, 8.6), layout="constrained")
    general_body(body)
    t = np.linspace(0, 8 * 3600, 14401)
    for eccentricity, colour, name in ((0.007783884106636759, BLUE, "its orbit, $e$ = 0.0078"), (0.0, RED, "a circle")):
        left.plot(t / 3600, boom(eccentricity, t), color=colour, linewidth=1.4, label=name)
    left.set_xlabel("$t$ [h]")
    left.set_ylabel("from the vertical [deg]")
    left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, fontsize=9, frameon=False)
    left.set_title("The swing of a boom in the plane of its orbit")

    t = np.linspace(0, 1.5, 15001)
    for spin, wheel, look, name in ((3.0, 0.36, {"color": AMBER, "linewidth": 5.0}, "with a wheel, spin $r$"),
                                    (3.0 + 0.36 / 0.012, 0.0, {"color": BLUE, "linewidth": 1.4}, "without, spin $r + l/C$")):
        middle.plot(*top(spin, wheel, t).T, label=name, **look)
    middle.set_aspect("equal")
    middle.set_xlabel("axis 3 of the top, along 1")
    middle.set_ylabel("along 2")
    middle.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, fontsize=9, frameon=False)
    middle.set_title("A symmetric gyrostat is a top")

    t, J = np.linspace(0, 12, 12001), np.array([3.0, 2.5, 2.0])

    def wheel(s):
        """Momentum along axis 3 of a wheel that is driven from 6 s to 9 s."""
        return np.array([0.0, 0.0, 0.1 * min(max(s - 6.0, 0.0), 3.0)])

    def rate(s, M):
        push = np.array([0.4, 0.0, 0.0]) if 2.0 <= s < 4.0 else np.zeros(3)
        return np.cross(M, (M - wheel(s)) / J) + push

    omega = (integrated(rate, J * np.array([0.02, 0.3, 0.05]), t) - np.array([wheel(s) for s in t])) / J
    for i, colour in enumerate((BLUE, RED, GREEN)):
        right.plot(t, omega[:, i], color=colour, linewidth=1.4, label=rf"$\omega_{i + 1}$")
    right.axvspan(2, 4, color=AMBER, alpha=0.25, linewidth=0)
    for at in (6, 9):
        right.axvline(at, color=GREY, linestyle=":", linewidth=1.2)
    right.set_xlim(0, 12)
    right.set_xlabel("$t$ [s]")
    right.set_ylabel(r"$\omega$ [rad/s]")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=9, frameon=False)
    right.set_title("A torque on and off, then a wheel that is driven")
    return figure


FIGURES = (deceleration, rotor, spinning, heavy, free, general)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).parent)
    parser.add_argument("--format", choices=("svg", "png", "pdf"), default="svg")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        for draw in FIGURES:
            figure = draw()
            figure.savefig(given.folder / f"{draw.__name__}.{given.format}", dpi=110, bbox_inches="tight", pad_inches=0.06, metadata={"Date": None} if given.format == "svg" else None)
            plt.close(figure)


if __name__ == "__main__":
    main()
