# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: what is drawn, the same bits however a sweep is cut, rows without an answer, files, the commands."""

import csv
import itertools
import json
import math
import re
import struct
import subprocess
import sys
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
import xarray
from conftest import ASSEMBLED, GOOD, HEAVY, PERIODIC, ROTOR, SPINNING, kinds
from gyrostat import DomainError, SceneError, sweep, sweep_files
from gyrostat.cli import main
from gyrostat.families import FAMILIES
from gyrostat.rotation import angle_between
from gyrostat.rows import numbers_of, place_of, plan_of
from gyrostat.scenes import bundled, load, scene_from
from gyrostat.sweep_report import drawings, missed_by, rank_correlations, responses, sobol_indices, tables, variance_shares
from gyrostat.sweeps import merge, open_results, save
from gyrostat.toml_text import toml_text
from gyrostat.vary import DESIGNS, Plan, Varied, choice, grid, linspace, lognormal, logspace, normal, number_in, read_words, uniform

VARY: dict[str, Any] = {"torque.control[0]": normal(0.06, "5%"), "body.inertia[0]": uniform(16000, 17000), "torque.drag": lognormal(1.2e-6, "20%")}
LIGHT: dict[str, Any] = {"tolerance": 1e-2, "times": [10000.0, 40000.0], "ask": ["stop_time", "angular_momentum_norm"]}


def light(n: int = 60, **more: Any) -> xarray.Dataset:
    """A sweep of despins that is done in a few milliseconds."""
    return sweep("tiangong-1", VARY, **{"n": n, **LIGHT, **more})


TUMBLING: dict[str, Any] = {"body.inertia[0]": uniform(1.0e-4, 1.35e-4), "initial.angular_velocity[0]": choice(0, 1e-3, 2, 5),
                            "initial.angular_velocity[1]": normal(0, 3)}


def tumbling(n: int = 60, **more: Any) -> xarray.Dataset:
    """A sweep of free bodies, some of which are none: most are answered side by side, those beside a separatrix one by one."""
    return sweep("t-handle", TUMBLING, **{"n": n, "times": [0.0, 0.7, 40.0], "ask": ["attitude", "angular_velocity"], **more})


def same(one: xarray.Dataset, other: xarray.Dataset) -> bool:
    """To the last bit."""
    def bits(values: xarray.DataArray) -> Any:
        return values.values.tobytes() if values.dtype.kind == "f" else values.values.tolist()

    return (set(one.variables) == set(other.variables) and one.attrs == other.attrs
            and all(bits(one[name]) == bits(other[name]) for name in one.variables))


def plan(vary: Mapping[str, Varied], n: int | None = 1000, cases: Mapping[str, Any] | None = None, **more: Any) -> Plan:
    """Of numbers without a unit."""
    readers = {key: lambda value: number_in(value, "1") for key in (*vary, *(cases or {}))}
    return Plan.of(vary, cases or {}, readers, n, more.get("seed", 1), more.get("design", "random"))


# ---- what is drawn ----


def test_the_draws_are_those_of_their_distributions() -> None:
    drawn = plan({"a": normal(3, "10%"), "b": uniform(-1, 2), "c": lognormal(2, "20%"), "d": choice(1, 2, 4)}, 40000).columns(range(40000))
    assert np.mean(drawn["a"]) == pytest.approx(3, abs=4 * 0.3 / 200)
    assert np.std(drawn["a"]) == pytest.approx(0.3, rel=0.02)
    assert np.mean(drawn["b"]) == pytest.approx(0.5, abs=0.02)
    assert np.min(drawn["b"]) >= -1 and np.max(drawn["b"]) <= 2
    assert np.median(drawn["c"]) == pytest.approx(2, rel=0.01)
    assert np.std(np.log(drawn["c"])) == pytest.approx(0.2, rel=0.02)
    assert {float(value): pytest.approx(1 / 3, abs=0.015) for value in (1, 2, 4)} == {value: np.mean(drawn["d"] == value) for value in (1.0, 2.0, 4.0)}
    assert abs(np.corrcoef(drawn["a"], drawn["b"])[0, 1]) < 0.02


@pytest.mark.parametrize("design", DESIGNS)
def test_a_draw_is_a_function_of_seed_row_and_name(design: str) -> None:
    given: dict[str, Varied] = {"a": normal(0, 1), "b": uniform(0, 1), "g": grid([1, 2, 3])}
    whole = plan(given, 300, design=design).columns(range(300))
    for cut in (1, 2, 3, 97, 298):
        for rows in (range(cut), range(cut, 300)):
            part = plan(given, 300, design=design).columns(rows)
            assert all(part[key].tobytes() == whole[key][rows.start:rows.stop].tobytes() for key in given)
    turned = plan(dict(reversed(given.items())), 300, design=design).columns(range(300))
    assert all(turned[key].tobytes() == whole[key].tobytes() for key in given)
    other = plan(given, 300, design=design, seed=2).columns(range(300))
    assert not np.any(other["a"] == whole["a"])


def test_a_number_more_changes_no_draw_of_the_others() -> None:
    alone, beside = plan({"a": normal(0, 1)}).columns(range(50)), plan({"b": normal(0, 1), "a": normal(0, 1)}).columns(range(50))
    assert alone["a"].tolist() == beside["a"].tolist()
    assert beside["a"].tolist() != beside["b"].tolist()


@pytest.mark.parametrize("design", ["sobol", "latin-hypercube"])
def test_the_points_of_a_design_fill_every_stratum(design: str) -> None:
    drawn = plan({"a": uniform(0, 1), "b": uniform(0, 1)}, 64, design=design).columns(range(64))
    for values in drawn.values():
        assert sorted((values * 64).astype(int)) == list(range(64))


def test_each_combination_of_a_grid_gets_the_same_points_of_a_design() -> None:
    drawn = plan({"a": uniform(0, 1), "g": grid([1, 2, 3])}, 48, design="sobol").columns(range(48))
    assert np.max(np.ptp(drawn["a"].reshape(16, 3), axis=1)) == 0


def test_the_rows_of_the_design_saltelli_mix_two_points() -> None:
    drawn = plan({"a": uniform(0, 1), "b": normal(0, 1), "c": uniform(0, 1)}, 40, design="saltelli").columns(range(40))
    points = {key: values.reshape(8, 5) for key, values in drawn.items()}
    for i, (key, values) in enumerate(points.items()):
        for other in range(3):
            assert values[:, 2 + other].tolist() == values[:, 1 if other == i else 0].tolist(), (key, other)
        assert not np.any(values[:, 0] == values[:, 1])
    for half in (0, 1):  # each is as even as the sequence
        assert sorted((points["a"][:, half] * 8).astype(int)) == list(range(8))
    with pytest.raises(DomainError, match="multiple of 5"):
        plan({"a": uniform(0, 1), "b": normal(0, 1), "c": uniform(0, 1)}, 41, design="saltelli")
    with pytest.raises(DomainError, match="no random number"):
        plan({"g": grid([1, 2])}, 4, design="saltelli")


