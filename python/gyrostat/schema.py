# SPDX-License-Identifier: BSD-3-Clause
"""The keys of scene files as a JSON Schema and as tables for reading, made from what the validator reads."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

from gyrostat.families import FAMILIES, Family
from gyrostat.fields import LIMIT, REQUIRED, UNSET, Choice, Choices, Field, inertia_parts, table_of
from gyrostat.orientation import SEQUENCES
from gyrostat.toml_text import toml_value
from gyrostat.units import PATTERN, SHARE_PATTERN, UNIT_PATTERN
from gyrostat.vary import DESIGNS

__all__ = ["interval", "key_tables", "schema", "ways"]

# Numbers with units, and units.
DEFINITIONS: Final = {"quantity": {"type": "string", "pattern": PATTERN}, "share": {"type": "string", "pattern": SHARE_PATTERN},
                      "unit": {"type": "string", "pattern": UNIT_PATTERN}}


def _number(field: Field) -> dict[str, Any]:
    """A number; of a key with a unit, one with a unit, too, and of the tolerance a share."""
    number = {"type": "number", ("exclusiveMinimum" if field.open_low else "minimum"): field.low,
              ("exclusiveMaximum" if field.open_high else "maximum"): field.high}
    text = "share" if field.name == "tolerance" else "quantity" if field.unit else ""
    return {"oneOf": [number, {"$ref": f"#/$defs/{text}"}]} if text else number


def _array(items: dict[str, Any], length: int | None = None) -> dict[str, Any]:
    size = {"minItems": 1} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": items, **size}


def _arrays(field: Field) -> list[dict[str, Any]]:
    """The shapes that an array of numbers may have."""
    if field.form in ("inertia", "moments"):
        tensor = replace(field, low=-field.high)
        return [_array(_number(field), 3), _array(_array(_number(tensor), 3), 3)]
    one = _number(field)
    match field.form:
        case "matrix":
            return [_array(one, 3), _array(_array(one, 3), 3)]
        case "rows" | "intervals":
            return [_array(_array(one, 3 if field.form == "rows" else 2))]
        case _:
            return [_array(one, 3 if field.form in ("vector", "axis", "vector or record") else None)]


def _numbers(field: Field) -> dict[str, Any]:
    """Several numbers: an array, { value = [...], unit = "..." }, and of an inertia moments and products."""
    ways = _arrays(field)
    if field.form == "matrix":
        ways.append(_number(field))
    if field.unit:
        free = _arrays(replace(field, unit="", low=-LIMIT, high=LIMIT, open_low=False, open_high=False))
        value = {"oneOf": free} if len(free) > 1 else free[0]
        ways.append({"type": "object", "properties": {"value": value, "unit": {"$ref": "#/$defs/unit"}}, "required": ["value", "unit"],
                     "additionalProperties": False})
    if field.form in ("inertia", "moments"):
        ways.append(_form(Field(field.name, "record", field.meaning, parts=inertia_parts(field))))
    return {"oneOf": ways} if len(ways) > 1 else ways[0]


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
        case "flag":
            return {"type": "boolean"}
        case "vector" | "axis" | "inertia" | "moments" | "matrix" | "numbers" | "rows" | "intervals" | "times":
            return _numbers(field)
        case "text or record":
            return {"oneOf": [_form(replace(field, form="text")), _form(replace(field, form="record"))]}
        case "number or record":
            return {"oneOf": [_number(field), _form(replace(field, form="record"))]}
        case "vector or record":
            return {"oneOf": [_numbers(field), {**_form(replace(field, form="record")), "minProperties": 1, "maxProperties": 1}]}
        case "direction":
            return _array({"type": "number", "minimum": -1.00000001, "maximum": 1.00000001}, 3)
        case "quaternion":
            return _array({"type": "number", "minimum": -1.000001, "maximum": 1.000001}, 4)
        case "turn":
            return _array(_number(field), 4)
        case "rotation":
            return _array(_array(_number(field), 3), 3)
        case "sequence":
            return {"enum": list(SEQUENCES)}
        case "ask":
            tolerance = {"oneOf": [{"type": "number", "exclusiveMinimum": 0}, {"type": "string"}]}
            return {"anyOf": [{"enum": ["all", "default"]}, {"type": "string", "minLength": 1}, {"type": "array", "items": {"type": "string"}, "minItems": 1},
                              {"type": "object", "additionalProperties": tolerance, "minProperties": 1}]}
        case "record":
            return {"type": "object", "properties": {part.name: _property(part) for part in field.parts},
                    "required": [part.name for part in field.parts if part.default is REQUIRED], "additionalProperties": False}
        case "records":
            sorts = [_form(replace(field, form="record", parts=parts)) for parts in field.sorts or (field.parts,)]
            return {"type": "array", "items": {"oneOf": sorts} if len(sorts) > 1 else sorts[0]}
        case "vary":
            how = [{"type": "string"}, {"type": "array", "items": {"oneOf": [{"type": "number"}, {"type": "string"}]}, "minItems": 1},
                   {"type": "object"}]
            settings = {"n": {"type": "integer", "minimum": 1}, "seed": {"type": "integer", "minimum": 0}, "design": {"enum": list(DESIGNS)},
                        "cases": {"oneOf": [{"type": "string"}, {"type": "object"}]}}
            return {"type": "object", "properties": settings, "additionalProperties": {"oneOf": how}}
        case "scene":
            return {"type": "object", "required": ["solve"]}


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
    def way(chosen: Choice) -> dict[str, Any]:
        # of two ways of one key each, both given, both hold: then oneOf does not
        beside = [_given((key,)) for other in choices if other is not chosen and not len(other) == len(chosen) == 1 for key in other]
        return {**_given(chosen), **({"not": {"anyOf": beside}} if beside else {})}

    return {"oneOf": [way(chosen) for chosen in choices]}


def _or_goes_on(choices: Choices) -> dict[str, Any]:
    """One way is taken; none need be where the scene begins at the end of another."""
    if () in choices:
        return _one_of(choices)
    return {"anyOf": [_one_of(choices), {"required": ["from"], **_one_of((*choices, ()))}]}


def _kind(family: Family) -> dict[str, Any]:
    tables = family.keys
    follows = any(field.name == "from" for field in tables[""])
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
                    + [table for table in tables if table and family.needs(table) and not (follows and table == "initial")],
        "additionalProperties": False,
        "allOf": [_or_goes_on(choices) if follows and table_of((*choices[0], "")[0]) == "initial" else _one_of(choices) for choices in family.alternatives],
    }


def schema(kind: str | None = None) -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a scene file, of one kind or of any, parsed from TOML.

    What a schema cannot say is checked when a scene is loaded: finite numbers, what a unit measures and the interval of a number that has one, the
    triangle inequality, a symmetric or diagonal tensor, increasing times, a unit quaternion or axis, direction cosines of a rotation, a rotor that
    the body can hold, a mass centre that a body with this inertia can have.
    """
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "gyrostat scene",
            "description": "Numbers are in SI units, radians and seconds; those with another unit are text, such as \"3000 rpm\"", "$defs": DEFINITIONS}
    if kind is not None:
        return {**head, **_kind(FAMILIES[kind])}
    return {**head, "oneOf": [_kind(family) for family in FAMILIES.values()]}


