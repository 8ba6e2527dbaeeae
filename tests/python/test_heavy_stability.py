# SPDX-License-Identifier: BSD-3-Clause
"""The stability of heavy bodies: rest, top, periodic motion and its family."""

import functools
import json
import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import HEAVY, PERIODIC, at_length
from gyrostat import DomainError, heavy, rotation
from gyrostat.cli import main
from gyrostat.families.heavy import stability as words
from gyrostat.scenes import load, scene_from
from gyrostat.stability import plot_stability, stability_report

ORBIT = tomllib.loads(PERIODIC)
BODY: dict[str, Any] = {"inertia": [0.0011, 0.0016, 0.0020], "mass": 0.8, "centre_of_mass": [0.012, 0.009, 0.010], "gravity": 9.80665,
                        "gravity_gradient": 4.6e-6}


@pytest.fixture(scope="module")
def report() -> dict[str, Any]:
    return stability_report(ORBIT)


def test_what_is_told_is_what_the_functions_find(report: dict[str, Any]) -> None:
    assert report["kind"] == "heavy" and json.loads(json.dumps(report)) == report
    c = math.sqrt(0.8 * 9.80665 * math.hypot(0.012, 0.009, 0.010) / 0.002)
    assert report["pendulum_rate"] == pytest.approx(c) == report["slow_rate"]
    assert report["rest"]["frequency"] == heavy.hanging(**BODY).frequency.tolist() and report["top"] is None
    orbit = heavy.periodic_orbit(**BODY, spin=150.0, cos_inclination=0.1)
    assert report["periodic"]["period"] == orbit.period and report["periodic"]["verdict"] == "stable"
    a, b = (complex(*m) for m in report["periodic"]["multipliers"])
    assert a * b == pytest.approx(1) and (a + b).real == pytest.approx(report["periodic"]["trace"])
    assert report["periodic"]["fast"]["verdict"] == "stable"


def test_the_family_goes_down_to_slow_spins_and_its_verdicts_are_those_of_its_traces(report: dict[str, Any]) -> None:
    family = report["family"]
    spin, trace = np.array(family["spin"]), np.array(family["trace"])
    assert spin[0] == pytest.approx(150.0) and spin[-1] < 0.7 * report["slow_rate"] and family["end"] == "homoclinic"
    assert all((v == "stable") == (abs(t) < 2) for v, t in zip(family["verdict"], trace, strict=True) if v != "undecided")
    assert {"stable", "unstable"} <= set(family["verdict"]) and family["folds"]
    one = len(spin) // 3
    again = heavy.periodic_orbit(**BODY, spin=spin[one], cos_inclination=0.1)
    assert again.period == pytest.approx(family["period"][one], rel=1e-9) and again.trace == pytest.approx(trace[one], abs=1e-6)
    titles = [title for title, _, _ in words.tables(report)]
    assert any("from fast spins down" in title for title in titles)
    assert "after" in words.sentence(report) and "fold" in words.sentence(report)