def test_grids_and_cases_are_combined_in_full() -> None:
    made = plan({"g": linspace(0, 1, 3), "h": logspace(1, 100, 3)}, None, {"p": (1, 2), "q": (5, 6)})
    drawn = made.columns(range(made.n))
    found = list(zip(*(drawn[key].tolist() for key in ("p", "q", "g", "h")), strict=True))
    expected = [(p, q, g, h) for (p, q), g, h in itertools.product([(1, 5), (2, 6)], [0, 0.5, 1], [1, 10, 100])]
    assert found == [pytest.approx(each) for each in expected]
    again = plan({"g": linspace(0, 1, 3)}, 6).columns(range(6))
    assert again["g"].tolist() == [0, 0.5, 1, 0, 0.5, 1]


@pytest.mark.parametrize(("text", "meant"), [
    ("normal(0.005, 5%)", normal(0.005, "5%")), (" uniform( 15 , 17 )", uniform(15, 17)), ("lognormal(1e-4, 0.2)", lognormal(1e-4, 0.2)),
    ("choice(total, carrier)", choice("total", "carrier")), ("[1, 2, 5 deg]", grid([1, 2, "5 deg"])), ("0:10:11", linspace(0, 10, 11)),
    ("1e-5:1e-3:50log", logspace(1e-5, 1e-3, 50)), ("1 deg/s : 3 deg/s : 5", linspace("1 deg/s", "3 deg/s", 5))])
def test_words_say_what_the_functions_say(text: str, meant: Varied) -> None:
    assert read_words(text) == meant
    assert read_words(str(meant)) == meant


@pytest.mark.parametrize(("vary", "told"), [
    ({"torque.control[0]": "norml(1, 2)"}, "norml"), ({"torque.control[0]": "normal(1)"}, "normal(0.005"), ({"torque.control[0]": 3.0}, "how"),
    ({"torque.control": "normal(1, 2)"}, "torque.control[0]"), ({"torque.contrl[0]": "normal(1, 2)"}, "did you mean torque.control"),
    ({"solve.tolerance": "normal(1, 2)"}, "can vary"), ({"torque.drag": "normal(1 kg, 2)"}, "1/s"), ({"torque.drag": "uniform(2, 1)"}, "smaller"),
    ({"torque.drag": "normal(1, -2)"}, ">= 0"), ({"torque.drag": "normal(0, 5%)"}, "nothing would vary"),
    ({"torque.drag": "uniform(-inf, inf)"}, "finite ends"), ({"torque.drag": "normal(nan, 1)"}, "finite mean"), ({"torque.drag": "lognormal(inf, 1)"}, "finite median"),
    ({"body.inertia[3]": "uniform(1, 2)"}, "no such component; they count from 0 to 2"), ({"body.inertia[0,3]": "uniform(1, 2)"}, "rows count from 0 to 2, columns to 2"),
    ({"torque.control[0,1]": "uniform(1, 2)"}, "one index names"), ({"torque.drag": "lognormal(-1, 2)"}, "median"), ({"torque.drag": "2:1:5"}, "smaller first"),
    ({"torque.law": "choice(total, all)"}, "carrier"), ({"torque.law": choice()}, "at least one"), ({"initial.angular_momentum[0]": "normal(1, 2)"}, "no value"),
    ({"torque.drag": "[1, 2, 3]"}, "multiple of the 3"), ({"drag": "uniform(0, 1)", "torque.drag": "uniform(0, 1)"}, "twice"),
    ({"body.inertia[0,1]": "uniform(0, 1)", "body.inertia[1,0]": "uniform(0, 1)"}, "the number that"), ({}, "nothing varies")])
def test_a_study_that_cannot_be_says_why(vary: dict[str, Any], told: str) -> None:
    with pytest.raises(DomainError, match=".*" + told.replace("(", r"\(").replace("[", r"\[")):
        sweep("tiangong-1", vary, n=10)


@pytest.mark.parametrize("vary", [{"torque.drag": "normal(1 kg, 2)"}, {"torque.drag": "uniform(2, 1)"}, {"torque.law": "choice(total, all)"}])
@pytest.mark.parametrize("listed", [False, True])
def test_a_key_is_named_once(vary: dict[str, Any], listed: bool) -> None:
    key, = vary
    with pytest.raises(DomainError) as refused:
        sweep("tiangong-1", *(() if listed else (vary,)), n=1, cases={key: ["1 kg"]} if listed else None)
    assert str(refused.value).count(key) == 1 and str(refused.value).startswith(f"{key}: ")


@pytest.mark.filterwarnings("error")
def test_a_number_beyond_all_doubles_is_the_reason_of_its_row() -> None:
    found = sweep("tiangong-1", {"torque.drag": "lognormal(1e-300, 1000)"}, n=20, **LIGHT)
    over = np.isinf(found["torque.drag"].values)
    assert np.any(over) and np.all(found["reason"].values[over] == "torque.drag is not finite")


def test_other_settings_that_cannot_be_say_why() -> None:
    wrong: dict[str, dict[str, Any]] = {
        "how many rows": {}, "design": {"n": 5, "design": "halton"}, "seed": {"n": 5, "seed": -1}, 'n = "4": give an integer without quotes': {"n": "4"}, "shard": {"n": 5, "shard": "3/2"},
        "threads": {"n": 5, "threads": 0},
        "columns have": {"cases": {"body.inertia[0]": [1.0], "body.inertia[1]": [1.0, 2.0]}}}
    for told, settings in wrong.items():
        with pytest.raises(DomainError, match=told):
            sweep("tiangong-1", {"drag": "uniform(0, 1)"}, **settings)


@pytest.mark.parametrize(("design", "n", "most"), [("sobol", 2**30 + 1, 2**30), ("latin-hypercube", 2**27, 2**26)])
@pytest.mark.parametrize("shard", [None, "1/1000000"])
def test_a_design_of_too_many_points_is_refused_before_any_are_made(design: str, n: int, most: int, shard: str | None) -> None:
    with pytest.raises(DomainError, match=f"give at most {most} rows"):
        sweep("tiangong-1", {"torque.drag": "uniform(0, 1)", "torque.control[0]": "uniform(0, 1)"}, n=n, design=design, shard=shard)
    assert plan({"a": uniform(0, 1)}, 2**31 - 1).n == 2**31 - 1


# ---- what comes back ----


def test_the_dataset_has_parameters_answers_and_errors() -> None:
    found = light()
    assert dict(found.sizes) == {"row": 60, "time": 2}
    assert found["time"].values.tolist() == [10000, 40000]
    assert found["row"].values.tolist() == list(range(60))
    assert found["angular_momentum_norm"].dims == ("row", "time")
    assert found["stop_time"].attrs["units"] == "s"
    assert np.all(found["stop_time_error"] > 0) and np.all(found["stop_time_error"] <= 1e-2)
    assert found["torque.drag"].attrs["role"] == "parameter"
    assert found["torque.drag"].attrs["varied"] == "lognormal(1.2e-06, 20%)"
    assert set(found["model"].values) <= {"equal-torque", "averaged", "averaged-2", "full"}
    assert np.all(found["met"]) and np.all(found["reason"] == "")
    assert "near-separatrix" in found["warnings"].attrs["flag_meanings"].split()


