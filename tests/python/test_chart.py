# SPDX-License-Identifier: BSD-3-Clause
"""The chart of error against cost."""

import csv
import io
import math
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import DomainError, charts, heavy
from gyrostat.charts import Chart, LeftOut, measured, methods
from gyrostat.charts.problem import Line, Run, Unanswered
from gyrostat.charts.problem import true_errors as errors_of_attitude
from gyrostat.cli import main
from gyrostat.families.deceleration.chart import true_errors
from gyrostat.families.general import chart as general_charts
from gyrostat.families.heavy import chart as heavy_charts
from gyrostat.families.rotor import chart as rotor_charts
from gyrostat.families.spinning import chart as spinning_charts
from gyrostat.scenes import load, scene_from


@pytest.fixture(scope="module")
def chart() -> Chart:
    return gyrostat.chart("tiangong-1", duration=4000.0, samples=21)


def test_every_method_stands_on_the_chart(chart: Chart) -> None:
    labels = set(chart.by_label())
    assert {"rung averaged", "rung full", "Taylor, order 20", "Runge-Kutta DOP853"} <= labels
    if gyrostat.build_info()["cvode"]:
        assert {"CVODE Adams", "CVODE BDF"} <= labels
    assert all(point.seconds > 0 for point in chart.points)


def test_errors_fall_with_the_tolerance_and_cost_grows(chart: Chart) -> None:
    for label, points in chart.by_label().items():
        if points[0].group in ("taylor", "dop853", "cvode"):
            errors = [point.error["angular_momentum"] for point in points]
            assert errors[-1] < 1e-3 * errors[0], label
            assert points[-1].rhs > points[0].rhs, label


def test_the_full_rung_is_as_good_as_it_says(chart: Chart) -> None:
    for point in chart.by_label()["rung full"]:
        stated = float(point.note.removeprefix("stated error "))
        assert point.error["angular_momentum"] <= stated


def test_the_chart_ends_before_the_stop() -> None:
    made = gyrostat.chart("cubesat-wheel", samples=11)
    assert "stops" in made.title
    assert all(math.isfinite(point.error["angular_momentum_norm"]) for point in made.points)


def test_true_errors_are_relative_to_the_greatest_size() -> None:
    want = np.array([[3.0, 4.0, 0.0], [0.0, 0.0, 1.0]])
    got = want + np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 0.0]])
    errors = true_errors({"angular_momentum": got}, want)
    assert errors["angular_momentum"] == pytest.approx(0.1)
    assert errors["angular_momentum_norm"] == pytest.approx((math.sqrt(25.25) - 5) / 5)
    assert math.isnan(true_errors({"angular_momentum_norm": np.array([5.0, 1.0])}, want)["angular_momentum"])


def test_what_is_left_out_is_said(chart: Chart) -> None:
    assert [(each.label, each.why) for each in chart.left_out] == [("rung equal-torque", "the control torques are not equal")]
    assert str(chart.left_out[0]) == "rung equal-torque: the control torques are not equal"


def test_a_method_that_takes_too_long_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(methods, "LONGEST", 5e-3)
    made = gyrostat.chart("tiangong-1", samples=3)
    assert all(point.seconds < 1e-2 for point in made.points)
    slow = {each.label: each for each in made.left_out if each.why == "takes over 0.005 s"}
    assert slow["SciPy DOP853 (Python right-hand side)"].settings[0] == "tolerance 0.0001"
    assert all(each.settings[-1] == "tolerance 1e-12" for each in slow.values())
    assert str(LeftOut("rung", "series", ("order 4", "order 6"), "why")) == "series, order 4, 6: why"


