# SPDX-License-Identifier: BSD-3-Clause
"""The chart of error against cost."""

import csv
import io
import math
from pathlib import Path

import gyrostat
import numpy as np
import pytest
from gyrostat.charts import Chart
from gyrostat.charts.deceleration import true_errors
from gyrostat.cli import main


@pytest.fixture(scope="module")
def chart() -> Chart:
    return gyrostat.chart("tiangong-1", duration=4000.0, samples=21)


def test_every_method_stands_on_the_chart(chart: Chart) -> None:
    labels = set(chart.by_label())
    assert {"rung averaged", "rung full", "Taylor, order 8", "Taylor, order 20", "Runge-Kutta DOP853"} <= labels
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
    errors = true_errors(got, None, want)
    assert errors["angular_momentum"] == pytest.approx(0.1)
    assert errors["angular_momentum_norm"] == pytest.approx((math.sqrt(25.25) - 5) / 5)
    assert math.isnan(true_errors(None, np.array([5.0, 1.0]), want)["angular_momentum"])


def test_files(chart: Chart, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    files = chart.save(tmp_path / "new" / "folder")
    assert [file.suffix for file in files] == [".png", ".svg", ".csv"] and all(file.stat().st_size > 1000 for file in files)
    rows = list(csv.DictReader(io.StringIO(files[2].read_text())))
    assert len(rows) == len(chart.points)
    assert float(rows[-1]["seconds"]) == chart.points[-1].seconds


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    status = main(["chart", "tiangong-1", "--set", "duration=1000.0", "--set", "samples=5", "-o", str(tmp_path)])
    out = capsys.readouterr().out
    assert status == 0 and str(tmp_path / "chart.png") in out
