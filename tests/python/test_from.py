# SPDX-License-Identifier: BSD-3-Clause
"""General scenes that begin where another ends, bodies that are told without their wheels, and attitudes told by angles."""

import copy
import math
import re
import tomllib
from fractions import Fraction
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import DomainError, SceneError, general
from gyrostat.families import FAMILIES
from gyrostat.families.general.before import end_of
from gyrostat.families.general.clock import PI, orbit_since, phase
from gyrostat.families.general.scene import arguments
from gyrostat.rotation import angle_between, matrix_from_quaternion
from gyrostat.scenes import load, scene_from
from gyrostat.toml_text import toml_text, toml_value

WAVE = {"mean": 1.0, "amplitude": 0.3, "rate": 0.4, "phase": 0.2}
# Everything that knows the time.
WHOLE: dict[str, Any] = {
    "name": "whole", "solve": {"duration": 40.0, "samples": 5, "tolerance": 1e-9},
    "body": {"inertia": [3.0, 2.5, 2.0], "mass": 4.0, "centre_of_mass": [0.1, 0.0, 0.05]},
    "wheel": [{"name": "a", "type": "friction", "axis": [0.6, 0, 0.8], "axial_inertia": 0.02, "rate": 300.0, "friction": 1e-3},
              {"name": "b", "type": "torque", "axis": [0, 1, 0], "axial_inertia": 0.01, "rate": 5.0,
               "torque": {"times": [0.0, 30.0, 60.0, 80.0], "values": [0.01, 0.03, -0.02, 0.0], "interpolation": "cubic", "extend": "hold"}}],
    "torque": [{"type": "constant", "torque": [0.01, 0.0, 0.002], "on": [[10.0, 70.0]], "factor": WAVE},
               {"type": "magnetic", "dipole": [1.0, 2.0, 0.5]}, {"type": "gravity-gradient"},
               {"type": "table", "frame": "orbit", "times": [20.0, 50.0, 60.0], "values": [[0.01, 0, 0], [0, 0.02, 0], [0, 0, 0.01]]}],
    "orbit": {"altitude": "400 km", "eccentricity": 0.1, "true_anomaly": 0.4},
    "field": {"rotating": {"axis": [0.0, 0.3, 1.0], "rate": 0.03, "vector": [1e-4, 0.0, 2e-4]}},
    "initial": {"angular_velocity": [0.3, -0.5, 0.8], "velocity": [1.0, 0.0, 0.0]},
}
LATER = [40.0, 55.0, 90.0]


def write(folder: Path, name: str, scene: dict[str, Any]) -> Path:
    text = "".join(f"{key} = {toml_value(value)}\n" for key, value in scene.items() if not isinstance(value, dict) and key not in ("wheel", "torque"))
    for key in ("wheel", "torque"):
        text += "".join(f"[[{key}]]\n" + "".join(f"{k} = {toml_value(v)}\n" for k, v in each.items()) for each in scene.get(key, ()))
    text += "".join(f"[{key}]\n" + "".join(f"{k} = {toml_value(v)}\n" for k, v in value.items()) for key, value in scene.items()
                    if isinstance(value, dict) and key not in ("from",))
    file = folder / f"{name}.toml"
    file.write_text(text)
    return file


def going_on(scene: dict[str, Any], before: Any, **changes: Any) -> dict[str, Any]:
    """The scene without a start of its own."""
    made = copy.deepcopy({key: value for key, value in scene.items() if key != "initial"})
    for wheel in made.get("wheel", ()):
        wheel.pop("rate", None)
    return {"name": "later", "from": before, **{k: v for k, v in made.items() if k != "name"}, "solve": {"times": LATER, "tolerance": 1e-8}, **changes}


def off(got: gyrostat.Answer, want: gyrostat.Answer, name: str) -> float:
    if name.startswith("attitude"):
        return float(np.max(angle_between(got[name], want[name])))
    rows = [answer[name].reshape(len(answer.t), -1) for answer in (got, want)]
    return float(np.max(np.linalg.norm(rows[0] - rows[1], axis=1)) / max(got.scale[name], np.max(np.linalg.norm(rows[1], axis=1))))


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_a_motion_in_two_scenes_is_the_motion_within_what_is_stated(tmp_path: Path, tolerance: float) -> None:
    write(tmp_path, "first", WHOLE | {"solve": {"duration": 40.0, "samples": 5, "tolerance": tolerance}})
    whole = gyrostat.solve(WHOLE, times=LATER, tolerance=1e-12, ask="all")
    later = gyrostat.solve(write(tmp_path, "second", going_on(WHOLE, "first.toml")), ask="all")
    assert later.t.tolist() == LATER
    for name in later:
        assert off(later, whole, name) <= later.error[name] + whole.error[name], name
    # the start's error is not only carried, it is carried sharply
    assert later.error["attitude"] < 1e3 * tolerance + 1e-9
    assert later.met == (later.error["attitude"] <= 1e-8)
    assert any(warning.code == "start-uncertain" for warning in later.warnings) == (not later.met)


def test_three_scenes_in_a_row(tmp_path: Path) -> None:
    write(tmp_path, "first", WHOLE | {"solve": {"times": [20.0], "tolerance": 1e-11}})
    write(tmp_path, "second", going_on(WHOLE, "first.toml", solve={"duration": 20.0, "samples": 2, "tolerance": 1e-11}))
    third = load(write(tmp_path, "third", going_on(WHOLE, "second.toml", solve={"duration": 10.0, "samples": 3})))
    assert third.start_time == 40.0
    assert third.times.tolist() == [40.0, 45.0, 50.0]
    got, want = gyrostat.solve(third), gyrostat.solve(WHOLE, times=third.times.tolist(), tolerance=1e-12)
    for name in got:
        assert off(got, want, name) <= got.error[name] + want.error[name], name