def test_what_else_the_machine_does_is_not_in_the_cost() -> None:
    """Beside a program on the same processor the clock on the wall runs twice as long as the solution."""
    swinging = {**heavy.arguments(load("toy-top", times=[500.0])), "attitude": None, "down": [0.6, 0.0, 0.8]}
    given = {key: value for key, value in swinging.items() if key not in ("periodic", "tolerance", "model", "integrator")}
    every = os.sched_getaffinity(0)
    for_a_minute = "import os, time\nos.sched_setaffinity(0, {%d})\nend = time.monotonic() + 60\nwhile time.monotonic() < end: pass"
    busy = subprocess.Popen([sys.executable, "-c", for_a_minute % min(every)])
    try:
        os.sched_setaffinity(0, {min(every)})
        began = time.thread_time()
        made = heavy.integrate(**given, method="dop853", tolerance=1e-12)
        used = time.thread_time() - began
    finally:
        os.sched_setaffinity(0, every)
        busy.kill()
        busy.wait()
    assert 0.05 < made["seconds"] <= used


def test_a_tighter_setting_that_would_take_too_long_is_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    def run() -> Run:
        nonlocal runs
        runs += 1
        return Run(0.6 * methods.LONGEST, {}, 1)

    monkeypatch.setattr(charts, "LONG", 0.2)
    runs = 0
    points, left_out = measured(Line("rival", "slow", (("loose", run), ("tight", run))), lambda _: {}, 7)
    assert runs == 1 and [point.setting for point in points] == ["loose"] and [each.settings for each in left_out] == [("tight",)]


@pytest.mark.parametrize("taken", [[0.03, 0.01, 0.02, 0.05, 0.1], [2e-3, *[1e-2] * 5, 1e-3]])
def test_the_cost_is_the_least_of_several_runs(taken: list[float], monkeypatch: pytest.MonkeyPatch) -> None:
    """Of seven, and no more once they have taken 0.2 s."""
    monkeypatch.setattr(charts, "LONG", 0.2)
    runs = iter([*taken, 1e-6])
    (point,), _ = measured(Line("rival", "quick", (("loose", lambda: Run(next(runs), {}, 1)),)), lambda _: {}, 7)
    assert point.seconds == min(taken) and list(runs) == [1e-6]


KINDS = ("tiangong-1", "two-attractors", "spinning-paper", "toy-top", "iss-drift", "rolling-gyroscope")


@pytest.mark.parametrize("scene", KINDS)
def test_a_single_time_is_charted_and_time_zero_refused(scene: str) -> None:
    made = gyrostat.chart(scene, times=[2.0])
    assert "1 time to 2 s" in made.title and "rung full" in made.by_label()
    with pytest.raises(DomainError, match="no motion to chart"):
        gyrostat.chart(scene, times=[0.0])


@pytest.mark.parametrize(("scene", "still"), [
    ("two-attractors", {"initial.angular_velocity": [0.0, 0.0, 0.0], "rotor_rate": 0.0, "no_load_rate": 0.0}),
    ("spinning-paper", {"initial.angular_velocity": [0.0, 0.0, 0.0], "torque.body": [0.0, 0.0, 0.0], "force": [0.0, 0.0, 0.0]}),
    ("toy-top", {"initial.angular_velocity": [0.0, 0.0, 0.0], "gravity": 0.0}),
    ("rolling-gyroscope", {"gravity": "0 m/s^2", "wheel": [], "ask": ["attitude", "angular_velocity", "down", "energy"]})])
def test_a_body_that_stays_at_rest_is_charted(scene: str, still: dict[str, Any]) -> None:
    made = gyrostat.chart(scene, duration=2.0, samples=3, **still)
    assert all(error < 1e-12 for point in made.points for error in point.error.values())


def test_a_body_without_momentum_has_nothing_to_chart() -> None:
    with pytest.raises(DomainError, match="at rest from the start"):
        gyrostat.chart("tiangong-1", angular_velocity=[0.0, 0.0, 0.0], control=[0.0, 0.0, 0.0], duration=10.0, samples=3)


def test_a_method_looks_the_same_in_every_chart(chart: Chart, rotor_chart: Chart) -> None:
    pytest.importorskip("matplotlib")

    def looks(made: Chart) -> dict[str, tuple[Any, ...]]:
        return {str(line.get_label()): (line.get_color(), line.get_marker(), line.get_markersize()) for line in made.plot().axes[0].lines}

    ours, theirs = looks(chart), looks(rotor_chart)
    common = set(ours) & set(theirs)
    assert {"rung full", "Taylor, order 20", "Runge-Kutta DOP853"} <= common
    assert all(ours[label] == theirs[label] for label in common)
    for each in (ours, theirs):
        assert len(set(each.values())) == len(each)


