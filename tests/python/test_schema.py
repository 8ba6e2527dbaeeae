# SPDX-License-Identifier: BSD-3-Clause
"""The JSON Schema says what the validator says."""

import json
import tomllib
from typing import Any

from conftest import ASSEMBLED, HEAVY, PERIODIC, ROTOR, SPINNING
from gyrostat.errors import SceneError
from gyrostat.families import FAMILIES
from gyrostat.scenes import bundled, load, scene_from
from gyrostat.schema import schema


def accepts(rule: dict[str, Any], value: Any) -> bool:
    """The part of JSON Schema that ours uses."""
    types = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int}
    if "type" in rule and (not isinstance(value, types[rule["type"]]) or isinstance(value, bool)):
        return False
    if "enum" in rule and value not in rule["enum"]:
        return False
    if "not" in rule and accepts(rule["not"], value):
        return False
    if "oneOf" in rule and sum(accepts(part, value) for part in rule["oneOf"]) != 1:
        return False
    if "anyOf" in rule and not any(accepts(part, value) for part in rule["anyOf"]):
        return False
    if "allOf" in rule and not all(accepts(part, value) for part in rule["allOf"]):
        return False
    if isinstance(value, dict):
        known = rule.get("properties", {})
        if rule.get("additionalProperties", True) is False and not set(value) <= set(known):
            return False
        return set(rule.get("required", ())) <= set(value) and all(accepts(known.get(k, {}), v) for k, v in value.items())
    if isinstance(value, list):
        return (rule.get("minItems", 0) <= len(value) <= rule.get("maxItems", len(value))
                and all(accepts(rule.get("items", {}), item) for item in value))
    if isinstance(value, str):
        return len(value) >= rule.get("minLength", 0)
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
}


def test_schema_accepts_the_bundled_scenes_and_refuses_spoilt_ones() -> None:
    kinds = set()
    for name, _ in bundled():
        data = load(name).to_dict()
        kinds.add(data["kind"])
        assert accepts(schema(), data)
        for table, key, value in [*SPOILT[data["kind"]], ("solve", "tolerance", 1.0), ("initial", "attitude", [0, 0, 0, 2]),
                                  ("solve", "samples", 1.5), ("solve", "times", [1.0])]:
            assert not accepts(schema(), {**data, table: {**data.get(table, {}), key: value}})
        for other in {*FAMILIES, "light"} - {data["kind"]}:
            assert not accepts(schema(), {**data, "kind": other})
        for table in ("solve", "torque", "rotor", "motor", "initial"):
            if table in data:
                assert not accepts(schema(), {key: value for key, value in data.items() if key != table})
        assert not accepts(schema(), {**data, "initial": {}})
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