def test_the_first_row_is_the_end(tmp_path: Path) -> None:
    first = load(write(tmp_path, "first", WHOLE))
    end = end_of(first)
    row = gyrostat.solve(write(tmp_path, "second", going_on(WHOLE, "first.toml")), times=[40.0, 41.0])
    assert row["angular_velocity"][0].tolist() == end.angular_velocity.tolist()
    assert row["rotor_rate"][0].tolist() == [rate for rate, _ in end.wheels.values()]


def test_an_answer_tells_its_scene_for_wherever_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "elsewhere").mkdir()
    write(tmp_path, "first", WHOLE)
    for begin in ('"first.toml"', '{file = "first.toml", keep = "momentum"}'):
        second = write(tmp_path, "second", going_on(WHOLE, "first.toml"))
        second.write_text(second.read_text().replace('from = "first.toml"', f"from = {begin}"))
        answer = gyrostat.solve(second)
        monkeypatch.chdir(tmp_path / "elsewhere")
        again = gyrostat.solve(answer.scene)
        assert again["attitude"].tobytes() == answer["attitude"].tobytes()
        assert answer.plot() and answer.view()
        monkeypatch.chdir(tmp_path)


def test_keys_of_the_start_override(tmp_path: Path) -> None:
    write(tmp_path, "first", WHOLE)
    own = going_on(WHOLE, "first.toml", initial={"angular_velocity": [0.1, 0.0, 0.0], "position": [1.0, 2.0, 3.0]})
    own["wheel"][0]["rate"] = 7.0
    row = gyrostat.solve(write(tmp_path, "second", own), times=[40.0, 41.0], ask="all")
    assert row["angular_velocity"][0].tolist() == [0.1, 0.0, 0.0]
    assert row["position"][0].tolist() == [1.0, 2.0, 3.0]
    assert row["rotor_rate"][0, 0] == 7.0
    assert row["rotor_rate"][0, 1] != 5.0
    assert angle_between(row["attitude"][0], end_of(load(tmp_path / "first.toml")).attitude) < 1e-15


def test_a_wheel_that_is_caught_is_one_of_very_strong_friction(tmp_path: Path) -> None:
    wheels = [{"name": "a", "type": "free", "axis": [0.6, 0.0, 0.8], "axial_inertia": 0.05, "rate": 40.0},
              {"name": "b", "type": "free", "axis": [0.0, 1.0, 1.0], "axial_inertia": 0.3, "rate": -3.0}]
    first = {"name": "first", "solve": {"times": [3.0], "tolerance": 1e-12}, "body": {"inertia": [3.0, 2.5, 2.0]}, "wheel": wheels,
             "initial": {"angular_velocity": [0.3, -0.5, 0.8]}}
    write(tmp_path, "first", first)
    caught = [{**wheels[0], "type": "locked"}, {**wheels[1]}]
    caught[0].pop("rate")
    later = going_on(first, {"file": "first.toml", "keep": "momentum"}, wheel=caught)
    later["wheel"][1].pop("rate")
    got = arguments(scene_from(later | {"from": {"file": str(tmp_path / "first.toml"), "keep": "momentum"}, "solve": {"times": [3.0, 4.0]}}))
    # half a millisecond is 250 times what the friction needs; meanwhile the body turns by that time
    braked = [{**wheels[0], "type": "friction", "friction": 2.5e4}, wheels[1]]
    end = end_of(load(tmp_path / "first.toml"))
    for wheel, (rate, _) in zip(braked, end.wheels.values(), strict=True):
        wheel["rate"] = rate
    limit = gyrostat.solve(first | {"wheel": braked, "initial": {"angular_velocity": end.angular_velocity.tolist()}}, times=[0.0, 5e-5], ask="all", tolerance=1e-9)
    assert np.allclose(limit["angular_velocity"][-1], got["angular_velocity"], atol=3e-4)
    assert abs(limit["rotor_rate"][-1, 1] - got["wheels"][1]["rate"]) < 3e-4
    assert np.linalg.norm(end.angular_velocity - got["angular_velocity"]) > 0.3


def test_a_top_that_is_let_go_keeps_its_momentum_and_the_path_of_its_mass_centre(tmp_path: Path) -> None:
    body = {"inertia": [0.5, 0.4, 0.3], "mass": 2.0, "centre_of_mass": [0.1, 0.05, 0.3], "fixed": True}
    first = {"name": "first", "solve": {"times": [2.0], "tolerance": 1e-10}, "body": body, "initial": {"angular_velocity": [0.3, -0.5, 0.8]},
             "field": {"gravity": 9.81}, "torque": [{"type": "weight"}]}
    write(tmp_path, "first", first)
    end, c = end_of(load(tmp_path / "first.toml")), np.array(body["centre_of_mass"])
    about_centre = np.diag([0.5, 0.4, 0.3]) - 2.0 * (c @ c * np.eye(3) - np.outer(c, c))
    # nothing but the pivot goes: the rates stay, whichever is kept
    for keep in ("rates", "momentum"):
        flying = {"name": "flying", "kind": "general", "from": {"file": str(tmp_path / "first.toml"), "keep": keep}, "solve": {"times": [2.0, 3.0]},
                  "body": {"inertia": about_centre.tolist(), "mass": 2.0, "centre_of_mass": c.tolist()}}
        got = arguments(scene_from(flying))
        assert np.allclose(got["angular_velocity"], end.angular_velocity, rtol=1e-13)
    # it unfolds as it leaves: the momentum about the mass centre stays, and so does where that is
    flying["body"] = {"inertia": (2 * about_centre).tolist(), "mass": 2.0, "centre_of_mass": [0.0, 0.0, 0.0]}
    got = arguments(scene_from(flying))
    assert np.allclose(got["angular_velocity"], end.angular_velocity / 2, rtol=1e-13)
    R = matrix_from_quaternion(end.attitude)
    assert np.allclose(got["position"], R @ c, rtol=1e-13) and np.allclose(got["velocity"], R @ np.cross(end.angular_velocity, c), rtol=1e-13)


