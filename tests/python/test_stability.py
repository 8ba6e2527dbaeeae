# SPDX-License-Identifier: BSD-3-Clause
"""The stability report: its table, its start, its refusals, its figure."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gyrostat
from gyrostat.cli import main
from gyrostat.families.deceleration.stability import quasi_stationary_line
from gyrostat.scenes import scene_from
from gyrostat.stability import plot_stability, report_stability, stability_report

# Torques about axes 1, 2, 3 and what they do in regime A: one row for each region.
ROWS = [((0.5, 0.8, 1.0), "to-axis"), ((1.5, 1.2, 1.0), "to-separatrix"), ((0.9, 0.6, 1.0), "to-interior"),
        ((1.1, 1.4, 1.0), "from-interior"), ((1.0, 1.0, 1.0), "neutral")]


def scene(control: tuple[float, ...] = (0.5, 0.8, 1.0), **changes: Any) -> dict[str, Any]:
    made: dict[str, Any] = {
        "name": "test", "kind": "deceleration", "solve": {"duration": 10.0, "samples": 11, "tolerance": 1e-3},
        "body": {"inertia": [35.0, 22.0, 16.0]},
        "torque": {"control": [1e-3 * b for b in control], "drag": 1e-4},
        "initial": {"angular_momentum": [40.0, 25.0, 16.5]},
    }
    for key, value in changes.items():
        table, name = key.split("__")
        made[table][name] = value
    return made


@pytest.mark.parametrize(("control", "region"), ROWS)
def test_the_region_of_each_row(control: tuple[float, ...], region: str) -> None:
    report = stability_report(scene(control))
    assert report["regimes"]["A"]["region"] == region
    assert report["torque_ratios"] == pytest.approx(control[:2])
    star = report["regimes"]["A"]["quasi_stationary"]
    assert (star is None) == ("interior" not in region)
    if star is not None:
        assert quasi_stationary_line("A", star, np.array([control[1]]))[0] == pytest.approx(control[0])


def test_regime_c_is_regime_a_with_the_outer_torques_exchanged() -> None:
    for control, _ in ROWS:
        here, there = stability_report(scene(control)), stability_report(scene(control[::-1]))
        assert here["regimes"]["C"] == there["regimes"]["A"]
        star = here["regimes"]["C"]["quasi_stationary"]
        if star is not None:
            line = quasi_stationary_line("C", star, np.array([control[1] / control[2]]))
            assert line[0] == pytest.approx(control[0] / control[2])


@pytest.mark.parametrize("control", [(0.5, 0.8, 1.0), (1.0, 0.8, 0.5), (0.9, 0.6, 1.0), (1.0, 0.6, 0.9), (1.3, 1.2, 1.0)])
def test_the_averaged_motion_goes_where_the_report_says(control: tuple[float, ...]) -> None:
    given = scene(control, solve__duration=3e5, solve__samples=301, solve__model="averaged")
    given["torque"]["drag"] = 0.0
    report = stability_report(given)
    answer = gyrostat.solve(given)
    moving = answer.t < answer.scalars["stop_time"]
    # One coordinate through both regimes: from -1 on axis 1 by 0 on the separatrix to 1 on axis 3.
    sign = np.where(answer["regime"] == "A", -1.0, 1.0)
    place = (sign * (1.0 - answer["modulus_squared"]))[moving]
    start, end = report["start"], report["start"]["tends_to"]
    assert place[0] == pytest.approx((1.0 - start["modulus_squared"]) * (-1.0 if start["regime"] == "A" else 1.0), abs=1e-6)
    aim = (1.0 - end["modulus_squared"]) * (-1.0 if end["regime"] == "A" else 1.0)
    assert np.all(np.diff(np.abs(place - aim)) < 1e-9)
    assert abs(place[-1] - aim) < 0.9 * abs(place[0] - aim)


def test_the_body_axes_do_not_matter() -> None:
    report = stability_report(scene())
    turned = stability_report(scene((0.8, 1.0, 0.5), body__inertia=[22.0, 16.0, 35.0],
                                    initial__angular_momentum=[25.0, 16.5, 40.0]))
    assert turned == report
    tensor = stability_report(scene(body__inertia=[[35.0, 0.0, 0.0], [0.0, 22.0, 0.0], [0.0, 0.0, 16.0]]))
    assert tensor == report


def test_torques_about_other_than_principal_axes_act_through_their_diagonal() -> None:
    c, s = np.cos(0.4), np.sin(0.4)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    inertia = turn @ np.diag([35.0, 22.0, 16.0]) @ turn.T
    report = stability_report(scene((0.5, 0.8, 1.0), body__inertia=inertia.tolist(),
                                    initial__angular_momentum=(turn @ [40.0, 25.0, 16.5]).tolist()))
    wanted = np.diag(turn.T @ np.diag([0.5e-3, 0.8e-3, 1e-3]) @ turn)
    assert report["control"] == pytest.approx(wanted.tolist())
    assert report["start"]["modulus_squared"] == pytest.approx(stability_report(scene())["start"]["modulus_squared"])


def test_the_sticking_separatrix_is_named() -> None:
    report = stability_report(scene((1.0, 0.2, 1.0)))
    assert report["start"]["tends_to"] == {"regime": "separatrix", "modulus_squared": 1.0}


@pytest.mark.parametrize(("changes", "words"), [
    ({"body__rotor_momentum": [0.0, 1.0, 0.0]}, "without rotor momentum"),
    ({"body__inertia": [22.0, 22.0, 16.0]}, "two moments are equal"),
    ({"initial__angular_momentum": [0.0, 0.0, 0.0]}, "at rest"),
])
def test_what_has_no_table_is_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(gyrostat.DomainError, match=words):
        stability_report(scene(**changes))


def test_printed_as_a_table_and_as_json(capsys: pytest.CaptureFixture[str], scene_file: Path) -> None:
    assert main(["stability", str(scene_file)]) == 0
    text = capsys.readouterr().out
    assert "regime" in text and "The start has" in text
    assert main(["stability", str(scene_file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["regimes"]["A"]["region"] == "to-axis"


@pytest.mark.parametrize(("control", "region"), [*ROWS, ((0.5, 0.8, 0.0), "to-separatrix")])
def test_the_figure_draws_in_every_region(control: tuple[float, ...], region: str, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    report = stability_report(scene(control))
    assert report["regimes"]["A"]["region"] == region
    figure = plot_stability(scene(control), report)
    assert [axes.get_xlabel() for axes in figure.axes] == ["κ₁ = b₁/b₃ [1]", "κ₁ = b₁/b₃ [1]", "k² [1]"]
    if region == "to-axis":
        file = tmp_path / "regions.png"
        assert report_stability(scene_from(scene(control)), plot=file) == 0
        assert file.read_bytes().startswith(b"\x89PNG")