VARIED = {"tiangong-1": {"body.inertia[1]": [70000.0, 71000.0]}, "two-attractors": {"motor.slope": [0.04, 0.06]}, "flat-sail": {"body.mass": [9.0, 11.0]},
          "lab-gyroscope": {"initial.angular_velocity[2]": [150.0, 160.0]}, "cubesat-pyramid": {"wheel[1].rate": [10.0, 20.0]}}


@pytest.mark.parametrize("name", VARIED)
def test_a_row_is_what_solve_answers_to_the_bit(name: str) -> None:
    scene = load(name, times=[1.0, 5.0])
    (key, values), = VARIED[name].items()
    found = sweep(scene, {key: values})
    numbers, place = numbers_of(scene), place_of(scene, key)
    assert len(numbers) > max(place.numbers)
    for row, value in enumerate(values):
        table, _, rest = key.partition(".")
        data = scene.to_dict()
        if table.startswith("wheel"):
            data["wheel"][1]["rate"] = value
        else:
            component = rest[rest.find("[") + 1:-1] if "[" in rest else ""
            home = data[table]
            home[rest.partition("[")[0]] = value if not component else [
                value if i == int(component) else old for i, old in enumerate(home[rest.partition("[")[0]])]
        answer = gyrostat.solve(data)
        assert found["model"].values[row] == answer.model
        for column, expected in answer.columns.items():
            if in_lanes(scene.kind, answer):
                error = float(found[f"{column}_error"].values[row])
                assert within_both(found[column].values[row], expected, answer.error[column] + error, answer, column)
                assert error <= 20 * answer.error[column]
                continue
            assert found[column].values[row].tolist() == expected.tolist()
            if column in answer.error:
                assert found[f"{column}_error"].values[row] == answer.error[column]
        for scalar, number in answer.scalars.items():
            got = found[scalar].values[row]
            expected = np.full_like(got, math.nan) if number is None and got.dtype.kind == "f" else np.asarray(number)
            assert np.array_equal(got, expected, equal_nan=got.dtype.kind == "f") if isinstance(got, np.generic | np.ndarray) else got == (number or "")


def in_lanes(kind: str, answer: gyrostat.Answer) -> bool:
    """Whether a row with this answer is integrated beside others, in steps of its own."""
    return kind == "rotor" and answer.model == "full"


def within_both(got: Any, expected: Any, error: float, answer: gyrostat.Answer, column: str) -> bool:
    """Whether two answers that both state this error at most differ by less."""
    size = max(float(np.linalg.norm(np.asarray(expected).reshape(len(answer.t), -1), axis=1).max()), answer.scale.get(column, 0.0))
    return bool(np.abs(np.asarray(got) - np.asarray(expected)).max() <= error * size)


GIVEN = {"deceleration": "torque.drag", "rotor": "motor.slope", "spinning": "body.mass", "heavy": "body.mass", "free": "initial.attitude[3]"}
SCENES = {**{name: file.read_text() for name, file in bundled() if FAMILIES[kinds()[name]].facts.inputs}, "GOOD": GOOD, "ROTOR": ROTOR, "ASSEMBLED": ASSEMBLED, "SPINNING": SPINNING,
          "HEAVY": HEAVY, "PERIODIC": PERIODIC}


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_as_a_row_of_numbers_is_that_scene(name: str) -> None:
    data = tomllib.loads(SCENES[name])
    data.pop("vary", None)
    scene = scene_from(data)
    scene = scene.replace(times=[float(scene.times[-1]) / 50, float(scene.times[-1]) / 20], ask="default")
    key = GIVEN[scene.kind]
    found = sweep(scene, {key: [numbers_of(scene)[place_of(scene, key).numbers[0]]]})
    answer = gyrostat.solve(scene)
    assert found["model"].values.tolist() == [answer.model]
    # numpy and the core round the momentum J omega of a tensor each in its way
    tensor = scene.kind == "deceleration" and isinstance(scene.tables["body"]["inertia"][0], tuple)
    for column in answer.error:
        expected, got = answer[column], found[column].values[0]
        if in_lanes(scene.kind, answer):
            assert within_both(got, expected, answer.error[column] + float(found[f"{column}_error"].values[0]), answer, column)
        else:
            assert np.allclose(got, expected, rtol=1e-13, atol=0) if tensor else got.tobytes() == expected.tobytes()


@pytest.mark.parametrize("name", [name for name, kind in kinds().items() if kind != "general"])
def test_the_numbers_of_a_scene_are_as_many_as_the_core_takes(name: str) -> None:
    scene = load(name)
    wheels = len(scene.top.get("wheel") or ())
    assert len(numbers_of(scene)) == sum(width * (wheels if listed else 1) for _, width, listed in FAMILIES[scene.kind].facts.inputs)


def test_components_of_tensors_directions_and_choices_vary() -> None:
    scene = load("tiangong-1")
    assert place_of(scene, "body.inertia[0,1]").numbers == (1, 3)
    assert place_of(scene, "inertia[2]").numbers == (8,)
    found = sweep(scene, {"torque.law": "choice(total, carrier)", "body.inertia[0, 1]": [0.0, 100.0]}, n=4, **LIGHT)
    assert np.all(found["met"])
    tilted = sweep("rotor-paper-repaired", {"rotor.axis[0]": "normal(0.75, 0.01)"}, n=4, times=[1.0, 2.0])
    assert np.all(tilted["reason"] == "")
    with pytest.raises(DomainError, match=r"body.inertia\[0,1\]"):  # a tensor has two of them
        place_of(load("two-attractors"), "body.inertia[2]")


def test_a_row_without_an_answer_says_why_and_is_no_exception() -> None:
    found = sweep("tiangong-1", cases={"body.inertia[2]": [76000.0, 1e6, math.nan, 76000.0, 76000.0], "torque.control[0]": [0.06, 0.06, 0.06, -1.0, math.inf]},
                  **LIGHT)
    assert found["reason"].values.tolist() == [
        "", "a principal moment exceeds the sum of the two others", "body.inertia[2] is not finite", "torque.control[0] is not >= 0",
        "torque.control[0] is not finite"]
    assert found["model"].values.tolist()[1:] == [""] * 4
    assert np.isnan(found["stop_time"].values[1:]).all() and np.isnan(found["angular_momentum_norm"].values[1:]).all()
    assert found["met"].values.tolist() == [True, False, False, False, False]
    named = sweep("tiangong-1", VARY, n=3, model="equal-torque", **LIGHT)
    assert set(named["reason"].values) == {"equal-torque: the control torques are not equal"}
    with pytest.raises(DomainError, match="torque.law: this is a word"):
        sweep("tiangong-1", {"torque.law": "normal(carrier, 300%)"}, n=20, **LIGHT)


