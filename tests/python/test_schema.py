# SPDX-License-Identifier: BSD-3-Clause
"""The JSON Schema says what the validator says; so do the table of keys and the template."""

import json
import re
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from conftest import ASSEMBLED, HEAVY, PERIODIC, ROTOR, SPINNING
from gyrostat import solve
from gyrostat.cli import main
from gyrostat.errors import SceneError
from gyrostat.families import FAMILIES
from gyrostat.fields import REQUIRED, Choice
from gyrostat.scenes import bundled, load, scene_from
from gyrostat.schema import schema
from gyrostat.template import template


@cache
def definitions() -> dict[str, Any]:
    """The schema, made once."""
    return schema()


def accepts(rule: dict[str, Any], value: Any) -> bool:
    """The part of JSON Schema that ours uses."""
    if "$ref" in rule:
        return accepts(definitions()["$defs"][rule["$ref"].removeprefix("#/$defs/")], value)
    types = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
    if "type" in rule and (not isinstance(value, types[rule["type"]]) or isinstance(value, bool) != (rule["type"] == "boolean")):
        return False
    if "enum" in rule and value not in rule["enum"]:
        return False
    if not accepts_parts(rule, value):
        return False
    if "not" in rule and accepts(rule["not"], value):
        return False
    if "oneOf" in rule and sum(accepts(part, value) for part in rule["oneOf"]) != 1:
        return False
    if "anyOf" in rule and not any(accepts(part, value) for part in rule["anyOf"]):
        return False
    return "allOf" not in rule or all(accepts(part, value) for part in rule["allOf"])


def accepts_parts(rule: dict[str, Any], value: Any) -> bool:
    """What a rule says of the members of a table or a list, of the length of a text, of the size of a number."""
    if isinstance(value, dict):
        known = rule.get("properties", {})
        if rule.get("additionalProperties", True) is False and not set(value) <= set(known):
            return False
        return set(rule.get("required", ())) <= set(value) and all(accepts(known.get(k, {}), v) for k, v in value.items())
    if isinstance(value, list):
        return (rule.get("minItems", 0) <= len(value) <= rule.get("maxItems", len(value))
                and all(accepts(rule.get("items", {}), item) for item in value))
    if isinstance(value, str):
        return len(value) >= rule.get("minLength", 0) and re.search(rule.get("pattern", ""), value) is not None
    return (rule.get("minimum", value) <= value <= rule.get("maximum", value)
            and value > rule.get("exclusiveMinimum", value - 1) and value < rule.get("exclusiveMaximum", value + 1))


def test_schema_is_json() -> None:
    assert json.loads(json.dumps(schema())) == schema()


def test_schema_has_every_key_once() -> None:
    for rule, (kind, family) in zip(schema()["oneOf"], FAMILIES.items(), strict=True):
        assert rule["properties"]["kind"]["enum"] == [kind]
        for table, fields in family.keys.items():
            properties = rule["properties"][table]["properties"] if table else rule["properties"]
            assert {field.name for field in fields} == {key for key in properties if table or key not in family.keys}


SPOILT = {
    "free": [("view", "half_angle", 4.0), ("body", "inertia", [1, 2]), ("body", "rotor_momentum", 1.0), ("solve", "model", "averaged"),
             ("body", "mass", 1.0), ("initial", "angular_velocity", [1.0, 2.0])],
    "deceleration": [("torque", "drag", -1.0), ("torque", "drag", "1"), ("torque", "law", "both"), ("body", "inertia", [1, 2]),
                     ("body", "mass", 1.0), ("solve", "model", "linear-tail")],
    "rotor": [("motor", "slope", -1.0), ("motor", "slope", "1"), ("rotor", "axis", [0, 0, 2]), ("rotor", "axis", [0, 1]),
              ("rotor", "axial_inertia", 0.0), ("carrier", "mass", -1.0), ("carrier", "mass", 0), ("body", "inertia", [1, 2]),
              ("initial", "angular_momentum", [1, 2, 3]), ("solve", "model", "averaged")],
    "spinning": [("body", "mass", 0), ("body", "rotor_momentum", [0, 0, 1]), ("body", "inertia", [1, 2]), ("field", "arm", -1.0),
                 ("field", "momentum", "1"), ("torque", "drag", 1.0), ("torque", "force", [1, 2]), ("initial", "velocity", 1.0),
                 ("initial", "angular_momentum", [1, 2, 3]), ("solve", "model", "closed-form"), ("solve", "integrator", "radau")],
    "heavy": [("body", "mass", 0), ("body", "centre_of_mass", [0, 1]), ("body", "inertia", [1, 2]), ("field", "gravity", -1.0),
              ("field", "centre_distance", 0.0), ("field", "gravity_gradient", -1.0), ("body", "rotor_momentum", 1.0), ("initial", "down", [0, 2, 0]),
              ("initial", "periodic", 1.0), ("initial", "periodic", {"spin": 1.0, "cos_inclination": 1.0}), ("initial", "periodic", {"spin": 1.0}),
              ("initial", "periodic", {"spin": 1.0, "cos_inclination": 0.0, "phase": 0.0}), ("solve", "model", "averaged"), ("solve", "integrator", "radau")],
    "general": [("body", "mass", 0), ("body", "fixed", 1), ("body", "inertia", [1, 2]), ("body", "inertia_about", "centre"), ("field", "gravity", -1.0),
                ("field", "uniform", 1.0), ("field", "dipole", {"axis": [0, 0, 1]}), ("orbit", "eccentricity", 1.0), ("orbit", "planet", "vulcan"),
                ("orbit", "radius", 0), ("solve", "recognise", "yes"), ("solve", "model", "averaged"), ("solve", "integrator", "adams"),
                ("initial", "relative_to", "body"), ("initial", "angular_velocity", {"inertial": [0, 1]}), ("initial", "velocity", 1.0)],
}


