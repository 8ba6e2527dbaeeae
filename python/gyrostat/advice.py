# SPDX-License-Identifier: BSD-3-Clause
"""Words of the messages about scenes: values as they were given, and what to write instead of what is wrong."""

import difflib
from collections.abc import Iterable, Mapping
from typing import Any, Final

from gyrostat.families import FAMILIES, Family
from gyrostat.fields import GENERAL, REQUIRED, Choices, Field, Table, table_of

__all__ = ["advice", "advice_anywhere", "bare_names", "kinds_with", "meaning_of", "nearest", "show", "suggested", "type_of", "wanted", "ways", "ways_of_kind"]


def show(value: Any) -> str:
    """A value as it would stand in a scene file, at most about 60 characters."""
    if isinstance(value, bool):
        text = "true" if value else "false"
    elif isinstance(value, int) and value.bit_length() > 200:
        text = f"an integer of {value.bit_length()} bits"
    elif isinstance(value, str):
        text = '"' + (value if len(value) < 60 else value[:57] + "...") + '"'
    elif isinstance(value, list | tuple):
        shown = []
        for item in value[:9]:
            shown.append(show(item))
            if sum(map(len, shown)) > 60:
                break
        text = "[" + ", ".join(shown) + (", ..." if len(shown) < len(value) else "") + "]"
    elif isinstance(value, dict):
        text = "a table" if value else "an empty table"
    elif isinstance(value, int | float):
        text = repr(value)
    else:
        text = str(value)
    return "".join(c if c.isprintable() else "?" for c in text)[:90]


def type_of(value: Any) -> str:
    names = {bool: "a truth value", str: "text", list: "an array", dict: "a table", int: "an integer", float: "a number"}
    return names.get(type(value), f"of type {type(value).__name__}")


def nearest(word: str, words: Iterable[str]) -> str:
    found = difflib.get_close_matches(word, list(words), 1, 0.6)
    return found[0] if found else ""


_PLANE: Final = ("radial", "the orbit lies in the plane of radial and along, in inertial axes: give these two directions")
_DRIVEN: Final = ("held", 'a reaction wheel has the type "torque" where its torque is given, "held" where its rate is')
# What others call by another name: a word that is known where this may be meant, and what has it there.
_CALLED: Final = {
    "inclination": _PLANE,
    "raan": _PLANE,
    "argument_of_perigee": ("radial", "radial is where the orbit begins, true_anomaly how far behind the pericentre: give these two"),
    "semi_major_axis": ("eccentricity", "give radius, the distance at t = 0: of an ellipse a (1 - e^2)/(1 + e cos true_anomaly), of a circle a"),
    "reaction": _DRIVEN,
    "reaction_wheel": _DRIVEN,
    "cmg": ("held", "there is no gimbal here: a wheel turns about an axis that is fixed in the body"),
}


def suggested(word: str, known: Iterable[str], form: str = "{}") -> str:
    """What may be meant by a word that is not known, as a sentence; "" where nothing is near."""
    known = list(known)
    near = nearest(word, known)
    beside, other = _CALLED.get(word.lower().replace("-", "_").replace(" ", "_"), ("", ""))
    if beside in known and difflib.SequenceMatcher(None, word, near).ratio() < 0.8:
        return other
    return f"did you mean {form.format(near)}?" if near else ""


def meaning_of(field: Field) -> str:
    return field.meaning + (f" ({field.unit})" if field.unit else "")


def ways(choices: Choices) -> str:
    """The alternatives for reading: "in [solve] give either duration and samples or times"."""
    tables = {table_of(key) for choice in choices for key in choice}
    if len(tables) == 1:
        return f"in [{tables.pop()}] give either {bare_names(choices)}"
    return "give either " + ", or ".join(" and ".join(filter(None, (", ".join(choice[:-1]), choice[-1]))) for choice in choices)


def bare_names(choices: Choices) -> str:
    return " or ".join(" and ".join(key.rpartition(".")[2] for key in choice) for choice in choices if choice)


def wanted(family: Family, table: str) -> str:
    names = [field.name for field in family.keys[table] if field.default is REQUIRED]
    names += [bare_names(choices) for choices in family.alternatives if all(table_of(key) == table for choice in choices for key in choice)]
    return ", ".join(names)


def ways_of_kind(tree: Mapping[str, Any]) -> str:
    """What to write where the kind is missing: one of those that know all tables that are there."""
    others = [name for name in FAMILIES if name != GENERAL]
    fitting = [name for name in others if all(key in FAMILIES[name].keys or not isinstance(tree[key], dict) for key in tree)] or others
    return "write " + " or ".join(f'kind = "{name}"' for name in fitting) + (" where it is one of these" if len(fitting) > 1 else "")


def advice(key: str, table: str, family: Family) -> str:
    """What to do about a key that `table` does not have."""
    layout = family.keys
    here = [field.name for field in layout[table]] + ([name for name in layout if name] if not table else [])
    homes = [name for name, fields in layout.items() if any(field.name == key for field in fields)]
    if homes and not homes[0]:
        return f"{key} belongs at the top of the file, before the first table"
    if homes:
        home = f"{key} belongs in {' or '.join(f'[{each}]' for each in homes)}"
        kinds = [each.name for each in FAMILIES.values() if any(field.name == key for field in each.keys.get(table, ()))]
        return f"scenes of the kind {' or '.join(kinds)} have {table}.{key}; in this kind {home}" if kinds else home
    if meant := suggested(key, here):
        return meant
    if not table and (kinds := [family.name for family in FAMILIES.values() if key in family.keys]):
        return f"only scenes of the kind {' or '.join(kinds)} have it"
    if not table and (near := nearest(key, {name for family in FAMILIES.values() for name in family.keys if name})):
        kinds = [family.name for family in FAMILIES.values() if near in family.keys]
        return f"did you mean {near}, which scenes of the kind {' or '.join(kinds)} have?"
    for name, fields in layout.items():
        if near := nearest(key, [field.name for field in fields]):
            return f"did you mean {name + '.' if name else ''}{near}?"
    if kinds := kinds_with(key, table):
        return f"leave it out: only scenes of the kind {' or '.join(kinds)} have it"
    return f"the keys here are {', '.join(here)}"


def kinds_with(key: str, table: str) -> list[str]:
    """The kinds whose `table` has the key; of every table where none is named."""
    return [family.name for family in FAMILIES.values()
            if any(field.name == key for name, fields in family.keys.items() if table in ("", name) for field in fields)]


def advice_anywhere(key: str, layout: Mapping[str, Table]) -> str:
    """What to do about a key, named without its table, that no table has."""
    names = [field.name for fields in layout.values() for field in fields]
    if near := nearest(key, names):
        return f"did you mean {near}?"
    if kinds := kinds_with(key, ""):
        return f"leave it out: only scenes of the kind {' or '.join(kinds)} have it"
    return f"the keys are {', '.join(names)}"
