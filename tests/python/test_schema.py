# SPDX-License-Identifier: BSD-3-Clause
"""The JSON Schema says what the validator says."""

import json
from typing import Any

from gyrostat.fields import KINDS
from gyrostat.scenes import bundled, load
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
            and value > rule.get("exclusiveMinimum", value - 1))


def test_schema_is_json() -> None:
    assert json.loads(json.dumps(schema())) == schema()


def test_schema_has_every_key_once() -> None:
    for rule, (kind, tables) in zip(schema()["oneOf"], KINDS.items(), strict=True):
        assert rule["properties"]["kind"]["enum"] == [kind]
        for table, fields in tables.items():
            properties = rule["properties"][table]["properties"] if table else rule["properties"]
            assert {field.name for field in fields} == {key for key in properties if key not in tables}


def test_schema_accepts_the_bundled_scenes_and_refuses_spoilt_ones() -> None:
    for name, _ in bundled():
        data = load(name).to_dict()
        assert accepts(schema(), data)
        for table, key, value in [("torque", "drag", -1.0), ("torque", "drag", "1"), ("torque", "law", "both"),
                                  ("body", "inertia", [1, 2]), ("solve", "tolerance", 1.0), ("body", "mass", 1.0),
                                  ("initial", "attitude", [0, 0, 0, 2]), ("solve", "samples", 1.5),
                                  ("solve", "times", [1.0])]:
            assert not accepts(schema(), {**data, table: {**data[table], key: value}})
        assert not accepts(schema(), {**data, "kind": "rotor"})
        assert not accepts(schema(), {key: value for key, value in data.items() if key != "torque"})
        assert not accepts(schema(), {**data, "initial": {}})
