# SPDX-License-Identifier: BSD-3-Clause
"""Figures of answers."""

import functools
import itertools
import math
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat.drawing import changes, curve, new_figure, save, time_unit

pytest.importorskip("matplotlib")

@pytest.fixture(autouse=True)
def room_for_labels() -> None:
    """Is made, here by day, too."""


SCENES = ("tiangong-1", "cubesat-wheel", "two-attractors", "pam-d-burn", "spinning-paper", "toy-top", "fast-spin")


def drawn(figure: Any) -> list[Any]:
    """Axes with curves over time, and their twins."""
    return [axes for axes in figure.axes if axes.lines and not axes.get_xlabel().startswith(("direction", "ω")) and axes.axison]


@functools.cache
def figure_of(scene: str) -> Any:
    return gyrostat.solve(scene).plot()


def legend_texts(figure: Any) -> set[str]:
    return {text.get_text() for axes in figure.axes if axes.get_legend() for text in axes.get_legend().get_texts()}


@pytest.mark.parametrize("scene", SCENES)
def test_every_panel_shows_something_and_nothing_lies_on_the_frame(scene: str) -> None:
    figure = figure_of(scene)
    assert all(axes.lines for axes in figure.axes)
    for axes in drawn(figure):
        low, high = axes.get_ylim()
        values = np.concatenate([np.asarray(line.get_ydata(), dtype=float) for line in axes.lines if line.get_linestyle() != ":"])
        values = values[np.isfinite(values)]
        room = 0.02 * (high - low) if axes.get_yscale() == "linear" else 0.0
        assert low <= values.min() and values.max() < high - room, axes.get_title(loc="left")


@pytest.mark.parametrize("scene", ["spinning-paper", "flat-sail", "no-stiffness", "toy-top"])
def test_what_is_written_has_room(scene: str, tmp_path: Path) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.image import imread
    from matplotlib.text import Text

    figure = gyrostat.solve(scene).plot(tmp_path / "answer.png")
    seen = imread(tmp_path / "answer.png")[..., :3]
    assert all(np.all(edge == 1) for edge in (seen[0], seen[-1], seen[:, 0], seen[:, -1]))  # nothing is cut
    FigureCanvasAgg(figure).draw()
    for axes in figure.axes:
        title, remark = (next((text for text in axes.findobj(Text) if text.get_text() == axes.get_title(loc=side)), None) for side in ("left", "right"))
        if axes.get_title(loc="left") and axes.get_title(loc="right"):
            assert title.get_window_extent().x1 + 4 < remark.get_window_extent().x0, title
    boxes = [axes.get_tightbbox() for axes in figure.axes]
    for (one, its), (other, of_other) in itertools.combinations(zip(boxes, figure.axes, strict=True), 2):
        assert its.get_position().bounds == of_other.get_position().bounds or not one.overlaps(other)


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("times", [[1.0], [0.0, 1.0]])
def test_one_time_and_two_are_marked(scene: str, times: list[float]) -> None:
    figure = gyrostat.solve(scene, times=times).plot()
    curves = [line for axes in drawn(figure) for line in axes.lines if len(line.get_xdata()) == len(times) and line.get_linestyle() == ":"]
    assert curves and all(line.get_marker() in "os" for line in curves)
    dots = {(line.get_marker(), line.get_markersize()) for line in curves}
    assert len(dots) == (2 if scene in ("tiangong-1", "cubesat-wheel") else 1)  # one within the other on two scales


def test_a_torque_that_is_switched_is_not_drawn_across_the_switch() -> None:
    answer = gyrostat.solve("iss-torque-pulse", times=[0.0, 1500.0, 1600.0, 28800.0], ask="all")
    panel = next(axes for axes in answer.plot().axes if axes.get_title(loc="left").startswith("External torque"))
    x, y = panel.lines[0].get_data()
    pieces = np.split(np.asarray(y, dtype=float), np.flatnonzero(np.isnan(np.asarray(y, dtype=float))))
    assert [len(piece[np.isfinite(piece)]) for piece in pieces] == [1, 2, 1] and np.all(np.diff(x) >= 0)
    alone = next(line for line in panel.lines if line.get_label() == "_alone")
    assert len(alone.get_xdata()) == 2


