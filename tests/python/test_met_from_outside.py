# SPDX-License-Identifier: BSD-3-Clause
"""What people from outside met in the package and the command, and what it does there."""

import copy
import json
import math
import pickle
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import DomainError, SceneError, deceleration, free, sweep, sweeps
from gyrostat.cli import main
from gyrostat.facts import FACTS
from gyrostat.scenes import load, scene_from
from gyrostat.vary import read_cases

BRICK: dict[str, Any] = {
    "name": "brick", "solve": {"duration": 10.0, "samples": 3, "tolerance": 1e-6}, "body": {"inertia": [3.0, 4.0, 5.0]},
    "torque": [{"type": "constant", "torque": [0.1, 0.0, 0.0], "on": [[0.0, 105.0]]}],
    "initial": {"angular_velocity": [0.1, 0.5, 0.2], "attitude": [0.0, 0.0, 0.0, 1.0]},
}
DESPIN: dict[str, Any] = {"inertia": [3.0, 4.0, 5.0], "control": [0.01] * 3, "drag": 0.0, "angular_momentum": [1.0, 2.0, 1.0], "times": [0.0, 10.0]}
WHEEL: dict[str, Any] = {"axis": np.array([0.0, 0.0, 1.0]), "axial_inertia": 0.1, "rate": 5.0}


def test_another_clock_has_other_times() -> None:
    for begin, other in ((100.0, 0.0), (0.0, 100.0)):
        scene = scene_from({**BRICK, "initial": {**BRICK["initial"], "time": begin}})
        assert scene.times[0] == begin
        moved = scene.replace(**{"initial.time": other})
        assert moved.times.tolist() == [other, other + 5, other + 10]
        assert gyrostat.solve(scene, **{"initial.time": other})["angular_velocity"].tolist() == gyrostat.solve(moved.to_dict())["angular_velocity"].tolist()


def test_no_view_without_the_torque_that_acted() -> None:
    with pytest.raises(DomainError, match="torque of your own"):
        gyrostat.solve(BRICK, torque=lambda *state: (0.0, 0.0, 1.0)).view()


@pytest.mark.parametrize("name", ["tiangong-1", "spinning-paper"])
def test_meanings_are_those_of_the_kind(name: str) -> None:
    answer = gyrostat.solve(name, times=[0.0, 1.0], ask="all")
    told = answer.to_xarray()
    for column in answer:
        assert told[column].attrs["long_name"] == FACTS[answer.scene["kind"]].columns[column].meaning


@pytest.mark.parametrize(("text", "told"), [
    ("a,a\n1,2\n", "twice"), ("a,b\n\n1,2\n\n3\n", "line 5"), ('a,b\n1,"' + "x" * 200_000 + "\n", "cannot be read"), ("a\n", "keys")])
def test_tables_of_cases_that_cannot_be_read(text: str, told: str, tmp_path: Path) -> None:
    (tmp_path / "cases.csv").write_text(text)
    with pytest.raises(DomainError, match=told):
        read_cases(tmp_path / "cases.csv")


@pytest.mark.parametrize("cases", [5, [1.0], {"body.inertia[0]": 5}, {"body.inertia[0]": [[1.0]]}])
def test_cases_that_are_no_table(cases: Any) -> None:
    with pytest.raises(DomainError, match="cases: give a table"):
        sweep("tiangong-1", cases=cases)


def test_words_of_a_sweep_are_told(tmp_path: Path) -> None:
    found = sweep("tiangong-1", cases={"torque.law": ["total", "carrier"]}, ask=["stop_time"])
    assert found["torque.law"].attrs["flag_meanings"] == "total carrier"
    sweeps.save(found, tmp_path / "out.csv")
    assert [line.split(",")[1] for line in (tmp_path / "out.csv").read_text().splitlines()[1:]] == ["total", "carrier"]


def test_what_is_not_finite_is_told_so() -> None:
    found = sweep("tiangong-1", cases={"body.inertia[0]": [math.inf, -1.0]}, ask=["stop_time"])
    assert found["reason"].values.tolist() == ["body.inertia[0] is not finite", "body.inertia[0] is not >= 1e-40"]


