# SPDX-License-Identifier: BSD-3-Clause
"""Designs of a thrusting spinner: over arrays, in a scene checked by its full motion, and on the command line."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import DomainError, design, spinning
from gyrostat.cli import main
from gyrostat.design import design_scene
from gyrostat.scenes import scene_from
from gyrostat.toml_text import toml_text

BODY: dict[str, Any] = {"inertia": [2985.0, 2729.0, 4183.0], "torque": [4.0, -2.0, 0.0]}


def scene(**changes: Any) -> gyrostat.Scene:
    return scene_from({
        "name": "stage", "kind": "spinning", "solve": {"duration": 60.0, "samples": 31, "tolerance": 1e-3},
        "body": {"inertia": BODY["inertia"], "mass": 2017.0},
        "torque": {"body": BODY["torque"], "force": [2.0, -1.0, 400.0]},
        "initial": {"angular_velocity": [0.0, 0.0, 0.33]},
    }, **changes)


def test_the_least_spin_over_arrays() -> None:
    budgets, rotors = np.array([1e-3, 1e-2, 0.1]), np.array([[0.0], [40.0], [-40.0]])
    for sense in (1.0, -1.0):
        made = design.spin_for_pointing(**BODY, budget=budgets, rotor_momentum=rotors, sense=sense)
        assert made.value.shape == (3, 3) and np.all(made.why == "") and np.all(np.sign(made.value) == sense)
        error = spinning.pointing_error(**BODY, spin_rate=made.value, rotor_momentum=rotors)
        # where stability limits the spin it points better than asked
        assert np.allclose(error[~made.unstable], np.broadcast_to(budgets, (3, 3))[~made.unstable], rtol=1e-12)
        assert np.all(error[made.unstable] <= np.broadcast_to(budgets, (3, 3))[made.unstable] * (1 + 1e-12))
        assert not np.any(made.unstable[0]) and np.all(made.tilt_bound[0] >= budgets)


def test_what_has_no_design_is_nan_and_says_why() -> None:
    none = design.spin_for_pointing(inertia=[[3.0, 2.0, 2.5], [2.0, 2.5, 3.0]], torque=[[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]], budget=0.1)
    assert np.all(np.isnan(none.value)) and none.why.tolist() == ["not-covered", "no-torque"]
    with pytest.raises(gyrostat.DomainError, match="row 1: budget = -0.1"):
        design.spin_for_pointing(**BODY, budget=[0.1, -0.1])
    with pytest.raises(gyrostat.DomainError, match="below|< pi/2"):
        design.torque_for_direction(**BODY, force=[0.0, 0.0, 1.0], angular_velocity=[0.0, 0.0, 1.0], budget=1.6)


def test_torques_and_burns_meet_the_budget_of_the_linear_motion() -> None:
    given: dict[str, Any] = {**BODY, "force": [2.0, -1.0, 400.0], "angular_velocity": [0.0, 0.0, 0.33]}
    torque = design.torque_for_direction(**given, budget=0.01)
    scaled = {**given, "torque": np.array(BODY["torque"]) * float(torque.value) / math.hypot(*BODY["torque"])}
    assert np.linalg.norm(spinning.secular_velocity_ratio(**scaled)) == pytest.approx(math.tan(0.01), rel=1e-12)
    burn = design.burn_for_displacement(**given, mass=2017.0, budget=[1.0, 10.0])
    x = spinning.linear(**given, mass=2017.0, t=burn.value).position
    assert np.hypot(x[:, 0], x[:, 1]) == pytest.approx([1.0, 10.0], rel=1e-12)
    burn = design.burn_for_velocity(**given, mass=2017.0, budget=[1.0, 10.0])
    assert np.linalg.norm(spinning.linear(**given, mass=2017.0, t=burn.value).velocity, axis=1) == pytest.approx([1.0, 10.0], rel=1e-12)


@pytest.mark.parametrize(("goal", "budget", "key"), [
    ("spin-for-pointing", 0.005, "initial.angular_velocity"), ("torque-for-direction", 0.01, "torque.body"),
    ("burn-for-displacement", 5.0, "solve.duration"), ("burn-for-velocity", 10.0, "solve.duration")])
def test_the_full_motion_of_the_designed_scene_finds_the_budget(goal: str, budget: float, key: str) -> None:
    for changes in ({}, {"initial.euler_312": [0.002, -0.001, 0.7], "initial.velocity": [1.0, 2.0, 3.0]}, {"body.rotor_momentum": 150.0},
                    {"initial.angular_velocity": [0.0, 0.0, -0.5]}):
        asked = scene(**changes)
        made = design_scene(asked, goal, budget)
        assert made.confirmed and made.met and not made.warnings
        assert abs(made.found / budget - 1) < 2e-3
        before, after = asked.to_dict(), made.scene.to_dict()
        table, name = key.split(".")
        assert before[table].pop(name) != after[table].pop(name)
        assert "source" not in before and goal in after.pop("source")
        assert before == after


def test_a_study_that_varies_the_designed_number_as_before_is_told() -> None:
    study = scene().replace(vary={"n": 10, "initial.angular_velocity[2]": "normal(50 rpm, 5%)", "body.inertia[2]": "normal(3000, 1%)"})
    told = [text for text in design_scene(study, "spin-for-pointing", 0.005).warnings if text.startswith("varies-as-before: ")]
    assert len(told) == 1 and "initial.angular_velocity[2] = normal(50 rpm, 5%)" in told[0] and "inertia" not in told[0]
    assert not [text for text in design_scene(study, "burn-for-velocity", 10.0).warnings if "vary" in text]


def test_a_start_that_leans_by_more_than_the_budget_is_told() -> None:
    nutating = scene(**{"initial.angular_velocity": [0.01, 0.0, 0.33]})
    made = design_scene(nutating, "spin-for-pointing", 0.005)
    alone = 0.01 * BODY["inertia"][0] / (BODY["inertia"][2] * made.value)
    assert made.confirmed and [text for text in made.warnings if text.startswith("start-leans-more: ") and f" {alone:.3g} rad " in text]
    assert not [text for text in design_scene(scene(), "spin-for-pointing", 0.005).warnings if "start" in text]


def test_a_goal_that_the_linear_motion_cannot_tell_is_not_confirmed() -> None:
    made = design_scene(scene(), "torque-for-direction", 0.6)
    assert not made.confirmed and any("beyond-small-tilt" in text for text in made.warnings)
    assert made.to_dict()["asked"] == 0.6


@pytest.mark.parametrize(("changes", "goal", "budget", "words"), [
    ({"torque.body": [0.0, 0.0, 0.0]}, "spin-for-pointing", 0.01, "no torque acts across axis 3"),
    ({"body.inertia": [4183.0, 2729.0, 2985.0]}, "spin-for-pointing", 0.01, "no stable spin"),
    ({"body.inertia": [4183.0, 2729.0, 2985.0]}, "torque-for-direction", 0.01, "the spin is unstable"),
    ({"torque.body": [1.0, 0.0, 1.0]}, "burn-for-velocity", 1.0, "torque acts about axis 3"),
    ({"torque.body": [1.0, 0.0, 1.0]}, "torque-for-direction", 0.01, "torque acts about axis 3: the spin is not constant$"),
    ({"torque.body": [1.0, 0.0, 1.0]}, "spin-for-pointing", 0.01, "torque acts about axis 3: the spin is not constant$"),
    ({"torque.force": [1.0, 0.0, 0.0]}, "torque-for-direction", 0.01, "no force acts along axis 3$"),
    ({"initial.angular_velocity": [0.01, 0.0, 0.0]}, "torque-for-direction", 0.01, "it does not spin about axis 3$"),
    ({"initial.euler_312": [0.02, 0.0, 0.0]}, "torque-for-direction", 0.01, "start alone lean the mean direction of axis 3 by 0.02 rad, which is over"),
    ({"body.rotor_momentum": -2091.5, "initial.angular_velocity": [0.0, 0.0, 0.5]}, "torque-for-direction", 0.01, "no gyroscopic stiffness$"),
    ({"torque.force": [0.0, 0.0, 0.0]}, "burn-for-displacement", 1.0, "no force acts"),
    ({"body.rotor_momentum": -600.0}, "spin-for-pointing", 0.007, "stability, not pointing"),
    ({}, "spin-for-pointing", 0.0, "budget = 0"),
    ({}, "spin-for-pointing", math.nan, "budget = nan"),
    ({}, "spin", 0.1, "use one of"),
    ({}, "spin-for-pointing", 1e300, "says nothing there"),
    ({"torque.force": [0.0, 0.0, 400.0]}, "torque-for-direction", math.pi / 2, "says nothing there"),
    ({}, "burn-for-velocity", 1e300, "budget = 1e[+]300: give a finite number > 0 with a square that a double holds"),
])
def test_what_cannot_be_designed_is_refused(changes: dict[str, Any], goal: str, budget: float, words: str) -> None:
    with pytest.raises(gyrostat.DomainError, match=words):
        design_scene(scene(**changes), goal, budget)


def test_the_limit_of_stability_is_told() -> None:
    with pytest.raises(gyrostat.DomainError, match="beyond") as told:
        design_scene(scene(**{"body.rotor_momentum": -600.0}), "spin-for-pointing", 0.007)
    limit = float(str(told.value).split("beyond ")[1].split()[0])
    assert limit == pytest.approx(600.0 / (4183.0 - 2985.0), rel=1e-8)


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, designed = tmp_path / "stage.toml", tmp_path / "designed.toml"
    file.write_text(toml_text(scene().to_dict()))
    assert main(["design", str(file), "--spin-for-pointing", "0.005", "-o", str(designed)]) == 0
    out = capsys.readouterr().out
    for part in ("least spin rate for 0.005 rad", "asked", "found", "confirmed", str(designed)):
        assert part in out
    spin = tomllib.loads(designed.read_text())["initial"]["angular_velocity"][2]
    assert spinning.pointing_error(**BODY, spin_rate=spin) == pytest.approx(0.005, rel=1e-12)
    assert main(["solve", str(designed)]) == 0
    capsys.readouterr()

    assert main(["design", str(file), "--spin-for-pointing", "5 mrad", "--json"]) == 0
    made = json.loads(capsys.readouterr().out)
    assert made["value"] == spin and made["confirmed"] and made["scene"]["initial"]["angular_velocity"] == [0.0, 0.0, spin]
    assert gyrostat.solve(made["scene"]).met

    assert main(["design", str(file), "--burn-for-velocity", "2.0"]) == 0
    assert "duration = " in capsys.readouterr().out
    assert main(["design", str(file), "--torque-for-direction", "0.6"]) == 3
    assert "NOT confirmed" in capsys.readouterr().out
    assert main(["design", str(file), "--torque-for-direction", "2.0"]) == 2
    assert main(["design", "tiangong-1", "--spin-for-pointing", "0.1"]) == 2
    assert "designs are known for the kind spinning" in capsys.readouterr().err
    for wrong in ([], ["--spin-for-pointing", "0.5kg"], ["--spin-for-pointing", "1", "--burn-for-velocity", "1"]):
        with pytest.raises(SystemExit) as left:
            main(["design", str(file), *wrong])
        assert left.value.code == 2


def test_toml_text_reads_back() -> None:
    data = {"name": 'a "quoted" \\ name\n\x7f é', "flag": True, "solve": {"times": [0.0, 1e-300, 0.1 + 0.2], "samples": 5, "tolerance": 1e-06},
            "body": {"inertia": [[1.0, 0.5], [0.5, -2.5e22]]}}
    assert tomllib.loads(toml_text(data)) == data


def test_a_budget_beyond_the_search_is_not_told_as_never_reached() -> None:
    spinner = {"inertia": [0.867, 0.9754, 0.5528], "torque": [-2.1e-7, 2.38e-7, 0.0], "force": [-3.3e-4, 0.0, 0.0], "angular_velocity": [0.0, 0.0, 1.0]}
    made = design.burn_for_displacement(**spinner, mass=1e9, budget=1.8)
    assert np.isnan(made.value) and made.why == "too-long"


def test_a_general_scene_of_a_spinning_body_is_designed_as_that() -> None:
    stage: dict[str, Any] = {
        "name": "stage", "solve": {"times": [60.0], "tolerance": 1e-4}, "body": {"inertia": [2400.0, 2400.0, 700.0], "mass": 2500.0},
        "torque": [{"type": "thrust", "force": [0.0, 0.0, 4e4], "point": [0.0, 0.002, -1.5]}], "initial": {"angular_velocity": [0.0, 0.0, 2.6]}}
    design = design_scene(scene_from(stage), "spin-for-pointing", math.radians(1))
    told = {"name": "stage", "kind": "spinning", "solve": stage["solve"], "body": stage["body"], "torque": {"body": [80.0, 0.0, 0.0], "force": [0.0, 0.0, 4e4]},
            "initial": stage["initial"]}
    assert design.scene.kind == "spinning" and design.value == design_scene(scene_from(told), "spin-for-pointing", math.radians(1)).value
    stage["torque"].append({"type": "damping", "coefficient": 0.1})
    with pytest.raises(DomainError, match="gyrostat recognise tells why"):
        design_scene(scene_from(stage), "spin-for-pointing", math.radians(1))


def test_what_varies_in_a_general_scene_is_told_to_be_left_out() -> None:
    stage: dict[str, Any] = {
        "name": "stage", "solve": {"times": [60.0], "tolerance": 1e-4}, "body": {"inertia": [2400.0, 2400.0, 700.0], "mass": 2500.0},
        "torque": [{"name": "motor", "type": "thrust", "force": [0.0, 0.0, 4e4], "point": [0.0, 0.002, -1.5]}],
        "initial": {"angular_velocity": [0.0, 0.0, 2.6]}, "vary": {"n": 4, "torque.motor.point[1]": "normal(2 mm, 1 mm)"}}
    design = design_scene(scene_from(stage), "spin-for-pointing", math.radians(1))
    assert any("vary-left-out" in warning and "torque.motor.point[1]" in warning for warning in design.warnings) and not design.scene.vary
