# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps of general scenes: every number of a scene, to the bits that the scene alone has; rows without an answer; what cannot vary."""

import copy
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import at_length
from gyrostat import DomainError, SceneError, sweep
from gyrostat.cli import main
from gyrostat.families import FAMILIES
from gyrostat.fields import Field, parts_of
from gyrostat.orientation import FORMS
from gyrostat.rows import inputs_of, numbers_of, place_of
from gyrostat.scenes import Scene, bundled, load, scene_from
from gyrostat.sweep_report import in_words
from gyrostat.sweeps import merge

pytest.importorskip("xarray")

# What the bundled scenes leave out: all that a scene file converts before it is computed.
CONVERTED: dict[str, dict[str, Any]] = {
    "about-origin": {
        "body": {"inertia": [3.0, 2.5, 2.0], "inertia_about": "origin", "mass": 2.0, "centre_of_mass": [0.1, 0.05, -0.2], "rotor_momentum": [0.1, 0.0, 0.2]},
        "wheel": [{"type": "motor", "axis": [1.0, 2.0, 2.0], "axial_inertia": 0.1, "momentum": 0.3, "stall_torque": 0.02, "no_load_rate": 5.0},
                  {"type": "held", "axis": [0.0, 3.0, 0.0], "axial_inertia": 0.05, "rate": {"times": [0.0, 4.0, 9.0], "values": [0.0, 1.0, 2.0]}},
                  {"type": "friction", "axis": [0.0, 0.0, 1.0], "axial_inertia": 0.02, "rate": 3.0, "friction": 0.001}],
        "torque": [{"type": "constant", "torque": [0.1, 0.0, 0.02], "frame": "inertial",
                    "factor": {"mean": 1.0, "amplitude": 0.5, "rate": 0.7, "phase": 0.2}},
                   {"type": "table", "times": [0.0, 1.0, 3.0], "values": [[0.0, 0.1, 0.0], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1]], "extend": "hold"},
                   {"type": "damping", "coefficient": 0.01, "on": [[0.5, 2.0]]}],
        "initial": {"angular_momentum": [0.5, -0.2, 0.9], "attitude": [0.1, 0.2, -0.3, 0.4]}},
    "altitude": {
        "body": {"inertia": [[3.0, 0.1, 0.0], [0.1, 2.5, 0.2], [0.0, 0.2, 2.0]]},
        "orbit": {"altitude": 4e5, "eccentricity": 0.01, "true_anomaly": 0.3, "radial": [1.0, 0.2, 0.0], "along": [0.0, 1.0, 0.3]},
        "field": {"dipole": {"axis": [0.1, 0.0, 2.0], "strength": 3.1e-5, "radius": 6371200.0}},
        "torque": [{"type": "gravity-gradient"}, {"type": "magnetic", "dipole": [5.0, 1.0, 0.0]}],
        "initial": {"relative_to": "orbit", "attitude": [0.0, 0.0, 0.0, 1.0], "angular_velocity": {"relative_to_orbit": [0.001, 0.0, 0.002]}}},
    "period": {
        "body": {"inertia": [3.0, 2.5, 2.0]}, "orbit": {"period": 5500.0}, "torque": [{"type": "gravity-gradient"}],
        "initial": {"angular_velocity": {"inertial": [0.01, 0.0, 0.02]}, "attitude": [0.5, 0.5, -0.5, 0.5]}},
    "wheels-apart": {
        "body": {"inertia": [3.0, 2.5, 2.0], "mass": 5.0, "centre_of_mass": [0.1, 0.0, 0.02], "wheels_in_inertia": False},
        "wheel": [{"type": "motor", "axis": [1.0, 2.0, 2.0], "axial_inertia": 0.1, "equatorial_inertia": 0.06, "mass": 0.8, "position": [0.3, 0.1, 0.0],
                   "rate": 2.0, "slope": 0.02, "no_load_rate": 5.0}],
        "initial": {"angular_momentum": [0.5, -0.2, 0.9], "velocity": [0.1, 0.0, 0.0]}},
    "fixed": {
        "body": {"inertia": [3.0, 2.5, 2.0], "inertia_about": "mass-centre", "fixed": True, "mass": 2.0, "centre_of_mass": [0.1, 0.05, -0.2]},
        "field": {"gravity": 9.81, "down": [0.0, 0.1, -2.0], "rotating": {"axis": [0.0, 0.0, 2.0], "rate": 0.3, "vector": [1e-4, 0.0, 1e-5]}},
        "torque": [{"type": "weight"}, {"type": "eddy-current", "matrix": [[1e4, 1.0, 0.0], [0.0, 2e4, 3.0], [0.0, 0.0, 1e4]]},
                   {"type": "thrust", "force": [0.0, 1.0, 0.0], "point": [0.2, 0.0, 0.0],
                    "factor": {"times": [0.0, 1.0, 2.0], "values": [0.0, 1.0, 0.5], "interpolation": "cubic"}}],
        "initial": {"angular_velocity": [0.3, -0.5, 0.8]}}}