def test_every_wheel_is_drawn_and_named() -> None:
    answer = free.solve(inertia=[3.0, 4.0, 5.0], angular_velocity=[0.1, 0.2, 0.3], wheels=[WHEEL] * 10, times=[0.0, 1.0, 2.0, 3.0], ask=["rotor_rate"])
    axes = answer.plot().axes[0]
    assert [line.get_label() for line in axes.lines] == [str(i) for i in range(1, 11)]


@pytest.mark.parametrize(("wheel", "told"), [({**WHEEL, "type": "Free"}, "held or free"), ({"axis": [0, 0, 1]}, "has no axial_inertia, rate")])
def test_wheels_that_are_none(wheel: dict[str, Any], told: str) -> None:
    with pytest.raises(DomainError, match=told):
        free.solve(inertia=[3.0, 4.0, 5.0], angular_velocity=[0.1, 0.2, 0.3], wheels=[wheel], times=[1.0])


def test_answers_of_the_functions_travel() -> None:
    for answer in (deceleration.solve(**DESPIN), free.solve(inertia=[3.0, 4.0, 5.0], angular_velocity=[0.1, 0.2, 0.3], wheels=[WHEEL], times=[1.0])):
        again = pickle.loads(pickle.dumps(answer))
        assert again.to_json() == answer.to_json() == copy.deepcopy(answer).to_json()
        assert json.loads(answer.to_json())["scene"]["kind"] == answer.scene["kind"]


@pytest.mark.parametrize("name", ["stage-despin-study", "wheel-seized", "cubesat-three-wheels"])
def test_every_scene_has_a_page(name: str) -> None:
    assert name in load(name)._repr_html_()


def test_a_name_is_text_wherever_it_stands(tmp_path: Path) -> None:
    odd = 'name="<!--<script> $\\\\foo$ é"'
    assert main(["solve", "t-handle", "--set", odd, "--plot", str(tmp_path / "p.png"), "-o", str(tmp_path / "report.txt")]) == 0
    assert main(["view", "t-handle", "--set", odd, "-o", str(tmp_path / "v.html")]) == 0
    page = (tmp_path / "v.html").read_text(encoding="utf-8")
    assert "<!--<script" not in page.split("</title>")[1]


def test_inputs_are_not_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cases, scene = tmp_path / "cases.csv", tmp_path / "s.toml"
    cases.write_text("torque.drag\n1e-6\n")
    scene.write_text(gyrostat.scenes.find("t-handle").read_text())
    assert main(["sweep", "tiangong-1", "--cases", str(cases), "-o", str(cases)]) == 2
    assert main(["view", str(scene), "-o", str(scene)]) == 2
    assert cases.read_text().startswith("torque.drag") and "inertia" in scene.read_text()


def test_stability_of_a_start_beside_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stability", "t-handle", "--set", "angular_velocity=[0,9,0]", "--json"]) == 0
    json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert main(["stability", "t-handle", "--set", "angular_velocity=[0,0,0]"]) == 2
    assert "give it a momentum" in capsys.readouterr().err


def test_a_folder_does_not_hide_a_bundled_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "t-handle").mkdir()
    monkeypatch.chdir(tmp_path)
    assert load("t-handle").name == "t-handle"
    (tmp_path / "other").mkdir()
    with pytest.raises(SceneError, match="this is a directory; name a scene file$"):
        load("other")


def test_a_rung_of_a_family_is_a_bare_word() -> None:
    assert main(["solve", "cubesat-three-wheels", "--set", "model=free:closed-form", "--json"]) in (0, 2)


@pytest.mark.parametrize("value", ["1" + "0" * 400, "1e400"])
def test_a_tolerance_beyond_all_numbers(value: str) -> None:
    assert main(["solve", "t-handle", "--set", f"ask={{energy={value}}}"]) == 2


def test_a_study_answers_with_a_start_of_another_kind() -> None:
    assert main(["solve", "stage-despin-study", "--set", "angular_momentum=[1000.0, 2000.0, 3000.0]"]) == 0