def test_wheels_are_counted_from_one_in_every_table(tmp_path: Path) -> None:
    asked: dict[str, Any] = {"ask": ["rotor_rate"], "times": [0.0, 1.0]}
    found = sweep("cubesat-three-wheels", {"initial.angular_velocity[0]": uniform(0, 0.01)}, n=2, **asked)
    assert found["rotor_rate"].dims == ("row", "time", "wheel")
    assert found["wheel"].values.tolist() == [1, 2, 3]
    save(found, tmp_path / "out.csv")
    assert "rotor_rate_3[1]" in (tmp_path / "out.csv").read_text().splitlines()[0].split(",")
    assert gyrostat.solve("cubesat-three-wheels", **asked).to_csv().splitlines()[0] == "t,rotor_rate_1,rotor_rate_2,rotor_rate_3"


# ---- the same bits however it is cut ----


@pytest.mark.parametrize("study", [light, tumbling])
@pytest.mark.parametrize("settings", [{"threads": 1}, {"threads": 5}, {"chunk": 7}, {"threads": 2, "chunk": 59}])
def test_threads_and_chunks_change_no_bit(study: Callable[..., xarray.Dataset], settings: dict[str, int]) -> None:
    assert same(study(**settings), study())


def test_rows_side_by_side_are_what_solve_answers_to_the_bit() -> None:
    found = tumbling(n=40, threads=1)
    assert 0 < int((found["reason"].values == "").sum()) < 40
    for row in range(40):
        if found["reason"].values[row]:
            continue
        scene = load("t-handle").to_dict()
        scene["body"]["inertia"][0] = float(found["body.inertia[0]"].values[row])
        for i in (0, 1):
            scene["initial"]["angular_velocity"][i] = float(found[f"initial.angular_velocity[{i}]"].values[row])
        answer = gyrostat.solve(scene, times=[0.0, 0.7, 40.0], ask=["attitude", "angular_velocity"])
        assert found["model"].values[row] == answer.model
        for name in ("attitude", "angular_velocity"):
            assert found[name].values[row].tolist() == answer.columns[name].tolist()
            assert found[f"{name}_error"].values[row] == answer.error[name]


TURNED: dict[str, dict[str, Any]] = {
    "deceleration": {"torque": {"control": [0.01, 0.01, 0.01], "drag": 0.01}},
    "free": {},
    "general": {},
    "heavy": {"body": {"inertia": [3.0, 4.0, 5.0], "mass": 2.0, "centre_of_mass": [0.1, 0.05, 0.1]}, "field": {"gravity": 9.8}},
    "rotor": {"rotor": {"axis": [1.0, 0.0, 0.0], "axial_inertia": 0.1}, "motor": {"slope": 0.01, "no_load_rate": 3.0}},
    "spinning": {"body": {"inertia": [3.0, 4.0, 5.0], "mass": 2.0}, "torque": {"body": [0.001, 0.0, 0.0], "force": [0.0, 0.0, 1.0]}},
}


def turned(kind: str, attitude: list[float]) -> dict[str, Any]:
    start: dict[str, Any] = {"angular_velocity": [0.1, 0.2, 0.3], "attitude": attitude}
    if kind == "rotor":
        start["rotor_rate"] = 1.0
    return {"name": "turned", "kind": kind, "body": {"inertia": [3.0, 4.0, 5.0]}, "solve": {"times": [1.0, 10.0]}, "initial": start, **TURNED[kind]}


@pytest.mark.parametrize("kind", [kind for kind in FAMILIES if kind != "rotor"])
def test_a_number_of_a_quaternion_that_is_off_unit_by_rounding_is_that_of_the_scene(kind: str) -> None:
    attitude = [0.5, -0.5, 0.5, 0.5000003]
    rows = sweep(turned(kind, attitude), {"initial.attitude[0]": [0.5, 0.50000012]}, ask=["attitude"])
    for row, number in enumerate((0.5, 0.50000012)):
        answer = gyrostat.solve(turned(kind, [number, *attitude[1:]]), ask=["attitude"])
        assert rows["attitude"].values[row].tobytes() == answer["attitude"].tobytes()
        assert rows["attitude_error"].values[row] == answer.error["attitude"]


def test_the_gradient_of_a_centre_is_that_of_the_scene() -> None:
    rows = sweep("bennu-gimbal", {"field.gravity": [7.57695831e-05]}, times=[70.0])
    answer = gyrostat.solve("bennu-gimbal", times=[70.0], **{"field.gravity": 7.57695831e-05})
    assert all(rows[column].values[0].tobytes() == answer[column].tobytes() for column in answer)


def test_more_threads_than_any_machine_has_are_refused() -> None:
    with pytest.raises(DomainError, match="threads = 1099511627776: give at most 1024"):
        light(threads=2**40)


@pytest.mark.parametrize("kind", list(FAMILIES))
def test_a_row_whose_attitude_is_nought_is_refused_as_the_scene_is(kind: str) -> None:
    """It is not one that was left out: a motion would begin at another."""
    scene = turned(kind, [0.0, 0.0, 0.0, 1.0])
    rows = sweep(scene, {"initial.attitude[3]": [0.0, 1.0]})
    assert not rows["met"].values[0] and rows["reason"].values[0]
    assert rows["met"].values[1] and not rows["reason"].values[1]
    with pytest.raises(SceneError, match="zero quaternion"):
        gyrostat.solve(turned(kind, [0.0, 0.0, 0.0, 0.0]))


def test_shards_put_together_are_the_whole(tmp_path: Path) -> None:
    assert same(merge([tumbling(shard=(i, 7)) for i in range(1, 8)]), tumbling())
    whole, parts = light(), [light(shard=(i, 4)) for i in (3, 1, 4, 2)]
    assert same(merge(parts), whole)
    for i, part in enumerate(parts):
        save(part, tmp_path / f"{i}.nc")
    assert same(merge(tmp_path / f"{i}.nc" for i in range(4)), whole)
    for told, wrong in {"rows 30 to 44 are missing": [parts[1], parts[2], parts[3]], "there twice": [parts[1], *parts], "another study":
                        [parts[1], light(seed=3, shard=(2, 4))], "rows 45 to 59 are missing": [parts[1], parts[3], parts[0]]}.items():
        with pytest.raises(DomainError, match=told):
            merge(wrong)


def test_a_sweep_that_is_interrupted_goes_on_where_it_was(tmp_path: Path) -> None:
    class Stopped(Exception):
        pass

    def stop(done: int, rows: int) -> None:
        if done >= 20:
            raise Stopped

    with pytest.raises(Stopped):
        light(chunk=10, parts=tmp_path, progress=stop)
    left = sorted(tmp_path.glob("*.nc"))
    assert 0 < len(left) < 6
    asked: list[tuple[int, int]] = []
    resumed = light(chunk=25, parts=tmp_path, progress=lambda done, rows: asked.append((done, rows)))
    assert same(resumed, light())
    tumbling(n=60, chunk=13, parts=tmp_path / "free", shard=(1, 1))
    (tmp_path / "free" / "rows-0000000013-0000000026.nc").unlink()
    assert same(tumbling(parts=tmp_path / "free"), tumbling())
    assert asked[0][0] > 10 * len(left) and asked[-1] == (60, 60)
    with pytest.raises(DomainError, match="another study"):
        light(seed=9, parts=tmp_path)