def test_files(chart: Chart, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    files = chart.save(tmp_path / "new" / "folder")
    assert [file.suffix for file in files] == [".png", ".svg", ".csv"] and all(file.stat().st_size > 1000 for file in files)
    rows = list(csv.DictReader(io.StringIO(files[2].read_text())))
    assert len(rows) == len(chart.points) + sum(len(each.settings) for each in chart.left_out)
    assert float(rows[len(chart.points) - 1]["seconds"]) == chart.points[-1].seconds
    for row, point in zip(rows, chart.points, strict=False):
        for measure in chart.measures:
            stated = row[f"stated_{measure.key}"]
            assert (float(stated) == point.stated[measure.key]) if measure.key in point.stated else not stated
            if stated and row[f"error_{measure.key}"]:
                assert float(row[f"error_{measure.key}"]) <= float(stated), row
    assert any(row["stated_angular_momentum"] for row in rows)
    assert rows[-1]["method"] == "rung equal-torque" and rows[-1]["note"] == "left out: the control torques are not equal"


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    status = main(["chart", "tiangong-1", "--set", "duration=1000.0", "--set", "samples=5", "-o", str(tmp_path)])
    out = capsys.readouterr().out
    assert status == 0 and str(tmp_path / "chart.png") in out


@pytest.fixture(scope="module")
def rotor_chart() -> Chart:
    return gyrostat.chart("two-attractors", duration=40.0, samples=21)


def test_every_method_of_a_rotor_scene_stands_on_the_chart(rotor_chart: Chart) -> None:
    labels = rotor_chart.by_label()
    assert {"rung full", "Taylor, order 20", "Radau IIA", "Runge-Kutta DOP853"} <= set(labels)
    if gyrostat.build_info()["cvode"]:
        assert {"CVODE Adams", "CVODE BDF"} <= set(labels)
    for label, points in labels.items():
        if points[0].group in ("taylor", "radau", "dop853", "cvode"):
            errors = [point.error["attitude"] for point in points]
            assert errors[-1] < 1e-3 * errors[0], label
    for point in labels["rung full"]:
        stated = float(point.note.removeprefix("stated error "))
        assert max(point.error.values()) <= stated


def test_a_stiff_scene_has_its_reference_and_its_chart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(methods, "LONGEST", 0.5)
    made = gyrostat.chart("stiff-wheel", duration=4.0, samples=5)
    assert "Radau in long double" in made.title
    lines = made.by_label()
    assert lines["Radau IIA"][-1].error["attitude"] < 1e-7
    fastest = min(point.seconds for point in lines["Radau IIA"])
    assert all(point.seconds > 10 * fastest for point in lines["Taylor, order 20"])
    assert lines["rung full"][-1].error["attitude"] < 1e-9


def test_a_long_scene_is_cut_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rotor_charts, "MOST_TURNS", 10.0)
    made = gyrostat.chart("two-attractors", duration=1e7, samples=5)
    assert "of the scene's 1e+07 s" in made.title


def test_errors_of_attitude_do_not_know_the_sign_of_a_quaternion() -> None:
    q = np.array([[0.0, 0.0, 0.0, 1.0], [0.0, 0.6, 0.0, 0.8]])
    rate = np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    half = 1e-9
    near = np.array([[math.sin(half), 0.0, 0.0, math.cos(half)], [0.0, -0.6, 0.0, -0.8]])
    errors = errors_of_attitude({"attitude": near, "angular_velocity": rate + [[0.0, 0.0, 0.0], [0.0, 0.0, 1e-3]]},
                                {"attitude": q, "angular_velocity": rate})
    assert errors["attitude"] == pytest.approx(2e-9, rel=1e-6)
    assert errors["angular_velocity"] == pytest.approx(5e-4)