# ---- for reading ----


def interval(field: Field) -> str:
    """The legal interval of the numbers of a key; empty where they are free."""
    if field.form == "count":
        return f"{field.low:.0f} to {field.high:.0f}"
    low = "" if field.low <= -LIMIT else f"{'>' if field.open_low else '>='} {field.low:g}"
    high = "" if field.high >= LIMIT else f"{'<' if field.open_high else '<='} {field.high:g}"
    return " and ".join(filter(None, (low, high)))


def _form_text(field: Field) -> str:
    match field.form:
        case "choice":
            return " | ".join(field.choices)
        case "count":
            return "integer"
        case "vector":
            return "3 numbers"
        case "axis":
            return "vector"
        case "flag":
            return "true or false"
        case "matrix":
            return "1, 3 or 3x3 numbers"
        case "rows":
            return "threes of numbers"
        case "intervals":
            return "pairs of numbers"
        case "text or record" | "number or record" | "vector or record":
            one = field.form.removesuffix(" or record")
            return f"{'3 numbers' if one == 'vector' else one} or {{ {', '.join(part.name for part in field.parts)} }}"
        case "direction":
            return "unit vector"
        case "quaternion" | "turn":
            return "4 numbers"
        case "inertia" | "moments":
            return "3 or 3x3 numbers"
        case "rotation":
            return "3x3 numbers"
        case "sequence":
            return "3-2-1 or ZYX and so on"
        case "times":
            return "numbers"
        case "ask":
            return "names, all or { name = tolerance }"
        case "record":
            return "{ " + ", ".join(part.name for part in field.parts) + " }"
        case "records":
            return f"[[{field.name}]] each"
        case "vary":
            return "[vary]"
        case "scene":
            return "{ a scene }"
        case _:
            return field.form


def _default_text(field: Field, alternatives: set[str], key: str) -> str:
    if field.default is REQUIRED:
        return "required"
    if key in alternatives:
        return "alternative"
    return "-" if field.default is UNSET else toml_value(field.default)


def _part_default(part: Field) -> str:
    return "" if part.default is REQUIRED else "-" if part.default is UNSET else toml_value(part.default)


def _part_rows(field: Field) -> Iterator[list[str]]:
    """A row of each key of records; of several sorts first what each is and which keys it has, then each key that differs in them."""
    said: list[Field] = []
    for sort in field.sorts:
        first = next(part for part in sort if part.name == field.by[0])
        keys = ", ".join(part.name for part in sort if part is not first)
        yield [f"  {first.name}", first.choices[0], "", _part_default(first), "", f"{first.meaning}; with {keys}"]
    for part in (part for sort in field.sorts or (field.parts,) for part in sort):
        if (field.sorts and part.name == field.by[0]) or part in said:
            continue
        said.append(part)
        yield [f"  {part.name}", _form_text(part), part.unit, _part_default(part), interval(part), part.meaning]


def key_tables(kind: str) -> Iterator[tuple[str, list[str], list[list[str]]]]:
    """Title, heads and rows of each table of a scene file of the kind."""
    family = FAMILIES[kind]
    alternatives = {key for choices in family.alternatives for choice in choices for key in choice}
    for table, fields in family.keys.items():
        rows = []
        for field in fields:
            default = _default_text(field, alternatives, f"{table}.{field.name}")
            rows.append([field.name, _form_text(field), field.unit, default, interval(field), field.meaning])
            if field.form in ("record", "records"):
                rows += _part_rows(field)
        title = f"[{table}]" if table else "at the top"
        yield title, ["key", "form", "unit", "default", "interval", "meaning"], rows


def ways(choices: Choices) -> str:
    """The alternatives as a sentence."""
    listed = ", or ".join(" with ".join(filter(None, (choice[0], ", ".join(choice[1:])))) for choice in choices if choice)
    return f"Give {'at most' if () in choices else 'exactly'} one of: {listed}."