@pytest.mark.parametrize("harm", ["empty", "cut", "stump", "nought", "renamed", "another's", "fewer", "a bit"])
def test_parts_that_are_damaged_are_done_again(tmp_path: Path, harm: str) -> None:
    light(chunk=10, parts=tmp_path)
    parts = sorted(tmp_path.glob("*.nc"))
    whole = parts[2].read_bytes()
    match harm:
        case "empty":
            parts[2].write_bytes(b"")
        case "cut":
            parts[2].write_bytes(whole[:len(whole) // 2])
        case "stump":
            parts[2].write_bytes(whole[:200])
        case "nought":
            parts[2].write_bytes(bytes(len(whole)))
        case "renamed":
            parts[2].rename(tmp_path / "rows-0000000020-0000000025.nc")
        case "another's":
            parts[2].write_bytes(parts[1].read_bytes())
        case "a bit":
            place = whole.find(struct.pack(">d", open_results(parts[2])["stop_time"][3]))
            assert place > 0
            parts[2].write_bytes(whole[:place + 1] + bytes([whole[place + 1] ^ 16]) + whole[place + 2:])
        case "fewer":
            save(open_results(parts[2]).isel(row=slice(0, 4)), parts[2])
    assert same(light(chunk=10, parts=tmp_path), light())


def test_what_a_killed_sweep_left_half_written_goes_with_its_parts(tmp_path: Path) -> None:
    left = tmp_path / "a.nc.parts" / ".rows-0000000000-0000000010.17-4.nc"
    left.parent.mkdir()
    left.write_bytes(b"CDF")
    assert main(["sweep", "stage-despin-study", "-n", "20", "--chunk", "10", "--resume", "-o", str(tmp_path / "a.nc")]) == 0
    assert [each.name for each in tmp_path.iterdir()] == ["a.nc"]


def test_what_is_put_together_has_each_row_once(tmp_path: Path) -> None:
    for wrong in ([3], [None], 3, "none.nc"):
        with pytest.raises(DomainError, match="parts are files|no such file"):
            merge(wrong)  # type: ignore[arg-type]
    part = light(shard=(2, 2))
    nameless = part.copy()
    nameless.attrs = {}
    for damaged in (nameless, part.isel(row=0), part.isel(row=[])):
        with pytest.raises(DomainError, match="a part: this holds no results of a sweep"):
            merge([damaged])
    for rows in ([0, 1, 1, *range(2, 30)], [0, *range(2, 30)], [1, 0, *range(2, 30)], [*range(14), *range(15, 30), 29]):
        with pytest.raises(DomainError, match="rows are missing in it, or there twice, or out of their order|missing"):
            merge([light(shard=(1, 2)), part.isel(row=rows)])


@pytest.mark.parametrize("harm", [{"study": "{broken"}, {"study": "{}"}, {"study": None}, {"kind": "none"}, {"kind": None}, {"row": None}, {"met": None}, {"rows": None}])
def test_damaged_results_are_told_as_such(tmp_path: Path, harm: dict[str, str | None]) -> None:
    found = light()
    (name, value), = harm.items()
    if name in ("met", "row"):
        found = found.drop_vars(name)
    elif name == "rows":
        found = found.isel(row=slice(0, 0))
    elif value is None:
        del found.attrs[name]
    else:
        found.attrs[name] = value
    found.to_netcdf(tmp_path / "found.nc", engine="scipy", format="NETCDF3_64BIT")
    with pytest.raises(DomainError, match="this holds no results of a sweep, or they are damaged"):
        open_results(tmp_path / "found.nc")


def test_a_folder_of_parts_keeps_what_is_not_a_part(tmp_path: Path) -> None:
    file = tmp_path / "f.nc"
    command = ["sweep", "tiangong-1", "--vary", "torque.drag=[1e-6, 2e-6]", "--ask", "stop_time", "--set", "tolerance=0.01", "-o", str(file)]
    (tmp_path / "f.nc.parts").mkdir()
    (tmp_path / "f.nc.parts" / "notes.txt").write_text("mine")
    assert main([*command, "--resume"]) == 0
    assert [each.name for each in (tmp_path / "f.nc.parts").iterdir()] == ["notes.txt"]


def test_long_rows_are_left_at_once_when_a_sweep_is_stopped() -> None:
    def stop(done: int, rows: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep("envisat-eddy-decay", {"torque.drag": "normal(1e-6, 1%)"}, n=4, model="full", threads=1, progress=stop)


# ---- files and commands ----


def test_results_are_read_back_as_they_were(tmp_path: Path) -> None:
    found = light()
    save(found, tmp_path / "out.nc")
    again = open_results(tmp_path / "out.nc")
    assert same(again, found)
    assert list(again.data_vars) == list(found.data_vars)  # so that a table has its columns where it had them
    save(found, tmp_path / "out.csv")
    with (tmp_path / "out.csv").open() as stream:
        lines = list(csv.DictReader(stream))
    assert [float(line["stop_time"]) for line in lines] == found["stop_time"].values.tolist()
    assert [float(line["angular_momentum_norm[1]"]) for line in lines] == found["angular_momentum_norm"].values[:, 1].tolist()
    for told, file in {"unknown ending": "out.xls", "no such file": "none.nc", "read from": "out.csv"}.items():
        with pytest.raises(DomainError, match=told):
            (save(found, tmp_path / file) if file == "out.xls" else open_results(tmp_path / file))


@pytest.mark.parametrize("ending", ["parquet", "zarr"])
def test_other_formats_where_their_library_is_there(tmp_path: Path, ending: str) -> None:
    pytest.importorskip({"parquet": "pyarrow", "zarr": "zarr"}[ending])
    found = light()
    save(found, tmp_path / f"out.{ending}")
    if ending == "zarr":
        assert same(open_results(tmp_path / "out.zarr"), found)
    else:
        import pandas

        assert pandas.read_parquet(tmp_path / "out.parquet")["stop_time"].tolist() == found["stop_time"].values.tolist()


@pytest.mark.parametrize(("ending", "library"), [("nc", "scipy"), ("parquet", "pyarrow"), ("zarr", "zarr")])
def test_a_missing_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str, library: str) -> None:
    found = light(3)
    monkeypatch.setattr(sweep_files, "find_spec", lambda name: None)
    with pytest.raises(ImportError, match=f"{library} is not installed: pip install"):
        save(found, tmp_path / f"out.{ending}")


STUDY = """
[vary]
n = 40
seed = 4
design = "sobol"
"body.inertia[0]" = "uniform(34, 36)"
torque.drag = [1e-4, 2e-4]
"""


def test_a_study_is_one_file(good: str, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(good + STUDY)
    found = sweep(file, ask=["stop_time"])
    told = json.loads(found.attrs["study"])
    assert (told["n"], told["seed"], told["design"]) == (40, 4, "sobol")
    assert told["vary"] == {"body.inertia[0]": "uniform(34.0, 36.0)", "torque.drag": "[0.0001, 0.0002]"}
    other = sweep(file, {"drag": "[3e-4]"}, n=20, seed=5, ask=["stop_time"])
    assert np.all(other["torque.drag"] == 3e-4) and other.sizes["row"] == 20
    scene = load(file)
    assert gyrostat.solve(scene).met
    assert scene_from(tomllib.loads(toml_text(scene.to_dict()))).to_dict() == scene.to_dict()
    for told_wrong, wrong in {"did you mean": STUDY.replace("torque.drag", "torque.darg"), "did you mean uniform": STUDY.replace("uniform", "unform"),
                              "integer": STUDY.replace("n = 40", 'n = "many"'), "multiple": STUDY.replace("n = 40", "n = 41")}.items():
        file.write_text(good + wrong)
        with pytest.raises(SceneError, match=told_wrong):
            load(file)


def test_cases_come_from_a_table(good: str, tmp_path: Path) -> None:
    (tmp_path / "cases.csv").write_text("torque.drag, body.inertia[0]\n1e-4, 35\n2e-4, 34.5\n")
    file = tmp_path / "study.toml"
    file.write_text(good + '\n[vary]\ncases = "cases.csv"\n')
    found = sweep(file, ask=["stop_time"])
    assert found["torque.drag"].values.tolist() == [1e-4, 2e-4] and found["body.inertia[0]"].values.tolist() == [35, 34.5]
    (tmp_path / "cases.csv").write_text("torque.drag\n")
    with pytest.raises(DomainError, match="first line"):
        sweep(file)


def test_a_table_of_cases_with_gaps_or_other_separators_is_told_where(tmp_path: Path) -> None:
    file = tmp_path / "cases.csv"
    for text, told in {"torque.drag,body.mass\n1e-6,\n": "line 2 has no value of body.mass", "torque.drag;body.mass\n1;2\n": "by commas, not by ;"}.items():
        file.write_text(text)
        with pytest.raises(DomainError, match=f"cases.csv: .*{told}"):
            sweep("tiangong-1", cases=file)


def test_words_may_be_quoted_and_counts_be_those_of_numpy() -> None:
    assert read_words("choice('total', \"carrier\")") == read_words("choice(total, carrier)")
    assert linspace(0, 1, np.int64(3)) == linspace(0, 1, 3)  # type: ignore[arg-type]


def test_the_shares_of_saltelli_rows_are_those_of_independent_ones() -> None:
    """The mixtures of a point share its numbers: what explains nothing would seem to explain a hundredth."""
    plan = gyrostat.load("stage-despin-study").to_dict()
    plan.pop("vary")
    vary = {"torque.control[0]": "uniform(0.9, 1.1)", "torque.control[1]": "uniform(0.9, 1.1)", "body.inertia[0]": "normal(4000, 0.1%)"}
    found = sweep(plan, vary, n=5 * 256, design="saltelli", ask=["angular_momentum_norm"], times=[10.0])
    own = found.isel(row=found["row"].values % 5 < 2)
    for each, alone in zip(responses(found), responses(own), strict=True):
        assert variance_shares(found, each) == variance_shares(own, alone)


def test_cases_of_a_scene_from_the_standard_input_stand_in_the_working_folder(tmp_path: Path) -> None:
    (tmp_path / "cc.csv").write_text("torque.drag\n1e-6\n2e-6\n")
    study = gyrostat.load("tiangong-1").to_dict() | {"vary": {"cases": "cc.csv"}}
    for scene in (["-"], ["/dev/stdin"]):
        made = subprocess.run([sys.executable, "-m", "gyrostat", "sweep", *scene, "--ask", "stop_time", "-o", "rows.csv"], cwd=tmp_path, input=toml_text(study),
                              capture_output=True, text=True)
        assert made.returncode == 0 and "2 rows" in made.stderr, made.stderr


def test_the_commands_sweep_merge_and_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    common = ["sweep", "tiangong-1", "--vary", "torque.control[0]=normal(0.06, 5%)", "--vary", "torque.drag=1e-7:1e-5:4log", "-n", "40", "--ask",
              "stop_time,angular_momentum_norm", "--set", "tolerance=1e-2", "--set", "times=[10000,40000]"]
    assert main([*common, "-o", str(tmp_path / "out.nc")]) == 0
    assert "40 rows, 100 % within the tolerance" in capsys.readouterr().err
    assert not (tmp_path / "out.nc.parts").exists()
    for i in (1, 2):
        assert main([*common, "--shard", f"{i}/2", "-o", str(tmp_path / f"{i}.nc")]) == 0
    assert main(["merge", str(tmp_path / "2.nc"), str(tmp_path / "1.nc"), "-o", str(tmp_path / "both.nc")]) == 0
    assert same(open_results(tmp_path / "both.nc"), open_results(tmp_path / "out.nc"))
    capsys.readouterr()
    assert main(["merge", str(tmp_path / "1.nc"), str(tmp_path / "2.nc"), "-o", str(tmp_path / "1.nc")]) == 2
    assert "the whole would replace one of its parts" in capsys.readouterr().err
    assert main(["report", str(tmp_path / "2.nc")]) == 0
    assert "a part: rows 20 to 39 of 40" in capsys.readouterr().out
    assert main(["report", str(tmp_path / "out.nc"), "-o", str(tmp_path / "figures")]) == 0
    told = capsys.readouterr().out
    assert "Rank correlations" in told and "averaged" in told
    assert {file.name for file in (tmp_path / "figures").iterdir()} == {"histograms.png", "bands.png", "tornado.png", "scatter.png"}
    (tmp_path / "out.nc.parts").mkdir()  # as Ctrl-C before the first chunk leaves it
    assert main([*common, "-o", str(tmp_path / "out.nc")]) == 0
    (tmp_path / "out.nc.parts").mkdir()
    (tmp_path / "out.nc.parts" / "rows-0000000000-0000000010.tmp").touch()
    assert main([*common, "-o", str(tmp_path / "out.nc")]) == 2
    assert "--resume" in capsys.readouterr().err
    assert main([*common, "--resume", "-o", str(tmp_path / "out.nc")]) == 0
    assert main(["sweep", "tiangong-1", "--vary", "torque.drag=[-1, 1e-6]", "--ask", "stop_time", "-o", str(tmp_path / "bad.csv")]) == 3
    assert "torque.drag is not >= 0" in capsys.readouterr().err
    assert main(["sweep", "iss-drift", "--vary", "body.inertia[0,1]=[1e3, 9e12]", "--ask", "attitude", "--set", "times=[1.0]", "-o", str(tmp_path / "no.nc")]) == 3
    example = "row 1: body.inertia: the principal moments are"
    assert example in capsys.readouterr().err
    assert main(["report", str(tmp_path / "no.nc")]) == 0
    assert example in " ".join(capsys.readouterr().out.split())
    assert main(["sweep", "tiangong-1", "--vary", "torque.drag=[-1, -2]", "--ask", "stop_time", "-o", str(tmp_path / "bad.nc")]) == 3
    assert main(["report", str(tmp_path / "bad.nc"), "-o", str(tmp_path / "none")]) == 0
    assert "nothing to draw" in capsys.readouterr().out and not (tmp_path / "none").exists()


@pytest.mark.parametrize(("name", "settings", "told"), [
    ("folder.nc", ["-n", "10"], "this is a folder; name a file"), ("file.zarr", ["-n", "10"], "results in .zarr are a folder"),
    ("large.nc", ["-n", "1200", "--set", "samples=300000", "--ask", "angular_momentum_norm"], "over 2 GiB.*write .zarr, ask for less"),
    ("large.csv", ["-n", "1200", "--chunk", "1100", "--set", "samples=300000", "--ask", "angular_momentum_norm"], "less than 1100 rows")])
def test_an_output_that_cannot_hold_the_results_is_refused_before_the_work(name: str, settings: list[str], told: str, tmp_path: Path,
                                                                           capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "folder.nc").mkdir()
    (tmp_path / "file.zarr").touch()
    monkeypatch.setattr(sweep_files, "find_spec", lambda name: True)
    monkeypatch.setattr("gyrostat.sweeps.Study.rows", lambda *_: pytest.fail("worked"))
    command = ["sweep", "tiangong-1", "--vary", "torque.drag=uniform(1e-6, 2e-6)", *settings]
    assert main([*command, "-o", str(tmp_path / name)]) == 2
    assert re.search(told, capsys.readouterr().err)
    assert not (tmp_path / f"{name}.parts").exists()


def test_a_report_ranks_what_matters() -> None:
    found = light(400)
    stop, = responses(found)
    ranked = rank_correlations(found, stop)
    places, others = (np.argsort(np.argsort(found[key].values)) for key in ("torque.control[0]", "stop_time"))
    assert ranked["torque.control[0]"] == pytest.approx(float(np.corrcoef(places, others)[0, 1]), abs=1e-12)
    titles = {title.split(",")[0]: rows for title, _, rows in tables(found)}
    assert float(titles["Percentiles"][0][6]) == pytest.approx(float(np.median(found["stop_time"])), rel=1e-4)
    assert not titles["No answer"]
    assert [name for name, _ in drawings(found)] == ["histograms", "bands", "tornado", "scatter"]


def test_a_report_names_what_misses_the_tolerance() -> None:
    varied = {"torque.drag": uniform(1e-4, 2e-4)}
    scene = gyrostat.load("tiangong-1").replace(model="averaged", tolerance=1e-9)
    assert missed_by(gyrostat.sweep(scene, varied, n=3, ask=["stop_time", "energy"])) == {"stop_time": 1.0}
    assert missed_by(gyrostat.sweep(scene, varied, n=3, ask={"stop_time": 0.5, "energy": "1e-9 %"})) == {"energy": 1.0}
    assert not missed_by(gyrostat.sweep(scene, varied, n=3, ask={"stop_time": 0.5}))
    for ask in ({"stop_time": "1e-9 s"}, {"angular_momentum_norm": "1e-9 N m s", "stop_time": 0.5}):
        assert missed_by(gyrostat.sweep(scene, varied, n=3, ask=ask)) == {next(iter(ask)): 1.0}


def ishigami(n: int) -> xarray.Dataset:
    """The function of Ishigami and Homma (1990), sin a + 7 sin^2 b + 0.1 c^4 sin a, as if it were the answer of a sweep."""
    made = plan({key: uniform(-math.pi, math.pi) for key in ("c", "a", "b")}, n, design="saltelli", seed=4)
    drawn = made.columns(range(n))
    answer = np.sin(drawn["a"]) * (1 + 0.1 * drawn["c"] ** 4) + 7 * np.sin(drawn["b"]) ** 2
    return xarray.Dataset({key: ("row", values, {"role": "parameter"}) for key, values in drawn.items()} | {"stop_time": ("row", answer)},
                          {"row": np.arange(n)}, {"kind": "deceleration", "study": json.dumps(made.told())})


def test_a_share_of_the_variance_sees_what_rises_and_falls() -> None:
    drawn = plan({key: uniform(-math.pi, math.pi) for key in ("c", "a", "b")}, 20000, seed=4).columns(range(20000))
    answer = np.sin(drawn["a"]) * (1 + 0.1 * drawn["c"] ** 4) + 7 * np.sin(drawn["b"]) ** 2  # Ishigami and Homma (1990)
    found = xarray.Dataset({key: ("row", values, {"role": "parameter"}) for key, values in drawn.items()} | {"stop_time": ("row", answer)},
                           {"row": np.arange(20000)}, {"kind": "deceleration"})
    response, = responses(found)
    shares, ranked = variance_shares(found, response), rank_correlations(found, response)
    assert shares == pytest.approx({"a": 0.3139, "b": 0.4424, "c": 0.0}, abs=0.02)
    assert abs(ranked["b"]) < 0.02  # blind to it
    constant = found.assign(stop_time=("row", np.ones(20000)))
    assert all(math.isnan(share) for share in variance_shares(constant, responses(constant)[0]).values())


def shares_of(answer: Callable[..., Any], vary: Mapping[str, Varied], n: int, seed: int = 4, design: str = "random") -> dict[str, float]:
    """Shares of the variance of a function of random numbers, as if it were the answer of a sweep."""
    drawn = plan(vary, n, seed=seed, design=design).columns(range(n))
    found = xarray.Dataset({key: ("row", values, {"role": "parameter"}) for key, values in drawn.items()} | {"stop_time": ("row", answer(**drawn))},
                           {"row": np.arange(n)}, {"kind": "deceleration"})
    return variance_shares(found, responses(found)[0])


@pytest.mark.parametrize("n", [200, 2000])
@pytest.mark.parametrize("alone", [uniform(0, 1), normal(3, "10%"), normal(0, 3), lognormal(9, "50%"), lognormal(9, "100%"), grid([0.0, 1.0, 5.0, 100.0])], ids=str)
def test_a_number_that_alone_sets_the_answer_explains_all_of_it(alone: Varied, n: int) -> None:
    for answer in (lambda x: x, lambda x: x**2, lambda x: 1e200 * np.abs(x) ** 0.5):
        assert 0.985 < shares_of(answer, {"x": alone}, n)["x"] <= 1.0


def test_the_shares_of_a_sum_are_those_of_its_parts() -> None:
    inertia = np.array([1.0, 1.6274, 2.4791])  # whose squares are as 0.1021 : 0.2704 : 0.6275
    exact = inertia**2 / np.sum(inertia**2)
    vary = {"a": normal(0, 3), "b": normal(0, 3), "c": normal(0, 3)}

    def energy(a: Any, b: Any, c: Any) -> Any:
        return (inertia[0] * a**2 + inertia[1] * b**2 + inertia[2] * c**2) / 2

    many = shares_of(energy, vary, 20000)
    assert [many[key] for key in "abc"] == pytest.approx(exact.tolist(), abs=0.025)
    several = np.mean([[shares_of(energy, vary, 2000, seed)[key] for key in "abc"] for seed in range(24)], axis=0)
    assert several.tolist() == pytest.approx(exact.tolist(), abs=0.02)


@pytest.mark.parametrize("idle", [uniform(0, 1), lognormal(1, "100%"), choice(1, 2, 5)], ids=str)
def test_a_number_that_does_nothing_explains_nothing(idle: Varied) -> None:
    shares = [shares_of(lambda idle, works: works, {"idle": idle, "works": lognormal(1, "50%")}, 400, seed)["idle"] for seed in range(30)]
    assert np.median(shares) < 0.01 and np.mean(shares) < 0.02


def test_points_of_low_discrepancy_give_idle_numbers_no_share() -> None:
    """A few such points lie along lines in a pair of numbers: what one does must not be told of the other."""
    vary: dict[str, Varied] = {**{f"idle{i}": normal(0, 1) for i in range(6)}, "much": normal(0, 1), "some": normal(0, 1)}
    for n, most in ((256, 0.15), (512, 0.06)):
        found = [shares_of(lambda much, some, **idle: much + 0.4 * some, vary, n, seed, design="sobol") for seed in range(6)]
        assert max(share for shares in found for key, share in shares.items() if key.startswith("idle")) < most
        assert all(shares["much"] == pytest.approx(1 / 1.16, abs=0.08) and shares["some"] == pytest.approx(0.16 / 1.16, abs=0.08) for shares in found)


def test_a_report_tells_of_stops_that_never_come() -> None:
    found = sweep("tiangong-1", {"torque.drag": uniform(1e-5, 2e-5)}, n=5, ask="stop_time", **{"torque.control": [0.0, 0.0, 0.0]})
    titles = {title.split(",")[0]: rows for title, _, rows in tables(found)}
    assert titles["Percentiles"] == [["stop_time", "s", "0 %", *["inf"] * 7, "-"]]


def test_of_general_scenes_a_report_shows_the_columns_where_no_scalar_has_a_value() -> None:
    found = sweep("momentum-dump", {"body.inertia[0]": uniform(850.0, 950.0)}, n=3)
    assert "angular_velocity_x" in [each.label for each in responses(found)]


def test_sobol_indices_are_those_of_a_function_whose_are_known() -> None:
    found = ishigami(5 * 4096)
    response, = responses(found)
    indices = sobol_indices(found, response)
    known = {"a": (0.3139, 0.5576), "b": (0.4424, 0.4424), "c": (0.0, 0.2437)}
    for key, (first, total) in known.items():
        assert 0 < indices[key].first_error < 0.03 and 0 < indices[key].total_error < 0.03
        assert indices[key].first == pytest.approx(first, abs=max(0.005, 3 * indices[key].first_error))
        assert indices[key].total == pytest.approx(total, abs=max(0.005, 3 * indices[key].total_error))
    # and to rounding what scipy makes of the same values
    values = response.values.reshape(4096, 5).T
    scipy = pytest.importorskip("scipy.stats").sobol_indices(
        func={"f_A": values[None, 0], "f_B": values[None, 1], "f_AB": values[2:, None]}, n=4096)
    assert [indices[key].first for key in "abc"] == pytest.approx(scipy.first_order.ravel().tolist(), abs=1e-12)
    assert [indices[key].total for key in "abc"] == pytest.approx(scipy.total_order.ravel().tolist(), abs=1e-12)


def test_sobol_indices_leave_out_points_without_an_answer() -> None:
    found = ishigami(5 * 512)
    found["stop_time"][::37] = math.nan
    few = sobol_indices(found, responses(found)[0])
    assert few["b"].total == pytest.approx(0.4424, abs=0.15)
    part = found.isel(row=slice(3, 5 * 400 + 1))  # a shard that begins and ends within a point
    whole = found.isel(row=slice(5, 5 * 400))
    assert sobol_indices(part, responses(part)[0]) == sobol_indices(whole, responses(whole)[0])
    random = light(40)
    assert not sobol_indices(random, responses(random)[0])


def test_a_report_of_the_design_saltelli_has_sobol_indices(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    study = ["sweep", "tiangong-1", "--vary", "torque.control[0]=normal(0.06, 5%)", "--vary", "torque.drag=lognormal(1.2e-6, 20%)", "--ask", "stop_time",
             "--set", "tolerance=1e-2", "--set", "times=[20000]", "--design", "saltelli", "-o", str(tmp_path / "out.nc")]
    assert main([*study, "-n", "258"]) == 2
    assert "multiple of 4" in capsys.readouterr().err
    assert main([*study, "-n", "256"]) == 0
    found = open_results(tmp_path / "out.nc")
    indices = sobol_indices(found, responses(found)[0])
    assert sum(each.first for each in indices.values()) == pytest.approx(1, abs=0.1)  # nearly a sum of two functions
    capsys.readouterr()
    assert main(["report", str(tmp_path / "out.nc")]) == 0
    assert "Sobol indices" in capsys.readouterr().out


def test_every_kind_has_a_report() -> None:
    for name, vary in VARIED.items():
        found = sweep(name, vary, times=[1.0, 2.0])
        for _, draw in drawings(found):
            draw()
        assert all(len(row) == len(heads) for _, heads, rows in tables(found) for row in rows)


def test_the_plan_of_a_scene_needs_no_optional_library() -> None:
    made, places = plan_of(load("tiangong-1"), {"drag": "normal(1e-6, 5%)"}, n=3)
    assert made.n == 3 and list(places) == ["torque.drag"]


def test_all_rows_of_motors_that_are_faster_than_the_body_state_what_they_err() -> None:
    """Where a wheel's rate fades faster than the body turns it and no tolerance sets the steps, and answer and companions must not take the same."""
    scene: dict[str, Any] = {
        "name": "fast-motor", "kind": "rotor", "body": {"inertia": [6.390131674302856, 5.475311171275947, 5.364891719688156]},
        "rotor": {"axis": [-0.7071758763103527, 0.2621550814973788, -0.6566406880553377], "axial_inertia": 9.098619502161738e-06},
        "motor": {"slope": 3.5e-5, "no_load_rate": 0.0},
        "initial": {"angular_velocity": [0.9669722789332148, -0.36060836889927, -0.9710363785210655], "rotor_rate": 0.0, "attitude": [0.0, 0.0, 0.0, 1.0]},
        "solve": {"times": [408.0], "tolerance": 1e-6, "ask": ["attitude"], "model": "full"}}
    slopes = (9.1e-6 * 1.417 * np.linspace(0.5, 6, 48)).tolist()
    rows = sweep(scene, {"motor.slope": slopes}, threads=1)
    for row, slope in enumerate(slopes):
        truth = gyrostat.solve(scene, **{"motor.slope": slope, "tolerance": 1e-13})
        single = gyrostat.solve(scene, **{"motor.slope": slope})
        for got, stated in ((rows["attitude"].values[row], float(rows["attitude_error"].values[row])), (single["attitude"], single.error["attitude"])):
            assert float(np.max(angle_between(got, truth["attitude"]))) <= stated + truth.error["attitude"], slope


def test_an_answer_of_one_scene_is_no_sweep(tmp_path: Path) -> None:
    gyrostat.solve("tiangong-1").to_netcdf(tmp_path / "answer.nc")
    with pytest.raises(DomainError, match="answer of one scene, not the rows of a sweep"):
        open_results(tmp_path / "answer.nc")


def test_a_component_of_a_key_that_is_told_in_another_form_is_named() -> None:
    with pytest.raises(DomainError, match=r"varies by its components, such as body.inertia\[0,0\]"):
        sweep("tiangong-1", {"body.inertia.moments[0]": uniform(1, 2)}, n=3)