def spinner(**solve: Any) -> dict[str, Any]:
    return {
        "name": "spinner", "kind": "spinning", "solve": {"duration": 120.0, "samples": 25, "tolerance": 1e-3, **solve},
        "body": {"inertia": [2985.0, 2729.0, 4183.0], "mass": 2017.0},
        "torque": {"body": [4.0, -2.0, 0.0], "force": [2.0, -1.0, 400.0]},
        "initial": {"angular_velocity": [0.002, -0.003, 0.7], "euler_312": [0.004, -0.002, 0.3], "velocity": [1.0, 0.0, -2.0]},
    }


@pytest.fixture(scope="module")
def spinning_chart() -> Chart:
    return gyrostat.chart(spinner())


def test_every_method_of_a_spinning_scene_stands_on_the_chart(spinning_chart: Chart) -> None:
    labels = spinning_chart.by_label()
    assert {"rung linear", "rung second-order", "rung picard", "rung full", "Taylor, order 20",
            "Runge-Kutta DOP853"} <= set(labels)
    if gyrostat.build_info()["cvode"]:
        assert {"CVODE Adams", "CVODE BDF"} <= set(labels)
    assert [measure.key for measure in spinning_chart.measures] == ["attitude", "velocity"]
    for label, points in labels.items():
        if points[0].group in ("taylor", "dop853", "cvode", "rival"):
            assert points[-1].error["attitude"] < 1e-3 * points[0].error["attitude"], label
        if points[0].group == "rung":
            for point in points:
                assert max(point.error.values()) <= float(point.note.removeprefix("stated error ")), label
    assert labels["rung second-order"][0].error["attitude"] < 0.1 * labels["rung linear"][0].error["attitude"]


def test_a_spinner_that_tumbles_has_no_closed_form_on_its_chart() -> None:
    tumbling = spinner(samples=5, duration=50.0)
    tumbling["torque"]["body"] = [2000.0, 0.0, 5.0]
    labels = gyrostat.chart(tumbling).by_label()
    assert "rung linear" not in labels and labels["rung full"][-1].error["attitude"] < 1e-9
    for rival in ("SciPy DOP853 (Python right-hand side)", "heyoka (compile time left out)"):
        assert rival not in labels or labels[rival][-1].error["velocity"] < 1e-7


def test_a_spinner_without_thrust_is_charted_by_its_rates(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spinning_charts, "MOST_TURNS", 5.0)
    coasting = spinner(samples=5)
    coasting["torque"]["force"] = [0.0, 0.0, 0.0]
    coasting["initial"]["velocity"] = [0.0, 0.0, 0.0]
    made = gyrostat.chart(coasting)
    assert [measure.key for measure in made.measures] == ["attitude", "angular_velocity"]
    assert "of the scene's 120 s" in made.title
    assert made.by_label()["Taylor, order 20"][-1].error["angular_velocity"] < 1e-12


def top(initial: dict[str, Any], **solve: Any) -> dict[str, Any]:
    return {
        "name": "top", "kind": "heavy", "solve": {"duration": 0.2, "samples": 21, "tolerance": 1e-3, **solve},
        "body": {"inertia": [0.0011, 0.0016, 0.0020], "mass": 0.8, "centre_of_mass": [0.012, 0.009, 0.010]},
        "field": {"gravity": 9.80665, "gravity_gradient": 0.5}, "initial": initial,
    }


def test_every_method_of_a_heavy_scene_stands_on_the_chart() -> None:
    labels = gyrostat.chart(top({"periodic": {"spin": 150.0, "cos_inclination": 0.1}})).by_label()
    assert {"rung series-2", "rung series", "rung full", "series, by order (from Python)", "Taylor, order 20",
            "Runge-Kutta DOP853"} <= set(labels)
    if gyrostat.build_info()["cvode"]:
        assert {"CVODE Adams", "CVODE BDF"} <= set(labels)
    for label, points in labels.items():
        assert set(points[0].error) == {"angular_velocity", "down"}
        if points[0].group in ("taylor", "dop853", "cvode", "rival"):
            assert points[-1].error["down"] < 1e-3 * points[0].error["down"], label
        if points[0].group == "rung":
            for point in points:
                assert max(point.error.values()) <= float(point.note.removeprefix("stated error ")) + 1e-13, label
    orders = labels["series, by order (from Python)"]
    assert orders[1].error["down"] < 0.05 * orders[0].error["down"]


