# SPDX-License-Identifier: BSD-3-Clause
"""A scene file to start from: every key of a kind with its meaning, the optional ones commented out."""

import textwrap
from collections.abc import Iterator
from typing import Final

from gyrostat.families import FAMILIES, Family
from gyrostat.fields import REQUIRED, UNSET, Choice, Field, table_of
from gyrostat.orientation import FORMS
from gyrostat.schema import interval
from gyrostat.toml_text import toml_value

__all__ = ["template"]

# What is asked for by default, by kind.
ASKED: Final = {
    "deceleration": "the slow columns, with an attitude at the start all",
    "general": "attitude, angular_velocity, of wheels rotor_rate and rotor_angle, with solve.euler euler",
}


def _listed(keys: Choice, table: str) -> str:
    """Full keys for reading; those of the table itself without its name."""
    names = [key.removeprefix(f"{table}.") for key in keys]
    return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))


def _full(table: str, field: Field) -> str:
    return f"{table}.{field.name}" if table else field.name


def _wanted(family: Family) -> set[str]:
    """Full keys that the template sets: the required ones, and the first of the alternatives that cannot all be left out."""
    keys = {_full(table, field) for table, fields in family.keys.items() for field in fields if field.default is REQUIRED}
    return keys.union(*(choices[0] for choices in family.alternatives if () not in choices))


def _remarks(family: Family, key: str) -> Iterator[str]:
    """With and instead of what a key that the template leaves out is given, and what its default stands for; the forms of an attitude stand for themselves."""
    table = table_of(key)
    if key == "solve.ask":
        yield f"\"default\": {ASKED.get(family.name, 'every column')}"
    forms = {(f"initial.{field.name}",) for field in FORMS}
    for choices in family.alternatives:
        for choice in choices:
            if key in choice:
                others = [other for other in choices if other and other != choice and other not in forms]
                together = tuple(other for other in choice if other != key)
                if together:
                    yield f"with {_listed(together, table)}"
                if others:
                    yield f"instead of {', or of '.join(_listed(other, table) for other in others)}"


def _comment(field: Field, remarks: str) -> list[str]:
    detail = " | ".join(field.choices) if len(field.choices) > 1 else ", ".join(filter(None, (field.unit, interval(field))))
    text = field.meaning + (f" [{detail}]" if detail else "") + (f"; {remarks}" if remarks else "")
    return textwrap.wrap(text, 118, initial_indent="# ", subsequent_indent="# ", break_on_hyphens=False)


def template(kind: str) -> str:
    """A commented scene file of the kind that can be solved as it stands."""
    family = FAMILIES[kind]
    wanted = _wanted(family)
    lines = [f"# A scene of the kind {kind}: SI units, radians, seconds; other units as \"90 min\". The numbers are an example's.",
             "# Optional keys and alternatives stand behind a #: take it away to use them. They show the default if there is one."]
    for table, fields in family.keys.items():
        used = any(_full(table, field) in wanted for field in fields)
        lines += ["", f"{'' if used else '#'}[{table}]"] if table else []
        for field in fields:
            key = _full(table, field)
            value = family.example[key] if field.default in (REQUIRED, UNSET, ()) else field.default
            lines += _comment(field, "" if key in wanted else "; ".join(_remarks(family, key)))
            lines.append(f"{'' if key in wanted else '#'}{field.name} = {toml_value(value)}")
    return "\n".join(lines) + "\n"