def scenes() -> dict[str, Scene]:
    """Those that are bundled, and those made up here, for a short time."""
    made = {name: load(name) for name, _ in bundled() if load(name).kind == "general" and load(name).before is None}
    made |= {name: scene_from({"name": name, "kind": "general", "solve": {"times": [2.0, 10.0]}, **each}) for name, each in CONVERTED.items()}
    return {name: each.replace(times=[float(each.times[-1]) / 40, float(each.times[-1]) / 20]) for name, each in made.items()}


SCENES = scenes()


def plain(value: Any) -> Any:
    """Lists and dicts, without what is not given."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items() if each is not None}
    return [plain(each) for each in value] if isinstance(value, tuple | list) else value


def written(scene: Scene) -> dict[str, Any]:
    """The scene as a file would have it, all in SI units."""
    made = {"name": scene.name, "kind": "general", **plain(dict(scene.tables)), **{key: plain(value) for key, value in scene.top.items() if key in ("wheel", "torque")}}
    for form in FORMS:
        made["initial"].pop(form.name, None)
    return made


def keys(name: str, field: Field, value: Any) -> Iterator[str]:
    """The keys of some of the numbers of a value."""
    if field.form == "records":
        for place, item in enumerate(value):
            for part in parts_of(field, item) or ():
                yield from keys(f"{name}[{place}].{part.name}", part, item[part.name])
    elif isinstance(value, dict):
        for part in field.parts:
            yield from keys(f"{name}.{part.name}", part, value[part.name])
    elif isinstance(value, tuple) and isinstance(value[0], tuple):
        yield from (f"{name}[0,1]", f"{name}[{len(value) - 1},{len(value[0]) - 1}]")
    elif isinstance(value, tuple):
        yield from (f"{name}[{place}]" for place in {0, len(value) - 1})
    elif isinstance(value, float):
        yield name


def with_number(scene: Scene, key: str, number: float) -> dict[str, Any]:
    """The file of the scene with one number written into it."""
    made = written(scene)
    for each in {key, "body.inertia[1,0]"} if key == "body.inertia[0,1]" else {key}:
        home: Any = made
        *path, last = [int(part) if part.isdigit() else part for part in re.findall(r"[\w-]+", each)]
        for part in path:
            home = home[part]
        home[last] = number
    return made


@pytest.mark.parametrize("name", SCENES)
def test_a_row_of_any_number_is_what_the_scene_with_that_number_comes_to(name: str) -> None:
    scene = SCENES[name]
    orbits = any(scene.tables["orbit"][name] is not None for name in ("radius", "altitude", "rate", "period"))
    inputs = [given for given in inputs_of(FAMILIES["general"]) if orbits or given[1] != "orbit"]
    found = [key for full, table, field in inputs for key in keys(full, field, scene.tables[table][field.name] if table else scene.top[field.name])]
    assert len(found) > 13
    found = at_length(found[len(found) % 3::3], found)
    answered = 0
    for key in found:
        given = float(numbers_of(scene)[place_of(scene, key).numbers[0]])
        number = given * 1.01 if given else 0.003
        rows = sweep(scene, {key: [given, number, given]}, threads=2)
        try:
            answer = gyrostat.solve(with_number(scene, key, number))
        except SceneError:
            continue
        answered += 1
        assert rows["model"].values[1] == answer.model, key
        for column, error in answer.error.items():
            assert rows[column].values[1].tobytes() == answer[column].tobytes(), (key, column)
            assert rows[f"{column}_error"].values[1] == error, (key, column)
        assert all(rows[column].values[0].tobytes() == rows[column].values[2].tobytes() for column in answer.error)
    assert answered > 0.8 * len(found)


def test_numbers_that_vary_together_are_converted_together() -> None:
    scene = SCENES["altitude"]
    varied = {"orbit.altitude": "normal(400 km, 5 km)", "orbit.radial[1]": "uniform(-0.3, 0.3)",
              "initial.angular_velocity.relative_to_orbit[1]": "normal(0, 0.1 deg/s)",
              "body.inertia[0][1]": "normal(0.1, 5%)", "initial.attitude[3]": "uniform(0.5, 1.5)"}
    rows = sweep(scene, varied, n=40, seed=3)
    for row in (0, 17, 39):
        data = written(scene)
        for key in varied:
            number = float(rows[key.replace("][", ",")].values[row])
            data = with_number(scene_from(data), key.replace("][", ","), number) if "attitude" not in key else data
        data["initial"]["attitude"] = [0.0, 0.0, 0.0, float(rows["initial.attitude[3]"].values[row])]
        answer = gyrostat.solve(data)
        assert all(rows[column].values[row].tobytes() == answer[column].tobytes() for column in answer.error)


def test_a_number_of_an_attitude_of_any_length_is_that_of_the_scene() -> None:
    scene = {"name": "turned", "solve": {"times": [10.0], "ask": ["attitude"]}, "body": {"inertia": [3.0, 4.0, 5.0]},
             "initial": {"angular_velocity": [0.1, 0.2, 0.3], "attitude": [1.0, 2.0, 3.0, 4.0]}}
    rows = sweep(scene, {"initial.attitude[3]": [4.0, -1.0, 0.0]})
    for row, number in enumerate((4.0, -1.0, 0.0)):
        scene["initial"]["attitude"][3] = number
        assert rows["attitude"].values[row].tobytes() == gyrostat.solve(scene)["attitude"].tobytes()


def test_a_coefficient_that_stands_for_a_matrix_is_one_number_or_three() -> None:
    scene = SCENES["about-origin"]
    whole, part = sweep(scene, {"torque[2].coefficient": [0.01, 0.03]}), sweep(scene, {"torque[2].coefficient[1]": [0.01, 0.03]})
    data = written(scene)
    for rows, value in ((whole, 0.03), (part, [0.01, 0.03, 0.01])):
        data["torque"][2]["coefficient"] = value
        answer = gyrostat.solve(data)
        assert all(rows[column].values[1].tobytes() == answer[column].tobytes() for column in answer.error)
    with pytest.raises(DomainError, match="one component varies"):
        place_of(SCENES["fixed"], "torque[1].matrix")
    with pytest.raises(DomainError, match="such as initial.angular_velocity.inertial"):
        place_of(SCENES["period"], "initial.angular_velocity[0]")


@pytest.mark.parametrize("settings", [{"threads": 1}, {"threads": 5}, {"chunk": 7}])
def test_threads_chunks_and_shards_change_no_bit(settings: dict[str, int]) -> None:
    scene = SCENES["about-origin"].replace(ask=["attitude", "rotor_rate"])
    varied = {"wheel[0].momentum": "normal(0.3, 10%)", "wheel[0].stall_torque": "uniform(0.01, 0.03)", "body.mass": "normal(2, 1%)",
              "torque[0].factor.amplitude": [0.1, 0.2]}
    whole, other = sweep(scene, varied, n=60), sweep(scene, varied, n=60, **settings)
    parts = merge([sweep(scene, varied, n=60, shard=(i, 3)) for i in (1, 2, 3)])
    for name in ("attitude", "rotor_rate", "rotor_rate_error", "excess"):
        assert whole[name].values.tobytes() == other[name].values.tobytes() == parts[name].values.tobytes()
    assert np.all(whole["met"]) and len(np.unique(whole["attitude"].values[:, -1, 0])) == 60


def test_rows_without_an_answer_say_why() -> None:
    scene = SCENES["about-origin"]
    rows = sweep(scene, cases={"wheel[0].axis[0]": [1.0, 0.0, 1.0, 1.0, 1.0], "body.mass": [2.0, 2.0, -1.0, 60.0, 2.0],
                               "wheel[2].friction": [0.0, 1e-3, 0, 0, -1.0], "torque[1].times[1]": [1.0, 1.0, 1.0, 1.0, 1.0]})
    assert rows["reason"].values.tolist()[:3] == ["", "", "body.mass is not > 0"]
    assert rows["reason"].values[3] == "the moments of inertia must be positive" and rows["reason"].values[4] == "wheel[2].friction is not >= 0"
    assert np.isnan(rows["angular_velocity"].values[2:]).all()
    none = sweep(scene, cases={f"wheel[0].axis[{i}]": [0.0, 1.0] for i in range(3)})
    assert none["reason"].values.tolist() == ["a number is NaN or infinite", ""]
    late = sweep(scene, {"torque[1].times[1]": [1.0, 4.0]})
    assert late["reason"].values.tolist() == ["", "the numbers are not in increasing order"]
    turned = sweep(SCENES["altitude"], {"initial.attitude[3]": [0.0, 1.0]})
    assert turned["reason"].values[0] != "" and turned["reason"].values[1] == ""


@pytest.mark.parametrize("form", ["dcm_body_to_inertial", "dcm_inertial_to_body"])
def test_a_row_whose_direction_cosines_are_no_rotation_says_so(form: str) -> None:
    c, s = 0.8, 0.6
    given = {"name": "test", "kind": "general", "solve": {"times": [0.0, 3.0]}, "body": {"inertia": [3.0, 2.5, 2.0]},
             "torque": [{"type": "constant", "torque": [0.1, 0.0, 0.2], "frame": "inertial"}],
             "initial": {form: [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], "angular_velocity": [0.3, -0.5, 0.8]}}
    key = f"initial.{form}"
    angle = 1.1
    turn = {f"{key}[0,0]": np.cos(angle), f"{key}[0,1]": -np.sin(angle), f"{key}[1,0]": np.sin(angle), f"{key}[1,1]": np.cos(angle)}
    own = {f"{key}[0,0]": c, f"{key}[0,1]": -s, f"{key}[1,0]": s, f"{key}[1,1]": c}
    lines = [turn, own | {f"{key}[0,0]": c + 1e-7}, own | {f"{key}[0,0]": c + 1e-10}, own | {f"{key}[0,0]": 3.0}, own | {f"{key}[0,0]": np.nan},
             {name: -value if name.endswith("[1,0]") or name.endswith("[1,1]") else value for name, value in own.items()}, own]
    rows = sweep(scene_from(given), cases={name: [float(line[name]) for line in lines] for name in own}, threads=2)
    reasons = rows["reason"].values.tolist()
    assert [reason.partition(":")[0] for reason in reasons] == ["", "not-orthonormal", "", "not-orthonormal", f"{key}[0,0] is not finite", "not-orthonormal", ""]
    assert "mirror" in reasons[5] and "row 1 has the length" in reasons[1]
    assert np.isnan(rows["attitude"].values[[1, 3, 4, 5]]).all() and np.isfinite(rows["attitude"].values[[0, 2, 6]]).all()
    # the row that is rounded has its warning, and each that has an answer is the scene alone
    flag = rows["warnings"].attrs["flag_masks"][rows["warnings"].attrs["flag_meanings"].split().index("not-orthonormal")]
    assert [bool(bits & flag) for bits in rows["warnings"].values] == [False, False, True, False, False, False, False]
    for row in (0, 2, 6):
        line, matrix = lines[row], [list(each) for each in given["initial"][form]]  # type: ignore[index]
        for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
            matrix[i][j] = float(line[f"{key}[{i},{j}]"])
        answer = gyrostat.solve({**given, "initial": {**given["initial"], form: matrix}})  # type: ignore[dict-item]
        assert rows["attitude"].values[row].tobytes() == answer["attitude"].tobytes()
        assert (bool([warning for warning in answer.warnings if warning.code == "not-orthonormal"])) == (row == 2)
    with pytest.raises(DomainError, match=re.escape(f"{key}[0,1], counting")):
        place_of(scene_from(given), key)


def test_rounded_direction_cosines_of_a_scene_are_told_in_every_row() -> None:
    c, s = 0.8 + 1e-10, 0.6
    scene = {"name": "test", "kind": "free", "solve": {"times": [0.0, 3.0]}, "body": {"inertia": [3.0, 2.5, 2.0]},
             "initial": {"dcm_body_to_inertial": [[c, -s, 0.0], [s, 0.8, 0.0], [0.0, 0.0, 1.0]], "angular_velocity": [0.3, -0.5, 0.8]}}
    rows = sweep(scene, {"initial.angular_velocity[0]": [0.1, 0.2]})
    told = rows["warnings"].attrs["flag_meanings"].split()
    assert told[-1] == "not-orthonormal" and all(bits >> (len(told) - 1) & 1 for bits in rows["warnings"].values)


def test_a_brake_that_stops_the_body_is_a_reason_or_a_stop_time() -> None:
    scene = scene_from({"name": "test", "kind": "general", "solve": {"times": [1.0, 5.0]}, "body": {"inertia": [3.0, 2.5, 2.0]},
                        "torque": [{"type": "brake", "limit": [0.1, 0.2, 0.1]}], "wheel": [{"type": "friction", "axis": [0, 0, 1], "axial_inertia": 0.1,
                                                                                           "rate": 0.1, "friction": 0.01}],
                        "initial": {"angular_velocity": [0.3, -0.5, 0.8]}})
    rows = sweep(scene, {"torque[0].limit[1]": [0.1, 20.0]})
    assert rows["reason"].values[0] == "" and np.isfinite(rows["angular_velocity"].values[0]).all()
    assert rows["reason"].values[1] == "" or "brake" in rows["reason"].values[1]


def test_wheels_and_torques_go_by_their_names_too() -> None:
    scene = SCENES["cubesat-three-wheels"]
    assert place_of(scene, "wheel.y.torque.values[0]").numbers == place_of(scene, "wheel[1].torque.values[0]").numbers
    assert place_of(scene, "wheel.z.axis[2]").key == "wheel.z.axis[2]"
    assert {"wheel.z.rate"} <= set(sweep(scene, {"wheel.z.rate": [1.0, 2.0]}).data_vars)
    with pytest.raises(DomainError, match="can vary"):
        place_of(scene, "wheel.pitch.rate")
    with pytest.raises(DomainError, match="stands for, too"):
        sweep(scene, {"wheel.z.rate": [1.0, 2.0], "wheel[2].rate": [1.0, 2.0]})
    odd = scene.replace(**{f"wheel[{i}].name": name for i, name in enumerate(("rw/1", "rw", "rw.2 b"))})
    for i, name in enumerate(("rw/1", "rw", "rw.2 b")):
        place = place_of(odd, f"wheel.{name}.axis[2]")
        assert place.numbers == place_of(odd, f"wheel[{i}].axis[2]").numbers
        assert place.key == ("wheel.rw.axis[2]" if name == "rw" else f"wheel[{i}].axis[2]")  # no file takes the names of the others


@pytest.mark.parametrize(("key", "told"), [
    ("wheel[7].rate", "the scene has 3 of wheel"), ("wheel[0].typ", "it has type, axis, axial_inertia"), ("wheel[0].type", "numbers alone"),
    ("body.fixed", "can vary"), ("wheel[0].rate", "no value"), ("wheel[0].axis", r"wheel\[0\].axis\[0\]"), ("body.mass[1]", "one number"),
    ("torque[1].values[1]", r"such as torque\[1\].values\[0,1\]"), ("torque[0].factor.means", "it has mean"), ("orbit.altitude", "no value"),
    ("initial.euler.angles[0]", "can vary"), ("solve.tolerance", "can vary")])
def test_what_cannot_vary_says_so(key: str, told: str) -> None:
    with pytest.raises(DomainError, match=told):
        place_of(SCENES["about-origin"], key)


def test_the_command_and_the_table_vary(tmp_path: Path) -> None:
    file = tmp_path / "rows.nc"
    assert main(["sweep", "iss-drift", "--vary", "body.inertia[0,0]=normal(1.28e8, 1%)", "-n", "3", "--ask", "angular_velocity", "-o", str(file)]) == 0
    import xarray

    with xarray.open_dataset(file) as rows:
        assert rows.sizes["row"] == 3 and rows.attrs["kind"] == "general"
    scene = scene_from({**written(SCENES["period"]), "vary": {"n": 4, "orbit.period": "uniform(90 min, 95 min)"}})
    assert sweep(scene).sizes["row"] == 4
    with pytest.raises(SceneError, match="no key of this name can vary"):
        scene_from({**written(SCENES["period"]), "vary": {"n": 3, "body.weight": "normal(1, 1%)"}})


def test_a_column_of_angles_is_swept() -> None:
    scene = SCENES["fixed"].replace(**{"solve.euler": "3-2-1"}, ask=["euler", "attitude"])
    rows = sweep(scene, {"body.mass": [2.0, 3.0]})
    answer = gyrostat.solve(scene)
    assert rows["euler"].values[0].tobytes() == answer["euler"].tobytes() and rows["euler_error"].values[0] == answer.error["euler"]


# Scenes whose start is not their own, or not exact, or at another time than 0, and what of them varies.
GOING_ON: dict[str, tuple[list[str], dict[str, Any]]] = {
    "seized": (["body.inertia[0]", "body.mass", "wheel[0].axial_inertia", "wheel[1].angle"], {
        "from": {"file": "cubesat-three-wheels", "keep": "momentum"}, "body": {"inertia": [0.041, 0.039, 0.0092], "mass": 4.0},
        "wheel": [{"name": "x", "type": "free", "axis": [1.0, 0.0, 0.0], "axial_inertia": 2.4e-5},
                  {"name": "y", "type": "free", "axis": [0.0, 1.0, 0.0], "axial_inertia": 2.4e-5, "angle": 0.5},
                  {"name": "z", "type": "locked", "axis": [0.0, 0.0, 1.0]}]}),
    "clock": (["torque[0].factor.phase", "field.rotating.rate", "orbit.true_anomaly", "orbit.altitude", "wheel[0].torque.values[1]", "initial.angular_velocity[1]",
               "initial.attitude[2]"], {
        "body": {"inertia": [3.0, 2.5, 2.0]}, "orbit": {"altitude": 4e5, "eccentricity": 0.1, "true_anomaly": 0.4},
        "field": {"rotating": {"axis": [0.0, 0.3, 1.0], "rate": 0.03, "vector": [1e-4, 0.0, 2e-4]}},
        "wheel": [{"type": "torque", "axis": [0.0, 1.0, 0.0], "axial_inertia": 0.01, "rate": 5.0,
                   "torque": {"times": [0.0, 95.0, 130.0], "values": [0.01, 0.03, -0.02], "extend": "hold"}}],
        "torque": [{"type": "constant", "torque": [0.01, 0.0, 0.002], "on": [[10.0, 120.0]], "factor": {"mean": 1.0, "amplitude": 0.3, "rate": 0.4, "phase": 0.2}},
                   {"type": "magnetic", "dipole": [1.0, 2.0, 0.5]}, {"type": "gravity-gradient"}],
        "initial": {"time": 90.0, "angular_velocity": [0.3, -0.5, 0.8], "attitude": [0.5, 0.5, -0.5, 0.5]}}),
    "error": (["initial.error.attitude", "initial.error.angular_velocity", "body.inertia[2]"], {
        "body": {"inertia": [3.0, 2.5, 2.0]}, "initial": {"angular_velocity": [0.3, -0.5, 0.8], "error": {"attitude": 1e-5, "angular_velocity": 1e-8}}})}


@pytest.mark.parametrize("name", GOING_ON)
def test_rows_of_a_scene_that_goes_on_are_what_each_comes_to_alone(name: str) -> None:
    varied, tables = GOING_ON[name]
    data = {"name": name, "kind": "general", "solve": {"times": [91.0, 110.0], "tolerance": 1e-4}, **tables}
    scene = scene_from(data)
    for key in varied:
        number = 1.01 * float(numbers_of(scene)[place_of(scene, key).numbers[0]])
        rows = sweep(scene, {key: [number, number * 1.001]}, threads=2)
        assert rows["time"].values.tolist() == [91.0, 110.0]
        made = copy.deepcopy(data)
        home: Any = made
        *path, last = [int(part) if part.isdigit() else part for part in re.findall(r"[\w-]+", key)]
        for part in path:
            home = home[part]
        home[last] = number
        answer = gyrostat.solve(made)
        assert rows["model"].values[0] == answer.model, key
        for column, error in answer.error.items():
            assert rows[column].values[0].tobytes() == answer[column].tobytes(), (key, column)
            assert rows[f"{column}_error"].values[0] == error, (key, column)
        codes = {code for bit, code in enumerate(FAMILIES["general"].facts.warnings) if rows["warnings"].values[0] >> bit & 1}
        assert codes == {warning.code for warning in answer.warnings} & set(FAMILIES["general"].facts.warnings), key


def test_what_a_row_of_a_scene_that_goes_on_may_be_and_what_not(tmp_path: Path) -> None:
    varied, tables = GOING_ON["error"]
    scene = scene_from({"name": "error", "kind": "general", "solve": {"times": [1.0], "tolerance": 1e-4}, **tables})
    rows = sweep(scene, {"body.inertia[2]": [2.0, 9.0, 2.1], "initial.error.attitude": [0.0, 1e-3]})
    assert [bool(reason) for reason in rows["reason"].values] == [False, False, True, True, False, False]
    assert rows["attitude_error"].values[1] > 1e-3 > rows["attitude_error"].values[0]
    with pytest.raises(DomainError, match="all rows have one clock"):
        sweep(scene_from({"name": "clock", "kind": "general", "solve": {"times": [91.0]}, **GOING_ON["clock"][1]}), {"initial.time": [80.0, 90.0]})
    # a part of a study whose scene before has changed is one of another study
    first = tmp_path / "first.toml"
    text = 'name = "first"\n[solve]\ntimes = [1.0]\n[body]\ninertia = [3.0, 2.5, 2.0]\n[initial]\nangular_velocity = [0.1, 0.2, %s]\n'
    studies = []
    for rate in (0.3, 0.4):
        first.write_text(text % rate)
        later = scene_from({"name": "later", "kind": "general", "from": str(first), "solve": {"times": [2.0]}, "body": {"inertia": [3.0, 2.5, 2.0]}})
        studies.append(sweep(later, {"body.inertia[0]": [3.0, 3.1]}))
    assert studies[0].attrs["study"] != studies[1].attrs["study"]
    assert np.all(studies[0]["attitude"].values != studies[1]["attitude"].values)
    rows = sweep(later, {"body.inertia[0]": [3.0, 99.0]})
    first.unlink()  # a report looks for no file: that one is not there would be no reason of a row
    assert rows["reason"].values[1] and in_words(rows, str(rows["reason"].values[1])) == ""


def test_a_resumed_sweep_has_the_types_of_one_that_ran_through(tmp_path: Path) -> None:
    def swept(**how: Any) -> Any:
        return sweep("cubesat-three-wheels", {"wheel[1].rate": "normal(10, 10%)"}, n=6, times=[21.0], ask=["attitude", "rotor_rate"], chunk=2, **how)

    whole, first = swept(), swept(parts=tmp_path)
    resumed = swept(parts=tmp_path)  # every part is read again
    for made in (first, resumed):
        assert made.equals(whole)
        for name, values in whole.variables.items():
            if values.dtype.kind in "if":
                assert made[name].dtype == values.dtype, name


def test_a_row_that_a_family_answers_says_that_it_warns() -> None:
    scene = gyrostat.scenes.load("iss-torque-pulse", times=[5.0, 20.0], ask="all").replace(**{"torque[0].on[0,0]": 0.0})
    codes = {warning.code for warning in gyrostat.solve(scene).warnings}
    assert {"no-spin", "unstable-spin"} <= codes
    warnings = sweep(scene, {"torque[0].on[0,0]": [0.0]})["warnings"]
    told = dict(zip(warnings.attrs["flag_meanings"].split(), warnings.attrs["flag_masks"], strict=True))
    assert warnings.values[0] & told["of-family"]
    assert bool(warnings.values[0] & told["no-value"]) == ("no-value" in codes)
