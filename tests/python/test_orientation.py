# SPDX-License-Identifier: BSD-3-Clause
"""An attitude means the same in every form that a scene file may give it in."""

import json
import math
import re
import tomllib
from functools import reduce
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import GOOD, HEAVY, PERIODIC, ROTOR, SPINNING
from gyrostat.errors import SceneError
from gyrostat.orientation import FORMS, SEQUENCES
from gyrostat.rotation import angle_between, matrix_from_quaternion, quaternion_from_euler_312
from gyrostat.scenes import load, scene_from
from gyrostat.schema import schema
from hypothesis import given, settings
from hypothesis import strategies as st
from test_schema import accepts

import gyrostat

BASE = tomllib.loads(ROTOR)
ROUNDING = 3e-15  # rad


def attitude(form: str, value: Any) -> np.ndarray[Any, Any]:
    """The quaternion that a form comes to."""
    made = np.array(scene_from(BASE, **{f"initial.{form}": value}).tables["initial"]["attitude"])
    assert abs(np.linalg.norm(made) - 1) < 1e-15
    return made


def turn(axis: int, angle: float) -> np.ndarray[Any, Any]:
    """The right-handed turn about an axis, 0 to 2."""
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    made = np.eye(3)
    made[i, i], made[i, j], made[j, i], made[j, j] = c, -s, s, c
    return made


def angle_to(q: np.ndarray[Any, Any], R: np.ndarray[Any, Any]) -> float:
    """Angle between a quaternion and a matrix."""
    D = matrix_from_quaternion(q).T @ R
    return float(np.linalg.norm([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]]) / 2 if np.trace(D) > 2 else math.pi)


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_every_sequence_turns_about_the_axes_of_the_body_one_after_the_other(sequence: str) -> None:
    axes = ["123".find(each) if each in "123" else "XYZ".find(each) for each in sequence.replace("-", "")]
    for angles in ([0.3, -1.1, 2.5], [0.0, 0.0, 0.0], [-3.0, 2.0, 400.0], [0.7, math.pi / 2, 0.2], [1e-9, -1e-9, 1e-12]):
        q = attitude("euler", {"sequence": sequence, "angles": angles})
        assert angle_to(q, reduce(np.matmul, map(turn, axes, angles))) < ROUNDING
        assert q[3] >= 0


def test_every_form_agrees_with_scipy() -> None:
    scipy = pytest.importorskip("scipy.spatial.transform")
    draw = np.random.default_rng(5)
    for R in scipy.Rotation.random(50, random_state=draw):
        q, dcm = R.as_quat(), R.as_matrix()
        given = {"quaternion_scalar_first": np.roll(q, 1), "mrp": R.as_mrp(), "rotation_vector": R.as_rotvec(), "dcm_body_to_inertial": dcm,
                 "dcm_inertial_to_body": dcm.T}
        for form, value in given.items():
            assert angle_between(attitude(form, value.tolist()), q) < ROUNDING, form
        for sequence in ("ZYX", "XYZ", "ZXZ", "ZXY", "YXY"):
            angles = draw.uniform(-6, 6, 3)
            wanted = scipy.Rotation.from_euler(sequence, angles).as_quat()
            assert angle_between(attitude("euler", {"sequence": sequence, "angles": angles.tolist()}), wanted) < ROUNDING
            fixed = scipy.Rotation.from_euler(sequence[::-1].lower(), angles[::-1]).as_quat()  # as the message about small letters says
            assert angle_between(fixed, wanted) < ROUNDING


@settings(max_examples=200, deadline=None)
@given(st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: math.hypot(*q) > 0.1))
def test_forms_of_any_quaternion(given: list[float]) -> None:
    q = np.array(given) / math.hypot(*given)
    R = matrix_from_quaternion(q)
    assert angle_between(attitude("dcm_body_to_inertial", R.tolist()), q) < ROUNDING
    assert angle_between(attitude("dcm_inertial_to_body", R.T.tolist()), q) < ROUNDING
    assert angle_between(attitude("quaternion_scalar_first", np.roll(q, 1).tolist()), q) < ROUNDING
    for sign in (1, -1):  # the set, and its shadow beyond half a turn
        if 1 + sign * q[3] > 0.3:
            assert angle_between(attitude("mrp", (sign * q[:3] / (1 + sign * q[3])).tolist()), q) < ROUNDING


