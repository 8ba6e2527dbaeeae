#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The moving picture of the readme: the scene t-handle over one period, as fast as it is.

    animation.py [FILE]      writes it to docs/gallery/t-handle.gif, or there

Needs the package gyrostat with its extra `cli`.
"""
import argparse
import io
import pathlib

import gyrostat
import numpy as np
from draw import AMBER, BLUE, GREEN, GREY, RED, STYLE, View, plt
from gyrostat.rotation import matrix_from_quaternion
from matplotlib.colors import to_rgb
from matplotlib.patches import Polygon
from PIL import Image

FRAMES_A_SECOND = 20
SIDES = 12
LIGHT = np.array([0.6, 0.2, 0.77])
STEEL = np.array(to_rgb("#A9B8C6"))
# Space as it is looked at: the momentum, nearly along inertial axis 2, points up.
LOOKED_AT = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def rod(start, axis, across, length, radius):
    """The faces of a rod, as polygons and outward normals, in body axes."""
    axis, across = np.eye(3)[axis], np.eye(3)[across]
    third = np.cross(axis, across)
    s = np.pi * (2 * np.arange(SIDES) + 1) / SIDES
    rim = np.asarray(start) + radius / np.cos(np.pi / SIDES) * (np.cos(s)[:, None] * across + np.sin(s)[:, None] * third)
    far = rim + length * axis
    sides = [np.array([rim[i - 1], rim[i], far[i], far[i - 1]]) for i in range(SIDES)]
    outward = [face.mean(axis=0) - np.asarray(start) - 0.5 * length * axis for face in sides]
    return [*zip(sides, outward, strict=True), (rim, -axis), (far, axis)]


# The bar lies along axis 3, that of least inertia; the stem, along the middle axis 2, is what it spins about.
HANDLE = [*rod([0.0, -0.16, -1.0], 2, 0, 2.0, 0.16), *rod([0.0, -0.16, 0.0], 1, 0, 1.0, 0.16)]


def body(view, R_IB):
    """The handle, far faces first; those turned away are not seen."""
    R = LOOKED_AT @ R_IB
    seen = [(points @ R.T, R @ normal / np.linalg.norm(normal)) for points, normal in HANDLE]
    for points, normal in sorted(seen, key=lambda face: view.depth(face[0].mean(axis=0))):
        if view.depth(normal) > 0:
            shade = STEEL * (0.45 + 0.55 * max(0.0, normal @ LIGHT))
            view.axes.add_patch(Polygon(view.flat(points), closed=True, facecolor=shade, edgecolor=shade, linewidth=0.4, zorder=3))


def frame(answer, i, R_IB):
    """The body in space at time i, and the rates in the body up to then."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(5.6, 2.4), width_ratios=[1, 1.35], layout="constrained")
    view = View(left, 35, 18)
    left.set_xlim(-1.25, 1.25)
    left.set_ylim(-1.25, 1.45)
    body(view, R_IB)
    view.arrow([0, 0, 1.02], [0, 0, 1.4], color=RED, width=1.4, head=9, zorder=6)
    left.set_title("momentum (red) stands still")
    for part, colour in enumerate((BLUE, AMBER, GREEN)):
        rate = answer["angular_velocity"][:, part]
        right.plot(answer.t, rate, color=colour, linewidth=0.7, alpha=0.35)
        right.plot(answer.t[:i + 1], rate[:i + 1], color=colour, linewidth=1.4, label=f"axis {part + 1}")
        right.plot(answer.t[i], rate[i], color=colour, marker="o", markersize=4)
    right.axhline(0, color=GREY, linewidth=0.5)
    right.set_xlim(0, answer.t[-1])
    right.set_xlabel("t [s]")
    right.set_title("rates about the body axes [rad/s]")
    right.legend(loc="lower right", fontsize=6.5, frameon=False, handlelength=1.2)
    stream = io.BytesIO()
    figure.savefig(stream, dpi=90)
    plt.close(figure)
    return Image.open(stream).convert("RGB")


def palette():
    """The colours of the picture and their ways to white, and the shades of the body."""
    to_white = np.linspace(0, 1, 9)[:, None]
    parts = [(1 - to_white) * to_rgb(colour) + to_white for colour in (BLUE, AMBER, GREEN, RED, "black")]
    made = Image.new("P", (1, 1))
    made.putpalette(np.round(255 * np.concatenate([*parts, np.linspace(0.45, 1, 19)[:, None] * STEEL])).astype(int).ravel().tolist())
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1] / "gallery" / "t-handle.gif")
    file = parser.parse_args().file
    plt.rcParams.update(STYLE | {"axes.titlesize": 8, "axes.titlelocation": "center", "font.size": 7.5})
    period = gyrostat.solve("t-handle").scalars["period"]
    answer = gyrostat.solve("t-handle", duration=period, samples=round(period * FRAMES_A_SECOND))
    frames = [frame(answer, i, R_IB) for i, R_IB in enumerate(matrix_from_quaternion(answer["attitude"]))]
    few = [each.quantize(palette=palette(), dither=Image.Dither.NONE) for each in frames]
    few[0].save(file, save_all=True, append_images=few[1:], duration=1000 // FRAMES_A_SECOND, loop=0, optimize=True)
    print(f"wrote {file}: {len(few)} frames, {file.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