@pytest.mark.parametrize("extend", ["hold", "zero"])
@pytest.mark.parametrize("cut", [10.0, 20.0])
def test_a_step_of_a_wheel_at_the_cut_is_made_once(tmp_path: Path, cut: float, extend: str) -> None:
    """The motor that keeps a rate gives wheel and body opposite momenta, wherever the motion is cut."""
    table = {"times": [0.0, 10.0, 20.0], "values": [1.0, 5.0, 7.0], "interpolation": "step", "extend": extend}
    whole = {"name": "whole", "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": {"angular_velocity": [0.1, 0.2, -0.3]},
             "wheel": [{"type": "held", "axis": [1.0, 1.0, 0.0], "axial_inertia": 0.1, "rate": table}, {"type": "free", "axis": [0.0, 1.0, 1.0], "axial_inertia": 0.2, "rate": 2.0}]}
    write(tmp_path, "first", whole | {"solve": {"times": [0.0, cut], "tolerance": 1e-11}})
    later = going_on(whole, "first.toml", solve={"times": [cut, 25.0], "tolerance": 1e-10})
    later["wheel"][0]["rate"] = table
    got, want = gyrostat.solve(write(tmp_path, "second", later), ask="all"), gyrostat.solve(whole, times=[0.0, cut, 25.0], tolerance=1e-11, ask="all")
    for name in got:
        if name != "torque":
            assert np.allclose(got[name][-1], want[name][-1], atol=1e-8), name
    assert np.linalg.norm(got["angular_velocity"][0] - end_of(load(tmp_path / "first.toml")).angular_velocity) > 1e-3


@pytest.mark.parametrize("keep", ["rates", "momentum"])
@pytest.mark.parametrize("interpolation", ["linear", "step", "cubic"])
def test_a_table_that_takes_a_wheel_over_departs_from_the_rate_it_had(tmp_path: Path, interpolation: str, keep: str) -> None:
    """Whatever the table says of earlier times: the wheel goes on at 100 rad/s, and nothing turns the body."""
    wheel = {"name": "w", "type": "held", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.1, "rate": 100.0}
    first = {"name": "first", "body": {"inertia": [3.0, 4.0, 5.0]}, "wheel": [wheel], "initial": {"angular_velocity": [0.0, 0.0, 0.1]}, "solve": {"times": [10.0]}}
    table = {"times": [10.0, 15.0, 20.0], "values": [100.0, 100.0, 100.0], "interpolation": interpolation}
    later = going_on(first, str(write(tmp_path, "first", first)), solve={"times": [10.0, 12.0]}, wheel=[{**wheel, "rate": table}])
    later["from"] = {"file": later["from"], "keep": keep}
    assert np.allclose(gyrostat.solve(later)["angular_velocity"], [0.0, 0.0, 0.1], atol=1e-12)
    # begun at another rate it turns the body, as a motor does
    table["values"] = [120.0, 120.0, 120.0]
    assert np.allclose(gyrostat.solve(later)["angular_velocity"], [0.0, 0.0, 0.1 - 0.1 * 20.0 / 5.0], atol=1e-12)


@pytest.mark.parametrize("names", [["v"], [""], ["v", "w"]])
def test_a_table_departs_from_a_rate_that_is_known_as_well_as_the_scene_before_knows_it(tmp_path: Path, names: list[str]) -> None:
    """Wheels of rates known to 5 rad/s; a table takes the first over at what is thought to be its rate, and turns the body where it is not."""
    v = {"name": names[0], "type": "free", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.1, "rate": 100.0}
    others = [{"name": name, "type": "free", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.2, "rate": 50.0} for name in names[1:]]
    first = {"name": "first", "body": {"inertia": [3.0, 4.0, 5.0]}, "wheel": [v, *others], "initial": {"angular_velocity": [0.0, 0.0, 0.1]}, "solve": {"times": [10.0], "tolerance": 1e-9}}
    table = {"times": [10.0, 15.0, 20.0], "values": [105.0, 105.0, 105.0]}

    def solved(name: str, of: dict[str, Any]) -> gyrostat.Answer:
        later = going_on(first, str(write(tmp_path, name, of)), solve={"times": [10.0, 12.0]}, wheel=[{**v, "type": "held", "rate": table}, *({k: w[k] for k in w if k != "rate"} for w in others)])
        return gyrostat.solve(later, ask="all")

    answer = solved("known", copy.deepcopy(first) | {"initial": first["initial"] | {"error": {"rotor_rate": 5.0}}})
    assert not answer.met
    for rate in (95.0, 105.0):
        other = solved("other", copy.deepcopy(first) | {"wheel": [v | {"rate": rate}, *others]})
        for name in ("angular_velocity", "attitude", "angular_momentum_inertial"):
            off = np.abs(other[name] - answer[name]).max()
            assert off > 1e-2 and off <= answer.error[name] * max(answer.scale.get(name, 1.0), np.abs(answer[name]).max()), name


def test_a_momentum_is_shared_with_a_wheel_whose_table_is_under_way(tmp_path: Path) -> None:
    """Between two of its times a cubic table is the cubic that the motion follows."""
    table = {"times": [0.0, 4.0, 9.0, 20.0], "values": [10.0, 30.0, 20.0, 60.0], "interpolation": "cubic"}
    whole = {"name": "whole", "body": {"inertia": [3.0, 4.0, 5.0]}, "initial": {"angular_velocity": [0.1, -0.2, 0.1]},
             "wheel": [{"type": "held", "axis": [0.0, 0.6, 0.8], "axial_inertia": 0.1, "rate": table}]}
    write(tmp_path, "first", whole | {"solve": {"times": [7.0], "tolerance": 1e-11}})
    later = going_on(whole, str(tmp_path / "first.toml"), solve={"times": [7.0, 15.0], "tolerance": 1e-10}, wheel=copy.deepcopy(whole["wheel"]))
    later["from"] = {"file": later["from"], "keep": "momentum"}
    got, want = gyrostat.solve(later), gyrostat.solve(whole, times=[7.0, 15.0], tolerance=1e-11)
    assert np.allclose(got["angular_velocity"], want["angular_velocity"], atol=1e-9)