def test_great_and_small_parameters() -> None:
    assert np.array_equal(attitude("mrp", [0, 0, 0]), [0, 0, 0, 1]) and np.array_equal(attitude("rotation_vector", [0, 0, 0]), [0, 0, 0, 1])
    assert attitude("mrp", [1e-12, 0, 0])[0] == pytest.approx(2e-12, rel=1e-15) and attitude("rotation_vector", [0, 1e-200, 0])[1] == 5e-201
    assert attitude("mrp", [1e50, 0, 0])[0] == pytest.approx(-2e-50, rel=1e-15)
    assert angle_between(attitude("rotation_vector", ["370 deg", 0, 0]), attitude("rotation_vector", ["10 deg", 0, 0])) < ROUNDING
    assert angle_between(attitude("rotation_vector", {"value": [0, 0, 180], "unit": "deg"}), [0, 0, 1, 0]) < ROUNDING


def test_a_matrix_that_is_not_quite_one_is_taken_as_the_nearest_rotation() -> None:
    draw = np.random.default_rng(6)
    for _ in range(20):
        R = reduce(np.matmul, (turn(i, draw.uniform(-3, 3)) for i in range(3)))
        M = R + draw.uniform(-2e-9, 2e-9, (3, 3))
        near = matrix_from_quaternion(attitude("dcm_body_to_inertial", M.tolist()))
        stretch = near.T @ M  # symmetric for the nearest
        assert np.abs(stretch - stretch.T).max() < 1e-15 and np.abs(near - M).max() < 3e-9
        scene = scene_from(BASE, dcm_body_to_inertial=M)
        assert scene.to_dict()["initial"]["dcm_body_to_inertial"] == M.tolist()


