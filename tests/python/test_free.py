# SPDX-License-Identifier: BSD-3-Clause
"""Free bodies with wheels: scenes, functions, figures."""

import math
import tomllib
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import drawn
from gyrostat import DomainError, SceneError, free
from gyrostat.families.free.functions import reduced
from gyrostat.families.free.stability import tables
from gyrostat.rotation import matrix_from_quaternion
from gyrostat.scenes import load, scene_from
from gyrostat.stability import plot_stability, stability_report
from gyrostat.toml_text import toml_text

SCENES = ("cubesat-pyramid", "dual-spinner", "t-handle", "toutatis", "tumbling-brick")
WHEEL = {"axis": [0.0, 0.6, 0.8], "axial_inertia": 0.2, "rate": 5.0}


def scene(**changes: Any) -> dict[str, Any]:
    return {"name": "test", "kind": "free", "solve": {"times": [0.0, 3.0, 40.0], "tolerance": 1e-9},
            "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": {"angular_velocity": [0.3, -0.5, 0.8]}, **changes}


@pytest.mark.parametrize("name", SCENES)
def test_bundled_scenes_are_met_and_drawn(name: str, tmp_path: Path) -> None:
    answer = gyrostat.solve(name)
    assert answer.met
    assert drawn(answer, tmp_path / "answer.png", name == "dual-spinner", 10_000).axes


def test_the_closed_form_and_the_full_equations_agree() -> None:
    given = scene(wheel=[{**WHEEL, "type": "held"}, {**WHEEL, "axis": [1.0, 0.0, 0.0], "rate": -9.0, "type": "free"}])
    form, full = (gyrostat.solve(scene_from(given), model=model) for model in ("closed-form", "full"))
    for name in ("attitude", "angular_velocity", "angular_momentum", "rotor_rate", "rotor_angle"):
        size = np.max(np.linalg.norm(full[name], axis=1))
        assert form[name].shape == full[name].shape
        assert np.max(np.linalg.norm(form[name] - full[name], axis=1)) <= (form.error[name] + full.error[name]) * size * 1.01
    assert form["rotor_rate"].shape == (3, 2) and np.all(form["rotor_rate"][:, 0] == 5.0)


def test_what_is_kept() -> None:
    answer = gyrostat.solve("tumbling-brick", model="closed-form")
    q, M = answer["attitude"], answer["angular_momentum"]
    u, w = q[:, :3], q[:, 3:]
    t = 2 * np.cross(u, M)
    seen = M + w * t + np.cross(u, t)
    assert np.max(np.abs(seen - answer.scalars["angular_momentum_inertial"])) < 1e-15
    energy = 0.5 * np.sum(M * answer["angular_velocity"], axis=1)
    assert energy == pytest.approx(answer.scalars["energy"], rel=1e-14)
    assert answer.scalars["period"] == pytest.approx(17.384, abs=1e-3) and answer.scalars["kind"] == "about-largest"


def test_a_year_is_as_easy_as_a_minute() -> None:
    answer = gyrostat.solve("dual-spinner", times=[31557600.0], tolerance=1e-6)
    assert answer.met and answer.model == "closed-form"
    far = gyrostat.solve("t-handle", times=[1e15])
    assert not far.met and "phase-unknown" in [warning.code for warning in far.warnings]


def test_scene_text_reads_back() -> None:
    checked = load("cubesat-pyramid")
    again = scene_from(tomllib.loads(toml_text(checked.to_dict())))
    assert again.to_dict() == checked.to_dict() and len(again.top["wheel"]) == 4
    assert checked.replace(tolerance=1e-3).top == checked.top
    answer = free.solve(**{**free.arguments(checked), "times": [1.0]})
    assert len(answer.scene["wheel"]) == 4 and gyrostat.solve(scene_from(answer.scene)).met


@pytest.mark.parametrize(("changes", "text"), [
    ({"wheel": {"axis": [0, 0, 1]}}, "not an array of tables"),
    ({"wheel": [{**WHEEL, "axis": [0.0, 0.6, 0.9]}]}, "wheel[0]: axis = [0.0, 0.6, 0.9]: the norm is"),
    ({"wheel": [WHEEL, {"axis": [0.0, 0.0, 1.0], "rate": 3.0}]}, "wheel[1]: the key axial_inertia is missing"),
    ({"wheel": [{**WHEEL, "rates": 1.0}]}, "did you mean rate?"),
    ({"wheel": [{**WHEEL, "type": "fixed"}]}, "use one of held, free"),
    ({"wheel": [{**WHEEL, "axial_inertia": -1.0}]}, "out of range"),
    ({"initial": {}}, "angular_velocity or angular_momentum"),
    ({"view": {"axis": [0.0, 0.0, 1.0]}}, "view.direction"),
])
def test_mistakes_are_named(changes: dict[str, Any], text: str) -> None:
    with pytest.raises(SceneError, match=text.replace("[", r"\[").replace("]", r"\]").replace(".", r"\.").replace("?", r"\?")):
        scene_from(scene(**changes))


def test_a_wheel_that_the_body_cannot_hold() -> None:
    with pytest.raises(DomainError, match=r"wheel\[0\]: axial_inertia = 2.4: the body of this inertia holds less than"):
        gyrostat.solve(scene_from(scene(wheel=[{**WHEEL, "axial_inertia": 2.4, "type": "free"}])))