def test_angles_of_the_attitude_are_drawn_in_degrees() -> None:
    answer = gyrostat.solve("cubesat-three-wheels", ask=["euler"], **{"solve.euler": "3-2-1"})
    panels = drawn(answer.plot())
    (angles,) = [axes for axes in panels if "3-2-1" in axes.get_title(loc="left")]
    assert angles.get_ylabel() == "a [deg]"
    assert angles.lines[0].get_ydata()[0] == pytest.approx(np.degrees(answer["euler"][0, 0]))


def test_a_map_of_one_time_shows_all_that_its_legend_names() -> None:
    axes = gyrostat.solve("pam-d-burn", times=[50.0]).plot().axes[0]
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    for line in axes.lines:
        assert np.all((line.get_xdata() > left) & (line.get_xdata() < right) & (line.get_ydata() > low) & (line.get_ydata() < high)), line.get_label()


def test_constants_of_a_free_motion_have_room() -> None:
    figure = gyrostat.solve("tiangong-1", control=[0.0, 0.0, 0.0], drag=0.0, duration=500.0, samples=20, model="full").plot()
    size, energy = figure.axes[0], figure.axes[-1]
    for axes in (size, energy):
        assert np.max(axes.lines[0].get_ydata()) < 0.85 * axes.get_ylim()[1]


def test_a_tumbler_has_no_panels_of_what_stands_still() -> None:
    still = {"force": [0.0, 0.0, 0.0], "torque.body": [0.0, 0.0, 0.0], "initial.angular_velocity": [0.3, 0.5, 0.1]}
    figure = gyrostat.solve("spinning-paper", duration=60.0, samples=200, **still).plot()
    titles = {axes.get_title(loc="left") for axes in figure.axes}
    assert "Angular velocity, body axes" in titles
    assert not titles & {"Velocity gained", "Velocity, inertial axes", "Position, inertial axes"}


def test_a_tumbler_that_no_torque_turns_has_no_mean_pointing_to_speak_of() -> None:
    answer = gyrostat.solve("spinning-paper", duration=60.0, samples=200, **{"torque.body": [0.0, 0.0, 0.0], "initial.angular_velocity": [0.3, 0.5, 0.1]})
    assert answer.scalars["pointing_error"] == 0 and answer.scalars["tilt_max"] > 1
    title = answer.plot().get_suptitle()
    assert "greatest tilt" in title and "lean" not in title


def test_the_lean_under_the_torque_is_told_apart_from_that_of_the_start() -> None:
    stage = {"inertia": [760.0, 760.0, 340.0], "torque.body": [12.0, -4.0, 0.0], "duration": 10.0, "samples": 400}
    still = gyrostat.solve("pam-d-burn", **stage, **{"initial.angular_velocity": [0.0, 0.0, 6.283]}).plot().get_suptitle()
    assert "lean under the torque 0.054 deg" in still and "of the start" not in still
    nutating = gyrostat.solve("pam-d-burn", **stage, **{"initial.angular_velocity": [0.01, 0.0, 6.283]}).plot().get_suptitle()
    assert "lean under the torque 0.054 deg (without that of the start, 0.204 deg)" in nutating