@pytest.mark.parametrize(("off", "warned"), [(0.0, False), (4e-13, False), (3e-12, True), (1e-9, True)])
def test_an_answer_warns_of_direction_cosines_that_are_rounded(off: float, warned: bool) -> None:
    for form in ("dcm_body_to_inertial", "dcm_inertial_to_body"):
        answer = gyrostat.solve(scene_from(BASE, **{form: [[1.0 + off, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]}))
        told = [warning.message for warning in answer.warnings if warning.code == "not-orthonormal"]
        assert len(told) == warned
        assert not told or told[0].endswith(f"off by {2 * off:.2g}")


# ---- in scenes ----

I3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
# The form, what is given, and what the message must contain.
MISTAKES: dict[str, tuple[str, Any, list[str]]] = {
    "equal neighbours": ("euler", {"sequence": "3-3-1", "angles": [0, 0, 0]}, ['sequence = "3-3-1"', "two turns about one axis", '"3-1-3"']),
    "equal letters": ("euler", {"sequence": "ZXX", "angles": [0, 0, 0]}, ["two turns about one axis", '"3-2-1"']),
    "two axes": ("euler", {"sequence": "3-2", "angles": [0, 0]}, ["no sequence of axes", "three axes"]),
    "an unknown axis": ("euler", {"sequence": "3-2-4", "angles": [0, 0, 0]}, ["no sequence of axes", '"ZYX"']),
    "digits without dashes": ("euler", {"sequence": "321", "angles": [0, 0, 0]}, ['write "3-2-1"']),
    "a number for a sequence": ("euler", {"sequence": 321, "angles": [0, 0, 0]}, ["an integer, not text"]),
    "small letters": ("euler", {"sequence": "zyx", "angles": [0, 0, 0]}, ["fixed axes", 'write "ZYX"', '"XYZ" with the angles in reverse']),
    "no sequence": ("euler", {"angles": [0, 0, 0]}, ["the key sequence is missing", "neighbours different"]),
    "no angles": ("euler", {"sequence": "3-2-1"}, ["the key angles is missing", "(rad)"]),
    "two angles": ("euler", {"sequence": "3-2-1", "angles": [0, 0]}, ["2 elements", "3 numbers"]),
    "an angle in metres": ("euler", {"sequence": "3-2-1", "angles": ["1 m", 0, 0]}, ["element 1", "its unit is rad, not m"]),
    "an angle per second": ("euler", {"sequence": "3-2-1", "angles": ["1 deg/s", 0, 0]}, ["its unit is rad, not deg/s"]),
    "angles alone": ("euler", [0.1, 0.2, 0.3], ["an array, not a table", "sequence"]),
    "an unknown part": ("euler", {"sequence": "3-2-1", "angels": [0, 0, 0]}, ["unknown key", "did you mean angles?"]),
    "unit of parameters": ("mrp", ["1 deg", 0, 0], ["element 1", "has no unit"]),
    "four parameters": ("mrp", [0, 0, 0, 1], ["4 elements", "3 numbers"]),
    "a vector in metres": ("rotation_vector", {"value": [0, 0, 1], "unit": "m"}, ["element 1", "its unit is rad, not m"]),
    "a mirror": ("dcm_body_to_inertial", [[0, 1, 0], [1, 0, 0], [0, 0, 1]], ["determinant is -1", "mirror", "change the sign of its row or column"]),
    "rows that lean": ("dcm_inertial_to_body", [[1, 0, 1e-7], [0, 1, 0], [0, 0, 1]], ["rows 1 and 3 are not across each other", "9 digits"]),
    "a short row": ("dcm_body_to_inertial", [[1, 0, 0], [0, 0.9999, 0], [0, 0, 1]], ["row 2 has the length 0.9999, not 1"]),
    "a row of two": ("dcm_body_to_inertial", [[1, 0], [0, 1, 0], [0, 0, 1]], ["row 1 is not an array of three numbers"]),
    "cosines beyond one": ("dcm_body_to_inertial", [[2, 0, 0], [0, 1, 0], [0, 0, 1]], ["element (1, 1) = 2 is out of range"]),
    "nothing but zeros": ("dcm_inertial_to_body", [[0, 0, 0]] * 3, ["row 1 has the length 0, not 1"]),
    "cosines with units": ("dcm_inertial_to_body", [["1 m", 0, 0], [0, 1, 0], [0, 0, 1]], ["element (1, 1)", "has no unit"]),
    "not of unit length": ("quaternion_scalar_first", [2, 0, 0, 0], ["norm is 2, not 1", "[1, 0, 0, 0]"]),
    "no quaternion": ("quaternion_scalar_first", [0, 0, 0, 0], ["zero quaternion", "[w, x, y, z]"]),
    "a quaternion of three": ("quaternion_scalar_first", [1, 0, 0], ["3 elements", "(w, x, y, z)"]),
}


@pytest.mark.parametrize("label", MISTAKES)
def test_a_mistake_in_an_attitude_says_what_would_be_right(label: str) -> None:
    form, value, wanted = MISTAKES[label]
    with pytest.raises(SceneError) as caught:
        scene_from(BASE, **{f"initial.{form}": value})
    message = str(caught.value)
    for part in [f"initial.{form}", *wanted]:
        assert part in message


def test_only_one_form_is_given() -> None:
    for first, second in (("attitude", "mrp"), ("euler", "rotation_vector"), ("dcm_body_to_inertial", "dcm_inertial_to_body")):
        given = {"attitude": [0, 0, 0, 1], "mrp": [0, 0, 0], "euler": {"sequence": "ZYX", "angles": [0, 0, 0]}, "rotation_vector": [0, 0, 0],
                 "dcm_body_to_inertial": I3, "dcm_inertial_to_body": I3}
        data = {**BASE, "initial": {"angular_velocity": [0, 0, 1], "rotor_rate": 0, first: given[first], second: given[second]}}
        with pytest.raises(SceneError, match=f"initial.{second}.*given beside initial.{first}; in .initial. give either attitude or"):
            scene_from(data)
        assert not accepts(schema(), data)
    with pytest.raises(SceneError, match="given beside initial.down"):
        scene_from({**tomllib.loads(HEAVY), "initial": {"angular_velocity": [0, 0, 1], "down": [0, 0, 1], "mrp": [0, 0, 0]}})
    with pytest.raises(SceneError, match="given beside initial.euler_312"):
        scene_from({**tomllib.loads(SPINNING), "initial": {"angular_velocity": [0, 0, 1], "euler_312": [0, 0, 0], "mrp": [0, 0, 0]}})


# One attitude in every form.
SAME: dict[str, Any] = {
    "attitude": [0.0, 0.0, 0.6, 0.8], "quaternion_scalar_first": [0.8, 0.0, 0.0, 0.6], "mrp": [0, 0, 1 / 3],
    "euler": {"sequence": "3-2-1", "angles": [2 * math.atan2(3, 4), 0, 0]}, "rotation_vector": [0, 0, 2 * math.atan2(3, 4)],
    "dcm_body_to_inertial": [[0.28, -0.96, 0.0], [0.96, 0.28, 0.0], [0.0, 0.0, 1.0]],
    "dcm_inertial_to_body": [[0.28, 0.96, 0.0], [-0.96, 0.28, 0.0], [0.0, 0.0, 1.0]],
}


@pytest.mark.parametrize("text", [GOOD, ROTOR, SPINNING, HEAVY, PERIODIC, "tumbling-brick"])
def test_every_kind_takes_every_form(text: str) -> None:
    data = load(text).to_dict() if text.isidentifier() or "-" in text[:12] else tomllib.loads(text)
    start = {} if text == PERIODIC else {"initial.angular_velocity": [0.1, 0.2, 0.3]}
    if text == PERIODIC:
        with pytest.raises(SceneError, match="given beside|is missing"):
            scene_from(data, mrp=[0, 0, 0])
        return
    answers = {}
    for form, value in SAME.items():
        scene = scene_from(data, duration=1.0, samples=3, tolerance=1e-9, ask=["attitude"], **{**start, f"initial.{form}": value})
        assert accepts(schema(), scene.to_dict())
        assert [key for key in scene.to_dict()["initial"] if key in SAME or key in ("down", "euler_312")] == [form]
        answers[form] = gyrostat.solve(scene)
        assert json.loads(answers[form].to_json())["scene"]["initial"][form] == value
        again = scene_from(scene.to_dict())
        assert again.to_dict() == scene.to_dict() and again.tables == scene.tables
    for form, answer in answers.items():
        assert np.all(angle_between(answer["attitude"], answers["attitude"]["attitude"]) < 1e-8), form
        assert angle_between(answer["attitude"][0], SAME["attitude"]) < ROUNDING
    assert {f"initial.{field.name}" for field in FORMS} == {f"initial.{form}" for form in SAME} - {"initial.attitude"}


def test_a_form_takes_the_place_of_another() -> None:
    scene = scene_from(BASE, euler={"sequence": "3-1-3", "angles": ["90 deg", 0, 0]})
    assert scene.tables["initial"]["attitude"] == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)), abs=1e-15)
    assert scene.replace(tolerance=1e-8).to_dict()["initial"]["euler"] == {"sequence": "3-1-3", "angles": ["90 deg", 0, 0]}
    turned = scene.replace(mrp=[0, 0, 1])
    assert "euler" not in turned.to_dict()["initial"] and turned.tables["initial"]["attitude"] == (0.0, 0.0, 1.0, 0.0)
    back = turned.replace(attitude=[0, 0, 0, 1])
    assert back.to_dict()["initial"].keys() == {"angular_velocity", "rotor_rate", "attitude"}
    assert scene.replace(**{"initial.euler.sequence": "2-1-3"}).tables["initial"]["attitude"][1] == pytest.approx(math.sqrt(0.5))