def test_wheels_without_a_name_are_not_taken_for_one_that_is_called_by_a_number(tmp_path: Path) -> None:
    wheels = [{"name": "2", "type": "free", "axis": [1.0, 0.0, 0.0], "axial_inertia": 0.1, "rate": 3.0}, {"type": "free", "axis": [0.0, 1.0, 0.0], "axial_inertia": 0.1, "rate": 5.0}]
    first = {"name": "first", "solve": {"times": [1.0]}, "body": {"inertia": [3.0, 2.5, 2.0]}, "wheel": wheels, "initial": {"angular_velocity": [0.0, 0.0, 0.1]}}
    write(tmp_path, "first", first)
    end = end_of(load(tmp_path / "first.toml")).wheels
    assert list(end) == ["2", 2]
    later = arguments(load(write(tmp_path, "second", going_on(first, "first.toml", solve={"times": [2.0]}))))
    assert [wheel["rate"] for wheel in later["wheels"]] == [end["2"][0], end[2][0]]


def test_a_wheel_that_is_called_otherwise_is_not_left_at_rest(tmp_path: Path) -> None:
    later = going_on(WHOLE, str(write(tmp_path, "first", WHOLE)))
    later["wheel"][1]["name"] = "B"
    with pytest.raises(DomainError, match="no wheel B, and b would go on nowhere"):
        gyrostat.solve(later)
    later["wheel"][1]["rate"] = 0.0
    assert gyrostat.solve(later)["rotor_rate"][0, 1] == 0.0
    later["wheel"] = [later["wheel"][0]]  # b is taken off
    gyrostat.solve(later)


def test_what_the_start_makes_too_great_is_told_with_the_tolerance_that_would_do(tmp_path: Path) -> None:
    first = copy.deepcopy(WHOLE)
    first["solve"]["tolerance"] = 1e-4
    answer = gyrostat.solve(going_on(first, str(write(tmp_path, "first", first))))
    (told,) = [warning.message for warning in answer.warnings if warning.code == "start-uncertain"]
    found = re.search(r"solve.tolerance = (\S+) in first.toml should do", told)
    assert not answer.met and found
    first["solve"]["tolerance"] = float(found[1])
    assert gyrostat.solve(going_on(first, str(write(tmp_path, "first", first)))).met


def test_rates_are_kept_by_default(tmp_path: Path) -> None:
    write(tmp_path, "first", WHOLE)
    lighter = going_on(WHOLE, str(tmp_path / "first.toml"), body={"inertia": [2.0, 1.9, 1.0], "mass": 2.0, "centre_of_mass": [0.0, 0.2, 0.0]})
    got, end = arguments(scene_from(lighter)), end_of(load(tmp_path / "first.toml"))
    assert got["angular_velocity"].tolist() == end.angular_velocity.tolist()
    R, arm = matrix_from_quaternion(end.attitude), np.array([-0.1, 0.2, -0.05])
    assert np.allclose(got["position"], end.position + R @ arm, rtol=1e-15)
    assert np.allclose(got["velocity"], end.velocity + R @ np.cross(end.angular_velocity, arm), rtol=1e-15)


def test_a_top_that_leaves_its_pivot_flies(tmp_path: Path) -> None:
    top = load("toy-top").replace(times=[0.5])
    flying: dict[str, Any] = {"name": "flying", "kind": "general", "from": "toy-top", "solve": {"duration": 0.2, "samples": 3}, "field": {"gravity": 9.80665},
              "body": {"inertia": [1e-4, 1e-4, 5e-5], "mass": 0.1, "centre_of_mass": [0.0, 0.0, 0.04]}}
    got = arguments(scene_from(flying))
    end = end_of(load("toy-top"))
    assert end.fixed and top.kind == "heavy"
    R, arm = matrix_from_quaternion(end.attitude), np.array([0.0, 0.0, 0.04])
    assert np.allclose(got["position"], R @ arm) and np.allclose(got["velocity"], R @ np.cross(end.angular_velocity, arm))
    with pytest.raises(DomainError, match="held at a point from now on"):
        arguments(scene_from(flying | {"from": "iss-drift", "body": {**flying["body"], "fixed": True}}))


def test_the_scene_before_may_be_of_any_kind() -> None:
    for name in ("toutatis", "cubesat-wheel-spin-up", "pam-d-burn", "envisat-detumble"):
        scene = load(name)
        wheels = [{"type": "free", "axis": scene.tables["rotor"]["axis"], "axial_inertia": 1e-4}] if scene.kind == "rotor" else []
        later = scene_from({"name": "later", "from": name, "solve": {"duration": 10.0, "samples": 2}, "body": {"inertia": [3.0, 2.5, 2.0]}, "wheel": wheels})
        assert later.start_time == scene.times[-1]
        answer = gyrostat.solve(later)
        assert answer.t[0] == scene.times[-1]
        if scene.kind == "rotor":
            assert answer["rotor_rate"][0, 0] == end_of(later.before).wheels[1][0]  # type: ignore[arg-type]


