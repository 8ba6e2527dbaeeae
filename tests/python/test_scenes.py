# SPDX-License-Identifier: BSD-3-Clause
"""Scene files: what is right is read, what is wrong is named with its remedy, and nothing else ever escapes."""

import math
import random
import re
import string
from pathlib import Path

import numpy as np
import pytest
from conftest import GOOD
from gyrostat.errors import SceneError
from gyrostat.fields import KINDS, RUNGS
from gyrostat.scenes import bundled, load, parse_override, scene_from
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st


def swap(old: str, new: str) -> str:
    assert old in GOOD
    return GOOD.replace(old, new)


# A scene text, and what the message about it must contain: key, value, and the remedy.
MISTAKES: dict[str, tuple[str, list[str]]] = {
    "not TOML": (swap("duration = 100.0", "duration = "), [":6", "not TOML"]),
    "duplicate key": (swap("drag = 2.0e-4", "drag = 2.0e-4\ndrag = 1.0"), ["not TOML", "drag"]),
    "unknown kind": (swap('"deceleration"', '"decelaration"'), ["kind", "decelaration", 'did you mean "deceleration"']),
    "kind of a later version": (swap('"deceleration"', '"rotor"'), ["kind", "rotor", "not built yet", "deceleration"]),
    "kind missing": (swap('kind = "deceleration"\n', ""), ["kind", "missing", 'kind = "deceleration"']),
    "kind not text": (swap('"deceleration"', "3"), ["kind = 3", "deceleration"]),
    "name missing": (swap('name = "test"\n', ""), ["name", "missing"]),
    "name empty": (swap('"test"', '""'), ["name", "empty"]),
    "name not text": (swap('"test"', "7"), ["name = 7", "an integer, not text", "quotes"]),
    "unknown key": (swap("drag = 2", "dragg = 2"), ["torque.dragg", "did you mean drag?"]),
    "unknown key at the top": (swap("[solve]", "colour = 1\n[solve]"), [":5", "colour = 1", "unknown key"]),
    "unknown table": (GOOD + "\n[motor]\nslope = 1\n", ["motor", "unknown table"]),
    "misspelt table": (swap("[torque]", "[torques]"), ["torques", "did you mean torque?", "[torque] is missing"]),
    "key in the wrong table": (swap("[torque]", "[torque]\ninertia = [1, 1, 1]"), ["torque.inertia", "belongs in [body]"]),
    "table missing": (GOOD.split("[initial]")[0], ["[initial] is missing", "angular_velocity or angular_momentum"]),
    "table given as a value": (GOOD.split("[body]")[0].replace("[solve]", "body = 3\n[solve]"), ["body = 3", "not a table"]),
    "array of tables": (swap("[body]", "[[body]]"), ["body", "an array, not a table"]),
    "missing key": (swap("drag = 2.0e-4\n", ""), ["torque.drag", "missing", "1/s"]),
    "text for a number": (swap("drag = 2.0e-4", 'drag = "2.0e-4"'), ["torque.drag", '"2.0e-4"', "without quotes"]),
    "truth value for a number": (swap("drag = 2.0e-4", "drag = true"), ["torque.drag = true", "a truth value", "number"]),
    "truth value in an array": (swap("[35.0, 22.0, 16.0]", "[35.0, true, 16.0]"), ["body.inertia", "element 2", "truth value"]),
    "date for a number": (swap("drag = 2.0e-4", "drag = 2020-01-01"), ["torque.drag = 2020-01-01", "date", "number"]),
    "array for a number": (swap("drag = 2.0e-4", "drag = [1.0]"), ["torque.drag = [1.0]", "an array"]),
    "number for an array": (swap("[0.005, 0.008, 0.010]", "0.005"), ["torque.control = 0.005", "3 numbers"]),
    "not a number": (swap("drag = 2.0e-4", "drag = nan"), ["torque.drag = nan", "not finite"]),
    "infinite": (swap("[40.0, 25.0, 16.5]", "[40.0, -inf, 16.5]"), ["initial.angular_momentum", "element 2 = -inf", "finite"]),
    "integer beyond double precision": (swap("2.0e-4", "1" + "0" * 400), ["torque.drag", "not finite"]),
    "integer beyond reading": (swap("2.0e-4", "1" * 5000), ["cannot be read"]),
    "absurd size": (swap("[40.0, 25.0, 16.5]", "[1e200, 0, 0]"), ["initial.angular_momentum", "out of range", "1e+60"]),
    "zero moment": (swap("[35.0, 22.0, 16.0]", "[35.0, 22.0, 0.0]"), ["body.inertia", "element 3 = 0.0", "kg m^2"]),
    "negative moment": (swap("[35.0, 22.0, 16.0]", "[35.0, -22.0, 16.0]"), ["body.inertia", "element 2 = -22.0", ">="]),
    "triangle inequality": (swap("[35.0, 22.0, 16.0]", "[50.0, 22.0, 16.0]"), ["body.inertia", "50", "22", "16", "triangle"]),
    "moments of two units": (swap("[35.0, 22.0, 16.0]", "[35.0, 35.0, 1e-13]"), ["body.inertia", "1e-13", "unit"]),
    "two moments": (swap("[35.0, 22.0, 16.0]", "[35.0, 22.0]"), ["body.inertia", "2 elements", "3 numbers"]),
    "tensor not symmetric": (swap("[35.0, 22.0, 16.0]", "[[35, 1, 0], [2, 22, 0], [0, 0, 16]]"),
                             ["body.inertia", "(1, 2) = 1.0", "(2, 1) = 2.0", "symmetric"]),
    "tensor not positive": (swap("[35.0, 22.0, 16.0]", "[[1, 5, 0], [5, 1, 0], [0, 0, 1]]"), ["body.inertia", "-4", "positive"]),
    "tensor with a short row": (swap("[35.0, 22.0, 16.0]", "[[35, 1], [1, 22, 0], [0, 0, 16]]"), ["body.inertia", "row 1", "three rows"]),
    "tensor against the triangle": (swap("[35.0, 22.0, 16.0]", "[[9, 0, 0], [0, 2, 0], [0, 0, 3]]"), ["body.inertia", "9", "triangle"]),
    "rotor momentum of two numbers": (swap("[0.0, 0.0, 0.0]", "[0.0, 0.0]"), ["body.rotor_momentum", "2 elements"]),
    "negative control": (swap("[0.005, 0.008, 0.010]", "[0.005, -0.008, 0.010]"), ["torque.control", "element 2 = -0.008", ">= 0"]),
    "negative drag": (swap("2.0e-4", "-2.0e-4"), ["torque.drag = -0.0002", ">= 0"]),
    "unknown law": (swap('\nlaw = "total"', '\nlaw = "totl"'), ["torque.law", '"totl"', 'did you mean "total"?', "carrier"]),
    "unknown drag law": (swap('drag_law = "total"', 'drag_law = "both"'), ["torque.drag_law", '"both"', "total, carrier"]),
    "unknown model": (swap('model = "auto"', 'model = "averaged-3"'), ["solve.model", "averaged-3", "averaged-2"]),
    "unknown integrator": (swap('integrator = "auto"', 'integrator = "euler"'), ["solve.integrator", "euler", "taylor"]),
    "integrator of a later kind": (swap('integrator = "auto"', 'integrator = "radau"'), ["solve.integrator", "radau", "taylor"]),
    "unknown elliptic backend": (swap('elliptic = "auto"', 'elliptic = "boost"'), ["solve.elliptic", "boost", "native"]),
    "list for a choice": (swap('model = "auto"', 'model = ["full"]'), ["solve.model", "an array, not text"]),
    "two starts": (swap("[initial]", "[initial]\nangular_velocity = [1.0, 0.0, 0.0]"), ["initial.angular_momentum", "either"]),
    "no start": (swap("angular_momentum = [40.0, 25.0, 16.5]\n", ""), ["initial.angular_velocity", "angular_momentum"]),
    "zero quaternion": (swap("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 0.0, 0.0]"), ["initial.attitude", "zero quaternion", "unit"]),
    "quaternion of another norm": (swap("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 3.0, 4.0]"),
                                   ["initial.attitude", "norm is 5", "[0, 0, 0.6, 0.8]"]),
    "quaternion of three numbers": (swap("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 1.0]"), ["initial.attitude", "4 numbers"]),
    "times beside duration": (swap("samples = 11", "samples = 11\ntimes = [1.0]"), ["solve.times", "either"]),
    "no times": (swap("duration = 100.0\nsamples = 11\n", ""), ["solve.duration", "duration and samples or times"]),
    "duration alone": (swap("samples = 11\n", ""), ["solve.samples", "missing"]),
    "empty times": (swap("duration = 100.0\nsamples = 11", "times = []"), ["solve.times", "no times"]),
    "times out of order": (swap("duration = 100.0\nsamples = 11", "times = [0, 2, 1]"), ["solve.times", "element 3 = 1.0", "increasing"]),
    "a time twice": (swap("duration = 100.0\nsamples = 11", "times = [0, 2, 2]"), ["solve.times", "element 3", "increasing"]),
    "negative time": (swap("duration = 100.0\nsamples = 11", "times = [-1, 2]"), ["solve.times", "element 1 = -1", ">= 0"]),
    "times not an array": (swap("duration = 100.0\nsamples = 11", "times = 5.0"), ["solve.times = 5.0", "an array"]),
    "zero duration": (swap("100.0", "0.0"), ["solve.duration = 0.0", "> 0"]),
    "one sample": (swap("samples = 11", "samples = 1"), ["solve.samples = 1", "from 2"]),
    "samples not an integer": (swap("samples = 11", "samples = 11.0"), ["solve.samples = 11.0", "integer", "401"]),
    "samples without end": (swap("samples = 11", "samples = 2000000000"), ["solve.samples", "1000000"]),
    "zero tolerance": (swap("tolerance = 1e-6", "tolerance = 0.0"), ["solve.tolerance = 0.0", "1e-15"]),
    "tolerance of one": (swap("tolerance = 1e-6", "tolerance = 1.0"), ["solve.tolerance = 1.0", "0.5"]),
}