def test_312_is_that_of_a_spinner() -> None:
    psi, phi, theta = 0.004, -0.002, 0.3
    q = attitude("euler", {"sequence": "3-1-2", "angles": [theta, psi, phi]})
    assert angle_between(q, quaternion_from_euler_312([psi, phi, theta])) < ROUNDING
    data = {**tomllib.loads(SPINNING), "initial": {"angular_velocity": [0, 0, 1], "euler": {"sequence": "ZXY", "angles": [theta, psi, phi]}}}
    assert gyrostat.solve(data, times=[0.0])["euler_312"][0] == pytest.approx([psi, phi, theta], abs=1e-15)


def test_without_an_attitude_all_is_as_it_was() -> None:
    start = {"angular_velocity": [0, 0, 1], "rotor_rate": 0}
    assert scene_from({**BASE, "initial": start}).tables["initial"]["attitude"] == (0.0, 0.0, 0.0, 1.0)
    assert scene_from(tomllib.loads(HEAVY)).tables["initial"]["attitude"] is None
    top = gyrostat.solve(tomllib.loads(HEAVY), rotation_vector=["170 deg", 0, 0], ask=["attitude", "down"])
    assert np.linalg.norm(top["down"][0] - [0, -math.sin(math.radians(170)), -math.cos(math.radians(170))]) < 1e-14


def test_the_table_of_the_page_shows_one_turn() -> None:
    page = (Path(__file__).resolve().parents[2] / "docs" / "scenes.md").read_text()
    shown = {key: tomllib.loads(f"value = {value}")["value"] for key, value in re.findall(r"^\| `(\w+)` \| [^|]+ \| `([\[{][^`]+)` \|$", page, re.M)}
    assert shown.keys() == SAME.keys()
    for form, value in shown.items():
        assert angle_between(attitude(form, value), [0, 0, math.sqrt(0.5), math.sqrt(0.5)]) < 1e-15, form


def test_the_quaternion_of_any_form_varies() -> None:
    pytest.importorskip("scipy")
    rows = gyrostat.sweep(BASE, {"initial.attitude[0]": [0.0, 0.1]}, rotation_vector=["20 deg", 0, 0], times=[0.0], ask=["attitude"])
    for x, row in zip([0.0, 0.1], rows["attitude"].values, strict=True):
        q = np.array([x, 0, 0, math.cos(math.pi / 18)])
        assert angle_between(row[0], q / np.linalg.norm(q)) < ROUNDING


def test_a_missing_attitude_is_not_blamed_on_the_start() -> None:
    averaged = gyrostat.solve(tomllib.loads(GOOD), mrp=[0, 0, 0.1], model="averaged")
    with pytest.raises(KeyError, match='belongs to scenes of this kind: a higher rung gives it'):
        averaged["attitude"]