BAD = [
    ({"from": "nowhere"}, "nowhere: there is no such file"),
    ({"from": ""}, "the text is empty"),
    ({"from": 3}, "not text"),
    ({"from": {"file": "toutatis", "keep": "energy"}}, "use one of rates, momentum"),
    ({"from": {"keep": "rates"}}, "the key file is missing"),
    ({"solve": {"times": [1.0, 2.0]}}, "the motion begins at"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_mistakes(changes: dict[str, Any], message: str) -> None:
    scene: dict[str, Any] = {"name": "x", "kind": "general", "from": "iss-drift", "solve": {"duration": 1.0, "samples": 2}, "body": {"inertia": [3.0, 2.5, 2.0]}}
    with pytest.raises(SceneError, match=message):
        scene_from(scene | changes)


def test_a_scene_without_start_and_without_from_is_told_so() -> None:
    with pytest.raises(SceneError, match="initial: the table .initial. is missing"):
        scene_from({"name": "x", "kind": "general", "solve": {"duration": 1.0, "samples": 2}, "body": {"inertia": [3.0, 2.5, 2.0]}})
    with pytest.raises(SceneError, match="angular_velocity or angular_momentum"):
        scene_from({"name": "x", "kind": "general", "solve": {"duration": 1.0, "samples": 2}, "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": {}})


FIRST: dict[str, Any] = {"name": "first", "kind": "general", "solve": {"duration": 10.0, "samples": 3, "tolerance": 1e-9}, "body": {"inertia": [3.0, 2.5, 2.0]},
                         "initial": {"angular_velocity": ["3 deg/s", -0.5, 0.8]}}
SECOND: dict[str, Any] = {"name": "second", "kind": "general", "solve": {"times": [10.0, 20.0], "tolerance": 1e-8}, "body": {"inertia": [3.0, 2.5, 2.0]}}


def test_a_scene_and_an_answer_stand_in_the_place_of_a_file(tmp_path: Path) -> None:
    answer = gyrostat.solve(FIRST)
    kept = tmp_path / "answer.json"
    kept.write_text(answer.to_json())
    by_file = gyrostat.solve(SECOND | {"from": str(write(tmp_path, "first", FIRST))})
    for before in (answer, scene_from(FIRST), {"scene": FIRST}, {"scene": answer, "keep": "rates"}, gyrostat.Answer.from_json(kept)):
        scene = scene_from(SECOND | {"from": before})
        later = gyrostat.solve(scene)
        assert np.array_equal(later["attitude"], by_file["attitude"]) and later.error == by_file.error
        # the chain is one scene, which says all
        assert scene_from(tomllib.loads(toml_text(scene.to_dict()))) == scene
        assert np.array_equal(gyrostat.solve(later.scene)["attitude"], by_file["attitude"])
    assert np.array_equal(gyrostat.solve(scene_from(SECOND | {"from": "iss-drift", "solve": {"duration": 1.0, "samples": 2}}), **{"from": answer, "times": [10.0, 20.0]})["attitude"],
                          by_file["attitude"])


def test_what_is_written_out_in_the_place_of_a_file_is_read_as_one() -> None:
    for before, message in (({"scene": 3}, "not a table"), ({"scene": FIRST, "file": "iss-drift"}, "both given"), ({"scene": FIRST | {"body": {}}}, "from.scene: body.inertia: the key is missing")):
        with pytest.raises(SceneError, match=message):
            scene_from(SECOND | {"from": before})
    chain = FIRST
    for _ in range(17):
        chain = SECOND | {"from": {"scene": chain}}
    with pytest.raises(SceneError, match="over 16 scenes go on"):
        scene_from(chain)
    pushed = general.solve(inertia=[3.0, 2.5, 2.0], angular_velocity=[0.3, -0.5, 0.8], times=[10.0], torque=lambda *_: np.array([0.0, 0.0, 0.1]))
    with pytest.raises(DomainError, match="a torque of your own"):
        gyrostat.solve(SECOND | {"from": pushed})


def test_circles_and_long_chains_are_refused(tmp_path: Path) -> None:
    one = {"name": "one", "from": "two.toml", "solve": {"duration": 1.0, "samples": 2}, "body": {"inertia": [3.0, 2.5, 2.0]}}
    write(tmp_path, "one", one)
    file = write(tmp_path, "two", {**one, "from": "one.toml"})
    with pytest.raises(SceneError, match="goes on from this scene in turn"):
        load(file)
    write(tmp_path, "scene0", WHOLE)
    for i in range(1, 18):
        write(tmp_path, f"scene{i}", {**one, "from": f"scene{i - 1}.toml"})
    assert load(tmp_path / "scene15.toml").start_time == 54.0
    with pytest.raises(SceneError, match="over 16 scenes go on from each other"):
        load(tmp_path / "scene17.toml")


# ---- bodies without their wheels ----


def steiner(mass: float, arm: Any) -> Any:
    arm = np.asarray(arm)
    return mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("about", ["reference", "mass-centre", "origin"])
def test_wheels_beside_the_inertia_are_added(fixed: bool, about: str) -> None:
    centre, place, u = np.array([0.1, 0.0, 0.05]), np.array([0.2, -0.1, 0.3]), np.array([0.6, 0.0, 0.8])
    wheel = {"type": "free", "axis": [3, 0, 4], "axial_inertia": 0.02, "mass": 0.5, "position": place.tolist(), "equatorial_inertia": 0.015}
    scene = scene_from({"name": "x", "kind": "general", "solve": {"times": [1.0]}, "wheel": [wheel], "initial": {"angular_velocity": [0.1, 0.2, 0.3]},
                        "body": {"inertia": [3.0, 2.5, 2.0], "mass": 4.0, "centre_of_mass": centre.tolist(), "fixed": fixed, "inertia_about": about,
                                 "wheels_in_inertia": False}})
    own = np.diag([3.0, 2.5, 2.0]) - (steiner(4.0, centre) if about == "origin" or (about == "reference" and fixed) else 0.0)
    all_centre = (4 * centre + 0.5 * place) / 4.5
    point = np.zeros(3) if fixed else all_centre
    want = own + steiner(4.0, centre - point) + 0.015 * np.eye(3) + 0.005 * np.outer(u, u) + steiner(0.5, place - point)
    got = arguments(scene)
    assert np.allclose(got["inertia"], want, rtol=1e-15, atol=1e-15)
    assert got["mass"] == 4.5
    assert np.allclose(got["centre_of_mass"], all_centre, rtol=1e-15)


APART = {"mass": 0.5, "position": [0, 0, 0.1], "equatorial_inertia": 0.015}


@pytest.mark.parametrize(("within", "keys", "message"), [
    (True, {"mass": 0.5}, "mass is given, but its inertia is part of body.inertia"),
    (False, {}, "the key mass is missing, and the body is without its wheels"),
    (False, {**APART, "equatorial_inertia": 0.005}, "below half of axial_inertia"),
])
def test_wheels_are_in_the_inertia_or_not(within: bool, keys: dict[str, Any], message: str) -> None:
    wheel = {"type": "free", "axis": [0, 0, 1], "axial_inertia": 0.02, **keys}
    with pytest.raises(SceneError, match=message):
        scene_from({"name": "x", "kind": "general", "solve": {"times": [1.0]}, "wheel": [wheel], "initial": {"angular_velocity": [0.1, 0.2, 0.3]},
                    "body": {"inertia": [3.0, 2.5, 2.0], "wheels_in_inertia": within}})


# ---- angles of the attitude ----


@pytest.mark.parametrize("sequence", ["3-2-1", "ZXZ", "1-2-3"])
def test_angles_are_those_that_a_start_takes(sequence: str) -> None:
    answer = gyrostat.solve("gravity-gradient-boom", **{"solve.euler": sequence, "solve.ask": ["attitude", "euler"]})
    for row in (1, 100, 480):
        start = {"angular_velocity": [0.0, 0.0, 0.0], "euler": {"sequence": sequence, "angles": answer["euler"][row].tolist()}}
        told = scene_from({"name": "x", "solve": {"times": [0.0]}, "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": start})
        assert angle_between(np.array(told.tables["initial"]["attitude"]), answer["attitude"][row]) < 1e-14
    steps = np.abs(np.diff(answer["euler"], axis=0))
    assert np.max(steps) < np.pi
    assert answer.error["euler"] >= answer.error["attitude"]


def test_turns_that_are_not_counted_are_told() -> None:
    scene: dict[str, Any] = {"name": "x", "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": {"angular_velocity": [0.0, 0.0, 1.0]},
                             "solve": {"duration": 20.0, "euler": "3-2-1", "ask": ["euler"]}}
    few, many = (gyrostat.solve(scene, samples=n) for n in (3, 30))
    assert [warning.code for warning in few.warnings] == ["turns-untold"] and not many.warnings
    assert many["euler"][-1, 0] == pytest.approx(20) and (few["euler"][-1, 0] - 20) / (2 * np.pi) == pytest.approx(round((few["euler"][-1, 0] - 20) / (2 * np.pi)))


def test_a_sequence_asks_for_the_angles() -> None:
    for ask in (None, ["attitude"], {"attitude": "0.1 deg"}, "all", ["euler"]):
        changes = {} if ask is None else {"solve.ask": ask}
        assert "euler" in gyrostat.solve(WHOLE, **changes, **{"solve.euler": "ZYX"})
    assert "euler" not in gyrostat.solve(WHOLE)
    met = gyrostat.solve(WHOLE, **{"solve.euler": "ZYX", "solve.ask": {"euler": "1 deg"}})
    assert met.met and list(met) == ["euler"] and met.tolerances["euler"] == pytest.approx(np.pi / 180)
    with pytest.raises(SceneError, match="the sequence of the angles is not said"):
        gyrostat.solve(WHOLE, ask=["euler"])
    with pytest.raises(SceneError, match="nothing acts along field.down"):
        gyrostat.solve(WHOLE, ask={"down": 1e-3})
    alone = {"name": "alone", "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": {"angular_velocity": [0.1, 0.0, 0.2]}, "solve": {"times": [1.0]}}
    for column, why in (("rotor_rate", "there is no wheel"), ("attitude_orbit", "there is no orbit")):
        with pytest.raises(SceneError, match=why):
            gyrostat.solve(alone, ask=[column])
    with pytest.raises(SceneError, match="held at its origin"):
        gyrostat.solve({**alone, "body": {"inertia": [3.0, 2.5, 2.0], "fixed": True}}, kind="general", ask=["position"])
    with pytest.raises(SceneError, match="neighbours different"):
        gyrostat.solve(WHOLE, **{"solve.euler": "3-3-1"})


# ---- a start at another time, or known to within an error ----


def test_a_start_may_be_given_at_any_time() -> None:
    end = gyrostat.solve(WHOLE, times=[40.0], tolerance=1e-13, ask="all")
    start = {"time": 40.0, "attitude": end["attitude"][0].tolist(), "angular_velocity": end["angular_velocity"][0].tolist()}
    later = copy.deepcopy(WHOLE) | {"solve": {"times": LATER, "tolerance": 1e-9}, "initial": start}
    for wheel, rate, angle in zip(later["wheel"], end["rotor_rate"][0], end["rotor_angle"][0], strict=True):
        wheel |= {"rate": float(rate), "angle": float(angle)}
    got, want = gyrostat.solve(later), gyrostat.solve(WHOLE, times=LATER, tolerance=1e-12)
    for name in got:
        assert off(got, want, name) <= got.error[name] + want.error[name] + 20 * end.error["attitude"], name
    with pytest.raises(SceneError, match="the motion begins at 40.0 s"):
        scene_from(later, times=[39.0, 50.0])
    with pytest.raises(SceneError, match="the clock goes on from the scene before"):
        scene_from(later | {"from": "iss-drift"})


@pytest.mark.parametrize("start", [5e7, 1e9, 3e12])
def test_a_clock_loses_no_phase_however_late(start: float) -> None:
    late = phase(1.3, start, 0.3)
    turns = Fraction(1.3) * Fraction(start) + Fraction(0.3) - Fraction(late)
    whole = turns / (2 * Fraction(PI))
    assert abs(late) <= math.pi and abs(whole - round(whole)) < 1e-16
    # mean motion 1 to the bit: half an axis of 1, mu 1
    orbit = {"radius": 0.5, "mu": 1.0, "eccentricity": 0.5, "true_anomaly": 0.0, "radial": np.array([1.0, 0, 0]), "along": np.array([0, 1.0, 0]),
             "told": {"lengths": (0.5,)}}
    there = orbit_since(start, orbit)
    E = 2 * math.atan2(math.sqrt(0.5) * math.sin(there["true_anomaly"] / 2), math.sqrt(1.5) * math.cos(there["true_anomaly"] / 2))
    assert math.remainder(E - 0.5 * math.sin(E) - phase(1.0, start), 2 * math.pi) == pytest.approx(0, abs=4e-15)
    assert there["radius"] == pytest.approx(1 - 0.5 * math.cos(E), rel=4e-15)


@pytest.mark.parametrize(("eccentricity", "anomaly", "rest"), [(0.99, 0.0, 490000.0), (0.999, 0.0, 499000.0), (0.3, 2.5, 1234.5), (0.0, 0.0, 250000.0)])
def test_an_orbit_is_the_same_many_periods_later(eccentricity: float, anomaly: float, rest: float) -> None:
    period = 500000.0

    def solved(turns: int) -> Any:
        begin = turns * period + rest
        return gyrostat.solve({"name": "late", "kind": "general", "body": {"inertia": [1.0, 2.0, 2.5]}, "torque": [{"type": "gravity-gradient"}],
                               "orbit": {"eccentricity": eccentricity, "true_anomaly": anomaly, "period": period},
                               "initial": {"time": begin, "attitude": [0.1, 0.2, 0.3, 0.9], "angular_velocity": [0.0, 0.0, 0.018]},
                               "solve": {"times": [begin + 12500.0], "tolerance": 1e-9, "ask": "all"}})

    first, late = solved(0), solved(299)
    for column in ("attitude", "angular_velocity", "attitude_orbit"):
        # the same to the digits of one answer, and what a rounding of the period does in as many turns is stated
        assert off(late, first, column) <= first.error[column], column
        assert late.error[column] > 20 * first.error[column] or eccentricity < 0.9


def test_a_wave_that_began_long_ago_acts_as_one_that_begins_now() -> None:
    start = 5e7
    times = np.array([2.5, 10.0, 50.0])

    def solved(begin: float, first: float) -> Any:
        wave = {"mean": 0.0, "amplitude": 1.0, "rate": 1.3, "phase": first}
        return gyrostat.solve({"name": "late", "kind": "general", "solve": {"times": (begin + times).tolist(), "tolerance": 1e-6, "ask": "all"},
                               "body": {"inertia": [30.0, 20.0, 15.0]}, "torque": [{"type": "constant", "torque": [0.1, 0.2, -0.1], "factor": wave}],
                               "initial": {"angular_velocity": [0.01, 0.02, 0.03], "time": begin}})

    late, now = solved(start, 0.3), solved(0.0, phase(1.3, start, 0.3))
    for column in ("attitude", "angular_velocity", "torque"):
        assert np.array_equal(late[column], now[column])
        assert late.error[column] > now.error[column]  # what a rounding of the rate has done in so many turns


@pytest.mark.parametrize("model", ["auto", "full"])
@pytest.mark.parametrize("begin", [285120.1, 285120.2, 285120.3])
def test_a_pulse_by_a_clock_that_began_before_lasts_as_long_as_it_does(begin: float, model: str) -> None:
    pulse = [864000.3, 864000.312]
    answer = gyrostat.solve({"name": "late", "kind": "general", "solve": {"times": [864010.0], "tolerance": 1e-9, "model": model, "ask": ["angular_velocity"]},
                             "body": {"inertia": [1.0, 1.2, 2.0]}, "torque": [{"type": "constant", "torque": [0.0, 0.0, 2.0], "on": [pulse]}],
                             "initial": {"angular_velocity": [0.0, 0.0, 0.01], "time": begin}})
    gained = Fraction(0.01) + Fraction(pulse[1]) - Fraction(pulse[0])
    off = abs(float(Fraction(float(answer["angular_velocity"][0, 2])) / gained - 1))
    assert off <= answer.error["angular_velocity"]
    exact = all(Fraction(t) - Fraction(begin) == Fraction(t - begin) for t in pulse)
    assert answer.met == exact  # what its times lose is stated, and nothing where they lose nothing


def test_an_error_of_the_start_is_part_of_the_answer() -> None:
    exact = gyrostat.solve(WHOLE, tolerance=1e-2)
    for size in (1e-7, 1e-4):
        known = {**WHOLE["initial"], "error": {"angular_velocity": size}}
        answer = gyrostat.solve(WHOLE | {"initial": known}, tolerance=1e-2)
        worst = 0.0
        for axis in range(3):
            moved = np.array(WHOLE["initial"]["angular_velocity"]) + size * np.eye(3)[axis]
            other = gyrostat.solve(WHOLE | {"initial": {**WHOLE["initial"], "angular_velocity": moved.tolist()}}, tolerance=1e-2)
            worst = max(worst, off(other, exact, "attitude"))
        assert worst - exact.error["attitude"] <= answer.error["attitude"] <= 3 * worst + 2 * exact.error["attitude"]
    told = gyrostat.solve(WHOLE | {"initial": {**WHOLE["initial"], "error": {"attitude": "0.1 deg", "position": "3 m"}}}, ask="all", tolerance=1e-2)
    assert told.error["attitude"] > 1.7e-3


def test_the_function_tells_its_scene_with_clock_and_error() -> None:
    answer = gyrostat.solve("wheel-seized")
    given = FAMILIES["general"].arguments(load("wheel-seized"))
    direct = FAMILIES["general"].solve(**given)
    assert direct.scene["initial"]["time"] == 90.0
    again = gyrostat.solve(direct.scene)
    for name in answer:
        assert np.array_equal(again[name], answer[name]) and again.error[name] == answer.error[name]


def test_a_wheel_that_keeps_its_absolute_rate_carries_what_the_bodys_rate_was_off(tmp_path: Path) -> None:
    wheel = {"name": "w", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.01}
    first = {"name": "held", "kind": "general", "solve": {"times": [10.0]}, "body": {"inertia": [1.0, 1.2, 1.5]},
             "wheel": [{**wheel, "type": "held", "rate": 1.0}], "initial": {"angular_velocity": [0.0, 0.0, 1.0], "error": {"angular_velocity": 1e-3}}}

    def caught(rate: float) -> gyrostat.Answer:
        start = {"angular_velocity": [0.0, 0.0, rate], **({"error": {"angular_velocity": 1e-3}} if rate == 1 else {})}
        file = tmp_path / f"first{rate}.toml"
        file.write_text(toml_text({**first, "initial": start}))
        return gyrostat.solve({"name": "free", "kind": "general", "from": {"file": str(file), "keep": "momentum"}, "solve": {"times": [11.0, 20.0], "ask": ["rotor_rate"]},
                               "body": {"inertia": [100.0, 120.0, 150.0]}, "wheel": [{**wheel, "type": "free"}]})

    stated, true = caught(1.0), caught(1.001)
    off = np.max(np.abs(stated["rotor_rate"] - true["rotor_rate"])) / np.max(np.abs(true["rotor_rate"]))
    assert off == pytest.approx(4.97e-4, rel=1e-2)
    assert off <= stated.error["rotor_rate"] < 3 * off


def test_a_given_momentum_leaves_to_the_body_what_the_wheels_may_be_off(tmp_path: Path) -> None:
    wheel = {"type": "motor", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.5, "slope": 0.05, "no_load_rate": 20.0}

    def second(rate: float) -> gyrostat.Answer:
        file = tmp_path / f"first{rate}.toml"
        file.write_text(toml_text({"name": "first", "kind": "general", "solve": {"times": [10.0], "tolerance": 0.1}, "body": {"inertia": [1.0, 2.0, 2.5]},
                                   "wheel": [{**wheel, "rate": rate}], "initial": {"angular_velocity": [0.1, 1.0, 0.2], "error": {"rotor_rate": 0.2}}}))
        return gyrostat.solve({"name": "second", "from": str(file), "solve": {"times": [10.0], "tolerance": 0.1, "ask": ["angular_velocity", "rotor_rate"]},
                               "body": {"inertia": [1.0, 2.0, 2.5]}, "wheel": [wheel], "initial": {"angular_momentum": [1.0, 0.5, 0.3]}})

    stated = second(3.0)
    for rate in (2.8, 3.2):
        true = second(rate)["angular_velocity"]
        off = np.linalg.norm(stated["angular_velocity"] - true) / np.linalg.norm(true)
        assert 1e-3 < off <= stated.error["angular_velocity"] < 10 * off


def test_a_scene_goes_on_from_one_that_ends_before_the_clock_reaches_zero(tmp_path: Path) -> None:
    body, rates = "[body]\ninertia = [1.0, 2.0, 2.5]\n", []
    for begin in (-5.0, 5.0):
        (tmp_path / "a.toml").write_text(f'name = "a"\n[solve]\nduration = 2.0\nsamples = 3\n{body}[initial]\ntime = {begin}\nangular_velocity = [0.1, 0.2, 0.3]\n', encoding="utf-8")
        (tmp_path / "b.toml").write_text(f'name = "b"\nfrom = "a.toml"\n[solve]\nduration = 10.0\nsamples = 3\n{body}', encoding="utf-8")
        answer = gyrostat.solve(tmp_path / "b.toml")
        assert answer.met and answer.t[0] == begin + 2
        rates.append(answer["angular_velocity"])
    np.testing.assert_array_equal(*rates)


def test_a_body_that_a_brake_has_stopped_is_at_rest_where_another_scene_goes_on(tmp_path: Path) -> None:
    body = "[body]\ninertia = [10.0, 12.0, 8.0]\n"
    brake = '[[torque]]\ntype = "brake"\nlimit = [0.1, 0.1, 0.1]\nlaw = "carrier"\n'
    (tmp_path / "a.toml").write_text(f'name = "a"\n[solve]\nduration = 30.0\nsamples = 2\n{body}{brake}[initial]\nangular_velocity = [0.1, 0.05, -0.02]\n', encoding="utf-8")
    later = 'name = "b"\nfrom = "a.toml"\n[solve]\nduration = 30.0\nsamples = 3\nask = ["attitude", "angular_velocity"]\n'
    (tmp_path / "b.toml").write_text(later + body, encoding="utf-8")
    answer = gyrostat.solve(tmp_path / "b.toml")
    assert answer.met and answer.error["angular_velocity"] == 0 and not np.any(answer["angular_velocity"])
    # one that may be let go again is not known to be at rest
    (tmp_path / "a.toml").write_text((tmp_path / "a.toml").read_text(encoding="utf-8").replace("[initial]", "on = [[0.0, 40.0]]\n[initial]"), encoding="utf-8")
    assert gyrostat.solve(tmp_path / "b.toml").error["angular_velocity"] > 0


def test_a_wheel_that_seizes_keeps_its_angle_and_turns_on_from_it(tmp_path: Path) -> None:
    def scene(name: str, kind: str, rest: str) -> str:
        return (f'name = "{name}"\n{rest}[solve]\nduration = 10.0\nsamples = 3\nask = "all"\n[body]\ninertia = [2.0, 3.0, 4.0]\n'
                f'[[wheel]]\nname = "x"\ntype = "{kind}"\naxis = [1, 0, 0]\naxial_inertia = 0.1\n')

    first = scene("a", "free", "") + "rate = 1.0\n[initial]\nangular_velocity = [0.1, 0.2, 0.3]\n"
    for name, text in (("a", first), ("b", scene("b", "locked", 'from = "a.toml"\n')), ("c", scene("c", "free", 'from = "b.toml"\n'))):
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    a, b, c = (gyrostat.solve(tmp_path / f"{name}.toml")["rotor_angle"][:, 0] for name in "abc")
    assert abs(a[-1]) > 10
    np.testing.assert_array_equal(b, np.full(3, b[0]))
    np.testing.assert_allclose([b[0], c[0]], a[-1], rtol=1e-9)