def test_the_schema_of_a_kind_is_its_part_of_the_whole() -> None:
    whole = schema()
    for kind, rule in zip(FAMILIES, whole.pop("oneOf"), strict=True):
        assert schema(kind) == {**whole, **rule}


@pytest.mark.parametrize("kind", list(FAMILIES))
def test_the_table_of_keys_has_every_key_with_unit_default_interval_and_meaning(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema", kind]) == 0
    out = capsys.readouterr().out
    parts = {title: text for title, text in re.findall(r"\n(\[\w+\]|at the top)\n(.*?)(?=\n\n)", out, re.S)}
    alternatives = {key for choices in FAMILIES[kind].alternatives for choice in choices for key in choice}
    for table, fields in FAMILIES[kind].keys.items():
        lines = parts[f"[{table}]" if table else "at the top"].splitlines()
        for field in fields:
            line = next(line for line in lines if re.match(rf"  {field.name}\b", line))  # keys of records stand further in
            assert field.unit in line and field.meaning.split()[0] in line
            assert "required" in line if field.default is REQUIRED else "required" not in line
            assert ("alternative" in line) == (f"{table}.{field.name}" in alternatives)
            assert not field.open_low or "> " in line
    assert "Give exactly one of: solve.duration with solve.samples, or solve.times." in out
    assert out.count("Give ") == len(FAMILIES[kind].alternatives)


def text_of(kind: str, chosen: Choice = (), rest: tuple[Choice, ...] = ()) -> str:
    """The template, one alternative taken and the rest taken out."""
    lines, table = [], ""
    for line in template(kind).splitlines():
        if found := re.match(r"#?\[(\w+)\]", line):
            table = found[1]
            line = found[0].lstrip("#")
        key = f"{table}.{line.partition(' ')[0].lstrip('#')}"
        if key in chosen:
            line = line.lstrip("#")
        elif any(key in other for other in rest):
            line = "#" + line
        lines.append(line)
    return "\n".join(lines)


@pytest.mark.parametrize("kind", list(FAMILIES))
def test_a_template_is_solved_as_it_stands(kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scene.toml"
    assert main(["new", kind, "-o", str(file)]) == 0 and file.read_text() == template(kind)
    assert main(["solve", str(file)]) == 0
    assert f"my-{kind} ({kind})" in capsys.readouterr().out
    file.write_text("mine")
    assert main(["new", kind, "-o", str(file)]) == 2 and "--force" in capsys.readouterr().err and file.read_text() == "mine"
    assert main(["new", kind, "-o", str(file), "--force"]) == 0 and main(["new", kind]) == 0
    assert file.read_text() == template(kind) == capsys.readouterr().out


@pytest.mark.parametrize("kind", list(FAMILIES))
def test_a_template_has_every_key_with_its_unit_and_every_alternative(kind: str) -> None:
    family = FAMILIES[kind]
    text = template(kind)
    assert max(map(len, text.splitlines())) <= 120
    written = re.sub(r"^#(?=\[|\w+ = )", "", text, flags=re.M)  # every key at once
    data = tomllib.loads(written)
    for table, fields in family.keys.items():
        for field in fields:
            assert field.name in (data[table] if table else data)
            assert field.unit in text and field.meaning.split(":")[0] in " ".join(text.replace("\n# ", " ").split())
    for choices in family.alternatives:
        for chosen in choices:
            rest = tuple(other for more in family.alternatives if any(key in chosen for choice in more for key in choice) or more == choices
                         for other in more if other != chosen)
            scene = scene_from(tomllib.loads(text_of(kind, chosen, rest)))
            for key in chosen:
                assert scene.tables[key.partition(".")[0]][key.partition(".")[2]] is not None
            assert solve(scene, tolerance=0.1, times=[0.0, 1.0]).met


@pytest.mark.parametrize("kind", list(FAMILIES))
def test_what_a_template_asks_for_is_the_default(kind: str) -> None:
    text = template(kind)
    assert '#ask = "default"' in text
    scene = scene_from(tomllib.loads(text))
    left_out, said = solve(scene, tolerance=0.1), solve(scene_from(tomllib.loads(text.replace('#ask = "default"', 'ask = "default"'))), tolerance=0.1)
    assert list(left_out.columns) == list(said.columns) and left_out.tolerances == said.tolerances
    if kind == "general":
        named = text[text.index('"default":'):text.index('#ask = "default"')]
        assert all(name in named for name in left_out.columns) and "energy" not in named and "energy" not in left_out.columns
    elif kind != "deceleration":
        assert list(left_out.columns) == list(solve(scene, tolerance=0.1, ask="all").columns)


def loads(data: dict[str, Any]) -> bool:
    try:
        scene_from(data)
    except SceneError:
        return False
    return True


def test_schema_accepts_the_bundled_scenes_and_refuses_spoilt_ones() -> None:
    kinds = set()
    for name, _ in bundled():
        data = load(name).to_dict()
        kinds.add(data["kind"])
        assert accepts(definitions(), data)
        for table, key, value in [*SPOILT[data["kind"]], ("solve", "tolerance", 1.0),
                                  ("initial", "attitude", [0, 0, 0] if data["kind"] == "general" else [0, 0, 0, 2]),
                                  ("solve", "samples", 1.5), ("solve", "times", [1.0])]:
            assert not accepts(definitions(), {**data, table: {**data.get(table, {}), key: value}})
        for other in {*FAMILIES, "light"} - {data["kind"]}:
            # a body with wheels alone is a general scene as it stands
            assert accepts(definitions(), {**data, "kind": other}) == (other == "general" and loads({**data, "kind": other}))
        for table in ("solve", "torque", "rotor", "motor", "initial"):
            if isinstance(data.get(table), dict):
                follows = table == "initial" and "from" in data  # the start is the end of another scene
                assert accepts(definitions(), {key: value for key, value in data.items() if key != table}) == follows
        assert accepts(definitions(), {**data, "initial": {}}) == ("from" in data)
    assert kinds == set(FAMILIES)


def test_schema_and_validator_agree_on_alternatives_between_tables() -> None:
    whole, apart, spinning, heavy, periodic = (tomllib.loads(text) for text in (ROTOR, ASSEMBLED, SPINNING, HEAVY, PERIODIC))
    start, motion = heavy["initial"], periodic["initial"]
    carrier = {"inertia": [2.1, 2.6, 3.2], "mass": 12.0}
    for data in (
        whole, apart, {**whole, "body": {}}, {**apart, "body": {}}, {**whole, "carrier": {}}, {**whole, "carrier": carrier},
        {**apart, "body": whole["body"]}, {**whole, "rotor": {**whole["rotor"], "offset": [0, 0, 1]}},
        {key: value for key, value in whole.items() if key != "body"}, {key: value for key, value in apart.items() if key != "carrier"},
        *({**apart, "rotor": {k: v for k, v in apart["rotor"].items() if k != key}} for key in apart["rotor"]),
        {**apart, "carrier": {"mass": 12.0}}, {**apart, "body": 3}, {**whole, "carrier": []},
        spinning, {key: value for key, value in spinning.items() if key != "field"}, {**spinning, "field": {}},
        {**spinning, "field": {"momentum": 0.3}}, {**spinning, "field": {**spinning["field"], "momentum": 0.3}},
        {**spinning, "field": {"charge": 0.3}}, {**spinning, "initial": {"angular_velocity": [0, 0, 1]}},
        {**spinning, "initial": {**spinning["initial"], "attitude": [0, 0, 0, 1]}},
        {**spinning, "initial": {"angular_velocity": [0, 0, 1], "attitude": [0, 0, 0, 1]}},
        heavy, periodic, {**heavy, "field": {"gravity": 9.8}}, {**heavy, "field": {"gravity": 9.8, "centre_distance": 6e6}},
        {**heavy, "field": {**heavy["field"], "centre_distance": 6e6}}, {**heavy, "initial": {**start, **motion}},
        {**heavy, "initial": {"angular_velocity": [0, 0, 1], "attitude": [0, 0, 0, 1]}}, {**heavy, "initial": {**start, "attitude": [0, 0, 0, 1]}},
        {**heavy, "initial": {"down": [0, 0, 1]}}, {**heavy, "initial": {"angular_velocity": [0, 0, 1]}}, {**heavy, "initial": {**motion, "down": [0, 0, 1]}},
    ):
        try:
            scene_from(data)
            right = True
        except SceneError:
            right = False
        assert accepts(schema(), data) == right, data
