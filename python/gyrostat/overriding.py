# SPDX-License-Identifier: BSD-3-Clause
"""Keys of a scene that are set from outside: `--set torque.drag=0`, `replace(**{"wheel[1].rate": 4.0})`."""

import re
import tomllib
from collections.abc import Iterable, Mapping
from typing import Any, Final

from gyrostat.advice import advice_anywhere, show
from gyrostat.errors import Mistake, Refused, SceneError
from gyrostat.families import FAMILIES
from gyrostat.fields import GENERAL, Choices, Field, Table, parts_of, table_of
from gyrostat.reading import plain, spread, tensor_rows
from gyrostat.units import PATTERN, SHARE_PATTERN, spelled

__all__ = ["SET_OUTSIDE", "override", "parse_override", "without_places"]


# Of keys that were given so, in place of the line of a file.
SET_OUTSIDE: Final = "(set on the command line or by keyword)"


def override(tree: dict[str, Any], label: str, overrides: Mapping[str, Any]) -> frozenset[str]:
    """Put each override into the tree and take out what it is an alternative to; the full keys, without places. `label` names the scene in messages."""
    kind = overrides.get("kind", tree.get("kind", GENERAL))
    family = FAMILIES.get(kind) if isinstance(kind, str) else None
    layout: Mapping[str, Table] = family.keys if family else {}
    full = {_full_key(given, plain(value), tree, label, layout): plain(value) for given, value in overrides.items()}
    touched = set(map(without_places, full))
    for key, value in full.items():
        for rival in _rivals(without_places(key), family.alternatives if family else ()) - touched:
            if isinstance(beside := tree.get(table_of(rival)), dict):
                beside.pop(rival.rpartition(".")[2], None)
        table, _, name = key.rpartition(".")
        _put(_home(tree, table, label), name, value, key, label)
    # mistakes in a table of a list are told of the list
    return frozenset(touched | {head for key in touched if isinstance(tree.get(head := key.partition(".")[0]), list)})


def _rivals(key: str, alternatives: Iterable[Choices]) -> set[str]:
    """The keys that go where this one comes."""
    return {rival for choices in alternatives if any(key in choice for choice in choices) for choice in choices if key not in choice for rival in choice}


def _full_key(given: str, value: Any, tree: Mapping[str, Any], label: str, layout: Mapping[str, Table]) -> str:
    """The key with its table: of a bare name the only table that has it, or in which it stands."""
    key = _dotted(given)
    if key is None:
        raise _wrong(label, show(given)[1:-1], value, *_NO_KEY)
    if "." in key:
        return key
    bare = without_places(key)
    homes = [home for home, fields in layout.items() if any(field.name == bare for field in fields)]
    there = [home for home in homes if not home or (isinstance(table := tree.get(home), dict) and bare in table)]
    if not there and "solve" not in homes:
        homes = [*_in_lists(tree, layout, bare), *homes]
    if not homes and key in layout:
        first = next(iter(value)) if isinstance(value, Mapping) and value else layout[key][0].name
        raise _wrong(label, key, value, "a table is not replaced as a whole",
                     f'set its keys one by one, as {key}.{first}, in Python replace(**{{"{key}.{first}": ...}}); keys that are not named stay')
    if not homes and key not in ("kind", "name", "source"):
        raise _wrong(label, key, value, "unknown key", advice_anywhere(key, layout))
    if len(homes) > 1:
        if len(there) != 1:
            raise _wrong(label, key, value, f"several tables have a key {key}", "write " + " or ".join(f"{home}.{key}" for home in homes))
        homes = there
    return f"{homes[0]}.{key}" if homes and homes[0] else key


def _wrong(label: str, key: str, value: Any, problem: str, remedy: str) -> SceneError:
    return SceneError(Mistake(f"{label} {SET_OUTSIDE}", key, show(value), problem, remedy))


def _in_lists(tree: Mapping[str, Any], layout: Mapping[str, Table], key: str) -> list[str]:
    """The tables in lists, as wheel[0], that can have this key."""
    made = []
    for field in layout.get("", ()):
        tables = tree.get(field.name)
        for i, table in enumerate(tables if isinstance(tables, list) else ()):
            if isinstance(table, dict) and any(part.name == key for part in parts_of(field, table) or ()):
                made.append(f"{field.name}[{i}]")
    return made


def without_places(key: str) -> str:
    return re.sub(r"\[[\d,]+\]", "", key)