def test_a_periodic_motion_of_a_body_in_other_axes_is_charted() -> None:
    scene = top({"periodic": {"spin": 150.0, "cos_inclination": 0.1}}, duration=0.05, samples=5)
    scene["body"]["inertia"] = [[1.1e-3, 1e-4, 0.0], [1e-4, 1.6e-3, -2e-4], [0.0, -2e-4, 2e-3]]
    labels = gyrostat.chart(scene).by_label()
    for label in ("series, by order (from Python)", "rung full", "Taylor, order 20"):
        assert labels[label][-1].error["down"] < 1e-10 and labels[label][-1].error["angular_velocity"] < 1e-10, label
    assert labels["rung series"][0].error["down"] < 1e-3


@pytest.mark.parametrize("start", [{"down": [0.6, 0.0, 0.8]}, {"attitude": [0.5, 0.5, 0.5, 0.5]}])
def test_rivals_know_the_same_heavy_body(start: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(heavy_charts, "MOST_TURNS", 3.0)
    scene = top({"angular_velocity": [3.0, -2.0, 40.0], **start}, duration=3.0)
    scene["body"]["inertia"] = [[1.1e-3, 1e-4, 0.0], [1e-4, 1.6e-3, -2e-4], [0.0, -2e-4, 2e-3]]
    made = gyrostat.chart(scene)
    assert "of the scene's 3 s" in made.title
    labels = made.by_label()
    assert "rung series" not in labels and labels["rung full"][-1].error["down"] < 1e-10
    for rival in ("SciPy DOP853 (Python right-hand side)", "heyoka (compile time left out)"):
        assert rival not in labels or labels[rival][-1].error["down"] < 1e-8


GENERAL: dict[str, Any] = {
    # every torque and wheel that the rival has, without what the bundled scenes have
    "laws": {
        "body": {"inertia": [3.0, 2.5, 2.0], "mass": 2.0, "centre_of_mass": [0.1, 0.05, -0.2], "rotor_momentum": [0.1, 0.0, 0.2]},
        "wheel": [{"type": "motor", "axis": [1.0, 2.0, 2.0], "axial_inertia": 0.1, "rate": 3.0, "slope": 0.02, "no_load_rate": 5.0, "friction": 0.01},
                  {"type": "held", "axis": [0.0, 3.0, 0.0], "axial_inertia": 0.05,
                   "rate": {"times": [0.0, 1.0, 2.5, 4.0], "values": [0.0, 3.0, -2.0, 1.0], "interpolation": "cubic", "extend": "hold"}},
                  {"type": "torque", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.02, "rate": 3.0, "friction": 0.001,
                   "torque": {"times": [0.5, 2.0], "values": [0.01, 0.02], "interpolation": "step"}}],
        "torque": [{"type": "constant", "torque": [0.1, 0.0, 0.02], "frame": "inertial",
                    "factor": {"mean": 1.0, "amplitude": 0.5, "rate": 0.7, "phase": 0.2}},
                   {"type": "table", "times": [0.0, 1.0, 3.0], "values": [[0.0, 0.1, 0.0], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1]]},
                   {"type": "damping", "coefficient": 0.01, "against": "carrier-momentum", "on": [[0.5, 2.0]]},
                   {"type": "thrust", "force": [0.0, 0.3, 0.1], "point": [0.2, 0.0, 0.1]}, {"type": "charge", "momentum": [0.1, 0.0, 0.3]},
                   {"type": "brake", "limit": [0.01, 0.02, 0.01]}],
        "initial": {"angular_velocity": [0.5, -0.2, 0.9]}},
    "orbit": {
        "body": {"inertia": [[3.0, 0.1, 0.0], [0.1, 2.5, 0.2], [0.0, 0.2, 2.0]]}, "orbit": {"altitude": 4e5, "eccentricity": 0.01, "true_anomaly": 0.3},
        "field": {"dipole": {"axis": [0.1, 0.0, 2.0], "strength": 3.1e-5, "radius": 6371200.0}},
        "torque": [{"type": "gravity-gradient"}, {"type": "magnetic", "dipole": [5.0, 1.0, 0.0]}, {"type": "eddy-current", "coefficient": 1e4},
                   {"type": "constant", "torque": [1e-5, 0.0, 1e-5], "frame": "orbit"}],
        "initial": {"angular_velocity": [0.01, 0.0, 0.02]}},
    "fixed": {
        "body": {"inertia": [3.0, 2.5, 2.0], "fixed": True, "mass": 2.0, "centre_of_mass": [0.1, 0.05, -0.2]},
        "field": {"gravity": 9.81, "down": [0.0, 0.1, -2.0], "rotating": {"axis": [0.0, 0.0, 2.0], "rate": 0.3, "vector": [1e-4, 0.0, 1e-5]}},
        "torque": [{"type": "weight"}, {"type": "eddy-current", "coefficient": 1e7}, {"type": "gravity-gradient", "gradient": 0.2},
                   {"type": "damping", "coefficient": 0.02, "against": "momentum"}],
        "initial": {"angular_velocity": [0.3, -0.5, 0.8]}}}