def test_body_and_wheels_come_to_one_gyrostat() -> None:
    u, omega, l = np.array(WHEEL["axis"]), np.array([0.3, -0.5, 0.8]), np.array([0.1, 0.2, -0.3])
    given = {"inertia": [3.0, 2.5, 2.0], "rotor_momentum": l, "angular_velocity": omega, "angular_momentum": None}
    held, turning = (reduced({**given, "wheels": [{**WHEEL, "type": kind}]}) for kind in ("held", "free"))
    J, M = np.diag([3.0, 2.5, 2.0]), np.array([3.0, 2.5, 2.0]) * omega + l + 0.2 * 5.0 * u
    np.testing.assert_allclose(held[0], J, rtol=1e-15)
    np.testing.assert_allclose(held[1], l + 0.2 * 5.0 * u, rtol=1e-15)
    np.testing.assert_allclose(turning[0], J - 0.2 * np.outer(u, u), rtol=1e-15)
    for inertia, kept, momentum in (held, turning):
        np.testing.assert_allclose(momentum, M, rtol=1e-14)
        np.testing.assert_allclose(inertia @ omega + kept, M, rtol=1e-14)
        again = reduced({**given, "angular_velocity": None, "angular_momentum": M, "wheels": [{**WHEEL, "type": "free"}]})
        np.testing.assert_allclose(again[1], turning[1], rtol=1e-14)
    with pytest.raises(DomainError, match=r"wheel\[0\]"):
        reduced({**given, "wheels": [{**WHEEL, "axial_inertia": 9.0, "type": "free"}]})


def test_permanent_rotations_of_a_rigid_body_and_with_much_rotor_momentum() -> None:
    body = {"inertia": [1.2e-4, 0.9e-4, 0.4e-4], "angular_velocity": [0.0, 9.0, 0.0]}
    found = free.permanent_rotations(**body)
    assert found.angular_velocity.shape == (6, 3) and found.stable.tolist() == [True, True, False, False, True, True]
    assert math.sqrt(-found.square[2]) == pytest.approx(9 * math.sqrt((1.2 - 0.9) * (0.9 - 0.4) / (1.2 * 0.4)))
    few = free.permanent_rotations(**{**body, "rotor_momentum": [0.0, 0.0, 1.0]})
    assert len(few.square) == 2 and few.stable.all()
    with pytest.raises(DomainError, match="other units"):  # squares of their rates overflow
        free.permanent_rotations(inertia=[2e-300, 2.5e-300, 3e-300], angular_velocity=[0.01, 1.0, 0.01], rotor_momentum=[0.1, 0.0, 0.2])


@pytest.mark.parametrize("q", [[0.0, 0.0, 0.0, 1.0], [0.1, -0.5, 0.3, 0.8]], ids=["in its axes", "turned"])
def test_rotations_in_the_plane_of_equal_moments_are_one_of_a_circle(q: list[float], tmp_path: Path) -> None:
    turn = matrix_from_quaternion(np.array(q) / np.linalg.norm(q))
    body = {"inertia": (turn @ np.diag([2.0, 2.0, 1.0]) @ turn.T).tolist(), "angular_velocity": (turn @ [0.1, 0.2, 1.0]).tolist()}
    found = free.permanent_rotations(**body)
    assert found.isolated.tolist() == [False] * (len(found.square) - 2) + [True, True] and found.stable.tolist() == found.isolated.tolist()
    report = stability_report(scene_from(scene(body={"inertia": body["inertia"]}, initial={"angular_velocity": body["angular_velocity"]})))
    across = [r for r in report["rotations"] if not r["isolated"]]
    assert across and all(r["growth_rate"] is None and r["frequency"] is None and not r["stable"] for r in across)
    assert {row[2] for _, _, rows in tables(report) for row in rows} == {"one of a circle", "stable"}


def test_flips_come_at_even_intervals() -> None:
    given = free.arguments(load("t-handle"))
    times = free.flips(inertia=given["inertia"], angular_velocity=given["angular_velocity"], axis=[0.0, 1.0, 0.0], begin=0.0, end=60.0)
    interval = gyrostat.solve("t-handle", model="closed-form").scalars["flip_interval"]
    assert np.diff(times) == pytest.approx(interval, rel=1e-12) and interval == pytest.approx(3.98, abs=0.01)


@pytest.mark.parametrize("name", SCENES)
def test_stability_of_the_bundled_scenes(name: str) -> None:
    report = stability_report(load(name))
    assert report["rotations"] and report["motion"]["kind"] in (
        "about-largest", "about-smallest", "one-component", "separatrix", "steady", "spherical")
    assert plot_stability(load(name), report) is not None


def test_chart() -> None:
    chart = gyrostat.chart("tumbling-brick")
    labels = {point.group for point in chart.points}
    assert {"rung", "taylor"} <= labels


def test_a_number_without_a_value_is_none() -> None:
    given: dict[str, Any] = {"inertia": [1.0, 2.0, 2.5], "angular_velocity": [0.0, 0.0, 1.0], "times": [0.0, 1.0]}
    for ask in (None, ["period", "turn_per_period", "flip_interval"]):
        told = free.solve(**given, ask=ask).scalars
        assert told["period"] is None and told["turn_per_period"] is None and told["flip_interval"] is None