def _home(tree: dict[str, Any], table: str, label: str) -> dict[str, Any]:
    """The table of this dotted name, made where there is none: of arrays of tables by its place, `wheel[1]`, or by its name, `wheel.pitch`, or the only one."""

    def fail(problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake(f"{label} {SET_OUTSIDE}", table, "", problem, remedy))

    home: Any = tree
    for part in table.split(".") if table else ():
        name, _, place = part.rstrip("]").partition("[")
        if isinstance(home, list):
            named = [item for item in home if isinstance(item, dict) and item.get("name") == name]
            if len(named) != 1:
                names = [item["name"] for item in home if isinstance(item, dict) and isinstance(item.get("name"), str)]
                raise fail(f"there is no one table named {name} here",
                           (f"they are named {', '.join(names)}; " if names else "") + f"write its place, such as {table.partition('.')[0]}[0], counted from 0")
            home = named[0]
        else:
            home = home.setdefault(name, {})
        if place:
            if not (isinstance(home, list) and int(place) < len(home)):
                raise fail(f"there is no {part}", f"there are {len(home)}, counted from 0" if isinstance(home, list) else f"leave out [{place}]")
            home = home[int(place)]
        if not isinstance(home, dict | list):
            raise SceneError(Mistake(label, table, show(home), "this is not a table", f"write [{table}] and its keys"))
    if isinstance(home, list):
        if len(home) != 1 or not isinstance(home[0], dict):
            raise fail(f"there are {len(home)} of these tables", f"write which, such as {table}[0].KEY, counted from 0, or {table}.NAME.KEY of the one with this name")
        home = home[0]
    found: dict[str, Any] = home
    return found


_INERTIA: Final = Field("inertia", "inertia", "inertia", "kg m^2")


def _put(home: dict[str, Any], name: str, value: Any, key: str, label: str) -> None:
    """Set a key, or one number of it: `control[0]`, `axis[2]`, `inertia[0,1]`, and of an inertia the same of the other side."""
    name, _, places = name.rstrip("]").partition("[")
    if not places:
        home[name] = value
        return
    indices = [int(place) for place in places.split(",")]
    for each in [indices, indices[::-1]] if name == "inertia" and len(indices) == 2 else [indices]:
        if isinstance(row := home.get(name), dict):
            try:
                home[name] = row = spread(Field(name, "numbers", name), row) if "value" in row or name != "inertia" else tensor_rows(_INERTIA, row)
            except Refused:
                pass  # it holds no such number, or what is wrong with it is told of the scene
        for place in each[:-1]:
            row = row[place] if isinstance(row, list) and place < len(row) else None
        if not isinstance(row, list) or each[-1] >= len(row) or isinstance(row[each[-1]], list | dict):
            raise _wrong(label, key, value, "there is no such number",
                         f"places are counted from 0, as {name}[0] of a vector and {name}[0,1] of a matrix, where the scene gives one")
        row[each[-1]] = value


# A dotted key: tables have one place at most, the number at its end two.
_KEY: Final = re.compile(r"([A-Za-z0-9_-]+(\[[0-9]{1,6}\])?\.)*[A-Za-z0-9_-]+(\[[0-9]{1,6}(,[0-9]{1,6})?\])?")
_NO_KEY: Final = ("this is no key", "write a key such as torque.drag, torque.control[0] or wheel[1].rate, places counted from 0")


def _dotted(key: str) -> str | None:
    """The key as it is looked up, without blanks about its places, `[i][j]` as `[i,j]`; None where it is none."""
    made = re.sub(r"\s*([\[\],])\s*", r"\1", key).replace("][", ",")
    return made if _KEY.fullmatch(made) else None


def parse_override(text: str) -> tuple[str, Any]:
    """`key=value` of the command line: a dotted key, with the places of tables and numbers in lists, or the bare name of one, and a TOML value, a bare
    word or a number with a unit."""

    def fail(key: str, value: str, problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake("--set", show(key)[1:-1], value, problem, remedy))

    key, equals, value = text.partition("=")
    key, value = key.strip(), value.strip()
    if not equals:
        raise fail(key, "", "there is no value", "write --set key=value, such as --set tolerance=1e-9")
    dotted = _dotted(key)
    if dotted is None:
        raise fail(key, show(value), *_NO_KEY)
    key = dotted
    try:
        read = tomllib.loads(f"value = {value}\n")
        if set(read) == {"value"}:
            return key, read["value"]
    except (tomllib.TOMLDecodeError, ValueError, RecursionError):
        if re.fullmatch(r"[A-Za-z][A-Za-z0-9_:-]*|[1-3]-[1-3]-[1-3]", value) or re.fullmatch(f"{PATTERN}|{SHARE_PATTERN}", value):
            return key, value
        if found := re.fullmatch(r"([-+.0-9eE]*[0-9.]) *([A-Za-z°/].*)", value):
            meant = f"{found[1]} {spelled(found[2])}"
            shown = meant if re.fullmatch(PATTERN, meant) else "3 h"
            raise fail(key, show(value), f"this is neither a TOML value nor a number with a unit, as {found[2]} is none",
                       f"put a value with a unit in quotes: --set '{key}=\"{shown}\"'")
    raise fail(key, show(value), "this is no TOML value", 'write a number, an array such as [1.0, 2.0, 3.0], or text in quotes')