@pytest.mark.parametrize("name", GENERAL)
def test_every_method_of_a_general_scene_stands_on_the_chart(name: str) -> None:
    end = 600.0 if name == "orbit" else 4.0
    made = gyrostat.chart({"name": name, "kind": "general", "solve": {"duration": end, "samples": 17}, **GENERAL[name]})
    labels = made.by_label()
    assert {"rung full", "Taylor, order 20", "Runge-Kutta DOP853", "SciPy DOP853 (Python right-hand side)"} <= set(labels)
    if gyrostat.build_info()["cvode"]:
        assert {"CVODE Adams", "CVODE BDF"} <= set(labels)
    for label, points in labels.items():
        for key in ("attitude", "angular_velocity"):
            if points[0].group == "rung":
                assert all(point.error[key] <= float(point.note.removeprefix("stated error ")) for point in points), label
            else:
                assert points[-1].error[key] < min(1e-3 * points[0].error[key], 1e-7), (label, key)
    assert {each.label for each in made.left_out} <= {"heyoka (compile time left out)"}


class Told:
    """Stands in for heyoka: its expressions are numbers, of one time and one state."""

    expression = float
    cos, sin, sqrt = map(staticmethod, (math.cos, math.sin, math.sqrt))

    def __init__(self, time: float, state: list[float]) -> None:
        self.time, self.state = time, state

    def make_vars(self, *names: str) -> list[float]:
        assert len(names) == len(self.state)
        return self.state


def without_single_times(tables: dict[str, Any]) -> dict[str, Any]:
    """Of a general scene, what has no table, no interval and no ellipse."""
    made = {**tables, "wheel": [each for each in tables.get("wheel", ()) if not any(isinstance(value, dict) for value in each.values())]}
    made["torque"] = [{key: value for key, value in each.items() if key != "on" and not (key == "factor" and "times" in value)} for each in tables["torque"]
                      if each["type"] != "table"]
    if "orbit" in tables:
        made["orbit"] = {**tables["orbit"], "eccentricity": 0.0}
    return made