@pytest.mark.parametrize("label", MISTAKES)
def test_mistake_names_file_key_value_and_remedy(label: str, tmp_path: Path) -> None:
    text, wanted = MISTAKES[label]
    file = tmp_path / "bad.toml"
    file.write_text(text)
    with pytest.raises(SceneError) as caught:
        load(file)
    message = str(caught.value)
    assert str(file) in message
    for part in wanted:
        assert part in message
    for mistake in caught.value.mistakes:
        assert mistake.remedy
        assert len(str(mistake)) < 600


def test_enough_mistakes() -> None:
    assert len(MISTAKES) >= 40


def test_every_mistake_is_reported_at_once(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text(swap("2.0e-4", "-1.0").replace("samples = 11", "samples = 1").replace("[35.0,", '["a",'))
    with pytest.raises(SceneError) as caught:
        load(file)
    assert [mistake.key for mistake in caught.value.mistakes] == ["solve.samples", "body.inertia", "torque.drag"]


def test_the_line_is_named(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text(swap("2.0e-4", "-1.0"))
    line = GOOD.splitlines().index("drag = 2.0e-4") + 1
    with pytest.raises(SceneError, match=re.escape(f"{file}:{line}: torque.drag")):
        load(file)


def test_files_that_are_no_scenes(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="directory"):
        load(tmp_path)
    with pytest.raises(SceneError, match="no such file"):
        load(tmp_path / "absent.toml")
    with pytest.raises(SceneError, match="did you mean the bundled scene tiangong-1"):
        load("tiangong1")
    with pytest.raises(SceneError, match="cannot be read"):
        load("a\0b")
    with pytest.raises(SceneError, match="cannot be read"):
        load("x" * 5000)
    file = tmp_path / "latin.toml"
    file.write_bytes(GOOD.replace("a test", "é").encode("latin-1"))
    with pytest.raises(SceneError, match="not UTF-8"):
        load(file)
    file.write_text("a = " + "[" * 100_000)
    with pytest.raises(SceneError):
        load(file)
    file.write_text("")
    with pytest.raises(SceneError, match="kind"):
        load(file)


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    file = tmp_path / "bom.toml"
    file.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
    assert load(file).name == "test"


def test_values_are_read(scene_file: Path) -> None:
    scene = load(scene_file)
    assert scene.kind == "deceleration" and scene.path == scene_file
    assert scene.times.shape == (11,) and scene.times[-1] == 100.0
    assert scene.tables["torque"]["control"] == (0.005, 0.008, 0.01)
    assert scene.tolerance == 1e-6 and scene.model == "auto"


def test_defaults_are_filled_in() -> None:
    scene = scene_from({"name": "a", "kind": "deceleration", "solve": {"times": [1]}, "body": {"inertia": [1, 1, 1]},
                        "torque": {"control": [0, 0, 0], "drag": 0}, "initial": {"angular_velocity": [1, 0, 0]}})
    assert scene.tables["body"]["rotor_momentum"] == (0.0, 0.0, 0.0)
    assert scene.tables["torque"]["law"] == "total"
    assert scene.tables["initial"]["attitude"] is None
    assert scene.to_dict()["solve"]["integrator"] == "auto"
    assert "attitude" not in scene.to_dict()["initial"]


def test_a_scene_survives_its_dict(scene_file: Path) -> None:
    scene = load(scene_file)
    assert scene_from(scene.to_dict()).to_dict() == scene.to_dict()


def test_a_nearly_unit_quaternion_is_normalised() -> None:
    q = np.array([0.5, 0.5, 0.5, 0.5]) * (1 + 3e-7)
    scene = load("near-separatrix", attitude=q)
    assert math.hypot(*scene.tables["initial"]["attitude"]) == pytest.approx(1, abs=4e-16)


def test_a_flat_body_and_a_symmetric_one_are_bodies() -> None:
    for inertia in ([1.0, 2.0, 3.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [[2, 0, 0], [0, 2, 0], [0, 0, 2]]):
        assert load("near-separatrix", inertia=inertia)


def test_overrides_are_checked_and_take_the_place_of_their_alternative(scene_file: Path) -> None:
    scene = load(scene_file, **{"torque.drag": 0, "tolerance": 1e-9, "times": np.array([1.0, 2.0])})
    assert scene.tables["torque"]["drag"] == 0.0 and scene.tolerance == 1e-9
    assert list(scene.times) == [1.0, 2.0]
    assert list(scene.replace(angular_velocity=[1, 2, 3]).to_dict()["initial"]) == ["angular_velocity", "attitude"]
    assert scene.replace(duration=5.0, samples=3).times.tolist() == [0.0, 2.5, 5.0]
    assert scene.replace() is scene
    for wrong in ({"drag": -1}, {"tolernce": 1}, {"torque.dragg": 1}, {"a.b.c": 1}, {"name.x": 1}, {"duration": 5.0}):
        with pytest.raises(SceneError):
            scene.replace(**wrong)


@pytest.mark.parametrize(("text", "key", "value"), [
    ("tolerance=1e-9", "tolerance", 1e-9), ("torque.control=[1, 2, 3]", "torque.control", [1, 2, 3]),
    ("model=full", "model", "full"), ('model = "averaged-2"', "model", "averaged-2"), ("model=averaged-2", "model", "averaged-2"),
    ("samples=5", "samples", 5),
])
def test_overrides_of_the_command_line(text: str, key: str, value: object) -> None:
    assert parse_override(text) == (key, value)


@pytest.mark.parametrize("text", ["tolerance", "=1", "a b=1", "drag=", "drag=1 2", "drag=1\nkind=2", "drag=[", "a..b=1", "x=" + "[" * 9999])
def test_overrides_that_cannot_be_read(text: str) -> None:
    with pytest.raises(SceneError, match="--set"):
        parse_override(text)


def test_bundled_scenes_have_names_and_sources() -> None:
    scenes = bundled()
    assert len(scenes) >= 6
    for name, file in scenes:
        scene = load(name)
        assert scene.name == file.stem and scene.source
        assert scene.kind in KINDS and scene.model in ("auto", *RUNGS[scene.kind])


# ---- fuzz: only SceneError ever escapes ----


def survives(text: str | bytes, folder: Path) -> None:
    file = folder / "fuzz.toml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    try:
        load(file).times
    except SceneError as error:
        assert error.mistakes and str(error)


def test_mutated_texts(tmp_path: Path) -> None:
    draw = random.Random(20260101)
    pieces = [*string.printable, "[[", "]]", "= nan", "= -inf", "1e999", "true", '"""', "{}", "[]", "\\u0000", "é", "9" * 30,
              "[solve]", "[body]", "kind", "0x", "1979-05-27", "\0"]
    lines = GOOD.splitlines(keepends=True)
    for _ in range(1500):
        text = "".join(lines)
        for _ in range(draw.randint(1, 4)):
            i, j = sorted((draw.randrange(len(text) + 1), draw.randrange(len(text) + 1)))
            match draw.randrange(5):
                case 0:
                    text = text[:i] + draw.choice(pieces) + text[i:]
                case 1:
                    text = text[:i] + text[i + draw.randint(1, 3):]
                case 2:
                    text = text[:i] + text[j:]
                case 3:
                    text = text[:i] + text[i:j] + text[i:j] + text[j:]
                case 4:
                    shuffled = text.splitlines(keepends=True)
                    draw.shuffle(shuffled)
                    text = "".join(shuffled)
        survives(text, tmp_path)


def test_random_bytes(tmp_path: Path) -> None:
    draw = random.Random(7)
    for _ in range(300):
        survives(draw.randbytes(draw.randrange(200)), tmp_path)


values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8) | st.binary(max_size=3)
    | st.sampled_from(["auto", "full", "total", "carrier", "taylor", "deceleration", 10**400, -0.0, 1e-300, 5e-324]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=3), max_leaves=12)
keys = st.sampled_from(sorted({field.name for tables in KINDS.values() for fields in tables.values() for field in fields}))
tables = st.dictionaries(keys | st.text(max_size=6), values, max_size=6)


@settings(max_examples=400, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.dictionaries(st.sampled_from(["name", "source", "solve", "body", "torque", "initial"]) | st.text(max_size=5),
                       tables | values, max_size=7))
def test_random_dicts(data: dict[str, object]) -> None:
    try:
        scene_from({"kind": "deceleration", **data})
    except SceneError as error:
        assert str(error)


@settings(max_examples=400, deadline=None)
@given(key=keys, value=values, dotted=st.sampled_from(["", "solve.", "body.", "torque.", "initial.", "x.y."]))
def test_random_overrides(key: str, value: object, dotted: str) -> None:
    try:
        load("cubesat-wheel", **{dotted + key: value})
    except SceneError as error:
        assert str(error)
