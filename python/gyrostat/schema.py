# SPDX-License-Identifier: BSD-3-Clause
"""JSON Schema of scene files, made from the table that the validator reads."""

from typing import Any

from gyrostat.families import FAMILIES, Family
from gyrostat.fields import REQUIRED, UNSET, Choice, Choices, Field, table_of

__all__ = ["schema"]


def _number(field: Field) -> dict[str, Any]:
    return {"type": "number", ("exclusiveMinimum" if field.open_low else "minimum"): field.low,
            ("exclusiveMaximum" if field.open_high else "maximum"): field.high}


def _array(items: dict[str, Any], length: int | None = None) -> dict[str, Any]:
    size = {"minItems": 1} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": items, **size}


def _form(field: Field) -> dict[str, Any]:
    match field.form:
        case "text":
            return {"type": "string", "minLength": 1} if field.default is REQUIRED else {"type": "string"}
        case "choice":
            return {"enum": list(field.choices)}
        case "number":
            return _number(field)
        case "count":
            return {"type": "integer", "minimum": int(field.low), "maximum": int(field.high)}
        case "vector":
            return _array(_number(field), 3)
        case "direction":
            return _array({"type": "number", "minimum": -1.00000001, "maximum": 1.00000001}, 3)
        case "quaternion":
            return _array({"type": "number", "minimum": -1.000001, "maximum": 1.000001}, 4)
        case "times":
            return _array(_number(field))
        case "inertia" | "moments":
            tensor = _array(_array({"type": "number", "minimum": -field.high, "maximum": field.high}, 3), 3)
            return {"oneOf": [_array(_number(field), 3), tensor]}
        case "record":
            return {"type": "object", "properties": {part.name: _property(part) for part in field.parts},
                    "required": [part.name for part in field.parts], "additionalProperties": False}


def _property(field: Field) -> dict[str, Any]:
    made = {"description": field.meaning + (f" [{field.unit}]" if field.unit else ""), **_form(field)}
    if field.default is not REQUIRED and field.default is not UNSET:
        made["default"] = list(field.default) if isinstance(field.default, tuple) else field.default
    return made


def _given(keys: Choice) -> dict[str, Any]:
    """All of the full keys are there."""
    tables = {table: [key.rpartition(".")[2] for key in keys if table_of(key) == table] for table in map(table_of, keys)}
    return {"required": list(tables), "properties": {table: {"required": names} for table, names in tables.items()}}


def _one_of(choices: Choices) -> dict[str, Any]:
    """One way is taken whole, and nothing of another."""
    return {"oneOf": [
        {**_given(chosen), "not": {"anyOf": [_given((key,)) for other in choices if other is not chosen for key in other]}}
        for chosen in choices
    ]}


def _kind(family: Family) -> dict[str, Any]:
    tables = family.keys
    properties: dict[str, Any] = {field.name: _property(field) for field in tables[""]}
    for table, fields in tables.items():
        if table:
            properties[table] = {
                "type": "object",
                "properties": {field.name: _property(field) for field in fields},
                "required": [field.name for field in fields if field.default is REQUIRED],
                "additionalProperties": False,
            }
    return {
        "type": "object",
        "properties": properties,
        "required": [field.name for field in tables[""] if field.default is REQUIRED]
                    + [table for table in tables if table and family.needs(table)],
        "additionalProperties": False,
        "allOf": [_one_of(choices) for choices in family.alternatives],
    }


def schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a scene file, parsed from TOML.

    What a schema cannot say is checked when a scene is loaded: finite numbers, the triangle inequality, a symmetric
    or diagonal tensor, increasing times, a unit quaternion or axis, a rotor that the body can hold, a mass centre that a body with this
    inertia can have.
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "gyrostat scene",
        "description": "SI units, radians, seconds",
        "oneOf": [_kind(family) for family in FAMILIES.values()],
    }
