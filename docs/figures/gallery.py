#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of docs/gallery.md, one of every bundled scene as it is solved, and the chart of the landing page.

    gallery.py [FOLDER]      writes them to docs/gallery, or into FOLDER

Needs the package gyrostat with its extra `cli`; the chart has SciPy in it where that is installed.
"""
import argparse
import pathlib

import gyrostat
import numpy as np
from draw import BLUE, GREEN, GREY, RED, STYLE, View, plt
from gyrostat.drawing import time_unit
from gyrostat.rotation import matrix_from_quaternion
from gyrostat.scenes import bundled
from PIL import Image

WIDTH, HEIGHT, DOTS = 2.7, 2.1, 100
COLOURS = 64
SAMPLES = 20001  # of a motion: enough for round curves
SMALL = 0.4  # rad: a path that stays within is drawn on a plane
PIECES = 24  # of a path, each of its own colour: light at the start, dark at the end


def shades(count):
    return plt.get_cmap("viridis_r")(np.linspace(0.1, 1.0, count))


def cut(points):
    """The pieces of a path, each with the first point of the next."""
    ends = np.linspace(0, len(points) - 1, PIECES + 1).astype(int)
    return [points[a:b + 1] for a, b in zip(ends[:-1], ends[1:], strict=True) if b > a]


def axis_3(answer):
    """The third body axis in inertial space, whose axis 3 points up."""
    return matrix_from_quaternion(answer["attitude"])[:, :, 2]


def on_sphere(axes, points, caption):
    """The path of a direction on the unit sphere."""
    view = View(axes, 35, 22)
    s = np.linspace(0, 2 * np.pi, 181)
    view.axes.plot(np.cos(s), np.sin(s), color=GREY, linewidth=0.9)
    for circle in (np.stack([np.cos(s), np.sin(s), 0 * s], -1), np.stack([np.cos(s), 0 * s, np.sin(s)], -1)):
        view.on_sphere(circle, color=GREY, linewidth=0.4)
    pieces = cut(points)
    for piece, shade in zip(pieces, shades(len(pieces)), strict=True):
        view.on_sphere(piece, color=shade, linewidth=1.1, zorder=3)
    view.line(points[:1], color=GREEN, marker="o", markersize=4.5, zorder=6)
    view.line(points[-1:], color=RED, marker="o", markersize=4.5, zorder=6)
    axes.set_title(caption)


def in_plane(axes, points, centre, caption):
    """The path of a direction beside `centre`, looked at from outside, as large as it is; of a long one the first turns."""
    first = np.cross([0.0, 1.0, 0.0], centre)
    first /= np.linalg.norm(first)
    flat = np.degrees(np.stack([points @ first, points @ np.cross(centre, first)], -1))
    lengths = np.linalg.norm(np.diff(flat, axis=0), axis=1).cumsum()
    flat = flat[:1 + np.searchsorted(lengths, 120 * np.ptp(flat, axis=0).max())]
    pieces = cut(flat)
    for piece, shade in zip(pieces, shades(len(pieces)), strict=True):
        axes.plot(piece[:, 0], piece[:, 1], color=shade, linewidth=0.9)
    axes.plot(*flat[0], "o", color=GREEN, markersize=4.5)
    axes.plot(*flat[-1], "o", color=RED, markersize=4.5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_title(f"{caption} [deg]")


def direction(axes, vectors, caption):
    """The path of a direction: on the sphere, or where it stays together on a plane beside it."""
    points = vectors / np.linalg.norm(vectors, axis=1)[:, None]
    centre = points.mean(axis=0)
    length = np.linalg.norm(centre)
    if length > 0 and (points @ centre).min() > np.cos(SMALL) * length:
        in_plane(axes, points, centre / length, caption)
    else:
        on_sphere(axes, points, caption)


def wheels(axes, answer):
    """The rates of the wheels over time."""
    unit, name = time_unit(answer.t[-1])
    axes.axhline(0, color=GREY, linewidth=0.5)
    for rates, colour in zip(answer["rotor_rate"].T, (BLUE, GREEN, RED, "black"), strict=False):
        axes.plot(answer.t / unit, rates * 60 / (2 * np.pi), color=colour, linewidth=1.2)
    axes.set_xlim(left=0)
    axes.set_title(f"wheels [rpm] over {name}")


def falling(axes, answer):
    """The momentum over time."""
    unit, name = time_unit(answer.t[-1])
    axes.fill_between(answer.t / unit, answer["angular_momentum_norm"], color=BLUE, alpha=0.2, linewidth=0)
    axes.plot(answer.t / unit, answer["angular_momentum_norm"], color=BLUE, linewidth=1.4)
    stop = answer.scalars.get("stop_time")
    if stop is not None and stop < 2 * answer.t[-1]:
        axes.axvline(stop / unit, color=RED, linestyle=":", linewidth=1.2)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.set_title(f"|M| [N m s] over {name}")


def save(figure, file):
    """A small file: of few colours."""
    figure.savefig(file, dpi=DOTS)
    plt.close(figure)
    with Image.open(file) as image:
        few = image.convert("RGB").quantize(COLOURS)
    few.save(file, optimize=True)


def general(axes, scene, answer):
    """Wheels where motors or bearings change their rates, else the path of an axis: in the axes of the orbit that which points down."""
    if any(wheel["type"] in ("torque", "motor", "friction") for wheel in scene.top["wheel"]):
        wheels(axes, answer)
    elif "attitude_orbit" in answer.columns:
        direction(axes, matrix_from_quaternion(answer["attitude_orbit"])[:, :, 0], "axis 1, seen from the orbit")
    else:
        direction(axes, axis_3(answer), "axis 3 in space")


def picture(name, file):
    scene = gyrostat.load(name)
    if scene.kind != "deceleration":
        scene = scene.replace(duration=float(scene.times[-1]) - scene.start_time, samples=SAMPLES, **({} if scene.kind == "general" else {"ask": "default"}))
    answer = gyrostat.solve(scene)
    figure, axes = plt.subplots(figsize=(WIDTH, HEIGHT), layout="constrained")
    axes.tick_params(labelsize=7)
    if scene.kind == "deceleration":
        falling(axes, answer)
    elif scene.kind == "spinning" or scene.kind == "heavy" and "attitude" in answer.columns:
        direction(axes, axis_3(answer), "axis 3 in space")
    elif scene.kind == "heavy":
        direction(axes, answer["down"], "down, seen from the body")
    elif scene.kind == "general":
        general(axes, scene, answer)
    else:
        direction(axes, answer["angular_momentum"], "momentum, seen from the body")
    save(figure, file)


def landing(file):
    """Error against cost for one scene: rungs of the ladder beside integrators."""
    chart = gyrostat.chart("tiangong-1")
    shown = {"rung averaged": (RED, "s"), "rung averaged-2": (RED, "D"), "rung full": (RED, "o"), "Taylor, order 20": (BLUE, "."),
             "Runge-Kutta DOP853": (GREEN, "."), "CVODE Adams": (GREY, "."), "SciPy DOP853 (Python right-hand side)": ("black", ".")}
    figure, axes = plt.subplots(figsize=(7.2, 3.9), layout="constrained")
    points = chart.by_label()
    for label, (colour, marker) in shown.items():
        if label in points:
            axes.loglog([p.seconds for p in points[label]], [max(p.error[chart.measures[0].key], 1e-16) for p in points[label]], color=colour,
                        marker=marker, markersize=7, linewidth=1.1, label=label.replace(" (Python right-hand side)", ""))
    axes.set_xlabel("CPU time of one solution [s]")
    axes.set_ylabel("greatest true error of |M|, relative")
    axes.set_title("A tumbling space station, 977 turns: what accuracy costs")
    axes.grid(alpha=0.3, linewidth=0.5)
    axes.legend(fontsize=8, frameon=False, ncols=2)
    save(figure, file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1] / "gallery")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE | {"axes.titlesize": 8.5, "axes.titlelocation": "center", "font.size": 8})
    for name, _ in bundled():
        picture(name, folder / f"{name}.png")
    landing(folder / "chart.png")


if __name__ == "__main__":
    main()
