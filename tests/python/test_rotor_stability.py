# SPDX-License-Identifier: BSD-3-Clause
"""Steady rotations of a gyrostat with a driven rotor over arrays; the stability report of a scene: table, verdict, figure."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gyrostat
from gyrostat import DomainError, rotor
from gyrostat.cli import main
from gyrostat.families.general.instance import as_instance
from gyrostat.families.general.rewrite import as_general
from gyrostat.families.rotor import stability as family
from gyrostat.families.rotor.sphere import Sphere, from_disc, onto_disc
from gyrostat.scenes import load, scene_from
from gyrostat.stability import plot_stability, report_stability, stability_report

AXIS = [0.75052555189406, 0.35024525755056, 0.56039241208090]


def scene(**changes: Any) -> dict[str, Any]:
    made: dict[str, Any] = {
        "name": "test", "kind": "rotor", "solve": {"duration": 40.0, "samples": 41, "tolerance": 1e-6},
        "body": {"inertia": [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]]},
        "rotor": {"axis": AXIS, "axial_inertia": 0.35}, "motor": {"slope": 0.2, "no_load_rate": 3.0},
        "initial": {"angular_velocity": [1.7607, -1.1869, -0.5230], "rotor_rate": 0.0},
    }
    for key, value in changes.items():
        table, name = key.split("__")
        made[table][name] = value
    return made


def bodies(count: int, seed: int = 1) -> dict[str, Any]:
    """Random gyrostats: carriers and thin rotors."""
    random = np.random.default_rng(seed)
    points = random.normal(size=(count, 3, 3))
    spread = np.einsum("nij,nkj->nik", points, points)
    carrier = np.trace(spread, axis1=1, axis2=2)[:, None, None] * np.eye(3) - spread
    axis = random.normal(size=(count, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    axial = random.uniform(0.05, 2.0, count)
    along = np.einsum("ni,nj->nij", axis, axis)
    inertia = carrier + axial[:, None, None] * (along + 0.5 * (np.eye(3) - along))
    return {"inertia": inertia, "axis": axis, "axial_inertia": axial, "slope": random.uniform(0.01, 3.0, count),
            "no_load_rate": random.normal(size=count) * 3, "momentum": random.uniform(0.5, 10.0, count)}


def test_an_axis_of_single_precision_is_named() -> None:
    with pytest.raises(DomainError, match="row 1: axis has the length 1.00000002"):
        rotor.steady_rotations(inertia=[3.0, 4.1, 5.2], axis=np.array([[0, 0, 1], [0.6, 0, 0.8]], dtype=np.float32), axial_inertia=0.8, slope=0.4,
                               no_load_rate=1.3, momentum=8.0)


def test_every_row_solves_the_equation_of_steady_rotations() -> None:
    given = bodies(200)
    made = rotor.steady_rotations(**given)
    assert set(made.count.tolist()) <= {2, 4, 6}
    for row in range(200):
        n = int(made.count[row])
        m, spin = made.direction[row, :n], made.spin_rate[row, :n]
        h = given["axial_inertia"][row] * given["no_load_rate"][row]
        left = spin[:, None] * (m @ given["inertia"][row])
        right = given["momentum"][row] * m - h * given["axis"][row]
        assert np.max(np.abs(left - right)) < 1e-10 * (given["momentum"][row] + abs(h))
        types = list(made.type[row, :n])
        assert types.count("min") - types.count("saddle") + types.count("max") == 2
        assert np.all(np.diff(made.level[row, :n]) >= 0)
        assert np.all(np.isnan(made.level[row, n:])) and set(made.type[row, n:]) <= {""}
        for i in range(n):
            cubic, values = made.cubic[row, i], made.eigenvalues[row, i]
            assert np.max(np.abs(np.polyval(cubic, values))) < 1e-9 * np.max(np.abs(cubic)) * (1 + np.max(np.abs(values)) ** 3)
            assert (made.verdict[row, i] == "asymptotically stable") == (types[i] == "min")
            assert made.decay_rate[row, i] == pytest.approx(-np.max(values.real), rel=1e-12, abs=0)


def test_leading_axes_broadcast() -> None:
    given = bodies(6)
    grid = rotor.steady_rotations(**{**given, "inertia": given["inertia"].reshape(2, 3, 3, 3), "axis": given["axis"].reshape(2, 3, 3),
                                     **{key: given[key].reshape(2, 3) for key in ("axial_inertia", "no_load_rate", "momentum")},
                                     "slope": 0.3})
    assert grid.count.shape == (2, 3) and grid.direction.shape == (2, 3, 8, 3) and grid.eigenvalues.shape == (2, 3, 8, 3)
    one = rotor.steady_rotations(**{key: value[4] for key, value in given.items() if key != "slope"}, slope=0.3)
    np.testing.assert_array_equal(grid.direction[1, 1], one.direction)
    assert one.count.shape == () and list(one.type) == list(grid.type[1, 1])
    swept = rotor.steady_rotations(**{key: value[0] for key, value in given.items() if key != "slope"}, slope=np.geomspace(0.01, 1, 5))
    assert swept.decay_rate.shape == (5, 8)
    moments = rotor.steady_rotations(inertia=[3.0, 4.0, 5.0], axis=AXIS, axial_inertia=0.3, slope=0.1, no_load_rate=1.0, momentum=2.0)
    tensor = rotor.steady_rotations(inertia=np.diag([3.0, 4.0, 5.0]), axis=AXIS, axial_inertia=0.3, slope=0.1, no_load_rate=1.0, momentum=2.0)
    np.testing.assert_array_equal(moments.level, tensor.level)


def test_what_is_not_physical_is_named() -> None:
    given = bodies(3)
    bad = given["axial_inertia"].copy()
    bad[1] = 1e3
    with pytest.raises(gyrostat.DomainError, match="row 1"):
        rotor.steady_rotations(**{**given, "axial_inertia": bad})
    with pytest.raises(gyrostat.DomainError, match="momentum, row 2"):
        rotor.steady_rotations(**{**given, "momentum": [1.0, 0.0, -1.0]})
    with pytest.raises(gyrostat.DomainError, match="broadcast"):
        rotor.steady_rotations(**{**given, "slope": [1.0, 2.0]})
    at_rest = rotor.steady_rotations(**{**given, "momentum": 0.0})
    assert at_rest.count.tolist() == [0, 0, 0] and set(at_rest.family) == {"at-rest"}


def test_the_motion_ends_where_the_report_says() -> None:
    for rates in ([1.7607, -1.1869, -0.5230], [2.1, 0.4, -0.9], [-1.0, 1.5, 0.7]):
        given = scene(initial__angular_velocity=rates, solve__duration=600.0)
        report = stability_report(given)
        verdict = report["attractor"]
        assert verdict["index"] is not None
        answer = gyrostat.solve(given)
        m = answer["angular_momentum"] / report["momentum"]
        end = np.array(report["steady_rotations"][verdict["index"]]["direction"])
        assert np.linalg.norm(m[-1] - end) < 1e-4
        assert verdict["settling"] == "followed"
        fine = gyrostat.solve(given, duration=verdict["settling_time"] + 100.0, samples=4001)
        off = np.arccos(np.clip(fine["angular_momentum"] @ end / report["momentum"], -1, 1))
        late = fine.t > verdict["settling_time"] + 1e-9
        assert np.all(off[late] < family.SETTLED * (1 + 1e-6))
        if verdict["settling_time"] > 0:
            assert off[~late].max() > family.SETTLED
        saddle = min(r["level"] for r in report["steady_rotations"] if r["type"] == "saddle")
        if verdict["time"] > 0:
            caught = gyrostat.solve(given, duration=verdict["time"], samples=2)
            assert caught["lyapunov"][-1] < saddle


@pytest.mark.parametrize("changes", [
    {"body__inertia": [86.0, 118.0, 141.0], "initial__angular_velocity": [0.0, 0.01, 0.1], "motor__slope": 2e-5, "motor__no_load_rate": 50.26548245743669,
     "rotor__axis": [0.997956956338743, 0.0498993477973318, 0.0398994784992693], "rotor__axial_inertia": 0.28},
    {"body__inertia": [0.63021861, 0.88441121, 0.82263986], "initial__angular_velocity": [1.37617854, 0.51633818, -1.29647439], "motor__slope": 0.06237923617998079,
     "initial__rotor_rate": -4.224938815645678, "motor__no_load_rate": -4.342475588348988, "rotor__axis": [-0.8742404216, -0.10677229164, 0.47360677146],
     "rotor__axial_inertia": 0.22835899023173065},
])
def test_no_swing_is_outside_after_the_settling_time(changes: dict[str, Any]) -> None:
    axis = np.array(changes["rotor__axis"])
    given = scene(**{**changes, "rotor__axis": (axis / np.linalg.norm(axis)).tolist()})
    report = stability_report(given)
    at, m = report["attractor"]["settling_time"], np.array(report["steady_rotations"][report["attractor"]["index"]]["direction"])
    answer = gyrostat.solve(given, duration=1.3 * at, samples=60001)  # thirty times a swing
    angle = np.arccos(np.clip(answer["angular_momentum"] @ m / report["momentum"], -1, 1))
    last = float(answer.t[np.flatnonzero(angle > family.SETTLED)[-1]])
    assert last <= at and at == pytest.approx(last, rel=1e-3)


def test_a_general_scene_that_is_exactly_that_of_a_family_is_judged_as_one() -> None:
    for name in ("intelsat-v-flat-spin", "tiangong-1", "envisat-eddy-decay", "lab-gyroscope", "t-handle", "cubesat-pyramid"):
        own = stability_report(load(name))
        assert stability_report(as_general(load(name))) == own
    assert stability_report(load("wheel-seized"))["kind"] == "free"
    assert plot_stability(as_general(load("toy-top"))) is not None
    with pytest.raises(gyrostat.DomainError, match="momentum-dump: a stability table is known .*: a torque changes with time"):
        stability_report(load("momentum-dump"))


MOTOR: dict[str, Any] = {"type": "motor", "axis": [0, 3, 4], "axial_inertia": 0.1, "slope": 0.01, "no_load_rate": 50.0, "rate": 1.0}
BRAKE: dict[str, Any] = {"type": "brake", "limit": [0.1, 0.1, 0.2]}


@pytest.mark.parametrize(("tables", "kind"), [
    ({"wheel": [MOTOR]}, "rotor"), ({"wheel": [MOTOR, {"type": "locked", "axis": [1, 0, 0], "axial_inertia": 0.1}]}, "rotor"), ({"torque": [BRAKE]}, "deceleration"),
    ({"wheel": [MOTOR], "body": {"rotor_momentum": [0, 0.6, 0.8]}}, None), ({"wheel": [{**MOTOR, "friction": 0.01}]}, None),
    ({"torque": [{"type": "charge", "momentum": [0, 0, 1.0]}]}, None), ({"torque": [{**BRAKE, "factor": {"mean": 5.0, "amplitude": 0.0, "rate": 1.0}}]}, None),
    ({"torque": [{**BRAKE, "on": [[10, 100]]}]}, None),
    ({"torque": [{"type": "weight"}], "body": {"fixed": True, "mass": 1.0, "centre_of_mass": [0, 0, 0.1]}, "field": {"gravity": 9.8, "down": [0, 0.6, 0.8]}}, "heavy"),
    ({"torque": [{"type": "weight"}] * 2, "body": {"fixed": True, "mass": 1.0, "centre_of_mass": [0, 0, 0.1]}, "field": {"gravity": 9.8}}, None)])
def test_of_a_general_scene_all_or_nothing_is_judged(tables: dict[str, Any], kind: str | None) -> None:
    given = {"name": "told otherwise", "solve": {"times": [1.0, 3.0]}, "initial": {"angular_velocity": [0.3, 0.2, -0.4]}, **tables,
             "body": {"inertia": [3.0, 2.5, 2.0], **tables.get("body", {})}}
    if kind is None:
        with pytest.raises(gyrostat.DomainError, match="not in the words of that kind"):
            stability_report(given)
        return
    instance = as_instance(scene_from(given), ("free", "deceleration", "rotor", "heavy"))
    assert instance is not None and instance.kind == kind == stability_report(given)["kind"]
    whole, alone = gyrostat.solve(given, model="full", ask=["angular_velocity"]), gyrostat.solve(instance, model="full", ask=["angular_velocity"])
    assert np.allclose(whole["angular_velocity"], alone["angular_velocity"], rtol=0, atol=1e-6)


def test_flat_spin_of_a_real_satellite() -> None:
    report = stability_report(load("intelsat-v-flat-spin"))
    assert report["start"]["flat_spin"]
    assert report["attractor"]["flat_spin"] == "recovers"
    assert report["attractor"]["certificate"] == "by uniqueness" and report["attractor"]["time"] == 0
    assert math.degrees(report["start"]["rotor_axis_angle"]) > 85
    assert 3600 < report["attractor"]["settling_time"] < 43200
    assert report["steady_rotations"][0]["e_fold_time"] > 100 * 31557600  # answered by algebra
    assert "Recovers from flat spin" in family.sentence(report)


def test_the_wheel_may_end_against_l_or_not_recover() -> None:
    # a flat spin about axis 3, the wheel on axis 1, l greater than h: both +e and -e may attract
    calm = scene(body__inertia=[3.0, 4.5, 5.0], rotor__axis=[0.9995, 0.0223583, 0.0223583], rotor__axial_inertia=0.05,
                 motor__no_load_rate=10.0, motor__slope=0.05, initial__angular_velocity=[0.0, 0.02, 1.0])
    axis = np.array(calm["rotor"]["axis"])
    calm["rotor"]["axis"] = (axis / np.linalg.norm(axis)).tolist()
    report = stability_report(calm)
    assert report["start"]["flat_spin"]
    assert report["attractor"]["flat_spin"] == "stays"
    assert "Does not recover" in family.sentence(report)


def test_undecided_with_the_margin(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(family, "MOST_TURNS", 30.0)
    given = scene(motor__slope=2e-5, initial__rotor_rate=3.0)
    report = stability_report(given)
    verdict = report["attractor"]
    assert verdict["index"] is None and verdict["certificate"] == "undecided"
    saddle = min(r["level"] for r in report["steady_rotations"] if r["type"] == "saddle")
    assert verdict["margin"] == pytest.approx(report["start"]["lyapunov"] - saddle)
    assert f"{verdict['margin']:.4g} J above the lowest saddle" in family.sentence(report)


def weakly_coupled(axial_inertia: float, rates: list[float]) -> dict[str, Any]:
    """A small wheel at its no-load rate, with the momentum of the large one."""
    return scene(rotor__axial_inertia=axial_inertia, motor__slope=0.5 * axial_inertia, motor__no_load_rate=1.05 / axial_inertia,
                 initial__rotor_rate=1.05 / axial_inertia, initial__angular_velocity=rates)


def test_the_mean_over_the_nutation_foretells_what_following_finds(monkeypatch: pytest.MonkeyPatch) -> None:
    undecided, settling = weakly_coupled(0.002, [1.7607, -1.1869, -0.5230]), weakly_coupled(0.01, [-1.0, 1.5, 0.7])
    caught, settled = (stability_report(given)["attractor"] for given in (undecided, settling))
    assert caught["index"] is not None and settled["settling"] == "followed"
    monkeypatch.setattr(family, "MOST_TURNS", 200.0)
    early, mean = (stability_report(given)["attractor"] for given in (undecided, settling))
    assert early["index"] is None
    assert early["expected_time"] == pytest.approx(caught["time"], rel=0.02)
    assert mean["settling"] == "averaged"
    assert mean["settling_time"] == pytest.approx(settled["settling_time"], rel=0.03)
    assert "expected" not in family.sentence(stability_report(settling)) and "about" in family.sentence(stability_report(undecided))


def test_exceptional_bodies() -> None:
    principal = stability_report(scene(body__inertia=[3.2, 4.1, 5.0], rotor__axis=[0.0, 0.0, 1.0]))
    assert principal["family"] == "principal-axis"
    marginal = [r for r in principal["steady_rotations"] if r["verdict"] == "marginal"]
    assert marginal and all(r["decay_rate"] is None and abs(r["direction"][2]) == pytest.approx(1) for r in marginal)
    assert "not exponentially" in family.sentence(principal)

    symmetric = stability_report(scene(body__inertia=[3.2, 3.2, 5.0], rotor__axis=[0.0, 0.0, 1.0]))
    assert symmetric["family"] == "axisymmetric" and symmetric["attractor"]["certificate"] == "none"
    assert "no attractor" in family.sentence(symmetric)

    j = 1 / np.array([3.0, 4.0, 5.5])
    e = np.array([3.0 * math.sqrt(j[0] - j[1]), 0.0, 5.5 * math.sqrt(j[1] - j[2])])
    section = stability_report(scene(body__inertia=[3.0, 4.0, 5.5], rotor__axis=(e / np.linalg.norm(e)).tolist(), motor__no_load_rate=30.0))
    assert section["family"] == "circular-section" and section["circular_section"]["tumbles"]
    assert "round for ever" in family.sentence(section)

    free = stability_report(scene(motor__slope=0.0))
    assert {r["verdict"] for r in free["steady_rotations"]} == {"conservative"}
    assert "no slope" in family.sentence(free)

    circle = stability_report(scene(body__inertia=[4.1, 4.1, 5.0], rotor__axis=[1.0, 0.0, 0.0], motor__no_load_rate=0.0))
    assert circle["continuum"] == "circle"
    assert any(not r["isolated"] for r in circle["steady_rotations"])

    still = stability_report(scene(initial__angular_velocity=[0.0, 0.0, 0.0]))
    assert still["family"] == "at-rest" and still["steady_rotations"] == [] and still["start"]["direction"] is None
    json.dumps([principal, symmetric, section, free, circle, still], allow_nan=False)


def test_the_body_axes_do_not_matter() -> None:
    turn = gyrostat.rotation.matrix_from_vector([0.3, -1.1, 0.7])
    given = scene()
    turned = scene(body__inertia=(turn @ given["body"]["inertia"] @ turn.T).tolist(), rotor__axis=(turn @ AXIS).tolist(),
                   initial__angular_velocity=(turn @ given["initial"]["angular_velocity"]).tolist())
    here, there = stability_report(given), stability_report(turned)
    assert there["attractor"]["index"] == here["attractor"]["index"]
    for a, b in zip(here["steady_rotations"], there["steady_rotations"], strict=True):
        assert b["level"] == pytest.approx(a["level"], rel=1e-10)
        assert b["decay_rate"] == pytest.approx(a["decay_rate"], rel=1e-8)
        np.testing.assert_allclose(b["direction"], turn @ a["direction"], atol=1e-10)


def test_printed_as_tables_and_as_json(capsys: pytest.CaptureFixture[str], rotor_file: Path) -> None:
    assert main(["stability", str(rotor_file)]) == 0
    text = capsys.readouterr().out
    assert "steady rotations" in text and "eigenvalues" in text and "ttractor" in text
    assert main(["stability", str(rotor_file), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["kind"] == "rotor"
    assert {"direction", "spin_rate", "type", "eigenvalues"} <= set(report["steady_rotations"][0])


def test_the_map_of_the_sphere_is_equal_in_area_and_can_be_undone() -> None:
    sphere = Sphere(np.diag([1.0, 2.0, 3.0]), np.array(AXIS), 1.0, 0.3)
    views = sphere.views()
    random = np.random.default_rng(2)
    m = random.normal(size=(4000, 3))
    m /= np.linalg.norm(m, axis=1, keepdims=True)
    front = [onto_disc(view, m)[2] for view in views]
    assert np.all(front[0] ^ front[1])
    for view, seen in zip(views, front, strict=True):
        assert np.linalg.det(view) == pytest.approx(1)
        x, y, _ = onto_disc(view, m[seen])
        assert np.all(np.hypot(x, y) <= 1 + 1e-12)
        np.testing.assert_allclose(from_disc(view, x, y), m[seen], atol=1e-12)
        assert np.mean(np.hypot(x, y) < math.sqrt(0.5)) == pytest.approx(0.5, abs=0.05)


@pytest.mark.parametrize("changes", [
    {}, {"solve__duration": 1e5}, {"motor__slope": 0.0},
    {"body__inertia": [4.1, 4.1, 4.1], "motor__no_load_rate": 0.0},
    {"body__inertia": [4.1, 4.1, 5.0], "rotor__axis": [0.0, 0.0, 1.0]},
])
def test_the_figure_draws(changes: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    checked = scene_from(scene(**changes))
    figure = plot_stability(checked)
    titles = [axes.get_title() for axes in figure.axes]
    assert {"front: around the rotor axis e", "back: around −e"} <= set(titles)
    assert {"path of the momentum", "start"} <= {text.get_text() for legend in figure.legends for text in legend.get_texts()}
    if not changes:
        file = tmp_path / "sphere.png"
        assert report_stability(checked, plot=file) == 0
        assert file.read_bytes().startswith(b"\x89PNG")


def test_at_rest_there_is_no_sphere() -> None:
    pytest.importorskip("matplotlib")
    with pytest.raises(gyrostat.DomainError, match="the momentum is zero"):
        plot_stability(scene(initial__angular_velocity=[0.0, 0.0, 0.0]))