@pytest.mark.parametrize("name", GENERAL)
def test_what_heyoka_integrates_is_the_right_hand_side(name: str) -> None:
    data = {"name": name, "kind": "general", "solve": {"times": [4.0]}, **GENERAL[name]}
    if name != "fixed":
        with pytest.raises(Unanswered, match="are not written for it"):
            general_charts.problem(scene_from(data)).rival.system(Told(0.0, []))
    rival = general_charts.problem(scene_from({**data, **without_single_times(GENERAL[name])})).rival
    for time in (0.0, 1.3):
        state = rival.start + 0.1 * time
        state[:4] /= np.linalg.norm(state[:4])
        pairs = rival.system(Told(time, state.tolist()))
        assert np.allclose([rate for _, rate in pairs], rival.right()(time, state), rtol=1e-12, atol=1e-14)
    pytest.importorskip("heyoka")
    chart = gyrostat.chart({**data, **without_single_times(GENERAL[name])})
    points = chart.by_label()["heyoka (compile time left out)"]
    assert points[-1].error["attitude"] < 1e-10


def test_the_rungs_on_the_chart_of_a_general_scene_are_those_of_its_families() -> None:
    pytest.importorskip("matplotlib")
    made = gyrostat.chart("iss-drift", duration=4000.0, samples=11)
    rungs = {label for label in made.by_label() if label.startswith("rung")}
    assert rungs == {"rung free:closed-form", "rung free:full", "rung full"} and len(made.by_label()["rung free:full"]) == 5
    lines = made.plot().axes[0].lines
    assert len({(line.get_color(), line.get_marker(), line.get_markersize()) for line in lines}) == len(lines)


@pytest.mark.parametrize("name", ["wheel-seized", "clock"])
def test_a_scene_that_goes_on_is_charted_from_its_start_on(name: str) -> None:
    pytest.importorskip("scipy")
    later: dict[str, Any] = {"name": "clock", "kind": "general", "solve": {"times": [40.0, 41.0, 44.0]}, "initial": {
        "time": 40.0, "angular_velocity": [0.3, -0.5, 0.8], "error": {"attitude": 0.1}}, "field": {"rotating": {"axis": [0.0, 0.3, 1.0], "rate": 0.3, "vector": [1e-4, 0.0, 2e-4]}},
        "body": {"inertia": [3.0, 2.5, 2.0]}, "orbit": {"altitude": 4e5, "eccentricity": 0.1},
        "wheel": [{"type": "held", "axis": [0.0, 1.0, 0.0], "axial_inertia": 0.1, "rate": {"times": [39.0, 42.0, 50.0], "values": [1.0, 3.0, 2.0]}}],
        "torque": [{"type": "constant", "torque": [0.1, 0.0, 0.02], "on": [[10.0, 43.0]], "factor": {"mean": 1.0, "amplitude": 0.3, "rate": 0.4, "phase": 0.2}},
                   {"type": "magnetic", "dipole": [100.0, 200.0, 50.0]}, {"type": "gravity-gradient"}]}
    made = gyrostat.chart(name, samples=13) if name != "clock" else gyrostat.chart(later)
    assert "the start taken as exact" in made.title and "from" in made.title.splitlines()[0]
    for label, points in made.by_label().items():
        for key in ("attitude", "angular_velocity"):
            if points[0].group == "rung":
                assert all(point.error[key] <= float(point.note.removeprefix("stated error ")) for point in points), label
            else:
                assert points[-1].error[key] < min(1e-3 * points[0].error[key], 1e-7), (label, key)
    assert {each.label for each in made.left_out} <= {"heyoka (compile time left out)"}


def test_a_general_scene_that_a_brake_stops_is_not_charted_beyond(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = {"name": "braked", "kind": "general", "solve": {"times": [1.0, 60.0]}, **GENERAL["laws"], "torque": [{"type": "brake", "limit": [0.1, 0.2, 0.1]}]}
    for wheels in (GENERAL["laws"]["wheel"][2:], []):
        with pytest.raises(DomainError, match="choose a shorter time: .*brake"):
            pushed = [*scene["torque"], {"type": "constant", "torque": [0.01, 0.0, 0.0]}]
            gyrostat.chart({**scene, "wheel": wheels, "torque": pushed, "body": {"inertia": [3.0, 2.5, 2.0]}})
    monkeypatch.setattr(general_charts, "MOST_TURNS", 2.0)
    assert "of the scene's 180 s" in gyrostat.chart("spinner-pulsed-thrust").title
