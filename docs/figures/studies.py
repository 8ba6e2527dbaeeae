#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of docs/studies.md, each from all rows of its sweep: some minutes.

    studies.py [FOLDER] [--keep DIR]      writes them to docs/gallery, or into FOLDER

What is computed is kept in DIR, and taken from there the next time. Needs the package gyrostat with its extras `cli` and `xarray`. The numbers that the page
names are printed.
"""
import argparse
import pathlib

import gyrostat
import numpy as np
from draw import AMBER, BLUE, GREEN, GREY, RED, STYLE, plt
from gallery import save
from gyrostat.sweep_report import Response, rank_correlations, responses, sobol_indices

SIZE = (9.0, 3.0)
LEVELS = (5, 50, 95)


def histogram(axes, values, unit):
    """Rows over a number, with the percentiles that the page names."""
    axes.hist(values, bins=60, color=BLUE, alpha=0.75)
    for level, style in zip(LEVELS, (":", "-", ":"), strict=True):
        at = np.percentile(values, level)
        axes.axvline(at, color=RED, linestyle=style, linewidth=1.3, label=f"{level} %: {at:.3g} {unit}")
    axes.set_ylim(top=1.4 * axes.get_ylim()[1])  # the legend stands above
    axes.legend(fontsize=8, framealpha=1, edgecolor="none", loc="upper right")
    axes.set_ylabel("rows")


def bars(axes, named, colour=BLUE, **more):
    """Bars with names, the longest on top."""
    order = sorted(named, key=lambda name: abs(named[name]))
    axes.barh(order, [named[name] for name in order], color=colour, **more)
    axes.grid(axis="x", alpha=0.3, linewidth=0.5)
    axes.tick_params(axis="y", labelsize=8)


def despin(rows, figure):
    left, middle, right = figure.subplots(1, 3, width_ratios=(1, 1, 0.8))
    hours = rows["stop_time"].values / 3600
    histogram(left, hours, "h")
    left.set_xlabel("time to rest [h]")
    drag = rows["torque.drag"].values
    models = rows["model"].values.astype(str)
    for model, colour in (("averaged", BLUE), ("averaged-2", AMBER), ("full", GREEN)):
        of = np.flatnonzero(models == model)
        middle.plot(drag[of[::4]], hours[of[::4]], ".", markersize=1.5, color=colour, rasterized=True)
        middle.plot([], [], "o", markersize=4, color=colour, label=f"{model}, {100 * len(of) / len(models):.0f} %")
    middle.set_xscale("log")
    middle.set_xlabel("drag of the eddy currents [1/s]")
    middle.set_ylabel("time to rest [h]")
    middle.legend(fontsize=8, frameon=False, title="answered by", title_fontsize=8)
    names = {"body.inertia[0]": "inertia, axis 1", "body.inertia[1]": "inertia, axis 2", "body.inertia[2]": "inertia, axis 3",
             "torque.control[0]": "plume, axis 1", "torque.drag": "eddy currents", "initial.angular_velocity[0]": "rate, axis 1",
             "initial.angular_velocity[2]": "rate, axis 3"}
    ranked = rank_correlations(rows, responses(rows)[0])
    bars(right, {names[key]: value for key, value in ranked.items()})
    right.axvline(0, color="black", linewidth=0.8)
    right.set_xlim(-1, 1)
    right.set_xlabel("rank correlation with the time")
    print("despin [h]", np.percentile(hours, LEVELS), {key: round(value, 2) for key, value in ranked.items()}, "met", float(rows["met"].mean()))


def burn(rows, figure):
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.2))
    velocity = rows["velocity"].values[:, -1]
    off = np.degrees(np.arctan2(np.hypot(velocity[:, 0], velocity[:, 1]), velocity[:, 2]))
    tilt = np.degrees(rows["tilt_max"].values)
    points = np.arange(len(off)) % 9 < 2  # a study of its own; the other seven of a point are mixtures of these two
    histogram(left, off[points], "°")
    left.set_xlabel("angle of the velocity gained to the aim [°]")
    names = {"torque.body": "torque across, each", "torque.force": "side force, each", "initial.angular_velocity[2]": "spin rate",
             "initial.angular_velocity": "rate across at the start, each"}
    shown = {}
    for label, values in (("of the velocity", off), ("of the greatest tilt", tilt)):
        total = sobol_indices(rows, Response(label, "deg", values, None))
        # the two of a pair are alike: their mean
        shown[label] = {name: float(np.mean([index.total for key, index in total.items() if key == start or (key[:-3] == start and not key.endswith("y[2]"))]))
                        for start, name in names.items()}
        print("burn", label, "[deg]", np.percentile(values[points], LEVELS), {key: (round(index.first, 3), round(index.total, 3), round(index.total_error, 3))
                                                                            for key, index in total.items()})
    order = sorted(names.values(), key=lambda name: shown["of the velocity"][name])
    places = np.arange(len(order))
    for (label, found), shift, colour in zip(shown.items(), (0.19, -0.19), (BLUE, AMBER), strict=True):
        right.barh(places + shift, [found[name] for name in order], height=0.36, color=colour, label=label)
    right.set_yticks(places, order, fontsize=8)
    right.set_xlabel("share of the variance (total Sobol index)")
    right.legend(fontsize=8, frameon=False, title="angle", title_fontsize=8, loc="lower right")
    right.grid(axis="x", alpha=0.3, linewidth=0.5)


def recovery(rows, figure):
    left, right = figure.subplots(1, 2)
    momentum = rows["angular_momentum"].values
    tilt = np.degrees(np.arccos(np.clip(momentum[..., 1] / np.linalg.norm(momentum, axis=-1), -1, 1)))
    slope, hours = rows["motor.slope"].values, rows["time"].values / 3600
    slopes = np.unique(slope)
    levels = np.array([np.percentile(tilt[slope == each, -1], (5, 25, 50, 75, 95)) for each in slopes]).T
    minutes = 0.159 / slopes / 60
    left.fill_between(minutes, levels[0], levels[4], color=BLUE, alpha=0.2, linewidth=0, label="5 to 95 %")
    left.fill_between(minutes, levels[1], levels[3], color=BLUE, alpha=0.4, linewidth=0, label="25 to 75 %")
    left.plot(minutes, levels[2], "o-", color=BLUE, markersize=3, linewidth=1.2, label="median")
    left.set_xlabel("time constant of the wheel, inertia over slope [min]")
    left.set_ylabel("pitch axis to momentum after 12 h [°]")
    left.set_ylim(0, 90)
    left.legend(fontsize=8, frameon=False)
    for each, colour in ((slopes[0], BLUE), (slopes[4], AMBER), (slopes[-1], RED)):
        of = tilt[slope == each]
        right.fill_between(hours, *np.percentile(of, (5, 95), axis=0), color=colour, alpha=0.2, linewidth=0)
        right.plot(hours, np.median(of, axis=0), color=colour, linewidth=1.2, label=f"{0.159 / each / 60:.0f} min")
    right.set_xlabel("time [h]")
    right.set_ylabel("pitch axis to momentum [°]")
    right.set_xlim(0, 12)
    right.set_ylim(0, 120)
    right.legend(fontsize=8, frameon=False, title="time constant", title_fontsize=8, loc="upper right", ncols=3)
    for axes in (left, right):
        axes.grid(alpha=0.3, linewidth=0.5)
    within = {round(0.159 / each / 60): [round(100 * float(np.mean(tilt[slope == each, -1] < angle))) for angle in (10, 30)] for each in slopes}
    print("recovery: min -> % within 10 and 30 deg", within, {round(0.159 / each / 60): np.round(levels[:, i], 1).tolist() for i, each in enumerate(slopes)})
    share = Response("tilt", "deg", tilt[:, -1], None)
    print({key: round(value, 2) for key, value in rank_correlations(rows, share).items()})
    slow = rows.isel(row=np.flatnonzero(slope == slopes[0]))
    print("slowest", {key: round(value, 2) for key, value in rank_correlations(slow, Response("tilt", "deg", tilt[slope == slopes[0], -1], None)).items()})


STUDIES = {"stage-despin-study": despin, "burn-pointing-study": burn, "flat-spin-recovery-study": recovery}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1] / "gallery")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE | {"font.size": 9})
    for name, draw in STUDIES.items():
        rows = gyrostat.sweep(name, parts=arguments.keep and arguments.keep / name)
        figure = plt.figure(figsize=SIZE, layout="constrained")
        draw(rows, figure)
        save(figure, arguments.folder / f"{name}-rows.png")


if __name__ == "__main__":
    main()