def test_powers_of_ten_are_set_as_such_and_dollars_as_dollars(tmp_path: Path) -> None:
    figure = gyrostat.solve("intelsat-v-flat-spin", name="costs $5 and $6").plot()
    ticks = [text for axes in figure.axes for axis in (axes.xaxis, axes.yaxis) for text in axis.get_ticklabels(which="both")]
    assert any("mathdefault" in text.get_text() for text in ticks)
    assert all(text.get_parse_math() for text in ticks if "mathdefault" in text.get_text())
    assert "costs $5 and $6" in figure.get_suptitle() and not any(text.get_parse_math() for text in figure.texts)
    save(figure, tmp_path / "figure.png")
    assert all(text.get_parse_math() for text in ticks if "mathdefault" in text.get_text())


def test_a_stop_beyond_the_axis_is_marked() -> None:
    notes = [text.get_text() for axes in figure_of("tiangong-1").axes for text in axes.texts]
    assert notes == ["stops at 16.4 h →"]
    inside = figure_of("cubesat-wheel")
    assert not [text for axes in inside.axes for text in axes.texts]
    assert any(line.get_linestyle() == ":" for line in inside.axes[0].lines)


def test_a_body_that_its_rotors_keep_turning_is_not_drawn_at_rest() -> None:
    changes: dict[str, Any] = {"rotor_momentum": [0.02, 0.01, 0.0], "control": [0.01, 0.01, 0.01], "drag": 0.0, "law": "total", "inertia": [35.0, 22.0, 16.0],
                               "initial.angular_velocity": [0.5, 0.6, 0.7], "tolerance": 1e-4}
    gone = gyrostat.solve("tiangong-1", duration=4000.0, samples=101, **changes)
    assert "does-not-stop" in [warning.code for warning in gone.warnings] and "rest" in gone["regime"]
    figure = gone.plot()
    assert "momentum is 0 at" in figure.get_suptitle() and "stops" not in figure.get_suptitle() and "at rest" not in legend_texts(figure)
    later = gyrostat.solve("tiangong-1", duration=500.0, samples=51, **changes).plot()
    assert [text.get_text()[:8] for axes in later.axes for text in axes.texts] == ["|M| is 0"]


def test_a_stop_is_marked_where_columns_are_asked_for_by_name() -> None:
    figure = gyrostat.solve("tiangong-1", ask=["stop_time", "angular_momentum_norm"], duration=60000.0).plot()
    assert [line.get_linestyle() for line in figure.axes[0].lines].count(":") == 1


def test_the_path_on_a_sphere_is_named() -> None:
    assert {"path of down", "start"} <= legend_texts(figure_of("toy-top"))


def test_components_have_one_naming() -> None:
    names = set().union(*(legend_texts(figure_of(scene)) for scene in SCENES))
    assert {"ω1", "ω2", "ω3", "M1", "m1", "d1", "v3", "qw"} <= names
    assert not {name for name in names if len(name) == 2 and name[1] in "xyzw" and name[0] != "q"}


@pytest.mark.parametrize(("span", "unit"), [(0.0, "s"), (2e-5, "µs"), (0.05, "ms"), (2.0, "s"), (200.0, "s"), (600.0, "min"), (86400.0, "h"),
                                            (1e6, "days"), (1e9, "years")])
def test_times_have_fitting_units(span: float, unit: str) -> None:
    scale, name = time_unit(span)
    assert name == unit and (span == 0 or 0.9 < span / scale < 1100)


def test_what_is_constant_but_for_rounding_does_not_change() -> None:
    assert not changes(np.full((3, 3), 7.0)) and not changes(np.zeros(4)) and not changes(np.array([1.0, 1.0 + 1e-15, 1.0]))
    assert changes(np.array([1.0, 1.0 + 1e-6, 1.0])) and changes(np.array([5.0]))


def test_samples_that_draw_no_curve_are_dots() -> None:
    axes = new_figure(4, 3).subplots()
    t = np.arange(200.0)
    curve(axes, t, np.cos(2.9 * t), ["coarse"])
    curve(axes, t, np.cos(0.1 * t), ["fine"])
    assert [line.get_linestyle() for line in axes.lines] == ["None", "-"]
    assert math.isclose(axes.lines[0].get_markersize(), 2)