@pytest.fixture(scope="module")
def level() -> dict[str, Any]:
    """By day with half of its members."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(heavy, "periodic_family", functools.partial(heavy.periodic_family, most_members=at_length(200, 400)))
        return stability_report(load("lab-gyroscope"))


def test_a_level_top_has_no_fast_precession(level: dict[str, Any]) -> None:
    assert any(["fast", "none: the axis is level"] in rows for _, _, rows in words.tables(level))
    assert level["top"]["precession"]["cos_inclination"] == 0 and level["top"]["precession"]["fast"] is None
    # slow precession of a level top: M g l over the spin's momentum
    assert level["top"]["precession"]["slow"] == pytest.approx(-2.67 * 9.80665 * 0.011239700374531819 / (0.0134946 * 33.51032163829112))


def test_members_at_the_bound_of_stability_are_no_rows_of_their_own(level: dict[str, Any]) -> None:
    family = {"spin": [9.0, 5.0, 4.9999, 4.9998, 3.0, 2.9999, 1.0, 0.9, 0.5], "folds": [5],
              "verdict": ["stable", "stable", "undecided", "undecided", "stable", "stable", "undecided", "unstable", "undecided"]}
    assert words._stretches(family) == [(0, 5, "stable"), (6, 8, "unstable")]
    alone = {"spin": [9.0, 1.0], "folds": [], "verdict": ["undecided", "undecided"]}
    assert words._stretches(alone) == [(0, 1, "undecided")]
    (*_, (_, _, rows)) = words.tables(level)
    assert [row[0] for row in rows] == ["stable"]


@pytest.mark.usefixtures("few_members")
def test_a_top(capsys: pytest.CaptureFixture[str]) -> None:
    report = stability_report(scene_from(tomllib.loads(HEAVY), inertia=[0.002, 0.002, 0.001], centre_of_mass=[0, 0, 0.02], mass=0.5,
                                         angular_velocity=[0, 0, 100], down=[0.6, 0, -0.8], gravity_gradient=0.0))
    threshold = math.sqrt(4 * 0.002 * 0.5 * 9.80665 * 0.02) / 0.001
    assert report["top"]["up"]["threshold"] == pytest.approx(threshold) and report["top"]["up"]["verdict"] == "stable"
    assert report["top"]["down"]["threshold"] == 0
    slow = report["top"]["precession"]["slow"]
    assert 0.002 * -0.8 * slow**2 - 0.001 * 100 * slow - 0.5 * 9.80665 * 0.02 == pytest.approx(0, abs=1e-12)
    # a regular precession is periodic: about axis 3 with the rest of the spin
    assert report["periodic"]["period"] == pytest.approx(2 * math.pi / (100 + 0.8 * slow), rel=1e-9)
    assert main(["stability", "toy-top"]) == 0
    out = capsys.readouterr().out
    assert "Regular precession" in out and "least stable spin" in out and "66.8" in out


@pytest.mark.usefixtures("few_members")
@pytest.mark.parametrize(("spin", "tilt"), [(157.0, 160.0), (157.0, 90.0), (40.0, 120.0), (70.0, 179.0), (5.0, 30.0)])
def test_the_nutation_of_a_top_is_that_of_its_motion(spin: float, tilt: float) -> None:
    """From a start without transverse rate the axis is back at its extreme after one nutation, and goes to the other after half of it."""
    body: dict[str, Any] = {"inertia": [3e-4, 3e-4, 1.5e-4], "mass": 0.2, "centre_of_mass": [0, 0, 0.03], "gravity": 9.81}
    down = [math.sin(math.radians(tilt)), 0.0, math.cos(math.radians(tilt))]
    scene = scene_from({"name": "top", "kind": "heavy", "body": {k: v for k, v in body.items() if k != "gravity"}, "field": {"gravity": 9.81},
                        "initial": {"angular_velocity": [0, 0, spin], "down": down}, "solve": {"times": [1.0]}})
    told = stability_report(scene)["top"]["nutation"]
    times = told["period"] * np.array([0.0, 0.5, 1.0])
    motion = heavy.integrate(**body, angular_velocity=[0, 0, spin], down=down, attitude=None, times=times, tolerance=1e-13)
    assert sorted(motion["down"][:2, 2]) == pytest.approx([told["least"], told["greatest"]], abs=1e-10)
    assert motion["down"][2, 2] == pytest.approx(motion["down"][0, 2], abs=1e-10)
    exact = heavy.exact(**body, angular_velocity=[0, 0, spin], down=down, t=[0.0])
    assert exact.nutation.tolist() == [told["least"], told["greatest"]] and exact.precession_rate == told["precession_rate"]


def test_only_a_top_that_leans_nods(capsys: pytest.CaptureFixture[str]) -> None:
    assert np.isnan(heavy.exact(**{**BODY, "gravity": 0.0}, angular_velocity=[1, 2, 3], down=[0, 0, 1], t=[0.0]).nutation).all()
    top = {"name": "top", "kind": "heavy", "body": {"inertia": [3e-4, 3e-4, 1.5e-4], "mass": 0.2, "centre_of_mass": [0, 0, 0.03]},
           "field": {"gravity": 9.81}, "initial": {"angular_velocity": [0, 0, 157.0], "down": [0, 0, -1]}, "solve": {"times": [1.0]}}
    assert stability_report(scene_from(top))["top"]["nutation"]["precession_rate"] is None  # it sleeps


def test_a_tongue(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    assert main(["stability", "half-rate-tongue", "--json", "--plot", str(tmp_path / "family.png")]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["periodic"]["verdict"] == "unstable" and report["periodic"]["trace"] < -2
    assert report["periodic"]["fast"]["exponent"] == 0.5
    assert (tmp_path / "family.png").stat().st_size > 5000


@pytest.mark.usefixtures("few_members")
@pytest.mark.parametrize("change", [{"angular_velocity": [0, 0, 0]}, {"down": [0, 0, 1]}, {"attitude": [0, 0, 0, 1]}, {"angular_velocity": [0, 0, 0.5]},
                                    {"gravity": 0.0, "gravity_gradient": 0.0}, {"centre_of_mass": [0, 0, 0], "gravity_gradient": 50.0},
                                    {"inertia": [0.002, 0.002, 0.002], "centre_of_mass": [0, 0, 0], "gravity_gradient": 0.0}])
def test_hard_starts_have_a_report(change: dict[str, Any]) -> None:
    report = stability_report(scene_from(tomllib.loads(HEAVY), **change))
    assert json.loads(json.dumps(report, allow_nan=False)) == report
    assert words.sentence(report)
    for _, heads, rows in words.tables(report):
        assert all(len(row) == len(heads) for row in rows)


@pytest.mark.usefixtures("few_members")
def test_a_body_in_axes_of_its_own(report: dict[str, Any]) -> None:
    R = rotation.matrix_from_quaternion([0.1, -0.05, 0.08, 0.99] / np.linalg.norm([0.1, -0.05, 0.08, 0.99]))
    inertia = R @ np.diag(BODY["inertia"]) @ R.T
    turned = stability_report(scene_from(tomllib.loads(PERIODIC), inertia=((inertia + inertia.T) / 2).tolist(),
                                         centre_of_mass=(R @ BODY["centre_of_mass"]).tolist()))
    assert turned["rest"]["frequency"] == pytest.approx(report["rest"]["frequency"], rel=1e-12)
    assert turned["rest"]["down"] == pytest.approx(R @ report["rest"]["down"], abs=1e-12)
    assert np.abs(turned["rest"]["swing"]) == pytest.approx(np.abs(report["rest"]["swing"] @ R.T), abs=1e-11)
    for name in ("angular_velocity", "down"):
        assert turned["periodic"][name] == pytest.approx(R @ report["periodic"][name], abs=1e-9)
    for name in ("period", "trace"):
        assert turned["periodic"][name] == pytest.approx(report["periodic"][name], rel=1e-9)
    last = at_length(len(turned["family"]["spin"]), 0) - 1
    assert turned["family"]["spin"][last] == pytest.approx(report["family"]["spin"][last], rel=1e-3)


@pytest.mark.usefixtures("few_members")
def test_what_cannot_be_told() -> None:
    pytest.importorskip("matplotlib")
    diagonal = scene_from(tomllib.loads(HEAVY), inertia=[[1.1e-3, 0, 0], [0, 1.6e-3, 0], [0, 0, 2e-3]])
    assert stability_report(diagonal)["rest"]["frequency"] == heavy.hanging(**BODY).frequency.tolist()
    with pytest.raises(DomainError, match="no family"):
        plot_stability(scene_from(tomllib.loads(HEAVY), down=[0, 0, 1]))


def test_how_far_from_hanging_the_start_is() -> None:
    heavy_scene = tomllib.loads(HEAVY)
    made = stability_report(heavy_scene)
    down = np.asarray(made["rest"]["down"])
    start = -rotation.matrix_from_quaternion(heavy_scene["initial"]["attitude"])[2] if "attitude" in heavy_scene["initial"] else np.asarray(heavy_scene["initial"]["down"])
    assert made["rest"]["start_angle"] == pytest.approx(math.acos(float(start @ down / np.linalg.norm(start))), rel=1e-9)
    told = words.sentence(made)
    assert ("degrees from hanging" in told) == (made["rest"]["start_angle"] > math.pi / 2)
    assert stability_report(ORBIT)["rest"]["start_angle"] is None
